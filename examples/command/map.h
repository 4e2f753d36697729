/* map.h - step 5 of the command, if asked for: the shapes of a picture -> a picture of them, in one panel or several.

   Panels differ in the column that fills the outlines and in where they are seen from. All have the same scale. Each
   column has its own colours, for some are always smaller than others: one bar at the right, or one below each panel. */
#ifndef SURFMINK_COMMAND_MAP_H
#define SURFMINK_COMMAND_MAP_H

#include "../picture/strokes.h"
#include "horizon.h"
#include "svg.h"

enum {
    BAR_GAP = 28,
    BAR_WIDTH = 18,
    BAR_SPACE = 116,
    BAR_MOST = 280,
    BAR_LEAST = 160,
    BAR_ENDS = 60, /* letters above, and half a letter below */
    BAR_BELOW = 62,
    PANEL_GAP = 24,
    PANEL_HEAD = 34,
    FOOT = 48,
    FOOT_ROW = 34 /* each after the first */
};

/* What stands below the panels, from left to right, and in more rows where there is no room. */
enum foot { FOOT_SCALE, FOOT_REFUSED, FOOT_UNDEFINED, FOOT_STROKES, FOOT_ITEMS };

typedef struct item {
    double width; /* pixels; 0: not shown */
    double x;     /* of its left end */
    int row;
} item;

/* One panel. */
typedef struct panel {
    camera camera;
    int color; /* which of the columns */
    int rank;  /* of its strokes; 0: it has none */
    range range;
    double mu_top; /* of the rank; strokes are left out where mu_p is a small part of it */
    int view;
    double least[2], most[2]; /* what is drawn, in view coordinates */
    double width, height;     /* pixels */
    double left, top;         /* pixels, of its upper left corner */
    int whole_sphere;
    int strokes; /* can any be seen? */
} panel;

typedef struct drawing {
    FILE *file;
    const options *options;
    panel panel[MOST_COLORS]; /* as many as there may be */
    int panels, columns, rows;
    const panel *at;      /* the one that is being drawn */
    double size;          /* pixels of the longer side of a panel, at most */
    double scale;         /* pixels per unit */
    double width, height; /* pixels of the largest panel */
    double shift;         /* pixels down, where the colour bar is taller than the drawing */
    int page_width, page_height;
    item foot[FOOT_ITEMS];
    int foot_rows;
    double bar_length; /* of the scale; 0: there is none */
    horizon horizon;
    points ring, seen; /* of the outline that is being drawn: all of it that can be seen, ring after ring */
    size_t *ring_end;  /* in `seen` */
    size_t rings, ring_room;
} drawing;

/* --- colour ------------------------------------------------------------------------------------------------------- */

/* The colour bar of rank p ends at the first of these that no mu_p exceeds. */
static double color_top(const picture *g, const options *o, int p, double *tick)
{
    static const double top[][2] = {{.05, .01}, {.1, .02}, {.2, .05}, {.3, .1}, {.4, .1},
                                    {.5, .1},   {.6, .2},  {.8, .2},  {1, .2}};
    double most = 0;
    size_t i;
    int k;
    for (i = 0; i < g->shapes; ++i) most = fmax(most, mu_of(g, o, i, p));
    if (most <= 0) most = 1; /* nothing was measured */
    for (k = 0; k < 8 && most > top[k][0]; ++k) continue;
    *tick = top[k][1];
    return top[k][0];
}

/* What the colours of a panel stand for. */
static range color_range(const picture *g, const options *o, int color)
{
    const quantity *q = &o->color_by.of[color];
    range r = {0, 1, 1, 0};
    double least = HUGE_VAL, most = -HUGE_VAL;
    size_t i;
    if (is_of(q, "theta")) return range_of_theta(q->rank);
    if (is_of(q, "mu")) {
        r.high = color_top(g, o, q->rank, &r.step);
        return r;
    }
    for (i = 0; i < g->shapes; ++i) {
        double value = value_of(g, o, i, color);
        if (g->shape[i].status != SURFMINK_OK || isnan(value)) continue;
        least = fmin(least, value);
        most = fmax(most, value);
    }
    return range_of_values(least, most);
}

/* Of a value; grey if it is undefined. */
static void find_value_color(const range *r, double value, int color[3])
{
    int k;
    for (k = 0; k < 3; ++k) color[k] = 200;
    if (!isnan(value)) find_color_in(r->turn ? turn_map : color_map, (value - r->low) / (r->high - r->low), color);
}

/* --- points ------------------------------------------------------------------------------------------------------- */

static double pixel_x(const drawing *d, double x)
{
    return d->at->left + (x - d->at->least[0]) * d->scale;
}

static double pixel_y(const drawing *d, double y)
{
    return d->at->top + (d->at->most[1] - y) * d->scale;
}

static void put_point(const drawing *d, char command, const double *view)
{
    fputc(command, d->file);
    put_pixels(d->file, pixel_x(d, view[0]));
    fputc(' ', d->file);
    put_pixels(d->file, pixel_y(d, view[1]));
}

