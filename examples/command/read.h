/* read.h - step 1 of the command: a file, table, mesh or GeoJSON -> polygons, one at a time. */
#ifndef SURFMINK_COMMAND_READ_H
#define SURFMINK_COMMAND_READ_H

#include "mesh.h"
#include "table.h"

#if HAS_POSIX
#include <sys/stat.h>
#endif

typedef struct reader {
    lines in;
    int surface; /* of all its polygons */
    int is_mesh;
    mesh mesh;
    table table;
} reader;

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

static int tell_format(lines *in)
{
    const char *what = NULL, *how = NULL;
    int format = -1;
    while (format == -1 && !in->ended && in->end - in->next < MOST_TO_TELL) {
        read_on(in);
        format = mesh_file_format(in->block + in->next, in->end - in->next, in->ended, &what, &how);
    }
    if (format == MESH_OTHER) die("%s: %s is not read: %s", in->name, what, how);
    return format == -1 ? MESH_UNKNOWN : format;
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
    r->is_mesh = tell_format(&r->in) != MESH_UNKNOWN || is_named_mesh(name);
    if (r->is_mesh) {
        read_mesh(&r->mesh, &r->in, o);
        r->surface = r->mesh.surface;
    } else {
        read_header(&r->table, &r->in, o);
        r->surface = r->table.layout->surface;
    }
}

/* Returns 0 when there is no other. */
static int next_polygon(reader *r, polygon *p)
{
    return r->is_mesh ? next_of_mesh(&r->mesh, p) : next_of_table(&r->table, p);
}

static void close_reader(reader *r)
{
    free_mesh(&r->mesh);
    close_lines(&r->in);
}

#endif
