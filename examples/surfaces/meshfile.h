/* meshfile.h - polygon meshes out of files, for surfmink - MIT or public domain, as you like (see surfmink.h)

   One header to copy; it needs no other file. C99 and C++, only libc and libm.

   WHAT IT DOES
     Reads the vertices and faces of a surface in space, and makes an oriented surface of them, or says why there is
     none: mesh.h cuts level sets out of it, the command surfmink measures its faces.

   FORMATS, told apart by what is in the file, not by its name
     OFF    text, with any of the prefixes ST, C, N; the counts on the same line as the word, with a blank or without
     OBJ    v, vn, f; other lines are skipped
     PLY    ascii, binary_little_endian, binary_big_endian
     STL    ascii and binary; its facets have copies of their vertices: mesh_file_orient joins them
     VTK    legacy, DATASET POLYDATA, ASCII: POLYGONS of both versions, TRIANGLE_STRIPS, NORMALS, point data
     Others are refused by name, with a program that converts them.

   DATA FLOW
     1 source   bytes, from wherever              mesh_source
     2 read     bytes -> vertices, faces, normals mesh_file_read
     3 orient   are the faces a surface?          mesh_file_orient: joins copies of vertices, turns faces round

   MEMORY AND COST
     Arrays come from malloc; mesh_file_free gives them back. When a call fails there is nothing to free from it.
     Reading takes linear time, orienting takes n log n. No globals; strtod heeds the locale, so leave LC_NUMERIC at
     "C". */
#ifndef SURFMINK_MESHFILE_H
#define SURFMINK_MESHFILE_H

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What may be wrong with a mesh. error.text says it in a sentence that begins with FILE:LINE. */
enum mesh_status {
    MESH_OK = 0,
    MESH_NO_MEMORY = 1,
    MESH_UNREADABLE = 2,    /* the file cannot be opened or read */
    MESH_MALFORMED = 3,     /* a line is not what the format asks for; too few or too many of them */
    MESH_NOT_TRIANGLES = 4, /* a face with fewer corners than 3 */
    MESH_BAD_INDEX = 5,     /* a face names a vertex that is not there, or one of them twice */
    MESH_TOO_LARGE = 6,     /* 2^32 half-edges or more */
    MESH_NOT_MANIFOLD = 7,  /* an edge with more than two faces, or a face twice: there is no surface there */
    MESH_NOT_ORIENTED = 8, /* two neighbours whose corners run the opposite way round, and turning them does not help */
    MESH_NO_NORMAL = 9,    /* the triangles at a vertex have no area, or their normals cancel */
    MESH_NOT_FINITE = 10,  /* a NaN or an infinity in a field or a level */
    MESH_BAD_ARGUMENT = 11 /* a step was left out: connect, normals */
};

typedef struct mesh_error {
    int status;
    char text
        [512]; /* a long file name is cut short here. It may quote what is in the file, control characters and all */
} mesh_error;

enum mesh_format { MESH_UNKNOWN = 0, MESH_OFF, MESH_OBJ, MESH_PLY, MESH_STL, MESH_STL_BINARY, MESH_VTK, MESH_OTHER };

/* Where the bytes come from. */
typedef struct mesh_source {
    const char *name;                                     /* for complaints */
    size_t (*read)(void *context, char *to, size_t most); /* 0 at the end, (size_t)-1 if it cannot be read */
    void *context;
} mesh_source;

typedef struct mesh_file {
    size_t vertices, faces;
    double *vertex;       /* 3 per vertex: x y z */
    size_t *begin;        /* faces + 1: where in `corner` the vertices of each face begin */
    uint32_t *corner;     /* counter-clockwise seen from outside, counted from 0 */
    unsigned long *line;  /* 1 per face: where the file has it; 0 in binary files */
    size_t normals;       /* 0: the file has none */
    double *normal;       /* 3 per normal, of any length */
    uint32_t *normal_of;  /* 1 per corner: its normal; NULL: normal v is that of vertex v */
    double *field;        /* 1 per vertex, as asked for; or NULL */
    char fields[256];     /* names of the scalars that the vertices have, with blanks between them */
    size_t infinite_line; /* of the first vertex that is not finite; 0: all are */
    uint32_t *joint;      /* from mesh_file_orient, 1 per vertex: the first of its copies */
    size_t joined;        /* from mesh_file_orient: vertices that are copies of another */
    size_t turned;        /* from mesh_file_orient: faces that ran against their neighbours, and were turned round */
    size_t first_turned;  /* the first of them */
    size_t shared;        /* from mesh_file_orient: edges with two faces */
} mesh_file;

#define MESH_NONE UINT32_MAX

/* Notes down what is wrong and returns the status. line = 0: the file as a whole. */
static inline int mesh__fail(mesh_error *error, int status, const char *name, size_t line, const char *format, ...)
{
    va_list arguments;
    char where[256];
    size_t used;
    if (!error) return status;
    error->status = status;
    if (name && line)
        snprintf(where, sizeof where, "%.220s:%lu: ", name, (unsigned long)line);
    else if (name)
        snprintf(where, sizeof where, "%.220s: ", name);
    else
        where[0] = 0;
    used = strlen(where);
    memcpy(error->text, where, used + 1);
    va_start(arguments, format);
    vsnprintf(error->text + used, sizeof error->text - used, format, arguments);
    va_end(arguments);
    return status;
}

/* Gives the arrays back and leaves an empty mesh. */
static inline void mesh_file_free(mesh_file *f)
{
    free(f->vertex);
    free(f->begin);
    free(f->corner);
    free(f->line);
    free(f->normal);
    free(f->normal_of);
    free(f->field);
    free(f->joint);
    memset(f, 0, sizeof *f);
}

/* The array with room for at least one more item, or NULL if there is no memory: then it is as before. */
static inline void *mesh__grow(void *array, size_t used, size_t *room, size_t bytes)
{
    size_t more = *room ? 2 * *room : 64;
    void *grown;
    if (used < *room) return array;
    if (more > SIZE_MAX / 2 / bytes) return NULL;
    grown = realloc(array, more * bytes);
    if (grown) *room = more;
    return grown;
}

static inline int mesh__no_memory(mesh_error *error, const char *name)
{
    mesh__fail(error, MESH_NO_MEMORY, name, 0, "out of memory");
    return MESH_NO_MEMORY;
}

/* --- 1. source: bytes -> lines, words ----------------------------------------------------------------------------- */

enum { MESH__LONGEST_LINE = 1 << 26, MESH__BLOCK = 1 << 15, MESH__LOOK_AHEAD = 1 << 14 };

typedef struct mesh__reader {
    const mesh_source *source;
    const char *name;
    char *block; /* of MESH__BLOCK bytes */
    size_t at, end;
    int ended;
    char *text; /* the line as it is being read, of room bytes */
    char *word; /* of formats that heed no lines: what follows on this one */
    size_t line, room;
    int again; /* the next line is this one: it has been looked at to tell the format */
    size_t vertex_room, normal_room, corner_room, of_room, begin_room, line_room, field_room;
    const char *field; /* that is asked for; NULL: none */
    mesh_error *error;
} mesh__reader;

/* Reads until so many bytes can be seen, or the file ends. */
static inline int mesh__look_ahead(mesh__reader *r, size_t bytes)
{
    if (r->at > 0) memmove(r->block, r->block + r->at, r->end - r->at);
    r->end -= r->at;
    r->at = 0;
    while (!r->ended && r->end < bytes) {
        size_t count = r->source->read(r->source->context, r->block + r->end, MESH__BLOCK - r->end);
        if (count == (size_t)-1) return mesh__fail(r->error, MESH_UNREADABLE, r->name, 0, "cannot be read");
        if (count == 0) r->ended = 1;
        r->end += count;
    }
    return MESH_OK;
}

/* The next byte, -1 at the end of the file, -2 if it cannot be read. */
static inline int mesh__byte(mesh__reader *r)
{
    if (r->at == r->end && mesh__look_ahead(r, 1) != MESH_OK) return -2;
    return r->at == r->end ? -1 : (unsigned char)r->block[r->at++];
}

/* A complaint about the line at hand, which quotes what stands there (cut short). */
static inline int mesh__malformed(const mesh__reader *r, const char *wanted, const char *found)
{
    size_t length = strlen(found += strspn(found, " \t"));
    if (!length) return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "expected %s, the line ends", wanted);
    return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "expected %s, got '%.*s'", wanted,
                      length < 40 ? (int)length : 40, found);
}

/* The next line, blank or not, without its end, which is \n, \r\n or a lone \r. *got = 0 at the end of the file. */
static inline int mesh__any_line(mesh__reader *r, int *got)
{
    size_t used = 0;
    int c;
    *got = 1;
    while ((c = mesh__byte(r)) >= 0) {
        void *grown = mesh__grow(r->text, used + 1, &r->room, 1);
        if (!grown) return mesh__no_memory(r->error, r->name);
        r->text = (char *)grown;
        if (c == '\r' && (r->at < r->end || mesh__look_ahead(r, 1) == MESH_OK) && r->at < r->end &&
            r->block[r->at] == '\n')
            c = mesh__byte(r);
        if (c == '\n' || c == '\r') break;
        if (used == MESH__LONGEST_LINE)
            return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line + 1,
                              "more than 64 MiB without the end of a line");
        if (c == 0) return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line + 1, "a zero byte: not a text file");
        r->text[used++] = (char)c;
    }
    if (c == -2) return MESH_UNREADABLE;
    if (c == -1 && !used) {
        *got = 0;
        return MESH_OK;
    }
    ++r->line;
    r->text[used] = 0;
    if (r->line == 1 && !strncmp(r->text, "\xef\xbb\xbf", 3)) memcpy(r->text, "   ", 3); /* a byte order mark */
    return MESH_OK;
}

