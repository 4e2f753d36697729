/* The sphere's exp and log, and what builds, repairs and converts outlines.
   cc -I. tests/test_helpers.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <stdlib.h>

#include "harness.h"
#include "shapes.h"

static void random_point(chance *c, double x[3])
{
    double square;
    do {
        size_t k;
        for (k = 0; k < 3; ++k) x[k] = between(c, -1, 1);
        square = dot3(x, x);
    } while (square < 0.1 || square > 1);
}

static double norm3(const double *x)
{
    return sqrt(dot3(x, x));
}

/* --- log and exp (paper 5.1) -------------------------------------------------------------------------------------- */

THEOREM(log_is_the_tangent_as_long_as_the_arc)
{
    chance c = {seed(71)};
    double x[3], y[3], vector[3], cross[3];
    int trial;
    for (trial = 0; trial < 1000; ++trial) {
        double radius = between(&c, 0.1, 10), arc;
        random_point(&c, x);
        random_point(&c, y);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_sphere_log(x, y, radius, vector));
        cross3(x, y, cross);
        arc = atan2(norm3(cross), dot3(x, y));
        CHECK_CLOSE(norm3(vector), radius * arc, 2e-15 + 2e-16 / arc);
        CHECK_NEAR(dot3(vector, x), 0, 1e-15 * radius * arc);
        CHECK_NEAR(dot3(vector, cross), 0, 4e-15 * radius); /* in the plane of the great circle, */
        CHECK(dot3(vector, y) > 0 || arc > PI / 2);         /* and not the long way round */
    }
}

THEOREM(exp_undoes_log_and_log_undoes_exp)
{
    chance c = {seed(72)};
    double x[3], y[3], vector[3], again[3];
    int trial, k;
    for (trial = 0; trial < 1000; ++trial) {
        double radius = between(&c, 0.1, 10), length, norm;
        random_point(&c, x);
        random_point(&c, y);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_sphere_log(x, y, radius, vector));
        CHECK_OK(surfmink_sphere_exp(x, vector, radius, again));
        for (k = 0; k < 3; ++k) CHECK_NEAR(again[k], radius * y[k] / norm3(y), 3e-15 * radius);
        /* The other way round, at every length from tiny to nearly half a great circle. */
        length = pow(10, between(&c, -12, 0.49)) * radius;
        norm = norm3(vector);
        for (k = 0; k < 3; ++k) vector[k] *= length / norm;
        CHECK_OK(surfmink_sphere_exp(x, vector, radius, y));
        CHECK_CLOSE(norm3(y), radius, 1e-15);
        CHECK_OK(surfmink_sphere_log(x, y, radius, again));
        for (k = 0; k < 3; ++k) CHECK_NEAR(again[k], vector[k], 1e-14 * radius); /* the points carry 1e-16 each */
    }
}

THEOREM(exp_drops_the_part_along_the_point_and_works_in_place)
{
    static const double up[3] = {0, 0, 5}, vector[3] = {PI / 2, 0, 7};
    double y[3], in_place[3] = {0, 0, 5}, also[3] = {PI / 2, 0, 7}, none[3] = {0, 0, 0};
    CHECK_OK(
        surfmink_sphere_exp(up, vector, 1.0, y)); /* only the direction of up counts: a quarter of the unit circle */
    CHECK_NEAR(y[0], 1, 1e-15), CHECK_NEAR(y[1], 0, 1e-15), CHECK_NEAR(y[2], 0, 1e-15);
    CHECK_OK(surfmink_sphere_exp(in_place, vector, 1.0, in_place));
    CHECK_SAME(in_place, y, 3);
    CHECK_OK(surfmink_sphere_exp(up, also, 1.0, also));
    CHECK_SAME(also, y, 3);
    CHECK_OK(surfmink_sphere_exp(up, none, 2.0, y));
    CHECK_NEAR(y[0], 0, 0), CHECK_NEAR(y[1], 0, 0), CHECK_NEAR(y[2], 2, 0);
}

