/* fit.h - the graph of cracks -> points of outlines, as near to the true boundary as the pixels tell.

   A junction of pixels lies on a corner of the grid, up to 0.7 pixels off. It is FITTED to the lines on which the
   chains leave it: each is a straight line through the middles of its first eight cracks, known to 1 / k at their
   centroid and worse outside, and the corner itself counts a little, so that short chains cannot pull it far away.

   A chain of crack middles is a staircase. It is smoothed by many passes of the mean of three points, which would also
   flatten what is curved; so what smoothing has taken away is smoothed in turn, and given back (TWICING, J. W. Tukey).

   Both neighbours of a chain share all of its points. */
#ifndef SURFMINK_IMAGE_FIT_H
#define SURFMINK_IMAGE_FIT_H

#include "trace.h"

enum fit_points { FIT_JUNCTIONS, FIT_CURVE, FIT_PIXELS };

/* Points of all outlines: first the junctions, then for each crack of each chain one of its own. */
typedef struct fit {
    enum fit_points kind;
    size_t count; /* junctions + cracks */
    double *xy;   /* 2 each, in pixels; of a wrapped image those of a chain run on beyond its seam */
} fit;

/* --- middles of cracks -------------------------------------------------------------------------------------------- */

/* The pixel to the left of a crack, and that to its right. */
static inline void fit__sides(const regions *r, size_t row, size_t column, int way, size_t side[2])
{
    size_t left = column > 0 ? column - 1 : r->width - 1, right = column < r->width ? column : 0;
    switch (way) {
    case TRACE_RIGHT:
        side[0] = (row - 1) * r->width + right;
        side[1] = row * r->width + right;
        break;
    case TRACE_UP:
        side[0] = (row - 1) * r->width + left;
        side[1] = (row - 1) * r->width + right;
        break;
    case TRACE_LEFT:
        side[0] = row * r->width + left;
        side[1] = (row - 1) * r->width + left;
        break;
    default:
        side[0] = row * r->width + right;
        side[1] = row * r->width + left;
        break;
    }
}

/* Where the boundary passes a crack: in its middle; or, at a pixel of a line that is as far from one cell as from the
   other, in the centre of that pixel, of which the smaller cell has all. */
static inline void fit__middle(const regions *r, size_t row, size_t column, int32_t turns, int way, double middle[2])
{
    static const int ahead_x[4] = {1, 0, -1, 0}, ahead_y[4] = {0, 1, 0, -1};
    double x = (double)column + (double)turns * (double)r->width - 0.5, y = 0.5 - (double)row, to_left = 0;
    size_t side[2];
    if (r->tied) {
        fit__sides(r, row, column, way, side);
        if (r->tied[side[0]] != r->tied[side[1]]) to_left = r->tied[side[0]] ? 0.5 : -0.5;
    }
    middle[0] = x + 0.5 * ahead_x[way] - to_left * ahead_y[way];
    middle[1] = y + 0.5 * ahead_y[way] + to_left * ahead_x[way];
}

/* --- junctions ---------------------------------------------------------------------------------------------------- */

enum { FIT_FIRST = 8 }; /* cracks of a chain that tell where it leaves its junction */

/* A straight line through `count` points: where they are, along what, and how far they are strewn along it. */
typedef struct fit__line {
    double count, centre[2], along[2], scatter;
} fit__line;

/* The line through points; 0 if they tell no direction, as a single one, or four round a pixel. */
static inline int fit__main_axis(double point[FIT_FIRST][2], size_t count, fit__line *line)
{
    double xx = 0, xy = 0, yy = 0, dx, dy, difference, length;
    size_t k;
    line->count = (double)count;
    line->centre[0] = line->centre[1] = 0;
    for (k = 0; k < count; ++k) {
        line->centre[0] += point[k][0] / line->count;
        line->centre[1] += point[k][1] / line->count;
    }
    for (k = 0; k < count; ++k) {
        dx = point[k][0] - line->centre[0];
        dy = point[k][1] - line->centre[1];
        xx += dx * dx;
        xy += dx * dy;
        yy += dy * dy;
    }
    difference = hypot(0.5 * (xx - yy), xy);
    if (!(difference > 1e-9 * (xx + yy))) return 0; /* coordinates are halves of integers: this is rounding */
    line->scatter = 0.5 * (xx + yy) + difference;
    dx = xx > yy ? 0.5 * (xx - yy) + difference : xy;
    dy = xx > yy ? xy : 0.5 * (yy - xx) + difference;
    length = hypot(dx, dy);
    line->along[0] = dx / length;
    line->along[1] = dy / length;
    return 1;
}

