/* Step 4: irreducible components become eigenvalues and eigenvectors (paper 2.4, 3.1).
   cc -I. tests/test_spectrum.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "harness.h"
#include "families.h"

#define P 12

/* A random polygon on the unit sphere, measured; its corners are its normals. */
static size_t cell(chance *c, int trial, double *xyz, double *length, double *turning, double *g)
{
    double xy[2 * MOST], phase[MOST];
    size_t n = 3 + one_of(c, 20);
    CASE("trial %d, %d corners", trial, (int)n);
    gentle_star(c, n, xy);
    onto_sphere(xy, n, between(c, 0.05, 2), xyz);
    turn_somehow(c, xyz, n);
    CHECK_OK(surfmink_edges(ON_SPHERE(xyz, n, 1.0), length, turning, NULL));
    CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
    CHECK_OK(surfmink_irreducible(length, phase, n, P, g));
    return n;
}

/* --- eigenvalues and angles --------------------------------------------------------------------------------------- */

THEOREM(eigenvalues_are_moduli_and_angles_arguments)
{
    /* L = 10, then components in all four quadrants. */
    static const double g[12] = {10, 0, 3, 4, -3, 4, -3, -4, 3, -4, 0, 0};
    double lambda[6], mu[6], theta[6];
    int p;
    CHECK_OK(surfmink_spectrum(g, 5, lambda, mu, theta));
    CHECK_NEAR(lambda[0], 10, 0);
    CHECK_NEAR(mu[0], 1, 0);
    CHECK_NEAR(theta[0], 0, 0);
    for (p = 1; p < 5; ++p) {
        CHECK_NEAR(lambda[p], 5, 0);
        CHECK_CLOSE(mu[p], 0.5, 2e-16);
        CHECK_CLOSE(theta[p], atan2(g[2 * p + 1], g[2 * p]) / p, 2e-16);
    }
    CHECK_NEAR(lambda[5], 0, 0);
    CHECK_NEAR(mu[5], 0, 0);
    CHECK_NEAR(theta[5], 0, 0);
}

THEOREM(each_output_of_the_spectrum_may_be_left_out)
{
    static const double g[4] = {10, 0, 3, 4};
    double lambda[2], mu[2], theta[2], alone[2];
    CHECK_OK(surfmink_spectrum(g, 1, lambda, mu, theta));
    CHECK_OK(surfmink_spectrum(g, 1, alone, NULL, NULL));
    CHECK_SAME(alone, lambda, 2);
    CHECK_OK(surfmink_spectrum(g, 1, NULL, alone, NULL));
    CHECK_SAME(alone, mu, 2);
    CHECK_OK(surfmink_spectrum(g, 1, NULL, NULL, alone));
    CHECK_SAME(alone, theta, 2);
    CHECK_OK(surfmink_spectrum(g, 1, NULL, NULL, NULL));
}

/* The plane, lengths in a unit of the caller's. */
static int log_in_units(void *context, const double *x, const double *y, double *length, double direction[2])
{
    direction[0] = y[0] - x[0];
    direction[1] = y[1] - x[1];
    *length = hypot(direction[0], direction[1]) * *(const double *)context;
    return SURFMINK_OK;
}

static surfmink_surface plane_in_units(double *unit)
{
    surfmink_surface s;
    s.context = unit;
    s.stride = 2;
    s.log = log_in_units;
    s.exp = NULL;
    return s;
}

/* A past bug: L above 1e308 was measured, but its spectrum was refused. */
THEOREM(what_is_measured_has_a_spectrum_up_to_the_largest_double)
{
    /* By callbacks, for elsewhere the area overflows first. L = 1.68e308, and the largest double is 1.797e308. */
    static const double corner[8] = {0, 0, 1, 0, 1, 1, 0, 1};
    double side = 4.2e307, g[10], lambda[5], mu[5];
    surfmink_surface plane = plane_in_units(&side);
    CHECK_OK(surfmink_measure(ON_SURFACE(&plane, corner, 4), 4, NULL, g, NULL, NULL));
    CHECK_OK(surfmink_spectrum(g, 4, lambda, mu, NULL));
    CHECK_CLOSE(lambda[0], 4 * side, 1e-15);
    CHECK_CLOSE(lambda[4], 4 * side, 1e-15);
    CHECK_NEAR(mu[4], 1, 1e-15);
}