THEOREM(log_keeps_digits_for_close_and_nearly_opposite_points)
{
    static const double x[3] = {0, 0, 1};
    double y[3], vector[3], t;
    for (t = 1; t > 1e-300; t /= 1000) { /* (t, 0, 1) is atan t away */
        y[0] = t, y[1] = 0, y[2] = 1;
        CASE("t = %g", t);
        CHECK_OK(surfmink_sphere_log(x, y, 1.0, vector));
        CHECK_CLOSE(vector[0], atan(t), 5e-16);
        CHECK_NEAR(vector[1], 0, 0);
        if (t < 1e-13) continue;
        y[2] = -1;
        CHECK_OK(surfmink_sphere_log(x, y, 1.0, vector));
        CHECK_CLOSE(vector[0], PI - atan(t), 5e-16);
        CHECK_NEAR(vector[1], 0, 0);
    }
    y[0] = 0, y[1] = 0, y[2] = 3; /* the same direction: no vector at all */
    CHECK_OK(surfmink_sphere_log(x, y, 1.0, vector));
    CHECK_NEAR(norm3(vector), 0, 0);
}

THEOREM(callbacks_of_the_sphere_use_one_frame_at_each_point)
{
    chance c = {seed(73)};
    double radius = 2, x[3], y[3], z[3], to_y[3], to_z[3], cross[3], length[2], direction[2][2];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    int trial, k;
    for (trial = 0; trial < 500; ++trial) {
        double turn, want;
        random_point(&c, x), random_point(&c, y), random_point(&c, z);
        CASE("trial %d", trial);
        CHECK_OK(sphere.log(sphere.context, x, y, &length[0], direction[0]));
        CHECK_OK(sphere.log(sphere.context, x, z, &length[1], direction[1]));
        CHECK_OK(surfmink_sphere_log(x, y, radius, to_y));
        CHECK_OK(surfmink_sphere_log(x, z, radius, to_z));
        CHECK_CLOSE(length[0], norm3(to_y), 1e-15);
        cross3(to_y, to_z, cross);
        want = atan2(dot3(cross, x) / norm3(x), dot3(to_y, to_z));
        turn = atan2(direction[1][1], direction[1][0]) - atan2(direction[0][1], direction[0][0]);
        CHECK_ANGLE(turn, want, 1e-14 / (length[0] < 0.1 ? length[0] : 0.1));
        turn = hypot(direction[0][0], direction[0][1]);
        direction[0][0] /= turn, direction[0][1] /= turn;
        CHECK_OK(sphere.exp(sphere.context, x, direction[0], length[0], z)); /* exp reads the frame that log wrote in */
        for (k = 0; k < 3; ++k) CHECK_NEAR(z[k], 2 * y[k] / norm3(y), 1e-14);
    }
}

/* --- longitude and latitude --------------------------------------------------------------------------------------- */

THEOREM(quadrants_and_poles_are_exact)
{
    static const double want[5][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 0}};
    double point[3], again[3], lon;
    int k, round;
    for (round = -3; round <= 3; ++round)
        for (k = 0; k < 5; ++k) {
            CASE("%d degrees", 90 * k + 360 * round);
            CHECK_OK(surfmink_from_lonlat(90 * k + 360 * round, 0, 2.0, point));
            CHECK_NEAR(point[0], 2 * want[k][0], 0);
            CHECK_NEAR(point[1], 2 * want[k][1], 0);
            CHECK_NEAR(point[2], 0, 0);
        }
    for (lon = -200; lon < 400; lon += 12.34) { /* at a pole all longitudes are the same point */
        CHECK_OK(surfmink_from_lonlat(lon, 90, 2.0, point));
        CHECK_NEAR(point[0], 0, 0), CHECK_NEAR(point[1], 0, 0), CHECK_NEAR(point[2], 2, 0);
        CHECK_OK(surfmink_from_lonlat(lon, -90, 2.0, point));
        CHECK_NEAR(point[0], 0, 0), CHECK_NEAR(point[1], 0, 0), CHECK_NEAR(point[2], -2, 0);
    }
    for (lon = -75; lon < 80; lon += 7.5) { /* the date line is one line */
        CHECK_OK(surfmink_from_lonlat(180, lon, 1.0, point));
        CHECK_OK(surfmink_from_lonlat(-180, lon, 1.0, again));
        for (k = 0; k < 3; ++k) CHECK_NEAR(point[k], again[k], 0);
        CHECK_NEAR(point[1], 0, 0);
    }
}

