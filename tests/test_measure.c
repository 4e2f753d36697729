/* Step 1: corners become edge lengths, turning angles and Minkowski functionals.
   cc -I. tests/test_measure.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <float.h>

#include "harness.h"
#include "shapes.h"

/* --- conventions -------------------------------------------------------------------------------------------------- */

THEOREM(edge_i_leaves_corner_i_and_turning_i_is_the_turn_at_corner_i)
{
    /* Sides 4, 3, 5; the right angle is at corner 1. */
    static const double corner[6] = {0, 0, 4, 0, 4, 3};
    double length[3], turning[3];
    CHECK_OK(surfmink_edges(IN_PLANE(corner, 3), length, turning, NULL));
    CHECK_NEAR(length[0], 4, 0);
    CHECK_NEAR(length[1], 3, 0);
    CHECK_NEAR(length[2], 5, 0);
    CHECK_NEAR(turning[0], PI - atan2(3, 4), 1e-15);
    CHECK_NEAR(turning[1], PI / 2, 0);
    CHECK_NEAR(turning[2], PI - atan2(4, 3), 1e-15);
}

THEOREM(a_turn_to_the_inside_is_positive_and_a_dent_is_negative)
{
    /* An L: five corners of the outside, and a dent at corner 3. */
    static const double corner[12] = {0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2};
    double length[6], turning[6];
    size_t i;
    CHECK_OK(surfmink_edges(IN_PLANE(corner, 6), length, turning, NULL));
    for (i = 0; i < 6; ++i) CHECK_NEAR(turning[i], i == 3 ? -PI / 2 : PI / 2, 0);
}

THEOREM(the_octant_of_a_sphere_has_three_right_angles)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double length[3], turning[3], area;
    size_t i;
    CHECK_OK(surfmink_edges(ON_SPHERE(corner, 3, 3.0), length, turning, NULL));
    for (i = 0; i < 3; ++i) {
        CHECK_CLOSE(length[i], 3 * PI / 2, 2e-16);
        CHECK_CLOSE(turning[i], PI / 2, 2e-16);
    }
    CHECK_OK(surfmink_area(ON_SPHERE(corner, 3, 3.0), &area));
    CHECK_CLOSE(area, 4 * PI * 9 / 8, 3e-16);
}

/* Corners at 0, e and 2 e + t e', where e' is e turned by a right angle, turn by atan t. They are exact; so is e x
   (out - in), while e x out would leave 1e-7 of that turn. Long smooth outlines consist of such corners. */
THEOREM(nearly_straight_corners_keep_all_digits_of_their_turn)
{
    static const double x[3] = {1, 2, 2}, y[3] = {2, 1, -2}; /* orthogonal, and to their normal, and all of length 3 */
    static const double normal[9] = {-2, 2, -1, -2, 2, -1, -2, 2, -1};
    chance c = {seed(18)};
    double flat[6] = {0}, space[9] = {0}, length[3], turning[3];
    int trial, k;
    for (trial = 0; trial < 300; ++trial) {
        double a = floor(between(&c, 1e5, 2.5e5)), b = floor(between(&c, 1e5, 2.5e5)), t = power_of_two(-30);
        if (trial % 2) t = -t;
        flat[2] = a, flat[3] = b, flat[4] = 2 * a - t * b, flat[5] = 2 * b + t * a;
        for (k = 0; k < 3; ++k) {
            space[3 + k] = flat[2] * x[k] + flat[3] * y[k];
            space[6 + k] = flat[4] * x[k] + flat[5] * y[k];
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(flat, 3), length, turning, NULL));
        CHECK_CLOSE(turning[1], atan(t), 1e-15);
        CHECK_OK(surfmink_edges(IN_SPACE(space, normal, 3), length, turning, NULL));
        CHECK_CLOSE(turning[1], atan(t), 2e-15);
    }
}

/* --- the same lengths and angles found another way ---------------------------------------------------------------- */

THEOREM(in_the_plane_a_turn_is_the_difference_of_two_edge_directions)
{
    chance c = {seed(1)};
    double xy[2 * MOST], length[MOST], turning[MOST];
    int trial;
    for (trial = 0; trial < 3000; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        random_star(&c, n, xy);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(xy, n), length, turning, NULL));
        for (i = 0; i < n; ++i) {
            const double *from = xy + 2 * ((i + n - 1) % n), *at = xy + 2 * i, *to = xy + 2 * ((i + 1) % n);
            double in = atan2(at[1] - from[1], at[0] - from[0]), out = atan2(to[1] - at[1], to[0] - at[0]);
            CHECK_CLOSE(length[i], hypot(to[0] - at[0], to[1] - at[1]), 5e-16);
            CHECK_ANGLE(turning[i], out - in, 2e-15);
            CHECK(fabs(turning[i]) <= PI);
        }
    }
}

THEOREM(on_the_sphere_edges_are_great_circles)
{
    chance c = {seed(2)};
    double xy[2 * MOST], xyz[3 * MOST], length[MOST], turning[MOST];
    int trial;
    for (trial = 0; trial < 1000; ++trial) {
        size_t n = 3 + one_of(&c, 20), i, k;
        double radius = between(&c, 0.1, 10);
        random_star(&c, n, xy);
        onto_sphere(xy, n, between(&c, 0.1, 3), xyz);
        turn_somehow(&c, xyz, n);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(ON_SPHERE(xyz, n, radius), length, turning, NULL));
        for (i = 0; i < n; ++i) {
            const double *from = xyz + 3 * ((i + n - 1) % n), *at = xyz + 3 * i, *to = xyz + 3 * ((i + 1) % n);
            double before[3], after[3], around[3], cross[3], arc, least;
            cross3(at, to, cross);
            arc = atan2(sqrt(dot3(cross, cross)), dot3(at, to));
            CHECK_NEAR(length[i] / radius, arc, 1e-15 * (1 + arc)); /* a longer one has more to round */
            /* The planes of two great circles meet at the corner, at the angle between their poles. */
            cross3(from, at, before);
            cross3(at, to, after);
            cross3(before, after, around);
            least = fmin(sqrt(dot3(before, before)), sqrt(dot3(after, after)));
            for (k = 0; k < 3; ++k) around[k] *= at[k];
            CHECK_ANGLE(turning[i], atan2(around[0] + around[1] + around[2], dot3(before, after)), 1e-15 / least);
        }
    }
}

