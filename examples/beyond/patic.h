/* patic.h - the p-atic field of a tissue on a curved surface, for surfmink.h - MIT or public domain, as surfmink.h

   One header to copy beside surfmink.h and director.h. C99 and C++11, only public calls, no allocation, no globals.

   WHAT IT DOES
     Makes one field of p-fold directions out of the outlines of a tissue, carries it over the curved surface, and finds
     its topological defects: charges that are exact multiples of 1/p and add up to the Euler characteristic.

   QUICK START
     surfmink_outline all = surfmink_embedded(corner, normal, offset[cells]);   // all outlines, one after the other
     patic tissue;
     void *memory = malloc(patic_bytes(offset, cells, 6));
     patic_build(&tissue, &all, offset, cells, 6, -1, memory);                  // -1: the usual tolerance of welding
     patic_field(&tissue, 6, z, NULL);                                          // 2 doubles a cell
     patic_coarsen(&tissue, 6, 1.5 * tissue.spacing, z, coarse);                // optional
     patic_charges(&tissue, 6, coarse);
     for (i = 0, count = patic_defects(&tissue, coarse); i < count; ++i)
         printf("%g at %g %g %g\n", (double)tissue.defect[i].k / 6, tissue.defect[i].x[0], ...);

   DATA FLOW (sections of this file, in order)
     1 cells      outlines -> centre, normal, axis, length of each cell; or why it is refused
     2 topology   corners -> welded vertices -> neighbours -> loops of cells round a vertex or along the boundary
     3 field      outlines -> z, one complex number a cell
     4 coarse     z -> Z, its mean over a ball of cells, carried to the middle one
     5 charges    z or Z -> charge of each loop -> defects
     6 order      z -> correlation G(r)

   CONVENTIONS
     cell         frame (axis, across, normal), right-handed. The axis is the co-normal of edge 0, tilted to the
                  centre. Charges, order and G do not depend on it.
     z            mu_p exp(i p psi), psi the angle of the direction against the axis; z[2 c], z[2 c + 1]. 0: no
     direction
     half-edge    numbered as the corner at which it begins: from there to the next corner of the cell, counter-
     clockwise
     twin         the half-edge of the neighbour that runs the other way between the same two vertices
     loop         cells c_1 c_2 ... each reached from the one before across a half-edge, with the vertex or the
     outside on
                  the right. If the vertex has cells all round, the loop is a dual face, and closed. Else it is a walk
                  along the boundary of the tissue.
     charge       of a loop: k / p, with k a whole number
   docs/field.md has the definitions with their reasons. */
#ifndef PATIC_H
#define PATIC_H

#include "director.h"
#include <stdint.h>
#include <string.h>

#define PATIC_NONE ((size_t)-1)

/* Why a cell is refused, besides enum surfmink_status. A refused cell is a hole: the others are measured. */
enum patic_status {
    PATIC_OVERLAPS = 64,    /* a half-edge of it belongs to another cell: a duplicate, the third cell at an edge, or a
                               neighbour that runs the other way round */
    PATIC_MEETS_ITSELF = 65 /* it comes twice to the same vertex, or has fewer than three */
};

typedef struct patic_cell {
    int status;   /* of enum surfmink_status or patic_status. Refused cells have nothing but this and the next two */
    size_t other; /* the cell in the way: PATIC_OVERLAPS, SURFMINK_OPPOSITE_NORMALS between neighbours; or NONE */
    size_t bad;   /* the corner to blame, counted within the outline, or n */
    double centre[3], normal[3], axis[3], across[3]; /* frame: axis, across, normal */
    double length;                                   /* of the outline */
    size_t component;                                /* from 0 */
    size_t neighbours;                               /* cells with which it shares an edge */
    int boundary;                                    /* it has an edge without a neighbour */
} patic_cell;

typedef struct patic_loop {
    size_t first;  /* its first half-edge; of an isolated cell its first corner */
    size_t steps;  /* cells in it, counted each time that it passes; 0: an isolated cell */
    int closed;    /* all round one vertex. Two cells (steps = 2) have no charge between them */
    long k;        /* from patic_charges: p times the charge; of a boundary walk p times its term b */
    double margin; /* from patic_charges: the charge stays while every p psi turns by less than margin pi / 2 */
    double order;  /* from patic_charges: smallest |z| of the cells */
} patic_loop;

typedef struct patic_component {
    size_t cells;
    size_t walks;          /* along its boundary; 0: closed */
    long chi;              /* Euler characteristic: cells - shared edges + closed loops */
    long charge, boundary; /* from patic_charges: sums of k over its dual faces and boundary walks. Together p chi */
} patic_component;

typedef struct patic_defect {
    double x[3];          /* of a loop: the mean of its corners; of a core: the mean of the centres of its cells */
    long k;               /* p times the charge, not 0 */
    size_t loop;          /* PATIC_NONE: a core */
    size_t core;          /* the first of its cells; PATIC_NONE: none, the defect is a loop */
    double margin, order; /* as in patic_loop; of a core: of the steps and the cells round it */
} patic_defect;

typedef struct patic {
    surfmink_outline all; /* a view of your corners; offset is yours, too */
    const size_t *offset;
    size_t cells;
    int max_rank;
    double tolerance;    /* of welding */
    double spacing;      /* mean distance of neighbours; 0 if there are none */
    size_t measured;     /* cells that are not refused */
    size_t isolated;     /* cells without neighbours */
    size_t shared;       /* edges with a cell on both sides */
    size_t faces, walks; /* loops that are closed, loops along the boundary */
    size_t components, loops, defects;
    long chi;        /* of all components */
    double residual; /* from patic_charges: how far p times a charge was off a whole number, at most */
    /* arrays in the memory that you gave */
    patic_cell *cell;                 /* cells */
    patic_loop *loop;                 /* loops */
    patic_component *component;       /* components */
    patic_defect *defect;             /* defects, from patic_defects */
    size_t *neighbour, *neighbour_at; /* those of cell c: neighbour[neighbour_at[c]] .. [neighbour_at[c + 1] - 1] */
    size_t *vertex, *twin, *owner,
        *loop_at;                 /* of each half-edge: the first corner of all at the vertex where it begins;
                                     the other side, or NONE; its cell; its loop, or NONE */
    double *length, *phase, *lag; /* of each edge: l, f, and chi - f of director.h */
    double *step;                 /* of each half-edge: w of section 5, radians */
    size_t *table, slots;         /* hash table, for sections 2 */
    size_t *mark, *queue;         /* cells each */
    double *scratch;
} patic;

