/* What the paper says in passing: remarks, inequalities of its proofs, sentences on its figures, each as it is printed
   or, where that is not true, as it has to be.
   cc -I. tests/test_statements.c -lm && ./a.out

   docs/internals/paper.md has the table from statements to theorems. The orders of convergence are in test_paper.c. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"
#include "examples/surfaces/ellipsoid.h"
#include "examples/paper/flower.h"
#include "chance.h"
#include "harness.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define P 6

enum { MOST = 8192 };

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void make_unit(double *a)
{
    double size = sqrt(dot(a, a));
    int k;
    for (k = 0; k < 3; ++k) a[k] /= size;
}

static double distance(const double *a, const double *b)
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static void some_vector(chance *c, double *a)
{
    do {
        a[0] = between(c, -1, 1);
        a[1] = between(c, -1, 1);
        a[2] = between(c, -1, 1);
    } while (dot(a, a) > 1 || dot(a, a) < 0.01);
    make_unit(a);
}

static double largest_difference(const double *mu, const double *other)
{
    double largest = 0;
    int p;
    for (p = 1; p <= P; ++p) largest = fmax(largest, fabs(mu[p] - other[p]));
    return largest;
}

/* --- Lemma 3.4: isometries of the manifold, here such that are no motions of space -------------------------------- */

enum { CORNERS = 7, FLAT = 0, CYLINDER, CONE };

/* A star about (0, 0), counter-clockwise, with deep dents. */
static void some_star(chance *c, double xy[2 * CORNERS])
{
    int i;
    for (i = 0; i < CORNERS; ++i) {
        double angle = 2 * PI * (i + between(c, -0.3, 0.3)) / CORNERS, radius = between(c, 0.3, 1);
        xy[2 * i] = radius * cos(angle);
        xy[2 * i + 1] = radius * sin(angle);
    }
}

/* A point of the flat sheet, rolled. The cone has its apex at (-1.5, 0) of the sheet, outside the stars; stretch other
   than 1 is no isometry. */
static void roll(int onto, const double *flat, double stretch, double *x, double *normal)
{
    const double radius = 0.6, slope = 0.7; /* of the cylinder; sine of the half angle of the cone */
    double u = stretch * flat[0], v = flat[1], angle, far, steep = sqrt(1 - slope * slope);
    if (onto == CYLINDER) {
        angle = u / radius;
        x[0] = radius * (normal[0] = cos(angle));
        x[1] = radius * (normal[1] = sin(angle));
        x[2] = v;
        normal[2] = 0;
    } else {
        far = hypot(u + 1.5, v);
        angle = atan2(v, u + 1.5) / slope;
        x[0] = far * slope * cos(angle);
        x[1] = far * slope * sin(angle);
        x[2] = -far * steep;
        normal[0] = steep * cos(angle);
        normal[1] = steep * sin(angle);
        normal[2] = slope;
    }
}

/* mu of the rolled star, with so many points on each edge; W_1 and W_2 with it. */
static void measure_rolled(int onto, const double *xy, double stretch, size_t points, double *mu,
                           surfmink_functionals *w)
{
    static double corner[3 * MOST], normal[3 * MOST];
    surfmink_outline o;
    double flat[2];
    size_t i, j, n = 0;
    for (i = 0; i < CORNERS; ++i)
        for (j = 0; j < points; ++j, ++n) {
            const double *from = xy + 2 * i, *to = xy + 2 * ((i + 1) % CORNERS);
            double t = (double)j / (double)points;
            flat[0] = from[0] + t * (to[0] - from[0]);
            flat[1] = from[1] + t * (to[1] - from[1]);
            roll(onto, flat, stretch, corner + 3 * n, normal + 3 * n);
        }
    o = surfmink_embedded(corner, normal, n);
    CHECK_OK(surfmink_measure(&o, P, mu, NULL, w, NULL));
}

THEOREM(a_polygon_rolled_on_a_cylinder_or_a_cone_keeps_its_mu)
{
    chance c = {34};
    surfmink_functionals w[4];
    double xy[2 * CORNERS], mu[4][P + 1], off[2];
    int round, onto, p;
    for (round = 0; round < 20; ++round)
        for (onto = CYLINDER; onto <= CONE; ++onto) {
            surfmink_outline flat;
            CASE("%s, star %d", onto == CONE ? "cone" : "cylinder", round);
            some_star(&c, xy);
            flat = surfmink_plane(xy, CORNERS);
            CHECK_OK(surfmink_measure(&flat, P, mu[0], NULL, &w[0], NULL));
            measure_rolled(onto, xy, 1, 64, mu[1], &w[1]);
            measure_rolled(onto, xy, 1, 256, mu[2], &w[2]);
            for (p = 0; p < 2; ++p) off[p] = largest_difference(mu[p + 1], mu[0]);
            CHECK(off[1] < 2e-3);
            CHECK_NEAR(log2(off[0] / off[1]) / 2, 2, 0.1); /* chords: order 2 */
            CHECK_CLOSE(w[2].length, w[0].length, 1e-3);
            CHECK_NEAR(w[2].turning, 2 * PI, 1e-3);
            measure_rolled(onto, xy, 1.3, 256, mu[3], &w[3]);
            CHECK(largest_difference(mu[3], mu[0]) > 20 * off[1]); /* a sheet that is stretched first */
        }
}

