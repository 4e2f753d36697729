/* playground.c - what docs/playground.html computes: an outline on a plane, sphere, ellipsoid or torus -> surfmink.h

   The page writes corners into playground_corner(), calls playground_measure() and reads arrays: nothing is copied and
   nothing allocated. `make playground` compiles this file to WebAssembly that imports nothing (freestanding/math.h says
   why); tests/check/playground.c compiles it natively and prints the same arrays, to be compared.

   Edges. In the plane straight lines, on the sphere great circles: the corners are measured as they are. On ellipsoid
   and torus the shortest geodesics (examples/surfaces/implicit.h), each cut into an odd number of pieces of at most
   PIECE: the chords of these pieces are measured, with the exact normals at their ends. So what is drawn, what is
   measured, and what the page hands to the command line are the same points.
   A table of corners with normals is a surface of its own, of which nothing else is known: edges are chords.

   Order. Edge 0 of what is measured is the edge `base`, or the piece in its middle: all directions are read there. */
#define SURFMINK_STATIC
#include "surfmink.h"
#include "examples/surfaces/ellipsoid.h"
#include "examples/surfaces/torus.h"

#ifdef __wasm__
#define EXPORT(name) __attribute__((export_name(#name)))
#else
#define EXPORT(name) static inline
#endif

#define PIECE 0.02 /* surfaces of the page have sizes near 1 */

enum { CORNERS = 1024, PIECES = 201, POINTS = 32768, RANK = 12 };
enum { PLANE, SPHERE, ELLIPSOID, TORUS, EMBEDDED }; /* as in engine.js */

/* Not of surfmink_status: a closed curve of the torus that bounds nothing; more than POINTS pieces. */
enum { WINDS = 100, TOO_LONG };

static double corner[3 * CORNERS]; /* x y z each; z = 0 in the plane */
static double given[3 * CORNERS];  /* EMBEDDED: a normal at each corner */
static double shape[3];            /* ellipsoid: three semi-axes; torus: two radii */

/* The outline as it is drawn: points with unit normals, each of the edge edge_of[], from the middle of the base. */
static double point[3 * POINTS], normal[3 * POINTS];
static int edge_of[POINTS];
static size_t points;

/* The outline as it is measured: its corners (two numbers each in the plane), or the points above. */
static double measured[3 * POINTS], length[POINTS], turning[POINTS], phase[POINTS], parallel[POINTS];
static size_t count;

/* What comes out, in the order of page.js. The last two are one arrow an edge, the sum of its transported co-normals as
   seen from the co-normal of the base: x y. Classical transport splits the base edge in two. */
typedef struct results {
    double bad, other; /* edges to blame, or -1 */
    double mu[RANK + 1], classical[RANK + 1];
    double theta[RANK + 1], theta_classical[RANK + 1];
    double area, length, turning, curvature, condition;
    double base[12];               /* point, co-normal, tangent, normal */
    double centre[6];              /* point, normal */
    double director[3 * RANK + 3]; /* of each rank, at the centre */
    double arrow[2 * CORNERS], arrow_classical[2 * CORNERS + 2];
    double foot[9 * CORNERS]; /* of each edge: its middle, co-normal and normal there */
} results;
static results result;

EXPORT(playground_corner) double *playground_corner(void)
{
    return corner;
}

EXPORT(playground_given) double *playground_given(void)
{
    return given;
}

EXPORT(playground_shape) double *playground_shape(void)
{
    return shape;
}

EXPORT(playground_result) const double *playground_result(void)
{
    return (const double *)&result;
}

EXPORT(playground_point) const double *playground_point(void)
{
    return point;
}

EXPORT(playground_normal) const double *playground_normal(void)
{
    return normal;
}

EXPORT(playground_edge_of) const int *playground_edge_of(void)
{
    return edge_of;
}

EXPORT(playground_points) int playground_points(void)
{
    return (int)points;
}

