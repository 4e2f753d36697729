/* examples/image/grey.h: curves on which a grey image has a given value. */
#ifndef SURFMINK_IMPLEMENTED
#define SURFMINK_IMPLEMENTATION
#endif
#include "surfmink.h"

#include <stdlib.h>

#include "examples/image/grey.h"
#include "harness.h"
#include "chance.h"

#define PI 3.14159265358979323846

enum { SIZE = 96, RANKS = 8 };
static double picture[SIZE * SIZE];

static void image_of(image *im, const double *number, size_t width, size_t height)
{
    static const uint16_t one = 1;
    image_error error;
    memset(im, 0, sizeof *im);
    im->name = "memory";
    im->size = width * height * sizeof *number;
    im->bytes = (unsigned char *)malloc(im->size);
    if (im->bytes) memcpy(im->bytes, number, im->size);
    im->width = width;
    im->height = height;
    im->channels = im->interleave = 1;
    im->kind = IMAGE_FLOAT;
    im->sample = sizeof *number;
    im->is_big_endian = *(const unsigned char *)&one == 0;
    CHECK(im->bytes && image_lay_rows(im, 0, &error));
}

/* Cuts an image in the plane, with square pixels of size 1. */
static void cut(const double *number, size_t width, size_t height, double level, int how, contours *c)
{
    image im;
    image_error error;
    grey g;
    memset(&g, 0, sizeof g);
    image_of(&im, number, width, height);
    g.im = &im;
    g.spacing[0] = g.spacing[1] = 1;
    CHECK(grey_begin(&g, &error) && grey_level_set(&g, level, how, c, &error));
    grey_free(&g);
    image_free(&im);
}

static size_t corners_of(const contours *c)
{
    return c->start[c->loops];
}

/* The share of each pixel that lies in a disc, by 16 x 16 points. */
static void draw_disc(double radius, double x, double y)
{
    enum { POINTS = 16 };
    int row, column, i, k;
    for (row = 0; row < SIZE; ++row)
        for (column = 0; column < SIZE; ++column) {
            int inside = 0;
            for (i = 0; i < POINTS; ++i)
                for (k = 0; k < POINTS; ++k)
                    inside += hypot(column - x + (i + 0.5) / POINTS - 0.5, row - y + (k + 0.5) / POINTS - 0.5) < radius;
            picture[row * SIZE + column] = (double)inside / (POINTS * POINTS);
        }
}

/* Three by three, of weights that sum up to 1: about a Gaussian with sigma = 1 after two. */
static void blur(void)
{
    static double old[SIZE * SIZE];
    int row, column, i, k;
    memcpy(old, picture, sizeof old);
    for (row = 1; row < SIZE - 1; ++row)
        for (column = 1; column < SIZE - 1; ++column) {
            double sum = 0;
            for (i = -1; i <= 1; ++i)
                for (k = -1; k <= 1; ++k) sum += old[(row + i) * SIZE + column + k] * (2 - abs(i)) * (2 - abs(k)) / 16;
            picture[row * SIZE + column] = sum;
        }
}

/* Measures the only loop. */
static void measure_disc(double *mu, surfmink_functionals *w)
{
    contours g;
    surfmink_outline disc;
    cut(picture, SIZE, SIZE, 0.5, CONTOUR_ABOVE, &g);
    CHECK_EQUAL(g.loops, 1);
    CHECK_EQUAL(g.open, 0);
    disc = surfmink_embedded(g.corner, g.normal, corners_of(&g));
    if (g.loops == 1) CHECK_OK(surfmink_measure(&disc, RANKS, mu, NULL, w, NULL));
    contours_free(&g);
}

