/* Step 2: turning angles become phases, and directions are carried along the outline (paper 2.3).
   cc -I. tests/test_transport.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "harness.h"
#include "shapes.h"

/* A random polygon on the unit sphere, with its lengths and turning angles; alternately small and large. */
static size_t cell(chance *c, int trial, double *xyz, double *length, double *turning)
{
    double xy[2 * MOST];
    size_t n = 3 + one_of(c, 20);
    CASE("trial %d, %d corners", trial, (int)n);
    gentle_star(c, n, xy);
    onto_sphere(xy, n, between(c, 0.05, 2), xyz);
    turn_somehow(c, xyz, n);
    CHECK_OK(surfmink_edges(ON_SPHERE(xyz, n, 1.0), length, turning, NULL));
    return n;
}

static double sum_of(const double *a, size_t n)
{
    double sum = 0;
    while (n-- > 0) sum += a[n];
    return sum;
}

/* --- phases ------------------------------------------------------------------------------------------------------- */

THEOREM(a_phase_is_the_turn_since_edge_0_over_that_of_one_round)
{
    static const double turning[4] = {1.0, 0.5, -0.25, 0.75}; /* S = 2: one round is stretched by pi */
    double f[4], phi[4], eta[4];
    CHECK_OK(surfmink_phases(turning, 4, SURFMINK_CORRECTED, f));
    CHECK_OK(surfmink_phases(turning, 4, SURFMINK_PARALLEL, phi));
    CHECK_OK(surfmink_phases(turning, 4, SURFMINK_DEFECT, eta));
    CHECK_NEAR(phi[0], 0, 0);
    CHECK_NEAR(phi[1], 0.5, 0); /* the turn at corner 1 lies between the edges 0 and 1; that at corner 0 comes last */
    CHECK_NEAR(phi[2], 0.25, 0);
    CHECK_NEAR(phi[3], 1, 0);
    CHECK_NEAR(f[0], 0, 0);
    CHECK_CLOSE(f[1], PI / 2, 3e-16);
    CHECK_CLOSE(f[2], PI / 4, 3e-16);
    CHECK_CLOSE(f[3], PI, 3e-16);
    CHECK_NEAR(eta[0], 0, 0);
    CHECK_CLOSE(eta[1], (PI - 1) / 2, 3e-16);
    CHECK_CLOSE(eta[2], (PI - 1) / 4, 3e-16);
    CHECK_CLOSE(eta[3], PI - 1, 3e-16);
}

/* Paper 2.3, eq. (f). */
THEOREM(the_corrected_phase_is_the_parallel_one_plus_the_defect)
{
    chance c = {seed(21)};
    double xyz[3 * MOST], length[MOST], turning[MOST], f[MOST], phi[MOST], eta[MOST];
    int trial;
    for (trial = 0; trial < 500; ++trial) {
        size_t n = cell(&c, trial, xyz, length, turning), i;
        double s = sum_of(turning, n), turned = 0;
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, f));
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_PARALLEL, phi));
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_DEFECT, eta));
        for (i = 0; i < n; ++i) {
            if (i > 0) turned += turning[i];
            CHECK_NEAR(phi[i], turned, 1e-14);
            CHECK_NEAR(f[i], 2 * PI / s * turned, 1e-13);
            CHECK_NEAR(phi[i] + eta[i], f[i], 2e-14);
            CHECK_NEAR(eta[i], (2 * PI - s) / s * turned, 1e-13);
        }
        CHECK_NEAR(f[n - 1] + 2 * PI / s * turning[0], 2 * PI, 1e-14); /* the last turn closes the round */
    }
}

THEOREM(where_nothing_is_enclosed_there_is_no_defect)
{
    chance c = {seed(22)};
    double xy[2 * MOST], length[MOST], turning[MOST], f[MOST], phi[MOST], eta[MOST];
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = 3 + one_of(&c, MOST - 2), i;
        random_star(&c, n, xy);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_PLANE(xy, n), length, turning, NULL));
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_CORRECTED, f));
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_PARALLEL, phi));
        CHECK_OK(surfmink_phases(turning, n, SURFMINK_DEFECT, eta));
        for (i = 0; i < n; ++i) {
            CHECK_NEAR(f[i], phi[i], 5e-14);
            CHECK_NEAR(eta[i], 0, 5e-14);
        }
    }
}

THEOREM(phases_may_take_the_place_of_the_turning_angles)
{
    chance c = {seed(23)};
    double xyz[3 * MOST], length[MOST], turning[MOST], apart[MOST];
    int trial, transport;
    for (trial = 0; trial < 30; ++trial)
        for (transport = 0; transport < 3; ++transport) {
            size_t n = cell(&c, trial, xyz, length, turning);
            CHECK_OK(surfmink_phases(turning, n, transport, apart));
            CHECK_OK(surfmink_phases(turning, n, transport, turning));
            CHECK_SAME(turning, apart, n);
        }
}

/* --- angles, carried ---------------------------------------------------------------------------------------------- */

