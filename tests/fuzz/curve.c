/* curve.c - fuzzes what measures smooth curves: of all surfaces, from edges, from hostile callbacks; and bends. */
#include "outline.h"

#include "../../examples/beyond/curve.h"

static double scratch[SURFMINK_CURVE_SCRATCH(CORNERS, RANK)];

typedef struct result {
    double mu[RANK + 1], error[RANK + 1], g[2 * RANK + 2];
    surfmink_functionals w;
    size_t bad;
} result;

static surfmink_curve_results results_of(result *r)
{
    surfmink_curve_results out;
    out.mu = r->mu;
    out.error = r->error;
    out.g = r->g;
    out.w = &r->w;
    memset(r, 0x5a, sizeof *r);
    return out;
}

static int measure_curve(const outline *o, const unsigned char *sharp, int order, result *r)
{
    surfmink_curve_options options = {0, NULL, 0, NULL};
    surfmink_curve_results out = results_of(r);
    surfmink_outline view = view_of(o);
    options.order = order;
    options.sharp = sharp;
    return surfmink_curve(&view, &options, RANK, scratch, &out, &r->bad);
}

static int is_known_of_curves(int status)
{
    return is_known(status) || status == SURFMINK_CURVE_UNLIKE_EDGES;
}

/* What has to hold by itself. */
static void claim_sound(int status, result *r, size_t n)
{
    result untouched;
    int p;
    memset(&untouched, 0x5a, sizeof untouched);
    CLAIM(is_known_of_curves(status));
    if (status != SURFMINK_OK) {
        CLAIM(r->bad <= n);
        r->bad = untouched.bad;
        CLAIM(same_bits(r, &untouched, sizeof untouched));
        return;
    }
    CLAIM(r->bad == untouched.bad);
    CLAIM(all_finite(r->g, 2 * RANK + 2) && all_finite(r->error, RANK + 1));
    CLAIM(isfinite(r->w.area) && isfinite(r->w.length) && isfinite(r->w.turning) && isfinite(r->w.curvature));
    CLAIM(r->w.length > 0 && r->w.turning > 0 && r->w.condition >= 1);
    CLAIM(r->error[0] >= 0 && r->error[0] <= 1 && r->mu[0] == 1);
    for (p = 1; p <= RANK; ++p) CLAIM(r->mu[p] >= 0 && r->mu[p] <= 1 && r->error[p] >= 0 && r->error[p] <= 1);
}

/* Order 2 is the polygon, to the bit. */
static void claim_polygon(const outline *o, int status, const result *r)
{
    measured m;
    CLAIM(measure_outline(o, &m) == status);
    if (status != SURFMINK_OK) return;
    CLAIM(same_bits(m.mu, r->mu, sizeof m.mu) && same_bits(m.g, r->g, sizeof m.g));
    CLAIM(same_bits(&m.w, &r->w, sizeof m.w));
}

/* How much longer is the longest edge than the shortest? */
static double unlike(const outline *o)
{
    measured m;
    double least = HUGE_VAL, most = 0;
    size_t i;
    if (!measure_twice(o, &m)) return HUGE_VAL;
    if (has_spike(o, &m)) return HUGE_VAL;
    for (i = 0; i < o->n; ++i) {
        least = fmin(least, m.length[i]);
        most = fmax(most, m.length[i]);
    }
    return least > 0 ? most / least : HUGE_VAL;
}

/* Another corner first: the same mu, L and S. */
static void claim_relabelled(const outline *o, const unsigned char *sharp, int order, size_t by, int status,
                             const result *r)
{
    outline other = *o;
    unsigned char moved[CORNERS];
    result b;
    double c, loose;
    size_t i;
    int p, again;
    if (o->n < 3 || !is_tame(o->corner, dim_of(o) * o->n) || !is_tame(o->normal, 3 * o->n) || !(unlike(o) < 1e3))
        return;
    relabel(&other, by % o->n);
    for (i = 0; i < o->n; ++i) moved[i] = sharp[(i + by) % o->n];
    again = measure_curve(&other, moved, order, &b);
    if (status != SURFMINK_OK || again != SURFMINK_OK) {
        CLAIM(status != SURFMINK_OK || r->w.condition > 1e6 || status == again);
        return;
    }
    c = r->w.condition + fabs(r->w.curvature) / r->w.turning;
    loose = 1e-9 * (1 + c) * (1 + c);
    if (!(loose < 0.01)) return;
    CLAIM(fabs(r->w.length - b.w.length) <= 1e-9 * r->w.length);
    CLAIM(fabs(r->w.turning - b.w.turning) <= loose * r->w.turning);
    for (p = 0; p <= RANK; ++p) CLAIM(fabs(r->mu[p] - b.mu[p]) <= loose);
}

/* Another unit, a power of two: the same bits. */
static void claim_unit(const outline *o, const unsigned char *sharp, int order, int status, const result *r, double by)
{
    outline other = *o;
    result b;
    if (!scale(&other, 1) || !scale(&other, by) || !(unlike(o) < 1e30)) return;
    CLAIM(measure_curve(&other, sharp, order, &b) == status);
    if (status != SURFMINK_OK) return;
    CLAIM(same_bits(r->mu, b.mu, sizeof b.mu) && same_bits(r->error, b.error, sizeof b.error));
}

