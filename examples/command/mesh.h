/* mesh.h - step 1 of the command: an OFF polygon mesh -> its faces, one polygon each.

   OFF
   # anything after a # is a comment
   4 1 0               vertices, faces, edges (may be left out)
   0 0 0               x y z of each vertex; more numbers are ignored
   ...
   4  0 1 2 3          corners of each face, counter-clockwise from outside; more numbers are ignored       */
#ifndef SURFMINK_COMMAND_MESH_H
#define SURFMINK_COMMAND_MESH_H

#include "lines.h"
#include "polygon.h"

typedef struct mesh {
    int surface;
    size_t vertices, faces;
    double *vertex; /* 3 a vertex */
    double *normal; /* 3 a vertex */
    size_t *begin;  /* faces + 1: where in `corner` the vertices of each face begin */
    size_t *corner;
    unsigned long *line; /* of each face */
    size_t next;         /* face to hand out */
} mesh;

/* --- lines -------------------------------------------------------------------------------------------------------- */

/* The next line that says something, split; 0 at the end of the file. */
static int next_mesh_line(lines *in)
{
    do {
        if (!read_line(in)) return 0;
        in->text[strcspn(in->text, "#")] = '\0';
    } while (is_blank_line(in->text));
    split_line(in, ' ');
    return 1;
}

static void expect_mesh_line(lines *in, const char *what, size_t number)
{
    if (!next_mesh_line(in)) malformed(in, "the file ends before %s %lu", what, (unsigned long)number);
}

/* Field i of the line as a count. */
static size_t count_in(const lines *in, size_t i, const char *what)
{
    size_t count;
    if (i >= in->fields) malformed(in, "%s is missing", what);
    if (!parse_count(in->field[i], &count)) malformed(in, "'%s' is not %s", in->field[i], what);
    return count;
}

/* --- the file ----------------------------------------------------------------------------------------------------- */

static void read_counts(mesh *m, lines *in)
{
    size_t first = 1;
    if (!next_mesh_line(in)) die("%s: the file is empty", in->name);
    if (strcmp(in->field[0], "OFF") != 0 && strcmp(in->field[0], "COFF") != 0) malformed(in, "a mesh begins with OFF");
    if (in->fields == 1) {
        if (!next_mesh_line(in)) malformed(in, "the file ends before the counts");
        first = 0;
    }
    m->vertices = count_in(in, first, "the number of vertices");
    m->faces = count_in(in, first + 1, "the number of faces");
}

/* Room grows with what is read: the counts at the top of a file are only a promise. */
static void read_vertices(mesh *m, lines *in)
{
    size_t i, k, room = 0;
    for (i = 0; i < m->vertices; ++i) {
        expect_mesh_line(in, "vertex", i);
        m->vertex = (double *)grow(m->vertex, &room, 3 * (i + 1), sizeof *m->vertex);
        if (in->fields < 3) malformed(in, "a vertex needs x y z");
        for (k = 0; k < 3; ++k)
            if (!parse_number(in->powers, in->field[k], m->vertex + 3 * i + k))
                malformed(in, "'%s' is not a number", in->field[k]);
    }
}

static void read_faces(mesh *m, lines *in)
{
    size_t i, k, n, vertex, corners = 0, room = 0, begin_room = 0, line_room = 0;
    m->begin = (size_t *)grow(m->begin, &begin_room, 1, sizeof *m->begin);
    m->begin[0] = 0;
    for (i = 0; i < m->faces; ++i) {
        expect_mesh_line(in, "face", i);
        n = count_in(in, 0, "the number of corners");
        if (n >= in->fields)
            malformed(in, "%lu corners are announced, %lu follow", (unsigned long)n, (unsigned long)in->fields - 1);
        m->corner = (size_t *)grow(m->corner, &room, corners + n + 1, sizeof *m->corner);
        for (k = 1; k <= n; ++k) {
            vertex = count_in(in, k, "the index of a vertex");
            if (vertex >= m->vertices) malformed(in, "there is no vertex %s", in->field[k]);
            m->corner[corners++] = vertex;
        }
        m->begin = (size_t *)grow(m->begin, &begin_room, i + 2, sizeof *m->begin);
        m->begin[i + 1] = corners;
        m->line = (unsigned long *)grow(m->line, &line_room, i + 1, sizeof *m->line);
        m->line[i] = in->number;
    }
    if (next_mesh_line(in)) malformed(in, "a line after the last of %lu faces", (unsigned long)m->faces);
}

/* --- normals ------------------------------------------------------------------------------------------------------ */

/* Twice the area vector of a face: cross products as seen from its first corner, so that far-away meshes keep their
   digits. */
static void area_vector(const mesh *m, size_t face, double area[3])
{
    size_t i, k;
    const size_t *corner = m->corner + m->begin[face];
    size_t n = m->begin[face + 1] - m->begin[face];
    double a[3], b[3];
    area[0] = area[1] = area[2] = 0;
    for (i = 1; i + 1 < n; ++i) {
        for (k = 0; k < 3; ++k) {
            a[k] = m->vertex[3 * corner[i] + k] - m->vertex[3 * corner[0] + k];
            b[k] = m->vertex[3 * corner[i + 1] + k] - m->vertex[3 * corner[0] + k];
        }
        area[0] += a[1] * b[2] - a[2] * b[1];
        area[1] += a[2] * b[0] - a[0] * b[2];
        area[2] += a[0] * b[1] - a[1] * b[0];
    }
}

static void find_normals(mesh *m)
{
    size_t i, j, k;
    double area[3];
    m->normal = (double *)resize(NULL, m->vertices + 1, 3 * sizeof *m->normal);
    for (i = 0; i < 3 * m->vertices; ++i) m->normal[i] = 0;
    for (i = 0; i < m->faces; ++i) {
        area_vector(m, i, area);
        for (j = m->begin[i]; j < m->begin[i + 1]; ++j)
            for (k = 0; k < 3; ++k) m->normal[3 * m->corner[j] + k] += area[k];
    }
}

/* --- polygons ----------------------------------------------------------------------------------------------------- */

static void read_mesh(mesh *m, lines *in, const options *o)
{
    memset(m, 0, sizeof *m);
    m->surface = o->surface == AS_THE_COLUMNS_SAY ? EMBEDDED : o->surface;
    read_counts(m, in);
    read_vertices(m, in);
    read_faces(m, in);
    find_normals(m);
}

static int next_of_mesh(mesh *m, polygon *p)
{
    size_t i, face = m->next;
    char number[32];
    if (face == m->faces) return 0;
    ++m->next;
    snprintf(number, sizeof number, "%lu", (unsigned long)face);
    begin_polygon(p, m->surface, number, m->line[face]);
    for (i = m->begin[face]; i < m->begin[face + 1]; ++i) {
        const double *x = m->vertex + 3 * m->corner[i], *normal = m->normal + 3 * m->corner[i];
        add_corner(p, x, normal, m->line[face]);
    }
    return 1;
}

static void free_mesh(mesh *m)
{
    free(m->vertex);
    free(m->normal);
    free(m->begin);
    free(m->corner);
    free(m->line);
}

#endif
