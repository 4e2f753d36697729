/* options.h - step 0 of the command: what the user asked for. */
#ifndef SURFMINK_COMMAND_OPTIONS_H
#define SURFMINK_COMMAND_OPTIONS_H

#include "../picture/camera.h"
#include "common.h"
#include "number.h"

#if HAS_POSIX
#include <sys/stat.h>
#endif

/* In the order of the words behind --surface and --reverse. */
enum surface { PLANE, SPHERE, EMBEDDED, AS_THE_COLUMNS_SAY };
enum reverse { REVERSE_AUTO, REVERSE_ALWAYS, REVERSE_NEVER };
enum crossings { CROSSINGS_AUTO, CROSSINGS_ALWAYS, CROSSINGS_NEVER };
enum directions { NO_DIRECTIONS, AT_FIRST_EDGE, AT_CENTER };
enum strokes_of { STROKES_ALONG, STROKES_ACROSS, STROKES_NOT_GIVEN };

/* Panels of a picture. */
enum { MOST_COLORS = 12, MOST_VIEWS = 6 };
enum look { LOOK_FRONT, LOOK_BACK, LOOK_FROM_GIVEN };

typedef struct viewpoint {
    enum look look;
    camera camera;  /* this and what follows: LOOK_FROM_GIVEN */
    double from[3]; /* as the user wrote it */
    int numbers;    /* 2: longitude and latitude, 3: a direction */
} viewpoint;

/* A column of the results that a picture shows. */
typedef struct quantity {
    char name[24];
    int rank; /* p of mu_p, theta_p, e_p_x and so on; 0: it has none */
} quantity;

typedef struct quantities {
    quantity of[MOST_COLORS];
    int count; /* 0: not given */
} quantities;

typedef struct options {
    int surface;         /* of enum surface */
    const char *id;      /* NAME[,NAME...]; NULL: not given */
    const char *columns; /* the same */
    int y_down;
    int estimate_normals;
    int parts;
    int repair;
    double merge_distance; /* of corners that --merge drops, a length; or if merge_relative, of the perimeter */
    int merge_relative;
    double resample;  /* 0: not given */
    int crossings;    /* of enum crossings */
    double radius;    /* 0: not given, 1 then */
    int max_rank;     /* P >= 1 */
    int transport;    /* of enum surfmink_transport */
    int order;        /* 2, or 4: the smooth curve through the corners */
    int error;        /* estimates how far off it */
    double sharp;     /* degrees: corners that turn by more are corners of the curve; 0: not given */
    int noise;        /* adds sigma_p, */
    double deviation; /* for noise of this standard deviation: a length, or if deviation_relative, of the mean edge */
    int deviation_relative;
    size_t smooth; /* passes */
    int reverse;   /* of enum reverse */
    int merge;
    int digits;
    int directions; /* of enum directions */
    int json;
    const char *svg, *histogram, *scatter, *ply; /* NULL: none */
    quantities color_by;                         /* what fills the picture */
    quantities histogram_of, scatter_of;
    int strokes; /* of enum strokes_of */
    viewpoint view[MOST_VIEWS];
    int views; /* 0: not given */
    const char *title, *unit;
    int summary;
    int quiet;
    const char **file;
    size_t files;
} options;

/* The strokes of pictures: along the eigenvectors of -lambda_p, as the paper draws them, or across those. */
static int is_along(const options *o)
{
    return o->strokes != STROKES_ACROSS;
}

static void usage_error(const char *format, ...) COMMAND_PRINTF(1, 2) COMMAND_DIES;
static void usage_error(const char *format, ...)
{
    va_list arguments;
    char text[2048];
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fputs(COMMAND_NAME ": ", stderr);
    put_harmless(stderr, text);
    fputs(" (" COMMAND_NAME " --help explains)\n", stderr);
    exit(EXIT_TROUBLE);
}

