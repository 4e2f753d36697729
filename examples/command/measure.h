/* measure.h - step 3 of the command: a batch of polygons -> the measure of each, or the reason why it has none. */
#ifndef SURFMINK_COMMAND_MEASURE_H
#define SURFMINK_COMMAND_MEASURE_H

#include "../beyond/crossings.h"
#include "batch.h"
#include "repair.h"

/* Of one polygon. */
typedef struct measure {
    int status;                /* of enum surfmink_status; unless OK only n and line count */
    size_t n;                  /* corners, as measured */
    const char *id;            /* as long as the batch is */
    unsigned long line;        /* of the corner to blame, or of the whole outline; 0: it has none */
    unsigned long crossing[2]; /* lines of two edges that cross; 0: not known */
    unsigned long hint_line;   /* of what may be the cause of a refusal; 0: not known */
    double hint_edge;          /* the cause: an edge so short, of the perimeter; 0: a spike */
    int reversed;              /* --reverse auto turned it round */
    int surface;
    double length, turning, area;
    const double *mu;    /* P + 1 */
    const double *theta; /* P + 1 */
    const double *error; /* P + 1, that of L first; NULL: not asked for */
    double frame[9];     /* nu, tau (, normal) at the middle of edge 0 */
    int has_frame;
    double centre[3], normal[3]; /* of the outline; in the plane centre[2] = 0 and the normal points up */
    const double *direction;     /* P + 1 vectors at the centre */
    const double *coherence;     /* P + 1 */
    int has_director;            /* is there a centre and what follows it? */
} measure;

/* Lengths and turning angles of one polygon. */
typedef struct edges {
    double *length, *turning;
    size_t length_room, turning_room;
} edges;

/* Of all polygons of a batch. */
typedef struct measures {
    surfmink_results of;
    size_t room; /* polygons */
    double *scratch;
    size_t scratch_room;
    double *g; /* 2 P + 2, of one polygon; as are its edges, their phases, and what is known about its centre */
    edges edges;
    double *phase, *direction, *coherence;
    size_t phase_room;
    double *error;        /* P + 1 a polygon; curves only */
    unsigned char *sharp; /* of one polygon's corners; curves only */
    size_t sharp_room;
    size_t *crossing; /* 2 a polygon: edges that cross, n if none are known */
    unsigned char *reversed;
} measures;

static void begin_measures(measures *m, int max_rank)
{
    memset(m, 0, sizeof *m);
    m->g = (double *)resize(NULL, 2 * ((size_t)max_rank + 1), sizeof *m->g);
    m->direction = (double *)resize(NULL, 3 * ((size_t)max_rank + 1), sizeof *m->direction);
    m->coherence = (double *)resize(NULL, (size_t)max_rank + 1, sizeof *m->coherence);
}

static void make_room(measures *m, size_t count, int max_rank)
{
    size_t ranks = (size_t)max_rank + 1;
    if (count <= m->room) return;
    m->of.status = (int *)resize(m->of.status, count, sizeof *m->of.status);
    m->of.bad = (size_t *)resize(m->of.bad, count, sizeof *m->of.bad);
    m->of.length = (double *)resize(m->of.length, count, sizeof *m->of.length);
    m->of.turning = (double *)resize(m->of.turning, count, sizeof *m->of.turning);
    m->of.area = (double *)resize(m->of.area, count, sizeof *m->of.area);
    m->of.mu = (double *)resize(m->of.mu, count, ranks * sizeof *m->of.mu);
    m->of.theta = (double *)resize(m->of.theta, count, ranks * sizeof *m->of.theta);
    m->error = (double *)resize(m->error, count, ranks * sizeof *m->error);
    m->crossing = (size_t *)resize(m->crossing, count, 2 * sizeof *m->crossing);
    m->reversed = (unsigned char *)resize(m->reversed, count, 1);
    m->room = count;
}

static void free_edges(edges *e)
{
    free(e->length);
    free(e->turning);
}

static void end_measures(measures *m)
{
    free(m->of.status);
    free(m->of.bad);
    free(m->of.length);
    free(m->of.turning);
    free(m->of.area);
    free(m->of.mu);
    free(m->of.theta);
    free(m->scratch);
    free(m->g);
    free(m->error);
    free(m->sharp);
    free(m->crossing);
    free(m->reversed);
    free_edges(&m->edges);
    free(m->phase);
    free(m->direction);
    free(m->coherence);
}

