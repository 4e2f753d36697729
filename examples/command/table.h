/* table.h - step 1 of the command: lines of a table -> polygons, one at a time. */
#ifndef SURFMINK_COMMAND_TABLE_H
#define SURFMINK_COMMAND_TABLE_H

#include "columns.h"
#include "polygon.h"
#include "seen.h"

/* If the radii of corners differ by a larger factor there is no sphere, or its centre is not the origin; those of
   segmented organs differ by less. */
static const double MOST_UNLIKE = 1.5;

typedef struct table {
    lines *in;
    char separator;
    column_list columns;
    char decimal;           /* '.' or ',' once a number has had one; \0 before */
    double down;            /* -1: y points down in the file */
    int shift;              /* the row names of R have no name: fields are one place further on */
    int has_row;            /* the line that ended a polygon, or came with --columns, is yet to be taken */
    int by_columns;         /* --columns: the file has no names */
    int by_lines;           /* it has none, and x,y,x,y,... on each line: an outline a line */
    unsigned long polygons; /* so far */
    unsigned long rows;
    char *id; /* of the row at hand; and what the first unnamed column had in the first row */
    size_t id_room;
    char *first;
    size_t first_room;
    char **begun_with; /* what each column that is not looked at had when the polygon began; NULL once it is told */
    size_t *begun_room;
    seen_ids seen;
    double nearest, farthest; /* of the corners of a sphere from its middle */
} table;

/* --- the line that names the columns ------------------------------------------------------------------------------ */

/* What stands between the fields: the first of these outside of quotes, else blanks. */
static char find_separator_of(const char *text)
{
    static const char candidate[] = "\t;,";
    const char *c, *s;
    for (c = candidate; *c; ++c) {
        int quoted = 0;
        for (s = text; *s; ++s) {
            if (*s == '"') quoted = !quoted;
            if (*s == *c && !quoted) return *c;
        }
    }
    return ' ';
}

/* Lines of x,y,x,y,... without names, as Cellpose writes them? */
static int is_by_lines(const table *t, const options *o)
{
    const lines *in = t->in;
    size_t i;
    double number;
    if (o->columns || o->id || t->separator != ',' || in->fields < 6) return 0;
    for (i = 0; i < in->fields; ++i)
        if (!parse_number(in->powers, in->field[i], &number)) return 0;
    if (o->surface != PLANE && o->surface != AS_THE_COLUMNS_SAY) return 0;
    return 1;
}

static void read_header(table *t, lines *in, const options *o)
{
    memset(t, 0, sizeof *t);
    t->in = in;
    do
        if (!read_line(in)) die("%s: no line names the columns", in->name);
    while (is_blank_line(in->text) || is_comment(in->text) || *in->text == '>' || strncmp(in->text, "sep=", 4) == 0);
    trim_end(in->text);
    t->separator = find_separator_of(in->text);
    split_line(in, t->separator);
    if (is_by_lines(t, o)) {
        remark("%s: no names, and x,y,x,y,... on each line: each line is an outline%s; if these are columns, --columns "
               "names them",
               in->name, o->y_down ? "" : "; --y-down if y counts rows of an image");
        t->by_lines = t->has_row = 1;
        t->columns.layout = &layout_plane;
        t->down = o->y_down ? -1 : 1;
        return;
    }
    read_columns(&t->columns, in, o);
    if (o->y_down && t->columns.layout->surface == SPHERE)
        die("%s: --y-down is for x y of an image, not for a sphere", in->name);
    t->by_columns = t->has_row = o->columns != NULL;
    t->down = o->y_down || (has(&t->columns, COLUMN_ROW) && t->columns.place[COLUMN_ROW] == t->columns.place[COLUMN_Y])
                  ? -1
                  : 1;
    t->begun_with = (char **)resize(NULL, t->columns.names + 1, sizeof *t->begun_with);
    t->begun_room = (size_t *)resize(NULL, t->columns.names + 1, sizeof *t->begun_room);
    memset(t->begun_with, 0, (t->columns.names + 1) * sizeof *t->begun_with);
    memset(t->begun_room, 0, (t->columns.names + 1) * sizeof *t->begun_room);
}

