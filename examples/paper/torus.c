/* torus.c - how triangular is a triangle on a surface that has no regular ones?

     cc torus.c -o torus -lm && ./torus DIRECTORY DATA             (from the root: make paper)

   Geodesic triangles on a torus (paper 5.1): two corners stay on the innermost ring, the third moves once over the
   tube, from theta_2 = 0.9 pi to -0.8 pi. Their edges are not the shortest geodesics but those that the straight
   segments of the chart (phi, theta) are pulled tight to: corners are angles not reduced modulo 2 pi. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "../surfaces/torus.h"
#include "experiment.h"
#include "../picture/plot.h"

#define RANKS  6
#define STEPS  170 /* over 1.7 pi */
#define PIECES 64  /* points that an edge is drawn with */

typedef struct triangle {
    double corner[6], length[3], turning[3], mu[RANKS + 1];
    double angle_spread, length_spread; /* largest minus smallest; angles divided by their sum */
} triangle;

static double radius[2] = {2.0, 1.375};

static double spread(const double *value)
{
    return fmax(value[0], fmax(value[1], value[2])) - fmin(value[0], fmin(value[1], value[2]));
}

static void measure(double theta2_over_pi, triangle *t)
{
    surfmink_surface chart = surfmink_torus_chart(radius);
    surfmink_outline outline = surfmink_on_surface(&chart, t->corner, 3);
    double phase[3], g[2 * RANKS + 2];
    int status;
    t->corner[0] = 0;
    t->corner[1] = t->corner[5] = PI;
    t->corner[2] = 1.55;
    t->corner[3] = theta2_over_pi * PI;
    t->corner[4] = 3.1;
    status = surfmink_edges(&outline, t->length, t->turning, NULL);
    if (status == SURFMINK_OK) status = surfmink_phases(t->turning, 3, SURFMINK_CORRECTED, phase);
    if (status == SURFMINK_OK) status = surfmink_irreducible(t->length, phase, 3, RANKS, g);
    if (status == SURFMINK_OK) status = surfmink_spectrum(g, RANKS, NULL, t->mu, NULL);
    experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
    t->angle_spread = spread(t->turning) / (t->turning[0] + t->turning[1] + t->turning[2]);
    t->length_spread = spread(t->length);
}

static void compare(experiment *e)
{
    static printed table;
    triangle t;
    char what[64];
    double theta, apart = 0, want;
    int row, k;
    printed_read(&table, e, "torus_triangles.tsv");
    puts("Geodesic triangles on the torus R = 2, r = 1.375: mu_p computed / reference");
    for (row = 0; row < table.rows; ++row) {
        theta = printed_number(&table, row, "theta2_over_pi");
        measure(theta, &t);
        printf("theta_2 = %5.2f pi ", theta);
        for (k = 2; k <= RANKS; ++k) {
            want = printed_rank(&table, row, "mu", k);
            apart = fmax(apart, fabs(t.mu[k] - want));
            printf("  %.9f / %.9f", t.mu[k], want);
            snprintf(what, sizeof what, "mu_%d at theta_2 = %.2f pi", k, theta);
            experiment_near(e, what, t.mu[k], want, 1e-11);
        }
        for (k = 0; k < 3; ++k) {
            snprintf(what, sizeof what, "edge %d at theta_2 = %.2f pi", k, theta);
            experiment_near(e, what, t.length[k], printed_rank(&table, row, "l", k + 1), 1e-11);
            snprintf(what, sizeof what, "turn %d at theta_2 = %.2f pi", k, theta);
            experiment_near(e, what, t.turning[k], printed_rank(&table, row, "alpha", k + 1), 1e-11);
        }
        putchar('\n');
    }
    printf("largest difference of mu: %.1e\n", apart);
}

