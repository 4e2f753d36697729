/* levelset.c - outlines where a scalar has a given value: on the vertices of a mesh, or in the pixels of a grey image.

   A concentration on a membrane, a temperature on a globe, the brightness of a picture: how elongated, how triangular
   are the regions where it is low or high? This command cuts them out, and surfmink measures them:

     levelset mesh.off field.txt --at 0.5 | surfmink --reverse auto
     levelset image.tif --at 128 --inside above | surfmink --reverse auto

   compile   cc levelset.c -o levelset -lm
   manual    ./levelset --help

   It only reads arguments, calls surfaces/mesh.h or image/grey.h, and prints. */

#define SURFMINK_IMPLEMENTATION
#include "../surfmink.h"

#include "command/harmless.h"
#include "image/grey.h"
#include "image/read.h"
#include "surfaces/mesh.h"

#include <errno.h>

#define PI 3.14159265358979323846

static const char *const help[] = {
    "levelset - outlines where a scalar on a mesh or in an image has a given value, as a table for surfmink\n"
    "\n"
    "EXAMPLES\n"
    "  levelset mesh.off field.txt --at 0.5 | surfmink                  the parts of the mesh where field < 0.5\n"
    "  levelset mesh.ply field.txt --at 0 --at 1 --inside above         where field >= 0, and where field >= 1\n"
    "  levelset image.tif --at 128 --inside above | surfmink            what is bright in a grey image\n"
    "  levelset image.tif --positions xyz.tif --at 128 | surfmink       the same on a curved surface\n"
    "  levelset body.obj --function z --at -1 --at 0 --at 1             a body cut at three heights\n"
    "  levelset --subdivide ico:6 --function flower | surfmink          a flower with four petals on the unit sphere\n"
    "  levelset mesh.off field.txt --at 0.5 --area                      no outlines, only their number and area\n"
    "  levelset mesh.off field.txt --at 0.5 --close --loops             which of them are holes, and of what\n"
    "\n"
    "USAGE\n"
    "  levelset [OPTIONS] MESH FIELD --at V [--at V ...]\n"
    "  levelset [OPTIONS] MESH --field NAME --at V [--at V ...]\n"
    "  levelset [OPTIONS] MESH --function NAME [--at V ...]\n"
    "  levelset [OPTIONS] IMAGE --at V [--at V ...]\n"
    "\n"
    "  MESH    a mesh of triangles or polygons: OFF, OBJ, PLY, STL or legacy VTK, whatever the name; - is standard\n"
    "          input. Polygons are split into triangles, copies of vertices at the boundary are joined, and faces\n"
    "          that run against their neighbours are turned round; standard error says so\n"
    "  FIELD   one number a line for each vertex of MESH, in its order; blank lines and what follows a # are skipped.\n"
    "          nan means no value: the triangles there are a hole\n"
    "  IMAGE   a grey image: TIFF without compression, NPY or PGM. The curves are interpolated between the centres of\n"
    "          the pixels. NaN means no value: the squares between pixels there are a hole\n"
    "\n",
    "OPTIONS (--option V or --option=V)\n"
    "  --at V                the value to cut at, as often as you like (0 if there is a --function and no --at)\n"
    "  --inside below|above  which part is outlined, and has its area measured: field < V (default) or field >= V\n"
    "  --close               closes curves that end at the boundary along it, and outlines a boundary that lies\n"
    "                        inside, so that all loops together enclose the inside\n"
    "  --field NAME          instead of FIELD, a scalar that the vertices have in a PLY or VTK file\n"
    "  --function NAME       instead of FIELD, a function of the place: x, y, z, or flower[:R0,A,OMEGA,X0,Y0], which\n"
    "                        is negative inside the curve theta = X0 + r cos t, phi = Y0 + r sin t with\n"
    "                        r = R0 - A sin(OMEGA t), angles seen from the origin (default 0.5,0.1,4,pi/2,pi/4)\n"
    "  --subdivide BASE:N    instead of MESH, a unit sphere: an icosahedron (ico) or octahedron (oct), refined N\n"
    "                        times\n"
    "  --positions FILE      for an IMAGE: the position of every pixel in space, x, y and z as pages, planes or\n"
    "                        channels, NaN where there is none\n"
    "  --normals FILE        the outward normal of every pixel, in the same form; without it normals are made from\n"
    "                        the positions\n"
    "  --spacing S[,S]       for an IMAGE in the plane: width and height of a pixel (default 1)\n"
    "  --flip                reverses a mesh whose normals point inwards, or the normals of a chart\n"
    "  --area                prints a table with one line per level instead of the outlines\n"
    "  --loops               prints a table with one line per loop instead of the outlines\n"
    "  --digits N            significant digits, 1 to 17; default 17, which is exact\n"
    "  --help\n"
    "\n",
    "OUTPUT\n"
    "  Lines that begin with # say where the outlines come from and, for each level, how many loops there are, the\n"
    "  area of the inside, and how many curves were left out. Then comes a table, tab separated, loops counted\n"
    "  through all levels: loop level x y z nx ny nz, or of an image without --positions loop level x y, where x is\n"
    "  the column and y minus the row, times the spacing.\n"
    "  Every loop has the inside on its left. A part with a hole has two loops; the one round the hole runs the other\n"
    "  way, and surfmink refuses it as clockwise, or measures it with --reverse auto.\n"
    "  Without --close, curves that end at the boundary of the mesh or image, or at a hole, enclose nothing and are\n"
    "  left out. The area is right nonetheless, also of parts without any loop. A chart also ends where it is folded:\n"
    "  where it shows another side of the surface than beside it.\n"
    "  The table of --loops: loop level part kind of corners area\n"
    "    part   connected part of the inside that the loop bounds, counted through all levels\n"
    "    kind   outer; hole, which surfmink calls clockwise; - where it refuses the loop otherwise, as a belt\n"
    "    of     outer loop of a hole; - if its part has none: it goes round the body or ends at the boundary\n"
    "    area   what the loop encloses, with its holes: of the polygon in the plane, else of the surface as far as\n"
    "           it is there; nan where the loop does not separate it\n"
    "\n"
    "EXIT STATUS\n"
    "  0: all is well. 1: a wrong option, or a file that is unreadable or malformed. 2: a curve was left out at a\n"
    "  boundary.\n"};

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

