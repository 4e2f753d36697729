/* read.h - step 1 of the command: a file, table, mesh or GeoJSON -> polygons, one at a time. */
#ifndef SURFMINK_COMMAND_READ_H
#define SURFMINK_COMMAND_READ_H

#include "estimate.h"
#include "geojson.h"
#include "mesh.h"
#include "table.h"

typedef struct reader {
    lines in;
    int surface; /* of all its polygons */
    int kind;    /* of enum reader_kind */
    mesh mesh;
    geojson geojson;
    table table;
    estimate estimate; /* --normals estimate: the table is read at once */
} reader;

enum reader_kind { READS_TABLE, READS_MESH, READS_GEOJSON, READS_ESTIMATE };

/* A name that promises a mesh. */
static int is_named_mesh(const char *name)
{
    static const char *const suffix[] = {".off", ".obj", ".ply", ".stl", ".vtk"};
    size_t n = strlen(name), i, k;
    for (i = 0; i < sizeof suffix / sizeof *suffix && n > 4; ++i) {
        for (k = 0; k < 4 && (name[n - 4 + k] | 0x20) == (suffix[i][k] | 0x20);) ++k;
        if (k == 4) return 1;
    }
    return 0;
}

/* As many bytes of the file as it takes to tell what it is; a table it is if that takes more than this. */
enum { MOST_TO_TELL = 1 << 18 };

static int tell_kind(lines *in)
{
    const char *what = NULL, *how = NULL, *first;
    int format = -1;
    size_t i;
    while (format == -1 && !in->ended && in->end - in->next < MOST_TO_TELL) {
        read_on(in);
        format = mesh_file_format(in->block + in->next, in->end - in->next, in->ended, &what, &how);
    }
    if (format == MESH_OTHER) die("%s: %s is not read: %s", in->name, what, how);
    first = in->block + in->next;
    i = in->end - in->next >= 3 && memcmp(first, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    while (i < in->end - in->next && strchr(" \t\r\n\x1e", first[i])) ++i; /* RFC 8142 has records */
    if (i < in->end - in->next && first[i] == '{') return READS_GEOJSON;
    return (format != MESH_UNKNOWN && format != -1) || is_named_mesh(in->name) ? READS_MESH : READS_TABLE;
}

/* Whether a file, NULL is standard output, and an open one are the same, whatever their names. */
static int is_same_file(const char *name, FILE *file, const char *file_name)
{
#if HAS_POSIX
    struct stat a, b;
    int known = (name ? stat(name, &a) : fstat(STDOUT_FILENO, &a)) == 0 && fstat(fileno(file), &b) == 0;
    (void)file_name;
    return known && S_ISREG(a.st_mode) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
#else
    (void)file;
    return name && strcmp(name, file_name) == 0;
#endif
}

/* What is read must not be written at the same time. (Closed, standard output has left its number to the file.) */
static void check_outputs(const reader *r, const char *name, const options *o)
{
    int i;
    for (i = 0; i < PICTURES; ++i)
        if (picture_file(o, i) && is_same_file(picture_file(o, i), r->in.file, name))
            die("%s: --%s would overwrite it", name, picture_option[i]);
#if HAS_POSIX
    if (fileno(r->in.file) == STDOUT_FILENO) return;
#endif
    if (is_same_file(NULL, r->in.file, name)) die("%s: it is standard output as well", name);
}

static void open_reader(reader *r, const char *name, const powers_of_ten *powers, const options *o)
{
    memset(r, 0, sizeof *r);
    open_lines(&r->in, name, powers);
    check_outputs(r, name, o);
    r->kind = tell_kind(&r->in);
    switch (r->kind) {
    case READS_MESH:
        read_mesh(&r->mesh, &r->in, o);
        r->surface = r->mesh.surface;
        break;
    case READS_GEOJSON:
        read_geojson(&r->geojson, &r->in, o);
        r->surface = o->surface == PLANE ? PLANE : SPHERE;
        break;
    default:
        read_header(&r->table, &r->in, o);
        r->surface = r->table.columns.layout->surface;
        if (r->table.columns.layout != &layout_space) break;
        estimate_normals(&r->estimate, &r->table);
        r->kind = READS_ESTIMATE;
    }
}

/* Returns 0 when there is no other. */
static int next_polygon(reader *r, polygon *p)
{
    switch (r->kind) {
    case READS_MESH: return next_of_mesh(&r->mesh, p);
    case READS_GEOJSON: return next_of_geojson(&r->geojson, p, r->surface);
    case READS_ESTIMATE: return next_of_estimate(&r->estimate, p);
    default: return next_of_table(&r->table, p);
    }
}

static void close_reader(reader *r)
{
    free_mesh(&r->mesh);
    free_geojson(&r->geojson);
    free_table(&r->table);
    free_estimate(&r->estimate);
    close_lines(&r->in);
}

#endif
