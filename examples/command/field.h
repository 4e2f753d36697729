/* field.h - the picture of a p-atic field: cells filled by hue or by order, rays along the directions, defects.

   A direction needs something to be measured from. Here it is what points to the right on the page, carried from the
   eye to the cell by the smallest rotation, so a hue says how the rays lie on the page. Hues go once round for 1/p of a
   turn. Rays lie along the directions of -lambda_p unless --strokes across asks for those of the table. Defects are
   told apart without colour: a black disc with a plus, a white one with a minus; a charge of k/p has k - 1 rings more,
   and where there are few it is printed. */
#ifndef SURFMINK_COMMAND_FIELD_H
#define SURFMINK_COMMAND_FIELD_H

#include "../picture/camera.h"
#include "../picture/strokes.h"
#include "../picture/svg.h"
#include "common.h"
#include "options.h"

/* Pixels. Charges are printed beside fewer than LABELLED defects of a panel. */
enum { FIELD_MARGIN = 20, FIELD_PANEL = 620, FIELD_TEXT = 20, FIELD_HEAD = 44, LABELLED = 25 };

/* Rays are as long as this part of the perimeter, a third of the width of a cell. How large the order is the colour
   says: below this part of the largest there are none, as in the pictures of surfmink. */
static const double FIELD_REACH = 1.0 / 9, FIELD_LEAST = 0.05;

typedef struct field_panel {
    camera eye;
    double left, top;                /* of the panel on the page */
    double height, scale, middle[2]; /* pixels a unit; what is seen in the middle */
    double low[2], high[2];          /* of what is seen */
    size_t seen;                     /* cells */
    double *ring;                    /* of the cell that is being drawn: x y on the page */
    size_t ring_room;
    size_t *order; /* cells from back to front */
    double *depth;
} field_panel;

static void field_corner(const patic *t, size_t h, double x[3])
{
    const double *from = t->all.corner + (t->all.kind == SURFMINK_PLANE ? 2 : 3) * h;
    double norm;
    int k;
    for (k = 0; k < 3; ++k) x[k] = k == 2 && t->all.kind == SURFMINK_PLANE ? 0 : from[k];
    if (t->all.kind != SURFMINK_SPHERE) return;
    norm = sqrt(dot(x, x));
    for (k = 0; k < 3; ++k) x[k] *= t->all.radius / norm;
}

/* --- where to look from ------------------------------------------------------------------------------------------- */

/* An open tissue from above, a closed one from where it is broadest: the axis in which its cells spread least, by power
   iteration on trace - covariance. */
static void look_at_field(const patic *t, camera *eye)
{
    double sum[3] = {0, 0, 0}, mean[3] = {0, 0, 0}, spread[3][3] = {{0}}, total = 0, v[3] = {0.1, 0.2, 1}, w[3], norm;
    size_t c;
    int i, j, round;
    for (c = 0; c < t->cells; ++c) {
        if (t->cell[c].status != SURFMINK_OK) continue;
        for (i = 0; i < 3; ++i) {
            sum[i] += t->cell[c].normal[i];
            mean[i] += t->cell[c].centre[i] / (double)t->measured;
        }
    }
    for (c = 0; c < t->cells; ++c)
        for (i = 0; i < 3 && t->cell[c].status == SURFMINK_OK; ++i)
            for (j = 0; j < 3; ++j) spread[i][j] += (t->cell[c].centre[i] - mean[i]) * (t->cell[c].centre[j] - mean[j]);
    for (i = 0; i < 3; ++i) total += spread[i][i];
    for (round = 0; round < 100 && total > 0; ++round) {
        for (i = 0; i < 3; ++i) w[i] = v[i] - dot(spread[i], v) / total;
        norm = sqrt(dot(w, w));
        for (i = 0; i < 3 && norm > 0; ++i) v[i] = w[i] / norm;
    }
    look_from(eye, sqrt(dot(sum, sum)) > 0.3 * (double)t->measured ? sum : v);
}

