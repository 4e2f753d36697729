/* outline.h - outlines out of bytes, and what has to hold of them however they are drawn. */
#ifndef FUZZ_OUTLINE_H
#define FUZZ_OUTLINE_H

#include "api.h"

/* --- outlines ----------------------------------------------------------------------------------------------------- */

typedef struct outline {
    enum surfmink_kind kind;
    size_t n;
    double corner[3 * CORNERS], normal[3 * CORNERS], radius;
} outline;

static size_t dim_of(const outline *o)
{
    return o->kind == SURFMINK_PLANE ? 2 : 3;
}

static void take_outline(bytes *in, enum surfmink_kind kind, outline *o)
{
    double unit = 1;
    size_t i;
    memset(o, 0, sizeof *o);
    o->kind = kind;
    o->radius = 1;
    o->n = take(in) % (CORNERS + 1);
    if (take(in) < 16) unit = take_number(in);
    if (kind == SURFMINK_SPHERE && take(in) < 16) o->radius = take_number(in);
    for (i = 0; i < dim_of(o) * o->n; ++i) o->corner[i] = unit * take_number(in);
    for (i = 0; kind == SURFMINK_EMBEDDED && i < 3 * o->n; ++i) o->normal[i] = take_number(in);
}

static surfmink_outline view_of(const outline *o)
{
    switch (o->kind) {
    case SURFMINK_PLANE: return surfmink_plane(o->corner, o->n);
    case SURFMINK_SPHERE: return surfmink_sphere(o->corner, o->n, o->radius);
    default: return surfmink_embedded(o->corner, o->normal, o->n);
    }
}

/* Nothing has been measured yet, or is compared. */
static int measure_outline(const outline *o, measured *m)
{
    surfmink_outline view = view_of(o);
    memset(m, 0x5a, sizeof *m);
    return surfmink_measure(&view, RANK, m->mu, m->g, &m->w, &m->bad);
}

/* One by one the four steps give the same bits, and refuse the same outlines for the same reason. */
static void claim_steps(const surfmink_outline *view, const measured *m)
{
    double phase[CORNERS], g[2 * RANK + 2], mu[RANK + 1];
    surfmink_functionals w;
    int status;
    memset(&w, 0x5a, sizeof w);
    status = surfmink_total(view, m->length, m->turning, view->n, &w);
    CLAIM(status == m->status && same_bits(&w, &m->w, sizeof w));
    if (status != SURFMINK_OK) return;
    CLAIM(surfmink_phases(m->turning, view->n, SURFMINK_CORRECTED, phase) == SURFMINK_OK);
    CLAIM(surfmink_irreducible(m->length, phase, view->n, RANK, g) == SURFMINK_OK);
    CLAIM(same_bits(g, m->g, sizeof g));
    CLAIM(surfmink_spectrum(g, RANK, NULL, mu, NULL) == SURFMINK_OK);
    if (m->w.length > 1e-290) CLAIM(same_bits(mu, m->mu, sizeof mu)); /* else components lose digits, or all */
}

/* In one call and in four steps, and what each of them promises. Returns 0 if there is nothing to compare others
   with. */
static int measure_twice(const outline *o, measured *m)
{
    surfmink_outline view = view_of(o);
    measured untouched;
    size_t i;
    int p;
    memset(&untouched, 0x5a, sizeof untouched);
    m->status = 0;
    p = measure_outline(o, m);
    CLAIM(is_known(p));
    if (p != SURFMINK_OK) {
        CLAIM(m->bad <= o->n);
        m->bad = untouched.bad;
        CLAIM(same_bits(m, &untouched, sizeof untouched));
    } else {
        CLAIM(m->bad == untouched.bad);
        CLAIM(all_finite(m->mu, RANK + 1) && all_finite(m->g, 2 * RANK + 2));
        CLAIM(isfinite(m->w.area) && isfinite(m->w.length) && isfinite(m->w.turning) && isfinite(m->w.curvature));
        CLAIM(m->w.length > 0 && m->w.turning > 0 && m->w.condition >= 1 - 4 * DBL_EPSILON);
        for (i = 0; i <= RANK; ++i) CLAIM(m->mu[i] >= 0 && m->mu[i] <= 1 + 4 * DBL_EPSILON);
    }
    m->status = p;
    p = surfmink_edges(&view, m->length, m->turning, &m->bad);
    CLAIM(is_known(p));
    if (p != SURFMINK_OK) {
        CLAIM(m->bad <= o->n);
        CLAIM(same_bits(m->length, untouched.length, sizeof m->length));
        CLAIM(same_bits(m->turning, untouched.turning, sizeof m->turning));
        CLAIM(m->status != SURFMINK_OK);
        return 0;
    }
    CLAIM(all_finite(m->length, o->n) && all_finite(m->turning, o->n));
    for (i = 0; i < o->n; ++i) CLAIM(m->length[i] >= 0 && fabs(m->turning[i]) <= 3.1415926535897936);
    claim_steps(&view, m);
    return 1;
}

