/* surfmink.c - the command `surfmink`: a table or a mesh of outlines in, a table of their p-fold symmetry out.

   compile   cc examples/surfmink.c -o surfmink -lm
   run       ./surfmink examples/data/countries.tsv
             ./surfmink --help

   It is a filter, a batch of polygons at a time:
     0 options  what the user asked for                                   command/options.h
     1 read     a file -> blocks -> lines -> numbers -> a polygon         command/lines.h number.h columns.h table.h
                or a mesh or GeoJSON -> polygons                          command/mesh.h json.h geojson.h antimeridian.h
                                                                          estimate.h read.h
     2 repair   a polygon -> what the options make of it -> into a batch  command/polygon.h repair.h batch.h parts.h
     3 measure  a batch -> L, S, area, mu, theta of each polygon          command/measure.h
     4 write    -> one line of a table, or a JSON object, for each        command/write.h refusal.h
     5 at the end, if asked for: a summary, pictures, polygons in space   command/summary.h picture.h svg.h map.h
                                                                          horizon.h chart.h ply.h; picture/
   A batch is measured when it is full, when the file ends, when the input pauses, and before any complaint. */

#include "command/posix.h"
#include <time.h>

#define SURFMINK_IMPLEMENTATION
#include "../surfmink.h"
#include "beyond/director.h"

#include "command/options.h"
#include "command/read.h"
#include "command/parts.h"
#include "command/measure.h"
#include "command/write.h"
#include "command/refusal.h"
#include "command/summary.h"
#include "command/map.h"
#include "command/chart.h"
#include "command/ply.h"

/* What lives as long as the run. */
typedef struct run {
    options options;
    powers_of_ten powers;
    polygon polygon; /* that is being read */
    polygon part;    /* of it */
    batch batch;
    measures measures;
    summary summary;
    picture picture;
    chart chart;
    pick pick[2 * MOST_COLORS + 2]; /* the columns that fill pictures, then those of charts */
    int picks;
    const char *name; /* of the file that is being read */
    int surface;      /* of the polygons so far; AS_THE_COLUMNS_SAY before the first file */
    int watched;      /* somebody looks at standard error and not at standard output */
    time_t started, shown;
    unsigned long measured, refused;
} run;

/* --- progress ----------------------------------------------------------------------------------------------------- */

static int is_watched(const options *o)
{
#if HAS_POSIX
    return !o->quiet && isatty(STDERR_FILENO) && !isatty(STDOUT_FILENO);
#else
    (void)o;
    return 0;
#endif
}

/* Only after two seconds, and then once a second. */
static void show_progress(run *r)
{
    time_t now;
    if (!r->watched) return;
    now = time(NULL);
    if (difftime(now, r->started) < 2 || difftime(now, r->shown) < 1) return;
    r->shown = now;
    fputs("\r\033[K", stderr);
    put_harmless(stderr, r->name);
    fprintf(stderr, ": %lu polygons, %lu refused", r->measured + r->refused, r->refused);
    fflush(stderr);
    progress_is_shown = 1;
}

/* --- one batch ---------------------------------------------------------------------------------------------------- */

static void report_refusal(const run *r, const measure *m)
{
    if (r->options.quiet) return;
    wipe_progress();
    fflush(stdout);
    write_refusal(stderr, r->name, m, &r->options);
}

static void write_polygon(run *r, polygon *p, const measure *m)
{
    const options *o = &r->options;
    write_row(stdout, o, &r->powers, o->json ? JSON_OBJECT : VALUES, p->surface, p->id, m);
    check_standard_output();
    if (m->status == SURFMINK_OK) {
        ++r->measured;
        warn_about(r->name, m, o);
    } else {
        ++r->refused;
        report_refusal(r, m);
    }
    if (o->summary) add_to_summary(&r->summary, m, o->max_rank);
    if (o->svg || o->ply || o->histogram || o->scatter) take_picks(r->pick, r->picks, o, p->surface, m);
    if (o->histogram || o->scatter) add_to_chart(&r->chart, p->id, m, r->pick + map_colors(o), o);
    if (o->svg || o->ply) add_to_picture(&r->picture, p, m, r->pick, o);
    show_progress(r);
}

/* Measures and writes the polygons that have been read; what write_held_back calls. */
static void process_batch(void *context)
{
    run *r = (run *)context;
    measure m;
    size_t i;
    if (r->batch.count > 0) measure_batch(&r->measures, &r->batch, &r->options);
    for (i = 0; i < r->batch.count; ++i) {
        m = measure_of(&r->measures, &r->batch, i, &r->options);
        write_polygon(r, &r->batch.polygon[i], &m);
    }
    clear_batch(&r->batch);
}

/* --- one file ----------------------------------------------------------------------------------------------------- */