/* --- after Lemma 3.7: conformal changes of the metric ------------------------------------------------------------- */

/* A flower of the plane and its image on the unit sphere by stereographic projection from the south pole, which keeps
   angles and multiplies lengths by 2 / (1 + |x|^2). */
static void petals(double size, size_t n, double *xy, double *xyz)
{
    size_t i;
    for (i = 0; i < n; ++i) {
        double t = 2 * PI * (double)i / (double)n, r = size * (1 + 0.25 * sin(3 * t) + 0.2 * cos(2 * t)), square;
        double *x = xy + 2 * i, *y = xyz + 3 * i;
        x[0] = r * cos(t) + 0.3 * size;
        x[1] = r * sin(t);
        square = x[0] * x[0] + x[1] * x[1];
        y[0] = 2 * x[0] / (1 + square);
        y[1] = 2 * x[1] / (1 + square);
        y[2] = (1 - square) / (1 + square);
    }
}

THEOREM(a_conformal_map_changes_mu_unless_it_is_a_scaling)
{
    static double xy[2 * MOST], xyz[3 * MOST];
    static const double size[4] = {0.6, 0.3, 0.15, 0.001};
    double flat[P + 1], round[P + 1], off[4];
    surfmink_outline o;
    int k;
    for (k = 0; k < 4; ++k) {
        CASE("size %g", size[k]);
        petals(size[k], 4096, xy, xyz);
        o = surfmink_plane(xy, 4096);
        CHECK_OK(surfmink_measure(&o, P, flat, NULL, NULL, NULL));
        o = surfmink_sphere(xyz, 4096, 1);
        CHECK_OK(surfmink_measure(&o, P, round, NULL, NULL, NULL));
        off[k] = largest_difference(flat, round);
    }
    CHECK(off[0] > 0.05);
    CHECK(off[1] > 0.01);
    CHECK(off[2] < off[1] && off[1] < off[0]);
    CHECK(off[3] < 1e-5); /* nearly constant: twice as large, and the same */
}

/* The integral of the new curvature is that of k_g + d phi / d nu over the old length. (The paper has a factor
   exp(-phi) in it, which belongs to the curvature itself and goes with the new length.) */
THEOREM(a_conformal_map_adds_the_normal_derivative_to_curvature)
{
    static double xy[2 * MOST], xyz[3 * MOST], length[MOST], turning[MOST];
    double sum[2][2], off[2], normal[2], printed, factor;
    surfmink_functionals w;
    surfmink_outline o;
    size_t n, i;
    int level, k;
    for (level = 0; level < 2; ++level) {
        n = (size_t)1024 << level;
        petals(0.6, n, xy, xyz);
        o = surfmink_plane(xy, n);
        CHECK_OK(surfmink_edges(&o, length, turning, NULL));
        for (sum[level][0] = sum[level][1] = 0, i = 0; i < n; ++i) {
            const double *x = xy + 2 * i, *before = xy + 2 * ((i + n - 1) % n), *after = xy + 2 * ((i + 1) % n);
            double square = x[0] * x[0] + x[1] * x[1], ds = (length[(i + n - 1) % n] + length[i]) / 2, across;
            normal[0] = after[1] - before[1]; /* outer: to the right of the way */
            normal[1] = before[0] - after[0];
            across = -2 * (x[0] * normal[0] + x[1] * normal[1]) / (1 + square) / hypot(normal[0], normal[1]);
            factor = 2 / (1 + square);
            sum[level][0] += turning[i] + across * ds;
            sum[level][1] += (turning[i] + across * ds) / factor;
        }
        o = surfmink_sphere(xyz, n, 1);
        CHECK_OK(surfmink_measure(&o, 1, NULL, NULL, &w, NULL));
        off[level] = fabs(sum[level][0] - w.turning);
        printed = fabs(sum[level][1] - w.turning);
        CHECK(printed > 0.3);
    }
    for (k = 0; k < 2; ++k) CHECK(off[k] < 1e-4);
    CHECK_NEAR(log2(off[0] / off[1]), 2, 0.1);
}

/* --- Remark 2.2: closed geodesics --------------------------------------------------------------------------------- */

/* Refused by name; with the defect eta set to zero, which leaves parallel transport, the co-normal stays what it is all
   the way: mu_p = 1 for all p, wherever it is read. */
