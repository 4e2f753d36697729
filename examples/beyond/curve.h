/* curve.h - smooth closed curves through corners, for surfmink.h - MIT or public domain, as surfmink.h */
#ifndef SURFMINK_CURVE_H
#define SURFMINK_CURVE_H

#ifndef SURFMINK_H
#include "surfmink.h"
#endif
#include <math.h>
#include <string.h>

enum { SURFMINK_CURVE_UNLIKE_EDGES = 100 };

#define SURFMINK_CURVE_UNKNOWN 1.0

typedef struct surfmink_curve_options {
    int order;
    const unsigned char *sharp;
    double curvature;
    int (*curvature_at)(void *context, const double *x, double *curvature);
} surfmink_curve_options;

typedef struct surfmink_curve_results {
    double *mu;
    double *error;
    double *g;
    surfmink_functionals *w;
} surfmink_curve_results;

typedef struct surfmink_curve_measured {
    size_t n;
    const double *length, *turning;
    const double *bend, *twist;
    const double *curvature;
    const unsigned char *sharp;
} surfmink_curve_measured;

static const double surfmink_curve__two_pi = 6.28318530717958647693;

/* --- sums that keep what a double rounds off ---------------------------------------------------------------------- */

typedef struct surfmink_curve__sum {
    double high, low;
} surfmink_curve__sum;

static inline void surfmink_curve__add(surfmink_curve__sum *sum, double x)
{
    double total = sum->high + x, part = total - sum->high;
    sum->low += (sum->high - (total - part)) + (x - part);
    sum->high = total;
}

static inline double surfmink_curve__value(const surfmink_curve__sum *sum)
{
    return sum->high + sum->low;
}

/* w becomes w z. */
static inline void surfmink_curve__multiply(double w[2], const double z[2])
{
    double re = w[0] * z[0] - w[1] * z[1];
    w[1] = w[0] * z[1] + w[1] * z[0];
    w[0] = re;
}

/* w becomes w z^p. */
static inline void surfmink_curve__times_power(double w[2], const double z[2], int p)
{
    double power[2];
    power[0] = z[0];
    power[1] = z[1];
    for (; p > 0; p /= 2) {
        if (p % 2) surfmink_curve__multiply(w, power);
        surfmink_curve__multiply(power, power);
    }
}

static inline int surfmink_curve__blame(int status, size_t corner, size_t *bad)
{
    if (status != SURFMINK_OK && bad) *bad = corner;
    return status;
}

/* --- arcs: from the edges of the polygon to those of the curve ---------------------------------------------------- */

typedef struct surfmink_curve__arcs {
    size_t n, windings;
    double *arc, *turn, *swept;
    const double *bend, *twist;
    const double *curvature;
    double constant;
    const unsigned char *sharp;
    double unit, measure;
    double power, sharpest;
    double whole, total, turned, rise;
    double segments;
    double lead;
} surfmink_curve__arcs;

static inline size_t surfmink_curve__next(const surfmink_curve__arcs *c, size_t i)
{
    return i + 1 < c->n ? i + 1 : 0;
}

static inline size_t surfmink_curve__previous(const surfmink_curve__arcs *c, size_t i)
{
    return i > 0 ? i - 1 : c->n - 1;
}

static inline int surfmink_curve__sharp(const surfmink_curve__arcs *c, size_t i)
{
    return c->sharp && c->sharp[i];
}

static inline double surfmink_curve__slant(const surfmink_curve__arcs *c, size_t i)
{
    return c->bend ? c->bend[i] * c->twist[i] / 6 : 0;
}

static inline double surfmink_curve__at_corner(const surfmink_curve__arcs *c, size_t i)
{
    return 2 * c->turn[i] / (c->arc[surfmink_curve__previous(c, i)] + c->arc[i]);
}

static inline double surfmink_curve__slope(const surfmink_curve__arcs *c, size_t i)
{
    size_t next = surfmink_curve__next(c, i);
    return 3 * (surfmink_curve__at_corner(c, next) - surfmink_curve__at_corner(c, i)) /
           (c->arc[surfmink_curve__previous(c, i)] + c->arc[i] + c->arc[next]);
}

