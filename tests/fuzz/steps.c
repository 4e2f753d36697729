/* steps.c - fuzzes what knows no surface: totals, phases, transport of angles, components, tensors, spectrum,
   eigenvectors. Lengths and turns are anything. */
#include "api.h"

static double length[CORNERS], turning[CORNERS], g[2 * RANK + 2];
static size_t n;
static double turned; /* sum |turning| */

static void totals(void)
{
    surfmink_functionals w = {-7, -7, -7, -7, -7};
    int status = surfmink_total(NULL, length, turning, n, &w);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK)
        CLAIM(w.area == -7 && w.length == -7 && w.turning == -7 && w.condition == -7);
    else
        CLAIM(w.area == 0 && w.length > 0 && w.turning > 0 && w.condition >= 1 - 1e-15 && isfinite(w.length));
}

static void phases_and_transport(bytes *in)
{
    double phase[CORNERS], aliased[CORNERS], carried = -7, angle = take_number(in);
    size_t from = take(in) % (CORNERS + 2);
    int how = (int)(take(in) % 5) - 1, status, k;
    memset(phase, 0x5a, sizeof phase);
    memcpy(aliased, turning, sizeof aliased);
    status = surfmink_phases(turning, n, how, phase);
    CLAIM(is_known(status));
    CLAIM(surfmink_phases(aliased, n, how, aliased) == status);
    if (status == SURFMINK_OK)
        CLAIM(same_bits(aliased, phase, n * sizeof *phase) && phase[0] == 0);
    else
        CLAIM(same_bits(aliased, turning, sizeof turning));
    if (status != SURFMINK_OK) CLAIM(is_untouched(phase, sizeof phase));
    k = surfmink_transport_angle(turning, n, from, (ptrdiff_t)take(in) - 128, how, angle, &carried);
    CLAIM(is_known(k));
    if (k != SURFMINK_OK)
        CLAIM(carried == -7);
    else
        CLAIM(status == SURFMINK_OK && from < n && isfinite(angle));
    if (k != SURFMINK_OK || how != SURFMINK_CORRECTED || !(turned < 1e4) || fabs(angle) > 100) return;
    CLAIM(surfmink_transport_angle(turning, n, from, (ptrdiff_t)n, how, 0, &carried) == SURFMINK_OK);
    CLAIM(fabs(carried + 6.283185307179586) < 1e-14);
}

/* By how much errors of single angles may be amplified, as in ACCURACY; 0 if the outline is refused. */
static double amplification(void)
{
    surfmink_functionals w;
    if (surfmink_total(NULL, length, turning, n, &w) != SURFMINK_OK || !(w.length < 1e300 && w.length > 1e-290))
        return 0;
    return w.condition + fabs(w.curvature) / w.turning;
}

static int measure_steps(const double *l, const double *alpha, double *components, double *mu)
{
    double phase[CORNERS];
    return surfmink_phases(alpha, n, SURFMINK_CORRECTED, phase) ||
           surfmink_irreducible(l, phase, n, RANK, components) || surfmink_spectrum(components, RANK, NULL, mu, NULL);
}

/* The same outline from another corner on, and in another unit. */
static void invariants(bytes *in)
{
    double l[CORNERS], alpha[CORNERS], mu[RANK + 1], other[RANK + 1], again[2 * RANK + 2], least = HUGE_VAL;
    double c = amplification(), loose = 1e-13 * (1 + c) * (1 + c);
    size_t by = take(in), i;
    surfmink_functionals w, v;
    int p;
    if (c == 0 || !(loose < 0.1)) return;
    for (i = 0; i < n; ++i) {
        l[i] = length[(i + by) % n];
        alpha[i] = turning[(i + by) % n];
        if (length[i] > 0 && !(length[i] >= least)) least = length[i];
    }
    CLAIM(measure_steps(length, turning, g, mu) == SURFMINK_OK && measure_steps(l, alpha, again, other) == SURFMINK_OK);
    for (p = 0; p <= RANK; ++p) {
        CLAIM(mu[p] >= 0 && mu[p] <= 1 + 4 * DBL_EPSILON);
        CLAIM(fabs(mu[p] - other[p]) <= loose);
    }
    CLAIM(surfmink_total(NULL, length, turning, n, &w) == SURFMINK_OK &&
          surfmink_total(NULL, l, alpha, n, &v) == SURFMINK_OK);
    CLAIM(fabs(w.length - v.length) <= 1e-15 * w.length && fabs(w.turning - v.turning) <= 1e-15 * c * w.turning);
    if (!(least > 1e-100 && w.length < 1e100)) return;
    for (i = 0; i < n; ++i) l[i] = 0x1p70 * length[i];
    CLAIM(measure_steps(l, turning, again, other) == SURFMINK_OK && same_bits(mu, other, sizeof mu));
    for (i = 0; i < 2 * RANK + 2; ++i) /* but for denormals, on the way or in the end */
        CLAIM(again[i] == 0x1p70 * g[i] || fabs(again[i]) < 1e-270 * again[0] || fabs(g[i]) < 1e-280);
}

/* In reverse S is -S: an outline that can be measured is clockwise then. */
static void reversed(void)
{
    double l[CORNERS], alpha[CORNERS];
    surfmink_functionals w;
    size_t i;
    if (amplification() == 0) return;
    for (i = 0; i < n; ++i) {
        l[i] = length[n - 1 - i];
        alpha[i] = -turning[n - 1 - i];
    }
    CLAIM(surfmink_total(NULL, l, alpha, n, &w) == SURFMINK_CLOCKWISE);
}

