/* patic.c - fuzzes the p-atic field: its topology, from outlines on a small lattice where all sorts of cells meet;
   and the command patic, its options, tables and pictures. An input that begins with the byte 1 is outlines. */
#include "world.h"

#define HAS_POSIX 0 /* streams in memory have nothing to poll */
#define main      patic_main
#include "examples/patic.c"
#undef main

enum { CELLS = 12, MOST = 8, RANK = 6 };

/* --- outlines ----------------------------------------------------------------------------------------------------- */

/* Corners on a lattice of 4 x 4 or 4 x 4 x 2 points, now and then a little off it. */
static size_t take_cells(bytes *in, int kind, size_t *offset, double *corner, double *normal)
{
    size_t cells = take(in) % (CELLS + 1), c, k, n, dim = kind == SURFMINK_PLANE ? 2 : 3, at = 0;
    for (offset[0] = 0, c = 0; c < cells; ++c) {
        n = take(in) % (MOST + 1);
        for (; n > 0; --n, ++at) {
            unsigned place = take(in);
            double off = place >= 224 ? take(in) / 1024.0 : 0;
            double x[3];
            x[0] = place % 4 + off;
            x[1] = place / 4 % 4;
            x[2] = kind == SURFMINK_SPHERE ? 2 : place / 16 % 2;
            for (k = 0; k < dim; ++k) corner[dim * at + k] = x[k] - (kind == SURFMINK_SPHERE && k < 2 ? 1.5 : 0);
            for (k = 0; k < 3; ++k) normal[3 * at + k] = kind == SURFMINK_EMBEDDED && k < 2 ? x[k] - 1.5 : k == 2;
        }
        offset[c + 1] = at;
    }
    return cells;
}

/* Twins belong together, every step to one loop, a closed loop to one vertex; and Euler's formula. */
static void claim_topology(const patic *t)
{
    size_t h, l, i, steps = 0, measured = 0, corners = t->offset[t->cells];
    long chi = 0;
    for (i = 0; i < t->cells; ++i) {
        measured += t->cell[i].status == SURFMINK_OK;
        CLAIM(*patic_status_name(t->cell[i].status) && *patic_strerror(t->cell[i].status));
        CLAIM(t->cell[i].other == PATIC_NONE || t->cell[i].other < i);
    }
    CLAIM(measured == t->measured);
    for (h = 0; h < corners; ++h) {
        size_t twin = t->twin[h];
        CLAIM((twin == PATIC_NONE) == (t->loop_at[h] == PATIC_NONE));
        if (twin == PATIC_NONE) continue;
        CLAIM(t->twin[twin] == h && t->owner[twin] != t->owner[h]);
        CLAIM(t->cell[t->owner[h]].status == SURFMINK_OK);
        CLAIM(t->vertex[h] == patic__end(t, twin) && t->vertex[twin] == patic__end(t, h));
    }
    for (l = 0; l < t->loops; ++l) {
        steps += t->loop[l].steps;
        for (i = 0, h = t->loop[l].first; i < t->loop[l].steps; ++i, h = patic__next_in_loop(t, h)) {
            CLAIM(t->loop_at[h] == l);
            CLAIM(!t->loop[l].closed || t->vertex[h] == t->vertex[t->loop[l].first]);
        }
    }
    CLAIM(steps == 2 * t->shared);
    for (i = 0; i < t->components; ++i) chi += t->component[i].chi;
    CLAIM(chi == t->chi && chi == (long)t->measured - (long)t->shared + (long)t->faces);
}

static void claim_field(patic *t, bytes *in)
{
    static double z[2 * CELLS], coarse[2 * CELLS];
    static size_t round[CELLS];
    int p = 1 + (int)(take(in) % RANK);
    size_t i, k, count;
    long charge = 0, sum = 0;
    CLAIM(patic_field(t, p, z, NULL) == SURFMINK_OK);
    CLAIM(patic_coarsen(t, p, take(in) / 32.0, z, coarse) == SURFMINK_OK);
    for (i = 0; i < t->cells; ++i) {
        CLAIM(hypot(coarse[2 * i], coarse[2 * i + 1]) <= 1 + 4 * DBL_EPSILON);
        if (t->cell[i].status != SURFMINK_OK) CLAIM(z[2 * i] == 0 && coarse[2 * i] == 0);
    }
    CLAIM(patic_charges(t, p, coarse) == SURFMINK_OK);
    for (i = 0; i < t->loops; ++i) {
        CLAIM(t->loop[i].margin >= 0 && t->loop[i].margin <= 1);
        if (t->loop[i].closed) charge += t->loop[i].k;
    }
    count = patic_defects(t, coarse);
    for (i = 0; i < count; ++i) {
        sum += t->defect[i].k;
        CLAIM(t->defect[i].k != 0 && t->defect[i].margin >= 0 && t->defect[i].margin <= 1);
        k = patic_around(t, &t->defect[i], round);
        CLAIM(k >= 3 && k <= t->cells);
        for (; k > 0; --k) CLAIM(round[k - 1] < t->cells && t->cell[round[k - 1]].status == SURFMINK_OK);
    }
    CLAIM(sum == charge);
}

static void fuzz_cells(bytes in)
{
    static double corner[3 * CELLS * MOST], normal[3 * CELLS * MOST];
    static size_t offset[CELLS + 1];
    static union {
        double aligned;
        char bytes[65536];
    } memory;
    int kind = (int)(take(&in) % 3);
    double weld = take(&in) / 256.0 - 0.1;
    size_t cells = take_cells(&in, kind, offset, corner, normal);
    surfmink_outline all = kind == SURFMINK_PLANE    ? surfmink_plane(corner, offset[cells])
                           : kind == SURFMINK_SPHERE ? surfmink_sphere(corner, offset[cells], 1)
                                                     : surfmink_embedded(corner, normal, offset[cells]);
    patic t;
    CLAIM(patic_bytes(offset, cells, RANK) <= sizeof memory.bytes);
    memset(memory.bytes, 0x5a, sizeof memory.bytes);
    CLAIM(patic_build(&t, &all, offset, cells, RANK, weld, memory.bytes + take(&in) % 16) == SURFMINK_OK);
    claim_topology(&t);
    claim_field(&t, &in);
}

static void fuzz(bytes in)
{
    int status, i, help = 0;
    if (in.left > 0 && in.at[0] == 1) {
        take(&in);
        fuzz_cells(in);
        return;
    }
    if (!world_begin(in)) return;
    world.silent = 0;
    for (i = 1; i < world.words; ++i) {
        help |= strcmp(world.word[i], "--help") == 0;
        if (strcmp(world.word[i], "--quiet") == 0) world.silent = EXIT_REFUSED;
    }
    status = world_run(patic_main);
    CLAIM(status == EXIT_MEASURED || status == EXIT_TROUBLE || status == EXIT_REFUSED);
    if (world.said && !help) claim_table(world.said);
    world_end();
}
