/* planted.c - faults planted into tables and GeoJSON: planted.h says what must hold.

   Corners are x y of the plane; the direction x y DEPTH of a sphere; x y DEPTH in space with that direction as normal;
   longitude and latitude in millionths of a degree, so near to the equator that straight lines are great circles. */
#include "planted.h"

enum { DEPTH = 2000, CUT = 1 };
enum { LON_LAT = KINDS, GEOJSON, FORMATS };
static const int fields_of[FORMATS] = {2, 3, 6, 2, 2};

/* --- a file of three outlines, and its faults --------------------------------------------------------------------- */

typedef struct table_row {
    char id;
    int k;
    char field[6][24];
} table_row;

enum planted {
    NONE,
    EXCHANGED,     /* two corners */
    DROPPED,       /* a table_row */
    TWICE,         /* a row, and again */
    COPIED,        /* a row, elsewhere in the outline */
    CLOSED,        /* the first row again at the end */
    ALMOST_CLOSED, /* with an error of rounding */
    ALMOST_TWICE,  /* a row again, with such an error */
    RENAMED,       /* an outline has the id of the one before */
    GLUED,         /* so, and both are closed */
    HOLED,         /* a hole under the same id, both closed */
    AGAIN,         /* the last outline has the id of the first */
    MIXED,         /* rows of the first two by turns */
    SPLIT,         /* the second outline within the first */
    REVERSED,
    MIRRORED, /* x and y are exchanged */
    NOT_A_NUMBER,
    EMPTY,   /* a field */
    WORD,    /* instead of a number */
    SHORT,   /* a row of fewer fields */
    LONG,    /* a row of more */
    NEGATED, /* a number */
    SHIFTED, /* its decimal point */
    SPIKE,
    SHUFFLED, /* rows, with their k */
    SAME_K,
    LOST_NORMAL, /* 0 0 0 */
    OPEN,        /* a ring of GeoJSON */
    INWARD,      /* a normal */
    FAULTS
};

static const char *const fault_name[FAULTS] = {
    "none",     "exchanged", "dropped",     "twice", "copied", "closed",  "almost_closed", "almost_twice",
    "renamed",  "glued",     "holed",       "again", "mixed",  "split",   "reversed",      "mirrored",
    "nan",      "empty",     "word",        "short", "long",   "negated", "shifted",       "spike",
    "shuffled", "same_k",    "lost_normal", "open",  "inward"};

typedef struct story {
    int format;
    enum planted fault;
    table_row row[4 * MOST_ROWS];
    size_t rows;
    ring told[3], changed[3]; /* what it was, and what it may be now, of the ids a b c */
    char text[1 << 16];
} story;

static void append_row(story *s, char id, int k, const long *x)
{
    table_row *r = &s->row[s->rows++];
    int c;
    r->id = id;
    r->k = k;
    for (c = 0; c < 6; ++c) snprintf(r->field[c], sizeof r->field[c], "%ld", c % 3 == 2 ? (long)DEPTH : x[c % 3]);
}

static void swap_rows(table_row *a, table_row *b)
{
    table_row swap = *a;
    *a = *b, *b = swap;
}

/* The rows first ... first + n - 1 as the outline that they now are, if they still are whole numbers. */
static void read_back(const story *s, size_t first, size_t n, ring *r)
{
    size_t i;
    for (r->n = n, i = 0; i < n; ++i) {
        r->x[i][0] = strtol(s->row[first + i].field[0], NULL, 10);
        r->x[i][1] = strtol(s->row[first + i].field[1], NULL, 10);
    }
}

static void insert_row(story *s, size_t at, table_row r)
{
    memmove(s->row + at + 1, s->row + at, (s->rows - at) * sizeof *s->row);
    s->row[at] = r;
    ++s->rows;
}

static void remove_row(story *s, size_t at)
{
    --s->rows;
    memmove(s->row + at, s->row + at + 1, (s->rows - at) * sizeof *s->row);
}

