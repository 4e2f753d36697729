/* patic.c - the command `patic`: the outlines of a tissue in, its p-atic field, defects and correlations out.

   compile   cc examples/patic.c -o patic -lm
   run       ./patic --rank 6 --radius 1.5c --defects defects.tsv --summary examples/data/tissue.tsv > field.tsv
             ./patic --help

     0 options   what the user asked for
     1 read      a file -> outlines                             command/read.h repair.h
     2 build     outlines -> cells, neighbours, loops           beyond/patic.h
     3 field     cells -> z, or its mean over a ball -> charges beyond/patic.h
     4 write     -> tables; a summary and a picture if asked    command/field.h */

#include "command/posix.h"

#define SURFMINK_IMPLEMENTATION
#include "../surfmink.h"

#define COMMAND_NAME "patic"
#include "command/options.h"
#include "command/read.h"
#include "command/repair.h"
#include "beyond/patic.h"
#include "command/field.h"

enum { MOST_RADII = 64, MOST_RANK = 1000 };

/* A radius of the coarse field: in units of length, or in mean distances of neighbours. */
typedef struct ball {
    double size;
    int in_cells;
} ball;

typedef struct request {
    options reading; /* for the readers, by their own rules */
    int rank;
    ball radius[MOST_RADII];
    int radii;
    double weld; /* negative: the usual tolerance */
    const char *defects, *correlation;
    int by_order; /* the picture: cells filled by order, not by hue */
} request;

/* All outlines of the file. */
typedef struct outlines {
    int surface;
    size_t cells, corners;
    size_t *offset;
    double *corner, *normal;
    char **id;
    unsigned long *line; /* of each corner */
    int *fault;          /* what reading has already found, of enum surfmink_status */
    unsigned long *first_line;
    size_t offset_room, corner_room, normal_room, id_room, line_room, fault_room, first_room;
} outlines;

static const char *const help[] = {
    "patic - the p-atic field of a tissue on a curved surface: directions, topological defects, correlations\n"
    "\n"
    "EXAMPLES\n"
    "  patic --rank 6 tissue.tsv > field.tsv                     # one line a cell\n"
    "  patic --rank 2 --radius 1.5c --defects d.tsv tissue.tsv   # coarse-grained over 1.5 mean distances of cells\n"
    "  patic --rank 6 --radius 1c,2c,4c tissue.tsv               # how many defects are left at which radius\n"
    "  patic --rank 6 --radius 2c --svg field.svg --summary cells.off > field.tsv\n"
    "\n"
    "USAGE\n"
    "  patic --rank P [OPTION ...] [FILE]\n"
    "  No FILE, or -, is standard input. The input is that of surfmink: a table with an id and x y | lon lat |\n"
    "  x y z | x y z nx ny nz, or a polygon mesh whose faces are the cells. Neighbouring outlines share their\n"
    "  corners, up to --weld.\n"
    "\n",
    "OUTPUT\n"
    "  One line a cell, tab separated: id n x y z nx ny nz mu order dx dy dz neighbours boundary status\n"
    "    x y z, nx ny nz   centre of the outline and its mean normal\n"
    "    mu                mu_P of the outline itself\n"
    "    order             |Z|, 0 to 1: how well the cells in the ball agree; without --radius it is mu\n"
    "    dx dy dz          direction of Z, one of P; empty where there is none\n"
    "    neighbours        cells that share an edge with it\n"
    "    boundary          1 if an edge has no cell on its other side\n"
    "    status            ok, or the reason why the cell is refused; it leaves a hole, and the others are measured\n"
    "  With several radii, one line a radius instead: radius cells components chi loops charges boundary plus minus\n"
    "  margin order, as in --summary.\n"
    "\n"
    "OPTIONS (--option value or --option=value; -- ends them)\n"
    "  --rank P               rank of the field: 2 nematic, 4 tetratic, 6 hexatic; 1 to 1000\n"
    "  --radius R[,R...]      mean over the cells within R, a length, or 1.5c: 1.5 mean distances of neighbours.\n"
    "                         Default 0, the raw field, which has a defect every few cells; 1.5c is a good start\n",
    "  --weld D               corners nearer than D are one; default 1e-6 of the mean edge; 0: only equal ones\n"
    "  --defects FILE         table x y z charge cells order margin, of charges k/P that are not 0: the cells round\n"
    "                         it, their smallest order, and the margin. A charge stays while all angles, times P,\n"
    "                         turn by less than margin pi/2\n"
    "  --correlation FILE     table r pairs G: correlation of the raw field at distance r, the middle of bins as wide\n"
    "                         as the mean distance of neighbours. Takes 1 s for 10,000 cells\n"
    "  --summary              on standard error: cells, components, Euler characteristic chi, boundary loops, sum of\n"
    "                         charges, boundary sum (both add up to chi), defects, smallest margin, mean order\n"
    "  --svg FILE             picture: cells filled by the angle of the P rays drawn in them, paler where order is "
    "less;\n"
    "                         defects are black discs (+) and white ones (-)\n"
    "  --strokes along|across            along (default): rays for P = 2 along the long axis, for P = 3, 4, ...\n"
    "                         towards corners; across: along dx dy dz. None where order is below 5 % of the largest\n"
    "  --color-by hue|order   order: filled by it instead\n"
    "  --view X,Y,Z           from where to look; LON,LAT, front, back; several: a panel for each\n"
    "  --title TEXT           above the picture\n"
    "  --surface plane|sphere|embedded, --merge, --reverse always   as in surfmink\n"
    "  --sphere-radius R      radius of the sphere, default 1\n"
    "  --quiet                no messages about refused cells, no warnings\n"
    "  --help                 this page\n"
    "\n"
    "EXIT STATUS\n"
    "  0: all cells were measured. 2: some were refused. 1: a wrong option, or a file that cannot be read or\n"
    "  written.\n"};

