/* accuracy.c - how wrong can surfmink be? Worst errors over random polygons, against quadruple precision.

     cc -O2 -I. tests/accuracy/accuracy.c -o accuracy -lquadmath -lm     (gcc: __float128)
     ./accuracy --polygons 100000                                        a table for each surface, the worst witness
     ./accuracy --repeat sphere/needle 12345                             one polygon again, all its figures

   Each polygon is measured by a single call, which the steps agree with to the bit; on the sphere through callbacks;
   and as a batch by every instance of the kernels that this machine can run: what stands beside an outline in a batch
   does not change its results, so batches of one do. What the kernels leave to the scalar path is judged there alone.
   A way that measured nothing fails. The table of generators shows the worst of all.

   The reference below shares nothing with surfmink.h: it knows directions of edges as angles in a frame of the tangent
   plane and turns as their differences, areas on the sphere through stereographic projection. Corners are doubles and
   taken as exact; polygons that surfmink refuses are counted, not judged.

   Turns are rounded, and 1 / S multiplies that: so S is judged relative to c, mu and the angles against 1 + c + c^2 /
   10, with c = (sum |alpha| + |2 pi - S|) / S; through callbacks against 1 + c^2 + sqrt(n) / 10; S through callbacks,
   which is the sum of their rounded turns, relative to c + sqrt(n) / 50. Areas are judged against how much their
   triangles cancel. The exit status is 1 if one of the limits in `quantity` is exceeded. */
#define SURFMINK_STATIC
#define SURFMINK_DISPATCH /* all instances in one program */
#include "surfmink.h"

#if !defined(__SIZEOF_FLOAT128__) || (defined(__has_include) && !__has_include(<quadmath.h>))
#error "accuracy.c needs quadruple precision: gcc with libquadmath, for instance on x86-64 or ppc64le"
#endif
#include <math.h>
#include <quadmath.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../chance.h"
#include "../instances.h"

typedef __float128 quad;

enum { MAX_RANK = 12, MAX_CORNERS = 100000 };

enum surface { PLANE, SPHERE, EMBEDDED, SURFACES };
static const char *const surface_name[SURFACES] = {"plane", "sphere", "embedded"};

enum { LENGTH, TURNING, MU, ANGLE, AREA, QUANTITIES };

/* What surfmink.h promises, checked here: claim and check cannot drift apart. */
static const struct {
    const char *name, *meaning;
    double limit;
} quantity[QUANTITIES] = {
    {"L", "relative", 1e-15},
    {"S", "relative, against c", 2e-15},
    {"mu", "p <= 12, against 1 + c + c^2 / 10", 1e-14},
    {"angle", "mu_p |p theta_p - reference|, p <= 12, against 1 + c + c^2 / 10", 1e-14},
    {"area", "against half the sum of |x_i - x_0| l_i", 2e-15},
};

/* --- chance ------------------------------------------------------------------------------------------------------- */

static chance luck; /* a polygon is known by its generator and its seed */

/* Mostly few corners, for there every way to be degenerate is likely; sometimes very many. */
static size_t corner_count(void)
{
    if (one_in(&luck, 4000)) return (size_t)magnitude(&luck, 1e4, MAX_CORNERS);
    if (one_in(&luck, 200)) return (size_t)magnitude(&luck, 1e3, 1e4);
    if (one_in(&luck, 10)) return (size_t)magnitude(&luck, 30, 1e3);
    return (size_t)magnitude(&luck, 3, 30);
}

/* --- outlines of about unit size, in a flat map ------------------------------------------------------------------- */

static double shape[2 * MAX_CORNERS];

static void put(size_t i, double distance, double angle)
{
    shape[2 * i] = distance * cos(angle);
    shape[2 * i + 1] = distance * sin(angle);
}

/* Round with noise of any size, down to none. */
static size_t draw_round(size_t n)
{
    double noise = magnitude(&luck, 1e-17, 0.5), stretch = magnitude(&luck, 0.05, 1), start = between(&luck, 0, 6.3);
    size_t i;
    for (i = 0; i < n; ++i) {
        put(i, 1 + noise * between(&luck, -1, 1), start + 2 * M_PI * (double)i / (double)n);
        shape[2 * i] *= stretch;
    }
    return n;
}

/* On a circle, the gaps of all magnitudes: tiny edges beside long ones, almost straight. */
static size_t draw_uneven(size_t n)
{
    static double gap[MAX_CORNERS];
    double smallest = magnitude(&luck, 1e-14, 1), total = 0, angle = 0;
    size_t i;
    for (i = 0; i < n; ++i) total += gap[i] = magnitude(&luck, smallest, 1);
    for (i = 0; i < n; ++i) {
        put(i, 1, angle);
        angle += 2 * M_PI * gap[i] / total;
    }
    return n;
}

