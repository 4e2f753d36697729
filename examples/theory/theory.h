/* theory.h - what the programs of this directory share. Each draws one picture of docs/internals/theory.md and
   prints the numbers behind it:

     plot p;
     if (theory_begin(&p, argc, argv, "pixels", 700, 300)) return 1;   // argv[1] is the directory of pixels.svg
     theory_need(status);                                              // ends the program if something was refused
     return plot_end(&p);                                                                                             */
#ifndef THEORY_H
#define THEORY_H

#include "../picture/plot.h"

#include <stdlib.h>

/* Opens DIRECTORY/NAME.svg. Returns 0, or 1 after saying what is wrong. */
static inline int theory_begin(plot *p, int argc, char **argv, const char *name, double width, double height)
{
    char path[512];
    if (argc != 2 || strlen(argv[1]) > 400) {
        fprintf(stderr, "usage: %s DIRECTORY\nwrites DIRECTORY/%s.svg, and the numbers behind it to standard output\n",
                argv[0], name);
        return 1;
    }
    snprintf(path, sizeof path, "%s/%s.svg", argv[1], name);
    return plot_begin(p, path, width, height);
}

/* Outlines here are meant to be measured. */
static inline void theory_need(int status)
{
    if (status == SURFMINK_OK) return;
    fprintf(stderr, "%s\n", surfmink_strerror(status));
    exit(1);
}

/* mu_1 ... mu_ranks as bars in a box, with the scale at its left. Of boxes in a row the first names both axes. */
static inline void theory_bars(plot *p, const double *mu, int ranks, double left, double top, double width,
                               double height, int first)
{
    plot_axes axes = {0, 0, 0, 0, {0, 1}, {0, 1}, {0, 0}};
    axes.left = left;
    axes.top = top;
    axes.width = width;
    axes.height = height;
    plot_ticks(p, &axes, 1, 1, "");
    plot_bars(p, &axes, mu, 1, ranks, 9);
    if (!first) return;
    plot_text_as(p, left - 9, top + height / 2, 11, AT_MIDDLE, "#000000", 0, 1, "$\\mu_p$");
    plot_text(p, left + width + 6, top + height + 10, 9, AT_MIDDLE, "$p$");
}

#endif /* THEORY_H */
