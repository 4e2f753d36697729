/* kernels.c - how wrong can the functions be that surfmink.h has instead of libm's? Worst errors of the scalar ones and
   of each vector instance, densely over their arguments, against quadruple precision; and are the coefficients in the
   header those of their generator?

     cc -O2 -I. tests/accuracy/kernels.c -o kernels -lquadmath -lm     (gcc: __float128; aarch64: long double, -lm)
     ./kernels                     where surfmink.h stands, whose text it reads: the worst errors, with witnesses
     ./kernels --seed 2            the same at other points
     ./kernels --coefficients      the coefficients, as they stand in the header

   An instance that this machine cannot run is left out, and said to be. The exit status is 1 if one of the limits in
   `figure` is exceeded, an angle that should be exact is not, or a coefficient does not stand in the header. */
#define SURFMINK_STATIC
#define SURFMINK_DISPATCH /* all instances in one program */
#include "surfmink.h"

#if defined(__LDBL_MANT_DIG__) && __LDBL_MANT_DIG__ == 113
typedef long double quad;
#define atan2q atan2l
#define atanq  atanl
#define asinq  asinl
#define sinq   sinl
#define cosq   cosl
#define sqrtq  sqrtl
#define fabsq  fabsl
#define rintq  rintl
#elif !defined(__SIZEOF_FLOAT128__) || (defined(__has_include) && !__has_include(<quadmath.h>))
#error "kernels.c needs quadruple precision: gcc with libquadmath, for instance on x86-64, or aarch64"
#else
#include <quadmath.h>
typedef __float128 quad;
#endif
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../chance.h"

/* --- instances: the functions of each, as loops over arrays ------------------------------------------------------- */

#define PI 3.14159265358979323846

enum function { ATAN2, TURNS, ARC_ANGLE, CIS, FUNCTIONS };

/* atan2: y, x -> angle; turns: t -> re, im; arc_angle: chord, square -> angle; cis, scalar only: angle -> re, im */
enum { BLOCK = 4096 }; /* a multiple of all widths */
typedef void kernel(const double *a, const double *b, double *u, double *v);

#define KERNELS(suffix, real, target)                                                               \
    target static void atan2_of##suffix(const double *a, const double *b, double *u, double *v)     \
    {                                                                                               \
        real y, x, angle;                                                                           \
        size_t i;                                                                                   \
        (void)v;                                                                                    \
        for (i = 0; i < BLOCK; i += sizeof(real) / sizeof(double)) {                                \
            memcpy(&y, a + i, sizeof y);                                                            \
            memcpy(&x, b + i, sizeof x);                                                            \
            angle = surfmink__atan2##suffix(y, x);                                                  \
            memcpy(u + i, &angle, sizeof angle);                                                    \
        }                                                                                           \
    }                                                                                               \
    target static void turns_of##suffix(const double *a, const double *b, double *u, double *v)     \
    {                                                                                               \
        real t, re, im;                                                                             \
        size_t i;                                                                                   \
        (void)b;                                                                                    \
        for (i = 0; i < BLOCK; i += sizeof(real) / sizeof(double)) {                                \
            memcpy(&t, a + i, sizeof t);                                                            \
            surfmink__turns##suffix(t, &re, &im);                                                   \
            memcpy(u + i, &re, sizeof re);                                                          \
            memcpy(v + i, &im, sizeof im);                                                          \
        }                                                                                           \
    }                                                                                               \
    target static void arc_angle_of##suffix(const double *a, const double *b, double *u, double *v) \
    {                                                                                               \
        real chord, square, angle;                                                                  \
        size_t i;                                                                                   \
        (void)v;                                                                                    \
        for (i = 0; i < BLOCK; i += sizeof(real) / sizeof(double)) {                                \
            memcpy(&chord, a + i, sizeof chord);                                                    \
            memcpy(&square, b + i, sizeof square);                                                  \
            angle = surfmink__arc_angle##suffix(chord, square);                                     \
            memcpy(u + i, &angle, sizeof angle);                                                    \
        }                                                                                           \
    }

static void atan2_of(const double *a, const double *b, double *u, double *v)
{
    size_t i;
    (void)v;
    for (i = 0; i < BLOCK; ++i) u[i] = surfmink__atan2(a[i], b[i]);
}

static void arc_angle_of(const double *a, const double *b, double *u, double *v)
{
    size_t i;
    (void)v;
    for (i = 0; i < BLOCK; ++i) u[i] = surfmink__arc_lane(a[i], b[i]);
}

