/* repair.h - step 2 of the command: a polygon -> the polygon that the options make of it. */
#ifndef SURFMINK_COMMAND_REPAIR_H
#define SURFMINK_COMMAND_REPAIR_H

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
    for (i = 0; i < p->n && p->n >= 3; ++i) {
        size_t before = i > 0 ? i - 1 : p->n - 1, behind = i + 1 < p->n ? i + 1 : 0;
        if (!(angle_between(p, i, before, behind, width) < spike_angle)) continue;
        if (least < 0) least = short_edge * perimeter_of(p) / (double)p->n;
        if (distance(p, before, i) >= least && distance(p, i, behind) >= least) return i;
    }
    return p->n;
}

/* --- corners ------------------------------------------------------------------------------------------------------ */

static void move_corner(polygon *p, size_t to, size_t from)
{
    size_t stride = stride_of(p->surface);
    if (to == from) return;
    memmove(p->corner + to * stride, p->corner + from * stride, stride * sizeof *p->corner);
    if (p->surface == EMBEDDED) memmove(p->normal + to * 3, p->normal + from * 3, 3 * sizeof *p->normal);
    p->line[to] = p->line[from];
    if (p->has_order) p->order[to] = p->order[from];
}

static void swap_corners(polygon *p, size_t i, size_t j)
{
    size_t stride = stride_of(p->surface), k;
    unsigned long line = p->line[i];
    double swap;
    for (k = 0; k < stride; ++k) {
        swap = p->corner[i * stride + k];
        p->corner[i * stride + k] = p->corner[j * stride + k];
        p->corner[j * stride + k] = swap;
    }
    for (k = 0; k < 3 && p->surface == EMBEDDED; ++k) {
        swap = p->normal[3 * i + k];
        p->normal[3 * i + k] = p->normal[3 * j + k];
        p->normal[3 * j + k] = swap;
    }
    p->line[i] = p->line[j];
    p->line[j] = line;
    if (!p->has_order) return;
    swap = p->order[i], p->order[i] = p->order[j], p->order[j] = swap;
}

/* Is the last corner the first one, repeated? */
static int is_closed(const polygon *p)
{
    double gap;
    if (p->n < 2) return 0;
    gap = distance(p, 0, p->n - 1);
    if (gap <= 0) return 1;
    if (p->n < 4 || !(gap < 1e-6 * distance(p, 0, p->n / 2))) return 0; /* far from it: saves the perimeter */
    return gap <= nearly_closed * perimeter_of(p);
}

static void drop_closing_corner(polygon *p)
{
    if (is_closed(p)) --p->n;
}

/* Heap sort by k: in place, and n log n whatever the order was. */
static void sift_down(polygon *p, size_t root, size_t end)
{
    size_t child;
    while ((child = 2 * root + 1) < end) {
        if (child + 1 < end && p->order[child] < p->order[child + 1]) ++child;
        if (!(p->order[root] < p->order[child])) return;
        swap_corners(p, root, child);
        root = child;
    }
}

static void sort_corners(polygon *p)
{
    size_t i;
    for (i = p->n / 2; i > 0; --i) sift_down(p, i - 1, p->n);
    for (i = p->n; i > 1; --i) {
        swap_corners(p, 0, i - 1);
        sift_down(p, 0, i - 1);
    }
}

/* k tells the order of the corners, wherever their lines stand. The first corner may be repeated with its own k. */
static void order_corners(polygon *p)
{
    size_t i;
    int rises = 1;
    if (!p->has_order) return;
    for (i = 0; i < p->n; ++i)
        if (!(fabs(p->order[i]) <= 1e15) || floor(p->order[i]) < p->order[i])
            find_fault(p, FAULT_BAD_ORDER, p->line[i]);
    if (p->n > 1 && p->order[p->n - 1] <= p->order[0] && p->order[p->n - 1] >= p->order[0] && is_closed(p)) --p->n;
    for (i = 1; i < p->n; ++i) rises &= p->order[i - 1] < p->order[i];
    if (rises || p->fault != SURFMINK_OK) return;
    sort_corners(p);
    for (i = 1; i < p->n; ++i)
        if (!(p->order[i - 1] < p->order[i]))
            find_fault(p, FAULT_BAD_ORDER, p->line[i - 1] > p->line[i] ? p->line[i - 1] : p->line[i]);
    p->has_order = 0;
}

