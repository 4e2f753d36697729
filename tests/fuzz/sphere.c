/* sphere.c - fuzzes what measures polygons of the sphere: measure, edges, area, frame; log, exp, and both as
   callbacks. */
#include "outline.h"

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* exp undoes log; log is tangential. */
static void log_and_exp(const outline *o, double radius)
{
    const double *x = o->corner, *y = o->corner + 3;
    double vector[3] = {-7, -7, -7}, z[3] = {-7, -7, -7}, size_x, size_y, off = 0;
    int status = surfmink_sphere_log(x, y, radius, vector), k;
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) {
        CLAIM(vector[0] == -7 && vector[1] == -7 && vector[2] == -7);
    } else {
        CLAIM(all_finite(vector, 3));
        status = surfmink_sphere_exp(x, vector, radius, z);
        CLAIM(status == SURFMINK_OK ? all_finite(z, 3) : status == SURFMINK_NOT_FINITE && radius > 1e300);
        size_x = sqrt(dot(x, x));
        size_y = sqrt(dot(y, y));
        if (!(size_x > 1e-100 && size_x < 1e100 && size_y > 1e-100 && size_y < 1e100)) return;
        if (!(radius > 1e-100 && radius < 1e100)) return;
        CLAIM(fabs(dot(vector, x)) <= 1e-14 * radius * size_x);
        for (k = 0; k < 3; ++k) off += fabs(z[k] / radius - y[k] / size_y);
        CLAIM(off < 1e-14);
    }
    z[0] = -7;
    status = surfmink_sphere_exp(x, y, radius, z);
    CLAIM(is_known(status));
    CLAIM(status == SURFMINK_OK ? all_finite(z, 3) : z[0] == -7);
}

/* The general door and the door for spheres are the same house. */
static void as_callbacks(outline *o)
{
    surfmink_surface sphere = surfmink_sphere_surface(&o->radius);
    surfmink_outline called = surfmink_on_surface(&sphere, o->corner, o->n), direct = view_of(o);
    double mu[RANK + 1], loose;
    measured m;
    size_t i;
    int status, p;
    status = surfmink_measure(&called, RANK, mu, NULL, NULL, &m.bad);
    CLAIM(is_known(status));
    if (!(o->radius > 1e-290 && o->radius < 1e290)) return; /* lengths under- or overflow */
    for (i = 0; i < o->n && surfmink_edges(&direct, m.length, m.turning, NULL) == SURFMINK_OK; ++i)
        if (!(m.length[i] > DBL_MIN)) return; /* so it is for a single one */
    if (!measure_twice(o, &m) || m.status != SURFMINK_OK || has_spike(o, &m) || m.w.condition > 1e5) return;
    CLAIM(status == SURFMINK_OK);
    loose = 1 + m.w.condition + fabs(m.w.curvature) / m.w.turning; /* 1 + c, c as in ACCURACY */
    loose = 1e-12 * loose * loose;
    for (p = 0; p <= RANK && loose < 0.1; ++p) CLAIM(fabs(mu[p] - m.mu[p]) <= loose);
}

/* Right-handed and orthonormal, along the edge. */
static void frames(const outline *o, size_t edge)
{
    surfmink_outline view = view_of(o);
    double frame[9] = {-7, -7, -7, -7, -7, -7, -7, -7, -7};
    int status = surfmink_frame(&view, edge, frame), i, j;
    CLAIM(is_known(status));
    for (i = 0; i < 9 && status != SURFMINK_OK; ++i) CLAIM(frame[i] == -7);
    if (status != SURFMINK_OK) return;
    for (i = 0; i < 3; ++i)
        for (j = 0; j <= i; ++j) CLAIM(fabs(dot(frame + 3 * i, frame + 3 * j) - (i == j)) < 1e-14);
}

static void fuzz(bytes in)
{
    outline o;
    surfmink_outline view;
    double area = -7;
    int status;
    take_outline(&in, SURFMINK_SPHERE, &o);
    view = view_of(&o);
    claim_invariants(&o);
    status = surfmink_area(&view, &area);
    CLAIM(is_known(status));
    CLAIM(status == SURFMINK_OK ? isfinite(area) : area == -7);
    log_and_exp(&o, o.radius);
    as_callbacks(&o);
    frames(&o, take(&in));
}
