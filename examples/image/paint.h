/* paint.h - numbers of a table -> an image: every pixel of a cell gets the number of its cell. */
#ifndef SURFMINK_IMAGE_PAINT_H
#define SURFMINK_IMAGE_PAINT_H

#include "../command/number.h"
#include "regions.h"

typedef struct paint {
    float *value;         /* of each region; NaN: none */
    unsigned char *given; /* each region: has had its row */
    size_t strangers;     /* rows that name no cell of the image */
} paint;

static inline void paint_free(paint *p)
{
    free(p->value);
    free(p->given);
    memset(p, 0, sizeof *p);
}

/* --- the table ---------------------------------------------------------------------------------------------------- */

/* A line cut into fields at tabs; returns how many there are, and keeps the two that are asked for. */
static inline size_t paint__split(char *line, const size_t want[2], char *field[2])
{
    size_t count = 0;
    char *tab;
    for (field[0] = field[1] = NULL;; line = tab + 1, ++count) {
        tab = strchr(line, '\t');
        if (tab) *tab = '\0';
        if (count == want[0]) field[0] = line;
        if (count == want[1]) field[1] = line;
        if (!tab) return count + 1;
    }
}

/* The numbers of two columns by their names. */
static inline void paint__find(char *line, const char *column, size_t place[2])
{
    size_t count = 0;
    char *tab;
    for (place[0] = place[1] = SIZE_MAX;; line = tab + 1, ++count) {
        tab = strchr(line, '\t');
        if (tab) *tab = '\0';
        if (strcmp(line, "id") == 0) place[0] = count;
        if (strcmp(line, column) == 0) place[1] = count;
        if (!tab) return;
    }
}

/* The region with this label, 0 if there is none. */
static inline size_t paint__region(const regions *r, double label)
{
    size_t low = 1, high = r->count, middle;
    while (low < high) {
        middle = low + (high - low) / 2;
        if (r->label[middle] < label)
            low = middle + 1;
        else
            high = middle;
    }
    return low < r->count && !(r->label[low] > label) ? low : 0;
}

/* One row: an empty field is a number that surfmink did not give, and is NaN. */
static inline int paint__row(paint *p, const regions *r, const char *name, size_t number, char *const field[2],
                             const powers_of_ten *powers, image_error *error)
{
    double label, value = 0;
    size_t region;
    if (!field[0] || !field[1])
        return image_fail(error, name, "line %lu: a row with too few columns", (unsigned long)number);
    if (!parse_number(powers, field[0], &label))
        return image_fail(error, name, "line %lu: the id '%.40s' is no label", (unsigned long)number, field[0]);
    if (*field[1] && !parse_number(powers, field[1], &value))
        return image_fail(error, name, "line %lu: '%.40s' is not a number", (unsigned long)number, field[1]);
    region = paint__region(r, label);
    if (region == 0) {
        ++p->strangers;
        return 1;
    }
    if (p->given[region])
        return image_fail(error, name, "line %lu: a second row of cell %.40s", (unsigned long)number, field[0]);
    p->given[region] = 1;
    if (*field[1]) p->value[region] = (float)value;
    return 1;
}

/* All lines of the table in memory, which ends with a zero byte. */
static inline int paint__rows(paint *p, const regions *r, const char *name, char *text, const char *column,
                              const powers_of_ten *powers, image_error *error)
{
    size_t place[2], number = 0;
    int has_names = 0;
    char *end, *field[2];
    for (; *text; text = end) {
        end = text + strcspn(text, "\n");
        if (*end) *end++ = '\0';
        text[strcspn(text, "\r")] = '\0';
        ++number;
        if (*text == '#' || !*text) continue;
        if (has_names) {
            paint__split(text, place, field);
            if (!paint__row(p, r, name, number, field, powers, error)) return 0;
            continue;
        }
        has_names = 1;
        paint__find(text, column, place);
        if (place[0] == SIZE_MAX)
            return image_fail(error, name, "no column is called id: a table of surfmink is wanted");
        if (place[1] == SIZE_MAX) return image_fail(error, name, "no column is called %.40s", column);
    }
    return has_names || image_fail(error, name, "no line names the columns");
}

static inline int paint__is_no_text(const unsigned char *bytes, size_t size)
{
    return memchr(bytes, 0, size) != NULL;
}

/* Reads one column of a table of surfmink. Whatever comes of it, paint_free gives the memory back. */
static inline int paint_read(paint *p, const regions *r, const char *name, const char *column,
                             const powers_of_ten *powers, image_error *error)
{
    static const uint32_t no_number = 0x7fc00000;
    image table; /* only its bytes */
    size_t k;
    char *text;
    int good;
    memset(p, 0, sizeof *p);
    p->value = (float *)malloc(r->count * sizeof *p->value);
    p->given = (unsigned char *)calloc(r->count, 1);
    if (!p->value || !p->given) return image_no_memory(error);
    for (k = 0; k < r->count; ++k) memcpy(p->value + k, &no_number, sizeof no_number);
    good = image_load(&table, name, paint__is_no_text, error);
    text = good ? (char *)realloc(table.bytes, table.size + 1) : NULL;
    if (text) {
        table.bytes = (unsigned char *)text;
        text[table.size] = '\0';
        good = paint__is_no_text(table.bytes, table.size)
                   ? image_fail(error, name, "a zero byte: this is not plain text")
                   : paint__rows(p, r, name, text, column, powers, error);
    } else if (good)
        good = image_no_memory(error);
    image_free(&table);
    return good;
}

/* --- the image ---------------------------------------------------------------------------------------------------- */

static inline void paint__integer(unsigned char *to, uint32_t value, size_t bytes)
{
    size_t k;
    for (k = 0; k < bytes; ++k) to[k] = (unsigned char)(value >> (8 * k) & 255);
}

/* A TIFF of one strip of 32-bit floats, the lowest byte first. */
static inline void paint_write(const paint *p, const regions *r, FILE *file)
{
    enum { ENTRIES = 10, DIRECTORY = 8 + 2 + 12 * ENTRIES + 4 };
    const uint32_t size = (uint32_t)(4 * r->width * r->height);
    const uint32_t entry[ENTRIES][3] = {{256, 4, (uint32_t)r->width},
                                        {257, 4, (uint32_t)r->height},
                                        {258, 3, 32},
                                        {259, 3, 1},
                                        {262, 3, 1},
                                        {273, 4, DIRECTORY},
                                        {277, 3, 1},
                                        {278, 4, (uint32_t)r->height},
                                        {279, 4, size},
                                        {339, 3, 3}};
    unsigned char head[DIRECTORY] = {'I', 'I', 42, 0, 8, 0, 0, 0, ENTRIES, 0}, four[4];
    size_t k, pixels = r->width * r->height;
    uint32_t bits;
    for (k = 0; k < ENTRIES; ++k) { /* tag, type (3: 16 bits, 4: 32), one value */
        paint__integer(head + 10 + 12 * k, entry[k][0], 2);
        paint__integer(head + 12 + 12 * k, entry[k][1], 2);
        paint__integer(head + 14 + 12 * k, 1, 4);
        paint__integer(head + 18 + 12 * k, entry[k][2], 4);
    }
    fwrite(head, 1, sizeof head, file);
    for (k = 0; k < pixels; ++k) {
        memcpy(&bits, &p->value[r->of[k]], sizeof bits);
        paint__integer(four, bits, 4);
        fwrite(four, 1, 4, file);
    }
}

#endif
