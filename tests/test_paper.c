/* What section 4 of the paper proves about polygons in smooth curves, lemma by lemma, and how much more is true.
   cc -I. tests/test_paper.c -lm && ./a.out

   One flower with three petals on the ellipsoid E(1.6, 1.3, 1.0), the paper's, cut with care or by chance, into
   geodesics or chords, with exact or approximate points and normals. Every theorem states the order that it expects,
   and those that tell a right scheme from a wrong one run the wrong one too. Flowers by chords on equal, graded and
   alternating partitions: test_convergence.c. Level sets: test_mesh.c, and here for the wrong index. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"
#include "examples/surfaces/ellipsoid.h"
#include "examples/surfaces/mesh.h"
#include "examples/paper/flower.h"
#include "chance.h"
#include "harness.h"

#include <stdint.h>
#include <stdlib.h>

#define P 6

enum { COARSEST = 256, LEVELS = 3, FINEST = COARSEST << (LEVELS - 1) };
enum partition { UNIFORM, GRADED, JITTERED, PARTITIONS };
enum edges { GEODESICS, CHORDS };
enum index { SECTION_3, SECTION_4 };

static const char *const partition_name[PARTITIONS] = {"equal edges", "graded edges", "jittered edges"};
static const char *const edges_name[2] = {"geodesics", "chords"};

/* A number in [-1, 1] that belongs to two others: chance that every run repeats. */
static double jitter(size_t i, size_t n)
{
    chance c = {((uint64_t)n << 32) + (uint64_t)i};
    return between(&c, -1, 1);
}

/* Where corner i of n lies, as a fraction of the arc length; corner 0 at 0. */
static double position(enum partition kind, size_t i, size_t n)
{
    double x = (double)i / (double)n;
    if (kind == GRADED) return x + 0.1 * sin(2 * PI * x);                               /* edges from 0.4 h to 1.6 h */
    if (kind == JITTERED && i > 0 && i < n) return x + 0.35 * jitter(i, n) / (double)n; /* from 0.3 h to 1.7 h */
    return x;
}

static flower_exact *exact_flower(void)
{
    static const flower curve = {{1.6, 1.3, 1.0}, 0.7, 0.2, 3, PI / 2, PI / 4};
    static flower_exact exact;
    if (!(exact.length > 0)) flower_integrate(&curve, &exact);
    return &exact;
}

/* A polygon in the flower, and where its corners are. */
typedef struct polygon {
    size_t n;
    double corner[3 * FINEST], normal[3 * FINEST], length[FINEST], turning[FINEST];
    double t[FINEST], arc[FINEST + 1];
} polygon;

static void place(polygon *q, enum partition kind, size_t n)
{
    flower_exact *exact = exact_flower();
    double d[3], dd[3];
    size_t i;
    q->n = n;
    for (i = 0; i <= n; ++i) q->arc[i] = exact->length * position(kind, i, n);
    for (i = 0; i < n; ++i) {
        q->t[i] = flower_time(exact, q->arc[i]);
        flower_point(&exact->curve, q->t[i], q->corner + 3 * i, q->normal + 3 * i, d, dd);
    }
}

static void join(polygon *q, enum edges edges)
{
    surfmink_implicit body = surfmink_ellipsoid(exact_flower()->curve.axis);
    surfmink_surface surface = surfmink_implicit_surface(&body);
    if (edges == CHORDS)
        CHECK_OK(surfmink_edges(IN_SPACE(q->corner, q->normal, q->n), q->length, q->turning, NULL));
    else
        CHECK_OK(surfmink_edges(ON_SURFACE(&surface, q->corner, q->n), q->length, q->turning, NULL));
}

typedef struct errors {
    double length, turning, phase, phase_middle, g_corner, g_middle; /* phases: worst edge; g, mu: worst rank */
    double mu, mu_of[P + 1];                                         /* mu_of: with its sign */
} errors;

