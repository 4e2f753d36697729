/* tissues.h - tissues for tests/test_patic.c: the dual cells of triangle meshes of many shapes. After surfmink.h.

   A vertex of the mesh that has triangles all round becomes a cell; a triangle becomes a corner, somewhere in it. So
   the topology of the tissue is that of the mesh, and corners are shared to the bit. */
#ifndef TISSUES_H
#define TISSUES_H

#include "shapes.h"

#include <stdlib.h>

typedef struct triangles {
    size_t vertices, triangles, vertex_room, triangle_room;
    double *vertex; /* 3 each */
    size_t *corner; /* 3 each, counter-clockwise from outside */
} triangles;

typedef struct tissue {
    enum surfmink_kind kind;
    size_t cells, corners;
    size_t *offset;
    double *corner, *normal; /* 3 each, whatever the kind; see tissue_outline */
    double *flat;            /* 2 each: x y */
} tissue;

static inline void *more(void *array, size_t count, size_t size)
{
    void *moved = realloc(array, (count + 1) * size);
    if (!moved) exit(1);
    return moved;
}

static inline size_t add_vertex(triangles *m, double x, double y, double z)
{
    if (m->vertices == m->vertex_room) {
        m->vertex_room = 2 * m->vertex_room + 16;
        m->vertex = (double *)more(m->vertex, m->vertex_room, 3 * sizeof *m->vertex);
    }
    m->vertex[3 * m->vertices] = x;
    m->vertex[3 * m->vertices + 1] = y;
    m->vertex[3 * m->vertices + 2] = z;
    return m->vertices++;
}

static inline void add_triangle(triangles *m, size_t a, size_t b, size_t c)
{
    if (m->triangles == m->triangle_room) {
        m->triangle_room = 2 * m->triangle_room + 16;
        m->corner = (size_t *)more(m->corner, m->triangle_room, 3 * sizeof *m->corner);
    }
    m->corner[3 * m->triangles] = a;
    m->corner[3 * m->triangles + 1] = b;
    m->corner[3 * m->triangles + 2] = c;
    ++m->triangles;
}

static inline void free_triangles(triangles *m)
{
    free(m->vertex);
    free(m->corner);
}

/* --- meshes ------------------------------------------------------------------------------------------------------- */

/* A grid of rows x columns quads, closed in u or v or not, each cut in two along a diagonal of either kind. */
static inline triangles grid_mesh(chance *c, size_t rows, size_t columns, int close_u, int close_v)
{
    triangles m = {0, 0, 0, 0, NULL, NULL};
    size_t nu = rows + !close_u, nv = columns + !close_v, i, j;
    for (i = 0; i < nu; ++i)
        for (j = 0; j < nv; ++j) add_vertex(&m, (double)i, (double)j, 0);
    for (i = 0; i < rows; ++i)
        for (j = 0; j < columns; ++j) {
            size_t a = i * nv + j, b = (i + 1) % nu * nv + j, d = i * nv + (j + 1) % nv;
            size_t e = (i + 1) % nu * nv + (j + 1) % nv;
            if (one_in(c, 4)) {
                add_triangle(&m, a, b, d);
                add_triangle(&m, b, e, d);
            } else {
                add_triangle(&m, a, b, e);
                add_triangle(&m, a, e, d);
            }
        }
    return m;
}

/* The plane, vertices shaken. */
static inline triangles plane_mesh(chance *c, size_t rows, size_t columns)
{
    triangles m = grid_mesh(c, rows, columns, 0, 0);
    size_t i;
    for (i = 0; i < 3 * m.vertices; ++i)
        if (i % 3 < 2) m.vertex[i] += between(c, -0.15, 0.15);
    return m;
}

/* A torus: 2 + 0.8 cos v from the axis. */
static inline triangles torus_mesh(chance *c, size_t rows, size_t columns)
{
    triangles m = grid_mesh(c, rows, columns, 1, 1);
    size_t i;
    for (i = 0; i < m.vertices; ++i) {
        double u = 2 * PI * (m.vertex[3 * i] + between(c, -0.1, 0.1)) / (double)rows;
        double v = 2 * PI * (m.vertex[3 * i + 1] + between(c, -0.1, 0.1)) / (double)columns;
        m.vertex[3 * i] = (2 + 0.8 * cos(v)) * cos(u);
        m.vertex[3 * i + 1] = (2 + 0.8 * cos(v)) * sin(u);
        m.vertex[3 * i + 2] = 0.8 * sin(v);
    }
    return m;
}

