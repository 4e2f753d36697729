/* mpi_cells.c - the command `surfmink` on many machines at once, for one large table in a file that all of them see.

   compile   mpicc -std=c99 -O2 -I. examples/scaling/mpi_cells.c -o mpi_cells -lm
   run       mpirun -n 64 ./mpi_cells mu.tsv --max-rank 12 cells.tsv

   The first argument is the file for the results, the others are those of `surfmink`: options, and one table. Results,
   refusals and exit status are those of `surfmink --max-rank 12 cells.tsv > mu.tsv`, byte for byte, for any number of
   ranks. --piece BYTES, before all else, is how much of the table a rank takes at a time (default 16 MiB).

   The table is cut into pieces, which the ranks take in turn; so all of them have work to the end, and memory does not
   grow with the table. In each round a rank
     1 reads its piece, collectively, and what of the next ones its last outline needs           cut
     2 learns how many lines there were before                                                   MPI_Exscan
     3 measures and writes into memory, by the code of the command                               command/
     4 learns where its rows go, and writes them, collectively                                   MPI_Exscan
   A piece begins with the first outline that begins in it, told by the lines of the piece alone: where the id changes
   or, without an id column, after a blank line. Both neighbours find the same place without asking each other.
   At a malformed line the run ends, as that of the command does: what later ranks have measured is dropped. */
#define _POSIX_C_SOURCE 200809L /* open_memstream */
#define HAS_POSIX       1
#include <limits.h>
#include <setjmp.h>
#include <unistd.h>

#include <mpi.h>

#define SURFMINK_IMPLEMENTATION
#include "../../surfmink.h"
#include "../beyond/curve.h"
#include "../beyond/director.h"

#include "../command/options.h"
#include "../command/read.h"
#include "../command/parts.h"
#include "../command/measure.h"
#include "../command/write.h"
#include "../command/refusal.h"

enum { LOOK_AHEAD = 4096, MOST_AT_A_TIME = 1 << 30 }; /* bytes; MPI counts with int */

/* A file in memory, which ends where die or the piece ends. */
typedef struct page {
    FILE *file;
    char *text;
    size_t size;
} page;

static struct {
    int rank, ranks;
    int going; /* all ranks have begun: none may stop alone */
    options options;
    powers_of_ten powers;
    const char *result_name, *table_name;
    MPI_File result, file;
    table table; /* its columns; in the file, its lines begin at `head` */
    lines in;    /* of the piece */
    long long head, size, piece;
    unsigned long lines_before, groups_before; /* of the round */
    long long written;                         /* bytes of the result so far */
    char *text;                                /* of the table, from the piece on */
    size_t text_room, text_size;
    long long text_at; /* where in the file it begins */
    char *probe;       /* a copy, to be cut up */
    size_t probe_room;
    polygon polygon, part;
    batch batch;
    measures measures;
    page rows, complaints;
    unsigned long refused;
    int broken; /* a line of the piece is malformed */
    jmp_buf end_of_piece;
} run;

/* --- what cannot go on -------------------------------------------------------------------------------------------- */

static void check_mpi(int error, const char *name)
{
    char text[MPI_MAX_ERROR_STRING];
    int length;
    if (error == MPI_SUCCESS) return;
    MPI_Error_string(error, text, &length);
    fprintf(stderr, "%s: %s\n", name, text);
    MPI_Abort(MPI_COMM_WORLD, EXIT_TROUBLE);
}

/* What die says while a piece is measured comes after the rows before it, and ends the piece. */
static void break_off(const char *line)
{
    if (run.complaints.file) fprintf(run.complaints.file, "%s\n", line);
    longjmp(run.end_of_piece, 1);
}

/* --- reading ------------------------------------------------------------------------------------------------------ */

/* The file from `at` to before `end`, less if the file ends, to the end of the text. */
static void read_more(long long end, int collectively)
{
    MPI_Status status;
    long long at = run.text_at + (long long)run.text_size;
    int count, got;
    if (end > run.size) end = run.size;
    run.text = (char *)grow(run.text, &run.text_room, (size_t)(end - run.text_at) + 2, 1);
    do {
        count = (int)(end - at < MOST_AT_A_TIME ? end - at : MOST_AT_A_TIME);
        check_mpi(collectively ? MPI_File_read_at_all(run.file, at, run.text + run.text_size, count, MPI_BYTE, &status)
                               : MPI_File_read_at(run.file, at, run.text + run.text_size, count, MPI_BYTE, &status),
                  run.table_name);
        MPI_Get_count(&status, MPI_BYTE, &got);
        if (got != count) {
            fprintf(stderr, "%s: became shorter while it was read\n", run.table_name);
            MPI_Abort(MPI_COMM_WORLD, EXIT_TROUBLE);
        }
        run.text_size += (size_t)got;
        at += got;
    } while (at < end);
}

