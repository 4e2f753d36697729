/* crossings.h - does an outline cross itself, and where? - MIT or public domain, as you like (see surfmink.h)

   One header to copy; it needs no other file. C99 and C++, only libc and libm.

   WHY  Length, turning and area are those of a closed curve, simple or not. Turning and area together give most curves
     away that cross themselves, but not those with one loop to the left and one to the right: (1,0) (1,6) (0,6) (6,4)
     (0,0) turns by 2 pi. Here pairs of edges are looked at, and the answer is certain.

   QUICK START
     size_t pair[2];
     if (crossings_plane(corner, n, pair) > 0) printf("edges %zu and %zu cross\n", pair[0], pair[1]);

   WHAT COUNTS  Two edges that have one point in common that is inside of both; and a corner that lies on another edge,
     or on another corner, if the outline changes sides there. Outlines that touch themselves do not cross; nor do edges
     that lie on each other: spikes, needles and seams.

   METHOD  Edges sorted by their least x, each against those before it that have not ended, if their boxes meet:
     O(n log n) for outlines whose edges are short beside them. A convex outline, all of whose turns are to the left
     and add up to one, costs n.
     plane     orientation of three points by its sign: in doubles if an error bound says that they decide, else exact,
               by sums of doubles that do not round (Shewchuk, Adaptive precision floating-point arithmetic, 1997)
     sphere    great-circle arcs: four triple products, of differences, so that small cells keep their digits. Where
               rounding decides, they touch, which is not crossing
     embedded  seen along the mean normal, where all normals are within 60 degrees of it: beyond that the view may fold
               over what is not folded, and what crosses there may cross or not

   Coordinates between 1e-140 and 1e140, or 0. Scratch comes from malloc. */
#ifndef SURFMINK_CROSSINGS_H
#define SURFMINK_CROSSINGS_H

#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* What the functions return besides 0, no edges cross, and 1, two do: pair. The last two: embedded, normals are more
   than 60 degrees from their mean. */
enum crossings_result { CROSSINGS_NO_MEMORY = -1, CROSSINGS_UNKNOWN = -2, CROSSINGS_SEEN = 2 };

/* --- the sign of a determinant ------------------------------------------------------------------------------------ */

/* Adds x to a sum of doubles that do not overlap, smallest first; returns how many there are then. */
static inline int crossings__add(double *sum, int count, double x)
{
    int i, kept = 0;
    for (i = 0; i < count; ++i) {
        double total = x + sum[i], part = total - x, error = (x - (total - part)) + (sum[i] - part);
        if (error != 0) sum[kept++] = error;
        x = total;
    }
    if (x != 0 || kept == 0) sum[kept++] = x;
    return kept;
}

/* Adds sign * x * y, exactly. */
static inline int crossings__add_product(double *sum, int count, double sign, double x, double y)
{
    double high = x * y, low = fma(x, y, -high);
    count = crossings__add(sum, count, sign * low);
    return crossings__add(sum, count, sign * high);
}

/* Positive if a, b, c run counter-clockwise, 0 if they lie on one line: exactly. */
static inline double crossings_orientation(const double *a, const double *b, const double *c)
{
    double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]), sum[16];
    double bound = 3.5 * DBL_EPSILON * (fabs(left) + fabs(right)); /* Shewchuk: (3 + 16 u) u, u = DBL_EPSILON / 2 */
    int count = 0;
    if (left - right > bound || right - left > bound) return left - right;
    count = crossings__add_product(sum, count, 1, a[0], b[1]);
    count = crossings__add_product(sum, count, -1, a[0], c[1]);
    count = crossings__add_product(sum, count, -1, c[0], b[1]);
    count = crossings__add_product(sum, count, -1, a[1], b[0]);
    count = crossings__add_product(sum, count, 1, a[1], c[0]);
    count = crossings__add_product(sum, count, 1, c[1], b[0]);
    return sum[count - 1];
}