/* The next line with something on it, comments (from # on) blanked out if there may be any. */
static inline int mesh__line(mesh__reader *r, int comments, int *got)
{
    *got = 1;
    if (r->again) {
        r->again = 0;
        return MESH_OK;
    }
    for (;;) {
        int status = mesh__any_line(r, got);
        if (status || !*got) return status;
        if (comments) r->text[strcspn(r->text, "#")] = 0;
        if (r->text[strspn(r->text, " \t")]) return MESH_OK;
    }
}

#ifndef MESH_STRTOD
#define MESH_STRTOD strtod /* yours may read the same numbers in every locale */
#endif

/* Reads a number at *at, or an integer, and moves on behind it; 0 if there is none. */
static inline int mesh__number(char **at, double *x)
{
    char *end;
    *x = MESH_STRTOD(*at, &end);
    if (end == *at || (*end && !strchr(" \t", *end))) return 0;
    *at = end;
    return 1;
}

/* What does not fit becomes LONG_MAX or LONG_MIN, which is no vertex. */
static inline int mesh__integer(char **at, const char *delimiters, long *k)
{
    char *end;
    *k = strtol(*at, &end, 10);
    if (end == *at || (*end && !strchr(delimiters, *end))) return 0;
    *at = end;
    return 1;
}

/* Whether the word comes next on the line; if so, moves on behind it. */
static inline int mesh__word(char **at, const char *word)
{
    char *from = *at + strspn(*at, " \t");
    size_t length = strlen(word);
    if (strncmp(from, word, length) != 0 || (from[length] && !strchr(" \t", from[length]))) return 0;
    *at = from + length;
    return 1;
}

/* --- 2. read: vertices, normals, faces ---------------------------------------------------------------------------- */

static inline int mesh__add_vertex(mesh__reader *r, mesh_file *f, const double x[3])
{
    void *grown = mesh__grow(f->vertex, f->vertices, &r->vertex_room, 3 * sizeof(double));
    int c;
    if (!grown) return mesh__no_memory(r->error, r->name);
    f->vertex = (double *)grown;
    if (f->vertices >= MESH_NONE) return mesh__fail(r->error, MESH_TOO_LARGE, r->name, r->line, "too many vertices");
    for (c = 0; c < 3; ++c)
        if (!(fabs(x[c]) <= DBL_MAX) && !f->infinite_line) f->infinite_line = r->line ? r->line : 1;
    memcpy(f->vertex + 3 * f->vertices++, x, 3 * sizeof(double));
    return MESH_OK;
}

/* The same from the text at *at. */
static inline int mesh__read_vertex(mesh__reader *r, mesh_file *f, char **at)
{
    static const char *const wanted[3] = {"a number x", "a number y", "a number z"};
    double x[3];
    int c;
    for (c = 0; c < 3; ++c)
        if (!mesh__number(at, &x[c])) return mesh__malformed(r, wanted[c], *at);
    return mesh__add_vertex(r, f, x);
}

static inline int mesh__add_normal(mesh__reader *r, mesh_file *f, const double x[3])
{
    void *grown = mesh__grow(f->normal, f->normals, &r->normal_room, 3 * sizeof(double));
    if (!grown) return mesh__no_memory(r->error, r->name);
    f->normal = (double *)grown;
    memcpy(f->normal + 3 * f->normals++, x, 3 * sizeof(double));
    return MESH_OK;
}

static inline int mesh__add_value(mesh__reader *r, mesh_file *f, size_t vertex, double value)
{
    void *grown = mesh__grow(f->field, vertex, &r->field_room, sizeof(double));
    if (!grown) return mesh__no_memory(r->error, r->name);
    f->field = (double *)grown;
    f->field[vertex] = value;
    return MESH_OK;
}

/* Notes down the name of a scalar that the vertices have. Is it the one asked for? */
static inline int mesh__is_field(const mesh__reader *r, mesh_file *f, const char *name, size_t length)
{
    size_t used = strlen(f->fields);
    if (used + length + 2 < sizeof f->fields) {
        if (used) f->fields[used++] = ' ';
        memcpy(f->fields + used, name, length);
        f->fields[used + length] = 0;
    }
    return r->field && strlen(r->field) == length && memcmp(r->field, name, length) == 0;
}

/* A corner of the face that is being read; vertices are counted from 0 and looked up when all have been read. */
static inline int mesh__add_corner(mesh__reader *r, mesh_file *f, size_t corners, long vertex)
{
    void *grown = mesh__grow(f->corner, corners, &r->corner_room, sizeof *f->corner);
    if (!grown) return mesh__no_memory(r->error, r->name);
    f->corner = (uint32_t *)grown;
    if (vertex < 0 || (unsigned long)vertex >= MESH_NONE)
        return mesh__fail(r->error, MESH_BAD_INDEX, r->name, r->line, "there is no vertex %ld", vertex);
    if (corners >= MESH_NONE) return mesh__fail(r->error, MESH_TOO_LARGE, r->name, r->line, "too many corners");
    f->corner[corners] = (uint32_t)vertex;
    return MESH_OK;
}

/* The face ends: it has the corners up to here. */
static inline int mesh__end_face(mesh__reader *r, mesh_file *f, size_t corners)
{
    void *grown = mesh__grow(f->begin, f->faces + 1, &r->begin_room, sizeof *f->begin);
    if (grown) f->begin = (size_t *)grown;
    if (grown) grown = mesh__grow(f->line, f->faces, &r->line_room, sizeof *f->line);
    if (!grown) return mesh__no_memory(r->error, r->name);
    f->line = (unsigned long *)grown;
    f->line[f->faces] = (unsigned long)r->line;
    f->begin[0] = 0;
    f->begin[++f->faces] = corners;
    return MESH_OK;
}

static inline size_t mesh__corners(const mesh_file *f)
{
    return f->faces ? f->begin[f->faces] : 0;
}

/* A face as OFF and PLY write it: 3 a b c. */
static inline int mesh__read_face(mesh__reader *r, mesh_file *f, char **at)
{
    long count, vertex, k;
    size_t corners = mesh__corners(f);
    int status;
    if (!mesh__integer(at, " \t", &count) || count < 0) return mesh__malformed(r, "a number of corners", *at);
    for (k = 0; k < count; ++k) {
        if (!(*at)[strspn(*at, " \t")])
            return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "%ld corners are announced, %ld follow",
                              count, k);
        if (!mesh__integer(at, " \t", &vertex)) return mesh__malformed(r, "the number of a vertex", *at);
        status = mesh__add_corner(r, f, corners++, vertex);
        if (status) return status;
    }
    return mesh__end_face(r, f, corners);
}

static inline int mesh__ends(const mesh__reader *r, long after, long promised, const char *what)
{
    return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the file ends after %ld of %ld %s", after, promised,
                      what);
}

/* --- OFF ---------------------------------------------------------------------------------------------------------- */

/* What follows x y z in a vertex of OFF with the prefix N: the normal and, with C, a colour, in either order. Of the
   first vertex the three numbers of length 1 are the normal; of which: 0 the first three, 1 the last three. */
static inline int mesh__off_normal(mesh__reader *r, mesh_file *f, char *at, int *which)
{
    double more[8], length[2] = {0, 0};
    size_t count = 0, c;
    while (count < 8 && mesh__number(&at, &more[count])) ++count;
    if (count < 3 || f->normals + 1 != f->vertices) return MESH_OK; /* no normal, or none at a vertex before */
    for (c = 0; c < 3; ++c) length[0] += more[c] * more[c], length[1] += more[count - 3 + c] * more[count - 3 + c];
    if (f->normals == 0) *which = fabs(length[0] - 1) > 0.01 && fabs(length[1] - 1) <= 0.01;
    return mesh__add_normal(r, f, *which ? more + count - 3 : more);
}

/* OFF: the word OFF (or COFF, NOFF, ...), numbers of vertices, faces and edges, vertices, faces. */
static inline int mesh__read_off(mesh__reader *r, mesh_file *f)
{
    long count[2], k;
    char *at = strstr(r->text, "OFF") + 3;
    int got, status, which = 0, has_normals = strcspn(r->text, "N") < strcspn(r->text, "O");
    r->again = 0;
    if (mesh__word(&at, "BINARY"))
        return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line,
                          "binary OFF is not read: MeshLab saves it as text, or as PLY");
    if (!at[strspn(at, " \t")]) { /* the counts stand on the next line, or behind the word */
        status = mesh__line(r, 1, &got);
        if (status) return status;
        if (!got) return mesh__ends(r, 0, 2, "counts");
        at = r->text;
    }
    for (k = 0; k < 2; ++k)
        if (!mesh__integer(&at, " \t", &count[k]) || count[k] < 0 || count[k] > LONG_MAX / 2)
            return mesh__malformed(r, "the numbers of vertices and faces", at);
    for (k = 0; k < count[0] + count[1]; ++k) {
        status = mesh__line(r, 1, &got);
        if (status) return status;
        if (!got)
            return k < count[0] ? mesh__ends(r, k, count[0], "vertices")
                                : mesh__ends(r, k - count[0], count[1], "faces");
        at = r->text;
        status = k < count[0] ? mesh__read_vertex(r, f, &at) : mesh__read_face(r, f, &at);
        if (!status && k < count[0] && has_normals) status = mesh__off_normal(r, f, at, &which);
        if (status) return status;
    }
    if (f->normals != f->vertices) f->normals = 0;
    status = mesh__line(r, 1, &got);
    return status || !got ? status : mesh__malformed(r, "the end of the file after its last face", r->text);
}

/* --- OBJ ---------------------------------------------------------------------------------------------------------- */

