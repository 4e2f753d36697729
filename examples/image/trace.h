/* trace.h - regions -> the graph of their boundaries: junctions, and chains of cracks between them.

   CRACK      a side between two pixels of different regions
   JUNCTION   a corner of pixels where three regions meet, or four
   CHAIN      cracks from one junction to the next; or a closed one, round a region without junctions
   HALF       a chain as it is passed with one of its two regions on the left: 2 k forwards, 2 k + 1 backwards

   Where four pixels meet of which two that touch by their corners are alike, these two are joined; if so are the other
   two, those of the larger region number. So the result does not depend on how the image is turned or mirrored.
   Coordinates are those of the picture: pixel (row, column) has its centre at x = column, y = -row. Every region has
   its outer boundary counter-clockwise. */
#ifndef SURFMINK_IMAGE_TRACE_H
#define SURFMINK_IMAGE_TRACE_H

#include "regions.h"

#define TRACE_NONE UINT32_MAX

/* The ways out of a corner, counter-clockwise; the way back of d is (d + 2) % 4. */
enum trace_way { TRACE_RIGHT, TRACE_UP, TRACE_LEFT, TRACE_DOWN };

typedef struct junction {
    uint32_t row, column; /* the corner up and left of the pixel with these numbers */
    uint32_t half[4];     /* that leaves it in each way, or TRACE_NONE */
    double x, y;          /* fitted, by fit.h */
} junction;

typedef struct chain {
    uint32_t row, column; /* of its first corner */
    uint32_t from, to;    /* junctions; TRACE_NONE at the border of the image, and for closed chains */
    uint32_t left, right; /* regions */
    uint32_t cracks;
    int32_t turns; /* round a wrapped image, until its last corner */
    size_t first;  /* crack: trace.way[first] to way[first + cracks - 1] */
} chain;

typedef struct trace {
    const regions *map;
    junction *junctions; /* row by row */
    size_t junction_count;
    chain *chains;
    size_t chain_count, chain_room;
    unsigned char *way; /* of each crack */
    size_t cracks, way_room;
    unsigned char *passed; /* each corner: 1 if the crack to its right has been passed, 2 if that below it */
    size_t *row_begin;     /* height + 2: the first junction of each row of corners */
    uint32_t *outline;     /* of each region: a half of its outer boundary, or TRACE_NONE */
} trace;

static inline void trace_free(trace *t)
{
    free(t->junctions);
    free(t->chains);
    free(t->way);
    free(t->passed);
    free(t->row_begin);
    free(t->outline);
    memset(t, 0, sizeof *t);
}

/* --- corners ------------------------------------------------------------------------------------------------------ */

/* The four regions around a corner inside the image, counter-clockwise from that which lies to the left when one leaves
   it to the right: up and right of it, up and left, down and left, down and right. */
static inline void trace__around(const regions *r, size_t row, size_t column, uint32_t region[4])
{
    const uint32_t *above = r->of + (row - 1) * r->width, *below = above + r->width;
    size_t left = column > 0 ? column - 1 : r->width - 1, right = column < r->width ? column : 0;
    region[TRACE_RIGHT] = above[right];
    region[TRACE_UP] = above[left];
    region[TRACE_LEFT] = below[left];
    region[TRACE_DOWN] = below[right];
}

/* Is the corner on the border of the image, where there are not four pixels? */
static inline int trace__is_border(const regions *r, size_t row, size_t column)
{
    return row == 0 || row == r->height || (!r->wraps && (column == 0 || column == r->width));
}

/* A crack leads away to the right where the two regions on its sides differ, and so on. */
static inline int trace__has_way(const uint32_t region[4], int way)
{
    return region[way] != region[(way + 3) % 4];
}

/* Whether two regions that touch by the corner are joined there: 1 up left with down right, 2 up right with down left,
   0 for neither. */
static inline int trace__joined(const uint32_t region[4])
{
    int falls = region[TRACE_UP] == region[TRACE_DOWN], rises = region[TRACE_RIGHT] == region[TRACE_LEFT];
    if (falls && rises) return region[TRACE_UP] > region[TRACE_RIGHT] ? 1 : 2;
    return falls ? 1 : rises ? 2 : 0;
}

static inline int trace__ways(const uint32_t region[4])
{
    return trace__has_way(region, 0) + trace__has_way(region, 1) + trace__has_way(region, 2) +
           trace__has_way(region, 3);
}

