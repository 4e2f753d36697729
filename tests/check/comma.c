/* comma.c - linked to a program, makes it run in the locale that COMMA_LOCALE names, where the point is a comma. */
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

static void __attribute__((constructor)) speak_german(void)
{
    const char *name = getenv("COMMA_LOCALE");
    if (name && setlocale(LC_ALL, name) && localeconv()->decimal_point[0] == ',') return;
    fputs("comma.c: no locale with a comma\n", stderr);
    exit(99);
}