static void components(bytes *in)
{
    double phase[CORNERS], again[2 * RANK + 2], fraction = take_number(in), sum = 0;
    size_t edge = take(in) % (CORNERS + 2), i;
    int rank = (int)(take(in) % (RANK + 2)) - 1, status, p;
    memset(g, 0x5a, sizeof g);
    memset(again, 0x5a, sizeof again);
    status = surfmink_irreducible(length, turning, n, rank, g);
    CLAIM(is_known(status));
    for (i = 0; i < n; ++i) sum += length[i];
    if (status != SURFMINK_OK) CLAIM(is_untouched(g, sizeof g));
    for (p = 0; p <= rank && status == SURFMINK_OK && sum < 1e300; ++p)
        CLAIM(hypot(g[2 * p], g[2 * p + 1]) <= sum * (1 + 1e-13) + 1e-300);
    status = surfmink_irreducible_parallel(length, turning, n, edge, fraction, rank, again);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) CLAIM(is_untouched(again, sizeof again));
    if (status != SURFMINK_OK || !(sum < 1e300 && turned < 1e4)) return;
    CLAIM(edge < n && rank >= 0);
    for (p = 0; p <= rank; ++p) CLAIM(hypot(again[2 * p], again[2 * p + 1]) <= sum * (1 + 1e-13) + 1e-300);
    if (edge > 0 || fraction > 0) return;
    CLAIM(surfmink_phases(turning, n, SURFMINK_PARALLEL, phase) == SURFMINK_OK);
    CLAIM(surfmink_irreducible(length, phase, n, rank, g) == SURFMINK_OK);
    for (i = 0; i < 2 * (size_t)rank + 2; ++i) CLAIM(fabs(g[i] - again[i]) <= 1e-13 * sum * (1 + turned) + 1e-300);
}

static void tensors(bytes *in)
{
    double tensor[RANK + 1], vector[2], contracted[2] = {-7, -7}, trace;
    int p = (int)(take(in) % (RANK + 2)) - 1, status, j;
    vector[0] = take_number(in);
    vector[1] = take_number(in);
    memset(tensor, 0x5a, sizeof tensor);
    status = surfmink_tensor(g, p, tensor);
    CLAIM(status == (p < 0 ? SURFMINK_BAD_ARGUMENT : SURFMINK_OK));
    if (p < 0) CLAIM(is_untouched(tensor, sizeof tensor));
    status = surfmink_trace_free(g, p, tensor);
    CLAIM(status == (p < 0 ? SURFMINK_BAD_ARGUMENT : SURFMINK_OK));
    if (p < 0) CLAIM(is_untouched(tensor, sizeof tensor));
    for (j = 0; j + 2 <= p && fabs(g[2 * p]) < 1e300 && fabs(g[2 * p + 1]) < 1e300; ++j) {
        trace = tensor[j] + tensor[j + 2]; /* contracting two indices: nu nu + tau tau */
        CLAIM(trace == 0);
    }
    if (p < 0) return;
    status = surfmink_contract(tensor, p, vector, contracted);
    CLAIM(status == (p < 1 ? SURFMINK_BAD_ARGUMENT : SURFMINK_OK));
    if (p < 1) CLAIM(contracted[0] == -7 && contracted[1] == -7);
}

static void spectra(bytes *in)
{
    double lambda[RANK + 1], mu[RANK + 1], theta[RANK + 1], angles[RANK], vector[3 * RANK], frame[6], phase;
    int p, rank = (int)(take(in) % (RANK + 2)) - 1, dim = (int)(take(in) % 5), sign = (int)take(in) - 128, status, k;
    for (p = 0; p <= RANK; ++p) {
        g[2 * p] = take_number(in);
        g[2 * p + 1] = take_number(in);
    }
    memset(lambda, 0x5a, sizeof lambda);
    memset(mu, 0x5a, sizeof mu);
    memset(theta, 0x5a, sizeof theta);
    status = surfmink_spectrum(g, rank, lambda, mu, theta);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK)
        CLAIM(is_untouched(lambda, sizeof mu) && is_untouched(mu, sizeof mu) && is_untouched(theta, sizeof mu));
    for (p = 1; p <= rank && status == SURFMINK_OK; ++p)
        CLAIM(lambda[p] >= 0 && mu[p] >= 0 && fabs(theta[p]) <= 3.1415926535897936 / p &&
              theta[p] > -3.1415926535897936 / p);
    for (k = 0; k < 6; ++k) frame[k] = take_number(in);
    phase = take_number(in);
    for (p = -1; p <= RANK; ++p) {
        memset(angles, 0x5a, sizeof angles);
        memset(vector, 0x5a, sizeof vector);
        status = surfmink_angles(g, p, sign, angles);
        CLAIM(is_known(status) && (p > 0 || status == SURFMINK_BAD_ARGUMENT));
        if (status != SURFMINK_OK) CLAIM(is_untouched(angles, sizeof angles));
        for (k = 1; k < p && status == SURFMINK_OK; ++k)
            CLAIM(fabs(angles[k] - angles[0] - k * 6.283185307179586 / p) < 1e-14);
        status = surfmink_eigenvectors(g, p, sign, phase, frame, dim, vector);
        CLAIM(is_known(status) && ((p > 0 && (dim == 2 || dim == 3)) || status == SURFMINK_BAD_ARGUMENT));
        if (status != SURFMINK_OK) CLAIM(is_untouched(vector, sizeof vector));
    }
}

static void fuzz(bytes in)
{
    size_t i;
    n = take(&in) % (CORNERS + 1);
    turned = 0;
    for (i = 0; i < n; ++i) {
        length[i] = take_number(&in);
        turning[i] = take_number(&in);
        turned += fabs(turning[i]);
    }
    for (; i < CORNERS; ++i) length[i] = turning[i] = 0;
    totals();
    phases_and_transport(&in);
    components(&in);
    invariants(&in);
    reversed();
    tensors(&in);
    spectra(&in);
}
