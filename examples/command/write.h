/* write.h - step 4 of the command: measures -> lines of a table, or JSON, or the columns that a picture shows. */
#ifndef SURFMINK_COMMAND_WRITE_H
#define SURFMINK_COMMAND_WRITE_H

#include "measure.h"
#include "number.h"

/* One walk over the columns does all of these, so that names and values cannot get out of step: it writes a row, or finds
   columns by their names, or takes their values. */
enum row { NAMES, VALUES, JSON_OBJECT, FIND, TAKE };

/* A column of numbers that a picture shows. */
typedef struct pick {
    const quantity *what;
    int column;   /* counted from 1; 0: there is none of that name */
    double value; /* of the polygon; NaN: undefined */
} pick;

typedef struct writer {
    FILE *out;
    enum row row;
    int digits;
    const powers_of_ten *powers;
    int columns; /* written so far in this row */
    pick *pick;
    int picks;
} writer;

/* L, mu_3 or e_3_x: without a rank p is 0, without an axis it is 0. */
static void make_name(char text[64], const char *name, int p, char axis)
{
    int length = snprintf(text, 48, "%s", name);
    if (p > 0) length += snprintf(text + length, 13, "_%d", p);
    if (axis) snprintf(text + length, 3, "_%c", axis);
}

static void find_pick(writer *w, const char *name, int p, char axis)
{
    char text[64];
    int i;
    make_name(text, name, p, axis);
    for (i = 0; i < w->picks; ++i)
        if (strcmp(w->pick[i].what->name, text) == 0) w->pick[i].column = w->columns;
}

static void take_value(writer *w, double value)
{
    int i;
    for (i = 0; i < w->picks; ++i)
        if (w->pick[i].column == w->columns) w->pick[i].value = value;
}

/* What goes before the value. Does the value follow? */
static int begin_column(writer *w, const char *name, int p, char axis)
{
    char text[64];
    if (w->columns++ > 0 && w->out) putc(w->row == JSON_OBJECT ? ',' : '\t', w->out);
    if (w->row == VALUES || w->row == TAKE) return 1;
    if (w->row == FIND) return 0;
    if (w->row == JSON_OBJECT) putc('"', w->out);
    make_name(text, name, p, axis);
    fputs(text, w->out);
    if (w->row == JSON_OBJECT) fputs("\":", w->out);
    return w->row != NAMES;
}

static void put_word(writer *w, const char *name, const char *word)
{
    if (!begin_column(w, name, 0, 0) || w->row == TAKE) return;
    if (w->row == JSON_OBJECT) putc('"', w->out);
    put_text(w->out, word, w->row == JSON_OBJECT ? IN_JSON : IN_TABLE);
    if (w->row == JSON_OBJECT) putc('"', w->out);
}

/* The value may be NULL: undefined. */
static void put_number(writer *w, const char *name, int p, char axis, const double *value)
{
    char text[32];
    int follows = begin_column(w, name, p, axis);
    if (w->row == FIND) find_pick(w, name, p, axis);
    if (w->row == TAKE) take_value(w, value && isfinite(*value) ? *value : (double)NAN);
    if (!follows || w->row == TAKE) return;
    if (value && isfinite(*value))
        fwrite(text, 1, (size_t)(write_number(w->powers, text, w->digits, *value) - text), w->out);
    else if (w->row == JSON_OBJECT)
        fputs("null", w->out);
}

static void put_count(writer *w, const char *name, size_t count)
{
    int follows = begin_column(w, name, 0, 0);
    if (w->row == FIND) find_pick(w, name, 0, 0);
    if (w->row == TAKE) take_value(w, (double)count);
    if (follows && w->row != TAKE) fprintf(w->out, "%lu", (unsigned long)count);
}

