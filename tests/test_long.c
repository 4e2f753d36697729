/* Outlines of up to ten million corners, and cells from a billionth to a trillionth of their sphere, keep all their
   digits.
   cc -I. tests/test_long.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <stdlib.h>

#include "harness.h"
#include "shapes.h"
#include "table.h"

#define P 12

/* So many count as a million: fewer on slow machines. */
static const size_t million = FEWER < 50 ? 1000000 : FEWER < 1000 ? 100000 : 30000;

static double *room_for(size_t doubles)
{
    double *room = (double *)malloc(doubles * sizeof *room);
    if (!room) {
        printf("no memory for %lu doubles\n", (unsigned long)doubles);
        exit(1);
    }
    return room;
}

/* --- many corners ------------------------------------------------------------------------------------------------- */

THEOREM(ten_million_equal_turns_do_not_drift)
{
    /* Of n edges the first half has length 3/2, the rest 1. For odd p that is a geometric sum, g_p = 1/(1 - exp(2 pi
       i p/n)); for even p nothing is left. Plainly summed phases are off by 1e-10 at the end. */
    size_t n = 10 * million, i;
    double *length = room_for(n), *phase = room_for(n), g[2 * (P + 1)], mu[P + 1], theta[P + 1], off = 0;
    surfmink_functionals w;
    int p;
    for (i = 0; i < n; ++i) {
        length[i] = i < n / 2 ? 1.5 : 1;
        phase[i] = 0.1 * PI / (double)n; /* a cone, or nearly a hemisphere: S = pi/10 */
    }
    CHECK_OK(surfmink_total(NULL, length, phase, n, &w));
    CHECK_CLOSE(w.length, 1.25 * (double)n, 0);
    CHECK_CLOSE(w.turning, 0.1 * PI, 1e-15);
    CHECK_CLOSE(w.condition, 1, 1e-15);
    CHECK_OK(surfmink_phases(phase, n, SURFMINK_CORRECTED, phase));
    for (i = 0; i < n; ++i) off = fmax(off, fabs(phase[i] - 2 * PI * (double)i / (double)n));
    CHECK_NEAR(off, 0, 3e-15);
    CHECK_OK(surfmink_irreducible(length, phase, n, P, g));
    CHECK_OK(surfmink_spectrum(g, P, NULL, mu, theta));
    for (p = 1; p <= P; ++p) {
        double half = PI * p / (double)n; /* 1/(1 - exp(2 i half)) = i exp(-i half) / (2 sin half) */
        CASE("p = %d", p);
        CHECK_NEAR(mu[p], p % 2 ? 1 / (2 * sin(half)) / (1.25 * (double)n) : 0, 3e-15);
        if (p % 2) CHECK_NEAR(p * theta[p], PI / 2 - half, 5e-14);
    }
    free(length);
    free(phase);
}

/* A square with `side` edges to a side, whose corners are whole numbers. */
static double *fine_square(size_t side)
{
    double *xy = room_for(8 * side), s = (double)side;
    size_t i;
    for (i = 0; i < side; ++i) {
        double x = (double)i;
        xy[2 * i] = x, xy[2 * i + 1] = 0;
        xy[2 * (side + i)] = s, xy[2 * (side + i) + 1] = x;
        xy[2 * (2 * side + i)] = s - x, xy[2 * (2 * side + i) + 1] = s;
        xy[2 * (3 * side + i)] = 0, xy[2 * (3 * side + i) + 1] = s - x;
    }
    return xy;
}

