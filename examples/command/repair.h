/* repair.h - step 2 of the command: a polygon -> the polygon that the options make of it. */
#ifndef SURFMINK_COMMAND_REPAIR_H
#define SURFMINK_COMMAND_REPAIR_H

#include "polygon.h"

/* Are they the same point, so that the library would refuse the edge between them? On a sphere directions decide. */
static int coincide(const polygon *p, size_t i, size_t j)
{
    size_t k, stride = stride_of(p->surface);
    const double *a = p->corner + i * stride, *b = p->corner + j * stride;
    double between[3];
    if (p->surface == SPHERE)
        return surfmink_sphere_log(a, b, 1, between) == SURFMINK_OK && between[0] == 0 && between[1] == 0 &&
               between[2] == 0;
    for (k = 0; k < stride; ++k)
        if (a[k] != b[k]) return 0;
    return 1;
}

static void drop_closing_corner(polygon *p)
{
    if (p->n > 1 && coincide(p, 0, p->n - 1)) --p->n;
}

/* surfmink_merge, but lines go along with their corners, and corners of a sphere are compared as directions. */
static void merge_corners(polygon *p)
{
    size_t i, kept = 1, stride = stride_of(p->surface);
    for (i = 1; i < p->n; ++i) {
        if (coincide(p, i, kept - 1)) continue;
        memmove(p->corner + kept * stride, p->corner + i * stride, stride * sizeof *p->corner);
        if (p->surface == EMBEDDED) memmove(p->normal + kept * 3, p->normal + i * 3, 3 * sizeof *p->normal);
        p->line[kept++] = p->line[i];
    }
    if (p->n > 0) p->n = kept;
    while (p->n > 1 && coincide(p, 0, p->n - 1)) --p->n;
}

static void smooth_corners(polygon *p, size_t passes)
{
    surfmink_smooth(p->corner, p->n, stride_of(p->surface), passes);
    if (p->surface == EMBEDDED) surfmink_smooth(p->normal, p->n, 3, passes);
}

static void reverse_corners(polygon *p)
{
    size_t i;
    surfmink_reverse(p->corner, p->n, stride_of(p->surface));
    if (p->surface == EMBEDDED) surfmink_reverse(p->normal, p->n, 3);
    for (i = 0; i < p->n / 2; ++i) {
        unsigned long line = p->line[i];
        p->line[i] = p->line[p->n - 1 - i];
        p->line[p->n - 1 - i] = line;
    }
}

/* In the order in which repairs may help each other. A fault shall not be smeared over its neighbours by smoothing. */
static void repair_polygon(polygon *p, const options *o)
{
    drop_closing_corner(p);
    if (p->fault != SURFMINK_OK) return;
    if (o->merge) merge_corners(p);
    smooth_corners(p, o->smooth);
    if (o->reverse == REVERSE_ALWAYS) reverse_corners(p);
}

#endif
