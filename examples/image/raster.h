/* raster.h - tissues whose cells are known exactly -> label images and charts, to measure how well outlines are found.

   PLANE    seeds scattered over a square, one for each unit of area, and evened out. A cell is what is nearer to its
            seed than to any other (Voronoi): a polygon. Bent by two shears, whose inverse is known, its sides are
            curves.
   SURFACE  the same on the unit sphere, where the sides are great circles; stretched, an ellipsoid.
   CHART    Mercator's, all round the equator, whose right side goes on at the left; or stereographic, a disc.

   The same seed gives the same tissue everywhere, but for the last bits of sin and cos. C99 and C++, only libc,
   libm. */
#ifndef SURFMINK_IMAGE_RASTER_H
#define SURFMINK_IMAGE_RASTER_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define RASTER_PI 3.14159265358979323846

enum { RASTER_CORNERS = 64, RASTER_ALONG = 32 }; /* corners of a cell at most; points of a side that is curved */

typedef struct raster {
    int is_surface;
    size_t cells, side; /* side: of the square in the plane, cells = side^2 */
    double *seed;       /* 2 each in the plane, 3 on the sphere */
    double bend;        /* plane: how far the shears reach */
    double axis[3];     /* surface: of the ellipsoid */
} raster;

enum raster_chart { RASTER_MERCATOR, RASTER_STEREOGRAPHIC };

/* An image of a chart: scale is radians for each pixel at the equator, or at the centre. */
typedef struct raster_map {
    enum raster_chart kind;
    size_t width, height;
    double scale;
} raster_map;

static inline void raster_free(raster *t)
{
    free(t->seed);
    memset(t, 0, sizeof *t);
}

/* Uniform in [0, 1): splitmix64. */
static inline double raster_random(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

/* --- polygons ----------------------------------------------------------------------------------------------------- */

/* Cuts off what lies where a x + b y > c; returns how many corners are left. */
static inline size_t raster__clip(double corner[RASTER_CORNERS][2], size_t n, double a, double b, double c)
{
    double kept[RASTER_CORNERS][2];
    size_t i, count = 0;
    for (i = 0; i < n && count + 2 < RASTER_CORNERS; ++i) {
        const double *p = corner[i], *q = corner[i + 1 < n ? i + 1 : 0];
        double dp = a * p[0] + b * p[1] - c, dq = a * q[0] + b * q[1] - c;
        if (dp <= 0) {
            kept[count][0] = p[0];
            kept[count++][1] = p[1];
        }
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
            kept[count][0] = p[0] + dp / (dp - dq) * (q[0] - p[0]);
            kept[count++][1] = p[1] + dp / (dp - dq) * (q[1] - p[1]);
        }
    }
    memcpy(corner, kept, count * sizeof *kept);
    return count;
}

static inline size_t raster__box(double corner[RASTER_CORNERS][2], double low, double high)
{
    corner[0][0] = corner[0][1] = corner[1][1] = corner[3][0] = low;
    corner[1][0] = corner[2][0] = corner[2][1] = corner[3][1] = high;
    return 4;
}

/* The cell of a seed in the plane, in a square with a margin round it, counter-clockwise. */
static inline size_t raster__plane_cell(const raster *t, size_t cell, double margin, double corner[RASTER_CORNERS][2])
{
    const double *s = t->seed + 2 * cell;
    size_t k, n = raster__box(corner, -margin, (double)t->side + margin);
    for (k = 0; k < t->cells; ++k) {
        const double *o = t->seed + 2 * k;
        double a = o[0] - s[0], b = o[1] - s[1];
        if (k != cell) n = raster__clip(corner, n, a, b, a * 0.5 * (o[0] + s[0]) + b * 0.5 * (o[1] + s[1]));
    }
    return n;
}

/* Two directions at a point of the unit sphere, right-handed with it. */
static inline void raster__frame(const double x[3], double e[3], double f[3])
{
    int k = fabs(x[0]) < 0.6 ? 0 : 1;
    double length;
    e[0] = -x[k] * x[0];
    e[1] = -x[k] * x[1];
    e[2] = -x[k] * x[2];
    e[k] += 1;
    length = sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]);
    for (k = 0; k < 3; ++k) e[k] /= length;
    f[0] = x[1] * e[2] - x[2] * e[1];
    f[1] = x[2] * e[0] - x[0] * e[2];
    f[2] = x[0] * e[1] - x[1] * e[0];
}

/* The cell of a seed on the sphere, its corners of unit length. Seen from the centre on the tangent plane of the seed,
   great circles are straight lines. */