/* One panel for each view, or the front and, if enough of the tissue looks away, the back. */
static int choose_views(const patic *t, const options *o, camera *eye)
{
    camera front;
    size_t c, away = 0;
    int i, count = o->views;
    look_at_field(t, &front);
    for (c = 0; c < t->cells; ++c) away += t->cell[c].status == SURFMINK_OK && dot(t->cell[c].normal, front.eye) < 0;
    if (count == 0) count = 20 * away > t->measured ? 2 : 1;
    for (i = 0; i < count; ++i) {
        double back[3];
        int k;
        for (k = 0; k < 3; ++k) back[k] = -front.eye[k];
        eye[i] = front;
        if (o->views > 0 && o->view[i].look == LOOK_FROM_GIVEN)
            eye[i] = o->view[i].camera;
        else if (o->views > 0 ? o->view[i].look == LOOK_BACK : i == 1)
            look_from(&eye[i], back);
    }
    return count;
}

static void begin_panel(const patic *t, field_panel *panel)
{
    size_t c, h, i, gap;
    double v[3], x[3];
    int k;
    panel->seen = 0;
    for (k = 0; k < 2; ++k) panel->low[k] = HUGE_VAL, panel->high[k] = -HUGE_VAL;
    for (c = 0; c < t->cells; ++c) {
        if (t->cell[c].status != SURFMINK_OK || !(dot(t->cell[c].normal, panel->eye.eye) > 0)) continue;
        panel->depth[c] = dot(t->cell[c].centre, panel->eye.eye);
        panel->order[panel->seen++] = c;
        for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
            field_corner(t, h, x);
            to_view(&panel->eye, x, v);
            for (k = 0; k < 2; ++k) {
                panel->low[k] = fmin(panel->low[k], v[k]);
                panel->high[k] = fmax(panel->high[k], v[k]);
            }
        }
    }
    for (gap = panel->seen / 2; gap > 0; gap /= 2) /* from back to front */
        for (i = gap; i < panel->seen; ++i)
            for (h = i; h >= gap && panel->depth[panel->order[h - gap]] > panel->depth[panel->order[h]]; h -= gap) {
                c = panel->order[h];
                panel->order[h] = panel->order[h - gap];
                panel->order[h - gap] = c;
            }
}

static void place_on_page(const field_panel *panel, const double x[3], double page[2])
{
    double v[3];
    to_view(&panel->eye, x, v);
    page[0] = panel->left + 0.5 * FIELD_PANEL + panel->scale * (v[0] - panel->middle[0]);
    page[1] = panel->top + panel->height / 2 - panel->scale * (v[1] - panel->middle[1]);
}

/* --- marks -------------------------------------------------------------------------------------------------------- */

static void put_place(FILE *out, const double page[2])
{
    int k;
    for (k = 0; k < 2; ++k) {
        double x = fmin(1e5, fmax(-1e5, page[k]));
        if (x < 0 && lround(10 * x) < 0) fputc('-', out);
        put_decimals(out, fabs(x), 1);
        if (k == 0) fputc(' ', out);
    }
}

/* A colour for every angle, mixed with white where the order is low, and so light that dark rays show on all of them;
   or that of the order, as surfmink colours mu_p. */
static void find_fill(double angle, double order, int by_order, int part[3])
{
    static const double third = 2.0943951023931953;
    int k;
    if (by_order) find_color(order, part);
    for (k = 0; k < 3 && !by_order; ++k) {
        double full = 0.68 + 0.32 * cos(angle - third * k), share = fmin(1, 0.25 + 0.75 * sqrt(order));
        part[k] = (int)(255 * fmin(1, fmax(0, share * full + 1 - share)) + 0.5);
    }
}

