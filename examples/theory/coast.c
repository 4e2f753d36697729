/* coast.c - how long is a coast, and how elongated is a country? It depends on the ruler.

     cc coast.c -o coast -lm && ./coast DIRECTORY                  (from the root: make pictures)

   Countries of examples/data/countries.tsv, simplified more and more: corners that lie within a tolerance of a straight
   line are dropped (Douglas and Peucker). Length and mu_p over that tolerance. */

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "theory.h"

#define RANKS     6
#define MOST      600    /* corners */
#define EARTH     6371.0 /* km */
#define COUNTRIES 4
#define STEPS     13 /* tolerances 0, 10, 15, ... km */

typedef struct country {
    const char *name;
    size_t n;
    double corner[3 * MOST];
} country;

static void read_country(country *c, const char *name)
{
    FILE *table = fopen("examples/data/countries.tsv", "r");
    char line[256], id[128];
    double lon, lat;
    c->name = name;
    c->n = 0;
    if (!table) {
        perror("examples/data/countries.tsv");
        exit(1);
    }
    while (fgets(line, sizeof line, table))
        if (sscanf(line, "%127[^\t]\t%lf\t%lf", id, &lon, &lat) == 3 && strcmp(id, name) == 0 && c->n < MOST)
            theory_need(surfmink_from_lonlat(lon, lat, EARTH, c->corner + 3 * c->n++));
    fclose(table);
}

/* How far a point is from the chord between two others. */
static double distance(const double *x, const double *a, const double *b)
{
    double along[3], to[3], length2, t, sum = 0;
    int k;
    for (k = 0; k < 3; ++k) {
        along[k] = b[k] - a[k];
        to[k] = x[k] - a[k];
    }
    length2 = dot(along, along);
    t = length2 > 0 ? fmin(fmax(dot(to, along) / length2, 0), 1) : 0;
    for (k = 0; k < 3; ++k) sum += (to[k] - t * along[k]) * (to[k] - t * along[k]);
    return sqrt(sum);
}

/* Marks what to keep of the corners between two that are kept; indices are modulo n. */
static void keep_between(const country *c, size_t from, size_t to, double tolerance,
                         char *keep) /* NOLINT(misc-no-recursion) */
{
    double far = tolerance, d;
    size_t i, worst = to;
    for (i = from + 1; i < to; ++i) {
        d = distance(c->corner + 3 * (i % c->n), c->corner + 3 * (from % c->n), c->corner + 3 * (to % c->n));
        if (d > far) {
            far = d;
            worst = i;
        }
    }
    if (worst == to) return;
    keep[worst % c->n] = 1;
    keep_between(c, from, worst, tolerance, keep);
    keep_between(c, worst, to, tolerance, keep);
}

/* Starts from corner 0 and the one that is farthest from it. */
static void simplify(const country *c, double tolerance, country *s)
{
    char keep[MOST] = {0};
    size_t i, far = 0;
    for (i = 1; i < c->n; ++i)
        if (distance(c->corner + 3 * i, c->corner, c->corner) > distance(c->corner + 3 * far, c->corner, c->corner))
            far = i;
    keep[0] = keep[far] = 1;
    keep_between(c, 0, far, tolerance, keep);
    keep_between(c, far, c->n, tolerance, keep);
    s->name = c->name;
    s->n = 0;
    for (i = 0; i < c->n; ++i)
        if (keep[i] || tolerance <= 0) memcpy(s->corner + 3 * s->n++, c->corner + 3 * i, 3 * sizeof(double));
}

