/* Outlines that cross themselves: examples/beyond/crossings.h.
   cc -I. tests/test_crossings.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "examples/beyond/crossings.h"

#include "chance.h"
#include "harness.h"

static const double third = 1.0471975511965976; /* pi / 3 */

/* The same outline from every corner, both ways round: the answer must not depend on it. */
static void check_all_ways(const double *corner, size_t n, int want)
{
    double turned[200];
    size_t pair[2], first, i, way;
    for (first = 0; first < n; ++first)
        for (way = 0; way < 2; ++way) {
            for (i = 0; i < n; ++i) {
                size_t from = way ? (first + n - i) % n : (first + i) % n;
                turned[2 * i] = corner[2 * from];
                turned[2 * i + 1] = corner[2 * from + 1];
            }
            CHECK_EQUAL(crossings_plane(turned, n, pair), want);
        }
}

THEOREM(crossings_with_turning_number_one_are_found)
{
    static const double grid[] = {1, 0, 1, 6, 0, 6, 6, 4, 0, 0}, bow[] = {0, 0, 4, 4, 4, 0, 0, 4};
    size_t pair[2];
    CHECK_EQUAL(crossings_plane(grid, 5, pair), 1);
    CHECK_EQUAL(pair[0], 0);
    CHECK(pair[1] == 2 || pair[1] == 3);
    check_all_ways(grid, 5, 1);
    check_all_ways(bow, 4, 1);
    CHECK_EQUAL(crossings_plane(bow, 4, pair), 1);
    CHECK(pair[0] == 0 && pair[1] == 2);
}

THEOREM(what_touches_or_lies_on_itself_does_not_cross)
{
    /* a needle, a square with a whisker, two squares that touch in a corner, an hourglass, a corner that touches a
       side, a keyhole */
    static const double needle[] = {3, 3, 4, 3, 5, 3, 6, 3, 5, 3, 4, 3};
    static const double whisker[] = {0, 0, 4, 0, 4, 4, 2, 4, 2, 3, 2, 4, 0, 4};
    static const double two[] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0, -1, 0, -1, -1, 0, -1};
    static const double hourglass[] = {0, 0, 1, 1, 2, 0, 2, 2, 1, 1, 0, 2};
    static const double touch[] = {0, 0, 4, 0, 4, 4, 2, 0, 0, 4};
    static const double keyhole[] = {0, 0, 6, 0, 6, 6, 0, 6, 0, 0, 2, 2, 2, 4, 4, 4, 4, 2, 2, 2};
    check_all_ways(needle, 6, 0);
    check_all_ways(whisker, 7, 0);
    check_all_ways(two, 8, 0);
    check_all_ways(hourglass, 6, 0);
    check_all_ways(touch, 5, 0);
    check_all_ways(keyhole, 10, 0);
}

THEOREM(what_crosses_in_a_corner_crosses)
{
    /* through a corner of its own, through the middle of a side */
    static const double eight[] = {0, 0, 1, 1, 2, 2, 2, 0, 1, 1, 0, 2};
    static const double through[] = {0, 0, 4, 0, 4, 2, 2, 0, 1, -2, 0, -2};
    check_all_ways(eight, 6, 1);
    check_all_ways(through, 6, 1);
}

/* Corners a few units in the last place off a line: the sign is that of integers. */
THEOREM(orientation_is_exact)
{
    chance dice = {12345};
    long i;
    for (i = 0; i < 200000 / FEWER; ++i) {
        /* a, b, c = base + k unit on a line, c moved by d units: the sign of the determinant is that of d times the
           way */
        double unit = ldexp(1, -50), base = 0.5, k = 1 + floor(1000 * between(&dice, 0, 1)),
               m = 1 + floor(1000 * between(&dice, 0, 1));
        double d = floor(3 * between(&dice, 0, 1)) - 1, a[2], b[2], c[2], got;
        a[0] = base, a[1] = base;
        b[0] = base + k * unit, b[1] = base + k * unit;
        c[0] = base + (k + m) * unit, c[1] = base + (k + m + d) * unit;
        got = crossings_orientation(a, b, c);
        CHECK_EQUAL((got > 0) - (got < 0), (d > 0) - (d < 0));
        got = crossings_orientation(b, a, c);
        CHECK_EQUAL((got > 0) - (got < 0), (d < 0) - (d > 0));
    }
}

/* Against all pairs, in rationals of small integers: outlines on a grid, where everything touches everything. */
static int plain_cross(const double *x, size_t n)
{
    size_t i, j;
    for (i = 0; i < n; ++i)
        for (j = i + 2; j < n; ++j) {
            const double *a = x + 2 * i, *b = x + 2 * ((i + 1) % n), *c = x + 2 * j, *d = x + 2 * ((j + 1) % n);
            double s1, s2, s3, s4;
            if (i == 0 && j + 1 == n) continue;
            s1 = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            s2 = (b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]);
            s3 = (d[0] - c[0]) * (a[1] - c[1]) - (d[1] - c[1]) * (a[0] - c[0]);
            s4 = (d[0] - c[0]) * (b[1] - c[1]) - (d[1] - c[1]) * (b[0] - c[0]);
            if (s1 * s2 < 0 && s3 * s4 < 0) return 1;
        }
    return 0;
}

