/* grey.h - a grey image -> the curves where it has a given value.

   MARCHING SQUARES: the corners of a square are the centres of four pixels that touch. A curve crosses a side of it
   where the value lies between those at its ends, which is interpolated; inside the square it is straight. Of a square
   with two opposite corners inside, the bilinear saddle tells which are connected. Squares are not cut into triangles:
   on sharp images that leaves a bias which does not shrink with the pixels.

   A curve has the inside on its left, in the picture: x = column, y = -row. Where a pixel is not finite there is no
   image; curves that end there or at the border enclose nothing, and are counted. Time and memory are linear. */
#ifndef SURFMINK_IMAGE_GREY_H
#define SURFMINK_IMAGE_GREY_H

#include "image.h"

enum grey_inside { GREY_BELOW, GREY_ABOVE }; /* where value < level; where value >= level */

typedef struct grey_loops {
    size_t loops;
    size_t *start;    /* loops + 1: loop k has the corners start[k] .. start[k + 1] - 1, three at least */
    double *xy;       /* 2 for each corner, in pixels */
    size_t open;      /* curves that end at the border of the image, or at a hole */
    size_t collapsed; /* loops round a pixel exactly at the level, without three corners: left out */
    size_t corners, corner_room, loop_room;
} grey_loops;

typedef struct grey__field {
    const image *im;
    double level;
    enum grey_inside inside;
    unsigned char
        *passed; /* each pixel: 1 if the side to the pixel on its right has been passed, 2 that to the one below */
} grey__field;

/* Where a curve is: about to enter a square across a side, with the inside on its left. (row, column) is the pixel at
   the left end of the side, and the way is as in trace.h: 0 right, 1 up, 2 left, 3 down. */
typedef struct grey__place {
    int64_t row, column;
    int way;
} grey__place;

static inline void grey_free(grey_loops *g)
{
    free(g->start);
    free(g->xy);
    memset(g, 0, sizeof *g);
}

static inline double grey__value(const grey__field *f, int64_t row, int64_t column)
{
    return image_value(f->im, 0, (size_t)row, (size_t)column);
}

static inline int grey__is_inside(const grey__field *f, double value)
{
    return (value >= f->level) == (f->inside == GREY_ABOVE);
}

/* The step to the left of a way; straight on is the step to the left of the way to the right. */
static const int grey__left_row[4] = {-1, 0, 1, 0}, grey__left_column[4] = {0, -1, 0, 1};

/* Is the pixel there, and finite? */
static inline int grey__is_there(const grey__field *f, int64_t row, int64_t column)
{
    return row >= 0 && column >= 0 && row < (int64_t)f->im->height && column < (int64_t)f->im->width &&
           fabs(grey__value(f, row, column)) <= 1e300;
}

/* Has the side been passed? It is from now on. */
static inline int grey__pass(grey__field *f, const grey__place *at)
{
    int back = (at->way + 2) % 4;
    int64_t row = at->row, column = at->column;
    unsigned char bit = at->way % 2 ? 1 : 2,
                  *passed; /* who goes up or down passes between a pixel and that on its right */
    if (at->way == 0 || at->way == 1) {
        /* going right the left end is the upper one, going up the left one: the side is its own */
    } else {
        row += grey__left_row[back];
        column += grey__left_column[back];
    }
    passed = &f->passed[(size_t)row * f->im->width + (size_t)column];
    if (*passed & bit) return 1;
    *passed |= bit;
    return 0;
}

/* The point on the side: the same from either end. */
static inline void grey__point(const grey__field *f, const grey__place *at, double xy[2])
{
    int back = (at->way + 2) % 4;
    int64_t row = at->row + grey__left_row[back], column = at->column + grey__left_column[back];
    double inside = grey__value(f, at->row, at->column), outside = grey__value(f, row, column);
    double part = (f->level - inside) / (outside - inside);
    xy[0] = (double)at->column + part * (double)(column - at->column);
    xy[1] = -((double)at->row + part * (double)(row - at->row));
}

/* Crosses the square ahead; 0 if there is none. The corners: `left` and `right` of the side, `far_left` and `far_right`
   beyond them. */
