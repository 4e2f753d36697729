/* contour.h - the loops of a level set: their corners, and what they enclose - MIT or public domain, as you like (see
   surfmink.h)

   What mesh.h (triangles) and ../image/grey.h (squares between pixels) have in common when they cut a surface cell by
   cell. C99 and C++, only libc and libm.

   CONVENTIONS
     inside      CONTOUR_BELOW: where value < level; CONTOUR_ABOVE: where value >= level. The two make up the surface.
     loop        has the inside on its left, seen from outside
     open curve  ends at the boundary of the surface. It is left out; with CONTOUR_CLOSE it is closed along the
                 boundary, and what lies inside of the boundary without any curve has it as a loop
     part        a connected piece of the inside, or of the outside. Two pieces that touch in a point are two parts */
#ifndef SURFMINK_CONTOUR_H
#define SURFMINK_CONTOUR_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum contour_how {
    CONTOUR_BELOW = 0,
    CONTOUR_ABOVE = 1,
    CONTOUR_CLOSE = 2, /* add it: open curves are closed */
    CONTOUR_PARTS = 4  /* add it: fills in part and enclosed */
};

#define CONTOUR_NONE SIZE_MAX

/* The loops of one level. */
typedef struct contours {
    size_t loops;
    size_t *start;    /* loops + 1: loop k has the corners start[k] .. start[k + 1] - 1, at least 3 */
    double *corner;   /* 3 per corner */
    double *normal;   /* 3 per corner, of unit length */
    double area;      /* W_0 of the inside, open curves or not */
    size_t open;      /* curves that end at the boundary: left out */
    size_t closed;    /* curves that end at the boundary: closed along it */
    size_t collapsed; /* loops around a point or a ridge exactly at the level, no wider than rounding: left out */
    size_t *part;     /* 1 per loop: the part on its left */
    double *enclosed; /* 2 per loop: the areas of the surface on its left and on its right, with all that lies beyond
                         other loops there; NaN if the loop does not separate the two */
} contours;

static inline void contours_free(contours *c)
{
    free(c->start);
    free(c->corner);
    free(c->normal);
    free(c->part);
    free(c->enclosed);
    memset(c, 0, sizeof *c);
}

/* Turns a loop round. */
static inline void contour_reverse(contours *c, size_t loop)
{
    size_t i = c->start[loop], j = c->start[loop + 1] - 1;
    int k;
    for (; i < j; ++i, --j)
        for (k = 0; k < 3; ++k) {
            double *x = c->corner + k, *n = c->normal + k, swap = x[3 * i];
            x[3 * i] = x[3 * j], x[3 * j] = swap;
            swap = n[3 * i], n[3 * i] = n[3 * j], n[3 * j] = swap;
        }
}

/* Adds to a sum that remembers its rounding error: sum[0] + sum[1] is right to the last digit for millions of terms. */
static inline void contour_sum(double sum[2], double x)
{
    double total = sum[0] + x;
    sum[1] += fabs(sum[0]) >= fabs(x) ? (sum[0] - total) + x : (x - total) + sum[0];
    sum[0] = total;
}

/* --- parts -------------------------------------------------------------------------------------------------------- */

/* Which part the corners of cells belong to. */
typedef struct contour_parts {
    uint32_t *part; /* each corner: another of its part, until contour_number; then the number of the part */
    size_t corners, count;
    double *area; /* each part; from contour_number, to be summed up by the caller */
} contour_parts;

static inline void contour_parts_free(contour_parts *p)
{
    free(p->part);
    free(p->area);
    memset(p, 0, sizeof *p);
}

/* Every corner is a part of its own; fewer than 2^32. Returns 0 if there is no memory. */
static inline int contour_parts_begin(contour_parts *p, size_t corners)
{
    size_t k;
    memset(p, 0, sizeof *p);
    p->corners = corners;
    p->part = (uint32_t *)malloc((corners + 1) * sizeof *p->part);
    for (k = 0; p->part && k < corners; ++k) p->part[k] = (uint32_t)k;
    return p->part != NULL;
}

