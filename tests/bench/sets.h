/* sets.h - what the benchmark measures: many outlines on one surface. Include it after surfmink.h. */
#ifndef BENCH_SETS_H
#define BENCH_SETS_H

#include "../shapes.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum surface { PLANE, SPHERE, EMBEDDED, SURFACES };
static const char *const surface_name[SURFACES] = {"plane", "sphere", "embedded"};

/* Up to 40 corners: stars, like cells of a tissue. From 1000: flowers, smooth curves well sampled. */
enum { SETS = 5, SMOOTH = 1000 };
static const char *const set_name[SETS] = {"q6", "ragged", "q40", "q1000", "q1e6"};
static const struct {
    size_t least, most;
} corners_of[SETS] = {{6, 6}, {3, 9}, {40, 40}, {1000, 1000}, {1000000, 1000000}}; /* all between are as likely */

typedef struct outlines {
    enum surface surface;
    size_t dim; /* doubles a corner */
    size_t count, longest;
    size_t *offset; /* outline i has the corners offset[i] .. offset[i+1] - 1 */
    double *corner; /* on the sphere: unit */
    double *normal; /* embedded: unit; else NULL */
} outlines;

/* Memory that is really there: pages that nobody wrote to may all be one page of zeros, which is always in cache. */
static void *reserve(size_t number, size_t size)
{
    void *memory = malloc(number * size);
    if (!memory) {
        fputs("bench: not enough memory\n", stderr);
        exit(2);
    }
    return memset(memory, 1, number * size);
}

/* A star about the origin, so that it never crosses itself. The more corners, the less their distance wobbles: turns
   are of every size and some go outwards, however many there are. */
static void draw_star(chance *c, size_t n, double *xy)
{
    double uneven = fmin(0.3, 1.5 / (double)n), start = between(c, 0, 2 * PI);
    size_t i;
    for (i = 0; i < n; ++i) {
        double r = between(c, 1 - uneven, 1 + uneven);
        double angle = start + 2 * PI * ((double)i + between(c, 0, 0.3)) / (double)n;
        xy[2 * i] = r * cos(angle);
        xy[2 * i + 1] = r * sin(angle);
    }
}

/* r = 1 + 0.3 cos 5 phi, the corners not quite evenly far apart. */
static void draw_flower(chance *c, size_t n, double *xy)
{
    double start = between(c, 0, 2 * PI);
    size_t i;
    for (i = 0; i < n; ++i) {
        double angle = start + 2 * PI * ((double)i + between(c, 0, 0.3)) / (double)n, r = 1 + 0.3 * cos(5 * angle);
        xy[2 * i] = r * cos(angle);
        xy[2 * i + 1] = r * sin(angle);
    }
}

static void lay_on_plane(chance *c, const double *xy, size_t n, double *corner)
{
    double x = between(c, -100, 100), y = between(c, -100, 100);
    size_t i;
    for (i = 0; i < n; ++i) {
        corner[2 * i] = x + xy[2 * i];
        corner[2 * i + 1] = y + xy[2 * i + 1];
    }
}

static void lay_on_sphere(chance *c, const double *xy, size_t n, double *corner)
{
    onto_sphere(xy, n, n < SMOOTH ? between(c, 0.05, 0.3) : 0.5, corner);
    turn_somehow(c, corner, n);
}

/* The same, stretched to the ellipsoid of the paper. */
static void lay_on_ellipsoid(chance *c, const double *xy, size_t n, double *corner, double *normal)
{
    static const double axis[3] = {1.6, 1.3, 1.0};
    size_t i, k;
    lay_on_sphere(c, xy, n, corner);
    for (i = 0; i < n; ++i, corner += 3, normal += 3) {
        double norm;
        for (k = 0; k < 3; ++k) {
            normal[k] = corner[k] / axis[k];
            corner[k] *= axis[k];
        }
        for (norm = sqrt(dot3(normal, normal)), k = 0; k < 3; ++k) normal[k] /= norm;
    }
}

/* Draws how many corners each outline has, until there are enough. */
static void draw_counts(chance *c, outlines *o, size_t least, size_t most, size_t corners)
{
    o->offset = (size_t *)reserve(corners / least + 2, sizeof *o->offset);
    o->offset[0] = 0;
    o->count = 0;
    o->longest = most;
    while (o->offset[o->count] < corners) {
        size_t n = least + one_of(c, most - least + 1);
        o->offset[o->count + 1] = o->offset[o->count] + n;
        ++o->count;
    }
}

static outlines make_outlines(enum surface surface, size_t set, size_t corners)
{
    chance c = {set + 1};
    size_t dim = surface == PLANE ? 2 : 3, i;
    outlines o = {surface, dim, 0, 0, NULL, NULL, NULL};
    double *xy = (double *)reserve(corners_of[set].most, 2 * sizeof *xy);
    draw_counts(&c, &o, corners_of[set].least, corners_of[set].most, corners);
    o.corner = (double *)reserve(o.offset[o.count], dim * sizeof *o.corner);
    if (surface == EMBEDDED) o.normal = (double *)reserve(o.offset[o.count], dim * sizeof *o.normal);
    for (i = 0; i < o.count; ++i) {
        size_t first = dim * o.offset[i], n = o.offset[i + 1] - o.offset[i];
        if (n < SMOOTH)
            draw_star(&c, n, xy);
        else
            draw_flower(&c, n, xy);
        if (surface == PLANE) lay_on_plane(&c, xy, n, o.corner + first);
        if (surface == SPHERE) lay_on_sphere(&c, xy, n, o.corner + first);
        if (surface == EMBEDDED) lay_on_ellipsoid(&c, xy, n, o.corner + first, o.normal + first);
    }
    free(xy);
    return o;
}

static void free_outlines(outlines *o)
{
    free(o->offset);
    free(o->corner);
    free(o->normal);
}

#endif