/* In pieces, for C99 promises no more than 4095 characters in one string. */
static const char *const help_text[] = {
    "surfmink - measures the p-fold symmetry of outlines on curved surfaces\n"
    "\n"
    "EXAMPLES\n"
    "  surfmink countries.tsv > mu.tsv                    # columns lon lat: great-circle polygons\n"
    "  surfmink --surface sphere points.tsv               # columns x y z: the same, in space\n"
    "  surfmink tissue.tsv --summary > mu.tsv             # columns x y z nx ny nz: any surface, with its normals\n"
    "  surfmink cells.off --svg cells.svg --color-by mu_5 # faces of a polygon mesh, and a picture of them\n"
    "  surfmink tissue.tsv --svg both.svg --color-by mu_2,mu_6 --histogram counts.svg > mu.tsv\n"
    "  surfmink --surface plane tissue.tsv                # the same cells as a microscope sees them from above\n"
    "  zcat big.tsv.gz | surfmink --json | jq 'select(.mu_6 > .9)'\n"
    "\n"
    "USAGE\n"
    "  surfmink [OPTION ...] [FILE ...]\n"
    "  No FILE, or -, is standard input. Results go to standard output, everything else to standard error.\n"
    "\n"
    "INPUT\n"
    "  A table has one corner a line. Tabs, semicolons, commas or blanks separate the fields, which may be quoted.\n"
    "  Blank lines and lines that begin with # are skipped. The first other line names the columns, in any order;\n"
    "  capitals and units in brackets do not matter:\n"
    "    x y                the plane (also: col, axis-1, position x)\n"
    "    row col            the plane, y is minus the row (also: axis-0)\n"
    "    lon lat            a sphere, degrees; great-circle arcs (also: longitude, lng, long, ra; latitude, dec)\n"
    "    x y z nx ny nz     any surface in space, with its outer normals; straight chords\n"
    "    x y z              needs --surface sphere (great-circle arcs; only the directions of the corners count)\n"
    "                       or --normals estimate\n"
    "    k                  order of the corners of an outline, whole numbers (also: vertex-index; K is an id)\n"
    "  All columns with a name such as cell, id, label, track, frame or name make the id together; without any, the\n"
    "  first column that is neither a coordinate nor a measured value. Successive lines with the same id are one\n"
    "  outline. Without an id, outlines end at a blank line, a line that begins with > or a row of NaNs, and their\n"
    "  ids count from 0 in each file. Corners run counter-clockwise, seen from outside; the first may be repeated at\n"
    "  the end. Decimal commas are read between tabs or semicolons. In a file without names, each line x,y,x,y,...\n"
    "  is an outline.\n"
    "\n"
    "  A polygon mesh (OFF, OBJ, PLY, STL, legacy VTK): each face is an outline, its id the number of the face.\n"
    "  Normals are those of the file, or area-weighted means over the faces at each vertex. Copies of vertices are\n"
    "  joined, and faces that run against their neighbours are turned round; standard error says so.\n"
    "  GeoJSON: each ring is an outline, with the id of its feature; parts get /0, /1, ..., holes /hole1.\n"
    "  The content of a file decides what it is, not its name.\n"
    "\n",
    "OUTPUT\n"
    "  One line an outline, tab separated: id n status L S area mu_1 ... mu_P theta_1 ... theta_P. Several files get\n"
    "  a column file in front.\n"
    "    n          number of corners, as measured\n"
    "    status     ok, or the reason why the outline was not measured; its numbers are then empty\n"
    "    L, area    length of the outline; area on its left (embedded: an estimate from corners and normals)\n"
    "    S          sum of the turning angles = 2 pi - enclosed curvature\n"
    "    mu_p       p-fold symmetry, 0 to 1\n"
    "    theta_p    its direction: an angle at the middle of edge 0, from the outward normal of the edge, turning\n"
    "               towards the edge; radians in (-pi/p, pi/p], empty where mu_p < 1e-12\n"
    "\n",
    "OPTIONS (--option value or --option=value; -- ends them)\n"
    "  --id NAME[,NAME...]    columns that make the id, or the property of GeoJSON features that does\n"
    "  --columns NAME[,NAME...]          names of the columns of a file without a line of names\n"
    "  --y-down               y points down, as in images: mirrors the outlines, so directions are those of the image\n"
    "  --normals given|estimate          estimate: normals of cells in space, from the corners that cells share\n"
    "                         (error of mu_p .0009 in the median, .065 at most), or of lone cells the best plane\n"
    "                         (.0013, .113)\n"
    "  --parts                each ring is an outline of its own, id/0, id/1, ...; a ring ends where its first corner\n"
    "                         comes again, or at a cut that leads to it and back. Rings that run the other way than\n"
    "                         the first are holes, id/1/hole\n"
    "  --surface plane|sphere|embedded   instead of the surface that the columns say; plane drops z\n"
    "  --radius R             radius of the sphere, default 1\n"
    "  --max-rank P           largest p, default 6\n"
    "  --transport corrected|parallel    parallel: classical transport to the middle of edge 0, for comparison\n"
    "  --order 2|4            4: measures the smooth curve through the corners, at fourth order. It needs exact\n"
    "                         corners and normals, about 20 to each bend. Shapes with corners need 2, the default,\n"
    "                         or --sharp. Not for meshes, whose normals are means\n"
    "  --error                adds columns error_L error_1 ... error_P after mu: estimated errors of L (relative) and\n"
    "                         mu_p against the smooth curve, from every second corner; 1 where none can be given\n"
    "  --sharp DEGREES        corners that turn by more are corners of the curve: for --order 4 and --error\n"
    "  --noise S              adds columns sigma_1 ... sigma_P after theta: the standard deviation of mu_p if corners\n"
    "                         move by chance, along the surface, by S in each direction. S is a length in the unit of\n"
    "                         the corners or of --radius, or 2%: of the mean edge. Good to 15 % up to p S = 0.3 mean\n"
    "                         edges, empty above 0.6; where mu_p is near 1 up to 1.7 times too large\n"
    "  --smooth K             smooths first: K passes of the 3-point mean, against the staircases of pixels\n"
    "  --reverse auto|always|never       auto turns clockwise outlines round, always all, never (default) none.\n"
    "                         So on the sphere auto measures the smaller side, whichever was meant\n"
    "  --merge                drops a corner that coincides with the one before, instead of refusing the outline\n"
    "  --merge DIST           also drops a corner nearer than DIST to it; 1e-9L: a fraction of the perimeter\n"
    "  --repair               removes spikes and seams, where the outline goes out and comes back the same way; with\n"
    "                         --merge DIST also those up to so wide\n"
    "  --resample STEP        first puts corners at equal distances of about STEP along the outline\n"
    "  --crossings auto|always|never     tests for edges that cross: outlines of up to 2,000 corners (default), all,\n"
    "                         or none\n"
    "  --digits N             significant digits, 1 to 17; default 17, which is exact\n"
    "  --directions           adds columns e_p_x e_p_y e_p_z: the direction theta_p as a vector\n"
    "  --directions center    the same at the centre of the outline; adds center_x center_y center_z, and\n"
    "                         coherence_p, 0 to 1: how well the edges agree\n"
    "  --json                 one JSON object a line instead of the table; null for what is undefined\n"
    "  --summary              mean, standard deviation, quartiles of each mu_p and count of dominant ranks, on\n"
    "                         standard error; keeps the mu of all outlines in memory\n"
    "  --quiet                no messages about refused outlines, no progress line\n"
    "  --help                 this page, as -h\n"
    "  --version\n"
    "\n",
    "PICTURES (options, too; all of them keep what they draw in memory)\n"
    "  --svg FILE             draws the outlines, filled by mu_p; strokes show the p directions of each at its centre\n"
    "  --strokes along|across            along (default): for mu_2 along the long axis, for mu_3, mu_4, ... towards\n"
    "                         corners. across: across the sides, as theta_p and --directions. None where mu_p is\n"
    "                         below 5 % of the end of its bar\n"
    "  --color-by COLUMN,...  what fills the outlines, default mu_2: columns of the results, as mu_6 (or only 6), "
    "area,\n"
    "                         n; several: a panel and a bar for each. theta_p: blue below 0, red above, both ends "
    "alike\n"
    "  --histogram FILE       draws how many outlines have which mu_1 ... mu_P\n"
    "  --histogram-of COLUMN,...         or which other columns; 12 at most\n"
    "  --scatter FILE         draws a point for each outline: mu_2 to the right, mu_P upwards\n"
    "  --scatter-of COLUMN,COLUMN        or two other columns\n"
    "  --view LON,LAT         from where to look: from above a point of the sphere,\n"
    "  --view X,Y,Z           from a direction,\n"
    "  --view front|back      from where most can be seen (default), or behind that, or behind the --view before.\n"
    "                         Several --view: a panel for each\n"
    "  --title TEXT           title of the pictures\n"
    "  --unit TEXT            unit of the corners, at the scale bar: um, km\n"
    "  --ply FILE             the outlines as polygons with colours and mu_1 ... mu_P, for ParaView, MeshLab, Blender\n"
    "\n",
    "REFUSALS AND EXIT STATUS\n"
    "  An outline that cannot be measured is reported on standard error as FILE:LINE: id: reason; the others are\n"
    "  still measured. Warnings tell the first of each kind; the last line counts them.\n"
    "  Exit status 0: all outlines were measured. 2: some were refused. 1: a wrong option, or a file\n"
    "  that cannot be read or written, is malformed, or does not name its columns; the run stops there. If the reader\n"
    "  of a pipe has gone (surfmink ... | head), the signal SIGPIPE ends the run without a message.\n"
    "\n"
    "MEMORY\n"
    "  grows with the largest outline, not with the table. Meshes, GeoJSON, --normals estimate, --summary and\n"
    "  pictures keep more. A line may be 64 MiB long.\n"};

