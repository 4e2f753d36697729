/* Surfaces that are not in the header: smooth implicit surfaces (ellipsoid, torus) and the hyperbolic plane.
   cc -I. tests/test_surfaces.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "examples/surfaces/ellipsoid.h"
#include "examples/surfaces/hyperbolic.h"
#include "examples/surfaces/torus.h"

#include "harness.h"
#include "shapes.h"
#include "table.h"

#define STRIDE (1 + (FEWER > 100 ? 11 : 0))

static double norm3(const double *a)
{
    return sqrt(dot3(a, a));
}

static double distance3(const double *a, const double *b)
{
    double d[3];
    int k;
    for (k = 0; k < 3; ++k) d[k] = b[k] - a[k];
    return norm3(d);
}

/* A direction of the frame at x as a vector in space. */
static void in_space(const surfmink_implicit *surface, const double *x, const double *direction, double *vector)
{
    double frame[9];
    int k;
    CHECK_OK(surfmink_implicit_frame(surface, x, frame));
    for (k = 0; k < 3; ++k) vector[k] = direction[0] * frame[k] + direction[1] * frame[3 + k];
}

/* Random surfaces: `bent` 0 nearly round, 1 bent, 2 strongly bent (axes up to 1 : 10, a torus with a hole of a
   tenth). */
static surfmink_implicit random_surface(chance *c, int bent, double *shape)
{
    static const double stretch[3] = {1.5, 3, 10}, tube[3] = {0.3, 0.6, 0.9};
    int k;
    if (one_of(c, 2)) {
        shape[0] = between(c, 1, 2);
        shape[1] = tube[bent] * shape[0];
        return surfmink_torus(shape);
    }
    for (k = 0; k < 3; ++k) shape[k] = pow(stretch[bent], between(c, 0, 1));
    return surfmink_ellipsoid(shape);
}

static void random_point(chance *c, const surfmink_implicit *surface, double *x)
{
    const double *shape = (const double *)surface->shape;
    double u = between(c, 0.1, PI - 0.1), v = between(c, -PI, PI);
    if (surface->f == surfmink_torus_f)
        surfmink_torus_point(shape, 2 * u, v, x);
    else
        surfmink_ellipsoid_point(shape, u, v, x);
}

/* Shorter geodesics than this are the only shortest ones on a random surface: less than pi / sqrt(max K), and less than
   half of the shortest loop of a torus. */
static double safe_length(const surfmink_implicit *surface)
{
    const double *s = (const double *)surface->shape;
    double longest;
    if (surface->f == surfmink_torus_f) return 0.9 * PI * fmin(s[0] - s[1], s[1]);
    longest = fmax(s[0], fmax(s[1], s[2])); /* at its end K = longest^2 / (the other two)^2 is greatest */
    return 0.9 * PI * s[0] * s[1] * s[2] / (longest * longest);
}

/* --- normals and curvature ---------------------------------------------------------------------------------------- */

THEOREM(normals_and_curvature_have_their_closed_forms)
{
    chance c = {seed(11)};
    int trial, k;
    for (trial = 0; trial < 300; ++trial) {
        double shape[3], x[3], normal[3], want[3], frame[9], curvature = 0, known;
        double u = between(&c, 0, PI), v = between(&c, -PI, PI);
        chart m;
        surfmink_implicit surface = random_surface(&c, (int)one_of(&c, 3), shape);
        CASE("trial %d", trial);
        m.a = shape[0], m.b = shape[1], m.c = shape[2];
        if (surface.f == surfmink_torus_f) {
            m.kind = TORUS;
            surfmink_torus_point(shape, u, v, x);
            known = cos(v) / (shape[1] * (shape[0] + shape[1] * cos(v)));
        } else {
            m.kind = ELLIPSOID;
            surfmink_ellipsoid_point(shape, u, v, x);
            for (known = 0, k = 0; k < 3; ++k) known += pow(x[k] / (shape[k] * shape[k]), 2);
            known = 1 / pow(shape[0] * shape[1] * shape[2] * known, 2);
        }
        CHECK_OK(surfmink_implicit_curvature(&surface, x, &curvature));
        CHECK_NEAR(curvature, known, 1e-13 * (fabs(known) + 1 / (shape[0] * shape[0])));
        chart_point(&m, u, v, want, normal, NULL, NULL);
        for (k = 0; k < 3; ++k) CHECK_NEAR(x[k], want[k], 1e-15 * norm3(x));
        for (k = 0; k < 3; ++k) want[k] = normal[k] / norm3(normal);
        CHECK_OK(surfmink_implicit_normal(&surface, x, normal));
        for (k = 0; k < 3; ++k) CHECK_NEAR(normal[k], want[k], 3e-15);
        CHECK_OK(surfmink_implicit_frame(&surface, x, frame));
        cross3(frame, frame + 3, want);
        for (k = 0; k < 3; ++k) CHECK_NEAR(want[k], normal[k], 1e-15);
        CHECK_NEAR(norm3(frame), 1, 1e-15);
        CHECK_NEAR(norm3(frame + 3), 1, 1e-15);
    }
}

/* --- geodesics with closed forms ---------------------------------------------------------------------------------- */

THEOREM(with_equal_axes_exp_and_log_are_those_of_the_sphere)
{
    chance c = {seed(12)};
    int trial, k;
    for (trial = 0; trial < 600; trial += STRIDE) {
        double radius = trial % 3 == 0   ? 1
                        : trial % 3 == 1 ? 6371.0
                                         : 1e-6,
               axis[3], x[3], y[3], z[3], vector[3], want[3];
        double length = 0, direction[2], angle = between(&c, -PI, PI);
        double reach = trial % 2 ? between(&c, 0.01, 3.1) : pow(10, between(&c, -12, 0));
        surfmink_implicit sphere = surfmink_ellipsoid(axis);
        axis[0] = axis[1] = axis[2] = radius;
        CASE("trial %d: radius %g, angle %g", trial, radius, reach);
        random_point(&c, &sphere, x);
        direction[0] = cos(angle);
        direction[1] = sin(angle);
        in_space(&sphere, x, direction, vector);
        for (k = 0; k < 3; ++k) vector[k] *= reach * radius;
        CHECK_OK(surfmink_sphere_exp(x, vector, radius, y));
        CHECK_OK(surfmink_implicit_log(&sphere, x, y, &length, direction));
        CHECK_OK(surfmink_sphere_log(x, y, radius, want));
        CHECK_CLOSE(length, norm3(want), 1e-14);
        in_space(&sphere, x, direction, z);
        /* the angle is as good as the coordinates of y, which round, are seen from x */
        for (k = 0; k < 3; ++k) CHECK_NEAR(z[k], want[k] / norm3(want), 1e-15 + 2e-15 / sin(reach) * (reach > 1));
        CHECK_OK(surfmink_implicit_exp(&sphere, x, direction, length, z));
        CHECK_NEAR(distance3(z, y), 0, 2e-15 * radius);
    }
}

/* The quarter of an ellipse with semi-axes a, b: the trapezoidal rule is exact for periodic functions. */
static double quarter_ellipse(double a, double b)
{
    double sum = 0;
    int i;
    for (i = 0; i < 2000; ++i) sum += hypot(a * cos(PI * (i + 0.5) / 1000), b * sin(PI * (i + 0.5) / 1000));
    return sum * PI / 4000;
}

THEOREM(principal_sections_of_an_ellipsoid_are_geodesics)
{
    double axis[3] = {1.6, 1.3, 1.0}, flat[3] = {1, 3, 0.4};
    double *both[2] = {axis, flat};
    int which, i, k;
    for (which = 0; which < 2; ++which)
        for (i = 0; i < 3; ++i) {
            surfmink_implicit body = surfmink_ellipsoid(both[which]);
            int j = (i + 1) % 3;
            double x[3] = {0, 0, 0}, y[3] = {0, 0, 0}, end[3], frame[9], direction[2];
            double quarter = quarter_ellipse(both[which][i], both[which][j]);
            CASE("ellipsoid %d, axes %d and %d", which, i, j);
            x[i] = both[which][i];
            y[j] = both[which][j];
            CHECK_OK(surfmink_implicit_frame(&body, x, frame));
            direction[0] = frame[j]; /* towards axis j */
            direction[1] = frame[3 + j];
            CHECK_OK(surfmink_implicit_exp(&body, x, direction, quarter, end));
            for (k = 0; k < 3; ++k) CHECK_NEAR(end[k], y[k], 1e-14);
            CHECK_OK(surfmink_implicit_exp(&body, x, direction, 4 * quarter, end)); /* all the way round */
            for (k = 0; k < 3; ++k) CHECK_NEAR(end[k], x[k], 1e-13);
            CHECK_OK(surfmink_implicit_exp(&body, x, direction, -3 * quarter, end)); /* and backwards */
            for (k = 0; k < 3; ++k) CHECK_NEAR(end[k], y[k], 1e-13);
        }
}