static void cis_of(const double *a, const double *b, double *u, double *v)
{
    size_t i;
    (void)b;
    for (i = 0; i < BLOCK; ++i) surfmink__cis(a[i], u + i, v + i);
}

#if SURFMINK__NATIVE == SURFMINK__SSE2
KERNELS(_sse2, surfmink__real_sse2, )
#endif
#if SURFMINK__NATIVE == SURFMINK__AVX2 || defined(SURFMINK__DISPATCHES)
KERNELS(_avx2, surfmink__real_avx2, __attribute__((target("avx2,fma"))))
#endif
#if SURFMINK__NATIVE == SURFMINK__AVX512 || defined(SURFMINK__DISPATCHES)
KERNELS(_avx512, surfmink__real_avx512, __attribute__((target("avx512f,avx512dq,fma"))))
#endif
#if SURFMINK__NATIVE == SURFMINK__NEON
KERNELS(_neon, surfmink__real_neon, )
#endif

#define FUNCTIONS_OF(suffix)                                           \
    {                                                                  \
        atan2_of##suffix, turns_of##suffix, arc_angle_of##suffix, NULL \
    }
static const struct {
    const char *name;
    kernel *function[FUNCTIONS];
} instance_of[] = {
    {"scalar", {atan2_of, NULL, arc_angle_of, cis_of}},
#if SURFMINK__NATIVE == SURFMINK__SSE2
    {"sse2", FUNCTIONS_OF(_sse2)},
#endif
#if SURFMINK__NATIVE == SURFMINK__AVX2 || defined(SURFMINK__DISPATCHES)
    {"avx2", FUNCTIONS_OF(_avx2)},
#endif
#if SURFMINK__NATIVE == SURFMINK__AVX512 || defined(SURFMINK__DISPATCHES)
    {"avx512", FUNCTIONS_OF(_avx512)},
#endif
#if SURFMINK__NATIVE == SURFMINK__NEON
    {"neon", FUNCTIONS_OF(_neon)},
#endif
};
enum { INSTANCES = sizeof instance_of / sizeof *instance_of };

static int can_run(int instance)
{
#ifdef SURFMINK__DISPATCHES
    if (!strcmp(instance_of[instance].name, "avx2"))
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    if (!strcmp(instance_of[instance].name, "avx512"))
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
#endif
    (void)instance;
    return 1;
}

/* --- figures: what is promised ------------------------------------------------------------------------------------ */

enum { ANGLE, ANGLE_RELATIVE, NEAR, FAR, MODULUS, ARC, PLAIN_NEAR, PLAIN_MODULUS, FIGURES };

static const struct {
    const char *name, *meaning;
    enum function function;
    double limit;
} figure[FIGURES] = {
    {"atan2", "absolute", ATAN2, 5e-16},
    {"atan2", "relative", ATAN2, 4e-16},
    {"turns, |t| <= 4", "absolute, either component", TURNS, 5e-16},
    {"turns, |t| <= 2^40", "absolute, either component", TURNS, 5e-16},
    {"turns", "||exp(2 pi i t)| - 1|", TURNS, 5e-16},
    {"arc_angle", "relative", ARC_ANGLE, 2e-16},
    {"cis, |angle| <= 4 pi", "absolute, either component", CIS, 5e-16},
    {"cis", "||exp(i angle)| - 1|", CIS, 5e-16},
};

typedef struct worst {
    double error, a, b;
    unsigned long points;
} worst;

static worst worst_of[FIGURES][INSTANCES];

static void note(int f, int instance, quad error, double a, double b)
{
    worst *w = &worst_of[f][instance];
    ++w->points;
    if (w->error != w->error || (double)error <= w->error) return; /* a NaN is the worst of all */
    w->error = (double)error;
    w->a = a;
    w->b = b;
}

/* --- the comparison ----------------------------------------------------------------------------------------------- */

static enum function on_trial;
static double in[2][BLOCK];
static size_t filled;

static void refer(double a, double b, quad want[2])
{
    quad angle = 8 * atanq(1) * (a - rintq(a)); /* a whole turn less: exact */
    if (on_trial == ATAN2) want[0] = atan2q(a, b);
    if (on_trial == ARC_ANGLE) want[0] = 2 * asinq((quad)a / 2);
    if (on_trial == CIS) angle = a;
    if (on_trial != TURNS && on_trial != CIS) return;
    want[0] = cosq(angle);
    want[1] = sinq(angle);
}

