/* levelset.c - and if neither the surface nor the curve is known, only a triangulation and a function on it?

     cc levelset.c -o levelset -lm && ./levelset DIRECTORY DATA    (from the root: make paper)

   The zero level set of a flower function with four petals on triangulated unit spheres (paper 5.2, figures
   "triangulated-sphere" and "sphere-convergence"): corners where it cuts the edges of triangles, normals averaged over
   triangles. The paper sees an erratic first order; turned at the right corner, errors fall smoothly with order 2. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "../surfaces/mesh.h"
#include "experiment.h"
#include "../picture/plot.h"

#define RANKS  8
#define LEVELS 9

/* Of the smooth curve, in 50-digit arithmetic; p = 2, 4, 6, 8. */
static const double exact[RANKS + 1] = {
    1, 0, 0.041307578749043, 0, 0.169084042925900, 0, 0.0742854634691783, 0, 0.301915775390885};

typedef struct result {
    double h, mu[RANKS + 1], late[RANKS + 1]; /* late: turned one corner late, as the paper's tables are */
    size_t corners;
} result;

/* rho of paper 5.2, negative inside. The paper adds pi to the angle t: with four petals that changes nothing. */
static double flower(const double x[3])
{
    double theta = acos(x[2] / sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])) - PI / 2;
    double phi = remainder(atan2(x[1], x[0]) - PI / 4, 2 * PI);
    return hypot(theta, phi) - (0.5 - 0.1 * sin(4 * (atan2(phi, theta) + PI)));
}

/* The level set on a sphere after so many subdivisions; keeps mesh and loops for a drawing if asked. */
static void measure(int base, int level, result *r, mesh *m, mesh_loops *loops)
{
    mesh_error error;
    double *field, *length, *turning, *phase, g[2 * RANKS + 2], first;
    surfmink_outline outline;
    size_t i, n;
    int status;
    if (mesh_sphere(m, base, level, &error) || mesh_connect(m, &error) || mesh_normals(m, &error))
        experiment_need(0, error.text);
    field = (double *)malloc(m->vertices * sizeof *field);
    experiment_need(field != NULL, "out of memory");
    for (i = 0; i < m->vertices; ++i) field[i] = flower(m->vertex + 3 * i);
    if (mesh_level_set(m, field, 0, MESH_BELOW, loops, &error)) experiment_need(0, error.text);
    free(field);
    experiment_need(loops->loops == 1, "the flower is one curve");
    n = loops->start[1];
    length = (double *)malloc(3 * n * sizeof *length);
    experiment_need(length != NULL, "out of memory");
    turning = length + n;
    phase = turning + n;
    r->h = mesh_longest_edge(m);
    r->corners = n;
    outline = surfmink_embedded(loops->corner, loops->normal, n);
    status = surfmink_measure(&outline, RANKS, r->mu, NULL, NULL, NULL);
    if (status == SURFMINK_OK) status = surfmink_edges(&outline, length, turning, NULL);
    experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
    first = turning[n - 1];
    memmove(turning + 1, turning, (n - 1) * sizeof *turning);
    turning[0] = first;
    surfmink_phases(turning, n, SURFMINK_CORRECTED, phase);
    surfmink_irreducible(length, phase, n, RANKS, g);
    surfmink_spectrum(g, RANKS, NULL, r->late, NULL);
    free(length);
}