/* p psi against the right of the page. */
static double angle_on_page(const patic *t, const field_panel *panel, int p, const double *z, size_t c)
{
    const patic_cell *cell = &t->cell[c];
    double right[3], part = dot(panel->eye.right, cell->normal) / (1 + dot(panel->eye.eye, cell->normal));
    int k;
    for (k = 0; k < 3; ++k) right[k] = panel->eye.right[k] - part * (panel->eye.eye[k] + cell->normal[k]);
    return atan2(z[2 * c + 1], z[2 * c]) - p * atan2(dot(right, cell->across), dot(right, cell->axis));
}

/* A cell; its outline on the page is kept for the rays. */
static void put_cell(FILE *out, const patic *t, field_panel *panel, size_t c, const int fill[3])
{
    double x[3];
    size_t h, n = t->offset[c + 1] - t->offset[c];
    panel->ring = (double *)grow(panel->ring, &panel->ring_room, 2 * n, sizeof *panel->ring);
    for (h = 0; h < n; ++h) {
        field_corner(t, t->offset[c] + h, x);
        place_on_page(panel, x, panel->ring + 2 * h);
        fputs(h == 0 ? "<path d=\"M" : "L", out);
        put_place(out, panel->ring + 2 * h);
    }
    fprintf(out, "Z\" fill=\"#%02x%02x%02x\"/>\n", (unsigned)fill[0], (unsigned)fill[1], (unsigned)fill[2]);
}

/* Rays along all p directions, as long as a third of the cell is wide if it has room for them. */
static void put_rays(FILE *out, const patic *t, const field_panel *panel, int p, const double *z, size_t c, int along,
                     const int fill[3])
{
    const patic_cell *cell = &t->cell[c];
    double page[2], step[2], x[3];
    size_t corners = t->offset[c + 1] - t->offset[c];
    strokes rays;
    rings outline;
    double reach = FIELD_REACH * cell->length;
    int n, i, k;
    if (dot(cell->normal, panel->eye.eye) < 0.15) return; /* too slanted for them to be seen */
    outline.point = panel->ring;
    outline.stride = 2;
    outline.end = &corners;
    outline.count = 1;
    rays.p = p;
    rays.first = atan2(z[2 * c + 1], z[2 * c]) / p + (along ? 3.14159265358979323846 / p : 0);
    place_on_page(panel, cell->centre, rays.middle);
    for (i = 0; i < 2; ++i) {
        const double *axis = i == 0 ? cell->axis : cell->across;
        for (k = 0; k < 3; ++k) x[k] = cell->centre[k] + reach * axis[k];
        place_on_page(panel, x, rays.axis[i]);
        for (k = 0; k < 2; ++k) rays.axis[i][k] -= rays.middle[k];
    }
    reach *= panel->scale * keep_strokes_inside(&rays, &outline);
    if (reach < 1.5) return;
    fprintf(out, "<path fill=\"none\" stroke-linecap=\"round\" stroke=\"%s\" stroke-width=\"", ink_on(fill));
    put_pixels(out, fmax(0.5, fmin(1.6, 0.13 * reach)));
    fputs("\" d=\"", out);
    for (n = 0; n < p; ++n) {
        stroke_step(&rays, n, step);
        for (k = 0; k < 2; ++k) page[k] = rays.middle[k] + step[k];
        fputc('M', out);
        put_place(out, rays.middle);
        fputc('L', out);
        put_place(out, page);
    }
    fputs("\"/>\n", out);
}

static int is_in_front(const patic *t, const field_panel *panel, const patic_defect *d)
{
    size_t c = d->core == PATIC_NONE ? t->owner[t->loop[d->loop].first] : d->core;
    return dot(t->cell[c].normal, panel->eye.eye) > 0;
}

static double disc_radius(const patic_defect *d, double size)
{
    long many = labs(d->k);
    return size * (1 + 0.45 * (double)((many < 4 ? many : 4) - 1));
}

