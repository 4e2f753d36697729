/* outputs.c - what surfmink.h makes of the same outlines wherever it is compiled: its bits, or how far they are off.
   cc -I. tests/check/outputs.c -lm

     ./a.out                         a digest of the bits of all outputs, one for each kind of call
     ./a.out --write FILE            the outputs themselves, eight bytes a number, the most significant first
     ./a.out --compare FILE WITHIN   against those of another build: the same statuses, differences of L and the area
                                     (relative; areas to 1e-3 L^2 at least), S, mu_p, g_p / L and mu_p p theta_p within
                                     WITHIN (1 + c), where c is the condition number;
                                     otherwise the exit status is 1
     --doubles                       in units of (1 + c)^2, c = (sum |alpha| + |2 pi - S|) / S: of builds that have no
                                     more digits than a double, for they round where they should not, or do not
     --rounding up | down | zero     measured in that direction of rounding, where the machine has it; or one after the
                                     other, if there are several

   The outlines are made of integers and come out the same everywhere: by no function of libm, and by no operation that
   rounds but the conversion of an integer. All calls see ordinary ones and others that take the careful paths: extreme
   units, spikes, dents, hundreds of corners, nearly half a sphere, steep edges, flipped normals, refused ones. */
#include <fenv.h>
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef OUTLINES
#define OUTLINES 1500 /* fewer for emulators */
#endif
enum { CORNERS = 400, RANK = 12, STEP_RANK = 5 };
enum { NUMBERS = 5 + 3 * RANK + RANK }; /* of a measured outline: the functionals; mu, g and theta of ranks 1 to RANK */

/* --- outlines of integers ----------------------------------------------------------------------------------------- */

static uint64_t chance; /* splitmix64 */

static int64_t below(int64_t limit)
{
    uint64_t z = chance += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (int64_t)((z ^ (z >> 31)) % (uint64_t)limit);
}

/* A number times a power of two, without rounding. */
static double scaled(int64_t number, int exponent)
{
    double x = (double)number;
    for (; exponent > 0; --exponent) x *= 2;
    for (; exponent < 0; ++exponent) x /= 2;
    return x;
}

/* The fraction below one of two positive integers below 2^62, cut off after 53 bits that count. */
static double fraction(uint64_t part, uint64_t whole)
{
    uint64_t bits = 0;
    int i;
    for (i = 0; i < 100 && bits < UINT64_C(1) << 52; ++i) {
        part *= 2;
        bits = 2 * bits + (part >= whole);
        if (part >= whole) part -= whole;
    }
    return scaled((int64_t)bits, -i);
}

/* Seen from the origin these corners follow each other round a square, counter-clockwise; all below 2^30. */
static void star(size_t n, int64_t (*xy)[2])
{
    const int64_t half = 1 << 19;
    int dented = below(4) == 0;
    size_t i;
    for (i = 0; i < n; ++i) {
        int64_t s = ((int64_t)i * 8 * half + below(6 * half)) / (int64_t)n, t = s % (2 * half) - half;
        int64_t far = dented && below(3) == 0 ? 8 + below(8) : 600 + below(400);
        int64_t x[4] = {half, -t, -half, t}, y[4] = {t, half, -t, -half};
        xy[i][0] = x[s / (2 * half)] * far;
        xy[i][1] = y[s / (2 * half)] * far;
    }
}

typedef struct outline {
    size_t n;
    double plane[2 * CORNERS], sphere[3 * CORNERS], embedded[3 * CORNERS], normal[3 * CORNERS];
} outline;

/* By stereographic projection, 2^30 to the equator; `turn` is the axis that the pole comes to lie on. */
static void onto_sphere(int64_t x, int64_t y, int turn, double *at)
{
    const int64_t one = 1 << 30;
    uint64_t whole = (uint64_t)(one * one + x * x + y * y), height = (uint64_t)(one * one - x * x - y * y);
    double across = fraction((uint64_t)(2 * one * (x < 0 ? -x : x)), whole);
    double along = fraction((uint64_t)(2 * one * (y < 0 ? -y : y)), whole);
    at[turn] = x < 0 ? -across : across;
    at[(turn + 1) % 3] = y < 0 ? -along : along;
    at[(turn + 2) % 3] = x * x + y * y > one * one ? 0 : fraction(height, whole);
}