THEOREM(the_sphere_is_embedded_with_its_corners_as_normals)
{
    /* The projections of a chord and of a great circle to the tangent plane have the same direction, whatever their
       length. */
    chance c = {seed(3)};
    double xy[2 * MOST], xyz[3 * MOST], length[2][MOST], turning[2][MOST];
    int trial;
    for (trial = 0; trial < 1000; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        random_star(&c, n, xy);
        onto_sphere(xy, n, trial % 2 ? between(&c, 0.1, 0.99) : 1e-6, xyz); /* no two corners 90 degrees apart */
        turn_somehow(&c, xyz, n);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(ON_SPHERE(xyz, n, 1.0), length[0], turning[0], NULL));
        CHECK_OK(surfmink_edges(IN_SPACE(xyz, xyz, n), length[1], turning[1], NULL));
        for (i = 0; i < n; ++i) {
            CHECK_ANGLE(turning[0][i], turning[1][i], 5e-15);
            CHECK_NEAR(length[1][i], 2 * sin(length[0][i] / 2),
                       1e-15); /* the corners are on the sphere to rounding only */
        }
    }
}

THEOREM(only_the_part_of_an_edge_along_the_surface_turns)
{
    /* Edges that leave the tangent plane: their projections turn, their lengths do not shrink. */
    chance c = {seed(4)};
    double xy[2 * MOST], xyz[3 * MOST], normal[3 * MOST], flat[2][MOST], raised[2][MOST];
    int trial;
    for (trial = 0; trial < 500; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        gentle_star(&c, n, xy);
        for (i = 0; i < n; ++i) {
            xyz[3 * i] = xy[2 * i];
            xyz[3 * i + 1] = xy[2 * i + 1];
            xyz[3 * i + 2] = i % 2 ? 0.0 : 0.05; /* zigzag along the normal */
            normal[3 * i] = normal[3 * i + 1] = 0;
            normal[3 * i + 2] = between(&c, 0.1, 10);
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(xy, n), flat[0], flat[1], NULL));
        CHECK_OK(surfmink_edges(IN_SPACE(xyz, normal, n), raised[0], raised[1], NULL));
        for (i = 0; i < n; ++i) {
            double rise = xyz[3 * ((i + 1) % n) + 2] - xyz[3 * i + 2];
            CHECK_CLOSE(raised[0][i], hypot(flat[0][i], rise), 1e-15);
            CHECK_ANGLE(raised[1][i], flat[1][i], 5e-15);
        }
    }
}

THEOREM(edges_may_be_steep_without_loss)
{
    /* A zigzag so high that edges rise at up to 89.999 degrees, in a plane spanned by (1, 2, 2) and (2, 1, -2). All
       corners are exact, but at the larger heights their differences are not: what rounding takes from them is small
       beside the edge and large beside its projection. */
    static const double u[3] = {1, 2, 2}, v[3] = {2, 1, -2}, up[3] = {-2, 2, -1};
    chance c = {seed(20)};
    double xy[2 * MOST], xyz[3 * MOST], normal[3 * MOST], flat[2][MOST], steep[2][MOST], height;
    int trial;
    for (trial = 0; trial < 200; ++trial)
        for (height = 1; height < 1e5; height *= 16) {
            size_t n = whole_star(&c, xy), i, k;
            for (i = 0; i < n; i += 2) { /* the low corners have fractions */
                xy[2 * i] += floor(between(&c, -5e8, 5e8)) * power_of_two(-38);
                xy[2 * i + 1] += floor(between(&c, -5e8, 5e8)) * power_of_two(-38);
            }
            for (i = 0; i < n; ++i)
                for (k = 0; k < 3; ++k) {
                    xyz[3 * i + k] = xy[2 * i] * u[k] + xy[2 * i + 1] * v[k] + (i % 2 ? height : 0) * up[k];
                    normal[3 * i + k] = up[k];
                }
            CASE("trial %d, height %g", trial, height);
            CHECK_OK(surfmink_edges(IN_PLANE(xy, n), flat[0], flat[1], NULL));
            CHECK_OK(surfmink_edges(IN_SPACE(xyz, normal, n), steep[0], steep[1], NULL));
            for (i = 0; i < n; ++i) {
                double rise = (i + 1) % n % 2 == i % 2 ? 0 : height;
                CHECK_CLOSE(steep[0][i], 3 * hypot(flat[0][i], rise), 1e-15);
                CHECK_ANGLE(steep[1][i], flat[1][i], 3e-15);
            }
        }
}

THEOREM(turning_angles_do_not_see_the_frames_of_the_callbacks)
{
    chance c = {seed(5)};
    surfmink_surface plane = spinning_plane();
    double xy[2 * MOST], flat[2][MOST], spun[2][MOST];
    int trial;
    for (trial = 0; trial < 500; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        random_star(&c, n, xy);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(xy, n), flat[0], flat[1], NULL));
        CHECK_OK(surfmink_edges(ON_SURFACE(&plane, xy, n), spun[0], spun[1], NULL));
        for (i = 0; i < n; ++i) {
            CHECK_CLOSE(spun[0][i], flat[0][i], 1e-15);
            CHECK_ANGLE(spun[1][i], flat[1][i], 3e-15);
        }
    }
}

THEOREM(the_sphere_by_callbacks_is_the_sphere)
{
    chance c = {seed(6)};
    double radius = 2.5, xy[2 * MOST], xyz[3 * MOST], direct[2][MOST], called[2][MOST];
    double mu[2][13], g[2][26];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    surfmink_functionals w[2];
    int trial, p;
    CHECK_EQUAL(sphere.stride, 3);
    for (trial = 0; trial < 500; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        radius = between(&c, 0.1, 10); /* read at each call */
        random_star(&c, n, xy);
        onto_sphere(xy, n, trial % 2 ? between(&c, 0.1, 3) : 1e-5, xyz);
        turn_somehow(&c, xyz, n);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(ON_SPHERE(xyz, n, radius), direct[0], direct[1], NULL));
        CHECK_OK(surfmink_edges(ON_SURFACE(&sphere, xyz, n), called[0], called[1], NULL));
        for (i = 0; i < n; ++i) {
            CHECK_CLOSE(called[0][i], direct[0][i], 1e-15);
            CHECK_ANGLE(called[1][i], direct[1][i], 5e-15);
        }
        CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, radius), 12, mu[0], g[0], &w[0], NULL));
        CHECK_OK(surfmink_measure(ON_SURFACE(&sphere, xyz, n), 12, mu[1], g[1], &w[1], NULL));
        CHECK_CLOSE(w[1].length, w[0].length, 1e-15);
        CHECK_CLOSE(w[1].turning, w[0].turning, 2e-15 * w[0].condition);
        for (p = 0; p <= 12; ++p) CHECK_NEAR(mu[1][p], mu[0][p], 1e-14 * w[0].condition);
    }
}