/* The sign of the triple product of three directions; 0 where rounding decides. */
static inline int crossings__triple(const double *a, const double *b, const double *c)
{
    double u[3], v[3], w[3], sum = 0, size = 0;
    int k;
    for (k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
    for (k = 0; k < 3; ++k) {
        double p = u[(k + 1) % 3] * v[(k + 2) % 3], q = u[(k + 2) % 3] * v[(k + 1) % 3];
        w[k] = p - q;
        sum += a[k] * w[k];
        size += fabs(a[k]) * (fabs(p) + fabs(q));
    }
    if (fabs(sum) <= 8 * DBL_EPSILON * size) return 0;
    return sum > 0 ? 1 : -1;
}

/* --- two edges ---------------------------------------------------------------------------------------------------- */

typedef struct crossings__outline {
    const double *corner;
    size_t n;
    int stride; /* 2: plane, 3: sphere */
} crossings__outline;

static inline const double *crossings__corner(const crossings__outline *o, size_t i)
{
    return o->corner + (size_t)o->stride * (i < o->n ? i : i - o->n);
}

/* On which side of the line or great circle through a and b is c? */
static inline int crossings__side(const crossings__outline *o, const double *a, const double *b, const double *c)
{
    double turn;
    if (o->stride == 3) return crossings__triple(a, b, c);
    turn = crossings_orientation(a, b, c);
    return (turn > 0) - (turn < 0);
}

static inline int crossings__same(const crossings__outline *o, const double *a, const double *b)
{
    return memcmp(a, b, (size_t)o->stride * sizeof *a) == 0;
}

/* Is c, which lies on the line of a and b, between them? */
static inline int crossings__between(const crossings__outline *o, const double *a, const double *b, const double *c)
{
    double sum = 0;
    int k;
    for (k = 0; k < o->stride; ++k) sum += (c[k] - a[k]) * (c[k] - b[k]);
    return sum < 0;
}

/* Does direction d lie in the sector that is passed by turning counter-clockwise at x from a to b? */
static inline int crossings__in_sector(const crossings__outline *o, const double *x, const double *a, const double *b,
                                       const double *d)
{
    int ab = crossings__side(o, x, a, b), ad = crossings__side(o, x, a, d), db = crossings__side(o, x, d, b);
    if (ab > 0) return ad > 0 && db > 0;
    return !(ad < 0 && db < 0) && ad != 0 && db != 0;
}

/* The corner j lies in edge i: does the outline change sides there? */
static inline int crossings__through_edge(const crossings__outline *o, size_t i, size_t j)
{
    const double *a = crossings__corner(o, i), *b = crossings__corner(o, i + 1);
    int before = crossings__side(o, a, b, crossings__corner(o, j + o->n - 1)),
        behind = crossings__side(o, a, b, crossings__corner(o, j + 1));
    return before * behind < 0;
}

/* Corners i and j are one point: do the ways through them cross there? */
static inline int crossings__through_corner(const crossings__outline *o, size_t i, size_t j)
{
    const double *x = crossings__corner(o, i), *in = crossings__corner(o, i + o->n - 1),
                 *out = crossings__corner(o, i + 1), *other_in = crossings__corner(o, j + o->n - 1),
                 *other_out = crossings__corner(o, j + 1);
    if (crossings__side(o, x, in, other_in) == 0 || crossings__side(o, x, in, other_out) == 0 ||
        crossings__side(o, x, out, other_in) == 0 || crossings__side(o, x, out, other_out) == 0)
        return 0; /* they lie on each other for a while */
    return crossings__in_sector(o, x, out, in, other_in) != crossings__in_sector(o, x, out, in, other_out);
}

/* Do edges i and j cross, which have no corner in common by their numbers? */
static inline int crossings__cross(const crossings__outline *o, size_t i, size_t j)
{
    const double *a = crossings__corner(o, i), *b = crossings__corner(o, i + 1), *c = crossings__corner(o, j),
                 *d = crossings__corner(o, j + 1);
    int side_c = crossings__side(o, a, b, c), side_d = crossings__side(o, a, b, d), side_a, side_b;
    if (side_c * side_d > 0) return 0;
    side_a = crossings__side(o, c, d, a), side_b = crossings__side(o, c, d, b);
    if (side_a * side_b > 0) return 0;
    if (side_a * side_b < 0 && side_c * side_d < 0)
        return o->stride == 2 || (side_a == -side_c); /* on the sphere the circles also meet at the antipode */
    if (crossings__same(o, a, c)) return crossings__through_corner(o, i, j);
    if (crossings__same(o, a, d) || crossings__same(o, b, c) || crossings__same(o, b, d)) return 0; /* seen from a, c */
    if (side_c == 0 && side_d != 0 && crossings__between(o, a, b, c)) return crossings__through_edge(o, i, j);
    if (side_a == 0 && side_b != 0 && crossings__between(o, c, d, a)) return crossings__through_edge(o, j, i);
    return 0;
}

/* --- all edges ---------------------------------------------------------------------------------------------------- */

typedef struct crossings__box {
    double low[3], high[3];
    size_t edge;
} crossings__box;

static inline int crossings__by_low(const void *a, const void *b)
{
    double x = ((const crossings__box *)a)->low[0], y = ((const crossings__box *)b)->low[0];
    return (x > y) - (x < y);
}

/* An arc of a great circle leaves the box of its chord by no more than chord^2 / 8, a little more for long ones. */
static inline void crossings__find_box(const crossings__outline *o, size_t i, crossings__box *box)
{
    const double *a = crossings__corner(o, i), *b = crossings__corner(o, i + 1);
    double chord = 0;
    int k;
    box->edge = i;
    for (k = 0; k < o->stride; ++k) {
        box->low[k] = a[k] < b[k] ? a[k] : b[k];
        box->high[k] = a[k] < b[k] ? b[k] : a[k];
        chord += (b[k] - a[k]) * (b[k] - a[k]);
    }
    for (k = 0; k < 3 && o->stride == 3; ++k) {
        box->low[k] -= chord / 4 + 4 * DBL_EPSILON; /* sagitta <= chord^2 / 4 up to half a circle, at radius 1 */
        box->high[k] += chord / 4 + 4 * DBL_EPSILON;
    }
}

static inline int crossings__are_neighbours(const crossings__outline *o, size_t i, size_t j)
{
    return i == j || i + 1 == j || j + 1 == i || (i == 0 && j + 1 == o->n) || (j == 0 && i + 1 == o->n);
}

static inline int crossings__find(const crossings__outline *o, size_t pair[2])
{
    crossings__box *box = (crossings__box *)malloc((o->n + 1) * sizeof *box);
    size_t *open = (size_t *)malloc((o->n + 1) * sizeof *open), i, k, count = 0, kept;
    int axis, found = 0;
    if (!box || !open) found = CROSSINGS_NO_MEMORY;
    for (i = 0; !found && i < o->n; ++i) crossings__find_box(o, i, &box[i]);
    if (!found) qsort(box, o->n, sizeof *box, crossings__by_low);
    for (i = 0; !found && i < o->n; ++i) {
        for (k = kept = 0; k < count && !found; ++k) {
            const crossings__box *other = &box[open[k]];
            if (other->high[0] < box[i].low[0]) continue; /* it has ended */
            open[kept++] = open[k];
            for (axis = 1; axis < o->stride; ++axis)
                if (other->high[axis] < box[i].low[axis] || box[i].high[axis] < other->low[axis]) break;
            if (axis < o->stride || crossings__are_neighbours(o, box[i].edge, other->edge)) continue;
            if (!crossings__cross(o, box[i].edge, other->edge)) continue;
            pair[0] = box[i].edge < other->edge ? box[i].edge : other->edge;
            pair[1] = box[i].edge < other->edge ? other->edge : box[i].edge;
            found = 1;
        }
        count = found ? count : kept;
        open[count++] = i;
    }
    free(box);
    free(open);
    return found;
}

/* Is it convex: does it turn to the left everywhere, and does x go up once and down once? */
static inline int crossings__is_convex(const crossings__outline *o)
{
    size_t i, changes = 0;
    int last = 0;
    for (i = 0; i < o->n; ++i) {
        const double *a = crossings__corner(o, i), *b = crossings__corner(o, i + 1);
        int way = (b[0] > a[0]) - (b[0] < a[0]);
        if (crossings__side(o, a, b, crossings__corner(o, i + 2)) <= 0) return 0;
        if (way && last && way != last) ++changes;
        if (way) last = way;
    }
    return changes <= 2;
}

/* Outlines of the plane: corner has n times x y. 1 and the numbers of two edges that cross (edge i joins corners i and
   i + 1), or 0. pair is untouched unless the result is positive. */
static inline int crossings_plane(const double *corner, size_t n, size_t pair[2])
{
    crossings__outline o;
    o.corner = corner;
    o.n = n;
    o.stride = 2;
    if (n < 4 || crossings__is_convex(&o)) return 0;
    return crossings__find(&o, pair);
}

/* Outlines of great-circle arcs: corner has n times x y z, of which only the directions count. */
static inline int crossings_sphere(const double *corner, size_t n, size_t pair[2])
{
    crossings__outline o;
    double *unit = (double *)malloc((3 * n + 1) * sizeof *unit);
    size_t i, k;
    int found;
    if (!unit) return CROSSINGS_NO_MEMORY;
    for (i = 0; i < n; ++i) {
        double length = 0;
        for (k = 0; k < 3; ++k) length += corner[3 * i + k] * corner[3 * i + k];
        length = sqrt(length);
        for (k = 0; k < 3; ++k) /* corners on the unit sphere stay as they are, and keep their small differences */
            unit[3 * i + k] = fabs(length - 1) <= 4 * DBL_EPSILON ? corner[3 * i + k] : corner[3 * i + k] / length;
    }
    o.corner = unit;
    o.n = n;
    o.stride = 3;
    found = n < 4 ? 0 : crossings__find(&o, pair);
    free(unit);
    return found;
}

/* The direction of the mean of the unit normals: 2 if all of them are within 60 degrees of it; 1 if they cancel less
   than normals do that lie on a cone of 60 degrees about it; else 0. */
static inline int crossings__mean_normal(const double *normal, size_t n, double mean[3])
{
    double length, cosine = 0.5;
    size_t i, k;
    mean[0] = mean[1] = mean[2] = 0;
    for (i = 0; i < n; ++i) {
        const double *m = normal + 3 * i;
        length = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
        for (k = 0; k < 3 && length > 0; ++k) mean[k] += m[k] / length;
    }
    length = sqrt(mean[0] * mean[0] + mean[1] * mean[1] + mean[2] * mean[2]);
    if (!(length > cosine * (double)n)) return 0;
    for (k = 0; k < 3; ++k) mean[k] /= length;
    for (i = 0; i < n; ++i) {
        const double *m = normal + 3 * i;
        double size = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
        if (!(m[0] * mean[0] + m[1] * mean[1] + m[2] * mean[2] >= cosine * size)) return 1;
    }
    return 2;
}

/* The direction along which most of the area is seen; 0 if there is none. */
static inline int crossings__area_vector(const double *corner, size_t n, double area[3])
{
    double a[3], b[3], length;
    size_t i, k;
    area[0] = area[1] = area[2] = 0;
    for (i = 1; i + 1 < n; ++i) {
        for (k = 0; k < 3; ++k) a[k] = corner[3 * i + k] - corner[k], b[k] = corner[3 * i + 3 + k] - corner[k];
        for (k = 0; k < 3; ++k) area[k] += a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    }
    length = sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    for (k = 0; k < 3 && length > 0; ++k) area[k] /= length;
    return length > 0;
}

/* Outlines of chords with normals at their corners, 3 each. If a normal is more than 60 degrees from the mean of all,
   nothing is certain: CROSSINGS_SEEN, with the pair, if edges cross as seen along the mean or, where the normals nearly
   cancel, along the area vector; else CROSSINGS_UNKNOWN. */
static inline int crossings_embedded(const double *corner, const double *normal, size_t n, size_t pair[2])
{
    double view[3], across[3] = {0, 0, 0}, up[3], *flat;
    size_t i, k, least = 0;
    int found, agree = normal ? crossings__mean_normal(normal, n, view) : 0;
    if (!agree && !crossings__area_vector(corner, n, view)) return CROSSINGS_UNKNOWN;
    for (k = 1; k < 3; ++k)
        if (fabs(view[k]) < fabs(view[least])) least = k;
    across[least] = 1;
    for (k = 0; k < 3; ++k) across[k] -= (k == least ? view[least] : 0) * view[least];
    for (k = 0; k < 3; ++k)
        if (k != least) across[k] = -view[least] * view[k];
    up[0] = view[1] * across[2] - view[2] * across[1];
    up[1] = view[2] * across[0] - view[0] * across[2];
    up[2] = view[0] * across[1] - view[1] * across[0];
    flat = (double *)malloc((2 * n + 1) * sizeof *flat);
    if (!flat) return CROSSINGS_NO_MEMORY;
    for (i = 0; i < n; ++i) {
        double d[3];
        for (k = 0; k < 3; ++k) d[k] = corner[3 * i + k] - corner[k];
        flat[2 * i] = d[0] * across[0] + d[1] * across[1] + d[2] * across[2];
        flat[2 * i + 1] = d[0] * up[0] + d[1] * up[1] + d[2] * up[2];
    }
    found = crossings_plane(flat, n, pair);
    free(flat);
    if (agree == 2 || found < 0) return found;
    return found ? CROSSINGS_SEEN : CROSSINGS_UNKNOWN;
}

#endif