/* Points that fall together in the picture are left out: coastlines have many. */
static void keep_ring(drawing *d, const points *ring)
{
    size_t i, last = 0;
    for (i = 0; i < ring->n; ++i) {
        const double *x = ring->x + 3 * i, *previous = ring->x + 3 * last;
        if (i > 0 && hypot(x[0] - previous[0], x[1] - previous[1]) * d->scale < 0.05) continue;
        add_point(&d->seen, x);
        last = i;
    }
    d->ring_end = (size_t *)grow(d->ring_end, &d->ring_room, d->rings + 1, sizeof *d->ring_end);
    d->ring_end[d->rings++] = d->seen.n;
}

static void put_rings(const drawing *d)
{
    size_t ring, i = 0;
    for (ring = 0; ring < d->rings; ++ring) {
        size_t first = i;
        for (; i < d->ring_end[ring]; ++i) put_point(d, i == first ? 'M' : 'L', d->seen.x + 3 * i);
        fputc('Z', d->file);
    }
}

/* --- size --------------------------------------------------------------------------------------------------------- */

static void include_point(panel *p, const double *view)
{
    size_t k;
    for (k = 0; k < 2; ++k) {
        p->least[k] = fmin(p->least[k], view[k]);
        p->most[k] = fmax(p->most[k], view[k]);
    }
}

/* The square from -1 to 1: a whole sphere, and what is shown where there is nothing to show. */
static double show_unit_square(panel *p)
{
    size_t k;
    for (k = 0; k < 2; ++k) p->least[k] = -1, p->most[k] = 1;
    return 2;
}

/* A sphere is drawn whole unless the outlines cover so little of it that they could not be told apart. Returns the
   longer side. */
static double find_extent(panel *p, const picture *g)
{
    double view[3], extent;
    size_t i, k;
    for (k = 0; k < 2; ++k) p->least[k] = HUGE_VAL, p->most[k] = -HUGE_VAL;
    for (i = 0; i < g->corners; ++i) {
        to_view(&p->camera, g->corner + 3 * i, view);
        if (g->surface != SPHERE || is_visible(view)) include_point(p, view);
    }
    extent = fmax(p->most[0] - p->least[0], p->most[1] - p->least[1]);
    p->whole_sphere = g->surface == SPHERE && !(extent > 0 && extent < 0.8);
    if (p->whole_sphere || !(extent > 0)) extent = show_unit_square(p);
    for (k = 0; k < 2; ++k) { /* room for the lines at the rim */
        p->least[k] -= p->whole_sphere ? 0.005 : 0.02 * extent;
        p->most[k] += p->whole_sphere ? 0.005 : 0.02 * extent;
    }
    return fmax(p->most[0] - p->least[0], p->most[1] - p->least[1]);
}

/* Of view i. The back is behind the view before it. */
static camera camera_of(const picture *g, const options *o, int i)
{
    const double above[3] = {0, 0, 1};
    camera c;
    size_t k;
    int turns = 0;
    for (; i >= 0 && i < o->views && o->view[i].look == LOOK_BACK; --i) ++turns;
    if (g->surface == PLANE)
        look_from(&c, above);
    else if (i >= 0 && i < o->views && o->view[i].look == LOOK_FROM_GIVEN)
        c = o->view[i].camera;
    else
        default_camera(g, &c);
    for (k = 0; k < 3 && turns % 2; ++k) {
        c.right[k] = -c.right[k];
        c.eye[k] = -c.eye[k];
    }
    return c;
}

/* Ranks side by side and views below each other; if there are only ranks or only views, up to three side by side. */
static void place_panels(drawing *d, const picture *g)
{
    const options *o = d->options;
    int views = o->views > 0 ? o->views : 1, colors = map_colors(o), i;
    double longest = 0, tick;
    d->panels = views * colors;
    d->columns = views > 1 && colors > 1 ? colors : d->panels == 4 ? 2 : d->panels < 3 ? d->panels : 3;
    d->rows = (d->panels + d->columns - 1) / d->columns;
    d->size = d->columns == 1 ? 720 : d->columns == 2 ? 520 : d->columns == 3 ? 400 : 300;
    for (i = 0; i < d->panels; ++i) {
        panel *p = &d->panel[i];
        p->color = i % colors;
        p->rank = map_rank(o, p->color);
        p->view = i / colors;
        p->camera = camera_of(g, o, i / colors);
        p->range = color_range(g, o, p->color);
        p->mu_top = p->rank > 0 ? color_top(g, o, p->rank, &tick) : 1;
        longest = fmax(longest, find_extent(p, g));
    }
    d->scale = d->size / longest;
    for (i = 0; i < d->panels; ++i) {
        d->panel[i].width = d->scale * (d->panel[i].most[0] - d->panel[i].least[0]);
        d->panel[i].height = d->scale * (d->panel[i].most[1] - d->panel[i].least[1]);
        d->width = fmax(d->width, d->panel[i].width);
        d->height = fmax(d->height, d->panel[i].height);
    }
}

/* All that is drawn, without margins, title, foot and colour bar. */
static double panels_width(const drawing *d)
{
    return d->columns * d->width + (d->columns - 1) * PANEL_GAP;
}

static int panel_head(const drawing *d)
{
    return d->panels > 1 ? PANEL_HEAD : 0;
}

static int bars_are_below(const drawing *d)
{
    return map_colors(d->options) > 1;
}

static int panel_foot(const drawing *d)
{
    return bars_are_below(d) ? BAR_BELOW : 0;
}