/* The shortest decimal that reads back as the same number: 0.1, not 0.10000000000000001; 100, not 1e+02. */
static const char *shortest(double x)
{
    static char text[32];
    int digits = fabs(x) >= 1 && fabs(x) < 1e15 ? 1 + (int)log10(fabs(x)) : 1;
    do snprintf(text, sizeof text, "%.*g", digits, x);
    while (digits++ < 17 && (strtod(text, NULL) < x || strtod(text, NULL) > x));
    return text;
}

static void print_outlines(const contours *loops, const double *level, size_t levels, int digits, int is_flat)
{
    size_t l, k, i, loop = 0;
    int c, numbers = is_flat ? 2 : 3;
    puts(is_flat ? "loop\tlevel\tx\ty" : "loop\tlevel\tx\ty\tz\tnx\tny\tnz");
    for (l = 0; l < levels; ++l)
        for (k = 0; k < loops[l].loops; ++k, ++loop)
            for (i = loops[l].start[k]; i < loops[l].start[k + 1]; ++i) {
                printf("%lu\t%s", (unsigned long)loop, shortest(level[l]));
                for (c = 0; c < numbers; ++c) printf("\t%.*g", digits, loops[l].corner[3 * i + (size_t)c]);
                for (c = 0; c < 3 && !is_flat; ++c) printf("\t%.*g", digits, loops[l].normal[3 * i + (size_t)c]);
                putchar('\n');
            }
}

