/* table.h - step 1 of the command: lines of a table -> polygons, one at a time. */
#ifndef SURFMINK_COMMAND_TABLE_H
#define SURFMINK_COMMAND_TABLE_H

#include "lines.h"
#include "polygon.h"

enum column {
    COLUMN_K,
    COLUMN_X,
    COLUMN_Y,
    COLUMN_Z,
    COLUMN_NX,
    COLUMN_NY,
    COLUMN_NZ,
    COLUMN_LON,
    COLUMN_LAT,
    COLUMNS
};

static const char *const column_name[COLUMNS] = {"k", "x", "y", "z", "nx", "ny", "nz", "lon", "lat"};

/* What the numbers of a line are, by surface. */
typedef struct layout {
    int surface;
    int lonlat;
    int columns;
    enum column column[6];
} layout;

static const layout layout_plane = {PLANE, 0, 2, {COLUMN_X, COLUMN_Y}};
static const layout layout_lonlat = {SPHERE, 1, 2, {COLUMN_LON, COLUMN_LAT}};
static const layout layout_sphere = {SPHERE, 0, 3, {COLUMN_X, COLUMN_Y, COLUMN_Z}};
static const layout layout_embedded = {EMBEDDED, 0, 6, {COLUMN_X, COLUMN_Y, COLUMN_Z, COLUMN_NX, COLUMN_NY, COLUMN_NZ}};

static const size_t nowhere = (size_t)-1;

typedef struct table {
    lines *in;
    char separator;
    size_t names;          /* fields of the line that names the columns */
    size_t place[COLUMNS]; /* field of each known column; nowhere if there is none */
    size_t id;             /* field of the id; nowhere if there is none */
    const layout *layout;
    int has_row;            /* the line that ended a polygon begins the next one */
    unsigned long polygons; /* so far */
} table;

/* --- the line that names the columns ------------------------------------------------------------------------------ */

/* Is it the name of column k? Coordinates may be in capitals, as ImageJ and others write them: X Y, Lon Lat. */
static int is_named(const char *name, int k)
{
    const char *known = column_name[k];
    if (k == COLUMN_K) return strcmp(name, known) == 0;
    for (; *known; ++known, ++name)
        if (*name != *known && *name != *known - 'a' + 'A') return 0;
    return *name == '\0';
}

static void find_columns(table *t)
{
    size_t i;
    int k;
    for (k = 0; k < COLUMNS; ++k) t->place[k] = nowhere;
    t->id = nowhere;
    t->names = t->in->fields;
    for (i = 0; i < t->names; ++i) {
        const char *name = t->in->field[i];
        for (k = 0; k < COLUMNS && !is_named(name, k); ++k) continue;
        if (k < COLUMNS && t->place[k] != nowhere) malformed(t->in, "two columns are named '%s'", column_name[k]);
        if (k < COLUMNS)
            t->place[k] = i;
        else if (t->id == nowhere && *name) /* a column without a name, as some programs write, is no id */
            t->id = i;
    }
}

static int has(const table *t, enum column k)
{
    return t->place[k] != nowhere;
}

/* Without --surface the columns say what they are; where they could be two things, they do not. */
static const layout *layout_from_columns(const table *t)
{
    int lonlat = has(t, COLUMN_LON) || has(t, COLUMN_LAT), xy = has(t, COLUMN_X) || has(t, COLUMN_Y);
    int normals = has(t, COLUMN_NX) || has(t, COLUMN_NY) || has(t, COLUMN_NZ);
    if (lonlat && xy) malformed(t->in, "columns lon lat and x y: choose with --surface");
    if (!lonlat && !xy) malformed(t->in, "this line should name the columns: x y, lon lat, x y z or x y z nx ny nz");
    if (lonlat) return &layout_lonlat;
    if (!has(t, COLUMN_Z)) return &layout_plane;
    if (!normals) malformed(t->in, "columns nx ny nz are missing, or --surface sphere, or --surface plane");
    return &layout_embedded;
}

