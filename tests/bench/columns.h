/* columns.h - what the benchmark compares: other ways to the same numbers, the product's calls, and the bare traffic of
   memory. Include it after surfmink.h and sets.h.

   Every column reads the same outlines and writes the same arrays: mu, g, L and S of each outline. A, B, C and D are
   kept as quick as their idea allows: nothing is checked, corners of the sphere and normals are taken as unit, long
   sums are not compensated. surfmink does all of that. */
#ifndef BENCH_COLUMNS_H
#define BENCH_COLUMNS_H

#include <math.h>
#include <string.h>

typedef struct task {
    outlines in;
    surfmink_results out;
    int max_rank;
    double *scratch; /* 2 doubles a corner */
    int no_scratch;  /* the batch has to do without */
    double seen;     /* what the columns without results make of their input */
} task;

/* Works on the outlines first .. last - 1. */
typedef void column_function(task *t, size_t first, size_t last);

/* Lengths l_i and turning angles alpha_i of one outline. */
typedef void edges_function(const double *corner, const double *normal, size_t n, double *length, double *turning);

static size_t ranks_of(const task *t)
{
    return (size_t)t->max_rank + 1;
}

static double clamp(double cosine)
{
    return cosine < -1 ? -1 : cosine > 1 ? 1 : cosine;
}

static void subtract3(const double *a, const double *b, double *difference)
{
    difference[0] = a[0] - b[0];
    difference[1] = a[1] - b[1];
    difference[2] = a[2] - b[2];
}

/* mu_p = |g_p| / L */
static void normalize(const double *g, int max_rank, double *mu)
{
    int p;
    for (p = 0; p <= max_rank; ++p) mu[p] = sqrt(g[2 * p] * g[2 * p] + g[2 * p + 1] * g[2 * p + 1]) / g[0];
}

/* --- A: the formulas of the paper as they are printed ------------------------------------------------------------- */

/* cos alpha_i = <e_{i-1}, e_i> / (l_{i-1} l_i), the sign from the determinant. */
static void paper_plane(const double *x, const double *normal, size_t n, double *length, double *turning)
{
    double in[2], out[2];
    size_t i;
    (void)normal;
    for (i = 0; i < n; ++i) {
        const double *next = x + 2 * (i + 1 < n ? i + 1 : 0);
        out[0] = next[0] - x[2 * i];
        out[1] = next[1] - x[2 * i + 1];
        length[i] = sqrt(out[0] * out[0] + out[1] * out[1]);
    }
    in[0] = x[0] - x[2 * n - 2];
    in[1] = x[1] - x[2 * n - 1];
    for (i = 0; i < n; ++i) {
        const double *next = x + 2 * (i + 1 < n ? i + 1 : 0);
        double angle;
        out[0] = next[0] - x[2 * i];
        out[1] = next[1] - x[2 * i + 1];
        angle = acos(clamp((in[0] * out[0] + in[1] * out[1]) / (length[i > 0 ? i - 1 : n - 1] * length[i])));
        turning[i] = in[0] * out[1] - in[1] * out[0] < 0 ? -angle : angle;
        in[0] = out[0];
        in[1] = out[1];
    }
}

/* P_n v = v - <v, n> n */
static void project(const double *v, const double *n, double *tangent)
{
    double along = dot3(v, n);
    size_t k;
    for (k = 0; k < 3; ++k) tangent[k] = v[k] - along * n[k];
}

/* cos alpha_i = -<v_1, v_2> / (|v_1| |v_2|), v_1 and v_2 the differences to the neighbours, projected. */
static double paper_turn(const double *previous, const double *x, const double *next, const double *normal)
{
    double a[3], b[3], v1[3], v2[3], cross[3], angle;
    subtract3(previous, x, a);
    subtract3(next, x, b);
    project(a, normal, v1);
    project(b, normal, v2);
    angle = acos(clamp(-dot3(v1, v2) / (sqrt(dot3(v1, v1)) * sqrt(dot3(v2, v2)))));
    cross3(v2, v1, cross);
    return dot3(normal, cross) < 0 ? -angle : angle;
}

static void paper_turns(const double *x, const double *normal, size_t n, double *turning)
{
    size_t i;
    for (i = 0; i < n; ++i)
        turning[i] =
            paper_turn(x + 3 * (i > 0 ? i - 1 : n - 1), x + 3 * i, x + 3 * (i + 1 < n ? i + 1 : 0), normal + 3 * i);
}

