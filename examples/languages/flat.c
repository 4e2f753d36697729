/* flat.c - the library that `make shared` builds; flag -fPIC and a visible SURFMINK_DEF: see the Makefile. */
#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "../beyond/curve.h"
#include "../beyond/director.h"
#include "../beyond/gradient.h"
#include "../beyond/patic.h"
#include "flat.h"

/* A kind that is none becomes an outline that every call refuses. */
static surfmink_outline outline_of(int kind, const double *corner, const double *normal, size_t n, double radius)
{
    if (kind == SURFMINK_PLANE) return surfmink_plane(corner, n);
    if (kind == SURFMINK_EMBEDDED) return surfmink_embedded(corner, normal, n);
    return surfmink_sphere(corner, n, kind == SURFMINK_SPHERE ? radius : -1);
}

static void put_functionals(const surfmink_functionals *from, double area, double *w)
{
    if (!w) return;
    w[0] = area;
    w[1] = from->length;
    w[2] = from->turning;
    w[3] = from->curvature;
    w[4] = from->condition;
}

SURFMINK_DEF int surfmink_flat_measure(int kind, const double *corner, const double *normal, size_t n, double radius,
                                       int max_rank, double *mu, double *g, double *w, size_t *bad)
{
    surfmink_outline outline = outline_of(kind, corner, normal, n, radius);
    surfmink_functionals all;
    int status = surfmink_measure(&outline, max_rank, mu, g, &all, bad);
    if (status == SURFMINK_OK) put_functionals(&all, all.area, w);
    return status;
}

SURFMINK_DEF int surfmink_flat_measure_surface(const surfmink_surface *surface, const double *corner, size_t n,
                                               int max_rank, double *mu, double *g, double *w, size_t *bad)
{
    surfmink_outline outline = surfmink_on_surface(surface, corner, n);
    surfmink_functionals all;
    int status = surfmink_measure(&outline, max_rank, mu, g, &all, bad);
    if (status == SURFMINK_OK) put_functionals(&all, (double)NAN, w);
    return status;
}

SURFMINK_DEF size_t surfmink_flat_batch(int kind, const double *corner, const double *normal, size_t n, double radius,
                                        const size_t *offset, size_t count, int max_rank, int *status, size_t *bad,
                                        double *length, double *turning, double *area, double *mu, double *g,
                                        double *theta, double *scratch)
{
    surfmink_outline all = outline_of(kind, corner, normal, n, radius);
    surfmink_results out;
    out.status = status;
    out.bad = bad;
    out.length = length;
    out.turning = turning;
    out.area = area;
    out.mu = mu;
    out.g = g;
    out.theta = theta;
    return surfmink_batch(&all, offset, count, max_rank, &out, scratch);
}

SURFMINK_DEF int surfmink_flat_curve(int kind, const double *corner, const double *normal, size_t n, double radius,
                                     int order, const unsigned char *sharp, int max_rank, double *mu, double *error,
                                     double *g, double *w, double *scratch, size_t *bad)
{
    surfmink_outline outline = outline_of(kind, corner, normal, n, radius);
    surfmink_functionals all;
    surfmink_curve_options options;
    surfmink_curve_results out;
    int status;
    options.order = order;
    options.sharp = sharp;
    options.curvature = 0;
    options.curvature_at = NULL;
    out.mu = mu;
    out.error = error;
    out.g = g;
    out.w = &all;
    status = surfmink_curve(&outline, &options, max_rank, scratch, &out, bad);
    if (status == SURFMINK_OK) put_functionals(&all, all.area, w);
    return status;
}

SURFMINK_DEF size_t surfmink_flat_gradient(int kind, const double *corner, const double *normal, size_t n,
                                           double radius, const size_t *offset, size_t count, int max_rank,
                                           const double *by_mu, const double *by_g, const double *by_theta,
                                           const double *by_length, int shared, int *status, size_t *bad, double *mu,
                                           double *g, double *theta, double *w, double *by_corner, double *by_normal,
                                           double *scratch)
{
    surfmink_outline all = outline_of(kind, corner, normal, n, radius);
    size_t refused, i, ranks = (size_t)max_rank + 1;
    surfmink_weights weights;
    surfmink_gradients out;
    weights.mu = by_mu;
    weights.g = by_g;
    weights.theta = by_theta;
    weights.length = by_length;
    weights.shared = shared;
    out.status = status;
    out.bad = bad;
    out.mu = mu;
    out.g = g;
    out.w = (surfmink_functionals *)w; /* five numbers in the same order */
    out.by_corner = by_corner;
    out.by_normal = by_normal;
    refused = surfmink_batch_gradient(&all, offset, count, max_rank, &weights, &out, scratch);
    for (i = 0; i < count && theta; ++i)
        if (status[i] == SURFMINK_OK) surfmink_spectrum(g + 2 * ranks * i, max_rank, NULL, NULL, theta + ranks * i);
    return refused;
}

