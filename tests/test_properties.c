/* What the eigenvalues say about shapes: section 3 of the paper, theorem by theorem.
   cc -I. tests/test_properties.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <float.h>

#include "harness.h"

#include "families.h"

#define P 12

/* --- the same outline, drawn otherwise (3.1, 3.2) ----------------------------------------------------------------- */

/* One table: what is done to an outline x its family x its surface x the way to measure. All of it is exact, so that
   nothing may change but by the rounding of two measurements: LIMIT, as ACCURACY grants it. */
enum change { FIRST_CORNER, QUARTER_TURN, MIRROR, UNIT, CHANGES };
static const char *const change_name[CHANGES] = {"another first corner", "turned", "in a mirror", "another unit"};
enum way { SINGLE, STEPS, BATCH, WAYS };
static const char *const way_name[WAYS] = {"single call", "steps", "batch"};

enum { LENGTH, TURNING, AREA, MU, LIMITS };
static const double LIMIT[LIMITS] = {
    2 * 1e-15, /* relative */
    2 * 2e-15, /* relative, times c = (sum |alpha| + |2 pi - S|) / S */
    2 * 2e-15, /* of half the sum of |x_i - x_0| l_i; in space, where it is an estimate, 1000 times that */
    2 * 1e-14, /* times 1 + c + c^2 / 10; so p theta_p of g_p, times mu_p */
};

typedef struct found {
    double mu[P + 1], theta[P + 1];
    surfmink_functionals w;
    int status;
} found;

static double length_of[LONGEST], turning_of[LONGEST];

