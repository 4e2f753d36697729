/* torus.h - the torus as a surface for surfmink.h - MIT or public domain, as surfmink.h

     double radius[2] = {2.0, 1.375};                // from the axis to the middle of the tube, of the tube
     surfmink_implicit ring = surfmink_torus(radius);
     surfmink_surface surface = surfmink_implicit_surface(&ring);    // corners x y z, edges are the shortest geodesics
     surfmink_surface chart = surfmink_torus_chart(radius);          // corners phi theta, see below
     surfmink_torus_point(radius, 0.6, 0.4, corner);                 // phi round the z axis, theta round the tube

   Two points of a torus are joined by many geodesics: once round the hole, twice, across. The chart chooses: its angles
   are not reduced modulo 2 pi, and an edge is the geodesic that the straight segment in (phi, theta) is pulled tight
   to. So the triangles of paper 5.1 are measured on the chart. A log whose exp would not end on the other corner of the
   chart is a CALLBACK_FAILED.

   Normals, curvature, exp, log, accuracy and errors: implicit.h, which this file needs beside it. */
#ifndef SURFMINK_TORUS_H
#define SURFMINK_TORUS_H

#include "implicit.h"

/* f = ((sqrt(x^2 + y^2) - R)^2 + z^2 - r^2) / 2 with its gradient and Hessian. shape: R > r > 0. The gradient vanishes
   in the middle of the tube; on the z axis there is none. */
static inline double surfmink_torus_f(const void *shape, const double x[3], double gradient[3], double hessian[6])
{
    const double *radius = (const double *)shape;
    double rho = hypot(x[0], x[1]), across = rho - radius[0], tube = hypot(across, x[2]);
    double ratio = rho > 0 ? radius[0] / rho : HUGE_VAL, c = rho > 0 ? x[0] / rho : 0, s = rho > 0 ? x[1] / rho : 0;
    gradient[0] = (1 - ratio) * x[0];
    gradient[1] = (1 - ratio) * x[1];
    gradient[2] = x[2];
    hessian[0] = 1 - ratio + ratio * c * c;
    hessian[1] = ratio * c * s;
    hessian[2] = 0;
    hessian[3] = 1 - ratio + ratio * s * s;
    hessian[4] = 0;
    hessian[5] = 1;
    return (tube - radius[1]) * (tube + radius[1]) / 2;
}

/* The torus with radius[0] = R and radius[1] = r, which must outlive it. */
static inline surfmink_implicit surfmink_torus(const double radius[2])
{
    surfmink_implicit implicit;
    implicit.f = surfmink_torus_f;
    implicit.shape = radius;
    return implicit;
}

/* The point of a chart: ((R + r cos theta) cos phi, (R + r cos theta) sin phi, r sin theta), radians (paper 5.1).
   (phi, theta) is right-handed about the outer normal. */
static inline void surfmink_torus_point(const double radius[2], double phi, double theta, double x[3])
{
    x[0] = (radius[0] + radius[1] * cos(theta)) * cos(phi);
    x[1] = (radius[0] + radius[1] * cos(theta)) * sin(phi);
    x[2] = radius[1] * sin(theta);
}

/* --- corners as phi, theta --------------------------------------------------------------------------------------- */

/* Where the geodesic that leaves x in a direction of the frame there ends in the chart. It is followed in pieces that
   turn each angle by less than half a turn, for a point in space does not tell how often it went round. Good enough to
   count rounds; digits are for one shot over the whole length. At most 1000 pieces, else BAD_ARGUMENT. */