static void goes_straight(const surfmink_outline *o)
{
    static double length[MOST], turning[MOST], phase[MOST];
    double mu[P + 1], g[2 * P + 2], frame[9], carried[3];
    surfmink_functionals w;
    size_t edge, n = o->n;
    int p;
    CHECK_STATUS(surfmink_measure(o, P, mu, NULL, NULL, NULL), SURFMINK_TOO_MUCH_CURVATURE);
    CHECK_OK(surfmink_edges(o, length, turning, NULL));
    CHECK_STATUS(surfmink_total(NULL, length, turning, n, &w), SURFMINK_TOO_MUCH_CURVATURE);
    CHECK_STATUS(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase), SURFMINK_TOO_MUCH_CURVATURE);
    CHECK_STATUS(surfmink_phases(turning, n, SURFMINK_DEFECT, phase), SURFMINK_TOO_MUCH_CURVATURE);
    CHECK_OK(surfmink_phases(turning, n, SURFMINK_PARALLEL, phase));
    CHECK_OK(surfmink_irreducible(length, phase, n, P, g));
    CHECK_OK(surfmink_spectrum(g, P, NULL, mu, NULL));
    for (p = 1; p <= P; ++p) CHECK_NEAR(mu[p], 1, 1e-13);
    for (edge = 0; edge < n; edge += n / 4) {
        CHECK_OK(surfmink_irreducible_parallel(length, turning, n, edge, 0.3, P, g));
        CHECK_OK(surfmink_spectrum(g, P, NULL, mu, NULL));
        for (p = 1; p <= P; ++p) CHECK_NEAR(mu[p], 1, 1e-13);
        CHECK_OK(surfmink_frame(o, 0, frame));
        memcpy(carried, frame, sizeof carried);
        CHECK_OK(surfmink_transport_vector(o, turning, 0, (ptrdiff_t)edge, SURFMINK_PARALLEL, carried));
        CHECK_NEAR(distance(carried, frame), 0, 1e-13); /* in space, too: across the plane of the curve */
    }
}

THEOREM(a_closed_geodesic_without_the_defect_has_mu_one)
{
    static double corner[3 * 64], normal[3 * 64];
    static const double axis[3] = {1.6, 1.3, 1.0};
    surfmink_outline o;
    size_t i;
    for (i = 0; i < 64; ++i) {
        double angle = 2 * PI * ((double)i + 0.3 * sin((double)i)) / 64;
        normal[3 * i] = corner[3 * i] = cos(angle);
        normal[3 * i + 1] = corner[3 * i + 1] = sin(angle);
        normal[3 * i + 2] = corner[3 * i + 2] = 0;
        corner[3 * i] *= axis[0];
        corner[3 * i + 1] *= axis[1];
        normal[3 * i] /= axis[0];
        normal[3 * i + 1] /= axis[1];
    }
    CASE("a great circle");
    o = surfmink_sphere(corner, 64, 1); /* directions count */
    goes_straight(&o);
    CASE("a principal ellipse of an ellipsoid");
    o = surfmink_embedded(corner, normal, 64);
    goes_straight(&o);
}

/* Paper 2.3: no construction with regular polygons at one is continuous there. */
THEOREM(a_regular_polygon_keeps_its_mu_up_to_the_great_circle)
{
    double corner[15] = {0}, mu[P + 1], height;
    surfmink_outline o = surfmink_sphere(corner, 5, 1);
    int i, p;
    for (height = 0.5; height > 1e-9; height /= 10) {
        CASE("height %g", height);
        for (i = 0; i < 5; ++i) {
            corner[3 * i] = cos(2 * PI * i / 5);
            corner[3 * i + 1] = sin(2 * PI * i / 5);
            corner[3 * i + 2] = height;
        }
        CHECK_OK(surfmink_measure(&o, P, mu, NULL, NULL, NULL));
        for (p = 1; p <= P; ++p) CHECK_NEAR(mu[p], p == 5, 1e-14);
    }
    for (i = 0; i < 5; ++i) corner[3 * i + 2] = 0;
    CHECK_STATUS(surfmink_measure(&o, P, mu, NULL, NULL, NULL), SURFMINK_TOO_MUCH_CURVATURE);
}

/* --- Remark 3.3: tensors, not only their trace-free parts --------------------------------------------------------- */

/* The tensor applied to p copies of the vector at this angle: sum l_i cos^p(f_i - angle). */
static double applied(const double *tensor, int p, double angle)
{
    double sum = 0, binomial = 1;
    int j;
    for (j = 0; j <= p; binomial *= (double)(p - j) / (j + 1), ++j)
        sum += binomial * tensor[j] * pow(cos(angle), p - j) * pow(sin(angle), j);
    return sum;
}

