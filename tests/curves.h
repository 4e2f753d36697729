/* curves.h - do estimates of errors hold? Random smooth curves on all surfaces, and what curve.h says of them. Include
   it after surfmink.h.

   Two sets of families of curves. With the first one the rules of the estimate were found; the second one, drawn and
   cut into edges otherwise, was first looked at when the rules stood. */
#ifndef CURVES_H
#define CURVES_H

#include "../examples/beyond/curve.h"
#include "../examples/surfaces/ellipsoid.h"
#include "shapes.h"

#include <stdlib.h>

enum { FOUND_WITH, JUDGED_BY, SETS };
enum { CURVE_FINEST = 4096, CURVE_RANKS = 6 };

enum curve_place {
    PLACE_PLANE,
    PLACE_SPHERE,
    PLACE_SPHERE_CHORDS,
    PLACE_ELLIPSOID,
    PLACE_TORUS,
    PLACE_HYPERBOLIC,
    PLACE_SPHERE_CALLBACKS,
    PLACE_ELLIPSOID_CALLBACKS,
    PLACES
};
static const char *const place_name[PLACES] = {"plane",
                                               "sphere",
                                               "sphere, chords",
                                               "ellipsoid",
                                               "torus",
                                               "hyperbolic plane, callbacks",
                                               "sphere, callbacks",
                                               "ellipsoid, callbacks"};

typedef struct random_curve {
    int set, family, place, cut;
    double a[21], b[21]; /* of the family */
    double size, angle, u, v, skew, start;
} random_curve;

/* --- shapes of size 1 about the origin ---------------------------------------------------------------------------- */

static inline void curve_shape_found_with(const random_curve *c, double t, double *x, double *y)
{
    double r = 1;
    int k;
    if (c->family == 1) { /* an ellipse */
        *x = 1.3 * cos(t);
        *y = 1.3 * sin(t) / c->a[0];
        return;
    }
    if (c->family == 3) /* a dent or a bump */
        r += c->a[0] * exp(-(1 - cos(t - c->a[1])) / (c->a[2] * c->a[2]));
    else /* four harmonics, or ten that decay */
        for (k = 1; k <= 10; ++k) r += c->a[k] * cos(k * t) + c->b[k] * sin(k * t);
    *x = r * cos(t);
    *y = r * sin(t);
}

static inline void curve_shape_judged_by(const random_curve *c, double t, double *x, double *y)
{
    double r = 1, s = sin(2 * t), k = c->a[1];
    switch (c->family) {
    case 0: r = 1 - c->a[0] * sin(k * t); break;                                             /* a flower */
    case 1: r = pow(pow(cos(t), 2 * k) + pow(c->a[0] * sin(t), 2 * k), -1 / (2 * k)); break; /* a rounded box */
    case 2: r = sqrt(cos(2 * t) + sqrt(pow(c->a[0], 4) - s * s)) / sqrt(1 + c->a[0] * c->a[0]); break; /* Cassini */
    default: break;
    }
    *x = r * cos(t);
    *y = r * sin(t);
    if (c->family == 3) *y = c->a[0] * sin(t) * exp(c->a[1] * cos(t)); /* an egg */
    if (c->family == 4) {                                              /* a bean: z + a z^2 + b z^3 */
        *x += c->a[0] * cos(2 * t) + c->a[1] * cos(3 * t + c->a[2]);
        *y += c->a[0] * sin(2 * t) + c->a[1] * sin(3 * t + c->a[2]);
    }
}

static inline random_curve some_curve(chance *luck, int set, int place)
{
    random_curve c;
    int k;
    memset(&c, 0, sizeof c);
    c.set = set;
    c.place = place;
    c.family = (int)one_of(luck, set == FOUND_WITH ? 4 : 5);
    for (k = 1; k <= 10 && set == FOUND_WITH; ++k) {
        double most = c.family == 2 ? 0.25 * exp(-0.5 * k) : c.family == 0 && k <= 4 ? 0.12 / k : 0;
        c.a[k] = between(luck, -most, most);
        c.b[k] = between(luck, -most, most);
    }
    if (set == FOUND_WITH && c.family == 1) c.a[0] = between(luck, 1, 3.5);
    if (set == FOUND_WITH && c.family == 3) {
        c.a[0] = between(luck, -0.3, 0.4);
        c.a[1] = between(luck, 0, 2 * PI);
        c.a[2] = between(luck, 0.4, 1);
    }
    if (set == JUDGED_BY) {
        static const double low[5] = {0.1, 0.5, 1.08, 0.5, -0.25}, high[5] = {0.8, 1, 1.8, 1, 0.25};
        c.a[0] = between(luck, low[c.family], high[c.family]);
        c.a[1] = c.family < 2 ? 2 + (double)one_of(luck, c.family ? 2 : 5) : between(luck, -0.12, 0.12);
        c.a[2] = between(luck, 0, 2 * PI);
        if (c.family == 0) c.a[0] /= c.a[1];
    }
    c.size = between(luck, 0.15, 0.55);
    c.angle = between(luck, 0, 2 * PI);
    c.skew = between(luck, -0.4, 0.4);
    c.start = between(luck, 0, 2 * PI);
    c.u = place == PLACE_TORUS ? between(luck, 0, 2 * PI) : 1.5;
    c.v = place == PLACE_TORUS ? between(luck, 0, 2 * PI) : 0.7;
    c.cut = one_of(luck, 3) ? 0 : 1 + (int)one_of(luck, 2);
    return c;
}

