/* surface.c - fuzzes what asks callbacks: measure, edges, regular polygon, points of an edge. The callbacks answer with
   what the bytes say: nonsense, failures, and now and then something sensible. */
#include "api.h"

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

static void fuzz(bytes in)
{
    double corner[2 * CORNERS] = {0}, scratch[2 * CORNERS], point[2 * CORNERS], untouched[2 * CORNERS];
    surfmink_surface surface;
    measured m, blank;
    size_t n = take(&in) % (CORNERS + 1), i;
    unsigned which = take(&in);
    int status;
    surface.context = &in;
    surface.stride = which & 1 ? 2 : take(&in) % 20;
    if (surface.stride > 0 && surface.stride <= 16) surface.stride = 2; /* what the callbacks write */
    surface.log = which & 6 ? some_log : NULL;
    surface.exp = which & 24 ? some_exp : NULL;
    memset(&m, 0x5a, sizeof m);
    memset(&blank, 0x5a, sizeof blank);
    memset(untouched, 0x5a, sizeof untouched);
    memset(point, 0x5a, sizeof point);
    if (which & 64) {
        m.status = blank.status;
        status = surfmink_measure_surface(&surface, corner, n, scratch, RANK, m.mu, m.g, &m.w, &m.bad);
    } else {
        status = surfmink_edges_surface(&surface, corner, n, scratch, m.length, m.turning, &m.bad);
    }
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) {
        CLAIM(m.bad <= n);
        m.bad = blank.bad;
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
