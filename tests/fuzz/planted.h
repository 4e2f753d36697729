/* planted.h - faults that people make, planted into files that are right: the command surfmink then measures what it
   measured before, or what the changed outline is; or refuses it, or says what it found. Another number with status ok
   and no word fails.

   What an outline is, is computed here by other formulas than the header's: in the plane from the directions of its
   edges, elsewhere from the planes that hold them. x y of corners are whole numbers, so that which edges cross is known
   exactly, and so it is wherever else straight lines stay straight. */
#ifndef FUZZ_PLANTED_H
#define FUZZ_PLANTED_H

#include "world.h"

#define HAS_POSIX 0
#define main      command_main
#include "examples/surfmink.c"
#undef main

enum { MOST_ROWS = 128, RANKS = 6 };
enum { IN_THE_PLANE, ON_THE_SPHERE, IN_SPACE, KINDS };
enum meeting { SIMPLE, TOUCHES, CROSSES };

static const double two_pi = 6.28318530717958648;

typedef struct ring {
    size_t n;
    long x[MOST_ROWS][2];
} ring;

typedef struct truth {
    double length, mu[RANKS + 1];
} truth;

static unsigned dice(bytes *in, unsigned sides)
{
    unsigned x = take(in);
    return (x << 8 | take(in)) % sides;
}

/* --- how edges meet ----------------------------------------------------------------------------------------------- */

