/* ellipsoid.h - the ellipsoid with three axes as a surface for surfmink.h - MIT or public domain, as surfmink.h

     double axis[3] = {1.6, 1.3, 1.0};                               // semi-axes along x, y, z, in your unit
     surfmink_implicit body = surfmink_ellipsoid(axis);
     surfmink_surface surface = surfmink_implicit_surface(&body);    // corners x y z; body and axis must outlive it
     surfmink_ellipsoid_point(axis, 1.3, 0.6, corner);               // theta from the z axis, phi from the x axis

   Normals, curvature, exp, log, accuracy and errors: implicit.h, which this file needs beside it. */
#ifndef SURFMINK_ELLIPSOID_H
#define SURFMINK_ELLIPSOID_H

#include "implicit.h"

/* f = (x^2/a^2 + y^2/b^2 + z^2/c^2 - 1) / 2 with its gradient and Hessian. shape: the axes a, b, c > 0. */
static inline double surfmink_ellipsoid_f(const void *shape, const double x[3], double gradient[3], double hessian[6])
{
    const double *axis = (const double *)shape;
    double sum = -1;
    int k;
    for (k = 0; k < 6; ++k) hessian[k] = 0;
    for (k = 0; k < 3; ++k) {
        double share = x[k] / axis[k];
        sum += share * share;
        gradient[k] = share / axis[k];
        hessian[k == 0 ? 0 : 2 * k + 1] = 1 / (axis[k] * axis[k]);
    }
    return sum / 2;
}

/* The ellipsoid with semi-axes axis[0..2], which must outlive it. */
static inline surfmink_implicit surfmink_ellipsoid(const double axis[3])
{
    surfmink_implicit implicit;
    implicit.f = surfmink_ellipsoid_f;
    implicit.shape = axis;
    return implicit;
}

/* The point of a chart: (a sin theta cos phi, b sin theta sin phi, c cos theta), radians (paper 5.2).
   (theta, phi) is right-handed about the outer normal. */
static inline void surfmink_ellipsoid_point(const double axis[3], double theta, double phi, double x[3])
{
    x[0] = axis[0] * sin(theta) * cos(phi);
    x[1] = axis[1] * sin(theta) * sin(phi);
    x[2] = axis[2] * cos(theta);
}

#endif /* SURFMINK_ELLIPSOID_H */
