/* The command outlines, from the inside: readers, boundaries, fitted points, charts. How exactly it draws is measured
   on tissues whose cells are known; `test_outlines --table` prints what docs/images.md shows, with another number
   behind it the same of another tissue. */
#ifndef SURFMINK_IMPLEMENTED
#define SURFMINK_IMPLEMENTATION
#endif
#include "surfmink.h"

#include <stdlib.h>

/* What the headers below ask for: nothing must be asked for before a file is known to be long enough. */
static size_t memory_asked;

static void *counted_malloc(size_t size)
{
    memory_asked += size;
    return malloc(size);
}

static void *counted_calloc(size_t count, size_t size)
{
    memory_asked += count * size;
    return calloc(count, size);
}

#define malloc counted_malloc
#define calloc counted_calloc

#include "examples/image/outline.h"
#include "examples/image/raster.h"
#include "examples/image/read.h"
#include "harness.h"
#include "chance.h"

#define PI 3.14159265358979323846

/* --- from labels to outlines -------------------------------------------------------------------------------------- */

typedef struct drawing {
    image labels, position, normal;
    regions map;
    trace graph;
    fit points;
    chart space;
    outlines out;
} drawing;

typedef struct settings {
    enum fit_points points;
    int wraps, lines, flips, welds;
    double background;
} settings;

/* Numbers in memory as an image that a file could have held. */
static void image_of(image *im, const void *number, enum image_kind kind, size_t sample, size_t planes, size_t width,
                     size_t height)
{
    static const uint16_t one = 1;
    image_error error;
    memset(im, 0, sizeof *im);
    im->name = "memory";
    im->size = planes * width * height * sample;
    im->bytes = (unsigned char *)malloc(im->size);
    CHECK(im->bytes);
    if (!im->bytes) return;
    memcpy(im->bytes, number, im->size);
    im->width = width;
    im->height = height;
    im->channels = planes;
    im->kind = kind;
    im->sample = sample;
    im->interleave = 1;
    im->is_big_endian = *(const unsigned char *)&one == 0;
    CHECK(image_lay_rows(im, 0, &error));
}

/* The outlines of a label image; position and normal may be NULL. Returns 0 if it is refused. */
static int draw(drawing *d, const uint32_t *label, size_t width, size_t height, const float *position,
                const float *normal, settings how)
{
    image_error error;
    int good;
    memset(d, 0, sizeof *d);
    image_of(&d->labels, label, IMAGE_UNSIGNED, 4, 1, width, height);
    if (position) image_of(&d->position, position, IMAGE_FLOAT, 4, 3, width, height);
    if (normal) image_of(&d->normal, normal, IMAGE_FLOAT, 4, 3, width, height);
    good = regions_read(&d->map, &d->labels, how.background, how.wraps, &error);
    good = good && (!how.lines || regions_fill_lines(&d->map, &error));
    if (good) regions_count(&d->map);
    good =
        good && trace_regions(&d->graph, &d->map, &error) && fit_points_of(&d->points, &d->graph, how.points, &error);
    d->space.position = &d->position;
    d->space.normal = normal ? &d->normal : NULL;
    d->space.wraps = how.wraps;
    d->space.flips = how.flips;
    d->out.map = &d->map;
    d->out.graph = &d->graph;
    d->out.points = &d->points;
    d->out.space = position ? &d->space : NULL;
    d->out.welds = how.welds;
    good = good && outlines_make(&d->out, &error);
    CHECK(good);
    return good;
}

static void erase(drawing *d)
{
    image_free(&d->labels);
    image_free(&d->position);
    image_free(&d->normal);
    regions_free(&d->map);
    trace_free(&d->graph);
    fit_free(&d->points);
    outlines_free(&d->out);
}

/* The region with this label, 0 if there is none. */
static size_t region_of(const drawing *d, double label)
{
    size_t k;
    for (k = 1; k < d->map.count; ++k)
        if (d->map.label[k] >= label && d->map.label[k] <= label) return k;
    return 0;
}

static int is_drawn(const drawing *d, size_t region)
{
    return region > 0 && region < d->map.count && !(d->map.flag[region] & REGION_DROPPED);
}

/* --- outlines in numbers ------------------------------------------------------------------------------------------ */

enum { MOST = 20000, RANKS = 6 }; /* corners of an outline */

typedef struct outline {
    size_t n;
    double corner[3 * MOST], normal[3 * MOST];
} outline;

typedef struct measures {
    int status;
    double mu[RANKS + 1], length, area;
} measures;

/* The outline of a region: x y without a chart, which goes into `corner` by twos. */
static void outline_of(drawing *d, size_t region, outline *to)
{
    image_error error;
    size_t k, c;
    CHECK(outlines_walk(&d->out, region, &error));
    CHECK(d->out.count <= MOST);
    to->n = d->out.count < MOST ? d->out.count : MOST;
    for (k = 0; k < to->n; ++k) {
        const outline_corner *corner = &d->out.corner[k];
        if (!d->out.space)
            outlines_xy(&d->out, corner, to->corner + 2 * k);
        else
            for (c = 0; c < 3; ++c) {
                to->corner[3 * k + c] = d->out.place[6 * (size_t)corner->point + c];
                to->normal[3 * k + c] = d->out.place[6 * (size_t)corner->point + 3 + c];
            }
    }
}

static void measure_plane(const double *corner, size_t n, measures *m)
{
    surfmink_functionals w;
    surfmink_outline view = surfmink_plane(corner, n);
    m->status = surfmink_measure(&view, RANKS, m->mu, NULL, &w, NULL);
    m->length = w.length;
    m->area = w.area;
}

/* The area is that of the triangles from the first corner, as seen along the mean normal: the same for both outlines
   that are compared. */
static void measure_space(const double *corner, const double *normal, size_t n, measures *m)
{
    surfmink_functionals w;
    surfmink_outline view = surfmink_embedded(corner, normal, n);
    double area[3] = {0, 0, 0}, mean[3] = {0, 0, 0}, a[3], b[3], twice[3];
    size_t k, c;
    m->status = surfmink_measure(&view, RANKS, m->mu, NULL, &w, NULL);
    m->length = w.length;
    for (k = 0; k < n; ++k) {
        for (c = 0; c < 3; ++c) {
            a[c] = corner[3 * k + c] - corner[c];
            b[c] = k + 1 < n ? corner[3 * k + 3 + c] - corner[c] : 0;
            mean[c] += normal[3 * k + c];
        }
        chart_cross(a, b, twice);
        for (c = 0; c < 3; ++c) area[c] += twice[c] / 2;
    }
    chart_unit(mean);
    m->area = chart_dot(area, mean);
}

/* --- errors over a tissue ----------------------------------------------------------------------------------------- */

typedef struct errors {
    size_t cells;
    double rms[RANKS + 1], bias[RANKS + 1], length, area; /* the last two relative */
} errors;

static void add_error(errors *e, const measures *got, const measures *want)
{
    int p;
    CHECK_OK(got->status);
    CHECK_OK(want->status);
    ++e->cells;
    for (p = 2; p <= RANKS; ++p) {
        double off = got->mu[p] - want->mu[p];
        e->rms[p] += off * off;
        e->bias[p] += off;
    }
    e->length += (got->length / want->length - 1) * (got->length / want->length - 1);
    e->area += (got->area / want->area - 1) * (got->area / want->area - 1);
}

static void finish_errors(errors *e)
{
    int p;
    for (p = 2; p <= RANKS; ++p) {
        e->rms[p] = sqrt(e->rms[p] / (double)e->cells);
        e->bias[p] /= (double)e->cells;
    }
    e->length = sqrt(e->length / (double)e->cells);
    e->area = sqrt(e->area / (double)e->cells);
}

/* What is compared: the staircase after four passes of the mean of three, as the paper has it; fitted junctions; curves
   between them. */
enum way { STAIRCASE, JUNCTIONS, CURVE, WAYS };

static settings settings_of(enum way way)
{
    settings how;
    memset(&how, 0, sizeof how);
    how.points = way == STAIRCASE ? FIT_PIXELS : way == JUNCTIONS ? FIT_JUNCTIONS : FIT_CURVE;
    return how;
}

static outline got_outline, want_outline; /* too large for a stack */

/* All cells of the drawing against the exact ones; `unit` is the length of a pixel. */
static void compare(drawing *d, const raster *t, enum way way, double unit, errors *e)
{
    size_t region, k;
    double exact[6 * MOST / 4];
    measures got, want;
    memset(e, 0, sizeof *e);
    for (region = 1; region < d->map.count; ++region) {
        size_t n = is_drawn(d, region) ? raster_cell(t, (size_t)d->map.label[region] - 1, exact, MOST / 4) : 0;
        if (n == 0) continue;
        outline_of(d, region, &got_outline);
        if (d->out.space) {
            for (k = 0; k < n; ++k) {
                memcpy(want_outline.corner + 3 * k, exact + 6 * k, 3 * sizeof *exact);
                memcpy(want_outline.normal + 3 * k, exact + 6 * k + 3, 3 * sizeof *exact);
            }
            if (way == STAIRCASE) surfmink_smooth(got_outline.corner, got_outline.n, 3, 4);
            if (way == STAIRCASE) surfmink_smooth(got_outline.normal, got_outline.n, 3, 4);
            measure_space(got_outline.corner, got_outline.normal, got_outline.n, &got);
            measure_space(want_outline.corner, want_outline.normal, n, &want);
        } else {
            if (way == STAIRCASE) surfmink_smooth(got_outline.corner, got_outline.n, 2, 4);
            measure_plane(got_outline.corner, got_outline.n, &got);
            measure_plane(exact, n, &want);
            got.length *= unit;
            got.area *= unit * unit;
        }
        add_error(e, &got, &want);
    }
    finish_errors(e);
}