/* Position and velocity at several lengths along one geodesic; the velocity is the direction of the log to a point a
   bit further on. */
static void follow(const surfmink_implicit *surface, const double *x, const double *direction, double s, double ahead,
                   double *point, double *velocity)
{
    double next[3], length, along[2];
    CHECK_OK(surfmink_implicit_exp(surface, x, direction, s, point));
    CHECK_OK(surfmink_implicit_exp(surface, x, direction, s + ahead, next));
    CHECK_OK(surfmink_implicit_log(surface, point, next, &length, along));
    CHECK_CLOSE(length, ahead, 1e-12);
    in_space(surface, point, along, velocity);
}

/* Clairaut: on a surface of revolution, distance from the axis times the sine of the angle to the meridian is
   constant. */
THEOREM(clairauts_relation_holds_on_the_torus_and_on_spheroids)
{
    chance c = {seed(13)};
    int trial, i;
    for (trial = 0; trial < 60; ++trial) {
        double shape[3], x[3], point[3], velocity[3], first = 0, angle = between(&c, -PI, PI), direction[2];
        surfmink_implicit surface;
        shape[0] = 1;
        shape[1] = trial % 3 ? 1 : between(&c, 0.2, 0.9); /* torus, or equal axes */
        shape[2] = trial % 3 == 1 ? between(&c, 0.3, 0.99) : between(&c, 1.01, 3);
        surface = trial % 3 ? surfmink_ellipsoid(shape) : surfmink_torus(shape);
        random_point(&c, &surface, x);
        direction[0] = cos(angle);
        direction[1] = sin(angle);
        CASE("trial %d", trial);
        /* Inside a torus two geodesics part as exp(s / sqrt(r (R - r))), and so do the two ends that are asked for. */
        for (i = 0; i < 6; ++i) {
            double part = trial % 3 ? 0 : 1 / sqrt(shape[1] * (1 - shape[1])), constant, s = i * between(&c, 0, 1);
            follow(&surface, x, direction, s, 0.15, point, velocity);
            constant = point[0] * velocity[1] - point[1] * velocity[0];
            if (i == 0) first = constant;
            CHECK_NEAR(constant, first, 1e-13 + 1e-16 * exp(part * s));
        }
    }
}

/* Joachimsthal: on any ellipsoid, (sum x^2/a^4) (sum v^2/a^2) is constant along a geodesic. */
THEOREM(joachimsthals_constant_holds_on_ellipsoids_with_three_axes)
{
    chance c = {seed(14)};
    int trial, i, k;
    for (trial = 0; trial < 60; ++trial) {
        double axis[3], x[3], point[3], velocity[3], first = 0, angle = between(&c, -PI, PI), direction[2];
        surfmink_implicit body = surfmink_ellipsoid(axis);
        for (k = 0; k < 3; ++k) axis[k] = pow(trial % 2 ? 2 : 8, between(&c, 0, 1));
        random_point(&c, &body, x);
        direction[0] = cos(angle);
        direction[1] = sin(angle);
        CASE("trial %d: axes %g %g %g", trial, axis[0], axis[1], axis[2]);
        for (i = 0; i < 6; ++i) {
            double p = 0, d = 0;
            follow(&body, x, direction, i * between(&c, 0, 1), 0.15, point, velocity);
            for (k = 0; k < 3; ++k) {
                p += pow(point[k] / (axis[k] * axis[k]), 2);
                d += pow(velocity[k] / axis[k], 2);
            }
            if (i == 0) first = p * d;
            CHECK_CLOSE(p * d, first, trial % 2 ? 1e-13 : 1e-12);
        }
    }
}

/* Karney, Algorithms for geodesics (2013), whose test set was computed with extended precision: latitude, longitude and
   azimuth at both ends in degrees, and metres between. */
THEOREM(distances_on_the_earth_are_those_of_karneys_test_set)
{
    static const double known[6][7] = {
        {35.60777, -139.44815, 111.098748429560326, -11.17491, -69.95921, 129.289270889708762, 8935244.5604818305},
        {55.52454, 106.05087, 22.020059880982801, 77.03196, 197.18234, 109.112041110671519, 4105086.1713924406},
        {-21.97856, 142.59065, -32.44456876433189, 41.84138, 98.56635, -41.84359951440466, 8394328.894657671},
        {-66.99028, 112.2363, 173.73491240878403, -12.70631, 285.90344, 2.512956620913668, 11150344.2312080241},
        {-17.42761, 173.34268, -159.033557661192928, -15.84784, 5.93557, -20.787484651536988, 16076603.1631180673},
        {32.84994, 48.28919, 150.492927788121982, -56.28556, 202.29132, 48.113449399816759, 16727068.9438164461},
    };
    const double a = 6378137, f = 1 / 298.257223563, square = f * (2 - f), degree = PI / 180;
    double axis[3] = {0, 0, 0};
    surfmink_implicit earth = surfmink_ellipsoid(axis);
    int i, end;
    axis[0] = axis[1] = a;
    axis[2] = a * (1 - f);
    for (i = 0; i < 6; ++i) {
        double x[2][3];
        CASE("row %d", i);
        for (end = 0; end < 2; ++end) {
            double lat = known[i][3 * end] * degree, lon = known[i][3 * end + 1] * degree;
            double across = a / sqrt(1 - square * sin(lat) * sin(lat));
            x[end][0] = across * cos(lat) * cos(lon);
            x[end][1] = across * cos(lat) * sin(lon);
            x[end][2] = (1 - square) * across * sin(lat);
        }
        for (end = 0; end < 2; ++end) {
            double lat = known[i][3 * end] * degree, lon = known[i][3 * end + 1] * degree, length, direction[2], t[3];
            double azimuth = known[i][3 * end + 2] * degree + (end ? PI : 0);
            CHECK_OK(surfmink_implicit_log(&earth, x[end], x[1 - end], &length, direction));
            CHECK_CLOSE(length, known[i][6], 1e-15);
            in_space(&earth, x[end], direction, t);
            CHECK_ANGLE(atan2(cos(lon) * t[1] - sin(lon) * t[0],
                              cos(lat) * t[2] - sin(lat) * (cos(lon) * t[0] + sin(lon) * t[1])),
                        azimuth, 1e-14);
        }
    }
}

/* --- exp and log -------------------------------------------------------------------------------------------------- */

THEOREM(exp_of_log_is_the_other_point)
{
    chance c = {seed(15)};
    int trial, k;
    for (trial = 0; trial < 400; ++trial) {
        double shape[3], x[3], y[3], z[3], length, direction[2], size;
        int bent = trial % 3;
        surfmink_implicit surface = random_surface(&c, bent, shape);
        CASE("trial %d: shape %g %g %g", trial, shape[0], shape[1], shape[2]);
        random_point(&c, &surface, x);
        for (size = pow(10, between(&c, -9, 0)), k = 0; k < 3; ++k)
            y[k] = x[k] + size * between(&c, -0.3, 0.3) * shape[1];
        CHECK_OK(surfmink_implicit_project(&surface, y, y));
        CHECK_OK(surfmink_implicit_log(&surface, x, y, &length, direction));
        CHECK_OK(surfmink_implicit_exp(&surface, x, direction, length, z));
        CHECK_NEAR(distance3(y, z), 0, 1e-14);
    }
}

THEOREM(log_of_exp_is_the_direction_and_the_length)
{
    chance c = {seed(16)};
    int trial;
    for (trial = 0; trial < 400; ++trial) {
        double shape[3], x[3], y[3], length, direction[2], angle = between(&c, -PI, PI), want[2], reach;
        surfmink_implicit surface = random_surface(&c, trial % 3, shape);
        reach = between(&c, 0.01, 1) * safe_length(&surface);
        CASE("trial %d: shape %g %g %g, length %g", trial, shape[0], shape[1], shape[2], reach);
        random_point(&c, &surface, x);
        want[0] = cos(angle);
        want[1] = sin(angle);
        CHECK_OK(surfmink_implicit_exp(&surface, x, want, reach, y));
        CHECK_OK(surfmink_implicit_log(&surface, x, y, &length, direction));
        CHECK_NEAR(length, reach, 1e-12);
        CHECK_NEAR(direction[0], want[0], 1e-12);
        CHECK_NEAR(direction[1], want[1], 1e-12);
    }
}