/* To standard output, and gone: what was asked for must not get lost unnoticed in a full disk or a closed pipe. */
static void answer(const char *const *text, size_t pieces) COMMAND_DIES;
static void answer(const char *const *text, size_t pieces)
{
    size_t i;
    for (i = 0; i < pieces; ++i) fputs(text[i], stdout);
    fflush(stdout);
    check_standard_output();
    close_standard_output();
    exit(EXIT_MEASURED);
}

/* --- values ------------------------------------------------------------------------------------------------------- */

/* Which of the words is it? */
static int parse_choice(const char *name, const char *value, const char *const *word, int words)
{
    int i;
    for (i = 0; i < words; ++i)
        if (strcmp(value, word[i]) == 0) return i;
    if (words == 2) usage_error("--%s is %s or %s, not '%s'", name, word[0], word[1], value);
    usage_error("--%s is %s, %s or %s, not '%s'", name, word[0], word[1], word[2], value);
}

static int parse_between(const char *name, const char *value, size_t least, size_t most)
{
    size_t number;
    if (!parse_count(value, &number) || number < least || number > most)
        usage_error("--%s is a whole number from %lu to %lu, not '%s'", name, (unsigned long)least, (unsigned long)most,
                    value);
    return (int)number;
}

/* Half a turn is the most there is. */
static double parse_sharp(const char *value)
{
    double degrees;
    if (!parse_number(NULL, value, &degrees) || !(degrees > 0 && degrees < 180))
        usage_error("--sharp is an angle between 0 and 180 degrees, not '%s'", value);
    return degrees;
}

