/* grey.h - a grey image -> the curves where it has a given value, in the plane or on a chart.

   MARCHING SQUARES: the corners of a square are the centres of four pixels that touch. A curve crosses a side of it
   where the value lies between those at its ends, which is interpolated; inside the square it is straight. Of a square
   with two opposite corners inside, the bilinear saddle tells which are connected. Squares are not cut into triangles:
   on sharp images that leaves a bias which does not shrink with the pixels.

   In the picture x = column and y = -row. The surface consists of the squares whose pixels all have a value and, on a
   chart, a position and a normal. Where the chart is folded, so that a square shows the other side of the surface than
   its neighbour does, the surface ends between them; a square that shows no side is a hole. Curves that end there or at
   the border are open: see contour.h. Time and memory are linear. */
#ifndef SURFMINK_IMAGE_GREY_H
#define SURFMINK_IMAGE_GREY_H

#include "../surfaces/contour.h"
#include "chart.h"

/* What is known of a square; that of a pixel is the one to its lower right. */
enum {
    GREY_ENTERED = 1,       /* times 2^way: a curve has come in, moving that way */
    GREY_WALKED = 16,       /* times 2^way: a loop has gone along that side, which is at the boundary */
    GREY_OUTSIDE = 256,     /* the chart shows it as seen from outside; so it is in the plane */
    GREY_MIRRORED = 512,    /* the chart shows it mirrored */
    GREY_IS_THERE = 3 * 256 /* one of the two */
};

typedef struct grey {
    const image *im;    /* with one channel */
    const chart *space; /* NULL: in the plane, */
    double spacing[2];  /* where pixels have this width and height */
    double largest;     /* coordinate, from grey_begin */
    size_t holes;       /* pixels without a value, a position or a normal, from grey_begin */
    uint16_t *square;
} grey;

/* The ways, and the steps that they take: right, up, left, down. What lies to the left of a way is the next one.
   A square has its sides in this order, seen with the square on the left, and its corner k is where side k begins. */
static const int grey__row[4] = {0, -1, 0, 1}, grey__column[4] = {1, 0, -1, 0};
static const size_t grey__corner_row[4] = {1, 1, 0, 0}, grey__corner_column[4] = {0, 1, 1, 0};

static inline void grey_free(grey *g)
{
    free(g->square);
    g->square = NULL;
}

static inline double grey__value(const grey *g, size_t row, size_t column)
{
    return image_value(g->im, 0, row, column);
}

/* --- squares ------------------------------------------------------------------------------------------------------ */

/* Has the pixel a value, and a place? */
static inline int grey__is_known(grey *g, size_t row, size_t column)
{
    double x[3], n[3];
    int k;
    if (!(fabs(grey__value(g, row, column)) <= 1e300)) return 0;
    if (!g->space) return 1;
    if (!chart_pixel(g->space, row, column, x, n)) return 0;
    for (k = 0; k < 3; ++k) g->largest = fmax(g->largest, fabs(x[k]));
    return 1;
}

/* Finds the squares. The members before `largest` are filled in by the caller. */
static inline int grey_begin(grey *g, image_error *error)
{
    size_t width = g->im->width, height = g->im->height, row, column, k;
    double normal[3];
    int side;
    g->holes = 0;
    g->largest = g->space ? 0 : fmax((double)width * g->spacing[0], (double)height * g->spacing[1]);
    g->square = (uint16_t *)calloc(width * height, sizeof *g->square);
    if (!g->square) return image_no_memory(error);
    for (row = 0; row < height; ++row)
        for (column = 0; column < width; ++column) { /* first 1 for a pixel that is known */
            g->square[row * width + column] = (uint16_t)grey__is_known(g, row, column);
            g->holes += !g->square[row * width + column];
        }
    for (row = 0; row < height; ++row)
        for (column = 0; column < width; ++column) {
            uint16_t *square = &g->square[row * width + column];
            int is_there = row + 1 < height && column + 1 < width;
            for (k = 0; is_there && k < 4; ++k)
                is_there = square[grey__corner_row[k] * width + grey__corner_column[k]] != 0;
            side = 1;
            if (is_there && g->space && !chart_corner(g->space, row + 1, column + 1, normal, &side)) side = 0;
            *square = (uint16_t)(!is_there || side == 0 ? 0 : side > 0 ? GREY_OUTSIDE : GREY_MIRRORED);
        }
    return 1;
}