THEOREM(log_from_the_other_end_is_the_same_geodesic)
{
    chance c = {seed(17)};
    int trial, k;
    for (trial = 0; trial < 200; ++trial) {
        double shape[3], x[3], y[3], middle[3], back[3], length[2], there[2], here[2];
        surfmink_implicit surface = random_surface(&c, trial % 3, shape);
        CASE("trial %d: shape %g %g %g", trial, shape[0], shape[1], shape[2]);
        random_point(&c, &surface, x);
        for (k = 0; k < 3; ++k) y[k] = x[k] + between(&c, -0.8, 0.8) * shape[1];
        CHECK_OK(surfmink_implicit_project(&surface, y, y));
        CHECK_OK(surfmink_implicit_log(&surface, x, y, &length[0], there));
        CHECK_OK(surfmink_implicit_log(&surface, y, x, &length[1], here));
        CHECK_SAME(&length[1], &length[0], 1);
        CHECK_OK(surfmink_implicit_exp(&surface, x, there, length[0] / 2, middle));
        CHECK_OK(surfmink_implicit_exp(&surface, y, here, length[0] / 2, back));
        CHECK_NEAR(distance3(middle, back), 0, 1e-13);
    }
}

THEOREM(small_shapes_keep_all_their_digits)
{
    double axis[3] = {1.6, 1.3, 1.0}, corner[3 * 5], normal[3 * 5], length[5], turning[5], flat[5], turn[5], size;
    surfmink_implicit body = surfmink_ellipsoid(axis);
    surfmink_surface surface = surfmink_implicit_surface(&body);
    size_t i;
    for (size = 1e-8; size > 1e-13; size /= 10) {
        CASE("size %g", size);
        for (i = 0; i < 5; ++i) {
            surfmink_ellipsoid_point(axis, 1.1 + size * ((double)i + 1) * cos(2 * PI * (double)i / 5),
                                     0.7 + size * sin(2 * PI * (double)i / 5), corner + 3 * i);
            CHECK_OK(surfmink_implicit_normal(&body, corner + 3 * i, normal + 3 * i));
        }
        /* At this size chords in the tangent planes are geodesics, to all digits. The corners carry rounding of
           1e-16 / size along the normals, which neither way of measuring may see. */
        CHECK_OK(surfmink_edges(ON_SURFACE(&surface, corner, 5), length, turning, NULL));
        CHECK_OK(surfmink_edges(IN_SPACE(corner, normal, 5), flat, turn, NULL));
        for (i = 0; i < 5; ++i) {
            CHECK_CLOSE(length[i], flat[i], 4e-16 + 1e-16 * pow(1e-16 / size, 2) / 1e-16);
            CHECK_NEAR(turning[i], turn[i], 3e-15);
        }
    }
}

THEOREM(the_unit_of_length_does_not_matter)
{
    chance c = {seed(18)};
    int trial, k;
    for (trial = 0; trial < 100; ++trial) {
        double shape[3], large[3], x[3], y[3], length[2], direction[2][2], unit = ldexp(1.0, (int)one_of(&c, 120) - 60);
        surfmink_implicit surface = random_surface(&c, trial % 2, shape), scaled = surface;
        random_point(&c, &surface, x);
        for (k = 0; k < 3; ++k) y[k] = x[k] + between(&c, -0.5, 0.5) * shape[1];
        CHECK_OK(surfmink_implicit_project(&surface, y, y));
        CHECK_OK(surfmink_implicit_log(&surface, x, y, &length[0], direction[0]));
        for (k = 0; k < 3; ++k) {
            large[k] = shape[k] * unit;
            x[k] *= unit;
            y[k] *= unit;
        }
        scaled.shape = large;
        CASE("trial %d: unit %g", trial, unit);
        CHECK_OK(surfmink_implicit_log(&scaled, x, y, &length[1], direction[1]));
        length[0] *= unit;
        CHECK_SAME(&length[1], &length[0], 1);
        CHECK_SAME(direction[1], direction[0], 2);
    }
}

/* An ellipsoid that is turned in space: all six second derivatives are at work. shape: axes, then the turn's matrix. */
static double turned(const void *shape, const double x[3], double gradient[3], double hessian[6])
{
    static const int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
    const double *turn = (const double *)shape + 3;
    double y[3], g[3], h[6], value;
    int i, j, k, l;
    for (i = 0; i < 3; ++i) y[i] = dot3(turn + 3 * i, x);
    value = surfmink_ellipsoid_f(shape, y, g, h);
    for (i = 0; i < 3; ++i) {
        for (gradient[i] = 0, k = 0; k < 3; ++k) gradient[i] += turn[3 * k + i] * g[k];
        for (j = i; j < 3; ++j)
            for (hessian[at[i][j]] = 0, k = 0; k < 3; ++k)
                for (l = 0; l < 3; ++l) hessian[at[i][j]] += turn[3 * k + i] * h[at[k][l]] * turn[3 * l + j];
    }
    return value;
}

THEOREM(a_surface_that_is_turned_in_space_has_the_same_geodesics)
{
    chance c = {seed(27)};
    int trial, k;
    for (trial = 0; trial < 60; ++trial) {
        double shape[12], x[3], y[3], there[6], length[2] = {0, 1}, direction[2], vector[3], other[3],
                                                curvature[2] = {0, 1};
        surfmink_implicit body = surfmink_ellipsoid(shape), tilted;
        for (k = 0; k < 3; ++k) shape[k] = pow(3, between(&c, 0, 1));
        for (k = 0; k < 9; ++k) shape[3 + k] = k % 4 == 0;
        turn_somehow(&c, shape + 3, 3); /* the rows: images of the axes */
        tilted.f = turned;
        tilted.shape = shape;
        random_point(&c, &body, x);
        random_point(&c, &body, y);
        for (k = 0; k < 3; ++k) y[k] = x[k] + 0.4 * (y[k] - x[k]);
        CHECK_OK(surfmink_implicit_project(&body, y, y));
        for (k = 0; k < 3; ++k) {
            there[k] = shape[3 + k] * x[0] + shape[6 + k] * x[1] + shape[9 + k] * x[2];
            there[3 + k] = shape[3 + k] * y[0] + shape[6 + k] * y[1] + shape[9 + k] * y[2];
        }
        CASE("trial %d: axes %g %g %g", trial, shape[0], shape[1], shape[2]);
        CHECK_OK(surfmink_implicit_curvature(&body, x, &curvature[0]));
        CHECK_OK(surfmink_implicit_curvature(&tilted, there, &curvature[1]));
        CHECK_CLOSE(curvature[1], curvature[0], 1e-13);
        CHECK_OK(surfmink_implicit_log(&body, x, y, &length[0], direction));
        in_space(&body, x, direction, vector);
        CHECK_OK(surfmink_implicit_log(&tilted, there, there + 3, &length[1], direction));
        in_space(&tilted, there, direction, other);
        CHECK_CLOSE(length[1], length[0], 1e-14);
        for (k = 0; k < 3; ++k) CHECK_NEAR(dot3(shape + 3 + 3 * k, other), vector[k], 1e-14);
    }
}

THEOREM(points_off_the_surface_count_as_the_points_below_them)
{
    chance c = {seed(19)};
    int trial, k;
    for (trial = 0; trial < 100; ++trial) {
        double shape[3], x[3], y[3], off[3], foot[3] = {0, 0, 0}, length[2], direction[2][2], normal[3], away;
        surfmink_implicit surface = random_surface(&c, 0, shape);
        random_point(&c, &surface, x);
        random_point(&c, &surface, y);
        for (k = 0; k < 3; ++k) y[k] = x[k] + 0.2 * (y[k] - x[k]);
        CHECK_OK(surfmink_implicit_project(&surface, y, y));
        CHECK_OK(surfmink_implicit_normal(&surface, x, normal));
        for (away = between(&c, -0.05, 0.05), k = 0; k < 3; ++k) off[k] = x[k] + away * normal[k];
        CHECK_OK(surfmink_implicit_project(&surface, off, foot));
        CASE("trial %d: shape %g %g %g", trial, shape[0], shape[1], shape[2]);
        CHECK_NEAR(distance3(foot, x), 0, away * away); /* next to the nearest point */
        CHECK_OK(surfmink_implicit_log(&surface, foot, y, &length[0], direction[0]));
        CHECK_OK(surfmink_implicit_log(&surface, off, y, &length[1], direction[1]));
        CHECK_NEAR(length[1], length[0], 1e-14 * length[0] + 2e-16); /* points are rounded */
        for (k = 0; k < 2; ++k) CHECK_NEAR(direction[1][k], direction[0][k], 1e-14 + 2e-16 / length[0]);
    }
}