THEOREM(on_the_sphere_only_the_direction_of_a_corner_counts)
{
    chance c = {seed(7)};
    double xy[2 * MOST], on[3 * MOST], off[3 * MOST], length[2][MOST], turning[2][MOST], area[2], least;
    int trial, compared = 0;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = 3 + one_of(&c, 20), i, k;
        random_star(&c, n, xy);
        onto_sphere(xy, n, trial % 2 ? 3.0 : 1e-6, on);
        turn_somehow(&c, on, n);
        for (i = 0; i < n; ++i) { /* powers of two keep every bit of a direction */
            int most = trial % 4 < 2 ? 2 : 500, exponent = (int)one_of(&c, (size_t)(2 * most + 1)) - most;
            for (k = 0; k < 3; ++k) off[3 * i + k] = ldexp(on[3 * i + k], exponent);
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(ON_SPHERE(on, n, 7.0), length[0], turning[0], NULL));
        for (least = 7, i = 0; i < n; ++i) least = fmin(least, length[0][i]);
        if (least < 7 * 8 * DBL_EPSILON) continue; /* off the sphere rounding might have kept these corners apart */
        CHECK_OK(surfmink_edges(ON_SPHERE(off, n, 7.0), length[1], turning[1], NULL));
        ++compared;
        for (i = 0; i < n; ++i) {
            CHECK_CLOSE(length[1][i], length[0][i], 3e-15);
            CHECK_ANGLE(turning[1][i], turning[0][i], 1e-14);
        }
        CHECK_OK(surfmink_area(ON_SPHERE(on, n, 7.0), &area[0]));
        CHECK_OK(surfmink_area(ON_SPHERE(off, n, 7.0), &area[1]));
        CHECK_CLOSE(area[1], area[0], 1e-14);
    }
    CHECK(compared > 280);
}

/* --- Minkowski functionals ---------------------------------------------------------------------------------------- */

THEOREM(the_functionals_are_area_length_and_total_turning)
{
    static const double corner[12] = {0, 0, 2, 0, 2, 1, 1, 1, 1, 2, 0, 2}; /* the L: area 3, length 8, one dent */
    double length[6], turning[6], mu[1];
    surfmink_functionals w, total;
    CHECK_OK(surfmink_measure(IN_PLANE(corner, 6), 0, mu, NULL, &w, NULL));
    CHECK_NEAR(mu[0], 1, 0);
    CHECK_NEAR(w.area, 3, 0);
    CHECK_NEAR(w.length, 8, 0);
    CHECK_NEAR(w.turning, 2 * PI, 0);
    CHECK_NEAR(w.curvature, 0, 0);
    CHECK_NEAR(w.condition, 1.5, 0); /* six right angles, of which one is lost again */
    CHECK_OK(surfmink_edges(IN_PLANE(corner, 6), length, turning, NULL));
    CHECK_OK(surfmink_total(NULL, length, turning, 6, &total));
    CHECK_NEAR(total.area, 0, 0);
    CHECK_NEAR(total.length, w.length, 0);
    CHECK_NEAR(total.turning, w.turning, 0);
    CHECK_NEAR(total.curvature, 0, 0);
    CHECK_NEAR(total.condition, w.condition, 0);
}

/* Theorem (Gauss-Bonnet): the turning angles add up to 2 pi minus the enclosed curvature. */
THEOREM(the_total_turn_is_two_pi_in_the_plane)
{
    chance c = {seed(8)};
    double xy[2 * MOST];
    surfmink_functionals w;
    int trial;
    for (trial = 0; trial < 2000; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2);
        random_star(&c, n, xy);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, n), 0, NULL, NULL, &w, NULL));
        CHECK_NEAR(w.turning, 2 * PI, 0); /* the theorem, not the sum of rounded angles */
        CHECK(w.area > 0);
    }
}

THEOREM(the_total_turn_is_two_pi_minus_the_area_on_the_unit_sphere)
{
    chance c = {seed(9)};
    double xy[2 * MOST], xyz[3 * MOST], area;
    surfmink_functionals w;
    int trial;
    for (trial = 0; trial < 2000; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2);
        double radius = between(&c, 0.1, 10);
        random_star(&c, n, xy);
        onto_sphere(xy, n, between(&c, 0.01, 5), xyz);
        turn_somehow(&c, xyz, n);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, radius), 0, NULL, NULL, &w, NULL));
        CHECK_CLOSE(w.turning, 2 * PI - w.area / (radius * radius), 1e-14 * w.condition);
        CHECK_CLOSE(w.curvature, w.area / (radius * radius), 5e-16);
        CHECK_OK(surfmink_area(ON_SPHERE(xyz, n, radius), &area));
        CHECK_CLOSE(w.area, area, 2e-15); /* a product of complex numbers, a sum of angles */
        CHECK(w.condition >= 1);
    }
}

THEOREM(the_hyperbolic_turn_is_two_pi_plus_the_area)
{
    chance c = {seed(10)};
    surfmink_surface hyperbolic = hyperbolic_plane();
    double xy[2 * MOST];
    surfmink_functionals w;
    int trial;
    for (trial = 0; trial < 1000; ++trial) {
        size_t n = 3 + one_of(&c, 20), i;
        double area;
        random_star(&c, n, xy);
        for (i = 0; i < 2 * n; ++i) xy[i] *= 0.7; /* geodesics of the disk bend towards its centre, where the star is */
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(ON_SURFACE(&hyperbolic, xy, n), 0, NULL, NULL, &w, NULL));
        area = hyperbolic_area(xy, n);
        CHECK_NEAR(w.turning, 2 * PI + area, 1e-13 * w.condition);
        CHECK_NEAR(w.curvature, -area, 1e-13 * w.condition);
        CHECK_NEAR(w.area, 0, 0);
    }
}

/* --- areas -------------------------------------------------------------------------------------------------------- */

