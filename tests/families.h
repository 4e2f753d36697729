/* families.h - outlines by chance, of every shape that breaks things and any number of corners, laid on the plane, the
   sphere and surfaces in space. Include it after shapes.h.

   A shape is drawn in a flat map, about as large as the unit circle, and then placed. Not all can be measured: some
   cross themselves, some enclose too much. */
#ifndef FAMILIES_H
#define FAMILIES_H

#include "shapes.h"

static inline double far_apart(const double *x, const double *y)
{
    double d[3];
    d[0] = x[0] - y[0], d[1] = x[1] - y[1], d[2] = x[2] - y[2];
    return sqrt(dot3(d, d));
}

enum { LONGEST = 5000 };

static double shape[2 * LONGEST];

static inline void put(size_t i, double distance_, double angle)
{
    shape[2 * i] = distance_ * cos(angle);
    shape[2 * i + 1] = distance_ * sin(angle);
}

/* Round with noise of any size, down to none. */
static inline size_t draw_round(chance *c, size_t n)
{
    double noise = magnitude(c, 1e-17, 0.5), stretch = magnitude(c, 0.05, 1), start = between(c, 0, 6.3);
    size_t i;
    for (i = 0; i < n; ++i) {
        put(i, 1 + noise * between(c, -1, 1), start + 2 * PI * (double)i / (double)n);
        shape[2 * i] *= stretch;
    }
    return n;
}

/* On a circle, with gaps of all magnitudes: tiny edges beside long ones. */
static inline size_t draw_uneven(chance *c, size_t n)
{
    static double gap[LONGEST];
    double smallest = magnitude(c, 1e-12, 1), total = 0, angle = 0;
    size_t i;
    for (i = 0; i < n; ++i) total += gap[i] = magnitude(c, smallest, 1);
    for (i = 0; i < n; angle += 2 * PI * gap[i++] / total) put(i, 1, angle);
    return n;
}

/* Dents and needles: the distance from the centre jumps from corner to corner. */
static inline size_t draw_star(chance *c, size_t n)
{
    double inner = magnitude(c, 1e-9, 1);
    size_t i;
    for (i = 0; i < n; ++i)
        put(i, i % 2 ? magnitude(c, inner, 1) : 1, 2 * PI * ((double)i + between(c, 0, 0.5)) / (double)n);
    return n;
}

/* Two chains of corners from one end to the other, a hair apart. */
static inline size_t draw_needle(chance *c, size_t n)
{
    double width = magnitude(c, 1e-14, 0.3), start = between(c, 0, 6.3);
    size_t i, there = 1 + one_of(c, n - 1), back = n - there;
    for (i = 0; i < n; ++i) {
        double x = i < there ? (double)i / (double)there : 1 - (double)(i - there) / (double)back;
        double y = i < there ? -width * x * (1 - x) : width * (x * (1 - x) + 0.1);
        shape[2 * i] = x * cos(start) - y * sin(start);
        shape[2 * i + 1] = x * sin(start) + y * cos(start);
    }
    return n;
}

/* Few sides, cut unevenly: what lies on a side is straight up to rounding. */
static inline size_t draw_sides(chance *c, size_t n)
{
    size_t sides = n < 8 ? 3 : 3 + one_of(c, 4), side, i;
    double start = between(c, 0, 6.3), angle[2];
    for (i = 0; i < n; ++i) {
        size_t first, next;
        double cut;
        for (side = 0; n * (side + 1) / sides <= i; ++side) continue;
        first = n * side / sides, next = n * (side + 1) / sides;
        cut = (double)(i - first) / (double)(next - first);
        cut = cut * cut;
        angle[0] = start + 2 * PI * (double)side / (double)sides;
        angle[1] = start + 2 * PI * (double)(side + 1) / (double)sides;
        shape[2 * i] = (1 - cut) * cos(angle[0]) + cut * cos(angle[1]);
        shape[2 * i + 1] = (1 - cut) * sin(angle[0]) + cut * sin(angle[1]);
    }
    return n;
}

/* A band wound up: turns a lot in both directions. */
static inline size_t draw_spiral(chance *c, size_t n)
{
    double windings = between(c, 0.5, 6);
    size_t half = n / 2 + 2, i;
    for (i = 0; i < half; ++i) {
        double t = (double)i / (double)(half - 1), r = 0.1 + 0.9 * t;
        put(i, r, 2 * PI * windings * t);
        put(2 * half - 1 - i, r * (1 - 0.3 / (1 + 10 * windings)), 2 * PI * windings * t);
    }
    return 2 * half;
}