/* --- on surfaces, cut into edges ---------------------------------------------------------------------------------- */

static inline void curve_at(const random_curve *c, double t, double *corner, double *normal)
{
    static const chart chart_of[SETS][3] = {{{ELLIPSOID, 1, 1, 1}, {ELLIPSOID, 1.6, 1.3, 1}, {TORUS, 2, 0.8, 0}},
                                            {{ELLIPSOID, 1, 1, 1}, {ELLIPSOID, 1, 1.5, 0.8}, {TORUS, 1.5, 0.7, 0}}};
    double x, y, a, b;
    if (c->set == FOUND_WITH)
        curve_shape_found_with(c, t, &x, &y);
    else
        curve_shape_judged_by(c, t, &x, &y);
    a = c->size * (cos(c->angle) * x - sin(c->angle) * y);
    b = c->size * (sin(c->angle) * x + cos(c->angle) * y);
    if (c->place == PLACE_PLANE || c->place == PLACE_HYPERBOLIC) {
        corner[0] = a * (c->place == PLACE_PLANE ? 1 : 0.7); /* all within the unit disk */
        corner[1] = b * (c->place == PLACE_PLANE ? 1 : 0.7);
    } else {
        int on_ellipsoid = c->place == PLACE_ELLIPSOID || c->place == PLACE_ELLIPSOID_CALLBACKS;
        int which = on_ellipsoid ? 1 : c->place == PLACE_TORUS ? 2 : 0;
        chart_point(&chart_of[c->set][which], c->u + a, c->v + b, corner, normal, NULL, NULL);
    }
}

/* n corners: smoothly graded, by chance, or alternating. */
static inline void curve_points(const random_curve *c, size_t n, chance *luck, double *corner, double *normal)
{
    size_t i, dim = c->place == PLACE_PLANE || c->place == PLACE_HYPERBOLIC ? 2 : 3;
    double off = c->set == FOUND_WITH ? 0.3 : 0.35, s;
    for (i = 0; i < n; ++i) {
        s = (double)i;
        if (c->cut == 1) s += between(luck, -off, off);
        if (c->cut == 2 && c->set == FOUND_WITH) s += i % 2 ? 0.25 : -0.25;
        if (c->cut == 2 && c->set == JUDGED_BY) s += i % 3 == 1 ? 0.3 : i % 3 == 2 ? -0.1 : 0;
        s *= 2 * PI / (double)n;
        s += c->set == FOUND_WITH ? c->skew * sin(s + c->start) : c->skew * sin(2 * s + c->start) / 2;
        curve_at(c, s, corner + dim * i, normal + 3 * i);
    }
}

static inline int curve_curvature(void *context, const double *x, double *curvature)
{
    return surfmink_implicit_curvature((const surfmink_implicit *)context, x, curvature);
}

static inline int curve_measure(const random_curve *c, size_t n, int order, double *corner, double *normal,
                                double *scratch, const surfmink_curve_results *out)
{
    static const double axis[SETS][3] = {{1.6, 1.3, 1}, {1, 1.5, 0.8}}, sphere[3] = {1, 1, 1};
    surfmink_implicit body = surfmink_ellipsoid(c->place == PLACE_ELLIPSOID_CALLBACKS ? axis[c->set] : sphere);
    surfmink_curve_options options = {0, NULL, 0, NULL};
    surfmink_surface surface = surfmink_implicit_surface(&body);
    double one = 1;
    surfmink_outline o = surfmink_embedded(corner, normal, n);
    options.order = order;
    if (c->place == PLACE_PLANE) o = surfmink_plane(corner, n);
    if (c->place == PLACE_SPHERE) o = surfmink_sphere(corner, n, 1);
    if (c->place == PLACE_HYPERBOLIC) {
        surface = hyperbolic_plane();
        options.curvature = -1;
    }
    if (c->place == PLACE_SPHERE_CALLBACKS) {
        surface = surfmink_sphere_surface(&one);
        options.curvature = 1;
    }
    if (c->place == PLACE_ELLIPSOID_CALLBACKS) options.curvature_at = curve_curvature;
    if (c->place >= PLACE_HYPERBOLIC) o = surfmink_on_surface(&surface, corner, n);
    return surfmink_curve(&o, &options, CURVE_RANKS, scratch, out, NULL);
}