static void find(enum way way, const surfmink_outline *o, found *f)
{
    double g[2 * P + 2], *phase = turning_of;
    size_t offset[2] = {0, 0};
    surfmink_results out = {NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    memset(f, 0, sizeof *f);
    if (way == SINGLE) f->status = surfmink_measure(o, P, f->mu, g, &f->w, NULL);
    if (way == STEPS) {
        f->status = surfmink_edges(o, length_of, turning_of, NULL);
        if (!f->status) f->status = surfmink_total(o, length_of, turning_of, o->n, &f->w);
        if (!f->status) f->status = surfmink_phases(turning_of, o->n, SURFMINK_CORRECTED, phase);
        if (!f->status) f->status = surfmink_irreducible(length_of, phase, o->n, P, g);
        if (!f->status) f->status = surfmink_spectrum(g, P, NULL, f->mu, NULL);
    }
    if (way == BATCH) {
        offset[1] = o->n;
        out.status = &f->status, out.length = &f->w.length, out.turning = &f->w.turning, out.area = &f->w.area;
        out.mu = f->mu, out.g = g;
        surfmink_batch(o, offset, 1, P, &out, NULL);
    }
    if (!f->status) CHECK_OK(surfmink_spectrum(g, P, NULL, NULL, f->theta));
}

/* What is known of an outline before: by how much its area may be wrong, and whether it is a matter of rounding what is
   said of it, for then the least change may change that. */
typedef struct nature {
    int edges, delicate;
    double half;   /* half the sum of |x_i - x_0| l_i */
    double cancel; /* in space: that over the vector area, by which the rounding of its direction is amplified */
    double phase[LONGEST];
} nature;

static void study(const drawn *d, nature *m)
{
    const surfmink_outline *o = &d->view;
    size_t i, k, dim = d->lies == ON_PLANE || d->lies == BY_CALLBACKS || d->lies == IN_HYPERBOLIC_PLANE ? 2 : 3;
    int round = d->lies == ON_SPHERES || d->lies == ON_CALLED_SPHERE;
    double s = 0, turned = 0, noise, first[3], x[3], area = 0, vector[3] = {0, 0, 0}, largest = 0;
    m->half = m->cancel = m->delicate = 0;
    m->edges = surfmink_edges(o, length_of, turning_of, NULL);
    if (m->edges) return;
    for (i = 0; i < o->n; ++i) {
        double most = 0, square = 0;
        for (k = 0; k < dim; ++k) most = fmax(most, fabs(x[k] = d->corner[dim * i + k]));
        for (k = 0; k < dim && round; ++k) square += x[k] / most * (x[k] / most);
        for (k = 0; k < dim && round; ++k) x[k] *= d->radius / most / sqrt(square);
        if (i == 0) memcpy(first, x, sizeof x);
        for (square = 0, most = 0, k = 0; k < dim; ++k) most = fmax(most, fabs(x[k] - first[k]));
        for (k = 0; k < dim && most > 0; ++k) square += (x[k] - first[k]) / most * ((x[k] - first[k]) / most);
        m->half += most * sqrt(square) * length_of[i] / 2;
        largest = fmax(largest, most);
        if (fabs(turning_of[i]) > PI - 1e-9) m->delicate = 1;         /* a spike has no sign */
        if (round && length_of[i] > 3.1 * d->radius) m->delicate = 1; /* next to antipodes */
        s += turning_of[i];
        turned += fabs(turning_of[i]);
    }
    for (i = 0; i < o->n && d->lies == ON_SURFACES; ++i) {
        const double *at = d->corner + 3 * i, *next = d->corner + 3 * ((i + 1) % o->n);
        for (k = 0; k < 3; ++k) {
            size_t u = (k + 1) % 3, v = (k + 2) % 3;
            vector[k] += (at[u] - first[u]) / largest * ((next[v] - at[v]) / largest) / 2 -
                         (at[v] - first[v]) / largest * ((next[u] - at[u]) / largest) / 2;
        }
    }
    if (d->lies == ON_SURFACES) m->cancel = m->half / largest / largest / hypot(hypot(vector[0], vector[1]), vector[2]);
    if (surfmink_phases(turning_of, o->n, SURFMINK_CORRECTED, m->phase) != SURFMINK_OK) m->phase[0] = 0;
    noise = fmax(1e-12 * turned, 4 * DBL_EPSILON * (double)o->n);
    if (fabs(s) > noise / 5 && fabs(s) < 5 * noise) m->delicate = 1;
    if (d->lies == ON_SURFACES && (fabs(s - PI) < 1e-9 || fabs(s - 3 * PI) < 1e-9)) m->delicate = 1;
    if ((d->lies == ON_PLANE || d->lies == ON_SPHERES) && surfmink_area(o, &area) == SURFMINK_OK &&
        fabs(area) <= LIMIT[AREA] * m->half)
        m->delicate = 1;
}

/* Another one that is the same. Returns 0 if it cannot be made. */
static int alter(chance *c, enum change change, const drawn *d, drawn *other, size_t *by, int *exponent)
{
    size_t n = d->view.n, i,
           dim = d->lies == ON_PLANE || d->lies == BY_CALLBACKS || d->lies == IN_HYPERBOLIC_PLANE ? 2 : 3;
    static const int powers[6] = {1, -1, 40, -40, 300, -300};
    *by = one_of(c, n);
    *exponent = 0;
    *other = *d;
    other->view.corner = other->corner;
    if (other->view.normal) other->view.normal = other->normal;
    if (other->view.surface) other->view.surface = &other->surface;
    if (d->lies == ON_CALLED_SPHERE) other->surface.context = &other->radius;
    switch (change) {
    case FIRST_CORNER:
        start_at(*by, d->corner, n, dim, other->corner);
        start_at(*by, d->normal, n, 3, other->normal);
        return 1;
    case QUARTER_TURN: /* or a third of a turn about (1, 1, 1) */
        for (i = 0; i < n; ++i) {
            const double *x = d->corner + dim * i, *m = d->normal + 3 * i;
            double *y = other->corner + dim * i, *k = other->normal + 3 * i;
            y[0] = dim == 2 ? -x[1] : x[1];
            y[1] = dim == 2 ? x[0] : x[2];
            if (dim == 3) y[2] = x[0];
            if (d->lies == IN_HYPERBOLIC_PLANE)
                y[0] = -x[0], y[1] = -x[1]; /* half a turn: there its log is exact, too */
            k[0] = m[1], k[1] = m[2], k[2] = m[0];
        }
        return 1;
    case MIRROR:
        for (i = 0; i < n; ++i) other->corner[dim * i] *= -1, other->normal[3 * i] *= -1;
        surfmink_reverse(other->corner, n, dim);
        surfmink_reverse(other->normal, n, 3);
        return 1;
    default:
        *exponent = powers[one_of(c, 6)];
        for (i = 0; i < dim * n; ++i) other->corner[i] = ldexp(d->corner[i], *exponent);
        for (i = 0; i < 3 * n; ++i) other->normal[i] = ldexp(d->normal[i], -*exponent);
        if (dim == 3 && d->lies != ON_SURFACES) *exponent = 0; /* only directions count */
        return d->lies != IN_HYPERBOLIC_PLANE;
    }
}

static void compare(const drawn *d, const nature *m, enum change change, size_t by, int exponent, const found *a,
                    const found *b, double c)
{
    const int called = d->lies >= BY_CALLBACKS;
    const double unit = ldexp(1, exponent), s = a->w.turning, root = sqrt((double)d->view.n);
    double half = m->half * unit * unit, shift = change == FIRST_CORNER ? m->phase[by] : 0, u;
    int p;
    c += fabs(2 * PI - s) / s;
    u = called ? 1 + c * c + root / 10 : 1 + c + c * c / 10;
    CHECK_CLOSE(b->w.length, unit * a->w.length, LIMIT[LENGTH]);
    CHECK_CLOSE(b->w.turning, s, LIMIT[TURNING] * (c + (called ? root / 50 : 0)));
    if (!called)
        CHECK_NEAR(b->w.area, unit * unit * a->w.area,
                   LIMIT[AREA] * half * (d->lies == ON_SURFACES ? 1e3 + m->cancel : 1) +
                       DBL_MIN * fmax(1, unit * unit));
    for (p = 1; p <= P && LIMIT[MU] * u < 0.1; ++p) {
        CHECK_NEAR(b->mu[p], a->mu[p], LIMIT[MU] * u);
        if (change != MIRROR)
            CHECK_NEAR(a->mu[p] * remainder(p * (b->theta[p] - a->theta[p] + shift), 2 * PI), 0, LIMIT[MU] * u);
    }
}

static void draw_otherwise(enum change change, enum lies lies, int trials)
{
    static drawn d, other;
    static nature m;
    chance c = {seed(51)};
    long compared[WAYS] = {0}, refused[WAYS] = {0};
    int way, trial, exponent;
    size_t by;
    c.state += 97 * (uint64_t)change + (uint64_t)lies;
    for (trial = 0; trial < trials; ++trial) {
        found one, a, b;
        draw_outline(&c, lies, 3 + one_of(&c, one_in(&c, 10) ? 300 : 20), &d);
        if (!alter(&c, change, &d, &other, &by, &exponent)) return;
        study(&d, &m);
        find(SINGLE, &d.view, &one);
        for (way = 0; way < WAYS; ++way) {
            find((enum way)way, &d.view, &a);
            find((enum way)way, &other.view, &b);
            CASE("%s, %s, %s, %s, trial %d", change_name[change], lies_name[lies], drawing_name[d.family],
                 way_name[way], trial);
            if (change == UNIT && (a.status == SURFMINK_NOT_FINITE || b.status == SURFMINK_NOT_FINITE)) continue;
            if (m.delicate) continue;
            if (m.edges) /* several things may be wrong: which of them is told depends on the first corner */
                CHECK(a.status != SURFMINK_OK && b.status != SURFMINK_OK);
            else
                CHECK_STATUS(b.status, a.status);
            ++(a.status ? refused : compared)[way];
            if (a.status || b.status || a.w.length < 1e-290 || b.w.length < 1e-290) continue;
            compare(&d, &m, change, by, exponent, &a, &b, one.w.condition);
        }
    }
    for (way = 0; way < WAYS; ++way) {
        CASE("%s, %s, %s: %ld compared, %ld refused", change_name[change], lies_name[lies], way_name[way],
             compared[way], refused[way]);
        CHECK(compared[way] > trials / 3 && refused[way] > trials / 50);
    }
}

/* Lemmas (point independence; isometries; scaling), and mirror images: whatever is said, `ok` or why not. */
THEOREM(drawn_otherwise_an_outline_is_the_same)
{
    int change, lies;
    for (change = 0; change < CHANGES; ++change)
        for (lies = 0; lies < LIES; ++lies) draw_otherwise((enum change)change, (enum lies)lies, FEWER > 20 ? 60 : 300);
}

/* --- invariance (3.2) --------------------------------------------------------------------------------------------- */

static void same_shape(const double *a, const double *b, double within)
{
    int p;
    for (p = 0; p <= P; ++p) CHECK_NEAR(a[p], b[p], within);
}

/* Lemma (isometries of the manifold), here isometries of space. */
THEOREM(rotations_and_translations_of_space_change_nothing)
{
    static const chart ellipsoid = {ELLIPSOID, 1.6, 1.3, 1.0};
    chance c = {seed(52)};
    double xyz[3 * MOST], normal[3 * MOST], both[6 * MOST], mu[2][P + 1], g[2][2 * (P + 1)];
    int trial, p;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = 3 + one_of(&c, 20), i;
        star_on_chart(&c, &ellipsoid, between(&c, 1, 2), between(&c, 0, 6), 0.4, n, xyz, normal);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), P, mu[0], g[0], NULL, NULL));
        memcpy(both, xyz, 3 * n * sizeof *both);
        memcpy(both + 3 * n, normal, 3 * n * sizeof *both);
        turn_somehow(&c, both, 2 * n);
        for (i = 0; i < 3 * n; ++i) both[i] += i % 3 == 0 ? 5.0 : -3.0;
        CHECK_OK(surfmink_measure(IN_SPACE(both, both + 3 * n, n), P, mu[1], g[1], NULL, NULL));
        same_shape(mu[1], mu[0], 1e-13);
        /* Not even in edge 0's own frame; moving by 5 rounds corners by 4e-16, which turns an edge of 0.02 by 2e-14. */
        for (p = 0; p <= 2 * P + 1; ++p) CHECK_NEAR(g[1][p], g[0][p], 2e-13);
    }
}

