/* outlines.c - outlines of the cells of a label image, in the plane or on a curved chart.

   A segmentation gives every pixel the number of its cell. This command draws the outlines as exactly as the pixels
   tell, and surfmink measures them:

     outlines labels.tif | surfmink

   compile   cc outlines.c -o outlines -lm
   manual    ./outlines --help

   It only reads arguments, calls the headers in image/, and prints: read.h file -> pixels, regions.h pixels -> regions,
   trace.h regions -> boundaries, fit.h boundaries -> points, chart.h points -> space, outline.h all of these ->
   outlines, write.h outlines -> text, paint.h numbers -> pixels. */

#include "command/posix.h"

#include "image/paint.h"
#include "image/read.h"
#include "image/write.h"

static const char *const help[] = {
    "outlines - outlines of the cells of a label image, as a table for surfmink\n"
    "\n"
    "EXAMPLES\n"
    "  outlines labels.tif | surfmink                                   how elongated, how hexagonal is every cell?\n"
    "  outlines labels.tif --spacing 0.2 | surfmink                     with pixels of 0.2 micrometres\n"
    "  outlines labels.tif --positions xyz.tif --normals n.tif | surfmink     on a curved surface\n"
    "  outlines labels.tif --points junctions | surfmink                straight sides from junction to junction\n"
    "  surfmink cells.tsv | outlines labels.tif --paint - --column mu_6 --out mu_6.tif   mu_6 as an image\n"
    "\n"
    "USAGE\n"
    "  outlines [OPTIONS] LABELS\n"
    "  outlines LABELS --paint TABLE --column NAME --out FILE\n"
    "\n"
    "  LABELS  an image with the number of its cell in every pixel, 0 where there is none: TIFF without compression,\n"
    "          NPY or PGM, whatever the name; - is standard input\n"
    "\n",
    "OPTIONS (--option V or --option=V)\n"
    "  --points curve|junctions|pixels  joins junctions by smooth curves (default), by straight edges, for tissues\n"
    "                        with straight sides, or by the sides of the pixels\n"
    "  --positions FILE      the position of every pixel in space: x, y and z as pages, planes or channels, NaN where\n"
    "                        there is none\n"
    "  --normals FILE        the outward normal of every pixel, in the same form; without it normals are made from\n"
    "                        the positions\n"
    "  --flip                reverses all normals\n"
    "  --spacing S[,S]       width and height of a pixel in the plane (default 1)\n"
    "  --wrap x              the image closes on itself from right to left, as on a cylinder\n"
    "  --lines               0 is also a line between cells, up to 3 pixels wide; its pixels go to the nearest cell\n"
    "  --background N        the label N is no cell, as 0 is none\n"
    "  --weld                corners nearer than a millionth of the mean edge become one\n"
    "  --off FILE            also writes a polygon mesh, in which neighbours share their points; with normals on a\n"
    "                        surface (NOFF)\n"
    "  --report FILE         also writes a table with a line for every label: pixels, corners, and why it is left out\n"
    "  --digits N            significant digits, 1 to 17; default 17, which is exact\n"
    "  --paint TABLE         draws no outlines, but an image: every pixel of a cell gets a number from this table of\n"
    "                        surfmink\n"
    "  --column NAME         which column of that table, as mu_6\n"
    "  --out FILE            the image: TIFF, 32-bit floats, NaN where there is no number\n"
    "  --help\n"
    "\n",
    "OUTPUT\n"
    "  A table: cell k x y, or cell k x y z nx ny nz, tab separated, counter-clockwise about the normal. x is the\n"
    "  column and y minus the row, times the spacing, so the image is not mirrored. Neighbours share the points\n"
    "  between them, to the bit.\n"
    "  Left out, and named on standard error: cells that are cut by the border of the image, run round a wrapped\n"
    "  image, have several parts, reach beyond the rim of the chart, lie where it is folded, or have fewer than three\n"
    "  junctions, or such as run the other way round, with --points junctions. Measured, and named: cells with holes,\n"
    "  by the outer outline, and cells of fewer than 20 pixels.\n"
    "\n"
    "EXIT STATUS\n"
    "  0: all cells have an outline. 1: a wrong option, or a file that is unreadable or malformed; nothing is\n"
    "  written. 2: some cells are left out.\n"};

static int complain(const char *what, const char *about)
{
    image_error line = {""};
    image_fail(&line, NULL, "outlines: %s%s%.100s (outlines --help shows examples)", what, about ? ": " : "",
               about ? about : "");
    fprintf(stderr, "%s\n", line.text);
    return 1;
}

/* --- options ------------------------------------------------------------------------------------------------------ */

typedef struct options {
    const char *labels, *positions, *normals, *off, *report, *paint, *column, *out;
    enum fit_points points;
    double spacing[2], background;
    int has_spacing, has_points, wraps, lines, flips, welds, digits, has_help;
} options;

