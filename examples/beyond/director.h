/* director.h - the directions of an outline at its centre, for surfmink.h - MIT or public domain, as surfmink.h

     double length[6], phase[6], g[14], lag[6], direction[21], coherence[7];
     surfmink_middle middle = {{0}, {0}, {0}, direction, coherence};
     surfmink_edges(&cell, length, phase, NULL);                        // a cell of 6 corners in space
     surfmink_phases(phase, 6, SURFMINK_CORRECTED, phase);
     surfmink_irreducible(length, phase, 6, 6, g);
     surfmink_director(&cell, length, phase, g, 6, lag, &middle);       // direction + 3 p is where rank p points

   An outline has one eigenvector of rank p for each of its edges: transports of each other along the outline. A glyph
   and an average over many outlines want one direction at the centre instead. Every edge tilts its copy to the centre
   by the smallest rotation that takes the normal of the edge to the mean normal. The directions found there are
   averaged, p times their angle, weighted by length.

   One header to copy beside surfmink.h. C99 and C++11, only public calls. Every function is static inline. */
#ifndef SURFMINK_DIRECTOR_H
#define SURFMINK_DIRECTOR_H

#ifndef SURFMINK_H
#include "surfmink.h"
#endif
#include <math.h>

/* The centre of an outline. */
typedef struct surfmink_middle {
    double centre[3];  /* out: mean of the outline, by length; plane: z = 0; sphere: radius times the normal */
    double normal[3];  /* out: unit, mean of the normals of the edges, by length; plane: 0 0 1 */
    double axis[3];    /* out: unit, the co-normal of edge 0 tilted to the centre; plane: z = 0 */
    double *direction; /* (P + 1) dim, dim = 2 in the plane, else 3; out: unit, orthogonal to the normal: eigenvector
                          n = 0 of +lambda_p; the others follow in steps of 2 pi / p. Rank 0 has none: 0. Or NULL */
    double *coherence; /* P + 1, out: in [0, 1], how well the edges agree: 1 if all do, as in the plane; depends on the
                          outline and on p, not on g. Only beside direction; or NULL */
} surfmink_middle;

static inline double surfmink_director__dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void surfmink_director__cross(const double *a, const double *b, double *c)
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Co-normal and normal at the middle of edge i. */
static inline int surfmink_director__edge(const surfmink_outline *o, size_t i, double nu[3], double normal[3])
{
    double frame[9] = {0, 0, 0, 0, 0, 0, 0, 0, 1};
    int k, status = surfmink_frame(o, i, frame);
    if (o->kind == SURFMINK_PLANE) frame[2] = 0; /* nu tau, two numbers each */
    for (k = 0; k < 3; ++k) {
        nu[k] = frame[k];
        normal[k] = frame[6 + k];
    }
    return status;
}

/* Means along the outline: of the normals of its edges, and of its points, as seen from corner 0 so that digits survive
   far away, and in quarters so that nothing overflows. */
static inline int surfmink_director__means(const surfmink_outline *o, const double *length, double total,
                                           surfmink_middle *m)
{
    const double least = 1e-6; /* a shorter mean normal is what cancellation leaves, as of a belt round a cylinder */
    const size_t dim = o->kind == SURFMINK_PLANE ? 2 : 3;
    const double *origin = o->corner, *x, *y;
    double nu[3], n[3], sum[3] = {0, 0, 0}, mean[3] = {0, 0, 0}, weight, norm;
    size_t i, k;
    int status;
    for (i = 0; i < o->n; ++i) {
        if ((status = surfmink_director__edge(o, i, nu, n)) != SURFMINK_OK) return status;
        x = origin + dim * i;
        y = i + 1 < o->n ? x + dim : origin;
        weight = length[i] / total;
        for (k = 0; k < 3; ++k) mean[k] += weight * n[k];
        for (k = 0; k < dim; ++k)
            sum[k] += weight * ((0.25 * x[k] - 0.25 * origin[k]) + (0.25 * y[k] - 0.25 * origin[k]));
    }
    norm = sqrt(surfmink_director__dot(mean, mean));
    if (!(norm > least)) return SURFMINK_ZERO_NORMAL;
    for (k = 0; k < 3; ++k) {
        m->normal[k] = mean[k] / norm;
        m->centre[k] = k < dim ? (origin[k] + sum[k]) + sum[k] : 0;
        if (o->kind == SURFMINK_SPHERE) m->centre[k] = o->radius * m->normal[k];
    }
    return SURFMINK_OK;
}

/* The co-normal of edge i, tilted to the mean normal N by the smallest rotation that takes n there: as nu is orthogonal
   to n, that is the mirror image in the plane orthogonal to n + N. */
