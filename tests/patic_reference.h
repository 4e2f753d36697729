/* patic_reference.h - the definitions of docs/field.md once more, as they are written there: slowly, in long double,
   with rotation matrices and lists of vertices instead of mirrors and half-edges. For tests/test_patic.c; after
   tissues.h. */
#ifndef PATIC_REFERENCE_H
#define PATIC_REFERENCE_H

#include "tissues.h"

enum { REF_CELLS = 256, REF_CORNERS = 16 };

typedef long double real;

typedef struct ref_cell {
    size_t n, vertex[REF_CORNERS];
    real x[REF_CORNERS][3], normal[REF_CORNERS][3]; /* of the corners */
    real l[REF_CORNERS], alpha[REF_CORNERS], tau[REF_CORNERS][3], m[REF_CORNERS][3], nu[REF_CORNERS][3];
    real length, centre[3], n0[3], e1[3], e2[3];
    real z[2], mu;
} ref_cell;

typedef struct reference {
    size_t cells;
    ref_cell cell[REF_CELLS];
    real spacing;
    long chi, sum, boundary; /* the latter two times p */
    size_t faces, walks;
    real worst; /* how far charges times p are off whole numbers */
} reference;

static inline real ref_dot(const real *a, const real *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void ref_cross(const real *a, const real *b, real *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void ref_unit(real *a)
{
    real norm = sqrtl(ref_dot(a, a));
    int k;
    for (k = 0; k < 3; ++k) a[k] /= norm;
}

/* v turned by the smallest rotation that takes a to b: Rodrigues' formula. */
static inline void ref_turn(const real *a, const real *b, const real *v, real *out)
{
    real axis[3], across[3], sine, cosine = ref_dot(a, b), along;
    int k;
    ref_cross(a, b, axis);
    sine = sqrtl(ref_dot(axis, axis));
    for (k = 0; k < 3; ++k) out[k] = v[k];
    if (!(sine > 0)) return;
    for (k = 0; k < 3; ++k) axis[k] /= sine;
    along = ref_dot(axis, v);
    ref_cross(axis, v, across);
    for (k = 0; k < 3; ++k) out[k] = cosine * v[k] + sine * across[k] + (1 - cosine) * along * axis[k];
}

static inline real ref_wrap(real angle)
{
    const real two_pi = 2 * acosl(-1.0L);
    while (angle > two_pi / 2) angle -= two_pi;
    while (angle <= -two_pi / 2) angle += two_pi;
    return angle;
}

static inline real ref_angle(const ref_cell *c, const real *v)
{
    return atan2l(ref_dot(v, c->e2), ref_dot(v, c->e1));
}

/* The angle of e1 of i in the frame of j. */
static inline real ref_carried(const ref_cell *i, const ref_cell *j)
{
    real v[3];
    ref_turn(i->n0, j->n0, i->e1, v);
    return ref_angle(j, v);
}

/* Section 1 of the definitions, for rank p. */
static inline void ref_measure(const tissue *s, size_t c, int p, ref_cell *o)
{
    const real two_pi = 2 * acosl(-1.0L), radius = 2;
    real total = 0, phase = 0, g[2] = {0, 0}, sum[2] = {0, 0}, mean[3] = {0, 0, 0}, arg;
    size_t i, j, k;
    o->n = s->offset[c + 1] - s->offset[c];
    for (i = 0; i < o->n; ++i)
        for (k = 0; k < 3; ++k) {
            o->x[i][k] = (real)s->corner[3 * (s->offset[c] + i) + k];
            o->normal[i][k] = s->kind == SURFMINK_PLANE ? k == 2 : (real)s->normal[3 * (s->offset[c] + i) + k];
            if (s->kind == SURFMINK_PLANE && k == 2) o->x[i][k] = 0;
        }
    for (i = 0; i < o->n; ++i) {
        if (s->kind == SURFMINK_SPHERE) {
            ref_unit(o->x[i]);
            for (k = 0; k < 3; ++k) o->normal[i][k] = o->x[i][k];
        }
        ref_unit(o->normal[i]);
    }
    for (i = 0; i < o->n; ++i) {
        real e[3], part;
        j = (i + 1) % o->n;
        for (k = 0; k < 3; ++k) e[k] = o->x[j][k] - o->x[i][k];
        o->l[i] = sqrtl(ref_dot(e, e));
        if (s->kind == SURFMINK_SPHERE) o->l[i] = 2 * radius * asinl(o->l[i] / 2);
        for (k = 0; k < 3; ++k) {
            o->tau[i][k] = e[k];
            o->m[i][k] = o->normal[i][k] + o->normal[j][k];
        }
        ref_unit(o->tau[i]);
        part = ref_dot(o->m[i], o->tau[i]);
        for (k = 0; k < 3; ++k) o->m[i][k] -= part * o->tau[i][k];
        ref_unit(o->m[i]);
        ref_cross(o->tau[i], o->m[i], o->nu[i]);
    }
    o->length = 0;
    for (k = 0; k < 3; ++k) o->centre[k] = 0;
    for (i = 0; i < o->n; ++i) {
        const real *in = o->tau[(i + o->n - 1) % o->n], *out = o->tau[i], *n = o->normal[i];
        real across[3];
        ref_cross(in, out, across);
        o->alpha[i] = atan2l(ref_dot(n, across), ref_dot(in, out) - ref_dot(in, n) * ref_dot(out, n));
        total += o->alpha[i];
        o->length += o->l[i];
        for (k = 0; k < 3; ++k) {
            mean[k] += o->l[i] * o->m[i][k];
            o->centre[k] += o->l[i] * (o->x[i][k] + o->x[(i + 1) % o->n][k]) / 2;
        }
    }
    ref_unit(mean);
    for (k = 0; k < 3; ++k) {
        o->n0[k] = mean[k];
        o->centre[k] = s->kind == SURFMINK_SPHERE ? radius * mean[k] : o->centre[k] / o->length;
    }
    ref_turn(o->m[0], o->n0, o->nu[0], o->e1);
    ref_cross(o->n0, o->e1, o->e2);
    for (i = 0; i < o->n; ++i) {
        real tilted[3], chi;
        if (i > 0) phase += two_pi / total * o->alpha[i];
        ref_turn(o->m[i], o->n0, o->nu[i], tilted);
        chi = ref_angle(o, tilted);
        g[0] += o->l[i] * cosl(p * phase);
        g[1] += o->l[i] * sinl(p * phase);
        sum[0] += o->l[i] * cosl(p * (chi - phase));
        sum[1] += o->l[i] * sinl(p * (chi - phase));
    }
    o->mu = hypotl(g[0], g[1]) / o->length;
    arg = atan2l(g[1], g[0]) + atan2l(sum[1], sum[0]);
    o->z[0] = o->mu * cosl(arg);
    o->z[1] = o->mu * sinl(arg);
    if (o->mu < 1e-12L || hypotl(sum[0], sum[1]) / o->length < 1e-12L) o->z[0] = o->z[1] = 0;
}

/* Corners within the tolerance get the same number. */
static inline void ref_weld(reference *r, real tolerance)
{
    size_t a, b, i, j, changed = 1, next = 0;
    for (a = 0; a < r->cells; ++a)
        for (i = 0; i < r->cell[a].n; ++i) r->cell[a].vertex[i] = next++;
    while (changed) {
        changed = 0;
        for (a = 0; a < r->cells; ++a)
            for (i = 0; i < r->cell[a].n; ++i)
                for (b = 0; b < r->cells; ++b)
                    for (j = 0; j < r->cell[b].n; ++j) {
                        real d[3];
                        int k;
                        if (r->cell[b].vertex[j] <= r->cell[a].vertex[i]) continue;
                        for (k = 0; k < 3; ++k) d[k] = r->cell[a].x[i][k] - r->cell[b].x[j][k];
                        if (sqrtl(ref_dot(d, d)) > tolerance) continue;
                        r->cell[b].vertex[j] = r->cell[a].vertex[i];
                        changed = 1;
                    }
    }
}

/* The cell in which b is followed by a, if in cell c a is followed by b; cells if there is none. *at: where b is. */
static inline size_t ref_across(const reference *r, size_t a, size_t b, size_t *at)
{
    size_t c;
    for (c = 0; c < r->cells; ++c)
        for (*at = 0; *at < r->cell[c].n; ++*at)
            if (r->cell[c].vertex[*at] == b && r->cell[c].vertex[(*at + 1) % r->cell[c].n] == a) return c;
    return c;
}

static inline real ref_argument(const real *z)
{
    return z[0] == 0 && z[1] == 0 ? 0 : atan2l(z[1], z[0]);
}

/* w from i to j: computed once, from the cell that comes first. */
static inline real ref_step(const reference *r, int p, size_t i, size_t j)
{
    if (i > j) return -ref_step(r, p, j, i);
    return ref_wrap(ref_argument(r->cell[j].z) - ref_argument(r->cell[i].z) -
                    p * ref_carried(&r->cell[i], &r->cell[j]));
}

/* The fan of cells round a vertex, counter-clockwise from cell c on; 0 if it is open. */
static inline size_t ref_fan(const reference *r, size_t c, size_t corner, size_t *fan)
{
    size_t v = r->cell[c].vertex[corner], first = c, count = 0, at = corner;
    do {
        size_t n = r->cell[c].n, before = r->cell[c].vertex[(at + n - 1) % n];
        fan[count++] = c;
        c = ref_across(r, before, v, &at);
    } while (c < r->cells && c != first);
    return c == first ? count : 0;
}

/* p times the charge of a fan. */
static inline real ref_charge(const reference *r, int p, const size_t *fan, size_t count)
{
    const real two_pi = 2 * acosl(-1.0L);
    real pole[3] = {0, 0, 0}, sum = 0, area = 0, across[3];
    size_t i;
    int k;
    for (i = 0; i < count; ++i) {
        for (k = 0; k < 3; ++k) pole[k] += r->cell[fan[i]].n0[k];
        sum += ref_step(r, p, fan[i], fan[(i + 1) % count]);
    }
    ref_unit(pole);
    for (i = 0; i < count; ++i) {
        const real *b = r->cell[fan[i]].n0, *c = r->cell[fan[(i + 1) % count]].n0;
        ref_cross(b, c, across);
        area += 2 * atan2l(ref_dot(pole, across), 1 + ref_dot(pole, b) + ref_dot(b, c) + ref_dot(c, pole));
    }
    return (sum + p * area) / two_pi;
}

/* The next step of a boundary walk that has come to cell c across its edge `at`: along the outline of c to the next
   edge with a cell behind it. *at becomes that edge of c, and *to the cell. */
static inline void ref_onward(const reference *r, size_t c, size_t *at, size_t *to)
{
    size_t n = r->cell[c].n, back;
    do {
        *at = (*at + 1) % n;
        *to = ref_across(r, r->cell[c].vertex[*at], r->cell[c].vertex[(*at + 1) % n], &back);
    } while (*to == r->cells);
}

static inline void ref_chord(const reference *r, size_t i, size_t j, real *chord)
{
    int k;
    for (k = 0; k < 3; ++k) chord[k] = r->cell[j].centre[k] - r->cell[i].centre[k];
}

/* p times b of the walk that leaves cell c across its edge `at`; marks its steps in done[cell][edge]. Two cells that
   share several edges are not for this function. */
static inline real ref_walk(const reference *r, int p, size_t c, size_t at, char done[REF_CELLS][REF_CORNERS])
{
    const real two_pi = 2 * acosl(-1.0L);
    real sum = 0, chord[3], back[3], beta, turn;
    size_t i = c, edge = at, j, k, came;
    do {
        done[i][edge] = 1;
        j = ref_across(r, r->cell[i].vertex[edge], r->cell[i].vertex[(edge + 1) % r->cell[i].n], &came);
        ref_chord(r, i, j, chord);
        turn = ref_wrap(ref_angle(&r->cell[j], chord) - ref_angle(&r->cell[i], chord) -
                        ref_carried(&r->cell[i], &r->cell[j]));
        ref_chord(r, j, i, back);
        edge = came;
        ref_onward(r, j, &edge, &k);
        ref_chord(r, j, k, chord);
        beta = k == i ? two_pi : ref_angle(&r->cell[j], chord) - ref_angle(&r->cell[j], back);
        while (beta <= 0) beta += two_pi;
        while (beta > two_pi) beta -= two_pi;
        sum += p * (turn + beta - two_pi / 2) - ref_step(r, p, i, j);
        i = j;
    } while (!done[i][edge]);
    return sum / two_pi;
}

static inline void ref_build(reference *r, const tissue *s, int p, real tolerance)
{
    size_t c;
    r->cells = s->cells;
    for (c = 0; c < s->cells; ++c) ref_measure(s, c, p, &r->cell[c]);
    ref_weld(r, tolerance);
}

static inline real ref_distance(const ref_cell *i, const ref_cell *j)
{
    real d[3], cosine = ref_dot(i->n0, j->n0), h = cosine >= 1 ? 0 : acosl(cosine) / 2;
    int k;
    for (k = 0; k < 3; ++k) d[k] = i->centre[k] - j->centre[k];
    return sqrtl(ref_dot(d, d)) * (h > 0 ? h / sinl(h) : 1);
}

static inline int ref_are_neighbours(const reference *r, size_t i, size_t j)
{
    size_t k, at;
    for (k = 0; k < r->cell[i].n; ++k)
        if (ref_across(r, r->cell[i].vertex[k], r->cell[i].vertex[(k + 1) % r->cell[i].n], &at) == j) return 1;
    return 0;
}

/* Charges of all corners and boundary walks of the field in cell[].z. */
static inline void ref_charges(reference *r, int p)
{
    static char done[REF_CELLS][REF_CORNERS], in_face[REF_CELLS][REF_CORNERS];
    size_t c, k, i, fan[REF_CELLS], count, at, edges = 0, pairs = 0;
    memset(done, 0, sizeof done);
    memset(in_face, 0, sizeof in_face);
    r->chi = (long)r->cells;
    r->sum = r->boundary = 0;
    r->faces = r->walks = 0;
    r->worst = r->spacing = 0;
    for (c = 0; c < r->cells; ++c)
        for (k = 0; k < r->cell[c].n; ++k) {
            real charge;
            size_t n = r->cell[c].n;
            if (ref_across(r, r->cell[c].vertex[k], r->cell[c].vertex[(k + 1) % n], &at) < r->cells) ++edges;
            count = ref_fan(r, c, k, fan);
            if (count == 0) continue;
            in_face[c][k] = 1; /* the step across the edge that begins here has this vertex on its right */
            for (i = 0; i < count && fan[i] >= c; ++i) continue;
            if (i < count) continue; /* seen from a cell before */
            ++r->chi;
            ++r->faces;
            if (count < 3) continue;
            charge = ref_charge(r, p, fan, count);
            r->sum += lroundl(charge);
            r->worst = fmaxl(r->worst, fabsl(charge - roundl(charge)));
        }
    r->chi -= (long)edges / 2;
    for (c = 0; c < r->cells; ++c) {
        int alone = 1;
        for (k = 0; k < r->cell[c].n; ++k) {
            size_t n = r->cell[c].n;
            real b;
            if (ref_across(r, r->cell[c].vertex[k], r->cell[c].vertex[(k + 1) % n], &at) == r->cells) continue;
            alone = 0;
            if (done[c][k] || in_face[c][k]) continue;
            b = ref_walk(r, p, c, k, done);
            ++r->walks;
            r->boundary += lroundl(b);
            r->worst = fmaxl(r->worst, fabsl(b - roundl(b)));
        }
        if (alone) r->boundary += p, ++r->walks;
    }
    for (c = 0; c < r->cells; ++c)
        for (k = c + 1; k < r->cells; ++k) {
            if (!ref_are_neighbours(r, c, k)) continue;
            r->spacing += ref_distance(&r->cell[c], &r->cell[k]);
            ++pairs;
        }
    if (pairs) r->spacing /= (real)pairs;
}

/* z of cell j, carried to cell i. */
static inline void ref_carry(const reference *r, int p, size_t j, size_t i, real out[2])
{
    real angle = i == j ? 0 : p * ref_carried(&r->cell[j], &r->cell[i]);
    out[0] = r->cell[j].z[0] * cosl(angle) - r->cell[j].z[1] * sinl(angle);
    out[1] = r->cell[j].z[0] * sinl(angle) + r->cell[j].z[1] * cosl(angle);
}

/* Z of cell i. */
static inline void ref_coarse(const reference *r, int p, size_t i, real radius, real out[2])
{
    char reached[REF_CELLS] = {0};
    real weight = 0, carried[2];
    size_t a, b, changed = 1;
    reached[i] = 1;
    while (changed)
        for (changed = 0, a = 0; a < r->cells; ++a)
            for (b = 0; b < r->cells && reached[a]; ++b) {
                if (reached[b] || ref_distance(&r->cell[i], &r->cell[b]) > radius ||
                    !(ref_dot(r->cell[i].n0, r->cell[b].n0) > 0) || !ref_are_neighbours(r, a, b))
                    continue;
                reached[b] = 1;
                changed = 1;
            }
    out[0] = out[1] = 0;
    for (a = 0; a < r->cells; ++a) {
        if (!reached[a]) continue;
        ref_carry(r, p, a, i, carried);
        out[0] += r->cell[a].length * carried[0];
        out[1] += r->cell[a].length * carried[1];
        weight += r->cell[a].length;
    }
    out[0] /= weight;
    out[1] /= weight;
}

/* G of the pairs whose distance lies in [low, high). */
static inline real ref_correlation(const reference *r, int p, real low, real high, size_t *pairs)
{
    real sum = 0, weight = 0, carried[2], d;
    size_t i, j;
    *pairs = 0;
    for (i = 0; i < r->cells; ++i)
        for (j = 0; j < i; ++j) {
            d = ref_distance(&r->cell[i], &r->cell[j]);
            if (!(ref_dot(r->cell[i].n0, r->cell[j].n0) > 0) || d < low || d >= high) continue;
            ref_carry(r, p, j, i, carried);
            ++*pairs;
            sum += r->cell[i].z[0] * carried[0] + r->cell[i].z[1] * carried[1];
            weight += hypotl(r->cell[i].z[0], r->cell[i].z[1]) * hypotl(r->cell[j].z[0], r->cell[j].z[1]);
        }
    return weight > 0 ? sum / weight : 0;
}

#endif