/* "ok", "overlaps", "meets_itself", ...: one word for a status of a cell. */
static inline const char *patic_status_name(int status)
{
    return status == PATIC_OVERLAPS       ? "overlaps"
           : status == PATIC_MEETS_ITSELF ? "meets_itself"
                                          : surfmink_status_name(status);
}

static inline const char *patic_strerror(int status)
{
    return status == PATIC_OVERLAPS       ? "an edge of it belongs to another cell"
           : status == PATIC_MEETS_ITSELF ? "the outline comes twice to the same vertex"
                                          : surfmink_strerror(status);
}

/* --- vectors and angles ------------------------------------------------------------------------------------------- */

static const double patic__pi = 3.14159265358979323846;

static inline double patic__dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void patic__cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* In any unit: squares of very long and very short vectors would be infinite or 0. */
static inline double patic__norm(const double *a)
{
    const double square = patic__dot(a, a), least = 1e-280, most = 1e280;
    return square > least && square < most ? sqrt(square) : hypot(hypot(a[0], a[1]), a[2]);
}

/* The angle of a vector in the frame of a cell. */
static inline double patic__angle(const patic_cell *c, const double *v)
{
    return atan2(patic__dot(v, c->across), patic__dot(v, c->axis));
}

/* The axis of i, carried to j by the smallest rotation n_i -> n_j. */
static inline void patic__carry(const patic_cell *i, const patic_cell *j, double v[3])
{
    double part = patic__dot(i->axis, j->normal) / (1 + patic__dot(i->normal, j->normal));
    int k;
    for (k = 0; k < 3; ++k) v[k] = i->axis[k] - part * (i->normal[k] + j->normal[k]);
}

/* r: its angle in the frame of j. */
static inline double patic__carried(const patic_cell *i, const patic_cell *j)
{
    double v[3];
    patic__carry(i, j, v);
    return patic__angle(j, v);
}

/* z of cell i, carried to cell j: times exp(i p r), without a sine. */
static inline void patic__carry_field(const patic_cell *i, const patic_cell *j, int p, const double *z, double out[2])
{
    double v[3], c, s, norm, re = z[0], im = z[1], old;
    if (i == j) {
        out[0] = re;
        out[1] = im;
        return;
    }
    patic__carry(i, j, v);
    c = patic__dot(v, j->axis);
    s = patic__dot(v, j->across);
    norm = sqrt(c * c + s * s);
    c /= norm;
    s /= norm;
    for (; p > 0; --p) {
        old = re;
        re = old * c - im * s;
        im = old * s + im * c;
    }
    out[0] = re;
    out[1] = im;
}

/* Distance of two cells: the chord between their centres times h / sin h, 2 h the angle between their normals; exact in
   the plane and on the sphere. */