THEOREM(the_first_angle_lies_in_minus_pi_over_p_to_pi_over_p)
{
    double g[2 * (P + 1)] = {1, 0}, theta[P + 1];
    int p, zero;
    for (zero = 0; zero < 2; ++zero) { /* a negative g_p has the argument pi, whatever the sign of its zero */
        for (p = 1; p <= P; ++p) {
            g[2 * p] = -1;
            g[2 * p + 1] = zero ? -0.0 : 0.0;
        }
        CASE("%s zero", zero ? "negative" : "positive");
        CHECK_OK(surfmink_spectrum(g, P, NULL, NULL, theta));
        for (p = 1; p <= P; ++p) CHECK_NEAR(theta[p], PI / p, 1e-15);
        CHECK_OK(surfmink_angles(g, 1, 1, theta));
        CHECK_NEAR(theta[0], PI, 1e-15);
        CHECK_OK(surfmink_angles(g, 1, -1, theta));
        CHECK_NEAR(theta[0], 2 * PI, 1e-15);
    }
}

/* Paper 2.4, eq. (minkowski-eigenvectors). */
THEOREM(there_are_p_angles_of_either_sign_half_a_step_apart)
{
    chance c = {seed(41)};
    double g[2 * (P + 1)], theta[P + 1], plus[P], minus[P];
    int trial, p, n;
    for (trial = 0; trial < 100; ++trial) {
        for (p = 0; p <= P; ++p) {
            g[2 * p] = between(&c, -1, 1);
            g[2 * p + 1] = between(&c, -1, 1);
        }
        g[0] = 2;
        CHECK_OK(surfmink_spectrum(g, P, NULL, NULL, theta));
        for (p = 1; p <= P; ++p) {
            CHECK_OK(surfmink_angles(g, p, trial % 5, plus)); /* any sign >= 0 */
            CHECK_OK(surfmink_angles(g, p, -1 - trial % 5, minus));
            CHECK_NEAR(plus[0], theta[p], 1e-15);
            for (n = 0; n < p; ++n) {
                CHECK_NEAR(plus[n], theta[p] + 2 * PI * n / p, 3e-15);
                CHECK_NEAR(minus[n], theta[p] + PI * (2 * n + 1) / p, 3e-15);
            }
        }
    }
}

/* --- the eigenvalue equation -------------------------------------------------------------------------------------- */

/* Paper 2.4: W contracted with p - 1 copies of e is lambda e, up to the factor 2^(p-1); for every one of the 2 p
   eigenvectors. */
THEOREM(eigenvectors_solve_the_z_eigenvector_equation)
{
    chance c = {seed(42)};
    double xyz[3 * MOST], length[MOST], turning[MOST], g[2 * (P + 1)], lambda[P + 1], theta[P], tensor[P + 1];
    int trial, p, n, sign;
    for (trial = 0; trial < 200; ++trial) {
        cell(&c, trial, xyz, length, turning, g);
        CHECK_OK(surfmink_spectrum(g, P, lambda, NULL, NULL));
        for (p = 1; p <= P; ++p) {
            CHECK_OK(surfmink_trace_free(g, p, tensor));
            for (sign = 1; sign >= -1; sign -= 2) {
                CHECK_OK(surfmink_angles(g, p, sign, theta));
                for (n = 0; n < p; ++n) {
                    double e[2], contracted[2], eigenvalue = sign * ldexp(lambda[p], 1 - p);
                    e[0] = cos(theta[n]);
                    e[1] = sin(theta[n]);
                    CHECK_OK(surfmink_contract(tensor, p, e, contracted));
                    CHECK_NEAR(contracted[0], eigenvalue * e[0], 1e-14 * fabs(eigenvalue) * pow(2, p / 2.0));
                    CHECK_NEAR(contracted[1], eigenvalue * e[1], 1e-14 * fabs(eigenvalue) * pow(2, p / 2.0));
                }
            }
        }
    }
}