THEOREM(far_away_squares_keep_their_area_and_every_other_digit)
{
    static const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    double far_off[8], area = 0, length[4], turning[4];
    surfmink_functionals w;
    size_t i;
    for (i = 0; i < 8; ++i) far_off[i] = square[i] + 1e8;
    CHECK_OK(surfmink_area(IN_PLANE(far_off, 4), &area));
    CHECK_NEAR(area, 1, 0);
    CHECK_OK(surfmink_measure(IN_PLANE(far_off, 4), 0, NULL, NULL, &w, NULL));
    CHECK_NEAR(w.area, 1, 0);
    CHECK_OK(surfmink_edges(IN_PLANE(far_off, 4), length, turning, NULL));
    for (i = 0; i < 4; ++i) {
        CHECK_NEAR(length[i], 1, 0);
        CHECK_NEAR(turning[i], PI / 2, 0);
    }
    surfmink_reverse(far_off, 4, 2);
    CHECK_OK(surfmink_area(IN_PLANE(far_off, 4), &area));
    CHECK_NEAR(area, -1, 0);
}

THEOREM(the_area_of_a_plane_polygon_is_the_sum_of_its_triangles)
{
    chance c = {seed(11)};
    double xy[2 * MOST], area;
    int trial;

    for (trial = 0; trial < 500; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        double sum = 0;
        random_star(&c, n, xy);
        for (i = 0; i < n; ++i) { /* about the centre of the star all of them count as positive */
            const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % n);
            sum += (a[0] * b[1] - a[1] * b[0]) / 2;
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_area(IN_PLANE(xy, n), &area));
        CHECK_NEAR(area, sum, 3e-15);
    }
}

THEOREM(tiny_cells_of_a_sphere_have_the_area_of_their_map)
{
    /* Near the pole the central projection stretches areas by 1 + 3/2 size^2, which is rounding for a size below
       1e-8. */
    chance c = {seed(12)};
    double xy[2 * MOST], xyz[3 * MOST], flat, area;
    surfmink_functionals w;
    double size;
    int trial;
    for (trial = 0; trial < 200; ++trial)
        for (size = 1e-9; size > 1e-13; size /= 10) {
            size_t n = 3 + one_of(&c, MOST - 2), i;
            random_star(&c, n, xy);
            for (i = 0; i < n; ++i) {
                xyz[3 * i] = xy[2 * i] *= size;
                xyz[3 * i + 1] = xy[2 * i + 1] *= size;
                xyz[3 * i + 2] = 1; /* only the direction counts */
            }
            CASE("trial %d, size %g", trial, size);
            CHECK_OK(surfmink_area(IN_PLANE(xy, n), &flat));
            CHECK_OK(surfmink_area(ON_SPHERE(xyz, n, 1.0), &area));
            CHECK_CLOSE(area, flat, 2e-14);
            CHECK_OK(surfmink_measure(ON_SPHERE(xyz, n, 10.0), 0, NULL, NULL, &w, NULL));
            CHECK_CLOSE(w.area, 100 * flat, 2e-14);
            CHECK_CLOSE(w.curvature, flat, 2e-14); /* 2 pi - S would say 0 */
        }
}

THEOREM(a_lune_through_both_poles_has_its_share_of_the_sphere)
{
    /* Corners 0 and 2, or 1 and 3, are opposite: wherever the fan of triangles starts, it meets that. ACCURACY grants
       2e-15 of half the sum of |x_i - x_0| l_i, which comes to at most 2 pi. */
    const double within = 2e-15 * 2 * PI;
    chance c = {seed(13)};
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        double width = trial < 20 ? power_of_two(-2 * trial) : between(&c, 1e-3, 179.9), corner[12], moved[12], area;
        double want = 2 * width * (PI / 180);
        surfmink_functionals w;
        size_t start;
        CHECK_OK(surfmink_from_lonlat(0, 90, 1.0, corner));
        CHECK_OK(surfmink_from_lonlat(0, between(&c, -80, 80), 1.0, corner + 3));
        CHECK_OK(surfmink_from_lonlat(0, -90, 1.0, corner + 6));
        CHECK_OK(surfmink_from_lonlat(width, between(&c, -80, 80), 1.0, corner + 9));
        if (trial % 2) turn_somehow(&c, corner, 4);
        for (start = 0; start < 4; ++start) {
            start_at(start, corner, 4, 3, moved);
            CASE("%g degrees wide, corner 0 is number %d", width, (int)start);
            CHECK_OK(surfmink_area(ON_SPHERE(moved, 4, 1.0), &area));
            CHECK_NEAR(area, want, within);
            CHECK_OK(surfmink_measure(ON_SPHERE(moved, 4, 1.0), 0, NULL, NULL, &w, NULL));
            CHECK_NEAR(w.area, want, within);
            CHECK_CLOSE(w.length, 2 * PI, 1e-15);
        }
        surfmink_reverse(corner, 4, 3); /* the other side is the larger one, so this one counts as negative */
        CHECK_OK(surfmink_area(ON_SPHERE(corner, 4, 1.0), &area));
        CHECK_NEAR(area, -want, within);
    }
}

THEOREM(the_area_on_a_sphere_does_not_depend_on_the_first_corner)
{
    chance c = {seed(14)};
    double xy[2 * MOST], xyz[3 * MOST], moved[3 * MOST], area, again;
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, 20), start;
        random_star(&c, n, xy);
        onto_sphere(xy, n, between(&c, 0.1, 100), xyz); /* up to the whole hemisphere */
        turn_somehow(&c, xyz, n);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_area(ON_SPHERE(xyz, n, 1.0), &area));
        for (start = 1; start < n; ++start) {
            start_at(start, xyz, n, 3, moved);
            CHECK_OK(surfmink_area(ON_SPHERE(moved, n, 1.0), &again));
            CHECK_NEAR(again, area, 2e-14);
        }
    }
}