static inline double patic__distance(const patic_cell *i, const patic_cell *j)
{
    double d[3], difference[3], sum[3], sine, cosine;
    int k;
    for (k = 0; k < 3; ++k) {
        d[k] = i->centre[k] - j->centre[k];
        difference[k] = i->normal[k] - j->normal[k];
        sum[k] = i->normal[k] + j->normal[k];
    }
    sine = patic__norm(difference) / 2;
    cosine = patic__norm(sum) / 2;
    return patic__norm(d) * (sine > 0 ? atan2(sine, cosine) / sine : 1);
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

/* Where the next array goes; with base = NULL only its place is counted. */
static inline void *patic__take(char *base, size_t *used, size_t count, size_t size)
{
    char *here = base ? base + *used : NULL;
    *used += (count * size + 15) / 16 * 16;
    return here;
}

static inline size_t patic__lay_out(patic *t, char *memory)
{
    size_t corners = t->offset[t->cells], used = 0, n = t->cells, ranks = (size_t)t->max_rank + 1;
    for (t->slots = 16; t->slots < 2 * corners; t->slots *= 2) continue;
    t->cell = (patic_cell *)patic__take(memory, &used, n, sizeof *t->cell);
    t->loop = (patic_loop *)patic__take(memory, &used, corners / 2 + n, sizeof *t->loop);
    t->component = (patic_component *)patic__take(memory, &used, n, sizeof *t->component);
    t->defect = (patic_defect *)patic__take(memory, &used, corners / 2 + n, sizeof *t->defect);
    t->neighbour = (size_t *)patic__take(memory, &used, corners, sizeof *t->neighbour);
    t->neighbour_at = (size_t *)patic__take(memory, &used, n + 1, sizeof *t->neighbour_at);
    t->vertex = (size_t *)patic__take(memory, &used, corners, sizeof *t->vertex);
    t->twin = (size_t *)patic__take(memory, &used, corners, sizeof *t->twin);
    t->owner = (size_t *)patic__take(memory, &used, corners, sizeof *t->owner);
    t->loop_at = (size_t *)patic__take(memory, &used, corners, sizeof *t->loop_at);
    t->length = (double *)patic__take(memory, &used, corners, sizeof *t->length);
    t->phase = (double *)patic__take(memory, &used, corners, sizeof *t->phase);
    t->lag = (double *)patic__take(memory, &used, corners, sizeof *t->lag);
    t->step = (double *)patic__take(memory, &used, corners, sizeof *t->step);
    t->table = (size_t *)patic__take(memory, &used, t->slots, sizeof *t->table);
    t->mark = (size_t *)patic__take(memory, &used, n, sizeof *t->mark);
    t->queue = (size_t *)patic__take(memory, &used, n, sizeof *t->queue);
    t->scratch = (double *)patic__take(memory, &used, 4 * ranks, sizeof *t->scratch);
    return used + 16; /* for memory that begins anywhere */
}

/* Bytes that patic_build needs: about 150 a corner and 350 a cell. 0 if offsets fall. */
static inline size_t patic_bytes(const size_t *offset, size_t cells, int max_rank)
{
    patic t;
    size_t i;
    memset(&t, 0, sizeof t);
    for (i = 0; i < cells; ++i)
        if (offset[i + 1] < offset[i]) return 0;
    t.offset = offset;
    t.cells = cells;
    t.max_rank = max_rank > 0 ? max_rank : 0;
    return patic__lay_out(&t, NULL);
}

/* --- 1. cells: outlines -> centre, normal, axis, length ----------------------------------------------------------- */

/* The outline of one cell. */
static inline surfmink_outline patic_outline(const patic *t, size_t c)
{
    surfmink_outline o = t->all;
    o.n = t->offset[c + 1] - t->offset[c];
    o.corner = t->all.corner + (o.kind == SURFMINK_PLANE ? 2 : 3) * t->offset[c];
    if (o.kind == SURFMINK_EMBEDDED) o.normal = t->all.normal + 3 * t->offset[c];
    return o;
}

static inline void patic__measure_cell(patic *t, size_t c)
{
    patic_cell *cell = &t->cell[c];
    surfmink_outline o = patic_outline(t, c);
    surfmink_functionals w;
    surfmink_middle middle;
    double *length = t->length + t->offset[c], *phase = t->phase + t->offset[c], *lag = t->lag + t->offset[c];
    double g[2] = {1, 0};
    int k, status;
    memset(cell, 0, sizeof *cell);
    memset(&middle, 0, sizeof middle);
    cell->other = PATIC_NONE;
    cell->bad = o.n;
    status = surfmink_measure(&o, 0, NULL, NULL, &w, &cell->bad);
    if (status == SURFMINK_OK) status = surfmink_edges(&o, length, phase, &cell->bad);
    if (status == SURFMINK_OK) status = surfmink_phases(phase, o.n, SURFMINK_CORRECTED, phase);
    if (status == SURFMINK_OK) {
        status = surfmink_director(&o, length, phase, g, 0, lag, &middle);
        if (status == SURFMINK_ZERO_NORMAL) status = SURFMINK_OPPOSITE_NORMALS; /* no corner lacks one: they cancel */
    }
    cell->status = status;
    if (status != SURFMINK_OK) return;
    cell->length = w.length;
    for (k = 0; k < 3; ++k) {
        cell->centre[k] = middle.centre[k];
        cell->normal[k] = middle.normal[k];
        cell->axis[k] = middle.axis[k];
    }
    patic__cross(cell->normal, cell->axis, cell->across);
}

/* --- 2. topology: corners -> vertices ----------------------------------------------------------------------------- */

/* A corner in space; on the sphere, where only directions count, at the radius. */
static inline void patic__point(const patic *t, size_t corner, double x[3])
{
    const double *from = t->all.corner + (t->all.kind == SURFMINK_PLANE ? 2 : 3) * corner;
    double norm;
    x[0] = from[0];
    x[1] = from[1];
    x[2] = t->all.kind == SURFMINK_PLANE ? 0 : from[2];
    if (t->all.kind != SURFMINK_SPHERE) return;
    norm = patic__norm(x);
    x[0] *= t->all.radius / norm;
    x[1] *= t->all.radius / norm;
    x[2] *= t->all.radius / norm;
}

/* The slot where a hash table is searched first. */
static inline size_t patic__slot(const patic *t, uint64_t a, uint64_t b, uint64_t c)
{
    uint64_t h = a * UINT64_C(0x9e3779b97f4a7c15) ^ b * UINT64_C(0xbf58476d1ce4e5b9) ^ c * UINT64_C(0x94d049bb133111eb);
    h = (h ^ (h >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    h = (h ^ (h >> 27)) * UINT64_C(0x94d049bb133111eb);
    return (size_t)(h ^ (h >> 31)) & (t->slots - 1);
}

static inline uint64_t patic__bits(double x)
{
    uint64_t bits;
    x += 0.0; /* no -0 */
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/* Corners that are one have one root: the first of them. */
static inline size_t patic__root(size_t *parent, size_t i)
{
    for (; parent[i] != i; i = parent[i]) parent[i] = parent[parent[i]];
    return i;
}

static inline void patic__unite(size_t *parent, size_t i, size_t j)
{
    i = patic__root(parent, i);
    j = patic__root(parent, j);
    if (i < j)
        parent[j] = i;
    else
        parent[i] = j;
}

/* Unites a corner with all in the box that lie within the tolerance. Returns whether one is the very same point. */
static inline int patic__search_box(patic *t, size_t corner, const double x[3], size_t slot)
{
    size_t other, *next = t->twin;
    double y[3], d;
    int k, same = 0;
    for (other = t->table[slot]; other != PATIC_NONE && !same; other = next[other]) {
        patic__point(t, other, y);
        for (k = 0; k < 3; ++k) y[k] -= x[k];
        d = patic__norm(y);
        if (d <= t->tolerance) patic__unite(t->vertex, corner, other);
        same = d == 0;
    }
    return same;
}

/* Boxes of side `side` hold the corners so far; those within the tolerance lie in up to eight of them, mostly in
   one. */
static inline void patic__weld_corner(patic *t, size_t corner, double side)
{
    double x[3], box[3][2];
    size_t slot[8], tried, home, *next = t->twin;
    int k, i, same = 0, count = 0;
    patic__point(t, corner, x);
    for (k = 0; k < 3; ++k)
        for (i = 0; i < 2; ++i) box[k][i] = floor((x[k] + (i ? t->tolerance : -t->tolerance)) / side);
    for (i = 0; i < 8 && !same; ++i) {
        if ((i & 1 && box[0][0] == box[0][1]) || (i & 2 && box[1][0] == box[1][1]) || (i & 4 && box[2][0] == box[2][1]))
            continue;
        slot[count] = patic__slot(t, patic__bits(box[0][i & 1]), patic__bits(box[1][i >> 1 & 1]),
                                  patic__bits(box[2][i >> 2 & 1]));
        for (tried = 0; tried < (size_t)count && slot[tried] != slot[count]; ++tried) continue;
        if (tried == (size_t)count) same = patic__search_box(t, corner, x, slot[count++]);
    }
    if (same) return; /* who is near to one of them is near to the other */
    home = patic__slot(t, patic__bits(floor(x[0] / side)), patic__bits(floor(x[1] / side)),
                       patic__bits(floor(x[2] / side)));
    next[corner] = t->table[home];
    t->table[home] = corner;
}

/* Corners nearer than the tolerance are one vertex. */
static inline void patic__weld(patic *t, double side)
{
    size_t corners = t->offset[t->cells], i, c;
    for (i = 0; i < t->slots; ++i) t->table[i] = PATIC_NONE;
    for (i = 0; i < corners; ++i) t->vertex[i] = i;
    for (c = 0; c < t->cells; ++c)
        for (i = t->offset[c]; i < t->offset[c + 1] && t->cell[c].status == SURFMINK_OK; ++i)
            patic__weld_corner(t, i, side);
    for (i = 0; i < corners; ++i) t->vertex[i] = patic__root(t->vertex, i);
}

/* --- vertices -> half-edges, twins -------------------------------------------------------------------------------- */

static inline size_t patic__after(const patic *t, size_t h)
{
    size_t c = t->owner[h];
    return h + 1 < t->offset[c + 1] ? h + 1 : t->offset[c];
}

/* The vertex where a half-edge ends. An edge shorter than the tolerance ends where it begins, and counts for
   nothing. */
static inline size_t patic__end(const patic *t, size_t h)
{
    return t->vertex[patic__after(t, h)];
}

static inline int patic__is_edge(const patic *t, size_t h)
{
    return t->vertex[h] != patic__end(t, h);
}

/* The half-edge from vertex a to b that a cell has put into the table, or NONE; *slot is where it is or would be. */
static inline size_t patic__find(const patic *t, size_t a, size_t b, size_t *slot)
{
    size_t h;
    for (*slot = patic__slot(t, a, b, 0);; *slot = (*slot + 1) & (t->slots - 1)) {
        h = t->table[*slot];
        if (h == PATIC_NONE || (t->vertex[h] == a && patic__end(t, h) == b)) return h;
    }
}

/* Does the outline come to no vertex twice? seen[v] is the last cell that came to v. */
static inline int patic__is_simple(const patic *t, size_t c, size_t *seen)
{
    size_t h, vertices = 0;
    for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
        if (!patic__is_edge(t, h)) continue;
        if (seen[t->vertex[h]] == c) return 0;
        seen[t->vertex[h]] = c;
        ++vertices;
    }
    return vertices >= 3;
}

/* May the cell join those before it? It shares no half-edge with them, and every neighbour's normal can be carried to
   its own. */
static inline int patic__fits(const patic *t, size_t c, size_t *other)
{
    const double opposite = 1e-12; /* as in director.h: normals opposite within 1e-6 rad */
    size_t h, slot, twin;
    double sum[3];
    int k;
    for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
        if (!patic__is_edge(t, h)) continue;
        *other = patic__find(t, t->vertex[h], patic__end(t, h), &slot);
        if (*other != PATIC_NONE) return PATIC_OVERLAPS;
    }
    for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
        if (!patic__is_edge(t, h)) continue;
        twin = patic__find(t, patic__end(t, h), t->vertex[h], &slot);
        if (twin == PATIC_NONE) continue;
        for (k = 0; k < 3; ++k) sum[k] = t->cell[t->owner[twin]].normal[k] + t->cell[c].normal[k];
        *other = twin;
        if (!(patic__dot(sum, sum) > opposite)) return SURFMINK_OPPOSITE_NORMALS;
    }
    *other = PATIC_NONE;
    return SURFMINK_OK;
}

static inline void patic__join(patic *t, size_t c)
{
    size_t h, slot, twin;
    for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
        if (!patic__is_edge(t, h)) continue;
        patic__find(t, t->vertex[h], patic__end(t, h), &slot);
        t->table[slot] = h;
        twin = patic__find(t, patic__end(t, h), t->vertex[h], &slot);
        if (twin == PATIC_NONE) continue;
        t->twin[h] = twin;
        t->twin[twin] = h;
        ++t->shared;
    }
}