static void judge(const polygon *q, enum index index, errors *off)
{
    static double turn[FINEST], phase[FINEST];
    flower_exact *exact = exact_flower();
    double g[2 * P + 2], corner[2 * P + 2], middle[2 * P + 2], mu[P + 1], start;
    surfmink_functionals w;
    size_t i;
    int p;
    for (i = 0; i < q->n; ++i) turn[i] = q->turning[index == SECTION_3 ? i : i > 0 ? i - 1 : q->n - 1];
    CHECK_OK(surfmink_total(NULL, q->length, turn, q->n, &w));
    CHECK_OK(surfmink_phases(turn, q->n, SURFMINK_CORRECTED, phase));
    CHECK_OK(surfmink_irreducible(q->length, phase, q->n, P, g));
    CHECK_OK(surfmink_spectrum(g, P, NULL, mu, NULL));
    flower_components(exact, 0, P, corner);
    flower_components(exact, flower_time(exact, (q->arc[0] + q->arc[1]) / 2), P, middle);
    off->length = fabs(w.length - exact->length);
    off->turning = fabs(w.turning - exact->kappa);
    off->phase = off->phase_middle = off->g_corner = off->g_middle = off->mu = 0;
    start = flower_phase(exact, flower_time(exact, (q->arc[0] + q->arc[1]) / 2));
    for (i = 0; i < q->n; ++i) {
        double here = flower_phase(exact, flower_time(exact, (q->arc[i] + q->arc[i + 1]) / 2)) - start;
        off->phase = fmax(off->phase, fabs(phase[i] - flower_phase(exact, q->t[i])));
        off->phase_middle = fmax(off->phase_middle, fabs(phase[i] - here));
    }
    for (p = 1; p <= P; ++p) {
        off->g_corner = fmax(off->g_corner, hypot(g[2 * p] - corner[2 * p], g[2 * p + 1] - corner[2 * p + 1]));
        off->g_middle = fmax(off->g_middle, hypot(g[2 * p] - middle[2 * p], g[2 * p + 1] - middle[2 * p + 1]));
        off->mu_of[p] = mu[p] - hypot(corner[2 * p], corner[2 * p + 1]) / corner[0];
        off->mu = fmax(off->mu, fabs(off->mu_of[p]));
    }
}

/* Order of convergence from the coarsest polygon to the finest. */
static double order(double coarse, double fine)
{
    return log2(coarse / fine) / (LEVELS - 1);
}

static void measure(polygon *q, enum edges edges, enum partition kind, enum index index, size_t n, errors *off)
{
    place(q, kind, n);
    join(q, edges);
    judge(q, index, off);
}

/* Corollaries 4.5 (f) and 4.6 (g), for geodesics and, by paper 4.2, for chords: order 1 is proved, and there is no more
   in phases compared at corners, nor in components read at a corner. But an edge has the direction of the curve at its
   middle: compared and read there both have order 2, as mu has. */
static void converges(enum edges edges)
{
    static polygon q;
    errors coarse, fine;
    int kind;
    for (kind = 0; kind < PARTITIONS; ++kind) {
        CASE("%s, %s", edges_name[edges], partition_name[kind]);
        measure(&q, edges, (enum partition)kind, SECTION_3, COARSEST, &coarse);
        measure(&q, edges, (enum partition)kind, SECTION_3, FINEST, &fine);
        CHECK_NEAR(order(coarse.length, fine.length), 2, 0.02);
        CHECK_NEAR(order(coarse.turning, fine.turning), 2, 0.02);
        CHECK_NEAR(order(coarse.mu, fine.mu), 2, 0.02);
        CHECK_NEAR(order(coarse.g_middle, fine.g_middle), 2, 0.02);
        CHECK_NEAR(order(coarse.g_corner, fine.g_corner), 1, 0.1);
        CHECK_NEAR(order(coarse.phase, fine.phase), 1, kind == JITTERED ? 0.25 : 0.05); /* chance: the worst corner */
        CHECK_NEAR(order(coarse.phase_middle, fine.phase_middle), 2, kind == JITTERED ? 0.25 : 0.05);
        CHECK_NEAR(fine.mu, 0, 6e-5);
        CHECK_NEAR(fine.g_middle, 0, 4e-4);
    }
}

THEOREM(geodesic_flowers_converge_at_second_order)
{
    converges(GEODESICS);
}

THEOREM(chords_of_flowers_converge_at_second_order_however_cut)
{
    converges(CHORDS);
}

/* The index of paper 4.1, which adds each turn one edge too late: components never see order 2, and mu only where
   edges are equal in the mean. */
THEOREM(by_the_index_of_section_4_geodesics_are_of_first_order)
{
    static polygon q;
    errors coarse, fine;
    int kind;
    for (kind = 0; kind < PARTITIONS; ++kind) {
        CASE("%s", partition_name[kind]);
        measure(&q, GEODESICS, (enum partition)kind, SECTION_4, COARSEST, &coarse);
        measure(&q, GEODESICS, (enum partition)kind, SECTION_4, FINEST, &fine);
        CHECK_NEAR(order(coarse.g_middle, fine.g_middle), 1, kind == JITTERED ? 0.3 : 0.05);
        if (kind == GRADED) CHECK_NEAR(order(coarse.mu, fine.mu), 1, 0.05);
    }
}

