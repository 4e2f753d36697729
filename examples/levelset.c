/* levelset.c - outlines on a triangle mesh: where a scalar on its vertices has a given value.

   A concentration on a membrane, a temperature on a globe, the height of a landscape: how elongated, how triangular are
   the regions where it is low or high? This command cuts them out of the mesh, and surfmink measures them:

     levelset mesh.off field.txt --at 0.5 | surfmink --reverse auto

   compile   cc levelset.c -o levelset -lm
   manual    ./levelset --help

   It only reads arguments, calls surfaces/mesh.h, and prints. */

#include "command/harmless.h"
#include "surfaces/mesh.h"

#include <errno.h>

#define PI 3.14159265358979323846

static const char help[] =
    "levelset - outlines where a scalar on a mesh has a given value, as a table for surfmink\n"
    "\n"
    "EXAMPLES\n"
    "  levelset mesh.off field.txt --at 0.5 | surfmink                  the parts of the mesh where field < 0.5\n"
    "  levelset mesh.ply field.txt --at 0 --at 1 --inside above         where field >= 0, and where field >= 1\n"
    "  levelset body.obj --function z --at -1 --at 0 --at 1             a body cut at three heights\n"
    "  levelset --subdivide ico:6 --function flower | surfmink          a flower with four petals on the unit sphere\n"
    "  levelset mesh.off field.txt --at 0.5 --area                      no outlines, only their number and area\n"
    "\n"
    "USAGE\n"
    "  levelset [OPTIONS] MESH FIELD --at V [--at V ...]\n"
    "  levelset [OPTIONS] MESH --field NAME --at V [--at V ...]\n"
    "  levelset [OPTIONS] MESH --function NAME [--at V ...]\n"
    "\n"
    "  MESH    a mesh of triangles or polygons, as OFF, OBJ, PLY, STL or legacy VTK (told apart by what is in the\n"
    "          file); - is standard input. Polygons are split into triangles, copies of vertices at the boundary\n"
    "          joined, faces that run against their neighbours turned round; standard error says so\n"
    "  FIELD   one number a line for each vertex of MESH, in its order; blank lines and what follows a # are skipped.\n"
    "          nan: no value; the triangles there are a hole\n"
    "\n"
    "OPTIONS (--option V or --option=V)\n"
    "  --at V                the value to cut at, as often as you like (0 if there is a --function and no --at)\n"
    "  --inside below|above  which part is outlined, and has its area measured: field < V (default) or field >= V\n"
    "  --field NAME          instead of FIELD, a scalar that the vertices have in a PLY or VTK file\n"
    "  --function NAME       instead of FIELD, a function of the place: x, y, z, or flower[:R0,A,OMEGA,X0,Y0], which\n"
    "                        is negative inside the curve theta = X0 + r cos t, phi = Y0 + r sin t with\n"
    "                        r = R0 - A sin(OMEGA t), angles seen from the origin (default 0.5,0.1,4,pi/2,pi/4)\n"
    "  --subdivide BASE:N    instead of MESH, a unit sphere: an icosahedron (ico) or octahedron (oct), refined N\n"
    "                        times\n"
    "  --flip                turns a mesh round whose normals point inwards\n"
    "  --area                prints a table with one line per level instead of the outlines\n"
    "  --digits N            significant digits of the numbers, 1 to 17 (default 17: nothing is lost)\n"
    "  --help\n"
    "\n"
    "OUTPUT\n"
    "  # lines that say where it comes from and, for each level, how many loops there are, the area of the inside,\n"
    "  and how many curves were left out; then a table: loop level x y z nx ny nz, tab separated, loops counted "
    "through\n"
    "  all levels. Every loop has the inside on its left. So a part with a hole has two: one round the outside, and\n"
    "  one round the hole the other way, which surfmink refuses as clockwise, or measures with --reverse auto.\n"
    "  Curves that end at the boundary of the mesh are left out, for they enclose nothing; the area is right all the\n"
    "  same, and so is that of a part without any loop.\n"
    "\n"
    "EXIT STATUS\n"
    "  0 all is well; 1 usage error, or a file that is unreadable or malformed; 2 a curve was left out at a boundary\n";

