/* implicit.h - geodesics on any smooth surface f = 0, for surfmink.h - MIT or public domain, as surfmink.h

   You give f with its gradient and Hessian; you get the exp and log of a surfmink_surface, normals and Gaussian
   curvature. ellipsoid.h and torus.h beside this file are two instances of a few lines each.

   QUICK START
     double axis[3] = {1.6, 1.3, 1.0};
     surfmink_implicit body = surfmink_ellipsoid(axis);                       // ellipsoid.h: f, gradient, Hessian
     surfmink_surface surface = surfmink_implicit_surface(&body);             // body and axis must outlive it
     surfmink_outline cell = surfmink_on_surface(&surface, corner, n);
     status = surfmink_measure(&cell, 6, mu, NULL, NULL, NULL);

   HOW IT WORKS
     A geodesic x(s) bends only along the normal:  x'' = -(x'.H x') / |grad f|^2 grad f  with H the Hessian of f.
     Along it the Jacobi field  m'' + K m = 0, m(0) = 0, m'(0) = 1  says how far the end moves across when the start
     turns: by m per radian. So log is Newton's method: shoot, split the miss into a part along the geodesic (what its
     length lacks) and a part across it (m times what its angle lacks), correct, shoot again.
     Steps are Gauss collocation of order 16 (8 nodes, solved by fixed-point sweeps), of a length that adapts.

   WHICH GEODESIC
     surfmink_implicit_log        the shortest one that it finds; what the callbacks use. Between near corners that
                                  is the shortest one. An edge longer than 1.3 of its chord is shot in 16 directions.
     surfmink_implicit_log_near   the one next to a first guess of yours (direction and length)
     surfmink_implicit_log_along  the one that a curve between the corners is pulled tight to: chooses a homotopy class

   CONVENTIONS
     Points are x y z, stride 3. f < 0 inside: its gradient is the outer normal. Nothing depends on the unit of length
     or on the size of f. Points off the surface are dropped onto it along the gradient before anything is measured.
     Directions have two components in the frame (e1, e2) of surfmink_implicit_frame, (e1, e2, normal) right-handed.

   ERRORS
     SURFMINK_COINCIDENT_CORNERS   the corners are the same point of the surface: no direction
     SURFMINK_ANTIPODAL_CORNERS    more than one shortest geodesic, or the geodesic passes a conjugate point (m <= 0
                                   on the way), beyond which it is not the shortest; also at m <= 1e-6 of its length,
                                   where the direction begins to be noise
     SURFMINK_CALLBACK_FAILED      no geodesic was found: Newton's method did not converge, as it cannot where K < 0
                                   makes m grow beyond 1e13, or log took 300 steps of about a radius of curvature,
                                   exp 30000
     SURFMINK_ZERO_NORMAL          grad f vanishes where a geodesic or the drop onto the surface came by
     SURFMINK_NOT_FINITE           a NaN or an infinity, given or from f
     On error outputs are untouched.

   ACCURACY (tests/test_surfaces.c)
     Against 50-digit geodesics on ellipsoids and tori: length 3e-16 relative, direction 4e-16. Against the same code in
     113-bit arithmetic, 2400 random pairs: length 6e-16 relative, direction 9e-16 (worst on ellipsoids of axes 1 : 10
     over half the body); edges of any size down to 1e-8 the same. Karney's distances on the Earth: to 1e-15.
     Where several geodesics compete, the shortest may be missed. Of 1000 random pairs, shooting from the other end
     finds another length in 0.1 % over half of ellipsoids of axes up to 1 : 10, in 3 % over the whole of them, and in
     8 % over the whole of a torus with a hole of a tenth; in none where edges are up to a radian of the chart. Use
     log_near or log_along where that matters.

   Every function is static inline: include this file wherever it is needed, there is nothing to link but libm.
   No allocation, no globals; about 3 KiB of stack. Include surfmink.h first, or have it on the include path.      */
#ifndef SURFMINK_IMPLICIT_H
#define SURFMINK_IMPLICIT_H

#ifndef SURFMINK_H
#include "surfmink.h"
#endif
#include <math.h>

/* The surface f = 0. shape is handed to f as it is.
   f           returns its value at x and writes its gradient and its Hessian, as xx xy xz yy yz zz.
   There must be no point with a zero gradient near the surface. */
typedef struct surfmink_implicit {
    double (*f)(const void *shape, const double x[3], double gradient[3], double hessian[6]);
    const void *shape;
} surfmink_implicit;

/* A curve on (or near) the surface: writes its point at t in [0, 1]. */
typedef void surfmink_implicit_path(const void *context, double t, double point[3]);

