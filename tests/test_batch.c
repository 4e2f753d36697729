/* Batches: many outlines in one call say what single calls say, wherever they stand and whatever stands beside them.
   cc -I. tests/test_batch.c -lm && ./a.out        (with -fopenmp also: whatever the number of threads)

   A batch may round otherwise than single calls. Both are as good as ACCURACY in surfmink.h says, so they may differ by
   what it grants the two of them: LIMIT below, amplified by the condition c = (sum |alpha| + |2 pi - S|) / S. The worst
   differences are printed, in units of what is allowed. */
#define SURFMINK_DISPATCH /* all instances in one program, where the compiler can */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include <float.h>
#include <limits.h>
#include <stdlib.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "harness.h"
#include "families.h"
#include "instances.h"
#include "table.h"

enum surface { PLANE, SPHERE, EMBEDDED, SURFACES };
static const char *const surface_name[SURFACES] = {"plane", "sphere", "embedded"};

#define STRIDE (1 + FEWER / 20 * 2) /* odd: through what is tried one by one */

/* --- instances ---------------------------------------------------------------------------------------------------- */

static int on_trial; /* the instance that all theorems are about just now; 0 is the public calls */

static const char *instance_name(int instance)
{
    return instance_of[instance].name;
}

/* A view of corners on one of the surfaces. */
static surfmink_outline view_of(enum surface surface, const double *corner, const double *normal, double radius,
                                size_t n)
{
    switch (surface) {
    case PLANE: return surfmink_plane(corner, n);
    case SPHERE: return surfmink_sphere(corner, n, radius);
    default: return surfmink_embedded(corner, normal, n);
    }
}

/* --- bundles: outlines of one surface, one after the other -------------------------------------------------------- */

typedef struct bundle {
    enum surface surface;
    double *corner, *normal, radius;
    size_t *offset, count;
    size_t most_corners, most_outlines; /* that there is room for */
    int max_rank;
} bundle;

static void *room_for(size_t size)
{
    void *room = malloc(size + 1);
    if (!room) {
        printf("no memory for %lu bytes\n", (unsigned long)size);
        exit(1);
    }
    return room;
}

static void bundle_open(bundle *b, enum surface surface, size_t most_outlines, size_t most_corners)
{
    b->surface = surface;
    b->radius = 1;
    b->max_rank = 12;
    b->count = 0;
    b->most_outlines = most_outlines;
    b->most_corners = most_corners;
    b->corner = (double *)room_for(3 * most_corners * sizeof *b->corner);
    b->normal = (double *)room_for(3 * most_corners * sizeof *b->normal);
    b->offset = (size_t *)room_for((most_outlines + 1) * sizeof *b->offset);
    b->offset[0] = 0;
}

static void bundle_close(bundle *b)
{
    free(b->corner);
    free(b->normal);
    free(b->offset);
}

static size_t dim_of(const bundle *b)
{
    return b->surface == PLANE ? 2 : 3;
}

static size_t corners_of(const bundle *b, size_t i)
{
    return b->offset[i + 1] - b->offset[i];
}

static double *corner_of(const bundle *b, size_t i)
{
    return b->corner + dim_of(b) * b->offset[i];
}

static double *normal_of(const bundle *b, size_t i)
{
    return b->normal + 3 * b->offset[i];
}

/* One more outline, of n corners that are yet to be written. Returns its number. */
static size_t add_outline(bundle *b, size_t n)
{
    if (b->count == b->most_outlines || b->offset[b->count] + n > b->most_corners) {
        printf("a bundle is full\n");
        exit(1);
    }
    b->offset[b->count + 1] = b->offset[b->count] + n;
    return b->count++;
}

static void copy_outline(bundle *to, const bundle *from, size_t i)
{
    size_t n = corners_of(from, i), j = add_outline(to, n);
    memcpy(corner_of(to, j), corner_of(from, i), n * dim_of(from) * sizeof(double));
    if (from->surface == EMBEDDED) memcpy(normal_of(to, j), normal_of(from, i), 3 * n * sizeof(double));
}

/* An empty bundle that could hold all of another one. */
static void bundle_like(bundle *b, const bundle *other)
{
    bundle_open(b, other->surface, other->most_outlines, other->most_corners);
    b->radius = other->radius;
    b->max_rank = other->max_rank;
}

/* --- answers: all that a batch writes ----------------------------------------------------------------------------- */

enum { STATUS, BAD, LENGTH, TURNING, AREA, MU, G, THETA, OUTPUTS };
static const char *const output_name[OUTPUTS] = {"status", "bad", "length", "turning", "area", "mu", "g", "theta"};

#define EVERYTHING ((1 << OUTPUTS) - 1)

/* Bytes around every array, which have to survive; so many that arrays are aligned like doubles and no better. */
enum { GUARD = 72, PATTERN = 0xA5 };

typedef struct answers {
    size_t count, refused, width[OUTPUTS]; /* width: bytes an outline */
    unsigned char *room[OUTPUTS];
    surfmink_results out;
} answers;

static unsigned char *entry(const answers *a, int output, size_t i)
{
    return a->room[output] ? a->room[output] + GUARD + i * a->width[output] : NULL;
}

static int is_pattern(const unsigned char *at, size_t size)
{
    while (size-- > 0)
        if (*at++ != PATTERN) return 0;
    return 1;
}

/* asked: a bit for each output that is not to be NULL. */
static void answers_open(answers *a, size_t count, int max_rank, int asked)
{
    size_t ranks = max_rank >= 0 ? (size_t)max_rank + 1 : 0, size;
    int k;
    a->count = count;
    a->width[STATUS] = sizeof(int);
    a->width[BAD] = sizeof(size_t);
    for (k = LENGTH; k < OUTPUTS; ++k) a->width[k] = (k < MU ? 1 : k == G ? 2 * ranks : ranks) * sizeof(double);
    for (k = 0; k < OUTPUTS; ++k) {
        size = count * a->width[k] + 2 * (size_t)GUARD;
        a->room[k] = asked >> k & 1 ? (unsigned char *)room_for(size) : NULL;
        if (a->room[k]) memset(a->room[k], PATTERN, size);
    }
    a->out.status = (int *)(void *)entry(a, STATUS, 0);
    a->out.bad = (size_t *)(void *)entry(a, BAD, 0);
    a->out.length = (double *)(void *)entry(a, LENGTH, 0);
    a->out.turning = (double *)(void *)entry(a, TURNING, 0);
    a->out.area = (double *)(void *)entry(a, AREA, 0);
    a->out.mu = (double *)(void *)entry(a, MU, 0);
    a->out.g = (double *)(void *)entry(a, G, 0);
    a->out.theta = (double *)(void *)entry(a, THETA, 0);
}

static void answers_close(answers *a)
{
    int k;
    for (k = 0; k < OUTPUTS; ++k) {
        if (!a->room[k]) continue;
        CHECK(is_pattern(a->room[k], GUARD));
        CHECK(is_pattern(entry(a, k, a->count), GUARD));
        free(a->room[k]);
    }
}

/* A check of one output, whose name is added to the case at hand. Costly: for what is known to fail. */
#define OF(output, check) (name_output(output), check, *strrchr(harness.which, ':') = '\0')

static void name_output(int output)
{
    size_t used = strlen(harness.which);
    snprintf(harness.which + used, sizeof harness.which - used, ": %s", output_name[output]);
}

/* What was refused has a status and a blame, and nothing else; what was not has no blame. */
static void check_untouched(const answers *a, size_t i)
{
    int k, status = a->out.status[i];
    for (k = BAD; k < OUTPUTS; ++k) {
        if (!a->room[k] || (k == BAD) != (status == SURFMINK_OK)) continue;
        if (!is_pattern(entry(a, k, i), a->width[k])) OF(k, CHECK(is_pattern(entry(a, k, i), a->width[k])));
    }
}

/* The same bits in all that both were asked for. */
static void check_same(const answers *a, size_t i, const answers *b, size_t j)
{
    int k;
    for (k = 0; k < OUTPUTS; ++k) {
        if (!a->room[k] || !b->room[k]) continue;
        if (memcmp(entry(a, k, i), entry(b, k, j), a->width[k]) == 0) continue;
        OF(k, CHECK(memcmp(entry(a, k, i), entry(b, k, j), a->width[k]) == 0));
        return;
    }
}

/* --- running a batch ---------------------------------------------------------------------------------------------- */

/* A copy at the very end of a block, off by one double from all alignments, so that sanitizers see who reads beyond. */
static double *exact_copy(const double *x, size_t count, double **block)
{
    *block = (double *)malloc((count + 1) * sizeof *x);
    if (!*block) exit(1);
    if (count > 0) memcpy(*block + 1, x, count * sizeof *x);
    return *block + 1;
}