static double panels_height(const drawing *d)
{
    return d->rows * (d->height + panel_head(d) + panel_foot(d)) + (d->rows - 1) * PANEL_GAP;
}

/* Of the one at the right. */
static double bar_height(const drawing *d)
{
    return fmin(BAR_MOST, fmax(BAR_LEAST, panels_height(d) - BAR_ENDS));
}

/* Places what is shown in the foot. Each item stays in one piece: the page is made as wide as the widest. */
static void lay_out_foot(drawing *d)
{
    double x = MARGIN, gap;
    int i;
    for (i = 0; i < FOOT_ITEMS; ++i) d->page_width = (int)fmax(d->page_width, 2 * MARGIN + ceil(d->foot[i].width));
    d->foot_rows = 1;
    for (i = 0; i < FOOT_ITEMS; ++i) {
        if (d->foot[i].width <= 0) continue;
        gap = x <= MARGIN ? 0 : 30;
        if (x + gap + d->foot[i].width > d->page_width - MARGIN) {
            ++d->foot_rows;
            x = MARGIN;
            gap = 0;
        }
        d->foot[i].x = x + gap;
        d->foot[i].row = d->foot_rows - 1;
        x += gap + d->foot[i].width;
    }
}

static double foot_y(const drawing *d, enum foot i)
{
    return d->page_height - MARGIN - 12 - FOOT_ROW * (d->foot_rows - 1 - d->foot[i].row);
}

static void lay_out(drawing *d)
{
    int i;
    d->shift = bars_are_below(d) ? 0 : fmax(0, (BAR_LEAST + BAR_ENDS - panels_height(d)) / 2);
    for (i = 0; i < d->panels; ++i) {
        panel *p = &d->panel[i];
        int row = i / d->columns;
        p->left = MARGIN + i % d->columns * (d->width + PANEL_GAP) + (d->width - p->width) / 2;
        p->top = MARGIN + title_space(d->options) + d->shift + panel_head(d) +
                 row * (d->height + panel_head(d) + panel_foot(d) + PANEL_GAP) + (d->height - p->height) / 2;
    }
    d->page_width = 2 * MARGIN + (bars_are_below(d) ? 0 : BAR_SPACE) + (int)ceil(panels_width(d));
    lay_out_foot(d);
    d->page_height = 2 * MARGIN + title_space(d->options) + (int)ceil(panels_height(d) + 2 * d->shift) + FOOT +
                     FOOT_ROW * (d->foot_rows - 1);
}

/* --- the sphere below --------------------------------------------------------------------------------------------- */

static int grid_step(const drawing *d)
{
    return d->at->whole_sphere ? 30 : 10;
}

/* A line of constant longitude or latitude, as far as it faces the eye. */
static void put_graticule_line(const drawing *d, int is_meridian, int degrees)
{
    int along, is_down = 0;
    double point[3], view[3];
    for (along = is_meridian ? -90 : -180; along <= (is_meridian ? 90 : 180); along += 2) {
        surfmink_from_lonlat(is_meridian ? degrees : along, is_meridian ? along : degrees, 1, point);
        to_view(&d->at->camera, point, view);
        if (is_visible(view)) put_point(d, is_down ? 'L' : 'M', view);
        is_down = is_visible(view);
    }
}

static void draw_sphere(const drawing *d)
{
    const double origin[3] = {0, 0, 0};
    int degrees, step = grid_step(d);
    begin_circle(d->file, pixel_x(d, origin[0]), pixel_y(d, origin[1]), d->scale);
    fputs(" fill=\"#f3f5f8\" stroke=\"#aeb7c1\"/>\n<path fill=\"none\" stroke=\"#d3dae1\" stroke-width=\".7\" d=\"",
          d->file);
    for (degrees = -180; degrees < 180; degrees += step) put_graticule_line(d, 1, degrees);
    for (degrees = step - 90; degrees < 90; degrees += step) put_graticule_line(d, 0, degrees);
    fputs("\"/>\n", d->file);
}

/* --- outlines ----------------------------------------------------------------------------------------------------- */

/* The outline in view coordinates, of the sphere with points between the corners, and what can be seen of it. */
static void find_outline(drawing *d, const picture *g, const shape *s)
{
    const double *corner = g->corner + 3 * s->first;
    double view[3];
    size_t i;
    d->horizon.outline.n = 0;
    for (i = 0; i < s->n; ++i)
        if (g->surface == SPHERE)
            add_edge(&d->horizon, &d->at->camera, corner + 3 * i, corner + 3 * (i + 1 < s->n ? i + 1 : 0));
        else {
            to_view(&d->at->camera, corner + 3 * i, view);
            add_point(&d->horizon.outline, view);
        }
    if (g->surface == SPHERE)
        find_pieces(&d->horizon);
    else
        d->horizon.pieces = 0;
    d->seen.n = d->rings = 0;
    if (d->horizon.pieces == 0) keep_ring(d, &d->horizon.outline);
    while (d->horizon.pieces > 0 && next_ring(&d->horizon, &d->ring)) keep_ring(d, &d->ring);
}

/* Can anything of it be seen? */
static int faces_eye(const drawing *d, const picture *g, const shape *s)
{
    if (g->surface == SPHERE) return d->horizon.pieces > 0 || is_visible(d->horizon.outline.x);
    return dot(s->normal, d->at->camera.eye) > 0;
}

