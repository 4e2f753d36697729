/* Triangle meshes and level sets: examples/surfaces/mesh.h.
   cc -I. tests/test_mesh.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "examples/surfaces/mesh.h"

#include "chance.h"
#include "harness.h"
#include "shapes.h"
#include "table.h"

/* A file that holds the text, open for reading. */
static FILE *file_of(const char *text)
{
    FILE *file = tmpfile();
    if (!file || fputs(text, file) < 0) {
        puts("no temporary file can be made");
        exit(1);
    }
    rewind(file);
    return file;
}

static int read_text(mesh *m, const char *text, mesh_error *error)
{
    FILE *file = file_of(text);
    int status = mesh_read_stream(m, file, "body", NULL, error);
    fclose(file);
    return status;
}

/* Everything that a level set needs. Test meshes are sound, unless the test says otherwise. */
static void prepare(mesh *m)
{
    mesh_error error;
    if (mesh_connect(m, &error) || mesh_normals(m, &error)) {
        printf("a mesh of the tests is not sound: %s\n", error.text);
        exit(1);
    }
}

static void read_sound(mesh *m, const char *text)
{
    mesh_error error;
    if (read_text(m, text, &error)) {
        printf("a mesh of the tests is malformed: %s\n", error.text);
        exit(1);
    }
    prepare(m);
}

static void sphere(mesh *m, int base, int level)
{
    mesh_error error;
    if (mesh_sphere(m, base, level, &error)) {
        puts(error.text);
        exit(1);
    }
    prepare(m);
}

/* The square [-1, 1]^2 of the plane z = 0, cut into count x count squares and these into two triangles. */
static void square(mesh *m, size_t count)
{
    size_t side = count + 1, i, j;
    memset(m, 0, sizeof *m);
    m->vertex = (double *)malloc(3 * side * side * sizeof(double));
    m->triangle = (uint32_t *)malloc(6 * count * count * sizeof(uint32_t));
    if (!m->vertex || !m->triangle) exit(1);
    for (j = 0; j < side; ++j)
        for (i = 0; i < side; ++i) {
            double *x = m->vertex + 3 * m->vertices++;
            x[0] = 2 * (double)i / (double)count - 1;
            x[1] = 2 * (double)j / (double)count - 1;
            x[2] = 0;
        }
    for (j = 0; j < count; ++j)
        for (i = 0; i < count; ++i) {
            uint32_t a = (uint32_t)(j * side + i), b = a + 1, d = a + (uint32_t)side, c = d + 1;
            uint32_t *corner = m->triangle + 3 * m->triangles;
            corner[0] = a, corner[1] = b, corner[2] = c;
            corner[3] = a, corner[4] = c, corner[5] = d;
            m->triangles += 2;
        }
    prepare(m);
}

static double *field_of(const mesh *m, double (*f)(const double *x))
{
    double *field = (double *)malloc(m->vertices * sizeof *field);
    size_t v;
    if (!field) exit(1);
    for (v = 0; v < m->vertices; ++v) field[v] = f(m->vertex + 3 * v);
    return field;
}

static double x_of(const double *x)
{
    return x[0];
}

static double height(const double *x)
{
    return x[2];
}

static double depth(const double *x)
{
    return -x[2];
}

static double distance(const double *x)
{
    return hypot(x[0], x[1]);
}

static double quadrants(const double *x)
{
    return x[0] * x[1];
}

static double ring(const double *x)
{
    return fabs(hypot(x[0], x[1]) - 0.6);
}

static double outside_flower(const double *x)
{
    double theta = acos(x[2] / sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2])) - PI / 2,
           phi = atan2(x[1], x[0]) - PI / 4;
    return sqrt(theta * theta + phi * phi) - (0.5 - 0.1 * sin(4 * (atan2(phi, theta) + PI)));
}

/* The level set of a field that the tests know to be sound. */
static void cut(const mesh *m, const double *field, double level, int inside, mesh_loops *loops)
{
    mesh_error error;
    if (!mesh_level_set(m, field, level, inside, loops, &error)) return;
    printf("no level set: %s\n", error.text);
    exit(1);
}

static size_t corners_of(const mesh_loops *loops, size_t k)
{
    return loops->start[k + 1] - loops->start[k];
}

/* Length and turning of a loop, whichever way round it runs. */
static void functionals(const mesh_loops *loops, size_t k, double *length, double *turning)
{
    size_t n = corners_of(loops, k), i;
    double *l = (double *)malloc(2 * n * sizeof(double));
    if (!l) exit(1);
    *length = *turning = 0;
    CHECK_OK(surfmink_edges(IN_SPACE(loops->corner + 3 * loops->start[k], loops->normal + 3 * loops->start[k], n), l,
                            l + n, NULL));
    for (i = 0; i < n; ++i) *length += l[i], *turning += l[n + i];
    free(l);
}

static int measure(const mesh_loops *loops, size_t k, int max_rank, double *mu, double *g, surfmink_functionals *w)
{
    const double *corner = loops->corner + 3 * loops->start[k], *normal = loops->normal + 3 * loops->start[k];
    return surfmink_measure(IN_SPACE(corner, normal, corners_of(loops, k)), max_rank, mu, g, w, NULL);
}

static double apart(const double *x, const double *y)
{
    return sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) + (x[2] - y[2]) * (x[2] - y[2]));
}

static const double *corner_of(const mesh_loops *loops, size_t k, size_t i)
{
    return loops->corner + 3 * (loops->start[k] + i % corners_of(loops, k));
}

/* What every loop promises: three corners or more, no edge without length, no way there and back, unit normals. */
static void check_tidy(const mesh_loops *loops)
{
    size_t k, i;
    for (k = 0; k < loops->loops; ++k) {
        CHECK(corners_of(loops, k) >= 3);
        for (i = 0; i < corners_of(loops, k); ++i) {
            CHECK(apart(corner_of(loops, k, i), corner_of(loops, k, i + 1)) > 0);
            CHECK(apart(corner_of(loops, k, i), corner_of(loops, k, i + 2)) > 0);
        }
    }
    for (i = 0; i < loops->start[loops->loops]; ++i) {
        const double *n = loops->normal + 3 * i;
        CHECK_NEAR(n[0] * n[0] + n[1] * n[1] + n[2] * n[2], 1, 1e-15);
    }
}

/* --- reading ------------------------------------------------------------------------------------------------------ */

static const char octahedron_off[] =
    "OFF\n# the corners stand on the axes\n6 8 12\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n"
    "0 0 -1\n3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";