THEOREM(longitudes_run_east_and_latitudes_north)
{
    chance c = {seed(74)};
    double point[3];
    int trial;
    for (trial = 0; trial < 1000; ++trial) {
        double lon = between(&c, -180, 180), lat = between(&c, -90, 90), radian = PI / 180;
        CASE("lon %.17g lat %.17g", lon, lat);
        CHECK_OK(surfmink_from_lonlat(lon, lat, 3.0, point));
        CHECK_NEAR(point[0], 3 * cos(lat * radian) * cos(lon * radian), 3e-15);
        CHECK_NEAR(point[1], 3 * cos(lat * radian) * sin(lon * radian), 3e-15);
        CHECK_NEAR(point[2], 3 * sin(lat * radian), 3e-15);
    }
    CHECK_OK(surfmink_from_lonlat(360e3 + 30, 60, 1.0, point)); /* a thousand times round */
    CHECK_NEAR(point[0], cos(PI / 6) / 2, 1e-15);
    CHECK_NEAR(point[1], 0.25, 1e-15);
}

/* --- building ----------------------------------------------------------------------------------------------------- */

THEOREM(a_regular_polygon_is_regular_round_its_centre)
{
    static const double centre[3] = {0.6, 0, -0.8};
    surfmink_surface hyperbolic = hyperbolic_plane(), sphere;
    double radius = 2, corner[3 * 12], length[12], turning[12], there, first, direction[2];
    size_t n, i;
    sphere = surfmink_sphere_surface(&radius);
    for (n = 3; n <= 12; ++n) {
        CASE("%d corners", (int)n);
        CHECK_OK(surfmink_regular_polygon(&sphere, centre, 1.5, 0.4, n, corner));
        CHECK_OK(surfmink_edges(ON_SURFACE(&sphere, corner, n), length, turning, NULL));
        for (i = 0; i < n; ++i) {
            CHECK_CLOSE(length[i], length[0], 1e-14);
            CHECK_NEAR(turning[i], turning[0], 1e-14);
            CHECK_OK(sphere.log(sphere.context, centre, corner + 3 * i, &there, direction));
            CHECK_CLOSE(there, 1.5, 1e-14);
            first = atan2(direction[1], direction[0]);
            CHECK_ANGLE(first, 0.4 + 2 * PI * (double)i / (double)n,
                        1e-14); /* the first at the angle, then counter-clockwise */
            CHECK(turning[i] > 0);
        }
        CHECK_OK(surfmink_regular_polygon(&hyperbolic, centre, 1.5, 0.4, n, corner)); /* reads (0.6, 0) of the centre */
        CHECK_OK(surfmink_edges(ON_SURFACE(&hyperbolic, corner, n), length, turning, NULL));
        for (i = 0; i < n; ++i) {
            CHECK_CLOSE(length[i], length[0], 1e-13);
            CHECK_NEAR(turning[i], turning[0], 1e-13);
        }
    }
}

THEOREM(points_of_an_edge_divide_it_evenly_without_its_end)
{
    chance c = {seed(75)};
    double radius = 2, x[3], y[3], point[3 * 9], whole, part, direction[2], cross[3];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    int trial, k;
    for (trial = 0; trial < 300; ++trial) {
        size_t m = 1 + one_of(&c, 9), i;
        random_point(&c, x), random_point(&c, y);
        CASE("trial %d, %d points", trial, (int)m);
        CHECK_OK(surfmink_edge_points(&sphere, x, y, m, point));
        CHECK_SAME(point, x, 3); /* the start as it is, to the bit */
        CHECK_OK(sphere.log(&radius, x, y, &whole, direction));
        cross3(x, y, cross);
        for (i = 1; i < m; ++i) {
            CHECK_OK(sphere.log(&radius, x, point + 3 * i, &part, direction));
            CHECK_NEAR(part, whole * (double)i / (double)m, 1e-14);
            CHECK_NEAR(dot3(point + 3 * i, cross), 0, 1e-14);
        }
        CHECK_OK(sphere.log(&radius, point + 3 * (m - 1), y, &part, direction));
        CHECK_NEAR(part, whole / (double)m, 1e-14);
        for (k = 0; k < 3; ++k) x[k] = y[k];
    }
}