static double parse_radius(const char *value)
{
    double radius;
    if (!parse_number(NULL, value, &radius) || !(radius > 0 && radius <= 1e100))
        usage_error("--radius is a positive number, not '%s'", value);
    return radius;
}

static double parse_step(const char *value)
{
    double step;
    if (!parse_number(NULL, value, &step) || !(step > 0 && step <= 1e100))
        usage_error("--resample is a positive length, not '%s'", value);
    return step;
}

/* A length, or a fraction of the perimeter: 1e-9L. */
static int parse_distance(const char *text, double *distance, int *relative)
{
    const char *end = read_number(NULL, text, distance);
    if (!end || !(*distance >= 0 && *distance <= 1e100)) return 0;
    *relative = *end == 'L';
    return end[*relative] == '\0' && !(*relative && *distance >= 0.5);
}

/* A length, or a part of the mean edge: 2%. */
static void parse_noise(options *o, const char *value)
{
    const char *end = read_number(NULL, value, &o->deviation);
    o->deviation_relative = end && *end == '%';
    if (!end || end[o->deviation_relative] != '\0' || !(o->deviation >= 0 && o->deviation <= 1e100))
        usage_error("--noise is a length, or a part of the mean edge as 2%%, and not negative, not '%s'", value);
    if (o->deviation_relative) o->deviation /= 100;
    o->noise = 1;
}

/* The digits behind the first _ of a name: p of mu_p. */
static int rank_of(const char *name)
{
    const char *at = strchr(name, '_');
    char digits[24];
    size_t rank, length;
    if (!at) return 0;
    length = strspn(at + 1, "0123456789");
    if (at[1 + length] != '\0' && at[1 + length] != '_') return 0;
    digits[0] = '\0';
    strncat(digits, at + 1, length < sizeof digits ? length : 0);
    return parse_count(digits, &rank) && rank <= INT32_MAX ? (int)rank : 0;
}

