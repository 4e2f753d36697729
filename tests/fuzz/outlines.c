/* outlines.c - fuzzes the command outlines: its options, readers of TIFF, NPY and PGM, boundaries, charts, and the
   table that comes out; and numbers painted back. */
#define WORLD_MEMORY 4000000 /* an input of a few hundred bytes has few pixels, whatever it announces */
#include "world.h"

#define main outlines_main
#include "examples/outlines.c"
#undef main

static void fuzz(bytes in)
{
    int status, is_short;
    if (!world_begin(in)) return;
    is_short = world.allocations < SIZE_MAX;
    status = world_run(outlines_main);
    CLAIM(status == 0 || status == 1 || status == 2);
    CLAIM(status != 1 || world.is_full || world.is_stale || is_short || world.said_size == 0);
    if (world.said && status != 1 && strncmp(world.said, "outlines - ", 11) != 0) claim_table(world.said);
    world_end();
}
