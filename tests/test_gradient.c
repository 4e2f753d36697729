/* Gradients: reverse accumulation says what differentiating the formulas says; and how sure mu_p is.
   cc -I. tests/test_gradient.c -lm && ./a.out

   The formulas are written again here, from the paper, with angles between projected edges and a sine and cosine for
   every rank, in dual numbers of long double: value and derivative along a direction, exact up to rounding. Differences
   are relative to the norm of the gradient. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "../examples/beyond/gradient.h"

#include "harness.h"
#include "shapes.h"

#ifndef OUTLINES
#define OUTLINES (1 + 299 / FEWER) /* of each surface; more of them find worse ones: docs/internals/beyond.md */
#endif

enum { SURFACES = 3 }; /* of enum surfmink_kind: all but callbacks */
static const char *const surface_name[SURFACES] = {"plane", "sphere", "embedded"};

enum { CORNERS = 1200, TOP = 60 /* ranks */, NUMBERS = 3 * CORNERS };

/* --- dual numbers ------------------------------------------------------------------------------------------------- */

typedef struct dual {
    long double v, d; /* value, derivative */
} dual;

static dual number(long double v, long double d)
{
    dual x;
    x.v = v;
    x.d = d;
    return x;
}

static dual given(double v, double d)
{
    dual x;
    x.v = (long double)v;
    x.d = (long double)d;
    return x;
}

static dual plus(dual a, dual b)
{
    return number(a.v + b.v, a.d + b.d);
}

static dual minus(dual a, dual b)
{
    return number(a.v - b.v, a.d - b.d);
}

static dual times(dual a, dual b)
{
    return number(a.v * b.v, a.d * b.v + a.v * b.d);
}

static dual over(dual a, dual b)
{
    return number(a.v / b.v, (a.d - a.v / b.v * b.d) / b.v);
}

static dual root(dual a)
{
    long double v = sqrtl(a.v);
    return number(v, a.d / (2 * v));
}

static dual angle_of(dual y, dual x)
{
    long double square = x.v * x.v + y.v * y.v;
    return number(atan2l(y.v, x.v), (x.v * y.d - y.v * x.d) / square);
}

static dual dot(const dual *a, const dual *b)
{
    return plus(plus(times(a[0], b[0]), times(a[1], b[1])), times(a[2], b[2]));
}

static void cross(const dual *a, const dual *b, dual *c)
{
    c[0] = minus(times(a[1], b[2]), times(a[2], b[1]));
    c[1] = minus(times(a[2], b[0]), times(a[0], b[2]));
    c[2] = minus(times(a[0], b[1]), times(a[1], b[0]));
}

/* --- the formulas, in dual numbers -------------------------------------------------------------------------------- */

/* One outline, and weights of an energy. */
typedef struct outline {
    enum surfmink_kind surface;
    size_t n;
    int max_rank;
    double corner[NUMBERS], normal[NUMBERS], radius;
    double mu[TOP + 1], g[2 * TOP + 2], theta[TOP + 1], length;
    surfmink_weights weights; /* points to these; or not */
} outline;

static size_t dim_of(const outline *o)
{
    return o->surface == SURFMINK_PLANE ? 2 : 3;
}

/* Corner i and its normal, moved along a direction (by corners and normals; NULL: not). */
static void moved(const outline *o, size_t i, const double *along, const double *along_normal, dual x[3], dual n[3])
{
    size_t k;
    for (k = 0; k < 3; ++k) {
        x[k] = n[k] = number(0, 0);
        if (k < dim_of(o)) x[k] = given(o->corner[dim_of(o) * i + k], along ? along[dim_of(o) * i + k] : 0);
        if (o->surface == SURFMINK_SPHERE) n[k] = x[k];
        if (o->surface == SURFMINK_EMBEDDED)
            n[k] = given(o->normal[3 * i + k], along_normal ? along_normal[3 * i + k] : 0);
    }
    if (o->surface == SURFMINK_PLANE) n[2] = number(1, 0);
}

static void unit(const dual *v, dual *u)
{
    dual norm = root(dot(v, v));
    int k;
    for (k = 0; k < 3; ++k) u[k] = over(v[k], norm);
}

/* v without its part along the unit vector n. */
static void project(const dual *v, const dual *n, dual *p)
{
    dual part = dot(v, n);
    int k;
    for (k = 0; k < 3; ++k) p[k] = minus(v[k], times(part, n[k]));
}

static void lengths_and_turns(const outline *o, const double *along, const double *along_normal, dual *length,
                              dual *turning)
{
    dual x[3][3], n[3][3], in[3], out[3], m[3], axis[3];
    size_t i, j, k;
    for (i = 0; i < o->n; ++i) {
        for (j = 0; j < 3; ++j) moved(o, (i + o->n - 1 + j) % o->n, along, along_normal, x[j], n[j]);
        for (k = 0; k < 3; ++k) {
            in[k] = minus(x[1][k], x[0][k]);
            out[k] = minus(x[2][k], x[1][k]);
        }
        length[i] = root(dot(out, out));
        if (o->surface == SURFMINK_SPHERE) {
            cross(x[1], out, m);
            length[i] = times(given(o->radius, 0), angle_of(root(dot(m, m)), dot(x[1], x[2])));
        }
        unit(n[1], axis);
        project(in, axis, in);
        project(out, axis, out);
        cross(in, out, m);
        turning[i] = angle_of(dot(axis, m), dot(in, out));
    }
}

/* E and its derivative, from lengths and turns. A modulus that is 0 up to rounding has none. */
static dual energy_of(const outline *o, const dual *length, const dual *turning)
{
    dual whole = number(0, 0), total = number(0, 0), energy = number(0, 0), re, im, f, modulus;
    const surfmink_weights *w = &o->weights;
    size_t i;
    int p;
    for (i = 0; i < o->n; ++i) {
        whole = plus(whole, turning[i]);
        total = plus(total, length[i]);
    }
    if (w->length) energy = plus(energy, times(given(*w->length, 0), total));
    for (p = 0; p <= o->max_rank; ++p) {
        dual turned = number(0, 0);
        re = im = number(0, 0);
        for (i = 0; i < o->n; ++i) {
            long double c, s;
            if (i > 0) turned = plus(turned, turning[i]);
            f = times(number(2 * 3.14159265358979323846264L * p, 0), over(turned, whole));
            c = cosl(f.v);
            s = sinl(f.v);
            re = plus(re, times(length[i], number(c, -s * f.d)));
            im = plus(im, times(length[i], number(s, c * f.d)));
        }
        if (w->g) {
            energy = plus(energy, times(given(w->g[2 * p], 0), re));
            energy = plus(energy, times(given(w->g[2 * p + 1], 0), im));
        }
        if (p == 0 || sqrtl(re.v * re.v + im.v * im.v) < 1e-13L * total.v) continue;
        modulus = root(plus(times(re, re), times(im, im)));
        if (w->mu) energy = plus(energy, times(given(w->mu[p], 0), over(modulus, total)));
        if (w->theta) energy = plus(energy, times(given(w->theta[p] / p, 0), angle_of(im, re)));
    }
    return energy;
}

static double derivative(const outline *o, const double *along, const double *along_normal)
{
    static dual length[CORNERS], turning[CORNERS];
    lengths_and_turns(o, along, along_normal, length, turning);
    return (double)energy_of(o, length, turning).d;
}

/* --- outlines and energies ---------------------------------------------------------------------------------------- */

/* Flowers with uneven corners, for any n. */
static void wavy(chance *c, size_t n, double *xy)
{
    double start = between(c, 0, 2 * PI), depth = between(c, 0.05, 0.25);
    size_t i;
    int petals = 2 + (int)one_of(c, 6);
    for (i = 0; i < n; ++i) {
        double t = start + 2 * PI * ((double)i + between(c, 0, 0.4)) / (double)n;
        double r = 1 + depth * cos(petals * t) + between(c, -0.3, 0.3) / (double)n;
        xy[2 * i] = r * cos(t);
        xy[2 * i + 1] = r * sin(t);
    }
}

/* Normals of any length, as if the corners lay on an ellipsoid. */
static void tilt_normals(chance *c, outline *o)
{
    size_t i, k;
    for (i = 0; i < o->n; ++i) {
        double size = between(c, 0.1, 10);
        for (k = 0; k < 3; ++k) o->normal[3 * i + k] = size * o->corner[3 * i + k] / (double)((k + 2) * (k + 2));
    }
    for (i = 0; i < o->n; ++i)
        for (k = 0; k < 3; ++k) o->corner[3 * i + k] *= (double)(k + 2) / 2;
}

static void lay(chance *c, enum surfmink_kind surface, const double *xy, size_t n, outline *o)
{
    double size = between(c, 0.02, surface == SURFMINK_EMBEDDED ? 0.3 : 0.7), x = between(c, -9, 9);
    size_t i, k;
    o->surface = surface;
    o->n = n;
    o->radius = surface == SURFMINK_SPHERE ? between(c, 0.5, 20) : 1;
    for (i = 0; i < 2 * n && surface == SURFMINK_PLANE; ++i) o->corner[i] = size * xy[i] + x;
    if (surface == SURFMINK_PLANE) return;
    onto_sphere(xy, n, size, o->corner);
    turn_somehow(c, o->corner, n);
    if (surface == SURFMINK_EMBEDDED) {
        tilt_normals(c, o);
        return;
    }
    for (i = 0; i < n; ++i) { /* corners may lie off the sphere */
        double off = one_of(c, 2) ? o->radius : o->radius * between(c, 0.97, 1.03);
        for (k = 0; k < 3; ++k) o->corner[3 * i + k] *= off;
    }
}

