/* curve.c - instructions a corner of examples/beyond/curve.h, for the table in docs/internals/beyond.md.

     cc -std=c99 -O2 -I. tests/bench/curve.c -o curve -lm && sh tests/bench/count_curve.sh ./curve

     ./curve plane|sphere|embedded WHAT CALLS

   Outlines of 1000 corners, mu_0 .. mu_6. What: 0 surfmink_measure, 1 order 4, 2 order 2 with errors, 3 order 4 with
   errors. */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "../../examples/beyond/curve.h"
#include "../shapes.h"

#include <stdio.h>
#include <stdlib.h>

enum { N = 1000, P = 6 };

int main(int argc, char **argv)
{
    static double corner[3 * N], normal[3 * N], scratch[SURFMINK_CURVE_SCRATCH(N, P)];
    double mu[P + 1], error[P + 1];
    surfmink_curve_options options = {4, NULL, 0, NULL};
    surfmink_curve_results out = {NULL, NULL, NULL, NULL};
    surfmink_outline o;
    chance c = {1};
    wobble w;
    int where, what, calls, status = SURFMINK_OK;
    if (argc != 4) return 1;
    where = argv[1][0] == 'p' ? IN_THE_PLANE : argv[1][0] == 's' ? ON_A_SPHERE : ON_AN_ELLIPSOID;
    what = atoi(argv[2]);
    w = some_wobble(&c, where);
    wobble_points(&w, N, corner, normal);
    o = surfmink_embedded(corner, normal, N);
    if (where == IN_THE_PLANE) o = surfmink_plane(corner, N);
    if (where == ON_A_SPHERE) o = surfmink_sphere(corner, N, 1);
    options.order = what == 2 ? 2 : 4;
    out.mu = mu;
    if (what >= 2) out.error = error;
    for (calls = atoi(argv[3]); calls > 0 && status == SURFMINK_OK; --calls)
        status =
            what ? surfmink_curve(&o, &options, P, scratch, &out, NULL) : surfmink_measure(&o, P, mu, NULL, NULL, NULL);
    puts(surfmink_curve_strerror(status));
    return status != SURFMINK_OK;
}
