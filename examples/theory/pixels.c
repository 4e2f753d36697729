/* pixels.c - what does a pixel image do to mu_p, and what does smoothing its outlines mend?

     cc pixels.c -o pixels -lm && ./pixels DIRECTORY               (from the root: make pictures)

   Discs and hexagons of pixels, traced along the sides of their pixels. All edges of such an outline run along the
   axes, so mu_4 = 1 whatever the shape and the resolution. Passes of the 3-point mean, --smooth K of the command, take
   that away; too many take the corners of the hexagon away, too. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "theory.h"

#define RANKS  8
#define MOST   2048 /* corners */
#define SIZES  5    /* radii 4, 8, ..., 64 pixels */
#define PASSES 7
#define SCALE  7.0 /* of a pixel in the pictures */

static const size_t passes[PASSES] = {0, 1, 2, 4, 8, 16, 32};

typedef struct outline {
    size_t n;
    double corner[2 * MOST];
} outline;

/* Is the middle of a pixel inside? No sides: a disc. The hexagon is turned by 10 degrees, so that none of its sides
   runs along the pixels. */
static int inside(int sides, double radius, int i, int j)
{
    int k;
    if (sides == 0) return i * i + j * j <= radius * radius;
    for (k = 0; k < sides; ++k) {
        double turn = 2 * PLOT_PI * k / sides + PLOT_PI / 18;
        if (i * cos(turn) + j * sin(turn) > radius * cos(PLOT_PI / sides)) return 0;
    }
    return 1;
}

/* Goes straight to (x, y), with a corner at every pixel on the way. */
static void walk(outline *o, int x, int y)
{
    double *at = o->corner + 2 * o->n;
    for (; at[0] < x || at[0] > x || at[1] < y || at[1] > y; at += 2, ++o->n) {
        at[2] = at[0] + (at[0] < x) - (at[0] > x);
        at[3] = at[1] + (at[1] < y) - (at[1] > y);
    }
}

/* The first or last pixel of a row; the shape is convex and about the origin. */
static int end_of_row(int sides, double radius, int row, int way)
{
    int i = 0, reach = (int)radius + 1;
    for (i = way * reach; i * way > -reach && !inside(sides, radius, i, row);) i -= way;
    return i;
}

/* Along the sides of the pixels, counter-clockwise from the lower left. Pixel (i, j) covers i .. i+1 and j .. j+1. */
static void trace(outline *o, int sides, double radius)
{
    int low = 0, high = 0, row;
    while (inside(sides, radius, end_of_row(sides, radius, low - 1, 1), low - 1)) --low;
    while (inside(sides, radius, end_of_row(sides, radius, high + 1, 1), high + 1)) ++high;
    o->n = 0;
    o->corner[0] = end_of_row(sides, radius, low, -1);
    o->corner[1] = low;
    for (row = low; row <= high; ++row) {
        walk(o, end_of_row(sides, radius, row, 1) + 1, row);
        walk(o, end_of_row(sides, radius, row, 1) + 1, row + 1);
    }
    for (row = high; row >= low; --row) {
        walk(o, end_of_row(sides, radius, row, -1), row + 1);
        walk(o, end_of_row(sides, radius, row, -1), row); /* ends where it began */
    }
}

static void measure(int sides, double radius, size_t smooth, outline *o, double *mu, double *length)
{
    surfmink_outline view;
    surfmink_functionals w;
    trace(o, sides, radius);
    surfmink_smooth(o->corner, o->n, 2, smooth);
    view = surfmink_plane(o->corner, o->n);
    theory_need(surfmink_measure(&view, RANKS, mu, NULL, &w, NULL));
    *length = w.length;
}

/* The pixels of a shape of radius 8, about (0, 0), under its name. */
static void draw_pixels(plot *p, int sides)
{
    plot_pen grid = {"#aaaaaa", 0.5, ""};
    int i, j;
    plot_keep(p, sides ? "hexagon" : "disc");
    for (i = -8; i <= 8; ++i)
        for (j = -8; j <= 8; ++j)
            if (inside(sides, 8, i, j)) plot_box(p, SCALE * i, -SCALE * (j + 1), SCALE, SCALE, grid, "#e8e8e8");
    plot_kept(p);
}

