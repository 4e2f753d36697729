/* regions.h - a label image -> regions: every pixel gets the number of its region, in the order of the labels.

   Region 0 is what is no cell: labels of 0 and below, NaN, and the label named background. */
#ifndef SURFMINK_IMAGE_REGIONS_H
#define SURFMINK_IMAGE_REGIONS_H

#include "image.h"

/* Why a cell has no outline, or what is to be said about it. */
enum region_flag {
    REGION_BORDER = 1,  /* touches the border of the image, where it may be cut off */
    REGION_WINDS = 2,   /* runs round a wrapped image: its outline closes nowhere */
    REGION_PARTS = 4,   /* has several parts */
    REGION_RIM = 8,     /* reaches beyond the positions or normals that are known */
    REGION_FOLD = 16,   /* lies where the chart is folded or torn */
    REGION_FEW = 32,    /* fewer than three corners: of --points junctions, or after welding */
    REGION_TURNED = 64, /* --points junctions: these run the other way round than the cell */
    REGION_DROPPED = 127,
    REGION_HOLES = 128, /* its outer outline is measured */
    REGION_SMALL = 256  /* fewer pixels than REGION_PIXELS */
};

/* Below this size mu_4 and mu_6 of the outline are wrong by .14 and more: see the table in docs/images.md. */
enum { REGION_PIXELS = 20 };

typedef struct regions {
    size_t width, height;
    int wraps;      /* the last column has the first for its neighbour */
    uint32_t *of;   /* height x width: the region of each pixel */
    size_t count;   /* 1 to count - 1 are cells */
    double *label;  /* of each region; whole numbers */
    size_t *pixels; /* of each region */
    uint16_t *flag;
    unsigned char
        *tied; /* height x width, NULL without lines: pixels of a line, as far from one cell as from another */
} regions;

static inline void regions_free(regions *r)
{
    free(r->of);
    free(r->label);
    free(r->pixels);
    free(r->flag);
    free(r->tied);
    memset(r, 0, sizeof *r);
}

/* --- distinct labels ---------------------------------------------------------------------------------------------- */

typedef struct regions__table {
    double *label;   /* in the order of their first pixel; the first is that of region 0 */
    uint32_t *place; /* open addressing: 1 + the index in `label`, 0 where nothing is */
    size_t count, room, places;
} regions__table;

static inline size_t regions__hash(double label, size_t places)
{
    uint64_t z = (uint64_t)(int64_t)label * UINT64_C(0x9e3779b97f4a7c15);
    return (size_t)(z >> 20) & (places - 1);
}

static inline void regions__put(regions__table *t, uint32_t index)
{
    size_t at = regions__hash(t->label[index], t->places);
    while (t->place[at]) at = (at + 1) & (t->places - 1);
    t->place[at] = index + 1;
}

/* Twice the room; the table is at most half full. */
static inline int regions__grow(regions__table *t)
{
    size_t room = t->room ? 2 * t->room : 1024, k;
    double *label = (double *)realloc(t->label, room * sizeof *label);
    if (label) t->label = label;
    free(t->place);
    t->place = label ? (uint32_t *)calloc(2 * room, sizeof *t->place) : NULL;
    if (!t->place) return 0;
    t->room = room;
    t->places = 2 * room;
    for (k = 1; k < t->count; ++k) regions__put(t, (uint32_t)k);
    return 1;
}

/* The index of a label, new or not; 0 if memory has run out. */
static inline uint32_t regions__index(regions__table *t, double label)
{
    size_t at = regions__hash(label, t->places);
    for (; t->place[at]; at = (at + 1) & (t->places - 1))
        if (!(t->label[t->place[at] - 1] < label) && !(t->label[t->place[at] - 1] > label)) return t->place[at] - 1;
    if (t->count == t->room && !regions__grow(t)) return 0;
    t->label[t->count] = label;
    regions__put(t, (uint32_t)t->count);
    return (uint32_t)t->count++;
}

static inline int regions__compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Beyond this, neighbouring whole numbers are one double. */
#define REGIONS_MOST 9007199254740992.0

static inline int regions__check(const image *im, double value, size_t row, size_t column, image_error *error)
{
    if (value != value) return 1; /* a NaN is no cell */
    if (!(value > -REGIONS_MOST && value < REGIONS_MOST))
        return image_fail(error, im->name, "row %lu, column %lu: the label %g is beyond 2^53", (unsigned long)row,
                          (unsigned long)column, value);
    if (value > floor(value))
        return image_fail(error, im->name,
                          "row %lu, column %lu: %.9g is no whole number: labels are wanted, not a grey image",
                          (unsigned long)row, (unsigned long)column, value);
    return 1;
}

