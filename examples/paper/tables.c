/* tables.c - how fast do polygons approach a smooth curve? Tables 1 and 2 of the paper, digit by digit, and put right.

     cc tables.c -o tables -lm && ./tables DIRECTORY DATA          (from the root: make paper)

   A flower with three petals is cut into q edges of equal arc length, and L, kappa = S, the phases f and the components
   g_3 of the polygon are compared with those of the curve. The paper prints the errors for great-circle polygons on the
   unit sphere (Table 1, whose caption names the ellipsoid) and for straight chords on an ellipsoid (Table 2).

     1 exact     the curve itself, by Fourier series                         flower.h
     2 polygons  q = 4, 8, ..., 1024: lengths and turning angles             surfmink_edges
     3 printed   as the authors computed: turns one corner late ("lag"), |g - g_q| divided by 4, orders against q/2
     4 right     turns as in section 3, directions read at the middle of edge 0: order 2 */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "../surfaces/ellipsoid.h"
#include "experiment.h"
#include "flower.h"
#include "../picture/plot.h"

#define LEVELS       9 /* q = 4 << level */
#define MOST_CORNERS (4 << (LEVELS - 1))
#define RANK         3

enum edges { GREAT_CIRCLES, CHORDS, GEODESICS };

/* G_BEFORE: section 4.2 to the letter, which pairs rightly but reads at the edge before corner 0. */
enum column { LENGTH, KAPPA, F_LAG, G_LAG, F, G, G_MIDDLE, MU, COLUMNS, G_BEFORE = COLUMNS, ALL_COLUMNS };
static const char *const heading[COLUMNS] = {"|L-L_q|", "|k-k_q|", "f, lag",    "g, lag /4",
                                             "f",       "g",       "g, middle", "mu_3"};
/* What the reference tables call them. */
static const char *const reference[COLUMNS] = {"L_err",     "kappa_err", "f_lag_err",         "g_lag_err_over4",
                                               "f_std_err", "g_std_err", "g_std_midedge_err", "mu3_std_err"};

typedef double errors[LEVELS][ALL_COLUMNS];

/* Distance of two components after each is divided by its perimeter, which the paper does too. */
static double distance(const double *g, const double *h, int p)
{
    return hypot(g[2 * p] / g[0] - h[2 * p] / h[0], g[2 * p + 1] / g[0] - h[2 * p + 1] / h[0]);
}

/* The largest error of a phase over all corners. */
static double phase_error(const flower_exact *exact, const double *phase, size_t q)
{
    double worst = 0;
    size_t i;
    for (i = 0; i < q; ++i)
        worst = fmax(worst,
                     fabs(phase[i] - flower_phase(exact, flower_time(exact, exact->length * (double)i / (double)q))));
    return worst;
}

/* The errors of one polygon of q corners. */
static void measure(const flower_exact *exact, enum edges edges, size_t q, double *error)
{
    static double corner[3 * MOST_CORNERS], normal[3 * MOST_CORNERS];
    static double length[MOST_CORNERS], turning[MOST_CORNERS], late[MOST_CORNERS], phase[MOST_CORNERS];
    double smooth[2 * RANK + 2], middle[2 * RANK + 2], g[2 * RANK + 2];
    surfmink_implicit body = surfmink_ellipsoid(exact->curve.axis);
    surfmink_surface surface = surfmink_implicit_surface(&body);
    surfmink_outline outline = surfmink_sphere(corner, q, 1.0);
    surfmink_functionals w;
    size_t i;
    int status;
    flower_polygon(exact, q, corner, normal);
    if (edges == CHORDS) outline = surfmink_embedded(corner, normal, q);
    if (edges == GEODESICS) outline = surfmink_on_surface(&surface, corner, q);
    status = surfmink_edges(&outline, length, turning, NULL);
    if (status == SURFMINK_OK) status = surfmink_total(&outline, length, turning, q, &w);
    experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
    flower_components(exact, 0, RANK, smooth);
    flower_components(exact, flower_time(exact, exact->length / (2 * (double)q)), RANK, middle);
    error[LENGTH] = fabs(w.length - exact->length);
    error[KAPPA] = fabs(w.turning - exact->kappa);

    /* Section 3: edge i has turned by alpha_1 + ... + alpha_i. */
    surfmink_phases(turning, q, SURFMINK_CORRECTED, phase);
    surfmink_irreducible(length, phase, q, RANK, g);
    error[F] = phase_error(exact, phase, q);
    error[G] = distance(g, smooth, RANK);
    error[G_MIDDLE] = distance(g, middle, RANK);
    error[MU] =
        fabs(hypot(g[2 * RANK], g[2 * RANK + 1]) / g[0] - hypot(smooth[2 * RANK], smooth[2 * RANK + 1]) / smooth[0]);

    /* Section 4.2: the same, turned on by alpha_0. */
    for (i = 0; i < q; ++i) phase[i] += 2 * PI / w.turning * turning[0];
    surfmink_irreducible(length, phase, q, RANK, g);
    error[G_BEFORE] = distance(g, smooth, RANK) / 4;

    /* The authors: by alpha_0 + ... + alpha_(i-1), one corner late. */
    for (i = 0; i < q; ++i) late[i] = turning[i > 0 ? i - 1 : q - 1];
    surfmink_phases(late, q, SURFMINK_CORRECTED, phase);
    surfmink_irreducible(length, phase, q, RANK, g);
    error[F_LAG] = phase_error(exact, phase, q);
    error[G_LAG] = distance(g, smooth, RANK) / 4;
}

