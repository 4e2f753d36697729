/* tiff.h - TIFF without compression: strips, both byte orders, integers of 8 to 64 bits, floats of 32 and 64; colours
   as samples, planes or pages.

   A header points to the directory of the first page, each directory to the next; a directory lists tags, and two of
   these say where in the file the strips of rows are. */
#ifndef SURFMINK_IMAGE_TIFF_H
#define SURFMINK_IMAGE_TIFF_H

#include "image.h"

enum { TIFF_PAGES = 4 }; /* one more than any map has: the fourth is refused, whatever follows it */

enum tiff__tag {
    TIFF_WIDTH = 256,
    TIFF_HEIGHT = 257,
    TIFF_BITS = 258,
    TIFF_COMPRESSION = 259,
    TIFF_FILL_ORDER = 266,
    TIFF_STRIPS = 273,
    TIFF_ORIENTATION = 274,
    TIFF_SAMPLES = 277,
    TIFF_STRIP_ROWS = 278,
    TIFF_STRIP_BYTES = 279,
    TIFF_PLANAR = 284,
    TIFF_TILE_WIDTH = 322,
    TIFF_TILES = 324,
    TIFF_FORMAT = 339
};

/* The values of one tag: `count` of them, each of `bytes` bytes, at `at` in the file. */
typedef struct tiff__values {
    size_t count, bytes, at;
} tiff__values;

typedef struct tiff__page {
    size_t width, height, samples, strip_rows, compression, bits, format, is_planar, is_tiled, fill_order, orientation;
    tiff__values strip, strip_bytes;
} tiff__page;

static inline size_t tiff__integer(const image *im, size_t at, size_t bytes)
{
    return (size_t)image_integer(im->bytes + at, bytes, im->is_big_endian);
}

static inline size_t tiff__value(const image *im, const tiff__values *values, size_t k)
{
    return tiff__integer(im, values->at + k * values->bytes, values->bytes);
}

/* The 12 bytes of a directory at `at`: tag, type, count, and the values or where they are. */
static inline int tiff__entry(const image *im, size_t at, size_t *tag, tiff__values *values, image_error *error)
{
    size_t type = tiff__integer(im, at + 2, 2);
    *tag = tiff__integer(im, at, 2);
    values->bytes = type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 0; /* 0: no unsigned integers */
    values->count = tiff__integer(im, at + 4, 4);
    values->at = at + 8;
    if (values->bytes == 0 || values->count == 0) return 1;
    if (values->count > 4 / values->bytes) values->at = tiff__integer(im, at + 8, 4);
    if (values->at > im->size || values->count > (im->size - values->at) / values->bytes)
        return image_fail(error, im->name, "truncated: tag %lu of the TIFF points outside the file",
                          (unsigned long)*tag);
    return 1;
}

/* The one value of a tag that has one for each sample: it must be the same for all. */
static inline int tiff__same(const image *im, const tiff__values *values, size_t *value, image_error *error)
{
    size_t k;
    *value = tiff__value(im, values, 0);
    for (k = 1; k < values->count; ++k)
        if (tiff__value(im, values, k) != *value)
            return image_fail(error, im->name, "the channels of this TIFF have numbers of different types");
    return 1;
}

static inline int tiff__keep(const image *im, tiff__page *page, size_t tag, const tiff__values *values,
                             image_error *error)
{
    size_t first;
    if (tag == TIFF_TILE_WIDTH || tag == TIFF_TILES) page->is_tiled = 1;
    if (values->bytes == 0 || values->count == 0) return 1;
    first = tiff__value(im, values, 0);
    switch (tag) {
    case TIFF_WIDTH: page->width = first; break;
    case TIFF_HEIGHT: page->height = first; break;
    case TIFF_BITS: return tiff__same(im, values, &page->bits, error);
    case TIFF_FORMAT: return tiff__same(im, values, &page->format, error);
    case TIFF_COMPRESSION: page->compression = first; break;
    case TIFF_FILL_ORDER: page->fill_order = first; break;
    case TIFF_ORIENTATION: page->orientation = first; break;
    case TIFF_SAMPLES: page->samples = first; break;
    case TIFF_STRIP_ROWS: page->strip_rows = first; break;
    case TIFF_PLANAR: page->is_planar = first == 2; break;
    case TIFF_STRIPS: page->strip = *values; break;
    case TIFF_STRIP_BYTES: page->strip_bytes = *values; break;
    default: break;
    }
    return 1;
}

/* The directory at `at`; *next is where the following one is, 0 after the last. */
static inline int tiff__directory(const image *im, size_t at, tiff__page *page, size_t *next, image_error *error)
{
    size_t entries, k, tag;
    tiff__values values;
    memset(page, 0, sizeof *page);
    page->compression = page->samples = page->bits = page->format = page->fill_order = page->orientation = 1;
    page->strip_rows = SIZE_MAX;
    if (at < 8 || at > im->size - 2)
        return image_fail(error, im->name, "truncated: a directory of the TIFF lies outside the file");
    entries = tiff__integer(im, at, 2);
    if (im->size - at - 2 < 4 || entries > (im->size - at - 2 - 4) / 12)
        return image_fail(error, im->name, "truncated: a directory of the TIFF reaches beyond the end of the file");
    for (k = 0; k < entries; ++k)
        if (!tiff__entry(im, at + 2 + 12 * k, &tag, &values, error) || !tiff__keep(im, page, tag, &values, error))
            return 0;
    *next = tiff__integer(im, at + 2 + 12 * entries, 4);
    return 1;
}

