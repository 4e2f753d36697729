/* gradient.c - instructions a corner of examples/beyond/gradient.h, for docs/internals/beyond.md.

     cc -std=c99 -O2 -I. tests/bench/gradient.c -o gradient -lm
     for way in plane sphere embedded; do for n in 6 40 1000; do for P in 6 12; do for what in 0 1; do
       for calls in 0 10; do
         valgrind --tool=callgrind --callgrind-out-file=/dev/null ./gradient $way $n $P $what $calls 2>&1 |
           grep Collected
       done; done; done; done; done        the difference, over 10 n, is instructions a corner

   What: 0 surfmink_measure (mu, g and functionals), 1 surfmink_gradient (the same, and the gradient by all corners and
   normals, for weights of all mu_p and of L). */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "../../examples/beyond/gradient.h"
#include "../shapes.h"

#include <stdio.h>
#include <stdlib.h>

enum { MOST_CORNERS = 1000, MOST_RANK = 12 };

int main(int argc, char **argv)
{
    static double corner[3 * MOST_CORNERS], normal[3 * MOST_CORNERS], by_corner[3 * MOST_CORNERS];
    static double by_normal[3 * MOST_CORNERS], scratch[4 * MOST_CORNERS + 2 * MOST_RANK + 2];
    double mu[MOST_RANK + 1], g[2 * MOST_RANK + 2], by_mu[MOST_RANK + 1], by_length = 0.3;
    surfmink_functionals w;
    surfmink_weights weights = {NULL, NULL, NULL, NULL, 0};
    surfmink_gradients out = {NULL, NULL, NULL, NULL, NULL, NULL, NULL};
    surfmink_outline o;
    chance c = {1};
    wobble curve;
    int where, n, rank, what, calls, p, status = SURFMINK_OK;
    if (argc != 6) return 1;
    where = argv[1][0] == 'p' ? IN_THE_PLANE : argv[1][0] == 's' ? ON_A_SPHERE : ON_AN_ELLIPSOID;
    n = atoi(argv[2]);
    rank = atoi(argv[3]);
    what = atoi(argv[4]);
    if (n < 3 || n > MOST_CORNERS || rank < 0 || rank > MOST_RANK) return 1;
    curve = some_wobble(&c, where);
    wobble_points(&curve, (size_t)n, corner, normal);
    o = surfmink_embedded(corner, normal, (size_t)n);
    if (where == IN_THE_PLANE) o = surfmink_plane(corner, (size_t)n);
    if (where == ON_A_SPHERE) o = surfmink_sphere(corner, (size_t)n, 1);
    for (p = 0; p <= rank; ++p) by_mu[p] = 1.0 / (p + 1);
    weights.mu = by_mu;
    weights.length = &by_length;
    out.mu = mu;
    out.g = g;
    out.w = &w;
    out.by_corner = by_corner;
    out.by_normal = by_normal;
    for (calls = atoi(argv[5]); calls > 0 && status == SURFMINK_OK; --calls)
        status =
            what ? surfmink_gradient(&o, rank, &weights, &out, scratch) : surfmink_measure(&o, rank, mu, g, &w, NULL);
    puts(surfmink_strerror(status));
    return status != SURFMINK_OK;
}