static inline double surfmink_curve__at_middle(const surfmink_curve__arcs *c, size_t i, double *slope)
{
    size_t next = surfmink_curve__next(c, i), previous = surfmink_curve__previous(c, i);
    *slope = 0;
    if (surfmink_curve__sharp(c, i) && surfmink_curve__sharp(c, next)) return 0;
    if (surfmink_curve__sharp(c, i)) {
        if (!surfmink_curve__sharp(c, surfmink_curve__next(c, next))) *slope = surfmink_curve__slope(c, next);
        return surfmink_curve__at_corner(c, next) - *slope * (c->arc[i] / 6 + c->arc[next] / 3);
    }
    if (!surfmink_curve__sharp(c, next))
        *slope = surfmink_curve__slope(c, i);
    else if (!surfmink_curve__sharp(c, previous))
        *slope = surfmink_curve__slope(c, previous);
    return surfmink_curve__at_corner(c, i) + *slope * (c->arc[i] / 6 + c->arc[previous] / 3);
}

static inline double surfmink_curve__twisting(const surfmink_curve__arcs *c, size_t i)
{
    size_t next = surfmink_curve__next(c, i), previous = surfmink_curve__previous(c, i);
    double torsion = c->twist[i] / c->arc[i], square = c->arc[i] * c->arc[i], left = 0, right = 0;
    double before = (c->arc[previous] + c->arc[i]) / 2, after = (c->arc[i] + c->arc[next]) / 2;
    int from = !surfmink_curve__sharp(c, i), to = !surfmink_curve__sharp(c, next);
    if (from) left = (torsion - c->twist[previous] / c->arc[previous]) / before;
    if (to) right = (c->twist[next] / c->arc[next] - torsion) / after;
    if (from && to) return (right * before + left * after) / (before + after) * square;
    return (left + right) * square;
}

static inline double surfmink_curve__rise(const surfmink_curve__arcs *c, size_t i)
{
    double a, w, l = c->arc[i] * c->measure;
    if (!c->bend) return (c->curvature ? c->curvature[i] : c->constant) * l * l * c->swept[i] / 12;
    a = c->bend[i];
    w = c->twist[i];
    return (a * surfmink_curve__twisting(c, i) + c->swept[i] * (a * a - w * w)) / 12;
}

/* Order 2 leaves edges as they are. */
static inline int surfmink_curve__bow(surfmink_curve__arcs *c, int order)
{
    surfmink_curve__sum whole = {0, 0}, turned = {0, 0}, total = {0, 0}, rise = {0, 0};
    double slope, before = 0, here, a;
    size_t i;
    c->segments = c->lead = c->power = c->sharpest = 0;
    before = surfmink_curve__slant(c, c->n - 1);
    for (i = 0; i < c->n; ++i) {
        c->arc[i] /= c->unit;
        c->power += pow(c->arc[i], order + 1);
        if (fabs(c->turn[i]) > c->sharpest) c->sharpest = fabs(c->turn[i]);
        if (!(c->arc[i] > 0)) return SURFMINK_NOT_FINITE;
        c->swept[i] = 0;
        surfmink_curve__add(&total, c->turn[i]);
        here = surfmink_curve__slant(c, i);
        if (order == 4) c->turn[i] += here - before;
        before = here;
    }
    for (i = 0; i < c->n && order == 4; ++i) {
        c->swept[i] = surfmink_curve__at_middle(c, i, &slope) * c->arc[i];
        if (i == 0) c->lead = slope * c->arc[0] * c->arc[0] / 24;
        c->segments += c->swept[i] * c->arc[i] * c->arc[i] / 12;
    }
    if (order == 4) before = surfmink_curve__rise(c, c->n - 1);
    for (i = 0; i < c->n && order == 4; ++i) {
        here = surfmink_curve__rise(c, i);
        surfmink_curve__add(&rise, here);
        surfmink_curve__add(&total, -here);
        c->turn[i] -= (before + here) / 2;
        before = here;
    }
    for (i = 0; i < c->n; ++i) {
        a = c->bend ? c->bend[i] : 0;
        if (order == 4) c->arc[i] *= 1 + (c->swept[i] * c->swept[i] + a * a) / 24;
        surfmink_curve__add(&whole, c->arc[i]);
        surfmink_curve__add(&turned, fabs(c->turn[i]));
    }
    c->whole = surfmink_curve__value(&whole);
    c->turned = surfmink_curve__value(&turned);
    c->total = surfmink_curve__value(&total);
    c->rise = surfmink_curve__value(&rise);
    return SURFMINK_OK;
}

