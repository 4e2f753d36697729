/* mesh.h - triangle meshes and their level sets, for surfmink - MIT or public domain, as you like (see surfmink.h)

   Copy it with meshfile.h, which reads the files, and contour.h, which keeps the loops, beside surfmink.h, which it does
   not need. C99 and C++, only libc and libm.

   WHAT IT DOES
     Reads a triangle mesh, and cuts it where a scalar on its vertices has a given value. Out come outlines as
     surfmink_embedded wants them: corners and unit normals, one closed loop after the other.

   QUICK START
     mesh m;  mesh_error error;  mesh_loops loops;
     double *field = NULL;                                                 // one scalar per vertex
     if (mesh_read(&m, "cell.off", NULL, &error) || mesh_connect(&m, &error) || mesh_normals(&m, &error) ||
         mesh_read_field(&m, "height.txt", &field, NULL, &error) ||
         mesh_level_set(&m, field, 0.5, MESH_BELOW, &loops, &error)) puts(error.text);
     for (k = 0; k < loops.loops; ++k) {
         surfmink_outline loop = surfmink_embedded(loops.corner + 3 * loops.start[k], loops.normal + 3 * loops.start[k],
                                                   loops.start[k + 1] - loops.start[k]);
         surfmink_measure(&loop, 6, mu, NULL, NULL, NULL);
     }

   DATA FLOW (sections of this file, in order)
     1 read      file -> vertices, triangles             every format of meshfile.h; or mesh_sphere builds them
     2 connect   triangles -> which edge meets which     refuses what is not an oriented surface
     3 normals   triangles -> unit normal per vertex     area-weighted
     4 level set field on the vertices -> loops          and the area of the part that they enclose

   CONVENTIONS
     triangle    its vertices a b c run counter-clockwise seen from outside
     half-edge   number 3 t + k: the side of triangle t that leaves its corner k for the next one
     inside      MESH_BELOW: where field < level; MESH_ABOVE: where field >= level. A vertex exactly at the level is
                 thus above it, in every triangle that it belongs to, and the two parts make up the whole mesh.
     loop        has the inside on its left, seen from outside. A component of the inside that is a disc has one loop,
                 with S > 0 on surfaces like a sphere; a hole in it has a loop of its own that runs round the
                 hole the other way, with S < 0: surfmink refuses it as clockwise, or measures the hole if reversed.

   MEMORY AND COST
     Arrays come from malloc. mesh_free and mesh_free_loops give them back; the field of mesh_read_field goes to free.
     When a call fails there is nothing to free from it: the mesh or loops that it should have made are empty.
     Every step takes linear time. No globals; strtod and printf heed the locale, so leave LC_NUMERIC at "C". */
#ifndef SURFMINK_MESH_H
#define SURFMINK_MESH_H

#include "contour.h"
#include "meshfile.h"

typedef struct mesh {
    size_t vertices, triangles;
    double *vertex;        /* 3 per vertex: x y z */
    uint32_t *triangle;    /* 3 per triangle: numbers of its vertices */
    unsigned long *line;   /* 1 per triangle: where the file has it, 0 in binary files; NULL if it is from no file */
    char *name;            /* the file; NULL if there is none */
    double *field;         /* 1 per vertex: the scalar asked for of the file; NULL if there is none */
    uint32_t *joint;       /* from mesh_read, 1 per vertex: itself, or the first of its copies, which triangles have */
    int ignored;           /* from mesh_read: the file has normals that contradict its faces, or each other */
    size_t joined, turned; /* from mesh_read: vertices that are copies; faces that were turned round, */
    unsigned long first_turned; /* and the line of the first of them */
    uint32_t *twin;             /* from mesh_connect: the half-edge on the other side, or MESH_NONE at the boundary */
    size_t edges;               /* from mesh_connect */
    size_t boundary_edges;      /* from mesh_connect: 0 for a closed mesh */
    size_t pinched; /* from mesh_connect: vertices where sheets touch that share no edge; harmless to loops, but
                              the normal there is a mean over the sheets */
    double *normal; /* from mesh_normals, or the file: 3 per vertex, of unit length; 0 at one without triangles */
} mesh;

enum mesh_inside { MESH_BELOW = CONTOUR_BELOW, MESH_ABOVE = CONTOUR_ABOVE };

typedef contours mesh_loops; /* the outlines of one level; corners on mesh edges */

enum mesh_base { MESH_ICOSAHEDRON = 20, MESH_OCTAHEDRON = 8 };

/* Gives the arrays back and leaves an empty mesh. */
static inline void mesh_free(mesh *m)
{
    free(m->vertex);
    free(m->triangle);
    free(m->line);
    free(m->name);
    free(m->field);
    free(m->joint);
    free(m->twin);
    free(m->normal);
    memset(m, 0, sizeof *m);
}

/* --- 1. read: file -> vertices, triangles ------------------------------------------------------------------------- */