/* On a sphere of radius 1. */
static double merge_distance(const polygon *p, const options *o)
{
    if (o->merge_relative) return o->merge_distance * perimeter_of(p);
    return p->surface == SPHERE && o->radius > 0 ? o->merge_distance / o->radius : o->merge_distance;
}

/* surfmink_merge, but lines go along with their corners, and corners of a sphere are compared as directions. */
static void merge_corners(polygon *p, const options *o)
{
    double near = merge_distance(p, o);
    size_t i, kept = 1;
    for (i = 1; i < p->n; ++i) {
        if (near > 0 ? distance(p, i, kept - 1) <= near : coincide(p, i, kept - 1)) continue;
        move_corner(p, kept++, i);
    }
    if (p->n > 0) p->n = kept;
    while (p->n > 1 && (near > 0 ? distance(p, 0, p->n - 1) <= near : coincide(p, 0, p->n - 1))) --p->n;
}

/* Is corner `tip` one that its neighbours i and j do without: coinciding with i, or the tip of a spike that is no wider
   than `near`? */
static int is_needless(const polygon *p, size_t tip, size_t i, size_t j, double near)
{
    double width;
    if (coincide(p, i, tip) || distance(p, i, tip) <= near) return 1;
    return i != j && angle_between(p, tip, i, j, &width) < 1 && width <= near;
}

/* Takes out spikes, however long: x, tip, x; x, y, tip, y, x; x, tip, y, x; ... and with them seams, where an outline
   comes back the way it went. */
