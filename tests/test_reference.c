/* The reference sets in tests/data: values in 50-digit arithmetic, from exactly the doubles that are printed there.
   cc -I. tests/test_reference.c -lm && ./a.out

   The limits of all sets are those of LIMITS; the worst errors found are printed, so that they can be quoted. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "harness.h"
#include "shapes.h"
#include "table.h"

#define P 12

/* Errors of L and area are relative, those of S and mu absolute; those of an angle are mu_p p theta_p modulo 2 pi. */
enum quantity { EDGE, TURN, LENGTH, TURNING, MU, THETA, AREA, QUANTITIES };
static const char *const quantity_name[QUANTITIES] = {"l", "alpha", "L", "S", "mu", "p mu theta", "area"};
static const double LIMITS[QUANTITIES] = {1e-14, 1e-13, 1e-14, 1e-13, 1e-13, 1e-12, 1e-13};
static double worst[QUANTITIES];

static void off_by(enum quantity what, double got, double want)
{
    double error = fabs(got - want);
    if (what == EDGE || what == LENGTH || what == AREA) error /= fabs(want);
    if (!(error <= LIMITS[what])) CASE("%s %s", harness.which, quantity_name[what]);
    CHECK(error <= LIMITS[what]);
    if (!(error <= worst[what])) worst[what] = error;
}

static void report(const char *set)
{
    int q;
    printf("%s: worst errors", set);
    for (q = 0; q < QUANTITIES; ++q)
        if (worst[q] > 0) printf("  %s %.1e", quantity_name[q], worst[q]);
    printf("\n");
    memset(worst, 0, sizeof worst);
}

/* A row of a reference table against what was measured. */
static void compare(const table *t, const surfmink_functionals *w, const double *mu, const double *g)
{
    double theta[P + 1];
    int p;
    off_by(LENGTH, w->length, table_number(t, "L"));
    off_by(TURNING, w->turning, table_number(t, "sum_alpha"));
    CHECK_NEAR(w->curvature, table_number(t, "deficit"), 1e-13);
    CHECK_OK(surfmink_spectrum(g, P, NULL, NULL, theta));
    for (p = 1; p <= P; ++p) {
        double want = table_rank(t, "theta_", p);
        off_by(MU, mu[p], table_rank(t, "mu_", p));
        if (!isnan(want)) off_by(THETA, mu[p] * remainder(p * (theta[p] - want), 2 * PI), 0);
    }
}

static size_t points(const char *path, const char *which, double *corner, double *normal, double *length,
                     double *turning)
{
    static const char *const x[3] = {"x", "y", "z"}, *const n[3] = {"nx", "ny", "nz"}, *const l[1] = {"l"},
                             *const alpha[1] = {"alpha"};
    size_t count = table_points(path, which, x, 3, MOST, corner);
    table_points(path, which, n, 3, MOST, normal);
    table_points(path, which, l, 1, MOST, length);
    table_points(path, which, alpha, 1, MOST, turning);
    return count;
}

static void compare_edges(size_t n, const double *length, const double *turning, const double *l, const double *alpha)
{
    size_t i;
    for (i = 0; i < n; ++i) {
        off_by(EDGE, length[i], l[i]);
        off_by(TURN, turning[i], alpha[i]);
    }
}

THEOREM(great_circle_polygons_of_every_size)
{
    double corner[3 * MOST], normal[3 * MOST], l[MOST], alpha[MOST], length[MOST], turning[MOST], mu[P + 1],
        g[2 * (P + 1)], area;
    surfmink_functionals w;
    table t;
    int cases = 0;
    table_open(&t, "tests/data/sphere_geodesic_ref.tsv");
    while (table_next(&t)) {
        size_t n = points("tests/data/sphere_geodesic_points.tsv", table_text(&t, "case"), corner, normal, l, alpha);
        double radius = table_number(&t, "R");
        CASE("%s %s", table_text(&t, "case"), table_text(&t, "desc"));
        CHECK_EQUAL(n, table_number(&t, "q"));
        CHECK_OK(surfmink_edges(ON_SPHERE(corner, n, radius), length, turning, NULL));
        compare_edges(n, length, turning, l, alpha);
        CHECK_OK(surfmink_measure(ON_SPHERE(corner, n, radius), P, mu, g, &w, NULL));
        compare(&t, &w, mu, g);
        off_by(AREA, w.area, table_number(&t, "area"));
        off_by(AREA, w.curvature * radius * radius, table_number(&t, "area"));
        CHECK_OK(surfmink_area(ON_SPHERE(corner, n, radius), &area));
        off_by(AREA, area, table_number(&t, "area"));
        ++cases;
    }
    CHECK_EQUAL(cases, 12);
    report("sphere_geodesic");
}