/* The one that stands for all that are united with k: the smallest. The way to it is halved. */
static inline uint32_t contour__find(uint32_t *set, size_t k)
{
    uint32_t at = (uint32_t)k;
    while (set[at] != at) at = set[at] = set[set[at]];
    return at;
}

static inline void contour_unite(uint32_t *set, size_t a, size_t b)
{
    uint32_t x = contour__find(set, a), y = contour__find(set, b);
    set[x > y ? x : y] = x > y ? y : x;
}

/* Numbers the parts in the order of their first corners. Returns 0 if there is no memory. */
static inline int contour_number(contour_parts *p)
{
    size_t k;
    for (k = 0; k < p->corners; ++k) contour__find(p->part, k);
    for (k = 0; k < p->corners; ++k) /* what stands for k is k, or comes before it and has its number */
        p->part[k] = p->part[k] == k ? (uint32_t)p->count++ : p->part[p->part[k]];
    p->area = (double *)calloc(p->count + 1, sizeof *p->area);
    return p->area != NULL;
}

/* --- corners of loops --------------------------------------------------------------------------------------------- */

/* A stretch of a curve between two parts. */
typedef struct contour__piece {
    size_t left, right; /* parts; right is CONTOUR_NONE beyond the boundary */
    size_t loop;        /* CONTOUR_NONE if the curve is left out */
} contour__piece;

/* Loops under construction. */
typedef struct contour_trace {
    contours *out;
    double same;                         /* corners no farther apart are one */
    size_t begin, used, corners, starts; /* corners of the loop at hand: begin .. used - 1; and rooms */
    contour__piece *piece;
    size_t first_piece, pieces, piece_room; /* the loop at hand has the pieces from the first one on */
} contour_trace;

static inline int contour_trace_begin(contour_trace *t, contours *out, double same)
{
    memset(t, 0, sizeof *t);
    memset(out, 0, sizeof *out);
    t->out = out;
    t->same = same;
    t->starts = 16;
    out->start = (size_t *)calloc(t->starts, sizeof *out->start);
    return out->start != NULL;
}

static inline int contour__is_same(const contour_trace *t, size_t i, size_t j)
{
    const double *x = t->out->corner + 3 * i, *y = t->out->corner + 3 * j;
    double d[3];
    int c;
    for (c = 0; c < 3; ++c) d[c] = x[c] - y[c];
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) <= t->same;
}

/* Appends a corner. Round a point exactly at the level several edges are cut in the same place: only one stays. Along a
   ridge exactly at the level a loop would run there and back: neither stays. Returns 0 if there is no memory. */
static inline int contour_add(contour_trace *t, const double x[3], const double n[3])
{
    if (t->used == t->corners) {
        size_t room = t->corners ? 2 * t->corners : 256;
        double *corner = (double *)realloc(t->out->corner, 3 * room * sizeof *corner), *normal = NULL;
        if (corner) t->out->corner = corner;
        if (corner) normal = (double *)realloc(t->out->normal, 3 * room * sizeof *normal);
        if (!normal) return 0;
        t->out->normal = normal;
        t->corners = room;
    }
    memcpy(t->out->corner + 3 * t->used, x, 3 * sizeof *x);
    memcpy(t->out->normal + 3 * t->used, n, 3 * sizeof *n);
    if (t->used > t->begin && contour__is_same(t, t->used - 1, t->used)) return 1;
    if (t->used > t->begin + 1 && contour__is_same(t, t->used - 2, t->used)) {
        --t->used;
        return 1;
    }
    ++t->used;
    return 1;
}

/* The curve at hand runs between these parts. Returns 0 if there is no memory. */
static inline int contour_between(contour_trace *t, size_t left, size_t right)
{
    contour__piece *piece;
    if (t->pieces == t->piece_room) {
        size_t room = t->piece_room ? 2 * t->piece_room : 64;
        piece = (contour__piece *)realloc(t->piece, room * sizeof *piece);
        if (!piece) return 0;
        t->piece = piece;
        t->piece_room = room;
    }
    piece = &t->piece[t->pieces++];
    piece->left = left;
    piece->right = right;
    piece->loop = CONTOUR_NONE;
    return 1;
}

/* Ends an open curve, which is left out. */
static inline void contour_leave_out(contour_trace *t)
{
    ++t->out->open;
    t->used = t->begin;
    t->first_piece = t->pieces;
}