static inline double mesh__length(const double x[3])
{
    return sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

/* A face on its way to triangles: its corners in a ring, seen along its area vector. */
typedef struct mesh__ring {
    const mesh_file *f;
    size_t begin, count;
    double area[3];
    size_t *next, *last, *reflex; /* reflex: the corners that turn to the right, none of which may lie in an ear */
    size_t reflexes;
} mesh__ring;

static inline const double *mesh__place(const mesh__ring *ring, size_t i)
{
    return ring->f->vertex + 3 * (size_t)ring->f->corner[ring->begin + i];
}

/* Twice the area of the triangle, positive if it runs the way of the face. */
static inline double mesh__side(const mesh__ring *ring, size_t i, size_t j, size_t k)
{
    const double *a = mesh__place(ring, i), *b = mesh__place(ring, j), *c = mesh__place(ring, k);
    double u[3], v[3];
    int x;
    for (x = 0; x < 3; ++x) u[x] = b[x] - a[x], v[x] = c[x] - a[x];
    return (u[1] * v[2] - u[2] * v[1]) * ring->area[0] + (u[2] * v[0] - u[0] * v[2]) * ring->area[1] +
           (u[0] * v[1] - u[1] * v[0]) * ring->area[2];
}

/* Can corner i be cut off, with its neighbours, as a triangle? */
static inline int mesh__is_ear(const mesh__ring *ring, size_t i)
{
    size_t a = ring->last[i], c = ring->next[i], k;
    if (!(mesh__side(ring, a, i, c) > 0)) return 0;
    for (k = 0; k < ring->reflexes; ++k) {
        size_t p = ring->reflex[k];
        if (p == a || p == i || p == c) continue;
        if (mesh__side(ring, a, i, p) >= 0 && mesh__side(ring, i, c, p) >= 0 && mesh__side(ring, c, a, p) >= 0)
            return 0;
    }
    return 1;
}

static inline double mesh__diagonal(const mesh__ring *ring, size_t i)
{
    const double *a = mesh__place(ring, ring->last[i]), *c = mesh__place(ring, ring->next[i]);
    double d[3];
    int k;
    for (k = 0; k < 3; ++k) d[k] = a[k] - c[k];
    return mesh__length(d);
}

/* The ear of a quad or a pentagon with the shortest diagonal; of more corners the next ear from `at` on. A face that
   crosses itself may have none: then any corner. */
static inline size_t mesh__next_ear(const mesh__ring *ring, size_t at)
{
    size_t k, best = at;
    double shortest = -1;
    for (k = 0; k < ring->count; ++k, at = ring->next[at]) {
        double diagonal = mesh__diagonal(ring, at);
        if ((shortest >= 0 && diagonal >= shortest) || !mesh__is_ear(ring, at)) continue;
        best = at;
        shortest = diagonal;
        if (ring->count > 5) break;
    }
    return best;
}

static inline int mesh__add_triangle(mesh *m, size_t room[2], const mesh__ring *ring, const size_t corner[3],
                                     unsigned long line, mesh_error *error)
{
    const uint32_t *joint = ring->f->joint, *vertex = ring->f->corner + ring->begin;
    uint32_t v[3];
    void *grown = mesh__grow(m->triangle, m->triangles, &room[0], 3 * sizeof *m->triangle);
    int k;
    if (grown) m->triangle = (uint32_t *)grown;
    if (grown) grown = mesh__grow(m->line, m->triangles, &room[1], sizeof *m->line);
    if (!grown) return mesh__no_memory(error, m->name);
    m->line = (unsigned long *)grown;
    if (m->triangles >= MESH_NONE / 3) return mesh__fail(error, MESH_TOO_LARGE, m->name, line, "too many triangles");
    for (k = 0; k < 3; ++k) v[k] = joint[vertex[corner[k]]];
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) return MESH_OK; /* joined: nothing is left of it */
    memcpy(m->triangle + 3 * m->triangles, v, sizeof v);
    m->line[m->triangles++] = line;
    return MESH_OK;
}

/* Cuts ears off a face until it is a triangle. O(corners times reflex corners). */
static inline int mesh__split(mesh *m, size_t room[2], mesh__ring *ring, unsigned long line, mesh_error *error)
{
    size_t n = ring->count, i, at = 0, corner[3];
    int status = MESH_OK;
    for (i = 0; i < n; ++i) {
        ring->next[i] = i + 1 < n ? i + 1 : 0;
        ring->last[i] = i > 0 ? i - 1 : n - 1;
    }
    for (ring->reflexes = 0, i = 0; i < n; ++i)
        if (mesh__side(ring, ring->last[i], i, ring->next[i]) <= 0) ring->reflex[ring->reflexes++] = i;
    while (!status && ring->count >= 3) {
        if (ring->count > 3) at = mesh__next_ear(ring, at);
        corner[0] = ring->last[at], corner[1] = at, corner[2] = ring->next[at];
        if (n == 3) corner[0] = 0, corner[1] = 1, corner[2] = 2;
        status = mesh__add_triangle(m, room, ring, corner, line, error);
        ring->next[corner[0]] = corner[2];
        ring->last[corner[2]] = corner[0];
        at = corner[2];
        if (--ring->count < 3) break;
    }
    return status;
}

static inline int mesh__split_faces(mesh *m, const mesh_file *f, mesh_error *error)
{
    mesh__ring ring;
    size_t i, most = 3, room[2] = {0, 0}, *work;
    int status = MESH_OK;
    for (i = 0; i < f->faces; ++i)
        if (f->begin[i + 1] - f->begin[i] > most) most = f->begin[i + 1] - f->begin[i];
    work = (size_t *)malloc(3 * most * sizeof *work);
    if (!work) return mesh__no_memory(error, m->name);
    memset(&ring, 0, sizeof ring);
    ring.f = f;
    ring.next = work, ring.last = work + most, ring.reflex = work + 2 * most;
    for (i = 0; !status && i < f->faces; ++i) {
        ring.begin = f->begin[i];
        ring.count = f->begin[i + 1] - f->begin[i];
        mesh_file_area(f, i, ring.area);
        status = mesh__split(m, room, &ring, f->line[i], error);
    }
    free(work);
    if (!status && !m->triangles)
        status = mesh__fail(error, MESH_MALFORMED, m->name, 0, "its faces are no larger than what is joined");
    return status;
}

/* Normals of the file, where it has them for all corners, where no face contradicts them, and where those of one vertex
   agree to 3 degrees: programs that draw also write normals of facets. */
static inline int mesh__take_normals(mesh *m, const mesh_file *f, mesh_error *error)
{
    const double cos_3 = 0.9986;
    size_t j, corners = f->begin[f->faces];
    double *sum, length;
    int c, agree = 1;
    if (!f->normals) return MESH_OK;
    m->ignored = mesh_file_contradiction(f) < f->faces;
    if (m->ignored) return MESH_OK;
    sum = (double *)calloc(3 * f->vertices + 1, sizeof *sum);
    if (!sum) return mesh__no_memory(error, m->name);
    for (j = 0; agree && j < corners; ++j) {
        const double *n = mesh_file_normal(f, j);
        double *to = sum + 3 * (size_t)f->joint[f->corner[j]];
        length = mesh__length(n);
        if (!(length > 0 && length <= DBL_MAX)) agree = 0;
        for (c = 0; c < 3 && agree; ++c) to[c] += n[c] / length;
    }
    for (j = 0; agree && j < corners; ++j) {
        const double *n = mesh_file_normal(f, j), *mean = sum + 3 * (size_t)f->joint[f->corner[j]];
        double cosine = (n[0] * mean[0] + n[1] * mean[1] + n[2] * mean[2]) / (mesh__length(n) * mesh__length(mean));
        agree = cosine > cos_3;
    }
    for (j = 0; agree && j < f->vertices; ++j) {
        length = mesh__length(sum + 3 * j);
        for (c = 0; c < 3 && length > 0; ++c) sum[3 * j + (size_t)c] /= length;
    }
    m->ignored = !agree;
    if (agree)
        m->normal = sum;
    else
        free(sum);
    return MESH_OK;
}