/* What the text of paper 5.1 says about its figure. */
static void check_text(experiment *e, const triangle *t, const double *theta)
{
    double least3 = 1, least6 = 1, from = 1, below = 1, late3 = 0, late6 = 0;
    triangle marked;
    int i;
    for (i = 0; i <= STEPS; ++i) {
        least6 = theta[i] < 0.7 ? fmin(least6, t[i].mu[6]) : least6;
        late3 += t[i].mu[3] > 0.8;
        late6 += t[i].mu[6] > 0.8;
        if (theta[i] < 0.7) least3 = fmin(least3, t[i].mu[3]);
        if (t[i].mu[6] < 0.8 && theta[i] < 0.7) {
            below = theta[i];
            if (from > 0.9) from = theta[i];
        }
    }
    experiment_claim(e, "mu_3 is mostly greater than 0.8", late3 > 0.8 * STEPS);
    printf("         mu_6 > 0.8 on %.0f %% of the sweep; it dips to %.3f between theta_2 = %.2f pi and %.2f pi\n",
           100 * late6 / (STEPS + 1), least6, from, below);
    printf("         mu_3 >= %.3f for all theta_2 < 0.7 pi, which the text calls close to 1\n", least3);
    measure(0.6, &marked);
    experiment_claim(e, "at 0.6 pi angles and edges are nearly equal: mu_3, mu_6 > 0.99 and mu_2, mu_4, mu_5 < 0.1",
                     marked.mu[3] > 0.99 && marked.mu[6] > 0.99 && marked.mu[2] < 0.1 && marked.mu[4] < 0.1 &&
                         marked.mu[5] < 0.1 && marked.angle_spread < 0.01 && marked.length_spread < 0.25);
    measure(-0.8, &marked);
    experiment_claim(e, "at -0.8 pi only angles are: mu_3, mu_6 > 0.97, but mu_2, mu_4, mu_5 > 0.2",
                     marked.mu[3] > 0.97 && marked.mu[6] > 0.97 && marked.mu[2] > 0.2 && marked.mu[4] > 0.2 &&
                         marked.mu[5] > 0.2 && marked.angle_spread < 0.02 && marked.length_spread > 6);
}

/* --- figure ------------------------------------------------------------------------------------------------------- */

/* The view is chosen so that the moving corner is on the near side. */
static void draw_triangle(plot *p, double theta2_over_pi, double azimuth, double elevation, double left, double top,
                          const char *title)
{
    plot_view view = plot_look(azimuth, elevation, left + 92, top + 92, 24);
    plot_pen seen = {"#d55e00", 2, ""}, hidden = {"#d55e00", 1, "2 2.5"};
    surfmink_surface chart = surfmink_torus_chart(radius);
    double angle[2 * PIECES], x[3 * (PIECES + 1)], xy[2];
    triangle t;
    int i, k, status;
    measure(theta2_over_pi, &t);
    plot_torus(p, &view, radius);
    plot_torus_outline(p, &view, radius);
    for (i = 0; i < 3; ++i) {
        const double *next = t.corner + 2 * ((i + 1) % 3);
        status = surfmink_edge_points(&chart, t.corner + 2 * i, next, PIECES, angle);
        experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
        for (k = 0; k < PIECES; ++k) surfmink_torus_point(radius, angle[2 * k], angle[2 * k + 1], x + 3 * k);
        surfmink_torus_point(radius, next[0], next[1], x + 3 * PIECES);
        plot_curve_on(p, &view, plot_in_torus, radius, 8, x, PIECES + 1, 0, seen, hidden);
    }
    for (i = 0; i < 3; ++i) {
        surfmink_torus_point(radius, t.corner[2 * i], t.corner[2 * i + 1], x);
        plot_project(&view, x, xy);
        plot_disc(p, xy[0], xy[1], 2.6, plot_thin,
                  plot_hidden(&view, plot_in_torus, radius, 8, x) ? "#bbbbbb" : "#ffffff");
    }
    plot_text(p, left + 92, top + 2, 11, AT_MIDDLE, title);
}