enum { WITHOUT_SCRATCH, WITH_SCRATCH };

static void run(const bundle *b, answers *a, int with_scratch)
{
    size_t corners = b->offset[b->count], before = 2 * b->offset[0], size = 2 * corners * sizeof(double);
    double *block[2] = {NULL, NULL}, *corner = exact_copy(b->corner, dim_of(b) * corners, block);
    double *normal = b->surface == EMBEDDED ? exact_copy(b->normal, 3 * corners, block + 1) : NULL;
    unsigned char *scratch = with_scratch ? (unsigned char *)room_for(size + 2 * (size_t)GUARD) : NULL;
    surfmink_outline all = view_of(b->surface, corner, normal, b->radius, corners);
    if (scratch) memset(scratch, PATTERN, size + 2 * (size_t)GUARD);
    a->refused = batch_by(on_trial, &all, b->offset, b->count, b->max_rank, &a->out,
                          scratch ? (double *)(void *)(scratch + GUARD) : NULL);
    if (scratch) {
        CHECK(is_pattern(scratch, GUARD + before * sizeof(double)));
        CHECK(is_pattern(scratch + GUARD + size, GUARD));
    }
    free(scratch);
    free(block[0]);
    free(block[1]);
}

/* Asks for everything. */
static void measure(const bundle *b, answers *a, int with_scratch)
{
    answers_open(a, b->count, b->max_rank, EVERYTHING);
    run(b, a, with_scratch);
}

/* --- against single calls ----------------------------------------------------------------------------------------- */

enum { MAX_RANK = 40 };

typedef struct single {
    int status;
    size_t bad;
    double c, mu[MAX_RANK + 1], g[2 * MAX_RANK + 2], theta[MAX_RANK + 1];
    surfmink_functionals w;
} single;

static void measure_one(const bundle *b, size_t i, single *s)
{
    surfmink_outline o = view_of(b->surface, corner_of(b, i), normal_of(b, i), b->radius, corners_of(b, i));
    s->status = surfmink_measure(&o, b->max_rank, s->mu, s->g, &s->w, &s->bad);
    if (s->status != SURFMINK_OK) return;
    s->c = s->w.condition;
    CHECK_OK(surfmink_spectrum(s->g, b->max_rank, NULL, NULL, s->theta));
}

/* What two measurements of one outline may differ in, by what each of them may be wrong.
   L      relative: 1e-15 each
   S      relative: 2e-15 each, times c, the condition number; in the plane not at all
   area   2e-15 each of half the sum of |x_i - x_0| l_i; on the sphere large ones are 2 pi - S, and as good as S
   mu, g, theta  mu_p, g_p / L, mu_p p theta_p at rank 12: 1e-14 (1 + c) each; at other ranks in proportion to p + 2,
          for not all is the phases' fault */
static const double LIMIT[OUTPUTS] = {0, 0, 2e-15, 4e-15, 4e-15, 2e-14, 2e-14, 2e-14};
static double worst[OUTPUTS]; /* differences found, in units of what is allowed */

static void differ(int what, double off, double allowed)
{
    if (!(off <= allowed)) OF(what, CHECK_NEAR(off, 0, allowed));
    if (allowed > 0 && !(off / allowed <= worst[what])) worst[what] = off / allowed;
}

static void report_worst(const char *title)
{
    int k;
    printf("%s, %s: worst differences", instance_name(on_trial), title);
    for (k = LENGTH; k < OUTPUTS; ++k) printf("  %s %.2f", output_name[k], worst[k]);
    printf("  of what is allowed\n");
}

/* Corner k of outline i, on the sphere brought to it, whatever its magnitude. */
static void position(const bundle *b, size_t i, size_t k, double x[3])
{
    const double *corner = corner_of(b, i) + dim_of(b) * (k % corners_of(b, i));
    double most, norm;
    x[0] = corner[0], x[1] = corner[1], x[2] = b->surface == PLANE ? 0 : corner[2];
    if (b->surface != SPHERE) return;
    most = fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
    x[0] /= most, x[1] /= most, x[2] /= most;
    norm = sqrt(dot3(x, x));
    for (k = 0; k < 3; ++k) x[k] *= b->radius / norm;
}

static double area_allowed(const bundle *b, size_t i, const single *s)
{
    double x[3], y[3], z[3], farthest = 0, sum = 0;
    size_t k;
    position(b, i, 0, x);
    position(b, i, 0, y);
    for (k = 0; k < corners_of(b, i); ++k) {
        position(b, i, k + 1, z);
        sum += far_apart(x, y) * far_apart(y, z) / 2;
        farthest = fmax(farthest, far_apart(x, y));
        memcpy(y, z, sizeof y);
    }
    if (b->surface == SPHERE && farthest > b->radius) sum += s->c * s->w.turning * b->radius * b->radius;
    return sum <= DBL_MAX ? LIMIT[AREA] * sum + DBL_MIN : DBL_MAX;
}

/* What mu and theta say of g is said of the same g, and is a matter of one or two roundings. */
static void check_spectrum(const double *g, const double *mu, const double *theta, int max_rank)
{
    static double want_mu[MAX_RANK + 1], want_theta[MAX_RANK + 1];
    int p;
    CHECK_OK(surfmink_spectrum(g, max_rank, NULL, want_mu, want_theta));
    CHECK(g[1] == 0 && mu[0] == 1 && theta[0] == 0);
    for (p = 1; p <= max_rank; ++p) {
        CHECK_NEAR(mu[p], want_mu[p], 1e-15);
        CHECK(mu[p] >= 0 && mu[p] <= 1);
        CHECK_NEAR(mu[p] * remainder(p * (theta[p] - want_theta[p]), 2 * PI), 0, 2e-15);
        CHECK(fabs(theta[p]) <= (PI + 1e-15) / p);
    }
}

static void compare_ranks(const bundle *b, const answers *a, size_t i, const single *s)
{
    size_t ranks = (size_t)b->max_rank + 1;
    const double *g = a->out.g + 2 * ranks * i, *mu = a->out.mu + ranks * i, *theta = a->out.theta + ranks * i;
    double allowed, unit = 1 + s->c, l = s->w.length;
    int p;
    CHECK(g[0] == a->out.length[i]);
    if (l > 1e-290) check_spectrum(g, mu, theta, b->max_rank); /* else components lose digits, or all */
    for (p = 0; p <= b->max_rank && LIMIT[MU] * unit < 0.1; ++p) {
        allowed = unit * (p + 2) / 14;
        differ(MU, fabs(mu[p] - s->mu[p]), LIMIT[MU] * allowed);
        if (!(l > 1e-290)) continue;
        differ(G, hypot((g[2 * p] - s->g[2 * p]) / l, (g[2 * p + 1] - s->g[2 * p + 1]) / l), LIMIT[G] * allowed);
        differ(THETA, s->mu[p] * fabs(remainder(p * (theta[p] - s->theta[p]), 2 * PI)), LIMIT[THETA] * allowed);
    }
}

static void compare(const bundle *b, const answers *a, size_t i, single *s)
{
    measure_one(b, i, s);
    CHECK_STATUS(a->out.status[i], s->status);
    check_untouched(a, i);
    if (s->status != SURFMINK_OK) CHECK_EQUAL(a->out.bad[i], s->bad);
    if (s->status != SURFMINK_OK || a->out.status[i] != SURFMINK_OK) return;
    differ(LENGTH, fabs(a->out.length[i] - s->w.length), LIMIT[LENGTH] * s->w.length);
    differ(TURNING, fabs(a->out.turning[i] - s->w.turning),
           b->surface == PLANE ? 0 : LIMIT[TURNING] * s->c * s->w.turning);
    differ(AREA, fabs(a->out.area[i] - s->w.area), b->surface == EMBEDDED ? 0 : area_allowed(b, i, s));
    compare_ranks(b, a, i, s);
}

/* All outlines of a bundle; counts what became of them in seen[status]. */
static void compare_all(const bundle *b, int with_scratch, size_t *seen)
{
    static single s;
    answers a;
    char which[100];
    size_t i, refused = 0;
    measure(b, &a, with_scratch);
    snprintf(which, sizeof which, "%.99s", harness.which);
    for (i = 0; i < b->count; ++i) {
        CASE("%s, outline %lu of %lu corners", which, (unsigned long)i, (unsigned long)corners_of(b, i));
        compare(b, &a, i, &s);
        refused += s.status != SURFMINK_OK;
        if (seen) ++seen[s.status];
    }
    CASE("%s", which);
    CHECK_EQUAL(a.refused, refused);
    answers_close(&a);
}

/* --- and what may be wrong with them ------------------------------------------------------------------------------ */

