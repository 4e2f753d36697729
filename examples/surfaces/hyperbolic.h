/* hyperbolic.h - the hyperbolic plane (K = -1) as a surface for surfmink.h - MIT or public domain, as surfmink.h

     surfmink_surface plane = surfmink_hyperbolic();                 // corners x y inside the unit circle
     double centre[2] = {0.3, -0.2}, corner[14];
     surfmink_regular_polygon(&plane, centre, 1.5, 0.0, 7, corner);  // mu_7 = 1, as in the flat plane

   The Poincare disk: points z = x + i y with |z| < 1, lengths 2 |dz| / (1 - |z|^2), geodesics are circular arcs at a
   right angle to the rim. It is not embedded in space: that is why log returns directions in a frame of its own, here
   the axes of the disk. Lengths are in units of the radius of curvature: scale them by R where K = -1 / R^2.

   exp and log are closed forms: the isometry z -> (z - a) / (1 - conj(a) z) takes a to 0, where geodesics are
   straight, and does not turn directions at a. Differences of corners are taken first, so small shapes keep all their
   digits; near the rim those of 1 - |z| count: what is rounded off the corner is lost.

   Errors: COINCIDENT_CORNERS; NOT_FINITE (a NaN, or exp so far out that the point rounds onto the rim, 36 from the
   middle); BAD_ARGUMENT (a corner on the rim or outside). Every function is static inline. */
#ifndef SURFMINK_HYPERBOLIC_H
#define SURFMINK_HYPERBOLIC_H

#ifndef SURFMINK_H
#include "surfmink.h"
#endif
#include <math.h>

/* 1 - |z|^2, with the digits that are left near the rim; not positive if z is no point of the disk, NaN for NaN. */
static inline double hyperbolic__room(const double *z)
{
    double size = hypot(z[0], z[1]);
    return (1 - size) * (1 + size);
}

/* (u / v) of complex numbers */
static inline void hyperbolic__divide(const double *u, const double *v, double *out)
{
    double square = v[0] * v[0] + v[1] * v[1], re = u[0] * v[0] + u[1] * v[1], im = u[1] * v[0] - u[0] * v[1];
    out[0] = re / square;
    out[1] = im / square;
}

/* Where y comes to lie if the plane is moved so that x comes to 0: (y - x) / (1 - conj(x) y). */
static inline int hyperbolic__seen_from(const double *x, const double *y, double *seen)
{
    double difference[2], denominator[2], room = hyperbolic__room(x), other = hyperbolic__room(y);
    if (!(room <= 1) || !(other <= 1)) return SURFMINK_NOT_FINITE; /* a NaN: finite points never have more */
    if (!(room > 0) || !(other > 0)) return SURFMINK_BAD_ARGUMENT;
    difference[0] = y[0] - x[0];
    difference[1] = y[1] - x[1];
    /* 1 - conj(x) y = 1 - |x|^2 - conj(x) (y - x): near the rim 1 - x.y would cancel */
    denominator[0] = room - (x[0] * difference[0] + x[1] * difference[1]);
    denominator[1] = x[1] * difference[0] - x[0] * difference[1];
    hyperbolic__divide(difference, denominator, seen);
    return SURFMINK_OK;
}

/* log as surfmink.h wants it: length 2 arsinh(|y - x| / sqrt((1 - |x|^2) (1 - |y|^2))), direction in the disk's
   axes. */
static inline int surfmink_hyperbolic_log(void *context, const double *x, const double *y, double *length,
                                          double direction[2])
{
    double seen[2], size, distance = hypot(y[0] - x[0], y[1] - x[1]);
    int status = hyperbolic__seen_from(x, y, seen);
    (void)context;
    if (status != SURFMINK_OK) return status;
    size = hypot(seen[0], seen[1]);
    if (!(size > 0)) return SURFMINK_COINCIDENT_CORNERS;
    *length = 2 * asinh(distance / (sqrt(hyperbolic__room(x)) * sqrt(hyperbolic__room(y))));
    direction[0] = seen[0] / size;
    direction[1] = seen[1] / size;
    return SURFMINK_OK;
}

/* exp as surfmink.h wants it: w = tanh(length / 2) direction, y = x + (1 - |x|^2) w / (1 + conj(x) w). */
static inline int surfmink_hyperbolic_exp(void *context, const double *x, const double direction[2], double length,
                                          double *y)
{
    double room = hyperbolic__room(x), reach = tanh(length / 2), w[2], denominator[2], move[2], left;
    (void)context;
    if (!(room <= 1) || !(fabs(reach) <= 1) || !(hypot(direction[0], direction[1]) < HUGE_VAL))
        return SURFMINK_NOT_FINITE;
    if (!(room > 0)) return SURFMINK_BAD_ARGUMENT;
    w[0] = reach * direction[0];
    w[1] = reach * direction[1];
    denominator[0] = 1 + (x[0] * w[0] + x[1] * w[1]);
    denominator[1] = x[0] * w[1] - x[1] * w[0];
    left = room / (denominator[0] * denominator[0] + denominator[1] * denominator[1]) / cosh(length / 2) /
           cosh(length / 2);
    if (!(left > 1e-15)) return SURFMINK_NOT_FINITE; /* 1 - |y|^2, which could not be told from 0 */
    hyperbolic__divide(w, denominator, move);
    y[0] = x[0] + room * move[0];
    y[1] = x[1] + room * move[1];
    return SURFMINK_OK;
}

/* The hyperbolic plane with its callbacks, stride 2. It has no context. */
static inline surfmink_surface surfmink_hyperbolic(void)
{
    surfmink_surface surface;
    surface.context = 0;
    surface.stride = 2;
    surface.log = surfmink_hyperbolic_log;
    surface.exp = surfmink_hyperbolic_exp;
    return surface;
}

/* Area enclosed by a geodesic polygon, positive if counter-clockwise; S = 2 pi + area. A fan of triangles from corner
   0, each 2 arg(1 - a conj(b)) once corner 0 is moved to 0: relative accuracy about 1e-15 for the smallest shapes, too;
   absolute 1e-11 with sides of 12.
   Errors: TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT. */
static inline int surfmink_hyperbolic_area(const double *corner, size_t n, double *area)
{
    double a[2], b[2], sum = 0;
    size_t i;
    int status;
    if (n < 3) return SURFMINK_TOO_FEW_CORNERS;
    status = hyperbolic__seen_from(corner, corner + 2, a);
    for (i = 2; i < n && status == SURFMINK_OK; ++i) {
        status = hyperbolic__seen_from(corner, corner + 2 * i, b);
        if (status != SURFMINK_OK) break;
        sum += 2 * atan2(a[0] * b[1] - a[1] * b[0], 1 - (a[0] * b[0] + a[1] * b[1]));
        a[0] = b[0];
        a[1] = b[1];
    }
    if (status != SURFMINK_OK) return status;
    *area = sum;
    return SURFMINK_OK;
}

#endif /* SURFMINK_HYPERBOLIC_H */