static void draw(const experiment *e, const triangle *t, const double *theta)
{
    static const double marked[4] = {0.6, 0.2, -0.4, -0.8}, azimuth[4] = {-80, 75, 75, 75},
                        elevation[4] = {52, 58, 8, -66};
    static const char *const title[4] = {"$\\theta_2$ = 0.6\\pi", "$\\theta_2$ = 0.2\\pi",
                                         "$\\theta_2$ = \\minus0.4\\pi", "$\\theta_2$ = \\minus0.8\\pi"};
    plot_axes values = {70, 195, 560, 190, {0.9, -0.82}, {0, 1.03}, {0, 0}};
    plot_axes spreads = {70, 415, 560, 110, {0.9, -0.82}, {0, 0.28}, {0, 0}};
    plot_axes lengths = {70, 415, 560, 110, {0.9, -0.82}, {0, 7}, {0, 0}};
    plot_pen dash = {"#666666", 0.9, "4 3"}, angle_pen = {"#0072b2", 1.4, ""}, length_pen = {"#000000", 1.4, ""};
    double y[STEPS + 1];
    char name[32];
    plot p;
    int i, k;
    if (plot_begin(&p, e->figure, 740, 565)) exit(1);
    for (k = 0; k < 4; ++k) draw_triangle(&p, marked[k], azimuth[k], elevation[k], 184.0 * k, 14, title[k]);
    plot_ticks(&p, &values, 0, 0.2, "\\pi");
    plot_frame(&p, &values, 0, 0.2, "", "$\\mu_p$");
    plot_ticks(&p, &spreads, 0, 0.2, "\\pi");
    plot_frame(&p, &spreads, 0, 0.1, "$\\theta_2$", "spread of angles");
    for (k = 0; k <= 6; k += 2) {
        snprintf(name, sizeof name, "%d", k);
        plot_text(&p, 635, plot_y(&lengths, k) + 3.5, 10, AT_START, name);
        plot_line(&p, 626, plot_y(&lengths, k), 630, plot_y(&lengths, k), plot_thin);
    }
    plot_text_as(&p, 658, 470, 11, AT_MIDDLE, "#000000", 0, 1, "spread of lengths");
    for (k = 0; k < 4; ++k) {
        plot_line(&p, plot_x(&values, marked[k]), 195, plot_x(&values, marked[k]), 385, dash);
        plot_line(&p, plot_x(&values, marked[k]), 415, plot_x(&values, marked[k]), 525, dash);
    }
    for (k = 2; k <= RANKS; ++k) {
        for (i = 0; i <= STEPS; ++i) y[i] = t[i].mu[k];
        plot_curve(&p, &values, theta, y, STEPS + 1, plot_pens[k - 2], PLOT_NONE);
        for (i = 4 + 2 * k; i <= STEPS; i += 24)
            plot_mark(&p, plot_markers[k - 2], plot_x(&values, theta[i]), plot_y(&values, y[i]), 3,
                      plot_pens[k - 2].colour);
        snprintf(name, sizeof name, "$\\mu_%d$", k);
        plot_key(&p, 648, 210 + 20.0 * (k - 2), plot_pens[k - 2], plot_markers[k - 2], name);
    }
    for (i = 0; i <= STEPS; ++i) y[i] = t[i].angle_spread;
    plot_curve(&p, &spreads, theta, y, STEPS + 1, angle_pen, PLOT_NONE);
    for (i = 0; i <= STEPS; i += 10)
        plot_mark(&p, PLOT_RING, plot_x(&spreads, theta[i]), plot_y(&spreads, y[i]), 3, angle_pen.colour);
    for (i = 0; i <= STEPS; ++i) y[i] = t[i].length_spread;
    plot_curve(&p, &lengths, theta, y, STEPS + 1, length_pen, PLOT_NONE);
    for (i = 5; i <= STEPS; i += 10)
        plot_mark(&p, PLOT_DISC, plot_x(&lengths, theta[i]), plot_y(&lengths, y[i]), 3, length_pen.colour);
    plot_box(&p, 297, 420, 210, 29, plot_no_line, "#ffffff"); /* the legend stands clear of the lines behind it */
    plot_key(&p, 300, 427, angle_pen, PLOT_RING, "angles (left axis, divided by their sum)");
    plot_key(&p, 300, 442, length_pen, PLOT_DISC, "lengths (right axis)");
    if (plot_end(&p)) exit(1);
}

int main(int argc, char **argv)
{
    static triangle t[STEPS + 1];
    static double theta[STEPS + 1];
    experiment e;
    int i, k;
    if (experiment_begin(&e, argc, argv, "torus")) return 1;
    compare(&e);
    fprintf(e.table, "theta2_over_pi\tl_1\tl_2\tl_3\talpha_1\talpha_2\talpha_3");
    for (k = 2; k <= RANKS; ++k) fprintf(e.table, "\tmu_%d", k);
    fprintf(e.table, "\tangle_spread\tlength_spread\n");
    for (i = 0; i <= STEPS; ++i) {
        theta[i] = 0.9 - 1.7 * i / STEPS;
        measure(theta[i], &t[i]);
        fprintf(e.table, "%.4f", theta[i]);
        for (k = 0; k < 3; ++k) fprintf(e.table, "\t%.12f", t[i].length[k]);
        for (k = 0; k < 3; ++k) fprintf(e.table, "\t%.12f", t[i].turning[k]);
        for (k = 2; k <= RANKS; ++k) fprintf(e.table, "\t%.12f", t[i].mu[k]);
        fprintf(e.table, "\t%.12f\t%.12f\n", t[i].angle_spread, t[i].length_spread);
    }
    check_text(&e, t, theta);
    draw(&e, t, theta);
    return experiment_end(&e);
}
