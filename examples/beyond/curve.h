/* curve.h - smooth closed curves through corners, for surfmink.h - MIT or public domain, as surfmink.h

     double mu[7], error[7], scratch[SURFMINK_CURVE_SCRATCH(100, 6)];   // an outline of 100 corners, mu_0 ... mu_6
     surfmink_curve_options fourth = {4, NULL, 0, NULL};                // order 4, no sharp corners
     surfmink_curve_results out = {mu, error, NULL, NULL};
     int status = surfmink_curve(&outline, &fourth, 6, scratch, &out, NULL);
     if (status != SURFMINK_OK) puts(surfmink_curve_strerror(status));
     else if (error[2] < SURFMINK_CURVE_UNKNOWN) printf("mu_2 = %.6f +- %.0e\n", mu[2], error[2]);

   surfmink_measure measures a polygon. If its corners are samples of a smooth curve, its numbers differ from those of
   the curve by an error that falls fourfold with twice the corners. surfmink_curve with order 4 measures the curve: its
   error falls sixteenfold. And it estimates how large the error is, by measuring the curve again from every second and
   from every fourth corner.
   Shapes with corners: take order 2, which is exact for polygons, or say which corners are sharp.

   One header to copy beside surfmink.h. C99 and C++11, only public calls and libm; no allocation, no globals. Every
   function is static inline. Errors as in surfmink.h: outputs are then untouched, except *bad.
   Derivation, convergence, limits, and how good the estimates are: docs/internals/beyond.md. */
#ifndef SURFMINK_CURVE_H
#define SURFMINK_CURVE_H

#ifndef SURFMINK_H
#include "surfmink.h"
#endif
#include <math.h>
#include <string.h>

/* What may be wrong besides enum surfmink_status: order 4, and two edges at a corner that is not sharp differ by more
   than 1 : 1000. surfmink_merge drops a corner that nearly repeats the one before. */
enum surfmink_curve_status { SURFMINK_CURVE_UNLIKE_EDGES = 100 };

/* As surfmink_strerror and surfmink_status_name, for the status above too. */
static inline const char *surfmink_curve_strerror(int status);
static inline const char *surfmink_curve_status_name(int status);

/* What is known of the curve.
   order              2: the polygon stands for the curve; 4
   sharp       n      not 0 where the curve itself has a corner between two smooth arcs; or NULL: nowhere. Order 4 then
                      looks along each arc only; an arc of one edge is straight or a geodesic
   curvature          callback surface: the Gaussian curvature K in 1 / length^2, if it is the same everywhere
   curvature_at       callback surface: writes K at the corner x, and returns as the other callbacks do; or NULL */
typedef struct surfmink_curve_options {
    int order;
    const unsigned char *sharp;
    double curvature;
    int (*curvature_at)(void *context, const double *x, double *curvature);
} surfmink_curve_options;

/* error[p] where nothing is known: for mu_p, which lies in [0, 1], that is a bound; for L it is a sign. */
#define SURFMINK_CURVE_UNKNOWN 1.0

/* Where the results go; each may be NULL. */
typedef struct surfmink_curve_results {
    double *mu;              /* P + 1 */
    double *error;           /* P + 1: how far mu_p may be off the curve; error[0] is that of L, over L */
    double *g;               /* 2 P + 2: read at the middle of the arc of edge 0, against the co-normal of the curve */
    surfmink_functionals *w; /* of the curve; area as in surfmink_area */
} surfmink_curve_results;

/* Doubles to work in, for n corners and ranks up to P. */
#define SURFMINK_CURVE_SCRATCH(n, P) (12 * (size_t)(n) + 4 * ((size_t)(P) + 2))

/* Measures the smooth closed curve on which the corners of an outline lie; embedded: with its exact normals.
   options            order 2 gives the numbers of surfmink_measure, to the bit; order 4 wants 20 corners or so for each
                      bend of the curve
   max_rank           P >= 0
   scratch            SURFMINK_CURVE_SCRATCH(n, P) doubles
   out                what is not asked for costs nothing
   bad                out, only on failure: as in surfmink_measure; or NULL
   Errors: those of surfmink_measure, for the polygon and for S of the curve; BAD_ARGUMENT (order); NOT_FINITE (a
   curvature; the length or the area of the curve); UNLIKE_EDGES, on the corner that ends the short edge (that begins
   it, if the edge leads to corner 0).
   Cost: O(n P); order 4 takes two to six times as long as surfmink_measure, the errors two to three times as long as
   that again. Callbacks: 2 n logs, with errors 6 n, at order 2 up to 10 n; n curvatures. */
static inline int surfmink_curve(const surfmink_outline *outline, const surfmink_curve_options *options, int max_rank,
                                 double *scratch, const surfmink_curve_results *out, size_t *bad);