/* --- the library -------------------------------------------------------------------------------------------------- */

static double radius_of(const options *o)
{
    return o->radius > 0 ? o->radius : 1;
}

static void measure_edges(edges *e, const polygon *p, double radius)
{
    e->length = (double *)grow(e->length, &e->length_room, p->n, sizeof *e->length);
    e->turning = (double *)grow(e->turning, &e->turning_room, p->n, sizeof *e->turning);
    switch (p->surface) {
    case PLANE: surfmink_edges_plane(p->corner, p->n, e->length, e->turning, NULL); break;
    case SPHERE: surfmink_edges_sphere(p->corner, p->n, radius, e->length, e->turning, NULL); break;
    default: surfmink_edges_embedded(p->corner, p->normal, p->n, e->length, e->turning, NULL); break;
    }
}

/* --order 4 and --error measure curves, one by one. */
static int measures_curves(const options *o)
{
    return o->order == 4 || o->error;
}

/* Which corners are sharp, for --sharp; NULL without it. Of an outline that is refused it does not matter. */
static const unsigned char *find_sharp(measures *m, const polygon *p, const options *o)
{
    size_t i;
    if (!(o->sharp > 0) || p->n < 3) return NULL;
    m->sharp = (unsigned char *)grow(m->sharp, &m->sharp_room, p->n, 1);
    m->edges.turning = (double *)grow(m->edges.turning, &m->edges.turning_room, p->n, sizeof *m->edges.turning);
    for (i = 0; i < p->n; ++i) m->edges.turning[i] = 0;
    measure_edges(&m->edges, p, radius_of(o));
    for (i = 0; i < p->n; ++i) m->sharp[i] = fabs(m->edges.turning[i]) * 57.295779513082323 > o->sharp;
    return m->sharp;
}

static void measure_curve(measures *m, const polygon *p, size_t i, const options *o)
{
    size_t ranks = (size_t)o->max_rank + 1;
    const unsigned char *sharp = find_sharp(m, p, o);
    double *mu = m->of.mu + i * ranks, *error = o->error ? m->error + i * ranks : NULL;
    surfmink_functionals w = {0, 0, 0, 0, 0};
    int status;
    m->scratch = (double *)grow(m->scratch, &m->scratch_room, 8 * p->n, sizeof *m->scratch);
    switch (p->surface) {
    case PLANE:
        status = surfmink_curve_plane(p->corner, sharp, p->n, o->order, o->max_rank, m->scratch, mu, error, m->g, &w,
                                      m->of.bad + i);
        break;
    case SPHERE:
        status = surfmink_curve_sphere(p->corner, sharp, p->n, radius_of(o), o->order, o->max_rank, m->scratch, mu,
                                       error, m->g, &w, m->of.bad + i);
        break;
    default:
        status = surfmink_curve_embedded(p->corner, p->normal, sharp, p->n, o->order, o->max_rank, m->scratch, mu,
                                         error, m->g, &w, m->of.bad + i);
    }
    if (status == SURFMINK_OK) status = surfmink_spectrum(m->g, o->max_rank, NULL, NULL, m->of.theta + i * ranks);
    m->of.status[i] = status;
    m->of.length[i] = w.length;
    m->of.turning[i] = w.turning;
    m->of.area[i] = w.area;
}

/* The polygons from `first` to before `end`, as they now are. */
static void measure_range(measures *m, const batch *b, size_t first, size_t end, const options *o)
{
    size_t ranks = (size_t)o->max_rank + 1, count = end - first, i;
    surfmink_results r = m->of;
    r.status += first;
    r.bad += first;
    r.length += first;
    r.turning += first;
    r.area += first;
    r.mu = o->transport == SURFMINK_PARALLEL ? NULL : r.mu + first * ranks;
    r.theta = o->transport == SURFMINK_PARALLEL ? NULL : r.theta + first * ranks;
    for (i = first; i < end && measures_curves(o); ++i) measure_curve(m, &b->polygon[i], i, o);
    switch (measures_curves(o) ? -1 : b->polygon[first].surface) {
    case -1: break;
    case PLANE: surfmink_batch_plane(b->corner, b->offset + first, count, o->max_rank, &r, m->scratch); break;
    case SPHERE:
        surfmink_batch_sphere(b->corner, b->offset + first, count, radius_of(o), o->max_rank, &r, m->scratch);
        break;
    default: surfmink_batch_embedded(b->corner, b->normal, b->offset + first, count, o->max_rank, &r, m->scratch);
    }
    for (i = first; i < end; ++i)
        if (b->polygon[i].fault != SURFMINK_OK) m->of.status[i] = b->polygon[i].fault;
}