static double mu_here(const drawing *d, const picture *g, const shape *s)
{
    return mu_of(g, d->options, (size_t)(s - g->shape), d->at->rank);
}

static double value_here(const drawing *d, const picture *g, const shape *s)
{
    return value_of(g, d->options, (size_t)(s - g->shape), d->at->color);
}

static void put_tooltip(const drawing *d, const picture *g, const shape *s)
{
    const quantity *q = &d->options->color_by.of[d->at->color];
    double value = value_here(d, g, s);
    char text[32];
    fputs("<title>", d->file);
    put_text(d->file, g->text + s->id, IN_XML);
    if (s->status == SURFMINK_OK) {
        fputs(": ", d->file);
        put_text(d->file, q->name, IN_XML);
        fputs(" = ", d->file);
        if (is_of(q, "mu"))
            put_decimals(d->file, value, 4);
        else if (isnan(value))
            fputs("undefined", d->file);
        else
            fwrite(text, 1, (size_t)(write_number(NULL, text, 5, value) - text), d->file);
    } else
        fprintf(d->file, ": %s", status_name(s->status));
    fputs("</title>", d->file);
}

/* Thin enough to leave small outlines their colour. */
static double line_width(const drawing *d, const picture *g)
{
    return fmin(1, fmax(0.2, 0.035 * d->scale * sqrt(g->area / (double)(g->shapes + 1))));
}

/* What is seen from the side has thinner lines, or they would cover it. */
static void thin_line(const drawing *d, const picture *g, const shape *s)
{
    double facing = dot(s->normal, d->at->camera.eye);
    if (!(facing < 0.6)) return;
    fputs(" stroke-width=\"", d->file);
    put_decimals(d->file, line_width(d, g) * fmax(0.15, facing / 0.6), 2);
    fputc('"', d->file);
}

static void draw_outline(drawing *d, const picture *g, const shape *s)
{
    int color[3];
    fputs("<path d=\"", d->file);
    put_rings(d);
    if (s->status == SURFMINK_OK) {
        fputs("\" fill=\"", d->file);
        find_value_color(&d->at->range, value_here(d, g, s), color);
        put_color(d->file, color);
        fputs("\"", d->file);
    } else
        fputs("\" fill=\"url(#refused)\" stroke=\"#8a8a8a\"", d->file);
    thin_line(d, g, s);
    fputc('>', d->file);
    put_tooltip(d, g, s);
    fputs("</path>\n", d->file);
}

static const double *director_here(const drawing *d, const picture *g, const shape *s)
{
    return g->director + 3 * ((size_t)map_colors(d->options) * (size_t)(s - g->shape) + (size_t)d->at->color);
}

/* Strokes are as long as this part of the radius of a disc as large as the outline, unless that has no room for them:
   how large mu_p is the colour says. */
static const double STROKE_REACH = 0.6;

/* There are none where mu_p is below this part of the end of its bar: the directions of hardly anything. */
static const double STROKE_LEAST = 0.05;

/* The strokes of the outline that find_outline has found, and their length in pixels; 0 where they could not be seen. */
static double find_strokes(const drawing *d, const picture *g, const shape *s, strokes *to)
{
    const double *director = director_here(d, g, s);
    double reach = STROKE_REACH * sqrt(s->area / 3.141592653589793), side[3], view[3];
    rings outline;
    size_t k;
    if (dot(director, director) < 0.5 || dot(s->normal, d->at->camera.eye) < 0.15) return 0;
    if (mu_here(d, g, s) < STROKE_LEAST * d->at->mu_top) return 0;
    cross(s->normal, director, side);
    to->p = d->at->rank;
    to->first = is_along(d->options) ? 3.141592653589793 / to->p : 0;
    to_view(&d->at->camera, s->centre, view);
    for (k = 0; k < 2; ++k) to->middle[k] = view[k];
    to_view(&d->at->camera, director, view);
    for (k = 0; k < 2; ++k) to->axis[0][k] = reach * view[k];
    to_view(&d->at->camera, side, view);
    for (k = 0; k < 2; ++k) to->axis[1][k] = reach * view[k];
    outline.point = d->seen.x;
    outline.stride = 3;
    outline.end = d->ring_end;
    outline.count = d->rings;
    reach *= d->scale * keep_strokes_inside(to, &outline);
    return reach < 1.5 ? 0 : reach;
}

static void look_for_strokes(drawing *d, const picture *g)
{
    strokes found;
    size_t i;
    int k;
    for (k = 0; k < d->panels; ++k) {
        d->at = &d->panel[k];
        for (i = 0; i < g->shapes && !d->panel[k].strokes; ++i) {
            find_outline(d, g, &g->shape[i]);
            if (faces_eye(d, g, &g->shape[i])) d->panel[k].strokes = find_strokes(d, g, &g->shape[i], &found) > 0;
        }
    }
}

