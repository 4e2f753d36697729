/* flat.h - surfmink.h and examples/beyond/ as functions of numbers and plain arrays, for languages that do not read C.

   `make shared` builds one library of these and of all functions of surfmink.h. surfmink.py and surfmink.f90 call it;
   anything that calls C can: no struct, no allocation, no state. What the numbers mean is said in surfmink.h and in the
   header that is named.

   Arguments that stand for an outline, or for the corners of all outlines, one outline after the other:
   kind               0 plane, 1 sphere, 2 embedded
   corner   2 n, 3 n  x y (plane), else x y z
   normal      3 n    embedded; else ignored: NULL
   n                  number of corners
   radius             sphere; else ignored
   offset    count+1  outline i has the corners offset[i] .. offset[i+1] - 1
   Every output may be NULL. Outputs of one outline: mu, theta, error P + 1; g 2 P + 2; w 5: area, length, turning,
   curvature, condition. Of many: so many, one outline after the other.
   An area that is not known is NaN: that of an outline on a surface by callback. */
#ifndef SURFMINK_FLAT_H
#define SURFMINK_FLAT_H

#include "../../surfmink.h"

#ifdef __cplusplus
extern "C" {
#endif

/* surfmink_measure. */
SURFMINK_DEF int surfmink_flat_measure(int kind, const double *corner, const double *normal, size_t n, double radius,
                                       int max_rank, double *mu, double *g, double *w, size_t *bad);

/* The same of an outline on a surface by callback: n corners of stride numbers. */
SURFMINK_DEF int surfmink_flat_measure_surface(const surfmink_surface *surface, const double *corner, size_t n,
                                               int max_rank, double *mu, double *g, double *w, size_t *bad);

/* surfmink_batch. The number of outlines that were refused. scratch: 2 n numbers, for outlines of more than 128 corners
   to be measured once; or NULL. */
SURFMINK_DEF size_t surfmink_flat_batch(int kind, const double *corner, const double *normal, size_t n, double radius,
                                        const size_t *offset, size_t count, int max_rank, int *status, size_t *bad,
                                        double *length, double *turning, double *area, double *mu, double *g,
                                        double *theta, double *scratch);

/* surfmink_curve of curve.h, whose status may be 100: unlike_edges.
   order              2 or 4
   sharp       n      not 0 where the curve itself has a corner; or NULL
   scratch            12 n + 8 (P + 2) numbers to work in */
SURFMINK_DEF int surfmink_flat_curve(int kind, const double *corner, const double *normal, size_t n, double radius,
                                     int order, const unsigned char *sharp, int max_rank, double *mu, double *error,
                                     double *g, double *w, double *scratch, size_t *bad);

/* surfmink_batch_gradient of gradient.h. The number of outlines that were refused.
   by_mu, by_g, by_theta, by_length  derivatives of the energy of an outline, laid out as mu, g, theta and L; or NULL
   shared             not 0: one set of them for all outlines; else one each
   status, g, by_corner  not NULL, if there is theta; by_corner never
   by_corner, by_normal  out, laid out as corner and normal
   scratch            4 n + (2 P + 2) count numbers to work in */
SURFMINK_DEF size_t surfmink_flat_gradient(int kind, const double *corner, const double *normal, size_t n,
                                           double radius, const size_t *offset, size_t count, int max_rank,
                                           const double *by_mu, const double *by_g, const double *by_theta,
                                           const double *by_length, int shared, int *status, size_t *bad, double *mu,
                                           double *g, double *theta, double *w, double *by_corner, double *by_normal,
                                           double *scratch);

/* surfmink_measure, and surfmink_director of director.h.
   centre, mean_normal 3  out; plane: z = 0, and 0 0 1
   direction (P+1)dim out: dim = 2 in the plane, else 3
   coherence   P + 1  out; not without direction
   scratch  2 n + 2 P + 2  numbers to work in */
SURFMINK_DEF int surfmink_flat_director(int kind, const double *corner, const double *normal, size_t n, double radius,
                                        int max_rank, double *mu, double *g, double *w, double *centre,
                                        double *mean_normal, double *direction, double *coherence, double *scratch,
                                        size_t *bad);

/* The field of a tissue: patic_build, patic_field, patic_coarsen, patic_charges and patic_defects of patic.h. Returns
   BAD_ARGUMENT for offsets that fall, do not begin with 0 or go beyond n, and for a rank, weld or ball without sense.
   The status of a cell may be 64 or 65 besides: overlaps, meets_itself.
   rank               of the field: 1 to 1000
   weld               corners nearer than this are one; negative: 1e-6 of the mean edge
   ball               the field is its mean over the cells within this distance; 0: as it is; negative: minus the
                      distance in mean distances of neighbours
   status, bad cells  out; of a refused cell nothing else is written
   centre, mean_normal, direction 3 cells  out; plane: z = 0, and 0 0 1; direction: 0 0 0 where there is none
   mu, order   cells  out: mu_rank of the outline, and |z| of the field
   defect  6 (n / 2 + cells) out: x y z charge order margin of each
   defects            out: how many
   totals      5      out: components, Euler characteristic, sum of charges, boundary sum, mean distance of neighbours
   scratch            numbers to work in, as many as the other call says; it says 0 if offsets fall, or for other ranks
*/
SURFMINK_DEF size_t surfmink_flat_patic_scratch(const size_t *offset, size_t cells, int rank);
SURFMINK_DEF int surfmink_flat_patic(int kind, const double *corner, const double *normal, size_t n, double radius,
                                     const size_t *offset, size_t cells, int rank, double weld, double ball,
                                     int *status, size_t *bad, double *centre, double *mean_normal, double *direction,
                                     double *mu, double *order, double *defect, size_t *defects, double *totals,
                                     double *scratch);

/* A status in a sentence and in a word, those of curve.h and patic.h among them; "" for a number that is none. */
SURFMINK_DEF const char *surfmink_flat_strerror(int status);
SURFMINK_DEF const char *surfmink_flat_status_name(int status);

#ifdef __cplusplus
}
#endif
#endif