/* The sphere by callbacks; K is some number. */
static void claim_by_callbacks(outline *o, const unsigned char *sharp, int order)
{
    surfmink_surface surface = surfmink_sphere_surface(&o->radius);
    surfmink_outline view = surfmink_on_surface(&surface, o->corner, o->n);
    surfmink_curve_options options = {0, NULL, 0, NULL};
    result r;
    surfmink_curve_results out = results_of(&r);
    options.order = order;
    options.sharp = sharp;
    options.curvature = o->normal[0];
    claim_sound(surfmink_curve(&view, &options, RANK, scratch, &out, &r.bad), &r, o->n);
}

static void on_a_surface(bytes *in, int order)
{
    unsigned char sharp[CORNERS];
    outline o;
    result r;
    size_t i;
    int status;
    take_outline(in, (enum surfmink_kind)(take(in) % 3), &o);
    for (i = 0; i < o.n; ++i) sharp[i] = take(in) < 64;
    status = measure_curve(&o, NULL, order, &r);
    claim_sound(status, &r, o.n);
    if (order == 2) claim_polygon(&o, status, &r);
    if (order != 2 && order != 4) CLAIM(status == SURFMINK_BAD_ARGUMENT);
    status = measure_curve(&o, sharp, order, &r);
    claim_sound(status, &r, o.n);
    claim_relabelled(&o, sharp, order, 1 + take(in), status, &r);
    claim_unit(&o, sharp, order, status, &r, 0x1p-40);
    claim_unit(&o, sharp, order, status, &r, 0x1p+101);
    if (o.kind == SURFMINK_SPHERE) claim_by_callbacks(&o, sharp, order);
}

/* --- edges and bends ---------------------------------------------------------------------------------------------- */

static void from_edges(bytes *in)
{
    double length[CORNERS], turning[CORNERS], bend[CORNERS], twist[CORNERS], curvature[CORNERS];
    unsigned char sharp[CORNERS];
    surfmink_curve_measured edges = {0, NULL, NULL, NULL, NULL, NULL, NULL};
    surfmink_curve_results out;
    result r;
    size_t n = take(in) % (CORNERS + 1), i;
    unsigned which = take(in);
    int status;
    edges.length = length;
    edges.turning = turning;
    for (i = 0; i < n; ++i) {
        length[i] = which & 1 ? take_number(in) : fabs(take_number(in));
        turning[i] = which & 2 ? take_number(in) : take_number(in) / 16;
        bend[i] = take_number(in) / (which & 4 ? 1 : 64);
        twist[i] = take_number(in) / (which & 4 ? 1 : 64);
        curvature[i] = take_number(in);
        sharp[i] = take(in) < 64;
    }
    edges.n = n;
    edges.bend = which & 8 ? bend : NULL;
    edges.twist = which & 16 ? twist : NULL;
    edges.curvature = which & 32 ? curvature : NULL;
    edges.sharp = which & 64 ? sharp : NULL;
    out = results_of(&r);
    status = surfmink_curve_edges(&edges, RANK, scratch, &out);
    if (status != SURFMINK_OK) {
        r.bad = n;
    } else {
        memset(r.error, 0, sizeof r.error); /* not measured edge by edge */
        CLAIM(!(which & 8) == !(which & 16));
    }
    claim_sound(status, &r, n);
}

static void bends(bytes *in)
{
    double bend[CORNERS], twist[CORNERS];
    size_t i, bad = CORNERS + 1;
    outline o;
    surfmink_outline view;
    int status;
    take_outline(in, SURFMINK_EMBEDDED, &o);
    memset(bend, 0x5a, sizeof bend);
    memset(twist, 0x5a, sizeof twist);
    view = view_of(&o);
    status = surfmink_curve_bends(&view, bend, twist, &bad);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) {
        CLAIM(bad <= o.n && is_untouched(bend, sizeof bend) && is_untouched(twist, sizeof twist));
        return;
    }
    for (i = 0; i < o.n; ++i) CLAIM(hypot(bend[i], twist[i]) <= 2 + 1e-14);
}

/* --- callbacks that say anything ---------------------------------------------------------------------------------- */

static int some_log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    bytes *in = (bytes *)context;
    unsigned status = take(in);
    (void)x;
    (void)y;
    *length = take_number(in);
    direction[0] = take_number(in);
    direction[1] = take_number(in);
    return status < 240 ? SURFMINK_OK : (int)status - 242;
}

static int some_curvature(void *context, const double *x, double *curvature)
{
    bytes *in = (bytes *)context;
    unsigned status = take(in);
    (void)x;
    *curvature = take_number(in);
    return status < 240 ? SURFMINK_OK : (int)status - 242;
}

static void by_callbacks(bytes *in, int order)
{
    double corner[2 * CORNERS] = {0};
    surfmink_surface surface;
    surfmink_outline view;
    surfmink_curve_options options = {0, NULL, 0, NULL};
    surfmink_curve_results out;
    result r;
    size_t n = take(in) % (CORNERS + 1);
    unsigned which = take(in);
    double constant = take_number(in);
    surface.context = in;
    surface.stride = which & 3 ? 2 : 0;
    surface.log = which & 12 ? some_log : NULL;
    surface.exp = NULL;
    options.order = order;
    options.curvature = constant;
    options.curvature_at = which & 16 ? some_curvature : NULL;
    view = surfmink_on_surface(&surface, corner, n);
    out = results_of(&r);
    claim_sound(surfmink_curve(&view, &options, RANK, scratch, &out, &r.bad), &r, n);
}

static void fuzz(bytes in)
{
    unsigned which = take(&in);
    int order = which < 8 ? (int)which : which & 8 ? 2 : 4;
    switch (which % 8) {
    case 0: from_edges(&in); break;
    case 1: bends(&in); break;
    case 2: by_callbacks(&in, order); break;
    default: on_a_surface(&in, order);
    }
}
