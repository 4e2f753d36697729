/* patic_shared.c - the p-atic field of a tissue for other languages: one call, arrays in, arrays out.

   compile   cc -O2 -shared -fPIC -I. examples/languages/patic_shared.c -o .build/libpatic.so -lm
   use       examples/languages/patic.py */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "examples/beyond/patic.h"

#include <stdlib.h>

/* Where the results go. Arrays of one entry a cell, or as many as said; none is NULL. */
typedef struct patic_arrays {
    int *status;
    double *centre, *normal, *direction; /* 3 each; direction: 0 where there is none */
    double *mu, *order;
    double *defect;    /* 6 each, room for corners / 2 + cells: x y z charge order margin */
    long defects, chi; /* out */
    double sum, boundary, spacing;
} patic_arrays;

/* kind: of enum surfmink_kind. radius: of the ball; negative: in mean distances. Returns a surfmink_status. */
int patic_measure(int kind, const double *corner, const double *normal, const size_t *offset, size_t cells,
                  double sphere_radius, int rank, double radius, double weld, patic_arrays *out);
int patic_measure(int kind, const double *corner, const double *normal, const size_t *offset, size_t cells,
                  double sphere_radius, int rank, double radius, double weld, patic_arrays *out)
{
    surfmink_outline all = kind == SURFMINK_PLANE    ? surfmink_plane(corner, offset[cells])
                           : kind == SURFMINK_SPHERE ? surfmink_sphere(corner, offset[cells], sphere_radius)
                                                     : surfmink_embedded(corner, normal, offset[cells]);
    size_t size = patic_bytes(offset, cells, rank), c, k;
    void *memory = malloc(size + 1);
    double *z = (double *)malloc((4 * cells + 1) * sizeof *z), *coarse = z + 2 * cells;
    int status = memory && z ? SURFMINK_OK : SURFMINK_BAD_ARGUMENT;
    patic t;
    if (status == SURFMINK_OK) status = patic_build(&t, &all, offset, cells, rank, weld, memory);
    if (status == SURFMINK_OK) status = patic_field(&t, rank, z, out->mu);
    if (status == SURFMINK_OK) status = patic_coarsen(&t, rank, radius < 0 ? -radius * t.spacing : radius, z, coarse);
    if (status == SURFMINK_OK) status = patic_charges(&t, rank, coarse);
    if (status == SURFMINK_OK) {
        out->defects = (long)patic_defects(&t, coarse);
        out->chi = t.chi;
        out->spacing = t.spacing;
        out->sum = out->boundary = 0;
        for (c = 0; c < t.components; ++c) {
            out->sum += (double)t.component[c].charge / rank;
            out->boundary += (double)t.component[c].boundary / rank;
        }
        for (c = 0; c < cells; ++c) {
            out->status[c] = t.cell[c].status;
            out->order[c] = hypot(coarse[2 * c], coarse[2 * c + 1]);
            for (k = 0; k < 3; ++k) {
                out->centre[3 * c + k] = t.cell[c].centre[k];
                out->normal[3 * c + k] = t.cell[c].normal[k];
                out->direction[3 * c + k] = 0;
            }
            patic_direction(&t, rank, coarse, c, out->direction + 3 * c);
        }
        for (c = 0; c < t.defects; ++c) {
            double *d = out->defect + 6 * c;
            for (k = 0; k < 3; ++k) d[k] = t.defect[c].x[k];
            d[3] = (double)t.defect[c].k / rank;
            d[4] = t.defect[c].order;
            d[5] = t.defect[c].margin;
        }
    }
    free(memory);
    free(z);
    return status;
}
