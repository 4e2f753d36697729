/* outline.h - the graph, its points and a chart -> outlines of cells, ready to be written. */
#ifndef SURFMINK_IMAGE_OUTLINE_H
#define SURFMINK_IMAGE_OUTLINE_H

#include "chart.h"
#include "fit.h"

/* One corner of an outline: a point of fit.h, and how often the outline has gone round a wrapped image before it. */
typedef struct outline_corner {
    uint32_t point;
    int32_t turns;
} outline_corner;

typedef struct outlines {
    regions *map;
    const trace *graph;
    const fit *points;
    const chart *space; /* NULL: the outlines are flat */
    int welds;
    double *place;              /* 6 for each point: position and normal; NULL without a chart */
    unsigned char *is_placed;   /* each point: its place is known */
    unsigned char *is_mirrored; /* each region: the chart shows it mirrored, and it is turned round */
    outline_corner *corner;     /* of the outline at hand */
    size_t count, room;
    uint32_t *same; /* each point: the one that stands for it, often itself; NULL without welding */
    double *normal; /* of the corners of pixels along it */
    size_t normal_room;
} outlines;

static inline void outlines_free(outlines *o)
{
    free(o->place);
    free(o->is_placed);
    free(o->is_mirrored);
    free(o->corner);
    free(o->same);
    free(o->normal);
    memset(o, 0, sizeof *o);
}

/* --- one outline -------------------------------------------------------------------------------------------------- */

static inline int outlines__add(outlines *o, size_t point, int64_t turns)
{
    if (o->count == o->room) {
        size_t room = o->room ? 2 * o->room : 256;
        outline_corner *more = (outline_corner *)realloc(o->corner, room * sizeof *more);
        if (!more) return 0;
        o->corner = more;
        o->room = room;
    }
    o->corner[o->count].point = (uint32_t)point;
    o->corner[o->count++].turns = (int32_t)turns;
    return 1;
}

/* The corners of a half, from its first junction up to the last one but without it. Turns are counted from where the
   half begins; those of the chain from where the chain does. */
static inline int outlines__add_half(outlines *o, uint32_t half, int64_t *turns)
{
    const chain *c = &o->graph->chains[half / 2];
    int is_closed = c->from == TRACE_NONE, forward = half % 2 == 0;
    size_t own = o->points->kind == FIT_JUNCTIONS              ? 0
                 : o->points->kind == FIT_PIXELS && !is_closed ? c->cracks - 1
                                                               : c->cracks;
    size_t first = o->graph->junction_count + c->first, k;
    if (!is_closed && !outlines__add(o, forward ? c->from : c->to, *turns)) return 0;
    if (!forward) *turns -= c->turns;
    for (k = 0; k < own; ++k)
        if (!outlines__add(o, first + (forward ? k : own - 1 - k), *turns)) return 0;
    if (forward) *turns += c->turns;
    return 1;
}

/* Puts the point that stands for each in its place, once. */
static inline void outlines__join(outlines *o)
{
    size_t k, kept = 0;
    for (k = 0; k < o->count; ++k) {
        outline_corner corner = o->corner[k];
        corner.point = o->same[corner.point];
        if (kept == 0 || o->corner[kept - 1].point != corner.point || o->corner[kept - 1].turns != corner.turns)
            o->corner[kept++] = corner;
    }
    while (kept > 1 && o->corner[kept - 1].point == o->corner[0].point && o->corner[kept - 1].turns == 0) --kept;
    o->count = kept;
}

/* The corners of a cell, counter-clockwise in the picture or, if the chart is mirrored, in space. */
static inline int outlines_walk(outlines *o, size_t region, image_error *error)
{
    uint32_t half = o->graph->outline[region];
    int64_t turns = 0;
    size_t k;
    o->count = 0;
    do {
        if (!outlines__add_half(o, half, &turns)) return image_no_memory(error);
        half = trace_next(o->graph, half);
    } while (half != o->graph->outline[region]);
    if (o->same) outlines__join(o);
    for (k = 0; k < o->count / 2 && o->is_mirrored[region]; ++k) {
        outline_corner kept = o->corner[k];
        o->corner[k] = o->corner[o->count - 1 - k];
        o->corner[o->count - 1 - k] = kept;
    }
    return 1;
}