static inline int trace__is_junction(const uint32_t region[4])
{
    int ways = trace__ways(region);
    return ways == 3 || (ways == 4 && !trace__joined(region));
}

/* The way on of who has come by `way` to a corner that is no junction. */
static inline int trace__next_way(const uint32_t region[4], int way)
{
    static const unsigned char round_falling[4] = {TRACE_DOWN, TRACE_LEFT, TRACE_UP, TRACE_RIGHT};
    static const unsigned char round_rising[4] = {TRACE_UP, TRACE_RIGHT, TRACE_DOWN, TRACE_LEFT};
    int on;
    if (trace__ways(region) == 4) return trace__joined(region) == 1 ? round_falling[way] : round_rising[way];
    for (on = 0; on == (way + 2) % 4 || !trace__has_way(region, on);) ++on;
    return on;
}

static inline size_t trace__corner(const regions *r, size_t row, size_t column)
{
    return row * (r->width + 1) + column;
}

/* One step. A wrapped image has its corners in columns 0 to width - 1. */
static inline void trace_step(const regions *r, int way, size_t *row, size_t *column, int32_t *turns)
{
    if (way == TRACE_UP)
        --*row;
    else if (way == TRACE_DOWN)
        ++*row;
    else if (way == TRACE_RIGHT) {
        if (++*column == r->width && r->wraps) {
            *column = 0;
            ++*turns;
        }
    } else if (*column > 0)
        --*column;
    else { /* only in a wrapped image */
        *column = r->width - 1;
        --*turns;
    }
}

/* Has the crack that leaves this corner been passed? It is from now on. */
static inline int trace__pass(trace *t, size_t row, size_t column, int way)
{
    int32_t turns = 0;
    unsigned char bit = way == TRACE_RIGHT || way == TRACE_LEFT ? 1 : 2, *at;
    if (way == TRACE_LEFT || way == TRACE_UP) trace_step(t->map, way, &row, &column, &turns);
    at = &t->passed[trace__corner(t->map, row, column)];
    if (*at & bit) return 1;
    *at |= bit;
    return 0;
}

/* --- junctions ---------------------------------------------------------------------------------------------------- */

static inline int trace__find_junctions(trace *t, image_error *error)
{
    const regions *r = t->map;
    size_t row, column, room = 0, k;
    size_t first = r->wraps ? 0 : 1;
    uint32_t region[4];
    for (row = 0; row <= r->height; ++row) {
        t->row_begin[row] = t->junction_count;
        for (column = first; row > 0 && row < r->height && column < r->width; ++column) {
            junction *j;
            trace__around(r, row, column, region);
            if (region[0] == region[1] && region[2] == region[3]) continue; /* mostly, and quickly told */
            if (!trace__is_junction(region)) continue;
            if (t->junction_count == room) {
                room = room ? 2 * room : 256;
                j = (junction *)realloc(t->junctions, room * sizeof *j);
                if (!j) return image_no_memory(error);
                t->junctions = j;
            }
            j = &t->junctions[t->junction_count++];
            j->row = (uint32_t)row;
            j->column = (uint32_t)column;
            for (k = 0; k < 4; ++k) j->half[k] = TRACE_NONE;
            j->x = (double)column - 0.5;
            j->y = 0.5 - (double)row;
        }
    }
    t->row_begin[r->height + 1] = t->junction_count;
    return 1;
}

/* The junction at a corner, TRACE_NONE if there is none. */
static inline uint32_t trace__junction_at(const trace *t, size_t row, size_t column)
{
    size_t low = t->row_begin[row], high = t->row_begin[row + 1];
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (t->junctions[middle].column == column) return (uint32_t)middle;
        if (t->junctions[middle].column < column)
            low = middle + 1;
        else
            high = middle;
    }
    return TRACE_NONE;
}

/* --- chains ------------------------------------------------------------------------------------------------------- */

static inline int trace__add_crack(trace *t, int way, image_error *error)
{
    if (t->cracks == t->way_room) {
        size_t room = t->way_room ? 2 * t->way_room : 4096;
        unsigned char *more = (unsigned char *)realloc(t->way, room);
        if (!more) return image_no_memory(error);
        t->way = more;
        t->way_room = room;
    }
    t->way[t->cracks++] = (unsigned char)way;
    return 1;
}

