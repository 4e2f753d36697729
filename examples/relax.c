/* relax.c - what does a tissue look like whose cells pull themselves into hexagons?

   In a vertex model cells share their corners, and every cell has an energy: it dislikes to be too large or too small,
   its perimeter is elastic, and here it also likes to be p-fold symmetric. On a curved body, with surface Minkowski
   tensors, that reads

     E = sum over cells   1/2 (A/A0 - 1)^2  +  k/2 (L/sqrt(A0) - s)^2  -  a mu_p  +  sum over edges  (d/l)^2

   with A0 the area of the body over the number of cells. The last term, with d = sqrt(A0)/20, only counts for short
   edges: cells do not change neighbours here, and at an edge that vanishes E would have a kink. The corners follow the
   force -dE/dx, along the surface, until nothing is to be gained. Nobody writes down how mu_p changes with the corners:
   surfmink_batch_gradient of beyond/gradient.h does.

     1 read     a table of cells on an ellipsoid, such as tissue.c makes; corners that agree to the last digit are one
     2 energy   measure all cells in one batch
     3 force    weights dE/dmu_p and dE/dL of each cell -> gradient by its corners and normals -> by shared corners
     4 relax    steps down the gradient, none of which may raise E
     5 write    the same table; read again, it has the same energy

   compile   cc examples/relax.c -o relax -lm
   run       ./tissue --cells 60 --relax 1 --axes 90,60,50 > wild.tsv
             ./relax --axes 90,60,50 --log energy.tsv < wild.tsv > calm.tsv
             ./surfmink --color-by 6 --unit um --svg calm.svg calm.tsv */

#define SURFMINK_IMPLEMENTATION
#include "../surfmink.h"

#include "beyond/gradient.h"
#include "command/harmless.h"
#include "surfaces/ellipsoid.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_CELLS   2000
#define MOST_CORNERS (6 * MOST_CELLS + 64) /* of all cells together: six each, on a closed surface */
#define MOST_RANK    24
#define LONGEST_NAME 64

/* --- what there is ------------------------------------------------------------------------------------------------ */

static double axis[3] = {110, 50, 40};                           /* semi-axes of the body */
static double perimeter_stiffness = 0.1, shape = 3.722, a = 0.2; /* k, s (that of a regular hexagon), a */
static int rank = 6;

static char cell_name[MOST_CELLS][LONGEST_NAME + 1];
static size_t cells, offset[MOST_CELLS + 1]; /* cell c has the places offset[c] .. offset[c + 1] - 1 */
static size_t vertex[MOST_CORNERS];          /* which shared corner stands at a place */
static size_t vertices;
static double position[3 * MOST_CORNERS], cell_area; /* of the shared corners; A0 */