/* Can these pixels be read? */
static inline int tiff__check_page(const image *im, const tiff__page *page, image_error *error)
{
    static const char *const remedy =
        "; save it plainly: tifffile.imwrite(name, image) in Python, or File > Save As > Tiff in ImageJ";
    if (page->is_tiled) return image_fail(error, im->name, "a tiled TIFF%s", remedy);
    if (page->compression != 1)
        return image_fail(error, im->name, "a compressed TIFF (scheme %lu)%s", (unsigned long)page->compression,
                          remedy);
    if (page->format == 3 ? page->bits != 32 && page->bits != 64
                          : page->bits != 8 && page->bits != 16 && page->bits != 32 && page->bits != 64)
        return image_fail(error, im->name, "a TIFF with %s of %lu bits%s", page->format == 3 ? "floats" : "numbers",
                          (unsigned long)page->bits, remedy);
    if (page->format < 1 || page->format > 3)
        return image_fail(error, im->name, "a TIFF with numbers that are neither integers nor floats (format %lu)%s",
                          (unsigned long)page->format, remedy);
    if (page->fill_order != 1) return image_fail(error, im->name, "a TIFF with its bits in reverse order%s", remedy);
    if (page->orientation != 1)
        return image_fail(error, im->name, "a TIFF whose first row is not the top one (Orientation %lu)%s",
                          (unsigned long)page->orientation, remedy);
    if (page->samples == 0) return image_fail(error, im->name, "a TIFF without channels");
    if (page->strip_rows == 0) return image_fail(error, im->name, "a TIFF with strips of no rows");
    if (page->strip.bytes == 0) return image_fail(error, im->name, "a TIFF that does not say where its strips are");
    return 1;
}

/* Where the rows of page number `first` begin; each strip has to lie in the file. */
static inline int tiff__lay_strips(image *im, const tiff__page *page, size_t first, image_error *error)
{
    size_t planes = page->is_planar ? page->samples : 1, plane, strip = 0, row, rows, k, at, bytes;
    size_t width = im->width * im->sample * (page->is_planar ? 1 : page->samples);
    for (plane = 0; plane < planes; ++plane)
        for (row = 0; row < im->height; row += rows, ++strip) {
            rows = im->height - row < page->strip_rows ? im->height - row : page->strip_rows;
            if (strip == page->strip.count) return image_fail(error, im->name, "truncated: the TIFF lacks strips");
            at = tiff__value(im, &page->strip, strip);
            bytes = strip < page->strip_bytes.count ? tiff__value(im, &page->strip_bytes, strip) : rows * width;
            if (bytes < rows * width || at > im->size || rows * width > im->size - at)
                return image_fail(error, im->name, "truncated: strip %lu of the TIFF is not all there",
                                  (unsigned long)strip);
            for (k = 0; k < rows; ++k) im->row[(first + plane) * im->height + row + k] = at + k * width;
        }
    return 1;
}

/* The directories, four at most; how many of them. */
static inline size_t tiff__pages(const image *im, tiff__page *page, image_error *error)
{
    size_t place[TIFF_PAGES], next = tiff__integer(im, 4, 4), pages, k;
    for (pages = 0; pages < TIFF_PAGES && (next || pages == 0); ++pages) {
        for (k = 0; k < pages; ++k)
            if (place[k] == next) {
                image_fail(error, im->name, "the directories of the TIFF run in a loop");
                return 0;
            }
        place[pages] = next;
        if (!tiff__directory(im, next, &page[pages], &next, error) || !tiff__check_page(im, &page[pages], error))
            return 0;
    }
    return pages;
}

static inline int tiff_read(image *im, image_error *error)
{
    tiff__page page[TIFF_PAGES];
    size_t pages, k;
    im->is_big_endian = im->bytes[0] == 'M';
    if (tiff__integer(im, 2, 2) == 43)
        return image_fail(error, im->name, "a BigTIFF; in Python: tifffile.imwrite(name, image, bigtiff=False)");
    pages = tiff__pages(im, page, error);
    if (pages == 0) return 0;
    for (k = 1; k < pages; ++k)
        if (page[k].width != page[0].width || page[k].height != page[0].height || page[k].bits != page[0].bits ||
            page[k].format != page[0].format || page[k].samples != page[0].samples)
            return image_fail(error, im->name, "the pages of this TIFF differ in size or type");
    if (pages > 1 && page[0].samples > 1)
        return image_fail(error, im->name, "a TIFF of several pages with %lu channels each",
                          (unsigned long)page[0].samples);
    if (pages == TIFF_PAGES)
        return image_fail(error, im->name, "a TIFF of more than 3 pages: one image is wanted, or a map of 3 pages");
    im->width = page[0].width;
    im->height = page[0].height;
    im->channels = pages * page[0].samples;
    im->sample = page[0].bits / 8;
    im->kind = page[0].format == 3 ? IMAGE_FLOAT : page[0].format == 2 ? IMAGE_SIGNED : IMAGE_UNSIGNED;
    im->interleave = page[0].is_planar ? 1 : page[0].samples;
    if (!image_check_size(im, error)) return 0;
    im->row = (size_t *)malloc(im->height * (im->channels / im->interleave) * sizeof *im->row);
    if (!im->row) return image_no_memory(error);
    for (k = 0; k < pages; ++k)
        if (!tiff__lay_strips(im, &page[k], k, error)) return 0;
    return 1;
}

#endif