static inline chain *trace__new_chain(trace *t, image_error *error)
{
    if (t->chain_count == t->chain_room) {
        size_t room = t->chain_room ? 2 * t->chain_room : 256;
        chain *more = (chain *)realloc(t->chains, room * sizeof *more);
        if (!more) {
            image_no_memory(error);
            return NULL;
        }
        t->chains = more;
        t->chain_room = room;
    }
    memset(&t->chains[t->chain_count], 0, sizeof *t->chains);
    return &t->chains[t->chain_count];
}

/* Follows the cracks from a corner until they end at a junction or at the border, or are back. A crack that has been
   passed is not followed a second time. */
static inline int trace__follow(trace *t, size_t row, size_t column, int way, uint32_t from, image_error *error)
{
    const regions *r = t->map;
    size_t at_row = row, at_column = column;
    uint32_t region[4], half = (uint32_t)(2 * t->chain_count);
    int at_way = way, is_closed = 0, at_border = trace__is_border(r, row, column);
    chain *c;
    if (trace__pass(t, row, column, way)) return 1;
    c = trace__new_chain(t, error);
    if (!c) return 0;
    c->row = (uint32_t)row;
    c->column = (uint32_t)column;
    c->from = from;
    c->to = TRACE_NONE;
    c->first = t->cracks;
    if (!at_border) {
        trace__around(r, row, column, region);
        c->left = region[way];
        c->right = region[(way + 3) % 4];
    }
    while (!is_closed) {
        if (!trace__add_crack(t, at_way, error)) return 0;
        trace_step(r, at_way, &at_row, &at_column, &c->turns);
        if (trace__is_border(r, at_row, at_column)) break;
        trace__around(r, at_row, at_column, region);
        if (trace__is_junction(region)) {
            c->to = trace__junction_at(t, at_row, at_column);
            break;
        }
        at_way = trace__next_way(region, at_way);
        is_closed = from == TRACE_NONE && at_row == row && at_column == column && at_way == way;
        if (!is_closed) trace__pass(t, at_row, at_column, at_way);
    }
    c->cracks = (uint32_t)(t->cracks - c->first);
    if (at_border) { /* and so to the border, for chains that begin at junctions come first: it bounds no whole cell */
        t->cracks = c->first;
        return 1;
    }
    if (from != TRACE_NONE) t->junctions[from].half[way] = half;
    if (c->to != TRACE_NONE) t->junctions[c->to].half[(at_way + 2) % 4] = half + 1;
    ++t->chain_count;
    return 1;
}

/* Every crack belongs to one chain: first those that begin at junctions, then those from border to border, which are
   let go; what is left is closed. */
static inline int trace__find_chains(trace *t, image_error *error)
{
    const regions *r = t->map;
    size_t k, row, column;
    int way;
    uint32_t region[4];
    for (k = 0; k < t->junction_count; ++k)
        for (way = 0; way < 4; ++way) {
            row = t->junctions[k].row;
            column = t->junctions[k].column;
            trace__around(r, row, column, region);
            if (trace__has_way(region, way) && !trace__follow(t, row, column, way, (uint32_t)k, error)) return 0;
        }
    for (column = 1; column < r->width; ++column) {
        const uint32_t *top = r->of + column, *bottom = r->of + (r->height - 1) * r->width + column;
        if (top[0] != top[-1] && !trace__follow(t, 0, column, TRACE_DOWN, TRACE_NONE, error)) return 0;
        if (bottom[0] != bottom[-1] && !trace__follow(t, r->height, column, TRACE_UP, TRACE_NONE, error)) return 0;
    }
    for (row = 1; row < r->height && !r->wraps; ++row) {
        const uint32_t *below = r->of + row * r->width, *above = below - r->width;
        if (*above != *below && !trace__follow(t, row, 0, TRACE_RIGHT, TRACE_NONE, error)) return 0;
        if (above[r->width - 1] != below[r->width - 1] &&
            !trace__follow(t, row, r->width, TRACE_LEFT, TRACE_NONE, error))
            return 0;
    }
    if (r->wraps) { /* the seam, at the top and at the bottom */
        const uint32_t *top = r->of, *bottom = r->of + (r->height - 1) * r->width;
        if (top[0] != top[r->width - 1] && !trace__follow(t, 0, 0, TRACE_DOWN, TRACE_NONE, error)) return 0;
        if (bottom[0] != bottom[r->width - 1] && !trace__follow(t, r->height, 0, TRACE_UP, TRACE_NONE, error)) return 0;
    }
    for (row = 2; row < r->height;
         ++row) /* a closed chain has a crack that goes up, from one inner corner to another */
        for (column = r->wraps ? 0 : 1; column < r->width; ++column) {
            const uint32_t *above = r->of + (row - 1) * r->width;
            if (above[column] != above[column > 0 ? column - 1 : r->width - 1] &&
                !trace__follow(t, row, column, TRACE_UP, TRACE_NONE, error))
                return 0;
        }
    return 1;
}