static inline int surfmink_director__tilted(const surfmink_outline *o, size_t i, const double normal[3],
                                            double tilted[3])
{
    const double opposite = 1e-12; /* |n + N|^2 within 1e-6 rad of opposite normals, where no rotation is smallest */
    double nu[3], n[3], s[3], part;
    int k, status = surfmink_director__edge(o, i, nu, n);
    for (k = 0; k < 3; ++k) s[k] = n[k] + normal[k];
    if (status == SURFMINK_OK && !(surfmink_director__dot(s, s) > opposite)) status = SURFMINK_ZERO_NORMAL;
    if (status != SURFMINK_OK) return status;
    part = 2 * surfmink_director__dot(nu, s) / surfmink_director__dot(s, s);
    for (k = 0; k < 3; ++k) tilted[k] = nu[k] - part * s[k];
    return SURFMINK_OK;
}

/* The directions at the centre, one for each rank.
   o                  plane, sphere or embedded: a surface by callbacks has no space to tilt in
   length, phase n    from steps 1 and 2; the phases of the transport that g was made with
   g         2 P + 2  only its arguments count
   lag         n      out: chi_i - f_i, below; may be the same array as phase, which is then lost. Written on failure,
   too
   middle             out; untouched on failure, and so are its arrays
   Where mu_p or the coherence is no more than rounding noise (1e-14) the directions are noise too.
   Errors: as surfmink_irreducible and surfmink_frame; ZERO_NORMAL: the mean of the normals is shorter than 1e-6, or one
   of them is opposite to it within 1e-6 rad; BAD_ARGUMENT: a surface by callbacks, or all lengths are 0.
   Cost: O(n P), two frames and one atan2 an edge, and surfmink_irreducible. Paper 2.4, seen from the centre.

   With chi_i the angle of the tilted co-normal i against that of edge 0, an eigenvector has the angle theta + chi_i -
   f_i there. So theta stays out of the average, sum l_i exp(i p (chi_i - f_i)), which is integrated like g_p. */
static inline int surfmink_director(const surfmink_outline *o, const double *length, const double *phase,
                                    const double *g, int max_rank, double *lag, surfmink_middle *middle)
{
    surfmink_middle m = *middle;
    double total = 0, e2[3], nu[3], angle, cosine, sine;
    size_t i, k, p, ranks = (size_t)max_rank + 1, dim = o->kind == SURFMINK_PLANE ? 2 : 3;
    int status;
    if (max_rank < 0 || o->kind == SURFMINK_SURFACE) return SURFMINK_BAD_ARGUMENT;
    if (o->n < 3) return SURFMINK_TOO_FEW_CORNERS;
    for (i = 0; i < o->n; ++i) {
        if (!(length[i] - length[i] == 0 && phase[i] - phase[i] == 0)) return SURFMINK_NOT_FINITE;
        if (!(length[i] >= 0)) return SURFMINK_BAD_ARGUMENT;
        total += length[i];
    }
    for (i = 0; i < 2 * ranks; ++i)
        if (!(g[i] - g[i] == 0)) return SURFMINK_NOT_FINITE;
    if (!(total - total == 0)) return SURFMINK_NOT_FINITE;
    if (!(total > 0)) return SURFMINK_BAD_ARGUMENT;
    if ((status = surfmink_director__means(o, length, total, &m)) != SURFMINK_OK) return status;
    for (i = 0; i < o->n; ++i) {
        if ((status = surfmink_director__tilted(o, i, m.normal, nu)) != SURFMINK_OK) return status;
        for (k = 0; k < 3 && i == 0; ++k) m.axis[k] = nu[k];
        if (i == 0) surfmink_director__cross(m.normal, m.axis, e2);
        lag[i] = atan2(surfmink_director__dot(nu, e2), surfmink_director__dot(nu, m.axis)) - phase[i];
    }
    if (m.direction) { /* 2 P + 2 numbers for now */
        if ((status = surfmink_irreducible(length, lag, o->n, max_rank, m.direction)) != SURFMINK_OK) return status;
        for (p = 0; p < ranks && m.coherence; ++p)
            m.coherence[p] = fmin(1, hypot(m.direction[2 * p], m.direction[2 * p + 1]) / m.direction[0]);
    }
    for (p = ranks; p-- > 1 && m.direction;) { /* backwards: the sums lie in front of where the vectors go */
        const double *sum = m.direction + 2 * p;
        angle = (atan2(sum[1], sum[0]) + atan2(g[2 * p + 1], g[2 * p])) / (double)p;
        cosine = cos(angle);
        sine = sin(angle);
        for (k = 0; k < dim; ++k) m.direction[p * dim + k] = cosine * m.axis[k] + sine * e2[k];
    }
    for (k = 0; k < dim && m.direction; ++k) m.direction[k] = 0;
    *middle = m;
    return SURFMINK_OK;
}

#endif