/* On z = (x x + y y) / 2 or (x x - y y) / 2, where 2^unit is 1. */
static void onto_paraboloid(int64_t x, int64_t y, int unit, int saddle, int scale, double *at, double *normal)
{
    at[0] = scaled(x, scale - unit);
    at[1] = scaled(y, scale - unit);
    at[2] = scaled(saddle ? x * x - y * y : x * x + y * y, scale - 2 * unit - 1);
    normal[0] = scaled(-x, -unit);
    normal[1] = scaled(saddle ? y : -y, -unit);
    normal[2] = 1;
}

static void make_outline(outline *o, int which)
{
    int64_t xy[CORNERS][2], x, y, shift, east = 0, south = 0;
    int scale, unit, turn, saddle;
    size_t i, k;
    chance = (uint64_t)which;
    shift = below(3) ? 1 + below(4) : 4 + below(12);
    scale = (int)below(9) - 4;
    unit = 32 + (int)below(6);
    turn = (int)below(3);
    saddle = (int)below(2);
    o->n = which % 25 == 7 ? 65 + (size_t)below(CORNERS - 65) : 3 + (size_t)below(20);
    star(o->n, xy);
    k = (size_t)below((int64_t)o->n - 2);
    switch (which % 17) {
    case 1: scale = -450; break;
    case 2: scale = 450; break;
    case 3: shift = 0; break;
    case 4: unit = 27 + (int)below(3); break;
    case 5: memcpy(xy[k + 2], xy[k], sizeof *xy); break;                 /* a spike */
    case 6: memcpy(xy[k + 1], xy[k], sizeof *xy); break;                 /* a repeated corner */
    case 8: xy[k + 1][0] = xy[k][0] + 1, xy[k + 1][1] = xy[k][1]; break; /* a tiny edge */
    case 9: memcpy(xy[k + 2], xy[k], sizeof *xy), ++xy[k + 2][0]; break; /* nearly a spike */
    case 11: shift = 20, east = south = 314491699; break; /* a cell of 5e-7 where two coordinates pass 1/2 */
    default: break;
    }
    for (i = 0; i < o->n; ++i) {
        k = which % 17 == 10 ? o->n - 1 - i : i; /* clockwise */
        x = xy[k][0];
        y = xy[k][1];
        o->plane[2 * i] = scaled(x, scale - 30);
        o->plane[2 * i + 1] = scaled(y, scale - 30);
        onto_paraboloid(x, y, unit, saddle, scale, o->embedded + 3 * i, o->normal + 3 * i);
        onto_sphere(east + x / (1 << shift), y / (1 << shift) - south, turn, o->sphere + 3 * i);
    }
}

/* --- outputs ------------------------------------------------------------------------------------------------------ */

static FILE *to, *from; /* --write, --compare */
static double within, worst[6];
static int doubles;
static int wrong_statuses, count, refused, compared;
static uint64_t digest;

static const char *const quantity[6] = {"L", "area", "S", "mu", "g/L", "theta"};

static uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* FNV-1a, a byte at a time from the most significant one on. */
static void put_bits(uint64_t bits)
{
    int i;
    for (i = 56; i >= 0; i -= 8) {
        digest = (digest ^ (bits >> i & 0xff)) * UINT64_C(0x100000001b3);
        if (to) fputc((int)(bits >> i & 0xff), to);
    }
}

static uint64_t get_bits(void)
{
    uint64_t bits = 0;
    int i;
    for (i = 0; i < 8; ++i) bits = bits << 8 | (uint64_t)(fgetc(from) & 0xff);
    return bits;
}

static void note(int what, double off)
{
    if (!(off <= worst[what])) worst[what] = off; /* NaN stays */
}