THEOREM(a_square_of_a_million_corners_is_a_square)
{
    size_t side = million / 4;
    double *xy = fine_square(side), mu[5], g[10], theta[5];
    surfmink_functionals w;
    CHECK_OK(surfmink_measure(IN_PLANE(xy, 4 * side), 4, mu, g, &w, NULL));
    CHECK_OK(surfmink_spectrum(g, 4, NULL, NULL, theta));
    CHECK_NEAR(mu[1], 0, 1e-15);
    CHECK_NEAR(mu[2], 0, 1e-15);
    CHECK_NEAR(mu[3], 0, 1e-15);
    CHECK_NEAR(mu[4], 1, 1e-15);
    CHECK_NEAR(theta[4], 0, 1e-15);
    CHECK_NEAR(w.length, (double)million, 0);
    CHECK_NEAR(w.area, (double)side * (double)side, 0);
    CHECK_NEAR(w.turning, 2 * PI, 1e-15);
    free(xy);
}

THEOREM(a_staircase_of_a_million_right_angles_is_a_square_to_rank_4)
{
    /* A pixelled triangle, half of whose turns are lost again: condition 250000. */
    size_t steps = million / 2, n = 2 * steps + 2, i;
    double *xy = room_for(2 * n), mu[9], s = (double)steps;
    surfmink_functionals w;
    xy[0] = 0, xy[1] = 0, xy[2] = s, xy[3] = 0;
    for (i = 0; i < steps; ++i) { /* up, then left, from (s, 0) to (0, s) */
        double k = (double)i;
        xy[4 + 4 * i] = s - k, xy[5 + 4 * i] = k + 1;
        xy[6 + 4 * i] = s - k - 1, xy[7 + 4 * i] = k + 1;
    }
    CHECK_OK(surfmink_measure(IN_PLANE(xy, n), 8, mu, NULL, &w, NULL));
    CHECK_NEAR(w.turning, 2 * PI, 1e-15);
    CHECK_CLOSE(w.condition, (s + 1) / 2, 1e-15);
    CHECK_NEAR(w.length, 4 * s, 0);
    CHECK_NEAR(w.area, s * (s + 1) / 2, 0);
    CHECK_NEAR(mu[2], 0, 1e-15);
    CHECK_NEAR(mu[4], 1, 1e-15);
    CHECK_NEAR(mu[8], 1, 1e-15);
    free(xy);
}

THEOREM(circles_of_latitude_have_their_turning_and_area)
{
    /* Regular polygon at angle r from the pole: with half a central angle b = pi/n, tan(interior/2) = 1/(cos r tan
       b), and sin(edge/2) = sin r sin b. */
    size_t n = million / 4, i;
    double *xyz = room_for(3 * n), mu[P + 1], r = 0.7, b = PI / (double)n, turn;
    surfmink_functionals w;
    int p;
    for (i = 0; i < n; ++i) {
        double angle = 2 * PI * (double)i / (double)n;
        xyz[3 * i] = sin(r) * cos(angle);
        xyz[3 * i + 1] = sin(r) * sin(angle);
        xyz[3 * i + 2] = cos(r);
    }
    CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, 1.0), P, mu, NULL, &w, NULL));
    turn = 2 * atan(cos(r) * tan(b)); /* pi - interior */
    CHECK_CLOSE(w.length, (double)n * 2 * asin(sin(r) * sin(b)), 1e-13);
    CHECK_CLOSE(w.turning, (double)n * turn, 1e-13);
    CHECK_CLOSE(w.area, 2 * PI - (double)n * turn, 1e-13);
    for (p = 1; p <= P; ++p) CHECK_NEAR(mu[p], 0, 1e-12);
    free(xyz);
}

THEOREM(a_million_corners_have_the_values_of_the_smooth_curve)
{
    /* The second-order error of the polygon is 1e-10 there. */
    size_t n = 1000000, i;
    double *xyz = room_for(3 * n), *normal = room_for(3 * n), mu[P + 1];
    surfmink_functionals w;
    table t;
    flower f;
    int p;
    table_open(&t, "tests/data/xsmooth_ref.tsv");
    while (table_next(&t)) {
        if (strcmp(table_text(&t, "case"), "xs01") != 0) continue;
        table_flower(&t, &f);
        for (i = 0; i < n; ++i) flower_point(&f, 2 * PI * (double)i / (double)n, xyz + 3 * i, normal + 3 * i, NULL);
        CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), P, mu, NULL, &w, NULL));
        CHECK_CLOSE(w.length, table_number(&t, "L"), 1e-10);
        CHECK_CLOSE(w.turning, table_number(&t, "kappa"), 1e-10);
        for (p = 1; p <= P; ++p) CHECK_NEAR(mu[p], table_rank(&t, "mu_", p), 1e-9);
    }
    free(xyz);
    free(normal);
}

