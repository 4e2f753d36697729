/* measure.h - step 3 of the command: a batch of polygons -> the measure of each, or the reason why it has none. */
#ifndef SURFMINK_COMMAND_MEASURE_H
#define SURFMINK_COMMAND_MEASURE_H

#include "../beyond/gradient.h"
#include "batch.h"
#include "repair.h"

/* Of one polygon. */
typedef struct measure {
    int status;         /* of enum surfmink_status, surfmink_curve_status or fault; unless OK only n and line count */
    size_t n;           /* corners, as measured */
    const char *id;     /* as long as the batch is */
    unsigned long line; /* of the corner to blame, or of the whole outline; 0: it has none */
    size_t crossing[2]; /* two edges that cross, or if the status is OK seem to; n: not known */
    unsigned long crossing_line[2];
    unsigned long hint_line; /* of what may be the cause of a refusal; 0: not known */
    double hint_edge;        /* the cause: an edge so short, of the perimeter; 0: a spike, */
    double hint_width;       /* so wide, of the perimeter */
    int reversed;            /* --reverse auto turned it round */
    int surface;
    int has_means, is_mirrored; /* as in polygon */
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
    const double *sigma;         /* P + 1, for --noise; NULL: not asked for, or not known */
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
    double *phase, *direction, *coherence, *sigma;
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
    m->sigma = (double *)resize(NULL, (size_t)max_rank + 1, sizeof *m->sigma);
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
    free(m->sigma);
}

/* --- the library -------------------------------------------------------------------------------------------------- */

static double radius_of(const options *o)
{
    return o->radius > 0 ? o->radius : 1;
}

/* How the library sees corners, and normals if they are EMBEDDED. */
static surfmink_outline outline_of(int surface, const double *corner, const double *normal, size_t n, const options *o)
{
    if (surface == PLANE) return surfmink_plane(corner, n);
    return surface == SPHERE ? surfmink_sphere(corner, n, radius_of(o)) : surfmink_embedded(corner, normal, n);
}

static surfmink_outline outline_of_polygon(const polygon *p, const options *o)
{
    return outline_of(p->surface, p->corner, p->normal, p->n, o);
}

static void measure_edges(edges *e, const surfmink_outline *outline)
{
    e->length = (double *)grow(e->length, &e->length_room, outline->n, sizeof *e->length);
    e->turning = (double *)grow(e->turning, &e->turning_room, outline->n, sizeof *e->turning);
    surfmink_edges(outline, e->length, e->turning, NULL);
}

/* --order 4 and --error measure curves, one by one. */
static int measures_curves(const options *o)
{
    return o->order == 4 || o->error;
}

/* Which corners are sharp, for --sharp; NULL without it. Of an outline that is refused it does not matter. */
static const unsigned char *find_sharp(measures *m, const surfmink_outline *outline, const options *o)
{
    size_t i;
    if (!(o->sharp > 0) || outline->n < 3) return NULL;
    m->sharp = (unsigned char *)grow(m->sharp, &m->sharp_room, outline->n, 1);
    m->edges.turning = (double *)grow(m->edges.turning, &m->edges.turning_room, outline->n, sizeof *m->edges.turning);
    for (i = 0; i < outline->n; ++i) m->edges.turning[i] = 0;
    measure_edges(&m->edges, outline);
    for (i = 0; i < outline->n; ++i) m->sharp[i] = fabs(m->edges.turning[i]) * 57.295779513082323 > o->sharp;
    return m->sharp;
}

static void measure_curve(measures *m, const polygon *p, size_t i, const options *o)
{
    size_t ranks = (size_t)o->max_rank + 1;
    surfmink_outline outline = outline_of_polygon(p, o);
    surfmink_functionals w = {0, 0, 0, 0, 0};
    surfmink_curve_options how;
    surfmink_curve_results to;
    int status;
    m->scratch =
        (double *)grow(m->scratch, &m->scratch_room, SURFMINK_CURVE_SCRATCH(p->n, o->max_rank), sizeof *m->scratch);
    how.order = o->order;
    how.sharp = find_sharp(m, &outline, o);
    how.curvature = 0;
    how.curvature_at = NULL;
    to.mu = m->of.mu + i * ranks;
    to.error = o->error ? m->error + i * ranks : NULL;
    to.g = m->g;
    to.w = &w;
    status = surfmink_curve(&outline, &how, o->max_rank, m->scratch, &to, m->of.bad + i);
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
    surfmink_outline all;
    r.status += first;
    r.bad += first;
    r.length += first;
    r.turning += first;
    r.area += first;
    r.mu = o->transport == SURFMINK_PARALLEL ? NULL : r.mu + first * ranks;
    r.theta = o->transport == SURFMINK_PARALLEL ? NULL : r.theta + first * ranks;
    all = outline_of(b->polygon[first].surface, b->corner, b->normal, b->offset[b->count], o);
    for (i = first; i < end && measures_curves(o); ++i) measure_curve(m, &b->polygon[i], i, o);
    if (!measures_curves(o)) surfmink_batch(&all, b->offset + first, count, o->max_rank, &r, m->scratch);
    for (i = first; i < end; ++i)
        if (b->polygon[i].fault != SURFMINK_OK) m->of.status[i] = b->polygon[i].fault;
}