/* Corners anywhere: half of the triangles are well drawn; of those with more corners many cross themselves. */
static inline size_t draw_any(chance *c, size_t n)
{
    size_t i;
    n = 3 + n % 3;
    for (i = 0; i < 2 * n; ++i) shape[i] = one_in(c, 4) ? magnitude(c, 1e-15, 1) - 0.3 : between(c, -1, 1);
    return n;
}

static inline size_t draw_eight(chance *c, size_t n)
{
    size_t i;
    n = 4 + 2 * (n / 2);
    for (i = 0; i < n; ++i) {
        double t = 2 * PI * ((double)i + 0.5) / (double)n;
        shape[2 * i] = sin(t);
        shape[2 * i + 1] = sin(2 * t) * between(c, 0.9, 1);
    }
    return n;
}

static size_t (*const drawing[])(chance *c, size_t n) = {draw_round, draw_round,  draw_uneven, draw_star, draw_needle,
                                                         draw_sides, draw_spiral, draw_any,    draw_eight};
static const char *const drawing_name[] = {"round", "round",  "uneven", "star", "needle",
                                           "sides", "spiral", "any",    "eight"};
enum { DRAWINGS = sizeof drawing / sizeof *drawing };

/* --- and how they lie on a surface -------------------------------------------------------------------------------- */

static inline void place_on_plane(chance *c, size_t n, double *xy)
{
    double unit = one_in(c, 10) ? magnitude(c, 1e-200, 1e200) : magnitude(c, 1e-9, 1e3), x = 0, y = 0;
    size_t i;
    if (one_in(c, 3)) { /* far off: corners keep the few digits that they have there */
        x = magnitude(c, 1, 1e8) * between(c, -1, 1);
        y = magnitude(c, 1, 1e8) * between(c, -1, 1);
    }
    for (i = 0; i < n; ++i) {
        xy[2 * i] = unit * (x + shape[2 * i]);
        xy[2 * i + 1] = unit * (y + shape[2 * i + 1]);
    }
}

/* By distance and direction from the pole; on the equator all distances are the same. */
static inline void wrap(size_t n, double size, int equator, double *xyz)
{
    size_t i;
    for (i = 0; i < n; ++i) {
        double u = shape[2 * i], v = shape[2 * i + 1], h = hypot(u, v), r = equator ? PI / 2 : size * h;
        double along = h > 0 ? sin(r) / h : 0;
        xyz[3 * i] = along * u;
        xyz[3 * i + 1] = along * v;
        xyz[3 * i + 2] = cos(r);
    }
}

/* From 1e-9 to hemispheres; exact ones about the pole, others anywhere; on the sphere or a little off. */
static inline void place_on_sphere(chance *c, size_t n, double *xyz)
{
    double size = one_in(c, 12) ? PI / 2 - magnitude(c, 1e-9, 1) : magnitude(c, 1e-9, 1.2);
    double unit = one_in(c, 10) ? magnitude(c, 1e-200, 1e200) : 1, off = one_in(c, 2) ? magnitude(c, 1e-12, 1e-3) : 0;
    size_t i, k;
    if (one_in(c, 40)) off = 0.9;
    if (one_in(c, 4))
        onto_sphere(shape, n, size, xyz);
    else
        wrap(n, size, one_in(c, 40), xyz);
    if (!one_in(c, 4)) turn_somehow(c, xyz, n);
    for (i = 0; i < n; ++i) {
        double height = unit * (1 + off * between(c, -1, 1));
        for (k = 0; k < 3; ++k) xyz[3 * i + k] *= height;
    }
}

/* z = h sin ku cos kv: steep where h k is large. */
static inline void wave_point(double h, double k, double u, double v, double x[3], double normal[3])
{
    x[0] = u, x[1] = v, x[2] = h * sin(k * u) * cos(k * v);
    normal[0] = -h * k * cos(k * u) * cos(k * v);
    normal[1] = h * k * sin(k * u) * sin(k * v);
    normal[2] = 1;
}

/* Ellipsoid, torus, waves or a plane in space. */
static inline void lay_out(chance *c, size_t n, double size, double *xyz, double *normal)
{
    static const chart chart_of[2] = {{ELLIPSOID, 1.6, 1.3, 1}, {TORUS, 2, 0.8, 0}};
    double u = between(c, 1, 2), v = between(c, 0, 6.3), h = between(c, -0.5, 0.5), k = between(c, 0, 6);
    size_t which = one_of(c, 5), i;
    for (i = 0; i < n; ++i) {
        double a = size * shape[2 * i], b = size * shape[2 * i + 1];
        if (which < 2)
            chart_point(&chart_of[which], u + a, v + b, xyz + 3 * i, normal + 3 * i, NULL, NULL);
        else
            wave_point(which == 4 ? 0 : h, k, (which == 2 ? u : 0) + a, (which == 2 ? v : 0) + b, xyz + 3 * i,
                       normal + 3 * i);
    }
}

