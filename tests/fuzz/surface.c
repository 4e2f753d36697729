/* surface.c - fuzzes what asks callbacks: measure, edges, regular polygon, points of an edge. The callbacks answer with
   what the bytes say: nonsense, failures, and now and then something sensible; or they are those of the plane. */
#include "outline.h"

static int answer(bytes *in, double *length, double direction[2])
{
    unsigned status = take(in);
    *length = take_number(in);
    direction[0] = take_number(in);
    direction[1] = take_number(in);
    return status < 240 ? SURFMINK_OK : (int)status - 242;
}

static int some_log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    (void)x;
    (void)y;
    return answer((bytes *)context, length, direction);
}

static int some_exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    double two[2];
    int status = answer((bytes *)context, y, two);
    (void)x;
    (void)length;
    CLAIM(isfinite(direction[0]) && isfinite(direction[1]));
    y[1] = two[0];
    return status;
}

/* --- the plane by callbacks --------------------------------------------------------------------------------------- */

/* Its frames point anywhere, its directions have any length, and it ends where x is `end`. */
static void turn_by(double angle, const double v[2], double out[2])
{
    double x = v[0] * cos(angle) - v[1] * sin(angle);
    out[1] = v[0] * sin(angle) + v[1] * cos(angle);
    out[0] = x;
}

static double frame_at(const double x[2])
{
    return remainder(7 * x[0] + 3 * x[1], 6);
}

static int plane_log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    double d[2];
    (void)context;
    d[0] = y[0] - x[0];
    d[1] = y[1] - x[1];
    *length = hypot(d[0], d[1]);
    if (*length == 0) return SURFMINK_COINCIDENT_CORNERS;
    turn_by(-frame_at(x), d, direction);
    return SURFMINK_OK;
}

static int plane_exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    double d[2];
    CLAIM(fabs(hypot(direction[0], direction[1]) - 1) < 1e-15);
    turn_by(frame_at(x), direction, d);
    d[0] = x[0] + length * d[0];
    d[1] = x[1] + length * d[1];
    y[1] = d[1];
    y[0] = d[0];
    return y[0] < *(double *)context ? SURFMINK_OK : SURFMINK_CALLBACK_FAILED;
}

static void measure_plane_surface(const surfmink_surface *plane, const outline *o, measured *m)
{
    surfmink_outline view = surfmink_on_surface(plane, o->corner, o->n);
    memset(m, 0x5a, sizeof *m);
    m->status = surfmink_measure(&view, RANK, m->mu, m->g, &m->w, &m->bad);
    CLAIM(is_known(m->status));
    if (m->status != SURFMINK_OK) CLAIM(is_untouched(m->mu, sizeof m->mu) && is_untouched(&m->w, sizeof m->w));
}

/* By callbacks the plane is what it is without them, wherever an outline begins and whichever way it runs. */
static void as_plane(const surfmink_surface *plane, const outline *o, size_t by)
{
    outline other = *o;
    measured direct, m, b;
    double loose;
    int p;
    if (!is_tame(o->corner, 2 * o->n) || !measure_twice(o, &direct)) return;
    measure_plane_surface(plane, o, &m);
    if (direct.status != SURFMINK_OK || has_spike(o, &direct) || direct.w.condition > 1e5) return;
    CLAIM(m.status == SURFMINK_OK && fabs(m.w.length - direct.w.length) <= 4e-15 * direct.w.length);
    CLAIM(fabs(m.w.turning - direct.w.turning) <= 1e-14 * (1 + direct.w.condition) * direct.w.turning);
    loose = 1e-12 * (1 + direct.w.condition) * (1 + direct.w.condition);
    for (p = 0; p <= RANK && loose < 0.1; ++p) CLAIM(fabs(m.mu[p] - direct.mu[p]) <= loose);
    relabel(&other, by);
    measure_plane_surface(plane, &other, &b);
    claim_alike(&m, &b);
    backwards(&other);
    measure_plane_surface(plane, &other, &b);
    CLAIM(b.status == SURFMINK_CLOCKWISE);
}