/* As sharp as pixels are, and blurred. (Cut into triangles, squares leave mu_4 at .01 to .19 on the sharp disc.) */
THEOREM(a_disc_is_round)
{
    static const double mu_4[2] = {.012, .002}, mu_8[2] = {.115, .0065}, area[2] = {.001, .002};
    double mu[RANKS + 1];
    surfmink_functionals w;
    chance c = {3};
    int blurred, round, p;
    for (blurred = 0; blurred < 2; ++blurred)
        for (round = 0; round < 20; ++round) {
            CASE("blurred %d, disc %d", blurred, round);
            draw_disc(32, 47 + between(&c, 0, 1), 47 + between(&c, 0, 1));
            if (blurred) blur();
            if (blurred) blur();
            measure_disc(mu, &w);
            for (p = 2; p <= 4; ++p) CHECK(mu[p] < mu_4[blurred]);
            CHECK(mu[8] < mu_8[blurred]);
            CHECK_CLOSE(w.area, PI * 32 * 32, area[blurred]);
        }
}

THEOREM(a_plane_is_cut_along_straight_lines)
{
    contours g;
    size_t k, edges = 0;
    for (k = 0; k < SIZE * SIZE; ++k) { /* a pyramid: its level sets are squares on their corners */
        double x = (double)(k % SIZE) - 47.25, y = (double)(k / SIZE) - 47.5;
        picture[k] = fabs(x) + fabs(y);
    }
    cut(picture, SIZE, SIZE, 30.3, CONTOUR_BELOW, &g);
    CHECK_EQUAL(g.loops, 1);
    for (k = 0; k < corners_of(&g); ++k, ++edges) {
        double x = g.corner[3 * k] - 47.25, y = -g.corner[3 * k + 1] - 47.5;
        if (fabs(x) > 1 && fabs(y) > 1) CHECK_NEAR(fabs(x) + fabs(y), 30.3, 1e-12);
    }
    CHECK(edges > 100);
    contours_free(&g);
}

static double area_of_loop(const contours *c, size_t k)
{
    double area = 0;
    const double *a, *b, *first = c->corner + 3 * c->start[k];
    size_t i, next;
    for (i = c->start[k]; i < c->start[k + 1]; ++i) {
        next = i + 1 < c->start[k + 1] ? i + 1 : c->start[k];
        a = c->corner + 3 * i;
        b = c->corner + 3 * next;
        area += 0.5 * ((a[0] - first[0]) * (b[1] - first[1]) - (b[0] - first[0]) * (a[1] - first[1]));
    }
    return area;
}

static double area_of(const contours *c)
{
    double area = 0;
    size_t k;
    for (k = 0; k < c->loops; ++k) area += area_of_loop(c, k);
    return area;
}

/* Noise has every case: both sides of a level have the same curves the other way round; turned images have turned
   ones. */
THEOREM(both_sides_of_a_level_have_the_same_curves)
{
    enum { WIDTH = 31, HEIGHT = 24 };
    static double number[WIDTH * HEIGHT], turned[WIDTH * HEIGHT];
    chance c = {17};
    int round, holes;
    for (round = 0; round < 60; ++round) {
        contours above, below, other;
        size_t k;
        holes = round % 3 == 2;
        for (k = 0; k < WIDTH * HEIGHT; ++k) {
            number[k] = round % 2 ? between(&c, 0, 1) : (double)one_of(&c, 4); /* often exactly at the level */
            if (holes && one_in(&c, 30)) number[k] = (double)NAN;
            turned[k % WIDTH * HEIGHT + HEIGHT - 1 - k / WIDTH] = number[k];
        }
        CASE("image %d", round);
        cut(number, WIDTH, HEIGHT, round % 2 ? 0.5 : 2, CONTOUR_ABOVE, &above);
        cut(number, WIDTH, HEIGHT, round % 2 ? 0.5 : 2, CONTOUR_BELOW, &below);
        cut(turned, HEIGHT, WIDTH, round % 2 ? 0.5 : 2, CONTOUR_ABOVE, &other);
        CHECK_EQUAL(above.loops + above.collapsed, below.loops + below.collapsed);
        CHECK_EQUAL(above.loops, other.loops);
        CHECK_EQUAL(above.open, below.open);
        CHECK_EQUAL(above.open, other.open);
        CHECK_NEAR(area_of(&above), -area_of(&below), 1e-9);
        CHECK_NEAR(area_of(&above), area_of(&other), 1e-9);
        CHECK(above.loops > 3);
        CHECK(above.open > 0);
        contours_free(&above);
        contours_free(&below);
        contours_free(&other);
    }
}