/* Cells join in the order of the file: of two that cannot both be there the first one stays. */
static inline void patic__join_all(patic *t)
{
    size_t corners = t->offset[t->cells], i, c, other, *seen = t->loop_at;
    for (i = 0; i < t->slots; ++i) t->table[i] = PATIC_NONE;
    for (i = 0; i < corners; ++i) t->twin[i] = seen[i] = PATIC_NONE;
    for (c = 0; c < t->cells; ++c) {
        patic_cell *cell = &t->cell[c];
        if (cell->status != SURFMINK_OK) continue;
        if (!patic__is_simple(t, c, seen))
            cell->status = PATIC_MEETS_ITSELF;
        else if ((cell->status = patic__fits(t, c, &other)) != SURFMINK_OK)
            cell->other = t->owner[other];
        else {
            patic__join(t, c);
            ++t->measured;
        }
    }
}

/* --- neighbours, components, loops -------------------------------------------------------------------------------- */

static inline void patic__find_neighbours(patic *t)
{
    size_t c, h, j, used = 0, pairs = 0;
    double sum = 0;
    for (c = 0; c < t->cells; ++c) t->mark[c] = PATIC_NONE;
    for (c = 0; c < t->cells; ++c) {
        patic_cell *cell = &t->cell[c];
        t->neighbour_at[c] = used;
        for (h = t->offset[c]; h < t->offset[c + 1] && cell->status == SURFMINK_OK; ++h) {
            if (!patic__is_edge(t, h)) continue;
            if (t->twin[h] == PATIC_NONE) {
                cell->boundary = 1;
                continue;
            }
            j = t->owner[t->twin[h]];
            if (t->mark[j] == c) continue;
            t->mark[j] = c;
            t->neighbour[used++] = j;
            if (j < c) continue;
            sum += patic__distance(cell, &t->cell[j]);
            ++pairs;
        }
        cell->neighbours = used - t->neighbour_at[c];
        if (cell->status == SURFMINK_OK && cell->neighbours == 0) ++t->isolated;
    }
    t->neighbour_at[t->cells] = used;
    t->spacing = pairs > 0 ? sum / (double)pairs : 0;
}

static inline void patic__find_components(patic *t)
{
    size_t c, i, k, begun, filled;
    for (c = 0; c < t->cells; ++c) t->cell[c].component = PATIC_NONE;
    for (c = 0; c < t->cells; ++c) {
        patic_component *component = &t->component[t->components];
        if (t->cell[c].status != SURFMINK_OK || t->cell[c].component != PATIC_NONE) continue;
        memset(component, 0, sizeof *component);
        t->queue[0] = c;
        t->cell[c].component = t->components;
        for (begun = 0, filled = 1; begun < filled; ++begun) {
            i = t->queue[begun];
            for (k = t->neighbour_at[i]; k < t->neighbour_at[i + 1]; ++k) {
                if (t->cell[t->neighbour[k]].component != PATIC_NONE) continue;
                t->cell[t->neighbour[k]].component = t->components;
                t->queue[filled++] = t->neighbour[k];
            }
        }
        component->cells = filled;
        component->chi = (long)filled;
        ++t->components;
    }
}

/* The half-edge across which a loop leaves a cell that it has entered across h: the next with a neighbour. If that is
   the very next one, the loop stays at its vertex. */
static inline size_t patic__onward(const patic *t, size_t h, int *stays)
{
    for (*stays = 1;; *stays = 0) {
        do h = patic__after(t, h);
        while (!patic__is_edge(t, h));
        if (t->twin[h] != PATIC_NONE) return h;
    }
}

/* The half-edge after h in its loop. */
static inline size_t patic__next_in_loop(const patic *t, size_t h)
{
    int stays;
    return patic__onward(t, t->twin[h], &stays);
}