static void paper_sphere(const double *x, const double *normal, size_t n, double *length, double *turning)
{
    size_t i;
    (void)normal;
    for (i = 0; i < n; ++i) length[i] = acos(clamp(dot3(x + 3 * i, x + 3 * (i + 1 < n ? i + 1 : 0))));
    paper_turns(x, x, n, turning);
}

static void paper_embedded(const double *x, const double *normal, size_t n, double *length, double *turning)
{
    double edge[3];
    size_t i;
    for (i = 0; i < n; ++i) {
        subtract3(x + 3 * (i + 1 < n ? i + 1 : 0), x + 3 * i, edge);
        length[i] = sqrt(dot3(edge, edge));
    }
    paper_turns(x, normal, n, turning);
}

/* gcc makes one call of sincos out of sine and cosine; clang calls both.
   g_p = sum l_i (cos p f_i, sin p f_i), f_i = (2 pi / S) sum_{j=1..i} alpha_j */
static void paper_integrate(const double *length, const double *turning, size_t n, double total, int max_rank,
                            double *g)
{
    double turned = 0, phase;
    size_t i;
    int p;
    memset(g, 0, (2 * (size_t)max_rank + 2) * sizeof *g);
    for (i = 0; i < n; ++i) {
        if (i > 0) turned += turning[i];
        phase = 2 * PI / total * turned;
        g[0] += length[i];
        for (p = 1; p <= max_rank; ++p) {
            g[2 * p] += length[i] * cos(p * phase);
            g[2 * p + 1] += length[i] * sin(p * phase);
        }
    }
}

/* --- B: the best that scalar code on libm can do ------------------------------------------------------------------ */

static void libm_plane(const double *x, const double *normal, size_t n, double *length, double *turning)
{
    double in[2], out[2];
    size_t i;
    (void)normal;
    in[0] = x[0] - x[2 * n - 2];
    in[1] = x[1] - x[2 * n - 1];
    for (i = 0; i < n; ++i) {
        const double *next = x + 2 * (i + 1 < n ? i + 1 : 0);
        out[0] = next[0] - x[2 * i];
        out[1] = next[1] - x[2 * i + 1];
        length[i] = sqrt(out[0] * out[0] + out[1] * out[1]);
        turning[i] = atan2(in[0] * out[1] - in[1] * out[0], in[0] * out[0] + in[1] * out[1]);
        in[0] = out[0];
        in[1] = out[1];
    }
}

/* alpha_i = atan2(n . (in x out), in . out - (in . n)(out . n)) */
static double libm_turn(const double *in, const double *out, const double *n)
{
    double cross[3];
    cross3(in, out, cross);
    return atan2(dot3(n, cross), dot3(in, out) - dot3(in, n) * dot3(out, n));
}

/* l_i = 2 atan2(|y - x|, |y + x|) */
static void libm_sphere(const double *x, const double *normal, size_t n, double *length, double *turning)
{
    double in[3], out[3], sum[3];
    size_t i, k;
    (void)normal;
    subtract3(x, x + 3 * (n - 1), in);
    for (i = 0; i < n; ++i) {
        const double *next = x + 3 * (i + 1 < n ? i + 1 : 0);
        subtract3(next, x + 3 * i, out);
        for (k = 0; k < 3; ++k) sum[k] = next[k] + x[3 * i + k];
        length[i] = 2 * atan2(sqrt(dot3(out, out)), sqrt(dot3(sum, sum)));
        turning[i] = libm_turn(in, out, x + 3 * i);
        for (k = 0; k < 3; ++k) in[k] = out[k];
    }
}

static void libm_embedded(const double *x, const double *normal, size_t n, double *length, double *turning)
{
    double in[3], out[3];
    size_t i, k;
    subtract3(x, x + 3 * (n - 1), in);
    for (i = 0; i < n; ++i) {
        subtract3(x + 3 * (i + 1 < n ? i + 1 : 0), x + 3 * i, out);
        length[i] = sqrt(dot3(out, out));
        turning[i] = libm_turn(in, out, normal + 3 * i);
        for (k = 0; k < 3; ++k) in[k] = out[k];
    }
}

/* One call where libm has it: gcc finds that out by itself, clang does not. */
static void sine_cosine(double angle, double *sine, double *cosine)
{
#if defined(__GLIBC__) && defined(_GNU_SOURCE)
    sincos(angle, sine, cosine);
#else
    *sine = sin(angle);
    *cosine = cos(angle);
#endif
}

