/* relax.c - fuzzes the command relax: its options, the table that it reads, and the tissue that it makes of it. */
#include "world.h"

#define main relax_main
#include "examples/relax.c"
#undef main

/* Would it take long? 99 steps are soon done. */
static int takes_long(void)
{
    int i, told = 0;
    for (i = 1; i + 1 < world.words; ++i)
        if (strcmp(world.word[i], "--steps") == 0) {
            told = 1;
            if (strlen(world.word[i + 1]) > 2) return 1;
        }
    return !told && world.size[0] > 300; /* the usual 300 steps: only of small tissues */
}

/* What the program knows before it reads its options. */
static void begin(void)
{
    static const double usual_axes[3] = {110, 50, 40};
    memcpy(axis, usual_axes, sizeof axis);
    perimeter_stiffness = 0.1;
    shape = 3.722;
    a = 0.2;
    rank = 6;
    cells = vertices = offset[0] = 0;
}

static double energy_said(void)
{
    const char *text = strstr(world.said, "energy ");
    CLAIM(text != NULL);
    return strtod(text + 7, NULL);
}

/* As many rows as corners, and the energy of where they are; no more of it than without a step. */
static void claim_relaxed(void)
{
    static char steps[] = "--steps", none[] = "0";
    const char *text;
    double relaxed = energy_said();
    size_t rows = 0;
    claim_table(world.said);
    for (text = world.said; *text; ++text) rows += *text == '\n';
    CLAIM(rows == offset[cells] + 2);
    CLAIM(relaxed == energy(position) && fabs(relaxed) < HUGE_VAL);
    if (world.words + 2 > WORLD_WORDS) return;
    world_end();
    world.word[world.words++] = steps;
    world.word[world.words++] = none;
    world.word[world.words] = NULL;
    world.allocations = SIZE_MAX;
    begin();
    CLAIM(world_run(relax_main) == EXIT_SUCCESS);
    CLAIM(relaxed <= energy_said());
}

static void fuzz(bytes in)
{
    int status, i, help = 0;
    if (!world_begin(in) || takes_long()) return;
    for (i = 1; i < world.words; ++i) help |= strcmp(world.word[i], "--help") == 0;
    begin();
    status = world_run(relax_main);
    CLAIM(status == EXIT_SUCCESS || status == EXIT_FAILURE);
    CLAIM(status == EXIT_SUCCESS || world.is_full || world.is_stale || world.said_size == 0);
    if (world.said && status == EXIT_SUCCESS && !help) claim_relaxed();
    world_end();
}
