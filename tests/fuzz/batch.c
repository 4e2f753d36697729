/* batch.c - fuzzes batches: many outlines of one surface in one call, against single calls and against themselves. */
#include "api.h"

enum { OUTLINES = 72, MOST_CORNERS = 2048, MOST_RANK = 20, RANKS = MOST_RANK + 1 };

/* --- outlines out of bytes ---------------------------------------------------------------------------------------- */

typedef struct bundle {
    enum surfmink_kind kind;
    int max_rank;
    size_t count, offset[OUTLINES + 1];
    double corner[3 * MOST_CORNERS], normal[3 * MOST_CORNERS], radius;
} bundle;

static size_t dim_of(const bundle *b)
{
    return b->kind == SURFMINK_PLANE ? 2 : 3;
}

static size_t corners_of(const bundle *b, size_t i)
{
    return b->offset[i + 1] - b->offset[i];
}

/* One more outline; fewer corners than asked for if there is no room for more. */
static size_t add_outline(bundle *b, size_t n)
{
    size_t left = MOST_CORNERS - b->offset[b->count];
    b->offset[b->count + 1] = b->offset[b->count] + (n < left ? n : left);
    return b->count++;
}

static void copy_outline(bundle *to, const bundle *from, size_t i)
{
    size_t n = corners_of(from, i), dim = dim_of(from), at;
    at = to->offset[add_outline(to, n)];
    n = to->offset[to->count] - at;
    memmove(to->corner + dim * at, from->corner + dim * from->offset[i], dim * n * sizeof(double));
    memmove(to->normal + 3 * at, from->normal + 3 * from->offset[i], 3 * n * sizeof(double));
}

/* Any numbers at all. */
static void take_numbers(bytes *in, bundle *b)
{
    size_t i = add_outline(b, take(in) % 13), k, dim = dim_of(b), end = b->offset[i + 1];
    for (k = dim * b->offset[i]; k < dim * end; ++k) b->corner[k] = take_number(in);
    for (k = 3 * b->offset[i]; k < 3 * end && b->kind == SURFMINK_EMBEDDED; ++k) b->normal[k] = take_number(in);
}

/* A point of a star, on the surface: a sphere about one of the axes, a saddle or a plane in space. */
static void put(bundle *b, size_t at, size_t axis, double bend, double x, double y)
{
    double *corner = b->corner + dim_of(b) * at, *normal = b->normal + 3 * at;
    if (b->kind == SURFMINK_PLANE) {
        corner[0] = x;
        corner[1] = y;
        return;
    }
    corner[axis] = x;
    corner[(axis + 1) % 3] = y;
    corner[(axis + 2) % 3] = b->kind == SURFMINK_SPHERE ? 1 : bend * (x * x - y * y);
    normal[axis] = -2 * bend * x;
    normal[(axis + 1) % 3] = 2 * bend * y;
    normal[(axis + 2) % 3] = 1;
}

/* Stars, of which most can be measured; their sides are cut in pieces, so that there are long ones. */
static void take_star(bytes *in, bundle *b)
{
    size_t n = 3 + take(in) % 18, pieces = take(in) % 8, i, k, axis = take(in) % 3, at;
    double size = ldexp(1, -(int)(take(in) % 32)), bend = (take(in) / 256.0 - 0.5) / size, r[24], last;
    pieces = pieces == 7 ? 2 + take(in) % 30 : 1;
    for (i = 0; i < n; ++i) r[i] = size * (1 + take(in)) / 256;
    at = b->offset[add_outline(b, n * pieces)];
    for (i = 0; at < b->offset[b->count]; ++i) {
        double here = 6.283185307179586 * (double)i / (double)n, next = 6.283185307179586 * (double)(i + 1) / (double)n;
        last = r[(i + 1) % n];
        for (k = 0; k < pieces && at < b->offset[b->count]; ++k, ++at) {
            double t = (double)k / (double)pieces;
            put(b, at, axis, bend, (1 - t) * r[i] * cos(here) + t * last * cos(next),
                (1 - t) * r[i] * sin(here) + t * last * sin(next));
        }
    }
}

