/* surfmink.h - v0.4.0 - surface Minkowski tensors of closed curves - MIT or public domain, as you like (end of file)

   One header, C99 and C++, no allocation, no global state; of libm only sqrt.

   WHAT IT DOES
     Says how p-fold symmetric an outline on a curved surface is, and in which directions. Corners in, mu_p out:
     mu_p = 1 for a polygon with p equal angles on any surface, mu_p = 0 for a circle, and a value between for all other
     shapes. mu_2 measures elongation, mu_3 how triangular an outline is, ..., mu_6 how hexagonal.
     An outline is one closed curve without holes that encloses a Gaussian curvature below 2 pi (on a sphere: less than
     half of it). An invalid outline is refused with the reason if its turning angles or its area reveal the fault. A
     crossing that changes neither goes undetected; examples/beyond/crossings.h finds all crossings.

   QUICK START
     #define SURFMINK_IMPLEMENTATION                              // in exactly one .c or .cpp file
     #include "surfmink.h"

     double corner[9] = {0, 0, 1,  1, 0, 0,  0, 1, 0};            // an octant of the unit sphere, counter-clockwise
     double mu[7];                                                // mu_0 ... mu_6
     surfmink_outline octant = surfmink_sphere(corner, 3, 1.0);   // a view: nothing is copied
     int status = surfmink_measure(&octant, 6, mu, NULL, NULL, NULL);
     if (status != SURFMINK_OK) puts(surfmink_strerror(status));
     else printf("mu_3 = %.3f, mu_4 = %.3f\n", mu[3], mu[4]);     // 1 and 0: a triangle, right angles and all

   DATA FLOW (sections of this file, in order)
     corners (+ normals | surface callbacks)
       1 measure    edge lengths l_i, turning angles alpha_i     surfmink_edges, surfmink_total, surfmink_area
       2 transport  phases f_i                                   surfmink_phases
       3 integrate  irreducible components g_p, p = 0..P         surfmink_irreducible; full tensors from them
       4 spectrum   lambda_p, mu_p, eigenvector angles theta     surfmink_spectrum, surfmink_eigenvectors
     surfmink_measure calls the same four steps and gives the same bits. Only step 1 knows the surface: steps 2 to 4
     work on l_i and alpha_i alone. surfmink_batch measures many outlines at once in vector instructions; it is the last
     section.

   CONVENTIONS
     corner x_i     x_0 .. x_{n-1}, counter-clockwise about the outer normal, the first not repeated at the end
     length l_i     of edge i, which joins corner i to corner i+1 (indices modulo n); your unit
     turning        alpha_i, the signed turn AT corner i, positive towards the inside; radians in [-pi, pi]
     S              sum of alpha_i = 2 pi - enclosed Gaussian curvature; 2 pi in the plane
     phase f_i      of edge i: f_0 = 0, f_i = (2 pi / S)(alpha_1 + ... + alpha_i); one full turn adds 2 pi
     rank p         0 .. P = max_rank, any P; p = 0 gives L; mu_1 = 0 in the plane but in general not on curved surfaces
     g_p            sum of l_i exp(i p f_i), stored as g[2p] (real part) and g[2p+1] (imaginary part)
     lambda_p, mu_p |g_p| and |g_p| / L in [0, 1]
     theta          eigenvector angle in the surface, from the outward normal of edge 0 within the surface (the outer
                    co-normal nu = tau x normal) turning towards the tangent tau. g is read at the MIDDLE of edge 0.
     Arrays hold one corner after the other: x y (plane) or x y z. Lengths have the unit of the corners. In the
     descriptions below, the second column is the number of elements of an array.

   PAPER
     L. Happel, H. Hardering, S. Praetorius, A. Voigt: Surface Minkowski tensors to characterize shapes on curved
     surfaces, arXiv:2506.13880, 2025. "Paper 2.3" in this file is a section of it, (2.5) an equation. Section 3 turns
     by alpha_i between edges i-1 and i; so does this file. (Section 4.1 prints the sum one corner late, which is wrong
     where edges differ in length; 4.2 is right.)

   ERRORS
     A call that can fail returns SURFMINK_OK = 0 or the value of enum surfmink_status that names the fault. After a
     fault every output is untouched, except *bad: the corner at fault, or n if the outline as a whole is.
     (surfmink_edges may have filled part of its arrays when a callback fails half-way.) NULL is allowed only where a
     description says so. Outputs do not overlap inputs unless a description says so. No errno, no assert, no printing.
     All calls are re-entrant and thread-safe.

   CONFIGURE (all optional; define before the include that brings the implementation)
     SURFMINK_STATIC     a private copy, implementation included, in this file; may be used in several files at once
     SURFMINK_DEF        prefix of every public function, e.g. __declspec(dllexport)
     SURFMINK_SQRT       replaces sqrt; <math.h> is then not included
     SURFMINK_NO_SIMD    leaves the vector instructions out: surfmink_batch is then a loop over surfmink_measure
     SURFMINK_DISPATCH   batches test at run time whether the processor has AVX-512, or AVX2 with FMA (gcc and clang on
                         x86-64). Without it they use the instructions that the compiler may use: SSE2, AVX2 with
                         -mavx2 -mfma, AVX-512 with -march=..., NEON on arm64. To compile the kernels for each set, the
                         file includes itself under the name in __FILE_NAME__, else "surfmink.h"; SURFMINK_FILE sets
                         another name. A copy that is pasted into a .c file has no name, and no dispatch
     -fopenmp            batches of more than 4e5 corners use all cores
     Including the file again, with or without SURFMINK_IMPLEMENTATION, is harmless.

   ACCURACY
     Let c = max(1, (sum |alpha_i| + |2 pi - S|) / S). It is near 1 for most outlines, and larger for an outline that
     turns back and forth or encloses a curvature near 2 pi. For every outline that is not refused:
       L       to 1e-15, relative
       S       to 2e-15 c, relative; through callbacks to 2e-15 (c + sqrt(n) / 50)
       mu_p    to 1e-14 (1 + c + c^2 / 10), p <= 12, and the angle p theta_p of g_p, times mu_p, to the same;
               through callbacks to 1e-14 (1 + c^2 + sqrt(n) / 10)
       area    to 2e-15 of half the sum of |x_i - x_0| l_i, which is large beside the area of a sliver. The area of an
               embedded outline is an estimate: see surfmink_area
     This holds for single calls, steps, callbacks and batches, at any size, from 3 to 1e5 corners, for edges from
     2.3e-308 to 1e308. make accuracy compares all ways with quadruple precision: cells of size 1e-12, corners off the
     sphere, edges steep against the tangent plane, needles, spikes, spirals, outlines beside great circles. The worst
     cases found are in docs/internals/trust.md. c describes rounding only. An error e in the position of a corner may
     change mu_p by about 2 pi p e / (S l), with l the length of its edges.
     Angles come from differences of corners and an arctangent, never arccos; long sums are compensated. Corners for
     which the plain formulas lose digits (spikes, edges steep against the tangent plane or longer than 100 degrees on a
     sphere, extreme units) are measured with twice the digits, each by itself, in fifty times the time.

   DETERMINISM
     The same program on the same machine gives the same bits, in any thread and locale, and in a batch with any other
     outlines and any number of threads. sin, cos and atan2 are polynomials of this file, and sqrt is correctly rounded
     in IEEE arithmetic. So all machines, libraries and compilers give the same bits, provided that
       a*b+c is not fused: -ffp-contract=off. gcc does not fuse with -std=c99, no compiler does for plain x86-64. With
         FMA, gcc 12 at -O3 fuses in vector code whatever it is told; -fno-tree-slp-vectorize prevents it
       doubles have 64 bits: for 32-bit x86 this takes -msse2 -mfpmath=sse
       batches use the same class of instructions: none; SSE2; or AVX2, AVX-512 and NEON, which agree to the bit.
     Otherwise the last bits may differ; statuses do not. Batches and single calls, and different sets of vector
     instructions, differ within ACCURACY; so do fused a*b+c, and x87 with -std=c99. Rounding up, down or towards zero
     doubles that difference, but batches in vector instructions then lose half of their digits. -ffast-math, and x87
     without -std=c99, remove the digits beyond a double: mu_p is then good to 1e-14 (1 + c')^2, with c' =
     (sum |alpha_i| + |2 pi - S|) / S, and the area on a sphere to 1e-14 (1 + c')^2 R^2; where corners lie off the
     sphere by more than an outline is wide, mu_p to 1e-16 R over that width. With -ffast-math NaN and infinity are not
     refused.

   docs/CHANGELOG.md has the history of versions, and the calls that replace those of 0.3. */
#ifndef SURFMINK_H
#define SURFMINK_H

#define SURFMINK_VERSION       "0.4.0"
#define SURFMINK_VERSION_MAJOR 0
#define SURFMINK_VERSION_MINOR 4
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

/* What may be wrong with an outline. surfmink_strerror describes it, surfmink_status_name names it. */
enum surfmink_status {
    SURFMINK_OK = 0,
    SURFMINK_TOO_FEW_CORNERS = 1,    /* a polygon needs at least 3 */
    SURFMINK_NOT_FINITE = 2,         /* a NaN or an infinity; or a length or an area outside the range of doubles */
    SURFMINK_COINCIDENT_CORNERS = 3, /* two neighbours are the same point: surfmink_merge drops one of them */
    SURFMINK_ZERO_NORMAL = 4,        /* a normal has no direction; on the sphere: a corner is the centre */
    SURFMINK_UPRIGHT_EDGE = 5,       /* an edge runs along the normal: it has no direction in the tangent plane */
    SURFMINK_ANTIPODAL_CORNERS = 6,  /* two neighbours are opposite: no unique great circle joins them */
    SURFMINK_CLOCKWISE = 7,          /* S < 0: the corners run clockwise (surfmink_reverse mends it), the normals point
                                        inwards, or on a sphere more than a hemisphere is enclosed */
    SURFMINK_TOO_MUCH_CURVATURE = 8, /* the enclosed curvature reaches 2 pi: S is no more than rounding noise */
    SURFMINK_CROSSES_ITSELF = 9,     /* S and the area contradict each other, in either direction */
    SURFMINK_CALLBACK_FAILED = 10,   /* a surface's log or exp failed or returned nonsense */
    SURFMINK_BAD_ARGUMENT = 11,      /* a negative rank, a radius that is not positive, an edge >= n, ... */
    SURFMINK_OPPOSITE_NORMALS = 12 /* the normals of two neighbours are 90 degrees apart or more: one may be flipped */
};

/* One sentence for a status, "" for a number that is not a status. The texts are constants. */
SURFMINK_DEF const char *surfmink_strerror(int status);

/* One word for a status, for tables: "ok", "too_few_corners", ...; "" for any other number. */
SURFMINK_DEF const char *surfmink_status_name(int status);

/* --- outlines: a view of your arrays ------------------------------------------------------------------------------ */

/* A surface of yours. Corners are opaque to this file: stride doubles each, read only by the callbacks.
   log     the geodesic from x to y: its length > 0 and its direction at x, as two components in an oriented orthonormal
           frame at x of your choice, always the same at the same x; need not be unit. The surface need not lie in
           space. Coinciding points have no direction: return SURFMINK_COINCIDENT_CORNERS.
   exp     the point at the given length along the geodesic that leaves x in the given unit direction. Only
           surfmink_regular_polygon and surfmink_edge_points call it; without them it may be NULL.
   Return SURFMINK_OK, or the status to report (SURFMINK_CALLBACK_FAILED if no other fits); outputs are then not
   read. */
typedef struct surfmink_surface {
    void *context; /* passed unchanged to the callbacks */
    size_t stride; /* doubles per corner */
    int (*log)(void *context, const double *x, const double *y, double *length, double direction[2]);
    int (*exp)(void *context, const double *x, const double direction[2], double length, double *y);
} surfmink_surface;

/* Where an outline lies. */
enum surfmink_kind {
    SURFMINK_PLANE = 0,    /* straight edges */
    SURFMINK_SPHERE = 1,   /* great-circle edges, each shorter than half a great circle */
    SURFMINK_EMBEDDED = 2, /* chords between points of a surface in space with known normals (paper 4.2) */
    SURFMINK_SURFACE = 3   /* geodesic edges, by callbacks (paper 4.1) */
};

/* An outline, or for surfmink_batch the corners of all outlines. The four functions below fill it in.
   corner        the corners, one after the other
   normal        SURFMINK_EMBEDDED: outer normal at each corner; need not be unit. NULL for other kinds
   radius        SURFMINK_SPHERE: > 0, at most 1e307. Only the directions of corners count, so they may lie a little off
                 the sphere, or on the unit sphere while radius gives the unit of lengths. 1 for other kinds
   surface       SURFMINK_SURFACE: the callbacks. NULL for other kinds */
typedef struct surfmink_outline {
    enum surfmink_kind kind;
    size_t n;             /* number of corners, >= 3 */
    const double *corner; /* plane 2 n, sphere and embedded 3 n, surface n * stride */
    const double *normal; /* 3 n */
    double radius;
    const surfmink_surface *surface;
} surfmink_outline;

SURFMINK_DEF surfmink_outline surfmink_plane(const double *corner, size_t n);
SURFMINK_DEF surfmink_outline surfmink_sphere(const double *corner, size_t n, double radius);
SURFMINK_DEF surfmink_outline surfmink_embedded(const double *corner, const double *normal, size_t n);
SURFMINK_DEF surfmink_outline surfmink_on_surface(const surfmink_surface *surface, const double *corner, size_t n);

/* --- one call for all four steps ---------------------------------------------------------------------------------- */

/* The Minkowski functionals of an outline (paper 2.2) and what follows from them. */
typedef struct surfmink_functionals {
    double area;      /* W_0, see surfmink_area; 0 for callback surfaces, which cannot supply it */
    double length;    /* W_1 = L, the sum of the edge lengths */
    double turning;   /* W_2 = S, the sum of the turning angles */
    double curvature; /* enclosed Gaussian curvature 2 pi - S: plane 0, sphere area / R^2, which keeps small digits */
    double condition; /* sum |alpha_i| / S >= 1: by how much errors of single angles may be amplified */
} surfmink_functionals;

/* Measures an outline.
   max_rank           P >= 0
   mu          P + 1  out: mu_0 = 1, mu_1, ..., mu_P; or NULL
   g         2 P + 2  out: irreducible components, for surfmink_spectrum and surfmink_angles; or NULL
   w                  out: the Minkowski functionals; or NULL
   bad                out, only on failure: the corner at fault, or n; or NULL
   Errors: those of surfmink_edges and surfmink_total; BAD_ARGUMENT.
   Spikes: where the outline runs exactly back on itself the turn is pi without a sign. It counts as +pi, a whisker that
   sticks out; one that sticks in is refused as CROSSES_ITSELF.
   Cost: O(n P) time, 12 KiB of stack; outlines of more than 128 corners are measured twice, for S and for the phases.
   Paper (3.2), with the turn of section 3. */
SURFMINK_DEF int surfmink_measure(const surfmink_outline *outline, int max_rank, double *mu, double *g,
                                  surfmink_functionals *w, size_t *bad);

/* Where the results of a batch go: your arrays, one entry per outline. Each may be NULL, and then costs nothing. */
typedef struct surfmink_results {
    int *status;     /* of enum surfmink_status */
    size_t *bad;     /* of refused outlines only: the corner at fault, counted within the outline, or n */
    double *length;  /* L */
    double *turning; /* S */
    double *area;    /* W_0; 0 for callback surfaces */
    double *mu;      /* P + 1 per outline */
    double *g;       /* 2 P + 2 per outline, as surfmink_measure */
    double *theta;   /* P + 1 per outline, as surfmink_spectrum; about as much work as all of g */
} surfmink_results;

/* Measures many outlines in one call: surfmink_measure for each, but several at once in vector instructions.
   all                the corners of all outlines, one outline after the other; all->n is their number
   offset    count+1  outline i has the corners offset[i] .. offset[i+1] - 1
   count              number of outlines
   out                of a refused outline only status and bad are written
   scratch  2 all->n  doubles to work in; or NULL: then outlines with more than 128 corners are measured twice, as
                      surfmink_measure does. No bit depends on it
   returns            how many outlines were refused: 0 if all is well
   Errors: each outline has its own, as in surfmink_measure. All get BAD_ARGUMENT if max_rank or the radius is invalid;
   a single one does if its offsets decrease or it ends after all->n.
   The results of an outline do not depend on the others or on the number of threads. They differ from those of
   surfmink_measure by rounding. Cost: O(corners P), 90 KiB of stack; figures: docs/internals/performance.md. */
SURFMINK_DEF size_t surfmink_batch(const surfmink_outline *all, const size_t *offset, size_t count, int max_rank,
                                   const surfmink_results *out, double *scratch);

/* --- 1. measure: corners -> lengths, turning angles, Minkowski functionals ---------------------------------------- */

/* Edge lengths and turning angles. surfmink_total checks the outline as a whole.
   length      n      out: l_i, of the edge from corner i to corner i+1
   turning     n      out: alpha_i, at corner i, in [-pi, pi]
   bad                as in surfmink_measure; or NULL
   Errors (*bad: the corner that ends the edge): TOO_FEW_CORNERS, NOT_FINITE, COINCIDENT_CORNERS; BAD_ARGUMENT;
     sphere: ZERO_NORMAL (a corner at the centre), ANTIPODAL_CORNERS (within 8 eps);
     embedded: ZERO_NORMAL, OPPOSITE_NORMALS, UPRIGHT_EDGE (within 1e-6 rad of the normal);
     surface: what the callbacks return, else CALLBACK_FAILED.
   Cost: O(n), one arctangent per corner; surface: 2 n calls of log. Paper 4.2; sphere and surface: 4.1. */
SURFMINK_DEF int surfmink_edges(const surfmink_outline *outline, double *length, double *turning, size_t *bad);

/* L, S, area, 2 pi - S and the condition number of measured edges, or the fault of the outline as a whole.
   outline            the outline that was measured; or NULL: then S alone decides, and the area is 0
   length      n      lengths >= 0
   turning     n      radians
   n                  outline->n, if there is an outline
   Errors: TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT (a negative length, all lengths 0), and
     TOO_MUCH_CURVATURE  |S| < max(1e-12 sum |alpha|, 4 n eps), below which S is rounding noise
     plane: valid if S = 2 pi and area >= 0; CLOCKWISE if S = -2 pi and area <= 0; otherwise CROSSES_ITSELF. An area
       within 1e-15 L^2 is 0 up to rounding
     sphere: the same with S + area / R^2 = 2 pi and area >= 0; CLOCKWISE if both signs are reversed
     embedded: valid if S is in [pi, 3 pi]. Otherwise the solid angle W of the polygon of normals (the Gauss image)
       decides: valid if S > 0 and S + W = 2 pi modulo 4 pi within pi; CLOCKWISE if S < 0 and the vector area of the
       corners points against their mean normal; otherwise CROSSES_ITSELF
     surface, or no outline: S < 0 is CLOCKWISE; crossings are not looked for.
   Cost: O(n). Paper 2.2. */
SURFMINK_DEF int surfmink_total(const surfmink_outline *outline, const double *length, const double *turning, size_t n,
                                surfmink_functionals *w);

/* The enclosed area W_0, positive if counter-clockwise.
   plane: shoelace about corner 0, so that digits survive far away.
   sphere: in (-2 pi R^2, 2 pi R^2]: the area to the left of the outline if that is the smaller part, else minus the
   area to the right. Absolute error 2e-15 of half the sum of |x_i - x_0| l_i: slivers lose digits.
   embedded: of the surface between geodesic edges, estimated from corners and normals alone, with a relative error of
   second order in the size of the outline over the radii of curvature.
   Errors: those of surfmink_edges; NOT_FINITE (the area overflows); BAD_ARGUMENT (a callback surface). Cost: O(n). */
SURFMINK_DEF int surfmink_area(const surfmink_outline *outline, double *area);

/* --- 2. transport: turning angles -> phases ----------------------------------------------------------------------- */

/* Which transport along the outline a phase or a vector follows (paper 2.3). */
enum surfmink_transport {
    SURFMINK_CORRECTED = 0, /* f = phi + eta: after one turn round the outline every vector is back where it was */
    SURFMINK_PARALLEL = 1,  /* phi: the classical parallel transport, off by the enclosed curvature after one turn */
    SURFMINK_DEFECT = 2     /* eta = (2 pi / S - 1) phi: the rotation between the two */
};

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