/* A text that begins with a finite number; behind it comes `end`. */
static int number(const char *text, double *x, const char **end)
{
    char *behind;
    *x = strtod(text, &behind);
    *end = behind;
    return behind != text && fabs(*x) <= 1e100;
}

static int parse_spacing(const char *text, options *o)
{
    const char *end;
    o->has_spacing = 1;
    if (!number(text, &o->spacing[0], &end)) return 0;
    o->spacing[1] = o->spacing[0];
    if (*end == ',' && !number(end + 1, &o->spacing[1], &end)) return 0;
    return !*end && o->spacing[0] >= 1e-100 && o->spacing[1] >= 1e-100;
}

static int parse_points(const char *text, options *o)
{
    static const char *const word[3] = {"junctions", "curve", "pixels"};
    int i = 0;
    o->has_points = 1;
    while (i < 3 && strcmp(text, word[i]) != 0) ++i;
    o->points = i == 0 ? FIT_JUNCTIONS : i == 1 ? FIT_CURVE : FIT_PIXELS;
    return i < 3;
}

/* An option with a value. Returns what is wrong with it, or NULL. */
static const char *set_value(options *o, const char *name, const char *value)
{
    const char *end;
    double digits;
    if (!strcmp(name, "--points")) return parse_points(value, o) ? NULL : "--points wants curve, junctions or pixels";
    if (!strcmp(name, "--spacing"))
        return parse_spacing(value, o) ? NULL : "--spacing wants one positive number, or two with a comma";
    if (!strcmp(name, "--wrap")) {
        o->wraps = 1;
        return strcmp(value, "x") == 0 ? NULL : "--wrap wants x";
    }
    if (!strcmp(name, "--background"))
        return number(value, &o->background, &end) && !*end && !(o->background > floor(o->background))
                   ? NULL
                   : "--background wants a label, a whole number";
    if (!strcmp(name, "--digits")) {
        if (!number(value, &digits, &end) || *end || digits < 1 || digits > 17 || digits > floor(digits))
            return "--digits wants 1 to 17";
        o->digits = (int)digits;
        return NULL;
    }
    if (!*value) return "a name is wanted";
    return NULL;
}

/* Where the name of a file, or of a column, goes; NULL for other options. */
static const char **file_of(options *o, const char *name)
{
    if (!strcmp(name, "--positions")) return &o->positions;
    if (!strcmp(name, "--normals")) return &o->normals;
    if (!strcmp(name, "--off")) return &o->off;
    if (!strcmp(name, "--report")) return &o->report;
    if (!strcmp(name, "--paint")) return &o->paint;
    if (!strcmp(name, "--column")) return &o->column;
    return !strcmp(name, "--out") ? &o->out : NULL;
}

static int *switch_of(options *o, const char *name)
{
    if (!strcmp(name, "--lines")) return &o->lines;
    if (!strcmp(name, "--flip")) return &o->flips;
    if (!strcmp(name, "--weld")) return &o->welds;
    return !strcmp(name, "--help") ? &o->has_help : NULL;
}

static int has_value(options *o, const char *name)
{
    return file_of(o, name) || !strcmp(name, "--points") || !strcmp(name, "--spacing") || !strcmp(name, "--wrap") ||
           !strcmp(name, "--background") || !strcmp(name, "--digits");
}

static int parse(int count, char **argument, options *o)
{
    int i;
    for (i = 1; i < count; ++i) {
        char *name = argument[i], *value = name[0] == '-' ? strchr(name, '=') : NULL;
        const char *wrong;
        if (value) *value++ = '\0'; /* --points=V is --points V */
        if (name[0] != '-' || !name[1]) {
            if (o->labels) return complain("one label image at a time, this is one file more", name);
            o->labels = name;
        } else if (switch_of(o, name)) {
            if (value) return complain("no value is wanted behind", name);
            *switch_of(o, name) = 1;
        } else if (!has_value(o, name)) {
            return complain("unknown option", name);
        } else if (!value && i + 1 == count) {
            return complain("a value is missing behind", name);
        } else {
            if (!value) value = argument[++i];
            wrong = set_value(o, name, value);
            if (wrong) return complain(wrong, value);
            if (file_of(o, name)) *file_of(o, name) = value;
        }
    }
    return 0;
}

/* Are these names of one file? */
static int is_one_file(const char *a, const char *b)
{
#if HAS_POSIX
    struct stat x, y;
    if (stat(a, &x) == 0 && stat(b, &y) == 0) return S_ISREG(x.st_mode) && x.st_dev == y.st_dev && x.st_ino == y.st_ino;
#endif
    return strcmp(a, b) == 0;
}