/* --- polygons ----------------------------------------------------------------------------------------------------- */

THEOREM(geodesic_polygons_agree_with_50_digit_references)
{
    static const char *const xyz[3] = {"x", "y", "z"}, *const measured[2] = {"l", "alpha"};
    static const char *const tangents[7] = {"t0x", "t0y", "t0z", "t1x", "t1y", "t1z", "l"};
    double shape[3], corner[3 * 8], want[2 * 8], edge[7 * 8], length[8], turning[8], mu[13], theta[13], g[26];
    surfmink_functionals w;
    table t;
    int cases = 0;
    table_open(&t, "tests/data/geodesic_surface_ref.tsv");
    while (table_next(&t)) {
        surfmink_implicit body;
        surfmink_surface surface;
        const char *which = table_text(&t, "case");
        size_t n = (size_t)table_number(&t, "q"), i;
        int p, k;
        CASE("%s", which);
        ++cases;
        if (strcmp(table_text(&t, "surface"), "ell") == 0) {
            CHECK_EQUAL(sscanf(table_text(&t, "params"), "%lf;%lf;%lf", &shape[0], &shape[1], &shape[2]), 3);
            body = surfmink_ellipsoid(shape);
        } else {
            CHECK_EQUAL(sscanf(table_text(&t, "params"), "%lf;%lf", &shape[0], &shape[1]), 2);
            body = surfmink_torus(shape);
        }
        surface = surfmink_implicit_surface(&body);
        CHECK_EQUAL(table_points("tests/data/geodesic_surface_points.tsv", which, xyz, 3, 8, corner), n);
        CHECK_EQUAL(table_points("tests/data/geodesic_surface_points.tsv", which, measured, 2, 8, want), n);
        CHECK_EQUAL(table_points("tests/data/geodesic_surface_edges.tsv", which, tangents, 7, 8, edge), n);
        CHECK_OK(surfmink_edges(ON_SURFACE(&surface, corner, n), length, turning, NULL));
        for (i = 0; i < n; ++i) {
            double l, direction[2], vector[3];
            const double *x = corner + 3 * i, *y = corner + 3 * ((i + 1) % n);
            CHECK_CLOSE(length[i], want[2 * i], 1e-15);
            CHECK_NEAR(turning[i], want[2 * i + 1], 2e-15);
            CHECK_OK(surfmink_implicit_log(&body, x, y, &l, direction));
            in_space(&body, x, direction, vector);
            for (k = 0; k < 3; ++k) CHECK_NEAR(vector[k], edge[7 * i + (size_t)k], 1e-15);
            CHECK_OK(surfmink_implicit_log(&body, y, x, &l, direction));
            in_space(&body, y, direction, vector);
            for (k = 0; k < 3; ++k) CHECK_NEAR(-vector[k], edge[7 * i + 3 + (size_t)k], 1e-15);
        }
        CHECK_OK(surfmink_measure(ON_SURFACE(&surface, corner, n), 12, mu, g, &w, NULL));
        CHECK_OK(surfmink_spectrum(g, 12, NULL, NULL, theta));
        CHECK_CLOSE(w.length, table_number(&t, "L"), 1e-14);
        CHECK_NEAR(w.turning, table_number(&t, "sum_alpha"), 1e-14);
        CHECK_NEAR(w.curvature, table_number(&t, "deficit"), 1e-14);
        for (p = 1; p <= 12; ++p) {
            double known = table_rank(&t, "mu_", p);
            CHECK_NEAR(mu[p], known, 1e-14);
            CHECK_ANGLE(p * known * remainder(theta[p] - table_rank(&t, "theta_", p), 2 * PI / p), 0, 1e-13);
        }
    }
    CHECK_EQUAL(cases, 3);
}

/* Paper 5.1, figure (sketch-Torus). The table was computed in double precision: its own l_1 and l_2, equal by symmetry,
   differ by up to 1e-12, so that much of the last digit is theirs. */
THEOREM(torus_triangles_have_the_printed_lengths_angles_and_mu)
{
    double radius[2] = {2, 1.375}, length[3], turning[3], phase[3], g[14], mu[7];
    double near_length = 0, near_direction[2] = {0, 0};
    surfmink_surface unrolled = surfmink_torus_chart(radius);
    surfmink_implicit torus = surfmink_torus(radius);
    table t;
    int rows = 0, p, i;
    table_open(&t, "examples/paper/data/torus_triangles.tsv");
    while (table_next(&t)) {
        static const char *const l[3] = {"l1", "l2", "l3"}, *const alpha[3] = {"alpha1", "alpha2", "alpha3"};
        double corner[6], x[3], y[3], direction[2], found;
        corner[0] = 0, corner[1] = PI;
        corner[2] = 1.55, corner[3] = table_number(&t, "theta2_over_pi") * PI;
        corner[4] = 3.1, corner[5] = PI;
        CASE("theta_2 = %s pi", table_text(&t, "theta2_over_pi"));
        if (rows % STRIDE == 0) {
            CHECK_OK(surfmink_edges(ON_SURFACE(&unrolled, corner, 3), length, turning, NULL));
            CHECK_OK(surfmink_phases(turning, 3, SURFMINK_CORRECTED, phase));
            CHECK_OK(surfmink_irreducible(length, phase, 3, 6, g));
            CHECK_OK(surfmink_spectrum(g, 6, NULL, mu, NULL));
            for (i = 0; i < 3; ++i) {
                CHECK_NEAR(length[i], table_number(&t, l[i]), 2.5e-12);
                CHECK_NEAR(turning[i], table_number(&t, alpha[i]), 2.5e-12);
            }
            CHECK_NEAR(length[0], length[1], 1e-13);
            CHECK_CLOSE(length[2], 3.1 * 0.625, 1e-14); /* along the inner ring */
            for (p = 2; p <= 6; ++p) {
                char name[8];
                sprintf(name, "mu%d", p);
                CHECK_NEAR(mu[p], table_number(&t, name), 2.5e-12);
            }
        }
        /* The same geodesic continued from one triangle to the next, from theta_2 = 0.9 pi on. */
        surfmink_torus_point(radius, corner[0], corner[1], x);
        surfmink_torus_point(radius, corner[2], corner[3], y);
        if (rows++ == 0) CHECK_OK(surfmink_implicit_log(&torus, x, y, &near_length, near_direction));
        CHECK_OK(surfmink_implicit_log_near(&torus, x, y, &near_length, near_direction, NULL));
        CHECK_OK(unrolled.log(unrolled.context, corner, corner + 2, &found, direction));
        CHECK_NEAR(near_length, found, 1e-13);
        CHECK_NEAR(near_direction[0], direction[0], 1e-13);
        CHECK_NEAR(near_direction[1], direction[1], 1e-13);
    }
    CHECK_EQUAL(rows, 35);
}

/* Integral of K over a polygon, from the chart: with F the integral of K sqrt(det g) over u from u_0, Green's theorem
   makes it the integral of F dv along the edges. Both are done by Gauss's rule of 5 points. Only points and
   directions of the edges come from exp and log. */
static const double gauss_node[5] = {-0.90617984593866399280, -0.53846931010568309104, 0, 0.53846931010568309104,
                                     0.90617984593866399280};
static const double gauss_weight[5] = {0.23692688505618908751, 0.47862867049936646804, 0.56888888888888888889,
                                       0.47862867049936646804, 0.23692688505618908751};

static double curvature_per_chart(const surfmink_implicit *surface, const chart *m, double u, double v)
{
    double x[3], normal[3], du[3], dv[3], area[3], curvature = 0;
    chart_point(m, u, v, x, normal, du, dv);
    cross3(du, dv, area);
    CHECK_OK(surfmink_implicit_curvature(surface, x, &curvature));
    return curvature * norm3(area);
}

