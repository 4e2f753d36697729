/* shapes.h - what the tests measure: random polygons, surfaces, smooth curves. Include it after surfmink.h.

   Random shapes are biased to corners of the input space: nearly straight corners, tiny edges, deep dents and needles.
   Every theorem seeds its own generator, so it finds the same shapes wherever and in whatever order it runs. */
#ifndef SHAPES_H
#define SHAPES_H

#include "chance.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define PI   3.14159265358979323846
#define MOST 64 /* corners of a random polygon, at most */

static inline double power_of_two(int exponent)
{
    return ldexp(1.0, exponent);
}

/* --- polygons ----------------------------------------------------------------------------------------------------- */

/* A counter-clockwise polygon that is star-shaped about the origin, so it never crosses itself; size about 1. */
static inline void random_star(chance *c, size_t n, double *xy)
{
    double gap[MOST], angle, sum, widest, depth = between(c, 0, 1);
    size_t i;
    do {
        for (sum = 0, i = 0; i < n; ++i) sum += gap[i] = one_of(c, 8) ? between(c, 0.05, 1) : 1e-7; /* a tiny edge */
        for (widest = 0, i = 0; i < n; ++i) {
            gap[i] *= 2 * PI / sum;
            if (gap[i] > widest) widest = gap[i];
        }
    } while (widest > 0.9 * PI);
    for (angle = between(c, 0, 2 * PI), i = 0; i < n; angle += gap[i++]) {
        double r = 1 - depth * between(c, 0, 0.9);
        if (one_of(c, 16) == 0) r = 0.02; /* a deep dent, and needles on both sides of it */
        xy[2 * i] = r * cos(angle);
        xy[2 * i + 1] = r * sin(angle);
    }
    for (i = 1; i + 1 < n; ++i) /* nearly straight corners, on either side, where the neighbours' angle allows it */
        if (one_of(c, 5) == 0 && gap[i - 1] + gap[i] < 0.9 * PI) {
            double bulge = 1 + between(c, -1e-9, 1e-9), *x = xy + 2 * i;
            if (!(x[-2] * x[3] - x[-1] * x[2] > 0)) continue;
            x[0] = (x[-2] + x[2]) / 2 * bulge;
            x[1] = (x[-1] + x[3]) / 2 * bulge;
        }
}

/* One without extremes, for surfaces where straight lines of the chart are not edges: there a needle might cross
   itself. */
static inline void gentle_star(chance *c, size_t n, double *xy)
{
    double gap[MOST], angle, sum = 0, r;
    size_t i;
    for (i = 0; i < n; ++i) sum += gap[i] = between(c, 0.6, 1);
    for (angle = between(c, 0, 2 * PI), i = 0; i < n; angle += 2 * PI * gap[i++] / sum) {
        r = between(c, 0.6, 1);
        xy[2 * i] = r * cos(angle);
        xy[2 * i + 1] = r * sin(angle);
    }
}

/* A gentle star of 3 to 22 corners in whole numbers up to 1000, so that it can be laid elsewhere without rounding. */
static inline size_t whole_star(chance *c, double *xy)
{
    size_t n, i;
    int apart;
    do {
        n = 3 + one_of(c, 20);
        gentle_star(c, n, xy);
        for (i = 0; i < 2 * n; ++i) xy[i] = floor(xy[i] * 1000);
        for (apart = 1, i = 0; i < n; ++i)
            if (hypot(xy[2 * i] - xy[2 * ((i + 1) % n)], xy[2 * i + 1] - xy[2 * ((i + 1) % n) + 1]) < 2) apart = 0;
    } while (!apart);
    return n;
}

/* The central projection to the sphere about the pole: straight edges become great circles, so a simple polygon about
   the origin stays simple, counter-clockwise and within a hemisphere. size = 1 covers half of that. */
static inline void onto_sphere(const double *xy, size_t n, double size, double *xyz)
{
    size_t i;
    for (i = 0; i < n; ++i) {
        double x = size * xy[2 * i], y = size * xy[2 * i + 1], norm = sqrt(x * x + y * y + 1);
        xyz[3 * i] = x / norm;
        xyz[3 * i + 1] = y / norm;
        xyz[3 * i + 2] = 1 / norm;
    }
}

