/* shapes.c - what does mu_p say about a circle, a rectangle, a star, a triangle on a sphere?

     cc shapes.c -o shapes -lm && ./shapes DIRECTORY               (from the root: make pictures)

   Eighteen outlines, each with its mu_1 to mu_8: twelve in the plane, six on a sphere. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "theory.h"

#define RANKS   8
#define MOST    256 /* corners */
#define PIECES  16  /* that an edge on the sphere is drawn with */
#define COLUMN  116.0
#define ROW     166.0
#define DRAWING 84.0 /* width and height of the place for an outline */

typedef struct shape {
    const char *name;
    size_t n;
    double corner[2 * MOST]; /* on the sphere: in the tangent plane at the centre, to be laid on by exp */
} shape;

/* --- outlines ----------------------------------------------------------------------------------------------------- */

/* n corners on an ellipse with these semi-axes, from the top on. */
static shape ring(const char *name, size_t n, double a, double b)
{
    shape s;
    size_t i;
    s.name = name;
    s.n = n;
    for (i = 0; i < n; ++i) {
        s.corner[2 * i] = -a * sin(2 * PLOT_PI * (double)i / (double)n);
        s.corner[2 * i + 1] = b * cos(2 * PLOT_PI * (double)i / (double)n);
    }
    return s;
}

static shape polygon(const char *name, size_t n, const double *corner)
{
    shape s;
    s.name = name;
    s.n = n;
    memcpy(s.corner, corner, 2 * n * sizeof *corner);
    return s;
}

static shape star(const char *name, double inner)
{
    shape s = ring(name, 10, 1, 1);
    size_t i;
    for (i = 1; i < 10; i += 2) {
        s.corner[2 * i] *= inner;
        s.corner[2 * i + 1] *= inner;
    }
    return s;
}

/* A smooth outline with a dent. */
static shape bean(const char *name)
{
    shape s;
    size_t i;
    s.name = name;
    s.n = MOST;
    for (i = 0; i < s.n; ++i) {
        double t = 2 * PLOT_PI * (double)i / (double)s.n, r = 0.75 + 0.3 * cos(2 * t) - 0.22 * sin(t);
        s.corner[2 * i] = r * cos(t);
        s.corner[2 * i + 1] = r * sin(t);
    }
    return s;
}

/* --- pictures ----------------------------------------------------------------------------------------------------- */

static void tell(const shape *s, const char *surface, const double *mu)
{
    int p;
    printf("%-14s %-7s", s->name, surface);
    for (p = 1; p <= RANKS; ++p) printf(" %6.3f", mu[p]);
    putchar('\n');
}

static void draw_plane(plot *p, const shape *s, double left, double top)
{
    plot_pen pen = {"#000000", 1.6, ""};
    surfmink_outline outline = surfmink_plane(s->corner, s->n);
    double xy[2 * MOST], low[2] = {9, 9}, high[2] = {-9, -9}, mu[RANKS + 1], scale;
    size_t i;
    int k;
    theory_need(surfmink_measure(&outline, RANKS, mu, NULL, NULL, NULL));
    tell(s, "plane", mu);
    for (i = 0; i < 2 * s->n; ++i) {
        low[i % 2] = fmin(low[i % 2], s->corner[i]);
        high[i % 2] = fmax(high[i % 2], s->corner[i]);
    }
    scale = (DRAWING - 6) / fmax(high[0] - low[0], high[1] - low[1]);
    for (i = 0; i < s->n; ++i)
        for (k = 0; k < 2; ++k)
            xy[2 * i + (size_t)k] = (k ? top + 18 : left + COLUMN / 2 - DRAWING / 2) + DRAWING / 2 +
                                    (k ? -1 : 1) * scale * (s->corner[2 * i + (size_t)k] - (low[k] + high[k]) / 2);
    plot_path(p, xy, s->n, 1, pen, "#dddddd");
    plot_text(p, left + COLUMN / 2, top + 11, 11, AT_MIDDLE, s->name);
    theory_bars(p, mu, RANKS, left + 18, top + 110, COLUMN - 24, 36, left < COLUMN);
}