static void wrong_usage(const char *format, ...) COMMAND_PRINTF(1, 2) COMMAND_DIES;
static void wrong_usage(const char *format, ...)
{
    va_list arguments;
    fputs("patic: ", stderr);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputs(" (patic --help explains)\n", stderr);
    exit(EXIT_TROUBLE);
}

/* --- 0. options --------------------------------------------------------------------------------------------------- */

static double parse_length(const char *name, const char *value)
{
    double length;
    if (!parse_number(NULL, value, &length) || !(length >= 0 && length <= 1e100))
        wrong_usage("--%s is a length, not negative, not '%s'", name, value);
    return length;
}

static void parse_radii(request *q, const char *value)
{
    const char *at = value, *end;
    for (q->radii = 0;; at = end + 1) {
        ball *b = &q->radius[q->radii];
        if (q->radii++ == MOST_RADII) wrong_usage("--radius takes at most %d of them", MOST_RADII);
        end = read_number(NULL, at, &b->size);
        if (!end || !(b->size >= 0 && b->size <= 1e100))
            wrong_usage("--radius is a length, or a number of cells as 1.5c, or several with commas, not '%s'", value);
        b->in_cells = *end == 'c';
        if (b->in_cells) ++end;
        if (*end == '\0') return;
        if (*end != ',') wrong_usage("--radius is a length, or a number of cells as 1.5c, not '%s'", value);
    }
}

/* Options that the readers know under the same name, or another; the last two take no value. */
enum { PASSED_ON = 9, WITH_A_VALUE = 7 };
static const char *const passed_on[PASSED_ON][2] = {
    {"surface", "--surface"}, {"sphere-radius", "--radius"}, {"reverse", "--reverse"}, {"svg", "--svg"},
    {"view", "--view"},       {"title", "--title"},          {"strokes", "--strokes"}, {"merge", "--merge"},
    {"quiet", "--quiet"}};

