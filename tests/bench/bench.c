/* bench.c - how long does an outline take? Ways to the same numbers, measured side by side.

     cc -std=c99 -O2 -I. -DBENCH_FLAGS='"-O2"' tests/bench/bench.c -o bench -lm     (or: make bench)
     ./bench --quick                          a table for every surface, set of outlines and maximal rank
     ./bench --surface plane --set q6 --rank 6

   Rounds are interleaved: each takes a sample of every column, so that whatever slows the machine for a while slows all
   of them. Ratios are medians over rounds of two samples of the same round. A sample goes over its outlines until 5 ms
   have passed at least.

   "cache": corners and results together fill 256 KiB (or eight outlines, where that is more) and stay in a cache of the
   second level; every pass goes over all of them.
   "memory": 9e6 corners. One cursor goes round the set, and each sample takes the parts that come next: what it reads
   and writes was last touched when everything else had been, too. (--quick has 1e6 corners, which a large cache of the
   third level may keep.)

   One core is timed by what the thread has used of it, so that other programs disturb little; all cores by the wall
   clock, for which the machine should have nothing else to do. The clock rate of the core is unknown: cycles are ticks
   of the time stamp counter, whose rate is printed. */
#define _GNU_SOURCE /* clock_gettime (POSIX), sincos where it exists */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "sets.h"
#include "columns.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#ifndef BENCH_FLAGS
#define BENCH_FLAGS "flags unknown (-DBENCH_FLAGS)"
#endif

#define TEXT(number)    TEXT_OF(number)
#define TEXT_OF(number) #number
#if defined(__clang__)
#define COMPILER "clang " TEXT(__clang_major__) "." TEXT(__clang_minor__) "." TEXT(__clang_patchlevel__)
#elif defined(__GNUC__)
#define COMPILER "gcc " __VERSION__
#else
#define COMPILER "unknown compiler"
#endif

enum place { CACHE, MEMORY, PLACES };
static const char *const place_name[PLACES] = {"cache", "memory"};

enum { MOST_ROUNDS = 1000, PART = 250000 /* corners of a set in memory that are measured in one piece */ };

/* What the user asked for; -1: all of them. */
typedef struct options {
    int surface, set, place, rank;
    int rounds, threads; /* 0: the usual */
    int quick, tsv, no_scratch;
    int count, repeat; /* the column to run without a clock, or -1, and how often */
} options;

/* One table: a set laid out on a surface, where its parts are, and what was measured. */
typedef struct table {
    task work;
    int surface, set, place, rounds, threads;
    size_t parts, cursor;
    double difference[COLUMNS];            /* largest, of mu from the batch */
    size_t passes[COLUMNS];                /* parts in a sample; 0: no such column here */
    double time[COLUMNS][MOST_ROUNDS];     /* ns a corner */
    double ratio[2][COLUMNS][MOST_ROUNDS]; /* time of A and B over that of the column, in the same round */
} table;

/* --- clocks ------------------------------------------------------------------------------------------------------- */