static void print_areas(const contours *loops, const double *level, size_t levels, int digits)
{
    size_t l;
    puts("level\tloops\tcorners\tarea\topen\tcollapsed");
    for (l = 0; l < levels; ++l)
        printf("%s\t%lu\t%lu\t%.*g\t%lu\t%lu\n", shortest(level[l]), (unsigned long)loops[l].loops,
               (unsigned long)loops[l].start[loops[l].loops], digits, loops[l].area, (unsigned long)loops[l].open,
               (unsigned long)loops[l].collapsed);
}

/* What surfmink says of a loop: OK of an outer one, CLOCKWISE of a hole. */
static int status_of(const contours *c, size_t loop)
{
    size_t first = c->start[loop];
    surfmink_outline o = surfmink_embedded(c->corner + 3 * first, c->normal + 3 * first, c->start[loop + 1] - first);
    return surfmink_measure(&o, 0, NULL, NULL, NULL, NULL);
}

/* The area of a loop in the plane. */
static double flat_area(const contours *c, size_t loop)
{
    const double *first = c->corner + 3 * c->start[loop];
    double sum[2] = {0, 0};
    size_t i;
    for (i = c->start[loop] + 1; i + 1 < c->start[loop + 1]; ++i) {
        const double *a = c->corner + 3 * i, *b = a + 3;
        contour_sum(sum, (a[0] - first[0]) * (b[1] - first[1]) / 2 - (b[0] - first[0]) * (a[1] - first[1]) / 2);
    }
    return fabs(sum[0] + sum[1]);
}

/* What is known of the parts of a level. */
typedef struct part_list {
    size_t *number; /* each part: how it is called in the table, from 1; 0 if it is not */
    size_t *outer;  /* each part: its outer loop, CONTOUR_NONE if there is none */
    int *status;    /* each loop */
} part_list;

static int list_parts(part_list *list, const contours *c, size_t *named)
{
    size_t k, count = 0;
    for (k = 0; k < c->loops; ++k)
        if (c->part[k] >= count) count = c->part[k] + 1;
    list->number = (size_t *)calloc(count + 1, sizeof *list->number);
    list->outer = (size_t *)calloc(count + 1, sizeof *list->outer);
    list->status = (int *)malloc((c->loops + 1) * sizeof *list->status);
    if (!list->number || !list->outer || !list->status) return 0;
    for (k = 0; k < count; ++k) list->outer[k] = CONTOUR_NONE;
    for (k = 0; k < c->loops; ++k) {
        list->status[k] = status_of(c, k);
        if (!list->number[c->part[k]]) list->number[c->part[k]] = ++*named;
        if (list->status[k] == SURFMINK_OK) list->outer[c->part[k]] = k;
    }
    return 1;
}

static void free_lists(part_list *lists, size_t levels)
{
    size_t l;
    for (l = 0; lists && l < levels; ++l) {
        free(lists[l].number);
        free(lists[l].outer);
        free(lists[l].status);
    }
    free(lists);
}

/* One for each level; NULL if there is no memory. */
static part_list *list_all_parts(const contours *loops, size_t levels)
{
    part_list *lists = (part_list *)calloc(levels, sizeof *lists);
    size_t l, named = 0;
    for (l = 0; lists && l < levels; ++l)
        if (!list_parts(&lists[l], &loops[l], &named)) {
            free_lists(lists, levels);
            return NULL;
        }
    return lists;
}

