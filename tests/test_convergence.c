/* Polygons through the points of a smooth curve converge to it at second order (paper 4; flowers on a sphere, an
   ellipsoid, a torus).
   cc -I. tests/test_convergence.c -lm && ./a.out

   The paper proves first order in general. On every partition, also of very unequal edges, L, the total turning and
   mu converge at second order, and so do the components if they are compared where they are read: in the middle of
   edge 0. With the index of the paper's section 4, which adds each turn one edge too late, there is only first
   order: that is shown too, so that these theorems are known to tell the two apart. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "harness.h"
#include "partitions.h"
#include "shapes.h"
#include "table.h"

#define P 6 /* higher ranks need finer polygons before their order shows */

enum { LEVELS = 3, COARSEST = 512, FINEST = COARSEST << (LEVELS - 1) };
typedef struct exact {
    flower curve;
    double length, turning, mu[P + 1], theta[P + 1]; /* theta at t = 0 */
} exact;

static void read_exact(const char *which, exact *e)
{
    table t;
    int p, found = 0;
    table_open(&t, "tests/data/xsmooth_ref.tsv");
    while (table_next(&t)) {
        if (strcmp(table_text(&t, "case"), which) != 0) continue;
        found = 1;
        table_flower(&t, &e->curve);
        e->length = table_number(&t, "L");
        e->turning = table_number(&t, "kappa");
        for (p = 1; p <= P; ++p) {
            e->mu[p] = table_rank(&t, "mu_", p);
            e->theta[p] = table_rank(&t, "theta_", p);
        }
    }
    CHECK(found);
}

typedef struct errors {
    double length, turning, mu, g;
} errors;

/* Worst errors over all ranks, from lengths and phases. */
static void judge(const exact *e, size_t n, const double *length, const double *turning, const double *phase,
                  errors *off)
{
    double g[2 * (P + 1)], mu[P + 1];
    surfmink_functionals w;
    int p;
    CHECK_OK(surfmink_total(NULL, length, turning, n, &w));
    CHECK_OK(surfmink_irreducible(length, phase, n, P, g));
    CHECK_OK(surfmink_spectrum(g, P, NULL, mu, NULL));
    off->length = fabs(w.length - e->length);
    off->turning = fabs(w.turning - e->turning);
    off->mu = off->g = 0;
    for (p = 1; p <= P; ++p) {
        double re = g[2 * p] - e->length * e->mu[p] * cos(p * e->theta[p]);
        double im = g[2 * p + 1] - e->length * e->mu[p] * sin(p * e->theta[p]);
        off->mu = fmax(off->mu, fabs(mu[p] - e->mu[p]));
        off->g = fmax(off->g, hypot(re, im));
    }
}

enum scheme { GREAT_CIRCLES, CHORDS };
enum recipe { SECTION_3, SECTION_4, FIDUCIAL_AT_A_CORNER };

static void measure(const exact *e, const flower_ruler *ruler, enum scheme scheme, enum partition kind,
                    enum recipe recipe, size_t n, errors *off)
{
    static double corner[3 * FINEST], normal[3 * FINEST], length[FINEST], turning[FINEST], phase[FINEST];
    double shift = recipe == FIDUCIAL_AT_A_CORNER ? -position(kind, 0, n) : 0, turned = 0;
    size_t i;
    for (i = 0; i < n; ++i) flower_at(ruler, position(kind, i, n) + shift, corner + 3 * i, normal + 3 * i);
    if (scheme == GREAT_CIRCLES)
        CHECK_OK(surfmink_edges(ON_SPHERE(corner, n, 1.0), length, turning, NULL));
    else
        CHECK_OK(surfmink_edges(IN_SPACE(corner, normal, n), length, turning, NULL));
    CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
    if (recipe == SECTION_4) { /* the turn at corner 0 counts, the one at corner i does not yet */
        double total = 0;
        for (i = 0; i < n; ++i) total += turning[i];
        for (i = 0; i < n; turned += turning[i++]) phase[i] = 2 * PI / total * turned;
    }
    judge(e, n, length, turning, phase, off);
}

/* Order of convergence, from the coarsest polygon to the finest. */
static double order(double coarse, double fine)
{
    return log2(coarse / fine) / (LEVELS - 1);
}

