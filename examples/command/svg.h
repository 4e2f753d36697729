/* svg.h - step 5 of the command, if asked for: the shapes of a picture -> a file of Scalable Vector Graphics.

   Every number is printed with two decimals of a pixel, so the same input gives the same bytes. */
#ifndef SURFMINK_COMMAND_SVG_H
#define SURFMINK_COMMAND_SVG_H

#include "horizon.h"
#include "picture.h"
#include <errno.h>

enum {
    DRAWING_SIZE = 720,
    MARGIN = 20,
    BAR_GAP = 28,
    BAR_WIDTH = 14,
    BAR_SPACE = 110,
    BAR_HEIGHT = 240,
    BAR_LEAST = 330
};

typedef struct drawing {
    FILE *file;
    const options *options;
    camera camera;
    double least[2], most[2]; /* what is drawn, in view coordinates */
    double scale;             /* pixels per unit */
    double width, height;     /* pixels of the drawing without margins and colour bar */
    double shift;             /* pixels down, where the colour bar is taller than the drawing */
    double top, tick;         /* of the colour bar */
    int whole_sphere;
    horizon horizon;
    points ring;
} drawing;

/* --- colour ------------------------------------------------------------------------------------------------------- */

/* From indigo over teal to yellow: a path of constant speed through the colour space OKLab, lightness 0.30 to 0.92, hue
   285 to 102 degrees. Lightness alone orders the colours: it works for any colour vision, and printed in grey. */
static const int color_map[11][3] = {{43, 33, 97},    {23, 58, 123},   {0, 80, 128},   {1, 102, 131},
                                     {2, 126, 138},   {1, 150, 142},   {0, 171, 138},  {77, 189, 129},
                                     {142, 204, 122}, {196, 218, 126}, {243, 232, 144}};

static void put_color(FILE *file, double fraction)
{
    double place = 10 * fmin(1, fmax(0, fraction)), rest;
    int i = place < 10 ? (int)place : 9, k, part[3];
    rest = place - i;
    for (k = 0; k < 3; ++k) part[k] = (int)(color_map[i][k] + rest * (color_map[i + 1][k] - color_map[i][k]) + 0.5);
    fprintf(file, "#%02x%02x%02x", (unsigned)part[0], (unsigned)part[1], (unsigned)part[2]);
}

/* The colour bar ends at the first of these that no mu_p exceeds. */
static void choose_top(drawing *d, const picture *g)
{
    static const double top[][2] = {{.05, .01}, {.1, .02}, {.2, .05}, {.3, .1}, {.4, .1},
                                    {.5, .1},   {.6, .2},  {.8, .2},  {1, .2}};
    double most = 0;
    size_t i;
    for (i = 0; i < g->shapes; ++i)
        if (g->shape[i].mu > most) most = g->shape[i].mu;
    if (most <= 0) most = 1; /* nothing was measured */
    for (i = 0; i < 8 && most > top[i][0]; ++i) continue;
    d->top = top[i][0];
    d->tick = top[i][1];
}

/* --- numbers ------------------------------------------------------------------------------------------------------ */

/* Two decimals, without what can be left out, and never -0. */
static void put_pixels(FILE *file, double pixels)
{
    long hundredths = lround(100 * fmin(1e6, fmax(-1e6, pixels))); /* farther out nothing can be seen */
    long whole = labs(hundredths) / 100, part = labs(hundredths) % 100;
    if (hundredths < 0) fputc('-', file);
    fprintf(file, "%ld", whole);
    if (part % 10)
        fprintf(file, ".%02ld", part);
    else if (part)
        fprintf(file, ".%ld", part / 10);
}

static double pixel_x(const drawing *d, double x)
{
    return MARGIN + (x - d->least[0]) * d->scale;
}

static double pixel_y(const drawing *d, double y)
{
    return MARGIN + d->shift + (d->most[1] - y) * d->scale;
}