/* What the readers would say under their own name. */
static void check_passed_on(const char *name, const char *value)
{
    static const char *const surfaces = " plane sphere embedded ";
    char word[16];
    if (strcmp(name, "surface") == 0) {
        snprintf(word, sizeof word, " %.12s ", value);
        if (!strstr(surfaces, word)) wrong_usage("--surface is plane, sphere or embedded, not '%s'", value);
    }
    if (strcmp(name, "reverse") == 0 && strcmp(value, "always") != 0 && strcmp(value, "never") != 0)
        wrong_usage("--reverse is always or never, not '%s'", value);
    if (strcmp(name, "sphere-radius") == 0 && !(parse_length(name, value) > 0))
        wrong_usage("--sphere-radius is a positive number, not '%s'", value);
}

static void set_own_option(request *q, const char *name, const char *value, int *summary)
{
    size_t rank;
    if (strcmp(name, "rank") == 0) {
        if (!parse_count(value, &rank) || rank < 1 || rank > MOST_RANK)
            wrong_usage("--rank is a whole number from 1 to %d, not '%s'", MOST_RANK, value);
        q->rank = (int)rank;
    } else if (strcmp(name, "radius") == 0)
        parse_radii(q, value);
    else if (strcmp(name, "weld") == 0)
        q->weld = parse_length(name, value);
    else if (strcmp(name, "defects") == 0)
        q->defects = value;
    else if (strcmp(name, "correlation") == 0)
        q->correlation = value;
    else if (strcmp(name, "color-by") == 0) {
        q->by_order = strcmp(value, "order") == 0;
        if (!q->by_order && strcmp(value, "hue") != 0) wrong_usage("--color-by is hue or order, not '%s'", value);
    } else
        *summary = 1;
}

/* Takes one option from the front of the arguments, and passes it on if it is the readers'; returns how many of them it
   was. */
static int take_own_option(request *q, char **argument, char **passed, int *count, int *summary)
{
    static const char *const own[] = {"rank", "radius", "weld", "defects", "correlation", "color-by", "summary"};
    const char *text = argument[0] + 2, *equals = strchr(argument[0], '=');
    size_t length = strcspn(text, "=");
    const char *name = NULL, *value;
    int i, k = -1, valued = 1;
    if (strcmp(argument[0], "--help") == 0) answer(help, sizeof help / sizeof *help);
    for (i = 0; i < 7 && strncmp(argument[0], "--", 2) == 0; ++i)
        if (strlen(own[i]) == length && strncmp(own[i], text, length) == 0) name = own[i], valued = i < 6;
    for (i = 0; i < PASSED_ON && strncmp(argument[0], "--", 2) == 0; ++i)
        if (strlen(passed_on[i][0]) == length && strncmp(passed_on[i][0], text, length) == 0)
            name = passed_on[i][0], k = i, valued = i < WITH_A_VALUE;
    if (!name) wrong_usage("unknown option '%.*s'", (int)strcspn(argument[0], "="), argument[0]);
    if (!valued && equals) wrong_usage("--%s takes no value", name);
    value = !valued ? "" : equals ? equals + 1 : argument[1];
    if (!value) wrong_usage("--%s needs a value", name);
    if (k < 0)
        set_own_option(q, name, value, summary);
    else {
        static char option_text[PASSED_ON][16];
        check_passed_on(name, value);
        snprintf(option_text[k], sizeof option_text[k], "%s", passed_on[k][1]);
        passed[(*count)++] = option_text[k];
        if (valued) passed[(*count)++] = equals ? argument[0] + (value - argument[0]) : argument[1];
    }
    return valued && !equals ? 2 : 1;
}

static void check_request(const request *q)
{
    const char *file[3];
    static const char *const name[3] = {"defects", "correlation", "svg"};
    int i, j;
    file[0] = q->defects;
    file[1] = q->correlation;
    file[2] = q->reading.svg;
    if (q->rank == 0) wrong_usage("--rank is missing: 2 for elongation, 4 for squares, 6 for hexagons");
    if (q->reading.files > 1) wrong_usage("one FILE at a time: a tissue is one file");
    for (i = 0; i < 3; ++i) {
        if (!file[i]) continue;
        if (*file[i] == '\0' || strcmp(file[i], "-") == 0) wrong_usage("--%s needs the name of a file", name[i]);
        if (q->radii > 1 && i != 1) wrong_usage("--%s needs one --radius", name[i]);
        for (j = 0; j < i; ++j)
            if (file[j] && strcmp(file[i], file[j]) == 0)
                wrong_usage("--%s and --%s would write the same file", name[j], name[i]);
    }
    if (q->by_order && !q->reading.svg) wrong_usage("--color-by is for pictures: add --svg FILE");
}

