/* lines.h - step 1 of the command: a file -> its lines -> their fields. */
#ifndef SURFMINK_COMMAND_LINES_H
#define SURFMINK_COMMAND_LINES_H

#include "common.h"
#include <errno.h>

typedef struct lines {
    const char *name; /* of the file, as the user wrote it */
    FILE *file;
    unsigned long number; /* of the line that is read, from 1 */
    char *text;           /* this line; split_line cuts it up */
    size_t room;
    char **field;
    size_t fields, field_room;
} lines;

/* The run stops at a line that says nothing: whatever followed would be a guess. */
static void malformed(const lines *in, const char *format, ...) COMMAND_PRINTF(2, 3) COMMAND_DIES;
static void malformed(const lines *in, const char *format, ...)
{
    char reason[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(reason, sizeof reason, format, arguments);
    va_end(arguments);
    die("%s:%lu: %s", in->name, in->number, reason);
}

static void open_lines(lines *in, const char *name)
{
    memset(in, 0, sizeof *in);
    in->name = name;
    in->file = strcmp(name, "-") == 0 ? stdin : fopen(name, "rb");
    if (!in->file) die("%s: %s", name, strerror(errno));
}

static void close_lines(lines *in)
{
    if (in->file != stdin) fclose(in->file);
    free(in->text);
    free(in->field);
}

/* A character, where \n, \r\n and a lone \r all end a line. */
static int next_character(lines *in)
{
    int c = getc(in->file);
    if (c == '\r') {
        c = getc(in->file);
        if (c != '\n' && c != EOF) ungetc(c, in->file);
        return '\n';
    }
    if (c == '\0') malformed(in, "a zero byte: this is not plain text");
    if (c == EOF && ferror(in->file)) die("%s: %s", in->name, strerror(errno));
    return c;
}

/* The next line, without its end; 0 if there is none. */
static int read_line(lines *in)
{
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    size_t n = 0;
    int c;
    ++in->number;
    for (c = next_character(in); c != EOF && c != '\n'; c = next_character(in)) {
        in->text = (char *)grow(in->text, &in->room, n + 2, 1);
        in->text[n++] = (char)c;
    }
    if (c == EOF && n == 0) {
        --in->number;
        return 0;
    }
    in->text = (char *)grow(in->text, &in->room, n + 1, 1);
    in->text[n] = '\0';
    if (in->number == 1 && strncmp(in->text, byte_order_mark, 3) == 0) memmove(in->text, in->text + 3, n - 2);
    return 1;
}

/* --- fields ------------------------------------------------------------------------------------------------------- */

static const char blanks[] = " \t\v\f";

static int is_blank_line(const char *text)
{
    return text[strspn(text, blanks)] == '\0';
}

static int is_comment(const char *text)
{
    return text[strspn(text, blanks)] == '#';
}

static void trim_end(char *text)
{
    size_t n = strlen(text);
    while (n > 0 && strchr(blanks, text[n - 1])) --n;
    text[n] = '\0';
}

/* Takes the quotes off a quoted field, where "" stands for one quote; returns what follows the closing one. */
static char *unquote(lines *in, char *field)
{
    char *from, *to = field;
    for (from = field + 1; *from != '"' || from[1] == '"'; ++from) {
        if (*from == '\0') malformed(in, "a quote is not closed");
        if (*from == '"') ++from;
        *to++ = *from;
    }
    *from = '\0'; /* in case the field reaches up to here */
    *to = '\0';
    return from + 1;
}

/* The field that begins at *rest, without the blanks around it; *rest moves behind it, to NULL after the last one. */
static char *take_field(lines *in, char **rest, char separator)
{
    const char stops[2] = {separator, '\0'};
    char *field = *rest + strspn(*rest, separator == '\t' ? " " : blanks), *end = field;
    int quoted = separator == ',' && *field == '"';
    if (quoted) end = unquote(in, field);
    end += strcspn(end, separator == ' ' ? blanks : stops);
    *rest = *end ? end + 1 : NULL;
    *end = '\0';
    if (!quoted) trim_end(field);
    return field;
}

/* Cuts the line into fields: at each tab, at each comma (where fields may be quoted) or at runs of blanks. */
static void split_line(lines *in, char separator)
{
    char *rest = in->text;
    if (separator == ' ') trim_end(in->text);
    for (in->fields = 0; rest; ++in->fields) {
        in->field = (char **)grow(in->field, &in->field_room, in->fields + 1, sizeof *in->field);
        in->field[in->fields] = take_field(in, &rest, separator);
    }
}

#endif