/* Slope of log error over log h by least squares, over the finest levels. */
static double order(const result *r, int last, int count, int p)
{
    double x, y, sx = 0, sy = 0, sxx = 0, sxy = 0;
    int i;
    for (i = last - count + 1; i <= last; ++i) {
        x = log(r[i].h);
        y = log(fabs(r[i].mu[p] - exact[p]));
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

static void compare(experiment *e, const char *name, const result *r, int first, int last)
{
    static printed t;
    char what[64];
    int level, row, p;
    printed_read(&t, e, "levelset_sphere.tsv");
    printf("%-5s %5s %9s %8s", name, "level", "h", "corners");
    for (p = 2; p <= RANKS; p += 2) printf("  mu_%d computed / reference    error", p);
    putchar('\n');
    for (level = first; level <= last; ++level) {
        printf("%-5s %5d %9.6f %8lu", name, level, r[level].h, (unsigned long)r[level].corners);
        fprintf(e->table, "%s\t%d\t%.9f\t%lu", name, level, r[level].h, (unsigned long)r[level].corners);
        for (row = 0; row < t.rows; ++row)
            if (strcmp(printed_text(&t, row, "mesh"), name) == 0 && atoi(printed_text(&t, row, "level")) == level)
                break;
        for (p = 2; p <= RANKS; p += 2) {
            double error = fabs(r[level].mu[p] - exact[p]), late = fabs(r[level].late[p] - exact[p]), want;
            fprintf(e->table, "\t%.12f\t%.6e\t%.6e", r[level].mu[p], error, late);
            if (row == t.rows) {
                printf("  %.10f / %-10s  %.3e", r[level].mu[p], "-", error);
                continue;
            }
            printf("  %.10f / %s  %.3e", r[level].mu[p],
                   printed_text(&t, row,
                                p == 2   ? "mu2"
                                : p == 4 ? "mu4"
                                : p == 6 ? "mu6"
                                         : "mu8"),
                   error);
            snprintf(what, sizeof what, "%s level %d, mu_%d", name, level, p);
            experiment_near(e, what, r[level].mu[p], printed_rank(&t, row, "mu", p), 6e-11);
            snprintf(what, sizeof what, "%s level %d, mu_%d one corner late", name, level, p);
            want = printed_rank(&t, row, "lag_err", p);
            experiment_near(e, what, late, want, 6e-4 * want);
        }
        putchar('\n');
        fputc('\n', e->table);
    }
}

/* --- figures ------------------------------------------------------------------------------------------------------ */

/* The near half of a mesh in thin lines, and the outline on it. */
static void draw_mesh(plot *p, const mesh *m, const mesh_loops *loops, double left, double top, const char *title)
{
    plot_view view = plot_look(45, 12, left + 100, top + 112, 92);
    plot_pen thin = {"#9a9a9a", 0.4, ""}, outline = {"#d55e00", 1.8, ""};
    double xy[2], *chain = (double *)malloc(2 * loops->start[1] * sizeof *chain);
    const double *corner[3];
    size_t t, i;
    int k;
    experiment_need(chain != NULL, "out of memory");
    fprintf(p->file, "<path fill=\"#f3f3f3\" stroke=\"%s\" stroke-width=\"%g\" d=\"", thin.colour, thin.width);
    for (t = 0; t < m->triangles; ++t) {
        double a[3], b[3], n[3];
        for (k = 0; k < 3; ++k) corner[k] = m->vertex + 3 * m->triangle[3 * t + (size_t)k];
        for (k = 0; k < 3; ++k) {
            a[k] = corner[1][k] - corner[0][k];
            b[k] = corner[2][k] - corner[0][k];
        }
        n[0] = a[1] * b[2] - a[2] * b[1];
        n[1] = a[2] * b[0] - a[0] * b[2];
        n[2] = a[0] * b[1] - a[1] * b[0];
        if (dot(n, view.camera.eye) <= 0) continue;
        for (k = 0; k < 3; ++k) {
            plot_project(&view, corner[k], xy);
            fprintf(p->file, "%s%.1f %.1f", k ? " " : "M", xy[0], xy[1]);
        }
        fputc('z', p->file);
    }
    fprintf(p->file, "\"/>\n");
    for (i = 0; i < loops->start[1]; ++i) plot_project(&view, loops->corner + 3 * i, chain + 2 * i);
    plot_path(p, chain, loops->start[1], 1, outline, "none");
    if (loops->start[1] < 60)
        for (i = 0; i < loops->start[1]; ++i) plot_disc(p, chain[2 * i], chain[2 * i + 1], 1.8, plot_thin, "#ffffff");
    plot_text(p, left + 100, top + 8, 11, AT_MIDDLE, title);
    free(chain);
}

static void draw_errors(plot *p, double left, const result *r, int first, int last, const char *title, int right)
{
    plot_axes axes = {left, 265, 290, 230, {1.4, 0.004}, {2e-6, 1.5}, {1, 1}};
    plot_pen late = {"#bbbbbb", 1.1, ""}, slope = {"#888888", 0.9, "3 3"};
    double h[LEVELS + 1], error[LEVELS + 1], guide[2], at[2] = {0.35, 0.006};
    int level, p_, n = 0;
    plot_frame(p, &axes, 0, 0, "grid size $h$", left < 100 ? "error of $\\mu_p$" : "");
    plot_letter(p, left, 256, title);
    guide[0] = 0.8;
    guide[1] = guide[0] * at[1] / at[0];
    plot_curve(p, &axes, at, guide, 2, slope, PLOT_NONE);
    plot_text_as(p, plot_x(&axes, 0.022), plot_y(&axes, 0.05) - 11, 9, AT_MIDDLE, "#555555", 0, 0, "order 1");
    guide[0] = 0.028;
    guide[1] = guide[0] * pow(at[1] / at[0], 2);
    plot_curve(p, &axes, at, guide, 2, slope, PLOT_NONE);
    plot_text_as(p, plot_x(&axes, 0.084), plot_y(&axes, 0.00032), 9, AT_MIDDLE, "#555555", 0, 0, "order 2");
    for (p_ = 2; p_ <= 6; p_ += 2) {
        for (n = 0, level = first; level <= last; ++level, ++n) {
            h[n] = r[level].h;
            error[n] = fabs(r[level].late[p_] - exact[p_]);
        }
        plot_curve(p, &axes, h, error, (size_t)n, late, PLOT_NONE);
    }
    for (p_ = 2; p_ <= 8; p_ += 2) {
        for (n = 0, level = first; level <= last; ++level, ++n) error[n] = fabs(r[level].mu[p_] - exact[p_]);
        plot_curve(p, &axes, h, error, (size_t)n, plot_pens[p_ / 2 - 1], plot_markers[p_ / 2 - 1]);
    }
    if (!right) return;
    for (p_ = 2; p_ <= 8; p_ += 2) {
        char name[16];
        snprintf(name, sizeof name, "$\\mu_%d$", p_);
        plot_key(p, 75 + 80.0 * (p_ / 2 - 1), 555, plot_pens[p_ / 2 - 1], plot_markers[p_ / 2 - 1], name);
    }
    plot_key(p, 400, 555, late, PLOT_NONE, "$\\mu_2, \\mu_4, \\mu_6$ turned one corner late (the paper's index)");
}

int main(int argc, char **argv)
{
    static const int drawn[3] = {0, 2, 4};
    static const char *const title[3] = {"icosahedron, level 0", "level 2", "level 4"};
    static result ico[LEVELS + 1], octa[LEVELS + 1];
    mesh m;
    mesh_loops loops;
    experiment e;
    plot p;
    double slope;
    char what[64];
    int level, k;
    if (experiment_begin(&e, argc, argv, "levelset") || plot_begin(&p, e.figure, 750, 575)) return 1;
    for (k = 0, level = 0; level < LEVELS; ++level) {
        measure(MESH_ICOSAHEDRON, level, &ico[level], &m, &loops);
        if (k < 3 && level == drawn[k]) {
            draw_mesh(&p, &m, &loops, 20 + 245.0 * k, 8, title[k]);
            ++k;
        }
        mesh_free(&m);
        mesh_free_loops(&loops);
    }
    for (level = 1; level <= LEVELS; ++level) {
        measure(MESH_OCTAHEDRON, level, &octa[level], &m, &loops);
        mesh_free(&m);
        mesh_free_loops(&loops);
    }
    fprintf(e.table, "mesh\tlevel\th\tcorners");
    for (k = 2; k <= RANKS; k += 2) fprintf(e.table, "\tmu_%d\terror_%d\tlate_error_%d", k, k, k);
    fputc('\n', e.table);
    puts("A flower as a level set on triangulated spheres");
    compare(&e, "ico", ico, 0, LEVELS - 1);
    compare(&e, "octa", octa, 1, LEVELS);
    for (k = 2; k <= 6; k += 2) {
        slope = order(ico, LEVELS - 1, 4, k);
        snprintf(what, sizeof what, "icosahedron: mu_%d has order %.2f over the finest four levels", k, slope);
        experiment_claim(&e, what, slope > 1.7 && slope < 2.3);
        slope = order(octa, LEVELS, 4, k);
        snprintf(what, sizeof what, "octahedron: mu_%d has order %.2f over the finest four levels", k, slope);
        experiment_claim(&e, what, slope > 1.7 && slope < 2.3);
    }
    draw_errors(&p, 65, ico, 0, LEVELS - 1, "(b)  icosahedron", 0);
    draw_errors(&p, 430, octa, 1, LEVELS, "(c)  octahedron", 1);
    plot_letter(&p, 10, 18, "(a)");
    return plot_end(&p) + experiment_end(&e) > 0;
}