static int complain(const char *what, const char *about)
{
    fprintf(stderr, "levelset: %s%s", what, about ? ": " : "");
    put_harmless(stderr, about ? about : "");
    fputs(" (levelset --help shows examples)\n", stderr);
    return 1;
}

/* Whether all of standard output has gone out; if not, says so. */
static int is_written(void)
{
    if (!fflush(stdout) && !ferror(stdout) && !fclose(stdout)) return 1; /* some disks complain only when it closes */
    fprintf(stderr, "levelset: standard output cannot be written: %s\n", strerror(errno));
    return 0;
}

/* A text that is one finite number and nothing else. */
static int number(const char *text, double *x)
{
    char *end;
    *x = strtod(text, &end);
    return end != text && !*end && fabs(*x) <= DBL_MAX;
}

/* --- functions of the place --------------------------------------------------------------------------------------- */

typedef struct {
    char axis;           /* x, y, z; or f, the flower */
    double parameter[5]; /* r0, a, omega, x0, y0 */
} function;

static int parse_function(const char *text, function *f)
{
    static const double usual[5] = {0.5, 0.1, 4, PI / 2, PI / 4};
    int k;
    memcpy(f->parameter, usual, sizeof usual);
    f->axis = text[0];
    if (strchr("xyz", text[0]) && text[0] && !text[1]) return 1;
    if (strncmp(text, "flower", 6) != 0 || (text[6] && text[6] != ':')) return 0;
    if (!text[6]) return 1;
    for (k = 0, text += 6; k < 5 && *text; ++k) {
        char *end;
        f->parameter[k] = strtod(text + 1, &end);
        if (end == text + 1 || (*end && *end != ',') || !(fabs(f->parameter[k]) <= DBL_MAX)) return 0;
        text = end;
    }
    /* with another omega the curve would not close: r jumps from t = 2 pi to t = 0 */
    return !*text && f->parameter[2] >= 0 && f->parameter[2] == floor(f->parameter[2]);
}

static double evaluate(const function *f, const double x[3])
{
    double theta, phi, t;
    if (f->axis != 'f') return x[f->axis - 'x'];
    theta = atan2(hypot(x[0], x[1]), x[2]) - f->parameter[3];
    phi = remainder(atan2(x[1], x[0]) - f->parameter[4], 2 * PI);
    t = atan2(phi, theta); /* without the extra pi of the paper's rho, which puts odd petals on the far side */
    return hypot(theta, phi) - (f->parameter[0] - f->parameter[1] * sin(f->parameter[2] * t));
}

/* --- output ------------------------------------------------------------------------------------------------------- */

/* The shortest decimal that reads back as the same number: 0.1, not 0.10000000000000001. */
static const char *shortest(double x)
{
    static char text[32];
    int digits = 1;
    do snprintf(text, sizeof text, "%.*g", digits, x);
    while (digits++ < 17 && (strtod(text, NULL) < x || strtod(text, NULL) > x));
    return text;
}

static void print_outlines(const mesh_loops *loops, const double *level, size_t levels, int digits)
{
    size_t l, k, i, loop = 0;
    int c;
    puts("loop\tlevel\tx\ty\tz\tnx\tny\tnz");
    for (l = 0; l < levels; ++l)
        for (k = 0; k < loops[l].loops; ++k, ++loop)
            for (i = loops[l].start[k]; i < loops[l].start[k + 1]; ++i) {
                printf("%lu\t%s", (unsigned long)loop, shortest(level[l]));
                for (c = 0; c < 3; ++c) printf("\t%.*g", digits, loops[l].corner[3 * i + (size_t)c]);
                for (c = 0; c < 3; ++c) printf("\t%.*g", digits, loops[l].normal[3 * i + (size_t)c]);
                putchar('\n');
            }
}

