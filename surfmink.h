/* surfmink.h - v0.3.0 - surface Minkowski tensors of closed curves - MIT or public domain, as you like (end of file)

   One header, C99 and C++, only libm, no allocation, no global state.

   WHAT IT DOES
     Says how p-fold symmetric an outline on a curved surface is, and in which directions. Corners in, mu_p out:
     mu_p = 1 for a polygon of p equal angles (in the plane, on a sphere, anywhere), 0 for a circle, in between for the
     rest. mu_2 is elongation, mu_3 is how triangular, ..., mu_6 how hexagonal.
     One closed outline without holes, which encloses a curvature below 2 pi (on a sphere: less than half of it). Those
     that cross themselves are refused in the plane and on the sphere, but for a few; elsewhere nothing can tell.

   QUICK START
     #define SURFMINK_IMPLEMENTATION                              // in exactly one .c or .cpp file
     #include "surfmink.h"

     double corner[9] = {0, 0, 1,  1, 0, 0,  0, 1, 0};            // an octant of the unit sphere, counter-clockwise
     double mu[7];                                                // mu_0 ... mu_6
     int status = surfmink_measure_sphere(corner, 3, 1.0, 6, mu, NULL, NULL, NULL);
     if (status != SURFMINK_OK) puts(surfmink_strerror(status));
     else printf("mu_3 = %.3f, mu_4 = %.3f\n", mu[3], mu[4]);     // 1 and 0: a triangle, right angles and all

   DATA FLOW (sections of this file, in order)
     corners (+ normals | surface callbacks)
       1 measure    edge lengths l_i, turning angles alpha_i     plane | sphere | embedded surface | callbacks
       2 transport  phases f_i                                   defect-corrected | classical parallel transport
       3 integrate  irreducible components g_p, p = 0..P         the full tensors W_1^p from them
       4 spectrum   lambda_p, mu_p, eigenvector angles theta     eigenvectors in space, directions at the centre
     surfmink_measure_* walks through all four; everything after step 1 knows only l_i and alpha_i, not the surface.
     surfmink_batch_* does so for many outlines at once, with the vector instructions of the machine.
     surfmink_curve_* measures the smooth curve through the corners, to fourth order, and says how far off it may be.
     surfmink_gradient_* goes the way back: weights of mu_p, theta_p, g_p and L -> derivatives by corners and normals.

   CONVENTIONS
     corner x_i     x_0 .. x_{n-1}, counter-clockwise about the outer normal, the first not repeated at the end
     length l_i     of edge i, which joins corner i to corner i+1 (indices modulo n); your unit
     turning        alpha_i, the signed turn AT corner i, positive towards the inside; radians in [-pi, pi]
     S              sum of alpha_i = 2 pi - enclosed Gaussian curvature; 2 pi in the plane
     phase f_i      of edge i: f_0 = 0, f_i = (2 pi / S)(alpha_1 + ... + alpha_i); once round adds 2 pi
     rank p         0 .. P = max_rank, any P; p = 0 gives L; mu_1 = 0 in the plane but not on curved surfaces
     g_p            sum of l_i exp(i p f_i), stored as g[2p] (real part) and g[2p+1] (imaginary part)
     lambda_p, mu_p |g_p| and |g_p| / L in [0, 1]
     theta          eigenvector angle, from the outer co-normal nu of an edge towards its tangent tau, where
                    (nu, tau, normal) is right-handed: nu = tau x normal. g is read at the MIDDLE of edge 0.
     Arrays hold one corner after the other: x y (plane) or x y z. Lengths come out in the unit of the corners. In the
     descriptions below, the second column is the number of elements of an array.

   PAPER
     L. Happel, H. Hardering, S. Praetorius, A. Voigt: Surface Minkowski tensors to characterize shapes on curved
     surfaces, arXiv:2506.13880, 2025. "Paper 2.3" in this file is a section of it, (2.5) an equation. Section 3 turns
     by alpha_i between edges i-1 and i; that is what is done here. (Section 4.1 prints the sum one corner late, which
     is wrong where edges differ in length; 4.2 is right.)

   ERRORS
     A call that can fail returns SURFMINK_OK = 0 or a value of enum surfmink_status, named after what is wrong with
     the outline; every output is then untouched, except *bad: the corner to blame, or n if it is the whole outline.
     NULL is allowed only where a docstring says so. Outputs do not overlap inputs unless a docstring says so.
     No errno, no assert, no printing. All calls are re-entrant and thread-safe.

   CONFIGURE (all optional; define before the include that brings the implementation)
     SURFMINK_STATIC     a private copy, implementation included, in this file; may be used in several files at once
     SURFMINK_DEF        prefix of every public function, e.g. __declspec(dllexport)
     SURFMINK_SIN, SURFMINK_COS, SURFMINK_ATAN2, SURFMINK_SQRT
                         replacements for libm; with all four defined <math.h> is not included. Batches in vector
                         instructions need no libm and do not use them
     SURFMINK_DISPATCH   batches ask the processor for AVX-512 or AVX2 with FMA (gcc and clang on x86-64). Otherwise
                         they use what the compiler is allowed to: SSE2, AVX2 with -mavx2 -mfma, AVX-512 with
                         -march=..., NEON on arm64
     SURFMINK_NO_SIMD    batches in plain C: other compilers and freestanding builds have no other. About a third as
                         fast
     SURFMINK_FILE       "surfmink.h": the name under which the implementation includes itself, once for each set of
                         vector instructions. Only if you rename the file; with SURFMINK_NO_SIMD it does not
     -fopenmp            batches use all cores
     Including the file again, with or without SURFMINK_IMPLEMENTATION, is harmless.

   ACCURACY
     With the condition number c = max(1, sum |alpha_i| / S), near 1 for most outlines and more where one turns to and
     fro, winds, or encloses a curvature near 2 pi, every outline that is not refused has
       L       to 1e-15, relative
       S       to 2e-15 c, relative
       mu_p    to 1e-14 (1 + c), p <= 12, and the angle p theta_p of g_p, times mu_p, to the same
       area    to 2e-15 of half the sum of |x_i - x_0| l_i; slivers are small beside that
     at any size of the outline, 3 to 1e5 corners (1e7 lose nothing, but there is no proof in higher precision). make
     accuracy holds all ways to measure against quadruple precision: cells of size 1e-12, corners off the sphere, edges
     steep against the tangent plane, needles, spikes, spirals, near great circles; docs/trust.md has the worst found.
     c is about rounding, not about errors of the corners themselves: one that is off by e may change mu_p by 2 pi p e /
     (S l) or so, with l the length of its edges. Convex outlines have c = 1 however small S is.
     Angles come from differences of corners and atan2, never arccos; long sums are compensated. Single calls and
     batches share their formulas. Outlines that are ordinary go through them as they are; others (extreme units,
     spikes, steep or very long edges, wide windings, S below 0.5, all that is refused) are measured corner by corner
     with twice the digits, and take more than ten times as long.

   DETERMINISM
     The same program on the same machine gives the same bits, whatever the thread or the locale, and in a batch
     whatever the other outlines and the number of threads. All functions give the same bits in other builds too (make
     check compares gcc, clang and tcc; C and C++; -O0 to -O3; x86-64, 32-bit x86, arm64 and big-endian s390x; glibc and
     musl), where
       a*b+c is not fused: -ffp-contract=off. gcc does not fuse with -std=c99, no compiler does for plain x86-64; gcc 12
         at -O3 does so in vectors where there is FMA, whatever it is told, unless by -fno-tree-slp-vectorize
       doubles have 64 bits: for 32-bit x86 this takes -msse2 -mfpmath=sse
       sin, cos and atan2 are the same. glibc has others for processors without FMA and for 32-bit x86, and musl its
         own, so that one program may differ between machines. With functions of yours as SURFMINK_SIN, SURFMINK_COS and
         SURFMINK_ATAN2 it does not
       batches use the same instructions: SSE2, or none; AVX2, AVX-512 and NEON agree to the bit.
     Otherwise the last bits may differ; statuses do not. Batches differ from single calls, and sets of vector
     instructions from each other, by no more than ACCURACY grants the two: with SURFMINK_DISPATCH results depend that
     much on the processor. Fused a*b+c, another libm, x87 with -std=c99, and rounding up, down or towards zero stay
     within that, too; but batches in vector instructions need rounding to nearest, or lose half of their digits.
     -ffast-math, and x87 without -std=c99, take away the digits beyond a double: with c' = (sum |alpha_i| + |2 pi - S|)
     / S that leaves 1e-14 (1 + c')^2. And -ffast-math lets NaN and infinity pass unrefused.

   HISTORY
     0.3.0  smooth curves to fourth order, error estimates; gradients; directions at the centre
     0.2.1  every outline to 1e-14 (1 + c), great circles and spirals included; the same bits from more compilers
     0.2.0  batches; faster single calls; S on the sphere to all digits
     0.1.0  the four steps, the four kinds of surfaces, transports, tensors, helpers */
#ifndef SURFMINK_H
#define SURFMINK_H

#define SURFMINK_VERSION       "0.3.0"
#define SURFMINK_VERSION_MAJOR 0
#define SURFMINK_VERSION_MINOR 3
#define SURFMINK_VERSION_PATCH 0

#include <stddef.h> /* size_t, ptrdiff_t */

#ifndef SURFMINK_DEF
#if defined(SURFMINK_STATIC) && defined(__GNUC__)
#define SURFMINK_DEF static __inline__ /* no warning about what a program does not call */
#elif defined(SURFMINK_STATIC)
#define SURFMINK_DEF static
#else
#define SURFMINK_DEF extern
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* What may be wrong with an outline. surfmink_strerror says it in a sentence, surfmink_status_name in a word. */
enum surfmink_status {
    SURFMINK_OK = 0,
    SURFMINK_TOO_FEW_CORNERS = 1,    /* a polygon needs at least 3 */
    SURFMINK_NOT_FINITE = 2,         /* a NaN or an infinity; or a difference, a length or an area overflows */
    SURFMINK_COINCIDENT_CORNERS = 3, /* two neighbours are the same point: surfmink_merge drops one of them */
    SURFMINK_ZERO_NORMAL = 4,        /* a normal has no direction; on the sphere: a corner is the centre */
    SURFMINK_UPRIGHT_EDGE = 5,       /* an edge runs along the normal: it has no direction in the tangent plane */
    SURFMINK_ANTIPODAL_CORNERS = 6,  /* two neighbours are opposite: no unique great circle joins them */
    SURFMINK_CLOCKWISE = 7,          /* S < 0: surfmink_reverse turns the corners round; or normals point inwards */
    SURFMINK_TOO_MUCH_CURVATURE = 8, /* the enclosed curvature reaches 2 pi: S is no more than rounding noise */
    SURFMINK_CROSSES_ITSELF = 9,     /* plane and sphere only: S and the area contradict each other */
    SURFMINK_CALLBACK_FAILED = 10,   /* a surface's log or exp failed or returned nonsense */
    SURFMINK_BAD_ARGUMENT = 11       /* a negative rank, a radius that is not positive, an edge >= n, ... */
};

/* One sentence for a status, "" for a number that is none. The texts are constants. */
SURFMINK_DEF const char *surfmink_strerror(int status);

/* One word for a status, for tables: "ok", "too_few_corners", ...; "" for a number that is none. */
SURFMINK_DEF const char *surfmink_status_name(int status);

/* The Minkowski functionals of an outline (paper 2.2) and what follows from them. */
typedef struct surfmink_functionals {
    double area;      /* W_0, plane and sphere; 0 where the surface does not tell it (embedded, callbacks) */
    double length;    /* W_1 = L, the sum of the edge lengths */
    double turning;   /* W_2 = S, the sum of the turning angles */
    double curvature; /* enclosed Gaussian curvature 2 pi - S: plane 0, sphere area / R^2, which keeps small digits */
    double condition; /* sum |alpha_i| / S >= 1: by how much errors of single angles may be amplified */
} surfmink_functionals;

/* A surface of yours. Corners are opaque to this file: stride doubles each, read only by the callbacks.
   log     the geodesic from x to y: its length > 0 and its direction at x, as two components in an oriented orthonormal
           frame at x of your choice (the same one each time x is asked for); need not be unit. So surfaces need not
           be embedded in space. Coinciding points have no direction: return SURFMINK_COINCIDENT_CORNERS.
   exp     the point at the given length along the geodesic that leaves x in the given unit direction. Only the
           functions that build something (regular polygon, points of an edge) ask for it: else it may be NULL.
   Return SURFMINK_OK, or the status to report: SURFMINK_CALLBACK_FAILED, or a better name; outputs then do
   not matter. */
typedef struct surfmink_surface {
    void *context; /* handed to the callbacks as it is */
    size_t stride; /* doubles a corner */
    int (*log)(void *context, const double *x, const double *y, double *length, double direction[2]);
    int (*exp)(void *context, const double *x, const double direction[2], double length, double *y);
} surfmink_surface;

/* Which transport along the outline a phase or a vector follows (paper 2.3). */
enum surfmink_transport {
    SURFMINK_CORRECTED = 0, /* f = phi + eta: after one turn round the outline every vector is back where it was */
    SURFMINK_PARALLEL = 1,  /* phi: the classical parallel transport, off by the enclosed curvature after one turn */
    SURFMINK_DEFECT = 2     /* eta = (2 pi / S - 1) phi: the rotation between the two */
};

/* --- the easy door: all four steps in one call -------------------------------------------------------------------- */

/* Measures a polygon of the plane.
   corner      2 n    x y of each corner
   n                  number of corners, >= 3
   max_rank           P >= 0
   mu          P + 1  out: mu_0 = 1, mu_1, ..., mu_P; or NULL
   g         2 P + 2  out: irreducible components, for surfmink_spectrum and surfmink_angles; or NULL
   w                  out: the Minkowski functionals; or NULL
   bad                out, only on failure: the corner to blame, or n; or NULL
   Errors: TOO_FEW_CORNERS, NOT_FINITE, COINCIDENT_CORNERS, CLOCKWISE, CROSSES_ITSELF (S is not 2 pi), BAD_ARGUMENT.
   An exact spike (the outline runs back on itself) has a turn of pi without a sign: it counts as +pi, a whisker that
   sticks out. One that sticks in is refused as CROSSES_ITSELF.
   Cost: O(n P) time, 10 KiB of stack. Paper (3.2), with the turn of section 3. */
SURFMINK_DEF int surfmink_measure_plane(const double *corner, size_t n, int max_rank, double *mu, double *g,
                                        surfmink_functionals *w, size_t *bad);

/* Measures a polygon of great-circle arcs on the sphere of the given radius about the origin.
   corner      3 n    x y z of each corner; only its direction counts, so it may lie a little off the sphere, or on
                      the unit sphere while radius gives the unit of the lengths
   radius             > 0, at most 1e307
   The rest, spikes and cost as in surfmink_measure_plane. Edges are shorter than half a great circle.
   Errors: as in the plane, and ZERO_NORMAL (a corner at the origin), ANTIPODAL_CORNERS, TOO_MUCH_CURVATURE (a
   great circle). CROSSES_ITSELF: S + area / R^2 is not 2 pi. More than a hemisphere has S < 0: CLOCKWISE. */
SURFMINK_DEF int surfmink_measure_sphere(const double *corner, size_t n, double radius, int max_rank, double *mu,
                                         double *g, surfmink_functionals *w, size_t *bad);

/* Measures a polygon of straight chords between points of a surface in space with known normals (paper 4.2).
   corner      3 n    x y z of each corner
   normal      3 n    outer normal at each corner; need not be unit; the same array as corner for a sphere at the origin
   The rest, spikes and cost as in surfmink_measure_plane. w->area is 0, for only you know the surface between corners.
   Errors: TOO_FEW_CORNERS, NOT_FINITE, COINCIDENT_CORNERS, ZERO_NORMAL, UPRIGHT_EDGE (within 1e-6 rad of the normal),
   CLOCKWISE, TOO_MUCH_CURVATURE, BAD_ARGUMENT. An outline that crosses itself is not found out. */
SURFMINK_DEF int surfmink_measure_embedded(const double *corner, const double *normal, size_t n, int max_rank,
                                           double *mu, double *g, surfmink_functionals *w, size_t *bad);

/* Measures a geodesic polygon of any surface that has a log.
   corner      n * surface->stride, as the callbacks understand them
   scratch     2 n    doubles to work in
   The rest and spikes as in surfmink_measure_plane; w->area is 0.
   Errors: what the callbacks return, else CALLBACK_FAILED; TOO_FEW_CORNERS, COINCIDENT_CORNERS (a length of 0),
   CLOCKWISE, TOO_MUCH_CURVATURE, BAD_ARGUMENT (no log, no stride). Cost: 2 n calls of log, O(n P) time. Paper 4.1. */
SURFMINK_DEF int surfmink_measure_surface(const surfmink_surface *surface, const double *corner, size_t n,
                                          double *scratch, int max_rank, double *mu, double *g, surfmink_functionals *w,
                                          size_t *bad);

/* --- the same for many outlines: batches -------------------------------------------------------------------------- */

/* Where the results of a batch go: arrays of yours, one entry an outline. Each may be NULL; all that are not asked for
   cost nothing. */
typedef struct surfmink_results {
    int *status;     /* of enum surfmink_status */
    size_t *bad;     /* only of refused outlines: the corner to blame, counted within the outline, or n */
    double *length;  /* L */
    double *turning; /* S */
    double *area;    /* W_0, plane and sphere; 0 of an embedded surface */
    double *mu;      /* P + 1 an outline */
    double *g;       /* 2 P + 2 an outline, as surfmink_measure_* */
    double *theta;   /* P + 1 an outline, as surfmink_spectrum; about as much work as all of g */
} surfmink_results;

/* Measures many outlines in one call: surfmink_measure_* for each, but several at once in vector instructions.
   corner, normal, radius, max_rank  as surfmink_measure_*; the corners of all outlines, one outline after the other
   offset    count+1  outline i has the corners offset[i] .. offset[i+1] - 1; none is looked at from offset[count] on
   count              number of outlines
   out                of a refused outline only status and bad are written
   scratch            2 doubles for each corner before offset[count], to work in; or NULL: then edges of outlines with
                      more than 64 corners are measured twice (in the plane they are anyway). No bit depends on it
   returns            how many outlines were refused: 0 if all is well
   Errors: each outline has its own, as in surfmink_measure_*; all have BAD_ARGUMENT if max_rank or radius is bad, and
   so has one whose offsets fall, or that ends after offset[count].
   An outline's results do not depend on the others nor on the number of threads. They differ from those of
   surfmink_measure_* by rounding. Cost: O(corners P), 50 KiB of stack, no libm; in docs/performance.md in figures. */
SURFMINK_DEF size_t surfmink_batch_plane(const double *corner, const size_t *offset, size_t count, int max_rank,
                                         const surfmink_results *out, double *scratch);
SURFMINK_DEF size_t surfmink_batch_sphere(const double *corner, const size_t *offset, size_t count, double radius,
                                          int max_rank, const surfmink_results *out, double *scratch);
SURFMINK_DEF size_t surfmink_batch_embedded(const double *corner, const double *normal, const size_t *offset,
                                            size_t count, int max_rank, const surfmink_results *out, double *scratch);

/* --- 1. measure: corners -> lengths, turning angles, Minkowski functionals ---------------------------------------- */

/* Edge lengths and turning angles; one function per kind of surface. Inputs and errors as in surfmink_measure_*, but
   nothing is said about the outline as a whole: no CLOCKWISE, TOO_MUCH_CURVATURE, CROSSES_ITSELF.
   length      n      out: l_i, of the edge from corner i to corner i+1
   turning     n      out: alpha_i, at corner i, in [-pi, pi]
   Cost: O(n), one atan2 a corner (sphere: two). Paper 4.2; on the sphere and through callbacks 4.1. */
SURFMINK_DEF int surfmink_edges_plane(const double *corner, size_t n, double *length, double *turning, size_t *bad);
SURFMINK_DEF int surfmink_edges_sphere(const double *corner, size_t n, double radius, double *length, double *turning,
                                       size_t *bad);
SURFMINK_DEF int surfmink_edges_embedded(const double *corner, const double *normal, size_t n, double *length,
                                         double *turning, size_t *bad);
/* scratch: 2 n doubles to work in, so that a callback that fails half-way leaves length and turning untouched. */
SURFMINK_DEF int surfmink_edges_surface(const surfmink_surface *surface, const double *corner, size_t n,
                                        double *scratch, double *length, double *turning, size_t *bad);

/* L, S, 2 pi - S and the condition number of measured edges; w->area is set to 0.
   length      n      lengths >= 0
   turning     n      radians
   Errors: TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT (a negative length, all lengths 0), CLOCKWISE, TOO_MUCH_CURVATURE:
   |S| < max(1e-12 sum |alpha|, 4 n eps), below which S is rounding noise. Cost: O(n). Paper 2.2. */
SURFMINK_DEF int surfmink_total(const double *length, const double *turning, size_t n, surfmink_functionals *w);

/* W_0 in the plane, positive if counter-clockwise: shoelace about corner 0, so that digits survive far away.
   Errors: TOO_FEW_CORNERS, NOT_FINITE. Cost: O(n). */
SURFMINK_DEF int surfmink_area_plane(const double *corner, size_t n, double *area);

/* W_0 on the sphere, in (-2 pi R^2, 2 pi R^2]: of the part to the left of the outline if that is the smaller one, else
   minus that of the part to the right. A fan of triangles; for
   outlines that go round most of a hemisphere 2 pi - S. Relative accuracy about 1e-15.
   Errors: TOO_FEW_CORNERS, NOT_FINITE, ZERO_NORMAL, COINCIDENT_CORNERS, ANTIPODAL_CORNERS, BAD_ARGUMENT. Cost: O(n). */
SURFMINK_DEF int surfmink_area_sphere(const double *corner, size_t n, double radius, double *area);

/* --- 2. transport: turning angles -> phases ----------------------------------------------------------------------- */

/* Phase of each edge, the angle that a co-normal gains on its way back to edge 0: a sum over turning[1] ... turning[i],
   times 2 pi / S (SURFMINK_CORRECTED: f_i), 1 (SURFMINK_PARALLEL: phi_i) or 2 pi / S - 1 (SURFMINK_DEFECT: eta_i).
   turning     n      radians
   transport          of enum surfmink_transport
   phase       n      out: radians, not reduced; phase[0] = 0; may be the same array as turning
   Errors: TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT, and unless PARALLEL: CLOCKWISE, TOO_MUCH_CURVATURE.
   Cost: O(n); the sums are compensated. Paper (2.5); 3.3 for polygons. */
SURFMINK_DEF int surfmink_phases(const double *turning, size_t n, int transport, double *phase);

/* Carries a direction along the outline: an angle against the co-normal of edge `from`, past `steps` corners (backwards
   if negative), becomes an angle against the co-normal of the edge where it arrives. n steps are one turn: CORRECTED
   then gives angle - 2 pi, PARALLEL angle - S, which is off by the enclosed curvature.
   angle, *carried    radians, not reduced
   Errors: as surfmink_phases, and BAD_ARGUMENT if from >= n. Cost: O(n + |steps|). Paper 2.3. */
SURFMINK_DEF int surfmink_transport_angle(const double *turning, size_t n, size_t from, ptrdiff_t steps, int transport,
                                          double angle, double *carried);

/* The same for a tangent vector in space: from the middle of one edge of an embedded outline to that of another.
   corner, normal 3 n as in surfmink_measure_embedded; turning n from surfmink_edges_embedded (or _sphere)
   vector      3      its part along the normal is dropped
   carried     3      out; may be the same array as vector
   Errors: as surfmink_transport_angle and surfmink_frame_embedded. */
SURFMINK_DEF int surfmink_transport_vector(const double *corner, const double *normal, const double *turning, size_t n,
                                           size_t from, ptrdiff_t steps, int transport, const double vector[3],
                                           double carried[3]);

/* --- 3. integrate: lengths, phases -> irreducible components, tensors --------------------------------------------- */

/* Irreducible components g_p = sum_i length_i exp(i p phase_i), p = 0..P; corrected phases read them at the middle
   of edge 0.
   length      n      lengths >= 0
   phase       n      radians, from surfmink_phases
   max_rank           P >= 0; errors grow slowly with it (1e-14 at 128)
   g         2 P + 2  out: g[2p], g[2p+1]; g[0] = L, g[1] = 0
   Errors: TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT. Cost: O(n P), one sine and cosine an edge and 24 ranks, 10 KiB of
   stack. Paper (3.2). */
SURFMINK_DEF int surfmink_irreducible(const double *length, const double *phase, size_t n, int max_rank, double *g);

/* The same with the classical parallel transport to a point of the outline: at `fraction` of edge `edge`. The result
   depends on that point, wherever curvature is enclosed; that is why it is here only for comparison.
   turning     n      radians, of any sum
   edge, fraction     edge < n, 0 <= fraction < 1; the edge is split there in two
   Errors and cost as surfmink_irreducible. Paper 2.3 and 5.1. */
SURFMINK_DEF int surfmink_irreducible_parallel(const double *length, const double *turning, size_t n, size_t edge,
                                               double fraction, int max_rank, double *g);

/* The distinct components of the full symmetric tensor W_1^p = sum_i l_i nu_i (x) ... (x) nu_i (paper 2.3).
   g         2 p + 2  components of all ranks up to p
   p                  0 .. 1000
   tensor      p + 1  out: tensor[j] has j indices along tau and p - j along nu, = sum_i l_i cos^(p-j) f_i sin^j f_i
   Errors: BAD_ARGUMENT. Cost: O(p^2). */
SURFMINK_DEF int surfmink_tensor(const double *g, int p, double *tensor);

/* The same for its trace-free part, which only g_p makes up: 2^(1-p) times the real part of (-i)^j g_p (paper 2.4). */
SURFMINK_DEF int surfmink_trace_free(const double *g, int p, double *tensor);

/* Contracts a symmetric tensor of rank p with p - 1 copies of a vector. For the trace-free part of W_1^p and a unit
   eigenvector e the result is 2^(1-p) lambda e: the eigenvalue equation of paper 2.4.
   tensor      p + 1  as from surfmink_tensor or surfmink_trace_free
   p                  1 .. 1000
   vector      2      along nu, along tau
   contracted  2      out; may be the same array as vector
   Errors: BAD_ARGUMENT. Cost: O(p^2). Rounding errors grow like 2^(p/2) eps against the result: the components are an
   ill-conditioned basis at high rank, unlike g. */
SURFMINK_DEF int surfmink_contract(const double *tensor, int p, const double vector[2], double contracted[2]);

/* --- 4. spectrum: irreducible components -> eigenvalues, eigenvectors --------------------------------------------- */

/* Eigenvalues and first eigenvector angles of all ranks. Each output may be NULL.
   g         2 P + 2
   lambda      P + 1  out: lambda_p = |g_p| >= 0; the other eigenvalue is -lambda_p
   mu          P + 1  out: lambda_p / L in [0, 1], up to rounding
   theta       P + 1  out: arg(g_p) / p in (-pi/p, pi/p], the n = 0 eigenvector of +lambda_p; theta[0] = 0.
                      Where mu_p is no more than rounding noise (1e-14) the directions are noise too
   Errors: NOT_FINITE, BAD_ARGUMENT (L is not positive). Cost: O(P). Paper 2.4. */
SURFMINK_DEF int surfmink_spectrum(const double *g, int max_rank, double *lambda, double *mu, double *theta);

/* The p eigenvector angles of one rank p >= 1: (arg g_p + 2 pi n) / p for sign >= 0, (arg g_p + (2 n + 1) pi) / p for
   sign < 0, n = 0 .. p-1. Errors: NOT_FINITE, BAD_ARGUMENT. Cost: O(p). Paper (2.10). */
SURFMINK_DEF int surfmink_angles(const double *g, int p, int sign, double *theta);

/* Outer co-normal nu and tangent tau of an edge of a plane polygon, unit vectors: frame[0..1] = nu, frame[2..3] = tau.
   Errors: TOO_FEW_CORNERS, NOT_FINITE, COINCIDENT_CORNERS, BAD_ARGUMENT (edge >= n). */
SURFMINK_DEF int surfmink_frame_plane(const double *corner, size_t n, size_t edge, double frame[4]);

/* Co-normal, tangent and normal at the middle of an edge in space: frame[0..2] = nu, [3..5] = tau along the chord,
   [6..8] = the mean of the normals at both ends, made orthogonal to the chord. On a sphere pass the corners as normals.
   Errors: TOO_FEW_CORNERS, NOT_FINITE, COINCIDENT_CORNERS, ZERO_NORMAL, UPRIGHT_EDGE, BAD_ARGUMENT. */
SURFMINK_DEF int surfmink_frame_embedded(const double *corner, const double *normal, size_t n, size_t edge,
                                         double frame[9]);

/* Eigenvectors of rank p at an edge, as unit vectors: cos(theta - phase) nu + sin(theta - phase) tau.
   g, p, sign         as in surfmink_angles
   phase              f_i of that edge from surfmink_phases; 0 at edge 0
   frame     2 dim    of that edge; dim 2 from surfmink_frame_plane, 3 from surfmink_frame_embedded
   vector    p dim    out: one after the other, n = 0 .. p-1
   Errors: NOT_FINITE, BAD_ARGUMENT. Paper 2.4 and 3.1: eigenvectors at two edges are transports of each other. */
SURFMINK_DEF int surfmink_eigenvectors(const double *g, int p, int sign, double phase, const double *frame, int dim,
                                       double *vector);

/* The directions of an outline at its centre, one for each rank: for glyphs and for averages over many outlines. Every
   edge has its own copy of an eigenvector; each is tilted to the centre by the smallest rotation that takes the normal
   of its edge to the mean normal, and the directions found there are averaged, p times their angle, weighted by length.
   corner, normal     as in surfmink_measure_*
   length, phase n    from steps 1 and 2; the phases of the transport that g was made with
   g         2 P + 2  only its arguments count
   scratch     n      doubles to work in; may be the same array as phase, which is then lost
   centre      2, 3   out: mean of the outline, by length; on the sphere times your radius it is mean_normal; or NULL
   mean_normal 3      out: unit, mean of the normals of the edges, by length; or NULL
   direction (P+1)dim out: dim = 2 or 3, unit and orthogonal to mean_normal: eigenvector n = 0 of +lambda_p; the others
                      follow in steps of 2 pi / p. Rank 0 has none: 0. Where mu_p or the coherence is no more than
                      rounding noise (1e-14) the directions are noise too; or NULL
   coherence   P + 1  out: in [0, 1], how well the edges agree: 1 if all do, as in the plane; it depends on the outline
                      and on p but not on g; or NULL
   Errors: as surfmink_irreducible and surfmink_edges_*; ZERO_NORMAL: the mean of the normals is shorter than 1e-6, or
   one of them is opposite to it within 1e-6 rad; BAD_ARGUMENT: all lengths are 0.
   Cost: O(n P), one atan2 and the sines and cosines of surfmink_irreducible. Paper 2.4, seen from the centre. */
SURFMINK_DEF int surfmink_director_plane(const double *corner, size_t n, const double *length, const double *phase,
                                         const double *g, int max_rank, double *scratch, double *centre,
                                         double *direction, double *coherence);
SURFMINK_DEF int surfmink_director_sphere(const double *corner, size_t n, const double *length, const double *phase,
                                          const double *g, int max_rank, double *scratch, double *mean_normal,
                                          double *direction, double *coherence);
SURFMINK_DEF int surfmink_director_embedded(const double *corner, const double *normal, size_t n, const double *length,
                                            const double *phase, const double *g, int max_rank, double *scratch,
                                            double *centre, double *mean_normal, double *direction, double *coherence);
/* --- smooth curves: fourth order, error estimates ----------------------------------------------------------------- */

/* Measures the smooth closed curve on which the corners lie, instead of the polygon that they make. Order 2 gives the
   numbers of surfmink_measure_*: the polygon stands for the curve, with errors that fall fourfold when corners are
   twice as many. Order 4 adds what the curve does between corners, by formulas in the same lengths and turns: errors
   fall sixteenfold. For shapes with corners take order 2, where polygons are exact, or tell which corners are sharp.
   corner, normal, radius, surface  as surfmink_measure_*; the corners lie on the curve, the normals are exact
   sharp       n      not 0 where the curve itself has a corner, between smooth arcs; or NULL: nowhere. Order 4 then
                      looks along each arc only. If all are sharp, edges are straight lines or geodesics
   n                  number of corners, >= 3; order 4 wants 20 or so for each bend of the curve
   order              2 or 4
   max_rank           P >= 0
   scratch     8 n    doubles to work in
   mu          P + 1  out; or NULL
   error       P + 1  out: how far mu_p may be off the curve: |mu_p - half mu_p| / 3 at order 2, / 15 at order 4, where
                      half mu_p is that of every second corner; error[0] is that of L, over L, since mu_0 has none.
                      1 if nothing can be said: fewer than 5 corners, or every second is an outline that is refused.
                      Of an even n, half mu_p is the mean of that of the even corners and that of the odd ones; of an
                      odd n, one goes round twice. If corners are sharp, they stay, and one goes round once. Or NULL
   g         2 P + 2  out: read at the middle of the arc of edge 0, against the co-normal of the curve there; or NULL
   w                  out: of the curve; area in the plane and on the sphere; or NULL
   bad                out, only on failure: as in surfmink_measure_*; or NULL
   Errors: as surfmink_measure_*, for the polygon and for S of the curve; BAD_ARGUMENT (order); NOT_FINITE (lengths of
   neighbours too unlike to divide one by the other); embedded: ZERO_NORMAL (normals of neighbours opposite).
   Cost: O(n P), at order 4 two to seven times surfmink_measure_*; error as much again.
   Derivation, convergence and limits: docs/beyond.md. */
SURFMINK_DEF int surfmink_curve_plane(const double *corner, const unsigned char *sharp, size_t n, int order,
                                      int max_rank, double *scratch, double *mu, double *error, double *g,
                                      surfmink_functionals *w, size_t *bad);
SURFMINK_DEF int surfmink_curve_sphere(const double *corner, const unsigned char *sharp, size_t n, double radius,
                                       int order, int max_rank, double *scratch, double *mu, double *error, double *g,
                                       surfmink_functionals *w, size_t *bad);
SURFMINK_DEF int surfmink_curve_embedded(const double *corner, const double *normal, const unsigned char *sharp,
                                         size_t n, int order, int max_rank, double *scratch, double *mu, double *error,
                                         double *g, surfmink_functionals *w, size_t *bad);
/* curvature          the Gaussian curvature K if it is the same everywhere, in 1 / length^2; else ignored
   curvature_at       writes K at the corner x, and returns as the callbacks of the surface do; or NULL */
SURFMINK_DEF int surfmink_curve_surface(const surfmink_surface *surface, double curvature,
                                        int (*curvature_at)(void *context, const double *x, double *curvature),
                                        const double *corner, const unsigned char *sharp, size_t n, int order,
                                        int max_rank, double *scratch, double *mu, double *error, double *g,
                                        surfmink_functionals *w, size_t *bad);

/* What order 4 needs to know of straight edges besides l_i and alpha_i: how the surface curves along them.
   corner, normal 3 n as surfmink_measure_embedded
   bend        n      out: a_i = -(n_{i+1} - n_i) . e, the angle by which the normal turns over along edge i: normal
                      curvature times length, negative where the surface bulges outwards along the edge
   twist       n      out: w_i = -(n_{i+1} - n_i) . (N x e), by which it turns about the edge: geodesic torsion times
                      length. e is the unit edge, N the mean normal orthogonal to it
   Errors: as surfmink_edges_embedded, and ZERO_NORMAL (normals of neighbours opposite). Cost: O(n). */
SURFMINK_DEF int surfmink_bends_embedded(const double *corner, const double *normal, size_t n, double *bend,
                                         double *twist, size_t *bad);

/* Order 4 from measured edges: l_i, alpha_i and three more numbers an edge are all that a surface contributes.
   length      n      lengths > 0
   turning     n      radians
   bend, twist n      of straight edges, from surfmink_bends_embedded; or both NULL: edges are geodesics
   curvature   n      Gaussian curvature K_i at the middle of geodesic edges, good to O(l^2); ignored if there are bend
                      and twist; or NULL: 0
   sharp, max_rank, mu, g  as surfmink_curve_*
   scratch     3 n    doubles to work in
   w                  out: of the curve; area is 0; or NULL
   Errors: as surfmink_total, for the polygon and for the curve; COINCIDENT_CORNERS (a length of 0); NOT_FINITE;
   BAD_ARGUMENT (bend without twist). Cost: O(n P). */
SURFMINK_DEF int surfmink_curve_edges(const double *length, const double *turning, const double *bend,
                                      const double *twist, const double *curvature, const unsigned char *sharp,
                                      size_t n, int max_rank, double *scratch, double *mu, double *g,
                                      surfmink_functionals *w);

/* --- gradients: an energy of what was measured -> its derivatives by corners and normals -------------------------- */

/* How an energy E of one outline changes with what surfmink_measure_* says of it: its derivatives, called weights. Each
   may be NULL: E does not depend on that. Steps 1 to 4 are linear in small changes, so weights are all one has to know
   of E. If E is not linear in mu, they depend on mu: measure first, or take the steps below one by one.
   Where mu_p is no more than rounding noise (1e-14), |g_p| has a kink and arg g_p means nothing: there the weights of
   mu_p and theta_p count as 0. g_p itself is smooth. For mu_p^2 = |g_p|^2 / L^2, which is smooth, too, give the weights
   2 g_p / L^2 of g_p and -2 mu_p^2 / L of L. */