/* Measured with 512 and 2048 corners, on every partition; orders have to be as told, up to a band. */
static void converges(const char *which, enum scheme scheme, enum recipe recipe, double order_of_g, double band)
{
    exact e;
    flower_ruler ruler;
    int kind;
    read_exact(which, &e);
    flower_measure(&e.curve, &ruler);
    CHECK_CLOSE(ruler.arc[FLOWER_PANELS], e.length, 1e-14);
    for (kind = 0; kind < PARTITIONS; ++kind) {
        errors coarse, fine;
        CASE("%s, %s, %s", which, scheme == CHORDS ? "chords" : "great circles", partition_name[kind]);
        measure(&e, &ruler, scheme, (enum partition)kind, recipe, COARSEST, &coarse);
        measure(&e, &ruler, scheme, (enum partition)kind, recipe, FINEST, &fine);
        CHECK_NEAR(order(coarse.length, fine.length), 2, 0.01);
        CHECK_NEAR(order(coarse.turning, fine.turning), 2, 0.01);
        CHECK_NEAR(order(coarse.g, fine.g), order_of_g, band);
        if (recipe != SECTION_4)
            CHECK_NEAR(order(coarse.mu, fine.mu), 2, band);
        else if (kind == GRADED)
            CHECK_NEAR(order(coarse.mu, fine.mu), 1, band); /* where edges are alike it errs little in mu */
        if (recipe == SECTION_3) {                          /* and errors are small, not only falling */
            CHECK_NEAR(fine.length / e.length, 0, 2e-5);
            CHECK_NEAR(fine.turning, 0, 1e-5);
            CHECK_NEAR(fine.mu, 0, 5e-5);
            CHECK_NEAR(fine.g / e.length, 0, 5e-5);
        }
    }
}

THEOREM(great_circles_in_a_flower_converge_at_second_order)
{
    converges("xs00", GREAT_CIRCLES, SECTION_3, 2, 0.02);
}

THEOREM(chords_of_flowers_converge_at_second_order_everywhere)
{
    converges("xs00", CHORDS, SECTION_3, 2, 0.02);
    converges("xs01", CHORDS, SECTION_3, 2, 0.02);
    converges("xs02", CHORDS, SECTION_3, 2, 0.15); /* its petals are sharper: 512 corners are few */
}

THEOREM(by_the_index_of_section_4_components_are_of_first_order)
{
    converges("xs00", GREAT_CIRCLES, SECTION_4, 1, 0.1);
    converges("xs01", CHORDS, SECTION_4, 1, 0.1);
}

THEOREM(compared_at_a_corner_components_converge_at_first_order_only)
{
    converges("xs00", GREAT_CIRCLES, FIDUCIAL_AT_A_CORNER, 1, 0.1);
    converges("xs01", CHORDS, FIDUCIAL_AT_A_CORNER, 1, 0.1);
}

/* Remark (length approximation), paper 4.1: polygons through points of a curve are shorter, and finer ones less so. */
THEOREM(lengths_grow_towards_the_length_of_the_curve)
{
    exact e;
    flower_ruler ruler;
    double before = 0;
    size_t n;
    read_exact("xs01", &e);
    flower_measure(&e.curve, &ruler);
    for (n = 8; n <= 1024; n *= 2) {
        double corner[3 * 1024], normal[3 * 1024];
        surfmink_functionals w;
        size_t i;
        for (i = 0; i < n; ++i) flower_at(&ruler, (double)i / (double)n, corner + 3 * i, normal + 3 * i);
        CASE("%d corners", (int)n);
        CHECK_OK(surfmink_measure(IN_SPACE(corner, normal, n), 0, NULL, NULL, &w, NULL));
        CHECK(w.length > before && w.length < e.length);
        before = w.length;
    }
}

int main(void)
{
    PROVE(great_circles_in_a_flower_converge_at_second_order);
    PROVE(chords_of_flowers_converge_at_second_order_everywhere);
    PROVE(by_the_index_of_section_4_components_are_of_first_order);
    PROVE(compared_at_a_corner_components_converge_at_first_order_only);
    PROVE(lengths_grow_towards_the_length_of_the_curve);
    return QED();
}