THEOREM(of_two_sides_the_smaller_one_is_told_with_its_sign)
{
    /* Round the north pole at 105 to 115 degrees from it, with a notch that reaches almost to the pole: so all
       corners are near the first one, and there is more than a hemisphere to the left. */
    chance c = {seed(24)};
    double corner[3 * 20], length[20], turning[20], area;
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 10 + one_of(&c, 10), i;
        double left = 2 * PI;
        for (i = 0; i < n; ++i) {
            double lat = i == 0 ? between(&c, 70, 85) : between(&c, -25, -15);
            CHECK_OK(surfmink_from_lonlat(360 * (double)i / (double)n, lat, 1.0, corner + 3 * i));
        }
        turn_somehow(&c, corner, n);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(ON_SPHERE(corner, n, 1.0), length, turning, NULL));
        for (i = 0; i < n; ++i) left -= turning[i];
        CHECK(left > 2 * PI);
        CHECK_OK(surfmink_area(ON_SPHERE(corner, n, 1.0), &area));
        CHECK_CLOSE(area, left - 4 * PI, 1e-14);
        surfmink_reverse(corner, n, 3);
        CHECK_OK(surfmink_area(ON_SPHERE(corner, n, 1.0), &area));
        CHECK_CLOSE(area, 4 * PI - left, 1e-14);
    }
}

THEOREM(a_hemisphere_has_half_the_sphere_on_either_side)
{
    static const double equator[12] = {1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    double area;
    CHECK_OK(surfmink_area(ON_SPHERE(equator, 4, 2.0), &area));
    CHECK_CLOSE(fabs(area), 2 * PI * 4, 1e-15);
}

/* --- areas in space ----------------------------------------------------------------------------------------------- */

/* Area of the chart within a circle of radius h about (u, v), by the rule of 64 angles and 8 Gaussian radii. */
static double disk_area(const chart *m, double u, double v, double h)
{
    static const double node[4] = {0.18343464249564980494, 0.52553240991632898582, 0.79666647741362673959,
                                   0.96028985649753623168};
    static const double weight[4] = {0.36268378337836198297, 0.31370664587788728734, 0.22238103445337447054,
                                     0.10122853629037625915};
    double sum = 0;
    int i, k;
    for (i = 0; i < 64; ++i)
        for (k = 0; k < 8; ++k) {
            double r = h / 2 * (1 + (k % 2 ? node[k / 2] : -node[k / 2])), t = 2 * PI * i / 64;
            double x[3], normal[3], du[3], dv[3], cross[3];
            chart_point(m, u + r * cos(t), v + r * sin(t), x, normal, du, dv);
            cross3(du, dv, cross);
            sum += weight[k / 2] * h / 2 * (2 * PI / 64) * r * sqrt(dot3(cross, cross));
        }
    return sum;
}

/* Paper 2.2: W_0, where corners and normals are all that is known. Errors fall at least fourfold when the outline is
   half as large, down to what 2,000 chords leave out of a smooth curve. */
THEOREM(areas_in_space_are_of_second_order_in_the_size)
{
    static const chart surface[3] = {{ELLIPSOID, 1, 1, 1}, {ELLIPSOID, 1.6, 1.3, 1}, {TORUS, 2, 0.8, 0}};
    enum { N = 2000 };
    static double corner[3 * N], normal[3 * N];
    int kind, at, i;
    for (kind = 0; kind < 3; ++kind)
        for (at = 0; at < 6; ++at) {
            double h, last = 1, u = 0.9 + 0.25 * at, v = 0.5 + at;
            for (h = 0.4; h > 0.02; h /= 2) {
                double area = 0, off;
                for (i = 0; i < N; ++i)
                    chart_point(&surface[kind], u + h * cos(2 * PI * i / N), v + h * sin(2 * PI * i / N),
                                corner + 3 * i, normal + 3 * i, NULL, NULL);
                CASE("surface %d, place %d, radius %g", kind, at, h);
                CHECK_OK(surfmink_area(IN_SPACE(corner, normal, N), &area));
                off = fabs(area / disk_area(&surface[kind], u, v, h) - 1);
                CHECK(off < last / 4 || off < 5e-6);
                CHECK(off < h * h / 4);
                last = off;
            }
        }
}

/* A strip round a cylinder, from -110 to 110 degrees: the normals at its ends lean away from the mean of all, and its
   area is positive all the same, whichever corner comes first. And a line there and back has none. */
THEOREM(an_area_in_space_is_on_the_side_of_most_normals)
{
    enum { SIDE = 45, CORNERS = 2 * SIDE };
    static const double line[12] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 0, 0}, up[12] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    double corner[3 * CORNERS], normal[3 * CORNERS], moved[3 * CORNERS], turned[3 * CORNERS], area, first = 0;
    size_t i;
    for (i = 0; i < CORNERS; ++i) {
        double t = (-110 + 5 * (double)(i < SIDE ? i : CORNERS - 1 - i)) * PI / 180, *n = normal + 3 * i;
        n[0] = sin(t), n[1] = 0, n[2] = cos(t);
        corner[3 * i] = n[0], corner[3 * i + 1] = i < SIDE ? -0.1 : 0.1, corner[3 * i + 2] = n[2];
    }
    for (i = 0; i < CORNERS; ++i) {
        start_at(i, corner, CORNERS, 3, moved);
        start_at(i, normal, CORNERS, 3, turned);
        CASE("from corner %d", (int)i);
        CHECK_OK(surfmink_area(IN_SPACE(moved, turned, CORNERS), &area));
        if (i == 0) first = area;
        CHECK_CLOSE(area, first, 1e-13);
    }
    CHECK_CLOSE(first, 0.2 * 220 * PI / 180, 0.25); /* an estimate: so long a strip is no disc */
    CHECK_OK(surfmink_area(IN_SPACE(line, up, 4), &area));
    CHECK_NEAR(area, 0, 0);
}

THEOREM(polygons_of_the_sphere_have_their_area_in_space_too)
{
    chance c = {seed(25)};
    double xy[2 * MOST], xyz[3 * MOST], area[2];
    int trial;
    for (trial = 0; trial < 1000; ++trial) {
        size_t n = 3 + one_of(&c, 20);
        double size = between(&c, 0.01, 0.6), radius = between(&c, 0.5, 2);
        size_t i;
        gentle_star(&c, n, xy);
        onto_sphere(xy, n, size, xyz);
        turn_somehow(&c, xyz, n);
        for (i = 0; i < 3 * n; ++i) xyz[i] *= radius;
        CASE("trial %d, %d corners, size %g", trial, (int)n, size);
        CHECK_OK(surfmink_area(ON_SPHERE(xyz, n, radius), &area[0]));
        CHECK_OK(surfmink_area(IN_SPACE(xyz, xyz, n), &area[1]));
        CHECK_CLOSE(area[1], area[0], 0.03 * size * size); /* which is below 1e-3 up to a radius of 10 degrees */
    }
}