/* The point of the surface at a point of the picture. */
static inline int grey__point(const grey *g, double column, double row, double x[3], double n[3], image_error *error)
{
    if (g->space)
        return chart_point(g->space, column, -row, x, n) ||
               image_fail(error, g->im->name, "at row %.6g, column %.6g (from 0) the normals cancel", row, column);
    x[0] = column * g->spacing[0];
    x[1] = -row * g->spacing[1];
    x[2] = n[0] = n[1] = 0;
    n[2] = 1;
    return 1;
}

/* --- a level ------------------------------------------------------------------------------------------------------ */

/* A level set under construction. */
typedef struct grey__trace {
    const grey *g;
    double level;
    int how;
    contour_trace loops;
    contour_parts parts; /* with CONTOUR_PARTS, of the corners of squares */
    image_error *error;
} grey__trace;

/* Where a curve is: about to enter a square across a side, with the inside on its left. (row, column) is the pixel at
   the left end of the side. */
typedef struct grey__place {
    size_t row, column;
    int way;
} grey__place;

static inline void grey__step(size_t *row, size_t *column, int way)
{
    *row += (size_t)grey__row[way % 4]; /* -1 wraps round, and so does a row above the first */
    *column += (size_t)grey__column[way % 4];
}

static inline int grey__is_inside(const grey__trace *t, double value)
{
    return (value >= t->level) == ((t->how & CONTOUR_ABOVE) != 0);
}

static inline int grey__is_pixel_inside(const grey__trace *t, size_t row, size_t column)
{
    return grey__is_inside(t, grey__value(t->g, row, column));
}

/* The number of the square ahead of a place; CONTOUR_NONE if there is none. */
static inline size_t grey__ahead(const grey *g, grey__place at)
{
    size_t row = at.row, column = at.column;
    grey__step(&row, &column, at.way);
    grey__step(&row, &column, at.way + 3); /* the corner opposite to (at.row, at.column) */
    if (row >= g->im->height || column >= g->im->width) return CONTOUR_NONE;
    if (row > at.row) row = at.row;
    if (column > at.column) column = at.column;
    return g->square[row * g->im->width + column] & GREY_IS_THERE ? row * g->im->width + column : CONTOUR_NONE;
}

/* Does the surface go on from a square into the one ahead of a place? */
static inline int grey__goes_on(const grey *g, size_t square, grey__place at)
{
    size_t ahead = grey__ahead(g, at);
    return ahead != CONTOUR_NONE && (g->square[ahead] & GREY_IS_THERE) == (g->square[square] & GREY_IS_THERE);
}

/* The place from which a square is entered across its side k. */
static inline grey__place grey__entry(const grey *g, size_t square, size_t k)
{
    grey__place at;
    at.row = square / g->im->width + grey__corner_row[k];
    at.column = square % g->im->width + grey__corner_column[k];
    at.way = (int)(k + 1) % 4;
    return at;
}

/* The same side, entered from the square: the place behind a place. */
static inline grey__place grey__behind(grey__place at)
{
    grey__step(&at.row, &at.column, at.way + 3);
    at.way = (at.way + 2) % 4;
    return at;
}

/* Of a square with two opposite corners at the level or above it, a and d, and two below, b and c: are the first two
   connected over the saddle, level + (ad - bc) / (a + d - b - c)? If not, the other two are. */
static inline int grey__joins_above(double level, double a, double b, double c, double d)
{
    double most;
    a -= level, b -= level, c -= level, d -= level;
    most = fmax(fmax(fabs(a), fabs(b)), fmax(fabs(c), fabs(d)));
    return (a / most) * (d / most) >= (b / most) * (c / most); /* no overflow, and none vanishes that counts */
}

static inline int grey__joins_inside(const grey__trace *t, double inside, double out, double other_out, double other)
{
    return t->how & CONTOUR_ABOVE ? grey__joins_above(t->level, inside, out, other_out, other)
                                  : !grey__joins_above(t->level, out, inside, other, other_out);
}

/* Crosses the square ahead. Its corners: `left` and `right` of the side, `far_left` and `far_right` beyond them. */
static inline void grey__cross(const grey__trace *t, grey__place *at)
{
    size_t row[3], column[3]; /* of right, far left, far right */
    double left, right, far_left, far_right;
    int turn_left, turn_right, k;
    for (k = 0; k < 3; ++k) row[k] = at->row, column[k] = at->column;
    grey__step(&row[0], &column[0], at->way + 3);
    grey__step(&row[1], &column[1], at->way);
    row[2] = row[0], column[2] = column[0];
    grey__step(&row[2], &column[2], at->way);
    left = grey__value(t->g, at->row, at->column);
    right = grey__value(t->g, row[0], column[0]);
    far_left = grey__value(t->g, row[1], column[1]);
    far_right = grey__value(t->g, row[2], column[2]);
    turn_left = !grey__is_inside(t, far_left);
    turn_right = grey__is_inside(t, far_right);
    if (turn_left && turn_right) turn_left = !grey__joins_inside(t, left, right, far_left, far_right);
    if (turn_left)
        at->way = (at->way + 1) % 4; /* the same pixel is to the left */
    else if (turn_right) {
        at->row = row[2];
        at->column = column[2];
        at->way = (at->way + 3) % 4;
    } else {
        at->row = row[1];
        at->column = column[1];
    }
}