static void remove_spikes(polygon *p, const options *o)
{
    size_t i, kept = 0, before = p->n;
    double near = nearly_closed * perimeter_of(p);
    if (o->merge && merge_distance(p, o) > near) near = merge_distance(p, o);
    for (i = 0; i < p->n; ++i) {
        move_corner(p, kept++, i);
        while (kept > 2 && is_needless(p, kept - 2, kept - 3, kept - 1, near)) {
            move_corner(p, kept - 2, kept - 1);
            --kept;
        }
    }
    p->n = kept;
    for (;;) { /* across the first corner */
        if (p->n > 2 && is_needless(p, p->n - 1, p->n - 2, 0, near))
            --p->n;
        else if (p->n > 2 && is_needless(p, 0, p->n - 1, 1, near)) {
            for (i = 1; i < p->n; ++i) move_corner(p, i - 1, i);
            --p->n;
        } else
            break;
    }
    if (p->n < before && p->n >= 3)
        remark("%s:%lu: %s: %lu corners of spikes or seams are taken out", current_file, p->first_line, p->id,
               (unsigned long)(before - p->n));
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
        if ((straight_off(p, first, i) <= nearly_closed * reach || coincide(p, first, i)) &&
            is_ring(p, first, i, area))
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

typedef struct place {
    double x[3];
    size_t corner;
} place;

static int compare_places(const void *one, const void *other)
{
    const place *a = (const place *)one, *b = (const place *)other;
    int k;
    for (k = 0; k < 3; ++k)
        if (a->x[k] < b->x[k] || a->x[k] > b->x[k]) return a->x[k] < b->x[k] ? -1 : 1;
    return a->corner < b->corner ? -1 : a->corner > b->corner;
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
    place *at;
    if (n < 8) return 0; /* two rings of three corners, and the two ends of the seam once more */
    at = (place *)resize(NULL, n, sizeof *at);
    for (i = 0; i < n; ++i) {
        for (k = 0; k < 3; ++k) at[i].x[k] = k < stride ? p->corner[i * stride + k] + 0.0 : 0; /* no -0 */
        at[i].corner = i;
    }
    qsort(at, n, sizeof *at, compare_places);
    least = reach_of(p, 0);
    least *= least * (1e-12 + 2e-16 * (double)n);
    sum = sum_areas(p);
    for (i = 0; i < n && !found; ++i)
        for (j = i + 1; j < n && j <= i + ALIKE && !found && memcmp(at[i].x, at[j].x, sizeof at->x) == 0; ++j)
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

/* Begins with the larger of the rings that a seam joins, so that each comes closed, one after the other. */
static void cut_seam(polygon *p, const size_t seam[2])
{
    size_t stride = stride_of(p->surface), i, from;
    double *sum = sum_areas(p), size[2];
    polygon turned;
    sizes_beside(p, sum, seam, size);
    free(sum);
    from = seam[size[0] > size[1] ? 0 : 1] + 1;
    memset(&turned, 0, sizeof turned);
    begin_polygon(&turned, p->surface, p->id, p->first_line);
    for (i = 0; i < p->n; ++i) {
        size_t at = (from + i) % p->n;
        add_corner(&turned, p->corner + at * stride, p->normal + 3 * at, p->line[at]);
    }
    p->n = 0;
    for (i = 0; i < turned.n; ++i) add_corner(p, turned.corner + i * stride, turned.normal + 3 * i, turned.line[i]);
    free_polygon(&turned);
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Corners of more outlines than a few buildings have: those of pixels. */
enum { FEWEST_STAIRS = 12 };

/* Do all edges run along the two axes? */
static int is_staircase(const polygon *p)
{
    size_t i;
    if (p->surface != PLANE || p->n <= FEWEST_STAIRS) return 0;
    for (i = 0; i < p->n; ++i) {
        const double *a = p->corner + 2 * i, *b = p->corner + 2 * (i + 1 < p->n ? i + 1 : 0);
        if (fabs(a[0] - b[0]) > 0 && fabs(a[1] - b[1]) > 0) return 0;
    }
    return 1;
}

/* A pass of the mean moves a corner by its edges, so they are to be alike: within a factor of 3, as the sides and
   diagonals of pixels and what is left of them are. */
static int is_uneven(const polygon *p)
{
    double least = HUGE_VAL, most = 0;
    size_t i;
    for (i = 0; i < p->n; ++i) {
        double length = distance(p, i, i + 1 < p->n ? i + 1 : 0);
        if (length < least) least = length;
        if (length > most) most = length;
    }
    return most > 3 * least;
}

/* Told of the first outline that is so. */
static void tell_pixels(const polygon *p, const options *o)
{
    if (!o->smooth && is_staircase(p) && warns(WARN_STAIRS))
        remark("%s:%lu: %s: all edges run along the axes, as those of pixels do, and mu_4 says just that; --resample 1 "
               "--smooth 4 (1: the size of a pixel), or trace a grey image",
               current_file, p->first_line, p->id);
    if (o->smooth && !(o->resample > 0) && is_uneven(p) && warns(WARN_UNEVEN))
        remark("%s:%lu: %s: --smooth wants edges of like length, and these are not; --resample STEP makes them so",
               current_file, p->first_line, p->id);
}

/* Corners at equal distances of about `step` along the outline, from the first one on. On a sphere along the chords. */
static void resample_corners(polygon *p, double step)
{
    polygon fine;
    size_t stride = stride_of(p->surface), n, i, k, edge = 0;
    double length = 0, at, passed = 0, *side = (double *)resize(NULL, p->n + 1, sizeof *side), x[3],
           normal[3] = {0, 0, 0};
    side[0] = 0;
    for (i = 0; i < p->n; ++i) {
        const double *a = p->corner + i * stride, *b = p->corner + (i + 1 < p->n ? i + 1 : 0) * stride;
        side[i] = hypot(hypot(b[0] - a[0], b[1] - a[1]), stride == 3 ? b[2] - a[2] : 0);
        length += side[i];
    }
    if (!(length / step < 1e8))
        die("%s:%lu: --resample %g makes too many corners of an outline of length %g", current_file, p->first_line,
            step, length);
    n = (size_t)(length / step + 0.5);
    if (n < 3) n = 3;
    memset(&fine, 0, sizeof fine);
    begin_polygon(&fine, p->surface, p->id, p->first_line);
    for (i = 0; i < n && length > 0 && p->corner; ++i) {
        const double *a, *b;
        double t;
        size_t next;
        at = length * (double)i / (double)n;
        while (edge + 1 < p->n && passed + side[edge] <= at) passed += side[edge++];
        next = edge + 1 < p->n ? edge + 1 : 0;
        a = p->corner + edge * stride, b = p->corner + next * stride;
        t = side[edge] > 0 ? (at - passed) / side[edge] : 0;
        for (k = 0; k < stride; ++k) x[k] = a[k] + t * (b[k] - a[k]);
        for (k = 0; k < 3 && p->surface == EMBEDDED; ++k)
            normal[k] = p->normal[3 * edge + k] + t * (p->normal[3 * next + k] - p->normal[3 * edge + k]);
        add_corner(&fine, x, normal, p->line[edge]);
    }
    free(side);
    if (fine.n > 0) {
        p->n = 0;
        for (i = 0; i < fine.n; ++i) add_corner(p, fine.corner + i * stride, fine.normal + 3 * i, fine.line[i]);
    }
    free_polygon(&fine);
}

static void smooth_corners(polygon *p, size_t passes)
{
    surfmink_smooth(p->corner, p->n, stride_of(p->surface), passes);
    if (p->surface == EMBEDDED) surfmink_smooth(p->normal, p->n, 3, passes);
}

static void reverse_corners(polygon *p)
{
    size_t i;
    surfmink_reverse(p->corner, p->n, stride_of(p->surface));
    if (p->surface == EMBEDDED) surfmink_reverse(p->normal, p->n, 3);
    for (i = 0; i < p->n / 2; ++i) {
        unsigned long line = p->line[i];
        p->line[i] = p->line[p->n - 1 - i];
        p->line[p->n - 1 - i] = line;
    }
}

/* In the order in which repairs may help each other. A fault shall not be smeared over its neighbours by smoothing. */
static void repair_polygon(polygon *p, const options *o)
{
    size_t end, seam[2];
    double fraction;
    order_corners(p);
    drop_closing_corner(p);
    if (p->fault != SURFMINK_OK) return;
    if (o->merge) merge_corners(p, o);
    if (o->repair) remove_spikes(p, o);
    if ((end = ring_end(p, 0)) < p->n || (end = hole_begin(p)) < p->n) {
        find_fault(p, FAULT_SEVERAL_RINGS, p->line[end]);
        return;
    }
    if (find_seam(p, seam)) {
        find_fault(p, FAULT_SEAM, p->line[seam[1]]);
        return;
    }
    if ((o->order == 4 || o->error) && p->n > 3 && (end = find_short_edge(p, &fraction)) < p->n &&
        !coincide(p, end, end + 1 < p->n ? end + 1 : 0)) {
        find_fault(p, FAULT_SHORT_EDGE, p->line[end + 1 < p->n ? end + 1 : 0]);
        return;
    }
    tell_pixels(p, o);
    if (o->smooth && (end = find_spike(p, &fraction)) < p->n && p->n > 4) {
        find_fault(p, FAULT_SPIKE, p->line[end]);
        return;
    }
    if (o->resample > 0) resample_corners(p, o->resample);
    smooth_corners(p, o->smooth);
    if (o->reverse == REVERSE_ALWAYS) reverse_corners(p);
}

#endif
