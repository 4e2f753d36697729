/* parts.h - step 2 of the command: a polygon -> its rings, repaired -> the batch. */
#ifndef SURFMINK_COMMAND_PARTS_H
#define SURFMINK_COMMAND_PARTS_H

#include "batch.h"
#include "repair.h"

/* Begins with the larger of the rings that a seam joins, so that each comes closed, one after the other. */
static void cut_seam(polygon *p, const size_t seam[2])
{
    size_t stride = stride_of(p->surface), i, from;
    double *sum = sum_areas(p), size[2];
    polygon turned;
    sizes_beside(p, sum, seam, size);
    free(sum);
    from = seam[size[0] > size[1] ? 0 : 1] + 1;
    memset(&turned, 0, sizeof turned);
    begin_polygon(&turned, p->surface, p->id, p->first_line);
    for (i = 0; i < p->n; ++i) {
        size_t at = (from + i) % p->n;
        add_corner(&turned, p->corner + at * stride, p->normal + 3 * at, p->line[at]);
    }
    p->n = 0;
    for (i = 0; i < turned.n; ++i) add_corner(p, turned.corner + i * stride, turned.normal + 3 * i, turned.line[i]);
    free_polygon(&turned);
}

/* Ring number `part` of a polygon. One that runs the other way round than the first is a hole, and is turned. */
static void take_part(polygon *part, const polygon *p, size_t first, size_t end, size_t number, const double turn[3])
{
    size_t stride = stride_of(p->surface), i;
    double area[3];
    char *id = (char *)resize(NULL, strlen(p->id) + 64, 1);
    area_vector(p, first, end, area);
    i = turn[0] * area[0] + turn[1] * area[1] + turn[2] * area[2] < 0;
    sprintf(id, "%s/%lu%s", p->id, (unsigned long)number, i ? "/hole" : "");
    begin_polygon(part, p->surface, id, p->line[first]);
    free(id);
    part->is_mirrored = p->is_mirrored;
    part->fault = p->fault;
    part->fault_line = p->fault_line;
    for (; first < end; ++first)
        add_corner(part, p->corner + first * stride, p->surface == EMBEDDED ? p->normal + 3 * first : NULL,
                   p->line[first]);
    if (i) reverse_corners(part);
}

/* The polygon, or each of its rings if they are to be outlines of their own, goes to the batch as the options want it.
   part: room for one of them. */
static void add_parts(batch *b, polygon *p, polygon *part, const options *o)
{
    size_t first, end, next, seam[2], number = 0;
    double turn[3];
    int has_seam = 0;
    if (o->parts && p->fault == SURFMINK_OK) {
        order_corners(p);
        if (p->fault == SURFMINK_OK) drop_closing_corner(p);
        has_seam = p->fault == SURFMINK_OK && find_seam(p, seam);
        if (has_seam) cut_seam(p, seam);
    }
    for (first = 0; o->parts && first < p->n; first = next) {
        end = ring_end(p, first);
        next = end + 1;
        if (first == 0 && end == p->n) next = end = hole_begin(p); /* the outer ring was left open */
        if (first == 0 && next >= p->n) break;
        if (first == 0) area_vector(p, 0, end, turn);
        take_part(part, p, first, end, number++, turn);
        if (has_seam) remove_spikes(part, o);     /* the rest of the seam */
        if (end == p->n && coincide(p, first, 1)) /* the first ring over again, and not to its end */
            find_fault(part, FAULT_SEVERAL_RINGS, p->line[first]);
        repair_polygon(part, o);
        add_to_batch(b, part);
    }
    if (number > 0) return;
    repair_polygon(p, o);
    add_to_batch(b, p);
}

#endif