/* --- following curves --------------------------------------------------------------------------------------------- */

/* How far the level is on the way from one value to another. */
static inline double grey__fraction(double from, double to, double level)
{
    return (level - from) / (to - from);
}

static inline int grey__add(grey__trace *t, double column, double row)
{
    double x[3], n[3];
    return grey__point(t->g, column, row, x, n, t->error) &&
           (contour_add(&t->loops, x, n) || image_no_memory(t->error));
}

/* The point on the side. */
static inline int grey__add_cut(grey__trace *t, grey__place at)
{
    const grey__place end = grey__behind(at); /* its pixel is at the right end */
    double part =
        grey__fraction(grey__value(t->g, at.row, at.column), grey__value(t->g, end.row, end.column), t->level);
    return grey__add(t, (double)at.column + part * ((double)end.column - (double)at.column),
                     (double)at.row + part * ((double)end.row - (double)at.row));
}

/* The part at a pixel that is a corner of the square. */
static inline size_t grey__part(const grey__trace *t, size_t square, size_t row, size_t column)
{
    static const size_t corner[2][2] = {{3, 2}, {0, 1}};
    size_t width = t->g->im->width;
    return t->parts.part[4 * square + corner[row - square / width][column - square % width]];
}

/* Walks along the boundary from a pixel, where it has come to going `way` with the square on its left, up to the next
   pixel; which square it then has on its left. On a point where two squares touch it stays with the first. */
static inline int grey__along(grey__trace *t, grey__place *at, size_t *square)
{
    const grey *g = t->g;
    int turn = 1;
    grey__place beyond;
    if (!grey__add(t, (double)at->column, (double)at->row)) return 0;
    for (;; --turn) { /* left, straight on, right: the first side with nothing beyond it */
        beyond = *at;
        grey__step(&beyond.row, &beyond.column, at->way + turn + 4);
        beyond.way = (at->way + turn + 3) % 4; /* across the side, to the right of it */
        if (!grey__goes_on(g, *square, beyond)) break;
        *square = grey__ahead(g, beyond);
    }
    at->way = (at->way + turn + 4) % 4;
    return 1;
}

/* A side at the boundary: marks it, and goes to its end. */
static inline void grey__pass(grey__trace *t, grey__place *at, size_t square)
{
    t->g->square[square] |= (uint16_t)(GREY_WALKED << at->way);
    grey__step(&at->row, &at->column, at->way);
}

static inline int grey__close(grey__trace *t, size_t square)
{
    size_t loops = t->loops.out->loops;
    if (!contour_close(&t->loops)) return image_no_memory(t->error);
    if (t->loops.out->loops > loops && (t->g->square[square] & GREY_MIRRORED)) contour_reverse(t->loops.out, loops);
    return 1;
}

/* Follows a curve from a place until it is back, or ends; there it goes on along the boundary, if curves are to be
   closed, to where the next one comes in. */
static inline int grey__follow(grey__trace *t, grey__place begin)
{
    const grey *g = t->g;
    grey__place at = begin, end;
    size_t square;
    do {
        square = grey__ahead(g, at);
        end = grey__behind(at);
        g->square[square] |= (uint16_t)(GREY_ENTERED << at.way);
        if (!grey__add_cut(t, at)) return 0;
        if (t->parts.part && !contour_between(&t->loops, grey__part(t, square, at.row, at.column),
                                              grey__part(t, square, end.row, end.column)))
            return image_no_memory(t->error);
        grey__cross(t, &at);
        if (grey__goes_on(g, square, at)) continue;
        if (!(t->how & CONTOUR_CLOSE)) return contour_leave_out(&t->loops), 1;
        ++t->loops.out->closed;
        if (!grey__add_cut(t, at)) return 0;
        at.way = (at.way + 1) % 4; /* along the side, to its left end, where it is */
        for (;;) {
            size_t row, column;
            if (!grey__along(t, &at, &square)) return 0;
            row = at.row, column = at.column;
            grey__step(&row, &column, at.way);
            if (!grey__is_pixel_inside(t, row, column)) break;
            grey__pass(t, &at, square);
        }
        at.way = (at.way + 1) % 4; /* into the square */
    } while (at.row != begin.row || at.column != begin.column || at.way != begin.way);
    return grey__close(t, square);
}

