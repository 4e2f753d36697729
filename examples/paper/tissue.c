/* tissue.c - how are the cells of a curved tissue shaped, and which way do they point?

     cc tissue.c -o tissue -lm && ./tissue DIRECTORY DATA          (from the root: make paper)

   The paper closes with three cells of a flower bud (figure "sketch-blender"): mu_2 ... mu_6, and the p-fold directions
   drawn in the tangent plane. Its images are not ours to give, so this is the synthetic tissue of examples/data: 400
   cells on an ellipsoid. Three cells in view are shown: the most elongated, the most pentagonal, the most hexagonal.
   Arrows are eigenvectors of -lambda_p, as in the paper: they point to the corners of a regular p-gon, and for p = 2
   along the long axis. Small arrows stand at the middles of edges; the large ones at the centre are their mean. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "experiment.h"
#include "../picture/plot.h"

#define RANKS        6
#define MOST_CELLS   400
#define MOST_CORNERS 16

typedef struct cell {
    size_t n;
    double corner[3 * MOST_CORNERS], normal[3 * MOST_CORNERS];
    double mu[RANKS + 1], g[2 * RANKS + 2], phase[MOST_CORNERS], turning[MOST_CORNERS], length[MOST_CORNERS];
    double middle[3], up[3]; /* mean of the corners, and of the normals */
    surfmink_functionals w;
} cell;

static void unit(double *v)
{
    double length = sqrt(dot(v, v));
    int k;
    for (k = 0; k < 3; ++k) v[k] /= length;
}

/* The cells of examples/data/tissue.tsv: cell, x y z, nx ny nz. */
static int read_tissue(const experiment *e, cell *cells)
{
    char path[512], line[256];
    double x[3], n[3];
    int number, last = -1, count = 0, k;
    FILE *in;
    snprintf(path, sizeof path, "%s/../../data/tissue.tsv", e->data);
    in = fopen(path, "r");
    if (!in) perror(path);
    experiment_need(in != NULL, "run from the root of the repository, or give the directory of the data");
    while (fgets(line, sizeof line, in)) {
        if (sscanf(line, "%d %lf %lf %lf %lf %lf %lf", &number, x, x + 1, x + 2, n, n + 1, n + 2) != 7) continue;
        if (number != last) {
            experiment_need(count < MOST_CELLS, "too many cells");
            cells[count++].n = 0;
        }
        last = number;
        experiment_need(cells[count - 1].n < MOST_CORNERS, "a cell has too many corners");
        for (k = 0; k < 3; ++k) {
            cells[count - 1].corner[3 * cells[count - 1].n + (size_t)k] = x[k];
            cells[count - 1].normal[3 * cells[count - 1].n + (size_t)k] = n[k];
        }
        ++cells[count - 1].n;
    }
    fclose(in);
    return count;
}

static surfmink_outline outline_of(const cell *c)
{
    return surfmink_embedded(c->corner, c->normal, c->n);
}

static void measure(cell *c)
{
    surfmink_outline outline = outline_of(c);
    size_t i;
    int k, status = surfmink_measure(&outline, RANKS, c->mu, c->g, &c->w, NULL);
    if (status == SURFMINK_OK) status = surfmink_edges(&outline, c->length, c->turning, NULL);
    if (status == SURFMINK_OK) status = surfmink_phases(c->turning, c->n, SURFMINK_CORRECTED, c->phase);
    experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
    for (k = 0; k < 3; ++k) {
        c->middle[k] = c->up[k] = 0;
        for (i = 0; i < c->n; ++i) {
            c->middle[k] += c->corner[3 * i + (size_t)k] / (double)c->n;
            c->up[k] += c->normal[3 * i + (size_t)k];
        }
    }
    unit(c->up);
}

