/* gradient.c - fuzzes examples/beyond/gradient.h: single calls, steps and batches, against measuring and against each
   other; and the noise of mu_p. */
#include "examples/beyond/gradient.h"

#include "outline.h"

/* What a gradient is made of, and what comes out. */
typedef struct pulled {
    double mu[RANK + 1], g[2 * RANK + 2], by_corner[3 * CORNERS], by_normal[3 * CORNERS];
    surfmink_functionals w;
    size_t bad;
} pulled;

typedef struct energy {
    double mu[RANK + 1], g[2 * RANK + 2], theta[RANK + 1], length;
    surfmink_weights weights;
} energy;

static void take_energy(bytes *in, energy *e)
{
    unsigned which = take(in);
    int p;
    for (p = 0; p <= RANK; ++p) {
        e->mu[p] = (double)take(in) / 128 - 1;
        e->theta[p] = (double)take(in) / 128 - 1;
        e->g[2 * p] = (double)take(in) / 128 - 1;
        e->g[2 * p + 1] = (double)take(in) / 128 - 1;
    }
    e->length = (double)take(in) / 128 - 1;
    e->weights.mu = which & 1 ? NULL : e->mu;
    e->weights.g = which & 2 ? NULL : e->g;
    e->weights.theta = which & 4 ? NULL : e->theta;
    e->weights.length = which & 8 ? NULL : &e->length;
    e->weights.shared = 0;
}

static int gradient(const outline *o, const energy *e, pulled *to)
{
    double scratch[4 * CORNERS + 2 * RANK + 2];
    surfmink_outline view = view_of(o);
    surfmink_gradients out;
    memset(to, 0x5a, sizeof *to);
    out.status = NULL;
    out.bad = &to->bad;
    out.mu = to->mu;
    out.g = to->g;
    out.w = &to->w;
    out.by_corner = to->by_corner;
    out.by_normal = to->by_normal;
    return surfmink_gradient(&view, RANK, &e->weights, &out, scratch);
}

/* Three copies in one batch; the middle one is refused. */
static void batch(const outline *o, const energy *e, const pulled *single, int status)
{
    double corner[9 * CORNERS], normal[9 * CORNERS], by_corner[9 * CORNERS], by_normal[9 * CORNERS];
    double scratch[12 * CORNERS + 3 * (2 * RANK + 2)];
    size_t dim = dim_of(o), i, size = dim * o->n * sizeof *corner, offset[4] = {0, 0, 0, 0};
    surfmink_weights shared = e->weights;
    surfmink_outline all = view_of(o);
    surfmink_gradients out;
    int statuses[3];
    memset(&out, 0, sizeof out);
    out.status = statuses;
    out.by_corner = by_corner;
    out.by_normal = by_normal;
    shared.shared = 1;
    for (i = 0; i < 3; ++i) {
        memcpy(corner + dim * offset[i], o->corner, i == 1 ? 0 : size);
        memcpy(normal + 3 * offset[i], o->normal, i == 1 ? 0 : 3 * o->n * sizeof *normal);
        offset[i + 1] = offset[i] + (i == 1 ? 0 : o->n);
    }
    all.n = offset[3];
    all.corner = corner;
    if (all.normal) all.normal = normal;
    memset(by_corner, 0x5a, sizeof by_corner);
    memset(by_normal, 0x5a, sizeof by_normal);
    CLAIM(surfmink_batch_gradient(&all, offset, 3, RANK, &shared, &out, scratch) ==
          (size_t)(1 + 2 * (status != SURFMINK_OK)));
    CLAIM(statuses[0] == status && statuses[2] == status);
    CLAIM(statuses[1] == SURFMINK_TOO_FEW_CORNERS || status == SURFMINK_BAD_ARGUMENT);
    for (i = 0; i < 3; i += 2) {
        CLAIM(same_bits(by_corner + dim * offset[i], single->by_corner, size));
        CLAIM(same_bits(by_normal + 3 * offset[i], single->by_normal, 3 * o->n * sizeof *normal));
    }
    CLAIM(is_untouched(by_corner + 2 * dim * o->n, sizeof by_corner - 2 * size));
}

