/* write.h - outlines -> a table, a polygon mesh, a report of every label, and what is said about them. */
#ifndef SURFMINK_IMAGE_WRITE_H
#define SURFMINK_IMAGE_WRITE_H

#include "../command/number.h"
#include "outline.h"

typedef struct writer {
    FILE *file;
    const powers_of_ten *powers;
    int digits;
    const double *spacing; /* of pixels, across and down; 1 with a chart */
} writer;

/* A file name inside a line of text. */
static inline void write_name(FILE *file, const char *name)
{
    char text[256];
    snprintf(text, sizeof text, "%.200s", name);
    image_disarm(text);
    fputs(text, file);
}

/* --- numbers ------------------------------------------------------------------------------------------------------ */

/* The text of a whole number. */
static inline char *write_label(char *to, double label)
{
    return to + snprintf(to, 24, "%.0f", label);
}

/* The text of a count, faster than by printf: every line of the table has one. */
static inline char *write__count(char *to, size_t count)
{
    char digit[24];
    size_t n = 0;
    do digit[n++] = (char)('0' + count % 10);
    while ((count /= 10) > 0);
    while (n > 0) *to++ = digit[--n];
    return to;
}

/* Numbers with `separator` before each. */
static inline char *write__numbers(const writer *w, char *to, char separator, const double *number, size_t count)
{
    size_t k;
    for (k = 0; k < count; ++k) {
        *to++ = separator;
        to = write_number(w->powers, to, w->digits, number[k]);
    }
    return to;
}

/* Coordinates of a corner: 2, or 6 with a chart. Returns how many. */
static inline size_t write__coordinates(const writer *w, const outlines *o, const outline_corner *corner,
                                        double number[6])
{
    if (o->space) {
        memcpy(number, o->place + 6 * (size_t)corner->point, 6 * sizeof *number);
        return 6;
    }
    outlines_xy(o, corner, number);
    number[0] *= w->spacing[0];
    number[1] *= w->spacing[1];
    return 2;
}

/* --- the table ---------------------------------------------------------------------------------------------------- */

enum { WRITE_LINE = 256 }; /* eight numbers of 25 characters at most */

static inline int write_table(const writer *w, outlines *o, image_error *error)
{
    size_t region, k;
    char line[WRITE_LINE], *at, *head;
    double number[6];
    fputs(o->space ? "cell\tk\tx\ty\tz\tnx\tny\tnz\n" : "cell\tk\tx\ty\n", w->file);
    for (region = 1; region < o->map->count; ++region) {
        if (o->map->flag[region] & REGION_DROPPED) continue;
        if (!outlines_walk(o, region, error)) return 0;
        head = write_label(line, o->map->label[region]);
        for (k = 0; k < o->count; ++k) {
            *head = '\t';
            at = write__count(head + 1, k);
            at = write__numbers(w, at, '\t', number, write__coordinates(w, o, &o->corner[k], number));
            *at++ = '\n';
            fwrite(line, 1, (size_t)(at - line), w->file);
        }
    }
    return 1;
}

/* --- the mesh ----------------------------------------------------------------------------------------------------- */

/* The number of each point in the mesh, from 1 on, in the order of the points; 0 for those of no cell that is measured.
   NULL if memory runs out. */
static inline uint32_t *write__number(outlines *o, size_t *points, size_t *faces, image_error *error)
{
    size_t region, k;
    uint32_t *number = (uint32_t *)calloc(o->points->count + 1, sizeof *number);
    *points = *faces = 0;
    if (!number) image_no_memory(error);
    for (region = 1; number && region < o->map->count; ++region) {
        if (o->map->flag[region] & REGION_DROPPED) continue;
        ++*faces;
        if (!outlines_walk(o, region, error)) {
            free(number);
            return NULL;
        }
        for (k = 0; k < o->count; ++k) number[o->corner[k].point] = 1;
    }
    for (k = 0; number && k < o->points->count; ++k)
        if (number[k]) number[k] = (uint32_t)++ * points;
    return number;
}