/* Multiplies each of the powers with exp(i f) once more and adds them up. */
static void add_rank(double *re, double *im, const double *cosine, const double *sine, size_t edges, double g[2])
{
    double sum_re = 0, sum_im = 0, product;
    size_t k;
    for (k = 0; k < edges; ++k) {
        product = re[k] * cosine[k] - im[k] * sine[k];
        im[k] = re[k] * sine[k] + im[k] * cosine[k];
        re[k] = product;
        sum_re += re[k];
        sum_im += im[k];
    }
    g[0] += sum_re;
    g[1] += sum_im;
}

/* The same sum; exp(i p f) by multiplying again and again with exp(i f). Edges are taken in blocks, rank by rank: then
   no multiplication waits for the one before, which at 12 ranks saves a quarter of the time. */
enum { BLOCK = 64 };

static void libm_integrate(const double *length, const double *turning, size_t n, double total, int max_rank, double *g)
{
    double re[BLOCK], im[BLOCK], cosine[BLOCK], sine[BLOCK], turned = 0;
    size_t first, edges, k;
    int p;
    memset(g, 0, (2 * (size_t)max_rank + 2) * sizeof *g);
    for (first = 0; first < n; first += edges) {
        edges = n - first < BLOCK ? n - first : BLOCK;
        for (k = 0; k < edges; ++k) {
            if (first + k > 0) turned += turning[first + k];
            sine_cosine(2 * PI / total * turned, &sine[k], &cosine[k]);
            g[0] += re[k] = length[first + k];
            im[k] = 0;
        }
        for (p = 1; p <= max_rank; ++p) add_rank(re, im, cosine, sine, edges, g + 2 * p);
    }
}

/* --- A and B: outline by outline ---------------------------------------------------------------------------------- */

static void measure_one(task *t, size_t i, edges_function *edges,
                        void (*integrate)(const double *, const double *, size_t, double, int, double *))
{
    const outlines *in = &t->in;
    size_t n = in->offset[i + 1] - in->offset[i], first = in->dim * in->offset[i], k;
    double *length = t->scratch, *turning = t->scratch + n, *g = t->out.g + 2 * ranks_of(t) * i, total = 0;
    edges(in->corner + first, in->normal ? in->normal + first : NULL, n, length, turning);
    for (k = 0; k < n; ++k) total += turning[k];
    integrate(length, turning, n, total, t->max_rank, g);
    normalize(g, t->max_rank, t->out.mu + ranks_of(t) * i);
    t->out.length[i] = g[0];
    t->out.turning[i] = total;
}

static void run_paper(task *t, size_t first, size_t last)
{
    static edges_function *const edges[SURFACES] = {paper_plane, paper_sphere, paper_embedded};
    size_t i;
    for (i = first; i < last; ++i) measure_one(t, i, edges[t->in.surface], paper_integrate);
}

static void run_libm(task *t, size_t first, size_t last)
{
    static edges_function *const edges[SURFACES] = {libm_plane, libm_sphere, libm_embedded};
    size_t i;
    for (i = first; i < last; ++i) measure_one(t, i, edges[t->in.surface], libm_integrate);
}

/* --- C: powers of the edge's normal, for each rank anew ----------------------------------------------------------- */

/* z^p by squaring: what libraries for the plane do, for instance papaya2, whose std::pow(std::complex<double>, int) is
   this loop in libstdc++. */
static void power(const double z[2], int p, double w[2])
{
    double re = z[0], im = z[1], product;
    w[0] = p & 1 ? re : 1;
    w[1] = p & 1 ? im : 0;
    while ((p >>= 1) > 0) {
        product = re * re - im * im;
        im = 2 * re * im;
        re = product;
        if ((p & 1) == 0) continue;
        product = w[0] * re - w[1] * im;
        w[1] = w[0] * im + w[1] * re;
        w[0] = product;
    }
}