static void print_loop(const contours *c, const part_list *list, size_t k, size_t before, int digits, int is_flat)
{
    int is_outer = list->status[k] == SURFMINK_OK, is_hole = list->status[k] == SURFMINK_CLOCKWISE;
    size_t outer = is_hole ? list->outer[c->part[k]] : CONTOUR_NONE;
    double area = is_outer ? c->enclosed[2 * k] : is_hole ? c->enclosed[2 * k + 1] : (double)NAN;
    if (is_flat && (is_outer || is_hole)) area = flat_area(c, k);
    printf("\t%lu\t%s\t", (unsigned long)(list->number[c->part[k]] - 1), is_outer ? "outer" : is_hole ? "hole" : "-");
    if (outer == CONTOUR_NONE)
        putchar('-');
    else
        printf("%lu", (unsigned long)(before + outer));
    printf("\t%lu\t", (unsigned long)(c->start[k + 1] - c->start[k]));
    if (area >= 0)
        printf("%.*g\n", digits, area);
    else
        puts("nan"); /* %g may print a sign */
}

static void print_loops(const contours *loops, const part_list *lists, const double *level, size_t levels, int digits,
                        int is_flat)
{
    size_t l, k, before = 0;
    puts("loop\tlevel\tpart\tkind\tof\tcorners\tarea");
    for (l = 0; l < levels; before += loops[l++].loops)
        for (k = 0; k < loops[l].loops; ++k) {
            printf("%lu\t%s", (unsigned long)(before + k), shortest(level[l]));
            print_loop(&loops[l], &lists[l], k, before, digits, is_flat);
        }
}

/* --- the command -------------------------------------------------------------------------------------------------- */

typedef struct {
    const char *file[2]; /* MESH and FIELD, or IMAGE; without --subdivide the first is the mesh */
    int files;
    const char *subdivide, *field, *function_text, *positions, *normals;
    function f;
    double *level, spacing[2];
    size_t levels;
    int base, refinements; /* of --subdivide */
    int is_image, has_spacing;
    int inside, flip, area, close, loops, digits;
} options;

static int *switch_of(options *o, const char *name)
{
    if (!strcmp(name, "--flip")) return &o->flip;
    if (!strcmp(name, "--area")) return &o->area;
    if (!strcmp(name, "--close")) return &o->close;
    return !strcmp(name, "--loops") ? &o->loops : NULL;
}

static int has_value(const char *name)
{
    static const char *const known[9] = {"--at",     "--inside",    "--function", "--field",  "--subdivide",
                                         "--digits", "--positions", "--normals",  "--spacing"};
    int i = 0;
    while (i < 9 && strcmp(name, known[i]) != 0) ++i;
    return i < 9;
}

static int parse_spacing(const char *text, options *o)
{
    char *end;
    o->has_spacing = 1;
    o->spacing[0] = o->spacing[1] = strtod(text, &end);
    if (end == text) return 0;
    if (*end == ',') {
        text = end + 1;
        o->spacing[1] = strtod(text, &end);
        if (end == text) return 0;
    }
    return !*end && o->spacing[0] >= 1e-100 && o->spacing[0] <= 1e100 && o->spacing[1] >= 1e-100 &&
           o->spacing[1] <= 1e100;
}

/* An option with a value. Returns what is wrong with it, or NULL. */
static const char *set_value(options *o, const char *name, const char *value)
{
    char *end;
    long n;
    if (!strcmp(name, "--at")) return number(value, &o->level[o->levels++]) ? NULL : "--at wants a finite number, got";
    if (!strcmp(name, "--inside")) {
        o->inside = strcmp(value, "above") != 0 ? CONTOUR_BELOW : CONTOUR_ABOVE;
        return o->inside == CONTOUR_ABOVE || !strcmp(value, "below") ? NULL : "--inside wants below or above, got";
    }
    if (!strcmp(name, "--spacing"))
        return parse_spacing(value, o) ? NULL : "--spacing wants one positive number, or two with a comma, got";
    if (!strcmp(name, "--function")) {
        o->function_text = value;
        return parse_function(value, &o->f)
                   ? NULL
                   : "--function wants x, y, z or flower:R0,A,OMEGA,X0,Y0 (a whole OMEGA), got";
    }
    if (!strcmp(name, "--subdivide")) {
        n = !strncmp(value, "ico:", 4) || !strncmp(value, "oct:", 4) ? strtol(value + 4, &end, 10) : -1;
        if (n < 0 || n > 12 || end == value + 4 || *end)
            return "--subdivide wants ico:N or oct:N with N from 0 to 12, got";
        o->subdivide = value;
        o->base = value[0] == 'i' ? MESH_ICOSAHEDRON : MESH_OCTAHEDRON;
        o->refinements = (int)n;
        return NULL;
    }
    if (!strcmp(name, "--digits")) {
        n = strtol(value, &end, 10);
        o->digits = (int)n;
        return n < 1 || n > 17 || end == value || *end ? "--digits wants 1 to 17, got" : NULL;
    }
    *(!strcmp(name, "--field") ? &o->field : !strcmp(name, "--positions") ? &o->positions : &o->normals) = value;
    return NULL;
}

