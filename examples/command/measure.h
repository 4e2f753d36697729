/* measure.h - step 2 of the command: a polygon -> its measure, or the reason why it has none. */
#ifndef SURFMINK_COMMAND_MEASURE_H
#define SURFMINK_COMMAND_MEASURE_H

#include "polygon.h"

typedef struct measure {
    int status;         /* of enum surfmink_status; unless OK only n and line count */
    size_t n;           /* corners, as measured */
    unsigned long line; /* of the corner to blame, or of the whole outline */
    surfmink_functionals w;
    double *g;       /* 2 P + 2 */
    double *mu;      /* P + 1 */
    double *theta;   /* P + 1 */
    double frame[9]; /* nu, tau (, normal) at the middle of edge 0 */
    int has_frame;
    double *length;  /* n, for the classical transport and for pictures */
    double *turning; /* n */
    size_t length_room, turning_room;
} measure;

static void begin_measure(measure *m, int max_rank)
{
    size_t ranks = (size_t)max_rank + 1;
    memset(m, 0, sizeof *m);
    m->g = (double *)resize(NULL, 2 * ranks, sizeof *m->g);
    m->mu = (double *)resize(NULL, ranks, sizeof *m->mu);
    m->theta = (double *)resize(NULL, ranks, sizeof *m->theta);
}

static void end_measure(measure *m)
{
    free(m->g);
    free(m->mu);
    free(m->theta);
    free(m->length);
    free(m->turning);
}

/* Below this mu_p is rounding noise, and so is any direction. */
static int has_direction(const measure *m, int p)
{
    return m->mu[p] >= 1e-12;
}

/* --- repairs ------------------------------------------------------------------------------------------------------ */

/* Are they the same point, so that the library would refuse the edge between them? On a sphere directions decide. */
static int coincide(const polygon *p, size_t i, size_t j)
{
    size_t k, stride = stride_of(p->surface);
    const double *a = p->corner + i * stride, *b = p->corner + j * stride;
    double between[3];
    if (p->surface == SPHERE)
        return surfmink_sphere_log(a, b, 1, between) == SURFMINK_OK && between[0] == 0 && between[1] == 0 &&
               between[2] == 0;
    for (k = 0; k < stride; ++k)
        if (a[k] != b[k]) return 0;
    return 1;
}

static void drop_closing_corner(polygon *p)
{
    if (p->n > 1 && coincide(p, 0, p->n - 1)) --p->n;
}

/* surfmink_merge, but lines go along with their corners, and corners of a sphere are compared as directions. */
static void merge_corners(polygon *p)
{
    size_t i, kept = 1, stride = stride_of(p->surface);
    for (i = 1; i < p->n; ++i) {
        if (coincide(p, i, kept - 1)) continue;
        memmove(p->corner + kept * stride, p->corner + i * stride, stride * sizeof *p->corner);
        if (p->surface == EMBEDDED) memmove(p->normal + kept * 3, p->normal + i * 3, 3 * sizeof *p->normal);
        p->line[kept++] = p->line[i];
    }
    if (p->n > 0) p->n = kept;
    while (p->n > 1 && coincide(p, 0, p->n - 1)) --p->n;
}

static void smooth_corners(polygon *p, size_t passes)
{
    surfmink_smooth(p->corner, p->n, stride_of(p->surface), passes);
    if (p->surface == EMBEDDED) surfmink_smooth(p->normal, p->n, 3, passes);
}

static void reverse_corners(polygon *p)
{
    size_t i;
    surfmink_reverse(p->corner, p->n, stride_of(p->surface));
    if (p->surface == EMBEDDED) surfmink_reverse(p->normal, p->n, 3);
    for (i = 0; i < p->n / 2; ++i) {
        unsigned long line = p->line[i];
        p->line[i] = p->line[p->n - 1 - i];
        p->line[p->n - 1 - i] = line;
    }
}