/* How an embedded surface curves along the edges of an outline: what order 4 needs besides l_i and alpha_i.
   bend        n      out: a_i = -(n_{i+1} - n_i) . e, the angle by which the normal turns over along edge i: normal
                      curvature times length, negative where the surface bulges outwards along the edge
   twist       n      out: w_i = -(n_{i+1} - n_i) . (N x e), by which it turns about the edge: geodesic torsion times
                      length. e is the unit edge, N the mean normal orthogonal to it
   Errors: those of surfmink_edges; BAD_ARGUMENT (not an embedded outline). Cost: O(n). */
static inline int surfmink_curve_bends(const surfmink_outline *outline, double *bend, double *twist, size_t *bad);

/* Measured edges: lengths, turns and at most two more numbers an edge are all that a surface contributes. */
typedef struct surfmink_curve_measured {
    size_t n;
    const double *length;       /* n, > 0 */
    const double *turning;      /* n, radians */
    const double *bend, *twist; /* n, of straight edges, from surfmink_curve_bends; or both NULL: edges are geodesics */
    const double *curvature;    /* n, Gaussian curvature at the middle of geodesic edges, good to O(l^2); ignored if
                                   there are bend and twist; or NULL: 0 */
    const unsigned char *sharp; /* n, as in surfmink_curve_options; or NULL */
} surfmink_curve_measured;

/* Order 4 from measured edges.
   scratch     3 n    doubles to work in
   out                the area is 0, and error is left alone: edges do not tell what every second corner would measure
   Errors: those of surfmink_total, for the polygon and for the curve; COINCIDENT_CORNERS (a length of 0); UNLIKE_EDGES;
   NOT_FINITE; BAD_ARGUMENT (bend without twist). Cost: O(n P). */
static inline int surfmink_curve_edges(const surfmink_curve_measured *edges, int max_rank, double *scratch,
                                       const surfmink_curve_results *out);

/* ==================================================================================================================
   Implementation
   ================================================================================================================== */

static const double surfmink_curve__pi = 3.14159265358979323846;

static inline const char *surfmink_curve_strerror(int status)
{
    if (status != SURFMINK_CURVE_UNLIKE_EDGES) return surfmink_strerror(status);
    return "an edge is more than 1000 times as long as the next one: two corners nearly coincide, or one is sharp";
}

static inline const char *surfmink_curve_status_name(int status)
{
    return status == SURFMINK_CURVE_UNLIKE_EDGES ? "unlike_edges" : surfmink_status_name(status);
}

static inline int surfmink_curve__blame(int status, size_t corner, size_t *bad)
{
    if (status != SURFMINK_OK && bad) *bad = corner;
    return status;
}

/* --- arcs: from the edges of a polygon to those of the curve ------------------------------------------------------ */