static surfmink_outline view_of(const outline *o)
{
    if (o->surface == SURFMINK_PLANE) return surfmink_plane(o->corner, o->n);
    if (o->surface == SURFMINK_SPHERE) return surfmink_sphere(o->corner, o->n, o->radius);
    return surfmink_embedded(o->corner, o->normal, o->n);
}

static int measure(const outline *o, double *mu, double *g, surfmink_functionals *w)
{
    surfmink_outline view = view_of(o);
    return surfmink_measure(&view, o->max_rank, mu, g, w, NULL);
}

/* Weights of everything, all of about the same consequence. Directions of a g_p that is next to nothing have an
   ill-conditioned derivative: they get none. */
static void weigh(chance *c, outline *o)
{
    double mu[TOP + 1];
    surfmink_functionals w;
    int p;
    CHECK_OK(measure(o, mu, NULL, &w));
    o->length = between(c, -1, 1) / w.length;
    for (p = 0; p <= o->max_rank; ++p) {
        o->mu[p] = mu[p] < 1e-4 ? 0 : between(c, -1, 1);
        o->theta[p] = mu[p] < 1e-4 ? 0 : mu[p] * between(c, -1, 1);
        o->g[2 * p] = between(c, -1, 1) / w.length;
        o->g[2 * p + 1] = between(c, -1, 1) / w.length;
    }
    o->weights.mu = o->mu;
    o->weights.g = o->g;
    o->weights.theta = o->theta;
    o->weights.length = &o->length;
    o->weights.shared = 0;
}

/* 300 of them: small n, all kinds of ranks. */
static void some_outline(chance *c, int which, enum surfmink_kind surface, outline *o)
{
    static const int rank[5] = {6, 1, 12, 0, 40};
    double xy[2 * MOST];
    size_t n = 3 + one_of(c, which % 3 ? 6 : 20);
    if (surface == SURFMINK_PLANE && which % 2)
        random_star(c, n, xy);
    else if (which % 4 == 2)
        wavy(c, n, xy);
    else
        gentle_star(c, n, xy);
    lay(c, surface, xy, n, o);
    o->max_rank = rank[which % 5];
    weigh(c, o);
}

static double norm_of(const double *v, size_t n)
{
    double sum = 0, most = 0;
    size_t i;
    for (i = 0; i < n; ++i)
        if (fabs(v[i]) > most) most = fabs(v[i]);
    for (i = 0; i < n && most > 0; ++i) sum += v[i] / most * (v[i] / most);
    return most * sqrt(sum);
}

static double distance(const double *a, const double *b, size_t n)
{
    static double d[NUMBERS];
    size_t i;
    for (i = 0; i < n; ++i) d[i] = a[i] - b[i];
    return norm_of(d, n);
}

typedef struct pulled {
    double mu[TOP + 1], g[2 * TOP + 2], by_corner[NUMBERS], by_normal[NUMBERS];
    surfmink_functionals w;
    size_t bad;
} pulled;

static double scratch[18 * CORNERS + 2 * TOP + 2];

static int gradient(const outline *o, pulled *to)
{
    surfmink_outline view = view_of(o);
    surfmink_gradients out;
    out.status = NULL;
    out.bad = &to->bad;
    out.mu = to->mu;
    out.g = to->g;
    out.w = &to->w;
    out.by_corner = to->by_corner;
    out.by_normal = to->by_normal;
    return surfmink_gradient(&view, o->max_rank, &o->weights, &out, scratch);
}

/* The whole gradient in dual numbers, one coordinate after the other. */
static void differentiate(const outline *o, double *by_corner, double *by_normal)
{
    static double along[NUMBERS];
    size_t i, numbers = dim_of(o) * o->n;
    memset(along, 0, sizeof along);
    for (i = 0; i < numbers; ++i) {
        along[i] = 1;
        by_corner[i] = derivative(o, along, NULL);
        by_normal[i] = o->surface == SURFMINK_EMBEDDED ? derivative(o, NULL, along) : 0;
        along[i] = 0;
    }
}

static double worst; /* of a theorem: distance from the reference by its norm */

static void check_gradient(const outline *o, const pulled *got, double within)
{
    static double by_corner[NUMBERS], by_normal[NUMBERS];
    size_t numbers = dim_of(o) * o->n;
    double off;
    differentiate(o, by_corner, by_normal);
    off = distance(got->by_corner, by_corner, numbers) / norm_of(by_corner, numbers);
    CHECK_NEAR(off, 0, within);
    if (off > worst) worst = off;
    if (o->surface != SURFMINK_EMBEDDED) return;
    if (o->max_rank == 0) { /* lengths alone: no normal matters */
        CHECK_NEAR(norm_of(got->by_normal, numbers), 0, 0);
        return;
    }
    off = distance(got->by_normal, by_normal, numbers) / norm_of(by_normal, numbers);
    CHECK_NEAR(off, 0, within);
    if (off > worst) worst = off;
}

/* --- the gradient is the derivative ------------------------------------------------------------------------------- */

THEOREM(the_gradient_is_the_derivative_by_every_coordinate)
{
    static outline o;
    static pulled got;
    int surface, which;
    for (surface = 0; surface < SURFACES; ++surface) {
        chance c = {1 + (uint64_t)surface};
        worst = 0;
        for (which = 0; which < OUTLINES; ++which) {
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            CASE("%s %d, %lu corners, P = %d", surface_name[surface], which, (unsigned long)o.n, o.max_rank);
            CHECK_OK(gradient(&o, &got));
            check_gradient(&o, &got, 1e-10);
        }
        NOTE("%s: gradients off by at most %.1e of their norm", surface_name[surface], worst);
    }
}

/* Outlines of more than 128 corners are measured in blocks; there are too many coordinates to try them all. */
THEOREM(gradients_of_long_outlines_are_derivatives)
{
    static const size_t size[5] = {63, 127, 129, 130, 1000};
    static double along[NUMBERS], tilt[NUMBERS], xy[2 * CORNERS], zero[NUMBERS];
    static outline o;
    static pulled got;
    chance c = {7};
    int surface, which, k;
    size_t i;
    worst = 0;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 5; ++which) {
            wavy(&c, size[which], xy);
            lay(&c, (enum surfmink_kind)surface, xy, size[which], &o);
            o.max_rank = which == 2 ? 0 : which == 3 ? 60 : 6;
            weigh(&c, &o);
            CASE("%s, %lu corners, P = %d", surface_name[surface], (unsigned long)o.n, o.max_rank);
            CHECK_OK(gradient(&o, &got));
            for (k = 0; k < 4; ++k) {
                double want, have = 0, size_of_it;
                for (i = 0; i < dim_of(&o) * o.n; ++i) {
                    along[i] = between(&c, -1, 1);
                    tilt[i] = between(&c, -1, 1);
                    have += along[i] * got.by_corner[i];
                    if (surface == SURFMINK_EMBEDDED) have += tilt[i] * got.by_normal[i];
                }
                want = derivative(&o, along, surface == SURFMINK_EMBEDDED ? tilt : NULL);
                size_of_it = norm_of(got.by_corner, dim_of(&o) * o.n);
                CHECK_NEAR(have / size_of_it, want / size_of_it, 1e-10);
                if (fabs(have - want) / size_of_it > worst) worst = fabs(have - want) / size_of_it;
            }
            if (o.n == 1000) continue;
            CHECK(norm_of(got.by_corner, dim_of(&o) * o.n) > 0);
            CHECK_NEAR(distance(got.by_normal, zero, 0), 0, 0);
        }
    NOTE("long outlines: derivatives off by at most %.1e of the norm of the gradient", worst);
}

/* --- what does not change the outline does not change E ----------------------------------------------------------- */

THEOREM(gradients_do_not_move_turn_or_scale_the_outline)
{
    static outline o;
    static pulled got;
    chance c = {8};
    int surface, which, k;
    size_t i;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 60; ++which) {
            double shift[3] = {0, 0, 0}, turn[3] = {0, 0, 0}, grow = 0, size = 0, per_turn, by_length = 0;
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            if (which % 2) { /* mu and theta alone do not change with the size; L does */
                o.weights.g = NULL;
                by_length = o.length;
            }
            CASE("%s %d", surface_name[surface], which);
            CHECK_OK(gradient(&o, &got));
            for (i = 0; i < o.n; ++i) {
                double x[3] = {0, 0, 0}, b[3] = {0, 0, 0}, m[3];
                for (k = 0; k < (int)dim_of(&o); ++k) {
                    x[k] = o.corner[dim_of(&o) * i + (size_t)k];
                    b[k] = got.by_corner[dim_of(&o) * i + (size_t)k];
                    shift[k] += b[k];
                    grow += b[k] * x[k];
                    size += fabs(b[k]);
                }
                cross3(x, b, m);
                for (k = 0; k < 3; ++k) turn[k] += m[k];
                if (surface == SURFMINK_SPHERE) CHECK_NEAR(dot3(x, b), 0, 2e-14 * sqrt(dot3(x, x) * dot3(b, b)));
                if (surface != SURFMINK_EMBEDDED) continue;
                cross3(o.normal + 3 * i, got.by_normal + 3 * i, m);
                for (k = 0; k < 3; ++k) {
                    turn[k] += m[k];
                    size += fabs(m[k]);
                }
                CHECK_NEAR(dot3(o.normal + 3 * i, got.by_normal + 3 * i), 0,
                           1e-14 * sqrt(dot3(o.normal + 3 * i, o.normal + 3 * i) *
                                        dot3(got.by_normal + 3 * i, got.by_normal + 3 * i)));
            }
            for (k = 0; k < 3; ++k) {
                per_turn = size * (norm_of(o.corner, dim_of(&o)) + 1);
                if (surface != SURFMINK_SPHERE) CHECK_NEAR(shift[k], 0, 1e-13 * size);
                if (surface != SURFMINK_PLANE || k == 2) CHECK_NEAR(turn[k], 0, 1e-13 * per_turn);
                if (which % 2 && surface != SURFMINK_SPHERE)
                    CHECK_NEAR(grow, by_length * got.w.length, 1e-13 * per_turn);
            }
        }
}