/* An outline that was there before: as it was, backwards, moved, or with another number in one place. */
static void take_again(bytes *in, bundle *b)
{
    size_t from = take(in) % (b->count + 1), how = take(in) % 4, i, k, n, dim = dim_of(b);
    double *corner;
    if (from == b->count) {
        add_outline(b, 0);
        return;
    }
    copy_outline(b, b, from);
    i = b->count - 1;
    n = corners_of(b, i);
    corner = b->corner + dim * b->offset[i];
    if (how == 1) surfmink_reverse(corner, n, dim);
    if (how == 1) surfmink_reverse(b->normal + 3 * b->offset[i], n, 3);
    for (k = 0; k < n && how == 2; ++k) corner[dim * k] += 1024;
    if (how == 3 && n > 0) corner[take(in) % (dim * n)] = take_number(in);
}

static void take_bundle(bytes *in, bundle *b)
{
    size_t count = take(in) % (OUTLINES + 1);
    unsigned how;
    memset(b, 0, sizeof *b);
    b->kind = (enum surfmink_kind)(take(in) % 3);
    b->max_rank = (int)(take(in) % (RANKS + 3)) - 1;
    if (b->max_rank > MOST_RANK) b->max_rank = 12;
    b->radius = take(in) < 16 ? take_number(in) : 1;
    while (b->count < count) {
        how = take(in);
        if (how < 80)
            take_numbers(in, b);
        else if (how < 176)
            take_star(in, b);
        else
            take_again(in, b);
    }
}

/* --- answers ------------------------------------------------------------------------------------------------------ */

enum { STATUS, BAD, LENGTH, TURNING, AREA, MU, G, THETA, OUTPUTS, EVERYTHING = (1 << OUTPUTS) - 1 };

/* What a batch writes, into arrays of exactly the right size, so that address sanitizers see who writes beyond. */
typedef struct answers {
    size_t refused, width[OUTPUTS]; /* bytes an outline */
    unsigned char *output[OUTPUTS];
    surfmink_results out;
} answers;

static void *exactly(size_t size)
{
    void *room = malloc(size);
    if (!room && size > 0) exit(2);
    if (room) memset(room, 0x5a, size);
    return room;
}

static void open_answers(answers *a, size_t count, int max_rank, unsigned asked)
{
    size_t ranks = (size_t)(max_rank + 1), k;
    for (k = 0; k < OUTPUTS; ++k) {
        a->width[k] = (k < MU ? 1 : k == G ? 2 * ranks : ranks) * sizeof(double);
        if (k == STATUS) a->width[k] = sizeof(int);
        if (k == BAD) a->width[k] = sizeof(size_t);
        a->output[k] = asked >> k & 1 ? (unsigned char *)exactly(count * a->width[k]) : NULL;
    }
    a->out.status = (int *)(void *)a->output[STATUS];
    a->out.bad = (size_t *)(void *)a->output[BAD];
    a->out.length = (double *)(void *)a->output[LENGTH];
    a->out.turning = (double *)(void *)a->output[TURNING];
    a->out.area = (double *)(void *)a->output[AREA];
    a->out.mu = (double *)(void *)a->output[MU];
    a->out.g = (double *)(void *)a->output[G];
    a->out.theta = (double *)(void *)a->output[THETA];
}

static void close_answers(answers *a)
{
    size_t k;
    for (k = 0; k < OUTPUTS; ++k) free(a->output[k]);
}

static double *exact_copy(const double *x, size_t count)
{
    double *copy = (double *)exactly(count * sizeof *x);
    if (copy) memcpy(copy, x, count * sizeof *x);
    return copy;
}

static surfmink_outline view_of(const bundle *b, const double *corner, const double *normal, size_t n)
{
    switch (b->kind) {
    case SURFMINK_PLANE: return surfmink_plane(corner, n);
    case SURFMINK_SPHERE: return surfmink_sphere(corner, n, b->radius);
    default: return surfmink_embedded(corner, normal, n);
    }
}

/* The outlines from `first` on; nothing may be read beyond the last of them. */
static void measure(const bundle *b, size_t first, size_t count, unsigned asked, int with_scratch, answers *a)
{
    const size_t *offset = b->offset + first;
    double *corner = exact_copy(b->corner, dim_of(b) * offset[count]),
           *normal = exact_copy(b->normal, 3 * offset[count]);
    double *scratch = with_scratch ? (double *)exactly(2 * offset[count] * sizeof(double)) : NULL;
    surfmink_outline all;
    open_answers(a, count, b->max_rank, asked);
    all = view_of(b, corner, normal, offset[count]);
    a->refused = surfmink_batch(&all, offset, count, b->max_rank, &a->out, scratch);
    if (scratch) CLAIM(is_untouched(scratch, 2 * offset[0] * sizeof(double)));
    free(corner);
    free(normal);
    free(scratch);
}