static void compare(const double *got, const double *want)
{
    double length = want[1], turning = want[2], c = want[4] + fabs(want[3]) / turning, amplified = 1 + c + c * c / 10;
    double area = fabs(want[0]) + 1e-3 * length * length, off;
    int p;
    if (doubles) amplified = pow(1 + c, 2);
    if (doubles && want[3] != 0) area += fabs(want[0] / want[3]); /* the square of the radius */
    note(0, fabs(got[1] / length - 1) / amplified);
    note(1, fabs(got[0] - want[0]) / area / amplified);
    note(2, fabs(got[2] - turning) / amplified);
    for (p = 0; p < RANK; ++p) {
        note(3, fabs(got[5 + p] - want[5 + p]) / amplified);
        note(4, fabs(got[5 + RANK + 2 * p] - want[5 + RANK + 2 * p]) / length / amplified);
        note(4, fabs(got[6 + RANK + 2 * p] - want[6 + RANK + 2 * p]) / length / amplified);
        off = remainder((p + 1) * (got[5 + 3 * RANK + p] - want[5 + 3 * RANK + p]), 6.28318530717958647692);
        note(5, fabs(off) * want[5 + p] / amplified);
    }
}

/* A status and, if it is OK, its numbers, which are compared if they are those of a measured outline. */
static void put(int status, const double *number, int numbers)
{
    double want[NUMBERS];
    int i, measured = numbers == NUMBERS, wanted;
    ++count;
    put_bits((uint64_t)status);
    if (status) ++refused;
    for (i = 0; i < numbers && !status; ++i) put_bits(bits_of(number[i]));
    if (!from) return;
    wanted = (int)get_bits();
    for (i = 0; i < numbers && !wanted; ++i) {
        uint64_t bits = get_bits();
        if (measured) memcpy(want + i, &bits, sizeof bits);
    }
    if (wanted != status) ++wrong_statuses;
    if (measured && !wanted && !status) compare(number, want), ++compared;
}

/* --- calls -------------------------------------------------------------------------------------------------------- */

static double radius = 3;
static outline shape[OUTLINES];

enum call { PLANE, SPHERE, EMBEDDED, SURFACE, CALLS };
static double condition[CALLS][OUTLINES];
static const char *const call_name[CALLS] = {"plane", "sphere", "embedded", "surface"};

static void put_measured(int status, const double *functionals, const double *mu, const double *g)
{
    double number[NUMBERS], theta[RANK + 1];
    if (!status) {
        memcpy(number, functionals, 5 * sizeof *number);
        memcpy(number + 5, mu + 1, RANK * sizeof *mu);
        memcpy(number + 5 + RANK, g + 2, 2 * RANK * sizeof *g);
        if (surfmink_spectrum(g, RANK, NULL, NULL, theta)) theta[1] = -9;
        memcpy(number + 5 + 3 * RANK, theta + 1, RANK * sizeof *theta);
    }
    put(status, number, NUMBERS);
}

static surfmink_outline view_of(enum call call, const outline *o)
{
    static const surfmink_surface *called;
    static surfmink_surface sphere;
    if (!called) sphere = surfmink_sphere_surface(&radius), called = &sphere;
    switch (call) {
    case PLANE: return surfmink_plane(o->plane, o->n);
    case SPHERE: return surfmink_sphere(o->sphere, o->n, radius);
    case EMBEDDED: return surfmink_embedded(o->embedded, o->normal, o->n);
    default: return surfmink_on_surface(called, o->sphere, o->n);
    }
}

static void single(enum call call, const outline *o)
{
    const surfmink_outline view = view_of(call, o);
    double mu[RANK + 1], g[2 * RANK + 2], number[5];
    surfmink_functionals w = {0, 0, 0, 0, 0};
    int status = surfmink_measure(&view, RANK, mu, g, &w, NULL);
    number[0] = w.area;
    number[1] = w.length;
    number[2] = w.turning;
    number[3] = w.curvature;
    number[4] = condition[call][o - shape] = w.condition;
    put_measured(status, number, mu, g);
}