/* Adds the arcs to p g_p of the ranks from `first` on. */
static inline void surfmink_curve__add_ranks(const surfmink_curve__arcs *c, int first, int ranks,
                                             surfmink_curve__sum *sum)
{
    surfmink_curve__sum path = {0, 0};
    double period = c->total / (double)c->windings, phase, x, w[2], z[2], v[2], u[2];
    size_t i;
    int k;
    for (i = 0; i < c->n; ++i) {
        if (i > 0) surfmink_curve__add(&path, c->turn[i]);
        phase = surfmink_curve__two_pi * (surfmink_curve__value(&path) / period);
        x = surfmink_curve__two_pi / 2 * (c->swept[i] / period);
        if (fabs(x) < 1e-100) x = 1e-100; /* straight: sin(p x) = p x */
        z[0] = cos(phase);
        z[1] = sin(phase);
        u[0] = v[0] = cos(x);
        u[1] = v[1] = sin(x);
        w[0] = c->arc[i] / x * z[0];
        w[1] = c->arc[i] / x * z[1];
        surfmink_curve__times_power(w, z, first - 1);
        surfmink_curve__times_power(v, u, first - 1);
        for (k = 0; k < ranks; ++k) {
            surfmink_curve__add(sum + 2 * k, w[0] * v[1]);
            surfmink_curve__add(sum + 2 * k + 1, w[1] * v[1]);
            surfmink_curve__multiply(w, z);
            surfmink_curve__multiply(v, u);
        }
    }
}

static inline void surfmink_curve__ranks(const surfmink_curve__arcs *c, int max_rank, double back, double *mu, double *g)
{
    enum { RANKS = 24 };
    surfmink_curve__sum sum[2 * RANKS];
    double lead[2], component[2];
    int first, ranks, k, p;
    lead[0] = cos(surfmink_curve__two_pi * (c->lead / c->total));
    lead[1] = sin(surfmink_curve__two_pi * (c->lead / c->total));
    if (mu) mu[0] = 1;
    if (g) g[0] = c->whole * back;
    if (g) g[1] = 0;
    for (first = 1; first <= max_rank; first += ranks) {
        ranks = max_rank - first < RANKS ? max_rank - first + 1 : RANKS;
        memset(sum, 0, sizeof sum);
        surfmink_curve__add_ranks(c, first, ranks, sum);
        for (k = 0; k < ranks; ++k) {
            p = first + k;
            component[0] = surfmink_curve__value(sum + 2 * k) / p;
            component[1] = surfmink_curve__value(sum + 2 * k + 1) / p;
            if (mu) mu[p] = fmin(1, hypot(component[0], component[1]) / c->whole);
            if (!g) continue;
            surfmink_curve__times_power(component, lead, p);
            g[2 * p] = component[0] * back;
            g[2 * p + 1] = component[1] * back;
        }
    }
}

/* --- outlines ----------------------------------------------------------------------------------------------------- */

static inline void surfmink_curve__unit(const double *v, double unit[3])
{
    double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2]))), norm;
    int k, exponent;
    frexp(most, &exponent);
    for (k = 0; k < 3; ++k) unit[k] = ldexp(v[k], -exponent);
    norm = sqrt(unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2]);
    for (k = 0; k < 3; ++k) unit[k] /= norm;
}

static inline void surfmink_curve__bend(const double frame[9], const double *x_normal, const double *y_normal,
                                        double *bend, double *twist)
{
    double a[3], b[3];
    int k;
    surfmink_curve__unit(x_normal, a);
    surfmink_curve__unit(y_normal, b);
    *bend = *twist = 0;
    for (k = 0; k < 3; ++k) {
        *bend -= (b[k] - a[k]) * frame[3 + k];
        *twist += (b[k] - a[k]) * frame[k]; /* nu is N x e the other way round */
    }
}

static inline int surfmink_curve_bends(const surfmink_outline *o, double *bend, double *twist, size_t *bad)
{
    double frame[9];
    size_t i, next;
    int pass, status;
    if (o->kind != SURFMINK_EMBEDDED) return surfmink_curve__blame(SURFMINK_BAD_ARGUMENT, o->n, bad);
    if (o->n < 3) return surfmink_curve__blame(SURFMINK_TOO_FEW_CORNERS, o->n, bad);
    for (pass = 0; pass < 2; ++pass)
        for (i = 0; i < o->n; ++i) {
            status = surfmink_frame(o, i, frame);
            if (status != SURFMINK_OK) return surfmink_curve__blame(status, i + 1 < o->n ? i + 1 : i, bad);
            next = i + 1 < o->n ? i + 1 : 0;
            if (pass == 1) surfmink_curve__bend(frame, o->normal + 3 * i, o->normal + 3 * next, bend + i, twist + i);
        }
    return SURFMINK_OK;
}