THEOREM(great_circle_polygons_through_callbacks)
{
    double corner[3 * MOST], normal[3 * MOST], l[MOST], alpha[MOST], length[MOST], turning[MOST];
    double mu[P + 1], g[2 * (P + 1)], radius;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    surfmink_functionals w;
    table t;
    table_open(&t, "tests/data/sphere_geodesic_ref.tsv");
    while (table_next(&t)) {
        size_t n = points("tests/data/sphere_geodesic_points.tsv", table_text(&t, "case"), corner, normal, l, alpha);
        radius = table_number(&t, "R");
        CASE("%s %s", table_text(&t, "case"), table_text(&t, "desc"));
        CHECK_OK(surfmink_edges(ON_SURFACE(&sphere, corner, n), length, turning, NULL));
        compare_edges(n, length, turning, l, alpha);
        CHECK_OK(surfmink_measure(ON_SURFACE(&sphere, corner, n), P, mu, g, &w, NULL));
        compare(&t, &w, mu, g);
    }
    report("sphere_geodesic by callbacks");
}

THEOREM(straight_chords_on_ellipsoids_and_tori)
{
    double corner[3 * MOST], normal[3 * MOST], l[MOST], alpha[MOST], length[MOST], turning[MOST], mu[P + 1],
        g[2 * (P + 1)];
    surfmink_functionals w;
    table t;
    int cases = 0;
    table_open(&t, "tests/data/line_surface_ref.tsv");
    while (table_next(&t)) {
        size_t n = points("tests/data/line_surface_points.tsv", table_text(&t, "case"), corner, normal, l, alpha);
        CASE("%s %s", table_text(&t, "case"), table_text(&t, "desc"));
        CHECK_EQUAL(n, table_number(&t, "q"));
        CHECK_OK(surfmink_edges(IN_SPACE(corner, normal, n), length, turning, NULL));
        compare_edges(n, length, turning, l, alpha);
        CHECK_OK(surfmink_measure(IN_SPACE(corner, normal, n), P, mu, g, &w, NULL));
        compare(&t, &w, mu, g);
        ++cases;
    }
    CHECK_EQUAL(cases, 6);
    report("line_surface");
}

THEOREM(flat_polygons_in_the_plane_and_in_space)
{
    double corner[3 * MOST], normal[3 * MOST], l[MOST], alpha[MOST], length[MOST], turning[MOST], xy[2 * MOST];
    double mu[P + 1], g[2 * (P + 1)], area;
    surfmink_functionals w;
    table t;
    int cases = 0;
    table_open(&t, "tests/data/flat_ref.tsv");
    while (table_next(&t)) {
        size_t n = points("tests/data/flat_points.tsv", table_text(&t, "case"), corner, normal, l, alpha), i;
        for (i = 0; i < n; ++i) {
            xy[2 * i] = corner[3 * i];
            xy[2 * i + 1] = corner[3 * i + 1];
        }
        CASE("%s %s", table_text(&t, "case"), table_text(&t, "desc"));
        CHECK_EQUAL(n, table_number(&t, "q"));
        CHECK_OK(surfmink_edges(IN_PLANE(xy, n), length, turning, NULL));
        compare_edges(n, length, turning, l, alpha);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, n), P, mu, g, &w, NULL));
        compare(&t, &w, mu, g);
        off_by(AREA, w.area, table_number(&t, "area"));
        CHECK_OK(surfmink_area(IN_PLANE(xy, n), &area));
        off_by(AREA, area, table_number(&t, "area"));
        CHECK_OK(surfmink_edges(IN_SPACE(corner, normal, n), length, turning, NULL));
        compare_edges(n, length, turning, l, alpha);
        CHECK_OK(surfmink_measure(IN_SPACE(corner, normal, n), P, mu, g, &w, NULL));
        compare(&t, &w, mu, g);
        ++cases;
    }
    CHECK_EQUAL(cases, 5);
    report("flat");
}