static void parse_request(request *q, int argc, char **argv)
{
    static char program[] = "patic";
    char **passed = (char **)resize(NULL, (size_t)argc + 2, sizeof *passed);
    int i = 1, count = 1, only_files = 0, summary = 0;
    memset(q, 0, sizeof *q);
    q->weld = -1;
    q->radii = 1;
    passed[0] = program;
    while (i < argc) {
        if (!only_files && argv[i][0] == '-' && argv[i][1] != '\0') {
            if (strcmp(argv[i], "--") == 0) {
                passed[count++] = argv[i++];
                only_files = 1;
            } else
                i += take_own_option(q, argv + i, passed, &count, &summary);
        } else
            passed[count++] = argv[i++];
    }
    passed[count] = NULL;
    parse_options(&q->reading, count, passed);
    q->reading.summary = summary;
    free(passed);
    check_request(q);
}

/* --- 1. read ------------------------------------------------------------------------------------------------------ */

/* A cell that crosses itself is refused, as by surfmink; one that comes back to a vertex, or along a cut, meets
   itself. */
static void find_faults(polygon *p, const request *q)
{
    surfmink_outline view = p->surface == PLANE    ? surfmink_plane(p->corner, p->n)
                            : p->surface == SPHERE ? surfmink_sphere(p->corner, p->n, 1)
                                                   : surfmink_embedded(p->corner, p->normal, p->n);
    size_t pair[2];
    if (p->fault == FAULT_SEVERAL_RINGS || p->fault == FAULT_SEAM) p->fault = PATIC_MEETS_ITSELF;
    if (p->fault == SURFMINK_OK &&
        find_crossing(p, surfmink_measure(&view, 0, NULL, NULL, NULL, NULL), &q->reading, pair) == 1)
        find_fault(p, SURFMINK_CROSSES_ITSELF, p->line[pair[0]]);
}

static void add_outline(outlines *all, const polygon *p)
{
    size_t stride = stride_of(p->surface), end = all->corners + p->n, i, length = strlen(p->id) + 1;
    size_t c = all->cells;
    all->offset = (size_t *)grow(all->offset, &all->offset_room, c + 2, sizeof *all->offset);
    all->id = (char **)grow(all->id, &all->id_room, c + 1, sizeof *all->id);
    all->fault = (int *)grow(all->fault, &all->fault_room, c + 1, sizeof *all->fault);
    all->first_line = (unsigned long *)grow(all->first_line, &all->first_room, c + 1, sizeof *all->first_line);
    all->corner = (double *)grow(all->corner, &all->corner_room, end * stride + 1, sizeof *all->corner);
    all->line = (unsigned long *)grow(all->line, &all->line_room, end + 1, sizeof *all->line);
    all->normal =
        (double *)grow(all->normal, &all->normal_room, p->surface == EMBEDDED ? 3 * end + 1 : 1, sizeof *all->normal);
    all->id[c] = (char *)resize(NULL, length, 1);
    memcpy(all->id[c], p->id, length);
    all->fault[c] = p->fault;
    all->first_line[c] = p->fault ? p->fault_line : p->first_line;
    for (i = 0; i < p->n * stride; ++i) /* what is faulty must not be measured */
        all->corner[all->corners * stride + i] = p->fault ? nan("") : p->corner[i];
    for (i = 0; i < p->n; ++i) all->line[all->corners + i] = p->line[i];
    if (p->surface == EMBEDDED && p->n > 0)
        memcpy(all->normal + 3 * all->corners, p->normal, 3 * p->n * sizeof *p->normal);
    all->offset[0] = 0;
    all->offset[++all->cells] = all->corners = end;
}