/* Does a line begin at text[i]? One before it and, if that is \r, text[i] itself tell. */
static int begins_line(const char *text, size_t i)
{
    return text[i - 1] == '\n' || (text[i - 1] == '\r' && text[i] != '\n');
}

/* --- cutting ------------------------------------------------------------------------------------------------------ */

/* A line that is malformed ends the run; what follows it does not matter. The cut is behind it, so that whoever has the
   outline before it sees it, too. */
static size_t behind_malformed(const lines *in)
{
    size_t i = in->next; /* of the line, if it has a zero byte; of the next one, for all other reasons */
    if (i > 0 && !memchr(in->block + i, '\0', in->end - i)) return i;
    for (++i; i < in->end && !begins_line(in->block, i); ++i) continue;
    return i;
}

/* Takes the text as all the lines that there are. text[size] is written to. */
static void begin_lines(lines *in, char *text, size_t size, unsigned long number)
{
    in->name = run.table_name;
    in->powers = &run.powers;
    in->number = number;
    in->block = text;
    in->next = in->feed.at = in->cr.at = in->nul.at = 0;
    in->end = size;
    in->ended = 1;
    in->feed.byte = '\n';
    in->cr.byte = '\r';
}

/* The first line from which on the lines tell that an outline begins; SIZE_MAX if none does. */
static size_t first_begin(table *t)
{
    char *last = NULL;
    const char *id;
    size_t room = 0, length;
    int gap = 0;
    while (next_row(t)) {
        if (t->in->fields == 0) {
            gap = 1;
            continue;
        }
        id = id_of_row(t);
        if (t->columns.ids == 0 ? gap : last && strcmp(id, last) != 0) {
            free(last);
            return (size_t)(t->in->text - t->in->block);
        }
        if (last) continue;
        length = strlen(id) + 1;
        last = (char *)grow(NULL, &room, length, 1);
        memcpy(last, id, length);
    }
    free(last);
    return SIZE_MAX;
}

static jmp_buf probe_failed;

static void fail_probe(const char *line)
{
    (void)line;
    longjmp(probe_failed, 1);
}

/* The same for text[from] to before text[end], whole lines, which stay as they are. */
static size_t probe_lines(size_t from, size_t end)
{
    static lines in; /* outlives the jump */
    static table t;
    size_t found;
    run.probe = (char *)grow(run.probe, &run.probe_room, end - from + 1, 1);
    memcpy(run.probe, run.text + from, end - from);
    begin_lines(&in, run.probe, end - from, 1);
    t = run.table;
    t.in = &in;
    last_words = fail_probe;
    if (setjmp(probe_failed))
        found = behind_malformed(&in);
    else
        found = first_begin(&t);
    last_words = NULL;
    return found == SIZE_MAX ? SIZE_MAX : from + found;
}

/* Where in the text the piece begins that begins at or behind `at` in the file. Reads on until that is known. */
static size_t find_cut(long long at)
{
    size_t from, end, found, look = LOOK_AHEAD;
    if (at <= run.head) return (size_t)(run.head - run.text_at);
    if (at >= run.size) return (size_t)(run.size - run.text_at);
    for (;; look *= 2) {
        int all;
        if (run.text_at + (long long)run.text_size < at + (long long)look) read_more(at + (long long)look, 0);
        all = run.text_at + (long long)run.text_size == run.size;
        from = (size_t)(at - run.text_at);
        end = from + look < run.text_size ? from + look : run.text_size;
        all = all && end == run.text_size;
        while (from < end && !begins_line(run.text, from)) ++from;
        while (!all && end > from && !(end < run.text_size && begins_line(run.text, end))) --end;
        found = from < end ? probe_lines(from, end) : SIZE_MAX;
        if (found != SIZE_MAX) return found;
        if (all) return run.text_size;
    }
}

/* --- one piece ---------------------------------------------------------------------------------------------------- */