THEOREM(tensors_at_two_edges_are_transports_of_each_other)
{
    chance c = {33};
    double xy[2 * CORNERS], corner[3 * CORNERS], later[3 * CORNERS], length[CORNERS], turning[CORNERS], phase[CORNERS];
    double g[2 * P + 2], first[P + 1], second[P + 1], angle;
    int round, i, k, p;
    for (round = 0; round < 20; ++round) {
        surfmink_outline o = surfmink_sphere(corner, CORNERS, 1), turned = surfmink_sphere(later, CORNERS, 1);
        some_star(&c, xy);
        for (i = 0; i < CORNERS; ++i) {
            corner[3 * i] = 0.8 * xy[2 * i];
            corner[3 * i + 1] = 0.8 * xy[2 * i + 1];
            corner[3 * i + 2] = 1;
        }
        CHECK_OK(surfmink_edges(&o, length, turning, NULL));
        CHECK_OK(surfmink_phases(turning, CORNERS, SURFMINK_CORRECTED, phase));
        for (k = 1; k < CORNERS; ++k)
            for (p = 1; p <= P; ++p) {
                CASE("star %d, edge %d, p = %d", round, k, p);
                for (i = 0; i < 3 * CORNERS; ++i) later[i] = corner[(i + 3 * k) % (3 * CORNERS)];
                CHECK_OK(surfmink_measure(&o, P, NULL, g, NULL, NULL));
                CHECK_OK(surfmink_tensor(g, p, first));
                CHECK_OK(surfmink_measure(&turned, P, NULL, g, NULL, NULL));
                CHECK_OK(surfmink_tensor(g, p, second));
                for (angle = 0; angle < 3; angle += 0.4)
                    CHECK_NEAR(applied(second, p, angle), applied(first, p, angle + phase[k]), 1e-13);
            }
    }
}

/* --- Remark 4.1: lengths, edge by edge ---------------------------------------------------------------------------- */

enum { UNIFORM, GRADED, JITTERED, PARTITIONS };

static double position(int partition, size_t i, size_t n)
{
    chance c = {((uint64_t)n << 32) + (uint64_t)i};
    double x = (double)i / (double)n;
    if (partition == GRADED) return x + 0.1 * sin(2 * PI * x);
    if (partition == JITTERED && i > 0 && i < n) return x + 0.35 * between(&c, -1, 1) / (double)n;
    return x;
}

/* |k_g| of a flower. */
static double geodesic_curvature(const flower *curve, double t)
{
    double x[3], n[3], d[3], dd[3], left[3];
    flower_point(curve, t, x, n, d, dd);
    cross(d, dd, left);
    return fabs(dot(n, left)) / pow(dot(d, d), 1.5);
}

static const flower three_petals = {{1.6, 1.3, 1.0}, 0.7, 0.2, 3, PI / 2, PI / 4};

THEOREM(an_arc_is_longer_than_its_edge_by_its_cube_at_most)
{
    static flower_exact exact;
    static double corner[3 * MOST], arc[MOST + 1], length[MOST], turning[MOST], bend[MOST];
    surfmink_implicit body = surfmink_ellipsoid(three_petals.axis);
    surfmink_surface surface = surfmink_implicit_surface(&body);
    double normal[3], d[3], dd[3], most, sharpest, sum, widest, ratio;
    surfmink_outline o;
    size_t n, i;
    int partition, k;
    flower_integrate(&three_petals, &exact);
    for (partition = 0; partition < PARTITIONS; ++partition)
        for (n = 128; n <= 512; n *= 2) {
            CASE("partition %d, %d corners", partition, (int)n);
            for (i = 0; i <= n; ++i) arc[i] = exact.length * position(partition, i, n);
            for (sharpest = 0, i = 0; i < n; ++i) {
                flower_point(&three_petals, flower_time(&exact, arc[i]), corner + 3 * i, normal, d, dd);
                for (bend[i] = 0, k = 0; k <= 8; ++k) /* the sharpest bend of the arc */
                    bend[i] =
                        fmax(bend[i], geodesic_curvature(&three_petals,
                                                         flower_time(&exact, arc[i] + (arc[i + 1] - arc[i]) * k / 8)));
                sharpest = fmax(sharpest, bend[i]);
            }
            o = surfmink_on_surface(&surface, corner, n);
            CHECK_OK(surfmink_edges(&o, length, turning, NULL));
            for (most = sum = widest = 0, i = 0; i < n; ++i) {
                double delta = arc[i + 1] - arc[i], off = delta - length[i];
                CHECK(off > -1e-13);
                CHECK(off <= bend[i] * bend[i] / 24 * pow(delta, 3) * (1 + delta) + 1e-13);
                most = fmax(most, off / pow(delta, 3));
                widest = fmax(widest, delta);
                sum += off;
            }
            ratio = most / (sharpest * sharpest / 24);
            CHECK(ratio > 0.8 && ratio < 1 + widest); /* so C = k^2 / 24 is no larger than needed */
            CHECK(sum <= sharpest * sharpest / 24 * exact.length * widest * widest * (1 + widest));
        }
}

/* --- Remark 4.3: curves of class C2 only -------------------------------------------------------------------------- */

/* A closed curve of the plane with curvature 1 + |s|^(1/2) + const on each of four equal parts, s from its middle: C2,
   not C3. Its direction there is s (1 + ..) + (2/3) |s|^(3/2); positions by Gauss's rule in the root of s. */
