/* levelset.c - fuzzes the command levelset: its options, meshes, fields, images, charts, and the table that comes out. */
#define WORLD_MEMORY 1000000 /* --subdivide: 4 times as much each time, and it takes its time */
#include "world.h"

#define main levelset_main
#include "examples/levelset.c"
#undef main

static void fuzz(bytes in)
{
    int status;
    if (!world_begin(in)) return;
    status = world_run(levelset_main);
    CLAIM(status == 0 || status == 1 || status == 2);
    CLAIM(status != 1 || world.is_full || world.is_stale || world.said_size == 0);
    if (world.said && status != 1 && strncmp(world.said, "levelset - ", 11) != 0) claim_table(world.said);
    world_end();
}
