/* surfmink_r.c - surfmink from R: the batches, as functions for .Call. surfmink.R calls them.

   compile   R CMD SHLIB examples/languages/surfmink_r.c */
#define SURFMINK_STATIC
#include "../../surfmink.h"

#define R_NO_REMAP
#include <R.h>
#include <Rinternals.h>

/* A matrix of numbers that are not known yet, or for one row a vector, as an entry of the list. */
static double *unknown(int rows, R_xlen_t columns, SEXP list, int at)
{
    SEXP made = rows == 1 ? Rf_allocVector(REALSXP, columns) : Rf_allocMatrix(REALSXP, rows, (int)columns);
    R_xlen_t i;
    SET_VECTOR_ELT(list, at, made);
    for (i = 0; i < rows * columns; ++i) REAL(made)[i] = NA_REAL;
    return REAL(made);
}

/* R's whole numbers end at 2^31: offsets are doubles. None may lead beyond the corners. */
static size_t *offsets(SEXP offset, R_xlen_t corners)
{
    R_xlen_t count = Rf_xlength(offset), i;
    size_t *made = (size_t *)R_alloc((size_t)count, sizeof *made);
    for (i = 0; i < count; ++i) {
        if (!(REAL(offset)[i] >= 0 && REAL(offset)[i] <= (double)corners))
            Rf_error("offset[%ld] is not between 0 and the number of corners", (long)i + 1);
        made[i] = (size_t)REAL(offset)[i];
    }
    return made;
}

/* corner 2 x n or 3 x n; normal 3 x n or NULL; radius a number or NULL: what is given says which surface it is.
   Returns a list: status, L, S and area of each outline; mu and theta, of each a column of P + 1. */
SEXP surfmink_r_batch(SEXP corner, SEXP normal, SEXP radius, SEXP offset, SEXP max_rank)
{
    static const char *const name[] = {"status", "L", "S", "area", "mu", "theta", ""};
    R_xlen_t count = Rf_xlength(offset) - 1, i;
    int dimension, corners, rank = Rf_asInteger(max_rank), ranks;
    surfmink_results out = {0};
    surfmink_outline all;
    SEXP list;
    size_t *at;
    if (!Rf_isReal(corner) || !Rf_isMatrix(corner)) Rf_error("corner is no matrix of numbers");
    dimension = Rf_nrows(corner);
    corners = Rf_ncols(corner);
    if (dimension != 2 && dimension != 3)
        Rf_error("corner has %d rows, not 2 or 3: each column is a corner", dimension);
    if (!Rf_isNull(normal) && (!Rf_isReal(normal) || !Rf_isMatrix(normal) || Rf_nrows(normal) != 3 ||
                               Rf_ncols(normal) != corners || dimension != 3))
        Rf_error("normal and corner are not both matrices of 3 rows and as many columns");
    if (!Rf_isReal(offset) || count < 0) Rf_error("offset is no vector of outlines + 1 numbers");
    if (rank < 0 || rank > 1000000) Rf_error("max_rank is not between 0 and 1000000");
    if (dimension == 3 && Rf_isNull(normal) && Rf_isNull(radius)) Rf_error("in space give normal, or radius");
    at = offsets(offset, corners);
    ranks = rank + 1;
    PROTECT(list = Rf_mkNamed(VECSXP, (const char **)name));
    SET_VECTOR_ELT(list, 0, Rf_allocVector(INTSXP, count));
    out.status = INTEGER(VECTOR_ELT(list, 0));
    out.length = unknown(1, count, list, 1);
    out.turning = unknown(1, count, list, 2);
    out.area = unknown(1, count, list, 3);
    out.mu = unknown(ranks, count, list, 4);
    out.theta = unknown(ranks, count, list, 5);
    for (i = 0; i < count; ++i) out.status[i] = SURFMINK_OK;
    if (dimension == 2)
        all = surfmink_plane(REAL(corner), (size_t)corners);
    else if (Rf_isNull(normal))
        all = surfmink_sphere(REAL(corner), (size_t)corners, Rf_asReal(radius));
    else
        all = surfmink_embedded(REAL(corner), REAL(normal), (size_t)corners);
    surfmink_batch(&all, at, (size_t)count, rank, &out, NULL);
    UNPROTECT(1);
    return list;
}

SEXP surfmink_r_status_name(SEXP status)
{
    R_xlen_t count = Rf_xlength(status), i;
    SEXP names = PROTECT(Rf_allocVector(STRSXP, count));
    for (i = 0; i < count; ++i) SET_STRING_ELT(names, i, Rf_mkChar(surfmink_status_name(INTEGER(status)[i])));
    UNPROTECT(1);
    return names;
}