static inline double dot3(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross3(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void turn_about(const double axis[3], double angle, double *xyz, size_t n)
{
    double s = sin(angle), c = cos(angle), norm = sqrt(dot3(axis, axis)), k[3], kx[3];
    size_t i, j;
    for (j = 0; j < 3; ++j) k[j] = axis[j] / norm;
    for (i = 0; i < n; ++i) {
        double *x = xyz + 3 * i, along = dot3(k, x);
        cross3(k, x, kx);
        for (j = 0; j < 3; ++j) x[j] = c * x[j] + s * kx[j] + (1 - c) * along * k[j];
    }
}

static inline void turn_somehow(chance *c, double *xyz, size_t n)
{
    double axis[3];
    axis[0] = between(c, -1, 1);
    axis[1] = between(c, -1, 1);
    axis[2] = between(c, 0.1, 1);
    turn_about(axis, between(c, 0, 2 * PI), xyz, n);
}

/* The same polygon that starts at corner k. */
static inline void start_at(size_t k, const double *corner, size_t n, size_t stride, double *relabelled)
{
    memcpy(relabelled, corner + k * stride, (n - k) * stride * sizeof *corner);
    memcpy(relabelled + (n - k) * stride, corner, k * stride * sizeof *corner);
}

/* A tangent vector, carried along an outline into another array; if that fails, not even the copy may have changed. */
static inline int carry(const surfmink_outline *outline, const double *turning, size_t from, ptrdiff_t steps,
                        int transport, const double *vector, double *carried)
{
    size_t size = (outline->kind == SURFMINK_PLANE ? 2 : 3) * sizeof *vector;
    double moved[3];
    int status;
    memcpy(moved, vector, size);
    status = surfmink_transport_vector(outline, turning, from, steps, transport, moved);
    if (status != SURFMINK_OK && memcmp(moved, vector, size) != 0) return -1;
    if (status == SURFMINK_OK) memcpy(carried, moved, size);
    return status;
}

/* --- surfaces in space, as charts (u, v) -------------------------------------------------------------------------- */

typedef struct chart {
    enum { ELLIPSOID, TORUS } kind;
    double a, b,
        c; /* ellipsoid: semi-axes, u = polar angle, v = longitude; torus: a + b cos v from the axis, u = longitude */
} chart;

/* Point, outer normal (not unit) and, unless NULL, the two tangents. */
static inline void chart_point(const chart *m, double u, double v, double x[3], double normal[3], double du[3],
                               double dv[3])
{
    double su = sin(u), cu = cos(u), sv = sin(v), cv = cos(v), tangent_u[3], tangent_v[3];
    if (m->kind == ELLIPSOID) {
        x[0] = m->a * su * cv, x[1] = m->b * su * sv, x[2] = m->c * cu;
        tangent_u[0] = m->a * cu * cv, tangent_u[1] = m->b * cu * sv, tangent_u[2] = -m->c * su;
        tangent_v[0] = -m->a * su * sv, tangent_v[1] = m->b * su * cv, tangent_v[2] = 0;
        normal[0] = x[0] / (m->a * m->a), normal[1] = x[1] / (m->b * m->b), normal[2] = x[2] / (m->c * m->c);
    } else {
        double r = m->a + m->b * cv;
        x[0] = r * cu, x[1] = r * su, x[2] = m->b * sv;
        tangent_u[0] = -r * su, tangent_u[1] = r * cu, tangent_u[2] = 0;
        tangent_v[0] = -m->b * sv * cu, tangent_v[1] = -m->b * sv * su, tangent_v[2] = m->b * cv;
        normal[0] = cv * cu, normal[1] = cv * su, normal[2] = sv;
    }
    if (du) memcpy(du, tangent_u, sizeof tangent_u);
    if (dv) memcpy(dv, tangent_v, sizeof tangent_v);
}

/* A gentle star laid on a surface: round the point (u, v) of its chart, counter-clockwise about the outer normal. */
static inline void star_on_chart(chance *c, const chart *m, double u, double v, double size, size_t n, double *xyz,
                                 double *normal)
{
    double xy[2 * MOST];
    size_t i;
    gentle_star(c, n, xy);
    for (i = 0; i < n; ++i)
        chart_point(m, u + size * xy[2 * i], v + size * xy[2 * i + 1], xyz + 3 * i, normal + 3 * i, NULL, NULL);
}

/* --- surfaces by callbacks ---------------------------------------------------------------------------------------- */

/* The hyperbolic plane (K = -1) in the Poincare disk, where it has closed forms: the isometry w = (y - x)/(1 - x* y)
   takes x to 0 and turns nothing there, and from 0 geodesics are rays of length 2 atanh |w|. */
static inline int hyperbolic_log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    double a = y[0] - x[0], b = y[1] - x[1];
    double c = 1 - x[0] * y[0] - x[1] * y[1], d = x[1] * y[0] - x[0] * y[1];
    double size = sqrt((a * a + b * b) / (c * c + d * d));
    (void)context;
    if (!(size > 0)) return SURFMINK_COINCIDENT_CORNERS;
    direction[0] = a * c + b * d; /* (a + ib)(c - id), which need not be unit */
    direction[1] = b * c - a * d;
    *length = 2 * atanh(size);
    return SURFMINK_OK;
}

static inline int hyperbolic_exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    double t = tanh(length / 2), w = t * direction[0], v = t * direction[1];
    double a = w + x[0], b = v + x[1]; /* (w + x)/(1 + x* w) */
    double c = 1 + x[0] * w + x[1] * v, d = x[0] * v - x[1] * w;
    (void)context;
    y[0] = (a * c + b * d) / (c * c + d * d);
    y[1] = (b * c - a * d) / (c * c + d * d);
    return SURFMINK_OK;
}

