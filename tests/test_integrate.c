/* Step 3: lengths and phases become irreducible components and tensors (paper 2.3, 2.4, 3.3).
   cc -I. tests/test_integrate.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <float.h>

#include "harness.h"
#include "shapes.h"

static size_t random_edges(chance *c, double *length, double *phase)
{
    size_t n = 3 + one_of(c, MOST - 2), i;
    for (i = 0; i < n; ++i) {
        length[i] = one_of(c, 6) ? between(c, 0.1, 1) : 0; /* a length may be 0 here, only the sum may not */
        phase[i] = between(c, -10, 10);
    }
    length[1] = 1;
    phase[0] = 0;
    return n;
}

/* x^k, with 0^0 = 1. */
static double power(double x, int k)
{
    double y = 1;
    while (k-- > 0) y *= x;
    return y;
}

/* --- irreducible components --------------------------------------------------------------------------------------- */

/* Paper 3.3, eq. (integrated-components-polygon). */
THEOREM(a_component_is_the_sum_of_lengths_times_powers_of_the_phase)
{
    chance c = {seed(31)};
    double length[MOST], phase[MOST], g[2 * 129];
    int trial, p;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = random_edges(&c, length, phase), i;
        double total = 0, widest = 1;
        for (i = 0; i < n; ++i) total += length[i], widest = fmax(widest, fabs(phase[i]));
        CASE("trial %d", trial);
        CHECK_OK(surfmink_irreducible(length, phase, n, 128, g));
        CHECK_CLOSE(g[0], total, 1e-15);
        CHECK_NEAR(g[1], 0, 0);
        for (p = 0; p <= 128; ++p) {
            double re = 0, im = 0;
            for (i = 0; i < n; ++i) {
                re += length[i] * cos(p * phase[i]);
                im += length[i] * sin(p * phase[i]);
            }
            /* p phase is rounded here, by eps / 2 of it; the header's sums are better than these. */
            CHECK_NEAR(g[2 * p] / total, re / total, 2e-15 + 2e-16 * p * widest);
            CHECK_NEAR(g[2 * p + 1] / total, im / total, 2e-15 + 2e-16 * p * widest);
        }
    }
}

/* Whole turns are taken off phases of any size, with a relative error of eps. */
THEOREM(phases_may_be_large)
{
    double l[3] = {1, 2, 3}, phase[3], g[4], x;
    for (x = 1; x < 1e13; x *= -3.7) {
        phase[0] = phase[1] = phase[2] = x;
        CASE("%g", x);
        CHECK_OK(surfmink_irreducible(l, phase, 3, 1, g));
        CHECK_NEAR(g[2], 6 * cos(x), 6 * DBL_EPSILON * (1 + fabs(x)));
        CHECK_NEAR(g[3], 6 * sin(x), 6 * DBL_EPSILON * (1 + fabs(x)));
    }
}

THEOREM(edges_without_length_have_components_zero)
{
    static const double none[3] = {0, 0, 0}, phase[3] = {0, 2, 4}, zero[8] = {0};
    double g[8];
    CHECK_OK(surfmink_irreducible(none, phase, 3, 3, g));
    CHECK_SAME(g, zero, 8);
}

THEOREM(at_rank_128_fourteen_digits_are_left)
{
    /* Phases 2 pi k / 1024 have powers whose cosines need no large argument: the reference is as good as libm. */
    double length[8], phase[8], g[2 * 129];
    int p, i;
    static const int step[8] = {0, 37, 130, 341, 513, 700, 901, 1013};
    for (i = 0; i < 8; ++i) {
        length[i] = 0.125;
        phase[i] = 2 * PI * step[i] / 1024;
    }
    CHECK_OK(surfmink_irreducible(length, phase, 8, 128, g));
    for (p = 0; p <= 128; ++p) {
        double re = 0, im = 0;
        for (i = 0; i < 8; ++i) {
            re += cos(2 * PI * (step[i] * p % 1024) / 1024) / 8;
            im += sin(2 * PI * (step[i] * p % 1024) / 1024) / 8;
        }
        CASE("p = %d", p);
        CHECK_NEAR(g[2 * p], re, p <= 12 ? 4e-15 : 3e-14);
        CHECK_NEAR(g[2 * p + 1], im, p <= 12 ? 4e-15 : 3e-14);
    }
}