/* A cube whose sides are n x n squares, cut in two: the sphere, and what can be made of it. */
static inline triangles block_mesh(chance *c, const int *solid, int nx, int ny, int nz)
{
    triangles m = {0, 0, 0, 0, NULL, NULL};
    size_t points = (size_t)((nx + 1) * (ny + 1) * (nz + 1)), i;
    size_t *number = (size_t *)more(NULL, points, sizeof *number);
    int x, y, z, axis, side;
    for (i = 0; i < points; ++i) number[i] = (size_t)-1;
    for (x = 0; x < nx; ++x)
        for (y = 0; y < ny; ++y)
            for (z = 0; z < nz; ++z)
                for (axis = 0; axis < 3; ++axis)
                    for (side = 0; side < 2; ++side) {
                        int at[3], next[3], u = (axis + 1) % 3, v = (axis + 2) % 3, k;
                        size_t q[4];
                        at[0] = x, at[1] = y, at[2] = z;
                        memcpy(next, at, sizeof at);
                        next[axis] += side ? 1 : -1;
                        if (!solid[(x * ny + y) * nz + z]) continue;
                        if (next[0] >= 0 && next[0] < nx && next[1] >= 0 && next[1] < ny && next[2] >= 0 &&
                            next[2] < nz && solid[(next[0] * ny + next[1]) * nz + next[2]])
                            continue;
                        for (k = 0; k < 4; ++k) { /* counter-clockwise about the axis */
                            int p[3];
                            size_t place;
                            memcpy(p, at, sizeof at);
                            p[axis] += side;
                            p[u] += k == 1 || k == 2;
                            p[v] += k >= 2;
                            place = (size_t)((p[0] * (ny + 1) + p[1]) * (nz + 1) + p[2]);
                            if (number[place] == (size_t)-1) number[place] = add_vertex(&m, p[0], p[1], p[2]);
                            q[side ? k : 3 - k] = number[place];
                        }
                        k = (int)one_of(c, 2);
                        add_triangle(&m, q[k], q[k + 1], q[k + 2]);
                        add_triangle(&m, q[k], q[k + 2], q[(k + 3) % 4]);
                    }
    free(number);
    return m;
}

static inline void smooth_mesh(triangles *m, int passes)
{
    double *sum = (double *)more(NULL, m->vertices, 4 * sizeof *sum);
    size_t i, t, k, j;
    for (; passes > 0; --passes) {
        for (i = 0; i < 4 * m->vertices; ++i) sum[i] = 0;
        for (t = 0; t < m->triangles; ++t)
            for (k = 0; k < 3; ++k)
                for (j = 0; j < 4; ++j)
                    sum[4 * m->corner[3 * t + k] + j] += j < 3 ? m->vertex[3 * m->corner[3 * t + (k + 1) % 3] + j] : 1;
        for (i = 0; i < m->vertices; ++i)
            for (j = 0; j < 3; ++j) m->vertex[3 * i + j] = (m->vertex[3 * i + j] + sum[4 * i + j] / sum[4 * i + 3]) / 2;
    }
    free(sum);
}

/* An ellipsoid with these semi-axes, from a cube with n squares along an edge. */
static inline triangles ellipsoid_mesh(chance *c, int n, double a, double b, double d)
{
    const int one = 1;
    int *solid = (int *)more(NULL, (size_t)(n * n * n), sizeof *solid), i;
    triangles m;
    size_t v, k;
    for (i = 0; i < n * n * n; ++i) solid[i] = one;
    m = block_mesh(c, solid, n, n, n);
    free(solid);
    for (v = 0; v < m.vertices; ++v) {
        double *x = m.vertex + 3 * v, norm;
        for (k = 0; k < 3; ++k) x[k] = tan((x[k] / n - 0.5) * PI / 2) + between(c, -0.15, 0.15) / n;
        norm = sqrt(dot3(x, x));
        x[0] *= a / norm, x[1] *= b / norm, x[2] *= d / norm;
    }
    return m;
}