/* Sides of a tissue in the plane; a bend of .4 makes curvature times diameter about 1.3. */
static void errors_in_plane(double bend, size_t across, uint64_t seed, enum way way, errors *e)
{
    enum { SIDE = 20 };
    raster t;
    drawing d;
    uint32_t *label = (uint32_t *)malloc(SIDE * across * SIDE * across * sizeof *label);
    int good = raster_plane(&t, SIDE, bend, seed, 1);
    memset(e, 0, sizeof *e);
    CHECK(label && good);
    if (label && good && raster_draw_plane(&t, across, label) &&
        draw(&d, label, SIDE * across, SIDE * across, NULL, NULL, settings_of(way)))
        compare(&d, &t, way, 1 / (double)across, e);
    erase(&d);
    raster_free(&t);
    free(label);
}

/* A sphere or an ellipsoid in a chart in which cells are about so many pixels across at the equator or the centre. */
static void errors_on_chart(const double axis[3], enum raster_chart kind, double across, uint64_t seed, enum way way,
                            errors *e)
{
    enum { CELLS = 400 };
    raster t;
    drawing d;
    raster_map map;
    settings how = settings_of(way);
    uint32_t *label;
    float *position, *normal;
    double angle = sqrt(4 * PI / CELLS); /* of a cell */
    int good = raster_surface(&t, CELLS, axis, seed, 1);
    map.kind = kind;
    map.width = (size_t)(across / angle * (kind == RASTER_MERCATOR ? 2 * PI : 2.4));
    map.height = (size_t)(across / angle * (kind == RASTER_MERCATOR ? 5 : 2.4));
    map.scale = kind == RASTER_MERCATOR ? 2 * PI / (double)map.width : angle / across;
    label = (uint32_t *)malloc(map.width * map.height * sizeof *label);
    position = (float *)malloc(3 * map.width * map.height * sizeof *position);
    normal = (float *)malloc(3 * map.width * map.height * sizeof *normal);
    memset(e, 0, sizeof *e);
    CHECK(good && label && position && normal);
    if (good && label && position && normal) {
        how.wraps = kind == RASTER_MERCATOR;
        raster_draw_chart(&t, &map, label, position, normal);
        if (draw(&d, label, map.width, map.height, position, normal, how)) compare(&d, &t, way, 1, e);
        erase(&d);
    }
    raster_free(&t);
    free(label);
    free(position);
    free(normal);
}

/* --- the tables of docs/images.md --------------------------------------------------------------------------------- */

enum { SIZES = 4, SURFACES = 3 };
static const size_t size_of[SIZES] = {5, 10, 20, 60};
static const double sphere[3] = {1, 1, 1}, ellipsoid[3] = {2, 1, 0.8};
static const uint64_t seed_of_tables = 20261129;
static const double bent = 0.4;

/* rms of mu_2, mu_4, mu_6; bias of mu_6; rms of L and area. */
static void print_errors(const errors *e)
{
    printf(" %.3f %.3f %.3f %+.3f %.3f %.3f |", e->rms[2], e->rms[4], e->rms[6], e->bias[6], e->length, e->area);
}

/* A row for every tissue, with a column for every way. */
static void print_tables(uint64_t seed)
{
    errors e;
    size_t k;
    int way, curved;
    for (curved = 0; curved < 2; ++curved)
        for (k = 0; k < SIZES; ++k) {
            printf("| %s | %lu |", curved ? "curved" : "straight", (unsigned long)size_of[k]);
            for (way = 0; way < WAYS; ++way) {
                errors_in_plane(curved ? bent : 0, size_of[k], seed, (enum way)way, &e);
                print_errors(&e);
            }
            putchar('\n');
        }
    for (k = 0; k < 2 * SURFACES; ++k) {
        const double *axis = k < SURFACES ? sphere : ellipsoid;
        enum raster_chart kind = k % SURFACES == 2 ? RASTER_STEREOGRAPHIC : RASTER_MERCATOR;
        double across = k % SURFACES == 1 ? 20 : 10;
        printf("| %s, %s | %.0f |", k < SURFACES ? "sphere" : "ellipsoid",
               kind == RASTER_MERCATOR ? "Mercator" : "stereographic", across);
        for (way = 0; way < WAYS; ++way) {
            errors_on_chart(axis, kind, across, seed, (enum way)way, &e);
            print_errors(&e);
        }
        putchar('\n');
    }
}

/* --- how exactly it draws ----------------------------------------------------------------------------------------- */

/* Limits of what a tissue that was not looked at may have: 1.2 times the worst of six others. */
typedef struct limit {
    enum way way;
    double bend;        /* in the plane; < 0: on a chart */
    const double *axis; /* of the surface */
    int kind;           /* of chart */
    size_t across;      /* pixels */
    double mu_2, mu_4, mu_6, bias_6, length, area;
} limit;

#define PLANE_STRAIGHT 0.0, NULL, 0
#define PLANE_CURVED   0.4, NULL, 0
#define ON(surface)    -1.0, surface, RASTER_MERCATOR
#define SEEN(surface)  -1.0, surface, RASTER_STEREOGRAPHIC

static const limit limits[] = {{JUNCTIONS, PLANE_STRAIGHT, 5, .078, .178, .22, .04, .046, .092},
                               {CURVE, PLANE_STRAIGHT, 5, .078, .176, .22, .05, .046, .084},
                               {JUNCTIONS, PLANE_STRAIGHT, 10, .032, .08, .095, .012, .02, .04},
                               {CURVE, PLANE_STRAIGHT, 10, .032, .078, .099, .027, .02, .027},
                               {JUNCTIONS, PLANE_STRAIGHT, 20, .015, .038, .049, .007, .01, .022},
                               {CURVE, PLANE_STRAIGHT, 20, .015, .037, .052, .019, .01, .01},
                               {JUNCTIONS, PLANE_STRAIGHT, 60, .005, .011, .0145, .002, .0036, .0072},
                               {CURVE, PLANE_STRAIGHT, 60, .005, .011, .0156, .005, .0036, .0024},
                               {CURVE, PLANE_CURVED, 5, .101, .24, .27, .155, .087, .086},
                               {CURVE, PLANE_CURVED, 10, .058, .122, .161, .066, .051, .068},
                               {CURVE, PLANE_CURVED, 20, .022, .051, .072, .026, .014, .01},
                               {CURVE, PLANE_CURVED, 60, .005, .011, .018, .004, .0036, .0024},
                               {JUNCTIONS, ON(sphere), 10, .028, .074, .084, .011, .017, .035},
                               {CURVE, ON(sphere), 10, .028, .074, .087, .03, .017, .022},
                               {CURVE, ON(sphere), 20, .014, .03, .041, .017, .0075, .0075},
                               {CURVE, SEEN(sphere), 10, .033, .081, .094, .048, .02, .03},
                               {CURVE, ON(ellipsoid), 10, .024, .062, .082, .02, .018, .022},
                               {CURVE, ON(ellipsoid), 20, .011, .027, .041, .01, .0085, .0075},
                               {CURVE, SEEN(ellipsoid), 10, .029, .068, .095, .027, .02, .03}};

THEOREM(errors_stay_within_their_limits_on_another_tissue)
{
    const uint64_t seed = 777;
    size_t k;
    errors e;
    for (k = 0; k < sizeof limits / sizeof *limits; ++k) {
        const limit *l = &limits[k];
        if (FEWER > 1 && (l->across > 10 || l->bend < 0)) continue;
        CASE("row %lu: way %d, %lu pixels across", (unsigned long)k, (int)l->way, (unsigned long)l->across);
        if (l->bend < 0)
            errors_on_chart(l->axis, (enum raster_chart)l->kind, (double)l->across, seed, l->way, &e);
        else
            errors_in_plane(l->bend, l->across, seed, l->way, &e);
        CHECK(e.cells > 70);
        CHECK(e.rms[2] <= l->mu_2);
        CHECK(e.rms[3] <= l->mu_4); /* the ranks between lie between */
        CHECK(e.rms[4] <= l->mu_4);
        CHECK(e.rms[5] <= l->mu_6);
        CHECK(e.rms[6] <= l->mu_6);
        CHECK(fabs(e.bias[6]) <= l->bias_6);
        CHECK(e.length <= l->length);
        CHECK(e.area <= l->area);
    }
}

/* The labels of a shape in the middle of an image: inside where r < radius at every angle. */
static void draw_shape(double radius, double stretch, int corners, double dx, double dy, double turn, measures *m)
{
    size_t size = (size_t)(2 * radius * stretch) + 8, row, column;
    uint32_t *label = (uint32_t *)calloc(size * size, sizeof *label);
    drawing d;
    for (row = 0; row < size; ++row)
        for (column = 0; column < size; ++column) {
            double x = (double)column - 0.5 * (double)size + dx, y = 0.5 * (double)size - (double)row + dy, most = 0;
            double u = x * cos(turn) + y * sin(turn), v = y * cos(turn) - x * sin(turn);
            int k;
            u /= stretch;
            if (corners == 0) most = hypot(u, v);
            for (k = 0; k < corners; ++k)
                most = fmax(most, (u * cos(2 * PI * k / corners) + v * sin(2 * PI * k / corners)) / cos(PI / corners));
            if (most < radius) label[row * size + column] = 7;
        }
    if (draw(&d, label, size, size, NULL, NULL, settings_of(CURVE))) {
        CHECK_EQUAL(d.map.count, 2);
        CHECK(is_drawn(&d, 1));
        outline_of(&d, 1, &got_outline);
        measure_plane(got_outline.corner, got_outline.n, m);
        CHECK_OK(m->status);
    }
    erase(&d);
    free(label);
}