/* Lemma (translation invariance): flows of Killing fields. The sphere has all rotations, */
THEOREM(on_the_sphere_every_rotation_is_a_translation)
{
    chance c = {seed(53)};
    double xy[2 * MOST], xyz[3 * MOST], mu[2][P + 1];
    surfmink_functionals w[2];
    int trial;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = 3 + one_of(&c, 20);
        random_star(&c, n, xy);
        onto_sphere(xy, n, between(&c, 0.1, 2), xyz);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, 2.0), P, mu[0], NULL, &w[0], NULL));
        turn_somehow(&c, xyz, n);
        CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, 2.0), P, mu[1], NULL, &w[1], NULL));
        same_shape(mu[1], mu[0], 3e-14 * w[0].condition);
        CHECK_CLOSE(w[1].length, w[0].length, 1e-14);
        CHECK_NEAR(w[1].area, w[0].area, 3e-14);
    }
}

/* a surface of revolution those about its axis, */
THEOREM(round_its_axis_a_torus_may_turn_round_its_tube_not)
{
    static const chart torus = {TORUS, 2.0, 0.9, 0};
    double xyz[3 * 8], normal[3 * 8], mu[3][P + 1], angle;
    int shift;
    for (angle = 0; angle < 6; angle += 0.7) {
        for (shift = 0; shift < 3; ++shift) { /* where it is; along the flow; round the tube, where curvature differs */
            size_t i;
            for (i = 0; i < 8; ++i) {
                double u = 0.4 * cos(2 * PI * (double)i / 8), v = 0.2 * sin(2 * PI * (double)i / 8);
                chart_point(&torus, u + (shift == 1 ? angle : 0), v + (shift == 2 ? PI : 0), xyz + 3 * i,
                            normal + 3 * i, NULL, NULL);
            }
            CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, 8), P, mu[shift], NULL, NULL, NULL));
        }
        same_shape(mu[1], mu[0], 1e-14);
        CHECK(fabs(mu[2][2] - mu[0][2]) > 0.01);
    }
}