/* What is written must be nothing that is read, nor be written twice. */
static int check_files(const options *o)
{
    const char *file[7];
    int i, k;
    file[0] = o->labels;
    file[1] = o->positions;
    file[2] = o->normals;
    file[3] = o->paint;
    file[4] = o->off;
    file[5] = o->report;
    file[6] = o->out;
    for (i = 4; i < 7; ++i) {
        if (file[i] && !strcmp(file[i], "-")) return complain("a file is wanted, not standard output", file[i]);
        for (k = 0; k < i; ++k)
            if (file[i] && file[k] && is_one_file(file[i], file[k]))
                return complain("this file would be overwritten", file[i]);
    }
    for (i = 1; i < 4; ++i)
        for (k = 0; k < i; ++k)
            if (file[i] && file[k] && !strcmp(file[i], "-") && !strcmp(file[k], "-"))
                return complain("standard input is one file", NULL);
    return 0;
}

/* What no single option can know to be wrong. */
static int check(const options *o)
{
    int drawing = o->positions || o->normals || o->off || o->report || o->has_spacing || o->has_points || o->wraps ||
                  o->flips || o->welds;
    if (!o->labels) return complain("there is no label image", NULL);
    if ((o->column || o->out) && !o->paint) return complain("--column and --out go with --paint TABLE", NULL);
    if (o->paint && (!o->column || !o->out)) return complain("--paint TABLE wants --column NAME and --out FILE", NULL);
    if (o->paint && drawing)
        return complain("--paint draws no outlines: of the other options only --lines and "
                        "--background go with it",
                        NULL);
    if (o->normals && !o->positions) return complain("--normals without --positions", o->normals);
    if (o->flips && !o->positions) return complain("--flip is for normals: there are none without --positions", NULL);
    if (o->has_spacing && o->positions)
        return complain("--spacing is for the plane: with --positions, these tell where a pixel is", NULL);
    if (o->off && o->wraps && !o->positions)
        return complain("--off with --wrap needs --positions: in the plane the two sides do not meet", NULL);
    return check_files(o);
}

/* --- the command -------------------------------------------------------------------------------------------------- */

/* All that a run holds. */
typedef struct run {
    const options *o;
    image labels, positions, normals;
    regions map;
    trace graph;
    fit points;
    chart space;
    outlines out;
    powers_of_ten powers;
    FILE *off, *report, *painted;
} run;

static int read_all(run *r, image_error *error)
{
    const options *o = r->o;
    if (!read_image(&r->labels, o->labels, error)) return 0;
    if (r->labels.channels != 1)
        return image_fail(error, o->labels, "%lu pages or colours: a label image has one number for each pixel",
                          (unsigned long)r->labels.channels);
    if (!read_map(&r->positions, o->positions, &r->labels, error) ||
        !read_map(&r->normals, o->normals, &r->labels, error))
        return 0;
    if (!regions_read(&r->map, &r->labels, o->background, o->wraps, error)) return 0;
    image_free(&r->labels);
    if (o->lines && !regions_fill_lines(&r->map, error)) return 0;
    if (!o->lines && !o->paint && regions_have_lines(&r->map)) {
        write_name(stderr, o->labels);
        fprintf(stderr, ": lines of 0 part the cells: --lines shares them out; without it mu_6 comes out too low\n");
    }
    regions_count(&r->map);
    return 1;
}

static int trace_all(run *r, image_error *error)
{
    const options *o = r->o;
    if (!trace_regions(&r->graph, &r->map, error) || !fit_points_of(&r->points, &r->graph, o->points, error)) return 0;
    r->space.position = &r->positions;
    r->space.normal = o->normals ? &r->normals : NULL;
    r->space.wraps = o->wraps;
    r->space.flips = o->flips;
    r->out.map = &r->map;
    r->out.graph = &r->graph;
    r->out.points = &r->points;
    r->out.space = o->positions ? &r->space : NULL;
    r->out.welds = o->welds;
    return outlines_make(&r->out, error);
}

static int open_file(FILE **file, const char *name, const char *mode, image_error *error)
{
    if (!name) return 1;
    *file = fopen(name, mode);
    return *file || image_fail(error, name, "cannot be written: %s", strerror(errno));
}

/* Some disks complain only when a file is closed. */
static int close_file(FILE **file, const char *name, image_error *error)
{
    FILE *open = *file;
    int failed;
    if (!open) return 1;
    *file = NULL;
    failed = ferror(open);
    failed = fclose(open) != 0 || failed;
    return !failed || image_fail(error, name, "cannot be written: %s", strerror(errno));
}

/* Can the file be written? It is left as it is, or away. A pipe is not tried: its reader would take that for its end,
   and wait no longer. */