static const layout *choose_layout(const table *t, int surface)
{
    int lonlat = has(t, COLUMN_LON) || has(t, COLUMN_LAT);
    switch (surface) {
    case PLANE: return &layout_plane;
    case SPHERE: return lonlat ? &layout_lonlat : &layout_sphere;
    case EMBEDDED: return &layout_embedded;
    default: return layout_from_columns(t);
    }
}

static void read_header(table *t, lines *in, const options *o)
{
    int i;
    memset(t, 0, sizeof *t);
    t->in = in;
    do
        if (!read_line(in)) die("%s: no line names the columns", in->name);
    while (is_blank_line(in->text) || is_comment(in->text));
    trim_end(in->text);
    t->separator = (char)(strchr(in->text, '\t') ? '\t' : strchr(in->text, ',') ? ',' : ' ');
    split_line(in, t->separator);
    find_columns(t);
    t->layout = choose_layout(t, o->surface);
    for (i = 0; i < t->layout->columns; ++i)
        if (!has(t, t->layout->column[i])) malformed(in, "no column '%s'", column_name[t->layout->column[i]]);
}

/* --- the lines below ---------------------------------------------------------------------------------------------- */

static const char *field_at(const table *t, size_t place, const char *name)
{
    if (place >= t->in->fields) malformed(t->in, "no field for column '%s'", name);
    return t->in->field[place];
}

static double number_at(const table *t, enum column k)
{
    const char *field = field_at(t, t->place[k], column_name[k]);
    double number;
    if (*field == '\0') malformed(t->in, "column '%s' is empty", column_name[k]);
    if (!parse_number(t->in->powers, field, &number))
        malformed(t->in, "'%s' in column '%s' is not a number", field, column_name[k]);
    return number;
}

/* More fields than names: an id with blanks, or a table that changes its mind. */
static void check_fields(const table *t)
{
    size_t i;
    for (i = t->names; i < t->in->fields; ++i)
        if (*t->in->field[i])
            malformed(t->in, "%lu fields, but %lu columns are named", (unsigned long)t->in->fields,
                      (unsigned long)t->names);
}

static void add_row(const table *t, polygon *p)
{
    double value[6] = {0, 0, 0, 0, 0, 0};
    int i, status = SURFMINK_OK;
    for (i = 0; i < t->layout->columns; ++i) {
        value[i] = number_at(t, t->layout->column[i]);
        if (!isfinite(value[i])) status = SURFMINK_NOT_FINITE;
    }
    if (t->layout->lonlat && status == SURFMINK_OK) status = surfmink_from_lonlat(value[0], value[1], 1, value);
    find_fault(p, status, t->in->number);
    add_corner(p, value, value + 3, t->in->number);
}

/* The next line that is no comment, split; 0 at the end of the file. A blank line has no fields. */
static int next_row(table *t)
{
    do
        if (!read_line(t->in)) return 0;
    while (is_comment(t->in->text));
    t->in->fields = 0;
    if (is_blank_line(t->in->text)) return 1;
    split_line(t->in, t->separator);
    check_fields(t);
    return 1;
}

static void begin_row_polygon(table *t, polygon *p)
{
    char number[32];
    snprintf(number, sizeof number, "%lu", t->polygons++);
    begin_polygon(p, t->layout->surface, t->id == nowhere ? number : field_at(t, t->id, "id"), t->in->number);
}

/* Lines that follow each other with the same id; without ids, up to a blank line. Returns 0 at the end of the file. */
static int next_of_table(table *t, polygon *p)
{
    int begun = 0, named = t->id != nowhere;
    while (t->has_row || next_row(t)) {
        t->has_row = 0;
        if (t->in->fields == 0) {
            if (begun && !named) return 1;
            continue;
        }
        if (begun && named && strcmp(p->id, field_at(t, t->id, "id")) != 0) {
            t->has_row = 1;
            return 1;
        }
        if (!begun) begin_row_polygon(t, p);
        begun = 1;
        add_row(t, p);
    }
    return begun;
}

#endif
