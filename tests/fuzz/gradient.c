/* gradient.c - fuzzes gradients: the easy doors, the steps and batches, against measuring and against each other. */
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

static int gradient(const outline *o, const energy *e, pulled *out)
{
    double scratch[6 * CORNERS];
    memset(out, 0x5a, sizeof *out);
    if (o->kind == PLANE)
        return surfmink_gradient_plane(o->corner, o->n, RANK, &e->weights, out->mu, out->g, &out->w, out->by_corner,
                                       scratch, &out->bad);
    if (o->kind == SPHERE)
        return surfmink_gradient_sphere(o->corner, o->n, o->radius, RANK, &e->weights, out->mu, out->g, &out->w,
                                        out->by_corner, scratch, &out->bad);
    return surfmink_gradient_embedded(o->corner, o->normal, o->n, RANK, &e->weights, out->mu, out->g, &out->w,
                                      out->by_corner, out->by_normal, scratch, &out->bad);
}

static int pull(const outline *o, const double *by_length, const double *by_turning, pulled *out)
{
    if (o->kind == PLANE) return surfmink_pull_plane(o->corner, o->n, by_length, by_turning, out->by_corner, &out->bad);
    if (o->kind == SPHERE)
        return surfmink_pull_sphere(o->corner, o->n, o->radius, by_length, by_turning, out->by_corner, &out->bad);
    return surfmink_pull_embedded(o->corner, o->normal, o->n, by_length, by_turning, out->by_corner, out->by_normal,
                                  &out->bad);
}

/* Three copies in one batch; the middle one is refused. */
static void batch(const outline *o, const energy *e, pulled *out, int status[3], size_t offset[4])
{
    double corner[9 * CORNERS], normal[9 * CORNERS], by_corner[9 * CORNERS], by_normal[9 * CORNERS];
    double scratch[18 * CORNERS];
    size_t dim = dim_of(o), i, size = dim * o->n * sizeof *corner;
    surfmink_weights shared = e->weights;
    surfmink_results results;
    memset(&results, 0, sizeof results);
    results.status = status;
    shared.shared = 1;
    offset[0] = 0;
    for (i = 0; i < 3; ++i) {
        memcpy(corner + dim * offset[i], o->corner, i == 1 ? 0 : size);
        memcpy(normal + 3 * offset[i], o->normal, i == 1 ? 0 : 3 * o->n * sizeof *normal);
        offset[i + 1] = offset[i] + (i == 1 ? 0 : o->n);
    }
    memset(by_corner, 0x5a, sizeof by_corner);
    memset(by_normal, 0x5a, sizeof by_normal);
    if (o->kind == PLANE)
        surfmink_batch_gradient_plane(corner, offset, 3, RANK, &shared, &results, by_corner, scratch);
    else if (o->kind == SPHERE)
        surfmink_batch_gradient_sphere(corner, offset, 3, o->radius, RANK, &shared, &results, by_corner, scratch);
    else
        surfmink_batch_gradient_embedded(corner, normal, offset, 3, RANK, &shared, &results, by_corner, by_normal,
                                         scratch);
    CLAIM(status[1] == SURFMINK_TOO_FEW_CORNERS || status[0] == SURFMINK_BAD_ARGUMENT);
    CLAIM(same_bits(by_corner, by_corner + dim * o->n, size));
    CLAIM(is_untouched(by_corner + 2 * dim * o->n, sizeof by_corner - 2 * size));
    memset(out, 0x5a, sizeof *out);
    memcpy(out->by_corner, by_corner, size);
    if (o->kind == EMBEDDED) memcpy(out->by_normal, by_normal, size);
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
        if (m->mu[p] < 1e-3 && !(o->kind == PLANE && p == 1)) return 0;
    return least > 1e-4 * most && most > 1e-3 && most < 1e3 && (o->kind != SPHERE || m->w.length < 5 * o->radius);
}

static void fuzz(bytes in)
{
    static const enum kind kind_of[3] = {PLANE, SPHERE, EMBEDDED};
    outline o;
    energy e;
    measured m;
    pulled got, steps, many, untouched;
    double by_g[2 * RANK + 2], by_length[CORNERS], by_turning[CORNERS], size, radius;
    size_t offset[4], numbers;
    int status, statuses[3];
    take_outline(&in, kind_of[take(&in) % 3], &o);
    take_energy(&in, &e);
    numbers = dim_of(&o) * o.n;
    status = gradient(&o, &e, &got);
    memset(&untouched, 0x5a, sizeof untouched);
    CLAIM(is_known(status));
    CLAIM(measure_twice(&o, &m) || m.status != SURFMINK_OK);
    CLAIM(status == m.status);
    batch(&o, &e, &many, statuses, offset);
    CLAIM(statuses[0] == statuses[2]);
    if (status != SURFMINK_OK) {
        CLAIM(got.bad <= o.n);
        got.bad = untouched.bad;
        CLAIM(same_bits(&got, &untouched, sizeof got));
        return;
    }
    CLAIM(same_bits(got.mu, m.mu, sizeof m.mu) && same_bits(got.g, m.g, sizeof m.g));
    CLAIM(is_untouched(got.by_corner + numbers, (3 * CORNERS - numbers) * sizeof *got.by_corner));
    CLAIM(o.kind == EMBEDDED || is_untouched(got.by_normal, sizeof got.by_normal));
    CLAIM(surfmink_pull_spectrum(&e.weights, m.g, RANK, by_g) == SURFMINK_OK);
    CLAIM(surfmink_pull_edges(by_g, RANK, m.length, m.turning, o.n, by_length, by_turning) == SURFMINK_OK ||
          m.w.condition > 1e6 || has_spike(&o, &m));
    if (!is_plain(&o, &m)) return;
    CLAIM(all_finite(got.by_corner, numbers) && (o.kind != EMBEDDED || all_finite(got.by_normal, 3 * o.n)));
    CLAIM(pull(&o, by_length, by_turning, &steps) == SURFMINK_OK);
    size = norm(got.by_corner, numbers) + norm(by_length, o.n);
    radius = norm(o.corner, numbers);
    if (o.kind == SPHERE) size += (norm(by_turning, o.n) + o.radius * norm(by_length, o.n)) / radius;
    CLAIM(distance(got.by_corner, steps.by_corner, numbers) <= 1e-7 * size);
    CLAIM(statuses[0] == SURFMINK_OK && distance(got.by_corner, many.by_corner, numbers) <= 1e-7 * size);
}