static unsigned long count_bytes(const char *text, size_t size, char byte)
{
    const char *end = text + size;
    unsigned long count = 0;
    for (; (text = (const char *)memchr(text, byte, (size_t)(end - text))) != NULL; ++text) ++count;
    return count;
}

/* Each ends with \n, \r\n or \r. */
static unsigned long count_lines(const char *text, size_t size)
{
    unsigned long count = count_bytes(text, size, '\n');
    size_t i;
    if (memchr(text, '\r', size))
        for (i = 0; i < size; ++i)
            if (text[i] == '\r' && !(i + 1 < size && text[i + 1] == '\n')) ++count;
    return count;
}

/* Outlines without ids: what is between blank lines, but for comments. */
static unsigned long count_groups(const char *text, size_t size)
{
    unsigned long count = 0;
    size_t i;
    int inside = 0, empty = 1;
    for (i = 0; i < size; ++i)
        if (text[i] == '\n' && i > 0 && text[i - 1] == '\r') {
            continue;
        } else if (text[i] == '\n' || text[i] == '\r') {
            if (empty) inside = 0;
            empty = 1;
        } else if (empty && !is_blank(text[i])) {
            empty = 0;
            if (text[i] == '#' || inside) continue;
            inside = 1;
            ++count;
        }
    return count;
}

static void open_page(page *p)
{
    p->file = open_memstream(&p->text, &p->size);
    if (!p->file) die("surfmink: out of memory");
}

static void close_page(page *p)
{
    FILE *file = p->file;
    p->file = NULL;
    if (fclose(file) != 0) die("surfmink: out of memory");
}

static void process_batch(void *context)
{
    size_t i;
    (void)context;
    if (run.batch.count > 0) measure_batch(&run.measures, &run.batch, &run.options);
    for (i = 0; i < run.batch.count; ++i) {
        const polygon *p = &run.batch.polygon[i];
        measure m = measure_of(&run.measures, &run.batch, i, &run.options);
        write_row(run.rows.file, &run.options, &run.powers, run.options.json ? JSON_OBJECT : VALUES, p->surface, p->id,
                  &m);
        if (m.status == SURFMINK_OK) continue;
        ++run.refused;
        if (!run.options.quiet) write_refusal(run.complaints.file, run.table_name, &m, &run.options);
    }
    clear_batch(&run.batch);
}

/* Measures the outlines of the lines in run.in; one that is malformed leads out of here. */
static void measure_lines(void)
{
    if (setjmp(run.end_of_piece)) {
        run.broken = 1;
    } else {
        last_words = break_off;
        held_back.write = process_batch;
        while (next_of_table(&run.table, &run.polygon)) {
            add_parts(&run.batch, &run.polygon, &run.part, &run.options);
            if (is_full(&run.batch, run.options.max_rank)) write_held_back();
        }
        write_held_back();
    }
    held_back.write = NULL;
    last_words = NULL;
}

/* --- one round ---------------------------------------------------------------------------------------------------- */

