/* chart.h - step 5 of the command, if asked for: columns of the results -> histograms, or one column over another. */
#ifndef SURFMINK_COMMAND_CHART_H
#define SURFMINK_COMMAND_CHART_H

#include "svg.h"

enum { BINS = 20, MOST_BINS = 40, CHART_WIDTH = 330, CHART_HEIGHT = 260 };
enum { CHART_LEFT = 98, CHART_FOOT = 74, CHART_HEAD = 30, SCATTER_SIZE = 560 };

/* The columns of the measured outlines that the charts show. */
typedef struct chart {
    double *value; /* as many as chart_columns, an outline */
    size_t measured, refused;
    size_t value_room;
    size_t *id; /* of each, where its text begins */
    size_t id_room;
    char *text;
    size_t text_length, text_room;
} chart;

/* --- what is shown ------------------------------------------------------------------------------------------------ */

/* Those of the histograms come first, then the two of the scatter plot. */
static int chart_columns(const options *o)
{
    return o->histogram_of.count + o->scatter_of.count;
}

static void add_to_chart(chart *c, const char *id, const measure *m, const pick *picked, const options *o)
{
    size_t columns = (size_t)chart_columns(o), length = strlen(id) + 1, i;
    if (m->status != SURFMINK_OK) {
        ++c->refused;
        return;
    }
    c->value = (double *)grow(c->value, &c->value_room, (c->measured + 1) * columns, sizeof *c->value);
    for (i = 0; i < columns; ++i) c->value[c->measured * columns + i] = picked[i].value;
    c->id = (size_t *)grow(c->id, &c->id_room, c->measured + 1, sizeof *c->id);
    c->text = (char *)grow(c->text, &c->text_room, c->text_length + length, 1);
    memcpy(c->text + c->text_length, id, length);
    c->id[c->measured++] = c->text_length;
    c->text_length += length;
}

static void free_chart(chart *c)
{
    free(c->value);
    free(c->id);
    free(c->text);
}

/* NaN where it is undefined. */
static double chart_value(const chart *c, const options *o, size_t i, int column)
{
    return c->value[i * (size_t)chart_columns(o) + (size_t)column];
}

/* From the least to the greatest value of a column, and how many there are. */
typedef struct extent {
    double least, most;
    size_t count;
    int whole; /* are all of them whole numbers? */
} extent;

static extent extent_of(const chart *c, const options *o, int column)
{
    extent e = {HUGE_VAL, -HUGE_VAL, 0, 1};
    size_t i;
    for (i = 0; i < c->measured; ++i) {
        double value = chart_value(c, o, i, column);
        if (isnan(value)) continue;
        ++e.count;
        e.least = fmin(e.least, value);
        e.most = fmax(e.most, value);
        e.whole = e.whole && !(floor(value) < value);
    }
    return e;
}

static range chart_range(const quantity *q, const extent *e)
{
    range all = {0, 1, 0.2, 0};
    if (is_of(q, "mu")) return all;
    return is_of(q, "theta") ? range_of_theta(q->rank) : range_of_values(e->least, e->most);
}

static double share_of(const range *r, double value)
{
    return (value - r->low) / (r->high - r->low);
}

/* A value in a text: mu_p with its usual number of decimals. */
static void put_value_of(FILE *file, const quantity *q, double value, int decimals)
{
    char text[32];
    if (is_of(q, "mu"))
        put_decimals(file, value, decimals);
    else
        fwrite(text, 1, (size_t)(write_number(NULL, text, decimals + 1, value) - text), file);
}

/* --- axes --------------------------------------------------------------------------------------------------------- */

/* To the right. The first and last tick may stand a little inside. The name is written below, in the middle. */
static void draw_value_axis(FILE *file, double left, double bottom, double width, double inset, const range *r,
                            const quantity *q)
{
    axis a = {0, 0, 0, 'h', 6, {0, 25}, AT_MIDDLE, 0, 1, 0, 0, 0};
    a.x = left + inset;
    a.y = bottom;
    a.length = width - 2 * inset;
    a.ticks = range_ticks(r);
    a.step = r->step;
    a.from = r->low;
    a.turn = r->turn;
    while (a.ticks / a.every > 9) ++a.every;
    fputs("<path fill=\"none\" stroke=\"#222\" d=\"", file);
    put_line(file, left, bottom, 'h', width);
    fputs("\"/>\n", file);
    put_axis(file, &a, 0);
    begin_text(file, left + width / 2, bottom + 54, AT_MIDDLE, "font-size=\"24\"");
    put_quantity(file, q);
    fputs("</text>\n", file);
}