typedef struct surfmink_weights {
    const double *mu;     /* P + 1: dE/dmu_p; the first does not count, for mu_0 = 1 */
    const double *g;      /* 2 P + 2: dE by the real and the imaginary part of g_p; those of g_0 are L, and 0 */
    const double *theta;  /* P + 1: dE/dtheta_p; the first does not count */
    const double *length; /* 1: dE/dL */
    size_t shared;        /* batches: 0 if each outline has weights of its own, else all have the first ones */
} surfmink_weights;

/* Measures an outline, as surfmink_measure_*, and pulls weights back to its corners: the gradient of E, whose negative
   is the force on each corner.
   corner, normal, n, radius, max_rank, mu, g, w, bad  as surfmink_measure_*, to the bit
   weights            finite
   by_corner  dim n   out: dE/dx_i, dim = 2 in the plane, else 3; on the sphere orthogonal to x_i
   by_normal  3 n     out: dE/dn_i, orthogonal to n_i; or NULL
   scratch    6 n     doubles to work in
   Errors: as surfmink_measure_*. Weights are not checked: what is not finite comes out again.
   On an embedded surface by_corner is at fixed normals. Where the normal is a function n(x) of the corner (a known
   surface) add its part: dE/dx_i = by_corner_i + (dn/dx)^T by_normal_i, and drop what is along n_i.
   Accuracy: within 3e-11 of the norm of the gradient in 12000 random outlines of 3 to 22 corners, most within 1e-14. A
   weight of a small mu_p costs 1 / mu_p, for it needs the direction of g_p; long smooth outlines on embedded surfaces
   up to eps n^2, for a corner gets the difference of its edges, and turns one over their length. docs/beyond.md.
   Cost: O(n P), about as much again as measuring; 16 KiB of stack. Reverse accumulation; without trigonometry. */
SURFMINK_DEF int surfmink_gradient_plane(const double *corner, size_t n, int max_rank, const surfmink_weights *weights,
                                         double *mu, double *g, surfmink_functionals *w, double *by_corner,
                                         double *scratch, size_t *bad);
SURFMINK_DEF int surfmink_gradient_sphere(const double *corner, size_t n, double radius, int max_rank,
                                          const surfmink_weights *weights, double *mu, double *g,
                                          surfmink_functionals *w, double *by_corner, double *scratch, size_t *bad);
SURFMINK_DEF int surfmink_gradient_embedded(const double *corner, const double *normal, size_t n, int max_rank,
                                            const surfmink_weights *weights, double *mu, double *g,
                                            surfmink_functionals *w, double *by_corner, double *by_normal,
                                            double *scratch, size_t *bad);

/* The same for many outlines: surfmink_batch_*, and the gradient.
   corner, normal, offset, count, radius, max_rank, out, returns  as surfmink_batch_*
   weights            one set an outline, as out->mu and the others are laid out; or shared
   by_corner, by_normal  out: of the corners of all outlines, one outline after the other, as corner; of refused
                      outlines nothing is written. A corner that several outlines share gets as many parts, which are
                      yours to add
   scratch            6 doubles for each corner before offset[count]
   Outlines do not depend on each other, as in surfmink_batch_*. Cost: O(corners P), 85 KiB of stack. */
SURFMINK_DEF size_t surfmink_batch_gradient_plane(const double *corner, const size_t *offset, size_t count,
                                                  int max_rank, const surfmink_weights *weights,
                                                  const surfmink_results *out, double *by_corner, double *scratch);
SURFMINK_DEF size_t surfmink_batch_gradient_sphere(const double *corner, const size_t *offset, size_t count,
                                                   double radius, int max_rank, const surfmink_weights *weights,
                                                   const surfmink_results *out, double *by_corner, double *scratch);
SURFMINK_DEF size_t surfmink_batch_gradient_embedded(const double *corner, const double *normal, const size_t *offset,
                                                     size_t count, int max_rank, const surfmink_weights *weights,
                                                     const surfmink_results *out, double *by_corner, double *by_normal,
                                                     double *scratch);

/* The same step by step, backwards. Step 4: weights of mu, theta and L become weights of g, those of g are added.
   g         2 P + 2  as for surfmink_spectrum
   by_g      2 P + 2  out: dE/dg_p, its parts by the real and the imaginary part of g_p
   Errors: NOT_FINITE (g), BAD_ARGUMENT (L is not positive). Cost: O(P). */
SURFMINK_DEF int surfmink_pull_spectrum(const surfmink_weights *weights, const double *g, int max_rank, double *by_g);

/* Steps 3 and 2: weights of g become weights of lengths and turning angles, as if these were free. This knows no
   surface: on one of yours, by callbacks, go on with the derivative of your log.
   by_g      2 P + 2  from surfmink_pull_spectrum
   length, turning n  from surfmink_edges_*
   by_length   n      out: dE/dl_i = Re sum_p conj(by_g_p) z_i^p with z_i = exp(i f_i)
   by_turning  n      out: dE/dalpha_i = (2 pi / S)(F_i + ... + F_(n-1)) - (1 / S) sum_j f_j F_j, where the first sum is
                      left out for i = 0, and F_j = dE/df_j = l_j Re sum_p i p conj(by_g_p) z_j^p
   Errors: as surfmink_total, and BAD_ARGUMENT (max_rank). Cost: O(n P). */
SURFMINK_DEF int surfmink_pull_edges(const double *by_g, int max_rank, const double *length, const double *turning,
                                     size_t n, double *by_length, double *by_turning);

/* Step 1: weights of lengths and turning angles become the gradient by corners, and normals. by_length and by_turning
   need not come from above: an energy of lengths and angles may be anything.
   by_length, by_turning n
   by_corner, by_normal  as surfmink_gradient_*
   Errors: as surfmink_edges_*. Cost: O(n), with twice the digits where edges cancel. */
SURFMINK_DEF int surfmink_pull_plane(const double *corner, size_t n, const double *by_length, const double *by_turning,
                                     double *by_corner, size_t *bad);
SURFMINK_DEF int surfmink_pull_sphere(const double *corner, size_t n, double radius, const double *by_length,
                                      const double *by_turning, double *by_corner, size_t *bad);
SURFMINK_DEF int surfmink_pull_embedded(const double *corner, const double *normal, size_t n, const double *by_length,
                                        const double *by_turning, double *by_corner, double *by_normal, size_t *bad);

/* --- the sphere as a surface: exp and log ------------------------------------------------------------------------- */

/* log: the tangent vector at x whose length is the great-circle distance from x to y (paper 5.1).
   x, y        3      points; only their directions count
   vector      3      out: orthogonal to x; 0 if x and y have the same direction
   Errors: NOT_FINITE, ZERO_NORMAL, ANTIPODAL_CORNERS, BAD_ARGUMENT (radius). */
SURFMINK_DEF int surfmink_sphere_log(const double x[3], const double y[3], double radius, double vector[3]);

/* exp: the point of the sphere reached from x along the tangent vector, whose part along x is dropped.
   y           3      out: on the sphere of the given radius; may be the same array as x or vector
   Errors: NOT_FINITE, ZERO_NORMAL, BAD_ARGUMENT (radius). */
SURFMINK_DEF int surfmink_sphere_exp(const double x[3], const double vector[3], double radius, double y[3]);

/* The sphere as a surface with callbacks, stride 3. *radius is read at each call and must outlive the surface. */
SURFMINK_DEF surfmink_surface surfmink_sphere(double *radius);

/* --- helpers: build, repair and convert outlines ------------------------------------------------------------------ */

/* The point of the sphere at a longitude and latitude in degrees. Quadrants are exact: -180 and 180 give the same
   point, as do all longitudes at a pole. lon in [-1e6, 1e6], lat in [-90, 90]. Errors: NOT_FINITE, BAD_ARGUMENT. */
SURFMINK_DEF int surfmink_from_lonlat(double lon, double lat, double radius, double point[3]);

/* Reverses the order of n corners (or normals) of `stride` doubles each, in place: clockwise becomes the other way. */
SURFMINK_DEF void surfmink_reverse(double *corner, size_t n, size_t stride);

/* Replaces every corner (or normal) by the mean of itself and its two neighbours, `passes` times, in place: takes the
   staircase out of pixel outlines (paper 5.3). Every pass also shrinks outlines a little. Cost: O(n passes). */
SURFMINK_DEF void surfmink_smooth(double *corner, size_t n, size_t stride, size_t passes);

/* Drops every corner that equals the one before it (the last one: the first one), in place.
   corner      n * stride
   normal      3 n    kept in step; or NULL
   On the sphere corners that differ in their distance from the centre alone are not equal, though they are coincident.
   returns            how many corners are left, at the front of the arrays */
SURFMINK_DEF size_t surfmink_merge(double *corner, double *normal, size_t n, size_t stride);

/* Corners of a regular polygon: n points at a geodesic distance from a centre, counter-clockwise, the first in the
   direction `angle` (radians) of the frame of the surface there.
   corner      n * surface->stride  out
   Errors: what exp returns, else CALLBACK_FAILED; TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT (no exp; a stride above
   16; a distance that is not positive). Cost: 2 n calls of exp, for nothing is written before all have succeeded. */
SURFMINK_DEF int surfmink_regular_polygon(const surfmink_surface *surface, const double *centre, double distance,
                                          double angle, size_t n, double *corner);

/* Points of the geodesic from x to y at the fractions 0, 1/m, ..., (m-1)/m of its length: edges laid end to end make
   an outline.
   point       m * surface->stride  out
   Errors: what log and exp return, else CALLBACK_FAILED; BAD_ARGUMENT (m = 0, no log, no exp, a stride above 16). */
SURFMINK_DEF int surfmink_edge_points(const surfmink_surface *surface, const double *x, const double *y, size_t m,
                                      double *point);

#ifdef __cplusplus
}
#endif
#endif /* SURFMINK_H */

/* ==================================================================================================================
   Implementation: the same sections in the same order. A helper stands just above its first caller.
   ================================================================================================================== */
#if (defined(SURFMINK_IMPLEMENTATION) || defined(SURFMINK_STATIC)) && !defined(SURFMINK_IMPLEMENTED)
#define SURFMINK_IMPLEMENTED

#if !defined(SURFMINK_SIN) || !defined(SURFMINK_COS) || !defined(SURFMINK_ATAN2) || !defined(SURFMINK_SQRT)
#include <math.h>
#endif
#ifndef SURFMINK_SIN
#define SURFMINK_SIN sin
#endif
#ifndef SURFMINK_COS
#define SURFMINK_COS cos
#endif
#ifndef SURFMINK_ATAN2
#define SURFMINK_ATAN2 atan2
#endif
#ifndef SURFMINK_SQRT
#define SURFMINK_SQRT sqrt
#endif

static const double surfmink__pi = 3.14159265358979323846;
static const double surfmink__two_pi = 6.28318530717958647693;
static const double surfmink__eps = 2.220446049250313e-16; /* distance from 1 to the next double */

/* Rows of corners that are worked on at a time, and ranks (three times this) that are summed in one pass over them:
   they stay in the first-level cache. Outlines of a batch that are sorted together, at most. */
#define SURFMINK__ROWS   64
#define SURFMINK__TILES  8
#define SURFMINK__WINDOW 64

/* Sets of vector instructions: which one the compiler has been told to use. */
#define SURFMINK__PLAIN  0
#define SURFMINK__SSE2   1
#define SURFMINK__AVX2   2
#define SURFMINK__AVX512 3
#define SURFMINK__NEON   4
#if defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 5)
#define SURFMINK__GNU_C
#endif
#if defined(_WIN32) && !defined(__clang__)
#define SURFMINK__NARROW /* gcc for Windows aligns the stack to 16 bytes only, whatever one asks for */
#endif
#if !defined(SURFMINK_NO_SIMD) && defined(SURFMINK__GNU_C) && defined(__STDC_HOSTED__) && __STDC_HOSTED__
#if defined(__AVX512F__) && defined(__AVX512DQ__) && !defined(SURFMINK__NARROW)
#define SURFMINK__NATIVE SURFMINK__AVX512
#elif defined(__AVX2__) && defined(__FMA__) && !defined(SURFMINK__NARROW)
#define SURFMINK__NATIVE SURFMINK__AVX2
#elif defined(__SSE2__)
#define SURFMINK__NATIVE SURFMINK__SSE2
#elif defined(__ARM_NEON) && defined(__aarch64__)
#define SURFMINK__NATIVE SURFMINK__NEON
#endif
#endif
#ifndef SURFMINK__NATIVE
#define SURFMINK__NATIVE SURFMINK__PLAIN
#endif
#if defined(SURFMINK_DISPATCH) && SURFMINK__NATIVE == SURFMINK__SSE2 && !defined(SURFMINK__NARROW)
#define SURFMINK__DISPATCHES
#endif
#if SURFMINK__NATIVE == SURFMINK__NEON
#include <arm_neon.h>
#elif SURFMINK__NATIVE != SURFMINK__PLAIN
#include <immintrin.h>
#endif
#ifndef SURFMINK_FILE
#define SURFMINK_FILE "surfmink.h"
#endif
#if SURFMINK__NATIVE != SURFMINK__PLAIN
typedef double surfmink__pair __attribute__((vector_size(16), may_alias));
#endif
#if defined(__GNUC__)
#define SURFMINK__INLINE       static __inline__ __attribute__((always_inline))
#define SURFMINK__KERNEL       static __inline__                /* no warning about what an instance does not use */
#define SURFMINK__APART        static __attribute__((noinline)) /* its stack is its own */
#define SURFMINK__PREFETCH(at) __builtin_prefetch(at)
#else
#define SURFMINK__INLINE       static
#define SURFMINK__KERNEL       static
#define SURFMINK__APART        static
#define SURFMINK__PREFETCH(at) (void)(at)
#endif

#ifdef __cplusplus
extern "C" {
#endif

SURFMINK_DEF const char *surfmink_strerror(int status)
{
    switch (status) {
    case SURFMINK_OK: return "measured";
    case SURFMINK_TOO_FEW_CORNERS: return "a polygon needs at least 3 corners";
    case SURFMINK_NOT_FINITE: return "a number is not finite";
    case SURFMINK_COINCIDENT_CORNERS: return "two neighbouring corners coincide";
    case SURFMINK_ZERO_NORMAL: return "a normal has no direction (on the sphere: a corner is the centre)";
    case SURFMINK_UPRIGHT_EDGE: return "an edge runs along the normal of the surface";
    case SURFMINK_ANTIPODAL_CORNERS: return "two neighbouring corners are antipodal: no unique edge joins them";
    case SURFMINK_CLOCKWISE: return "the corners run clockwise (their turns sum up to less than 0)";
    case SURFMINK_TOO_MUCH_CURVATURE: return "the enclosed curvature reaches 2 pi: no transport is defined";
    case SURFMINK_CROSSES_ITSELF: return "the outline crosses itself";
    case SURFMINK_CALLBACK_FAILED: return "a callback of the surface failed";
    case SURFMINK_BAD_ARGUMENT: return "an argument is out of its range";
    default: return "";
    }
}

SURFMINK_DEF const char *surfmink_status_name(int status)
{
    switch (status) {
    case SURFMINK_OK: return "ok";
    case SURFMINK_TOO_FEW_CORNERS: return "too_few_corners";
    case SURFMINK_NOT_FINITE: return "not_finite";
    case SURFMINK_COINCIDENT_CORNERS: return "coincident_corners";
    case SURFMINK_ZERO_NORMAL: return "zero_normal";
    case SURFMINK_UPRIGHT_EDGE: return "upright_edge";
    case SURFMINK_ANTIPODAL_CORNERS: return "antipodal_corners";
    case SURFMINK_CLOCKWISE: return "clockwise";
    case SURFMINK_TOO_MUCH_CURVATURE: return "too_much_curvature";
    case SURFMINK_CROSSES_ITSELF: return "crosses_itself";
    case SURFMINK_CALLBACK_FAILED: return "callback_failed";
    case SURFMINK_BAD_ARGUMENT: return "bad_argument";
    default: return "";
    }
}

/* --- arithmetic that everything below stands on ------------------------------------------------------------------- */

static double surfmink__abs(double x)
{
    return x < 0 ? -x : x;
}

enum surfmink__kind { SURFMINK__PLANE, SURFMINK__SPHERE, SURFMINK__EMBEDDED, SURFMINK__MEASURED };

/* A sum that remembers what rounding took away (two-sum): its error does not grow with the number of terms. */
typedef struct surfmink__sum {
    double high, low;
} surfmink__sum;

static void surfmink__add(surfmink__sum *sum, double x)
{
    double high = sum->high + x;
    double kept = high - sum->high;
    sum->low += (sum->high - (high - kept)) + (x - kept);
    sum->high = high;
}

static double surfmink__value(const surfmink__sum *sum)
{
    return sum->high + sum->low;
}

/* The power of two that brings a magnitude m > 0 into [2^-100, 2^100], where products of three factors neither overflow
   nor underflow. It is 1 for all but absurd units, and multiplying by it is exact. */
static double surfmink__scale(double m)
{
    double scale = 1;
    int k;
    if (m >= 7.8886090522101181e-31 && m <= 1.2676506002282294e30) return 1; /* 2^-100, 2^100 */
    for (k = 0; k < 5; ++k) {
        if (m * scale > 1.2676506002282294e30) scale *= 6.2230152778611417e-61; /* 2^-200 */
        if (m * scale < 7.8886090522101181e-31) scale *= 1.6069380442589903e60; /* 2^200 */
    }
    return scale;
}

/* Brings a normal in a column of the kernels to ordinary magnitude, if it has one. */
static void surfmink__shrink_normal(double *normal)
{
    const size_t column = SURFMINK__ROWS + 2;
    double x = surfmink__abs(normal[0]), y = surfmink__abs(normal[column]), z = surfmink__abs(normal[2 * column]),
           scale;
    if (y > x) x = y;
    if (z > x) x = z;
    if (!(x > 0 && x <= 1.7976931348623157e308)) return;
    scale = surfmink__scale(x);
    normal[0] *= scale;
    normal[column] *= scale;
    normal[2 * column] *= scale;
}

/* The same for a gradient by it, which is the larger the smaller the normal is. */
static void surfmink__scale_gradient(const double *normal, double *column)
{
    const size_t next = SURFMINK__ROWS + 2;
    double x = surfmink__abs(normal[0]), y = surfmink__abs(normal[1]), z = surfmink__abs(normal[2]), scale;
    if (y > x) x = y;
    if (z > x) x = z;
    scale = surfmink__scale(x);
    column[0] *= scale;
    column[next] *= scale;
    column[2 * next] *= scale;
}

/* What is summed over the rows of an outline: l_i, alpha_i, area, |alpha_i|, and 1 for each row that is ordinary. */
enum { SURFMINK__LENGTH, SURFMINK__TURNING, SURFMINK__AREA, SURFMINK__TURNS, SURFMINK__GOOD, SURFMINK__SUMS };

/* What of an energy is pulled back, and where its gradient goes. */
typedef struct surfmink__back {
    const surfmink_weights *weights;
    double *by_corner, *by_normal; /* or NULL: by_normal */
} surfmink__back;

/* Outlines to measure. */
typedef struct surfmink__job {
    const double *corner, *normal; /* embedded only: normal */
    const size_t *offset;
    size_t end; /* corners before the end of the batch */
    const surfmink_results *out;
    const surfmink__back *back; /* gradients, or NULL */
    double *scratch;            /* 2 doubles a corner, or NULL; gradients: 6 */
    surfmink_functionals *w;    /* of a single outline, or NULL */
    double radius;              /* of the sphere, else 1 */
    double unit;                /* of lengths that the kernels measure */
    double scale;               /* power of two that makes a single outline ordinary */
    enum surfmink__kind kind;
    int max_rank;
} surfmink__job;

#ifdef __cplusplus
}
#endif
#define SURFMINK__INSTANCE SURFMINK__PLAIN /* the formulas as single calls use them */
#define SURFMINK__REST
#endif /* SURFMINK_IMPLEMENTATION */

/* ==================================================================================================================
   Kernels: the formulas of the four steps, written once, for any number of lanes. A lane is an outline, or a strip of a
   long one. This part of the file is compiled with one lane, real = double, for the calls that measure one outline; and
   again, by including the file from itself, for every set of vector instructions that batches use. SURFMINK__(name) is
   the name of the instance at hand. A row holds one corner of each lane; stages pass over rows that stay in the
   first-level cache.
   ================================================================================================================== */
#ifdef SURFMINK__INSTANCE

#if SURFMINK__INSTANCE == SURFMINK__PLAIN
#define SURFMINK__(name) surfmink__##name
#define SURFMINK__LANES  ((size_t)1)
#define SURFMINK__ALIGNED
#define SURFMINK__WIDTH            1
#define SURFMINK__GANG             1
#define surfmink__real             double
#define surfmink__mask             int
#define SURFMINK__SET(x)           (x)
#define SURFMINK__LOAD(at)         (*(at))
#define SURFMINK__STORE(at, x)     (*(at) = (x))
#define SURFMINK__LOAD_ANY(at)     (*(at))
#define SURFMINK__STORE_ANY(at, x) (*(at) = (x))
#define SURFMINK__MIN(a, b)        ((a) < (b) ? (a) : (b))
#define SURFMINK__MAX(a, b)        ((a) > (b) ? (a) : (b))
#define SURFMINK__ABS(a)           surfmink__abs(a)
#define SURFMINK__LESS(a, b)       ((a) < (b))
#define SURFMINK__SELECT(m, a, b)  ((m) ? (a) : (b))
#define SURFMINK__WHERE(m, a)      ((m) ? (a) : 0)
#define SURFMINK__SIGNED(a, s)     ((s) < 0 ? -(a) : (a))
#define SURFMINK__ROOT(a)          SURFMINK_SQRT(a)
#define SURFMINK__SCALED(a, s)     ((a) * (s))
#define SURFMINK__RATIO(a, b)      ((a) / (b))
#else
#define SURFMINK__LANES            ((size_t)8)
#define SURFMINK__GANG             2
#define SURFMINK__ALIGNED          __attribute__((aligned(64)))
#define surfmink__real             SURFMINK__(real)
#define surfmink__mask             SURFMINK__(mask)
#define SURFMINK__SET(x)           ((x)-SURFMINK__(zero))
#define SURFMINK__LOAD(at)         (*(const SURFMINK__(loaded) *)(const void *)(at))
#define SURFMINK__STORE(at, x)     (*(SURFMINK__(loaded) *)(void *)(at) = (x))
#define SURFMINK__LOAD_ANY(at)     (*(const SURFMINK__(caller) *)(const void *)(at)) /* the caller's memory */
#define SURFMINK__STORE_ANY(at, x) (*(SURFMINK__(caller) *)(void *)(at) = (x))
#define SURFMINK__SIGN             ((surfmink__mask)SURFMINK__SET(-0.0))
#define SURFMINK__ABS(a)           ((surfmink__real)(~SURFMINK__SIGN & (surfmink__mask)(a)))
#define SURFMINK__LESS(a, b)       ((surfmink__mask)((a) < (b)))
#define SURFMINK__SELECT(m, a, b)  ((surfmink__real)(((m) & (surfmink__mask)(a)) | (~(m) & (surfmink__mask)(b))))
#define SURFMINK__WHERE(m, a)      ((surfmink__real)((m) & (surfmink__mask)(a)))
/* -a where the mask is set; where s < 0; where k, an integer plus 1.5 * 2^52, is odd */
#define SURFMINK__NEGATE(m, a)     ((surfmink__real)(((m)&SURFMINK__SIGN) ^ (surfmink__mask)(a)))
#define SURFMINK__SIGNED(a, s)     SURFMINK__NEGATE((surfmink__mask)(s), a)
#define SURFMINK__ODD(a, k)        SURFMINK__NEGATE((surfmink__mask)(k) << 63, a)
#define SURFMINK__SCALED(a, s)     (a) /* in batches s is 1 */
/* 0 for b = 0, behind short lanes */
#define SURFMINK__RATIO(a, b)      SURFMINK__WHERE(SURFMINK__LESS(SURFMINK__(zero), b), (a) / (b))
#endif
#if SURFMINK__INSTANCE == SURFMINK__SSE2
#define SURFMINK__(name)     surfmink__##name##_sse2
#define SURFMINK__WIDTH      2
#define SURFMINK__MIN(a, b)  _mm_min_pd(a, b)
#define SURFMINK__MAX(a, b)  _mm_max_pd(a, b)
#define SURFMINK__ROOT(a)    _mm_sqrt_pd(a)
#define SURFMINK__BARRIER(a) __asm__("" : "+x"(a))
#elif SURFMINK__INSTANCE == SURFMINK__AVX2
#define SURFMINK__(name)        surfmink__##name##_avx2
#define SURFMINK__WIDTH         4
#define SURFMINK__MIN(a, b)     _mm256_min_pd(a, b)
#define SURFMINK__MAX(a, b)     _mm256_max_pd(a, b)
#define SURFMINK__ROOT(a)       _mm256_sqrt_pd(a)
#define SURFMINK__FMA(a, b, c)  _mm256_fmadd_pd(a, b, c)
#define SURFMINK__FNMA(a, b, c) _mm256_fnmadd_pd(a, b, c)
#define SURFMINK__BARRIER(a)    __asm__("" : "+x"(a))
#elif SURFMINK__INSTANCE == SURFMINK__AVX512
#define SURFMINK__(name)        surfmink__##name##_avx512
#define SURFMINK__WIDTH         8
/* all lanes of masked ones, for g++ 12 warns about what its header does in the others */
#define SURFMINK__MIN(a, b)     _mm512_maskz_min_pd((__mmask8)-1, a, b)
#define SURFMINK__MAX(a, b)     _mm512_maskz_max_pd((__mmask8)-1, a, b)
#define SURFMINK__ROOT(a)       _mm512_maskz_sqrt_pd((__mmask8)-1, a)
#define SURFMINK__FMA(a, b, c)  _mm512_fmadd_pd(a, b, c)
#define SURFMINK__FNMA(a, b, c) _mm512_fnmadd_pd(a, b, c)
#define SURFMINK__BARRIER(a)    __asm__("" : "+v"(a))
#elif SURFMINK__INSTANCE == SURFMINK__NEON
#define SURFMINK__(name)        surfmink__##name##_neon
#define SURFMINK__WIDTH         2
#define SURFMINK__MIN(a, b)     ((surfmink__real)vminq_f64((float64x2_t)(a), (float64x2_t)(b)))
#define SURFMINK__MAX(a, b)     ((surfmink__real)vmaxq_f64((float64x2_t)(a), (float64x2_t)(b)))
#define SURFMINK__ROOT(a)       ((surfmink__real)vsqrtq_f64((float64x2_t)(a)))
#define SURFMINK__FMA(a, b, c)  ((surfmink__real)vfmaq_f64((float64x2_t)(c), (float64x2_t)(a), (float64x2_t)(b)))
#define SURFMINK__FNMA(a, b, c) ((surfmink__real)vfmsq_f64((float64x2_t)(c), (float64x2_t)(a), (float64x2_t)(b)))
#define SURFMINK__BARRIER(a)    __asm__("" : "+w"(a))
#endif
#ifndef SURFMINK__FMA /* a b + c and c - a b */
#define SURFMINK__FMA(a, b, c)  ((a) * (b) + (c))
#define SURFMINK__FNMA(a, b, c) ((c) - (a) * (b))
#endif
#define SURFMINK__COLUMN ((SURFMINK__ROWS + 2) * SURFMINK__LANES)

#if SURFMINK__INSTANCE != SURFMINK__PLAIN
typedef double surfmink__real __attribute__((vector_size(8 * SURFMINK__WIDTH)));
typedef double SURFMINK__(loaded) __attribute__((vector_size(8 * SURFMINK__WIDTH), may_alias));
typedef double SURFMINK__(caller) __attribute__((vector_size(8 * SURFMINK__WIDTH), may_alias, aligned(8)));
typedef __INT64_TYPE__ surfmink__mask __attribute__((vector_size(8 * SURFMINK__WIDTH)));
static const surfmink__real SURFMINK__(zero) = {0};
#endif

/* What a group of lanes is measured in: 37 KiB for eight. Coordinates x y (z), and normals, come in columns, in which
   row -1 holds the corner before the first. When all angles are known, columns 2 and 3 hold z_i = exp(i f_i), and
   length and turned the real and imaginary part of l_i z_i^p. */
typedef struct SURFMINK__ALIGNED SURFMINK__(rows) {
    double column[6][SURFMINK__COLUMN];
    double length[SURFMINK__ROWS * SURFMINK__LANES]; /* l_i */
    double turned[SURFMINK__ROWS * SURFMINK__LANES]; /* the sine of alpha_i, then alpha_0 + ... + alpha_i */
    double cosine[SURFMINK__ROWS * SURFMINK__LANES];
    double first[3][2 * SURFMINK__LANES]; /* strips: corners 0 and 1 of the outline, in columns */
} SURFMINK__(rows);

/* Sums over the rows of each lane, and what else is known of it. */
typedef struct SURFMINK__ALIGNED SURFMINK__(totals) {
    double sum[SURFMINK__SUMS][SURFMINK__LANES];
    double known[SURFMINK__LANES];    /* S, as well as it can be known */
    double sharpest[SURFMINK__LANES]; /* largest |alpha_i| */
    double widest[SURFMINK__LANES];   /* largest |alpha_0 + ... + alpha_i| */
    double largest[SURFMINK__LANES];  /* largest sine or cosine, whose common factor is that of the unit */
    double expected[SURFMINK__LANES]; /* good rows, if all are */
    double behind[SURFMINK__LANES];   /* turns between the middle of edge 0 and the lane */
} SURFMINK__(totals);

/* What gradients need beside: 31 KiB for eight lanes. What is kept of the rows while z_i takes its place; dE/dl_i
   without by_all, and dE/df_i / l_i, of the ranks pulled so far; and of each lane what settle() says. */
typedef struct SURFMINK__ALIGNED SURFMINK__(tape) {
    double column[2][SURFMINK__ROWS * SURFMINK__LANES]; /* columns 2 and 3 */
    double length[SURFMINK__ROWS * SURFMINK__LANES];    /* l_i */
    double turned[SURFMINK__ROWS * SURFMINK__LANES];    /* alpha_0 + ... + alpha_i */
    double by_length[SURFMINK__ROWS * SURFMINK__LANES];
    double by_phase[SURFMINK__ROWS * SURFMINK__LANES];
    double by_g[SURFMINK__LANES * 6 * SURFMINK__TILES];  /* conj(dE/dg_p) of the ranks at hand */
    double by_all[SURFMINK__LANES];                      /* dE/dL */
    double sum[SURFMINK__LANES];                         /* of F_i = dE/df_i */
    double moment[SURFMINK__LANES];                      /* of F_i times the turns since edge 0 */
    double starts[SURFMINK__LANES];                      /* 1 if row 0 is corner 0 of the outline, else 0 */
    double factor[SURFMINK__LANES];                      /* 2 pi / S */
    double base[SURFMINK__LANES];                        /* dE/dalpha_0 */
    double suffix[SURFMINK__LANES];                      /* 2 pi / S times the sum of F_i behind the rows at hand */
    double over[6][SURFMINK__LANES];                     /* what a lane gives to the corner (and normal) behind it */
    double by_mu[SURFMINK__LANES * 3 * SURFMINK__TILES]; /* weights of the ranks at hand */
    double by_theta[SURFMINK__LANES * 3 * SURFMINK__TILES];
    double tail[6 * SURFMINK__LANES]; /* strips: the last row of the scratch */
} SURFMINK__(tape);

/* Three ranks of each lane, a row each (g_p: two). */
typedef struct SURFMINK__ALIGNED SURFMINK__(ranks) {
    double g[6 * SURFMINK__LANES], mu[3 * SURFMINK__LANES], theta[3 * SURFMINK__LANES];
} SURFMINK__(ranks);

/* --- vectors ------------------------------------------------------------------------------------------------------ */

SURFMINK__INLINE surfmink__real SURFMINK__(dot)(const surfmink__real a[3], const surfmink__real b[3])
{
    return SURFMINK__FMA(a[2], b[2], SURFMINK__FMA(a[1], b[1], a[0] * b[0]));
}

SURFMINK__INLINE void SURFMINK__(cross)(const surfmink__real a[3], const surfmink__real b[3], surfmink__real c[3])
{
    c[0] = SURFMINK__FNMA(a[2], b[1], a[1] * b[2]);
    c[1] = SURFMINK__FNMA(a[0], b[2], a[2] * b[0]);
    c[2] = SURFMINK__FNMA(a[1], b[0], a[0] * b[1]);
}

/* Components and normals of one row. */
SURFMINK__INLINE void SURFMINK__(load)(const double *at, surfmink__real v[3])
{
    v[0] = SURFMINK__LOAD(at);
    v[1] = SURFMINK__LOAD(at + SURFMINK__COLUMN);
    v[2] = SURFMINK__LOAD(at + 2 * SURFMINK__COLUMN);
}

SURFMINK__INLINE void SURFMINK__(subtract)(const surfmink__real a[3], const surfmink__real b[3],
                                           surfmink__real difference[3])
{
    difference[0] = a[0] - b[0];
    difference[1] = a[1] - b[1];
    difference[2] = a[2] - b[2];
}

/* Adds a length to a sum of lengths that remembers what rounding took away. */
SURFMINK__INLINE void SURFMINK__(add_length)(surfmink__real length, surfmink__real *sum, surfmink__real *lost)
{
    surfmink__real high = *sum + length;
    *lost = *lost + (length - (high - *sum));
    *sum = high;
}

/* --- angles ------------------------------------------------------------------------------------------------------- */

#if SURFMINK__INSTANCE == SURFMINK__PLAIN
SURFMINK__KERNEL double surfmink__atan2(double y, double x)
{
    return SURFMINK_ATAN2(y, x);
}

/* exp(2 pi i t) */
SURFMINK__KERNEL void surfmink__turns(double t, double *re, double *im)
{
    *re = SURFMINK_COS(surfmink__two_pi * t);
    *im = SURFMINK_SIN(surfmink__two_pi * t);
}

/* Angle at the centre of an arc of the unit sphere from its chord and the square of that, up to a right angle. */
SURFMINK__KERNEL double surfmink__arc_angle(double chord, double square)
{
    return 2 * SURFMINK_ATAN2(chord, SURFMINK_SQRT(4 - square));
}
#else
/* a + b u + ..., even and odd powers apart: two chains of half the length. Coefficients here and below interpolate at
   Chebyshev's points; tests/accuracy/kernels.c computes and checks them. */
#define SURFMINK__2(a, b)        SURFMINK__FMA(u, SURFMINK__SET(b), SURFMINK__SET(a))
#define SURFMINK__3(a, b, c)     SURFMINK__FMA(uu, SURFMINK__SET(c), SURFMINK__2(a, b))
#define SURFMINK__UP(rest, a, b) SURFMINK__FMA(uu, rest, SURFMINK__2(a, b))

/* Angle of (x, y) in [-pi, pi], 0 of (0, 0), for magnitudes from 1e-150 to 1e150: a ratio within tan(pi / 8) of 0, then
   pi / 4, pi / 2 or pi from there. Multiples of 45 degrees are exact. Worst error in 1e7 angles: 4.7e-16, at y, x =
   0x1.ea6a22f06107p+0, -0x1.cfdbd8f7eede1p-1; relative 3.6e-16. */
SURFMINK__INLINE surfmink__real SURFMINK__(atan2)(surfmink__real y, surfmink__real x)
{
    surfmink__real across = SURFMINK__ABS(y), along = SURFMINK__ABS(x), t, u, uu, angle;
    surfmink__real low = SURFMINK__MIN(across, along);
    surfmink__real high = SURFMINK__MAX(SURFMINK__MAX(across, along), SURFMINK__SET(1e-300));
    surfmink__mask wide = SURFMINK__LESS(SURFMINK__SET(0.41421356237309503) * high, low);
    surfmink__mask steep = SURFMINK__LESS(along, across), back = SURFMINK__LESS(x, SURFMINK__SET(0.0));
    t = (low - SURFMINK__WHERE(wide, high)) / (high + SURFMINK__WHERE(wide, low));
    u = t * t;
    uu = u * u;
    angle = SURFMINK__3(-0.050854497379402598, 0.039231658295587189, -0.01917688711906226);
    angle = SURFMINK__UP(angle, -0.066645114473819475, 0.0585814891280221);
    angle = SURFMINK__UP(angle, -0.090909045781239026, 0.076921831908260865);
    angle = SURFMINK__UP(angle, -0.14285714284666542, 0.11111111015256361);
    angle = SURFMINK__UP(angle, -0.33333333333333331, 0.19999999999995521);
    angle = SURFMINK__FMA(t * u, angle, t) + SURFMINK__WHERE(wide, SURFMINK__SET(0.78539816339744831));
    angle = SURFMINK__NEGATE(steep, angle) + SURFMINK__WHERE(steep, SURFMINK__SET(1.5707963267948966));
    angle = SURFMINK__NEGATE(back, angle) + SURFMINK__WHERE(back, SURFMINK__SET(3.1415926535897931));
    return SURFMINK__SIGNED(angle, y);
}

/* exp(2 pi i t), |t| < 2^50: (-1)^k exp(pi i r) with an integer k and |r| <= 1/2, both exact. Worst error of either
   part in 1e7 angles: 4.0e-16, at t = 0x1.000004164239ap-2. */
