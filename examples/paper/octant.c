/* octant.c - is a triangle with three right angles a triangle or a square?

     cc octant.c -o octant -lm && ./octant DIRECTORY DATA          (from the root: make paper)

   An octant of the sphere (paper 5.1, figure "minkowski-eigenvectors"). Parallel transport turns by 90 degrees at each
   corner, so it takes the outline for a square: mu_4 = 1, and mu_3 depends on where one looks. The corrected transport
   turns by 120 degrees: mu_3 = 1, mu_4 = 0, everywhere. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "experiment.h"
#include "../picture/plot.h"

#define RANKS    6
#define PIECES   30 /* that an edge is coloured with */
#define PER_EDGE 4  /* places along an edge where eigenvectors are drawn */

static const double unit_sphere[3] = {1, 1, 1};
static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
static double length[3], turning[3];

/* mu_p and g_p with the fiducial point at a fraction of an edge, for either transport. */
static void components(int transport, size_t edge, double fraction, double *mu, double *g)
{
    double phase[3], rotation;
    int p, status;
    if (transport == SURFMINK_PARALLEL) {
        status = surfmink_irreducible_parallel(length, turning, 3, edge, fraction, RANKS, g);
    } else {
        surfmink_phases(turning, 3, transport, phase);
        status = surfmink_irreducible(length, phase, 3, RANKS, g);
        for (p = 0; p <= RANKS && status == SURFMINK_OK; ++p) { /* read at this edge instead of edge 0 */
            double re = g[2 * p], im = g[2 * p + 1];
            rotation = -p * phase[edge];
            g[2 * p] = re * cos(rotation) - im * sin(rotation);
            g[2 * p + 1] = re * sin(rotation) + im * cos(rotation);
        }
    }
    if (status == SURFMINK_OK) status = surfmink_spectrum(g, RANKS, NULL, mu, NULL);
    experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
}

/* A point of an edge with co-normal and tangent: edges are quarter circles, from one axis to the next. */
static void place(size_t edge, double fraction, double x[3], double frame[6])
{
    const double *a = corner + 3 * edge, *b = corner + 3 * ((edge + 1) % 3), *c = corner + 3 * ((edge + 2) % 3);
    double s = sin(fraction * PI / 2), t = cos(fraction * PI / 2);
    int k;
    for (k = 0; k < 3; ++k) {
        x[k] = t * a[k] + s * b[k];
        frame[k] = -c[k]; /* outwards is away from the third axis */
        frame[3 + k] = t * b[k] - s * a[k];
    }
}

static const plot_pen outwards = {"#cc3399", 1.8, ""}, eigenvector = {"#000000", 1.1, ""};

static void draw_panel(plot *p, double left, int transport, int rank, const char *title, const char *value)
{
    plot_view view = plot_look(38, 32, left + 88, 122, 80);
    plot_pen casing = {"#000000", 4.6, ""}, line = {"", 3.4, ""};
    double mu[RANKS + 1], g[2 * RANKS + 2], x[6], frame[6], arrow[3 * RANKS], tip[3], from[2], to[2];
    char colour[8];
    size_t edge;
    int i, k, n;
    plot_ellipsoid(p, &view, unit_sphere);
    plot_graticule(p, &view, unit_sphere, 30);
    for (n = 0; n < 2; ++n)
        for (edge = 0; edge < 3; ++edge)
            for (i = 0; i < PIECES; ++i) {
                components(transport, edge, (i + 0.5) / PIECES, mu, g);
                place(edge, (double)i / PIECES, x, frame);
                place(edge, (i + 1.2) / PIECES, x + 3, frame);
                line.colour = plot_ramp(mu[rank], colour);
                plot_project(&view, x, from);
                plot_project(&view, x + 3, to);
                plot_line(p, from[0], from[1], to[0], to[1], n ? line : casing);
            }
    for (edge = 0; edge < 3; ++edge)
        for (i = 0; i < PER_EDGE; ++i) {
            components(transport, edge, (i + 0.5) / PER_EDGE, mu, g);
            place(edge, (i + 0.5) / PER_EDGE, x, frame);
            plot_project(&view, x, from);
            for (k = 0; k < 3; ++k) tip[k] = x[k] + 0.4 * frame[k];
            plot_project(&view, tip, to);
            plot_arrow(p, from[0], from[1], to[0], to[1], outwards);
            if (mu[rank] < 1e-9) continue; /* no direction is better than another */
            surfmink_eigenvectors(g, rank, 1, 0, frame, 3, arrow);
            for (n = 0; n < rank; ++n) {
                for (k = 0; k < 3; ++k) tip[k] = x[k] + 0.21 * arrow[3 * n + k];
                plot_project(&view, tip, to);
                plot_arrow(p, from[0], from[1], to[0], to[1], eigenvector);
            }
        }
    plot_letter(p, left + 6, 16, title);
    plot_text(p, left + 88, 226, 11, AT_MIDDLE, value);
}

/* Below the four panels. */
static void draw_key(plot *p, double y)
{
    plot_arrow(p, 70, y, 96, y, outwards);
    plot_text(p, 104, y + 3.5, 10, AT_START, "outwards (co-normal)");
    plot_arrow(p, 250, y, 276, y, eigenvector);
    plot_text(p, 284, y + 3.5, 10, AT_START, "eigenvectors (positive eigenvalue)");
}

/* mu_3 and mu_4 over the place of the fiducial point on edge 0. Two of them are 1 everywhere: a thin line on a thick
   one, with marks that take turns. */
