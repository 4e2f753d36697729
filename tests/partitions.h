/* partitions.h - ways to cut a closed curve into edges, of which some are smooth and others are not. */
#ifndef PARTITIONS_H
#define PARTITIONS_H

#include <math.h>

#include "shapes.h" /* PI */

enum partition { UNIFORM, GRADED, ALTERNATING, TWO_HALVES, PARTITIONS };
static const char *const partition_name[PARTITIONS] = {"equal edges", "edges graded 1:4", "edges alternating 1:3",
                                                       "one half coarse 3:1"};

/* Where corner i of n lies, as a fraction of the curve; the middle of edge 0 is at 0. */
static double position(enum partition kind, size_t i, size_t n)
{
    double x = ((double)i - 0.5) / (double)n, h = 1.0 / (double)n;
    switch (kind) {
    case GRADED: return x + 0.1 * sin(2 * PI * x); /* from 1.6 h to 0.4 h */
    case ALTERNATING: return i % 2 ? h * ((double)i - 0.75) : h * ((double)i - 0.25);
    case TWO_HALVES: return x <= 0.75 ? x * 2 / 3 : 0.5 + (x - 0.75) * 2;
    default: return x;
    }
}

#endif