static double dot3(const double *u, const double *v)
{
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

static double distance2(const double *u, const double *v)
{
    return (u[0] - v[0]) * (u[0] - v[0]) + (u[1] - v[1]) * (u[1] - v[1]) + (u[2] - v[2]) * (u[2] - v[2]);
}

static void cross3(const double *u, const double *v, double *w)
{
    w[0] = u[1] * v[2] - u[2] * v[1];
    w[1] = u[2] * v[0] - u[0] * v[2];
    w[2] = u[0] * v[1] - u[1] * v[0];
}

static void refuse(const char *what, const char *problem)
{
    fputs("relax: ", stderr);
    put_harmless(stderr, what);
    fprintf(stderr, ": %s (see relax --help)\n", problem);
    exit(EXIT_FAILURE);
}

static void refuse_line(unsigned long line, const char *problem)
{
    fprintf(stderr, "relax: line %lu: %s\n", line, problem);
    exit(EXIT_FAILURE);
}

/* The area of the body, by the midpoint rule in both angles: for a smooth periodic integrand that has all digits. */
static double area_of_body(void)
{
    enum { AROUND = 400 };
    double sum = 0, pi = acos(-1.0), step = pi / AROUND;
    int i, j;
    for (i = 0; i < 2 * AROUND; ++i) /* u goes once round: both halves are the body, once each */
        for (j = 0; j < AROUND; ++j) {
            double u = step * (i + 0.5), v = 2 * step * (j + 0.5), n[3];
            n[0] = axis[1] * axis[2] * sin(u) * cos(v);
            n[1] = axis[0] * axis[2] * sin(u) * sin(v);
            n[2] = axis[0] * axis[1] * cos(u);
            sum += fabs(sin(u)) * sqrt(dot3(n, n)) * step * 2 * step / 2;
        }
    return sum;
}

/* --- 1. read ------------------------------------------------------------------------------------------------------ */

/* The shared corner at a point, a new one if it is the first there. */
static size_t vertex_at(const double x[3])
{
    size_t v;
    for (v = 0; v < vertices; ++v)
        if (!(distance2(position + 3 * v, x) > 0)) return v;
    memcpy(position + 3 * v, x, 3 * sizeof *x);
    return vertices++;
}

static void read_corner(char *text, unsigned long line)
{
    char *end = strchr(text, '\t');
    double x[3], level = 0;
    int k;
    if (!end || end == text || end - text > LONGEST_NAME) refuse_line(line, "does not begin with the name of a cell");
    *end = '\0';
    if (cells == 0 || strcmp(cell_name[cells - 1], text) != 0) {
        if (cells == MOST_CELLS) refuse_line(line, "too many cells");
        strcpy(cell_name[cells], text);
        offset[cells + 1] = offset[cells];
        ++cells;
    }
    for (k = 0; k < 3; ++k) {
        text = end + 1;
        x[k] = strtod(text, &end);
        if (end == text || (*end != '\t' && *end != '\n' && *end != '\0') || (k < 2 && *end != '\t'))
            refuse_line(line, "x, y or z is not a number");
        level += x[k] / axis[k] * (x[k] / axis[k]);
    }
    if (!(fabs(level - 1) < 1e-6)) refuse_line(line, "the corner is not on the ellipsoid (--axes says which)");
    if (offset[cells] == MOST_CORNERS) refuse_line(line, "too many corners");
    vertex[offset[cells]++] = vertex_at(x);
}

static void read_cells(FILE *file)
{
    char text[1000];
    unsigned long line = 0;
    int named = 0;
    while (fgets(text, sizeof text, file)) {
        ++line;
        if (text[0] == '#' || text[0] == '\n') continue;
        if (!strchr(text, '\n') && !feof(file)) refuse_line(line, "too long");
        if (named)
            read_corner(text, line);
        else if (strncmp(text, "cell\tx\ty\tz", 10) != 0)
            refuse_line(line, "the columns are not cell, x, y, z");
        named = 1;
    }
    if (ferror(file)) refuse("standard input", strerror(errno));
    if (cells == 0) refuse("standard input", "holds no cells");
}

/* --- 2. energy ---------------------------------------------------------------------------------------------------- */

/* Corners and normals of all cells, one cell after the other, and what is measured of them. */
static double corner[3 * MOST_CORNERS], normal[3 * MOST_CORNERS];
static double mu[MOST_CELLS * (MOST_RANK + 1)], length[MOST_CELLS], area[MOST_CELLS];
static int status[MOST_CELLS];

/* Normals are the gradient of the function whose level the body is: they need not be unit. */
static void place(const double *x)
{
    size_t i;
    double hessian[6];
    for (i = 0; i < offset[cells]; ++i) {
        memcpy(corner + 3 * i, x + 3 * vertex[i], 3 * sizeof *x);
        surfmink_ellipsoid_f(axis, corner + 3 * i, normal + 3 * i, hessian);
    }
}

/* The length of the vector area, half the sum of x_i x x_(i+1): what one sees of the cell from above. It shrinks as a
   cell folds over. With a gradient: adds `weight` times that of the area. */
static double area_of(size_t c, double weight, double *by_corner)
{
    size_t first = offset[c], n = offset[c + 1] - first, i, k;
    double w[3], sum[3] = {0, 0, 0}, u[3], v[3], size;
    for (i = 0; i < n; ++i) {
        for (k = 0; k < 3; ++k) {
            u[k] = corner[3 * (first + i) + k] - corner[3 * first + k];
            v[k] = corner[3 * (first + (i + 1) % n) + k] - corner[3 * first + k];
        }
        cross3(u, v, w);
        for (k = 0; k < 3; ++k) sum[k] += w[k] / 2;
    }
    size = sqrt(dot3(sum, sum));
    for (i = 0; i < n && by_corner && size > 0; ++i) {
        for (k = 0; k < 3; ++k)
            u[k] = corner[3 * (first + (i + 1) % n) + k] - corner[3 * (first + (i + n - 1) % n) + k];
        cross3(u, sum, w);
        for (k = 0; k < 3; ++k) by_corner[3 * (first + i) + k] += weight / 2 * w[k] / size;
    }
    return size;
}

/* What keeps edges from vanishing. With a gradient: adds that. */
static double short_edges(size_t c, double *by_corner)
{
    size_t first = offset[c], n = offset[c + 1] - first, i, k;
    double sum = 0;
    for (i = 0; i < n; ++i) {
        size_t here = 3 * (first + i), next = 3 * (first + (i + 1) % n);
        double e[3], square, term;
        for (k = 0; k < 3; ++k) e[k] = corner[next + k] - corner[here + k];
        square = dot3(e, e);
        term = cell_area / 400 / square;
        sum += term;
        for (k = 0; by_corner && k < 3; ++k) {
            by_corner[here + k] += 2 * term / square * e[k];
            by_corner[next + k] -= 2 * term / square * e[k];
        }
    }
    return sum;
}

/* HUGE_VAL where a cell cannot be measured: no step may lead there. */
static double energy(const double *x)
{
    surfmink_outline all = surfmink_embedded(corner, normal, offset[cells]);
    surfmink_results out;
    double sum = 0;
    size_t c;
    memset(&out, 0, sizeof out);
    out.status = status;
    out.length = length;
    out.mu = mu;
    place(x);
    if (surfmink_batch(&all, offset, cells, rank, &out, NULL) > 0) return HUGE_VAL;
    for (c = 0; c < cells; ++c) {
        double size, around = length[c] / sqrt(cell_area) - shape;
        area[c] = area_of(c, 0, NULL);
        size = area[c] / cell_area - 1;
        sum += size * size / 2 + perimeter_stiffness * around * around / 2;
        sum += short_edges(c, NULL) - a * mu[c * ((size_t)rank + 1) + (size_t)rank];
    }
    return sum;
}

/* --- 3. force ----------------------------------------------------------------------------------------------------- */

/* The gradient of E by the shared corners, along the surface. The energy there has just been taken. */
static void gradient(const double *x, double *by_vertex)
{
    static double by_mu[MOST_CELLS * (MOST_RANK + 1)], by_length[MOST_CELLS];
    static double scratch[4 * MOST_CORNERS + (2 * MOST_RANK + 2) * MOST_CELLS];
    static double by_corner[3 * MOST_CORNERS], by_normal[3 * MOST_CORNERS];
    surfmink_weights weights = {NULL, NULL, NULL, NULL, 0};
    surfmink_outline all = surfmink_embedded(corner, normal, offset[cells]);
    surfmink_gradients to;
    double hessian[6], up[3], part;
    size_t c, i, k, v;
    memset(&to, 0, sizeof to);
    to.by_corner = by_corner;
    to.by_normal = by_normal;
    weights.mu = by_mu;
    weights.length = by_length;
    for (c = 0; c < cells; ++c) { /* the perimeter is not linear in E: its weight is what it is now */
        by_mu[c * ((size_t)rank + 1) + (size_t)rank] = -a;
        by_length[c] = perimeter_stiffness * (length[c] / sqrt(cell_area) - shape) / sqrt(cell_area);
    }
    place(x);
    surfmink_batch_gradient(&all, offset, cells, rank, &weights, &to, scratch);
    for (c = 0; c < cells; ++c) {
        area_of(c, (area[c] / cell_area - 1) / cell_area, by_corner);
        short_edges(c, by_corner);
    }
    memset(by_vertex, 0, 3 * vertices * sizeof *by_vertex);
    for (i = 0; i < offset[cells]; ++i) /* normals move with corners, by the Hessian, which is diagonal here */
        for (surfmink_ellipsoid_f(axis, corner + 3 * i, up, hessian), k = 0; k < 3; ++k)
            by_vertex[3 * vertex[i] + k] +=
                by_corner[3 * i + k] + hessian[k == 0 ? 0 : 2 * k + 1] * by_normal[3 * i + k];
    for (v = 0; v < vertices; ++v) {
        surfmink_ellipsoid_f(axis, x + 3 * v, up, hessian);
        part = dot3(by_vertex + 3 * v, up) / dot3(up, up);
        for (k = 0; k < 3; ++k) by_vertex[3 * v + k] -= part * up[k];
    }
}

/* --- 4. relax ----------------------------------------------------------------------------------------------------- */

/* A step against the gradient, and back to the surface along the ray from the middle. */
static void step_down(const double *x, const double *by_vertex, double step, double *to)
{
    size_t v, k;
    for (v = 0; v < vertices; ++v) {
        double level = 0;
        for (k = 0; k < 3; ++k) {
            to[3 * v + k] = x[3 * v + k] - step * by_vertex[3 * v + k];
            level += to[3 * v + k] / axis[k] * (to[3 * v + k] / axis[k]);
        }
        for (k = 0; k < 3; ++k) to[3 * v + k] /= sqrt(level);
    }
}

static double mean_mu(void)
{
    double sum = 0;
    size_t c;
    for (c = 0; c < cells; ++c) sum += mu[c * ((size_t)rank + 1) + (size_t)rank];
    return sum / (double)cells;
}

/* Steps have the length of Barzilai and Borwein, halved until E has fallen by a ten-thousandth of what the gradient
   promises. Ends early when even the shortest does not: where a cell is about to fold over. */
static double relax(unsigned long steps, FILE *log)
{
    static double g[3 * MOST_CORNERS], next_g[3 * MOST_CORNERS], next[3 * MOST_CORNERS];
    double now = energy(position), then, square, step, dx, change, moved;
    unsigned long k;
    size_t i, numbers = 3 * vertices;
    if (log) fprintf(log, "step\tenergy\tgradient\tmean_mu\n%d\t%.17g\t", 0, now);
    gradient(position, g);
    for (square = 0, i = 0; i < numbers; ++i) square += g[i] * g[i];
    if (log) fprintf(log, "%.6g\t%.6f\n", sqrt(square), mean_mu());
    step = square > 0 ? 0.05 * sqrt(cell_area / square) : 0;
    for (k = 1; k <= steps && square > 0; ++k) {
        int halved = 0;
        step_down(position, g, step, next);
        while (!((then = energy(next)) <= now - 1e-4 * step * square) && halved++ < 60)
            step_down(position, g, step /= 2, next);
        if (!(then < now)) break;
        gradient(next, next_g);
        for (change = moved = 0, i = 0; i < numbers; ++i) {
            dx = next[i] - position[i];
            moved += dx * dx;
            change += dx * (next_g[i] - g[i]);
        }
        step = change > 0 ? moved / change : 2 * step;
        for (square = 0, i = 0; i < numbers; ++i) square += next_g[i] * next_g[i];
        if (step * sqrt(square) > sqrt(cell_area)) step = sqrt(cell_area / square);
        memcpy(position, next, numbers * sizeof *next);
        memcpy(g, next_g, numbers * sizeof *g);
        now = then;
        if (log) fprintf(log, "%lu\t%.17g\t%.6g\t%.6f\n", k, now, sqrt(square), mean_mu());
    }
    return energy(position);
}

/* --- 5. write ----------------------------------------------------------------------------------------------------- */

static void write_cells(double final)
{
    size_t c, i, k;
    printf("# relaxed tissue, rank %d: energy %.17g, mean mu %.6f\n", rank, final, mean_mu());
    printf("cell\tx\ty\tz\tnx\tny\tnz\n");
    for (c = 0; c < cells; ++c)
        for (i = offset[c]; i < offset[c + 1]; ++i) {
            double size = sqrt(dot3(normal + 3 * i, normal + 3 * i));
            put_harmless(stdout, cell_name[c]);
            for (k = 0; k < 3; ++k) printf("\t%.17g", corner[3 * i + k]);
            for (k = 0; k < 3; ++k) printf("\t%.17g", normal[3 * i + k] / size);
            putchar('\n');
        }
}

/* --- options ------------------------------------------------------------------------------------------------------ */

static const char help[] = "relax < wild.tsv > calm.tsv\n"
                           "    lets the cells of a table, as tissue makes it, become p-fold symmetric\n"
                           "\n"
                           "  --rank P         p of the mu_p that is rewarded, 1 to 24 (6)\n"
                           "  --reward A       how much, 0 to 100, beside 1 for the area (0.2)\n"
                           "  --perimeter K    stiffness of the perimeter, 0 to 100 (0.1)\n"
                           "  --shape S        preferred perimeter over root of area, 0 to 100 (3.722)\n"
                           "  --axes A,B,C     semi-axes of the ellipsoid (110,50,40)\n"
                           "  --steps N        at most, 0 to 1000000 (300)\n"
                           "  --log FILE       a row for each step: energy, norm of the gradient, mean mu_p\n"
                           "  --help           this text\n";

enum { RANK, REWARD, PERIMETER, SHAPE, AXES, STEPS, LOG, OPTIONS };
static const char *const option_name[OPTIONS] = {"--rank", "--reward", "--perimeter", "--shape",
                                                 "--axes", "--steps",  "--log"};

static double read_number(const char *option, const char *text, double least, double most)
{
    char problem[80], *end;
    double value = strtod(text, &end);
    if (end != text && *end == '\0' && value >= least && value <= most) return value;
    snprintf(problem, sizeof problem, "must be a number from %g to %g", least, most);
    refuse(option, problem);
    return 0;
}

static int read_whole(const char *option, const char *text, int least, int most)
{
    double value = read_number(option, text, least, most);
    if (floor(value) < value) refuse(option, "must be a whole number");
    return (int)value;
}

static void read_axes(const char *option, const char *text)
{
    int k;
    for (k = 0; k < 3; ++k) {
        char *end;
        axis[k] = strtod(text, &end);
        if (end == text || *end != (k < 2 ? ',' : '\0') || !(axis[k] >= 1e-6 && axis[k] <= 1e6))
            refuse(option, "must be three numbers from 1e-6 to 1e6 with commas between, as 110,50,40");
        text = end + 1;
    }
}

/* The exit status, when all is written: some disks say only when a file is closed that they are full. */
static int finish(void)
{
    if (fflush(stdout) || ferror(stdout) || fclose(stdout)) refuse("standard output", strerror(errno));
    return EXIT_SUCCESS;
}

int main(int argc, char **argv)
{
    FILE *log = NULL;
    const char *log_name = NULL;
    int steps = 300, i, known;
    double final;
    for (i = 1; i < argc; i += 2) {
        const char *option = argv[i], *value = argv[i + 1]; /* NULL after the last */
        if (strcmp(option, "--help") == 0) {
            fputs(help, stdout);
            return finish();
        }
        for (known = 0; known < OPTIONS && strcmp(option, option_name[known]) != 0;) ++known;
        if (known == OPTIONS) refuse(option, "no such option");
        if (!value) refuse(option, "a value is missing");
        switch (known) {
        case RANK: rank = read_whole(option, value, 1, MOST_RANK); break;
        case REWARD: a = read_number(option, value, 0, 100); break;
        case PERIMETER: perimeter_stiffness = read_number(option, value, 0, 100); break;
        case SHAPE: shape = read_number(option, value, 0, 100); break;
        case AXES: read_axes(option, value); break;
        case STEPS: steps = read_whole(option, value, 0, 1000000); break;
        default: log_name = value; break;
        }
    }
    read_cells(stdin);
    cell_area = area_of_body() / (double)cells;
    if (!(energy(position) < HUGE_VAL))
        for (i = 0; (size_t)i < cells; ++i)
            if (status[i] != SURFMINK_OK) {
                fputs("relax: cell ", stderr);
                put_harmless(stderr, cell_name[i]);
                fprintf(stderr, ": %s\n", surfmink_strerror(status[i]));
                return EXIT_FAILURE;
            }
    if (log_name && !(log = fopen(log_name, "w"))) refuse(log_name, strerror(errno));
    final = relax((unsigned long)steps, log);
    if (log && (ferror(log) | fclose(log))) refuse(log_name, "cannot be written");
    write_cells(final);
    return finish();
}