THEOREM(a_component_does_not_depend_on_how_many_are_asked_for)
{
    chance c = {seed(32)};
    double length[MOST], phase[MOST], all[2 * 81], some[2 * 81], blank[2 * 81];
    size_t n = random_edges(&c, length, phase), asked;
    memset(blank, 0xA5, sizeof blank);
    CHECK_OK(surfmink_irreducible(length, phase, n, 80, all));
    for (asked = 1; asked <= 81; ++asked) {
        memset(some, 0xA5, sizeof some);
        CHECK_OK(surfmink_irreducible(length, phase, n, (int)asked - 1, some));
        CHECK_SAME(some, all, 2 * asked);
        CHECK_SAME(some + 2 * asked, blank + 2 * asked, 2 * (81 - asked)); /* nothing beyond is written */
    }
}

/* --- the flat tensor ---------------------------------------------------------------------------------------------- */

/* Remark of paper 2.3: in the plane the definition coincides with the usual one. */
THEOREM(in_the_plane_components_are_those_of_the_edge_normals)
{
    chance c = {seed(33)};
    double xy[2 * MOST], g[26], mu[13], first[4];
    int trial, p;
    for (trial = 0; trial < 500; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        double re[13] = {0}, im[13] = {0}, total = 0, turned_re = 1, turned_im = 0;
        random_star(&c, n, xy);
        for (i = 0; i < n; ++i) { /* the sum of l (nu_x + i nu_y)^p, where l nu = (dy, -dx) */
            const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % n);
            double nx = b[1] - a[1], ny = a[0] - b[0], l = hypot(nx, ny), z_re = 1, z_im = 0, t;
            total += l;
            for (p = 0; p <= 12; ++p) {
                re[p] += l * z_re;
                im[p] += l * z_im;
                t = (z_re * nx - z_im * ny) / l;
                z_im = (z_re * ny + z_im * nx) / l;
                z_re = t;
            }
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, n), 12, mu, g, NULL, NULL));
        CHECK_OK(surfmink_frame(IN_PLANE(xy, n), 0, first));
        for (p = 0; p <= 12; ++p) {
            double t = turned_re;
            CHECK_NEAR(mu[p], hypot(re[p], im[p]) / total, 2e-14);
            /* g_p is read in the frame of edge 0: seen from the x axis it is g_p nu_0^p. */
            CHECK_NEAR(g[2 * p] * turned_re - g[2 * p + 1] * turned_im, re[p], 2e-14 * total);
            CHECK_NEAR(g[2 * p] * turned_im + g[2 * p + 1] * turned_re, im[p], 2e-14 * total);
            turned_re = turned_re * first[0] - turned_im * first[1];
            turned_im = t * first[1] + turned_im * first[0];
        }
        CHECK_NEAR(mu[1], 0, 1e-14); /* the normals of a closed polygon add up to nothing */
    }
}

THEOREM(in_the_plane_the_full_tensor_is_that_of_the_edge_normals)
{
    chance c = {seed(34)};
    double xy[2 * MOST], g[2 * 13], frame[4], tensor[13];
    int trial, p, j;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, 20), i;
        random_star(&c, n, xy);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_measure(IN_PLANE(xy, n), 12, NULL, g, NULL, NULL));
        CHECK_OK(surfmink_frame(IN_PLANE(xy, n), 0, frame));
        for (p = 0; p <= 12; ++p) {
            CHECK_OK(surfmink_tensor(g, p, tensor));
            for (j = 0; j <= p; ++j) { /* p - j indices along nu of edge 0, j along its tau */
                double sum = 0;
                for (i = 0; i < n; ++i) {
                    const double *a = xy + 2 * i, *b = xy + 2 * ((i + 1) % n);
                    double nx = b[1] - a[1], ny = a[0] - b[0], l = hypot(nx, ny);
                    sum += l * power((nx * frame[0] + ny * frame[1]) / l, p - j) *
                           power((nx * frame[2] + ny * frame[3]) / l, j);
                }
                CHECK_NEAR(tensor[j], sum, 3e-14 * g[0]);
            }
        }
    }
}

/* --- tensors and their trace-free parts --------------------------------------------------------------------------- */

THEOREM(the_full_tensor_has_the_components_of_its_definition)
{
    chance c = {seed(35)};
    double length[MOST], phase[MOST], g[2 * 65], tensor[65];
    int trial, p, j;
    for (trial = 0; trial < 20; ++trial) {
        size_t n = random_edges(&c, length, phase), i;
        CASE("trial %d", trial);
        CHECK_OK(surfmink_irreducible(length, phase, n, 64, g));
        for (p = 0; p <= 64; p += p < 12 ? 1 : 13) {
            CHECK_OK(surfmink_tensor(g, p, tensor));
            for (j = 0; j <= p; ++j) {
                double sum = 0;
                for (i = 0; i < n; ++i) sum += length[i] * power(cos(phase[i]), p - j) * power(sin(phase[i]), j);
                CHECK_NEAR(tensor[j], sum, 2e-14 * g[0]);
            }
        }
    }
}