/* k_g, from the first two derivatives of the curve. */
static double geodesic_curvature(double t)
{
    double x[3], n[3], d[3], dd[3], cross;
    flower_point(&exact_flower()->curve, t, x, n, d, dd);
    cross = n[0] * (d[1] * dd[2] - d[2] * dd[1]) + n[1] * (d[2] * dd[0] - d[0] * dd[2]) +
            n[2] * (d[0] * dd[1] - d[1] * dd[0]);
    return cross / pow(flower__dot(d, d), 1.5);
}

/* The larger of the two edges that meet at a corner, in arc length, and their sum. */
static double edges_at(const polygon *q, size_t i, double *sum)
{
    double after = q->arc[i + 1] - q->arc[i],
           before = i > 0 ? q->arc[i] - q->arc[i - 1] : q->arc[q->n] - q->arc[q->n - 1];
    *sum = before + after;
    return fmax(before, after);
}

/* Lemma 4.2 (angle approximation) and the remark after it: a turn is k_g times half the edges that meet there,
   up to C times the square of the larger edge, and up to its cube where all edges are equal. */
THEOREM(a_turn_is_the_curvature_times_half_the_edges_that_meet_there)
{
    static polygon q;
    double worst[PARTITIONS][LEVELS], sum, edge;
    int kind, level;
    size_t i;
    for (kind = 0; kind < PARTITIONS; ++kind)
        for (level = 0; level < LEVELS; ++level) {
            place(&q, (enum partition)kind, (size_t)COARSEST << level);
            join(&q, GEODESICS);
            for (worst[kind][level] = 0, i = 0; i < q.n; ++i) {
                double off;
                edge = edges_at(&q, i, &sum);
                off = fabs(q.turning[i] - geodesic_curvature(q.t[i]) * sum / 2);
                worst[kind][level] = fmax(worst[kind][level], off / (edge * edge));
            }
            CASE("%s, %d corners", partition_name[kind], (int)q.n);
            CHECK(worst[kind][level] < 12);
            if (kind != JITTERED) continue;
            CHECK(worst[kind][level] > 7); /* so the lemma can not be improved where neighbours differ */
        }
    CASE("equal edges");
    CHECK_NEAR(order(worst[UNIFORM][0], worst[UNIFORM][LEVELS - 1]), 1, 0.05);
}

/* Lemma 4.8 (approximation of the angles): the turn from chord to chord is that of geodesics, up to C times the
   squares of both edges. */
THEOREM(chords_turn_as_geodesics_do)
{
    static polygon q;
    static double turning[FINEST];
    double worst, sum, edge, before[PARTITIONS] = {0};
    int kind, level;
    size_t i;
    for (level = 0; level < LEVELS; ++level)
        for (kind = 0; kind < PARTITIONS; ++kind) {
            place(&q, (enum partition)kind, (size_t)COARSEST << level);
            join(&q, GEODESICS);
            memcpy(turning, q.turning, q.n * sizeof *turning);
            join(&q, CHORDS);
            for (worst = 0, i = 0; i < q.n; ++i) {
                edge = edges_at(&q, i, &sum);
                worst = fmax(worst, fabs(q.turning[i] - turning[i]) / (edge * edge));
            }
            CASE("%s, %d corners", partition_name[kind], (int)q.n);
            CHECK(worst < 0.2);
            if (kind != JITTERED && level > 0)
                CHECK_NEAR(before[kind] / worst, 2, 0.2); /* smooth partitions: the cube */
            before[kind] = worst;
        }
}

/* Lemma 4.4 (accumulated curvature): what has turned up to a corner is the curvature up to there, to first
   order; the whole turn is the whole curvature to second order: the theorems above. */
THEOREM(turns_add_up_to_the_curvature_passed)
{
    static polygon q;
    flower_exact *exact = exact_flower();
    double worst[LEVELS], turned;
    int kind, level;
    size_t i;
    for (kind = 0; kind < PARTITIONS; ++kind) {
        CASE("%s", partition_name[kind]);
        for (level = 0; level < LEVELS; ++level) {
            place(&q, (enum partition)kind, (size_t)COARSEST << level);
            join(&q, GEODESICS);
            for (worst[level] = turned = 0, i = 0; i < q.n; turned += q.turning[i++])
                worst[level] = fmax(worst[level], fabs(turned - flower_phase(exact, q.t[i]) * exact->kappa / (2 * PI)));
            CHECK(worst[level] < 10 * exact->length / (double)q.n);
        }
        CHECK_NEAR(order(worst[0], worst[LEVELS - 1]), 1, kind == JITTERED ? 0.25 : 0.05);
    }
}

