/* image.h - a file in memory -> its pixels. The formats stand in tiff.h, npy.h and pgm.h; read.h tells them apart.

   An image keeps the bytes of its file and decodes a pixel when it is asked for: nothing is copied, and nothing is
   allocated before the file is known to hold every pixel that it announces. C99 and C++, only libc. */
#ifndef SURFMINK_IMAGE_H
#define SURFMINK_IMAGE_H

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum image_kind { IMAGE_UNSIGNED, IMAGE_SIGNED, IMAGE_FLOAT };

typedef struct image {
    const char *name; /* of the file, as the user wrote it */
    unsigned char *bytes;
    size_t size;
    size_t width, height;
    size_t channels;      /* numbers a pixel, be they samples, pages or planes */
    enum image_kind kind; /* of these numbers */
    size_t sample;        /* bytes of one: 1, 2, 4 or 8 */
    int is_big_endian;
    size_t *row;       /* height x planes: where in `bytes` each row begins */
    size_t interleave; /* samples from one pixel to the next: the channels, or 1 where each channel is a plane */
} image;

typedef struct image_error {
    char text[512]; /* a sentence that begins with the file */
} image_error;

/* --- complaints --------------------------------------------------------------------------------------------------- */

/* Bytes of the UTF-8 character at s, 0 if there is none. */
static inline size_t image__character(const unsigned char *s)
{
    size_t i, length = s[0] < 0x80 ? 1 : s[0] < 0xc2 ? 0 : s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : s[0] < 0xf5 ? 4 : 0;
    for (i = 1; i < length; ++i)
        if ((s[i] & 0xc0) != 0x80) return 0;
    return length;
}

/* Text from a file or a command line must not command a terminal: a question mark takes the place of every control
   character, those of 8 bits (C1) included, and of every byte that belongs to no character. */
static inline void image_disarm(char *text)
{
    unsigned char *s = (unsigned char *)text;
    while (*s) {
        size_t length = image__character(s);
        int is_control = *s < 0x20 || *s == 0x7f || (*s == 0xc2 && length == 2 && s[1] < 0xa0);
        if (length == 0 || is_control) {
            *s++ = '?';
            if (is_control && length == 2) *s++ = '?';
        } else
            s += length;
    }
}

/* Notes down what is wrong; returns 0, as does the call that failed. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static inline int
image_fail(image_error *error, const char *name, const char *format, ...)
{
    va_list arguments;
    size_t used;
    snprintf(error->text, sizeof error->text, name ? "%.200s: " : "%.200s", name ? name : "");
    used = strlen(error->text);
    va_start(arguments, format);
    vsnprintf(error->text + used, sizeof error->text - used, format, arguments);
    va_end(arguments);
    image_disarm(error->text);
    return 0;
}

static inline int image_no_memory(image_error *error)
{
    image_fail(error, NULL, "out of memory");
    return 0;
}

/* --- bytes -------------------------------------------------------------------------------------------------------- */

static inline void image_free(image *im)
{
    free(im->bytes);
    free(im->row);
    memset(im, 0, sizeof *im);
}

/* The unsigned integer of `count` bytes, 8 at most, at s. */
static inline uint64_t image_integer(const unsigned char *s, size_t count, int is_big_endian)
{
    uint64_t value = 0;
    size_t i;
    for (i = 0; i < count; ++i) value = value << 8 | s[is_big_endian ? i : count - 1 - i];
    return value;
}

/* Reads all of the file, or if `enough` finds nothing to like in its first bytes, no more than these. Room grows with
   what has been read: the memory taken is at most twice the file. */
static inline int image_load(image *im, const char *name, int (*enough)(const unsigned char *, size_t),
                             image_error *error)
{
    FILE *file = strcmp(name, "-") == 0 ? stdin : fopen(name, "rb");
    size_t room = 65536, count;
    int failed = 0;
    memset(im, 0, sizeof *im);
    im->name = name;
    if (!file) return image_fail(error, name, "%s", strerror(errno));
    im->bytes = (unsigned char *)malloc(room);
    while (im->bytes) {
        count = fread(im->bytes + im->size, 1, room - im->size, file);
        im->size += count;
        if (count == 0 || (im->size >= 8 && enough(im->bytes, im->size))) break;
        if (im->size == room) {
            unsigned char *more = room <= SIZE_MAX / 2 ? (unsigned char *)realloc(im->bytes, 2 * room) : NULL;
            if (!more) free(im->bytes);
            im->bytes = more;
            room *= 2;
        }
    }
    if (!im->bytes)
        failed = !image_no_memory(error);
    else if (ferror(file))
        failed = !image_fail(error, name, "cannot be read: %s", strerror(errno));
    else if (im->size == 0)
        failed = !image_fail(error, name, "the file is empty");
    if (file != stdin) fclose(file);
    return !failed;
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Whether so many samples can be there, and be counted: halves of chains (trace.h), four a pixel at most, have 32-bit
   numbers. */
static inline int image_check_size(const image *im, image_error *error)
{
    size_t most = ((size_t)1 << 30) - 1, pixels;
    if (im->width == 0 || im->height == 0) return image_fail(error, im->name, "an image without pixels");
    if (im->width > most || im->height > most || im->width > most / im->height)
        return image_fail(error, im->name, "%lu x %lu pixels are announced, 2^30 or more: cut the image up",
                          (unsigned long)im->width, (unsigned long)im->height);
    pixels = im->width * im->height;
    if (pixels > im->size || im->channels > im->size / pixels || im->sample > im->size / pixels / im->channels)
        return image_fail(error, im->name,
                          "truncated: %lu x %lu pixels with %lu numbers of %lu bytes do not fit into %lu bytes",
                          (unsigned long)im->width, (unsigned long)im->height, (unsigned long)im->channels,
                          (unsigned long)im->sample, (unsigned long)im->size);
    return 1;
}

/* Rows for planes that stand one behind the other from `start` on; the size has been checked. */
static inline int image_lay_rows(image *im, size_t start, image_error *error)
{
    size_t rows = im->height * (im->channels / im->interleave), k;
    im->row = (size_t *)malloc(rows * sizeof *im->row);
    if (!im->row) return image_no_memory(error);
    for (k = 0; k < rows; ++k) im->row[k] = start + k * im->width * im->interleave * im->sample;
    return 1;
}

/* Where the sample of a pixel stands. */
static inline const unsigned char *image_at(const image *im, size_t channel, size_t row, size_t column)
{
    size_t plane = im->interleave > 1 ? 0 : channel;
    return im->bytes + im->row[plane * im->height + row] +
           (column * im->interleave + (im->interleave > 1 ? channel : 0)) * im->sample;
}

static inline double image_value(const image *im, size_t channel, size_t row, size_t column)
{
    uint64_t bits = image_integer(image_at(im, channel, row, column), im->sample, im->is_big_endian), sign;
    double d;
    if (im->kind == IMAGE_FLOAT && im->sample == 4) {
        uint32_t half = (uint32_t)bits;
        float f;
        memcpy(&f, &half, sizeof f);
        return (double)f;
    }
    if (im->kind == IMAGE_FLOAT) {
        memcpy(&d, &bits, sizeof d);
        return d;
    }
    sign = (uint64_t)1 << (8 * im->sample - 1);
    if (im->kind == IMAGE_SIGNED && (bits & sign)) return -(double)((~bits & (sign - 1)) + 1);
    return (double)bits;
}

#endif
