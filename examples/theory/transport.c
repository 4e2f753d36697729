/* transport.c - why does plain parallel transport call a triangle on a sphere a square?

     cc transport.c -o transport -lm && ./transport DIRECTORY      (from the root: make pictures)

   The outer co-normals of an octant of the sphere, brought to one point of its outline by either transport; then the
   same for regular triangles of every size. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "theory.h"

#define RANKS  6
#define PIECES 30
#define SIZES  60

static const double axis[3] = {1, 1, 1};
static const double octant[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};

/* mu of a spherical triangle by either transport to the middle of edge 0; also its edges. */
static void measure(const double *corner, double *corrected, double *parallel, double *length, double *turning)
{
    surfmink_outline triangle = surfmink_sphere(corner, 3, 1);
    double g[2 * RANKS + 2];
    theory_need(surfmink_measure(&triangle, RANKS, corrected, NULL, NULL, NULL));
    theory_need(surfmink_edges(&triangle, length, turning, NULL));
    theory_need(surfmink_irreducible_parallel(length, turning, 3, 0, 0.5, RANKS, g));
    theory_need(surfmink_spectrum(g, RANKS, NULL, parallel, NULL));
}

/* The octant, and the co-normal in the middle of each edge. */
static void draw_octant(plot *p, double x, double y, double size)
{
    plot_view view = plot_look(52, 36, x, y, size);
    plot_pen pen = {"#000000", 2, ""}, arrow = {"#d55e00", 2, ""};
    double radius = 1, edge[3 * (3 * PIECES)], frame[9], from[2], to[2], middle[3], tip[3];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    surfmink_outline triangle = surfmink_sphere(octant, 3, 1);
    char name[8];
    size_t i;
    int k;
    plot_ellipsoid(p, &view, axis);
    plot_graticule(p, &view, axis, 30);
    for (i = 0; i < 3; ++i)
        theory_need(
            surfmink_edge_points(&sphere, octant + 3 * i, octant + 3 * ((i + 1) % 3), PIECES, edge + 3 * PIECES * i));
    plot_curve_on(p, &view, plot_in_ellipsoid, axis, 2.2, edge, (size_t)3 * PIECES, 1, pen, plot_no_line);
    for (i = 0; i < 3; ++i) {
        theory_need(surfmink_frame(&triangle, i, frame));
        for (k = 0; k < 3; ++k) {
            middle[k] = edge[3 * (PIECES * i + PIECES / 2) + (size_t)k];
            tip[k] = middle[k] + 0.45 * frame[k];
        }
        plot_project(&view, middle, from);
        plot_project(&view, tip, to);
        plot_arrow(p, from[0], from[1], to[0], to[1], arrow);
        snprintf(name, sizeof name, "%d", (int)i);
        for (k = 0; k < 3; ++k) tip[k] = middle[k] - 0.16 * frame[k];
        plot_project(&view, tip, to);
        plot_text_as(p, to[0], to[1] + 4, 12, AT_MIDDLE, "#000000", 1, 0, name);
    }
}

/* Directions round a point, each as long as the part of the outline that has it. */
static void draw_compass(plot *p, double x, double y, double size, int count, const double *angle, const double *length,
                         const char *const *name)
{
    plot_pen ring = {"#999999", 0.8, "2 2"}, arrow = {"#d55e00", 2, ""};
    double reach;
    int k;
    plot_disc(p, x, y, size, ring, "none");
    for (k = 0; k < count; ++k) {
        reach = size * length[k];
        plot_arrow(p, x, y, x + reach * cos(angle[k]), y - reach * sin(angle[k]), arrow);
        plot_text_as(p, x + (size + 11) * cos(angle[k]), y - (size + 11) * sin(angle[k]) + 4, 11, AT_MIDDLE, "#000000",
                     1, 0, name[k]);
    }
}