/* Where faces are no triangles: the mean over the faces, for that over their triangles depends on how they were cut. */
static inline int mesh__mean_normals(mesh *m, const mesh_file *f, mesh_error *error)
{
    double *mean, length;
    size_t i, v, c;
    for (i = 0; i < f->faces && f->begin[i + 1] - f->begin[i] == 3;) ++i;
    if (m->normal || i == f->faces) return MESH_OK;
    mean = mesh_file_means(f);
    if (!mean) return mesh__no_memory(error, m->name);
    for (i = 0; i < 3 * m->triangles; ++i) {
        length = mesh__length(mean + 3 * (size_t)m->triangle[i]);
        if (length > 0 && length <= DBL_MAX) continue;
        free(mean); /* mesh_normals says where there is none */
        return MESH_OK;
    }
    for (v = 0; v < f->vertices; ++v) {
        length = mesh__length(mean + 3 * v);
        for (c = 0; c < 3 && length > 0; ++c) mean[3 * v + c] /= length;
    }
    m->normal = mean;
    return MESH_OK;
}

/* What meshfile.h reads and mere outlines may have, but a surface of triangles may not. */
static inline int mesh__check_faces(const mesh_file *f, const char *name, mesh_error *error)
{
    size_t i, j;
    if (f->infinite_line)
        return mesh__fail(error, MESH_MALFORMED, name, f->infinite_line, "expected finite numbers x y z");
    for (i = 0; i < f->faces; ++i) {
        size_t n = f->begin[i + 1] - f->begin[i];
        const uint32_t *v = f->corner + f->begin[i];
        if (n < 3)
            return mesh__fail(error, MESH_NOT_TRIANGLES, name, f->line[i], "a face of %lu corners", (unsigned long)n);
        for (j = 0; j < n; ++j)
            if (v[j] == v[j + 1 < n ? j + 1 : 0])
                return mesh__fail(error, MESH_BAD_INDEX, name, f->line[i],
                                  "a face has vertex %lu twice, counted from 0", (unsigned long)v[j]);
    }
    return f->faces ? MESH_OK : mesh__fail(error, MESH_MALFORMED, name, 0, "there are no faces in it");
}

/* Makes triangles of a mesh that has been read; what is taken over from f is NULL there. */
static inline int mesh__from_file(mesh *m, mesh_file *f, const char *name, mesh_error *error)
{
    int status = mesh__check_faces(f, name, error);
    if (!status) status = mesh_file_orient(f, name, error);
    if (status) return status;
    m->name = (char *)malloc(strlen(name) + 1);
    if (!m->name) return mesh__no_memory(error, name);
    strcpy(m->name, name);
    status = mesh__split_faces(m, f, error);
    if (!status) status = mesh__take_normals(m, f, error);
    if (!status) status = mesh__mean_normals(m, f, error);
    m->vertices = f->vertices;
    m->vertex = f->vertex;
    m->field = f->field;
    m->joint = f->joint;
    f->vertex = f->field = NULL;
    f->joint = NULL;
    m->joined = f->joined;
    m->turned = f->turned;
    m->first_turned = f->line[f->first_turned];
    return status;
}

/* Reads a mesh: an oriented surface, whose quads and polygons are split into triangles. Copies of vertices at its
   boundary are joined, faces that run against their neighbours turned round: m->joined, m->turned.
   m           out: vertices as in the file, in its order, also those that no triangle uses; triangles in the order of
               their faces
   field       NULL, or the name of a scalar of the vertices: m->field
   Errors: UNREADABLE, MALFORMED, NOT_TRIANGLES, BAD_INDEX, TOO_LARGE, NOT_MANIFOLD, NOT_ORIENTED, NO_MEMORY; error may
   be NULL. */
static inline int mesh_read_source(mesh *m, const mesh_source *source, const char *field, mesh_error *error)
{
    mesh_file f;
    int status;
    memset(m, 0, sizeof *m);
    status = mesh_file_read(&f, source, field, error);
    if (!status) status = mesh__from_file(m, &f, source->name, error);
    mesh_file_free(&f);
    if (status) mesh_free(m);
    return status;
}

/* The same from an open file, which stays open. */
static inline int mesh_read_stream(mesh *m, FILE *file, const char *name, const char *field, mesh_error *error)
{
    mesh_source source;
    source.name = name;
    source.read = mesh_file_from_stream;
    source.context = file;
    return mesh_read_source(m, &source, field, error);
}

/* The same from a file that is opened and closed here. "-" is standard input. */
static inline int mesh_read(mesh *m, const char *path, const char *field, mesh_error *error)
{
    FILE *file = strcmp(path, "-") ? fopen(path, "rb") : stdin;
    int status;
    memset(m, 0, sizeof *m);
    if (!file) return mesh__fail(error, MESH_UNREADABLE, path, 0, "cannot be opened");
    status = mesh_read_stream(m, file, path, field, error);
    if (file != stdin) fclose(file);
    return status;
}

static inline int mesh__is_nan(double x)
{
    return !(x <= 0) && !(x > 0);
}

static inline int mesh__read_values(const mesh *m, mesh__reader *r, double *field, size_t *hole)
{
    size_t k;
    int got = 1, status;
    for (k = 0;; ++k) {
        char *at;
        status = mesh__line(r, 1, &got);
        if (status) return status;
        if (!got) break;
        at = r->text;
        if (k == m->vertices)
            return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line, "a value too many: the mesh has %lu vertices",
                              (unsigned long)k);
        if (!mesh__number(&at, &field[k]) || at[strspn(at, " \t")])
            return mesh__malformed(r, "one finite number a line", r->text);
        if (!mesh__is_nan(field[k]) && !(fabs(field[k]) <= DBL_MAX))
            return mesh__malformed(r, "one finite number a line", r->text);
        if (mesh__is_nan(field[k]) && hole && !*hole) *hole = r->line;
        if (mesh__is_nan(field[k]) && !hole) return mesh__malformed(r, "one finite number a line", r->text);
    }
    if (k == m->vertices) return MESH_OK;
    return mesh__fail(r->error, MESH_MALFORMED, r->name, r->line,
                      "the file ends after %lu values: the mesh has %lu vertices", (unsigned long)k,
                      (unsigned long)m->vertices);
}