static void draw_values(plot *p, const experiment *e, double left)
{
    static const char *const name[4] = {"$\\mu_3$ parallel", "$\\mu_4$ parallel", "$\\mu_3$ corrected",
                                        "$\\mu_4$ corrected"};
    static const enum plot_marker marker[4] = {PLOT_NONE, PLOT_BOX, PLOT_DISC, PLOT_NONE};
    plot_axes axes = {left, 42, 150, 140, {0, 1}, {0, 1.05}, {0, 0}};
    plot_pen pen[4];
    double u[65], value[4][65], mu[RANKS + 1], g[2 * RANKS + 2];
    int i, k;
    for (i = 0; i <= 64; ++i) {
        u[i] = i / 64.0;
        components(SURFMINK_PARALLEL, i < 64 ? 0 : 1, i < 64 ? u[i] : 0, mu, g);
        value[0][i] = mu[3];
        value[1][i] = mu[4];
        fprintf(e->table, "%.6f", u[i]);
        for (k = 1; k <= RANKS; ++k) fprintf(e->table, "\t%.15f", mu[k]);
        components(SURFMINK_CORRECTED, 0, 0, mu, g);
        value[2][i] = mu[3];
        value[3][i] = mu[4];
        for (k = 1; k <= RANKS; ++k) fprintf(e->table, "\t%.15f", mu[k]);
        fputc('\n', e->table);
    }
    plot_frame(p, &axes, 0.5, 0.2, "fiducial point, fraction of edge", "$\\mu_p$");
    for (k = 0; k < 4; ++k) {
        pen[k] = plot_pens[k];
        if (k == 1) pen[k].width = 4;
        plot_curve(p, &axes, u, value[k], 65, pen[k], PLOT_NONE);
        plot_key(p, left + 14, 114 - 14 * k, pen[k], marker[k], name[k]);
    }
    for (k = 1; k < 3; ++k)
        for (i = k == 1 ? 4 : 12; i < 64; i += 16)
            plot_mark(p, marker[k], plot_x(&axes, u[i]), plot_y(&axes, value[k][i]), 3.5, pen[k].colour);
    plot_letter(p, left - 30, 16, "(c)");
}

int main(int argc, char **argv)
{
    static printed t;
    surfmink_outline octant = surfmink_sphere(corner, 3, 1.0);
    double mu[RANKS + 1], g[2 * RANKS + 2], low = 1, high = 0, u;
    char what[64];
    experiment e;
    plot p;
    int row, k;
    if (experiment_begin(&e, argc, argv, "octant") || plot_begin(&p, e.figure, 985, 262)) return 1;
    experiment_need(surfmink_edges(&octant, length, turning, NULL) == SURFMINK_OK, "the octant is fine");
    printed_read(&t, &e, "triangle90.tsv");
    puts("The octant under parallel transport to a point at a fraction u of an edge: mu_p computed / reference");
    for (row = 0; row < t.rows; ++row) {
        u = printed_number(&t, row, "u");
        components(SURFMINK_PARALLEL, u < 1 ? 0 : 1, u < 1 ? u : 0, mu, g);
        low = fmin(low, mu[3]);
        high = fmax(high, mu[3]);
        printf("u = %.2f ", u);
        for (k = 1; k <= RANKS; ++k) {
            double want = printed_rank(&t, row, "mu_", k);
            if (k == 3 || k == 4) printf("  mu_%d %.12f / %.12f", k, mu[k], want);
            snprintf(what, sizeof what, "mu_%d at u = %.2f", k, u);
            experiment_near(&e, what, mu[k], want, 2e-15);
        }
        putchar('\n');
    }
    experiment_claim(&e, "parallel transport: 0.23 < mu_3 < 0.34, printed below figure (a)", low > 0.23 && high < 0.34);
    components(SURFMINK_PARALLEL, 0, 0.5, mu, g);
    experiment_claim(&e, "parallel transport: mu_4 = 1", fabs(mu[4] - 1) < 1e-15);
    components(SURFMINK_CORRECTED, 0, 0, mu, g);
    experiment_claim(&e, "corrected transport: mu_3 = 1 and mu_4 = 0", fabs(mu[3] - 1) < 1e-15 && mu[4] < 1e-15);
    fprintf(e.table, "u");
    for (k = 1; k <= RANKS; ++k) fprintf(e.table, "\tparallel_mu_%d", k);
    for (k = 1; k <= RANKS; ++k) fprintf(e.table, "\tcorrected_mu_%d", k);
    fputc('\n', e.table);
    draw_panel(&p, 0, SURFMINK_PARALLEL, 3, "(a.i)  parallel, $p$ = 3", "0.23 < $\\mu_3$ < 0.34");
    draw_panel(&p, 180, SURFMINK_PARALLEL, 4, "(a.ii)  parallel, $p$ = 4", "$\\mu_4$ = 1");
    draw_panel(&p, 360, SURFMINK_CORRECTED, 3, "(b.i)  corrected, $p$ = 3", "$\\mu_3$ = 1");
    draw_panel(&p, 540, SURFMINK_CORRECTED, 4, "(b.ii)  corrected, $p$ = 4", "$\\mu_4$ = 0");
    plot_scale(&p, 727, 62, 12, 120, "$\\mu_p$");
    draw_key(&p, 249);
    draw_values(&p, &e, 815);
    return plot_end(&p) + experiment_end(&e) > 0;
}
