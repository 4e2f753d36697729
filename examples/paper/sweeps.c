/* sweeps.c - which mu_p notices what, when a flower on an ellipsoid changes?

     cc sweeps.c -o sweeps -lm && ./sweeps DIRECTORY DATA          (from the root: make paper)

   The four sweeps of paper 5.3 (figure "sketch-Ellipsoid") on the ellipsoid E(1.6, 1.3, 1.0): amplitude a, mean radius
   r0, number of petals omega, position y0; p = 2 ... 10. The reference holds the values of the smooth curves. What a
   user has is a polygon: with q corners it comes close to them with order 2, and two polygons make a third value for
   free that comes much closer: (4 mu_q - mu_(q/2)) / 3, Richardson's extrapolation. Order 2 begins where the corners
   lie closer than the radius of the tightest bend, which between long petals is a hundredth of its size. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "experiment.h"
#include "flower.h"
#include "../picture/plot.h"

#define RANKS        12
#define LEVELS       6 /* q = 256 ... 8192 */
#define MOST_CORNERS 8192

/* mu of straight chords between q points at equal distances along the curve. */
static void measure(const flower_exact *exact, size_t q, double *mu)
{
    static double corner[3 * MOST_CORNERS], normal[3 * MOST_CORNERS];
    surfmink_outline outline = surfmink_embedded(corner, normal, q);
    int status;
    flower_polygon(exact, q, corner, normal);
    status = surfmink_measure(&outline, RANKS, mu, NULL, NULL, NULL);
    experiment_need(status == SURFMINK_OK, surfmink_strerror(status));
}

static double largest_difference(const double *mu, const double *other)
{
    double largest = 0;
    int p;
    for (p = 1; p <= RANKS; ++p) largest = fmax(largest, fabs(mu[p] - other[p]));
    return largest;
}

/* --- figure ------------------------------------------------------------------------------------------------------- */

#define CELL 112.0 /* width of one picture with its bars */

static plot_view look(double x, double y)
{
    return plot_look(45, 22, x, y, 34);
}

static void draw_cell(plot *p, const flower *curve, const double *mu, double left, double top, int first,
                      const char *title)
{
    plot_axes axes = {left + 22, top + 98, CELL - 28, 52, {0, 1}, {0, 0.45}, {0, 0}};
    plot_view view = look(left + CELL / 2 + 6, top + 52);
    plot_pen line = {"#d55e00", 1.6, ""}, hidden = {"#d55e00", 0.8, "2 2"};
    double x[3 * 180], normal[3], d[3], dd[3];
    int i;
    plot_repeat(p, "body", view.x, view.y);
    for (i = 0; i < 180; ++i) flower_point(curve, 2 * PI * i / 180, x + 3 * i, normal, d, dd);
    plot_curve_on(p, &view, plot_in_ellipsoid, curve->axis, 3.6, x, 180, 1, line, hidden);
    plot_text(p, view.x, top + 8, 10, AT_MIDDLE, title);
    plot_ticks(p, &axes, 1, 0.2, "");
    plot_bars(p, &axes, mu, 2, 10, 8);
    plot_text(p, axes.left + axes.width + 7, top + 159, 9, AT_MIDDLE, "$p$");
    if (first) plot_text_as(p, left - 9, top + 124, 11, AT_MIDDLE, "#000000", 0, 1, "$\\mu_p$");
}