SURFMINK__INLINE void SURFMINK__(turns)(surfmink__real t, surfmink__real *re, surfmink__real *im)
{
    const surfmink__real two = SURFMINK__SET(2.0), magic = SURFMINK__SET(6755399441055744.0); /* 1.5 * 2^52 */
    surfmink__real k = SURFMINK__FMA(two, t, magic), r, u, cosine, sine;
    SURFMINK__BARRIER(k); /* or -ffast-math would see that k - magic is 2 t */
    r = SURFMINK__FMA(two, t, magic - k);
    u = r * r;
    cosine = SURFMINK__FMA(u, SURFMINK__SET(4.1663994627269487e-06), SURFMINK__SET(-0.00010458286368326585));
    cosine = SURFMINK__FMA(u, cosine, SURFMINK__SET(0.001929562652479866));
    cosine = SURFMINK__FMA(u, cosine, SURFMINK__SET(-0.025806890025875391));
    cosine = SURFMINK__FMA(u, cosine, SURFMINK__SET(0.2353306302721577));
    cosine = SURFMINK__FMA(u, cosine, SURFMINK__SET(-1.3352627688518803));
    cosine = SURFMINK__FMA(u, cosine, SURFMINK__SET(4.0587121264167356));
    cosine = SURFMINK__FMA(u, cosine, SURFMINK__SET(-4.934802200544679));
    sine = SURFMINK__FMA(u, SURFMINK__SET(7.725743030789876e-07), SURFMINK__SET(-2.1906201655131958e-05));
    sine = SURFMINK__FMA(u, sine, SURFMINK__SET(0.00046630087411496363));
    sine = SURFMINK__FMA(u, sine, SURFMINK__SET(-0.0073704307196345862));
    sine = SURFMINK__FMA(u, sine, SURFMINK__SET(0.082145886596752316));
    sine = SURFMINK__FMA(u, sine, SURFMINK__SET(-0.59926452932034302));
    sine = SURFMINK__FMA(u, sine, SURFMINK__SET(2.5501640398773402));
    sine = SURFMINK__FMA(u, sine, SURFMINK__SET(-5.1677127800499703));
    *re = SURFMINK__ODD(SURFMINK__FMA(u, cosine, SURFMINK__SET(1.0)), k);
    *im = SURFMINK__ODD(r * SURFMINK__FMA(u, sine, SURFMINK__SET(3.1415926535897931)), k);
}

/* 2 asin(chord / 2) for a chord up to 1, u its square. Worst relative error in 1e6 chords: 1.3e-16, at
   0x1.fb11f0d3ba763p-1. */
SURFMINK__INLINE surfmink__real SURFMINK__(arc_angle)(surfmink__real chord, surfmink__real u)
{
    surfmink__real uu = u * u, angle;
    angle = SURFMINK__3(4.1486929518446973e-09, -8.8524145312590621e-10, 4.28525378814661e-10);
    angle = SURFMINK__UP(angle, 3.9378411675208203e-08, 5.2046839891818601e-09);
    angle = SURFMINK__UP(angle, 8.5273516684283038e-07, 1.7515834678932046e-07);
    angle = SURFMINK__UP(angle, 2.1847825138818251e-05, 4.2364240041186456e-06);
    angle = SURFMINK__UP(angle, 0.00069754464291180358, 0.00011867946929113768);
    angle = SURFMINK__UP(angle, 0.041666666666666671, 0.0046874999999990206);
    return SURFMINK__FMA(chord * u, angle, chord);
}
#endif

/* --- 1. measure: corners -> lengths, turning angles --------------------------------------------------------------- */

/* Sine and cosine, up to a common factor, of the turn from edge a to edge b in the plane orthogonal to n:
   n . (a x b) and a . b - (a . n)(b . n) for unit n. a x b is a x (b - a) or b x (b - a), whichever edge is shorter: at
   nearly straight corners that does not cancel. aa, bb, nn are the squares of the vectors, norm = |n|, bn = b . n. */
SURFMINK__INLINE void SURFMINK__(turn)(const surfmink__real a[3], surfmink__real aa, const surfmink__real b[3],
                                       surfmink__real bb, const surfmink__real n[3], surfmink__real nn,
                                       surfmink__real norm, surfmink__real bn, surfmink__real *sine,
                                       surfmink__real *cosine)
{
    surfmink__real shorter[3], d[3], cross[3];
    surfmink__mask less = SURFMINK__LESS(aa, bb);
    *cosine = SURFMINK__FNMA(SURFMINK__(dot)(a, n), bn, nn * SURFMINK__(dot)(a, b));
    SURFMINK__(subtract)(b, a, d);
    shorter[0] = SURFMINK__SELECT(less, a[0], b[0]);
    shorter[1] = SURFMINK__SELECT(less, a[1], b[1]);
    shorter[2] = SURFMINK__SELECT(less, a[2], b[2]);
    SURFMINK__(cross)(shorter, d, cross);
    *sine = norm * SURFMINK__(dot)(n, cross);
}

/* 1 where neither edge of a turn is steep against the tangent plane, zero, or out of range: `size` is what the larger
   one of sine and cosine comes to if both edges are tangent; gradients divide by the square of `length`. NaN is not
   less. */
SURFMINK__INLINE surfmink__real SURFMINK__(ordinary)(surfmink__real larger, surfmink__real size, surfmink__real length)
{
    surfmink__mask good = SURFMINK__LESS(SURFMINK__FMA(SURFMINK__SET(0.35), size, SURFMINK__SET(1e-200)), larger);
    good = good & SURFMINK__LESS(SURFMINK__SET(1e-140), length);
    return SURFMINK__WHERE(good, SURFMINK__SET(1.0));
}

/* Straight edges between points of a surface in space. */
SURFMINK__KERNEL void SURFMINK__(edges_embedded)(SURFMINK__(rows) *r, size_t rows, SURFMINK__(totals) *t)
{
    surfmink__real x[3], a[3], b[3], n[3], aa, bb, nn, before, length, sine, cosine, larger, sum, lost, good, most;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        sum = lost = good = SURFMINK__SET(0.0);
        most = SURFMINK__LOAD(t->largest + lane);
        SURFMINK__(load)(r->column[0] + lane, x);
        SURFMINK__(load)(r->column[0] + lane + SURFMINK__LANES, a);
        SURFMINK__(subtract)(a, x, a);
        aa = SURFMINK__(dot)(a, a);
        before = SURFMINK__ROOT(aa);
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            SURFMINK__(load)(r->column[0] + i + SURFMINK__LANES, x);
            SURFMINK__(load)(r->column[0] + i + 2 * SURFMINK__LANES, b);
            SURFMINK__(subtract)(b, x, b);
            bb = SURFMINK__(dot)(b, b);
            length = SURFMINK__ROOT(bb);
            SURFMINK__(add_length)(length, &sum, &lost);
            SURFMINK__STORE(r->length + i, length);
            SURFMINK__(load)(r->column[3] + i + SURFMINK__LANES, n);
            nn = SURFMINK__(dot)(n, n);
            SURFMINK__(turn)(a, aa, b, bb, n, nn, SURFMINK__ROOT(nn), SURFMINK__(dot)(b, n), &sine, &cosine);
            SURFMINK__STORE(r->turned + i, sine);
            SURFMINK__STORE(r->cosine + i, cosine);
            larger = SURFMINK__MAX(SURFMINK__ABS(sine), SURFMINK__ABS(cosine));
            most = SURFMINK__MAX(most, larger);
            good = good + SURFMINK__(ordinary)(larger, nn * before * length, length);
            a[0] = b[0];
            a[1] = b[1];
            a[2] = b[2];
            aa = bb;
            before = length;
        }
        SURFMINK__STORE(t->sum[SURFMINK__LENGTH] + lane, sum + lost);
        SURFMINK__STORE(t->sum[SURFMINK__GOOD] + lane, good);
        SURFMINK__STORE(t->largest + lane, most);
    }
}

/* Great-circle edges of the unit sphere, of corners that may lie a little off it. The direction of an edge in the
   tangent plane is that of the chord; its length needs the chord within the sphere, whose square is
   (|y - x|^2 - (|y| - |x|)^2) / |x||y|. A fan of triangles (p, x, y) from the first corner has the solid angle 2 arg of
   the product of 1 + i p.(x x y) / (|p||x||y| + |y| p.x + |p| x.y + |x| y.p). */
SURFMINK__KERNEL void SURFMINK__(edges_sphere)(SURFMINK__(rows) *r, size_t rows, const double *first, size_t stride,
                                               SURFMINK__(totals) *t)
{
    surfmink__real p[3], x[3], y[3], a[3], b[3], c[3], aa, bb, bn, xx, yy, p_norm, x_norm, y_norm, px, py, norms;
    surfmink__real sine, cosine, square, length, rise, around, sum, lost, good, re, im, part, below;
    surfmink__mask fine;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        sum = lost = good = im = SURFMINK__SET(0.0);
        re = SURFMINK__SET(1.0);
        p[0] = SURFMINK__LOAD(first + lane);
        p[1] = SURFMINK__LOAD(first + lane + stride);
        p[2] = SURFMINK__LOAD(first + lane + 2 * stride);
        SURFMINK__(load)(r->column[0] + lane, y);
        SURFMINK__(load)(r->column[0] + lane + SURFMINK__LANES, x);
        SURFMINK__(subtract)(x, y, a);
        aa = SURFMINK__(dot)(a, a);
        xx = SURFMINK__(dot)(x, x);
        px = SURFMINK__(dot)(p, x);
        p_norm = SURFMINK__ROOT(SURFMINK__(dot)(p, p));
        x_norm = SURFMINK__ROOT(xx);
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            SURFMINK__(load)(r->column[0] + i + 2 * SURFMINK__LANES, y);
            SURFMINK__(subtract)(y, x, b);
            bb = SURFMINK__(dot)(b, b);
            bn = SURFMINK__(dot)(b, x);
            yy = SURFMINK__(dot)(y, y);
            y_norm = SURFMINK__ROOT(yy);
            SURFMINK__(turn)(a, aa, b, bb, x, xx, x_norm, bn, &sine, &cosine);
            rise = SURFMINK__FMA(SURFMINK__SET(2.0), bn, bb); /* |y|^2 - |x|^2 */
            rise = rise * rise;
            around = (x_norm + y_norm) * (x_norm + y_norm);
            norms = x_norm * y_norm;
            square = (bb * around - rise) / SURFMINK__MAX(around * norms, SURFMINK__SET(1e-300));
            square = SURFMINK__MAX(square, SURFMINK__SET(0.0));
            length = SURFMINK__(arc_angle)(SURFMINK__ROOT(square), square);
            SURFMINK__(subtract)(x, p, c);
            SURFMINK__(cross)(c, b, a);
            py = SURFMINK__(dot)(p, y);
            norms = norms * p_norm;
            below = SURFMINK__FMA(y_norm, px, norms);
            below = SURFMINK__FMA(p_norm, xx + bn, SURFMINK__FMA(x_norm, py, below));
            part = SURFMINK__(dot)(p, a) / SURFMINK__MAX(below, SURFMINK__SET(1e-300));
            c[0] = SURFMINK__FNMA(im, part, re);
            im = SURFMINK__FMA(re, part, im);
            re = c[0];
            fine = SURFMINK__LESS(SURFMINK__FMA(SURFMINK__SET(2.0), rise, SURFMINK__SET(1e-200)), bb * around);
            fine = fine & SURFMINK__LESS(square, SURFMINK__SET(1.0)) & SURFMINK__LESS(norms, below);
            good = good + SURFMINK__WHERE(fine, SURFMINK__SET(1.0));
            SURFMINK__(add_length)(length, &sum, &lost);
            SURFMINK__STORE(r->length + i, length);
            SURFMINK__STORE(r->turned + i, sine);
            SURFMINK__STORE(r->cosine + i, cosine);
            x[0] = y[0];
            x[1] = y[1];
            x[2] = y[2];
            a[0] = b[0];
            a[1] = b[1];
            a[2] = b[2];
            aa = bb;
            xx = yy;
            px = py;
            x_norm = y_norm;
        }
        SURFMINK__STORE(t->sum[SURFMINK__LENGTH] + lane, sum + lost);
        SURFMINK__STORE(t->sum[SURFMINK__GOOD] + lane, good);
        SURFMINK__STORE(t->sum[SURFMINK__AREA] + lane, SURFMINK__SET(2.0) * SURFMINK__(atan2)(im, re));
    }
}

/* The plane needs no angles: z_i = exp(i f_i) is the direction of edge i against that of edge 0, and S is 2 pi times
   the number of times that the direction of the edges passes the x axis, to the left less to the right. */
SURFMINK__KERNEL void SURFMINK__(edges_plane)(SURFMINK__(rows) *r, size_t rows, const double *first, size_t stride,
                                              SURFMINK__(totals) *t)
{
    surfmink__real p[2], u[2], x[2], y[2], a[2], b[2], d[2], length, inverse, cross, along, re, im;
    surfmink__real sum, lost, good, area, turns, least, zero = SURFMINK__SET(0.0), one = SURFMINK__SET(1.0);
    surfmink__mask fine, passes, a_below, b_below;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        sum = lost = good = area = turns = zero;
        p[0] = SURFMINK__LOAD(first + lane);
        p[1] = SURFMINK__LOAD(first + lane + stride);
        u[0] = SURFMINK__LOAD(first + lane + SURFMINK__LANES) - p[0];
        u[1] = SURFMINK__LOAD(first + lane + SURFMINK__LANES + stride) - p[1];
        length = SURFMINK__ROOT(SURFMINK__FMA(u[1], u[1], u[0] * u[0]));
        inverse = one / SURFMINK__MAX(length, SURFMINK__SET(1e-300));
        u[0] = u[0] * inverse;
        u[1] = u[1] * inverse;
        x[0] = SURFMINK__LOAD(r->column[0] + lane + SURFMINK__LANES);
        x[1] = SURFMINK__LOAD(r->column[1] + lane + SURFMINK__LANES);
        a[0] = x[0] - SURFMINK__LOAD(r->column[0] + lane);
        a[1] = x[1] - SURFMINK__LOAD(r->column[1] + lane);
        a_below = SURFMINK__LESS(a[1], zero);
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            y[0] = SURFMINK__LOAD(r->column[0] + i + 2 * SURFMINK__LANES);
            y[1] = SURFMINK__LOAD(r->column[1] + i + 2 * SURFMINK__LANES);
            b[0] = y[0] - x[0];
            b[1] = y[1] - x[1];
            length = SURFMINK__ROOT(SURFMINK__FMA(b[1], b[1], b[0] * b[0]));
            cross = SURFMINK__FNMA(a[1], b[0], a[0] * b[1]);
            along = SURFMINK__FMA(a[1], b[1], a[0] * b[0]);
            b_below = SURFMINK__LESS(b[1], zero);
            passes = a_below ^ b_below;
            /* no spike, no edge of length 0, nothing out of range, no pass to a side that cannot be told */
            least = SURFMINK__FNMA(SURFMINK__SET(4e-15), along, SURFMINK__SET(1e-250));
            least = SURFMINK__SELECT(passes, SURFMINK__MAX(least, SURFMINK__SET(1e-250)), least);
            fine = SURFMINK__LESS(least, SURFMINK__ABS(cross));
            fine = fine & SURFMINK__LESS(SURFMINK__SET(1e-140), length);
            passes = passes & (b_below ^ SURFMINK__LESS(zero, cross));
            d[0] = x[0] - p[0];
            d[1] = x[1] - p[1];
            re = SURFMINK__FMA(b[1], u[1], b[0] * u[0]);
            im = SURFMINK__FNMA(b[0], u[1], b[1] * u[0]);
            inverse = one / SURFMINK__MAX(length, SURFMINK__SET(1e-300));
            SURFMINK__(add_length)(length, &sum, &lost);
            good = good + SURFMINK__WHERE(fine, one);
            turns = turns + SURFMINK__WHERE(passes, SURFMINK__SIGNED(one, cross));
            area = area + SURFMINK__FNMA(d[1], b[0], d[0] * b[1]);
            SURFMINK__STORE(r->length + i, re);
            SURFMINK__STORE(r->turned + i, im);
            SURFMINK__STORE(r->cosine + i, length); /* there is no cosine; gradients want l_i */
            SURFMINK__STORE(r->column[2] + i, re * inverse);
            SURFMINK__STORE(r->column[3] + i, im * inverse);
            x[0] = y[0];
            x[1] = y[1];
            a[0] = b[0];
            a[1] = b[1];
            a_below = b_below;
        }
        SURFMINK__STORE(t->sum[SURFMINK__LENGTH] + lane, sum + lost);
        SURFMINK__STORE(t->sum[SURFMINK__GOOD] + lane, good);
        SURFMINK__STORE(t->sum[SURFMINK__AREA] + lane, SURFMINK__SET(0.5) * area);
        SURFMINK__STORE(t->sum[SURFMINK__TURNING] + lane, SURFMINK__SET(6.2831853071795865) * turns);
    }
}

/* --- 2. transport: turning angles -> phases ----------------------------------------------------------------------- */

/* turned_i = alpha_0 + ... + alpha_i of the rows at hand, whose sum is the last of them. */
SURFMINK__KERNEL void SURFMINK__(angles)(SURFMINK__(rows) *r, size_t rows, SURFMINK__(totals) *t)
{
    surfmink__real angle, size, sum, lost, turned, turns, sharpest, widest;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        sum = lost = turned = turns = SURFMINK__SET(0.0);
        sharpest = SURFMINK__LOAD(t->sharpest + lane);
        widest = SURFMINK__SET(0.0);
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            angle = SURFMINK__(atan2)(SURFMINK__LOAD(r->turned + i), SURFMINK__LOAD(r->cosine + i));
            size = SURFMINK__ABS(angle);
            SURFMINK__(add_length)(angle, &sum, &lost);
            turned = sum + lost;
            turns = turns + size;
            sharpest = SURFMINK__MAX(sharpest, size);
            widest = SURFMINK__MAX(widest, SURFMINK__ABS(turned));
            SURFMINK__STORE(r->turned + i, turned);
        }
        SURFMINK__STORE(t->sum[SURFMINK__TURNING] + lane, turned);
        SURFMINK__STORE(t->sum[SURFMINK__TURNS] + lane, turns);
        SURFMINK__STORE(t->sharpest + lane, sharpest);
        SURFMINK__STORE(t->widest + lane, widest);
    }
}

/* z_i = exp(i f_i) with f_i = 2 pi (base + turned_i) / S, and l_i z_i. */
SURFMINK__KERNEL void SURFMINK__(phases)(SURFMINK__(rows) *r, size_t rows, const double *base, const double *turning)
{
    surfmink__real start, inverse, length, re, im;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        start = SURFMINK__LOAD(base + lane);
        inverse = SURFMINK__SET(1.0) / SURFMINK__LOAD(turning + lane);
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            length = SURFMINK__LOAD(r->length + i);
            SURFMINK__(turns)((start + SURFMINK__LOAD(r->turned + i)) * inverse, &re, &im);
            SURFMINK__STORE(r->column[2] + i, re);
            SURFMINK__STORE(r->column[3] + i, im);
            SURFMINK__STORE(r->length + i, length * re);
            SURFMINK__STORE(r->turned + i, length * im);
        }
    }
}

/* --- 3. integrate: lengths, phases -> irreducible components ------------------------------------------------------ */

/* w becomes w z. */
SURFMINK__INLINE void SURFMINK__(multiply)(surfmink__real *re, surfmink__real *im, surfmink__real z_re,
                                           surfmink__real z_im)
{
    surfmink__real t = SURFMINK__FNMA(*im, z_im, *re * z_re);
    *im = SURFMINK__FMA(*im, z_re, *re * z_im);
    *re = t;
}

/* w becomes w z^p, by repeated squaring. */
SURFMINK__KERNEL void SURFMINK__(raise)(SURFMINK__(rows) *r, size_t rows, int p)
{
    surfmink__real re, im, x, y;
    size_t i;
    int left;
    for (i = 0; i < rows * SURFMINK__LANES && p > 0; i += SURFMINK__WIDTH) {
        re = SURFMINK__LOAD(r->length + i);
        im = SURFMINK__LOAD(r->turned + i);
        x = SURFMINK__LOAD(r->column[2] + i);
        y = SURFMINK__LOAD(r->column[3] + i);
        for (left = p; left > 0; left /= 2) {
            if (left % 2) SURFMINK__(multiply)(&re, &im, x, y);
            SURFMINK__(multiply)(&x, &y, x, y);
        }
        SURFMINK__STORE(r->length + i, re);
        SURFMINK__STORE(r->turned + i, im);
    }
}

/* Sums w = l z^p over the rows for three ranks on end, which is what 16 registers hold; w is left at the rank after
   them if there are more to come.
   g  6 lanes  out: real and imaginary parts, rank by rank */
SURFMINK__INLINE void SURFMINK__(three_ranks)(SURFMINK__(rows) *r, size_t rows, int more, double *g)
{
    surfmink__real re, im, x, y, g_re[3], g_im[3];
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        g_re[0] = g_re[1] = g_re[2] = g_im[0] = g_im[1] = g_im[2] = SURFMINK__SET(0.0);
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            re = SURFMINK__LOAD(r->length + i);
            im = SURFMINK__LOAD(r->turned + i);
            x = SURFMINK__LOAD(r->column[2] + i);
            y = SURFMINK__LOAD(r->column[3] + i);
            g_re[0] = g_re[0] + re;
            g_im[0] = g_im[0] + im;
            SURFMINK__(multiply)(&re, &im, x, y);
            g_re[1] = g_re[1] + re;
            g_im[1] = g_im[1] + im;
            SURFMINK__(multiply)(&re, &im, x, y);
            g_re[2] = g_re[2] + re;
            g_im[2] = g_im[2] + im;
            if (!more) continue;
            SURFMINK__(multiply)(&re, &im, x, y);
            SURFMINK__STORE(r->length + i, re);
            SURFMINK__STORE(r->turned + i, im);
        }
        SURFMINK__STORE(g + lane, g_re[0]);
        SURFMINK__STORE(g + lane + SURFMINK__LANES, g_im[0]);
        SURFMINK__STORE(g + lane + 2 * SURFMINK__LANES, g_re[1]);
        SURFMINK__STORE(g + lane + 3 * SURFMINK__LANES, g_im[1]);
        SURFMINK__STORE(g + lane + 4 * SURFMINK__LANES, g_re[2]);
        SURFMINK__STORE(g + lane + 5 * SURFMINK__LANES, g_im[2]);
    }
}

SURFMINK__KERNEL void SURFMINK__(power_sums)(SURFMINK__(rows) *r, size_t rows, int more, double *g)
{
    if (more)
        SURFMINK__(three_ranks)(r, rows, 1, g);
    else
        SURFMINK__(three_ranks)(r, rows, 0, g);
}

/* --- 4. spectrum: irreducible components -> eigenvalues, angles --------------------------------------------------- */

/* mu_p = |g_p| / L, and theta_p = arg(g_p) / p. */
SURFMINK__INLINE void SURFMINK__(rank)(const double *g, const double *length, double p, double *mu, double *theta)
{
    surfmink__real re = SURFMINK__LOAD(g), im = SURFMINK__LOAD(g + SURFMINK__LANES);
    surfmink__real ratio = SURFMINK__ROOT(SURFMINK__FMA(im, im, re * re)) / SURFMINK__LOAD(length);
    SURFMINK__STORE(mu, SURFMINK__MIN(ratio, SURFMINK__SET(1.0))); /* rounding may take it above */
    if (theta) SURFMINK__STORE(theta, SURFMINK__(atan2)(im + SURFMINK__SET(0.0), re) / SURFMINK__SET(p));
}

/* Three ranks from p on. */
SURFMINK__KERNEL void SURFMINK__(spectrum)(SURFMINK__(ranks) *r, const double *length, double p, int with_theta)
{
    double *theta = with_theta ? r->theta : NULL;
    size_t lane, k;
    for (lane = 0; lane < SURFMINK__LANES && !with_theta; lane += SURFMINK__WIDTH) {
        SURFMINK__(rank)(r->g + lane, length + lane, p, r->mu + lane, NULL);
        SURFMINK__(rank)(r->g + lane + 2 * SURFMINK__LANES, length + lane, p, r->mu + lane + SURFMINK__LANES, NULL);
        SURFMINK__(rank)(r->g + lane + 4 * SURFMINK__LANES, length + lane, p, r->mu + lane + 2 * SURFMINK__LANES, NULL);
    }
    for (k = 0; k < 3 && with_theta; ++k)
        for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) SURFMINK__(rank)
    (r->g + lane + 2 * k * SURFMINK__LANES, length + lane, p + (double)k, r->mu + lane + k * SURFMINK__LANES,
     theta + lane + k * SURFMINK__LANES);
}

/* --- gradients: weights -> derivatives by corners and normals ----------------------------------------------------- */

/* The weight of g_p, in place as its conjugate, gets what weights of |g_p| / L and of arg(g_p) / p add to it, and that
   of L its part. A modulus that is noise has no derivative. */
SURFMINK__INLINE void SURFMINK__(pull_rank)(const double *g, const double *length, double p, const double *by_mu,
                                            const double *by_theta, double *by_g, double *by_length)
{
    surfmink__real re = SURFMINK__LOAD(g), im = SURFMINK__LOAD(g + SURFMINK__LANES), along, around;
    surfmink__real square = SURFMINK__FMA(im, im, re * re), root = SURFMINK__ROOT(square), all = SURFMINK__LOAD(length);
    surfmink__real by_re = SURFMINK__LOAD(by_g), by_im = SURFMINK__LOAD(by_g + SURFMINK__LANES);
    surfmink__mask is_there = SURFMINK__LESS(SURFMINK__SET(1e-14) * all, root);
    along = SURFMINK__WHERE(is_there, SURFMINK__LOAD(by_mu) / (root * all));
    SURFMINK__STORE(by_length, SURFMINK__FNMA(along, square / all, SURFMINK__LOAD(by_length)));
    by_re = SURFMINK__FMA(along, re, by_re);
    by_im = SURFMINK__FMA(along, im, by_im);
    if (by_theta) {
        around = SURFMINK__WHERE(is_there, SURFMINK__LOAD(by_theta) / (SURFMINK__SET(p) * square));
        by_re = SURFMINK__FNMA(around, im, by_re);
        by_im = SURFMINK__FMA(around, re, by_im);
    }
    SURFMINK__STORE(by_g, by_re);
    SURFMINK__STORE(by_g + SURFMINK__LANES, -by_im);
}

/* a becomes a z + b. */
SURFMINK__INLINE void SURFMINK__(horner_step)(surfmink__real *re, surfmink__real *im, surfmink__real x,
                                              surfmink__real y, surfmink__real b_re, surfmink__real b_im)
{
    surfmink__real t = SURFMINK__FNMA(*im, y, SURFMINK__FMA(*re, x, b_re));
    *im = SURFMINK__FMA(*im, x, SURFMINK__FMA(*re, y, b_im));
    *re = t;
}

/* Two steps of a polynomial and of its derivative, with the coefficients at `by`. */
SURFMINK__INLINE void SURFMINK__(horner_steps)(surfmink__real a[2], surfmink__real d[2], surfmink__real x,
                                               surfmink__real y, const double *by)
{
    SURFMINK__(horner_step)(d, d + 1, x, y, a[0], a[1]);
    SURFMINK__(horner_step)
    (a, a + 1, x, y, SURFMINK__LOAD(by + 2 * SURFMINK__LANES), SURFMINK__LOAD(by + 3 * SURFMINK__LANES));
    SURFMINK__(horner_step)(d, d + 1, x, y, a[0], a[1]);
    SURFMINK__(horner_step)(a, a + 1, x, y, SURFMINK__LOAD(by), SURFMINK__LOAD(by + SURFMINK__LANES));
}

/* With the polynomial c(z) = sum conj(dE/dg_p) z^p of `ranks` ranks from `first` on, dE/dl_i is Re c(z_i), and
   dE/df_i / l_i is Re i z_i c'(z_i): by Horner's rule with derivative, four ranks a turn. Added to what is there unless
   `first` is 1. */
SURFMINK__INLINE void SURFMINK__(horner)(const SURFMINK__(rows) *r, size_t rows, int first, int ranks,
                                         SURFMINK__(tape) *k)
{
    surfmink__real x, y, re, im, a[2], d[2], factor = SURFMINK__SET((double)(first - 1));
    const double *by, *last = k->by_g + 2 * (size_t)(ranks - 1) * SURFMINK__LANES;
    size_t lane, i;
    int left;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH)
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            x = SURFMINK__LOAD(r->column[2] + i);
            y = SURFMINK__LOAD(r->column[3] + i);
            by = last + lane;
            a[0] = SURFMINK__LOAD(by);
            a[1] = SURFMINK__LOAD(by + SURFMINK__LANES);
            d[0] = d[1] = SURFMINK__SET(0.0);
            left = ranks - 1;
            if (left % 2) {
                d[0] = a[0];
                d[1] = a[1];
                by -= 2 * SURFMINK__LANES;
                SURFMINK__(horner_step)(a, a + 1, x, y, SURFMINK__LOAD(by), SURFMINK__LOAD(by + SURFMINK__LANES));
            }
            if (left % 4 > 1) SURFMINK__(horner_steps)(a, d, x, y, by -= 4 * SURFMINK__LANES);
            for (left /= 4; left > 0; --left, by -= 8 * SURFMINK__LANES) {
                SURFMINK__(horner_steps)(a, d, x, y, by - 4 * SURFMINK__LANES);
                SURFMINK__(horner_steps)(a, d, x, y, by - 8 * SURFMINK__LANES);
            }
            SURFMINK__(horner_step)(d, d + 1, x, y, a[0], a[1]);
            re = x;
            im = y;
            if (first > 1) {
                d[0] = SURFMINK__FMA(factor, a[0], d[0]);
                d[1] = SURFMINK__FMA(factor, a[1], d[1]);
                for (left = first - 1; left > 0; left /= 2) { /* z^first */
                    if (left % 2) SURFMINK__(multiply)(&re, &im, x, y);
                    SURFMINK__(multiply)(&x, &y, x, y);
                }
            }
            x = SURFMINK__FNMA(a[1], im, a[0] * re);
            y = SURFMINK__FMA(d[1], re, d[0] * im);
            if (first > 1) {
                x = x + SURFMINK__LOAD(k->by_length + i);
                y = y - SURFMINK__LOAD(k->by_phase + i);
            }
            SURFMINK__STORE(k->by_length + i, x);
            SURFMINK__STORE(k->by_phase + i, -y);
        }
}

SURFMINK__KERNEL void SURFMINK__(pull_powers)(const SURFMINK__(rows) *r, size_t rows, int first, int ranks,
                                              SURFMINK__(tape) *k)
{
    if (first > 1)
        SURFMINK__(horner)(r, rows, first, ranks, k);
    else
        SURFMINK__(horner)(r, rows, 1, ranks, k);
}

/* Adds F_i = dE/df_i to its sum over the rows, and F_i times the turns since edge 0.
   base    as for the phases
   turned  or NULL: in the plane that does not matter */
SURFMINK__INLINE void SURFMINK__(sum_phases)(const double *length, const double *turned, size_t rows,
                                             const double *base, SURFMINK__(tape) *k)
{
    surfmink__real start, by_phase, sum, moment;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        start = SURFMINK__LOAD(base + lane);
        sum = SURFMINK__LOAD(k->sum + lane);
        moment = SURFMINK__LOAD(k->moment + lane);
        for (i = lane; i < rows * SURFMINK__LANES; i += SURFMINK__LANES) {
            by_phase = SURFMINK__LOAD(length + i) * SURFMINK__LOAD(k->by_phase + i);
            sum = sum + by_phase;
            if (turned) moment = SURFMINK__FMA(start + SURFMINK__LOAD(turned + i), by_phase, moment);
        }
        SURFMINK__STORE(k->sum + lane, sum);
        SURFMINK__STORE(k->moment + lane, moment);
    }
}

SURFMINK__KERNEL void SURFMINK__(pull_sums)(const surfmink__job *job, const double *length, size_t rows,
                                            const double *base, SURFMINK__(tape) *k)
{
    if (job->kind == SURFMINK__PLANE)
        SURFMINK__(sum_phases)(length, NULL, rows, base, k);
    else
        SURFMINK__(sum_phases)(length, k->turned, rows, base, k);
}

/* The last steps go over the rows backwards, and leave the gradient where the corners (and normals) were. Each edge
   gives to both of its corners: that of row `rows` gets its part from the last edge only, that of row 0 from the first.
   A_i = dE/dalpha_i, and A_i - A_(i+1) = (2 pi / S) F_i, without cancellation but at corner 0, whose turn is in no
   phase and only in S.

   In the plane dE/df_j turns edge j and, the other way, edge 0. */
SURFMINK__KERNEL void SURFMINK__(back_plane)(SURFMINK__(rows) *r, size_t rows, int is_first, const double *first,
                                             size_t stride, const double *lengths, SURFMINK__(tape) *k)
{
    surfmink__real u[2], x, y, re, im, out_re, out_im, length, by_all, by_phase;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        u[0] = SURFMINK__LOAD(first + lane + SURFMINK__LANES) - SURFMINK__LOAD(first + lane);
        u[1] = SURFMINK__LOAD(first + lane + SURFMINK__LANES + stride) - SURFMINK__LOAD(first + lane + stride);
        length = SURFMINK__ROOT(SURFMINK__FMA(u[1], u[1], u[0] * u[0]));
        u[0] = u[0] / length;
        u[1] = u[1] / length;
        by_all = SURFMINK__LOAD(k->by_all + lane);
        out_re = out_im = SURFMINK__SET(0.0);
        for (i = rows * SURFMINK__LANES + lane; i >= SURFMINK__LANES;) {
            i -= SURFMINK__LANES;
            x = SURFMINK__LOAD(r->column[2] + i);
            y = SURFMINK__LOAD(r->column[3] + i);
            length = SURFMINK__LOAD(k->by_length + i) + by_all;
            by_phase = SURFMINK__LOAD(k->by_phase + i);
            if (i == lane && is_first)
                by_phase = by_phase - SURFMINK__LOAD(k->starts + lane) * SURFMINK__LOAD(k->sum + lane) /
                                          SURFMINK__LOAD(lengths + i);
            re = SURFMINK__FNMA(y, by_phase, x * length); /* along and across edge 0 */
            im = SURFMINK__FMA(x, by_phase, y * length);
            x = SURFMINK__FNMA(im, u[1], re * u[0]);
            y = SURFMINK__FMA(im, u[0], re * u[1]);
            SURFMINK__STORE(r->column[0] + i + 2 * SURFMINK__LANES, x - out_re);
            SURFMINK__STORE(r->column[1] + i + 2 * SURFMINK__LANES, y - out_im);
            out_re = x;
            out_im = y;
        }
        SURFMINK__STORE(r->column[0] + SURFMINK__LANES + lane, -out_re);
        SURFMINK__STORE(r->column[1] + SURFMINK__LANES + lane, -out_im);
    }
}

/* A_i, and (2 pi / S) F_i, of which `suffix` is the sum from the last one on. */
SURFMINK__INLINE void SURFMINK__(pull_turn)(const SURFMINK__(tape) *k, size_t lane, size_t i, int is_corner_0,
                                            surfmink__real behind, surfmink__real *suffix, surfmink__real *turn,
                                            surfmink__real *step)
{
    surfmink__real base = SURFMINK__LOAD(k->base + lane), starts;
    *step = SURFMINK__LOAD(k->factor + lane) * SURFMINK__LOAD(k->length + i) * SURFMINK__LOAD(k->by_phase + i);
    *suffix = *suffix + *step;
    *turn = *suffix + base;
    if (!is_corner_0) return;
    starts = SURFMINK__LOAD(k->starts + lane);
    *step = SURFMINK__FNMA(starts, *step - (base - behind), *step);
    *turn = base + SURFMINK__FNMA(starts, *suffix, *suffix);
}

/* Great-circle edges, in angles: with m the unit vector along x x y, theta the length and t the unit tangents at both
   ends, V = dE/dl,
     |x| dE/dx = -V t_x + (A_x tan(theta / 2) - (A_x - A_y) / sin(theta)) m
     |y| dE/dy =  V t_y + (A_y tan(theta / 2) + (A_x - A_y) / sin(theta)) m */
SURFMINK__KERNEL void SURFMINK__(back_sphere)(SURFMINK__(rows) *r, size_t rows, int is_first, SURFMINK__(tape) *k)
{
    surfmink__real x[3], y[3], b[3], m[3], t[3], out[3], x_norm, y_norm, x_inverse, y_inverse, root, rise, half, by_all;
    surfmink__real length, suffix, step, x_turn, y_turn;
    const surfmink__real one = SURFMINK__SET(1.0);
    size_t lane, i, j;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        by_all = SURFMINK__LOAD(k->by_all + lane);
        suffix = SURFMINK__LOAD(k->suffix + lane);
        y_turn = suffix + SURFMINK__LOAD(k->base + lane);
        SURFMINK__(load)(r->column[0] + lane + (rows + 1) * SURFMINK__LANES, y);
        y_norm = SURFMINK__ROOT(SURFMINK__(dot)(y, y));
        y_inverse = one / y_norm;
        out[0] = out[1] = out[2] = SURFMINK__SET(0.0);
        for (i = rows * SURFMINK__LANES + lane; i >= SURFMINK__LANES;) {
            i -= SURFMINK__LANES;
            SURFMINK__(load)(r->column[0] + i + SURFMINK__LANES, x);
            SURFMINK__(subtract)(y, x, b);
            x_norm = SURFMINK__ROOT(SURFMINK__(dot)(x, x));
            x_inverse = one / x_norm;
            SURFMINK__(pull_turn)(k, lane, i, i == lane && is_first, y_turn, &suffix, &x_turn, &step);
            length = SURFMINK__LOAD(k->by_length + i) + by_all;
            SURFMINK__(cross)(x, b, m);
            root = SURFMINK__ROOT(SURFMINK__(dot)(m, m));
            root = SURFMINK__RATIO(one, root);
            for (j = 0; j < 3; ++j) m[j] = m[j] * root;
            for (j = 0; j < 3; ++j) t[j] = SURFMINK__FMA(SURFMINK__SET(2.0), x[j], b[j]);
            rise = SURFMINK__(dot)(b, t) / (x_norm + y_norm); /* |y| - |x| */
            half = SURFMINK__SET(0.5) * root * SURFMINK__FNMA(rise, rise, SURFMINK__(dot)(b, b));
            step = step * (x_norm * y_norm) * root;
            SURFMINK__(cross)(m, y, t);
            for (j = 0; j < 3; ++j) {
                t[j] = SURFMINK__FMA(length * y_inverse, t[j], out[j]);
                t[j] = SURFMINK__FMA(SURFMINK__FMA(y_turn, half, step), m[j], t[j]);
                SURFMINK__STORE(r->column[j] + i + 2 * SURFMINK__LANES, t[j] * y_inverse);
            }
            SURFMINK__(cross)(m, x, t);
            for (j = 0; j < 3; ++j) {
                out[j] = SURFMINK__FMA(x_turn, half, -step) * m[j];
                out[j] = SURFMINK__FNMA(length * x_inverse, t[j], out[j]);
                y[j] = x[j];
            }
            y_norm = x_norm;
            y_inverse = x_inverse;
            y_turn = x_turn;
        }
        for (j = 0; j < 3; ++j) SURFMINK__STORE(r->column[j] + lane + SURFMINK__LANES, out[j] * y_inverse);
        SURFMINK__STORE(k->suffix + lane, suffix);
    }
}