static void check_file(const reader *in, const char *name, const char *option, const char *file)
{
    if (file && is_same_file(file, in->in.file, name)) die("%s: --%s would overwrite it", name, option);
}

static void read_outlines(outlines *all, const request *q)
{
    const char *name = q->reading.file[0];
    powers_of_ten powers;
    reader in;
    polygon p;
    memset(all, 0, sizeof *all);
    memset(&p, 0, sizeof p);
    prepare_powers(&powers);
    open_reader(&in, name, &powers, &q->reading);
    check_file(&in, name, "defects", q->defects);
    check_file(&in, name, "correlation", q->correlation);
    all->surface = in.surface;
    if (q->reading.radius > 0 && in.surface != SPHERE)
        die("%s: --sphere-radius is for spheres, and this is none", name);
    while (next_polygon(&in, &p)) {
        repair_polygon(&p, &q->reading);
        find_faults(&p, q);
        add_outline(all, &p);
    }
    close_reader(&in);
    free_polygon(&p);
    if (all->cells == 0) {
        all->offset = (size_t *)grow(all->offset, &all->offset_room, 1, sizeof *all->offset);
        all->offset[0] = 0;
    }
}

static void free_outlines(outlines *all)
{
    size_t c;
    for (c = 0; c < all->cells; ++c) free(all->id[c]);
    free(all->offset);
    free(all->corner);
    free(all->normal);
    free(all->id);
    free(all->line);
    free(all->fault);
    free(all->first_line);
}

/* --- 2. build ----------------------------------------------------------------------------------------------------- */

/* What the user could do about a refused cell. */
static const char *remedy(int status)
{
    switch (status) {
    case PATIC_OVERLAPS: return "; drop one of the two, or turn the one round that runs clockwise";
    case PATIC_MEETS_ITSELF:
        return "; a cell has one ring; if corners have been welded, a smaller --weld keeps them apart";
    case SURFMINK_CLOCKWISE: return "; --reverse always turns all outlines round";
    case SURFMINK_COINCIDENT_CORNERS: return "; --merge drops one of them";
    case SURFMINK_OPPOSITE_NORMALS: return "; the surface folds back here: more cells, or other normals";
    default: return "";
    }
}

static int status_of(const outlines *all, const patic *t, size_t c)
{
    return all->fault && all->fault[c] != SURFMINK_OK ? all->fault[c] : t->cell[c].status;
}

static const char *name_of(int status)
{
    return status >= FAULT_BAD_ORDER ? status_name(status) : patic_status_name(status);
}

static void complain(const request *q, const outlines *all, const patic *t, size_t c)
{
    int status = status_of(all, t, c);
    size_t n = all->offset[c + 1] - all->offset[c], bad = t->cell[c].bad;
    unsigned long line;
    if (!all->line || !all->first_line) return; /* there is no cell */
    line = status == t->cell[c].status && bad < n ? all->line[all->offset[c] + bad] : all->first_line[c];
    fprintf(stderr, "%s:%lu: cell ", q->reading.file[0], line);
    put_text(stderr, all->id[c], IN_TABLE);
    fprintf(stderr, ": %s: %s", name_of(status),
            status == SURFMINK_CROSSES_ITSELF && all->fault[c] == status
                ? "the edge that begins here crosses another one"
            : status >= FAULT_BAD_ORDER ? status_text(status)
                                        : patic_strerror(status));
    if (status == t->cell[c].status && t->cell[c].other != PATIC_NONE) {
        fputs(status == PATIC_OVERLAPS ? " already, to cell " : ", those of it and of cell ", stderr);
        put_text(stderr, all->id[t->cell[c].other], IN_TABLE);
    }
    fprintf(stderr, "%s\n", remedy(status));
}