THEOREM(discs_are_round_and_ellipses_what_they_are)
{
    enum { PLACES = 200 };
    static const double radius[3] = {8, 20, 60}, mu_4[3] = {.08, .023, .0045}, mu_6[3] = {.12, .05, .0095};
    static const double length[3] = {.02, .005, .001}, area[3] = {.04, .01, .003}; /* a disc has so many pixels */
    measures m, exact;
    size_t k, i;
    int p;
    for (k = 0; k < 3; ++k) {
        double square[RANKS + 1] = {0, 0, 0, 0, 0, 0, 0}, off;
        chance c = {5};
        CASE("radius %g", radius[k]);
        for (i = 0; i < 1000; ++i) {
            want_outline.corner[2 * i] = 2 * radius[k] * cos(2 * PI * (double)i / 1000);
            want_outline.corner[2 * i + 1] = radius[k] * sin(2 * PI * (double)i / 1000);
        }
        measure_plane(want_outline.corner, 1000, &exact);
        for (i = 0; i < PLACES; ++i) {
            double x = between(&c, 0, 1), y = between(&c, 0, 1);
            draw_shape(radius[k], 1, 0, x, y, 0, &m);
            for (p = 2; p <= RANKS; ++p) square[p] += m.mu[p] * m.mu[p] / PLACES;
            CHECK_CLOSE(m.length, 2 * PI * radius[k], length[k]);
            CHECK_CLOSE(m.area, PI * radius[k] * radius[k], area[k]);
            draw_shape(radius[k], 2, 0, x, y, between(&c, 0, PI), &m);
            off = m.mu[2] - exact.mu[2];
            CHECK(fabs(off) < mu_4[k] / 2);
            CHECK_NEAR(m.mu[4], exact.mu[4], 2 * mu_4[k]);
            CHECK_CLOSE(m.area, 2 * PI * radius[k] * radius[k], area[k]);
        }
        for (p = 2; p <= RANKS; ++p) CHECK(sqrt(square[p]) < (p < 5 ? mu_4[k] : mu_6[k]));
    }
}

/* A closed chain, done again from the staircase: K = n / 16 passes, from 8 to 64 but n / 4 at most; then as many of
   what they have taken away. */
THEOREM(a_closed_curve_is_smoothed_and_given_back)
{
    enum { WIDE = 160 };
    static uint32_t label[WIDE * WIDE];
    static double rest[2 * MOST];
    double radius;
    for (radius = 0.6; radius < 75; radius *= 1.4) {
        drawing stairs, curve;
        size_t k, i, n, passes;
        for (k = 0; k < WIDE * WIDE; ++k)
            label[k] = hypot((double)(k % WIDE) - 80.2, (double)(k / WIDE) - 79.7) < radius;
        CASE("radius %g", radius);
        if (draw(&stairs, label, WIDE, WIDE, NULL, NULL, settings_of(STAIRCASE)) &&
            draw(&curve, label, WIDE, WIDE, NULL, NULL, settings_of(CURVE))) {
            outline_of(&stairs, 1, &want_outline);
            outline_of(&curve, 1, &got_outline);
            n = want_outline.n;
            CHECK_EQUAL(got_outline.n, n);
            for (k = 0; k < 2 * n; ++k)
                rest[k] = 0.5 * (want_outline.corner[k] + want_outline.corner[k + 2 < 2 * n ? k + 2 : k + 2 - 2 * n]);
            memcpy(want_outline.corner, rest, 2 * n * sizeof *rest);
            passes = n < 128 ? 8 : n > 1024 ? 64 : n / 16;
            if (passes > n / 4) passes = n / 4;
            surfmink_smooth(want_outline.corner, n, 2, passes);
            for (k = 0; k < 2 * n; ++k) rest[k] -= want_outline.corner[k];
            surfmink_smooth(rest, n, 2, passes);
            for (k = 0; k < n; ++k) {
                double best = HUGE_VAL, x = want_outline.corner[2 * k] + rest[2 * k];
                double y = want_outline.corner[2 * k + 1] + rest[2 * k + 1];
                for (i = 0; i < got_outline.n; ++i)
                    best = fmin(best, hypot(got_outline.corner[2 * i] - x, got_outline.corner[2 * i + 1] - y));
                CHECK_NEAR(best, 0, 1e-9);
            }
        }
        erase(&stairs);
        erase(&curve);
    }
}

/* docs/images.md says so: without junctions, corners are rounded off. */
THEOREM(an_isolated_polygon_loses_its_corners)
{
    measures m;
    draw_shape(8, 1, 6, 0.21, 0.37, 0.2, &m);
    CHECK(m.mu[6] > 0.35 && m.mu[6] < 0.75);
    draw_shape(60, 1, 6, 0.21, 0.37, 0.2, &m);
    CHECK(m.mu[6] > 0.75 && m.mu[6] < 0.99);
}

/* --- what does not change an outline ------------------------------------------------------------------------------ */

/* Noise, and each of its connected pieces a cell, those that touch only by a corner too: pixels meet in every way. */
static void noise(chance *c, uint32_t *label, size_t width, size_t height)
{
    size_t pixels = width * height, k, changed = 1;
    uint32_t *grey = (uint32_t *)malloc(pixels * sizeof *grey);
    for (k = 0; k < pixels; ++k) {
        grey[k] = one_in(c, 2) ? (uint32_t)one_of(c, 3) : k > 0 ? grey[k - 1] : 1;
        label[k] = grey[k] ? (uint32_t)k + 1 : 0;
    }
    while (changed) /* the largest number of a piece spreads over it */
        for (changed = 0, k = 0; k < pixels; ++k) {
            int dx, dy;
            for (dy = -1; dy <= 1; ++dy)
                for (dx = -1; dx <= 1; ++dx) {
                    int64_t y = (int64_t)(k / width) + dy, x = (int64_t)(k % width) + dx;
                    size_t other;
                    if (y < 0 || y >= (int64_t)height || x < 0 || x >= (int64_t)width) continue;
                    other = (size_t)y * width + (size_t)x;
                    if (grey[other] == grey[k] && label[other] > label[k]) {
                        label[k] = label[other];
                        changed = 1;
                    }
                }
        }
    free(grey);
}

/* A Voronoi tissue with seeds by chance; with lines, those pixels are 0 that have a larger label at their side. */
static void small_tissue(chance *c, uint32_t *label, size_t width, size_t height, size_t cells, int lines)
{
    double seed[64][2];
    size_t k, row, column;
    for (k = 0; k < cells; ++k) {
        seed[k][0] = between(c, 0, (double)width);
        seed[k][1] = between(c, 0, (double)height);
    }
    for (row = 0; row < height; ++row)
        for (column = 0; column < width; ++column) {
            double best = HUGE_VAL;
            for (k = 0; k < cells; ++k) {
                double d = hypot(seed[k][0] - (double)column, seed[k][1] - (double)row);
                if (d < best) {
                    best = d;
                    label[row * width + column] = (uint32_t)k + 1;
                }
            }
        }
    for (row = 0; row < height && lines; ++row)
        for (column = 0; column < width; ++column) {
            uint32_t *at = label + row * width + column;
            if ((column + 1 < width && at[1] > *at) || (row + 1 < height && at[width] > *at)) *at = 0;
        }
}

/* Turned and mirrored: bit 2 swaps rows and columns, bits 0 and 1 count them from the other end. */
static void turn_point(int how, size_t width, size_t height, const double xy[2], double out[2])
{
    double column = how & 4 ? -xy[1] : xy[0], row = how & 4 ? xy[0] : -xy[1];
    double w = (double)(how & 4 ? height : width), h = (double)(how & 4 ? width : height);
    out[0] = how & 1 ? w - 1 - column : column;
    out[1] = -(how & 2 ? h - 1 - row : row);
}

static void turn_image(int how, size_t width, size_t height, const uint32_t *label, uint32_t *out)
{
    size_t row, column;
    double xy[2], to[2];
    for (row = 0; row < height; ++row)
        for (column = 0; column < width; ++column) {
            xy[0] = (double)column;
            xy[1] = -(double)row;
            turn_point(how, width, height, xy, to);
            out[(size_t)-to[1] * (how & 4 ? height : width) + (size_t)to[0]] = label[row * width + column];
        }
}

/* Is every corner of a, turned, one of b? */
static void check_turned(const outline *a, const outline *b, int how, size_t width, size_t height)
{
    size_t i, k;
    CHECK_EQUAL(a->n, b->n);
    for (i = 0; i < a->n; ++i) {
        double to[2], best = HUGE_VAL;
        turn_point(how, width, height, a->corner + 2 * i, to);
        for (k = 0; k < b->n; ++k) best = fmin(best, hypot(b->corner[2 * k] - to[0], b->corner[2 * k + 1] - to[1]));
        CHECK_NEAR(best, 0, 1e-9);
    }
}

THEOREM(outlines_turn_and_mirror_with_the_image)
{
    enum { WIDTH = 33, HEIGHT = 26 };
    static uint32_t label[WIDTH * HEIGHT], turned[WIDTH * HEIGHT];
    chance c = {4711};
    int round, how, drawn = 0;
    for (round = 0; round < 36; ++round) {
        settings s;
        memset(&s, 0, sizeof s);
        s.points = round % 3 == 0 ? FIT_CURVE : round % 3 == 1 ? FIT_JUNCTIONS : FIT_PIXELS;
        s.lines = round % 4 == 3;
        if (round % 2 == 0)
            noise(&c, label, WIDTH, HEIGHT);
        else
            small_tissue(&c, label, WIDTH, HEIGHT, 20, s.lines);
        for (how = 1; how < 8; ++how) {
            drawing a, b;
            size_t k;
            CASE("image %d, turned %d", round, how);
            turn_image(how, WIDTH, HEIGHT, label, turned);
            if (draw(&a, label, WIDTH, HEIGHT, NULL, NULL, s) &&
                draw(&b, turned, how & 4 ? HEIGHT : WIDTH, how & 4 ? WIDTH : HEIGHT, NULL, NULL, s)) {
                CHECK_EQUAL(a.map.count, b.map.count);
                for (k = 1; k < a.map.count && k < b.map.count; ++k) {
                    CHECK_EQUAL(a.map.flag[k], b.map.flag[k]);
                    if (!is_drawn(&a, k) || !is_drawn(&b, k)) continue;
                    ++drawn;
                    outline_of(&a, k, &got_outline);
                    outline_of(&b, k, &want_outline);
                    check_turned(&got_outline, &want_outline, how, WIDTH, HEIGHT);
                }
            }
            erase(&a);
            erase(&b);
        }
    }
    CHECK(drawn > 2000);
}

