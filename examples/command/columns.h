/* columns.h - step 1 of the command: the line that names the columns of a table -> what each of them is. */
#ifndef SURFMINK_COMMAND_COLUMNS_H
#define SURFMINK_COMMAND_COLUMNS_H

#include "lines.h"
#include "options.h"

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
    COLUMN_ROW, /* of an image: y is minus the row */
    COLUMNS
};

/* Names in small letters, what is not a letter or digit left out; the first is the one that messages use. */
static const char *const column_name[COLUMNS][8] = {{"k", "vertexindex", "vertexpartindex", NULL},
                                                    {"x", "col", "column", "positionx", "points0", NULL},
                                                    {"y", "positiony", "points1", NULL},
                                                    {"z", "positionz", "points2", NULL},
                                                    {"nx", "normalx", "normals0", NULL},
                                                    {"ny", "normaly", "normals1", NULL},
                                                    {"nz", "normalz", "normals2", NULL},
                                                    {"lon", "longitude", "lng", "long", "ra", NULL},
                                                    {"lat", "latitude", "dec", NULL},
                                                    {"row", NULL}};

/* Names of columns that make an outline what it is, and of columns that are measured. */
static const char *const id_word[] = {
    "cell",   "cells",     "id",      "ids",     "label",    "labels",  "track",    "frame", "t",
    "time",   "timepoint", "ring",    "part",    "name",     "file",    "filename", "image", "roi",
    "object", "outline",   "polygon", "contour", "region",   "country", "plate",    "face",  "loop",
    "tissue", "sample",    "slice",   "stack",   "series",   "group",   "feature",  "fid",   "gid",
    "uid",    "index",     "shape",   "segment", "particle", "nucleus", "grain",    NULL};
static const char *const measured_word[] = {"area",   "mean",   "perimeter", "length",   "volume",    "std",
                                            "sd",     "min",    "max",       "median",   "intensity", "type",
                                            "value",  "radius", "angle",     "distance", "score",     "width",
                                            "height", "color",  "colour",    "level",    NULL};

/* Units that longitudes and latitudes are not in. */
static const char *const foreign_unit[] = {"rad",   "radian", "radians", "h",   "hr",        "hour",
                                           "hours", "hms",    "dms",     "gon", "grad",      "arcmin",
                                           "min",   "arcsec", "sec",     "mas", "hourangle", NULL};

static const char *const geometry_word[] = {"wkt", "geometry", "geom", "wkb", NULL};

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
static const layout layout_space = {EMBEDDED, 0, 3, {COLUMN_X, COLUMN_Y, COLUMN_Z}}; /* normals are estimated */

static const size_t nowhere = (size_t)-1;
enum { MOST_IDS = 16 };

typedef struct column_list {
    size_t names;          /* fields of the line */
    char **name;           /* as in the file */
    size_t place[COLUMNS]; /* field of each known column; nowhere if there is none */
    size_t id[MOST_IDS];   /* fields that make the id */
    int ids;
    size_t unnamed; /* a first column without a name, or an index: it may be an id; else nowhere */
    const layout *layout;
} column_list;

/* --- names -------------------------------------------------------------------------------------------------------- */

