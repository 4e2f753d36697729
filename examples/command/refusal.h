/* refusal.h - step 4 of the command: why an outline was not measured, for standard error. */
#ifndef SURFMINK_COMMAND_REFUSAL_H
#define SURFMINK_COMMAND_REFUSAL_H

#include "measure.h"

/* What the user could do about it. */
static const char *advice(const measure *m, const options *o)
{
    switch (m->status) {
    case SURFMINK_CLOCKWISE:
        if (o->reverse == REVERSE_ALWAYS) return "; --reverse auto reverses only such outlines";
        if (m->surface == SPHERE)
            return "; --reverse auto measures the other side of such outlines; or were lon and lat exchanged?";
        if (m->surface != PLANE) return "; --reverse auto reverses such outlines; or normals point inwards";
        return m->is_mirrored ? "; --reverse auto reverses such outlines"
                              : "; --reverse auto reverses such outlines; if y points down, as in images, use "
                                "--y-down instead: it also keeps directions right";
    case SURFMINK_OPPOSITE_NORMALS:
        return m->has_means ? ": they are means over faces, and these meet too sharply here; a finer mesh helps, or "
                              "one with normals of its own"
                            : ": one of them may be flipped";
    case SURFMINK_COINCIDENT_CORNERS: return "; --merge drops one of them, --repair also seams and spikes";
    case SURFMINK_TOO_FEW_CORNERS:
        return m->n == 1 && !o->id
                   ? "; if every row has an id of its own, --id names the columns that outlines have in "
                     "common"
                   : "";
    case SURFMINK_BAD_ARGUMENT:
        return ": a latitude lies between -90 and 90, a longitude within 1e6 degrees; x y of a map want --surface "
               "plane";
    case FAULT_SEVERAL_RINGS:
        return o->parts ? "" : "; --parts makes each ring an outline, --repair takes spikes and seams out";
    case FAULT_SEAM: return "; --parts makes each ring an outline";
    case FAULT_SPIKE: return "; --repair takes it out";
    case FAULT_SHORT_EDGE: return "; --merge 1e-6L drops such corners";
    default: return "";
    }
}

/* The reason of a refusal. On a sphere every outline runs counter-clockwise about one of its sides; where edges that
   cross have been found, nothing had to contradict each other. */
static const char *reason(const measure *m)
{
    if (m->status == SURFMINK_CLOCKWISE && m->surface == SPHERE) return "the left side is more than a hemisphere";
    if (m->status == SURFMINK_CROSSES_ITSELF && m->crossing[0] < m->n) return "the outline crosses itself";
    return status_text(m->status);
}

/* Which edges cross. Those of a face stand on one line, and are counted. */
static const char *name_crossing(const measure *m, char *text, size_t size)
{
    if (m->crossing_line[0] == m->crossing_line[1])
        snprintf(text, size, "its edges %lu and %lu (from 0) cross", (unsigned long)m->crossing[0],
                 (unsigned long)m->crossing[1]);
    else
        snprintf(text, size, "the edges from lines %lu and %lu cross", m->crossing_line[0], m->crossing_line[1]);
    return text;
}

/* What takes a spike out. */
static const char *name_remedy(const measure *m, char *text, size_t size)
{
    if (m->hint_width <= nearly_closed)
        snprintf(text, size, "--repair");
    else
        snprintf(text, size, "--repair --merge %.0eL", 2 * m->hint_width);
    return text;
}

/* What is to be said about an outline that has been measured. */
static void warn_about(const char *name, const measure *m, const options *o)
{
    char crossing[100], remedy[60];
    if (m->status != SURFMINK_OK) return;
    if (m->crossing[0] < m->n && warns(WARN_CROSSING))
        remark("%s:%lu: %s: %s as seen from above; the normals differ too much to tell whether they do on the surface",
               name, m->crossing_line[0], m->id, name_crossing(m, crossing, sizeof crossing));
    if (m->hint_line && warns(WARN_SPIKE))
        remark("%s:%lu: %s: the outline goes there and back at this corner, a spike, of which both sides count; "
               "%s takes it out",
               name, m->hint_line, m->id, name_remedy(m, remedy, sizeof remedy));
    if (m->surface == SPHERE && (m->reversed || o->reverse == REVERSE_ALWAYS) && warns(WARN_SIDE))
        remark("%s:%lu: %s: turned round: measured is the side to the right of the corners in the file, less than a "
               "hemisphere",
               name, m->line, m->id);
}

static void write_refusal(FILE *out, const char *name, const measure *m, const options *o)
{
    int crosses = m->status == SURFMINK_CROSSES_ITSELF && m->crossing[0] < m->n;
    unsigned long line = m->hint_line ? m->hint_line : crosses ? m->crossing_line[0] : m->line;
    char crossing[100], remedy[60];
    put_harmless(out, name);
    if (line > 0) fprintf(out, ":%lu", line);
    fputs(": ", out);
    put_harmless(out, m->id);
    fprintf(out, ": %s", reason(m));
    if (crosses) fprintf(out, ": %s", name_crossing(m, crossing, sizeof crossing));
    if (m->hint_line && m->hint_edge > 0)
        fprintf(out, "; the edge that ends here is only %.1g of the perimeter long: --merge %.0eL drops it",
                m->hint_edge, 10 * m->hint_edge);
    else if (m->hint_line)
        fprintf(out, "; the outline goes there and back at this corner, a spike: %s takes it out",
                name_remedy(m, remedy, sizeof remedy));
    else
        fputs(advice(m, o), out);
    fputc('\n', out);
}

#endif