/* How the direction of the edge e, seen along n, turns as e changes: q = n x e / |P e|^2 for unit n. Returns what
   c = n x e is multiplied with to become A q.
   tilt  out: and to become the part by n, as n tilts: -A (n . e) q / |n|, without the sign */
SURFMINK__INLINE surfmink__real SURFMINK__(swing)(const surfmink__real n[3], surfmink__real nn, surfmink__real norm,
                                                  const surfmink__real e[3], surfmink__real turn, surfmink__real c[3],
                                                  surfmink__real *tilt)
{
    surfmink__real square, factor;
    SURFMINK__(cross)(n, e, c);
    square = SURFMINK__(dot)(c, c);
    factor = SURFMINK__RATIO(turn * norm, square);
    *tilt = factor * SURFMINK__(dot)(n, e) / nn;
    return factor;
}

/* Straight edges: with q of its directions at both ends an edge e gets V e / |e| + A_x q_x - A_y q_y. */
SURFMINK__KERNEL void SURFMINK__(back_embedded)(SURFMINK__(rows) *r, size_t rows, int is_first, SURFMINK__(tape) *k)
{
    surfmink__real x[3], y[3], e[3], n_x[3], n_y[3], c_x[3], c_y[3], out[3], tilt[3], x_norm, y_norm, x_square,
        y_square;
    surfmink__real x_factor, y_factor, x_tilt, y_tilt, by_all, along, suffix, step, x_turn, y_turn, g;
    size_t lane, i, j;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        by_all = SURFMINK__LOAD(k->by_all + lane);
        suffix = SURFMINK__LOAD(k->suffix + lane);
        y_turn = suffix + SURFMINK__LOAD(k->base + lane);
        SURFMINK__(load)(r->column[0] + lane + (rows + 1) * SURFMINK__LANES, y);
        SURFMINK__(load)(r->column[3] + lane + (rows + 1) * SURFMINK__LANES, n_y);
        y_square = SURFMINK__(dot)(n_y, n_y);
        y_norm = SURFMINK__ROOT(y_square);
        for (j = 0; j < 3; ++j) out[j] = tilt[j] = SURFMINK__SET(0.0);
        for (i = rows * SURFMINK__LANES + lane; i >= SURFMINK__LANES;) {
            i -= SURFMINK__LANES;
            SURFMINK__(load)(r->column[0] + i + SURFMINK__LANES, x);
            SURFMINK__(load)(r->column[3] + i + SURFMINK__LANES, n_x);
            SURFMINK__(subtract)(y, x, e);
            x_square = SURFMINK__(dot)(n_x, n_x);
            x_norm = SURFMINK__ROOT(x_square);
            y_factor = SURFMINK__(swing)(n_y, y_square, y_norm, e, y_turn, c_y, &y_tilt);
            SURFMINK__(pull_turn)(k, lane, i, i == lane && is_first, y_turn, &suffix, &x_turn, &step);
            x_factor = SURFMINK__(swing)(n_x, x_square, x_norm, e, x_turn, c_x, &x_tilt);
            along = SURFMINK__LOAD(k->length + i);
            along = SURFMINK__RATIO(SURFMINK__LOAD(k->by_length + i) + by_all, along);
            for (j = 0; j < 3; ++j) {
                g = SURFMINK__FMA(y_tilt, c_y[j], tilt[j]);
                SURFMINK__STORE(r->column[3 + j] + i + 2 * SURFMINK__LANES, g);
                tilt[j] = -x_tilt * c_x[j];
                g = SURFMINK__FMA(x_factor, c_x[j], SURFMINK__FNMA(y_factor, c_y[j], along * e[j]));
                SURFMINK__STORE(r->column[j] + i + 2 * SURFMINK__LANES, g - out[j]);
                out[j] = g;
                y[j] = x[j];
                n_y[j] = n_x[j];
            }
            y_square = x_square;
            y_norm = x_norm;
            y_turn = x_turn;
        }
        for (j = 0; j < 3; ++j) {
            SURFMINK__STORE(r->column[j] + lane + SURFMINK__LANES, -out[j]);
            SURFMINK__STORE(r->column[3 + j] + lane + SURFMINK__LANES, tilt[j]);
        }
        SURFMINK__STORE(k->suffix + lane, suffix);
    }
}

/* --- batches: all four steps for a group of lanes ----------------------------------------------------------------- */

/* Outlines of at most SURFMINK__ROWS corners, a lane each; or the strips of one that is longer. */
typedef struct SURFMINK__(group) {
    surfmink__sum sum[SURFMINK__SUMS][SURFMINK__LANES]; /* strips: sums over the rows so far */
    double widest[SURFMINK__LANES];                     /* strips: the same of the sum of turns */
    size_t outline[SURFMINK__LANES];                    /* which one of the batch */
    size_t base[SURFMINK__LANES];                       /* its first corner */
    size_t size[SURFMINK__LANES];                       /* how many it has */
    size_t start[SURFMINK__LANES];                      /* the first corner of the lane */
    size_t count[SURFMINK__LANES];                      /* how many it has */
    size_t used;                                        /* lanes that hold results of their own */
    size_t good, good_lane[SURFMINK__LANES];            /* those of them that are ordinary */
    size_t rows;                                        /* of the longest lane */
    size_t strips;                                      /* one outline or several? */
} SURFMINK__(group);

/* Where the corners of a lane stand: the one before the rows at hand, those of the rows, and the one behind them. */
typedef struct SURFMINK__(run) {
    size_t before, at, count, behind;
} SURFMINK__(run);

/* One row of two neighbouring lanes; of the one lane, where batches have to be ordinary as they are but a single
   outline is made so. */
SURFMINK__INLINE void SURFMINK__(put)(double a, double b, double scale, double *at)
{
#if SURFMINK__GANG == 2
    surfmink__pair pair;
    pair[0] = a;
    pair[1] = b;
    *(surfmink__pair *)(void *)at = pair;
    (void)scale;
#else
    *at = a * scale;
    (void)b;
#endif
}

SURFMINK__INLINE void SURFMINK__(put_row)(const double *a, const double *b, size_t dim, double scale, double *row)
{
    SURFMINK__(put)(a[0], b[0], scale, row);
    SURFMINK__(put)(a[1], b[1], scale, row + SURFMINK__COLUMN);
    if (dim > 2) SURFMINK__(put)(a[2], b[2], scale, row + 2 * SURFMINK__COLUMN);
}

/* Spreads corners (or normals) of all lanes over columns, two lanes at a time. For corners also the row before the
   first and the one behind the last. Short lanes are padded with the corner behind their last one: edges of length 0,
   which turn nowhere. */
SURFMINK__INLINE void SURFMINK__(gather)(const double *from, size_t dim, double scale, const SURFMINK__(run) *run,
                                         size_t rows, int ends, double *column)
{
    size_t lane, i, both, end = (rows + (ends ? 1 : 0)) * dim;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__GANG, run += SURFMINK__GANG, column += SURFMINK__GANG) {
        const SURFMINK__(run) *next = run + SURFMINK__GANG - 1;
        const double *a = from + dim * run->at, *b = from + dim * next->at;
        const double *a_behind = from + dim * run->behind, *b_behind = from + dim * next->behind;
        double *row = column + SURFMINK__LANES;
        if (ends) SURFMINK__(put_row)(from + dim * run->before, from + dim * next->before, dim, scale, column);
        both = dim * (run->count < next->count ? run->count : next->count);
        for (i = 0; i < both; i += dim, row += SURFMINK__LANES) SURFMINK__(put_row)(a + i, b + i, dim, scale, row);
        for (; i < end; i += dim, row += SURFMINK__LANES) SURFMINK__(put_row)
        (i < dim * run->count ? a + i : a_behind, i < dim * next->count ? b + i : b_behind, dim, scale, row);
    }
}

/* Corners and normals of the rows; for gradients also the normal behind them. */
SURFMINK__KERNEL void SURFMINK__(gather_rows)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row,
                                              size_t rows, SURFMINK__(rows) *r)
{
    size_t lane, base, past;
    SURFMINK__(run) run[SURFMINK__LANES];
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        base = g->base[lane];
        past = row < g->count[lane] ? row : g->count[lane];
        run[lane].at = g->start[lane] + past;
        run[lane].count = g->count[lane] - past < rows ? g->count[lane] - past : rows;
        run[lane].behind =
            run[lane].at + run[lane].count < base + g->size[lane] ? run[lane].at + run[lane].count : base;
        run[lane].before = (run[lane].at > base ? run[lane].at : base + g->size[lane]) - 1;
    }
    if (job->kind == SURFMINK__PLANE) {
        SURFMINK__(gather)(job->corner, 2, job->scale, run, rows, 1, r->column[0]);
        return;
    }
    SURFMINK__(gather)(job->corner, 3, job->scale, run, rows, 1, r->column[0]);
    if (job->kind == SURFMINK__SPHERE) return;
    SURFMINK__(gather)(job->normal, 3, 1, run, rows, job->back != NULL, r->column[3]);
#if SURFMINK__INSTANCE == SURFMINK__PLAIN
    for (lane = 0; lane < rows + (job->back ? 1 : 0); ++lane) surfmink__shrink_normal(r->column[3] + 1 + lane);
#endif
}

/* Step 1, and the angles of step 2. */
SURFMINK__KERNEL void SURFMINK__(measure_rows)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row,
                                               size_t rows, SURFMINK__(rows) *r, SURFMINK__(totals) *t)
{
    const double *first = g->strips ? r->first[0] : r->column[0] + SURFMINK__LANES;
    size_t stride = g->strips ? 2 * SURFMINK__LANES : SURFMINK__COLUMN;
    SURFMINK__(gather_rows)(job, g, row, rows, r);
    if (job->kind == SURFMINK__PLANE) {
        SURFMINK__(edges_plane)(r, rows, first, stride, t);
        return;
    }
    if (job->kind == SURFMINK__SPHERE)
        SURFMINK__(edges_sphere)(r, rows, first, stride, t);
    else
        SURFMINK__(edges_embedded)(r, rows, t);
    SURFMINK__(angles)(r, rows, t);
}

/* Which lanes are ordinary, so that these results stand: their number of good rows becomes 1, that of others 0. The
   rest is left to the calls that look at each corner. S is what the surface says it is: 2 pi in the plane, 2 pi - area
   on the sphere, which has more digits than a sum of rounded turns. Phases go by the sum, for that closes. Rounding is
   multiplied by 1 / S, and where the sum of the turns exceeds S by far on the way, once more by that: such are left. */
SURFMINK__KERNEL void SURFMINK__(judge)(const surfmink__job *job, SURFMINK__(totals) *t)
{
    surfmink__real length, turning, area, known;
    surfmink__mask fine;
    size_t lane;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        length = SURFMINK__LOAD(t->sum[SURFMINK__LENGTH] + lane);
        turning = SURFMINK__LOAD(t->sum[SURFMINK__TURNING] + lane);
        known = SURFMINK__SET(6.2831853071795865) - SURFMINK__LOAD(t->sum[SURFMINK__AREA] + lane);
        if (job->kind == SURFMINK__PLANE) known = SURFMINK__SET(6.2831853071795865);
        if (job->kind == SURFMINK__EMBEDDED) known = turning;
        fine = SURFMINK__LESS(
            SURFMINK__ABS(SURFMINK__LOAD(t->sum[SURFMINK__GOOD] + lane) - SURFMINK__LOAD(t->expected + lane)),
            SURFMINK__SET(0.5));
        fine = fine & SURFMINK__LESS(SURFMINK__SET(1e-100), length) & SURFMINK__LESS(length, SURFMINK__SET(1e100));
        fine = fine & SURFMINK__LESS(SURFMINK__LOAD(t->largest + lane), SURFMINK__SET(1e300));
        fine = fine & SURFMINK__LESS(SURFMINK__LOAD(t->sharpest + lane), SURFMINK__SET(3.14159265358978)); /* spikes */
        fine = fine & SURFMINK__LESS(SURFMINK__FMA(SURFMINK__SET(1e-3), SURFMINK__LOAD(t->sum[SURFMINK__TURNS] + lane),
                                                   SURFMINK__SET(0.5)),
                                     known);
        if (job->kind != SURFMINK__PLANE) /* there whole turns are counted, which rounding does not reach */
            fine = fine & SURFMINK__LESS(SURFMINK__LOAD(t->widest + lane), SURFMINK__SET(2.0) * known);
        fine = fine & SURFMINK__LESS(SURFMINK__ABS(turning - known), SURFMINK__SET(1e-3));
        area = SURFMINK__LOAD(t->sum[SURFMINK__AREA] + lane);
        if (job->kind == SURFMINK__SPHERE) fine = fine & SURFMINK__LESS(SURFMINK__SET(0.0), area);
        fine =
            fine & SURFMINK__LESS(SURFMINK__SET(1e-300), length * SURFMINK__SET(job->unit)); /* as it will be written */
        fine = fine & SURFMINK__LESS(length * SURFMINK__SET(job->unit), SURFMINK__SET(1.7e308));
        fine = fine & SURFMINK__LESS(SURFMINK__ABS(area) * SURFMINK__SET(job->unit) * SURFMINK__SET(job->unit),
                                     SURFMINK__SET(8e307)); /* others double it */
        /* whatever becomes of the rest, nothing is divided by zero */
        SURFMINK__STORE(t->sum[SURFMINK__LENGTH] + lane, SURFMINK__SELECT(fine, length, SURFMINK__SET(1.0)));
        SURFMINK__STORE(t->sum[SURFMINK__TURNING] + lane, SURFMINK__SELECT(fine, turning, SURFMINK__SET(1.0)));
        SURFMINK__STORE(t->known + lane, known);
        SURFMINK__STORE(t->sum[SURFMINK__GOOD] + lane, SURFMINK__WHERE(fine, SURFMINK__SET(1.0)));
    }
}

/* What is known before any rank is. */
SURFMINK__KERNEL void SURFMINK__(write)(const surfmink__job *job, const SURFMINK__(totals) *t, SURFMINK__(group) *g)
{
    const surfmink_results *out = job->out;
    surfmink_functionals w;
    size_t lane, i, k, ranks = (size_t)job->max_rank + 1;
    g->good = 0;
    for (lane = 0; lane < g->used; ++lane)
        if (t->sum[SURFMINK__GOOD][lane] > 0) g->good_lane[g->good++] = lane;
    for (k = 0; k < g->good; ++k) {
        lane = g->good_lane[k];
        i = g->outline[lane];
        w.length = t->sum[SURFMINK__LENGTH][lane] * job->unit;
        w.turning = t->known[lane];
        w.area = t->sum[SURFMINK__AREA][lane] * job->unit * job->unit;
        if (out->status) out->status[i] = SURFMINK_OK;
        if (out->length) out->length[i] = w.length;
        if (out->turning) out->turning[i] = w.turning;
        if (out->area) out->area[i] = w.area;
        if (out->mu) out->mu[i * ranks] = 1;
        if (out->theta) out->theta[i * ranks] = 0;
        if (out->g) {
            out->g[2 * i * ranks] = w.length;
            out->g[2 * i * ranks + 1] = 0;
        }
        if (!job->w) continue;
        w.curvature = job->kind == SURFMINK__SPHERE ? t->sum[SURFMINK__AREA][lane] : surfmink__two_pi - w.turning;
        w.condition = t->sum[SURFMINK__TURNS][lane] / w.turning;
        *job->w = w;
    }
}

/* Three numbers of a lane, which stand a row apart. */
SURFMINK__INLINE void SURFMINK__(take)(const double *from, double *to)
{
    to[0] = from[0];
    to[1] = from[SURFMINK__LANES];
    to[2] = from[2 * SURFMINK__LANES];
}

/* Ranks from p on, three a tile, as far as they are asked for. */
SURFMINK__KERNEL void SURFMINK__(write_ranks)(const surfmink__job *job, const SURFMINK__(totals) *t,
                                              const SURFMINK__(group) *g, SURFMINK__(ranks) *r, int p, int tiles)
{
    const surfmink_results *out = job->out;
    size_t ranks = (size_t)job->max_rank + 1, lane, at, j, k;
    int tile;
    for (tile = 0; tile < tiles; ++tile) {
        if (out->mu || out->theta)
            SURFMINK__(spectrum)(r + tile, t->sum[SURFMINK__LENGTH], p + 3 * tile, out->theta != NULL);
        for (k = 0; k < 6 * SURFMINK__LANES && (job->unit < 1 || job->unit > 1); ++k) r[tile].g[k] *= job->unit;
    }
    for (k = 0; k < g->good; ++k) {
        lane = g->good_lane[k];
        at = g->outline[lane] * ranks + (size_t)p;
        for (tile = 0; tile < tiles && p + 3 * tile + 2 <= job->max_rank; ++tile, at += 3) {
            if (out->mu) SURFMINK__(take)(r[tile].mu + lane, out->mu + at);
            if (out->theta) SURFMINK__(take)(r[tile].theta + lane, out->theta + at);
            if (!out->g) continue;
            SURFMINK__(take)(r[tile].g + lane, out->g + 2 * at);
            SURFMINK__(take)(r[tile].g + lane + 3 * SURFMINK__LANES, out->g + 2 * at + 3);
        }
        if (tile == tiles) continue;
        for (j = 0; (size_t)(p + 3 * tile) + j < ranks; ++j) {
            if (out->mu) out->mu[at + j] = r[tile].mu[j * SURFMINK__LANES + lane];
            if (out->theta) out->theta[at + j] = r[tile].theta[j * SURFMINK__LANES + lane];
            if (!out->g) continue;
            out->g[2 * (at + j)] = r[tile].g[2 * j * SURFMINK__LANES + lane];
            out->g[2 * (at + j) + 1] = r[tile].g[(2 * j + 1) * SURFMINK__LANES + lane];
        }
    }
}

/* How many tiles of three ranks are left from rank p on, of those that are done in one go. */
SURFMINK__KERNEL int SURFMINK__(tiles)(const surfmink__job *job, int p)
{
    return job->max_rank - p < 3 * SURFMINK__TILES ? (job->max_rank - p) / 3 + 1 : SURFMINK__TILES;
}

SURFMINK__KERNEL void SURFMINK__(begin)(SURFMINK__(totals) *t)
{
    size_t lane, k;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        for (k = 0; k < SURFMINK__SUMS; ++k) t->sum[k][lane] = 0;
        t->sharpest[lane] = t->widest[lane] = t->largest[lane] = 0;
    }
}

/* --- batches: gradients of a group of lanes ----------------------------------------------------------------------- */

/* Before phases take their place: l_i, the turns, and what columns 2 and 3 hold. */
SURFMINK__KERNEL void SURFMINK__(keep_rows)(const surfmink__job *job, const SURFMINK__(rows) *r, size_t rows,
                                            SURFMINK__(tape) *k)
{
    surfmink__real x, y;
    size_t i;
    for (i = 0; i < rows * SURFMINK__LANES; i += SURFMINK__WIDTH) {
        x = SURFMINK__LOAD(r->column[2] + i);
        y = SURFMINK__LOAD(r->column[3] + i);
        if (job->kind == SURFMINK__PLANE) { /* there it is l_i z_i, and z_i */
            x = SURFMINK__FMA(SURFMINK__LOAD(r->turned + i), y, x * SURFMINK__LOAD(r->length + i));
            SURFMINK__STORE(k->length + i, x);
            continue;
        }
        SURFMINK__STORE(k->length + i, SURFMINK__LOAD(r->length + i));
        SURFMINK__STORE(k->turned + i, SURFMINK__LOAD(r->turned + i));
        SURFMINK__STORE(k->column[0] + i, x);
        SURFMINK__STORE(k->column[1] + i, y);
    }
}

SURFMINK__KERNEL void SURFMINK__(restore_rows)(const SURFMINK__(tape) *k, size_t rows, SURFMINK__(rows) *r)
{
    size_t i;
    for (i = 0; i < rows * SURFMINK__LANES; i += SURFMINK__WIDTH) {
        SURFMINK__STORE(r->column[2] + i, SURFMINK__LOAD(k->column[0] + i));
        SURFMINK__STORE(r->column[3] + i, SURFMINK__LOAD(k->column[1] + i));
    }
}

/* `count` weights of each lane's outline, a row each, of those that have `each` an outline. */
SURFMINK__KERNEL void SURFMINK__(weights)(const surfmink__job *job, const SURFMINK__(group) *g, const double *from,
                                          size_t each, size_t count, double *to)
{
    size_t lane, i;
    if (job->back->weights->shared) each = 0;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__GANG) {
        const double *a = from + g->outline[lane] * each, *b = from + g->outline[lane + SURFMINK__GANG - 1] * each;
        for (i = 0; i < count; ++i) SURFMINK__(put)(a[i], b[i], 1, to + i * SURFMINK__LANES + lane);
    }
}

/* Weights of L and of the real part of g_0, which is L, too. */
SURFMINK__KERNEL void SURFMINK__(pull_length)(const surfmink__job *job, const SURFMINK__(group) *g, SURFMINK__(tape) *k)
{
    const surfmink_weights *w = job->back->weights;
    size_t lane, i;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        k->by_all[lane] = k->sum[lane] = k->moment[lane] = 0;
        k->starts[lane] = g->strips && lane > 0 ? 0 : 1; /* whether row 0 is corner 0 */
    }
    for (i = 0; i < SURFMINK__LANES * 3 * SURFMINK__TILES && !w->mu; ++i) k->by_mu[i] = 0;
    if (w->length) SURFMINK__(weights)(job, g, w->length, 1, 1, k->by_all);
    if (w->g) {
        SURFMINK__(weights)(job, g, w->g, 2 * ((size_t)job->max_rank + 1), 1, k->by_g);
        for (lane = 0; lane < SURFMINK__LANES; ++lane) k->by_all[lane] += k->by_g[lane];
    }
    for (lane = 0; lane < SURFMINK__LANES && (job->unit < 1 || job->unit > 1); ++lane) k->by_all[lane] *= job->unit;
}

/* Weights of `ranks` ranks from `first` on, of which g is known, become weights of these g, and of L. */
SURFMINK__KERNEL void SURFMINK__(pull_ranks)(const surfmink__job *job, const SURFMINK__(group) *g,
                                             const SURFMINK__(totals) *t, const SURFMINK__(ranks) *sum, int first,
                                             int ranks, SURFMINK__(tape) *k)
{
    const surfmink_weights *w = job->back->weights;
    const size_t each = (size_t)job->max_rank + 1, from = (size_t)first, count = (size_t)ranks;
    const double *by_theta = w->theta ? k->by_theta : NULL, *length = t->sum[SURFMINK__LENGTH];
    size_t lane, p, i;
    if (w->mu) SURFMINK__(weights)(job, g, w->mu + from, each, count, k->by_mu);
    if (w->theta) SURFMINK__(weights)(job, g, w->theta + from, each, count, k->by_theta);
    if (w->g) SURFMINK__(weights)(job, g, w->g + 2 * from, 2 * each, 2 * count, k->by_g);
    for (i = 0; i < 2 * count * SURFMINK__LANES && !w->g; i += SURFMINK__WIDTH)
        SURFMINK__STORE(k->by_g + i, SURFMINK__SET(0.0));
    for (i = 0; i < 2 * count * SURFMINK__LANES && w->g && (job->unit < 1 || job->unit > 1); ++i)
        k->by_g[i] *= job->unit;
    for (p = 0; p < count; ++p)
        for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
            i = p * SURFMINK__LANES + lane;
            if (by_theta) SURFMINK__(pull_rank)
            (sum[p / 3].g + 2 * (p % 3) * SURFMINK__LANES + lane, length + lane, (double)(ptrdiff_t)(from + p),
             k->by_mu + i, by_theta + i, k->by_g + i + p * SURFMINK__LANES, k->by_all + lane);
            else SURFMINK__(pull_rank)(sum[p / 3].g + 2 * (p % 3) * SURFMINK__LANES + lane, length + lane, 0,
                                       k->by_mu + i, NULL, k->by_g + i + p * SURFMINK__LANES, k->by_all + lane);
        }
}

/* How many ranks are left from rank p on, of those that are done in one go. */
SURFMINK__KERNEL int SURFMINK__(ranks_from)(const surfmink__job *job, int p)
{
    return job->max_rank - p < 3 * SURFMINK__TILES ? job->max_rank - p + 1 : 3 * SURFMINK__TILES;
}

/* Without any rank E depends on L alone. */
SURFMINK__KERNEL void SURFMINK__(pull_nothing)(size_t rows, SURFMINK__(tape) *k)
{
    size_t i;
    for (i = 0; i < rows * SURFMINK__LANES; ++i) k->by_length[i] = k->by_phase[i] = 0;
}

/* The sums of all lanes are known: dE/dalpha_0, which is the part by S alone, and where A_i starts in each lane. */
SURFMINK__KERNEL void SURFMINK__(settle)(const SURFMINK__(group) *g, const SURFMINK__(totals) *t, SURFMINK__(tape) *k)
{
    surfmink__real inverse, factor;
    double beyond = 0, base = 0;
    size_t lane;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        inverse = SURFMINK__SET(1.0) / SURFMINK__LOAD(t->sum[SURFMINK__TURNING] + lane);
        factor = SURFMINK__SET(6.2831853071795865) * inverse;
        SURFMINK__STORE(k->factor + lane, factor);
        SURFMINK__STORE(k->base + lane, -SURFMINK__LOAD(k->moment + lane) * factor * inverse);
        SURFMINK__STORE(k->suffix + lane, SURFMINK__SET(0.0));
    }
    if (!g->strips) return;
    for (lane = SURFMINK__LANES; lane-- > 0;) { /* strips have it from the lanes behind them */
        k->suffix[lane] = k->factor[lane] * beyond;
        beyond += k->sum[lane];
        base += k->base[lane];
    }
    for (lane = 0; lane < SURFMINK__LANES; ++lane) k->base[lane] = base;
    k->sum[0] = beyond;
}

SURFMINK__INLINE void SURFMINK__(spread_row)(const double *row, size_t dim, double scale, double *to)
{
    to[0] = SURFMINK__SCALED(row[0], scale);
    to[1] = SURFMINK__SCALED(row[SURFMINK__COLUMN], scale);
    if (dim > 2) to[2] = SURFMINK__SCALED(row[2 * SURFMINK__COLUMN], scale);
    (void)scale;
}

/* Rows of a lane, to corners one after the other. */
SURFMINK__INLINE void SURFMINK__(spread_lane)(const double *row, size_t count, size_t dim, double scale, double *to)
{
    for (; count > 1; count -= 2, row += 2 * SURFMINK__LANES, to += 2 * dim) {
        SURFMINK__(spread_row)(row, dim, scale, to);
        SURFMINK__(spread_row)(row + SURFMINK__LANES, dim, scale, to + dim);
    }
    if (count > 0) SURFMINK__(spread_row)(row, dim, scale, to);
}

/* The gradient, from the columns to where it belongs. Corner 0 of an outline gets its second part from the row behind
   the last one. */
SURFMINK__INLINE void SURFMINK__(spread_short)(const SURFMINK__(group) *g, const double *column, size_t dim,
                                               double scale, double *to)
{
    size_t k, lane, j;
    for (k = 0; k < g->good; ++k) {
        const double *row = column + SURFMINK__LANES + g->good_lane[k], *end;
        double *at = to + dim * g->base[g->good_lane[k]];
        lane = g->good_lane[k];
        end = row + g->count[lane] * SURFMINK__LANES;
        for (j = 0; j < dim; ++j)
            at[j] = SURFMINK__SCALED(row[j * SURFMINK__COLUMN] + end[j * SURFMINK__COLUMN] + 0.0, scale); /* no -0 */
        SURFMINK__(spread_lane)(row + SURFMINK__LANES, g->count[lane] - 1, dim, scale, at + dim);
    }
}

/* Rows of strips give to the rows behind them, which are written already, or to where the next strip starts, which is
   written last. */
SURFMINK__INLINE void SURFMINK__(spread_strips)(const SURFMINK__(group) *g, size_t row, size_t rows,
                                                const double *column, size_t dim, double scale, double *to,
                                                double over[3][SURFMINK__LANES])
{
    size_t lane, j, end;
    double *at, behind;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        if (row >= g->count[lane]) continue;
        end = g->count[lane] - row < rows ? g->count[lane] - row : rows;
        at = to + dim * (g->start[lane] + row);
        SURFMINK__(spread_lane)(column + SURFMINK__LANES + lane, end, dim, scale, at);
        for (j = 0; j < dim; ++j) {
            behind = SURFMINK__SCALED(column[j * SURFMINK__COLUMN + (end + 1) * SURFMINK__LANES + lane], scale);
            if (row + end == g->count[lane])
                over[j][lane] = behind;
            else
                at[dim * end + j] += behind;
        }
    }
    for (lane = 0; lane < SURFMINK__LANES && row == 0; ++lane)
        for (j = 0; j < dim; ++j) to[dim * g->start[lane] + j] += over[j][lane > 0 ? lane - 1 : SURFMINK__LANES - 1];
}

SURFMINK__KERNEL void SURFMINK__(spread)(const SURFMINK__(group) *g, size_t row, size_t rows, const double *column,
                                         size_t dim, double scale, double *to, double over[3][SURFMINK__LANES])
{
    if (g->strips)
        SURFMINK__(spread_strips)(g, row, rows, column, dim, scale, to, over);
    else if (dim == 2)
        SURFMINK__(spread_short)(g, column, 2, scale, to);
    else
        SURFMINK__(spread_short)(g, column, 3, scale, to);
}

/* The way back through step 1, for rows whose lengths and phases have got their weights. */
SURFMINK__KERNEL void SURFMINK__(back_rows)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row,
                                            size_t rows, SURFMINK__(rows) *r, SURFMINK__(tape) *k)
{
    const double *first = g->strips ? r->first[0] : r->column[0] + SURFMINK__LANES;
    size_t stride = g->strips ? 2 * SURFMINK__LANES : SURFMINK__COLUMN;
    if (job->kind == SURFMINK__PLANE)
        SURFMINK__(back_plane)(r, rows, row == 0, first, stride, g->strips ? k->length : r->cosine, k);
    else if (job->kind == SURFMINK__SPHERE)
        SURFMINK__(back_sphere)(r, rows, row == 0, k);
    else
        SURFMINK__(back_embedded)(r, rows, row == 0, k);
    SURFMINK__(spread)
    (g, row, rows, r->column[0], job->kind == SURFMINK__PLANE ? 2 : 3, job->scale, job->back->by_corner, k->over);
    if (job->kind != SURFMINK__EMBEDDED || !job->back->by_normal) return;
#if SURFMINK__INSTANCE == SURFMINK__PLAIN
    for (stride = 0; stride <= rows; ++stride) /* normals were brought to ordinary magnitude */
        surfmink__scale_gradient(job->normal + 3 * (g->base[0] + (row + stride) % g->size[0]),
                                 r->column[3] + 1 + stride);
#endif
    SURFMINK__(spread)(g, row, rows, r->column[3], 3, 1, job->back->by_normal, k->over + 3);
}

/* The way back for outlines that fit into the rows whole, when all ranks are pulled. */
SURFMINK__KERNEL void SURFMINK__(back_short)(const surfmink__job *job, const SURFMINK__(group) *g,
                                             const SURFMINK__(totals) *t, SURFMINK__(rows) *r, SURFMINK__(tape) *k)
{
    if (job->max_rank == 0) SURFMINK__(pull_nothing)(g->rows, k);
    SURFMINK__(pull_sums)(job, job->kind == SURFMINK__PLANE ? r->cosine : k->length, g->rows, t->behind, k);
    SURFMINK__(settle)(g, t, k);
    if (job->kind != SURFMINK__PLANE) SURFMINK__(restore_rows)(k, g->rows, r);
    SURFMINK__(back_rows)(job, g, 0, g->rows, r, k);
}

/* Outlines that fit into the rows whole.
   k  for gradients; or NULL */
SURFMINK__KERNEL void SURFMINK__(measure_short)(const surfmink__job *job, SURFMINK__(group) *g, SURFMINK__(rows) *r,
                                                SURFMINK__(totals) *t, SURFMINK__(ranks) *sum, SURFMINK__(tape) *k)
{
    size_t lane;
    int first, ranks, tile, tiles;
    SURFMINK__(begin)(t);
    SURFMINK__(measure_rows)(job, g, 0, g->rows, r, t);
    SURFMINK__(judge)(job, t);
    SURFMINK__(write)(job, t, g);
    if (g->good == 0) return;
    if (k) {
        if (job->kind != SURFMINK__PLANE) SURFMINK__(keep_rows)(job, r, g->rows, k);
        SURFMINK__(pull_length)(job, g, k);
    }
    for (lane = 0; lane < SURFMINK__LANES; ++lane) t->behind[lane] = -r->turned[lane];
    if (job->kind != SURFMINK__PLANE) SURFMINK__(phases)(r, g->rows, t->behind, t->sum[SURFMINK__TURNING]);
    for (first = 1; first <= job->max_rank; first += 3 * SURFMINK__TILES) {
        tiles = SURFMINK__(tiles)(job, first);
        for (tile = 0; tile < tiles; ++tile)
            SURFMINK__(power_sums)(r, g->rows, first + 3 * tile + 3 <= job->max_rank, sum[tile].g);
        ranks = SURFMINK__(ranks_from)(job, first);
        if (k) SURFMINK__(pull_ranks)(job, g, t, sum, first, ranks, k);
        SURFMINK__(write_ranks)(job, t, g, sum, first, tiles);
        if (k) SURFMINK__(pull_powers)(r, g->rows, first, ranks, k);
    }
    if (k) SURFMINK__(back_short)(job, g, t, r, k);
}

/* Rows of the strips of a long outline, from the first on in order: turned_i is counted from where the strip starts. */
SURFMINK__KERNEL void SURFMINK__(measure_strips)(const surfmink__job *job, SURFMINK__(group) *g, size_t row,
                                                 size_t rows, SURFMINK__(rows) *r, SURFMINK__(totals) *t)
{
    double before, wide;
    size_t lane, i, k;
    if (row == 0) SURFMINK__(begin)(t);
    SURFMINK__(measure_rows)(job, g, row, rows, r, t);
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        for (k = 0; k < SURFMINK__SUMS && row == 0; ++k) g->sum[k][lane].high = g->sum[k][lane].low = 0;
        before = surfmink__value(&g->sum[SURFMINK__TURNING][lane]);
        wide = surfmink__abs(before) + t->widest[lane];
        if (row == 0 || wide > g->widest[lane]) g->widest[lane] = wide;
        for (i = lane; i < rows * SURFMINK__LANES && job->kind != SURFMINK__PLANE; i += SURFMINK__LANES)
            r->turned[i] += before;
        for (k = 0; k < SURFMINK__SUMS; ++k) surfmink__add(&g->sum[k][lane], t->sum[k][lane]);
    }
}

/* Lengths and turns into the caller's scratch, or back again. No condition in the loops: gcc 12 makes masked AVX-512
   instructions of those at -O3, and wrong ones. */
SURFMINK__KERNEL void SURFMINK__(keep)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row, size_t rows,
                                       SURFMINK__(rows) *r, int back)
{
    double *at;
    size_t lane, i, some;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        some = row < g->count[lane] ? g->count[lane] - row : 0;
        if (some > rows) some = rows;
        at = job->scratch + 2 * (g->start[lane] + row);
        if (back) {
            for (i = 0; i < some; ++i) {
                r->length[i * SURFMINK__LANES + lane] = at[2 * i];
                r->turned[i * SURFMINK__LANES + lane] = at[2 * i + 1];
            }
            for (; i < rows; ++i) /* padding */
                r->length[i * SURFMINK__LANES + lane] = r->turned[i * SURFMINK__LANES + lane] = 0;
        } else
            for (i = 0; i < some; ++i) {
                at[2 * i] = r->length[i * SURFMINK__LANES + lane];
                at[2 * i + 1] = r->turned[i * SURFMINK__LANES + lane];
            }
    }
}

/* The same for gradients: two numbers of each lane, the number `part` and the next one of six, into the scratch or back
   again. Rows are kept whole; the last one might not fit into six numbers a corner, and stays in the tape. */
SURFMINK__KERNEL void SURFMINK__(stash)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row, size_t rows,
                                        size_t part, double *a, double *b, int back, SURFMINK__(tape) *k)
{
    double *at = job->scratch + 6 * (g->base[0] + SURFMINK__LANES * row), *kept;
    size_t lane, i;
    for (i = 0; i < rows; ++i, at += 6 * SURFMINK__LANES, a += SURFMINK__LANES, b += SURFMINK__LANES) {
        kept = (row + i + 1 < g->rows ? at : k->tail) + part * SURFMINK__LANES;
        for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH)
            if (back) {
                SURFMINK__STORE(a + lane, SURFMINK__LOAD_ANY(kept + lane));
                SURFMINK__STORE(b + lane, SURFMINK__LOAD_ANY(kept + lane + SURFMINK__LANES));
            } else {
                SURFMINK__STORE_ANY(kept + lane, SURFMINK__LOAD(a + lane));
                SURFMINK__STORE_ANY(kept + lane + SURFMINK__LANES, SURFMINK__LOAD(b + lane));
            }
    }
}