/* The eigenvector n = 0 of +lambda_p in the plane or in space. */
static void put_direction(writer *w, int p, size_t dimensions, const measure *m)
{
    double part;
    size_t k;
    int defined = m && m->has_frame && has_direction(m, p);
    for (k = 0; k < dimensions; ++k) {
        part = defined ? cos(m->theta[p]) * m->frame[k] + sin(m->theta[p]) * m->frame[dimensions + k] : 0;
        put_number(w, "e", p, "xyz"[k], defined ? &part : NULL);
    }
}

/* The same at the centre, and how well the edges agree about it. */
static void put_directors(writer *w, int max_rank, size_t dimensions, const measure *m)
{
    const measure *ok = m && m->has_director ? m : NULL;
    size_t k;
    int p;
    for (k = 0; k < dimensions; ++k) put_number(w, "center", 0, "xyz"[k], ok ? ok->centre + k : NULL);
    for (p = 1; p <= max_rank; ++p) {
        const double *e = ok && has_director(ok, p) ? ok->direction + dimensions * (size_t)p : NULL;
        for (k = 0; k < dimensions; ++k) put_number(w, "e", p, "xyz"[k], e ? e + k : NULL);
    }
    for (p = 1; p <= max_rank; ++p) put_number(w, "coherence", p, 0, ok ? ok->coherence + p : NULL);
}

/* m is NULL for the names. */
static void walk_columns(writer *w, const options *o, int surface, const char *id, const measure *m)
{
    const measure *ok = m && m->status == SURFMINK_OK ? m : NULL;
    int p;
    if (o->files > 1) put_word(w, "file", current_file);
    put_word(w, "id", id);
    put_count(w, "n", m ? m->n : 0);
    put_word(w, "status", m ? status_name(m->status) : "");
    put_number(w, "L", 0, 0, ok ? &ok->length : NULL);
    put_number(w, "S", 0, 0, ok ? &ok->turning : NULL);
    put_number(w, "area", 0, 0, ok ? &ok->area : NULL);
    for (p = 1; p <= o->max_rank; ++p) put_number(w, "mu", p, 0, ok ? ok->mu + p : NULL);
    if (o->error) put_number(w, "error_L", 0, 0, ok ? ok->error : NULL);
    for (p = 1; p <= o->max_rank && o->error; ++p) put_number(w, "error", p, 0, ok ? ok->error + p : NULL);
    for (p = 1; p <= o->max_rank; ++p) put_number(w, "theta", p, 0, ok && has_direction(ok, p) ? ok->theta + p : NULL);
    for (p = 1; p <= o->max_rank && o->noise; ++p) put_number(w, "sigma", p, 0, ok && ok->sigma ? ok->sigma + p : NULL);
    for (p = 1; p <= o->max_rank && o->directions == AT_FIRST_EDGE; ++p) put_direction(w, p, stride_of(surface), ok);
    if (o->directions == AT_CENTER) put_directors(w, o->max_rank, stride_of(surface), ok);
}

static void write_row(FILE *out, const options *o, const powers_of_ten *powers, enum row row, int surface,
                      const char *id, const measure *m)
{
    writer w = {NULL, NAMES, 0, NULL, 0, NULL, 0};
    w.out = out;
    w.row = row;
    w.digits = o->digits;
    w.powers = powers;
    if (row == JSON_OBJECT) putc('{', out);
    walk_columns(&w, o, surface, id, m);
    fputs(row == JSON_OBJECT ? "}\n" : "\n", out);
}

/* Where the columns are, by their names. */
static void find_picks(pick *list, int count, const options *o, int surface)
{
    writer w = {NULL, FIND, 0, NULL, 0, NULL, 0};
    int i;
    w.pick = list;
    w.picks = count;
    for (i = 0; i < count; ++i) list[i].column = 0;
    walk_columns(&w, o, surface, "", NULL);
}

/* Their values for a polygon. */
static void take_picks(pick *list, int count, const options *o, int surface, const measure *m)
{
    writer w = {NULL, TAKE, 0, NULL, 0, NULL, 0};
    int i;
    w.pick = list;
    w.picks = count;
    for (i = 0; i < count; ++i) list[i].value = (double)NAN;
    walk_columns(&w, o, surface, "", m);
}

#endif