static double order(errors error, int level, enum column c)
{
    return log2(error[level - 1][c] / error[level][c]);
}

static void print_errors(experiment *e, const char *name, errors error)
{
    int level, c;
    printf("%5s", "q");
    for (c = 0; c < COLUMNS; ++c) printf("  %-9s order", heading[c]);
    putchar('\n');
    for (level = 0; level < LEVELS; ++level) {
        printf("%5d", 4 << level);
        fprintf(e->table, "%s\t%d", name, 4 << level);
        for (c = 0; c < COLUMNS; ++c) {
            printf("  %9.3e ", error[level][c]);
            fprintf(e->table, "\t%.6e", error[level][c]);
            if (level > 0) {
                printf("%5.2f", order(error, level, (enum column)c));
                fprintf(e->table, "\t%.2f", order(error, level, (enum column)c));
            } else {
                printf("%5s", "-");
                fprintf(e->table, "\tnan");
            }
        }
        putchar('\n');
        fputc('\n', e->table);
    }
}

/* All digits of the reference, which has seven of each error, up to what its own rounding took away. */
static void compare_errors(experiment *e, const char *file, errors error, double rounding)
{
    static printed t;
    char what[128];
    int row, c;
    printed_read(&t, e, file);
    for (row = 0; row < t.rows; ++row)
        for (c = 0; c < COLUMNS; ++c) {
            double want = printed_number(&t, row, reference[c]);
            snprintf(what, sizeof what, "%s, q = %s, %s", file, printed_text(&t, row, "q"), reference[c]);
            experiment_near(e, what, error[row][c], want, 1e-6 * want + rounding);
        }
}

/* The smooth curve itself against 16 digits: L, kappa, mu_p, and g_p as a whole by p theta_p. */
static void compare_exact(experiment *e, const char *surface, const flower_exact *exact)
{
    static printed t;
    double g[2 * 12 + 2], mu, theta, worst = 0;
    char what[64];
    int row, p;
    printed_read(&t, e, "smooth_flowers.tsv");
    for (row = 0; row < t.rows && strcmp(printed_text(&t, row, "surface"), surface) != 0; ++row) continue;
    experiment_need(row < t.rows, "the exact values of a flower are missing");
    flower_components(exact, 0, 12, g);
    experiment_near(e, "L of the smooth curve", exact->length, printed_number(&t, row, "L"), 1e-14);
    experiment_near(e, "kappa of the smooth curve", exact->kappa, printed_number(&t, row, "kappa"), 1e-13);
    for (p = 1; p <= 12; ++p) {
        mu = printed_rank(&t, row, "mu_", p);
        theta = printed_rank(&t, row, "theta_", p);
        snprintf(what, sizeof what, "g_%d of the smooth curve on the %s", p, surface);
        mu = hypot(g[2 * p] / g[0] - mu * cos(p * theta), g[2 * p + 1] / g[0] - mu * sin(p * theta));
        worst = fmax(worst, mu);
        experiment_near(e, what, mu, 0, 1e-13);
    }
    printf("The smooth curve on the %s: L = %.14f, kappa = %.14f, g_1 ... g_12 to %.0e of the reference\n", surface,
           exact->length, exact->kappa, worst);
}