/* The country as seen from above its middle, and its mu. */
static void draw_country(plot *p, const country *whole, double tolerance, double left, double top)
{
    static country s;
    plot_pen pen = {"#000000", 1.2, ""};
    double middle[3] = {0, 0, 0}, mu[RANKS + 1], xy[2 * MOST];
    surfmink_outline outline;
    plot_view view;
    char name[64];
    size_t i;
    for (i = 0; i < 3 * whole->n; ++i) middle[i % 3] += whole->corner[i];
    view = plot_look(atan2(middle[1], middle[0]) * 180 / PLOT_PI,
                     atan2(middle[2], hypot(middle[0], middle[1])) * 180 / PLOT_PI, left + 80, top + 72, 0.034);
    simplify(whole, tolerance, &s);
    outline = surfmink_sphere(s.corner, s.n, EARTH);
    theory_need(surfmink_measure(&outline, RANKS, mu, NULL, NULL, NULL));
    for (i = 0; i < s.n; ++i) plot_project(&view, s.corner + 3 * i, xy + 2 * i);
    plot_path(p, xy, s.n, 1, pen, "#dddddd");
    if (tolerance > 0)
        snprintf(name, sizeof name, "to %g km: %lu corners", tolerance, (unsigned long)s.n);
    else
        snprintf(name, sizeof name, "as in the data: %lu corners", (unsigned long)s.n);
    plot_text(p, left + 80, top + 12, 11, AT_MIDDLE, name);
    theory_bars(p, mu, RANKS, left + 30, top + 146, 100, 40, !(tolerance > 0));
}

int main(int argc, char **argv)
{
    static const char *const names[COUNTRIES] = {"Canada", "Mexico", "Chile", "Ukraine"};
    static const double tolerance[STEPS] = {10, 15, 20, 30, 50, 70, 100, 150, 200, 300, 500, 700, 1000};
    static country whole, s;
    plot_axes lengths = {60, 242, 260, 190, {8, 1200}, {0.4, 1.05}, {1, 0}};
    plot_axes shapes = {410, 242, 260, 190, {8, 1200}, {0, 1}, {1, 0}};
    double at[STEPS], length[STEPS], mu2[STEPS], mu[RANKS + 1], first;
    surfmink_outline outline;
    surfmink_functionals w;
    plot p;
    int k, step, used, rank, status;
    if (theory_begin(&p, argc, argv, "coast", 780, 490)) return 1;
    plot_letter(&p, 6, 16, "(a)");
    read_country(&whole, "Mexico");
    for (k = 0; k < 4; ++k) draw_country(&p, &whole, k == 0 ? 0 : k == 1 ? 50 : k == 2 ? 200 : 500, 26 + 186.0 * k, 4);
    plot_letter(&p, 6, 236, "(b)");
    plot_frame(&p, &lengths, 0, 0.1, "tolerance, km", "length / length in the data");
    plot_letter(&p, 356, 236, "(c)");
    plot_frame(&p, &shapes, 0, 0.2, "tolerance, km", "$\\mu_2$");
    puts("country   tolerance  corners   length     mu_2   mu_3   mu_4   mu_6\n               km              km");
    for (k = 0; k < COUNTRIES; ++k) {
        read_country(&whole, names[k]);
        outline = surfmink_sphere(whole.corner, whole.n, EARTH);
        theory_need(surfmink_measure(&outline, RANKS, mu, NULL, &w, NULL));
        first = w.length;
        for (used = 0, step = -1; step < STEPS; ++step) {
            simplify(&whole, step < 0 ? 0 : tolerance[step], &s);
            outline = surfmink_sphere(s.corner, s.n, EARTH);
            status = surfmink_measure(&outline, RANKS, mu, NULL, &w, NULL);
            printf("%-8s %10g %8lu", names[k], step < 0 ? 0 : tolerance[step], (unsigned long)s.n);
            if (status != SURFMINK_OK) {
                printf("   %s\n", surfmink_strerror(status));
                continue;
            }
            printf(" %8.0f  ", w.length);
            for (rank = 2; rank <= 6; ++rank)
                if (rank != 5) printf("  %5.3f", mu[rank]);
            putchar('\n');
            if (step < 0) continue;
            at[used] = tolerance[step];
            length[used] = w.length / first;
            mu2[used++] = mu[2];
        }
        plot_curve(&p, &lengths, at, length, (size_t)used, plot_pens[k], plot_markers[k]);
        plot_curve(&p, &shapes, at, mu2, (size_t)used, plot_pens[k], plot_markers[k]);
        plot_key(&p, 690, 260 + 18.0 * k, plot_pens[k], plot_markers[k], names[k]);
    }
    return plot_end(&p);
}