static double integral_of_curvature(const surfmink_implicit *surface, const chart *m, const double *corner, size_t n,
                                    double u0)
{
    double sum = 0;
    size_t i;
    int panel, j, inner, k;
    for (i = 0; i < n; ++i) {
        const double *x = corner + 3 * i, *y = corner + 3 * ((i + 1) % n);
        double length, direction[2];
        CHECK_OK(surfmink_implicit_log(surface, x, y, &length, direction));
        for (panel = 0; panel < 16; ++panel)
            for (j = 0; j < 5; ++j) {
                double s = length * (panel + (1 + gauss_node[j]) / 2) / 16, point[3], ahead[2], rest, t[3], u, v, f = 0;
                double at[3], normal[3], du[3], dv[3], e, g, h, speed;
                CHECK_OK(surfmink_implicit_exp(surface, x, direction, s, point));
                CHECK_OK(surfmink_implicit_log(surface, point, y, &rest, ahead));
                in_space(surface, point, ahead, t);
                if (m->kind == TORUS) {
                    u = atan2(point[1], point[0]);
                    v = atan2(point[2], hypot(point[0], point[1]) - m->a);
                } else {
                    u = acos(point[2] / m->c);
                    v = atan2(point[1] / m->b, point[0] / m->a);
                }
                chart_point(m, u, v, at, normal, du, dv);
                e = dot3(du, du), g = dot3(dv, dv), h = dot3(du, dv);
                speed = (e * dot3(t, dv) - h * dot3(t, du)) / (e * g - h * h); /* dv/ds */
                for (inner = 0; inner < 4; ++inner)
                    for (k = 0; k < 5; ++k)
                        f += gauss_weight[k] / 8 * (u - u0) *
                             curvature_per_chart(surface, m, u0 + (u - u0) * (inner + (1 + gauss_node[k]) / 2) / 4, v);
                sum += gauss_weight[j] * length / 32 * f * speed;
            }
    }
    return sum;
}

THEOREM(gauss_bonnet_for_triangles_of_ellipsoid_and_torus)
{
    chance c = {seed(20)};
    int trial;
    for (trial = 0; trial < 12; ++trial) {
        double shape[3], corner[9], normal[9], length[3], turning[3];
        surfmink_functionals w;
        chart m;
        double u = between(&c, 0.9, 2), v = between(&c, -2, 2);
        surfmink_implicit body = random_surface(&c, trial < 9 ? 0 : 1, shape);
        surfmink_surface surface = surfmink_implicit_surface(&body);
        m.kind = body.f == surfmink_torus_f ? TORUS : ELLIPSOID;
        m.a = shape[0], m.b = shape[1], m.c = m.kind == TORUS ? 0 : shape[2];
        star_on_chart(&c, &m, u, v, 0.6, 3, corner, normal);
        CASE("trial %d: %s %g %g %g", trial, m.kind == TORUS ? "torus" : "ellipsoid", m.a, m.b, m.c);
        CHECK_OK(surfmink_edges(ON_SURFACE(&surface, corner, 3), length, turning, NULL));
        CHECK_OK(surfmink_total(NULL, length, turning, 3, &w));
        CHECK_NEAR(w.curvature, integral_of_curvature(&body, &m, corner, 3, u), 1e-12);
    }
}

THEOREM(regular_polygons_of_a_round_ellipsoid)
{
    double axis[3] = {2, 2, 2}, centre[3], corner[3 * 8], mu[13];
    surfmink_implicit body = surfmink_ellipsoid(axis);
    surfmink_surface surface = surfmink_implicit_surface(&body);
    size_t q;
    int p;
    surfmink_ellipsoid_point(axis, 1.2, 0.5, centre);
    for (q = 3; q <= 8; ++q) {
        CHECK_OK(surfmink_regular_polygon(&surface, centre, 1.4, 0.3, q, corner));
        CHECK_OK(surfmink_measure(ON_SURFACE(&surface, corner, q), 12, mu, NULL, NULL, NULL));
        CASE("%d corners", (int)q);
        for (p = 0; p <= 12; ++p) CHECK_NEAR(mu[p], p % (int)q ? 0 : 1, 1e-14);
    }
}

/* --- which geodesic ----------------------------------------------------------------------------------------------- */

THEOREM(the_chart_of_the_torus_chooses_how_often_an_edge_goes_round)
{
    double radius[2] = {2, 0.75}, from[2] = {0.3, PI}, to[2], length, direction[2], end[2];
    surfmink_surface unrolled = surfmink_torus_chart(radius);
    int round, sign;
    for (sign = -1; sign <= 1; sign += 2)
        for (round = 1; round <= 3; ++round) {
            CASE("%d rounds", sign * round);
            to[0] = from[0] + sign * round * 2 * PI; /* the inner ring is a geodesic; a loop comes back to its start */
            to[1] = from[1];
            CHECK_OK(unrolled.log(unrolled.context, from, to, &length, direction));
            CHECK_CLOSE(length, round * 2 * PI * 1.25, 1e-14);
            CHECK_OK(unrolled.exp(unrolled.context, from, direction, length, end));
            CHECK_NEAR(end[0], to[0], 1e-12);
            CHECK_NEAR(end[1], to[1], 1e-12);
        }
    for (round = 1; round <= (FEWER > 100 ? 4 : 16); round *= 2) { /* so is the circle round the tube */
        CASE("%d rounds of the tube", round);
        to[0] = from[0];
        to[1] = from[1] + round * 2 * PI;
        CHECK_OK(unrolled.log(unrolled.context, from, to, &length, direction));
        CHECK_CLOSE(length, round * 2 * PI * 0.75, 1e-14);
    }
    to[0] = from[0] + 5.5; /* a long way round, and the short one back: both are geodesics, only one is the shortest */
    to[1] = from[1] + 0.5;
    CHECK_OK(unrolled.log(unrolled.context, from, to, &length, direction));
    CHECK(length > 5.5 * 1.25);
    CHECK_OK(unrolled.exp(unrolled.context, from, direction, length, end));
    CHECK_NEAR(end[0], to[0], 1e-12);
    CHECK_NEAR(end[1], to[1], 1e-12);
    {
        surfmink_implicit torus = surfmink_torus(radius);
        double x[3], y[3], shortest;
        surfmink_torus_point(radius, from[0], from[1], x);
        surfmink_torus_point(radius, to[0], to[1], y);
        CHECK_OK(surfmink_implicit_log(&torus, x, y, &shortest, direction));
        CHECK(shortest < 1.5);
    }
}

/* A geodesic of another homotopy class ends at the same point of space, but not of the chart. An ok from log means the
   right one, on thin tubes and fat ones. Where K < 0 makes directions grow by 1e13 on the way, log fails by name. */
THEOREM(in_the_chart_of_the_torus_exp_of_log_is_the_other_corner)
{
    static const double tube[6] = {0.05, 0.1, 0.3, 0.6, 0.8, 0.9}, far[2] = {3, 6};
    double radius[2] = {1, 0.0625}, x[2] = {4, -0.920379638671875}, y[2] = {0, 0}, end[2], length, direction[2];
    surfmink_surface unrolled = surfmink_torus_chart(radius);
    chance c = {seed(22)};
    int i, k, trial, status, tried, found;
    CHECK_OK(unrolled.log(unrolled.context, x, y, &length, direction));
    CHECK_OK(unrolled.exp(unrolled.context, x, direction, length, end));
    CHECK_NEAR(hypot(end[0] - y[0], end[1] - y[1]), 0, 1e-6);
    for (i = 0; i < 6; ++i)
        for (k = 0; k < 2; ++k) {
            radius[1] = tube[i];
            tried = found = 0;
            for (trial = 0; trial < 15; trial += STRIDE) {
                x[0] = between(&c, -3, 3);
                x[1] = between(&c, -3, 3);
                y[0] = x[0] + between(&c, -far[k], far[k]);
                y[1] = x[1] + between(&c, -far[k], far[k]);
                CASE("r / R = %g, %.17g %.17g to %.17g %.17g", tube[i], x[0], x[1], y[0], y[1]);
                status = unrolled.log(unrolled.context, x, y, &length, direction);
                ++tried;
                if (status != SURFMINK_OK) {
                    CHECK(status == SURFMINK_ANTIPODAL_CORNERS || status == SURFMINK_CALLBACK_FAILED);
                    continue;
                }
                ++found;
                CHECK_OK(unrolled.exp(unrolled.context, x, direction, length, end));
                CHECK_NEAR(hypot(end[0] - y[0], end[1] - y[1]), 0, i == 0 ? 1e-3 : 1e-6);
            }
            CHECK(found >= (k == 0 ? 0.9 : 0.6) * tried - 1);
        }
}