/* Edge i beside the one before it, at corners that are not sharp: returns the short one of two that are too unlike. */
static inline size_t surfmink_curve__unlike(const double *length, const unsigned char *sharp, size_t n)
{
    static const double most = 1e3;
    size_t i, before = n - 1;
    for (i = 0; i < n; before = i++)
        if (!(sharp && sharp[i]) && !(length[i] <= most * length[before] && length[before] <= most * length[i]))
            return length[i] < length[before] ? i : before;
    return n;
}

typedef struct surfmink_curve__source {
    surfmink_outline outline;
    const surfmink_curve_options *how;
    double *length, *turning, *bend, *twist, *swept, *corner, *normal, *value;
    unsigned char *sharp;
    double unit, measure, constant;
} surfmink_curve__source;

static inline surfmink_curve__source surfmink_curve__source_of(const surfmink_outline *o,
                                                               const surfmink_curve_options *how, double *scratch)
{
    surfmink_curve__source s;
    size_t n = o->n;
    s.outline = *o;
    s.how = how;
    s.length = scratch;
    s.turning = scratch + n;
    s.bend = scratch + 2 * n;
    s.twist = scratch + 3 * n; 
    s.swept = scratch + 4 * n;
    s.corner = scratch + 5 * n;
    s.normal = scratch + 8 * n;
    s.sharp = (unsigned char *)(scratch + 11 * n);
    s.value = scratch + 12 * n;
    s.unit = s.measure = 1;
    s.constant = o->kind == SURFMINK_SURFACE ? how->curvature : o->kind == SURFMINK_SPHERE ? 1 : 0;
    return s;
}

static inline void surfmink_curve__scale(surfmink_curve__source *s, double length)
{
    int exponent;
    frexp(length, &exponent);
    if (exponent > 1000) exponent = 1000;
    if (exponent < -1000) exponent = -1000;
    s->unit = s->measure = ldexp(1, exponent);
    if (s->outline.kind != SURFMINK_SPHERE) return;
    s->unit = s->outline.radius;
    s->measure = 1;
}

static inline int surfmink_curve__some_log(void *context, const double *x, const double *y, double *length,
                                           double direction[2])
{
    const surfmink_outline *o = (const surfmink_outline *)context;
    const double *corner = o->corner;
    size_t stride = o->surface->stride;
    return (o->surface->log)(o->surface->context, corner + stride * (size_t)*x, corner + stride * (size_t)*y, length,
                             direction);
}

static inline size_t surfmink_curve__step(const surfmink_curve__source *s, size_t i, size_t step)
{
    for (; step > 0; --step) {
        i = i + 1 < s->outline.n ? i + 1 : 0;
        if (s->how->sharp && s->how->sharp[i]) break;
    }
    return i;
}

/* Takes every step-th corner. */
static inline surfmink_outline surfmink_curve__some(const surfmink_curve__source *s, size_t step, size_t start,
                                                    size_t *windings)
{
    surfmink_outline some = s->outline;
    size_t dim = some.kind == SURFMINK_PLANE ? 2 : 3, at = start, next;
    some.n = *windings = 0;
    do {
        next = surfmink_curve__step(s, at, step);
        if (next <= at) ++*windings;
        if (some.kind == SURFMINK_SURFACE)
            s->corner[some.n] = (double)at;
        else if (step > 1)
            memcpy(s->corner + dim * some.n, some.corner + dim * at, dim * sizeof(double));
        if (some.kind == SURFMINK_EMBEDDED && step > 1)
            memcpy(s->normal + 3 * some.n, some.normal + 3 * at, 3 * sizeof(double));
        s->sharp[some.n] = s->how->sharp && s->how->sharp[at];
        ++some.n;
        at = next;
    } while (at != start);
    if (step > 1) {
        some.corner = s->corner;
        some.normal = s->normal;
    }
    return some;
}