/* What only a mesh has, or only an image. */
static int check_source(options *o)
{
    int is_mesh = o->subdivide || o->field || o->function_text || o->files == 2;
    const char *for_image = o->positions     ? "--positions"
                            : o->normals     ? "--normals"
                            : o->has_spacing ? "--spacing"
                                             : NULL;
    o->is_image = !is_mesh;
    if (is_mesh && for_image) return complain("this is for an IMAGE, not for a mesh", for_image);
    if (o->normals && !o->positions) return complain("--normals without --positions", o->normals);
    if (o->has_spacing && o->positions)
        return complain("--spacing is for the plane: with --positions, these tell where a pixel is", NULL);
    if (o->is_image && o->flip && !o->positions)
        return complain("--flip is for normals: an image has none without --positions", NULL);
    if (o->is_image && (!strcmp(o->file[0], "-") + (o->positions && !strcmp(o->positions, "-")) +
                        (o->normals && !strcmp(o->normals, "-"))) > 1)
        return complain("standard input is one file", NULL);
    return 0;
}

static int check(options *o)
{
    int values = o->function_text || o->field;
    if (!o->subdivide && o->files == 0) return complain("there is neither a mesh nor an image", NULL);
    if (o->field && (o->subdivide || o->function_text))
        return complain("--field is of a MESH in a file, without --function", o->field);
    if (o->subdivide && o->files + values == 0)
        return complain("there is no FIELD, no --field and no --function", NULL);
    if (o->files > !o->subdivide + !values)
        return complain("FIELD, --field and --function, or MESH and --subdivide, exclude each other",
                        o->file[o->files - 1]);
    if (o->files == 2 && !strcmp(o->file[0], "-") && !strcmp(o->file[1], "-"))
        return complain("standard input is either MESH or FIELD", NULL);
    if (o->area && o->loops) return complain("--area and --loops are two tables: one at a time", NULL);
    if (!o->levels && !o->function_text) return complain("there is no --at", NULL);
    if (!o->levels) o->level[o->levels++] = 0;
    return check_source(o);
}

static int parse(int count, char **argument, options *o)
{
    int i;
    for (i = 1; i < count; ++i) {
        char *name = argument[i], *value = strchr(name, '=');
        const char *wrong;
        if (name[0] == '-' && value)
            *value++ = '\0'; /* --at=V is --at V */
        else
            value = NULL;
        if (name[0] != '-' || !name[1]) {
            if (o->files == 2) return complain("one mesh and one field, this is one file more", name);
            o->file[o->files++] = name;
        } else if (switch_of(o, name)) {
            if (value) return complain("no value is wanted behind", name);
            *switch_of(o, name) = 1;
        } else if (!has_value(name)) {
            return complain("unknown option", name);
        } else if (!value && i + 1 == count) {
            return complain("a value is missing behind", name);
        } else {
            if (!value) value = argument[++i];
            wrong = set_value(o, name, value);
            if (wrong) return complain(wrong, value);
        }
    }
    return check(o);
}