/* How sure mu_p is: no claim of accuracy, but numbers. */
static void noise(const outline *o, const measured *m, int status, bytes *in)
{
    double scratch[18 * CORNERS + 2 * RANK + 2], deviation = take_number(in);
    double mu[RANK + 1], sigma[RANK + 1], bias[RANK + 1];
    surfmink_outline view = view_of(o);
    surfmink_uncertainty out;
    size_t bad = 99;
    int p, got;
    out.mu = mu;
    out.sigma = sigma;
    out.bias = bias;
    out.bad = &bad;
    memset(sigma, 0x5a, sizeof sigma);
    if (take(in) & 1) deviation = 1e-3 * m->w.length;
    got = surfmink_noise(&view, RANK, deviation, &out, scratch);
    if (got != SURFMINK_OK) {
        CLAIM((got == status || got == SURFMINK_BAD_ARGUMENT) && bad <= o->n && is_untouched(sigma, sizeof sigma));
        return;
    }
    CLAIM(status == SURFMINK_OK && deviation >= 0 && sigma[0] == 0 && bias[0] == 0);
    for (p = 1; p <= RANK; ++p) {
        CLAIM(!(sigma[p] < 0));
        if (deviation == 1e-3 * m->w.length && m->w.condition < 100 && is_tame(o->corner, dim_of(o) * o->n))
            CLAIM(isfinite(sigma[p]) && isfinite(bias[p]));
    }
}

static double norm(const double *v, size_t n)
{
    double sum = 0;
    size_t i;
    for (i = 0; i < n; ++i) sum += v[i] * v[i];
    return sqrt(sum);
}

static double distance(const double *a, const double *b, size_t n)
{
    double sum = 0;
    size_t i;
    for (i = 0; i < n; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sqrt(sum);
}

/* Is the outline one whose gradient has digits to compare? No edge of extreme length beside the others, no ill
   condition, no g_p so small that its direction is noise. */
static int is_plain(const outline *o, const measured *m)
{
    double least = HUGE_VAL, most = 0;
    size_t i;
    int p;
    if (m->status != SURFMINK_OK || has_spike(o, m) || m->w.condition > 100) return 0;
    if (!is_tame(o->corner, dim_of(o) * o->n) || !is_tame(o->normal, 3 * o->n)) return 0;
    for (i = 0; i < o->n; ++i) {
        if (m->length[i] < least) least = m->length[i];
        if (m->length[i] > most) most = m->length[i];
    }
    for (p = 1; p <= RANK; ++p)
        if (m->mu[p] < 1e-3 && !(o->kind == SURFMINK_PLANE && p == 1)) return 0;
    return least > 1e-4 * most && most > 1e-3 && most < 1e3 &&
           (o->kind != SURFMINK_SPHERE || m->w.length < 5 * o->radius);
}

static void fuzz(bytes in)
{
    outline o;
    energy e;
    measured m;
    pulled got, steps, untouched;
    double by_g[2 * RANK + 2], by_length[CORNERS], by_turning[CORNERS], scratch[2 * CORNERS], size, radius;
    surfmink_outline view;
    size_t numbers;
    int status;
    take_outline(&in, (enum surfmink_kind)(take(&in) % 3), &o);
    view = view_of(&o);
    take_energy(&in, &e);
    numbers = dim_of(&o) * o.n;
    status = gradient(&o, &e, &got);
    memset(&untouched, 0x5a, sizeof untouched);
    CLAIM(is_known(status));
    CLAIM(measure_twice(&o, &m) || m.status != SURFMINK_OK);
    CLAIM(status == m.status);
    batch(&o, &e, &got, status);
    noise(&o, &m, m.status, &in);
    if (status != SURFMINK_OK) {
        CLAIM(got.bad <= o.n);
        got.bad = untouched.bad;
        CLAIM(same_bits(&got, &untouched, sizeof got));
        return;
    }
    CLAIM(same_bits(got.g, m.g, sizeof m.g) && same_bits(&got.w, &m.w, sizeof m.w));
    if (m.w.length > 1e-290) CLAIM(same_bits(got.mu, m.mu, sizeof m.mu)); /* else g has lost digits */
    CLAIM(is_untouched(got.by_corner + numbers, (3 * CORNERS - numbers) * sizeof *got.by_corner));
    CLAIM(o.kind == SURFMINK_EMBEDDED || is_untouched(got.by_normal, sizeof got.by_normal));
    CLAIM(surfmink_pull_spectrum(&e.weights, m.g, RANK, by_g) == SURFMINK_OK);
    CLAIM(surfmink_pull_edges(by_g, RANK, m.length, m.turning, o.n, by_length, by_turning) == SURFMINK_OK ||
          m.w.condition > 1e6 || has_spike(&o, &m));
    if (!is_plain(&o, &m)) return;
    CLAIM(all_finite(got.by_corner, numbers) && (o.kind != SURFMINK_EMBEDDED || all_finite(got.by_normal, 3 * o.n)));
    CLAIM(surfmink_pull_corners(&view, by_length, by_turning, steps.by_corner, steps.by_normal, scratch, NULL) ==
          SURFMINK_OK);
    size = norm(got.by_corner, numbers) + norm(by_length, o.n);
    radius = norm(o.corner, numbers);
    if (o.kind == SURFMINK_SPHERE) size += (norm(by_turning, o.n) + o.radius * norm(by_length, o.n)) / radius;
    CLAIM(distance(got.by_corner, steps.by_corner, numbers) <= 1e-7 * size);
}