static inline void patic__add_loop(patic *t, size_t first, size_t steps, int closed)
{
    patic_loop *loop = &t->loop[t->loops++];
    patic_component *component = &t->component[t->cell[t->owner[first]].component];
    memset(loop, 0, sizeof *loop);
    loop->first = first;
    loop->steps = steps;
    loop->closed = closed;
    t->faces += closed ? 1 : 0;
    t->walks += closed ? 0 : 1;
    component->walks += closed ? 0 : 1;
    component->chi += closed;
}

static inline void patic__find_loops(patic *t)
{
    size_t h, c, steps, corners = t->offset[t->cells];
    int closed, stays;
    for (h = 0; h < corners; ++h) t->loop_at[h] = PATIC_NONE;
    for (c = 0; c < t->cells; ++c) {
        if (t->cell[c].status != SURFMINK_OK) continue;
        if (t->cell[c].neighbours == 0) patic__add_loop(t, t->offset[c], 0, 0);
        for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
            size_t at = h;
            if (t->twin[h] == PATIC_NONE) continue;
            if (c < t->owner[t->twin[h]]) --t->component[t->cell[c].component].chi;
            if (t->loop_at[h] != PATIC_NONE) continue;
            for (steps = 0, closed = 1; steps == 0 || at != h; ++steps) {
                t->loop_at[at] = t->loops;
                at = patic__onward(t, t->twin[at], &stays);
                if (!stays) closed = 0;
            }
            patic__add_loop(t, h, steps, closed);
        }
    }
    for (c = 0; c < t->components; ++c) t->chi += t->component[c].chi;
}

/* Measures all cells and finds their topology.
   all                plane, sphere or embedded: the corners of all outlines, one outline after the other (n is not
   used)
   offset    cells+1  outline c has the corners offset[c] .. offset[c + 1] - 1
   max_rank           the largest p that will be asked for
   weld               corners nearer than this are one; negative: 1e-6 of the mean edge; 0: only the very same points
   memory             patic_bytes(offset, cells, max_rank) bytes; it has to live as long as *t
   returns            SURFMINK_OK, or BAD_ARGUMENT: offsets fall, weld is NaN or infinite, a surface by callbacks.
   What is
                      wrong with single cells is in t->cell[c].status
   Cost: O(corners) time, but for tolerances so large that many corners lie within them. */
static inline int patic_build(patic *t, const surfmink_outline *all, const size_t *offset, size_t cells, int max_rank,
                              double weld, void *memory)
{
    const double usual = 1e-6,
                 boxes = 4; /* of the mean edge; of the tolerance: few corners near a wall, few in a box */
    size_t c, h, edges = 0, begin = (16 - (size_t)((uintptr_t)memory % 16)) % 16;
    double length = 0, side;
    memset(t, 0, sizeof *t);
    if (all->kind == SURFMINK_SURFACE || max_rank < 0 || !(weld - weld == 0)) return SURFMINK_BAD_ARGUMENT;
    if (patic_bytes(offset, cells, max_rank) == 0) return SURFMINK_BAD_ARGUMENT;
    t->all = *all;
    t->offset = offset;
    t->cells = cells;
    t->max_rank = max_rank;
    patic__lay_out(t, (char *)memory + begin);
    for (c = 0; c < cells; ++c) {
        for (h = offset[c]; h < offset[c + 1]; ++h) t->owner[h] = c;
        patic__measure_cell(t, c);
        if (t->cell[c].status != SURFMINK_OK) continue;
        edges += offset[c + 1] - offset[c]; /* the mean so far, for the sum might overflow */
        length += (t->cell[c].length - (double)(offset[c + 1] - offset[c]) * length) / (double)edges;
    }
    t->tolerance = weld >= 0 ? weld : usual * length;
    side = t->tolerance > 0 ? boxes * t->tolerance : length > 0 ? length : 1;
    patic__weld(t, side);
    patic__join_all(t);
    patic__find_neighbours(t);
    patic__find_components(t);
    patic__find_loops(t);
    return SURFMINK_OK;
}

/* --- 3. field: outlines -> z -------------------------------------------------------------------------------------- */

/* Below this mu_p, a coherence and an order are rounding noise, and a cell has no direction. */
static const double patic__no_direction = 1e-12;

static inline int patic__is_directed(const double *z, size_t c)
{
    return z[2 * c] != 0 || z[2 * c + 1] != 0;
}

/* z of all cells: mu_p exp(i p psi). 0 of refused cells, and of those without direction.
   p                  1 .. max_rank
   z         2 cells  out
   mu          cells  out: mu_p, with a direction or without; or NULL
   Errors: BAD_ARGUMENT. Cost: O(corners p), and a sine and a cosine an edge. */
static inline int patic_field(patic *t, int p, double *z, double *mu_p)
{
    size_t c;
    if (p < 1 || p > t->max_rank) return SURFMINK_BAD_ARGUMENT;
    for (c = 0; c < t->cells; ++c) {
        size_t at = t->offset[c], n = t->offset[c + 1] - at;
        double *g = t->scratch, *mean = g + 2 * ((size_t)p + 1), *sum = g + 2 * (size_t)p,
               *sharp = mean + 2 * (size_t)p;
        double mu, angle;
        z[2 * c] = z[2 * c + 1] = 0;
        if (mu_p) mu_p[c] = 0;
        if (t->cell[c].status != SURFMINK_OK) continue;
        if (surfmink_irreducible(t->length + at, t->phase + at, n, p, g) != SURFMINK_OK ||
            surfmink_irreducible(t->length + at, t->lag + at, n, p, mean) != SURFMINK_OK)
            continue; /* never: they have been measured */
        mu = hypot(sum[0], sum[1]) / g[0];
        if (mu_p) mu_p[c] = mu;
        if (!(mu >= patic__no_direction && hypot(sharp[0], sharp[1]) >= patic__no_direction * g[0])) continue;
        angle = atan2(sum[1], sum[0]) + atan2(sharp[1], sharp[0]);
        z[2 * c] = mu * cos(angle);
        z[2 * c + 1] = mu * sin(angle);
    }
    return SURFMINK_OK;
}

/* The direction of z as a unit vector in space, n = 0 of p; returns 0 and leaves it if there is none. */
static inline int patic_direction(const patic *t, int p, const double *z, size_t c, double direction[3])
{
    const patic_cell *cell = &t->cell[c];
    double psi;
    int k;
    if (!patic__is_directed(z, c)) return 0;
    psi = atan2(z[2 * c + 1], z[2 * c]) / p;
    for (k = 0; k < 3; ++k) direction[k] = cos(psi) * cell->axis[k] + sin(psi) * cell->across[k];
    return 1;
}