/* The paper's own table: every other level, with the order against the level between that it does not print. */
static void compare_printed(experiment *e, const char *file, errors error, const enum column *column,
                            const char *const *name, int columns)
{
    static printed t;
    char cell[64];
    int row, c, before = e->agree;
    printed_read(&t, e, file);
    printf("%5s", "q");
    for (c = 0; c < columns; ++c) printf("   %-10s computed printed   eoc printed", name[c]);
    putchar('\n');
    for (row = 0; row < t.rows; ++row) {
        int level = 2 * row;
        printf("%5s", printed_text(&t, row, "q"));
        for (c = 0; c < columns; ++c) {
            const char *value, *eoc;
            snprintf(cell, sizeof cell, "%s_err", name[c]);
            value = printed_text(&t, row, cell);
            snprintf(cell, sizeof cell, "%s_eoc", name[c]);
            eoc = printed_text(&t, row, cell);
            printf("              %.1e  %s", error[level][column[c]], value);
            snprintf(cell, sizeof cell, "%s: q = %d, %s", file, 4 << level, name[c]);
            experiment_printed(e, cell, value, 1, error[level][column[c]]);
            if (level == 0) {
                printf("%14s", "");
                continue;
            }
            printf("  %5.2f  %5s ", order(error, level, column[c]), eoc);
            experiment_printed(e, cell, eoc, 0, order(error, level, column[c]));
        }
        putchar('\n');
    }
    printf("%d entries agree\n\n", e->agree - before);
}

/* --- figure ------------------------------------------------------------------------------------------------------- */

static void draw_slope(plot *p, const plot_axes *axes, double start, int slope)
{
    double q[2] = {192, 1024}, error[2];
    plot_pen pen = {"#888888", 0.9, "3 3"};
    char label[16];
    double at = slope == 1 ? 420 : 330; /* above the line, or below the one that has errors above it */
    error[0] = start;
    error[1] = start * pow(q[0] / q[1], slope);
    plot_curve(p, axes, q, error, 2, pen, PLOT_NONE);
    snprintf(label, sizeof label, "order %d", slope);
    plot_text_as(p, plot_x(axes, at), plot_y(axes, start * pow(q[0] / at, slope)) + (slope == 1 ? -5 : 11), 9,
                 slope == 1 ? AT_START : AT_END, "#555555", 0, 0, label);
}

static void draw(const experiment *e, errors great_circles, errors chords)
{
    static const enum column shown[6] = {F, G_LAG, G, G_MIDDLE, MU, KAPPA};
    static const char *const meaning[6] = {"$f$",
                                           "$g_3$ as printed (one corner late, divided by 4)",
                                           "$g_3$ read at corner 0",
                                           "$g_3$ read at the middle of edge 0",
                                           "$\\mu_3$",
                                           "$\\kappa$"};
    static const char *const title[2] = {"(a)  great circles on the unit sphere", "(b)  chords on the ellipsoid"};
    static const double key[3] = {60, 365, 620};
    /* mu_3 lies on g_3 read at the middle, so that has a broad pale line to lie on. */
    plot_pen pen[6], broad = {"#9bd5c4", 5, ""};
    enum plot_marker marker[6];
    double q[LEVELS], error[LEVELS];
    plot p;
    int panel, k, level;
    for (k = 0; k < 6; ++k) {
        pen[k] = k == 3 ? broad : plot_pens[k];
        marker[k] = k == 3 ? PLOT_NONE : plot_markers[k];
    }
    if (plot_begin(&p, e->figure, 760, 370)) exit(1);
    for (panel = 0; panel < 2; ++panel) {
        plot_axes axes = {60, 30, 290, 235, {3, 1400}, {1e-6, 4}, {1, 1}};
        axes.left += 375 * panel;
        plot_frame(&p, &axes, 0, 0, "number of edges $q$", panel ? "" : "error");
        plot_letter(&p, axes.left, axes.top - 9, title[panel]);
        for (k = 0; k < 6; ++k) {
            for (level = 0; level < LEVELS; ++level) {
                q[level] = 4 << level;
                error[level] = panel ? chords[level][shown[k]] : great_circles[level][shown[k]];
            }
            plot_curve(&p, &axes, q, error, LEVELS, pen[k], marker[k]);
        }
        draw_slope(&p, &axes, 0.9, 1);
        draw_slope(&p, &axes, 4e-5, 2);
    }
    for (k = 0; k < 6; ++k) plot_key(&p, key[k / 2], 325 + 20 * (k % 2), pen[k], marker[k], meaning[k]);
    if (plot_end(&p)) exit(1);
}

