/* chart.h - step 5 of the command, if asked for: the mu_p of all outlines -> histograms, or one rank over another. */
#ifndef SURFMINK_COMMAND_CHART_H
#define SURFMINK_COMMAND_CHART_H

#include "svg.h"

enum { BINS = 20, CHART_WIDTH = 330, CHART_HEIGHT = 210, CHART_LEFT = 98, CHART_FOOT = 74, CHART_HEAD = 30 };
enum { SCATTER_SIZE = 560 };

/* The mu_p of the measured outlines, of the ranks that the charts show. */
typedef struct chart {
    double *mu; /* as many as chart_ranks, an outline */
    size_t measured, refused;
    size_t mu_room;
    size_t *id; /* of each, where its text begins */
    size_t id_room;
    char *text;
    size_t text_length, text_room;
} chart;

/* --- what is shown ------------------------------------------------------------------------------------------------ */

/* Those of --color-by, else all up to 12. The last one may be on the scatter plot, too. */
static int chart_ranks(const options *o)
{
    if (o->colors > 0) return o->colors;
    return o->max_rank < MOST_COLORS ? o->max_rank : MOST_COLORS;
}

static int chart_rank(const options *o, int i)
{
    return o->colors > 0 ? o->color_by[i] : i + 1;
}

static void add_to_chart(chart *c, const char *id, const measure *m, const options *o)
{
    size_t ranks = (size_t)chart_ranks(o), length = strlen(id) + 1;
    int i;
    if (m->status != SURFMINK_OK) {
        ++c->refused;
        return;
    }
    c->mu = (double *)grow(c->mu, &c->mu_room, (c->measured + 1) * ranks, sizeof *c->mu);
    for (i = 0; i < chart_ranks(o); ++i) c->mu[c->measured * ranks + (size_t)i] = m->mu[chart_rank(o, i)];
    c->id = (size_t *)grow(c->id, &c->id_room, c->measured + 1, sizeof *c->id);
    c->text = (char *)grow(c->text, &c->text_room, c->text_length + length, 1);
    memcpy(c->text + c->text_length, id, length);
    c->id[c->measured++] = c->text_length;
    c->text_length += length;
}

static void free_chart(chart *c)
{
    free(c->mu);
    free(c->id);
    free(c->text);
}

static double chart_mu(const chart *c, const options *o, size_t i, int which)
{
    return c->mu[i * (size_t)chart_ranks(o) + (size_t)which];
}

/* --- axes --------------------------------------------------------------------------------------------------------- */

/* From 0 to 1, with a tick every 0.2 or so. The rank is written below, in the middle. */
static void draw_mu_axis(FILE *file, double left, double bottom, double width, int rank)
{
    axis a = {0, 0, 0, 'h', 6, {0, 25}, AT_MIDDLE, 5, 1, 0.2};
    a.x = left;
    a.y = bottom;
    a.length = width;
    put_axis(file, &a, 1);
    begin_text(file, left + width / 2, bottom + 54, AT_MIDDLE, "font-size=\"24\"");
    put_mu(file, rank);
    fputs("</text>\n", file);
}