/* Upwards. */
static void draw_upward_axis(FILE *file, double left, double bottom, double height, const range *r)
{
    axis a = {0, 0, 0, 'v', -6, {-10, 7}, AT_END, 0, 1, 0, 0, 0};
    a.x = left;
    a.y = bottom;
    a.length = -height;
    a.ticks = range_ticks(r);
    a.step = r->step;
    a.from = r->low;
    a.turn = r->turn;
    put_axis(file, &a, 1);
}

/* Reads upwards. */
static void put_upright(FILE *file, double x, double y, enum anchor anchor, const char *text)
{
    fputs("<g transform=\"translate(", file);
    put_pixels(file, x);
    fputc(' ', file);
    put_pixels(file, y);
    fputs(") rotate(-90)\">", file);
    put_label(file, 0, 0, anchor, text);
    fputs("</g>\n", file);
}

/* --- histograms --------------------------------------------------------------------------------------------------- */

/* One histogram. */
typedef struct histogram {
    const quantity *what;
    extent extent;
    range range, ticks; /* of all bins, of the ticks below them */
    int bins;
    size_t count[MOST_BINS];
    double left, bottom; /* pixels */
    double most, step;   /* the end of the upward axis, and from tick to tick */
} histogram;

/* Whole numbers, if there is room, have a bar each; other bars begin and end at round numbers. */
static void choose_bins(histogram *h)
{
    const extent *e = &h->extent;
    h->range = h->ticks = chart_range(h->what, e);
    h->bins = BINS;
    if (is_of(h->what, "mu") || is_of(h->what, "theta")) return;
    if (e->count > 0 && e->whole && e->most - e->least < MOST_BINS) {
        h->bins = (int)(e->most - e->least) + 1;
        h->ticks.low = e->least;
        h->ticks.high = e->most;
        h->ticks.step = 1;
        h->range.low = e->least - 0.5;
        h->range.high = e->most + 0.5;
        return;
    }
    h->bins = range_ticks(&h->range) * (range_ticks(&h->range) < 6 ? 5 : 2);
}

static void count_bins(histogram *h, const chart *c, const options *o, int column)
{
    size_t i, highest = 1;
    int bin;
    for (bin = 0; bin < MOST_BINS; ++bin) h->count[bin] = 0;
    for (i = 0; i < c->measured; ++i) {
        double value = chart_value(c, o, i, column);
        if (isnan(value)) continue;
        bin = (int)(h->bins * share_of(&h->range, value));
        ++h->count[bin < h->bins ? bin : h->bins - 1];
    }
    for (bin = 0; bin < h->bins; ++bin)
        if (h->count[bin] > highest) highest = h->count[bin];
    h->step = fmax(1, round_step((double)highest / 2.5));
    h->most = h->step * ceil((double)highest / h->step);
}

static double edge_of(const histogram *h, int bin)
{
    return h->range.low + (h->range.high - h->range.low) * bin / h->bins;
}

static double median_of(const chart *c, const options *o, int column, size_t count)
{
    double *values = (double *)resize(NULL, count, sizeof *values), median;
    size_t i, n = 0;
    for (i = 0; i < c->measured; ++i) {
        double value = chart_value(c, o, i, column);
        if (!isnan(value)) values[n++] = value;
    }
    qsort(values, n, sizeof *values, by_size);
    median = quantile(values, n, 0.5);
    free(values);
    return median;
}