/* --- f and what follows from it at one point -------------------------------------------------------------------- */

static inline double implicit__dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double implicit__norm(const double *a)
{
    return sqrt(implicit__dot(a, a));
}

static inline void implicit__cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* v . H v */
static inline double implicit__quadratic(const double *h, const double *v)
{
    return h[0] * v[0] * v[0] + h[3] * v[1] * v[1] + h[5] * v[2] * v[2] +
           2 * (h[1] * v[0] * v[1] + h[2] * v[0] * v[2] + h[4] * v[1] * v[2]);
}

typedef struct implicit__jet {
    double value, gradient[3], hessian[6];
    double square; /* |gradient|^2 */
} implicit__jet;

static inline int implicit__look(const surfmink_implicit *surface, const double *x, implicit__jet *jet)
{
    jet->value = surface->f(surface->shape, x, jet->gradient, jet->hessian);
    jet->square = implicit__dot(jet->gradient, jet->gradient);
    if (!(fabs(jet->value) + jet->square < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    return jet->square > 0 ? SURFMINK_OK : SURFMINK_ZERO_NORMAL;
}

/* K = grad . adj(H) grad / |grad|^4 */
static inline double implicit__gauss(const implicit__jet *jet)
{
    const double *h = jet->hessian;
    double adjugate[6];
    adjugate[0] = h[3] * h[5] - h[4] * h[4];
    adjugate[1] = h[2] * h[4] - h[1] * h[5];
    adjugate[2] = h[1] * h[4] - h[2] * h[3];
    adjugate[3] = h[0] * h[5] - h[2] * h[2];
    adjugate[4] = h[1] * h[2] - h[0] * h[4];
    adjugate[5] = h[0] * h[3] - h[1] * h[1];
    return implicit__quadratic(adjugate, jet->gradient) / jet->square / jet->square;
}

/* The small way from x onto the surface along the gradient, by itself: added to x, its digits would be gone. */
static inline int implicit__drop(const surfmink_implicit *surface, const double *x, double *way)
{
    implicit__jet jet;
    double y[3], step = 0, size = implicit__norm(x);
    int round, k, status;
    for (k = 0; k < 3; ++k) way[k] = 0;
    if (!(size < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    for (round = 0; round < 50; ++round) {
        for (k = 0; k < 3; ++k) y[k] = x[k] + way[k];
        status = implicit__look(surface, y, &jet);
        if (status != SURFMINK_OK) return status;
        step = jet.value / jet.square;
        for (k = 0; k < 3; ++k) way[k] -= step * jet.gradient[k];
        if (fabs(step) * sqrt(jet.square) <= 1e-9 * size) return SURFMINK_OK; /* Newton: squared, that is rounding */
    }
    return SURFMINK_CALLBACK_FAILED;
}

/* The point of the surface that x lies over, along the gradient (for x near the surface: next to the nearest one).
   y           3      out; may be the same array as x                                                                */
static inline int surfmink_implicit_project(const surfmink_implicit *surface, const double x[3], double y[3])
{
    double way[3];
    int k, status = implicit__drop(surface, x, way);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) y[k] = x[k] + way[k];
    return SURFMINK_OK;
}

/* Outer unit normal at a point; for surfmink_embedded. */
static inline int surfmink_implicit_normal(const surfmink_implicit *surface, const double x[3], double normal[3])
{
    implicit__jet jet;
    int k, status = implicit__look(surface, x, &jet);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) normal[k] = jet.gradient[k] / sqrt(jet.square);
    return SURFMINK_OK;
}

/* Gaussian curvature at a point. */
static inline int surfmink_implicit_curvature(const surfmink_implicit *surface, const double x[3], double *curvature)
{
    implicit__jet jet;
    int status = implicit__look(surface, x, &jet);
    if (status != SURFMINK_OK) return status;
    *curvature = implicit__gauss(&jet);
    return SURFMINK_OK;
}

/* The frame that directions refer to: e1 = frame[0..2], e2 = [3..5], normal = [6..8]. e1 is at a right angle to the
   coordinate axis that is farthest from the normal. Depends on nothing but the point.                               */
static inline int surfmink_implicit_frame(const surfmink_implicit *surface, const double x[3], double frame[9])
{
    double axis[3] = {0, 0, 0}, e1[3], normal[3], size;
    int k, flat = 0, status = surfmink_implicit_normal(surface, x, normal);
    if (status != SURFMINK_OK) return status;
    for (k = 1; k < 3; ++k)
        if (fabs(normal[k]) < fabs(normal[flat])) flat = k;
    axis[flat] = 1;
    implicit__cross(axis, normal, e1);
    size = implicit__norm(e1);
    for (k = 0; k < 3; ++k) frame[k] = e1[k] / size;
    implicit__cross(normal, frame, frame + 3);
    for (k = 0; k < 3; ++k) frame[6 + k] = normal[k];
    return SURFMINK_OK;
}

/* --- shooting: a geodesic and its Jacobi field ------------------------------------------------------------------- */

#define IMPLICIT__NODES 8

typedef struct implicit__flow {
    const surfmink_implicit *surface;
    double origin[3]; /* positions count from here: short edges keep their digits */
    double step;      /* the step that was right last time, 0 if there was none */
    int most;         /* steps of a shot, so that a wrong Hessian cannot keep us for hours */
    double node[IMPLICIT__NODES], weight[IMPLICIT__NODES];
    double once[IMPLICIT__NODES][IMPLICIT__NODES];  /* accelerations -> velocities at the nodes */
    double twice[IMPLICIT__NODES][IMPLICIT__NODES]; /* accelerations -> positions at the nodes */
    double tail[2][IMPLICIT__NODES];                /* accelerations -> their last two Legendre coefficients */
} implicit__flow;

/* Where a geodesic ends: its position, velocity, and in [3] the Jacobi field, as if that were a fourth dimension. */
typedef struct implicit__end {
    double position[4], velocity[4], normal[3];
    int conjugate; /* the Jacobi field was not positive all the way */
} implicit__end;

/* Gauss-Legendre rule of 8 nodes on [0, 1]. Its integration matrices follow from the Legendre expansion of what is
   integrated, sum_k (2k+1) P_k(t) sum_j w_j P_k(t_j) a_j, and the integral (P_{k+1} - P_{k-1}) / (2k+1) of P_k. */
static inline void implicit__begin(implicit__flow *flow, const surfmink_implicit *surface, int most)
{
    static const double abscissa[4] = {.18343464249564980494, .52553240991632898582, .79666647741362673959,
                                       .96028985649753623168};
    static const double weight[4] = {.36268378337836198297, .31370664587788728734, .22238103445337447054,
                                     .10122853629037625915};
    double legendre[IMPLICIT__NODES][IMPLICIT__NODES + 1], sum;
    int i, j, k;
    flow->surface = surface;
    flow->step = 0;
    flow->most = most;
    for (i = 0; i < IMPLICIT__NODES; ++i) {
        double t = i < 4 ? -abscissa[3 - i] : abscissa[i - 4];
        flow->node[i] = (1 + t) / 2;
        flow->weight[i] = weight[i < 4 ? 3 - i : i - 4] / 2;
        legendre[i][0] = 1;
        legendre[i][1] = t;
        for (k = 1; k < IMPLICIT__NODES; ++k)
            legendre[i][k + 1] = ((2 * k + 1) * t * legendre[i][k] - k * legendre[i][k - 1]) / (k + 1);
    }
    for (j = 0; j < IMPLICIT__NODES; ++j) {
        for (i = 0; i < IMPLICIT__NODES; ++i) {
            for (sum = 2 * flow->node[i], k = 1; k < IMPLICIT__NODES; ++k)
                sum += legendre[j][k] * (legendre[i][k + 1] - legendre[i][k - 1]);
            flow->once[i][j] = flow->weight[j] / 2 * sum;
        }
        for (k = 0; k < 2; ++k)
            flow->tail[k][j] =
                (2 * (IMPLICIT__NODES - 1 - k) + 1) * flow->weight[j] * legendre[j][IMPLICIT__NODES - 1 - k];
    }
    for (i = 0; i < IMPLICIT__NODES; ++i)
        for (j = 0; j < IMPLICIT__NODES; ++j)
            for (flow->twice[i][j] = 0, k = 0; k < IMPLICIT__NODES; ++k)
                flow->twice[i][j] += flow->once[i][k] * flow->once[k][j];
}

static inline int implicit__bend(const implicit__flow *flow, const double *position, const double *velocity,
                                 double *acceleration)
{
    implicit__jet jet;
    double x[3], pull;
    int k, status;
    for (k = 0; k < 3; ++k) x[k] = flow->origin[k] + position[k];
    status = implicit__look(flow->surface, x, &jet);
    if (status != SURFMINK_OK) return status;
    pull = -implicit__quadratic(jet.hessian, velocity) / jet.square;
    for (k = 0; k < 3; ++k) acceleration[k] = pull * jet.gradient[k];
    acceleration[3] = -implicit__gauss(&jet) * position[3];
    return SURFMINK_OK;
}

/* One step of length h from *end. *error: the last Legendre coefficients of what was integrated, as a share of the
   velocity; HUGE_VAL if the sweeps do not converge. The error of the end point is about the square of that. */
static inline int implicit__step(const implicit__flow *flow, const implicit__end *end, double h, implicit__end *next,
                                 double *error)
{
    double a[IMPLICIT__NODES][4], old[4], q[4], v[4], start[4], scale = 1, change = HUGE_VAL, before;
    int i, j, k, sweep, status;
    *error = HUGE_VAL;
    *next = *end;
    if (fabs(end->velocity[3]) > 1) scale = fabs(end->velocity[3]); /* grows without bounds where K < 0 */
    status = implicit__bend(flow, end->position, end->velocity, start);
    if (status != SURFMINK_OK) return status;
    for (j = 0; j < IMPLICIT__NODES; ++j)
        for (k = 0; k < 4; ++k) a[j][k] = start[k];
    for (sweep = 0; sweep < 30; ++sweep) {
        before = change;
        change = 0;
        next->conjugate = end->conjugate;
        for (i = 0; i < IMPLICIT__NODES; ++i) {
            for (k = 0; k < 4; ++k) {
                double push = 0, shift = 0;
                for (j = 0; j < IMPLICIT__NODES; ++j) {
                    push += flow->once[i][j] * a[j][k];
                    shift += flow->twice[i][j] * a[j][k];
                }
                v[k] = end->velocity[k] + h * push;
                q[k] = end->position[k] + h * (flow->node[i] * end->velocity[k] + h * shift);
                old[k] = a[i][k];
            }
            status = implicit__bend(flow, q, v, a[i]);
            if (status != SURFMINK_OK) return SURFMINK_OK; /* far out, perhaps: try a shorter step */
            for (k = 0; k < 4; ++k) {
                double moved = h * fabs(a[i][k] - old[k]) / (k < 3 ? 1 : scale);
                if (!(moved <= change)) change = moved; /* a NaN moves, too */
            }
            if (!(q[3] > 0)) next->conjugate = 1;
        }
        if (!(change < 4)) return SURFMINK_OK;
        /* Below 1e-13 sweeps that bring no more are stopped by rounding, not by too long a step. */
        if (change < 1e-15 || (change < 1e-13 && change > before / 2)) break;
    }
    if (sweep == 30) return SURFMINK_OK;
    for (*error = 0, k = 0; k < 4; ++k) {
        double push = 0, shift = 0, tail[2] = {0, 0};
        for (j = 0; j < IMPLICIT__NODES; ++j) {
            push += flow->weight[j] * a[j][k];
            shift += flow->weight[j] * (1 - flow->node[j]) * a[j][k];
            for (i = 0; i < 2; ++i) tail[i] += flow->tail[i][j] * a[j][k];
        }
        next->velocity[k] = end->velocity[k] + h * push;
        next->position[k] = end->position[k] + h * (end->velocity[k] + h * shift);
        for (i = 0; i < 2; ++i)
            if (h * fabs(tail[i]) > *error * (k < 3 ? 1 : scale)) *error = h * fabs(tail[i]) / (k < 3 ? 1 : scale);
    }
    return SURFMINK_OK;
}

/* Rounding pushes the end off the surface and its velocity off the tangent plane: puts both back. */
static inline int implicit__settle(const implicit__flow *flow, implicit__end *end)
{
    implicit__jet jet;
    double x[3], off, size;
    int k, status;
    for (k = 0; k < 3; ++k) x[k] = flow->origin[k] + end->position[k];
    status = implicit__look(flow->surface, x, &jet);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) end->normal[k] = jet.gradient[k] / sqrt(jet.square);
    off = implicit__dot(end->velocity, end->normal);
    for (k = 0; k < 3; ++k) {
        end->position[k] -= jet.value / jet.square * jet.gradient[k];
        end->velocity[k] -= off * end->normal[k];
    }
    size = implicit__norm(end->velocity);
    if (!(size > 0)) return SURFMINK_NOT_FINITE;
    for (k = 0; k < 3; ++k) end->velocity[k] /= size;
    return SURFMINK_OK;
}

/* The geodesic of the given length > 0 from flow->origin along a tangent vector. */
static inline int implicit__shoot(implicit__flow *flow, const double *tangent, double length, implicit__end *end)
{
    /* Its square, the error of a step, is below rounding. At 1e-5 errors of 1e-14 begin
       to show, at 3e-9 steps are half as long for nothing. */
    const double tolerance = 1e-6;
    double done = 0, h, error, change;
    implicit__end next;
    int k, status, steps = 0;
    for (k = 0; k < 4; ++k) {
        end->position[k] = 0;
        end->velocity[k] = k < 3 ? tangent[k] : 1;
    }
    end->conjugate = 0;
    status = implicit__settle(flow, end);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) end->position[k] = 0;
    if (!(length < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    if (!(flow->step > 0)) { /* a radius of curvature, to begin with */
        double unit[4] = {0, 0, 0, 1}, a[4], bent;
        status = implicit__bend(flow, unit, end->velocity, a);
        if (status != SURFMINK_OK) return status;
        bent = fmax(implicit__norm(a), sqrt(fabs(a[3])));
        flow->step = bent > 0 ? 1 / bent : length;
    }
    while (done < length) {
        if (steps++ == flow->most) return SURFMINK_CALLBACK_FAILED;
        h = (length - done) / ceil((length - done) / flow->step);
        status = implicit__step(flow, end, h, &next, &error);
        if (status != SURFMINK_OK) return status;
        change = error > 0 ? 0.8 * sqrt(sqrt(sqrt(tolerance / error))) : 4;
        change = change > 4 ? 4 : change > 0.25 ? change : 0.25;
        if (error <= tolerance) {
            *end = next;
            status = implicit__settle(flow, end);
            if (status != SURFMINK_OK) return status;
            done = h < length - done ? done + h : length;
            if (change > 1) flow->step = h * change > flow->step ? h * change : flow->step;
        } else {
            flow->step = h * change;
        }
    }
    if (!(end->position[3] > 1e-6 * length)) end->conjugate = 1;
    return SURFMINK_OK;
}

/* --- exp and log -------------------------------------------------------------------------------------------------- */

/* exp: the point at a distance from x along a direction of the frame at x (normalised here; a negative length goes
   backwards). y may be the same array as x.
   Errors: NOT_FINITE, ZERO_NORMAL, CALLBACK_FAILED, BAD_ARGUMENT (no direction). */
static inline int surfmink_implicit_exp(const surfmink_implicit *surface, const double x[3], const double direction[2],
                                        double length, double y[3])
{
    implicit__flow flow;
    implicit__end end;
    double way[3], frame[9], tangent[3], size = hypot(direction[0], direction[1]);
    int k, status = implicit__drop(surface, x, way);
    if (status != SURFMINK_OK) return status;
    if (!(size < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    if (!(size > 0)) return SURFMINK_BAD_ARGUMENT;
    implicit__begin(&flow, surface, 30000);
    for (k = 0; k < 3; ++k) flow.origin[k] = x[k] + way[k];
    status = surfmink_implicit_frame(surface, flow.origin, frame);
    if (status != SURFMINK_OK) return status;
    if (length < 0) size = -size;
    for (k = 0; k < 3; ++k) tangent[k] = (direction[0] * frame[k] + direction[1] * frame[3 + k]) / size;
    status = implicit__shoot(&flow, tangent, fabs(length), &end);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) y[k] = flow.origin[k] + end.position[k];
    return SURFMINK_OK;
}

/* A log at work: from flow.origin, the foot of x on the surface, to flow.origin + target, the foot of y. */
typedef struct implicit__aim {
    implicit__flow flow;
    double frame[9], from[3], to[3]; /* from, to: the ways from x and y to their feet */
    double target[3], chord, size;
} implicit__aim;

/* A geodesic: its unit tangents at both ends and its length. */
typedef struct implicit__shot {
    double tangent[3], arrival[3], length;
} implicit__shot;

static inline int implicit__depart(implicit__aim *aim, const surfmink_implicit *surface, const double *x)
{
    int k, status = implicit__drop(surface, x, aim->from);
    if (status != SURFMINK_OK) return status;
    implicit__begin(&aim->flow, surface, 300);
    for (k = 0; k < 3; ++k) aim->flow.origin[k] = x[k] + aim->from[k];
    return surfmink_implicit_frame(surface, aim->flow.origin, aim->frame);
}

static inline int implicit__arrive(implicit__aim *aim, const double *x, const double *y)
{
    int k, status = implicit__drop(aim->flow.surface, y, aim->to);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) aim->target[k] = y[k] - x[k] + (aim->to[k] - aim->from[k]);
    aim->chord = implicit__norm(aim->target);
    aim->size = implicit__norm(x) + implicit__norm(y);
    if (!(aim->chord < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    /* Shorter than the rounding of the coordinates: no digit of its direction would be right. */
    return aim->chord > 2.3e-16 * aim->size ? SURFMINK_OK : SURFMINK_COINCIDENT_CORNERS;
}

/* Turns a tangent vector by an angle in the plane of e1 and e2. */
static inline void implicit__turn(const double *normal, double angle, double *tangent)
{
    double left[3], c = cos(angle), s = sin(angle);
    int k;
    implicit__cross(normal, tangent, left);
    for (k = 0; k < 3; ++k) tangent[k] = c * tangent[k] + s * left[k];
}

/* First guess: the circle through both points that is tangent to the surface in the first one (on a sphere: the
   answer). Where the chord is upright, any direction is as good. */
static inline void implicit__guess(const implicit__aim *aim, implicit__shot *shot)
{
    const double *normal = aim->frame + 6;
    double up = implicit__dot(aim->target, normal), along, slope;
    int k;
    for (k = 0; k < 3; ++k) shot->tangent[k] = aim->target[k] - up * normal[k];
    along = implicit__norm(shot->tangent);
    slope = atan2(fabs(up), along);
    shot->length = slope > 0 ? aim->chord * slope / sin(slope) : aim->chord;
    for (k = 0; k < 3; ++k) shot->tangent[k] = along > 0 ? shot->tangent[k] / along : aim->frame[k];
}

static inline double implicit__clamp(double value, double limit)
{
    return value > limit ? limit : value < -limit ? -limit : value;
}

/* Newton's method from a first shot. A steady hand takes whole steps only and gives up when they are large: then the
   answer continues the first shot, rather than being any geodesic that meets the target. Shots over `longest` are none.
   enough: the miss, as a share of the length, that one last correction mends: its square is what that leaves. */
static inline int implicit__hit(implicit__aim *aim, implicit__shot *shot, int steady, double enough, double longest)
{
    implicit__shot now = *shot, best = now;
    implicit__end end;
    double least = HUGE_VAL, share = 1, turn = 0, stretch = 0, across, miss, upright, gap[3], left[3];
    int round, k, status, conjugate = 0;
    for (round = 0; round < (steady ? 10 : 25) && now.length < longest; ++round) {
        status = implicit__shoot(&aim->flow, now.tangent, now.length, &end);
        if (status != SURFMINK_OK) return status;
        for (k = 0; k < 3; ++k) gap[k] = aim->target[k] - end.position[k];
        miss = implicit__norm(gap);
        if (miss < least) {
            implicit__cross(end.normal, end.velocity, left);
            stretch = implicit__dot(gap, end.velocity);
            across = implicit__dot(gap, left);
            turn = end.position[3] != 0 ? across / end.position[3] : 0; /* there no angle moves the end across */
            upright = implicit__dot(gap, end.normal); /* not small where this is another sheet of the surface */
            conjugate = end.conjugate;
            if (hypot(stretch, across) <= enough * now.length &&
                fabs(upright) <= 1e3 * enough * now.length + 1e-12 * aim->size) {
                if (conjugate) return SURFMINK_ANTIPODAL_CORNERS;
                if (fabs(turn) <= 100 * enough) {
                    implicit__turn(aim->frame + 6, turn, now.tangent);
                    for (k = 0; k < 3; ++k) now.arrival[k] = end.velocity[k] + turn * end.velocity[3] * left[k];
                    now.length += stretch;
                    *shot = now;
                    return SURFMINK_OK;
                }
            }
            if (steady && !(fabs(turn) < 0.3 && fabs(stretch) < 0.3 * now.length && end.position[3] > 0)) break;
            turn = implicit__clamp(turn, 0.7);
            stretch = implicit__clamp(stretch, 0.5 * now.length);
            best = now;
            least = miss;
            share = share < 0.5 ? 2 * share : 1;
        } else { /* too far: half the step from the best one so far */
            share /= 2;
            if (steady || share < 0.02) break;
        }
        now = best;
        implicit__turn(aim->frame + 6, share * turn, now.tangent);
        now.length += share * stretch;
    }
    return conjugate ? SURFMINK_ANTIPODAL_CORNERS : SURFMINK_CALLBACK_FAILED;
}

/* Components of a tangent vector, or of its opposite, in the frame at the foot of a point. */
static inline int implicit__tell(const surfmink_implicit *surface, const double *x, const double *way,
                                 const double *tangent, double sign, double *direction)
{
    double foot[3], frame[9], a, b, size;
    int k, status;
    for (k = 0; k < 3; ++k) foot[k] = x[k] + way[k];
    status = surfmink_implicit_frame(surface, foot, frame);
    if (status != SURFMINK_OK) return status;
    a = implicit__dot(tangent, frame);
    b = implicit__dot(tangent, frame + 3);
    size = sign * hypot(a, b);
    direction[0] = a / size;
    direction[1] = b / size;
    return SURFMINK_OK;
}

/* log: the shortest geodesic from x to y that is found: its length and its direction in the frame at x. log from y to x
   is the same geodesic, and its length the same to the bit. Errors: all of the list above. (Of two that are equally
   long the second may be missed: 1 in 1,200 pairs of antipodes of an ellipsoid.)
   Cost: 70 calls of f for a tiny edge, 200 for a tenth of a radian, 700 for one (6, 16 and 60 microseconds, gcc -O2 on
   an AMD EPYC); above 1.3 chords some 20 times that, and up to 1e6 calls where strong curvature makes Newton miss.   */
static inline int surfmink_implicit_log(const surfmink_implicit *surface, const double x[3], const double y[3],
                                        double *length, double direction[2])
{
    implicit__aim aim;
    implicit__shot guess, shot, best;
    const double *start = x, *stop = y;
    int k, turns, status, failure, found, tie = 0;
    for (k = 0; k < 2 && x[k] == y[k]; ++k) continue;
    if (x[k] > y[k]) { /* one of both ways is shot, so that the other cannot differ */
        start = y;
        stop = x;
    }
    status = implicit__depart(&aim, surface, start);
    if (status != SURFMINK_OK) return status;
    status = implicit__arrive(&aim, start, stop);
    if (status != SURFMINK_OK) return status;
    implicit__guess(&aim, &guess);
    best = guess;
    failure = implicit__hit(&aim, &best, 0, 1e-10, HUGE_VAL);
    found = failure == SURFMINK_OK;
    if (!found || best.length > 1.3 * aim.chord) {
        /* All round, and on, until something is found: across a thin body the chord is far too short. Every other shot
           starts with the chord's own length, for the circle is too long across a flat body, as the chord is round a
           ball. */
        for (turns = 1; turns < 16 || (turns < 80 && !found && failure != SURFMINK_ANTIPODAL_CORNERS); ++turns) {
            shot = guess;
            if (turns % 2) shot.length = aim.chord;
            shot.length = ldexp(shot.length, turns / 16);
            implicit__turn(aim.frame + 6, turns * 0.39269908169872415, shot.tangent);
            status = implicit__hit(&aim, &shot, 0, 1e-10, found ? 1.5 * best.length : HUGE_VAL);
            if (status == SURFMINK_ANTIPODAL_CORNERS) failure = status;
            if (status != SURFMINK_OK) continue;
            if (!found || shot.length < best.length * (1 - 1e-9)) {
                best = shot;
                tie = 0;
            } else if (shot.length < best.length * (1 + 1e-9) && implicit__dot(shot.tangent, best.tangent) < 1 - 1e-9) {
                tie = 1;
            }
            found = 1;
        }
    }
    if (!found) return failure;
    if (tie) return SURFMINK_ANTIPODAL_CORNERS;
    if (start == x)
        status = implicit__tell(surface, x, aim.from, best.tangent, 1, direction);
    else
        status = implicit__tell(surface, x, aim.to, best.arrival, -1, direction);
    if (status == SURFMINK_OK) *length = best.length;
    return status;
}

static inline int implicit__answer(const implicit__aim *aim, const double *x, const double *y,
                                   const implicit__shot *shot, double *length, double *direction, double *back)
{
    double there[2], here[2];
    int k, status = implicit__tell(aim->flow.surface, x, aim->from, shot->tangent, 1, there);
    if (status == SURFMINK_OK) status = implicit__tell(aim->flow.surface, y, aim->to, shot->arrival, -1, here);
    if (status != SURFMINK_OK) return status;
    *length = shot->length;
    for (k = 0; k < 2; ++k) {
        direction[k] = there[k];
        if (back) back[k] = here[k];
    }
    return SURFMINK_OK;
}

/* log next to a first guess: Newton's method from there, without a look at others. Chooses among several geodesics.
   length, direction  in: the guess (length > 0, direction not 0); out: the geodesic
   back        2      out: its direction at y, back to x; or NULL
   Errors: as above; ANTIPODAL_CORNERS only for conjugate points; BAD_ARGUMENT (no guess). */
static inline int surfmink_implicit_log_near(const surfmink_implicit *surface, const double x[3], const double y[3],
                                             double *length, double direction[2], double *back)
{
    implicit__aim aim;
    implicit__shot shot;
    double size = hypot(direction[0], direction[1]);
    int k, status;
    if (!(size < HUGE_VAL) || !(*length < HUGE_VAL)) return SURFMINK_NOT_FINITE;
    if (!(size > 0) || !(*length > 0)) return SURFMINK_BAD_ARGUMENT;
    status = implicit__depart(&aim, surface, x);
    if (status != SURFMINK_OK) return status;
    status = implicit__arrive(&aim, x, y);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) shot.tangent[k] = (direction[0] * aim.frame[k] + direction[1] * aim.frame[3 + k]) / size;
    shot.length = *length;
    status = implicit__hit(&aim, &shot, 0, 1e-10, HUGE_VAL);
    if (status != SURFMINK_OK) return status;
    return implicit__answer(&aim, x, y, &shot, length, direction, back);
}

/* The largest curvature that a surface can have at a point near it: |H| / |grad|. */
static inline int implicit__bound(const surfmink_implicit *surface, const double *x, double *curvature)
{
    implicit__jet jet;
    const double *h = jet.hessian;
    int status = implicit__look(surface, x, &jet);
    if (status != SURFMINK_OK) return status;
    *curvature =
        sqrt((h[0] * h[0] + h[3] * h[3] + h[5] * h[5] + 2 * (h[1] * h[1] + h[2] * h[2] + h[4] * h[4])) / jet.square);
    return SURFMINK_OK;
}

/* log along a curve: of all geodesics from path(0) to path(1) the one that a short geodesic becomes while its end is
   led along the curve. So it is homotopic to the curve, and a curve that comes back to its start gives a loop. Who can
   tell one homotopy class from another should do so: torus.h does.
   length, direction  out, as for log
   back        2      out: its direction at path(1), back to path(0); or NULL
   Errors: as above; ANTIPODAL_CORNERS if it meets a conjugate point on the way. Cost: ten logs, and more where the way
   is more than eight radii of curvature. */
static inline int surfmink_implicit_log_along(const surfmink_implicit *surface, surfmink_implicit_path *path,
                                              const void *context, double *length, double direction[2], double *back)
{
    implicit__aim aim;
    implicit__shot shot = {{0, 0, 0}, {0, 0, 0}, 0}, trial = shot;
    double x[3], y[3] = {0, 0, 0}, last[3], way[3], done = 0, stride = 0.125, next, sag, leap, bend = 0;
    int k, status;
    path(context, 0, x);
    status = implicit__depart(&aim, surface, x);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 3; ++k) last[k] = x[k];
    while (done < 1) {
        next = done + stride < 1 ? done + stride : 1;
        path(context, next, y);
        path(context, done + 0.4 * (next - done), way);
        for (sag = leap = 0, k = 0; k < 3; ++k) {
            sag += pow(way[k] - 0.6 * last[k] - 0.4 * y[k], 2);
            leap += pow(y[k] - last[k], 2);
        }
        status = implicit__bound(surface, y, &bend);
        if (status != SURFMINK_OK) return status;
        /* A curve that winds is followed in pieces that do not: ends alone would not tell. And the end is led no
           farther than a radius of curvature at a time. With four of them Newton's method may end on the next round of
           a thin tube: in 9 of 150 edges of a torus with r / R = 0.3, angles up to 6; with two, or one, in none. */
        if (sag > leap / 16 || leap * bend * bend > 1) {
            stride /= 2;
            if (stride < 1e-5) return SURFMINK_CALLBACK_FAILED;
            continue;
        }
        status = implicit__arrive(&aim, x, y);
        if (done > 0) {
            trial = shot; /* and where the end passes the start again, the chord is 0, but the geodesic is not */
            if (status == SURFMINK_COINCIDENT_CORNERS) status = SURFMINK_OK;
        } else if (status == SURFMINK_OK) {
            implicit__guess(&aim, &trial);
        }
        if (status == SURFMINK_OK) status = implicit__hit(&aim, &trial, 1, next < 1 ? 1e-4 : 1e-10, HUGE_VAL);
        if (status == SURFMINK_OK) {
            shot = trial;
            done = next;
            for (k = 0; k < 3; ++k) last[k] = y[k];
            stride = stride < 0.0625 ? 2 * stride : 0.125;
        } else {
            stride /= 4;
            if (stride < 1e-5) return status;
        }
    }
    return implicit__answer(&aim, x, y, &shot, length, direction, back);
}

/* --- for surfmink.h ----------------------------------------------------------------------------------------------- */

static inline int implicit__log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    return surfmink_implicit_log((const surfmink_implicit *)context, x, y, length, direction);
}

static inline int implicit__exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    return surfmink_implicit_exp((const surfmink_implicit *)context, x, direction, length, y);
}

/* The surface with its callbacks, stride 3. *implicit is read at each call and must outlive the surface. */
static inline surfmink_surface surfmink_implicit_surface(surfmink_implicit *implicit)
{
    surfmink_surface surface;
    surface.context = implicit;
    surface.stride = 3;
    surface.log = implicit__log;
    surface.exp = implicit__exp;
    return surface;
}

#endif /* SURFMINK_IMPLICIT_H */