THEOREM(geodesic_polygons_from_their_lengths_and_turning_angles)
{
    /* Geodesics of the ellipsoid and the torus are not the header's business: steps 2 to 4 take l and alpha as they
       are. */
    double corner[3 * MOST], normal[3 * MOST], l[MOST], alpha[MOST], mu[P + 1], g[2 * (P + 1)];
    surfmink_functionals w;
    table t;
    int cases = 0;
    table_open(&t, "tests/data/geodesic_surface_ref.tsv");
    while (table_next(&t)) {
        size_t n = points("tests/data/geodesic_surface_points.tsv", table_text(&t, "case"), corner, normal, l, alpha);
        CASE("%s %s", table_text(&t, "case"), table_text(&t, "desc"));
        CHECK_OK(surfmink_total(NULL, l, alpha, n, &w));
        CHECK_OK(surfmink_phases(alpha, n, SURFMINK_CORRECTED, alpha));
        CHECK_OK(surfmink_irreducible(l, alpha, n, P, g));
        CHECK_OK(surfmink_spectrum(g, P, NULL, mu, NULL));
        compare(&t, &w, mu, g);
        ++cases;
    }
    CHECK_EQUAL(cases, 3);
    report("geodesic_surface");
}

/* Paper 5.1, triangles on a torus; in double precision there, good to 1e-12. */
THEOREM(geodesic_triangles_on_the_torus_of_the_paper)
{
    double l[3], alpha[3], g[14], mu[7], error, most = 0;
    table t;
    int p, rows = 0;
    table_open(&t, "examples/paper/data/torus_triangles.tsv");
    while (table_next(&t)) {
        for (p = 0; p < 3; ++p) {
            l[p] = table_rank(&t, "l", p + 1);
            alpha[p] = table_rank(&t, "alpha", p + 1);
        }
        CASE("theta2 = %s pi", table_text(&t, "theta2_over_pi"));
        CHECK_OK(surfmink_phases(alpha, 3, SURFMINK_CORRECTED, alpha));
        CHECK_OK(surfmink_irreducible(l, alpha, 3, 6, g));
        CHECK_OK(surfmink_spectrum(g, 6, NULL, mu, NULL));
        for (p = 2; p <= 6; ++p) {
            error = fabs(mu[p] - table_rank(&t, "mu", p));
            if (!(error <= most)) most = error;
            CHECK_NEAR(mu[p], table_rank(&t, "mu", p), 1e-11);
        }
        ++rows;
    }
    CHECK_EQUAL(rows, 35);
    NOTE("paper_torus_triangles: worst errors  mu %.1e", most);
}

/* Paper 5.1: the octant with the classical transport, for every fraction u of an edge; 15 decimals. */
THEOREM(the_octant_with_the_classical_transport)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double length[3], turning[3], g[14], mu[7], error, most = 0;
    table t;
    int p, rows = 0;
    CHECK_OK(surfmink_edges(ON_SPHERE(corner, 3, 1.0), length, turning, NULL));
    table_open(&t, "examples/paper/data/triangle90.tsv");
    while (table_next(&t)) {
        double u = table_number(&t, "u");
        /* u = 1 is the end of the edge, where the next one starts. */
        CHECK_OK(surfmink_irreducible_parallel(length, turning, 3, u < 1 ? 0 : 1, u < 1 ? u : 0, 6, g));
        CHECK_OK(surfmink_spectrum(g, 6, NULL, mu, NULL));
        CASE("u = %g", u);
        for (p = 1; p <= 6; ++p) {
            error = fabs(mu[p] - table_rank(&t, "mu_", p));
            if (!(error <= most)) most = error;
            CHECK_NEAR(mu[p], table_rank(&t, "mu_", p), 3e-15);
        }
        ++rows;
    }
    CHECK_EQUAL(rows, 21);
    NOTE("paper_triangle90: worst errors  mu %.1e", most);
}

/* --- smooth curves ------------------------------------------------------------------------------------------------ */

/* L, S and all g_p of the polygon with n corners on a flower, t = 0 in the middle of edge 0. */
enum { VALUES = 2 + 2 * P };

static void sample(const flower *f, size_t n, double *value)
{
    static double corner[3 * 4096], normal[3 * 4096];
    double g[2 * (P + 1)];
    surfmink_functionals w;
    size_t i;
    for (i = 0; i < n; ++i)
        flower_point(f, 2 * PI * ((double)i - 0.5) / (double)n, corner + 3 * i, normal + 3 * i, NULL);
    CHECK_OK(surfmink_measure(IN_SPACE(corner, normal, n), P, NULL, g, &w, NULL));
    value[0] = w.length;
    value[1] = w.turning;
    memcpy(value + 2, g + 2, 2 * P * sizeof *g);
}