/* Names of columns with commas between them; 5 is mu_5. */
static void parse_quantities(const char *name, const char *value, quantities *list, int most)
{
    const char *at = value;
    size_t length;
    for (list->count = 0;; at += length + 1) {
        quantity *q = &list->of[list->count];
        length = strcspn(at, ",");
        if (list->count == most) usage_error("--%s takes at most %d columns", name, most);
        if (length == 0 || length + 3 >= sizeof q->name)
            usage_error("--%s takes columns of the results, as mu_2 or mu_2,area, not '%s'", name, value);
        strcpy(q->name, strspn(at, "0123456789") == length ? "mu_" : "");
        strncat(q->name, at, length);
        q->rank = rank_of(q->name);
        ++list->count;
        if (at[length] == '\0') return;
    }
}

/* Numbers with commas between them; returns how many, 0 if they are none or too many. */
static int parse_list(const char *value, double *number, int most)
{
    const char *end;
    int count = 0;
    for (;; value = end + 1) {
        if (count == most) return 0;
        end = read_number(NULL, value, &number[count]);
        if (!end || !(fabs(number[count]) <= 1e100)) return 0;
        ++count;
        if (*end == '\0') return count;
        if (*end != ',') return 0;
    }
}

static void parse_view(options *o, const char *value)
{
    double v[3] = {0, 0, 0};
    viewpoint *new_view = &o->view[o->views];
    int count = parse_list(value, v, 3);
    if (o->views == MOST_VIEWS) usage_error("--view can be given %d times at most", MOST_VIEWS);
    ++o->views;
    new_view->look = LOOK_FROM_GIVEN;
    new_view->numbers = count;
    memcpy(new_view->from, v, sizeof v);
    if (strcmp(value, "front") == 0)
        new_view->look = LOOK_FRONT;
    else if (strcmp(value, "back") == 0)
        new_view->look = LOOK_BACK;
    else if (count == 2) {
        if (!look_from_lonlat(&new_view->camera, v[0], v[1]))
            usage_error("--view %s: a latitude lies in [-90, 90]", value);
    } else if (count == 3 && hypot(hypot(v[0], v[1]), v[2]) > 0)
        look_from(&new_view->camera, v);
    else
        usage_error("--view is LON,LAT in degrees, a direction X,Y,Z, front or back, not '%s'", value);
}

/* --- the command line --------------------------------------------------------------------------------------------- */

enum option {
    OPTION_SURFACE,
    OPTION_RADIUS,
    OPTION_MAX_RANK,
    OPTION_TRANSPORT,
    OPTION_ORDER,
    OPTION_SHARP,
    OPTION_NOISE,
    OPTION_SMOOTH,
    OPTION_REVERSE,
    OPTION_DIGITS,
    OPTION_SVG,
    OPTION_HISTOGRAM,
    OPTION_HISTOGRAM_OF,
    OPTION_SCATTER,
    OPTION_SCATTER_OF,
    OPTION_PLY,
    OPTION_COLOR_BY,
    OPTION_STROKES,
    OPTION_VIEW,
    OPTION_TITLE,
    OPTION_UNIT,
    OPTION_ID,
    OPTION_COLUMNS,
    OPTION_NORMALS,
    OPTION_RESAMPLE,
    OPTION_CROSSINGS,
    OPTION_DIRECTIONS, /* with or without a value */
    OPTION_MERGE,      /* the same */
    OPTION_PARTS,      /* from here on without one */
    OPTION_REPAIR,
    OPTION_Y_DOWN,
    OPTION_ERROR,
    OPTION_JSON,
    OPTION_SUMMARY,
    OPTION_QUIET,
    OPTION_HELP,
    OPTION_VERSION,
    OPTIONS
};

/* In this order. */
static const char *const option_name[OPTIONS] = {
    "surface",  "radius",    "max-rank",   "transport", "order",        "sharp",   "noise",      "smooth",
    "reverse",  "digits",    "svg",        "histogram", "histogram-of", "scatter", "scatter-of", "ply",
    "color-by", "strokes",   "view",       "title",     "unit",         "id",      "columns",    "normals",
    "resample", "crossings", "directions", "merge",     "parts",        "repair",  "y-down",     "error",
    "json",     "summary",   "quiet",      "help",      "version"};