/* The smallest rotation that takes the unit vector a to b, applied to v. */
static void carry(const double a[3], const double b[3], const double v[3], double out[3])
{
    double turn[3], cosine = dot(a, b), along;
    cross(a, b, turn);
    along = dot(turn, v) / (1 + cosine);
    out[0] = cosine * v[0] + turn[1] * v[2] - turn[2] * v[1] + along * turn[0];
    out[1] = cosine * v[1] + turn[2] * v[0] - turn[0] * v[2] + along * turn[1];
    out[2] = cosine * v[2] + turn[0] * v[1] - turn[1] * v[0] + along * turn[2];
}

/* The p directions at the centre of a cell: those at all edges are turned into the plane of the mean normal and
   averaged as p-fold directions, weighted with the lengths of the edges. Returns how much they agree, in [0, 1]. */
static double centre_directions(const cell *c, int p, double *direction)
{
    surfmink_outline outline = outline_of(c);
    double frame[9], nu[3], tau[3], e1[3], e2[3], re = 0, im = 0, psi;
    size_t i;
    int k, n;
    for (i = 0; i < c->n; ++i) {
        surfmink_frame(&outline, i, frame);
        carry(frame + 6, c->up, frame, nu);
        carry(frame + 6, c->up, frame + 3, tau);
        if (i == 0)
            for (k = 0; k < 3; ++k) {
                e1[k] = nu[k];
                e2[k] = tau[k];
            }
        psi = atan2(c->g[2 * p + 1], c->g[2 * p]) / p + PI / p - c->phase[i] + atan2(dot(nu, e2), dot(nu, e1));
        re += c->length[i] * cos(p * psi);
        im += c->length[i] * sin(p * psi);
    }
    for (n = 0; n < p; ++n) {
        psi = (atan2(im, re) + 2 * PI * n) / p;
        for (k = 0; k < 3; ++k) direction[3 * n + k] = cos(psi) * e1[k] + sin(psi) * e2[k];
    }
    return hypot(re, im) / c->w.length;
}

/* --- figure ------------------------------------------------------------------------------------------------------- */

static void draw_outline(plot *p, const plot_view *view, const cell *c, const double *about, plot_pen pen,
                         const char *fill)
{
    double xy[2 * MOST_CORNERS], x[3];
    size_t i;
    int k;
    for (i = 0; i < c->n; ++i) {
        for (k = 0; k < 3; ++k) x[k] = c->corner[3 * i + (size_t)k] - about[k];
        plot_project(view, x, xy + 2 * i);
    }
    plot_path(p, xy, c->n, 1, pen, fill);
}

static void draw_vector(plot *p, const plot_view *view, const double *from, const double *direction, double length,
                        plot_pen pen)
{
    double tip[3], a[2], b[2];
    int k;
    for (k = 0; k < 3; ++k) tip[k] = from[k] + length * direction[k];
    plot_project(view, from, a);
    plot_project(view, tip, b);
    plot_arrow(p, a[0], a[1], b[0], b[1], pen);
}

/* One cell, seen at 35 degrees to its normal: its normals (p = 0), or its p-fold directions. */
static void draw_cell(plot *p, const cell *c, int rank, double x, double y)
{
    static const double origin[3] = {0, 0, 0};
    plot_pen rim = {"#009e73", 1.7, ""}, small = {"#7b3294", 1, ""}, large = {"#000000", 1.7, ""};
    surfmink_outline outline = outline_of(c);
    double toward[3], at[3], frame[9], arrow[3 * RANKS], size = c->w.length / 2.9;
    plot_view view;
    size_t i;
    int k, n;
    for (k = 0; k < 3; ++k) toward[k] = (k == 2) - c->up[2] * c->up[k];
    unit(toward);
    for (k = 0; k < 3; ++k) toward[k] = cos(0.6) * c->up[k] - sin(0.6) * toward[k];
    view = plot_look(atan2(toward[1], toward[0]) * 180 / PI, asin(toward[2]) * 180 / PI, x, y, 92 / size);
    draw_outline(p, &view, c, c->middle, rim, "#eef7f3");
    for (i = 0; i < c->n; ++i) {
        const double *next = c->corner + 3 * ((i + 1) % c->n);
        for (k = 0; k < 3; ++k) at[k] = (c->corner[3 * i + (size_t)k] + next[k]) / 2 - c->middle[k];
        surfmink_frame(&outline, i, frame);
        if (rank == 0) {
            for (k = 0; k < 3; ++k) at[k] = c->corner[3 * i + (size_t)k] - c->middle[k];
            draw_vector(p, &view, at, c->normal + 3 * i, 0.33 * size, small);
            continue;
        }
        surfmink_eigenvectors(c->g, rank, -1, c->phase[i], frame, 3, arrow);
        for (n = 0; n < rank; ++n) draw_vector(p, &view, at, arrow + 3 * n, 0.13 * size, small);
    }
    if (rank == 0) {
        draw_vector(p, &view, origin, c->up, 0.33 * size, large);
        return;
    }
    centre_directions(c, rank, arrow);
    for (n = 0; n < rank; ++n) draw_vector(p, &view, origin, arrow + 3 * n, 0.3 * size, large);
}