THEOREM(an_outline_with_points_along_its_edges_is_the_same_outline)
{
    chance c = {seed(76)};
    surfmink_surface hyperbolic = hyperbolic_plane();
    double xy[2 * MOST], fine[2 * 5 * MOST], mu[2][13];
    surfmink_functionals w[2];
    int trial, p;
    for (trial = 0; trial < 100; ++trial) {
        size_t n = 3 + one_of(&c, 20), i;
        gentle_star(&c, n, xy);
        for (i = 0; i < 2 * n; ++i) xy[i] *= 0.7;
        for (i = 0; i < n; ++i)
            CHECK_OK(surfmink_edge_points(&hyperbolic, xy + 2 * i, xy + 2 * ((i + 1) % n), 5, fine + 10 * i));
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(ON_SURFACE(&hyperbolic, xy, n), 12, mu[0], NULL, &w[0], NULL));
        CHECK_OK(surfmink_measure(ON_SURFACE(&hyperbolic, fine, 5 * n), 12, mu[1], NULL, &w[1], NULL));
        CHECK_CLOSE(w[1].length, w[0].length, 1e-13);
        CHECK_CLOSE(w[1].turning, w[0].turning, 1e-13);
        for (p = 0; p <= 12; ++p) CHECK_NEAR(mu[1][p], mu[0][p], 1e-12);
    }
}

/* --- repairing ---------------------------------------------------------------------------------------------------- */