/* x and y of a corner in the picture, in pixels. */
static inline void outlines_xy(const outlines *o, const outline_corner *corner, double xy[2])
{
    xy[0] = o->points->xy[2 * (size_t)corner->point];
    xy[1] = o->points->xy[2 * (size_t)corner->point + 1];
    if (corner->turns) xy[0] += (double)corner->turns * (double)o->map->width;
}

/* --- the chart along it ------------------------------------------------------------------------------------------- */

static inline int outlines__keep_normal(outlines *o, const double normal[3], size_t count)
{
    if (3 * count + 3 > o->normal_room) {
        size_t room = o->normal_room ? 2 * o->normal_room : 768;
        double *more = (double *)realloc(o->normal, room * sizeof *more);
        if (!more) return 0;
        o->normal = more;
        o->normal_room = room;
    }
    memcpy(o->normal + 3 * count, normal, 3 * sizeof *normal);
    return 1;
}

/* At every corner of pixels along the outline all four have a place, the chart shows the same side throughout, and no
   normal is more than 90 degrees off their sum. Maps are often smeared some pixels beyond their rim, where positions
   are known but wrong: this is how such cells are found. */
static inline int outlines__check_chart(outlines *o, size_t region, image_error *error)
{
    const trace *t = o->graph;
    uint32_t half = t->outline[region];
    double normal[3], sum[3] = {0, 0, 0};
    size_t count = 0, k, at_row, at_column;
    int side, first_side = 0, i;
    do {
        const chain *c = &t->chains[half / 2];
        int32_t turns = 0;
        at_row = c->row; /* either way each corner of the chain is passed but one, which the next half has */
        at_column = c->column;
        for (k = 0; k < c->cracks; ++k) {
            if (half % 2) trace_step(t->map, t->way[c->first + k], &at_row, &at_column, &turns);
            if (!chart_corner(o->space, at_row, at_column, normal, &side)) {
                o->map->flag[region] |= REGION_RIM;
                return 1;
            }
            if (!(half % 2)) trace_step(t->map, t->way[c->first + k], &at_row, &at_column, &turns);
            if (!outlines__keep_normal(o, normal, count++)) return image_no_memory(error);
            if (first_side == 0) first_side = side;
            if (side == 0 || side != first_side) o->map->flag[region] |= REGION_FOLD;
            for (i = 0; i < 3; ++i) sum[i] += normal[i];
        }
        half = trace_next(t, half);
    } while (half != t->outline[region]);
    for (k = 0; k < count; ++k)
        if (!(chart_dot(o->normal + 3 * k, sum) > 0)) o->map->flag[region] |= REGION_FOLD;
    o->is_mirrored[region] = first_side < 0;
    return 1;
}

/* Finds the places of all corners. */
static inline void outlines__place(outlines *o, size_t region)
{
    size_t k;
    for (k = 0; k < o->count; ++k) {
        size_t point = o->corner[k].point;
        double *place = o->place + 6 * point;
        if (!o->is_placed[point])
            o->is_placed[point] = (unsigned char)chart_point(o->space, o->points->xy[2 * point],
                                                             o->points->xy[2 * point + 1], place, place + 3);
        if (!o->is_placed[point]) o->map->flag[region] |= REGION_RIM;
    }
}

/* --- welding ------------------------------------------------------------------------------------------------------ */

/* How far two points are apart: in space or, without a chart, in the picture. */
static inline double outlines__distance(const outlines *o, size_t a, size_t b)
{
    size_t size = o->space ? 6 : 2, k;
    const double *place = o->space ? o->place : o->points->xy;
    double d[3] = {0, 0, 0};
    for (k = 0; k < 3 && k < size; ++k) d[k] = place[size * a + k] - place[size * b + k];
    return sqrt(chart_dot(d, d));
}

/* The point that stands for this one; the way to it is halved. */
static inline uint32_t outlines__find(uint32_t *same, uint32_t point)
{
    while (same[point] != point) point = same[point] = same[same[point]];
    return point;
}

/* A map that is constant over some pixels has corners at the same place, and edges without length. Neighbours along an
   outline that are this close become one point, for every cell that has them. */