static inline surfmink_surface hyperbolic_plane(void)
{
    surfmink_surface s;
    s.context = NULL;
    s.stride = 2;
    s.log = hyperbolic_log;
    s.exp = hyperbolic_exp;
    return s;
}

/* Area of a hyperbolic polygon, a fan about corner 0: a triangle 0, a, b of the disk has tan(A/2) = Im(a* b)/(1 -
   Re(a* b)). */
static inline double hyperbolic_area(const double *corner, size_t n)
{
    double area = 0;
    size_t i;
    int k;
    for (i = 1; i + 1 < n; ++i) {
        double w[2][2];
        for (k = 0; k < 2; ++k) {
            double length, norm;
            if (hyperbolic_log(NULL, corner, corner + 2 * (i + (size_t)k), &length, w[k]) != SURFMINK_OK)
                return nan("");
            norm = sqrt(w[k][0] * w[k][0] + w[k][1] * w[k][1]);
            w[k][0] *= tanh(length / 2) / norm;
            w[k][1] *= tanh(length / 2) / norm;
        }
        area += 2 * atan2(w[0][0] * w[1][1] - w[0][1] * w[1][0], 1 - (w[0][0] * w[1][0] + w[0][1] * w[1][1]));
    }
    return area;
}

/* The plane with a frame that spins from point to point and a log whose direction is not unit: turning angles must
   not notice. */
static inline double spin_at(const double *x)
{
    return 7 * x[0] - 11 * x[1] + 1;
}

static inline int spinning_log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    double a = y[0] - x[0], b = y[1] - x[1], s = sin(spin_at(x)), c = cos(spin_at(x));
    (void)context;
    *length = sqrt(a * a + b * b);
    if (!(*length > 0)) return SURFMINK_COINCIDENT_CORNERS;
    direction[0] = 3 * (c * a + s * b);
    direction[1] = 3 * (c * b - s * a);
    return SURFMINK_OK;
}

static inline int spinning_exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    double s = sin(spin_at(x)), c = cos(spin_at(x));
    double a = x[0] + length * (c * direction[0] - s * direction[1]);
    double b = x[1] + length * (s * direction[0] + c * direction[1]);
    (void)context;
    y[0] = a;
    y[1] = b;
    return SURFMINK_OK;
}

static inline surfmink_surface spinning_plane(void)
{
    surfmink_surface s;
    s.context = NULL;
    s.stride = 2;
    s.log = spinning_log;
    s.exp = spinning_exp;
    return s;
}

/* --- smooth curves: the flowers of the paper ---------------------------------------------------------------------- */

typedef struct flower {
    chart surface;
    double u0, v0, r0, a;
    int petals; /* r = r0 - a sin(petals t) about (u0, v0) of the chart */
} flower;

static inline void flower_point(const flower *f, double t, double x[3], double normal[3], double *speed)
{
    double r = f->r0 - f->a * sin(f->petals * t), dr = -f->a * f->petals * cos(f->petals * t);
    double u = dr * cos(t) - r * sin(t), v = dr * sin(t) + r * cos(t), du[3], dv[3], tangent[3];
    int k;
    chart_point(&f->surface, f->u0 + r * cos(t), f->v0 + r * sin(t), x, normal, du, dv);
    for (k = 0; k < 3; ++k) tangent[k] = u * du[k] + v * dv[k];
    if (speed) *speed = sqrt(dot3(tangent, tangent));
}