/* The sum over the ranks before this one; *all, that over all ranks, is added to. */
static unsigned long long sum_before(unsigned long long mine, unsigned long *all)
{
    unsigned long long before = 0, sum = 0;
    MPI_Exscan(&mine, &before, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
    MPI_Allreduce(&mine, &sum, 1, MPI_UNSIGNED_LONG_LONG, MPI_SUM, MPI_COMM_WORLD);
    *all += (unsigned long)sum;
    return run.rank == 0 ? 0 : before;
}

/* The rows of all ranks, one after the other. */
static void write_rows(const char *text, size_t size)
{
    unsigned long all = 0;
    long long at = run.written + (long long)sum_before(size, &all);
    int left;
    do {
        int count = (int)(size < MOST_AT_A_TIME ? size : MOST_AT_A_TIME), more;
        check_mpi(MPI_File_write_at_all(run.result, at, text, count, MPI_BYTE, MPI_STATUS_IGNORE), run.result_name);
        text += count;
        at += count;
        size -= (size_t)count;
        more = size > 0;
        MPI_Allreduce(&more, &left, 1, MPI_INT, MPI_LOR, MPI_COMM_WORLD);
    } while (left);
    run.written += (long long)all;
}

/* The complaints of all ranks, one after the other, by the first one. */
static void write_complaints(char *text, size_t size)
{
    unsigned long long length = size;
    int from, count;
    if (run.rank > 0) {
        MPI_Send(&length, 1, MPI_UNSIGNED_LONG_LONG, 0, 0, MPI_COMM_WORLD);
        for (; length > 0; length -= (unsigned)count, text += count) {
            count = length < MOST_AT_A_TIME ? (int)length : MOST_AT_A_TIME;
            MPI_Send(text, count, MPI_BYTE, 0, 0, MPI_COMM_WORLD);
        }
        return;
    }
    fwrite(text, 1, size, stderr);
    for (from = 1; from < run.ranks; ++from) {
        MPI_Recv(&length, 1, MPI_UNSIGNED_LONG_LONG, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        for (; length > 0; length -= (unsigned)count) {
            count = length < MOST_AT_A_TIME ? (int)length : MOST_AT_A_TIME;
            run.probe = (char *)grow(run.probe, &run.probe_room, (size_t)count, 1);
            MPI_Recv(run.probe, count, MPI_BYTE, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
            fwrite(run.probe, 1, (size_t)count, stderr);
        }
    }
    fflush(stderr);
}

/* Piece `first` + rank: its bytes, then its lines, its outlines, its rows. Returns 0 if the run ends here. */
static int go_round(long long first)
{
    long long begin = run.head + (first + run.rank) * run.piece, end = begin + run.piece;
    size_t from, to;
    unsigned long refused = run.refused;
    int broken, first_broken;
    if (begin > run.size) begin = run.size;
    if (end > run.size) end = run.size;
    run.text_at = begin > 0 ? begin - 1 : 0; /* the byte before tells whether a line begins here */
    run.text_size = 0;
    read_more(end + LOOK_AHEAD, 1);
    from = find_cut(begin);
    to = find_cut(end);
    begin_lines(&run.in, run.text + from, to - from, 0);
    run.in.number = run.lines_before;
    run.in.number += (unsigned long)sum_before(count_lines(run.in.block, run.in.end), &run.lines_before);
    run.table.in = &run.in;
    run.table.has_row = 0;
    run.table.polygons = run.groups_before;
    run.table.polygons += (unsigned long)sum_before(
        run.table.columns.ids == 0 ? count_groups(run.in.block, run.in.end) : 0, &run.groups_before);
    open_page(&run.rows);
    open_page(&run.complaints);
    measure_lines();
    close_page(&run.rows);
    close_page(&run.complaints);
    broken = run.broken ? run.rank : INT_MAX;
    MPI_Allreduce(&broken, &first_broken, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    if (run.rank > first_broken) { /* the run had ended before */
        run.refused = refused;
        run.rows.size = run.complaints.size = 0;
    }
    write_rows(run.rows.text, run.rows.size);
    write_complaints(run.complaints.text, run.complaints.size);
    free(run.rows.text);
    free(run.complaints.text);
    run.broken = first_broken < INT_MAX;
    return !run.broken;
}

/* --- all of it ---------------------------------------------------------------------------------------------------- */

/* If the first rank stops before the others have begun, be it for --help, they stop, too. */
static void stop_others(void)
{
    int going = 0;
    if (run.going) return;
    MPI_Bcast(&going, 1, MPI_INT, 0, MPI_COMM_WORLD);
    MPI_Finalize();
}

/* Takes the arguments. They are --piece BYTES or not, the result, and those of the command. */
static void take_arguments(int argc, char **argv)
{
    size_t bytes = 1 << 24;
    int i;
    if (argc > 2 && strcmp(argv[1], "--piece") == 0) {
        if (!parse_count(argv[2], &bytes) || bytes < 1 || bytes > MOST_AT_A_TIME / 2)
            usage_error("--piece is a number of bytes from 1 to %d, not '%s'", MOST_AT_A_TIME / 2, argv[2]);
        argc -= 2;
        argv += 2;
    }
    run.piece = (long long)bytes;
    parse_options(&run.options, argc > 1 && argv[1][0] != '-' ? argc - 1 : argc,
                  argc > 1 && argv[1][0] != '-' ? argv + 1 : argv);
    if (argc < 3 || argv[1][0] == '-') usage_error("mpirun ... mpi_cells [--piece BYTES] RESULT [OPTION ...] TABLE");
    run.result_name = argv[1];
    run.table_name = run.options.file[0];
    current_file = run.table_name;
    says_nothing = 1; /* notes are about what a run sees, and a rank sees only its pieces */
    if (run.options.files != 1 || strcmp(run.table_name, "-") == 0 || is_named_mesh(run.table_name))
        usage_error("mpi_cells reads one table, from a file");
    if (run.options.estimate_normals) usage_error("mpi_cells does not estimate normals: that takes the whole table");
    if (run.options.summary) usage_error("mpi_cells makes neither summaries nor pictures");
    for (i = 0; i < PICTURES; ++i)
        if (picture_file(&run.options, i)) usage_error("mpi_cells makes neither summaries nor pictures");
}

/* The columns. The first rank finds them first, with all the complaints that this may lead to. */
static void find_head(void)
{
    lines in;
    struct stat file;
    open_lines(&in, run.table_name, &run.powers);
    if (fstat(fileno(in.file), &file) != 0 || !S_ISREG(file.st_mode)) die("%s: not a file", run.table_name);
    if (is_same_file(run.result_name, in.file, run.table_name)) die("%s: it is the result as well", run.table_name);
    if (tell_kind(&in) != READS_TABLE) die("%s: not a table", run.table_name);
    read_header(&run.table, &in, &run.options);
    if (run.table.by_columns || run.table.by_lines || run.table.columns.unnamed != nowhere)
        die("%s: mpi_cells wants a line that names the columns, and an id by its name", run.table_name);
    if (run.options.radius > 0 && run.table.columns.layout->surface != SPHERE)
        die("%s: --radius is for spheres, and this is none", run.table_name);
    run.size = (long long)file.st_size;
    run.head = (long long)lseek(fileno(in.file), 0, SEEK_CUR) - (long long)(in.end - in.next);
    run.lines_before = in.number;
    close_lines(&in);
}

/* What the first rank has found is known to all. */
static void share_head(void)
{
    long long found[3];
    int going = 1;
    run.going = 1;
    found[0] = run.head;
    found[1] = run.size;
    found[2] = (long long)run.lines_before;
    MPI_Bcast(&going, 1, MPI_INT, 0, MPI_COMM_WORLD);
    if (!going) {
        MPI_Finalize();
        exit(EXIT_MEASURED); /* the first rank has its own status */
    }
    MPI_Bcast(found, 3, MPI_LONG_LONG, 0, MPI_COMM_WORLD);
    run.head = found[0];
    run.size = found[1];
    run.lines_before = (unsigned long)found[2];
}

static void open_files(void)
{
    check_mpi(MPI_File_open(MPI_COMM_WORLD, run.table_name, MPI_MODE_RDONLY, MPI_INFO_NULL, &run.file), run.table_name);
    check_mpi(
        MPI_File_open(MPI_COMM_WORLD, run.result_name, MPI_MODE_CREATE | MPI_MODE_WRONLY, MPI_INFO_NULL, &run.result),
        run.result_name);
    check_mpi(MPI_File_set_size(run.result, 0), run.result_name);
}

static void close_files(void)
{
    check_mpi(MPI_File_close(&run.file), run.table_name);
    check_mpi(MPI_File_close(&run.result), run.result_name);
    free((void *)run.options.file);
    free(run.text);
    free(run.probe);
    free(run.in.field);
    free_polygon(&run.polygon);
    free_polygon(&run.part);
    free_table(&run.table);
    free_batch(&run.batch);
    end_measures(&run.measures);
}

int main(int argc, char **argv)
{
    long long first, pieces;
    page names;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &run.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &run.ranks);
    prepare_powers(&run.powers);
    if (run.rank == 0) {
        atexit(stop_others);
        take_arguments(argc, argv);
        find_head();
    }
    share_head();
    if (run.rank > 0) {
        unsigned long lines_before = run.lines_before;
        take_arguments(argc, argv);
        find_head();
        run.lines_before = lines_before;
    }
    begin_batch(&run.batch);
    begin_measures(&run.measures, run.options.max_rank);
    open_files();

    open_page(&names);
    if (run.rank == 0 && !run.options.json)
        write_row(names.file, &run.options, &run.powers, NAMES, run.table.columns.layout->surface, "", NULL);
    close_page(&names);
    write_rows(names.text, names.size);
    free(names.text);
    pieces = (run.size - run.head + run.piece - 1) / run.piece;
    for (first = 0; first < pieces && go_round(first); first += run.ranks) continue;

    close_files();
    MPI_Allreduce(MPI_IN_PLACE, &run.refused, 1, MPI_UNSIGNED_LONG, MPI_SUM, MPI_COMM_WORLD);
    MPI_Finalize();
    return run.broken ? EXIT_TROUBLE : run.refused > 0 ? EXIT_REFUSED : EXIT_MEASURED;
}