/* Reads a scalar for each vertex of the mesh, one a line; comments (from # on) and blank lines are skipped.
   *field      m->vertices  out: to be freed by the caller
   *hole       out: the line of the first NaN, 0 if there is none; with NULL a NaN is refused
   Errors: UNREADABLE, MALFORMED (also: too few or too many values), NO_MEMORY; error may be NULL. */
static inline int mesh_read_field_stream(const mesh *m, FILE *file, const char *name, double **field, size_t *hole,
                                         mesh_error *error)
{
    mesh__reader r;
    mesh_source source;
    int status = MESH_OK;
    source.name = name;
    source.read = mesh_file_from_stream;
    source.context = file;
    memset(&r, 0, sizeof r);
    r.source = &source;
    r.name = name;
    r.error = error;
    r.block = (char *)malloc(MESH__BLOCK);
    if (hole) *hole = 0;
    *field = (double *)malloc((m->vertices + 1) * sizeof **field);
    if (!*field || !r.block) status = mesh__no_memory(error, name);
    if (!status) status = mesh__read_values(m, &r, *field, hole);
    free(r.text);
    free(r.block);
    if (status) {
        free(*field);
        *field = NULL;
    }
    return status;
}

/* The same from a file that is opened and closed here. "-" is standard input. */
static inline int mesh_read_field(const mesh *m, const char *path, double **field, size_t *hole, mesh_error *error)
{
    FILE *file = strcmp(path, "-") ? fopen(path, "r") : stdin;
    int status;
    *field = NULL;
    if (!file) return mesh__fail(error, MESH_UNREADABLE, path, 0, "cannot be opened");
    status = mesh_read_field_stream(m, file, path, field, hole, error);
    if (file != stdin) fclose(file);
    return status;
}

/* Leaves out the triangles at vertices without a value, a NaN, which then is 0. Returns how many these are; connect has
   to be done after it. */
static inline size_t mesh_cut_holes(mesh *m, double *field)
{
    size_t t, kept = 0, v;
    for (t = 0; t < m->triangles; ++t) {
        const uint32_t *v3 = m->triangle + 3 * t;
        if (mesh__is_nan(field[v3[0]]) || mesh__is_nan(field[v3[1]]) || mesh__is_nan(field[v3[2]])) continue;
        memmove(m->triangle + 3 * kept, v3, 3 * sizeof *v3);
        if (m->line) m->line[kept] = m->line[t];
        ++kept;
    }
    t = m->triangles - kept;
    m->triangles = kept;
    for (v = 0; v < m->vertices; ++v)
        if (mesh__is_nan(field[v])) field[v] = 0;
    return t;
}

/* --- 2. connect: triangles -> which edge meets which -------------------------------------------------------------- */

/* The next half-edge round the same triangle. */
static inline size_t mesh__next(size_t h)
{
    return h % 3 < 2 ? h + 1 : h - 2;
}

/* The larger (end = 1) or smaller (end = 0) vertex of a half-edge. */
static inline uint32_t mesh__end(const mesh *m, size_t h, int end)
{
    uint32_t a = m->triangle[h], b = m->triangle[mesh__next(h)];
    return (a > b) == end ? a : b;
}

/* Sorts half-edges by one of their ends, in linear time; those with equal ends keep their order.
   place: m->vertices + 1 numbers to work in. */
static inline void mesh__sort(const mesh *m, int end, const uint32_t *from, uint32_t *to, size_t *place)
{
    size_t halves = 3 * m->triangles, h, v;
    memset(place, 0, (m->vertices + 1) * sizeof *place);
    for (h = 0; h < halves; ++h) ++place[mesh__end(m, h, end) + 1];
    for (v = 0; v < m->vertices; ++v) place[v + 1] += place[v];
    for (h = 0; h < halves; ++h) {
        uint32_t half = from ? from[h] : (uint32_t)h;
        to[place[mesh__end(m, half, end)]++] = half;
    }
}

/* Walks round a vertex from one of the half-edges that leave it, as far as triangles share edges. */
static inline void mesh__fan(const mesh *m, size_t h, unsigned char *seen)
{
    uint32_t twin;
    do {
        seen[h] = 1;
        twin = m->twin[mesh__next(mesh__next(h))]; /* beyond the side that comes back to the vertex */
        if (twin == MESH_NONE) return;
        h = twin;
    } while (!seen[h]);
}

/* Counts vertices with more than one fan of triangles round them. */
static inline size_t mesh__count_pinched(const mesh *m, unsigned char *seen, unsigned char *fans)
{
    size_t halves = 3 * m->triangles, pinched = 0, h;
    int closed;
    for (closed = 0; closed < 2; ++closed) /* fans that end at a boundary are walked first, from their first side */
        for (h = 0; h < halves; ++h)
            if (!seen[h] && (closed || m->twin[h] == MESH_NONE)) {
                unsigned char *fan = &fans[m->triangle[h]];
                mesh__fan(m, h, seen);
                if (*fan == 1) ++pinched;
                if (*fan < 2) ++*fan;
            }
    return pinched;
}

/* Finds for each half-edge its twin on the other side of the edge, and counts edges.
   Errors: NOT_MANIFOLD, NOT_ORIENTED, NO_MEMORY; the mesh is then as before. Cost: O(vertices + triangles). */
