/* summary.h - step 5 of the command, if asked for: the measures of all polygons -> a few lines about them. */
#ifndef SURFMINK_COMMAND_SUMMARY_H
#define SURFMINK_COMMAND_SUMMARY_H

#include "measure.h"

typedef struct summary {
    double *mu;    /* P a measured polygon */
    double *worst; /* P + 1: largest estimates of errors */
    int errors;    /* are there any? */
    size_t room;
    size_t measured, refused;
    size_t *dominant; /* P + 1: how many outlines have this dominant rank */
} summary;

static void begin_summary(summary *s, int max_rank)
{
    int p;
    memset(s, 0, sizeof *s);
    s->dominant = (size_t *)resize(NULL, (size_t)max_rank + 1, sizeof *s->dominant);
    s->worst = (double *)resize(NULL, (size_t)max_rank + 1, sizeof *s->worst);
    for (p = 0; p <= max_rank; ++p) s->dominant[p] = 0;
    for (p = 0; p <= max_rank; ++p) s->worst[p] = 0;
}

static void end_summary(summary *s)
{
    free(s->mu);
    free(s->worst);
    free(s->dominant);
}

/* The p >= 2 with the largest mu_p. A square has mu_4 = mu_8 = 1 up to rounding: the smallest such p counts. */
static int dominant_rank(const double *mu, int max_rank)
{
    int p, best = 2;
    for (p = 3; p <= max_rank; ++p)
        if (mu[p] > mu[best] + 1e-12) best = p;
    return best;
}

static void add_to_summary(summary *s, const measure *m, int max_rank)
{
    size_t ranks = (size_t)max_rank;
    int p;
    if (m->status != SURFMINK_OK) {
        ++s->refused;
        return;
    }
    s->mu = (double *)grow(s->mu, &s->room, (s->measured + 1) * ranks, sizeof *s->mu);
    memcpy(s->mu + s->measured * ranks, m->mu + 1, ranks * sizeof *s->mu);
    ++s->measured;
    for (p = 0; p <= max_rank && m->error; ++p)
        if (m->error[p] > s->worst[p]) s->worst[p] = m->error[p];
    if (m->error) s->errors = 1;
    if (max_rank >= 2) ++s->dominant[dominant_rank(m->mu, max_rank)];
}

static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Between the sorted values: linear, so that the quantile 0 is the least and 1 the greatest. */
static double quantile(const double *sorted, size_t n, double fraction)
{
    double place = fraction * (double)(n - 1);
    size_t below = (size_t)place, above = below + 1 < n ? below + 1 : below;
    return sorted[below] + (place - (double)below) * (sorted[above] - sorted[below]);
}

static void put_column(double value)
{
    fputs("  ", stderr);
    put_decimals(stderr, value, 6);
}

static void summarize_rank(const summary *s, int p, int max_rank, double *values)
{
    size_t i, n = s->measured;
    double mean = 0, squares = 0;
    for (i = 0; i < n; ++i) values[i] = s->mu[i * (size_t)max_rank + (size_t)(p - 1)];
    qsort(values, n, sizeof *values, by_size);
    for (i = 0; i < n; ++i) mean += values[i] / (double)n;
    for (i = 0; i < n; ++i) squares += (values[i] - mean) * (values[i] - mean);
    fprintf(stderr, "mu_%-5d", p);
    put_column(mean);
    if (n > 1)
        put_column(sqrt(squares / (double)(n - 1)));
    else
        fputs("         -", stderr); /* one value does not spread */
    for (i = 1; i <= 3; ++i) put_column(quantile(values, n, 0.25 * (double)i));
    if (s->errors) put_column(s->worst[p]);
    fputc('\n', stderr);
}

static void write_summary(const summary *s, int max_rank)
{
    double *values;
    int p;
    fprintf(stderr, "%lu measured, %lu refused\n", (unsigned long)s->measured, (unsigned long)s->refused);
    if (s->measured == 0) return;
    fputs("              mean        sd       25%       50%       75%", stderr);
    fputs(s->errors ? " max error\n" : "\n", stderr);
    values = (double *)resize(NULL, s->measured, sizeof *values);
    for (p = 1; p <= max_rank; ++p) summarize_rank(s, p, max_rank, values);
    free(values);
    if (max_rank < 2) return;
    fputs("dominant rank (the p >= 2 with the largest mu_p):", stderr);
    for (p = 2; p <= max_rank; ++p)
        if (max_rank <= 12 || s->dominant[p]) fprintf(stderr, "  p=%d: %lu", p, (unsigned long)s->dominant[p]);
    fputc('\n', stderr);
}

#endif