/* For p = 2 that is the eigenvalue equation of a symmetric matrix. */
THEOREM(at_rank_2_eigenvectors_are_those_of_a_matrix)
{
    chance c = {seed(43)};
    double xyz[3 * MOST], length[MOST], turning[MOST], g[2 * (P + 1)], m[3], theta[2];
    int trial;
    for (trial = 0; trial < 100; ++trial) {
        double spread, half_trace;
        cell(&c, trial, xyz, length, turning, g);
        CHECK_OK(surfmink_tensor(g, 2, m));
        half_trace = (m[0] + m[2]) / 2;
        spread = hypot((m[0] - m[2]) / 2, m[1]); /* the eigenvalues are half the trace +- this */
        CHECK_OK(surfmink_angles(g, 2, 1, theta));
        CHECK_NEAR(m[0] * cos(theta[0]) + m[1] * sin(theta[0]), (half_trace + spread) * cos(theta[0]), 1e-14 * g[0]);
        CHECK_NEAR(m[1] * cos(theta[1]) + m[2] * sin(theta[1]), (half_trace + spread) * sin(theta[1]), 1e-14 * g[0]);
        CHECK_NEAR(spread, hypot(g[4], g[5]) / 2, 1e-14 * g[0]);
    }
}

/* --- frames ------------------------------------------------------------------------------------------------------- */

THEOREM(the_co_normal_points_out_and_the_tangent_along_the_edge)
{
    static const double triangle[6] = {0, 0, 4, 0, 4, 3};
    static const double octant[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double flat[4], frame[9], s = sqrt(0.5);
    size_t k;
    static const double want[3][4] = {{0, -1, 1, 0}, {1, 0, 0, 1}, {-0.6, 0.8, -0.8, -0.6}};
    for (k = 0; k < 3; ++k) {
        int j;
        CHECK_OK(surfmink_frame(IN_PLANE(triangle, 3), k, flat));
        for (j = 0; j < 4; ++j) CHECK_NEAR(flat[j], want[k][j], 2e-16);
    }
    CHECK_OK(surfmink_frame(IN_SPACE(octant, octant, 3), 1, frame)); /* from x to y along the equator: out is down */
    CHECK_NEAR(frame[0], 0, 1e-15), CHECK_NEAR(frame[1], 0, 1e-15), CHECK_NEAR(frame[2], -1, 1e-15);
    CHECK_NEAR(frame[3], -s, 1e-15), CHECK_NEAR(frame[4], s, 1e-15), CHECK_NEAR(frame[5], 0, 1e-15);
    CHECK_NEAR(frame[6], s, 1e-15), CHECK_NEAR(frame[7], s, 1e-15), CHECK_NEAR(frame[8], 0, 1e-15);
}

THEOREM(frames_are_right_handed_and_orthonormal)
{
    static const chart ellipsoid = {ELLIPSOID, 1.6, 1.3, 1.0};
    chance c = {seed(44)};
    double xyz[3 * MOST], normal[3 * MOST], frame[9], again[9], cross[3];
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, 20), i, k;
        star_on_chart(&c, &ellipsoid, between(&c, 1, 2), between(&c, 0, 6), 0.4, n, xyz, normal);
        CASE("trial %d", trial);
        for (i = 0; i < n; ++i) {
            double a[3], b[3], edge[3], mean[3], part;
            CHECK_OK(surfmink_frame(IN_SPACE(xyz, normal, n), i, frame));
            cross3(frame + 3, frame + 6, cross); /* nu = tau x normal */
            for (k = 0; k < 3; ++k) {
                CHECK_NEAR(dot3(frame + 3 * k, frame + 3 * k), 1, 1e-15);
                CHECK_NEAR(dot3(frame + 3 * k, frame + 3 * ((k + 1) % 3)), 0, 1e-15);
                CHECK_NEAR(cross[k], frame[k], 1e-15);
                a[k] = normal[3 * i + k];
                b[k] = normal[3 * ((i + 1) % n) + k];
                edge[k] = xyz[3 * ((i + 1) % n) + k] - xyz[3 * i + k];
            }
            CHECK_CLOSE(dot3(edge, frame + 3), sqrt(dot3(edge, edge)), 1e-15); /* tau is the chord */
            for (k = 0; k < 3; ++k) mean[k] = a[k] / sqrt(dot3(a, a)) + b[k] / sqrt(dot3(b, b));
            part = dot3(mean, frame + 3);
            for (k = 0; k < 3; ++k) mean[k] -= part * frame[3 + k];
            CHECK_CLOSE(dot3(mean, frame + 6), sqrt(dot3(mean, mean)), 1e-15); /* the normal is the mean of both */
        }
        for (i = 0; i < 3; ++i) normal[i] *= 16; /* of their directions, not of themselves */
        CHECK_OK(surfmink_frame(IN_SPACE(xyz, normal, n), n - 1, frame));
        for (i = 0; i < 3; ++i) normal[i] /= 16;
        CHECK_OK(surfmink_frame(IN_SPACE(xyz, normal, n), n - 1, again));
        CHECK_SAME(frame, again, 9);
    }
}

