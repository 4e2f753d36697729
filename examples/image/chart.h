/* chart.h - maps of positions and normals -> points in space.

   A chart is a flat image of a curved surface: a map of positions tells where in space each pixel lies, a map of
   normals which way is out there. Between pixels both are bilinear. Where nothing is known a map has NaN. Without
   a map of normals they are made from the positions, and point to the side from which the chart is seen as it is
   drawn. */
#ifndef SURFMINK_IMAGE_CHART_H
#define SURFMINK_IMAGE_CHART_H

#include "image.h"

typedef struct chart {
    const image *position, *normal; /* three channels each; normal may be NULL */
    int wraps, flips;               /* flips: all normals turned round */
} chart;

/* --- vectors ------------------------------------------------------------------------------------------------------ */

static inline double chart_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void chart_cross(const double a[3], const double b[3], double out[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* 0 if it has no direction: zero, or not known. */
static inline int chart_unit(double v[3])
{
    double most = fabs(v[0]), length;
    int k;
    for (k = 1; k < 3; ++k)
        if (fabs(v[k]) > most) most = fabs(v[k]);
    if (!(most > 0 && most <= 1e300)) return 0;
    for (k = 0; k < 3; ++k) v[k] /= most; /* neither squares that overflow nor such that vanish */
    length = sqrt(chart_dot(v, v));
    for (k = 0; k < 3; ++k) v[k] /= length;
    return length == length;
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Is the position of this pixel known? */
static inline int chart__position(const chart *map, size_t row, size_t column, double x[3])
{
    size_t k;
    int known = 1;
    for (k = 0; k < 3; ++k) {
        x[k] = image_value(map->position, k, row, column);
        known = known && fabs(x[k]) <= 1e150;
    }
    return known;
}

/* The pixel beside this one; at the border of the image this one itself. */
static inline size_t chart__beside(size_t at, size_t size, int step, int wraps)
{
    if (step > 0) return at + 1 < size ? at + 1 : wraps ? 0 : at;
    return at > 0 ? at - 1 : wraps ? size - 1 : at;
}

/* The cross product of central differences. */
static inline int chart__made_normal(const chart *map, size_t row, size_t column, double n[3])
{
    size_t width = map->position->width, height = map->position->height;
    double east[3], west[3], north[3], south[3];
    int k;
    if (!chart__position(map, row, chart__beside(column, width, 1, map->wraps), east) ||
        !chart__position(map, row, chart__beside(column, width, -1, map->wraps), west) ||
        !chart__position(map, chart__beside(row, height, -1, 0), column, north) ||
        !chart__position(map, chart__beside(row, height, 1, 0), column, south))
        return 0;
    for (k = 0; k < 3; ++k) {
        east[k] -= west[k];
        north[k] -= south[k];
    }
    return chart_unit(east) && chart_unit(north) && (chart_cross(east, north, n), chart_unit(n));
}

/* Position and unit normal of a pixel; 0 if one of them is not known. */
static inline int chart_pixel(const chart *map, size_t row, size_t column, double x[3], double n[3])
{
    size_t k;
    if (!chart__position(map, row, column, x)) return 0;
    if (map->normal) {
        for (k = 0; k < 3; ++k) n[k] = image_value(map->normal, k, row, column);
        if (!chart_unit(n)) return 0;
    } else if (!chart__made_normal(map, row, column, n))
        return 0;
    for (k = 0; k < 3; ++k) n[k] = map->flips ? -n[k] : n[k];
    return 1;
}

/* --- points ------------------------------------------------------------------------------------------------------- */

/* Position and unit normal at a point of the image, x = column and y = -row; 0 if one of the pixels around it is not
   known. Beyond the centres of the outermost pixels the map goes on straight. */
static inline int chart_point(const chart *map, double x, double y, double position[3], double normal[3])
{
    size_t width = map->position->width, height = map->position->height, row, column, r, c, k;
    double fx, fy, weight, at[3], n[3];
    if (map->wraps) x -= floor(x / (double)width) * (double)width;
    column = x > 0 ? (size_t)x : 0;
    row = y < 0 ? (size_t)-y : 0;
    if (map->wraps && column >= width) column = width - 1; /* a hair below 0 was rounded to the width */
    if (!map->wraps && column + 2 > width) column = width > 2 ? width - 2 : 0;
    if (row + 2 > height) row = height > 2 ? height - 2 : 0;
    fx = x - (double)column;
    fy = -y - (double)row;
    for (k = 0; k < 3; ++k) position[k] = normal[k] = 0;
    for (r = 0; r < 2; ++r)
        for (c = 0; c < 2; ++c) {
            weight = (c ? fx : 1 - fx) * (r ? fy : 1 - fy);
            if (!(weight < 0 || weight > 0)) continue;
            if (row + r >= height || (!map->wraps && column + c >= width) ||
                !chart_pixel(map, row + r, (column + c) % width, at, n))
                return 0;
            for (k = 0; k < 3; ++k) {
                position[k] += weight * at[k];
                normal[k] += weight * n[k];
            }
        }
    return chart_unit(normal);
}

/* A corner of pixels: the sum of the four normals, made unit, and which way round the chart shows the surface there: 1
   as seen from outside, -1 mirrored, 0 neither (folded or torn). Returns 0 if one of the four pixels is not known. */
static inline int chart_corner(const chart *map, size_t row, size_t column, double normal[3], int *side)
{
    size_t width = map->position->width, k;
    size_t west = column > 0 ? column - 1 : width - 1, east = column < width ? column : 0;
    double ne[3], nw[3], sw[3], se[3], n[4][3], area[3], seen;
    if (!chart_pixel(map, row - 1, east, ne, n[0]) || !chart_pixel(map, row - 1, west, nw, n[1]) ||
        !chart_pixel(map, row, west, sw, n[2]) || !chart_pixel(map, row, east, se, n[3]))
        return 0;
    for (k = 0; k < 3; ++k) {
        normal[k] = n[0][k] + n[1][k] + n[2][k] + n[3][k];
        ne[k] -= sw[k];
        nw[k] -= se[k];
    }
    if (!chart_unit(normal)) normal[0] = normal[1] = normal[2] = 0; /* opposite normals: no side */
    chart_cross(ne, nw, area);
    seen = chart_dot(area, normal);
    *side = (seen > 0) - (seen < 0);
    return 1;
}

#endif