/* The number of a vertex or normal, of which there are `count` so far: from 1, or from -1 for the latest. */
static inline long mesh__obj_index(long k, size_t count)
{
    return k > 0 ? k - 1 : k > -LONG_MAX ? k + (long)count : -1;
}

/* Corner a, a/t, a//n or a/t/n; *normal = -1 without n. */
static inline int mesh__obj_corner(mesh__reader *r, const mesh_file *f, char **at, long *vertex, long *normal)
{
    long k;
    int slash;
    *normal = -1;
    for (slash = 0; slash < 3; ++slash) {
        if (slash == 1 && **at == '/') { /* no t */
            ++*at;
            continue;
        }
        if (strcmp(*at + strspn(*at, " \t"), "\\") == 0)
            return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line,
                              "a line that goes on in the next one is not read: MeshLab saves faces on one line");
        if (!mesh__integer(at, "/ \t", &k)) return mesh__malformed(r, "the number of a vertex", *at);
        if (k == 0) return mesh__fail(r->error, MESH_BAD_INDEX, r->name, r->line, "OBJ counts vertices from 1");
        if (slash == 0) *vertex = mesh__obj_index(k, f->vertices);
        if (slash == 2) *normal = mesh__obj_index(k, f->normals);
        if (slash == 2 && (*normal < 0 || (size_t)*normal >= f->normals))
            return mesh__fail(r->error, MESH_BAD_INDEX, r->name, r->line, "there is no normal %ld", k);
        if (**at != '/' || !(*at)[1] || strchr(" \t", (*at)[1])) break;
        ++*at;
    }
    *at += strcspn(*at, " \t");
    return MESH_OK;
}

static inline int mesh__obj_face(mesh__reader *r, mesh_file *f, char *at, int *complete)
{
    size_t corners = mesh__corners(f);
    while (at[strspn(at, " \t")]) {
        long vertex = 0, normal = -1;
        void *grown;
        int status = mesh__obj_corner(r, f, &at, &vertex, &normal);
        if (!status) status = mesh__add_corner(r, f, corners, vertex);
        if (status) return status;
        grown = mesh__grow(f->normal_of, corners, &r->of_room, sizeof *f->normal_of);
        if (!grown) return mesh__no_memory(r->error, r->name);
        f->normal_of = (uint32_t *)grown;
        if (normal < 0) *complete = 0;
        f->normal_of[corners++] = *complete ? (uint32_t)normal : 0;
    }
    return mesh__end_face(r, f, corners);
}

/* OBJ: lines v x y z, vn x y z and f a b c; every other line is skipped. */
static inline int mesh__read_obj(mesh__reader *r, mesh_file *f)
{
    int complete = 1; /* does every corner have a normal? */
    for (;;) {
        char *at;
        double x[3];
        int got, status = mesh__line(r, 1, &got);
        if (status) return status;
        if (!got) break;
        at = r->text;
        if (mesh__word(&at, "v"))
            status = mesh__read_vertex(r, f, &at);
        else if (mesh__word(&at, "vn"))
            status = mesh__number(&at, x) && mesh__number(&at, x + 1) && mesh__number(&at, x + 2)
                         ? mesh__add_normal(r, f, x)
                         : mesh__malformed(r, "a normal", at);
        else if (mesh__word(&at, "f"))
            status = mesh__obj_face(r, f, at, &complete);
        if (status) return status;
    }
    if (!complete) f->normals = 0;
    return MESH_OK;
}

/* --- PLY ---------------------------------------------------------------------------------------------------------- */

enum { MESH__ELEMENTS = 16, MESH__PROPERTIES = 64 };

/* What a property is to us: a coordinate x y z, of a normal a b c, the list of corners v, the field f, or nothing. */
typedef struct mesh__property {
    char is, type, count; /* types: c C s S i I f d; count is 0 for what is no list */
} mesh__property;

typedef struct mesh__element {
    char is; /* v vertex, f face, s something else */
    long count;
    int properties;
    mesh__property property[MESH__PROPERTIES];
} mesh__element;

/* A type of PLY as a letter, 0 if there is none of that name. */
static inline char mesh__ply_type(char **at)
{
    static const char *const name[] = {"char", "int8",  "uchar", "uint8",  "short", "int16",   "ushort", "uint16",
                                       "int",  "int32", "uint",  "uint32", "float", "float32", "double", "float64"};
    static const char letter[] = "ccCCssSSiiIIffdd";
    int k;
    for (k = 0; k < 16; ++k)
        if (mesh__word(at, name[k])) return letter[k];
    return 0;
}

static inline int mesh__ply_property(mesh__reader *r, mesh_file *f, mesh__element *e, char *at)
{
    static const char *const known[] = {"x", "y", "z", "nx", "ny", "nz"};
    mesh__property *p = &e->property[e->properties];
    int k;
    memset(p, 0, sizeof *p);
    if (mesh__word(&at, "list") && !(p->count = mesh__ply_type(&at))) return mesh__malformed(r, "a type of PLY", at);
    p->type = mesh__ply_type(&at);
    if (!p->type) return mesh__malformed(r, "a type of PLY", at);
    at += strspn(at, " \t");
    if (!*at) return mesh__malformed(r, "the name of a property", at);
    for (k = 0; k < 6 && e->is == 'v' && !p->count; ++k) {
        char *end = at;
        if (mesh__word(&end, known[k])) p->is = "xyzabc"[k];
    }
    if (e->is == 'v' && !p->count && !p->is && mesh__is_field(r, f, at, strcspn(at, " \t"))) p->is = 'f';
    if (e->is == 'f' && p->count && (mesh__word(&at, "vertex_indices") || mesh__word(&at, "vertex_index"))) p->is = 'v';
    ++e->properties;
    return MESH_OK;
}

/* The header; *format becomes a (ascii), l or b (endian), 0 without a line that says so. */
static inline int mesh__ply_header(mesh__reader *r, mesh_file *f, mesh__element *element, int *elements, char *format)
{
    for (;;) {
        mesh__element *e = element + *elements - 1;
        char *at;
        int got, status = mesh__line(r, 0, &got);
        if (status) return status;
        if (!got) return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the file ends before end_header");
        at = r->text;
        if (mesh__word(&at, "end_header")) return MESH_OK;
        if (mesh__word(&at, "format")) {
            *format = (char)(mesh__word(&at, "ascii")                  ? 'a'
                             : mesh__word(&at, "binary_little_endian") ? 'l'
                             : mesh__word(&at, "binary_big_endian")    ? 'b'
                                                                       : 0);
            if (!*format) return mesh__malformed(r, "ascii, binary_little_endian or binary_big_endian", at);
        } else if (mesh__word(&at, "element")) {
            if (*elements == MESH__ELEMENTS) return mesh__malformed(r, "at most 16 kinds of elements", r->text);
            e = element + (*elements)++;
            memset(e, 0, sizeof *e);
            if (mesh__word(&at, "tristrips"))
                return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line,
                                  "triangle strips of PLY are not read: MeshLab saves faces");
            e->is = (char)(mesh__word(&at, "vertex") ? 'v' : mesh__word(&at, "face") ? 'f' : 's');
            if (e->is == 's') at += strspn(at, " \t"), at += strcspn(at, " \t");
            if (!mesh__integer(&at, " \t", &e->count) || e->count < 0)
                return mesh__malformed(r, "a number of elements", at);
        } else if (mesh__word(&at, "property")) {
            if (*elements == 0 || e->properties == MESH__PROPERTIES)
                return mesh__malformed(r, "an element first, and at most 64 properties of it", r->text);
            status = mesh__ply_property(r, f, e, at);
            if (status) return status;
        } else if (!mesh__word(&at, "comment") && !mesh__word(&at, "obj_info")) {
            return mesh__malformed(r, "a line of a PLY header", r->text);
        }
    }
}

/* The next number of a PLY: from the text at *at, or of this type from the bytes of the file. */
static inline int mesh__ply_number(mesh__reader *r, char format, char type, char **at, double *x)
{
    static const char letters[] = "cCsSiIfd";
    static const int sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    int k, c, size = sizes[strchr(letters, type) - letters];
    uint64_t bits = 0;
    uint32_t half;
    float single;
    if (format == 'a') return mesh__number(at, x) ? MESH_OK : mesh__malformed(r, "a number for each property", *at);
    for (k = 0; k < size; ++k) {
        c = mesh__byte(r);
        if (c == -2) return MESH_UNREADABLE;
        if (c < 0) return mesh__fail(r->error, MESH_MALFORMED, r->name, 0, "the file ends within its numbers");
        bits |= (uint64_t)c << 8 * (format == 'l' ? k : size - 1 - k);
    }
    half = (uint32_t)bits;
    memcpy(&single, &half, sizeof single);
    switch (type) {
    case 'c': *x = bits < 0x80 ? (double)bits : (double)bits - 0x100; break;
    case 's': *x = bits < 0x8000 ? (double)bits : (double)bits - 0x10000; break;
    case 'i': *x = bits < 0x80000000 ? (double)bits : (double)bits - 4294967296.0; break;
    case 'f': *x = (double)single; break;
    case 'd': memcpy(x, &bits, sizeof *x); break;
    default: *x = (double)bits;
    }
    return MESH_OK;
}

/* The list of corners of a face. */
static inline int mesh__ply_face(mesh__reader *r, mesh_file *f, char format, const mesh__property *p, char **at)
{
    double count, vertex, k;
    size_t corners = mesh__corners(f);
    int status;
    if (format == 'a') return mesh__read_face(r, f, at);
    status = mesh__ply_number(r, format, p->count, at, &count);
    for (k = 0; !status && k < count; ++k) {
        status = mesh__ply_number(r, format, p->type, at, &vertex);
        if (!status) status = mesh__add_corner(r, f, corners++, vertex >= 0 && vertex < 1e10 ? (long)vertex : -1);
    }
    return status ? status : mesh__end_face(r, f, corners);
}