static void put_defect(FILE *out, const field_panel *panel, const patic_defect *d, double size)
{
    double page[2];
    long k, many = labs(d->k);
    place_on_page(panel, d->x, page);
    for (k = many < 4 ? many : 4; k > 0; --k) {
        fputs("<circle cx=\"", out);
        put_decimals(out, fmax(0, page[0]), 1);
        fputs("\" cy=\"", out);
        put_decimals(out, fmax(0, page[1]), 1);
        fputs("\" r=\"", out);
        put_decimals(out, size * (1 + 0.45 * (double)(k - 1)), 1);
        fprintf(out, "\" fill=\"%s\" stroke=\"%s\"/>\n", k == 1 && d->k > 0 ? "#000" : "#fff",
                d->k > 0 && many == 1 ? "#fff" : "#000");
    }
    fprintf(out, "<path stroke=\"%s\" d=\"M", d->k > 0 ? "#fff" : "#000");
    page[0] -= size / 2;
    put_place(out, page);
    fputc('h', out);
    put_decimals(out, size, 1);
    page[0] += size / 2;
    if (d->k > 0) {
        page[1] -= size / 2;
        fputc('M', out);
        put_place(out, page);
        fputc('v', out);
        put_decimals(out, size, 1);
    }
    fputs("\"/>\n", out);
}

/* --- charges beside the discs ------------------------------------------------------------------------------------- */

/* What the charges of a panel must not cover: the middles of boxes, and half their widths and heights. */
typedef struct taken {
    double middle[2 * LABELLED][2], half[2 * LABELLED][2];
    int count;
} taken;

static void occupy(taken *all, const double middle[2], double half_width, double half_height)
{
    int k;
    for (k = 0; k < 2; ++k) all->middle[all->count][k] = middle[k];
    all->half[all->count][0] = half_width;
    all->half[all->count++][1] = half_height;
}

static int is_free(const taken *all, const double middle[2], const double half[2])
{
    int i;
    for (i = 0; i < all->count; ++i)
        if (fabs(middle[0] - all->middle[i][0]) < half[0] + all->half[i][0] &&
            fabs(middle[1] - all->middle[i][1]) < half[1] + all->half[i][1])
            return 0;
    return middle[0] - half[0] > 0 && middle[1] - half[1] > 0;
}

/* To the right of the disc, or to its left, above or below it; nowhere if it would cover another disc or charge. */
static void put_charge(FILE *out, const field_panel *panel, int p, const patic_defect *d, double size, taken *all)
{
    static const int side[4][2] = {{1, 0}, {-1, 0}, {0, -1}, {0, 1}};
    double page[2], middle[2], half[2], radius = disc_radius(d, size);
    char text[48];
    int k, length = snprintf(text, sizeof text, "%ld/%d", labs(d->k), p) + 1;
    half[0] = 3.9 * length; /* letters of 14 pixels */
    half[1] = 6;
    place_on_page(panel, d->x, page);
    for (k = 0; k < 4; ++k) {
        middle[0] = page[0] + side[k][0] * (radius + 3 + half[0]);
        middle[1] = page[1] + side[k][1] * (radius + 2 + half[1]);
        if (is_free(all, middle, half)) break;
    }
    if (k == 4) return;
    occupy(all, middle, half[0], half[1]);
    fputs("<text text-anchor=\"middle\" x=\"", out);
    put_decimals(out, middle[0], 1);
    fputs("\" y=\"", out);
    put_decimals(out, middle[1] + 5, 1);
    fprintf(out, "\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">%s%s</text>\n",
            d->k > 0 ? "+" : "\xe2\x88\x92", text);
}