int main(int argc, char **argv)
{
    static const char *const sweeps[4] = {"a", "r0", "omega", "y0"};
    static const char *const title[4] = {"(a)  amplitude $a$;  $r_0$ = 0.4, $\\omega$ = 5, $y_0$ = \\pi/4",
                                         "(b)  mean radius $r_0$;  $a$ = 0.1, $\\omega$ = 5, $y_0$ = \\pi/4",
                                         "(c)  petals $\\omega$;  $r_0$ = 0.4, $a$ = 0.1, $y_0$ = \\pi/4",
                                         "(d)  position $y_0$;  $r_0$ = 0.4, $a$ = 0.1, $\\omega$ = 5"};
    static const double left[4] = {20, 20, 20, 20 + 4.5 * CELL}, top[4] = {0, 192, 384, 384};
    static printed t;
    static flower_exact exact;
    flower curve = {{1.6, 1.3, 1.0}, 0, 0, 0, PI / 2, 0};
    double g[2 * RANKS + 2], smooth[RANKS + 1], want[RANKS + 1], mu[LEVELS][RANKS + 1], better[RANKS + 1];
    double worst = 0, worst_better = 0, slope, least = 9, most = 0;
    char what[96];
    plot_view view = look(0, 0);
    experiment e;
    plot p;
    int row, k, level, sweep, column = 0, last = -1;
    if (experiment_begin(&e, argc, argv, "sweeps") || plot_begin(&p, e.figure, 8 * CELL + 44, 580)) return 1;
    plot_keep(&p, "body");
    plot_ellipsoid(&p, &view, curve.axis);
    plot_graticule(&p, &view, curve.axis, 30);
    plot_kept(&p);
    printed_read(&t, &e, "ellipsoid_sweeps.tsv");
    fprintf(e.table, "sweep\tr0\ta\tomega\ty0_over_pi");
    for (k = 1; k <= RANKS; ++k) fprintf(e.table, "\tmu_%d", k);
    fprintf(e.table, "\terror_q8192\torder\terror_richardson\n");
    puts("Flowers on E(1.6, 1.3, 1.0): largest error of mu_1 ... mu_12 against the smooth curve, of q chords");
    puts("sweep    r0      a  omega  y0/pi   q=256     q=512     q=1024    q=2048    q=4096    q=8192   order   "
         "Richardson");
    for (row = 0; row < t.rows; ++row) {
        const char *name = printed_text(&t, row, "sweep");
        for (sweep = 0; sweep < 4 && strcmp(sweeps[sweep], name) != 0; ++sweep) continue;
        experiment_need(sweep < 4, "an unknown sweep");
        curve.r0 = printed_number(&t, row, "r0");
        curve.a = printed_number(&t, row, "a");
        curve.omega = atoi(printed_text(&t, row, "omega"));
        curve.y0 = printed_number(&t, row, "y0_over_pi") * PI;
        flower_integrate(&curve, &exact);
        flower_components(&exact, 0, RANKS, g);
        want[0] = 1;
        for (k = 0; k <= RANKS; ++k) {
            smooth[k] = hypot(g[2 * k], g[2 * k + 1]) / g[0];
            if (k == 0) continue;
            want[k] = printed_rank(&t, row, "mu_", k);
            snprintf(what, sizeof what, "sweep %s, row %d, mu_%d of the smooth curve", name, row, k);
            experiment_near(&e, what, smooth[k], want[k], 1e-12);
        }
        experiment_near(&e, "L of the smooth curve", exact.length, printed_number(&t, row, "L"), 1e-12);
        experiment_near(&e, "kappa of the smooth curve", exact.kappa, printed_number(&t, row, "kappa"), 1e-12);
        for (level = 0; level < LEVELS; ++level) measure(&exact, (size_t)256 << level, mu[level]);
        for (k = 0; k <= RANKS; ++k) better[k] = (4 * mu[LEVELS - 1][k] - mu[LEVELS - 2][k]) / 3;
        slope = log2(largest_difference(mu[LEVELS - 2], want) / largest_difference(mu[LEVELS - 1], want));
        least = fmin(least, slope);
        most = fmax(most, slope);
        worst = fmax(worst, largest_difference(mu[LEVELS - 1], want));
        worst_better = fmax(worst_better, largest_difference(better, want));
        printf("%-5s %5g %6g  %5d  %5g", name, curve.r0, curve.a, curve.omega, curve.y0 / PI);
        for (level = 0; level < LEVELS; ++level) printf("   %.1e", largest_difference(mu[level], want));
        printf("   %5.2f   %.1e\n", slope, largest_difference(better, want));
        fprintf(e.table, "%s\t%g\t%g\t%d\t%g", name, curve.r0, curve.a, curve.omega, curve.y0 / PI);
        for (k = 1; k <= RANKS; ++k) fprintf(e.table, "\t%.12f", smooth[k]);
        fprintf(e.table, "\t%.2e\t%.2f\t%.2e\n", largest_difference(mu[LEVELS - 1], want), slope,
                largest_difference(better, want));

        if (sweep != last) {
            last = sweep;
            column = 0;
            plot_letter(&p, left[sweep] + 8, top[sweep] + 16, title[sweep]);
        }
        if (sweep == 0) snprintf(what, sizeof what, "$a$ = %g", curve.a);
        if (sweep == 1) snprintf(what, sizeof what, "$r_0$ = %g", curve.r0);
        if (sweep == 2) snprintf(what, sizeof what, "$\\omega$ = %d", curve.omega);
        if (sweep == 3) snprintf(what, sizeof what, "$y_0$ = %g\\pi", curve.y0 / PI);
        draw_cell(&p, &curve, mu[LEVELS - 1], left[sweep] + CELL * column, top[sweep] + 22, column == 0, what);
        ++column;
    }
    snprintf(what, sizeof what, "polygons of 8192 chords agree to 2e-6 (worst %.1e), order %.2f to %.2f", worst, least,
             most);
    experiment_claim(&e, what, worst < 2e-6 && least > 1.97 && most < 2.03);
    snprintf(what, sizeof what, "Richardson's extrapolation agrees to 1e-6 (worst %.1e)", worst_better);
    experiment_claim(&e, what, worst_better < 1e-6);
    return plot_end(&p) + experiment_end(&e) > 0;
}