int main(int argc, char **argv)
{
    static const enum column table1[4] = {LENGTH, KAPPA, F_LAG, G_LAG}, table2[3] = {LENGTH, KAPPA, G_LAG};
    static const char *const name1[4] = {"L", "kappa", "f", "g"}, *const name2[3] = {"L", "kappa", "g"};
    flower curve = {{1, 1, 1}, 0.7, 0.2, 3, PI / 2, PI / 4};
    static flower_exact sphere, ellipsoid;
    static errors great_circles, chords, geodesics;
    experiment e;
    int level, c;
    if (experiment_begin(&e, argc, argv, "tables")) return 1;
    flower_integrate(&curve, &sphere);
    curve.axis[0] = 1.6;
    curve.axis[1] = 1.3;
    flower_integrate(&curve, &ellipsoid);
    for (level = 0; level < LEVELS; ++level) {
        measure(&sphere, GREAT_CIRCLES, (size_t)4 << level, great_circles[level]);
        measure(&ellipsoid, CHORDS, (size_t)4 << level, chords[level]);
        measure(&ellipsoid, GEODESICS, (size_t)4 << level, geodesics[level]);
    }
    fprintf(e.table, "table\tq");
    for (c = 0; c < COLUMNS; ++c) fprintf(e.table, "\t%s\teoc_%s", reference[c], reference[c]);
    fputc('\n', e.table);

    compare_exact(&e, "sphere", &sphere);
    compare_exact(&e, "ellipsoid", &ellipsoid);
    puts("\nTable 1 as printed. It is the unit sphere; f and g turn one corner late; |g - g_q| is divided by 4;");
    puts("eoc compares with q/2.");
    compare_printed(&e, "table1_printed.tsv", great_circles, table1, name1, 4);
    puts("Table 2 as printed: chords on the ellipsoid, computed in the same way.");
    compare_printed(&e, "table2_printed.tsv", chords, table2, name2, 3);

    puts(
        "Could Table 2 be section 4.2 to the letter, whose lengths |x_i - x_(i-1)| go with its phases? |g - g_q| / 4:");
    for (level = 0; level < LEVELS; level += 2)
        printf("%5d  to the letter %.1e  one corner late %.1e\n", 4 << level, chords[level][G_BEFORE],
               chords[level][G_LAG]);
    puts("No: q = 4 and 16 are printed as 2.0e-02 and 3.3e-02.\n");

    puts("Table 1 put right: great circles on the unit sphere; \"g, middle\" is read at the middle of edge 0.");
    print_errors(&e, "sphere_great_circles", great_circles);
    compare_errors(&e, "table1_reference.tsv", great_circles, 0);
    puts("\nWhat the caption of Table 1 describes: geodesics on the ellipsoid.");
    print_errors(&e, "ellipsoid_geodesics", geodesics);
    /* Its geodesics are in double precision: 1e-12 for each of 1024 angles. Ours follow q^-2 to 1e-11. */
    compare_errors(&e, "ellipsoid_geodesic_reference.tsv", geodesics, 1.5e-9);
    puts("\nTable 2 put right: chords on the ellipsoid.");
    print_errors(&e, "ellipsoid_chords", chords);
    compare_errors(&e, "table2_reference.tsv", chords, 0);
    putchar('\n');
    draw(&e, great_circles, chords);
    return experiment_end(&e);
}