static void draw_bars(FILE *file, const histogram *h)
{
    double width = (double)CHART_WIDTH / h->bins, height;
    int i;
    fputs("<g fill=\"#5b7fa6\" stroke=\"#fff\" stroke-width=\".8\">\n", file);
    for (i = 0; i < h->bins; ++i) {
        if (h->count[i] == 0) continue;
        height = CHART_HEIGHT * (double)h->count[i] / h->most;
        begin_rect(file, h->left + i * width, h->bottom - height, width, height);
        fputs("><title>", file);
        put_value_of(file, h->what, edge_of(h, i), 2);
        fputs(" to ", file);
        put_value_of(file, h->what, edge_of(h, i + 1), 2);
        fprintf(file, ": %lu</title></rect>\n", (unsigned long)h->count[i]);
    }
    fputs("</g>\n", file);
}

/* A bar too low to be seen. */
static int is_faint(const histogram *h, int bin)
{
    return bin >= 0 && bin < h->bins && h->count[bin] > 0 && CHART_HEIGHT * (double)h->count[bin] / h->most < 3;
}

/* A mark above each of them, with its count; upwards where counts have no room beside each other. */
static void name_faint_bars(FILE *file, const histogram *h)
{
    double width = (double)CHART_WIDTH / h->bins, x;
    char text[32];
    int i;
    for (i = 0; i < h->bins; ++i) {
        if (!is_faint(h, i)) continue;
        snprintf(text, sizeof text, "%lu", (unsigned long)h->count[i]);
        x = h->left + (i + 0.5) * width;
        fputs("<g font-size=\"16\"><path d=\"M", file);
        put_pixels(file, x);
        fputc(' ', file);
        put_pixels(file, h->bottom - 3);
        fputs("l-4 -8h8Z\"/>", file);
        if (strlen(text) > 1 && (is_faint(h, i - 1) || is_faint(h, i + 1)))
            put_upright(file, x + 6, h->bottom - 15, AT_START, text);
        else
            put_label(file, i > 0 ? x : h->left + 3, h->bottom - 15, i > 0 ? AT_MIDDLE : AT_START, text);
        fputs("</g>\n", file);
    }
}

/* The median as a dashed line, its value on the side where there is room. */
static void draw_median(FILE *file, const histogram *h, double median)
{
    double share = share_of(&h->range, median), x = h->left + CHART_WIDTH * share, y = h->bottom - CHART_HEIGHT;
    int right = share < 0.6;
    fputs("<path fill=\"none\" stroke=\"#222\" stroke-width=\"2\" stroke-dasharray=\"7 4\" d=\"", file);
    put_line(file, x, h->bottom, 'v', -(CHART_HEIGHT + 8));
    fputs("\"/>\n", file);
    begin_text(file, right ? x + 7 : x - 7, y - 1, right ? AT_START : AT_END, "font-size=\"18\"");
    fputs("median ", file);
    put_value_of(file, h->what, median, 2);
    fputs("</text>\n", file);
}

/* What the bars count, along the upward axis, in letters that it has room for. */
static void draw_count_label(FILE *file, const histogram *h)
{
    char text[64];
    snprintf(text, sizeof text, "number of outlines, n = %lu", (unsigned long)h->extent.count);
    fputs("<g font-size=\"", file);
    put_pixels(file, fmin(TEXT_SIZE, TEXT_SIZE * (CHART_HEIGHT + CHART_HEAD) / text_width(text)));
    fputs("\">", file);
    put_upright(file, h->left - CHART_LEFT + 24, h->bottom - 0.5 * CHART_HEIGHT, AT_MIDDLE, text);
    fputs("</g>\n", file);
}

static void draw_histogram(FILE *file, const chart *c, const options *o, int column, double left, double top)
{
    histogram h;
    range counts = {0, 0, 0, 0};
    double inset;
    h.what = &o->histogram_of.of[column];
    h.extent = extent_of(c, o, column);
    h.left = left;
    h.bottom = top + CHART_HEAD + CHART_HEIGHT;
    choose_bins(&h);
    count_bins(&h, c, o, column);
    counts.high = h.most;
    counts.step = h.step;
    inset = CHART_WIDTH * share_of(&h.range, h.ticks.low);
    draw_bars(file, &h);
    fputs("<g fill=\"#222\">\n", file);
    draw_upward_axis(file, left, h.bottom, CHART_HEIGHT, &counts);
    draw_count_label(file, &h);
    draw_value_axis(file, left, h.bottom, CHART_WIDTH, inset, &h.ticks, h.what);
    name_faint_bars(file, &h);
    if (o->histogram_of.count > 1) put_letter(file, left - CHART_LEFT + 6, top + 10, column);
    if (h.extent.count > 0 && !h.range.turn) draw_median(file, &h, median_of(c, o, column, h.extent.count));
    fputs("</g>\n", file);
}

