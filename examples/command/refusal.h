/* refusal.h - step 4 of the command: why an outline was not measured, for standard error. */
#ifndef SURFMINK_COMMAND_REFUSAL_H
#define SURFMINK_COMMAND_REFUSAL_H

#include "measure.h"

/* What the user could do about it. */
static const char *advice(int status, const options *o)
{
    switch (status) {
    case SURFMINK_CLOCKWISE:
        return o->reverse == REVERSE_ALWAYS ? "; --reverse auto turns only such outlines round"
                                            : "; --reverse auto turns such outlines round";
    case SURFMINK_OPPOSITE_NORMALS: return ": one of them may be flipped";
    case SURFMINK_COINCIDENT_CORNERS: return "; --merge drops one of them";
    case SURFMINK_BAD_ARGUMENT: return ": a latitude lies between -90 and 90, a longitude within 1e6 degrees";
    default: return "";
    }
}

static void write_refusal(FILE *out, const char *name, const measure *m, const options *o)
{
    fprintf(out, "%s:%lu: %s%s\n", name, m->line, surfmink_curve_strerror(m->status), advice(m->status, o));
}

#endif