static void print_areas(const mesh_loops *loops, const double *level, size_t levels, int digits)
{
    size_t l;
    puts("level\tloops\tcorners\tarea\topen\tcollapsed");
    for (l = 0; l < levels; ++l)
        printf("%s\t%lu\t%lu\t%.*g\t%lu\t%lu\n", shortest(level[l]), (unsigned long)loops[l].loops,
               (unsigned long)loops[l].start[loops[l].loops], digits, loops[l].area, (unsigned long)loops[l].open,
               (unsigned long)loops[l].collapsed);
}

/* --- the command -------------------------------------------------------------------------------------------------- */

typedef struct {
    const char *file[2]; /* MESH and FIELD; without --subdivide the first is the mesh */
    int files;
    const char *subdivide, *field, *function_text;
    function f;
    double *level;
    size_t levels;
    int base, refinements; /* of --subdivide */
    int inside, flip, area, digits;
} options;

static int parse(int count, char **argument, options *o)
{
    int i, values;
    for (i = 1; i < count; ++i) {
        char *name = argument[i], *value = strchr(name, '='), *end;
        if (name[0] == '-' && value)
            *value++ = '\0'; /* --at=V is --at V */
        else
            value = NULL;
        if (name[0] != '-' || !name[1]) {
            if (o->files == 2) return complain("one mesh and one field, this is one file more", name);
            o->file[o->files++] = name;
        } else if (!strcmp(name, "--flip") || !strcmp(name, "--area")) {
            if (value) return complain("no value is wanted behind", name);
            if (name[2] == 'f')
                o->flip = 1;
            else
                o->area = 1;
        } else if (strcmp(name, "--at") != 0 && strcmp(name, "--inside") != 0 && strcmp(name, "--function") != 0 &&
                   strcmp(name, "--field") != 0 && strcmp(name, "--subdivide") != 0 && strcmp(name, "--digits") != 0) {
            return complain("unknown option", name);
        } else if (!value && i + 1 == count) {
            return complain("a value is missing behind", name);
        } else {
            if (!value) value = argument[++i];
            if (!strcmp(name, "--at")) {
                if (!number(value, &o->level[o->levels++])) return complain("--at wants a finite number, got", value);
            } else if (!strcmp(name, "--inside")) {
                o->inside = strcmp(value, "above") != 0 ? MESH_BELOW : MESH_ABOVE;
                if (o->inside == MESH_BELOW && strcmp(value, "below") != 0)
                    return complain("--inside wants below or above, got", value);
            } else if (!strcmp(name, "--field")) {
                o->field = value;
            } else if (!strcmp(name, "--function")) {
                o->function_text = value;
                if (!parse_function(value, &o->f))
                    return complain("--function wants x, y, z or flower:R0,A,OMEGA,X0,Y0 (a whole OMEGA), got", value);
            } else if (!strcmp(name, "--subdivide")) {
                long level =
                    !strncmp(value, "ico:", 4) || !strncmp(value, "oct:", 4) ? strtol(value + 4, &end, 10) : -1;
                if (level < 0 || level > 12 || end == value + 4 || *end)
                    return complain("--subdivide wants ico:N or oct:N with N from 0 to 12, got", value);
                o->subdivide = value;
                o->base = value[0] == 'i' ? MESH_ICOSAHEDRON : MESH_OCTAHEDRON;
                o->refinements = (int)level;
            } else {
                long digits = strtol(value, &end, 10);
                if (digits < 1 || digits > 17 || end == value || *end)
                    return complain("--digits wants 1 to 17, got", value);
                o->digits = (int)digits;
            }
        }
    }
    if (!o->subdivide && o->files == 0) return complain("there is no mesh", NULL);
    if (o->field && (o->subdivide || o->function_text))
        return complain("--field is of a MESH in a file, without --function", o->field);
    values = o->function_text || o->field;
    if (o->files < !o->subdivide + !values) return complain("there is no FIELD, no --field and no --function", NULL);
    if (o->files > !o->subdivide + !values)
        return complain("FIELD, --field and --function, or MESH and --subdivide, exclude each other",
                        o->file[o->files - 1]);
    if (o->files == 2 && !strcmp(o->file[0], "-") && !strcmp(o->file[1], "-"))
        return complain("standard input is either MESH or FIELD", NULL);
    if (!o->levels && !o->function_text) return complain("there is no --at", NULL);
    if (!o->levels) o->level[o->levels++] = 0;
    return 0;
}