/* The strips of a long outline put together, in the first lane of the totals. */
SURFMINK__KERNEL void SURFMINK__(join)(const SURFMINK__(group) *g, SURFMINK__(totals) *t)
{
    surfmink__sum sum;
    double before, widest = 0;
    size_t lane, k;
    for (k = 0; k < SURFMINK__SUMS; ++k) {
        sum.high = sum.low = 0;
        for (lane = 0; lane < SURFMINK__LANES; ++lane) {
            before = surfmink__value(&sum);
            if (k == SURFMINK__TURNING) t->behind[lane] += before;
            if (k == SURFMINK__TURNING && surfmink__abs(before) + g->widest[lane] > widest)
                widest = surfmink__abs(before) + g->widest[lane];
            surfmink__add(&sum, g->sum[k][lane].high);
            surfmink__add(&sum, g->sum[k][lane].low);
        }
        t->sum[k][0] = surfmink__value(&sum);
    }
    for (lane = 1; lane < SURFMINK__LANES; ++lane) {
        if (t->sharpest[lane] > t->sharpest[0]) t->sharpest[0] = t->sharpest[lane];
        if (t->largest[lane] > t->largest[0]) t->largest[0] = t->largest[lane];
    }
    t->widest[0] = widest;
}

/* Cuts an outline into strips of like length. */
SURFMINK__KERNEL void SURFMINK__(cut)(const surfmink__job *job, size_t outline, SURFMINK__(group) *g,
                                      SURFMINK__(rows) *r, SURFMINK__(totals) *t)
{
    size_t dim = job->kind == SURFMINK__PLANE ? 2 : 3, n = job->offset[outline + 1] - job->offset[outline], lane, k;
    const double *corner = job->corner + dim * job->offset[outline];
    g->used = 1;
    g->rows = (n + SURFMINK__LANES - 1) / SURFMINK__LANES;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        g->outline[lane] = outline;
        g->base[lane] = job->offset[outline];
        g->size[lane] = n;
        g->start[lane] = g->base[lane] + lane * g->rows;
        g->count[lane] = n - lane * g->rows < g->rows ? n - lane * g->rows : g->rows;
        t->expected[lane] = (double)(ptrdiff_t)n;
        for (k = 0; k < 2 * dim; ++k) r->first[k % dim][k / dim * SURFMINK__LANES + lane] = corner[k] * job->scale;
    }
}

/* Pulls ranks of rows of strips, of which everything is in the caller's scratch. */
SURFMINK__KERNEL void SURFMINK__(pull_strips)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row,
                                              size_t rows, int first, int ranks, SURFMINK__(rows) *r,
                                              SURFMINK__(tape) *k)
{
    if (ranks > 0 || job->kind == SURFMINK__PLANE) /* else there have been no phases */
        SURFMINK__(stash)(job, g, row, rows, 4, r->column[2], r->column[3], 1, k);
    if (first > 1) SURFMINK__(stash)(job, g, row, rows, 2, k->by_length, k->by_phase, 1, k);
    if (ranks > 0)
        SURFMINK__(pull_powers)(r, rows, first, ranks, k);
    else
        SURFMINK__(pull_nothing)(rows, k);
}

/* Ranks of an outline in strips: once over them, from the last rows to the first. In the plane the last ranks take the
   way back with them; elsewhere dE/dalpha_i has to wait for the sums of all lanes. */
SURFMINK__KERNEL void SURFMINK__(pull_long)(const surfmink__job *job, const SURFMINK__(group) *g,
                                            const SURFMINK__(totals) *t, int first, int ranks, SURFMINK__(rows) *r,
                                            SURFMINK__(tape) *k)
{
    const int last = first + ranks > job->max_rank;
    size_t block = (g->rows + SURFMINK__ROWS - 1) / SURFMINK__ROWS, blocks = block, row, rows, p, lane;
    for (p = 0; p < 2 * (size_t)ranks * SURFMINK__LANES; p += SURFMINK__LANES)
        for (lane = 1; lane < SURFMINK__LANES; ++lane) k->by_g[p + lane] = k->by_g[p];
    for (lane = 1; lane < SURFMINK__LANES; ++lane) k->by_all[lane] = k->by_all[0];
    while (block-- > 0) {
        row = block * SURFMINK__ROWS;
        rows = g->rows - row < SURFMINK__ROWS ? g->rows - row : SURFMINK__ROWS;
        SURFMINK__(pull_strips)(job, g, row, rows, first, ranks, r, k);
        if (last) {
            if (job->kind == SURFMINK__PLANE) {
                SURFMINK__(stash)(job, g, row, rows, 0, r->length, r->turned, 1, k);
                SURFMINK__(keep_rows)(job, r, rows, k);
            } else
                SURFMINK__(stash)(job, g, row, rows, 0, k->length, k->turned, 1, k);
            SURFMINK__(pull_sums)(job, k->length, rows, t->behind, k);
        }
        if (!last || job->kind != SURFMINK__PLANE) {
            SURFMINK__(stash)(job, g, row, rows, 2, k->by_length, k->by_phase, 0, k);
            continue;
        }
        if (row == 0) SURFMINK__(settle)(g, t, k);
        SURFMINK__(back_rows)(job, g, row, rows, r, k);
    }
    if (!last || job->kind == SURFMINK__PLANE) return;
    SURFMINK__(settle)(g, t, k);
    while (blocks-- > 0) {
        row = blocks * SURFMINK__ROWS;
        rows = g->rows - row < SURFMINK__ROWS ? g->rows - row : SURFMINK__ROWS;
        SURFMINK__(gather_rows)(job, g, row, rows, r);
        SURFMINK__(stash)(job, g, row, rows, 0, k->length, k->turned, 1, k);
        SURFMINK__(stash)(job, g, row, rows, 2, k->by_length, k->by_phase, 1, k);
        SURFMINK__(back_rows)(job, g, row, rows, r, k);
    }
}

/* Outlines with more corners than there are rows, in strips: once over them for S, which every phase needs, and once
   for each 24 ranks. For gradients twice for each 24 ranks, and once for the way back. */
SURFMINK__KERNEL void SURFMINK__(measure_long)(const surfmink__job *job, SURFMINK__(group) *g, SURFMINK__(rows) *r,
                                               SURFMINK__(totals) *t, SURFMINK__(ranks) *sum, SURFMINK__(tape) *k)
{
    SURFMINK__(totals) again;
    SURFMINK__(ranks) part;
    size_t row, rows, lane, j;
    int first, ranks, tile, tiles, kept = job->scratch && job->kind != SURFMINK__PLANE;
    for (row = 0; row < g->rows; row += SURFMINK__ROWS) {
        rows = g->rows - row < SURFMINK__ROWS ? g->rows - row : SURFMINK__ROWS;
        SURFMINK__(measure_strips)(job, g, row, rows, r, t);
        for (lane = 0; lane < SURFMINK__LANES && row == 0; ++lane) t->behind[lane] = -r->turned[0];
        if (k)
            SURFMINK__(stash)(job, g, row, rows, 0, r->length, r->turned, 0, k);
        else if (kept)
            SURFMINK__(keep)(job, g, row, rows, r, 0);
        if (k && job->kind == SURFMINK__PLANE)
            SURFMINK__(stash)(job, g, row, rows, 4, r->column[2], r->column[3], 0, k);
    }
    SURFMINK__(join)(g, t);
    SURFMINK__(judge)(job, t);
    SURFMINK__(write)(job, t, g);
    for (lane = 1; lane < SURFMINK__LANES; ++lane) t->sum[SURFMINK__TURNING][lane] = t->sum[SURFMINK__TURNING][0];
    if (k) SURFMINK__(pull_length)(job, g, k);
    for (first = 1; first <= job->max_rank && g->good > 0; first += 3 * SURFMINK__TILES) {
        tiles = SURFMINK__(tiles)(job, first);
        for (tile = 0; tile < tiles; ++tile)
            for (j = 0; j < 6 * SURFMINK__LANES; ++j) sum[tile].g[j] = 0;
        for (row = 0; row < g->rows; row += SURFMINK__ROWS) {
            rows = g->rows - row < SURFMINK__ROWS ? g->rows - row : SURFMINK__ROWS;
            if (k)
                SURFMINK__(stash)(job, g, row, rows, 0, r->length, r->turned, 1, k);
            else if (kept)
                SURFMINK__(keep)(job, g, row, rows, r, 1);
            else
                SURFMINK__(measure_strips)(job, g, row, rows, r, &again);
            if (job->kind != SURFMINK__PLANE) SURFMINK__(phases)(r, rows, t->behind, t->sum[SURFMINK__TURNING]);
            if (k) SURFMINK__(stash)(job, g, row, rows, 4, r->column[2], r->column[3], job->kind == SURFMINK__PLANE, k);
            SURFMINK__(raise)(r, rows, first - 1);
            for (tile = 0; tile < tiles; ++tile) {
                SURFMINK__(power_sums)(r, rows, tile + 1 < tiles, part.g);
                for (j = 0; j < 6 * SURFMINK__LANES; ++j) sum[tile].g[j] += part.g[j];
            }
        }
        for (tile = 0; tile < tiles; ++tile)
            for (j = 0; j < 6 * SURFMINK__LANES; ++j)
                if (j % SURFMINK__LANES) sum[tile].g[j - j % SURFMINK__LANES] += sum[tile].g[j];
        ranks = SURFMINK__(ranks_from)(job, first);
        if (k) SURFMINK__(pull_ranks)(job, g, t, sum, first, ranks, k);
        SURFMINK__(write_ranks)(job, t, g, sum, first, tiles);
        if (k) SURFMINK__(pull_long)(job, g, t, first, ranks, r, k);
    }
    if (k && g->good > 0 && job->max_rank == 0) SURFMINK__(pull_long)(job, g, t, 1, 0, r, k);
}

/* Asks for the corners from number `at` on, which the next window will want, and want in the order of their number. */
SURFMINK__KERNEL void SURFMINK__(prefetch)(const surfmink__job *job, size_t at, size_t count)
{
    size_t dim = job->kind == SURFMINK__PLANE ? 2 : 3, line = 8, i;
    if (at >= job->end || count > job->end - at) return;
    for (i = dim * at; i < dim * (at + count); i += line) {
        SURFMINK__PREFETCH(job->corner + i);
        if (job->kind == SURFMINK__EMBEDDED) SURFMINK__PREFETCH(job->normal + i);
    }
}

/* Outlines first .. first + count - 1 of a batch, at most SURFMINK__WINDOW. Those that fit are sorted by their number
   of corners, so that the lanes of a group are of like length.
   k            for gradients; or NULL
   left  count  out: 1 where nothing was written because the outline is not ordinary */
SURFMINK__KERNEL void SURFMINK__(outlines)(const surfmink__job *job, size_t first, size_t count, SURFMINK__(tape) *k,
                                           unsigned char *left)
{
    SURFMINK__(rows) r;
    SURFMINK__(totals) t;
    SURFMINK__(ranks) sum[SURFMINK__TILES];
    SURFMINK__(group) g;
    const size_t *offset = job->offset + first;
    size_t place[SURFMINK__ROWS + 2] = {0}, order[SURFMINK__WINDOW], i, n, lane, at, fitting = 0;
    size_t ahead = offset[count];
    for (i = 0; i < count; ++i) {
        n = offset[i + 1] - offset[i];
        left[i] = 0;
        if (offset[i + 1] < offset[i] || offset[i + 1] > job->end || n < 3)
            left[i] = 1;
        else
            ++place[n <= SURFMINK__ROWS ? n : SURFMINK__ROWS + 1];
    }
    at = 0;
    for (n = 3; n < SURFMINK__ROWS + 2; ++n) {
        fitting = at;
        at += place[n];
        place[n] = fitting; /* of those with fewer corners */
    }
    for (i = 0; i < count; ++i) {
        n = offset[i + 1] - offset[i];
        if (!left[i]) order[place[n <= SURFMINK__ROWS ? n : SURFMINK__ROWS + 1]++] = i;
    }
    g.strips = 0;
    for (i = 0; i < fitting; i += SURFMINK__LANES) {
        g.used = fitting - i > SURFMINK__LANES ? SURFMINK__LANES : fitting - i;
        for (lane = 0; lane < SURFMINK__LANES; ++lane) {
            n = order[i + (lane < g.used ? lane : 0)];
            g.outline[lane] = first + n;
            g.base[lane] = g.start[lane] = offset[n];
            g.size[lane] = g.count[lane] = offset[n + 1] - offset[n];
            t.expected[lane] = (double)(ptrdiff_t)g.count[lane];
        }
        g.rows = g.count[g.used - 1];
        SURFMINK__(prefetch)(job, ahead, g.rows * SURFMINK__LANES);
        ahead += g.rows * SURFMINK__LANES;
        SURFMINK__(measure_short)(job, &g, &r, &t, sum, k);
        for (lane = 0; lane < g.used && g.good < g.used; ++lane)
            left[g.outline[lane] - first] = !(t.sum[SURFMINK__GOOD][lane] > 0);
    }
    g.strips = 1;
    for (i = fitting; i < at; ++i) {
        SURFMINK__(cut)(job, first + order[i], &g, &r, &t);
        SURFMINK__(measure_long)(job, &g, &r, &t, sum, k);
        left[order[i]] = g.good == 0;
    }
}

SURFMINK__APART void SURFMINK__(gradients)(const surfmink__job *job, size_t first, size_t count, unsigned char *left)
{
    SURFMINK__(tape) k;
    SURFMINK__(outlines)(job, first, count, &k, left);
}

SURFMINK__KERNEL void SURFMINK__(window)(const surfmink__job *job, size_t first, size_t count, unsigned char *left)
{
    if (job->back)
        SURFMINK__(gradients)(job, first, count, left);
    else
        SURFMINK__(outlines)(job, first, count, NULL, left);
}

#undef SURFMINK__
#undef SURFMINK__LANES
#undef SURFMINK__ALIGNED
#undef SURFMINK__WIDTH
#undef SURFMINK__GANG
#undef SURFMINK__COLUMN
#undef surfmink__real
#undef surfmink__mask
#undef SURFMINK__SET
#undef SURFMINK__LOAD
#undef SURFMINK__STORE
#undef SURFMINK__LOAD_ANY
#undef SURFMINK__STORE_ANY
#undef SURFMINK__MIN
#undef SURFMINK__MAX
#undef SURFMINK__ABS
#undef SURFMINK__LESS
#undef SURFMINK__SELECT
#undef SURFMINK__WHERE
#undef SURFMINK__NEGATE
#undef SURFMINK__SIGNED
#undef SURFMINK__SIGN
#undef SURFMINK__ODD
#undef SURFMINK__SCALED
#undef SURFMINK__RATIO
#undef SURFMINK__ROOT
#undef SURFMINK__FMA
#undef SURFMINK__FNMA
#undef SURFMINK__BARRIER
#undef SURFMINK__INSTANCE
#endif /* SURFMINK__INSTANCE */

#ifdef SURFMINK__REST
#undef SURFMINK__REST

/* The same again for each set of vector instructions in use. */
#if defined(SURFMINK__NATIVE) && SURFMINK__NATIVE != SURFMINK__PLAIN
#define SURFMINK__INSTANCE SURFMINK__NATIVE
#include SURFMINK_FILE
#endif
#ifdef SURFMINK__DISPATCHES
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif
#define SURFMINK__INSTANCE SURFMINK__AVX2
#include SURFMINK_FILE
#ifdef __clang__
#pragma clang attribute pop
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,fma"))), apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,fma")
#endif
#define SURFMINK__INSTANCE SURFMINK__AVX512
#include SURFMINK_FILE
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* --- more arithmetic ---------------------------------------------------------------------------------------------- */

/* NaN fails both comparisons. */
static int surfmink__finite(const double *v, size_t dim)
{
    size_t k;
    for (k = 0; k < dim; ++k)
        if (!(v[k] >= -1.7976931348623157e308 && v[k] <= 1.7976931348623157e308)) return 0;
    return 1;
}

/* A length L that leaves room for rounding: |g_p| <= L, but may come out an ulp above it. */
static int surfmink__writable(double length)
{
    return length <= 1.7976e308;
}

static double surfmink__max_abs(const double *v, size_t dim)
{
    double m = 0;
    size_t k;
    for (k = 0; k < dim; ++k)
        if (surfmink__abs(v[k]) > m) m = surfmink__abs(v[k]);
    return m;
}

/* The power of two that brings a magnitude m > 0 into [1, 2): the same numbers come out of m in any unit. */
static double surfmink__binade(double m)
{
    static const double step[7] = {18446744073709551616.0, 4294967296.0, 65536, 256, 16, 4, 2};
    double scale = surfmink__scale(m);
    int k;
    if (m * scale < 1 && scale < 1e270) scale *= 1.2676506002282294e30; /* 2^100 */
    for (k = 0; k < 7; ++k)
        if (m * scale >= step[k]) scale /= step[k];
    while (m * scale < 1 && scale < 4e307) scale *= 2; /* beyond is no double: denormals stay below 1 */
    return scale;
}

/* Copies a vector, scaled to ordinary magnitude; the scale comes back. A zero vector stays zero. */
static double surfmink__shrink(const double *v, size_t dim, double *out)
{
    double m = surfmink__max_abs(v, dim);
    double scale = m > 0 ? surfmink__scale(m) : 1;
    size_t k;
    for (k = 0; k < dim; ++k) out[k] = v[k] * scale;
    return scale;
}

static void surfmink__sub(const double *a, const double *b, size_t dim, double *difference)
{
    size_t k;
    for (k = 0; k < dim; ++k) difference[k] = a[k] - b[k];
}

/* Euclidean length of a vector of 2 or 3 components, of any magnitude. */
static double surfmink__norm(const double *v, size_t dim)
{
    double u[3] = {0, 0, 0};
    double scale = surfmink__shrink(v, dim, u);
    return SURFMINK_SQRT(surfmink__dot(u, u)) / scale;
}

static void surfmink__unit(const double *v, size_t dim, double *unit)
{
    double u[3] = {0, 0, 0}, norm;
    size_t k;
    surfmink__shrink(v, dim, u);
    norm = SURFMINK_SQRT(surfmink__dot(u, u));
    for (k = 0; k < dim; ++k) unit[k] = u[k] / norm;
}

/* --- numbers with twice the digits: high is the double next to it, low what is left ------------------------------- */

/* Adds a b, for factors of ordinary magnitude: split into a float and a rest they have products that are exact doubles,
   but for the last, which is next to nothing; no compiler can spoil that by fusing a product with a sum. */
static void surfmink__add_product(surfmink__sum *sum, double a, double b)
{
    double a_high = (double)(float)a, b_high = (double)(float)b, a_low = a - a_high, b_low = b - b_high;
    surfmink__add(sum, a_high * b_high);
    surfmink__add(sum, a_high * b_low);
    surfmink__add(sum, a_low * b_high);
    surfmink__add(sum, a_low * b_low);
}

static void surfmink__add_fine(surfmink__sum *sum, surfmink__sum a, surfmink__sum b)
{
    surfmink__add_product(sum, a.high, b.high);
    surfmink__add(sum, a.high * b.low);
    surfmink__add(sum, a.low * b.high);
}

static surfmink__sum surfmink__fine(double high, double low)
{
    surfmink__sum fine;
    fine.high = high;
    fine.low = 0;
    surfmink__add(&fine, low);
    return fine;
}

static surfmink__sum surfmink__minus(surfmink__sum a)
{
    a.high = -a.high;
    a.low = -a.low;
    return a;
}

/* a b + c d */
static surfmink__sum surfmink__fine_pair(surfmink__sum a, surfmink__sum b, surfmink__sum c, surfmink__sum d)
{
    surfmink__sum sum = {0, 0};
    surfmink__add_fine(&sum, a, b);
    surfmink__add_fine(&sum, c, d);
    return surfmink__fine(sum.high, sum.low);
}

static surfmink__sum surfmink__fine_dot(const surfmink__sum a[3], const surfmink__sum b[3])
{
    surfmink__sum sum = {0, 0};
    size_t k;
    for (k = 0; k < 3; ++k) surfmink__add_fine(&sum, a[k], b[k]);
    return surfmink__fine(sum.high, sum.low);
}

static void surfmink__fine_cross(const surfmink__sum a[3], const surfmink__sum b[3], surfmink__sum c[3])
{
    c[0] = surfmink__fine_pair(a[1], b[2], surfmink__minus(a[2]), b[1]);
    c[1] = surfmink__fine_pair(a[2], b[0], surfmink__minus(a[0]), b[2]);
    c[2] = surfmink__fine_pair(a[0], b[1], surfmink__minus(a[1]), b[0]);
}

static surfmink__sum surfmink__fine_root(surfmink__sum x)
{
    double root = SURFMINK_SQRT(x.high);
    surfmink__add_product(&x, -root, root);
    return surfmink__fine(root, surfmink__value(&x) / (2 * root));
}

/* Brings a vector into [1, 2), its largest component, by a power of two, which comes back. Zero stays zero. */
static double surfmink__fine_shrink(surfmink__sum *v, size_t dim)
{
    double m = 0, scale;
    size_t k;
    for (k = 0; k < dim; ++k)
        if (surfmink__abs(v[k].high) > m) m = surfmink__abs(v[k].high);
    scale = m > 0 ? surfmink__binade(m) : 1;
    for (k = 0; k < dim; ++k) {
        v[k].high *= scale;
        v[k].low *= scale;
    }
    return scale;
}

static int surfmink__blame(int status, size_t corner, size_t *bad)
{
    if (bad) *bad = corner;
    return status;
}

/* --- 1. measure --------------------------------------------------------------------------------------------------- */

/* An outline, whatever its surface: corners are measured one at a time, so that no call needs memory for all. */
typedef struct surfmink__outline {
    const double *corner;           /* plane 2 n, sphere and embedded 3 n */
    const double *normal;           /* embedded 3 n */
    const double *length, *turning; /* measured n */
    double radius, scale;           /* sphere: radius; power of two that makes corner 0 ordinary */
    size_t n;
    enum surfmink__kind kind;
    int dim; /* doubles a corner */
} surfmink__outline;

static size_t surfmink__next(const surfmink__outline *o, size_t i)
{
    return i + 1 < o->n ? i + 1 : 0;
}

static size_t surfmink__previous(const surfmink__outline *o, size_t i)
{
    return i > 0 ? i - 1 : o->n - 1;
}

/* Angle from y = sine, x = cosine up to a common factor. An exact spike (within rounding) has no sign: +pi it is. */
static double surfmink__angle(double y, double x)
{
    if (x < 0 && surfmink__abs(y) <= -8 * surfmink__eps * x) return surfmink__pi;
    return SURFMINK_ATAN2(y, x);
}

/* Turn from one direction in a plane to another, of any magnitudes. */
static double surfmink__turn_plane(const double in[2], const double out[2])
{
    surfmink__sum a[2], b[2];
    size_t k;
    for (k = 0; k < 2; ++k) {
        a[k] = surfmink__fine(in[k], 0);
        b[k] = surfmink__fine(out[k], 0);
    }
    surfmink__fine_shrink(a, 2);
    surfmink__fine_shrink(b, 2);
    return surfmink__angle(surfmink__fine_pair(a[0], b[1], surfmink__minus(a[1]), b[0]).high,
                           surfmink__fine_pair(a[0], b[0], a[1], b[1]).high);
}

/* Corner i of a sphere, scaled like corner 0 so that differences stay exact; on its own if far off. The scale comes
   back. */
static double surfmink__sphere_point(const surfmink__outline *o, size_t i, double x[3])
{
    const double *corner = o->corner + 3 * i;
    double m = surfmink__max_abs(corner, 3), scale = o->scale;
    size_t k;
    if (!(m * scale < 32 && m * scale >= 1.0 / 32)) scale = surfmink__binade(m);
    for (k = 0; k < 3; ++k) x[k] = corner[k] * scale;
    return scale;
}

/* Corner i in space. */
static void surfmink__point(const surfmink__outline *o, size_t i, double x[3])
{
    const double *corner = o->corner + (size_t)o->dim * i;
    if (o->kind == SURFMINK__SPHERE) {
        surfmink__sphere_point(o, i, x);
        return;
    }
    x[0] = corner[0];
    x[1] = corner[1];
    x[2] = o->dim == 3 ? corner[2] : 0;
}

/* The normal at corner i, of ordinary length. */
static void surfmink__axis(const surfmink__outline *o, size_t i, surfmink__sum axis[3])
{
    const double up[3] = {0, 0, 1};
    const double *normal = o->kind == SURFMINK__PLANE ? up : o->kind == SURFMINK__SPHERE ? o->corner : o->normal;
    size_t k, at = o->kind == SURFMINK__PLANE ? 0 : 3 * i;
    for (k = 0; k < 3; ++k) axis[k] = surfmink__fine(normal[at + k], 0);
    surfmink__fine_shrink(axis, 3);
}

/* n x (y - x): the edge from x to y as seen along the normal n and turned by 90 degrees, times a power of two, which
   comes back. What rounding takes from y - x is kept, and what is along n is taken off first: where that is almost all,
   what is left needs all its digits. A multiple of 24 bits is exact, and three times that is enough. */
static double surfmink__seen(const surfmink__sum n[3], const double x[3], const double y[3], surfmink__sum seen[3])
{
    surfmink__sum edge[3];
    double scale, along, nn = 0, high;
    size_t k;
    int times;
    for (k = 0; k < 3; ++k) {
        edge[k] = surfmink__fine(y[k], -x[k]);
        nn += n[k].high * n[k].high;
    }
    scale = surfmink__fine_shrink(edge, 3);
    for (times = 0; times < 3; ++times) {
        along = 0;
        for (k = 0; k < 3; ++k) along += edge[k].high * n[k].high;
        along = (double)(float)(along / nn);
        for (k = 0; k < 3; ++k) {
            high = (double)(float)n[k].high;
            surfmink__add(edge + k, -along * high);
            surfmink__add(edge + k, -along * (n[k].high - high));
            edge[k] = surfmink__fine(edge[k].high, edge[k].low);
        }
    }
    surfmink__fine_cross(n, edge, seen);
    return scale;
}

static double surfmink__fine_norm(const surfmink__sum v[3])
{
    double u[3];
    size_t k;
    for (k = 0; k < 3; ++k) u[k] = v[k].high;
    return surfmink__norm(u, 3);
}

/* n . (a x b) for a and b orthogonal to n: |n| |a| |b| times the sine of the turn from a to b. */
static surfmink__sum surfmink__fine_triple(const surfmink__sum n[3], const surfmink__sum a[3], const surfmink__sum b[3])
{
    surfmink__sum cross[3];
    surfmink__fine_cross(a, b, cross);
    return surfmink__fine_dot(n, cross);
}

/* What a corner is measured from. */
typedef struct surfmink__corner {
    double before[3], x[3], next[3];
    surfmink__sum n[3];
} surfmink__corner;

static surfmink__corner surfmink__corner_of(const surfmink__outline *o, size_t i)
{
    surfmink__corner c;
    surfmink__point(o, surfmink__previous(o, i), c.before);
    surfmink__point(o, i, c.x);
    surfmink__point(o, surfmink__next(o, i), c.next);
    surfmink__axis(o, i, c.n);
    return c;
}

/* Cosine and sine of the turn at a corner, up to a common factor, with twice the digits. */
static void surfmink__fine_turn(const surfmink__corner *c, surfmink__sum turn[2])
{
    surfmink__sum in[3], out[3], along = {0, 0};
    surfmink__seen(c->n, c->before, c->x, in);
    surfmink__seen(c->n, c->x, c->next, out);
    surfmink__add_fine(&along, surfmink__fine_dot(in, out), surfmink__fine_root(surfmink__fine_dot(c->n, c->n)));
    turn[0] = along;
    turn[1] = surfmink__fine_triple(c->n, in, out);
    surfmink__fine_shrink(turn, 2);
}

/* The turn at a corner as the kernels know it, to 1e-16 or so. Returns 0 where that is not enough: an edge is steep, or
   next to nothing beside the other, or turns back. All of that is the same in any unit. */
static int surfmink__plain_turn(const surfmink__corner *c, double *turning)
{
    double in[3], out[3], n[3], in_in, out_out, nn, sine, cosine, in_size, out_size, scale, larger;
    size_t k;
    surfmink__sub(c->x, c->before, 3, in);
    surfmink__sub(c->next, c->x, 3, out);
    in_size = surfmink__max_abs(in, 3);
    out_size = surfmink__max_abs(out, 3);
    scale = surfmink__binade(in_size > out_size ? in_size : out_size);
    if (in_size * scale < 1e-60 || out_size * scale < 1e-60) return 0;
    for (k = 0; k < 3; ++k) {
        in[k] *= scale;
        out[k] *= scale;
        n[k] = c->n[k].high;
    }
    in_in = surfmink__dot(in, in);
    out_out = surfmink__dot(out, out);
    nn = surfmink__dot(n, n);
    surfmink__turn(in, in_in, out, out_out, n, nn, SURFMINK_SQRT(nn), surfmink__dot(out, n), &sine, &cosine);
    larger = surfmink__abs(sine) > surfmink__abs(cosine) ? surfmink__abs(sine) : surfmink__abs(cosine);
    if (!(larger > 0.35 * nn * SURFMINK_SQRT(in_in * out_out))) return 0;
    if (cosine < 0 && surfmink__abs(sine) < -1e-9 * cosine) return 0;
    *turning = SURFMINK_ATAN2(sine, cosine);
    return 1;
}

/* The angle at the centre of the great-circle edge from corner i to the next. Corners are refused as coincident if no
   more than what rounding makes of their distances from the centre keeps them apart, as antipodal within 8 eps: there
   the direction of the edge would be the rounding of the corners. */
static int surfmink__arc(const surfmink__outline *o, size_t i, double *angle)
{
    double x[3], y[3], edge[3], m[3], x_norm, y_norm, sine, cosine, off = 1;
    surfmink__sum n[3], seen[3];
    int apart = surfmink__abs(surfmink__sphere_point(o, i, x) - surfmink__sphere_point(o, surfmink__next(o, i), y)) > 0;
    x_norm = surfmink__norm(x, 3);
    y_norm = surfmink__norm(y, 3);
    surfmink__sub(y, x, 3, edge);
    surfmink__cross(x, edge, m);
    sine = surfmink__norm(m, 3) / x_norm / y_norm;
    if (!(1.5 * sine * y_norm > surfmink__norm(edge, 3))) { /* steep: m may have lost digits */
        surfmink__axis(o, i, n);
        sine = 1 / surfmink__seen(n, x, y, seen);
        sine *= surfmink__fine_norm(seen) / surfmink__fine_norm(n) / y_norm;
    }
    cosine = surfmink__dot(x, y) / x_norm / y_norm;
    if (!apart) off = surfmink__abs(y_norm - x_norm) / (x_norm > y_norm ? x_norm : y_norm);
    if (cosine < 0 && !(sine > 8 * surfmink__eps)) return SURFMINK_ANTIPODAL_CORNERS;
    if (!(sine > 8 * surfmink__eps * off)) return SURFMINK_COINCIDENT_CORNERS;
    *angle = SURFMINK_ATAN2(sine, cosine);
    return SURFMINK_OK;
}

/* Is there something wrong with a corner, whatever its neighbours? */
static int surfmink__check_corner(const surfmink__outline *o, size_t i)
{
    size_t dim = (size_t)o->dim;
    const double *corner, *normal;
    if (o->kind == SURFMINK__MEASURED) {
        if (!surfmink__finite(o->length + i, 1) || !surfmink__finite(o->turning + i, 1)) return SURFMINK_NOT_FINITE;
        return o->length[i] >= 0 ? SURFMINK_OK : SURFMINK_BAD_ARGUMENT;
    }
    corner = o->corner + dim * i;
    if (!surfmink__finite(corner, dim)) return SURFMINK_NOT_FINITE;
    if (o->kind == SURFMINK__PLANE) return SURFMINK_OK;
    normal = o->kind == SURFMINK__SPHERE ? corner : o->normal + 3 * i;
    if (!surfmink__finite(normal, 3)) return SURFMINK_NOT_FINITE;
    return surfmink__max_abs(normal, 3) > 0 ? SURFMINK_OK : SURFMINK_ZERO_NORMAL;
}

/* Does the edge from x to y run along the normal at corner i, so that it has no direction in the tangent plane? 1e-6
   rad, in sine. */
static int surfmink__upright(const surfmink__outline *o, size_t i, const double *x, const double *y)
{
    double edge[3], e[3], axis[3], along, size;
    surfmink__sum n[3], seen[3];
    size_t k;
    surfmink__sub(y, x, 3, edge);
    surfmink__axis(o, i, n);
    surfmink__shrink(edge, 3, e);
    for (k = 0; k < 3; ++k) axis[k] = n[k].high;
    along = surfmink__dot(e, axis);
    if (2 * along * along < surfmink__dot(e, e) * surfmink__dot(axis, axis)) return 0; /* not even steep */
    size = surfmink__norm(edge, 3) * surfmink__seen(n, x, y, seen) * surfmink__fine_norm(n);
    return !(surfmink__fine_norm(seen) > 1e-6 * size);
}

/* Is there something wrong with the edge from corner i to the next? */
static int surfmink__check_edge(const surfmink__outline *o, size_t i)
{
    size_t next = surfmink__next(o, i), dim = (size_t)o->dim;
    double edge[3], angle;
    const double *a, *b;
    if (o->kind == SURFMINK__MEASURED) return SURFMINK_OK;
    if (o->kind == SURFMINK__SPHERE) return surfmink__arc(o, i, &angle);
    a = o->corner + dim * i;
    b = o->corner + dim * next;
    surfmink__sub(b, a, dim, edge);
    if (!(surfmink__max_abs(edge, dim) <= 1e308)) return SURFMINK_NOT_FINITE; /* or its length may not be */
    if (!(surfmink__max_abs(edge, dim) > 0)) return SURFMINK_COINCIDENT_CORNERS;
    if (o->kind == SURFMINK__EMBEDDED && (surfmink__upright(o, i, a, b) || surfmink__upright(o, next, a, b)))
        return SURFMINK_UPRIGHT_EDGE;
    return SURFMINK_OK;
}

/* Everything that can be said corner by corner, before anything is written. An edge is blamed on its later corner. */
static int surfmink__check(const surfmink__outline *o, size_t *bad)
{
    size_t i;
    int status;
    if (o->n < 3) return surfmink__blame(SURFMINK_TOO_FEW_CORNERS, o->n, bad);
    for (i = 0; i < o->n; ++i)
        if ((status = surfmink__check_corner(o, i)) != SURFMINK_OK) return surfmink__blame(status, i, bad);
    for (i = 0; i < o->n; ++i)
        if ((status = surfmink__check_edge(o, i)) != SURFMINK_OK)
            return surfmink__blame(status, i + 1 < o->n ? i + 1 : i, bad);
    return SURFMINK_OK;
}

/* Length of edge i and turning angle at corner i of an outline that has passed surfmink__check. With twice the digits,
   if the turn itself is asked for; it is zero where there is none. */
static void surfmink__measure_corner(const surfmink__outline *o, size_t i, double *length, double *turning,
                                     surfmink__sum *turn)
{
    double edge[3], angle = 0;
    surfmink__sum fine[2];
    surfmink__corner c;
    size_t dim = (size_t)o->dim;
    if (o->kind == SURFMINK__MEASURED) {
        *length = o->length[i];
        *turning = o->turning[i];
        turn[0] = turn[1] = surfmink__fine(0, 0);
        return;
    }
    if (o->kind == SURFMINK__SPHERE) {
        surfmink__arc(o, i, &angle);
        *length = o->radius * angle;
    } else {
        surfmink__sub(o->corner + dim * surfmink__next(o, i), o->corner + dim * i, dim, edge);
        *length = surfmink__norm(edge, dim);
    }
    c = surfmink__corner_of(o, i);
    if (!turn && surfmink__plain_turn(&c, turning)) return;
    surfmink__fine_turn(&c, turn ? turn : fine);
    *turning = turn ? surfmink__angle(turn[1].high, turn[0].high) : surfmink__angle(fine[1].high, fine[0].high);
}

static surfmink__outline surfmink__outline_of(enum surfmink__kind kind, const double *corner, const double *normal,
                                              size_t n)
{
    surfmink__outline o;
    o.kind = kind;
    o.dim = kind == SURFMINK__PLANE ? 2 : 3;
    o.corner = corner;
    o.normal = normal;
    o.length = o.turning = NULL;
    o.radius = o.scale = 1;
    o.n = n;
    return o;
}

static surfmink__outline surfmink__outline_measured(const double *length, const double *turning, size_t n)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__MEASURED, NULL, NULL, n);
    o.length = length;
    o.turning = turning;
    return o;
}

/* A radius, or a distance: finite even if multiplied by 2 pi. */
static int surfmink__positive(double x)
{
    return x > 0 && x <= 1e307;
}

static surfmink__outline surfmink__outline_sphere(const double *corner, size_t n, double radius)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__SPHERE, corner, NULL, n);
    double m = n > 0 && surfmink__finite(corner, 3) ? surfmink__max_abs(corner, 3) : 0;
    o.radius = radius;
    o.scale = m > 0 ? surfmink__binade(m) : 1;
    return o;
}