/* The line on which a half leaves its junction, in coordinates with the junction's corner at the origin; so it is the
   same wherever it lies in the image. */
static inline int fit__leaving(const trace *t, const junction *j, uint32_t half, fit__line *line)
{
    const chain *c = &t->chains[half / 2];
    double point[FIT_FIRST][2];
    size_t k, count = c->cracks < FIT_FIRST ? c->cracks : (size_t)FIT_FIRST, row = j->row, column = j->column;
    int32_t turns = 0;
    for (k = 0; k < count; ++k) {
        int way = half % 2 ? (t->way[c->first + c->cracks - 1 - k] + 2) % 4 : t->way[c->first + k];
        fit__middle(t->map, row, column, turns, way, point[k]);
        point[k][0] -= (double)j->column - 0.5;
        point[k][1] -= 0.5 - (double)j->row;
        trace_step(t->map, way, &row, &column, &turns);
    }
    return fit__main_axis(point, count, line);
}

/* The point that is nearest to all lines, seen from the corner: the sum of (distance / its error)^2 is least. How
   well a line is known depends on where on it one looks, so this is repeated. */
static inline void fit__meet(const fit__line *line, size_t lines, double meeting[2])
{
    enum { ROUNDS = 3 };
    const double corner_weight = 0.25; /* the corner is known to 2 pixels, as far as this goes */
    size_t k;
    int round;
    meeting[0] = meeting[1] = 0;
    for (round = 0; round < ROUNDS; ++round) {
        double xx = corner_weight, xy = 0, yy = corner_weight, x = 0, y = 0, determinant;
        for (k = 0; k < lines; ++k) {
            const double *c = line[k].centre, *along = line[k].along;
            double off = along[0] * (meeting[0] - c[0]) + along[1] * (meeting[1] - c[1]);
            double weight = 1 / (1 / line[k].count + off * off / line[k].scatter);
            double nx = -along[1], ny = along[0], distance = nx * c[0] + ny * c[1];
            xx += weight * nx * nx;
            xy += weight * nx * ny;
            yy += weight * ny * ny;
            x += weight * nx * distance;
            y += weight * ny * distance;
        }
        determinant = xx * yy - xy * xy; /* corner_weight^2 at least */
        meeting[0] = (yy * x - xy * y) / determinant;
        meeting[1] = (xx * y - xy * x) / determinant;
    }
}

static inline void fit__junction(const trace *t, junction *j)
{
    fit__line line[4];
    double meeting[2];
    size_t lines = 0;
    int way;
    for (way = 0; way < 4; ++way)
        if (j->half[way] != TRACE_NONE) lines += (size_t)fit__leaving(t, j, j->half[way], &line[lines]);
    fit__meet(line, lines, meeting);
    j->x = ((double)j->column - 0.5) + meeting[0];
    j->y = (0.5 - (double)j->row) + meeting[1];
}

/* --- junctions that have passed each other ------------------------------------------------------------------------ */

enum { FIT_SHORT = 4 }; /* cracks of a chain whose junctions may have been fitted past each other */

/* A closed chain with one junction on it cannot be turned round. */
static inline int fit__is_turned(const trace *t, const chain *c)
{
    const junction *a, *b;
    double turn, dx, dy;
    if (c->cracks > FIT_SHORT || c->from == TRACE_NONE || c->to == TRACE_NONE) return 0;
    a = &t->junctions[c->from];
    b = &t->junctions[c->to];
    turn = (double)c->turns * (double)t->map->width;
    dx = (double)b->column - (double)a->column + turn;
    dy = (double)a->row - (double)b->row;
    return (b->x - a->x + turn) * dx + (b->y - a->y) * dy < 0.25 * (dx * dx + dy * dy);
}