/* The same for a tangent vector: from the middle of one edge to that of another, in place.
   turning     n      from surfmink_edges
   vector    2 or 3   in: its part along the normal of the edge is dropped; out: carried
   Errors: as surfmink_transport_angle and surfmink_frame. */
SURFMINK_DEF int surfmink_transport_vector(const surfmink_outline *outline, const double *turning, size_t from,
                                           ptrdiff_t steps, int transport, double *vector);

/* --- 3. integrate: lengths, phases -> irreducible components, tensors --------------------------------------------- */

/* Irreducible components g_p = sum_i length_i exp(i p phase_i), p = 0..P; corrected phases read them at the middle
   of edge 0.
   length      n      lengths >= 0
   phase       n      radians, from surfmink_phases
   max_rank           P >= 0; errors grow slowly with it (1e-14 at 128)
   g         2 P + 2  out: g[2p], g[2p+1]; g[0] = L, g[1] = 0
   Errors: TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT. Cost: O(n P), one sine and cosine an edge and 24 ranks, 6 KiB of
   stack. Paper (3.2). */
SURFMINK_DEF int surfmink_irreducible(const double *length, const double *phase, size_t n, int max_rank, double *g);

/* The same with the classical parallel transport to a point of the outline: at `fraction` of edge `edge`. Where
   curvature is enclosed the result depends on that point; the call is here for comparison only.
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

/* The same for its trace-free part, a function of g_p alone: 2^(1-p) times the real part of (-i)^j g_p (paper 2.4). */
SURFMINK_DEF int surfmink_trace_free(const double *g, int p, double *tensor);

/* Contracts a symmetric tensor of rank p with p - 1 copies of a vector. For the trace-free part of W_1^p and a unit
   eigenvector e the result is 2^(1-p) lambda e: the eigenvalue equation of paper 2.4.
   tensor      p + 1  as from surfmink_tensor or surfmink_trace_free
   p                  1 .. 1000
   vector      2      along nu, along tau
   contracted  2      out; may be the same array as vector
   Errors: BAD_ARGUMENT. Cost: O(p^2). Relative rounding errors grow like 2^(p/2) eps: unlike g, the components are an
   ill-conditioned basis at high rank. */
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

/* Co-normal, tangent and normal at the middle of an edge, unit vectors one after the other.
   frame     4 or 9   out: plane: nu, tau; else nu, tau, normal. Embedded: tau along the chord, normal the mean of those
                      at both ends, made orthogonal to the chord. Sphere: of the great circle
   Errors: those of surfmink_edges, for this edge; BAD_ARGUMENT (edge >= n, a callback surface). */
SURFMINK_DEF int surfmink_frame(const surfmink_outline *outline, size_t edge, double *frame);

/* Eigenvectors of rank p at an edge, as unit vectors: cos(theta - phase) nu + sin(theta - phase) tau.
   g, p, sign         as in surfmink_angles
   phase              f_i of that edge from surfmink_phases; 0 at edge 0
   frame     2 dim    of that edge, from surfmink_frame; dim 2 in the plane, else 3
   vector    p dim    out: one after the other, n = 0 .. p-1
   Errors: NOT_FINITE, BAD_ARGUMENT. Paper 2.4 and 3.1: eigenvectors at two edges are transports of each other. */
SURFMINK_DEF int surfmink_eigenvectors(const double *g, int p, int sign, double phase, const double *frame, int dim,
                                       double *vector);

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
SURFMINK_DEF surfmink_surface surfmink_sphere_surface(double *radius);

/* --- helpers: build, repair and convert outlines ------------------------------------------------------------------ */

/* The point of the sphere at a longitude and latitude in degrees. Quadrants are exact: -180 and 180 give the same
   point, as do all longitudes at a pole. lon in [-1e6, 1e6], lat in [-90, 90]. Errors: NOT_FINITE, BAD_ARGUMENT. */
SURFMINK_DEF int surfmink_from_lonlat(double lon, double lat, double radius, double point[3]);

/* Reverses the order of n corners (or normals) of `stride` doubles each, in place. */
SURFMINK_DEF void surfmink_reverse(double *corner, size_t n, size_t stride);

/* Replaces every corner (or normal) by the mean of itself and its two neighbours, `passes` times, in place. It smooths
   the staircase of pixel outlines (paper 5.3), and shrinks them a little. Cost: O(n passes). */
SURFMINK_DEF void surfmink_smooth(double *corner, size_t n, size_t stride, size_t passes);

/* Drops every corner that lies within a distance of the one kept before it (the last ones: of the first), in place.
   corner      n * stride
   normal      3 n    kept in step; or NULL
   distance           >= 0, straight; 0 drops equal corners. On the sphere, corners in the same direction but at
                      different distances from the centre are coincident, not equal
   returns            how many corners are left, at the front of the arrays */
SURFMINK_DEF size_t surfmink_merge(double *corner, double *normal, size_t n, size_t stride, double distance);

/* Corners of a regular polygon: n points at a geodesic distance from a centre, counter-clockwise, the first in the
   direction `angle` (radians) of the frame of the surface there.
   corner      n * surface->stride  out
   Errors: what exp returns, else CALLBACK_FAILED; TOO_FEW_CORNERS, NOT_FINITE, BAD_ARGUMENT (no exp; a stride above
   16; a distance that is not positive). Cost: 2 n calls of exp: corners are written only when all have succeeded. */
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

#ifndef SURFMINK_SQRT
#include <math.h>
#define SURFMINK_SQRT sqrt
#endif

static const double surfmink__pi = 3.14159265358979323846;
static const double surfmink__two_pi = 6.28318530717958647693;
static const double surfmink__eps = 2.220446049250313e-16; /* distance from 1 to the next double */
static const double surfmink__largest = 1.7976931348623157e308;

#define SURFMINK__BLOCK 128 /* edges that a call keeps on its stack */
#define SURFMINK__RANKS 24  /* ranks that are summed in one pass over the edges; a multiple of 3 */

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC push_options
#pragma GCC optimize("no-trapping-math") /* or gcc makes no vectors of comparisons */
#define SURFMINK__OPTIONS
#endif