/* and the hyperbolic plane its Moebius maps: here the one that takes a point of the disk to 0. */
THEOREM(in_the_hyperbolic_plane_moebius_maps_are_translations)
{
    chance c = {seed(54)};
    surfmink_surface hyperbolic = hyperbolic_plane();
    double xy[2 * MOST], mu[2][P + 1];
    surfmink_functionals w;
    int trial;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = 3 + one_of(&c, 20), i;
        double to[2];
        gentle_star(&c, n, xy);
        for (i = 0; i < 2 * n; ++i) xy[i] *= 0.6;
        to[0] = between(&c, -0.6, 0.6);
        to[1] = between(&c, -0.6, 0.6);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(ON_SURFACE(&hyperbolic, xy, n), P, mu[0], NULL, &w, NULL));
        for (i = 0; i < n; ++i) {
            double length = 0, direction[2] = {0, 0}, norm;
            CHECK_OK(hyperbolic_log(NULL, to, xy + 2 * i, &length, direction));
            norm = hypot(direction[0], direction[1]);
            xy[2 * i] = tanh(length / 2) * direction[0] / norm;
            xy[2 * i + 1] = tanh(length / 2) * direction[1] / norm;
        }
        CHECK_OK(surfmink_measure(ON_SURFACE(&hyperbolic, xy, n), P, mu[1], NULL, &w, NULL));
        same_shape(mu[1], mu[0], 3e-13);
    }
}

/* Lemma (scaling invariance). A power of two only moves the exponent, so it may change no bit, however absurd the
   unit. (Where there is an area it must not overflow.) */
static const int powers[] = {1, -1, 40, -40, 400, -400, -700, 500, 900};
enum { POWERS = sizeof powers / sizeof *powers, POWERS_WITH_AREA = POWERS - 1 };

THEOREM(the_unit_of_length_changes_no_bit_in_the_plane)
{
    chance c = {seed(55)};
    double xy[2 * MOST], scaled[2 * MOST], mu[2][P + 1], g[2][2 * (P + 1)];
    surfmink_functionals w[2];
    size_t k;
    int trial, p;
    for (trial = 0; trial < 20; ++trial)
        for (k = 0; k < POWERS_WITH_AREA; ++k) {
            size_t n = 3 + one_of(&c, 20), i;
            random_star(&c, n, xy);
            for (i = 0; i < 2 * n; ++i) scaled[i] = ldexp(xy[i], powers[k]);
            CASE("trial %d, unit 2^%d", trial, powers[k]);
            CHECK_OK(surfmink_measure(IN_PLANE(xy, n), P, mu[0], g[0], &w[0], NULL));
            CHECK_OK(surfmink_measure(IN_PLANE(scaled, n), P, mu[1], g[1], &w[1], NULL));
            CHECK_SAME(mu[1], mu[0], P + 1);
            CHECK_NEAR(w[1].length, ldexp(w[0].length, powers[k]), 0);
            CHECK_NEAR(w[1].turning, w[0].turning, 0);
            CHECK_NEAR(w[1].condition, w[0].condition, 0);
            for (p = 0; p <= 2 * P + 1; ++p) CHECK_NEAR(g[1][p], ldexp(g[0][p], powers[k]), 0);
            if (powers[k] > -500) CHECK_NEAR(w[1].area, ldexp(w[0].area, 2 * powers[k]), 0);
        }
}

THEOREM(the_unit_of_length_changes_no_bit_on_the_sphere)
{
    chance c = {seed(56)};
    double xy[2 * MOST], xyz[3 * MOST], scaled[3 * MOST], mu[3][P + 1];
    surfmink_functionals w[3];
    size_t k;
    int trial;
    for (trial = 0; trial < 20; ++trial)
        for (k = 0; k < POWERS; ++k) {
            size_t n = 3 + one_of(&c, 20), i;
            random_star(&c, n, xy);
            onto_sphere(xy, n, trial % 2 ? 1.0 : 1e-6, xyz);
            turn_somehow(&c, xyz, n);
            for (i = 0; i < 3 * n; ++i) scaled[i] = ldexp(xyz[i], powers[k]);
            CASE("trial %d, unit 2^%d", trial, powers[k]);
            CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, 1.0), P, mu[0], NULL, &w[0], NULL));
            CHECK_OK(
                surfmink_measure(ON_SPHERE(scaled, n, 1.0), P, mu[1], NULL, &w[1], NULL)); /* only directions count */
            CHECK_SAME(mu[1], mu[0], P + 1);
            CHECK_NEAR(w[1].area, w[0].area, 0);
            if (k >= POWERS_WITH_AREA) continue;
            CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, ldexp(1.0, powers[k])), P, mu[2], NULL, &w[2], NULL));
            CHECK_SAME(mu[2], mu[0], P + 1);
            CHECK_NEAR(w[2].length, ldexp(w[0].length, powers[k]), 0);
            CHECK_NEAR(w[2].turning, w[0].turning, 0);
            CHECK_NEAR(w[2].curvature, w[0].curvature, 0);
        }
}

THEOREM(units_and_stretched_normals_change_no_bit_in_space)
{
    static const chart ellipsoid = {ELLIPSOID, 1.6, 1.3, 1.0};
    chance c = {seed(57)};
    double xyz[3 * MOST], normal[3 * MOST], scaled[3 * MOST], stretched[3 * MOST], mu[2][P + 1];
    surfmink_functionals w[2];
    size_t k;
    int trial;
    for (trial = 0; trial < 20; ++trial)
        for (k = 0; k < POWERS_WITH_AREA; ++k) {
            size_t n = 3 + one_of(&c, 20), i;
            star_on_chart(&c, &ellipsoid, between(&c, 1, 2), between(&c, 0, 6), 0.4, n, xyz, normal);
            for (i = 0; i < 3 * n; ++i) {
                scaled[i] = ldexp(xyz[i], powers[k]);
                stretched[i] = ldexp(normal[i], powers[(i / 3 + k) % POWERS]); /* each normal by another factor */
            }
            CASE("trial %d, unit 2^%d", trial, powers[k]);
            CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), P, mu[0], NULL, &w[0], NULL));
            CHECK_OK(surfmink_measure(IN_SPACE(scaled, stretched, n), P, mu[1], NULL, &w[1], NULL));
            CHECK_SAME(mu[1], mu[0], P + 1);
            CHECK_NEAR(w[1].length, ldexp(w[0].length, powers[k]), 0);
            CHECK_NEAR(w[1].turning, w[0].turning, 0);
        }
}

