/* common.h - what all parts of the command need: complaints, memory, counts out of text, text into tables. */
#ifndef SURFMINK_COMMAND_COMMON_H
#define SURFMINK_COMMAND_COMMON_H

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../beyond/curve.h" /* here, before options is a type */
#include "harmless.h"

#if defined(__GNUC__)
#define COMMAND_PRINTF(text, first) __attribute__((format(printf, text, first)))
#define COMMAND_DIES                __attribute__((noreturn))
#else
#define COMMAND_PRINTF(text, first)
#define COMMAND_DIES
#endif

/* Who complains. Another command that includes these parts says its own name before. */
#ifndef COMMAND_NAME
#define COMMAND_NAME "surfmink"
#endif

/* Exit statuses: all measured, something is wrong with the call or its input, some outlines were refused. */
enum { EXIT_MEASURED = 0, EXIT_TROUBLE = 1, EXIT_REFUSED = 2 };

/* --- what is held back -------------------------------------------------------------------------------------------- */

/* Polygons are measured many at a time. Those that have been read and wait for others are measured and written at once
   if the run ends early or the input pauses: nobody shall notice that they had to wait. */
static struct {
    void (*write)(void *context);
    void *context;
} held_back;

static void write_held_back(void)
{
    void (*write)(void *) = held_back.write;
    held_back.write = NULL; /* should this end the run, it is not tried again */
    if (write) write(held_back.context);
    held_back.write = write;
}

/* --- complaints --------------------------------------------------------------------------------------------------- */

/* Is there an unfinished progress line on the terminal? The next complaint has to wipe it first. */
static int progress_is_shown;

static void wipe_progress(void)
{
    if (progress_is_shown) fputs("\r\033[K", stderr);
    progress_is_shown = 0;
}

/* Takes the last line of a run that must not just end; it does not return. NULL: die ends the run itself. */
static void (*last_words)(const char *line);

/* One line to standard error, which cannot command a terminal, whatever it quotes. */
static void say(const char *line)
{
    fflush(stdout);
    wipe_progress();
    put_harmless(stderr, line);
    fputc('\n', stderr);
}

/* The file that is being read, for remarks. */
static const char *current_file = "-";

/* --quiet: no remarks. */
static int says_nothing;

/* A line about something that is no reason to end the run. */
static void remark(const char *format, ...) COMMAND_PRINTF(1, 2);
static void remark(const char *format, ...)
{
    va_list arguments;
    char line[4096];
    if (says_nothing) return;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    say(line);
}

/* Warnings are remarks about what may not be as it was meant. Of each kind only the first one is told; all are counted,
   and the last line of a run has their number. */
enum warning {
    WARN_COLUMN,
    WARN_AGAIN,
    WARN_COMMA,
    WARN_RADIUS,
    WARN_SPIKE,
    WARN_CROSSING,
    WARN_SIDE,
    WARN_STAIRS,
    WARN_UNEVEN,
    WARN_LONG,
    WARN_BREAK,
    WARNINGS
};

static struct {
    unsigned long all;
    int told[WARNINGS];
} warnings;

/* Counts a warning of this kind; is it the first one, and to be told? */
static int warns(enum warning kind)
{
    if (says_nothing) return 0;
    ++warnings.all;
    return !warnings.told[kind]++;
}

/* One line, and the end. What has been read so far goes out first, so that the two keep their order. */
static void die(const char *format, ...) COMMAND_PRINTF(1, 2) COMMAND_DIES;
static void die(const char *format, ...)
{
    va_list arguments;
    char line[8192];
    write_held_back();
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    if (last_words) last_words(line);
    say(line);
    exit(EXIT_TROUBLE);
}

static void check_standard_output(void)
{
    if (ferror(stdout)) die(COMMAND_NAME ": cannot write to standard output: %s", strerror(errno));
}

/* Some disks say only now that they are full. */
static void close_standard_output(void)
{
    if (fclose(stdout) == 0) return;
    fprintf(stderr, COMMAND_NAME ": cannot write to standard output: %s\n", strerror(errno));
    exit(EXIT_TROUBLE);
}

/* --- memory ------------------------------------------------------------------------------------------------------- */

static void *resize(void *array, size_t count, size_t size)
{
    void *moved = count <= SIZE_MAX / size ? realloc(array, count * size) : NULL;
    if (!moved) die(COMMAND_NAME ": out of memory");
    return moved;
}

/* Makes room for at least `need` elements; doubling keeps the cost of growing one by one linear. */
static void *grow(void *array, size_t *room, size_t need, size_t size)
{
    size_t more = need > 2 * *room ? need : 2 * *room;
    if (need <= *room) return array;
    if (more < 16) more = 16;
    array = resize(array, more, size); /* if that ends the run, what is left is written with the room that there is */
    *room = more;
    return array;
}

/* --- numbers into text -------------------------------------------------------------------------------------------- */

/* A number that is not negative, with so many decimals: as printf, but the same in every locale. */
static void put_decimals(FILE *file, double number, int decimals)
{
    long whole = 1, all;
    int k;
    for (k = 0; k < decimals; ++k) whole *= 10;
    all = lround(number * (double)whole);
    fprintf(file, "%ld.%0*ld", all / whole, decimals, all % whole);
}

/* --- counts out of text ------------------------------------------------------------------------------------------- */

/* The whole text as a count: digits and nothing else, so neither -1 nor 1e3. */
static int parse_count(const char *text, size_t *value)
{
    size_t digit;
    *value = 0;
    if (*text == '\0') return 0;
    for (; *text; ++text) {
        if (*text < '0' || *text > '9') return 0;
        digit = (size_t)(*text - '0');
        if (*value > (SIZE_MAX - digit) / 10) return 0;
        *value = 10 * *value + digit;
    }
    return 1;
}

/* --- text into tables --------------------------------------------------------------------------------------------- */

enum notation { IN_TABLE, IN_JSON, IN_XML };

static void put_ascii(FILE *out, int c, enum notation notation)
{
    if (notation == IN_JSON && (c == '"' || c == '\\'))
        fprintf(out, "\\%c", c);
    else if (notation == IN_XML && strchr("&<>\"", c))
        fprintf(out, "&#%d;", c);
    else
        fputc(c, out);
}

/* A control character would break the line or the document. */
static void put_control(FILE *out, const unsigned char *s, enum notation notation)
{
    if (notation == IN_JSON && (s[0] < 0x80 || s[0] == 0xc2))
        fprintf(out, "\\u%04x", (unsigned)(s[0] == 0xc2 ? s[1] : s[0]));
    else
        fputs(notation == IN_TABLE || s[0] < 0x80 || s[0] == 0xc2 ? " " : "\xef\xbf\xbd", out);
}

/* Text of unknown origin. Where the notation cannot hold a byte, the replacement character U+FFFD stands for it. */
static void put_text(FILE *out, const char *text, enum notation notation)
{
    const unsigned char *s = (const unsigned char *)text;
    int length;
    while (*s) {
        length = utf8_length(s);
        if (control_length(s))
            put_control(out, s, notation);
        else if (length == 1)
            put_ascii(out, *s, notation);
        else if (length > 1)
            fwrite(s, 1, (size_t)length, out);
        else if (notation == IN_TABLE)
            fputc(*s, out);
        else
            fputs("\xef\xbf\xbd", out);
        s += length > 0 ? length : 1;
    }
}

#endif
