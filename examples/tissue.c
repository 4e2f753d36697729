/* tissue.c - a synthetic tissue: a few hundred cells that tile an elongated ellipsoid.

   What does an epithelium look like to surfmink? Like this table: corners and normals of cells
   that cover a curved body without gap or overlap. Each cell is the part of the ellipsoid that is
   nearer to its seed than to any other seed (a Voronoi diagram restricted to the surface), so each
   corner is the one point of the ellipsoid equally far from three seeds.

     1 scatter  seeds, uniformly by area
     2 corners  triples of seeds -> points of the ellipsoid that no fourth seed is nearer to
     3 relax    seed -> middle of its cell, a few times: cells even out as they do in a tissue
     4 print    one line per corner, counter-clockwise about the outer normal

   compile   cc tissue.c -o tissue -lm
   run       ./tissue > tissue.tsv

   The same options give the same table everywhere: the random numbers are made here, and all of
   the arithmetic is + - * / sqrt, which IEEE 754 rounds alike on every machine. Where a compiler
   fuses a*b+c into one rounding, the difference hides below the nine printed decimals.
   The output is CC0: do with it what you like. */

#include <errno.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_CELLS 10000
#define MAX_RING  64 /* corners of one cell; 13 was the most among 120000 unrelaxed cells */
#define MAX_REACH 160

typedef struct { /* a corner and the three cells around it, counter-clockwise */
    double x[3];
    int cell[3];
} corner_t;

static double axis[3] = {110, 50, 40}; /* semi-axes in micrometres */
static double seed[MAX_CELLS][3];
static int cells = 400;
static corner_t corner[2 * MAX_CELLS];
static int corners;

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void minus(const double *a, const double *b, double *out)
{
    out[0] = a[0] - b[0];
    out[1] = a[1] - b[1];
    out[2] = a[2] - b[2];
}

static double distance2(const double *a, const double *b)
{
    double d[3];
    minus(a, b, d);
    return dot(d, d);
}

/* The outer unit normal of the ellipsoid at its point x: the gradient of sum (x_c / axis_c)^2. */
static void normal_at(const double *x, double *normal)
{
    double length;
    int c;
    for (c = 0; c < 3; ++c) normal[c] = x[c] / axis[c] / axis[c];
    length = sqrt(dot(normal, normal));
    for (c = 0; c < 3; ++c) normal[c] /= length;
}

/* --- 1. scatter -------------------------------------------------------------------- */

/* The next random number in [0, 1), by splitmix64: a counter, scrambled. */
static double uniform(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    z ^= z >> 31;
    return (double)(z >> 11) / 9007199254740992.0; /* the top 53 bits over 2^53 */
}

/* Uniform points of the unit sphere, stretched to the ellipsoid. Stretching enlarges the area at u
   in proportion to |u / axis|; keeping points with that probability makes them uniform again. */
static void scatter(uint64_t state)
{
    double shortest = fmin(axis[0], fmin(axis[1], axis[2]));
    int i = 0, c;
    while (i < cells) {
        double u[3], v[3], r2;
        for (c = 0; c < 3; ++c) u[c] = 2 * uniform(&state) - 1;
        r2 = dot(u, u);
        if (r2 > 1 || r2 < 1e-4) continue; /* outside the ball, or too near its centre to have a direction */
        for (c = 0; c < 3; ++c) u[c] /= sqrt(r2);
        for (c = 0; c < 3; ++c) v[c] = u[c] / axis[c];
        if (uniform(&state) > shortest * sqrt(dot(v, v))) continue;
        for (c = 0; c < 3; ++c) seed[i][c] = axis[c] * u[c];
        ++i;
    }
}

/* --- 2. corners -------------------------------------------------------------------- */

/* The (at most reach) seeds nearest to seed i, nearest first; returns how many. */
static int nearest(int i, int reach, int *near)
{
    double d2[MAX_REACH] = {0};
    int j, k, count = 0;
    for (j = 0; j < cells; ++j) {
        double d = distance2(seed[i], seed[j]);
        if (j == i || (count == reach && d >= d2[reach - 1])) continue;
        if (count < reach) ++count;
        for (k = count - 1; k > 0 && d2[k - 1] > d; --k) {
            d2[k] = d2[k - 1];
            near[k] = near[k - 1];
        }
        d2[k] = d;
        near[k] = j;
    }
    return count;
}

/* The point of the ellipsoid equally far from seeds i, j, k. Such points of space form the line
   through the centre of the triangle's circumcircle, at right angles to it; of the line's two
   points on the ellipsoid we take the one on the triangle's side. Returns 0 if there is none. */