/* A plate with `holes` holes, smoothed: genus 1 or 2. */
static inline triangles plate_mesh(chance *c, int holes)
{
    enum { FINE = 2 };
    int nx = FINE * (2 * holes + 1), ny = FINE * 3, nz = FINE, x, y, z;
    int *solid = (int *)more(NULL, (size_t)(nx * ny * nz), sizeof *solid);
    triangles m;
    for (x = 0; x < nx; ++x)
        for (y = 0; y < ny; ++y)
            for (z = 0; z < nz; ++z) solid[(x * ny + y) * nz + z] = !(x / FINE % 2 == 1 && y / FINE == 1);
    m = block_mesh(c, solid, nx, ny, nz);
    free(solid);
    smooth_mesh(&m, 6);
    return m;
}

/* --- tissues ------------------------------------------------------------------------------------------------------ */

/* Dual cells. shake, below 0.3: how far a corner is from the middle of its triangle. */
static inline tissue dual_tissue(chance *c, const triangles *m, enum surfmink_kind kind, double shake)
{
    tissue s = {SURFMINK_PLANE, 0, 0, NULL, NULL, NULL, NULL};
    double *vertex_normal = (double *)more(NULL, m->vertices, 3 * sizeof *vertex_normal);
    double *point = (double *)more(NULL, m->triangles, 3 * sizeof *point);
    double *normal = (double *)more(NULL, m->triangles, 3 * sizeof *normal);
    size_t *begin = (size_t *)more(NULL, m->vertices + 1, sizeof *begin), *list, *fan, v, t, k, j, i, n;
    list = (size_t *)more(NULL, 3 * m->triangles, sizeof *list);
    fan = (size_t *)more(NULL, 3 * m->triangles, sizeof *fan);
    for (i = 0; i < 3 * m->vertices; ++i) vertex_normal[i] = 0;
    for (v = 0; v <= m->vertices; ++v) begin[v] = 0;
    for (t = 0; t < m->triangles; ++t) {
        const double *a = m->vertex + 3 * m->corner[3 * t], *b = m->vertex + 3 * m->corner[3 * t + 1];
        const double *d = m->vertex + 3 * m->corner[3 * t + 2];
        double u[3], w[3], area[3];
        for (k = 0; k < 3; ++k) u[k] = b[k] - a[k], w[k] = d[k] - a[k];
        cross3(u, w, area);
        for (k = 0; k < 3; ++k) {
            ++begin[m->corner[3 * t + k] + 1];
            for (j = 0; j < 3; ++j) vertex_normal[3 * m->corner[3 * t + k] + j] += area[j];
        }
    }
    for (v = 0; v < m->vertices; ++v) {
        double norm = sqrt(dot3(vertex_normal + 3 * v, vertex_normal + 3 * v));
        begin[v + 1] += begin[v];
        for (j = 0; j < 3 && norm > 0; ++j) vertex_normal[3 * v + j] /= norm;
    }
    for (t = 3 * m->triangles; t > 0; --t) { /* fills each list from its end, and begin[v] comes to rest at it */
        v = m->corner[t - 1];
        list[begin[v + 1] - 1] = (t - 1) / 3;
        --begin[v + 1];
    }
    /* begin[v + 1] is now where the list of v begins */
    for (t = 0; t < m->triangles; ++t) {
        double weight[3], sum = 0;
        for (k = 0; k < 3; ++k) sum += weight[k] = 1 + between(c, -shake, shake) * 2;
        for (j = 0; j < 3; ++j) {
            point[3 * t + j] = normal[3 * t + j] = 0;
            for (k = 0; k < 3; ++k) {
                point[3 * t + j] += weight[k] / sum * m->vertex[3 * m->corner[3 * t + k] + j];
                normal[3 * t + j] += weight[k] / sum * vertex_normal[3 * m->corner[3 * t + k] + j];
            }
        }
    }
    s.kind = kind;
    s.offset = (size_t *)more(NULL, m->vertices + 1, sizeof *s.offset);
    s.corner = (double *)more(NULL, 3 * m->triangles, 3 * sizeof *s.corner);
    s.normal = (double *)more(NULL, 3 * m->triangles, 3 * sizeof *s.normal);
    s.flat = (double *)more(NULL, 3 * m->triangles, 2 * sizeof *s.flat);
    s.offset[0] = 0;
    for (v = 0; v < m->vertices; ++v) {
        size_t first = begin[v + 1], last = v + 1 < m->vertices ? begin[v + 2] : 3 * m->triangles;
        n = last - first;
        if (n < 3) continue;
        fan[0] = list[first];
        for (i = 1; i <= n; ++i) { /* triangle v a b is followed by v b c */
            const size_t *old = m->corner + 3 * fan[i - 1];
            size_t b = old[0] == v ? old[2] : old[1] == v ? old[0] : old[1];
            for (j = first; j < last; ++j) {
                const size_t *now = m->corner + 3 * list[j];
                size_t a = now[0] == v ? now[1] : now[1] == v ? now[2] : now[0];
                if (a == b) break;
            }
            if (j == last) break;
            if (i < n) fan[i] = list[j];
        }
        if (i <= n) continue; /* open */
        for (i = 0; i < n; ++i) {
            memcpy(s.corner + 3 * s.corners, point + 3 * fan[i], 3 * sizeof *point);
            memcpy(s.normal + 3 * s.corners, normal + 3 * fan[i], 3 * sizeof *normal);
            s.flat[2 * s.corners] = point[3 * fan[i]];
            s.flat[2 * s.corners + 1] = point[3 * fan[i] + 1];
            ++s.corners;
        }
        s.offset[++s.cells] = s.corners;
    }
    free(vertex_normal);
    free(point);
    free(normal);
    free(begin);
    free(list);
    free(fan);
    return s;
}