THEOREM(reversal_is_its_own_inverse_and_swaps_whole_corners)
{
    static const double want[10] = {9, 10, 7, 8, 5, 6, 3, 4, 1, 2};
    double corner[10] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, even[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    static const double swapped[6] = {4, 5, 6, 1, 2, 3};
    surfmink_reverse(corner, 5, 2);
    CHECK_SAME(corner, want, 10);
    surfmink_reverse(corner, 5, 2);
    CHECK_NEAR(corner[0], 1, 0), CHECK_NEAR(corner[9], 10, 0);
    surfmink_reverse(even, 2, 3);
    CHECK_SAME(even, swapped, 6);
    CHECK_NEAR(even[6], 7, 0); /* beyond the n corners nothing moves */
    surfmink_reverse(even, 1, 3);
    surfmink_reverse(even, 0, 3);
    CHECK_SAME(even, swapped, 6);
}

/* Paper 5.3. */
THEOREM(smoothing_takes_the_mean_of_a_corner_and_its_neighbours)
{
    chance c = {seed(77)};
    double corner[3 * MOST], once[3 * MOST], smooth[3 * MOST];
    int trial;
    for (trial = 0; trial < 100; ++trial) {
        size_t n = 3 + one_of(&c, 20), stride = 2 + one_of(&c, 2), passes = one_of(&c, 5), pass, i, k;
        for (i = 0; i < n * stride; ++i) smooth[i] = corner[i] = between(&c, -1, 1);
        for (pass = 0; pass < passes; ++pass) {
            for (i = 0; i < n; ++i)
                for (k = 0; k < stride; ++k)
                    once[i * stride + k] = (corner[(i + n - 1) % n * stride + k] + corner[i * stride + k] +
                                            corner[(i + 1) % n * stride + k]) /
                                           3;
            memcpy(corner, once, sizeof once);
        }
        surfmink_smooth(smooth, n, stride, passes);
        CASE("trial %d, %d passes", trial, (int)passes);
        for (i = 0; i < n * stride; ++i) CHECK_NEAR(smooth[i], corner[i], 1e-15);
        surfmink_smooth(smooth, 0, stride, 1); /* no corners are smooth */
        for (i = 0; i < n * stride; ++i) CHECK_NEAR(smooth[i], corner[i], 1e-15);
    }
}

THEOREM(smoothing_takes_the_staircase_out_of_a_pixel_outline)
{
    /* The slanted square |x| + |y| <= 8 in pixels: as drawn it turns by right angles only, so it looks like a square
       that stands upright; smoothed, its eigenvectors of rank 4 point along the diagonals. */
    double corner[2 * 2 * 32], mu[5], g[10], frame[4], vector[8];
    int x = 8, y = 0, k = 0, side;
    static const int step[4][2] = {{-1, 1}, {-1, -1}, {1, -1}, {1, 1}};
    size_t i, n;
    for (side = 0; side < 4; ++side)
        for (i = 0; i < 8; ++i) {
            int across = side % 2; /* corners of the staircase lie outside */
            corner[k++] = x, corner[k++] = y;
            corner[k++] = x + (across ? step[side][0] : 0), corner[k++] = y + (across ? 0 : step[side][1]);
            x += step[side][0];
            y += step[side][1];
        }
    n = (size_t)k / 2;
    CHECK_OK(surfmink_measure(IN_PLANE(corner, n), 4, mu, g, NULL, NULL));
    CHECK_NEAR(mu[4], 1, 1e-14);
    CHECK_OK(surfmink_frame(IN_PLANE(corner, n), 0, frame));
    CHECK_OK(surfmink_eigenvectors(g, 4, 1, 0.0, frame, 2, vector));
    CHECK_NEAR(fmin(fabs(vector[0]), fabs(vector[1])), 0, 1e-13);
    surfmink_smooth(corner, n, 2, 4);
    CHECK_OK(surfmink_measure(IN_PLANE(corner, n), 4, mu, g, NULL, NULL));
    CHECK(mu[4] > 0.5);
    CHECK_OK(surfmink_frame(IN_PLANE(corner, n), 0, frame));
    CHECK_OK(surfmink_eigenvectors(g, 4, 1, 0.0, frame, 2, vector));
    CHECK_NEAR(fabs(vector[0]), sqrt(0.5), 0.05);
}

THEOREM(merging_drops_repeated_corners_and_their_normals)
{
    const double nan = (double)NAN;
    double unknown[6] = {nan, nan, nan, nan, 1, 1};
    double corner[14] = {1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 1, 1}; /* a a b b b c a: the last is the first again */
    double normal[21] = {10, 1, 2, 11, 0, 0, 20, 3, 4, 21, 0, 0, 22, 0, 0, 30, 5, 6, 12, 0, 0};
    static const double want[6] = {1, 1, 2, 2, 3, 3}, kept[9] = {10, 1, 2, 20, 3, 4, 30, 5, 6};
    double twice[7] = {1, 2, 1, 2, 3, 4, 5};
    static const double once[7] = {1, 2, 3, 4, 3, 4, 5};
    double near[6] = {0, 0, 0, 1e-300, 0, 0}, same[4] = {5, 5, 5, 5}, zero[4] = {0.0, 0.0, -0.0, 0.0};
    CHECK_EQUAL(surfmink_merge(corner, normal, 7, 2, 0.0), 3);
    CHECK_SAME(corner, want, 6);
    CHECK_SAME(normal, kept, 9);
    CHECK_EQUAL(surfmink_merge(corner, NULL, 3, 2, 0.0), 3);
    CHECK_SAME(corner, want, 6);
    CHECK_EQUAL(surfmink_merge(near, NULL, 3, 2, 0.0), 2); /* only equal corners are the same */
    CHECK_EQUAL(surfmink_merge(twice, NULL, 3, 2, 0.0), 2);
    CHECK_SAME(twice, once, 7); /* what stands behind them stays */
    CHECK_EQUAL(surfmink_merge(same, NULL, 2, 2, 0.0), 1);
    CHECK_EQUAL(surfmink_merge(zero, NULL, 2, 2, 0.0), 1); /* there is no negative place */
    CHECK_EQUAL(surfmink_merge(same, NULL, 1, 2, 0.0), 1);
    CHECK_EQUAL(surfmink_merge(same, NULL, 0, 2, 0.0), 0);
    CHECK_EQUAL(surfmink_merge(unknown, NULL, 3, 2, 0.0),
                3); /* NaN equals nothing: it is refused later, not lost here */
}

/* A distance is straight, not one of coordinates, in any unit; and nothing behind the corners is read. */
THEOREM(merging_takes_straight_distances_of_any_size)
{
    static const double corner[6] = {0, 0, 0.8, 0.8, 5, 5}; /* 1.13 apart */
    int power;
    for (power = -700; power <= 700; power += 350) {
        double *copy = (double *)malloc(sizeof corner);
        size_t i, kept;
        CHECK(copy);
        if (!copy) return;
        for (i = 0; i < 6; ++i) copy[i] = ldexp(corner[i], power);
        CASE("2^%d", power);
        CHECK_EQUAL(surfmink_merge(copy, NULL, 3, 2, ldexp(1.1, power)), 3);
        kept = surfmink_merge(copy, NULL, 3, 2, ldexp(1.2, power));
        CHECK_EQUAL(kept, 2);
        CHECK_EQUAL(copy[2] == ldexp(5, power), 1);
        free(copy);
    }
}

THEOREM(a_merged_outline_is_measured_where_it_was_refused)
{
    chance c = {seed(78)};
    double xy[2 * MOST], doubled[4 * MOST], mu[2][7];
    int trial, p;
    for (trial = 0; trial < 100; ++trial) {
        size_t n = 3 + one_of(&c, 20), m = 0, i;
        random_star(&c, n, xy);
        for (i = 0; i < n; ++i) {
            size_t copies = i == 0 ? 2 : 1 + one_of(&c, 2);
            while (copies-- > 0) memcpy(doubled + 2 * m++, xy + 2 * i, 2 * sizeof *xy);
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, n), 6, mu[0], NULL, NULL, NULL));
        CHECK_STATUS(surfmink_measure(IN_PLANE(doubled, m), 6, mu[1], NULL, NULL, NULL), SURFMINK_COINCIDENT_CORNERS);
        CHECK_EQUAL(surfmink_merge(doubled, NULL, m, 2, 0.0), n);
        CHECK_OK(surfmink_measure(IN_PLANE(doubled, n), 6, mu[1], NULL, NULL, NULL));
        for (p = 0; p <= 6; ++p) CHECK_NEAR(mu[1][p], mu[0][p], 0);
    }
}