/* --- a mesh ------------------------------------------------------------------------------------------------------- */

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

static void report_surface(const options *o, const mesh *m)
{
    const char *mesh_name = o->subdivide ? o->subdivide : o->file[0];
    if (!m->boundary_edges && m->triangles && mesh_volume(m) < 0) {
        put_harmless(stderr, mesh_name);
        fputs(": inside out, its normals point inwards: --flip turns it round\n", stderr);
    }
    if (m->pinched) {
        put_harmless(stderr, mesh_name);
        fprintf(stderr, ": vertices where sheets touch that share no edge: %lu (normals there are a mean)\n",
                (unsigned long)m->pinched);
    }
}

static int cut_mesh(const options *o, mesh *m, contours *loops)
{
    mesh_error error;
    double *field = NULL;
    size_t l;
    int status = prepare(o, m, &field, &error), how = o->inside | (o->close ? CONTOUR_CLOSE : 0);
    for (l = 0; !status && l < o->levels; ++l)
        status = mesh_level_set(m, field, o->level[l], how | (o->loops ? CONTOUR_PARTS : 0), &loops[l], &error);
    free(field);
    if (!status) {
        report_surface(o, m);
        return 1;
    }
    put_harmless(stderr, error.text);
    fputc('\n', stderr);
    return 0;
}

/* --- an image ----------------------------------------------------------------------------------------------------- */

typedef struct picture {
    image grey, positions, normals;
    chart space;
    grey squares;
} picture;

static int read_picture(const options *o, picture *p, image_error *error)
{
    const char *name = o->file[0];
    if (!read_image(&p->grey, name, error)) {
        if (p->grey.bytes && p->grey.size > 0 && read_format(p->grey.bytes, p->grey.size) == READ_KNOWN)
            image_fail(error, name,
                       "no image (TIFF without compression, NPY or PGM); if it is a mesh, it wants a FIELD, a --field "
                       "or a --function");
        return 0;
    }
    if (p->grey.channels != 1)
        return image_fail(error, name, "%lu pages or colours: a grey image has one number for each pixel",
                          (unsigned long)p->grey.channels);
    if (!read_map(&p->positions, o->positions, &p->grey, error) || !read_map(&p->normals, o->normals, &p->grey, error))
        return 0;
    p->space.position = &p->positions;
    p->space.normal = o->normals ? &p->normals : NULL;
    p->space.flips = o->flip;
    p->squares.im = &p->grey;
    p->squares.space = o->positions ? &p->space : NULL;
    p->squares.spacing[0] = o->spacing[0];
    p->squares.spacing[1] = o->spacing[1];
    return grey_begin(&p->squares, error);
}

static int cut_image(const options *o, picture *p, contours *loops)
{
    image_error error = {""};
    size_t l;
    int good = read_picture(o, p, &error), how = o->inside | (o->close ? CONTOUR_CLOSE : 0);
    for (l = 0; good && l < o->levels; ++l)
        good = grey_level_set(&p->squares, o->level[l], how | (o->loops ? CONTOUR_PARTS : 0), &loops[l], &error);
    if (!good) fprintf(stderr, "%s\n", error.text);
    if (good && p->squares.holes) {
        put_harmless(stderr, o->file[0]);
        fprintf(stderr, ": %lu pixels have no value%s: holes\n", (unsigned long)p->squares.holes,
                o->positions ? ", position or normal" : "");
    }
    return good;
}

/* --- the command -------------------------------------------------------------------------------------------------- */

