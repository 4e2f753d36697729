/* api.h - the library under fuzzing, and small things that every harness of it asks. */
#ifndef FUZZ_API_H
#define FUZZ_API_H

#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "fuzz.h"

enum { CORNERS = 20, RANK = 12 };

typedef struct measured {
    double mu[RANK + 1], g[2 * RANK + 2];
    surfmink_functionals w;
    double length[CORNERS], turning[CORNERS];
    size_t bad;
    int status;
} measured;

static inline int is_known(int status)
{
    return status >= SURFMINK_OK && status <= SURFMINK_OPPOSITE_NORMALS;
}

static inline int all_finite(const double *x, size_t count)
{
    for (; count > 0; --count)
        if (!isfinite(x[count - 1])) return 0;
    return 1;
}

static inline int same_bits(const void *a, const void *b, size_t size)
{
    return memcmp(a, b, size) == 0;
}

/* Nothing has been written since memset(array, 0x5a, size). */
static inline int is_untouched(const void *array, size_t size)
{
    const unsigned char *at = (const unsigned char *)array;
    for (; size > 0; --size)
        if (*at++ != 0x5a) return 0;
    return 1;
}

#endif