SURFMINK_DEF int surfmink_flat_director(int kind, const double *corner, const double *normal, size_t n, double radius,
                                        int max_rank, double *mu, double *g, double *w, double *centre,
                                        double *mean_normal, double *direction, double *coherence, double *scratch,
                                        size_t *bad)
{
    surfmink_outline outline = outline_of(kind, corner, normal, n, radius);
    double *length = scratch, *phase = scratch + n, *components = scratch + 2 * n;
    surfmink_functionals all;
    surfmink_middle middle;
    int k, p, status = surfmink_measure(&outline, max_rank, NULL, components, &all, bad);
    if (status != SURFMINK_OK) return status;
    middle.direction = direction;
    middle.coherence = coherence;
    status = surfmink_edges(&outline, length, phase, bad);
    if (status == SURFMINK_OK) status = surfmink_phases(phase, n, SURFMINK_CORRECTED, phase);
    if (status == SURFMINK_OK)
        status = surfmink_director(&outline, length, phase, components, max_rank, phase, &middle);
    if (status != SURFMINK_OK) { /* it has edges: the whole outline is to blame */
        if (bad) *bad = n;
        return status;
    }
    for (k = 0; k < 3 && centre; ++k) centre[k] = middle.centre[k];
    for (k = 0; k < 3 && mean_normal; ++k) mean_normal[k] = middle.normal[k];
    for (p = 0; p < 2 * (max_rank + 1) && g; ++p) g[p] = components[p];
    put_functionals(&all, all.area, w);
    return mu ? surfmink_spectrum(components, max_rank, NULL, mu, NULL) : SURFMINK_OK;
}

/* z, its mean, mu, and the memory of patic.h, which may begin anywhere. */
SURFMINK_DEF size_t surfmink_flat_patic_scratch(const size_t *offset, size_t cells, int rank)
{
    const int most_rank = 1000; /* as the command: directions are carried by powers of a complex number */
    size_t bytes = rank >= 1 && rank <= most_rank ? patic_bytes(offset, cells, rank) : 0;
    return bytes == 0 ? 0 : 5 * cells + bytes / sizeof(double) + 1;
}

static void put_vector(const double *from, size_t i, double *to)
{
    int k;
    for (k = 0; k < 3 && to; ++k) to[3 * i + (size_t)k] = from[k];
}

static void put_cells(const patic *t, int rank, const double *mu_of, const double *z, int *status, size_t *bad,
                      double *centre, double *mean_normal, double *direction, double *mu, double *order)
{
    size_t c;
    for (c = 0; c < t->cells; ++c) {
        const patic_cell *cell = &t->cell[c];
        double towards[3] = {0, 0, 0};
        if (status) status[c] = cell->status;
        if (bad) bad[c] = cell->bad;
        if (cell->status != SURFMINK_OK) continue;
        patic_direction(t, rank, z, c, towards);
        put_vector(cell->centre, c, centre);
        put_vector(cell->normal, c, mean_normal);
        put_vector(towards, c, direction);
        if (mu) mu[c] = mu_of[c];
        if (order) order[c] = hypot(z[2 * c], z[2 * c + 1]);
    }
}

static void put_defects(const patic *t, int rank, double *defect)
{
    size_t i;
    for (i = 0; i < t->defects && defect; ++i, defect += 6) {
        put_vector(t->defect[i].x, 0, defect);
        defect[3] = (double)t->defect[i].k / rank;
        defect[4] = t->defect[i].order;
        defect[5] = t->defect[i].margin;
    }
}

static void put_totals(const patic *t, int rank, double *totals)
{
    long charge = 0, boundary = 0;
    size_t i;
    for (i = 0; i < t->components; ++i) {
        charge += t->component[i].charge;
        boundary += t->component[i].boundary;
    }
    if (!totals) return;
    totals[0] = (double)t->components;
    totals[1] = (double)t->chi;
    totals[2] = (double)charge / rank;
    totals[3] = (double)boundary / rank;
    totals[4] = t->spacing;
}

SURFMINK_DEF int surfmink_flat_patic(int kind, const double *corner, const double *normal, size_t n, double radius,
                                     const size_t *offset, size_t cells, int rank, double weld, double ball,
                                     int *status, size_t *bad, double *centre, double *mean_normal, double *direction,
                                     double *mu, double *order, double *defect, size_t *defects, double *totals,
                                     double *scratch)
{
    surfmink_outline all = outline_of(kind, corner, normal, n, radius);
    double *z = scratch, *coarse, *mu_of;
    patic t;
    int failed;
    if (surfmink_flat_patic_scratch(offset, cells, rank) == 0 || offset[0] != 0 || offset[cells] > n)
        return SURFMINK_BAD_ARGUMENT;
    coarse = z + 2 * cells;
    mu_of = coarse + 2 * cells;
    failed = patic_build(&t, &all, offset, cells, rank, weld, mu_of + cells);
    if (failed == SURFMINK_OK) failed = patic_field(&t, rank, z, mu_of);
    if (failed == SURFMINK_OK) failed = patic_coarsen(&t, rank, ball < 0 ? -ball * t.spacing : ball, z, coarse);
    if (failed == SURFMINK_OK) failed = patic_charges(&t, rank, coarse);
    if (failed != SURFMINK_OK) return failed;
    patic_defects(&t, coarse);
    put_cells(&t, rank, mu_of, coarse, status, bad, centre, mean_normal, direction, mu, order);
    put_defects(&t, rank, defect);
    put_totals(&t, rank, totals);
    if (defects) *defects = t.defects;
    return SURFMINK_OK;
}

static int is_of_patic(int status)
{
    return status == PATIC_OVERLAPS || status == PATIC_MEETS_ITSELF;
}

SURFMINK_DEF const char *surfmink_flat_strerror(int status)
{
    return is_of_patic(status) ? patic_strerror(status) : surfmink_curve_strerror(status);
}

SURFMINK_DEF const char *surfmink_flat_status_name(int status)
{
    return is_of_patic(status) ? patic_status_name(status) : surfmink_curve_status_name(status);
}