THEOREM(carried_back_to_edge_0_a_co_normal_has_the_phase_of_its_edge)
{
    /* That is what a phase is (paper 2.3): the angle of the transported co-normal against the co-normal at the
       fiducial point. */
    chance c = {seed(24)};
    double xyz[3 * MOST], length[MOST], turning[MOST], phase[MOST], carried;
    int trial, transport;
    for (trial = 0; trial < 60; ++trial)
        for (transport = 0; transport < 3; ++transport) {
            size_t n = cell(&c, trial, xyz, length, turning), i;
            CHECK_OK(surfmink_phases(turning, n, transport, phase));
            for (i = 0; i < n; ++i) {
                CHECK_OK(surfmink_transport_angle(turning, n, i, -(ptrdiff_t)i, transport, 0.0, &carried));
                CHECK_NEAR(carried, phase[i], 1e-14);
                CHECK_OK(surfmink_transport_angle(turning, n, 0, (ptrdiff_t)i, transport, 0.25, &carried));
                CHECK_NEAR(carried, 0.25 - phase[i], 1e-14);
            }
        }
}

THEOREM(one_round_closes_but_for_the_enclosed_curvature)
{
    chance c = {seed(25)};
    double xyz[3 * MOST], length[MOST], turning[MOST], area, carried;
    int trial;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = cell(&c, trial, xyz, length, turning), from = one_of(&c, n);
        double angle = between(&c, -PI, PI);
        ptrdiff_t round = (ptrdiff_t)n;
        CHECK_OK(surfmink_area(ON_SPHERE(xyz, n, 1.0), &area)); /* on the unit sphere the area is the curvature */
        CHECK_OK(surfmink_transport_angle(turning, n, from, round, SURFMINK_CORRECTED, angle, &carried));
        CHECK_NEAR(carried, angle - 2 * PI, 2e-15);
        CHECK_OK(surfmink_transport_angle(turning, n, from, 3 * round, SURFMINK_CORRECTED, angle, &carried));
        CHECK_NEAR(carried, angle - 6 * PI, 1e-14);
        CHECK_OK(surfmink_transport_angle(turning, n, from, -round, SURFMINK_CORRECTED, angle, &carried));
        CHECK_NEAR(carried, angle + 2 * PI, 2e-15);
        CHECK_OK(surfmink_transport_angle(turning, n, from, round, SURFMINK_PARALLEL, angle, &carried));
        CHECK_NEAR(carried, angle - 2 * PI + area, 2e-14);
        CHECK_OK(surfmink_transport_angle(turning, n, from, round, SURFMINK_DEFECT, angle, &carried));
        CHECK_NEAR(carried, angle - area, 2e-14);
    }
}

THEOREM(transports_add_up_and_undo_each_other)
{
    chance c = {seed(26)};
    double xyz[3 * MOST], length[MOST], turning[MOST], there, on, all, back;
    int trial;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = cell(&c, trial, xyz, length, turning), from = one_of(&c, n), over;
        ptrdiff_t first = (ptrdiff_t)one_of(&c, 3 * n) - (ptrdiff_t)n,
                  second = (ptrdiff_t)one_of(&c, 3 * n) - (ptrdiff_t)n;
        int transport = trial % 3;
        over = (from + 2 * n + (size_t)(first + (ptrdiff_t)n)) % n;
        CHECK_OK(surfmink_transport_angle(turning, n, from, first, transport, 0.5, &there));
        CHECK_OK(surfmink_transport_angle(turning, n, over, second, transport, there, &on));
        CHECK_OK(surfmink_transport_angle(turning, n, from, first + second, transport, 0.5, &all));
        CHECK_NEAR(on, all, 3e-14);
        CHECK_OK(surfmink_transport_angle(turning, n, over, -first, transport, there, &back));
        CHECK_NEAR(back, 0.5, 1e-14);
        CHECK_OK(surfmink_transport_angle(turning, n, from, 0, transport, 0.5, &all));
        CHECK_NEAR(all, 0.5, 0);
    }
}

/* --- vectors in space, carried ------------------------------------------------------------------------------------ */

/* Parallel transport along great circles, from the middle of edge `from` to the middle of the next, without angles:
   it is the rotation of space that moves one point to the other along the edge, once for each half edge. */
static void roll_on(const double *xyz, const double *length, size_t n, size_t from, double *vector)
{
    size_t i;
    for (i = from; i <= from + 1; ++i) {
        double pole[3];
        cross3(xyz + 3 * (i % n), xyz + 3 * ((i + 1) % n), pole);
        turn_about(pole, length[i % n] / 2, vector, 1);
    }
}

THEOREM(parallel_transport_on_the_sphere_rolls_along_great_circles)
{
    chance c = {seed(27)};
    double xyz[3 * MOST], length[MOST], turning[MOST], frame[9], vector[3], rolled[3], carried[3];
    int trial;
    for (trial = 0; trial < 200; ++trial) {
        size_t n = cell(&c, trial, xyz, length, turning), from = one_of(&c, n), step, k;
        CHECK_OK(surfmink_frame(ON_SPHERE(xyz, n, 1.0), from, frame));
        for (k = 0; k < 3; ++k) rolled[k] = vector[k] = 0.6 * frame[k] + 0.8 * frame[3 + k];
        for (step = 1; step <= n + 2; ++step) {
            roll_on(xyz, length, n, (from + step - 1) % n, rolled);
            CHECK_OK(carry(ON_SPHERE(xyz, n, 1.0), turning, from, (ptrdiff_t)step, SURFMINK_PARALLEL, vector, carried));
            for (k = 0; k < 3; ++k) CHECK_NEAR(carried[k], rolled[k], 5e-14);
        }
    }
}