static inline int mesh_connect(mesh *m, mesh_error *error)
{
    size_t halves = 3 * m->triangles, edges = 0, boundary = 0, h, group;
    uint32_t *twin = (uint32_t *)malloc((halves + 1) * sizeof *twin);
    uint32_t *sorted = (uint32_t *)malloc((halves + 1) * sizeof *sorted);
    size_t *place = (size_t *)malloc((m->vertices + 1) * sizeof *place);
    unsigned char *seen = NULL, *fans = NULL;
    int status = twin && sorted && place ? MESH_OK : mesh__no_memory(error, m->name);
    if (!status) { /* two sorts bring together the half-edges of one edge */
        mesh__sort(m, 1, NULL, twin, place);
        mesh__sort(m, 0, twin, sorted, place);
        seen = (unsigned char *)calloc(halves + 1, 1);
        fans = (unsigned char *)calloc(m->vertices + 1, 1);
        if (!seen || !fans) status = mesh__no_memory(error, m->name);
    }
    for (h = 0; !status && h < halves; h += group) {
        uint32_t low = mesh__end(m, sorted[h], 0), high = mesh__end(m, sorted[h], 1);
        for (group = 1; h + group < halves && mesh__end(m, sorted[h + group], 0) == low &&
                        mesh__end(m, sorted[h + group], 1) == high;
             ++group)
            continue;
        ++edges;
        if (group == 1) {
            ++boundary;
            twin[sorted[h]] = MESH_NONE;
        } else if (group > 2) {
            status = mesh__fail(error, MESH_NOT_MANIFOLD, m->name, m->line ? m->line[sorted[h + 2] / 3] : 0,
                                "the edge between vertices %lu and %lu (from 0) has %lu triangles: not a surface",
                                (unsigned long)low, (unsigned long)high, (unsigned long)group);
        } else if (m->triangle[sorted[h]] == m->triangle[sorted[h + 1]]) {
            status = mesh__fail(error, MESH_NOT_ORIENTED, m->name, m->line ? m->line[sorted[h + 1] / 3] : 0,
                                "the triangles at the edge between vertices %lu and %lu (from 0) run opposite ways",
                                (unsigned long)low, (unsigned long)high);
        } else {
            twin[sorted[h]] = sorted[h + 1];
            twin[sorted[h + 1]] = sorted[h];
        }
    }
    if (!status) {
        free(m->twin);
        m->twin = twin;
        twin = NULL;
        m->edges = edges;
        m->boundary_edges = boundary;
        m->pinched = mesh__count_pinched(m, seen, fans);
    }
    free(twin);
    free(sorted);
    free(place);
    free(seen);
    free(fans);
    return status;
}

/* Turns every triangle round, so that the other side is outside; connect and normals have to be done again. */
static inline void mesh_flip(mesh *m)
{
    size_t t;
    for (t = 0; t < m->triangles; ++t) {
        uint32_t *corner = m->triangle + 3 * t, last = corner[2];
        corner[2] = corner[1];
        corner[1] = last;
    }
    for (t = 0; m->normal && t < 3 * m->vertices; ++t) m->normal[t] = -m->normal[t];
    free(m->twin);
    m->twin = NULL;
}

/* --- 3. normals: triangles -> unit normal per vertex -------------------------------------------------------------- */

/* Twice the area of a triangle, along its normal. */
static inline void mesh__double_area(const mesh *m, size_t t, double out[3])
{
    const double *a = m->vertex + 3 * (size_t)m->triangle[3 * t], *b = m->vertex + 3 * (size_t)m->triangle[3 * t + 1],
                 *c = m->vertex + 3 * (size_t)m->triangle[3 * t + 2];
    double u[3], v[3];
    int k;
    for (k = 0; k < 3; ++k) u[k] = b[k] - a[k], v[k] = c[k] - a[k];
    out[0] = u[1] * v[2] - u[2] * v[1];
    out[1] = u[2] * v[0] - u[0] * v[2];
    out[2] = u[0] * v[1] - u[1] * v[0];
}

/* Unit normals at the vertices: the sum of the normals of the triangles there, weighted by area, normalised.
   Errors: NO_NORMAL, NO_MEMORY; the mesh is then as before. Cost: O(vertices + triangles). */
static inline int mesh_normals(mesh *m, mesh_error *error)
{
    double *normal = (double *)calloc(3 * m->vertices + 1, sizeof *normal);
    size_t t, v;
    int c, k;
    if (!normal) return mesh__no_memory(error, m->name);
    for (t = 0; t < m->triangles; ++t) {
        double n[3];
        mesh__double_area(m, t, n);
        for (k = 0; k < 3; ++k)
            for (c = 0; c < 3; ++c) normal[3 * (size_t)m->triangle[3 * t + (size_t)k] + (size_t)c] += n[c];
    }
    for (t = 0; t < 3 * m->triangles; ++t) { /* not over the vertices: those without triangles need no normal */
        double *n = normal + 3 * (size_t)m->triangle[t], length = mesh__length(n);
        if (!(length > 0 && length <= DBL_MAX)) {
            v = m->triangle[t];
            free(normal);
            return mesh__fail(error, MESH_NO_NORMAL, m->name, m->line ? m->line[t / 3] : 0,
                              "vertex %lu (from 0) has no normal: its triangles have no area, or cancel",
                              (unsigned long)v);
        }
        for (c = 0; c < 3; ++c) n[c] /= length;
    }
    free(m->normal);
    m->normal = normal;
    return MESH_OK;
}

/* --- 4. level set: field on the vertices -> loops ----------------------------------------------------------------- */

/* Area of the mesh. */
static inline double mesh_area(const mesh *m)
{
    double sum[2] = {0, 0}, n[3];
    size_t t;
    for (t = 0; t < m->triangles; ++t) {
        mesh__double_area(m, t, n);
        contour_sum(sum, mesh__length(n) / 2);
    }
    return sum[0] + sum[1];
}

/* Volume inside a closed mesh; negative if it is inside out, so that its normals point inwards. */
static inline double mesh_volume(const mesh *m)
{
    double sum[2] = {0, 0}, n[3];
    size_t t;
    for (t = 0; t < m->triangles; ++t) {
        const double *o = m->vertex + 3 * (size_t)m->triangle[0], *a = m->vertex + 3 * (size_t)m->triangle[3 * t];
        mesh__double_area(m, t, n);
        contour_sum(sum, ((a[0] - o[0]) * n[0] + (a[1] - o[1]) * n[1] + (a[2] - o[2]) * n[2]) / 6);
    }
    return sum[0] + sum[1];
}