/* What is known of the arcs, one for each edge. */
typedef struct surfmink_curve__arcs {
    size_t n, windings;         /* the corners go round so many times */
    double *arc, *turn, *swept; /* l_i, then h_i, over unit; alpha_i, then those of the curve; D_i */
    const double *bend, *twist; /* a_i, w_i; or NULL: edges are geodesics */
    const double *curvature;    /* K_i; or NULL: constant everywhere */
    double constant, unit;      /* unit is the length that counts as 1 */
    double measure;             /* the unit of the lengths that belong to K; on a sphere the radius: 1 */
    const unsigned char *sharp; /* or NULL */
    surfmink_functionals w;     /* of the arcs: L over unit, S, condition */
    double rise, segments;      /* sum E_i; area between chords and arcs */
    double lead;                /* from the mean direction of arc 0 to that at its middle */
    double power, sharpest;     /* sum l_i^(order + 1); largest turn at a corner that is not sharp */
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

/* A_i: the mean direction of arc i, carried to its ends, leaves that of the chord by this angle. */
static inline double surfmink_curve__slant(const surfmink_curve__arcs *c, size_t i)
{
    return c->bend ? c->bend[i] * c->twist[i] / 6 : 0;
}

/* Geodesic curvature at corner i: its turn over half the two edges. It belongs to the point (l_i - l_{i-1}) / 3 behind
   the corner, and would be exact for curvature that changes linearly. */
static inline double surfmink_curve__at_corner(const surfmink_curve__arcs *c, size_t i)
{
    return 2 * c->turn[i] / (c->arc[surfmink_curve__previous(c, i)] + c->arc[i]);
}

/* Its derivative from corner i to the next. */
static inline double surfmink_curve__slope(const surfmink_curve__arcs *c, size_t i)
{
    size_t next = surfmink_curve__next(c, i);
    return 3 * (surfmink_curve__at_corner(c, next) - surfmink_curve__at_corner(c, i)) /
           (c->arc[surfmink_curve__previous(c, i)] + c->arc[i] + c->arc[next]);
}

/* Geodesic curvature in the middle of arc i, and its derivative: linear between the corners at both ends, or between
   the two next to a sharp one. With one corner that is not sharp the curvature is constant, with none it is 0. */
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

/* By how much geodesic torsion times l_i changes along arc i: a parabola through this arc and both neighbours; next to
   a sharp corner a line through two. */
static inline double surfmink_curve__torsion_change(const surfmink_curve__arcs *c, size_t i)
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

/* E_i: what the surface between the arc and the edge takes from the turns at both ends. Of a geodesic it is the
   Gaussian curvature between the two, K_i D_i l_i^2 / 12. */
static inline double surfmink_curve__rise(const surfmink_curve__arcs *c, size_t i)
{
    double a, w, l = c->arc[i] * c->measure;
    if (!c->bend) return (c->curvature ? c->curvature[i] : c->constant) * l * l * c->swept[i] / 12;
    a = c->bend[i];
    w = c->twist[i];
    return (a * surfmink_curve__torsion_change(c, i) + c->swept[i] * (a * a - w * w)) / 12;
}

/* Order 4: turns and arc lengths of the curve. Between corners its direction runs through the angle D_i = swept, half
   of it on either side of a mean that is the direction of the chord but for A_i. */
static inline void surfmink_curve__bow(surfmink_curve__arcs *c)
{
    double slope, before = surfmink_curve__slant(c, c->n - 1), here, a;
    size_t i;
    for (i = 0; i < c->n; ++i) {
        here = surfmink_curve__slant(c, i);
        c->turn[i] += here - before;
        before = here;
    }
    for (i = 0; i < c->n; ++i) {
        c->swept[i] = surfmink_curve__at_middle(c, i, &slope) * c->arc[i];
        if (i == 0) c->lead = slope * c->arc[0] * c->arc[0] / 24;
        c->segments += c->swept[i] * c->arc[i] * c->arc[i] / 12;
    }
    before = surfmink_curve__rise(c, c->n - 1);
    for (i = 0; i < c->n; ++i) {
        here = surfmink_curve__rise(c, i);
        c->turn[i] -= (before + here) / 2;
        before = here;
        c->rise += here;
    }
    for (i = 0; i < c->n; ++i) {
        a = c->bend ? c->bend[i] : 0;
        c->arc[i] *= 1 + (c->swept[i] * c->swept[i] + a * a) / 24;
    }
}

/* Makes arcs of lengths and turns; order 2 leaves them as they are. Is the curve one that can be measured? */
static inline int surfmink_curve__make_arcs(surfmink_curve__arcs *c, int order)
{
    static const double longest = 1e100; /* where all products stay finite, over unit; only nonsense is longer */
    size_t i;
    int status;
    c->rise = c->segments = c->lead = c->power = c->sharpest = 0;
    for (i = 0; i < c->n; ++i) {
        c->arc[i] /= c->unit;
        if (!(c->arc[i] > 0)) return SURFMINK_NOT_FINITE; /* beside the longest edges it goes under */
        c->swept[i] = 0;
        if (!surfmink_curve__sharp(c, i)) c->sharpest = fmax(c->sharpest, fabs(c->turn[i]));
        if (surfmink_curve__sharp(c, i) && surfmink_curve__sharp(c, surfmink_curve__next(c, i))) continue;
        c->power += pow(c->arc[i], order + 1);
    }
    if (order == 4) surfmink_curve__bow(c);
    if ((status = surfmink_total(NULL, c->arc, c->turn, c->n, &c->w)) != SURFMINK_OK) return status;
    return c->w.length < longest ? SURFMINK_OK : SURFMINK_NOT_FINITE;
}

/* --- ranks: from arcs to mu and g --------------------------------------------------------------------------------- */

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
    double power[2], square[2];
    power[0] = z[0];
    power[1] = z[1];
    for (; p > 0; p /= 2) {
        if (p % 2) surfmink_curve__multiply(w, power);
        square[0] = power[0];
        square[1] = power[1];
        surfmink_curve__multiply(power, square);
    }
}

/* sum[0] + sum[1] grows by x; sum[1] is what sum[0] rounds off. */
static inline void surfmink_curve__add(double sum[2], double x)
{
    double total = sum[0] + x, part = total - sum[0];
    sum[1] += (sum[0] - (total - part)) + (x - part);
    sum[0] = total;
}

/* Adds to `sum` the parts of p g_p, p = first, first + 1, ... On an arc the phase runs from f - x to f + x, where x =
   pi D / S, and the mean of exp(i p f) there is sin(p x) / (p x) exp(i p f). sin(p x) is the imaginary part of
   exp(i x)^p, which keeps its digits however small x is. */
