/* curvature.c - what happens to an outline that encloses almost 2 pi of curvature, half a sphere?

     cc curvature.c -o curvature -lm && ./curvature DIRECTORY      (from the root: make pictures)

   A flower and a hexagon on the unit sphere grow towards the equator. S = 2 pi - enclosed curvature goes to 0, and all
   that is divided by S grows: the condition number of the flower, and what an error in the corners does to mu. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "theory.h"

#define RANKS   6
#define PETALS  6
#define CORNERS 120 /* of the flower */
#define STEPS   13  /* values of S from 2 pi down to 1e-5, a factor of 3 or so apart */
#define NOISE   1e-6
#define TRIALS  16

static const double axis[3] = {1, 1, 1};

/* corners points round the pole: at the colatitude, more and less by depth where there are petals. */
static void grow(size_t corners, double colatitude, double depth, double *corner)
{
    size_t i;
    for (i = 0; i < corners; ++i) {
        double phi = 2 * PLOT_PI * (double)i / (double)corners, theta = colatitude + depth * cos(PETALS * phi);
        corner[3 * i] = sin(theta) * cos(phi);
        corner[3 * i + 1] = sin(theta) * sin(phi);
        corner[3 * i + 2] = cos(theta);
    }
}

/* A number between -1 and 1: the same ones in every run. */
static double random_number(unsigned long *state)
{
    *state = (*state * 1103515245ul + 12345ul) & 0x7ffffffful;
    return (double)*state / 0x40000000ul - 1;
}

/* Total turning of an outline; by bisection the colatitude where it is S. */
static double size_for(double s, size_t corners, double depth, double *corner)
{
    surfmink_outline outline = surfmink_sphere(corner, corners, 1);
    double length[CORNERS], turning[CORNERS], low = 0.2, high = 2, middle = 0, sum;
    int step;
    size_t i;
    for (step = 0; step < 60; ++step) {
        middle = (low + high) / 2;
        grow(corners, middle, depth, corner);
        theory_need(surfmink_edges(&outline, length, turning, NULL));
        for (sum = 0, i = 0; i < corners; ++i) sum += turning[i];
        if (sum > s)
            low = middle;
        else
            high = middle;
    }
    return middle;
}

/* The largest change of mu_2 ... mu_6 over some trials in which every corner is moved by up to NOISE; 0 if an outline
   was refused. */
static double shake(const double *corner, size_t corners, const double *mu)
{
    double moved[3 * CORNERS] = {0}, now[RANKS + 1], most = 0;
    surfmink_outline outline = surfmink_sphere(moved, corners, 1);
    unsigned long state = 1;
    size_t i;
    int trial, p;
    for (trial = 0; trial < TRIALS; ++trial) {
        for (i = 0; i < 3 * corners; ++i) moved[i] = corner[i] + NOISE * random_number(&state);
        if (surfmink_measure(&outline, RANKS, now, NULL, NULL, NULL) != SURFMINK_OK) return 0;
        for (p = 2; p <= RANKS; ++p) most = fmax(most, fabs(now[p] - mu[p]));
    }
    return most;
}

static void draw_outline(plot *p, double s, double x, double y)
{
    plot_view view = plot_look(0, 50, x, y, 62);
    plot_pen pen = {"#000000", 1.8, ""}, hidden = {"#000000", 0.9, "2 3"};
    double corner[3 * CORNERS];
    char name[64];
    size_for(s, CORNERS, 0.2, corner);
    plot_repeat(p, "sphere", x, y);
    plot_curve_on(p, &view, plot_in_ellipsoid, axis, 2.2, corner, CORNERS, 1, pen, hidden);
    snprintf(name, sizeof name, "$S$ = %g", s);
    plot_text(p, x, y + 78, 11, AT_MIDDLE, name);
}

int main(int argc, char **argv)
{
    plot_axes left = {220, 24, 220, 210, {1e-5, 10}, {0.3, 1e7}, {1, 1}};
    plot_axes right = {530, 24, 220, 210, {1e-5, 10}, {1e-7, 1}, {1, 1}};
    plot_view view = plot_look(0, 50, 0, 0, 62);
    double corner[3 * CORNERS], mu[RANKS + 1], s[STEPS], condition[2][STEPS], change[2][STEPS];
    surfmink_functionals w;
    plot p;
    int kind, k;
    if (theory_begin(&p, argc, argv, "curvature", 770, 310)) return 1;
    printf("what moving each corner by up to %g does\n\n", NOISE);
    puts("outline         S   curvature   condition    mu_2    mu_4    mu_6   largest change of mu");
    for (kind = 0; kind < 2; ++kind)
        for (k = 0; k < STEPS; ++k) {
            size_t corners = kind ? 6 : CORNERS;
            surfmink_outline outline = surfmink_sphere(corner, corners, 1);
            s[k] = pow(10, 0.5 - 0.5 * k + (k > 0 ? 0 : 0.15));
            size_for(s[k], corners, kind ? 0 : 0.2, corner);
            theory_need(surfmink_measure(&outline, RANKS, mu, NULL, &w, NULL));
            condition[kind][k] = w.condition;
            change[kind][k] = shake(corner, corners, mu);
            printf("%-8s %8.1e   %9.6f    %8.2e  %6.4f  %6.4f  %6.4f   %.1e\n", kind ? "hexagon" : "flower", w.turning,
                   w.curvature, w.condition, mu[2], mu[4], mu[6], change[kind][k]);
        }
    plot_keep(&p, "sphere");
    plot_ellipsoid(&p, &view, axis);
    plot_graticule(&p, &view, axis, 30);
    plot_kept(&p);
    plot_letter(&p, 6, 16, "(a)");
    draw_outline(&p, 4, 84, 84);
    draw_outline(&p, 0.1, 84, 232);
    plot_letter(&p, 168, 16, "(b)");
    plot_frame(&p, &left, 0, 0, "$S$ = 2\\pi \\minus enclosed curvature", "condition number $c$");
    plot_letter(&p, 470, 16, "(c)");
    plot_frame(&p, &right, 0, 0, "$S$ = 2\\pi \\minus enclosed curvature", "change of $\\mu_p$");
    for (kind = 0; kind < 2; ++kind) {
        plot_curve(&p, &left, s, condition[kind], STEPS, plot_pens[2 * kind], plot_markers[2 * kind]);
        plot_curve(&p, &right, s, change[kind], STEPS, plot_pens[2 * kind], plot_markers[2 * kind]);
        plot_key(&p, 300 + 160.0 * kind, 290, plot_pens[2 * kind], plot_markers[2 * kind],
                 kind ? "hexagon, 6 corners" : "flower, 120 corners");
    }
    return plot_end(&p);
}