/* The longest edge of the mesh: the h of convergence studies. */
static inline double mesh_longest_edge(const mesh *m)
{
    double longest = 0;
    size_t h;
    for (h = 0; h < 3 * m->triangles; ++h) {
        const double *a = m->vertex + 3 * (size_t)m->triangle[h],
                     *b = m->vertex + 3 * (size_t)m->triangle[mesh__next(h)];
        double d[3];
        int c;
        for (c = 0; c < 3; ++c) d[c] = a[c] - b[c];
        longest = fmax(longest, mesh__length(d));
    }
    return longest;
}

/* Gives the arrays back and leaves no loops. */
static inline void mesh_free_loops(mesh_loops *loops)
{
    contours_free(loops);
}

/* How far the level is on the way from one end of an edge to the other: exactly 0 and 1 at the ends. */
static inline double mesh__fraction(double from, double to, double level)
{
    if (fabs(to - from) <= DBL_MAX) return (level - from) / (to - from);
    return (level / 2 - from / 2) / (to / 2 - from / 2); /* the difference overflows, that of the halves does not */
}

/* The share of a triangle that lies below the level. */
static inline double mesh__share_below(const double f[3], double level)
{
    int below = (f[0] < level) + (f[1] < level) + (f[2] < level), k = 0;
    double share;
    if (below == 0 || below == 3) return below == 3;
    while (k < 2 && (f[k] < level) != (below == 1)) ++k; /* the one corner that is on its side alone */
    share = mesh__fraction(f[k], f[(k + 1) % 3], level) * mesh__fraction(f[k], f[(k + 2) % 3], level);
    return below == 1 ? share : 1 - share;
}

/* A level set under construction. */
typedef struct mesh__trace {
    const mesh *m;
    const double *field;
    double level;
    int how;
    int is_above; /* which side is on the left: above only to close curves, for else loops are turned round */
    contour_trace loops;
    contour_parts parts; /* with CONTOUR_PARTS, of half-edges: the corners of triangles that they leave */
    unsigned char
        *seen; /* each triangle: 1 if a curve has passed it; 2 << k if its side k, at the boundary, has been */
    mesh_error *error;
} mesh__trace;

/* Is the vertex that a half-edge leaves on the side that curves have on their left? */
static inline int mesh__is_inside(const mesh__trace *trace, size_t h)
{
    return (trace->field[trace->m->triangle[h]] < trace->level) != trace->is_above;
}

/* Appends the point where the level crosses a half-edge. */
static inline int mesh__add_cut(mesh__trace *trace, size_t h)
{
    const mesh *m = trace->m;
    size_t from = m->triangle[h], to = m->triangle[mesh__next(h)];
    double t = mesh__fraction(trace->field[from], trace->field[to], trace->level);
    double s = 1 - t, x[3], n[3], length;
    int c;
    for (c = 0; c < 3; ++c) {
        x[c] = s * m->vertex[3 * from + (size_t)c] + t * m->vertex[3 * to + (size_t)c];
        n[c] = s * m->normal[3 * from + (size_t)c] + t * m->normal[3 * to + (size_t)c];
    }
    length = mesh__length(n);
    if (!(length > 0))
        return mesh__fail(trace->error, MESH_NO_NORMAL, m->name, m->line ? m->line[h / 3] : 0,
                          "the normals at vertices %lu and %lu (from 0) are opposite", (unsigned long)from,
                          (unsigned long)to);
    for (c = 0; c < 3; ++c) n[c] /= length;
    return contour_add(&trace->loops, x, n) ? MESH_OK : mesh__no_memory(trace->error, m->name);
}

static inline int mesh__add_end(mesh__trace *trace, size_t h)
{
    const mesh *m = trace->m;
    const size_t v = m->triangle[h];
    return contour_add(&trace->loops, m->vertex + 3 * v, m->normal + 3 * v) ? MESH_OK
                                                                            : mesh__no_memory(trace->error, m->name);
}

/* The half-edge of triangle t that leads from inside to outside, or MESH_NONE. There a curve with the inside on its
   left comes in; it leaves where a half-edge leads back inside. */
static inline uint32_t mesh__entry(const mesh__trace *trace, size_t t)
{
    size_t h;
    for (h = 3 * t; h < 3 * t + 3; ++h)
        if (mesh__is_inside(trace, h) && !mesh__is_inside(trace, mesh__next(h))) return (uint32_t)h;
    return MESH_NONE;
}

static inline size_t mesh__exit(const mesh__trace *trace, size_t entry)
{
    size_t h = mesh__next(entry);
    return mesh__is_inside(trace, mesh__next(h)) ? h : mesh__next(h);
}

/* Passes a half-edge at the boundary: returns the next one there, on the same sheet if several meet in a vertex. */
static inline size_t mesh__along(mesh__trace *trace, size_t h)
{
    const uint32_t *twin = trace->m->twin;
    trace->seen[h / 3] |= (unsigned char)(2 << h % 3);
    h = mesh__next(h);
    while (twin[h] != MESH_NONE) h = mesh__next(twin[h]);
    return h;
}

/* The curve at hand runs between these two. */
static inline int mesh__between(mesh__trace *trace, size_t left, size_t right)
{
    int is_turned = trace->is_above != (trace->how & CONTOUR_ABOVE);
    const uint32_t *part = trace->parts.part;
    return contour_between(&trace->loops, part[is_turned ? right : left], part[is_turned ? left : right])
               ? MESH_OK
               : mesh__no_memory(trace->error, trace->m->name);
}

/* Follows the curve that comes in at a half-edge until it closes or leaves the mesh; there it goes on along the
   boundary, if curves are to be closed, to where the next one comes in. */
static inline int mesh__follow(mesh__trace *trace, size_t begin)
{
    const mesh *m = trace->m;
    size_t h = begin;
    int status = MESH_OK;
    do {
        size_t exit = mesh__exit(trace, h);
        status = mesh__add_cut(trace, h);
        trace->seen[h / 3] |= 1;
        if (!status && trace->parts.part) status = mesh__between(trace, h, mesh__next(h));
        h = m->twin[exit];
        if (status || h != MESH_NONE) continue;
        if (!(trace->how & CONTOUR_CLOSE)) return contour_leave_out(&trace->loops), MESH_OK;
        ++trace->loops.out->closed;
        status = mesh__add_cut(trace, exit);
        for (h = mesh__along(trace, exit); !status; h = mesh__along(trace, h)) {
            status = mesh__add_end(trace, h);
            if (!mesh__is_inside(trace, mesh__next(h))) break;
        }
    } while (!status && h != begin);
    if (status) return status;
    return contour_close(&trace->loops) ? MESH_OK : mesh__no_memory(trace->error, m->name);
}