static void put_defects(FILE *out, const patic *t, const field_panel *panel, int p)
{
    double size = fmin(9, fmax(3, 0.22 * t->spacing * panel->scale)), page[2];
    size_t i, defects = 0;
    taken all;
    all.count = 0;
    for (i = 0; i < t->defects; ++i) {
        const patic_defect *d = &t->defect[i];
        if (!is_in_front(t, panel, d)) continue;
        put_defect(out, panel, d, size);
        place_on_page(panel, d->x, page);
        if (defects++ < LABELLED) occupy(&all, page, disc_radius(d, size), disc_radius(d, size));
    }
    for (i = 0; i < t->defects && defects < LABELLED; ++i)
        if (is_in_front(t, panel, &t->defect[i])) put_charge(out, panel, p, &t->defect[i], size, &all);
}

static void put_panel(FILE *out, const patic *t, field_panel *panel, int p, const double *z, double most, int by_order,
                      int along)
{
    double order, angle;
    size_t i;
    int fill[3];
    fputs("<g stroke=\"#fff\" stroke-width=\".7\" stroke-linejoin=\"round\">\n", out);
    for (i = 0; i < panel->seen; ++i) {
        size_t c = panel->order[i];
        order = hypot(z[2 * c], z[2 * c + 1]) / most;
        angle = order > 0 ? angle_on_page(t, panel, p, z, c) + (along ? 3.14159265358979323846 : 0) : 0;
        find_fill(angle, order, by_order, fill);
        put_cell(out, t, panel, c, fill);
        if (order >= FIELD_LEAST) put_rays(out, t, panel, p, z, c, along, fill);
    }
    fputs("</g>\n<g font-size=\"14\" stroke-width=\"1.4\">\n", out);
    put_defects(out, t, panel, p);
    fputs("</g>\n", out);
}

/* --- the page ----------------------------------------------------------------------------------------------------- */

/* Some angles and their hues, in a row that ends at `right`. */
static void put_hues(FILE *out, int p, double right, double y)
{
    enum { HUES = 5, HUE_WIDTH = 32 };
    const double turn = 6.283185307179586;
    double x, angle;
    int i, n, fill[3];
    fputs("<g id=\"hues\" stroke-linecap=\"round\">\n", out);
    for (i = 0; i < HUES; ++i) {
        x = right - HUE_WIDTH * (HUES - 0.5 - i);
        find_fill(turn * i / HUES, 1, 0, fill);
        begin_circle(out, x, y, 14);
        fprintf(out, " fill=\"#%02x%02x%02x\"/><path stroke=\"%s\" stroke-width=\"1.6\" d=\"", (unsigned)fill[0],
                (unsigned)fill[1], (unsigned)fill[2], ink_on(fill));
        for (n = 0; n < p; ++n) {
            angle = turn * (n + (double)i / HUES) / p;
            fputc('M', out);
            put_pixels(out, x);
            fputc(' ', out);
            put_pixels(out, y);
            fputc('L', out);
            put_pixels(out, x + 10 * cos(angle));
            fputc(' ', out);
            put_pixels(out, y - 10 * sin(angle));
        }
        fputs("\"/>\n", out);
    }
    fputs("</g>\n", out);
}