/* p strokes from the centre along the eigenvectors. */
static void draw_glyph(const drawing *d, const picture *g, const shape *s)
{
    strokes found;
    double reach = find_strokes(d, g, s, &found), step[2], end[2];
    int k, color[3];
    if (reach <= 0) return;
    fputs("<path fill=\"none\" stroke-linecap=\"round\" d=\"", d->file);
    for (k = 0; k < found.p; ++k) {
        stroke_step(&found, k, step);
        end[0] = found.middle[0] + step[0];
        end[1] = found.middle[1] + step[1];
        put_point(d, 'M', found.middle);
        put_point(d, 'L', end);
    }
    find_value_color(&d->at->range, value_here(d, g, s), color);
    fprintf(d->file, "\" stroke=\"%s\" stroke-width=\"", ink_on(color));
    put_pixels(d->file, fmax(0.5, fmin(2.2, 0.13 * reach) * fmin(1, 1.5 * dot(s->normal, d->at->camera.eye))));
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
        order[i].towards_eye = g->surface == EMBEDDED ? dot(g->shape[i].centre, d->at->camera.eye) : 0;
    }
    qsort(order, g->shapes, sizeof *order, farther_first);
    return order;
}

static void draw_shapes(drawing *d, const picture *g)
{
    depth *order = sort_shapes(d, g);
    size_t i;
    for (i = 0; i < g->shapes; ++i) {
        const shape *s = &g->shape[order[i].shape];
        find_outline(d, g, s);
        if (!faces_eye(d, g, s)) continue;
        draw_outline(d, g, s);
        draw_glyph(d, g, s);
    }
    free(order);
}

/* --- beside the panels -------------------------------------------------------------------------------------------- */

static void set_ticks(axis *a, const range *r)
{
    a->ticks = range_ticks(r);
    a->step = r->step;
    a->from = r->low;
    a->turn = r->turn;
}

static void draw_bar(const drawing *d)
{
    const panel *p = &d->panel[0];
    const quantity *q = &d->options->color_by.of[p->color];
    double x = MARGIN + panels_width(d) + BAR_GAP, height = bar_height(d);
    double y = MARGIN + title_space(d->options) + d->shift + (panels_height(d) + 36 - height) / 2;
    axis a = {BAR_WIDTH, 0, 0, 'v', 6, {11, 7}, AT_START, 0, 1, 0, 0, 0};
    a.y = height;
    a.length = -height;
    set_ticks(&a, &p->range);
    fputs("<g fill=\"#222\" transform=\"translate(", d->file);
    put_pixels(d->file, x);
    fputc(' ', d->file);
    put_pixels(d->file, y);
    fputs(")\">\n", d->file);
    fputs("<g font-size=\"", d->file);
    put_pixels(d->file, quantity_size(q, 26, BAR_SPACE - BAR_GAP));
    fputs("\">", d->file);
    begin_text(d->file, 0, -18, AT_START, "");
    put_quantity(d->file, q);
    fprintf(d->file, "</text></g>\n<rect width=\"%d\" height=\"", BAR_WIDTH);
    put_pixels(d->file, height);
    fprintf(d->file, "\" fill=\"url(#%s)\" stroke=\"#222\" stroke-width=\".7\"/>\n", p->range.turn ? "turn" : "bar");
    put_axis(d->file, &a, 0);
    fputs("</g>\n", d->file);
}

/* Below a panel, as wide as half of it. */
static void draw_bar_below(const drawing *d)
{
    const panel *p = d->at;
    double width = 0.6 * d->width, x = p->left + p->width / 2 - width / 2;
    double y = p->top + p->height + (d->height - p->height) / 2 + 12;
    axis a = {0, 14, 0, 'h', 5, {0, 24}, AT_MIDDLE, 0, 1, 0, 0, 0};
    a.length = width;
    set_ticks(&a, &p->range);
    a.every = a.ticks > 6 || width < 200 ? 2 : 1;
    if (a.ticks % a.every) a.every = a.ticks; /* only both ends */
    fputs("<g fill=\"#222\" transform=\"translate(", d->file);
    put_pixels(d->file, x);
    fputc(' ', d->file);
    put_pixels(d->file, y);
    fputs(")\">\n<rect width=\"", d->file);
    put_pixels(d->file, width);
    fprintf(d->file, "\" height=\"14\" fill=\"url(#%s_below)\" stroke=\"#222\" stroke-width=\".7\"/>\n",
            p->range.turn ? "turn" : "bar");
    put_axis(d->file, &a, 0);
    fputs("</g>\n", d->file);
}

/* --- below the panels --------------------------------------------------------------------------------------------- */

/* What the scale bar is in where --unit does not say. */
static const char *scale_unit(const drawing *d, const picture *g)
{
    return d->options->unit       ? d->options->unit
           : g->surface == SPHERE ? "(units of the radius)"
                                  : "(units of the corners)";
}

/* On a sphere without a radius what can be said is how far the lines of the grid are apart. */
static int has_grid(const drawing *d, const picture *g)
{
    return g->surface == SPHERE && !(d->options->radius > 0);
}

/* Strokes of the same rank look alike in all views. */
static int has_strokes(const drawing *d, int color)
{
    int i;
    for (i = 0; i < color; ++i) /* one sample for a rank is enough */
        if (map_rank(d->options, i) == map_rank(d->options, color)) return 0;
    for (i = 0; i < d->panels; ++i)
        if (d->panel[i].rank == map_rank(d->options, color) && d->panel[i].strokes) return 1;
    return 0;
}