/* g_p = sum l_i z_i^p, z_i the outer normal of edge i as a complex number. */
static void flat_integrate(const double *x, size_t n, int max_rank, double *g)
{
    double length, z[2], w[2];
    size_t i;
    int p;
    memset(g, 0, (2 * (size_t)max_rank + 2) * sizeof *g);
    for (i = 0; i < n; ++i) {
        const double *next = x + 2 * (i + 1 < n ? i + 1 : 0);
        z[0] = next[1] - x[2 * i + 1]; /* the edge turned to the right */
        z[1] = x[2 * i] - next[0];
        length = sqrt(z[0] * z[0] + z[1] * z[1]);
        z[0] /= length;
        z[1] /= length;
        g[0] += length;
        for (p = 1; p <= max_rank; ++p) {
            power(z, p, w);
            g[2 * p] += length * w[0];
            g[2 * p + 1] += length * w[1];
        }
    }
}

/* --- D: powers of the edge's normal, one multiplication a rank ---------------------------------------------------- */

/* The best that scalar code can do in the plane: no angle is ever formed. w_i = l_i z_i^p becomes that of the next
   rank, block by block as in B. */
static void direct_integrate(const double *x, size_t n, int max_rank, double *g)
{
    double re[BLOCK], im[BLOCK], cosine[BLOCK], sine[BLOCK], length;
    size_t first, edges, k, i;
    int p;
    memset(g, 0, (2 * (size_t)max_rank + 2) * sizeof *g);
    for (first = 0; first < n; first += edges) {
        edges = n - first < BLOCK ? n - first : BLOCK;
        for (k = 0; k < edges; ++k) {
            const double *next;
            i = first + k;
            next = x + 2 * (i + 1 < n ? i + 1 : 0);
            cosine[k] = next[1] - x[2 * i + 1]; /* the edge turned to the right */
            sine[k] = x[2 * i] - next[0];
            length = sqrt(cosine[k] * cosine[k] + sine[k] * sine[k]);
            cosine[k] /= length;
            sine[k] /= length;
            g[0] += re[k] = length;
            im[k] = 0;
        }
        for (p = 1; p <= max_rank; ++p) add_rank(re, im, cosine, sine, edges, g + 2 * p);
    }
}

/* C and D. S is not measured this way: in the plane it is 2 pi. */
static void measure_flat(task *t, size_t first, size_t last, void (*integrate)(const double *, size_t, int, double *))
{
    size_t i;
    for (i = first; i < last; ++i) {
        size_t from = t->in.offset[i], n = t->in.offset[i + 1] - from;
        double *g = t->out.g + 2 * ranks_of(t) * i;
        integrate(t->in.corner + 2 * from, n, t->max_rank, g);
        normalize(g, t->max_rank, t->out.mu + ranks_of(t) * i);
        t->out.length[i] = g[0];
        t->out.turning[i] = 2 * PI;
    }
}

static void run_flat(task *t, size_t first, size_t last)
{
    measure_flat(t, first, last, flat_integrate);
}

static void run_direct(task *t, size_t first, size_t last)
{
    measure_flat(t, first, last, direct_integrate);
}

/* --- surfmink ----------------------------------------------------------------------------------------------------- */

/* The corners of outlines first .. last - 1. */
static surfmink_outline view_of(const outlines *in, size_t first, size_t last)
{
    size_t at = in->dim * in->offset[first], n = in->offset[last] - in->offset[first];
    switch (in->surface) {
    case PLANE: return surfmink_plane(in->corner + at, n);
    case SPHERE: return surfmink_sphere(in->corner + at, n, 1.0);
    default: return surfmink_embedded(in->corner + at, in->normal + at, n);
    }
}

static void run_single(task *t, size_t first, size_t last)
{
    surfmink_functionals w = {0, 0, 0, 0, 0};
    size_t i;
    for (i = first; i < last; ++i) {
        surfmink_outline o = view_of(&t->in, i, i + 1);
        t->out.status[i] =
            surfmink_measure(&o, t->max_rank, t->out.mu + ranks_of(t) * i, t->out.g + 2 * ranks_of(t) * i, &w, NULL);
        t->out.length[i] = w.length;
        t->out.turning[i] = w.turning;
    }
}

static int by_steps(const surfmink_outline *o, int max_rank, double *scratch, double *mu, double *g,
                    surfmink_functionals *w)
{
    double *length = scratch, *turning = scratch + o->n;
    int status = surfmink_edges(o, length, turning, NULL);
    if (!status) status = surfmink_total(o, length, turning, o->n, w);
    if (!status) status = surfmink_phases(turning, o->n, SURFMINK_CORRECTED, turning);
    if (!status) status = surfmink_irreducible(length, turning, o->n, max_rank, g);
    if (!status) status = surfmink_spectrum(g, max_rank, NULL, mu, NULL);
    return status;
}

