/* What is drawn wrong is named, blamed on a corner where one is to blame, and changes nothing.
   cc -I. tests/test_errors.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <float.h>

#include "harness.h"
#include "shapes.h"

enum { TRIALS = FEWER > 100 ? 2000 : 12000 };

/* Room for every output of every call. Before each refusal it is filled with a pattern, which has to survive. */
static struct {
    double mu[40], g[80], length[40], turning[40], vector[120];
    surfmink_functionals w;
} out, untouched;
static size_t bad;

#define NOBODY 12345

static void fill(void)
{
    memset(&out, 0xA5, sizeof out);
    memset(&untouched, 0xA5, sizeof untouched);
    bad = NOBODY;
}

static int nothing_written(void)
{
    return memcmp(&out, &untouched, sizeof out) == 0;
}

#define REFUSES(call, status)        (fill(), CHECK_STATUS(call, status), CHECK(nothing_written()))
#define BLAMES(call, status, corner) (REFUSES(call, status), CHECK_EQUAL(bad, corner))
/* An edge has two corners: either may take the blame. */
#define BLAMES_EITHER(call, status, a, b) (REFUSES(call, status), CHECK(bad == (a) || bad == (b)))

static double infinity_(void)
{
    return HUGE_VAL;
}

static double nan_(void)
{
    return nan("");
}

/* --- the names ---------------------------------------------------------------------------------------------------- */

THEOREM(every_status_has_its_own_sentence_and_word)
{
    static const char *const word[13] = {"ok",
                                         "too_few_corners",
                                         "not_finite",
                                         "coincident_corners",
                                         "zero_normal",
                                         "upright_edge",
                                         "antipodal_corners",
                                         "clockwise",
                                         "too_much_curvature",
                                         "crosses_itself",
                                         "callback_failed",
                                         "bad_argument",
                                         "opposite_normals"};
    int a, b;
    CHECK_EQUAL(SURFMINK_OK, 0);
    CHECK_EQUAL(SURFMINK_BAD_ARGUMENT, 11);
    CHECK_EQUAL(SURFMINK_OPPOSITE_NORMALS, 12);
    for (a = 0; a < 13; ++a) {
        CASE("status %d", a);
        CHECK(strcmp(surfmink_status_name(a), word[a]) == 0);
        CHECK(strlen(surfmink_strerror(a)) > 5);
        for (b = 0; b < a; ++b) CHECK(strcmp(surfmink_strerror(a), surfmink_strerror(b)) != 0);
    }
    for (a = -3; a < 40; a = a == -1 ? 13 : a + 1) {
        CASE("status %d", a);
        CHECK(strcmp(surfmink_status_name(a), "") == 0);
        CHECK(strcmp(surfmink_strerror(a), "") == 0);
    }
}

/* --- outlines that are wrong whatever the surface ----------------------------------------------------------------- */

/* The four kinds of surfaces behind one call, so that what is true of all is said once: the plane, the sphere, the same
   with its corners as normals, and the plane by callbacks. */
enum kind { PLANE, SPHERE, EMBEDDED, SURFACE, KINDS };
static const char *const kind_name[KINDS] = {"plane", "sphere", "embedded", "surface"};

static int measure(enum kind kind, const double *corner, size_t n, int max_rank)
{
    surfmink_surface plane = spinning_plane();
    switch (kind) {
    case PLANE: return surfmink_measure(IN_PLANE(corner, n), max_rank, out.mu, out.g, &out.w, &bad);
    case SPHERE: return surfmink_measure(ON_SPHERE(corner, n, 1.0), max_rank, out.mu, out.g, &out.w, &bad);
    case EMBEDDED: return surfmink_measure(IN_SPACE(corner, corner, n), max_rank, out.mu, out.g, &out.w, &bad);
    default: return surfmink_measure(ON_SURFACE(&plane, corner, n), max_rank, out.mu, out.g, &out.w, &bad);
    }
}

static int edges(enum kind kind, const double *corner, size_t n)
{
    surfmink_surface plane = spinning_plane();
    switch (kind) {
    case PLANE: return surfmink_edges(IN_PLANE(corner, n), out.length, out.turning, &bad);
    case SPHERE: return surfmink_edges(ON_SPHERE(corner, n, 1.0), out.length, out.turning, &bad);
    case EMBEDDED: return surfmink_edges(IN_SPACE(corner, corner, n), out.length, out.turning, &bad);
    default: return surfmink_edges(ON_SURFACE(&plane, corner, n), out.length, out.turning, &bad);
    }
}

/* A counter-clockwise pentagon on any of them; returns the number of doubles of a corner. */
static size_t pentagon(enum kind kind, double *corner)
{
    double xy[10];
    size_t i;
    for (i = 0; i < 5; ++i) {
        xy[2 * i] = cos(2 * PI * (double)i / 5);
        xy[2 * i + 1] = sin(2 * PI * (double)i / 5);
    }
    if (kind == PLANE || kind == SURFACE) {
        memcpy(corner, xy, sizeof xy);
        return 2;
    }
    onto_sphere(xy, 5, 0.5, corner);
    return 3;
}

THEOREM(fewer_than_three_corners_are_too_few)
{
    double corner[15];
    int kind;
    size_t n;
    for (kind = 0; kind < KINDS; ++kind)
        for (n = 0; n < 3; ++n) {
            pentagon((enum kind)kind, corner);
            CASE("%s, %d corners", kind_name[kind], (int)n);
            BLAMES(measure((enum kind)kind, corner, n, 3), SURFMINK_TOO_FEW_CORNERS, n);
            BLAMES(edges((enum kind)kind, corner, n), SURFMINK_TOO_FEW_CORNERS, n);
        }
}

THEOREM(a_corner_that_is_not_finite_is_blamed)
{
    double corner[15], wrong[3];
    int kind, what;
    size_t k;
    wrong[0] = nan_(), wrong[1] = infinity_(), wrong[2] = -infinity_();
    for (kind = 0; kind < SURFACE; ++kind) /* corners of a surface by callbacks are opaque */
        for (what = 0; what < 3; ++what) {
            size_t stride = pentagon((enum kind)kind, corner);
            for (k = 0; k < 5 * stride; ++k) {
                double kept = corner[k];
                corner[k] = wrong[what];
                CASE("%s, %g in place %d", kind_name[kind], wrong[what], (int)k);
                BLAMES(measure((enum kind)kind, corner, 5, 3), SURFMINK_NOT_FINITE, k / stride);
                BLAMES(edges((enum kind)kind, corner, 5), SURFMINK_NOT_FINITE, k / stride);
                corner[k] = kept;
            }
        }
}

THEOREM(neighbours_that_coincide_are_blamed)
{
    double corner[15];
    int kind;
    size_t i;
    for (kind = 0; kind < KINDS; ++kind)
        for (i = 0; i < 5; ++i) {
            size_t stride = pentagon((enum kind)kind, corner), next = (i + 1) % 5;
            memcpy(corner + next * stride, corner + i * stride, stride * sizeof *corner);
            CASE("%s, corners %d and %d", kind_name[kind], (int)i, (int)next);
            BLAMES_EITHER(measure((enum kind)kind, corner, 5, 3), SURFMINK_COINCIDENT_CORNERS, i, next);
            BLAMES_EITHER(edges((enum kind)kind, corner, 5), SURFMINK_COINCIDENT_CORNERS, i, next);
            if (kind != SPHERE) continue;
            corner[3 * next] *= 2, corner[3 * next + 1] *= 2,
                corner[3 * next + 2] *= 2; /* the same direction is the same point */
            BLAMES_EITHER(measure((enum kind)kind, corner, 5, 3), SURFMINK_COINCIDENT_CORNERS, i, next);
        }
}

THEOREM(on_the_sphere_one_direction_is_one_point_however_far_off)
{
    double corner[12] = {1, 2, 3, 0, 0, 0, -2, 1, 2, -1, -2, 2};
    chance c = {seed(92)};
    int factor, trial;
    size_t k;
    for (factor = 1; factor < 200; ++factor) { /* whole numbers, so that the direction is the same to the bit */
        for (k = 0; k < 3; ++k) corner[3 + k] = factor * corner[k];
        CASE("times %d", factor);
        BLAMES_EITHER(measure(SPHERE, corner, 4, 3), SURFMINK_COINCIDENT_CORNERS, 0, 1);
        BLAMES_EITHER(edges(SPHERE, corner, 4), SURFMINK_COINCIDENT_CORNERS, 0, 1);
        for (k = 0; k < 3; ++k) corner[3 + k] *= -1;
        BLAMES_EITHER(edges(SPHERE, corner, 4), SURFMINK_ANTIPODAL_CORNERS, 0, 1);
    }
    for (trial = 0; trial < 200; ++trial) { /* nor does the rounding of a longer vector make another point */
        double stretch = between(&c, 50, 1000);
        for (k = 0; k < 3; ++k) {
            corner[k] = between(&c, 0.1, 1);
            corner[3 + k] = stretch * corner[k];
        }
        CASE("times %.17g", stretch);
        BLAMES_EITHER(edges(SPHERE, corner, 4), SURFMINK_COINCIDENT_CORNERS, 0, 1);
    }
}

THEOREM(corners_may_meet_again_if_they_are_not_neighbours)
{
    double corner[18];
    int kind;
    for (kind = 0; kind < KINDS; ++kind) {
        size_t stride = pentagon((enum kind)kind, corner);
        memcpy(corner + 5 * stride, corner + 3 * stride, stride * sizeof *corner); /* 0 1 2 3 4 3, a whisker at 4 */
        CASE("%s", kind_name[kind]);
        CHECK_OK(edges((enum kind)kind, corner, 6));
        CHECK_NEAR(out.turning[4], PI, 0);
    }
}

THEOREM(clockwise_outlines_are_named)
{
    double corner[15];
    int kind;
    for (kind = 0; kind < KINDS; ++kind) {
        size_t stride = pentagon((enum kind)kind, corner);
        CASE("%s", kind_name[kind]);
        CHECK_OK(measure((enum kind)kind, corner, 5, 3));
        surfmink_reverse(corner, 5, stride);
        BLAMES(measure((enum kind)kind, corner, 5, 3), SURFMINK_CLOCKWISE, 5);
        fill();
        CHECK_OK(edges((enum kind)kind, corner, 5)); /* lengths and angles say nothing about the outline as a whole */
        CHECK_EQUAL(bad, NOBODY);
    }
}

/* Towards the last corner and away from it the outline turns by so little that no product of its edges can tell. */
THEOREM(clockwise_is_found_out_where_a_turn_is_next_to_nothing)
{
    const double far[8] = {8e153, -1e-155, -1e153, -3e154, -2e66, 0, 0, 0};
    double corner[8];
    int k, e;
    for (e = 0; e >= -200; e -= 10) {
        for (k = 0; k < 8; ++k) corner[k] = ldexp(far[k], e);
        CASE("2^%d", e);
        BLAMES(measure(PLANE, corner, 4, 3), SURFMINK_CLOCKWISE, 4);
    }
}