static inline void surfmink_curve__add_ranks(const surfmink_curve__arcs *c, int first, int ranks, double (*sum)[2])
{
    static const double straight = 1e-100; /* sin(p x) = p x to the bit, and nothing is divided by 0 */
    double period = c->w.turning / (double)c->windings, path[2] = {0, 0}, phase, x, w[2], z[2], v[2], u[2];
    size_t i;
    int k;
    for (i = 0; i < c->n; ++i) {
        if (i > 0) surfmink_curve__add(path, c->turn[i]);
        phase = 2 * surfmink_curve__pi * ((path[0] + path[1]) / period);
        x = surfmink_curve__pi * (c->swept[i] / period);
        if (fabs(x) < straight) x = straight;
        z[0] = cos(phase);
        z[1] = sin(phase);
        u[0] = v[0] = cos(x);
        u[1] = v[1] = sin(x);
        w[0] = c->arc[i] / x * z[0];
        w[1] = c->arc[i] / x * z[1];
        surfmink_curve__times_power(w, z, first - 1);
        surfmink_curve__times_power(v, u, first - 1);
        for (k = 0; k < ranks; ++k) {
            surfmink_curve__add(sum[2 * (size_t)k], w[0] * v[1]);
            surfmink_curve__add(sum[2 * (size_t)k + 1], w[1] * v[1]);
            surfmink_curve__multiply(w, z);
            surfmink_curve__multiply(v, u);
        }
    }
}

/* mu or g may be NULL. */
static inline void surfmink_curve__integrate(const surfmink_curve__arcs *c, int max_rank, double *mu, double *g)
{
    enum { RANKS = 24 }; /* summed in one pass over the arcs */
    double sum[2 * RANKS][2], lead[2], component[2], turned = 2 * surfmink_curve__pi * (c->lead / c->w.turning);
    int first, ranks, k, p;
    lead[0] = cos(turned);
    lead[1] = sin(turned);
    if (mu) mu[0] = 1;
    if (g) g[0] = c->w.length * c->unit;
    if (g) g[1] = 0;
    for (first = 1; first <= max_rank && (mu || g); first += ranks) {
        ranks = max_rank - first < RANKS ? max_rank - first + 1 : RANKS;
        memset(sum, 0, sizeof sum);
        surfmink_curve__add_ranks(c, first, ranks, sum);
        for (k = 0; k < ranks; ++k) {
            p = first + k;
            component[0] = (sum[2 * (size_t)k][0] + sum[2 * (size_t)k][1]) / p;
            component[1] = (sum[2 * (size_t)k + 1][0] + sum[2 * (size_t)k + 1][1]) / p;
            if (mu) mu[p] = fmin(1, hypot(component[0], component[1]) / c->w.length);
            if (!g) continue;
            surfmink_curve__times_power(component, lead, p);
            g[2 * (size_t)p] = component[0] * c->unit;
            g[2 * (size_t)p + 1] = component[1] * c->unit;
        }
    }
}

/* --- outlines: all corners, or every step-th ---------------------------------------------------------------------- */

static inline void surfmink_curve__unit_vector(const double v[3], double unit[3])
{
    double most = fmax(fabs(v[0]), fmax(fabs(v[1]), fabs(v[2]))), norm;
    int k;
    for (k = 0; k < 3; ++k) unit[k] = v[k] / most; /* whose square is neither 0 nor infinite */
    norm = sqrt(unit[0] * unit[0] + unit[1] * unit[1] + unit[2] * unit[2]);
    for (k = 0; k < 3; ++k) unit[k] /= norm;
}

/* a_i and w_i of all edges; or, if bend is NULL, whether they have any. */
static inline int surfmink_curve__bends(const surfmink_outline *o, double *bend, double *twist, size_t *bad)
{
    double frame[9], a[3], b[3]; /* nu = e x N, e, N */
    size_t i;
    int k, status;
    for (i = 0; i < o->n; ++i) {
        status = surfmink_frame(o, i, frame);
        if (status != SURFMINK_OK) return surfmink_curve__blame(status, i + 1 < o->n ? i + 1 : i, bad);
        if (!bend) continue;
        surfmink_curve__unit_vector(o->normal + 3 * i, a);
        surfmink_curve__unit_vector(o->normal + 3 * (i + 1 < o->n ? i + 1 : 0), b);
        bend[i] = twist[i] = 0;
        for (k = 0; k < 3; ++k) bend[i] -= (b[k] - a[k]) * frame[3 + k];
        for (k = 0; k < 3; ++k) twist[i] += (b[k] - a[k]) * frame[k];
    }
    return SURFMINK_OK;
}