static double rough_half, rough_level; /* half of a part; the constant makes a part turn by a right angle */

static void rough_step(double s, double *xy)
{
    static const double node[5] = {0, 0.5384693101056831, -0.5384693101056831, 0.9061798459386640, -0.9061798459386640},
                        weight[5] = {0.5688888888888889, 0.4786286704993665, 0.4786286704993665, 0.2369268850561891,
                                     0.2369268850561891};
    double root = sqrt(fabs(s)), sign = s < 0 ? -1 : 1, a;
    int panel, k;
    xy[0] = xy[1] = 0;
    for (panel = 0; panel < 40; ++panel)
        for (k = 0; k < 5; ++k) {
            double t = root * (panel + 0.5 + node[k] / 2) / 40, u = t * t;
            a = rough_level * u + 2 * u * t / 3;
            xy[0] += weight[k] * root / 80 * 2 * t * cos(a);
            xy[1] += weight[k] * root / 80 * 2 * t * sin(a);
        }
    xy[0] *= sign; /* odd, and even */
}

/* Point i of n = 4 m, where point 0 is the middle of a part. */
static void rough_polygon(size_t m, double *xy)
{
    double end[2], start[2], here[2], c, s;
    size_t i, part;
    rough_half = 0.7;
    rough_level = (PI / 4 - 2 * pow(rough_half, 1.5) / 3) / rough_half;
    rough_step(rough_half, end);
    rough_step(-rough_half, start);
    for (i = 0; i < m; ++i) rough_step(2 * rough_half * ((double)i - (double)(m / 2)) / (double)m, xy + 2 * i);
    /* The next part begins where this one ends, turned by a right angle: (x, y) -> end + R ((x, y) - start). */
    for (part = 1; part < 4; ++part)
        for (i = 0; i < m; ++i) {
            const double *last = xy + 2 * ((part - 1) * m + i);
            here[0] = last[0];
            here[1] = last[1];
            c = 0, s = 1;
            xy[2 * (part * m + i)] = end[0] + c * (here[0] - start[0]) - s * (here[1] - start[1]);
            xy[2 * (part * m + i) + 1] = end[1] + s * (here[0] - start[0]) + c * (here[1] - start[1]);
        }
}

THEOREM(on_a_curve_of_class_c2_only_angles_have_order_three_halves)
{
    static double xy[2 * MOST], length[MOST], turning[MOST];
    double off[4], smooth[4], delta;
    surfmink_functionals w;
    surfmink_outline o;
    int level;
    for (level = 0; level < 4; ++level) {
        size_t m = (size_t)64 << level, at = m / 2, between_ = m / 2 + m / 4;
        rough_polygon(m, xy);
        o = surfmink_plane(xy, 4 * m);
        CHECK_OK(surfmink_measure(&o, 1, NULL, NULL, &w, NULL)); /* it closes, and turns once */
        CHECK_OK(surfmink_edges(&o, length, turning, NULL));
        delta = 2 * rough_half / (double)m;
        CHECK_CLOSE(length[4 * m - 1], length[m - 1], 1e-9);
        off[level] = fabs(turning[at] - rough_level * delta);
        smooth[level] = fabs(turning[between_] - (rough_level + sqrt(rough_half / 2)) * delta);
        CHECK(off[level] > 0.3 * pow(delta, 1.5) && off[level] < 0.8 * pow(delta, 1.5));
        CHECK(off[level] / delta < 0.8 * sqrt(delta)); /* yet the angles converge to the curvature */
    }
    CHECK_NEAR(log2(off[0] / off[3]) / 3, 1.5, 0.01);
    CHECK_NEAR(log2(smooth[0] / smooth[3]) / 3, 3, 0.05); /* where it is smooth: Remark 4.3, equal edges */
}

/* --- Corollary 4.5: the constant ---------------------------------------------------------------------------------- */

/* f_i is the phase of the curve from the middle of edge 0 to the middle of edge i. Against f(s, 0) it is off by what
   the curve turns in half an edge, at both ends, times 2 pi / kappa: C = pi (|k_g(0)| + max |k_g|) / kappa, with the
   inverse of the total curvature, and no smaller C does. */
