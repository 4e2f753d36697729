/* field.h - the picture of a p-atic field: cells filled by hue or by order, rays along the directions, defects.

   A direction needs something to be measured from. Here it is what points to the right on the page, carried from the
   eye to the cell by the smallest rotation, so a hue says how the rays lie on the page. Hues go once round for 1/p of
   a turn. Defects are told apart without colour: a black disc with a plus, a white one with a minus; a charge of k/p
   has k - 1 rings more, and where there are few it is printed. */
#ifndef SURFMINK_COMMAND_FIELD_H
#define SURFMINK_COMMAND_FIELD_H

#include "../picture/camera.h"
#include "common.h"
#include "options.h"

/* Pixels. Charges are printed beside fewer than LABELLED defects of a panel. */
enum { FIELD_MARGIN = 20, FIELD_PANEL = 620, FIELD_TEXT = 20, FIELD_HEAD = 44, LABELLED = 25 };

typedef struct field_panel {
    camera eye;
    double left, top;                /* of the panel on the page */
    double height, scale, middle[2]; /* pixels a unit; what is seen in the middle */
    double low[2], high[2];          /* of what is seen */
    size_t seen;                     /* cells */
    size_t *order;                   /* cells from back to front */
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

/* A colour of equal lightness for every angle, mixed with white where the order is low; or a grey-safe scale of
   order. */
static void put_fill(FILE *out, double angle, double order, int by_order)
{
    static const double third = 2.0943951023931953;
    int k, part[3];
    for (k = 0; k < 3; ++k) {
        double full = 0.62 + 0.36 * cos(angle - third * k), share = fmin(1, 0.25 + 0.75 * sqrt(order));
        if (by_order)
            full = k == 0 ? 0.17 + 0.8 * order : k == 1 ? 0.13 + 0.78 * order : 0.38 + 0.18 * order, share = 1;
        part[k] = (int)(255 * fmin(1, fmax(0, share * full + 1 - share)) + 0.5);
    }
    fprintf(out, "#%02x%02x%02x", (unsigned)part[0], (unsigned)part[1], (unsigned)part[2]);
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

static void put_cell(FILE *out, const patic *t, const field_panel *panel, int p, const double *z, size_t c, double most,
                     int by_order)
{
    double order = hypot(z[2 * c], z[2 * c + 1]) / most, x[3], page[2];
    size_t h;
    for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
        field_corner(t, h, x);
        place_on_page(panel, x, page);
        fputs(h == t->offset[c] ? "<path d=\"M" : "L", out);
        put_place(out, page);
    }
    fputs("Z\" fill=\"", out);
    put_fill(out, order > 0 ? angle_on_page(t, panel, p, z, c) : 0, order, by_order);
    fputs("\"/>\n", out);
}

/* Rays along all p directions, as long as a third of the cell is wide; shorter where the order is less. */
static void put_rays(FILE *out, const patic *t, const field_panel *panel, int p, const double *z, size_t c, double most)
{
    const patic_cell *cell = &t->cell[c];
    double order = hypot(z[2 * c], z[2 * c + 1]) / most, size, psi, x[3], page[2];
    int n, k;
    if (!(order > 0)) return;
    size = cell->length / 9 * (0.35 + 0.65 * sqrt(order));
    for (n = 0; n < p; ++n) {
        psi = (atan2(z[2 * c + 1], z[2 * c]) + 2 * 3.14159265358979323846 * n) / p;
        place_on_page(panel, cell->centre, page);
        fputc('M', out);
        put_place(out, page);
        for (k = 0; k < 3; ++k) x[k] = cell->centre[k] + size * (cos(psi) * cell->axis[k] + sin(psi) * cell->across[k]);
        place_on_page(panel, x, page);
        fputc('L', out);
        put_place(out, page);
    }
}

static int is_in_front(const patic *t, const field_panel *panel, const patic_defect *d)
{
    size_t c = d->core == PATIC_NONE ? t->owner[t->loop[d->loop].first] : d->core;
    return dot(t->cell[c].normal, panel->eye.eye) > 0;
}

static void put_defect(FILE *out, const field_panel *panel, int p, const patic_defect *d, double size, int labelled)
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
        page[1] += size / 2;
    }
    fputs("\"/>\n", out);
    if (!labelled) return;
    fputs("<text x=\"", out);
    put_decimals(out, fmax(0, page[0] + size + 4), 1);
    fputs("\" y=\"", out);
    put_decimals(out, fmax(0, page[1] + 6), 1);
    fprintf(out, "\" stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\">%s%ld/%d</text>\n",
            d->k > 0 ? "+" : "\xe2\x88\x92", many, p);
}

static void put_panel(FILE *out, const patic *t, const field_panel *panel, int p, const double *z, double most,
                      int by_order)
{
    size_t i, defects = 0;
    double size = fmin(9, fmax(3, 0.22 * t->spacing * panel->scale));
    fputs("<g stroke=\"#fff\" stroke-width=\".7\" stroke-linejoin=\"round\">\n", out);
    for (i = 0; i < panel->seen; ++i) put_cell(out, t, panel, p, z, panel->order[i], most, by_order);
    fprintf(out, "</g>\n<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.1\" d=\"", by_order ? "#fff" : "#222");
    for (i = 0; i < panel->seen; ++i) put_rays(out, t, panel, p, z, panel->order[i], most);
    fputs("M0 0\"/>\n<g font-size=\"14\" stroke-width=\"1.4\">\n", out);
    for (i = 0; i < t->defects; ++i) defects += is_in_front(t, panel, &t->defect[i]) ? 1 : 0;
    for (i = 0; i < t->defects; ++i)
        if (is_in_front(t, panel, &t->defect[i])) put_defect(out, panel, p, &t->defect[i], size, defects < LABELLED);
    fputs("</g>\n", out);
}

/* --- the page ----------------------------------------------------------------------------------------------------- */

static void put_page(FILE *out, const patic *t, const field_panel *panel, int panels, int p, const double *z,
                     int by_order, const options *o)
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
    for (i = 0; i < panels; ++i) put_panel(out, t, &panel[i], p, z, most > 0 ? most : 1, by_order);
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
    fputs("</text></g>\n</svg>\n", out);
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
        free(panel[i].order);
        free(panel[i].depth);
    }
}

#endif