/* Spikes: the distance from the centre jumps from corner to corner. */
static size_t draw_star(size_t n)
{
    double inner = magnitude(&luck, 1e-12, 1), angle;
    int random = one_in(&luck, 2);
    size_t i;
    for (i = 0; i < n; ++i) {
        angle = 2 * M_PI * ((double)i + between(&luck, 0, 0.5)) / (double)n;
        put(i, random ? magnitude(&luck, inner, 1) : i % 2 ? inner : 1, angle);
    }
    return n;
}

/* Two chains of corners from one end to the other, a hair apart: needles, slivers, hairpins. */
static size_t draw_needle(size_t n)
{
    double width = magnitude(&luck, 1e-14, 0.3), start = between(&luck, 0, 6.3), x, y;
    size_t i, there = 1 + (size_t)between(&luck, 0, (double)(n - 2)), back = n - there;
    for (i = 0; i < n; ++i) {
        x = i < there ? (double)i / (double)there : 1 - (double)(i - there) / (double)back;
        y = i < there ? -width * x * (1 - x) : width * (x * (1 - x) + 0.1);
        shape[2 * i] = x * cos(start) - y * sin(start);
        shape[2 * i + 1] = x * sin(start) + y * cos(start);
    }
    return n;
}

/* A polygon of few corners whose sides are cut unevenly: what lies on a side is straight up to rounding. */
static size_t draw_sides(size_t n)
{
    size_t sides = 3 + (size_t)between(&luck, 0, 4), i, k, next, m = 0;
    double start = between(&luck, 0, 6.3), cut, angle[2];
    if (n < 2 * sides) n = 2 * sides;
    for (i = 0; i < sides; ++i) {
        angle[0] = start + 2 * M_PI * (double)i / (double)sides;
        angle[1] = start + 2 * M_PI * (double)(i + 1) / (double)sides;
        next = n * (i + 1) / sides;
        for (k = n * i / sides; k < next; ++k, ++m) {
            cut = (double)(k - n * i / sides) / (double)(next - n * i / sides);
            cut = cut > 0 ? cut * cut * cut : 0;
            shape[2 * m] = (1 - cut) * cos(angle[0]) + cut * cos(angle[1]);
            shape[2 * m + 1] = (1 - cut) * sin(angle[0]) + cut * sin(angle[1]);
        }
    }
    return m;
}

/* A disc of pixels: corners on a lattice, some pixels long, some short. */
static size_t draw_pixels(size_t n)
{
    double r = (double)n / 8 + 1;
    size_t m = 0;
    long x, y = (long)r, side, last;
    long corner[2];
    for (side = 0; side < 4; ++side) { /* a quarter of the outline, four times turned */
        for (x = 0, y = (long)r; y > 0 && m + 2 < MAX_CORNERS; --y) {
            last = x;
            while ((double)((x + 1) * (x + 1) + (y - 1) * (y - 1)) <= r * r) ++x;
            if (x == last) continue;
            for (int end = 0; end < 2; ++end, ++m) {
                corner[0] = end ? x : last;
                corner[1] = y;
                for (long turn = 0; turn < side; ++turn) {
                    long kept = corner[0];
                    corner[0] = corner[1];
                    corner[1] = -kept;
                }
                shape[2 * m] = (double)corner[0] / r;
                shape[2 * m + 1] = (double)corner[1] / r;
            }
        }
    }
    surfmink_reverse(shape, m, 2);
    return m;
}

/* A coast: midpoints pushed aside again and again. */
static size_t draw_coast(size_t n)
{
    double roughness = between(&luck, 0.02, 0.6);
    size_t sides = 3 + (size_t)between(&luck, 0, 3), m = sides, i;
    draw_round(sides);
    while (2 * m <= n) {
        for (i = m; i-- > 0;) {
            double ax = shape[2 * i], ay = shape[2 * i + 1];
            double bx = i + 1 < m ? shape[4 * i + 4] : shape[0], by = i + 1 < m ? shape[4 * i + 5] : shape[1];
            double push = roughness * between(&luck, -0.5, 0.5);
            shape[4 * i + 2] = (ax + bx) / 2 - push * (by - ay);
            shape[4 * i + 3] = (ay + by) / 2 + push * (bx - ax);
            shape[4 * i] = ax;
            shape[4 * i + 1] = ay;
        }
        m *= 2;
    }
    return m;
}

/* A band wound up: turns a lot in both directions. */
static size_t draw_spiral(size_t n)
{
    double windings = between(&luck, 0.5, 20), t, r;
    size_t half = n / 2 + 2, i;
    for (i = 0; i < half; ++i) {
        t = (double)i / (double)(half - 1);
        r = 0.1 + 0.9 * t;
        put(i, r, 2 * M_PI * windings * t);
        put(2 * half - 1 - i, r * (1 - 0.3 / (1 + 10 * windings)), 2 * M_PI * windings * t);
    }
    return 2 * half;
}