static void set_option(options *o, int option, const char *value)
{
    static const char *const surfaces[] = {"plane", "sphere", "embedded"};
    static const char *const transports[] = {"corrected", "parallel"};
    static const char *const orders[] = {"2", "4"};
    static const char *const reversals[] = {"auto", "always", "never"};
    static const char *const places[] = {"edge", "center", "centre"};
    static const char *const estimates[] = {"estimate", "given"};
    static const char *const extents[] = {"auto", "always", "never"};
    static const char *const ways[] = {"along", "across"};
    static const char *const version[] = {"surfmink " SURFMINK_VERSION "\n"};
    const char *name = option_name[option];
    switch (option) {
    case OPTION_SURFACE: o->surface = parse_choice(name, value, surfaces, 3); break;
    case OPTION_RADIUS: o->radius = parse_radius(value); break;
    case OPTION_MAX_RANK: o->max_rank = parse_between(name, value, 1, 1000000); break;
    case OPTION_TRANSPORT: o->transport = parse_choice(name, value, transports, 2); break;
    case OPTION_ORDER: o->order = parse_choice(name, value, orders, 2) ? 4 : 2; break;
    case OPTION_SHARP: o->sharp = parse_sharp(value); break;
    case OPTION_ERROR: o->error = 1; break;
    case OPTION_NOISE: parse_noise(o, value); break;
    case OPTION_SMOOTH: o->smooth = (size_t)parse_between(name, value, 0, 1000000); break;
    case OPTION_REVERSE: o->reverse = parse_choice(name, value, reversals, 3); break;
    case OPTION_DIGITS: o->digits = parse_between(name, value, 1, 17); break;
    case OPTION_SVG: o->svg = value; break;
    case OPTION_HISTOGRAM: o->histogram = value; break;
    case OPTION_HISTOGRAM_OF: parse_quantities(name, value, &o->histogram_of, MOST_COLORS); break;
    case OPTION_SCATTER: o->scatter = value; break;
    case OPTION_SCATTER_OF: parse_quantities(name, value, &o->scatter_of, 2); break;
    case OPTION_PLY: o->ply = value; break;
    case OPTION_COLOR_BY: parse_quantities(name, value, &o->color_by, MOST_COLORS); break;
    case OPTION_STROKES: o->strokes = parse_choice(name, value, ways, 2); break;
    case OPTION_VIEW: parse_view(o, value); break;
    case OPTION_TITLE: o->title = value; break;
    case OPTION_UNIT: o->unit = value; break;
    case OPTION_ID: o->id = value; break;
    case OPTION_COLUMNS: o->columns = value; break;
    case OPTION_NORMALS: o->estimate_normals = parse_choice(name, value, estimates, 2) == 0; break;
    case OPTION_RESAMPLE: o->resample = parse_step(value); break;
    case OPTION_CROSSINGS: o->crossings = parse_choice(name, value, extents, 3); break;
    case OPTION_PARTS: o->parts = 1; break;
    case OPTION_REPAIR: o->repair = 1; break;
    case OPTION_Y_DOWN: o->y_down = 1; break;
    case OPTION_MERGE:
        o->merge = 1;
        if (value && !parse_distance(value, &o->merge_distance, &o->merge_relative))
            usage_error("--merge takes a distance, or a fraction of the perimeter as 1e-9L, not '%s'", value);
        break;
    case OPTION_DIRECTIONS:
        o->directions = value && parse_choice(name, value, places, 3) > 0 ? AT_CENTER : AT_FIRST_EDGE;
        break;
    case OPTION_JSON: o->json = 1; break;
    case OPTION_SUMMARY: o->summary = 1; break;
    case OPTION_QUIET: o->quiet = 1; break;
    case OPTION_HELP: answer(help_text, sizeof help_text / sizeof *help_text);
    case OPTION_VERSION: answer(version, 1);
    default: break;
    }
}

/* The option that `text`, up to a possible =, names. */
static int find_option(const char *text)
{
    size_t length = strcspn(text, "=");
    int i;
    if (strcmp(text, "-h") == 0) return OPTION_HELP;
    for (i = 0; i < OPTIONS; ++i)
        if (length > 2 && strncmp(text, "--", 2) == 0 && strlen(option_name[i]) == length - 2 &&
            strncmp(text + 2, option_name[i], length - 2) == 0)
            return i;
    usage_error("unknown option '%.*s'", (int)length, text);
}