static inline int grey__cross(const grey__field *f, grey__place *at)
{
    int ahead = (at->way + 3) % 4, back = (at->way + 2) % 4; /* indices into the steps: forwards, and to the right */
    int64_t right_row = at->row + grey__left_row[back], right_column = at->column + grey__left_column[back];
    int64_t row = at->row + grey__left_row[ahead], column = at->column + grey__left_column[ahead];
    int64_t far_row = right_row + grey__left_row[ahead], far_column = right_column + grey__left_column[ahead];
    double left, right, far_left, far_right;
    int turn_left, turn_right;
    if (!grey__is_there(f, row, column) || !grey__is_there(f, far_row, far_column)) return 0;
    left = grey__value(f, at->row, at->column);
    right = grey__value(f, right_row, right_column);
    far_left = grey__value(f, row, column);
    far_right = grey__value(f, far_row, far_column);
    turn_left = !grey__is_inside(f, far_left);
    turn_right = grey__is_inside(f, far_right);
    if (turn_left && turn_right) /* a saddle: are the two corners inside connected over it? */
        turn_left = !grey__is_inside(f, (left * far_right - right * far_left) / (left + far_right - right - far_left));
    if (turn_left)
        at->way = (at->way + 1) % 4; /* the same pixel is to the left */
    else if (turn_right) {
        at->row = far_row;
        at->column = far_column;
        at->way = (at->way + 3) % 4;
    } else {
        at->row = row;
        at->column = column;
    }
    return 1;
}

/* Room for another corner and another loop. */
static inline int grey__grow(grey_loops *g)
{
    if (g->corners == g->corner_room) {
        size_t room = g->corner_room ? 2 * g->corner_room : 256;
        double *more = (double *)realloc(g->xy, 2 * room * sizeof *more);
        if (!more) return 0;
        g->xy = more;
        g->corner_room = room;
    }
    if (g->loops + 2 > g->loop_room) {
        size_t room = g->loop_room ? 2 * g->loop_room : 16;
        size_t *more = (size_t *)realloc(g->start, room * sizeof *more);
        if (!more) return 0;
        g->start = more;
        g->loop_room = room;
    }
    return 1;
}

/* Two corners at the same pixel are one. */
static inline int grey__same(const double *a, const double *b)
{
    return a[0] >= b[0] && a[0] <= b[0] && a[1] >= b[1] && a[1] <= b[1];
}

/* Follows a curve from a side until it is back, or ends. */
static inline int grey__follow(grey_loops *g, grey__field *f, grey__place at)
{
    const grey__place begin = at;
    size_t first = g->start[g->loops];
    if (grey__pass(f, &at)) return 1;
    for (;;) {
        if (!grey__grow(g)) return 0;
        grey__point(f, &at, g->xy + 2 * g->corners);
        if (g->corners == first || !grey__same(g->xy + 2 * g->corners, g->xy + 2 * (g->corners - 1))) ++g->corners;
        if (!grey__cross(f, &at)) {
            ++g->open;
            break;
        }
        if (at.row == begin.row && at.column == begin.column && at.way == begin.way) {
            while (g->corners > first + 1 && grey__same(g->xy + 2 * (g->corners - 1), g->xy + 2 * first)) --g->corners;
            if (g->corners - first < 3)
                ++g->collapsed;
            else
                g->start[++g->loops] = g->corners;
            break;
        }
        if (grey__pass(f, &at)) break; /* the rest of an open curve, whose end has been counted */
    }
    g->corners = g->start[g->loops];
    return 1;
}

/* All closed curves at a level of an image with one channel. Whatever comes of it, grey_free gives the memory back. */
static inline int grey_contours(grey_loops *g, const image *im, double level, enum grey_inside inside,
                                image_error *error)
{
    grey__field f;
    grey__place at;
    int side, good;
    memset(g, 0, sizeof *g);
    f.im = im;
    f.level = level;
    f.inside = inside;
    f.passed = (unsigned char *)calloc(im->width * im->height, 1);
    good = f.passed && grey__grow(g);
    if (good) g->start[0] = 0;
    for (at.row = 0; good && at.row < (int64_t)im->height; ++at.row)
        for (at.column = 0; good && at.column < (int64_t)im->width; ++at.column) {
            if (!grey__is_there(&f, at.row, at.column)) continue;
            for (side = 0; good && side < 2; ++side) { /* to the pixel on the right, to the pixel below */
                grey__place from = at;
                int64_t row = at.row + side, column = at.column + 1 - side;
                int here = grey__is_inside(&f, grey__value(&f, at.row, at.column));
                if (!grey__is_there(&f, row, column) || here == grey__is_inside(&f, grey__value(&f, row, column)))
                    continue;
                if (!here) {
                    from.row = row;
                    from.column = column;
                }
                from.way = side == 0 ? (here ? 1 : 3) : (here ? 0 : 2);
                good = grey__follow(g, &f, from);
            }
        }
    free(f.passed);
    return good || image_no_memory(error);
}

#endif