static void write_histograms(const chart *c, const options *o)
{
    FILE *file = open_page(o->histogram);
    int count = o->histogram_of.count, columns = count == 4 ? 2 : count < 3 ? count : 3;
    int rows = (count + columns - 1) / columns, i;
    int wide = CHART_LEFT + CHART_WIDTH + 26, high = CHART_HEAD + CHART_HEIGHT + CHART_FOOT;
    int width = 2 * MARGIN + columns * wide, height = 2 * MARGIN + title_space(o) + rows * high;
    begin_page(file, width, height, o, "Histograms of the p-fold symmetry of outlines");
    fprintf(file, "How many of %lu outlines have which", (unsigned long)c->measured);
    for (i = 0; i < count; ++i) {
        fputs(i > 0 ? ", " : " ", file);
        put_text(file, o->histogram_of.of[i].name, IN_XML);
    }
    fprintf(file, "; dashed: the median. %lu outlines were refused. Drawn by surfmink " SURFMINK_VERSION ".",
            (unsigned long)c->refused);
    end_description(file, width, o);
    for (i = 0; i < count; ++i) {
        int column = i % columns, row = i / columns;
        draw_histogram(file, c, o, i, MARGIN + CHART_LEFT + column * wide, MARGIN + title_space(o) + row * high);
    }
    fputs("</svg>\n", file);
    close_page(file, o->histogram);
}

/* --- one column over another -------------------------------------------------------------------------------------- */

/* The two columns: to the right, and up. */
typedef struct scatter {
    const quantity *what[2];
    range range[2];
    int column[2]; /* of the chart */
    size_t count;  /* outlines that have both */
    double left, bottom;
} scatter;

/* Both values of an outline; 0 if one of them is undefined. */
static int find_point(const scatter *s, const chart *c, const options *o, size_t i, double value[2])
{
    value[0] = chart_value(c, o, i, s->column[0]);
    value[1] = chart_value(c, o, i, s->column[1]);
    return !isnan(value[0]) && !isnan(value[1]);
}