/* What may follow --directions. Another word is a file, or the next option. */
static int is_place(const char *text)
{
    return text && (strcmp(text, "edge") == 0 || strcmp(text, "center") == 0 || strcmp(text, "centre") == 0);
}

/* Takes one option from the front of the arguments; returns how many of them it was. */
static int take_option(options *o, char **argument)
{
    int option = find_option(argument[0]), relative;
    double distance;
    const char *equals = strchr(argument[0], '=');
    if ((option == OPTION_DIRECTIONS && !equals && !is_place(argument[1])) ||
        (option == OPTION_MERGE && !equals && !(argument[1] && parse_distance(argument[1], &distance, &relative)))) {
        set_option(o, option, NULL);
        return 1;
    }
    if (option >= OPTION_PARTS) {
        if (equals) usage_error("--%s takes no value", option_name[option]);
        set_option(o, option, NULL);
        return 1;
    }
    if (!equals && !argument[1]) usage_error("--%s needs a value", option_name[option]);
    set_option(o, option, equals ? equals + 1 : argument[1]);
    return equals ? 1 : 2;
}

/* What is drawn, by the names of the options. */
enum { PICTURES = 4 };
static const char *const picture_option[PICTURES] = {"svg", "histogram", "scatter", "ply"};

static const char *picture_file(const options *o, int i)
{
    return i == 0 ? o->svg : i == 1 ? o->histogram : i == 2 ? o->scatter : o->ply;
}

#if HAS_POSIX
/* The folder that a file is in, or would be. */
static int stat_folder(const char *name, struct stat *folder)
{
    const char *slash = strrchr(name, '/');
    size_t length = slash ? (size_t)(slash - name) + 1 : 0;
    char *text = (char *)resize(NULL, length + 2, 1);
    int known;
    memcpy(text, name, length);
    strcpy(text + length, ".");
    known = stat(text, folder) == 0;
    free(text);
    return known;
}
#endif

/* Would both names write to one file? Not by their names, but by device and inode; of files that are yet to be made, by
   those of their folders. Devices such as /dev/null bear it. */
static int is_same_output(const char *a, const char *b)
{
#if HAS_POSIX
    struct stat at_a, at_b;
    const char *base_a = strrchr(a, '/'), *base_b = strrchr(b, '/');
    int is_a = stat(a, &at_a) == 0, is_b = stat(b, &at_b) == 0;
    if (is_a != is_b) return 0;
    if (is_a) return S_ISREG(at_a.st_mode) && at_a.st_dev == at_b.st_dev && at_a.st_ino == at_b.st_ino;
    if (strcmp(base_a ? base_a + 1 : a, base_b ? base_b + 1 : b) != 0) return 0;
    if (!stat_folder(a, &at_a) || !stat_folder(b, &at_b)) return strcmp(a, b) == 0;
    return at_a.st_dev == at_b.st_dev && at_a.st_ino == at_b.st_ino;
#else
    return strcmp(a, b) == 0;
#endif
}

static int is_standard_output(const char *name)
{
#if HAS_POSIX
    struct stat file, out;
    return stat(name, &file) == 0 && fstat(fileno(stdout), &out) == 0 && S_ISREG(out.st_mode) &&
           file.st_dev == out.st_dev && file.st_ino == out.st_ino;
#else
    (void)name;
    return 0;
#endif
}

static void check_ranks(const char *name, const quantities *list, const options *o)
{
    int i;
    for (i = 0; i < list->count; ++i)
        if (list->of[i].rank > o->max_rank)
            usage_error("--%s %s needs --max-rank %d", name, list->of[i].name, list->of[i].rank);
}

static void add_quantity(quantities *list, int rank)
{
    quantity *q = &list->of[list->count++];
    snprintf(q->name, sizeof q->name, "mu_%d", rank);
    q->rank = rank;
}