/* Corners anywhere: of triangles half are well drawn, of larger ones those that do not cross are rare. */
static size_t draw_any(size_t n)
{
    size_t i;
    n = 3 + n % 3;
    for (i = 0; i < n; ++i) {
        shape[2 * i] = one_in(&luck, 4) ? signed_magnitude(&luck, 1e-15, 1) : between(&luck, -1, 1);
        shape[2 * i + 1] = one_in(&luck, 4) ? signed_magnitude(&luck, 1e-15, 1) : between(&luck, -1, 1);
    }
    return n;
}

static const struct {
    const char *name;
    size_t (*draw)(size_t n);
} generator[] = {{"round", draw_round},   {"uneven", draw_uneven}, {"star", draw_star},
                 {"needle", draw_needle}, {"sides", draw_sides},   {"pixels", draw_pixels},
                 {"coast", draw_coast},   {"spiral", draw_spiral}, {"any", draw_any}};
enum { GENERATORS = sizeof generator / sizeof *generator };

/* --- and how they lie on a surface -------------------------------------------------------------------------------- */

typedef struct polygon {
    enum surface surface;
    size_t n;
    double size, radius;
    double corner[3 * MAX_CORNERS], normal[3 * MAX_CORNERS];
} polygon;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* A random rotation: three orthonormal vectors. */
static void random_frame(double frame[3][3])
{
    double part;
    int i, j, k;
    for (i = 0; i < 3; ++i) {
        for (k = 0; k < 3; ++k) frame[i][k] = between(&luck, -1, 1);
        for (j = 0; j < i; ++j)
            for (part = dot(frame[i], frame[j]), k = 0; k < 3; ++k) frame[i][k] -= part * frame[j][k];
        for (part = sqrt(dot(frame[i], frame[i])), k = 0; k < 3; ++k) frame[i][k] /= part;
    }
    part = frame[0][0] * (frame[1][1] * frame[2][2] - frame[1][2] * frame[2][1]) -
           frame[0][1] * (frame[1][0] * frame[2][2] - frame[1][2] * frame[2][0]) +
           frame[0][2] * (frame[1][0] * frame[2][1] - frame[1][1] * frame[2][0]);
    if (part < 0)
        for (k = 0; k < 3; ++k) frame[2][k] = -frame[2][k];
}

static void place_on_plane(polygon *o)
{
    double unit = one_in(&luck, 10) ? magnitude(&luck, 1e-290, 1e290) : 1, x = 0, y = 0;
    size_t i;
    if (one_in(&luck, 2)) { /* far away: corners keep the few digits that they have there */
        x = signed_magnitude(&luck, 1e-3, 1e12) * o->size;
        y = signed_magnitude(&luck, 1e-3, 1e12) * o->size;
    }
    for (i = 0; i < o->n; ++i) {
        o->corner[2 * i] = (x + o->size * shape[2 * i]) * unit;
        o->corner[2 * i + 1] = (y + o->size * shape[2 * i + 1]) * unit;
    }
}

static void place_on_sphere(polygon *o)
{
    double frame[3][3], unit = one_in(&luck, 10) ? magnitude(&luck, 1e-290, 1e290) : 1,
                        off = one_in(&luck, 2) ? magnitude(&luck, 1e-16, 0.9) : 0;
    size_t i;
    int k;
    random_frame(frame);
    o->radius = one_in(&luck, 4) ? magnitude(&luck, 1e-100, 1e100) : 1;
    if (one_in(&luck, 20))
        o->size = M_PI / 2 - magnitude(&luck, 1e-12, 1); /* nearly a great circle: curvature near 2 pi */
    for (i = 0; i < o->n; ++i) {
        double u = shape[2 * i], v = shape[2 * i + 1], r = hypot(u, v), angle = o->size * r;
        double along = r > 0 ? sin(angle) / r : 0, height = unit * (1 + off * between(&luck, -1, 1));
        for (k = 0; k < 3; ++k)
            o->corner[3 * i + (size_t)k] =
                height * (cos(angle) * frame[2][k] + along * (u * frame[0][k] + v * frame[1][k]));
    }
    if (one_in(&luck, 20)) { /* two neighbours almost opposite */
        double gap = magnitude(&luck, 1e-15, 1e-1);
        for (k = 0; k < 3; ++k)
            o->corner[3 + k] = -o->corner[k] * between(&luck, 1, 1 + off) + unit * gap * frame[0][k];
    }
}

/* Points and normals of a quadric z = (a u^2 + b v^2) / 2 over the map: bowl, saddle, ridge or plane; then noise on the
   normals, steep edges, any magnitude. */