/* --- 4. coarse field: z -> Z -------------------------------------------------------------------------------------- */

/* A distance that equals a radius or the end of a bin up to rounding, as in a regular lattice, lies on this side. */
static const double patic__rounding = 1e-9;

/* Z_i: the mean of z, carried to i by one smallest rotation each, over the cells that are reached from i over
   neighbours without going farther than `radius` or to where normals are 90 degrees or more from that of i; weighted
   by length.
   radius             >= 0; 0 gives z again
   z, coarse 2 cells  in, out; not the same array
   Errors: BAD_ARGUMENT. Cost: O(cells x cells in a ball). */
static inline int patic_coarsen(patic *t, int p, double radius, const double *z, double *coarse)
{
    size_t c, i, j, k, begun, filled;
    if (p < 1 || !(radius >= 0)) return SURFMINK_BAD_ARGUMENT;
    if (!(radius > 0)) {
        memcpy(coarse, z, 2 * t->cells * sizeof *z);
        return SURFMINK_OK;
    }
    for (c = 0; c < t->cells; ++c) t->mark[c] = PATIC_NONE;
    for (c = 0; c < t->cells; ++c) {
        const patic_cell *cell = &t->cell[c];
        double re = 0, im = 0, weight = 0, carried[2];
        coarse[2 * c] = coarse[2 * c + 1] = 0;
        if (cell->status != SURFMINK_OK) continue;
        t->queue[0] = c;
        t->mark[c] = c;
        for (begun = 0, filled = 1; begun < filled; ++begun) {
            i = t->queue[begun];
            weight += t->cell[i].length;
            patic__carry_field(&t->cell[i], cell, p, z + 2 * i, carried);
            re += t->cell[i].length * carried[0];
            im += t->cell[i].length * carried[1];
            for (k = t->neighbour_at[i]; k < t->neighbour_at[i + 1]; ++k) {
                j = t->neighbour[k];
                if (t->mark[j] == c) continue;
                t->mark[j] = c;
                if (!(patic__dot(cell->normal, t->cell[j].normal) > 0)) continue;
                if (!(patic__distance(cell, &t->cell[j]) <= radius * (1 + patic__rounding))) continue;
                t->queue[filled++] = j;
            }
        }
        if (!(hypot(re, im) >= patic__no_direction * weight)) continue;
        coarse[2 * c] = re / weight;
        coarse[2 * c + 1] = im / weight;
    }
    return SURFMINK_OK;
}

/* --- 5. charges: z -> steps -> charge of each loop -> defects ----------------------------------------------------- */

/* Into (-pi, pi]. A tie, up to rounding, counts as +pi. */
static inline double patic__wrap(double angle)
{
    const double tie =
        1e-10; /* an angle p psi is good to 1e-14 over mu, which is at least 1e-4 where steps mean much */
    angle = remainder(angle, 2 * patic__pi);
    return angle <= -patic__pi + tie ? angle + 2 * patic__pi : angle;
}

static inline double patic__argument(const double *z, size_t c)
{
    return patic__is_directed(z, c) ? atan2(z[2 * c + 1], z[2 * c]) : 0;
}

/* w: by how much p psi turns from cell to cell, for each pair once, seen from the one that comes first. */
static inline void patic__find_steps(patic *t, int p, const double *z)
{
    size_t h, i, j, corners = t->offset[t->cells];
    for (h = 0; h < corners; ++h) {
        if (t->twin[h] == PATIC_NONE) continue;
        i = t->owner[h];
        j = t->owner[t->twin[h]];
        if (i > j) continue;
        t->step[h] =
            patic__wrap(patic__argument(z, j) - patic__argument(z, i) - p * patic__carried(&t->cell[i], &t->cell[j]));
        t->step[t->twin[h]] = -t->step[h];
    }
}

/* Omega: the signed area that the normals of the cells of a dual face enclose on the unit sphere, a fan about their
   sum. Loops run clockwise round their vertex: that is minus the area of the fan in their order. */
static inline double patic__gauss_image(const patic *t, const patic_loop *loop)
{
    double pole[3] = {0, 0, 0}, norm, area = 0, ab[3];
    const double *a, *b = t->cell[t->owner[loop->first]].normal;
    size_t h = loop->first, i;
    int k;
    for (i = 0; i < loop->steps; ++i, h = patic__next_in_loop(t, h))
        for (k = 0; k < 3; ++k) pole[k] += t->cell[t->owner[h]].normal[k];
    norm = patic__norm(pole);
    for (k = 0; k < 3; ++k) pole[k] = norm > 0 ? pole[k] / norm : b[k];
    for (i = 0; i < loop->steps; ++i) {
        a = b;
        h = patic__next_in_loop(t, h);
        b = t->cell[t->owner[h]].normal;
        patic__cross(a, b, ab);
        area -= 2 * atan2(patic__dot(pole, ab), 1 + patic__dot(pole, a) + patic__dot(a, b) + patic__dot(b, pole));
    }
    return area;
}

/* Do these edges of a cell begin and end one border with a neighbour, with no other cell and no gap in between? */
static inline int patic__is_border(const patic *t, size_t first, size_t last)
{
    while (first != last) {
        size_t next = patic__after(t, first);
        if (t->twin[next] == PATIC_NONE || patic__after(t, t->twin[next]) != t->twin[first]) return 0;
        first = next;
    }
    return 1;
}

/* The angle at a cell that a boundary walk enters across `in` (of this cell) and leaves across `out`: from where it
   came, counter-clockwise, to where it goes; in (0, 2 pi]. Back into the same neighbour the chord is the same. It goes
   all round where both edges are of one border; where the two cells enclose a gap between two borders, the middles of
   the two edges tell whether it is all or nothing. */
static inline double patic__turn(const patic *t, size_t in, size_t out)
{
    const patic_cell *cell = &t->cell[t->owner[in]];
    size_t from = t->owner[t->twin[in]], to = t->owner[t->twin[out]];
    double u[3], v[3], x[3], y[3], angle;
    int k;
    if (patic__is_border(t, in, out) || patic__is_border(t, out, in)) return 2 * patic__pi;
    for (k = 0; k < 3; ++k) {
        u[k] = t->cell[from].centre[k] - cell->centre[k];
        v[k] = t->cell[to].centre[k] - cell->centre[k];
    }
    if (from == to) {
        patic__point(t, in, u);
        patic__point(t, patic__after(t, in), x);
        patic__point(t, out, v);
        patic__point(t, patic__after(t, out), y);
        for (k = 0; k < 3; ++k) {
            u[k] = (u[k] + x[k]) / 2 - cell->centre[k];
            v[k] = (v[k] + y[k]) / 2 - cell->centre[k];
        }
    }
    angle = patic__angle(cell, v) - patic__angle(cell, u);
    if (!(angle > 0)) angle += 2 * patic__pi;
    if (from == to) return angle < patic__pi ? 0 : 2 * patic__pi;
    return angle;
}

