/* pgm.h - PGM, the plainest of image formats: P2 (numbers as text) and P5 (bytes, or two of them for each pixel). */
#ifndef SURFMINK_IMAGE_PGM_H
#define SURFMINK_IMAGE_PGM_H

#include "image.h"

static inline int pgm_is_blank(unsigned char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

/* The number behind blanks and comments at *at, which moves behind it; 0 if there is none or it is absurd. */
static inline int pgm_number(const image *im, size_t *at, size_t *number)
{
    size_t begin;
    while (*at < im->size && (pgm_is_blank(im->bytes[*at]) || im->bytes[*at] == '#')) {
        if (im->bytes[*at] == '#')
            while (*at < im->size && im->bytes[*at] != '\n' && im->bytes[*at] != '\r') ++*at;
        else
            ++*at;
    }
    begin = *at;
    for (*number = 0; *at < im->size && im->bytes[*at] >= '0' && im->bytes[*at] <= '9'; ++*at) {
        if (*number > 100000000) return 0;
        *number = 10 * *number + (size_t)(im->bytes[*at] - '0');
    }
    return *at > begin;
}

/* P2: the numbers take the place of their text, two bytes each. A number and the blank behind it are two bytes at
   least, so none is overwritten before it has been read. */
static inline int pgm_pack_text(image *im, size_t at, size_t maximum, image_error *error)
{
    size_t count = im->width * im->height, k, value;
    for (k = 0; k < count; ++k) {
        if (!pgm_number(im, &at, &value))
            return image_fail(error, im->name,
                              at < im->size ? "pixel %lu of %lu is not a number"
                                            : "truncated: %lu numbers, and there are %lu pixels",
                              (unsigned long)k, (unsigned long)count);
        if (at < im->size && !pgm_is_blank(im->bytes[at]) && im->bytes[at] != '#')
            return image_fail(error, im->name, "pixel %lu of %lu is not a number", (unsigned long)k,
                              (unsigned long)count);
        if (value > maximum)
            return image_fail(error, im->name, "pixel %lu is %lu, above the maximum %lu that the file names",
                              (unsigned long)k, (unsigned long)value, (unsigned long)maximum);
        im->bytes[2 * k] = (unsigned char)(value >> 8);
        im->bytes[2 * k + 1] = (unsigned char)(value & 255);
    }
    if (pgm_number(im, &at, &value) || at < im->size)
        return image_fail(error, im->name, "more follows behind the last of %lu pixels", (unsigned long)count);
    return 1;
}

/* P5: one blank, then bytes. */
static inline int pgm_check_bytes(const image *im, size_t at, size_t maximum, image_error *error)
{
    size_t count = im->width * im->height, k, value;
    if (count * im->sample > im->size - at)
        return image_fail(error, im->name, "truncated: %lu pixels of %lu bytes are announced, %lu bytes follow",
                          (unsigned long)count, (unsigned long)im->sample, (unsigned long)(im->size - at));
    for (k = 0; k < count; ++k) {
        value = (size_t)image_integer(im->bytes + at + k * im->sample, im->sample, 1);
        if (value > maximum)
            return image_fail(error, im->name, "pixel %lu is %lu, above the maximum %lu that the file names",
                              (unsigned long)k, (unsigned long)value, (unsigned long)maximum);
    }
    for (k = at + count * im->sample; k < im->size; ++k)
        if (!pgm_is_blank(im->bytes[k]))
            return image_fail(error, im->name, "more follows behind the last of %lu pixels", (unsigned long)count);
    return 1;
}

static inline int pgm_read(image *im, image_error *error)
{
    size_t at = 2, maximum;
    int is_text = im->bytes[1] == '2';
    if ((!pgm_is_blank(im->bytes[2]) && im->bytes[2] != '#') || !pgm_number(im, &at, &im->width) ||
        !pgm_number(im, &at, &im->height) || !pgm_number(im, &at, &maximum) || at == im->size ||
        !pgm_is_blank(im->bytes[at]))
        return image_fail(error, im->name, "a PGM begins with P%c, width, height and greatest grey", im->bytes[1]);
    ++at;
    if (maximum < 1 || maximum > 65535)
        return image_fail(error, im->name, "the greatest grey of a PGM lies from 1 to 65535, not at %lu",
                          (unsigned long)maximum);
    im->kind = IMAGE_UNSIGNED;
    im->channels = im->interleave = 1;
    im->is_big_endian = 1;
    im->sample = is_text || maximum < 256 ? 1 : 2; /* of text: at least a byte for each number */
    if (!image_check_size(im, error)) return 0;
    if (is_text) {
        im->sample = 2;
        if (im->width * im->height > (im->size - at) / 2 + 1)
            return image_fail(error, im->name, "truncated: %lu pixels are announced, too few numbers follow",
                              (unsigned long)(im->width * im->height));
        return pgm_pack_text(im, at, maximum, error) && image_lay_rows(im, 0, error);
    }
    return pgm_check_bytes(im, at, maximum, error) && image_lay_rows(im, at, error);
}

#endif
