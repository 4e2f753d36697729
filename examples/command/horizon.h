/* horizon.h - the part of a sphere polygon that faces the eye, as rings in the plane of the picture. */
#ifndef SURFMINK_COMMAND_HORIZON_H
#define SURFMINK_COMMAND_HORIZON_H

#include "../picture/camera.h"

/* Points of great circles and of the horizon are at most this far apart. */
static const double degrees_per_point = 2;

/* A growing list of points, three numbers each. */
typedef struct points {
    double *x;
    size_t n, room; /* n points; room in numbers */
} points;

static void add_point(points *list, const double x[3])
{
    list->x = (double *)grow(list->x, &list->room, 3 * (list->n + 1), sizeof *list->x);
    memcpy(list->x + 3 * list->n++, x, 3 * sizeof *x);
}

/* A piece of the outline on the visible side, with the angles at which it comes over the horizon and goes. */
typedef struct visible {
    size_t first, n; /* points */
    double comes, goes;
    int drawn;
} visible;

typedef struct horizon {
    points outline; /* in view coordinates, with points between the corners */
    points piece;   /* of the visible pieces, one after the other */
    visible *visible;
    size_t pieces, room;
} horizon;

static void free_horizon(horizon *h)
{
    free(h->outline.x);
    free(h->piece.x);
    free(h->visible);
}

/* --- great circles between the corners ---------------------------------------------------------------------------- */

static void add_edge(horizon *h, const camera *c, const double *from, const double *to)
{
    double radius = 1, between[3 * 91], view[3];
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    double chord[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    double degrees = 2 * asin(fmin(1, sqrt(dot(chord, chord)) / 2)) * 57.29577951308232;
    size_t i, m = (size_t)ceil(degrees / degrees_per_point);
    if (m < 1) m = 1;
    if (surfmink_edge_points(&sphere, from, to, m, between) != SURFMINK_OK) { /* no edge, or no unique one */
        m = 1;
        memcpy(between, from, 3 * sizeof *from);
    }
    for (i = 0; i < m; ++i) {
        to_view(c, between + 3 * i, view);
        add_point(&h->outline, view);
    }
}

/* --- pieces ------------------------------------------------------------------------------------------------------- */

/* On the horizon itself counts as visible, whatever rounding says: cells may share an edge with it. */
static int is_visible(const double *view)
{
    return view[2] >= -1e-9;
}

/* Where the short step from a to b crosses the horizon. */
static double crossing(const double *a, const double *b)
{
    double t = fmin(1, fmax(0, a[2] / (a[2] - b[2]))); /* what rounding calls visible may lie a little below */
    return atan2(a[1] + t * (b[1] - a[1]), a[0] + t * (b[0] - a[0]));
}

static void add_horizon_point(points *list, double angle)
{
    double x[3];
    x[0] = cos(angle);
    x[1] = sin(angle);
    x[2] = 0;
    add_point(list, x);
}

/* From point i, the first that has come over the horizon, to the last before it goes. */
static void add_piece(horizon *h, size_t i)
{
    const double *x = h->outline.x;
    size_t n = h->outline.n, before = i > 0 ? i - 1 : n - 1;
    visible *v;
    h->visible = (visible *)grow(h->visible, &h->room, h->pieces + 1, sizeof *h->visible);
    v = &h->visible[h->pieces++];
    v->first = h->piece.n;
    v->drawn = 0;
    v->comes = crossing(x + 3 * before, x + 3 * i);
    add_horizon_point(&h->piece, v->comes);
    for (; is_visible(x + 3 * i); i = i + 1 < n ? i + 1 : 0) {
        add_point(&h->piece, x + 3 * i);
        before = i;
    }
    v->goes = crossing(x + 3 * before, x + 3 * i);
    add_horizon_point(&h->piece, v->goes);
    v->n = h->piece.n - v->first;
}

/* All pieces; none if all of the outline can be seen, or nothing of it. */
static void find_pieces(horizon *h)
{
    const double *x = h->outline.x;
    size_t i, before, n = h->outline.n;
    h->piece.n = h->pieces = 0;
    for (i = 0; i < n; ++i) {
        before = i > 0 ? i - 1 : n - 1;
        if (is_visible(x + 3 * i) && !is_visible(x + 3 * before)) add_piece(h, i);
    }
}

/* --- rings -------------------------------------------------------------------------------------------------------- */

/* How far it is counter-clockwise along the horizon. A touch whose angles differ only by rounding is no full turn. */
static double horizon_way(double from, double to)
{
    const double turn = 6.283185307179586;
    double way = to - from;
    while (way < 0) way += turn;
    while (way >= turn) way -= turn;
    return way > turn - 1e-6 ? 0 : way;
}

/* The inside lies to the left of the outline. So where a piece goes below the horizon, the inside is bounded by the
   horizon from there, counter-clockwise, to where the next piece comes up. */
static size_t next_piece(const horizon *h, size_t i)
{
    size_t j, best = i;
    for (j = 0; j < h->pieces; ++j)
        if (horizon_way(h->visible[i].goes, h->visible[j].comes) <
            horizon_way(h->visible[i].goes, h->visible[best].comes))
            best = j;
    return best;
}

static void follow_horizon(points *ring, double from, double to)
{
    double way = horizon_way(from, to), step = degrees_per_point * 0.017453292519943296;
    int i;
    for (i = 1; i * step < way; ++i) add_horizon_point(ring, from + i * step);
}

/* The ring that begins with a piece which has not been drawn yet; 0 if there is none. */
static int next_ring(horizon *h, points *ring)
{
    size_t i = 0, j, k;
    ring->n = 0;
    while (i < h->pieces && h->visible[i].drawn) ++i;
    if (i == h->pieces) return 0;
    for (; !h->visible[i].drawn; i = j) {
        visible *v = &h->visible[i];
        v->drawn = 1;
        for (k = 0; k < v->n; ++k) add_point(ring, h->piece.x + 3 * (v->first + k));
        j = next_piece(h, i);
        follow_horizon(ring, v->goes, h->visible[j].comes);
    }
    return 1;
}

#endif