/* --- eigenvectors ------------------------------------------------------------------------------------------------- */

THEOREM(in_the_plane_eigenvectors_point_along_the_flat_tensor)
{
    /* With G = sum l (nu_x + i nu_y)^p the eigenvectors are the unit vectors e with e^p = +-G/|G|. */
    chance c = {seed(45)};
    double xy[2 * MOST], length[MOST], turning[MOST], phase[MOST], g[2 * (P + 1)], frame[4], vector[2 * P];
    int trial, p, sign, k;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, 20), i;
        random_star(&c, n, xy);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(xy, n), length, turning, NULL));
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
        CHECK_OK(surfmink_irreducible(length, phase, n, P, g));
        for (p = 2; p <= P; ++p)
            for (sign = 1; sign >= -1; sign -= 2) {
                double re = 0, im = 0, within;
                size_t edge = one_of(&c, n);
                for (i = 0; i < n; ++i) {
                    const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % n);
                    double direction = atan2(a[0] - b[0], b[1] - a[1]);
                    re += length[i] * cos(p * direction);
                    im += length[i] * sin(p * direction);
                }
                within = 5e-14 * g[0] / hypot(re, im);
                CHECK_OK(surfmink_frame(IN_PLANE(xy, n), edge, frame));
                CHECK_OK(surfmink_eigenvectors(g, p, sign, phase[edge], frame, 2, vector));
                for (k = 0; k < p; ++k) {
                    double direction = atan2(vector[2 * k + 1], vector[2 * k]), *first = vector;
                    CHECK_CLOSE(hypot(vector[2 * k], vector[2 * k + 1]), 1, 1e-15);
                    CHECK_ANGLE(p * direction, atan2(im, re) + (sign > 0 ? 0 : PI), within);
                    CHECK_ANGLE(direction - atan2(first[1], first[0]), 2 * PI * k / p, 1e-14); /* one after the other */
                }
            }
    }
}

THEOREM(eigenvectors_in_space_are_tangent_at_their_angles)
{
    chance c = {seed(46)};
    double xyz[3 * MOST], length[MOST], turning[MOST], g[2 * (P + 1)], frame[9], theta[P], vector[3 * P];
    int trial, p, k;
    for (trial = 0; trial < 100; ++trial) {
        int sign = trial % 2 ? 1 : -1;
        cell(&c, trial, xyz, length, turning, g);
        CHECK_OK(surfmink_frame(ON_SPHERE(xyz, 3, 1.0), 0, frame));
        for (p = 1; p <= P; ++p) {
            CHECK_OK(surfmink_angles(g, p, sign, theta));
            CHECK_OK(surfmink_eigenvectors(g, p, sign, 0.0, frame, 3, vector));
            for (k = 0; k < p; ++k) { /* from the co-normal towards the tangent */
                CHECK_NEAR(dot3(vector + 3 * k, frame), cos(theta[k]), 1e-15);
                CHECK_NEAR(dot3(vector + 3 * k, frame + 3), sin(theta[k]), 1e-15);
                CHECK_NEAR(dot3(vector + 3 * k, frame + 6), 0, 1e-15);
            }
        }
    }
}