enum { BACKWARDS, TOO_FEW, NO_NUMBER, INFINITE, HUGE_ONE, TWICE, NOWHERE, OPPOSITE, SPIKE, TINY, SPOILERS };

/* Spoils the last outline of a bundle. */
static void spoil(bundle *b, chance *c, size_t how)
{
    size_t i = b->count - 1, n = corners_of(b, i), dim = dim_of(b), at = one_of(c, n), next = (at + 1) % n, k;
    double *corner = corner_of(b, i), *normal = normal_of(b, i);
    double *wrong = b->surface == EMBEDDED && one_in(c, 2) ? normal : corner;
    double *x = corner + dim * at, *y = corner + dim * next;
    switch (how) {
    case BACKWARDS:
        surfmink_reverse(corner, n, dim);
        if (b->surface == EMBEDDED) surfmink_reverse(normal, n, dim);
        break;
    case TOO_FEW: b->offset[b->count] = b->offset[i] + one_of(c, 3); break;
    case NO_NUMBER: wrong[one_of(c, dim * n)] = nan(""); break;
    case INFINITE: wrong[one_of(c, dim * n)] = one_in(c, 2) ? HUGE_VAL : -HUGE_VAL; break;
    case HUGE_ONE: wrong[one_of(c, dim * n)] = one_in(c, 2) ? DBL_MAX : -1e200; break;
    case TWICE: memcpy(y, x, dim * sizeof *x); break;
    case NOWHERE: memset(wrong + dim * at, 0, dim * sizeof *wrong); break;
    case OPPOSITE: /* on the sphere, of its neighbour; in space an edge runs along a normal */
        for (k = 0; k < dim; ++k) {
            if (b->surface != EMBEDDED) y[k] = -x[k];
            if (b->surface == EMBEDDED) normal[3 * at + k] = y[k] - x[k];
        }
        break;
    case SPIKE: memcpy(corner + dim * ((at + 2) % n), x, dim * sizeof *x); break; /* there and back again */
    default:
        for (k = 0; k < dim * n; ++k) corner[k] *= 1e-310;
    }
}

/* Mostly few corners, for there every way to be odd is likely. */
static size_t corner_count(chance *c)
{
    if (one_in(c, 25)) return 65 + one_of(c, 236);
    if (one_in(c, 4)) return 10 + one_of(c, 55);
    return 3 + one_of(c, 7);
}

static void random_outline(bundle *b, chance *c, size_t n)
{
    size_t at;
    n = drawing[one_of(c, DRAWINGS)](c, n);
    at = add_outline(b, n);
    switch (b->surface) {
    case PLANE: place_on_plane(c, n, corner_of(b, at)); break;
    case SPHERE: place_on_sphere(c, n, corner_of(b, at)); break;
    default: place_in_space(c, n, corner_of(b, at), normal_of(b, at));
    }
    if (one_in(c, 6)) spoil(b, c, one_of(c, SPOILERS));
}

static void random_bundle(bundle *b, chance *c, enum surface surface, size_t count)
{
    bundle_open(b, surface, count, 330 * count + LONGEST);
    b->radius = one_in(c, 3) ? magnitude(c, 1e-100, 1e100) : 1;
    while (b->count < count) random_outline(b, c, corner_count(c));
}

/* Of all kinds, with some long ones among them. */
static void mixed_bundle(bundle *b, enum surface surface, size_t count, uint64_t number)
{
    chance c;
    c.state = seed(number) + (uint64_t)surface;
    bundle_open(b, surface, count, 1400 * count);
    while (b->count < count) random_outline(b, &c, one_in(&c, 20) ? 65 + one_of(&c, 1300) : corner_count(&c));
}

/* --- what single calls say ---------------------------------------------------------------------------------------- */

static void random_batches(enum surface surface, size_t outlines)
{
    static const int ranks[] = {0, 1, 6, 12, 12, 12, 12, 12, 12, 13, 15, 16, 17, 31, 32, 33, MAX_RANK};
    size_t seen[SURFMINK_OPPOSITE_NORMALS + 1] = {0}, done, trial = 0, few;
    chance c;
    c.state = seed(200) + (uint64_t)surface;
    memset(worst, 0, sizeof worst);
    if (on_trial < KERNELS) outlines /= 4; /* the same functions as others, or as single calls */
    for (done = 0; done < outlines / FEWER; ++trial) {
        bundle b;
        random_bundle(&b, &c, surface, 1 + one_of(&c, 600));
        b.max_rank = ranks[one_of(&c, sizeof ranks / sizeof *ranks)];
        CASE("%s, batch %lu, rank %d", surface_name[surface], (unsigned long)trial, b.max_rank);
        compare_all(&b, trial % 2 ? WITH_SCRATCH : WITHOUT_SCRATCH, seen);
        done += b.count;
        bundle_close(&b);
    }
    report_worst(surface_name[surface]);
    few = done / 1000;
    CHECK(2 * seen[SURFMINK_OK] > done); /* these are tests of the test: there was something to compare */
    CHECK(seen[SURFMINK_TOO_FEW_CORNERS] > few && seen[SURFMINK_NOT_FINITE] > few && seen[SURFMINK_CLOCKWISE] > few);
    CHECK(seen[SURFMINK_COINCIDENT_CORNERS] > few);
    if (surface != PLANE) CHECK(seen[SURFMINK_ZERO_NORMAL] > few && seen[SURFMINK_TOO_MUCH_CURVATURE] > few);
    CHECK(seen[SURFMINK_CROSSES_ITSELF] > few);
    if (surface == SPHERE) CHECK(seen[SURFMINK_ANTIPODAL_CORNERS] > few);
    if (surface == EMBEDDED) CHECK(seen[SURFMINK_UPRIGHT_EDGE] > few && seen[SURFMINK_OPPOSITE_NORMALS] > few);
}

THEOREM(in_the_plane_a_batch_says_what_single_calls_say)
{
    random_batches(PLANE, 20000);
}

THEOREM(on_the_sphere_a_batch_says_what_single_calls_say)
{
    random_batches(SPHERE, 13000);
}

THEOREM(on_embedded_surfaces_a_batch_says_what_single_calls_say)
{
    random_batches(EMBEDDED, 17000);
}

/* A flower of n corners: smooth, so that the turn at each of many corners is small and S not a sum of noise. */
static void add_flower(bundle *b, size_t n)
{
    static const double one[3] = {1, 1, 1}, several[3] = {1.6, 1.3, 1};
    const double *axis = b->surface == EMBEDDED ? several : one;
    size_t which = add_outline(b, n), i, k;
    for (i = 0; i < n; ++i) {
        double t = 2 * PI * (double)i / (double)n, c = cos(t), s = sin(t), r = 0.7 - 0.2 * s * (3 - 4 * s * s);
        double u = PI / 2 + r * c, v = 0.8 + r * s, x[3], *corner = corner_of(b, which) + dim_of(b) * i;
        x[0] = sin(u) * cos(v), x[1] = sin(u) * sin(v), x[2] = cos(u);
        if (b->surface == PLANE) x[0] = r * c, x[1] = r * s;
        for (k = 0; k < dim_of(b); ++k) {
            corner[k] = axis[k] * x[k];
            if (b->surface == EMBEDDED) normal_of(b, which)[3 * i + k] = x[k] / axis[k];
        }
    }
}

/* Up to and across whatever an implementation may cut outlines and batches into. */
static void every_length(bundle *b, enum surface surface)
{
    static const size_t more[] = {127, 128, 129, 130, 511, 512, 513, 514, 1000, 4097};
    size_t n, k;
    bundle_open(b, surface, 100, 12000);
    for (n = 3; n <= 80; ++n) add_flower(b, n);
    for (k = 0; k < sizeof more / sizeof *more; ++k) add_flower(b, more[k]);
}

THEOREM(every_number_of_corners_is_measured_alike)
{
    int surface, scratch;
    memset(worst, 0, sizeof worst);
    for (surface = 0; surface < SURFACES; ++surface) {
        bundle b;
        size_t seen[SURFMINK_OPPOSITE_NORMALS + 1] = {0};
        every_length(&b, (enum surface)surface);
        for (scratch = 0; scratch < 2; ++scratch) {
            CASE("%s, %s scratch", surface_name[surface], scratch ? "with" : "without");
            compare_all(&b, scratch, seen);
        }
        CHECK_EQUAL(seen[SURFMINK_OK], 2 * b.count);
        bundle_close(&b);
    }
    report_worst("3 to 4097 corners");
}

/* Single calls of that length take their time: once will do for all instances. */
static const single *single_million(const bundle *b)
{
    static single s[SURFACES];
    static int known[SURFACES];
    if (!known[b->surface]++) measure_one(b, 0, &s[b->surface]);
    return &s[b->surface];
}