static void place_in_space(polygon *o)
{
    double frame[3][3], local[3], normal[3], unit = one_in(&luck, 10) ? magnitude(&luck, 1e-290, 1e290) : 1;
    double a = one_in(&luck, 3) ? 0 : between(&luck, -2, 1), b = one_in(&luck, 3) ? a : between(&luck, -2, 1), far = 0;
    double tilt = one_in(&luck, 2) ? 0 : magnitude(&luck, 1e-16, 1), stretch = one_in(&luck, 4) ? 1e100 : 1, scale;
    int cap = one_in(&luck, 6);
    size_t i;
    int k;
    random_frame(frame);
    if (one_in(&luck, 3)) far = signed_magnitude(&luck, 1e-3, 1e12) * o->size;
    if (cap && one_in(&luck, 2)) o->size = M_PI / 2 - magnitude(&luck, 1e-12, 1);
    for (i = 0; i < o->n; ++i) {
        double u = o->size * shape[2 * i], v = o->size * shape[2 * i + 1], r = hypot(u, v);
        if (cap) { /* the unit sphere, measured with chords */
            local[0] = r > 0 ? sin(r) * u / r : 0;
            local[1] = r > 0 ? sin(r) * v / r : 0;
            local[2] = cos(r);
            for (k = 0; k < 3; ++k) normal[k] = local[k];
        } else {
            local[0] = u;
            local[1] = v;
            local[2] = (a * u * u + b * v * v) / 2;
            normal[0] = -a * u;
            normal[1] = -b * v;
            normal[2] = 1;
        }
        for (k = 0; k < 3; ++k) normal[k] += tilt * between(&luck, -1, 1);
        local[0] += far;
        scale = magnitude(&luck, 1 / stretch, stretch);
        for (k = 0; k < 3; ++k) {
            o->corner[3 * i + (size_t)k] =
                unit * (local[0] * frame[0][k] + local[1] * frame[1][k] + local[2] * frame[2][k]);
            o->normal[3 * i + (size_t)k] =
                scale * (normal[0] * frame[0][k] + normal[1] * frame[1][k] + normal[2] * frame[2][k]);
        }
    }
    if (one_in(&luck, 6)) { /* a normal almost along an edge, up to where it is refused */
        double slope = magnitude(&luck, 1e-6, 1), edge[3], longest;
        for (k = 0; k < 3; ++k) edge[k] = (o->corner[3 + k] - o->corner[k]) / unit;
        longest = sqrt(dot(edge, edge));
        for (k = 0; k < 3; ++k) o->normal[k] = edge[k] / longest + slope * frame[2][k];
    }
}

static void make_polygon(polygon *o, enum surface surface, int which, uint64_t seed)
{
    luck.state = seed;
    o->surface = surface;
    o->size = magnitude(&luck, 1e-12, 1.5);
    o->radius = 1;
    o->n = generator[which].draw(corner_count());
    if (surface == PLANE) place_on_plane(o);
    if (surface == SPHERE) place_on_sphere(o);
    if (surface == EMBEDDED) place_in_space(o);
}

/* --- the reference, in quadruple precision ------------------------------------------------------------------------ */

typedef struct measured {
    quad length, turning, turned, area, area_terms;
    quad mu[MAX_RANK + 1], angle[MAX_RANK + 1];
    int spike;   /* a turn of -pi up to rounding, which is to count as +pi */
    int crosses; /* S and area contradict each other: the area is not defined */
} measured;

static quad edge_length[MAX_CORNERS], edge_turn[MAX_CORNERS];