/* Moves points and tilts normals, by errors that vary smoothly along the curve or from corner to corner by chance. */
static void disturb(polygon *q, int by_chance, double tilt, double shift)
{
    size_t i;
    int k;
    for (i = 0; i < q->n; ++i)
        for (k = 0; k < 3; ++k) {
            q->normal[3 * i + (size_t)k] +=
                tilt * (by_chance ? jitter(7 * i + (size_t)k, q->n) : sin((2 + k) * q->t[i] + k));
            q->corner[3 * i + (size_t)k] +=
                shift * (by_chance ? jitter(7 * i + (size_t)k + 3, q->n) : cos((3 - k) * q->t[i] + 2 * k));
        }
}

/* Errors at all levels if normals are off by tilt h^t and points by shift h^s, where h is the mean edge. */
static void measure_disturbed(enum partition kind, int by_chance, double tilt, int t, double shift, int s, errors *off)
{
    static polygon q;
    double h;
    int level;
    CASE("%s, %s errors, normals %g h^%d, points %g h^%d", partition_name[kind], by_chance ? "chance" : "smooth", tilt,
         t, shift, s);
    for (level = 0; level < LEVELS; ++level) {
        place(&q, kind, (size_t)COARSEST << level);
        h = exact_flower()->length / (double)q.n;
        disturb(&q, by_chance, tilt * pow(h, t), shift * pow(h, s));
        join(&q, CHORDS);
        judge(&q, SECTION_3, &off[level]);
    }
}

/* Paper 4.3 and Corollary 4.11, what a mesh gives: points of order h^2, normals of order h. Order 1 is proved, and
   there is no more of it. */
THEOREM(points_of_order_h2_and_normals_of_order_h_make_order_one)
{
    errors off[LEVELS];
    int kind;
    for (kind = 0; kind < PARTITIONS; ++kind) {
        measure_disturbed((enum partition)kind, 0, 1, 1, 0.5, 2, off);
        CHECK_NEAR(order(off[0].turning, off[LEVELS - 1].turning), 1, 0.1);
        CHECK_NEAR(order(off[0].g_middle, off[LEVELS - 1].g_middle), 1, 0.1);
        CHECK_NEAR(order(off[0].mu, off[LEVELS - 1].mu), 1.2, 0.2); /* most of mu's errors is still of second order */
        measure_disturbed((enum partition)kind, 1, 1, 1, 0.5, 2, off);
        CHECK(order(off[0].turning, off[LEVELS - 1].turning) > 1); /* chance cancels */
        CHECK(order(off[0].mu, off[LEVELS - 1].mu) > 1);
        CHECK_NEAR(off[LEVELS - 1].mu, 0, 5e-4);
    }
}

THEOREM(with_points_and_normals_of_order_h2_the_order_is_two)
{
    errors off[LEVELS];
    int kind;
    for (kind = 0; kind < PARTITIONS; ++kind) {
        measure_disturbed((enum partition)kind, 0, 1, 2, 0.5, 2, off);
        CHECK_NEAR(order(off[0].turning, off[LEVELS - 1].turning), 2, 0.05);
        CHECK_NEAR(order(off[0].g_middle, off[LEVELS - 1].g_middle), 2, 0.05);
        CHECK_NEAR(order(off[0].mu, off[LEVELS - 1].mu), 2, 0.05);
    }
}

/* Both conditions are needed: normals that stay wrong keep their error for ever, and so do points that are off by as
   much as their distances, if by chance. */
THEOREM(with_worse_points_or_normals_nothing_converges)
{
    errors off[LEVELS];
    int kind;
    for (kind = 0; kind < PARTITIONS; ++kind) {
        measure_disturbed((enum partition)kind, 0, 0.02, 0, 0, 0, off);
        CHECK_NEAR(order(off[0].turning, off[LEVELS - 1].turning), 0, 0.1);
        CHECK_NEAR(order(off[0].g_middle, off[LEVELS - 1].g_middle), 0, 0.1);
        measure_disturbed((enum partition)kind, 1, 0, 0, 0.1, 1, off);
        CHECK(off[LEVELS - 1].mu > 0.02);
    }
}