/* Normals along one axis of space: each component has to be looked at. */
THEOREM(in_every_plane_of_the_axes_stretched_normals_change_no_bit)
{
    chance c = {seed(59)};
    double xy[2 * MOST], xyz[3 * MOST], normal[3 * MOST], mu[2][P + 1];
    int turn, k;
    for (turn = 0; turn < 3; ++turn)
        for (k = 0; k < POWERS; ++k) {
            size_t n = 3 + one_of(&c, 20), i;
            int pass;
            random_star(&c, n, xy);
            CASE("axis %d, normals 2^%d", (turn + 2) % 3, powers[k]);
            for (pass = 0; pass < 2; ++pass) {
                for (i = 0; i < n; ++i) {
                    xyz[3 * i + (size_t)turn] = xy[2 * i], normal[3 * i + (size_t)turn] = 0;
                    xyz[3 * i + (size_t)(turn + 1) % 3] = xy[2 * i + 1], normal[3 * i + (size_t)(turn + 1) % 3] = 0;
                    xyz[3 * i + (size_t)(turn + 2) % 3] = 0;
                    normal[3 * i + (size_t)(turn + 2) % 3] = pass ? ldexp(1.0, powers[k]) : 1;
                }
                CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), P, mu[pass], NULL, NULL, NULL));
            }
            CHECK_SAME(mu[1], mu[0], P + 1);
        }
}

THEOREM(neither_the_unit_nor_the_normals_need_be_sensible)
{
    static const chart ellipsoid = {ELLIPSOID, 1.6, 1.3, 1.0};
    static const double unit[6] = {1e-200, 1e150, 1e-290, 1e-100, 3.7, 1e-9};
    chance c = {seed(58)};
    double xy[2 * MOST], xyz[3 * MOST], normal[3 * MOST], mu[2][P + 1];
    surfmink_functionals w[2];
    int trial, k;
    for (trial = 0; trial < 50; ++trial)
        for (k = 0; k < 6; ++k) {
            size_t n = 3 + one_of(&c, 20), i;
            CASE("trial %d, unit %g", trial, unit[k]);
            random_star(&c, n, xy);
            CHECK_OK(surfmink_measure(IN_PLANE(xy, n), P, mu[0], NULL, &w[0], NULL));
            for (i = 0; i < 2 * n; ++i) xy[i] *= unit[k];
            CHECK_OK(surfmink_measure(IN_PLANE(xy, n), P, mu[1], NULL, &w[1], NULL));
            same_shape(mu[1], mu[0], 1e-14);
            CHECK_CLOSE(w[1].length, unit[k] * w[0].length, 1e-14);
            star_on_chart(&c, &ellipsoid, between(&c, 1, 2), between(&c, 0, 6), 0.4, n, xyz, normal);
            CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), P, mu[0], NULL, &w[0], NULL));
            for (i = 0; i < 3 * n; ++i) xyz[i] *= unit[k];
            for (i = 0; i < n; ++i) {
                double stretch = between(&c, 0.1, 10) * unit[k];
                normal[3 * i] *= stretch;
                normal[3 * i + 1] *= stretch;
                normal[3 * i + 2] *= stretch;
            }
            CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), P, mu[1], NULL, &w[1], NULL));
            same_shape(mu[1], mu[0], 3e-14);
        }
}

/* --- geodesic polygons (3.3) -------------------------------------------------------------------------------------- */

THEOREM(the_triangle_with_sides_3_4_5_has_its_closed_form)
{
    /* Seen from edge 0, of length 3, the co-normals are 1, i and z = -(3 + 4i)/5, so g_p = 3 + 4 i^p + 5 z^p. */
    static const double corner[6] = {0, 0, 3, 0, 3, 4};
    static const double want[14] = {12,    0,     0,      0,      -2.4,   4.8,     7.68,
                                    -5.76, 2.784, -2.688, 3.3792, 8.9856, 2.76096, -3.29472};
    double mu[7], g[14];
    int p;
    CHECK_OK(surfmink_measure(IN_PLANE(corner, 3), 6, mu, g, NULL, NULL));
    for (p = 0; p < 14; ++p) CHECK_NEAR(g[p], want[p], 2e-14);
    CHECK_NEAR(mu[1], 0, 1e-15);
    CHECK_NEAR(mu[2], sqrt(5) / 5, 1e-15);
    CHECK_NEAR(mu[3], 0.8, 1e-15);
    CHECK_NEAR(mu[4], sqrt(65) / 25, 1e-15);
    CHECK_NEAR(mu[5], 0.8, 1e-15);
    CHECK_NEAR(mu[6], sqrt(2005) / 125, 1e-15);
}