/* A band that is wound up and almost touches itself: its area is small beside the squares of its size. */
THEOREM(thin_meanders_of_a_sphere_keep_the_digits_of_their_area)
{
    enum { TURNS = 40 };
    static double xy[2 * 4 * TURNS], xyz[3 * 4 * TURNS];
    double width, flat, area = 0, half;
    size_t i, n;
    for (width = 1e-2; width > 1e-13; width /= 10) {
        for (i = 0; i < TURNS; ++i) { /* up and down, then back beside it; so small that the map is flat */
            double x = (double)i / TURNS, y = i % 2 ? 1 : 0;
            size_t j = 2 * TURNS - 1 - i;
            xy[2 * i] = x * 1e-9, xy[2 * i + 1] = y * 1e-9;
            xy[2 * j] = x * 1e-9, xy[2 * j + 1] = (y + width) * 1e-9;
        }
        n = 2 * TURNS;
        for (half = 0, i = 0; i < n; ++i) {
            const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % n);
            xyz[3 * i] = a[0], xyz[3 * i + 1] = a[1], xyz[3 * i + 2] = 1;
            half += hypot(a[0] - xy[0], a[1] - xy[1]) * hypot(b[0] - a[0], b[1] - a[1]) / 2;
        }
        CASE("width %g", width);
        CHECK_OK(surfmink_area(IN_PLANE(xy, n), &flat));
        CHECK_OK(surfmink_area(ON_SPHERE(xyz, n, 1.0), &area));
        CHECK_NEAR(area, flat, 2 * 2e-15 * half);
    }
}

/* --- outlines that are drawn wrong as a whole --------------------------------------------------------------------- */

THEOREM(reversal_negates_every_turn)
{
    chance c = {seed(15)};
    double xyz[3 * MOST], normal[3 * MOST], length[2][MOST], turning[2][MOST];
    static const chart ellipsoid = {ELLIPSOID, 1.6, 1.3, 1.0};
    surfmink_functionals w;
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, 20), i, bad;
        star_on_chart(&c, &ellipsoid, between(&c, 1, 2), between(&c, 0, 6), 0.4, n, xyz, normal);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_SPACE(xyz, normal, n), length[0], turning[0], NULL));
        CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), 0, NULL, NULL, &w, NULL));
        surfmink_reverse(xyz, n, 3);
        surfmink_reverse(normal, n, 3);
        CHECK_OK(surfmink_edges(IN_SPACE(xyz, normal, n), length[1], turning[1], NULL));
        for (i = 0; i < n; ++i) {
            CHECK_CLOSE(length[1][i], length[0][n - 1 - (i + 1) % n], 1e-15);
            CHECK_ANGLE(turning[1][i], -turning[0][n - 1 - i], 1e-15);
        }
        CHECK_STATUS(surfmink_measure(IN_SPACE(xyz, normal, n), 0, NULL, NULL, &w, &bad), SURFMINK_CLOCKWISE);
        CHECK_EQUAL(bad, n);
        for (i = 0; i < 3 * n; ++i) normal[i] = -normal[i]; /* seen from inside the same corners are right again */
        CHECK_OK(surfmink_measure(IN_SPACE(xyz, normal, n), 0, NULL, NULL, &w, NULL));
    }
}

/* Draws a polygon of the plane, and the same one on the sphere about the pole, and says what becomes of either. */
static void both_say(const double *xy, size_t n, int status)
{
    double xyz[3 * MOST];
    size_t bad = 99;
    surfmink_functionals w;
    CHECK_STATUS(surfmink_measure(IN_PLANE(xy, n), 2, NULL, NULL, &w, &bad), status);
    CHECK_EQUAL(bad, status == SURFMINK_OK ? 99 : n);
    onto_sphere(xy, n, 0.3, xyz);
    CHECK_STATUS(surfmink_measure(ON_SPHERE(xyz, n, 1.0), 2, NULL, NULL, &w, NULL), status);
    onto_sphere(xy, n, 1e-6, xyz);
    CHECK_STATUS(surfmink_measure(ON_SPHERE(xyz, n, 1.0), 2, NULL, NULL, &w, NULL), status);
}