/* Plants the fault into the middle outline, whose rows are first ... first + n - 1. */
static void plant(story *s, bytes *in, size_t first, size_t n)
{
    size_t i = first + dice(in, (unsigned)n), j = first + dice(in, (unsigned)n), k, last = first + n - 1;
    int c = (int)dice(in, 2), wide = fields_of[s->format];
    table_row r = s->row[i];
    char *field = s->row[i].field[c];
    switch (s->fault) {
    case EXCHANGED: swap_rows(&s->row[i], &s->row[j]); break;
    case DROPPED: remove_row(s, i), --n; break;
    case TWICE: insert_row(s, i, r), ++n; break;
    case COPIED: insert_row(s, j, r), ++n; break;
    case CLOSED: insert_row(s, first + n, s->row[first]); return;
    case ALMOST_CLOSED:
    case ALMOST_TWICE:
        if (s->fault == ALMOST_CLOSED)
            i = first, j = first + n, r = s->row[first];
        else
            j = i + 1;
        for (k = 0; k < 2; ++k)
            snprintf(r.field[k], sizeof r.field[k], "%.17g",
                     strtod(r.field[k], NULL) * (1 + (dice(in, 7) - 3.0) * DBL_EPSILON));
        insert_row(s, j, r);
        return;
    case RENAMED:
        for (k = first; k <= last; ++k) s->row[k].id = 'a';
        read_back(s, 0, first + n, &s->changed[0]);
        s->changed[1].n = s->told[1].n = 0;
        return;
    case GLUED:
        insert_row(s, first + n, s->row[first]);
        insert_row(s, first, s->row[0]);
        for (k = 0; k <= last + 2; ++k) s->row[k].id = 'a';
        s->changed[1].n = s->told[1].n = 0;
        s->told[0].n = s->changed[0].n = 0; /* neither is what one has now */
        return;
    case HOLED:
        insert_row(s, first + n, s->row[first]);
        for (k = 0; k <= n; ++k) {
            table_row inner = s->row[first + (n - k) % n];
            for (c = 0; c < 2; ++c) {
                long x = strtol(inner.field[c], NULL, 10) / 4;
                snprintf(inner.field[c], sizeof inner.field[c], "%ld", x);
            }
            insert_row(s, first + n + 1 + k, inner);
        }
        s->told[1].n = s->changed[1].n = 0;
        return;
    case AGAIN:
        for (k = last + 1; k < s->rows; ++k) s->row[k].id = 'a';
        s->changed[0] = s->told[2];
        s->told[2].n = s->changed[2].n = 0;
        return;
    case MIXED:
        for (k = 0; k + 1 < first && first + k <= last; k += 2) swap_rows(&s->row[k], &s->row[first + k]);
        return;
    case SPLIT:
        for (k = 0; k < n; ++k) {
            r = s->row[s->told[0].n + k];
            remove_row(s, s->told[0].n + k);
            insert_row(s, 2 + k, r);
        }
        return;
    case REVERSED:
        for (k = 0; k < n / 2; ++k) swap_rows(&s->row[first + k], &s->row[last - k]);
        break;
    case MIRRORED:
        for (k = first; k <= last; ++k)
            for (c = 0; c < 6; c += 3) {
                char swap[24];
                memcpy(swap, s->row[k].field[c], 24);
                memcpy(s->row[k].field[c], s->row[k].field[c + 1], 24);
                memcpy(s->row[k].field[c + 1], swap, 24);
            }
        break;
    case NOT_A_NUMBER:
        strcpy(field, "nan");
        s->told[1].n = 0;
        break;
    case EMPTY: strcpy(field, ""); break;
    case WORD: strcpy(field, "NA"); break;
    case SHORT: s->row[i].field[wide - 1][0] = CUT; break;
    case LONG: strcat(s->row[i].field[wide - 1], "\t7"); break;
    case NEGATED:
        snprintf(field, 24, "%ld", -strtol(r.field[c], NULL, 10));
        if (wide == 6) strcpy(s->row[i].field[c + 3], field);
        break;
    case SHIFTED:
        snprintf(field, 24, "%ld", 10 * strtol(r.field[c], NULL, 10));
        if (wide == 6) strcpy(s->row[i].field[c + 3], field);
        break;
    case SPIKE:
        insert_row(s, i + 1, s->row[j]);
        insert_row(s, i + 2, r);
        n += 2;
        break;
    case SHUFFLED:
    case SAME_K:
        if (s->format == GEOJSON) return;
        if (s->fault == SAME_K) s->row[i].k = s->row[j].k;
        if (s->fault == SAME_K) return;
        for (k = 0; k < n; ++k) swap_rows(&s->row[first + k], &s->row[first + dice(in, (unsigned)n)]);
        return;
    case LOST_NORMAL:
        for (c = 3; c < 6; ++c) strcpy(s->row[i].field[c], "0");
        if (wide == 6) s->told[1].n = 0;
        return;
    case INWARD:
        for (c = 3; c < 6; ++c) snprintf(s->row[i].field[c], 24, "%ld", -strtol(r.field[c], NULL, 10));
        if (wide == 6) s->told[1].n = 0;
        return;
    default: return;
    }
    read_back(s, first, n, &s->changed[1]);
}

/* The table, with or without a column k. */
static void write_table(story *s, int with_k)
{
    static const char *const names[FORMATS] = {"x\ty", "x\ty\tz", "x\ty\tz\tnx\tny\tnz", "lon\tlat", NULL};
    char *at = s->text;
    size_t i;
    int c;
    at += sprintf(at, "%s\ncell\t%s%s\n", s->format == ON_THE_SPHERE ? "--surface sphere" : "", with_k ? "k\t" : "",
                  names[s->format]);
    for (i = 0; i < s->rows; ++i) {
        at += sprintf(at, "%c", s->row[i].id);
        if (with_k) at += sprintf(at, "\t%d", s->row[i].k);
        for (c = 0; c < fields_of[s->format] && s->row[i].field[c][0] != CUT; ++c)
            at += sprintf(at, "\t%s%s", s->row[i].field[c], s->format == LON_LAT ? "e-6" : "");
        at += sprintf(at, "\n");
    }
}