/* Sends a junction back to its corner, and notes that it moved. */
static inline void fit__send_back(trace *t, uint32_t at, unsigned char *is_back, uint32_t *moved, size_t *moves)
{
    if (is_back[at]) return;
    is_back[at] = 1;
    t->junctions[at].x = (double)t->junctions[at].column - 0.5;
    t->junctions[at].y = 0.5 - (double)t->junctions[at].row;
    moved[(*moves)++] = at;
}

/* Both ends of a short chain that the fit has turned round, or nearly, go back to their corners; that may turn other
   chains round, and so on. All chains of one round are judged before any junction moves, so the order does not matter;
   a round looks at the chains of junctions that have moved in the last one, so that all of them take linear time. */
static inline int fit__untangle(trace *t, image_error *error)
{
    unsigned char *is_back = (unsigned char *)calloc(t->junction_count + 1, 1);
    uint32_t *moved = (uint32_t *)malloc((t->junction_count + 1) * sizeof *moved);
    uint32_t *bad = (uint32_t *)malloc((4 * t->junction_count + t->chain_count + 1) * sizeof *bad);
    size_t moves = 0, begin = 0, end, bads = 0, k;
    int way, good = is_back && moved && bad;
    for (k = 0; good && k < t->chain_count; ++k)
        if (fit__is_turned(t, &t->chains[k])) bad[bads++] = (uint32_t)k;
    while (good && bads > 0) {
        for (k = 0; k < bads; ++k) {
            fit__send_back(t, t->chains[bad[k]].from, is_back, moved, &moves);
            fit__send_back(t, t->chains[bad[k]].to, is_back, moved, &moves);
        }
        end = moves;
        for (bads = 0, k = begin; k < end; ++k)
            for (way = 0; way < 4; ++way) {
                uint32_t half = t->junctions[moved[k]].half[way];
                if (half != TRACE_NONE && fit__is_turned(t, &t->chains[half / 2])) bad[bads++] = half / 2;
            }
        begin = end;
    }
    free(is_back);
    free(moved);
    free(bad);
    return good || image_no_memory(error);
}

/* --- chains ------------------------------------------------------------------------------------------------------- */

static inline size_t fit__clamp(size_t value, size_t least, size_t most)
{
    return value < least ? least : value > most ? most : value;
}

/* Passes of the mean of three points, in place. The first and the last of n points stay, or are neighbours. */
static inline void fit__smooth(double *xy, size_t n, int is_closed, size_t passes)
{
    const double third = 1.0 / 3;
    size_t pass, i, c;
    for (pass = 0; pass < passes; ++pass)
        for (c = 0; c < 2; ++c) {
            double first = xy[c], before = is_closed ? xy[2 * (n - 1) + c] : xy[c], here, after;
            for (i = is_closed ? 0 : 1; i < (is_closed ? n : n - 1); ++i) {
                here = xy[2 * i + c];
                after = i + 1 < n ? xy[2 * (i + 1) + c] : first;
                xy[2 * i + c] = (before + here + after) * third;
                before = here;
            }
        }
}

/* Smooths n points, smooths what that has taken away, and gives it back; `rest` has room for as many. */
static inline void fit__twice(double *xy, double *rest, size_t n, int is_closed, size_t passes)
{
    size_t i;
    memcpy(rest, xy, 2 * n * sizeof *rest);
    fit__smooth(xy, n, is_closed, passes);
    for (i = 0; i < 2 * n; ++i) rest[i] -= xy[i];
    fit__smooth(rest, n, is_closed, passes);
    for (i = 0; i < 2 * n; ++i) xy[i] += rest[i];
}