/* 2 pi p b of a boundary walk. */
static inline double patic__walk(const patic *t, int p, const patic_loop *loop)
{
    double chord[3], sum = 0, turn;
    size_t h = loop->first, i, onward;
    int k;
    if (loop->steps == 0) return 2 * patic__pi * p; /* an isolated cell: a disc */
    for (i = 0; i < loop->steps; ++i, h = onward) {
        const patic_cell *from = &t->cell[t->owner[h]], *to = &t->cell[t->owner[t->twin[h]]];
        for (k = 0; k < 3; ++k) chord[k] = to->centre[k] - from->centre[k];
        onward = patic__next_in_loop(t, h);
        turn = patic__angle(to, chord) - patic__angle(from, chord) - patic__carried(from, to);
        sum += p * (remainder(turn, 2 * patic__pi) + patic__turn(t, t->twin[h], onward) - patic__pi) - t->step[h];
    }
    return sum;
}

/* Charges of a field: t->loop[].k, margin, order, t->component[].charge, boundary, t->residual.
   z         2 cells  of patic_field or patic_coarsen, or any other field in the frames of the cells
   Errors: BAD_ARGUMENT, NOT_FINITE. Cost: O(corners). */
static inline int patic_charges(patic *t, int p, const double *z)
{
    size_t l, h, i, c;
    if (p < 1) return SURFMINK_BAD_ARGUMENT;
    for (i = 0; i < 2 * t->cells; ++i)
        if (!(z[i] - z[i] == 0)) return SURFMINK_NOT_FINITE;
    patic__find_steps(t, p, z);
    t->residual = 0;
    for (c = 0; c < t->components; ++c) t->component[c].charge = t->component[c].boundary = 0;
    for (l = 0; l < t->loops; ++l) {
        patic_loop *loop = &t->loop[l];
        double sum = 0, most = 0, exact, modulus;
        loop->order = hypot(z[2 * t->owner[loop->first]], z[2 * t->owner[loop->first] + 1]);
        for (i = 0, h = loop->first; i < loop->steps; ++i, h = patic__next_in_loop(t, h)) {
            sum -= t->step[h]; /* clockwise */
            most = fmax(most, fabs(t->step[h]));
            modulus = hypot(z[2 * t->owner[h]], z[2 * t->owner[h] + 1]);
            loop->order = fmin(loop->order, modulus);
        }
        loop->margin = fmax(0, 1 - most / patic__pi);
        if (loop->closed)
            exact = loop->steps < 3 ? 0 : (sum + p * patic__gauss_image(t, loop)) / (2 * patic__pi);
        else
            exact = patic__walk(t, p, loop) / (2 * patic__pi);
        loop->k = lround(exact);
        t->residual = fmax(t->residual, fabs(exact - (double)loop->k));
        c = t->cell[t->owner[loop->first]].component;
        if (loop->closed)
            t->component[c].charge += loop->k;
        else
            t->component[c].boundary += loop->k;
    }
    return SURFMINK_OK;
}

/* Cells without direction that touch, at an edge or at a corner with cells all round, are one core: its charge is that
   of all its corners, for the arbitrary directions in it cancel. queue[c] is then the first cell of the core of c, and
   NONE for a cell with a direction. */
static inline void patic__find_cores(patic *t, const double *z)
{
    size_t c, h, l, i, k, first, *core = t->queue;
    for (c = 0; c < t->cells; ++c)
        core[c] = t->cell[c].status == SURFMINK_OK && !patic__is_directed(z, c) ? c : PATIC_NONE;
    for (c = 0; c < t->cells; ++c) {
        if (core[c] == PATIC_NONE) continue;
        for (k = t->neighbour_at[c]; k < t->neighbour_at[c + 1]; ++k)
            if (core[t->neighbour[k]] != PATIC_NONE) patic__unite(core, c, t->neighbour[k]);
    }
    for (l = 0; l < t->loops; ++l) {
        if (!t->loop[l].closed) continue;
        for (first = PATIC_NONE, i = 0, h = t->loop[l].first; i < t->loop[l].steps;
             ++i, h = patic__next_in_loop(t, h)) {
            c = t->owner[h];
            if (core[c] == PATIC_NONE) continue;
            if (first != PATIC_NONE)
                patic__unite(core, first, c);
            else
                first = c;
        }
    }
    for (c = 0; c < t->cells; ++c)
        if (core[c] != PATIC_NONE) core[c] = patic__root(core, c);
}

/* The core that a loop touches, or NONE. */
static inline size_t patic__core_at(const patic *t, const patic_loop *loop)
{
    size_t i, h = loop->first;
    for (i = 0; i < loop->steps; ++i, h = patic__next_in_loop(t, h))
        if (t->queue[t->owner[h]] != PATIC_NONE) return t->queue[t->owner[h]];
    return PATIC_NONE;
}

static inline patic_defect *patic__add_defect(patic *t, size_t loop, size_t core)
{
    patic_defect *d = &t->defect[t->defects++];
    memset(d, 0, sizeof *d);
    d->loop = loop;
    d->core = core;
    d->margin = 1;
    d->order = HUGE_VAL;
    return d;
}

/* A corner with a charge, without a core. */
static inline void patic__add_corner(patic *t, size_t l)
{
    const patic_loop *loop = &t->loop[l];
    patic_defect *d = patic__add_defect(t, l, PATIC_NONE);
    double x[3];
    size_t i, h = loop->first;
    int k;
    d->k = loop->k;
    d->margin = loop->margin;
    d->order = loop->order;
    for (i = 0; i < loop->steps; ++i, h = patic__next_in_loop(t, h)) {
        patic__point(t, h, x);
        for (k = 0; k < 3; ++k) d->x[k] += x[k] / (double)loop->steps;
    }
}

/* What a dual face adds to the defect of its core: its charge, and the outermost steps, whose other side is no face of
   the core. */
static inline void patic__add_to_core(const patic *t, const double *z, const patic_loop *loop, patic_defect *d)
{
    size_t i, h = loop->first, c, other;
    d->k += loop->k;
    for (i = 0; i < loop->steps; ++i, h = patic__next_in_loop(t, h)) {
        c = t->owner[h];
        if (t->queue[c] == PATIC_NONE) d->order = fmin(d->order, hypot(z[2 * c], z[2 * c + 1]));
        other = patic__core_at(t, &t->loop[t->loop_at[t->twin[h]]]);
        if (other != d->core) d->margin = fmin(d->margin, fmax(0, 1 - fabs(t->step[h]) / patic__pi));
    }
}