static void put_page(FILE *out, const patic *t, field_panel *panel, int panels, int p, const double *z, int by_order,
                     const options *o)
{
    int head = o->title ? FIELD_HEAD : 0, width = panels * FIELD_PANEL + (panels + 1) * FIELD_MARGIN, i;
    int height = head + (int)panel[0].height + 2 * FIELD_MARGIN + 2 * FIELD_TEXT;
    unsigned long plus = 0, minus = 0;
    double most = 0, mean = 0;
    size_t c;
    for (c = 0; c < t->defects; ++c) {
        plus += t->defect[c].k > 0;
        minus += t->defect[c].k < 0;
    }
    for (c = 0; c < t->cells; ++c) {
        most = fmax(most, hypot(z[2 * c], z[2 * c + 1]));
        mean += hypot(z[2 * c], z[2 * c + 1]) / (double)(t->measured + (t->measured == 0));
    }
    fprintf(out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" role=\"img\" "
            "aria-labelledby=\"title description\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"%d\">\n"
            "<title id=\"title\">",
            width, height, width, height, FIELD_TEXT);
    put_text(out, o->title ? o->title : "p-atic field", IN_XML);
    fprintf(
        out,
        "</title>\n<desc id=\"description\">%lu cells, filled by %s, with rays along the %d directions of each; %lu "
        "positive defects, black discs, and %lu negative ones, white discs.</desc>\n"
        "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n",
        (unsigned long)t->measured, by_order ? "order" : "the angle of the direction", p, plus, minus);
    if (o->title) {
        fprintf(out, "<text x=\"%d\" y=\"%d\" font-weight=\"bold\" fill=\"#222\">", FIELD_MARGIN, FIELD_MARGIN + 24);
        put_text(out, o->title, IN_XML);
        fputs("</text>\n", out);
    }
    for (i = 0; i < panels; ++i) put_panel(out, t, &panel[i], p, z, most > 0 ? most : 1, by_order, is_along(o));
    fprintf(out,
            "<g transform=\"translate(%d %d)\"><circle cx=\"8\" cy=\"-6\" r=\"7\"/><text x=\"22\">%lu</text>"
            "<circle cx=\"98\" cy=\"-6\" r=\"7\" fill=\"#fff\" stroke=\"#000\" stroke-width=\"1.4\"/>"
            "<text x=\"112\">%lu</text><text x=\"180\">p = %d, mean order ",
            FIELD_MARGIN, height - FIELD_MARGIN, plus, minus, p);
    put_decimals(out, mean, 3);
    if (by_order) {
        fputs(", yellow ", out);
        put_decimals(out, most, 3);
    }
    fputs("</text></g>\n", out);
    if (!by_order) put_hues(out, p, width - FIELD_MARGIN, height - FIELD_MARGIN - 6);
    fputs("</svg>\n", out);
}

/* Draws t->defects, too: after patic_defects. */
static void write_field(const patic *t, int p, const double *z, int by_order, const options *o)
{
    field_panel panel[MOST_VIEWS];
    camera eye[MOST_VIEWS];
    int i, k, panels = choose_views(t, o, eye), failed;
    double widest = 0, tallest = 0;
    FILE *out;
    for (i = 0; i < panels; ++i) {
        panel[i].eye = eye[i];
        panel[i].ring = NULL;
        panel[i].ring_room = 0;
        panel[i].order = (size_t *)resize(NULL, t->cells + 1, sizeof *panel[i].order);
        panel[i].depth = (double *)resize(NULL, t->cells + 1, sizeof *panel[i].depth);
        panel[i].left = FIELD_MARGIN + i * (FIELD_PANEL + FIELD_MARGIN);
        panel[i].top = FIELD_MARGIN + (o->title ? FIELD_HEAD : 0);
        begin_panel(t, &panel[i]);
        if (panel[i].seen == 0) continue;
        for (k = 0; k < 2; ++k) widest = fmax(widest, panel[i].high[k] - panel[i].low[k]);
        tallest = fmax(tallest, panel[i].high[1] - panel[i].low[1]);
    }
    for (i = 0; i < panels; ++i) {
        panel[i].scale = widest > 0 ? FIELD_PANEL / widest : 1;
        panel[i].height = ceil(fmin(FIELD_PANEL, tallest * panel[i].scale + 1));
        for (k = 0; k < 2; ++k) panel[i].middle[k] = panel[i].seen ? (panel[i].low[k] + panel[i].high[k]) / 2 : 0;
    }
    out = fopen(o->svg, "wb");
    if (!out) die("%s: %s", o->svg, strerror(errno));
    put_page(out, t, panel, panels, p, z, by_order, o);
    failed = ferror(out);
    if (fclose(out) != 0 || failed) die("%s: cannot write: %s", o->svg, strerror(errno));
    for (i = 0; i < panels; ++i) {
        free(panel[i].ring);
        free(panel[i].order);
        free(panel[i].depth);
    }
}

#endif