static quad q_dot(const quad *a, const quad *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void q_difference(const double *a, const double *b, quad c[3])
{
    int k;
    for (k = 0; k < 3; ++k) c[k] = (quad)a[k] - (quad)b[k];
}

static void q_unit(const double *v, quad unit[3])
{
    quad norm;
    int k;
    for (k = 0; k < 3; ++k) unit[k] = v[k];
    norm = sqrtq(q_dot(unit, unit));
    for (k = 0; k < 3; ++k) unit[k] /= norm;
}

/* Two vectors that complete a unit vector to a right-handed frame. */
static void q_frame(const quad n[3], quad e1[3], quad e2[3])
{
    quad norm;
    int k, far = fabsq(n[0]) < 0.6Q ? 0 : 1;
    for (k = 0; k < 3; ++k) e1[k] = (k == far) - n[far] * n[k];
    norm = sqrtq(q_dot(e1, e1));
    for (k = 0; k < 3; ++k) e1[k] /= norm;
    for (k = 0; k < 3; ++k) e2[k] = n[(k + 1) % 3] * e1[(k + 2) % 3] - n[(k + 2) % 3] * e1[(k + 1) % 3];
}

static quad q_wrap(quad angle)
{
    while (angle > M_PIq) angle -= 2 * M_PIq;
    while (angle <= -M_PIq) angle += 2 * M_PIq;
    return angle;
}

/* Turn at a corner with unit normal n, as a difference of two directions in the tangent plane. */
static quad q_turn(const quad in[3], const quad out[3], const quad n[3])
{
    quad e1[3], e2[3];
    q_frame(n, e1, e2);
    return q_wrap(atan2q(q_dot(out, e2), q_dot(out, e1)) - atan2q(q_dot(in, e2), q_dot(in, e1)));
}

static void refer_plane(const polygon *o, measured *m)
{
    quad before, here, x, y, ax, ay;
    const double *c = o->corner;
    size_t i, n = o->n;
    x = (quad)c[0] - (quad)c[2 * n - 2];
    y = (quad)c[1] - (quad)c[2 * n - 1];
    before = atan2q(y, x);
    for (i = 0; i < n; ++i, before = here) {
        const double *next = i + 1 < n ? c + 2 * i + 2 : c;
        x = (quad)next[0] - (quad)c[2 * i];
        y = (quad)next[1] - (quad)c[2 * i + 1];
        edge_length[i] = hypotq(x, y);
        here = atan2q(y, x);
        edge_turn[i] = q_wrap(here - before);
        ax = (quad)c[2 * i] - (quad)c[0];
        ay = (quad)c[2 * i + 1] - (quad)c[1];
        m->area += (ax * y - ay * x) / 2;
        m->area_terms += hypotq(ax, ay) * hypotq(x, y) / 2;
    }
}

static void refer_embedded(const polygon *o)
{
    quad in[3], out[3], normal[3];
    const double *c = o->corner;
    size_t i, n = o->n;
    q_difference(c, c + 3 * (n - 1), in);
    for (i = 0; i < n; ++i) {
        q_difference(i + 1 < n ? c + 3 * i + 3 : c, c + 3 * i, out);
        q_unit(o->normal + 3 * i, normal);
        edge_length[i] = sqrtq(q_dot(out, out));
        edge_turn[i] = q_turn(in, out, normal);
        memcpy(in, out, sizeof in);
    }
}

/* The direction of the edge from corner x to y, unit vectors beside them, at one of the two: the tangent part of the
   chord. That of the corners as they are is exact; but where they stand at different distances from the centre it is
   lost in the difference, and unit vectors are better. */
static void q_chord(const double *x, const quad x_unit[3], const double *y, const quad y_unit[3], quad chord[3])
{
    quad along;
    int k;
    q_difference(y, x, chord);
    along = q_dot(chord, x_unit);
    if (2 * along * along <= q_dot(chord, chord)) return;
    for (k = 0; k < 3; ++k) chord[k] = y_unit[k] - x_unit[k];
}

/* Stereographic map of the sphere from the point opposite to corner 0: the triangle of corner 0 with the images z and w
   of two others has the area 2 arg(1 + conj(z) w). */
static void refer_sphere(const polygon *o, measured *m)
{
    quad e1[3], e2[3], first[3], before[3], here[3], next[3], in[3], out[3], sum[3], z[2] = {0, 0}, w[2];
    const double *c = o->corner;
    size_t i, n = o->n;
    int k;
    q_unit(c + 3 * (n - 1), before);
    q_unit(c, here);
    memcpy(first, here, sizeof first);
    q_frame(first, e1, e2);
    for (i = 0; i < n; ++i) {
        q_unit(i + 1 < n ? c + 3 * i + 3 : c, next);
        for (k = 0; k < 3; ++k) {
            out[k] = next[k] - here[k];
            sum[k] = next[k] + here[k];
        }
        edge_length[i] = 2 * atan2q(sqrtq(q_dot(out, out)), sqrtq(q_dot(sum, sum)));
        q_chord(c + 3 * (i > 0 ? i - 1 : n - 1), before, c + 3 * i, here, in);
        q_chord(c + 3 * i, here, i + 1 < n ? c + 3 * i + 3 : c, next, out);
        edge_turn[i] = q_turn(in, out, here);
        for (k = 0; k < 3; ++k) sum[k] = next[k] - first[k];
        w[0] = q_dot(sum, e1) / (1 + q_dot(next, first));
        w[1] = q_dot(sum, e2) / (1 + q_dot(next, first));
        m->area += 2 * atan2q(z[0] * w[1] - z[1] * w[0], 1 + z[0] * w[0] + z[1] * w[1]);
        m->area_terms += 2 * sqrtq(z[0] * z[0] + z[1] * z[1]) * edge_length[i] / 2;
        memcpy(z, w, sizeof z);
        memcpy(before, here, sizeof before);
        memcpy(here, next, sizeof here);
    }
}

static void refer(const polygon *o, measured *m)
{
    quad phase = 0, g_re[MAX_RANK + 1] = {0}, g_im[MAX_RANK + 1] = {0}, re, im, c, s, t;
    size_t i;
    int p;
    memset(m, 0, sizeof *m);
    if (o->surface == PLANE) refer_plane(o, m);
    if (o->surface == SPHERE) refer_sphere(o, m);
    if (o->surface == EMBEDDED) refer_embedded(o);
    for (i = 0; i < o->n; ++i) {
        if (edge_turn[i] < -M_PIq + 1e-14Q) m->spike = 1;
        m->length += edge_length[i];
        m->turning += edge_turn[i];
        m->turned += fabsq(edge_turn[i]);
    }
    for (i = 0; i < o->n; ++i) {
        if (i > 0) phase += edge_turn[i];
        sincosq(2 * M_PIq / m->turning * phase, &s, &c);
        for (re = edge_length[i], im = 0, p = 0; p <= MAX_RANK; ++p) {
            g_re[p] += re;
            g_im[p] += im;
            t = re * c - im * s;
            im = re * s + im * c;
            re = t;
        }
    }
    for (p = 0; p <= MAX_RANK; ++p) {
        m->mu[p] = hypotq(g_re[p], g_im[p]) / m->length;
        m->angle[p] = atan2q(g_im[p], g_re[p]);
    }
    if (o->surface != SPHERE) return;
    m->length *= o->radius;
    m->area += 4 * M_PIq * rintq((2 * M_PIq - m->turning - m->area) / (4 * M_PIq)); /* the fan knows it modulo 4 pi */
    m->crosses = fabsq(2 * M_PIq - m->turning - m->area) > 1;
    m->area *= (quad)o->radius * o->radius;
    m->area_terms *= (quad)o->radius * o->radius;
}

/* --- the comparison ----------------------------------------------------------------------------------------------- */

enum { CALLBACKS = INSTANCES, WAYS = INSTANCES + 1 };
enum { SPIKE = -1, LEFT = -2 }; /* not judged: see measured.spike; the kernels leave it to the single call */

typedef struct verdict {
    int status;
    double condition, error[QUANTITIES], judged[QUANTITIES]; /* as it is; against its limit's measure */
} verdict;

/* A NaN is the worst of all. */
static int is_worse(double error, double than)
{
    return than == than && !(error <= than);
}

static double worse(double a, double b)
{
    return is_worse(b, a) ? b : a;
}

static surfmink_outline view(const polygon *o)
{
    if (o->surface == PLANE) return surfmink_plane(o->corner, o->n);
    if (o->surface == SPHERE) return surfmink_sphere(o->corner, o->n, o->radius);
    return surfmink_embedded(o->corner, o->normal, o->n);
}

static int measure_single(const surfmink_outline *outline, double *mu, double *theta, surfmink_functionals *w)
{
    double g[2 * MAX_RANK + 2];
    int status = surfmink_measure(outline, MAX_RANK, mu, g, w, NULL);
    if (status == SURFMINK_OK) surfmink_spectrum(g, MAX_RANK, NULL, NULL, theta);
    return status;
}

static int measure(int way, const polygon *o, double *mu, double *theta, surfmink_functionals *w)
{
    surfmink_outline outline = view(o);
    double radius = o->radius;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    size_t offset[2] = {0, o->n}, refused;
    unsigned char left;
    surfmink_results out = {NULL, NULL, &w->length, &w->turning, &w->area, mu, NULL, theta};
    surfmink__job job = job_of(&outline, offset, MAX_RANK, &out, NULL);
    if (way == CALLBACKS) {
        outline = surfmink_on_surface(&sphere, o->corner, o->n);
        return measure_single(&outline, mu, theta, w);
    }
    if (!instance_of[way].window) return measure_single(&outline, mu, theta, w);
    refused = instance_of[way].window(&job, 0, 1, &left);
    return left ? LEFT : refused > 0 ? SURFMINK_CLOCKWISE : SURFMINK_OK;
}

static const char *way_name(int way)
{
    return way == CALLBACKS ? "calls" : instance_of[way].name;
}

static int can_take(int way, enum surface surface)
{
    if (way == SCALAR) return 0; /* that is the public call */
    return way == CALLBACKS ? surface == SPHERE : can_run(way);
}

static void compare(const polygon *o, const measured *m, const double *mu, const double *theta,
                    const surfmink_functionals *w, int way, verdict *v)
{
    int p, q;
    double c;
    v->condition = m->turned > m->turning ? (double)(m->turned / m->turning) : 1;
    c = (double)((m->turned + fabsq(2 * M_PIq - m->turning)) / m->turning);
    c = c > 1 ? c : 1;
    v->error[LENGTH] = v->judged[LENGTH] = (double)fabsq(w->length / m->length - 1);
    v->error[TURNING] = (double)fabsq(w->turning - m->turning);
    v->judged[TURNING] = v->error[TURNING] / (double)m->turning / (way == CALLBACKS ? c + sqrt((double)o->n) / 50 : c);
    if (o->surface != EMBEDDED && way != CALLBACKS && !m->crosses && m->area_terms > 1e-280Q &&
        m->area_terms < 1e300Q) { /* else it has no double */
        v->error[AREA] = (double)fabsq(w->area / m->area - 1);
        v->judged[AREA] = (double)(fabsq(w->area - m->area) / m->area_terms);
    }
    for (p = 0; p <= MAX_RANK; ++p) {
        v->error[MU] = worse(v->error[MU], (double)fabsq(mu[p] - m->mu[p]));
        v->error[ANGLE] =
            worse(v->error[ANGLE], (double)(m->mu[p] * fabsq(remainderq(p * (quad)theta[p] - m->angle[p], 2 * M_PIq))));
    }
    for (q = MU; q <= ANGLE; ++q)
        v->judged[q] = v->error[q] / (way == CALLBACKS ? 1 + c * c + sqrt((double)o->n) / 10 : 1 + c + c * c / 10);
}

static void show_results(const measured *m, const double *mu, const double *theta, const surfmink_functionals *w)
{
    int p;
    for (p = 0; p <= MAX_RANK; ++p)
        printf("mu_%-2d  %.17g  want %.17g\np theta %.17g  want %.17g\n", p, mu[p], (double)m->mu[p], p * theta[p],
               (double)m->angle[p]);
    printf("L      %.17g  want %.17g\nS      %.17g  want %.17g\narea   %.17g  want %.17g\n", w->length,
           (double)m->length, w->turning, (double)m->turning, w->area, (double)m->area);
}

/* A verdict on each way to measure a polygon. */
static void judge(const polygon *o, verdict v[WAYS], int show)
{
    static measured m;
    double mu[MAX_RANK + 1], theta[MAX_RANK + 1];
    surfmink_functionals w;
    int way, referred = 0;
    for (way = 0; way < WAYS; ++way) {
        memset(v + way, 0, sizeof *v);
        if (!can_take(way, o->surface)) continue;
        v[way].status = measure(way, o, mu, theta, &w);
        if (v[way].status != SURFMINK_OK) continue;
        if (!referred++) refer(o, &m);
        if (show) printf("%s\n", way_name(way));
        if (show) show_results(&m, mu, theta, &w);
        if (m.spike)
            v[way].status = SPIKE;
        else
            compare(o, &m, mu, theta, &w, way, v + way);
    }
}

typedef struct worst {
    double error, judged, condition, size;
    uint64_t seed;
    size_t n;
    int generator;
} worst;

static void keep_worst(worst *w, const verdict *v, int q, const polygon *o, int which, uint64_t seed)
{
    if (!is_worse(v->judged[q], w->judged)) return;
    w->judged = v->judged[q];
    w->error = v->error[q];
    w->condition = v->condition;
    w->size = o->size;
    w->seed = seed;
    w->n = o->n;
    w->generator = which;
}

static int survey(polygon *o, enum surface surface, uint64_t polygons, uint64_t master)
{
    static worst all[GENERATORS][QUANTITIES];
    worst top[WAYS][QUANTITIES];
    uint64_t measured_by[WAYS] = {0}, refused = 0, spikes = 0, otherwise = 0, k, seed;
    verdict v[WAYS];
    int q, i, way, failed = 0;
    memset(all, 0, sizeof all);
    memset(top, 0, sizeof top);
    for (k = 0; k < polygons; ++k) {
        luck.state = master + k * SURFACES + (uint64_t)surface;
        seed = chance_bits(&luck) >> 16; /* short enough to be typed */
        i = (int)(k % GENERATORS);
        make_polygon(o, surface, i, seed);
        judge(o, v, 0);
        refused += v[0].status > 0;
        spikes += v[0].status == SPIKE;
        for (way = 0; way < WAYS; ++way) {
            if (!can_take(way, o->surface)) continue;
            measured_by[way] += v[way].status == SURFMINK_OK;
            if (way != CALLBACKS && v[way].status != LEFT && v[way].status != v[0].status && !otherwise++)
                printf("%s takes what the single call refuses: --repeat %s/%s %lu  ABOVE ITS LIMIT\n", way_name(way),
                       surface_name[surface], generator[i].name, (unsigned long)seed);
            for (q = 0; v[way].status == SURFMINK_OK && q < QUANTITIES; ++q) {
                keep_worst(&all[i][q], v + way, q, o, i, seed);
                keep_worst(&top[way][q], v + way, q, o, i, seed);
            }
        }
    }
    printf("%s: %lu polygons measured, %lu refused, %lu with a turn of -pi up to rounding left out\n",
           surface_name[surface], (unsigned long)measured_by[0], (unsigned long)refused, (unsigned long)spikes);
    printf("measured by:");
    for (way = 1; way < WAYS; ++way)
        if (can_take(way, surface)) printf(" %s %lu", way_name(way), (unsigned long)measured_by[way]);
    printf("; %lu refused by the single call\n", (unsigned long)otherwise);
    for (way = 0; way < WAYS; ++way) {
        if (!can_take(way, surface) || measured_by[way] > polygons / 10) continue;
        printf("%s measured next to nothing  ABOVE ITS LIMIT\n", way_name(way));
        ++failed;
    }
    for (q = 0; q < QUANTITIES; ++q) printf("%10s", quantity[q].name);
    printf("\n");
    for (i = 0; i < GENERATORS; ++i) {
        for (q = 0; q < QUANTITIES; ++q) printf("%10.1e", all[i][q].judged);
        printf("  %s\n", generator[i].name);
    }
    for (q = 0; q < QUANTITIES; ++q) {
        if (surface == EMBEDDED && q == AREA) continue;
        printf("%s (%s), limit %.2g\n", quantity[q].name, quantity[q].meaning, quantity[q].limit);
        for (way = 0; way < WAYS; ++way) {
            const worst *w = &top[way][q];
            int above = !(w->judged <= quantity[q].limit);
            if (!can_take(way, o->surface)) continue;
            printf("  %-6s %.2g (as it is %.2g, condition %.2g): --repeat %s/%s %lu, n %lu, size %.2g%s\n",
                   way_name(way), w->judged, w->error, w->condition, surface_name[surface],
                   generator[w->generator].name, (unsigned long)w->seed, (unsigned long)w->n, w->size,
                   above ? "  ABOVE ITS LIMIT" : "");
            failed += above;
        }
    }
    printf("\n");
    return failed + (otherwise > 0);
}

static int repeat(polygon *o, const char *name, uint64_t seed)
{
    char full[100];
    verdict v[WAYS];
    int surface, i, q, way;
    for (surface = 0; surface < SURFACES; ++surface)
        for (i = 0; i < (int)GENERATORS; ++i) {
            snprintf(full, sizeof full, "%s/%s", surface_name[surface], generator[i].name);
            if (strcmp(full, name) != 0) continue;
            make_polygon(o, (enum surface)surface, i, seed);
            judge(o, v, 1);
            printf("n %lu, size %.3g\n", (unsigned long)o->n, o->size);
            for (way = 0; way < WAYS; ++way) {
                if (!can_take(way, o->surface)) continue;
                if (v[way].status == LEFT) printf("%s leaves it to the single call\n", way_name(way));
                if (v[way].status == LEFT) continue;
                printf("%s: status %d, condition %.3g\n", way_name(way), v[way].status, v[way].condition);
                for (q = 0; q < QUANTITIES; ++q)
                    printf("error of %-6s %.3g, judged %.3g\n", quantity[q].name, v[way].error[q], v[way].judged[q]);
            }
            for (size_t k = 0; k < o->n && k < 20; ++k) {
                printf("l %-24.17g alpha %-24.17g", (double)edge_length[k], (double)edge_turn[k]);
                for (i = 0; i < (surface == PLANE ? 2 : 3); ++i)
                    printf(" %a", o->corner[(surface == PLANE ? 2 : 3) * k + (size_t)i]);
                for (i = 0; surface == EMBEDDED && i < 3; ++i) printf(" %a", o->normal[3 * k + (size_t)i]);
                printf("\n");
            }
            return 0;
        }
    fprintf(stderr, "accuracy: no generator %s; there are {plane,sphere,embedded}/{", name);
    for (i = 0; i < (int)GENERATORS; ++i) fprintf(stderr, "%s%s", i ? "," : "", generator[i].name);
    fprintf(stderr, "}\n");
    return 2;
}

int main(int argc, char **argv)
{
    static polygon o;
    uint64_t polygons = 10000, seed = 1;
    int surface, failed = 0, only = -1, i;
    for (i = 1; i < argc; ++i) {
        int left = argc - i - 1;
        if (!strcmp(argv[i], "--polygons") && left >= 1)
            polygons = strtoull(argv[++i], NULL, 10);
        else if (!strcmp(argv[i], "--seed") && left >= 1)
            seed = strtoull(argv[++i], NULL, 10);
        else if (!strcmp(argv[i], "--repeat") && left >= 2)
            return repeat(&o, argv[i + 1], strtoull(argv[i + 2], NULL, 10));
        else if (!strcmp(argv[i], "plane"))
            only = PLANE;
        else if (!strcmp(argv[i], "sphere"))
            only = SPHERE;
        else if (!strcmp(argv[i], "embedded"))
            only = EMBEDDED;
        else {
            fprintf(stderr, "usage: accuracy [--polygons N] [--seed S] [plane|sphere|embedded] "
                            "[--repeat SURFACE/GENERATOR SEED]\n");
            return 2;
        }
    }
    for (surface = 0; surface < SURFACES; ++surface)
        if (only < 0 || only == surface) failed += survey(&o, (enum surface)surface, polygons, seed * 1000003);
    printf("%d figures above their limits\n", failed);
    return failed != 0;
}
