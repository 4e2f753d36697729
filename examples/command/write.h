/* write.h - step 3 of the command: measures -> lines of a table, or JSON. */
#ifndef SURFMINK_COMMAND_WRITE_H
#define SURFMINK_COMMAND_WRITE_H

#include "measure.h"

/* One walk over the columns writes all three, so that names and values cannot get out of step. */
enum row { NAMES, VALUES, JSON_OBJECT };

typedef struct writer {
    enum row row;
    int digits;
    int columns; /* written so far in this row */
} writer;

/* What goes before the value. Does the value follow? */
static int begin_column(writer *w, const char *name)
{
    if (w->columns++ > 0) putchar(w->row == JSON_OBJECT ? ',' : '\t');
    if (w->row == NAMES) fputs(name, stdout);
    if (w->row == JSON_OBJECT) printf("\"%s\":", name);
    return w->row != NAMES;
}

static void put_word(writer *w, const char *name, const char *word)
{
    if (!begin_column(w, name)) return;
    if (w->row == JSON_OBJECT) putchar('"');
    put_text(stdout, word, w->row == JSON_OBJECT ? IN_JSON : IN_TABLE);
    if (w->row == JSON_OBJECT) putchar('"');
}

/* The value may be NULL: undefined. */
static void put_number(writer *w, const char *name, const double *value)
{
    if (!begin_column(w, name)) return;
    if (value && isfinite(*value))
        printf("%.*g", w->digits, *value);
    else if (w->row == JSON_OBJECT)
        fputs("null", stdout);
}

static void put_count(writer *w, const char *name, size_t count)
{
    if (begin_column(w, name)) printf("%lu", (unsigned long)count);
}

static void put_rank(writer *w, const char *name, int p, const double *value)
{
    char full_name[32];
    snprintf(full_name, sizeof full_name, "%s_%d", name, p);
    put_number(w, full_name, value);
}

/* The eigenvector n = 0 of +lambda_p in the plane or in space. */
static void put_direction(writer *w, int p, size_t dimensions, const measure *m)
{
    char name[32];
    double part;
    size_t k;
    int defined = m && m->has_frame && has_direction(m, p);
    for (k = 0; k < dimensions; ++k) {
        snprintf(name, sizeof name, "e_%d_%c", p, "xyz"[k]);
        part = defined ? cos(m->theta[p]) * m->frame[k] + sin(m->theta[p]) * m->frame[dimensions + k] : 0;
        put_number(w, name, defined ? &part : NULL);
    }
}

/* m is NULL for the line of names. */
static void write_row(const options *o, enum row row, int surface, const char *id, const measure *m)
{
    const measure *ok = m && m->status == SURFMINK_OK ? m : NULL;
    writer w;
    int p;
    w.row = row;
    w.digits = o->digits;
    w.columns = 0;
    if (row == JSON_OBJECT) putchar('{');
    put_word(&w, "id", id);
    put_count(&w, "n", m ? m->n : 0);
    put_word(&w, "status", m ? surfmink_status_name(m->status) : "");
    put_number(&w, "L", ok ? &ok->w.length : NULL);
    put_number(&w, "S", ok ? &ok->w.turning : NULL);
    put_number(&w, "area", ok && surface != EMBEDDED ? &ok->w.area : NULL);
    for (p = 1; p <= o->max_rank; ++p) put_rank(&w, "mu", p, ok ? ok->mu + p : NULL);
    for (p = 1; p <= o->max_rank; ++p) put_rank(&w, "theta", p, ok && has_direction(ok, p) ? ok->theta + p : NULL);
    for (p = 1; p <= o->max_rank && o->directions; ++p) put_direction(&w, p, stride_of(surface), ok);
    fputs(row == JSON_OBJECT ? "}\n" : "\n", stdout);
}

#endif
