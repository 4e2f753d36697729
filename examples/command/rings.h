/* rings.h - step 2 of the command: what is odd about a polygon: corners that coincide, edges that are none, spikes,
   rings that close before its end, seams. */
#ifndef SURFMINK_COMMAND_RINGS_H
#define SURFMINK_COMMAND_RINGS_H

#include "../beyond/crossings.h"
#include "polygon.h"

/* A last corner nearer to the first than this fraction of the perimeter is the first one, repeated: it has been through
   a sum or a change of units, which costs a few units in the last place of coordinates that may be 1e3 perimeters
   away. */
static const double nearly_closed = 1e-12;
/* An edge below this fraction of the mean one is a corner that was written twice, not a side: its direction is rounding
   noise, or 1e-6 of its size is. */
static const double short_edge = 1e-6;

/* A corner at which the outline turns back on itself within this angle, in radians, is a spike. */
static const double spike_angle = 1e-5;

/* --- distances ---------------------------------------------------------------------------------------------------- */

/* From corner i to corner j, on a sphere of radius 1 between their directions. */
static double distance(const polygon *p, size_t i, size_t j)
{
    size_t k, stride = stride_of(p->surface);
    const double *a = p->corner + i * stride, *b = p->corner + j * stride;
    double between[3] = {0, 0, 0};
    if (p->surface == SPHERE) {
        if (surfmink_sphere_log(a, b, 1, between) != SURFMINK_OK) return 4; /* antipodes, or no directions */
    } else {
        for (k = 0; k < stride; ++k) between[k] = b[k] - a[k];
    }
    return hypot(hypot(between[0], between[1]), between[2]);
}

/* Are they the same point, so that the library would refuse the edge between them? On a sphere directions decide. */
static int coincide(const polygon *p, size_t i, size_t j)
{
    size_t k, stride = stride_of(p->surface);
    const double *a = p->corner + i * stride, *b = p->corner + j * stride;
    if (p->surface == SPHERE) {
        for (k = 0; k < 3; ++k) { /* most are told apart by the cross product, whose two terms are far from equal */
            double u = a[k] * b[(k + 1) % 3], v = a[(k + 1) % 3] * b[k];
            if (fabs(u - v) > 1e-12 * (fabs(u) + fabs(v))) return 0;
        }
        return distance(p, i, j) <= 0;
    }
    for (k = 0; k < stride; ++k)
        if (a[k] != b[k]) return 0;
    return 1;
}

static double perimeter_of(const polygon *p)
{
    double sum = 0;
    size_t i;
    for (i = 0; i < p->n; ++i) sum += distance(p, i, i + 1 < p->n ? i + 1 : 0);
    return sum;
}

/* The corner that the shortest edge begins at, if that is a short edge; else n. *fraction: of the perimeter. */
static size_t find_short_edge(const polygon *p, double *fraction)
{
    double perimeter = perimeter_of(p), least = HUGE_VAL;
    size_t i, at = p->n;
    for (i = 0; i < p->n; ++i) {
        double length = distance(p, i, i + 1 < p->n ? i + 1 : 0);
        if (length < least) least = length, at = i;
    }
    *fraction = least / perimeter;
    return least < short_edge * perimeter / (double)p->n ? at : p->n;
}

/* The edges from corner `tip` to corners i and j: what they are as vectors, or on a sphere the normals of their great
   circles. Returns the sine of the angle between them, *width how far the end of the shorter one is from the other; 2
   if they go different ways. */
static double angle_between(const polygon *p, size_t tip, size_t i, size_t j, double *width)
{
    size_t stride = stride_of(p->surface), k;
    const double *t = p->corner + tip * stride, *a = p->corner + i * stride, *b = p->corner + j * stride;
    double u[3] = {0, 0, 0}, v[3] = {0, 0, 0}, u_norm, v_norm, height, cosine = 0;
    for (k = 0; k < stride; ++k) {
        size_t l = (k + 1) % 3, m = (k + 2) % 3;
        u[k] = p->surface == SPHERE ? t[l] * a[m] - t[m] * a[l] : a[k] - t[k];
        v[k] = p->surface == SPHERE ? t[l] * b[m] - t[m] * b[l] : b[k] - t[k];
        cosine += u[k] * v[k];
    }
    if (!(cosine > 0)) return 2;
    u_norm = hypot(hypot(u[0], u[1]), u[2]);
    v_norm = hypot(hypot(v[0], v[1]), v[2]);
    height = hypot(hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2]), u[0] * v[1] - u[1] * v[0]);
    *width = height / (u_norm > v_norm ? u_norm : v_norm);
    if (p->surface == SPHERE) *width /= hypot(hypot(t[0], t[1]), t[2]) * hypot(hypot(a[0], a[1]), a[2]);
    return height / (u_norm * v_norm);
}

