/* beyond.c - gradients, their noise, curves and directors of outlines that are wrong leave their outputs alone.
   cc -I. tests/check/beyond.c -lm && ./a.out

   Outlines by chance, most with a fault: too few corners, a NaN, a repeated corner, no normal or one turned round, the
   wrong way round, a great circle, a rank or a radius that is none. Where a call fails every output keeps its bits;
   where it succeeds it writes. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "../../examples/beyond/curve.h"
#include "../../examples/beyond/director.h"
#include "../../examples/beyond/gradient.h"
#include "../shapes.h"

#include <stdio.h>

enum { N = 12, P = 4, CALLS = 4, OUTPUTS = 200, FAULTS = 10, OUTLINES = 4000 };

static const double untouched = -1234.5;
static const char *const call_name[CALLS] = {"gradient", "noise", "curve", "director"};

static double output[OUTPUTS], scratch[SURFMINK_CURVE_SCRATCH(N, P) + 400];

static surfmink_outline some_outline(chance *c, int fault, double *corner, double *normal, int *max_rank)
{
    const int where = (int)one_of(c, 3);
    surfmink_outline o;
    wobble w = some_wobble(c, where);
    size_t i, at = 1 + one_of(c, N - 2), dim = where == IN_THE_PLANE ? 2 : 3;
    *max_rank = P;
    wobble_points(&w, N, corner, normal);
    if (fault == 1) corner[at] = nan("");
    if (fault == 2) memcpy(corner + dim * at, corner + dim * (at - 1), dim * sizeof *corner);
    if (fault == 3) surfmink_reverse(corner, N, dim);
    if (fault == 3) surfmink_reverse(normal, N, 3);
    if (fault == 4) *max_rank = -1;
    for (i = 0; i < 3 && fault == 5; ++i) normal[3 * at + i] = 0;
    for (i = 0; i < 3 && fault == 6; ++i) normal[3 * at + i] *= -1;
    for (i = 0; i < N && fault == 7 && dim == 3; ++i) corner[3 * i + 2] = 0;
    for (i = 0; i < N && fault == 8; ++i) corner[dim * i] = 1;
    o = where == IN_THE_PLANE  ? surfmink_plane(corner, N)
        : where == ON_A_SPHERE ? surfmink_sphere(corner, N, fault == 9 ? -1 : 1)
                               : surfmink_embedded(corner, normal, N);
    if (fault == 0) o.n = 2;
    return o;
}

/* One of the calls; `first` is an output that it writes if it succeeds. */
static int call(int which, const surfmink_outline *o, int max_rank, double **first)
{
    static const double by_mu[P + 1] = {0, 1, 1, 1, 1};
    static double length[N], phase[N], g[2 * P + 2], lag[N];
    surfmink_weights weights = {by_mu, NULL, NULL, NULL, 0};
    surfmink_gradients gradients = {NULL, NULL, output, output + 10, NULL, output + 30, output + 80};
    surfmink_uncertainty noise = {output, output + 10, output + 20, NULL};
    surfmink_curve_options options = {4, NULL, 0, NULL};
    surfmink_curve_results curve = {output, output + 10, output + 20, NULL};
    surfmink_middle middle = {{0}, {0}, {0}, output, output + 40};
    int status;
    *first = output + 1;
    if (which == 0) return surfmink_gradient(o, max_rank, &weights, &gradients, scratch);
    if (which == 1) return surfmink_noise(o, max_rank, 0.01, &noise, scratch);
    if (which == 2) return surfmink_curve(o, &options, max_rank, scratch, &curve, NULL);
    *first = output + 4;
    status = surfmink_edges(o, length, phase, NULL);
    if (status == SURFMINK_OK) status = surfmink_phases(phase, o->n, SURFMINK_CORRECTED, phase);
    if (status == SURFMINK_OK) status = surfmink_irreducible(length, phase, o->n, max_rank < 0 ? P : max_rank, g);
    if (status == SURFMINK_OK) status = surfmink_director(o, length, phase, g, max_rank, lag, &middle);
    return status;
}

int main(void)
{
    static double corner[3 * N], normal[3 * N];
    chance c = {7};
    surfmink_outline o;
    int i, k, which, max_rank, touched, status, wrong = 0, refused[CALLS] = {0}, measured[CALLS] = {0};
    double *first;
    for (i = 0; i < OUTLINES; ++i) {
        o = some_outline(&c, i % (FAULTS + 2), corner, normal, &max_rank);
        for (which = 0; which < CALLS; ++which) {
            for (k = 0; k < OUTPUTS; ++k) output[k] = untouched;
            status = call(which, &o, max_rank, &first);
            for (touched = k = 0; k < OUTPUTS; ++k) touched += memcmp(output + k, &untouched, sizeof untouched) != 0;
            ++(status == SURFMINK_OK ? measured : refused)[which];
            if (status == SURFMINK_OK ? memcmp(first, &untouched, sizeof untouched) != 0 : touched == 0) continue;
            printf("%s of outline %d: %s, %d outputs written\n", call_name[which], i,
                   surfmink_curve_status_name(status), touched);
            ++wrong;
        }
    }
    for (which = 0; which < CALLS; ++which) {
        printf("%s: %d measured, %d refused\n", call_name[which], measured[which], refused[which]);
        if (measured[which] < OUTLINES / 10 || refused[which] < OUTLINES / 4) ++wrong;
    }
    return wrong != 0;
}