THEOREM(on_curved_surfaces_mu_1_is_not_zero)
{
    /* Half the octant, cut through the corner at z: sides pi/4, pi/2, pi/2, turns pi/2, pi/2, 3 pi/4, so S = 7 pi/4. */
    double s = sqrt(0.5), mu[P + 1], re, im, a = 2 * PI / (7 * PI / 4) * (PI / 2);
    double corner[9] = {1, 0, 0, 0, 0, 0, 0, 0, 1};
    surfmink_functionals w;
    corner[3] = corner[4] = s;
    CHECK_OK(surfmink_measure(ON_SPHERE(corner, 3, 1.0), P, mu, NULL, &w, NULL));
    CHECK_CLOSE(w.turning, 7 * PI / 4, 1e-15);
    CHECK_CLOSE(w.area, PI / 4, 1e-15);
    re = 1 + 2 * cos(a) + 2 * cos(a + 1.5 * a); /* lengths in units of pi/4; the turn at z is 3/2 right angles */
    im = 2 * sin(a) + 2 * sin(a + 1.5 * a);
    CHECK_NEAR(mu[1], hypot(re, im) / 5, 2e-15);
    CHECK(mu[1] > 0.02);
}

/* Paper 5.1: with the corrected transport the octant is a triangle, right angles and all. */
THEOREM(the_octant_is_a_perfect_triangle)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double mu[P + 1];
    surfmink_functionals w;
    int p;
    CHECK_OK(surfmink_measure(ON_SPHERE(corner, 3, 1.0), P, mu, NULL, &w, NULL));
    for (p = 0; p <= P; ++p) CHECK_NEAR(mu[p], p % 3 == 0 ? 1 : 0, 2e-15);
    CHECK_CLOSE(w.turning, 3 * PI / 2, 2e-16);
    CHECK_CLOSE(w.curvature, PI / 2, 4e-16);
    CHECK_CLOSE(w.condition, 1, 2e-16);
}

/* --- regular polygons (3.4) --------------------------------------------------------------------------------------- */

/* Theorem (eigenvalues of equal-angle polygons): mu_p = 1 if q divides p, else 0. */
static void regular_polygons(surfmink_surface *surface, const double *centre, double distance, double within)
{
    double corner[3 * 24], mu[25], g[50], theta[25];
    size_t q;
    int p;
    for (q = 3; q <= 24; ++q) {
        CASE("%d corners at distance %g", (int)q, distance);
        CHECK_OK(surfmink_regular_polygon(surface, centre, distance, 0.3, q, corner));
        CHECK_OK(surfmink_measure(ON_SURFACE(surface, corner, q), 24, mu, g, NULL, NULL));
        CHECK_OK(surfmink_spectrum(g, 24, NULL, NULL, theta));
        for (p = 0; p <= 24; ++p) {
            CHECK_NEAR(mu[p], p % (int)q == 0 ? 1 : 0, within);
            CHECK(mu[p] <= 1);
        }
        for (p = (int)q; p <= 24; p += (int)q) CHECK_NEAR(theta[p], 0, within); /* the co-normals are eigenvectors */
    }
}

THEOREM(regular_polygons_have_mu_one_at_multiples_of_n)
{
    static const double origin[2] = {0, 0}, off_centre[2] = {0.3, -0.4}, pole[3] = {0, 0, 1},
                        somewhere[3] = {0.6, 0, -0.8};
    surfmink_surface plane = spinning_plane(), hyperbolic = hyperbolic_plane(), sphere;
    double radius = 3, distance, within;
    sphere = surfmink_sphere_surface(&radius);
    for (distance = 0.01; distance < 4; distance *= 1.7) {
        regular_polygons(&plane, origin, distance, 2e-14);
        regular_polygons(&plane, off_centre, distance, 2e-14 / fmin(distance, 1));
        regular_polygons(&hyperbolic, origin, distance, 2e-13);
        regular_polygons(&hyperbolic, off_centre, fmin(distance, 1.5), 1e-13 / fmin(distance, 1));
        /* S = 2 pi cos(distance / radius): the smaller it is, the more the rounding
           of the corners moves mu (ACCURACY). */
        within = 2e-14 / fmin(distance, 1) / cos(distance / radius);
        regular_polygons(&sphere, pole, distance, within);
        regular_polygons(&sphere, somewhere, distance, within);
    }
}

/* The theorem asks for equal angles only: sides may differ if p is a multiple of q. */
THEOREM(equal_angles_suffice_for_mu_one)
{
    chance c = {seed(60)};
    double xy[2 * 20], mu[41], side[20];
    int trial, p;
    for (trial = 0; trial < 200; ++trial) {
        size_t q = 4 + one_of(&c, 17), i, k;
        double x = 0, y = 0;
        /* Sides 1 + sum_k a_k cos(2 pi k i/q + b_k), k >= 2, in directions 2 pi i/q: they close because k = 1 is
           missing. */
        for (i = 0; i < q; ++i) side[i] = 1;
        for (k = 2; k <= q / 2; ++k) {
            double a = between(&c, 0, 1.8 / (double)q), b = between(&c, 0, 2 * PI);
            for (i = 0; i < q; ++i) side[i] += a * cos(2 * PI * (double)(k * i % q) / (double)q + b);
        }
        for (i = 0; i < q; ++i) {
            xy[2 * i] = x;
            xy[2 * i + 1] = y;
            x += side[i] * cos(2 * PI * (double)i / (double)q);
            y += side[i] * sin(2 * PI * (double)i / (double)q);
        }
        CASE("trial %d, %d corners", trial, (int)q);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, q), 40, mu, NULL, NULL, NULL));
        for (p = 0; p <= 40; p += (int)q) CHECK_NEAR(mu[p], 1, 1e-13);
        CHECK_NEAR(mu[1], 0, 1e-14);
    }
}