THEOREM(the_constant_of_f_is_curvature_over_total_curvature)
{
    static flower_exact exact;
    static double corner[3 * 2048], normal[3 * 2048], turning[2048], length[2048], phase[2048];
    static const double radius[4] = {0.4, 0.8, 1.1, 1.3};
    flower curve = {{1, 1, 1}, 0, 0.1, 4, PI / 2, PI / 4};
    double last = 0;
    int r, k;
    for (r = 0; r < 4; ++r) {
        double sharpest = 0, worst = 0, bound, t;
        size_t n = 2048, i;
        surfmink_outline o = surfmink_embedded(corner, normal, n);
        curve.r0 = radius[r];
        CASE("r0 = %g", curve.r0);
        flower_integrate(&curve, &exact);
        flower_polygon(&exact, n, corner, normal);
        CHECK_OK(surfmink_edges(&o, length, turning, NULL));
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
        for (i = 0; i < n; ++i)
            for (k = 0; k <= 2; ++k) { /* s_i <= s <= s_(i+1) */
                t = flower_time(&exact, exact.length * ((double)i + k / 2.0) / (double)n);
                sharpest = fmax(sharpest, geodesic_curvature(&curve, t));
                worst = fmax(worst, fabs(flower_phase(&exact, t) - phase[i]));
            }
        bound = PI * (sharpest + geodesic_curvature(&curve, 0)) / exact.kappa * exact.length / (double)n;
        CHECK_NEAR(worst / bound, 1, 0.02);
        CHECK(PI / exact.kappa > last); /* kappa falls */
        last = PI / exact.kappa;
    }
    CHECK(exact.kappa < 2.1);
}

/* --- Lemmas 4.7, 4.9, 4.10 and Corollary 4.11: angles of perturbed vectors ---------------------------------------- */

static double angle_between(const double *a, const double *b)
{
    double c[3];
    cross(a, b, c);
    return atan2(sqrt(dot(c, c)), dot(a, b));
}

/* 2 arcsin(d / 2) <= d + d^3 / 21.2 up to d = 1: C = 1 / 21, and hardly less, as arcs of great circles show. */
THEOREM(an_angle_changes_by_no_more_than_its_vectors)
{
    chance c = {47};
    double v[3], w[3], off[3], near_v[3], d, tightest = 0, change;
    int round, k;
    for (round = 0; round < 100000 / FEWER + 100; ++round) {
        double share = magnitude(&c, 1e-6, 1);
        some_vector(&c, v);
        some_vector(&c, w);
        if (round % 2) /* along the great circle through both: the worst that can be */
            for (k = 0; k < 3; ++k) off[k] = w[k] - dot(v, w) * v[k];
        else
            some_vector(&c, off);
        for (k = 0; k < 3; ++k) near_v[k] = v[k] + share * off[k];
        make_unit(near_v);
        d = distance(v, near_v);
        if (d > 1) continue;
        change = fabs(angle_between(v, w) - angle_between(near_v, w));
        CHECK(change <= d + d * d * d / 21 + 1e-15);
        if (d > 0.5) tightest = fmax(tightest, (change - d) / (d * d * d));
    }
    CHECK(tightest > 1.0 / 24);
}

/* The cosine of the turn at corner 1 of the outline -v, 0, w: of P v and P w, where P projects along the normal. */
static double cosine(const double *v, const double *w, const double *normal)
{
    double corner[9] = {0}, normals[9] = {0}, length[3], turning[3];
    surfmink_outline o = surfmink_embedded(corner, normals, 3);
    int k;
    for (k = 0; k < 3; ++k) {
        corner[k] = -v[k];
        corner[3 + k] = 0;
        corner[6 + k] = w[k];
        normals[k] = normals[3 + k] = normals[6 + k] = normal[k];
    }
    CHECK_OK(surfmink_edges(&o, length, turning, NULL));
    return cos(turning[1]);
}

/* A normal; one that is off by h; two unit vectors at a right angle to the first and at a given angle to each other,
   then moved by `tilt` along the normal, one up and one down. */
static void some_pair(chance *c, double h, double apart, double tilt, double *n, double *n_h, double *v, double *w)
{
    double off[3], left[3];
    int k;
    some_vector(c, n);
    some_vector(c, off);
    for (k = 0; k < 3; ++k) n_h[k] = n[k] + h * off[k];
    make_unit(n_h);
    some_vector(c, v);
    cross(n, v, left);
    make_unit(left);
    cross(left, n, v);
    for (k = 0; k < 3; ++k) w[k] = cos(apart) * v[k] + sin(apart) * left[k];
    for (k = 0; k < 3; ++k) {
        v[k] += tilt * n[k];
        w[k] -= tilt * n[k];
    }
}

enum inequality { LEMMA_9, LEMMA_10, COROLLARY_11, EDGES_OF_LENGTH_H };

/* The change of the cosine over what bounds it but for a constant: h^4 + h^2 |v - w|^2 (Lemma 4.9), without the square
   in the other two; v and w are here the projected unit vectors. Vectors move by h^2 / 2 at most in the last two. */
static double largest_ratio(enum inequality which, double h, double apart)
{
    chance c = {49};
    double n[3], n_h[3], v[3], w[3], v_h[3], w_h[3], a[3], b[3], gap = 2 * sin(apart / 2), most = 0;
    double size = which == EDGES_OF_LENGTH_H ? h : 1, moved = which >= COROLLARY_11 ? h * h / 2 : 0;
    double bound = pow(h, 4) + h * h * (which == LEMMA_9 ? gap * gap : gap);
    int round, k;
    CASE("h = %g, angle %g", h, apart);
    for (round = 0; round < 500; ++round) {
        some_pair(&c, h, apart, which == LEMMA_9 ? 0 : h * between(&c, -1, 1), n, n_h, v, w);
        some_vector(&c, a);
        some_vector(&c, b);
        for (k = 0; k < 3; ++k) {
            v_h[k] = size * v[k] + moved * a[k];
            w_h[k] = size * w[k] + moved * b[k];
        }
        most = fmax(most, fabs(cosine(v_h, w_h, n_h) - cosine(v, w, n)) / bound);
    }
    return most;
}

