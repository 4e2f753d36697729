/* field.c - how much order and how many defects are left when a p-atic field is averaged over balls of radius R?

     cc field.c -o field -lm && ./field DIRECTORY               (from the root: make pictures)

   A flat tissue without any order of its own: the Voronoi cells of points by chance, evened out once. Its raw field
   has a defect every few cells. At even p the mean over a ball is that of many independent cells, and order falls as
   1/R. At odd p the two sides of a shared edge cancel, only the rim of the ball is left, and order falls as R^-1.5;
   so first neighbours point against each other, and defects hardly thin out. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "../beyond/patic.h"
#include "theory.h"

#include <stdint.h>

#define SIDE    48 /* cells along a side of the square */
#define SEEDS   (SIDE * SIDE)
#define CORNERS 32 /* of one cell, at most */
#define RANKS   6
#define RADII   7
#define BINS    8

static const double radius[RADII] = {0, 1, 1.5, 2.1, 3, 4.2, 6};

static double seed[SEEDS][2], corner[2 * SEEDS * CORNERS];
static size_t offset[SEEDS + 1], cells;
static uint64_t state = 1;

/* In [0, 1), the same on every machine: splitmix64. */
static double by_chance(void)
{
    uint64_t z = state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

/* Cuts off what is nearer to seed b than to seed a; returns the number of corners left. */
static size_t cut(double *x, size_t n, const double *a, const double *b)
{
    double middle[2], along[2], kept[2 * CORNERS];
    size_t i, left = 0;
    int k;
    for (k = 0; k < 2; ++k) {
        middle[k] = (a[k] + b[k]) / 2;
        along[k] = b[k] - a[k];
    }
    for (i = 0; i < n; ++i) {
        const double *u = x + 2 * i, *v = x + 2 * ((i + 1) % n);
        double s = (u[0] - middle[0]) * along[0] + (u[1] - middle[1]) * along[1];
        double t = (v[0] - middle[0]) * along[0] + (v[1] - middle[1]) * along[1];
        if (s <= 0) {
            kept[2 * left] = u[0];
            kept[2 * left++ + 1] = u[1];
        }
        if ((s < 0 && t > 0) || (s > 0 && t < 0)) {
            kept[2 * left] = u[0] + s / (s - t) * (v[0] - u[0]);
            kept[2 * left++ + 1] = u[1] + s / (s - t) * (v[1] - u[1]);
        }
    }
    memcpy(x, kept, 2 * left * sizeof *x);
    return left;
}

/* The Voronoi cell of a seed within the square; seeds farther than `reach` cannot touch it. */
static size_t voronoi_cell(size_t i, double *x)
{
    const double reach = 7;
    static const double square[8] = {0, 0, SIDE, 0, SIDE, SIDE, 0, SIDE};
    size_t n = 4, j;
    memcpy(x, square, sizeof square);
    for (j = 0; j < SEEDS; ++j)
        if (j != i && fabs(seed[j][0] - seed[i][0]) < reach && fabs(seed[j][1] - seed[i][1]) < reach)
            n = cut(x, n, seed[i], seed[j]);
    return n;
}

/* Seeds by chance, moved once to the middle of the corners of their cells; cells that touch the square are left out. */
static void make_tissue(void)
{
    double x[2 * CORNERS];
    static double moved[SEEDS][2];
    size_t i, k, n;
    int touches;
    for (i = 0; i < SEEDS; ++i)
        for (k = 0; k < 2; ++k) seed[i][k] = SIDE * by_chance();
    for (i = 0; i < SEEDS; ++i) {
        n = voronoi_cell(i, x);
        moved[i][0] = moved[i][1] = 0;
        for (k = 0; k < n; ++k) {
            moved[i][0] += x[2 * k] / (double)n;
            moved[i][1] += x[2 * k + 1] / (double)n;
        }
    }
    memcpy(seed, moved, sizeof seed);
    for (i = 0; i < SEEDS; ++i) {
        double *at = corner + 2 * offset[cells];
        n = voronoi_cell(i, at);
        for (touches = 0, k = 0; k < 2 * n; ++k) touches |= !(at[k] > 1e-9 && at[k] < SIDE - 1e-9);
        if (touches) continue;
        offset[cells + 1] = offset[cells] + n;
        ++cells;
    }
}

/* Mean order of the cells whose ball lies within the tissue at the largest radius. */
static double mean_order(const patic *t, const double *z)
{
    double sum = 0, edge = radius[RADII - 1] + 2, count = 0;
    size_t c;
    for (c = 0; c < t->cells; ++c) {
        const double *x = t->cell[c].centre;
        if (x[0] < edge || x[0] > SIDE - edge || x[1] < edge || x[1] > SIDE - edge) continue;
        sum += hypot(z[2 * c], z[2 * c + 1]);
        ++count;
    }
    return sum / count;
}

/* The slope of log y over log x from the second value on, by least squares. */
static double slope(const double *x, const double *y, int n)
{
    double a = 0, b = 0, aa = 0, ab = 0, m = n - 1;
    int i;
    for (i = 1; i < n; ++i) {
        a += log(x[i]) / m;
        b += log(y[i]) / m;
    }
    for (i = 1; i < n; ++i) {
        aa += (log(x[i]) - a) * (log(x[i]) - a);
        ab += (log(x[i]) - a) * (log(y[i]) - b);
    }
    return ab / aa;
}

static void draw_slope(plot *p, const plot_axes *axes, double power, double at, const char *text)
{
    double x[2] = {1.4, 6}, y[2];
    plot_pen pen = {"#999999", 0.9, "1 2"};
    y[0] = at;
    y[1] = at * pow(x[1] / x[0], power);
    plot_curve(p, axes, x, y, 2, pen, PLOT_NONE);
    plot_text(p, plot_x(axes, x[1]) - 4, plot_y(axes, y[1]) + 12, 9, AT_END, text);
}

int main(int argc, char **argv)
{
    plot_axes order_axes = {52, 12, 230, 220, {0.85, 10}, {0.004, 0.6}, {1, 1}};
    plot_axes defect_axes = {350, 12, 230, 220, {0.85, 10}, {8, 2000}, {1, 1}};
    plot_axes correlation_axes = {650, 12, 200, 220, {0, BINS}, {-0.4, 0.4}, {0, 0}};
    double order[RANKS + 1][RADII], defects[RANKS + 1][RADII], g[RANKS + 1][BINS], r[BINS], *z, *coarse;
    surfmink_outline all;
    patic_bin bin[BINS];
    patic t;
    plot p;
    void *memory;
    int rank, k;
    if (theory_begin(&p, argc, argv, "field", 950, 276)) return 1;
    make_tissue();
    all = surfmink_plane(corner, offset[cells]);
    memory = malloc(patic_bytes(offset, cells, RANKS));
    z = (double *)malloc(2 * cells * sizeof *z);
    coarse = (double *)malloc(2 * cells * sizeof *coarse);
    if (!memory || !z || !coarse) return 1;
    theory_need(patic_build(&t, &all, offset, cells, RANKS, -1, memory));
    printf("%lu cells, chi %ld, mean distance of neighbours %.4f\n", (unsigned long)cells, t.chi, t.spacing);
    for (rank = 2; rank <= RANKS; ++rank) {
        theory_need(patic_field(&t, rank, z, NULL));
        for (k = 0; k < RADII; ++k) {
            theory_need(patic_coarsen(&t, rank, radius[k] * t.spacing, z, coarse));
            theory_need(patic_charges(&t, rank, coarse));
            order[rank][k] = mean_order(&t, coarse);
            defects[rank][k] = (double)patic_defects(&t, coarse);
        }
        patic_correlation(&t, rank, z, t.spacing, BINS, bin);
        for (k = 0; k < BINS; ++k) {
            g[rank][k] = bin[k].sum / bin[k].weight;
            r[k] = k + 0.5;
        }
    }
    printf("\nmean order by radius in mean distances\n p");
    for (k = 0; k < RADII; ++k) printf(" %7.1f", radius[k]);
    printf("   slope\n");
    for (rank = 2; rank <= RANKS; ++rank) {
        printf("%2d", rank);
        for (k = 0; k < RADII; ++k) printf(" %7.4f", order[rank][k]);
        printf(" %7.2f\n", slope(radius, order[rank], RADII));
    }
    printf("\nnumber of defects\n");
    for (rank = 2; rank <= RANKS; ++rank) {
        printf("%2d", rank);
        for (k = 0; k < RADII; ++k) printf(" %7.0f", defects[rank][k]);
        putchar('\n');
    }
    printf("\nG by distance in mean distances\n p");
    for (k = 0; k < BINS; ++k) printf(" %7.1f", r[k]);
    putchar('\n');
    for (rank = 2; rank <= RANKS; ++rank) {
        printf("%2d", rank);
        for (k = 0; k < BINS; ++k) printf(" %7.4f", g[rank][k]);
        putchar('\n');
    }
    plot_frame(&p, &order_axes, 1, 1, "R in mean distances", "mean order");
    plot_frame(&p, &defect_axes, 1, 1, "R in mean distances", "defects");
    plot_frame(&p, &correlation_axes, 2, 0.2, "distance in mean distances", "$G_p$");
    draw_slope(&p, &order_axes, -1, 0.34, "$R$^{\\minus1}");
    draw_slope(&p, &order_axes, -1.5, 0.05, "$R$^{\\minus1.5}");
    for (rank = 2; rank <= RANKS; ++rank) {
        char name[16];
        plot_curve(&p, &order_axes, radius + 1, order[rank] + 1, RADII - 1, plot_pens[rank - 2],
                   plot_markers[rank - 2]);
        plot_curve(&p, &defect_axes, radius + 1, defects[rank] + 1, RADII - 1, plot_pens[rank - 2],
                   plot_markers[rank - 2]);
        plot_curve(&p, &correlation_axes, r, g[rank], BINS, plot_pens[rank - 2], plot_markers[rank - 2]);
        snprintf(name, sizeof name, "$p$ = %d", rank);
        plot_key(&p, 872, 40 + 20.0 * (rank - 2), plot_pens[rank - 2], plot_markers[rank - 2], name);
    }
    plot_letter(&p, 6, 12, "(a)");
    plot_letter(&p, 302, 12, "(b)");
    plot_letter(&p, 600, 12, "(c)");
    free(memory);
    free(z);
    free(coarse);
    return plot_end(&p);
}