THEOREM(a_rank_is_not_negative)
{
    double corner[15];
    int kind;
    for (kind = 0; kind < KINDS; ++kind) {
        pentagon((enum kind)kind, corner);
        CASE("%s", kind_name[kind]);
        BLAMES(measure((enum kind)kind, corner, 5, -1), SURFMINK_BAD_ARGUMENT, 5);
        fill();
        CHECK_OK(measure((enum kind)kind, corner, 5, 0));
        CHECK_NEAR(out.mu[0], 1, 0);
        CHECK(memcmp(out.mu + 1, untouched.mu + 1, sizeof out.mu - sizeof *out.mu) == 0); /* P + 1 numbers, no more */
        CHECK(memcmp(out.g + 2, untouched.g + 2, sizeof out.g - 2 * sizeof *out.g) == 0);
    }
}

THEOREM(the_blame_may_be_left_out)
{
    static const double line[6] = {0, 0, 1, 0, 1, 0};
    double radius = 1;
    surfmink_surface sphere = surfmink_sphere_surface(&radius), plane = spinning_plane();
    static const double same[9] = {0, 0, 1, 0, 0, 1, 0, 1, 0};
    REFUSES(surfmink_measure(IN_PLANE(line, 3), 1, out.mu, out.g, &out.w, NULL), SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_measure(ON_SPHERE(same, 3, 1.0), 1, out.mu, out.g, &out.w, NULL), SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_measure(IN_SPACE(same, same, 3), 1, out.mu, out.g, &out.w, NULL), SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_measure(ON_SURFACE(&sphere, same, 3), 1, out.mu, out.g, &out.w, NULL),
            SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_edges(IN_PLANE(line, 3), out.length, out.turning, NULL), SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_edges(ON_SPHERE(same, 3, 1.0), out.length, out.turning, NULL), SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_edges(IN_SPACE(same, same, 3), out.length, out.turning, NULL), SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_edges(ON_SURFACE(&plane, line, 3), out.length, out.turning, NULL), SURFMINK_COINCIDENT_CORNERS);
}

/* --- outlines that are wrong on one kind of surface --------------------------------------------------------------- */

THEOREM(what_overflows_is_not_finite)
{
    static const double square[8] = {0, 0, 0.9e308, 0, 0.9e308, 0.9e308, 0, 0.9e308}, quarter[4] = {1.5, 1.5, 1.5, 1.5};
    double wide[6], corner[15], length[4], area;
    surfmink_functionals w;
    wide[0] = -1e308, wide[1] = 0, wide[2] = 1e308, wide[3] = 0, wide[4] = 0, wide[5] = 1e308; /* a difference */
    REFUSES(surfmink_measure(IN_PLANE(wide, 3), 3, out.mu, out.g, &out.w, &bad), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_edges(IN_PLANE(wide, 3), out.length, out.turning, &bad), SURFMINK_NOT_FINITE);
    wide[0] = -0.8e308, wide[1] = -0.8e308, wide[2] = 0.8e308, wide[3] = 0.8e308, wide[4] = -0.8e308,
    wide[5] = 0.8e308; /* a length */
    REFUSES(surfmink_edges(IN_PLANE(wide, 3), out.length, out.turning, &bad), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_measure(IN_PLANE(wide, 3), 3, out.mu, out.g, &out.w, &bad), SURFMINK_NOT_FINITE);
    wide[0] = 0, wide[1] = 0, wide[2] = 1e160, wide[3] = 0, wide[4] = 0, wide[5] = 1e160; /* an area */
    REFUSES(surfmink_measure(IN_PLANE(wide, 3), 3, out.mu, out.g, &out.w, &bad), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_area(IN_PLANE(wide, 3), &out.mu[0]), SURFMINK_NOT_FINITE);
    wide[2] = wide[5] = 1.9e154;
    BLAMES(measure(PLANE, wide, 3, 3), SURFMINK_NOT_FINITE, 3);
    REFUSES(surfmink_area(IN_PLANE(wide, 3), &out.mu[0]), SURFMINK_NOT_FINITE);
    wide[2] = wide[5] = 1.6e154; /* twice an area, not the area */
    CHECK_OK(surfmink_measure(IN_PLANE(wide, 3), 3, NULL, NULL, &w, NULL));
    CHECK_CLOSE(w.area, 1.28e308, 1e-15);
    CHECK_OK(surfmink_area(IN_PLANE(wide, 3), &area));
    CHECK_CLOSE(area, 1.28e308, 1e-15);
    CHECK_OK(surfmink_edges(IN_PLANE(wide, 3), out.length, out.turning, &bad));
    pentagon(SPHERE, corner);
    REFUSES(surfmink_measure(ON_SPHERE(corner, 5, 1e160), 3, out.mu, out.g, &out.w, &bad), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_area(ON_SPHERE(corner, 5, 1e160), &out.mu[0]), SURFMINK_NOT_FINITE);
    CHECK_OK(surfmink_edges(ON_SPHERE(corner, 5, 1e160), out.length, out.turning, &bad));
    onto_sphere(corner, 5, 1.0, corner);
    CHECK_OK(surfmink_area(ON_SPHERE(corner, 5, 1e100), &area));
    REFUSES(surfmink_measure(IN_PLANE(square, 4), 3, out.mu, out.g, &out.w, &bad), SURFMINK_NOT_FINITE); /* a sum */
    CHECK_OK(surfmink_edges(IN_PLANE(square, 4), length, out.turning, &bad));
    REFUSES(surfmink_total(NULL, length, quarter, 4, &out.w), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_irreducible(length, quarter, 4, 3, out.g), SURFMINK_NOT_FINITE);
}

