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
    surfmink_outline loop;
    size_t k, n;
    for (k = 0; k < loops->loops; ++k) {
        n = loops->start[k + 1] - loops->start[k];
        CLAIM(n >= 3);
        CLAIM(all_finite(loops->corner + 3 * loops->start[k], 3 * n));
        loop = surfmink_embedded(loops->corner + 3 * loops->start[k], loops->normal + 3 * loops->start[k], n);
        CLAIM(is_known(surfmink_measure(&loop, 6, NULL, NULL, &w, NULL)));
    }
}

/* Turned round they are the same, so the same corners, last to first. */
static void claim_reversed(const mesh_loops *below, const mesh_loops *above)
{
    size_t k, i, j;
    CLAIM(below->loops == above->loops && below->open == above->open && below->collapsed == above->collapsed);
    for (k = 0; k < below->loops; ++k) {
        CLAIM(below->start[k + 1] == above->start[k + 1]);
        for (i = below->start[k], j = below->start[k + 1]; i < below->start[k + 1]; ++i) {
            --j;
            CLAIM(same_bits(below->corner + 3 * i, above->corner + 3 * j, 3 * sizeof(double)));
            CLAIM(same_bits(below->normal + 3 * i, above->normal + 3 * j, 3 * sizeof(double)));
        }
    }
}

/* Neither squares nor products of two lengths under- or overflow. */
static int is_tame(const mesh *m)
{
    double size;
    size_t i;
    for (i = 0; i < 3 * m->vertices; ++i) {
        size = fabs(m->vertex[i]);
        if (size != 0 && !(size > 1e-60 && size < 1e60)) return 0;
    }
    return 1;
}

/* In another unit, a power of two, everything is the same to the last bit. */
static void claim_scaled(mesh *m, const double *field, double level, const mesh_loops *loops)
{
    mesh_loops other;
    size_t i, corners = loops->start[loops->loops];
    for (i = 0; i < 3 * m->vertices; ++i) m->vertex[i] *= 0x1p20;
    CLAIM(mesh_normals(m, NULL) == MESH_OK && mesh_level_set(m, field, level, MESH_BELOW, &other, NULL) == MESH_OK);
    CLAIM(other.loops == loops->loops && other.area == 0x1p40 * loops->area);
    CLAIM(other.start[other.loops] == corners);
    for (i = 0; i < 3 * corners; ++i)
        CLAIM(other.corner[i] == 0x1p20 * loops->corner[i] && other.normal[i] == loops->normal[i]);
    mesh_free_loops(&other);
    for (i = 0; i < 3 * m->vertices; ++i) m->vertex[i] *= 0x1p-20;
    CLAIM(mesh_normals(m, NULL) == MESH_OK);
}

/* Below a level and above it lies the whole mesh; seen from its other side it is the same. */
static void cut_at(mesh *m, const double *field, double level, mesh_error *error)
{
    mesh_loops loops[2];
    double area = mesh_area(m), volume = mesh_volume(m);
    int side, status[2];
    for (side = 0; side < 2; ++side) {
        status[side] = mesh_level_set(m, field, level, side ? MESH_ABOVE : MESH_BELOW, &loops[side], error);
        if (status[side])
            CLAIM(status[side] == error->status && error->text[0] && !loops[side].start && !loops[side].corner);
        else
            measure_loops(&loops[side]);
    }
    CLAIM(status[0] == status[1]);
    if (!status[0]) {
        claim_reversed(&loops[0], &loops[1]);
        CLAIM(loops[0].area >= 0 && loops[1].area >= 0);
        if (is_tame(m)) {
            CLAIM(fabs(loops[0].area + loops[1].area - area) <= 1e-14 * area);
            claim_scaled(m, field, level, &loops[0]);
        }
    }
    mesh_free_loops(&loops[0]);
    mesh_free_loops(&loops[1]);
    mesh_flip(m);
    CLAIM(mesh_connect(m, NULL) == MESH_OK && mesh_normals(m, NULL) == MESH_OK);
    if (is_tame(m)) CLAIM(mesh_area(m) == area && mesh_volume(m) == -volume);
    CLAIM(mesh_level_set(m, field, level, MESH_BELOW, &loops[0], NULL) == status[0]);
    mesh_free_loops(&loops[0]);
    mesh_flip(m);
    CLAIM(mesh_connect(m, NULL) == MESH_OK && mesh_normals(m, NULL) == MESH_OK);
}

static void cut(mesh *m, const double *read, mesh_error *error)
{
    double *field = (double *)malloc(m->vertices * sizeof *field), level = 0;
    size_t i;
    if (!field) return;
    for (i = 0; i < m->vertices; ++i) {
        field[i] = read ? read[i] : m->vertex[3 * i + 2];
        if (i == m->vertices / 2) level = field[i]; /* through a vertex: the hard case */
    }
    cut_at(m, field, level, error);
    cut_at(m, field, level + 0.1, error);
    free(field);
}

/* What a reader accepts is a mesh: indices exist, twins are mutual, each edge has one triangle or two. */
static void connect_and_cut(mesh *m, const double *field, mesh_error *error)
{
    size_t h, boundary = 0;
    int status = mesh_connect(m, error);
    if (status) {
        CLAIM(status == error->status && !m->twin && (status == MESH_NOT_MANIFOLD || status == MESH_NOT_ORIENTED));
        return;
    }
    for (h = 0; h < 3 * m->triangles; ++h) {
        CLAIM(m->twin[h] == MESH_NONE || m->twin[m->twin[h]] == h);
        boundary += m->twin[h] == MESH_NONE;
    }
    CLAIM(m->boundary_edges == boundary && 2 * m->edges == 3 * m->triangles + boundary && m->pinched <= m->vertices);
    status = mesh_normals(m, error);
    if (status)
        CLAIM(status == MESH_NO_NORMAL && status == error->status && !m->normal);
    else
        cut(m, field, error);
}

/* The mesh stands before a byte 0x1e, a field for it behind; without such a byte all is both. */
static void fuzz(bytes in)
{
    mesh_error error;
    mesh m;
    FILE *file;
    double *field;
    const uint8_t *end = in.left ? (const uint8_t *)memchr(in.at, 0x1e, in.left) : NULL;
    bytes second = in;
    size_t h;
    int status;
    if (end) {
        second.at = end + 1;
        second.left = in.left - 1 - (size_t)(end - in.at);
        in.left = (size_t)(end - in.at);
    }
    if (in.left == 0 || second.left == 0) return; /* fmemopen refuses it */
    file = open_bytes(&in);
    status = mesh_read_stream(&m, file, "mesh", NULL, &error);
    fclose(file);
    if (status) {
        CLAIM(status == error.status && strncmp(error.text, "mesh", 4) == 0);
        CLAIM(!m.vertex && !m.triangle && !m.line && !m.name && m.vertices == 0 && m.triangles == 0);
        return;
    }
    CLAIM(m.triangles > 0 && all_finite(m.vertex, 3 * m.vertices));
    for (h = 0; h < 3 * m.triangles; ++h) CLAIM(m.triangle[h] < m.vertices);
    file = open_bytes(&second);
    status = mesh_read_field_stream(&m, file, "field", &field, NULL, &error);
    if (status == MESH_OK)
        CLAIM(all_finite(field, m.vertices));
    else
        CLAIM(status == error.status && strncmp(error.text, "field", 5) == 0 && !field);
    fclose(file);
    connect_and_cut(&m, field, &error);
    free(field);
    mesh_free(&m);
}