static void put_point(const drawing *d, char command, const double *view)
{
    fputc(command, d->file);
    put_pixels(d->file, pixel_x(d, view[0]));
    fputc(' ', d->file);
    put_pixels(d->file, pixel_y(d, view[1]));
}

/* Points that fall together in the picture are left out: coastlines have many. */
static void put_ring(const drawing *d, const points *ring)
{
    size_t i, last = 0;
    for (i = 0; i < ring->n; ++i) {
        const double *x = ring->x + 3 * i, *previous = ring->x + 3 * last;
        if (i > 0 && hypot(x[0] - previous[0], x[1] - previous[1]) * d->scale < 0.05) continue;
        put_point(d, i == 0 ? 'M' : 'L', x);
        last = i;
    }
    fputc('Z', d->file);
}

/* --- size --------------------------------------------------------------------------------------------------------- */

static void include_point(drawing *d, const double *view)
{
    size_t k;
    for (k = 0; k < 2; ++k) {
        d->least[k] = fmin(d->least[k], view[k]);
        d->most[k] = fmax(d->most[k], view[k]);
    }
}

/* The square from -1 to 1: a whole sphere, and what is shown where there is nothing to show. */
static double show_unit_square(drawing *d)
{
    size_t k;
    for (k = 0; k < 2; ++k) d->least[k] = -1, d->most[k] = 1;
    return 2;
}

/* A sphere is drawn whole unless the outlines cover so little of it that they could not be told apart. */
static void find_extent(drawing *d, const picture *g)
{
    double view[3], extent;
    size_t i, k;
    for (k = 0; k < 2; ++k) d->least[k] = HUGE_VAL, d->most[k] = -HUGE_VAL;
    for (i = 0; i < g->corners; ++i) {
        to_view(&d->camera, g->corner + 3 * i, view);
        if (g->surface != SPHERE || is_visible(view)) include_point(d, view);
    }
    extent = fmax(d->most[0] - d->least[0], d->most[1] - d->least[1]);
    d->whole_sphere = g->surface == SPHERE && !(extent > 0 && extent < 0.8);
    if (d->whole_sphere || !(extent > 0)) extent = show_unit_square(d);
    for (k = 0; k < 2; ++k) { /* room for the lines at the rim */
        d->least[k] -= d->whole_sphere ? 0.005 : 0.02 * extent;
        d->most[k] += d->whole_sphere ? 0.005 : 0.02 * extent;
    }
    d->scale = DRAWING_SIZE / fmax(d->most[0] - d->least[0], d->most[1] - d->least[1]);
    d->width = d->scale * (d->most[0] - d->least[0]);
    d->height = d->scale * (d->most[1] - d->least[1]);
    d->shift = d->height < BAR_LEAST ? (BAR_LEAST - d->height) / 2 : 0;
}

/* --- the sphere below --------------------------------------------------------------------------------------------- */

/* A line of constant longitude or latitude, as far as it faces the eye. */
static void put_graticule_line(const drawing *d, int is_meridian, int degrees)
{
    int along, is_down = 0;
    double point[3], view[3];
    for (along = is_meridian ? -90 : -180; along <= (is_meridian ? 90 : 180); along += 2) {
        surfmink_from_lonlat(is_meridian ? degrees : along, is_meridian ? along : degrees, 1, point);
        to_view(&d->camera, point, view);
        if (is_visible(view)) put_point(d, is_down ? 'L' : 'M', view);
        is_down = is_visible(view);
    }
}

