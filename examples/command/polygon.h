/* polygon.h - an outline on its way from a file to its measure. */
#ifndef SURFMINK_COMMAND_POLYGON_H
#define SURFMINK_COMMAND_POLYGON_H

#include "../beyond/curve.h"
#include "common.h"
#include "options.h"

/* What may be wrong with an outline beyond enum surfmink_status: what only a file can tell, or only a search. */
enum fault { FAULT_BAD_ORDER = 1000, FAULT_SEVERAL_RINGS, FAULT_SEAM, FAULT_SHORT_EDGE, FAULT_SPIKE };

static inline const char *status_name(int status)
{
    switch (status) {
    case FAULT_BAD_ORDER: return "bad_order";
    case FAULT_SEVERAL_RINGS: return "several_rings";
    case FAULT_SEAM: return "seam";
    case FAULT_SHORT_EDGE: return "short_edge";
    case FAULT_SPIKE: return "spike";
    default: return surfmink_curve_status_name(status);
    }
}

static inline const char *status_text(int status)
{
    switch (status) {
    case FAULT_BAD_ORDER: return "k is no order: it is not whole, or twice the same, within this outline";
    case FAULT_SEVERAL_RINGS:
        return "a ring closes here, and the outline goes on: a hole, or another part, under the same id";
    case FAULT_SEAM:
        return "the outline goes back here along an edge of its own: a cut that leads to a hole, or to another part";
    case FAULT_SPIKE: return "the outline goes there and back at this corner, a spike, which smoothing would spread";
    case FAULT_SHORT_EDGE: return "this corner is all but that before it, which curves do not bear";
    default: return surfmink_curve_strerror(status);
    }
}

typedef struct polygon {
    int surface; /* of enum surface: PLANE, SPHERE or EMBEDDED */
    char *id;
    size_t id_room;
    size_t n, room;
    double *corner;      /* PLANE: x y, else x y z of each corner */
    double *normal;      /* EMBEDDED: of each corner */
    int has_means;       /* they are means over faces */
    int is_mirrored;     /* y pointed down */
    unsigned long *line; /* where each corner stands in its file */
    double *order;       /* the k of each corner; used if has_order */
    size_t order_room;
    int has_order;
    unsigned long first_line;
    int fault; /* of enum surfmink_status or fault: what reading has already found */
    unsigned long fault_line;
} polygon;

static size_t stride_of(int surface)
{
    return surface == PLANE ? 2 : 3;
}

static void rename_polygon(polygon *p, const char *id)
{
    size_t length = strlen(id);
    p->id = (char *)grow(p->id, &p->id_room, length + 1, 1);
    memcpy(p->id, id, length + 1);
}

static void begin_polygon(polygon *p, int surface, const char *id, unsigned long line)
{
    rename_polygon(p, id);
    p->surface = surface;
    p->n = 0;
    p->has_order = 0;
    p->has_means = 0;
    p->is_mirrored = 0;
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

/* The k of the last corner. */
static void set_order(polygon *p, double k)
{
    p->order = (double *)grow(p->order, &p->order_room, p->n, sizeof *p->order);
    p->order[p->n - 1] = k;
    p->has_order = 1;
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
    free(p->order);
}

#endif