THEOREM(two_indices_contracted_leave_the_tensor_of_rank_p_minus_2)
{
    chance c = {seed(36)};
    double length[MOST], phase[MOST], g[2 * 1001], tensor[1001], lower[1001];
    int p, j;
    size_t n = random_edges(&c, length, phase);
    CHECK_OK(surfmink_irreducible(length, phase, n, 1000, g));
    for (p = 2; p <= 1000; p += p < 40 ? 1 : 320) { /* nu_a nu_a = 1 */
        CHECK_OK(surfmink_tensor(g, p, tensor));
        CHECK_OK(surfmink_tensor(g, p - 2, lower));
        CASE("p = %d", p);
        for (j = 0; j <= p - 2; ++j) CHECK_NEAR(tensor[j] + tensor[j + 2], lower[j], 1e-13 * g[0]);
    }
}

THEOREM(the_trace_free_part_is_the_tensor_less_its_traces)
{
    chance c = {seed(37)};
    double length[MOST], phase[MOST], g[2 * 41], only[2 * 41], tensor[41], free_part[41];
    int p, j;
    size_t n = random_edges(&c, length, phase);
    CHECK_OK(surfmink_irreducible(length, phase, n, 40, g));
    CHECK_OK(surfmink_trace_free(g, 0, free_part));
    CHECK_NEAR(free_part[0], g[0], 0);
    CHECK_OK(surfmink_trace_free(g, 1, free_part));
    CHECK_NEAR(free_part[0], g[2], 0);
    CHECK_NEAR(free_part[1], g[3], 0);
    CHECK_OK(surfmink_tensor(g, 2, tensor)); /* rank 2: subtract half the trace from the diagonal */
    CHECK_OK(surfmink_trace_free(g, 2, free_part));
    CHECK_NEAR(free_part[0], tensor[0] - (tensor[0] + tensor[2]) / 2, 1e-14);
    CHECK_NEAR(free_part[1], tensor[1], 1e-14);
    CHECK_NEAR(free_part[2], tensor[2] - (tensor[0] + tensor[2]) / 2, 1e-14);
    CHECK_OK(surfmink_tensor(g, 3, tensor)); /* rank 3: T_abc - (d_ab t_c + d_bc t_a + d_ca t_b)/4 with t_a = T_abb */
    CHECK_OK(surfmink_trace_free(g, 3, free_part));
    CHECK_NEAR(free_part[0], tensor[0] - 3 * (tensor[0] + tensor[2]) / 4, 1e-14);
    CHECK_NEAR(free_part[1], tensor[1] - (tensor[1] + tensor[3]) / 4, 1e-14);
    CHECK_NEAR(free_part[2], tensor[2] - (tensor[0] + tensor[2]) / 4, 1e-14);
    CHECK_NEAR(free_part[3], tensor[3] - 3 * (tensor[1] + tensor[3]) / 4, 1e-14);
    for (p = 2; p <= 40; ++p) {
        CASE("p = %d", p);
        CHECK_OK(surfmink_trace_free(g, p, free_part));
        for (j = 0; j <= p - 2; ++j) CHECK_NEAR(free_part[j] + free_part[j + 2], 0, 0);
        /* It is what the full tensor becomes when no lower rank is left. */
        memset(only, 0, sizeof only);
        only[2 * p] = g[2 * p];
        only[2 * p + 1] = g[2 * p + 1];
        CHECK_OK(surfmink_tensor(only, p, tensor));
        for (j = 0; j <= p; ++j) CHECK_NEAR(tensor[j], free_part[j], 1e-15 * fabs(tensor[0]) + 1e-15 * fabs(tensor[1]));
    }
}

THEOREM(contraction_sums_normals_times_powers_of_projections)
{
    chance c = {seed(38)};
    double length[MOST], phase[MOST], g[2 * 21], tensor[21];
    int trial, p;
    for (trial = 0; trial < 50; ++trial) {
        size_t n = random_edges(&c, length, phase), i;
        CASE("trial %d", trial);
        CHECK_OK(surfmink_irreducible(length, phase, n, 20, g));
        for (p = 1; p <= 20; ++p) {
            double vector[2], contracted[2], want[2] = {0, 0}, size;
            vector[0] = between(&c, -2, 2);
            vector[1] = between(&c, -2, 2);
            size = hypot(vector[0], vector[1]);
            for (i = 0; i < n; ++i) {
                double along = length[i] * power(cos(phase[i]) * vector[0] + sin(phase[i]) * vector[1], p - 1);
                want[0] += along * cos(phase[i]);
                want[1] += along * sin(phase[i]);
            }
            CHECK_OK(surfmink_tensor(g, p, tensor));
            CHECK_OK(surfmink_contract(tensor, p, vector, contracted));
            CHECK_NEAR(contracted[0], want[0], 1e-14 * g[0] * power(sqrt(2) * size, p - 1));
            CHECK_NEAR(contracted[1], want[1], 1e-14 * g[0] * power(sqrt(2) * size, p - 1));
            CHECK_OK(surfmink_contract(tensor, p, vector, vector)); /* in place */
            CHECK_SAME(vector, contracted, 2);
        }
    }
}

