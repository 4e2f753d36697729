/* playground.c - what examples/playground/playground.c computes, natively and with the libm of this machine.
   cc -I. tests/check/playground.c -lm

     ./a.out < outlines      one line an outline: kind base shape[3] n corners[3 n] and, of kind EMBEDDED, normals[3 n].
                             Prints its status, the results in the order of the struct, then how many points, the
                             points and their normals
     ./a.out --functions     how far sin, cos, atan2 and hypot of freestanding/math.h are off, in units in the last
                             place, against long double; exit status 1 if above what that file says */
#define fabs      own_fabs
#define sqrt      own_sqrt
#define floor     own_floor
#define ceil      own_ceil
#define fmin      own_fmin
#define fmax      own_fmax
#define hypot     own_hypot
#define ldexp     own_ldexp
#define pow       own_pow
#define remainder own_remainder
#define sin       own_sin
#define cos       own_cos
#define atan2     own_atan2
#include "examples/playground/freestanding/math.h"
#undef HUGE_VAL
#undef fabs
#undef sqrt
#undef floor
#undef ceil
#undef fmin
#undef fmax
#undef hypot
#undef ldexp
#undef pow
#undef remainder
#undef sin
#undef cos
#undef atan2

#include "examples/playground/playground.c"

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static uint64_t chance; /* splitmix64 */

static double random_number(void)
{
    uint64_t z = chance += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

/* Units in the last place of the right answer. */
static double units(double got, long double want)
{
    int exponent;
    frexpl(want, &exponent);
    return (double)(fabsl(got - want) / ldexpl(1, exponent - 53));
}

static void worst(double *most, double got, long double want)
{
    double off = units(got, want);
    if (!(off <= *most)) *most = off; /* a NaN is the worst */
}

static int functions(void)
{
    static const double special[] = {0, 1, 0.25, 0.5, 0.75, 1e-300, 1e300, 3, 1e-9, HUGE_VAL};
    double most[4] = {0, 0, 0, 0};
    int i, j, k, bad = 0;
    for (i = 0; i < 500000; ++i) {
        double size = pow(10, 17 * random_number() - 12), x = (2 * random_number() - 1) * size, y;
        if (i % 4 == 0) x = floor(random_number() * 60000) * 1.5707963267948966 + (random_number() - 0.5) * 1e-7;
        if (i % 4 == 1) x = (2 * random_number() - 1) * 7;
        worst(most, own_sin(x), sinl(x));
        worst(most + 1, own_cos(x), cosl(x));
        x = (2 * random_number() - 1) * size;
        y = (2 * random_number() - 1) * (i % 3 == 0 ? size : fabs(x) * 1.5);
        worst(most + 2, own_atan2(y, x), atan2l(y, x));
        worst(most + 3, own_hypot(y, x), hypotl(y, x));
    }
    for (i = 0; i < 10; ++i)
        for (j = 0; j < 10; ++j)
            for (k = 0; k < 4; ++k) {
                double y = copysign(special[i], k & 1 ? -1 : 1), x = copysign(special[j], k & 2 ? -1 : 1);
                double got = own_atan2(y, x), want = atan2(y, x);
                bad += !(fabs(got - want) <= 5e-16 * fabs(want)) || signbit(got) != signbit(want);
                bad += !(own_hypot(y, x) == hypot(y, x) || units(own_hypot(y, x), hypotl(y, x)) < 2);
                bad += own_fmin(y, x) != fmin(y, x) || own_fmax(y, x) != fmax(y, x);
                bad += own_ceil(y) != ceil(y) || own_floor(y) != floor(y);
            }
    bad += own_fmin(NAN, 1) != 1 || own_fmin(1, NAN) != 1 || own_fmax(NAN, 1) != 1 || own_fmax(1, NAN) != 1;
    bad += !isnan(own_sin(NAN)) || !isnan(own_cos(NAN)) || !isnan(own_atan2(NAN, 1)) || !isnan(own_atan2(1, NAN));
    bad += !isnan(own_sin(HUGE_VAL)) || own_ldexp(3, 5) != 96 || own_ldexp(3, -5) != 3.0 / 32;
    printf("sin %.3f cos %.3f atan2 %.3f hypot %.3f units in the last place; %d special values wrong\n", most[0],
           most[1], most[2], most[3], bad);
    return !(most[0] <= 0.8 && most[1] <= 0.8 && most[2] <= 1.7 && most[3] <= 2 && bad == 0);
}

static void print_numbers(const double *x, size_t n)
{
    size_t i;
    for (i = 0; i < n; ++i) printf(" %.17g", x[i]);
}

int main(int argc, char **argv)
{
    int kind, base, n, i, status;
    if (argc > 1 && strcmp(argv[1], "--functions") == 0) return functions();
    while (scanf("%d%d%lf%lf%lf%d", &kind, &base, shape, shape + 1, shape + 2, &n) == 6) {
        if (n > playground_corners()) return 1;
        for (i = 0; i < 3 * n; ++i)
            if (scanf("%lf", playground_corner() + i) != 1) return 1;
        for (i = 0; i < 3 * n && kind == EMBEDDED; ++i)
            if (scanf("%lf", playground_given() + i) != 1) return 1;
        status = playground_measure(kind, n, base);
        printf("%s", playground_status_name(status));
        print_numbers(playground_result(), sizeof result / sizeof(double));
        printf(" %d", playground_points());
        print_numbers(playground_point(), 3 * points);
        print_numbers(playground_normal(), 3 * points);
        putchar('\n');
    }
    return ferror(stdout) || fflush(stdout) != 0;
}