static void free_table(table *t)
{
    size_t i;
    for (i = 0; t->begun_with && i < t->columns.names; ++i) free(t->begun_with[i]);
    free(t->begun_with);
    free(t->begun_room);
    free(t->id);
    free(t->first);
    free_seen(&t->seen);
    free_columns(&t->columns);
}

/* --- the lines below ---------------------------------------------------------------------------------------------- */

static const char *field_at(const table *t, size_t place, const char *name)
{
    if (place + (size_t)t->shift >= t->in->fields) malformed(t->in, "no field for column '%s'", name);
    return t->in->field[place + (size_t)t->shift];
}

/* Could the comma stand between thousands: 1,234? */
static int has_thousands(const char *field)
{
    size_t before;
    if (*field == '-' || *field == '+') ++field;
    before = strspn(field, "0123456789");
    return before >= 1 && before <= 3 && *field != '0' && strlen(field) == before + 4;
}

/* A number with a decimal comma, where commas do not separate. A file has points or commas, not both. */
static int parse_with_comma(table *t, const char *field, double *number)
{
    char text[64], *comma;
    if (t->separator != ';' && t->separator != '\t') return 0;
    if (strlen(field) >= sizeof text) return 0;
    strcpy(text, field);
    comma = strchr(text, ',');
    if (!comma || strchr(text, '.') || strchr(comma + 1, ',')) return 0;
    *comma = '.';
    if (!parse_number(t->in->powers, text, number)) return 0;
    if (t->decimal == '.') malformed(t->in, "'%s' has a decimal comma, numbers before it a point", field);
    if (t->decimal == '\0' && has_thousands(field) && warns(WARN_COMMA))
        remark("%s:%lu: %s is read as %s: a decimal comma, not one between thousands", t->in->name, t->in->number,
               field, text);
    t->decimal = ',';
    return 1;
}

static double number_at(table *t, enum column k)
{
    const char *name = column_name[k][0], *field = field_at(t, t->columns.place[k], name);
    double number;
    if (*field == '\0') malformed(t->in, "column '%s' is empty", name);
    if (parse_number(t->in->powers, field, &number)) {
        if (t->separator != ';' && t->separator != '\t') return number;
        if (t->decimal == ',' && strchr(field, '.'))
            malformed(t->in, "'%s' has a decimal point, numbers before it a comma", field);
        if (t->decimal == '\0' && strchr(field, '.')) t->decimal = '.';
        return number;
    }
    if (parse_with_comma(t, field, &number)) return number;
    if (t->by_columns && t->rows == 0)
        malformed(t->in, "'%s' in column '%s' is not a number; --columns is for files without a line of names", field,
                  name);
    malformed(t->in, "'%s' in column '%s' is not a number", field, name);
}

/* More fields than names: row names of R, an id with blanks, or a table that changes its mind. */
static void check_fields(table *t)
{
    size_t i, names = t->columns.names;
    if (t->rows == 0 && !t->by_columns && t->in->first_quoted && t->in->fields == names + 1) t->shift = 1;
    for (i = names + (size_t)t->shift; i < t->in->fields; ++i)
        if (*t->in->field[i])
            malformed(t->in, "%lu fields, but %lu columns are named%s", (unsigned long)t->in->fields,
                      (unsigned long)names,
                      t->separator == ' ' ? ": blanks within a field need quotes, row names quotes or a name" : "");
}

/* The next line that is no comment, split; 0 at the end of the file. What separates polygons has no fields: a blank
   line, and a line that begins with >. */
static int next_row(table *t)
{
    if (t->has_row) { /* it has been split */
        t->has_row = 0;
        if (t->in->fields > 0) check_fields(t);
        return 1;
    }
    do
        if (!read_line(t->in)) return 0;
    while (is_comment(t->in->text));
    t->in->fields = 0;
    if (is_blank_line(t->in->text) || *skip_blanks(t->in->text) == '>') return 1;
    split_line(t->in, t->separator);
    check_fields(t);
    return 1;
}

