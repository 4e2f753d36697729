/* embedded.c - fuzzes what measures polygons on a surface in space: measure, edges, area, frame, transport of a
   vector. */
#include "outline.h"

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void frames(const outline *o, size_t edge)
{
    surfmink_outline view = view_of(o);
    double frame[9] = {-7, -7, -7, -7, -7, -7, -7, -7, -7};
    int status = surfmink_frame(&view, edge, frame), i, j;
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) {
        for (i = 0; i < 9; ++i) CLAIM(frame[i] == -7);
        return;
    }
    for (i = 0; i < 3; ++i)
        for (j = 0; j <= i; ++j) CLAIM(fabs(dot(frame + 3 * i, frame + 3 * j) - (i == j)) < 1e-9);
}

/* A vector that goes round once comes back under the corrected transport, whatever the outline. No vector grows. */
static void transport(const outline *o, const double *turning, bytes *in)
{
    surfmink_outline view = view_of(o);
    double frame[9], vector[3], there[3], round[3], s = 0, turned = 0;
    size_t from = take(in) % (o->n + 1), i;
    ptrdiff_t steps = (ptrdiff_t)take(in) - 128;
    int how = (int)(take(in) % 4), status, k;
    for (k = 0; k < 3; ++k) vector[k] = take_number(in);
    memcpy(there, vector, sizeof there);
    status = surfmink_transport_vector(&view, turning, from, steps, how, there);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) {
        CLAIM(same_bits(there, vector, sizeof there));
        return;
    }
    CLAIM(from < o->n && how < 3);
    if (!is_tame(vector, 3)) return;
    CLAIM(sqrt(dot(there, there)) <= sqrt(dot(vector, vector)) * (1 + 1e-9) + 1e-300);
    for (i = 0; i < o->n; ++i) {
        s += turning[i];
        turned += fabs(turning[i]);
    }
    if (how != SURFMINK_CORRECTED || !(turned < 1e3 * s)) return;
    CLAIM(surfmink_frame(&view, from, frame) == SURFMINK_OK);
    memcpy(round, frame, sizeof round);
    status = surfmink_transport_vector(&view, turning, from, (ptrdiff_t)o->n, how, round);
    CLAIM(status == SURFMINK_OK);
    for (k = 0; k < 3; ++k) CLAIM(fabs(round[k] - frame[k]) < 1e-9);
}

/* An area is finite where it is told, and told of all that is measured. */
static void areas(const outline *o, const measured *m)
{
    surfmink_outline view = view_of(o);
    double area = -7;
    int status = surfmink_area(&view, &area);
    CLAIM(is_known(status));
    CLAIM(status == SURFMINK_OK ? isfinite(area) : area == -7);
    if (m->status == SURFMINK_OK) CLAIM(status == SURFMINK_OK && same_bits(&area, &m->w.area, sizeof area));
}

static void fuzz(bytes in)
{
    outline o;
    measured m;
    take_outline(&in, SURFMINK_EMBEDDED, &o);
    claim_invariants(&o);
    frames(&o, take(&in));
    if (!measure_twice(&o, &m)) return;
    areas(&o, &m);
    transport(&o, m.turning, &in);
}