/* Closes the loop at hand: tidied across its seam, it is kept or, if nothing is left of it, dropped. Returns 0 if there
   is no memory. */
static inline int contour_close(contour_trace *t)
{
    contours *c = t->out;
    size_t first = c->start[c->loops], begin = t->begin, end = t->used, k;
    while (end - begin >= 2) {
        if (contour__is_same(t, begin, end - 1))
            --end;
        else if (end - begin > 2 && contour__is_same(t, begin, end - 2))
            end -= 2;
        else if (end - begin > 2 && contour__is_same(t, begin + 1, end - 1))
            ++begin, --end;
        else
            break;
    }
    t->begin = t->used = first;
    if (end - begin < 3) {
        ++c->collapsed;
        t->first_piece = t->pieces;
        return 1;
    }
    if (c->loops + 2 > t->starts) {
        size_t *start = (size_t *)realloc(c->start, 2 * t->starts * sizeof *start);
        if (!start) return 0;
        c->start = start;
        t->starts *= 2;
    }
    memmove(c->corner + 3 * first, c->corner + 3 * begin, 3 * (end - begin) * sizeof(double));
    memmove(c->normal + 3 * first, c->normal + 3 * begin, 3 * (end - begin) * sizeof(double));
    for (k = t->first_piece; k < t->pieces; ++k) t->piece[k].loop = c->loops;
    t->first_piece = t->pieces;
    c->start[++c->loops] = t->begin = t->used = first + end - begin;
    return 1;
}

/* --- what loops enclose ------------------------------------------------------------------------------------------- */

/* The graph whose nodes are parts and whose edges are loops. A loop separates what is on its left from what is on its
   right if no other way leads from one to the other: if its edge is a bridge. */
typedef struct contour__graph {
    size_t nodes, loops;
    uint32_t *set;      /* each part: parts that no loop separates are one node; */
    uint32_t *web;      /* and nodes that loops connect */
    double *area, *sum; /* each node; each web */
    size_t *end;        /* 2 per loop: nodes on its left and right */
    size_t *first, *at; /* each node: its edges are edge[first[k]] .. edge[first[k + 1] - 1]; the next one to take */
    size_t *edge;
    size_t *root; /* each web: the node of largest area, for differences to lose nothing */
    size_t *in, *low,
        *way; /* each node: when it was met, the earliest that is met beyond it, the edge that led there */
    size_t *stack;
    size_t *block;
} contour__graph;

static inline void contour__graph_free(contour__graph *g)
{
    free(g->set);
    free(g->area);
    free(g->block);
}

static inline int contour__graph_begin(contour__graph *g, const contour_trace *t, const contour_parts *p)
{
    size_t n, k;
    memset(g, 0, sizeof *g);
    g->loops = t->out->loops;
    n = g->nodes = p->count + g->loops; /* beyond the boundary every loop has a node of its own */
    g->set = (uint32_t *)malloc((2 * n + 1) * sizeof *g->set);
    g->area = (double *)calloc(2 * n + 1, sizeof *g->area);
    g->block = (size_t *)calloc(7 * n + 1 + 4 * g->loops + 1, sizeof *g->block);
    if (!g->set || !g->area || !g->block) return 0;
    g->web = g->set + n;
    g->sum = g->area + n;
    g->first = g->block;
    g->at = g->first + n + 1;
    g->root = g->at + n;
    g->in = g->root + n;
    g->low = g->in + n;
    g->way = g->low + n;
    g->stack = g->way + n;
    g->end = g->stack + n;
    g->edge = g->end + 2 * g->loops;
    for (k = 0; k < n; ++k) g->set[k] = g->web[k] = (uint32_t)k;
    return 1;
}