THEOREM(the_staircase_has_the_area_of_the_pixels)
{
    enum { WIDTH = 40, HEIGHT = 30 };
    static uint32_t label[WIDTH * HEIGHT];
    chance c = {12};
    int round, drawn = 0;
    for (round = 0; round < 30; ++round) {
        drawing d;
        size_t k, i;
        settings s = settings_of(STAIRCASE);
        s.wraps = round % 2;
        noise(&c, label, WIDTH, HEIGHT);
        if (draw(&d, label, WIDTH, HEIGHT, NULL, NULL, s))
            for (k = 1; k < d.map.count; ++k) {
                double area = 0;
                CASE("image %d, cell %lu", round, (unsigned long)k);
                if (!is_drawn(&d, k) || (d.map.flag[k] & REGION_HOLES)) continue;
                outline_of(&d, k, &got_outline);
                for (i = 0; i < got_outline.n; ++i) {
                    const double *a = got_outline.corner + 2 * i;
                    const double *b = got_outline.corner + 2 * (i + 1 < got_outline.n ? i + 1 : 0);
                    area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
                    CHECK_NEAR(fabs(a[0] - b[0]) + fabs(a[1] - b[1]), 1, 0);
                }
                CHECK_NEAR(area, (double)d.map.pixels[k], 1e-9);
                ++drawn;
            }
        erase(&d);
    }
    CHECK(drawn > 300);
}

/* Is this half a part of the outline of the cell on its left, and not of one of its holes? */
static int is_on_outline(const drawing *d, uint32_t half)
{
    uint32_t region = trace_left(&d->graph, half), at = d->graph.outline[region];
    if (!is_drawn(d, region)) return 0;
    do {
        if (at == half) return 1;
        at = trace_next(&d->graph, at);
    } while (at != d->graph.outline[region]);
    return 0;
}

/* Every edge of a cell is an edge of its neighbour, the other way: the same two points, to the bit. */
THEOREM(neighbours_share_their_points)
{
    enum { WIDTH = 60, HEIGHT = 50, EDGES = 40000 };
    static uint32_t label[WIDTH * HEIGHT];
    static double edge[EDGES][4];
    chance c = {99};
    int round;
    for (round = 0; round < 8; ++round) {
        drawing d;
        size_t edges = 0, k, i, j, alone = 0, expected = 0;
        if (round < 4)
            small_tissue(&c, label, WIDTH, HEIGHT, 40, 0);
        else
            noise(&c, label, WIDTH, HEIGHT);
        CASE("image %d", round);
        if (draw(&d, label, WIDTH, HEIGHT, NULL, NULL, settings_of(round % 2 ? CURVE : STAIRCASE))) {
            for (k = 1; k < d.map.count; ++k) {
                if (!is_drawn(&d, k)) continue;
                outline_of(&d, k, &got_outline);
                for (i = 0; i < got_outline.n && edges < EDGES; ++i, ++edges) {
                    memcpy(edge[edges], got_outline.corner + 2 * i, 2 * sizeof **edge);
                    memcpy(edge[edges] + 2, got_outline.corner + 2 * (i + 1 < got_outline.n ? i + 1 : 0),
                           2 * sizeof **edge);
                }
            }
            for (i = 0; i < edges; ++i) {
                int back = 0, again = 0;
                for (j = 0; j < edges; ++j) {
                    back += memcmp(edge[i], edge[j] + 2, 2 * sizeof **edge) == 0 &&
                            memcmp(edge[i] + 2, edge[j], 2 * sizeof **edge) == 0;
                    again += memcmp(edge[i], edge[j], sizeof edge[i]) == 0;
                }
                CHECK_EQUAL(again, 1);
                CHECK(back <= 1);
                if (back == 0) ++alone;
            }
            for (k = 0; k < 2 * d.graph.chain_count; ++k) {
                const chain *h = &d.graph.chains[k / 2];
                size_t own = round % 2 && h->from != TRACE_NONE ? h->cracks + 1 : h->cracks;
                if (is_on_outline(&d, (uint32_t)k) && !is_on_outline(&d, (uint32_t)k ^ 1)) expected += own;
            }
            CHECK_EQUAL(alone, expected);
            CHECK(edges > 100 && edges < EDGES);
        }
        erase(&d);
    }
}

/* --- charts ------------------------------------------------------------------------------------------------------- */

enum { CHART_WIDTH = 48, CHART_HEIGHT = 40, CHART_PIXELS = CHART_WIDTH * CHART_HEIGHT };
static uint32_t chart_label[CHART_PIXELS];
static float chart_position[3 * CHART_PIXELS], chart_normal[3 * CHART_PIXELS];

/* A tilted plane in space: every coordinate is a linear function of column and row, in numbers that floats hold. */
static void tilted_chart(uint64_t seed)
{
    chance c = {0};
    size_t k;
    c.state = seed;
    small_tissue(&c, chart_label, CHART_WIDTH, CHART_HEIGHT, 30, 0);
    for (k = 0; k < CHART_PIXELS; ++k) {
        double x = (double)(k % CHART_WIDTH), y = -(double)(k / CHART_WIDTH);
        chart_position[k] = (float)(0.75 * x + 10);
        chart_position[CHART_PIXELS + k] = (float)(0.5 * y - 3);
        chart_position[2 * CHART_PIXELS + k] = (float)(0.25 * x - 0.125 * y);
        chart_normal[k] = -0.125f; /* (.75, 0, .25) x (0, .5, -.125) = (-.125, .09375, .375) */
        chart_normal[CHART_PIXELS + k] = 0.09375f;
        chart_normal[2 * CHART_PIXELS + k] = 0.375f;
    }
}

/* Compares what two drawings of the same tissue measure. */
static void check_same_measures(drawing *a, drawing *b, double within)
{
    size_t k, p, drawn = 0;
    measures got, want;
    for (k = 1; k < a->map.count; ++k) {
        CHECK_EQUAL(a->map.flag[k], b->map.flag[k]);
        if (!is_drawn(a, k) || !is_drawn(b, k)) continue;
        outline_of(a, k, &got_outline);
        measure_space(got_outline.corner, got_outline.normal, got_outline.n, &got);
        outline_of(b, k, &got_outline);
        measure_space(got_outline.corner, got_outline.normal, got_outline.n, &want);
        CHECK_OK(got.status);
        CHECK_OK(want.status);
        for (p = 1; p <= RANKS; ++p) CHECK_NEAR(got.mu[p], want.mu[p], within);
        CHECK_CLOSE(got.length, want.length, within);
        CHECK_CLOSE(got.area, want.area, within);
        ++drawn;
    }
    CHECK(drawn > 5);
}

THEOREM(on_a_tilted_plane_an_outline_is_the_flat_one_tilted)
{
    drawing flat, tilted;
    size_t k, i;
    int way, drawn = 0;
    tilted_chart(5);
    for (way = 0; way < WAYS; ++way) {
        if (draw(&flat, chart_label, CHART_WIDTH, CHART_HEIGHT, NULL, NULL, settings_of((enum way)way)) &&
            draw(&tilted, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, chart_normal,
                 settings_of((enum way)way)))
            for (k = 1; k < flat.map.count; ++k) {
                CHECK_EQUAL(flat.map.flag[k], tilted.map.flag[k]);
                if (!is_drawn(&flat, k) || !is_drawn(&tilted, k)) continue;
                outline_of(&flat, k, &got_outline);
                outline_of(&tilted, k, &want_outline);
                CHECK_EQUAL(got_outline.n, want_outline.n);
                for (i = 0; i < got_outline.n; ++i) {
                    double x = got_outline.corner[2 * i], y = got_outline.corner[2 * i + 1];
                    CHECK_NEAR(want_outline.corner[3 * i], 0.75 * x + 10, 1e-12);
                    CHECK_NEAR(want_outline.corner[3 * i + 1], 0.5 * y - 3, 1e-12);
                    CHECK_NEAR(want_outline.corner[3 * i + 2], 0.25 * x - 0.125 * y, 1e-12);
                    CHECK_NEAR(want_outline.normal[3 * i + 2], 0.375 / hypot(hypot(0.125, 0.09375), 0.375), 1e-12);
                }
                ++drawn;
            }
        erase(&flat);
        erase(&tilted);
    }
    CHECK(drawn > 30);
}

/* A cap of a sphere instead, so that normals differ. */
static void round_chart(uint64_t seed)
{
    size_t k, c;
    tilted_chart(seed);
    for (k = 0; k < CHART_PIXELS; ++k) {
        double x = ((double)(k % CHART_WIDTH) - 23.5) / 40, y = (19.5 - (double)(k / CHART_WIDTH)) / 40, n[3], z;
        z = 1 / sqrt(1 + x * x + y * y);
        n[0] = x * z;
        n[1] = y * z;
        n[2] = z;
        for (c = 0; c < 3; ++c) {
            chart_position[c * CHART_PIXELS + k] = (float)(50 * n[c]);
            chart_normal[c * CHART_PIXELS + k] = (float)n[c];
        }
    }
}

THEOREM(normals_may_be_long_inward_or_made_from_the_positions)
{
    static float other[3 * CHART_PIXELS];
    drawing a, b;
    settings how = settings_of(CURVE);
    size_t k, c;
    chance by = {8};
    round_chart(6);
    for (k = 0; k < CHART_PIXELS; ++k) {
        float length = (float)magnitude(&by, 1e-20, 1e20);
        for (c = 0; c < 3; ++c) other[c * CHART_PIXELS + k] = chart_normal[c * CHART_PIXELS + k] * length;
    }
    if (draw(&a, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, chart_normal, how) &&
        draw(&b, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, other, how))
        check_same_measures(&a, &b, 1e-6); /* floats */
    erase(&b);
    for (k = 0; k < 3 * CHART_PIXELS; ++k) other[k] = -chart_normal[k];
    if (draw(&b, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, other, how)) check_same_measures(&a, &b, 1e-9);
    outline_of(&a, 9, &got_outline);
    erase(&b);
    how.flips = 1;
    if (draw(&b, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, other, how)) {
        for (k = 1; k < a.map.count; ++k) {
            if (!is_drawn(&a, k)) continue;
            outline_of(&a, k, &got_outline);
            outline_of(&b, k, &want_outline);
            CHECK_SAME(want_outline.corner, got_outline.corner, 3 * got_outline.n);
            CHECK_SAME(want_outline.normal, got_outline.normal, 3 * got_outline.n);
        }
    }
    erase(&b);
    how.flips = 0;
    if (draw(&b, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, NULL, how)) check_same_measures(&a, &b, 2e-3);
    erase(&b);
    erase(&a);
}