THEOREM(log_finds_the_shortest_geodesic_and_log_near_the_guessed)
{
    /* Two points on the rim of a lens, near the ends of its long axis: over the top, and by symmetry below, it is
       short. */
    double axis[3] = {3, 2, 0.5}, x[3], y[3], length, direction[2], over, back[2], frame[9];
    surfmink_implicit lens = surfmink_ellipsoid(axis);
    surfmink_ellipsoid_point(axis, PI / 2 - 0.01, 0.02, x);
    surfmink_ellipsoid_point(axis, PI / 2 - 0.01, PI + 0.03, y);
    CHECK_OK(surfmink_implicit_log(&lens, x, y, &over, direction));
    CHECK_NEAR(over, 2 * quarter_ellipse(3, 0.5), 0.05);
    CHECK_OK(surfmink_implicit_frame(&lens, x, frame));
    CHECK(direction[0] * frame[2] + direction[1] * frame[5] > 0.1); /* up */
    length = over;
    direction[0] = -frame[2];
    direction[1] = -frame[5];
    CHECK_OK(surfmink_implicit_log_near(&lens, x, y, &length, direction, back));
    CHECK(direction[0] * frame[2] + direction[1] * frame[5] < -0.1); /* down, and longer */
    CHECK(length > over + 1e-3);
    CHECK_NEAR(length, over, 0.1);
    {
        double from_y = length, there[2];
        there[0] = back[0], there[1] = back[1];
        CHECK_OK(surfmink_implicit_log_near(&lens, y, x, &from_y, there, NULL));
        CHECK_CLOSE(from_y, length, 1e-14);
        CHECK_NEAR(there[0], back[0], 1e-13);
        CHECK_NEAR(there[1], back[1], 1e-13);
    }
}

THEOREM(the_other_side_of_a_thin_body_is_far)
{
    double axis[3] = {1, 1, 0.2}, x[3], y[3], end[3], length, direction[2];
    surfmink_implicit lens = surfmink_ellipsoid(axis);
    int i;
    for (i = 1; i <= 9; ++i) {
        CASE("%d", i);
        surfmink_ellipsoid_point(axis, 0.1 * i, 0.1, x);
        surfmink_ellipsoid_point(axis, PI - 0.1 * i - 0.01, 0.13, y); /* below, round the rim */
        length = 0;
        CHECK_OK(surfmink_implicit_log(&lens, x, y, &length, direction));
        CHECK(length > 2 * (1 - sin(0.1 * i + 0.01)));
        CHECK_OK(surfmink_implicit_exp(&lens, x, direction, length, end));
        CHECK_NEAR(distance3(end, y), 0, 1e-13);
    }
}

/* --- failure has a name ------------------------------------------------------------------------------------------- */

static int log_status(const surfmink_implicit *surface, const double *x, const double *y)
{
    double length = 7, direction[2] = {8, 9};
    int status = surfmink_implicit_log(surface, x, y, &length, direction);
    if (status != SURFMINK_OK) CHECK(length == 7 && direction[0] == 8 && direction[1] == 9);
    return status;
}

static double wrinkled(const void *shape, const double x[3], double gradient[3], double hessian[6])
{
    /* A plane at 0 with a gradient that lies: nothing leads down to it. */
    int k;
    (void)shape;
    for (k = 0; k < 6; ++k) hessian[k] = 0;
    gradient[0] = gradient[1] = 0;
    gradient[2] = -1;
    return x[2];
}

THEOREM(geodesics_that_are_not_unique_fail_by_name)
{
    double unit[3] = {1, 1, 1}, body[3] = {1.6, 1.3, 1.0}, earth[3] = {1, 1, 0.99664718933525254};
    double x[3], y[3], direction[2] = {1, 0}, length = 2 * PI, near_pole[3] = {0, 0, -1};
    double radius[2] = {2, 0.5}, from[2] = {0, 0}, to[2] = {5, 0};
    surfmink_implicit sphere = surfmink_ellipsoid(unit), ellipsoid = surfmink_ellipsoid(body);
    surfmink_implicit spheroid = surfmink_ellipsoid(earth);
    surfmink_surface unrolled = surfmink_torus_chart(radius);
    chance c = {seed(21)};
    int trial, k, missed = 0;
    for (trial = 0; trial < 30; trial += STRIDE) {
        random_point(&c, &sphere, x);
        for (k = 0; k < 3; ++k) y[k] = -x[k];
        CHECK_STATUS(log_status(&sphere, x, y), SURFMINK_ANTIPODAL_CORNERS); /* all directions lead there */
        random_point(&c, &ellipsoid, x);
        for (k = 0; k < 3; ++k) y[k] = -x[k];
        missed += log_status(&ellipsoid, x, y) != SURFMINK_ANTIPODAL_CORNERS; /* two do, equally long */
    }
    CHECK(missed <= 1); /* of two that are equally long one may not be found: 1 in 1200 */
    surfmink_ellipsoid_point(earth, 0, 0, x);
    for (k = 0; k < 3; ++k) y[k] = -x[k];
    CHECK_STATUS(log_status(&spheroid, x, y), SURFMINK_ANTIPODAL_CORNERS);
    surfmink_ellipsoid_point(earth, PI / 2, 0, x);
    for (k = 0; k < 3; ++k) y[k] = -x[k];
    CHECK_STATUS(log_status(&spheroid, x, y), SURFMINK_ANTIPODAL_CORNERS); /* over either pole */
    x[0] = x[1] = 0, x[2] = 1;
    near_pole[0] = 1e-7; /* almost antipodal: 1e-7 of a radian is too little to tell the direction */
    CHECK_STATUS(log_status(&sphere, x, near_pole), SURFMINK_ANTIPODAL_CORNERS);
    near_pole[0] = 1e-4;
    CHECK_STATUS(log_status(&sphere, x, near_pole), SURFMINK_OK);
    /* The long way round a sphere passes the antipode, a conjugate point. */
    surfmink_ellipsoid_point(unit, PI / 2, 0, x);
    surfmink_ellipsoid_point(unit, PI / 2, 1, y);
    {
        double frame[9];
        CHECK_OK(surfmink_implicit_frame(&sphere, x, frame));
        direction[0] = -frame[1];
        direction[1] = -frame[4];
        length = 2 * PI - 1;
        CHECK_STATUS(surfmink_implicit_log_near(&sphere, x, y, &length, direction, NULL), SURFMINK_ANTIPODAL_CORNERS);
        CHECK(length == 2 * PI - 1 && direction[0] == -frame[1]);
        direction[0] = frame[1];
        direction[1] = frame[4];
        length = 2 * PI + 1; /* past two of them: the Jacobi field is positive again */
        CHECK_STATUS(surfmink_implicit_log_near(&sphere, x, y, &length, direction, NULL), SURFMINK_ANTIPODAL_CORNERS);
    }
    /* So does the outer ring of a torus, after pi sqrt(r (R + r)) = 3.5: at an angle of 1.4. */
    CHECK_STATUS(unrolled.log(unrolled.context, from, to, &length, direction), SURFMINK_ANTIPODAL_CORNERS);
    to[0] = 1.39;
    CHECK_STATUS(unrolled.log(unrolled.context, from, to, &length, direction), SURFMINK_OK);
    to[0] = 1.42;
    CHECK_STATUS(unrolled.log(unrolled.context, from, to, &length, direction), SURFMINK_ANTIPODAL_CORNERS);
}

/* Where m -> 0 a turn hardly moves the end, so a small miss may hide a large error of the direction. */
THEOREM(next_to_a_conjugate_point_log_still_hits)
{
    double axis[3] = {1.6, 1.3, 1.0}, x[3], y[3], end[3], direction[2], length, low = 2, high = 6, way;
    static const double from[2] = {0.6, 0.8};
    surfmink_implicit body = surfmink_ellipsoid(axis);
    int i;
    surfmink_ellipsoid_point(axis, 1.1, 0.4, x);
    for (i = 0; i < 40; ++i) { /* where the geodesic from x has its first conjugate point */
        length = (low + high) / 2;
        direction[0] = from[0], direction[1] = from[1];
        CHECK_OK(surfmink_implicit_exp(&body, x, direction, length, y));
        if (surfmink_implicit_log_near(&body, x, y, &length, direction, NULL) == SURFMINK_OK)
            low = (low + high) / 2;
        else
            high = (low + high) / 2;
    }
    CHECK(low > 3 && high < 5);
    for (way = 1e-4; way > 2e-6; way /= 2) {
        CASE("%g before it", way);
        CHECK_OK(surfmink_implicit_exp(&body, x, from, low - way, y));
        length = low - way;
        direction[0] = from[0] - 0.1 * way, direction[1] = from[1];
        CHECK_OK(surfmink_implicit_log_near(&body, x, y, &length, direction, NULL));
        CHECK_NEAR(length, low - way, 1e-12);
        CHECK_NEAR(direction[0], from[0], 1e-14 / way);
        CHECK_OK(surfmink_implicit_exp(&body, x, direction, length, end));
        CHECK_NEAR(distance3(end, y), 0, 1e-14);
    }
}

static double slab(const void *shape, const double x[3], double gradient[3], double hessian[6])
{
    int k;
    (void)shape;
    for (k = 0; k < 6; ++k) hessian[k] = 0;
    hessian[5] = 2;
    gradient[0] = gradient[1] = 0;
    gradient[2] = 2 * x[2];
    return x[2] * x[2] - 1;
}

