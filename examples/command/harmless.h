/* harmless.h - text of unknown origin, such as names of files and cells, for a terminal; for all commands.

   A control character in it could move the cursor, change what has been written, or end a line of a table: C0 (below
   blank), DEL, and C1, which UTF-8 writes as 0xC2 0x80 to 0xC2 0x9F and 8-bit terminals take as the single byte. */
#ifndef SURFMINK_COMMAND_HARMLESS_H
#define SURFMINK_COMMAND_HARMLESS_H

#include <stdio.h>
#include <string.h>

/* Bytes of the well-formed UTF-8 character at s, 0 if there is none. JSON and XML must not contain anything else. */
static inline int utf8_length(const unsigned char *s)
{
    int i, length = s[0] < 0x80 ? 1 : s[0] < 0xc2 ? 0 : s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : s[0] < 0xf5 ? 4 : 0;
    for (i = 1; i < length; ++i)
        if ((s[i] & 0xc0) != 0x80) return 0;
    if (s[0] == 0xe0 && s[1] < 0xa0) return 0;                 /* overlong */
    if (s[0] == 0xf0 && s[1] < 0x90) return 0;                 /* overlong */
    if (s[0] == 0xf4 && s[1] > 0x8f) return 0;                 /* beyond the last character */
    if (s[0] == 0xed && s[1] > 0x9f) return 0;                 /* a surrogate */
    if (s[0] == 0xef && s[1] == 0xbf && s[2] > 0xbd) return 0; /* a non-character, which XML forbids */
    return length;
}

/* Bytes of the control character at s, 0 if there is none. */
static inline int control_length(const unsigned char *s)
{
    if ((s[0] > 0 && s[0] < ' ') || s[0] == 0x7f) return 1;
    if (s[0] == 0xc2 && s[1] >= 0x80 && s[1] <= 0x9f) return 2;
    return s[0] >= 0x80 && s[0] <= 0x9f; /* alone: within a character of UTF-8 nobody looks for it here */
}

/* Bytes to take together at s: a character of UTF-8, or a byte that is part of none. */
static inline int character_length(const unsigned char *s)
{
    int length = utf8_length(s);
    return length > 0 ? length : 1;
}

/* Every control character becomes a question mark, in place. */
static inline void make_harmless(char *text)
{
    const unsigned char *from = (const unsigned char *)text;
    char *to = text;
    while (*from) {
        int length = character_length(from);
        if (control_length(from))
            *to++ = '?';
        else {
            memmove(to, from, (size_t)length);
            to += length;
        }
        from += length;
    }
    *to = '\0';
}

/* Prints the text so. */
static inline void put_harmless(FILE *out, const char *text)
{
    const unsigned char *s = (const unsigned char *)text;
    while (*s) {
        int length = character_length(s);
        if (control_length(s))
            fputc('?', out);
        else
            fwrite(s, 1, (size_t)length, out);
        s += length;
    }
}

#endif