static void draw_sphere(const drawing *d)
{
    const double origin[3] = {0, 0, 0};
    int degrees, step = d->whole_sphere ? 30 : 10;
    fputs("<circle cx=\"", d->file);
    put_pixels(d->file, pixel_x(d, origin[0]));
    fputs("\" cy=\"", d->file);
    put_pixels(d->file, pixel_y(d, origin[1]));
    fputs("\" r=\"", d->file);
    put_pixels(d->file, d->scale);
    fputs("\" fill=\"#f3f5f8\" stroke=\"#aeb7c1\"/>\n<path fill=\"none\" stroke=\"#d3dae1\" stroke-width=\".7\" d=\"",
          d->file);
    for (degrees = -180; degrees < 180; degrees += step) put_graticule_line(d, 1, degrees);
    for (degrees = step - 90; degrees < 90; degrees += step) put_graticule_line(d, 0, degrees);
    fputs("\"/>\n", d->file);
}

/* --- outlines ----------------------------------------------------------------------------------------------------- */

/* The outline in view coordinates; of the sphere with points between the corners. */
static void find_outline(drawing *d, const picture *g, const shape *s)
{
    const double *corner = g->corner + 3 * s->first;
    double view[3];
    size_t i;
    d->horizon.outline.n = 0;
    for (i = 0; i < s->n; ++i)
        if (g->surface == SPHERE)
            add_edge(&d->horizon, &d->camera, corner + 3 * i, corner + 3 * (i + 1 < s->n ? i + 1 : 0));
        else {
            to_view(&d->camera, corner + 3 * i, view);
            add_point(&d->horizon.outline, view);
        }
    if (g->surface == SPHERE)
        find_pieces(&d->horizon);
    else
        d->horizon.pieces = 0;
}

/* Can anything of it be seen? */
static int faces_eye(const drawing *d, const picture *g, const shape *s)
{
    if (g->surface == SPHERE) return d->horizon.pieces > 0 || is_visible(d->horizon.outline.x);
    return dot(s->normal, d->camera.eye) > 0;
}

static void put_tooltip(const drawing *d, const picture *g, const shape *s)
{
    fputs("<title>", d->file);
    put_text(d->file, g->text + s->id, IN_XML);
    if (s->status == SURFMINK_OK) {
        fprintf(d->file, ": mu_%d = ", d->options->color_by);
        put_decimals(d->file, s->mu, 4);
    } else
        fprintf(d->file, ": %s", surfmink_status_name(s->status));
    fputs("</title>", d->file);
}

static void draw_outline(drawing *d, const picture *g, const shape *s)
{
    fputs("<path d=\"", d->file);
    if (d->horizon.pieces == 0) put_ring(d, &d->horizon.outline);
    while (d->horizon.pieces > 0 && next_ring(&d->horizon, &d->ring)) put_ring(d, &d->ring);
    if (s->status == SURFMINK_OK) {
        fputs("\" fill=\"", d->file);
        put_color(d->file, s->mu / d->top);
        fputs("\">", d->file);
    } else
        fputs("\" fill=\"url(#refused)\" stroke=\"#8a8a8a\">", d->file);
    put_tooltip(d, g, s);
    fputs("</path>\n", d->file);
}

/* p strokes from the centre along the eigenvectors, longer where mu_p is larger (its root: small mu_p are common). */
static void draw_glyph(const drawing *d, const shape *s)
{
    int k, p = d->options->color_by;
    double reach = 0.65 * sqrt(s->area / 3.141592653589793 * s->mu / d->top);
    double side[3], end[3], view[3], angle;
    size_t j;
    if (dot(s->director, s->director) < 0.5 || reach * d->scale < 1.5 || dot(s->normal, d->camera.eye) < 0.15) return;
    cross(s->normal, s->director, side);
    fputs("<path fill=\"none\" stroke-linecap=\"round\" d=\"", d->file);
    for (k = 0; k < p; ++k) {
        angle = 6.283185307179586 * k / p;
        for (j = 0; j < 3; ++j) end[j] = s->centre[j] + reach * (cos(angle) * s->director[j] + sin(angle) * side[j]);
        to_view(&d->camera, s->centre, view);
        put_point(d, 'M', view);
        to_view(&d->camera, end, view);
        put_point(d, 'L', view);
    }
    fprintf(d->file, "\" stroke=\"%s\" stroke-width=\"", s->mu < 0.62 * d->top ? "#fff" : "#2b2161");
    put_pixels(d->file, fmin(1.6, fmax(0.5, 0.12 * reach * d->scale)));
    fputs("\"/>\n", d->file);
}