static void compare_million(enum surface surface)
{
    const single *s;
    bundle b;
    answers a;
    double off = 0;
    int p;
    bundle_open(&b, surface, 1, 1000000 / FEWER);
    add_flower(&b, 1000000 / FEWER);
    measure(&b, &a, WITH_SCRATCH);
    s = single_million(&b);
    CASE("%s", surface_name[surface]);
    CHECK_OK(a.out.status[0]);
    CHECK_OK(s->status);
    CHECK_CLOSE(a.out.length[0], s->w.length, 1e-14);
    CHECK_CLOSE(a.out.turning[0], s->w.turning, 1e-14);
    CHECK_NEAR(a.out.area[0], s->w.area, 1e-14);
    for (p = 0; p <= b.max_rank; ++p) {
        off = fmax(off, hypot(a.out.g[2 * p] - s->g[2 * p], a.out.g[2 * p + 1] - s->g[2 * p + 1]) / s->w.length);
        CHECK_NEAR(a.out.mu[p], s->mu[p], 3e-14);
    }
    CHECK_NEAR(off, 0, 3e-14);
    NOTE("%s, %s, a million corners: L %.1e  S %.1e  area %.1e  g %.1e", instance_name(on_trial), surface_name[surface],
         fabs(a.out.length[0] / s->w.length - 1), fabs(a.out.turning[0] / s->w.turning - 1),
         fabs(a.out.area[0] - s->w.area), off);
    answers_close(&a);
    bundle_close(&b);
}

THEOREM(a_flower_of_a_million_corners_keeps_its_digits)
{
    int surface;
    for (surface = 0; surface < SURFACES; ++surface) compare_million((enum surface)surface);
}

/* --- the same bits, however an outline is asked for --------------------------------------------------------------- */

enum { MIXED = 200 };

static void shuffle(chance *c, size_t *order, size_t count)
{
    size_t i, j, kept;
    for (i = count; i > 1; --i) {
        j = one_of(c, i);
        kept = order[i - 1], order[i - 1] = order[j], order[j] = kept;
    }
}

/* The outlines of b in an order, which may leave some out, against what was said of them before. */
static void check_order(const bundle *b, const answers *before, const size_t *order, size_t count, int with_scratch)
{
    bundle other;
    answers a;
    size_t i;
    bundle_like(&other, b);
    for (i = 0; i < count; ++i) copy_outline(&other, b, order[i]);
    measure(&other, &a, with_scratch);
    for (i = 0; i < count; ++i) {
        CASE("%s, outline %lu in place %lu of %lu", surface_name[b->surface], (unsigned long)order[i], (unsigned long)i,
             (unsigned long)count);
        check_same(&a, i, before, order[i]);
    }
    answers_close(&a);
    bundle_close(&other);
}

THEOREM(an_outline_has_the_same_bits_wherever_it_stands)
{
    chance c = {seed(221)};
    int surface, trial;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t order[MIXED], i;
        bundle b;
        answers all;
        mixed_bundle(&b, (enum surface)surface, MIXED, 222);
        measure(&b, &all, WITH_SCRATCH);
        for (i = 0; i < MIXED; i += STRIDE) check_order(&b, &all, &i, 1, WITHOUT_SCRATCH);
        for (i = 0; i < MIXED; ++i) order[i] = i;
        for (i = 2; i <= MIXED; i += i < 20 && FEWER < 200 ? 1 : 11 * STRIDE)
            check_order(&b, &all, order, i, WITH_SCRATCH);
        for (trial = 0; trial < 8; trial += STRIDE) {
            shuffle(&c, order, MIXED);
            check_order(&b, &all, order, MIXED - one_of(&c, 100), trial % 2);
        }
        answers_close(&all);
        bundle_close(&b);
    }
}

THEOREM(among_refused_ones_an_outline_has_the_same_bits)
{
    chance c = {seed(223)};
    int surface;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t order[64], refused[MIXED], i, k, bad = 0, last;
        bundle b;
        answers all;
        mixed_bundle(&b, (enum surface)surface, MIXED, 224);
        measure(&b, &all, WITHOUT_SCRATCH);
        CASE("%s", surface_name[surface]);
        for (i = 0; i < MIXED; ++i)
            if (all.out.status[i] != SURFMINK_OK) refused[bad++] = i;
        CHECK(bad > 20 && bad < MIXED - 50);
        for (i = 0, last = 0; i < MIXED && bad > 0; i += STRIDE) {
            if (all.out.status[i] != SURFMINK_OK) continue;
            for (k = 0; k < 64; ++k) order[k] = refused[one_of(&c, bad)];
            order[one_of(&c, 64)] = i;
            order[one_of(&c, 64)] = last; /* and one that is not, in one place out of 64 */
            check_order(&b, &all, order, 64, WITHOUT_SCRATCH);
            last = i;
        }
        answers_close(&all);
        bundle_close(&b);
    }
}

THEOREM(scratch_changes_no_bit)
{
    int surface;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t i, set;
        bundle b;
        answers a[2];
        for (set = 0; set < 2; ++set) {
            if (set == 0)
                mixed_bundle(&b, (enum surface)surface, MIXED, 226);
            else
                every_length(&b, (enum surface)surface);
            measure(&b, &a[0], WITHOUT_SCRATCH);
            measure(&b, &a[1], WITH_SCRATCH);
            CHECK_EQUAL(a[1].refused, a[0].refused);
            for (i = 0; i < b.count; ++i) {
                CASE("%s, outline %lu of %lu corners", surface_name[surface], (unsigned long)i,
                     (unsigned long)corners_of(&b, i));
                check_same(&a[1], i, &a[0], i);
            }
            answers_close(&a[0]);
            answers_close(&a[1]);
            bundle_close(&b);
        }
    }
}

THEOREM(what_is_not_asked_for_changes_no_bit_of_the_rest)
{
    int surface, asked;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t i;
        bundle b;
        answers all, some;
        mixed_bundle(&b, (enum surface)surface, 24, 227);
        b.max_rank = 8; /* tiles of three ranks, and one that is not full */
        measure(&b, &all, WITH_SCRATCH);
        for (asked = 0; asked <= EVERYTHING; asked += STRIDE) {
            answers_open(&some, b.count, b.max_rank, asked);
            run(&b, &some, asked % 3 == 0);
            CASE("%s, asked for 0x%02x", surface_name[surface], (unsigned)asked);
            CHECK_EQUAL(some.refused, all.refused);
            for (i = 0; i < b.count; ++i) {
                CASE("%s, asked for 0x%02x, outline %lu", surface_name[surface], (unsigned)asked, (unsigned long)i);
                check_same(&some, i, &all, i);
            }
            answers_close(&some);
        }
        answers_close(&all);
        bundle_close(&b);
    }
}

#ifdef _OPENMP
THEOREM(any_number_of_threads_gives_the_same_bits)
{
    int surface, threads, scratch, most = omp_get_max_threads();
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t i;
        bundle b;
        answers one, a;
        mixed_bundle(&b, (enum surface)surface, 1000, 229);
        --b.count;
        add_flower(&b, surfmink__parallel + 1); /* below that many corners there is but one thread */
        omp_set_num_threads(1);
        measure(&b, &one, WITH_SCRATCH);
        for (threads = 2; threads <= 3; ++threads)
            for (scratch = 0; scratch < 2; ++scratch) {
                omp_set_num_threads(threads);
                measure(&b, &a, scratch);
                CASE("%s, %d threads", surface_name[surface], threads);
                CHECK_EQUAL(a.refused, one.refused);
                for (i = 0; i < b.count; ++i) {
                    CASE("%s, %d threads, outline %lu", surface_name[surface], threads, (unsigned long)i);
                    check_same(&a, i, &one, i);
                }
                answers_close(&a);
            }
        answers_close(&one);
        bundle_close(&b);
    }
    omp_set_num_threads(most);
}
#endif

/* --- refusals ----------------------------------------------------------------------------------------------------- */

/* Plain outlines, one of them long; the last arguments single out one that is to be spoiled. */
static void plain_bundle(bundle *b, enum surface surface, size_t count, size_t place, size_t how)
{
    chance c = {seed(231)};
    size_t n, i;
    bundle_open(b, surface, count, 100 * count);
    while (b->count < count) {
        n = one_in(&c, 15) ? 97 : 3 + one_of(&c, 7);
        for (i = 0; i < n; ++i) put(i, 1, 2 * PI * ((double)i + between(&c, 0, 0.5)) / (double)n);
        i = add_outline(b, n);
        if (surface == PLANE) memcpy(corner_of(b, i), shape, 2 * n * sizeof *shape);
        if (surface == SPHERE) onto_sphere(shape, n, 0.5, corner_of(b, i));
        if (surface == EMBEDDED) /* again where normals happen to be opposite */
            do lay_out(&c, n, 0.3, corner_of(b, i), normal_of(b, i));
            while (surfmink_measure(IN_SPACE(corner_of(b, i), normal_of(b, i), n), 0, NULL, NULL, NULL, NULL));
        if (i == place) {
            chance other = {seed(232)};
            other.state += 1000 * place + how;
            spoil(b, &other, how);
        }
    }
}

