/* experiment.h - what the programs of this directory share: results in two files, computed beside printed, one verdict.

     experiment e;
     if (experiment_begin(&e, argc, argv, "torus")) return 1;   // argv[1] is the directory of torus.svg and torus.tsv
     experiment_near(&e, "mu_3 at 0.6 pi", mu[3], 0.998924059012, 1e-11);
     experiment_printed(&e, "|L - L_q|, q = 4", "8.6e-01", 1, error);
     return experiment_end(&e);                                 // 1 if anything did not come out as printed

   Printed numbers live in data/ beside this file. Programs look for it from the root of the repository, or where
   argv[2] says.                                                                                                      */
#ifndef EXPERIMENT_H
#define EXPERIMENT_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

typedef struct experiment {
    const char *name, *data;
    char figure[512];
    FILE *table;
    int agree, differ;
} experiment;

/* Opens the table and makes the name of the figure. Returns 0, or 1 after saying what is wrong. */
static inline int experiment_begin(experiment *e, int argc, char **argv, const char *name)
{
    char path[512];
    if (argc < 2 || argc > 3 || strlen(argv[1]) > 400) {
        fprintf(stderr,
                "usage: %s DIRECTORY [DATA]\nwrites DIRECTORY/%s.svg and .tsv; DATA: default examples/paper/data\n",
                argv[0], name);
        return 1;
    }
    e->name = name;
    e->data = argc == 3 ? argv[2] : "examples/paper/data";
    e->agree = e->differ = 0;
    snprintf(e->figure, sizeof e->figure, "%s/%s.svg", argv[1], name);
    snprintf(path, sizeof path, "%s/%s.tsv", argv[1], name);
    e->table = fopen(path, "w");
    if (!e->table) perror(path);
    return e->table == NULL;
}

/* Something that has to go well for the rest to mean anything. */
static inline void experiment_need(int well, const char *what)
{
    if (well) return;
    fprintf(stderr, "%s\n", what);
    exit(1);
}

static inline int experiment__note(experiment *e, int well)
{
    if (well)
        ++e->agree;
    else
        ++e->differ;
    return well;
}

/* Is a computed number within a distance of the one that is printed? NaN never is. Says so only if not. */
static inline int experiment_near(experiment *e, const char *what, double computed, double printed, double within)
{
    if (fabs(computed - printed) <= within) return experiment__note(e, 1);
    printf("\nDIFFERS  %s: computed %.15g, printed %.15g, allowed %.1e\n", what, computed, printed, within);
    return experiment__note(e, 0);
}

/* Does a computed number, rounded like the printed one, read the same? exponent: as 1.2e-03, else as 0.00. */
static inline int experiment_printed(experiment *e, const char *what, const char *printed, int exponent,
                                     double computed)
{
    char text[32];
    snprintf(text, sizeof text, exponent ? "%.1e" : "%.2f", computed);
    if (strcmp(text, printed) == 0) return experiment__note(e, 1);
    printf("\nDIFFERS  %s: computed %s (%.6g), printed %s\n", what, text, computed, printed);
    return experiment__note(e, 0);
}

/* A sentence of the text that must hold. */
static inline int experiment_claim(experiment *e, const char *sentence, int holds)
{
    printf("%-8s %s\n", holds ? "holds" : "DIFFERS", sentence);
    return experiment__note(e, holds);
}

static inline int experiment_end(experiment *e)
{
    int failed = ferror(e->table);
    failed = fclose(e->table) != 0 || failed;
    printf("%s: %d of %d values and claims hold%s\n\n", e->name, e->agree, e->agree + e->differ,
           failed ? ", but the table could not be written" : "");
    return failed || e->differ > 0;
}

/* --- tables of printed numbers ------------------------------------------------------------------------------------ */

/* A small table: tab separated, # for notes, the first other line names the columns. */
typedef struct printed {
    int rows, columns;
    char name[48][32];
    char text[48][48][28];
} printed;

static inline int printed__split(char *line, char field[48][32], size_t room)
{
    int count = 0;
    line[strcspn(line, "\r\n")] = 0;
    for (; line && count < 48; ++count) {
        char *tab = strchr(line, '\t');
        if (tab) *tab = 0;
        if (strlen(line) >= room) return 0;
        strcpy(field[count], line);
        line = tab ? tab + 1 : NULL;
    }
    return line ? 0 : count;
}

static inline void printed_read(printed *t, const experiment *e, const char *file)
{
    char path[512], line[4096], field[48][32];
    FILE *in;
    int k, columns;
    snprintf(path, sizeof path, "%s/%s", e->data, file);
    in = fopen(path, "r");
    if (!in) perror(path);
    experiment_need(in != NULL, "run from the root of the repository, or give the directory of the data");
    t->rows = t->columns = 0;
    while (fgets(line, sizeof line, in)) {
        if (line[0] == '#' || line[0] == '\n') continue;
        columns = printed__split(line, field, t->columns ? 28 : 32);
        if (!t->columns) {
            t->columns = columns;
            memcpy(t->name, field, sizeof field);
            continue;
        }
        experiment_need(columns == t->columns && t->rows < 48, "a table of printed numbers is malformed");
        for (k = 0; k < columns; ++k) strcpy(t->text[t->rows][k], field[k]);
        ++t->rows;
    }
    fclose(in);
}

static inline const char *printed_text(const printed *t, int row, const char *column)
{
    int k;
    for (k = 0; k < t->columns; ++k)
        if (strcmp(t->name[k], column) == 0) return t->text[row][k];
    experiment_need(0, "a column of a table of printed numbers is missing");
    return "";
}

static inline double printed_number(const printed *t, int row, const char *column)
{
    const char *text = printed_text(t, row, column);
    char *end;
    double value = strtod(text, &end);
    return end > text && !*end ? value : (double)NAN;
}

/* mu_3, err4, ...: a column whose name ends with a number. */
static inline double printed_rank(const printed *t, int row, const char *column, int p)
{
    char name[32];
    snprintf(name, sizeof name, "%s%d", column, p);
    return printed_number(t, row, name);
}

#endif /* EXPERIMENT_H */