THEOREM(a_mirrored_chart_draws_the_same_cells)
{
    static uint32_t label[CHART_PIXELS];
    static float position[3 * CHART_PIXELS], normal[3 * CHART_PIXELS];
    drawing a, b;
    size_t k, c;
    round_chart(7);
    for (k = 0; k < CHART_PIXELS; ++k) {
        size_t to = k / CHART_WIDTH * CHART_WIDTH + CHART_WIDTH - 1 - k % CHART_WIDTH;
        label[to] = chart_label[k];
        for (c = 0; c < 3; ++c) {
            position[c * CHART_PIXELS + to] = chart_position[c * CHART_PIXELS + k];
            normal[c * CHART_PIXELS + to] = chart_normal[c * CHART_PIXELS + k];
        }
    }
    if (draw(&a, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, chart_normal, settings_of(CURVE)) &&
        draw(&b, label, CHART_WIDTH, CHART_HEIGHT, position, normal, settings_of(CURVE)))
        check_same_measures(&a, &b, 1e-9);
    for (k = 1; k < a.map.count; ++k)
        if (is_drawn(&a, k)) CHECK_EQUAL(a.out.is_mirrored[k] + b.out.is_mirrored[k], 1);
    erase(&a);
    erase(&b);
}

/* Cells over columns from..to are left out with the flag, all others as before. */
static void check_flagged(drawing *a, drawing *b, size_t from, size_t to, int flag)
{
    size_t k, pixel, hit = 0;
    for (k = 1; k < a->map.count; ++k) {
        int inside = 0, near_it = 0;
        if (!is_drawn(a, k)) continue;
        for (pixel = 0; pixel < CHART_PIXELS; ++pixel) {
            size_t column = pixel % CHART_WIDTH;
            if (a->map.of[pixel] != k) continue;
            if (column >= from && column <= to) inside = 1;
            if (column + 3 >= from && column <= to + 3) near_it = 1;
        }
        if (inside) CHECK(b->map.flag[k] & flag);
        if (inside) ++hit;
        if (!near_it) CHECK_EQUAL(b->map.flag[k], a->map.flag[k]);
    }
    CHECK(hit > 2);
}

THEOREM(cells_at_the_rim_or_on_a_fold_of_the_chart_are_left_out)
{
    static float position[3 * CHART_PIXELS], normal[3 * CHART_PIXELS];
    drawing a, b;
    settings how = settings_of(CURVE);
    size_t k, c;
    int fault;
    round_chart(31);
    if (!draw(&a, chart_label, CHART_WIDTH, CHART_HEIGHT, chart_position, chart_normal, how)) return;
    for (fault = 0; fault < 5; ++fault) {
        const size_t from = 20, to = 26;
        CASE("fault %d", fault);
        memcpy(position, chart_position, sizeof position);
        memcpy(normal, chart_normal, sizeof normal);
        for (k = 0; k < CHART_PIXELS; ++k) {
            size_t column = k % CHART_WIDTH;
            if (column < from || column > to) continue;
            for (c = 0; c < 3; ++c) {
                size_t at = c * CHART_PIXELS + k;
                if (fault == 0) position[at] = (float)NAN;                         /* no position */
                if (fault == 1) normal[at] = 0;                                    /* no normal */
                if (fault == 2) position[at] = chart_position[at - column + from]; /* smeared beyond a rim */
                if (fault == 3) position[at] = chart_position[at - column + from + to - column]; /* folded back */
                if (fault == 4) normal[at] = -normal[at];
            }
        }
        if (draw(&b, chart_label, CHART_WIDTH, CHART_HEIGHT, position, normal, how))
            check_flagged(&a, &b, from, to, fault < 2 ? REGION_RIM : REGION_FOLD);
        erase(&b);
    }
    erase(&a);
}

/* A cell that goes round more than half of a cylinder: the chart shows the same side of it throughout. */
THEOREM(a_cell_that_turns_by_more_than_half_is_left_out)
{
    static uint32_t label[CHART_PIXELS];
    size_t k;
    double degrees;
    for (degrees = 120; degrees <= 300; degrees += 180) {
        drawing d;
        for (k = 0; k < CHART_PIXELS; ++k) {
            size_t row = k / CHART_WIDTH, column = k % CHART_WIDTH;
            double angle = degrees * PI / 180 * (double)column / CHART_WIDTH;
            label[k] = row > 9 && row < 30 && column > 1 && column < CHART_WIDTH - 2;
            chart_position[k] = chart_normal[k] = (float)-cos(angle);
            chart_position[CHART_PIXELS + k] = -0.1f * (float)row;
            chart_normal[CHART_PIXELS + k] = 0;
            chart_position[2 * CHART_PIXELS + k] = chart_normal[2 * CHART_PIXELS + k] = (float)sin(angle);
        }
        CASE("%g degrees", degrees);
        if (draw(&d, label, CHART_WIDTH, CHART_HEIGHT, chart_position, chart_normal, settings_of(CURVE)))
            CHECK_EQUAL(d.map.flag[1], degrees > 180 ? REGION_FOLD : 0);
        erase(&d);
    }
}

/* A cap of a sphere, on a stereographic chart about its middle: counter-clockwise about the normals even where it is
   more than a hemisphere, so that its turns sum up to 2 pi cos(degrees). */
THEOREM(a_cell_larger_than_a_hemisphere_is_not_turned_round)
{
    enum { SIDE = 121, PIXELS = SIDE * SIDE };
    static uint32_t label[PIXELS];
    static float position[3 * PIXELS];
    static outline cap;
    static double length[MOST], turning[MOST];
    static const double degrees[4] = {60, 95, 120, 140};
    double sum;
    size_t k, i;
    int mirrored;
    for (k = 0; k < 4; ++k)
        for (mirrored = 0; mirrored < 2; ++mirrored) {
            drawing d;
            for (i = 0; i < PIXELS; ++i) {
                double x = ((double)(i % SIDE) - 60) / 15, y = (60 - (double)(i / SIDE)) / 15, size = 1 + x * x + y * y;
                position[i] = (float)((mirrored ? -2 : 2) * x / size);
                position[PIXELS + i] = (float)(2 * y / size);
                position[2 * PIXELS + i] = (float)((2 - size) / size);
                label[i] = (2 - size) / size > cos(degrees[k] * PI / 180);
            }
            CASE("%g degrees", degrees[k]);
            if (draw(&d, label, SIDE, SIDE, position, position, settings_of(CURVE)) && is_drawn(&d, 1)) {
                outline_of(&d, 1, &cap);
                CHECK_OK(surfmink_edges(IN_SPACE(cap.corner, cap.normal, cap.n), length, turning, NULL));
                for (sum = 0, i = 0; i < cap.n; ++i) sum += turning[i];
                CHECK_NEAR(sum, 2 * PI * cos(degrees[k] * PI / 180), 0.05);
            }
            CHECK(is_drawn(&d, 1));
            erase(&d);
        }
}

/* All points of a chain in one place: two cells lose as many corners, and keep the others. */
THEOREM(corners_at_one_place_are_welded)
{
    drawing d;
    image_error error;
    size_t k, i, before[2], cell[2];
    tilted_chart(3);
    if (draw(&d, chart_label, CHART_WIDTH, CHART_HEIGHT, NULL, NULL, settings_of(CURVE))) {
        const chain *c = d.graph.chains;
        while (c->cracks < 4 || !is_drawn(&d, c->left) || !is_drawn(&d, c->right)) ++c;
        cell[0] = c->left;
        cell[1] = c->right;
        for (k = 0; k < 2; ++k) {
            outline_of(&d, cell[k], &got_outline);
            before[k] = got_outline.n;
        }
        for (k = 0; k < c->cracks; ++k)
            for (i = 0; i < 2; ++i)
                d.points.xy[2 * (d.graph.junction_count + c->first + k) + i] =
                    d.points.xy[2 * (d.graph.junction_count + c->first) + i] + 1e-9 * (double)k;
        free(d.out.is_mirrored);
        d.out.welds = 1;
        CHECK(outlines_make(&d.out, &error));
        for (k = 0; k < 2; ++k) {
            outline_of(&d, cell[k], &got_outline);
            CHECK_EQUAL(got_outline.n, before[k] - (c->cracks - 1));
        }
    }
    erase(&d);
}

/* --- decisions ---------------------------------------------------------------------------------------------------- */

/* A picture in letters: '.' is 0. Returns the flags of the cell with this letter, -1 if it is not there. */
static int flags_in(const char *picture, char letter, settings how, size_t *corners)
{
    uint32_t label[400];
    size_t width = strcspn(picture, "\n"), height = 0, count = 0, region;
    drawing d;
    int flags = -1;
    for (; *picture; ++picture) {
        if (*picture == '\n')
            ++height;
        else
            label[count++] = *picture == '.' ? 0 : (uint32_t)*picture;
    }
    CHECK_EQUAL(count, width * height);
    if (draw(&d, label, width, height, NULL, NULL, how)) {
        region = region_of(&d, letter);
        if (region > 0) flags = d.map.flag[region] & ~REGION_SMALL;
        if (corners) *corners = 0;
        if (corners && is_drawn(&d, region)) {
            outline_of(&d, region, &got_outline);
            *corners = got_outline.n;
        }
    }
    erase(&d);
    return flags;
}

