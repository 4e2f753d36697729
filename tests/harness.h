/* harness.h - theorems that can fail. Include it after surfmink.h.

     THEOREM(a_square_is_as_square_as_can_be) { ... CHECK_NEAR(mu[4], 1.0, 1e-15); }
     int main(void) { PROVE(a_square_is_as_square_as_can_be); return QED(); }

   A check that fails prints file, line, expression, got and want, and the theorem goes on; so one run shows all that is
   wrong. CASE says which of many polygons it was, NOTE prints a line of its own. The last line of the program is
   `N passed, N failed`, counted in theorems, and its exit status is 1 if any failed.
   A theorem that checks nothing fails, and so does a program that proves none.
   With -DFEWER=N theorems that try many things try fewer, up to a factor of N: for emulators and sanitizers.
   With EFFORT=N in the environment (make test EFFORT=10) theorems that take a seed() are proved for N times as many:
   N rounds, of which the first is always the same. SLOW=0.5 names theorems that took so many seconds of the processor.
   A theorem that nobody PROVEs is an unused function: the compiler's warning is the check that the list is complete. */
#ifndef HARNESS_H
#define HARNESS_H

#include <math.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#ifndef FEWER
#define FEWER 1
#endif

#define THEOREM(name) static void name(void)
#define PROVE(name)   harness_prove(name, #name)
#define QED()         harness_qed()

#define CHECK(claim)            harness_true((claim) ? 1 : 0, #claim, __FILE__, __LINE__)
#define CHECK_EQUAL(got, want)  harness_equal((long long)(got), (long long)(want), #got, __FILE__, __LINE__)
#define CHECK_STATUS(got, want) harness_status((got), (want), #got, __FILE__, __LINE__)
#define CHECK_OK(got)           CHECK_STATUS(got, SURFMINK_OK)
/* Absolute, relative, and modulo 2 pi. A NaN is never near anything. */
#define CHECK_NEAR(got, want, within)  harness_near((got), (want), (within), 0, #got, __FILE__, __LINE__)
#define CHECK_CLOSE(got, want, within) harness_near((got), (want), (within), 1, #got, __FILE__, __LINE__)
#define CHECK_ANGLE(got, want, within) harness_near((got), (want), (within), 2, #got, __FILE__, __LINE__)
/* The same doubles, bit for bit. */
#define CHECK_SAME(got, want, count) harness_same((got), (want), (count), #got, __FILE__, __LINE__)

/* A check that calls none of these, for speed, unless it is known to fail. */
#define COUNTED ((void)++harness.checks)

/* An outline for the time of a call: surfmink_measure(IN_PLANE(corner, n), ...). */
#define IN_PLANE(corner, n)            ((surfmink_outline[1]){surfmink_plane(corner, n)})
#define ON_SPHERE(corner, n, radius)   ((surfmink_outline[1]){surfmink_sphere(corner, n, radius)})
#define IN_SPACE(corner, normal, n)    ((surfmink_outline[1]){surfmink_embedded(corner, normal, n)})
#define ON_SURFACE(surface, corner, n) ((surfmink_outline[1]){surfmink_on_surface(surface, corner, n)})

#ifndef HARNESS_SHOWN
#define HARNESS_SHOWN 5 /* failures printed for each theorem; the rest are only counted */
#endif

static struct {
    int passed, failed; /* theorems */
    long checks;        /* of the theorem at hand */
    int failures;       /* of them */
    int round, seeded;  /* which of the seeds, and whether it asks for one */
    const char *name;
    char which[200]; /* the case at hand */
} harness;

/* A theorem's own seed, another one each round. */
static inline uint64_t seed(uint64_t number)
{
    harness.seeded = 1;
    return number + 1000003 * (uint64_t)harness.round;
}

static inline void CASE(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(harness.which, sizeof harness.which, format, list);
    va_end(list);
}

static inline void NOTE(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
    putchar('\n');
}

static inline int harness_shows(const char *file, int line)
{
    if (harness.failures++ == 0) printf("FAILED %s\n", harness.name);
    if (harness.failures > HARNESS_SHOWN) return 0;
    printf("%s:%d: ", file, line);
    if (harness.round > 0) printf("[round %d] ", harness.round);
    if (harness.which[0]) printf("[%s] ", harness.which);
    return 1;
}

static inline void harness_true(int claim, const char *text, const char *file, int line)
{
    ++harness.checks;
    if (!claim && harness_shows(file, line)) printf("%s does not hold\n", text);
}

static inline void harness_equal(long long got, long long want, const char *text, const char *file, int line)
{
    ++harness.checks;
    if (got != want && harness_shows(file, line)) printf("%s: got %lld, want %lld\n", text, got, want);
}

static inline void harness_status(int got, int want, const char *text, const char *file, int line)
{
    ++harness.checks;
    if (got != want && harness_shows(file, line)) {
        printf("%s: got %d (%s), ", text, got, surfmink_status_name(got));
        printf("want %d (%s)\n", want, surfmink_status_name(want));
    }
}

static inline void harness_near(double got, double want, double within, int kind, const char *text, const char *file,
                                int line)
{
    static const char *const unit[3] = {"", " relative", " modulo 2 pi"};
    double off = got - want;
    ++harness.checks;
    if (kind == 1) off /= fabs(want);
    if (kind == 2) off = remainder(off, 6.28318530717958647692);
    if (got == want || fabs(off) <= within) return;
    if (harness_shows(file, line))
        printf("%s: got %.17g, want %.17g, off by %.3g%s where %.3g is allowed\n", text, got, want, off, unit[kind],
               within);
}

static inline void harness_same(const double *got, const double *want, size_t count, const char *text, const char *file,
                                int line)
{
    size_t i;
    harness.checks += count > 0;
    for (i = 0; i < count; ++i) {
        if (memcmp(&got[i], &want[i], sizeof *got) == 0) continue;
        if (harness_shows(file, line))
            printf("%s[%lu]: got %.17g, want %.17g to the bit\n", text, (unsigned long)i, got[i], want[i]);
        return;
    }
}

/* Leaves NaN on the stack, for variables that nobody has set. Before each theorem, and where one asks for it. */
static inline void harness_leave_nan(void)
{
    volatile unsigned char nan[65536];
    size_t i;
    for (i = 0; i < sizeof nan; ++i) nan[i] = 0xff;
}

static inline void harness_spoil_stack(void)
{
    static void (*volatile spoil)(void) = harness_leave_nan; /* not inlined: its stack is that of the next call */
    spoil();
}

static inline void harness_prove(void (*theorem)(void), const char *name)
{
    const char *effort = getenv("EFFORT"), *slow = getenv("SLOW");
    const clock_t start = clock();
    double seconds;
    int rounds = effort ? atoi(effort) : 1;
    harness.name = name;
    harness.checks = harness.failures = harness.round = harness.seeded = 0;
    do {
        harness_spoil_stack();
        harness.which[0] = '\0';
        theorem();
    } while (harness.seeded && ++harness.round < rounds);
    seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    if (slow && seconds >= atof(slow)) printf("%.1f s %s\n", seconds, name);
    if (harness.checks == 0 && harness_shows(__FILE__, __LINE__)) printf("nothing has been checked\n");
    if (harness.failures > HARNESS_SHOWN) printf("... and %d more\n", harness.failures - HARNESS_SHOWN);
    if (harness.failures)
        ++harness.failed;
    else
        ++harness.passed;
}

static inline int harness_qed(void)
{
    printf("%d passed, %d failed\n", harness.passed, harness.failed);
    return harness.failed != 0 || harness.passed == 0;
}

#endif