THEOREM(a_refused_outline_is_untouched_and_others_do_not_notice)
{
    enum { COUNT = 21 };
    static single s;
    int surface;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t place, how, i, refused = 0;
        bundle b;
        answers good, a;
        plain_bundle(&b, (enum surface)surface, COUNT, COUNT, 0);
        measure(&b, &good, WITH_SCRATCH);
        CHECK_EQUAL(good.refused, 0);
        bundle_close(&b);
        for (place = 0; place < COUNT; ++place)
            for (how = 0; how < SPOILERS; ++how) {
                plain_bundle(&b, (enum surface)surface, COUNT, place, how);
                measure(&b, &a, how % 2 ? WITH_SCRATCH : WITHOUT_SCRATCH);
                CASE("%s, spoiler %d, outline %d", surface_name[surface], (int)how, (int)place);
                compare(&b, &a, place, &s);
                CHECK_EQUAL(a.refused, s.status != SURFMINK_OK);
                refused += a.refused;
                for (i = 0; i < COUNT; ++i) {
                    CASE("%s, spoiler %d, outline %d, seen at %d", surface_name[surface], (int)how, (int)place, (int)i);
                    if (i != place) check_same(&a, i, &good, i);
                }
                answers_close(&a);
                bundle_close(&b);
            }
        CHECK(refused > COUNT * (SPOILERS - 4));
        answers_close(&good);
    }
}

/* Refused for a reason that is not theirs: nothing is said of any outline but that. */
static void check_all_bad(const bundle *b)
{
    size_t i;
    answers a;
    measure(b, &a, WITH_SCRATCH);
    CHECK_EQUAL(a.refused, b->count);
    for (i = 0; i < b->count; ++i) {
        CHECK_STATUS(a.out.status[i], SURFMINK_BAD_ARGUMENT);
        CHECK_EQUAL(a.out.bad[i], corners_of(b, i));
        check_untouched(&a, i);
    }
    answers_close(&a);
}

THEOREM(a_bad_rank_or_radius_refuses_all)
{
    double wrong_radius[6];
    int surface, k;
    wrong_radius[0] = 0, wrong_radius[1] = -0.0, wrong_radius[2] = -1;
    wrong_radius[3] = HUGE_VAL, wrong_radius[4] = nan(""), wrong_radius[5] = 1e308;
    for (surface = 0; surface < SURFACES; ++surface) {
        bundle b;
        mixed_bundle(&b, (enum surface)surface, 150, 233);
        for (k = 0; k < 3; ++k) {
            b.max_rank = k == 0 ? -1 : k == 1 ? -7 : INT_MIN;
            CASE("%s, rank %d", surface_name[surface], b.max_rank);
            check_all_bad(&b);
        }
        b.max_rank = 3;
        for (k = 0; k < 6 && surface == SPHERE; ++k) {
            b.radius = wrong_radius[k];
            CASE("radius %g", b.radius);
            check_all_bad(&b);
        }
        bundle_close(&b);
    }
}

THEOREM(no_outlines_are_none_refused_and_nothing_written)
{
    int surface, asked;
    for (surface = 0; surface < SURFACES; ++surface)
        for (asked = 0; asked < 2; ++asked) {
            bundle b;
            answers a;
            mixed_bundle(&b, (enum surface)surface, 3, 234);
            b.count = 0;
            answers_open(&a, 3, b.max_rank, asked ? EVERYTHING : 0);
            run(&b, &a, WITH_SCRATCH);
            CHECK_EQUAL(a.refused, 0);
            a.count = 0; /* so that what follows is guard */
            answers_close(&a);
            bundle_close(&b);
        }
}