/* One element: its line, or its bytes. */
static inline int mesh__ply_element(mesh__reader *r, mesh_file *f, char format, const mesh__element *e)
{
    double x[3] = {0, 0, 0}, normal[3] = {0, 0, 0}, value = 0, count, ignored;
    char *at = r->text, is_normal = 0;
    int k, status = MESH_OK;
    for (k = 0; !status && k < e->properties; ++k) {
        const mesh__property *p = &e->property[k];
        if (p->is == 'v') {
            status = mesh__ply_face(r, f, format, p, &at);
        } else if (p->count) {
            status = mesh__ply_number(r, format, p->count, &at, &count);
            for (; !status && count > 0; --count) status = mesh__ply_number(r, format, p->type, &at, &ignored);
        } else {
            double *to = !p->is ? &ignored : &value;
            if (p->is >= 'x' && p->is <= 'z') to = x + (p->is - 'x');
            if (p->is >= 'a' && p->is <= 'c') to = normal + (p->is - 'a');
            if (p->is >= 'a' && p->is <= 'c') is_normal = 1;
            status = mesh__ply_number(r, format, p->type, &at, to);
        }
    }
    if (!status && format == 'a' && at[strspn(at, " \t")])
        status = mesh__malformed(r, "no more numbers than properties", at);
    if (!status && e->is == 'v') {
        if (is_normal) status = mesh__add_normal(r, f, normal);
        for (k = 0; !status && k < e->properties; ++k)
            if (e->property[k].is == 'f') status = mesh__add_value(r, f, f->vertices, value);
        if (!status) status = mesh__add_vertex(r, f, x);
    }
    return status;
}

/* PLY: a header that names elements (vertex, face, others) and their properties, then each element. */
static inline int mesh__read_ply(mesh__reader *r, mesh_file *f)
{
    mesh__element *element = (mesh__element *)malloc(MESH__ELEMENTS * sizeof *element);
    int elements = 0, got, e, k, status;
    char format = 0;
    if (!element) return mesh__no_memory(r->error, r->name);
    r->again = 0;
    status = mesh__ply_header(r, f, element, &elements, &format);
    if (!status && !format)
        status = mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the header has no line 'format ascii 1.0'");
    if (!status && format != 'a') r->line = 0;
    for (e = 0; !status && e < elements; ++e) {
        int seen[128] = {0};
        const mesh__element *all = &element[e];
        long i;
        for (k = 0; k < all->properties; ++k) ++seen[(int)all->property[k].is];
        if (all->is == 'v' && !(seen['x'] && seen['y'] && seen['z']))
            status = mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the vertices have no x, y, z");
        if (all->is == 'f' && seen['v'] != 1)
            status = mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the faces have no list vertex_indices");
        for (i = 0; !status && i < all->count && all->properties; ++i) {
            got = 1;
            if (format == 'a') status = mesh__line(r, 0, &got);
            if (!status && !got)
                status = mesh__ends(r, i, all->count,
                                    all->is == 'v'   ? "vertices"
                                    : all->is == 'f' ? "faces"
                                                     : "other elements");
            if (!status) status = mesh__ply_element(r, f, format, all);
        }
    }
    free(element);
    if (status) return status;
    if (format == 'a') {
        status = mesh__line(r, 0, &got);
        return status || !got ? status : mesh__malformed(r, "the end of the file after its last element", r->text);
    }
    return mesh__byte(r) == -1 ? MESH_OK
                               : mesh__fail(r->error, MESH_MALFORMED, r->name, 0, "bytes after the last element");
}

/* --- STL ---------------------------------------------------------------------------------------------------------- */

/* STL as text: every line `vertex x y z` is a corner, `endfacet` ends a face; the normals are those of the facets. */
static inline int mesh__read_stl(mesh__reader *r, mesh_file *f)
{
    size_t corners = 0;
    for (;;) {
        char *at;
        int got, status = mesh__line(r, 0, &got);
        if (status) return status;
        if (!got)
            return corners == mesh__corners(f)
                       ? MESH_OK
                       : mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the file ends within a facet");
        at = r->text;
        if (mesh__word(&at, "vertex")) {
            status = mesh__read_vertex(r, f, &at);
            if (!status) status = mesh__add_corner(r, f, corners++, (long)f->vertices - 1);
        } else if (mesh__word(&at, "endfacet")) {
            status = mesh__end_face(r, f, corners);
        } else if (!mesh__word(&at, "facet") && !mesh__word(&at, "outer") && !mesh__word(&at, "endloop") &&
                   !mesh__word(&at, "solid") && !mesh__word(&at, "endsolid")) {
            status = mesh__malformed(r, "a line of an STL file", r->text);
        }
        if (status) return status;
    }
}

/* STL in bytes: 80 of a header, the number of facets, and of each 12 numbers of 4 bytes and 2 more bytes. */
static inline int mesh__read_stl_binary(mesh__reader *r, mesh_file *f)
{
    double number[12] = {0}, count, i;
    char *none = NULL;
    int k, status = MESH_OK;
    r->at += 80;
    r->line = 0;
    status = mesh__ply_number(r, 'l', 'I', &none, &count);
    for (i = 0; !status && i < count; ++i) {
        for (k = 0; !status && k < 12; ++k) status = mesh__ply_number(r, 'l', 'f', &none, &number[k]);
        if (!status) status = mesh__ply_number(r, 'l', 'S', &none, &number[0]);
        for (k = 0; !status && k < 3; ++k) {
            status = mesh__add_vertex(r, f, number + 3 + 3 * (size_t)k);
            if (!status) status = mesh__add_corner(r, f, f->vertices - 1, (long)f->vertices - 1);
        }
        if (!status) status = mesh__end_face(r, f, f->vertices);
    }
    if (status || mesh__byte(r) == -1) return status;
    return mesh__fail(r->error, MESH_MALFORMED, r->name, 0, "bytes after the last of %.0f facets of a binary STL",
                      count);
}

/* --- VTK ---------------------------------------------------------------------------------------------------------- */

/* The next word of the file, on this line or a later one; at the end of the file NULL. */
static inline int mesh__vtk_word(mesh__reader *r, char **word)
{
    int got, status;
    while (!r->word || !*(r->word += strspn(r->word, " \t"))) {
        status = mesh__line(r, 0, &got);
        if (status) return status;
        r->word = got ? r->text : NULL;
        *word = NULL;
        if (!got) return MESH_OK;
    }
    *word = r->word;
    r->word += strcspn(r->word, " \t");
    if (*r->word) *r->word++ = 0;
    return MESH_OK;
}

static inline int mesh__vtk_number(mesh__reader *r, double *x)
{
    char *word;
    int status = mesh__vtk_word(r, &word);
    if (status) return status;
    if (!word) return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the file ends before its last number");
    return mesh__number(&word, x) && !*word ? MESH_OK : mesh__malformed(r, "a number", word);
}

static inline int mesh__vtk_count(mesh__reader *r, long *count)
{
    double x = 0;
    int status = mesh__vtk_number(r, &x);
    if (status) return status;
    if (!(x >= 0 && x < 1e10 && floor(x) >= x))
        return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "expected a whole number, got %g", x);
    *count = (long)x;
    return MESH_OK;
}

/* So many numbers that do not matter. */
static inline int mesh__vtk_skip(mesh__reader *r, double count)
{
    double x;
    int status = MESH_OK;
    for (; !status && count > 0; --count) status = mesh__vtk_number(r, &x);
    return status;
}

/* Faces as `n a b c` each. A strip a b c d ... is the triangles a b c, c b d, ...; where strips are sewn together, some
   have a corner twice, and are none. */
static inline int mesh__vtk_faces(mesh__reader *r, mesh_file *f, long faces, int strips)
{
    long i, k, n = 0, vertex = 0, two[2] = {0, 0};
    int status = MESH_OK;
    for (i = 0; !status && i < faces; ++i) {
        size_t corners = mesh__corners(f);
        status = mesh__vtk_count(r, &n);
        for (k = 0; !status && k < n; ++k) {
            status = mesh__vtk_count(r, &vertex);
            if (!status && !strips) status = mesh__add_corner(r, f, corners++, vertex);
            if (!status && strips && k >= 2 && two[0] != two[1] && two[0] != vertex && two[1] != vertex) {
                status = mesh__add_corner(r, f, corners++, two[0]);
                if (!status) status = mesh__add_corner(r, f, corners++, two[1]);
                if (!status) status = mesh__add_corner(r, f, corners++, vertex);
                if (!status) status = mesh__end_face(r, f, corners);
            }
            two[k % 2] = vertex;
        }
        if (!status && !strips) status = mesh__end_face(r, f, corners);
    }
    return status;
}

/* Faces as version 5 has them: OFFSETS type, where each begins in the list behind CONNECTIVITY type. */
static inline int mesh__vtk_offsets(mesh__reader *r, mesh_file *f, long offsets, long size)
{
    long i, k, vertex = 0, *offset = (long *)malloc(((size_t)offsets + 1) * sizeof *offset);
    size_t corners = mesh__corners(f);
    char *word;
    int status = offset ? mesh__vtk_word(r, &word) : mesh__no_memory(r->error, r->name); /* the type */
    for (i = 0; !status && i < offsets; ++i) {
        status = mesh__vtk_count(r, &offset[i]);
        if (!status && (i ? offset[i] < offset[i - 1] || offset[i] > size : offset[i] != 0))
            status =
                mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "OFFSETS do not count up from 0 to %ld", size);
    }
    if (!status) status = mesh__vtk_word(r, &word);
    if (!status && !(word && strcmp(word, "CONNECTIVITY") == 0))
        status = mesh__malformed(r, "CONNECTIVITY behind OFFSETS", word ? word : "");
    if (!status) status = mesh__vtk_word(r, &word);
    for (i = 0; !status && i + 1 < offsets; ++i) {
        for (k = offset[i]; !status && k < offset[i + 1]; ++k) {
            status = mesh__vtk_count(r, &vertex);
            if (!status) status = mesh__add_corner(r, f, corners++, vertex);
        }
        if (!status) status = mesh__end_face(r, f, corners);
    }
    free(offset);
    return status;
}