/* Lemma (point independence of the eigenvectors), paper 3.1. */
THEOREM(eigenvectors_at_two_edges_are_transports_of_each_other)
{
    chance c = {seed(47)};
    double xyz[3 * MOST], length[MOST], turning[MOST], phase[MOST], g[2 * (P + 1)], frame[9], here[3 * P], there[3 * P],
        carried[3];
    int trial, p, k;
    for (trial = 0; trial < 150; ++trial) {
        size_t n = cell(&c, trial, xyz, length, turning, g), from = one_of(&c, n), to = one_of(&c, n), j;
        int sign = trial % 2 ? 1 : -1;
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
        for (p = 1; p <= P; ++p) {
            CHECK_OK(surfmink_frame(ON_SPHERE(xyz, n, 1.0), from, frame));
            CHECK_OK(surfmink_eigenvectors(g, p, sign, phase[from], frame, 3, here));
            CHECK_OK(surfmink_frame(ON_SPHERE(xyz, n, 1.0), to, frame));
            CHECK_OK(surfmink_eigenvectors(g, p, sign, phase[to], frame, 3, there));
            for (k = 0; k < p; ++k) {
                ptrdiff_t steps = (ptrdiff_t)to - (ptrdiff_t)from;
                CHECK_OK(
                    carry(ON_SPHERE(xyz, n, 1.0), turning, from, steps, SURFMINK_CORRECTED, here + 3 * k, carried));
                for (j = 0; j < 3; ++j) CHECK_NEAR(carried[j], there[3 * k + (int)j], 1e-14);
            }
        }
    }
}

THEOREM(eigenvectors_at_an_edge_do_not_depend_on_the_first_corner)
{
    chance c = {seed(48)};
    double xyz[3 * MOST], length[MOST], turning[MOST], phase[MOST], g[2 * (P + 1)], mu[P + 1];
    double moved[3 * MOST], again[2 * (P + 1)], frame[9], vector[3 * P], other[3 * P];
    int trial, p, k, m;
    for (trial = 0; trial < 150; ++trial) {
        size_t n = cell(&c, trial, xyz, length, turning, g), start = one_of(&c, n);
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, phase));
        CHECK_OK(surfmink_spectrum(g, P, NULL, mu, NULL));
        CHECK_OK(surfmink_frame(ON_SPHERE(xyz, n, 1.0), start, frame));
        start_at(start, xyz, n, 3, moved);
        CHECK_OK(surfmink_measure(ON_SPHERE(moved, n, 1.0), P, NULL, again, NULL, NULL));
        for (p = 1; p <= P; ++p) {
            CHECK_OK(surfmink_eigenvectors(g, p, 1, phase[start], frame, 3, vector));
            CHECK_OK(surfmink_eigenvectors(again, p, 1, 0.0, frame, 3, other));
            for (k = 0; k < p; ++k) { /* the same set, though counting may start elsewhere */
                double nearest = 1;
                for (m = 0; m < p; ++m) {
                    double off = fabs(vector[3 * k] - other[3 * m]) + fabs(vector[3 * k + 1] - other[3 * m + 1]) +
                                 fabs(vector[3 * k + 2] - other[3 * m + 2]);
                    if (off < nearest) nearest = off;
                }
                CHECK_NEAR(nearest, 0, 1e-13 / mu[p]);
            }
        }
    }
}

/* --- all four steps ----------------------------------------------------------------------------------------------- */

enum { MOST_RANK = 30 };

typedef struct answer {
    double mu[MOST_RANK + 1], g[2 * MOST_RANK + 2];
    surfmink_functionals w;
    size_t bad;
    int status;
} answer;

