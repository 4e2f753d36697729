/* command.c - fuzzes the command surfmink: its options, its readers, its table, JSON and pictures. */
#include "world.h"

#define HAS_POSIX 0 /* streams in memory have nothing to poll */
#define main      command_main
#include "examples/surfmink.c"
#undef main

/* A column by its name: from the table that was said, mu lies in [0, 1]. */
static void claim_mu(char *text)
{
    static char is_mu[4096];
    char *field = text, *end;
    size_t column = 0;
    int head = 1;
    memset(is_mu, 0, sizeof is_mu);
    for (; *field; field = end + 1) {
        end = field + strcspn(field, "\t\n");
        if (*end == '\0') return;
        if (column < sizeof is_mu) {
            if (head) is_mu[column] = strncmp(field, "mu_", 3) == 0;
            if (!head && is_mu[column] && end > field)
                CLAIM(strtod(field, NULL) >= 0 && strtod(field, NULL) <= 1 + 4 * DBL_EPSILON);
        }
        ++column;
        if (*end == '\n') head = 0;
        if (*end == '\n') column = 0;
    }
}

/* A line of JSON is one object, and its quotes and braces pair. */
static void claim_json(const char *text)
{
    int in_string = 0, depth = 0;
    for (; *text; ++text) {
        if (in_string) {
            CLAIM((unsigned char)*text >= ' ');
            if (*text == '\\') CLAIM(text[1] != '\0');
            if (*text == '\\')
                ++text;
            else if (*text == '"')
                in_string = 0;
        } else if (*text == '"')
            in_string = 1;
        else if (*text == '\n')
            CLAIM(depth == 0);
        else {
            depth += (*text == '{') - (*text == '}');
            CLAIM(depth == (*text != '}'));
        }
    }
    CLAIM(!in_string && depth == 0);
}

static void fuzz(bytes in)
{
    int status, i, json, texts = 0;
    if (!world_begin(in)) return;
    for (i = 1; i < world.words; ++i)
        texts |= strcmp(world.word[i], "--help") == 0 || strcmp(world.word[i], "--version") == 0;
    world.silent = 0;
    for (i = 1; i < world.words; ++i)
        if (strcmp(world.word[i], "--quiet") == 0) world.silent = EXIT_REFUSED; /* or a file or a title of that name */
    progress_is_shown = 0;
    held_back.write = NULL; /* of a run that ended early */
    status = world_run(command_main);
    CLAIM(status == EXIT_MEASURED || status == EXIT_TROUBLE || status == EXIT_REFUSED);
    json = world.said && *world.said == '{'; /* --json may also be a file, behind --, or a title */
    if (world.said && !texts && json) claim_json(world.said);
    if (world.said && !texts && !json) {
        claim_table(world.said);
        claim_mu(world.said);
    }
    world_end();
}