/* Follows a boundary that lies inside as a whole. */
static inline int mesh__follow_boundary(mesh__trace *trace, size_t begin)
{
    size_t h = begin;
    int status = MESH_OK;
    do {
        status = mesh__add_end(trace, h);
        h = mesh__along(trace, h);
    } while (!status && h != begin);
    if (!status && ((trace->parts.part && !contour_between(&trace->loops, trace->parts.part[h], CONTOUR_NONE)) ||
                    !contour_close(&trace->loops)))
        status = mesh__no_memory(trace->error, trace->m->name);
    return status;
}

/* All curves: those from the boundary first, then the rest closes. */
static inline int mesh__follow_all(mesh__trace *trace)
{
    const mesh *m = trace->m;
    size_t t, h;
    int status = MESH_OK;
    for (t = 0; !status && t < m->triangles; ++t) {
        const uint32_t entry = trace->seen[t] & 1 ? MESH_NONE : mesh__entry(trace, t);
        if (entry != MESH_NONE && m->twin[entry] == MESH_NONE) status = mesh__follow(trace, entry);
    }
    for (t = 0; !status && t < m->triangles; ++t) {
        const uint32_t entry = trace->seen[t] & 1 ? MESH_NONE : mesh__entry(trace, t);
        if (entry != MESH_NONE) status = mesh__follow(trace, entry);
    }
    for (h = 0; !status && (trace->how & CONTOUR_CLOSE) && h < 3 * m->triangles; ++h)
        if (m->twin[h] == MESH_NONE && !(trace->seen[h / 3] & 2 << h % 3) && mesh__is_inside(trace, h) &&
            mesh__is_inside(trace, mesh__next(h)))
            status = mesh__follow_boundary(trace, h);
    return status;
}

/* Corners of a triangle on the same side of the level are one part, and so are those of its neighbour at the same
   vertices. */
static inline int mesh__part(mesh__trace *trace)
{
    const mesh *m = trace->m;
    size_t h, next;
    if (!contour_parts_begin(&trace->parts, 3 * m->triangles)) return mesh__no_memory(trace->error, m->name);
    for (h = 0; h < 3 * m->triangles; ++h) {
        next = mesh__next(h);
        if (mesh__is_inside(trace, h) == mesh__is_inside(trace, next)) contour_unite(trace->parts.part, h, next);
        if (m->twin[h] < h) { /* which leaves the vertex that h leads to */
            contour_unite(trace->parts.part, h, mesh__next(m->twin[h]));
            contour_unite(trace->parts.part, next, m->twin[h]);
        }
    }
    return contour_number(&trace->parts) ? MESH_OK : mesh__no_memory(trace->error, m->name);
}

/* The area of the inside, and those of all parts. */
static inline void mesh__sum_areas(mesh__trace *trace)
{
    const mesh *m = trace->m;
    double sum[2] = {0, 0}, f[3], n[3], share, area;
    size_t t, h;
    for (t = 0; t < m->triangles; ++t) {
        for (h = 0; h < 3; ++h) f[h] = trace->field[m->triangle[3 * t + h]];
        share = mesh__share_below(f, trace->level);
        if (trace->how & CONTOUR_ABOVE) share = 1 - share;
        mesh__double_area(m, t, n);
        area = mesh__length(n) / 2;
        contour_sum(sum, area * share);
        for (h = 3 * t; trace->parts.part && h < 3 * t + 3; ++h) { /* of corners on one side only the last */
            if (h % 3 < 2 && mesh__is_inside(trace, h) == mesh__is_inside(trace, 3 * t + 2)) continue;
            if (h % 3 < 1 && mesh__is_inside(trace, h) == mesh__is_inside(trace, h + 1)) continue;
            trace->parts.area[trace->parts.part[h]] +=
                area *
                (mesh__is_inside(trace, h) == (trace->is_above == (trace->how & CONTOUR_ABOVE)) ? share : 1 - share);
        }
    }
    trace->loops.out->area = sum[0] + sum[1];
}

/* Cuts the mesh where the field, linear on each triangle, has the value level.
   m                  after mesh_connect and mesh_normals
   field  m->vertices one finite scalar per vertex
   how                MESH_BELOW or MESH_ABOVE: which part is on the left of the loops and has its area measured; plus
                      CONTOUR_CLOSE, plus CONTOUR_PARTS, as you like
   loops              out: one per component of the curve; those that were closed along the boundary come first, and
                      boundaries without a curve last. Corners on mesh edges, with the normals of both ends
                      interpolated. Neighbours are more than 1e-12 of the largest coordinate apart: below that an edge
                      of an outline is rounding noise, without a direction
   Errors: BAD_ARGUMENT, NOT_FINITE, NO_NORMAL, NO_MEMORY; loops is then empty. Cost: O(vertices + triangles). */