/* --- against single calls ----------------------------------------------------------------------------------------- */

typedef struct single {
    double mu[RANKS], g[2 * RANKS], theta[RANKS];
    double length[MOST_CORNERS], turning[MOST_CORNERS];
    surfmink_functionals w;
    size_t bad;
    int status, delicate;
} single;

/* Is it a matter of rounding what is wrong with an outline? A spike turns by pi, of no definite sign; S is next to
   nothing of what it is a sum of. */
static int is_delicate(const single *s, size_t n)
{
    double sum = 0, turned = 0;
    size_t i;
    for (i = 0; i < n; ++i) {
        if (fabs(s->turning[i]) > 3.141592653589) return 1;
        sum += s->turning[i];
        turned += fabs(s->turning[i]);
    }
    return fabs(sum) <= 1e-9 * turned;
}

static void measure_one(const bundle *b, size_t i, single *s)
{
    size_t n = corners_of(b, i), at = b->offset[i];
    surfmink_outline o = view_of(b, b->corner + dim_of(b) * at, b->normal + 3 * at, n);
    int edges = surfmink_edges(&o, s->length, s->turning, NULL);
    s->status = surfmink_measure(&o, b->max_rank, s->mu, s->g, &s->w, &s->bad);
    s->delicate = edges == SURFMINK_OK && is_delicate(s, n);
    if (s->status == SURFMINK_OK) CLAIM(surfmink_spectrum(s->g, b->max_rank, NULL, NULL, s->theta) == SURFMINK_OK);
}

/* No |x_i - x_0| is above L / 2: that bounds what an area may be wrong by. On the sphere large ones are 2 pi - S. */
static void claim_area(const bundle *b, const single *s, double area, double c)
{
    double l = s->w.length, terms = l / 2 * l / 2, unit = b->radius * b->radius;
    if (b->kind == SURFMINK_EMBEDDED) CLAIM(same_bits(&area, &s->w.area, sizeof area));
    if (b->kind == SURFMINK_SPHERE && l > b->radius) terms += c * s->w.turning * unit;
    CLAIM(fabs(area - s->w.area) <= 1e-14 * terms + DBL_MIN);
}

static void claim_close(const bundle *b, const answers *a, size_t i, const single *s)
{
    size_t ranks = (size_t)b->max_rank + 1, p;
    const double *mu = a->out.mu + ranks * i, *g = a->out.g + 2 * ranks * i, *theta = a->out.theta + ranks * i;
    double l = s->w.length, c = s->w.condition + fabs(s->w.curvature) / s->w.turning, loose, off;
    CLAIM(fabs(a->out.length[i] - l) <= 4e-15 * l && g[0] == a->out.length[i] && g[1] == 0);
    CLAIM(fabs(a->out.turning[i] - s->w.turning) <= 1e-14 * c * s->w.turning);
    claim_area(b, s, a->out.area[i], c);
    for (p = 0; p < ranks; ++p) {
        loose = 1e-13 * (1 + c) * (1 + c) * (p > 12 ? (double)p / 12 : 1);
        CLAIM(mu[p] >= 0 && mu[p] <= 1 + 4 * DBL_EPSILON);
        CLAIM(isfinite(g[2 * p]) && isfinite(g[2 * p + 1]));
        if (loose < 0.1) CLAIM(fabs(mu[p] - s->mu[p]) <= loose);
        if (!(l > 1e-290 && l < 1e307)) continue; /* components lose their digits, or have no directions */
        CLAIM(fabs(theta[p]) <= 3.1415926535897936);
        if (!(loose < 0.1)) continue;
        off = s->mu[p] * fabs(remainder((double)p * (theta[p] - s->theta[p]), 6.283185307179586));
        CLAIM(hypot((g[2 * p] - s->g[2 * p]) / l, (g[2 * p + 1] - s->g[2 * p + 1]) / l) <= loose);
        CLAIM(off <= loose);
    }
}