/* The tip of the first spike, where the outline turns back on itself along edges that are none of the short ones; else
   n. *width: how wide it is. */
static size_t find_spike(const polygon *p, double *width)
{
    double least = -1;
    size_t i;
    *width = 0;
    for (i = 0; i < p->n && p->n >= 3; ++i) {
        size_t before = i > 0 ? i - 1 : p->n - 1, behind = i + 1 < p->n ? i + 1 : 0;
        if (!(angle_between(p, i, before, behind, width) < spike_angle)) continue;
        if (least < 0) least = short_edge * perimeter_of(p) / (double)p->n;
        if (distance(p, before, i) >= least && distance(p, i, behind) >= least) return i;
    }
    return p->n;
}

/* --- rings -------------------------------------------------------------------------------------------------------- */

/* Twice the area vector of the corners from `first` to before `end`. */
static void area_vector(const polygon *p, size_t first, size_t end, double area[3])
{
    size_t stride = stride_of(p->surface), i, k;
    double a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
    area[0] = area[1] = area[2] = 0;
    for (i = first + 1; i + 1 < end; ++i) {
        for (k = 0; k < stride; ++k) {
            a[k] = p->corner[i * stride + k] - p->corner[first * stride + k];
            b[k] = p->corner[(i + 1) * stride + k] - p->corner[first * stride + k];
        }
        area[0] += a[1] * b[2] - a[2] * b[1];
        area[1] += a[2] * b[0] - a[0] * b[2];
        area[2] += a[0] * b[1] - a[1] * b[0];
    }
}

/* The sum of the coordinates by which corner i is off from corner `from`. */
static double straight_off(const polygon *p, size_t from, size_t i)
{
    size_t stride = stride_of(p->surface), k;
    double sum = 0;
    for (k = 0; k < stride; ++k) sum += fabs(p->corner[i * stride + k] - p->corner[from * stride + k]);
    return sum;
}

/* How far the outline reaches from corner `from`. */
static double reach_of(const polygon *p, size_t from)
{
    double reach = 0;
    size_t i;
    for (i = 0; i < p->n; ++i)
        if (straight_off(p, from, i) > reach) reach = straight_off(p, from, i);
    return reach;
}

/* Do the corners from `first` to before `end` enclose anything, and do not just go there and back? */
static int is_ring(const polygon *p, size_t first, size_t end, double area[3])
{
    double reach = 0;
    size_t i;
    area_vector(p, first, end, area);
    for (i = first; i < end; ++i)
        if (straight_off(p, first, i) > reach) reach = straight_off(p, first, i);
    return hypot(hypot(area[0], area[1]), area[2]) > 1e-12 * reach * reach;
}

/* The corner at which the ring that begins at `first` has closed: its first corner again, or nearly. n if it does
   not. */
static size_t ring_end(const polygon *p, size_t first)
{
    double reach = p->n > first + 3 ? reach_of(p, first) : 0, area[3];
    size_t i;
    for (i = first + 3; i < p->n; ++i)
        if ((straight_off(p, first, i) <= nearly_closed * reach || coincide(p, first, i)) && is_ring(p, first, i, area))
            return i;
    return p->n;
}

/* The same from the end: where a ring begins that closes with the last corner and runs the other way round, as holes
   do behind an outer ring that is left open. */
static size_t hole_begin(const polygon *p)
{
    double reach = p->n > 6 ? reach_of(p, p->n - 1) : 0, outer[3], hole[3];
    size_t i;
    for (i = 3; i + 4 <= p->n && reach > 0; ++i)
        if ((straight_off(p, p->n - 1, i) <= nearly_closed * reach || coincide(p, p->n - 1, i)) &&
            is_ring(p, i, p->n - 1, hole) && is_ring(p, 0, i, outer) &&
            outer[0] * hole[0] + outer[1] * hole[1] + outer[2] * hole[2] < 0)
            return i;
    return p->n;
}

/* --- seams -------------------------------------------------------------------------------------------------------- */

typedef struct corner_place {
    double x[3];
    size_t corner;
} corner_place;

static int compare_points(const corner_place *a, const corner_place *b)
{
    int k;
    for (k = 0; k < 3; ++k)
        if (a->x[k] < b->x[k] || a->x[k] > b->x[k]) return a->x[k] < b->x[k] ? -1 : 1;
    return 0;
}

static int compare_places(const void *one, const void *other)
{
    const corner_place *a = (const corner_place *)one, *b = (const corner_place *)other;
    int order = compare_points(a, b);
    return order ? order : a->corner < b->corner ? -1 : a->corner > b->corner;
}