static inline size_t raster__sphere_cell(const raster *t, size_t cell, double out[RASTER_CORNERS][3])
{
    const double *s = t->seed + 3 * cell;
    double corner[RASTER_CORNERS][2], e[3], f[3], length;
    size_t k, n = raster__box(corner, -2, 2), c;
    raster__frame(s, e, f);
    for (k = 0; k < t->cells; ++k) {
        const double *o = t->seed + 3 * k;
        double a = 0, b = 0, height = 1; /* nearer to s than to o: x.(o - s) <= 0 */
        for (c = 0; c < 3; ++c) {
            a += (o[c] - s[c]) * e[c];
            b += (o[c] - s[c]) * f[c];
            height -= o[c] * s[c];
        }
        if (k != cell) n = raster__clip(corner, n, a, b, height);
    }
    for (k = 0; k < n; ++k) {
        length = sqrt(1 + corner[k][0] * corner[k][0] + corner[k][1] * corner[k][1]);
        for (c = 0; c < 3; ++c) out[k][c] = (s[c] + corner[k][0] * e[c] + corner[k][1] * f[c]) / length;
    }
    return n;
}

/* --- tissues ------------------------------------------------------------------------------------------------------ */

/* One step of Lloyd's: every seed to the middle of its cell, which evens the cells out. Returns 0 without memory. */
static inline int raster__relax(raster *t)
{
    size_t dim = t->is_surface ? 3 : 2, cell, k, c;
    double *moved = (double *)calloc(t->cells * dim, sizeof *moved);
    if (!moved) return 0;
    for (cell = 0; cell < t->cells; ++cell) {
        double flat[RASTER_CORNERS][2], round[RASTER_CORNERS][3], *to = moved + dim * cell, area = 0, length = 0;
        size_t n = t->is_surface ? raster__sphere_cell(t, cell, round) : raster__plane_cell(t, cell, 0, flat);
        for (k = 0; k < n; ++k) {
            size_t next = k + 1 < n ? k + 1 : 0;
            double twice;
            if (t->is_surface) {
                for (c = 0; c < 3; ++c) to[c] += round[k][c] / (double)n;
                continue;
            }
            twice = flat[k][0] * flat[next][1] - flat[next][0] * flat[k][1];
            area += twice;
            for (c = 0; c < 2; ++c) to[c] += twice * (flat[k][c] + flat[next][c]) / 3;
        }
        for (c = 0; c < dim; ++c) length += to[c] * to[c];
        for (c = 0; c < dim; ++c) to[c] /= t->is_surface ? sqrt(length) : area;
    }
    memcpy(t->seed, moved, t->cells * dim * sizeof *moved);
    free(moved);
    return 1;
}

/* side x side cells in the plane; bend 0: with straight sides. Returns 0 without memory. */
static inline int raster_plane(raster *t, size_t side, double bend, uint64_t seed, int relax)
{
    size_t k;
    memset(t, 0, sizeof *t);
    t->side = side;
    t->cells = side * side;
    t->bend = bend;
    t->seed = (double *)malloc(2 * t->cells * sizeof *t->seed);
    for (k = 0; t->seed && k < 2 * t->cells; ++k) t->seed[k] = (double)side * raster_random(&seed);
    while (t->seed && relax-- > 0)
        if (!raster__relax(t)) raster_free(t);
    return t->seed != NULL;
}

/* Cells all over an ellipsoid with these axes. */
static inline int raster_surface(raster *t, size_t cells, const double axis[3], uint64_t seed, int relax)
{
    size_t k;
    memset(t, 0, sizeof *t);
    t->is_surface = 1;
    t->cells = cells;
    memcpy(t->axis, axis, sizeof t->axis);
    t->seed = (double *)malloc(3 * cells * sizeof *t->seed);
    for (k = 0; t->seed && k < cells; ++k) {
        double z = 2 * raster_random(&seed) - 1, phi = 2 * RASTER_PI * raster_random(&seed), r = sqrt(1 - z * z);
        t->seed[3 * k] = r * cos(phi);
        t->seed[3 * k + 1] = r * sin(phi);
        t->seed[3 * k + 2] = z;
    }
    while (t->seed && relax-- > 0)
        if (!raster__relax(t)) raster_free(t);
    return t->seed != NULL;
}

/* --- exact outlines ----------------------------------------------------------------------------------------------- */

/* The shears, from the picture to the plane of the seeds; back: the other way. */
static inline void raster__shear(const raster *t, int back, double xy[2])
{
    const double wave = 2 * RASTER_PI / 3; /* three cells long */
    double reach = back ? -t->bend : t->bend;
    if (!back) xy[0] += reach * sin(wave * xy[1]);
    xy[1] += reach * sin(wave * xy[0] + 1);
    if (back) xy[0] += reach * sin(wave * xy[1]);
}

