/* regular.c - does a regular polygon on a sphere have mu_p = 1 at its own p, and 0 elsewhere?

     cc regular.c -o regular -lm && ./regular DIRECTORY            (from the root: make paper)

   Regular polygons of 3 to 6 corners on a geodesic circle, as in the first experiment of paper 5.1: equal angles, equal
   edges, so the theorem on equal-angle polygons (paper 3.4) says 1 at multiples of the corner count, else 0. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "experiment.h"
#include "../picture/plot.h"

#define RANKS  6
#define PIECES 24 /* points that an edge is drawn with */

static void draw(plot *p, const surfmink_surface *sphere, const double *corner, int n, const double *mu, double left)
{
    static const double axis[3] = {1, 1, 1};
    plot_view view = plot_look(35, 50, left + 85, 95, 78);
    plot_pen seen = {"#0072b2", 2.2, ""}, hidden = {"#0072b2", 0.8, "2 3"};
    plot_axes axes = {left + 38, 190, 94, 60, {0, 1}, {0, 1}, {0, 0}};
    double edge[3 * (PIECES + 1)], xy[2];
    char name[64];
    int i, k;
    plot_ellipsoid(p, &view, axis);
    plot_graticule(p, &view, axis, 30);
    for (i = 0; i < n; ++i) {
        const double *next = corner + 3 * ((i + 1) % n);
        surfmink_edge_points(sphere, corner + 3 * i, next, PIECES, edge);
        for (k = 0; k < 3; ++k) edge[3 * PIECES + k] = next[k];
        plot_curve_on(p, &view, plot_in_ellipsoid, axis, 2.2, edge, PIECES + 1, 0, seen, hidden);
    }
    for (i = 0; i < n; ++i) {
        plot_project(&view, corner + 3 * i, xy);
        plot_disc(p, xy[0], xy[1], 3, plot_thin, "#ffffff");
    }
    plot_ticks(p, &axes, 1, 1, "");
    plot_bars(p, &axes, mu, 1, RANKS, 10);
    plot_text(p, axes.left - 18, axes.top + 34, 11, AT_MIDDLE, "$\\mu_p$");
    plot_text(p, axes.left + axes.width + 8, axes.top + 71, 10, AT_START, "$p$");
    snprintf(name, sizeof name, "(%c)  %d corners", 'a' + n - 3, n);
    plot_letter(p, left + 8, 14, name);
}

int main(int argc, char **argv)
{
    double radius = 1, centre[3] = {0.47, 0.33, 0.82}, corner[3 * 6], mu[RANKS + 1];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    surfmink_outline outline;
    char what[32];
    experiment e;
    plot p;
    int n, k, status;
    if (experiment_begin(&e, argc, argv, "regular") || plot_begin(&p, e.figure, 680, 272)) return 1;
    puts("Regular polygons on the unit sphere: mu_p computed / printed");
    printf("corners");
    fprintf(e.table, "corners");
    for (k = 1; k <= RANKS; ++k) {
        printf("   %10s mu_%d", "", k);
        fprintf(e.table, "\tmu_%d", k);
    }
    for (n = 3; n <= 6; ++n) {
        status = surfmink_regular_polygon(&sphere, centre, 0.85, 0.3, (size_t)n, corner);
        outline = surfmink_sphere(corner, (size_t)n, radius);
        if (status == SURFMINK_OK) status = surfmink_measure(&outline, RANKS, mu, NULL, NULL, NULL);
        experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
        printf("\n%7d", n);
        fprintf(e.table, "\n%d", n);
        for (k = 1; k <= RANKS; ++k) {
            double want = k % n == 0 ? 1 : 0;
            printf("   %.9f / %.0f", mu[k], want);
            fprintf(e.table, "\t%.15f", mu[k]);
            snprintf(what, sizeof what, "mu_%d of %d corners", k, n);
            experiment_near(&e, what, mu[k], want, 5e-15); /* the corners are rounded, too */
        }
        draw(&p, &sphere, corner, n, mu, 170.0 * (n - 3));
    }
    putchar('\n');
    fputc('\n', e.table);
    return plot_end(&p) + experiment_end(&e) > 0;
}