THEOREM(turning_and_area_tell_an_outline_that_crosses_itself)
{
    static const double square[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
    static const double bow_tie[8] = {-1, -1, 1, 1, 1, -1, -1, 1};
    static const double eight[16] = {0, 0, 1, -1, 2, 0, 1, 1, -0.01, 0, -1, -1, -2, 0, -1, 1};
    double loops[2 * MOST];
    size_t i;
    both_say(square, 4, SURFMINK_OK);
    both_say(bow_tie, 4, SURFMINK_CROSSES_ITSELF);
    both_say(eight, 8, SURFMINK_CROSSES_ITSELF);
    for (i = 0; i < 15; ++i) { /* a spiral that goes round twice and closes, then three times */
        loops[2 * i] = (1 + 0.02 * (double)i) * cos(2 * 2 * PI * (double)i / 15);
        loops[2 * i + 1] = (1 + 0.02 * (double)i) * sin(2 * 2 * PI * (double)i / 15);
    }
    CASE("twice");
    both_say(loops, 15, SURFMINK_CROSSES_ITSELF);
    for (i = 0; i < 20; ++i) {
        loops[2 * i] = (1 + 0.02 * (double)i) * cos(3 * 2 * PI * (double)i / 20);
        loops[2 * i + 1] = (1 + 0.02 * (double)i) * sin(3 * 2 * PI * (double)i / 20);
    }
    CASE("three times");
    both_say(loops, 20, SURFMINK_CROSSES_ITSELF);
    CASE("five-pointed star");
    for (i = 0; i < 5; ++i) {
        loops[2 * i] = cos(2 * 2 * PI * (double)i / 5);
        loops[2 * i + 1] = sin(2 * 2 * PI * (double)i / 5);
    }
    both_say(loops, 5, SURFMINK_CROSSES_ITSELF);
}

/* Accepted by 0.3.0: S is 2 pi, or what is left of it, and the area negative; or what is said depended on the first
   corner, for the checks were skipped where the fan of triangles met an antipode. */
THEOREM(turning_and_area_agree_or_the_outline_is_refused)
{
    static const double knot[10] = {1, 0, 1, 6, 0, 6, 6, 4, 0, 0}; /* S = 2 pi, area -12 */
    static const double cube[24] = {-1, -1, 1, 1, -1, -1, 1, 1, 1, 1, -1, 1, 1, 1, -1, -1, -1, -1, -1, 1, 1, -1, 1, -1};
    double cut[48], moved[48], xy[2 * MOST], area;
    surfmink_functionals w;
    chance c = {seed(27)};
    size_t i, k, start;
    int trial, measured = 0, crossing = 0;
    both_say(knot, 5, SURFMINK_CROSSES_ITSELF);
    CHECK_OK(surfmink_area(IN_PLANE(knot, 5), &area));
    CHECK_NEAR(area, -12, 0);
    for (i = 0; i < 8; ++i)
        for (k = 0; k < 3; ++k) { /* a point at 0.3 of each edge changes nothing */
            cut[6 * i + k] = cube[3 * i + k];
            cut[6 * i + 3 + k] = 0.7 * cube[3 * i + k] + 0.3 * cube[3 * ((i + 1) % 8) + k];
        }
    for (start = 0; start < 16; ++start) {
        CASE("round the cube, first corner %d", (int)start);
        start_at(start, cut, 16, 3, moved);
        CHECK_STATUS(surfmink_measure(ON_SPHERE(moved, 16, 1.0), 2, NULL, NULL, &w, NULL), SURFMINK_CROSSES_ITSELF);
        if (start >= 8) continue;
        start_at(start, cube, 8, 3, moved);
        CHECK_STATUS(surfmink_measure(ON_SPHERE(moved, 8, 1.0), 2, NULL, NULL, &w, NULL), SURFMINK_CROSSES_ITSELF);
    }
    for (trial = 0; trial < 4000; ++trial) { /* corners exchanged, or anywhere: whatever is accepted is consistent */
        size_t n = 4 + one_of(&c, 8), status;
        double xyz[3 * MOST], swap;
        gentle_star(&c, n, xy);
        i = one_of(&c, n);
        k = one_of(&c, n);
        for (start = 0; start < 2; ++start)
            swap = xy[2 * i + start], xy[2 * i + start] = xy[2 * k + start], xy[2 * k + start] = swap;
        if (trial % 2) surfmink_reverse(xy, n, 2);
        CASE("trial %d", trial);
        status = (size_t)surfmink_measure(IN_PLANE(xy, n), 2, NULL, NULL, &w, NULL);
        if (status == SURFMINK_OK) CHECK(w.turning == 2 * PI && w.area > 0);
        if (status == SURFMINK_OK) ++measured;
        if (status == SURFMINK_CROSSES_ITSELF) ++crossing;
        onto_sphere(xy, n, between(&c, 0.1, 1), xyz);
        if (surfmink_measure(ON_SPHERE(xyz, n, 1.0), 2, NULL, NULL, &w, NULL)) continue;
        CHECK_NEAR(w.turning + w.area, 2 * PI, 2e-15);
        CHECK(w.area > 0 && w.turning > 0);
    }
    CASE("%d measured, %d cross themselves", measured, crossing);
    CHECK(measured > 200 && crossing > 1000);
}

THEOREM(clockwise_outlines_are_refused)
{
    chance c = {seed(16)};
    double xy[2 * MOST];
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, 20);
        random_star(&c, n, xy);
        CASE("trial %d", trial);
        both_say(xy, n, SURFMINK_OK);
        surfmink_reverse(xy, n, 2);
        both_say(xy, n, SURFMINK_CLOCKWISE);
    }
}

THEOREM(more_than_a_hemisphere_is_clockwise)
{
    chance c = {seed(17)};
    double corner[3 * MOST], latitude;
    surfmink_functionals w;
    size_t n, i;
    for (n = 3; n < 40; ++n)
        for (latitude = -0.5; latitude < 1; latitude += 0.5) {
            for (i = 0; i < n; ++i)
                CHECK_OK(surfmink_from_lonlat(360.0 * (double)i / (double)n, latitude, 1.0, corner + 3 * i));
            turn_somehow(&c, corner, n);
            CASE("%d corners at latitude %g", (int)n, latitude);
            CHECK_STATUS(surfmink_measure(ON_SPHERE(corner, n, 1.0), 2, NULL, NULL, &w, NULL),
                         latitude < 0   ? SURFMINK_CLOCKWISE
                         : latitude > 0 ? SURFMINK_OK
                                        : SURFMINK_TOO_MUCH_CURVATURE);
            CHECK_STATUS(surfmink_measure(IN_SPACE(corner, corner, n), 2, NULL, NULL, &w, NULL),
                         n == 3         ? SURFMINK_OPPOSITE_NORMALS
                         : latitude < 0 ? SURFMINK_CLOCKWISE
                         : latitude > 0 ? SURFMINK_OK
                                        : SURFMINK_TOO_MUCH_CURVATURE);
        }
}

/* --- spikes ------------------------------------------------------------------------------------------------------- */

THEOREM(a_whisker_out_is_measured_and_one_in_refused)
{
    /* A square whose corner 2 grows a hair and comes back: the turn at the tip of the hair is pi. */
    double corner[12] = {-1, -1, 1, -1, 1, 1, 2, 2, 1, 1, -1, 1}, length[6], turning[6], mu[5];
    surfmink_functionals w;
    CHECK_OK(surfmink_edges(IN_PLANE(corner, 6), length, turning, NULL));
    CHECK_NEAR(turning[3], PI, 0);
    CHECK_OK(surfmink_measure(IN_PLANE(corner, 6), 4, mu, NULL, &w, NULL));
    CHECK_NEAR(w.turning, 2 * PI, 1e-15);
    CHECK_NEAR(w.area, 4, 0);
    /* Four sides of length 2 have z^4 = 1, the two of the hair, sqrt 2 each, z^4 = -1. */
    CHECK_CLOSE(mu[4], (8 - 2 * sqrt(2)) / (8 + 2 * sqrt(2)), 1e-15);
    both_say(corner, 6, SURFMINK_OK);
    corner[6] = corner[7] = 0.5;
    both_say(corner, 6, SURFMINK_CROSSES_ITSELF);
}