/* A point of the unit sphere on the ellipsoid, and the normal there. */
static inline void raster_stretch(const raster *t, const double unit[3], double x[3], double normal[3])
{
    double length = 0;
    int c;
    for (c = 0; c < 3; ++c) {
        x[c] = t->axis[c] * unit[c];
        normal[c] = unit[c] / t->axis[c];
        length += normal[c] * normal[c];
    }
    for (c = 0; c < 3; ++c) normal[c] /= sqrt(length);
}

/* The outline of a cell: x and y in units of the plane, or x y z nx ny nz, for `room` points at most. Straight sides of
   the plane have their ends, others RASTER_ALONG points each. Returns how many points. */
static inline size_t raster_cell(const raster *t, size_t cell, double *point, size_t room)
{
    double flat[RASTER_CORNERS][2], round[RASTER_CORNERS][3];
    size_t n = t->is_surface ? raster__sphere_cell(t, cell, round) : raster__plane_cell(t, cell, 1, flat);
    size_t along = t->is_surface || t->bend > 0 ? RASTER_ALONG : 1, count = 0, k, i, c;
    for (k = 0; k < n; ++k)
        for (i = 0; i < along && count < room; ++i, ++count) {
            size_t next = k + 1 < n ? k + 1 : 0;
            double s = (double)i / (double)along, unit[3], length = 0, *xy = point + 2 * count;
            if (t->is_surface) {
                for (c = 0; c < 3; ++c) unit[c] = (1 - s) * round[k][c] + s * round[next][c];
                for (c = 0; c < 3; ++c) length += unit[c] * unit[c];
                for (c = 0; c < 3; ++c) unit[c] /= sqrt(length);
                raster_stretch(t, unit, point + 6 * count, point + 6 * count + 3);
                continue;
            }
            for (c = 0; c < 2; ++c) xy[c] = (1 - s) * flat[k][c] + s * flat[next][c];
            raster__shear(t, 1, xy);
        }
    return count;
}

/* --- images ------------------------------------------------------------------------------------------------------- */

/* Seeds of the plane by the unit squares in which they lie: the first of each, and the one behind each; 1 + the number
   of the seed, 0 at the end. */
typedef struct raster__squares {
    uint32_t *first, *behind;
} raster__squares;

static inline size_t raster__square(const raster *t, double x)
{
    return x < 0 ? 0 : x < (double)t->side ? (size_t)x : t->side - 1;
}

/* The seed nearest to a point: square by square, ring after ring, until nothing further out can be nearer. */
static inline uint32_t raster__nearest(const raster *t, const raster__squares *squares, const double xy[2])
{
    int64_t side = (int64_t)t->side, ring, row, column;
    int64_t at_column = (int64_t)raster__square(t, xy[0]), at_row = (int64_t)raster__square(t, xy[1]);
    double best = HUGE_VAL;
    uint32_t nearest = 0, k;
    for (ring = 0; ring <= side && !(best <= (double)((ring - 1) * (ring - 1)) && ring > 1); ++ring)
        for (row = at_row - ring; row <= at_row + ring; ++row)
            for (column = at_column - ring; column <= at_column + ring; ++column) {
                int is_inner = row > at_row - ring && row < at_row + ring && column > at_column - ring;
                if (is_inner && column < at_column + ring) continue;
                if (row < 0 || row >= side || column < 0 || column >= side) continue;
                for (k = squares->first[row * side + column]; k; k = squares->behind[k - 1]) {
                    double dx = t->seed[2 * (k - 1)] - xy[0], dy = t->seed[2 * (k - 1) + 1] - xy[1];
                    if (!(dx * dx + dy * dy < best)) continue;
                    best = dx * dx + dy * dy;
                    nearest = k;
                }
            }
    return nearest;
}

/* The labels of the plane, `across` pixels to a unit: side x across pixels each way. The cell of seed k has the label
   k + 1. Pixel (row, column) has its centre at ((column + 1/2) / across, side - (row + 1/2) / across). */