static inline void free_tissue(tissue *s)
{
    free(s->offset);
    free(s->corner);
    free(s->normal);
    free(s->flat);
}

/* All outlines as surfmink sees them. */
static inline surfmink_outline tissue_outline(const tissue *s)
{
    if (s->kind == SURFMINK_PLANE) return surfmink_plane(s->flat, s->corners);
    if (s->kind == SURFMINK_SPHERE) return surfmink_sphere(s->corner, s->corners, 2);
    return surfmink_embedded(s->corner, s->normal, s->corners);
}

/* The cells that are to be kept, in the order of `order`, which may name a cell twice; each from its corner `start`
   on. */
static inline tissue pick_cells(const tissue *s, const size_t *order, const size_t *start, size_t cells)
{
    tissue r = {SURFMINK_PLANE, 0, 0, NULL, NULL, NULL, NULL};
    size_t i, k, n, corners = 0;
    for (i = 0; i < cells; ++i) corners += s->offset[order[i] + 1] - s->offset[order[i]];
    r.kind = s->kind;
    r.offset = (size_t *)more(NULL, cells, sizeof *r.offset);
    r.corner = (double *)more(NULL, corners, 3 * sizeof *r.corner);
    r.normal = (double *)more(NULL, corners, 3 * sizeof *r.normal);
    r.flat = (double *)more(NULL, corners, 2 * sizeof *r.flat);
    r.offset[0] = 0;
    for (i = 0; i < cells; ++i) {
        n = s->offset[order[i] + 1] - s->offset[order[i]];
        for (k = 0; k < n; ++k) {
            size_t from = s->offset[order[i]] + (k + (start ? start[i] : 0)) % n;
            memcpy(r.corner + 3 * r.corners, s->corner + 3 * from, 3 * sizeof *r.corner);
            memcpy(r.normal + 3 * r.corners, s->normal + 3 * from, 3 * sizeof *r.normal);
            memcpy(r.flat + 2 * r.corners, s->flat + 2 * from, 2 * sizeof *r.flat);
            ++r.corners;
        }
        r.offset[++r.cells] = r.corners;
    }
    return r;
}

/* Without the cells that chance drops. */
static inline tissue drop_cells(chance *c, const tissue *s, double share)
{
    size_t *order = (size_t *)more(NULL, s->cells, sizeof *order), i, kept = 0;
    tissue r;
    for (i = 0; i < s->cells; ++i)
        if (between(c, 0, 1) >= share) order[kept++] = i;
    r = pick_cells(s, order, NULL, kept);
    free(order);
    return r;
}

#endif