THEOREM(off_obj_and_ply_of_one_mesh_read_the_same)
{
    static const char *const same[] = {
        /* colours behind, counts behind the word, blank lines, tabs, CRLF, no newline at the end */
        "COFF 6 8 0\r\n1 0 0 255 0 0\r\n-1 0 0\r\n\r\n0\t1\t0\r\n0 -1 0\r\n0 0 1 # top\r\n0 0 -1\r\n3 0 2 4\r\n3 2 1 4 "
        "7\r\n"
        "3 1 3 4\r\n3 3 0 4\r\n3 2 0 5\r\n3 1 2 5\r\n3 3 1 5\r\n3 0 3 5",
        /* every way to write a corner, and lines of no interest */
        "# OBJ\nmtllib none.mtl\no body\nv 1 0 0\nv -1 0 0 1.0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\nvn 0 0 1\nvt 0 "
        "0\ns off\n"
        "f 1 3 5\nf 3/1 2/1 5/1\nf 2//1 4//1 5//1\nf 4/1/1 1/1/1 5/1/1\nf -4 -6 -1\nf 2 3 6\nf 4 2 6 # last but one\nf "
        "1 4 6\n",
        /* other properties and elements before, between and behind */
        "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 6\nproperty uchar red\nproperty float x\nproperty "
        "float y\n"
        "property float z\nproperty float quality\nelement material 1\nproperty list uchar int ids\nproperty float "
        "gloss\n"
        "element face 8\nproperty uchar group\nproperty list uchar int vertex_indices\nend_header\n"
        "9 1 0 0 .5\n9 -1 0 0 .5\n9 0 1 0 .5\n9 0 -1 0 .5\n9 0 0 1 .5\n9 0 0 -1 .5\n2 7 7 0.25\n"
        "1 3 0 2 4\n1 3 2 1 4\n1 3 1 3 4\n1 3 3 0 4\n1 3 2 0 5\n1 3 1 2 5\n1 3 3 1 5\n1 3 0 3 5\n",
        /* counts glued to the word; normals and colours; lone \\r */
        "STCNOFF6 8 12\r1 0 0 0 0 0\r-1 0 0\r0 1 0\r0 -1 0\r0 0 1\r0 0 -1\r3 0 2 4\r3 2 1 4\r3 1 3 4\r3 3 0 4\r"
        "3 2 0 5\r3 1 2 5\r3 3 1 5\r3 0 3 5",
        /* VTK: several points a line, faces across lines, cells of no interest, data behind */
        "# vtk DataFile Version 3.0\n\nASCII\nDATASET POLYDATA\nPOINTS 6 float\n1 0 0 -1 0 0 0 1 0\n0 -1 0 0 0 1 0 0 "
        "-1\nVERTICES 1 2\n1 0\nPOLYGONS 8 32\n3 0 2 4 3 2 1 4\n3 1\n3 4 3 3 0 4\n3 2 0 5 3 1 2 5 3 3 1 5\n3 0 3 5\n"
        "LINES 1 3\n2 0 1\nCELL_DATA 8\nSCALARS a int 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\nPOINT_DATA 6\n"
        "VECTORS v float\n0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0\nSCALARS h double\nLOOKUP_TABLE default\n1 2 3 4 5 6\n",
        /* as version 5 of the format has it, with strips of one triangle */
        "# vtk DataFile Version 5.1\nvtk output\nASCII\nDATASET POLYDATA\nPOINTS 6 double\n1 0 0 -1 0 0 0 1 0 0 -1 0 0 "
        "0 1 0 0 -1\nMETADATA\nINFORMATION 1\nNAME a LOCATION b\nDATA 2 0 1\n\nPOLYGONS 9 24\nOFFSETS vtktypeint64\n0 "
        "3 "
        "6 9 12 15 18 21 24\nCONNECTIVITY vtktypeint64\n0 2 4 2 1 4 1 3 4 3 0 4\n2 0 5 1 2 5 3 1 5 0 3 5\nPOINT_DATA "
        "6\nFIELD FieldData 1\nh 1 6 double\n1 2 3 4 5 6\nMETADATA\nINFORMATION 0\n\n",
        "# vtk DataFile Version 2.0\nstrips\nASCII\nDATASET POLYDATA\nPOINTS 6 double\n1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 "
        "0 "
        "0 -1\nTRIANGLE_STRIPS 8 32\n3 0 2 4 3 2 1 4 3 1 3 4 3 3 0 4 3 2 0 5 3 1 2 5 3 3 1 5 3 0 3 5\n"};
    static const unsigned long first_line[] = {9, 13, 24, 8, 11, 16, 8}; /* of a face */
    mesh m, other;
    mesh_error error;
    size_t k;
    CHECK_EQUAL(read_text(&m, octahedron_off, &error), MESH_OK);
    CHECK_EQUAL(m.vertices, 6);
    CHECK_EQUAL(m.triangles, 8);
    for (k = 0; k < sizeof same / sizeof *same; ++k) {
        CASE("variant %d", (int)k);
        CHECK_EQUAL(read_text(&other, same[k], &error), MESH_OK);
        CHECK_EQUAL(other.vertices, 6);
        CHECK_EQUAL(other.triangles, 8);
        if (other.vertices != 6 || other.triangles != 8) continue;
        CHECK_SAME(other.vertex, m.vertex, 18);
        CHECK(memcmp(other.triangle, m.triangle, 24 * sizeof(uint32_t)) == 0);
        CHECK_EQUAL(other.line[0], first_line[k]);
        mesh_free(&other);
    }
    mesh_free(&m);
}

