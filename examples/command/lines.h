/* lines.h - step 1 of the command: a file -> its lines -> their fields. */
#ifndef SURFMINK_COMMAND_LINES_H
#define SURFMINK_COMMAND_LINES_H

#include "common.h"
#include "number.h"

#if HAS_POSIX
#include <poll.h>
#endif

/* How far the unread text has been searched for a byte: up to there it has none. So each search looks at a byte once,
   however long the lines are. */
typedef struct search {
    char byte;
    size_t at;
} search;

typedef struct lines {
    const char *name; /* of the file, as the user wrote it */
    FILE *file;
    int ended;                   /* there is no more to read */
    const powers_of_ten *powers; /* for the numbers in it */
    unsigned long number;        /* of the line that is read, from 1 */
    char *text;                  /* this line; split_line cuts it up */
    char **field;
    size_t fields, field_room;
    int quoted, first_quoted; /* the field that has just been taken, the first one of the line */
    char *block;              /* of the file: the line at hand, and what follows it */
    size_t next, end;         /* of what follows it */
    size_t room;              /* one more than end may be */
    search feed, cr, nul;     /* \n, \r, \0 */
} lines;

enum { BLOCK_SIZE = 65536, LONGEST_LINE = 1 << 26 };

/* The run stops at a line that says nothing: whatever followed would be a guess. */
static void malformed(const lines *in, const char *format, ...) COMMAND_PRINTF(2, 3) COMMAND_DIES;
static void malformed(const lines *in, const char *format, ...)
{
    char reason[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    die("%s:%lu: %s", in->name, in->number, reason);
}

static void open_lines(lines *in, const char *name, const powers_of_ten *powers)
{
    memset(in, 0, sizeof *in);
    in->name = name;
    in->file = strcmp(name, "-") == 0 ? stdin : fopen(name, "rb");
    if (!in->file) die("%s: %s", name, strerror(errno));
    in->powers = powers;
    in->room = BLOCK_SIZE;
    in->block = (char *)resize(NULL, in->room, 1);
    in->feed.byte = '\n';
    in->cr.byte = '\r';
}

static void close_lines(lines *in)
{
    if (in->file != stdin) fclose(in->file);
    free(in->block);
    free(in->field);
}

/* --- blocks ------------------------------------------------------------------------------------------------------- */

/* Some bytes of the file, 0 at its end. From a pipe or a terminal these are all that there are, and if there are none,
   nothing is held back while they are awaited: who types outlines sees a row as soon as the next outline begins.
   Without POSIX one cannot ask what there is, and rows wait for whole blocks and batches. */
static size_t read_some(lines *in, char *to, size_t most)
{
#if HAS_POSIX
    struct pollfd input;
    ssize_t count;
    input.fd = fileno(in->file);
    input.events = POLLIN;
    if (poll(&input, 1, 0) != 1 || !(input.revents & (POLLIN | POLLHUP))) {
        write_held_back();
        fflush(stdout);
        check_standard_output();
    }
    do count = read(input.fd, to, most);
    while (count < 0 && errno == EINTR);
    if (count < 0) die("%s: %s", in->name, strerror(errno));
    return (size_t)count;
#else
    size_t count = fread(to, 1, most, in->file);
    if (count == 0 && ferror(in->file)) die("%s: %s", in->name, strerror(errno));
    return count;
#endif
}

/* The unread text, which is less than a line, moves to the front of the block, and more comes behind it. */
static void read_on(lines *in)
{
    size_t unread = in->end - in->next, count;
    if (in->next > 0) memmove(in->block, in->block + in->next, unread);
    in->feed.at -= in->next;
    in->cr.at -= in->next;
    in->nul.at -= in->next;
    in->next = 0;
    in->end = unread;
    in->block = (char *)grow(in->block, &in->room, in->end + BLOCK_SIZE / 2, 1);
    count = read_some(in, in->block + in->end, in->room - 1 - in->end);
    in->end += count;
    in->ended = count == 0;
}

/* The next bytes of the file, for who does not want lines: 0 at its end. */
static size_t take_bytes(lines *in, char *to, size_t most)
{
    size_t count = in->end - in->next;
    if (count > most) count = most;
    if (count > 0) memcpy(to, in->block + in->next, count);
    in->next += count;
    if (count > 0 || in->ended) return count;
    return read_some(in, to, most);
}

/* --- lines -------------------------------------------------------------------------------------------------------- */

/* Where the byte comes next in the unread text; its end if it does not. */
static size_t find(const lines *in, search *s)
{
    const char *found;
    if (s->at < in->next) s->at = in->next;
    found = (const char *)memchr(in->block + s->at, s->byte, in->end - s->at);
    s->at = found ? (size_t)(found - in->block) : in->end;
    return s->at;
}

/* Where the next line ends: at the first \n, \r\n, lone \r, or with the file. Reads as much of it as that takes. */
static size_t find_line_end(lines *in)
{
    size_t feed, cr, end;
    for (;;) {
        feed = find(in, &in->feed);
        cr = find(in, &in->cr);
        end = feed < cr ? feed : cr;
        if (find(in, &in->nul) < end)
            malformed(in, "a zero byte: this is not plain text%s",
                      in->number == 1 && in->end > 1 &&
                              (memcmp(in->block, "\xff\xfe", 2) == 0 || memcmp(in->block, "\xfe\xff", 2) == 0)
                          ? " but UTF-16: iconv -f UTF-16 -t UTF-8 converts it"
                          : "");
        if (in->ended || feed < in->end || cr + 1 < in->end) return end; /* a \r is not the last: \n could follow */
        if (end - in->next > LONGEST_LINE) malformed(in, "more than 64 MiB without the end of a line");
        read_on(in);
    }
}

/* The next line, without its end; 0 if there is none. */
static int read_line(lines *in)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    size_t end;
    ++in->number;
    end = find_line_end(in);
    if (in->next == in->end) {
        --in->number;
        return 0;
    }
    in->text = in->block + in->next;
    in->next = end + 1;
    if (end + 1 < in->end && in->block[end] == '\r' && in->block[end + 1] == '\n') ++in->next;
    if (end == in->end) in->next = end;
    in->block[end] = '\0';
    if (in->number == 1 && strncmp(in->text, byte_order_mark, 3) == 0) in->text += 3;
    return 1;
}