static void compare(int instance, double a, double b, double u, double v, const quad want[2])
{
    quad off = fabsq(u - want[0]), other;
    switch (on_trial) {
    case ATAN2:
        note(ANGLE, instance, off, a, b);
        if (want[0] != 0) note(ANGLE_RELATIVE, instance, off / fabsq(want[0]), a, b);
        break;
    case TURNS:
        other = fabsq(v - want[1]);
        note(fabs(a) <= 4 ? NEAR : FAR, instance, off > other || off != off ? off : other, a, 0);
        note(MODULUS, instance, fabsq((quad)u * u + (quad)v * v - 1) / 2, a, 0);
        break;
    case CIS:
        other = fabsq(v - want[1]);
        note(PLAIN_NEAR, instance, off > other || off != off ? off : other, a, 0);
        note(PLAIN_MODULUS, instance, fabsq((quad)u * u + (quad)v * v - 1) / 2, a, 0);
        break;
    default: note(ARC, instance, off / want[0], a, b);
    }
}

static void flush_points(void)
{
    static quad want[BLOCK][2];
    static double out[2][BLOCK];
    size_t i;
    int instance;
    for (i = 0; i < filled; ++i) refer(in[0][i], in[1][i], want[i]);
    for (instance = 0; instance < INSTANCES; ++instance) {
        if (!can_run(instance) || !instance_of[instance].function[on_trial]) continue;
        instance_of[instance].function[on_trial](in[0], in[1], out[0], out[1]);
        for (i = 0; i < filled; ++i) compare(instance, in[0][i], in[1][i], out[0][i], out[1][i], want[i]);
    }
    filled = 0;
}

static void point(double a, double b)
{
    in[0][filled] = a;
    in[1][filled] = b;
    if (++filled == BLOCK) flush_points();
}

/* --- arguments ---------------------------------------------------------------------------------------------------- */

static chance luck;

/* A ratio in all eight octants: of ordinary size, or of any at which neither leg is beyond 1e-150 or 1e150. */
static void octants(double ratio)
{
    double room = ratio > 1e-300 ? ratio : 1e-300, high = magnitude(&luck, 1, 2), low;
    int octant;
    if (chance_bits(&luck) % 2) high = magnitude(&luck, 1e-150 / room < 1e150 ? 1e-150 / room : 1e150, 1e150);
    low = ratio * high;
    for (octant = 0; octant < 8; ++octant) {
        double y = octant & 1 ? high : low, x = octant & 1 ? low : high;
        point(octant & 2 ? -y : y, octant & 4 ? -x : x);
    }
}

/* Ratios on a grid; and near 0, where octants meet, and at tan(pi / 8), where the reduction changes. */
static void try_atan2(void)
{
    const long grid = 1L << 17, near = 1L << 15;
    long i;
    on_trial = ATAN2;
    for (i = 0; i < grid; ++i) octants(((double)i + between(&luck, 0, 1)) / (double)grid);
    for (i = 0; i < near; ++i) {
        octants(magnitude(&luck, 1e-300, 1));
        octants(magnitude(&luck, 1e-17, 1));
        octants(1 - magnitude(&luck, 1e-17, 0.5));
        octants(0.41421356237309503 + signed_magnitude(&luck, 1e-17, 0.4));
    }
    flush_points();
}

/* All of |t| <= 4, more densely where octants meet; and beyond. */
static void try_turns(void)
{
    const long grid = 1L << 19, near = 1L << 17;
    long i;
    on_trial = TURNS;
    for (i = -grid; i < grid; ++i) point(4 * ((double)i + between(&luck, 0, 1)) / (double)grid, 0);
    for (i = 0; i < near; ++i) {
        point((double)(chance_bits(&luck) % 63) / 8 - 3.875 + signed_magnitude(&luck, 1e-18, 0.0625), 0);
        point(signed_magnitude(&luck, 1e-300, 4), 0);
        point(signed_magnitude(&luck, 4, 0x1p40), 0);
        point(rint(signed_magnitude(&luck, 32, 0x1p43)) / 8, 0);
    }
    flush_points();
}

/* All of |angle| <= 4 pi, more densely at multiples of pi / 4. */
static void try_cis(void)
{
    const long grid = 1L << 20, near = 1L << 18;
    long i;
    on_trial = CIS;
    for (i = -grid; i < grid; ++i) point(4 * PI * ((double)i + between(&luck, 0, 1)) / (double)grid, 0);
    for (i = 0; i < near; ++i) {
        point(PI / 4 * (double)(chance_bits(&luck) % 31) - 12 + signed_magnitude(&luck, 1e-18, 0.0625), 0);
        point(signed_magnitude(&luck, 1e-300, 12), 0);
    }
    flush_points();
}