/* Follows a boundary that lies inside as a whole. */
static inline int grey__follow_boundary(grey__trace *t, size_t square, size_t side)
{
    size_t begin = square;
    grey__place at = grey__entry(t->g, square, side);
    at.way = (int)side;
    if (t->parts.part && !contour_between(&t->loops, grey__part(t, square, at.row, at.column), CONTOUR_NONE))
        return image_no_memory(t->error);
    do {
        grey__pass(t, &at, square);
        if (!grey__along(t, &at, &square)) return 0;
    } while (square != begin || at.way != (int)side);
    return grey__close(t, square);
}

/* All curves: those from the boundary first, then the rest closes; then boundaries without a curve. */
static inline int grey__follow_all(grey__trace *t)
{
    const grey *g = t->g;
    size_t width = g->im->width, square, k;
    int round, inside[4];
    for (round = 0; round < (t->how & CONTOUR_CLOSE ? 3 : 2); ++round)
        for (square = 0; square < width * (g->im->height - 1); ++square) {
            if (!(g->square[square] & GREY_IS_THERE)) continue;
            for (k = 0; k < 4; ++k)
                inside[k] = grey__is_pixel_inside(t, square / width + grey__corner_row[k],
                                                  square % width + grey__corner_column[k]);
            for (k = 0; k < 4; ++k) {
                grey__place at = grey__entry(g, square, k);
                int is_boundary, good = 1;
                if (!inside[k] || inside[(k + 1) % 4] != (round == 2)) continue;
                is_boundary = round == 1 || !grey__goes_on(g, square, grey__behind(at));
                if (round < 2 && is_boundary && !(g->square[square] & GREY_ENTERED << at.way))
                    good = grey__follow(t, at);
                if (round == 2 && is_boundary && !(g->square[square] & GREY_WALKED << k))
                    good = grey__follow_boundary(t, square, k);
                if (!good) return 0;
            }
        }
    return 1;
}

/* --- parts and areas ---------------------------------------------------------------------------------------------- */

static inline int grey__joins(const grey__trace *t, const double value[4], const int inside[4])
{
    return inside[0] ? grey__joins_inside(t, value[0], value[1], value[3], value[2])
                     : grey__joins_inside(t, value[1], value[0], value[2], value[3]);
}

/* The corners of a square: values, whether they are inside, and whether opposite ones alternate. */
static inline int grey__look(const grey__trace *t, size_t square, double value[4], int inside[4])
{
    size_t width = t->g->im->width, k;
    for (k = 0; k < 4; ++k) {
        value[k] = grey__value(t->g, square / width + grey__corner_row[k], square % width + grey__corner_column[k]);
        inside[k] = grey__is_inside(t, value[k]);
    }
    return inside[0] == inside[2] && inside[1] == inside[3] && inside[0] != inside[1];
}

/* Corners of a square on the same side of the level are one part, unless a saddle keeps them apart, and so are those of
   its neighbours at the same pixels. */
static inline int grey__make_parts(grey__trace *t)
{
    const grey *g = t->g;
    size_t width = g->im->width, squares = width * (g->im->height - 1), square, k;
    double value[4];
    int inside[4], is_saddle;
    if (!contour_parts_begin(&t->parts, 4 * squares)) return image_no_memory(t->error);
    for (square = 0; square < squares; ++square) {
        uint32_t *part = t->parts.part;
        if (!(g->square[square] & GREY_IS_THERE)) continue;
        is_saddle = grey__look(t, square, value, inside);
        for (k = 0; k < 4; ++k)
            if (inside[k] == inside[(k + 1) % 4]) contour_unite(part, 4 * square + k, 4 * square + (k + 1) % 4);
        if (is_saddle) {
            k = grey__joins(t, value, inside) == inside[0] ? 0 : 1;
            contour_unite(part, 4 * square + k, 4 * square + k + 2);
        }
        for (k = 0; k < 2; ++k) /* the neighbours below and on the right */
            if (grey__goes_on(g, square, grey__behind(grey__entry(g, square, k)))) {
                size_t next = 4 * (square + (k == 0 ? width : 1));
                contour_unite(part, 4 * square + k, next + (k == 0 ? 3 : 0));
                contour_unite(part, 4 * square + k + 1, next + (k == 0 ? 2 : 3));
            }
    }
    return contour_number(&t->parts) || image_no_memory(t->error);
}

/* A piece of a square: points of the surface, seen from the first. */
typedef struct grey__piece {
    double first[3], last[3], twice[3];
    size_t count;
} grey__piece;