/* Are these samples the same, byte for byte? With a size that the compiler knows it needs no call. */
static inline int regions__alike(const unsigned char *a, const unsigned char *b, size_t sample)
{
    switch (sample) {
    case 1: return *a == *b;
    case 2: return memcmp(a, b, 2) == 0;
    case 4: return memcmp(a, b, 4) == 0;
    default: return memcmp(a, b, 8) == 0;
    }
}

/* Fills in `of` by indices into the table. */
static inline int regions__scan(regions *r, const image *im, double background, regions__table *t, image_error *error)
{
    size_t row, column;
    uint32_t index = 0;
    for (row = 0; row < r->height; ++row) {
        const unsigned char *last = NULL, *here = image_at(im, 0, row, 0);
        for (column = 0; column < r->width; ++column, here += im->sample) {
            if (!last || !regions__alike(here, last, im->sample)) { /* neighbours are mostly alike */
                double value = image_value(im, 0, row, column);
                if (!regions__check(im, value, row, column, error)) return 0;
                last = here;
                index = 0;
                if (value > 0 && (value < background || value > background)) {
                    index = regions__index(t, value);
                    if (index == 0) return image_no_memory(error);
                }
            }
            r->of[row * r->width + column] = index;
        }
    }
    return 1;
}

/* From the order of the first pixels to that of the labels. */
static inline int regions__sort(regions *r, const regions__table *t, image_error *error)
{
    size_t k, low, high, middle, pixels = r->width * r->height;
    uint32_t *rank = (uint32_t *)calloc(t->count, sizeof *rank);
    r->count = t->count;
    r->label = (double *)malloc(t->count * sizeof *r->label);
    r->pixels = (size_t *)calloc(t->count, sizeof *r->pixels);
    r->flag = (uint16_t *)calloc(t->count, sizeof *r->flag);
    if (!rank || !r->label || !r->pixels || !r->flag) {
        free(rank);
        return image_no_memory(error);
    }
    memcpy(r->label, t->label, t->count * sizeof *r->label);
    qsort(r->label + 1, t->count - 1, sizeof *r->label, regions__compare);
    for (k = 1; k < t->count; ++k) {
        for (low = 1, high = t->count; high - low > 1;) {
            middle = low + (high - low) / 2;
            if (r->label[middle] > t->label[k])
                high = middle;
            else
                low = middle;
        }
        rank[k] = (uint32_t)low;
    }
    for (k = 0; k < pixels; ++k) r->of[k] = rank[r->of[k]];
    free(rank);
    return 1;
}

/* Regions of a label image, which has one channel. Label `background` is none of a cell. Whatever comes of it,
   regions_free gives the memory back. */
static inline int regions_read(regions *r, const image *im, double background, int wraps, image_error *error)
{
    regions__table t;
    int good;
    memset(r, 0, sizeof *r);
    memset(&t, 0, sizeof t);
    r->width = im->width;
    r->height = im->height;
    r->wraps = wraps;
    r->of = (uint32_t *)malloc(im->width * im->height * sizeof *r->of);
    good = (r->of && regions__grow(&t)) || image_no_memory(error);
    if (good) {
        t.label[0] = 0;
        t.count = 1;
        good = regions__scan(r, im, background, &t, error) && regions__sort(r, &t, error);
    }
    free(t.label);
    free(t.place);
    return good;
}

/* --- lines -------------------------------------------------------------------------------------------------------- */

/* A pixel of a line is at most this far from a cell on each side. The two distances make one more than the line is
   wide: lines of three pixels are shared out whole whatever their slope, those of four only along rows and columns. */
enum { LINES_FAR = 4, LINES_WIDE = 5, LINES_NEAR = 48 }; /* pixels within LINES_FAR */

/* The pixels around one, nearest first. */
static inline void regions__around(int around[LINES_NEAR][2])
{
    int square, x, y, n = 0;
    for (square = 1; square <= LINES_FAR * LINES_FAR; ++square)
        for (y = -LINES_FAR; y <= LINES_FAR; ++y)
            for (x = -LINES_FAR; x <= LINES_FAR; ++x)
                if (x * x + y * y == square) {
                    around[n][0] = x;
                    around[n++][1] = y;
                }
}