static inline int outlines__weld(outlines *o, image_error *error)
{
    const double near = 1e-6; /* of the mean edge */
    double sum = 0, edges = 0;
    size_t region, k, next;
    int round;
    uint32_t *same = (uint32_t *)malloc((o->points->count + 1) * sizeof *same);
    if (!same) return image_no_memory(error);
    for (k = 0; k < o->points->count; ++k) same[k] = (uint32_t)k;
    for (round = 0; round < 2; ++round) /* first the mean, then the edges that are short */
        for (region = 1; region < o->map->count; ++region) {
            if (o->map->flag[region] & REGION_DROPPED) continue;
            if (!outlines_walk(o, region, error)) {
                free(same);
                return 0;
            }
            for (k = 0; k < o->count; ++k) {
                uint32_t a, b;
                double length;
                next = k + 1 < o->count ? k + 1 : 0;
                a = o->corner[k].point;
                b = o->corner[next].point;
                length = outlines__distance(o, a, b);
                if (round == 0 && o->corner[k].turns == o->corner[next].turns) {
                    sum += length;
                    ++edges;
                } else if (round == 1 && length * edges < near * sum) {
                    a = outlines__find(same, a);
                    b = outlines__find(same, b);
                    same[a > b ? a : b] = a > b ? b : a;
                }
            }
        }
    for (k = 0; k < o->points->count; ++k) same[k] = outlines__find(same, (uint32_t)k);
    o->same = same;
    return 1;
}

/* --- all outlines ------------------------------------------------------------------------------------------------- */

/* Twice the area of the outline at hand in the picture, positive if it runs counter-clockwise there. */
static inline double outlines__area(const outlines *o)
{
    double sum = 0, first[2], a[2], b[2];
    size_t k;
    outlines_xy(o, &o->corner[0], first);
    for (k = 1; k + 1 < o->count; ++k) {
        outlines_xy(o, &o->corner[k], a);
        outlines_xy(o, &o->corner[k + 1], b);
        sum += (a[0] - first[0]) * (b[1] - first[1]) - (a[1] - first[1]) * (b[0] - first[0]);
    }
    return sum;
}

/* Fewer than three corners enclose nothing: so it may be between junctions, and after welding. The junctions of a cell
   that holds others in a bay may run the other way round than the cell, or enclose nothing. */
static inline int outlines__count(outlines *o, size_t region, image_error *error)
{
    double area;
    if (!outlines_walk(o, region, error)) return 0;
    if (o->count < 3) {
        o->map->flag[region] |= REGION_FEW;
    } else if (o->points->kind == FIT_JUNCTIONS) {
        area = outlines__area(o);
        if (!(o->is_mirrored[region] ? -area > 1e-9 : area > 1e-9)) o->map->flag[region] |= REGION_TURNED;
    }
    return 1;
}

/* Decides which cells are measured, and where their points are. `o` is filled in by the caller as far as its fifth
   member; on failure outlines_free gives back the rest. */
static inline int outlines_make(outlines *o, image_error *error)
{
    size_t region, points = o->points->count;
    o->is_mirrored = (unsigned char *)calloc(o->map->count, 1);
    if (o->space) o->is_placed = (unsigned char *)calloc(points + 1, 1);
    if (o->space) o->place = (double *)malloc((6 * points + 1) * sizeof *o->place);
    if (!o->is_mirrored || (o->space && (!o->is_placed || !o->place))) return image_no_memory(error);
    for (region = 1; region < o->map->count; ++region) {
        if (o->map->flag[region] & REGION_DROPPED) continue;
        if (!o->space && o->points->kind != FIT_JUNCTIONS) continue; /* a corner for each crack: four at least */
        if (o->space && !outlines__check_chart(o, region, error)) return 0;
        if (o->map->flag[region] & REGION_DROPPED) continue;
        if (!outlines__count(o, region, error)) return 0;
        if (o->space && o->count >= 3) outlines__place(o, region);
    }
    if (!o->welds) return 1;
    if (!outlines__weld(o, error)) return 0;
    for (region = 1; region < o->map->count; ++region)
        if (!(o->map->flag[region] & REGION_DROPPED) && !outlines__count(o, region, error)) return 0;
    return 1;
}

#endif