/* All steps one by one, on a sphere or a paraboloid. */
static void steps(const outline *o, int curved)
{
    const surfmink_surface sphere = surfmink_sphere_surface(&radius);
    const surfmink_outline view = view_of(curved ? EMBEDDED : SPHERE, o), plane = view_of(PLANE, o);
    double length[CORNERS], turning[CORNERS], phase[CORNERS], g[2 * STEP_RANK + 2], frame[9], out[3 * STEP_RANK], x[3];
    surfmink_functionals w;
    int p, transport, status = surfmink_edges(&view, length, turning, NULL);
    put(status, length, (int)o->n);
    if (status) return;
    put(status, turning, (int)o->n);
    put(surfmink_total(&view, length, turning, o->n, &w), &w.area, 1);
    put(surfmink_total(NULL, length, turning, o->n, &w), &w.turning, 1);
    put(surfmink_area(&view, x), x, 1);
    put(surfmink_area(&plane, x), x, 1);
    put(surfmink_irreducible_parallel(length, turning, o->n, 1, 0.25, STEP_RANK, g), g, 2 * STEP_RANK + 2);
    for (transport = SURFMINK_DEFECT; transport >= SURFMINK_CORRECTED; --transport) {
        status = surfmink_phases(turning, o->n, transport, phase);
        put(status, phase, (int)o->n);
        if (status) return;
    }
    status = surfmink_irreducible(length, phase, o->n, STEP_RANK, g);
    put(status, g, 2 * STEP_RANK + 2);
    if (status) return;
    put(surfmink_frame(&view, 1, frame), frame, 9);
    memcpy(x, frame, sizeof x);
    put(surfmink_transport_vector(&view, turning, 1, -2, SURFMINK_CORRECTED, x), x, 3);
    for (p = 1; p <= STEP_RANK; ++p) {
        put(surfmink_angles(g, p, -1, out), out, p);
        put(surfmink_eigenvectors(g, p, 1, phase[1], frame, 3, out), out, 3 * p);
        put(surfmink_tensor(g, p, out), out, p + 1);
    }
    put(surfmink_sphere_log(o->sphere, o->sphere + 3, radius, x), x, 3);
    put(surfmink_sphere_exp(o->sphere, x, radius, x), x, 3);
    p = (int)below(360);
    put(surfmink_from_lonlat(p - 180, scaled(below(90 << 20), -20), radius, x), x, 3);
    put(surfmink_regular_polygon(&sphere, x, 0.25, 0.5, STEP_RANK, out), out, 3 * STEP_RANK);
}

static double all_corners[3 * CORNERS * OUTLINES], all_normals[3 * CORNERS * OUTLINES];

static void batch(enum call call)
{
    static size_t offset[OUTLINES + 1];
    static double length[OUTLINES], turning[OUTLINES], area[OUTLINES], mu[OUTLINES * (RANK + 1)],
        theta[OUTLINES * (RANK + 1)], g[OUTLINES * (2 * RANK + 2)];
    static int status[OUTLINES];
    surfmink_results out;
    surfmink_outline all;
    double number[5];
    size_t i, dim = call == PLANE ? 2 : 3;
    for (i = 0; i < OUTLINES; ++i) {
        const outline *o = shape + i;
        const double *corner = call == PLANE ? o->plane : call == SPHERE ? o->sphere : o->embedded;
        memcpy(all_corners + dim * offset[i], corner, dim * o->n * sizeof *corner);
        if (call == EMBEDDED) memcpy(all_normals + dim * offset[i], o->normal, dim * o->n * sizeof *corner);
        offset[i + 1] = offset[i] + o->n;
    }
    memset(&out, 0, sizeof out);
    out.status = status;
    out.length = length;
    out.turning = turning;
    out.area = area;
    out.mu = mu;
    out.g = g;
    out.theta = theta;
    all = view_of(call, shape);
    all.corner = all_corners;
    if (call == EMBEDDED) all.normal = all_normals;
    all.n = offset[OUTLINES];
    surfmink_batch(&all, offset, OUTLINES, RANK, &out, NULL);
    for (i = 0; i < OUTLINES; ++i) {
        number[0] = area[i];
        number[1] = length[i];
        number[2] = turning[i];
        number[3] = 6.28318530717958647692 - turning[i];
        number[4] = condition[call][i]; /* which batches do not tell */
        put_measured(status[i], number, mu + i * (RANK + 1), g + i * (2 * RANK + 2));
        if (!status[i]) put(0, theta + i * (RANK + 1), RANK + 1);
    }
}