static int surfmink__edges(const surfmink__outline *o, double *length, double *turning, size_t *bad)
{
    size_t i;
    int status = surfmink__check(o, bad);
    if (status != SURFMINK_OK) return status;
    for (i = 0; i < o->n; ++i) surfmink__measure_corner(o, i, length + i, turning + i, NULL);
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_edges_plane(const double *corner, size_t n, double *length, double *turning, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    return surfmink__edges(&o, length, turning, bad);
}

SURFMINK_DEF int surfmink_edges_sphere(const double *corner, size_t n, double radius, double *length, double *turning,
                                       size_t *bad)
{
    surfmink__outline o = surfmink__outline_sphere(corner, n, radius);
    if (!surfmink__positive(radius)) return surfmink__blame(SURFMINK_BAD_ARGUMENT, n, bad);
    return surfmink__edges(&o, length, turning, bad);
}

SURFMINK_DEF int surfmink_edges_embedded(const double *corner, const double *normal, size_t n, double *length,
                                         double *turning, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    return surfmink__edges(&o, length, turning, bad);
}

/* Asks the log of a surface, and mistrusts it: its direction has to be one, and its length positive. */
static int surfmink__log(const surfmink_surface *surface, const double *x, const double *y, double *length,
                         double direction[2])
{
    int status;
    *length = direction[0] = direction[1] = 0;
    status = (surface->log)(surface->context, x, y, length, direction); /* in brackets: tgmath.h has macros */
    if (status != SURFMINK_OK) return *surfmink_strerror(status) ? status : SURFMINK_CALLBACK_FAILED;
    if (!surfmink__finite(length, 1) || !surfmink__finite(direction, 2) || *length < 0) return SURFMINK_CALLBACK_FAILED;
    if (!(*length > 0)) return SURFMINK_COINCIDENT_CORNERS;
    return surfmink__max_abs(direction, 2) > 0 ? SURFMINK_OK : SURFMINK_CALLBACK_FAILED;
}

/* Length of the edge from a corner to the next, and the turn at the corner. */
static int surfmink__log_corner(const surfmink_surface *surface, const double *before, const double *x,
                                const double *next, double *length, double *turning)
{
    double in[2], out[2], back;
    int status = surfmink__log(surface, x, before, &back, in);
    if (status == SURFMINK_OK) status = surfmink__log(surface, x, next, length, out);
    if (status != SURFMINK_OK) return status;
    in[0] = -in[0]; /* the way back to the previous corner points against the edge that arrives */
    in[1] = -in[1];
    *turning = surfmink__turn_plane(in, out);
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_edges_surface(const surfmink_surface *surface, const double *corner, size_t n,
                                        double *scratch, double *length, double *turning, size_t *bad)
{
    size_t i, previous, next;
    int status;
    if (n < 3) return surfmink__blame(SURFMINK_TOO_FEW_CORNERS, n, bad);
    if (!surface->log || surface->stride == 0) return surfmink__blame(SURFMINK_BAD_ARGUMENT, n, bad);
    for (i = 0; i < n; ++i) {
        previous = i > 0 ? i - 1 : n - 1;
        next = i + 1 < n ? i + 1 : 0;
        status = surfmink__log_corner(surface, corner + previous * surface->stride, corner + i * surface->stride,
                                      corner + next * surface->stride, scratch + i, scratch + n + i);
        if (status != SURFMINK_OK) return surfmink__blame(status, i, bad);
    }
    for (i = 0; i < n; ++i) {
        length[i] = scratch[i];
        turning[i] = scratch[n + i];
    }
    return SURFMINK_OK;
}

/* Shoelace about corner 0, with edges as differences: a x e, where a leads from corner 0 to the edge e. */
static double surfmink__area_plane(const surfmink__outline *o)
{
    surfmink__sum twice = {0, 0};
    double largest = surfmink__max_abs(o->corner, 2 * o->n), scale = largest > 0 ? surfmink__scale(largest) : 1;
    double corner[2], next[2], a[2], e[2], first[2];
    size_t i, k;
    for (k = 0; k < 2; ++k) {
        first[k] = o->corner[k] * scale;
        next[k] = o->corner[2 + k] * scale;
    }
    for (i = 1; i + 1 < o->n; ++i) {
        for (k = 0; k < 2; ++k) {
            corner[k] = next[k];
            next[k] = o->corner[2 * i + 2 + k] * scale;
        }
        surfmink__sub(corner, first, 2, a);
        surfmink__sub(next, corner, 2, e);
        surfmink__add(&twice, a[0] * e[1] - a[1] * e[0]);
    }
    return surfmink__value(&twice) / 2 / scale / scale;
}

/* Solid angle to the left of a polygon on the unit sphere, modulo 4 pi: a fan of triangles (a, x, y) from one corner a.
   Each is 2 atan2(a.(x x y), |a||x||y| + |y| a.x + |a| x.y + |x| y.a), its numerator put together from the sides as
   seen along a, so that small ones keep their digits; the denominator does not where corners are almost opposite, and
   the error, in eps, tells. Returns 0 where a corner is farther from the apex than an angle with the cosine `reach`:
   next to the point opposite to it triangles have no definite area. */
static int surfmink__fan(const surfmink__outline *o, size_t apex, double reach, double *solid_angle, double *error)
{
    surfmink__sum sum = {0, 0}, n[3], to_x[3], to_y[3];
    double a[3], x[3], y[3], axis[3], n_norm, x_norm, y_norm, nx, ny, x_scale = 1, y_scale, twice, across, norms;
    size_t i, k, at = apex;
    surfmink__sphere_point(o, apex, a);
    surfmink__axis(o, apex, n);
    for (k = 0; k < 3; ++k) {
        axis[k] = n[k].high;
        to_x[k] = n[k]; /* the first triangle has no area */
        x[k] = a[k];
    }
    n_norm = surfmink__norm(axis, 3);
    for (i = 0; i < o->n; ++i) {
        surfmink__sphere_point(o, i, y);
        if (!(surfmink__dot(axis, y) > reach * n_norm * surfmink__norm(y, 3))) return 0;
    }
    *error = 0;
    x_norm = surfmink__norm(a, 3);
    nx = n_norm * x_norm;
    for (i = 1; i < o->n; ++i) {
        at = surfmink__next(o, at);
        surfmink__sphere_point(o, at, y);
        y_norm = surfmink__norm(y, 3);
        y_scale = surfmink__seen(n, a, y, to_y);
        ny = surfmink__dot(axis, y);
        if (i > 1) {
            twice = surfmink__fine_triple(n, to_x, to_y).high / (n_norm * n_norm) / x_scale / y_scale;
            norms = n_norm * x_norm * y_norm;
            across = norms + y_norm * nx + n_norm * surfmink__dot(x, y) + x_norm * ny;
            *error += 4 * norms * surfmink__abs(twice) / (twice * twice + across * across);
            surfmink__add(&sum, 2 * SURFMINK_ATAN2(twice, across));
        }
        for (k = 0; k < 3; ++k) {
            x[k] = y[k];
            to_x[k] = to_y[k];
        }
        x_norm = y_norm;
        x_scale = y_scale;
        nx = ny;
    }
    *solid_angle = surfmink__value(&sum);
    return 1;
}

/* A sum of turns. Where they have twice the digits their product as complex numbers is kept too: its angle is the sum
   but for multiples of 2 pi, and has all digits, while turns that are rounded one by one would be off by
   eps sum |alpha|, which is a lot for a small sum. */
typedef struct surfmink__path {
    surfmink__sum turned, z[2];
} surfmink__path;

static surfmink__path surfmink__path_of(void)
{
    surfmink__path path = {{0, 0}, {{1, 0}, {0, 0}}};
    return path;
}

static void surfmink__turn_by(surfmink__path *path, double alpha, const surfmink__sum turn[2])
{
    surfmink__sum *z = path->z, re;
    surfmink__add(&path->turned, alpha);
    re = surfmink__fine_pair(z[0], turn[0], surfmink__minus(z[1]), turn[1]);
    z[1] = surfmink__fine_pair(z[0], turn[1], z[1], turn[0]);
    z[0] = re;
    surfmink__fine_shrink(z, 2);
}

static double surfmink__turned(const surfmink__path *path)
{
    double roughly = surfmink__value(&path->turned), angle, windings;
    surfmink__sum sum = {0, 0};
    if (!(surfmink__abs(path->z[0].high) + surfmink__abs(path->z[1].high) > 0)) return roughly;
    angle = SURFMINK_ATAN2(path->z[1].high, path->z[0].high);
    windings = (roughly - angle) / surfmink__two_pi;
    windings = (double)(ptrdiff_t)(windings + (windings < 0 ? -0.5 : 0.5));
    surfmink__add_product(&sum, windings, surfmink__two_pi);
    surfmink__add(&sum, windings * 2.4492935982947064e-16); /* what 2 pi has beyond a double */
    surfmink__add(&sum, angle);
    return surfmink__value(&sum);
}

/* Sums over all corners: L, S and, for the condition number and the noise, sum |alpha|. */
static void surfmink__sums(const surfmink__outline *o, double *length, double *turning, double *turned)
{
    surfmink__sum l = {0, 0}, t = {0, 0}, turn[2];
    surfmink__path path = surfmink__path_of();
    double edge, alpha;
    size_t i;
    for (i = 0; i < o->n; ++i) {
        surfmink__measure_corner(o, i, &edge, &alpha, turn);
        surfmink__turn_by(&path, alpha, turn);
        surfmink__add(&l, edge);
        surfmink__add(&t, surfmink__abs(alpha));
    }
    *length = surfmink__value(&l);
    *turning = surfmink__turned(&path);
    *turned = surfmink__value(&t);
}

/* A fan from one of 16 corners, evenly spaced: within 60 degrees if there is one, within 120, or 0.6 degrees short of
   the opposite point. Returns 0 if there is none. */
static int surfmink__solid_angle(const surfmink__outline *o, double *solid_angle, double *error)
{
    static const double reach[3] = {0.5, -0.5, -0.99995};
    size_t apex, k;
    for (k = 0; k < 3; ++k)
        for (apex = 0; apex < o->n; apex += o->n / 16 + 1)
            if (surfmink__fan(o, apex, reach[k], solid_angle, error)) return 1;
    return 0;
}

/* S + solid angle = 2 pi k, whatever was drawn. */
static int surfmink__windings(double turning, double solid_angle)
{
    double windings = (turning + solid_angle) / surfmink__two_pi;
    int k = 0;
    while (k < windings - 0.5) ++k; /* nearest integer, without a libm call */
    while (k > windings + 0.5) --k;
    return k;
}

/* Is S > 0, and more than rounding noise? Corners on a great circle turn by 1e-16 each: hence the second threshold. */
static int surfmink__check_turning(double turning, double turned, size_t n)
{
    double noise = 1e-12 * turned, least = 4 * surfmink__eps * (double)n;
    if (least > noise) noise = least;
    if (turning < -noise) return SURFMINK_CLOCKWISE;
    return turning > noise ? SURFMINK_OK : SURFMINK_TOO_MUCH_CURVATURE;
}

/* The plane encloses no curvature: S is a multiple of 2 pi whatever was drawn, and 2 pi if it is drawn right. */
static int surfmink__judge_plane(const surfmink__outline *o, surfmink_functionals *w)
{
    if (w->turning < -surfmink__pi && w->turning > -3 * surfmink__pi) return SURFMINK_CLOCKWISE;
    if (!(w->turning > surfmink__pi && w->turning < 3 * surfmink__pi)) return SURFMINK_CROSSES_ITSELF;
    w->turning = surfmink__two_pi; /* which the sum of n turns misses by rounding */
    w->area = surfmink__area_plane(o);
    w->curvature = 0;
    return SURFMINK_OK;
}

/* On the sphere an outline that can be drawn without crossings has S + solid angle = 2 pi k with an odd k. A fan knows
   the solid angle modulo 4 pi, and 2 pi - S which of them is meant. It should lie in [0, 4 pi]: that finds loops that
   wind three times. The slack of 1 is for digitised outlines with a hairpin whose two sides overlap. Small angles have
   more digits than 2 pi - S. */
static int surfmink__judge_sphere(const surfmink__outline *o, double turned, surfmink_functionals *w)
{
    double solid_angle, error;
    int status, k;
    w->curvature = surfmink__two_pi - w->turning;
    if (surfmink__solid_angle(o, &solid_angle, &error)) {
        k = surfmink__windings(w->turning, solid_angle);
        if (k % 2 == 0) return SURFMINK_CROSSES_ITSELF;
        if (w->curvature < -1 || w->curvature > 2 * surfmink__two_pi + 1) return SURFMINK_CROSSES_ITSELF;
        if (error < 1) w->curvature = solid_angle + (1 - k) * surfmink__two_pi;
    }
    status = surfmink__check_turning(w->turning, turned, o->n);
    w->area = w->curvature * o->radius * o->radius;
    return status;
}

/* The Minkowski functionals of an outline that has passed surfmink__check, or what is wrong with it as a whole. */
static int surfmink__functionals(const surfmink__outline *o, surfmink_functionals *w)
{
    double turned;
    int status;
    surfmink__sums(o, &w->length, &w->turning, &turned);
    if (!surfmink__writable(w->length)) return SURFMINK_NOT_FINITE;
    if (!(w->length > 0)) return SURFMINK_BAD_ARGUMENT;
    w->area = 0;
    w->curvature = surfmink__two_pi - w->turning;
    if (o->kind == SURFMINK__PLANE)
        status = surfmink__judge_plane(o, w);
    else if (o->kind == SURFMINK__SPHERE)
        status = surfmink__judge_sphere(o, turned, w);
    else
        status = surfmink__check_turning(w->turning, turned, o->n);
    if (status != SURFMINK_OK) return status;
    w->condition = turned > w->turning ? turned / w->turning : 1; /* rounding may take it below */
    return surfmink__finite(&w->area, 1) ? SURFMINK_OK : SURFMINK_NOT_FINITE;
}

SURFMINK_DEF int surfmink_total(const double *length, const double *turning, size_t n, surfmink_functionals *w)
{
    surfmink__outline o = surfmink__outline_measured(length, turning, n);
    surfmink_functionals total = {0, 0, 0, 0, 0};
    int status = surfmink__check(&o, NULL);
    if (status == SURFMINK_OK) status = surfmink__functionals(&o, &total);
    if (status == SURFMINK_OK) *w = total;
    return status;
}

SURFMINK_DEF int surfmink_area_plane(const double *corner, size_t n, double *area)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    double sum;
    if (n < 3) return SURFMINK_TOO_FEW_CORNERS;
    if (!surfmink__finite(corner, 2 * n)) return SURFMINK_NOT_FINITE;
    sum = surfmink__area_plane(&o);
    if (!surfmink__finite(&sum, 1)) return SURFMINK_NOT_FINITE;
    *area = sum;
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_area_sphere(const double *corner, size_t n, double radius, double *area)
{
    surfmink__outline o = surfmink__outline_sphere(corner, n, radius);
    double solid_angle, error = 0, length, turning, turned;
    int status, k = 1, fan;
    if (!surfmink__positive(radius)) return SURFMINK_BAD_ARGUMENT;
    status = surfmink__check(&o, NULL);
    if (status != SURFMINK_OK) return status;
    fan = surfmink__solid_angle(&o, &solid_angle, &error);
    if (!fan || !(error < 1)) { /* then S knows it better */
        surfmink__sums(&o, &length, &turning, &turned);
        if (fan) k = surfmink__windings(turning, solid_angle);
        solid_angle = k * surfmink__two_pi - turning;
    }
    while (solid_angle > surfmink__two_pi) solid_angle -= 2 * surfmink__two_pi;
    while (solid_angle <= -surfmink__two_pi) solid_angle += 2 * surfmink__two_pi;
    solid_angle = solid_angle * radius * radius;
    if (!(surfmink__abs(solid_angle) <= 1.7976931348623157e308)) return SURFMINK_NOT_FINITE;
    *area = solid_angle;
    return SURFMINK_OK;
}

/* --- 2. transport ------------------------------------------------------------------------------------------------- */

/* What a transport multiplies the turn with: f, phi or eta = f - phi (paper 2.3). */
static int surfmink__factor(const double *turning, size_t n, int transport, double *factor)
{
    surfmink__sum total = {0, 0}, turned = {0, 0};
    double s;
    size_t i;
    int status;
    if (n < 3) return SURFMINK_TOO_FEW_CORNERS;
    if (!surfmink__finite(turning, n)) return SURFMINK_NOT_FINITE;
    *factor = 1;
    if (transport == SURFMINK_PARALLEL) return SURFMINK_OK;
    if (transport != SURFMINK_CORRECTED && transport != SURFMINK_DEFECT) return SURFMINK_BAD_ARGUMENT;
    for (i = 0; i < n; ++i) {
        surfmink__add(&total, turning[i]);
        surfmink__add(&turned, surfmink__abs(turning[i]));
    }
    s = surfmink__value(&total);
    status = surfmink__check_turning(s, surfmink__value(&turned), n);
    if (status != SURFMINK_OK) return status;
    *factor = transport == SURFMINK_CORRECTED ? surfmink__two_pi / s : (surfmink__two_pi - s) / s;
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_phases(const double *turning, size_t n, int transport, double *phase)
{
    surfmink__sum turned = {0, 0};
    double factor;
    size_t i;
    int status = surfmink__factor(turning, n, transport, &factor);
    if (status != SURFMINK_OK) return status;
    phase[0] = 0;
    for (i = 1; i < n; ++i) {
        surfmink__add(&turned, turning[i]); /* read before write: phase may be turning */
        phase[i] = factor * surfmink__value(&turned);
    }
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_transport_angle(const double *turning, size_t n, size_t from, ptrdiff_t steps, int transport,
                                          double angle, double *carried)
{
    surfmink__sum turned = {0, 0};
    double factor;
    size_t edge = from;
    int status = surfmink__factor(turning, n, transport, &factor);
    if (status != SURFMINK_OK) return status;
    if (!surfmink__finite(&angle, 1)) return SURFMINK_NOT_FINITE;
    if (from >= n) return SURFMINK_BAD_ARGUMENT;
    for (; steps > 0; --steps) { /* past corner i+1, where the frame of the edge turns to the left */
        edge = edge + 1 < n ? edge + 1 : 0;
        surfmink__add(&turned, turning[edge]);
    }
    for (; steps < 0; ++steps) {
        surfmink__add(&turned, -turning[edge]);
        edge = edge > 0 ? edge - 1 : n - 1;
    }
    *carried = angle - factor * surfmink__value(&turned);
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_transport_vector(const double *corner, const double *normal, const double *turning, size_t n,
                                           size_t from, ptrdiff_t steps, int transport, const double vector[3],
                                           double carried[3])
{
    double start[9], end[9], angle, along_nu, along_tau, cosine, sine;
    ptrdiff_t left;
    size_t to, k;
    int status = surfmink_transport_angle(turning, n, from, steps, transport, 0, &angle);
    if (status != SURFMINK_OK) return status;
    left = steps % (ptrdiff_t)n;
    to = left >= 0 ? from + (size_t)left : from + n - (size_t)-left;
    to = to < n ? to : to - n;
    if (!surfmink__finite(vector, 3)) return SURFMINK_NOT_FINITE;
    if ((status = surfmink_frame_embedded(corner, normal, n, from, start)) != SURFMINK_OK) return status;
    if ((status = surfmink_frame_embedded(corner, normal, n, to, end)) != SURFMINK_OK) return status;
    along_nu = surfmink__dot(vector, start);
    along_tau = surfmink__dot(vector, start + 3);
    cosine = SURFMINK_COS(angle);
    sine = SURFMINK_SIN(angle);
    for (k = 0; k < 3; ++k)
        carried[k] =
            (cosine * along_nu - sine * along_tau) * end[k] + (sine * along_nu + cosine * along_tau) * end[3 + k];
    return SURFMINK_OK;
}

/* --- 3. integrate ------------------------------------------------------------------------------------------------- */

/* What is integrated: the edges of an outline from the fiducial point on. Edge `first` is split there, at a fraction of
   its length; its front part comes last, one full turn later. */
typedef struct surfmink__curve {
    const surfmink__outline *outline;
    const double *phase; /* f_i, or NULL: the sum of the turns, with a period to be stretched to 2 pi, if not 0 */
    double period, fraction;
    double length, unit; /* L, and a power of two that makes lengths ordinary, so that no sum overflows or goes under */
    size_t first;
} surfmink__curve;

/* 2 pi turned / period, but for multiples of 2 pi: without them a large one has more digits. */
static double surfmink__phase(double turned, double period)
{
    surfmink__sum rest = {0, 0};
    double periods, scale;
    if (!(period > 0)) return turned;
    periods = turned / period;
    periods = (double)(ptrdiff_t)(periods + (periods < 0 ? -0.5 : 0.5));
    scale = surfmink__scale(period);
    surfmink__add(&rest, turned * scale);
    surfmink__add_product(&rest, -periods, period * scale);
    return surfmink__two_pi * (surfmink__value(&rest) / (period * scale));
}

/* Fills rows with l z and z = exp(i f) of the edges from number `start` of the curve on; `path` is carried from call to
   call. */
static void surfmink__fill(const surfmink__curve *c, size_t start, size_t count, surfmink__path *path,
                           surfmink__rows *r)
{
    const surfmink__outline *o = c->outline;
    surfmink__sum turn[2];
    double length, turning, phase;
    size_t j, k, i;
    for (j = 0; j < count; ++j) {
        k = start + j; /* edges passed since the fiducial point */
        i = c->first + k < o->n ? c->first + k : c->first + k - o->n;
        surfmink__measure_corner(o, i, &length, &turning, turn);
        if (k > 0) surfmink__turn_by(path, turning, turn);
        if (k == 0) length *= 1 - c->fraction;
        if (k == o->n) length *= c->fraction;
        phase = c->phase ? c->phase[i] : surfmink__phase(surfmink__turned(path), c->period);
        r->column[2][j] = SURFMINK_COS(phase);
        r->column[3][j] = SURFMINK_SIN(phase);
        r->length[j] = length * c->unit * r->column[2][j];
        r->turned[j] = length * c->unit * r->column[3][j];
    }
}

/* arg g_p in (-pi, pi]: adding 0 makes +0 of -0, or a negative real g_p might come out at -pi. */
static double surfmink__argument(double re, double im)
{
    return SURFMINK_ATAN2(im + 0.0, re);
}

static double surfmink__modulus(double re, double im)
{
    double v[2];
    v[0] = re;
    v[1] = im;
    return surfmink__norm(v, 2);
}

/* |g_p| / L, which rounding may take an eps or two above 1. */
static double surfmink__ratio(double re, double im, double length)
{
    double mu = surfmink__modulus(re / length, im / length);
    return mu > 1 ? 1 : mu;
}

/* How many ranks are left from `first` on, of those that are done in one go. */
static int surfmink__ranks_left(int first, int max_rank)
{
    return max_rank - first < 3 * SURFMINK__TILES ? max_rank - first + 1 : 3 * SURFMINK__TILES;
}

/* g_p = sum l_i exp(i p f_i) of `ranks` ranks from `first` on, times the unit of the curve. */
static void surfmink__sum_ranks(const surfmink__curve *c, int first, int ranks, surfmink__sum *sum)
{
    surfmink__rows rows;
    surfmink__path path = surfmink__path_of();
    size_t count = c->outline->n + (c->fraction > 0 ? 1 : 0), start, size;
    double part[6];
    int p, k;
    for (k = 0; k < 6 * SURFMINK__TILES; ++k) sum[k].high = sum[k].low = 0;
    for (start = 0; start < count; start += size) {
        size = count - start < SURFMINK__ROWS ? count - start : SURFMINK__ROWS;
        surfmink__fill(c, start, size, &path, &rows);
        surfmink__raise(&rows, size, first - 1);
        for (p = 0; p < ranks; p += 3) {
            surfmink__power_sums(&rows, size, p + 3 < ranks, part);
            for (k = 0; k < 6; ++k) surfmink__add(sum + 2 * (size_t)p + k, part[k]);
        }
    }
}

/* g_p, mu_p = |g_p| / L and theta_p = arg(g_p) / p for p = 1..P, 24 ranks at a time; g_0 = L is known. */
static void surfmink__integrate(const surfmink__curve *c, int max_rank, double *mu, double *g, double *theta)
{
    surfmink__sum sum[6 * SURFMINK__TILES];
    double re, im;
    int first, p, ranks;
    if (g) {
        g[0] = c->length;
        g[1] = 0;
    }
    if (mu) mu[0] = 1;
    if (theta) theta[0] = 0;
    for (first = 1; first <= max_rank; first += ranks) {
        ranks = surfmink__ranks_left(first, max_rank);
        surfmink__sum_ranks(c, first, ranks, sum);
        for (p = 0; p < ranks; ++p) {
            re = surfmink__value(sum + 2 * (size_t)p);
            im = surfmink__value(sum + 2 * (size_t)p + 1);
            if (g) {
                g[2 * (size_t)(first + p)] = re / c->unit;
                g[2 * (size_t)(first + p) + 1] = im / c->unit;
            }
            if (mu) mu[first + p] = surfmink__ratio(re, im, c->length * c->unit);
            if (theta) theta[first + p] = surfmink__argument(re, im) / (first + p);
        }
    }
}

static surfmink__curve surfmink__curve_of(const surfmink__outline *o, double length, double period)
{
    surfmink__curve c;
    c.outline = o;
    c.length = length;
    c.unit = length > 0 ? surfmink__scale(length) : 1;
    c.phase = NULL;
    c.period = period;
    c.fraction = 0;
    c.first = 0;
    return c;
}

/* What the two functions below have in common: measured edges, checked, and their sum. */
static int surfmink__check_measured(const surfmink__outline *o, int max_rank, double *length)
{
    double turning, turned;
    int status = max_rank >= 0 ? surfmink__check(o, NULL) : SURFMINK_BAD_ARGUMENT;
    if (status != SURFMINK_OK) return status;
    surfmink__sums(o, length, &turning, &turned);
    return surfmink__writable(*length) ? SURFMINK_OK : SURFMINK_NOT_FINITE;
}

SURFMINK_DEF int surfmink_irreducible(const double *length, const double *phase, size_t n, int max_rank, double *g)
{
    surfmink__outline o = surfmink__outline_measured(length, phase, n);
    surfmink__curve c;
    double total;
    int status = surfmink__check_measured(&o, max_rank, &total);
    if (status != SURFMINK_OK) return status;
    c = surfmink__curve_of(&o, total, 0);
    c.phase = phase;
    surfmink__integrate(&c, max_rank, NULL, g, NULL);
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_irreducible_parallel(const double *length, const double *turning, size_t n, size_t edge,
                                               double fraction, int max_rank, double *g)
{
    surfmink__outline o = surfmink__outline_measured(length, turning, n);
    surfmink__curve c;
    double total;
    int status = surfmink__check_measured(&o, max_rank, &total);
    if (status != SURFMINK_OK) return status;
    if (edge >= n || !(fraction >= 0 && fraction < 1)) return SURFMINK_BAD_ARGUMENT;
    c = surfmink__curve_of(&o, total, 0);
    c.first = edge;
    c.fraction = fraction;
    surfmink__integrate(&c, max_rank, NULL, g, NULL);
    return SURFMINK_OK;
}

/* Real part of (-i)^j (re + i im): what j indices along tau instead of nu make of a component. */
static double surfmink__along_tau(double re, double im, int j)
{
    switch (j % 4) {
    case 0: return re;
    case 1: return im;
    case 2: return -re;
    default: return -im;
    }
}

static double surfmink__half_to(int p)
{
    double power = 1;
    while (p-- > 0) power /= 2;
    return power;
}

/* cos^(p-j) f sin^j f = 2^-p (-i)^j sum_k K_k(j) exp(i (p - 2k) f), with Krawtchouk's polynomials K_k(j), the
   coefficients of (1 + x)^(p-j) (1 - x)^j. They are symmetric, K_(p-k) = (-1)^j K_k: the first half, where their
   recurrence is stable, suffices. */
SURFMINK_DEF int surfmink_tensor(const double *g, int p, double *tensor)
{
    double last, krawtchouk, next, sum;
    const double *at;
    int j, k;
    if (p < 0 || p > 1000) return SURFMINK_BAD_ARGUMENT;
    for (j = 0; j <= p; ++j) {
        last = 0;
        krawtchouk = surfmink__half_to(p);
        sum = 0;
        for (k = 0; 2 * k < p; ++k) {
            at = g + 2 * (size_t)(p - 2 * k);
            sum += 2 * krawtchouk * surfmink__along_tau(at[0], at[1], j);
            next = ((p - 2 * j) * krawtchouk - (p - k + 1) * last) / (k + 1);
            last = krawtchouk;
            krawtchouk = next;
        }
        if (p % 2 == 0) sum += krawtchouk * surfmink__along_tau(g[0], g[1], j);
        tensor[j] = sum;
    }
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_trace_free(const double *g, int p, double *tensor)
{
    double half;
    int j;
    if (p < 0 || p > 1000) return SURFMINK_BAD_ARGUMENT;
    half = surfmink__half_to(p - 1);
    g += 2 * (size_t)p;
    for (j = 0; j <= p; ++j) tensor[j] = half * surfmink__along_tau(g[0], g[1], j);
    return SURFMINK_OK;
}

/* Each contraction with the vector turns neighbours t_j, t_(j+1) into v_0 t_j + v_1 t_(j+1); p - 1 of them give
   binomial sums. */
SURFMINK_DEF int surfmink_contract(const double *tensor, int p, const double vector[2], double contracted[2])
{
    surfmink__sum sum[2] = {{0, 0}, {0, 0}};
    double term, first, second;
    int j, k;
    if (p < 1 || p > 1000) return SURFMINK_BAD_ARGUMENT;
    for (j = 0; j < p; ++j) {
        term = 1;
        for (k = 1; k <= j; ++k) term *= (double)(p - k) / k * vector[1]; /* C(p-1, j) v_1^j */
        for (k = j; k < p - 1; ++k) term *= vector[0];
        surfmink__add(sum, term * tensor[j]);
        surfmink__add(sum + 1, term * tensor[j + 1]);
    }
    first = surfmink__value(sum);
    second = surfmink__value(sum + 1);
    contracted[0] = first;
    contracted[1] = second;
    return SURFMINK_OK;
}

/* --- 4. spectrum -------------------------------------------------------------------------------------------------- */

SURFMINK_DEF int surfmink_spectrum(const double *g, int max_rank, double *lambda, double *mu, double *theta)
{
    double size[2]; /* lambda and lambda / L */
    const double *at;
    int p;
    if (max_rank < 0) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(g, 2 * ((size_t)max_rank + 1))) return SURFMINK_NOT_FINITE;
    if (!(g[0] > 0)) return SURFMINK_BAD_ARGUMENT;
    for (p = 0; p <= max_rank; ++p) {
        at = g + 2 * (size_t)p;
        size[0] = surfmink__modulus(at[0], at[1]);
        size[1] = size[0] / g[0];
        if (!surfmink__finite(size, 2)) return SURFMINK_NOT_FINITE;
    }
    for (p = 0; p <= max_rank; ++p) {
        at = g + 2 * (size_t)p;
        if (lambda) lambda[p] = surfmink__modulus(at[0], at[1]);
        if (mu) mu[p] = surfmink__ratio(at[0], at[1], g[0]);
        if (theta) theta[p] = p > 0 ? surfmink__argument(at[0], at[1]) / p : 0;
    }
    return SURFMINK_OK;
}

static double surfmink__theta(const double *g, int p, int sign, int n)
{
    double half_turns = sign >= 0 ? 2.0 * n : 2.0 * n + 1;
    g += 2 * (size_t)p;
    return (surfmink__argument(g[0], g[1]) + half_turns * surfmink__pi) / p;
}

SURFMINK_DEF int surfmink_angles(const double *g, int p, int sign, double *theta)
{
    int n;
    if (p < 1) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(g + 2 * (size_t)p, 2)) return SURFMINK_NOT_FINITE;
    for (n = 0; n < p; ++n) theta[n] = surfmink__theta(g, p, sign, n);
    return SURFMINK_OK;
}

/* What is wrong with one edge, asked about it alone. */
static int surfmink__check_one(const surfmink__outline *o, size_t edge)
{
    int status;
    if (o->n < 3) return SURFMINK_TOO_FEW_CORNERS;
    if (edge >= o->n) return SURFMINK_BAD_ARGUMENT;
    if ((status = surfmink__check_corner(o, edge)) != SURFMINK_OK) return status;
    if ((status = surfmink__check_corner(o, surfmink__next(o, edge))) != SURFMINK_OK) return status;
    return surfmink__check_edge(o, edge);
}

SURFMINK_DEF int surfmink_frame_plane(const double *corner, size_t n, size_t edge, double frame[4])
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    double along[2];
    int status = surfmink__check_one(&o, edge);
    if (status != SURFMINK_OK) return status;
    surfmink__sub(corner + 2 * surfmink__next(&o, edge), corner + 2 * edge, 2, along);
    surfmink__unit(along, 2, frame + 2);
    frame[0] = frame[3]; /* nu is tau turned to the right, out of a counter-clockwise polygon */
    frame[1] = -frame[2];
    return SURFMINK_OK;
}

/* Co-normal, tangent and normal at the middle of a chord between corners that have passed the checks, with the normals
   at both ends. */
static int surfmink__chord_frame(const double *x, const double *y, const double *x_normal, const double *y_normal,
                                 double frame[9])
{
    double along[3], tau[3], a[3], b[3], mean[3], part;
    size_t k;
    surfmink__sub(y, x, 3, along);
    surfmink__unit(along, 3, tau);
    surfmink__unit(x_normal, 3, a);
    surfmink__unit(y_normal, 3, b);
    for (k = 0; k < 3; ++k) mean[k] = a[k] + b[k];
    part = surfmink__dot(mean, tau);
    for (k = 0; k < 3; ++k) mean[k] -= part * tau[k];
    if (!(surfmink__max_abs(mean, 3) > 1e-6)) return SURFMINK_ZERO_NORMAL; /* the two normals are opposite */
    surfmink__unit(mean, 3, frame + 6);
    for (k = 0; k < 3; ++k) frame[3 + k] = tau[k];
    surfmink__cross(frame + 3, frame + 6, frame); /* nu = tau x normal */
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_frame_embedded(const double *corner, const double *normal, size_t n, size_t edge,
                                         double frame[9])
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    size_t next;
    int status = surfmink__check_one(&o, edge);
    if (status != SURFMINK_OK) return status;
    next = surfmink__next(&o, edge);
    return surfmink__chord_frame(corner + 3 * edge, corner + 3 * next, normal + 3 * edge, normal + 3 * next, frame);
}

SURFMINK_DEF int surfmink_eigenvectors(const double *g, int p, int sign, double phase, const double *frame, int dim,
                                       double *vector)
{
    double theta, cosine, sine;
    int n, k;
    if (p < 1 || dim < 2 || dim > 3) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(g + 2 * (size_t)p, 2) || !surfmink__finite(&phase, 1) ||
        !surfmink__finite(frame, 2 * (size_t)dim))
        return SURFMINK_NOT_FINITE;
    for (n = 0; n < p; ++n) {
        theta = surfmink__theta(g, p, sign, n) - phase;
        cosine = SURFMINK_COS(theta);
        sine = SURFMINK_SIN(theta);
        for (k = 0; k < dim; ++k) vector[n * dim + k] = cosine * frame[k] + sine * frame[dim + k];
    }
    return SURFMINK_OK;
}

/* Co-normal and normal at the middle of a great-circle arc. The co-normal is the pole of the circle. The normal is the
   mean of those at the ends; where these are more than 90 degrees apart their difference, along the tangent, has more
   digits. */
static void surfmink__arc_frame(const surfmink__outline *o, size_t i, double nu[3], double normal[3])
{
    double x[3], y[3], a[3], b[3], pole[3], mean[3], tau[3];
    surfmink__sum n[3], seen[3];
    int wide;
    size_t k;
    surfmink__sphere_point(o, i, x);
    surfmink__sphere_point(o, surfmink__next(o, i), y);
    surfmink__axis(o, i, n);
    surfmink__seen(n, x, y, seen);
    surfmink__unit(x, 3, a);
    surfmink__unit(y, 3, b);
    wide = surfmink__dot(a, b) < 0;
    for (k = 0; k < 3; ++k) {
        pole[k] = -seen[k].high;
        mean[k] = wide ? b[k] - a[k] : b[k] + a[k];
    }
    surfmink__unit(pole, 3, nu);
    surfmink__unit(mean, 3, wide ? tau : normal);
    if (wide) surfmink__cross(nu, tau, normal);
}

/* Co-normal and normal at the middle of edge i, whatever the surface. */
static int surfmink__middle_of_edge(const surfmink__outline *o, size_t i, double nu[3], double normal[3])
{
    const double up[3] = {0, 0, 1};
    const double *x_normal = up, *y_normal = up;
    double x[3], y[3], frame[9];
    size_t next = surfmink__next(o, i), k;
    if (o->kind == SURFMINK__SPHERE) {
        surfmink__arc_frame(o, i, nu, normal);
        return SURFMINK_OK;
    }
    if (o->kind == SURFMINK__EMBEDDED) {
        x_normal = o->normal + 3 * i;
        y_normal = o->normal + 3 * next;
    }
    surfmink__point(o, i, x);
    surfmink__point(o, next, y);
    if (surfmink__chord_frame(x, y, x_normal, y_normal, frame) != SURFMINK_OK) return SURFMINK_ZERO_NORMAL;
    for (k = 0; k < 3; ++k) {
        nu[k] = frame[k];
        normal[k] = frame[6 + k];
    }
    return SURFMINK_OK;
}

/* Means along the outline: of its edges' normals, and of its points, as seen from corner 0 so that digits survive far
   away, and in quarters so that nothing overflows. */
static int surfmink__middle(const surfmink__outline *o, const double *length, double total, double centre[3],
                            double normal[3])
{
    double nu[3], n[3], x[3], y[3], origin[3], sum[3] = {0, 0, 0}, mean[3] = {0, 0, 0}, weight;
    size_t i, k;
    int status;
    surfmink__point(o, 0, origin);
    for (i = 0; i < o->n; ++i) {
        if ((status = surfmink__middle_of_edge(o, i, nu, n)) != SURFMINK_OK) return status;
        surfmink__point(o, i, x);
        surfmink__point(o, surfmink__next(o, i), y);
        weight = length[i] / total;
        for (k = 0; k < 3; ++k) {
            sum[k] += weight * ((0.25 * x[k] - 0.25 * origin[k]) + (0.25 * y[k] - 0.25 * origin[k]));
            mean[k] += weight * n[k];
        }
    }
    if (!(surfmink__norm(mean, 3) > 1e-6)) return SURFMINK_ZERO_NORMAL;
    surfmink__unit(mean, 3, normal);
    for (k = 0; k < 3; ++k) centre[k] = (origin[k] + sum[k]) + sum[k];
    return SURFMINK_OK;
}

/* The co-normal of edge i, tilted to the mean normal N by the smallest rotation that takes n there: as nu is orthogonal
   to n, that is the mirror image in the plane orthogonal to n + N. */
static int surfmink__tilted(const surfmink__outline *o, size_t i, const double normal[3], double tilted[3])
{
    double nu[3], n[3], s[3], part;
    size_t k;
    surfmink__middle_of_edge(o, i, nu, n);
    for (k = 0; k < 3; ++k) s[k] = n[k] + normal[k];
    if (!(surfmink__dot(s, s) > 1e-12)) return SURFMINK_ZERO_NORMAL;
    part = 2 * surfmink__dot(nu, s) / surfmink__dot(s, s);
    for (k = 0; k < 3; ++k) tilted[k] = nu[k] - part * s[k];
    return SURFMINK_OK;
}

/* With chi_i the angle of the tilted co-normal i against that of edge 0, an eigenvector has the angle theta + chi_i -
   f_i there. So theta stays out of the average, sum l_i exp(i p (chi_i - f_i)), which is integrated like g_p. */
static int surfmink__director(const surfmink__outline *o, const double *length, const double *phase, const double *g,
                              int max_rank, double *scratch, double *centre, double *mean_normal, double *direction,
                              double *coherence)
{
    surfmink__outline measured = surfmink__outline_measured(length, phase, o->n);
    surfmink__curve curve;
    double total, middle[3], normal[3], e1[3], e2[3], nu[3], angle, cosine, sine;
    size_t i, k, dim = (size_t)o->dim;
    int p, status = surfmink__check_measured(&measured, max_rank, &total);
    if (status != SURFMINK_OK) return status;
    if ((status = surfmink__check(o, NULL)) != SURFMINK_OK) return status;
    if (!(total > 0)) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(g, 2 * ((size_t)max_rank + 1))) return SURFMINK_NOT_FINITE;
    if ((status = surfmink__middle(o, length, total, middle, normal)) != SURFMINK_OK) return status;
    for (i = 0; i < o->n; ++i) {
        if ((status = surfmink__tilted(o, i, normal, nu)) != SURFMINK_OK) return status;
        for (k = 0; k < 3 && i == 0; ++k) e1[k] = nu[k];
        if (i == 0) surfmink__cross(normal, e1, e2);
        scratch[i] = SURFMINK_ATAN2(surfmink__dot(nu, e2), surfmink__dot(nu, e1)) - phase[i];
    }
    curve = surfmink__curve_of(&measured, total, 0);
    curve.phase = scratch;
    surfmink__integrate(&curve, max_rank, coherence, NULL, direction);
    for (k = 0; k < dim && centre; ++k) centre[k] = middle[k];
    for (k = 0; k < 3 && mean_normal; ++k) mean_normal[k] = normal[k];
    if (!direction) return SURFMINK_OK;
    for (p = max_rank; p > 0; --p) { /* backwards: the angles lie in front of where the vectors go */
        angle = direction[p] + surfmink__theta(g, p, 1, 0);
        cosine = SURFMINK_COS(angle);
        sine = SURFMINK_SIN(angle);
        for (k = 0; k < dim; ++k) direction[(size_t)p * dim + k] = cosine * e1[k] + sine * e2[k];
    }
    for (k = 0; k < dim; ++k) direction[k] = 0;
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_director_plane(const double *corner, size_t n, const double *length, const double *phase,
                                         const double *g, int max_rank, double *scratch, double *centre,
                                         double *direction, double *coherence)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    return surfmink__director(&o, length, phase, g, max_rank, scratch, centre, NULL, direction, coherence);
}

SURFMINK_DEF int surfmink_director_sphere(const double *corner, size_t n, const double *length, const double *phase,
                                          const double *g, int max_rank, double *scratch, double *mean_normal,
                                          double *direction, double *coherence)
{
    surfmink__outline o = surfmink__outline_sphere(corner, n, 1);
    return surfmink__director(&o, length, phase, g, max_rank, scratch, NULL, mean_normal, direction, coherence);
}

SURFMINK_DEF int surfmink_director_embedded(const double *corner, const double *normal, size_t n, const double *length,
                                            const double *phase, const double *g, int max_rank, double *scratch,
                                            double *centre, double *mean_normal, double *direction, double *coherence)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    return surfmink__director(&o, length, phase, g, max_rank, scratch, centre, mean_normal, direction, coherence);
}

/* --- the easy door ------------------------------------------------------------------------------------------------ */

static surfmink__job surfmink__job_of(enum surfmink__kind kind, const double *corner, const double *normal,
                                      double radius, const size_t *offset, int max_rank, const surfmink_results *out,
                                      double *scratch)
{
    surfmink__job job;
    job.kind = kind;
    job.corner = corner;
    job.normal = normal;
    job.radius = job.unit = radius;
    job.scale = 1;
    job.offset = offset;
    job.end = 0;
    job.max_rank = max_rank;
    job.out = out;
    job.back = NULL;
    job.scratch = scratch;
    job.w = NULL;
    return job;
}

/* sum |alpha_i| of an ordinary outline in the plane, where the kernels need no angles. */
static double surfmink__turns_plane(const surfmink__outline *o, double scale)
{
    const double *x = o->corner + 2 * (o->n - 1), *y = o->corner;
    surfmink__sum turned = {0, 0};
    double a[2], b[2];
    size_t i;
    a[0] = (x[0] - x[-2]) * scale;
    a[1] = (x[1] - x[-1]) * scale;
    for (i = 0; i < o->n; ++i, x = y, y += 2) {
        b[0] = (y[0] - x[0]) * scale;
        b[1] = (y[1] - x[1]) * scale;
        surfmink__add(&turned, surfmink__abs(surfmink__atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])));
        a[0] = b[0];
        a[1] = b[1];
    }
    return surfmink__value(&turned);
}