/* One array of point or cell data: `components` numbers for each of `count`. */
static inline int mesh__vtk_array(mesh__reader *r, mesh_file *f, long count, double components, int wanted)
{
    double x = 0;
    long i;
    int status = MESH_OK;
    if (!wanted) return mesh__vtk_skip(r, (double)count * components);
    for (i = 0; !status && i < count; ++i) {
        status = mesh__vtk_number(r, &x);
        if (!status) status = mesh__add_value(r, f, (size_t)i, x);
    }
    return status;
}

/* FIELD name arrays: of each its name, components, tuples, type, and the numbers. points: of point data. */
static inline int mesh__vtk_field(mesh__reader *r, mesh_file *f, int points)
{
    long arrays = 0, components = 0, tuples = 0, i;
    char *word;
    int wanted = 0, status = mesh__vtk_word(r, &word);
    if (!status) status = mesh__vtk_count(r, &arrays);
    for (i = 0; !status && i < arrays; ++i) {
        status = mesh__vtk_word(r, &word);
        if (!status && word && strcmp(word, "METADATA") == 0) { /* up to a blank line, behind an array */
            int got = 1;
            while (!status && got && r->text[strspn(r->text, " \t")]) status = mesh__any_line(r, &got);
            r->word = NULL;
            if (!status) status = mesh__vtk_word(r, &word);
        }
        if (status) return status;
        if (!word) return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the file ends before a field");
        if (points) wanted = mesh__is_field(r, f, word, strlen(word));
        status = mesh__vtk_count(r, &components);
        if (!status) status = mesh__vtk_count(r, &tuples);
        if (!status) status = mesh__vtk_word(r, &word);
        if (!status && wanted && components != 1)
            status = mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "'%s' has %ld components, not 1", r->field,
                                components);
        if (!status) status = mesh__vtk_array(r, f, tuples, (double)components, wanted);
    }
    return status;
}

/* What stands behind POINT_DATA or CELL_DATA, for `count` points or cells. Returns -1 if it is something else. */
static inline int mesh__vtk_data(mesh__reader *r, mesh_file *f, const char *key, long count, int points)
{
    char *word;
    double components = 1, x[3] = {0, 0, 0};
    long i, n = 0;
    int k, wanted = 0, status;
    if (strcmp(key, "FIELD") == 0) return mesh__vtk_field(r, f, points);
    if (strcmp(key, "SCALARS") != 0 && strcmp(key, "NORMALS") != 0 && strcmp(key, "VECTORS") != 0 &&
        strcmp(key, "TENSORS") != 0 && strcmp(key, "TEXTURE_COORDINATES") != 0 && strcmp(key, "COLOR_SCALARS") != 0 &&
        strcmp(key, "LOOKUP_TABLE") != 0)
        return -1;
    k = key[0] == 'S'   ? 's'
        : key[0] == 'L' ? 'l'
        : key[0] == 'C' ? 'c'
        : key[1] == 'O' ? 'n'
        : key[2] == 'X' ? 't'
                        : 'v';
    if (key[0] == 'T' && key[2] == 'N') components = 9;
    status = mesh__vtk_word(r, &word); /* the name */
    if (!status && !word) return mesh__malformed(r, "a name", "");
    if (!status && k == 's' && points) wanted = mesh__is_field(r, f, word, strlen(word));
    if (!status && (k == 'l' || k == 'c')) { /* a table of colours, and colours */
        status = mesh__vtk_count(r, &n);
        return status ? status : mesh__vtk_skip(r, k == 'l' ? 4.0 * (double)n : (double)count * (double)n);
    }
    if (!status && k == 't') {
        status = mesh__vtk_count(r, &n);
        components = (double)n;
    }
    if (!status) status = mesh__vtk_word(r, &word); /* the type */
    if (!status && k == 's') {
        if (r->word && mesh__number(&r->word, x)) components = x[0];
        status = mesh__vtk_word(r, &word);
        if (!status && !(word && strcmp(word, "LOOKUP_TABLE") == 0))
            return mesh__malformed(r, "LOOKUP_TABLE behind SCALARS", word ? word : "");
        if (!status) status = mesh__vtk_word(r, &word);
        if (!status && wanted && components > 1) wanted = 0;
    }
    if (status) return status;
    if (k == 's' || k == 't') return mesh__vtk_array(r, f, count, components, wanted);
    if (components < 2) components = 3;
    if (k != 'n' || !points) return mesh__vtk_skip(r, (double)count * components);
    for (i = 0; !status && i < count; ++i) {
        for (k = 0; !status && k < 3; ++k) status = mesh__vtk_number(r, &x[k]);
        if (!status) status = mesh__add_normal(r, f, x);
    }
    return status;
}

/* The word comes again. */
static inline void mesh__vtk_put_back(mesh__reader *r, char *word)
{
    char *end = word + strlen(word);
    if (r->word > end) *end = ' ';
    r->word = word;
}

/* POLYGONS and TRIANGLE_STRIPS are faces; VERTICES and LINES are none. */
static inline int mesh__vtk_cells(mesh__reader *r, mesh_file *f, const char *key)
{
    char *word = NULL;
    long count = 0, size = 0;
    int is_faces = strcmp(key, "POLYGONS") == 0, is_strips = strcmp(key, "TRIANGLE_STRIPS") == 0;
    int status = mesh__vtk_count(r, &count);
    if (!status) status = mesh__vtk_count(r, &size);
    if (!status) status = mesh__vtk_word(r, &word);
    if (status || !word) return status;
    if (strcmp(word, "OFFSETS") == 0 && is_faces) return mesh__vtk_offsets(r, f, count, size);
    if (strcmp(word, "OFFSETS") == 0) {
        if (is_strips)
            return mesh__fail(
                r->error, MESH_MALFORMED, r->name, r->line,
                "triangle strips with OFFSETS are not read: ParaView's filter Triangulate makes polygons");
        status = mesh__vtk_word(r, &word); /* the type */
        if (!status) status = mesh__vtk_skip(r, (double)count);
        if (!status) status = mesh__vtk_word(r, &word);
        if (!status) status = mesh__vtk_word(r, &word);
        return status ? status : mesh__vtk_skip(r, (double)size);
    }
    mesh__vtk_put_back(r, word);
    if (is_faces || is_strips) return mesh__vtk_faces(r, f, count, is_strips);
    return mesh__vtk_skip(r, (double)size);
}

/* The head of a VTK file, up to DATASET POLYDATA. */
static inline int mesh__vtk_head(mesh__reader *r)
{
    static const char surface[] =
        "DATASET %.40s is no surface: ParaView's filter Extract Surface makes one; save it as PLY";
    char *at, *word;
    int got = 1, status;
    r->again = 0;
    status = mesh__any_line(r, &got); /* the title */
    if (!status && got) status = mesh__line(r, 0, &got);
    if (status) return status;
    at = r->text;
    if (got && mesh__word(&at, "BINARY"))
        return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line,
                          "binary VTK is not read: ParaView saves it as ascii, or as PLY");
    if (!got || !mesh__word(&at, "ASCII")) return mesh__malformed(r, "ASCII", got ? r->text : "");
    status = mesh__vtk_word(r, &word);
    if (!status && !(word && strcmp(word, "DATASET") == 0)) return mesh__malformed(r, "DATASET", word ? word : "");
    if (!status) status = mesh__vtk_word(r, &word);
    if (!status && !(word && strcmp(word, "POLYDATA") == 0))
        return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, surface, word ? word : "");
    return status;
}

/* VTK: sections, each of which says what it is and how long. */
static inline int mesh__read_vtk(mesh__reader *r, mesh_file *f)
{
    long count = 0, i;
    int points = 0, k, status = mesh__vtk_head(r);
    while (!status) {
        char *word, key[32];
        double x[3];
        status = mesh__vtk_word(r, &word);
        if (status || !word) break;
        snprintf(key, sizeof key, "%s", word);
        if (strcmp(key, "POINTS") == 0) {
            status = mesh__vtk_count(r, &count);
            if (!status) status = mesh__vtk_word(r, &word); /* the type */
            for (i = 0; !status && i < count; ++i) {
                for (k = 0; !status && k < 3; ++k) status = mesh__vtk_number(r, &x[k]);
                if (!status) status = mesh__add_vertex(r, f, x);
            }
        } else if (strcmp(key, "POLYGONS") == 0 || strcmp(key, "TRIANGLE_STRIPS") == 0 || strcmp(key, "LINES") == 0 ||
                   strcmp(key, "VERTICES") == 0) {
            status = mesh__vtk_cells(r, f, key);
        } else if (strcmp(key, "POINT_DATA") == 0 || strcmp(key, "CELL_DATA") == 0) {
            points = key[0] == 'P';
            status = mesh__vtk_count(r, &count);
            if (!status && points && (size_t)count != f->vertices)
                status = mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "POINT_DATA of %ld points, not %lu",
                                    count, (unsigned long)f->vertices);
        } else if (strcmp(key, "METADATA") == 0) {
            int got = 1;
            while (!status && got && r->text[strspn(r->text, " \t")]) status = mesh__any_line(r, &got);
            r->word = NULL;
        } else {
            status = mesh__vtk_data(r, f, key, count, points);
            if (status == -1) status = mesh__malformed(r, "a section of a VTK file", key);
        }
    }
    if (f->normals != f->vertices) f->normals = 0;
    return status;
}