/* What was done to the mesh to make it a surface. */
static void report_mesh(const mesh *m)
{
    char text[200];
    if (m->joined) {
        snprintf(text, sizeof text, ": %lu vertices are copies of others: joined\n", (unsigned long)m->joined);
        put_harmless(stderr, m->name);
        fputs(text, stderr);
    }
    if (m->turned) {
        snprintf(text, sizeof text, ":%lu: runs against its neighbours; %lu such %s turned round\n", m->first_turned,
                 (unsigned long)m->turned, m->turned == 1 ? "face is" : "faces are");
        put_harmless(stderr, m->name);
        fputs(text, stderr);
    }
    if (m->ignored) {
        put_harmless(stderr, m->name);
        fputs(": its normals contradict its faces, or each other: not used; means over the faces are\n", stderr);
    }
}

/* Copies of a vertex have one value, which is that of the first. */
static int check_copies(const mesh *m, const double *field, mesh_error *error)
{
    size_t v;
    for (v = 0; m->joint && field && v < m->vertices; ++v)
        if (field[v] < field[m->joint[v]] || field[v] > field[m->joint[v]])
            return mesh__fail(error, MESH_MALFORMED, m->name, 0,
                              "vertices %lu and %lu (from 0) are one point with two values: %g and %g",
                              (unsigned long)m->joint[v], (unsigned long)v, field[m->joint[v]], field[v]);
    return MESH_OK;
}

/* NaN is no value: the triangles there are a hole. */
static void cut_holes(mesh *m, double *field, const char *name, size_t line)
{
    size_t v = 0, left_out;
    while (v < m->vertices && !mesh__is_nan(field[v])) ++v;
    if (v == m->vertices) return;
    left_out = mesh_cut_holes(m, field);
    put_harmless(stderr, name);
    if (line) fprintf(stderr, ":%lu", (unsigned long)line);
    fprintf(stderr, ": vertex %lu (from 0) is the first without a value; a hole of %lu triangles\n", (unsigned long)v,
            (unsigned long)left_out);
}

/* The mesh, ready for level sets, and its field. Both files are read first: their errors come before others. */
static int prepare(const options *o, mesh *m, double **field, mesh_error *error)
{
    const char *field_file = o->function_text || o->field ? NULL : o->file[!o->subdivide];
    size_t v, hole = 0;
    int status =
        o->subdivide ? mesh_sphere(m, o->base, o->refinements, error) : mesh_read(m, o->file[0], o->field, error);
    if (!status && field_file) status = mesh_read_field(m, field_file, field, &hole, error);
    if (status) return status;
    if (!field_file) {
        *field = (double *)malloc((m->vertices + 1) * sizeof **field);
        if (!*field) return mesh__no_memory(error, NULL);
        for (v = 0; v < m->vertices; ++v) (*field)[v] = o->field ? m->field[v] : evaluate(&o->f, m->vertex + 3 * v);
    }
    status = check_copies(m, *field, error);
    if (status) return status;
    report_mesh(m);
    cut_holes(m, *field, field_file ? field_file : m->name, hole);
    if (o->flip) mesh_flip(m);
    status = mesh_connect(m, error);
    return status || m->normal ? status : mesh_normals(m, error);
}