static inline int grey__add_to_piece(const grey__trace *t, grey__piece *piece, double column, double row)
{
    double x[3], n[3], cross[3];
    int k;
    if (!grey__point(t->g, column, row, x, n, t->error)) return 0;
    for (k = 0; k < 3; ++k) {
        if (piece->count == 0) piece->first[k] = x[k], piece->twice[k] = 0;
        x[k] -= piece->first[k];
    }
    if (piece->count > 1) chart_cross(piece->last, x, cross);
    for (k = 0; k < 3; ++k) {
        if (piece->count > 1) piece->twice[k] += cross[k];
        piece->last[k] = x[k];
    }
    ++piece->count;
    return 1;
}

static inline double grey__area(const grey__piece *piece)
{
    return hypot(hypot(piece->twice[0], piece->twice[1]), piece->twice[2]) / 2;
}

/* The point of a square at its corner k or, with a part of the way, towards the next corner. */
static inline int grey__add_point(const grey__trace *t, grey__piece *piece, size_t square, size_t k, double part)
{
    size_t width = t->g->im->width, row = square / width + grey__corner_row[k];
    size_t column = square % width + grey__corner_column[k];
    return grey__add_to_piece(t, piece, (double)column + part * grey__column[k], (double)row + part * grey__row[k]);
}

/* The pieces of a square on one side of the level. Sets area[k] for a corner k that has a piece of its own, or is the
   first of its piece, and 0 for the others. */
static inline int grey__pieces(const grey__trace *t, size_t square, int side, double area[4])
{
    double value[4], cut[4];
    int inside[4], is_saddle = grey__look(t, square, value, inside), is_apart, good = 1;
    size_t k, owner = 4;
    grey__piece piece;
    is_apart = is_saddle && grey__joins(t, value, inside) != side;
    memset(&piece, 0, sizeof piece);
    for (k = 0; k < 4; ++k) {
        area[k] = 0;
        cut[k] = inside[k] != inside[(k + 1) % 4] ? grey__fraction(value[k], value[(k + 1) % 4], t->level) : 0;
    }
    for (k = 0; good && k < 4; ++k) {
        if (is_apart && inside[k] == side) {
            piece.count = 0;
            good = grey__add_point(t, &piece, square, (k + 3) % 4, cut[(k + 3) % 4]);
        }
        if (inside[k] == side) good = good && grey__add_point(t, &piece, square, k, 0);
        if (inside[k] == side && owner == 4) owner = k;
        if (inside[k] != inside[(k + 1) % 4] && (!is_apart || inside[k] == side))
            good = good && grey__add_point(t, &piece, square, k, cut[k]);
        if (is_apart && inside[k] == side) area[k] = grey__area(&piece);
    }
    if (!is_apart && owner < 4) area[owner] = grey__area(&piece);
    return good;
}

/* The area of the inside, and those of all parts. */
static inline int grey__sum_areas(grey__trace *t)
{
    const grey *g = t->g;
    size_t squares = g->im->width * (g->im->height - 1), square, k;
    double sum[2] = {0, 0}, area[4];
    int side;
    for (square = 0; square < squares; ++square)
        for (side = t->parts.part ? 0 : 1; side < 2 && (g->square[square] & GREY_IS_THERE); ++side) {
            if (!grey__pieces(t, square, side, area)) return 0;
            for (k = 0; k < 4; ++k) {
                if (side) contour_sum(sum, area[k]);
                if (t->parts.part) t->parts.area[t->parts.part[4 * square + k]] += area[k];
            }
        }
    t->loops.out->area = sum[0] + sum[1];
    return 1;
}

/* Cuts the image at a level, which is finite, after grey_begin. `how` is as in contour.h. Whatever comes of it,
   contours_free gives the memory back. */
static inline int grey_level_set(const grey *g, double level, int how, contours *out, image_error *error)
{
    grey__trace t;
    size_t k;
    int good;
    memset(&t, 0, sizeof t);
    t.g = g;
    t.level = level;
    t.how = how;
    t.error = error;
    for (k = 0; k < g->im->width * g->im->height; ++k) g->square[k] &= GREY_IS_THERE;
    good = contour_trace_begin(&t.loops, out, 1e-12 * g->largest) || image_no_memory(error);
    if (good && (how & CONTOUR_PARTS)) good = grey__make_parts(&t);
    good = good && grey__sum_areas(&t) && grey__follow_all(&t);
    if (good && (how & CONTOUR_PARTS)) good = contour_enclose(&t.loops, &t.parts) || image_no_memory(error);
    contour_parts_free(&t.parts);
    contour_trace_end(&t.loops);
    return good;
}

#endif
