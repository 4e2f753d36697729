/* How far one smallest rotation carries a direction: the transport of docs/field.md against the geodesic.
   cc -I. tests/test_field.c -lm && ./a.out

   The tangent of a geodesic is parallel along it. So the smallest rotation n(x) -> n(y) is off by the angle delta
   between the tangent at y and that at x, so rotated. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "harness.h"
#include "shapes.h"

enum { RANK = 6, SPACINGS = 6 };

/* A circle with its centre on the x axis, revolved about z: a torus, or if the centre is 0 a sphere. */
typedef struct revolved {
    double axis, tube; /* radii */
} revolved;

static const revolved sphere = {0, 1}, torus = {2, 0.8};

/* A geodesic as u, v, du/ds, dv/ds: u about the axis, v about the tube. */
static void slope_of(const revolved *s, const double x[4], double by_length[4])
{
    double r = s->axis + s->tube * cos(x[1]), fall = -s->tube * sin(x[1]); /* dr/dv */
    by_length[0] = x[2];
    by_length[1] = x[3];
    by_length[2] = -2 * fall / r * x[2] * x[3];
    by_length[3] = r * fall / (s->tube * s->tube) * x[2] * x[2];
}

/* Runge and Kutta's fourth order. */
static void walk(const revolved *s, double x[4], double length)
{
    enum { STEPS = 200 };
    const double h = length / STEPS, share[4] = {1. / 6, 1. / 3, 1. / 3, 1. / 6}, reach[4] = {0, 0.5, 0.5, 1};
    double k[4] = {0, 0, 0, 0}, at[4], sum[4];
    int step, stage, j;
    for (step = 0; step < STEPS; ++step) {
        for (j = 0; j < 4; ++j) sum[j] = x[j];
        for (stage = 0; stage < 4; ++stage) {
            for (j = 0; j < 4; ++j) at[j] = x[j] + reach[stage] * h * k[j];
            slope_of(s, at, k);
            for (j = 0; j < 4; ++j) sum[j] += share[stage] * h * k[j];
        }
        for (j = 0; j < 4; ++j) x[j] = sum[j];
    }
}

/* Normal and unit tangent. */
static void frame_of(const revolved *s, const double x[4], double n[3], double t[3])
{
    double r = s->axis + s->tube * cos(x[1]), radial = -s->tube * sin(x[1]) * x[3];
    n[0] = cos(x[1]) * cos(x[0]);
    n[1] = cos(x[1]) * sin(x[0]);
    n[2] = sin(x[1]);
    t[0] = radial * cos(x[0]) - r * x[2] * sin(x[0]);
    t[1] = radial * sin(x[0]) + r * x[2] * cos(x[0]);
    t[2] = s->tube * cos(x[1]) * x[3];
}

/* Angle by which the smallest rotation misses. */
static double missed(const double m[3], const double t[3], const double n[3], const double u[3])
{
    double turned[3], part = (t[0] * n[0] + t[1] * n[1] + t[2] * n[2]) / (1 + m[0] * n[0] + m[1] * n[1] + m[2] * n[2]);
    double along = 0, across = 0;
    int k;
    for (k = 0; k < 3; ++k) turned[k] = t[k] - part * (m[k] + n[k]);
    for (k = 0; k < 3; ++k) along += turned[k] * u[k];
    for (k = 0; k < 3; ++k) across += turned[k] * (n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3]);
    return atan2(across, along);
}

/* Mean of cos(6 delta) over geodesics of this length from points with v between lowest and highest, by area, whose
   normals end less than 90 degrees apart, as for the coarse field. */
static double agreement(chance *c, const revolved *s, double lowest, double highest, double length)
{
    const int draws = 1000;
    double sum = 0, x[4], m[3], t[3], n[3], u[3], r, angle;
    int count = 0, draw;
    for (draw = 0; draw < draws; ++draw) {
        do {
            x[1] = between(c, lowest, highest);
            r = s->axis + s->tube * cos(x[1]);
        } while (between(c, 0, s->axis + s->tube) > r);
        angle = between(c, -PI, PI);
        x[0] = 0;
        x[2] = cos(angle) / r;
        x[3] = sin(angle) / s->tube;
        frame_of(s, x, m, t);
        walk(s, x, length);
        frame_of(s, x, n, u);
        if (m[0] * n[0] + m[1] * n[1] + m[2] * n[2] <= 0) continue;
        sum += cos(RANK * missed(m, t, n, u));
        ++count;
    }
    CHECK(count > draws / 10);
    return sum / count;
}

THEOREM(on_a_sphere_one_rotation_is_the_transport)
{
    chance c = {1};
    int k;
    for (k = 1; k <= SPACINGS; ++k)
        CHECK_NEAR(agreement(&c, &sphere, -0.2, 0.2, 0.2 * k), 1, 1e-9); /* not over a pole */
}

/* The inner half of a torus is a saddle. Spacings are those of as many hexagons. */
THEOREM(on_saddles_one_rotation_is_good_to_three_spacings)
{
    const double area = 4 * PI * PI * torus.axis * torus.tube;
    const int cells[3] = {400, 1000, 4000};
    double inside[3][SPACINGS + 1], all;
    chance c = {2};
    int i, k;
    for (i = 0; i < 3; ++i)
        for (k = 1; k <= SPACINGS; ++k) {
            double length = k * sqrt(2 / sqrt(3.) * area / cells[i]);
            inside[i][k] = agreement(&c, &torus, 0.5 * PI, 1.5 * PI, length);
            all = agreement(&c, &torus, 0, 2 * PI, length);
            NOTE("torus of %d cells, %d spacings (%.2f): <cos 6 delta> %.3f from the inner half, %.3f from all of it",
                 cells[i], k, length, inside[i][k], all);
            CHECK(all > inside[i][k] - 0.02);
            if (k > 1) CHECK(inside[i][k] < inside[i][k - 1] + 0.001);
        }
    CHECK(inside[0][2] > 0.98 && inside[0][3] < 0.95);
    CHECK(inside[1][3] > 0.98 && inside[1][4] < 0.96 && inside[1][6] < 0.6);
    CHECK(inside[2][6] > 0.98);
}

int main(void)
{
    PROVE(on_a_sphere_one_rotation_is_the_transport);
    PROVE(on_saddles_one_rotation_is_good_to_three_spacings);
    return QED();
}