/* What is shown if nobody asks for other columns. */
static void choose_quantities(options *o)
{
    int p;
    if (o->color_by.count == 0) add_quantity(&o->color_by, o->max_rank < 2 ? 1 : 2);
    for (p = 1; p <= o->max_rank && o->histogram_of.count == p - 1 && p <= MOST_COLORS; ++p)
        add_quantity(&o->histogram_of, p);
    if (o->scatter_of.count > 0) return;
    add_quantity(&o->scatter_of, o->max_rank < 3 ? 1 : 2);
    add_quantity(&o->scatter_of, o->max_rank);
}

/* What no single option can know to be wrong. An option without effect would be taken for one that has been obeyed. */
static void check_options(options *o)
{
    int i, j;
    for (i = 0; i < PICTURES; ++i) {
        const char *name = picture_file(o, i);
        if (!name) continue;
        if (*name == '\0' || strcmp(name, "-") == 0) usage_error("--%s needs the name of a file", picture_option[i]);
        if (is_standard_output(name))
            usage_error("--%s would write the file that is standard output", picture_option[i]);
        for (j = 0; j < i; ++j)
            if (picture_file(o, j) && is_same_output(name, picture_file(o, j)))
                usage_error("--%s and --%s would write the same file", picture_option[j], picture_option[i]);
    }
    if (!o->svg && !o->ply && o->color_by.count > 0) usage_error("--color-by is for outlines: add --svg FILE");
    if (!o->histogram && o->histogram_of.count > 0) usage_error("--histogram-of is for --histogram FILE");
    if (!o->scatter && o->scatter_of.count > 0) usage_error("--scatter-of is for --scatter FILE");
    if (!o->svg && o->strokes != STROKES_NOT_GIVEN) usage_error("--strokes is for pictures: add --svg FILE");
    if (!o->svg && o->views > 0) usage_error("--view is for pictures: add --svg FILE");
    if (!o->svg && !o->histogram && !o->scatter && o->title) usage_error("--title is for pictures: add --svg FILE");
    if (!o->svg && o->unit) usage_error("--unit is for pictures: add --svg FILE");
    check_ranks("color-by", &o->color_by, o);
    check_ranks("histogram-of", &o->histogram_of, o);
    check_ranks("scatter-of", &o->scatter_of, o);
    if (o->scatter && (o->scatter_of.count == 1 || (o->scatter_of.count == 0 && o->max_rank < 2)))
        usage_error("--scatter needs two columns, as --scatter-of mu_2,area");
    if (o->svg && o->views * o->color_by.count > MOST_COLORS)
        usage_error("--svg draws %d panels at most: fewer --view, or fewer columns", MOST_COLORS);
    if (o->transport == SURFMINK_PARALLEL && (o->order == 4 || o->error))
        usage_error("--transport parallel has neither --order 4 nor --error");
    if (o->noise && (o->order == 4 || o->transport == SURFMINK_PARALLEL))
        usage_error("--noise has neither --order 4 nor --transport parallel");
    if (o->noise && (o->smooth > 0 || o->resample > 0))
        usage_error(
            "--noise is that of corners as measured: independent, which it is not after --smooth or --resample");
    if (o->estimate_normals && (o->surface == PLANE || o->surface == SPHERE))
        usage_error("--normals estimate is for cells in space, not for --surface %s",
                    o->surface == PLANE ? "plane" : "sphere");
    if (o->sharp > 0 && o->order == 2 && !o->error) usage_error("--sharp is for --order 4 and --error");
}

static void parse_options(options *o, int argc, char **argv)
{
    static const char *const standard_input = "-";
    int i = 1, only_files = 0;
    memset(o, 0, sizeof *o);
    o->surface = AS_THE_COLUMNS_SAY;
    o->max_rank = 6;
    o->transport = SURFMINK_CORRECTED;
    o->order = 2;
    o->reverse = REVERSE_NEVER;
    o->strokes = STROKES_NOT_GIVEN;
    o->digits = 17;
    o->file = (const char **)resize(NULL, (size_t)argc + 1, sizeof *o->file);
    while (i < argc) {
        if (!only_files && strcmp(argv[i], "--") == 0) {
            only_files = 1;
            ++i;
        } else if (only_files || argv[i][0] != '-' || argv[i][1] == '\0')
            o->file[o->files++] = argv[i++];
        else
            i += take_option(o, argv + i);
    }
    if (o->files == 0) o->file[o->files++] = standard_input;
    check_options(o);
    choose_quantities(o);
}

#endif
