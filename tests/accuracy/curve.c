/* curve.c - smooth curves against quadruple precision, and how well their errors are estimated.

     gcc -O2 -I. tests/accuracy/curve.c -o curve -lquadmath -lm
     ./curve 400                                            so many curves of each kind; exit status 1 above a limit

   The first table: worst rounding errors of order 4. The reference below is the scheme of docs/internals/beyond.md,
   written once more, from its formulas: turns as differences of angles in a frame of the tangent plane, geodesic
   curvature on the line through two points, every sin(x) / x by itself. Corners are doubles and taken as exact.

   The other tables: how often errors of random curves are within their estimates. tests/curves.h draws the curves. */
#define SURFMINK_STATIC
#include "surfmink.h"

#if !defined(__SIZEOF_FLOAT128__) || (defined(__has_include) && !__has_include(<quadmath.h>))
#error "curve.c needs quadruple precision: gcc with libquadmath, for instance on x86-64 or ppc64le"
#endif
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>

#include "../curves.h"

typedef __float128 quad;

enum { P = 12, FINEST = 2048 };
enum { LENGTH, TURNING, MU, ANGLE, AREA, QUANTITIES };

/* As surfmink.h promises of polygons, times two: the arcs are known from more numbers that are rounded. */
static const struct {
    const char *name, *meaning;
    double limit;
} quantity[QUANTITIES] = {
    {"L", "relative", 2e-15},
    {"S", "relative, against c", 4e-15},
    {"mu", "p <= 12, against 1 + c", 2e-14},
    {"angle", "mu_p |p theta_p - reference|, p <= 12, against 1 + c", 2e-14},
    {"area", "relative", 4e-15},
};

/* --- the reference ------------------------------------------------------------------------------------------------ */