/* The outlines as beyond/patic.h wants them, and the memory behind it. */
static void *build(patic *t, const request *q, const outlines *all)
{
    surfmink_outline view = surfmink_plane(all->corner, all->corners);
    void *memory = resize(NULL, patic_bytes(all->offset, all->cells, q->rank), 1);
    size_t c;
    if (all->surface == SPHERE)
        view = surfmink_sphere(all->corner, all->corners, q->reading.radius > 0 ? q->reading.radius : 1);
    if (all->surface == EMBEDDED) view = surfmink_embedded(all->corner, all->normal, all->corners);
    if (patic_build(t, &view, all->offset, all->cells, q->rank, q->weld, memory) != SURFMINK_OK)
        die("patic: cannot build the tissue");
    for (c = 0; c < t->cells && !q->reading.quiet; ++c)
        if (status_of(all, t, c) != SURFMINK_OK) complain(q, all, t, c);
    if (!q->reading.quiet && t->measured > 1 && 2 * t->isolated > t->measured)
        fprintf(stderr,
                "patic: WARNING: %lu of %lu cells share no edge with another, so there is no field between them, only "
                "single cells.\n"
                "patic: WARNING: If corners should be the same but differ a little, --weld D welds those nearer than D "
                "(now %g).\n"
                "patic: WARNING: If there are gaps, as between the cells of a segmentation, `outlines` makes shared "
                "outlines of a label image.\n",
                (unsigned long)t->isolated, (unsigned long)t->measured, t->tolerance);
    return memory;
}

/* --- 3. field ----------------------------------------------------------------------------------------------------- */

/* What the charges of one radius add up to. */
typedef struct totals {
    double radius, margin, order;
    long charge, boundary;
    unsigned long plus, minus;
} totals;

static double length_of(const ball *b, const patic *t)
{
    return b->in_cells ? b->size * t->spacing : b->size;
}

static totals add_up(const patic *t, double radius, const double *z)
{
    totals sum = {0, 1, 0, 0, 0, 0, 0};
    size_t i;
    sum.radius = radius;
    for (i = 0; i < t->components; ++i) {
        sum.charge += t->component[i].charge;
        sum.boundary += t->component[i].boundary;
    }
    for (i = 0; i < t->loops; ++i)
        if (t->loop[i].closed && t->loop[i].steps >= 3 && t->loop[i].order > 0)
            sum.margin = fmin(sum.margin, t->loop[i].margin);
    for (i = 0; i < t->defects; ++i) {
        if (t->defect[i].k > 0)
            ++sum.plus;
        else
            ++sum.minus;
        if (t->defect[i].core != PATIC_NONE) sum.margin = fmin(sum.margin, t->defect[i].margin);
    }
    for (i = 0; i < t->cells; ++i)
        if (t->cell[i].status == SURFMINK_OK) sum.order += hypot(z[2 * i], z[2 * i + 1]) / (double)t->measured;
    return sum;
}

/* The theorem is about surfaces: where cells are too large for the curvature, chords and normals are none of one. */
static void warn_if_too_coarse(const request *q, const outlines *all, const patic *t)
{
    size_t c, first;
    for (c = 0; c < t->components && !q->reading.quiet; ++c) {
        const patic_component *part = &t->component[c];
        if (part->charge + part->boundary == q->rank * part->chi) continue;
        for (first = 0; t->cell[first].component != c; ++first) continue;
        fputs("patic: WARNING: the component of cell ", stderr);
        put_text(stderr, all->id[first], IN_TABLE);
        fprintf(stderr,
                " (%lu cells) is too coarse for its curvature: its charges sum to %g%s, its Euler characteristic is "
                "%ld\n",
                (unsigned long)part->cells, (double)(part->charge + part->boundary) / q->rank,
                part->walks > 0 ? " with the boundary" : "", part->chi);
    }
}

static totals find_defects(const request *q, patic *t, double radius, const double *z, double *order)
{
    if (patic_coarsen(t, q->rank, radius, z, order) != SURFMINK_OK || patic_charges(t, q->rank, order) != SURFMINK_OK)
        die("patic: cannot measure the field");
    patic_defects(t, order);
    return add_up(t, radius, order);
}

/* --- 4. write ----------------------------------------------------------------------------------------------------- */

/* The formats of one run: numbers to all digits. */
static void put_value(FILE *out, const powers_of_ten *powers, double value)
{
    char text[32];
    fwrite(text, 1, (size_t)(write_number(powers, text, 17, value) - text), out);
}