/* --- the classical transport, for comparison ---------------------------------------------------------------------- */

/* Paper 5.1: the octant with the classical transport, read at a fraction u of an edge. The four pieces of its
   outline, of lengths 1-u, 1, 1, u, have phases of 0, 1, 2, 3 right angles. */
THEOREM(by_classical_transport_the_octant_is_a_square)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double length[3], turning[3], g[14], mu[7], u;
    size_t edge;
    CHECK_OK(surfmink_edges(ON_SPHERE(corner, 3, 1.0), length, turning, NULL));
    for (edge = 0; edge < 3; ++edge)
        for (u = 0; u < 1; u += 1.0 / 64) {
            CASE("edge %d at %g", (int)edge, u);
            CHECK_OK(surfmink_irreducible_parallel(length, turning, 3, edge, u, 6, g));
            CHECK_OK(surfmink_spectrum(g, 6, NULL, mu, NULL));
            CHECK_NEAR(g[0], 3 * PI / 2, 1e-15);
            CHECK_NEAR(mu[1], sqrt(u * u + (1 - u) * (1 - u)) / 3, 1e-15);
            CHECK_NEAR(mu[2], fabs(1 - 2 * u) / 3, 1e-15);
            CHECK_NEAR(mu[3], sqrt(u * u + (1 - u) * (1 - u)) / 3, 1e-15);
            CHECK_NEAR(mu[4], 1, 1e-15);
            CHECK_NEAR(mu[5], sqrt(u * u + (1 - u) * (1 - u)) / 3, 2e-15);
            CHECK_NEAR(mu[6], fabs(1 - 2 * u) / 3, 2e-15);
            /* g itself, whose unit is the length of a side: (1-u) + i - 1 - i u at rank 1 */
            CHECK_NEAR(g[2], -u * PI / 2, 2e-15);
            CHECK_NEAR(g[3], (1 - u) * PI / 2, 2e-15);
        }
}

THEOREM(classical_transport_splits_the_edge_of_its_point)
{
    chance c = {seed(39)};
    double length[MOST], turning[MOST], g[26], next[26];
    int trial, p;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = random_edges(&c, length, turning), edge = one_of(&c, n), k;
        double fraction = one_of(&c, 4) ? between(&c, 0, 1) : 0, turned = 0, re[13], im[13],
               back = turning[(edge + 1) % n];
        for (p = 0; p <= 12; ++p) {
            re[p] = (1 - fraction) * length[edge];
            im[p] = 0;
        }
        for (k = 1; k <= n; ++k) { /* any sum of turning angles will do: nothing is divided by it */
            size_t i = (edge + k) % n;
            turned += turning[i];
            for (p = 0; p <= 12; ++p) {
                re[p] += length[i] * (k == n ? fraction : 1) * cos(p * turned);
                im[p] += length[i] * (k == n ? fraction : 1) * sin(p * turned);
            }
        }
        CASE("trial %d", trial);
        CHECK_OK(surfmink_irreducible_parallel(length, turning, n, edge, fraction, 12, g));
        for (p = 0; p <= 12; ++p) {
            CHECK_NEAR(g[2 * p], re[p], 2e-13 * g[0]);
            CHECK_NEAR(g[2 * p + 1], im[p], 2e-13 * g[0]);
        }
        /* The end of an edge is the start of the next one, up to the turn between them. */
        CHECK_OK(surfmink_irreducible_parallel(length, turning, n, edge, 1 - 1e-15, 12, g));
        CHECK_OK(surfmink_irreducible_parallel(length, turning, n, (edge + 1) % n, 0.0, 12, next));
        for (p = 0; p <= 12; ++p) {
            CHECK_NEAR(g[2 * p], next[2 * p] * cos(p * back) - next[2 * p + 1] * sin(p * back), 3e-13 * g[0]);
            CHECK_NEAR(g[2 * p + 1], next[2 * p + 1] * cos(p * back) + next[2 * p] * sin(p * back), 3e-13 * g[0]);
        }
    }
}