static void draw_sphere(plot *p, const shape *s, double left, double top)
{
    static const double axis[3] = {1, 1, 1};
    plot_pen pen = {"#000000", 1.8, ""};
    plot_view view = plot_look(30, 35, left + COLUMN / 2, top + 18 + DRAWING / 2, DRAWING / 2);
    double corner[3 * MOST], curve[3 * MOST * 2], *at = curve, mu[RANKS + 1], vector[3], radius = 1;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    surfmink_outline outline = surfmink_sphere(corner, s->n, radius);
    size_t i, pieces = s->n > 2 * PIECES ? 1 : PIECES;
    int k;
    for (i = 0; i < s->n; ++i) {
        for (k = 0; k < 3; ++k)
            vector[k] = s->corner[2 * i] * view.camera.right[k] + s->corner[2 * i + 1] * view.camera.up[k];
        theory_need(surfmink_sphere_exp(view.camera.eye, vector, radius, corner + 3 * i));
    }
    theory_need(surfmink_measure(&outline, RANKS, mu, NULL, NULL, NULL));
    tell(s, "sphere", mu);
    for (i = 0; i < s->n; ++i, at += 3 * pieces)
        theory_need(surfmink_edge_points(&sphere, corner + 3 * i, corner + 3 * ((i + 1) % s->n), pieces, at));
    plot_repeat(p, "sphere", view.x, view.y);
    plot_curve_on(p, &view, plot_in_ellipsoid, axis, 2.2, curve, s->n * pieces, 1, pen, plot_no_line);
    plot_text(p, left + COLUMN / 2, top + 11, 11, AT_MIDDLE, s->name);
    theory_bars(p, mu, RANKS, left + 18, top + 110, COLUMN - 24, 36, left < COLUMN);
}

int main(int argc, char **argv)
{
    static const double rectangle[] = {0, 0, 2, 0, 2, 1, 0, 1};
    static const double triangle[] = {0, 0, 4, 0, 0, 3};
    static const double corner[] = {0, 0, 2, 0, 2, 0.8, 0.8, 0.8, 0.8, 2, 0, 2};
    static const double cell[] = {0, 0, 1.1, -0.3, 2, 0.6, 1.7, 1.7, 0.7, 1.9, -0.3, 1.1};
    static const double slab[] = {-1.1, -0.35, 1.1, -0.35, 1.1, 0.35, -1.1, 0.35};
    static const double axis[3] = {1, 1, 1};
    double octant = acos(1 / sqrt(3.0)); /* from the middle of an octant, or of a face of a cube, to a corner */
    plot_view view = plot_look(30, 35, 0, 0, DRAWING / 2);
    shape shapes[18];
    plot p;
    int k;
    if (theory_begin(&p, argc, argv, "shapes", 6 * COLUMN + 10, 3 * ROW + 4)) return 1;
    shapes[0] = ring("circle", MOST, 1, 1);
    shapes[1] = ring("triangle", 3, 1, 1);
    shapes[2] = polygon("square", 4, ring("", 4, 1, 1).corner);
    shapes[3] = ring("pentagon", 5, 1, 1);
    shapes[4] = ring("hexagon", 6, 1, 1);
    shapes[5] = star("star", (3 - sqrt(5.0)) / 2);
    shapes[6] = ring("ellipse 2:1", MOST, 1, 0.5);
    shapes[7] = polygon("rectangle 2:1", 4, rectangle);
    shapes[8] = polygon("3-4-5 triangle", 3, triangle);
    shapes[9] = polygon("letter L", 6, corner);
    shapes[10] = polygon("a cell", 6, cell);
    shapes[11] = bean("bean");
    shapes[12] = ring("circle", 96, 0.8, 0.8);
    shapes[13] = ring("octant", 3, octant, octant);
    shapes[14] = ring("face of a cube", 4, octant, octant);
    shapes[15] = ring("hexagon", 6, 0.9, 0.9);
    shapes[16] = star("star", (3 - sqrt(5.0)) / 2);
    shapes[17] = polygon("slab", 4, slab);
    plot_keep(&p, "sphere");
    plot_ellipsoid(&p, &view, axis);
    plot_graticule(&p, &view, axis, 30);
    plot_kept(&p);
    puts("outline        surface   mu_1   mu_2   mu_3   mu_4   mu_5   mu_6   mu_7   mu_8");
    for (k = 0; k < 18; ++k)
        (k < 12 ? draw_plane : draw_sphere)(&p, &shapes[k], 5 + COLUMN * (k % 6), ROW * (double)(k / 6));
    return plot_end(&p);
}
