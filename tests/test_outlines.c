/* The command outlines, from the inside: readers, boundaries, fitted points, charts. How exactly it draws is measured on
   tissues whose cells are known; `test_outlines --table` prints what docs/images.md shows, with another number behind it the same of
   another tissue. */
#ifndef SURFMINK_IMPLEMENTED
#define SURFMINK_IMPLEMENTATION
#endif
#include "surfmink.h"

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
    good = good && trace_regions(&d->graph, &d->map, &error) &&
           fit_points_of(&d->points, &d->graph, how.points, &error);
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
    m->status = surfmink_measure_plane(corner, n, RANKS, m->mu, NULL, &w, NULL);
    m->length = w.length;
    m->area = w.area;
}

/* The area is that of the triangles from the first corner, as seen along the mean normal: the same for both outlines
   that are compared. */
static void measure_space(const double *corner, const double *normal, size_t n, measures *m)
{
    surfmink_functionals w;
    double area[3] = {0, 0, 0}, mean[3] = {0, 0, 0}, a[3], b[3], twice[3];
    size_t k, c;
    m->status = surfmink_measure_embedded(corner, normal, n, RANKS, m->mu, NULL, &w, NULL);
    m->length = w.length;
    for (k = 0; k + 1 < n; ++k) {
        for (c = 0; c < 3; ++c) {
            a[c] = corner[3 * k + c] - corner[c];
            b[c] = corner[3 * k + 3 + c] - corner[c];
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

static void print_errors(const errors *e)
{
    printf(" %.3f %.3f %.3f | %+.3f | %.3f | %.3f |", e->rms[2], e->rms[4], e->rms[6], e->bias[6], e->length, e->area);
}

static void print_tables(uint64_t seed)
{
    static const char *const name[WAYS] = {"staircase, 4 passes", "junctions", "curve"};
    errors e;
    size_t k;
    int way, curved;
    for (curved = 0; curved < 2; ++curved)
        for (k = 0; k < SIZES; ++k)
            for (way = 0; way < WAYS; ++way) {
                errors_in_plane(curved ? bent : 0, size_of[k], seed, (enum way)way, &e);
                printf("| %s | %lu | %s |", curved ? "curved" : "straight", (unsigned long)size_of[k], name[way]);
                print_errors(&e);
                printf(" %lu |\n", (unsigned long)e.cells);
            }
    for (k = 0; k < 2 * SURFACES; ++k)
        for (way = 0; way < WAYS; ++way) {
            const double *axis = k < SURFACES ? sphere : ellipsoid;
            enum raster_chart kind = k % SURFACES == 2 ? RASTER_STEREOGRAPHIC : RASTER_MERCATOR;
            double across = k % SURFACES == 1 ? 20 : 10;
            errors_on_chart(axis, kind, across, seed, (enum way)way, &e);
            printf("| %s, %s | %.0f | %s |", k < SURFACES ? "sphere" : "ellipsoid",
                   kind == RASTER_MERCATOR ? "Mercator" : "stereographic", across, name[way]);
            print_errors(&e);
            printf(" %lu |\n", (unsigned long)e.cells);
        }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "--table") == 0) {
        print_tables(argc > 2 ? (uint64_t)atol(argv[2]) : seed_of_tables);
        return harness.failures > 0;
    }
    return QED();
}
