/* json.h - the words of a JSON text, one after the other: what geojson.h is read from. Nothing is kept but the text. */
#ifndef SURFMINK_COMMAND_JSON_H
#define SURFMINK_COMMAND_JSON_H

#include "lines.h"

enum { DEEPEST_JSON = 64 };

typedef struct json {
    const lines *in;
    char *text;
    size_t size, at;
    unsigned long line; /* at which `at` stands */
} json;

static void bad_json(const json *j, const char *what) COMMAND_DIES;
static void bad_json(const json *j, const char *what)
{
    die("%s:%lu: %s", j->in->name, j->line, what);
}

static char json_next(json *j)
{
    for (; j->at < j->size && strchr(" \t\r\n\x1e", j->text[j->at]); ++j->at)
        if (j->text[j->at] == '\n') ++j->line;
    return (char)(j->at < j->size ? j->text[j->at] : '\0');
}

/* Is this character the next one? Then it is taken. */
static int json_takes(json *j, char c)
{
    if (json_next(j) != c) return 0;
    ++j->at;
    return 1;
}

static void json_expect(json *j, char c)
{
    char what[] = "no GeoJSON: expected ' '";
    what[sizeof what - 3] = c;
    if (!json_takes(j, c)) bad_json(j, what);
}

static unsigned json_hex(const json *j, const char *digits)
{
    unsigned code = 0;
    int k;
    for (k = 0; k < 4; ++k) {
        int digit = digits + k < j->text + j->size ? hexadecimal_digit(digits[k]) : -1;
        if (digit < 0) bad_json(j, "no GeoJSON: \\u without four hexadecimal digits");
        code = 16 * code + (unsigned)digit;
    }
    return code;
}

static char *put_utf8(char *to, unsigned code)
{
    if (code < 0x80) {
        *to++ = (char)code;
        return to;
    }
    if (code < 0x800)
        *to++ = (char)(0xc0 | code >> 6);
    else if (code < 0x10000) {
        *to++ = (char)(0xe0 | code >> 12);
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
    } else {
        *to++ = (char)(0xf0 | code >> 18);
        *to++ = (char)(0x80 | (code >> 12 & 0x3f));
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
    }
    *to++ = (char)(0x80 | (code & 0x3f));
    return to;
}

/* A string, decoded in place: it gets shorter, never longer. The text behind it stays. */
static char *json_string(json *j)
{
    static const char escape[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    char *from, *to, *begin, *end = j->text + j->size;
    json_expect(j, '"');
    begin = from = to = j->text + j->at;
    while (from < end && *from != '"') {
        if (*from != '\\') {
            *to++ = *from++;
            continue;
        }
        if (++from < end && *from == 'u') {
            unsigned code = json_hex(j, from + 1), low;
            from += 5;
            if (code >> 10 == 0x36 && from + 1 < end && from[0] == '\\' && from[1] == 'u') { /* half of a pair */
                low = json_hex(j, from + 2);
                if (low >> 10 == 0x37) code = 0x10000 + ((code & 0x3ff) << 10) + (low & 0x3ff), from += 6;
            }
            to = put_utf8(to, code ? code : ' ');
        } else {
            const char *which = from < end && *from ? strchr(escape, *from) : NULL;
            if (!which) bad_json(j, "no GeoJSON: an unknown escape in a string");
            *to++ = meant[which - escape];
            ++from;
        }
    }
    if (from == end) bad_json(j, "no GeoJSON: a string does not end");
    j->at = (size_t)(from - j->text) + 1;
    *to = '\0';
    return begin;
}

/* A number, true, false or null: up to what ends it. */
static void json_word(json *j, char *word, size_t size)
{
    size_t length = 0;
    json_next(j);
    while (j->at < j->size && !strchr(" \t\r\n,]}:", j->text[j->at])) {
        if (length + 1 < size) word[length++] = j->text[j->at];
        ++j->at;
    }
    word[length] = '\0';
    if (length == 0 || strchr("[{\"", word[0])) bad_json(j, "no GeoJSON: a value is missing");
}

static void json_skip(json *j, int depth)
{
    char word[8], c = json_next(j), close = (char)(c == '{' ? '}' : ']');
    if (depth > DEEPEST_JSON) bad_json(j, "nested too deeply");
    if (c == '"')
        json_string(j);
    else if (c != '{' && c != '[')
        json_word(j, word, sizeof word);
    else {
        ++j->at;
        if (json_takes(j, close)) return;
        do {
            if (c == '{') {
                json_string(j);
                json_expect(j, ':');
            }
            json_skip(j, depth + 1);
        } while (json_takes(j, ','));
        json_expect(j, close);
    }
}

static double json_number(json *j)
{
    char word[400];
    double value;
    json_word(j, word, sizeof word);
    if (!parse_number(j->in->powers, word, &value)) bad_json(j, "a coordinate is not a number");
    return value;
}

#endif
