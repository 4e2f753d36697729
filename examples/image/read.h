/* read.h - an image of any of the formats, told apart by its first bytes. */
#ifndef SURFMINK_IMAGE_READ_H
#define SURFMINK_IMAGE_READ_H

#include "npy.h"
#include "pgm.h"
#include "tiff.h"

/* What the first bytes of a file promise; the formats that can be read come first. */
enum { READ_FORMATS = 4, READ_KNOWN = 11 };
static const struct {
    const char *bytes, *name;
} read_magic[READ_KNOWN] = {{"II", "a TIFF"},           {"MM", "a TIFF"},
                            {"\x93NUMPY", "an NPY"},    {"P", "a PGM"},
                            {"\x89PNG", "a PNG"},       {"\xff\xd8\xff", "a JPEG"},
                            {"GIF8", "a GIF"},          {"BM", "a BMP"},
                            {"\x89HDF", "HDF5"},        {"PK\x03\x04", "an NPZ or another zip archive"},
                            {"\x1f\x8b", "a gzip file"}};

/* TIFF has 42 behind its letters, in the byte order that these tell, or 43; PGM and its kin a digit. */
static inline int read__agrees(size_t format, const unsigned char *bytes, size_t size)
{
    uint64_t version = format < 2 && size >= 4 ? image_integer(bytes + 2, 2, bytes[0] == 'M') : 0;
    if (format < 2) return version == 42 || version == 43;
    return format != 3 || (size >= 2 && bytes[1] >= '1' && bytes[1] <= '7');
}

/* The number of the format in this list; READ_KNOWN if it is unknown. */
static inline size_t read_format(const unsigned char *bytes, size_t size)
{
    size_t k, n;
    for (k = 0; k < READ_KNOWN; ++k) {
        n = strlen(read_magic[k].bytes);
        if (size >= n && memcmp(bytes, read_magic[k].bytes, n) == 0 && read__agrees(k, bytes, size)) break;
    }
    return k;
}

/* There is no sense in reading on where no format can be read. */
static inline int read_is_foreign(const unsigned char *bytes, size_t size)
{
    return read_format(bytes, size) >= READ_FORMATS;
}

static inline int read__decode(image *im, image_error *error)
{
    size_t format = read_format(im->bytes, im->size);
    if (format == READ_KNOWN)
        return image_fail(error, im->name, "no image that can be read: TIFF without compression, NPY and PGM can");
    if (format >= READ_FORMATS)
        return image_fail(error, im->name,
                          "this is %s: save it as TIFF without compression, NPY or PGM (in Python: "
                          "tifffile.imwrite, numpy.save)",
                          read_magic[format].name);
    if (im->size < 10)
        return image_fail(error, im->name, "truncated: %lu bytes of %s", (unsigned long)im->size,
                          read_magic[format].name);
    if (format < 2) return tiff_read(im, error);
    if (format == 2) return npy_read(im, error);
    if (im->bytes[1] == '2' || im->bytes[1] == '5') return pgm_read(im, error);
    return image_fail(error, im->name, "this is %s: a PGM, which begins with P2 or P5, has one number for each pixel",
                      im->bytes[1] == '3' || im->bytes[1] == '6'   ? "a PPM, an image in colours"
                      : im->bytes[1] == '1' || im->bytes[1] == '4' ? "a PBM, an image in black and white"
                                                                   : "a PAM");
}

/* The image in a file, - is standard input. Whatever comes of it, image_free gives the memory back. */
static inline int read_image(image *im, const char *name, image_error *error)
{
    return image_load(im, name, read_is_foreign, error) && read__decode(im, error);
}

/* A map of the pixels of an image: three numbers for each. Without a name there is none, and the map stays empty. */
static inline int read_map(image *map, const char *name, const image *of, image_error *error)
{
    if (!name) return 1;
    if (!read_image(map, name, error)) return 0;
    if (map->channels != 3)
        return image_fail(error, name, "%lu numbers for each pixel: a map has three, x, y and z",
                          (unsigned long)map->channels);
    if (map->width != of->width || map->height != of->height)
        return image_fail(error, name, "%lu x %lu pixels, and the image has %lu x %lu", (unsigned long)map->width,
                          (unsigned long)map->height, (unsigned long)of->width, (unsigned long)of->height);
    return 1;
}

#endif