static void alternating_polygons(surfmink_surface *surface, const double *centre, double distance, double within)
{
    double regular[2][3 * 10], corner[3 * 20], length[20], turning[20], mu[41];
    size_t m, i;
    int p;
    for (m = 2; m <= 10; ++m) {
        CASE("%d pairs of corners at distance %g", (int)m, distance);
        if (m == 2) continue; /* a regular polygon of two corners is none */
        CHECK_OK(surfmink_regular_polygon(surface, centre, distance, 0.0, m, regular[0]));
        CHECK_OK(surfmink_regular_polygon(surface, centre, distance, 2 * PI / (double)m * 0.3, m, regular[1]));
        for (i = 0; i < 2 * m; ++i)
            memcpy(corner + i * surface->stride, regular[i % 2] + i / 2 * surface->stride,
                   surface->stride * sizeof *corner);
        CHECK_OK(surfmink_edges(ON_SURFACE(surface, corner, 2 * m), length, turning, NULL));
        for (i = 0; i < 2 * m; ++i) CHECK_NEAR(turning[i], turning[0], within);
        CHECK(length[1] > 1.5 * length[0]);
        CHECK_OK(surfmink_measure(ON_SURFACE(surface, corner, 2 * m), 40, mu, NULL, NULL, NULL));
        for (p = 0; p <= 40; ++p) { /* l_0 + l_1 exp(i pi p/m), m times over if m divides p, else 0 */
            double want = p % (int)m ? 0 : p / (int)m % 2 ? (length[1] - length[0]) / (length[1] + length[0]) : 1;
            CHECK_NEAR(mu[p], want, within);
        }
    }
}

THEOREM(equal_angles_and_alternating_sides_have_a_closed_form)
{
    static const double origin[2] = {0, 0}, off_centre[2] = {0.3, -0.4}, somewhere[3] = {0.6, 0, -0.8};
    surfmink_surface plane = spinning_plane(), hyperbolic = hyperbolic_plane(), sphere;
    double radius = 3, distance;
    sphere = surfmink_sphere_surface(&radius);
    for (distance = 0.1; distance < 3; distance *= 1.7) {
        alternating_polygons(&plane, origin, distance, 1e-13);
        alternating_polygons(&hyperbolic, off_centre, fmin(distance, 1.5), 1e-12);
        alternating_polygons(&sphere, somewhere, distance, 3e-13);
    }
}

THEOREM(a_rectangle_has_mu_4_of_a_square_and_its_elongation)
{
    static const double corner[8] = {0, 0, 3, 0, 3, 1, 0, 1};
    double mu[5], g[10], theta[5];
    CHECK_OK(surfmink_measure(IN_PLANE(corner, 4), 4, mu, g, NULL, NULL));
    CHECK_OK(surfmink_spectrum(g, 4, NULL, NULL, theta));
    CHECK_NEAR(mu[1], 0, 1e-15);
    CHECK_NEAR(mu[2], 0.5, 1e-15); /* (3 - 1)/(3 + 1) */
    CHECK_NEAR(mu[3], 0, 1e-15);
    CHECK_NEAR(mu[4], 1, 1e-15);
    CHECK_NEAR(theta[2], 0, 1e-15); /* across the long sides: eigenvectors are co-normals, not axes of elongation */
}

/* --- stability (3.5) ---------------------------------------------------------------------------------------------- */

/* A polygon on a surface, and the same with one corner more beside edge k: pushed out (side = 1) or in (-1) by a
   height. */
static void add_vertex(surfmink_surface *surface, const double *corner, size_t n, size_t k, double side, double height,
                       double *more)
{
    const double *x = corner + k * surface->stride, *y = corner + (k + 1) % n * surface->stride;
    double middle[2 * 3], length, along[2] = {0, 0}, out[2], norm;
    CHECK_OK(surfmink_edge_points(surface, x, y, 2, middle));
    CHECK_OK(surface->log(surface->context, middle + surface->stride, y, &length, along));
    norm = hypot(along[0], along[1]);
    out[0] = side * along[1] / norm; /* to the right of the edge, or to the left */
    out[1] = -side * along[0] / norm;
    memcpy(more, corner, (k + 1) * surface->stride * sizeof *more);
    CHECK_OK(surface->exp(surface->context, middle + surface->stride, out, height, more + (k + 1) * surface->stride));
    memcpy(more + (k + 2) * surface->stride, corner + (k + 1) * surface->stride,
           (n - k - 1) * surface->stride * sizeof *more);
}