static const double tilts[4] = {0.1, 0.03, 0.01, 0.003};

/* With this constant, which is no larger than needed. */
static void cosines_hold(enum inequality which, double constant)
{
    static const double aparts[5] = {0.003, 0.03, 0.3, 1.5, 3};
    double largest = 0, ratio;
    int i, j;
    for (i = 0; i < 4; ++i)
        for (j = 0; j < 5; ++j) {
            ratio = largest_ratio(which, tilts[i], aparts[j]);
            CHECK(ratio <= constant);
            if (j == 2 || j == 3) CHECK(ratio > constant / 3); /* so at every h: the order is right, too */
            largest = fmax(largest, ratio);
        }
    CHECK(largest > 0.8 * constant);
}

THEOREM(tilted_normals_change_cosines_as_lemma_4_9_says)
{
    cosines_hold(LEMMA_9, 0.5);
}

THEOREM(so_they_do_of_vectors_off_the_tangent_plane_lemma_4_10)
{
    cosines_hold(LEMMA_10, 2);
}

/* Corollary 4.11 for vectors of length 1. Edges, which the paper puts in for them, are as short as h: moved by h^2
   their directions change by h, and the bound is missed by a factor of 1 / h. Yet f converges, because neighbouring
   turns change by opposite amounts: their sum sees only the ends (test_paper.c measures it). */
THEOREM(points_off_by_h2_change_cosines_of_unit_vectors_only_so_much)
{
    double ratio[4];
    int i;
    cosines_hold(COROLLARY_11, 3);
    for (i = 0; i < 4; ++i) ratio[i] = largest_ratio(EDGES_OF_LENGTH_H, tilts[i], tilts[i]);
    CHECK_NEAR(log(ratio[3] / ratio[0]) / log(tilts[0] / tilts[3]), 1, 0.1);
}

/* --- paper 5.2: the column f of Table 1
   ---------------------------------------------------------------------------- */

/* With the index of section 4, as the table has it, f_i misses the turn at corner i: the printed 1.2, .34, .088 are the
   largest |f - f_i| at corners. Over all of each edge, as Corollary 4.5 has it, they are larger. */
THEOREM(the_printed_errors_of_f_are_those_at_corners)
{
    static flower_exact exact;
    static double corner[3 * 256], normal[3 * 256], length[256], turning[256], late[256], phase[256];
    static const flower curve = {{1, 1, 1}, 0.7, 0.2, 3, PI / 2, PI / 4};
    static const double printed[4] = {2.4, 1.2, 0.34, 0.088}, everywhere[4] = {2.4, 1.6, 0.76, 0.24};
    double at_corners, worst, off;
    size_t n, i;
    int row, k;
    flower_integrate(&curve, &exact);
    for (row = 0, n = 4; n <= 256; n *= 4, ++row) {
        surfmink_outline o = surfmink_sphere(corner, n, 1);
        CASE("%d corners", (int)n);
        flower_polygon(&exact, n, corner, normal);
        CHECK_OK(surfmink_edges(&o, length, turning, NULL));
        for (i = 0; i < n; ++i) late[(i + 1) % n] = turning[i];
        CHECK_OK(surfmink_phases(late, n, SURFMINK_CORRECTED, phase));
        for (at_corners = worst = 0, i = 0; i < n; ++i)
            for (k = 0; k <= 32; ++k) {
                double t = flower_time(&exact, exact.length * ((double)i + k / 32.0) / (double)n);
                off = fabs(flower_phase(&exact, t) - phase[i]);
                if (k == 0) at_corners = fmax(at_corners, off);
                worst = fmax(worst, off);
            }
        CHECK_CLOSE(at_corners, printed[row], 0.03);
        CHECK_CLOSE(worst, everywhere[row], 0.03);
    }
}

/* --- paper 5.3: sentences on the sweeps --------------------------------------------------------------------------- */

/* mu of a flower on E(1.6, 1.3, 1.0), by Richardson's extrapolation from 1024 and 2048 chords. */
static void measure_flower(double r0, double a, int omega, double y0, double *mu)
{
    enum { CHORDS = 2048 };
    static flower_exact exact;
    static double corner[3 * CHORDS], normal[3 * CHORDS];
    flower curve = {{1.6, 1.3, 1.0}, 0, 0, 0, PI / 2, 0};
    double coarse[P + 1];
    surfmink_outline o;
    int p;
    curve.r0 = r0;
    curve.a = a;
    curve.omega = omega;
    curve.y0 = y0 * PI;
    flower_integrate(&curve, &exact);
    flower_polygon(&exact, CHORDS / 2, corner, normal);
    o = surfmink_embedded(corner, normal, CHORDS / 2);
    CHECK_OK(surfmink_measure(&o, P, coarse, NULL, NULL, NULL));
    flower_polygon(&exact, CHORDS, corner, normal);
    o = surfmink_embedded(corner, normal, CHORDS);
    CHECK_OK(surfmink_measure(&o, P, mu, NULL, NULL, NULL));
    for (p = 0; p <= P; ++p) mu[p] = (4 * mu[p] - coarse[p]) / 3;
}