THEOREM(what_is_left_out_is_left_out_by_name)
{
    settings curve = settings_of(CURVE), junctions = settings_of(JUNCTIONS), wrapped = settings_of(CURVE);
    size_t corners;
    wrapped.wraps = 1;
    CHECK_EQUAL(flags_in("....\n.aa.\n....\n", 'a', curve, &corners), 0);
    CHECK_EQUAL(corners, 6);
    CHECK_EQUAL(flags_in("....\n.aa.\n....\n", 'a', junctions, NULL), REGION_FEW);
    CHECK_EQUAL(flags_in("....\naaa.\n....\n", 'a', curve, NULL), REGION_BORDER);
    CHECK_EQUAL(flags_in(".....\n.aab.\n.aab.\n.....\n", 'a', junctions, NULL), REGION_FEW);
    CHECK_EQUAL(flags_in(".....\n.aab.\n.ccb.\n.....\n", 'a', junctions, &corners), 0);
    CHECK_EQUAL(corners, 3);
    CHECK_EQUAL(flags_in("......\n.abcd.\n.abcd.\n......\n", 'b', junctions, &corners), 0); /* neighbours of 0 */
    CHECK_EQUAL(corners, 4);
    CHECK_EQUAL(flags_in("......\n.aa.a.\n......\n", 'a', curve, NULL), REGION_PARTS);
    CHECK_EQUAL(flags_in(".....\n.a.a.\n..a..\n.....\n", 'a', curve, NULL), 0);     /* joined by corners */
    CHECK_EQUAL(flags_in("......\n.aba..\n.bab..\n......\n", 'b', curve, NULL), 0); /* the larger number is joined */
    CHECK_EQUAL(flags_in("......\n.ab...\n.ba...\n......\n", 'a', curve, NULL), REGION_PARTS);
    CHECK_EQUAL(flags_in(".....\n.aaa.\n.a.a.\n.aaa.\n.....\n", 'a', curve, &corners), REGION_HOLES);
    CHECK_EQUAL(corners, 12);
    CHECK_EQUAL(flags_in(".....\n.aaa.\n.aba.\n.aaa.\n.....\n", 'b', curve, &corners), 0);
    CHECK_EQUAL(corners, 4);
    CHECK_EQUAL(flags_in("......\n.aabb.\n.aabb.\n.ccdd.\n.ccdd.\n......\n", 'd', junctions, &corners), 0);
    CHECK_EQUAL(corners, 3); /* one of them is shared by four */
    CHECK_EQUAL(flags_in("....\naa.a\n....\n", 'a', curve, NULL), REGION_BORDER);
    CHECK_EQUAL(flags_in("....\naa.a\n....\n", 'a', wrapped, &corners), 0);
    CHECK_EQUAL(corners, 8);
    CHECK_EQUAL(flags_in("....\naaaa\n....\n", 'a', wrapped, NULL), REGION_WINDS);
    CHECK_EQUAL(flags_in("....\naaaa\n.aa.\n....\n", 'a', wrapped, NULL), REGION_WINDS);
    CHECK_EQUAL(flags_in("....\naaba\n....\n", 'b', wrapped, NULL), 0);
    CHECK_EQUAL(flags_in("....\naaaa\nbbbb\n....\n", 'b', wrapped, NULL), REGION_WINDS);
    curve.lines = 1;
    CHECK_EQUAL(flags_in("..........\n.aa....bb.\n.aa....bb.\n..........\n", 'a', curve, &corners), 0);
    CHECK(corners > 8); /* four pixels wide: shared out */
    CHECK_EQUAL(flags_in("...........\n.aa.....bb.\n.aa.....bb.\n...........\n", 'a', curve, &corners), 0);
    CHECK_EQUAL(corners, 8); /* five: background */
    curve.lines = 0;
    curve.background = 'b';
    CHECK_EQUAL(flags_in(".....\n.aab.\n.ccb.\n.....\n", 'b', curve, NULL), -1);
}

THEOREM(a_wrapped_image_has_no_seam)
{
    enum { WIDTH = 36, HEIGHT = 30 };
    static uint32_t label[WIDTH * HEIGHT], moved[WIDTH * HEIGHT];
    chance c = {321};
    int round, way, drawn = 0;
    for (round = 0; round < 12; ++round)
        for (way = 0; way < WAYS; ++way) {
            drawing a, b;
            size_t k, i, shift = 1 + one_of(&c, WIDTH - 1);
            settings how = settings_of((enum way)way);
            how.wraps = 1;
            how.lines = round % 3 == 2;
            if (round % 2)
                noise(&c, label, WIDTH, HEIGHT);
            else
                small_tissue(&c, label, WIDTH, HEIGHT, 25, how.lines);
            for (k = 0; k < WIDTH * HEIGHT; ++k) moved[k / WIDTH * WIDTH + (k % WIDTH + shift) % WIDTH] = label[k];
            CASE("image %d, way %d, moved by %lu", round, way, (unsigned long)shift);
            if (draw(&a, label, WIDTH, HEIGHT, NULL, NULL, how) && draw(&b, moved, WIDTH, HEIGHT, NULL, NULL, how))
                for (k = 1; k < a.map.count; ++k) {
                    CHECK_EQUAL(a.map.flag[k], b.map.flag[k]);
                    if (!is_drawn(&a, k) || !is_drawn(&b, k)) continue;
                    outline_of(&a, k, &got_outline);
                    outline_of(&b, k, &want_outline);
                    CHECK_EQUAL(got_outline.n, want_outline.n);
                    for (i = 0; i < got_outline.n; ++i) {
                        double best = HUGE_VAL;
                        size_t j;
                        for (j = 0; j < want_outline.n; ++j) {
                            double x = want_outline.corner[2 * j] - got_outline.corner[2 * i] - (double)shift;
                            double y = want_outline.corner[2 * j + 1] - got_outline.corner[2 * i + 1];
                            best = fmin(best, hypot(remainder(x, WIDTH), y));
                        }
                        CHECK_NEAR(best, 0, 1e-9);
                    }
                    ++drawn;
                }
            erase(&a);
            erase(&b);
        }
    CHECK(drawn > 300);
}

/* Lines along the exact sides of a tissue: pixels with their centre within half the width of the nearest side. */
THEOREM(lines_of_zeros_are_shared_out)
{
    enum { SIDE = 12, ACROSS = 20, SIZE = SIDE * ACROSS };
    static uint32_t label[SIZE * SIZE], lined[SIZE * SIZE];
    static const double area[4] = {.008, .012, .011, .012}, mu_6[4] = {.05, .05, .055, .075};
    raster t;
    drawing d;
    errors e;
    int wide;
    size_t row, column, k;
    settings how = settings_of(CURVE);
    CHECK(raster_plane(&t, SIDE, 0, 4242, 1) && raster_draw_plane(&t, ACROSS, label));
    how.lines = 1;
    for (wide = 0; wide <= 3; ++wide) {
        CASE("%d pixels wide", wide);
        for (row = 0; row < SIZE; ++row)
            for (column = 0; column < SIZE; ++column) {
                double x = ((double)column + 0.5) / ACROSS, y = SIDE - ((double)row + 0.5) / ACROSS, nearest = SIDE;
                const double *own = t.seed + 2 * (label[row * SIZE + column] - 1), *other = t.seed;
                for (k = 0; k < t.cells; ++k, other += 2) {
                    double a = other[0] - own[0], b = other[1] - own[1], to_side = hypot(a, b) / 2;
                    if (other == own) continue;
                    to_side -= ((x - own[0]) * a + (y - own[1]) * b) / hypot(a, b);
                    nearest = fmin(nearest, to_side);
                }
                lined[row * SIZE + column] = nearest * ACROSS < wide / 2.0 ? 0 : label[row * SIZE + column];
            }
        if (draw(&d, lined, SIZE, SIZE, NULL, NULL, how)) compare(&d, &t, CURVE, 1.0 / ACROSS, &e);
        erase(&d);
        CHECK(e.cells > 80);
        CHECK(e.area < area[wide]);
        CHECK(e.rms[6] < mu_6[wide]);
    }
    raster_free(&t);
}

/* --- files -------------------------------------------------------------------------------------------------------- */

enum { FILE_ROOM = 65536 };

/* A file under construction. */
typedef struct file_bytes {
    unsigned char byte[FILE_ROOM];
    size_t size;
    int is_big_endian;
} file_bytes;

static file_bytes made; /* too large for a stack */

static void put_integer(file_bytes *f, uint64_t value, size_t bytes)
{
    size_t k;
    CHECK(f->size + bytes <= FILE_ROOM);
    for (k = 0; k < bytes; ++k)
        f->byte[f->size++] = (unsigned char)(value >> (8 * (f->is_big_endian ? bytes - 1 - k : k)) & 255);
}

static void put_text(file_bytes *f, const char *text)
{
    size_t n = strlen(text);
    CHECK(f->size + n <= FILE_ROOM);
    memcpy(f->byte + f->size, text, n);
    f->size += n;
}

/* What the pixels of all files below hold. */
static double pixel_of(enum image_kind kind, size_t sample, size_t channel, size_t row, size_t column)
{
    double value = (double)((7 * row + 3 * column + 50 * channel) % 120);
    if (kind == IMAGE_SIGNED && (row + column) % 3 == 0) value = -value - 1;
    if (kind == IMAGE_FLOAT) value = value / 8 - 3;
    if (kind != IMAGE_FLOAT && sample > 1 && row == 1) value *= 100;
    return value;
}

static void put_pixel(file_bytes *f, enum image_kind kind, size_t sample, size_t channel, size_t row, size_t column)
{
    double value = pixel_of(kind, sample, channel, row, column);
    float single = (float)value;
    uint64_t bits = (uint64_t)(int64_t)value;
    uint32_t half;
    if (kind == IMAGE_FLOAT && sample == 8) memcpy(&bits, &value, sizeof bits);
    if (kind == IMAGE_FLOAT && sample == 4) {
        memcpy(&half, &single, sizeof half);
        bits = half;
    }
    put_integer(f, bits, sample);
}

/* The bytes as a file that has been loaded; what was asked for is counted from here. */
static int decode(const unsigned char *bytes, size_t size, image *im, image_error *error)
{
    memset(im, 0, sizeof *im);
    im->name = "made";
    im->bytes = (unsigned char *)malloc(size + 1); /* of exactly the size, for sanitizers: */
    im->bytes = (unsigned char *)realloc(im->bytes, size > 0 ? size : 1);
    memcpy(im->bytes, bytes, size);
    im->size = size;
    memory_asked = 0;
    return read__decode(im, error);
}