/* --- which format ------------------------------------------------------------------------------------------------- */

/* Files of other programs: how they begin, what they are, and what makes them readable. */
static inline int mesh__is_foreign(const char *first, size_t length, const char **what, const char **how)
{
    static const struct {
        const char *begin;
        size_t length;
        const char *what, *how;
    } known[] = {{"\x1f\x8b", 2, "compressed (gzip)", "gzip -dc FILE | ... - reads it"},
                 {"PK\x03\x04", 4, "a zip archive (xlsx, 3mf, kmz, RoiSet)",
                  "unzip it; spreadsheets save CSV, ImageJ XY coordinates"},
                 {"glTF", 4, "binary glTF", "Blender or MeshLab saves it as PLY"},
                 {"<VTKFile", 8, "XML of VTK", "ParaView saves it as PLY, or meshio convert IN OUT.ply"},
                 {"<GIFTI", 6, "a GIFTI surface", "mris_convert IN OUT.stl"},
                 {"<COLLADA", 8, "COLLADA", "Blender or MeshLab saves it as PLY"},
                 {"<X3D", 4, "X3D", "MeshLab saves it as PLY"},
                 {"<kml", 4, "KML", "ogr2ogr -f GeoJSON OUT.geojson IN"},
                 {"#VRML", 5, "VRML", "MeshLab saves it as PLY"},
                 {"#Inventor", 9, "Open Inventor", "MeshLab saves it as PLY"},
                 {"\xff\xff\xfe", 3, "a FreeSurfer surface", "mris_convert IN OUT.stl"},
                 {"$MeshFormat", 11, "a Gmsh mesh", "gmsh IN -save -o OUT.stl, or meshio convert IN OUT.ply"},
                 {"MeshVersionFormatted", 20, "a Medit mesh", "meshio convert IN OUT.ply"},
                 {"Kaydara FBX", 11, "FBX", "Blender saves it as PLY"},
                 {"; FBX", 5, "FBX", "Blender saves it as PLY"},
                 {"BLENDER", 7, "a Blender file", "Blender exports PLY"},
                 {"\x89HDF", 4, "HDF5", "meshio convert IN.xdmf OUT.ply"},
                 {"CDF\x01", 4, "netCDF", "ncdump, or a script that writes a table"},
                 {"# .PCD", 6, "a point cloud", "a surface has faces: MeshLab or Open3D makes them"},
                 {"\x93NUMPY", 6, "an array of NumPy", "numpy.savetxt writes text"},
                 {"SQLite format 3", 15, "SQLite, as GeoPackages are", "ogr2ogr -f GeoJSON OUT.geojson IN"},
                 {"\x00\x00\x27\x0a", 4, "a shapefile", "ogr2ogr -f GeoJSON OUT.geojson IN"},
                 {"Iout", 4, "a region of ImageJ", "ImageJ: File, Save As, XY Coordinates"},
                 {"II*", 4, "an image (TIFF)", "trace its outlines first: docs/cookbook.md"},
                 {"MM\x00*", 4, "an image (TIFF)", "trace its outlines first: docs/cookbook.md"},
                 {"\x89PNG", 4, "an image (PNG)", "trace its outlines first: docs/cookbook.md"}};
    size_t k;
    for (k = 0; k < sizeof known / sizeof *known; ++k)
        if (length >= known[k].length && memcmp(first, known[k].begin, known[k].length) == 0) {
            *what = known[k].what;
            *how = known[k].how;
            return 1;
        }
    return 0;
}

/* XML says in its first line, or behind it, what it is. */
static inline const char *mesh__skip_xml(const char *first, size_t *length)
{
    const char *at = first, *end = first + *length;
    while (at < end && (strchr(" \t\r\n", *at) || (*at == '<' && at + 1 < end && strchr("?!", at[1])))) {
        if (*at == '<')
            while (at < end && *at != '>') ++at;
        if (at < end) ++at;
    }
    *length = (size_t)(end - at);
    return at;
}

/* The prefixes of OFF in any order, then blank, digit or the end of the line. 4OFF and nOFF are not in space. */
static inline int mesh__is_off(const char *at)
{
    at += strspn(at, "STCN");
    return !strncmp(at, "OFF", 3) && (!at[3] || strchr(" \t\r\n0123456789", at[3]));
}

static inline int mesh__is_word(const char *at, const char *end, const char *word)
{
    size_t length = strlen(word);
    return (size_t)(end - at) >= length && memcmp(at, word, length) == 0 &&
           (at + length == end || strchr(" \t", at[length]));
}

/* A binary STL: 80 bytes of anything, the number of facets, and the first facet has a normal of length 1, or 0. */
static inline int mesh__is_stl_binary(const char *first, size_t length)
{
    float n[3];
    unsigned char count[4];
    double square = 0;
    int k;
    const union {
        unsigned char byte[4];
        uint32_t number;
    } one = {{1, 0, 0, 0}};
    if (length < 134 || !memchr(first, 0, 84)) return 0;
    memcpy(count, first + 80, 4);
    if (!(count[0] | count[1] | count[2] | count[3])) return 0;
    for (k = 0; k < 3; ++k) {
        unsigned char in[4], turned[4];
        int b;
        memcpy(in, first + 84 + 4 * (size_t)k, 4);
        for (b = 0; b < 4; ++b) turned[b] = in[one.number == 1 ? b : 3 - b];
        memcpy(&n[k], turned, 4);
        square += (double)n[k] * (double)n[k];
    }
    return fabs(square - 1) < 0.01 || !(square > 0);
}

/* Which format the first bytes of a file are of; MESH_UNKNOWN: none of these, -1: a few more bytes are needed to tell.
   With MESH_OTHER `what` it is and `how` to convert it. */
static inline int mesh_file_format(const char *first, size_t length, int ended, const char **what, const char **how)
{
    static const char *const obj[] = {"vn", "vt", "vp", "mtllib", "usemtl", "o", "g", "s", "cstype", "f", "l", "p"};
    const char *at = first, *line_end, *end = first + length, *xml;
    size_t rest = length, k;
    int groups = 0, is_solid = 0, first_line = 1;
    if (mesh__is_foreign(first, length, what, how)) return MESH_OTHER;
    if (length < 134 && !ended && memchr(first, 0, length < 84 ? length : 84)) return -1;
    if (mesh__is_stl_binary(first, length)) return MESH_STL_BINARY;
    xml = mesh__skip_xml(first, &rest);
    if (rest < length && rest > 0 && *xml == '<' && mesh__is_foreign(xml, rest, what, how)) return MESH_OTHER;
    if (length >= 3 && !memcmp(at, "\xef\xbb\xbf", 3)) at += 3;
    for (; at < end; at = line_end + 1) {
        const char *word;
        char text[16];
        while (at < end && strchr(" \t\r\n", *at)) ++at;
        for (line_end = at; line_end < end && *line_end != '\n' && *line_end != '\r';) ++line_end;
        if (line_end == end && !ended) return -1;
        if (at == end) break;
        word = at;
        k = (size_t)(line_end - at);
        snprintf(text, sizeof text, "%.*s", k < 15 ? (int)k : 15, at);
        if (first_line && k >= 14 && !strncmp(word, "# vtk DataFile", 14)) return MESH_VTK;
        first_line = 0;
        if (*word == '#') continue;
        if (is_solid && (mesh__is_word(word, line_end, "facet") || mesh__is_word(word, line_end, "endsolid")))
            return MESH_STL;
        if (is_solid) return MESH_UNKNOWN;
        if (mesh__is_off(text)) return MESH_OFF;
        if (mesh__is_word(word, line_end, "ply") && k == 3) return MESH_PLY;
        if (mesh__is_word(word, line_end, "v")) {
            word += 1 + strspn(word + 1, " \t");
            return word < line_end && strchr("+-.0123456789", *word) ? MESH_OBJ : MESH_UNKNOWN;
        }
        is_solid = mesh__is_word(word, line_end, "solid");
        for (k = 0; k < sizeof obj / sizeof *obj && !mesh__is_word(word, line_end, obj[k]);) ++k;
        if (k == sizeof obj / sizeof *obj && !is_solid) return MESH_UNKNOWN;
        if (k >= 5 && !is_solid && ++groups > 2) return MESH_UNKNOWN; /* rows of a table whose id is o, g or s */
        if (k >= 9 && !is_solid) return MESH_UNKNOWN;                 /* no vertex comes before a face */
    }
    return ended ? MESH_UNKNOWN : -1;
}

/* Tells the format, and reads it. */
static inline int mesh__read_any(mesh__reader *r, mesh_file *f)
{
    const char *what = NULL, *how = NULL;
    int format, got, status = mesh__look_ahead(r, MESH__LOOK_AHEAD);
    if (status) return status;
    format = mesh_file_format(r->block, r->end, r->ended, &what, &how);
    if (format == MESH_OTHER) return mesh__fail(r->error, MESH_MALFORMED, r->name, 0, "%s is not read: %s", what, how);
    if (format == MESH_STL_BINARY) return mesh__read_stl_binary(r, f);
    status = mesh__line(r, format != MESH_VTK, &got);
    if (status) return status;
    if (!got) return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "the file is empty");
    r->again = 1;
    switch (format) {
    case MESH_OFF: return mesh__read_off(r, f);
    case MESH_OBJ: return mesh__read_obj(r, f);
    case MESH_PLY: return mesh__read_ply(r, f);
    case MESH_STL: return mesh__read_stl(r, f);
    case MESH_VTK: return mesh__read_vtk(r, f);
    default: return mesh__malformed(r, "a mesh: OFF, OBJ, PLY, STL or legacy VTK", r->text);
    }
}

