/* estimate.h - step 1 of the command, --normals estimate: cells in space without normals -> with.

   Where cells share corners, the normal there is the mean of theirs, weighted by area; a cell that shares none has that
   of its best plane. What that costs, on the 400 cells of examples/data/tissue.tsv, whose normals are known: mu_2 to
   mu_6 are off by .0009 in the median and by .065 at most; as lone cells by .0013 and .113. */
#ifndef SURFMINK_COMMAND_ESTIMATE_H
#define SURFMINK_COMMAND_ESTIMATE_H

#include "repair.h"
#include "table.h"
#include "../surfaces/meshfile.h"

/* All cells of a file, as faces of a mesh. */
typedef struct estimate {
    mesh_file file;
    char **id;           /* of each face */
    unsigned long *line; /* of each corner */
    double *normal;      /* of each corner */
    size_t id_room, vertex_room, corner_room, line_room, begin_room, face_room;
    int *fault;
    unsigned long *fault_line;
    size_t fault_room, fault_line_room;
    size_t next;
} estimate;

static void keep_cell(estimate *e, const polygon *p)
{
    mesh_file *f = &e->file;
    size_t i, at = f->vertices, length = strlen(p->id) + 1;
    f->vertex = (double *)grow(f->vertex, &e->vertex_room, 3 * (at + p->n), sizeof *f->vertex);
    f->corner = (uint32_t *)grow(f->corner, &e->corner_room, at + p->n, sizeof *f->corner);
    e->line = (unsigned long *)grow(e->line, &e->line_room, at + p->n, sizeof *e->line);
    f->begin = (size_t *)grow(f->begin, &e->begin_room, f->faces + 2, sizeof *f->begin);
    f->line = (unsigned long *)grow(f->line, &e->face_room, f->faces + 1, sizeof *f->line);
    e->id = (char **)grow(e->id, &e->id_room, f->faces + 1, sizeof *e->id);
    e->fault = (int *)grow(e->fault, &e->fault_room, f->faces + 1, sizeof *e->fault);
    e->fault_line = (unsigned long *)grow(e->fault_line, &e->fault_line_room, f->faces + 1, sizeof *e->fault_line);
    if (at + p->n >= MESH_NONE) die("%s: too many corners for --normals estimate", current_file);
    for (i = 0; i < p->n; ++i) {
        memcpy(f->vertex + 3 * (at + i), p->corner + 3 * i, 3 * sizeof *f->vertex);
        f->corner[at + i] = (uint32_t)(at + i);
        e->line[at + i] = p->line[i];
    }
    e->id[f->faces] = (char *)resize(NULL, length, 1);
    memcpy(e->id[f->faces], p->id, length);
    e->fault[f->faces] = p->fault;
    e->fault_line[f->faces] = p->fault_line;
    f->line[f->faces] = p->first_line;
    f->begin[0] = 0;
    f->vertices = f->begin[++f->faces] = at + p->n;
}

/* Reads all of the table. */
static void estimate_normals(estimate *e, table *t)
{
    polygon p;
    mesh_error error;
    memset(e, 0, sizeof *e);
    memset(&p, 0, sizeof p);
    while (next_of_table(t, &p)) {
        order_corners(&p);
        drop_closing_corner(&p);
        keep_cell(e, &p);
    }
    free_polygon(&p);
    if (e->file.faces == 0) return;
    if (mesh_file_orient(&e->file, current_file, &error) != MESH_OK) die("%s", error.text);
    e->normal = mesh_file_means(&e->file);
    if (!e->normal) die(COMMAND_NAME ": out of memory");
    remark(
        "%s: normals are estimated: means over cells that share corners (on a tissue that missed mu_p by .0009 in the "
        "median, .065 at most); of lone cells the best plane (.0013, .113)",
        current_file);
    if (e->file.turned)
        remark("%s:%lu: outline %s runs against its neighbours; %lu such are turned round", current_file,
               e->file.line[e->file.first_turned], e->id[e->file.first_turned], (unsigned long)e->file.turned);
}

static int next_of_estimate(estimate *e, polygon *p)
{
    const mesh_file *f = &e->file;
    size_t i, face = e->next;
    if (face == f->faces) return 0;
    ++e->next;
    begin_polygon(p, EMBEDDED, e->id[face], f->line[face]);
    p->has_means = 1;
    find_fault(p, e->fault[face], e->fault_line[face]);
    for (i = f->begin[face]; i < f->begin[face + 1]; ++i) {
        size_t v = f->corner[i];
        add_corner(p, f->vertex + 3 * v, e->normal + 3 * v, e->line[v]);
    }
    return 1;
}

static void free_estimate(estimate *e)
{
    size_t i;
    for (i = 0; i < e->file.faces; ++i) free(e->id[i]);
    free(e->id);
    free(e->line);
    free(e->normal);
    free(e->fault);
    free(e->fault_line);
    mesh_file_free(&e->file);
}

#endif