THEOREM(what_is_wrong_with_a_mesh_file_is_said_with_file_and_line)
{
    static const struct {
        const char *text;
        int status;
        const char *said;
    } wrong[] = {
        {"", MESH_MALFORMED, "body: the file is empty"},
        {"# nothing\n\n", MESH_MALFORMED, "body:2: the file is empty"},
        {"solid stl\n", MESH_MALFORMED, "body:1: expected a mesh: OFF, OBJ, PLY, STL or legacy VTK, got 'solid stl'"},
        {"4OFF\n1 1 0\n", MESH_MALFORMED, "body:1: expected a mesh: OFF, OBJ, PLY, STL or legacy VTK, got '4OFF'"},
        {"OFF BINARY\n", MESH_MALFORMED, "body:1: binary OFF"},
        {"OFF\n", MESH_MALFORMED, "body:1: the file ends after 0 of 2 counts"},
        {"OFF\n3\n", MESH_MALFORMED, "body:2: expected the numbers of vertices and faces, the line ends"},
        {"OFF\n3 -1 0\n", MESH_MALFORMED, "body:2: expected the numbers of vertices and faces"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n", MESH_MALFORMED, "body:4: the file ends after 2 of 3 vertices"},
        {"OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", MESH_MALFORMED, "body:6: the file ends after 1 of 2 faces"},
        {"OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", MESH_MALFORMED, "body:4: expected a number z, the line ends"},
        {"OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", MESH_MALFORMED, "body:4: expected finite numbers x y z"},
        {"OFF\n3 1 0\n0 0 0\n1e999 0 0\n0 1 0\n3 0 1 2\n", MESH_MALFORMED, "body:4: expected finite numbers x y z"},
        {"OFF\n3 1 0\n0 0 0\n1,0 0 0\n0 1 0\n3 0 1 2\n", MESH_MALFORMED, "body:4: expected a number x, got '1,0 0 0'"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", MESH_MALFORMED, "body:6: 3 corners are announced, 2 follow"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2.5\n", MESH_MALFORMED,
         "body:6: expected the number of a vertex, got '2.5'"},
        {"OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1\n", MESH_NOT_TRIANGLES, "body:7: a face of 2 corners"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", MESH_BAD_INDEX, "body:6: there is no vertex 3"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", MESH_BAD_INDEX, "body:6: there is no vertex -1"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n\n3 0 1 1\n", MESH_BAD_INDEX, "body:7: a face has vertex 1 twice"},
        {"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n", MESH_MALFORMED, "body:7: expected the end of the file"},
        {"OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", MESH_MALFORMED, "body: there are no faces in it"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", MESH_BAD_INDEX, "body:4: OBJ counts vertices from 1"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", MESH_BAD_INDEX,
         "body:4: there is no vertex 3, counted from 0: there are 3"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", MESH_BAD_INDEX, "body:4: there is no vertex -1"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", MESH_NOT_TRIANGLES, "body:4: a face of 2 corners"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4\nf 4 2 1\n", MESH_NOT_MANIFOLD,
         "body:6: face 1 has the same corners as face 0 (from 0): not a surface; drop one of them"},
        {"v 0 0 0\nv 1 0 0\nv 0 x 0\nf 1 2 3\n", MESH_MALFORMED, "body:3: expected a number y, got 'x 0'"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 c\n", MESH_MALFORMED, "body:4: expected the number of a vertex, got 'c'"},
        {"ply\nformat binary 1.0\n", MESH_MALFORMED,
         "body:2: expected ascii, binary_little_endian or binary_big_endian, got 'binary 1.0'"},
        {"ply\nend_header\n", MESH_MALFORMED, "body:2: the header has no line 'format ascii 1.0'"},
        {"ply\nformat ascii 1.0\n", MESH_MALFORMED, "body:2: the file ends before end_header"},
        {"ply\nformat ascii 1.0\nproperty float x\n", MESH_MALFORMED, "body:3: expected an element first"},
        {"ply\nformat ascii 1.0\nelement vertex many\n", MESH_MALFORMED,
         "body:3: expected a number of elements, got 'many'"},
        {"ply\nformat ascii 1.0\nfoo\n", MESH_MALFORMED, "body:3: expected a line of a PLY header, got 'foo'"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
         MESH_MALFORMED, "body:6: the vertices have no x, y, z"},
        {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int colours\nend_header\n0\n", MESH_MALFORMED,
         "body:5: the faces have no list vertex_indices"},
        {"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 "
         "0 0\n",
         MESH_MALFORMED, "body:8: the file ends after 1 of 2 vertices"},
        {"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 "
         "0 0 0\n",
         MESH_MALFORMED, "body:8: expected no more numbers than properties, got '0'"},
        {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nend_header\n2 0 0\n",
         MESH_BAD_INDEX, "body:6: there is no vertex 0"},
        {"ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_index\nend_header\n3 0 1 2\n",
         MESH_BAD_INDEX, "body:6: there is no vertex 0, counted from 0: there are 0"},
        {"ply\nformat ascii 1.0\nelement odd 1\nproperty list uchar int a\nend_header\n2 1\n", MESH_MALFORMED,
         "body:6: expected a number for each property, the line ends"}};
    mesh m;
    mesh_error error;
    size_t k;
    for (k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        CASE("%s", wrong[k].said);
        CHECK_EQUAL(read_text(&m, wrong[k].text, &error), wrong[k].status);
        CHECK_EQUAL(error.status, wrong[k].status);
        CHECK(strncmp(error.text, wrong[k].said, strlen(wrong[k].said)) == 0);
        if (strncmp(error.text, wrong[k].said, strlen(wrong[k].said)) != 0) NOTE("  it says: %s", error.text);
        CHECK(!m.vertex && !m.triangle && !m.line && !m.name && m.vertices == 0 && m.triangles == 0);
        mesh_free(&m);
    }
    CASE("a file that is not there");
    CHECK_EQUAL(mesh_read(&m, "tests/data/no such mesh.off", NULL, &error), MESH_UNREADABLE);
    CHECK(strcmp(error.text, "tests/data/no such mesh.off: cannot be opened") == 0);
    CHECK_EQUAL(mesh_read(&m, "tests/data/no such mesh.off", NULL, NULL), MESH_UNREADABLE);
}

THEOREM(a_binary_file_is_called_that)
{
    static const char bytes[] = "OFF\n3 1 0\n0\0\0\n";
    FILE *file = tmpfile();
    mesh m;
    mesh_error error;
    if (!file || fwrite(bytes, 1, sizeof bytes, file) != sizeof bytes) exit(1);
    rewind(file);
    CHECK_EQUAL(mesh_read_stream(&m, file, "body", NULL, &error), MESH_MALFORMED);
    CHECK(strcmp(error.text, "body:3: a zero byte: not a text file") == 0);
    fclose(file);
}

THEOREM(what_is_wrong_with_a_field_file_is_said_with_file_and_line)
{
    static const struct {
        const char *text, *said;
    } wrong[] = {{"1\n2\n3\n4\n5\n", "field:5: the file ends after 5 values: the mesh has 6 vertices"},
                 {"1\n2\n3\n4\n5\n6\n# more\n7\n", "field:8: a value too many: the mesh has 6 vertices"},
                 {"1\n2\n\nthree\n4\n5\n6\n", "field:4: expected one finite number a line, got 'three'"},
                 {"1\n2\nnan\n4\n5\n6\n", "field:3: expected one finite number a line, got 'nan'"},
                 {"1\n2\n-inf\n4\n5\n6\n", "field:3: expected one finite number a line, got '-inf'"},
                 {"1\n2 3\n4\n5\n6\n", "field:2: expected one finite number a line, got '2 3'"},
                 {"", "field: the file ends after 0 values: the mesh has 6 vertices"}};
    static const double want[6] = {1, -2.5, 3e-300, 4, 5, 6};
    mesh m;
    mesh_error error;
    double *field = NULL;
    FILE *file = file_of("# a field\n1\n\n-2.5 # note\r\n\t3e-300\n4\n5\n6");
    size_t k;
    read_sound(&m, octahedron_off);
    CHECK_EQUAL(mesh_read_field_stream(&m, file, "field", &field, NULL, &error), MESH_OK);
    fclose(file);
    CHECK_SAME(field, want, 6);
    free(field);
    for (k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        CASE("%s", wrong[k].said);
        file = file_of(wrong[k].text);
        CHECK_EQUAL(mesh_read_field_stream(&m, file, "field", &field, NULL, &error), MESH_MALFORMED);
        fclose(file);
        CHECK(strcmp(error.text, wrong[k].said) == 0);
        CHECK(field == NULL);
    }
    CASE("a file that is not there");
    CHECK_EQUAL(mesh_read_field(&m, "tests/data/no such field.txt", &field, NULL, &error), MESH_UNREADABLE);
    mesh_free(&m);
}

/* --- connecting --------------------------------------------------------------------------------------------------- */

/* Euler: vertices - edges + triangles = 2 on every closed surface without handles. */
THEOREM(refined_spheres_are_closed_oriented_and_obey_euler)
{
    static const int base[2] = {MESH_ICOSAHEDRON, MESH_OCTAHEDRON};
    static const double origin[3] = {0, 0, 0};
    mesh m;
    mesh_error error;
    size_t v, k;
    int b, level;
    for (b = 0; b < 2; ++b)
        for (level = 0; level < 5; ++level) {
            CASE("%d triangles refined %d times", base[b], level);
            sphere(&m, base[b], level);
            CHECK_EQUAL(m.triangles, base[b] << 2 * level);
            CHECK_EQUAL((long)m.vertices - (long)m.edges + (long)m.triangles, 2);
            CHECK_EQUAL(m.boundary_edges, 0);
            CHECK_EQUAL(m.pinched, 0);
            for (v = 0; v < m.vertices; ++v) CHECK_NEAR(apart(m.vertex + 3 * v, origin), 1, 3e-16);
            for (k = 0; k < 3 * m.triangles; ++k) CHECK_EQUAL(m.twin[m.twin[k]], k);
            CHECK(mesh_volume(&m) > 0);
            CHECK_NEAR(mesh_volume(&m), 4 * PI / 3, 2.5 * mesh_longest_edge(&m) * mesh_longest_edge(&m));
            mesh_free(&m);
        }
    CHECK_EQUAL(mesh_sphere(&m, 12, 0, &error), MESH_BAD_ARGUMENT);
    CHECK_EQUAL(mesh_sphere(&m, MESH_OCTAHEDRON, -1, &error), MESH_BAD_ARGUMENT);
}

THEOREM(a_mesh_that_is_no_oriented_surface_is_refused_by_name)
{
    mesh m;
    mesh_error error;
    uint32_t swap;
    CASE("a triangle of the octahedron is turned round by hand");
    CHECK_EQUAL(read_text(&m, octahedron_off, &error), MESH_OK);
    swap = m.triangle[4], m.triangle[4] = m.triangle[5], m.triangle[5] = swap;
    CHECK_EQUAL(mesh_connect(&m, &error), MESH_NOT_ORIENTED);
    CHECK(strcmp(error.text,
                 "body:15: the triangles at the edge between vertices 1 and 2 (from 0) run opposite ways") == 0);
    CHECK(m.twin == NULL);
    swap = m.triangle[4], m.triangle[4] = m.triangle[5], m.triangle[5] = swap;
    CASE("it shares an edge with two others");
    m.triangle[3] = 0, m.triangle[4] = 4, m.triangle[5] = 1;
    CHECK_EQUAL(mesh_connect(&m, &error), MESH_NOT_MANIFOLD);
    mesh_free(&m);
    CASE("a book of three leaves");
    CHECK_EQUAL(read_text(&m, "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n-1 0 0\n3 0 1 2\n3 1 0 3\n3 0 1 4\n", &error),
                MESH_NOT_MANIFOLD);
    CHECK(strcmp(error.text, "body:10: the edge between vertices 0 and 1 (from 0) has 3 faces: not a surface") == 0);
    CASE("a Moebius strip of five triangles");
    CHECK_EQUAL(
        read_text(&m, "OFF\n5 5 0\n0 0 0\n1 0 0\n2 1 0\n1 2 1\n0 1 0\n3 0 1 2\n3 1 3 2\n3 2 3 4\n3 3 0 4\n3 4 0 1\n",
                  &error),
        MESH_NOT_ORIENTED);
    CHECK(strstr(error.text, " run opposite ways, and so do others if one of them is turned") != NULL);
    CASE("a triangle with two sides");
    CHECK_EQUAL(read_text(&m, "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n", &error), MESH_NOT_MANIFOLD);
    CHECK(strncmp(error.text, "body:7: face 1 has the same corners as face 0", 45) == 0);
    CASE("a triangle without area");
    CHECK_EQUAL(read_text(&m, "OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", &error), MESH_OK);
    CHECK_EQUAL(mesh_connect(&m, &error), MESH_OK);
    CHECK_EQUAL(mesh_normals(&m, &error), MESH_NO_NORMAL);
    CHECK(strcmp(error.text, "body:6: vertex 0 (from 0) has no normal: its triangles have no area, or cancel") == 0);
    CHECK(m.normal == NULL);
    mesh_free(&m);
}

/* The octahedron with any of its triangles turned round, up to half of them: turned back, or all the others are. */
THEOREM(faces_that_run_against_their_neighbours_are_turned_round)
{
    static const int corner[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    static const char vertices[] = "OFF\n6 8 0\n1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n";
    mesh m;
    mesh_error error;
    int which, k;
    for (which = 0; which < 256; ++which) {
        char text[400];
        size_t used = sizeof vertices - 1, turned = 0;
        memcpy(text, vertices, sizeof vertices);
        for (k = 0; k < 8; ++k) {
            int turn = which >> k & 1;
            turned += (size_t)turn;
            used += (size_t)snprintf(text + used, sizeof text - used, "3 %d %d %d\n", corner[k][0], corner[k][1 + turn],
                                     corner[k][2 - turn]);
        }
        CASE("faces %d", which);
        CHECK_EQUAL(read_text(&m, text, &error), MESH_OK);
        CHECK_EQUAL(m.turned, turned <= 4 ? (turned == 4 && which & 1 ? 4 : turned) : 8 - turned);
        CHECK_EQUAL(mesh_connect(&m, &error), MESH_OK);
        CHECK_NEAR(fabs(mesh_volume(&m)), 4 / 3.0, 1e-14);
        if (which == 4) CHECK_EQUAL(m.first_turned, 11);
        mesh_free(&m);
    }
}

/* Triangles with corners of their own, as STL has them, a little off each other: 1e-7 is joined, 1e-3 is not. Two
   octahedra that touch along an edge have copies there, too, but no boundary: they stay two. */
THEOREM(copies_of_vertices_at_the_boundary_are_joined)
{
    mesh m, soup, two;
    mesh_error error;
    double off;
    size_t t, k, c;
    read_sound(&m, octahedron_off);
    for (off = 1e-7; off < 1; off *= 1e4) {
        char text[4000];
        size_t used = (size_t)snprintf(text, sizeof text, "OFF\n24 8 0\n");
        for (t = 0; t < 24; ++t, used += strlen(text + used)) {
            const double *x = m.vertex + 3 * (size_t)m.triangle[t];
            snprintf(text + used, sizeof text - used, "%.17g %.17g %.17g\n", x[0], x[1], x[2] + off * (double)(t % 2));
        }
        for (t = 0; t < 8; ++t, used += strlen(text + used))
            snprintf(text + used, sizeof text - used, "3 %d %d %d\n", (int)(3 * t), (int)(3 * t + 1), (int)(3 * t + 2));
        CASE("off by %g", off);
        CHECK_EQUAL(read_text(&soup, text, &error), MESH_OK);
        CHECK_EQUAL(mesh_connect(&soup, &error), MESH_OK);
        CHECK_EQUAL(soup.boundary_edges == 0, off < 1e-4);
        if (off < 1e-4) CHECK_EQUAL(soup.joined, 18);
        mesh_free(&soup);
    }
    CASE("two octahedra");
    {
        char text[1000] = "OFF\n12 16 0\n";
        size_t used = strlen(text);
        for (k = 0; k < 2; ++k)
            for (t = 0; t < 6; ++t, used += strlen(text + used)) /* the second one mirrored at the middle of an edge */
                snprintf(text + used, sizeof text - used, "%g %g %g\n", k ? 1 - m.vertex[3 * t] : m.vertex[3 * t],
                         k ? 1 - m.vertex[3 * t + 1] : m.vertex[3 * t + 1], m.vertex[3 * t + 2]);
        for (k = 0; k < 2; ++k)
            for (t = 0; t < 8; ++t, used += strlen(text + used)) {
                uint32_t v[3];
                for (c = 0; c < 3; ++c) v[c] = m.triangle[3 * t + c] + (uint32_t)(6 * k);
                snprintf(text + used, sizeof text - used, "3 %u %u %u\n", (unsigned)v[0], (unsigned)v[1],
                         (unsigned)v[2]);
            }
        CHECK_EQUAL(read_text(&two, text, &error), MESH_OK);
        CHECK_EQUAL(two.joined, 0);
        CHECK_EQUAL(mesh_connect(&two, &error), MESH_OK);
        CHECK_NEAR(mesh_volume(&two), 8 / 3.0, 1e-14);
        mesh_free(&two);
    }
    mesh_free(&m);
}

/* Polygons of the plane: whatever their triangles are, they have the area of the polygon, and none runs backwards. */
THEOREM(polygons_are_split_into_triangles_that_fill_them)
{
    static const struct {
        const char *text;
        double area;
        size_t triangles;
    } polygon[] = {
        {"OFF\n4 1\n0 0 0\n2 0 0\n2 1 0\n0 1 0\n4 0 1 2 3\n", 2, 2},
        {"OFF\n4 1\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n4 0 1 2 3\n", 4, 2}, /* a dart: one diagonal lies outside */
        {"OFF\n4 1\n4 0 0\n1 1 0\n0 4 0\n0 0 0\n4 0 1 2 3\n", 4, 2}, /* the same from another corner */
        {"OFF\n10 1\n0 0 0\n5 0 0\n5 4 0\n4 4 0\n4 1 0\n3 1 0\n3 4 0\n1 4 0\n1 1 0\n0 1 0\n10 0 1 2 3 4 5 6 7 8 9\n",
         14, 8},
        {"OFF\n6 1\n0 0 7\n2 0 7\n2 2 7\n1 2 7\n1 1 7\n0 1 7\n6 5 4 3 2 1 0\n", 3, 4}}; /* an L, seen from below */
    mesh m;
    mesh_error error;
    size_t k, t;
    double n[3], sign;
    for (k = 0; k < sizeof polygon / sizeof *polygon; ++k) {
        CASE("polygon %d", (int)k);
        CHECK_EQUAL(read_text(&m, polygon[k].text, &error), MESH_OK);
        CHECK_EQUAL(m.triangles, polygon[k].triangles);
        CHECK_NEAR(mesh_area(&m), polygon[k].area, 1e-14);
        sign = k == 4 ? -1 : 1;
        for (t = 0; t < m.triangles; ++t) {
            mesh__double_area(&m, t, n);
            CHECK(sign * n[2] > 0);
        }
        CHECK_EQUAL(mesh_connect(&m, &error), MESH_OK);
        CHECK_EQUAL(m.boundary_edges, polygon[k].triangles + 2);
        mesh_free(&m);
    }
}

THEOREM(sheets_that_touch_in_a_vertex_are_counted)
{
    mesh m;
    CASE("two tetrahedra of different size, tip to tip");
    read_sound(
        &m, "OFF\n7 8 0\n0 0 0\n1 0 1\n-1 1 1\n-1 -1 1\n2 0 -2\n-2 2 -2\n-2 -2 -2\n3 0 2 1\n3 0 3 2\n3 0 1 3\n3 1 2 3\n"
            "3 0 4 5\n3 0 5 6\n3 0 6 4\n3 4 6 5\n");
    CHECK_EQUAL(m.pinched, 1);
    CHECK_EQUAL(m.boundary_edges, 0);
    mesh_free(&m);
    CASE("a bow tie, with boundaries");
    read_sound(&m, "OFF\n5 2 0\n0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n3 0 1 2\n3 0 3 4\n");
    CHECK_EQUAL(m.pinched, 1);
    CHECK_EQUAL(m.boundary_edges, 6);
    mesh_free(&m);
    CASE("a square");
    square(&m, 4);
    CHECK_EQUAL(m.pinched, 0);
    CHECK_EQUAL(m.boundary_edges, 16);
    CHECK_EQUAL(m.edges, 16 + (3 * 32 - 16) / 2);
    mesh_free(&m);
}

THEOREM(a_flipped_mesh_is_inside_out)
{
    mesh m;
    double volume;
    size_t v;
    sphere(&m, MESH_ICOSAHEDRON, 2);
    volume = mesh_volume(&m);
    mesh_flip(&m);
    CHECK(!m.twin && m.normal);
    prepare(&m);
    CHECK_NEAR(mesh_volume(&m), -volume, 1e-15);
    for (v = 0; v < m.vertices; ++v)
        CHECK(m.vertex[3 * v] * m.normal[3 * v] + m.vertex[3 * v + 1] * m.normal[3 * v + 1] +
                  m.vertex[3 * v + 2] * m.normal[3 * v + 2] <
              -0.99);
    mesh_free(&m);
}

/* --- normals ------------------------------------------------------------------------------------------------------ */

THEOREM(a_vertex_normal_is_the_mean_weighted_by_area)
{
    /* A fold along the y axis: area 1/2 upwards on the left, area 3/2 to the side on the right. */
    mesh m;
    read_sound(&m, "OFF\n5 2 0\n0 0 0\n0 1 0\n-1 0 0\n0 0 -3\n9 9 9\n3 0 1 2\n3 1 0 3\n");
    CHECK_NEAR(m.normal[0], 3 / sqrt(10.0), 1e-15);
    CHECK_NEAR(m.normal[1], 0, 0);
    CHECK_NEAR(m.normal[2], 1 / sqrt(10.0), 1e-15);
    CHECK_NEAR(m.normal[3 * 2 + 2], 1, 0); /* a corner of one triangle only has its normal */
    CHECK_NEAR(m.normal[3 * 3], 1, 0);
    CHECK_NEAR(m.normal[3 * 4], 0, 0); /* a vertex without triangles is no error, and has none */
    mesh_free(&m);
}

/* Across an edge of the coarsest mesh the triangles on both sides differ: order 1 there, 2 in the mean. */
THEOREM(normals_of_a_refined_sphere_are_of_second_order)
{
    double worst[8], mean[8];
    int level;
    for (level = 0; level < 8; ++level) {
        mesh m;
        size_t v;
        worst[level] = mean[level] = 0;
        sphere(&m, MESH_OCTAHEDRON, level);
        for (v = 0; v < m.vertices; ++v) {
            double off = apart(m.vertex + 3 * v, m.normal + 3 * v);
            worst[level] = fmax(worst[level], off);
            mean[level] += off / (double)m.vertices;
        }
        mesh_free(&m);
    }
    CHECK_NEAR(worst[0], 0, 1e-15);
    CHECK_NEAR(log2(worst[6] / worst[7]), 1, 0.1);
    CHECK_NEAR(log2(mean[6] / mean[7]), 2, 0.1);
}

/* --- areas -------------------------------------------------------------------------------------------------------- */

THEOREM(areas_are_exact_on_flat_triangles)
{
    mesh m;
    mesh_loops loops;
    double field[3] = {0, 1, 2}, *linear, level;
    read_sound(&m, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    cut(&m, field, 0.5, MESH_BELOW, &loops); /* a corner is below: 1/2 of one side, 1/4 of the other */
    CHECK_NEAR(loops.area, 0.5 * 0.125, 1e-16);
    mesh_free_loops(&loops);
    cut(&m, field, 1.5, MESH_BELOW, &loops); /* a corner is above */
    CHECK_NEAR(loops.area, 0.5 * (1 - 0.125), 1e-16);
    mesh_free_loops(&loops);
    cut(&m, field, 1.5, MESH_ABOVE, &loops);
    CHECK_NEAR(loops.area, 0.5 * 0.125, 1e-16);
    mesh_free_loops(&loops);
    mesh_free(&m);

    square(&m, 7);
    linear = field_of(&m, x_of);
    for (level = -1.25; level < 1.3; level += 0.0625) {
        CASE("level %g", level);
        cut(&m, linear, level, MESH_BELOW, &loops);
        CHECK_NEAR(loops.area, 2 * (fmin(fmax(level, -1), 1) + 1), 3e-15);
        mesh_free_loops(&loops);
    }
    free(linear);
    mesh_free(&m);
}

/* A cap of the unit sphere above height c: area 2 pi (1 - c), L = 2 pi sqrt(1 - c^2), S = 2 pi c. */
THEOREM(caps_of_refined_spheres_converge_with_order_two)
{
    static const char *const name[3] = {"area", "length", "turning"};
    static const double c[2] = {0.3, 0.55};
    double off[2][3][8];
    int k, q, level;
    for (level = 4; level < 8; ++level) {
        mesh m;
        double *field;
        sphere(&m, MESH_OCTAHEDRON, level);
        field = field_of(&m, depth);
        for (k = 0; k < 2; ++k) {
            mesh_loops loops;
            double length, turning;
            cut(&m, field, -c[k], MESH_BELOW, &loops);
            CHECK_EQUAL(loops.loops, 1);
            CHECK_EQUAL(loops.open + loops.collapsed, 0);
            functionals(&loops, 0, &length, &turning);
            off[k][0][level] = fabs(loops.area - 2 * PI * (1 - c[k]));
            off[k][1][level] = fabs(length - 2 * PI * sqrt(1 - c[k] * c[k]));
            off[k][2][level] = fabs(turning - 2 * PI * c[k]);
            mesh_free_loops(&loops);
        }
        free(field);
        mesh_free(&m);
    }
    for (k = 0; k < 2; ++k)
        for (q = 0; q < 3; ++q) {
            CASE("%s of the cap above %g", name[q], c[k]);
            CHECK(off[k][q][7] < 1e-3);
            CHECK_NEAR(log2(off[k][q][4] / off[k][q][7]) / 3, 2, 0.2);
        }
}

/* --- loops -------------------------------------------------------------------------------------------------------- */

THEOREM(the_inside_is_on_the_left)
{
    mesh m;
    mesh_loops below, above;
    double *field, length, turning;
    size_t i, n;
    square(&m, 20);
    field = field_of(&m, distance);
    cut(&m, field, 0.7, MESH_BELOW, &below);
    cut(&m, field, 0.7, MESH_ABOVE, &above);
    CHECK_EQUAL(below.loops, 1);
    CHECK_EQUAL(above.loops, 1);
    functionals(&below, 0, &length, &turning);
    CHECK_NEAR(turning, 2 * PI, 1e-13);
    CHECK_NEAR(length, 2 * PI * 0.7, 0.02);
    functionals(&above, 0, &length, &turning);
    CHECK_NEAR(turning, -2 * PI, 1e-13);
    CHECK_NEAR(below.area, PI * 0.49, 0.02);
    CHECK_NEAR(below.area + above.area, 4, 1e-14);
    CHECK_NEAR(mesh_area(&m), 4, 1e-14);
    n = corners_of(&below, 0);
    CHECK_EQUAL(corners_of(&above, 0), n);
    for (i = 0; i < n; ++i) CHECK_NEAR(apart(corner_of(&below, 0, i), corner_of(&above, 0, n - 1 - i)), 0, 0);
    mesh_free_loops(&below);
    mesh_free_loops(&above);
    free(field);
    mesh_free(&m);
}

THEOREM(a_hole_has_a_loop_of_its_own_that_runs_the_other_way)
{
    mesh m;
    mesh_loops loops;
    double *field, length[2], turning[2], mu[3];
    int outer, hole;
    square(&m, 40);
    field = field_of(&m, ring);
    cut(&m, field, 0.2, MESH_BELOW, &loops);
    CHECK_EQUAL(loops.loops, 2);
    functionals(&loops, 0, &length[0], &turning[0]);
    functionals(&loops, 1, &length[1], &turning[1]);
    outer = length[0] < length[1];
    hole = !outer;
    CHECK_NEAR(length[outer], 2 * PI * 0.8, 0.02);
    CHECK_NEAR(turning[outer], 2 * PI, 1e-13);
    CHECK_NEAR(length[hole], 2 * PI * 0.4, 0.02);
    CHECK_NEAR(turning[hole], -2 * PI, 1e-13);
    CHECK_NEAR(loops.area, PI * (0.64 - 0.16), 0.02);
    CHECK_STATUS(measure(&loops, (size_t)outer, 2, mu, NULL, NULL), SURFMINK_OK);
    CHECK_STATUS(measure(&loops, (size_t)hole, 2, mu, NULL, NULL), SURFMINK_CLOCKWISE);
    mesh_free_loops(&loops);
    free(field);
    mesh_free(&m);
}

/* Generic levels meet no vertex: then the corners are the cut edges, each once. */
THEOREM(every_cut_edge_is_a_corner_of_one_loop)
{
    chance c = {seed(7)};
    mesh m;
    mesh_loops loops;
    double *field;
    size_t v, h, edges;
    int trial;
    sphere(&m, MESH_ICOSAHEDRON, 3);
    field = field_of(&m, height);
    for (trial = 0; trial < 100; ++trial) {
        CASE("trial %d", trial);
        for (v = 0; v < m.vertices; ++v) field[v] = between(&c, 0, 1);
        cut(&m, field, 0.1 + 0.008 * trial, MESH_BELOW, &loops);
        for (h = edges = 0; h < 3 * m.triangles; ++h)
            edges += field[m.triangle[h]] < 0.1 + 0.008 * trial &&
                     field[m.triangle[h % 3 < 2 ? h + 1 : h - 2]] >= 0.1 + 0.008 * trial;
        CHECK_EQUAL(loops.start[loops.loops], edges);
        CHECK_EQUAL(loops.collapsed, 0);
        CHECK_EQUAL(loops.open, 0);
        check_tidy(&loops);
        mesh_free_loops(&loops);
    }
    free(field);
    mesh_free(&m);
}

THEOREM(curves_that_end_at_the_boundary_are_counted_and_left_out)
{
    mesh m;
    mesh_loops loops;
    double *field;
    size_t v;
    square(&m, 10);
    field = field_of(&m, x_of);
    cut(&m, field, 0.1, MESH_BELOW, &loops);
    CHECK_EQUAL(loops.open, 1);
    CHECK_EQUAL(loops.loops, 0);
    CHECK_EQUAL(loops.start[0], 0);
    mesh_free_loops(&loops);
    for (v = 0; v < m.vertices; ++v) field[v] = fabs(field[v]);
    field[5 * 11 + 5] = 1; /* a peak in the middle of the valley */
    cut(&m, field, 0.5, MESH_BELOW, &loops);
    CHECK_EQUAL(loops.open, 2);
    CHECK_EQUAL(loops.loops, 1);
    CHECK_EQUAL(corners_of(&loops, 0), 6);
    check_tidy(&loops);
    mesh_free_loops(&loops);
    cut(&m, field, 2, MESH_BELOW, &loops); /* all of it: no curve, but an area */
    CHECK_EQUAL(loops.open + loops.loops + loops.collapsed, 0);
    CHECK_NEAR(loops.area, 4, 1e-14);
    mesh_free_loops(&loops);
    cut(&m, field, -1, MESH_BELOW, &loops);
    CHECK_EQUAL(loops.open + loops.loops + loops.collapsed, 0);
    CHECK_NEAR(loops.area, 0, 0);
    mesh_free_loops(&loops);
    free(field);
    mesh_free(&m);
}

/* --- levels exactly at a vertex ----------------------------------------------------------------------------------- */

THEOREM(the_equator_of_the_octahedron_has_four_corners)
{
    mesh m;
    mesh_loops loops;
    double *field, mu[5], up[3] = {0, 0, 1};
    size_t i;
    sphere(&m, MESH_OCTAHEDRON, 0);
    field = field_of(&m, depth);
    cut(&m, field, 0, MESH_BELOW, &loops); /* eight edges are cut, in four points */
    CHECK_EQUAL(loops.loops, 1);
    CHECK_EQUAL(corners_of(&loops, 0), 4);
    for (i = 0; i < 4; ++i) {
        const double *x = corner_of(&loops, 0, i);
        CHECK_NEAR(x[2], 0, 0);
        CHECK_NEAR(fabs(x[0]) + fabs(x[1]), 1, 0);
    }
    /* with normals along the axis it is a flat square */
    for (i = 0; i < 4; ++i) memcpy(loops.normal + 3 * i, up, sizeof up);
    CHECK_OK(measure(&loops, 0, 4, mu, NULL, NULL));
    CHECK_NEAR(mu[4], 1, 1e-15);
    CHECK_NEAR(loops.area, 2 * sqrt(3.0), 1e-15);
    mesh_free_loops(&loops);
    cut(&m, field, -1, MESH_BELOW, &loops); /* nothing is deeper than the top vertex */
    CHECK_EQUAL(loops.loops + loops.collapsed, 0);
    mesh_free_loops(&loops);
    cut(&m, field, 1, MESH_ABOVE, &loops); /* of the part above only the bottom vertex is left */
    CHECK_EQUAL(loops.loops, 0);
    CHECK_EQUAL(loops.collapsed, 1);
    CHECK_NEAR(loops.area, 0, 0);
    mesh_free_loops(&loops);
    free(field);
    mesh_free(&m);
}

/* The rule for ties (at the level is above it) makes a level at vertices the limit of levels just below it. */
THEOREM(a_level_at_vertices_is_the_limit_of_levels_just_below_it)
{
    chance c = {seed(11)};
    mesh m;
    double *field;
    size_t v, collapsed = 0;
    int trial;
    sphere(&m, MESH_OCTAHEDRON, 3);
    field = field_of(&m, height);
    for (trial = 0; trial < 200; ++trial) {
        mesh_loops at, nearly, below, above;
        double length, short_length, turning;
        CASE("trial %d", trial);
        for (v = 0; v < m.vertices; ++v) field[v] = (double)one_of(&c, 4);
        cut(&m, field, 2, MESH_BELOW, &at);
        cut(&m, field, 2 - 1e-14, MESH_BELOW, &nearly);
        cut(&m, field, 2 - 1e-9, MESH_BELOW, &below);
        cut(&m, field, 2, MESH_ABOVE, &above);
        check_tidy(&at);
        check_tidy(&below);
        CHECK_EQUAL(nearly.loops, at.loops); /* 1e-14 is as good as nothing */
        CHECK_EQUAL(nearly.collapsed, at.collapsed);
        CHECK_EQUAL(nearly.start[nearly.loops], at.start[at.loops]);
        CHECK_EQUAL(at.loops + at.collapsed, below.loops);
        CHECK_EQUAL(below.collapsed, 0);
        CHECK_NEAR(at.area, below.area, 1e-8);
        CHECK_NEAR(at.area + above.area, mesh_area(&m), 1e-13);
        collapsed += at.collapsed;
        if (at.loops == 1 && !at.collapsed) {
            functionals(&at, 0, &length, &turning);
            functionals(&below, 0, &short_length, &turning);
            CHECK(length <= short_length + 1e-7); /* what ran there and back is gone */
        }
        mesh_free_loops(&at);
        mesh_free_loops(&nearly);
        mesh_free_loops(&below);
        mesh_free_loops(&above);
    }
    CHECK(collapsed > 100);
    free(field);
    mesh_free(&m);
}

/* A hexagonal hill with a ridge from its foot, exactly at the level: the outline is that of the hill, with nothing that
   runs along the ridge and back; wherever the triangles are counted from, so wherever the outline starts. */
THEOREM(a_ridge_exactly_at_the_level_is_no_part_of_the_outline)
{
    mesh m;
    double *field, want;
    size_t shift;
    uint32_t turned[3];
    square(&m, 10);
    field = field_of(&m, height);
    field[5 * 11 + 3] = 2; /* the hill: hexagon of cut edges */
    field[5 * 11 + 4] = field[5 * 11 + 5] = field[5 * 11 + 6] = field[6 * 11 + 7] = 1; /* the ridge */
    for (shift = 0; shift < m.triangles; ++shift) {
        mesh_loops loops;
        double length, turning;
        CASE("shift %d", (int)shift);
        cut(&m, field, 1, MESH_ABOVE, &loops);
        check_tidy(&loops);
        CHECK_EQUAL(loops.loops, 1);
        CHECK_EQUAL(loops.collapsed, 0);
        CHECK_EQUAL(corners_of(&loops, 0), 6);
        functionals(&loops, 0, &length, &turning);
        if (shift == 0) want = length;
        CHECK_NEAR(length, want, 1e-15);
        CHECK_NEAR(turning, 2 * PI, 1e-14);
        mesh_free_loops(&loops);
        memcpy(turned, m.triangle, sizeof turned);
        memmove(m.triangle, m.triangle + 3, 3 * (m.triangles - 1) * sizeof *turned);
        memcpy(m.triangle + 3 * (m.triangles - 1), turned, sizeof turned);
        prepare(&m);
    }
    field[5 * 11 + 3] = 1; /* now the ridge alone: it has no width */
    for (shift = 0; shift < 2; ++shift) {
        mesh_loops loops;
        cut(&m, field, 1, shift ? MESH_ABOVE : MESH_BELOW, &loops);
        CHECK_EQUAL(loops.loops, 0);
        CHECK_EQUAL(loops.collapsed, 1);
        CHECK_NEAR(loops.area, shift ? 0 : 4, 1e-14);
        mesh_free_loops(&loops);
    }
    free(field);
    mesh_free(&m);
}

THEOREM(a_level_within_rounding_of_vertices_meets_them)
{
    static const double level[6] = {1e-17, -1e-17, 1e-16, -1e-16, 3e-14, -3e-14};
    mesh m;
    mesh_loops loops;
    double *field, want[7], mu[7];
    int k, p;
    sphere(&m, MESH_OCTAHEDRON, 4);
    field = field_of(&m, depth); /* the equator runs through vertices */
    for (p = 0; p < 2; ++p) {    /* once more with a tilt, so that it is not the plane z = 0 that saves us */
        size_t v;
        for (v = 0; p && v < m.vertices; ++v) {
            double *x = m.vertex + 3 * v, y = x[0];
            x[0] = 0.6 * y + 0.8 * x[2];
            x[2] = 0.6 * x[2] - 0.8 * y;
            x[1] += 0.7;
        }
        prepare(&m);
        for (k = -1; k < 6; ++k) {
            CASE("level %g", k < 0 ? 0 : level[k]);
            cut(&m, field, k < 0 ? 0 : level[k], MESH_BELOW, &loops);
            CHECK_EQUAL(loops.loops, 1);
            check_tidy(&loops);
            /* on an equator S is rounding noise, so the outline is measured in its plane */
            for (v = 0; v < loops.start[1]; ++v) {
                loops.normal[3 * v] = p ? 0.8 : 0;
                loops.normal[3 * v + 1] = 0;
                loops.normal[3 * v + 2] = p ? 0.6 : 1;
            }
            CHECK_OK(measure(&loops, 0, 6, k < 0 ? want : mu, NULL, NULL));
            if (k >= 0) CHECK_NEAR(mu[4], want[4], 1e-9);
            if (k >= 0) CHECK_NEAR(mu[6], want[6], 1e-9);
            mesh_free_loops(&loops);
        }
    }
    free(field);
    mesh_free(&m);
}

THEOREM(nonsense_is_refused_by_name_and_leaves_no_loops)
{
    mesh m;
    mesh_loops loops;
    mesh_error error;
    double *field;
    mesh_sphere(&m, MESH_OCTAHEDRON, 1, NULL);
    field = field_of(&m, height);
    CHECK_EQUAL(mesh_level_set(&m, field, 0.5, MESH_BELOW, &loops, &error), MESH_BAD_ARGUMENT);
    prepare(&m);
    CHECK_EQUAL(mesh_level_set(&m, field, 0.5, 8, &loops, &error), MESH_BAD_ARGUMENT);
    CHECK_EQUAL(mesh_level_set(&m, field, nan(""), MESH_BELOW, &loops, &error), MESH_NOT_FINITE);
    field[3] = HUGE_VAL;
    CHECK_EQUAL(mesh_level_set(&m, field, 0.5, MESH_BELOW, &loops, &error), MESH_NOT_FINITE);
    CHECK(strcmp(error.text, "the field at vertex 3 (from 0) is not finite") == 0);
    field[3] = nan("");
    CHECK_EQUAL(mesh_level_set(&m, field, 0.5, MESH_BELOW, &loops, NULL), MESH_NOT_FINITE);
    CHECK(loops.loops == 0 && !loops.start && !loops.corner && !loops.normal);
    mesh_free_loops(&loops);
    free(field);
    mesh_free(&m);
}

THEOREM(fields_of_any_size_are_cut_in_the_same_places)
{
    static const double scale[3] = {0x1p-1000, 0x1p-60, 0x1p1023};
    mesh m;
    double *field;
    size_t v;
    int k;
    sphere(&m, MESH_ICOSAHEDRON, 2);
    for (k = 0; k < 3; ++k) {
        mesh_loops loops, scaled;
        CASE("scale %g", scale[k]);
        field = field_of(&m, depth);
        cut(&m, field, -0.5, MESH_BELOW, &loops);
        for (v = 0; v < m.vertices; ++v) field[v] *= scale[k];
        cut(&m, field, -0.5 * scale[k], MESH_BELOW, &scaled);
        CHECK_EQUAL(scaled.start[1], loops.start[1]);
        CHECK_SAME(scaled.corner, loops.corner, 3 * loops.start[1]);
        CHECK_NEAR(scaled.area, loops.area, 1e-15);
        for (v = 0; v < m.vertices; ++v) field[v] = v % 2 ? 1.5e308 : -1.5e308; /* their difference overflows */
        mesh_free_loops(&scaled);
        cut(&m, field, 0, MESH_BELOW, &scaled);
        CHECK(scaled.loops > 0);
        check_tidy(&scaled);
        mesh_free_loops(&scaled);
        mesh_free_loops(&loops);
        free(field);
    }
    mesh_free(&m);
}

/* --- the paper's experiment, and a random field ------------------------------------------------------------------- */

static struct {
    double h[10], mu[10][4]; /* of each level, p = 2, 4, 6, 8 */
    size_t corners[10];
} study[2];

static const int finest[2] = {8, 9};

/* The flower on refined spheres: icosahedron to 1.3 million, octahedron to 2.1 million triangles. */
static void run_study(void)
{
    static const int base[2] = {MESH_ICOSAHEDRON, MESH_OCTAHEDRON};
    int b, level, k;
    for (b = 0; b < 2; ++b) {
        mesh m;
        mesh_sphere(&m, base[b], 0, NULL);
        for (level = 0; level <= finest[b]; ++level) {
            mesh_loops loops;
            double *field, mu[9];
            if (level) CHECK_EQUAL(mesh_refine_sphere(&m, NULL), MESH_OK);
            prepare(&m);
            field = field_of(&m, outside_flower);
            cut(&m, field, 0, MESH_BELOW, &loops);
            study[b].h[level] = mesh_longest_edge(&m);
            study[b].corners[level] = loops.loops ? corners_of(&loops, 0) : 0;
            if (loops.loops) CHECK_OK(measure(&loops, 0, 8, mu, NULL, NULL));
            for (k = 0; loops.loops && k < 4; ++k) study[b].mu[level][k] = mu[2 * k + 2];
            mesh_free_loops(&loops);
            free(field);
        }
        mesh_free(&m);
    }
}

/* Paper 5.2, figure (sphere-convergence), with the index of section 3. */
THEOREM(the_flower_on_refined_spheres_is_the_table_s_to_every_digit)
{
    table t;
    int rows = 0, k;
    run_study();
    table_open(&t, "examples/paper/data/levelset_sphere.tsv");
    while (table_next(&t)) {
        int b = table_text(&t, "mesh")[0] == 'o', level = (int)table_number(&t, "level");
        CASE("%s %d", table_text(&t, "mesh"), level);
        CHECK_NEAR(study[b].h[level], table_number(&t, "h"), 0.51e-6);
        CHECK_EQUAL(study[b].corners[level], table_number(&t, "q"));
        for (k = 0; k < 4; ++k) CHECK_NEAR(study[b].mu[level][k], table_rank(&t, "mu", 2 * k + 2), 0.6e-10);
        ++rows;
    }
    CHECK_EQUAL(rows, 17);
}

/* Slope of log(error) over log(h), by least squares over the finest four levels, against the smooth curve. */
THEOREM(errors_of_mu_on_level_sets_fall_with_order_two)
{
    static const double limit[4] = {.041307578749043, .169084042925900, .0742854634691783, .301915775390885};
    int b, k, level;
    for (b = 0; b < 2; ++b)
        for (k = 0; k < 4; ++k) {
            double x = 0, y = 0, xx = 0, xy = 0;
            for (level = finest[b] - 3; level <= finest[b]; ++level) {
                double h = log(study[b].h[level]), e = log(fabs(study[b].mu[level][k] - limit[k]));
                x += h / 4, y += e / 4, xx += h * h / 4, xy += h * e / 4;
            }
            CASE("%s, mu_%d", b ? "octahedron" : "icosahedron", 2 * k + 2);
            CHECK_NEAR((xy - x * y) / (xx - x * x), 2, 0.3);
        }
}

static const char *const xyz[3] = {"x", "y", "z"}, *const nxyz[3] = {"nx", "ny", "nz"};

/* Loop k of the contours, as the table has it; returns its number of corners. */
static size_t read_contour(int k, double corner[][3], double normal[][3], size_t most)
{
    table t;
    size_t n = 0;
    int c;
    table_open(&t, "tests/data/sphere_grf_seed1.contours.cells.tsv");
    while (table_next(&t)) {
        if ((int)table_number(&t, "cell") != k) continue;
        if (n == most) exit(1);
        for (c = 0; c < 3; ++c) corner[n][c] = table_number(&t, xyz[c]), normal[n][c] = table_number(&t, nxyz[c]);
        ++n;
    }
    return n;
}

/* As it reads back from a table with so many decimals. */
static double printed(double x, int decimals)
{
    char text[64];
    snprintf(text, sizeof text, "%.*f", decimals, x);
    return strtod(text, NULL);
}

/* A Gaussian random field on a sphere: 17 contours found by another program, with the part above on the left, and
   measured in 40 digits as it printed them: 10 decimals of a corner, 9 of a normal. Contour 7 is a hole. */
THEOREM(contours_of_a_random_field_are_those_found_elsewhere)
{
    static double corner[256][3], normal[256][3], ours[2][256][3];
    static const double level[3] = {0.5, 1, 1.5};
    mesh m;
    mesh_error error;
    mesh_loops loops[3];
    double *field = NULL;
    size_t found = 0, k, i;
    int l, c, p, clockwise = 0;
    table t;
    if (mesh_read(&m, "tests/data/sphere_geodesic16.mesh.off", NULL, &error) ||
        mesh_read_field(&m, "tests/data/sphere_grf_seed1.field.txt", &field, NULL, &error)) {
        puts(error.text);
        exit(1);
    }
    prepare(&m);
    for (l = 0; l < 3; ++l) {
        cut(&m, field, level[l], MESH_ABOVE, &loops[l]);
        CHECK_EQUAL(loops[l].open + loops[l].collapsed, 0);
        check_tidy(&loops[l]);
        found += loops[l].loops;
    }
    CHECK_EQUAL(found, 17);
    table_open(&t, "tests/data/sphere_grf_seed1.contours.ref.tsv");
    while (table_next(&t)) {
        int id = (int)table_number(&t, "cell");
        size_t n = read_contour(id, corner, normal, 256), start = 0;
        double mu[7], g[14], nearest = 1;
        const mesh_loops *at;
        surfmink_functionals w;
        CASE("contour %d", id);
        for (l = 0; l < 2 && level[l] < table_number(&t, "level"); ++l) continue;
        at = &loops[l];
        for (k = 0; k < at->loops; ++k) /* the loop that has its first corner, and where on it */
            for (i = 0; i < corners_of(at, k); ++i)
                if (apart(corner_of(at, k, i), corner[0]) < nearest) {
                    nearest = apart(corner_of(at, k, i), corner[0]);
                    found = k, start = i;
                }
        CHECK_EQUAL(corners_of(at, found), n);
        if (corners_of(at, found) != n) continue;
        for (i = 0; i < n; ++i) {
            const double *x = corner_of(at, found, start + i);
            const double *nx = at->normal + 3 * (at->start[found] + (start + i) % n);
            CHECK_NEAR(apart(x, corner[i]), 0, 1e-10);
            CHECK_NEAR(apart(nx, normal[i]), 0, 1e-9);
            for (c = 0; c < 3; ++c) ours[0][i][c] = printed(x[c], 10), ours[1][i][c] = printed(nx[c], 9);
        }
        if (id == 7) { /* nothing is defined for a hole as it runs, so turn it round */
            ++clockwise;
            CHECK_STATUS(surfmink_measure(IN_SPACE(ours[0][0], ours[1][0], n), 6, mu, g, &w, NULL), SURFMINK_CLOCKWISE);
            surfmink_reverse(ours[0][0], n, 3);
            surfmink_reverse(ours[1][0], n, 3);
        }
        CHECK_OK(surfmink_measure(IN_SPACE(ours[0][0], ours[1][0], n), 6, mu, g, &w, NULL));
        CHECK_CLOSE(w.length, table_number(&t, "L"), 1e-14);
        CHECK_NEAR(id == 7 ? -w.turning : w.turning, table_number(&t, "sum_alpha"), 1e-13);
        for (p = 2; p <= 6; ++p) {
            CHECK_NEAR(mu[p], table_rank(&t, "mu_", p), 1e-12);
            if (id != 7) CHECK_ANGLE(atan2(g[2 * p + 1], g[2 * p]), table_rank(&t, "arg_", p), 1e-12 / mu[p]);
        }
    }
    CHECK_EQUAL(clockwise, 1);
    for (l = 0; l < 3; ++l) mesh_free_loops(&loops[l]);
    free(field);
    mesh_free(&m);
}

/* --- what loops enclose ------------------------------------------------------------------------------------------- */

/* A torus of 60 x 30 x 2 triangles about the z axis: radius 1, of the tube 0.4. */
static void torus(mesh *m)
{
    enum { ROUND = 60, TUBE = 30 };
    size_t i, j;
    memset(m, 0, sizeof *m);
    m->vertex = (double *)malloc(3 * ROUND * TUBE * sizeof(double));
    m->triangle = (uint32_t *)malloc(6 * ROUND * TUBE * sizeof(uint32_t));
    if (!m->vertex || !m->triangle) exit(1);
    for (j = 0; j < TUBE; ++j)
        for (i = 0; i < ROUND; ++i) {
            double phi = 2 * PI * (double)i / ROUND, theta = 2 * PI * ((double)j + 0.3) / TUBE;
            double *x = m->vertex + 3 * m->vertices++;
            uint32_t *corner = m->triangle + 3 * m->triangles;
            size_t a = j * ROUND + i, b = j * ROUND + (i + 1) % ROUND;
            size_t d = (j + 1) % TUBE * ROUND + i, c = (j + 1) % TUBE * ROUND + (i + 1) % ROUND;
            x[0] = (1 + 0.4 * cos(theta)) * cos(phi);
            x[1] = (1 + 0.4 * cos(theta)) * sin(phi);
            x[2] = 0.4 * sin(theta);
            corner[0] = corner[3] = (uint32_t)a;
            corner[1] = (uint32_t)b;
            corner[2] = corner[4] = (uint32_t)c;
            corner[5] = (uint32_t)d;
            m->triangles += 2;
        }
    prepare(m);
}

static double flat_area(const mesh_loops *loops, size_t k)
{
    double area = 0;
    size_t i;
    for (i = 0; i < corners_of(loops, k); ++i) {
        const double *a = corner_of(loops, k, i), *b = corner_of(loops, k, i + 1);
        area += (a[0] * b[1] - b[0] * a[1]) / 2;
    }
    return area;
}

/* Random fields on a square with a hole: below or above the level, closed loops are the whole boundary of the inside, and
   those of one part enclose something. */
THEOREM(loops_closed_along_the_boundary_enclose_the_inside)
{
    enum { COUNT = 14 };
    double field[(COUNT + 1) * (COUNT + 1)];
    chance c = {seed(41)};
    size_t round, closed = 0, k, i;
    for (round = 0; round < 60; ++round) {
        mesh m;
        mesh_loops loops;
        int how = (round % 2 ? MESH_ABOVE : MESH_BELOW) | CONTOUR_CLOSE | CONTOUR_PARTS;
        square(&m, COUNT);
        for (k = 0; k < m.vertices; ++k) {
            field[k] = round % 3 ? between(&c, 0, 1) : (double)one_of(&c, 3);
            if (round % 4 == 3 && one_in(&c, 10)) field[k] = nan("");
        }
        mesh_cut_holes(&m, field);
        prepare(&m);
        CASE("field %d", (int)round);
        cut(&m, field, round % 3 ? between(&c, 0, 1) : 1, how, &loops);
        CHECK_EQUAL(loops.open, 0);
        closed += loops.closed;
        check_tidy(&loops);
        {
            double area = 0;
            for (k = 0; k < loops.loops; ++k) area += flat_area(&loops, k);
            CHECK_NEAR(area, loops.area, 1e-12);
        }
        for (k = 0; k < loops.loops; ++k) {
            double part = 0;
            for (i = 0; i < loops.loops; ++i) part += loops.part[i] == loops.part[k] ? flat_area(&loops, i) : 0;
            CHECK(part > 0);
        }
        mesh_free_loops(&loops);
        mesh_free(&m);
    }
    CHECK(closed > 200);
}

THEOREM(a_loop_encloses_what_lies_beyond_it)
{
    enum { COUNT = 16 };
    double field[(COUNT + 1) * (COUNT + 1)];
    chance c = {seed(43)};
    size_t round, k, checked = 0;
    mesh m;
    square(&m, COUNT);
    for (round = 0; round < 60; ++round) {
        mesh_loops loops;
        int how = (round % 2 ? MESH_ABOVE : MESH_BELOW) | (round % 4 < 2 ? CONTOUR_CLOSE : 0) | CONTOUR_PARTS;
        for (k = 0; k < m.vertices; ++k) field[k] = between(&c, 0, 1);
        CASE("field %d", (int)round);
        cut(&m, field, between(&c, 0.1, 0.9), how, &loops);
        for (k = 0; k < loops.loops; ++k, ++checked) {
            double area = flat_area(&loops, k);
            CHECK_NEAR(loops.enclosed[2 * k], area > 0 ? area : 4 + area, 1e-12);
            CHECK_NEAR(loops.enclosed[2 * k + 1], area > 0 ? 4 - area : -area, 1e-12);
        }
        mesh_free_loops(&loops);
    }
    CHECK(checked > 300);
    mesh_free(&m);
}

/* Two circles round a torus bound the same two parts: neither separates anything by itself. Together with its image on
   the other side of the axis a small one does. */
THEOREM(a_loop_that_does_not_separate_encloses_nothing)
{
    mesh m;
    mesh_loops loops;
    double *field, whole;
    size_t k;
    torus(&m);
    whole = mesh_area(&m);
    field = field_of(&m, height);
    cut(&m, field, 0.01, MESH_BELOW | CONTOUR_PARTS, &loops);
    CHECK_EQUAL(loops.loops, 2);
    for (k = 0; k < 2 * loops.loops; ++k) CHECK(mesh__is_nan(loops.enclosed[k]));
    CHECK_EQUAL(loops.part[0], loops.part[1]);
    mesh_free_loops(&loops);
    free(field);
    field = field_of(&m, quadrants);
    cut(&m, field, 0.03, MESH_BELOW | CONTOUR_PARTS, &loops); /* a ring of four parts */
    CHECK_EQUAL(loops.loops, 4);
    for (k = 0; k < 2 * loops.loops; ++k) CHECK(mesh__is_nan(loops.enclosed[k]));
    mesh_free_loops(&loops);
    free(field);
    field = field_of(&m, x_of);
    cut(&m, field, 1.2, MESH_ABOVE | CONTOUR_PARTS, &loops);
    CHECK_EQUAL(loops.loops, 1);
    CHECK_NEAR(loops.enclosed[0], loops.area, 1e-12);
    CHECK_NEAR(loops.enclosed[1], whole - loops.area, 1e-12);
    mesh_free_loops(&loops);
    free(field);
    mesh_free(&m);
}

/* A sphere cut at three heights by turns: caps and bands; what a loop has on its left is all beyond it. */
THEOREM(bands_of_a_sphere_are_one_part_with_two_loops)
{
    mesh m;
    mesh_loops loops;
    mesh_error error;
    double *field, whole;
    size_t v;
    sphere(&m, MESH_ICOSAHEDRON, 4);
    whole = mesh_area(&m);
    field = field_of(&m, height);
    for (v = 0; v < m.vertices; ++v) field[v] = fabs(field[v] - 0.4);
    cut(&m, field, 0.3, MESH_BELOW | CONTOUR_PARTS, &loops); /* between the heights 0.1 and 0.7 */
    CHECK_EQUAL(loops.loops, 2);
    CHECK_EQUAL(loops.part[0], loops.part[1]);
    for (v = 0; v < 2; ++v) {
        double top = loops.corner[3 * loops.start[v] + 2], left = top > 0.4 ? 1 + top : 1 - top;
        CHECK_NEAR(loops.enclosed[2 * v] / whole, left / 2, 0.002);
        CHECK_NEAR(loops.enclosed[2 * v] + loops.enclosed[2 * v + 1], whole, 1e-12);
    }
    CHECK_NEAR(loops.area, loops.enclosed[0] + loops.enclosed[2] - whole, 1e-12);
    mesh_free_loops(&loops);
    CHECK_EQUAL(mesh_level_set(&m, field, 3, MESH_BELOW | CONTOUR_CLOSE | CONTOUR_PARTS, &loops, &error), MESH_OK);
    CHECK_EQUAL(loops.loops, 0); /* all of a closed surface */
    mesh_free_loops(&loops);
    free(field);
    mesh_free(&m);
}

int main(void)
{
    PROVE(off_obj_and_ply_of_one_mesh_read_the_same);
    PROVE(what_is_wrong_with_a_mesh_file_is_said_with_file_and_line);
    PROVE(a_binary_file_is_called_that);
    PROVE(what_is_wrong_with_a_field_file_is_said_with_file_and_line);
    PROVE(refined_spheres_are_closed_oriented_and_obey_euler);
    PROVE(a_mesh_that_is_no_oriented_surface_is_refused_by_name);
    PROVE(faces_that_run_against_their_neighbours_are_turned_round);
    PROVE(copies_of_vertices_at_the_boundary_are_joined);
    PROVE(polygons_are_split_into_triangles_that_fill_them);
    PROVE(sheets_that_touch_in_a_vertex_are_counted);
    PROVE(a_flipped_mesh_is_inside_out);
    PROVE(a_vertex_normal_is_the_mean_weighted_by_area);
    PROVE(normals_of_a_refined_sphere_are_of_second_order);
    PROVE(areas_are_exact_on_flat_triangles);
    PROVE(caps_of_refined_spheres_converge_with_order_two);
    PROVE(the_inside_is_on_the_left);
    PROVE(a_hole_has_a_loop_of_its_own_that_runs_the_other_way);
    PROVE(every_cut_edge_is_a_corner_of_one_loop);
    PROVE(curves_that_end_at_the_boundary_are_counted_and_left_out);
    PROVE(the_equator_of_the_octahedron_has_four_corners);
    PROVE(a_level_at_vertices_is_the_limit_of_levels_just_below_it);
    PROVE(a_ridge_exactly_at_the_level_is_no_part_of_the_outline);
    PROVE(a_level_within_rounding_of_vertices_meets_them);
    PROVE(nonsense_is_refused_by_name_and_leaves_no_loops);
    PROVE(fields_of_any_size_are_cut_in_the_same_places);
    PROVE(the_flower_on_refined_spheres_is_the_table_s_to_every_digit);
    PROVE(errors_of_mu_on_level_sets_fall_with_order_two);
    PROVE(contours_of_a_random_field_are_those_found_elsewhere);
    PROVE(loops_closed_along_the_boundary_enclose_the_inside);
    PROVE(a_loop_encloses_what_lies_beyond_it);
    PROVE(a_loop_that_does_not_separate_encloses_nothing);
    PROVE(bands_of_a_sphere_are_one_part_with_two_loops);
    return QED();
}