/* A spike turns by pi up to rounding, and so has no definite sign. */
static int has_spike(const outline *o, const measured *m)
{
    size_t i;
    for (i = 0; i < o->n; ++i)
        if (fabs(m->turning[i]) > 3.141592653589) return 1;
    return 0;
}

/* What an exact copy of an outline, drawn otherwise, has to agree in: all that does not depend on how it is drawn. */
static void claim_alike(const measured *a, const measured *b)
{
    double c, loose;
    int p;
    if (a->status != SURFMINK_OK || b->status != SURFMINK_OK) {
        CLAIM(a->status != SURFMINK_OK || a->w.condition > 1e6 || b->status == a->status);
        return;
    }
    c = a->w.condition + fabs(a->w.curvature) / a->w.turning; /* as in ACCURACY: near half a sphere S is little */
    loose = 1e-13 * (1 + c) * (1 + c);
    if (!(loose < 0.1)) return;
    CLAIM(fabs(a->w.length - b->w.length) <= 1e-14 * a->w.length);
    CLAIM(fabs(a->w.turning - b->w.turning) <= 1e-14 * (1 + c) * a->w.turning);
    for (p = 0; p <= RANK; ++p) CLAIM(fabs(a->mu[p] - b->mu[p]) <= loose);
}

/* --- the same outline, drawn otherwise, exactly ------------------------------------------------------------------- */

static void relabel(outline *o, size_t by)
{
    outline old = *o;
    size_t i, k, dim = dim_of(o);
    for (i = 0; i < o->n; ++i)
        for (k = 0; k < 3; ++k) {
            if (k < dim) o->corner[dim * i + k] = old.corner[dim * ((i + by) % o->n) + k];
            o->normal[3 * i + k] = old.normal[3 * ((i + by) % o->n) + k];
        }
}

/* By a quarter turn in the plane, a third of a turn about (1, 1, 1) in space. */
static void rotate_numbers(double *x, size_t n, size_t dim)
{
    double kept;
    size_t i;
    for (i = 0; i < n; ++i, x += dim) {
        kept = x[0];
        x[0] = dim == 2 ? -x[1] : x[1];
        x[1] = dim == 2 ? kept : x[2];
        if (dim == 3) x[2] = kept;
    }
}

static void rotate(outline *o)
{
    rotate_numbers(o->corner, o->n, dim_of(o));
    rotate_numbers(o->normal, o->n, 3);
}

static void backwards(outline *o)
{
    surfmink_reverse(o->corner, o->n, dim_of(o));
    surfmink_reverse(o->normal, o->n, 3);
}

static void mirror(outline *o)
{
    size_t i;
    for (i = 0; i < o->n; ++i) {
        o->corner[dim_of(o) * i] = -o->corner[dim_of(o) * i];
        o->normal[3 * i] = -o->normal[3 * i];
    }
}

/* Are the magnitudes of all numbers but 0 such that neither products nor sums of them under- or overflow? */
static int is_tame(const double *x, size_t count)
{
    double least = HUGE_VAL, most = 0;
    for (; count > 0; --count, ++x) {
        if (*x != 0 && !(fabs(*x) >= least)) least = fabs(*x);
        if (!(fabs(*x) <= most)) most = fabs(*x);
    }
    return most == 0 || (least > 1e-120 && most < 1e120 && most < 1e20 * least);
}

/* Returns 0 if that is not exact. */
static int scale(outline *o, double by)
{
    size_t i;
    for (i = 0; i < dim_of(o) * o->n; ++i) o->corner[i] *= by;
    return is_tame(o->corner, dim_of(o) * o->n) && is_tame(o->normal, 3 * o->n);
}

/* Lengths and what follows from them scale with the corners; on the sphere they belong to the radius instead. */
static void claim_scaled(const outline *o, const measured *a, double by)
{
    outline other = *o;
    measured b;
    size_t i;
    double length = o->kind == SURFMINK_SPHERE ? 1 : by;
    if (!scale(&other, 1) || !scale(&other, by)) return;
    if (!measure_twice(&other, &b)) return;
    CLAIM(same_bits(a->turning, b.turning, o->n * sizeof *a->turning));
    for (i = 0; i < o->n; ++i) CLAIM(a->length[i] * length == b.length[i]);
    CLAIM(a->status == b.status);
    if (a->status == SURFMINK_OK) CLAIM(same_bits(a->mu, b.mu, sizeof a->mu));
}

