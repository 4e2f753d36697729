/* polygon.h - an outline on its way from a file to its measure. */
#ifndef SURFMINK_COMMAND_POLYGON_H
#define SURFMINK_COMMAND_POLYGON_H

#include "common.h"
#include "options.h"

typedef struct polygon {
    int surface; /* of enum surface: PLANE, SPHERE or EMBEDDED */
    char *id;
    size_t id_room;
    size_t n, room;
    double *corner;      /* PLANE: x y, else x y z of each corner */
    double *normal;      /* EMBEDDED: of each corner */
    unsigned long *line; /* where each corner stands in its file */
    unsigned long first_line;
    int fault; /* of enum surfmink_status: what reading has already found */
    unsigned long fault_line;
} polygon;

static size_t stride_of(int surface)
{
    return surface == PLANE ? 2 : 3;
}

static void begin_polygon(polygon *p, int surface, const char *id, unsigned long line)
{
    size_t length = strlen(id);
    p->surface = surface;
    p->id = (char *)grow(p->id, &p->id_room, length + 1, 1);
    memcpy(p->id, id, length + 1);
    p->n = 0;
    p->first_line = line;
    p->fault = SURFMINK_OK;
}

/* normal may be NULL unless the surface is EMBEDDED. */
static void add_corner(polygon *p, const double *corner, const double *normal, unsigned long line)
{
    size_t stride = stride_of(p->surface);
    if (p->n == p->room) {
        p->room = p->room ? 2 * p->room : 16;
        p->corner = (double *)resize(p->corner, p->room, 3 * sizeof *p->corner);
        p->normal = (double *)resize(p->normal, p->room, 3 * sizeof *p->normal);
        p->line = (unsigned long *)resize(p->line, p->room, sizeof *p->line);
    }
    memcpy(p->corner + p->n * stride, corner, stride * sizeof *corner);
    if (p->surface == EMBEDDED) memcpy(p->normal + p->n * 3, normal, 3 * sizeof *normal);
    p->line[p->n++] = line;
}

/* The first fault is the one that is reported. */
static void find_fault(polygon *p, int status, unsigned long line)
{
    if (p->fault != SURFMINK_OK || status == SURFMINK_OK) return;
    p->fault = status;
    p->fault_line = line;
}

static void free_polygon(polygon *p)
{
    free(p->id);
    free(p->corner);
    free(p->normal);
    free(p->line);
}

#endif