/* Regular triangles from tiny to almost a hemisphere, by the angle of their corners. */
static void draw_sizes(plot *p, double left, double top)
{
    plot_axes axes = {0, 0, 230, 180, {60, 180}, {-0.06, 1.06}, {0, 0}}; /* curves at 0 and 1 clear of the frame */
    double radius = 1, corner[9], length[3], turning[3], a[RANKS + 1], b[RANKS + 1];
    static double angle[SIZES], corrected[2][SIZES], parallel[2][SIZES];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    static const double centre[3] = {0, 0, 1};
    int i, k;
    axes.left = left;
    axes.top = top;
    puts("\nregular triangles on the unit sphere, mu_3 and mu_4\ncorners   area   corrected      parallel");
    for (k = 0; k < SIZES; ++k) {
        double distance = PLOT_PI / 2 * (k + 0.5) / SIZES;
        theory_need(surfmink_regular_polygon(&sphere, centre, distance, 0, 3, corner));
        measure(corner, a, b, length, turning);
        angle[k] = 180 - turning[1] * 180 / PLOT_PI;
        corrected[0][k] = a[3];
        corrected[1][k] = a[4];
        parallel[0][k] = b[3];
        parallel[1][k] = b[4];
        if (k % 6 == 5)
            printf("%6.1f   %5.3f   %.3f  %.3f   %.3f  %.3f\n", angle[k],
                   2 * PLOT_PI - turning[0] - turning[1] - turning[2], a[3], a[4], b[3], b[4]);
    }
    plot_frame(p, &axes, 30, 0.5, "angle of the corners, degrees", "$\\mu_3$, $\\mu_4$");
    plot_curve(p, &axes, angle, corrected[0], SIZES, plot_pens[0], PLOT_NONE);
    plot_curve(p, &axes, angle, corrected[1], SIZES, plot_pens[7], PLOT_NONE);
    for (i = 0; i < 2; ++i) {
        plot_curve(p, &axes, angle, parallel[i], SIZES, plot_pens[1 + i], PLOT_NONE);
        for (k = 12; k < SIZES; k += 4)
            plot_mark(p, plot_markers[1 + i], plot_x(&axes, angle[k]), plot_y(&axes, parallel[i][k]), 3,
                      plot_pens[1 + i].colour);
    }
    plot_key(p, left, top + 226, plot_pens[0], PLOT_NONE, "$\\mu_3$, corrected");
    plot_key(p, left, top + 242, plot_pens[7], PLOT_NONE, "$\\mu_4$, corrected");
    plot_key(p, left + 120, top + 226, plot_pens[1], plot_markers[1], "$\\mu_3$, parallel");
    plot_key(p, left + 120, top + 242, plot_pens[2], plot_markers[2], "$\\mu_4$, parallel");
}

int main(int argc, char **argv)
{
    static const char *const halves[] = {"0", "1", "2", "0"}, *const whole[] = {"0", "1", "2"};
    double corrected[RANKS + 1], parallel[RANKS + 1], length[3], turning[3], phase[4], part[4];
    plot p;
    int k;
    if (theory_begin(&p, argc, argv, "transport", 860, 300)) return 1;
    measure(octant, corrected, parallel, length, turning);
    puts("an octant of the sphere, by either transport to the middle of edge 0");
    puts("            mu_1   mu_2   mu_3   mu_4   mu_5   mu_6");
    printf("corrected");
    for (k = 1; k <= RANKS; ++k) printf(" %6.3f", corrected[k]);
    printf("\nparallel ");
    for (k = 1; k <= RANKS; ++k) printf(" %6.3f", parallel[k]);
    putchar('\n');
    plot_letter(&p, 8, 18, "(a)  an octant, its co-normals");
    draw_octant(&p, 120, 150, 100);
    plot_letter(&p, 250, 18, "(b)  parallel");
    theory_need(surfmink_phases(turning, 3, SURFMINK_PARALLEL, phase));
    for (k = 0; k < 3; ++k) part[k] = k == 0 ? 0.5 : 1; /* the point in the middle of edge 0 cuts it in two */
    phase[3] = phase[2] + turning[0];
    part[3] = 0.5;
    draw_compass(&p, 320, 105, 54, 4, phase, part, halves);
    theory_bars(&p, parallel, RANKS, 278, 200, 90, 60, 1);
    plot_letter(&p, 400, 18, "(c)  corrected");
    theory_need(surfmink_phases(turning, 3, SURFMINK_CORRECTED, phase));
    for (k = 0; k < 3; ++k) part[k] = 1;
    draw_compass(&p, 470, 105, 54, 3, phase, part, whole);
    theory_bars(&p, corrected, RANKS, 428, 200, 90, 60, 1);
    plot_letter(&p, 570, 18, "(d)  regular triangles of all sizes");
    draw_sizes(&p, 615, 40);
    return plot_end(&p);
}