/* The points of one chain, to `to`: one for each crack. Both scratch arrays have room for two more. */
static inline void fit__chain(const trace *t, const chain *c, double *scratch, double *rest, double *to)
{
    int is_closed = c->from == TRACE_NONE && c->to == TRACE_NONE;
    size_t n = c->cracks, k, row = c->row, column = c->column, passes;
    int32_t turns = 0;
    double *middle = is_closed ? scratch : scratch + 2, origin[2];
    origin[0] = (double)c->column; /* small numbers round less */
    origin[1] = -(double)c->row;
    for (k = 0; k < n; ++k) {
        fit__middle(t->map, row, column, turns, t->way[c->first + k], middle + 2 * k);
        middle[2 * k] -= origin[0];
        middle[2 * k + 1] -= origin[1];
        trace_step(t->map, t->way[c->first + k], &row, &column, &turns);
    }
    if (is_closed) {
        passes = fit__clamp(n / 16, 8, 64);
        fit__twice(scratch, rest, n, 1, passes < n / 4 ? passes : n / 4);
    } else {
        double *last = middle + 2 * n;
        scratch[0] = (c->from == TRACE_NONE ? (double)c->column - 0.5 : t->junctions[c->from].x) - origin[0];
        scratch[1] = (c->from == TRACE_NONE ? 0.5 - (double)c->row : t->junctions[c->from].y) - origin[1];
        last[0] = (c->to == TRACE_NONE ? (double)column - 0.5 : t->junctions[c->to].x) - origin[0] +
                  (double)turns * (double)t->map->width;
        last[1] = (c->to == TRACE_NONE ? 0.5 - (double)row : t->junctions[c->to].y) - origin[1];
        fit__twice(scratch, rest, n + 2, 0, fit__clamp(n, 8, 64));
    }
    for (k = 0; k < n; ++k) {
        to[2 * k] = middle[2 * k] + origin[0];
        to[2 * k + 1] = middle[2 * k + 1] + origin[1];
    }
}

/* The corners of pixels on a chain, but for those at its ends, where junctions are; a closed one has one more. */
static inline void fit__staircase(const trace *t, const chain *c, double *to)
{
    size_t k, row = c->row, column = c->column;
    int32_t turns = 0;
    for (k = 0; k < c->cracks; ++k) {
        trace_step(t->map, t->way[c->first + k], &row, &column, &turns);
        to[2 * k] = (double)column - 0.5 + (double)turns * (double)t->map->width;
        to[2 * k + 1] = 0.5 - (double)row;
    }
}

static inline void fit_free(fit *f)
{
    free(f->xy);
    memset(f, 0, sizeof *f);
}

/* Points of all chains that end somewhere. Whatever comes of it, fit_free gives the memory back. */
static inline int fit_points_of(fit *f, trace *t, enum fit_points kind, image_error *error)
{
    size_t k, longest = 0;
    double *scratch;
    memset(f, 0, sizeof *f);
    f->kind = kind;
    if (kind != FIT_PIXELS) {
        for (k = 0; k < t->junction_count; ++k) fit__junction(t, &t->junctions[k]);
        if (!fit__untangle(t, error)) return 0;
    }
    for (k = 0; k < t->chain_count; ++k)
        if (t->chains[k].cracks > longest) longest = t->chains[k].cracks;
    f->count = t->junction_count + (kind == FIT_JUNCTIONS ? 0 : t->cracks);
    f->xy = (double *)malloc((2 * f->count + 1) * sizeof *f->xy);
    scratch = (double *)malloc(4 * (longest + 2) * sizeof *scratch);
    if (!f->xy || !scratch) {
        free(scratch);
        return image_no_memory(error);
    }
    for (k = 0; k < t->junction_count; ++k) {
        f->xy[2 * k] = t->junctions[k].x;
        f->xy[2 * k + 1] = t->junctions[k].y;
    }
    for (k = 0; k < t->chain_count && kind != FIT_JUNCTIONS; ++k) {
        double *to = f->xy + 2 * (t->junction_count + t->chains[k].first);
        if (kind == FIT_CURVE)
            fit__chain(t, &t->chains[k], scratch, scratch + 2 * (longest + 2), to);
        else
            fit__staircase(t, &t->chains[k], to);
    }
    free(scratch);
    return 1;
}

#endif