/* --- measuring ---------------------------------------------------------------------------------------------------- */

static int measure_corrected(measure *m, const polygon *p, const options *o, double radius, size_t *bad)
{
    switch (p->surface) {
    case PLANE: return surfmink_measure_plane(p->corner, p->n, o->max_rank, NULL, m->g, &m->w, bad);
    case SPHERE: return surfmink_measure_sphere(p->corner, p->n, radius, o->max_rank, NULL, m->g, &m->w, bad);
    default: return surfmink_measure_embedded(p->corner, p->normal, p->n, o->max_rank, NULL, m->g, &m->w, bad);
    }
}

static void measure_edges(measure *m, const polygon *p, double radius)
{
    m->length = (double *)grow(m->length, &m->length_room, p->n, sizeof *m->length);
    m->turning = (double *)grow(m->turning, &m->turning_room, p->n, sizeof *m->turning);
    switch (p->surface) {
    case PLANE: surfmink_edges_plane(p->corner, p->n, m->length, m->turning, NULL); break;
    case SPHERE: surfmink_edges_sphere(p->corner, p->n, radius, m->length, m->turning, NULL); break;
    default: surfmink_edges_embedded(p->corner, p->normal, p->n, m->length, m->turning, NULL); break;
    }
}

/* Corners of a sphere may lie off it; the frame must not notice. It only looks at the first two. */
static int sphere_frame(const polygon *p, double frame[9])
{
    double on_sphere[9], length;
    size_t i, k;
    for (i = 0; i < 3; ++i) {
        const double *x = p->corner + 3 * i;
        length = hypot(hypot(x[0], x[1]), x[2]);
        for (k = 0; k < 3; ++k) on_sphere[3 * i + k] = x[k] / length;
    }
    return surfmink_frame_embedded(on_sphere, on_sphere, 3, 0, frame);
}

static int find_frame(measure *m, const polygon *p)
{
    switch (p->surface) {
    case PLANE: return surfmink_frame_plane(p->corner, p->n, 0, m->frame);
    case SPHERE: return sphere_frame(p, m->frame);
    default: return surfmink_frame_embedded(p->corner, p->normal, p->n, 0, m->frame);
    }
}

/* The outline as it now is. Whatever the transport, what the corrected one refuses is refused. */
static int measure_once(measure *m, const polygon *p, const options *o)
{
    double radius = o->radius > 0 ? o->radius : 1;
    size_t bad = p->n;
    int status = measure_corrected(m, p, o, radius, &bad);
    m->n = p->n;
    m->line = bad < p->n ? p->line[bad] : p->first_line;
    if (status == SURFMINK_OK && o->transport == SURFMINK_PARALLEL) {
        measure_edges(m, p, radius);
        status = surfmink_irreducible_parallel(m->length, m->turning, p->n, 0, 0.5, o->max_rank, m->g);
    }
    if (status == SURFMINK_OK) status = surfmink_spectrum(m->g, o->max_rank, NULL, m->mu, m->theta);
    m->has_frame = status == SURFMINK_OK && o->directions && find_frame(m, p) == SURFMINK_OK;
    return status;
}

/* Repairs the polygon as far as the options say, in the order in which they may help each other, and measures it. */
static void measure_polygon(measure *m, polygon *p, const options *o)
{
    drop_closing_corner(p);
    m->n = p->n;
    m->line = p->fault_line;
    m->status = p->fault; /* not to be smeared over the neighbours by smoothing */
    if (m->status != SURFMINK_OK) return;
    if (o->merge) merge_corners(p);
    smooth_corners(p, o->smooth);
    if (o->reverse == REVERSE_ALWAYS) reverse_corners(p);
    m->status = measure_once(m, p, o);
    if (m->status == SURFMINK_CLOCKWISE && o->reverse == REVERSE_AUTO) {
        reverse_corners(p);
        m->status = measure_once(m, p, o);
    }
}

#endif