/* --- how often do estimates hold? --------------------------------------------------------------------------------- */

enum { CORNER_RANGES = 5 };
static const size_t corner_range[CORNER_RANGES + 1] = {20, 34, 60, 120, 300, 1001};

/* Errors over estimates, of L and mu_1 .. mu_6. */
typedef struct estimates {
    size_t all, known, within, within_three, kept, room;
    double worst, *ratio;
} estimates;

static inline void estimate_keep(estimates *e, double ratio)
{
    if (e->kept == e->room) {
        e->room = 2 * e->room + 1000;
        e->ratio = (double *)realloc(e->ratio, e->room * sizeof *e->ratio);
        if (!e->ratio) abort();
    }
    e->ratio[e->kept++] = ratio;
}

static inline void estimate_counts(estimates *e, double off, double error)
{
    double ratio = off / error;
    ++e->all;
    if (!(error < SURFMINK_CURVE_UNKNOWN)) return;
    ++e->known;
    e->within += ratio <= 1;
    e->within_three += ratio <= 3;
    if (!(ratio <= e->worst)) e->worst = ratio;
    estimate_keep(e, ratio);
}

/* Of some ranges or surfaces together. */
static inline void estimate_add(estimates *sum, const estimates *e)
{
    size_t i;
    sum->all += e->all;
    sum->known += e->known;
    sum->within += e->within;
    sum->within_three += e->within_three;
    if (!(e->worst <= sum->worst)) sum->worst = e->worst;
    for (i = 0; i < e->kept; ++i) estimate_keep(sum, e->ratio[i]);
}

static inline int estimate_order(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Half of the errors are above so much of their estimates. */
static inline double estimate_median(estimates *e)
{
    qsort(e->ratio, e->kept, sizeof *e->ratio, estimate_order);
    return e->kept ? e->ratio[e->kept / 2] : 0;
}

/* Measures one curve in 2048 and 4096 corners of order 4, from which the truth follows to sixth order, and in 20 to
   1000 with estimates. Returns how many of these were refused. */
static inline int estimate_curve(chance *luck, int set, int place, estimates e[2][CORNER_RANGES])
{
    static double corner[3 * CURVE_FINEST], normal[3 * CURVE_FINEST],
        scratch[SURFMINK_CURVE_SCRATCH(CURVE_FINEST, CURVE_RANKS)];
    random_curve c = some_curve(luck, set, place), smooth = c;
    chance cut = {chance_bits(luck)};
    double truth[2][CURVE_RANKS + 1], mu[CURVE_RANKS + 1], error[CURVE_RANKS + 1], exact;
    size_t n = (size_t)magnitude(luck, (double)corner_range[0], (double)corner_range[CORNER_RANGES]), range = 0;
    surfmink_functionals w;
    surfmink_curve_results out = {NULL, NULL, NULL, NULL};
    int fine, order, p, refused = 0;
    out.mu = mu;
    out.w = &w;
    if (place == PLACE_ELLIPSOID_CALLBACKS) smooth.place = PLACE_ELLIPSOID; /* the same curve, and quicker */
    smooth.cut = 0;
    smooth.skew = 0;
    for (fine = 0; fine < 2; ++fine) {
        curve_points(&smooth, CURVE_FINEST / (size_t)(2 - fine), &cut, corner, normal);
        refused +=
            curve_measure(&smooth, CURVE_FINEST / (size_t)(2 - fine), 4, corner, normal, scratch, &out) != SURFMINK_OK;
        memcpy(truth[fine], mu, sizeof mu);
        truth[fine][0] = w.length;
    }
    out.error = error;
    curve_points(&c, n, &cut, corner, normal);
    while (range + 1 < CORNER_RANGES && n >= corner_range[range + 1]) ++range;
    for (order = 2; order <= 4 && !refused; order += 2) {
        if (curve_measure(&c, n, order, corner, normal, scratch, &out) != SURFMINK_OK) return 1;
        mu[0] = w.length;
        for (p = 0; p <= CURVE_RANKS; ++p) {
            if (p == 1 && place == PLACE_PLANE) continue; /* mu_1 is 0 there, and no news */
            exact = truth[1][p] + (truth[1][p] - truth[0][p]) / 15;
            estimate_counts(&e[order / 4][range], fabs(mu[p] - exact) / (p == 0 ? exact : 1), error[p]);
        }
    }
    return refused;
}

#endif