THEOREM(outlines_without_corners_need_no_place_for_them)
{
    static const size_t offset[3] = {0, 0, 0};
    int status[2] = {-1, -1};
    size_t bad[2] = {9, 9};
    surfmink_results out = {NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    out.status = status;
    out.bad = bad;
    CHECK_EQUAL(surfmink_batch(IN_SPACE(NULL, NULL, 0), offset, 2, 6, &out, NULL), 2);
    CHECK_STATUS(status[0], SURFMINK_TOO_FEW_CORNERS);
    CHECK_STATUS(status[1], SURFMINK_TOO_FEW_CORNERS);
    CHECK(bad[0] == 0 && bad[1] == 0);
}

THEOREM(corners_before_the_first_offset_are_not_looked_at)
{
    int surface, scratch;
    for (surface = 0; surface < SURFACES; ++surface)
        for (scratch = 0; scratch < 2; ++scratch) {
            size_t i, first;
            bundle b, rest;
            answers all, a;
            mixed_bundle(&b, (enum surface)surface, 100, 235);
            measure(&b, &all, WITH_SCRATCH);
            for (first = 1; first < 100; first += first < 10 ? STRIDE : 15 * STRIDE) {
                rest = b;
                rest.offset += first;
                rest.count -= first;
                for (i = 0; i < dim_of(&b) * rest.offset[0]; ++i) b.corner[i] = nan("");
                measure(&rest, &a, scratch);
                for (i = 0; i < rest.count; ++i) {
                    CASE("%s, outline %d of those from %d on", surface_name[surface], (int)i, (int)first);
                    check_same(&a, i, &all, first + i);
                }
                answers_close(&a);
            }
            answers_close(&all);
            bundle_close(&b);
        }
}

/* Three outlines on the corners of one flower, with offsets that do not only rise. */
static void measure_falling(enum surface surface, size_t length, size_t offset[4], answers *a)
{
    bundle b, falling;
    bundle_open(&b, surface, 1, length);
    add_flower(&b, length);
    falling = b;
    falling.offset = offset;
    falling.count = 3;
    measure(&falling, a, WITH_SCRATCH);
    CASE("%s, %d corners", surface_name[surface], (int)length);
    bundle_close(&b);
}

THEOREM(offsets_that_fall_are_a_bad_argument)
{
    static const size_t length[3] = {5, 70, 600};
    int surface, k;
    for (surface = 0; surface < SURFACES; ++surface)
        for (k = 0; k < 3; ++k) { /* an outline, one that would end before it starts, and the first one again */
            size_t offset[4] = {0, 0, 0, 0};
            answers a;
            offset[1] = offset[3] = length[k];
            measure_falling((enum surface)surface, length[k], offset, &a);
            CHECK_EQUAL(a.refused, 1);
            CHECK_OK(a.out.status[0]);
            CHECK_STATUS(a.out.status[1], SURFMINK_BAD_ARGUMENT);
            check_untouched(&a, 1);
            check_same(&a, 2, &a, 0);
            answers_close(&a);
        }
}

THEOREM(outlines_that_end_after_the_last_offset_are_a_bad_argument)
{
    static const size_t length[3] = {5, 70, 600};
    int surface, k;
    for (surface = 0; surface < SURFACES; ++surface)
        for (k = 0; k < 3; ++k) { /* one that ends after the last, one that falls, and one that is within */
            size_t offset[4] = {0, 0, 3, 0};
            answers a;
            offset[1] = length[k];
            offset[3] = length[k] - 1;
            measure_falling((enum surface)surface, length[k], offset, &a);
            CHECK_STATUS(a.out.status[0], SURFMINK_BAD_ARGUMENT);
            CHECK_STATUS(a.out.status[1], SURFMINK_BAD_ARGUMENT);
            check_untouched(&a, 0);
            check_untouched(&a, 1);
            CHECK(a.out.status[2] != SURFMINK_BAD_ARGUMENT);
            answers_close(&a);
        }
}

/* --- the reference sets in tests/data, to the limits of test_reference.c ------------------------------------------ */

enum { REFERENCE_RANK = 12, MOST_REFERENCE = 256 };

static const char *const point_columns[3] = {"x", "y", "z"}, *const normal_columns[3] = {"nx", "ny", "nz"};

/* The outlines of a table, in the order of their reference. */
static void add_reference(bundle *b, const char *reference, const char *points)
{
    static double corner[3 * MOST_REFERENCE];
    table t;
    table_open(&t, reference);
    while (table_next(&t)) {
        const char *name = table_text(&t, "case");
        size_t n = table_points(points, name, point_columns, 3, MOST_REFERENCE, corner), i = add_outline(b, n), k;
        for (k = 0; k < n; ++k) memcpy(corner_of(b, i) + dim_of(b) * k, corner + 3 * k, dim_of(b) * sizeof *corner);
        table_points(points, name, normal_columns, 3, MOST_REFERENCE, normal_of(b, i));
    }
}

/* One row against what was measured of it. */
static void check_reference(const table *t, const answers *a, size_t i)
{
    size_t ranks = REFERENCE_RANK + 1;
    const double *mu = a->out.mu + ranks * i, *theta = a->out.theta + ranks * i;
    int p;
    CASE("%s %s", table_text(t, "case"), table_text(t, "desc"));
    CHECK_OK(a->out.status[i]);
    CHECK_CLOSE(a->out.length[i], table_number(t, "L"), 1e-14);
    CHECK_NEAR(a->out.turning[i], table_number(t, "sum_alpha"), 1e-13);
    for (p = 1; p <= REFERENCE_RANK; ++p) {
        double want = table_rank(t, "theta_", p);
        CHECK_NEAR(mu[p], table_rank(t, "mu_", p), 1e-13);
        if (!isnan(want)) CHECK_NEAR(mu[p] * remainder(p * (theta[p] - want), 2 * PI), 0, 1e-12);
    }
}

/* All outlines of the set in one batch, or one for each row that has a radius. */
static void check_set(enum surface surface, const char *reference, const char *points, size_t rows)
{
    bundle b;
    answers a;
    table t;
    size_t i = 0;
    bundle_open(&b, surface, 20, 2000);
    add_reference(&b, reference, points);
    CHECK_EQUAL(b.count, rows);
    table_open(&t, reference);
    while (table_next(&t)) {
        if (surface == SPHERE) b.radius = table_number(&t, "R");
        measure(&b, &a, i % 2 ? WITH_SCRATCH : WITHOUT_SCRATCH);
        CHECK_EQUAL(a.refused, 0);
        check_reference(&t, &a, i);
        if (surface != EMBEDDED) CHECK_CLOSE(a.out.area[i], table_number(&t, "area"), 1e-13);
        answers_close(&a);
        ++i;
    }
    bundle_close(&b);
}

THEOREM(the_reference_sets_come_out_of_batches)
{
    check_set(SPHERE, "tests/data/sphere_geodesic_ref.tsv", "tests/data/sphere_geodesic_points.tsv", 12);
    check_set(EMBEDDED, "tests/data/line_surface_ref.tsv", "tests/data/line_surface_points.tsv", 6);
    check_set(PLANE, "tests/data/flat_ref.tsv", "tests/data/flat_points.tsv", 5);
    check_set(EMBEDDED, "tests/data/flat_ref.tsv", "tests/data/flat_points.tsv", 5);
}

/* Contours of a random field on a mesh of the sphere, one after the other. */
static void add_contours(bundle *b)
{
    table t;
    double last = -1, corner[3], normal[3];
    size_t k, d, at = 0;
    table_open(&t, "tests/data/sphere_grf_seed1.contours.cells.tsv");
    while (table_next(&t)) {
        double cell = table_number(&t, "cell");
        for (d = 0; d < 3; ++d)
            corner[d] = table_number(&t, point_columns[d]), normal[d] = table_number(&t, normal_columns[d]);
        if (cell != last) at = b->offset[add_outline(b, 0)];
        last = cell;
        k = b->offset[b->count]++;
        CHECK(k >= at);
        memcpy(b->corner + 3 * k, corner, sizeof corner);
        memcpy(b->normal + 3 * k, normal, sizeof normal);
    }
}

THEOREM(contours_of_a_random_field_come_out_of_a_batch)
{
    bundle b;
    answers a;
    table t;
    size_t i, hole = 7;
    int p;
    bundle_open(&b, EMBEDDED, 20, 2000);
    b.max_rank = 6;
    add_contours(&b);
    CHECK_EQUAL(b.count, 17);
    measure(&b, &a, WITH_SCRATCH);
    CHECK_EQUAL(a.refused, 1);
    CHECK_STATUS(a.out.status[hole], SURFMINK_CLOCKWISE); /* a hole runs the other way */
    answers_close(&a);
    surfmink_reverse(corner_of(&b, hole), corners_of(&b, hole), 3);
    surfmink_reverse(normal_of(&b, hole), corners_of(&b, hole), 3);
    measure(&b, &a, WITH_SCRATCH);
    CHECK_EQUAL(a.refused, 0);
    table_open(&t, "tests/data/sphere_grf_seed1.contours.ref.tsv");
    for (i = 0; table_next(&t); ++i) {
        const double *mu = a.out.mu + 7 * i, *theta = a.out.theta + 7 * i;
        CASE("contour %d", (int)i);
        CHECK_EQUAL(corners_of(&b, i), table_number(&t, "n"));
        CHECK_CLOSE(a.out.length[i], table_number(&t, "L"), 1e-14);
        CHECK_NEAR(i == hole ? -a.out.turning[i] : a.out.turning[i], table_number(&t, "sum_alpha"), 1e-13);
        for (p = 2; p <= 6; ++p) {
            CHECK_NEAR(mu[p], table_rank(&t, "mu_", p), 1e-13);
            if (i != hole) CHECK_NEAR(mu[p] * remainder(p * theta[p] - table_rank(&t, "arg_", p), 2 * PI), 0, 1e-12);
        }
    }
    answers_close(&a);
    bundle_close(&b);
}

/* --- what a measure of shapes has to do --------------------------------------------------------------------------- */

/* Of ordinary magnitudes, so that units of 2^-90 to 2^90 leave them ordinary: kernels take normals whose squares lie in
   [1e-60, 1e60]. */
static void ordinary_bundle(bundle *b, enum surface surface)
{
    chance c = {seed(251)};
    size_t n, i;
    c.state += (uint64_t)surface;
    bundle_open(b, surface, 100, 12000);
    while (b->count < 100) {
        n = one_in(&c, 12) ? 65 + one_of(&c, 700) : corner_count(&c);
        for (i = 0; i < n; ++i) put(i, between(&c, 0.3, 1), 2 * PI * ((double)i + between(&c, 0, 0.9)) / (double)n);
        i = add_outline(b, n);
        if (surface == PLANE) memcpy(corner_of(b, i), shape, 2 * n * sizeof *shape);
        if (surface == SPHERE) onto_sphere(shape, n, between(&c, 0.001, 1), corner_of(b, i));
        if (surface == EMBEDDED) lay_out(&c, n, between(&c, 0.001, 0.3), corner_of(b, i), normal_of(b, i));
    }
}

/* Lengths `by` times as long, areas its square, all that has no unit the same: exactly. */
static void check_scaled(const bundle *b, const answers *before, double by)
{
    size_t i, k, ranks = (size_t)b->max_rank + 1;
    answers a;
    measure(b, &a, WITH_SCRATCH);
    CHECK_EQUAL(a.refused, before->refused);
    for (i = 0; i < b->count; ++i) {
        CASE("%s, outline %lu, %g times as large", surface_name[b->surface], (unsigned long)i, by);
        CHECK_EQUAL(a.out.status[i], before->out.status[i]);
        if (a.out.status[i] != SURFMINK_OK) continue;
        CHECK(a.out.length[i] == before->out.length[i] * by);
        CHECK(a.out.area[i] == before->out.area[i] * by * by);
        CHECK_SAME(a.out.turning + i, before->out.turning + i, 1);
        CHECK_SAME(a.out.mu + ranks * i, before->out.mu + ranks * i, ranks);
        CHECK_SAME(a.out.theta + ranks * i, before->out.theta + ranks * i, ranks);
        for (k = 2 * ranks * i; k < 2 * ranks * (i + 1); ++k) CHECK(a.out.g[k] == before->out.g[k] * by);
    }
    answers_close(&a);
}

THEOREM(powers_of_two_scale_exactly)
{
    static const int powers[] = {-90, -63, -1, 1, 52, 90};
    int surface;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t k, i;
        bundle b;
        answers before;
        ordinary_bundle(&b, (enum surface)surface);
        measure(&b, &before, WITHOUT_SCRATCH);
        CHECK(before.refused < b.count / 4);
        for (k = 0; k < sizeof powers / sizeof *powers; ++k) {
            double by = power_of_two(powers[k]);
            for (i = 0; i < dim_of(&b) * b.offset[b.count]; ++i) b.corner[i] *= by;
            check_scaled(&b, &before, surface == SPHERE ? 1 : by);
            for (i = 0; i < dim_of(&b) * b.offset[b.count]; ++i) b.corner[i] /= by;
            for (i = 0; i < 3 * b.offset[b.count] && surface == EMBEDDED; ++i) b.normal[i] *= by;
            b.radius *= by;
            check_scaled(&b, &before, surface == SPHERE ? by : 1);
            for (i = 0; i < 3 * b.offset[b.count] && surface == EMBEDDED; ++i) b.normal[i] /= by;
            b.radius /= by;
        }
        answers_close(&before);
        bundle_close(&b);
    }
}