static inline int surfmink_curve_bends(const surfmink_outline *o, double *bend, double *twist, size_t *bad)
{
    int status = SURFMINK_OK;
    if (o->kind != SURFMINK_EMBEDDED) status = SURFMINK_BAD_ARGUMENT;
    if (status == SURFMINK_OK && o->n < 3) status = SURFMINK_TOO_FEW_CORNERS;
    if (status != SURFMINK_OK) return surfmink_curve__blame(status, o->n, bad);
    status = surfmink_curve__bends(o, NULL, NULL, bad); /* nothing is written before all edges have passed */
    return status == SURFMINK_OK ? surfmink_curve__bends(o, bend, twist, bad) : status;
}

/* Curvature at a corner is a turn over two lengths: order 4 is worth something as long as both matter. Beyond that a
   last point that repeats the first, off by a rounding, would pass for an arc of its own. The corner to blame, or n. */
static inline size_t surfmink_curve__find_unlike(const double *length, const unsigned char *sharp, size_t n)
{
    static const double most = 1e3;
    size_t i, before = n - 1, edge;
    for (i = 0; i < n; before = i++) {
        if (sharp && sharp[i]) continue;
        if (length[i] <= most * length[before] && length[before] <= most * length[i]) continue;
        edge = length[i] < length[before] ? i : before;
        return edge + 1 < n ? edge + 1 : edge;
    }
    return n;
}

/* An outline to measure, and the doubles to work in. */
typedef struct surfmink_curve__work {
    surfmink_outline outline;
    const surfmink_curve_options *options;
    double *arc, *turn, *swept;          /* n each, as in surfmink_curve__arcs */
    double *bend, *twist;                /* n each; of a surface with curvature_at: K_i at edges, K at all corners */
    double *corner, *normal;             /* 3 n each, of every step-th corner; of a surface: its number */
    unsigned char *sharp;                /* n, of every step-th corner */
    double *fine, *half, *quarter, *one; /* P + 2 each: of all corners, of fewer; of one time round */
    double unit;                         /* as in surfmink_curve__arcs */
} surfmink_curve__work;

static inline surfmink_curve__work
surfmink_curve__work_of(const surfmink_outline *o, const surfmink_curve_options *options, int max_rank, double *scratch)
{
    surfmink_curve__work work;
    size_t n = o->n, ranks = (size_t)max_rank + 2;
    work.outline = *o;
    work.options = options;
    work.arc = scratch;
    work.turn = scratch + n;
    work.swept = scratch + 2 * n;
    work.bend = scratch + 3 * n;
    work.twist = scratch + 4 * n;
    work.corner = scratch + 5 * n;
    work.normal = scratch + 8 * n;
    work.sharp = (unsigned char *)(scratch + 11 * n);
    work.fine = scratch + 12 * n;
    work.half = work.fine + ranks;
    work.quarter = work.half + ranks;
    work.one = work.quarter + ranks;
    work.unit = 1;
    return work;
}

/* The power of two above a length, as far as its inverse is a double too; on a sphere the radius. */
static inline double surfmink_curve__unit(const surfmink_outline *o, double length)
{
    int exponent;
    if (o && o->kind == SURFMINK_SPHERE) return o->radius;
    frexp(length, &exponent);
    return ldexp(1, exponent > 1000 ? 1000 : exponent < -1000 ? -1000 : exponent);
}

/* Corners of a surface may have any stride: every step-th is known by its number. */
static inline int surfmink_curve__log(void *context, const double *x, const double *y, double *length,
                                      double direction[2])
{
    const surfmink_outline *o = (const surfmink_outline *)context;
    const double *from = o->corner + o->surface->stride * (size_t)*x, *to = o->corner + o->surface->stride * (size_t)*y;
    return (o->surface->log)(o->surface->context, from, to, length, direction);
}

/* Copies every step-th corner and each sharp one, from one of them on, as many times round as it takes to come back to
   that one. */
static inline surfmink_outline surfmink_curve__some(surfmink_curve__work *work, size_t step, size_t start,
                                                    size_t *windings)
{
    surfmink_outline some = work->outline;
    const unsigned char *sharp = work->options->sharp;
    size_t n = some.n, dim = some.kind == SURFMINK_PLANE ? 2 : 3, at = start, k;
    some.n = *windings = 0;
    do {
        if (some.kind == SURFMINK_SURFACE)
            work->corner[some.n] = (double)at;
        else
            memcpy(work->corner + dim * some.n, some.corner + dim * at, dim * sizeof *work->corner);
        if (some.normal) memcpy(work->normal + 3 * some.n, some.normal + 3 * at, 3 * sizeof *work->normal);
        work->sharp[some.n++] = sharp && sharp[at];
        for (k = 0; k < step && !(k > 0 && sharp && sharp[at]); ++k) {
            at = at + 1 < n ? at + 1 : 0;
            if (at == 0) ++*windings;
        }
    } while (at != start);
    some.corner = work->corner;
    if (some.normal) some.normal = work->normal;
    return some;
}

