/* ply.h - step 5 of the command, if asked for: the shapes of a picture -> polygons in space, in the format PLY.

   Every outline has its own vertices, so that each can carry the colour and the mu_p of its outline: some programs read
   such properties of faces, others those of vertices, and some only the colours. */
#ifndef SURFMINK_COMMAND_PLY_H
#define SURFMINK_COMMAND_PLY_H

#include "map.h"

static void put_ply_number(FILE *file, const powers_of_ten *powers, double value)
{
    char text[32];
    fwrite(text, 1, (size_t)(write_number(powers, text, 17, value) - text), file);
}

static void declare_measures(FILE *file, const options *o)
{
    int p;
    fputs("property uchar red\nproperty uchar green\nproperty uchar blue\n", file);
    for (p = 1; p <= o->max_rank; ++p) fprintf(file, "property double mu_%d\n", p);
}

static void write_ply_header(FILE *file, const picture *g, const options *o, const range *r)
{
    size_t i, most = 0;
    for (i = 0; i < g->shapes; ++i)
        if (g->shape[i].n > most) most = g->shape[i].n;
    fputs("ply\nformat ascii 1.0\n"
          "comment surfmink " SURFMINK_VERSION ": outlines with their p-fold symmetry mu_p, 0 to 1; -1: refused\n"
          "comment every outline has its own vertices; vertices and faces carry its colour and its mu_p\n",
          file);
    fputs("comment colours: ", file);
    describe_colors(file, &o->color_by.of[0], r);
    fputs("; grey: refused or undefined\n", file);
    fprintf(file, "element vertex %lu\n", (unsigned long)g->corners);
    fputs("property double x\nproperty double y\nproperty double z\n"
          "property double nx\nproperty double ny\nproperty double nz\n",
          file);
    declare_measures(file, o);
    fprintf(file, "element face %lu\nproperty list %s int vertex_indices\n", (unsigned long)g->shapes,
            most < 256 ? "uchar" : "int");
    declare_measures(file, o);
    fputs("end_header\n", file);
}

/* What a vertex and a face have in common. */
static void put_measures(FILE *file, const powers_of_ten *powers, const picture *g, const options *o, size_t i,
                         const range *r)
{
    int color[3] = {150, 150, 150}, p;
    if (g->shape[i].status == SURFMINK_OK) find_value_color(r, value_of(g, o, i, 0), color);
    fprintf(file, " %d %d %d", color[0], color[1], color[2]);
    for (p = 1; p <= o->max_rank; ++p) {
        fputc(' ', file);
        put_ply_number(file, powers, g->shape[i].status == SURFMINK_OK ? mu_of(g, o, i, p) : -1);
    }
    fputc('\n', file);
}

static void write_ply_vertices(FILE *file, const powers_of_ten *powers, const picture *g, const options *o,
                               const range *r)
{
    double unit = g->surface == SPHERE ? radius_of(o) : 1;
    size_t i, j, k;
    for (i = 0; i < g->shapes; ++i)
        for (j = g->shape[i].first; j < g->shape[i].first + g->shape[i].n; ++j) {
            for (k = 0; k < 3; ++k) {
                if (k > 0) fputc(' ', file);
                put_ply_number(file, powers, unit * g->corner[3 * j + k]);
            }
            for (k = 0; k < 3; ++k) {
                fputc(' ', file);
                put_ply_number(file, powers, g->normal[3 * j + k]);
            }
            put_measures(file, powers, g, o, i, r);
        }
}

static void write_ply(const picture *g, const options *o, const powers_of_ten *powers)
{
    FILE *file = open_page(o->ply);
    range r = color_range(g, o, 0);
    size_t i, j;
    write_ply_header(file, g, o, &r);
    write_ply_vertices(file, powers, g, o, &r);
    for (i = 0; i < g->shapes; ++i) {
        fprintf(file, "%lu", (unsigned long)g->shape[i].n);
        for (j = 0; j < g->shape[i].n; ++j) fprintf(file, " %lu", (unsigned long)(g->shape[i].first + j));
        put_measures(file, powers, g, o, i, &r);
    }
    close_page(file, o->ply);
}

#endif