static int strokes_shown(const drawing *d)
{
    int i, shown = 0;
    for (i = 0; i < map_colors(d->options); ++i) shown += has_strokes(d, i);
    return shown;
}

/* Where they point. */
static const char *stroke_words(const drawing *d)
{
    int i, elongation = 0, others = 0;
    for (i = 0; i < map_colors(d->options); ++i) {
        if (!has_strokes(d, i)) continue;
        if (map_rank(d->options, i) == 2)
            elongation = 1;
        else
            others = 1;
    }
    if (!is_along(d->options)) return others ? "across the sides" : "across the long axis";
    return !others ? "along the long axis" : elongation ? "along the long axis, towards corners" : "towards corners";
}

static double pixels_of_unit(const drawing *d, const picture *g)
{
    return d->scale / (g->surface == SPHERE ? d->options->radius : 1);
}

static int has_undefined(const drawing *d, const picture *g)
{
    size_t i;
    int color;
    for (i = 0; i < g->shapes; ++i)
        for (color = 0; color < map_colors(d->options); ++color)
            if (g->shape[i].status == SURFMINK_OK && isnan(value_of(g, d->options, i, color))) return 1;
    return 0;
}

static void write_scale(const drawing *d, const picture *g, char text[32])
{
    if (has_grid(d, g))
        snprintf(text, 32, "grid: %d\xc2\xb0", d->panel[0].whole_sphere ? 30 : 10);
    else
        *write_number(NULL, text, 4, d->bar_length) = '\0';
}

enum { SAMPLE_WIDTH = 36, BAR_TO_TEXT = 12, SQUARE_TO_TEXT = 9 };

/* What there is to say, and how wide it is. The length of the scale is about a fifth of a panel. */
static void find_foot(drawing *d, const picture *g)
{
    char text[32];
    int shown = strokes_shown(d);
    if (g->corners > 0 && !has_grid(d, g)) {
        d->bar_length = round_step(0.25 * d->width / pixels_of_unit(d, g));
        write_scale(d, g, text);
        d->foot[FOOT_SCALE].width = d->bar_length * pixels_of_unit(d, g) + BAR_TO_TEXT + text_width(text) +
                                    text_width(" ") + text_width(scale_unit(d, g));
    } else if (g->corners > 0 && g->area <= 10) { /* above, almost 4 pi, nothing of the grid can be seen */
        write_scale(d, g, text);
        d->foot[FOOT_SCALE].width = text_width(text);
    }
    if (g->measured < g->shapes) d->foot[FOOT_REFUSED].width = BAR_WIDTH + SQUARE_TO_TEXT + text_width("refused");
    if (has_undefined(d, g)) d->foot[FOOT_UNDEFINED].width = BAR_WIDTH + SQUARE_TO_TEXT + text_width("undefined");
    if (shown == 0) return;
    d->foot[FOOT_STROKES].width =
        SAMPLE_WIDTH * shown + SQUARE_TO_TEXT + text_width("directions of mu: ") + text_width(stroke_words(d));
}

/* A square with what it means beside it. */
static void draw_square(const drawing *d, enum foot which, const char *paint, const char *text)
{
    double x = d->foot[which].x, y = foot_y(d, which);
    if (d->foot[which].width <= 0) return;
    fputs("<rect x=\"", d->file);
    put_pixels(d->file, x);
    fputs("\" y=\"", d->file);
    put_pixels(d->file, y - 9);
    fprintf(d->file, "\" width=\"%d\" height=\"%d\" fill=\"%s\" stroke=\"#8a8a8a\"/>\n<g fill=\"#222\">", BAR_WIDTH,
            BAR_WIDTH, paint);
    put_label(d->file, x + BAR_WIDTH + SQUARE_TO_TEXT, y + 7, AT_START, text);
    fputs("</g>\n", d->file);
}

/* On a sphere it holds at the middle. */
static void draw_scale(const drawing *d, const picture *g)
{
    double x = d->foot[FOOT_SCALE].x, y = foot_y(d, FOOT_SCALE), length = 0;
    char text[32];
    if (!has_grid(d, g)) {
        length = d->bar_length * pixels_of_unit(d, g);
        fputs("<path fill=\"none\" stroke=\"#222\" stroke-width=\"4\" d=\"", d->file);
        put_line(d->file, x, y, 'h', length);
        fputs("\"/>\n", d->file);
        length += BAR_TO_TEXT;
    }
    write_scale(d, g, text);
    fputs("<g fill=\"#222\">", d->file);
    begin_text(d->file, x + length, y + 7, AT_START, "");
    fputs(text, d->file);
    if (!has_grid(d, g)) {
        fputc(' ', d->file);
        put_text(d->file, scale_unit(d, g), IN_XML);
    }
    fputs("</text></g>\n", d->file);
}

/* An outline with its strokes about (x, y): a rectangle that lies for p = 2, else a regular polygon with a side at the
   right. */
