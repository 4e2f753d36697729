/* camera.h - where a picture is seen from: an orthographic eye, infinitely far away. */
#ifndef SURFMINK_PICTURE_CAMERA_H
#define SURFMINK_PICTURE_CAMERA_H

#include "../../surfmink.h"

#include <math.h>

typedef struct camera {
    double right[3], up[3], eye[3]; /* orthonormal, right-handed; eye points from the surface towards the eye */
} camera;

static inline double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* Above a longitude and latitude, north up. At a pole the longitude still says what is down. Returns 0 for latitudes
   that do not exist. */
static inline int look_from_lonlat(camera *c, double lon, double lat)
{
    if (surfmink_from_lonlat(lon, lat, 1, c->eye) != SURFMINK_OK) return 0;
    surfmink_from_lonlat(lat < 0 ? lon : lon + 180, 90 - fabs(lat), 1, c->up);
    cross(c->up, c->eye, c->right);
    return 1;
}

/* From a direction, z up. Seen along z, y is up, as under a microscope. */
static inline void look_from(camera *c, const double direction[3])
{
    const double degree = 0.017453292519943296;
    double across = hypot(direction[0], direction[1]);
    if (across > 0)
        look_from_lonlat(c, atan2(direction[1], direction[0]) / degree, atan2(direction[2], across) / degree);
    else
        look_from_lonlat(c, direction[2] > 0 ? -90 : 90, direction[2] > 0 ? 90 : -90);
}

/* To the right, up, and towards the eye. */
static inline void to_view(const camera *c, const double x[3], double view[3])
{
    view[0] = dot(c->right, x);
    view[1] = dot(c->up, x);
    view[2] = dot(c->eye, x);
}

#endif