static inline int raster_draw_plane(const raster *t, size_t across, uint32_t *label)
{
    size_t size = t->side * across, row, column, k, at;
    raster__squares squares;
    int good;
    squares.first = (uint32_t *)calloc(t->side * t->side, sizeof *squares.first);
    squares.behind = (uint32_t *)calloc(t->cells, sizeof *squares.behind);
    good = squares.first && squares.behind;
    for (k = 0; good && k < t->cells; ++k) {
        at = raster__square(t, t->seed[2 * k + 1]) * t->side + raster__square(t, t->seed[2 * k]);
        squares.behind[k] = squares.first[at];
        squares.first[at] = (uint32_t)k + 1;
    }
    for (row = 0; good && row < size; ++row)
        for (column = 0; column < size; ++column) {
            double xy[2];
            xy[0] = ((double)column + 0.5) / (double)across;
            xy[1] = (double)t->side - ((double)row + 0.5) / (double)across;
            raster__shear(t, 0, xy);
            label[row * size + column] = raster__nearest(t, &squares, xy);
        }
    free(squares.first);
    free(squares.behind);
    return good;
}

/* Where on the unit sphere a pixel of a chart lies, seen from outside; 0 if it lies on no part of it: Mercator's chart
   ends at 80 degrees, the stereographic one 60 degrees round its centre, which is none of the poles. */
static inline int raster_unproject(const raster_map *map, size_t row, size_t column, double unit[3])
{
    double x = map->scale * ((double)column - 0.5 * (double)(map->width - 1));
    double y = map->scale * (0.5 * (double)(map->height - 1) - (double)row);
    double d, r;
    if (map->kind == RASTER_MERCATOR) {
        unit[0] = cos(x) / cosh(y);
        unit[1] = sin(x) / cosh(y);
        unit[2] = tanh(y);
        return fabs(unit[2]) < 0.985;
    }
    r = 0.25 *
        (x * x + y * y); /* tan^2 of half the angle to the centre (0.6, 0, 0.8); e = (0, 1, 0), f = (-0.8, 0, 0.6) */
    d = 1 / (1 + r);
    unit[0] = d * (0.6 * (1 - r) - 0.8 * y);
    unit[1] = d * x;
    unit[2] = d * (0.8 * (1 - r) + 0.6 * y);
    return r < 1.0 / 3;
}

/* The labels of a chart, and for each pixel its position and normal, 3 planes each; beyond the rim the label is 0, and
   positions and normals are NaN. */
static inline void raster_draw_chart(const raster *t, const raster_map *map, uint32_t *label, float *position,
                                     float *normal)
{
    static const uint32_t no_number = 0x7fc00000;
    size_t pixels = map->width * map->height, at, k, c;
    double unit[3], x[3], n[3];
    for (at = 0; at < pixels; ++at) {
        int is_there = raster_unproject(map, at / map->width, at % map->width, unit);
        double best = -2;
        label[at] = 0;
        for (k = 0; is_there && k < t->cells; ++k) {
            double cosine = unit[0] * t->seed[3 * k] + unit[1] * t->seed[3 * k + 1] + unit[2] * t->seed[3 * k + 2];
            if (!(cosine > best)) continue;
            best = cosine;
            label[at] = (uint32_t)k + 1;
        }
        raster_stretch(t, unit, x, n);
        for (c = 0; c < 3; ++c) {
            position[c * pixels + at] = (float)x[c];
            normal[c * pixels + at] = (float)n[c];
            if (is_there) continue;
            memcpy(&position[c * pixels + at], &no_number, sizeof no_number);
            memcpy(&normal[c * pixels + at], &no_number, sizeof no_number);
        }
    }
}

/* Numbers of 4 bytes in the byte order of this machine as NPY, with one plane or three. */
static inline int raster_write_npy(const char *name, const void *number, int is_float, size_t planes, size_t height,
                                   size_t width)
{
    static const uint16_t one = 1;
    char head[128];
    FILE *file = fopen(name, "wb");
    int used, failed;
    if (!file) return 0;
    memset(head, ' ', sizeof head);
    memcpy(head, "\x93NUMPY\1\0v\0", 10); /* v: 118 bytes follow, the last of them a line end */
    used = snprintf(head + 10, 110,
                    planes > 1 ? "{'descr': '%c%s', 'fortran_order': False, 'shape': (%lu, %lu, %lu), }"
                               : "{'descr': '%c%s', 'fortran_order': False, 'shape': (%.0lu%lu, %lu), }",
                    *(const unsigned char *)&one ? '<' : '>', is_float ? "f4" : "u4",
                    (unsigned long)(planes > 1 ? planes : 0), (unsigned long)height, (unsigned long)width);
    head[10 + used] = ' ';
    head[127] = '\n';
    fwrite(head, 1, sizeof head, file);
    fwrite(number, 4, planes * height * width, file);
    failed = ferror(file);
    return fclose(file) == 0 && !failed;
}

#endif