static void draw_sample(const drawing *d, int p, double x, double y)
{
    int is_way_to_corner = is_along(d->options) || p == 1, k;
    double angle, first = p == 2 ? 1.5707963267948966 : 0, reach;
    reach = 0.75 * (p == 2 ? (is_way_to_corner ? 14 : 6) : 13 * (is_way_to_corner ? 1 : cos(3.141592653589793 / p)));
    fputs("<path d=\"", d->file);
    for (k = 0; k < (p == 2 ? 4 : p) && p > 1; ++k) {
        angle = 3.141592653589793 * (2 * k + 1) / p; /* the middle of a side is at the right */
        fputc(k == 0 ? 'M' : 'L', d->file);
        put_pixels(d->file, p == 2 ? x + (k == 0 || k == 3 ? 14 : -14) : x + 13 * cos(angle));
        fputc(' ', d->file);
        put_pixels(d->file, p == 2 ? y + (k < 2 ? 6 : -6) : y + 13 * sin(angle));
    }
    if (p > 1) fputc('Z', d->file);
    if (is_along(d->options)) first += 3.141592653589793 / p;
    fputs("\"/><path stroke-width=\"2.2\" d=\"", d->file);
    for (k = 0; k < p; ++k) {
        angle = first + 6.283185307179586 * k / p;
        fputc('M', d->file);
        put_pixels(d->file, x);
        fputc(' ', d->file);
        put_pixels(d->file, y);
        fputc('L', d->file);
        put_pixels(d->file, x + reach * cos(angle));
        fputc(' ', d->file);
        put_pixels(d->file, y + reach * sin(angle));
    }
    fputs("\"/>\n", d->file);
}

/* The key of the strokes: a sample for each rank, and what they are. */
static void draw_stroke_key(const drawing *d)
{
    double x = d->foot[FOOT_STROKES].x, y = foot_y(d, FOOT_STROKES);
    int i, rank = 0, shown = strokes_shown(d);
    fputs("<g id=\"strokes\" fill=\"none\" stroke=\"#222\">\n", d->file);
    for (i = 0; i < map_colors(d->options); ++i) {
        if (!has_strokes(d, i)) continue;
        rank = map_rank(d->options, i);
        draw_sample(d, rank, x + 0.5 * SAMPLE_WIDTH, y);
        x += SAMPLE_WIDTH;
    }
    fputs("</g>\n<g fill=\"#222\">", d->file);
    begin_text(d->file, x + SQUARE_TO_TEXT, y + 7, AT_START, "");
    fputs(shown == 1 && rank < 3 ? "direction of " : "directions of ", d->file);
    put_mu(d->file, shown == 1 ? rank : 0);
    fprintf(d->file, "<tspan dy=\"-5\">: %s</tspan></text></g>\n", stroke_words(d));
}

static void define_bar(const drawing *d, const char *name, const int map[11][3])
{
    int i;
    fprintf(d->file, "<linearGradient id=\"%s%s>\n", name,
            bars_are_below(d) ? "_below\"" : "\" x1=\"0\" y1=\"1\" x2=\"0\" y2=\"0\"");
    for (i = 0; i <= 10; ++i) {
        fprintf(d->file, "<stop offset=\"%d.%d\" stop-color=\"", i / 10, i % 10);
        put_color(d->file, map[i]);
        fputs("\"/>\n", d->file);
    }
    fputs("</linearGradient>\n", d->file);
}