/* Vectors of the plane have two columns, those of space three; a picture shows one kind of surface. */
static void check_surface(const run *r, const reader *in, const char *name)
{
    const options *o = &r->options;
    int surface = in->surface;
    int first = r->surface == AS_THE_COLUMNS_SAY;
    if (o->order == 4 && in->mesh.mean)
        die("%s: --order 4 needs exact normals, and those of a mesh are means; --surface tells another surface", name);
    if (o->radius > 0 && surface != SPHERE) die("%s: --radius is for spheres, and this is none", name);
    if (o->views > 0 && surface == PLANE) die("%s: --view is for surfaces in space, and this is a plane", name);
    if (!first && (o->svg || o->ply) && surface != r->surface)
        die("%s: another kind of surface in the same picture", name);
    if (!first && o->directions && !o->json && stride_of(surface) != stride_of(r->surface))
        die("%s: directions in the plane and in space do not go into one table; --json can hold both", name);
}

static void process_file(run *r, const char *name)
{
    reader in;
    r->name = current_file = name;
    open_reader(&in, name, &r->powers, &r->options);
    check_surface(r, &in, name);
    if (r->surface == AS_THE_COLUMNS_SAY && !r->options.json)
        write_row(stdout, &r->options, &r->powers, NAMES, in.surface, "", NULL);
    r->surface = in.surface;
    find_picks(r->pick, r->picks, &r->options, in.surface);
    while (next_polygon(&in, &r->polygon)) {
        add_parts(&r->batch, &r->polygon, &r->part, &r->options);
        if (is_full(&r->batch, r->options.max_rank)) write_held_back();
    }
    write_held_back();
    close_reader(&in);
}

/* --- columns that pictures show ----------------------------------------------------------------------------------- */

/* In space there are more columns than in the plane, where e_2_z is undefined. */
static void add_picks(run *r, const char *option, const quantities *list)
{
    static const char *const source[][2] = {{"error_", "--error"},
                                            {"sigma_", "--noise S"},
                                            {"e_", "--directions"},
                                            {"center_", "--directions center"},
                                            {"coherence_", "--directions center"}};
    const char *by = NULL;
    int i, k;
    for (i = 0; i < list->count; ++i) {
        pick *p = &r->pick[r->picks++];
        p->what = &list->of[i];
        find_picks(p, 1, &r->options, EMBEDDED);
        for (k = 0; k < 5; ++k)
            if (strncmp(p->what->name, source[k][0], strlen(source[k][0])) == 0) by = source[k][1];
        if (p->column == 0 && by) usage_error("--%s %s: %s adds such columns", option, p->what->name, by);
        if (p->column == 0)
            usage_error("--%s %s: the results have no such column of numbers; they have n, L, S, area, mu_p, theta_p",
                        option, p->what->name);
    }
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

static void begin_run(run *r, int argc, char **argv)
{
    memset(r, 0, sizeof *r);
    memset(&warnings, 0, sizeof warnings);
    parse_options(&r->options, argc, argv);
    add_picks(r, "color-by", &r->options.color_by);
    add_picks(r, "histogram-of", &r->options.histogram_of);
    add_picks(r, "scatter-of", &r->options.scatter_of);
    prepare_powers(&r->powers);
    begin_batch(&r->batch);
    begin_measures(&r->measures, r->options.max_rank);
    begin_summary(&r->summary, r->options.max_rank);
    held_back.write = process_batch;
    held_back.context = r;
    says_nothing = r->options.quiet;
    r->surface = AS_THE_COLUMNS_SAY;
    r->watched = is_watched(&r->options);
    r->started = r->shown = time(NULL);
}

/* Warnings that came again were not told again. One alone is not counted. */
static void tell_counts(const run *r)
{
    if (warnings.all == 0 || r->refused + warnings.all == 1) return;
    remark(COMMAND_NAME ": %lu measured, %lu refused; %lu warning%s", r->measured, r->refused, warnings.all,
           warnings.all > 1 ? "s, of which the first of each kind are told" : "");
}

static void finish_run(run *r)
{
    held_back.write = NULL;
    held_back.context = NULL;
    wipe_progress();
    fflush(stdout);
    check_standard_output();
    tell_counts(r);
    if (r->options.summary) write_summary(&r->summary, r->options.max_rank);
    if (r->options.svg) write_map(&r->picture, &r->options);
    if (r->options.histogram) write_histograms(&r->chart, &r->options);
    if (r->options.scatter) write_scatter(&r->chart, &r->options);
    if (r->options.ply) write_ply(&r->picture, &r->options, &r->powers);
    close_standard_output();
}

static void free_run(run *r)
{
    free(r->options.file);
    free_polygon(&r->polygon);
    free_polygon(&r->part);
    free_batch(&r->batch);
    end_measures(&r->measures);
    end_summary(&r->summary);
    free_picture(&r->picture);
    free_chart(&r->chart);
}

int main(int argc, char **argv)
{
    run r;
    size_t i;
    int refused;
    begin_run(&r, argc, argv);
    for (i = 0; i < r.options.files; ++i) process_file(&r, r.options.file[i]);
    finish_run(&r);
    refused = r.refused > 0;
    free_run(&r);
    return refused ? EXIT_REFUSED : EXIT_MEASURED;
}