/* What crosses itself is nothing else, so it is not turned round either. */
static void find_crossings(measures *m, const batch *b, const options *o)
{
    size_t i;
    for (i = 0; i < b->count; ++i)
        if (find_crossing(&b->polygon[i], m->of.status[i], o, m->crossing + 2 * i) == 1)
            m->of.status[i] = SURFMINK_CROSSES_ITSELF;
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
        surfmink_outline outline = outline_of_polygon(p, o);
        int *status = &m->of.status[i];
        if (*status != SURFMINK_OK) continue;
        measure_edges(&m->edges, &outline);
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

/* For --directions center and the strokes of pictures. Of g only the angles count. */
static int find_director(measures *m, const surfmink_outline *outline, measure *one, const options *o)
{
    size_t k, r;
    surfmink_middle middle;
    middle.direction = m->direction;
    middle.coherence = m->coherence;
    measure_edges(&m->edges, outline);
    m->phase = (double *)grow(m->phase, &m->phase_room, outline->n, sizeof *m->phase);
    if (surfmink_phases(m->edges.turning, outline->n, o->transport, m->phase) != SURFMINK_OK) return 0;
    for (r = 0; r <= (size_t)o->max_rank; ++r) {
        m->g[2 * r] = one->mu[r] * cos((double)r * one->theta[r]);
        m->g[2 * r + 1] = one->mu[r] * sin((double)r * one->theta[r]);
    }
    if (surfmink_director(outline, m->edges.length, m->phase, m->g, o->max_rank, m->phase, &middle) != SURFMINK_OK)
        return 0;
    for (k = 0; k < 3; ++k) {
        one->centre[k] = middle.centre[k];
        one->normal[k] = middle.normal[k];
    }
    return 1;
}

/* p S over the mean edge: up to here sigma has been compared with draws, and was 0.83 to 1.36 of theirs. */
static const double MOST_NOISE = 0.6;

/* For --noise. */
static const double *find_sigma(measures *m, const surfmink_outline *outline, double length, const options *o)
{
    double edge = length / (double)outline->n, deviation = o->deviation * (o->deviation_relative ? edge : 1);
    surfmink_uncertainty out = {NULL, NULL, NULL, NULL};
    int p;
    out.sigma = m->sigma;
    m->scratch =
        (double *)grow(m->scratch, &m->scratch_room, surfmink_noise_room(outline->n, o->max_rank), sizeof *m->scratch);
    if (surfmink_noise(outline, o->max_rank, deviation, &out, m->scratch) != SURFMINK_OK) return NULL;
    for (p = 1; p <= o->max_rank; ++p)
        if (!(p * deviation <= MOST_NOISE * edge)) m->sigma[p] = (double)NAN;
    return m->sigma;
}

static unsigned long line_to_blame(const polygon *p, size_t bad)
{
    if (p->fault != SURFMINK_OK) return p->fault_line;
    return bad < p->n ? p->line[bad] : p->first_line;
}

/* Is the whole outline as thin as a spike? */
static int is_sliver(const polygon *p)
{
    double area[3], reach = reach_of(p, 0);
    area_vector(p, 0, p->n, area);
    return hypot(hypot(area[0], area[1]), area[2]) < spike_angle * reach * reach;
}

/* What may be the cause of a refusal by the whole outline: a spike, or an edge that is none. A spike in an outline that
   is measured is a hint, too. */
static void find_hint(measure *one, const polygon *p)
{
    size_t at;
    one->hint_line = 0;
    one->hint_edge = 0;
    if (p->n < 3 || p->fault != SURFMINK_OK) return;
    if (one->status != SURFMINK_CLOCKWISE && one->status != SURFMINK_CROSSES_ITSELF &&
        one->status != SURFMINK_TOO_MUCH_CURVATURE && one->status != SURFMINK_OK)
        return;
    at = find_spike(p, &one->hint_width);
    if (at < p->n && one->hint_width > 0 && is_sliver(p)) at = p->n; /* all of it is one spike, and no fault */
    if (at < p->n) {
        one->hint_line = p->line[at];
        one->hint_width /= perimeter_of(p);
    }
    if (at < p->n || one->status == SURFMINK_OK) return;
    at = find_short_edge(p, &one->hint_edge);
    if (at < p->n) one->hint_line = p->line[at + 1 < p->n ? at + 1 : 0];
}

static measure measure_of(measures *m, const batch *b, size_t i, const options *o)
{
    const polygon *p = &b->polygon[i];
    surfmink_outline outline = outline_of_polygon(p, o);
    size_t ranks = (size_t)o->max_rank + 1, k;
    measure one;
    one.status = m->of.status[i];
    one.n = p->n;
    one.id = p->id;
    one.surface = p->surface;
    one.has_means = p->has_means;
    one.is_mirrored = p->is_mirrored;
    one.reversed = m->reversed[i];
    for (k = 0; k < 2; ++k) {
        one.crossing[k] = m->crossing[2 * i + k];
        one.crossing_line[k] = one.crossing[k] < p->n ? p->line[one.crossing[k]] : 0;
    }
    find_hint(&one, p);
    one.line = one.status == SURFMINK_OK ? p->first_line : line_to_blame(p, m->of.bad[i]);
    one.length = m->of.length[i];
    one.turning = m->of.turning[i];
    one.area = m->of.area[i];
    one.mu = m->of.mu + i * ranks;
    one.theta = m->of.theta + i * ranks;
    one.error = o->error ? m->error + i * ranks : NULL;
    one.has_frame = one.status == SURFMINK_OK && o->directions && surfmink_frame(&outline, 0, one.frame) == SURFMINK_OK;
    one.sigma = one.status == SURFMINK_OK && o->noise ? find_sigma(m, &outline, one.length, o) : NULL;
    one.direction = m->direction;
    one.coherence = m->coherence;
    one.has_director =
        one.status == SURFMINK_OK && (o->directions == AT_CENTER || o->svg) && find_director(m, &outline, &one, o);
    return one;
}

#endif
