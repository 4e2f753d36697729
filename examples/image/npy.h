/* npy.h - NPY, what numpy.save writes: versions 1 and 2, C order, both byte orders, integers, floats and booleans.

   A header in the notation of Python, and then the numbers:
     {'descr': '<u2', 'fortran_order': False, 'shape': (512, 512), }   */
#ifndef SURFMINK_IMAGE_NPY_H
#define SURFMINK_IMAGE_NPY_H

#include "image.h"

typedef struct npy__text {
    const char *at, *end;
} npy__text;

static inline void npy__skip(npy__text *t)
{
    while (t->at < t->end && (*t->at == ' ' || *t->at == '\n' || *t->at == '\t')) ++t->at;
}

/* Is c the next character but blanks? It is taken then. */
static inline int npy__take(npy__text *t, char c)
{
    npy__skip(t);
    if (t->at == t->end || *t->at != c) return 0;
    ++t->at;
    return 1;
}

/* A word in quotes, shorter than `room`. */
static inline int npy__quoted(npy__text *t, char *word, size_t room)
{
    size_t n = 0;
    char quote;
    npy__skip(t);
    if (t->at == t->end || (*t->at != '\'' && *t->at != '"')) return 0;
    for (quote = *t->at++; t->at < t->end && *t->at != quote && n + 1 < room; ++t->at) word[n++] = *t->at;
    word[n] = '\0';
    return t->at < t->end && *t->at++ == quote;
}

/* True or False. */
static inline int npy__bool(npy__text *t, int *value)
{
    size_t left;
    npy__skip(t);
    left = (size_t)(t->end - t->at);
    *value = left >= 4 && memcmp(t->at, "True", 4) == 0;
    if (!*value && !(left >= 5 && memcmp(t->at, "False", 5) == 0)) return 0;
    t->at += *value ? 4 : 5;
    return 1;
}

/* (a, b, c): *axes counts all of them, the first three are kept. */
static inline int npy__shape(npy__text *t, size_t shape[3], size_t *axes)
{
    *axes = 0;
    if (!npy__take(t, '(')) return 0;
    while (!npy__take(t, ')')) {
        size_t value = 0, digits = 0;
        npy__skip(t);
        for (; t->at < t->end && *t->at >= '0' && *t->at <= '9'; ++t->at, ++digits) {
            if (value > (SIZE_MAX - 9) / 10) return 0;
            value = 10 * value + (size_t)(*t->at - '0');
        }
        if (digits == 0) return 0;
        if (*axes < 3) shape[*axes] = value;
        ++*axes;
        if (!npy__take(t, ',') && (t->at == t->end || *t->at != ')')) return 0;
    }
    return 1;
}

/* '<f4' and the like. */
static inline int npy__type(image *im, const char *descr, image_error *error)
{
    size_t sample = strlen(descr) == 3 && descr[2] >= '1' && descr[2] <= '8' ? (size_t)(descr[2] - '0') : 0;
    char kind = descr[sample ? 1 : strlen(descr)]; /* none of this length: the zero at the end */
    int order = descr[0] == '<' || descr[0] == '>' || (descr[0] == '|' && sample == 1);
    int is_whole = (kind == 'u' || kind == 'i') && (sample == 1 || sample == 2 || sample == 4 || sample == 8);
    if (!order || (!is_whole && !(kind == 'f' && (sample == 4 || sample == 8)) && !(kind == 'b' && sample == 1)))
        return image_fail(error, im->name,
                          "numbers of type '%.20s': integers and floats of 32 or 64 bits can be read; in numpy: "
                          "image.astype('<f4')",
                          descr);
    im->is_big_endian = descr[0] == '>';
    im->sample = sample;
    im->kind = kind == 'f' ? IMAGE_FLOAT : kind == 'i' ? IMAGE_SIGNED : IMAGE_UNSIGNED;
    return 1;
}

/* Rows and columns; of three axes the last or the first has three channels. */
static inline int npy__axes(image *im, const size_t *shape, size_t axes, image_error *error)
{
    int last = axes == 3 && shape[2] == 3;
    if (axes != 2 && axes != 3)
        return image_fail(error, im->name, "an array of %lu axes: an image has two, a map of positions three",
                          (unsigned long)axes);
    if (axes == 3 && !last && shape[0] != 3)
        return image_fail(error, im->name, "an array of shape (%lu, %lu, %lu): of three axes one has 3 channels",
                          (unsigned long)shape[0], (unsigned long)shape[1], (unsigned long)shape[2]);
    im->height = shape[axes == 3 && !last];
    im->width = shape[axes == 3 && !last ? 2 : 1];
    im->channels = axes == 3 ? 3 : 1;
    im->interleave = last ? 3 : 1;
    return 1;
}

static inline int npy_read(image *im, image_error *error)
{
    size_t head = im->bytes[6] == 1 ? 10 : 12, length, shape[3] = {0, 0, 0}, axes = 0;
    int seen = 0, is_fortran = 0;
    char descr[32], key[32];
    npy__text t;
    if (im->bytes[6] != 1 && im->bytes[6] != 2)
        return image_fail(error, im->name, "NPY of version %d: versions 1 and 2 can be read", im->bytes[6]);
    length = im->size < head ? 0 : (size_t)image_integer(im->bytes + 8, head - 8, 0);
    if (im->size < head || length > im->size - head) return image_fail(error, im->name, "truncated in its header");
    t.at = (const char *)im->bytes + head;
    t.end = t.at + length;
    if (!npy__take(&t, '{')) return image_fail(error, im->name, "the header of this NPY is no dictionary");
    while (!npy__take(&t, '}')) {
        int good = npy__quoted(&t, key, sizeof key) && npy__take(&t, ':');
        if (good && strcmp(key, "descr") == 0) {
            npy__skip(&t);
            if (t.at < t.end && *t.at == '[')
                return image_fail(error, im->name, "an array of records: save the field that is the image");
            good = npy__quoted(&t, descr, sizeof descr);
            seen |= 1;
        } else if (good && strcmp(key, "fortran_order") == 0) {
            good = npy__bool(&t, &is_fortran);
            seen |= 2;
        } else if (good && strcmp(key, "shape") == 0) {
            good = npy__shape(&t, shape, &axes);
            seen |= 4;
        } else
            good = 0;
        if (!good || (!npy__take(&t, ',') && (t.at == t.end || *t.at != '}')))
            return image_fail(error, im->name, "the header of this NPY is malformed");
    }
    if (seen != 7) return image_fail(error, im->name, "the header of this NPY lacks descr, fortran_order or shape");
    if (is_fortran)
        return image_fail(error, im->name, "an array in Fortran order; in numpy: numpy.ascontiguousarray(image)");
    if (!npy__type(im, descr, error) || !npy__axes(im, shape, axes, error) || !image_check_size(im, error)) return 0;
    if (im->width * im->height * im->channels * im->sample != im->size - head - length)
        return image_fail(error, im->name, "%s: its shape needs %lu bytes, %lu follow the header",
                          im->width * im->height * im->channels * im->sample > im->size - head - length
                              ? "truncated"
                              : "more follows behind the array",
                          (unsigned long)(im->width * im->height * im->channels * im->sample),
                          (unsigned long)(im->size - head - length));
    return image_lay_rows(im, head + length, error);
}

#endif