/* --- the steps ---------------------------------------------------------------------------------------------------- */

/* The same by surfmink_edges, phases, irreducible, and back by surfmink_pull_*. */
static void step_by_step(const outline *o, double *by_corner, double *by_normal)
{
    static double length[CORNERS], turning[CORNERS], phase[CORNERS], by_length[CORNERS], by_turning[CORNERS];
    static double g[2 * TOP + 2], by_g[2 * TOP + 2];
    surfmink_outline view = view_of(o);
    size_t n = o->n, bad = 99;
    CHECK_OK(surfmink_edges(&view, length, turning, &bad));
    CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
    CHECK_OK(surfmink_irreducible(length, phase, n, o->max_rank, g));
    CHECK_OK(surfmink_pull_spectrum(&o->weights, g, o->max_rank, by_g));
    CHECK_OK(surfmink_pull_edges(by_g, o->max_rank, length, turning, n, by_length, by_turning));
    CHECK_OK(surfmink_pull_corners(&view, by_length, by_turning, by_corner, by_normal, scratch, &bad));
    CHECK_EQUAL(bad, 99);
}

THEOREM(the_steps_lead_to_the_same_gradient)
{
    static outline o;
    static pulled got;
    static double by_corner[NUMBERS], by_normal[NUMBERS], xy[2 * CORNERS];
    chance c = {9};
    int surface, which;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 100; ++which) {
            size_t numbers;
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            if (which == 50 || which == 51) {
                wavy(&c, 150, xy);
                lay(&c, (enum surfmink_kind)surface, xy, 150, &o);
                o.max_rank = which == 50 ? 0 : TOP;
                weigh(&c, &o);
            }
            if (which % 7 == 1) o.weights.mu = NULL;
            if (which % 7 == 2) o.weights.g = NULL;
            if (which % 7 == 3) o.weights.theta = NULL;
            if (which % 7 == 4) o.weights.length = NULL;
            numbers = dim_of(&o) * o.n;
            CASE("%s %d", surface_name[surface], which);
            CHECK_OK(gradient(&o, &got));
            step_by_step(&o, by_corner, by_normal);
            CHECK_NEAR(distance(got.by_corner, by_corner, numbers), 0, 1e-10 * norm_of(by_corner, numbers));
            if (surface == SURFMINK_EMBEDDED)
                CHECK_NEAR(distance(got.by_normal, by_normal, numbers), 0, 1e-10 * norm_of(by_normal, numbers));
        }
}

/* An energy of lengths and turns that has nothing to do with mu. */
THEOREM(any_weights_of_lengths_and_turns_are_pulled_back)
{
    static outline o;
    static dual length[CORNERS], turning[CORNERS];
    static double by_length[CORNERS], by_turning[CORNERS], by_corner[NUMBERS], by_normal[NUMBERS], along[NUMBERS],
        tilt[NUMBERS];
    surfmink_outline view;
    chance c = {10};
    int surface, which, k;
    size_t i;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 100; ++which) {
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            CASE("%s %d", surface_name[surface], which);
            for (i = 0; i < o.n; ++i) {
                by_length[i] = between(&c, -1, 1);
                by_turning[i] = between(&c, -1, 1);
            }
            view = view_of(&o);
            CHECK_OK(surfmink_pull_corners(&view, by_length, by_turning, along, NULL, scratch, NULL));
            CHECK_OK(surfmink_pull_corners(&view, by_length, by_turning, by_corner, by_normal, scratch, NULL));
            CHECK_SAME(by_corner, along, dim_of(&o) * o.n);
            for (k = 0; k < 3; ++k) {
                double want = 0, got = 0, size = norm_of(by_corner, dim_of(&o) * o.n);
                for (i = 0; i < dim_of(&o) * o.n; ++i) {
                    along[i] = between(&c, -1, 1);
                    tilt[i] = between(&c, -1, 1);
                    got += along[i] * by_corner[i];
                    if (surface == SURFMINK_EMBEDDED) got += tilt[i] * by_normal[i];
                }
                lengths_and_turns(&o, along, tilt, length, turning);
                for (i = 0; i < o.n; ++i)
                    want +=
                        (double)((long double)by_length[i] * length[i].d + (long double)by_turning[i] * turning[i].d);
                CHECK_NEAR(got / size, want / size, 1e-11);
            }
        }
}

/* The steps before the last know no surface: lengths and turns that vary as they like. */
THEOREM(weights_of_edges_are_derivatives_by_lengths_and_turns)
{
    static outline o;
    static dual length[CORNERS], turning[CORNERS];
    double l[MOST], alpha[MOST], phase[MOST], g[2 * TOP + 2], by_g[2 * TOP + 2], by_length[MOST], by_turning[MOST];
    chance c = {11};
    int which;
    size_t i, j;
    for (which = 0; which < 100; ++which) {
        surfmink_functionals w;
        o.n = 3 + one_of(&c, 12);
        o.max_rank = which % 3 ? 8 : 45;
        for (i = 0; i < o.n; ++i) {
            l[i] = one_of(&c, 9) ? between(&c, 0.2, 2) : 0;
            alpha[i] = between(&c, -0.3, 1);
        }
        alpha[0] += 2;
        CASE("%d", which);
        CHECK_OK(surfmink_total(NULL, l, alpha, o.n, &w));
        CHECK_OK(surfmink_phases(alpha, o.n, SURFMINK_CORRECTED, phase));
        CHECK_OK(surfmink_irreducible(l, phase, o.n, o.max_rank, g));
        o.length = between(&c, -1, 1);
        for (i = 0; i <= (size_t)o.max_rank; ++i) {
            o.mu[i] = between(&c, -1, 1);
            o.theta[i] = between(&c, -0.1, 0.1);
            o.g[2 * i] = between(&c, -1, 1);
            o.g[2 * i + 1] = between(&c, -1, 1);
        }
        o.weights.mu = o.mu;
        o.weights.theta = o.theta;
        o.weights.g = o.g;
        o.weights.length = &o.length;
        CHECK_OK(surfmink_pull_spectrum(&o.weights, g, o.max_rank, by_g));
        CHECK_OK(surfmink_pull_edges(by_g, o.max_rank, l, alpha, o.n, by_length, by_turning));
        for (j = 0; j < 2 * o.n; ++j) {
            double want, got = j < o.n ? by_length[j] : by_turning[j - o.n];
            for (i = 0; i < o.n; ++i) {
                length[i] = given(l[i], j == i);
                turning[i] = given(alpha[i], j == o.n + i);
            }
            want = (double)energy_of(&o, length, turning).d;
            CHECK_NEAR(got, want, 1e-10 * (norm_of(by_length, o.n) + norm_of(by_turning, o.n)));
        }
    }
}

/* --- what is said about weights ----------------------------------------------------------------------------------- */

THEOREM(what_is_measured_on_the_way_is_what_measuring_says)
{
    static outline o;
    static pulled got;
    static double xy[2 * CORNERS];
    double mu[TOP + 1], g[2 * TOP + 2];
    surfmink_functionals w;
    chance c = {12};
    int surface, which;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 40; ++which) {
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            if (which > 35) {
                wavy(&c, which > 37 ? 700 : 65, xy);
                lay(&c, (enum surfmink_kind)surface, xy, which > 37 ? 700 : 65, &o);
                o.max_rank = which % 2 ? 0 : TOP;
                weigh(&c, &o);
            }
            CASE("%s %d", surface_name[surface], which);
            CHECK_OK(gradient(&o, &got));
            CHECK_OK(measure(&o, mu, g, &w));
            CHECK_SAME(got.mu, mu, (size_t)o.max_rank + 1);
            CHECK_SAME(got.g, g, 2 * ((size_t)o.max_rank + 1));
            CHECK_SAME(&got.w.area, &w.area, 1);
            CHECK_SAME(&got.w.length, &w.length, 1);
            CHECK_SAME(&got.w.turning, &w.turning, 1);
            CHECK_SAME(&got.w.curvature, &w.curvature, 1);
            CHECK_SAME(&got.w.condition, &w.condition, 1);
        }
}

THEOREM(gradients_are_linear_in_the_weights)
{
    static outline o;
    static pulled got[5];
    chance c = {13};
    int surface, which, k;
    size_t i;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 30; ++which) {
            surfmink_weights all, none = {NULL, NULL, NULL, NULL, 0};
            double sum[NUMBERS], tilt[NUMBERS], size = 0;
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            all = o.weights;
            CASE("%s %d", surface_name[surface], which);
            for (k = 0; k < 5; ++k) {
                o.weights = none;
                if (k == 0) o.weights = all;
                if (k == 1) o.weights.mu = all.mu;
                if (k == 2) o.weights.g = all.g;
                if (k == 3) o.weights.theta = all.theta;
                if (k == 4) o.weights.length = all.length;
                CHECK_OK(gradient(&o, &got[k]));
            }
            for (i = 0; i < dim_of(&o) * o.n; ++i)
                for (sum[i] = tilt[i] = 0, k = 1; k < 5; ++k) {
                    sum[i] += got[k].by_corner[i];
                    tilt[i] += surface == SURFMINK_EMBEDDED ? got[k].by_normal[i] : 0;
                    size += fabs(got[k].by_corner[i]);
                }
            CHECK_NEAR(distance(sum, got[0].by_corner, dim_of(&o) * o.n), 0, 1e-10 * size);
            if (surface == SURFMINK_EMBEDDED) CHECK_NEAR(distance(tilt, got[0].by_normal, 3 * o.n), 0, 1e-9 * size);
            o.weights = none;
            CHECK_OK(gradient(&o, &got[0]));
            CHECK_NEAR(norm_of(got[0].by_corner, dim_of(&o) * o.n), 0, 0);
        }
}