/* A feature for each run of rows with one id; what is not closed is, unless the fault is that. */
static void write_geojson(story *s)
{
    char *at = s->text;
    size_t i, first = 0;
    at += sprintf(at, "\n{\"type\":\"FeatureCollection\",\"features\":[");
    for (i = 0; i <= s->rows; ++i) {
        const table_row *r = &s->row[i < s->rows ? i : first];
        int ends = i > 0 && (i == s->rows || s->row[i].id != s->row[first].id);
        if (ends) {
            r = &s->row[first];
            if (s->fault != OPEN) at += sprintf(at, ",[%se-6,%se-6]", r->field[0], r->field[1]);
            at += sprintf(at, "]]}}");
            first = i;
        }
        if (i == s->rows) break;
        r = &s->row[i];
        if (i == first)
            at +=
                sprintf(at,
                        "%s{\"type\":\"Feature\",\"properties\":{\"name\":\"%c\"},\"geometry\":{\"type\":\"Polygon\",\n"
                        "\"coordinates\":[[",
                        i ? "," : "", r->id);
        at += sprintf(at, "%s[%se-6", i == first ? "" : ",\n", r->field[0]);
        if (r->field[1][0] != CUT) at += sprintf(at, ",%se-6", r->field[1]);
        at += sprintf(at, "]");
    }
    sprintf(at, "]}\n");
}

/* --- judged ------------------------------------------------------------------------------------------------------- */

static int truth_of(const ring *r, int format, truth *t)
{
    double x[MOST_ROWS][3], normal[MOST_ROWS][3];
    size_t i;
    for (i = 0; i < r->n; ++i) {
        double a = (double)r->x[i][0], b = (double)r->x[i][1], depth = DEPTH, norm;
        if (format >= LON_LAT) { /* seen along the x axis */
            double lon = a * 1e-6 * two_pi / 360, lat = b * 1e-6 * two_pi / 360;
            a = sin(lon) * cos(lat), b = sin(lat), depth = cos(lon) * cos(lat);
        }
        norm = sqrt(a * a + b * b + depth * depth);
        normal[i][0] = a / norm, normal[i][1] = b / norm, normal[i][2] = depth / norm;
        x[i][0] = a, x[i][1] = b, x[i][2] = depth;
        if (format == ON_THE_SPHERE || format >= LON_LAT) memcpy(x[i], normal[i], sizeof x[i]);
    }
    return find_truth(r, format >= LON_LAT ? ON_THE_SPHERE : format, x, normal, t);
}

/* Is it this outline? GeoJSON says which ring is the outer one, so it may run either way. */
static int says_ring(char *const *field, const ring *r, int format)
{
    truth t;
    ring turned;
    size_t i, k;
    if (truth_of(r, format, &t) && says(field, &t)) return 1;
    for (turned.n = r->n, i = 0; i < r->n; ++i)
        for (k = 0; k < 2; ++k) turned.x[i][k] = r->x[r->n - 1 - i][k];
    return format == GEOJSON && truth_of(&turned, format, &t) && says(field, &t);
}

/* Every row with status ok is an outline as it was, or as it is; if it is neither, standard error has a word. */
static void judge(const story *s)
{
    static char name[64];
    char *field[64], *at = world.said;
    int holds = 1, told = strstr(world.complained, "comes again") || strstr(world.complained, "there and back");
    while (at && next_row_said(&at, field)) {
        size_t which = (size_t)(field[0][0] - 'a');
        CLAIM(which < 3);
        holds &= says_ring(field, &s->told[which], s->format) || says_ring(field, &s->changed[which], s->format);
    }
    snprintf(name, sizeof name, "%d %s %s", s->format, fault_name[s->fault], told && !holds ? "(told)" : "");
    JUDGE(name, holds || told, s->text);
}

static void fuzz(bytes in)
{
    static story s;
    size_t i, k, first = 0, n = 0;
    memset(&s, 0, sizeof s);
    s.format = (int)dice(&in, FORMATS);
    s.fault = (enum planted)dice(&in, FAULTS);
    for (i = 0; i < 3; ++i) {
        make_ring(&in, &s.told[i]);
        s.changed[i] = s.told[i];
        if (i == 1) first = s.rows, n = s.told[i].n;
        for (k = 0; k < s.told[i].n; ++k) append_row(&s, (char)('a' + i), (int)k, s.told[i].x[k]);
    }
    plant(&s, &in, first, n);
    if (s.format == GEOJSON)
        write_geojson(&s);
    else
        write_table(&s, s.fault == SHUFFLED || s.fault == SAME_K);
    run_command(s.text);
    judge(&s);
    world_end();
}