/* One normal almost along the edge that leaves its corner, up to where it is refused. */
static inline void make_steep(chance *c, size_t n, const double *xyz, double *normal)
{
    size_t i = one_of(c, n), k, next = (i + 1) % n;
    double edge = far_apart(xyz + 3 * i, xyz + 3 * next), norm = sqrt(dot3(normal + 3 * i, normal + 3 * i));
    double slope = magnitude(c, 1e-7, 3);
    for (k = 0; k < 3 && edge > 0; ++k)
        normal[3 * i + k] = (xyz[3 * next + k] - xyz[3 * i + k]) / edge + slope * normal[3 * i + k] / norm;
}

static inline void place_in_space(chance *c, size_t n, double *xyz, double *normal)
{
    double size = one_in(c, 12) ? between(c, 0.5, 1.5) : magnitude(c, 1e-9, 0.5), far_off = 0;
    double unit = one_in(c, 10) ? magnitude(c, 1e-200, 1e200) : 1, spread = one_in(c, 2) ? magnitude(c, 1, 1e3) : 1;
    double stretch = one_in(c, 20) ? (one_in(c, 2) ? 1e-150 : 1e150) : 1;
    size_t i, k;
    chance twin;
    if (one_in(c, 40)) { /* a great circle */
        wrap(n, 1, 1, xyz);
        memcpy(normal, xyz, 3 * n * sizeof *xyz);
    } else
        lay_out(c, n, size, xyz, normal);
    twin = *c;
    turn_somehow(c, xyz, n);
    turn_somehow(&twin, normal, n);
    if (one_in(c, 5)) far_off = size * magnitude(c, 1, 1e8);
    if (one_in(c, 8)) make_steep(c, n, xyz, normal);
    for (i = 0; i < n; ++i) {
        double scale = stretch * magnitude(c, 1 / spread, spread);
        for (k = 0; k < 3; ++k) {
            xyz[3 * i + k] = unit * (xyz[3 * i + k] + far_off);
            normal[3 * i + k] *= scale;
        }
    }
}

/* --- an outline of any family, on any surface, for any way to measure --------------------------------------------- */

enum lies { ON_PLANE, ON_SPHERES, ON_SURFACES, BY_CALLBACKS, IN_HYPERBOLIC_PLANE, ON_CALLED_SPHERE, LIES };
static const char *const lies_name[LIES] = {"plane",           "sphere",           "in space",
                                            "plane, by calls", "hyperbolic plane", "sphere, by calls"};

typedef struct drawn {
    enum lies lies;
    size_t family;
    surfmink_outline view;
    surfmink_surface surface;
    double radius, corner[3 * LONGEST], normal[3 * LONGEST];
} drawn;

/* One more outline of about n corners. It stays where it is: its view points into it. */
static inline void draw_outline(chance *c, enum lies lies, size_t n, drawn *d)
{
    size_t i;
    d->lies = lies;
    d->family = one_of(c, DRAWINGS);
    d->radius = 1;
    n = drawing[d->family](c, n);
    switch (lies) {
    case ON_PLANE:
        place_on_plane(c, n, d->corner);
        d->view = surfmink_plane(d->corner, n);
        return;
    case ON_SURFACES:
        place_in_space(c, n, d->corner, d->normal);
        d->view = surfmink_embedded(d->corner, d->normal, n);
        return;
    case ON_SPHERES:
    case ON_CALLED_SPHERE:
        place_on_sphere(c, n, d->corner);
        d->radius = one_in(c, 3) ? magnitude(c, 1e-50, 1e50) : 1;
        d->surface = surfmink_sphere_surface(&d->radius);
        d->view = surfmink_sphere(d->corner, n, d->radius);
        if (lies == ON_CALLED_SPHERE) d->view = surfmink_on_surface(&d->surface, d->corner, n);
        return;
    default:
        d->surface = lies == BY_CALLBACKS ? spinning_plane() : hyperbolic_plane();
        for (i = 0; i < 2 * n; ++i) d->corner[i] = 0.8 * shape[i]; /* the hyperbolic plane is the unit disk */
        d->view = surfmink_on_surface(&d->surface, d->corner, n);
    }
}

#endif