/* A square has mu_2 = mu_6 = 0: the modulus has a kink there, and a direction is nothing. g_2 is smooth. */
THEOREM(where_mu_is_zero_its_weight_counts_as_nothing)
{
    static const double square[2][8] = {{0, 0, 1, 0, 1, 1, 0, 1}, {0.1, -0.3, 0.9, 0.5, 0.1, 1.3, -0.7, 0.5}};
    static outline o;
    static pulled got, smooth;
    double by_corner[NUMBERS], by_normal[NUMBERS];
    int which, rank, step;
    for (which = 0; which < 2; ++which)
        for (rank = 1; rank < 8; ++rank)
            for (step = 0; step < 2; ++step) {
                memset(&o, 0, sizeof o);
                o.surface = SURFMINK_PLANE;
                o.n = 4;
                o.max_rank = 8;
                memcpy(o.corner, square[which], sizeof square[which]);
                o.mu[rank] = 3;
                o.theta[rank] = 5;
                o.weights.mu = o.mu;
                o.weights.theta = step ? o.theta : NULL;
                CASE("square %d, rank %d", which, rank);
                CHECK_OK(gradient(&o, &got));
                if (rank != 4) CHECK_NEAR(norm_of(got.by_corner, 8), 0, 0);
                step_by_step(&o, by_corner, by_normal);
                if (rank != 4) CHECK_NEAR(norm_of(by_corner, 8), 0, 0);
                o.g[2 * rank] = 1;
                o.g[2 * rank + 1] = -2;
                o.weights.g = o.g;
                CHECK_OK(gradient(&o, &smooth));
                if (rank == 1) /* g_1 is 0 for all polygons of the plane */
                    CHECK_NEAR(norm_of(smooth.by_corner, 8), 0, 1e-14);
                else
                    check_gradient(&o, &smooth, 1e-13);
                if (rank == 2) CHECK(norm_of(smooth.by_corner, 8) > 1);
            }
}

/* Below 1e-14 of L nothing counts, above everything. */
THEOREM(noise_ends_at_1e_14)
{
    const double weight[2] = {0, 1};
    double g[4] = {1, 0, 0, 0}, by_g[4];
    surfmink_weights weights = {NULL, NULL, NULL, NULL, 0};
    weights.mu = weight;
    g[2] = 0.99e-14;
    CHECK_OK(surfmink_pull_spectrum(&weights, g, 1, by_g));
    CHECK_NEAR(by_g[2], 0, 0);
    g[2] = 1.01e-14;
    CHECK_OK(surfmink_pull_spectrum(&weights, g, 1, by_g));
    CHECK_NEAR(by_g[2], 1, 1e-15);
    CHECK_NEAR(by_g[0], -g[2], 1e-29);
    weights.mu = NULL;
    weights.theta = weight;
    CHECK_OK(surfmink_pull_spectrum(&weights, g, 1, by_g));
    CHECK_CLOSE(by_g[3], 1 / g[2], 1e-15);
    g[2] = 0.99e-14;
    CHECK_OK(surfmink_pull_spectrum(&weights, g, 1, by_g));
    CHECK_NEAR(by_g[3], 0, 0);
}

/* In another unit, a power of two: the same bits, with the power of the unit that belongs there. Normals may each have
   a length of their own, which costs rounding. */
THEOREM(units_do_not_matter)
{
    static const int unit[6] = {1, -3, 60, -60, 400, -400};
    static outline o, scaled;
    static pulled got, want;
    chance c = {14};
    int surface, which, k;
    size_t i, numbers;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 30; ++which)
            for (k = 0; k < 6; ++k) {
                double scale = power_of_two(unit[k]);
                some_outline(&c, which, (enum surfmink_kind)surface, &o);
                o.weights.g = NULL;
                o.weights.length = NULL;
                scaled = o;
                scaled.weights.mu = scaled.mu;
                scaled.weights.theta = scaled.theta;
                numbers = dim_of(&o) * o.n;
                for (i = 0; i < numbers; ++i) scaled.corner[i] *= scale;
                for (i = 0; i < 3 * o.n; ++i)
                    if (which % 2 && i / 3 % 2 == 0) scaled.normal[i] /= scale;
                CASE("%s %d, 2^%d", surface_name[surface], which, unit[k]);
                CHECK_OK(gradient(&o, &want));
                CHECK_OK(gradient(&scaled, &got));
                for (i = 0; i < numbers; ++i) got.by_corner[i] *= scale;
                for (i = 0; i < 3 * o.n; ++i)
                    if (which % 2 && i / 3 % 2 == 0) got.by_normal[i] /= scale;
                CHECK_NEAR(distance(got.by_corner, want.by_corner, numbers), 0,
                           1e-13 * norm_of(want.by_corner, numbers));
                if (surface == SURFMINK_EMBEDDED)
                    CHECK_NEAR(distance(got.by_normal, want.by_normal, numbers), 0,
                               1e-13 * norm_of(want.by_normal, numbers));
                if (which % 2 && surface == SURFMINK_EMBEDDED) continue;
                CHECK_SAME(got.by_corner, want.by_corner, numbers);
                if (surface == SURFMINK_EMBEDDED) CHECK_SAME(got.by_normal, want.by_normal, numbers);
            }
}

/* On the sphere the unit comes in with the radius. */
THEOREM(weights_of_lengths_have_the_unit_of_lengths)
{
    static outline o;
    static pulled got;
    chance c = {15};
    int surface, which;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 30; ++which) {
            size_t i;
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            for (i = 0; i < dim_of(&o) * o.n && surface != SURFMINK_SPHERE; ++i) o.corner[i] *= 1000;
            if (surface == SURFMINK_SPHERE) o.radius *= 1000;
            CASE("%s %d", surface_name[surface], which);
            CHECK_OK(gradient(&o, &got));
            check_gradient(&o, &got, 1e-10);
        }
}

/* --- outlines that are measured with twice the digits ------------------------------------------------------------- */

static void careful(chance *c, const char *what, outline *o, double within)
{
    static pulled got;
    static double by_corner[NUMBERS], by_normal[NUMBERS];
    size_t numbers = dim_of(o) * o->n;
    weigh(c, o);
    CASE("%s, %s", surface_name[o->surface], what);
    CHECK_OK(gradient(o, &got));
    check_gradient(o, &got, within);
    step_by_step(o, by_corner, by_normal);
    CHECK_NEAR(distance(got.by_corner, by_corner, numbers), 0, within * norm_of(by_corner, numbers));
}

/* Each deviates from what kernels take; the tolerance is that of the angles, times what amplifies them. */
THEOREM(outlines_that_are_not_ordinary_have_gradients)
{
    static const int rank[4] = {6, 0, 40, 12};
    static const double whisker[16] = {0, 0, 4, -1, 4, 2, 7, 2, 4, 2, 4, 4, 2, 5, 0, 4}; /* its tip turns by pi */
    static outline o;
    double xy[2 * MOST];
    chance c = {16};
    int which;
    size_t i;
    for (which = 0; which < 12; ++which) {
        size_t n = 5 + one_of(&c, 6);
        o.max_rank = rank[which % 4];
        lay(&c, SURFMINK_PLANE, whisker, 8, &o);
        memcpy(o.corner, whisker, sizeof whisker);
        careful(&c, "a whisker", &o, 1e-13);

        gentle_star(&c, n, xy); /* edges of more than 60 degrees */
        lay(&c, SURFMINK_SPHERE, xy, n, &o);
        onto_sphere(xy, n, 20, o.corner);
        careful(&c, "long edges", &o, 1e-9);

        gentle_star(&c, n, xy); /* corners far off the sphere: steep edges */
        lay(&c, SURFMINK_SPHERE, xy, n, &o);
        for (i = 0; i < 3; ++i) o.corner[i] *= 100;
        careful(&c, "a corner far off", &o, 1e-10);

        gentle_star(&c, n, xy); /* an edge along the normal, almost */
        lay(&c, SURFMINK_EMBEDDED, xy, n, &o);
        for (i = 0; i < 3; ++i) o.normal[i] = o.corner[3 + i] - o.corner[i] + 0.01 * o.normal[i];
        if (measure(&o, o.mu, NULL, NULL) == SURFMINK_OK) careful(&c, "a steep edge", &o, 1e-9);

        gentle_star(&c, n, xy); /* S next to nothing: almost half a sphere */
        onto_sphere(xy, n, 1, o.normal);
        lay(&c, SURFMINK_EMBEDDED, xy, n, &o);
        onto_sphere(xy, n, 1, o.normal);
        for (i = 0; i < n; ++i) {
            o.corner[3 * i] = o.normal[3 * i];
            o.corner[3 * i + 1] = o.normal[3 * i + 1];
            o.corner[3 * i + 2] = 0.01;
            o.normal[3 * i] = o.corner[3 * i];
            o.normal[3 * i + 1] = o.corner[3 * i + 1];
            o.normal[3 * i + 2] = 0.05;
        }
        if (measure(&o, o.mu, NULL, NULL) == SURFMINK_OK) careful(&c, "small S", &o, 1e-8);
    }
}