/* Paper, figure (parallel-transport): carried round the octant a vector comes back turned by a right angle, or as it
   was. */
THEOREM(round_the_octant_a_vector_turns_unless_corrected)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double length[3], turning[3], frame[9], carried[3];
    size_t k;
    CHECK_OK(surfmink_edges(ON_SPHERE(corner, 3, 1.0), length, turning, NULL));
    CHECK_OK(surfmink_frame(IN_SPACE(corner, corner, 3), 0, frame));
    /* Edge 0 runs from the pole towards x: the co-normal points away from y. */
    CHECK_NEAR(frame[0], 0, 0);
    CHECK_NEAR(frame[1], -1, 1e-15);
    CHECK_NEAR(frame[2], 0, 0);
    CHECK_OK(carry(IN_SPACE(corner, corner, 3), turning, 0, 3, SURFMINK_CORRECTED, frame, carried));
    for (k = 0; k < 3; ++k) CHECK_NEAR(carried[k], frame[k], 1e-15);
    CHECK_OK(carry(IN_SPACE(corner, corner, 3), turning, 0, 3, SURFMINK_PARALLEL, frame, carried));
    for (k = 0; k < 3; ++k) CHECK_NEAR(carried[k], frame[3 + k], 1e-15); /* from nu a right angle towards tau */
}

THEOREM(carried_vectors_stay_tangent_and_keep_their_length)
{
    static const chart torus = {TORUS, 2.0, 0.9, 0};
    chance c = {seed(28)};
    double xyz[3 * MOST], normal[3 * MOST], length[MOST], turning[MOST], start[9], end[9], vector[3], carried[3],
        back[3];
    int trial;
    for (trial = 0; trial < 300; ++trial) {
        size_t n = 3 + one_of(&c, 20), from = one_of(&c, n), to, k;
        ptrdiff_t steps = (ptrdiff_t)one_of(&c, 3 * n) - (ptrdiff_t)n;
        int transport = trial % 3;
        double angle;
        star_on_chart(&c, &torus, between(&c, 0, 6), between(&c, 0, 6), 0.4, n, xyz, normal);
        CASE("trial %d", trial);
        CHECK_OK(surfmink_edges(IN_SPACE(xyz, normal, n), length, turning, NULL));
        to = (from + (size_t)(steps + (ptrdiff_t)n)) % n;
        CHECK_OK(surfmink_frame(IN_SPACE(xyz, normal, n), from, start));
        CHECK_OK(surfmink_frame(IN_SPACE(xyz, normal, n), to, end));
        for (k = 0; k < 3; ++k)
            vector[k] = 3 * start[k] - 4 * start[3 + k] + 7 * start[6 + k]; /* 7 along the normal is dropped */
        CHECK_OK(carry(IN_SPACE(xyz, normal, n), turning, from, steps, transport, vector, carried));
        CHECK_NEAR(dot3(carried, end + 6), 0, 1e-14);
        CHECK_CLOSE(dot3(carried, carried), 25, 1e-14);
        /* Its angle against the frame where it arrives is the carried angle. */
        CHECK_OK(surfmink_transport_angle(turning, n, from, steps, transport, atan2(-4, 3), &angle));
        CHECK_ANGLE(atan2(dot3(carried, end + 3), dot3(carried, end)), angle, 1e-14);
        CHECK_OK(carry(IN_SPACE(xyz, normal, n), turning, to, -steps, transport, carried, back));
        for (k = 0; k < 3; ++k) CHECK_NEAR(back[k], 3 * start[k] - 4 * start[3 + k], 3e-14);
        CHECK_OK(surfmink_transport_vector(IN_SPACE(xyz, normal, n), turning, from, steps, transport,
                                           vector)); /* in place */
        CHECK_SAME(vector, carried, 3);
    }
}

int main(void)
{
    PROVE(a_phase_is_the_turn_since_edge_0_over_that_of_one_round);
    PROVE(the_corrected_phase_is_the_parallel_one_plus_the_defect);
    PROVE(where_nothing_is_enclosed_there_is_no_defect);
    PROVE(phases_may_take_the_place_of_the_turning_angles);
    PROVE(carried_back_to_edge_0_a_co_normal_has_the_phase_of_its_edge);
    PROVE(one_round_closes_but_for_the_enclosed_curvature);
    PROVE(transports_add_up_and_undo_each_other);
    PROVE(parallel_transport_on_the_sphere_rolls_along_great_circles);
    PROVE(round_the_octant_a_vector_turns_unless_corrected);
    PROVE(carried_vectors_stay_tangent_and_keep_their_length);
    return QED();
}