/* Outlines of more corners than this are only looked at with --crossings always: 2,000 corners take 0.3 ms. */
enum { MOST_TO_CROSS = 2000 };

/* Edges that cross: turning and area do not give all of them away. What crosses itself is nothing else, so it is not
   turned round either. */
static void find_crossings(measures *m, const batch *b, const options *o)
{
    size_t i, *pair;
    int found;
    for (i = 0; i < b->count; ++i) {
        const polygon *p = &b->polygon[i];
        int status = m->of.status[i];
        pair = m->crossing + 2 * i;
        pair[0] = pair[1] = p->n;
        if (status != SURFMINK_OK && status != SURFMINK_CLOCKWISE && status != SURFMINK_CROSSES_ITSELF &&
            status != SURFMINK_TOO_MUCH_CURVATURE)
            continue;
        if (o->crossings == CROSSINGS_NEVER || (o->crossings == CROSSINGS_AUTO && p->n > MOST_TO_CROSS)) continue;
        switch (p->surface) {
        case PLANE: found = crossings_plane(p->corner, p->n, pair); break;
        case SPHERE: found = crossings_sphere(p->corner, p->n, pair); break;
        default: found = crossings_embedded(p->corner, p->normal, p->n, pair);
        }
        if (found == CROSSINGS_NO_MEMORY) die("surfmink: out of memory");
        if (found == 1) m->of.status[i] = SURFMINK_CROSSES_ITSELF;
    }
}

/* For --reverse auto: the clockwise ones are turned round and measured again, in runs of such. */
static void measure_reversed(measures *m, batch *b, const options *o)
{
    size_t first, end;
    for (first = 0; first < b->count; first = end + 1) {
        for (end = first; end < b->count && m->of.status[end] == SURFMINK_CLOCKWISE; ++end) {
            reverse_corners(&b->polygon[end]);
            m->reversed[end] = 1;
        }
        if (end > first) measure_range(m, b, first, end, o);
    }
}

/* For --transport parallel: mu and theta of the classical transport. What the corrected one refuses is refused. */
static void measure_parallel(measures *m, const batch *b, const options *o)
{
    size_t ranks = (size_t)o->max_rank + 1, i;
    for (i = 0; i < b->count; ++i) {
        const polygon *p = &b->polygon[i];
        int *status = &m->of.status[i];
        if (*status != SURFMINK_OK) continue;
        measure_edges(&m->edges, p, radius_of(o));
        *status = surfmink_irreducible_parallel(m->edges.length, m->edges.turning, p->n, 0, 0.5, o->max_rank, m->g);
        if (*status == SURFMINK_OK)
            *status = surfmink_spectrum(m->g, o->max_rank, NULL, m->of.mu + i * ranks, m->of.theta + i * ranks);
        if (*status != SURFMINK_OK) m->of.bad[i] = p->n;
    }
}

static void measure_batch(measures *m, batch *b, const options *o)
{
    place_polygons(b);
    make_room(m, b->count, o->max_rank);
    m->scratch = (double *)grow(m->scratch, &m->scratch_room, 2 * b->offset[b->count], sizeof *m->scratch);
    memset(m->reversed, 0, b->count);
    measure_range(m, b, 0, b->count, o);
    find_crossings(m, b, o);
    if (o->reverse == REVERSE_AUTO) measure_reversed(m, b, o);
    if (o->transport == SURFMINK_PARALLEL) measure_parallel(m, b, o);
}

/* --- one polygon -------------------------------------------------------------------------------------------------- */

/* Below this mu_p is rounding noise, and so is any direction. */
static int has_direction(const measure *m, int p)
{
    return m->mu[p] >= 1e-12;
}