THEOREM(no_geodesic_leads_from_one_sheet_to_another)
{
    static const double x[3] = {0, 0, 1}, beside[3] = {3, 0, 1}, below[3] = {3, 0, -1}, under[3] = {0, 0, -1};
    surfmink_implicit planes;
    planes.f = slab;
    planes.shape = NULL;
    CHECK_OK(log_status(&planes, x, beside));
    CHECK_STATUS(log_status(&planes, x, below), SURFMINK_CALLBACK_FAILED);
    CHECK_STATUS(log_status(&planes, x, under), SURFMINK_CALLBACK_FAILED);
}

THEOREM(other_failures_have_names_too_and_change_nothing)
{
    double axis[3] = {1.6, 1.3, 1.0}, radius[2] = {2, 1}, x[3], y[3], direction[2] = {1, 0}, length = 1,
           point[3] = {7, 8, 9};
    double nowhere[3] = {0, 0, 0}, lost[3], above[3], corner[9], mu[4] = {5, 5, 5, 5}, angles[2] = {0.1, 0.2};
    surfmink_implicit body = surfmink_ellipsoid(axis), ring = surfmink_torus(radius), lie;
    surfmink_surface surface = surfmink_implicit_surface(&body), unrolled = surfmink_torus_chart(radius);
    size_t bad = 77;
    int k;
    lie.f = wrinkled;
    lie.shape = NULL;
    surfmink_ellipsoid_point(axis, 1, 1, x);
    surfmink_ellipsoid_point(axis, 1.2, 1, y);
    for (k = 0; k < 3; ++k) lost[k] = x[k], above[k] = 2 * x[k];
    lost[1] = nan("");
    CHECK_STATUS(log_status(&body, x, x), SURFMINK_COINCIDENT_CORNERS);
    CHECK_OK(surfmink_implicit_project(&body, above, above));
    for (k = 0; k < 3; ++k) corner[k] = 1.1 * above[k];
    CHECK_OK(surfmink_implicit_project(&body, corner, corner + 3));
    CHECK_STATUS(log_status(&body, corner, corner + 3), SURFMINK_COINCIDENT_CORNERS); /* one above the other */
    CHECK_STATUS(log_status(&body, x, nowhere), SURFMINK_ZERO_NORMAL); /* the centre lies below no point */
    CHECK_STATUS(log_status(&body, nowhere, x), SURFMINK_ZERO_NORMAL);
    CHECK_STATUS(log_status(&body, x, lost), SURFMINK_NOT_FINITE);
    CHECK_STATUS(log_status(&body, lost, x), SURFMINK_NOT_FINITE);
    lost[1] = HUGE_VAL;
    CHECK_STATUS(log_status(&body, x, lost), SURFMINK_NOT_FINITE);
    CHECK_STATUS(log_status(&ring, x, nowhere), SURFMINK_NOT_FINITE); /* the axis of a torus */
    CHECK_STATUS(log_status(&lie, x, y), SURFMINK_CALLBACK_FAILED);
    CHECK_STATUS(surfmink_implicit_exp(&body, lost, direction, 1, point), SURFMINK_NOT_FINITE);
    CHECK_STATUS(surfmink_implicit_exp(&body, x, direction, HUGE_VAL, point), SURFMINK_NOT_FINITE);
    CHECK_STATUS(surfmink_implicit_exp(&body, x, direction, 1e6, point), SURFMINK_CALLBACK_FAILED); /* for ever */
    direction[0] = nan("");
    CHECK_STATUS(surfmink_implicit_exp(&body, x, direction, 1, point), SURFMINK_NOT_FINITE);
    direction[0] = 0;
    CHECK_STATUS(surfmink_implicit_exp(&body, x, direction, 1, point), SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(surfmink_implicit_log_near(&body, x, y, &length, direction, NULL), SURFMINK_BAD_ARGUMENT);
    direction[0] = 1;
    length = 0;
    CHECK_STATUS(surfmink_implicit_log_near(&body, x, y, &length, direction, NULL), SURFMINK_BAD_ARGUMENT);
    CHECK(point[0] == 7 && point[1] == 8 && point[2] == 9);
    CHECK_OK(surfmink_implicit_exp(&body, x, direction, 0, point));
    for (k = 0; k < 3; ++k) CHECK_NEAR(point[k], x[k], 3e-16);
    CHECK_STATUS(unrolled.log(unrolled.context, angles, angles, &length, direction), SURFMINK_COINCIDENT_CORNERS);
    /* Through the header the name comes back with the corner to blame. */
    for (k = 0; k < 3; ++k) corner[k] = x[k], corner[3 + k] = y[k], corner[6 + k] = -y[k];
    CHECK_STATUS(surfmink_measure(ON_SURFACE(&surface, corner, 3), 3, mu, NULL, NULL, &bad),
                 SURFMINK_ANTIPODAL_CORNERS);
    CHECK(bad == 1 || bad == 2);
    CHECK(mu[0] == 5 && mu[3] == 5);
}

/* --- the hyperbolic plane ----------------------------------------------------------------------------------------- */

static void random_hyperbolic(chance *c, double *x)
{
    double r = tanh(between(c, 0, 3)), angle = between(c, -PI, PI); /* up to 6 from the middle */
    x[0] = r * cos(angle);
    x[1] = r * sin(angle);
}

THEOREM(hyperbolic_distances_are_those_of_the_half_plane)
{
    chance c = {seed(22)};
    int trial;
    for (trial = 0; trial < 500; ++trial) {
        double x[2], y[2], length = 0, direction[2] = {1, 0}, half[2][2], *point[2], square;
        int k;
        random_hyperbolic(&c, x);
        random_hyperbolic(&c, y);
        point[0] = x, point[1] = y;
        for (k = 0; k < 2; ++k) { /* z -> i (1 + z)/(1 - z), an isometry onto y > 0 */
            double a = point[k][0], b = point[k][1], d = (1 - a) * (1 - a) + b * b;
            half[k][0] = -2 * b / d;
            half[k][1] = (1 - a * a - b * b) / d;
        }
        square = pow(half[0][0] - half[1][0], 2) + pow(half[0][1] - half[1][1], 2);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_hyperbolic_log(NULL, x, y, &length, direction));
        CHECK_CLOSE(length, acosh(1 + square / (2 * half[0][1] * half[1][1])), 1e-12);
        CHECK_NEAR(hypot(direction[0], direction[1]), 1, 3e-16);
    }
}

THEOREM(hyperbolic_triangles_obey_the_law_of_cosines)
{
    chance c = {seed(23)};
    int trial, i;
    for (trial = 0; trial < 300; ++trial) {
        surfmink_surface plane = surfmink_hyperbolic();
        double corner[6], l[3], turning[3], area = 0;
        surfmink_functionals w;
        for (i = 0; i < 3; ++i) random_hyperbolic(&c, corner + 2 * i);
        CHECK_OK(surfmink_hyperbolic_area(corner, 3, &area));
        if (fabs(area) < 1e-3) continue; /* the law of cosines has no digits for a needle */
        if (area < 0) surfmink_reverse(corner, 3, 2);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(ON_SURFACE(&plane, corner, 3), l, turning, NULL));
        for (i = 0; i < 3; ++i) { /* at corner i, between edges i-1 and i */
            double a = l[(i + 2) % 3], b = l[i], far = l[(i + 1) % 3];
            CHECK_NEAR(cos(PI - turning[i]), (cosh(a) * cosh(b) - cosh(far)) / (sinh(a) * sinh(b)), 1e-8);
        }
        CHECK_OK(surfmink_total(NULL, l, turning, 3, &w));
        CHECK_NEAR(w.turning, 2 * PI + fabs(area), 1e-11); /* sides of up to 12 */
    }
}

THEOREM(hyperbolic_exp_and_log_are_inverse_to_each_other)
{
    chance c = {seed(24)};
    int trial;
    for (trial = 0; trial < 500; ++trial) {
        double x[2], y[2], z[2], length = 0, direction[2], angle = between(&c, -PI, PI);
        double reach = trial % 2 ? between(&c, 0.1, 8) : pow(10, between(&c, -12, 0));
        random_hyperbolic(&c, x);
        random_hyperbolic(&c, y);
        CASE("trial %d: length %g", trial, reach);
        CHECK_OK(surfmink_hyperbolic_log(NULL, x, y, &length, direction));
        CHECK_OK(surfmink_hyperbolic_exp(NULL, x, direction, length, z));
        CHECK_NEAR(hypot(z[0] - y[0], z[1] - y[1]), 0, 1e-13);
        direction[0] = cos(angle);
        direction[1] = sin(angle);
        CHECK_OK(surfmink_hyperbolic_exp(NULL, x, direction, reach, z));
        CHECK_OK(surfmink_hyperbolic_log(NULL, x, z, &length, y));
        /* corners are rounded to 1e-16, and near the rim that is 1e-16 / (1 - |z|^2) of a length */
        CHECK_NEAR(length, reach, 3e-15 * (1 + 1 / (1 - hypot(z[0], z[1])) + 1 / (1 - hypot(x[0], x[1]))));
    }
}