/* Without unit, quotes, blanks and capitals: `X (um)`, `x [um]` and `X` are all x. */
static void simplify_name(const char *name, char *simple, size_t size)
{
    size_t length = 0;
    for (; *name && *name != '(' && *name != '['; ++name) {
        char c = (char)(*name >= 'A' && *name <= 'Z' ? *name - 'A' + 'a' : *name);
        if (((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || (unsigned char)c >= 0x80) && length + 1 < size)
            simple[length++] = c;
    }
    simple[length] = '\0';
}

/* Is it the name of column k, the usual one or, if `other`, another? K is no k, for it may well be an id. */
static int is_named(const char *name, int k, int other)
{
    char simple[32];
    int i;
    simplify_name(name, simple, sizeof simple);
    if (strcmp(name, "K") == 0) return 0;
    if (!other) return strcmp(simple, column_name[k][0]) == 0;
    for (i = 1; column_name[k][i]; ++i)
        if (strcmp(simple, column_name[k][i]) == 0) return 1;
    return 0;
}

static int is_listed(const char *word, size_t length, const char *const *list)
{
    for (; *list; ++list)
        if (strlen(*list) == length && strncmp(word, *list, length) == 0) return 1;
    return 0;
}

/* Has the name a word of the list in it? Words end at what is no letter, and before a capital: track_id, cellID. */
static int has_word(const char *name, const char *const *list)
{
    char word[32];
    size_t length = 0;
    char last = ' ';
    for (;; ++name) {
        int is_capital = *name >= 'A' && *name <= 'Z', is_letter = is_capital || (*name >= 'a' && *name <= 'z');
        if (length > 0 && (!is_letter || (is_capital && last >= 'a' && last <= 'z'))) {
            if (is_listed(word, length, list)) return 1;
            length = 0;
        }
        if (*name == '\0') return 0;
        if (is_letter && length < sizeof word) word[length++] = (char)(is_capital ? *name - 'A' + 'a' : *name);
        last = *name;
    }
}

/* --- which column is what ----------------------------------------------------------------------------------------- */

static int has(const column_list *c, enum column k)
{
    return c->place[k] != nowhere;
}

/* Is it one of the known columns? */
static int is_known(const column_list *c, size_t place)
{
    int k;
    for (k = 0; k < COLUMNS; ++k)
        if (c->place[k] == place) return 1;
    return 0;
}

/* In the order of --id, or of the columns. */
static void add_id(column_list *c, size_t place, int in_order)
{
    int i = c->ids;
    if (c->ids == MOST_IDS) return;
    for (; in_order && i > 0 && c->id[i - 1] > place; --i) c->id[i] = c->id[i - 1];
    c->id[i] = place;
    ++c->ids;
}

/* Names as a list for messages. */
static void list_names(const column_list *c, char *text, size_t size)
{
    size_t i, used = 0;
    text[0] = '\0';
    for (i = 0; i < c->names && used < size; ++i) {
        int length = snprintf(text + used, size - used, "%s%s", i > 0 ? ", " : "", c->name[i]);
        used += length > 0 ? (size_t)length : 0;
    }
}

/* The columns that --id names. */
static void take_ids(column_list *c, const lines *in, const char *list)
{
    char wanted[256], names[400];
    size_t length, i;
    for (;; list += length + 1) {
        length = strcspn(list, ",");
        snprintf(wanted, sizeof wanted, "%.*s", length < 255 ? (int)length : 255, list);
        for (i = 0; i < c->names && strcmp(c->name[i], wanted) != 0;) ++i;
        list_names(c, names, sizeof names);
        if (i == c->names) malformed(in, "no column '%s' for --id; the columns are: %s", wanted, names);
        add_id(c, i, 0);
        if (list[length] == '\0') return;
    }
}

/* pandas writes an index without a name, and reads it as Unnamed: 0. */
static int is_unnamed(const char *name)
{
    return *name == '\0' || strncmp(name, "Unnamed: ", 9) == 0;
}

/* Without --id: all whose names say so; else the first other one, unless it is measured. A second order is no id, and
   an index alone may count rows. */
static void guess_ids(column_list *c)
{
    size_t i;
    char simple[32];
    for (i = 0; i < c->names; ++i)
        if (!is_known(c, i) && !is_named(c->name[i], COLUMN_K, 1) && has_word(c->name[i], id_word) &&
            !has_word(c->name[i], measured_word))
            add_id(c, i, 1);
    if (c->ids == 1) {
        simplify_name(c->name[c->id[0]], simple, sizeof simple);
        if (strcmp(simple, "index") != 0) return;
        c->unnamed = c->id[0];
        c->ids = 0;
        return;
    }
    for (i = 0; i < c->names && c->ids == 0; ++i)
        if (!is_known(c, i) && !is_unnamed(c->name[i]) && !has_word(c->name[i], measured_word)) add_id(c, i, 1);
    if (c->ids == 0 && c->names > 0 && is_unnamed(c->name[0])) c->unnamed = 0;
}

/* napari has axis-0, axis-1, ...: the last two are row and column of an image, those before count images, unless an
   axis is named by letter as well. */
static void take_axes(column_list *c, int with_ids)
{
    size_t place[MOST_IDS], i;
    char simple[32], name[32];
    int axes = 0, k;
    for (i = 0; axes < MOST_IDS && i < c->names;) {
        simplify_name(c->name[i], simple, sizeof simple);
        snprintf(name, sizeof name, "axis%d", axes);
        if (strcmp(simple, name) == 0)
            place[axes++] = i, i = 0;
        else
            ++i;
    }
    if (axes < 2 || has(c, COLUMN_X) || has(c, COLUMN_Y) || has(c, COLUMN_ROW)) return;
    c->place[COLUMN_ROW] = place[axes - 2];
    c->place[COLUMN_X] = place[axes - 1];
    for (k = 0; with_ids && k + 2 < axes; ++k) add_id(c, place[k], 1);
}

static int is_id(const column_list *c, size_t place)
{
    int i;
    for (i = 0; i < c->ids; ++i)
        if (c->id[i] == place) return 1;
    return 0;
}

/* Is the column neither used nor known? */
static int is_ignored(const column_list *c, size_t place)
{
    return !is_known(c, place) && !is_id(c, place) && place != c->unnamed;
}

/* Where there is something to guess, what has been guessed. */
static void tell_ids(const column_list *c, const lines *in)
{
    enum { MOST_TOLD = 8 };
    char ids[400] = "", ignored[400] = "", more[40] = "";
    size_t i, told = 0;
    for (i = 0; i < c->names; ++i) {
        int is_level = strcmp(c->name[i], "level") == 0; /* levelset writes it beside its loops, which are ids enough */
        char *list = is_id(c, i) ? ids : is_ignored(c, i) && c->name[i][0] && !is_level ? ignored : NULL;
        if (list == ignored && ++told > MOST_TOLD) {
            snprintf(more, sizeof more, " and %lu more", (unsigned long)(told - MOST_TOLD));
            continue;
        }
        if (list) snprintf(list + strlen(list), 400 - strlen(list), "%s%.60s", *list ? " " : "", c->name[i]);
    }
    if (c->ids > 0 && (c->ids > 1 || *ignored))
        remark("%s: id: %s%s%s%s (--id names others)", in->name, ids, *ignored ? "; not looked at: " : "", ignored,
               more);
}

static void find_columns(column_list *c, const lines *in, const options *o)
{
    size_t i;
    int k;
    for (k = 0; k < COLUMNS; ++k) c->place[k] = nowhere;
    c->unnamed = nowhere;
    for (i = 0; i < c->names; ++i)
        for (k = 0; k < COLUMNS; ++k) {
            if (!is_named(c->name[i], k, 0)) continue;
            if (has(c, (enum column)k)) malformed(in, "two columns are named '%s'", column_name[k][0]);
            c->place[k] = i;
        }
    if (has(c, COLUMN_X) && has(c, COLUMN_Y)) c->place[COLUMN_ROW] = nowhere;
    for (i = 0; i < c->names; ++i)
        for (k = 0; k < COLUMNS; ++k) {
            int is_place = k == COLUMN_LON || k == COLUMN_LAT || k == COLUMN_ROW;
            if (is_place && has(c, COLUMN_X) && has(c, COLUMN_Y)) continue; /* ra, dec, row may be anything then */
            if (!has(c, (enum column)k) && !is_known(c, i) && is_named(c->name[i], k, 1)) c->place[k] = i;
        }
    take_axes(c, !o->id);
    if (has(c, COLUMN_ROW) && !has(c, COLUMN_Y)) c->place[COLUMN_Y] = c->place[COLUMN_ROW];
    if (o->id)
        take_ids(c, in, o->id);
    else
        guess_ids(c);
}

/* Longitudes and latitudes are degrees, whatever a name says in brackets: better not to read them. */
static void check_degrees(const column_list *c, const lines *in)
{
    int k;
    for (k = COLUMN_LON; k <= COLUMN_LAT; ++k) {
        const char *name = has(c, (enum column)k) ? c->name[c->place[k]] : "", *unit = name + strcspn(name, "([");
        if (*unit && has_word(unit, foreign_unit))
            malformed(in, "column '%s': longitudes and latitudes are read in degrees: convert them", name);
    }
}

/* Without --surface the columns say what they are; where they could be two things, they do not. */
static const layout *layout_from_columns(const column_list *c, const lines *in, const options *o)
{
    int lonlat = has(c, COLUMN_LON) || has(c, COLUMN_LAT), xy = has(c, COLUMN_X) || has(c, COLUMN_Y);
    int normals = has(c, COLUMN_NX) || has(c, COLUMN_NY) || has(c, COLUMN_NZ);
    char names[400];
    double number;
    size_t i;
    if (lonlat && xy) malformed(in, "columns lon lat and x y: choose with --surface");
    if (!lonlat && !xy) {
        list_names(c, names, sizeof names);
        for (i = 0; i < c->names; ++i)
            if (has_word(c->name[i], geometry_word))
                malformed(in,
                          "column '%s': geometry within a field is not read; save the layer as GeoJSON (QGIS, or "
                          "ogr2ogr OUT.geojson IN)",
                          c->name[i]);
        for (i = 0; i < c->names && parse_number(in->powers, c->name[i], &number);) ++i;
        malformed(in, "this line should name the columns: x y, lon lat, x y z or x y z nx ny nz; %s: %s",
                  i == c->names ? "--columns x,y names them where the file has only numbers, as here" : "here they are",
                  names);
    }
    if (lonlat) return &layout_lonlat;
    if (!has(c, COLUMN_Z)) return &layout_plane;
    if (o->estimate_normals) return &layout_space;
    if (!normals)
        malformed(in, "columns nx ny nz are missing, or --surface sphere, or --surface plane, or --normals estimate");
    return &layout_embedded;
}

static const layout *choose_layout(const column_list *c, const lines *in, const options *o)
{
    int lonlat = has(c, COLUMN_LON) || has(c, COLUMN_LAT);
    switch (o->surface) {
    case PLANE: return &layout_plane;
    case SPHERE: return lonlat ? &layout_lonlat : &layout_sphere;
    case EMBEDDED: return o->estimate_normals ? &layout_space : &layout_embedded;
    default: return layout_from_columns(c, in, o);
    }
}

/* The names: the fields of the line at hand, or those of --columns. */
static void keep_names(column_list *c, const lines *in, const options *o)
{
    size_t i, length, room = 0;
    const char *list = o->columns;
    memset(c, 0, sizeof *c);
    if (!list) {
        c->name = (char **)resize(NULL, in->fields + 1, sizeof *c->name);
        for (i = 0; i < in->fields; ++i) {
            length = strlen(in->field[i]) + 1;
            c->name[i] = (char *)resize(NULL, length, 1);
            memcpy(c->name[i], in->field[i], length);
        }
        c->names = in->fields;
        return;
    }
    for (;; list += length + 1) {
        length = strcspn(list, ",");
        c->name = (char **)grow(c->name, &room, c->names + 1, sizeof *c->name);
        c->name[c->names] = (char *)resize(NULL, length + 1, 1);
        memcpy(c->name[c->names], list, length);
        c->name[c->names++][length] = '\0';
        if (list[length] == '\0') return;
    }
}

static void read_columns(column_list *c, const lines *in, const options *o)
{
    int i;
    char names[400];
    keep_names(c, in, o);
    find_columns(c, in, o);
    c->layout = choose_layout(c, in, o);
    list_names(c, names, sizeof names);
    for (i = 0; i < c->layout->columns; ++i)
        if (!has(c, c->layout->column[i]))
            malformed(in, "no column '%s'; the columns are: %s", column_name[c->layout->column[i]][0], names);
    if (c->layout->lonlat) check_degrees(c, in);
    if (!o->id) tell_ids(c, in);
}

static void free_columns(column_list *c)
{
    size_t i;
    for (i = 0; i < c->names; ++i) free(c->name[i]);
    free(c->name);
}

#endif
