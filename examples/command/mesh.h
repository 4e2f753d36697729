/* mesh.h - step 1 of the command: a polygon mesh -> its faces, one polygon each. The formats are those of
   surfaces/meshfile.h. */
#ifndef SURFMINK_COMMAND_MESH_H
#define SURFMINK_COMMAND_MESH_H

#include "lines.h"
#include "polygon.h"
#include "../surfaces/meshfile.h"

typedef struct mesh {
    int surface;
    mesh_file file;
    double *mean; /* EMBEDDED: 3 a vertex, the normals if the file has none that can be used; else NULL */
    size_t next;  /* face to hand out */
} mesh;

/* How the bytes of the file come to the reader: context is the lines. */
static size_t read_mesh_bytes(void *context, char *to, size_t most)
{
    return take_bytes((lines *)context, to, most);
}

/* The normals of the file, unless they contradict its faces, which then are no surface of these normals. Outlines that
   share no edge are no surface: their normals are all that is known about it. */
static void find_normals(mesh *m, const char *name)
{
    mesh_file *f = &m->file;
    mesh_error error;
    size_t odd = f->normals ? mesh_file_contradiction(f) : 0;
    if (f->normals && odd == f->faces) return;
    if (mesh_file_orient(f, name, &error) != MESH_OK) die("%s", error.text);
    if (f->joined) remark("%s: %lu vertices are copies of others: joined", name, (unsigned long)f->joined);
    if (f->normals && !f->shared) return;
    if (f->turned)
        remark("%s:%lu: face %lu runs against its neighbours; %lu such %s turned round", name, f->line[f->first_turned],
               (unsigned long)f->first_turned, (unsigned long)f->turned, f->turned == 1 ? "face is" : "faces are");
    if (f->normals)
        remark("%s: normals that point against face %lu are not used; area-weighted means over the faces are", name,
               (unsigned long)odd);
    m->mean = mesh_file_means(f);
    if (!m->mean) die(COMMAND_NAME ": out of memory");
}

static void read_mesh(mesh *m, lines *in, const options *o)
{
    mesh_source source;
    mesh_error error;
    memset(m, 0, sizeof *m);
    m->surface = o->surface == AS_THE_COLUMNS_SAY ? EMBEDDED : o->surface;
    source.name = in->name;
    source.read = read_mesh_bytes;
    source.context = in;
    if (mesh_file_read(&m->file, &source, NULL, &error) != MESH_OK) die("%s", error.text);
    if (m->file.faces == 0) die("%s: there are no faces in it", in->name);
    if (m->file.infinite_line)
        remark("%s:%lu: a vertex is not finite: no face with it is measured", in->name,
               (unsigned long)m->file.infinite_line);
    if (m->surface == EMBEDDED) find_normals(m, in->name);
}

static int next_of_mesh(mesh *m, polygon *p)
{
    const mesh_file *f = &m->file;
    size_t i, face = m->next;
    char number[32];
    if (face == f->faces) return 0;
    ++m->next;
    snprintf(number, sizeof number, "%lu", (unsigned long)face);
    begin_polygon(p, m->surface, number, f->line[face]);
    p->has_means = m->mean != NULL;
    for (i = f->begin[face]; i < f->begin[face + 1]; ++i) {
        size_t v = f->corner[i];
        const double *x = f->vertex + 3 * v;
        const double *normal = m->mean ? m->mean + 3 * v : f->normals ? mesh_file_normal(f, i) : NULL;
        if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2])) find_fault(p, SURFMINK_NOT_FINITE, f->line[face]);
        add_corner(p, x, normal, f->line[face]);
    }
    return 1;
}

static void free_mesh(mesh *m)
{
    mesh_file_free(&m->file);
    free(m->mean);
}

#endif