/* Lemma (continuity), with the formulas of its proof for the phases of the larger polygon. */
static void one_vertex_more(chance *c, surfmink_surface *surface, const double *corner, size_t n)
{
    double more[3 * MOST], triangle[9], l[2][MOST], alpha[2][MOST], f[2][MOST], g[2][2 * (P + 1)], beta[3], edge[3];
    double height, last = 1;
    size_t k = 1 + one_of(c, n - 2), i; /* not edge 0, whose frame would change; nor the last, for brevity */
    double side = one_of(c, 2) ? 1 : -1;
    surfmink_functionals w[2];
    int p;
    CHECK_OK(surfmink_edges(ON_SURFACE(surface, corner, n), l[0], alpha[0], NULL));
    CHECK_OK(surfmink_total(NULL, l[0], alpha[0], n, &w[0]));
    CHECK_OK(surfmink_phases(alpha[0], n, SURFMINK_CORRECTED, f[0]));
    CHECK_OK(surfmink_irreducible(l[0], f[0], n, P, g[0]));
    for (height = 0.05; height > 1e-9; height /= 8) {
        double kappa, ratio, unit = 2 * PI / w[0].turning, within, worst = 0;
        add_vertex(surface, corner, n, k, side, height, more);
        CASE("%d corners, one %s edge %d, height %g", (int)n, side > 0 ? "outside" : "inside", (int)k, height);
        CHECK_OK(surfmink_edges(ON_SURFACE(surface, more, n + 1), l[1], alpha[1], NULL));
        CHECK_OK(surfmink_total(NULL, l[1], alpha[1], n + 1, &w[1]));
        CHECK_OK(surfmink_phases(alpha[1], n + 1, SURFMINK_CORRECTED, f[1]));
        CHECK_OK(surfmink_irreducible(l[1], f[1], n + 1, P, g[1]));
        /* The three points x_k, x_k+1/2, x_k+1 form a triangle with turning angles beta and the curvature kappa. */
        memcpy(triangle, more + k * surface->stride, 3 * surface->stride * sizeof *triangle);
        CHECK_OK(surfmink_edges(ON_SURFACE(surface, triangle, 3), edge, beta, NULL));
        kappa = 2 * PI - side * (beta[0] + beta[1] + beta[2]);
        within = 2e-13;
        CHECK_NEAR(w[1].turning, w[0].turning - side * kappa, within);
        ratio = w[0].turning / w[1].turning;
        for (i = 0; i < k; ++i) CHECK_NEAR(f[1][i], ratio * f[0][i], within);
        CHECK_NEAR(f[1][k], ratio * (f[0][k] + unit * (beta[0] - side * PI)), within);
        CHECK_NEAR(f[1][k + 1], ratio * (f[0][k] + unit * (beta[0] - side * PI + beta[1])), within);
        for (i = k + 2; i <= n; ++i) CHECK_NEAR(f[1][i], ratio * (f[0][i - 1] - side * unit * kappa), within);
        /* As the vertex comes near, so do the components, at first order in the height. */
        for (p = 0; p <= P; ++p)
            worst = fmax(worst, hypot(g[1][2 * p] - g[0][2 * p], g[1][2 * p + 1] - g[0][2 * p + 1]) / (p + 1));
        CHECK(worst < 20 * height + 1e-13);
        CHECK(worst < last / 2 || worst < 1e-12);
        last = worst;
    }
}

THEOREM(a_vertex_more_or_less_changes_little_on_every_surface)
{
    surfmink_surface plane = spinning_plane(), hyperbolic = hyperbolic_plane(), sphere;
    chance c = {seed(61)};
    double radius = 1, xy[2 * MOST], xyz[3 * MOST];
    int trial;
    sphere = surfmink_sphere_surface(&radius);
    for (trial = 0; trial < 30; ++trial) {
        size_t n = 4 + one_of(&c, 12), i;
        gentle_star(&c, n, xy);
        one_vertex_more(&c, &plane, xy, n);
        onto_sphere(xy, n, between(&c, 0.5, 1.5), xyz);
        one_vertex_more(&c, &sphere, xyz, n);
        for (i = 0; i < 2 * n; ++i) xy[i] *= 0.7;
        one_vertex_more(&c, &hyperbolic, xy, n);
    }
}

THEOREM(a_corner_on_the_edge_changes_nothing)
{
    /* kappa_eps = 0: the vertex lies on the edge. Coordinates are dyadic, so it does so exactly. */
    static const double coarse[10] = {0, 0, 4, 0, 6, 4, 2, 8, -2, 2};
    static const double fine[18] = {0, 0, 1, 0, 3.5, 0, 4, 0, 5, 2, 6, 4, 2, 8, 0, 5, -2, 2};
    double mu[2][P + 1];
    surfmink_functionals w[2];
    CHECK_OK(surfmink_measure(IN_PLANE(coarse, 5), P, mu[0], NULL, &w[0], NULL));
    CHECK_OK(surfmink_measure(IN_PLANE(fine, 9), P, mu[1], NULL, &w[1], NULL));
    same_shape(mu[1], mu[0], 2e-15);
    CHECK_CLOSE(w[1].length, w[0].length, 2e-16);
    CHECK_NEAR(w[1].area, w[0].area, 0);
}

int main(void)
{
    PROVE(drawn_otherwise_an_outline_is_the_same);
    PROVE(rotations_and_translations_of_space_change_nothing);
    PROVE(on_the_sphere_every_rotation_is_a_translation);
    PROVE(round_its_axis_a_torus_may_turn_round_its_tube_not);
    PROVE(in_the_hyperbolic_plane_moebius_maps_are_translations);
    PROVE(the_unit_of_length_changes_no_bit_in_the_plane);
    PROVE(the_unit_of_length_changes_no_bit_on_the_sphere);
    PROVE(units_and_stretched_normals_change_no_bit_in_space);
    PROVE(in_every_plane_of_the_axes_stretched_normals_change_no_bit);
    PROVE(neither_the_unit_nor_the_normals_need_be_sensible);
    PROVE(the_triangle_with_sides_3_4_5_has_its_closed_form);
    PROVE(on_curved_surfaces_mu_1_is_not_zero);
    PROVE(the_octant_is_a_perfect_triangle);
    PROVE(regular_polygons_have_mu_one_at_multiples_of_n);
    PROVE(equal_angles_suffice_for_mu_one);
    PROVE(equal_angles_and_alternating_sides_have_a_closed_form);
    PROVE(a_rectangle_has_mu_4_of_a_square_and_its_elongation);
    PROVE(a_vertex_more_or_less_changes_little_on_every_surface);
    PROVE(a_corner_on_the_edge_changes_nothing);
    return QED();
}