static int equidistant_point(int i, int j, int k, corner_t *out)
{
    double u[3], v[3], along[3], cu[3], cv[3], centre[3], normal[3];
    double uu, vv, aa, A = 0, B = 0, C = -1, root, t;
    int c;
    minus(seed[j], seed[i], u);
    minus(seed[k], seed[i], v);
    cross(u, v, along);
    uu = dot(u, u);
    vv = dot(v, v);
    aa = dot(along, along);
    if (!(aa > 1e-20 * uu * vv)) return 0; /* three seeds in a row have no circumcircle */
    cross(v, along, cu);
    cross(along, u, cv);
    for (c = 0; c < 3; ++c) {
        centre[c] = seed[i][c] + (uu * cu[c] + vv * cv[c]) / (2 * aa);
        along[c] /= sqrt(aa);
        A += (along[c] / axis[c]) * (along[c] / axis[c]); /* A t^2 + 2 B t + C = 0 on the ellipsoid */
        B += (along[c] / axis[c]) * (centre[c] / axis[c]);
        C += (centre[c] / axis[c]) * (centre[c] / axis[c]);
    }
    root = B * B - A * C;
    if (!(root >= 0)) return 0;
    t = -C / (B + (B < 0 ? -sqrt(root) : sqrt(root))); /* the root of smaller size, without cancellation */
    for (c = 0; c < 3; ++c) out->x[c] = centre[c] + t * along[c];
    normal_at(out->x, normal);
    out->cell[0] = i;
    out->cell[1] = dot(along, normal) > 0 ? j : k; /* counter-clockwise seen from outside */
    out->cell[2] = dot(along, normal) > 0 ? k : j;
    return 1;
}

static int is_nearer(int m, const corner_t *at)
{
    const int *own = at->cell;
    return m != own[0] && m != own[1] && m != own[2] && distance2(seed[m], at->x) < distance2(seed[own[0]], at->x);
}

/* Every triple i < j < k is tried once, so the cells around a corner share its very bits. */
static int find_corners(int reach)
{
    int near[MAX_REACH], i, a, b, m;
    corners = 0;
    for (i = 0; i < cells; ++i) {
        int count = nearest(i, reach, near);
        for (a = 0; a < count; ++a) {
            for (b = 0; b < count; ++b) {
                corner_t found;
                if (!(i < near[a] && near[a] < near[b])) continue;
                if (!equidistant_point(i, near[a], near[b], &found)) continue;
                for (m = 0; m < count && !is_nearer(near[m], &found); ++m) {
                } /* most triples fail at once */
                if (m < count) continue;
                for (m = 0; m < cells && !is_nearer(m, &found); ++m) {
                }
                if (m < cells) continue;
                if (corners == 2 * cells - 4) return 0;
                corner[corners++] = found;
            }
        }
    }
    return corners == 2 * cells - 4; /* Euler: V - E + F = 2, with three edges at each corner: E = 3V/2 */
}

/* The corners of cell i, counter-clockwise; returns how many, or 0 if they form no closed ring.
   Around a corner lie the cells i, j, k: we come in between i and j and leave between i and k. */
static int ring_of(int i, const corner_t **ring)
{
    const corner_t *mine[MAX_RING];
    int in[MAX_RING], out[MAX_RING], count = 0, v, s, at = 0, n = 0;
    for (v = 0; v < corners; ++v) {
        for (s = 0; s < 3; ++s) {
            if (corner[v].cell[s] != i) continue;
            if (count == MAX_RING) return 0;
            mine[count] = &corner[v];
            in[count] = corner[v].cell[(s + 1) % 3];
            out[count++] = corner[v].cell[(s + 2) % 3];
        }
    }
    if (count < 3) return 0;
    do {
        int next;
        ring[n++] = mine[at];
        for (next = 0; next < count && in[next] != out[at]; ++next) {
        }
        if (next == count) return 0;
        at = next;
    } while (at != 0 && n < count);
    return at == 0 && n == count ? n : 0; /* one ring, and all corners are on it */
}

static int every_cell_is_a_ring(void)
{
    const corner_t *ring[MAX_RING];
    int i;
    for (i = 0; i < cells; ++i)
        if (!ring_of(i, ring)) return 0;
    return 1;
}

/* The corners of the whole tissue. Neighbours of a cell are sought among the 20 nearest seeds. Across
   a hole between unrelaxed seeds they may be further off: then the rings do not close, and we reach
   out further. */
static int tile(void)
{
    int reach;
    for (reach = 20; reach <= MAX_REACH; reach *= 2)
        if (find_corners(reach) && every_cell_is_a_ring()) return 1;
    return 0;
}

/* --- 3. relax ---------------------------------------------------------------------- */

/* Every seed moves to the centroid of its cell (a fan of triangles about the seed), which lies a
   little below the surface and is pushed out again along the ray from the body's centre. */
static void relax(void)
{
    const corner_t *ring[MAX_RING];
    int i, k, c;
    for (i = 0; i < cells; ++i) {
        double moment[3] = {0, 0, 0}, size = 0, q = 0;
        int n = ring_of(i, ring);
        for (k = 0; k < n; ++k) {
            const double *a = ring[k]->x, *b = ring[(k + 1) % n]->x;
            double u[3], v[3], w[3], area;
            minus(a, seed[i], u);
            minus(b, seed[i], v);
            cross(u, v, w);
            area = sqrt(dot(w, w)) / 2;
            for (c = 0; c < 3; ++c) moment[c] += area * (seed[i][c] + a[c] + b[c]) / 3;
            size += area;
        }
        for (c = 0; c < 3; ++c) q += (moment[c] / size / axis[c]) * (moment[c] / size / axis[c]);
        for (c = 0; c < 3; ++c) seed[i][c] = moment[c] / size / sqrt(q);
    }
}