/* The column beside the border, or round a wrapped image; width where there is none. */
static inline size_t regions__column(const regions *r, size_t column, int step)
{
    int64_t at = (int64_t)column + step, width = (int64_t)r->width;
    if (r->wraps) at = (at % width + width) % width;
    return at >= 0 && at < width ? (size_t)at : r->width;
}

/* The cell that a pixel of a line goes to, 0 if it belongs to no line: the nearest, of two as near the smaller. */
static inline uint32_t regions__nearest(const regions *r, const uint32_t *of, int around[LINES_NEAR][2], size_t row,
                                        size_t column, int *tied)
{
    uint32_t nearest = 0;
    int k, first = 0, second = 0;
    *tied = 0;
    for (k = 0; k < LINES_NEAR && !second; ++k) {
        int64_t y = (int64_t)row + around[k][1];
        size_t x = regions__column(r, column, around[k][0]);
        int square = around[k][0] * around[k][0] + around[k][1] * around[k][1];
        uint32_t cell = y >= 0 && y < (int64_t)r->height && x < r->width ? of[(size_t)y * r->width + x] : 0;
        if (cell == 0 || cell == nearest) continue;
        if (!first)
            first = square;
        else if (square > first)
            second = square;
        else
            *tied = 1;
        if (!second && (nearest == 0 || cell < nearest)) nearest = cell;
    }
    if (*tied) second = first;
    return second && sqrt((double)first) + sqrt((double)second) <= LINES_WIDE ? nearest : 0;
}

static inline int regions__at_border(const regions *r, size_t row, size_t column)
{
    return row == 0 || row + 1 == r->height || (!r->wraps && (column == 0 || column + 1 == r->width));
}

/* Shares out the pixels of lines of 0 between cells, as watershed and EpySeg leave them; but for those at the border of
   the image, where they would make cells touch it. */
static inline int regions_fill_lines(regions *r, image_error *error)
{
    size_t row, column, pixels = r->width * r->height;
    int around[LINES_NEAR][2], tied;
    uint32_t *filled = (uint32_t *)malloc(pixels * sizeof *filled);
    r->tied = (unsigned char *)calloc(pixels, 1);
    if (!filled || !r->tied) {
        free(filled);
        return image_no_memory(error);
    }
    memcpy(filled, r->of, pixels * sizeof *filled);
    regions__around(around);
    for (row = 0; row < r->height; ++row)
        for (column = 0; column < r->width; ++column) {
            size_t at = row * r->width + column;
            if (r->of[at] || regions__at_border(r, row, column)) continue;
            filled[at] = regions__nearest(r, r->of, around, row, column, &tied);
            r->tied[at] = (unsigned char)(filled[at] && tied);
        }
    free(r->of);
    r->of = filled;
    return 1;
}

/* Does a row of at most two pixels of 0 begin at `at`, behind one cell and before another? `next` leads on, `room`
   pixels are left. */
static inline int regions__parts(const regions *r, size_t at, size_t next, size_t room)
{
    uint32_t before = r->of[at - next], behind = 0;
    if (room > 1) behind = r->of[at + next];
    if (!behind && room > 2) behind = r->of[at + 2 * next];
    return behind && behind != before;
}

/* Is most of the border between cells and 0 that of lines? */
static inline int regions_have_lines(const regions *r)
{
    size_t row, column, sides = 0, lines = 0, at = 0;
    for (row = 0; row < r->height; ++row)
        for (column = 0; column < r->width; ++column, ++at) {
            if (r->of[at]) continue;
            if (column && r->of[at - 1]) ++sides, lines += (size_t)regions__parts(r, at, 1, r->width - column);
            if (row && r->of[at - r->width]) ++sides, lines += (size_t)regions__parts(r, at, r->width, r->height - row);
        }
    return 2 * lines > sides;
}

/* --- counts ------------------------------------------------------------------------------------------------------- */

/* How many pixels each cell has, and which touch the border. */
static inline void regions_count(regions *r)
{
    size_t row, column, k;
    for (row = 0; row < r->height; ++row)
        for (column = 0; column < r->width; ++column) {
            uint32_t cell = r->of[row * r->width + column];
            ++r->pixels[cell];
            if (regions__at_border(r, row, column)) r->flag[cell] |= REGION_BORDER;
        }
    for (k = 1; k < r->count; ++k)
        if (r->pixels[k] < REGION_PIXELS) r->flag[k] |= REGION_SMALL;
}

#endif