static void print_source(const options *o, const mesh *m, const picture *p)
{
    printf("# levelset of ");
    if (o->is_image) {
        put_harmless(stdout, o->file[0]);
        printf(" (%lu x %lu pixels)", (unsigned long)p->grey.width, (unsigned long)p->grey.height);
    } else {
        put_harmless(stdout, o->function_text ? o->function_text : o->field ? o->field : o->file[!o->subdivide]);
        printf(" on ");
        put_harmless(stdout, o->subdivide ? o->subdivide : o->file[0]);
        printf(" (%lu vertices, %lu triangles, %lu boundary edges, longest edge %.6g)", (unsigned long)m->vertices,
               (unsigned long)m->triangles, (unsigned long)m->boundary_edges, mesh_longest_edge(m));
    }
    printf(", inside %s\n", o->inside == CONTOUR_BELOW ? "below" : "above");
}

/* Says of each level what was found, and what was left out; returns how many curves that are. */
static size_t print_levels(const options *o, const contours *loops)
{
    size_t l, open = 0;
    for (l = 0; l < o->levels; ++l) {
        printf("# level %s: ", shortest(o->level[l]));
        printf("loops %lu, area %.*g, open curves left out %lu", (unsigned long)loops[l].loops, o->digits,
               loops[l].area, (unsigned long)loops[l].open);
        if (o->close) printf(", closed along the boundary %lu", (unsigned long)loops[l].closed);
        if (loops[l].collapsed) printf(", collapsed loops left out %lu", (unsigned long)loops[l].collapsed);
        putchar('\n');
        if (loops[l].open) {
            put_harmless(stderr, o->subdivide ? o->subdivide : o->file[0]);
            fprintf(stderr, ": level %s: %lu %s at the %s: left out\n", shortest(o->level[l]),
                    (unsigned long)loops[l].open, loops[l].open == 1 ? "curve ends" : "curves end",
                    o->is_image ? "border or at a hole" : "boundary of the mesh");
        }
        open += loops[l].open;
    }
    return open;
}

/* Writes out all levels; returns the exit status. */
static int print(const options *o, const mesh *m, const picture *p, const contours *loops)
{
    int is_flat = o->is_image && !o->positions, status;
    part_list *lists = o->loops ? list_all_parts(loops, o->levels) : NULL;
    if (o->loops && !lists) return complain("out of memory", NULL);
    print_source(o, m, p);
    status = print_levels(o, loops) ? 2 : 0;
    if (o->area)
        print_areas(loops, o->level, o->levels, o->digits);
    else if (o->loops)
        print_loops(loops, lists, o->level, o->levels, o->digits, is_flat);
    else
        print_outlines(loops, o->level, o->levels, o->digits, is_flat);
    free_lists(lists, o->levels);
    return is_written() ? status : 1;
}

static int run(const options *o)
{
    mesh m;
    picture p;
    contours *loops = (contours *)calloc(o->levels, sizeof *loops);
    size_t l;
    int status = 1;
    memset(&m, 0, sizeof m);
    memset(&p, 0, sizeof p);
    if (!loops)
        complain("out of memory", NULL);
    else if (o->is_image ? cut_image(o, &p, loops) : cut_mesh(o, &m, loops))
        status = print(o, &m, &p, loops);
    for (l = 0; loops && l < o->levels; ++l) contours_free(&loops[l]);
    free(loops);
    mesh_free(&m);
    grey_free(&p.squares);
    image_free(&p.grey);
    image_free(&p.positions);
    image_free(&p.normals);
    return status;
}

int main(int count, char **argument)
{
    options o;
    int i, status;
    for (i = 1; i < count; ++i)
        if (!strcmp(argument[i], "--help") || !strcmp(argument[i], "-h")) {
            for (i = 0; i < (int)(sizeof help / sizeof *help); ++i) fputs(help[i], stdout);
            return !is_written();
        }
    memset(&o, 0, sizeof o);
    o.digits = 17;
    o.spacing[0] = o.spacing[1] = 1;
    o.level = (double *)malloc(((size_t)count + 1) * sizeof *o.level);
    if (!o.level) return complain("out of memory", NULL);
    status = parse(count, argument, &o);
    if (!status) status = run(&o);
    free(o.level);
    return status;
}