/* --- small and far away ------------------------------------------------------------------------------------------- */

THEOREM(in_the_plane_it_does_not_matter_where_a_cell_lies)
{
    chance c = {seed(81)};
    double xy[2 * MOST], far_off[2 * MOST], mu[2][P + 1], g[2][2 * (P + 1)];
    surfmink_functionals w[2];
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = whole_star(&c, xy), i;
        double x = floor(between(&c, -4e15, 4e15)), y = floor(between(&c, -4e15, 4e15));
        for (i = 0; i < n; ++i) {
            far_off[2 * i] = xy[2 * i] + x;
            far_off[2 * i + 1] = xy[2 * i + 1] + y;
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, n), P, mu[0], g[0], &w[0], NULL));
        CHECK_OK(surfmink_measure(IN_PLANE(far_off, n), P, mu[1], g[1], &w[1], NULL));
        CHECK_SAME(mu[1], mu[0], P + 1);
        CHECK_SAME(g[1], g[0], 2 * (P + 1));
        CHECK_SAME(&w[1].area, &w[0].area, 1);
        CHECK_SAME(&w[1].turning, &w[0].turning, 1);
    }
}

THEOREM(on_an_embedded_surface_it_does_not_matter_where_a_cell_lies)
{
    chance c = {seed(82)};
    double xy[2 * MOST], here[3 * MOST], far_off[3 * MOST], normal[3 * MOST], mu[2][P + 1];
    surfmink_functionals w;
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = whole_star(&c, xy), i;
        for (i = 0; i < n; ++i) {
            double x = xy[2 * i], y = xy[2 * i + 1];
            here[3 * i] = x, here[3 * i + 1] = y, here[3 * i + 2] = floor((x * x - y * y) / 16384); /* a saddle */
            normal[3 * i] = -2 * x / 16384, normal[3 * i + 1] = 2 * y / 16384, normal[3 * i + 2] = 1;
            far_off[3 * i] = x + 1e12, far_off[3 * i + 1] = y - 3e12, far_off[3 * i + 2] = here[3 * i + 2] + 2e12;
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(IN_SPACE(here, normal, n), P, mu[0], NULL, &w, NULL));
        CHECK(w.curvature < 0);
        CHECK_OK(surfmink_measure(IN_SPACE(far_off, normal, n), P, mu[1], NULL, &w, NULL));
        CHECK_SAME(mu[1], mu[0], P + 1);
    }
}

/* Central projection from a small cell of the sphere to the plane that touches it is an isometry up to size^2, which
   is rounding below 1e-8. So a cell of the sphere has to say what its map says, to full accuracy. */
static void says_what_its_map_says(const double *xyz, const double *map, size_t n)
{
    double mu[2][P + 1], g[2][2 * (P + 1)], theta[2][P + 1];
    surfmink_functionals w[2];
    int p;
    CHECK_OK(surfmink_measure(IN_PLANE(map, n), P, mu[0], g[0], &w[0], NULL));
    CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, 1.0), P, mu[1], g[1], &w[1], NULL));
    CHECK_OK(surfmink_spectrum(g[0], P, NULL, NULL, theta[0]));
    CHECK_OK(surfmink_spectrum(g[1], P, NULL, NULL, theta[1]));
    CHECK_CLOSE(w[1].length, w[0].length, 1e-15);
    CHECK_CLOSE(w[1].area, w[0].area, 5e-15 * w[0].condition);
    CHECK_CLOSE(w[1].curvature, w[0].area, 5e-15 * w[0].condition);
    CHECK_CLOSE(w[1].turning, 2 * PI, 1e-15 * w[0].condition);
    for (p = 1; p <= P; ++p) {
        CHECK_NEAR(mu[1][p], mu[0][p], 1e-14 * w[0].condition);
        CHECK_NEAR(mu[0][p] * remainder(p * (theta[1][p] - theta[0][p]), 2 * PI), 0, 2e-14 * w[0].condition);
    }
}