/* The file that was made decodes to the pixels that were put, and no shorter one decodes. */
static void check_file(enum image_kind kind, size_t sample, size_t channels, size_t width, size_t height, int cut)
{
    image im;
    image_error error;
    size_t row, column, channel, size;
    int good = decode(made.byte, made.size, &im, &error);
    if (!good) NOTE("%s", error.text);
    CHECK(good);
    if (good) {
        CHECK_EQUAL(im.width, width);
        CHECK_EQUAL(im.height, height);
        CHECK_EQUAL(im.channels, channels);
        for (channel = 0; channel < channels; ++channel)
            for (row = 0; row < height; ++row)
                for (column = 0; column < width; ++column)
                    CHECK_NEAR(image_value(&im, channel, row, column), pixel_of(kind, sample, channel, row, column), 0);
    }
    image_free(&im);
    for (size = 0; cut && size < made.size; ++size) {
        CASE("cut to %lu of %lu bytes", (unsigned long)size, (unsigned long)made.size);
        CHECK(!decode(made.byte, size, &im, &error));
        CHECK_EQUAL(memory_asked <= height * channels * sizeof *im.row, 1); /* that a strip is not there shows late */
        image_free(&im);
    }
    harness.which[0] = '\0';
}

/* --- TIFF --- */

enum layout { INTERLEAVED, PLANAR, PAGES };

/* Tags that are written otherwise: for files that are to be refused. */
typedef struct other_tag {
    unsigned tag;
    uint32_t value;
} other_tag;

static void put_tag(unsigned tag, unsigned type, uint32_t count, uint32_t value, const other_tag *other)
{
    size_t bytes = type == 3 && count == 1 ? 2 : 4;
    if (other && other->tag == tag) value = other->value;
    put_integer(&made, tag, 2);
    put_integer(&made, type, 2);
    put_integer(&made, count, 4);
    put_integer(&made, value, bytes);
    if (bytes == 2) put_integer(&made, 0, 2);
}

/* One directory, what it points to, and its strips; `more`: another directory follows. */
static void put_page(enum image_kind kind, size_t sample, size_t samples, size_t first, enum layout layout,
                     size_t width, size_t height, size_t strip_rows, int more, const other_tag *other)
{
    size_t planes = layout == PLANAR ? samples : 1, strips = (height + strip_rows - 1) / strip_rows * planes;
    size_t row_bytes = width * sample * (layout == INTERLEAVED ? samples : 1);
    size_t lists = made.size + 2 + 12 * 12 + 4, data, at, plane, row, column, channel, k;
    put_integer(&made, 12, 2);
    data = lists + 4 * 4 + 8 * strips;
    put_tag(256, 4, 1, (uint32_t)width, other);
    put_tag(257, 4, 1, (uint32_t)height, other);
    put_tag(258, 3, samples > 2 ? (uint32_t)samples : 1, samples > 2 ? (uint32_t)lists : 8 * (uint32_t)sample, other);
    put_tag(259, 3, 1, 1, other);
    put_tag(other && other->tag == 266 ? 266 : 262, 3, 1, 1, other);
    put_tag(270, 2, 4, 0, other);
    put_tag(273, 4, (uint32_t)strips, strips > 1 ? (uint32_t)(lists + 16) : (uint32_t)data, other);
    put_tag(277, 3, 1, (uint32_t)samples, other);
    put_tag(278, 4, 1, (uint32_t)strip_rows, other);
    put_tag(279, 4, (uint32_t)strips, strips > 1 ? (uint32_t)(lists + 16 + 4 * strips) : (uint32_t)(height * row_bytes),
            other);
    put_tag(284, 3, 1, layout == PLANAR ? 2 : 1, other);
    put_tag(other && other->tag > 284 && other->tag != 339 ? other->tag : 339, 3, 1,
            kind == IMAGE_FLOAT    ? 3
            : kind == IMAGE_SIGNED ? 2
                                   : 1,
            other);
    put_integer(&made, more ? data + height * row_bytes * planes : 0, 4);
    CHECK_EQUAL(made.size, lists);
    for (k = 0; k < 8; ++k) put_integer(&made, 8 * sample, 2); /* samples are 3 at most */
    for (k = 0, at = data; k < strips; ++k) {
        size_t begin = k % (strips / planes) * strip_rows;
        put_integer(&made, at, 4);
        at += (height - begin < strip_rows ? height - begin : strip_rows) * row_bytes;
    }
    for (k = 0; k < strips; ++k) {
        size_t begin = k % (strips / planes) * strip_rows;
        put_integer(&made, (height - begin < strip_rows ? height - begin : strip_rows) * row_bytes, 4);
    }
    CHECK_EQUAL(made.size, data);
    for (plane = 0; plane < planes; ++plane)
        for (row = 0; row < height; ++row)
            for (column = 0; column < width; ++column)
                for (channel = 0; channel < (layout == INTERLEAVED ? samples : 1); ++channel)
                    put_pixel(&made, kind, sample, first + plane + channel, row, column);
}

static void make_tiff(enum image_kind kind, size_t sample, size_t channels, enum layout layout, size_t width,
                      size_t height, size_t strip_rows, const other_tag *other)
{
    size_t k;
    made.size = 0;
    put_text(&made, made.is_big_endian ? "MM" : "II");
    put_integer(&made, 42, 2);
    put_integer(&made, 8, 4);
    for (k = 0; k < (layout == PAGES ? channels : 1); ++k)
        put_page(kind, sample, layout == PAGES ? 1 : channels, k, layout, width, height, strip_rows,
                 layout == PAGES && k + 1 < channels, other);
}

static const struct {
    enum image_kind kind;
    size_t sample;
    const char *npy;
} types[] = {{IMAGE_UNSIGNED, 1, "u1"}, {IMAGE_UNSIGNED, 2, "u2"}, {IMAGE_UNSIGNED, 4, "u4"}, {IMAGE_UNSIGNED, 8, "u8"},
             {IMAGE_SIGNED, 1, "i1"},   {IMAGE_SIGNED, 2, "i2"},   {IMAGE_SIGNED, 4, "i4"},   {IMAGE_SIGNED, 8, "i8"},
             {IMAGE_FLOAT, 4, "f4"},    {IMAGE_FLOAT, 8, "f8"}};
enum { TYPES = sizeof types / sizeof *types };

THEOREM(tiff_of_every_type_layout_and_byte_order_is_read)
{
    size_t k, strip;
    int layout;
    for (made.is_big_endian = 0; made.is_big_endian < 2; ++made.is_big_endian)
        for (k = 0; k < TYPES; ++k)
            for (strip = 1; strip <= 5; strip += 2)
                for (layout = -1; layout <= PAGES; ++layout) { /* -1: one channel */
                    size_t channels = layout < 0 ? 1 : 3;
                    make_tiff(types[k].kind, types[k].sample, channels, layout < 0 ? INTERLEAVED : (enum layout)layout,
                              7, 5, strip, NULL);
                    check_file(types[k].kind, types[k].sample, channels, 7, 5, k % 3 == 0);
                }
}

/* --- NPY --- */

static void make_npy(int version, const char *header, enum image_kind kind, size_t sample, size_t channels,
                     int is_interleaved, size_t width, size_t height)
{
    size_t row, column, channel, length = strlen(header) + 1;
    int order = made.is_big_endian;
    made.size = 0;
    put_text(&made, "\x93NUMPY");
    put_integer(&made, (uint64_t)version, 1);
    put_integer(&made, 0, 1);
    made.is_big_endian = 0;
    put_integer(&made, length, version == 1 ? 2 : 4);
    made.is_big_endian = order;
    put_text(&made, header);
    put_text(&made, "\n");
    for (channel = 0; channel < (is_interleaved ? 1 : channels); ++channel)
        for (row = 0; row < height; ++row)
            for (column = 0; column < width; ++column)
                if (is_interleaved)
                    for (channel = 0; channel < channels; ++channel)
                        put_pixel(&made, kind, sample, channel, row, column);
                else
                    put_pixel(&made, kind, sample, channel, row, column);
}

THEOREM(npy_of_every_type_shape_and_byte_order_is_read)
{
    static const char *const format[4] = {"{'descr': '%c%s', 'fortran_order': False, 'shape': (5, 7), }",
                                          "{\"shape\":(5,7,3),\"descr\":\"%c%s\",\"fortran_order\":False}",
                                          "{'descr': '%c%s', 'fortran_order': False, 'shape': (3, 5, 7), }      ",
                                          "{ 'fortran_order' : False , 'shape' : ( 5 , 7 , ) ,'descr': '%c%s' }"};
    char header[200];
    size_t k, shape;
    int version;
    for (made.is_big_endian = 0; made.is_big_endian < 2; ++made.is_big_endian)
        for (k = 0; k < TYPES; ++k)
            for (version = 1; version <= 2; ++version)
                for (shape = 0; shape < 4; ++shape) {
                    size_t channels = shape == 1 || shape == 2 ? 3 : 1;
                    char order = types[k].sample == 1 ? '|' : made.is_big_endian ? '>' : '<';
                    snprintf(header, sizeof header, format[shape], order, types[k].npy);
                    make_npy(version, header, types[k].kind, types[k].sample, channels, shape == 1, 7, 5);
                    check_file(types[k].kind, types[k].sample, channels, 7, 5, k % 3 == 0);
                }
}

/* --- PGM --- */

static void make_pgm(const char *head, size_t sample, int is_text)
{
    size_t row, column;
    char number[16];
    made.size = 0;
    made.is_big_endian = 1;
    put_text(&made, head);
    for (row = 0; row < 5; ++row)
        for (column = 0; column < 7; ++column) {
            snprintf(number, sizeof number, "%.0f%s", pixel_of(IMAGE_UNSIGNED, sample, 0, row, column),
                     row == 4 && column == 6 ? ""
                     : column == 6           ? " # row\n"
                                             : " ");
            if (is_text)
                put_text(&made, number);
            else
                put_pixel(&made, IMAGE_UNSIGNED, sample, 0, row, column);
        }
}