/* A chord whose square has been rounded, or the root of a square. */
static void chord(double c)
{
    double square = c * c;
    point(c, square);
    if (c > 0) point(sqrt(square), square);
}

static void try_arc_angle(void)
{
    const long grid = 1L << 18, near = 1L << 17;
    long i;
    on_trial = ARC_ANGLE;
    for (i = 0; i < grid; ++i) chord(((double)i + between(&luck, 0, 1)) / (double)grid);
    for (i = 0; i < near; ++i) {
        chord(magnitude(&luck, 1e-160, 1));
        chord(1 - magnitude(&luck, 1e-17, 0.1));
    }
    chord(1);
    flush_points();
}

/* Angles that have to be right to the last bit: multiples of 45 degrees, at all sizes. */
static int check_exact(void)
{
    static const double way[10][2] = {{0, 1},    {1, 1},   {1, 0},  {1, -1}, {0, -1},
                                      {-0., -1}, {-1, -1}, {-1, 0}, {-1, 1}, {0, 0}};
    static double out[2][BLOCK];
    size_t i, count = 0;
    int instance, k, size, failed = 0;
    for (size = -150; size <= 150; ++size)
        for (k = 0; k < 10; ++k, ++count) {
            in[0][count] = way[k][0] * pow(10, size);
            in[1][count] = way[k][1] * pow(10, size);
        }
    for (instance = 0; instance < INSTANCES; ++instance) {
        if (!can_run(instance)) continue;
        instance_of[instance].function[ATAN2](in[0], in[1], out[0], out[1]);
        for (i = 0; i < count; ++i) {
            if (out[0][i] == (double)atan2q(in[0][i], in[1][i])) continue;
            if (instance == 0 && in[0][i] == 0 && out[0][i] == PI) continue; /* the scalar one knows no -0 */
            if (!failed++)
                printf("%s: atan2(%a, %a) is %a\n", instance_of[instance].name, in[0][i], in[1][i], out[0][i]);
        }
    }
    printf("atan2 at multiples of 45 degrees, from 1e-150 to 1e150: %d not exact\n", failed);
    return failed;
}

static int report(void)
{
    int f, instance, above, failed = 0;
    for (f = 0; f < FIGURES; ++f) {
        printf("%s (%s)\n", figure[f].name, figure[f].meaning);
        for (instance = 0; instance < INSTANCES; ++instance) {
            const worst *w = &worst_of[f][instance];
            double limit = figure[f].limit;
            if (!instance_of[instance].function[figure[f].function]) continue;
            if (!can_run(instance)) {
                printf("  %-7s cannot run here\n", instance_of[instance].name);
                continue;
            }
            above = !(w->error <= limit) || w->points == 0;
            printf("  %-7s %.3g of %.2g at %a", instance_of[instance].name, w->error, limit, w->a);
            if (figure[f].function != TURNS) printf(", %a", w->b);
            printf("; %lu points%s\n", w->points, above ? "  ABOVE ITS LIMIT" : "");
            failed += above;
        }
    }
    return failed;
}

/* --- coefficients ------------------------------------------------------------------------------------------------- */

static quad pi(void)
{
    return 4 * atanq(1);
}

static quad atan_rest(quad u)
{
    quad t = sqrtq(u);
    return (atanq(t) / t - 1) / u;
}

static quad asin_rest(quad u)
{
    quad chord = sqrtq(u);
    return (2 * asinq(chord / 2) / chord - 1) / u;
}

static quad sine_rest(quad v)
{
    quad r = sqrtq(v);
    return (sinq(pi() * r) / r - pi()) / v;
}

static quad cosine_rest(quad v)
{
    return (cosq(pi() * sqrtq(v)) - 1) / v;
}

static quad radian_sine_rest(quad v)
{
    quad x = sqrtq(v);
    return (sinq(x) / x - 1) / v;
}

static quad radian_cosine_rest(quad v)
{
    return (cosq(sqrtq(v)) - 1) / v;
}

enum { POLYNOMIALS = 6, MOST_COEFFICIENTS = 13 };