/* Arc length from t to t + h, by Gauss's rule of 5 points. */
static inline double flower_arc(const flower *f, double t, double h)
{
    static const double node[3] = {0, 0.53846931010568309104, 0.90617984593866399280};
    static const double weight[3] = {0.56888888888888888889, 0.47862867049936646804, 0.23692688505618908751};
    double sum = 0, speed, x[3], normal[3];
    int k;
    for (k = -2; k <= 2; ++k) {
        int j = k < 0 ? -k : k;
        flower_point(f, t + h / 2 * (1 + (k < 0 ? -node[j] : node[j])), x, normal, &speed);
        sum += weight[j] * speed;
    }
    return sum * h / 2;
}

#define FLOWER_PANELS 512

typedef struct flower_ruler {
    flower curve;
    double arc[FLOWER_PANELS + 1]; /* arc length at t = 2 pi k / FLOWER_PANELS */
} flower_ruler;

static inline void flower_measure(const flower *f, flower_ruler *ruler)
{
    int k;
    ruler->curve = *f;
    ruler->arc[0] = 0;
    for (k = 0; k < FLOWER_PANELS; ++k)
        ruler->arc[k + 1] = ruler->arc[k] + flower_arc(f, 2 * PI * k / FLOWER_PANELS, 2 * PI / FLOWER_PANELS);
}

/* The point at a fraction of the arc length, counted from t = 0 and modulo 1, with its normal. */
static inline void flower_at(const flower_ruler *ruler, double fraction, double x[3], double normal[3])
{
    double whole = ruler->arc[FLOWER_PANELS], s = (fraction - floor(fraction)) * whole, t, start, speed;
    int low = 0, high = FLOWER_PANELS, k;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (ruler->arc[middle] <= s)
            low = middle;
        else
            high = middle;
    }
    start = 2 * PI * low / FLOWER_PANELS;
    for (t = start, k = 0; k < 4; ++k) {
        flower_point(&ruler->curve, t, x, normal, &speed);
        t += (s - ruler->arc[low] - flower_arc(&ruler->curve, start, t - start)) / speed;
    }
    flower_point(&ruler->curve, t, x, normal, NULL);
}

/* --- smooth curves by chance -------------------------------------------------------------------------------------- */

/* r(t) round a point of the plane or of a chart: four harmonics, and t uneven. */
typedef struct wobble {
    int plane;
    chart surface;
    double u, v, size, cosine[5], sine[5], skew, start;
} wobble;

enum { IN_THE_PLANE, ON_A_SPHERE, ON_AN_ELLIPSOID, ON_A_TORUS, WHERE };

static inline wobble some_wobble(chance *c, int where)
{
    wobble w;
    int k;
    memset(&w, 0, sizeof w);
    w.plane = where == IN_THE_PLANE;
    w.surface.kind = where == ON_A_TORUS ? TORUS : ELLIPSOID;
    w.surface.a = where == ON_A_TORUS ? 2 : where == ON_AN_ELLIPSOID ? 1.6 : 1;
    w.surface.b = where == ON_A_TORUS ? 0.8 : where == ON_AN_ELLIPSOID ? 1.3 : 1;
    w.surface.c = 1;
    w.u = where == ON_A_TORUS ? between(c, 0, 2 * PI) : 1.5;
    w.v = where == ON_A_TORUS ? between(c, 0, 2 * PI) : 0.7;
    w.size = between(c, 0.2, 0.6);
    for (k = 1; k <= 4; ++k) {
        w.cosine[k] = between(c, -0.12, 0.12) / k;
        w.sine[k] = between(c, -0.12, 0.12) / k;
    }
    w.skew = between(c, -0.4, 0.4);
    w.start = between(c, 0, 2 * PI);
    return w;
}

/* n points of it, and the normals there unless it lies in the plane. */
static inline void wobble_points(const wobble *w, size_t n, double *corner, double *normal)
{
    size_t i;
    int k;
    for (i = 0; i < n; ++i) {
        double s = 2 * PI * (double)i / (double)n, t = s + w->skew * sin(s + w->start), r = w->size, x, y;
        for (k = 1; k <= 4; ++k) r += w->size * (w->cosine[k] * cos(k * t) + w->sine[k] * sin(k * t));
        x = r * cos(t);
        y = r * sin(t);
        if (w->plane)
            corner[2 * i] = x, corner[2 * i + 1] = y;
        else
            chart_point(&w->surface, w->u + x, w->v + y, corner + 3 * i, normal + 3 * i, NULL, NULL);
    }
}

#endif