/* Pearson's coefficient, of shares of the axes: no unit can overflow; 0 if there is no spread. */
static double correlation(const scatter *s, const chart *c, const options *o)
{
    double mean[2] = {0, 0}, xx = 0, xy = 0, yy = 0, v[2], x, y;
    size_t i;
    for (i = 0; i < c->measured; ++i) {
        if (!find_point(s, c, o, i, v)) continue;
        mean[0] += share_of(&s->range[0], v[0]) / (double)s->count;
        mean[1] += share_of(&s->range[1], v[1]) / (double)s->count;
    }
    for (i = 0; i < c->measured; ++i) {
        if (!find_point(s, c, o, i, v)) continue;
        x = share_of(&s->range[0], v[0]) - mean[0];
        y = share_of(&s->range[1], v[1]) - mean[1];
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    return xx > 1e-24 && yy > 1e-24 ? xy / sqrt(xx * yy) : 0;
}

static void draw_points(FILE *file, const scatter *s, const chart *c, const options *o)
{
    size_t i;
    double radius = c->measured > 2000 ? 2.5 : 4.5, v[2];
    fprintf(file, "<g fill=\"#1f4e79\" fill-opacity=\"%s\" stroke=\"#fff\" stroke-width=\".6\">\n",
            c->measured > 2000 ? ".4" : ".75");
    for (i = 0; i < c->measured; ++i) {
        if (!find_point(s, c, o, i, v)) continue;
        begin_circle(file, s->left + SCATTER_SIZE * share_of(&s->range[0], v[0]),
                     s->bottom - SCATTER_SIZE * share_of(&s->range[1], v[1]), radius);
        fputs("><title>", file);
        put_text(file, c->text + c->id[i], IN_XML);
        fputs(": ", file);
        put_value_of(file, s->what[0], v[0], 4);
        fputs(", ", file);
        put_value_of(file, s->what[1], v[1], 4);
        fputs("</title></circle>\n", file);
    }
    fputs("</g>\n", file);
}

static void draw_scatter_axes(FILE *file, const scatter *s)
{
    int i, ticks[2];
    ticks[0] = range_ticks(&s->range[0]);
    ticks[1] = range_ticks(&s->range[1]);
    fputs("<path fill=\"none\" stroke=\"#d9dee4\" d=\"", file);
    for (i = 0; i <= ticks[1]; ++i)
        put_line(file, s->left, s->bottom - SCATTER_SIZE * (double)i / ticks[1], 'h', SCATTER_SIZE);
    for (i = 0; i <= ticks[0]; ++i)
        put_line(file, s->left + SCATTER_SIZE * (double)i / ticks[0], s->bottom, 'v', -SCATTER_SIZE);
    fputs("\"/>\n<g fill=\"#222\">\n", file);
    draw_value_axis(file, s->left, s->bottom, SCATTER_SIZE, 0, &s->range[0], s->what[0]);
    draw_upward_axis(file, s->left, s->bottom, SCATTER_SIZE, &s->range[1]);
    fputs("<g font-size=\"24\" transform=\"translate(", file);
    put_pixels(file, s->left - 74);
    fputc(' ', file);
    put_pixels(file, s->bottom - SCATTER_SIZE / 2.0);
    fputs(quantity_letters(s->what[1]) < 4 ? ")\">" : ") rotate(-90)\">", file);
    begin_text(file, 0, 8, AT_MIDDLE, "");
    put_quantity(file, s->what[1]);
    fputs("</text></g>\n</g>\n", file);
}

/* What the axes do not say, outside of them. */
static void draw_correlation(FILE *file, const scatter *s, double r)
{
    fputs("<g fill=\"#222\">", file);
    begin_text(file, s->left + SCATTER_SIZE, s->bottom - SCATTER_SIZE - 12, AT_END, "");
    fprintf(file, "<tspan font-style=\"italic\">n</tspan> = %lu, <tspan font-style=\"italic\">r</tspan> = %s",
            (unsigned long)s->count, r <= -0.005 ? "\xe2\x88\x92" : "");
    put_decimals(file, fabs(r), 2);
    fputs("</text></g>\n", file);
}

static void write_scatter(const chart *c, const options *o)
{
    FILE *file = open_page(o->scatter);
    int width = 2 * MARGIN + 90 + SCATTER_SIZE + 16, k;
    int height = 2 * MARGIN + title_space(o) + 30 + SCATTER_SIZE + CHART_FOOT - 10;
    double v[2];
    scatter s;
    size_t i;
    s.left = MARGIN + 90;
    s.bottom = MARGIN + title_space(o) + 30 + SCATTER_SIZE;
    s.count = 0;
    for (k = 0; k < 2; ++k) {
        extent e = extent_of(c, o, s.column[k] = o->histogram_of.count + k);
        s.what[k] = &o->scatter_of.of[k];
        s.range[k] = chart_range(s.what[k], &e);
    }
    for (i = 0; i < c->measured; ++i) s.count += find_point(&s, c, o, i, v) ? 1 : 0;
    begin_page(file, width, height, o, "Two columns of the p-fold symmetry of outlines");
    put_text(file, s.what[1]->name, IN_XML);
    fputs(" (up) over ", file);
    put_text(file, s.what[0]->name, IN_XML);
    fprintf(file,
            " (right), of %lu outlines; %lu outlines were refused. n: outlines, r: correlation coefficient (Pearson). "
            "Drawn by surfmink " SURFMINK_VERSION ".",
            (unsigned long)s.count, (unsigned long)c->refused);
    end_description(file, width, o);
    draw_scatter_axes(file, &s);
    draw_points(file, &s, c, o);
    draw_correlation(file, &s, correlation(&s, c, o));
    fputs("</svg>\n", file);
    close_page(file, o->scatter);
}

#endif