/* Its outline after so many passes, over the pixels, and mu of it. */
static void draw_outline(plot *p, int sides, size_t smooth, double left, double top)
{
    static outline o;
    plot_pen pen = {"#000000", 1.8, ""};
    double mu[RANKS + 1], length, xy[2 * MOST];
    char name[64];
    size_t k;
    plot_repeat(p, sides ? "hexagon" : "disc", left + 65, top + 85);
    measure(sides, 8, smooth, &o, mu, &length);
    for (k = 0; k < o.n; ++k) {
        xy[2 * k] = left + 65 + SCALE * o.corner[2 * k];
        xy[2 * k + 1] = top + 85 - SCALE * o.corner[2 * k + 1];
    }
    plot_path(p, xy, o.n, 1, pen, "none");
    if (smooth > 0)
        snprintf(name, sizeof name, "%lu pass%s", (unsigned long)smooth, smooth > 1 ? "es" : "");
    else
        snprintf(name, sizeof name, "as traced");
    plot_text(p, left + 68, top + 12, 11, AT_MIDDLE, name);
    theory_bars(p, mu, RANKS, left + 22, top + 158, 96, 40, smooth == 0);
}

/* mu_rank over the radius, one line for each number of passes. */
static void draw_curves(plot *p, int sides, int rank, const plot_axes *axes, const char *title)
{
    static outline o;
    double at[SIZES], value[SIZES], mu[RANKS + 1], length;
    int size, k;
    printf("\n%s, mu_%d by radius in pixels\npasses", sides ? "hexagon" : "disc", rank);
    for (size = 0; size < SIZES; ++size) printf(" %8d", 4 << size);
    putchar('\n');
    plot_frame(p, axes, 0, 0.2, "radius in pixels", title);
    for (size = 0; size < SIZES; ++size) {
        char label[16];
        double x = plot_x(axes, size);
        snprintf(label, sizeof label, "%d", 4 << size);
        plot_line(p, x, axes->top, x, axes->top + axes->height, plot_faint);
        plot_text(p, x, axes->top + axes->height + 13, 10, AT_MIDDLE, label);
    }
    for (k = 0; k < PASSES; ++k) {
        printf("%6lu", (unsigned long)passes[k]);
        for (size = 0; size < SIZES; ++size) {
            at[size] = size;
            measure(sides, 4 << size, passes[k], &o, mu, &length);
            value[size] = mu[rank];
            printf(" %8.4f", mu[rank]);
        }
        putchar('\n');
        plot_curve(p, axes, at, value, SIZES, plot_pens[k], plot_markers[k]);
    }
}

/* What the staircase does to the length: 8 radii instead of 2 pi. */
static void tell_lengths(void)
{
    static outline o;
    double mu[RANKS + 1], length;
    int size, k;
    puts("\ndisc, length over 2 pi radius, by radius in pixels");
    for (k = 0; k < PASSES; ++k) {
        printf("%6lu", (unsigned long)passes[k]);
        for (size = 0; size < SIZES; ++size) {
            measure(0, 4 << size, passes[k], &o, mu, &length);
            printf(" %8.4f", length / (2 * PLOT_PI * (4 << size)));
        }
        putchar('\n');
    }
}

int main(int argc, char **argv)
{
    plot_axes disc = {50, 236, 300, 190, {-0.15, 4.15}, {-0.04, 1.04}, {0, 0}};
    plot_axes hexagon = {420, 236, 300, 190, {-0.15, 4.15}, {-0.04, 1.04}, {0, 0}};
    char name[32];
    plot p;
    int k;
    if (theory_begin(&p, argc, argv, "pixels", 820, 466)) return 1;
    draw_pixels(&p, 0);
    draw_pixels(&p, 6);
    plot_letter(&p, 6, 16, "(a)");
    plot_letter(&p, 418, 16, "(b)");
    for (k = 0; k < 3; ++k) {
        draw_outline(&p, 0, passes[k == 2 ? 3 : k], 8 + 134.0 * k, 4);
        draw_outline(&p, 6, passes[k == 2 ? 3 : k], 420 + 134.0 * k, 4);
    }
    plot_letter(&p, 6, 230, "(c)");
    plot_letter(&p, 376, 230, "(d)");
    draw_curves(&p, 0, 4, &disc, "$\\mu_4$ of the disc (should be 0)");
    draw_curves(&p, 6, 6, &hexagon, "$\\mu_6$ of the hexagon (should be 1)");
    tell_lengths();
    plot_text(&p, 740, 250, 10, AT_START, "passes");
    for (k = 0; k < PASSES; ++k) {
        snprintf(name, sizeof name, "%lu", (unsigned long)passes[k]);
        plot_key(&p, 740, 268 + 18.0 * k, plot_pens[k], plot_markers[k], name);
    }
    return plot_end(&p);
}