static inline int mesh__check_file(const mesh_file *f, const char *name, mesh_error *error)
{
    size_t i, j;
    for (i = 0; i < f->faces; ++i)
        for (j = f->begin[i]; j < f->begin[i + 1]; ++j)
            if (f->corner[j] >= f->vertices)
                return mesh__fail(error, MESH_BAD_INDEX, name, f->line[i],
                                  "there is no vertex %lu, counted from 0: there are %lu", (unsigned long)f->corner[j],
                                  (unsigned long)f->vertices);
    return MESH_OK;
}

/* Reads a mesh.
   f           out: vertices and faces as in the file, in its order; also vertices that no face uses, and faces of
               fewer corners than 3
   field       NULL, or the name of a scalar that its vertices have: f->field
   Errors: UNREADABLE, MALFORMED, BAD_INDEX, TOO_LARGE, NO_MEMORY; error may be NULL. */
static inline int mesh_file_read(mesh_file *f, const mesh_source *source, const char *field, mesh_error *error)
{
    mesh__reader r;
    int status;
    memset(f, 0, sizeof *f);
    memset(&r, 0, sizeof r);
    r.source = source;
    r.name = source->name;
    r.field = field;
    r.error = error;
    r.block = (char *)calloc(MESH__BLOCK, 1);
    status = r.block ? mesh__read_any(&r, f) : mesh__no_memory(error, r.name);
    free(r.block);
    free(r.text);
    if (!status) status = mesh__check_file(f, r.name, error);
    if (!status && !f->begin) { /* no faces at all */
        f->begin = (size_t *)calloc(1, sizeof *f->begin);
        if (!f->begin) status = mesh__no_memory(error, r.name);
    }
    if (!status && field && !f->field)
        status = mesh__fail(error, MESH_MALFORMED, r.name, 0, "the vertices have no scalar '%.60s'; they have: %s",
                            field, f->fields[0] ? f->fields : "none");
    if (status) mesh_file_free(f);
    return status;
}

/* What reads from a C file, which stays open: context is the FILE. */
static inline size_t mesh_file_from_stream(void *context, char *to, size_t most)
{
    FILE *file = (FILE *)context;
    size_t count = fread(to, 1, most, file);
    return count == 0 && ferror(file) ? (size_t)-1 : count;
}

/* --- 3. orient: faces -> an oriented surface ---------------------------------------------------------------------- */

/* Vertices nearer than this times the mean edge are copies of each other: what a program writes twice agrees to the
   last digit or, after a detour through 32 bits, to 1e-7 of the coordinates. */
static const double mesh__copies = 1e-6;

typedef struct mesh__half {
    uint32_t low, high; /* vertices */
    uint32_t face;
    int rises; /* from low to high? */
} mesh__half;

static inline int mesh__by_edge(const void *a, const void *b)
{
    const mesh__half *x = (const mesh__half *)a, *y = (const mesh__half *)b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    if (x->high != y->high) return x->high < y->high ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

/* Is it a triangle two corners of which have been joined? The edges that are left are one. */
static inline int mesh__is_collapsed(const mesh_file *f, size_t face)
{
    const uint32_t *v = f->corner + f->begin[face];
    return f->begin[face + 1] - f->begin[face] == 3 &&
           (f->joint[v[0]] == f->joint[v[1]] || f->joint[v[1]] == f->joint[v[2]] || f->joint[v[2]] == f->joint[v[0]]);
}

/* The sides of all faces with three corners or more, sorted by edge. */
static inline size_t mesh__list_halves(const mesh_file *f, mesh__half *half)
{
    size_t i, j, count = 0;
    for (i = 0; i < f->faces; ++i) {
        size_t begin = f->begin[i], n = f->begin[i + 1] - begin;
        if (n >= 3 && mesh__is_collapsed(f, i)) continue;
        for (j = 0; j < n && n >= 3; ++j) {
            uint32_t from = f->joint[f->corner[begin + j]], to = f->joint[f->corner[begin + (j + 1 < n ? j + 1 : 0)]];
            if (from == to) continue;
            half[count].low = from < to ? from : to;
            half[count].high = from < to ? to : from;
            half[count].face = (uint32_t)i;
            half[count++].rises = from < to;
        }
    }
    qsort(half, count, sizeof *half, mesh__by_edge);
    return count;
}

/* How many sides from half[i] on have the same edge. */
static inline size_t mesh__group(const mesh__half *half, size_t count, size_t i)
{
    size_t k = 1;
    while (i + k < count && half[i + k].low == half[i].low && half[i + k].high == half[i].high) ++k;
    return k;
}

/* Of a cell of the grid; in 32 bits, so that no product overflows. */
static inline size_t mesh__hash(const double cell[3])
{
    uint64_t bits, hash = 0;
    int c;
    for (c = 0; c < 3; ++c) {
        double x = cell[c] + 0.0; /* -0 is 0 */
        memcpy(&bits, &x, sizeof bits);
        bits ^= bits >> 32;
        hash = ((hash ^ bits) & 0xffffffff) * 0x9e3779b1;
        hash ^= hash >> 15;
    }
    return (size_t)(hash & 0xffffffff);
}

/* Joins vertices of the boundary (free[v]) that lie within `near` of each other: a grid of cells of that size, of which
   the 27 about a vertex are looked at. */
static inline int mesh__join(mesh_file *f, const unsigned char *is_free, double near, mesh_error *error,
                             const char *name)
{
    size_t v, room = 64, at;
    uint32_t *head, *next = (uint32_t *)malloc((f->vertices + 1) * sizeof *next);
    int k, c;
    while (room < 2 * f->vertices) room *= 2;
    head = (uint32_t *)malloc(room * sizeof *head);
    if (!head || !next) {
        free(head);
        free(next);
        return mesh__no_memory(error, name);
    }
    memset(head, 0xff, room * sizeof *head);
    for (v = 0; v < f->vertices; ++v) {
        const double *x = f->vertex + 3 * v;
        double cell[3], other[3];
        uint32_t found = MESH_NONE, u;
        if (!is_free[v] || !(fabs(x[0]) + fabs(x[1]) + fabs(x[2]) <= DBL_MAX)) continue;
        for (c = 0; c < 3; ++c) cell[c] = floor(x[c] / near);
        for (k = 0; k < 27 && found == MESH_NONE; ++k) {
            for (c = 0; c < 3; ++c) other[c] = cell[c] + (c == 0 ? k % 3 : c == 1 ? k / 3 % 3 : k / 9) - 1;
            for (u = head[mesh__hash(other) & (room - 1)]; u != MESH_NONE && found == MESH_NONE; u = next[u]) {
                const double *y = f->vertex + 3 * (size_t)u;
                double d[3];
                for (c = 0; c < 3; ++c) d[c] = x[c] - y[c];
                if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] <= near * near) found = u;
            }
        }
        if (found != MESH_NONE) {
            f->joint[v] = f->joint[found];
            ++f->joined;
            continue;
        }
        at = mesh__hash(cell) & (room - 1);
        next[v] = head[at];
        head[at] = (uint32_t)v;
    }
    free(head);
    free(next);
    return MESH_OK;
}

/* The mean edge, and which vertices lie on edges with one face only. */
static inline double mesh__find_boundary(const mesh_file *f, const mesh__half *half, size_t count,
                                         unsigned char *is_free)
{
    double sum = 0;
    size_t i, group, edges = 0;
    for (i = 0; i < count; i += group) {
        const double *a = f->vertex + 3 * (size_t)half[i].low, *b = f->vertex + 3 * (size_t)half[i].high;
        group = mesh__group(half, count, i);
        if (group == 1) is_free[half[i].low] = is_free[half[i].high] = 1;
        sum += hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
        ++edges;
    }
    return edges ? sum / (double)edges : 0;
}

static inline int mesh__by_number(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return x < y ? -1 : x > y;
}

/* Have the two faces the same corners, whichever way round? */
static inline int mesh__same_face(const mesh_file *f, size_t i, size_t j)
{
    size_t n = f->begin[i + 1] - f->begin[i], k;
    uint32_t *mine, *other;
    int same;
    if (f->begin[j + 1] - f->begin[j] != n) return 0;
    mine = (uint32_t *)malloc(2 * n * sizeof *mine);
    if (!mine) return 0;
    other = mine + n;
    for (k = 0; k < n; ++k) {
        mine[k] = f->joint[f->corner[f->begin[i] + k]];
        other[k] = f->joint[f->corner[f->begin[j] + k]];
    }
    qsort(mine, n, sizeof *mine, mesh__by_number);
    qsort(other, n, sizeof *other, mesh__by_number);
    same = memcmp(mine, other, n * sizeof *mine) == 0;
    free(mine);
    return same;
}

/* No edge with more than two faces, no face twice. */
static inline int mesh__check_edges(mesh_file *f, const mesh__half *half, size_t count, const char *name,
                                    mesh_error *error)
{
    size_t i, k, group;
    for (i = 0; i < count; i += group) {
        group = mesh__group(half, count, i);
        if (group == 2) ++f->shared;
        for (k = 1; k < group; ++k)
            if (half[i + k].face != half[i + k - 1].face && mesh__same_face(f, half[i + k].face, half[i + k - 1].face))
                return mesh__fail(error, MESH_NOT_MANIFOLD, name, f->line[half[i + k].face],
                                  "face %lu has the same corners as face %lu (from 0): not a surface; drop one of them",
                                  (unsigned long)half[i + k].face, (unsigned long)half[i + k - 1].face);
        if (group > 2)
            return mesh__fail(error, MESH_NOT_MANIFOLD, name, f->line[half[i + 2].face],
                              "the edge between vertices %lu and %lu (from 0) has %lu faces: not a surface",
                              (unsigned long)half[i].low, (unsigned long)half[i].high, (unsigned long)group);
    }
    return MESH_OK;
}