/* What is built lies where it should, and nothing is written of what reaches the end of the plane. */
static void build_on_plane(const surfmink_surface *plane, const outline *o, bytes *in)
{
    double point[2 * CORNERS], distance = take_number(in), angle = take_number(in), mu[CORNERS + 1], size, off;
    size_t n = take(in) % (CORNERS + 1), i;
    const double *x = o->corner, *y = o->corner + 2;
    surfmink_outline built;
    int status;
    memset(point, 0x5a, sizeof point);
    status = surfmink_regular_polygon(plane, x, distance, angle, n, point);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) CLAIM(is_untouched(point, sizeof point));
    size = fabs(x[0]) + fabs(x[1]);
    if (status == SURFMINK_OK && is_tame(&distance, 1) && distance > 1e-3 * size && fabs(angle) < 1e3) {
        built = surfmink_plane(point, n);
        CLAIM(surfmink_measure(&built, (int)n, mu, NULL, NULL, NULL) == SURFMINK_OK);
        CLAIM(fabs(mu[n] - 1) < 1e-9);
    }
    memset(point, 0x5a, sizeof point);
    status = surfmink_edge_points(plane, x, y, n, point);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) CLAIM(is_untouched(point, sizeof point));
    if (status != SURFMINK_OK || !is_tame(o->corner, 4)) return;
    size += fabs(y[0]) + fabs(y[1]);
    for (i = 0; i < n; ++i) {
        off = fabs(point[2 * i] - x[0] - (y[0] - x[0]) * (double)i / (double)n);
        off += fabs(point[2 * i + 1] - x[1] - (y[1] - x[1]) * (double)i / (double)n);
        CLAIM(off <= 1e-14 * size);
    }
}

static void on_plane(bytes *in)
{
    double end = take_number(in);
    surfmink_surface plane;
    outline o;
    plane.context = &end;
    plane.stride = 2;
    plane.log = plane_log;
    plane.exp = plane_exp;
    take_outline(in, SURFMINK_PLANE, &o);
    as_plane(&plane, &o, take(in));
    build_on_plane(&plane, &o, in);
}

/* --- anything by callbacks ---------------------------------------------------------------------------------------- */

static void fuzz(bytes in)
{
    double corner[2 * CORNERS] = {0}, point[2 * CORNERS], untouched[2 * CORNERS];
    surfmink_surface surface;
    surfmink_outline view = surfmink_on_surface(&surface, corner, 0);
    measured m, blank;
    size_t n = take(&in) % (CORNERS + 1), i;
    unsigned which = take(&in);
    int status;
    if (which & 128) {
        on_plane(&in);
        return;
    }
    surface.context = &in;
    surface.stride = which & 1 ? 2 : take(&in) % 20;
    if (surface.stride > 0 && surface.stride <= 16) surface.stride = 2; /* what the callbacks write */
    surface.log = which & 6 ? some_log : NULL;
    surface.exp = which & 24 ? some_exp : NULL;
    view.n = n;
    memset(&m, 0x5a, sizeof m);
    memset(&blank, 0x5a, sizeof blank);
    memset(untouched, 0x5a, sizeof untouched);
    memset(point, 0x5a, sizeof point);
    if (which & 64) {
        m.status = blank.status;
        status = surfmink_measure(&view, RANK, m.mu, m.g, &m.w, &m.bad);
    } else {
        status = surfmink_edges(&view, m.length, m.turning, &m.bad);
    }
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) {
        CLAIM(m.bad <= n);
        m.bad = blank.bad;
        if (!(which & 64)) { /* a callback that failed half-way: part of the edges may stand there */
            memcpy(m.length, blank.length, sizeof m.length);
            memcpy(m.turning, blank.turning, sizeof m.turning);
        }
        CLAIM(same_bits(&m, &blank, sizeof m));
    } else if (which & 64) {
        for (i = 0; i <= RANK; ++i) CLAIM(m.mu[i] >= 0 && m.mu[i] <= 1 + 4 * DBL_EPSILON);
    } else {
        for (i = 0; i < n; ++i) CLAIM(m.length[i] > 0 && fabs(m.turning[i]) <= 3.1415926535897936);
    }
    status = which & 32 ? surfmink_regular_polygon(&surface, corner, take_number(&in), take_number(&in), n, point)
                        : surfmink_edge_points(&surface, corner, corner + 2, n, point);
    CLAIM(is_known(status));
    if (status == SURFMINK_OK) CLAIM(all_finite(point, 2 * n));
    /* A callback that answers otherwise when it is asked again may fail in the second pass, when point is written. */
    if (!surface.exp) CLAIM(status != SURFMINK_OK && same_bits(point, untouched, sizeof point));
}