static void run_steps(task *t, size_t first, size_t last)
{
    surfmink_functionals w = {0, 0, 0, 0, 0};
    size_t i;
    for (i = first; i < last; ++i) {
        surfmink_outline o = view_of(&t->in, i, i + 1);
        t->out.status[i] =
            by_steps(&o, t->max_rank, t->scratch, t->out.mu + ranks_of(t) * i, t->out.g + 2 * ranks_of(t) * i, &w);
        t->out.length[i] = w.length;
        t->out.turning[i] = w.turning;
    }
}

/* Where the results go from outline `first` on. */
static surfmink_results results_from(const task *t, size_t first)
{
    surfmink_results out = t->out;
    out.status += first;
    out.length += first;
    out.turning += first;
    out.mu += ranks_of(t) * first;
    out.g += 2 * ranks_of(t) * first;
    return out;
}

static void run_batch(task *t, size_t first, size_t last)
{
    surfmink_outline all = view_of(&t->in, 0, last);
    surfmink_results out = results_from(t, first);
    surfmink_batch(&all, t->in.offset + first, last - first, t->max_rank, &out, t->no_scratch ? NULL : t->scratch);
}

/* --- bounds: nobody is quicker than memory ------------------------------------------------------------------------ */

/* Eight sums side by side: one alone would wait for its additions, not for memory. */
static double sum_of(const double *x, size_t n)
{
    double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0, g = 0, h = 0;
    size_t i;
    for (i = 0; i + 8 <= n; i += 8) {
        a += x[i], b += x[i + 1], c += x[i + 2], d += x[i + 3];
        e += x[i + 4], f += x[i + 5], g += x[i + 6], h += x[i + 7];
    }
    for (; i < n; ++i) a += x[i];
    return ((a + b) + (c + d)) + ((e + f) + (g + h));
}

static void run_read(task *t, size_t first, size_t last)
{
    const outlines *in = &t->in;
    size_t from = in->dim * in->offset[first], n = in->dim * in->offset[last] - from, offsets = 0, i;
    for (i = first; i < last; ++i) offsets += in->offset[i];
    t->seen += (double)offsets + sum_of(in->corner + from, n);
    if (in->normal) t->seen += sum_of(in->normal + from, n);
}

static void run_read_write(task *t, size_t first, size_t last)
{
    size_t count = last - first, ranks = ranks_of(t);
    int byte;
    run_read(t, first, last);
    byte = t->seen > 0;
    memset(t->out.status + first, byte, count * sizeof *t->out.status);
    memset(t->out.length + first, byte, count * sizeof *t->out.length);
    memset(t->out.turning + first, byte, count * sizeof *t->out.turning);
    memset(t->out.mu + ranks * first, byte, ranks * count * sizeof *t->out.mu);
    memset(t->out.g + 2 * ranks * first, byte, 2 * ranks * count * sizeof *t->out.g);
}

/* --- all of them, in the order of the tables ---------------------------------------------------------------------- */

enum { PAPER, LIBM, FLAT, DIRECT, SINGLE, STEPS, BATCH, BATCH_ALL, READ, READ_WRITE, COLUMNS };

static const char *const column_name[COLUMNS] = {"A",     "B",     "C",         "D",    "single",
                                                 "steps", "batch", "batch-all", "read", "read-write"};

static const struct {
    column_function *run;
    double tolerance; /* of mu against the batch; 0: nothing to compare. arccos keeps half of the digits at best */
    const char *meaning;
} column[COLUMNS] = {
    {run_paper, 1e-5, "the paper's formulas as printed: arccos; cos and sin of p f for every rank p"},
    {run_libm, 1e-12, "the best scalar libm code: atan2, one sin and cos an edge, powers by multiplication"},
    {run_flat, 1e-12, "plane only: for every rank a power of the edge's normal, as flat-space libraries do"},
    {run_direct, 1e-12, "plane only: powers of the edge's normal, one multiplication a rank, no trigonometry"},
    {run_single, 1e-12, "surfmink_measure for every outline"},
    {run_steps, 1e-12, "the four steps one by one for every outline"},
    {run_batch, 0, "surfmink_batch, one core"},
    {run_batch, 1e-12, "surfmink_batch, all cores (or --threads)"},
    {run_read, 0, "bound: a sum over corners, normals and offsets"},
    {run_read_write, 0, "bound: the same, and memset of all results"},
};

#endif