static long turn_of(const long *a, const long *b, const long *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static int sign_of(long x)
{
    return (x > 0) - (x < 0);
}

/* Does c, which lies on a line with a and b, lie between them? */
static int lies_between(const long *a, const long *b, const long *c)
{
    return (c[0] - a[0]) * (c[0] - b[0]) + (c[1] - a[1]) * (c[1] - b[1]) <= 0;
}

/* Neighbours have one point in common, and more only if they run there and back. */
static enum meeting meeting_of(const ring *r, size_t i, size_t j)
{
    const long *a = r->x[i], *b = r->x[(i + 1) % r->n], *c = r->x[j], *d = r->x[(j + 1) % r->n];
    int s = sign_of(turn_of(a, b, c)), t = sign_of(turn_of(a, b, d));
    int u = sign_of(turn_of(c, d, a)), v = sign_of(turn_of(c, d, b));
    if ((j + 1) % r->n == i && r->n > 2) return meeting_of(r, j, i);
    if ((i + 1) % r->n == j)
        return t == 0 && (b[0] - a[0]) * (d[0] - c[0]) + (b[1] - a[1]) * (d[1] - c[1]) <= 0 ? TOUCHES : SIMPLE;
    if (s * t < 0 && u * v < 0) return CROSSES;
    if ((s == 0 && lies_between(a, b, c)) || (t == 0 && lies_between(a, b, d)) || (u == 0 && lies_between(c, d, a)) ||
        (v == 0 && lies_between(c, d, b)))
        return TOUCHES;
    return SIMPLE;
}

static enum meeting worst_meeting(const ring *r)
{
    size_t i, j;
    enum meeting worst = SIMPLE;
    for (i = 0; i + 1 < r->n; ++i)
        for (j = i + 1; j < r->n; ++j) {
            enum meeting m = meeting_of(r, i, j);
            if (j == i + 1 && i == 0 && r->n == 3) m = m > meeting_of(r, 2, 0) ? m : meeting_of(r, 2, 0);
            if (m > worst) worst = m;
        }
    return worst;
}

static long double_area(const ring *r)
{
    long sum = 0;
    size_t i;
    for (i = 1; i + 1 < r->n; ++i) sum += turn_of(r->x[0], r->x[i], r->x[i + 1]);
    return sum;
}

/* A star about the origin, of 3 to 8 corners: simple, counter-clockwise. */
static inline void make_ring(bytes *in, ring *r)
{
    size_t i;
    do {
        double at = dice(in, 1000) / 1000.0, gap[8], sum = 0;
        r->n = 3 + dice(in, 6);
        for (i = 0; i < r->n; ++i) sum += gap[i] = 0.6 + 0.4 * dice(in, 1000) / 1000.0;
        for (i = 0; i < r->n; at += two_pi * gap[i++] / sum) {
            double reach = 400 + dice(in, 400);
            r->x[i][0] = lround(reach * cos(at));
            r->x[i][1] = lround(reach * sin(at));
        }
    } while (worst_meeting(r) != SIMPLE || double_area(r) <= 0);
}

/* --- what an outline is ------------------------------------------------------------------------------------------- */

static void cross_product(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static double inner(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The direction that stands on an edge, to its left, as seen where the normal is; and the length of the edge. */
static double left_of_edge(const double *from, const double *to, const double *normal, int kind, double *left)
{
    double e[3], size;
    int k;
    for (k = 0; k < 3; ++k) e[k] = to[k] - from[k];
    cross_product(kind == ON_THE_SPHERE ? from : normal, kind == ON_THE_SPHERE ? to : e, left);
    size = sqrt(inner(kind == ON_THE_SPHERE ? left : e, kind == ON_THE_SPHERE ? left : e));
    return kind == ON_THE_SPHERE ? atan2(size, inner(from, to)) : size;
}

/* Length and mu of the outline that is this ring: corner i at x[i], normals of any length there. Returns 0 where there
   are none: fewer corners than 3, edges without length, clockwise, crossing; touching itself and not turning once. */
static int find_truth(const ring *r, int kind, double (*x)[3], double (*normal)[3], truth *t)
{
    double turned, whole = 0, turn[MOST_ROWS], length[MOST_ROWS], in[3], out[3], c[3];
    size_t i;
    int p;
    if (r->n < 3 || double_area(r) <= 0 || worst_meeting(r) == CROSSES) return 0;
    for (i = 0; i < r->n; ++i) {
        size_t before = (i + r->n - 1) % r->n, next = (i + 1) % r->n;
        double size = sqrt(inner(normal[i], normal[i]));
        if (r->x[i][0] == r->x[next][0] && r->x[i][1] == r->x[next][1]) return 0;
        left_of_edge(x[before], x[i], normal[i], kind, in);
        length[i] = left_of_edge(x[i], x[next], normal[i], kind, out);
        cross_product(in, out, c);
        turn[i] = atan2(inner(c, normal[i]) / size, inner(in, out));
        if (kind == IN_THE_PLANE) {
            turn[i] = atan2(x[next][1] - x[i][1], x[next][0] - x[i][0]) -
                      atan2(x[i][1] - x[before][1], x[i][0] - x[before][0]);
            turn[i] -= two_pi * floor(turn[i] / two_pi + 0.5);
        }
        whole += turn[i];
    }
    if (kind == IN_THE_PLANE && !(fabs(whole - two_pi) < 1e-9)) return 0;
    for (t->length = 0, i = 0; i < r->n; ++i) t->length += length[i];
    for (p = 1; p <= RANKS; ++p) {
        double real = 0, imaginary = 0;
        for (turned = 0, i = 0; i < r->n; ++i) {
            if (i > 0) turned += turn[i];
            real += length[i] * cos(p * two_pi / whole * turned);
            imaginary += length[i] * sin(p * two_pi / whole * turned);
        }
        t->mu[p] = sqrt(real * real + imaginary * imaginary) / t->length;
    }
    return whole > 1e-9;
}

/* --- what the command says about it ------------------------------------------------------------------------------- */

/* Do these fields of a row, L to mu_6, say this? */
static int says(char *const *field, const truth *t)
{
    int p;
    if (!(fabs(strtod(field[3], NULL) - t->length) <= 1e-7 * t->length)) return 0;
    for (p = 1; p <= RANKS; ++p)
        if (!(fabs(strtod(field[5 + p], NULL) - t->mu[p]) <= 1e-7)) return 0;
    return 1;
}

/* Runs the command on a text, the first line of which has its options. */
static int run_command(const char *text)
{
    int status;
    bytes in;
    in.at = (const uint8_t *)text;
    in.left = strlen(text);
    CLAIM(world_begin(in));
    progress_is_shown = 0;
    held_back.write = NULL;
    status = world_run(command_main);
    CLAIM(status == EXIT_MEASURED || status == EXIT_TROUBLE || status == EXIT_REFUSED);
    if (world.said) claim_table(world.said);
    CLAIM(status != EXIT_TROUBLE || strncmp(world.complained, "-:", 2) == 0 || strstr(world.complained, "\n-:"));
    return status;
}

/* The next row of the table with status ok, cut into its fields; 0 behind the last one. */
static int next_row_said(char **at, char **field)
{
    while (**at) {
        char *end = strchr(*at, '\n'), *line = *at;
        size_t fields = 0;
        CLAIM(end != NULL);
        *at = end + 1;
        *end = '\0';
        for (field[0] = line; fields < 63 && (line = strchr(line, '\t')) != NULL; *line++ = '\0')
            field[++fields] = line + 1;
        if (fields > 5 + RANKS && strcmp(field[2], "ok") == 0) return 1;
    }
    return 0;
}

/* A number that is neither, with status ok: what has been found, for who looks for more; else the end. */
#ifdef PLANTED_SHOWS
#define JUDGE(name, holds, text) \
    dprintf(1, "%s\t%s\n", name, (holds) ? "holds" : "WRONG"), (holds) ? 0 : dprintf(2, "---- %s\n%s\n", name, text)
#else
#define JUDGE(name, holds, text) CLAIM(holds)
#endif

#endif