/* Sizes at which squares of lengths are no doubles. */
THEOREM(gradients_of_absurd_units_are_those_of_sensible_ones)
{
    static const int unit[4] = {-900, 480, -930, 300};
    static outline o, scaled;
    static pulled got, want;
    chance c = {17};
    int surface, which;
    size_t i, k;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 40; ++which) {
            double scale = power_of_two(unit[which % 4]);
            some_outline(&c, which, (enum surfmink_kind)surface, &o);
            if (which % 8 > 3) { /* and one edge that is short in any unit */
                for (k = 0; k < dim_of(&o); ++k) o.corner[dim_of(&o) + k] = o.corner[k];
                o.corner[dim_of(&o)] += 1e-14 * fabs(o.corner[0]);
                if (measure(&o, o.mu, NULL, NULL) != SURFMINK_OK) continue;
                weigh(&c, &o);
            }
            o.weights.g = NULL;
            o.weights.length = NULL;
            scaled = o;
            scaled.weights.mu = scaled.mu;
            scaled.weights.theta = scaled.theta;
            for (i = 0; i < dim_of(&o) * o.n; ++i) scaled.corner[i] *= scale;
            CASE("%s %d", surface_name[surface], which);
            CHECK_OK(gradient(&o, &want));
            CHECK_OK(gradient(&scaled, &got));
            for (i = 0; i < dim_of(&o) * o.n; ++i) got.by_corner[i] *= scale;
            CHECK_NEAR(distance(got.by_corner, want.by_corner, dim_of(&o) * o.n), 0,
                       1e-10 * norm_of(want.by_corner, dim_of(&o) * o.n));
        }
}

/* --- refusals ----------------------------------------------------------------------------------------------------- */

static void untouched(const double *v, size_t n)
{
    size_t i;
    for (i = 0; i < n; ++i) CHECK_NEAR(v[i], -77, 0);
}