/* The id of the row at hand, its columns with / between them; "" without an id. */
static const char *id_of_row(table *t)
{
    const column_list *c = &t->columns;
    size_t used = 0, length;
    int i;
    if (c->ids == 1) return field_at(t, c->id[0], "id");
    for (i = 0; i < c->ids; ++i) {
        const char *field = field_at(t, c->id[i], c->name[c->id[i]]);
        length = strlen(field);
        t->id = (char *)grow(t->id, &t->id_room, used + length + 2, 1);
        if (i > 0) t->id[used++] = '/';
        memcpy(t->id + used, field, length + 1);
        used += length;
    }
    return c->ids ? t->id : "";
}

/* --- what is told once -------------------------------------------------------------------------------------------- */

static void tell_again(table *t, const char *id)
{
    if (t->columns.ids == 0 || says_nothing || !is_seen(&t->seen, id) || !warns(WARN_AGAIN)) return;
    remark("%s:%lu: id %s comes again: only lines that follow each other are one outline", t->in->name, t->in->number,
           id);
}

/* Notes down what the columns that are not looked at have when a polygon begins; later, whether that changes. */
static void watch_ignored(table *t, const polygon *p, int begins)
{
    const column_list *c = &t->columns;
    size_t i, length;
    if (says_nothing) return;
    for (i = 0; i < c->names; ++i) {
        const char *field;
        if (!is_ignored(c, i) || !c->name[i][0] || t->begun_room[i] == nowhere) continue;
        if (i + (size_t)t->shift >= t->in->fields) continue;
        field = t->in->field[i + (size_t)t->shift];
        if (!begins) {
            if (!t->begun_with[i]) continue; /* the first row of all ended before this column */
            if (strcmp(field, t->begun_with[i]) == 0) continue;
            if (warns(WARN_COLUMN))
                remark("%s:%lu: column '%s' changes within outline %s; if it tells outlines apart, say so with --id",
                       t->in->name, t->in->number, c->name[i], p->id);
            t->begun_room[i] = nowhere; /* once is enough */
            continue;
        }
        length = strlen(field) + 1;
        t->begun_with[i] = (char *)grow(t->begun_with[i], &t->begun_room[i], length, 1);
        memcpy(t->begun_with[i], field, length);
    }
}

/* --- polygons ----------------------------------------------------------------------------------------------------- */

/* Corners at very different distances from the origin are hardly those of a sphere about it. */
static void watch_radius(table *t, const double *x)
{
    double radius = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    if (!(radius > 0 && radius <= 1e150) || t->farthest < 0) return;
    if (t->rows == 0) t->nearest = t->farthest = radius;
    if (radius < t->nearest) t->nearest = radius;
    if (radius > t->farthest) t->farthest = radius;
    if (!(t->farthest > MOST_UNLIKE * t->nearest)) return;
    if (warns(WARN_RADIUS))
        remark("%s:%lu: corners lie up to %.0f %% farther from the origin than others: a sphere has its middle there, "
               "and only the directions of corners count",
               t->in->name, t->in->number, 100 * (t->farthest / t->nearest - 1));
    t->farthest = -1; /* once a file */
}

static void add_row(table *t, polygon *p)
{
    const layout *l = t->columns.layout;
    double value[6] = {0, 0, 0, 0, 0, 0}, k = 0;
    int i, status = SURFMINK_OK;
    for (i = 0; i < l->columns; ++i) {
        value[i] = number_at(t, l->column[i]);
        if (!isfinite(value[i])) status = SURFMINK_NOT_FINITE;
    }
    if (l->surface != SPHERE) value[1] *= t->down;
    if (l->surface == EMBEDDED) value[4] *= t->down;
    if (l->lonlat && status == SURFMINK_OK) status = surfmink_from_lonlat(value[0], value[1], 1, value);
    find_fault(p, status, t->in->number);
    if (l->surface == SPHERE && !l->lonlat) watch_radius(t, value);
    if (has(&t->columns, COLUMN_K)) k = number_at(t, COLUMN_K);
    add_corner(p, value, value + 3, t->in->number);
    if (has(&t->columns, COLUMN_K)) set_order(p, k);
    ++t->rows;
}