#ifdef __cplusplus
extern "C" {
#endif

SURFMINK_DEF const char *surfmink_strerror(int status)
{
    switch (status) {
    case SURFMINK_OK: return "measured";
    case SURFMINK_TOO_FEW_CORNERS: return "a polygon needs at least 3 corners";
    case SURFMINK_NOT_FINITE: return "a number is not finite, or a length or an area is outside the range of doubles";
    case SURFMINK_COINCIDENT_CORNERS: return "two neighbouring corners coincide";
    case SURFMINK_ZERO_NORMAL: return "a normal has no direction (on the sphere: a corner is the centre)";
    case SURFMINK_UPRIGHT_EDGE: return "an edge runs along the normal of the surface";
    case SURFMINK_ANTIPODAL_CORNERS: return "two neighbouring corners are antipodal: no unique edge joins them";
    case SURFMINK_CLOCKWISE: return "the corners run clockwise (their turning angles add up to less than 0)";
    case SURFMINK_TOO_MUCH_CURVATURE: return "the enclosed curvature reaches 2 pi: no transport is defined";
    case SURFMINK_CROSSES_ITSELF: return "the outline crosses itself (its turns and its area contradict each other)";
    case SURFMINK_CALLBACK_FAILED: return "a callback of the surface failed";
    case SURFMINK_BAD_ARGUMENT: return "an argument is out of its range";
    case SURFMINK_OPPOSITE_NORMALS: return "the normals of two neighbouring corners are more than 90 degrees apart";
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
    case SURFMINK_OPPOSITE_NORMALS: return "opposite_normals";
    default: return "";
    }
}

/* --- outlines ----------------------------------------------------------------------------------------------------- */

static surfmink_outline surfmink__view(enum surfmink_kind kind, const double *corner, size_t n)
{
    surfmink_outline o;
    o.kind = kind;
    o.n = n;
    o.corner = corner;
    o.normal = NULL;
    o.radius = 1;
    o.surface = NULL;
    return o;
}

SURFMINK_DEF surfmink_outline surfmink_plane(const double *corner, size_t n)
{
    return surfmink__view(SURFMINK_PLANE, corner, n);
}

SURFMINK_DEF surfmink_outline surfmink_sphere(const double *corner, size_t n, double radius)
{
    surfmink_outline o = surfmink__view(SURFMINK_SPHERE, corner, n);
    o.radius = radius;
    return o;
}

SURFMINK_DEF surfmink_outline surfmink_embedded(const double *corner, const double *normal, size_t n)
{
    surfmink_outline o = surfmink__view(SURFMINK_EMBEDDED, corner, n);
    o.normal = normal;
    return o;
}

SURFMINK_DEF surfmink_outline surfmink_on_surface(const surfmink_surface *surface, const double *corner, size_t n)
{
    surfmink_outline o = surfmink__view(SURFMINK_SURFACE, corner, n);
    o.surface = surface;
    return o;
}

static size_t surfmink__next(const surfmink_outline *o, size_t i)
{
    return i + 1 < o->n ? i + 1 : 0;
}

static size_t surfmink__previous(const surfmink_outline *o, size_t i)
{
    return i > 0 ? i - 1 : o->n - 1;
}

/* Doubles a corner. */
static size_t surfmink__stride(const surfmink_outline *o)
{
    if (o->kind == SURFMINK_SURFACE) return o->surface->stride;
    return o->kind == SURFMINK_PLANE ? 2 : 3;
}

/* --- arithmetic --------------------------------------------------------------------------------------------------- */

/* Functions of loops over lanes, and those that vector kernels call, too: out of line these would be SSE code between
   AVX instructions, which makes long outlines five times as slow on some processors. */
#if defined(__GNUC__)
#define SURFMINK__INLINE static __inline__ __attribute__((always_inline))
#else
#define SURFMINK__INLINE static
#endif

SURFMINK__INLINE double surfmink__abs(double x)
{
    return x < 0 ? -x : x;
}

/* NaN fails both comparisons. */
static int surfmink__finite(const double *v, size_t dim)
{
    size_t k;
    for (k = 0; k < dim; ++k)
        if (!(v[k] >= -surfmink__largest && v[k] <= surfmink__largest)) return 0;
    return 1;
}

static double surfmink__max_abs(const double *v, size_t dim)
{
    double m = 0;
    size_t k;
    for (k = 0; k < dim; ++k)
        if (surfmink__abs(v[k]) > m) m = surfmink__abs(v[k]);
    return m;
}

/* The nearest integer. Beyond 2^52 all doubles are integers. */
static double surfmink__round(double x)
{
    double high = 0;
    if (!(surfmink__abs(x) < 4503599627370496.0)) return x;
    if (surfmink__abs(x) > 1073741824.0) { /* 2^30: a long may have 32 bits */
        high = (double)(long)(x / 1073741824.0) * 1073741824.0;
        x -= high;
    }
    return high + (double)(long)(x + (x < 0 ? -0.5 : 0.5));
}

/* A double-double: `high` is the number, `low` what rounding took from it. As the sum of many terms its error does not
   grow with their number. */
typedef struct surfmink__dd {
    double high, low;
} surfmink__dd;

SURFMINK__INLINE void surfmink__add(surfmink__dd *sum, double x)
{
    double high = sum->high + x;
    double kept = high - sum->high;
    sum->low += (sum->high - (high - kept)) + (x - kept);
    sum->high = high;
}

SURFMINK__INLINE double surfmink__value(const surfmink__dd *sum)
{
    return sum->high + sum->low;
}

static double surfmink__dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void surfmink__cross(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static void surfmink__sub(const double *a, const double *b, size_t dim, double *difference)
{
    size_t k;
    for (k = 0; k < dim; ++k) difference[k] = a[k] - b[k];
}

/* Squares of ordinary magnitude (2^-200, 2^200): products of four such factors neither overflow nor lose digits. */
static const double surfmink__small = 6.2230152778611417e-61, surfmink__large = 1.6069380442589903e60;

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
    double square = 0, m, scale;
    size_t k;
    for (k = 0; k < dim; ++k) {
        out[k] = v[k];
        square += v[k] * v[k];
    }
    if (square > surfmink__small && square < surfmink__large) return 1;
    m = surfmink__max_abs(v, dim);
    scale = m > 0 ? surfmink__scale(m) : 1;
    for (k = 0; k < dim; ++k) out[k] *= scale;
    return scale;
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

/* Formulas that several corners or edges on end go through at once: compilers turn loops over lanes into vector
   instructions, which changes no bit. */
#define SURFMINK__QUAD 4
/* Corners in full lanes, with both neighbours; coordinates of a block of them. */
#define SURFMINK__PADDED(count) (((count) + SURFMINK__QUAD - 1) / SURFMINK__QUAD * SURFMINK__QUAD + 2)
#define SURFMINK__SPAN          (3 * SURFMINK__PADDED(SURFMINK__BLOCK))

/* Angle of (x, y) in [-pi, pi], 0 of (0, 0), for magnitudes from 1e-150 to 1e150: the arctangent of a ratio t within
   tan(pi / 8) of 0, to which pi / 4, pi / 2 and pi are added with what they have beyond a double. The polynomial
   interpolates at Chebyshev's points; tests/accuracy/kernels.c computes and checks it. Multiples of 45 degrees are
   exact. Worst error in 1e7 angles: 3.3e-16, at y, x = 0x1.806e10dc69775p-1, -0x1.d00c4948d5e5fp+0; relative
   2.9e-16. */
SURFMINK__INLINE double surfmink__atan2_lane(double y, double x)
{
    double across = y < 0 ? -y : y, along = x < 0 ? -x : x, t, u, uu, odd, even, sign, offset, rest;
    double low = across < along ? across : along, high = across < along ? along : across;
    double wide = 0.41421356237309503 * high < low ? 1.0 : 0.0;
    high = 1e-300 < high ? high : 1e-300;
    t = (low - wide * high) / (high + wide * low);
    u = t * t;
    uu = u * u;
    even = -0.066645114473819475 + uu * (-0.050854497379402598 + uu * -0.01917688711906226);
    even = -0.33333333333333331 + uu * (-0.14285714284666542 + uu * (-0.090909045781239026 + uu * even));
    odd = 0.076921831908260865 + uu * (0.0585814891280221 + uu * 0.039231658295587189);
    odd = 0.19999999999995521 + uu * (0.11111111015256361 + uu * odd);
    offset = wide * 0.78539816339744831;
    rest = wide * 3.061616997868383e-17 + t * u * (even + u * odd);
    sign = along < across ? -1.0 : 1.0; /* pi / 2 - angle */
    offset = (along < across ? 1.5707963267948966 : 0.0) + sign * offset;
    rest = (along < across ? 6.123233995736766e-17 : 0.0) + sign * rest;
    t *= sign;
    sign = x < 0 ? -1.0 : 1.0; /* pi - angle */
    offset = (x < 0 ? 3.1415926535897931 : 0.0) + sign * offset;
    rest = (x < 0 ? 1.2246467991473532e-16 : 0.0) + sign * rest;
    t *= sign;
    sign = y < 0 ? -1.0 : 1.0;
    return sign * (offset + (t + rest));
}

static double surfmink__atan2(double y, double x)
{
    return surfmink__atan2_lane(y, x);
}

/* The nearest integer of a number below 2^31. */
SURFMINK__INLINE double surfmink__round_lane(double x)
{
    return (double)(int)(x + (x < 0 ? -0.5 : 0.5));
}

/* exp(i angle) for |angle| < 1e9: (-1)^k exp(i x) with an integer k and |x| <= pi / 2. k pi is taken off in two
   parts, of which the first has 33 bits, so that for k < 2^20 nothing is lost. Coefficients as in
   surfmink__atan2_lane. Worst error of either part in 3e6 angles within 4 pi: 3.6e-16, at -0x1.5ea986be1de39p+3. */
SURFMINK__INLINE void surfmink__cis_lane(double angle, double *re, double *im)
{
    double k = surfmink__round_lane(angle * 0.31830988618379067), x, u, cosine, sine, half;
    x = (angle - k * 3.1415926534682512) - k * 1.2154198847226498e-10;
    u = x * x;
    cosine = 2.0876630867422994e-09 + u * (-1.1464689885720029e-11 + u * 4.6276759850181716e-14);
    cosine = -0.0013888888888860709 + u * (2.4801587292446213e-05 + u * (-2.7557317767320528e-07 + u * cosine));
    cosine = u * (-0.5 + u * (0.041666666666666338 + u * cosine));
    sine = 1.6058977312464087e-10 + u * (-7.6439702967985717e-13 + u * 2.7314447669863995e-15);
    sine = -0.00019841269841254974 + u * (2.7557319219163234e-06 + u * (-2.5052107616996182e-08 + u * sine));
    sine = u * (-0.16666666666666666 + u * (0.0083333333333333159 + u * sine));
    half = 0.5 * k - (double)(int)(0.5 * k);
    half = 1 - 8 * half * half; /* -1 for odd k */
    *re = half * (1 + cosine);
    *im = half * (x + x * sine);
}

/* An angle that surfmink__cis_lane may have. Those beyond 1e9 have lost half of their digits anyway. */
static double surfmink__reduced(double angle)
{
    while (surfmink__abs(angle) >= 1e9) angle -= surfmink__two_pi * surfmink__round(angle / surfmink__two_pi);
    return angle;
}

static void surfmink__cis(double angle, double *re, double *im)
{
    surfmink__cis_lane(surfmink__reduced(angle), re, im);
}

/* 2 asin(chord / 2) of a chord up to 1, u its square. Worst relative error in 1e6 chords: 1.2e-16, at
   0x1.fd107a273f0f5p-1. */
SURFMINK__INLINE double surfmink__arc_lane(double chord, double u)
{
    double uu = u * u, even, odd;
    even = 3.9378411675208203e-08 + uu * (4.1486929518446973e-09 + uu * 4.28525378814661e-10);
    even = 0.00069754464291180358 + uu * (2.1847825138818251e-05 + uu * (8.5273516684283038e-07 + uu * even));
    odd = 1.7515834678932046e-07 + uu * (5.2046839891818601e-09 + uu * -8.8524145312590621e-10);
    odd = 0.0046874999999990206 + uu * (0.00011867946929113768 + uu * (4.2364240041186456e-06 + uu * odd));
    return chord + chord * u * ((0.041666666666666671 + uu * even) + u * odd);
}

/* --- arithmetic with twice the digits ----------------------------------------------------------------------------- */

/* Adds a b, for factors of ordinary magnitude: split into a float and a rest they have products that are exact doubles,
   but for the last, which is next to nothing; no compiler can spoil that by fusing a product with a sum. */
static void surfmink__add_product(surfmink__dd *sum, double a, double b)
{
    double a_high = (double)(float)a, b_high = (double)(float)b, a_low = a - a_high, b_low = b - b_high;
    surfmink__add(sum, a_high * b_high);
    surfmink__add(sum, a_high * b_low);
    surfmink__add(sum, a_low * b_high);
    surfmink__add(sum, a_low * b_low);
}

static void surfmink__dd_add_product(surfmink__dd *sum, surfmink__dd a, surfmink__dd b)
{
    surfmink__add_product(sum, a.high, b.high);
    surfmink__add(sum, a.high * b.low);
    surfmink__add(sum, a.low * b.high);
}

static surfmink__dd surfmink__dd_of(double high, double low)
{
    surfmink__dd sum;
    sum.high = high;
    sum.low = 0;
    surfmink__add(&sum, low);
    return sum;
}

static surfmink__dd surfmink__dd_minus(surfmink__dd a)
{
    a.high = -a.high;
    a.low = -a.low;
    return a;
}

/* a b + c d */
static surfmink__dd surfmink__dd_pair(surfmink__dd a, surfmink__dd b, surfmink__dd c, surfmink__dd d)
{
    surfmink__dd sum = {0, 0};
    surfmink__dd_add_product(&sum, a, b);
    surfmink__dd_add_product(&sum, c, d);
    return surfmink__dd_of(sum.high, sum.low);
}

static surfmink__dd surfmink__dd_dot(const surfmink__dd a[3], const surfmink__dd b[3])
{
    surfmink__dd sum = {0, 0};
    size_t k;
    for (k = 0; k < 3; ++k) surfmink__dd_add_product(&sum, a[k], b[k]);
    return surfmink__dd_of(sum.high, sum.low);
}

static void surfmink__dd_cross(const surfmink__dd a[3], const surfmink__dd b[3], surfmink__dd c[3])
{
    c[0] = surfmink__dd_pair(a[1], b[2], surfmink__dd_minus(a[2]), b[1]);
    c[1] = surfmink__dd_pair(a[2], b[0], surfmink__dd_minus(a[0]), b[2]);
    c[2] = surfmink__dd_pair(a[0], b[1], surfmink__dd_minus(a[1]), b[0]);
}

static surfmink__dd surfmink__dd_sqrt(surfmink__dd x)
{
    double root = SURFMINK_SQRT(x.high);
    surfmink__add_product(&x, -root, root);
    return surfmink__dd_of(root, surfmink__value(&x) / (2 * root));
}

/* Brings a vector into [1, 2), its largest component, by a power of two, which comes back. Zero stays zero. */
static double surfmink__dd_shrink(surfmink__dd *v, size_t dim)
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

static double surfmink__dd_norm(const surfmink__dd v[3])
{
    double u[3];
    size_t k;
    for (k = 0; k < 3; ++k) u[k] = v[k].high;
    return surfmink__norm(u, 3);
}

/* --- 1. measure --------------------------------------------------------------------------------------------------- */

/* Which corners the plain formulas measure to 1e-15; surfmink__corner_twice measures the others with twice the digits,
   or refuses them. Squares of edges and of normals are ordinary. Thresholds:
   steep   the part of both edges that lies in the tangent plane, as a product: the rounding of an edge is amplified by
           its inverse. Great-circle edges of 100 degrees have sin^2 of their half angles 0.6
   spike   sine over cosine of a turn near pi, below which its sign is rounding (a few eps) */
static const double surfmink__steep = 0.35, surfmink__spike = 1e-14;

static int surfmink__blame(int status, size_t corner, size_t *bad)
{
    if (bad) *bad = corner;
    return status;
}

/* What comes out of some corners on end: the length of the edge that leaves it, and the sine and cosine of its turn
   up to a common factor. */
typedef struct surfmink__quad {
    double length[SURFMINK__QUAD], sine[SURFMINK__QUAD], cosine[SURFMINK__QUAD];
    double in[SURFMINK__QUAD], out[SURFMINK__QUAD]; /* squares of the edges; out is 0 where something else is wrong */
    double size[SURFMINK__QUAD];                    /* the square of what the larger of sine and cosine has to exceed */
} surfmink__quad;

/* Do the plain formulas measure a turn? NaN does not pass. */
SURFMINK__INLINE int surfmink__plain(double in, double out, double sine, double cosine, double size)
{
    double larger = sine * sine > cosine * cosine ? sine * sine : cosine * cosine;
    return in > surfmink__small && in < surfmink__large && out > surfmink__small && out < surfmink__large &&
           larger > size && surfmink__abs(sine) > -surfmink__spike * cosine;
}

/* The turn from edge a to edge b in the plane orthogonal to n: n . (a x b) / |n| and a . b - (a . n)(b . n) for unit n,
   times |n|^2. a x b is a x (b - a) or b x (b - a), whichever edge is shorter: at nearly straight corners that does not
   cancel. aa, bb, nn are squares of the vectors. */
SURFMINK__INLINE void surfmink__turn(const double a[3], double aa, const double b[3], double bb, const double n[3],
                                     double nn, double *sine, double *cosine)
{
    double x = b[0] - a[0], y = b[1] - a[1], z = b[2] - a[2];
    double sx = aa < bb ? a[0] : b[0], sy = aa < bb ? a[1] : b[1], sz = aa < bb ? a[2] : b[2];
    *cosine = nn * surfmink__dot(a, b) - surfmink__dot(a, n) * surfmink__dot(b, n);
    *sine = n[0] * (sy * z - sz * y) + n[1] * (sz * x - sx * z) + n[2] * (sx * y - sy * x);
}

/* In what follows edge[0] arrives at the corner of the first lane, edge[1] leaves it, ..; n[0], n[1], .. are the
   normals (or corners) at the corner before the first lane, its own, .. that behind the last. Square roots have loops
   of their own, for they may set errno and keep compilers from making vectors. */
static void surfmink__turns_plane(const double *edge, surfmink__quad *l)
{
    const double *a = edge, *b = edge + 2;
    double d[2], s[2], aa, bb;
    size_t k;
    for (k = 0; k < SURFMINK__QUAD; ++k, a += 2, b += 2) {
        aa = a[0] * a[0] + a[1] * a[1];
        bb = b[0] * b[0] + b[1] * b[1];
        d[0] = b[0] - a[0];
        d[1] = b[1] - a[1];
        s[0] = aa < bb ? a[0] : b[0];
        s[1] = aa < bb ? a[1] : b[1];
        l->sine[k] = s[0] * d[1] - s[1] * d[0];
        l->cosine[k] = a[0] * b[0] + a[1] * b[1];
        l->in[k] = aa;
        l->out[k] = bb;
        l->size[k] = 0;
    }
    for (k = 0; k < SURFMINK__QUAD; ++k) l->length[k] = SURFMINK_SQRT(l->out[k]);
}

static void surfmink__turns_space(const double *edge, const double *n, surfmink__quad *l)
{
    const double *a = edge, *b = edge + 3;
    double aa, bb, nn[SURFMINK__QUAD];
    size_t k;
    for (k = 0; k < SURFMINK__QUAD; ++k, a += 3, b += 3) {
        aa = surfmink__dot(a, a);
        bb = surfmink__dot(b, b);
        nn[k] = surfmink__dot(n + 3 * k + 3, n + 3 * k + 3);
        surfmink__turn(a, aa, b, bb, n + 3 * k + 3, nn[k], l->sine + k, l->cosine + k);
        l->in[k] = aa;
        l->out[k] = bb;
        l->size[k] = surfmink__steep * surfmink__steep * nn[k] * nn[k] * aa * bb;
    }
    for (k = 0; k < SURFMINK__QUAD; ++k) {
        l->sine[k] *= SURFMINK_SQRT(nn[k]);
        l->length[k] = SURFMINK_SQRT(l->out[k]);
    }
}

/* Corner i of a sphere, scaled like corner 0 so that differences stay exact; on its own if far off. The scale comes
   back. */
static double surfmink__sphere_point(const surfmink_outline *o, size_t i, double x[3])
{
    const double *corner = o->corner + 3 * i;
    double m = surfmink__max_abs(corner, 3), scale = surfmink__binade(surfmink__max_abs(o->corner, 3));
    size_t k;
    if (!(m * scale < 32 && m * scale >= 1.0 / 32)) scale = surfmink__binade(m);
    for (k = 0; k < 3; ++k) x[k] = corner[k] * scale;
    return scale;
}

/* Corner i in space. */
static void surfmink__point(const surfmink_outline *o, size_t i, double x[3])
{
    const double *corner = o->corner + surfmink__stride(o) * i;
    if (o->kind == SURFMINK_SPHERE) {
        surfmink__sphere_point(o, i, x);
        return;
    }
    x[0] = corner[0];
    x[1] = corner[1];
    x[2] = o->kind == SURFMINK_PLANE ? 0 : corner[2];
}

static const double *surfmink__normal_at(const surfmink_outline *o, size_t i)
{
    static const double up[3] = {0, 0, 1};
    if (o->kind == SURFMINK_PLANE) return up;
    return (o->kind == SURFMINK_SPHERE ? o->corner : o->normal) + 3 * i;
}

/* The normal at corner i, its largest component in [1, 2). */
static void surfmink__axis(const surfmink_outline *o, size_t i, surfmink__dd axis[3])
{
    const double *normal = surfmink__normal_at(o, i);
    size_t k;
    for (k = 0; k < 3; ++k) axis[k] = surfmink__dd_of(normal[k], 0);
    surfmink__dd_shrink(axis, 3);
}

/* n x (y - x): the edge from x to y within the tangent plane, turned to the left, times a power of two, which comes
   back. What rounding takes from y - x is kept, and products lose 2^-100: where all but 8 eps of an edge is along n,
   what is left still has the digits of a double. */
static double surfmink__leftward(const surfmink__dd n[3], const double x[3], const double y[3], surfmink__dd left[3])
{
    surfmink__dd edge[3];
    double scale;
    size_t k;
    for (k = 0; k < 3; ++k) edge[k] = surfmink__dd_of(y[k], -x[k]);
    scale = surfmink__dd_shrink(edge, 3);
    surfmink__dd_cross(n, edge, left);
    return scale;
}

/* n . (a x b) for a and b orthogonal to n: |n| |a| |b| times the sine of the turn from a to b. */
static surfmink__dd surfmink__dd_triple(const surfmink__dd n[3], const surfmink__dd a[3], const surfmink__dd b[3])
{
    surfmink__dd cross[3];
    surfmink__dd_cross(a, b, cross);
    return surfmink__dd_dot(n, cross);
}

/* An exact spike (within rounding) has no sign: its turn is +pi. */
static void surfmink__turn_of(double y, double x, double *sine, double *cosine)
{
    *sine = x < 0 && surfmink__abs(y) <= -8 * surfmink__eps * x ? 0 : y;
    *cosine = x;
}

/* The angle at the centre of the great-circle edge from corner i to the next. Corners are refused as coincident if no
   more than what rounding makes of their distances from the centre keeps them apart, and as antipodal within 8 eps:
   there the edge direction would be rounding noise. */
static int surfmink__arc(const surfmink_outline *o, size_t i, double *angle)
{
    double x[3], y[3], edge[3], m[3], x_norm, y_norm, sine, cosine, off = 1;
    surfmink__dd n[3], left[3];
    int apart = surfmink__abs(surfmink__sphere_point(o, i, x) - surfmink__sphere_point(o, surfmink__next(o, i), y)) > 0;
    x_norm = surfmink__norm(x, 3);
    y_norm = surfmink__norm(y, 3);
    surfmink__sub(y, x, 3, edge);
    surfmink__cross(x, edge, m);
    sine = surfmink__norm(m, 3) / x_norm / y_norm;
    if (!(1.5 * sine * y_norm > surfmink__norm(edge, 3))) { /* steep: m may have lost digits */
        surfmink__axis(o, i, n);
        sine = 1 / surfmink__leftward(n, x, y, left);
        sine *= surfmink__dd_norm(left) / surfmink__dd_norm(n) / y_norm;
    }
    cosine = surfmink__dot(x, y) / x_norm / y_norm;
    if (!apart) off = surfmink__abs(y_norm - x_norm) / (x_norm > y_norm ? x_norm : y_norm);
    if (cosine < 0 && !(sine > 8 * surfmink__eps)) return SURFMINK_ANTIPODAL_CORNERS;
    if (!(sine > 8 * surfmink__eps * off)) return SURFMINK_COINCIDENT_CORNERS;
    *angle = surfmink__atan2(sine, cosine);
    return SURFMINK_OK;
}

/* Is there something wrong with a corner, whatever its neighbours? */
static int surfmink__check_corner(const surfmink_outline *o, size_t i)
{
    const double *normal = surfmink__normal_at(o, i);
    size_t dim = surfmink__stride(o);
    if (!surfmink__finite(o->corner + dim * i, dim) || !surfmink__finite(normal, 3)) return SURFMINK_NOT_FINITE;
    return surfmink__max_abs(normal, 3) > 0 ? SURFMINK_OK : SURFMINK_ZERO_NORMAL;
}

/* Does the edge from x to y run along the normal at corner i, so that it has no direction in the tangent plane? 1e-6
   rad, in sine. */
static int surfmink__upright(const surfmink_outline *o, size_t i, const double *x, const double *y)
{
    double edge[3], e[3], axis[3], along, size;
    surfmink__dd n[3], left[3];
    size_t k;
    surfmink__sub(y, x, 3, edge);
    surfmink__axis(o, i, n);
    surfmink__shrink(edge, 3, e);
    for (k = 0; k < 3; ++k) axis[k] = n[k].high;
    along = surfmink__dot(e, axis);
    if (2 * along * along < surfmink__dot(e, e) * surfmink__dot(axis, axis)) return 0; /* not even steep */
    size = surfmink__norm(edge, 3) * surfmink__leftward(n, x, y, left) * surfmink__dd_norm(n);
    return !(surfmink__dd_norm(left) > 1e-6 * size);
}

/* Are two normals more than 90 degrees apart? The slack, 1e-6 rad, is for octants, whose normals are 90 degrees apart
   but for rounding. */
static int surfmink__opposite(const double *a, const double *b)
{
    double a_unit[3], b_unit[3];
    surfmink__unit(a, 3, a_unit);
    surfmink__unit(b, 3, b_unit);
    return surfmink__dot(a_unit, b_unit) < -1e-6;
}

/* The shortest length that has all digits of a double; the longest that may still be multiplied by sqrt(3). */
static const double surfmink__shortest = 2.2250738585072014e-308, surfmink__longest = 1e308;

/* Is there something wrong with the edge from corner i to the next? */
static int surfmink__check_edge(const surfmink_outline *o, size_t i)
{
    size_t next = surfmink__next(o, i), dim = surfmink__stride(o);
    double edge[3], angle, size;
    const double *a = o->corner + dim * i, *b = o->corner + dim * next;
    int status;
    if (o->kind == SURFMINK_SPHERE) {
        if ((status = surfmink__arc(o, i, &angle)) != SURFMINK_OK) return status;
        return o->radius * angle >= surfmink__shortest ? SURFMINK_OK : SURFMINK_NOT_FINITE;
    }
    surfmink__sub(b, a, dim, edge);
    size = surfmink__max_abs(edge, dim);
    if (!(size <= surfmink__longest)) return SURFMINK_NOT_FINITE;
    if (!(size > 0)) return SURFMINK_COINCIDENT_CORNERS;
    if (size < surfmink__shortest) return SURFMINK_NOT_FINITE;
    if (o->kind == SURFMINK_PLANE) return SURFMINK_OK;
    if (surfmink__opposite(o->normal + 3 * i, o->normal + 3 * next)) return SURFMINK_OPPOSITE_NORMALS;
    return surfmink__upright(o, i, a, b) || surfmink__upright(o, next, a, b) ? SURFMINK_UPRIGHT_EDGE : SURFMINK_OK;
}

/* A corner that the plain formulas do not measure: they are tried again at ordinary magnitude, so that the same bits
   come out in any unit (on a sphere they were there); then it has its turn with twice the digits. Returns 0 if there is
   something wrong with it. */
static int surfmink__corner_twice(const surfmink_outline *o, size_t i, double *length, double *sine, double *cosine)
{
    size_t previous = surfmink__previous(o, i), next = surfmink__next(o, i), k;
    double before[3], x[3], after[3], in[3], out[3], n[3], in_in, out_out, nn, scale, angle = 0;
    surfmink__dd axis[3], from[3], to[3], turn[2] = {{0, 0}, {0, 0}};
    if (surfmink__check_corner(o, previous) != SURFMINK_OK || surfmink__check_corner(o, i) != SURFMINK_OK ||
        surfmink__check_corner(o, next) != SURFMINK_OK || surfmink__check_edge(o, previous) != SURFMINK_OK ||
        surfmink__check_edge(o, i) != SURFMINK_OK)
        return 0;
    surfmink__point(o, previous, before);
    surfmink__point(o, i, x);
    surfmink__point(o, next, after);
    surfmink__axis(o, i, axis);
    surfmink__sub(x, before, 3, in);
    surfmink__sub(after, x, 3, out);
    if (o->kind == SURFMINK_SPHERE)
        surfmink__arc(o, i, &angle);
    else
        angle = surfmink__norm(out, 3);
    *length = angle * o->radius;
    in_in = surfmink__max_abs(in, 3);
    out_out = surfmink__max_abs(out, 3);
    scale = surfmink__binade(in_in > out_out ? in_in : out_out);
    for (k = 0; k < 3; ++k) {
        in[k] *= scale;
        out[k] *= scale;
        n[k] = axis[k].high;
    }
    in_in = surfmink__dot(in, in);
    out_out = surfmink__dot(out, out);
    nn = surfmink__dot(n, n);
    surfmink__turn(in, in_in, out, out_out, n, nn, sine, cosine);
    *sine *= SURFMINK_SQRT(nn);
    if (o->kind != SURFMINK_SPHERE &&
        surfmink__plain(in_in, out_out, *sine, *cosine, surfmink__steep * surfmink__steep * nn * nn * in_in * out_out))
        return 1;
    surfmink__leftward(axis, before, x, from);
    surfmink__leftward(axis, x, after, to);
    surfmink__dd_add_product(turn, surfmink__dd_dot(from, to), surfmink__dd_sqrt(surfmink__dd_dot(axis, axis)));
    turn[1] = surfmink__dd_triple(axis, from, to);
    surfmink__dd_shrink(turn, 2);
    surfmink__turn_of(turn[1].high, turn[0].high, sine, cosine);
    return 1;
}

/* Corners (or normals) on end, from the one before `first` on, as many as the lanes of `count` corners and their
   neighbours take; scaled by a power of two, on a sphere each by its own if that is 0. */
static void surfmink__copy(const surfmink_outline *o, const double *from, double scale, size_t first, size_t count,
                           double copy[SURFMINK__SPAN])
{
    size_t i = surfmink__previous(o, first), dim = o->kind == SURFMINK_PLANE ? 2 : 3;
    const double *at = from + dim * i;
    double x, y, *end = copy + dim * SURFMINK__PADDED(count);
    for (; copy < end; copy += dim) { /* read before written, so that compilers may store both at once */
        x = at[0] * scale;
        y = at[1] * scale;
        copy[0] = x;
        copy[1] = y;
        if (dim > 2) copy[2] = at[2] * scale;
        if (!(scale > 0)) surfmink__sphere_point(o, i, copy);
        i = surfmink__next(o, i);
        at = i > 0 ? at + dim : from;
    }
}

/* The edges between corners that were copied. Nothing else is done here: with -ffast-math compilers would make
   x - 2 y + z of the difference of two edges, which has no digits where corners are close. */
static void surfmink__edges_between(const double *x, size_t dim, size_t count, double edge[SURFMINK__SPAN])
{
    size_t k, end = dim * (SURFMINK__PADDED(count) - 1);
    for (k = 0; k < end; ++k) edge[k] = x[k + dim] - x[k];
}

/* Normals that are 90 degrees or more from that of the corner before, or not of ordinary size, are none that plain
   formulas take. */
static void surfmink__between_normals(const double *n, surfmink__quad *l)
{
    double nn;
    size_t k;
    for (k = 0; k < SURFMINK__QUAD; ++k, n += 3) {
        nn = surfmink__dot(n + 3, n + 3);
        if (!(surfmink__dot(n, n + 3) > 0 && nn > surfmink__small && nn < surfmink__large)) l->out[k] = 0;
    }
}

/* The power of two that brings the corners of a sphere to ordinary magnitude: 1 for all but absurd units. */
static double surfmink__ray_scale(const surfmink_outline *o)
{
    double m = surfmink__max_abs(o->corner, 3);
    if (m >= 8.8817841970012523e-16 && m <= 1125899906842624.0) return 1; /* 2^-50, 2^50 */
    return m > 0 && m <= surfmink__largest ? surfmink__binade(m) : 1;
}

/* Great-circle edges of corners that may lie a little off the sphere. The direction of an edge in the tangent plane is
   that of the chord; its length needs the chord within the unit sphere, whose square is
   (|y - x|^2 - (|y| - |x|)^2) / |x||y|. A corner is not plain where the edge rises by more than a tenth of its
   length, is shorter than eps, or ends next to the antipode. */
static void surfmink__arcs(const double *x, const double *edge, double radius, surfmink__quad *l)
{
    double norm[SURFMINK__QUAD + 1], rise, chord[SURFMINK__QUAD], root[SURFMINK__QUAD];
    const double *a = x + 3, *b = x + 6, *e = edge + 3;
    size_t k;
    for (k = 0; k <= SURFMINK__QUAD; ++k) {
        norm[k] = SURFMINK_SQRT(surfmink__dot(x + 3 * k + 3, x + 3 * k + 3));
        if (!(norm[k] > 0)) norm[k] = 1; /* the centre, which is refused: nothing is divided by 0 */
    }
    for (k = 0; k < SURFMINK__QUAD; ++k, a += 3, b += 3, e += 3) {
        rise = e[0] * (b[0] + a[0]) + e[1] * (b[1] + a[1]) + e[2] * (b[2] + a[2]);
        rise = rise / (norm[k] + norm[k + 1]); /* |y| - |x| */
        chord[k] = (l->out[k] - rise * rise) / (norm[k] * norm[k + 1]);
        if (!(100 * rise * rise < l->out[k] && chord[k] > surfmink__eps * surfmink__eps && chord[k] < 3.5))
            l->out[k] = 0;
        root[k] = SURFMINK_SQRT(chord[k] > 0 ? chord[k] : 0);
    }
    for (k = 0; k < SURFMINK__QUAD; ++k) l->length[k] = radius * surfmink__arc_lane(root[k], chord[k]);
    for (k = 0; k < SURFMINK__QUAD; ++k) {
        if (chord[k] >= 1 && chord[k] < 3.5)
            l->length[k] = radius * 2 * surfmink__atan2(root[k], SURFMINK_SQRT(4 - chord[k]));
        if (!(l->length[k] >= surfmink__shortest)) l->out[k] = 0;
    }
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
    if (*length < surfmink__shortest) return SURFMINK_NOT_FINITE;
    return surfmink__max_abs(direction, 2) > 0 ? SURFMINK_OK : SURFMINK_CALLBACK_FAILED;
}

/* A corner between geodesic edges. The way back to the corner before points against the edge that arrives. */
static int surfmink__corner_surface(const surfmink_outline *o, size_t i, double *length, double *sine, double *cosine)
{
    const double *x = o->corner + o->surface->stride * i;
    double in[2], out[2], back;
    surfmink__dd a[2], b[2], turn[2];
    size_t k;
    int status = surfmink__log(o->surface, x, o->corner + o->surface->stride * surfmink__previous(o, i), &back, in);
    if (status == SURFMINK_OK)
        status = surfmink__log(o->surface, x, o->corner + o->surface->stride * surfmink__next(o, i), length, out);
    if (status != SURFMINK_OK) return status;
    for (k = 0; k < 2; ++k) {
        a[k] = surfmink__dd_of(-in[k], 0);
        b[k] = surfmink__dd_of(out[k], 0);
    }
    surfmink__dd_shrink(a, 2);
    surfmink__dd_shrink(b, 2);
    turn[0] = surfmink__dd_pair(a[0], b[0], a[1], b[1]);
    turn[1] = surfmink__dd_pair(a[0], b[1], surfmink__dd_minus(a[1]), b[0]);
    surfmink__dd_shrink(turn, 2);
    surfmink__turn_of(turn[1].high, turn[0].high, sine, cosine);
    return SURFMINK_OK;
}

/* The corners of some lanes, one surface or the other, from edges and normals (on a sphere: corners) on end. Returns 0
   if a corner among the first `count` is refused. */
static int surfmink__measure_lanes(const surfmink_outline *o, size_t first, size_t count, const double *edge,
                                   const double *normal, surfmink__quad *l)
{
    size_t k;
    if (o->kind == SURFMINK_PLANE)
        surfmink__turns_plane(edge, l);
    else
        surfmink__turns_space(edge, normal, l);
    if (o->kind == SURFMINK_SPHERE) surfmink__arcs(normal, edge, o->radius, l);
    if (o->kind == SURFMINK_EMBEDDED) surfmink__between_normals(normal, l);
    for (k = 0; k < count; ++k)
        if (!surfmink__plain(l->in[k], l->out[k], l->sine[k], l->cosine[k], l->size[k]) &&
            !surfmink__corner_twice(o, first + k, l->length + k, l->sine + k, l->cosine + k))
            return 0;
    return 1;
}

/* A radius, or a distance: finite even if multiplied by 2 pi. */
static int surfmink__positive(double x)
{
    return x > 0 && x <= 1e307;
}

static int surfmink__has_arrays(const surfmink_outline *o)
{
    return o->corner && (o->normal || o->kind != SURFMINK_EMBEDDED);
}

/* What can be told of an outline without looking at its corners. */
static int surfmink__check_view(const surfmink_outline *o, size_t *bad)
{
    if (o->kind == SURFMINK_SPHERE && !surfmink__positive(o->radius))
        return surfmink__blame(SURFMINK_BAD_ARGUMENT, o->n, bad);
    if (o->kind == SURFMINK_SURFACE && (!o->surface || !o->surface->log || o->surface->stride == 0))
        return surfmink__blame(SURFMINK_BAD_ARGUMENT, o->n, bad);
    if ((unsigned)o->kind > SURFMINK_SURFACE) return surfmink__blame(SURFMINK_BAD_ARGUMENT, o->n, bad);
    if (o->n < 3) return surfmink__blame(SURFMINK_TOO_FEW_CORNERS, o->n, bad);
    return surfmink__has_arrays(o) ? SURFMINK_OK : surfmink__blame(SURFMINK_BAD_ARGUMENT, o->n, bad);
}

/* What is wrong with an outline that is refused: the first bad corner; else the first bad edge, which is blamed on its
   later corner. */
static int surfmink__find_fault(const surfmink_outline *o, size_t *bad)
{
    size_t i, at = o->n;
    int found, status = SURFMINK_NOT_FINITE;
    for (i = o->n; i > 0; --i) {
        if ((found = surfmink__check_corner(o, i - 1)) == SURFMINK_OK) continue;
        status = found;
        at = i - 1;
    }
    for (i = at < o->n ? 0 : o->n; i > 0; --i) {
        if ((found = surfmink__check_edge(o, i - 1)) == SURFMINK_OK) continue;
        status = found;
        at = i < o->n ? i : i - 1;
    }
    return surfmink__blame(status, at, bad);
}

/* Edges first .. first + count - 1, at most SURFMINK__BLOCK. All turning angles of single calls, on all surfaces, come
   from the arctangent below; those of batches from `angles`. */
static int surfmink__measure_edges(const surfmink_outline *o, size_t first, size_t count, double *length,
                                   double *turning, size_t *bad)
{
    const size_t dim = o->kind == SURFMINK_PLANE ? 2 : 3;
    double x[SURFMINK__SPAN], edge[SURFMINK__SPAN], normal[SURFMINK__SPAN], angle[SURFMINK__QUAD];
    const double *n = o->kind == SURFMINK_SPHERE ? x : normal;
    surfmink__quad l;
    size_t i, k, lanes;
    int status;
    if (o->kind != SURFMINK_SURFACE) {
        surfmink__copy(o, o->corner, o->kind == SURFMINK_SPHERE ? surfmink__ray_scale(o) : 1, first, count, x);
        surfmink__edges_between(x, dim, count, edge);
    }
    if (o->kind == SURFMINK_EMBEDDED) surfmink__copy(o, o->normal, 1, first, count, normal);
    for (i = 0; i < count; i += lanes) {
        lanes = count - i < SURFMINK__QUAD ? count - i : SURFMINK__QUAD;
        if (o->kind != SURFMINK_SURFACE) {
            if (!surfmink__measure_lanes(o, first + i, lanes, edge + dim * i, n + 3 * i, &l))
                return surfmink__find_fault(o, bad);
        } else
            for (k = 0; k < SURFMINK__QUAD; ++k) {
                l.sine[k] = l.cosine[k] = 0;
                if (k >= lanes) continue;
                status = surfmink__corner_surface(o, first + i + k, l.length + k, l.sine + k, l.cosine + k);
                if (status != SURFMINK_OK) return surfmink__blame(status, first + i + k, bad);
            }
        for (k = 0; k < SURFMINK__QUAD; ++k) angle[k] = surfmink__atan2_lane(l.sine[k], l.cosine[k]);
        for (k = 0; k < lanes; ++k) {
            length[i + k] = l.length[k];
            turning[i + k] = angle[k];
        }
    }
    return SURFMINK_OK;
}

/* Edges, wherever they come from: arrays, or else an outline, which is measured block by block. */
typedef struct surfmink__polygon {
    const surfmink_outline *outline;
    const double *length, *turning; /* n each, or NULL */
    size_t n;
} surfmink__polygon;

/* The edges from number `first` on, at most SURFMINK__BLOCK. */
typedef struct surfmink__block {
    const double *length, *turning;
    size_t count;
    double own[2][SURFMINK__BLOCK];
} surfmink__block;

static int surfmink__load(const surfmink__polygon *p, size_t first, surfmink__block *b, size_t *bad)
{
    b->count = p->n - first < SURFMINK__BLOCK ? p->n - first : SURFMINK__BLOCK;
    b->length = p->length ? p->length + first : b->own[0];
    b->turning = p->length ? p->turning + first : b->own[1];
    if (p->length) return SURFMINK_OK;
    return surfmink__measure_edges(p->outline, first, b->count, b->own[0], b->own[1], bad);
}

/* An outline as a polygon: if it is short, measured into a block that outlives the call, else to be measured again. */
static int surfmink__polygon_of(const surfmink_outline *o, surfmink__polygon *p, surfmink__block *kept, size_t *bad)
{
    int status = surfmink__check_view(o, bad);
    p->outline = o;
    p->length = p->turning = NULL;
    p->n = o->n;
    if (status != SURFMINK_OK || o->n > SURFMINK__BLOCK) return status;
    status = surfmink__load(p, 0, kept, bad);
    p->length = kept->length;
    p->turning = kept->turning;
    return status;
}

SURFMINK_DEF int surfmink_edges(const surfmink_outline *outline, double *length, double *turning, size_t *bad)
{
    surfmink__polygon polygon;
    surfmink__block block;
    size_t first, i;
    int status = surfmink__polygon_of(outline, &polygon, &block, bad), pass;
    /* A long one is looked at before anything is written; callbacks may be too expensive for that. */
    for (pass = outline->n > SURFMINK__BLOCK && outline->kind != SURFMINK_SURFACE ? 0 : 1; pass < 2; ++pass)
        for (first = 0; first < outline->n && status == SURFMINK_OK; first += block.count) {
            status = surfmink__load(&polygon, first, &block, bad);
            for (i = 0; i < block.count && status == SURFMINK_OK && pass > 0; ++i) {
                length[first + i] = block.length[i];
                turning[first + i] = block.turning[i];
            }
        }
    return status;
}

/* Shoelace about corner 0, with edges as differences: a x e, where a leads from corner 0 to the edge e. */
static double surfmink__shoelace(const surfmink_outline *o, double scale)
{
    const double *first = o->corner, *x = o->corner + 2, *next;
    surfmink__dd twice = {0, 0};
    size_t i;
    for (i = 1; i + 1 < o->n; ++i, x = next) {
        next = x + 2;
        surfmink__add(&twice, (x[0] * scale - first[0] * scale) * (next[1] * scale - x[1] * scale) -
                                  (x[1] * scale - first[1] * scale) * (next[0] * scale - x[0] * scale));
    }
    return surfmink__value(&twice) / 2;
}

/* W_0 in the plane times the square of a power of two: 1 but for areas that overflow or lose digits. */
static double surfmink__area_plane(const surfmink_outline *o, double *scale)
{
    double area = surfmink__shoelace(o, 1);
    *scale = 1;
    if (surfmink__abs(area) > surfmink__small && surfmink__abs(area) < surfmink__large) return area;
    *scale = surfmink__scale(surfmink__max_abs(o->corner, 2 * o->n));
    return surfmink__shoelace(o, *scale);
}

/* w becomes w z. */
static void surfmink__multiply(double w[2], double re, double im)
{
    double swap = w[0] * re - w[1] * im;
    w[1] = w[0] * im + w[1] * re;
    w[0] = swap;
}

/* A fan of triangles (a, x, y) on a sphere, from an apex a, which need not be a corner. Half the solid angle of one is
   the argument of |a||x||y| + |y| a.x + |a| x.y + |x| y.a + i a.(x x y). */
typedef struct surfmink__fan {
    double a[3], norm;
    double worst; /* smallest square of the moduli of these numbers over |a||x||y|: near 0 next to -a */
} surfmink__fan;

/* a.(x x y) / |a||x||y| with twice the digits, for triangles with a steep side. */
static double surfmink__triple(const surfmink__fan *fan, const double x[3], const double y[3], double norms)
{
    surfmink__dd a[3], left_x[3], left_y[3];
    double triple, norm, scale;
    size_t k;
    for (k = 0; k < 3; ++k) a[k] = surfmink__dd_of(fan->a[k], 0);
    surfmink__dd_shrink(a, 3);
    scale = surfmink__leftward(a, fan->a, x, left_x) * surfmink__leftward(a, fan->a, y, left_y);
    norm = surfmink__dd_norm(a);
    triple = surfmink__dd_triple(a, left_x, left_y).high / scale;
    return triple / (norm * norm * norm) * (fan->norm / norms);
}

/* The numbers of triangles on end, over |a||x||y|. The triple product is put together from differences, so that small
   triangles keep their digits. */
static void surfmink__triangles(const surfmink__fan *fan, const double *corner, const double *edge,
                                double re[SURFMINK__QUAD], double im[SURFMINK__QUAD])
{
    double norm[SURFMINK__QUAD + 1], norms, to_x[3], cross[3], rise, edge_rise;
    const double *x = corner + 3, *y = corner + 6, *e = edge + 3;
    size_t k;
    for (k = 0; k <= SURFMINK__QUAD; ++k) norm[k] = SURFMINK_SQRT(surfmink__dot(x + 3 * k, x + 3 * k));
    for (k = 0; k < SURFMINK__QUAD; ++k, x += 3, y += 3, e += 3) {
        surfmink__sub(x, fan->a, 3, to_x);
        norms = fan->norm * norm[k] * norm[k + 1];
        surfmink__cross(to_x, e, cross);
        im[k] = surfmink__dot(fan->a, cross) / norms;
        re[k] = norm[k + 1] * surfmink__dot(fan->a, x) + fan->norm * surfmink__dot(x, y) +
                norm[k] * surfmink__dot(y, fan->a);
        re[k] = 1 + re[k] / norms;
        rise = norm[k] - fan->norm;
        edge_rise = norm[k + 1] - norm[k];
        if (2 * rise * rise > surfmink__dot(to_x, to_x) || 2 * edge_rise * edge_rise > surfmink__dot(e, e))
            im[k] = surfmink__triple(fan, x, y, norms);
    }
}

/* Solid angle to the left of an outline on a sphere, modulo 4 pi, from the edges first .. end - 1: triangles from
   corner 0 to its own edges have none. Sixteen numbers of triangles are multiplied before their argument is taken:
   their moduli lie between fan->worst and 4. */
static double surfmink__fan_angle(surfmink__fan *fan, const surfmink_outline *o, double scale, size_t first, size_t end)
{
    surfmink__dd sum = {0, 0};
    double x[SURFMINK__SPAN], edge[SURFMINK__SPAN], re[SURFMINK__QUAD], im[SURFMINK__QUAD], z[2] = {1, 0}, square;
    size_t i, k, count;
    for (; first < end; first += count) {
        count = end - first < SURFMINK__BLOCK ? end - first : SURFMINK__BLOCK;
        surfmink__copy(o, o->corner, scale, first, count, x);
        surfmink__edges_between(x, 3, count, edge);
        for (i = 0; i < count; i += SURFMINK__QUAD) {
            surfmink__triangles(fan, x + 3 * i, edge + 3 * i, re, im);
            for (k = 0; k < SURFMINK__QUAD && i + k < count; ++k) {
                square = re[k] * re[k] + im[k] * im[k];
                if (!(square >= fan->worst)) fan->worst = square;
                surfmink__multiply(z, re[k], im[k]);
            }
            if (i % 16 != 12 && i + k < count) continue;
            surfmink__add(&sum, 2 * surfmink__atan2(z[1], z[0]));
            z[0] = 1;
            z[1] = 0;
        }
    }
    return surfmink__value(&sum);
}

/* Vector area of an outline in space, half the sum of x x x', about corner 0, times the square of the scale. Its unit
   vector is the mean normal of what it encloses. */
static double surfmink__vector_area(const surfmink_outline *o, double scale, double direction[3])
{
    surfmink__dd sum[3] = {{0, 0}, {0, 0}, {0, 0}};
    double a[3], e[3], cross[3], twice[3], norm;
    size_t i, k;
    for (i = 1; i + 1 < o->n; ++i) {
        for (k = 0; k < 3; ++k) {
            a[k] = (o->corner[3 * i + k] - o->corner[k]) * scale;
            e[k] = (o->corner[3 * i + 3 + k] - o->corner[3 * i + k]) * scale;
        }
        surfmink__cross(a, e, cross);
        for (k = 0; k < 3; ++k) surfmink__add(sum + k, cross[k]);
    }
    for (k = 0; k < 3; ++k) twice[k] = surfmink__value(sum + k);
    norm = surfmink__norm(twice, 3);
    for (k = 0; k < 3; ++k) direction[k] = norm > 0 ? twice[k] / norm : 0;
    return norm / 2;
}

/* Are the corners of a sphere of like magnitude, so that one scale will do for all? */
static int surfmink__alike(const surfmink_outline *o, double scale)
{
    double m;
    size_t i;
    for (i = 0; i < o->n; ++i) {
        m = surfmink__max_abs(o->corner + 3 * i, 3) * scale;
        if (!(m > 1e-20 && m < 1e20)) return 0;
    }
    return 1;
}

/* The solid angle from corner 0; where an edge passes next to the point opposite to it, from the pole of the outline,
   or the best of directions all over the sphere: the curve passes next to few of these. The number of a triangle
   amplifies rounding by the inverse of its modulus. Returns the smallest modulus: it is small from everywhere where
   corners are almost antipodal. */
static double surfmink__solid_angle(const surfmink_outline *o, double *solid_angle)
{
    static const double direction[14][3] = {{1, .1, .2},   {-1, -.2, .1}, {.2, 1, -.1},  {-.1, -1, -.2}, {.1, -.2, 1},
                                            {-.2, .1, -1}, {1, .9, .8},   {-1, .8, .9},  {.9, -1, .8},   {.8, .9, -1},
                                            {-.9, -1, .8}, {-1, .9, -.8}, {.8, -.9, -1}, {-.8, -1, -.9}};
    double scale = surfmink__ray_scale(o), size, angle, best = 0;
    surfmink__fan fan;
    size_t i, k;
    if (!surfmink__alike(o, scale)) scale = 0;
    for (i = 0; i < 16 && best < 0.25; ++i) {
        if (i == 1) surfmink__vector_area(o, scale, fan.a);
        size = i > 0 && scale > 0 ? 1 / surfmink__binade(surfmink__max_abs(o->corner, 3) * scale) : 1;
        for (k = 0; k < 3 && i > 0; ++k) fan.a[k] = size * (i > 1 ? direction[i - 2][k] : fan.a[k]);
        for (k = 0; k < 3 && i == 0; ++k) fan.a[k] = o->corner[k] * scale;
        if (i == 0 && !(scale > 0)) surfmink__sphere_point(o, 0, fan.a);
        fan.norm = surfmink__norm(fan.a, 3);
        fan.worst = 16;
        if (!(fan.norm > 0)) continue;
        angle =
            i == 0 ? surfmink__fan_angle(&fan, o, scale, 1, o->n - 1) : surfmink__fan_angle(&fan, o, scale, 0, o->n);
        if (fan.worst <= best) continue;
        best = fan.worst;
        *solid_angle = angle;
    }
    return SURFMINK_SQRT(best);
}

/* x modulo 4 pi, in (-2 pi, 2 pi]. */
static double surfmink__modulo(double x)
{
    x -= 2 * surfmink__two_pi * surfmink__round(x / (2 * surfmink__two_pi));
    return x > -surfmink__two_pi ? x : x + 2 * surfmink__two_pi;
}

/* Sum of the unit normals at the corners. */
static void surfmink__mean_normal(const surfmink_outline *o, double mean[3])
{
    double n[3];
    size_t i, k;
    mean[0] = mean[1] = mean[2] = 0;
    for (i = 0; i < o->n; ++i) {
        surfmink__unit(o->normal + 3 * i, 3, n);
        for (k = 0; k < 3; ++k) mean[k] += n[k];
    }
}

/* The area of a surface in space between geodesic edges. Its vector area is that of the chords and of the segments
   between chords and geodesics: l a / 12 of an edge along which the normal turns by a = dn . e, in the plane of e and
   n. The part of the vector area along its own direction N is the area times the mean of n . N = 1 - |n - N|^2 / 2.
   Inside, n - N is linear in the place to first order, and so the mean of its square over a triangle (centre, x, y)
   is a sixth of |a|^2 + a.b + |b|^2 = 5 + n.m - 3 (n + m).N, where a = n - N and b = m - N at x and y; the triangles
   are weighted by their area. */
static double surfmink__area_embedded(const surfmink_outline *o)
{
    double scale = 0, direction[3], centre[3] = {0, 0, 0}, n[3], m[3], to_x[3], e[3], cross[3];
    double area, weight, weights = 0, squares = 0, slopes = 0, segments = 0, towards = 0, n_up, m_up, turn, bend;
    size_t i, k, next;
    for (i = 1; i < o->n; ++i) {
        surfmink__sub(o->corner + 3 * i, o->corner, 3, e);
        turn = surfmink__max_abs(e, 3);
        scale = turn > scale ? turn : scale;
        for (k = 0; k < 3; ++k) centre[k] += e[k] / (double)o->n;
    }
    scale = surfmink__scale(scale);
    for (k = 0; k < 3; ++k) centre[k] *= scale;
    area = surfmink__vector_area(o, scale, direction);
    surfmink__unit(o->normal, 3, n);
    n_up = surfmink__dot(n, direction);
    for (i = 0; i < o->n; ++i) {
        next = surfmink__next(o, i);
        surfmink__unit(o->normal + 3 * next, 3, m);
        for (k = 0; k < 3; ++k) {
            to_x[k] = (o->corner[3 * i + k] - o->corner[k]) * scale - centre[k];
            e[k] = (o->corner[3 * next + k] - o->corner[3 * i + k]) * scale;
        }
        m_up = surfmink__dot(m, direction);
        towards += m_up;
        turn = surfmink__dot(m, e) - surfmink__dot(n, e); /* a l */
        surfmink__cross(to_x, e, cross);
        weight = surfmink__dot(cross, direction);
        weights += weight;
        bend = surfmink__dot(n, m);
        squares += weight * (5 + bend);
        slopes += weight * 3 * (n_up + m_up);
        for (k = 0; k < 3; ++k) n[k] += m[k];
        /* l a / 12 of the co-normal e x (n + m), for a circle with its series in the square of sin(angle(n, m) / 2) */
        surfmink__cross(e, n, cross);
        bend = 0.5 - 0.5 * bend;
        segments -= turn / 24 * (1 + bend * (0.8 + 0.685 * bend)) * surfmink__dot(cross, direction);
        for (k = 0; k < 3; ++k) n[k] = m[k];
        n_up = m_up;
    }
    if (towards < 0) { /* N points against the normals */
        area = -area;
        slopes = -slopes;
        segments = -segments;
    }
    squares = weights > 0 || weights < 0 ? (squares - slopes) / 6 / weights : 0;
    area += segments;
    if (squares < 1.98) area /= 1 - squares / 2; /* else the normals are all over the place: the projected area */
    return area / scale / scale;
}

static double surfmink__area(const surfmink_outline *o)
{
    double angle = 0, scale;
    if (o->kind == SURFMINK_PLANE) {
        angle = surfmink__area_plane(o, &scale);
        return angle / scale / scale;
    }
    if (o->kind == SURFMINK_EMBEDDED) return surfmink__area_embedded(o);
    surfmink__solid_angle(o, &angle);
    return surfmink__modulo(angle) * o->radius * o->radius;
}

SURFMINK_DEF int surfmink_area(const surfmink_outline *outline, double *area)
{
    surfmink__polygon polygon;
    surfmink__block block;
    size_t i;
    double sum;
    int status = surfmink__polygon_of(outline, &polygon, &block, NULL);
    for (i = 0; i < outline->n && status == SURFMINK_OK; i += SURFMINK__BLOCK)
        status = surfmink__load(&polygon, i, &block, NULL);
    if (status != SURFMINK_OK) return status;
    if (outline->kind == SURFMINK_SURFACE) return SURFMINK_BAD_ARGUMENT;
    sum = surfmink__area(outline);
    if (!surfmink__finite(&sum, 1)) return SURFMINK_NOT_FINITE;
    *area = sum;
    return SURFMINK_OK;
}

/* The longest L: |g_p| <= L, but may come out an ulp above it. */
static const double surfmink__room = 1.7976e308;

/* L, S and, for the condition number and the noise, sum |alpha|. */
typedef struct surfmink__sums {
    double length, turning, turned;
} surfmink__sums;

static int surfmink__sum_edges(const surfmink__polygon *p, surfmink__sums *sums, size_t *bad)
{
    surfmink__dd length = {0, 0}, turning = {0, 0}, turned = {0, 0};
    surfmink__block b;
    size_t first, i;
    int status;
    for (first = 0; first < p->n; first += b.count) {
        if ((status = surfmink__load(p, first, &b, bad)) != SURFMINK_OK) return status;
        for (i = 0; i < b.count; ++i) {
            surfmink__add(&length, b.length[i]);
            surfmink__add(&turning, b.turning[i]);
            surfmink__add(&turned, surfmink__abs(b.turning[i]));
        }
    }
    sums->length = surfmink__value(&length);
    sums->turning = surfmink__value(&turning);
    sums->turned = surfmink__value(&turned);
    return SURFMINK_OK;
}

/* Is S > 0, and more than rounding noise? Corners on a great circle turn by 1e-16 each: hence the second threshold. */
static int surfmink__check_turning(double turning, double turned, size_t n)
{
    double noise = 1e-12 * turned, least = 4 * surfmink__eps * (double)n;
    if (least > noise) noise = least;
    if (turning < -noise) return SURFMINK_CLOCKWISE;
    return turning > noise ? SURFMINK_OK : SURFMINK_TOO_MUCH_CURVATURE;
}

/* How far below 0 an area may come out by rounding, over the square of L: a double line that goes there and back has an
   area of 0, S = 2 pi and mu_2 = 1, as the thinnest rectangle. */
static const double surfmink__flat = 1e-15;

/* The plane encloses no curvature: S is a multiple of 2 pi whatever was drawn. */
static int surfmink__check_plane(const surfmink_outline *o, surfmink_functionals *w)
{
    double scale, area = surfmink__area_plane(o, &scale),
                  flat = surfmink__flat * (w->length * scale) * (w->length * scale);
    if (w->turning < -surfmink__pi && w->turning > -3 * surfmink__pi && area < flat) return SURFMINK_CLOCKWISE;
    if (!(w->turning > surfmink__pi && w->turning < 3 * surfmink__pi && area > -flat)) return SURFMINK_CROSSES_ITSELF;
    w->area = area / scale / scale;
    w->turning = surfmink__two_pi; /* which the sum of n turns misses by rounding */
    w->curvature = 0;
    return SURFMINK_OK;
}

/* On the sphere S + solid angle is an odd multiple of 2 pi for all outlines that can be drawn without crossings; and
   what is enclosed, 2 pi - S, lies between 0 and 2 pi if they are drawn right, and below 4 pi if they are clockwise.
   The solid angle is known modulo 4 pi, and has more digits than S unless corners are almost antipodal. */
static int surfmink__check_sphere(const surfmink_outline *o, double turned, surfmink_functionals *w)
{
    const double l = w->length / o->radius, flat = surfmink__flat * l * l;
    double solid_angle = 0, windings, beyond, modulus = surfmink__solid_angle(o, &solid_angle);
    int status = surfmink__check_turning(w->turning, turned, o->n);
    windings = surfmink__round((w->turning + solid_angle) / surfmink__two_pi);
    if (!(surfmink__abs(0.5 * windings - surfmink__round(0.5 * windings)) > 0.25)) return SURFMINK_CROSSES_ITSELF;
    if (status == SURFMINK_CLOCKWISE) {
        beyond = modulus > 0.3 ? solid_angle - (1 + windings) * surfmink__two_pi : -surfmink__two_pi - w->turning;
        return beyond < flat ? SURFMINK_CLOCKWISE : SURFMINK_CROSSES_ITSELF;
    }
    if (modulus > 0.3) {
        w->curvature = solid_angle; /* to which 0 is not added: -ffast-math would make something of it */
        if (!(windings > 0.5 && windings < 1.5)) w->curvature += (1 - windings) * surfmink__two_pi;
    }
    if (!(w->curvature > -flat)) return SURFMINK_CROSSES_ITSELF;
    if (status != SURFMINK_OK) return status;
    w->turning = surfmink__two_pi - w->curvature;
    w->area = w->curvature * o->radius * o->radius;
    return SURFMINK_OK;
}

/* By how much S + W differs from 2 pi, or from -2 pi if S < 0, where W is the solid angle of the normals. It is the sum
   of the triangles that neighbours make with the mean normal, if all normals are within 90 degrees of that; else it is
   known modulo 4 pi, and a curve that winds three times may be taken for one on a saddle. */
static double surfmink__gauss_bonnet(const surfmink_outline *o, double turning, const double mean[3])
{
    surfmink_outline image = surfmink_sphere(o->normal, o->n, 1);
    double n[3], a[3], b[3], cross[3], sum = turning - surfmink__two_pi, angle = 0;
    size_t i;
    surfmink__solid_angle(&image, &angle);
    angle = surfmink__modulo(sum + angle);
    if (!(surfmink__max_abs(mean, 3) > 0)) return angle;
    surfmink__unit(mean, 3, n);
    if (turning < 0) sum += 2 * surfmink__two_pi;
    for (i = 0; i < o->n; ++i) {
        surfmink__unit(o->normal + 3 * i, 3, a);
        surfmink__unit(o->normal + 3 * surfmink__next(o, i), 3, b);
        if (!(surfmink__dot(n, a) > 0)) return angle;
        surfmink__cross(a, b, cross);
        sum += 2 * surfmink__atan2(surfmink__dot(n, cross),
                                   1 + surfmink__dot(n, a) + surfmink__dot(n, b) + surfmink__dot(a, b));
    }
    return sum;
}

/* S + W = 2 pi holds up to discretisation, which amounts to 0.007 for cells of tissues: nothing has to be looked at for
   S in [pi, 3 pi], as all ordinary cells have it. */
static int surfmink__check_embedded(const surfmink_outline *o, double turned, surfmink_functionals *w)
{
    double direction[3], mean[3], scale;
    int status = surfmink__check_turning(w->turning, turned, o->n), inwards;
    if (w->turning < surfmink__pi || w->turning > 3 * surfmink__pi) {
        surfmink__mean_normal(o, mean);
        if (!(surfmink__abs(surfmink__gauss_bonnet(o, w->turning, mean)) < surfmink__pi))
            return SURFMINK_CROSSES_ITSELF;
        if (status == SURFMINK_TOO_MUCH_CURVATURE) return status;
        scale = surfmink__scale(w->length);
        surfmink__vector_area(o, scale, direction);
        inwards = surfmink__dot(direction, mean) < 0;
        if (inwards != (status == SURFMINK_CLOCKWISE)) return SURFMINK_CROSSES_ITSELF;
    }
    return status;
}

/* The Minkowski functionals, or what is wrong with the outline as a whole. *sum is that of the rounded turns, by which
   phases go, for that closes. The area of embedded outlines, which nothing depends on, is left out unless asked for, or
   so large that it might overflow. */
static int surfmink__functionals(const surfmink__polygon *p, int with_area, surfmink_functionals *w, double *sum,
                                 size_t *bad)
{
    surfmink__sums sums;
    int status = surfmink__sum_edges(p, &sums, bad);
    if (status != SURFMINK_OK) return status;
    if (!(sums.length <= surfmink__room)) return surfmink__blame(SURFMINK_NOT_FINITE, p->n, bad);
    if (!(sums.length > 0)) return surfmink__blame(SURFMINK_BAD_ARGUMENT, p->n, bad);
    *sum = w->turning = sums.turning;
    w->length = sums.length;
    w->area = 0;
    w->curvature = surfmink__two_pi - w->turning;
    if (!p->outline || p->outline->kind == SURFMINK_SURFACE)
        status = surfmink__check_turning(w->turning, sums.turned, p->n);
    else if (p->outline->kind == SURFMINK_PLANE)
        status = surfmink__check_plane(p->outline, w);
    else if (p->outline->kind == SURFMINK_SPHERE)
        status = surfmink__check_sphere(p->outline, sums.turned, w);
    else
        status = surfmink__check_embedded(p->outline, sums.turned, w);
    if (status != SURFMINK_OK) return surfmink__blame(status, p->n, bad);
    if (p->outline && p->outline->kind == SURFMINK_EMBEDDED && (with_area || sums.length > 1e150))
        w->area = surfmink__area_embedded(p->outline);
    w->condition = sums.turned > w->turning ? sums.turned / w->turning : 1; /* rounding may take it below */
    return surfmink__finite(&w->area, 1) ? SURFMINK_OK : surfmink__blame(SURFMINK_NOT_FINITE, p->n, bad);
}

/* Measured edges from the caller. */
static int surfmink__check_edges(const double *length, const double *turning, size_t n)
{
    size_t i;
    if (n < 3) return SURFMINK_TOO_FEW_CORNERS;
    if (!surfmink__finite(length, n) || !surfmink__finite(turning, n)) return SURFMINK_NOT_FINITE;
    for (i = 0; i < n; ++i)
        if (length[i] < 0) return SURFMINK_BAD_ARGUMENT;
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_total(const surfmink_outline *outline, const double *length, const double *turning, size_t n,
                                surfmink_functionals *w)
{
    surfmink__polygon p;
    surfmink_functionals total;
    double sum;
    int status = surfmink__check_edges(length, turning, n);
    if (status == SURFMINK_OK && outline)
        status = outline->n == n ? surfmink__check_view(outline, NULL) : SURFMINK_BAD_ARGUMENT;
    if (status != SURFMINK_OK) return status;
    p.outline = outline;
    p.length = length;
    p.turning = turning;
    p.n = n;
    status = surfmink__functionals(&p, 1, &total, &sum, NULL);
    if (status == SURFMINK_OK) *w = total;
    return status;
}

/* --- 2. transport ------------------------------------------------------------------------------------------------- */

/* What a transport multiplies the turn with: f, phi or eta = f - phi (paper 2.3). */
static int surfmink__factor(const double *turning, size_t n, int transport, double *factor)
{
    surfmink__polygon p;
    surfmink__sums sums;
    int status;
    if (n < 3) return SURFMINK_TOO_FEW_CORNERS;
    if (!surfmink__finite(turning, n)) return SURFMINK_NOT_FINITE;
    if (transport != SURFMINK_CORRECTED && transport != SURFMINK_PARALLEL && transport != SURFMINK_DEFECT)
        return SURFMINK_BAD_ARGUMENT;
    p.outline = NULL;
    p.length = p.turning = turning;
    p.n = n;
    surfmink__sum_edges(&p, &sums, NULL);
    if (!surfmink__finite(&sums.turned, 1)) return SURFMINK_NOT_FINITE;
    *factor = 1;
    if (transport == SURFMINK_PARALLEL) return SURFMINK_OK;
    status = surfmink__check_turning(sums.turning, sums.turned, n);
    if (status != SURFMINK_OK) return status;
    *factor = transport == SURFMINK_CORRECTED ? surfmink__two_pi / sums.turning
                                              : (surfmink__two_pi - sums.turning) / sums.turning;
    return SURFMINK_OK;
}

/* Phases of edges first, first + 1, ... `turned` carries the sum of the turns from call to call; that before edge 0
   does not count. */
static void surfmink__add_turns(const double *turning, size_t count, double factor, surfmink__dd *turned, size_t first,
                                double *phase)
{
    size_t i;
    for (i = 0; i < count; ++i) {
        if (first + i > 0) surfmink__add(turned, turning[i]); /* read before write: phase may be turning */
        phase[i] = factor * surfmink__value(turned);
    }
}

SURFMINK_DEF int surfmink_phases(const double *turning, size_t n, int transport, double *phase)
{
    surfmink__dd turned = {0, 0};
    double factor;
    int status = surfmink__factor(turning, n, transport, &factor);
    if (status == SURFMINK_OK) surfmink__add_turns(turning, n, factor, &turned, 0, phase);
    return status;
}

SURFMINK_DEF int surfmink_transport_angle(const double *turning, size_t n, size_t from, ptrdiff_t steps, int transport,
                                          double angle, double *carried)
{
    surfmink__dd turned = {0, 0};
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
    angle -= factor * surfmink__value(&turned);
    if (!surfmink__finite(&angle, 1)) return SURFMINK_NOT_FINITE;
    *carried = angle;
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_transport_vector(const surfmink_outline *outline, const double *turning, size_t from,
                                           ptrdiff_t steps, int transport, double *vector)
{
    double start[9], end[9], angle, along_nu = 0, along_tau = 0, cosine, sine;
    size_t to, k, n = outline->n, dim = outline->kind == SURFMINK_PLANE ? 2 : 3;
    ptrdiff_t left;
    int status = surfmink_transport_angle(turning, n, from, steps, transport, 0, &angle);
    if (status != SURFMINK_OK) return status;
    left = steps % (ptrdiff_t)n;
    to = left >= 0 ? from + (size_t)left : from + n - (size_t)-left;
    to = to < n ? to : to - n;
    if ((status = surfmink_frame(outline, from, start)) != SURFMINK_OK) return status;
    if ((status = surfmink_frame(outline, to, end)) != SURFMINK_OK) return status;
    if (!surfmink__finite(vector, dim)) return SURFMINK_NOT_FINITE;
    for (k = 0; k < dim; ++k) {
        along_nu += vector[k] * start[k];
        along_tau += vector[k] * start[dim + k];
    }
    surfmink__cis(angle, &cosine, &sine);
    for (k = 0; k < dim; ++k)
        vector[k] =
            (cosine * along_nu - sine * along_tau) * end[k] + (sine * along_nu + cosine * along_tau) * end[dim + k];
    return SURFMINK_OK;
}

/* --- 3. integrate ------------------------------------------------------------------------------------------------- */

/* Powers w = l z^p of edges on end, lane by lane, and their sums. */
typedef struct surfmink__powers {
    double z[2][SURFMINK__QUAD], w[2][SURFMINK__QUAD];
} surfmink__powers;

/* w = l z^p, z = exp(i f), by repeated squaring. */
static void surfmink__power(const double length[SURFMINK__QUAD], const double phase[SURFMINK__QUAD], int p,
                            surfmink__powers *powers)
{
    double v[2], w[2];
    size_t k;
    int left;
    for (k = 0; k < SURFMINK__QUAD; ++k) {
        surfmink__cis_lane(phase[k], powers->z[0] + k, powers->z[1] + k);
        powers->w[0][k] = length[k] * powers->z[0][k];
        powers->w[1][k] = length[k] * powers->z[1][k];
    }
    for (k = 0; k < SURFMINK__QUAD && p > 1; ++k) {
        v[0] = powers->z[0][k];
        v[1] = powers->z[1][k];
        w[0] = powers->w[0][k];
        w[1] = powers->w[1][k];
        for (left = p - 1; left > 0; left /= 2) {
            if (left % 2) surfmink__multiply(w, v[0], v[1]);
            surfmink__multiply(v, v[0], v[1]);
        }
        powers->w[0][k] = w[0];
        powers->w[1][k] = w[1];
    }
}

/* Adds l_i exp(i p f_i) times unit of at most SURFMINK__BLOCK edges to the sums of `ranks` ranks from `first` on.
   sum  2 ranks */
static void surfmink__add_ranks(const double *length, const double *phase, size_t count, double unit, int first,
                                int ranks, surfmink__dd *sum)
{
    surfmink__powers powers;
    double g[2 * SURFMINK__RANKS][SURFMINK__QUAD], l[SURFMINK__BLOCK], f[SURFMINK__BLOCK], swap;
    size_t i, k;
    int p;
    for (i = 0; i < count; ++i) {
        l[i] = length[i] * unit;
        f[i] = surfmink__reduced(phase[i]);
    }
    for (; i % SURFMINK__QUAD; ++i) l[i] = f[i] = 0;
    for (p = 0; p < 2 * ranks; ++p)
        for (k = 0; k < SURFMINK__QUAD; ++k) g[p][k] = 0;
    for (i = 0; i < count; i += SURFMINK__QUAD) {
        surfmink__power(l + i, f + i, first, &powers);
        for (p = 0; p < 2 * ranks; p += 2)
            for (k = 0; k < SURFMINK__QUAD; ++k) {
                g[p][k] += powers.w[0][k];
                g[p + 1][k] += powers.w[1][k];
                swap = powers.w[0][k] * powers.z[0][k] - powers.w[1][k] * powers.z[1][k];
                powers.w[1][k] = powers.w[0][k] * powers.z[1][k] + powers.w[1][k] * powers.z[0][k];
                powers.w[0][k] = swap;
            }
    }
    for (p = 0; p < 2 * ranks; ++p) surfmink__add(sum + p, (g[p][0] + g[p][1]) + (g[p][2] + g[p][3]));
}

/* arg g_p in (-pi, pi], at any magnitude. Adding 0 makes +0 of -0, or a negative real g_p might come out at -pi. */
static double surfmink__argument(const double g[2])
{
    double v[2];
    surfmink__shrink(g, 2, v);
    return surfmink__atan2(v[1] + 0.0, v[0]);
}

/* (scale |g_p|)^2 */
static double surfmink__square(const double g[2], double scale)
{
    return g[0] * scale * (g[0] * scale) + g[1] * scale * (g[1] * scale);
}

/* |g_p| / L, which rounding may take an eps or two above 1. */
static double surfmink__ratio(double square, double length)
{
    double mu = SURFMINK_SQRT(square) / length;
    return mu > 1 ? 1 : mu;
}

/* g_p, mu_p and arg(g_p) / p of the ranks from 0 on. Phases are given, or factor times the sum of the turns. Nothing
   is written of the 24 ranks at hand before all edges are known. */
static int surfmink__integrate(const surfmink__polygon *p, const double *phase, double factor, double length,
                               int max_rank, double *mu, double *g, double *theta)
{
    surfmink__dd sum[2 * SURFMINK__RANKS], turned;
    surfmink__block b;
    double phases[SURFMINK__BLOCK], unit = surfmink__scale(length), back = 1 / unit, v[2];
    size_t start;
    int first, ranks, k, status;
    for (first = 1; first <= max_rank; first += ranks) {
        ranks = max_rank - first < SURFMINK__RANKS ? max_rank - first + 1 : SURFMINK__RANKS;
        for (k = 0; k < 2 * ranks; ++k) sum[k].high = sum[k].low = 0;
        turned.high = turned.low = 0;
        for (start = 0; start < p->n; start += b.count) {
            if ((status = surfmink__load(p, start, &b, NULL)) != SURFMINK_OK) return status;
            if (!phase) surfmink__add_turns(b.turning, b.count, factor, &turned, start, phases);
            surfmink__add_ranks(b.length, phase ? phase + start : phases, b.count, unit, first, ranks, sum);
        }
        for (k = 0; k < ranks; ++k) {
            v[0] = surfmink__value(sum + 2 * (size_t)k);
            v[1] = surfmink__value(sum + 2 * (size_t)k + 1);
            if (g) {
                g[2 * (size_t)(first + k)] = v[0] * back;
                g[2 * (size_t)(first + k) + 1] = v[1] * back;
            }
            if (mu) mu[first + k] = surfmink__ratio(surfmink__square(v, 1), length * unit);
            if (theta) theta[first + k] = surfmink__argument(v) / (first + k);
        }
    }
    if (mu) mu[0] = 1;
    if (theta) theta[0] = 0;
    if (!g) return SURFMINK_OK;
    g[0] = length;
    g[1] = 0;
    return SURFMINK_OK;
}

/* Measured edges from the caller, checked, and their sum. */
static int surfmink__polygon_from(const double *length, const double *turning, size_t n, int max_rank,
                                  surfmink__polygon *p, double *total)
{
    surfmink__dd sum = {0, 0};
    size_t i;
    int status = max_rank >= 0 ? surfmink__check_edges(length, turning, n) : SURFMINK_BAD_ARGUMENT;
    p->outline = NULL;
    p->length = length;
    p->turning = turning;
    p->n = n;
    if (status != SURFMINK_OK) return status;
    for (i = 0; i < n; ++i) surfmink__add(&sum, length[i]);
    *total = surfmink__value(&sum);
    return *total <= surfmink__room ? SURFMINK_OK : SURFMINK_NOT_FINITE;
}

SURFMINK_DEF int surfmink_irreducible(const double *length, const double *phase, size_t n, int max_rank, double *g)
{
    surfmink__polygon p;
    double total;
    int status = surfmink__polygon_from(length, phase, n, max_rank, &p, &total);
    return status == SURFMINK_OK ? surfmink__integrate(&p, phase, 0, total, max_rank, NULL, g, NULL) : status;
}

/* The edges from the fiducial point on: the rear part of its edge, all others, and its front part, one turn later. */
SURFMINK_DEF int surfmink_irreducible_parallel(const double *length, const double *turning, size_t n, size_t edge,
                                               double fraction, int max_rank, double *g)
{
    surfmink__polygon p;
    surfmink__dd sum[2 * SURFMINK__RANKS], turned;
    double total, unit, factor, part[SURFMINK__BLOCK], phase[SURFMINK__BLOCK];
    size_t i, at, count;
    int first, ranks, k, status = surfmink__polygon_from(length, turning, n, max_rank, &p, &total);
    if (status != SURFMINK_OK) return status;
    if (edge >= n || !(fraction >= 0 && fraction < 1)) return SURFMINK_BAD_ARGUMENT;
    /* 1, or turns whose sum overflows */
    if ((status = surfmink__factor(turning, n, SURFMINK_PARALLEL, &factor)) != SURFMINK_OK) return status;
    unit = surfmink__scale(total);
    for (first = 1; first <= max_rank; first += ranks) {
        ranks = max_rank - first < SURFMINK__RANKS ? max_rank - first + 1 : SURFMINK__RANKS;
        for (k = 0; k < 2 * ranks; ++k) sum[k].high = sum[k].low = 0;
        turned.high = turned.low = 0;
        for (i = count = 0; i <= n; ++i) { /* edges passed since the fiducial point */
            at = edge + i < n ? edge + i : edge + i - n;
            if (i > 0) surfmink__add(&turned, turning[at]);
            part[count] = length[at] * (i == 0 ? 1 - fraction : i == n ? fraction : 1);
            phase[count++] = surfmink__value(&turned);
            if (count < SURFMINK__BLOCK && i < n) continue;
            surfmink__add_ranks(part, phase, count, unit, first, ranks, sum);
            count = 0;
        }
        for (k = 0; k < 2 * ranks; ++k) g[2 * (size_t)first + (size_t)k] = surfmink__value(sum + k) / unit;
    }
    g[0] = total;
    g[1] = 0;
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
    surfmink__dd sum[2] = {{0, 0}, {0, 0}};
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
    double scale, length;
    const double *at;
    int p;
    if (max_rank < 0) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(g, 2 * ((size_t)max_rank + 1))) return SURFMINK_NOT_FINITE;
    if (!(g[0] > 0)) return SURFMINK_BAD_ARGUMENT;
    scale = surfmink__scale(g[0]);
    length = g[0] * scale;
    for (p = 0; p <= max_rank; ++p)
        if (!(surfmink__square(g + 2 * (size_t)p, scale) <= 4 * length * length)) return SURFMINK_NOT_FINITE;
    for (p = 0; p <= max_rank; ++p) {
        at = g + 2 * (size_t)p;
        if (lambda) lambda[p] = surfmink__norm(at, 2);
        if (mu) mu[p] = surfmink__ratio(surfmink__square(at, scale), length);
        if (theta) theta[p] = p > 0 ? surfmink__argument(at) / p : 0;
    }
    return SURFMINK_OK;
}

static double surfmink__theta(const double *g, int p, int sign, int n)
{
    double half_turns = sign >= 0 ? 2.0 * n : 2.0 * n + 1;
    return (surfmink__argument(g + 2 * (size_t)p) + half_turns * surfmink__pi) / p;
}

SURFMINK_DEF int surfmink_angles(const double *g, int p, int sign, double *theta)
{
    int n;
    if (p < 1) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(g + 2 * (size_t)p, 2)) return SURFMINK_NOT_FINITE;
    for (n = 0; n < p; ++n) theta[n] = surfmink__theta(g, p, sign, n);
    return SURFMINK_OK;
}

/* Middle of a chord between corners that have passed the checks, with the normals at both ends. */
static int surfmink__chord_frame(const surfmink_outline *o, size_t edge, double frame[9])
{
    double along[3], tau[3], a[3], b[3], mean[3], part;
    size_t k, next = surfmink__next(o, edge);
    surfmink__sub(o->corner + 3 * next, o->corner + 3 * edge, 3, along);
    surfmink__unit(along, 3, tau);
    surfmink__unit(o->normal + 3 * edge, 3, a);
    surfmink__unit(o->normal + 3 * next, 3, b);
    for (k = 0; k < 3; ++k) mean[k] = a[k] + b[k];
    part = surfmink__dot(mean, tau);
    for (k = 0; k < 3; ++k) mean[k] -= part * tau[k];
    if (!(surfmink__max_abs(mean, 3) > 1e-6)) return SURFMINK_ZERO_NORMAL; /* both normals run along the edge */
    surfmink__unit(mean, 3, frame + 6);
    for (k = 0; k < 3; ++k) frame[3 + k] = tau[k];
    surfmink__cross(frame + 3, frame + 6, frame); /* nu = tau x normal */
    return SURFMINK_OK;
}

/* Middle of a great-circle arc. The co-normal is the pole of the circle. The normal is the mean of those at the ends;
   where these are more than 90 degrees apart their difference, along the tangent, has more digits. */
static void surfmink__arc_frame(const surfmink_outline *o, size_t i, double frame[9])
{
    double x[3], y[3], a[3], b[3], pole[3], mean[3];
    surfmink__dd n[3], left[3];
    int wide;
    size_t k;
    surfmink__sphere_point(o, i, x);
    surfmink__sphere_point(o, surfmink__next(o, i), y);
    surfmink__axis(o, i, n);
    surfmink__leftward(n, x, y, left);
    surfmink__unit(x, 3, a);
    surfmink__unit(y, 3, b);
    wide = surfmink__dot(a, b) < 0;
    for (k = 0; k < 3; ++k) {
        pole[k] = -left[k].high;
        mean[k] = wide ? b[k] - a[k] : b[k] + a[k];
    }
    surfmink__unit(pole, 3, frame);
    surfmink__unit(mean, 3, wide ? frame + 3 : frame + 6);
    if (wide)
        surfmink__cross(frame, frame + 3, frame + 6);
    else
        surfmink__cross(frame + 6, frame, frame + 3);
}

SURFMINK_DEF int surfmink_frame(const surfmink_outline *outline, size_t edge, double *frame)
{
    double along[2];
    size_t next;
    int status = surfmink__check_view(outline, NULL);
    if (status != SURFMINK_OK) return status;
    if (edge >= outline->n || outline->kind == SURFMINK_SURFACE) return SURFMINK_BAD_ARGUMENT;
    next = surfmink__next(outline, edge);
    if ((status = surfmink__check_corner(outline, edge)) != SURFMINK_OK) return status;
    if ((status = surfmink__check_corner(outline, next)) != SURFMINK_OK) return status;
    if ((status = surfmink__check_edge(outline, edge)) != SURFMINK_OK) return status;
    if (outline->kind == SURFMINK_EMBEDDED) return surfmink__chord_frame(outline, edge, frame);
    if (outline->kind == SURFMINK_SPHERE) {
        surfmink__arc_frame(outline, edge, frame);
        return SURFMINK_OK;
    }
    surfmink__sub(outline->corner + 2 * next, outline->corner + 2 * edge, 2, along);
    surfmink__unit(along, 2, frame + 2);
    frame[0] = frame[3]; /* nu is tau turned to the right, out of a counter-clockwise polygon */
    frame[1] = -frame[2];
    return SURFMINK_OK;
}

SURFMINK_DEF int surfmink_eigenvectors(const double *g, int p, int sign, double phase, const double *frame, int dim,
                                       double *vector)
{
    double cosine, sine;
    int n, k;
    if (p < 1 || dim < 2 || dim > 3) return SURFMINK_BAD_ARGUMENT;
    if (!surfmink__finite(g + 2 * (size_t)p, 2) || !surfmink__finite(&phase, 1) ||
        !surfmink__finite(frame, 2 * (size_t)dim))
        return SURFMINK_NOT_FINITE;
    for (n = 0; n < p; ++n) {
        surfmink__cis(surfmink__theta(g, p, sign, n) - phase, &cosine, &sine);
        for (k = 0; k < dim; ++k) vector[n * dim + k] = cosine * frame[k] + sine * frame[dim + k];
    }
    return SURFMINK_OK;
}

/* --- one call for all four steps ---------------------------------------------------------------------------------- */

static int surfmink__measure(const surfmink_outline *o, int max_rank, double *mu, double *g, double *theta,
                             int with_area, surfmink_functionals *w, size_t *bad)
{
    surfmink__polygon polygon;
    surfmink__block kept;
    surfmink_functionals total;
    double sum;
    int status = max_rank < 0 ? surfmink__blame(SURFMINK_BAD_ARGUMENT, o->n, bad)
                              : surfmink__polygon_of(o, &polygon, &kept, bad);
    if (status != SURFMINK_OK) return status;
    if ((status = surfmink__functionals(&polygon, with_area, &total, &sum, bad)) != SURFMINK_OK) return status;
    if (mu || g || theta)
        status = surfmink__integrate(&polygon, NULL, surfmink__two_pi / sum, total.length, max_rank, mu, g, theta);
    if (w && status == SURFMINK_OK) *w = total;
    return status;
}

SURFMINK_DEF int surfmink_measure(const surfmink_outline *outline, int max_rank, double *mu, double *g,
                                  surfmink_functionals *w, size_t *bad)
{
    return surfmink__measure(outline, max_rank, mu, g, NULL, w != NULL, w, bad);
}
/* --- the sphere as a surface -------------------------------------------------------------------------------------- */

SURFMINK_DEF int surfmink_sphere_log(const double x[3], const double y[3], double radius, double vector[3])
{
    surfmink_outline o;
    surfmink__dd n[3], left[3];
    double pair[6], a[3], b[3], m[3], axis[3], direction[3], tangent[3], angle;
    size_t k;
    int status;
    for (k = 0; k < 3; ++k) {
        pair[k] = x[k];
        pair[3 + k] = y[k];
    }
    if (!surfmink__positive(radius)) return SURFMINK_BAD_ARGUMENT;
    o = surfmink_sphere(pair, 2, radius);
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
    surfmink__leftward(n, a, b, left);
    for (k = 0; k < 3; ++k) {
        axis[k] = n[k].high;
        m[k] = left[k].high;
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
    surfmink__cis(turn, &cosine, &sine);
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

SURFMINK_DEF surfmink_surface surfmink_sphere_surface(double *radius)
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
    surfmink__cis(rest, cosine, sine);
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

/* Within a distance, in ordinary units. NaN is near nothing: it is to be refused, not to be dropped. */
static int surfmink__near(const double *a, const double *b, size_t stride, double distance)
{
    double largest = 0, square = 0, scale;
    size_t k;
    for (k = 0; k < stride; ++k) {
        if (!(surfmink__abs(a[k] - b[k]) <= distance)) return 0;
        if (surfmink__abs(a[k] - b[k]) > largest) largest = surfmink__abs(a[k] - b[k]);
    }
    scale = largest > 0 ? surfmink__scale(largest) : 1;
    for (k = 0; k < stride; ++k) square += (a[k] - b[k]) * scale * ((a[k] - b[k]) * scale);
    return SURFMINK_SQRT(square) <= distance * scale;
}

SURFMINK_DEF size_t surfmink_merge(double *corner, double *normal, size_t n, size_t stride, double distance)
{
    size_t i, k, kept = 0;
    for (i = 0; i < n; ++i) {
        if (kept > 0 && surfmink__near(corner + i * stride, corner + (kept - 1) * stride, stride, distance)) continue;
        for (k = 0; k < stride; ++k) corner[kept * stride + k] = corner[i * stride + k];
        if (normal)
            for (k = 0; k < 3; ++k) normal[3 * kept + k] = normal[3 * i + k];
        ++kept;
    }
    while (kept > 1 && surfmink__near(corner, corner + (kept - 1) * stride, stride, distance)) --kept;
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
            surfmink__cis(turn, direction, direction + 1);
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

/* --- many outlines ------------------------------------------------------------------------------------------------ */

/* What a batch is about. */
typedef struct surfmink__job {
    const surfmink_outline *all;
    const size_t *offset;
    const surfmink_results *out;
    double *scratch;
    double unit; /* of lengths: the radius of a sphere, else 1 */
    int max_rank;
} surfmink__job;

/* Outline i as surfmink_measure does it. Returns whether it is refused. */
static size_t surfmink__measure_one(const surfmink__job *job, size_t i)
{
    const surfmink_results *out = job->out;
    const size_t at = job->offset[i], end = job->offset[i + 1],
                 ranks = job->max_rank >= 0 ? (size_t)job->max_rank + 1 : 0;
    surfmink_outline o = *job->all;
    surfmink_functionals w;
    size_t bad = end >= at ? end - at : 0;
    int status = SURFMINK_BAD_ARGUMENT;
    o.n = bad;
    if (job->max_rank >= 0 && end >= at && end <= job->all->n) status = surfmink__check_view(&o, NULL);
    if (status == SURFMINK_OK) { /* else there may be no corner at all, nor a place for it */
        o.corner += surfmink__stride(&o) * at;
        if (o.kind == SURFMINK_EMBEDDED) o.normal += 3 * at;
        status = surfmink__measure(&o, job->max_rank, out->mu ? out->mu + i * ranks : NULL,
                                   out->g ? out->g + 2 * i * ranks : NULL, out->theta ? out->theta + i * ranks : NULL,
                                   out->area != NULL, &w, &bad);
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

/* --- many outlines, in vector instructions ------------------------------------------------------------------------ */

#ifdef __cplusplus
}
#endif
#ifdef SURFMINK__OPTIONS
#pragma GCC pop_options
#endif

/* Sets of vector instructions: which one the compiler has been told to use. */
#define SURFMINK__SSE2   1
#define SURFMINK__AVX2   2
#define SURFMINK__AVX512 3
#define SURFMINK__NEON   4
#if defined(_WIN32) && !defined(__clang__)
#define SURFMINK__NARROW /* gcc for Windows aligns the stack to 16 bytes only, whatever one asks for */
#endif
#if !defined(SURFMINK_NO_SIMD) && (defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 5)) && \
    defined(__STDC_HOSTED__) && __STDC_HOSTED__
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
#define SURFMINK__REST
#ifdef SURFMINK__NATIVE
#define SURFMINK__INSTANCE SURFMINK__NATIVE

/* Kernels are included again from the name below; text pasted into a .c file, at level 0, has none. */
#ifndef SURFMINK_FILE
#if defined(SURFMINK_DISPATCH) && defined(__INCLUDE_LEVEL__) && __INCLUDE_LEVEL__ == 0
#define SURFMINK__NO_NAME
#elif defined(__FILE_NAME__)
#define SURFMINK_FILE __FILE_NAME__
#else
#define SURFMINK_FILE "surfmink.h"
#endif
#endif
#if defined(SURFMINK_DISPATCH) && SURFMINK__NATIVE == SURFMINK__SSE2 && !defined(SURFMINK__NARROW) && \
    !defined(SURFMINK__NO_NAME)
#define SURFMINK__DISPATCHES
#endif
#if SURFMINK__NATIVE == SURFMINK__NEON
#include <arm_neon.h>
#else
#include <immintrin.h>
#endif

/* Rows of corners that a lane holds; rows of strips that are worked on at a time, so that they stay in the first-level
   cache; three times this many ranks are summed in one pass over them; outlines that are sorted together, at most. */
#define SURFMINK__ROWS   128
#define SURFMINK__STRIP  64
#define SURFMINK__TILES  8
#define SURFMINK__WINDOW 64

#define SURFMINK__VECTOR       static __inline__ __attribute__((always_inline))
#define SURFMINK__KERNEL       static __inline__ /* no warning about what an instance does not use */
#define SURFMINK__PREFETCH(at) __builtin_prefetch(at)
typedef double surfmink__pair __attribute__((vector_size(16), may_alias));

/* What is summed over the rows of an outline: l_i, alpha_i, area, |alpha_i|, and 1 for each row with a plain corner. */
enum { SURFMINK__LENGTH, SURFMINK__TURNING, SURFMINK__AREA, SURFMINK__TURNS, SURFMINK__GOOD, SURFMINK__SUMS };

/* The area of an outline: as the kernels know it, or that of an embedded one, which they do not. */
static double surfmink__area_of(const surfmink__job *job, size_t i, double area)
{
    surfmink_outline o = *job->all;
    if (o.kind != SURFMINK_EMBEDDED) return area;
    o.corner += 3 * job->offset[i];
    o.normal += 3 * job->offset[i];
    o.n = job->offset[i + 1] - job->offset[i];
    return surfmink__area_embedded(&o);
}
#endif /* SURFMINK__NATIVE */
#endif /* SURFMINK_IMPLEMENTATION */

/* Kernels: the formulas of the four steps for groups of outlines, a lane each, or for strips of a long one. They
   measure what the plain formulas measure and leave the rest to the scalar path. This part is compiled for every set
   of vector instructions in use: SURFMINK__(name) is the name of the instance at hand. A row holds one corner of each
   lane; stages pass over rows that stay in the first-level cache. */
#ifdef SURFMINK__INSTANCE

#define SURFMINK__LANES           ((size_t)8)
#define SURFMINK__ALIGNED         __attribute__((aligned(64)))
#define surfmink__real            SURFMINK__(real)
#define surfmink__mask            SURFMINK__(mask)
#define SURFMINK__SET(x)          ((x)-SURFMINK__(zero))
#define SURFMINK__LOAD(at)        (*(const SURFMINK__(loaded) *)(const void *)(at))
#define SURFMINK__STORE(at, x)    (*(SURFMINK__(loaded) *)(void *)(at) = (x))
#define SURFMINK__SIGN            ((surfmink__mask)SURFMINK__SET(-0.0))
#define SURFMINK__ABS(a)          ((surfmink__real)(~SURFMINK__SIGN & (surfmink__mask)(a)))
#define SURFMINK__LESS(a, b)      ((surfmink__mask)((a) < (b)))
#define SURFMINK__SELECT(m, a, b) ((surfmink__real)(((m) & (surfmink__mask)(a)) | (~(m) & (surfmink__mask)(b))))
#define SURFMINK__WHERE(m, a)     ((surfmink__real)((m) & (surfmink__mask)(a)))
/* -a where the mask is set; where s < 0; where k, an integer plus 1.5 * 2^52, is odd */
#define SURFMINK__NEGATE(m, a) ((surfmink__real)(((m)&SURFMINK__SIGN) ^ (surfmink__mask)(a)))
#define SURFMINK__SIGNED(a, s) SURFMINK__NEGATE((surfmink__mask)(s), a)
#define SURFMINK__ODD(a, k)    SURFMINK__NEGATE((surfmink__mask)(k) << 63, a)
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

typedef double surfmink__real __attribute__((vector_size(8 * SURFMINK__WIDTH)));
typedef double SURFMINK__(loaded) __attribute__((vector_size(8 * SURFMINK__WIDTH), may_alias));
typedef __INT64_TYPE__ surfmink__mask __attribute__((vector_size(8 * SURFMINK__WIDTH)));
static const surfmink__real SURFMINK__(zero) = {0};

/* What a group of lanes is measured in: 75 KiB for eight lanes, of which short outlines touch the first rows only.
   Coordinates x y (z), and normals, come in columns, in which row -1 holds the corner before the first. When all angles
   are known, columns 2 and 3 hold z_i = exp(i f_i), and length and turned the real and imaginary part of l_i z_i^p. */
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

/* Three ranks of each lane, a row each (g_p: two). */
typedef struct SURFMINK__ALIGNED SURFMINK__(ranks) {
    double g[6 * SURFMINK__LANES], mu[3 * SURFMINK__LANES], theta[3 * SURFMINK__LANES];
} SURFMINK__(ranks);

/* --- vectors ------------------------------------------------------------------------------------------------------ */

SURFMINK__VECTOR surfmink__real SURFMINK__(dot)(const surfmink__real a[3], const surfmink__real b[3])
{
    return SURFMINK__FMA(a[2], b[2], SURFMINK__FMA(a[1], b[1], a[0] * b[0]));
}

SURFMINK__VECTOR void SURFMINK__(cross)(const surfmink__real a[3], const surfmink__real b[3], surfmink__real c[3])
{
    c[0] = SURFMINK__FNMA(a[2], b[1], a[1] * b[2]);
    c[1] = SURFMINK__FNMA(a[0], b[2], a[2] * b[0]);
    c[2] = SURFMINK__FNMA(a[1], b[0], a[0] * b[1]);
}

/* Components and normals of one row. */
SURFMINK__VECTOR void SURFMINK__(load)(const double *at, surfmink__real v[3])
{
    v[0] = SURFMINK__LOAD(at);
    v[1] = SURFMINK__LOAD(at + SURFMINK__COLUMN);
    v[2] = SURFMINK__LOAD(at + 2 * SURFMINK__COLUMN);
}

SURFMINK__VECTOR void SURFMINK__(subtract)(const surfmink__real a[3], const surfmink__real b[3],
                                           surfmink__real difference[3])
{
    difference[0] = a[0] - b[0];
    difference[1] = a[1] - b[1];
    difference[2] = a[2] - b[2];
}

/* Adds a length to a sum of lengths that remembers what rounding took away. */
SURFMINK__VECTOR void SURFMINK__(add_length)(surfmink__real length, surfmink__real *sum, surfmink__real *lost)
{
    surfmink__real high = *sum + length;
    *lost = *lost + (length - (high - *sum));
    *sum = high;
}

/* a + b u + ..., even and odd powers apart: two chains of half the length. Coefficients here and below interpolate at
   Chebyshev's points; tests/accuracy/kernels.c computes and checks them. */
#define SURFMINK__2(a, b)        SURFMINK__FMA(u, SURFMINK__SET(b), SURFMINK__SET(a))
#define SURFMINK__3(a, b, c)     SURFMINK__FMA(uu, SURFMINK__SET(c), SURFMINK__2(a, b))
#define SURFMINK__UP(rest, a, b) SURFMINK__FMA(uu, rest, SURFMINK__2(a, b))

/* Angle of (x, y) in [-pi, pi], 0 of (0, 0), for magnitudes from 1e-150 to 1e150: a ratio within tan(pi / 8) of 0, then
   pi / 4, pi / 2 or pi from there. Multiples of 45 degrees are exact. Worst error in 1e7 angles: 4.7e-16, at y, x =
   0x1.ea6a22f06107p+0, -0x1.cfdbd8f7eede1p-1; relative 3.6e-16. */
SURFMINK__VECTOR surfmink__real SURFMINK__(atan2)(surfmink__real y, surfmink__real x)
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
SURFMINK__VECTOR void SURFMINK__(turns)(surfmink__real t, surfmink__real *re, surfmink__real *im)
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
SURFMINK__VECTOR surfmink__real SURFMINK__(arc_angle)(surfmink__real chord, surfmink__real u)
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
/* --- 1. measure: corners -> lengths, turning angles --------------------------------------------------------------- */

/* Sine and cosine, up to a common factor, of the turn from edge a to edge b in the plane orthogonal to n:
   n . (a x b) and a . b - (a . n)(b . n) for unit n. a x b is a x (b - a) or b x (b - a), whichever edge is shorter: at
   nearly straight corners that does not cancel. aa, bb, nn are the squares of the vectors, norm = |n|, bn = b . n. */
SURFMINK__VECTOR void SURFMINK__(turn)(const surfmink__real a[3], surfmink__real aa, const surfmink__real b[3],
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
   one of sine and cosine comes to if both edges are tangent; edges of length 0 turn nowhere. NaN is not
   less. */
SURFMINK__VECTOR surfmink__real SURFMINK__(plain)(surfmink__real larger, surfmink__real size, surfmink__real length)
{
    surfmink__mask good = SURFMINK__LESS(SURFMINK__FMA(SURFMINK__SET(0.35), size, SURFMINK__SET(1e-200)), larger);
    good = good & SURFMINK__LESS(SURFMINK__SET(1e-140), length);
    return SURFMINK__WHERE(good, SURFMINK__SET(1.0));
}

/* Straight edges between points of a surface in space. */
SURFMINK__KERNEL void SURFMINK__(edges_embedded)(SURFMINK__(rows) *r, size_t rows, SURFMINK__(totals) *t)
{
    surfmink__real x[3], a[3], b[3], n[3], last[3], aa, bb, nn, before, length, sine, cosine, larger, sum, lost, good,
        most;
    surfmink__mask same;
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
            SURFMINK__(load)(r->column[3] + i, last);
            SURFMINK__(load)(r->column[3] + i + SURFMINK__LANES, n);
            same = SURFMINK__LESS(SURFMINK__SET(0.0), SURFMINK__(dot)(last, n)); /* less than 90 degrees apart */
            nn = SURFMINK__(dot)(n, n);
            same = same & SURFMINK__LESS(SURFMINK__SET(1e-60), nn) & SURFMINK__LESS(nn, SURFMINK__SET(1e60));
            SURFMINK__(turn)(a, aa, b, bb, n, nn, SURFMINK__ROOT(nn), SURFMINK__(dot)(b, n), &sine, &cosine);
            SURFMINK__STORE(r->turned + i, sine);
            SURFMINK__STORE(r->cosine + i, cosine);
            larger = SURFMINK__MAX(SURFMINK__ABS(sine), SURFMINK__ABS(cosine));
            most = SURFMINK__MAX(most, larger);
            good = good + SURFMINK__WHERE(same, SURFMINK__(plain)(larger, nn * before * length, length));
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

/* w becomes w z. */
SURFMINK__VECTOR void SURFMINK__(multiply)(surfmink__real *re, surfmink__real *im, surfmink__real z_re,
                                           surfmink__real z_im)
{
    surfmink__real t = SURFMINK__FNMA(*im, z_im, *re * z_re);
    *im = SURFMINK__FMA(*im, z_re, *re * z_im);
    *re = t;
}

/* Angle at the centre of an arc from the square of its chord, up to 120 degrees: beyond 60 degrees twice that of half
   the arc. */
SURFMINK__VECTOR surfmink__real SURFMINK__(arc)(surfmink__real square)
{
    surfmink__mask wide = SURFMINK__LESS(SURFMINK__SET(1.0), square);
    surfmink__real half;
    size_t k;
    int any = 0;
    for (k = 0; k < SURFMINK__WIDTH; ++k) any |= wide[k] != 0;
    if (!any) return SURFMINK__(arc_angle)(SURFMINK__ROOT(square), square);
    half = SURFMINK__SET(2.0) - SURFMINK__ROOT(SURFMINK__MAX(SURFMINK__SET(4.0) - square, SURFMINK__SET(0.0)));
    half = SURFMINK__SELECT(wide, half, square);
    half = SURFMINK__(arc_angle)(SURFMINK__ROOT(half), half);
    return half + SURFMINK__WHERE(wide, half);
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
    surfmink__mask plain;
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
            length = SURFMINK__(arc)(square);
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
            plain = SURFMINK__LESS(SURFMINK__FMA(SURFMINK__SET(2.0), rise, SURFMINK__SET(1e-200)), bb * around);
            plain = plain & SURFMINK__LESS(square, SURFMINK__SET(2.9));
            plain = plain & SURFMINK__LESS(SURFMINK__SET(0.1225) * xx * xx * aa * bb, /* 0.35^2: see surfmink__steep */
                                           SURFMINK__FMA(sine, sine, cosine * cosine));
            plain = plain & SURFMINK__LESS(SURFMINK__SET(0.5) * norms, below);
            good = good + SURFMINK__WHERE(plain, SURFMINK__SET(1.0));
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
    surfmink__mask plain, passes, a_below, b_below;
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
            plain = SURFMINK__LESS(least, SURFMINK__ABS(cross));
            plain = plain & SURFMINK__LESS(SURFMINK__SET(1e-140), length);
            passes = passes & (b_below ^ SURFMINK__LESS(zero, cross));
            d[0] = x[0] - p[0];
            d[1] = x[1] - p[1];
            re = SURFMINK__FMA(b[1], u[1], b[0] * u[0]);
            im = SURFMINK__FNMA(b[0], u[1], b[1] * u[0]);
            inverse = one / SURFMINK__MAX(length, SURFMINK__SET(1e-300));
            SURFMINK__(add_length)(length, &sum, &lost);
            good = good + SURFMINK__WHERE(plain, one);
            turns = turns + SURFMINK__WHERE(passes, SURFMINK__SIGNED(one, cross));
            area = area + SURFMINK__FNMA(d[1], b[0], d[0] * b[1]);
            SURFMINK__STORE(r->length + i, re);
            SURFMINK__STORE(r->turned + i, im);
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

/* w = l z becomes l z^p, by repeated squaring. */
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
SURFMINK__VECTOR void SURFMINK__(three_ranks)(SURFMINK__(rows) *r, size_t rows, int more, double *g)
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
SURFMINK__VECTOR void SURFMINK__(rank)(const double *g, const double *length, double p, double *mu, double *theta)
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

/* --- batches: all four steps for a group of lanes ----------------------------------------------------------------- */

/* Outlines of at most SURFMINK__ROWS corners, a lane each; or the strips of one that is longer. */
typedef struct SURFMINK__(group) {
    surfmink__dd sum[SURFMINK__SUMS][SURFMINK__LANES]; /* strips: sums over the rows so far */
    double widest[SURFMINK__LANES];                    /* strips: the same of the sum of turns */
    size_t outline[SURFMINK__LANES];                   /* which one of the batch */
    size_t base[SURFMINK__LANES];                      /* its first corner */
    size_t size[SURFMINK__LANES];                      /* how many it has */
    size_t start[SURFMINK__LANES];                     /* the first corner of the lane */
    size_t count[SURFMINK__LANES];                     /* how many it has */
    size_t used;                                       /* lanes that hold results of their own */
    size_t good, good_lane[SURFMINK__LANES];           /* those of them that are ordinary */
    size_t rows;                                       /* of the longest lane */
    size_t strips;                                     /* one outline or several? */
} SURFMINK__(group);

/* Where the corners of a lane stand: the one before the rows at hand, those of the rows, and the one behind them. */
typedef struct SURFMINK__(span) {
    size_t before, at, count, behind;
} SURFMINK__(span);

/* One row of two neighbouring lanes. */
SURFMINK__VECTOR void SURFMINK__(store_pair)(double a, double b, double *at)
{
    surfmink__pair pair;
    pair[0] = a;
    pair[1] = b;
    *(surfmink__pair *)(void *)at = pair;
}

SURFMINK__VECTOR void SURFMINK__(store_row)(const double *a, const double *b, size_t dim, double *row)
{
    SURFMINK__(store_pair)(a[0], b[0], row);
    SURFMINK__(store_pair)(a[1], b[1], row + SURFMINK__COLUMN);
    if (dim > 2) SURFMINK__(store_pair)(a[2], b[2], row + 2 * SURFMINK__COLUMN);
}

/* Spreads corners (or normals) of all lanes over columns, two lanes at a time, with the row before the first and that
   behind the last. Short lanes are padded with the corner behind their last one: edges of length 0, which turn
   nowhere. */
SURFMINK__VECTOR void SURFMINK__(gather)(const double *from, size_t dim, const SURFMINK__(span) *span, size_t rows,
                                         double *column)
{
    size_t lane, i, both, end = (rows + 1) * dim;
    for (lane = 0; lane < SURFMINK__LANES; lane += 2, span += 2, column += 2) {
        const SURFMINK__(span) *next = span + 1;
        const double *a = from + dim * span->at, *b = from + dim * next->at;
        const double *a_behind = from + dim * span->behind, *b_behind = from + dim * next->behind;
        double *row = column + SURFMINK__LANES;
        SURFMINK__(store_row)(from + dim * span->before, from + dim * next->before, dim, column);
        both = dim * (span->count < next->count ? span->count : next->count);
        for (i = 0; i < both; i += dim, row += SURFMINK__LANES) SURFMINK__(store_row)(a + i, b + i, dim, row);
        for (; i < end; i += dim, row += SURFMINK__LANES) SURFMINK__(store_row)
        (i < dim * span->count ? a + i : a_behind, i < dim * next->count ? b + i : b_behind, dim, row);
    }
}

/* Corners and normals of the rows. */
SURFMINK__KERNEL void SURFMINK__(gather_rows)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row,
                                              size_t rows, SURFMINK__(rows) *r)
{
    size_t lane, base, past;
    SURFMINK__(span) span[SURFMINK__LANES];
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        base = g->base[lane];
        past = row < g->count[lane] ? row : g->count[lane];
        span[lane].at = g->start[lane] + past;
        span[lane].count = g->count[lane] - past < rows ? g->count[lane] - past : rows;
        span[lane].behind =
            span[lane].at + span[lane].count < base + g->size[lane] ? span[lane].at + span[lane].count : base;
        span[lane].before = (span[lane].at > base ? span[lane].at : base + g->size[lane]) - 1;
    }
    SURFMINK__(gather)(job->all->corner, job->all->kind == SURFMINK_PLANE ? 2 : 3, span, rows, r->column[0]);
    if (job->all->kind == SURFMINK_EMBEDDED) SURFMINK__(gather)(job->all->normal, 3, span, rows, r->column[3]);
}

/* Step 1, and the angles of step 2. */
SURFMINK__KERNEL void SURFMINK__(measure_rows)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row,
                                               size_t rows, SURFMINK__(rows) *r, SURFMINK__(totals) *t)
{
    const double *first = g->strips ? r->first[0] : r->column[0] + SURFMINK__LANES;
    size_t stride = g->strips ? 2 * SURFMINK__LANES : SURFMINK__COLUMN;
    SURFMINK__(gather_rows)(job, g, row, rows, r);
    if (job->all->kind == SURFMINK_PLANE) {
        SURFMINK__(edges_plane)(r, rows, first, stride, t);
        return;
    }
    if (job->all->kind == SURFMINK_SPHERE)
        SURFMINK__(edges_sphere)(r, rows, first, stride, t);
    else
        SURFMINK__(edges_embedded)(r, rows, t);
    SURFMINK__(angles)(r, rows, t);
}

/* Which lanes have all their corners measured by the plain formulas, and are right or clockwise as a whole: their
   number of good rows becomes 1, or -1, that of others 0; these go to the scalar path. S is what the surface says it
   is: 2 pi in the plane, 2 pi - area on the sphere, which has more digits than a sum of rounded turns. Phases go by
   the sum, for that closes. Rounding is amplified by 1 / S, and again where the sum of the turns exceeds S by far on
   the way. */
SURFMINK__KERNEL void SURFMINK__(accept)(const surfmink__job *job, SURFMINK__(totals) *t)
{
    const surfmink__real two_pi = SURFMINK__SET(6.2831853071795865), zero = SURFMINK__SET(0.0);
    const surfmink__real unit = SURFMINK__SET(job->unit);
    surfmink__real length, turning, area, known;
    surfmink__mask good, clockwise;
    size_t lane;
    for (lane = 0; lane < SURFMINK__LANES; lane += SURFMINK__WIDTH) {
        length = SURFMINK__LOAD(t->sum[SURFMINK__LENGTH] + lane);
        turning = SURFMINK__LOAD(t->sum[SURFMINK__TURNING] + lane);
        area = SURFMINK__LOAD(t->sum[SURFMINK__AREA] + lane);
        good = SURFMINK__LESS(
            SURFMINK__ABS(SURFMINK__LOAD(t->sum[SURFMINK__GOOD] + lane) - SURFMINK__LOAD(t->expected + lane)),
            SURFMINK__SET(0.5));
        good = good & SURFMINK__LESS(SURFMINK__SET(1e-100), length) & SURFMINK__LESS(length, SURFMINK__SET(1e100));
        good = good & SURFMINK__LESS(SURFMINK__SET(1e-300), length * unit); /* as it will be written */
        good = good & SURFMINK__LESS(length * unit, SURFMINK__SET(1.7e308));
        good = good & SURFMINK__LESS(SURFMINK__ABS(area) * unit * unit, SURFMINK__SET(8e307)); /* others double it */
        clockwise =
            good & SURFMINK__LESS(area, zero) & SURFMINK__LESS(SURFMINK__ABS(turning + two_pi), SURFMINK__SET(1e-3));
        known = two_pi;
        if (job->all->kind == SURFMINK_EMBEDDED) { /* nothing to be looked at for S in [pi, 3 pi] */
            known = turning;
            good = good & SURFMINK__LESS(SURFMINK__SET(3.1415926535897936), known) &
                   SURFMINK__LESS(known, SURFMINK__SET(9.42477796076937));
        } else
            good = good & SURFMINK__LESS(zero, area);
        if (job->all->kind == SURFMINK_SPHERE) known = two_pi - area;
        good = good & SURFMINK__LESS(SURFMINK__ABS(turning - known), SURFMINK__SET(1e-3));
        if (job->all->kind != SURFMINK_PLANE) {     /* there whole turns are counted, which rounding does not reach */
            clockwise = SURFMINK__LESS(zero, zero); /* none */
            good = good & SURFMINK__LESS(SURFMINK__LOAD(t->largest + lane), SURFMINK__SET(1e300));
            good =
                good & SURFMINK__LESS(SURFMINK__LOAD(t->sharpest + lane), SURFMINK__SET(3.14159265358978)); /* spikes */
            good =
                good & SURFMINK__LESS(SURFMINK__FMA(SURFMINK__SET(1e-3), SURFMINK__LOAD(t->sum[SURFMINK__TURNS] + lane),
                                                    SURFMINK__SET(0.5)),
                                      known);
            good = good & SURFMINK__LESS(SURFMINK__LOAD(t->widest + lane), SURFMINK__SET(2.0) * known);
        }
        /* whatever becomes of the rest, nothing is divided by zero */
        SURFMINK__STORE(t->sum[SURFMINK__LENGTH] + lane, SURFMINK__SELECT(good, length, SURFMINK__SET(1.0)));
        SURFMINK__STORE(t->sum[SURFMINK__TURNING] + lane, SURFMINK__SELECT(good, turning, SURFMINK__SET(1.0)));
        SURFMINK__STORE(t->known + lane, known);
        SURFMINK__STORE(t->sum[SURFMINK__GOOD] + lane,
                        SURFMINK__WHERE(good, SURFMINK__SET(1.0)) - SURFMINK__WHERE(clockwise, SURFMINK__SET(1.0)));
    }
}

/* What is known before any rank is. Returns how many lanes are refused. */
SURFMINK__KERNEL size_t SURFMINK__(write)(const surfmink__job *job, const SURFMINK__(totals) *t, SURFMINK__(group) *g)
{
    const surfmink_results *out = job->out;
    size_t lane, i, ranks = (size_t)job->max_rank + 1, refused = 0;
    double length;
    g->good = 0;
    for (lane = 0; lane < g->used; ++lane) {
        i = g->outline[lane];
        if (t->sum[SURFMINK__GOOD][lane] < 0) {
            if (out->status) out->status[i] = SURFMINK_CLOCKWISE;
            if (out->bad) out->bad[i] = g->size[lane];
            ++refused;
        }
        if (!(t->sum[SURFMINK__GOOD][lane] > 0)) continue;
        g->good_lane[g->good++] = lane;
        length = t->sum[SURFMINK__LENGTH][lane] * job->unit;
        if (out->status) out->status[i] = SURFMINK_OK;
        if (out->length) out->length[i] = length;
        if (out->turning) out->turning[i] = t->known[lane];
        if (out->area) out->area[i] = surfmink__area_of(job, i, t->sum[SURFMINK__AREA][lane] * job->unit * job->unit);
        if (out->mu) out->mu[i * ranks] = 1;
        if (out->theta) out->theta[i * ranks] = 0;
        if (!out->g) continue;
        out->g[2 * i * ranks] = length;
        out->g[2 * i * ranks + 1] = 0;
    }
    return refused;
}

/* Three numbers of a lane, which stand a row apart. */
SURFMINK__VECTOR void SURFMINK__(copy_three)(const double *from, double *to)
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
            if (out->mu) SURFMINK__(copy_three)(r[tile].mu + lane, out->mu + at);
            if (out->theta) SURFMINK__(copy_three)(r[tile].theta + lane, out->theta + at);
            if (!out->g) continue;
            SURFMINK__(copy_three)(r[tile].g + lane, out->g + 2 * at);
            SURFMINK__(copy_three)(r[tile].g + lane + 3 * SURFMINK__LANES, out->g + 2 * at + 3);
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

SURFMINK__KERNEL void SURFMINK__(clear)(SURFMINK__(totals) *t)
{
    size_t lane, k;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        for (k = 0; k < SURFMINK__SUMS; ++k) t->sum[k][lane] = 0;
        t->sharpest[lane] = t->widest[lane] = t->largest[lane] = 0;
    }
}

/* Outlines that fit into the rows whole. Returns how many are refused. */
SURFMINK__KERNEL size_t SURFMINK__(measure_short)(const surfmink__job *job, SURFMINK__(group) *g, SURFMINK__(rows) *r,
                                                  SURFMINK__(totals) *t, SURFMINK__(ranks) *sum)
{
    size_t lane, refused;
    int first, tile, tiles;
    SURFMINK__(clear)(t);
    SURFMINK__(measure_rows)(job, g, 0, g->rows, r, t);
    SURFMINK__(accept)(job, t);
    refused = SURFMINK__(write)(job, t, g);
    if (g->good == 0) return refused;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) t->behind[lane] = -r->turned[lane];
    if (job->all->kind != SURFMINK_PLANE) SURFMINK__(phases)(r, g->rows, t->behind, t->sum[SURFMINK__TURNING]);
    for (first = 1; first <= job->max_rank; first += 3 * SURFMINK__TILES) {
        tiles = SURFMINK__(tiles)(job, first);
        for (tile = 0; tile < tiles; ++tile)
            SURFMINK__(power_sums)(r, g->rows, first + 3 * tile + 3 <= job->max_rank, sum[tile].g);
        SURFMINK__(write_ranks)(job, t, g, sum, first, tiles);
    }
    return refused;
}

/* Rows of the strips of a long outline, from the first on in order: turned_i is counted from where the strip starts. */
SURFMINK__KERNEL void SURFMINK__(measure_strips)(const surfmink__job *job, SURFMINK__(group) *g, size_t row,
                                                 size_t rows, SURFMINK__(rows) *r, SURFMINK__(totals) *t)
{
    double before, wide;
    size_t lane, i, k;
    if (row == 0) SURFMINK__(clear)(t);
    SURFMINK__(measure_rows)(job, g, row, rows, r, t);
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        for (k = 0; k < SURFMINK__SUMS && row == 0; ++k) g->sum[k][lane].high = g->sum[k][lane].low = 0;
        before = surfmink__value(&g->sum[SURFMINK__TURNING][lane]);
        wide = surfmink__abs(before) + t->widest[lane];
        if (row == 0 || wide > g->widest[lane]) g->widest[lane] = wide;
        for (i = lane; i < rows * SURFMINK__LANES && job->all->kind != SURFMINK_PLANE; i += SURFMINK__LANES)
            r->turned[i] += before;
        for (k = 0; k < SURFMINK__SUMS; ++k) surfmink__add(&g->sum[k][lane], t->sum[k][lane]);
    }
}

/* Lengths and turns into the caller's scratch, or back again. No condition in the loops: gcc 12 makes masked AVX-512
   instructions of those at -O3, and wrong ones. */
SURFMINK__KERNEL void SURFMINK__(store_edges)(const surfmink__job *job, const SURFMINK__(group) *g, size_t row,
                                              size_t rows, SURFMINK__(rows) *r, int back)
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

/* The strips of a long outline put together, in the first lane of the totals. */
SURFMINK__KERNEL void SURFMINK__(merge_strips)(const SURFMINK__(group) *g, SURFMINK__(totals) *t)
{
    surfmink__dd sum;
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
SURFMINK__KERNEL void SURFMINK__(split)(const surfmink__job *job, size_t outline, SURFMINK__(group) *g,
                                        SURFMINK__(rows) *r, SURFMINK__(totals) *t)
{
    size_t dim = job->all->kind == SURFMINK_PLANE ? 2 : 3, n = job->offset[outline + 1] - job->offset[outline], lane, k;
    const double *corner = job->all->corner + dim * job->offset[outline];
    g->used = 1;
    g->rows = (n + SURFMINK__LANES - 1) / SURFMINK__LANES;
    for (lane = 0; lane < SURFMINK__LANES; ++lane) {
        g->outline[lane] = outline;
        g->base[lane] = job->offset[outline];
        g->size[lane] = n;
        g->start[lane] = g->base[lane] + lane * g->rows;
        g->count[lane] = n - lane * g->rows < g->rows ? n - lane * g->rows : g->rows;
        t->expected[lane] = (double)(ptrdiff_t)n;
        for (k = 0; k < 2 * dim; ++k) r->first[k % dim][k / dim * SURFMINK__LANES + lane] = corner[k];
    }
}

/* Sums of powers of rows of strips, added to those of the rows before.
   ranks 6 tiles  real and imaginary parts, tile by tile */
SURFMINK__KERNEL void SURFMINK__(add_powers)(SURFMINK__(rows) *r, size_t rows, int first, int tiles,
                                             SURFMINK__(ranks) *sum)
{
    SURFMINK__(ranks) part;
    size_t j;
    int tile;
    SURFMINK__(raise)(r, rows, first - 1);
    for (tile = 0; tile < tiles; ++tile) {
        SURFMINK__(power_sums)(r, rows, tile + 1 < tiles, part.g);
        for (j = 0; j < 6 * SURFMINK__LANES; ++j) sum[tile].g[j] += part.g[j];
    }
}

/* Outlines with more corners than there are rows, in strips: once over them for S, which every phase needs, and once
   for each 24 ranks. In the plane, where phases need no S, the first 24 ranks are summed on the way. */
SURFMINK__KERNEL size_t SURFMINK__(measure_long)(const surfmink__job *job, SURFMINK__(group) *g, SURFMINK__(rows) *r,
                                                 SURFMINK__(totals) *t, SURFMINK__(ranks) *sum)
{
    SURFMINK__(totals) again;
    const int plane = job->all->kind == SURFMINK_PLANE, kept = job->scratch && !plane;
    size_t row, rows, lane, j, refused;
    int first, tile, tiles;
    for (tile = 0; tile < SURFMINK__TILES; ++tile)
        for (j = 0; j < 6 * SURFMINK__LANES; ++j) sum[tile].g[j] = 0;
    for (row = 0; row < g->rows; row += SURFMINK__STRIP) {
        rows = g->rows - row < SURFMINK__STRIP ? g->rows - row : SURFMINK__STRIP;
        SURFMINK__(measure_strips)(job, g, row, rows, r, t);
        for (lane = 0; lane < SURFMINK__LANES && row == 0; ++lane) t->behind[lane] = -r->turned[0];
        if (kept) SURFMINK__(store_edges)(job, g, row, rows, r, 0);
        if (plane && job->max_rank > 0) SURFMINK__(add_powers)(r, rows, 1, SURFMINK__(tiles)(job, 1), sum);
    }
    SURFMINK__(merge_strips)(g, t);
    SURFMINK__(accept)(job, t);
    refused = SURFMINK__(write)(job, t, g);
    for (lane = 1; lane < SURFMINK__LANES; ++lane) t->sum[SURFMINK__TURNING][lane] = t->sum[SURFMINK__TURNING][0];
    for (first = 1; first <= job->max_rank && g->good > 0; first += 3 * SURFMINK__TILES) {
        tiles = SURFMINK__(tiles)(job, first);
        for (tile = 0; tile < tiles && (first > 1 || !plane); ++tile)
            for (j = 0; j < 6 * SURFMINK__LANES; ++j) sum[tile].g[j] = 0;
        for (row = 0; row < g->rows && (first > 1 || !plane); row += SURFMINK__STRIP) {
            rows = g->rows - row < SURFMINK__STRIP ? g->rows - row : SURFMINK__STRIP;
            if (kept)
                SURFMINK__(store_edges)(job, g, row, rows, r, 1);
            else
                SURFMINK__(measure_strips)(job, g, row, rows, r, &again);
            if (!plane) SURFMINK__(phases)(r, rows, t->behind, t->sum[SURFMINK__TURNING]);
            SURFMINK__(add_powers)(r, rows, first, tiles, sum);
        }
        for (tile = 0; tile < tiles; ++tile)
            for (j = 0; j < 6 * SURFMINK__LANES; ++j)
                if (j % SURFMINK__LANES) sum[tile].g[j - j % SURFMINK__LANES] += sum[tile].g[j];
        SURFMINK__(write_ranks)(job, t, g, sum, first, tiles);
    }
    return refused;
}

/* Loads corners from number `at` on in the order in which the next window reads them. */
SURFMINK__KERNEL void SURFMINK__(prefetch)(const surfmink__job *job, size_t at, size_t count)
{
    size_t dim = job->all->kind == SURFMINK_PLANE ? 2 : 3, line = 8, i;
    if (at >= job->all->n || count > job->all->n - at) return;
    for (i = dim * at; i < dim * (at + count); i += line) {
        SURFMINK__PREFETCH(job->all->corner + i);
        if (job->all->kind == SURFMINK_EMBEDDED) SURFMINK__PREFETCH(job->all->normal + i);
    }
}

/* Outlines first .. first + count - 1 of a batch, at most SURFMINK__WINDOW. Those that fit are sorted by their number
   of corners, so that the lanes of a group are of like length.
   left  count  out: 1 where nothing was written, because the outline needs the scalar path
   returns      how many outlines were refused, besides those */
static size_t SURFMINK__(window)(const surfmink__job *job, size_t first, size_t count, unsigned char *left)
{
    SURFMINK__(rows) r;
    SURFMINK__(totals) t;
    SURFMINK__(ranks) sum[SURFMINK__TILES];
    SURFMINK__(group) g;
    const size_t *offset = job->offset + first;
    size_t place[SURFMINK__ROWS + 2] = {0}, order[SURFMINK__WINDOW], i, n, lane, at, fitting = 0;
    size_t ahead = offset[count], refused = 0;
    for (i = 0; i < count; ++i) {
        n = offset[i + 1] - offset[i];
        left[i] = 0;
        if (offset[i + 1] < offset[i] || offset[i + 1] > job->all->n || n < 3)
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
        refused += SURFMINK__(measure_short)(job, &g, &r, &t, sum);
        for (lane = 0; lane < g.used && g.good < g.used; ++lane)
            left[g.outline[lane] - first] = t.sum[SURFMINK__GOOD][lane] > -0.5 && t.sum[SURFMINK__GOOD][lane] < 0.5;
    }
    g.strips = 1;
    for (i = fitting; i < at; ++i) {
        SURFMINK__(split)(job, first + order[i], &g, &r, &t);
        refused += SURFMINK__(measure_long)(job, &g, &r, &t, sum);
        left[order[i]] = t.sum[SURFMINK__GOOD][0] > -0.5 && t.sum[SURFMINK__GOOD][0] < 0.5;
    }
    return refused;
}

#undef SURFMINK__
#undef SURFMINK__COLUMN
#undef SURFMINK__LANES
#undef SURFMINK__ALIGNED
#undef surfmink__real
#undef surfmink__mask
#undef SURFMINK__SET
#undef SURFMINK__LOAD
#undef SURFMINK__STORE
#undef SURFMINK__SIGN
#undef SURFMINK__ABS
#undef SURFMINK__LESS
#undef SURFMINK__SELECT
#undef SURFMINK__WHERE
#undef SURFMINK__NEGATE
#undef SURFMINK__SIGNED
#undef SURFMINK__ODD
#undef SURFMINK__WIDTH
#undef SURFMINK__MIN
#undef SURFMINK__MAX
#undef SURFMINK__ROOT
#undef SURFMINK__BARRIER
#undef SURFMINK__FMA
#undef SURFMINK__FNMA
#undef SURFMINK__2
#undef SURFMINK__3
#undef SURFMINK__UP
#undef SURFMINK__INSTANCE
#endif /* SURFMINK__INSTANCE */

#ifdef SURFMINK__REST
#undef SURFMINK__REST

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
#ifdef SURFMINK__INSTANCE /* the file that was included was another one */
#error "surfmink.h includes itself for SURFMINK_DISPATCH: define SURFMINK_FILE as its name"
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

#ifdef SURFMINK__NATIVE

typedef size_t surfmink__measure_window(const surfmink__job *job, size_t first, size_t count, unsigned char *left);

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
#else
    return surfmink__window_neon;
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

/* Outlines first .. first + count - 1. Kernels take none whose job as a whole is bad. */
static size_t surfmink__measure_some(const surfmink__job *job, size_t first, size_t count,
                                     surfmink__measure_window *measure)
{
    unsigned char left[SURFMINK__WINDOW];
    size_t i, refused = measure ? measure(job, first, count, left) : 0;
    for (i = 0; i < count; ++i)
        if (!measure || left[i]) refused += surfmink__measure_one(job, first + i);
    return refused;
}

/* How many outlines to take at a time: few if they are long, so that threads have something to share; else full
   groups. */
static size_t surfmink__window_size(const surfmink__job *job, size_t count)
{
    size_t size = count / (job->all->n / 16384 + 1);
    if (size >= SURFMINK__WINDOW) return SURFMINK__WINDOW;
    return size > 8 ? size - size % 8 : size > 0 ? size : 1;
}

#else

typedef size_t surfmink__measure_window(void);

static surfmink__measure_window *surfmink__choose(void)
{
    return NULL;
}

static size_t surfmink__measure_some(const surfmink__job *job, size_t first, size_t count,
                                     surfmink__measure_window *measure)
{
    size_t refused = 0;
    (void)measure;
    for (; count > 0; --count, ++first) refused += surfmink__measure_one(job, first);
    return refused;
}

static size_t surfmink__window_size(const surfmink__job *job, size_t count)
{
    (void)job;
    return count > 64 ? 64 : count > 0 ? count : 1;
}

#endif

#ifdef _OPENMP
/* Fewer corners than this are measured before another thread has begun: docs/internals/performance.md. */
static const size_t surfmink__parallel = 400000;

/* Where offsets fall, outlines may share corners, and so scratch: that is no work for threads. */
static int surfmink__rises(const size_t *offset, size_t count)
{
    while (count > 0 && offset[count - 1] <= offset[count]) --count;
    return count == 0;
}
#endif

SURFMINK_DEF size_t surfmink_batch(const surfmink_outline *all, const size_t *offset, size_t count, int max_rank,
                                   const surfmink_results *out, double *scratch)
{
    surfmink__measure_window *measure = NULL;
    surfmink__job job;
    size_t size, refused = 0;
#ifdef _OPENMP
    const int parallel = all->n > surfmink__parallel && surfmink__rises(offset, count);
#endif
    ptrdiff_t windows, k;
    job.all = all;
    job.offset = offset;
    job.out = out;
    job.scratch = scratch;
    job.unit = all->kind == SURFMINK_SPHERE ? all->radius : 1;
    job.max_rank = max_rank;
    if ((unsigned)all->kind < SURFMINK_SURFACE && max_rank >= 0 && surfmink__positive(job.unit) &&
        surfmink__has_arrays(all))
        measure = surfmink__choose();
    size = surfmink__window_size(&job, count);
    windows = (ptrdiff_t)(count / size + (count % size > 0));
#ifdef _OPENMP
#pragma omp parallel for schedule(guided) reduction(+ : refused) if (parallel)
#endif
    for (k = 0; k < windows; ++k) {
        const size_t first = (size_t)k * size;
        refused += surfmink__measure_some(&job, first, count - first < size ? count - first : size, measure);
    }
    return refused;
}

#ifdef __cplusplus
}
#endif
#endif /* SURFMINK__REST */

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