/* Neighbours of faces: of face i from link[start[i]] to before link[start[i + 1]], as 2 * neighbour + 1 if the two run
   opposite ways. */
static inline void mesh__list_neighbours(const mesh_file *f, const mesh__half *half, size_t count, size_t *start,
                                         uint64_t *link)
{
    size_t i, group;
    for (i = 0; i < count; i += group)
        if ((group = mesh__group(half, count, i)) == 2) ++start[half[i].face + 1], ++start[half[i + 1].face + 1];
    for (i = 0; i < f->faces; ++i) start[i + 1] += start[i];
    for (i = 0; i < count; i += group)
        if ((group = mesh__group(half, count, i)) == 2) {
            uint64_t against = half[i].rises == half[i + 1].rises, a = half[i].face, b = half[i + 1].face;
            link[start[a]++] = 2 * b + against;
            link[start[b]++] = 2 * a + against;
        }
    for (i = f->faces; i > 0; --i) start[i] = start[i - 1]; /* they were moved on while the lists were filled */
    start[0] = 0;
}

/* Flood fill from face to face: state is 1 for a face that stays, 2 for one that is turned. Of each component the
   smaller part is turned. Returns 0 where two neighbours cannot both be right: pair. */
static inline int mesh__flood(const mesh_file *f, const size_t *start, const uint64_t *link, unsigned char *state,
                              uint32_t *queue, size_t pair[2])
{
    size_t i, k, head, tail, turned;
    for (i = 0; i < f->faces; ++i) {
        if (state[i]) continue;
        state[i] = 1;
        queue[0] = (uint32_t)i;
        turned = 0;
        for (head = 0, tail = 1; head < tail; ++head) {
            uint32_t face = queue[head];
            turned += state[face] == 2;
            for (k = start[face]; k < start[face + 1]; ++k) {
                size_t other = (size_t)(link[k] / 2);
                unsigned char want = (unsigned char)(link[k] % 2 ? 3 - state[face] : state[face]);
                pair[0] = face;
                pair[1] = other;
                if (state[other] && state[other] != want) return 0;
                if (!state[other]) queue[tail++] = (uint32_t)other;
                state[other] = want;
            }
        }
        for (k = 0; k < tail && 2 * turned > tail; ++k) state[queue[k]] = (unsigned char)(3 - state[queue[k]]);
    }
    return 1;
}

/* Turns the face round; its first corner stays the first. */
static inline void mesh__turn(mesh_file *f, size_t face)
{
    size_t i, j;
    for (i = f->begin[face] + 1, j = f->begin[face + 1] - 1; i < j; ++i, --j) {
        uint32_t swap = f->corner[i];
        f->corner[i] = f->corner[j], f->corner[j] = swap;
        if (f->normal_of) swap = f->normal_of[i], f->normal_of[i] = f->normal_of[j], f->normal_of[j] = swap;
    }
    if (f->turned++ == 0) f->first_turned = face;
}

/* Names the edge between the two faces. */
static inline int mesh__not_orientable(const mesh_file *f, const mesh__half *half, size_t count, const size_t pair[2],
                                       const char *name, mesh_error *error)
{
    size_t i = 0, group = 0, last = pair[0] > pair[1] ? pair[0] : pair[1];
    for (; i < count; i += group) {
        group = mesh__group(half, count, i);
        if (group == 2 && half[i].face + half[i + 1].face == pair[0] + pair[1] && half[i + 1].face == last) break;
    }
    return mesh__fail(error, MESH_NOT_ORIENTED, name, f->line[last],
                      "the faces at the edge between vertices %lu and %lu (from 0) run opposite ways, and so do others "
                      "if one of them is turned: a surface with one side only, like a Moebius strip",
                      (unsigned long)half[i].low, (unsigned long)half[i].high);
}

static inline int mesh__orient(mesh_file *f, mesh__half *half, const char *name, mesh_error *error)
{
    size_t count = mesh__list_halves(f, half), corners = mesh__corners(f), pair[2], i;
    unsigned char *state = (unsigned char *)calloc(f->faces + 1, 1);
    unsigned char *is_free = (unsigned char *)calloc(f->vertices + 1, 1);
    size_t *start = (size_t *)calloc(f->faces + 2, sizeof *start);
    uint64_t *link = (uint64_t *)malloc((corners + 1) * sizeof *link);
    uint32_t *queue = (uint32_t *)malloc((f->faces + 1) * sizeof *queue);
    int status = state && is_free && start && link && queue ? MESH_OK : mesh__no_memory(error, name);
    if (!status) {
        double near = mesh__copies * mesh__find_boundary(f, half, count, is_free);
        if (near > 0 && near <= DBL_MAX) status = mesh__join(f, is_free, near, error, name);
        if (!status && f->joined) count = mesh__list_halves(f, half);
    }
    if (!status) status = mesh__check_edges(f, half, count, name, error);
    if (!status) {
        mesh__list_neighbours(f, half, count, start, link);
        if (!mesh__flood(f, start, link, state, queue, pair))
            status = mesh__not_orientable(f, half, count, pair, name, error);
    }
    for (i = 0; !status && i < f->faces; ++i)
        if (state[i] == 2) mesh__turn(f, i);
    free(state);
    free(is_free);
    free(start);
    free(link);
    free(queue);
    return status;
}

/* Makes the faces an oriented surface: joins copies of vertices at the boundary, where they are within 1e-6 of the mean
   edge, and turns faces round that run against their neighbours; of a component the smaller part. f->joint, joined,
   turned and shared say what was done. Faces with fewer than 3 corners are left as they are.
   Errors: NOT_MANIFOLD, NOT_ORIENTED, NO_MEMORY. */
static inline int mesh_file_orient(mesh_file *f, const char *name, mesh_error *error)
{
    mesh__half *half = (mesh__half *)malloc((mesh__corners(f) + 1) * sizeof *half);
    size_t v;
    int status = MESH_OK;
    free(f->joint);
    f->joint = (uint32_t *)malloc((f->vertices + 1) * sizeof *f->joint);
    f->joined = f->turned = f->shared = 0;
    if (!half || !f->joint) status = mesh__no_memory(error, name);
    for (v = 0; !status && v < f->vertices; ++v) f->joint[v] = (uint32_t)v;
    if (!status) status = mesh__orient(f, half, name, error);
    free(half);
    return status;
}

/* Twice the area vector of a face: cross products as seen from its first corner, so that meshes far away keep their
   digits. */
static inline void mesh_file_area(const mesh_file *f, size_t face, double area[3])
{
    size_t i, n = f->begin[face + 1] - f->begin[face];
    const uint32_t *corner = n ? f->corner + f->begin[face] : NULL;
    double a[3], b[3];
    int k;
    area[0] = area[1] = area[2] = 0;
    for (i = 1; i + 1 < n; ++i) {
        for (k = 0; k < 3; ++k) {
            a[k] = f->vertex[3 * (size_t)corner[i] + (size_t)k] - f->vertex[3 * (size_t)corner[0] + (size_t)k];
            b[k] = f->vertex[3 * (size_t)corner[i + 1] + (size_t)k] - f->vertex[3 * (size_t)corner[0] + (size_t)k];
        }
        area[0] += a[1] * b[2] - a[2] * b[1];
        area[1] += a[2] * b[0] - a[0] * b[2];
        area[2] += a[0] * b[1] - a[1] * b[0];
    }
}

/* The normals of the vertices: sums of the area vectors of the faces there, not made unit; of those that are finite, so
   that one bad vertex does not spoil its neighbours. Copies of a vertex have the same one. The faces must have been
   oriented. 3 per vertex, for the caller to free; NULL if there is no memory. */
static inline double *mesh_file_means(const mesh_file *f)
{
    double *sum = (double *)calloc(3 * f->vertices + 1, sizeof *sum), area[3];
    size_t i, j, v, before;
    int k, is_finite;
    if (!sum) return NULL;
    for (i = 0; i < f->faces; ++i) {
        mesh_file_area(f, i, area);
        is_finite = fabs(area[0]) + fabs(area[1]) + fabs(area[2]) <= DBL_MAX;
        for (j = f->begin[i]; j < f->begin[i + 1] && is_finite; ++j) {
            before = f->joint[f->corner[j > f->begin[i] ? j - 1 : f->begin[i + 1] - 1]];
            v = f->joint[f->corner[j]];
            for (k = 0; k < 3 && v != before; ++k) sum[3 * v + (size_t)k] += area[k]; /* a corner twice counts once */
        }
    }
    for (v = 0; v < f->vertices; ++v)
        if (f->joint[v] != v) memcpy(sum + 3 * v, sum + 3 * (size_t)f->joint[v], 3 * sizeof *sum);
    return sum;
}

/* The normal that the file gives to a corner; there must be some. */
static inline const double *mesh_file_normal(const mesh_file *f, size_t corner)
{
    return f->normal + 3 * (size_t)(f->normal_of ? f->normal_of[corner] : f->corner[corner]);
}

/* The first face whose normals in the file, summed, point against its own; f->faces if none does. */
static inline size_t mesh_file_contradiction(const mesh_file *f)
{
    size_t i, j;
    double area[3];
    for (i = 0; i < f->faces; ++i) {
        double sum = 0;
        mesh_file_area(f, i, area);
        for (j = f->begin[i]; j < f->begin[i + 1]; ++j) {
            const double *n = mesh_file_normal(f, j);
            double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
            if (length > 0) sum += (area[0] * n[0] + area[1] * n[1] + area[2] * n[2]) / length;
        }
        if (sum <= 0 && (area[0] != 0 || area[1] != 0 || area[2] != 0)) return i;
    }
    return f->faces;
}

#endif