/* Is the row one of NaNs, as MATLAB has between outlines? */
static int is_gap(const table *t)
{
    const layout *l = t->columns.layout;
    int i;
    for (i = 0; i < l->columns; ++i) {
        size_t place = t->columns.place[l->column[i]] + (size_t)t->shift;
        double number;
        if (place >= t->in->fields || !parse_number(t->in->powers, t->in->field[place], &number) || !isnan(number))
            return 0;
    }
    return 1;
}

static void begin_row_polygon(table *t, polygon *p)
{
    char number[32];
    const char *id = number;
    snprintf(number, sizeof number, "%lu", t->polygons++);
    if (t->columns.ids > 0) id = id_of_row(t);
    begin_polygon(p, t->columns.layout->surface, id, t->in->number);
    p->is_mirrored = t->down < 0;
    tell_again(t, p->id);
}

/* A first column without a name, or an index, is an id if the first two rows agree in it; else it counts rows. */
static void judge_unnamed(table *t, polygon *p)
{
    const char *field;
    size_t length;
    if (t->columns.unnamed == nowhere || t->rows > 1) return;
    field = field_at(t, t->columns.unnamed, "without a name");
    if (t->rows == 0) {
        length = strlen(field) + 1;
        t->first = (char *)grow(t->first, &t->first_room, length, 1);
        memcpy(t->first, field, length);
        return;
    }
    if (strcmp(field, t->first) == 0) {
        add_id(&t->columns, t->columns.unnamed, 1);
        rename_polygon(p, t->first);
        if (t->columns.name[t->columns.unnamed][0])
            remark("%s: id: %s, which is the same in rows that follow each other (--id names others)", t->in->name,
                   t->columns.name[t->columns.unnamed]);
        else
            remark("%s: id: the first column, which has no name but the same in rows that follow each other",
                   t->in->name);
    }
    t->columns.unnamed = nowhere;
}

/* A line of x,y,x,y,... */
static int next_line_polygon(table *t, polygon *p)
{
    char number[32];
    size_t i, k;
    do {
        if (!t->has_row && !read_line(t->in)) return 0;
        if (!t->has_row && (is_comment(t->in->text) || is_blank_line(t->in->text))) continue;
        if (!t->has_row) split_line(t->in, t->separator);
        t->has_row = 0;
        break;
    } while (1);
    if (t->in->fields % 2 != 0) malformed(t->in, "%lu numbers are no pairs x,y", (unsigned long)t->in->fields);
    snprintf(number, sizeof number, "%lu", t->polygons++);
    begin_polygon(p, PLANE, number, t->in->number);
    p->is_mirrored = t->down < 0;
    for (i = 0; i < t->in->fields; i += 2) {
        double x[2];
        for (k = 0; k < 2; ++k)
            if (!parse_number(t->in->powers, t->in->field[i + k], &x[k]))
                malformed(t->in, "'%s' is not a number", t->in->field[i + k]);
        x[1] *= t->down;
        if (!isfinite(x[0]) || !isfinite(x[1])) find_fault(p, SURFMINK_NOT_FINITE, t->in->number);
        add_corner(p, x, NULL, t->in->number);
    }
    return 1;
}

/* Lines that follow each other with the same id; without ids, up to a blank line. Returns 0 at the end of the file. */
static int next_of_table(table *t, polygon *p)
{
    unsigned long gap = 0;
    int begun = 0;
    if (t->by_lines) return next_line_polygon(t, p);
    while (next_row(t)) {
        if (t->in->fields == 0 || (t->columns.ids == 0 && is_gap(t))) {
            if (begun && t->columns.ids == 0) return 1;
            if (begun && p->n >= 3) gap = t->in->number;
            continue;
        }
        if (begun) judge_unnamed(t, p);
        if (begun && t->columns.ids > 0 && strcmp(p->id, id_of_row(t)) != 0) {
            t->has_row = 1;
            return 1;
        }
        if (begun && gap && warns(WARN_BREAK))
            remark("%s:%lu: a blank line, or one with >, within outline %s: it goes on, for ids alone part outlines "
                   "where there are any",
                   t->in->name, gap, p->id);
        gap = 0;
        if (!begun) judge_unnamed(t, p);
        if (!begun) begin_row_polygon(t, p);
        watch_ignored(t, p, !begun);
        begun = 1;
        add_row(t, p);
    }
    return begun;
}

#endif
