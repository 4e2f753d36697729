/* table.h - reads the tables in tests/data. Include it after shapes.h.

   Tab separated, `#` lines are notes, the first other line names the columns.

   Columns are asked for by name. A file or column that is missing ends the program with a sentence, for then nothing
   that follows would mean anything. */
#ifndef TABLE_H
#define TABLE_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct table {
    FILE *file;
    const char *path;
    int columns, fields;
    char header[4096], row[4096];
    char *name[64], *field[64];
} table;

static inline void table_fails(const table *t, const char *what)
{
    printf("%s: %s\n", t->path, what);
    exit(1);
}

static inline int table_split(char *line, char **part)
{
    int count = 0;
    line[strcspn(line, "\r\n")] = '\0';
    while (line && count < 64) {
        part[count++] = line;
        line = strchr(line, '\t');
        if (line) *line++ = '\0';
    }
    return count;
}

/* The next row; 0 at the end, where the file is closed. */
static inline int table_next(table *t)
{
    while (fgets(t->row, sizeof t->row, t->file)) {
        if (t->row[0] == '#' || t->row[0] == '\n') continue;
        t->fields = table_split(t->row, t->field);
        if (t->columns && t->fields != t->columns) table_fails(t, "a row has too few or too many columns");
        return 1;
    }
    fclose(t->file);
    return 0;
}

static inline void table_open(table *t, const char *path)
{
    t->path = path;
    t->columns = 0;
    t->file = fopen(path, "r");
    if (!t->file) table_fails(t, "cannot be read (the tests run from the root of the repository)");
    if (!table_next(t)) table_fails(t, "no columns");
    memcpy(t->header, t->row, sizeof t->header);
    for (t->columns = 0; t->columns < t->fields; ++t->columns)
        t->name[t->columns] = t->header + (t->field[t->columns] - t->row);
}

static inline const char *table_text(const table *t, const char *column)
{
    int k;
    for (k = 0; k < t->columns; ++k)
        if (strcmp(t->name[k], column) == 0) return t->field[k];
    printf("%s: ", column);
    table_fails(t, "there is no such column");
    return "";
}

static inline double table_number(const table *t, const char *column)
{
    const char *text = table_text(t, column);
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end) {
        printf("%s = %s: ", column, text);
        table_fails(t, "this is not a number");
    }
    return value;
}

/* mu_3, theta_3, ... */
static inline double table_rank(const table *t, const char *column, int p)
{
    char name[32];
    snprintf(name, sizeof name, "%s%d", column, p);
    return table_number(t, name);
}

/* Reads the rows of one case of a table of points: dim columns from names[], one corner after the other. Returns how
   many. */
static inline size_t table_points(const char *path, const char *which, const char *const *names, int dim, size_t most,
                                  double *out)
{
    table t;
    size_t n = 0;
    int k;
    table_open(&t, path);
    while (table_next(&t)) {
        if (strcmp(table_text(&t, "case"), which) != 0) continue;
        if (n == most) table_fails(&t, "a polygon has too many corners");
        for (k = 0; k < dim; ++k) out[n * (size_t)dim + (size_t)k] = table_number(&t, names[k]);
        ++n;
    }
    if (n == 0) table_fails(&t, "no points for a case of the reference table");
    return n;
}

/* A flower as the tables describe it: "a;b;c" of the surface and "u0=..;v0=..;r0=..;a=..;w=.." of the curve. */
static inline void table_flower(const table *t, flower *f)
{
    memset(f, 0, sizeof *f);
    f->surface.kind = strcmp(table_text(t, "surface"), "tor") == 0 ? TORUS : ELLIPSOID;
    if (sscanf(table_text(t, "params"), "%lf;%lf;%lf", &f->surface.a, &f->surface.b, &f->surface.c) < 2 ||
        sscanf(table_text(t, "curve"), "u0=%lf;v0=%lf;r0=%lf;a=%lf;w=%d", &f->u0, &f->v0, &f->r0, &f->a, &f->petals) !=
            5)
        table_fails(t, "this is not a flower");
}

#endif
