/* mesh.c - fuzzes the mesh reader of examples/surfaces/mesh.h and what follows it: text -> triangles -> twins, normals,
   loops of a level set, which then are measured. */
#define _POSIX_C_SOURCE 200809L /* fmemopen */
#include "api.h"
#include "examples/surfaces/mesh.h"

static FILE *open_bytes(const bytes *in)
{
    FILE *file = fmemopen((void *)(uintptr_t)in->at, in->left, "r");
    CLAIM(file != NULL);
    return file;
}

/* Whatever a loop is, measuring it is defined. */
static void measure_loops(const mesh_loops *loops)
{
    surfmink_functionals w;
    size_t k, n;
    for (k = 0; k < loops->loops; ++k) {
        n = loops->start[k + 1] - loops->start[k];
        CLAIM(n >= 3);
        CLAIM(all_finite(loops->corner + 3 * loops->start[k], 3 * n));
        CLAIM(is_known(surfmink_measure_embedded(loops->corner + 3 * loops->start[k],
                                                 loops->normal + 3 * loops->start[k], n, 6, NULL, NULL, &w, NULL)));
    }
}

static void cut(const mesh *m, mesh_error *error)
{
    double *field = (double *)malloc(m->vertices * sizeof *field), level = 0;
    mesh_loops loops;
    size_t i;
    int side, status;
    if (!field) return;
    for (i = 0; i < m->vertices; ++i) {
        field[i] = m->vertex[3 * i + 2];
        if (i == m->vertices / 2) level = field[i]; /* through a vertex: the hard case */
    }
    for (side = 0; side < 4; ++side) {
        status = mesh_level_set(m, field, side / 2 ? level : level + 0.1, side % 2, &loops, error);
        if (status)
            CLAIM(status == error->status && error->text[0]);
        else
            measure_loops(&loops);
        if (!status) mesh_free_loops(&loops);
    }
    free(field);
}

/* What a reader accepts is a mesh: indices exist, twins are mutual. */
static void fuzz(bytes in)
{
    mesh_error error;
    mesh m;
    FILE *file;
    double *field;
    size_t h;
    int status;
    if (in.left == 0) return; /* fmemopen refuses it */
    file = open_bytes(&in);
    status = mesh_read_stream(&m, file, "mesh", &error);
    fclose(file);
    if (status) {
        CLAIM(status == error.status && strncmp(error.text, "mesh", 4) == 0);
        return;
    }
    CLAIM(m.triangles > 0 && all_finite(m.vertex, 3 * m.vertices));
    for (h = 0; h < 3 * m.triangles; ++h) CLAIM(m.triangle[h] < m.vertices);
    file = open_bytes(&in);
    if (mesh_read_field_stream(&m, file, "field", &field, &error) == MESH_OK) {
        CLAIM(all_finite(field, m.vertices));
        free(field);
    }
    fclose(file);
    if (mesh_connect(&m, &error) == MESH_OK) {
        for (h = 0; h < 3 * m.triangles; ++h) CLAIM(m.twin[h] == MESH_NONE || m.twin[m.twin[h]] == h);
        if (mesh_normals(&m, &error) == MESH_OK) cut(&m, &error);
        mesh_flip(&m);
    }
    mesh_free(&m);
}