EXPORT(playground_measured) const double *playground_measured(void)
{
    return measured;
}

EXPORT(playground_count) int playground_count(void)
{
    return (int)count;
}

EXPORT(playground_corners) int playground_corners(void)
{
    return CORNERS;
}

EXPORT(playground_strerror) const char *playground_strerror(int status)
{
    if (status == WINDS) return "the outline winds round the torus and encloses no part of it";
    return status == TOO_LONG ? "the outline is too long for this page" : surfmink_strerror(status);
}

EXPORT(playground_status_name) const char *playground_status_name(int status)
{
    if (status == WINDS) return "winds";
    return status == TOO_LONG ? "too_long" : surfmink_status_name(status);
}

/* --- the surfaces ------------------------------------------------------------------------------------------------- */

static int plane_log(void *context, const double *x, const double *y, double *way, double direction[2])
{
    (void)context;
    direction[0] = y[0] - x[0];
    direction[1] = y[1] - x[1];
    *way = hypot(direction[0], direction[1]);
    return *way > 0 ? SURFMINK_OK : SURFMINK_COINCIDENT_CORNERS;
}

static int plane_exp(void *context, const double *x, const double direction[2], double way, double *y)
{
    (void)context;
    y[0] = x[0] + way * direction[0];
    y[1] = x[1] + way * direction[1];
    y[2] = 0;
    return SURFMINK_OK;
}

static surfmink_surface surface_of(int kind, surfmink_implicit *implicit, double *radius)
{
    surfmink_surface plane;
    *radius = 1;
    if (kind == SPHERE) return surfmink_sphere_surface(radius);
    if (kind == ELLIPSOID || kind == TORUS) {
        *implicit = kind == TORUS ? surfmink_torus(shape) : surfmink_ellipsoid(shape);
        return surfmink_implicit_surface(implicit);
    }
    plane.context = NULL;
    plane.stride = 3;
    plane.log = plane_log;
    plane.exp = plane_exp;
    return plane;
}

/* The outline that is measured. */
static surfmink_outline outline_of(int kind)
{
    if (kind == PLANE) return surfmink_plane(measured, count);
    return kind == SPHERE ? surfmink_sphere(measured, count, 1) : surfmink_embedded(measured, normal, count);
}

static void normal_at(int kind, const surfmink_implicit *implicit, const double *x, double *n)
{
    double size;
    int k;
    n[0] = n[1] = 0;
    n[2] = 1;
    if (kind == SPHERE || kind == EMBEDDED) /* of EMBEDDED x is the normal itself */
        for (size = implicit__norm(x), k = 0; k < 3; ++k) n[k] = size > 0 ? x[k] / size : 0;
    else if (kind != PLANE)
        surfmink_implicit_normal(implicit, x, n);
}

/* Puts a point onto the surface. Returns 0 if it lies where no way leads there. */
EXPORT(playground_project) int playground_project(int kind, int i)
{
    surfmink_implicit implicit;
    double radius, size, *x = corner + 3 * i;
    int k;
    surface_of(kind, &implicit, &radius);
    if (kind == EMBEDDED) return 1;
    if (kind == PLANE) {
        x[2] = 0;
        return 1;
    }
    if (kind == SPHERE) {
        size = implicit__norm(x);
        if (!(size > 0)) return 0;
        for (k = 0; k < 3; ++k) x[k] /= size;
        return 1;
    }
    return surfmink_implicit_project(&implicit, x, x) == SURFMINK_OK;
}

/* n corners at a distance from the point that is corner 0 now, the first in the direction `angle`. Returns a status. */
EXPORT(playground_regular) int playground_regular(int kind, int n, double distance, double angle)
{
    surfmink_implicit implicit;
    double radius, centre[3] = {corner[0], corner[1], corner[2]};
    surfmink_surface surface = surface_of(kind, &implicit, &radius);
    if (n > CORNERS) return SURFMINK_BAD_ARGUMENT;
    return surfmink_regular_polygon(&surface, centre, distance, angle, (size_t)n, corner);
}