static void draw(const experiment *e, const cell *cells, int count, const cell *const *chosen, const plot_view *view)
{
    static const double origin[3] = {0, 0, 0};
    static const char *const column[7] = {"outline, normals", "",        "$p$ = 2", "$p$ = 3",
                                          "$p$ = 4",          "$p$ = 5", "$p$ = 6"};
    plot_pen thin = {"#444444", 0.5, ""}, thick = {"#000000", 2.2, ""};
    char colour[8], name[8];
    double xy[2];
    plot p;
    int i, k, n;
    if (plot_begin(&p, e->figure, 780, 655)) exit(1);
    plot_letter(&p, 8, 20, "(a)");
    for (i = 0; i < count; ++i)
        if (dot(cells[i].up, view->camera.eye) > 0.02)
            draw_outline(&p, view, &cells[i], origin, thin, plot_ramp(cells[i].mu[6], colour));
    for (k = 0; k < 3; ++k) draw_outline(&p, view, chosen[k], origin, thick, "none");
    for (k = 0; k < 3; ++k) {
        plot_project(view, chosen[k]->middle, xy);
        plot_disc(&p, xy[0], xy[1], 7.5, plot_thin, "#ffffff");
        snprintf(name, sizeof name, "%d", k + 1);
        plot_text_as(&p, xy[0], xy[1] + 4, 11, AT_MIDDLE, "#000000", 1, 0, name);
    }
    plot_scale(&p, 502, 60, 12, 120, "$\\mu_6$");
    plot_letter(&p, 550, 20, "(b)");
    for (k = 0; k < 3; ++k) {
        plot_axes axes = {620, 22.0 + 76 * k, 130, 50, {0, 1}, {0, 1}, {0, 0}};
        plot_ticks(&p, &axes, 1, 0.5, "");
        plot_bars(&p, &axes, chosen[k]->mu, 2, RANKS, 9);
        plot_text(&p, 580, axes.top + 30, 11, AT_MIDDLE, "$\\mu_p$");
        plot_text(&p, 760, axes.top + 60, 9, AT_MIDDLE, "$p$");
        snprintf(name, sizeof name, "%d", k + 1);
        plot_disc(&p, 562, axes.top + 26, 7.5, plot_thin, "#ffffff");
        plot_text_as(&p, 562, axes.top + 30, 11, AT_MIDDLE, "#000000", 1, 0, name);
    }
    plot_letter(&p, 8, 270, "(c)");
    for (k = 0; k < 3; ++k) {
        double y = 345.0 + 122 * k;
        snprintf(name, sizeof name, "%d", k + 1);
        plot_disc(&p, 18, y, 7.5, plot_thin, "#ffffff");
        plot_text_as(&p, 18, y + 4, 11, AT_MIDDLE, "#000000", 1, 0, name);
        for (n = 0; n <= RANKS; ++n)
            if (n != 1) draw_cell(&p, chosen[k], n, 88 + 124.0 * (n ? n - 1 : 0), y);
    }
    for (n = 0; n <= RANKS; ++n)
        if (n != 1) plot_text(&p, 88 + 124.0 * (n ? n - 1 : 0), 278, 11, AT_MIDDLE, column[n]);
    if (plot_end(&p)) exit(1);
}