/* Two opposite corners at 1, two at 0, in a frame of 0: connected over the saddle where that is inside. */
THEOREM(a_saddle_is_decided_bilinearly)
{
    static double number[16] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
    contours g;
    double level;
    for (level = 0.3; level < 1; level += 0.4) { /* the saddle is at 0.5 */
        cut(number, 4, 4, level, CONTOUR_ABOVE, &g);
        CHECK_EQUAL(g.loops, level < 0.5 ? 1 : 2);
        CHECK_EQUAL(g.open, 0);
        contours_free(&g);
    }
}

THEOREM(what_is_open_is_counted_and_what_is_flat_is_none)
{
    static double number[20] = {0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
    static double dot[9] = {0, 0, 0, 0, 1, 0, 0, 0, 0};
    contours g;
    cut(number, 5, 4, 0.5, CONTOUR_ABOVE, &g); /* a ridge from border to border has two sides */
    CHECK_EQUAL(g.loops, 0);
    CHECK_EQUAL(g.open, 2);
    contours_free(&g);
    cut(dot, 3, 3, 1, CONTOUR_ABOVE, &g);
    CHECK_EQUAL(g.loops, 0);
    CHECK_EQUAL(g.collapsed, 1);
    contours_free(&g);
    cut(dot, 3, 3, 0.5, CONTOUR_ABOVE, &g);
    CHECK_EQUAL(g.loops, 1);
    CHECK_NEAR(area_of(&g), 0.5, 1e-15);
    contours_free(&g);
    cut(dot, 3, 3, 0.5, CONTOUR_BELOW, &g);
    CHECK_NEAR(area_of(&g), -0.5, 1e-15); /* a hole runs the other way */
    contours_free(&g);
    dot[0] = (double)NAN;
    cut(dot, 3, 3, 0.5, CONTOUR_ABOVE, &g);
    CHECK_EQUAL(g.loops, 0);
    CHECK_EQUAL(g.open, 1);
    contours_free(&g);
}

/* --- against sums over squares ------------------------------------------------------------------------------------ */

enum { PSI = 9 };

/* What papaya2 (Schaller, Kapfer, Schroeder-Turk 2020) sums up for an image: the area, the length and the tensors
   psi_s = sum of length (n_x + i n_y)^s over all edges, with the outer normal n and y upwards. */
typedef struct sums {
    double area, length, psi[PSI][2];
} sums;

static void add_edge(sums *all, double dx, double dy)
{
    double length = hypot(dx, dy), angle = atan2(-dx, dy);
    int s;
    all->length += length;
    for (s = 0; s < PSI; ++s) {
        all->psi[s][0] += length * cos(s * angle);
        all->psi[s][1] += length * sin(s * angle);
    }
}

static void sum_loops(sums *all, const contours *c)
{
    size_t k, i, next;
    memset(all, 0, sizeof *all);
    all->area = c->area;
    for (k = 0; k < c->loops; ++k)
        for (i = c->start[k]; i < c->start[k + 1]; ++i) {
            next = i + 1 < c->start[k + 1] ? i + 1 : c->start[k];
            add_edge(all, c->corner[3 * next] - c->corner[3 * i], c->corner[3 * next + 1] - c->corner[3 * i + 1]);
        }
}

/* Of a square a cut-off corner: the sides of it that are cut, and where it stands. */
static void add_corner(sums *all, double x, double y, int is_inside)
{
    int is_first = x * y > 0; /* in the first or third quadrant, as seen from the corner, the way runs from x to y */
    double sign = is_inside == is_first ? 1 : -1;
    all->area += (is_inside ? 0.5 : -0.5) * fabs(x * y);
    if (hypot(x, y) > 0) add_edge(all, -sign * x, sign * y);
}

/* One square: z[0] at (0, 0), z[1] at (1, 0), z[2] at (0, 1), z[3] at (1, 1), above the level or not. No table: a corner
   is cut off if both its neighbours are on the other side; else the cut is straight across. */
static void add_square(sums *all, const double z[4], double level)
{
    static const int across[4] = {3, 2, 1, 0};
    double cut[4][4], saddle;
    int in[4], count = 0, i, k, cuts_inside;
    for (i = 0; i < 4; ++i) count += in[i] = z[i] >= level;
    for (i = 0; i < 4; ++i)
        for (k = 0; k < 4; ++k) cut[i][k] = in[i] != in[k] ? (level - z[i]) / (z[k] - z[i]) : 0;
    if (count == 0) return;
    if (count == 2 && in[0] != in[3]) {
        int at = in[0] ? 0 : 3, on_x = in[at ^ 1]; /* the neighbour in x is inside as well: cut on both sides in y */
        double a = cut[at][at ^ (on_x ? 2 : 1)], b = cut[on_x ? at ^ 1 : at ^ 2][across[at]];
        double away = at == 0 ? 1 : -1; /* the outside is there */
        all->area += (a + b) / 2;
        if (on_x)
            add_edge(all, -away, away * (a - b));
        else
            add_edge(all, away * (b - a), away);
        return;
    }
    all->area += count >= 2;
    saddle = (z[0] * z[3] - z[1] * z[2]) / (z[0] + z[3] - z[1] - z[2]);
    cuts_inside = count == 2 ? saddle < level : count == 1;
    if (count == 2 && cuts_inside) all->area -= 1;
    for (i = 0; i < 4 && count < 4; ++i)
        if (in[i] == cuts_inside)
            add_corner(all, (i & 1 ? -1 : 1) * cut[i][i ^ 1], (i & 2 ? -1 : 1) * cut[i][i ^ 2], cuts_inside);
}

static void sum_squares(sums *all, const double *number, size_t width, size_t height, double level)
{
    size_t row, column, k;
    memset(all, 0, sizeof *all);
    for (row = 1; row < height; ++row)
        for (column = 0; column + 1 < width; ++column) {
            double z[4];
            for (k = 0; k < 4; ++k) z[k] = number[(row - k / 2) * width + column + k % 2];
            if (isfinite(z[0] + z[1] + z[2] + z[3])) add_square(all, z, level);
        }
}

static void check_sums(const sums *got, const sums *want, double within)
{
    int s;
    CHECK_NEAR(got->area, want->area, within);
    CHECK_NEAR(got->length, want->length, within);
    for (s = 0; s < PSI; ++s) {
        CHECK_NEAR(got->psi[s][0], want->psi[s][0], within);
        CHECK_NEAR(got->psi[s][1], want->psi[s][1], within);
    }
}

/* Loops are followed; sums need no loops. Noise, of which every other square has a saddle. */
THEOREM(loops_are_the_edges_of_all_squares)
{
    enum { WIDTH = 37, HEIGHT = 29 };
    static double number[WIDTH * HEIGHT];
    chance c = {seed(23)};
    int round;
    for (round = 0; round < 40; ++round) {
        sums got, want;
        contours g;
        size_t k;
        double level = between(&c, 0.2, 0.8);
        CASE("image %d", round);
        for (k = 0; k < WIDTH * HEIGHT; ++k) {
            size_t row = k / WIDTH, column = k % WIDTH;
            number[k] = row == 0 || column == 0 || row == HEIGHT - 1 || column == WIDTH - 1 ? 0 : between(&c, 0, 1);
        }
        cut(number, WIDTH, HEIGHT, level, CONTOUR_ABOVE, &g);
        CHECK_EQUAL(g.open + g.collapsed, 0);
        CHECK(g.loops > 10);
        sum_loops(&got, &g);
        sum_squares(&want, number, WIDTH, HEIGHT, level);
        check_sums(&got, &want, 1e-10);
        CHECK_NEAR(area_of(&g), g.area, 1e-10);
        contours_free(&g);
    }
}

/* Values that the tests of papaya2 expect of its interpolated marching squares, for pixels of size 1. */
THEOREM(small_images_have_the_values_of_papaya2)
{
    static const struct {
        const char *pixels;
        size_t width;
        double area, length, psi[PSI][2]; /* psi of 2, 3 and 4 */
    } expected[3] = {
        {"    x    ", 3, 0.5, 2.8284271247461903, {{0}, {0}, {0, 0}, {0, 0}, {-2.8284271247461903, 0}}},
        {"     x   xx  x      ", 4, 3.5, 7.6568542494923806, {{0}, {0}, {2, 0}, {-4, 0}, {-3.6568542494923806, 0}}},
        {"       x   xxx      ", 5, 3.5, 7.6568542494923806, {{0}, {0}, {-2, 0}, {0, 4}, {-3.6568542494923806, 0}}},
    };
    double number[20];
    int i, s;
    for (i = 0; i < 3; ++i) {
        size_t pixels = strlen(expected[i].pixels), k;
        contours g;
        sums got;
        for (k = 0; k < pixels; ++k) number[k] = expected[i].pixels[k] == 'x';
        cut(number, expected[i].width, pixels / expected[i].width, 0.5, CONTOUR_ABOVE, &g);
        CHECK_EQUAL(g.loops, 1);
        sum_loops(&got, &g);
        CHECK_NEAR(got.area, expected[i].area, 1e-14);
        CHECK_NEAR(got.length, expected[i].length, 1e-14);
        for (s = 2; s < 5; ++s) {
            CHECK_NEAR(got.psi[s][0], expected[i].psi[s][0], 1e-14);
            CHECK_NEAR(got.psi[s][1], expected[i].psi[s][1], 1e-14);
        }
        contours_free(&g);
    }
}

/* --- what loops enclose ------------------------------------------------------------------------------------------- */

/* Closed along the boundary, loops are the whole boundary of the inside; and of every part of it. */
THEOREM(closed_loops_enclose_the_inside)
{
    enum { WIDTH = 23, HEIGHT = 19 };
    static double number[WIDTH * HEIGHT];
    chance c = {seed(29)};
    int round, how;
    size_t closed = 0;
    for (round = 0; round < 60; ++round)
        for (how = CONTOUR_BELOW; how <= CONTOUR_ABOVE; ++how) {
            contours g;
            size_t k, i;
            CASE("image %d, %d", round, how);
            for (k = 0; k < WIDTH * HEIGHT; ++k) {
                number[k] = round % 3 ? between(&c, 0, 1) : (double)one_of(&c, 4);
                if (round % 2 && one_in(&c, 12)) number[k] = (double)NAN;
            }
            cut(number, WIDTH, HEIGHT, round % 3 ? between(&c, 0, 1) : 2, how | CONTOUR_CLOSE | CONTOUR_PARTS, &g);
            CHECK_EQUAL(g.open, 0);
            CHECK_NEAR(area_of(&g), g.area, 1e-10);
            closed += g.closed;
            for (k = 0; k < g.loops; ++k) { /* the loops of one part */
                double part = 0;
                for (i = 0; i < g.loops; ++i) part += g.part[i] == g.part[k] ? area_of_loop(&g, i) : 0;
                CHECK(part > 0);
            }
            contours_free(&g);
        }
    CHECK(closed > 1000);
}

/* Without holes in the image, what the surface has on the left of a loop and on its right is what the loop encloses. */
THEOREM(what_a_loop_encloses_is_summed_over_parts)
{
    enum { WIDTH = 31, HEIGHT = 27 };
    static double number[WIDTH * HEIGHT];
    const double whole = (WIDTH - 1) * (HEIGHT - 1);
    chance c = {seed(31)};
    int round, how;
    for (round = 0; round < 40; ++round)
        for (how = 0; how < 4; ++how) { /* below or above, closed or not */
            contours g;
            size_t k, i, outer;
            CASE("image %d, %d", round, how);
            for (k = 0; k < WIDTH * HEIGHT; ++k) number[k] = between(&c, 0, 1);
            cut(number, WIDTH, HEIGHT, between(&c, 0.1, 0.9), how | CONTOUR_PARTS, &g);
            for (k = 0; k < g.loops; ++k) {
                double area = area_of_loop(&g, k);
                CHECK_NEAR(g.enclosed[2 * k], area > 0 ? area : whole + area, 1e-9);
                CHECK_NEAR(g.enclosed[2 * k] + g.enclosed[2 * k + 1], whole, 1e-9);
                for (i = outer = 0; i < g.loops; ++i) outer += g.part[i] == g.part[k] && area_of_loop(&g, i) > 0;
                CHECK(how & CONTOUR_CLOSE ? outer == 1 : outer <= 1);
            }
            contours_free(&g);
        }
}

/* --- on a chart --------------------------------------------------------------------------------------------------- */

enum { CHART = 61, PIXELS = CHART * CHART };

typedef struct sphere_chart {
    double height[PIXELS];
    chart space;
    image map, im;
    grey g;
} sphere_chart;

/* The unit sphere about its north pole, stereographic, from above: column 30 and row 30 are the pole. Mirrored in x; and
   folded behind a column, from which on it comes back. */
static void chart_of_sphere(sphere_chart *s, int is_mirrored, int fold)
{
    static double planes[3 * PIXELS];
    image_error error;
    size_t k;
    for (k = 0; k < PIXELS; ++k) {
        int column = (int)(k % CHART);
        double u, v = (30 - (double)(k / CHART)) / 25, square;
        if (column > fold) column = 2 * fold - column;
        u = ((double)column - 30) / 25 * (is_mirrored ? -1 : 1);
        square = u * u + v * v;
        planes[k] = 2 * u / (1 + square);
        planes[PIXELS + k] = 2 * v / (1 + square);
        s->height[k] = planes[2 * PIXELS + k] = (1 - square) / (1 + square);
    }
    image_of(&s->map, planes, CHART, 3 * CHART);
    s->map.height = CHART;
    s->map.channels = 3;
    free(s->map.row);
    CHECK(image_lay_rows(&s->map, 0, &error));
    memset(&s->space, 0, sizeof s->space);
    s->space.position = s->space.normal = &s->map; /* on the unit sphere a point is its normal */
    memset(&s->g, 0, sizeof s->g);
    s->g.im = &s->im;
    s->g.space = &s->space;
}

static void cut_chart(sphere_chart *s, const double *number, double level, int how, contours *c)
{
    image_error error;
    image_of(&s->im, number, CHART, CHART);
    CHECK(grey_begin(&s->g, &error) && grey_level_set(&s->g, level, how, c, &error));
    grey_free(&s->g);
    image_free(&s->im);
}

/* Circles of latitude. Pixels are 0.08 apart at the pole: of a circle of radius r the chords between them cut off up to
   0.4 (0.08 / r)^2, as measured. */
THEOREM(a_cap_on_a_chart_is_round)
{
    static sphere_chart s;
    int is_mirrored, flips, p;
    double height;
    for (is_mirrored = 0; is_mirrored < 2; ++is_mirrored)
        for (flips = 0; flips < 2; ++flips)
            for (height = -0.1; height < 0.9; height += 0.2) {
                contours c;
                surfmink_outline loop;
                surfmink_functionals w;
                double mu[RANKS + 1], within = 0.4 * 0.08 * 0.08 / (1 - height * height);
                CASE("mirrored %d, flipped %d, height %g", is_mirrored, flips, height);
                chart_of_sphere(&s, is_mirrored, CHART);
                s.space.flips = flips;
                cut_chart(&s, s.height, height, CONTOUR_ABOVE | CONTOUR_PARTS, &c);
                CHECK_EQUAL(c.loops, 1);
                loop = surfmink_embedded(c.corner, c.normal, corners_of(&c));
                if (height > 0)
                    CHECK_OK(surfmink_measure(&loop, RANKS, mu, NULL, &w, NULL));
                else
                    CHECK_STATUS(surfmink_measure(&loop, RANKS, mu, NULL, &w, NULL), SURFMINK_CLOCKWISE);
                if (height > 0) {
                    CHECK_CLOSE(w.length, 2 * PI * sqrt(1 - height * height), within);
                    for (p = 1; p <= RANKS; ++p) CHECK_NEAR(mu[p], 0, 0.01);
                }
                CHECK_CLOSE(c.area, 2 * PI * (1 - height), within);
                CHECK_NEAR(c.enclosed[0], c.area, 1e-12);
                contours_free(&c);
                image_free(&s.map);
            }
}

/* Where the chart turns back the surface ends: a disc across it is two halves, which can be closed. */
THEOREM(a_chart_ends_where_it_is_folded)
{
    static sphere_chart s;
    static double number[PIXELS];
    contours c;
    size_t k;
    int row, column;
    for (k = 0; k < PIXELS; ++k) {
        row = (int)(k / CHART) - 30;
        column = (int)(k % CHART) - 40;
        number[k] = hypot(row, column);
    }
    chart_of_sphere(&s, 0, 40);
    cut_chart(&s, number, 7.3, CONTOUR_BELOW, &c);
    CHECK_EQUAL(c.loops, 0);
    CHECK_EQUAL(c.open, 2);
    contours_free(&c);
    cut_chart(&s, number, 7.3, CONTOUR_BELOW | CONTOUR_CLOSE | CONTOUR_PARTS, &c);
    CHECK_EQUAL(c.loops, 2);
    CHECK_EQUAL(c.closed, 2);
    for (k = 0; k < c.loops; ++k) {
        size_t n = c.start[k + 1] - c.start[k];
        surfmink_outline half = surfmink_embedded(c.corner + 3 * c.start[k], c.normal + 3 * c.start[k], n);
        CHECK_OK(surfmink_measure(&half, 6, NULL, NULL, NULL, NULL));
        CHECK_CLOSE(c.enclosed[2 * k], c.area / 2, 1e-12);
    }
    CHECK(c.loops == 2 && c.part[0] != c.part[1]);
    contours_free(&c);
    for (k = 0; k < PIXELS; ++k) number[k] = hypot((double)(k / CHART) - 30, (double)(k % CHART) - 30);
    cut_chart(&s, number, 7.3, CONTOUR_BELOW, &c); /* beside the fold it is whole */
    CHECK_EQUAL(c.loops, 1);
    CHECK_EQUAL(c.open, 0);
    contours_free(&c);
    image_free(&s.map);
}

/* A pixel without a position is a hole, as one without a value is. */
THEOREM(what_has_no_place_is_a_hole)
{
    static sphere_chart s;
    static double number[PIXELS];
    contours c, want;
    size_t hole = 30 * CHART + 33;
    double none = (double)NAN;
    chart_of_sphere(&s, 0, CHART);
    memcpy(number, s.height, sizeof number);
    number[hole] = none;
    cut_chart(&s, number, 0.8, CONTOUR_ABOVE | CONTOUR_CLOSE | CONTOUR_PARTS, &want);
    memcpy(s.map.bytes + s.map.row[0] + hole * sizeof none, &none, sizeof none);
    cut_chart(&s, s.height, 0.8, CONTOUR_ABOVE | CONTOUR_CLOSE | CONTOUR_PARTS, &c);
    CHECK_EQUAL(s.g.holes, 1);
    CHECK_EQUAL(c.loops, 2);
    CHECK_EQUAL(c.loops, want.loops);
    CHECK_EQUAL(c.closed, 0);
    CHECK_EQUAL(corners_of(&c), corners_of(&want));
    if (corners_of(&c) == corners_of(&want)) CHECK_SAME(c.corner, want.corner, 3 * corners_of(&c));
    CHECK_NEAR(c.area, want.area, 0);
    contours_free(&c);
    contours_free(&want);
    image_free(&s.map);
}

int main(void)
{
    PROVE(a_disc_is_round);
    PROVE(a_plane_is_cut_along_straight_lines);
    PROVE(both_sides_of_a_level_have_the_same_curves);
    PROVE(a_saddle_is_decided_bilinearly);
    PROVE(what_is_open_is_counted_and_what_is_flat_is_none);
    PROVE(loops_are_the_edges_of_all_squares);
    PROVE(small_images_have_the_values_of_papaya2);
    PROVE(closed_loops_enclose_the_inside);
    PROVE(what_a_loop_encloses_is_summed_over_parts);
    PROVE(a_cap_on_a_chart_is_round);
    PROVE(a_chart_ends_where_it_is_folded);
    PROVE(what_has_no_place_is_a_hole);
    return QED();
}