static quad dot(const quad a[3], const quad b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const quad a[3], const quad b[3], quad c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void unit(quad a[3])
{
    quad norm = sqrtq(dot(a, a));
    int k;
    for (k = 0; k < 3; ++k) a[k] /= norm;
}

/* The direction of a vector in the plane orthogonal to n, as an angle from a fixed axis. */
static quad direction(const quad n[3], const quad v[3])
{
    quad axis[3] = {0, 0, 0}, e1[3], e2[3];
    int k, least = 0;
    for (k = 1; k < 3; ++k)
        if (fabsq(n[k]) < fabsq(n[least])) least = k;
    axis[least] = 1;
    cross(axis, n, e1);
    unit(e1);
    cross(n, e1, e2);
    return atan2q(dot(v, e2), dot(v, e1));
}

/* What is known of a curve, and what comes out. */
typedef struct arcs {
    size_t n;
    int chords; /* else geodesics of curvature k */
    quad k, l[FINEST], alpha[FINEST], a[FINEST], w[FINEST];
    const unsigned char *sharp;
    quad length, turning, turned, area, g[2 * P + 2];
} arcs;

static void measure(const quad *x, const quad *normal, arcs *c)
{
    size_t i, k, n = c->n;
    for (i = 0; i < n; ++i) {
        const quad *here = x + 3 * i, *next = x + 3 * ((i + 1) % n), *before = x + 3 * ((i + n - 1) % n);
        const quad *m = normal + 3 * i, *m_next = normal + 3 * ((i + 1) % n);
        quad e[3], in[3], b[3], mean[3], d[3], along;
        for (k = 0; k < 3; ++k) {
            e[k] = next[k] - here[k];
            in[k] = here[k] - before[k];
        }
        c->alpha[i] = direction(m, e) - direction(m, in);
        c->alpha[i] -= 2 * M_PIq * roundq(c->alpha[i] / (2 * M_PIq));
        c->l[i] = sqrtq(dot(e, e));
        if (!c->chords && c->k > 0) c->l[i] = 2 * asinq(c->l[i] / 2);
        unit(e);
        along = dot(m, e) + dot(m_next, e);
        for (k = 0; k < 3; ++k) {
            mean[k] = m[k] + m_next[k] - along * e[k];
            d[k] = m_next[k] - m[k];
        }
        unit(mean);
        cross(mean, e, b);
        c->a[i] = c->chords ? -dot(d, e) : 0;
        c->w[i] = c->chords ? -dot(d, b) : 0;
    }
}

/* Where kv of corner j lies on the line on which x_i is 0, and its value. */
static quad place(const arcs *c, size_t i, ptrdiff_t steps, quad *kv)
{
    size_t n = c->n, j = (i + n + (size_t)steps) % n, b = (j + n - 1) % n, k;
    quad at = (c->l[j] - c->l[b]) / 3;
    for (k = 0; steps > 0 && k < (size_t)steps; ++k) at += c->l[(i + k) % n];
    for (k = 0; steps < 0 && k < (size_t)-steps; ++k) at -= c->l[(i + n - 1 - k) % n];
    *kv = 2 * (c->alpha[j] + (c->a[j] * c->w[j] - c->a[b] * c->w[b]) / 6) / (c->l[b] + c->l[j]);
    return at;
}

static int sharp(const arcs *c, size_t i, ptrdiff_t steps)
{
    return c->sharp && c->sharp[(i + c->n + (size_t)steps) % c->n];
}

/* Geodesic curvature in the middle of edge i, and its slope: the line through kv of two corners of the arc. */
static quad curvature(const arcs *c, size_t i, quad *slope)
{
    ptrdiff_t from = 0, to = 1;
    quad one, two, at_one, at_two;
    *slope = 0;
    if (sharp(c, i, 0) && sharp(c, i, 1)) return 0;
    if (sharp(c, i, 0)) from = 1, to = sharp(c, i, 2) ? 1 : 2;
    if (sharp(c, i, 1)) to = 0, from = sharp(c, i, -1) ? 0 : -1;
    at_one = place(c, i, from, &one);
    at_two = place(c, i, to, &two);
    if (from == to) return one;
    *slope = (two - one) / (at_two - at_one);
    return one + *slope * (c->l[i] / 2 - at_one);
}

static quad torsion_change(const arcs *c, size_t i)
{
    size_t n = c->n, b = (i + n - 1) % n, f = (i + 1) % n;
    quad c0 = (c->l[b] + c->l[i]) / 2, c1 = (c->l[i] + c->l[f]) / 2, t = c->w[i] / c->l[i];
    quad down = (t - c->w[b] / c->l[b]) / c0, up = (c->w[f] / c->l[f] - t) / c1;
    if (sharp(c, i, 0) && sharp(c, i, 1)) return 0;
    if (sharp(c, i, 0)) return up;
    if (sharp(c, i, 1)) return down;
    return (up * c0 + down * c1) / (c0 + c1);
}

static void fourth(arcs *c)
{
    static quad swept[FINEST], e[FINEST], turn[FINEST];
    quad slope, lead = 0, phase = 0;
    size_t n = c->n, i, b;
    int p;
    c->length = c->turning = c->turned = c->area = 0;
    for (p = 0; p <= 2 * P + 1; ++p) c->g[p] = 0;
    for (i = 0; i < n; ++i) {
        swept[i] = curvature(c, i, &slope) * c->l[i];
        if (i == 0) lead = slope * c->l[0] * c->l[0] / 24;
        e[i] = c->chords ? (c->a[i] * torsion_change(c, i) * c->l[i] * c->l[i] +
                            swept[i] * (c->a[i] * c->a[i] - c->w[i] * c->w[i])) /
                               12
                         : c->k * swept[i] * c->l[i] * c->l[i] / 12;
        c->area += swept[i] * c->l[i] * c->l[i] / 12;
    }
    for (i = 0; i < n; ++i) {
        b = (i + n - 1) % n;
        turn[i] = c->alpha[i] + (c->a[i] * c->w[i] - c->a[b] * c->w[b]) / 6 - (e[b] + e[i]) / 2;
        c->turning += turn[i];
        c->turned += fabsq(turn[i]);
    }
    for (i = 0; i < n; ++i) {
        quad h = c->l[i] * (1 + (swept[i] * swept[i] + c->a[i] * c->a[i]) / 24);
        c->length += h;
        if (i > 0) phase += 2 * M_PIq / c->turning * turn[i];
        for (p = 1; p <= P; ++p) {
            quad x = p * M_PIq * swept[i] / c->turning, f = p * (phase + 2 * M_PIq / c->turning * lead);
            quad part = x == 0 ? h : h * sinq(x) / x;
            c->g[2 * p] += part * cosq(f);
            c->g[2 * p + 1] += part * sinq(f);
        }
    }
}

/* --- rounding errors ---------------------------------------------------------------------------------------------- */

static double scratch[SURFMINK_CURVE_SCRATCH(FINEST, P)], worst[QUANTITIES];

/* NaN is the worst. */
static void judge(int what, double off)
{
    if (!(off <= worst[what])) worst[what] = off;
}

/* Area of the polygon in the plane, or on the unit sphere by its turns. */
static quad polygon_area(const arcs *c, const quad *x)
{
    quad area = 0;
    size_t i, n = c->n;
    if (c->k > 0) {
        for (area = 2 * M_PIq, i = 0; i < n; ++i) area -= c->alpha[i];
        return area;
    }
    for (i = 0; i < n; ++i) {
        const quad *a = x + 3 * i, *b = x + 3 * ((i + 1) % n);
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    return area;
}

static int survey(int where, int geodesics, int curves)
{
    static double corner[3 * FINEST], normal[3 * FINEST];
    static quad x[3 * FINEST], m[3 * FINEST];
    static unsigned char marks[FINEST];
    static arcs c;
    chance luck = {1000 + (uint64_t)where};
    int round, p, k, failed = 0;
    for (k = 0; k < QUANTITIES; ++k) worst[k] = 0;
    for (round = 0; round < curves; ++round) {
        wobble w = some_wobble(&luck, where);
        double mu[P + 1], g[2 * P + 2], condition;
        surfmink_functionals f;
        surfmink_outline o;
        surfmink_curve_options options = {4, NULL, 0, NULL};
        surfmink_curve_results out = {NULL, NULL, NULL, NULL};
        size_t i, j, dim = where == IN_THE_PLANE ? 2 : 3;
        int status;
        c.n = 8 + one_of(&luck, round % 20 ? 120 : 2000);
        c.chords = !geodesics;
        c.k = where == ON_A_SPHERE ? 1 : 0;
        c.sharp = round % 3 ? NULL : marks;
        for (i = 0; i < c.n; ++i) marks[i] = one_of(&luck, 5) == 0;
        wobble_points(&w, c.n, corner, normal);
        for (i = 0; i < c.n; ++i) {
            for (j = 0; j < 3; ++j) {
                x[3 * i + j] = j < dim ? corner[dim * i + j] : 0;
                m[3 * i + j] = where == IN_THE_PLANE ? j == 2 : where == ON_A_SPHERE ? x[3 * i + j] : normal[3 * i + j];
            }
            unit(m + 3 * i);
            for (j = 0; j < 3 && where == ON_A_SPHERE && geodesics; ++j) x[3 * i + j] = m[3 * i + j];
        }
        measure(x, m, &c);
        fourth(&c);
        o = surfmink_embedded(corner, where == ON_A_SPHERE ? corner : normal, c.n);
        if (where == IN_THE_PLANE) o = surfmink_plane(corner, c.n);
        if (where == ON_A_SPHERE && geodesics) o = surfmink_sphere(corner, c.n, 1);
        options.sharp = c.sharp;
        out.mu = mu;
        out.g = g;
        out.w = &f;
        status = surfmink_curve(&o, &options, P, scratch, &out, NULL);
        if (status != SURFMINK_OK) {
            printf("curve %d: %s\n", round, surfmink_curve_strerror(status));
            return 1;
        }
        condition = fmax(1, (double)(c.turned / c.turning));
        judge(LENGTH, fabs((double)(f.length / c.length - 1)));
        judge(TURNING, fabs((double)(f.turning / c.turning - 1)) / condition);
        if (geodesics) judge(AREA, fabs((double)(f.area / (polygon_area(&c, x) + c.area) - 1)));
        for (p = 1; p <= P; ++p) {
            quad modulus = sqrtq(c.g[2 * p] * c.g[2 * p] + c.g[2 * p + 1] * c.g[2 * p + 1]) / c.length;
            quad turn = atan2q(g[2 * p + 1], g[2 * p]) - atan2q(c.g[2 * p + 1], c.g[2 * p]);
            turn -= 2 * M_PIq * roundq(turn / (2 * M_PIq));
            judge(MU, fabs((double)(mu[p] - modulus)) / (1 + condition));
            judge(ANGLE, fabs((double)(turn * modulus)) / (1 + condition));
        }
    }
    for (k = 0; k < QUANTITIES; ++k) {
        printf("  %s %.1e", quantity[k].name, worst[k]);
        if (!(worst[k] <= quantity[k].limit)) ++failed;
    }
    printf("\n");
    return failed;
}

/* --- estimates ---------------------------------------------------------------------------------------------------- */

/* One line of the table. If it is in docs/internals/beyond.md, the page must have it; returns whether it has not. */
static int print_estimates(const char *which, int order, estimates *e, int is_documented)
{
    static char page[100000];
    char line[200];
    double known = e->known ? (double)e->known : 1;
    FILE *file = is_documented && !*page ? fopen("docs/internals/beyond.md", "r") : NULL;
    if (file) page[fread(page, 1, sizeof page - 1, file)] = '\0';
    if (file) fclose(file);
    sprintf(line, "| %s | %d | %d | %.1f | %.2f | %.2f | %.1f | %.2f |\n", which, order, (int)e->all,
            100 * (double)e->known / (double)e->all, 100 * (double)e->within / known,
            100 * (double)e->within_three / known, e->worst, estimate_median(e));
    printf("%s", line);
    if (!is_documented || strstr(page, line)) return 0;
    puts("docs/internals/beyond.md does not have this line");
    return 1;
}

/* What is asked of all together: within the estimate in 95 %, within three times it in 99.9 %, and half of the errors
   above a tenth of it. */
static int falls_short(estimates *e)
{
    return !((double)e->within >= 0.95 * (double)e->known && (double)e->within_three >= 0.999 * (double)e->known &&
             estimate_median(e) >= 0.1);
}

static int survey_estimates(int set, int curves)
{
    static estimates e[PLACES][2][CORNER_RANGES], none;
    estimates sum;
    char which[40];
    int place, order, round, refused = 0, failed = 0, is_documented = set == JUDGED_BY && curves == 200;
    size_t range;
    memset(e, 0, sizeof e);
    for (place = 0; place < PLACES; ++place) {
        chance luck = {7000 + (uint64_t)(100 * set + place)};
        for (round = 0; round < curves; ++round) refused += estimate_curve(&luck, set, place, e[place]);
    }
    printf("\n%s; %d curves on each surface, %d refused\n",
           set == FOUND_WITH ? "families that the rules were found with" : "families that judge", curves, refused);
    printf("| corners, surface | order | errors | known, %% | within, %% | within 3 times, %% | worst | median |\n");
    for (order = 2; order <= 4; order += 2) {
        for (range = 0; range < CORNER_RANGES; ++range) {
            for (sum = none, place = 0; place < PLACES; ++place) estimate_add(&sum, &e[place][order / 4][range]);
            sprintf(which, "%d to %d", (int)corner_range[range], (int)corner_range[range + 1] - 1);
            failed += print_estimates(which, order, &sum, is_documented);
            free(sum.ratio);
        }
        for (place = 0; place < PLACES; ++place) {
            for (sum = none, range = 0; range < CORNER_RANGES; ++range) estimate_add(&sum, &e[place][order / 4][range]);
            failed += print_estimates(place_name[place], order, &sum, 0);
            if (is_documented && !(100 * (double)sum.within >= 99.6 * (double)sum.known)) {
                puts("docs/internals/beyond.md says that 99.6 % are within");
                ++failed;
            }
            free(sum.ratio);
        }
        for (sum = none, place = 0; place < PLACES; ++place)
            for (range = 0; range < CORNER_RANGES; ++range) estimate_add(&sum, &e[place][order / 4][range]);
        failed += print_estimates("all", order, &sum, is_documented);
        failed += falls_short(&sum);
        free(sum.ratio);
    }
    for (place = 0; place < PLACES; ++place)
        for (order = 0; order < 2; ++order)
            for (range = 0; range < CORNER_RANGES; ++range) free(e[place][order][range].ratio);
    return failed + refused;
}

int main(int argc, char **argv)
{
    int curves = argc > 1 ? atoi(argv[1]) : 400, failed = 0, k;
    printf("worst rounding errors of order 4 over %d curves of each kind; limits:", curves);
    for (k = 0; k < QUANTITIES; ++k) printf(" %s %.0e (%s)", quantity[k].name, quantity[k].limit, quantity[k].meaning);
    printf("\nplane                 ");
    failed += survey(IN_THE_PLANE, 1, curves);
    printf("sphere, great circles ");
    failed += survey(ON_A_SPHERE, 1, curves);
    printf("sphere, chords        ");
    failed += survey(ON_A_SPHERE, 0, curves);
    printf("ellipsoid, chords     ");
    failed += survey(ON_AN_ELLIPSOID, 0, curves);
    printf("torus, chords         ");
    failed += survey(ON_A_TORUS, 0, curves);
    printf("%d figures above their limits\n", failed);
    failed += survey_estimates(FOUND_WITH, curves);
    failed += survey_estimates(JUDGED_BY, curves);
    return failed != 0;
}