/* Below the normal range a double has fewer digits, and mu would be off by 1e-4 without a word, as it was in 0.3.0. */
THEOREM(lengths_below_the_normal_range_are_refused)
{
    static const double scale[2] = {8, 0.25}; /* of the shortest normal length */
    double corner[15], tiny[15], radius;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    size_t offset[2] = {0, 5}, i;
    surfmink_results results = {NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    int kind, k, status = -1;
    results.status = &status;
    for (kind = 0; kind < SURFACE; ++kind)
        for (k = 0; k < 2; ++k) {
            const double by = scale[k] * DBL_MIN;
            const int want = k ? SURFMINK_NOT_FINITE : SURFMINK_OK;
            pentagon((enum kind)kind, corner);
            radius = by;
            for (i = 0; i < 15; ++i) tiny[i] = corner[i] * by;
            CASE("%s, %g", kind_name[kind], by);
            fill();
            switch (kind) {
            case SPHERE: /* the radius is the unit */
                CHECK_STATUS(surfmink_edges(ON_SPHERE(corner, 5, by), out.length, out.turning, &bad), want);
                CHECK_STATUS(surfmink_edges(ON_SURFACE(&sphere, corner, 5), out.length, out.turning, &bad), want);
                surfmink_batch(ON_SPHERE(corner, 5, by), offset, 1, 2, &results, NULL);
                break;
            case EMBEDDED:
                CHECK_STATUS(surfmink_edges(IN_SPACE(tiny, corner, 5), out.length, out.turning, &bad), want);
                surfmink_batch(IN_SPACE(tiny, corner, 5), offset, 1, 2, &results, NULL);
                break;
            default:
                CHECK_STATUS(surfmink_edges(IN_PLANE(tiny, 5), out.length, out.turning, &bad), want);
                surfmink_batch(IN_PLANE(tiny, 5), offset, 1, 2, &results, NULL);
            }
            CHECK_STATUS(status, want);
        }
}

/* Each coordinate is looked at: corners that differ in one alone are two. */
THEOREM(corners_that_differ_in_one_coordinate_do_not_coincide)
{
    static const double up[9] = {1, 1, 1, 1, 1, 1, 1, 1, 1};
    double corner[9], length[3], turning[3];
    size_t k, dim;
    for (dim = 2; dim <= 3; ++dim)
        for (k = 0; k < dim; ++k) {
            size_t i;
            for (i = 0; i < 9; ++i) corner[i] = i < dim ? 1 : i < 2 * dim ? 1 : -2 + 0.5 * (double)(i % dim);
            corner[dim + k] = 1.5;
            CASE("%d dimensions, coordinate %d", (int)dim, (int)k);
            CHECK_EQUAL(surfmink_merge(corner, NULL, 3, dim, 0.0), 3);
            CHECK_EQUAL(surfmink_merge(corner, NULL, 3, dim, 0.49), 3);
            if (dim == 2) {
                CHECK_OK(surfmink_edges(IN_PLANE(corner, 3), length, turning, NULL));
                CHECK_NEAR(length[0], 0.5, 0);
                continue;
            }
            CHECK_OK(surfmink_edges(IN_SPACE(corner, up, 3), length, turning, NULL));
            CHECK_NEAR(length[0], 0.5, 0);
            CHECK_OK(surfmink_edges(ON_SPHERE(corner, 3, 1.0), length, turning, NULL));
            CHECK(length[0] > 0.1);
            CHECK_EQUAL(surfmink_merge(corner, NULL, 3, dim, 0.51), 2);
        }
}

/* The area of a sphere overflows where R^2 times the solid angle does, not before. */
THEOREM(the_area_of_a_sphere_is_told_up_to_the_largest_double)
{
    static const double octant[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0}; /* pi / 2 R^2 */
    static const size_t offset[2] = {0, 3};
    const double most = sqrt(DBL_MAX / PI) * sqrt(2); /* sqrt(DBL_MAX / (pi / 2)) */
    double area;
    surfmink_functionals w;
    surfmink_results results = {NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    int status;
    results.status = &status;
    results.area = &area;
    CHECK_OK(surfmink_area(ON_SPHERE(octant, 3, most * (1 - 1e-12)), &area));
    CHECK_CLOSE(area, DBL_MAX, 3e-12);
    CHECK_OK(surfmink_measure(ON_SPHERE(octant, 3, most * (1 - 1e-12)), 1, NULL, NULL, &w, NULL));
    CHECK_CLOSE(w.area, DBL_MAX, 3e-12);
    CHECK_EQUAL(surfmink_batch(ON_SPHERE(octant, 3, most * (1 - 1e-12)), offset, 1, 1, &results, NULL), 0);
    CHECK_CLOSE(area, DBL_MAX, 3e-12);
    REFUSES(surfmink_area(ON_SPHERE(octant, 3, most * (1 + 1e-12)), out.mu), SURFMINK_NOT_FINITE);
    BLAMES(surfmink_measure(ON_SPHERE(octant, 3, most * (1 + 1e-12)), 1, out.mu, out.g, &out.w, &bad),
           SURFMINK_NOT_FINITE, 3);
    CHECK_EQUAL(surfmink_batch(ON_SPHERE(octant, 3, most * (1 + 1e-12)), offset, 1, 1, &results, NULL), 1);
    CHECK_STATUS(status, SURFMINK_NOT_FINITE);
}

/* A past bug: measured edges with L next to the largest double had g_p an ulp above it, which is infinite. */
THEOREM(what_is_as_long_as_a_double_can_say_has_no_room_for_rounding)
{
    static const double beyond[4] = {0, 0, 0, DBL_MAX}, below[4] = {0, 0, 0, 1.797e308};
    double turning[4] = {1.5, 1.5, 1.5, 1.5}, g[2 * 13];
    int trial, p;
    for (trial = 0; trial < 1000; ++trial) {
        turning[3] = PI / 2000 * trial;
        CASE("trial %d", trial);
        REFUSES(surfmink_total(NULL, beyond, turning, 4, &out.w), SURFMINK_NOT_FINITE);
        REFUSES(surfmink_irreducible(beyond, turning, 4, 3, out.g), SURFMINK_NOT_FINITE);
        REFUSES(surfmink_irreducible_parallel(beyond, turning, 4, 0, 0.5, 3, out.g), SURFMINK_NOT_FINITE);
        CHECK_OK(surfmink_irreducible(below, turning, 4, 12, g));
        for (p = 0; p <= 12; ++p) CHECK(fabs(g[2 * p]) <= DBL_MAX && fabs(g[2 * p + 1]) <= DBL_MAX);
    }
}

THEOREM(a_sphere_has_a_centre_antipodes_and_a_positive_radius)
{
    static const double wrong_radius[4] = {0, -1, -0.0, 1.0000001e307};
    double corner[15], infinite = infinity_();
    size_t i;
    for (i = 0; i < 5; ++i) {
        pentagon(SPHERE, corner);
        corner[3 * i] = corner[3 * i + 1] = corner[3 * i + 2] = 0;
        CASE("corner %d", (int)i);
        BLAMES(surfmink_measure(ON_SPHERE(corner, 5, 1.0), 3, out.mu, out.g, &out.w, &bad), SURFMINK_ZERO_NORMAL, i);
        BLAMES(surfmink_edges(ON_SPHERE(corner, 5, 1.0), out.length, out.turning, &bad), SURFMINK_ZERO_NORMAL, i);
        REFUSES(surfmink_area(ON_SPHERE(corner, 5, 1.0), &out.mu[0]), SURFMINK_ZERO_NORMAL);
        pentagon(SPHERE, corner);
        corner[3 * i] = -3 * corner[3 * ((i + 1) % 5)]; /* opposite to the next one, and three times as far off */
        corner[3 * i + 1] = -3 * corner[3 * ((i + 1) % 5) + 1];
        corner[3 * i + 2] = -3 * corner[3 * ((i + 1) % 5) + 2];
        BLAMES_EITHER(surfmink_measure(ON_SPHERE(corner, 5, 1.0), 3, out.mu, out.g, &out.w, &bad),
                      SURFMINK_ANTIPODAL_CORNERS, i, (i + 1) % 5);
        BLAMES_EITHER(surfmink_edges(ON_SPHERE(corner, 5, 1.0), out.length, out.turning, &bad),
                      SURFMINK_ANTIPODAL_CORNERS, i, (i + 1) % 5);
        REFUSES(surfmink_area(ON_SPHERE(corner, 5, 1.0), &out.mu[0]), SURFMINK_ANTIPODAL_CORNERS);
    }
    pentagon(SPHERE, corner);
    CHECK_OK(surfmink_edges(ON_SPHERE(corner, 5, 1e307), out.length, out.turning, &bad));
    CHECK_OK(surfmink_from_lonlat(10, 20, 1e307, out.vector));
    for (i = 0; i < 6; ++i) {
        double radius = i < 4 ? wrong_radius[i] : i == 4 ? infinite : nan_();
        CASE("radius %g", radius);
        BLAMES(surfmink_measure(ON_SPHERE(corner, 5, radius), 3, out.mu, out.g, &out.w, &bad), SURFMINK_BAD_ARGUMENT,
               5);
        BLAMES(surfmink_edges(ON_SPHERE(corner, 5, radius), out.length, out.turning, &bad), SURFMINK_BAD_ARGUMENT, 5);
        REFUSES(surfmink_area(ON_SPHERE(corner, 5, radius), &out.mu[0]), SURFMINK_BAD_ARGUMENT);
        REFUSES(surfmink_sphere_log(corner, corner + 3, radius, out.vector), SURFMINK_BAD_ARGUMENT);
        REFUSES(surfmink_sphere_exp(corner, corner + 3, radius, out.vector), SURFMINK_BAD_ARGUMENT);
        REFUSES(surfmink_from_lonlat(10, 20, radius, out.vector), SURFMINK_BAD_ARGUMENT);
    }
}

THEOREM(areas_check_corners_and_take_either_orientation)
{
    double corner[15];
    size_t n;
    for (n = 0; n < 3; ++n) {
        pentagon(SPHERE, corner);
        REFUSES(surfmink_area(IN_PLANE(corner, n), &out.mu[0]), SURFMINK_TOO_FEW_CORNERS);
        REFUSES(surfmink_area(ON_SPHERE(corner, n, 1.0), &out.mu[0]), SURFMINK_TOO_FEW_CORNERS);
    }
    memcpy(corner + 3, corner, 3 * sizeof *corner);
    REFUSES(surfmink_area(ON_SPHERE(corner, 5, 1.0), &out.mu[0]), SURFMINK_COINCIDENT_CORNERS);
    corner[4] = nan_();
    REFUSES(surfmink_area(ON_SPHERE(corner, 5, 1.0), &out.mu[0]), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_area(IN_PLANE(corner, 5), &out.mu[0]), SURFMINK_NOT_FINITE);
    pentagon(PLANE, corner);
    CHECK_OK(surfmink_area(IN_PLANE(corner, 5), &out.mu[0]));
    CHECK(out.mu[0] > 0);
    surfmink_reverse(corner, 5, 2);
    CHECK_OK(surfmink_area(IN_PLANE(corner, 5), &out.mu[0]));
    CHECK(out.mu[0] < 0);
    memcpy(corner + 2, corner, 2 * sizeof *corner);
    REFUSES(surfmink_area(IN_PLANE(corner, 5), &out.mu[0]), SURFMINK_COINCIDENT_CORNERS);
}

THEOREM(normals_need_a_direction_that_no_edge_has)
{
    static const double tilt[2] = {0.5e-6, 2e-6}; /* refused within 1e-6 rad of the normal */
    double corner[15], normal[15];
    size_t i, k;
    for (i = 0; i < 5; ++i) {
        size_t next = (i + 1) % 5;
        pentagon(EMBEDDED, corner);
        memcpy(normal, corner, sizeof normal);
        CASE("corner %d", (int)i);
        normal[3 * i] = normal[3 * i + 1] = normal[3 * i + 2] = 0;
        BLAMES(surfmink_measure(IN_SPACE(corner, normal, 5), 3, out.mu, out.g, &out.w, &bad), SURFMINK_ZERO_NORMAL, i);
        BLAMES(surfmink_edges(IN_SPACE(corner, normal, 5), out.length, out.turning, &bad), SURFMINK_ZERO_NORMAL, i);
        REFUSES(surfmink_frame(IN_SPACE(corner, normal, 5), i, out.vector), SURFMINK_ZERO_NORMAL);
        normal[3 * i] = nan_();
        BLAMES(surfmink_measure(IN_SPACE(corner, normal, 5), 3, out.mu, out.g, &out.w, &bad), SURFMINK_NOT_FINITE, i);
        BLAMES(surfmink_edges(IN_SPACE(corner, normal, 5), out.length, out.turning, &bad), SURFMINK_NOT_FINITE, i);
        REFUSES(surfmink_frame(IN_SPACE(corner, normal, 5), i, out.vector), SURFMINK_NOT_FINITE);
        for (k = 0; k < 4; ++k) { /* a normal along the edge behind or before it, either way round */
            size_t other = k % 2 ? next : (i + 4) % 5, j;
            double edge[3], side[3], length;
            int wide;
            for (j = 0; j < 3; ++j) edge[j] = corner[3 * other + j] - corner[3 * i + j];
            cross3(edge, corner + 3 * i, side);
            length = sqrt(dot3(edge, edge) / dot3(side, side));
            for (wide = 0; wide < 2; ++wide) {
                for (j = 0; j < 15; ++j) /* the others are not far from it, or normals would be opposite */
                    normal[j] = corner[j] + 4 * edge[j % 3] * (k < 2 ? 1 : -1);
                for (j = 0; j < 3; ++j)
                    normal[3 * i + j] = (edge[j] + tilt[wide] * length * side[j]) * (k < 2 ? 1 : -1);
                CASE("corner %d, edge to %d, tilted by %g", (int)i, (int)other, tilt[wide]);
                if (wide)
                    CHECK_OK(surfmink_edges(IN_SPACE(corner, normal, 5), out.length, out.turning, &bad));
                else {
                    BLAMES_EITHER(surfmink_measure(IN_SPACE(corner, normal, 5), 3, out.mu, out.g, &out.w, &bad),
                                  SURFMINK_UPRIGHT_EDGE, i, other);
                    BLAMES_EITHER(surfmink_edges(IN_SPACE(corner, normal, 5), out.length, out.turning, &bad),
                                  SURFMINK_UPRIGHT_EDGE, i, other);
                    REFUSES(surfmink_frame(IN_SPACE(corner, normal, 5), k % 2 ? i : other, out.vector),
                            SURFMINK_UPRIGHT_EDGE);
                }
            }
        }
    }
}

/* A normal that is flipped, as from a mesh whose triangles do not run the same way round: measured by 0.3.0, with
   mu_6 = 0 of a flat regular hexagon. Octants have normals 90 degrees apart, but for rounding. */
THEOREM(neighbouring_normals_are_at_most_90_degrees_apart)
{
    static const double octant[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double flat[18], normal[18], lean;
    size_t i, k;
    for (i = 0; i < 6; ++i) {
        flat[3 * i] = cos(PI * (double)i / 3), flat[3 * i + 1] = sin(PI * (double)i / 3), flat[3 * i + 2] = 0;
        normal[3 * i] = normal[3 * i + 1] = 0, normal[3 * i + 2] = 1;
    }
    CHECK_OK(surfmink_edges(IN_SPACE(flat, normal, 6), out.length, out.turning, NULL));
    for (i = 0; i < 6; ++i) {
        size_t other = i > 0 ? i : 1; /* an edge is blamed on the corner that ends it, the first edge first */
        normal[3 * i + 2] = -1;
        CASE("normal %d flipped", (int)i);
        BLAMES(surfmink_measure(IN_SPACE(flat, normal, 6), 3, out.mu, out.g, &out.w, &bad), SURFMINK_OPPOSITE_NORMALS,
               other);
        BLAMES(surfmink_edges(IN_SPACE(flat, normal, 6), out.length, out.turning, &bad), SURFMINK_OPPOSITE_NORMALS,
               other);
        REFUSES(surfmink_area(IN_SPACE(flat, normal, 6), &out.w.area), SURFMINK_OPPOSITE_NORMALS);
        REFUSES(surfmink_frame(IN_SPACE(flat, normal, 6), i, out.vector), SURFMINK_OPPOSITE_NORMALS);
        for (k = 0; k < 2; ++k) { /* 1e-3 rad to either side of 90 degrees; out of the outline, not along an edge */
            lean = k ? -1e-3 : 1e-3;
            memcpy(normal + 3 * i, flat + 3 * i, 2 * sizeof *flat);
            normal[3 * i + 2] = lean;
            fill();
            CHECK_STATUS(surfmink_edges(IN_SPACE(flat, normal, 6), out.length, out.turning, &bad),
                         k ? SURFMINK_OPPOSITE_NORMALS : SURFMINK_OK);
        }
        for (k = 0; k < 2; ++k) { /* a right angle up to 1e-6 of rounding */
            lean = k ? -1.5e-6 : -0.5e-6;
            memcpy(normal + 3 * i, flat + 3 * i, 2 * sizeof *flat);
            normal[3 * i + 2] = lean;
            fill();
            CHECK_STATUS(surfmink_edges(IN_SPACE(flat, normal, 6), out.length, out.turning, &bad),
                         k ? SURFMINK_OPPOSITE_NORMALS : SURFMINK_OK);
        }
        normal[3 * i] = normal[3 * i + 1] = 0, normal[3 * i + 2] = 1;
    }
    CHECK_OK(surfmink_edges(IN_SPACE(octant, octant, 3), out.length, out.turning, NULL));
}

THEOREM(too_much_curvature_is_named)
{
    static const double equator[12] = {1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0};
    static const double up[3] = {0, 0, 1};
    double flat[24], normal[24], radius = 1;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    size_t i;
    BLAMES(surfmink_measure(ON_SPHERE(equator, 4, 1.0), 3, out.mu, out.g, &out.w, &bad), SURFMINK_TOO_MUCH_CURVATURE,
           4);
    BLAMES(surfmink_measure(IN_SPACE(equator, equator, 4), 3, out.mu, out.g, &out.w, &bad), SURFMINK_TOO_MUCH_CURVATURE,
           4);
    BLAMES(surfmink_measure(ON_SURFACE(&sphere, equator, 4), 3, out.mu, out.g, &out.w, &bad),
           SURFMINK_TOO_MUCH_CURVATURE, 4);
    /* A flat figure of eight has S = 0, too; but its normals enclose no solid angle. */
    for (i = 0; i < 8; ++i) {
        double t = 2 * PI * ((double)i + 0.5) / 8;
        flat[3 * i] = sin(t), flat[3 * i + 1] = sin(2 * t), flat[3 * i + 2] = 0;
        memcpy(normal + 3 * i, up, sizeof up);
    }
    BLAMES(surfmink_measure(IN_SPACE(flat, normal, 8), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CROSSES_ITSELF, 8);
}

/* --- callbacks that fail ------------------------------------------------------------------------------------------ */

typedef struct saboteur {
    int calls, fails_at, status; /* fails with the status at that call, */
    int lies;                    /* or says OK and returns nonsense */
} saboteur;

enum {
    TELLS_THE_TRUTH,
    NEGATIVE_LENGTH,
    LENGTH_NAN,
    LENGTH_INFINITE,
    NO_LENGTH,
    NO_DIRECTION,
    DIRECTION_NAN,
    DIRECTION_INFINITE,
    NOTHING_BUT_A_LENGTH,
    LIES
};

static int sabotaged_log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    saboteur *s = (saboteur *)context;
    double kept[2];
    int status;
    memcpy(kept, direction, sizeof kept);
    status = spinning_log(NULL, x, y, length, direction);
    if (s->calls++ != s->fails_at) return status;
    switch (s->lies) {
    case NOTHING_BUT_A_LENGTH: memcpy(direction, kept, sizeof kept); break;
    case NEGATIVE_LENGTH: *length = -1; break;
    case LENGTH_NAN: *length = nan_(); break;
    case LENGTH_INFINITE: *length = infinity_(); break;
    case NO_LENGTH: *length = 0; break;
    case NO_DIRECTION: direction[0] = direction[1] = 0; break;
    case DIRECTION_NAN: direction[1] = nan_(); break;
    case DIRECTION_INFINITE: direction[0] = infinity_(); break;
    default: return s->status;
    }
    return SURFMINK_OK;
}

static int sabotaged_exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    saboteur *s = (saboteur *)context;
    int status = spinning_exp(NULL, x, direction, length, y);
    if (s->calls++ != s->fails_at) return status;
    if (s->lies) y[1] = s->lies % 2 ? nan_() : infinity_();
    return s->lies ? SURFMINK_OK : s->status;
}

static surfmink_surface sabotaged(saboteur *s, int fails_at, int status, int lies)
{
    surfmink_surface surface;
    s->calls = 0;
    s->fails_at = fails_at;
    s->status = status;
    s->lies = lies;
    surface.context = s;
    surface.stride = 2;
    surface.log = sabotaged_log;
    surface.exp = sabotaged_exp;
    return surface;
}

THEOREM(a_failing_callback_comes_back_with_its_name_and_corner)
{
    double corner[15];
    surfmink_surface surface;
    saboteur s;
    int call, status;
    pentagon(SURFACE, corner);
    for (call = 0; call < 10; ++call) /* two calls a corner */
        for (status = 1; status < 14; ++status) {
            int named = status < 12    ? status
                        : status == 12 ? 99
                                       : -7,
                comes_back = status < 12 ? status : SURFMINK_CALLBACK_FAILED;
            CASE("call %d says %d", call, named);
            surface = sabotaged(&s, call, named, TELLS_THE_TRUTH);
            BLAMES(surfmink_measure(ON_SURFACE(&surface, corner, 5), 3, out.mu, out.g, &out.w, &bad), comes_back,
                   call / 2);
            CHECK_EQUAL(s.calls, call + 1); /* nothing is asked after a failure */
            surface = sabotaged(&s, call, named, TELLS_THE_TRUTH);
            BLAMES(surfmink_edges(ON_SURFACE(&surface, corner, 5), out.length, out.turning, &bad), comes_back,
                   call / 2);
        }
    surface = sabotaged(&s, 10, SURFMINK_CALLBACK_FAILED, TELLS_THE_TRUTH); /* ten calls are enough */
    CHECK_OK(surfmink_measure(ON_SURFACE(&surface, corner, 5), 3, out.mu, out.g, &out.w, &bad));
}

THEOREM(nonsense_from_a_callback_is_not_believed)
{
    double corner[15];
    surfmink_surface surface;
    saboteur s;
    int call, lies;
    pentagon(SURFACE, corner);
    for (call = 0; call < 10; ++call)
        for (lies = 1; lies < LIES; ++lies) {
            int want = lies == NO_LENGTH ? SURFMINK_COINCIDENT_CORNERS : SURFMINK_CALLBACK_FAILED;
            CASE("call %d, lie %d", call, lies);
            surface = sabotaged(&s, call, 0, lies);
            BLAMES(surfmink_measure(ON_SURFACE(&surface, corner, 5), 3, out.mu, out.g, &out.w, &bad), want, call / 2);
            surface = sabotaged(&s, call, 0, lies);
            BLAMES(surfmink_edges(ON_SURFACE(&surface, corner, 5), out.length, out.turning, &bad), want, call / 2);
        }
}

THEOREM(a_surface_needs_callbacks_and_a_stride)
{
    double corner[15];
    surfmink_surface surface = spinning_plane();
    pentagon(SURFACE, corner);
    surface.exp = NULL; /* only building asks for it */
    CHECK_OK(surfmink_measure(ON_SURFACE(&surface, corner, 5), 3, out.mu, out.g, &out.w, &bad));
    REFUSES(surfmink_regular_polygon(&surface, corner, 1.0, 0.0, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_edge_points(&surface, corner, corner + 2, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    surface = spinning_plane();
    surface.log = NULL;
    CHECK_OK(surfmink_regular_polygon(&surface, corner, 1.0, 0.0, 3, out.vector));
    BLAMES(surfmink_measure(ON_SURFACE(&surface, corner, 5), 3, out.mu, out.g, &out.w, &bad), SURFMINK_BAD_ARGUMENT, 5);
    BLAMES(surfmink_edges(ON_SURFACE(&surface, corner, 5), out.length, out.turning, &bad), SURFMINK_BAD_ARGUMENT, 5);
    REFUSES(surfmink_edge_points(&surface, corner, corner + 2, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    surface = spinning_plane();
    surface.stride = 0;
    BLAMES(surfmink_measure(ON_SURFACE(&surface, corner, 5), 3, out.mu, out.g, &out.w, &bad), SURFMINK_BAD_ARGUMENT, 5);
    BLAMES(surfmink_edges(ON_SURFACE(&surface, corner, 5), out.length, out.turning, &bad), SURFMINK_BAD_ARGUMENT, 5);
    REFUSES(surfmink_regular_polygon(&surface, corner, 1.0, 0.0, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_edge_points(&surface, corner, corner + 2, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    surface.stride = 17;
    REFUSES(surfmink_regular_polygon(&surface, corner, 1.0, 0.0, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_edge_points(&surface, corner, corner + 2, 3, out.vector), SURFMINK_BAD_ARGUMENT);
}

THEOREM(a_view_without_corners_or_normals_is_refused)
{
    double xyz[15], normal[15];
    pentagon(EMBEDDED, xyz);
    memcpy(normal, xyz, sizeof normal);
    BLAMES(surfmink_measure(IN_SPACE(xyz, NULL, 5), 3, out.mu, out.g, &out.w, &bad), SURFMINK_BAD_ARGUMENT, 5);
    BLAMES(surfmink_measure(IN_SPACE(NULL, normal, 5), 3, out.mu, out.g, &out.w, &bad), SURFMINK_BAD_ARGUMENT, 5);
    BLAMES(surfmink_edges(IN_PLANE(NULL, 5), out.length, out.turning, &bad), SURFMINK_BAD_ARGUMENT, 5);
    REFUSES(surfmink_area(ON_SPHERE(NULL, 5, 1.0), &out.w.area), SURFMINK_BAD_ARGUMENT);
}

/* Whether or not its area is asked for. */
THEOREM(an_outline_whose_area_overflows_is_refused)
{
    static const double up[9] = {0, 0, 1, 0, 0, 1, 0, 0, 1}, large[9] = {0, 0, 0, 3e200, 0, 0, 0, 4e200, 0};
    BLAMES(surfmink_measure(IN_SPACE(large, up, 3), 3, out.mu, out.g, &out.w, &bad), SURFMINK_NOT_FINITE, 3);
    BLAMES(surfmink_measure(IN_SPACE(large, up, 3), 3, out.mu, out.g, NULL, &bad), SURFMINK_NOT_FINITE, 3);
}

THEOREM(a_view_of_no_kind_or_of_another_length_is_refused)
{
    double flat[10], called[15], area, carried[2] = {1, 0};
    surfmink_surface surface = spinning_plane();
    surfmink_outline view = surfmink_plane(flat, 5);
    pentagon(PLANE, flat);
    pentagon(SURFACE, called);
    CHECK_OK(surfmink_edges(&view, out.length, out.turning, &bad));
    CHECK_OK(surfmink_transport_vector(&view, out.turning, 0, 5, SURFMINK_CORRECTED, carried));
    CHECK_NEAR(carried[0], 1, 1e-15);
    {
        double length[5], turning[5];
        surfmink_functionals w;
        CHECK_OK(surfmink_edges(&view, length, turning, &bad));
        CHECK_OK(surfmink_total(&view, length, turning, 5, &w));
        REFUSES(surfmink_total(IN_PLANE(flat, 4), length, turning, 5, &out.w), SURFMINK_BAD_ARGUMENT);
        view.kind = (enum surfmink_kind)4;
        REFUSES(surfmink_total(&view, length, turning, 5, &out.w), SURFMINK_BAD_ARGUMENT);
    }
    BLAMES(surfmink_measure(&view, 3, out.mu, out.g, &out.w, &bad), SURFMINK_BAD_ARGUMENT, 5);
    BLAMES(surfmink_edges(&view, out.length, out.turning, &bad), SURFMINK_BAD_ARGUMENT, 5);
    REFUSES(surfmink_area(&view, &out.w.area), SURFMINK_BAD_ARGUMENT);
    BLAMES(surfmink_measure(ON_SURFACE(NULL, called, 5), 3, out.mu, out.g, &out.w, &bad), SURFMINK_BAD_ARGUMENT, 5);
    REFUSES(surfmink_area(ON_SURFACE(&surface, called, 5), &out.w.area), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_frame(ON_SURFACE(&surface, called, 5), 0, out.vector), SURFMINK_BAD_ARGUMENT);
    CHECK_OK(surfmink_area(IN_PLANE(flat, 5), &area));
}

/* Long outlines are measured twice: a callback that fails only then is told as well. */
THEOREM(a_callback_that_fails_the_second_time_is_told)
{
    double corner[2 * 300];
    saboteur s;
    surfmink_surface surface = spinning_plane();
    static const double centre[2] = {0, 0};
    CHECK_OK(surfmink_regular_polygon(&surface, centre, 1, 0, 300, corner));
    surface = sabotaged(&s, 2 * 300 + 3, SURFMINK_CALLBACK_FAILED, 0);
    REFUSES(surfmink_measure(ON_SURFACE(&surface, corner, 300), 3, out.mu, out.g, &out.w, &bad),
            SURFMINK_CALLBACK_FAILED);
}

THEOREM(building_needs_a_size_and_fails_as_a_whole)
{
    static const double centre[2] = {0, 0}, other[2] = {1, 2}, nowhere[3] = {0, 0, 0};
    double radius = 1, unknown[3] = {1, 0, 0}, point[10];
    surfmink_surface surface = spinning_plane(), sphere = surfmink_sphere_surface(&radius);
    saboteur s;
    int call, status;
    REFUSES(surfmink_regular_polygon(&surface, centre, 1.0, 0.0, 2, out.vector), SURFMINK_TOO_FEW_CORNERS);
    REFUSES(surfmink_regular_polygon(&surface, centre, 0.0, 0.0, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_regular_polygon(&surface, centre, -1.0, 0.0, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_regular_polygon(&surface, centre, nan_(), 0.0, 3, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_regular_polygon(&surface, centre, 1.0, nan_(), 3, out.vector), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_regular_polygon(&surface, centre, 1.0, infinity_(), 3, out.vector), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_edge_points(&surface, centre, other, 0, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_edge_points(&surface, centre, centre, 3, out.vector), SURFMINK_COINCIDENT_CORNERS);
    unknown[2] = nan_();
    REFUSES(surfmink_regular_polygon(&sphere, nowhere, 1.0, 0.0, 3, out.vector), SURFMINK_ZERO_NORMAL);
    REFUSES(surfmink_regular_polygon(&sphere, unknown, 1.0, 0.0, 3, out.vector), SURFMINK_NOT_FINITE);
    for (call = 0; call < 5; ++call) {
        for (status = 1; status < 14; ++status) {
            int named = status < 12 ? status : 99, comes_back = status < 12 ? status : SURFMINK_CALLBACK_FAILED;
            CASE("call %d says %d", call, named);
            surface = sabotaged(&s, call, named, TELLS_THE_TRUTH);
            REFUSES(surfmink_regular_polygon(&surface, centre, 1.0, 0.0, 5, out.vector), comes_back);
            surface = sabotaged(&s, call, named, TELLS_THE_TRUTH); /* one log and then four exp */
            REFUSES(surfmink_edge_points(&surface, centre, other, 5, out.vector), comes_back);
        }
        surface = sabotaged(&s, call, 0, 1);
        REFUSES(surfmink_regular_polygon(&surface, centre, 1.0, 0.0, 5, out.vector), SURFMINK_CALLBACK_FAILED);
        surface = sabotaged(&s, call, 0, 2);
        REFUSES(surfmink_regular_polygon(&surface, centre, 1.0, 0.0, 5, out.vector), SURFMINK_CALLBACK_FAILED);
        surface = sabotaged(&s, call, 0, LENGTH_NAN);
        REFUSES(surfmink_edge_points(&surface, centre, other, 5, out.vector), SURFMINK_CALLBACK_FAILED);
    }
    surface = sabotaged(&s, -1, 0, TELLS_THE_TRUTH);
    CHECK_OK(surfmink_regular_polygon(&surface, centre, 1.0, 0.0, 5, point));
    CHECK_EQUAL(s.calls, 10); /* twice for each corner, and once more for the log and each point but the first */
    CHECK_OK(surfmink_edge_points(&surface, centre, other, 5, point));
    CHECK_EQUAL(s.calls, 19);
}

/* --- the later steps ---------------------------------------------------------------------------------------------- */

/* Star polygons {7/2} and {7/3}, in either direction. */
THEOREM(what_winds_more_than_once_crosses_itself)
{
    double xy[14], xyz[21];
    int winding, sense, i;
    for (winding = 2; winding <= 3; ++winding)
        for (sense = -1; sense <= 1; sense += 2) {
            for (i = 0; i < 7; ++i) {
                xy[2 * i] = 0.3 * cos(2 * PI * i * winding / 7);
                xy[2 * i + 1] = 0.3 * sense * sin(2 * PI * i * winding / 7);
                xyz[3 * i] = xy[2 * i], xyz[3 * i + 1] = xy[2 * i + 1], xyz[3 * i + 2] = 1;
            }
            CASE("%d times, %d", winding, sense);
            BLAMES(surfmink_measure(IN_PLANE(xy, 7), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CROSSES_ITSELF, 7);
            BLAMES(surfmink_measure(ON_SPHERE(xyz, 7, 1.0), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CROSSES_ITSELF,
                   7);
            BLAMES(surfmink_measure(IN_SPACE(xyz, xyz, 7), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CROSSES_ITSELF, 7);
        }
}

/* However small, on every surface. */
THEOREM(what_runs_clockwise_is_told_as_that_at_any_size)
{
    double xy[12], xyz[18], out_of[18], size;
    int i;
    for (size = 0.5; size > 1e-13; size /= 7) {
        for (i = 0; i < 6; ++i) {
            double t = -2 * PI * i / 6, x = size * cos(t), y = 0.8 * size * sin(t);
            xy[2 * i] = x, xy[2 * i + 1] = y;
            xyz[3 * i] = x, xyz[3 * i + 1] = y, xyz[3 * i + 2] = 1;
            out_of[3 * i] = 0.3 + 0.8 * x, out_of[3 * i + 1] = 0.4 + y, out_of[3 * i + 2] = 0.9 - 0.6 * x;
        }
        CASE("size %g", size);
        BLAMES(surfmink_measure(IN_PLANE(xy, 6), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CLOCKWISE, 6);
        BLAMES(surfmink_measure(ON_SPHERE(xyz, 6, 1e6), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CLOCKWISE, 6);
        BLAMES(surfmink_measure(ON_SPHERE(out_of, 6, 1.0), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CLOCKWISE, 6);
        BLAMES(surfmink_measure(IN_SPACE(xyz, xyz, 6), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CLOCKWISE, 6);
        BLAMES(surfmink_measure(IN_SPACE(out_of, out_of, 6), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CLOCKWISE, 6);
    }
}

/* A clockwise square, at two corners of which a small loop turns the other way: S = 2 pi, and a negative area, which is
   small on a sphere of any radius. */
THEOREM(the_radius_does_not_excuse_a_negative_area)
{
    static const double xy[16] = {0, 0, 0, 11, -1, 11, -1, 10, 10, 10, 10, -1, 11, -1, 11, 0};
    double xyz[24], radius;
    int i;
    for (i = 0; i < 8; ++i) xyz[3 * i] = 1e-3 * xy[2 * i], xyz[3 * i + 1] = 1e-3 * xy[2 * i + 1], xyz[3 * i + 2] = 1;
    BLAMES(surfmink_measure(IN_PLANE(xy, 8), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CROSSES_ITSELF, 8);
    for (radius = 1e-9; radius < 2e9; radius *= 1e3) {
        CASE("radius %g", radius);
        BLAMES(surfmink_measure(ON_SPHERE(xyz, 8, radius), 3, out.mu, out.g, &out.w, &bad), SURFMINK_CROSSES_ITSELF, 8);
    }
}

/* Finite ones, whose sum is not. */
THEOREM(turns_whose_sum_overflows_are_refused)
{
    static const double l[3] = {1, 1, 1}, huge[3] = {1e308, -1e308, 1e308}, large[3] = {5e307, -5e307, 5e307};
    int transport;
    REFUSES(surfmink_total(NULL, l, huge, 3, &out.w), SURFMINK_TOO_MUCH_CURVATURE);
    REFUSES(surfmink_irreducible_parallel(l, huge, 3, 0, 0.5, 3, out.g), SURFMINK_NOT_FINITE);
    CHECK_OK(surfmink_irreducible_parallel(l, large, 3, 0, 0.5, 3, out.g));
    for (transport = 0; transport < 3; ++transport) {
        REFUSES(surfmink_phases(huge, 3, transport, out.turning), SURFMINK_NOT_FINITE);
        REFUSES(surfmink_transport_angle(huge, 3, 0, 1, transport, 0.0, out.mu), SURFMINK_NOT_FINITE);
    }
    REFUSES(surfmink_transport_angle(large, 3, 0, 12, SURFMINK_PARALLEL, 0.0, out.mu), SURFMINK_NOT_FINITE);
}

THEOREM(totals_and_phases_refuse_what_no_outline_has)
{
    static const double l[4] = {1, 1, 1, 1}, a[4] = {1.5, 1.5, 1.5, 1.5}, away[4] = {-1.5, -1.5, -1.5, 1},
                        none[4] = {0, 0, 0, 0};
    double length[4], turning[4], wrong[3], carried = 0;
    size_t n, i;
    int what, transport;
    wrong[0] = nan_(), wrong[1] = infinity_(), wrong[2] = -infinity_();
    for (n = 0; n < 3; ++n) {
        REFUSES(surfmink_total(NULL, l, a, n, &out.w), SURFMINK_TOO_FEW_CORNERS);
        REFUSES(surfmink_irreducible(l, a, n, 3, out.g), SURFMINK_TOO_FEW_CORNERS);
        REFUSES(surfmink_irreducible_parallel(l, a, n, 0, 0.5, 3, out.g), SURFMINK_TOO_FEW_CORNERS);
        for (transport = 0; transport < 3; ++transport) {
            REFUSES(surfmink_phases(a, n, transport, out.turning), SURFMINK_TOO_FEW_CORNERS);
            REFUSES(surfmink_transport_angle(a, n, 0, 1, transport, 0.0, out.mu), SURFMINK_TOO_FEW_CORNERS);
        }
    }
    for (what = 0; what < 3; ++what)
        for (i = 0; i < 4; ++i) {
            memcpy(length, l, sizeof l);
            memcpy(turning, a, sizeof a);
            length[i] = turning[i] = wrong[what];
            CASE("%g in place %d", wrong[what], (int)i);
            REFUSES(surfmink_total(NULL, length, a, 4, &out.w), SURFMINK_NOT_FINITE);
            REFUSES(surfmink_total(NULL, l, turning, 4, &out.w), SURFMINK_NOT_FINITE);
            REFUSES(surfmink_irreducible(length, a, 4, 3, out.g), SURFMINK_NOT_FINITE);
            REFUSES(surfmink_irreducible(l, turning, 4, 3, out.g), SURFMINK_NOT_FINITE);
            REFUSES(surfmink_irreducible_parallel(length, a, 4, 0, 0.5, 3, out.g), SURFMINK_NOT_FINITE);
            REFUSES(surfmink_irreducible_parallel(l, turning, 4, 0, 0.5, 3, out.g), SURFMINK_NOT_FINITE);
            for (transport = 0; transport < 3; ++transport) {
                REFUSES(surfmink_phases(turning, 4, transport, out.turning), SURFMINK_NOT_FINITE);
                REFUSES(surfmink_transport_angle(turning, 4, 0, 1, transport, 0.0, out.mu), SURFMINK_NOT_FINITE);
                REFUSES(surfmink_transport_angle(a, 4, 0, 1, transport, wrong[what], out.mu), SURFMINK_NOT_FINITE);
            }
        }
    for (i = 0; i < 4; ++i) {
        memcpy(length, l, sizeof l);
        length[i] = -1;
        REFUSES(surfmink_total(NULL, length, a, 4, &out.w), SURFMINK_BAD_ARGUMENT);
        REFUSES(surfmink_irreducible(length, a, 4, 3, out.g), SURFMINK_BAD_ARGUMENT);
    }
    REFUSES(surfmink_total(NULL, none, a, 4, &out.w), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_irreducible(l, a, 4, -1, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_irreducible_parallel(length, a, 4, 0, 0.5, 3, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_irreducible_parallel(l, a, 4, 0, 0.5, -1, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_irreducible_parallel(l, a, 4, 4, 0.5, 3, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_irreducible_parallel(l, a, 4, 0, 1.0, 3, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_irreducible_parallel(l, a, 4, 0, -0.1, 3, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_irreducible_parallel(l, a, 4, 0, nan_(), 3, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_phases(a, 4, 3, out.turning), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_phases(a, 4, -1, out.turning), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_transport_angle(a, 4, 4, 1, SURFMINK_CORRECTED, 0.0, out.mu), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_transport_angle(a, 4, 0, 1, 3, 0.0, out.mu), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_total(NULL, l, away, 4, &out.w), SURFMINK_CLOCKWISE);
    REFUSES(surfmink_total(NULL, l, none, 4, &out.w), SURFMINK_TOO_MUCH_CURVATURE);
    for (transport = 0; transport < 3; ++transport) {
        if (transport == SURFMINK_PARALLEL) { /* which needs no sum to divide by */
            CHECK_OK(surfmink_phases(away, 4, transport, out.turning));
            CHECK_OK(surfmink_transport_angle(none, 4, 0, 1, transport, 0.0, &carried));
            continue;
        }
        REFUSES(surfmink_phases(away, 4, transport, out.turning), SURFMINK_CLOCKWISE);
        REFUSES(surfmink_phases(none, 4, transport, out.turning), SURFMINK_TOO_MUCH_CURVATURE);
        REFUSES(surfmink_transport_angle(away, 4, 0, 1, transport, 0.0, out.mu), SURFMINK_CLOCKWISE);
        REFUSES(surfmink_transport_angle(none, 4, 0, 1, transport, 0.0, out.mu), SURFMINK_TOO_MUCH_CURVATURE);
    }
}

/* In an outline of many blocks of corners, wherever the fault is. */
THEOREM(a_long_outline_is_looked_at_before_anything_is_written)
{
    enum { MANY = 300 };
    static double xy[2 * MANY], round[3 * MANY], normal[3 * MANY], length[MANY], turning[MANY], before[MANY];
    size_t i, kind;
    memset(before, 0xA5, sizeof before);
    for (i = 0; i < MANY; ++i) {
        double angle = 2 * PI * (double)i / MANY;
        xy[2 * i] = round[3 * i] = cos(angle);
        xy[2 * i + 1] = round[3 * i + 1] = sin(angle);
        round[3 * i + 2] = 0.1;
        normal[3 * i + 2] = 1;
    }
    for (i = 0; i < MANY; ++i)
        for (kind = 0; kind < 3; ++kind) {
            surfmink_outline o = kind == 0   ? surfmink_plane(xy, MANY)
                                 : kind == 1 ? surfmink_sphere(round, MANY, 1)
                                             : surfmink_embedded(round, normal, MANY);
            double *corner = kind ? round : xy, kept[3];
            size_t dim = kind ? 3 : 2, next = i + 1 < MANY ? i + 1 : 0;
            memcpy(kept, corner + dim * next, dim * sizeof *kept);
            memcpy(corner + dim * next, corner + dim * i, dim * sizeof *kept);
            memcpy(length, before, sizeof length);
            memcpy(turning, before, sizeof turning);
            CASE("kind %u, corner %u", (unsigned)kind, (unsigned)next);
            CHECK_STATUS(surfmink_edges(&o, length, turning, &bad), SURFMINK_COINCIDENT_CORNERS);
            CHECK(bad == i || bad == next);
            CHECK(memcmp(length, before, sizeof length) == 0 && memcmp(turning, before, sizeof turning) == 0);
            memcpy(corner + dim * next, kept, dim * sizeof *kept);
        }
}

/* Within 8 eps of the antipode an arc has no direction. */
THEOREM(an_arc_ends_8_eps_before_the_antipode)
{
    static const double sine[4] = {6.5 * DBL_EPSILON, 7.5 * DBL_EPSILON, 8.5 * DBL_EPSILON, 12 * DBL_EPSILON};
    double corner[9] = {1, 0, 0, -1, 0, 0, 0, 0, 1};
    int k;
    for (k = 0; k < 4; ++k) {
        corner[4] = sine[k];
        fill();
        CHECK_STATUS(surfmink_edges(ON_SPHERE(corner, 3, 1), out.length, out.turning, &bad),
                     k < 2 ? SURFMINK_ANTIPODAL_CORNERS : SURFMINK_OK);
    }
}

/* Needles, whose area is rounding noise of either sign, and what contradicts itself: in any unit. */
THEOREM(the_status_in_the_plane_knows_no_unit)
{
    static const double crossed[10] = {1, 0, 1, 6, 0, 6, 6, 4, 0, 0};
    chance c = {46};
    long negative = 0;
    int trial, power;
    for (trial = 0; trial < 400; ++trial) {
        double corner[10], scaled[10], area = 0, along, t;
        size_t n = trial ? 3 : 5, i;
        memcpy(corner, crossed, sizeof corner);
        if (trial) {
            along = between(&c, 0, 6);
            t = between(&c, 0.2, 0.8);
            corner[0] = between(&c, -1, 1), corner[1] = between(&c, -1, 1);
            corner[2] = corner[0] + cos(along), corner[3] = corner[1] + sin(along);
            corner[4] = corner[0] + t * cos(along), corner[5] = corner[1] + t * sin(along);
            for (i = 0; i < 3; ++i)
                area += corner[2 * i] * corner[2 * ((i + 1) % 3) + 1] - corner[2 * ((i + 1) % 3)] * corner[2 * i + 1];
            negative += area < 0;
        }
        CASE("%d", trial);
        for (power = -500; power <= 500; power += 500) {
            for (i = 0; i < 2 * n; ++i) scaled[i] = ldexp(corner[i], power);
            fill();
            if (trial) {
                int status = surfmink_measure(IN_PLANE(scaled, n), 3, out.mu, NULL, NULL, &bad);
                CHECK(status == SURFMINK_OK || status == SURFMINK_CLOCKWISE);
                CHECK_STATUS(status, surfmink_measure(IN_PLANE(corner, n), 3, out.mu, NULL, NULL, &bad));
            } else {
                CHECK_STATUS(surfmink_measure(IN_PLANE(scaled, n), 3, out.mu, NULL, NULL, &bad),
                             SURFMINK_CROSSES_ITSELF);
            }
        }
    }
    CHECK(negative > 50 && negative < 350);
}

/* An arc that goes there and back is as thin as an outline can be, and right, whichever side rounding takes: of a long
   one both turns are +pi within 8 eps, which has no sign. */
THEOREM(an_arc_there_and_back_encloses_nothing_and_is_right)
{
    chance c = {47};
    long negative = 0;
    int trial;
    for (trial = 0; trial < 400; ++trial) {
        double corner[9], t = between(&c, 0.2, 0.8);
        int k;
        for (k = 0; k < 6; ++k) corner[k] = between(&c, 0.2, 1) * (k == 3 ? -1 : 1);
        for (k = 0; k < 3; ++k) corner[6 + k] = corner[k] + t * (corner[3 + k] - corner[k]);
        CASE("%d", trial);
        fill();
        CHECK_OK(surfmink_measure(ON_SPHERE(corner, 3, 1), 3, out.mu, NULL, &out.w, &bad));
        CHECK_NEAR(out.w.area, 0, 1e-15 * out.w.length * out.w.length);
        negative += out.w.area < 0;
    }
    CHECK(negative > 50 && negative < 350);
}

/* Where the triangles from corner 0 do not do, since an edge passes next to its antipode, other directions do, however
   far out the corners are. */
THEOREM(the_status_on_the_sphere_knows_no_distance_of_corners)
{
    static const double path[24] = {-1, -1, 1, 1, -1, -1, 1, 1, 1, 1, -1, 1, 1, 1, -1, -1, -1, -1, -1, 1, 1, -1, 1, -1};
    int power, first;
    for (first = 0; first < 16; ++first) {
        double fine[48], scaled[48];
        size_t i, k;
        int status = -1;
        for (i = 0; i < 8; ++i)
            for (k = 0; k < 3; ++k) {
                const double *a = path + 3 * i, *b = path + 3 * ((i + 1) % 8);
                fine[3 * ((2 * i + (size_t)first) % 16) + k] = a[k];
                fine[3 * ((2 * i + 1 + (size_t)first) % 16) + k] = 0.7 * a[k] + 0.3 * b[k];
            }
        for (power = -120; power <= 120; power += 40) {
            int got;
            for (i = 0; i < 48; ++i) scaled[i] = ldexp(fine[i], power);
            fill();
            got = surfmink_measure(ON_SPHERE(scaled, 16, 1), 3, out.mu, NULL, NULL, &bad);
            if (status < 0) status = got;
            CASE("first %d, 2^%d", first, power);
            CHECK_STATUS(got, status);
            CHECK_STATUS(got, SURFMINK_CROSSES_ITSELF);
        }
    }
}

THEOREM(a_total_turn_below_the_noise_is_no_turn)
{
    /* |S| <= max(1e-12 sum |alpha|, 4 n eps): here sum |alpha| = 4, or nearly 0. */
    static const double l[4] = {1, 1, 1, 1};
    static const double sums[8] = {2e-12, 8e-12, 1e-313, 1e-15, 3e-15, 1e-14, 16 * DBL_EPSILON, 17 * DBL_EPSILON};
    static const int big[8] = {1, 1, 1, 0, 0, 0, 0, 0}, is_noise[8] = {1, 0, 1, 1, 1, 0, 1, 0};
    double turning[4];
    int k;
    for (k = 0; k < 8; ++k) {
        turning[0] = turning[1] = big[k];
        turning[2] = -big[k];
        turning[3] = -big[k] + sums[k];
        CASE("S = %g", sums[k]);
        if (is_noise[k]) {
            REFUSES(surfmink_total(NULL, l, turning, 4, &out.w), SURFMINK_TOO_MUCH_CURVATURE);
            REFUSES(surfmink_phases(turning, 4, SURFMINK_CORRECTED, out.turning), SURFMINK_TOO_MUCH_CURVATURE);
        } else {
            CHECK_OK(surfmink_total(NULL, l, turning, 4, &out.w));
            CHECK_OK(surfmink_phases(turning, 4, SURFMINK_CORRECTED, out.turning));
        }
        turning[3] = -big[k] - sums[k];
        REFUSES(surfmink_total(NULL, l, turning, 4, &out.w),
                is_noise[k] ? SURFMINK_TOO_MUCH_CURVATURE : SURFMINK_CLOCKWISE);
    }
}

THEOREM(vectors_are_carried_only_along_sound_edges)
{
    double corner[15], turning[5], length[5], vector[3] = {1, 0, 0};
    pentagon(EMBEDDED, corner);
    CHECK_OK(surfmink_edges(IN_SPACE(corner, corner, 5), length, turning, NULL));
    CHECK_OK(carry(IN_SPACE(corner, corner, 5), turning, 0, 2, SURFMINK_CORRECTED, vector, out.vector));
    REFUSES(carry(IN_SPACE(corner, corner, 2), turning, 0, 2, SURFMINK_CORRECTED, vector, out.vector),
            SURFMINK_TOO_FEW_CORNERS);
    REFUSES(carry(IN_SPACE(corner, corner, 5), turning, 5, 2, SURFMINK_CORRECTED, vector, out.vector),
            SURFMINK_BAD_ARGUMENT);
    REFUSES(carry(IN_SPACE(corner, corner, 5), turning, 0, 2, 7, vector, out.vector), SURFMINK_BAD_ARGUMENT);
    vector[1] = nan_();
    REFUSES(carry(IN_SPACE(corner, corner, 5), turning, 0, 2, SURFMINK_CORRECTED, vector, out.vector),
            SURFMINK_NOT_FINITE);
    vector[1] = 0;
    turning[3] = nan_();
    REFUSES(carry(IN_SPACE(corner, corner, 5), turning, 0, 2, SURFMINK_PARALLEL, vector, out.vector),
            SURFMINK_NOT_FINITE);
    turning[3] = -10;
    REFUSES(carry(IN_SPACE(corner, corner, 5), turning, 0, 2, SURFMINK_CORRECTED, vector, out.vector),
            SURFMINK_CLOCKWISE);
    memcpy(corner + 9, corner + 6, 3 * sizeof *corner); /* edge 2, where it arrives */
    REFUSES(carry(IN_SPACE(corner, corner, 5), turning, 0, 2, SURFMINK_PARALLEL, vector, out.vector),
            SURFMINK_COINCIDENT_CORNERS);
    REFUSES(carry(IN_SPACE(corner, corner, 5), turning, 2, 2, SURFMINK_PARALLEL, vector, out.vector),
            SURFMINK_COINCIDENT_CORNERS);
}

THEOREM(tensors_and_spectra_refuse_ranks_that_do_not_exist)
{
    double g[8] = {4, 0, 1, 2, 3, 4, 1, 1}, tensor[4] = {1, 2, 3, 4}, vector[2] = {1, 0},
           frame[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    size_t k;
    REFUSES(surfmink_tensor(g, -1, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_tensor(g, 1001, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_trace_free(g, -1, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_trace_free(g, 1001, out.g), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_contract(tensor, 0, vector, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_contract(tensor, 1001, vector, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_spectrum(g, -1, out.mu, out.length, out.turning), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_angles(g, 0, 1, out.mu), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_angles(g, -1, 1, out.mu), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_eigenvectors(g, 0, 1, 0.0, frame, 2, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_eigenvectors(g, 2, 1, 0.0, frame, 1, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_eigenvectors(g, 2, 1, 0.0, frame, 4, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_eigenvectors(g, 2, 1, nan_(), frame, 2, out.vector), SURFMINK_NOT_FINITE);
    for (k = 0; k < 6; ++k) {
        double kept = frame[k];
        frame[k] = infinity_();
        REFUSES(surfmink_eigenvectors(g, 2, 1, 0.0, frame, 3, out.vector), SURFMINK_NOT_FINITE);
        frame[k] = kept;
    }
    for (k = 0; k < 8; ++k) {
        double kept = g[k];
        g[k] = k % 2 ? nan_() : infinity_();
        CASE("component %d", (int)k);
        REFUSES(surfmink_spectrum(g, 3, out.mu, out.length, out.turning), SURFMINK_NOT_FINITE);
        if (k / 2 > 0) {
            REFUSES(surfmink_angles(g, (int)k / 2, 1, out.mu), SURFMINK_NOT_FINITE);
            REFUSES(surfmink_eigenvectors(g, (int)k / 2, 1, 0.0, frame, 2, out.vector), SURFMINK_NOT_FINITE);
        }
        g[k] = kept;
    }
    g[2] = g[3] = 1.5e308; /* whose modulus overflows */
    REFUSES(surfmink_spectrum(g, 3, out.mu, out.length, out.turning), SURFMINK_NOT_FINITE);
    g[2] = g[3] = 1e300, g[0] = 1e-10; /* whose ratio does */
    REFUSES(surfmink_spectrum(g, 3, out.mu, out.length, out.turning), SURFMINK_NOT_FINITE);
    g[0] = 0;
    REFUSES(surfmink_spectrum(g, 3, out.mu, out.length, out.turning), SURFMINK_BAD_ARGUMENT);
    g[0] = -1;
    REFUSES(surfmink_spectrum(g, 3, out.mu, out.length, out.turning), SURFMINK_BAD_ARGUMENT);
}

THEOREM(frames_refuse_edges_that_have_none)
{
    static const double chord[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0}, along[9] = {1, 1e-3, 0, 1, -1e-3, 0, 0, 0, 1};
    double flat[10], space[15];
    REFUSES(surfmink_frame(IN_SPACE(chord, along, 3), 0, out.vector), SURFMINK_ZERO_NORMAL); /* the means of both */
    pentagon(PLANE, flat);
    pentagon(EMBEDDED, space);
    REFUSES(surfmink_frame(IN_PLANE(flat, 2), 0, out.vector), SURFMINK_TOO_FEW_CORNERS);
    REFUSES(surfmink_frame(IN_SPACE(space, space, 2), 0, out.vector), SURFMINK_TOO_FEW_CORNERS);
    REFUSES(surfmink_frame(IN_PLANE(flat, 5), 5, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_frame(IN_SPACE(space, space, 5), 5, out.vector), SURFMINK_BAD_ARGUMENT);
    memcpy(flat + 2, flat, 2 * sizeof *flat);
    memcpy(space + 3, space, 3 * sizeof *space);
    REFUSES(surfmink_frame(IN_PLANE(flat, 5), 0, out.vector), SURFMINK_COINCIDENT_CORNERS);
    REFUSES(surfmink_frame(IN_SPACE(space, space, 5), 0, out.vector), SURFMINK_COINCIDENT_CORNERS);
    CHECK_OK(surfmink_frame(IN_PLANE(flat, 5), 2, out.vector)); /* other edges are not asked */
    CHECK_OK(surfmink_frame(IN_SPACE(space, space, 5), 2, out.vector));
    flat[1] = nan_();
    space[1] = nan_();
    REFUSES(surfmink_frame(IN_PLANE(flat, 5), 4, out.vector), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_frame(IN_SPACE(space, space, 5), 4, out.vector), SURFMINK_NOT_FINITE);
}

THEOREM(points_of_the_sphere_refuse_what_is_none)
{
    double x[3] = {0, 0, 2}, y[3] = {1, 0, 0}, opposite[3] = {0, 0, -5}, zero[3] = {0, 0, 0}, wrong[3] = {0, 0, 1};
    size_t k;
    REFUSES(surfmink_sphere_log(x, opposite, 1.0, out.vector), SURFMINK_ANTIPODAL_CORNERS);
    REFUSES(surfmink_sphere_log(zero, y, 1.0, out.vector), SURFMINK_ZERO_NORMAL);
    REFUSES(surfmink_sphere_log(x, zero, 1.0, out.vector), SURFMINK_ZERO_NORMAL);
    REFUSES(surfmink_sphere_exp(zero, y, 1.0, out.vector), SURFMINK_ZERO_NORMAL);
    for (k = 0; k < 3; ++k) {
        double kept = wrong[k];
        wrong[k] = k % 2 ? nan_() : infinity_();
        REFUSES(surfmink_sphere_log(wrong, y, 1.0, out.vector), SURFMINK_NOT_FINITE);
        REFUSES(surfmink_sphere_log(y, wrong, 1.0, out.vector), SURFMINK_NOT_FINITE);
        REFUSES(surfmink_sphere_exp(wrong, y, 1.0, out.vector), SURFMINK_NOT_FINITE);
        REFUSES(surfmink_sphere_exp(y, wrong, 1.0, out.vector), SURFMINK_NOT_FINITE);
        wrong[k] = kept;
    }
    REFUSES(surfmink_from_lonlat(nan_(), 0, 1.0, out.vector), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_from_lonlat(0, infinity_(), 1.0, out.vector), SURFMINK_NOT_FINITE);
    REFUSES(surfmink_from_lonlat(1.1e6, 0, 1.0, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_from_lonlat(-1.1e6, 0, 1.0, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_from_lonlat(0, 90.001, 1.0, out.vector), SURFMINK_BAD_ARGUMENT);
    REFUSES(surfmink_from_lonlat(0, -90.001, 1.0, out.vector), SURFMINK_BAD_ARGUMENT);
    CHECK_OK(surfmink_from_lonlat(1e6, 90, 1.0, out.vector));
    CHECK_OK(surfmink_from_lonlat(-1e6, -90, 1.0, out.vector));
}

/* --- whatever is drawn -------------------------------------------------------------------------------------------- */

/* Numbers that break programs, and ordinary ones, so that outlines are refused for many reasons and often not at
   all. */
static double any_number(chance *c)
{
    static const double odd[16] = {0.0,    -0.0,  1,      -1,     2,       1e-9,    1e-160,   1e160,
                                   -1e160, 1e300, -1e300, 1e-300, DBL_MIN, DBL_MAX, -DBL_MAX, 5e-324};
    size_t k = one_of(c, 48);
    if (k < 16) return odd[k];
    if (k == 16) return nan_();
    if (k == 17) return infinity_();
    if (k == 18) return -infinity_();
    if (k < 24) return floor(between(c, -3, 3));
    return between(c, -3, 3);
}

static int all_finite(const double *x, size_t count)
{
    while (count-- > 0)
        if (!isfinite(x[count])) return 0;
    return 1;
}

/* An outline is measured with finite numbers, or refused with a corner (or n) to blame and nothing else written. */
static void sound(int status, size_t n, int ranks, int edge_arrays)
{
    if (status != SURFMINK_OK) {
        CHECK(nothing_written());
        CHECK(bad <= n);
        CHECK(strlen(surfmink_status_name(status)) > 0);
        return;
    }
    CHECK_EQUAL(bad, NOBODY);
    if (edge_arrays) {
        CHECK(all_finite(out.length, n));
        CHECK(all_finite(out.turning, n));
        return;
    }
    CHECK(all_finite(out.mu, (size_t)ranks + 1));
    CHECK(all_finite(out.g, 2 * (size_t)ranks + 2));
    CHECK(all_finite(&out.w.area, 1) && all_finite(&out.w.length, 1) && all_finite(&out.w.turning, 1));
    CHECK(all_finite(&out.w.curvature, 1) && out.w.condition > 0.99 && out.w.length > 0 && out.w.turning > 0);
    while (ranks > 0) CHECK(out.mu[ranks] >= 0 && out.mu[ranks] <= 1), --ranks;
}

THEOREM(what_is_drawn_is_measured_finite_or_refused_untouched)
{
    chance c = {seed(91)};
    double corner[3 * 8], normal[3 * 8], radius;
    surfmink_surface sphere = surfmink_sphere_surface(&radius), plane = spinning_plane();
    long seen[SURFMINK_OPPOSITE_NORMALS + 1] = {0};
    int trial, status, round;
    for (trial = 0; trial < TRIALS; ++trial) {
        size_t n = 2 + one_of(&c, 6), k;
        size_t one_in = trial % 3 ? 30 : 1; /* how many of the numbers are odd */
        for (k = 0; k < 3 * n; ++k) {
            corner[k] = one_of(&c, one_in) ? between(&c, -3, 3) : any_number(&c);
            normal[k] = one_of(&c, one_in) ? between(&c, -3, 3) : any_number(&c);
        }
        radius = one_of(&c, 4) ? 1 : any_number(&c);
        CASE("trial %d", trial);
        for (round = 0; round < 8; ++round) {
            fill();
            switch (round) {
            case 0: status = surfmink_measure(IN_PLANE(corner, n), 5, out.mu, out.g, &out.w, &bad); break;
            case 1: status = surfmink_measure(ON_SPHERE(corner, n, radius), 5, out.mu, out.g, &out.w, &bad); break;
            case 2: status = surfmink_measure(IN_SPACE(corner, normal, n), 5, out.mu, out.g, &out.w, &bad); break;
            case 3: status = surfmink_measure(ON_SURFACE(&plane, corner, n), 5, out.mu, out.g, &out.w, &bad); break;
            case 4: status = surfmink_edges(IN_PLANE(corner, n), out.length, out.turning, &bad); break;
            case 5: status = surfmink_edges(ON_SPHERE(corner, n, radius), out.length, out.turning, &bad); break;
            case 6: status = surfmink_edges(IN_SPACE(corner, normal, n), out.length, out.turning, &bad); break;
            default: status = surfmink_edges(ON_SURFACE(&sphere, corner, n), out.length, out.turning, &bad); break;
            }
            sound(status, n, 5, round >= 4);
            if (status >= 0 && status <= SURFMINK_OPPOSITE_NORMALS) ++seen[status];
        }
        fill();
        status = surfmink_area(ON_SPHERE(corner, n, radius), out.mu);
        if (status)
            CHECK(nothing_written());
        else
            CHECK(isfinite(out.mu[0]));
        fill();
        status = surfmink_area(IN_PLANE(corner, n), out.mu);
        if (status)
            CHECK(nothing_written());
        else
            CHECK(isfinite(out.mu[0]));
        fill();
        status = surfmink_sphere_log(corner, normal, radius, out.vector);
        if (status)
            CHECK(nothing_written());
        else
            CHECK(all_finite(out.vector, 3));
        fill();
        status = surfmink_sphere_exp(corner, normal, radius, out.vector);
        if (status)
            CHECK(nothing_written());
        else
            CHECK(all_finite(out.vector, 3));
        fill();
        status = surfmink_frame(IN_SPACE(corner, normal, n), 1, out.vector);
        if (status)
            CHECK(nothing_written());
        else
            CHECK(all_finite(out.vector, 9));
        fill();
        status = surfmink_irreducible(corner, normal, n, 5, out.g);
        if (status)
            CHECK(nothing_written());
        else
            CHECK(all_finite(out.g, 12));
    }
    CASE("all together");
    for (status = SURFMINK_OK; status <= SURFMINK_OPPOSITE_NORMALS; ++status) {
        CASE("%s was seen %ld times", surfmink_status_name(status), seen[status]);
        if (status != SURFMINK_UPRIGHT_EDGE && status != SURFMINK_ANTIPODAL_CORNERS &&
            status != SURFMINK_CALLBACK_FAILED)
            CHECK(seen[status] > 0);
    }
}

int main(void)
{
    PROVE(every_status_has_its_own_sentence_and_word);
    PROVE(fewer_than_three_corners_are_too_few);
    PROVE(a_corner_that_is_not_finite_is_blamed);
    PROVE(neighbours_that_coincide_are_blamed);
    PROVE(on_the_sphere_one_direction_is_one_point_however_far_off);
    PROVE(corners_may_meet_again_if_they_are_not_neighbours);
    PROVE(clockwise_outlines_are_named);
    PROVE(clockwise_is_found_out_where_a_turn_is_next_to_nothing);
    PROVE(a_rank_is_not_negative);
    PROVE(the_blame_may_be_left_out);
    PROVE(what_overflows_is_not_finite);
    PROVE(lengths_below_the_normal_range_are_refused);
    PROVE(corners_that_differ_in_one_coordinate_do_not_coincide);
    PROVE(the_area_of_a_sphere_is_told_up_to_the_largest_double);
    PROVE(what_is_as_long_as_a_double_can_say_has_no_room_for_rounding);
    PROVE(a_sphere_has_a_centre_antipodes_and_a_positive_radius);
    PROVE(areas_check_corners_and_take_either_orientation);
    PROVE(normals_need_a_direction_that_no_edge_has);
    PROVE(neighbouring_normals_are_at_most_90_degrees_apart);
    PROVE(too_much_curvature_is_named);
    PROVE(a_failing_callback_comes_back_with_its_name_and_corner);
    PROVE(nonsense_from_a_callback_is_not_believed);
    PROVE(a_surface_needs_callbacks_and_a_stride);
    PROVE(a_view_without_corners_or_normals_is_refused);
    PROVE(an_outline_whose_area_overflows_is_refused);
    PROVE(a_view_of_no_kind_or_of_another_length_is_refused);
    PROVE(a_callback_that_fails_the_second_time_is_told);
    PROVE(building_needs_a_size_and_fails_as_a_whole);
    PROVE(what_winds_more_than_once_crosses_itself);
    PROVE(what_runs_clockwise_is_told_as_that_at_any_size);
    PROVE(the_radius_does_not_excuse_a_negative_area);
    PROVE(turns_whose_sum_overflows_are_refused);
    PROVE(totals_and_phases_refuse_what_no_outline_has);
    PROVE(a_total_turn_below_the_noise_is_no_turn);
    PROVE(vectors_are_carried_only_along_sound_edges);
    PROVE(tensors_and_spectra_refuse_ranks_that_do_not_exist);
    PROVE(a_long_outline_is_looked_at_before_anything_is_written);
    PROVE(an_arc_ends_8_eps_before_the_antipode);
    PROVE(the_status_in_the_plane_knows_no_unit);
    PROVE(an_arc_there_and_back_encloses_nothing_and_is_right);
    PROVE(the_status_on_the_sphere_knows_no_distance_of_corners);
    PROVE(frames_refuse_edges_that_have_none);
    PROVE(points_of_the_sphere_refuse_what_is_none);
    PROVE(what_is_drawn_is_measured_finite_or_refused_untouched);
    return QED();
}