static inline int mesh_level_set(const mesh *m, const double *field, double level, int how, mesh_loops *loops,
                                 mesh_error *error)
{
    mesh__trace trace;
    double largest = 0;
    size_t v;
    int status = MESH_OK;
    memset(loops, 0, sizeof *loops);
    memset(&trace, 0, sizeof trace);
    if (!m->twin || !m->normal || (how & ~(CONTOUR_ABOVE | CONTOUR_CLOSE | CONTOUR_PARTS)))
        return mesh__fail(error, MESH_BAD_ARGUMENT, m->name, 0, "a level set needs mesh_connect and mesh_normals");
    for (v = 0; v < m->vertices; ++v)
        if (!(fabs(field[v]) <= DBL_MAX))
            return mesh__fail(error, MESH_NOT_FINITE, m->name, 0, "the field at vertex %lu (from 0) is not finite",
                              (unsigned long)v);
    if (!(fabs(level) <= DBL_MAX)) return mesh__fail(error, MESH_NOT_FINITE, m->name, 0, "the level is not finite");
    for (v = 0; v < 3 * m->vertices; ++v) largest = fmax(largest, fabs(m->vertex[v]));
    trace.m = m;
    trace.field = field;
    trace.level = level;
    trace.how = how;
    trace.is_above = how & CONTOUR_CLOSE ? how & CONTOUR_ABOVE : 0;
    trace.error = error;
    trace.seen = (unsigned char *)calloc(m->triangles + 1, 1);
    if (!contour_trace_begin(&trace.loops, loops, 1e-12 * largest) || !trace.seen)
        status = mesh__no_memory(error, m->name);
    if (!status && (how & CONTOUR_PARTS)) status = mesh__part(&trace);
    if (!status) {
        mesh__sum_areas(&trace);
        status = mesh__follow_all(&trace);
    }
    for (v = 0; !status && trace.is_above != (how & CONTOUR_ABOVE) && v < loops->loops; ++v) contour_reverse(loops, v);
    if (!status && (how & CONTOUR_PARTS) && !contour_enclose(&trace.loops, &trace.parts))
        status = mesh__no_memory(error, m->name);
    free(trace.seen);
    contour_parts_free(&trace.parts);
    contour_trace_end(&trace.loops);
    if (status) mesh_free_loops(loops);
    return status;
}

/* --- refined spheres ---------------------------------------------------------------------------------------------- */

/* Splits every triangle of a closed mesh in four at the middles of its edges, which are moved out to the unit sphere.
   Connect and normals have to be done again after it. Errors: as mesh_connect, BAD_ARGUMENT (a boundary), TOO_LARGE. */
static inline int mesh_refine_sphere(mesh *m, mesh_error *error)
{
    mesh fine;
    size_t h, t;
    uint32_t *middle;
    int c, status = m->twin ? MESH_OK : mesh_connect(m, error);
    if (status) return status;
    if (m->boundary_edges) return mesh__fail(error, MESH_BAD_ARGUMENT, m->name, 0, "only closed meshes can be refined");
    memset(&fine, 0, sizeof fine);
    if (m->triangles > MESH_NONE / 12 - 1) return mesh__fail(error, MESH_TOO_LARGE, NULL, 0, "too many triangles");
    fine.vertices = m->vertices + m->edges;
    fine.triangles = 4 * m->triangles;
    fine.vertex = (double *)malloc(3 * fine.vertices * sizeof(double));
    fine.triangle = (uint32_t *)malloc(3 * fine.triangles * sizeof *fine.triangle);
    middle = (uint32_t *)malloc(3 * m->triangles * sizeof *middle);
    if (!fine.vertex || !fine.triangle || !middle) {
        free(middle);
        mesh_free(&fine);
        return mesh__no_memory(error, NULL);
    }
    memcpy(fine.vertex, m->vertex, 3 * m->vertices * sizeof(double));
    fine.vertices = m->vertices;
    for (h = 0; h < 3 * m->triangles; ++h) {
        const double *a = m->vertex + 3 * (size_t)m->triangle[h],
                     *b = m->vertex + 3 * (size_t)m->triangle[mesh__next(h)];
        double *x = fine.vertex + 3 * fine.vertices, length;
        middle[h] = m->twin[h] < h ? middle[m->twin[h]] : (uint32_t)fine.vertices;
        if (middle[h] != fine.vertices) continue;
        for (c = 0; c < 3; ++c) x[c] = a[c] + b[c];
        length = mesh__length(x);
        for (c = 0; c < 3; ++c) x[c] /= length;
        ++fine.vertices;
    }
    for (t = 0; t < m->triangles; ++t) {
        const uint32_t *v = m->triangle + 3 * t, *mid = middle + 3 * t;
        const uint32_t four[12] = {v[0],   mid[0], mid[2], mid[0], v[1],   mid[1],
                                   mid[2], mid[1], v[2],   mid[0], mid[1], mid[2]};
        memcpy(fine.triangle + 12 * t, four, sizeof four);
    }
    free(middle);
    mesh_free(m);
    *m = fine;
    return MESH_OK;
}

/* A triangulated unit sphere: a regular solid, refined `level` times.
   base               MESH_ICOSAHEDRON or MESH_OCTAHEDRON, with corners on the axes' planes or on the axes
   level              >= 0; base * 4^level triangles
   Errors: BAD_ARGUMENT, TOO_LARGE, NO_MEMORY. Cost: linear in the number of triangles. */
static inline int mesh_sphere(mesh *m, int base, int level, mesh_error *error)
{
    static const uint32_t twenty[60] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                        4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                        6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    static const uint32_t eight[24] = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    const double golden = (1 + sqrt(5.0)) / 2, length = sqrt(1 + golden * golden);
    int k, c, status = MESH_OK;
    memset(m, 0, sizeof *m);
    if ((base != MESH_ICOSAHEDRON && base != MESH_OCTAHEDRON) || level < 0)
        return mesh__fail(error, MESH_BAD_ARGUMENT, NULL, 0,
                          "a refined sphere starts from 20 or 8 triangles, at level 0");
    m->vertices = base == MESH_ICOSAHEDRON ? 12 : 6;
    m->triangles = (size_t)base;
    m->vertex = (double *)calloc(3 * m->vertices, sizeof(double));
    m->triangle = (uint32_t *)malloc(3 * m->triangles * sizeof *m->triangle);
    if (!m->vertex || !m->triangle)
        status = mesh__no_memory(error, NULL);
    else if (base == MESH_ICOSAHEDRON) {
        for (k = 0; k < 12; ++k) { /* three golden rectangles: (-+1, +-golden, 0) and its cyclic shifts */
            c = k / 4;
            m->vertex[3 * k + c] = (k % 2 ? 1 : -1) / length;
            m->vertex[3 * k + (c + 1) % 3] = (k % 4 < 2 ? golden : -golden) / length;
        }
        /* the shifts put the long side of the second rectangle along z, of the third along x */
        memcpy(m->triangle, twenty, sizeof twenty);
    } else {
        for (k = 0; k < 6; ++k) m->vertex[3 * k + k / 2] = k % 2 ? -1 : 1;
        memcpy(m->triangle, eight, sizeof eight);
    }
    for (k = 0; !status && k < level; ++k) status = mesh_refine_sphere(m, error);
    if (status) mesh_free(m);
    return status;
}

#endif