static int round_towards(const char *direction)
{
#ifdef FE_UPWARD
    if (strcmp(direction, "up") == 0) return fesetround(FE_UPWARD);
    if (strcmp(direction, "down") == 0) return fesetround(FE_DOWNWARD);
    if (strcmp(direction, "zero") == 0) return fesetround(FE_TOWARDZERO);
    if (strcmp(direction, "nearest") == 0) return fesetround(FE_TONEAREST);
#endif
    (void)direction;
    return 1;
}

static void begin(void)
{
    digest = UINT64_C(0xcbf29ce484222325);
    count = refused = 0;
}

static void end(const char *before, const char *name)
{
    printf("%s%s: %d outputs, %d refused, bits %08lx%08lx\n", before, name, count, refused,
           (unsigned long)(digest >> 32), (unsigned long)(digest & 0xffffffff));
}

static void measure_all(void)
{
    int i, call;
    for (call = 0; call < CALLS; ++call) {
        begin();
        for (i = 0; i < OUTLINES; ++i) single((enum call)call, shape + i);
        end("", call_name[call]);
    }
    begin();
    for (i = 0; i < OUTLINES; ++i) steps(shape + i, i & 1);
    end("", "steps");
    for (call = 0; call < SURFACE; ++call) {
        begin();
        batch((enum call)call);
        end("batch of ", call_name[call]);
    }
}

/* Whether all is as it was in the file. */
static int compare_all(const char *direction)
{
    int i, same;
    wrong_statuses = compared = 0;
    memset(worst, 0, sizeof worst);
    rewind(from);
    if (direction && round_towards(direction)) return printf("%s: no such direction of rounding\n", direction), 0;
    measure_all();
    round_towards("nearest");
    same = wrong_statuses == 0 && fgetc(from) == EOF && compared > OUTLINES; /* so much was there to compare */
    printf("%d statuses differ; worst", wrong_statuses);
    for (i = 0; i < 6; ++i) {
        printf(" %s %.2g", quantity[i], worst[i]);
        if (!(worst[i] <= within)) same = 0;
    }
    puts(same ? "" : ": TOO MUCH");
    return same;
}

int main(int argc, char **argv)
{
    const char *direction[3];
    int i, directions = 0, same = 1;
    for (i = 0; i < OUTLINES; ++i) make_outline(shape + i, i);
    for (i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--write") == 0 && i + 1 < argc) {
            to = fopen(argv[++i], "wb");
            if (!to) return printf("%s: cannot be written\n", argv[i]), 2;
        } else if (strcmp(argv[i], "--compare") == 0 && i + 2 < argc) {
            from = fopen(argv[++i], "rb");
            within = strtod(argv[++i], NULL);
            if (!from) return printf("%s: cannot be read\n", argv[i - 1]), 2;
        } else if (strcmp(argv[i], "--doubles") == 0)
            doubles = 1;
        else if (strcmp(argv[i], "--rounding") == 0 && i + 1 < argc && directions < 3)
            direction[directions++] = argv[++i];
        else
            return printf("%s: what is that?\n", argv[i]), 2;
    }
    if (!from) {
        measure_all();
        return to && fclose(to) ? 2 : 0;
    }
    if (directions == 0) return !compare_all(NULL);
    for (i = 0; i < directions; ++i) same &= compare_all(direction[i]);
    return !same;
}
