/* tissue.c - fuzzes the command tissue: its options, and the cells that it makes of a few seeds. */
#include "world.h"

#define main tissue_main
#include "examples/tissue.c"
#undef main

/* Would it take long? 99 cells and 9 rounds are soon done. */
static int takes_long(void)
{
    int i;
    for (i = 1; i + 1 < world.words; ++i)
        if (strlen(world.word[i + 1]) > (strcmp(world.word[i], "--cells") == 0   ? 2
                                         : strcmp(world.word[i], "--relax") == 0 ? 1
                                                                                 : 511))
            return 1;
    return 0;
}

/* Three cells share each of the 2 cells - 4 corners. */
static void claim_corners(const char *text)
{
    int rows = -4; /* three comments and the names */
    for (; *text; ++text) rows += *text == '\n';
    CLAIM(rows == 3 * (2 * cells - 4));
}

static void fuzz(bytes in)
{
    static const double usual_axes[3] = {110, 50, 40};
    int status, i, help = 0;
    memcpy(axis, usual_axes, sizeof axis);
    cells = 40;
    if (!world_begin(in) || takes_long()) return;
    for (i = 1; i < world.words; ++i) help |= strcmp(world.word[i], "--help") == 0;
    status = world_run(tissue_main);
    CLAIM(status == EXIT_SUCCESS || status == EXIT_FAILURE);
    CLAIM(status == EXIT_SUCCESS || world.is_full || world.is_stale || world.said_size == 0);
    if (world.said && status == EXIT_SUCCESS && !help) {
        claim_table(world.said);
        claim_corners(world.said);
    }
    world_end();
}