/* "mostly mu_2 and mu_5 obtain the highest values": of mu_2 ... mu_6 they are the two largest in 17 of 20. */
THEOREM(mu_2_and_mu_5_are_largest_in_17_of_20_flowers)
{
    static const double amplitude[8] = {0, 0.025, 0.05, 0.075, 0.1, 0.125, 0.15, 0.2};
    double mu[20][P + 1];
    int i, p, flowers = 0, largest = 0;
    for (i = 0; i < 8; ++i) measure_flower(0.4, amplitude[i], 5, 0.25, mu[flowers++]);
    for (i = 2; i < 8; ++i) measure_flower(i / 10.0, 0.1, 5, 0.25, mu[flowers++]);
    for (i = 3; i < 8; i += 2) measure_flower(0.4, 0.1, i, 0.25, mu[flowers++]);
    for (i = 1; i < 4; ++i) measure_flower(0.4, 0.1, 5, i / 8.0, mu[flowers++]);
    CHECK_EQUAL(flowers, 20);
    for (i = 0; i < flowers; ++i) {
        double least = fmin(mu[i][2], mu[i][5]), other = 0;
        for (p = 2; p <= 6; ++p)
            if (p != 2 && p != 5) other = fmax(other, mu[i][p]);
        largest += least > other;
    }
    CHECK_EQUAL(largest, 17);
}

THEOREM(three_petals_raise_mu_3_and_three_or_seven_lower_mu_5)
{
    double three[P + 1], five[P + 1], seven[P + 1];
    measure_flower(0.4, 0.1, 3, 0.25, three);
    measure_flower(0.4, 0.1, 5, 0.25, five);
    measure_flower(0.4, 0.1, 7, 0.25, seven);
    CHECK_NEAR(three[3], 0.395, 5e-4);
    CHECK_NEAR(five[3], 0.036, 5e-4);
    CHECK_NEAR(three[5], 0.163, 5e-4);
    CHECK_NEAR(five[5], 0.360, 5e-4);
    CHECK_NEAR(seven[5], 0.095, 5e-4);
}

THEOREM(mu_2_falls_where_the_surface_curves_more)
{
    static const double want[3] = {0.286, 0.236, 0.174};
    double mu[P + 1], axis[3] = {1.6, 1.3, 1.0}, x[3], curvature = 0, last = 0;
    surfmink_implicit body = surfmink_ellipsoid(axis);
    int i;
    for (i = 0; i < 3; ++i) {
        double y0 = (3 - i) / 8.0;
        CASE("y0 = %g pi", y0);
        measure_flower(0.4, 0.1, 5, y0, mu);
        CHECK_NEAR(mu[2], want[i], 5e-4);
        surfmink_ellipsoid_point(axis, PI / 2, y0 * PI, x);
        CHECK_OK(surfmink_implicit_curvature(&body, x, &curvature));
        CHECK(curvature > last);
        last = curvature;
    }
}

int main(void)
{
    PROVE(a_polygon_rolled_on_a_cylinder_or_a_cone_keeps_its_mu);
    PROVE(a_conformal_map_changes_mu_unless_it_is_a_scaling);
    PROVE(a_conformal_map_adds_the_normal_derivative_to_curvature);
    PROVE(a_closed_geodesic_without_the_defect_has_mu_one);
    PROVE(a_regular_polygon_keeps_its_mu_up_to_the_great_circle);
    PROVE(tensors_at_two_edges_are_transports_of_each_other);
    PROVE(an_arc_is_longer_than_its_edge_by_its_cube_at_most);
    PROVE(on_a_curve_of_class_c2_only_angles_have_order_three_halves);
    PROVE(the_constant_of_f_is_curvature_over_total_curvature);
    PROVE(an_angle_changes_by_no_more_than_its_vectors);
    PROVE(tilted_normals_change_cosines_as_lemma_4_9_says);
    PROVE(so_they_do_of_vectors_off_the_tangent_plane_lemma_4_10);
    PROVE(points_off_by_h2_change_cosines_of_unit_vectors_only_so_much);
    PROVE(the_printed_errors_of_f_are_those_at_corners);
    PROVE(mu_2_and_mu_5_are_largest_in_17_of_20_flowers);
    PROVE(three_petals_raise_mu_3_and_three_or_seven_lower_mu_5);
    PROVE(mu_2_falls_where_the_surface_curves_more);
    return QED();
}