/* --- fields ------------------------------------------------------------------------------------------------------- */

static int is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

static char *skip_blanks(char *text)
{
    while (is_blank(*text)) ++text;
    return text;
}

static int is_blank_line(char *text)
{
    return *skip_blanks(text) == '\0';
}

static int is_comment(char *text)
{
    return *skip_blanks(text) == '#';
}

/* The text ends at `end` or before the blanks there. */
static void cut(const char *text, char *end)
{
    while (end > text && is_blank(end[-1])) --end;
    *end = '\0';
}

static void trim_end(char *text)
{
    cut(text, text + strlen(text));
}

/* Takes the quotes off a quoted field, where "" stands for one quote; returns what follows the closing one. The field
   then begins behind the opening one. */
static char *unquote(lines *in, char *field)
{
    char *from, *to = field + 1;
    for (from = field + 1; *from != '"' || from[1] == '"'; ++from) {
        if (*from == '\0') malformed(in, "a quote is not closed");
        if (*from == '"') ++from;
        *to++ = *from;
    }
    *from = '\0'; /* in case the field reaches up to here */
    *to = '\0';
    return from + 1;
}

/* The separator or, if that is a blank, any blank; else the end of the text. */
static char *find_separator(char *text, char separator)
{
    char *found;
    if (separator == ' ') {
        while (*text && !is_blank(*text)) ++text;
        return text;
    }
    found = strchr(text, separator);
    return found ? found : text + strlen(text);
}

/* Does a quoted field begin here? Between tabs and blanks, where not everybody quotes, its end has to be in sight. */
static int is_quoted(const char *field, char separator)
{
    const char *end;
    if (*field != '"') return 0;
    if (separator == ',' || separator == ';') return 1;
    for (end = field + 1; *end != '"' || end[1] == '"'; ++end) {
        if (*end == '\0') return 0;
        if (*end == '"') ++end;
    }
    return end[1] == '\0' || end[1] == separator || is_blank(end[1]);
}

/* The field that begins at *rest, without the blanks around it; *rest moves behind it, to NULL after the last one. */
static char *take_field(lines *in, char **rest, char separator)
{
    char *field = *rest, *end;
    int quoted;
    while (*field == ' ' || (separator != '\t' && is_blank(*field))) ++field;
    quoted = is_quoted(field, separator);
    end = find_separator(quoted ? unquote(in, field) : field, separator);
    *rest = *end ? end + 1 : NULL;
    *end = '\0';
    in->quoted = quoted;
    if (!quoted) cut(field, end);
    return quoted ? field + 1 : field;
}

/* Cuts the line into fields, each of which may be quoted: at tabs, semicolons, commas or runs of blanks. */
static void split_line(lines *in, char separator)
{
    char *rest = in->text;
    if (separator == ' ') trim_end(in->text);
    for (in->fields = 0; rest; ++in->fields) {
        in->field = (char **)grow(in->field, &in->field_room, in->fields + 1, sizeof *in->field);
        in->field[in->fields] = take_field(in, &rest, separator);
        if (in->fields == 0) in->first_quoted = in->quoted;
    }
}

/* strtod, the same in every locale: for surfaces/meshfile.h. */
static inline double strtod_everywhere(const char *text, char **end)
{
    static powers_of_ten powers;
    static int ready;
    const char *behind;
    double x = 0;
    if (!ready) prepare_powers(&powers);
    ready = 1;
    behind = read_number(&powers, text, &x);
    if (!behind) behind = text;
    memcpy(end, &behind, sizeof *end);
    return x;
}
#define MESH_STRTOD strtod_everywhere

#endif