/* --- the edges ---------------------------------------------------------------------------------------------------- */

/* An edge that was traced before: while one corner is dragged, all edges but two stay. */
typedef struct trace {
    int kind;
    double from[3], to[3], shape[3];
    size_t pieces;
    double point[3 * PIECES];
} trace;
static trace traced[CORNERS];

static int same(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* The points of an edge, in traced[i]. */
static int trace_edge(int kind, const surfmink_surface *surface, int i, const double *x, const double *y)
{
    trace *t = traced + i;
    double way, direction[2];
    int k, status;
    if (kind == EMBEDDED) {
        for (k = 0; k < 3; ++k) t->point[k] = x[k];
        t->kind = kind;
        t->pieces = 1;
        return SURFMINK_OK;
    }
    if (t->pieces > 0 && t->kind == kind && same(t->from, x) && same(t->to, y) && same(t->shape, shape))
        return SURFMINK_OK;
    t->pieces = 0;
    status = surface->log(surface->context, x, y, &way, direction);
    if (status != SURFMINK_OK) return status;
    if (!(way < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    t->pieces = way < PIECES * PIECE ? (size_t)ceil(way / PIECE) | 1 : PIECES;
    if (kind == PLANE) t->pieces = 1;
    status = surfmink_edge_points(surface, x, y, t->pieces, t->point);
    if (status != SURFMINK_OK) t->pieces = 0;
    t->kind = kind;
    for (k = 0; k < 3; ++k) {
        t->from[k] = x[k];
        t->to[k] = y[k];
        t->shape[k] = shape[k];
    }
    return status;
}

static void add_points(int kind, const surfmink_implicit *implicit, int i, size_t from, size_t to)
{
    size_t j;
    int k;
    for (j = from; j < to; ++j, ++points) {
        for (k = 0; k < 3; ++k) point[3 * points + (size_t)k] = traced[i].point[3 * j + (size_t)k];
        normal_at(kind, implicit, kind == EMBEDDED ? given + 3 * i : point + 3 * points, normal + 3 * points);
        edge_of[points] = i;
    }
}

/* All edges, from the middle piece of the base edge round to the piece before it. An edge that cannot be traced leaves
   a gap in the drawing, and its status. */
static int trace_outline(int kind, const surfmink_surface *surface, const surfmink_implicit *implicit, int n, int base)
{
    int i, e, status, first = SURFMINK_OK;
    size_t total = 0;
    points = 0;
    for (i = 0; i < n; ++i) {
        status = trace_edge(kind, surface, i, corner + 3 * i, corner + 3 * ((i + 1) % n));
        if (status != SURFMINK_OK && first == SURFMINK_OK) {
            first = status;
            result.bad = i;
        }
        total += traced[i].pieces;
    }
    if (total > POINTS) return TOO_LONG;
    for (i = 0; i < n; ++i) {
        e = (base + i) % n;
        add_points(kind, implicit, e, i == 0 ? traced[e].pieces / 2 : 0, traced[e].pieces);
    }
    add_points(kind, implicit, base, 0, traced[base].pieces / 2);
    return first;
}

/* --- does it cross itself? ---------------------------------------------------------------------------------------- */

/* What surfmink_measure cannot tell on ellipsoid and torus, and not always elsewhere: two loops, one to each side,
   leave S and the area as they should be. Here every segment is held against every other.
   In flat coordinates (plane, and on the torus the angles, unwrapped): two segments cross if the ends of each lie on
   both sides of the other. On the sphere, and on the ellipsoid scaled to it, so do arcs. A table with normals is seen
   along their mean, unless one of them is more than 60 degrees off it: from there it may fold over what does not. */
static double flat[2 * POINTS];

/* Whatever crosses, lies within the circles about both: only so are the signs below more than rounding, where segments
   follow each other on a line. */
static int near_each_other(const double *a, const double *b, const double *c, const double *d, int dimensions)
{
    double one = 0, other = 0, apart = 0;
    int k;
    for (k = 0; k < dimensions; ++k) {
        one += (b[k] - a[k]) * (b[k] - a[k]);
        other += (d[k] - c[k]) * (d[k] - c[k]);
        apart += (a[k] + b[k] - c[k] - d[k]) * (a[k] + b[k] - c[k] - d[k]);
    }
    if (apart > 2.5 * (one + other)) return 0; /* (x + y)^2 <= 2 (x^2 + y^2): most pairs need no root */
    return sqrt(apart) <= sqrt(one) + sqrt(other);
}

static double side(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double round_turns(double angle)
{
    return 6.28318530717958647693 * floor(angle / 6.28318530717958647693 + 0.5);
}

/* Angles of the torus along the outline, without jumps. Returns a status: WINDS if they do not come back to where they
   began, CLOCKWISE if they go round the wrong way. */
static int unwrap(void)
{
    double x[2], way, area = 0;
    size_t i, j, k;
    for (i = 0; i <= points; ++i) {
        const double *p = point + 3 * (i % points);
        x[0] = atan2(p[1], p[0]);
        x[1] = atan2(p[2], hypot(p[0], p[1]) - shape[0]);
        for (k = 0; k < 2; ++k) {
            if (i > 0) x[k] -= round_turns(x[k] - flat[2 * (i - 1) + k]);
            way = x[k] - flat[k];
            if (i == points && (way > 1 || way < -1)) return WINDS;
            if (i < points) flat[2 * i + k] = x[k];
        }
    }
    for (i = 1; i + 1 < points; ++i) {
        j = i + 1;
        area += side(flat, flat + 2 * i, flat + 2 * j);
    }
    return area > 0 ? SURFMINK_OK : SURFMINK_CLOCKWISE;
}

static int flat_crossing(size_t i, size_t j, int periodic)
{
    const double *a = flat + 2 * i, *b = flat + 2 * ((i + 1) % points);
    double c[2], d[2], s, t;
    size_t k;
    for (k = 0; k < 2; ++k) {
        double turns = periodic ? round_turns(flat[2 * j + k] - a[k]) : 0;
        c[k] = flat[2 * j + k] - turns;
        d[k] = flat[2 * ((j + 1) % points) + k] - turns;
    }
    if (!near_each_other(a, b, c, d, 2)) return 0;
    s = side(a, b, c);
    t = side(a, b, d);
    if (!((s < 0 && t > 0) || (s > 0 && t < 0))) return 0;
    s = side(c, d, a);
    t = side(c, d, b);
    return (s < 0 && t > 0) || (s > 0 && t < 0);
}

static void arc_end(int kind, size_t i, double *x)
{
    int k;
    for (k = 0; k < 3; ++k) x[k] = point[3 * (i % points) + (size_t)k] / (kind == ELLIPSOID ? shape[k] : 1);
}

static int arcs_crossing(int kind, const double *a, const double *b, const double *ab, size_t j)
{
    double c[3], d[3], cd[3], s, t, u, v;
    arc_end(kind, j, c);
    arc_end(kind, j + 1, d);
    s = implicit__dot(ab, c);
    t = implicit__dot(ab, d);
    if (!((s < 0 && t > 0) || (s > 0 && t < 0)) || !near_each_other(a, b, c, d, 3)) return 0;
    implicit__cross(c, d, cd);
    u = implicit__dot(cd, a);
    v = implicit__dot(cd, b);
    /* and not one of the other's far side: around the crossing the four corners go a, c, b, d or back */
    return s > 0 ? u < 0 && v > 0 : u > 0 && v < 0;
}

/* Unit sum of the normals at the points; 0 0 0 if they cancel. */
static void mean_normal(double *N)
{
    double size;
    size_t i, k;
    N[0] = N[1] = N[2] = 0;
    for (i = 0; i < points; ++i)
        for (k = 0; k < 3; ++k) N[k] += normal[3 * i + k];
    size = implicit__norm(N);
    for (k = 0; k < 3; ++k) N[k] = size > 1e-6 * (double)points ? N[k] / size : 0;
}

/* Flat coordinates along the mean normal. Returns 0 if the outline may fold there. */
static int flatten(void)
{
    double N[3], across[3], along[3], size;
    size_t i, k;
    mean_normal(N);
    for (i = 0; i < points; ++i)
        if (!(implicit__dot(normal + 3 * i, N) > 0.5)) return 0; /* 60 degrees */
    for (k = 0; k < 3; ++k) across[k] = 0;
    across[fabs(N[0]) < 0.6 ? 0 : 1] = 1;
    implicit__cross(N, across, along);
    size = implicit__norm(along);
    for (k = 0; k < 3; ++k) along[k] /= size;
    implicit__cross(along, N, across);
    for (i = 0; i < points; ++i) {
        double d[3]; /* corners far from the origin keep their digits */
        for (k = 0; k < 3; ++k) d[k] = point[3 * i + k] - point[k];
        flat[2 * i] = implicit__dot(d, across);
        flat[2 * i + 1] = implicit__dot(d, along);
    }
    return 1;
}

/* Names in result.bad and result.other the edges of the first crossing. */
static int crosses(int kind)
{
    double a[3] = {0, 0, 0}, b[3] = {0, 0, 0}, ab[3] = {0, 0, 0};
    size_t i, j;
    if (kind == EMBEDDED && !flatten()) return 0;
    for (i = 0; i < points && kind == PLANE; ++i) {
        flat[2 * i] = point[3 * i];
        flat[2 * i + 1] = point[3 * i + 1];
    }
    for (i = 0; i + 2 < points; ++i) {
        if (kind == SPHERE || kind == ELLIPSOID) {
            arc_end(kind, i, a);
            arc_end(kind, i + 1, b);
            implicit__cross(a, b, ab);
        }
        for (j = i + 2; j < points - (i == 0); ++j) {
            int is_arc = kind == SPHERE || kind == ELLIPSOID;
            if (!(is_arc ? arcs_crossing(kind, a, b, ab, j) : flat_crossing(i, j, kind == TORUS))) continue;
            result.bad = edge_of[i];
            result.other = edge_of[j];
            return 1;
        }
    }
    return 0;
}

/* --- what is drawn of the results --------------------------------------------------------------------------------- */

static int is_chord(int kind)
{
    return kind == ELLIPSOID || kind == TORUS || kind == EMBEDDED;
}

static void add_arrow(double *arrow, double size, double angle)
{
    arrow[0] += size * cos(angle);
    arrow[1] += size * sin(angle);
}

/* The co-normal of each edge, carried to the base by both transports. */
static void find_arrows(int kind, int n, int base)
{
    double *late = result.arrow_classical + 2 * n, all = 0; /* late: the part of the base edge that comes last */
    size_t i, e, last = count - (is_chord(kind) ? traced[base].pieces / 2 : 0);
    for (i = 0; i < count; ++i) all += turning[i];
    for (i = 0; i < count; ++i) {
        e = is_chord(kind) ? (size_t)edge_of[i] : ((size_t)base + i) % (size_t)n;
        add_arrow(result.arrow + 2 * e, length[i], phase[i]);
        if (i == 0) {
            add_arrow(result.arrow_classical + 2 * e, length[i] / 2, 0);
            add_arrow(late, length[i] / 2, all);
        } else {
            add_arrow(i < last ? result.arrow_classical + 2 * e : late, length[i], parallel[i]);
        }
    }
}

/* Co-normals of all edges in their middles, and the frame of the base. */
static int find_feet(int n, int base)
{
    surfmink_outline drawn = surfmink_embedded(point, normal, points);
    double frame[9];
    size_t piece = 0, next;
    int i, k, e, status;
    for (i = 0; i < n; ++i) {
        e = (base + i) % n;
        if (i > 0) piece += traced[e].pieces / 2;
        status = surfmink_frame(&drawn, piece, frame);
        if (status != SURFMINK_OK) return status;
        next = (piece + 1) % points;
        for (k = 0; k < 3; ++k) {
            result.foot[9 * e + k] = (point[3 * piece + (size_t)k] + point[3 * next + (size_t)k]) / 2;
            result.foot[9 * e + 3 + k] = frame[k];
            result.foot[9 * e + 6 + k] = frame[6 + k];
        }
        for (k = 0; k < 12 && i == 0; ++k) result.base[k] = k < 3 ? result.foot[9 * e + k] : frame[k - 3];
        piece += traced[e].pieces - traced[e].pieces / 2;
    }
    return SURFMINK_OK;
}

/* The middle of the outline, on the surface if that is known. */
static int find_centre(int kind, const surfmink_implicit *implicit)
{
    double *x = result.centre, size;
    size_t i, j, k;
    double total = 0;
    for (i = 0; i < points; ++i) {
        double d[3];
        j = (i + 1) % points;
        for (k = 0; k < 3; ++k) d[k] = point[3 * j + k] - point[3 * i + k];
        size = implicit__norm(d);
        total += size;
        for (k = 0; k < 3; ++k) x[k] += size * (point[3 * i + k] + point[3 * j + k]) / 2;
    }
    for (k = 0; k < 3; ++k) x[k] /= total;
    size = kind == SPHERE ? implicit__norm(x) : 1;
    if (!(size > 1e-6)) return SURFMINK_ZERO_NORMAL;
    for (k = 0; k < 3; ++k) x[k] /= size;
    if (kind == EMBEDDED) {
        mean_normal(x + 3);
        return implicit__norm(x + 3) > 0 ? SURFMINK_OK : SURFMINK_ZERO_NORMAL;
    }
    if (is_chord(kind)) {
        int status = surfmink_implicit_project(implicit, x, x);
        if (status != SURFMINK_OK) return status;
    }
    normal_at(kind, implicit, x, x + 3);
    return SURFMINK_OK;
}

/* Carries a tangent vector from where the normal is n to where it is N, by the smallest rotation between the two. */
static void tilt(double *v, const double *n, const double *N)
{
    double part = implicit__dot(v, N) / (1 + implicit__dot(n, N));
    int k;
    for (k = 0; k < 3; ++k) v[k] -= part * (n[k] + N[k]);
}

/* Directions at the centre: the eigenvectors of every edge, tilted there by the smallest rotation between the normals,
   differ a little; this is their mean, as in the pictures of the command. Tilted, the co-normal of a piece stands at
   the angle a; so that is where the phase f would be read, and the mean is that of exp(i p (a - f)). */
static void find_directors(int kind, int n, int base)
{
    const surfmink_outline drawn = surfmink_embedded(point, normal, points);
    const double *N = result.centre + 3;
    double sum[2 * RANK + 2] = {0}, frame[9], e1[3], e2[3], turn[2], power[2], tilted[3], angle, size;
    size_t i, k, edge;
    int p;
    for (k = 0; k < 3; ++k) e1[k] = result.base[3 + k];
    tilt(e1, result.base + 9, N);
    implicit__cross(N, e1, e2);
    for (i = 0; i < points; ++i) {
        if (surfmink_frame(&drawn, i, frame) != SURFMINK_OK) continue;
        if (!(1 + implicit__dot(frame + 6, N) > 1e-6)) continue; /* opposite: no smallest rotation */
        for (k = 0; k < 3; ++k) tilted[k] = point[3 * ((i + 1) % points) + k] - point[3 * i + k];
        size = implicit__norm(tilted);
        for (k = 0; k < 3; ++k) tilted[k] = frame[k];
        tilt(tilted, frame + 6, N);
        edge = is_chord(kind) ? i : (size_t)((edge_of[i] - base + n) % n);
        angle = atan2(implicit__dot(tilted, e2), implicit__dot(tilted, e1)) - phase[edge];
        turn[0] = cos(angle);
        turn[1] = sin(angle);
        power[0] = size;
        power[1] = 0;
        for (p = 1; p <= RANK; ++p) {
            double re = power[0] * turn[0] - power[1] * turn[1];
            power[1] = power[0] * turn[1] + power[1] * turn[0];
            power[0] = re;
            sum[2 * p] += power[0];
            sum[2 * p + 1] += power[1];
        }
    }
    for (p = 1; p <= RANK; ++p) {
        angle = result.theta[p] + atan2(sum[2 * p + 1], sum[2 * p]) / p;
        for (k = 0; k < 3; ++k) result.director[3 * p + (int)k] = cos(angle) * e1[k] + sin(angle) * e2[k];
    }
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

static void clear_result(void)
{
    double *x = (double *)&result;
    size_t i;
    for (i = 0; i < sizeof result / sizeof *x; ++i) x[i] = 0;
    result.bad = result.other = -1;
}

/* Measures the outline of n corners. Returns a status of surfmink_status, or WINDS; then result.bad may name an edge or
   corner, and nothing else is there but the points to draw. */
EXPORT(playground_measure) int playground_measure(int kind, int n, int base)
{
    surfmink_implicit implicit;
    surfmink_outline outline;
    surfmink_functionals w;
    double radius, g[2 * RANK + 2], mu[RANK + 1];
    surfmink_surface surface = surface_of(kind, &implicit, &radius);
    size_t i, bad = 0, stride = kind == PLANE ? 2 : 3;
    int p, status, winds = SURFMINK_OK;
    clear_result();
    points = count = 0;
    if (n < 3) return SURFMINK_TOO_FEW_CORNERS;
    if (n > CORNERS || base < 0 || base >= n) return SURFMINK_BAD_ARGUMENT;
    status = trace_outline(kind, &surface, &implicit, n, base);
    if (status != SURFMINK_OK) return status;
    if (kind == TORUS) winds = unwrap();
    if (winds == WINDS) return WINDS;
    if (crosses(kind)) return SURFMINK_CROSSES_ITSELF;
    if (winds != SURFMINK_OK) return winds;

    count = is_chord(kind) ? points : (size_t)n;
    for (i = 0; i < stride * count; ++i)
        measured[i] = is_chord(kind) ? point[i] : corner[3 * (((size_t)base + i / stride) % (size_t)n) + i % stride];
    outline = outline_of(kind);
    status = surfmink_measure(&outline, RANK, mu, g, &w, &bad);
    if (status != SURFMINK_OK) {
        result.bad = bad >= count ? -1 : is_chord(kind) ? edge_of[bad] : (double)(((size_t)base + bad) % (size_t)n);
        return status;
    }
    status = surfmink_edges(&outline, length, turning, &bad);
    if (status != SURFMINK_OK) return status;
    result.area = w.area;
    result.length = w.length;
    result.turning = w.turning;
    result.curvature = w.curvature;
    result.condition = w.condition;
    for (p = 0; p <= RANK; ++p) result.mu[p] = mu[p];
    surfmink_spectrum(g, RANK, NULL, NULL, result.theta);
    surfmink_irreducible_parallel(length, turning, count, 0, 0.5, RANK, g);
    surfmink_spectrum(g, RANK, NULL, result.classical, result.theta_classical);
    surfmink_phases(turning, count, SURFMINK_CORRECTED, phase);
    surfmink_phases(turning, count, SURFMINK_PARALLEL, parallel);
    find_arrows(kind, n, base);
    status = find_feet(n, base);
    if (status != SURFMINK_OK) return status;
    if (find_centre(kind, &implicit) == SURFMINK_OK) find_directors(kind, n, base);
    return SURFMINK_OK;
}