/* sum[3 i]: the area vector, twice, of corners 0 to i, each edge seen from corner 0. */
static double *sum_areas(const polygon *p)
{
    double *sum = (double *)resize(NULL, p->n + 1, 3 * sizeof *sum);
    size_t stride = stride_of(p->surface), i, k;
    double a[3] = {0, 0, 0}, b[3] = {0, 0, 0};
    sum[0] = sum[1] = sum[2] = 0;
    for (i = 0; i < p->n; ++i) {
        const double *x = p->corner + i * stride, *y = i + 1 < p->n ? x + stride : p->corner;
        for (k = 0; k < stride; ++k) a[k] = x[k] - p->corner[k], b[k] = y[k] - p->corner[k];
        for (k = 0; k < 3; ++k)
            sum[3 * i + 3 + k] = sum[3 * i + k] + a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    return sum;
}

/* How much is enclosed between the two edges of a seam, and how much beyond. */
static void sizes_beside(const polygon *p, const double *sum, const size_t seam[2], double size[2])
{
    double inner[3], outer[3];
    int k;
    for (k = 0; k < 3; ++k) {
        inner[k] = sum[3 * seam[1] + (size_t)k] - sum[3 * seam[0] + 3 + (size_t)k];
        outer[k] = sum[3 * p->n + (size_t)k] - inner[k];
    }
    size[0] = hypot(hypot(inner[0], inner[1]), inner[2]);
    size[1] = hypot(hypot(outer[0], outer[1]), outer[2]);
}

/* An edge that the outline goes back along, from corner seam[0] to the next and later from corner seam[1] to the next,
   with something enclosed on both sides. Returns whether there is one. */
static int find_seam(const polygon *p, size_t seam[2])
{
    enum { ALIKE = 8 }; /* of the corners at one place those that come next are looked at */
    size_t stride = stride_of(p->surface), i, j, k, n = p->n;
    double least, *sum, size[2];
    int found = 0;
    corner_place *at;
    if (n < 8) return 0; /* two rings of three corners, and the two ends of the seam once more */
    at = (corner_place *)resize(NULL, n, sizeof *at);
    for (i = 0; i < n; ++i) {
        for (k = 0; k < 3; ++k) at[i].x[k] = k < stride ? p->corner[i * stride + k] + 0.0 : 0; /* no -0 */
        at[i].corner = i;
    }
    qsort(at, n, sizeof *at, compare_places);
    least = reach_of(p, 0);
    least *= least * (1e-12 + 2e-16 * (double)n);
    sum = sum_areas(p);
    for (i = 0; i < n && !found; ++i)
        for (j = i + 1; j < n && j <= i + ALIKE && !found && compare_points(at + i, at + j) == 0; ++j)
            for (k = 0; k < 2 && !found && (k == 0 || at[i].corner == 0); ++k) { /* both may end at corner 0 */
                seam[0] = at[k ? j : i].corner;
                seam[1] = k ? n - 1 : at[j].corner - 1;
                if (!(seam[0] < seam[1]) || !coincide(p, seam[0] + 1, seam[1])) continue;
                sizes_beside(p, sum, seam, size);
                found = size[0] > least && size[1] > least;
            }
    free(at);
    free(sum);
    return found;
}

/* --- crossings ---------------------------------------------------------------------------------------------------- */

/* Outlines of more corners than this are only looked at with --crossings always. */
enum { MOST_TO_CROSS = 2000 };

/* Edges that cross: turning and area do not give all of them away. `status` is what surfmink_measure says of the
   outline. Returns 1 if two edges cross, as crossings.h does; they are in pair, which else has p->n twice. */
static int find_crossing(const polygon *p, int status, const options *o, size_t pair[2])
{
    int found;
    pair[0] = pair[1] = p->n;
    if (status != SURFMINK_OK && status != SURFMINK_CLOCKWISE && status != SURFMINK_CROSSES_ITSELF &&
        status != SURFMINK_TOO_MUCH_CURVATURE)
        return 0;
    if (o->crossings == CROSSINGS_NEVER || (o->crossings == CROSSINGS_AUTO && p->n > MOST_TO_CROSS)) return 0;
    switch (p->surface) {
    case PLANE: found = crossings_plane(p->corner, p->n, pair); break;
    case SPHERE: found = crossings_sphere(p->corner, p->n, pair); break;
    default: found = crossings_embedded(p->corner, p->normal, p->n, pair);
    }
    if (found == CROSSINGS_NO_MEMORY) die(COMMAND_NAME ": out of memory");
    return found;
}

#endif