static void by_steps(const surfmink_outline *o, int max_rank, answer *a)
{
    static double length[LONGEST], turning[LONGEST], phase[LONGEST];
    a->status = surfmink_edges(o, length, turning, &a->bad);
    if (a->status) return;
    a->status = surfmink_total(o, length, turning, o->n, &a->w);
    if (a->status) return;
    CHECK_OK(surfmink_phases(turning, o->n, SURFMINK_CORRECTED, phase));
    CHECK_OK(surfmink_irreducible(length, phase, o->n, max_rank, a->g));
    CHECK_OK(surfmink_spectrum(a->g, max_rank, NULL, a->mu, NULL));
}

/* 3 to 3000 corners: mostly few, for there every way to be odd is likely. */
static size_t corner_count(chance *c)
{
    if (one_in(c, 40)) return (size_t)magnitude(c, 100, 3000);
    return 3 + one_of(c, one_in(c, 4) ? 60 : 8);
}

THEOREM(surfmink_measure_and_the_four_steps_give_the_same_bits)
{
    enum { OUTLINES = FEWER > 20 ? 100000 / 20 : 100000 };
    static const int ranks[5] = {0, 1, 6, 12, MOST_RANK};
    static drawn d;
    chance c = {seed(49)};
    long measured[LIES] = {0}, refused[LIES] = {0}, trial, longest = 0;
    answer one, four;
    int rank, lies;
    for (trial = 0; trial < OUTLINES; ++trial) {
        draw_outline(&c, (enum lies)(trial % LIES), corner_count(&c), &d);
        rank = ranks[one_of(&c, 5)];
        CASE("outline %ld, %s, %s, %d corners", trial, lies_name[d.lies], drawing_name[d.family], (int)d.view.n);
        memset(&one, 0, sizeof one);
        memset(&four, 0, sizeof four);
        one.status = surfmink_measure(&d.view, rank, one.mu, one.g, &one.w, &one.bad);
        by_steps(&d.view, rank, &four);
        CHECK_STATUS(four.status, one.status);
        ++(one.status ? refused : measured)[d.lies];
        if (one.status) {
            if (four.bad) CHECK_EQUAL(four.bad, one.bad); /* edges blame a corner, which is 1 or later or not at all */
            continue;
        }
        if ((long)d.view.n > longest) longest = (long)d.view.n;
        CHECK_SAME(&four.w.area, &one.w.area, sizeof one.w / sizeof one.w.area);
        CHECK_SAME(four.g, one.g, 2 * (size_t)rank + 2);
        if (one.w.length > 1e-290) CHECK_SAME(four.mu, one.mu, (size_t)rank + 1); /* else g has lost digits, or all */
    }
    for (lies = 0; lies < LIES; ++lies) {
        CASE("%s: %ld measured, %ld refused", lies_name[lies], measured[lies], refused[lies]);
        CHECK(measured[lies] > OUTLINES / LIES / 2 && refused[lies] > OUTLINES / LIES / 50);
    }
    CHECK(longest > 2500);
}

int main(void)
{
    PROVE(eigenvalues_are_moduli_and_angles_arguments);
    PROVE(each_output_of_the_spectrum_may_be_left_out);
    PROVE(what_is_measured_has_a_spectrum_up_to_the_largest_double);
    PROVE(the_first_angle_lies_in_minus_pi_over_p_to_pi_over_p);
    PROVE(there_are_p_angles_of_either_sign_half_a_step_apart);
    PROVE(eigenvectors_solve_the_z_eigenvector_equation);
    PROVE(at_rank_2_eigenvectors_are_those_of_a_matrix);
    PROVE(the_co_normal_points_out_and_the_tangent_along_the_edge);
    PROVE(frames_are_right_handed_and_orthonormal);
    PROVE(in_the_plane_eigenvectors_point_along_the_flat_tensor);
    PROVE(eigenvectors_in_space_are_tangent_at_their_angles);
    PROVE(eigenvectors_at_two_edges_are_transports_of_each_other);
    PROVE(eigenvectors_at_an_edge_do_not_depend_on_the_first_corner);
    PROVE(surfmink_measure_and_the_four_steps_give_the_same_bits);
    return QED();
}