/* --- outlines ----------------------------------------------------------------------------------------------------- */

static inline uint32_t trace_left(const trace *t, uint32_t half)
{
    return half % 2 ? t->chains[half / 2].right : t->chains[half / 2].left;
}

/* The half that goes on along the same region; itself, where it is closed. */
static inline uint32_t trace_next(const trace *t, uint32_t half)
{
    const chain *c = &t->chains[half / 2];
    uint32_t at = half % 2 ? c->from : c->to, region = trace_left(t, half);
    int way;
    if (at == TRACE_NONE) return half;
    for (way = 0; way < 4; ++way) {
        uint32_t next = t->junctions[at].half[way];
        if (next != TRACE_NONE && trace_left(t, next) == region) return next;
    }
    return half; /* not reached: at a junction every region lies to the left of one of the ways out */
}

/* Follows a boundary once round: its area in pixels, and how often it winds round a wrapped image. */
static inline void trace__go_round(const trace *t, uint32_t half, unsigned char *seen, double *area, int64_t *turns)
{
    uint32_t at = half;
    int64_t x = 0;
    *area = 0;
    *turns = 0;
    do {
        const chain *c = &t->chains[at / 2];
        int forward = at % 2 == 0;
        size_t k;
        seen[at] = 1;
        for (k = 0; k < c->cracks; ++k) {
            int way = forward ? t->way[c->first + k] : (t->way[c->first + c->cracks - 1 - k] + 2) % 4;
            if (way == TRACE_RIGHT || way == TRACE_LEFT)
                x += way == TRACE_RIGHT ? 1 : -1;
            else
                *area += (double)(way == TRACE_UP ? x : -x);
        }
        *turns += forward ? c->turns : -(int64_t)c->turns;
        at = trace_next(t, at);
    } while (at != half);
}

/* The outer boundary of every cell that can have one. */
static inline int trace__find_outlines(trace *t, regions *r, image_error *error)
{
    size_t halves = 2 * t->chain_count, k;
    unsigned char *seen = (unsigned char *)calloc(halves + 1, 1);
    double *enclosed = (double *)calloc(r->count, sizeof *enclosed); /* by the boundaries of each region */
    t->outline = (uint32_t *)malloc(r->count * sizeof *t->outline);
    if (!seen || !enclosed || !t->outline) {
        free(seen);
        free(enclosed);
        return image_no_memory(error);
    }
    for (k = 0; k < r->count; ++k) t->outline[k] = TRACE_NONE;
    for (k = 0; k < halves; ++k) {
        uint32_t region = trace_left(t, (uint32_t)k);
        double area;
        int64_t turns;
        if (seen[k] || region == 0 || (r->flag[region] & REGION_BORDER)) continue;
        trace__go_round(t, (uint32_t)k, seen, &area, &turns);
        enclosed[region] += area;
        if (turns != 0)
            r->flag[region] |= REGION_WINDS;
        else if (area < 0)
            r->flag[region] |= REGION_HOLES;
        else if (t->outline[region] != TRACE_NONE)
            r->flag[region] |= REGION_PARTS;
        else
            t->outline[region] = (uint32_t)k;
    }
    for (k = 1; k < r->count; ++k) /* a part goes straight round a wrapped image, without a crack up or down */
        if (fabs(enclosed[k] - (double)r->pixels[k]) > 0 && !(r->flag[k] & REGION_BORDER)) r->flag[k] |= REGION_WINDS;
    free(seen);
    free(enclosed);
    return 1;
}

/* Traces all boundaries; r is marked with what is found. Whatever comes of it, trace_free
   gives the memory back. */
static inline int trace_regions(trace *t, regions *r, image_error *error)
{
    int good;
    memset(t, 0, sizeof *t);
    t->map = r;
    t->passed = (unsigned char *)calloc((r->width + 1) * (r->height + 1), 1);
    t->row_begin = (size_t *)malloc((r->height + 2) * sizeof *t->row_begin);
    good = (t->passed && t->row_begin) || image_no_memory(error);
    good = good && trace__find_junctions(t, error) && trace__find_chains(t, error) && trace__find_outlines(t, r, error);
    free(t->passed);
    t->passed = NULL;
    return good;
}

#endif
