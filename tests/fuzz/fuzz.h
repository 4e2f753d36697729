/* fuzz.h - what all harnesses share: numbers out of bytes, claims, and two ways to run.

   A harness is one file with fuzz(bytes): it turns bytes into a call and claims what must hold whatever they are. Each
   builds in two ways: with clang -fsanitize=fuzzer, or plainly with any compiler, when driver.h is its main. */
#ifndef FUZZ_H
#define FUZZ_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A claim that does not hold ends the program, so that fuzzers keep the input. */
#define CLAIM(what) ((what) ? (void)0 : fuzz_fails(#what, __FILE__, __LINE__))

static void fuzz_fails(const char *what, const char *file, int line)
{
    fflush(stdout);
    fprintf(stderr, "%s:%d: %s does not hold\n", file, line, what);
    abort();
}

/* --- numbers out of bytes ----------------------------------------------------------------------------------------- */

typedef struct bytes {
    const uint8_t *at;
    size_t left;
} bytes;

/* Zeros follow the end: every string of bytes says something. */
static inline unsigned take(bytes *in)
{
    if (in->left == 0) return 0;
    --in->left;
    return *in->at++;
}

/* A double of any bits; small integers, for coincidences; fractions, for polygons that can be measured; what breaks
   programs. */
static inline double take_number(bytes *in)
{
    static const double odd[16] = {0,     -0.0,   1,       -1,      1e-9,     1e-160, 1e160,    -1e300,
                                   1e300, 1e-300, DBL_MIN, DBL_MAX, -DBL_MAX, 5e-324, HUGE_VAL, NAN};
    unsigned how = take(in), k;
    uint64_t bits = 0;
    double x;
    if (how < 8) {
        for (k = 0; k < 8; ++k) bits = bits << 8 | take(in);
        memcpy(&x, &bits, sizeof x);
        return x;
    }
    if (how < 32) return odd[how % 16];
    if (how < 96) return (double)how - 64;
    x = ((double)how - 176) + take(in) / 256.0;
    return x + take(in) / 65536.0;
}

/* --- the two ways to run a harness -------------------------------------------------------------------------------- */

static void fuzz(bytes in);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    bytes in;
    in.at = data;
    in.left = size;
    fuzz(in);
    return 0;
}

#ifndef FUZZ_WITH_LIBFUZZER
#include "driver.h"
#endif

#endif