static int try_file(const char *name, image_error *error)
{
    FILE *file = NULL;
    int there;
#if HAS_POSIX
    struct stat s;
    if (!name) return 1;
    there = stat(name, &s) == 0;
    if (there && !S_ISREG(s.st_mode) && !S_ISDIR(s.st_mode)) return 1;
#else
    if (!name) return 1;
    file = fopen(name, "rb");
    there = file != NULL;
    if (file) fclose(file);
#endif
    if (!open_file(&file, name, "ab", error)) return 0;
    fclose(file);
    if (!there) remove(name);
    return 1;
}

/* All files, or none: what cannot be written leaves the others as they are. */
static int open_files(run *r, image_error *error)
{
    const options *o = r->o;
    if (!try_file(o->off, error) || !try_file(o->report, error) || !open_file(&r->off, o->off, "wb", error)) return 0;
    if (o->off && o->report && is_one_file(o->off, o->report)) {
        remove(o->off); /* it was not there before, and so no name of it was known */
        return image_fail(error, o->report, "this file would be overwritten");
    }
    return open_file(&r->report, o->report, "wb", error);
}

/* Sets *dropped to how many cells are left out. */
static int write_all(run *r, size_t *dropped, image_error *error)
{
    const options *o = r->o;
    writer w;
    size_t cells = r->map.count - 1;
    if (!open_files(r, error)) return 0;
    *dropped = write_notices(stderr, o->labels, &r->map);
    if (cells == 0) fprintf(stderr, "outlines: no pixel has a label above 0\n");
    w.powers = &r->powers;
    w.digits = o->digits;
    w.spacing = o->spacing;
    w.file = r->off;
    if (r->off && !write_off(&w, &r->out, error)) return 0;
    if (r->report && !write_report(r->report, &r->out, error)) return 0;
    if (!close_file(&r->off, o->off, error) || !close_file(&r->report, o->report, error)) return 0;
    w.file = stdout;
    printf("# outlines of ");
    write_name(stdout, o->labels);
    printf(", %lu x %lu pixels: %lu of %lu cells\n", (unsigned long)r->map.width, (unsigned long)r->map.height,
           (unsigned long)(cells - *dropped), (unsigned long)cells);
    if (!write_table(&w, &r->out, error)) return 0;
    if (fflush(stdout) || ferror(stdout) || fclose(stdout))
        return image_fail(error, NULL, "outlines: standard output cannot be written: %s", strerror(errno));
    return 1;
}

/* Numbers of a table into pixels. */
static int paint_all(run *r, image_error *error)
{
    const options *o = r->o;
    paint p;
    int good = paint_read(&p, &r->map, o->paint, o->column, &r->powers, error);
    if (good) {
        good = open_file(&r->painted, o->out, "wb", error);
        if (good) paint_write(&p, &r->map, r->painted);
        good = good && close_file(&r->painted, o->out, error);
        if (good && p.strangers > 0) {
            write_name(stderr, o->paint);
            fprintf(stderr, ": rows of cells that the image does not have: %lu\n", (unsigned long)p.strangers);
        }
    }
    paint_free(&p);
    return good;
}

static void end_run(run *r)
{
    image_error ignored = {""};
    image_free(&r->labels);
    image_free(&r->positions);
    image_free(&r->normals);
    regions_free(&r->map);
    trace_free(&r->graph);
    fit_free(&r->points);
    outlines_free(&r->out);
    close_file(&r->off, "", &ignored); /* only where the run has failed before */
    close_file(&r->report, "", &ignored);
    close_file(&r->painted, "", &ignored);
}

static int run_all(const options *o)
{
    run r;
    image_error error = {""};
    size_t dropped = 0;
    int good;
    memset(&r, 0, sizeof r);
    r.o = o;
    prepare_powers(&r.powers);
    good = read_all(&r, &error);
    if (o->paint)
        good = good && paint_all(&r, &error);
    else
        good = good && trace_all(&r, &error) && write_all(&r, &dropped, &error);
    if (!good) fprintf(stderr, "%s\n", error.text);
    end_run(&r);
    return !good ? 1 : dropped > 0 ? 2 : 0;
}

int main(int argc, char **argv)
{
    options o;
    size_t i;
    memset(&o, 0, sizeof o);
    o.points = FIT_CURVE;
    o.spacing[0] = o.spacing[1] = 1;
    o.digits = 17;
    if (parse(argc, argv, &o)) return 1;
    if (o.has_help) {
        for (i = 0; i < sizeof help / sizeof *help; ++i) fputs(help[i], stdout);
        if (!fflush(stdout) && !ferror(stdout) && !fclose(stdout)) return 0;
        fprintf(stderr, "outlines: standard output cannot be written: %s\n", strerror(errno));
        return 1;
    }
    return check(&o) ? 1 : run_all(&o);
}