int main(int argc, char **argv)
{
    static const char *const why[3] = {"most elongated", "most pentagonal", "most hexagonal"};
    static const int by[3] = {2, 5, 6};
    static cell cells[MOST_CELLS];
    const cell *chosen[3] = {NULL, NULL, NULL};
    plot_view view = plot_look(-62, 24, 255, 130, 2.1);
    double curvature = 0, frame[9], arrow[3 * RANKS], there[3 * RANKS], off = 0, coherence;
    experiment e;
    int count, i, k, n, edge, p;
    if (experiment_begin(&e, argc, argv, "tissue")) return 1;
    count = read_tissue(&e, cells);
    fprintf(e.table, "cell\tcorners\tL\tS");
    for (p = 2; p <= RANKS; ++p) fprintf(e.table, "\tmu_%d", p);
    for (p = 2; p <= RANKS; ++p) fprintf(e.table, "\tcoherence_%d", p);
    fputc('\n', e.table);
    for (i = 0; i < count; ++i) {
        measure(&cells[i]);
        curvature += cells[i].w.curvature;
        fprintf(e.table, "%d\t%lu\t%.6f\t%.9f", i, (unsigned long)cells[i].n, cells[i].w.length, cells[i].w.turning);
        for (p = 2; p <= RANKS; ++p) fprintf(e.table, "\t%.9f", cells[i].mu[p]);
        for (p = 2; p <= RANKS; ++p) fprintf(e.table, "\t%.6f", centre_directions(&cells[i], p, arrow));
        fputc('\n', e.table);
        for (k = 0; k < 3; ++k)
            if (dot(cells[i].up, view.camera.eye) > 0.75 && (!chosen[k] || cells[i].mu[by[k]] > chosen[k]->mu[by[k]]))
                chosen[k] = &cells[i];
    }
    printf("Three of %d cells of a tissue on an ellipsoid\n", count);
    for (k = 0; k < 3; ++k) {
        printf("%d  cell %3d, %-15s %lu corners ", k + 1, (int)(chosen[k] - cells), why[k],
               (unsigned long)chosen[k]->n);
        for (p = 2; p <= RANKS; ++p) {
            coherence = centre_directions(chosen[k], p, arrow);
            printf("  mu_%d = %.3f (coherence %.3f)", p, chosen[k]->mu[p], coherence);
        }
        putchar('\n');
    }
    /* Around each corner the angles in its tangent plane make a full turn, so the sum is Euler's 4 pi exactly. */
    printf("curvature enclosed by all cells: %.9f, 4 pi = %.9f\n", curvature, 4 * PI);
    experiment_near(&e, "curvature of the whole tissue", curvature, 4 * PI, 1e-6);
    for (k = 0; k < 3; ++k) /* paper 3.1: eigenvectors at two edges are transports of each other */
        for (p = 2; p <= RANKS; ++p)
            for (edge = 0; edge <= (int)chosen[k]->n; ++edge) {
                const cell *c = chosen[k];
                surfmink_outline outline = outline_of(c);
                size_t at = (size_t)edge % c->n;
                surfmink_frame(&outline, 0, frame);
                surfmink_eigenvectors(c->g, p, -1, 0, frame, 3, arrow);
                surfmink_frame(&outline, at, frame);
                surfmink_eigenvectors(c->g, p, -1, c->phase[at], frame, 3, there);
                surfmink_transport_vector(&outline, c->turning, 0, edge, SURFMINK_CORRECTED, arrow);
                for (n = 0; n < 3; ++n) off = fmax(off, fabs(arrow[n] - there[n]));
            }
    printf("eigenvectors at all edges against those carried there from edge 0: %.1e\n", off);
    experiment_near(&e, "eigenvectors carried along the outlines", off, 0, 1e-13);
    draw(&e, cells, count, chosen, &view);
    return experiment_end(&e);
}