THEOREM(cells_at_the_pole_keep_all_digits_down_to_any_size)
{
    static const double sizes[8] = {1e-9, 1e-10, 1e-11, 1e-12, 1e-20, 1e-50, 1e-100, 1e-150};
    chance c = {seed(83)};
    double xy[2 * MOST], xyz[3 * MOST];
    int trial, k;
    for (trial = 0; trial < 100; ++trial)
        for (k = 0; k < 8; ++k) {
            size_t n = 3 + one_of(&c, MOST - 2), i;
            random_star(&c, n, xy);
            for (i = 0; i < n; ++i) {
                xyz[3 * i] = xy[2 * i] *= sizes[k];
                xyz[3 * i + 1] = xy[2 * i + 1] *= sizes[k];
                xyz[3 * i + 2] = 1;
            }
            CASE("trial %d, size %g", trial, sizes[k]);
            says_what_its_map_says(xyz, xy, n);
        }
}

THEOREM(cells_anywhere_keep_all_digits_that_their_corners_have)
{
    /* About c = (3, 2, 1)/4 the directions (1, -1, -1) and (-1, 4, -5) are orthogonal to it and to each other, so
       corners are exact. Odd trials lift each corner off the sphere, to (1 + r) c, by about the size of the cell. */
    static const double centre[3] = {0.75, 0.5, 0.25}, u[3] = {1, -1, -1}, v[3] = {-1, 4, -5};
    chance c = {seed(84)};
    double xy[2 * MOST], xyz[3 * MOST];
    int trial, bits;
    for (trial = 0; trial < 200; ++trial)
        for (bits = 40; bits <= 50; bits += 5) { /* sizes from 5e-9 to 5e-12 */
            size_t n = whole_star(&c, xy), i, k;
            double unit = power_of_two(-bits);
            for (i = 0; i < n; ++i) {
                double a = unit * xy[2 * i], b = unit * xy[2 * i + 1];
                double r = trial % 2 ? unit * floor(between(&c, -1000, 1000)) : 0;
                for (k = 0; k < 3; ++k) xyz[3 * i + k] = (1 + r) * centre[k] + a * u[k] + b * v[k];
                xy[2 * i] = a * sqrt(3) / (sqrt(14) / 4) / (1 + r);
                xy[2 * i + 1] = b * sqrt(42) / (sqrt(14) / 4) / (1 + r);
            }
            CASE("trial %d, unit 2^-%d", trial, bits);
            says_what_its_map_says(xyz, xy, n);
        }
}

int main(void)
{
    PROVE(ten_million_equal_turns_do_not_drift);
    PROVE(a_square_of_a_million_corners_is_a_square);
    PROVE(a_staircase_of_a_million_right_angles_is_a_square_to_rank_4);
    PROVE(circles_of_latitude_have_their_turning_and_area);
    PROVE(a_million_corners_have_the_values_of_the_smooth_curve);
    PROVE(in_the_plane_it_does_not_matter_where_a_cell_lies);
    PROVE(on_an_embedded_surface_it_does_not_matter_where_a_cell_lies);
    PROVE(cells_at_the_pole_keep_all_digits_down_to_any_size);
    PROVE(cells_anywhere_keep_all_digits_that_their_corners_have);
    return QED();
}