THEOREM(what_is_refused_changes_nothing_and_is_named)
{
    static outline o;
    static pulled got;
    double xy[2 * MOST], l[4] = {1, 1, 1, 1}, alpha[4] = {2, 2, 2, -0.3}, by_l[4], by_alpha[4], g[4] = {1, 0, 0.5, 0},
                         by_g[4] = {-77, -77, -77, -77};
    double nan_of = nan("");
    surfmink_surface disk = hyperbolic_plane();
    surfmink_outline view;
    surfmink_gradients out = {NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    chance c = {18};
    int surface, what;
    size_t i;
    for (surface = 0; surface < SURFACES; ++surface)
        for (what = 0; what < 5; ++what) {
            gentle_star(&c, 6, xy);
            lay(&c, (enum surfmink_kind)surface, xy, 6, &o);
            o.max_rank = 3;
            weigh(&c, &o);
            if (what == 1) o.n = 2;
            if (what == 2) o.corner[4] = nan_of;
            if (what == 3) memcpy(o.corner + 2 * dim_of(&o), o.corner + dim_of(&o), dim_of(&o) * sizeof *o.corner);
            if (what == 4) surfmink_reverse(o.corner, 6, dim_of(&o));
            if (what == 0) o.max_rank = -1;
            for (i = 0; i < NUMBERS; ++i) got.by_corner[i] = got.by_normal[i] = -77;
            got.mu[0] = got.g[0] = got.w.length = -77;
            got.bad = 99;
            CASE("%s %d", surface_name[surface], what);
            if (what == 4 && surface == SURFMINK_EMBEDDED) surfmink_reverse(o.normal, 6, 3);
            CHECK_STATUS(gradient(&o, &got), what == 0   ? SURFMINK_BAD_ARGUMENT
                                             : what == 1 ? SURFMINK_TOO_FEW_CORNERS
                                             : what == 2 ? SURFMINK_NOT_FINITE
                                             : what == 3 ? SURFMINK_COINCIDENT_CORNERS
                                                         : SURFMINK_CLOCKWISE);
            CHECK_EQUAL(got.bad, what == 1 ? 2 : what == 2 ? 4 / dim_of(&o) : what == 3 ? 2 : 6);
            untouched(got.by_corner, NUMBERS);
            untouched(got.by_normal, NUMBERS);
            CHECK(got.mu[0] == -77 && got.g[0] == -77 && got.w.length == -77);
        }
    CASE("a radius");
    o.surface = SURFMINK_SPHERE;
    o.radius = 0;
    CHECK_STATUS(gradient(&o, &got), SURFMINK_BAD_ARGUMENT);
    view = view_of(&o);
    CHECK_STATUS(surfmink_pull_corners(&view, l, alpha, got.by_corner, NULL, scratch, &got.bad), SURFMINK_BAD_ARGUMENT);
    CHECK_EQUAL(got.bad, 6);
    CASE("two corners");
    o.n = 2;
    o.radius = 1;
    for (surface = 0; surface < SURFACES; ++surface) {
        o.surface = (enum surfmink_kind)surface;
        view = view_of(&o);
        got.bad = 99;
        CHECK_STATUS(surfmink_pull_corners(&view, l, alpha, got.by_corner, got.by_normal, scratch, NULL),
                     SURFMINK_TOO_FEW_CORNERS);
        CHECK_STATUS(surfmink_pull_corners(&view, l, alpha, got.by_corner, got.by_normal, scratch, &got.bad),
                     SURFMINK_TOO_FEW_CORNERS);
        CHECK_EQUAL(got.bad, 2);
    }
    CASE("callbacks");
    view = surfmink_on_surface(&disk, o.corner, 6);
    out.bad = &got.bad;
    out.by_corner = got.by_corner;
    CHECK_STATUS(surfmink_pull_corners(&view, l, alpha, got.by_corner, NULL, scratch, &got.bad), SURFMINK_BAD_ARGUMENT);
    CHECK_EQUAL(got.bad, 6);
    CHECK_STATUS(surfmink_gradient(&view, 3, &o.weights, &out, scratch), SURFMINK_BAD_ARGUMENT);
    untouched(got.by_corner, NUMBERS);
    untouched(got.by_normal, NUMBERS);
    CASE("edges");
    for (i = 0; i < 4; ++i) by_l[i] = by_alpha[i] = -77;
    CHECK_STATUS(surfmink_pull_edges(g, -1, l, alpha, 4, by_l, by_alpha), SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(surfmink_pull_edges(g, 1, l, alpha, 2, by_l, by_alpha), SURFMINK_TOO_FEW_CORNERS);
    alpha[0] = nan_of;
    CHECK_STATUS(surfmink_pull_edges(g, 1, l, alpha, 4, by_l, by_alpha), SURFMINK_NOT_FINITE);
    alpha[0] = -9;
    CHECK_STATUS(surfmink_pull_edges(g, 1, l, alpha, 4, by_l, by_alpha), SURFMINK_CLOCKWISE);
    untouched(by_l, 4);
    untouched(by_alpha, 4);
    CASE("components");
    CHECK_STATUS(surfmink_pull_spectrum(&o.weights, g, -1, by_g), SURFMINK_BAD_ARGUMENT);
    g[2] = nan_of;
    CHECK_STATUS(surfmink_pull_spectrum(&o.weights, g, 1, by_g), SURFMINK_NOT_FINITE);
    g[2] = g[0] = 0;
    CHECK_STATUS(surfmink_pull_spectrum(&o.weights, g, 1, by_g), SURFMINK_BAD_ARGUMENT);
    untouched(by_g, 4);
}

THEOREM(outputs_that_nobody_wants_may_be_null)
{
    static outline o;
    static pulled got;
    static double by_corner[NUMBERS];
    surfmink_gradients out = {NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    surfmink_outline view;
    double xy[2 * MOST];
    chance c = {19};
    int surface;
    out.by_corner = by_corner;
    for (surface = 0; surface < SURFACES; ++surface) {
        gentle_star(&c, 7, xy);
        lay(&c, (enum surfmink_kind)surface, xy, 7, &o);
        o.max_rank = 6;
        weigh(&c, &o);
        view = view_of(&o);
        CHECK_OK(gradient(&o, &got));
        CHECK_OK(surfmink_gradient(&view, 6, &o.weights, &out, scratch));
        CHECK_SAME(by_corner, got.by_corner, 7 * dim_of(&o));
        view.n = 2;
        CHECK_STATUS(surfmink_gradient(&view, 6, &o.weights, &out, scratch), SURFMINK_TOO_FEW_CORNERS);
        CHECK_SAME(by_corner, got.by_corner, 7 * dim_of(&o));
    }
}

/* Between corners so near to each other that the square of their distance is no double. */
THEOREM(an_edge_next_to_nothing_has_a_huge_gradient)
{
    static outline o;
    static pulled got;
    chance c = {22};
    size_t i;
    double xy[2 * MOST], mu[TOP + 1], g[2 * TOP + 2];
    surfmink_functionals w;
    gentle_star(&c, 6, xy);
    lay(&c, SURFMINK_EMBEDDED, xy, 6, &o);
    o.max_rank = 6;
    for (i = 0; i < 18; ++i)
        if (i < 6 || i > 8) o.corner[i] -= o.corner[6 + i % 3];
    for (i = 6; i < 9; ++i) o.corner[i] = 0;
    for (i = 9; i < 12; ++i) o.corner[i] *= 1e-170;
    weigh(&c, &o);
    CHECK_OK(gradient(&o, &got));
    check_gradient(&o, &got, 1e-10);
    CHECK_OK(measure(&o, mu, g, &w));
    CHECK_SAME(got.mu, mu, 7);
    CHECK_SAME(got.g, g, 14);
}

/* --- batches ------------------------------------------------------------------------------------------------------ */

enum { BUNDLE = 40, ROOM = 4000 }; /* outlines, and corners of all */

/* Many outlines of one surface, their weights, and what comes out. */
typedef struct bundle {
    enum surfmink_kind surface;
    size_t count, offset[BUNDLE + 1];
    int max_rank;
    double radius, corner[3 * ROOM], normal[3 * ROOM], mu[BUNDLE * (TOP + 1)], g[2 * BUNDLE * (TOP + 1)],
        theta[BUNDLE * (TOP + 1)], length[BUNDLE];
    surfmink_weights weights;
} bundle;

typedef struct answers {
    int status[BUNDLE];
    size_t refused, bad[BUNDLE];
    double mu[BUNDLE * (TOP + 1)], g[2 * BUNDLE * (TOP + 1)], by_corner[3 * ROOM], by_normal[3 * ROOM];
    surfmink_functionals w[BUNDLE];
} answers;

/* Outlines of all sizes, some long, some refused, some that are not ordinary. */
static void fill_bundle(chance *c, enum surfmink_kind surface, int max_rank, bundle *b)
{
    static outline o;
    static double xy[2 * CORNERS];
    size_t i, n, ranks = (size_t)max_rank + 1;
    b->surface = surface;
    b->count = BUNDLE;
    b->max_rank = max_rank;
    b->radius = surface == SURFMINK_SPHERE ? 3 : 1;
    b->offset[0] = 0;
    for (i = 0; i < BUNDLE; ++i) {
        n = i % 10 == 7 ? 60 + one_of(c, 8) : i % 20 == 13 ? (i == 13 ? 600 : 513) : 3 + one_of(c, 8);
        if (n < MOST)
            gentle_star(c, n, xy);
        else
            wavy(c, n, xy);
        lay(c, surface, xy, n, &o);
        o.max_rank = max_rank;
        o.radius = b->radius;
        weigh(c, &o);
        if (i == 4) surfmink_reverse(o.corner, n, dim_of(&o));
        if (i == 4 && surface == SURFMINK_EMBEDDED) surfmink_reverse(o.normal, n, 3);
        if (i == 11) o.corner[1] = nan("");
        if (i == 17 && surface != SURFMINK_PLANE) onto_sphere(xy, n, 20, o.corner);
        if (i == 17) memcpy(o.normal, o.corner, 3 * n * sizeof *o.corner);
        if (i == 21 && surface == SURFMINK_PLANE) { /* a short edge and a long one, which turns back */
            o.corner[2] = o.corner[0] + 1e-9;
            o.corner[3] = o.corner[1];
        }
        if (i == 22) n = 2;
        memcpy(b->corner + dim_of(&o) * b->offset[i], o.corner, dim_of(&o) * n * sizeof *o.corner);
        memcpy(b->normal + 3 * b->offset[i], o.normal, 3 * n * sizeof *o.normal);
        memcpy(b->mu + ranks * i, o.mu, ranks * sizeof *o.mu);
        memcpy(b->theta + ranks * i, o.theta, ranks * sizeof *o.mu);
        memcpy(b->g + 2 * ranks * i, o.g, 2 * ranks * sizeof *o.mu);
        b->length[i] = o.length;
        b->offset[i + 1] = b->offset[i] + n;
    }
    b->weights.mu = b->mu;
    b->weights.g = b->g;
    b->weights.theta = b->theta;
    b->weights.length = b->length;
    b->weights.shared = 0;
}

static void run(const bundle *b, const size_t *offset, size_t count, int with_normals, answers *a)
{
    static double room[4 * ROOM + (2 * TOP + 2) * BUNDLE];
    surfmink_outline all = {b->surface, b->offset[BUNDLE], b->corner, b->normal, b->radius, NULL};
    surfmink_gradients out;
    size_t i;
    out.status = a->status;
    out.bad = a->bad;
    out.mu = a->mu;
    out.g = a->g;
    out.w = a->w;
    out.by_corner = a->by_corner;
    out.by_normal = with_normals ? a->by_normal : NULL;
    for (i = 0; i < 3 * ROOM; ++i) a->by_corner[i] = a->by_normal[i] = -77;
    for (i = 0; i < BUNDLE; ++i) a->bad[i] = 99;
    a->refused = surfmink_batch_gradient(&all, offset, count, b->max_rank, &b->weights, &out, room);
}

/* One outline of a bundle, with its own weights. */
static void take(const bundle *b, size_t i, size_t weights, outline *o)
{
    size_t ranks = (size_t)b->max_rank + 1;
    o->surface = b->surface;
    o->n = b->offset[i + 1] - b->offset[i];
    o->max_rank = b->max_rank;
    o->radius = b->radius;
    memcpy(o->corner, b->corner + dim_of(o) * b->offset[i], dim_of(o) * o->n * sizeof *o->corner);
    memcpy(o->normal, b->normal + 3 * b->offset[i], 3 * o->n * sizeof *o->normal);
    o->weights.mu = b->weights.mu ? b->mu + ranks * weights : NULL;
    o->weights.g = b->weights.g ? b->g + 2 * ranks * weights : NULL;
    o->weights.theta = b->weights.theta ? b->theta + ranks * weights : NULL;
    o->weights.length = b->weights.length ? b->length + weights : NULL;
}

THEOREM(a_batch_says_what_single_calls_say)
{
    static const int rank[3] = {6, 0, 30};
    static bundle b;
    static answers a;
    static outline o;
    static pulled got;
    int surface, k;
    size_t i, dim, ranks, refused;
    chance c = {20};
    for (surface = 0; surface < SURFACES; ++surface)
        for (k = 0; k < 3; ++k) {
            fill_bundle(&c, (enum surfmink_kind)surface, rank[k], &b);
            if (k == surface) b.weights.theta = NULL;
            if (k == (surface + 1) % 3) b.weights.g = NULL;
            if (k == (surface + 2) % 3) b.weights.mu = b.weights.length = NULL;
            b.weights.shared = k == 2;
            run(&b, b.offset, b.count, k != 1, &a);
            ranks = (size_t)rank[k] + 1;
            for (refused = i = 0; i < b.count; ++i) {
                take(&b, i, b.weights.shared ? 0 : i, &o);
                dim = dim_of(&o);
                got.bad = 99;
                CASE("%s, outline %lu of %lu corners, P = %d", surface_name[surface], (unsigned long)i,
                     (unsigned long)o.n, b.max_rank);
                CHECK_STATUS(a.status[i], gradient(&o, &got));
                CHECK_EQUAL(a.bad[i], got.bad);
                refused += a.status[i] != SURFMINK_OK;
                if (a.status[i] != SURFMINK_OK) {
                    untouched(a.by_corner + dim * b.offset[i], dim * o.n);
                    untouched(a.by_normal + 3 * b.offset[i], 3 * o.n);
                    continue;
                }
                CHECK_SAME(a.mu + ranks * i, got.mu, ranks);
                CHECK_SAME(a.g + 2 * ranks * i, got.g, 2 * ranks);
                CHECK_SAME(&a.w[i].length, &got.w.length, 1);
                CHECK_SAME(a.by_corner + dim * b.offset[i], got.by_corner, dim * o.n);
                if (surface == SURFMINK_EMBEDDED && k != 1)
                    CHECK_SAME(a.by_normal + 3 * b.offset[i], got.by_normal, 3 * o.n);
                else
                    untouched(a.by_normal + 3 * b.offset[i], 3 * o.n);
            }
            CHECK_EQUAL(a.refused, refused);
            CHECK(refused >= 2);
        }
}

THEOREM(a_batch_with_a_bad_argument_writes_nothing)
{
    static bundle b;
    static answers a;
    chance c = {21};
    const size_t backwards[3] = {9, 5, 5}, beyond[3] = {0, 70000, 3};
    fill_bundle(&c, SURFMINK_SPHERE, 6, &b);
    b.radius = -1;
    run(&b, b.offset, b.count, 1, &a);
    CHECK_EQUAL(a.refused, b.count);
    CHECK_STATUS(a.status[0], SURFMINK_BAD_ARGUMENT);
    untouched(a.by_corner, 3 * ROOM);
    b.radius = 1;
    run(&b, backwards, 2, 1, &a);
    CHECK_STATUS(a.status[0], SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(a.status[1], SURFMINK_TOO_FEW_CORNERS);
    run(&b, beyond, 2, 1, &a);
    CHECK_STATUS(a.status[0], SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(a.status[1], SURFMINK_BAD_ARGUMENT);
    untouched(a.by_corner, 3 * ROOM);
    b.max_rank = -2;
    run(&b, b.offset, b.count, 1, &a);
    CHECK_EQUAL(a.refused, b.count);
    CHECK_STATUS(a.status[0], SURFMINK_BAD_ARGUMENT);
    untouched(a.by_corner, 3 * ROOM);
    b.max_rank = 6;
    b.surface = SURFMINK_SURFACE;
    run(&b, b.offset, b.count, 1, &a);
    CHECK_EQUAL(a.refused, b.count);
    untouched(a.by_corner, 3 * ROOM);
}

/* --- where digits are rare ---------------------------------------------------------------------------------------- */

/* Corners just above the equator: S is 2 pi times their height, or so. */
THEOREM(beside_a_great_circle_the_gradient_is_off_by_1e_12_over_S)
{
    static outline o;
    static pulled got;
    chance c = {23};
    surfmink_functionals w;
    int k, which;
    size_t i;
    for (k = 0; k < 10; ++k)
        for (worst = 0, which = 0; which < 40; ++which) {
            memset(&o, 0, sizeof o);
            o.surface = which % 2 ? SURFMINK_SPHERE : SURFMINK_EMBEDDED;
            o.n = 7 + one_of(&c, 8);
            o.radius = 1;
            o.max_rank = 6;
            for (i = 0; i < o.n; ++i) {
                double t = 2 * PI * ((double)i + between(&c, -0.2, 0.2)) / (double)o.n;
                double z = pow(10, -k) * between(&c, 0.4, 0.5);
                o.corner[3 * i] = cos(t) * sqrt(1 - z * z);
                o.corner[3 * i + 1] = sin(t) * sqrt(1 - z * z);
                o.corner[3 * i + 2] = z;
            }
            turn_somehow(&c, o.corner, o.n);
            memcpy(o.normal, o.corner, sizeof o.normal);
            CASE("%s %d, height 1e-%d", surface_name[o.surface], which, k);
            CHECK_OK(measure(&o, o.mu, NULL, &w));
            weigh(&c, &o);
            CHECK_OK(gradient(&o, &got));
            check_gradient(&o, &got, 1e-12 / w.turning);
        }
}

/* A corner more, next to another one, before and behind edge 0 and elsewhere. The reference knows its own differences
   to 1e-18 of their distance. */
THEOREM(corners_next_to_each_other_lose_no_digits)
{
    static outline o;
    static pulled got;
    double xy[2 * MOST];
    chance c = {24};
    int surface, which, k, tried = 0;
    size_t i, at, dim;
    for (surface = 0; surface < SURFACES; ++surface)
        for (k = 2; k < 15; ++k)
            for (which = 0; which < 12; ++which) {
                static const size_t where[3] = {0, 5, 2};
                double apart = pow(10, -k) * between(&c, 0.5, 1), *x, *y;
                at = where[which % 3];
                gentle_star(&c, 6, xy);
                lay(&c, (enum surfmink_kind)surface, xy, 6, &o);
                o.max_rank = 6;
                dim = dim_of(&o);
                memmove(o.corner + dim * (at + 1), o.corner + dim * at, (6 - at) * dim * sizeof *o.corner);
                memmove(o.normal + 3 * (at + 1), o.normal + 3 * at, (6 - at) * 3 * sizeof *o.normal);
                o.n = 7;
                x = o.corner + dim * (at + 1);
                y = o.corner + dim * ((at + 2) % 7);
                for (i = 0; i < dim; ++i) x[i] += apart * (y[i] - x[i] + (i == 0 ? 0.3 * fabs(x[i]) : 0));
                x = o.normal + 3 * (at + 1);
                y = o.normal + 3 * ((at + 2) % 7);
                for (i = 0; i < 3; ++i) x[i] += apart * (y[i] - x[i]);
                CASE("%s, corner %lu, 1e-%d apart", surface_name[surface], (unsigned long)at, k);
                if (measure(&o, o.mu, NULL, NULL) != SURFMINK_OK) continue; /* not every such corner leaves it simple */
                weigh(&c, &o);
                CHECK_OK(gradient(&o, &got));
                check_gradient(&o, &got, 1e-11 + 1e-18 / apart);
                ++tried;
            }
    CHECK(tried > 400); /* of 468 */
}

/* --- how sure mu_p is --------------------------------------------------------------------------------------------- */

enum { DRAWS = 3000, SMALL = 6 /* ranks */ };

static double normal_number(chance *c)
{
    double u = between(c, 1e-12, 1), v = between(c, 0, 2 * PI);
    return sqrt(-2 * log(u)) * cos(v);
}

static const double axis[3] = {1, 1.5, 2}; /* of an ellipsoid */

/* Moves a corner along the surface. On the ellipsoid it goes back to it, and its normal with it. */
static void displace(outline *o, size_t i, const double move[3])
{
    size_t k, dim = dim_of(o);
    double *x = o->corner + dim * i, normal[3], size = 0;
    memcpy(normal, (o->surface == SURFMINK_SPHERE ? o->corner : o->normal) + 3 * i, sizeof normal);
    for (k = 0; k < dim; ++k) x[k] += move[k] - (dim == 3 ? normal[k] * dot3(move, normal) / dot3(normal, normal) : 0);
    if (o->surface != SURFMINK_EMBEDDED) return;
    for (k = 0; k < 3; ++k) size += x[k] / axis[k] * (x[k] / axis[k]);
    for (k = 0; k < 3; ++k) x[k] /= sqrt(size);
    for (k = 0; k < 3; ++k) o->normal[3 * i + k] = x[k] / (axis[k] * axis[k]);
}

/* A cell of about 0.2 of the radius of curvature. */
static void some_cell(chance *c, enum surfmink_kind surface, int regular, outline *o)
{
    double xy[2 * MOST];
    size_t i, n = regular ? 6 : 5 + one_of(c, 4);
    memset(o, 0, sizeof *o);
    gentle_star(c, n, xy);
    for (i = 0; i < n && regular; ++i) {
        xy[2 * i] = 0.8 * cos(2 * PI * (double)i / (double)n);
        xy[2 * i + 1] = 0.8 * sin(2 * PI * (double)i / (double)n);
    }
    lay(c, surface, xy, n, o);
    if (surface != SURFMINK_PLANE) onto_sphere(xy, n, 0.2, o->corner);
    if (surface != SURFMINK_PLANE) turn_somehow(c, o->corner, n);
    for (i = 0; i < 3 * n && surface == SURFMINK_EMBEDDED; ++i) {
        o->normal[i] = o->corner[i] / axis[i % 3];
        o->corner[i] *= axis[i % 3];
    }
    o->radius = 1;
    o->max_rank = SMALL;
}

typedef struct sure {
    double mu[SMALL + 1], sigma[SMALL + 1], bias[SMALL + 1];
    size_t bad;
} sure;

static int noise(const outline *o, double deviation, sure *to)
{
    surfmink_outline view = view_of(o);
    surfmink_uncertainty out;
    out.mu = to->mu;
    out.sigma = to->sigma;
    out.bias = to->bias;
    out.bad = &to->bad;
    return surfmink_noise(&view, o->max_rank, deviation, &out, scratch);
}

/* Noise of so much of the mean edge. Standard deviations of 3000 draws are known to 1.3 %, means of mu^2 to 2 mu sigma
   / sqrt(3000): four times that is allowed, and what the second order leaves out. Regular polygons have mu_p = 0 but
   for p = 6. */
THEOREM(sigma_and_bias_are_those_of_3000_draws)
{
    static outline o, noisy;
    chance c = {25};
    surfmink_functionals w;
    sure says;
    static const double share[4] = {0.005, 0.02, 0.05, 0.1}, low[4] = {0.92, 0.92, 0.85, 0.8},
                        high[4] = {1.1, 1.1, 1.2, 1.6};
    double least[4] = {1, 1, 1, 1}, most[4] = {1, 1, 1, 1}, move[3];
    int surface, which, draw, p, much;
    size_t i, k;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 20; ++which) {
            double mu[SMALL + 1], mean[SMALL + 1] = {0}, square[SMALL + 1] = {0}, s, off;
            some_cell(&c, (enum surfmink_kind)surface, which == 0, &o);
            CHECK_OK(measure(&o, mu, NULL, &w));
            much = (which + 1) % 4;
            s = share[much] * w.length / (double)o.n;
            CHECK_OK(noise(&o, s, &says));
            CHECK_SAME(says.mu, mu, SMALL + 1);
            CHECK(!(says.sigma[0] > 0) && !(says.bias[0] > 0 || says.bias[0] < 0));
            for (draw = 0; draw < DRAWS; ++draw) {
                noisy = o;
                for (i = 0; i < o.n; ++i) {
                    for (k = 0; k < 3; ++k) move[k] = k < dim_of(&o) ? s * normal_number(&c) : 0;
                    displace(&noisy, i, move);
                }
                CHECK_OK(measure(&noisy, mu, NULL, NULL));
                for (p = 1; p <= SMALL; ++p) {
                    mean[p] += (mu[p] - says.mu[p]) / DRAWS;
                    square[p] += (mu[p] - says.mu[p]) * (mu[p] - says.mu[p]) / DRAWS;
                }
            }
            for (p = 2; p <= SMALL; ++p) {
                double spread = sqrt(square[p] - mean[p] * mean[p]);
                double bias = square[p] + 2 * says.mu[p] * mean[p];
                CASE("%s %d, s = %g, mu_%d = %.3f", surface_name[surface], which, s, p, says.mu[p]);
                off = says.sigma[p] / spread;
                if (which == 0 && p == 6) {
                    CHECK(off > 0.95 && off < 1.7);
                    continue;
                }
                CHECK(off > low[much] && off < high[much]);
                if (off < least[much]) least[much] = off;
                if (off > most[much]) most[much] = off;
                if (much < 2)
                    CHECK_NEAR(says.bias[p], bias, 8 * says.mu[p] * spread / sqrt(DRAWS) + 0.25 * spread * spread);
            }
        }
    for (much = 0; much < 4; ++much)
        NOTE("noise of %.3f of an edge: sigma over that of %d draws %.3f to %.3f", share[much], DRAWS, least[much],
             most[much]);
}

/* To second order the bias is s^2 / 2 times the sum of second derivatives of mu^2 along the surface: here differences.
   What it leaves out goes like the curvature over a cell, 0.03. */
THEOREM(the_bias_is_the_laplacian_of_mu_squared)
{
    static const double step = 2e-4;
    static outline o, moved_one;
    chance c = {29};
    sure says;
    surfmink_functionals w;
    int surface, which, p, sign;
    size_t i, k, j;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 20; ++which) {
            double mu[SMALL + 1], sum[SMALL + 1] = {0}, unit;
            some_cell(&c, (enum surfmink_kind)surface, which == 0, &o);
            CHECK_OK(measure(&o, mu, NULL, &w));
            unit = w.length / (double)o.n;
            CHECK_OK(noise(&o, 0.01 * unit, &says));
            for (i = 0; i < o.n; ++i)
                for (k = 0; k < 2; ++k) {
                    double e[2][3] = {{0.6, 0.8, 0}, {-0.8, 0.6, 0}};
                    const double *n = (surface == SURFMINK_SPHERE ? o.corner : o.normal) + 3 * i;
                    if (surface != SURFMINK_PLANE) {
                        cross3(n, e[1], e[0]);
                        cross3(n, e[0], e[1]);
                        unit = w.length / (double)o.n / sqrt(dot3(e[k], e[k]));
                    }
                    for (sign = -1; sign < 2; sign += 2) {
                        double move[3];
                        moved_one = o;
                        for (j = 0; j < 3; ++j) move[j] = sign * step * unit * e[k][j];
                        displace(&moved_one, i, move);
                        CHECK_OK(measure(&moved_one, mu, NULL, NULL));
                        for (p = 1; p <= SMALL; ++p)
                            sum[p] += 0.5 * 1e-4 * (mu[p] - says.mu[p]) * (mu[p] + says.mu[p]) / (step * step);
                    }
                }
            for (p = 2; p <= SMALL; ++p) {
                double size = 1e-4 * p * p; /* what its terms are like */
                CASE("%s %d, mu_%d = %.3f", surface_name[surface], which, p, says.mu[p]);
                CHECK_NEAR(says.bias[p], sum[p], (surface == SURFMINK_PLANE ? 1e-5 : 0.05) * size);
            }
        }
}

/* Where noise is small: |J| of the gradient, within the surface. */
THEOREM(sigma_is_the_norm_of_the_gradient)
{
    static outline o;
    static pulled got;
    chance c = {26};
    sure says;
    double weight[SMALL + 1];
    int surface, which, p;
    size_t i;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 20; ++which) {
            some_cell(&c, (enum surfmink_kind)surface, 0, &o);
            if (surface == SURFMINK_SPHERE) { /* the unit of lengths is that of the radius */
                for (i = 0; i < 3 * o.n; ++i) o.corner[i] *= 7;
                o.radius = 1000;
            }
            CHECK_OK(noise(&o, surface == SURFMINK_SPHERE ? 1e-4 : 1e-7, &says));
            for (p = 2; p <= SMALL; ++p) {
                double norm = 0;
                if (says.mu[p] < 0.01) continue;
                for (i = 0; i <= SMALL; ++i) weight[i] = i == (size_t)p;
                memset(&o.weights, 0, sizeof o.weights);
                o.weights.mu = weight;
                CHECK_OK(gradient(&o, &got));
                for (i = 0; i < o.n; ++i) {
                    const double *b = got.by_corner + dim_of(&o) * i, *n = o.normal + 3 * i;
                    double part = surface == SURFMINK_EMBEDDED ? dot3(b, n) : 0;
                    norm += dim_of(&o) == 2 ? b[0] * b[0] + b[1] * b[1] : dot3(b, b);
                    if (surface == SURFMINK_EMBEDDED) norm -= part * part / dot3(n, n);
                }
                norm = surface == SURFMINK_SPHERE ? sqrt(norm) * 7 / 1000 * 1e-4 : sqrt(norm) * 1e-7;
                CASE("%s %d, mu_%d = %g", surface_name[surface], which, p, says.mu[p]);
                CHECK_CLOSE(says.sigma[p], norm, 1e-6);
            }
        }
}

/* Noise of twice the size, small against all edges, has four times the bias; in another unit, a power of two, the
   same bits. */
THEOREM(noise_scales_as_it_should)
{
    static outline o, scaled;
    chance c = {27};
    sure one, two;
    int surface, which, p;
    size_t i;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 10; ++which) {
            some_cell(&c, (enum surfmink_kind)surface, which == 0, &o);
            CASE("%s %d", surface_name[surface], which);
            CHECK_OK(noise(&o, 0.01 / 32, &one));
            CHECK_OK(noise(&o, 0.02 / 32, &two));
            for (p = 1; p <= SMALL; ++p) CHECK_NEAR(two.bias[p], 4 * one.bias[p], 1e-16);
            CHECK_OK(noise(&o, 0.01, &one));
            scaled = o;
            for (i = 0; i < dim_of(&o) * o.n; ++i) scaled.corner[i] *= 1024;
            scaled.radius = surface == SURFMINK_SPHERE ? 1024 : 1;
            CHECK_OK(noise(&scaled, 10.24, &two));
            for (p = 1; p <= SMALL; ++p) {
                CHECK_CLOSE(two.bias[p], one.bias[p], 1e-12);
                CHECK_CLOSE(two.sigma[p], one.sigma[p], 1e-12);
            }
            CHECK_OK(noise(&o, 0, &one));
            for (p = 0; p <= SMALL; ++p) CHECK(!(one.sigma[p] > 0) && !(fabs(one.bias[p]) > 0));
        }
}

/* An edge shorter than the noise turns by any angle, and cannot change more than itself: less than the noise can. No
   number from 0 to 1 varies by more than 1/2. */
THEOREM(short_edges_do_not_make_sigma_large)
{
    static outline o, shorter;
    chance c = {30};
    sure with, without;
    int surface, which, p;
    size_t k, dim;
    for (surface = 0; surface < SURFACES; ++surface)
        for (which = 0; which < 10; ++which) {
            some_cell(&c, (enum surfmink_kind)surface, 0, &o);
            shorter = o;
            dim = dim_of(&o);
            for (k = 0; k < dim; ++k) { /* a corner 1e-6 of an edge behind the last one */
                shorter.corner[dim * o.n + k] =
                    o.corner[dim * (o.n - 1) + k] + 1e-6 * (o.corner[k] - o.corner[dim * (o.n - 1) + k]);
                if (surface == SURFMINK_EMBEDDED) shorter.normal[dim * o.n + k] = o.normal[dim * (o.n - 1) + k];
            }
            ++shorter.n;
            CASE("%s %d", surface_name[surface], which);
            CHECK_OK(noise(&o, 0.004, &without));
            CHECK_OK(noise(&shorter, 0.004, &with));
            for (p = 2; p <= SMALL; ++p) {
                CHECK(with.sigma[p] > without.sigma[p] / 3 && with.sigma[p] < 3 * without.sigma[p]);
                CHECK(with.sigma[p] <= 0.5);
                CHECK(fabs(with.bias[p]) <= 1);
            }
        }
}

THEOREM(noise_that_is_refused_changes_nothing_and_is_named)
{
    static outline o;
    chance c = {28};
    sure says;
    surfmink_uncertainty none = {NULL, NULL, NULL, NULL};
    surfmink_outline view;
    int what;
    for (what = 0; what < 6; ++what) {
        some_cell(&c, what % 2 ? SURFMINK_SPHERE : SURFMINK_EMBEDDED, 1, &o);
        says.mu[0] = says.sigma[0] = says.bias[0] = -77;
        says.bad = 99;
        if (what == 3) o.n = 2;
        if (what == 4) surfmink_reverse(o.corner, 6, 3);
        if (what == 4) surfmink_reverse(o.normal, 6, 3);
        if (what == 5) o.max_rank = -1;
        CASE("%d", what);
        CHECK_STATUS(noise(&o,
                           what == 0   ? -1
                           : what == 1 ? nan("")
                           : what == 2 ? HUGE_VAL
                                       : 0.01,
                           &says),
                     what == 3   ? SURFMINK_TOO_FEW_CORNERS
                     : what == 4 ? SURFMINK_CLOCKWISE
                                 : SURFMINK_BAD_ARGUMENT);
        CHECK_EQUAL(says.bad, what == 3 ? 2 : 6);
        CHECK(says.mu[0] == -77 && says.sigma[0] == -77 && says.bias[0] == -77);
    }
    some_cell(&c, SURFMINK_PLANE, 1, &o);
    view = view_of(&o);
    CHECK_OK(surfmink_noise(&view, 6, 0.01, &none, scratch));
    CHECK_STATUS(surfmink_noise(&view, 6, -0.01, &none, scratch), SURFMINK_BAD_ARGUMENT);
}

int main(void)
{
    PROVE(the_gradient_is_the_derivative_by_every_coordinate);
    PROVE(gradients_of_long_outlines_are_derivatives);
    PROVE(gradients_do_not_move_turn_or_scale_the_outline);
    PROVE(the_steps_lead_to_the_same_gradient);
    PROVE(any_weights_of_lengths_and_turns_are_pulled_back);
    PROVE(weights_of_edges_are_derivatives_by_lengths_and_turns);
    PROVE(what_is_measured_on_the_way_is_what_measuring_says);
    PROVE(gradients_are_linear_in_the_weights);
    PROVE(where_mu_is_zero_its_weight_counts_as_nothing);
    PROVE(noise_ends_at_1e_14);
    PROVE(units_do_not_matter);
    PROVE(weights_of_lengths_have_the_unit_of_lengths);
    PROVE(outlines_that_are_not_ordinary_have_gradients);
    PROVE(gradients_of_absurd_units_are_those_of_sensible_ones);
    PROVE(what_is_refused_changes_nothing_and_is_named);
    PROVE(outputs_that_nobody_wants_may_be_null);
    PROVE(an_edge_next_to_nothing_has_a_huge_gradient);
    PROVE(a_batch_says_what_single_calls_say);
    PROVE(a_batch_with_a_bad_argument_writes_nothing);
    PROVE(beside_a_great_circle_the_gradient_is_off_by_1e_12_over_S);
    PROVE(corners_next_to_each_other_lose_no_digits);
    PROVE(sigma_and_bias_are_those_of_3000_draws);
    PROVE(the_bias_is_the_laplacian_of_mu_squared);
    PROVE(sigma_is_the_norm_of_the_gradient);
    PROVE(noise_scales_as_it_should);
    PROVE(short_edges_do_not_make_sigma_large);
    PROVE(noise_that_is_refused_changes_nothing_and_is_named);
    return QED();
}