/* --- turned by any angle, to rounding ----------------------------------------------------------------------------- */

static void turn_numbers(double *x, size_t n, size_t dim, double angle)
{
    double c = cos(angle), s = sin(angle), kept;
    for (; n > 0; --n, x += dim) {
        kept = x[0];
        x[0] = c * kept - s * x[1];
        x[1] = s * kept + c * x[1];
    }
}

static double size_of(const double *x, size_t dim)
{
    double sum = 0;
    for (; dim > 0; --dim) sum += x[dim - 1] * x[dim - 1];
    return sqrt(sum);
}

/* How far rounded coordinates may turn an edge, in radians; large if that says little about how far it turns in the
   tangent plane. */
static double rounding(const outline *o, const measured *m)
{
    double x[3], most = 0, worst = 0, least = HUGE_VAL, off, upright;
    size_t i, k, at, dim = dim_of(o), next;
    for (i = 0; i < o->n; ++i) {
        off = size_of(o->corner + dim * i, dim);
        if (off > most) most = off;
        if (m->length[i] < least) least = m->length[i];
        if (o->kind == SURFMINK_SPHERE && !(m->length[i] < 3 * o->radius)) return 1;
        if (!(fabs(m->turning[i]) < 3.14)) return 1;
        next = (i + 1) % o->n;
        for (at = i; o->kind == SURFMINK_EMBEDDED; at = next) {
            upright = 0;
            for (k = 0; k < 3; ++k) {
                x[k] = o->corner[3 * next + k] - o->corner[3 * i + k];
                upright += x[k] * o->normal[3 * at + k];
            }
            upright = fabs(upright) / (size_of(x, 3) * size_of(o->normal + 3 * at, 3));
            if (upright > worst) worst = upright;
            if (at == next) break;
        }
    }
    if (!(worst < 0.99 && least > 0)) return 1; /* a length may be too small for a double */
    return 4 * DBL_EPSILON * (o->kind == SURFMINK_SPHERE ? o->radius / least : most / least) / (1 - worst);
}

static void claim_turned(const outline *o, const measured *m, double angle)
{
    outline other = *o;
    measured b;
    double c, loose, off;
    int p;
    if (m->status != SURFMINK_OK) return;
    c = m->w.condition + fabs(m->w.curvature) / m->w.turning;
    off = rounding(o, m) * (double)o->n;
    loose = (1e-13 + 20 * RANK * off) * (1 + c) * (1 + c);
    if (!(loose < 0.01)) return;
    turn_numbers(other.corner, o->n, dim_of(o), angle);
    turn_numbers(other.normal, o->n, 3, angle);
    CLAIM(measure_twice(&other, &b) && b.status == SURFMINK_OK);
    CLAIM(fabs(m->w.length - b.w.length) <= (1e-14 + off) * m->w.length);
    CLAIM(fabs(m->w.turning - b.w.turning) <= (1e-14 * m->w.turning + 20 * off) * (1 + c));
    for (p = 0; p <= RANK; ++p) CLAIM(fabs(m->mu[p] - b.mu[p]) <= loose);
}

static inline void claim_invariants(const outline *o)
{
    outline other;
    measured m, b;
    double s = 0, turned = 0;
    size_t i;
    if (!measure_twice(o, &m)) return;
    claim_scaled(o, &m, 0x1p-40);
    claim_scaled(o, &m, 0x1p+101);
    if (has_spike(o, &m) || !is_tame(o->corner, dim_of(o) * o->n) || !is_tame(o->normal, 3 * o->n)) return;

    other = *o;
    relabel(&other, 1 + (size_t)fabs(fmod(o->corner[0], 7)));
    measure_twice(&other, &b);
    claim_alike(&m, &b);

    other = *o;
    rotate(&other);
    measure_twice(&other, &b);
    claim_alike(&m, &b);

    claim_turned(o, &m, 1);
    claim_turned(o, &m, 2.5 + (double)o->n);

    other = *o;
    backwards(&other);
    CLAIM(measure_twice(&other, &b));
    for (i = 0; i < o->n; ++i) {
        s += m.turning[i] + b.turning[i];
        turned += fabs(m.turning[i]);
    }
    CLAIM(fabs(s) <= 1e-14 * (turned + (double)o->n));
    if (m.status == SURFMINK_OK && m.w.condition < 1e6) /* in space S in [pi, 3 pi] is taken as it is, -S is not */
        CLAIM(b.status == SURFMINK_CLOCKWISE || (o->kind == SURFMINK_EMBEDDED && b.status == SURFMINK_CROSSES_ITSELF));

    mirror(&other); /* counter-clockwise again, seen in a mirror */
    measure_twice(&other, &b);
    claim_alike(&m, &b);
}

#endif
