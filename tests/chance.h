/* chance.h - numbers by chance, the same on every machine: splitmix64, for which every seed is a good one. */
#ifndef CHANCE_H
#define CHANCE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

typedef struct chance {
    uint64_t state;
} chance;

static inline uint64_t chance_bits(chance *c)
{
    uint64_t z = c->state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

static inline double between(chance *c, double low, double high)
{
    return low + (high - low) * ((double)(chance_bits(c) >> 11) / 9007199254740992.0);
}

/* 0 .. count - 1 */
static inline size_t one_of(chance *c, size_t count)
{
    return (size_t)(chance_bits(c) % count);
}

static inline int one_in(chance *c, size_t cases)
{
    return one_of(c, cases) == 0;
}

/* Magnitudes are what breaks things: all of them are equally likely. */
static inline double magnitude(chance *c, double low, double high)
{
    return exp(between(c, log(low), log(high)));
}

static inline double signed_magnitude(chance *c, double low, double high)
{
    double m = magnitude(c, low, high);
    return chance_bits(c) % 2 ? m : -m;
}

#endif
