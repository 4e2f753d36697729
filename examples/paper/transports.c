/* transports.c - what becomes of a vector that is carried once round an outline?

     cc transports.c -o transports -lm && ./transports DIRECTORY   (from the root: make paper)

   The co-normal of a great-circle polygon sets out at a point of edge 0 and goes all the way round (paper 5.1, figure
   "ParallelTransport"). Parallel transport brings it back turned by the enclosed curvature; the corrected transport of
   paper 2.3 spreads that defect over the way, and brings it back where it was. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "experiment.h"
#include "../picture/plot.h"

#define CORNERS  5
#define PER_EDGE 8 /* arrows */

/* A pentagon that covers a good part of the unit sphere. */
static const double lonlat[2 * CORNERS] = {-8, -22, 68, -28, 96, 30, 40, 64, -20, 34};

static const double unit_sphere[3] = {1, 1, 1};

typedef struct journey {
    double corner[3 * CORNERS], length[CORNERS], turning[CORNERS];
} journey;

/* Where the journey is after a part of the way, and the frame of the outline there. Edge 0 is left from its middle. */
static void place(const journey *j, double way, size_t *edge, double x[3], double nu[3], double tau[3])
{
    double vector[3], rest[3], norm = 0;
    double position = 0.5 + way * CORNERS, fraction;
    const double *from, *to;
    size_t step = (size_t)position;
    int k;
    fraction = position - (double)step;
    *edge = step; /* CORNERS means edge 0 again, one turn later */
    from = j->corner + 3 * (step % CORNERS);
    to = j->corner + 3 * ((step + 1) % CORNERS);
    surfmink_sphere_log(from, to, 1.0, vector);
    for (k = 0; k < 3; ++k) rest[k] = fraction * vector[k];
    surfmink_sphere_exp(from, rest, 1.0, x);
    surfmink_sphere_log(x, to, 1.0, tau);
    for (k = 0; k < 3; ++k) norm += tau[k] * tau[k];
    for (k = 0; k < 3; ++k) tau[k] /= sqrt(norm);
    nu[0] = tau[1] * x[2] - tau[2] * x[1];
    nu[1] = tau[2] * x[0] - tau[0] * x[2];
    nu[2] = tau[0] * x[1] - tau[1] * x[0];
}

/* The carried co-normal after a part of the way, drawn as an arrow. */
static void draw_arrow(plot *p, const plot_view *view, const journey *j, int transport, double way, plot_pen pen)
{
    double x[3], nu[3], tau[3], tip[3], angle, from[2], to[2];
    size_t edge;
    int k;
    place(j, way, &edge, x, nu, tau);
    surfmink_transport_angle(j->turning, CORNERS, 0, (ptrdiff_t)edge, transport, 0, &angle);
    for (k = 0; k < 3; ++k) tip[k] = x[k] + 0.27 * (cos(angle) * nu[k] + sin(angle) * tau[k]);
    plot_project(view, x, from);
    plot_project(view, tip, to);
    plot_arrow(p, from[0], from[1], to[0], to[1], pen);
}

static void draw_panel(plot *p, const journey *j, double left, int which, const char *title)
{
    plot_view view = plot_look(42, 18, left + 120, 145, 108);
    plot_pen outline = {"#222222", 1.3, ""}, pen = {"", 1.3, ""}, start = {"#000000", 1, ""};
    double edge[3 * 33], x[3], nu[3], tau[3], xy[2];
    size_t at;
    char colour[8];
    int i, k, last = CORNERS * PER_EDGE;
    plot_ellipsoid(p, &view, unit_sphere);
    plot_graticule(p, &view, unit_sphere, 30);
    for (i = 0; i < CORNERS; ++i) {
        double vector[3], part[3];
        surfmink_sphere_log(j->corner + 3 * i, j->corner + 3 * ((i + 1) % CORNERS), 1.0, vector);
        for (k = 0; k <= 32; ++k) {
            int c;
            for (c = 0; c < 3; ++c) part[c] = vector[c] * k / 32;
            surfmink_sphere_exp(j->corner + 3 * i, part, 1.0, edge + 3 * k);
        }
        plot_curve_on(p, &view, plot_in_ellipsoid, unit_sphere, 2.2, edge, 33, 0, outline, outline);
    }
    for (i = 0; i <= last; ++i) {
        double way = (double)i / last;
        if (i == 0 || i == last)
            pen.width = 2.6;
        else
            pen.width = 1.3;
        pen.colour = plot_ramp(0.76 * way, colour);
        if (which < 2) {
            draw_arrow(p, &view, j, which == 0 ? SURFMINK_PARALLEL : SURFMINK_CORRECTED, way, pen);
            continue;
        }
        pen.colour = "#d55e00";
        pen.dash = "3 2";
        draw_arrow(p, &view, j, SURFMINK_PARALLEL, way, pen);
        pen.colour = "#0072b2";
        pen.dash = "";
        draw_arrow(p, &view, j, SURFMINK_CORRECTED, way, pen);
    }
    place(j, 0, &at, x, nu, tau);
    plot_project(&view, x, xy);
    plot_disc(p, xy[0], xy[1], 3.6, start, "#000000");
    plot_letter(p, left + 8, 18, title);
}