/* Refused outlines have a status and a blame and nothing else; others no blame. */
static void claim_untouched(const answers *a, size_t i)
{
    size_t k;
    for (k = BAD; k < OUTPUTS; ++k)
        if ((k == BAD) == (a->out.status[i] == SURFMINK_OK))
            CLAIM(is_untouched(a->output[k] + a->width[k] * i, a->width[k]));
}

static void claim_single(const bundle *b, const answers *a)
{
    static single s;
    size_t i, refused = 0;
    for (i = 0; i < b->count; ++i) {
        int status = a->out.status[i];
        CLAIM(is_known(status));
        claim_untouched(a, i);
        refused += status != SURFMINK_OK;
        measure_one(b, i, &s);
        if (s.delicate && status != s.status) continue;
        CLAIM(status == s.status);
        if (status == SURFMINK_OK)
            claim_close(b, a, i, &s);
        else
            CLAIM(a->out.bad[i] == s.bad);
    }
    CLAIM(a->refused == refused);
}

/* --- against itself ----------------------------------------------------------------------------------------------- */

static void claim_same(const answers *a, size_t i, const answers *b, size_t j)
{
    size_t k;
    for (k = 0; k < OUTPUTS; ++k)
        if (a->output[k] && b->output[k])
            CLAIM(same_bits(a->output[k] + a->width[k] * i, b->output[k] + a->width[k] * j, a->width[k]));
}

/* Alone, and with corners before it that are not its own. */
static void claim_alone(const bundle *b, const answers *all, int with_scratch)
{
    answers a;
    size_t i;
    for (i = 0; i < b->count; ++i) {
        measure(b, i, 1, EVERYTHING, with_scratch, &a);
        claim_same(&a, 0, all, i);
        close_answers(&a);
    }
}

static void claim_backwards(const bundle *b, const answers *all, unsigned asked)
{
    static bundle other;
    answers a;
    size_t i;
    memset(&other, 0, sizeof other);
    other.kind = b->kind;
    other.max_rank = b->max_rank;
    other.radius = b->radius;
    for (i = b->count; i > 0; --i) copy_outline(&other, b, i - 1);
    measure(&other, 0, other.count, asked, 0, &a);
    CLAIM(a.refused == all->refused);
    for (i = 0; i < b->count; ++i) claim_same(&a, b->count - 1 - i, all, i);
    close_answers(&a);
}

/* In another unit, a power of two, all outlines of sane numbers are the same to the last bit. */
static int is_sane(const double *x, size_t count)
{
    for (; count > 0; --count, ++x)
        if (!(fabs(*x) < 0x1p40) || (*x != 0 && !(fabs(*x) > 0x1p-60))) return 0;
    return 1;
}

static void claim_scaled(const bundle *b, const answers *all)
{
    static bundle other;
    const double unit = b->kind == SURFMINK_SPHERE ? 1 : 0x1p30;
    size_t i, k, dim = dim_of(b);
    answers a;
    other = *b;
    for (i = 0; i < dim * b->offset[b->count]; ++i) other.corner[i] *= 0x1p30;
    measure(&other, 0, other.count, EVERYTHING, 0, &a);
    for (i = 0; i < b->count; ++i) {
        if (!is_sane(b->corner + dim * b->offset[i], dim * corners_of(b, i))) continue;
        if (!is_sane(b->normal + 3 * b->offset[i], 3 * corners_of(b, i))) continue;
        CLAIM(a.out.status[i] == all->out.status[i]);
        if (a.out.status[i] != SURFMINK_OK) continue;
        CLAIM(a.out.length[i] == unit * all->out.length[i] && a.out.turning[i] == all->out.turning[i]);
        CLAIM(a.out.area[i] == unit * unit * all->out.area[i]);
        for (k = MU; k < OUTPUTS; ++k)
            if (k != G) CLAIM(same_bits(a.output[k] + a.width[k] * i, all->output[k] + a.width[k] * i, a.width[k]));
    }
    close_answers(&a);
}

static void fuzz(bytes in)
{
    static bundle b;
    answers all;
    unsigned asked = take(&in);
    take_bundle(&in, &b);
    measure(&b, 0, b.count, EVERYTHING, 1, &all);
    claim_single(&b, &all);
    claim_alone(&b, &all, asked % 2);
    claim_backwards(&b, &all, asked);
    if (all.out.mu) claim_scaled(&b, &all);
    close_answers(&all);
}