THEOREM(random_outlines_cross_where_all_pairs_say_so)
{
    chance dice = {777};
    long t, crossed = 0, trials = 20000 / FEWER;
    for (t = 0; t < trials; ++t) {
        double x[24], space[36];
        size_t n = 4 + (size_t)(8 * between(&dice, 0, 1)), i, pair[2];
        int want;
        for (i = 0; i < 2 * n; ++i) x[i] = between(&dice, 0, 1) - 0.5;
        want = plain_cross(x, n);
        crossed += want;
        CHECK_EQUAL(crossings_plane(x, n, pair), want);
        for (i = 0; i < n; ++i) { /* the same on a sphere, seen from its centre: lines are great circles */
            space[3 * i] = x[2 * i], space[3 * i + 1] = x[2 * i + 1], space[3 * i + 2] = 0.7;
        }
        CHECK_EQUAL(crossings_sphere(space, n, pair), want);
        for (i = 0; i < n; ++i) space[3 * i + 2] = x[2 * i] * x[2 * i + 1];
        {
            double normal[36];
            for (i = 0; i < 3 * n; ++i) normal[i] = i % 3 == 2;
            CHECK_EQUAL(crossings_embedded(space, normal, n, pair), want);
        }
    }
    CHECK(crossed > trials / 10 && crossed < trials); /* both occur */
}

/* Stars and their likes have no crossings; with two corners exchanged they have. */
THEOREM(an_exchange_of_two_corners_is_found)
{
    chance dice = {4242};
    long t;
    for (t = 0; t < 2000 / FEWER; ++t) {
        double x[200], sphere[300], r;
        size_t n = 8 + (size_t)(80 * between(&dice, 0, 1)), i, pair[2], at, k;
        for (i = 0; i < n; ++i) {
            r = 0.5 + 0.5 * between(&dice, 0, 1);
            x[2 * i] = r * cos(6 * third * (double)i / (double)n);
            x[2 * i + 1] = r * sin(6 * third * (double)i / (double)n);
        }
        CHECK_EQUAL(crossings_plane(x, n, pair), 0);
        for (i = 0; i < n; ++i) sphere[3 * i] = x[2 * i], sphere[3 * i + 1] = x[2 * i + 1], sphere[3 * i + 2] = 1;
        CHECK_EQUAL(crossings_sphere(sphere, n, pair), 0);
        at = (size_t)((double)(n - 4) * between(&dice, 0, 1));
        for (k = 0; k < 2; ++k) {
            double swap = x[2 * at + k];
            x[2 * at + k] = x[2 * (at + 3) + k], x[2 * (at + 3) + k] = swap;
        }
        CHECK_EQUAL(crossings_plane(x, n, pair), plain_cross(x, n));
    }
}

/* Arcs whose great circles meet at the antipode only, and a cell of 1e-8, crossed and not. */
THEOREM(arcs_are_not_circles_and_small_cells_are_cells)
{
    static const double square[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    double x[12];
    size_t i, pair[2];
    int crossed;
    for (crossed = 0; crossed < 2; ++crossed) {
        for (i = 0; i < 4; ++i) {
            const double *at = square[crossed ? (i == 1 ? 2 : i == 2 ? 1 : i) : i];
            x[3 * i] = 0.6 + 1e-8 * (at[0] - 0.75 * at[1]);
            x[3 * i + 1] = 1e-8 * at[1];
            x[3 * i + 2] = sqrt(1 - x[3 * i] * x[3 * i] - x[3 * i + 1] * x[3 * i + 1]);
        }
        CHECK_EQUAL(crossings_sphere(x, 4, pair), crossed);
    }
    /* one edge near +x, the other near -x, on circles that cross */
    {
        static const double far_away[12] = {1, 0.1, 0.1, 1, -0.1, -0.1, -1, 0.1, -0.1, -1, -0.1, 0.1};
        CHECK_EQUAL(crossings_sphere(far_away, 4, pair), 0);
    }
}

THEOREM(normals_that_fold_over_are_unknown)
{
    static const double corner[12] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const double flat[12] = {0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4},
                        folded[12] = {0, 0, 1, 0, 0, 1, 9, 0, 1, 0, 0, 1},
                        bow_tie[12] = {0, 0, 0, 2, 0, 0, 0, 2, 0, 1, 2, 0},
                        opposite[12] = {0, 1, 1, 0, 1, -1, 0, -1, 1, 0, -1, -1};
    size_t pair[2];
    CHECK_EQUAL(crossings_embedded(corner, flat, 4, pair), 0);
    CHECK_EQUAL(crossings_embedded(corner, folded, 4, pair), CROSSINGS_UNKNOWN);
    CHECK_EQUAL(crossings_embedded(bow_tie, flat, 4, pair), 1);
    CHECK_EQUAL(crossings_embedded(bow_tie, folded, 4, pair), CROSSINGS_SEEN);
    CHECK_EQUAL(pair[0], 1);
    CHECK_EQUAL(pair[1], 3);
    CHECK_EQUAL(crossings_embedded(corner, opposite, 4, pair), CROSSINGS_UNKNOWN);
    CHECK_EQUAL(crossings_embedded(bow_tie, opposite, 4, pair), CROSSINGS_SEEN);
}

int main(void)
{
    PROVE(crossings_with_turning_number_one_are_found);
    PROVE(what_touches_or_lies_on_itself_does_not_cross);
    PROVE(what_crosses_in_a_corner_crosses);
    PROVE(orientation_is_exact);
    PROVE(random_outlines_cross_where_all_pairs_say_so);
    PROVE(an_exchange_of_two_corners_is_found);
    PROVE(arcs_are_not_circles_and_small_cells_are_cells);
    PROVE(normals_that_fold_over_are_unknown);
    return QED();
}