THEOREM(smooth_curves_are_the_limit_of_their_polygons)
{
    /* Errors fall like h^2, h^4, ...: Richardson's extrapolation from 256, 512, ... 4096 corners leaves h^10. */
    table t;
    double most[3] = {0, 0, 0};
    int cases = 0;
    table_open(&t, "tests/data/xsmooth_ref.tsv");
    while (table_next(&t)) {
        double value[5][VALUES], want;
        flower f;
        int level, order, k, p;
        table_flower(&t, &f);
        CASE("%s", table_text(&t, "case"));
        for (level = 0; level < 5; ++level) sample(&f, (size_t)256 << level, value[level]);
        for (order = 1; order < 5; ++order)
            for (level = 4; level >= order; --level)
                for (k = 0; k < VALUES; ++k)
                    value[level][k] += (value[level][k] - value[level - 1][k]) / (power_of_two(2 * order) - 1);
        want = table_number(&t, "L");
        CHECK_CLOSE(value[4][0], want, 1e-14);
        most[0] = fmax(most[0], fabs(value[4][0] / want - 1));
        want = table_number(&t, "kappa");
        CHECK_NEAR(value[4][1], want, 1e-13);
        most[1] = fmax(most[1], fabs(value[4][1] - want));
        for (p = 1; p <= P; ++p) { /* g_p / L = mu_p exp(i p theta_p), in the co-normal frame at t = 0 */
            double mu = table_rank(&t, "mu_", p), angle = p * table_rank(&t, "theta_", p);
            double re = value[4][2 * p] / value[4][0] - mu * cos(angle),
                   im = value[4][2 * p + 1] / value[4][0] - mu * sin(angle);
            CASE("%s, p = %d", table_text(&t, "case"), p);
            CHECK_NEAR(hypot(re, im), 0, 1e-10);
            most[2] = fmax(most[2], hypot(re, im));
        }
        ++cases;
    }
    CHECK_EQUAL(cases, 3);
    NOTE("xsmooth, extrapolated: worst errors  L %.1e  S %.1e  g/L %.1e", most[0], most[1], most[2]);
}

/* The corners of the paper's tables 1 and 2: flower (0.7, 0.2, 3) about (pi/2, pi/4), equal arcs, the first at t =
   0. */
static double paper_table(const char *path, const chart *surface, int geodesic)
{
    static double corner[3 * 1024], normal[3 * 1024];
    flower_ruler ruler;
    flower f;
    double mu[4], most = 0;
    surfmink_functionals w;
    table t;
    f.surface = *surface;
    f.u0 = PI / 2, f.v0 = PI / 4, f.r0 = 0.7, f.a = 0.2, f.petals = 3;
    flower_measure(&f, &ruler);
    table_open(&t, path);
    while (table_next(&t)) {
        size_t q = (size_t)table_number(&t, "q"), i;
        for (i = 0; i < q; ++i) flower_at(&ruler, (double)i / (double)q, corner + 3 * i, normal + 3 * i);
        CASE("q = %d", (int)q);
        if (geodesic)
            CHECK_OK(surfmink_measure(ON_SPHERE(corner, q, 1.0), 3, mu, NULL, &w, NULL));
        else
            CHECK_OK(surfmink_measure(IN_SPACE(corner, normal, q), 3, mu, NULL, &w, NULL));
        CHECK_CLOSE(w.length, table_number(&t, "L_q"), 2e-14);
        CHECK_CLOSE(w.turning, table_number(&t, "kappa_q"), 1e-13);
        CHECK_NEAR(mu[3], table_number(&t, "mu3_std"), 1e-13);
        most = fmax(most, fabs(mu[3] - table_number(&t, "mu3_std")));
    }
    return most;
}

THEOREM(the_polygons_of_the_papers_tables_with_its_section_3)
{
    /* The paper prints values with the index of its section 4; the columns std are those of section 3. */
    static const chart unit_sphere = {ELLIPSOID, 1, 1, 1}, ellipsoid = {ELLIPSOID, 1.6, 1.3, 1};
    double first = paper_table("examples/paper/data/table1_reference.tsv", &unit_sphere, 1);
    double second = paper_table("examples/paper/data/table2_reference.tsv", &ellipsoid, 0);
    NOTE("paper tables 1 and 2: worst errors  mu_3 %.1e and %.1e", first, second);
}

int main(void)
{
    PROVE(great_circle_polygons_of_every_size);
    PROVE(great_circle_polygons_through_callbacks);
    PROVE(straight_chords_on_ellipsoids_and_tori);
    PROVE(flat_polygons_in_the_plane_and_in_space);
    PROVE(geodesic_polygons_from_their_lengths_and_turning_angles);
    PROVE(geodesic_triangles_on_the_torus_of_the_paper);
    PROVE(the_octant_with_the_classical_transport);
    PROVE(smooth_curves_are_the_limit_of_their_polygons);
    PROVE(the_polygons_of_the_papers_tables_with_its_section_3);
    return QED();
}