int main(int argc, char **argv)
{
    static const char *const transport_name[2] = {"corrected", "parallel"}; /* as in enum surfmink_transport */
    plot_pen parallel = {"#d55e00", 1.3, "3 2"}, corrected = {"#0072b2", 1.3, ""};
    surfmink_outline outline;
    surfmink_functionals w;
    double phase[CORNERS], home, colour_at;
    char colour[8];
    journey j;
    experiment e;
    plot p;
    int i, t, k, status = SURFMINK_OK;
    if (experiment_begin(&e, argc, argv, "transports") || plot_begin(&p, e.figure, 720, 300)) return 1;
    for (i = 0; i < CORNERS; ++i) surfmink_from_lonlat(lonlat[2 * i], lonlat[2 * i + 1], 1.0, j.corner + 3 * i);
    outline = surfmink_sphere(j.corner, CORNERS, 1.0);
    status = surfmink_edges(&outline, j.length, j.turning, NULL);
    if (status == SURFMINK_OK) status = surfmink_total(&outline, j.length, j.turning, CORNERS, &w);
    experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
    printf("A pentagon on the unit sphere: area = enclosed curvature = %.12f, S = %.12f\n", w.curvature, w.turning);
    fprintf(e.table, "transport\tedge\tphase\n");
    for (t = 0; t < 2; ++t) {
        surfmink_phases(j.turning, CORNERS, t, phase);
        for (k = 0; k < CORNERS; ++k) fprintf(e.table, "%s\t%d\t%.15f\n", transport_name[t], k, phase[k]);
        surfmink_transport_angle(j.turning, CORNERS, 0, CORNERS, t, 0, &home);
        fprintf(e.table, "%s\t%d\t%.15f\n", transport_name[t], CORNERS, -home);
        printf("%-9s transport: after one turn off by %18.15f, expected %18.15f\n", transport_name[t], home + 2 * PI,
               t == SURFMINK_PARALLEL ? w.area : 0.0);
        experiment_near(&e, "after one turn", home + 2 * PI, t == SURFMINK_PARALLEL ? w.area : 0.0, 4e-15);
    }
    draw_panel(&p, &j, 0, 0, "(a)  parallel transport");
    draw_panel(&p, &j, 240, 1, "(b)  corrected transport");
    draw_panel(&p, &j, 480, 2, "(c)  both");
    for (i = 0; i < 60; ++i) {
        colour_at = (i + 0.5) / 60;
        plot_box(&p, 165 + 2.0 * i, 276, 2.3, 9, plot_no_line, plot_ramp(0.76 * colour_at, colour));
    }
    plot_box(&p, 165, 276, 120, 9, plot_thin, "none");
    plot_text(&p, 158, 284, 10, AT_END, "start");
    plot_text(&p, 292, 284, 10, AT_START, "after one turn");
    plot_key(&p, 508, 280, parallel, PLOT_NONE, "parallel");
    plot_key(&p, 605, 280, corrected, PLOT_NONE, "corrected");
    return plot_end(&p) + experiment_end(&e) > 0;
}