static void put_vector(FILE *out, const powers_of_ten *powers, const double v[3])
{
    int k;
    for (k = 0; k < 3; ++k) {
        fputc('\t', out);
        if (v) put_value(out, powers, v[k] + 0.0); /* no -0 */
    }
}

static void write_cells(const request *q, const outlines *all, const patic *t, const double *mu, const double *z)
{
    powers_of_ten powers;
    size_t c;
    prepare_powers(&powers);
    puts("id\tn\tx\ty\tz\tnx\tny\tnz\tmu\torder\tdx\tdy\tdz\tneighbours\tboundary\tstatus");
    for (c = 0; c < t->cells; ++c) {
        const patic_cell *cell = &t->cell[c];
        double direction[3];
        int status = status_of(all, t, c), ok = status == SURFMINK_OK;
        put_text(stdout, all->id[c], IN_TABLE);
        printf("\t%lu", (unsigned long)(all->offset[c + 1] - all->offset[c]));
        put_vector(stdout, &powers, ok ? cell->centre : NULL);
        put_vector(stdout, &powers, ok ? cell->normal : NULL);
        putchar('\t');
        if (ok) put_value(stdout, &powers, mu[c]);
        putchar('\t');
        if (ok) put_value(stdout, &powers, hypot(z[2 * c], z[2 * c + 1]));
        put_vector(stdout, &powers, ok && patic_direction(t, q->rank, z, c, direction) ? direction : NULL);
        if (ok)
            printf("\t%lu\t%d", (unsigned long)cell->neighbours, cell->boundary);
        else
            printf("\t\t");
        printf("\t%s\n", name_of(status));
        if ((c & 1023) == 0) check_standard_output();
    }
}

static FILE *open_table(const char *name)
{
    FILE *file = fopen(name, "wb");
    if (!file) die("%s: %s", name, strerror(errno));
    return file;
}

static void close_table(FILE *file, const char *name)
{
    int failed = ferror(file);
    if (fclose(file) != 0 || failed) die("%s: cannot write: %s", name, strerror(errno));
}

static void write_defects(const request *q, const outlines *all, patic *t)
{
    powers_of_ten powers;
    FILE *out = open_table(q->defects);
    size_t *cells = (size_t *)resize(NULL, t->cells + 1, sizeof *cells), i, k, count;
    prepare_powers(&powers);
    fputs("x\ty\tz\tcharge\tcells\torder\tmargin\n", out);
    for (i = 0; i < t->defects; ++i) {
        const patic_defect *d = &t->defect[i];
        for (k = 0; k < 3; ++k) {
            put_value(out, &powers, d->x[k] + 0.0);
            fputc('\t', out);
        }
        put_value(out, &powers, (double)d->k / q->rank);
        fputc('\t', out);
        for (count = patic_around(t, d, cells), k = 0; k < count; ++k) {
            if (k > 0) fputc(',', out);
            if (all->id) put_text(out, all->id[cells[k]], IN_TABLE);
        }
        fputc('\t', out);
        put_value(out, &powers, d->order);
        fputc('\t', out);
        put_value(out, &powers, d->margin);
        fputc('\n', out);
    }
    free(cells);
    close_table(out, q->defects);
}

static void write_correlation(const request *q, const patic *t, const double *z)
{
    const size_t most = 10000000; /* bins: a tissue of 10^8 cells in a row; more is far-off cells */
    powers_of_ten powers;
    double width = t->spacing;
    size_t b, bins = width > 0 ? patic_correlation(t, q->rank, z, width, 0, NULL) : 0;
    patic_bin *bin;
    FILE *out;
    if (bins > most) die("%s: cells lie too far apart for --correlation", q->reading.file[0]);
    bin = (patic_bin *)resize(NULL, bins + 1, sizeof *bin);
    out = open_table(q->correlation);
    prepare_powers(&powers);
    if (bins > 0) patic_correlation(t, q->rank, z, width, bins, bin);
    fputs("r\tpairs\tG\n", out);
    for (b = 0; b < bins; ++b) {
        if (bin[b].pairs == 0) continue;
        put_value(out, &powers, ((double)b + 0.5) * width);
        fprintf(out, "\t%lu\t", (unsigned long)bin[b].pairs);
        if (bin[b].weight > 0) put_value(out, &powers, bin[b].sum / bin[b].weight);
        fputc('\n', out);
    }
    free(bin);
    close_table(out, q->correlation);
}