/* K at all corners, if it is asked for, and the numbers of the corners. */
static inline int surfmink_curve__curvatures(const surfmink_curve__work *work, size_t *bad)
{
    const surfmink_outline *o = &work->outline;
    size_t i;
    int status;
    for (i = 0; i < o->n && o->kind == SURFMINK_SURFACE && work->options->curvature_at; ++i) {
        work->corner[i] = (double)i;
        work->twist[i] = 0;
        status =
            (work->options->curvature_at)(o->surface->context, o->corner + o->surface->stride * i, work->twist + i);
        if (status != SURFMINK_OK && !*surfmink_strerror(status)) status = SURFMINK_CALLBACK_FAILED;
        if (status == SURFMINK_OK && !(fabs(work->twist[i]) < HUGE_VAL)) status = SURFMINK_CALLBACK_FAILED;
        if (status != SURFMINK_OK) return surfmink_curve__blame(status, i, bad);
    }
    return SURFMINK_OK;
}

/* What order 4 needs besides lengths and turns. */
static inline int surfmink_curve__look_around(surfmink_curve__work *work, const surfmink_outline *o,
                                              surfmink_curve__arcs *c, size_t *bad)
{
    size_t i = surfmink_curve__find_unlike(c->arc, c->sharp, c->n);
    if (i < c->n) return surfmink_curve__blame(SURFMINK_CURVE_UNLIKE_EDGES, i, bad);
    if (o->kind == SURFMINK_EMBEDDED) {
        c->bend = work->bend;
        c->twist = work->twist;
        return surfmink_curve__bends(o, work->bend, work->twist, bad);
    }
    if (o->kind != SURFMINK_SURFACE || !work->options->curvature_at) return SURFMINK_OK;
    for (i = 0; i < c->n; ++i) work->bend[i] = work->twist[(size_t)work->corner[i]] / 2;
    for (i = 0; i < c->n; ++i)
        work->swept[i] = work->bend[i] + work->bend[surfmink_curve__next(c, i)]; /* the mean of both ends */
    memcpy(work->bend, work->swept, c->n * sizeof *work->bend);
    c->curvature = work->bend;
    return SURFMINK_OK;
}

static inline surfmink_curve__arcs surfmink_curve__arcs_of(const surfmink_curve__work *work, size_t n)
{
    surfmink_curve__arcs c;
    memset(&c, 0, sizeof c);
    c.n = n;
    c.windings = 1;
    c.arc = work->arc;
    c.turn = work->turn;
    c.swept = work->swept;
    c.bend = c.twist = c.curvature = NULL;
    c.constant = work->outline.kind == SURFMINK_SURFACE  ? work->options->curvature
                 : work->outline.kind == SURFMINK_SPHERE ? 1
                                                         : 0;
    c.unit = work->unit;
    c.measure = work->outline.kind == SURFMINK_SPHERE ? 1 : work->unit;
    c.sharp = work->options->sharp;
    return c;
}

/* --- estimates of the error --------------------------------------------------------------------------------------- */

/* Measures every step-th corner. Returns 0 if that is no outline, or winds otherwise than all of them: S of one time
   round is then more than half a turn off. */
static inline int surfmink_curve__measure_some(surfmink_curve__work *work, size_t step, size_t start, double turning,
                                               surfmink_curve__arcs *c)
{
    surfmink_surface numbers;
    surfmink_outline some;
    size_t windings;
    some = surfmink_curve__some(work, step, start, &windings);
    if (some.kind == SURFMINK_SURFACE) {
        numbers.context = &work->outline;
        numbers.stride = 1;
        numbers.log = surfmink_curve__log;
        numbers.exp = NULL;
        some.surface = &numbers;
    }
    *c = surfmink_curve__arcs_of(work, some.n);
    c->windings = windings;
    if (c->sharp) c->sharp = work->sharp;
    if (surfmink_edges(&some, work->arc, work->turn, NULL) != SURFMINK_OK) return 0;
    if (work->options->order == 4 && surfmink_curve__look_around(work, &some, c, NULL) != SURFMINK_OK) return 0;
    if (surfmink_curve__make_arcs(c, work->options->order) != SURFMINK_OK) return 0;
    return fabs(c->w.turning / (double)windings - turning) < surfmink_curve__pi;
}

/* How far L (over L) and mu_p of every step-th corner are off those of all corners: the largest of the ways to choose
   them, which are 1, 2 or 4; if there are sharp corners, 1. Returns the mean of their powers; negative if nothing is
   known. */