/* Open curves separate nothing; neither do the stretches of boundary between the right-hand parts of a loop. */
static inline void contour__graph_nodes(contour__graph *g, const contour_trace *t, const contour_parts *p)
{
    size_t k, *right = g->at; /* each loop: one part on its right */
    for (k = 0; k < g->loops; ++k) right[k] = CONTOUR_NONE;
    for (k = 0; k < t->pieces; ++k) {
        const contour__piece *piece = &t->piece[k];
        size_t other = piece->right != CONTOUR_NONE ? piece->right : p->count + piece->loop;
        if (piece->loop == CONTOUR_NONE)
            contour_unite(g->set, piece->left, other);
        else if (right[piece->loop] == CONTOUR_NONE)
            right[piece->loop] = other;
        else
            contour_unite(g->set, right[piece->loop], other);
        if (piece->loop != CONTOUR_NONE) t->out->part[piece->loop] = piece->left;
    }
    for (k = 0; k < g->loops; ++k) {
        g->end[2 * k] = contour__find(g->set, t->out->part[k]);
        g->end[2 * k + 1] = contour__find(g->set, right[k]);
        contour_unite(g->web, g->end[2 * k], g->end[2 * k + 1]);
        ++g->first[g->end[2 * k] + 1];
        ++g->first[g->end[2 * k + 1] + 1];
    }
    for (k = 0; k < p->count; ++k) g->area[contour__find(g->set, k)] += p->area[k];
    for (k = 0; k < g->nodes; ++k) {
        size_t web = contour__find(g->web, k);
        g->first[k + 1] += g->first[k];
        g->at[k] = g->first[k];
        g->sum[web] += g->area[k];
        if (web == k || g->area[k] > g->area[g->root[web]]) g->root[web] = k;
    }
    for (k = 0; k < 2 * g->loops; ++k) g->edge[g->at[g->end[k]]++] = k / 2;
    for (k = 0; k < g->nodes; ++k) g->at[k] = g->first[k];
}

/* Visits a web in depth, and finds its bridges (Tarjan). */
static inline void contour__graph_visit(contour__graph *g, size_t root, double *enclosed)
{
    size_t depth = 0, met = 1;
    double whole = g->sum[contour__find(g->web, root)];
    g->stack[depth++] = root;
    g->in[root] = g->low[root] = met++;
    g->way[root] = CONTOUR_NONE;
    while (depth > 0) {
        size_t v = g->stack[depth - 1], e, w;
        if (g->at[v] < g->first[v + 1]) {
            e = g->edge[g->at[v]++];
            w = g->end[2 * e] == v ? g->end[2 * e + 1] : g->end[2 * e];
            if (e == g->way[v]) continue;
            if (g->in[w] && g->in[w] < g->low[v]) g->low[v] = g->in[w];
            if (g->in[w]) continue;
            g->way[w] = e;
            g->in[w] = g->low[w] = met++;
            g->stack[depth++] = w;
            continue;
        }
        if (--depth == 0) continue;
        w = g->stack[depth - 1];
        if (g->low[v] < g->low[w]) g->low[w] = g->low[v];
        g->area[w] += g->area[v]; /* with all that lies beyond it */
        e = g->way[v];
        if (g->low[v] > g->in[w]) {
            enclosed[2 * e + (g->end[2 * e] == v ? 0 : 1)] = g->area[v];
            enclosed[2 * e + (g->end[2 * e] == v ? 1 : 0)] = whole - g->area[v];
        }
    }
}

/* Fills in part and enclosed, from the areas of the parts. Returns 0 if there is no memory. */
static inline int contour_enclose(contour_trace *t, const contour_parts *p)
{
    contours *c = t->out;
    contour__graph g;
    size_t k;
    int good = contour__graph_begin(&g, t, p);
    c->part = (size_t *)calloc(c->loops + 1, sizeof *c->part);
    c->enclosed = (double *)malloc((2 * c->loops + 1) * sizeof *c->enclosed);
    good = good && c->part && c->enclosed;
    for (k = 0; good && k < 2 * c->loops; ++k) c->enclosed[k] = (double)NAN;
    if (good) contour__graph_nodes(&g, t, p);
    for (k = 0; good && k < g.nodes; ++k)
        if (g.root[contour__find(g.web, k)] == k && g.first[k] < g.first[k + 1])
            contour__graph_visit(&g, k, c->enclosed);
    contour__graph_free(&g);
    return good;
}

static inline void contour_trace_end(contour_trace *t)
{
    free(t->piece);
    memset(t, 0, sizeof *t);
}

#endif