/* Where the partition is smooth the error is a power series in h^2: two polygons make a third value, of order 4. */
THEOREM(richardsons_extrapolation_of_two_polygons_has_order_four)
{
    static polygon q;
    errors off[LEVELS];
    double better[2];
    int kind, level, p;
    for (kind = 0; kind <= GRADED; ++kind) {
        CASE("%s", partition_name[kind]);
        for (level = 0; level < LEVELS; ++level)
            measure(&q, CHORDS, (enum partition)kind, SECTION_3, (size_t)COARSEST << level, &off[level]);
        for (level = 0; level < 2; ++level)
            for (better[level] = 0, p = 1; p <= P; ++p)
                better[level] = fmax(better[level], fabs(4 * off[level + 1].mu_of[p] - off[level].mu_of[p]) / 3);
        CHECK_NEAR(log2(better[0] / better[1]), 4, 0.3);
        CHECK_NEAR(better[1], 0, 3e-7);
    }
}

/* Paper 5.2, figure (sphere-convergence): edges of all lengths follow each other on a mesh, which is where the index
   of section 4 errs most. The right one is within the band of order 2 that test_mesh.c asks for; this one is nowhere
   near. */
THEOREM(on_level_sets_the_index_of_section_4_costs_an_order)
{
    static const double limit[7] = {1, 0, .041307578749043, 0, .169084042925900, 0, .0742854634691783};
    double right[2], late[2], *field, *length, *turning, *phase, g[14], mu[7];
    mesh m;
    mesh_loops loops;
    mesh_error error;
    size_t i, n;
    int level, p;
    for (level = 5; level <= 8; level += 3) {
        CASE("octahedron, level %d", level);
        CHECK_EQUAL(mesh_sphere(&m, MESH_OCTAHEDRON, level, &error), MESH_OK);
        CHECK_EQUAL(mesh_connect(&m, &error), MESH_OK);
        CHECK_EQUAL(mesh_normals(&m, &error), MESH_OK);
        field = (double *)malloc(m.vertices * sizeof *field);
        if (!field) exit(1);
        for (i = 0; i < m.vertices; ++i) {
            const double *x = m.vertex + 3 * i;
            double theta = acos(x[2]) - PI / 2, phi = remainder(atan2(x[1], x[0]) - PI / 4, 2 * PI);
            field[i] = hypot(theta, phi) - (0.5 - 0.1 * sin(4 * atan2(phi, theta)));
        }
        CHECK_EQUAL(mesh_level_set(&m, field, 0, MESH_BELOW, &loops, &error), MESH_OK);
        n = loops.start[1];
        length = (double *)malloc(3 * n * sizeof *length);
        if (!length) exit(1);
        turning = length + n;
        phase = turning + n;
        right[level / 8] = late[level / 8] = 0;
        CHECK_OK(surfmink_measure(IN_SPACE(loops.corner, loops.normal, n), 6, mu, NULL, NULL, NULL));
        for (p = 2; p <= 6; p += 2) right[level / 8] = fmax(right[level / 8], fabs(mu[p] - limit[p]));
        CHECK_OK(surfmink_edges(IN_SPACE(loops.corner, loops.normal, n), length, turning, NULL));
        surfmink_reverse(turning, n, 1); /* twice, and once without the first: every turn moves one corner on */
        surfmink_reverse(turning + 1, n - 1, 1);
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
        CHECK_OK(surfmink_irreducible(length, phase, n, 6, g));
        CHECK_OK(surfmink_spectrum(g, 6, NULL, mu, NULL));
        for (p = 2; p <= 6; p += 2) late[level / 8] = fmax(late[level / 8], fabs(mu[p] - limit[p]));
        free(length);
        free(field);
        mesh_free_loops(&loops);
        mesh_free(&m);
    }
    CHECK(log2(right[0] / right[1]) / 3 > 1.9);
    CHECK(log2(late[0] / late[1]) / 3 < 1.5);
    CHECK(late[1] > 10 * right[1]);
}

int main(void)
{
    PROVE(geodesic_flowers_converge_at_second_order);
    PROVE(chords_of_flowers_converge_at_second_order_however_cut);
    PROVE(by_the_index_of_section_4_geodesics_are_of_first_order);
    PROVE(a_turn_is_the_curvature_times_half_the_edges_that_meet_there);
    PROVE(chords_turn_as_geodesics_do);
    PROVE(turns_add_up_to_the_curvature_passed);
    PROVE(points_of_order_h2_and_normals_of_order_h_make_order_one);
    PROVE(with_points_and_normals_of_order_h2_the_order_is_two);
    PROVE(with_worse_points_or_normals_nothing_converges);
    PROVE(richardsons_extrapolation_of_two_polygons_has_order_four);
    PROVE(on_level_sets_the_index_of_section_4_costs_an_order);
    return QED();
}