/* OFF, or NOFF with normals: every point once, and a face for every cell that the table has. */
static inline int write_off(const writer *w, outlines *o, image_error *error)
{
    size_t region, k, points, faces;
    uint32_t *number = write__number(o, &points, &faces, error);
    outline_corner corner;
    double coordinate[6];
    char line[WRITE_LINE], *at;
    int good = number != NULL;
    if (good)
        fprintf(w->file, "%s\n%lu %lu 0\n", o->space ? "NOFF" : "OFF", (unsigned long)points, (unsigned long)faces);
    corner.turns = 0;
    for (k = 0; good && k < o->points->count; ++k) {
        if (!number[k]) continue;
        corner.point = (uint32_t)k;
        at = write__numbers(w, line, ' ', coordinate, write__coordinates(w, o, &corner, coordinate));
        if (!o->space) at += snprintf(at, 4, " 0");
        *at++ = '\n';
        fwrite(line + 1, 1, (size_t)(at - line - 1), w->file); /* without the blank in front */
    }
    for (region = 1; good && region < o->map->count; ++region) {
        if (o->map->flag[region] & REGION_DROPPED) continue;
        good = outlines_walk(o, region, error);
        fprintf(w->file, "%lu", (unsigned long)o->count);
        for (k = 0; good && k < o->count; ++k) fprintf(w->file, " %lu", (unsigned long)number[o->corner[k].point] - 1);
        fputc('\n', w->file);
    }
    free(number);
    return good;
}

/* --- what is said ------------------------------------------------------------------------------------------------- */

/* In this order: a cell is counted under the first that holds. */
enum { WRITE_REASONS = 7, WRITE_WORDS = 2 };
static const struct {
    int flag;
    const char *word, *sentence;
} write_reason[WRITE_REASONS + WRITE_WORDS] = {
    {REGION_BORDER, "border", "left out, cut by the border of the image"},
    {REGION_WINDS, "winds", "left out, running round the wrapped image"},
    {REGION_PARTS, "parts", "left out, of several parts"},
    {REGION_RIM, "rim", "left out, reaching beyond the rim of the chart"},
    {REGION_FOLD, "fold", "left out, where the chart is folded or torn"},
    {REGION_FEW, "few_junctions", "left out, with fewer than three junctions or corners that --weld leaves apart"},
    {REGION_TURNED, "turned",
     "left out, of which the junctions run the other way round (--points curve measures them)"},
    {REGION_HOLES, "holes", "measured by the outer outline, with holes"},
    {REGION_SMALL, "small", "measured, but of fewer than 20 pixels"}};

/* Why the cell is left out; the length of the list if it is not. */
static inline int write__reason(int flags)
{
    int i = 0;
    while (i < WRITE_REASONS && !(flags & write_reason[i].flag)) ++i;
    return i;
}

/* Does the cell belong under reason or word number i? */
static inline int write__is_under(int flags, int i)
{
    return i < WRITE_REASONS ? write__reason(flags) == i
                             : !(flags & REGION_DROPPED) && (flags & write_reason[i].flag) != 0;
}

/* One line for each reason, with a count and the first labels; returns how many cells are left out. */
static inline size_t write_notices(FILE *file, const char *name, const regions *r)
{
    enum { SHOWN = 10 };
    size_t region, dropped = 0, count;
    int i;
    char label[32];
    for (i = 0; i < WRITE_REASONS + WRITE_WORDS; ++i) {
        for (count = 0, region = 1; region < r->count; ++region) count += write__is_under(r->flag[region], i) != 0;
        if (i < WRITE_REASONS) dropped += count;
        if (count == 0) continue;
        write_name(file, name);
        fprintf(file, ": %s: %lu (", write_reason[i].sentence, (unsigned long)count);
        for (count = 0, region = 1; region < r->count; ++region) {
            if (!write__is_under(r->flag[region], i)) continue;
            *write_label(label, r->label[region]) = '\0';
            if (count < SHOWN) fprintf(file, count ? " %s" : "%s", label);
            ++count;
        }
        fputs(count > SHOWN ? " ...)\n" : ")\n", file);
    }
    return dropped;
}

/* A line for every label. */
static inline int write_report(FILE *file, outlines *o, image_error *error)
{
    size_t region;
    int flags, i;
    char label[32];
    fputs("cell\tpixels\tcorners\tstatus\tword\n", file);
    for (region = 1; region < o->map->count; ++region) {
        flags = o->map->flag[region];
        o->count = 0;
        if (!(flags & REGION_DROPPED) && !outlines_walk(o, region, error)) return 0;
        i = write__reason(flags);
        *write_label(label, o->map->label[region]) = '\0';
        fprintf(file, "%s\t%lu\t%lu\t%s\t%s%s%s\n", label, (unsigned long)o->map->pixels[region],
                (unsigned long)o->count, i < WRITE_REASONS ? write_reason[i].word : "ok",
                flags & REGION_HOLES ? "holes" : "", (flags & REGION_HOLES) && (flags & REGION_SMALL) ? "," : "",
                flags & REGION_SMALL ? "small" : "");
    }
    return 1;
}

#endif