/* Regular polygons of 3 to 40 corners, of many sizes: on the sphere, and in space with corners for normals. */
static void regular_bundle(bundle *b, enum surface surface)
{
    static const double size[3] = {1e-9, 0.1, 1.2};
    size_t n, i, k;
    bundle_open(b, surface, 3 * 38, 3 * 38 * 40);
    b->max_rank = MAX_RANK;
    for (k = 0; k < 3; ++k)
        for (n = 3; n <= 40; ++n) {
            size_t at = add_outline(b, n);
            double *corner = corner_of(b, at);
            for (i = 0; i < n; ++i) put(i, surface == PLANE ? size[k] : 1, 2 * PI * (double)i / (double)n + 0.1);
            if (surface == PLANE)
                memcpy(corner, shape, 2 * n * sizeof *shape);
            else
                onto_sphere(shape, n, size[k], corner);
            if (surface == EMBEDDED) memcpy(normal_of(b, at), corner, 3 * n * sizeof *corner);
        }
}

/* Paper 3.4: mu_p = 1 where the number of corners divides p, else 0. */
THEOREM(regular_polygons_have_mu_one_at_multiples_of_n)
{
    int surface, p;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t i;
        bundle b;
        answers a;
        regular_bundle(&b, (enum surface)surface);
        measure(&b, &a, WITHOUT_SCRATCH);
        CHECK_EQUAL(a.refused, 0);
        for (i = 0; i < b.count; ++i)
            for (p = 1; p <= MAX_RANK; ++p) {
                CASE("%s, %d corners, outline %d, rank %d", surface_name[surface], (int)corners_of(&b, i), (int)i, p);
                CHECK_NEAR(a.out.mu[(MAX_RANK + 1) * i + (size_t)p], (size_t)p % corners_of(&b, i) ? 0 : 1,
                           1e-14 * fmax(1, p / 12.0));
            }
        answers_close(&a);
        bundle_close(&b);
    }
}

/* Two surfaces, one meaning: all but the area, within what `compare` grants. */
static void check_alike(const bundle *b, const answers *a, const answers *other, int all)
{
    static single s;
    size_t ranks = (size_t)b->max_rank + 1, i, p;
    for (i = 0; i < b->count; ++i) {
        CASE("%s, outline %lu of %lu corners", surface_name[b->surface], (unsigned long)i,
             (unsigned long)corners_of(b, i));
        measure_one(b, i, &s);
        CHECK_EQUAL(a->out.status[i], other->out.status[i]);
        if (a->out.status[i] != SURFMINK_OK || other->out.status[i] != SURFMINK_OK || s.c > 100) continue;
        CHECK_CLOSE(other->out.turning[i], a->out.turning[i], LIMIT[TURNING] * s.c);
        if (!all) continue;
        CHECK_CLOSE(other->out.length[i], a->out.length[i], LIMIT[LENGTH]);
        for (p = 0; p < ranks; ++p)
            CHECK_NEAR(other->out.mu[ranks * i + p], a->out.mu[ranks * i + p], LIMIT[MU] * (1 + s.c) * (1 + s.c));
    }
}

THEOREM(a_plane_in_space_is_the_plane)
{
    bundle plane, space;
    answers a, other;
    size_t i, turn;
    ordinary_bundle(&plane, PLANE);
    bundle_open(&space, EMBEDDED, plane.most_outlines, plane.most_corners);
    for (i = 0; i < plane.count; ++i) add_outline(&space, corners_of(&plane, i));
    measure(&plane, &a, WITH_SCRATCH);
    for (turn = 0; turn < 3; ++turn) { /* the plane of x and y, of y and z, of z and x */
        for (i = 0; i < plane.offset[plane.count]; ++i) {
            space.corner[3 * i + turn] = plane.corner[2 * i];
            space.corner[3 * i + (turn + 1) % 3] = plane.corner[2 * i + 1];
            space.corner[3 * i + (turn + 2) % 3] = 7;
            space.normal[3 * i + turn] = space.normal[3 * i + (turn + 1) % 3] = 0;
            space.normal[3 * i + (turn + 2) % 3] = 0.3;
        }
        measure(&space, &other, WITHOUT_SCRATCH);
        check_alike(&plane, &a, &other, 1);
        answers_close(&other);
    }
    answers_close(&a);
    bundle_close(&plane);
    bundle_close(&space);
}

/* With chords for arcs, which at a size of 1e-8 is the same to all digits. */
THEOREM(the_sphere_is_an_embedded_surface_up_to_lengths)
{
    int small;
    for (small = 0; small < 2; ++small) {
        bundle sphere, space;
        answers a, other;
        size_t i;
        ordinary_bundle(&sphere, SPHERE);
        for (i = 0; i < sphere.offset[sphere.count] && small; ++i) {
            sphere.corner[3 * i] *= 1e-8;
            sphere.corner[3 * i + 1] *= 1e-8;
            sphere.corner[3 * i + 2] = 1;
        }
        bundle_open(&space, EMBEDDED, sphere.most_outlines, sphere.most_corners);
        for (i = 0; i < sphere.count; ++i) add_outline(&space, corners_of(&sphere, i));
        memcpy(space.corner, sphere.corner, 3 * sphere.offset[sphere.count] * sizeof(double));
        memcpy(space.normal, sphere.corner, 3 * sphere.offset[sphere.count] * sizeof(double));
        measure(&sphere, &a, WITH_SCRATCH);
        measure(&space, &other, WITH_SCRATCH);
        check_alike(&sphere, &a, &other, small);
        answers_close(&a);
        answers_close(&other);
        bundle_close(&sphere);
        bundle_close(&space);
    }
}

/* --- what the kernels measure themselves -------------------------------------------------------------------------- */

#ifdef SURFMINK__NATIVE
/* The corner-by-corner path would make up for kernels that decline: slower, but right. */
static void check_kernels_take(const bundle *b, size_t first)
{
    surfmink__measure_window *window = on_trial == PUBLIC ? surfmink__choose() : instance_of[on_trial].window;
    surfmink_outline all = view_of(b->surface, b->corner, b->normal, b->radius, b->offset[b->count]);
    unsigned char left[64];
    size_t at, i;
    answers a;
    if (!window) return; /* outline by outline there is nothing to leave */
    answers_open(&a, b->count, b->max_rank, EVERYTHING);
    for (at = first; at < b->count; at += 64) {
        size_t count = b->count - at < 64 ? b->count - at : 64;
        surfmink__job job = job_of(&all, b->offset, b->max_rank, &a.out, NULL);
        window(&job, at, count, left);
        for (i = 0; i < count; ++i) {
            CASE("%s, outline %d of %d corners", surface_name[b->surface], (int)(at + i), (int)corners_of(b, at + i));
            CHECK(!left[i]);
        }
    }
    answers_close(&a);
}

THEOREM(kernels_measure_flowers_and_small_polygons_themselves)
{
    int surface;
    for (surface = 0; surface < SURFACES; ++surface) {
        bundle b;
        every_length(&b, (enum surface)surface);
        check_kernels_take(&b, 9); /* from 12 corners on */
        bundle_close(&b);
        regular_bundle(&b, (enum surface)surface);
        b.count = 2 * 38; /* the largest ones are not ordinary on a sphere */
        check_kernels_take(&b, 0);
        bundle_close(&b);
    }
}
#endif

/* --- in any strip of a long outline ------------------------------------------------------------------------------- */

enum { STAR = 150 }; /* corners; a strip has 19 of them where there are eight lanes */

/* One more star of long edges in space, its normals all up. */
static size_t add_star(bundle *b)
{
    size_t at = add_outline(b, STAR), i;
    double *corner = corner_of(b, at), *normal = normal_of(b, at);
    for (i = 0; i < STAR; ++i) {
        double r = i % 2 ? 30 : 28, phi = 2 * PI * (double)i / STAR;
        corner[3 * i] = r * cos(phi), corner[3 * i + 1] = r * sin(phi), corner[3 * i + 2] = 0;
        normal[3 * i] = normal[3 * i + 1] = 0, normal[3 * i + 2] = 1;
    }
    return at;
}

