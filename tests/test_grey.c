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
static double grey[SIZE * SIZE];

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

static void contours(const double *number, size_t width, size_t height, double level, enum grey_inside inside,
                     grey_loops *g)
{
    image im;
    image_error error;
    image_of(&im, number, width, height);
    CHECK(grey_contours(g, &im, level, inside, &error));
    image_free(&im);
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
            grey[row * SIZE + column] = (double)inside / (POINTS * POINTS);
        }
}

/* Three by three, of weights that sum up to 1: about a Gaussian with sigma = 1 after two. */
static void blur(void)
{
    static double old[SIZE * SIZE];
    int row, column, i, k;
    memcpy(old, grey, sizeof old);
    for (row = 1; row < SIZE - 1; ++row)
        for (column = 1; column < SIZE - 1; ++column) {
            double sum = 0;
            for (i = -1; i <= 1; ++i)
                for (k = -1; k <= 1; ++k) sum += old[(row + i) * SIZE + column + k] * (2 - abs(i)) * (2 - abs(k)) / 16;
            grey[row * SIZE + column] = sum;
        }
}

/* Measures the only loop. */
static void measure_disc(double *mu, surfmink_functionals *w)
{
    grey_loops g;
    surfmink_outline disc;
    contours(grey, SIZE, SIZE, 0.5, GREY_ABOVE, &g);
    CHECK_EQUAL(g.loops, 1);
    CHECK_EQUAL(g.open, 0);
    disc = surfmink_plane(g.xy, g.corners);
    if (g.loops == 1) CHECK_OK(surfmink_measure(&disc, RANKS, mu, NULL, w, NULL));
    grey_free(&g);
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
    grey_loops g;
    size_t k, edges = 0;
    for (k = 0; k < SIZE * SIZE; ++k) { /* a pyramid: its level sets are squares on their corners */
        double x = (double)(k % SIZE) - 47.25, y = (double)(k / SIZE) - 47.5;
        grey[k] = fabs(x) + fabs(y);
    }
    contours(grey, SIZE, SIZE, 30.3, GREY_BELOW, &g);
    CHECK_EQUAL(g.loops, 1);
    for (k = 0; k < g.corners; ++k, ++edges) {
        double x = g.xy[2 * k] - 47.25, y = -g.xy[2 * k + 1] - 47.5;
        if (fabs(x) > 1 && fabs(y) > 1) CHECK_NEAR(fabs(x) + fabs(y), 30.3, 1e-12);
    }
    CHECK(edges > 100);
    grey_free(&g);
}

static double area_of(const grey_loops *g)
{
    double area = 0;
    size_t k, i, next;
    for (k = 0; k < g->loops; ++k)
        for (i = g->start[k]; i < g->start[k + 1]; ++i) {
            next = i + 1 < g->start[k + 1] ? i + 1 : g->start[k];
            area += 0.5 * (g->xy[2 * i] * g->xy[2 * next + 1] - g->xy[2 * next] * g->xy[2 * i + 1]);
        }
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
        grey_loops above, below, other;
        size_t k;
        holes = round % 3 == 2;
        for (k = 0; k < WIDTH * HEIGHT; ++k) {
            number[k] = round % 2 ? between(&c, 0, 1) : (double)one_of(&c, 4); /* often exactly at the level */
            if (holes && one_in(&c, 30)) number[k] = (double)NAN;
            turned[k % WIDTH * HEIGHT + HEIGHT - 1 - k / WIDTH] = number[k];
        }
        CASE("image %d", round);
        contours(number, WIDTH, HEIGHT, round % 2 ? 0.5 : 2, GREY_ABOVE, &above);
        contours(number, WIDTH, HEIGHT, round % 2 ? 0.5 : 2, GREY_BELOW, &below);
        contours(turned, HEIGHT, WIDTH, round % 2 ? 0.5 : 2, GREY_ABOVE, &other);
        CHECK_EQUAL(above.loops + above.collapsed, below.loops + below.collapsed);
        CHECK_EQUAL(above.loops, other.loops);
        CHECK_EQUAL(above.open, below.open);
        CHECK_EQUAL(above.open, other.open);
        CHECK_NEAR(area_of(&above), -area_of(&below), 1e-9);
        CHECK_NEAR(area_of(&above), area_of(&other), 1e-9);
        CHECK(above.loops > 3);
        CHECK(above.open > 0);
        grey_free(&above);
        grey_free(&below);
        grey_free(&other);
    }
}

/* Two opposite corners at 1, two at 0, in a frame of 0: connected over the saddle where that is inside. */
THEOREM(a_saddle_is_decided_bilinearly)
{
    static double number[16] = {0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0};
    grey_loops g;
    double level;
    for (level = 0.3; level < 1; level += 0.4) { /* the saddle is at 0.5 */
        contours(number, 4, 4, level, GREY_ABOVE, &g);
        CHECK_EQUAL(g.loops, level < 0.5 ? 1 : 2);
        CHECK_EQUAL(g.open, 0);
        grey_free(&g);
    }
}

THEOREM(what_is_open_is_counted_and_what_is_flat_is_none)
{
    static double number[20] = {0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
    static double dot[9] = {0, 0, 0, 0, 1, 0, 0, 0, 0};
    grey_loops g;
    contours(number, 5, 4, 0.5, GREY_ABOVE, &g); /* a ridge from border to border has two sides */
    CHECK_EQUAL(g.loops, 0);
    CHECK_EQUAL(g.open, 2);
    grey_free(&g);
    contours(dot, 3, 3, 1, GREY_ABOVE, &g);
    CHECK_EQUAL(g.loops, 0);
    CHECK_EQUAL(g.collapsed, 1);
    grey_free(&g);
    contours(dot, 3, 3, 0.5, GREY_ABOVE, &g);
    CHECK_EQUAL(g.loops, 1);
    CHECK_NEAR(area_of(&g), 0.5, 1e-15);
    grey_free(&g);
    contours(dot, 3, 3, 0.5, GREY_BELOW, &g);
    CHECK_NEAR(area_of(&g), -0.5, 1e-15); /* a hole runs the other way */
    grey_free(&g);
    dot[0] = (double)NAN;
    contours(dot, 3, 3, 0.5, GREY_ABOVE, &g);
    CHECK_EQUAL(g.loops, 0);
    CHECK_EQUAL(g.open, 1);
    grey_free(&g);
}

int main(void)
{
    PROVE(a_disc_is_round);
    PROVE(a_plane_is_cut_along_straight_lines);
    PROVE(both_sides_of_a_level_have_the_same_curves);
    PROVE(a_saddle_is_decided_bilinearly);
    PROVE(what_is_open_is_counted_and_what_is_flat_is_none);
    return QED();
}