static void define_fills(const drawing *d)
{
    int i, turns = 0;
    for (i = 0; i < d->panels; ++i) turns += d->panel[i].range.turn > 0;
    fputs("<defs>\n", d->file);
    if (turns < d->panels) define_bar(d, "bar", color_map);
    if (turns > 0) define_bar(d, "turn", turn_map);
    fputs("<pattern id=\"refused\" width=\"5\" height=\"5\" patternUnits=\"userSpaceOnUse\" "
          "patternTransform=\"rotate(45)\">"
          "<rect width=\"5\" height=\"5\" fill=\"#ececec\"/><path d=\"M0 0v5\" stroke=\"#8a8a8a\" stroke-width=\"2\"/>"
          "</pattern>\n",
          d->file);
    for (i = 0; i < d->panels; ++i) {
        fprintf(d->file, "<clipPath id=\"panel%d\"><rect x=\"", i);
        put_pixels(d->file, d->panel[i].left);
        fputs("\" y=\"", d->file);
        put_pixels(d->file, d->panel[i].top);
        fputs("\" width=\"", d->file);
        put_pixels(d->file, d->panel[i].width);
        fputs("\" height=\"", d->file);
        put_pixels(d->file, d->panel[i].height);
        fputs("\"/></clipPath>\n", d->file);
    }
    fputs("</defs>\n", d->file);
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

/* What its colours mean. */
static void describe_colors(FILE *file, const quantity *q, const range *r)
{
    char low[32], high[32];
    put_text(file, q->name, IN_XML);
    if (r->turn) {
        fprintf(file, ", pale for 0, blue below, red above, dark for -pi/%d and pi/%d alike", r->turn, r->turn);
        return;
    }
    *write_number(NULL, low, 5, r->low) = '\0';
    *write_number(NULL, high, 5, r->high) = '\0';
    fprintf(file, ", dark for %s to light for %s", low, high);
}

static void begin_map(const drawing *d, const picture *g)
{
    int i;
    begin_page(d->file, d->page_width, d->page_height, d->options, "Outlines and their p-fold symmetry");
    fprintf(d->file, "%lu outlines (%lu of them refused) filled by ", (unsigned long)g->shapes,
            (unsigned long)(g->shapes - g->measured));
    for (i = 0; i < map_colors(d->options); ++i) {
        if (i > 0) fputs("; by ", d->file);
        describe_colors(d->file, &d->options->color_by.of[i], &d->panel[i].range);
    }
    fputc('.', d->file);
    if (strokes_shown(d) > 0)
        fprintf(
            d->file,
            " Strokes: eigenvectors of the %s eigenvalue at the middle of each outline, %s; as long as there is room, "
            "none where mu_p is below %d %% of the end of its bar.",
            is_along(d->options) ? "negative" : "positive",
            is_along(d->options) ? "along its long axis and towards its corners" : "across its longest sides",
            (int)(100 * STROKE_LEAST + 0.5));
    fputs(" Drawn by surfmink " SURFMINK_VERSION ".", d->file);
    end_description(d->file, d->page_width, d->options);
    define_fills(d);
}

enum { VIEW_NAME = 128 };

/* Returns the new end. */
static char *append(char *end, const char *text)
{
    size_t length = strlen(text);
    memcpy(end, text, length + 1);
    return end + length;
}

static char *append_number(char *end, double value)
{
    end = write_number(NULL, end, 4, value);
    *end = '\0';
    return end;
}

static char *append_degrees(char *end, double degrees, const char *positive, const char *negative)
{
    end = append(append_number(end, fabs(degrees)), "\xc2\xb0 ");
    return append(end, degrees < 0 ? negative : positive);
}

/* From where the outlines are seen. */
static void name_view(const options *o, int i, char name[VIEW_NAME])
{
    const viewpoint *v = &o->view[i];
    if (v->look == LOOK_BACK)
        append(name, i > 0 ? "from the other side" : "from behind");
    else if (v->look == LOOK_FRONT)
        append(name, "from the front");
    else if (v->numbers == 2) {
        name = append(name, "from above ");
        name = append_degrees(name, remainder(v->from[0], 360), "E", "W");
        name = append(name, ", ");
        append_degrees(name, v->from[1], "N", "S");
    } else {
        name = append_number(append(name, "from x, y, z = "), v->from[0]);
        name = append_number(append(name, ", "), v->from[1]);
        append_number(append(name, ", "), v->from[2]);
    }
}

/* The title of a panel, in letters that it has room for. */
static void draw_head(const drawing *d, int i)
{
    double left = MARGIN + i % d->columns * (d->width + PANEL_GAP);
    double y = d->at->top - (d->height - d->at->height) / 2 - 12;
    int several_columns = map_colors(d->options) > 1, several_views = d->options->views > 1;
    const quantity *q = &d->options->color_by.of[d->at->color];
    char name[VIEW_NAME] = "";
    size_t length;
    if (d->panels == 1) return;
    if (several_views) name_view(d->options, d->at->view, name);
    length = text_length(name) + (several_columns ? quantity_letters(q) + 1 : 0);
    fputs("<g fill=\"#222\">", d->file);
    put_letter(d->file, left, y, i);
    fputs("<g font-size=\"", d->file);
    put_pixels(d->file, fmin(22, fmax(11, (d->width - 48) / (0.58 * (double)length))));
    fputs("\">", d->file);
    begin_text(d->file, left + d->width / 2, y, AT_MIDDLE, "");
    if (several_columns) put_quantity(d->file, q);
    if (several_views)
        fprintf(d->file, "<tspan%s>%s%s</tspan>", several_columns ? " dy=\"-5\"" : "", several_columns ? ", " : "",
                name);
    fputs("</text></g>\n</g>\n", d->file);
}

static void draw_panel(drawing *d, const picture *g, int i)
{
    d->at = &d->panel[i];
    draw_head(d, i);
    if (g->surface == SPHERE)
        fprintf(d->file, "<g clip-path=\"url(#panel%d)\">\n", i);
    else
        fputs("<g>\n", d->file);
    if (g->surface == SPHERE) draw_sphere(d);
    fputs("<g stroke=\"#fff\" stroke-width=\"", d->file);
    put_decimals(d->file, line_width(d, g), 2);
    fputs("\" stroke-linejoin=\"round\">\n", d->file);
    draw_shapes(d, g);
    fputs("</g>\n</g>\n", d->file);
    if (bars_are_below(d)) draw_bar_below(d);
}

static void write_map(const picture *g, const options *o)
{
    drawing d;
    int i;
    memset(&d, 0, sizeof d);
    d.options = o;
    place_panels(&d, g);
    look_for_strokes(&d, g);
    find_foot(&d, g);
    lay_out(&d);
    d.file = open_page(o->svg);
    begin_map(&d, g);
    for (i = 0; i < d.panels; ++i) draw_panel(&d, g, i);
    if (!bars_are_below(&d)) draw_bar(&d);
    if (d.foot[FOOT_SCALE].width > 0) draw_scale(&d, g);
    draw_square(&d, FOOT_REFUSED, "url(#refused)", "refused");
    draw_square(&d, FOOT_UNDEFINED, "#c8c8c8", "undefined");
    if (d.foot[FOOT_STROKES].width > 0) draw_stroke_key(&d);
    fputs("</svg>\n", d.file);
    close_page(d.file, o->svg);
    free_horizon(&d.horizon);
    free(d.ring.x);
    free(d.seen.x);
    free(d.ring_end);
}

#endif
