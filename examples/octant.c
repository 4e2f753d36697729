/* octant.c - a triangle with three right angles: is it a triangle or a square?

     cc octant.c -o octant -lm && ./octant */
#include <stdio.h>
#define SURFMINK_IMPLEMENTATION
#include "../surfmink.h"

int main(void)
{
    /* an eighth of the unit sphere; corners counter-clockwise, seen from outside */
    const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    surfmink_outline octant = surfmink_sphere(corner, 3, 1.0);
    double mu[7];
    int p, status = surfmink_measure(&octant, 6, mu, NULL, NULL, NULL);
    if (status != SURFMINK_OK) return puts(surfmink_strerror(status)), 1;
    for (p = 1; p <= 6; ++p) printf("mu_%d = %.6f\n", p, mu[p]);
    return 0; /* p = 3 says 1, and so does its multiple 6: a perfect triangle */
}