THEOREM(regular_polygons_of_the_hyperbolic_plane)
{
    static const double reach[4] = {1e-7, 0.1, 1.5, 4};
    surfmink_surface plane = surfmink_hyperbolic();
    chance c = {seed(25)};
    size_t q, i;
    int size, p;
    for (q = 3; q <= 9; ++q)
        for (size = 0; size < 4; ++size) {
            double centre[2], corner[18], length[9], turning[9], mu[19], area = 0, inside;
            double r = reach[size], inherent;
            surfmink_functionals w;
            centre[0] = between(&c, -0.5, 0.5);
            centre[1] = between(&c, -0.5, 0.5);
            CASE("%d corners at %g", (int)q, r);
            CHECK_OK(surfmink_regular_polygon(&plane, centre, r, 0.4, q, corner));
            CHECK_OK(surfmink_edges(ON_SURFACE(&plane, corner, q), length, turning, NULL));
            CHECK_OK(surfmink_measure(ON_SURFACE(&plane, corner, q), 18, mu, NULL, &w, NULL));
            /* Rounding a corner to 1e-16 moves it by that, over 1 - |z|^2 near the rim, against a size of r. */
            inherent = size == 0 ? 2e-8 : size == 3 ? 1e-12 : 2e-14;
            for (p = 0; p <= 18; ++p) CHECK_NEAR(mu[p], p % (int)q ? 0 : 1, inherent);
            for (i = 0; i < q; ++i) CHECK_CLOSE(sinh(length[i] / 2), sinh(r) * sin(PI / (double)q), inherent);
            CHECK_OK(surfmink_hyperbolic_area(corner, q, &area));
            CHECK_NEAR(w.turning, 2 * PI + area, inherent);
            /* Half of an inner angle has the tangent cot(pi/q) / cosh r. */
            inside = 2 * atan(1 / (tan(PI / (double)q) * cosh(r)));
            if (r > 0.01)
                CHECK_NEAR(area, ((double)q - 2) * PI - (double)q * inside, inherent);
            else
                CHECK_CLOSE(area, (double)q / 2 * r * r * sin(2 * PI / (double)q), inherent);
        }
}

THEOREM(polygons_may_lie_anywhere_in_the_hyperbolic_plane)
{
    surfmink_surface plane = surfmink_hyperbolic();
    chance c = {seed(26)};
    int trial, p;
    for (trial = 0; trial < 50; ++trial) {
        double here[10], there[10], mu[2][7], area[2] = {0, 0}, a[2], length = 0, direction[2] = {1, 0};
        double spin = between(&c, -PI, PI);
        size_t i;
        gentle_star(&c, 5, here);
        for (i = 0; i < 10; ++i) here[i] *= 0.6;
        random_hyperbolic(&c, a);
        for (i = 0; i < 5; ++i) { /* laid out from a as it was from 0, and turned */
            static const double zero[2] = {0, 0};
            double turned[2];
            CHECK_OK(surfmink_hyperbolic_log(NULL, zero, here + 2 * i, &length, direction));
            turned[0] = cos(spin) * direction[0] - sin(spin) * direction[1];
            turned[1] = sin(spin) * direction[0] + cos(spin) * direction[1];
            CHECK_OK(surfmink_hyperbolic_exp(NULL, a, turned, length, there + 2 * i));
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(ON_SURFACE(&plane, here, 5), 6, mu[0], NULL, NULL, NULL));
        CHECK_OK(surfmink_measure(ON_SURFACE(&plane, there, 5), 6, mu[1], NULL, NULL, NULL));
        CHECK_OK(surfmink_hyperbolic_area(here, 5, &area[0]));
        CHECK_OK(surfmink_hyperbolic_area(there, 5, &area[1]));
        for (p = 1; p <= 6; ++p) CHECK_NEAR(mu[1][p], mu[0][p], 1e-12);
        CHECK_NEAR(area[1], area[0], 1e-12);
    }
}

THEOREM(points_that_are_not_in_the_hyperbolic_plane_are_refused)
{
    double x[2] = {0.1, 0.2}, rim[2] = {0, 1}, outside[2] = {1, 1}, lost[2], length = 7, direction[2] = {1, 0},
           y[2] = {8, 9};
    double corner[6] = {0, 0, 0.5, 0, 0, 1.5}, area = 5;
    lost[0] = nan("");
    lost[1] = 0;
    CHECK_STATUS(surfmink_hyperbolic_log(NULL, x, x, &length, direction), SURFMINK_COINCIDENT_CORNERS);
    CHECK_STATUS(surfmink_hyperbolic_log(NULL, x, rim, &length, direction), SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(surfmink_hyperbolic_log(NULL, outside, x, &length, direction), SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(surfmink_hyperbolic_log(NULL, lost, x, &length, direction), SURFMINK_NOT_FINITE);
    CHECK_STATUS(surfmink_hyperbolic_log(NULL, x, lost, &length, direction), SURFMINK_NOT_FINITE);
    CHECK_STATUS(surfmink_hyperbolic_exp(NULL, outside, direction, 1, y), SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(surfmink_hyperbolic_exp(NULL, lost, direction, 1, y), SURFMINK_NOT_FINITE);
    CHECK_STATUS(surfmink_hyperbolic_exp(NULL, x, direction, lost[0], y), SURFMINK_NOT_FINITE);
    CHECK_STATUS(surfmink_hyperbolic_exp(NULL, x, direction, 40, y), SURFMINK_NOT_FINITE); /* rounds onto the rim */
    CHECK_STATUS(surfmink_hyperbolic_area(corner, 3, &area), SURFMINK_BAD_ARGUMENT);
    CHECK_STATUS(surfmink_hyperbolic_area(corner, 2, &area), SURFMINK_TOO_FEW_CORNERS);
    CHECK(length == 7 && direction[0] == 1 && direction[1] == 0 && y[0] == 8 && y[1] == 9 && area == 5);
}

int main(void)
{
    PROVE(normals_and_curvature_have_their_closed_forms);
    PROVE(with_equal_axes_exp_and_log_are_those_of_the_sphere);
    PROVE(principal_sections_of_an_ellipsoid_are_geodesics);
    PROVE(clairauts_relation_holds_on_the_torus_and_on_spheroids);
    PROVE(joachimsthals_constant_holds_on_ellipsoids_with_three_axes);
    PROVE(distances_on_the_earth_are_those_of_karneys_test_set);
    PROVE(exp_of_log_is_the_other_point);
    PROVE(log_of_exp_is_the_direction_and_the_length);
    PROVE(log_from_the_other_end_is_the_same_geodesic);
    PROVE(small_shapes_keep_all_their_digits);
    PROVE(the_unit_of_length_does_not_matter);
    PROVE(a_surface_that_is_turned_in_space_has_the_same_geodesics);
    PROVE(points_off_the_surface_count_as_the_points_below_them);
    PROVE(geodesic_polygons_agree_with_50_digit_references);
    PROVE(torus_triangles_have_the_printed_lengths_angles_and_mu);
    PROVE(gauss_bonnet_for_triangles_of_ellipsoid_and_torus);
    PROVE(regular_polygons_of_a_round_ellipsoid);
    PROVE(the_chart_of_the_torus_chooses_how_often_an_edge_goes_round);
    PROVE(in_the_chart_of_the_torus_exp_of_log_is_the_other_corner);
    PROVE(log_finds_the_shortest_geodesic_and_log_near_the_guessed);
    PROVE(the_other_side_of_a_thin_body_is_far);
    PROVE(geodesics_that_are_not_unique_fail_by_name);
    PROVE(next_to_a_conjugate_point_log_still_hits);
    PROVE(no_geodesic_leads_from_one_sheet_to_another);
    PROVE(other_failures_have_names_too_and_change_nothing);
    PROVE(hyperbolic_distances_are_those_of_the_half_plane);
    PROVE(hyperbolic_triangles_obey_the_law_of_cosines);
    PROVE(hyperbolic_exp_and_log_are_inverse_to_each_other);
    PROVE(regular_polygons_of_the_hyperbolic_plane);
    PROVE(polygons_may_lie_anywhere_in_the_hyperbolic_plane);
    PROVE(points_that_are_not_in_the_hyperbolic_plane_are_refused);
    return QED();
}