/* An ordinary outline, as a batch of one with a single lane. The scales are its own, so that the same bits come out in
   any unit. Returns whether it was ordinary; if not, nothing is written. */
static int surfmink__quickly(const surfmink__outline *o, int max_rank, double *mu, double *g, double *theta,
                             surfmink_functionals *w, const surfmink__back *back, double *scratch)
{
    size_t offset[2] = {0, 0}, dim = (size_t)o->dim;
    surfmink_results out = {NULL, NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    surfmink__job job = surfmink__job_of(o->kind, o->corner, o->normal, o->radius, offset, max_rank, &out, scratch);
    double edge[3];
    unsigned char left;
    if (o->kind == SURFMINK__MEASURED || o->n < 3) return 0;
    surfmink__sub(o->corner + dim, o->corner, dim, edge);
    if (!surfmink__finite(edge, dim) || !(surfmink__max_abs(edge, dim) > 0)) return 0;
    job.scale = o->kind == SURFMINK__SPHERE ? o->scale : surfmink__binade(surfmink__max_abs(edge, dim));
    if (o->kind != SURFMINK__SPHERE) job.unit = 1 / job.scale;
    offset[1] = job.end = o->n;
    out.mu = mu;
    out.g = g;
    out.theta = theta;
    job.w = w;
    job.back = back;
    surfmink__window(&job, 0, 1, &left);
    if (left) return 0;
    if (w && o->kind == SURFMINK__PLANE) w->condition = surfmink__turns_plane(o, job.scale) / w->turning;
    if (w && w->condition < 1) w->condition = 1; /* by rounding */
    return 1;
}

/* Corner by corner, and twice: once for S, which every phase needs, once for the components. Nothing is written before
   the second. */
static int surfmink__carefully(const surfmink__outline *o, int max_rank, double *mu, double *g, double *theta,
                               surfmink_functionals *w, size_t *bad)
{
    surfmink_functionals total;
    surfmink__curve c;
    int status;
    if ((status = surfmink__check(o, bad)) != SURFMINK_OK) return status;
    if ((status = surfmink__functionals(o, &total)) != SURFMINK_OK) return surfmink__blame(status, o->n, bad);
    c = surfmink__curve_of(o, total.length, total.turning);
    if (mu || g || theta) surfmink__integrate(&c, max_rank, mu, g, theta);
    if (w) *w = total;
    return SURFMINK_OK;
}

static int surfmink__measure(const surfmink__outline *o, int max_rank, double *mu, double *g, double *theta,
                             surfmink_functionals *w, size_t *bad)
{
    if (max_rank < 0) return surfmink__blame(SURFMINK_BAD_ARGUMENT, o->n, bad);
    if (surfmink__quickly(o, max_rank, mu, g, theta, w, NULL, NULL)) return SURFMINK_OK;
    return surfmink__carefully(o, max_rank, mu, g, theta, w, bad);
}

SURFMINK_DEF int surfmink_measure_plane(const double *corner, size_t n, int max_rank, double *mu, double *g,
                                        surfmink_functionals *w, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    return surfmink__measure(&o, max_rank, mu, g, NULL, w, bad);
}

SURFMINK_DEF int surfmink_measure_sphere(const double *corner, size_t n, double radius, int max_rank, double *mu,
                                         double *g, surfmink_functionals *w, size_t *bad)
{
    surfmink__outline o = surfmink__outline_sphere(corner, n, radius);
    if (!surfmink__positive(radius)) return surfmink__blame(SURFMINK_BAD_ARGUMENT, n, bad);
    return surfmink__measure(&o, max_rank, mu, g, NULL, w, bad);
}

SURFMINK_DEF int surfmink_measure_embedded(const double *corner, const double *normal, size_t n, int max_rank,
                                           double *mu, double *g, surfmink_functionals *w, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    return surfmink__measure(&o, max_rank, mu, g, NULL, w, bad);
}

SURFMINK_DEF int surfmink_measure_surface(const surfmink_surface *surface, const double *corner, size_t n,
                                          double *scratch, int max_rank, double *mu, double *g, surfmink_functionals *w,
                                          size_t *bad)
{
    surfmink__outline o = surfmink__outline_measured(scratch, scratch + n, n);
    int status = surfmink_edges_surface(surface, corner, n, scratch, scratch, scratch + n, bad);
    return status == SURFMINK_OK ? surfmink__measure(&o, max_rank, mu, g, NULL, w, bad) : status;
}

/* --- gradients: corner by corner ---------------------------------------------------------------------------------- */

/* Adds to the derivatives by g_p and by L what the weights of rank p say; g_p and L are given times `unit`. */
static void surfmink__pull_weights(const surfmink_weights *weights, size_t p, double re, double im, double length,
                                   double unit, double by_g[2], double *by_length)
{
    const double zero = 0;
    double at[2], by_l = 0;
    at[0] = re;
    at[1] = im;
    by_g[0] = by_g[1] = 0;
    surfmink__pull_rank(at, &length, (double)(ptrdiff_t)p, weights->mu ? weights->mu + p : &zero,
                        weights->theta ? weights->theta + p : NULL, by_g, &by_l);
    by_g[0] *= unit;
    by_g[1] *= -unit; /* it has come conjugate */
    *by_length += unit * by_l;
    if (!weights->g) return;
    by_g[0] += weights->g[2 * p];
    by_g[1] += weights->g[2 * p + 1];
}

/* The weight of L and of g_0, which is the same. */
static double surfmink__by_length(const surfmink_weights *weights)
{
    return (weights->length ? *weights->length : 0) + (weights->g ? *weights->g : 0);
}

/* Adds to dE/dl_i and dE/df_i / l_i what `ranks` ranks from `first` on contribute. */
static void surfmink__pull_phases(const surfmink__curve *c, int first, int ranks, surfmink__tape *k, double *by_length,
                                  double *by_phase)
{
    surfmink__rows rows;
    surfmink__path path = surfmink__path_of();
    size_t start, size, i;
    for (start = 0; start < c->outline->n; start += size) {
        size = c->outline->n - start < SURFMINK__ROWS ? c->outline->n - start : SURFMINK__ROWS;
        surfmink__fill(c, start, size, &path, &rows);
        for (i = 0; i < size && first > 1; ++i) {
            k->by_length[i] = by_length[start + i];
            k->by_phase[i] = by_phase[start + i];
        }
        surfmink__pull_powers(&rows, size, first, ranks, k);
        for (i = 0; i < size; ++i) {
            by_length[start + i] = k->by_length[i];
            by_phase[start + i] = k->by_phase[i];
        }
    }
}

/* What is left of steps 3 and 2 when all ranks are pulled. by_turning comes as dE/df_i / l_i. */
static void surfmink__pull_turns(const surfmink__outline *o, double period, double by_all, double *by_length,
                                 double *by_turning)
{
    surfmink__sum suffix = {0, 0}, moment = {0, 0};
    size_t i;
    for (i = o->n; i-- > 1;) {
        surfmink__add(&suffix, o->length[i] * by_turning[i]);
        by_turning[i] = surfmink__value(&suffix);
        surfmink__add(&moment, o->turning[i] * by_turning[i]);
    }
    by_turning[0] = 0;
    for (i = 0; i < o->n; ++i) {
        by_length[i] += by_all;
        by_turning[i] = surfmink__two_pi / period * (by_turning[i] - surfmink__value(&moment) / period);
    }
}

SURFMINK_DEF int surfmink_pull_spectrum(const surfmink_weights *weights, const double *g, int max_rank, double *by_g)
{
    double unit, by_length;
    size_t p;
    int status = surfmink_spectrum(g, max_rank, NULL, NULL, NULL);
    if (status != SURFMINK_OK) return status;
    unit = surfmink__scale(g[0]);
    by_length = surfmink__by_length(weights);
    for (p = 1; p <= (size_t)max_rank; ++p)
        surfmink__pull_weights(weights, p, g[2 * p] * unit, g[2 * p + 1] * unit, g[0] * unit, unit, by_g + 2 * p,
                               &by_length);
    by_g[0] = by_length;
    by_g[1] = 0;
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_pull_edges(const double *by_g, int max_rank, const double *length, const double *turning,
                                     size_t n, double *by_length, double *by_turning)
{
    surfmink__outline o = surfmink__outline_measured(length, turning, n);
    surfmink_functionals w;
    surfmink__curve c;
    surfmink__tape k;
    size_t i, p, from;
    int first, ranks, status = max_rank >= 0 ? surfmink__check(&o, NULL) : SURFMINK_BAD_ARGUMENT;
    if (status == SURFMINK_OK) status = surfmink__functionals(&o, &w);
    if (status != SURFMINK_OK) return status;
    c = surfmink__curve_of(&o, w.length, w.turning);
    for (i = 0; i < n; ++i) by_length[i] = by_turning[i] = 0;
    for (first = 1; first <= max_rank; first += ranks) {
        ranks = surfmink__ranks_left(first, max_rank);
        from = (size_t)first;
        for (p = 0; p < (size_t)ranks; ++p) {
            k.by_g[2 * p] = by_g[2 * (from + p)];
            k.by_g[2 * p + 1] = -by_g[2 * (from + p) + 1];
        }
        surfmink__pull_phases(&c, first, ranks, &k, by_length, by_turning);
    }
    surfmink__pull_turns(&o, w.turning, by_g[0], by_length, by_turning);
    return SURFMINK_OK;
}

/* Adds a times a vector. */
static void surfmink__add_scaled(double a, const double *v, size_t dim, double *sum)
{
    size_t k;
    for (k = 0; k < dim; ++k) sum[k] += a * v[k];
}

/* Where an edge from x to y, of the given length, is seen along the normal at corner i: q |y - x|, with the vector q by
   which its direction turns as it changes. Returns the cosine of the angle between edge and normal. */
static double surfmink__swing_at(const surfmink__outline *o, size_t i, const double x[3], const double y[3],
                                 const double unit[3], double length, double q[3])
{
    surfmink__sum n[3], seen[3];
    double axis[3], square = 0, norm, scale;
    size_t k;
    surfmink__axis(o, i, n);
    scale = surfmink__seen(n, x, y, seen);
    for (k = 0; k < 3; ++k) {
        axis[k] = n[k].high;
        square += seen[k].high * seen[k].high;
    }
    norm = surfmink__fine_norm(n);
    for (k = 0; k < 3; ++k) q[k] = norm * seen[k].high / square * (length * scale);
    return surfmink__dot(axis, unit) / norm;
}

/* What edge i of the plane or of an embedded surface gives to its corners and their normals: see the kernels. */
static void surfmink__back_edge(const surfmink__outline *o, size_t i, double by_length, double x_turn, double y_turn,
                                double *by_corner, double *by_normal)
{
    double x[3], y[3], edge[3], unit[3] = {0, 0, 0}, g[3], q_x[3], q_y[3], length, x_along, y_along;
    size_t next = surfmink__next(o, i), dim = o->dim == 2 ? 2 : 3, k;
    surfmink__point(o, i, x);
    surfmink__point(o, next, y);
    surfmink__sub(y, x, dim, edge);
    surfmink__unit(edge, dim, unit);
    length = surfmink__norm(edge, dim);
    x_along = surfmink__swing_at(o, i, x, y, unit, length, q_x);
    y_along = surfmink__swing_at(o, next, x, y, unit, length, q_y);
    for (k = 0; k < 3; ++k) {
        g[k] = (x_turn - y_turn) * q_x[k] + y_turn * (q_x[k] - q_y[k]);
        g[k] = by_length * unit[k] + g[k] / length;
    }
    surfmink__add_scaled(-1, g, dim, by_corner + dim * i);
    surfmink__add_scaled(1, g, dim, by_corner + dim * next);
    if (!by_normal) return;
    surfmink__add_scaled(-x_turn * x_along / surfmink__norm(o->normal + 3 * i, 3), q_x, 3, by_normal + 3 * i);
    surfmink__add_scaled(y_turn * y_along / surfmink__norm(o->normal + 3 * next, 3), q_y, 3, by_normal + 3 * next);
}

/* The same on the sphere. */
static void surfmink__back_arc(const surfmink__outline *o, size_t i, double by_length, double x_turn, double y_turn,
                               double *by_corner)
{
    surfmink__sum n[3], seen[3];
    double x[3], y[3], m[3], t[3], angle = 1, half, step, x_norm, y_norm;
    size_t next = surfmink__next(o, i), k;
    surfmink__arc(o, i, &angle);
    x_norm = surfmink__sphere_point(o, i, x);
    y_norm = surfmink__sphere_point(o, next, y);
    x_norm = surfmink__norm(x, 3) / x_norm;
    y_norm = surfmink__norm(y, 3) / y_norm;
    surfmink__axis(o, i, n);
    surfmink__seen(n, x, y, seen);
    for (k = 0; k < 3; ++k) m[k] = seen[k].high;
    surfmink__unit(m, 3, m);
    half = SURFMINK_SIN(angle / 2) / SURFMINK_COS(angle / 2);
    step = (x_turn - y_turn) / SURFMINK_SIN(angle);
    surfmink__unit(x, 3, x);
    surfmink__cross(m, x, t);
    surfmink__add_scaled((x_turn * half - step) / x_norm, m, 3, by_corner + 3 * i);
    surfmink__add_scaled(-by_length * o->radius / x_norm, t, 3, by_corner + 3 * i);
    surfmink__unit(y, 3, y);
    surfmink__cross(m, y, t);
    surfmink__add_scaled((y_turn * half + step) / y_norm, m, 3, by_corner + 3 * next);
    surfmink__add_scaled(by_length * o->radius / y_norm, t, 3, by_corner + 3 * next);
}

/* Step 1 backwards, of an outline that has passed surfmink__check. */
static void surfmink__back_edges(const surfmink__outline *o, const double *by_length, const double *by_turning,
                                 double *by_corner, double *by_normal)
{
    size_t i, next;
    for (i = 0; i < o->n * (size_t)o->dim; ++i) {
        by_corner[i] = 0;
        if (by_normal) by_normal[i] = 0;
    }
    for (i = 0; i < o->n; ++i) {
        next = surfmink__next(o, i);
        if (o->kind == SURFMINK__SPHERE)
            surfmink__back_arc(o, i, by_length[i], by_turning[i], by_turning[next], by_corner);
        else
            surfmink__back_edge(o, i, by_length[i], by_turning[i], by_turning[next], by_corner, by_normal);
    }
}

static int surfmink__pull(const surfmink__outline *o, const double *by_length, const double *by_turning,
                          double *by_corner, double *by_normal, size_t *bad)
{
    int status = surfmink__check(o, bad);
    if (status == SURFMINK_OK) surfmink__back_edges(o, by_length, by_turning, by_corner, by_normal);
    return status;
}

SURFMINK_DEF int surfmink_pull_plane(const double *corner, size_t n, const double *by_length, const double *by_turning,
                                     double *by_corner, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    return surfmink__pull(&o, by_length, by_turning, by_corner, NULL, bad);
}

SURFMINK_DEF int surfmink_pull_sphere(const double *corner, size_t n, double radius, const double *by_length,
                                      const double *by_turning, double *by_corner, size_t *bad)
{
    surfmink__outline o = surfmink__outline_sphere(corner, n, radius);
    if (!surfmink__positive(radius)) return surfmink__blame(SURFMINK_BAD_ARGUMENT, n, bad);
    return surfmink__pull(&o, by_length, by_turning, by_corner, NULL, bad);
}

SURFMINK_DEF int surfmink_pull_embedded(const double *corner, const double *normal, size_t n, const double *by_length,
                                        const double *by_turning, double *by_corner, double *by_normal, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    return surfmink__pull(&o, by_length, by_turning, by_corner, by_normal, bad);
}

/* An outline that is not ordinary: lengths and turns go into scratch, then their weights, and all steps back are taken
   one by one. */
static int surfmink__carefully_back(const surfmink__outline *o, int max_rank, double *mu, double *g, double *theta,
                                    surfmink_functionals *w, size_t *bad, const surfmink__back *back, double *scratch)
{
    double *length = scratch, *turning = scratch + o->n, *by_length = turning + o->n, *by_turning = by_length + o->n;
    surfmink__outline edges = surfmink__outline_measured(length, turning, o->n);
    surfmink__sum sum[6 * SURFMINK__TILES];
    surfmink_functionals total;
    surfmink__curve c;
    surfmink__tape k;
    double by_g[2], by_all;
    size_t i, p;
    int first, ranks, status = surfmink__carefully(o, max_rank, mu, g, theta, &total, bad);
    if (status != SURFMINK_OK) return status;
    if (w) *w = total;
    surfmink__edges(o, length, turning, NULL);
    for (i = 0; i < o->n; ++i) by_length[i] = by_turning[i] = 0;
    c = surfmink__curve_of(&edges, total.length, total.turning);
    by_all = surfmink__by_length(back->weights);
    for (first = 1; first <= max_rank; first += ranks) {
        ranks = surfmink__ranks_left(first, max_rank);
        surfmink__sum_ranks(&c, first, ranks, sum);
        for (p = 0; p < (size_t)ranks; ++p) {
            surfmink__pull_weights(back->weights, (size_t)first + p, surfmink__value(sum + 2 * p),
                                   surfmink__value(sum + 2 * p + 1), total.length * c.unit, c.unit, by_g, &by_all);
            k.by_g[2 * p] = by_g[0];
            k.by_g[2 * p + 1] = -by_g[1];
        }
        surfmink__pull_phases(&c, first, ranks, &k, by_length, by_turning);
    }
    surfmink__pull_turns(&edges, total.turning, by_all, by_length, by_turning);
    surfmink__back_edges(o, by_length, by_turning, back->by_corner, back->by_normal);
    return SURFMINK_OK;
}

/* An outline, and its gradient if one is asked for. */
static int surfmink__gradient(const surfmink__outline *o, int max_rank, double *mu, double *g, double *theta,
                              surfmink_functionals *w, size_t *bad, const surfmink__back *back, double *scratch)
{
    if (!back) return surfmink__measure(o, max_rank, mu, g, theta, w, bad);
    if (max_rank < 0) return surfmink__blame(SURFMINK_BAD_ARGUMENT, o->n, bad);
    if (surfmink__quickly(o, max_rank, mu, g, theta, w, back, scratch)) return SURFMINK_OK;
    return surfmink__carefully_back(o, max_rank, mu, g, theta, w, bad, back, scratch);
}

/* --- batches ------------------------------------------------------------------------------------------------------ */

typedef void surfmink__measure_window(const surfmink__job *job, size_t first, size_t count, unsigned char *left);

static int surfmink__known_job(const surfmink__job *job)
{
    return job->max_rank >= 0 && surfmink__positive(job->radius);
}

/* What of the weights and gradients of a batch belongs to outline i, whose corners are those from `at` on, counted in
   doubles.
   weights  out: its own */
static surfmink__back surfmink__back_of(const surfmink__job *job, size_t i, size_t at, surfmink_weights *weights)
{
    surfmink__back back = *job->back;
    size_t each = (size_t)job->max_rank + 1;
    *weights = *back.weights;
    if (weights->shared) i = 0;
    if (weights->mu) weights->mu += i * each;
    if (weights->g) weights->g += 2 * i * each;
    if (weights->theta) weights->theta += i * each;
    if (weights->length) weights->length += i;
    back.weights = weights;
    back.by_corner += at;
    if (back.by_normal) back.by_normal += at;
    return back;
}

/* One outline that the kernels have left. Returns whether it is refused. */
static int surfmink__left_over(const surfmink__job *job, size_t i)
{
    const surfmink_results *out = job->out;
    const size_t at = job->offset[i], end = job->offset[i + 1];
    surfmink__outline o;
    surfmink__back back;
    surfmink_weights weights;
    surfmink_functionals w;
    size_t bad = end >= at ? end - at : 0, rank;
    int status = SURFMINK_BAD_ARGUMENT, known = surfmink__known_job(job) && end >= at && end <= job->end;
    if (known && end - at < 3) /* there may be no corner at all, nor a place for them */
        status = SURFMINK_TOO_FEW_CORNERS;
    else if (known) {
        if (job->kind == SURFMINK__PLANE)
            o = surfmink__outline_of(SURFMINK__PLANE, job->corner + 2 * at, NULL, end - at);
        else if (job->kind == SURFMINK__SPHERE)
            o = surfmink__outline_sphere(job->corner + 3 * at, end - at, job->radius);
        else
            o = surfmink__outline_of(SURFMINK__EMBEDDED, job->corner + 3 * at, job->normal + 3 * at, end - at);
        rank = i * ((size_t)job->max_rank + 1);
        if (job->back) back = surfmink__back_of(job, i, (size_t)o.dim * at, &weights);
        status = surfmink__gradient(&o, job->max_rank, out->mu ? out->mu + rank : NULL,
                                    out->g ? out->g + 2 * rank : NULL, out->theta ? out->theta + rank : NULL, &w, &bad,
                                    job->back ? &back : NULL, job->back ? job->scratch + 6 * at : NULL);
    }
    if (out->status) out->status[i] = status;
    if (status != SURFMINK_OK) {
        if (out->bad) out->bad[i] = bad;
        return 1;
    }
    if (out->length) out->length[i] = w.length;
    if (out->turning) out->turning[i] = w.turning;
    if (out->area) out->area[i] = w.area;
    return 0;
}

/* How many outlines to take at a time: few if they are long, so that threads have something to share; else full groups.
   */
static size_t surfmink__window_size(const surfmink__job *job, size_t count)
{
    size_t size = count / ((job->offset[count] - job->offset[0]) / 16384 + 1);
    if (size >= SURFMINK__WINDOW) return SURFMINK__WINDOW;
    return size > 8 ? size - size % 8 : size > 0 ? size : 1;
}

#ifdef _OPENMP
/* Where offsets fall, outlines may share corners, and so what is written for each: that is no work for threads. */
static int surfmink__rises(const size_t *offset, size_t count)
{
    while (count > 0 && offset[count - 1] <= offset[count]) --count;
    return count == 0;
}
#endif

static size_t surfmink__batch(surfmink__job *job, size_t count, surfmink__measure_window *measure)
{
    const int known = surfmink__known_job(job);
    const size_t size = surfmink__window_size(job, count);
    const ptrdiff_t windows = (ptrdiff_t)(count / size + (count % size > 0));
    size_t refused = 0;
    ptrdiff_t k;
    job->end = job->offset[count];
#ifdef _OPENMP
#pragma omp parallel for schedule(guided) reduction(+ : refused) if (surfmink__rises(job->offset, count))
#endif
    for (k = 0; k < windows; ++k) {
        unsigned char left[SURFMINK__WINDOW];
        const size_t first = (size_t)k * size, some = count - first < size ? count - first : size;
        size_t i;
        if (known) measure(job, first, some, left);
        for (i = 0; i < some; ++i)
            if (!known || left[i]) refused += (size_t)surfmink__left_over(job, first + i);
    }
    return refused;
}

/* The instance of the kernels for a processor that has AVX-512, or AVX2 with FMA; without SURFMINK_DISPATCH the one
   that the compiler has been told. */
static surfmink__measure_window *surfmink__instance(int avx512, int avx2)
{
#ifdef SURFMINK__DISPATCHES
    if (avx512) return surfmink__window_avx512;
    if (avx2) return surfmink__window_avx2;
#endif
    (void)avx512;
    (void)avx2;
#if SURFMINK__NATIVE == SURFMINK__AVX512
    return surfmink__window_avx512;
#elif SURFMINK__NATIVE == SURFMINK__AVX2
    return surfmink__window_avx2;
#elif SURFMINK__NATIVE == SURFMINK__SSE2
    return surfmink__window_sse2;
#elif SURFMINK__NATIVE == SURFMINK__NEON
    return surfmink__window_neon;
#else
    return surfmink__window;
#endif
}

static surfmink__measure_window *surfmink__choose(void)
{
    int avx512 = 0, avx2 = 0;
#ifdef SURFMINK__DISPATCHES
    avx512 = (__builtin_cpu_supports("avx512f") != 0) & (__builtin_cpu_supports("avx512dq") != 0);
    avx2 = (__builtin_cpu_supports("avx2") != 0) & (__builtin_cpu_supports("fma") != 0);
#endif
    return surfmink__instance(avx512, avx2);
}

SURFMINK_DEF size_t surfmink_batch_plane(const double *corner, const size_t *offset, size_t count, int max_rank,
                                         const surfmink_results *out, double *scratch)
{
    surfmink__job job = surfmink__job_of(SURFMINK__PLANE, corner, NULL, 1, offset, max_rank, out, scratch);
    return surfmink__batch(&job, count, surfmink__choose());
}

SURFMINK_DEF size_t surfmink_batch_sphere(const double *corner, const size_t *offset, size_t count, double radius,
                                          int max_rank, const surfmink_results *out, double *scratch)
{
    surfmink__job job = surfmink__job_of(SURFMINK__SPHERE, corner, NULL, radius, offset, max_rank, out, scratch);
    return surfmink__batch(&job, count, surfmink__choose());
}

SURFMINK_DEF size_t surfmink_batch_embedded(const double *corner, const double *normal, const size_t *offset,
                                            size_t count, int max_rank, const surfmink_results *out, double *scratch)
{
    surfmink__job job = surfmink__job_of(SURFMINK__EMBEDDED, corner, normal, 1, offset, max_rank, out, scratch);
    return surfmink__batch(&job, count, surfmink__choose());
}

/* --- smooth curves ------------------------------------------------------------------------------------------------ */

/* A smooth curve through corners: what is known of its arcs, one for each edge, and what order 4 makes of it. */
typedef struct surfmink__arcs {
    const double *length, *turning;    /* l_i, alpha_i */
    const double *bend, *twist;        /* a_i, w_i; or NULL: edges are geodesics */
    const double *curvature;           /* K_i; or NULL: `constant` everywhere */
    const unsigned char *sharp;        /* or NULL: no corner is */
    double constant;                   /* of geodesics only */
    double *arc, *turn, *swept;        /* h_i times unit, turn_i, D_i */
    double unit, back;                 /* lengths times unit are ordinary; times back they are those of the caller */
    double whole, total, turned, rise; /* sum of arc, S, sum |turn_i|, sum E_i */
    double segments;                   /* between chords and arcs: sum D_i l_i^2 / 12, in units */
    double lead;                       /* from the mean direction of arc 0 to that at its middle */
    size_t n, windings;                /* the corners go round so many times */
} surfmink__arcs;

static size_t surfmink__after(const surfmink__arcs *c, size_t i)
{
    return i + 1 < c->n ? i + 1 : 0;
}

static size_t surfmink__behind(const surfmink__arcs *c, size_t i)
{
    return i > 0 ? i - 1 : c->n - 1;
}

static int surfmink__sharp(const surfmink__arcs *c, size_t i)
{
    return c->sharp && c->sharp[i];
}

/* A_i = a_i w_i / 6: by so much the mean direction of arc i, carried to its ends, leaves that of the chord. */
static double surfmink__slant(const surfmink__arcs *c, size_t i)
{
    return c->bend ? c->bend[i] * c->twist[i] / 6 : 0;
}

/* Geodesic curvature at corner i: its turn over half the two edges. It belongs to the point (l_i - l_{i-1}) / 3 behind
   the corner, and would be exact for curvature that changes linearly. */
static double surfmink__curving(const surfmink__arcs *c, size_t i)
{
    return 2 * c->turn[i] / (c->arc[surfmink__behind(c, i)] + c->arc[i]);
}

/* How it changes from corner i to the next. */
static double surfmink__change(const surfmink__arcs *c, size_t i)
{
    size_t next = surfmink__after(c, i);
    return 3 * (surfmink__curving(c, next) - surfmink__curving(c, i)) /
           (c->arc[surfmink__behind(c, i)] + c->arc[i] + c->arc[next]);
}

/* Geodesic curvature in the middle of arc i and its derivative along it: linear between the corners at both ends, or
   from the two next to a sharp one; constant, or straight, if there are no two or no one. */
static double surfmink__curved(const surfmink__arcs *c, size_t i, double *change)
{
    size_t next = surfmink__after(c, i), behind = surfmink__behind(c, i);
    *change = 0;
    if (surfmink__sharp(c, i) && surfmink__sharp(c, next)) return 0;
    if (surfmink__sharp(c, i)) {
        if (!surfmink__sharp(c, surfmink__after(c, next))) *change = surfmink__change(c, next);
        return surfmink__curving(c, next) - *change * (c->arc[i] / 6 + c->arc[next] / 3);
    }
    if (!surfmink__sharp(c, next))
        *change = surfmink__change(c, i);
    else if (!surfmink__sharp(c, behind))
        *change = surfmink__change(c, behind);
    return surfmink__curving(c, i) + *change * (c->arc[i] / 6 + c->arc[behind] / 3);
}

/* How much geodesic torsion times l_i changes along arc i: a parabola through it and both neighbours; next to a sharp
   corner one of them. */
static double surfmink__twisting(const surfmink__arcs *c, size_t i)
{
    size_t next = surfmink__after(c, i), behind = surfmink__behind(c, i);
    int from = !surfmink__sharp(c, i), to = !surfmink__sharp(c, next);
    double torsion = c->twist[i] / c->arc[i];
    double before = (c->arc[behind] + c->arc[i]) / 2, after = (c->arc[i] + c->arc[next]) / 2, rise = 0, gain = 0;
    if (from) rise = (torsion - c->twist[behind] / c->arc[behind]) / before;
    if (to) gain = (c->twist[next] / c->arc[next] - torsion) / after;
    if (from && to) return (gain * before + rise * after) / (before + after) * c->arc[i] * c->arc[i];
    return (rise + gain) * c->arc[i] * c->arc[i];
}

/* E_i: what the surface between the arc and the edge takes from the turns at both ends. Of a geodesic it is the
   Gaussian curvature between the two, K_i D_i l_i^2 / 12. */
static double surfmink__rise(const surfmink__arcs *c, size_t i)
{
    double a, w, k = c->curvature ? c->curvature[i] : c->constant;
    if (!c->bend) return k * c->length[i] * c->length[i] * c->swept[i] / 12;
    a = c->bend[i];
    w = c->twist[i];
    return (a * surfmink__twisting(c, i) + c->swept[i] * (a * a - w * w)) / 12;
}

/* Order 4: arc lengths and turns of the curve. Between corners its direction goes through the angle D_i = swept, on
   both sides of a mean that a chord of the surface has but for A_i. Order 2 leaves edges as they are. Returns 0 if an
   edge is so small beside the outline that its length goes under. */
static int surfmink__bow(surfmink__arcs *c, int order)
{
    surfmink__sum whole = {0, 0}, turned = {0, 0}, total = {0, 0}, rise = {0, 0};
    double change, before = 0, here, a;
    size_t i;
    c->segments = c->lead = 0;
    for (i = 0; i < c->n; ++i) {
        c->arc[i] = c->length[i] * c->unit;
        if (!(c->arc[i] > 0)) return 0;
        c->turn[i] = c->turning[i];
        c->swept[i] = 0;
        surfmink__add(&total, c->turning[i]);
        if (order == 4) c->turn[i] += surfmink__slant(c, i) - surfmink__slant(c, surfmink__behind(c, i));
    }
    for (i = 0; i < c->n && order == 4; ++i) {
        c->swept[i] = surfmink__curved(c, i, &change) * c->arc[i];
        if (i == 0) c->lead = change * c->arc[0] * c->arc[0] / 24;
    }
    if (order == 4) before = surfmink__rise(c, c->n - 1);
    for (i = 0; i < c->n && order == 4; ++i) {
        here = surfmink__rise(c, i);
        surfmink__add(&rise, here);
        surfmink__add(&total, -here);
        c->turn[i] -= (before + here) / 2;
        before = here;
        c->segments += c->swept[i] * c->arc[i] * c->arc[i] / 12;
    }
    for (i = 0; i < c->n; ++i) {
        a = c->bend ? c->bend[i] : 0;
        if (order == 4) c->arc[i] *= 1 + (c->swept[i] * c->swept[i] + a * a) / 24;
        surfmink__add(&whole, c->arc[i]);
        surfmink__add(&turned, surfmink__abs(c->turn[i]));
    }
    c->whole = surfmink__value(&whole);
    c->turned = surfmink__value(&turned);
    c->total = surfmink__value(&total);
    c->rise = surfmink__value(&rise);
    return 1;
}

/* Is the curve one that can be measured? Where neighbours are too unlike, it is endlessly longer than the polygon. */
static int surfmink__check_arcs(const surfmink__arcs *c)
{
    if (!(c->whole < 1e100) || !surfmink__finite(&c->total, 1)) return SURFMINK_NOT_FINITE;
    return surfmink__check_turning(c->total, c->turned, c->n);
}

/* w becomes w z^p. */
static void surfmink__times_power(double w[2], const double z[2], int p)
{
    double x = z[0], y = z[1];
    for (; p > 0; p /= 2) {
        if (p % 2) surfmink__multiply(w, w + 1, x, y);
        surfmink__multiply(&x, &y, x, y);
    }
}

/* Adds to `part` what arcs start .. end - 1 contribute to p g_p of the ranks from `first` on. On an arc the phase runs
   from f - x to f + x, x = pi D / S, and the mean of exp(i p f) there is sin(p x) / (p x) exp(i p f). sin(p x) is the
   imaginary part of exp(i x)^p, which keeps its digits however small x is. */
static void surfmink__sum_arcs(const surfmink__arcs *c, size_t start, size_t end, int first, int ranks,
                               surfmink__sum *path, double *part)
{
    double period = c->total / (double)c->windings, phase, x, w[2], z[2], u[2], v[2];
    size_t i, k;
    for (i = start; i < end; ++i) {
        if (i > 0) surfmink__add(path, c->turn[i]);
        phase = surfmink__phase(surfmink__value(path), period);
        x = surfmink__pi * (c->swept[i] / period);
        if (surfmink__abs(x) < 1e-100) x = 1e-100; /* straight: sin(p x) = p x, to the bit or nearly */
        z[0] = SURFMINK_COS(phase);
        z[1] = SURFMINK_SIN(phase);
        u[0] = v[0] = SURFMINK_COS(x);
        u[1] = v[1] = SURFMINK_SIN(x);
        w[0] = c->arc[i] / x * z[0];
        w[1] = c->arc[i] / x * z[1];
        surfmink__times_power(w, z, first - 1);
        surfmink__times_power(v, u, first - 1);
        for (k = 0; k < (size_t)ranks; ++k) {
            part[2 * k] += w[0] * v[1];
            part[2 * k + 1] += w[1] * v[1];
            surfmink__multiply(w, w + 1, z[0], z[1]);
            surfmink__multiply(v, v + 1, u[0], u[1]);
        }
    }
}

/* g_p and mu_p of the arcs, 24 ranks at a time; and less[p] becomes less by `share` of mu_p. */
static void surfmink__ranks_of_arcs(const surfmink__arcs *c, int max_rank, double *mu, double *g, double *less,
                                    double share)
{
    double part[6 * SURFMINK__TILES], re, im, ratio, lead[2], turn[2];
    surfmink__sum sum[6 * SURFMINK__TILES], path;
    size_t start, end;
    int first, ranks, k, p;
    lead[0] = SURFMINK_COS(surfmink__two_pi * (c->lead / c->total));
    lead[1] = SURFMINK_SIN(surfmink__two_pi * (c->lead / c->total));
    for (first = 1; first <= max_rank; first += ranks) {
        ranks = max_rank - first < 3 * SURFMINK__TILES ? max_rank - first + 1 : 3 * SURFMINK__TILES;
        path.high = path.low = 0;
        for (k = 0; k < 2 * ranks; ++k) sum[k].high = sum[k].low = 0;
        for (start = 0; start < c->n; start = end) {
            end = c->n - start < SURFMINK__ROWS ? c->n : start + SURFMINK__ROWS;
            for (k = 0; k < 2 * ranks; ++k) part[k] = 0;
            surfmink__sum_arcs(c, start, end, first, ranks, &path, part);
            for (k = 0; k < 2 * ranks; ++k) surfmink__add(sum + k, part[k]);
        }
        for (k = 0; k < ranks; ++k) {
            p = first + k;
            re = surfmink__value(sum + 2 * (size_t)k) / p;
            im = surfmink__value(sum + 2 * (size_t)k + 1) / p;
            ratio = surfmink__ratio(re, im, c->whole);
            if (mu) mu[p] = ratio;
            if (less) less[p] -= share * ratio;
            if (!g) continue;
            turn[0] = re;
            turn[1] = im;
            surfmink__times_power(turn, lead, p);
            g[2 * (size_t)p] = turn[0] * c->back;
            g[2 * (size_t)p + 1] = turn[1] * c->back;
        }
    }
}

/* Where the corners of a smooth curve come from. */
typedef struct surfmink__source {
    const surfmink__outline *outline; /* plane, sphere, embedded; a surface: edges in scratch */
    const surfmink_surface *surface;  /* or NULL */
    int (*curvature_at)(void *context, const double *x, double *curvature); /* or NULL */
    const double *corner;                                                   /* of a surface */
    const unsigned char *sharp;
    double curvature;
    double unit, back; /* as in surfmink__arcs */
    size_t n;
    size_t measured; /* not 0: edges are well; of a surface they are in scratch already */
} surfmink__source;

/* a_i and w_i of the edge from x to y. Returns 0 if the normals are opposite. */
static int surfmink__bend(const double x[3], const double y[3], const double x_normal[3], const double y_normal[3],
                          double *bend, double *twist)
{
    double frame[9], a[3], b[3], d[3];
    if (surfmink__chord_frame(x, y, x_normal, y_normal, frame) != SURFMINK_OK) return 0;
    surfmink__unit(x_normal, 3, a);
    surfmink__unit(y_normal, 3, b);
    surfmink__sub(b, a, 3, d);
    *bend = -surfmink__dot(d, frame + 3);
    *twist = surfmink__dot(d, frame); /* nu is N x e the other way round */
    return 1;
}

SURFMINK_DEF int surfmink_bends_embedded(const double *corner, const double *normal, size_t n, double *bend,
                                         double *twist, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    double a, w;
    size_t i, next, pass;
    int status = surfmink__check(&o, bad);
    if (status != SURFMINK_OK) return status;
    for (pass = 0; pass < 2; ++pass) /* nothing is written before all is known to be well */
        for (i = 0; i < n; ++i) {
            next = surfmink__next(&o, i);
            if (!surfmink__bend(corner + 3 * i, corner + 3 * next, normal + 3 * i, normal + 3 * next, &a, &w))
                return surfmink__blame(SURFMINK_ZERO_NORMAL, i + 1 < n ? i + 1 : i, bad);
            if (pass == 0) continue;
            bend[i] = a;
            twist[i] = w;
        }
    return SURFMINK_OK;
}

/* Length and bend of the edge from corner at[1] to at[2], and the turn at at[1] on the way from at[0]; of a surface its
   curvature there. Three corners are an outline, which knows how to check and measure. */
static int surfmink__measure_between(const surfmink__source *s, const size_t at[3], double *length, double *turning,
                                     double *bend, double *twist)
{
    double corner[9], normal[9];
    const surfmink__outline *o = s->outline;
    surfmink__outline three = *o;
    size_t dim, j, k;
    int status;
    if (s->surface) {
        const double *x = s->corner + at[1] * s->surface->stride;
        status = SURFMINK_OK;
        if (!s->measured)
            status = surfmink__log_corner(s->surface, s->corner + at[0] * s->surface->stride, x,
                                          s->corner + at[2] * s->surface->stride, length, turning);
        if (status != SURFMINK_OK || !s->curvature_at) return status;
        *bend = 0;
        status = (s->curvature_at)(s->surface->context, x, bend);
        if (status != SURFMINK_OK) return *surfmink_strerror(status) ? status : SURFMINK_CALLBACK_FAILED;
        return surfmink__finite(bend, 1) ? SURFMINK_OK : SURFMINK_CALLBACK_FAILED;
    }
    dim = (size_t)o->dim;
    for (j = 0; j < 3; ++j)
        for (k = 0; k < dim; ++k) {
            corner[dim * j + k] = o->corner[dim * at[j] + k];
            if (o->normal) normal[3 * j + k] = o->normal[3 * at[j] + k];
        }
    three.corner = corner;
    three.normal = o->normal ? normal : NULL;
    three.n = 3;
    three.radius = 1; /* edges of a sphere as angles */
    status = s->measured ? SURFMINK_OK : surfmink__check_edge(&three, 1);
    if (status != SURFMINK_OK) return status;
    surfmink__measure_corner(&three, 1, length, turning, NULL);
    if (!o->normal) return SURFMINK_OK;
    return surfmink__bend(corner + 3, corner + 6, normal + 3, normal + 6, bend, twist) ? SURFMINK_OK
                                                                                       : SURFMINK_ZERO_NORMAL;
}

/* The corner after corner i: the next one; or the one after that, but no sharp corner is left out. */
static size_t surfmink__step(const surfmink__source *s, size_t i, int every_second)
{
    size_t next = i + 1 < s->n ? i + 1 : 0;
    if (!every_second || (s->sharp && s->sharp[next])) return next;
    return next + 1 < s->n ? next + 1 : 0;
}

/* Measures a curve, or every second corner of it, from one of them on: once round, twice if that is how one comes back
   to where one began.
   scratch  8 n  l alpha, a w or K, h turn D, and which are sharp */
static int surfmink__trace(const surfmink__source *s, int every_second, size_t start, double *scratch,
                           surfmink__arcs *c, size_t *bad)
{
    double *length = scratch, *turning = scratch + s->n, *bend = scratch + 2 * s->n, *twist = scratch + 3 * s->n,
           first = 0;
    unsigned char *sharp = (unsigned char *)(scratch + 7 * s->n);
    size_t k, at[3];
    int status;
    c->n = c->windings = 0;
    at[0] = at[1] = start;
    do { /* how many corners, and which one is before the first? */
        at[0] = at[1];
        at[1] = surfmink__step(s, at[1], every_second);
        if (at[1] <= at[0]) ++c->windings;
        ++c->n;
    } while (at[1] != start);
    for (k = 0; k < c->n; ++k) {
        at[2] = surfmink__step(s, at[1], every_second);
        status = surfmink__measure_between(s, at, length + k, turning + k, bend + k, twist + k);
        if (status != SURFMINK_OK)
            return surfmink__blame(status, s->surface ? at[1] : at[1] + 1 < s->n ? at[1] + 1 : at[1], bad);
        sharp[k] = s->sharp && s->sharp[at[1]];
        at[0] = at[1];
        at[1] = at[2];
    }
    if (s->curvature_at) first = bend[0]; /* from corners to the middle of edges */
    for (k = 0; k < c->n && s->curvature_at; ++k) bend[k] = (bend[k] + (k + 1 < c->n ? bend[k + 1] : first)) / 2;
    c->length = length;
    c->turning = turning;
    c->bend = s->outline->kind == SURFMINK__EMBEDDED ? bend : NULL;
    c->twist = twist;
    c->curvature = s->curvature_at ? bend : NULL;
    c->sharp = s->sharp ? sharp : NULL;
    c->constant = s->curvature;
    c->unit = s->unit;
    c->back = s->back;
    c->arc = scratch + 4 * s->n;
    c->turn = scratch + 5 * s->n;
    c->swept = scratch + 6 * s->n;
    return SURFMINK_OK;
}

/* S within a half turn of that of the whole: else every second corner winds otherwise, and tells nothing. */
static int surfmink__winds_alike(const surfmink__arcs *c, double turning)
{
    return surfmink__abs(c->total / (double)c->windings - turning) < surfmink__pi;
}

/* Estimates of the error. At the start error holds mu_p, and 1 for L; what every second corner makes of them is taken
   off. If n is even and no corner sharp, the even corners and the odd ones are asked, and their mean is taken. */
static void surfmink__estimate(const surfmink__source *s, int order, int max_rank, double length, double turning,
                               double *scratch, double *error)
{
    surfmink__arcs c;
    size_t start = 0, halves = s->n % 2 == 0 ? 2 : 1, half, i;
    int p, known = s->n >= 5;
    for (i = 0; i < s->n && s->sharp; ++i)
        if (s->sharp[i]) {
            start = i;
            halves = 1;
        }
    for (half = 0; half < halves && known; ++half) {
        known = surfmink__trace(s, 1, start + half, scratch, &c, NULL) == SURFMINK_OK && surfmink__bow(&c, order) &&
                surfmink__check_arcs(&c) == SURFMINK_OK && surfmink__winds_alike(&c, turning);
        if (!known) break;
        error[0] -= c.whole * c.back / (double)c.windings / length / (double)halves;
        surfmink__ranks_of_arcs(&c, max_rank, NULL, NULL, error, 1 / (double)halves);
    }
    for (p = 0; p <= max_rank; ++p) error[p] = known ? surfmink__abs(error[p]) / (order == 4 ? 15 : 3) : 1;
}

/* The functionals of the curve from those of the polygon: what lies between the two is added. */
static surfmink_functionals surfmink__functionals_of(const surfmink__arcs *c, const surfmink__source *s,
                                                     const surfmink_functionals *polygon)
{
    surfmink_functionals w = *polygon;
    double radius = s->outline->radius;
    w.length = c->whole * c->back;
    w.turning = c->total;
    w.curvature += c->rise;
    if (s->outline->kind == SURFMINK__PLANE) w.area += c->segments * c->back * c->back;
    if (s->outline->kind == SURFMINK__SPHERE) w.area = w.curvature * radius * radius;
    w.condition = c->turned > c->total ? c->turned / c->total : 1;
    return w;
}

/* All four steps for arcs of which lengths, turns and bends are known, and the functionals of the polygon. */
static int surfmink__fourth(surfmink__arcs *c, const surfmink__source *s, int max_rank, double *mu, double *g,
                            surfmink_functionals *w)
{
    surfmink_functionals curve;
    int status;
    if (!surfmink__bow(c, 4)) return SURFMINK_NOT_FINITE;
    c->total = w->turning - c->rise; /* which the polygon knows better than the sum of its turns */
    if ((status = surfmink__check_arcs(c)) != SURFMINK_OK) return status;
    curve = surfmink__functionals_of(c, s, w);
    if (!surfmink__writable(curve.length) || !surfmink__finite(&curve.area, 1)) return SURFMINK_NOT_FINITE;
    if (mu) mu[0] = 1;
    if (g) {
        g[0] = curve.length;
        g[1] = 0;
    }
    surfmink__ranks_of_arcs(c, max_rank, mu, g, NULL, 0);
    *w = curve;
    return SURFMINK_OK;
}

static int surfmink__measure_curve(surfmink__source *s, int order, int max_rank, double *scratch, double *mu,
                                   double *error, double *g, surfmink_functionals *w, size_t *bad)
{
    const surfmink__outline *o = s->outline;
    surfmink_functionals total;
    surfmink__arcs c;
    double *found = mu ? mu : error;
    int status = SURFMINK_OK, p;
    if (max_rank < 0 || (order != 2 && order != 4)) return surfmink__blame(SURFMINK_BAD_ARGUMENT, s->n, bad);
    if (s->surface) status = surfmink_edges_surface(s->surface, s->corner, s->n, scratch, scratch, scratch + s->n, bad);
    if (status != SURFMINK_OK) return status;
    status = order == 2 ? surfmink__measure(o, max_rank, found, g, NULL, &total, bad)
                        : surfmink__measure(o, 0, NULL, NULL, NULL, &total, bad);
    if (status != SURFMINK_OK) return status;
    s->unit = o->kind == SURFMINK__SPHERE ? 1 : surfmink__scale(total.length);
    s->back = o->kind == SURFMINK__SPHERE ? o->radius : 1 / s->unit;
    if (order == 4) {
        s->measured = 1;
        if ((status = surfmink__trace(s, 0, 0, scratch, &c, bad)) != SURFMINK_OK) return status;
        s->measured = 0;
        status = surfmink__fourth(&c, s, max_rank, found, g, &total);
        if (status != SURFMINK_OK) return surfmink__blame(status, s->n, bad);
    }
    for (p = 0; p <= max_rank && mu && error; ++p) error[p] = mu[p];
    if (error) surfmink__estimate(s, order, max_rank, total.length, total.turning, scratch, error);
    if (w) *w = total;
    return SURFMINK_OK;
}

static surfmink__source surfmink__source_of(const surfmink__outline *o, const unsigned char *sharp)
{
    surfmink__source s;
    s.outline = o;
    s.surface = NULL;
    s.curvature_at = NULL;
    s.corner = o->corner;
    s.sharp = sharp;
    s.curvature = o->kind == SURFMINK__SPHERE ? 1 : 0; /* of the unit sphere */
    s.n = o->n;
    s.unit = s.back = 0; /* known when L is */
    s.measured = 0;
    return s;
}

SURFMINK_DEF int surfmink_curve_plane(const double *corner, const unsigned char *sharp, size_t n, int order,
                                      int max_rank, double *scratch, double *mu, double *error, double *g,
                                      surfmink_functionals *w, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    surfmink__source s = surfmink__source_of(&o, sharp);
    return surfmink__measure_curve(&s, order, max_rank, scratch, mu, error, g, w, bad);
}

SURFMINK_DEF int surfmink_curve_sphere(const double *corner, const unsigned char *sharp, size_t n, double radius,
                                       int order, int max_rank, double *scratch, double *mu, double *error, double *g,
                                       surfmink_functionals *w, size_t *bad)
{
    surfmink__outline o = surfmink__outline_sphere(corner, n, radius);
    surfmink__source s = surfmink__source_of(&o, sharp);
    if (!surfmink__positive(radius)) return surfmink__blame(SURFMINK_BAD_ARGUMENT, n, bad);
    return surfmink__measure_curve(&s, order, max_rank, scratch, mu, error, g, w, bad);
}

SURFMINK_DEF int surfmink_curve_embedded(const double *corner, const double *normal, const unsigned char *sharp,
                                         size_t n, int order, int max_rank, double *scratch, double *mu, double *error,
                                         double *g, surfmink_functionals *w, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    surfmink__source s = surfmink__source_of(&o, sharp);
    return surfmink__measure_curve(&s, order, max_rank, scratch, mu, error, g, w, bad);
}

SURFMINK_DEF int surfmink_curve_surface(const surfmink_surface *surface, double curvature,
                                        int (*curvature_at)(void *context, const double *x, double *curvature),
                                        const double *corner, const unsigned char *sharp, size_t n, int order,
                                        int max_rank, double *scratch, double *mu, double *error, double *g,
                                        surfmink_functionals *w, size_t *bad)
{
    surfmink__outline o = surfmink__outline_measured(scratch, scratch + n, n);
    surfmink__source s = surfmink__source_of(&o, sharp);
    if (!curvature_at && !surfmink__finite(&curvature, 1)) return surfmink__blame(SURFMINK_NOT_FINITE, n, bad);
    s.surface = surface;
    s.corner = corner;
    s.curvature = curvature;
    s.curvature_at = curvature_at;
    return surfmink__measure_curve(&s, order, max_rank, scratch, mu, error, g, w, bad);
}

SURFMINK_DEF int surfmink_curve_edges(const double *length, const double *turning, const double *bend,
                                      const double *twist, const double *curvature, const unsigned char *sharp,
                                      size_t n, int max_rank, double *scratch, double *mu, double *g,
                                      surfmink_functionals *w)
{
    surfmink__outline o = surfmink__outline_measured(length, turning, n);
    surfmink__source s = surfmink__source_of(&o, sharp);
    surfmink_functionals total;
    surfmink__arcs c;
    size_t i;
    int status = surfmink__measure(&o, 0, NULL, NULL, NULL, &total, NULL);
    if (status != SURFMINK_OK) return status;
    if (max_rank < 0 || !bend != !twist) return SURFMINK_BAD_ARGUMENT;
    for (i = 0; i < n; ++i)
        if (!(length[i] > 0)) return SURFMINK_COINCIDENT_CORNERS;
    if ((bend && !surfmink__finite(bend, n)) || (twist && !surfmink__finite(twist, n))) return SURFMINK_NOT_FINITE;
    if (curvature && !bend && !surfmink__finite(curvature, n)) return SURFMINK_NOT_FINITE;
    c.length = length;
    c.turning = turning;
    c.bend = bend;
    c.twist = twist;
    c.curvature = curvature;
    c.sharp = sharp;
    c.constant = 0;
    c.arc = scratch;
    c.turn = scratch + n;
    c.swept = scratch + 2 * n;
    c.unit = surfmink__scale(total.length);
    c.back = 1 / c.unit;
    c.n = n;
    c.windings = 1;
    status = surfmink__fourth(&c, &s, max_rank, mu, g, &total);
    if (status == SURFMINK_OK && w) *w = total;
    return status;
}

/* --- gradients: the doors ----------------------------------------------------------------------------------------- */

static surfmink__back surfmink__pulls(const surfmink_weights *weights, double *by_corner, double *by_normal)
{
    surfmink__back back;
    back.weights = weights;
    back.by_corner = by_corner;
    back.by_normal = by_normal;
    return back;
}

SURFMINK_DEF int surfmink_gradient_plane(const double *corner, size_t n, int max_rank, const surfmink_weights *weights,
                                         double *mu, double *g, surfmink_functionals *w, double *by_corner,
                                         double *scratch, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__PLANE, corner, NULL, n);
    surfmink__back back = surfmink__pulls(weights, by_corner, NULL);
    return surfmink__gradient(&o, max_rank, mu, g, NULL, w, bad, &back, scratch);
}

SURFMINK_DEF int surfmink_gradient_sphere(const double *corner, size_t n, double radius, int max_rank,
                                          const surfmink_weights *weights, double *mu, double *g,
                                          surfmink_functionals *w, double *by_corner, double *scratch, size_t *bad)
{
    surfmink__outline o = surfmink__outline_sphere(corner, n, radius);
    surfmink__back back = surfmink__pulls(weights, by_corner, NULL);
    if (!surfmink__positive(radius)) return surfmink__blame(SURFMINK_BAD_ARGUMENT, n, bad);
    return surfmink__gradient(&o, max_rank, mu, g, NULL, w, bad, &back, scratch);
}

SURFMINK_DEF int surfmink_gradient_embedded(const double *corner, const double *normal, size_t n, int max_rank,
                                            const surfmink_weights *weights, double *mu, double *g,
                                            surfmink_functionals *w, double *by_corner, double *by_normal,
                                            double *scratch, size_t *bad)
{
    surfmink__outline o = surfmink__outline_of(SURFMINK__EMBEDDED, corner, normal, n);
    surfmink__back back = surfmink__pulls(weights, by_corner, by_normal);
    return surfmink__gradient(&o, max_rank, mu, g, NULL, w, bad, &back, scratch);
}

SURFMINK_DEF size_t surfmink_batch_gradient_plane(const double *corner, const size_t *offset, size_t count,
                                                  int max_rank, const surfmink_weights *weights,
                                                  const surfmink_results *out, double *by_corner, double *scratch)
{
    surfmink__job job = surfmink__job_of(SURFMINK__PLANE, corner, NULL, 1, offset, max_rank, out, scratch);
    surfmink__back back = surfmink__pulls(weights, by_corner, NULL);
    job.back = &back;
    return surfmink__batch(&job, count, surfmink__choose());
}

SURFMINK_DEF size_t surfmink_batch_gradient_sphere(const double *corner, const size_t *offset, size_t count,
                                                   double radius, int max_rank, const surfmink_weights *weights,
                                                   const surfmink_results *out, double *by_corner, double *scratch)
{
    surfmink__job job = surfmink__job_of(SURFMINK__SPHERE, corner, NULL, radius, offset, max_rank, out, scratch);
    surfmink__back back = surfmink__pulls(weights, by_corner, NULL);
    job.back = &back;
    return surfmink__batch(&job, count, surfmink__choose());
}

SURFMINK_DEF size_t surfmink_batch_gradient_embedded(const double *corner, const double *normal, const size_t *offset,
                                                     size_t count, int max_rank, const surfmink_weights *weights,
                                                     const surfmink_results *out, double *by_corner, double *by_normal,
                                                     double *scratch)
{
    surfmink__job job = surfmink__job_of(SURFMINK__EMBEDDED, corner, normal, 1, offset, max_rank, out, scratch);
    surfmink__back back = surfmink__pulls(weights, by_corner, by_normal);
    job.back = &back;
    return surfmink__batch(&job, count, surfmink__choose());
}

/* --- the sphere as a surface -------------------------------------------------------------------------------------- */

SURFMINK_DEF int surfmink_sphere_log(const double x[3], const double y[3], double radius, double vector[3])
{
    surfmink__outline o;
    surfmink__sum n[3], seen[3];
    double pair[6], a[3], b[3], m[3], axis[3], direction[3], tangent[3], angle;
    size_t k;
    int status;
    for (k = 0; k < 3; ++k) {
        pair[k] = x[k];
        pair[3 + k] = y[k];
    }
    if (!surfmink__positive(radius)) return SURFMINK_BAD_ARGUMENT;
    o = surfmink__outline_sphere(pair, 2, radius);
    if ((status = surfmink__check_corner(&o, 0)) != SURFMINK_OK) return status;
    if ((status = surfmink__check_corner(&o, 1)) != SURFMINK_OK) return status;
    status = surfmink__arc(&o, 0, &angle);
    if (status == SURFMINK_COINCIDENT_CORNERS) {
        vector[0] = vector[1] = vector[2] = 0;
        return SURFMINK_OK;
    }
    if (status != SURFMINK_OK) return status;
    surfmink__sphere_point(&o, 0, a);
    surfmink__sphere_point(&o, 1, b);
    surfmink__axis(&o, 0, n);
    surfmink__seen(n, a, b, seen);
    for (k = 0; k < 3; ++k) {
        axis[k] = n[k].high;
        m[k] = seen[k].high;
    }
    surfmink__cross(m, axis, direction);
    surfmink__unit(direction, 3, tangent);
    for (k = 0; k < 3; ++k) vector[k] = radius * angle * tangent[k];
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_sphere_exp(const double x[3], const double vector[3], double radius, double y[3])
{
    double unit[3], v[3], tangent[3], length, part, turn, cosine, sine;
    size_t k;
    if (!surfmink__positive(radius)) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(x, 3) || !surfmink__finite(vector, 3)) return SURFMINK_NOT_FINITE;
    if (!(surfmink__max_abs(x, 3) > 0)) return SURFMINK_ZERO_NORMAL;
    surfmink__unit(x, 3, unit);
    part = surfmink__dot(vector, unit);
    for (k = 0; k < 3; ++k) v[k] = vector[k] - part * unit[k];
    if (!surfmink__finite(v, 3) || surfmink__max_abs(v, 3) > 1e308) return SURFMINK_NOT_FINITE; /* nor is its length */
    length = surfmink__norm(v, 3);
    turn = length / radius;
    if (!surfmink__finite(&turn, 1)) return SURFMINK_NOT_FINITE;
    tangent[0] = tangent[1] = tangent[2] = 0;
    if (length > 0) surfmink__unit(v, 3, tangent);
    cosine = SURFMINK_COS(turn);
    sine = SURFMINK_SIN(turn);
    for (k = 0; k < 3; ++k) y[k] = radius * (cosine * unit[k] + sine * tangent[k]);
    return SURFMINK_OK;
}

/* An oriented orthonormal frame at x, the same each time: e1 = axis x n for the axis farthest from x, e2 = n x e1. */
static void surfmink__sphere_frame(const double *x, double e1[3], double e2[3])
{
    double n[3], axis[3] = {0, 0, 0}, c[3];
    size_t k, least = 0;
    surfmink__unit(x, 3, n);
    for (k = 1; k < 3; ++k)
        if (surfmink__abs(n[k]) < surfmink__abs(n[least])) least = k;
    axis[least] = 1;
    surfmink__cross(axis, n, c);
    surfmink__unit(c, 3, e1);
    surfmink__cross(n, e1, e2);
}

static int surfmink__sphere_log(void *context, const double *x, const double *y, double *length, double direction[2])
{
    const double *radius = (const double *)context;
    double vector[3], e1[3], e2[3];
    int status = surfmink_sphere_log(x, y, *radius, vector);
    if (status != SURFMINK_OK) return status;
    surfmink__sphere_frame(x, e1, e2);
    *length = surfmink__norm(vector, 3);
    direction[0] = surfmink__dot(vector, e1);
    direction[1] = surfmink__dot(vector, e2);
    return *length > 0 ? SURFMINK_OK : SURFMINK_COINCIDENT_CORNERS;
}

static int surfmink__sphere_exp(void *context, const double *x, const double direction[2], double length, double *y)
{
    const double *radius = (const double *)context;
    double vector[3], e1[3], e2[3];
    size_t k;
    if (!surfmink__finite(x, 3)) return SURFMINK_NOT_FINITE;
    if (!(surfmink__max_abs(x, 3) > 0)) return SURFMINK_ZERO_NORMAL;
    surfmink__sphere_frame(x, e1, e2);
    for (k = 0; k < 3; ++k) vector[k] = length * (direction[0] * e1[k] + direction[1] * e2[k]);
    return surfmink_sphere_exp(x, vector, *radius, y);
}

SURFMINK_DEF surfmink_surface surfmink_sphere(double *radius)
{
    surfmink_surface surface;
    surface.context = radius;
    surface.stride = 3;
    surface.log = surfmink__sphere_log;
    surface.exp = surfmink__sphere_exp;
    return surface;
}

/* --- helpers ------------------------------------------------------------------------------------------------------ */

/* Cosine and sine of an angle in degrees. It is reduced to within 45 degrees of a quarter turn, which is exact, before
   it is rounded to radians; then the quarter turns are made, which swaps and negates. */
static void surfmink__degrees(double degrees, double *cosine, double *sine)
{
    long quarters = (long)(degrees / 90 + (degrees < 0 ? -0.5 : 0.5));
    double rest = (degrees - 90.0 * (double)quarters) * (surfmink__pi / 180), swapped;
    *cosine = SURFMINK_COS(rest);
    *sine = SURFMINK_SIN(rest);
    for (quarters = (quarters % 4 + 4) % 4; quarters > 0; --quarters) {
        swapped = *cosine;
        *cosine = -*sine;
        *sine = swapped;
    }
}

SURFMINK_DEF int surfmink_from_lonlat(double lon, double lat, double radius, double point[3])
{
    double cos_lon, sin_lon, cos_lat, sin_lat;
    if (!surfmink__finite(&lon, 1) || !surfmink__finite(&lat, 1)) return SURFMINK_NOT_FINITE;
    if (surfmink__abs(lon) > 1e6 || surfmink__abs(lat) > 90 || !surfmink__positive(radius))
        return SURFMINK_BAD_ARGUMENT;
    surfmink__degrees(lon, &cos_lon, &sin_lon);
    surfmink__degrees(lat, &cos_lat, &sin_lat);
    point[0] = radius * cos_lat * cos_lon;
    point[1] = radius * cos_lat * sin_lon;
    point[2] = radius * sin_lat;
    return SURFMINK_OK;
}

SURFMINK_DEF void surfmink_reverse(double *corner, size_t n, size_t stride)
{
    size_t i, k;
    double kept;
    for (i = 0; i < n / 2; ++i)
        for (k = 0; k < stride; ++k) {
            kept = corner[i * stride + k];
            corner[i * stride + k] = corner[(n - 1 - i) * stride + k];
            corner[(n - 1 - i) * stride + k] = kept;
        }
}

SURFMINK_DEF void surfmink_smooth(double *corner, size_t n, size_t stride, size_t passes)
{
    double previous, here, first;
    size_t i, k;
    if (n == 0) return;
    for (; passes > 0; --passes)
        for (k = 0; k < stride; ++k) {
            previous = corner[(n - 1) * stride + k];
            first = corner[k];
            for (i = 0; i < n; ++i) {
                here = corner[i * stride + k];
                corner[i * stride + k] = (previous + here + (i + 1 < n ? corner[(i + 1) * stride + k] : first)) / 3;
                previous = here;
            }
        }
}

/* NaN equals nothing: it is to be refused, not to be dropped. */
static int surfmink__equal(const double *a, const double *b, size_t stride)
{
    size_t k;
    for (k = 0; k < stride; ++k)
        if (!(a[k] >= b[k] && a[k] <= b[k])) return 0;
    return 1;
}

SURFMINK_DEF size_t surfmink_merge(double *corner, double *normal, size_t n, size_t stride)
{
    size_t i, k, kept = 0;
    for (i = 0; i < n; ++i) {
        if (kept > 0 && surfmink__equal(corner + i * stride, corner + (kept - 1) * stride, stride)) continue;
        for (k = 0; k < stride; ++k) corner[kept * stride + k] = corner[i * stride + k];
        if (normal)
            for (k = 0; k < 3; ++k) normal[3 * kept + k] = normal[3 * i + k];
        ++kept;
    }
    while (kept > 1 && surfmink__equal(corner, corner + (kept - 1) * stride, stride)) --kept;
    return kept;
}

/* Corners of at most this many doubles can be tried out on the stack before anything is written. */
#define SURFMINK__STRIDE 16

static int surfmink__exp(const surfmink_surface *surface, const double *x, const double direction[2], double length,
                         double *y)
{
    int status = (surface->exp)(surface->context, x, direction, length, y);
    if (status != SURFMINK_OK) return *surfmink_strerror(status) ? status : SURFMINK_CALLBACK_FAILED;
    return surfmink__finite(y, surface->stride) ? SURFMINK_OK : SURFMINK_CALLBACK_FAILED;
}

SURFMINK_DEF int surfmink_regular_polygon(const surfmink_surface *surface, const double *centre, double distance,
                                          double angle, size_t n, double *corner)
{
    double trial[SURFMINK__STRIDE], direction[2], turn;
    size_t i;
    int status, pass;
    if (n < 3) return SURFMINK_TOO_FEW_CORNERS;
    if (!surfmink__finite(&angle, 1)) return SURFMINK_NOT_FINITE;
    if (!surface->exp || surface->stride == 0 || surface->stride > SURFMINK__STRIDE || !surfmink__positive(distance))
        return SURFMINK_BAD_ARGUMENT;
    for (pass = 0; pass < 2; ++pass) /* first into the trial, then, when all is well, into the polygon */
        for (i = 0; i < n; ++i) {
            turn = angle + surfmink__two_pi * (double)i / (double)n;
            direction[0] = SURFMINK_COS(turn);
            direction[1] = SURFMINK_SIN(turn);
            status = surfmink__exp(surface, centre, direction, distance, pass ? corner + i * surface->stride : trial);
            if (status != SURFMINK_OK) return status;
        }
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_edge_points(const surfmink_surface *surface, const double *x, const double *y, size_t m,
                                      double *point)
{
    double trial[SURFMINK__STRIDE], direction[2], unit[2], length;
    size_t i, k;
    int status, pass;
    if (m == 0 || !surface->log || !surface->exp || surface->stride == 0 || surface->stride > SURFMINK__STRIDE)
        return SURFMINK_BAD_ARGUMENT;
    if ((status = surfmink__log(surface, x, y, &length, direction)) != SURFMINK_OK) return status;
    surfmink__unit(direction, 2, unit);
    for (pass = 0; pass < 2; ++pass)
        for (i = 1; i < m; ++i) {
            status = surfmink__exp(surface, x, unit, length * (double)i / (double)m,
                                   pass ? point + i * surface->stride : trial);
            if (status != SURFMINK_OK) return status;
        }
    for (k = 0; k < surface->stride; ++k) point[k] = x[k];
    return SURFMINK_OK;
}

#ifdef __cplusplus
}
#endif
#endif /* SURFMINK_IMPLEMENTATION */

/* LICENSE: this software is available under two licenses; choose whichever you prefer.
   ------------------------------------------------------------------------------
   ALTERNATIVE A - MIT License
   Copyright (c) 2026 the surfmink authors
   Permission is hereby granted, free of charge, to any person obtaining a copy of
   this software and associated documentation files (the "Software"), to deal in
   the Software without restriction, including without limitation the rights to
   use, copy, modify, merge, publish, distribute, sublicense, and/or sell copies
   of the Software, and to permit persons to whom the Software is furnished to do
   so, subject to the following conditions:
   The above copyright notice and this permission notice shall be included in all
   copies or substantial portions of the Software.
   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
   IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
   FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
   AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
   LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
   OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE
   SOFTWARE.
   ------------------------------------------------------------------------------
   ALTERNATIVE B - Public Domain (www.unlicense.org)
   This is free and unencumbered software released into the public domain.
   Anyone is free to copy, modify, publish, use, compile, sell, or distribute this
   software, either in source code form or as a compiled binary, for any purpose,
   commercial or non-commercial, and by any means.
   In jurisdictions that recognize copyright laws, the author or authors of this
   software dedicate any and all copyright interest in the software to the public
   domain. We make this dedication for the benefit of the public at large and to
   the detriment of our heirs and successors. We intend this dedication to be an
   overt act of relinquishment in perpetuity of all present and future rights to
   this software under copyright law.
   THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
   IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
   FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE
   AUTHORS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN
   ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION
   WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
   ------------------------------------------------------------------------------ */
