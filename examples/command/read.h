/* read.h - step 1 of the command: a file, table or mesh -> polygons, one at a time. */
#ifndef SURFMINK_COMMAND_READ_H
#define SURFMINK_COMMAND_READ_H

#include "mesh.h"
#include "table.h"

typedef struct reader {
    lines in;
    int surface; /* of all its polygons */
    int is_mesh;
    mesh mesh;
    table table;
} reader;

static int ends_in_off(const char *name)
{
    size_t n = strlen(name);
    return n >= 4 && (strcmp(name + n - 4, ".off") == 0 || strcmp(name + n - 4, ".OFF") == 0);
}

static void open_reader(reader *r, const char *name, const powers_of_ten *powers, const options *o)
{
    memset(r, 0, sizeof *r);
    open_lines(&r->in, name, powers);
    r->is_mesh = ends_in_off(name);
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