static inline int surfmink_curve__trace(surfmink_curve__source *s, size_t step, size_t start,
                                        surfmink_curve__arcs *c, size_t *bad)
{
    surfmink_surface surface;
    surfmink_outline some;
    size_t k;
    int status;
    some = surfmink_curve__some(s, step, start, &c->windings);
    if (some.kind == SURFMINK_SURFACE && step > 1) {
        surface = *some.surface;
        surface.context = &s->outline;
        surface.stride = 1;
        surface.log = surfmink_curve__some_log;
        some.surface = &surface;
    }
    status = surfmink_edges(&some, s->length, s->turning, bad);
    if (status != SURFMINK_OK) return status;
    c->n = some.n;
    c->arc = s->length;
    c->turn = s->turning;
    c->swept = s->swept;
    c->bend = c->twist = c->curvature = NULL;
    c->constant = s->constant;
    c->unit = s->unit;
    c->measure = s->measure;
    c->sharp = s->how->sharp ? s->sharp : NULL;
    if (s->how->order == 2) return SURFMINK_OK;
    k = surfmink_curve__unlike(s->length, c->sharp, c->n);
    if (k < c->n) return surfmink_curve__blame(SURFMINK_CURVE_UNLIKE_EDGES, k + 1 < c->n ? k + 1 : k, bad);
    if (some.kind == SURFMINK_EMBEDDED) {
        status = surfmink_curve_bends(&some, s->bend, s->twist, bad);
        c->bend = s->bend;
        c->twist = s->twist;
    }
    if (some.kind == SURFMINK_SURFACE && s->how->curvature_at) {
        for (k = 0; k < c->n; ++k)
            s->bend[k] =
                (s->twist[(size_t)s->corner[k]] + s->twist[(size_t)s->corner[surfmink_curve__next(c, k)]]) / 2;
        c->curvature = s->bend;
    }
    return status;
}

/* K at all corners. */
static inline int surfmink_curve__curvatures(const surfmink_curve__source *s, size_t *bad)
{
    const surfmink_outline *o = &s->outline;
    size_t i;
    int status;
    if (o->kind != SURFMINK_SURFACE || !s->how->curvature_at) return SURFMINK_OK;
    for (i = 0; i < o->n; ++i) {
        s->twist[i] = 0;
        status = (s->how->curvature_at)(o->surface->context, o->corner + o->surface->stride * i, s->twist + i);
        if (status != SURFMINK_OK && !*surfmink_strerror(status)) status = SURFMINK_CALLBACK_FAILED;
        if (status == SURFMINK_OK && !(fabs(s->twist[i]) < HUGE_VAL)) status = SURFMINK_CALLBACK_FAILED;
        if (status != SURFMINK_OK) return surfmink_curve__blame(status, i, bad);
    }
    return SURFMINK_OK;
}

static inline int surfmink_curve__check(const surfmink_curve__arcs *c)
{
    surfmink_functionals w;
    double length[3] = {1, 1, 1}, turning[3];
    if (!(c->whole < 1e100) || !(fabs(c->total) < HUGE_VAL) || !(c->turned < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    turning[0] = c->total / (double)c->windings;
    turning[1] = turning[2] = 0;
    return surfmink_total(NULL, length, turning, 3, &w);
}

typedef struct surfmink_curve__stat { double *mean, *most, power, sharpest; size_t m; } surfmink_curve__stat;

static inline int surfmink_curve__level(surfmink_curve__source *s, size_t step, double length, double turning, int ranks,
                                        const double *fine, surfmink_curve__stat *st)
{
    surfmink_curve__arcs c;
    size_t n = s->outline.n, cosets = n % step == 0 ? step : n % 2 == 0 && step == 4 ? 2 : 1, start = 0, i, coset;
    int p, status;
    for (i = 0; i < n && s->how->sharp; ++i)
        if (s->how->sharp[i]) { start = i; cosets = 1; }
    for (p = 0; p <= ranks; ++p) st->mean[p] = st->most[p] = 0;
    st->power = st->sharpest = 0;
    for (coset = 0; coset < cosets; ++coset) {
        status = surfmink_curve__trace(s, step, start + coset, &c, NULL);
        if (status == SURFMINK_OK) status = surfmink_curve__bow(&c, s->how->order);
        if (status == SURFMINK_OK) status = surfmink_curve__check(&c);
        if (status == SURFMINK_OK && !(fabs(c.total / (double)c.windings - turning) < surfmink_curve__two_pi / 2)) status = SURFMINK_CLOCKWISE;
        if (status != SURFMINK_OK) return status;
        surfmink_curve__ranks(&c, ranks, 1, s->value, NULL);
        s->value[0] = c.whole / (double)c.windings * c.unit / length;
        for (p = 0; p <= ranks; ++p) {
            st->mean[p] += s->value[p] / (double)cosets;
            if (fine) st->most[p] = fmax(st->most[p], fabs(s->value[p] - fine[p]));
        }
        st->power += c.power / (double)c.windings / (double)cosets;
        st->sharpest = fmax(st->sharpest, c.sharpest);
        st->m = c.n;
    }
    return SURFMINK_OK;
}
#endif