THEOREM(the_split_edge_is_one_edge_more_at_every_rank)
{
    chance c = {seed(30)};
    double length[MOST], turning[MOST], piece[MOST + 1], phase[MOST + 1], g[2 * 71 + 1], want[2 * 71];
    static const int ranks[5] = {24, 25, 48, 49, 70}; /* 24 are summed at a time */
    int trial, k, max_rank;
    for (trial = 0; trial < 50; ++trial) {
        size_t n = random_edges(&c, length, turning), edge = one_of(&c, n), i;
        double fraction = between(&c, 0, 1), turned = 0;
        max_rank = ranks[trial % 5];
        piece[0] = (1 - fraction) * length[edge];
        phase[0] = 0;
        for (i = 1; i <= n; ++i) {
            piece[i] = length[(edge + i) % n] * (i == n ? fraction : 1);
            phase[i] = turned += turning[(edge + i) % n];
        }
        CASE("trial %d", trial);
        g[2 * max_rank + 2] = -7;
        CHECK_OK(surfmink_irreducible_parallel(length, turning, n, edge, fraction, max_rank, g));
        CHECK_OK(surfmink_irreducible(piece, phase, n + 1, max_rank, want));
        for (k = 0; k < 2 * max_rank + 2; ++k) CHECK_NEAR(g[k], want[k], 1e-13 * (k + 1) * g[0]);
        CHECK_NEAR(g[2 * max_rank + 2], -7, 0);
    }
}

/* Lengths of 0, and more edges than are worked on at a time. */
THEOREM(no_length_has_no_component_and_a_long_one_is_one)
{
    enum { EDGES = 1000 };
    static double length[EDGES], turning[EDGES];
    double g[26];
    size_t i;
    int p;
    for (i = 0; i < EDGES; ++i) turning[i] = 2 * PI / EDGES;
    CHECK_OK(surfmink_irreducible_parallel(length, turning, EDGES, 7, 0.5, 12, g));
    for (p = 0; p <= 25; ++p) CHECK_NEAR(g[p], 0, 0);
    for (i = 0; i < EDGES; ++i) length[i] = i % (EDGES / 5) ? 0 : 2; /* five edges of length 2 */
    CHECK_OK(surfmink_irreducible_parallel(length, turning, EDGES, 0, 0, 12, g));
    for (p = 0; p <= 12; ++p) {
        CHECK_NEAR(g[2 * p], p % 5 ? 0 : 10, 2e-14);
        CHECK_NEAR(g[2 * p + 1], 0, 1e-13);
    }
}

THEOREM(in_the_plane_both_transports_agree_at_every_point)
{
    chance c = {seed(40)};
    double xy[2 * MOST], moved[2 * MOST], length[MOST], turning[MOST], g[26], parallel[26];
    int trial, p;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), edge = one_of(&c, n);
        random_star(&c, n, xy);
        start_at(edge, xy, n, 2, moved);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(xy, n), length, turning, NULL));
        CHECK_OK(surfmink_measure(IN_PLANE(moved, n), 12, NULL, g, NULL, NULL));
        CHECK_OK(surfmink_irreducible_parallel(length, turning, n, edge, between(&c, 0, 1), 12, parallel));
        for (p = 0; p <= 25; ++p) CHECK_NEAR(parallel[p], g[p], 3e-14 * g[0]);
    }
}

int main(void)
{
    PROVE(a_component_is_the_sum_of_lengths_times_powers_of_the_phase);
    PROVE(phases_may_be_large);
    PROVE(edges_without_length_have_components_zero);
    PROVE(at_rank_128_fourteen_digits_are_left);
    PROVE(a_component_does_not_depend_on_how_many_are_asked_for);
    PROVE(in_the_plane_components_are_those_of_the_edge_normals);
    PROVE(in_the_plane_the_full_tensor_is_that_of_the_edge_normals);
    PROVE(the_full_tensor_has_the_components_of_its_definition);
    PROVE(two_indices_contracted_leave_the_tensor_of_rank_p_minus_2);
    PROVE(the_trace_free_part_is_the_tensor_less_its_traces);
    PROVE(contraction_sums_normals_times_powers_of_projections);
    PROVE(by_classical_transport_the_octant_is_a_square);
    PROVE(classical_transport_splits_the_edge_of_its_point);
    PROVE(the_split_edge_is_one_edge_more_at_every_rank);
    PROVE(no_length_has_no_component_and_a_long_one_is_one);
    PROVE(in_the_plane_both_transports_agree_at_every_point);
    return QED();
}