/* --- order -------------------------------------------------------------------------------------------------------- */

typedef struct depth {
    double towards_eye;
    size_t shape;
} depth;

static int farther_first(const void *a, const void *b)
{
    const depth *x = (const depth *)a, *y = (const depth *)b;
    if (x->towards_eye < y->towards_eye || x->towards_eye > y->towards_eye)
        return x->towards_eye < y->towards_eye ? -1 : 1;
    return (x->shape > y->shape) - (x->shape < y->shape);
}

/* What is nearer is drawn later. Outlines of a plane or a sphere cannot hide each other: they keep their order. */
static depth *sort_shapes(const drawing *d, const picture *g)
{
    depth *order = (depth *)resize(NULL, g->shapes + 1, sizeof *order);
    size_t i;
    for (i = 0; i < g->shapes; ++i) {
        order[i].shape = i;
        order[i].towards_eye = g->surface == EMBEDDED ? dot(g->shape[i].centre, d->camera.eye) : 0;
    }
    qsort(order, g->shapes, sizeof *order, farther_first);
    return order;
}

static void draw_shapes(drawing *d, const picture *g)
{
    depth *order = sort_shapes(d, g);
    size_t i;
    int glyphs_last = g->surface != EMBEDDED; /* over all outlines, unless a nearer one has to hide them */
    for (i = 0; i < g->shapes; ++i) {
        const shape *s = &g->shape[order[i].shape];
        find_outline(d, g, s);
        if (!faces_eye(d, g, s)) continue;
        draw_outline(d, g, s);
        if (!glyphs_last) draw_glyph(d, s);
    }
    for (i = 0; i < g->shapes && glyphs_last; ++i) draw_glyph(d, &g->shape[i]);
    free(order);
}

/* --- the colour bar ----------------------------------------------------------------------------------------------- */

static void draw_bar(const drawing *d, int has_refused)
{
    double x = MARGIN + d->width + BAR_GAP, y = MARGIN + d->shift + (d->height - BAR_HEIGHT) / 2, at;
    char tick[32];
    int i, ticks = (int)(d->top / d->tick + 0.5);
    fprintf(d->file,
            "<g font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222\" transform=\"translate(");
    put_pixels(d->file, x);
    fputc(' ', d->file);
    put_pixels(d->file, y);
    fprintf(d->file,
            ")\">\n<text x=\"0\" y=\"-14\" font-size=\"16\"><tspan font-style=\"italic\">\xce\xbc</tspan>"
            "<tspan font-size=\"11\" dy=\"4\">%d</tspan></text>\n",
            d->options->color_by);
    fprintf(d->file, "<rect width=\"%d\" height=\"%d\" fill=\"url(#bar)\"/>\n", BAR_WIDTH, BAR_HEIGHT);
    for (i = 0; i <= ticks; ++i) {
        at = BAR_HEIGHT * (1 - (double)i / ticks);
        fprintf(d->file, "<path d=\"M%d ", BAR_WIDTH);
        put_decimals(d->file, at, 1);
        fprintf(d->file, "h5\" stroke=\"#222\"/><text x=\"%d\" y=\"", BAR_WIDTH + 9);
        put_decimals(d->file, at + 4.5, 1);
        *write_number(NULL, tick, 4, i * d->tick) = '\0';
        fprintf(d->file, "\">%s</text>\n", tick);
    }
    if (has_refused)
        fprintf(d->file,
                "<rect y=\"%d\" width=\"%d\" height=\"%d\" fill=\"url(#refused)\" stroke=\"#8a8a8a\"/>"
                "<text x=\"%d\" y=\"%d\">refused</text>\n",
                BAR_HEIGHT + 22, BAR_WIDTH, BAR_WIDTH, BAR_WIDTH + 9, BAR_HEIGHT + 34);
    fputs("</g>\n", d->file);
}

