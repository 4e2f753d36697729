/* batch.h - polygons on their way to the measure, which takes many at a time. */
#ifndef SURFMINK_COMMAND_BATCH_H
#define SURFMINK_COMMAND_BATCH_H

#include "polygon.h"

/* All polygons have the same kind of surface. */
typedef struct batch {
    size_t count;
    polygon *polygon;    /* their arrays are parts of those below, from place_polygons to the next add_to_batch */
    size_t *offset;      /* count + 1: where the corners of each begin */
    double *corner;      /* as in polygon.h */
    double *normal;      /* EMBEDDED */
    unsigned long *line; /* of each corner */
    char *id;            /* texts, one after the other */
    size_t id_length;
    size_t polygon_room, offset_room, corner_room, normal_room, line_room, id_room;
} batch;

/* So many polygons, corners or values of mu fill a batch: enough to be fast, few enough to stay in the cache. */
enum { MOST_POLYGONS = 1024, MOST_CORNERS = 8192, MOST_VALUES = 65536 };

static void begin_batch(batch *b)
{
    memset(b, 0, sizeof *b);
    b->offset = (size_t *)grow(NULL, &b->offset_room, 1, sizeof *b->offset);
    b->offset[0] = 0;
}

static int is_full(const batch *b, int max_rank)
{
    return b->count >= MOST_POLYGONS || b->offset[b->count] >= MOST_CORNERS ||
           b->count * (size_t)max_rank >= MOST_VALUES;
}

/* Copies the polygon to the end of the batch. It counts when all of it is there: where memory ends, those before it are
   still measured. */
static void add_to_batch(batch *b, const polygon *p)
{
    size_t at = b->offset[b->count], end = at + p->n, stride = stride_of(p->surface), length = strlen(p->id) + 1;
    b->polygon = (polygon *)grow(b->polygon, &b->polygon_room, b->count + 1, sizeof *b->polygon);
    b->offset = (size_t *)grow(b->offset, &b->offset_room, b->count + 2, sizeof *b->offset);
    b->corner = (double *)grow(b->corner, &b->corner_room, end * stride, sizeof *b->corner);
    b->line = (unsigned long *)grow(b->line, &b->line_room, end, sizeof *b->line);
    b->id = (char *)grow(b->id, &b->id_room, b->id_length + length, 1);
    if (p->surface == EMBEDDED) b->normal = (double *)grow(b->normal, &b->normal_room, end * 3, sizeof *b->normal);
    b->polygon[b->count] = *p;
    memcpy(b->id + b->id_length, p->id, length);
    b->id_length += length;
    if (p->n > 0) { /* else there need not be any arrays yet */
        memcpy(b->corner + at * stride, p->corner, p->n * stride * sizeof *p->corner);
        memcpy(b->line + at, p->line, p->n * sizeof *p->line);
        if (p->surface == EMBEDDED) memcpy(b->normal + at * 3, p->normal, p->n * 3 * sizeof *p->normal);
    }
    b->offset[++b->count] = end;
}

/* The arrays may have moved while they grew: only now the polygons can point into them. */
static void place_polygons(batch *b)
{
    size_t i;
    char *id = b->id;
    for (i = 0; i < b->count; ++i) {
        polygon *p = &b->polygon[i];
        p->id = id;
        id += strlen(id) + 1;
        if (p->n == 0) continue;
        p->corner = b->corner + b->offset[i] * stride_of(p->surface);
        p->normal = p->surface == EMBEDDED ? b->normal + b->offset[i] * 3 : NULL;
        p->line = b->line + b->offset[i];
    }
}

static void clear_batch(batch *b)
{
    b->count = b->id_length = 0;
}

static void free_batch(batch *b)
{
    free(b->polygon);
    free(b->offset);
    free(b->corner);
    free(b->normal);
    free(b->line);
    free(b->id);
}

#endif