static inline double surfmink_curve__deviations(surfmink_curve__work *work, size_t step,
                                                const surfmink_curve__arcs *all, int ranks, double *off)
{
    surfmink_curve__arcs c;
    size_t n = work->outline.n, ways = n % step == 0 ? step : n % 2 == 0 ? 2 : 1, start = 0, way, i;
    double power = 0;
    int p;
    for (i = 0; i < n && work->options->sharp; ++i)
        if (work->options->sharp[i]) {
            start = i;
            ways = 1;
        }
    for (p = 0; p <= ranks; ++p) off[p] = 0;
    for (way = 0; way < ways; ++way) {
        if (!surfmink_curve__measure_some(work, step, start + way, all->w.turning, &c)) return -1;
        surfmink_curve__integrate(&c, ranks, work->one, NULL);
        work->one[0] = c.w.length / (double)c.windings / all->w.length;
        power += c.power / (double)c.windings / (double)ways;
        for (p = 0; p <= ranks; ++p) off[p] = fmax(off[p], fabs(work->one[p] - work->fine[p]));
    }
    return power;
}

/* The largest of rank p and its neighbours: the error of one rank may happen to change its sign, those of all seldom
   do at once. L has no neighbours, and counts twice instead. */
static inline double surfmink_curve__around(const double *off, int p)
{
    if (p == 0) return 2 * off[0];
    return fmax(fmax(off[p], off[p + 1]), p > 1 ? off[p - 1] : 0);
}

/* Errors are proportional to sum l_i^(order + 1): from all corners to every second and to every fourth one they grow by
   known factors. So either deviation tells the error, and the larger one counts. Where the growth that is seen is
   slower, it counts instead. Where it is below a doubling, which would be order 1, nothing is known; nor of ranks whose
   phase takes half a turn from one edge to the next. */
static inline void surfmink_curve__estimate(surfmink_curve__work *work, const surfmink_curve__arcs *all, int max_rank,
                                            double *error)
{
    static const double safety = 2;       /* with it the estimates hold as often as docs/internals/beyond.md says */
    static const double rounding = 2e-14; /* of mu, over 1 + condition: docs/internals/beyond.md */
    double noise = rounding * (1 + all->w.condition), half, quarter, growth, phase, twofold = -1, fourfold = -1;
    int p;
    for (p = 0; p <= max_rank; ++p) error[p] = SURFMINK_CURVE_UNKNOWN;
    if (!(all->w.turning > 0)) return; /* there are no arcs */
    phase = 2 * surfmink_curve__pi * all->sharpest / all->w.turning;
    surfmink_curve__integrate(all, max_rank + 1, work->fine, NULL);
    work->fine[0] = 1;
    if (work->outline.n >= 12 && all->w.length > 0) /* every fourth corner makes a polygon */
        twofold = surfmink_curve__deviations(work, 2, all, max_rank + 1, work->half);
    if (twofold >= 0) fourfold = surfmink_curve__deviations(work, 4, all, max_rank + 1, work->quarter);
    for (p = 0; p <= max_rank; ++p) {
        if (!(fourfold >= 0 && p * phase < surfmink_curve__pi)) continue;
        half = surfmink_curve__around(work->half, p);
        quarter = surfmink_curve__around(work->quarter, p);
        if (!(half > noise)) {
            error[p] = noise;
            continue;
        }
        if (!(twofold > all->power && fourfold > all->power)) continue; /* hardly a corner is left out */
        growth = quarter / half - 1; /* from half, which lacks the error itself, to quarter, which does too */
        if (!(growth >= 2)) continue;
        half /= fmin(twofold / all->power, growth) - 1;
        quarter /= fourfold / all->power - 1;
        error[p] = fmin(SURFMINK_CURVE_UNKNOWN, noise + safety * fmax(half, quarter));
    }
}

/* --- the calls ---------------------------------------------------------------------------------------------------- */

/* mu and g of order 4, and the functionals of the curve: those of the polygon, and what lies between the two. The
   polygon knows its S better than the sum of turns does; phases are shares of the sum, as in surfmink_measure. */