/* Writes out all levels; returns how many curves were left out at boundaries. */
static size_t print(const options *o, const mesh *m, const mesh_loops *loops)
{
    const char *mesh_name = o->subdivide ? o->subdivide : o->file[0];
    size_t l, open = 0;
    printf("# levelset of ");
    put_harmless(stdout, o->function_text ? o->function_text : o->field ? o->field : o->file[!o->subdivide]);
    printf(" on ");
    put_harmless(stdout, mesh_name);
    printf(" (%lu vertices, %lu triangles, %lu boundary edges, longest edge %.6g), inside %s\n",
           (unsigned long)m->vertices, (unsigned long)m->triangles, (unsigned long)m->boundary_edges,
           mesh_longest_edge(m), o->inside == MESH_BELOW ? "below" : "above");
    for (l = 0; l < o->levels; ++l) {
        printf("# level %s: ", shortest(o->level[l]));
        printf("loops %lu, area %.*g, open curves left out %lu", (unsigned long)loops[l].loops, o->digits,
               loops[l].area, (unsigned long)loops[l].open);
        if (loops[l].collapsed) printf(", collapsed loops left out %lu", (unsigned long)loops[l].collapsed);
        putchar('\n');
        if (loops[l].open) {
            put_harmless(stderr, mesh_name);
            fprintf(stderr, ": level %s: %lu %s at the boundary of the mesh: left out\n", shortest(o->level[l]),
                    (unsigned long)loops[l].open, loops[l].open == 1 ? "curve ends" : "curves end");
        }
        open += loops[l].open;
    }
    if (o->area)
        print_areas(loops, o->level, o->levels, o->digits);
    else
        print_outlines(loops, o->level, o->levels, o->digits);
    return open;
}

static int run(const options *o)
{
    const char *mesh_name = o->subdivide ? o->subdivide : o->file[0];
    mesh m;
    mesh_error error;
    mesh_loops *loops = (mesh_loops *)calloc(o->levels, sizeof *loops);
    double *field = NULL;
    size_t l, open = 0;
    int status = loops ? MESH_OK : mesh__no_memory(&error, NULL);
    memset(&m, 0, sizeof m);
    if (!status) status = prepare(o, &m, &field, &error);
    for (l = 0; !status && l < o->levels; ++l)
        status = mesh_level_set(&m, field, o->level[l], o->inside, &loops[l], &error);
    if (status) {
        put_harmless(stderr, error.text);
        fputc('\n', stderr);
    } else {
        if (!m.boundary_edges && m.triangles && mesh_volume(&m) < 0) {
            put_harmless(stderr, mesh_name);
            fputs(": inside out, its normals point inwards: --flip turns it round\n", stderr);
        }
        if (m.pinched) {
            put_harmless(stderr, mesh_name);
            fprintf(stderr, ": vertices where sheets touch that share no edge: %lu (normals there are a mean)\n",
                    (unsigned long)m.pinched);
        }
        open = print(o, &m, loops);
        if (!is_written()) status = MESH_UNREADABLE;
    }
    for (l = 0; loops && l < o->levels; ++l) mesh_free_loops(&loops[l]);
    free(loops);
    free(field);
    mesh_free(&m);
    return status ? 1 : open ? 2 : 0;
}

int main(int count, char **argument)
{
    options o;
    int i, status;
    for (i = 1; i < count; ++i)
        if (!strcmp(argument[i], "--help") || !strcmp(argument[i], "-h")) {
            fputs(help, stdout);
            return !is_written();
        }
    memset(&o, 0, sizeof o);
    o.digits = 17;
    o.level = (double *)malloc(((size_t)count + 1) * sizeof *o.level);
    if (!o.level) return complain("out of memory", NULL);
    status = parse(count, argument, &o);
    if (!status) status = run(&o);
    free(o.level);
    return status;
}