/* Nor is there one where the edges contradict each other. */
static int has_director(const measure *m, int p)
{
    return has_direction(m, p) && m->coherence[p] >= 1e-12;
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

static int find_frame(const polygon *p, double frame[9])
{
    switch (p->surface) {
    case PLANE: return surfmink_frame_plane(p->corner, p->n, 0, frame);
    case SPHERE: return sphere_frame(p, frame);
    default: return surfmink_frame_embedded(p->corner, p->normal, p->n, 0, frame);
    }
}

/* For --directions center and the strokes of pictures. Of g only the angles count. */
static int find_director(measures *m, const polygon *p, measure *one, const options *o)
{
    double *length, *phase, *e = m->direction, *c = m->coherence;
    int status;
    size_t k, r;
    for (k = 0; k < 3; ++k) one->centre[k] = one->normal[k] = k == 2 && p->surface == PLANE ? 1 : 0;
    one->centre[2] = 0;
    measure_edges(&m->edges, p, radius_of(o));
    m->phase = (double *)grow(m->phase, &m->phase_room, p->n, sizeof *m->phase);
    length = m->edges.length;
    phase = m->phase;
    if (surfmink_phases(m->edges.turning, p->n, o->transport, phase) != SURFMINK_OK) return 0;
    for (r = 0; r <= (size_t)o->max_rank; ++r) {
        m->g[2 * r] = one->mu[r] * cos((double)r * one->theta[r]);
        m->g[2 * r + 1] = one->mu[r] * sin((double)r * one->theta[r]);
    }
    switch (p->surface) {
    case PLANE:
        status = surfmink_director_plane(p->corner, p->n, length, phase, m->g, o->max_rank, phase, one->centre, e, c);
        break;
    case SPHERE:
        status = surfmink_director_sphere(p->corner, p->n, length, phase, m->g, o->max_rank, phase, one->normal, e, c);
        for (k = 0; k < 3; ++k) one->centre[k] = radius_of(o) * one->normal[k];
        break;
    default:
        status = surfmink_director_embedded(p->corner, p->normal, p->n, length, phase, m->g, o->max_rank, phase,
                                            one->centre, one->normal, e, c);
    }
    return status == SURFMINK_OK;
}

static unsigned long line_to_blame(const polygon *p, size_t bad)
{
    if (p->fault != SURFMINK_OK) return p->fault_line;
    return bad < p->n ? p->line[bad] : p->first_line;
}

/* What may be the cause of a refusal by the whole outline: a spike, or an edge that is none. */
static void find_hint(measure *one, const polygon *p)
{
    size_t at;
    one->hint_line = 0;
    one->hint_edge = 0;
    if (p->n < 3 || p->fault != SURFMINK_OK) return;
    if (one->status != SURFMINK_CLOCKWISE && one->status != SURFMINK_CROSSES_ITSELF &&
        one->status != SURFMINK_TOO_MUCH_CURVATURE && one->status != SURFMINK_COINCIDENT_CORNERS)
        return;
    at = find_spike(p);
    if (at < p->n && one->status != SURFMINK_COINCIDENT_CORNERS) one->hint_line = p->line[at];
    if (at < p->n || one->status == SURFMINK_COINCIDENT_CORNERS) return;
    at = find_short_edge(p, &one->hint_edge);
    if (at < p->n) one->hint_line = p->line[at + 1 < p->n ? at + 1 : 0];
}

static measure measure_of(measures *m, const batch *b, size_t i, const options *o)
{
    const polygon *p = &b->polygon[i];
    size_t ranks = (size_t)o->max_rank + 1, k;
    measure one;
    one.status = m->of.status[i];
    one.n = p->n;
    one.id = p->id;
    one.surface = p->surface;
    one.reversed = m->reversed[i];
    for (k = 0; k < 2; ++k) {
        size_t edge = m->crossing[2 * i + k];
        one.crossing[k] = edge < p->n ? p->line[edge] : 0;
    }
    find_hint(&one, p);
    one.line = one.status == SURFMINK_OK ? p->first_line : line_to_blame(p, m->of.bad[i]);
    one.length = m->of.length[i];
    one.turning = m->of.turning[i];
    one.area = m->of.area[i];
    one.mu = m->of.mu + i * ranks;
    one.theta = m->of.theta + i * ranks;
    one.error = o->error ? m->error + i * ranks : NULL;
    one.has_frame = one.status == SURFMINK_OK && o->directions && find_frame(p, one.frame) == SURFMINK_OK;
    one.direction = m->direction;
    one.coherence = m->coherence;
    one.has_director =
        one.status == SURFMINK_OK && (o->directions == AT_CENTER || o->svg) && find_director(m, p, &one, o);
    return one;
}

#endif