static inline int torus__follow(const surfmink_implicit *torus, const double *x, const double *direction, double length,
                                double *end)
{
    const double *radius = (const double *)torus->shape;
    const double longest = 1.5 * fmin(radius[0] - radius[1], radius[1]); /* either angle turns by 1.5 at most */
    implicit__flow flow;
    implicit__end arrival;
    double pieces = ceil(length / longest), size = hypot(direction[0], direction[1]), frame[9], tangent[3], angle[2], i;
    int k, status;
    if (!(pieces <= 1000)) return SURFMINK_BAD_ARGUMENT;
    implicit__begin(&flow, torus, 300);
    surfmink_torus_point(radius, x[0], x[1], flow.origin);
    status = surfmink_implicit_frame(torus, flow.origin, frame);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) tangent[k] = (direction[0] * frame[k] + direction[1] * frame[3 + k]) / size;
    end[0] = x[0];
    end[1] = x[1];
    for (i = 0; i < pieces; ++i) {
        status = implicit__shoot(&flow, tangent, length / pieces, &arrival);
        if (status != SURFMINK_OK) return status;
        for (k = 0; k < 3; ++k) {
            flow.origin[k] += arrival.position[k];
            tangent[k] = arrival.velocity[k];
        }
        angle[0] = atan2(flow.origin[1], flow.origin[0]);
        angle[1] = atan2(flow.origin[2], hypot(flow.origin[0], flow.origin[1]) - radius[0]);
        for (k = 0; k < 2; ++k) end[k] += remainder(angle[k] - end[k], 6.28318530717958647693);
    }
    return SURFMINK_OK;
}

typedef struct torus__segment {
    const double *radius, *from, *to;
} torus__segment;

static inline void torus__segment_point(const void *context, double t, double point[3])
{
    const torus__segment *s = (const torus__segment *)context;
    surfmink_torus_point(s->radius, s->from[0] + t * (s->to[0] - s->from[0]), s->from[1] + t * (s->to[1] - s->from[1]),
                         point);
}

/* One of both ways is computed, so that the other cannot differ. In space a geodesic of another homotopy class ends at
   the same point: the chart tells. */
static inline int torus__log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    surfmink_implicit torus = surfmink_torus((const double *)context);
    torus__segment segment;
    double there[2], back[2], end[2], found;
    int k, status, reversed = x[0] > y[0] || (x[0] == y[0] && x[1] > y[1]);
    if (x[0] == y[0] && x[1] == y[1]) return SURFMINK_COINCIDENT_CORNERS;
    segment.radius = (const double *)context;
    segment.from = reversed ? y : x;
    segment.to = reversed ? x : y;
    status = surfmink_implicit_log_along(&torus, torus__segment_point, &segment, &found, there, back);
    if (status == SURFMINK_OK) status = torus__follow(&torus, segment.from, there, found, end);
    if (status != SURFMINK_OK) return status;
    if (!(hypot(end[0] - segment.to[0], end[1] - segment.to[1]) < 1)) return SURFMINK_CALLBACK_FAILED; /* not 2 pi */
    *length = found;
    for (k = 0; k < 2; ++k) direction[k] = reversed ? back[k] : there[k];
    return SURFMINK_OK;
}

static inline int torus__exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    const double *radius = (const double *)context;
    surfmink_implicit torus = surfmink_torus(radius);
    double start[3], point[3], end[2], angle[2], ahead[2];
    int k, status;
    surfmink_torus_point(radius, x[0], x[1], start);
    status = surfmink_implicit_exp(&torus, start, direction, length, point);
    for (k = 0; k < 2; ++k) ahead[k] = length < 0 ? -direction[k] : direction[k];
    if (status == SURFMINK_OK) status = torus__follow(&torus, x, ahead, fabs(length), end);
    if (status != SURFMINK_OK) return status;
    angle[0] = atan2(point[1], point[0]);
    angle[1] = atan2(point[2], hypot(point[0], point[1]) - radius[0]);
    for (k = 0; k < 2; ++k) y[k] = end[k] + remainder(angle[k] - end[k], 6.28318530717958647693);
    return SURFMINK_OK;
}

/* The torus with corners phi theta, stride 2; the frame is that of surfmink_implicit_frame at the point in space.
   radius is read at each call and must outlive the surface. */
static inline surfmink_surface surfmink_torus_chart(double radius[2])
{
    surfmink_surface surface;
    surface.context = radius;
    surface.stride = 2;
    surface.log = torus__log;
    surface.exp = torus__exp;
    return surface;
}

#endif /* SURFMINK_TORUS_H */