static void write_summary_of(const request *q, const patic *t, const totals *sum)
{
    fprintf(stderr, "rank\t%d\nradius\t%.6g\n", q->rank, sum->radius);
    if (t->spacing > 0) fprintf(stderr, "radius in mean distances\t%.6g\n", sum->radius / t->spacing);
    fprintf(stderr, "cells\t%lu\nrefused\t%lu\nisolated\t%lu\ncomponents\t%lu\nchi\t%ld\nboundary loops\t%lu\n",
            (unsigned long)t->measured, (unsigned long)(t->cells - t->measured), (unsigned long)t->isolated,
            (unsigned long)t->components, t->chi, (unsigned long)t->walks);
    fprintf(stderr, "sum of charges\t%.6g\nboundary sum\t%.6g\ndefects +\t%lu\ndefects -\t%lu\n",
            (double)sum->charge / q->rank, (double)sum->boundary / q->rank, sum->plus, sum->minus);
    fprintf(stderr, "smallest margin\t%.3g\nmean order\t%.4g\n", sum->margin, sum->order);
}

static void write_scan_line(const request *q, const patic *t, const totals *sum)
{
    powers_of_ten powers;
    prepare_powers(&powers);
    put_value(stdout, &powers, sum->radius);
    printf("\t%lu\t%lu\t%ld\t%lu\t", (unsigned long)t->measured, (unsigned long)t->components, t->chi,
           (unsigned long)t->walks);
    put_value(stdout, &powers, (double)sum->charge / q->rank);
    putchar('\t');
    put_value(stdout, &powers, (double)sum->boundary / q->rank);
    printf("\t%lu\t%lu\t", sum->plus, sum->minus);
    put_value(stdout, &powers, sum->margin);
    putchar('\t');
    put_value(stdout, &powers, sum->order);
    putchar('\n');
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

int main(int argc, char **argv)
{
    request q;
    outlines all;
    patic t;
    void *memory;
    double *z, *order, *mu;
    int i, refused;
    parse_request(&q, argc, argv);
    read_outlines(&all, &q);
    memory = build(&t, &q, &all);
    z = (double *)resize(NULL, 2 * t.cells + 1, sizeof *z);
    order = (double *)resize(NULL, 2 * t.cells + 1, sizeof *order);
    mu = (double *)resize(NULL, t.cells + 1, sizeof *mu);
    if (patic_field(&t, q.rank, z, mu) != SURFMINK_OK) die("patic: cannot measure the field");
    if (q.radii > 1) puts("radius\tcells\tcomponents\tchi\tloops\tcharges\tboundary\tplus\tminus\tmargin\torder");
    for (i = 0; i < q.radii; ++i) {
        totals sum = find_defects(&q, &t, length_of(&q.radius[i], &t), z, order);
        if (i == 0) warn_if_too_coarse(&q, &all, &t); /* so it is at every radius: steps cancel */
        if (q.radii > 1) write_scan_line(&q, &t, &sum);
        if (q.reading.summary) write_summary_of(&q, &t, &sum);
    }
    if (q.radii == 1) write_cells(&q, &all, &t, mu, order);
    fflush(stdout);
    check_standard_output();
    if (q.defects) write_defects(&q, &all, &t);
    if (q.correlation) write_correlation(&q, &t, z);
    if (q.reading.svg) write_field(&t, q.rank, order, q.by_order, &q.reading);
    refused = t.measured < t.cells;
    close_standard_output();
    free(q.reading.file);
    free(z);
    free(order);
    free(mu);
    free(memory);
    free_outlines(&all);
    return refused ? EXIT_REFUSED : EXIT_MEASURED;
}