/* A boundary walk through a core: the arbitrary directions there decide how much of the charge is its own, so the core
   has no margin. */
static inline void patic__walk_through_cores(patic *t, const patic_loop *walk)
{
    size_t i, h = walk->first;
    for (i = 0; i < walk->steps; ++i, h = patic__next_in_loop(t, h))
        if (t->queue[t->owner[h]] != PATIC_NONE) t->defect[t->mark[t->queue[t->owner[h]]]].margin = 0;
}

/* Finds the defects of the field that patic_charges has seen: t->defect, with charges that are not 0.
   z                  the field of patic_charges
   returns            how many */
static inline size_t patic_defects(patic *t, const double *z)
{
    size_t l, c, core, kept, i;
    patic_defect *d;
    int k;
    t->defects = 0;
    patic__find_cores(t, z);
    for (c = 0; c < t->cells; ++c) {
        t->mark[c] = t->defects;
        if (t->queue[c] == c) patic__add_defect(t, PATIC_NONE, c);
    }
    for (l = 0; l < t->loops; ++l) {
        core = patic__core_at(t, &t->loop[l]);
        if (!t->loop[l].closed)
            patic__walk_through_cores(t, &t->loop[l]);
        else if (core != PATIC_NONE)
            patic__add_to_core(t, z, &t->loop[l], &t->defect[t->mark[core]]);
        else if (t->loop[l].k != 0)
            patic__add_corner(t, l);
    }
    for (c = 0; c < t->cells; ++c) { /* centres of cores: loop counts their cells for now */
        if (t->queue[c] == PATIC_NONE) continue;
        d = &t->defect[t->mark[t->queue[c]]];
        d->loop = d->loop == PATIC_NONE ? 1 : d->loop + 1;
        for (k = 0; k < 3; ++k) d->x[k] += (t->cell[c].centre[k] - d->x[k]) / (double)d->loop;
    }
    for (kept = 0, i = 0; i < t->defects; ++i) {
        if (t->defect[i].core != PATIC_NONE) t->defect[i].loop = PATIC_NONE;
        if (t->defect[i].order > 1e300) t->defect[i].order = 0; /* a core with nothing round it */
        if (t->defect[i].k != 0) t->defect[kept++] = t->defect[i];
    }
    return t->defects = kept;
}

/* Lists the cells of the loops round one cell, and its neighbours, that belong to the core (or to none) and are not
   listed yet. */
static inline size_t patic__list_round(patic *t, size_t c, size_t core, size_t *cells, size_t count)
{
    size_t h, at, i, other;
    for (h = t->offset[c]; h < t->offset[c + 1]; ++h) {
        const patic_loop *loop;
        if (t->twin[h] == PATIC_NONE) continue;
        loop = &t->loop[t->loop_at[h]];
        for (i = 0, at = t->twin[h]; i < (loop->closed ? loop->steps - 1 : 1); ++i) {
            other = t->owner[at];
            if (t->queue[other] == core && t->mark[other] != PATIC_NONE) {
                t->mark[other] = PATIC_NONE;
                cells[count++] = other;
            }
            at = t->twin[patic__next_in_loop(t, t->twin[at])];
        }
    }
    return count;
}

/* The cells round a defect, those of a core first, counter-clockwise round a corner; returns how many.
   d                  of the last patic_defects
   cells              out: room for all cells of the tissue */
static inline size_t patic_around(patic *t, const patic_defect *d, size_t *cells)
{
    size_t i, h, count = 0, inner;
    if (d->core == PATIC_NONE) {
        count = t->loop[d->loop].steps;
        for (i = count, h = t->loop[d->loop].first; i > 0; h = patic__next_in_loop(t, h)) cells[--i] = t->owner[h];
        return count;
    }
    t->mark[d->core] = PATIC_NONE;
    cells[count++] = d->core;
    for (i = 0; i < count; ++i) count = patic__list_round(t, cells[i], d->core, cells, count);
    for (inner = count, i = 0; i < inner; ++i) count = patic__list_round(t, cells[i], PATIC_NONE, cells, count);
    for (i = 0; i < count; ++i) t->mark[cells[i]] = 0;
    return count;
}

/* --- 6. order: z -> G(r) ------------------------------------------------------------------------------------------ */

typedef struct patic_bin {
    size_t pairs;
    double sum, weight; /* of Re(conj z_i T z_j), of |z_i| |z_j|: G is their ratio, and 0 where weight is 0 */
} patic_bin;

/* G in bins of a width, over the pairs of cells whose normals are less than 90 degrees apart, wherever they are; T is
   the smallest rotation from j to i. Bin b holds distances from b width on, up to (b + 1) width.
   width              > 0, as t->spacing
   bin       bins     out
   returns            the number of bins that all pairs would need: those farther apart are left out. With bins = 0
                      nothing else is found, in a third of the time. Cost: O(cells^2). */
static inline size_t patic_correlation(const patic *t, int p, const double *z, double width, size_t bins,
                                       patic_bin *bin)
{
    const double most = 1e15; /* bins: more than a size_t has everywhere, less than a double counts */
    double carried[2], place;
    size_t i, j, b, need = 0;
    for (b = 0; b < bins; ++b) {
        bin[b].pairs = 0;
        bin[b].sum = bin[b].weight = 0;
    }
    for (i = 0; i < t->cells; ++i) {
        const patic_cell *cell = &t->cell[i];
        double modulus = hypot(z[2 * i], z[2 * i + 1]);
        if (cell->status != SURFMINK_OK) continue;
        for (j = i + 1; j < t->cells; ++j) {
            if (t->cell[j].status != SURFMINK_OK || !(patic__dot(cell->normal, t->cell[j].normal) > 0)) continue;
            place = patic__distance(cell, &t->cell[j]) / width * (1 + patic__rounding);
            b = (size_t)(place < most ? place : most);
            if (b >= need) need = b + 1;
            if (b >= bins) continue;
            patic__carry_field(&t->cell[j], cell, p, z + 2 * j, carried);
            ++bin[b].pairs;
            bin[b].sum += z[2 * i] * carried[0] + z[2 * i + 1] * carried[1];
            bin[b].weight += modulus * sqrt(z[2 * j] * z[2 * j] + z[2 * j + 1] * z[2 * j + 1]);
        }
    }
    return need;
}

#endif