/* From 0 to `most`. */
static void draw_count_axis(FILE *file, double left, double bottom, double height, double most, double step)
{
    axis a = {0, 0, 0, 'v', -6, {-10, 7}, AT_END, 0, 1, 0};
    a.x = left;
    a.y = bottom;
    a.length = -height;
    a.ticks = (int)(most / step + 0.5);
    a.step = step;
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

static int bin_of(double mu)
{
    int bin = (int)(BINS * mu);
    return bin < BINS ? bin : BINS - 1;
}

static void count_bins(const chart *c, const options *o, int which, size_t count[BINS])
{
    size_t i;
    for (i = 0; i < BINS; ++i) count[i] = 0;
    for (i = 0; i < c->measured; ++i) ++count[bin_of(chart_mu(c, o, i, which))];
}

static double median_of(const chart *c, const options *o, int which)
{
    double *values = (double *)resize(NULL, c->measured, sizeof *values), median;
    size_t i;
    for (i = 0; i < c->measured; ++i) values[i] = chart_mu(c, o, i, which);
    qsort(values, c->measured, sizeof *values, by_size);
    median = quantile(values, c->measured, 0.5);
    free(values);
    return median;
}

static void draw_bars(FILE *file, double left, double bottom, const size_t count[BINS], double most)
{
    double width = (double)CHART_WIDTH / BINS, height;
    int i;
    fputs("<g fill=\"#5b7fa6\" stroke=\"#fff\" stroke-width=\".8\">\n", file);
    for (i = 0; i < BINS; ++i) {
        if (count[i] == 0) continue;
        height = CHART_HEIGHT * (double)count[i] / most;
        begin_rect(file, left + i * width, bottom - height, width, height);
        fputs("><title>", file);
        put_decimals(file, (double)i / BINS, 2);
        fputs(" to ", file);
        put_decimals(file, (double)(i + 1) / BINS, 2);
        fprintf(file, ": %lu</title></rect>\n", (unsigned long)count[i]);
    }
    fputs("</g>\n", file);
}

/* A bar too low to be seen. */
static int is_faint(const size_t count[BINS], int bin, double most)
{
    return bin >= 0 && bin < BINS && count[bin] > 0 && CHART_HEIGHT * (double)count[bin] / most < 2;
}

/* A mark above each of them, with its count; upwards where counts have no room beside each other. */
static void name_faint_bars(FILE *file, double left, double bottom, const size_t count[BINS], double most)
{
    double width = (double)CHART_WIDTH / BINS, x;
    char text[32];
    int i;
    for (i = 0; i < BINS; ++i) {
        if (!is_faint(count, i, most)) continue;
        snprintf(text, sizeof text, "%lu", (unsigned long)count[i]);
        x = left + (i + 0.5) * width;
        fputs("<g font-size=\"16\"><path d=\"M", file);
        put_pixels(file, x);
        fputc(' ', file);
        put_pixels(file, bottom - 3);
        fputs("l-4 -8h8Z\"/>", file);
        if (strlen(text) > 1 && (is_faint(count, i - 1, most) || is_faint(count, i + 1, most)))
            put_upright(file, x + 6, bottom - 15, AT_START, text);
        else
            put_label(file, i > 0 ? x : left + 3, bottom - 15, i > 0 ? AT_MIDDLE : AT_START, text);
        fputs("</g>\n", file);
    }
}

/* The median as a dashed line, its value on the side where there is room. */
static void draw_median(FILE *file, double left, double bottom, double median)
{
    double x = left + CHART_WIDTH * median;
    int right = median < 0.6;
    fputs("<path fill=\"none\" stroke=\"#222\" stroke-width=\"2\" stroke-dasharray=\"7 4\" d=\"", file);
    put_line(file, x, bottom, 'v', -(CHART_HEIGHT + 8));
    fputs("\"/>\n", file);
    begin_text(file, right ? x + 7 : x - 7, bottom - CHART_HEIGHT - 1, right ? AT_START : AT_END, "font-size=\"18\"");
    fputs("median ", file);
    put_decimals(file, median, 2);
    fputs("</text>\n", file);
}

static void draw_histogram(FILE *file, const chart *c, const options *o, int which, double left, double top)
{
    size_t count[BINS], highest = 1, i;
    double bottom = top + CHART_HEAD + CHART_HEIGHT, step, most;
    count_bins(c, o, which, count);
    for (i = 0; i < BINS; ++i)
        if (count[i] > highest) highest = count[i];
    step = fmax(1, round_step((double)highest / 2.5));
    most = step * ceil((double)highest / step);
    draw_bars(file, left, bottom, count, most);
    fputs("<g fill=\"#222\">\n", file);
    draw_count_axis(file, left, bottom, CHART_HEIGHT, most, step);
    put_upright(file, left - CHART_LEFT + 24, bottom - 0.5 * CHART_HEIGHT, AT_MIDDLE, "outlines");
    draw_mu_axis(file, left, bottom, CHART_WIDTH, chart_rank(o, which));
    name_faint_bars(file, left, bottom, count, most);
    if (chart_ranks(o) > 1) put_letter(file, left - CHART_LEFT + 6, top + 10, which);
    if (c->measured > 0) draw_median(file, left, bottom, median_of(c, o, which));
    fputs("</g>\n", file);
}

static void write_histograms(const chart *c, const options *o)
{
    FILE *file = open_page(o->histogram);
    int ranks = chart_ranks(o),
        columns = ranks == 4  ? 2
                  : ranks < 3 ? ranks
                              : 3,
        rows = (ranks + columns - 1) / columns, i;
    int wide = CHART_LEFT + CHART_WIDTH + 26, high = CHART_HEAD + CHART_HEIGHT + CHART_FOOT;
    int width = 2 * MARGIN + columns * wide, height = 2 * MARGIN + title_space(o) + rows * high;
    begin_page(file, width, height, o, "Histograms of the p-fold symmetry of outlines");
    fprintf(file,
            "How many of %lu outlines have which mu_p, 0 to 1 in %d steps, for each rank p; dashed: the median. %lu "
            "outlines were refused. Drawn by surfmink " SURFMINK_VERSION ".",
            (unsigned long)c->measured, BINS, (unsigned long)c->refused);
    end_description(file, width, o);
    for (i = 0; i < ranks; ++i) {
        int column = i % columns, row = i / columns;
        draw_histogram(file, c, o, i, MARGIN + CHART_LEFT + column * wide, MARGIN + title_space(o) + row * high);
    }
    fputs("</svg>\n", file);
    close_page(file, o->histogram);
}

/* --- one rank over another ---------------------------------------------------------------------------------------- */

/* Which of the ranks of the chart lie on the axes. */
static void scatter_axes(const options *o, int which[2])
{
    which[0] = o->colors > 0 || o->max_rank < 3 ? 0 : 1;
    which[1] = o->colors > 0 ? 1 : chart_ranks(o) - 1;
}

/* Pearson's coefficient; 0 if there is no spread. */
static double correlation(const chart *c, const options *o, const int which[2])
{
    double mean[2] = {0, 0}, xx = 0, xy = 0, yy = 0, x, y;
    size_t i;
    for (i = 0; i < c->measured; ++i) {
        mean[0] += chart_mu(c, o, i, which[0]) / (double)c->measured;
        mean[1] += chart_mu(c, o, i, which[1]) / (double)c->measured;
    }
    for (i = 0; i < c->measured; ++i) {
        x = chart_mu(c, o, i, which[0]) - mean[0];
        y = chart_mu(c, o, i, which[1]) - mean[1];
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    return xx > 1e-24 && yy > 1e-24 ? xy / sqrt(xx * yy) : 0;
}

static void draw_points(FILE *file, const chart *c, const options *o, const int which[2], double left, double bottom)
{
    size_t i;
    double radius = c->measured > 2000 ? 2.5 : 4.5;
    fprintf(file, "<g fill=\"#1f4e79\" fill-opacity=\"%s\" stroke=\"#fff\" stroke-width=\".6\">\n",
            c->measured > 2000 ? ".4" : ".75");
    for (i = 0; i < c->measured; ++i) {
        double x = chart_mu(c, o, i, which[0]), y = chart_mu(c, o, i, which[1]);
        begin_circle(file, left + SCATTER_SIZE * x, bottom - SCATTER_SIZE * y, radius);
        fputs("><title>", file);
        put_text(file, c->text + c->id[i], IN_XML);
        fputs(": ", file);
        put_decimals(file, x, 4);
        fputs(", ", file);
        put_decimals(file, y, 4);
        fputs("</title></circle>\n", file);
    }
    fputs("</g>\n", file);
}

static void draw_scatter_axes(FILE *file, const options *o, const int which[2], double left, double bottom)
{
    int i;
    fputs("<path fill=\"none\" stroke=\"#d9dee4\" d=\"", file);
    for (i = 1; i <= 5; ++i) {
        put_line(file, left, bottom - SCATTER_SIZE * i / 5.0, 'h', SCATTER_SIZE);
        put_line(file, left + SCATTER_SIZE * i / 5.0, bottom, 'v', -SCATTER_SIZE);
    }
    fputs("\"/>\n<g fill=\"#222\">\n", file);
    draw_mu_axis(file, left, bottom, SCATTER_SIZE, chart_rank(o, which[0]));
    draw_count_axis(file, left, bottom, SCATTER_SIZE, 1, 0.2);
    begin_text(file, left - 74, bottom - SCATTER_SIZE / 2.0 + 8, AT_START, "font-size=\"24\"");
    put_mu(file, chart_rank(o, which[1]));
    fputs("</text>\n</g>\n", file);
}

/* What the axes do not say, outside of them. */
static void draw_correlation(FILE *file, const chart *c, double r, double right, double top)
{
    fputs("<g fill=\"#222\">", file);
    begin_text(file, right, top, AT_END, "");
    fprintf(file, "<tspan font-style=\"italic\">n</tspan> = %lu, <tspan font-style=\"italic\">r</tspan> = %s",
            (unsigned long)c->measured, r <= -0.005 ? "\xe2\x88\x92" : "");
    put_decimals(file, fabs(r), 2);
    fputs("</text></g>\n", file);
}

static void write_scatter(const chart *c, const options *o)
{
    FILE *file = open_page(o->scatter);
    int which[2], width = 2 * MARGIN + 90 + SCATTER_SIZE + 16;
    int height = 2 * MARGIN + title_space(o) + 30 + SCATTER_SIZE + CHART_FOOT - 10;
    double left = MARGIN + 90, bottom = MARGIN + title_space(o) + 30 + SCATTER_SIZE, r;
    scatter_axes(o, which);
    r = correlation(c, o, which);
    begin_page(file, width, height, o, "Two ranks of the p-fold symmetry of outlines");
    fprintf(file,
            "mu_%d (up) over mu_%d (right), both 0 to 1, of %lu outlines; %lu outlines were refused. n: outlines, r: "
            "correlation coefficient (Pearson). Drawn by surfmink " SURFMINK_VERSION ".",
            chart_rank(o, which[1]), chart_rank(o, which[0]), (unsigned long)c->measured, (unsigned long)c->refused);
    end_description(file, width, o);
    draw_scatter_axes(file, o, which, left, bottom);
    draw_points(file, c, o, which, left, bottom);
    draw_correlation(file, c, r, left + SCATTER_SIZE, bottom - SCATTER_SIZE - 12);
    fputs("</svg>\n", file);
    close_page(file, o->scatter);
}

#endif