static void define_fills(const drawing *d)
{
    int i;
    fputs("<defs>\n<linearGradient id=\"bar\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\">\n", d->file);
    for (i = 0; i <= 10; ++i) {
        fprintf(d->file, "<stop offset=\"%d.%d\" stop-color=\"", i / 10, i % 10);
        put_color(d->file, 0.1 * i);
        fputs("\"/>\n", d->file);
    }
    fputs("</linearGradient>\n"
          "<pattern id=\"refused\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" "
          "patternTransform=\"rotate(45)\">"
          "<rect width=\"5\" height=\"5\" fill=\"#ececec\"/><path d=\"M0 0v5\" stroke=\"#8a8a8a\" stroke-width=\"2\"/>"
          "</pattern>\n",
          d->file);
    fprintf(d->file, "<clipPath id=\"frame\"><rect x=\"%d\" y=\"", MARGIN);
    put_pixels(d->file, MARGIN + d->shift);
    fputs("\" width=\"", d->file);
    put_pixels(d->file, d->width);
    fputs("\" height=\"", d->file);
    put_pixels(d->file, d->height);
    fputs("\"/></clipPath>\n</defs>\n", d->file);
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

static void begin_svg(const drawing *d)
{
    int width = 2 * MARGIN + BAR_SPACE + (int)ceil(d->width), height = 2 * MARGIN + (int)ceil(d->height + 2 * d->shift);
    fprintf(d->file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\">\n"
            "<desc>Outlines filled by mu_%d (surfmink); strokes: eigenvectors of the positive eigenvalue.</desc>\n",
            width, height, width, height, d->options->color_by);
    define_fills(d);
    fputs("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", d->file);
}

static int has_refused(const picture *g)
{
    size_t i;
    for (i = 0; i < g->shapes; ++i)
        if (g->shape[i].status != SURFMINK_OK) return 1;
    return 0;
}

/* Thin enough to leave small outlines their colour. */
static double line_width(const drawing *d, const picture *g)
{
    double area = 0;
    size_t i;
    for (i = 0; i < g->shapes; ++i) area += g->shape[i].area;
    return fmin(0.7, fmax(0.2, 0.03 * d->scale * sqrt(area / (double)(g->shapes + 1))));
}

static void draw(drawing *d, const picture *g)
{
    begin_svg(d);
    fputs(g->surface == SPHERE ? "<g clip-path=\"url(#frame)\">\n" : "<g>\n", d->file);
    if (g->surface == SPHERE) draw_sphere(d);
    fputs("<g stroke=\"#fff\" stroke-width=\"", d->file);
    put_decimals(d->file, line_width(d, g), 2);
    fputs("\" stroke-linejoin=\"round\">\n", d->file);
    draw_shapes(d, g);
    fputs("</g>\n</g>\n", d->file);
    draw_bar(d, has_refused(g));
    fputs("</svg>\n", d->file);
}

static void write_picture(const picture *g, const options *o)
{
    drawing d;
    int failed;
    memset(&d, 0, sizeof d);
    d.options = o;
    d.camera = o->camera;
    if (g->surface == PLANE) {
        const double above[3] = {0, 0, 1};
        look_from(&d.camera, above);
    } else if (!o->has_view)
        default_camera(g, &d.camera);
    choose_top(&d, g);
    find_extent(&d, g);
    d.file = fopen(o->svg, "wb");
    if (!d.file) die("%s: %s", o->svg, strerror(errno));
    draw(&d, g);
    failed = ferror(d.file);
    if (fclose(d.file) != 0 || failed) die("%s: cannot write: %s", o->svg, strerror(errno));
    free_horizon(&d.horizon);
    free(d.ring.x);
}

#endif