/* --- 4. print ---------------------------------------------------------------------- */

static void print_cells(void)
{
    const corner_t *ring[MAX_RING];
    int i, k;
    printf("cell\tx\ty\tz\tnx\tny\tnz\n");
    for (i = 0; i < cells; ++i) {
        int n = ring_of(i, ring);
        for (k = 0; k < n; ++k) {
            const double *x = ring[k]->x;
            double normal[3];
            normal_at(x, normal);
            printf("%d\t%.9f\t%.9f\t%.9f\t%.9f\t%.9f\t%.9f\n", i, x[0], x[1], x[2], normal[0], normal[1], normal[2]);
        }
    }
}

static const char help[] = "tissue > tissue.tsv\n"
                           "    400 cells on an ellipsoid, as a table: cell, corner x y z, outer normal nx ny nz\n"
                           "\n"
                           "  --cells N      how many cells, 12 to 10000 (400)\n"
                           "  --seed S       another tissue for each whole number S (1)\n"
                           "  --axes A,B,C   semi-axes along x, y, z in micrometres, 1 to 1000000 (110,50,40)\n"
                           "  --relax K      how often cells even out, 0 (wild) to 1000 (honeycomb) (3)\n"
                           "  --help         this text\n";

/* The exit status, once all of standard output has gone out. */
static int finish(void)
{
    if (!fflush(stdout) && !ferror(stdout) && !fclose(stdout)) return EXIT_SUCCESS;
    fprintf(stderr, "tissue: cannot write to standard output: %s\n", strerror(errno));
    return EXIT_FAILURE;
}

/* Says what is wrong with the command line, and leaves. */
static void refuse(const char *option, const char *problem)
{
    fprintf(stderr, "tissue: %s: %s (see tissue --help)\n", option, problem);
    exit(EXIT_FAILURE);
}

/* A whole number from least to most, written with digits only. */
static unsigned long read_whole(const char *option, const char *text, unsigned long least, unsigned long most)
{
    char problem[80];
    size_t digits = strspn(text, "0123456789");
    unsigned long value = digits > 0 && digits < 10 && !text[digits] ? strtoul(text, NULL, 10) : most + 1;
    if (value >= least && value <= most) return value;
    snprintf(problem, sizeof problem, "must be a whole number from %lu to %lu", least, most);
    refuse(option, problem);
    return 0;
}

static void read_axes(const char *option, const char *text)
{
    int c;
    for (c = 0; c < 3; ++c) {
        char *end;
        axis[c] = strtod(text, &end);
        if (end == text || *end != (c < 2 ? ',' : '\0') || !(axis[c] >= 1 && axis[c] <= 1e6))
            refuse(option, "must be three numbers from 1 to 1000000 with commas between, as 110,50,40");
        text = end + 1;
    }
}

int main(int argc, char **argv)
{
    unsigned long start = 1, rounds = 3, r;
    int a;
    for (a = 1; a < argc; a += 2) {
        const char *option = argv[a], *value = argv[a + 1]; /* NULL after the last */
        int is_cells = !strcmp(option, "--cells"), is_seed = !strcmp(option, "--seed");
        int is_axes = !strcmp(option, "--axes"), is_relax = !strcmp(option, "--relax");
        if (!strcmp(option, "--help")) {
            fputs(help, stdout);
            return finish();
        }
        if (!(is_cells || is_seed || is_axes || is_relax)) refuse(option, "no such option");
        if (!value) refuse(option, "a value is missing");
        if (is_cells) cells = (int)read_whole(option, value, 12, MAX_CELLS);
        if (is_seed) start = read_whole(option, value, 0, 999999999);
        if (is_relax) rounds = read_whole(option, value, 0, 1000);
        if (is_axes) read_axes(option, value);
    }

    scatter(start);
    for (r = 0; r <= rounds; ++r) {
        if (!tile()) {
            fprintf(stderr, "tissue: a cell wraps around the body: "
                            "take more --cells, rounder --axes or another --seed\n");
            return EXIT_FAILURE;
        }
        if (r < rounds) relax();
    }

    printf("# synthetic tissue: %d Voronoi cells on an ellipsoid, corners and outer normals, in micrometres; licence "
           "CC0\n",
           cells);
    printf("# made by: tissue --cells %d --seed %lu --axes %.15g,%.15g,%.15g --relax %lu\n", cells, start, axis[0],
           axis[1], axis[2], rounds);
    printf("# counter-clockwise about the outer normal; neighbouring cells share their corners to the last digit\n");
    print_cells();
    return finish();
}