static inline int surfmink_curve__fourth(surfmink_curve__arcs *c, const surfmink_outline *o, int max_rank,
                                         surfmink_functionals *w, const surfmink_curve_results *out)
{
    surfmink_functionals curve = *w;
    int status = surfmink_curve__make_arcs(c, 4);
    if (status != SURFMINK_OK) return status;
    curve.length = c->w.length * c->unit;
    curve.turning = w->turning - c->rise;
    curve.curvature += c->rise;
    curve.condition = c->w.condition;
    if (o && o->kind == SURFMINK_SPHERE) curve.area = curve.curvature * o->radius * o->radius;
    if (o && (o->kind == SURFMINK_PLANE || o->kind == SURFMINK_EMBEDDED)) curve.area += c->segments * c->unit * c->unit;
    if (!(curve.length < HUGE_VAL && fabs(curve.area) < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    surfmink_curve__integrate(c, max_rank, out->mu, out->g);
    *w = curve;
    return SURFMINK_OK;
}

static inline int surfmink_curve(const surfmink_outline *outline, const surfmink_curve_options *options, int max_rank,
                                 double *scratch, const surfmink_curve_results *out, size_t *bad)
{
    surfmink_curve__work work;
    surfmink_curve__arcs c;
    surfmink_functionals w;
    int status = SURFMINK_OK;
    if (max_rank < 0 || (options->order != 2 && options->order != 4)) status = SURFMINK_BAD_ARGUMENT;
    if (status == SURFMINK_OK && outline->kind == SURFMINK_SURFACE && !options->curvature_at &&
        !(fabs(options->curvature) < HUGE_VAL))
        status = SURFMINK_NOT_FINITE;
    if (status != SURFMINK_OK) return surfmink_curve__blame(status, outline->n, bad);
    work = surfmink_curve__work_of(outline, options, max_rank, scratch);
    if (options->order == 2 && !out->error) return surfmink_measure(outline, max_rank, out->mu, out->g, out->w, bad);
    if ((status = surfmink_edges(outline, work.arc, work.turn, bad)) != SURFMINK_OK) return status;
    status = surfmink_total(outline, work.arc, work.turn, outline->n, &w);
    if (status != SURFMINK_OK) return surfmink_curve__blame(status, outline->n, bad);
    work.unit = surfmink_curve__unit(outline, w.length);
    c = surfmink_curve__arcs_of(&work, outline->n);
    if (options->order == 2) {
        surfmink_curve__make_arcs(&c, 2); /* if that fails, c.w stays 0, and errors are unknown */
        if ((status = surfmink_measure(outline, max_rank, out->mu, out->g, &w, bad)) != SURFMINK_OK) return status;
    } else {
        if ((status = surfmink_curve__curvatures(&work, bad)) != SURFMINK_OK) return status;
        if ((status = surfmink_curve__look_around(&work, outline, &c, bad)) != SURFMINK_OK) return status;
        status = surfmink_curve__fourth(&c, outline, max_rank, &w, out);
    }
    if (status != SURFMINK_OK) return surfmink_curve__blame(status, outline->n, bad);
    if (out->error) surfmink_curve__estimate(&work, &c, max_rank, out->error);
    if (out->w) *out->w = w;
    return SURFMINK_OK;
}

static inline int surfmink_curve__all_finite(const double *x, size_t n)
{
    for (; x && n > 0; --n)
        if (!(fabs(x[n - 1]) < HUGE_VAL)) return 0;
    return 1;
}

static inline int surfmink_curve_edges(const surfmink_curve_measured *edges, int max_rank, double *scratch,
                                       const surfmink_curve_results *out)
{
    surfmink_curve__arcs c;
    surfmink_functionals w;
    size_t n = edges->n, i;
    int status = surfmink_total(NULL, edges->length, edges->turning, n, &w);
    if (status != SURFMINK_OK) return status;
    if (max_rank < 0 || !edges->bend != !edges->twist) return SURFMINK_BAD_ARGUMENT;
    for (i = 0; i < n; ++i)
        if (!(edges->length[i] > 0)) return SURFMINK_COINCIDENT_CORNERS;
    if (!surfmink_curve__all_finite(edges->bend, n) || !surfmink_curve__all_finite(edges->twist, n) ||
        !surfmink_curve__all_finite(edges->bend ? NULL : edges->curvature, n))
        return SURFMINK_NOT_FINITE;
    if (surfmink_curve__find_unlike(edges->length, edges->sharp, n) < n) return SURFMINK_CURVE_UNLIKE_EDGES;
    memset(&c, 0, sizeof c);
    c.n = n;
    c.windings = 1;
    c.arc = scratch;
    c.turn = scratch + n;
    c.swept = scratch + 2 * n;
    memcpy(c.arc, edges->length, n * sizeof *c.arc);
    memcpy(c.turn, edges->turning, n * sizeof *c.turn);
    c.bend = edges->bend;
    c.twist = edges->twist;
    c.curvature = edges->curvature;
    c.sharp = edges->sharp;
    c.unit = c.measure = surfmink_curve__unit(NULL, w.length);
    status = surfmink_curve__fourth(&c, NULL, max_rank, &w, out);
    if (status == SURFMINK_OK && out->w) *out->w = w;
    return status;
}

#endif