static const struct {
    const char *meaning;
    quad (*function)(quad u);
    int n;
} polynomial[POLYNOMIALS] = {
    {"atan2: (atan(t) / t - 1) / u, u = t^2 in [0, tan^2(pi / 8)]", atan_rest, 11},
    {"arc_angle: (2 asin(c / 2) / c - 1) / u, u = c^2 in [0, 1]", asin_rest, 13},
    {"turns: (sin(pi r) / r - pi) / v, v = r^2 in [0, 1/4]", sine_rest, 8},
    {"turns: (cos(pi r) - 1) / v, v = r^2 in [0, 1/4]", cosine_rest, 8},
    {"cis: (sin(x) / x - 1) / v, v = x^2 in [0, pi^2 / 4]", radian_sine_rest, 8},
    {"cis: (cos(x) - 1) / v, v = x^2 in [0, pi^2 / 4]", radian_cosine_rest, 8},
};

/* Where the domain of a polynomial ends; it begins at 0. */
static quad domain_of(int k)
{
    if (k == 0) return 3 - 2 * sqrtq(2); /* tan^2(pi / 8) */
    if (k > 3) return pi() * pi() / 4;
    return k == 1 ? 1 : (quad)1 / 4;
}

/* Interpolates polynomial k at Chebyshev's points: divided differences, then Newton's form multiplied out. */
static void interpolate(int k, double *coefficient)
{
    quad node[MOST_COEFFICIENTS], difference[MOST_COEFFICIENTS], sum[MOST_COEFFICIENTS] = {0};
    int n = polynomial[k].n, order, i;
    for (i = 0; i < n; ++i) {
        node[i] = domain_of(k) / 2 * (1 - cosq(pi() * (2 * i + 1) / (2 * n)));
        difference[i] = polynomial[k].function(node[i]);
    }
    for (order = 1; order < n; ++order)
        for (i = n - 1; i >= order; --i)
            difference[i] = (difference[i] - difference[i - 1]) / (node[i] - node[i - order]);
    for (order = n - 1; order >= 0; --order) { /* sum becomes sum (u - node) + difference */
        for (i = n - 1; i > 0; --i) sum[i] = sum[i - 1] - node[order] * sum[i];
        sum[0] = difference[order] - node[order] * sum[0];
    }
    for (i = 0; i < n; ++i) coefficient[i] = (double)sum[i];
}

/* Does a number stand in a text, and not as a part of a longer one? */
static int stands_in(const char *text, const char *number)
{
    const char *at = text;
    while ((at = strstr(at, number)) != NULL) {
        char before = at > text ? at[-1] : ' ', behind = at[strlen(number)];
        if (!strchr("-.0123456789", before) && strchr(",); ", behind)) return 1;
        ++at;
    }
    return 0;
}

static int print_coefficients(void)
{
    double coefficient[MOST_COEFFICIENTS];
    int k, i;
    for (k = 0; k < POLYNOMIALS; ++k) {
        interpolate(k, coefficient);
        printf("%s\n", polynomial[k].meaning);
        for (i = 0; i < polynomial[k].n; ++i) printf("  %.17g\n", coefficient[i]);
    }
    return 0;
}

static int check_coefficients(const char *name)
{
    static char text[1 << 20];
    double coefficient[MOST_COEFFICIENTS];
    char number[40];
    size_t size;
    int k, i, found = 0, missing = 0;
    FILE *file = fopen(name, "r");
    if (!file) {
        fprintf(stderr, "kernels: cannot read %s here\n", name);
        return 1;
    }
    size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[size] = 0;
    for (k = 0; k < POLYNOMIALS; ++k) {
        interpolate(k, coefficient);
        for (i = 0; i < polynomial[k].n; ++i) {
            snprintf(number, sizeof number, "%.17g", coefficient[i]);
            if (stands_in(text, number))
                ++found;
            else if (++missing)
                printf("coefficient %d of %s: %s does not stand in %s\n", i, polynomial[k].meaning, number, name);
        }
    }
    printf("coefficients: %d stand in %s, %d do not\n", found, name, missing);
    return missing;
}

int main(int argc, char **argv)
{
    int failed;
    if (argc == 2 && !strcmp(argv[1], "--coefficients")) return print_coefficients();
    if (argc == 3 && !strcmp(argv[1], "--seed"))
        luck.state = strtoull(argv[2], NULL, 10);
    else if (argc > 1) {
        fprintf(stderr, "usage: kernels [--seed S | --coefficients]\n");
        return 2;
    }
    failed = check_coefficients("surfmink.h");
    failed += check_exact();
    try_atan2();
    try_turns();
    try_arc_angle();
    try_cis();
    failed += report();
    printf("%d figures above their limits\n", failed);
    return failed != 0;
}