static double read_clock(clockid_t clock) /* ns */
{
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static double now(void)
{
    return read_clock(CLOCK_MONOTONIC);
}

static double ticks(void)
{
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
    return (double)__builtin_ia32_rdtsc();
#else
    return 0;
#endif
}

/* Ticks of the time stamp counter in a nanosecond; 0 where there is none. */
static double tick_rate(void)
{
    double start = now(), from = ticks(), elapsed;
    while ((elapsed = now() - start) < 50e6) continue;
    return (ticks() - from) / elapsed;
}

/* --- one sample --------------------------------------------------------------------------------------------------- */

static void use_threads(int threads)
{
#ifdef _OPENMP
    omp_set_num_threads(threads);
#else
    (void)threads;
#endif
}

static int most_threads(void)
{
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return 1;
#endif
}

/* Lets a column work on the next parts of the set; returns ns, and how many corners that were. */
static double run_parts(table *t, int which, size_t parts, size_t *corners)
{
    const outlines *in = &t->work.in;
    clockid_t clock = which == BATCH_ALL ? CLOCK_MONOTONIC : CLOCK_THREAD_CPUTIME_ID;
    double start = read_clock(clock);
    *corners = 0;
    for (; parts > 0; --parts) {
        size_t first = in->count * t->cursor / t->parts, last = in->count * (t->cursor + 1) / t->parts;
        column[which].run(&t->work, first, last);
        *corners += in->offset[last] - in->offset[first];
        t->cursor = (t->cursor + 1) % t->parts;
    }
    return read_clock(clock) - start;
}

/* Threads that have run out of work wait for more without sleeping, at first, and take power, or even the core, from
   whoever is measured next: so wait for them (without sleeping: a core that slept starts slowly). */
static void let_threads_sleep(void)
{
    double start = now();
    while (now() - start < 5e6) continue;
}

static double sample(table *t, int which, size_t parts, size_t *corners)
{
    double elapsed;
    use_threads(which == BATCH_ALL ? t->threads : 1);
    elapsed = run_parts(t, which, parts, corners);
    if (which == BATCH_ALL) let_threads_sleep();
    return elapsed;
}

static int has_column(const table *t, int which)
{
    if (which == FLAT || which == DIRECT) return t->surface == PLANE;
    if (which == BATCH_ALL) return t->threads > 1;
    return 1;
}

/* How many parts take 5 ms. The first sample, which finds nothing prepared, tells little unless it is far more. */
static size_t passes_for(table *t, int which)
{
    size_t passes = 1, corners;
    if (sample(t, which, 1, &corners) > 50e6) return 1;
    while (sample(t, which, passes, &corners) < 5e6) passes *= 2;
    return passes;
}

static void measure(table *t)
{
    size_t corners;
    int round, k, i;
    for (i = 0; i < COLUMNS; ++i) t->passes[i] = has_column(t, i) ? passes_for(t, i) : 0;
    for (round = 0; round < t->rounds; ++round) {
        for (k = 0; k < COLUMNS; ++k) {
            i = (round + k) % COLUMNS; /* each comes first in turn */
            if (t->passes[i] == 0) continue;
            t->time[i][round] = sample(t, i, t->passes[i], &corners);
            t->time[i][round] /= (double)corners;
        }
        for (i = 0; i < COLUMNS; ++i) {
            if (t->passes[i] == 0) continue;
            t->ratio[0][i][round] = t->time[PAPER][round] / t->time[i][round];
            t->ratio[1][i][round] = t->time[LIBM][round] / t->time[i][round];
        }
    }
}

/* --- do they agree? ----------------------------------------------------------------------------------------------- */

/* A NaN anywhere is a difference, too. */
static double largest_difference(const double *a, const double *b, size_t n)
{
    double largest = 0, difference;
    size_t i;
    for (i = 0; i < n; ++i) {
        difference = fabs(a[i] - b[i]);
        if (!(difference <= largest)) largest = difference;
    }
    return largest;
}

static void none_refused(const int *status, size_t n)
{
    size_t i;
    for (i = 0; i < n; ++i)
        if (status[i] != SURFMINK_OK) {
            fprintf(stderr, "bench: outline %lu: %s\n", (unsigned long)i, surfmink_strerror(status[i]));
            exit(1);
        }
}

/* Compares mu of the set's first part, or all of it in cache. An outline that was refused, or a column that is wrong,
   makes all figures void. */
static void verify(table *t)
{
    size_t last = t->work.in.count / t->parts, numbers = last * ranks_of(&t->work), i;
    double *mu = (double *)reserve(numbers, sizeof *mu);
    int which;
    use_threads(1);
    run_batch(&t->work, 0, last);
    none_refused(t->work.out.status, last);
    memcpy(mu, t->work.out.mu, numbers * sizeof *mu);
    for (which = 0; which < COLUMNS; ++which) {
        t->difference[which] = 0;
        if (!has_column(t, which) || !(column[which].tolerance > 0)) continue;
        for (i = 0; i < numbers; ++i) t->work.out.mu[i] = (double)NAN;
        use_threads(which == BATCH_ALL ? t->threads : 1);
        column[which].run(&t->work, 0, last);
        t->difference[which] = largest_difference(mu, t->work.out.mu, numbers);
        if (t->difference[which] <= column[which].tolerance) continue;
        fprintf(stderr, "bench: %s, %s: mu of column %s is off by %g\n", surface_name[t->surface], set_name[t->set],
                column_name[which], t->difference[which]);
        exit(1);
    }
    free(mu);
}

/* --- one table ---------------------------------------------------------------------------------------------------- */

/* Bytes of results for an outline. */
static size_t result_size(int max_rank)
{
    return sizeof(int) + (2 + 3 * ((size_t)max_rank + 1)) * sizeof(double);
}

static size_t corners_in_cache(int surface, int set, int max_rank)
{
    double each = (double)(corners_of[set].least + corners_of[set].most) / 2;
    double corner = surface == PLANE ? 16 : surface == SPHERE ? 24 : 48;
    double corners = 262144 / (corner + ((double)result_size(max_rank) + 8) / each);
    return corners < 8 * each ? (size_t)(8 * each) : (size_t)corners;
}

static void prepare(table *t, size_t corners, int max_rank, int no_scratch)
{
    task *w = &t->work;
    w->in = make_outlines((enum surface)t->surface, (size_t)t->set, corners);
    corners = w->in.offset[w->in.count];
    w->max_rank = max_rank;
    w->no_scratch = no_scratch;
    w->seen = 0;
    w->scratch = (double *)reserve(corners, 2 * sizeof *w->scratch);
    memset(&w->out, 0, sizeof w->out);
    w->out.status = (int *)reserve(w->in.count, sizeof *w->out.status);
    w->out.length = (double *)reserve(w->in.count, sizeof *w->out.length);
    w->out.turning = (double *)reserve(w->in.count, sizeof *w->out.turning);
    w->out.mu = (double *)reserve(w->in.count, ranks_of(w) * sizeof *w->out.mu);
    w->out.g = (double *)reserve(w->in.count, 2 * ranks_of(w) * sizeof *w->out.g);
    t->cursor = 0;
    t->parts = t->place == CACHE ? 1 : w->in.longest > PART ? w->in.count : corners > PART ? corners / PART : 1;
}

/* Everything that was written is read once more here, and so had to be written. */
static double clear(table *t)
{
    task *w = &t->work;
    double sum = w->seen + sum_of(w->out.mu, w->in.count * ranks_of(w)) +
                 sum_of(w->out.g, 2 * w->in.count * ranks_of(w)) + sum_of(w->out.length, w->in.count) +
                 sum_of(w->out.turning, w->in.count);
    size_t i;
    for (i = 0; i < w->in.count; ++i) sum += w->out.status[i];
    free_outlines(&w->in);
    free(w->scratch);
    free(w->out.status);
    free(w->out.length);
    free(w->out.turning);
    free(w->out.mu);
    free(w->out.g);
    return sum;
}

/* --- what came out ------------------------------------------------------------------------------------------------ */

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* q = 0: smallest, 0.5: median, 1: largest. */
static double quantile(const double *value, int n, double q)
{
    double sorted[MOST_ROUNDS], at = q * (n - 1);
    int low = (int)at, high = low + 1 < n ? low + 1 : low;
    memcpy(sorted, value, (size_t)n * sizeof *value);
    qsort(sorted, (size_t)n, sizeof *sorted, ascending);
    return sorted[low] + (at - low) * (sorted[high] - sorted[low]);
}

typedef struct summary {
    double fastest, median; /* ns a corner */
    double spread;          /* the distance of the quartiles, in percent of the median */
    double ticks;           /* a corner, median */
    double times[2];        /* how many times as fast as A and B, median */
} summary;

static summary summarize(const table *t, int which, double rate)
{
    const double *time = t->time[which];
    summary s;
    int n = t->rounds, k;
    s.fastest = quantile(time, n, 0);
    s.median = quantile(time, n, 0.5);
    s.spread = 100 * (quantile(time, n, 0.75) - quantile(time, n, 0.25)) / s.median;
    s.ticks = s.median * rate;
    for (k = 0; k < 2; ++k) s.times[k] = quantile(t->ratio[k][which], n, 0.5);
    return s;
}

static void print_machine(double rate)
{
    char line[256] = "";
    FILE *cpu = fopen("/proc/cpuinfo", "r");
    while (cpu && fgets(line, sizeof line, cpu))
        if (strncmp(line, "model name", 10) == 0 && strchr(line, ':')) break;
    if (cpu) fclose(cpu);
    if (strncmp(line, "model name", 10) != 0) strcpy(line, ": unknown processor\n");
    printf("machine    %.*s, %ld cores\n", (int)strcspn(strchr(line, ':') + 2, "\n"), strchr(line, ':') + 2,
           sysconf(_SC_NPROCESSORS_ONLN));
    printf("compiler   " COMPILER "\nflags      " BENCH_FLAGS "\n");
    if (rate > 0) printf("ticks      of the time stamp counter, %.3f GHz whatever the clock of the core\n", rate);
    printf("surfmink   " SURFMINK_VERSION "\n\n");
}

static void print_columns(void)
{
    int i;
    for (i = 0; i < COLUMNS; ++i) printf("%-15s%s\n", column_name[i], column[i].meaning);
}

static void print_start(int tsv, double rate)
{
    if (tsv) {
        printf("compiler\tflags\tsurface\tset\tplace\trank\tcolumn\toutlines\tcorners\tthreads\trounds\tns_fastest\t"
               "ns_median\tspread_percent\tticks_median\ttimes_as_fast_as_A\ttimes_as_fast_as_B\tmu_difference\n");
    } else {
        print_machine(rate);
        print_columns();
    }
}

static void print_head(const table *t)
{
    const outlines *in = &t->work.in;
    double corners = (double)in->offset[in->count], bytes = (double)in->dim * 8 * (in->normal ? 2 : 1);
    int i;
    printf("\n%s, %s, %s, P = %d: %.0f corners in %lu outlines, %.3g MiB with results; %d rounds",
           surface_name[t->surface], set_name[t->set], place_name[t->place], t->work.max_rank, corners,
           (unsigned long)in->count,
           (corners * bytes + (double)(in->count * (8 + result_size(t->work.max_rank)))) / 1048576, t->rounds);
    if (t->threads > 1) printf(", %d threads", t->threads);
    printf("\nmu differs from the batch by at most:");
    for (i = 0; i < COLUMNS; ++i)
        if (t->passes[i] && column[i].tolerance > 0) printf(" %s %.1e", column_name[i], t->difference[i]);
    printf("\n%-12s%10s%10s%9s%10s%12s%12s\n", "", "ns/corner", "ns/corner", "spread", "ticks", "times as", "times as");
    printf("%-12s%10s%10s%9s%10s%12s%12s\n", "", "fastest", "median", "%", "a corner", "fast as A", "fast as B");
}

static void print_table(const table *t, double rate)
{
    summary s;
    int i;
    print_head(t);
    for (i = 0; i < COLUMNS; ++i) {
        if (t->passes[i] == 0) continue;
        s = summarize(t, i, rate);
        printf("%-15s%7.2f%10.2f%9.1f%10.1f%12.2f%12.2f\n", column_name[i], s.fastest, s.median, s.spread, s.ticks,
               s.times[0], s.times[1]);
    }
}

static void print_rows(const table *t, double rate)
{
    const outlines *in = &t->work.in;
    summary s;
    int i;
    for (i = 0; i < COLUMNS; ++i) {
        if (t->passes[i] == 0) continue;
        s = summarize(t, i, rate);
        printf("%s\t%s\t%s\t%s\t%s\t%d\t%s\t%lu\t%lu\t%d\t%d\t", COMPILER, BENCH_FLAGS, surface_name[t->surface],
               set_name[t->set], place_name[t->place], t->work.max_rank, column_name[i], (unsigned long)in->count,
               (unsigned long)in->offset[in->count], i == BATCH_ALL ? t->threads : 1, t->rounds);
        printf("%.4f\t%.4f\t%.2f\t%.3f\t%.4f\t%.4f\t%.2e\n", s.fastest, s.median, s.spread, s.ticks, s.times[0],
               s.times[1], t->difference[i]);
    }
}

/* --- all tables --------------------------------------------------------------------------------------------------- */

/* The set of one outline that is longer than a cache exists in memory only. */
static int is_wanted(const options *o, const table *t)
{
    if (t->place == CACHE && corners_of[t->set].least > PART) return 0;
    return (o->surface < 0 || o->surface == t->surface) && (o->set < 0 || o->set == t->set) &&
           (o->place < 0 || o->place == t->place);
}

static int rounds_of(const options *o, int place)
{
    int rounds = o->rounds > 0 ? o->rounds : o->quick ? 5 : 15;
    return place == MEMORY && o->rounds <= 0 ? (rounds + 2) / 3 : rounds;
}

static double fill_table(table *t, const options *o, int rank, double rate)
{
    size_t corners = t->place == CACHE ? corners_in_cache(t->surface, t->set, rank) : o->quick ? 1000000 : 9000000;
    t->rounds = rounds_of(o, t->place);
    t->threads = o->threads > 0 ? o->threads : most_threads();
    prepare(t, corners, rank, o->no_scratch);
    verify(t);
    measure(t);
    if (o->tsv)
        print_rows(t, rate);
    else
        print_table(t, rate);
    fflush(stdout);
    return clear(t);
}

static void all_tables(const options *o)
{
    static table t;
    double rate = tick_rate(), checksum = 0;
    print_start(o->tsv, rate);
    for (t.place = 0; t.place < PLACES; ++t.place)
        for (t.surface = 0; t.surface < SURFACES; ++t.surface)
            for (t.set = 0; t.set < SETS; ++t.set) {
                if (!is_wanted(o, &t)) continue;
                checksum += fill_table(&t, o, o->rank >= 0 ? o->rank : 6, rate);
                if (o->rank < 0) checksum += fill_table(&t, o, 12, rate);
            }
    if (!o->tsv) printf("\nchecksum %g\n", checksum);
}

/* --- without a clock ---------------------------------------------------------------------------------------------- */

/* For a tool that counts instructions: count.sh takes the difference of two runs that only differ in --repeat. */
static void count_only(const options *o)
{
    static table t;
    size_t least;
    int i;
    t.surface = o->surface >= 0 ? o->surface : PLANE;
    t.set = o->set >= 0 ? o->set : 0;
    t.place = CACHE;
    least = 8 * corners_of[t.set].most;
    use_threads(1);
    prepare(&t, least > 4096 ? least : 4096, o->rank >= 0 ? o->rank : 6, o->no_scratch);
    for (i = 0; i < o->repeat; ++i) column[o->count].run(&t.work, 0, t.work.in.count);
    printf("corners %lu\n", (unsigned long)t.work.in.offset[t.work.in.count]);
    printf("checksum %g\n", clear(&t));
}

/* --- options ------------------------------------------------------------------------------------------------------ */

static const char help_text[] =
    "bench - how long surfmink takes, and other ways to the same numbers\n"
    "\n"
    "EXAMPLES\n"
    "  bench --quick                                        # a minute: every table, few rounds\n"
    "  bench --surface sphere --set q6 --rank 6 --rounds 51 # two tables, in cache and from memory\n"
    "  bench --tsv > bench.tsv                              # minutes: a row for every table and column\n"
    "  valgrind --tool=callgrind bench --count B --surface plane --set q40 --rank 12 --repeat 3\n"
    "\n"
    "OPTIONS\n"
    "  --quick           5 rounds (2 from memory), 1e6 corners in memory instead of 9e6\n"
    "  --surface NAME    plane, sphere or embedded (an ellipsoid)\n"
    "  --set NAME        q6, ragged (3 to 9 corners), q40, q1000, q1e6 (in memory only)\n"
    "  --place NAME      cache or memory\n"
    "  --rank P          maximal rank; otherwise 6 and 12\n"
    "  --rounds N        otherwise 15, and 5 from memory\n"
    "  --threads N       for the column batch-all; otherwise as many as there are processors (-fopenmp)\n"
    "  --no-scratch      the batch gets no scratch memory\n"
    "  --tsv             one row for each surface, set, place, rank and column\n"
    "  --count COLUMN    runs this column alone on 4096 corners (or eight outlines), without a clock\n"
    "  --repeat N        so many times\n"
    "\n"
    "COLUMNS\n";

static void complain(const char *what, const char *about)
{
    fprintf(stderr, "bench: %s: %s (bench --help explains)\n", about, what);
    exit(2);
}

static int number(const char *option, const char *text, int least, int most)
{
    char *end;
    long n = strtol(text, &end, 10);
    if (end == text || *end || n < least || n > most) complain("not a number, or out of range", option);
    return (int)n;
}

/* Which of these is called so? */
static int called(const char *text, const char *const *name, int names)
{
    int i;
    for (i = 0; i < names; ++i)
        if (strcmp(text, name[i]) == 0) return i;
    complain("no such name", text);
    return -1;
}

/* An option that stands alone. */
static int read_switch(options *o, const char *name)
{
    if (strcmp(name, "--quick") == 0) return o->quick = 1;
    if (strcmp(name, "--tsv") == 0) return o->tsv = 1;
    if (strcmp(name, "--no-scratch") == 0) return o->no_scratch = 1;
    if (strcmp(name, "--help") == 0) {
        fputs(help_text, stdout);
        print_columns();
        exit(0);
    }
    return 0;
}

/* An option with a value behind it. */
static void read_value(options *o, const char *name, const char *value)
{
    if (!value) complain("unknown, or its value is missing", name);
    if (strcmp(name, "--surface") == 0)
        o->surface = called(value, surface_name, SURFACES);
    else if (strcmp(name, "--set") == 0)
        o->set = called(value, set_name, SETS);
    else if (strcmp(name, "--place") == 0)
        o->place = called(value, place_name, PLACES);
    else if (strcmp(name, "--rank") == 0)
        o->rank = number(name, value, 0, 128);
    else if (strcmp(name, "--rounds") == 0)
        o->rounds = number(name, value, 1, MOST_ROUNDS);
    else if (strcmp(name, "--threads") == 0)
        o->threads = number(name, value, 1, 4096);
    else if (strcmp(name, "--count") == 0)
        o->count = called(value, column_name, COLUMNS);
    else if (strcmp(name, "--repeat") == 0)
        o->repeat = number(name, value, 0, 1000000);
    else
        complain("no such option", name);
}

static options read_options(int argc, char **argv)
{
    options o = {-1, -1, -1, -1, 0, 0, 0, 0, 0, -1, 1};
    int i;
    for (i = 1; i < argc; ++i)
        if (!read_switch(&o, argv[i])) {
            read_value(&o, argv[i], argv[i + 1]);
            ++i;
        }
    if ((o.count == FLAT || o.count == DIRECT) && o.surface > PLANE)
        complain("this column knows the plane only", column_name[o.count]);
    return o;
}

int main(int argc, char **argv)
{
    options o = read_options(argc, argv);
    if (o.count >= 0)
        count_only(&o);
    else
        all_tables(&o);
    return 0;
}