THEOREM(pgm_as_text_and_bytes_is_read)
{
    make_pgm("P5\n7 5\n255\n", 1, 0);
    check_file(IMAGE_UNSIGNED, 1, 1, 7, 5, 1);
    make_pgm("P5 # a comment\n 7\t5 # 9 9\n\n65535\n", 2, 0);
    check_file(IMAGE_UNSIGNED, 2, 1, 7, 5, 1);
    make_pgm("P2\n7 5\n255\n", 1, 1);
    put_text(&made, "\n");
    check_file(IMAGE_UNSIGNED, 1, 1, 7, 5, 0);
    make_pgm("P2 7 5 65535\n", 2, 1);
    check_file(IMAGE_UNSIGNED, 2, 1, 7, 5, 0); /* 90 and 9 cannot be told apart where the file ends */
}

/* --- what is refused --- */

static void check_refused(const char *why)
{
    image im;
    image_error error;
    int good = decode(made.byte, made.size, &im, &error);
    CASE("%s", why);
    CHECK(!good);
    if (!good && !strstr(error.text, why)) NOTE("%s", error.text);
    if (!good) CHECK(strstr(error.text, why) != NULL);
    CHECK_EQUAL(memory_asked, 0);
    image_free(&im);
}

THEOREM(what_cannot_be_read_is_refused_by_name)
{
    static const struct {
        other_tag other;
        const char *why;
    } tiff[] = {{{259, 5}, "a compressed TIFF (scheme 5); save it plainly"},
                {{322, 16}, "a tiled TIFF; save it plainly"},
                {{258, 1}, "numbers of 1 bits"},
                {{258, 12}, "numbers of 12 bits"},
                {{256, 0}, "without pixels"},
                {{256, 40000}, "truncated"},
                {{256, 4000000000u}, "2^30 or more"},
                {{257, 2000}, "truncated"},
                {{277, 0}, "without channels"},
                {{278, 0}, "strips of no rows"},
                {{273, 4000000}, "truncated"},
                {{279, 69}, "truncated"},
                {{339, 4}, "neither integers nor floats (format 4)"},
                {{339, 6}, "neither integers nor floats (format 6)"},
                {{266, 2}, "its bits in reverse order"}};
    static const struct {
        const char *header, *why;
    } npy[] = {{"{'descr': '<u2', 'fortran_order': True, 'shape': (5, 7), }", "Fortran order"},
               {"{'descr': '<c8', 'fortran_order': False, 'shape': (5, 7), }", "numbers of type '<c8'"},
               {"{'descr': '<f2', 'fortran_order': False, 'shape': (5, 7), }", "numbers of type '<f2'"},
               {"{'descr': '|O', 'fortran_order': False, 'shape': (5, 7), }", "numbers of type '|O'"},
               {"{'descr': [('a', '<u2')], 'fortran_order': False, 'shape': (5, 7), }", "records"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (35,), }", "an array of 1 axes"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (1, 1, 5, 7), }", "an array of 4 axes"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (5, 7, 4), }", "of three axes one has 3"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (5, 8), }", "truncated"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (5, 6), }", "more follows"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (99999999999, 99999999999), }", "2^30 or more"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (99999999999999999999999, 1), }", "malformed"},
               {"{'descr': '<u2', 'fortran_order': False, 'shape': (0, 7), }", "without pixels"},
               {"{'descr': '<u2', 'fortran_order': False}", "lacks"},
               {"{'descr': '<u2', 'fortran_order': 0, 'shape': (5, 7)}", "malformed"},
               {"('descr', '<u2')", "no dictionary"},
               {"{'descr': '<u2", "malformed"}};
    static const struct {
        const char *file, *why;
    } text[] = {{"P6\n1 1\n255\nabc", "a PPM"},
                {"P4\n8 1\na........", "a PBM"},
                {"P7\nWIDTH 1.....", "a PAM"},
                {"P2\n3 1\n7\n1 2      ", "truncated"},
                {"P2\n3 1\n7\n1 8 3    ", "pixel 1 is 8, above the maximum 7"},
                {"P2\n3 1\n7\n1 -2 3   ", "is not a number"},
                {"P2\n3 1\n7\n1 2.5 3  ", "is not a number"},
                {"P2\n3 1\n7\n1 2 3 4  ", "more follows"},
                {"P5\n3 1\n7\n\1\2\x08", "pixel 2 is 8, above"},
                {"P5\n3 1\n7\n\1\2\3\4\5", "more follows"},
                {"P5\n99999 99999\n255\nab", "2^30 or more"},
                {"P5\n999 999\n255\nab", "truncated"},
                {"P5\n3 1\n70000\nabcdef", "from 1 to 65535"},
                {"P5\n3 x\n7\nabcdef", "a PGM begins with"},
                {"\x89PNG\r\n\x1a\n....", "this is a PNG"},
                {"\xff\xd8\xff\xe0.......", "this is a JPEG"},
                {"PK\3\4..........", "this is an NPZ"},
                {"cell\tx\ty\n1\t2\t3\n", "no image that can be read"},
                {"II+\0", "no image"}};
    size_t k;
    for (made.is_big_endian = 0; made.is_big_endian < 2; ++made.is_big_endian)
        for (k = 0; k < sizeof tiff / sizeof *tiff; ++k) {
            make_tiff(IMAGE_UNSIGNED, 2, 1, INTERLEAVED, 7, 5, 5, &tiff[k].other);
            if (tiff[k].other.tag == 257) { /* the strip is not all there: found as the rows are laid */
                image im;
                image_error error;
                CHECK(!decode(made.byte, made.size, &im, &error));
                image_free(&im);
                continue;
            }
            if (tiff[k].other.tag == 273 || tiff[k].other.tag == 279) {
                image im;
                image_error error;
                CHECK(!decode(made.byte, made.size, &im, &error) && strstr(error.text, "strip 0"));
                image_free(&im);
                continue;
            }
            check_refused(tiff[k].why);
        }
    made.is_big_endian = 0;
    make_tiff(IMAGE_FLOAT, 2, 1, INTERLEAVED, 7, 5, 5, NULL);
    check_refused("floats of 16 bits");
    make_tiff(IMAGE_UNSIGNED, 2, 3, PAGES, 7, 5, 5, NULL);
    made.byte[2] = 43;
    check_refused("a BigTIFF");
    make_tiff(IMAGE_UNSIGNED, 2, 4, PAGES, 7, 5, 5, NULL);
    check_refused("more than 3 pages");
    make_tiff(IMAGE_UNSIGNED, 2, 1, INTERLEAVED, 7, 5, 5, NULL);
    made.byte[8 + 2 + 144] = 8; /* the next directory is this one */
    check_refused("in a loop");
    made.byte[8 + 2 + 144] = 200;
    check_refused("truncated");
    made.byte[4] = 3;
    check_refused("lies outside the file");
    for (k = 0; k < sizeof npy / sizeof *npy; ++k) {
        make_npy(1, npy[k].header, IMAGE_UNSIGNED, 2, 1, 0, 7, 5);
        check_refused(npy[k].why);
    }
    make_npy(3, npy[0].header, IMAGE_UNSIGNED, 2, 1, 0, 7, 5);
    check_refused("version 3");
    for (k = 0; k < sizeof text / sizeof *text; ++k) {
        made.size = 0;
        put_text(&made, text[k].file);
        check_refused(text[k].why);
    }
}

/* Whatever byte is changed: a refusal, or an image all of whose pixels can be read. */
THEOREM(no_changed_byte_does_harm)
{
    chance c = {2};
    int round, k, kind;
    for (round = 0; round < 20000 / FEWER; ++round) {
        image im;
        image_error error;
        size_t row, column, channel;
        double sum = 0;
        made.is_big_endian = round % 2;
        kind = round / 2 % 5;
        if (kind < 3)
            make_tiff(IMAGE_UNSIGNED, 1, 3, (enum layout)kind, 7, 5, 2, NULL);
        else if (kind == 3)
            make_npy(1, "{'descr': '|u1', 'fortran_order': False, 'shape': (5, 7), }", IMAGE_UNSIGNED, 1, 1, 0, 7, 5);
        else
            make_pgm("P2\n7 5\n255\n", 1, 1);
        for (k = 0; k < 3; ++k) {
            size_t at = one_of(&c, one_in(&c, 2) || made.size < 170 ? made.size : 170);
            made.byte[at] = (unsigned char)(one_in(&c, 2) ? chance_bits(&c) : made.byte[at] ^ (1u << one_of(&c, 8)));
        }
        if (decode(made.byte, made.size, &im, &error))
            for (channel = 0; channel < im.channels; ++channel)
                for (row = 0; row < im.height; ++row)
                    for (column = 0; column < im.width; ++column) sum += image_value(&im, channel, row, column);
        CHECK(!(sum < -1e300));
        image_free(&im);
    }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--table") == 0) {
        print_tables(argc > 2 ? (uint64_t)atol(argv[2]) : seed_of_tables);
        return harness.failures > 0;
    }
    PROVE(errors_stay_within_their_limits_on_another_tissue);
    PROVE(discs_are_round_and_ellipses_what_they_are);
    PROVE(a_closed_curve_is_smoothed_and_given_back);
    PROVE(an_isolated_polygon_loses_its_corners);
    PROVE(outlines_turn_and_mirror_with_the_image);
    PROVE(the_staircase_has_the_area_of_the_pixels);
    PROVE(neighbours_share_their_points);
    PROVE(on_a_tilted_plane_an_outline_is_the_flat_one_tilted);
    PROVE(normals_may_be_long_inward_or_made_from_the_positions);
    PROVE(a_mirrored_chart_draws_the_same_cells);
    PROVE(cells_at_the_rim_or_on_a_fold_of_the_chart_are_left_out);
    PROVE(a_cell_that_turns_by_more_than_half_is_left_out);
    PROVE(a_cell_larger_than_a_hemisphere_is_not_turned_round);
    PROVE(corners_at_one_place_are_welded);
    PROVE(what_is_left_out_is_left_out_by_name);
    PROVE(a_wrapped_image_has_no_seam);
    PROVE(lines_of_zeros_are_shared_out);
    PROVE(tiff_of_every_type_layout_and_byte_order_is_read);
    PROVE(npy_of_every_type_shape_and_byte_order_is_read);
    PROVE(pgm_as_text_and_bytes_is_read);
    PROVE(what_cannot_be_read_is_refused_by_name);
    PROVE(no_changed_byte_does_harm);
    return QED();
}