/* Points that end with their block, for address sanitizers: nothing is read of a fourth number, or written. */
THEOREM(points_are_three_numbers)
{
    double *x = (double *)malloc(3 * sizeof *x), *v = (double *)malloc(3 * sizeof *v),
           *y = (double *)malloc(3 * sizeof *y);
    double radius = 2, direction[2] = {0.6, 0.8}, length = 0;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    CHECK(x && v && y);
    if (!x || !v || !y) return;
    x[0] = 0, x[1] = 0, x[2] = 2;
    y[0] = 2, y[1] = 0, y[2] = 0;
    CHECK_OK(surfmink_sphere_log(x, y, radius, v));
    CHECK_CLOSE(v[0], PI, 1e-15);
    CHECK_OK(surfmink_sphere_exp(x, v, radius, y));
    CHECK_CLOSE(y[0], 2, 1e-15);
    CHECK_OK(sphere.log(&radius, x, y, &length, direction));
    CHECK_CLOSE(length, PI, 1e-15);
    CHECK_OK(sphere.exp(&radius, x, direction, 1.0, y));
    CHECK_OK(surfmink_from_lonlat(10, 20, radius, y));
    free(x);
    free(v);
    free(y);
}

int main(void)
{
    PROVE(log_is_the_tangent_as_long_as_the_arc);
    PROVE(exp_undoes_log_and_log_undoes_exp);
    PROVE(exp_drops_the_part_along_the_point_and_works_in_place);
    PROVE(log_keeps_digits_for_close_and_nearly_opposite_points);
    PROVE(callbacks_of_the_sphere_use_one_frame_at_each_point);
    PROVE(quadrants_and_poles_are_exact);
    PROVE(longitudes_run_east_and_latitudes_north);
    PROVE(a_regular_polygon_is_regular_round_its_centre);
    PROVE(points_of_an_edge_divide_it_evenly_without_its_end);
    PROVE(an_outline_with_points_along_its_edges_is_the_same_outline);
    PROVE(reversal_is_its_own_inverse_and_swaps_whole_corners);
    PROVE(smoothing_takes_the_mean_of_a_corner_and_its_neighbours);
    PROVE(smoothing_takes_the_staircase_out_of_a_pixel_outline);
    PROVE(merging_drops_repeated_corners_and_their_normals);
    PROVE(merging_takes_straight_distances_of_any_size);
    PROVE(a_merged_outline_is_measured_where_it_was_refused);
    PROVE(points_are_three_numbers);
    return QED();
}