THEOREM(a_whisker_turns_by_plus_pi_wherever_it_points)
{
    /* There and back again, exactly: the sine of that turn is a zero whose sign depends on the direction and on the
       normal. */
    static const double square[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
    chance c = {seed(19)};
    double xy[12], xyz[18], length[6], turning[6], radius = 1;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    surfmink_functionals w;
    int trial;
    for (trial = 0; trial < 500; ++trial) {
        size_t i;
        memcpy(xy, square, sizeof square);
        xy[8] = xy[4], xy[9] = xy[5], xy[10] = xy[6], xy[11] = xy[7];
        xy[6] = between(&c, 1.1, 3), xy[7] = between(&c, 1.1, 3);
        onto_sphere(xy, 6, 0.3, xyz);
        if (trial < 8)
            for (i = 0; i < 18; ++i) xyz[i] *= trial >> i % 3 & 1 ? -1 : 1; /* the eight octants, mirrored as need be */
        else
            turn_somehow(&c, xyz, 6);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(xy, 6), length, turning, NULL));
        CHECK_NEAR(turning[3], PI, 0);
        CHECK_OK(surfmink_edges(ON_SPHERE(xyz, 6, 1.0), length, turning, NULL));
        CHECK_NEAR(turning[3], PI, 0);
        CHECK_OK(surfmink_edges(IN_SPACE(xyz, xyz, 6), length, turning, NULL));
        CHECK_NEAR(turning[3], PI, 0);
        CHECK_OK(surfmink_edges(ON_SURFACE(&sphere, xyz, 6), length, turning, NULL));
        CHECK_NEAR(turning[3], PI, 0);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, 6), 2, NULL, NULL, &w, NULL));
        if (trial >= 8) CHECK_OK(surfmink_measure(ON_SPHERE(xyz, 6, 1.0), 2, NULL, NULL, &w, NULL));
    }
}

THEOREM(a_notch_is_no_spike_however_thin)
{
    double corner[14] = {-1, -1, 1, -1, 1, 1, 0, 1, 0, 0, 0, 1, -1, 1}, length[7], turning[7], width;
    surfmink_functionals w;
    for (width = 0.1; width > 4e-15; width /= 3) {
        corner[6] = width, corner[10] = -width;
        CASE("width %g", width);
        CHECK_OK(surfmink_edges(IN_PLANE(corner, 7), length, turning, NULL));
        CHECK_NEAR(turning[4], 2 * atan(width) - PI, 5e-16);
        CHECK_OK(surfmink_measure(IN_PLANE(corner, 7), 2, NULL, NULL, &w, NULL));
        CHECK_NEAR(w.turning, 2 * PI, 2e-15);
        CHECK_NEAR(w.area, 4 - width, 2e-15);
    }
}

THEOREM(every_output_of_the_easy_calls_may_be_left_out)
{
    static const double octant[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0}, triangle[6] = {0, 0, 4, 0, 4, 3};
    double radius = 1, mu[4], g[8], only_mu[4], only_g[8];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    surfmink_functionals w;
    CHECK_OK(surfmink_measure(IN_PLANE(triangle, 3), 3, NULL, NULL, NULL, NULL));
    CHECK_OK(surfmink_measure(ON_SPHERE(octant, 3, 1.0), 3, NULL, NULL, NULL, NULL));
    CHECK_OK(surfmink_measure(IN_SPACE(octant, octant, 3), 3, NULL, NULL, NULL, NULL));
    CHECK_OK(surfmink_measure(ON_SURFACE(&sphere, octant, 3), 3, NULL, NULL, NULL, NULL));
    CHECK_OK(surfmink_measure(IN_PLANE(triangle, 3), 3, mu, g, &w, NULL));
    CHECK_OK(surfmink_measure(IN_PLANE(triangle, 3), 3, only_mu, NULL, NULL, NULL));
    CHECK_OK(surfmink_measure(IN_PLANE(triangle, 3), 3, NULL, only_g, NULL, NULL));
    CHECK_SAME(only_mu, mu, 4);
    CHECK_SAME(only_g, g, 8);
}

int main(void)
{
    PROVE(edge_i_leaves_corner_i_and_turning_i_is_the_turn_at_corner_i);
    PROVE(a_turn_to_the_inside_is_positive_and_a_dent_is_negative);
    PROVE(the_octant_of_a_sphere_has_three_right_angles);
    PROVE(nearly_straight_corners_keep_all_digits_of_their_turn);
    PROVE(in_the_plane_a_turn_is_the_difference_of_two_edge_directions);
    PROVE(on_the_sphere_edges_are_great_circles);
    PROVE(the_sphere_is_embedded_with_its_corners_as_normals);
    PROVE(only_the_part_of_an_edge_along_the_surface_turns);
    PROVE(edges_may_be_steep_without_loss);
    PROVE(turning_angles_do_not_see_the_frames_of_the_callbacks);
    PROVE(the_sphere_by_callbacks_is_the_sphere);
    PROVE(on_the_sphere_only_the_direction_of_a_corner_counts);
    PROVE(the_functionals_are_area_length_and_total_turning);
    PROVE(the_total_turn_is_two_pi_in_the_plane);
    PROVE(the_total_turn_is_two_pi_minus_the_area_on_the_unit_sphere);
    PROVE(the_hyperbolic_turn_is_two_pi_plus_the_area);
    PROVE(far_away_squares_keep_their_area_and_every_other_digit);
    PROVE(the_area_of_a_plane_polygon_is_the_sum_of_its_triangles);
    PROVE(tiny_cells_of_a_sphere_have_the_area_of_their_map);
    PROVE(a_lune_through_both_poles_has_its_share_of_the_sphere);
    PROVE(the_area_on_a_sphere_does_not_depend_on_the_first_corner);
    PROVE(of_two_sides_the_smaller_one_is_told_with_its_sign);
    PROVE(a_hemisphere_has_half_the_sphere_on_either_side);
    PROVE(areas_in_space_are_of_second_order_in_the_size);
    PROVE(an_area_in_space_is_on_the_side_of_most_normals);
    PROVE(polygons_of_the_sphere_have_their_area_in_space_too);
    PROVE(thin_meanders_of_a_sphere_keep_the_digits_of_their_area);
    PROVE(reversal_negates_every_turn);
    PROVE(turning_and_area_tell_an_outline_that_crosses_itself);
    PROVE(turning_and_area_agree_or_the_outline_is_refused);
    PROVE(clockwise_outlines_are_refused);
    PROVE(more_than_a_hemisphere_is_clockwise);
    PROVE(a_whisker_out_is_measured_and_one_in_refused);
    PROVE(a_whisker_turns_by_plus_pi_wherever_it_points);
    PROVE(a_notch_is_no_spike_however_thin);
    PROVE(every_output_of_the_easy_calls_may_be_left_out);
    return QED();
}