/* Where products of normals and edges overflow, the careful path takes over; up to there the kernels do. */
THEOREM(a_normal_counts_by_its_direction_however_long_it_is)
{
    bundle b;
    answers a;
    size_t i, at;
    int p;
    bundle_open(&b, EMBEDDED, 1000, 1000 * STAR);
    add_star(&b);
    for (at = 5; at < STAR; at += 19) {
        double length = 3e153;
        for (; length < 8e153; length *= 1.03) normal_of(&b, add_star(&b))[3 * at + 2] = length;
    }
    measure(&b, &a, WITHOUT_SCRATCH);
    CHECK_EQUAL(a.refused, 0);
    for (i = 0; i < b.count; ++i) {
        CASE("outline %d", (int)i);
        CHECK_CLOSE(a.out.turning[i], 2 * PI, 1e-13);
        for (p = 0; p <= b.max_rank; ++p) CHECK_NEAR(a.out.mu[i * 13 + (size_t)p], a.out.mu[p], 1e-13);
    }
    answers_close(&a);
    bundle_close(&b);
}

/* A past bug: the square of such a normal is denormal, and the kernels said S = 6.161 for 2 pi. */
THEOREM(tiny_normals_beside_long_edges_keep_their_digits)
{
    static const double size[4] = {1.5e-162, 1e-160, 1e-158, 1e162}, edge[4] = {1e61, 1e64, 1e80, 1e-100};
    bundle b;
    answers a;
    size_t i, k, n, at;
    bundle_open(&b, EMBEDDED, 300, 300 * STAR);
    for (k = 0; k < 16; ++k)
        for (n = 3; n <= STAR; n += n < 12 ? 1 : 46) {
            at = add_outline(&b, n);
            for (i = 0; i < n; ++i) {
                double t = 2 * PI * (double)i / (double)n, *x = corner_of(&b, at) + 3 * i,
                       *m = normal_of(&b, at) + 3 * i;
                x[0] = edge[k / 4] * cos(t), x[1] = edge[k / 4] * sin(t), x[2] = 0;
                m[0] = m[1] = 0, m[2] = size[k % 4] * (1 + 0.5 * (double)(i % 3));
            }
        }
    measure(&b, &a, WITH_SCRATCH);
    CHECK_EQUAL(a.refused, 0);
    for (i = 0; i < b.count; ++i) {
        CASE("outline %d of %d corners", (int)i, (int)corners_of(&b, i));
        CHECK_CLOSE(a.out.turning[i], 2 * PI, LIMIT[TURNING]);
        for (k = 1; k <= 12; ++k) CHECK_NEAR(a.out.mu[13 * i + k], k % corners_of(&b, i) ? 0 : 1, LIMIT[MU]);
    }
    answers_close(&a);
    bundle_close(&b);
}

/* One more circle of `size` corners on the saddle z = 2 (x^2 - y^2), which encloses a curvature of about -3 pi / 2;
   with a whisker at corner `at` if there is one, the way back from which ends in the corner but for rounding. */
static void add_whisker(bundle *b, size_t size, size_t at, double rounding)
{
    size_t n = at < size ? size + 2 : size, number = add_outline(b, n), i, k;
    double *x = corner_of(b, number), *normal = normal_of(b, number);
    for (i = 0; i < n; ++i, x += 3, normal += 3) {
        size_t place = i <= at ? i : i < at + 3 ? at : i - 2;
        double phi = 2 * PI * (double)place / (double)size;
        x[0] = cos(phi), x[1] = sin(phi), x[2] = 2 * (x[0] * x[0] - x[1] * x[1]);
        normal[0] = -4 * x[0], normal[1] = 4 * x[1], normal[2] = 1;
        if (i == at + 1)
            for (k = 0; k < 2; ++k) x[k] *= 1.5;
        if (i == at + 2) x[0] *= 1 + rounding;
    }
}

/* Short outlines have a lane each, long ones are cut into strips. */
THEOREM(a_whisker_turns_by_plus_pi_wherever_it_stands)
{
    static const size_t size[2] = {40, STAR};
    bundle b;
    answers a;
    size_t i, at, k;
    int ulps;
    for (k = 0; k < 2; ++k) {
        bundle_open(&b, EMBEDDED, 1000, 1000 * (STAR + 2));
        add_whisker(&b, size[k], size[k], 0);
        for (at = 0; at < size[k]; at += STRIDE)
            for (ulps = -1; ulps <= 1; ++ulps) add_whisker(&b, size[k], at, ulps * DBL_EPSILON);
        measure(&b, &a, WITHOUT_SCRATCH);
        CHECK_EQUAL(a.refused, 0);
        for (i = 0; i < b.count; ++i) {
            CASE("outline %d of %d corners", (int)i, (int)size[k]);
            CHECK(a.out.turning[i] > 3 * PI); /* so that 2 pi less would be an ordinary S, too */
            CHECK_CLOSE(a.out.turning[i], a.out.turning[0], 1e-13);
        }
        answers_close(&a);
        bundle_close(&b);
    }
}

#ifdef SURFMINK__DISPATCHES
THEOREM(a_processor_gets_the_widest_instance_that_it_can_run)
{
    CHECK(surfmink__instance(1, 1) == surfmink__window_avx512);
    CHECK(surfmink__instance(1, 0) == surfmink__window_avx512);
    CHECK(surfmink__instance(0, 1) == surfmink__window_avx2);
    CHECK(surfmink__instance(0, 0) == surfmink__window_sse2);
    CHECK(surfmink__choose() == surfmink__instance(can_run(KERNELS + 2), can_run(KERNELS + 1))); /* in instance_of */
}

/* Both have fused multiply-add and eight lanes; what stands in one register or in two is no matter. */
THEOREM(avx2_and_avx512_agree_to_the_bit)
{
    static const int avx2 = KERNELS + 1, avx512 = KERNELS + 2; /* in instance_of */
    int surface;
    if (!can_run(avx2) || !can_run(avx512)) return;
    for (surface = 0; surface < SURFACES; ++surface) {
        size_t i;
        bundle b;
        answers a[2];
        mixed_bundle(&b, (enum surface)surface, MIXED, 227);
        on_trial = avx2;
        measure(&b, &a[0], WITH_SCRATCH);
        on_trial = avx512;
        measure(&b, &a[1], WITH_SCRATCH);
        for (i = 0; i < b.count; ++i) {
            CASE("%s, outline %lu of %lu corners", surface_name[surface], (unsigned long)i,
                 (unsigned long)corners_of(&b, i));
            check_same(&a[1], i, &a[0], i);
        }
        answers_close(&a[0]);
        answers_close(&a[1]);
        bundle_close(&b);
    }
}
#endif

static void prove_all(void)
{
    PROVE(in_the_plane_a_batch_says_what_single_calls_say);
    PROVE(on_the_sphere_a_batch_says_what_single_calls_say);
    PROVE(on_embedded_surfaces_a_batch_says_what_single_calls_say);
    PROVE(every_number_of_corners_is_measured_alike);
    if (on_trial >= KERNELS || KERNELS == INSTANCES) PROVE(a_flower_of_a_million_corners_keeps_its_digits);
    PROVE(an_outline_has_the_same_bits_wherever_it_stands);
    PROVE(among_refused_ones_an_outline_has_the_same_bits);
    PROVE(scratch_changes_no_bit);
    PROVE(what_is_not_asked_for_changes_no_bit_of_the_rest);
#ifdef _OPENMP
    PROVE(any_number_of_threads_gives_the_same_bits);
#endif
    PROVE(a_refused_outline_is_untouched_and_others_do_not_notice);
    PROVE(a_bad_rank_or_radius_refuses_all);
    PROVE(no_outlines_are_none_refused_and_nothing_written);
    PROVE(corners_before_the_first_offset_are_not_looked_at);
    PROVE(offsets_that_fall_are_a_bad_argument);
    PROVE(outlines_that_end_after_the_last_offset_are_a_bad_argument);
    PROVE(the_reference_sets_come_out_of_batches);
    PROVE(contours_of_a_random_field_come_out_of_a_batch);
    PROVE(powers_of_two_scale_exactly);
    PROVE(regular_polygons_have_mu_one_at_multiples_of_n);
    PROVE(a_plane_in_space_is_the_plane);
    PROVE(the_sphere_is_an_embedded_surface_up_to_lengths);
#ifdef SURFMINK__NATIVE
    if (on_trial != SCALAR) PROVE(kernels_measure_flowers_and_small_polygons_themselves);
#endif
    PROVE(a_normal_counts_by_its_direction_however_long_it_is);
    PROVE(tiny_normals_beside_long_edges_keep_their_digits);
    PROVE(a_whisker_turns_by_plus_pi_wherever_it_stands);
}

int main(void)
{
    for (on_trial = 0; on_trial < INSTANCES; ++on_trial)
        if (can_run(on_trial))
            prove_all();
        else
            NOTE("%s: not for this machine", instance_name(on_trial));
    PROVE(outlines_without_corners_need_no_place_for_them);
#ifdef SURFMINK__DISPATCHES
    PROVE(a_processor_gets_the_widest_instance_that_it_can_run);
    PROVE(avx2_and_avx512_agree_to_the_bit);
#endif
    return QED();
}
