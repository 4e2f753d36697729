/* antimeridian.h - rings of longitudes and latitudes: which way they run; pieces that were cut at 180 degrees joined.

   RFC 7946 (3.1.9) wants a polygon that crosses the antimeridian cut in two there, and one round a pole drawn down to
   it and back along 180 and -180 degrees. On the sphere there is no such seam. Where a side along 180 meets the same
   side, run the other way, both go away, and what is left is linked up. */
#ifndef SURFMINK_COMMAND_ANTIMERIDIAN_H
#define SURFMINK_COMMAND_ANTIMERIDIAN_H

#include "common.h"

typedef struct lonlat_ring {
    size_t first, count; /* points */
    size_t id, part;     /* whose it is */
    size_t hole;         /* 0: the outer ring of its part; else a hole, which runs counter-clockwise as others do */
    unsigned long line;
} lonlat_ring;

typedef struct lonlat_rings {
    lonlat_ring *ring;
    size_t count, room;
    double *point; /* lon, lat */
    size_t points, point_room;
} lonlat_rings;

static void begin_ring(lonlat_rings *all, size_t id, size_t part, size_t hole, unsigned long line)
{
    lonlat_ring *r;
    all->ring = (lonlat_ring *)grow(all->ring, &all->room, all->count + 1, sizeof *all->ring);
    r = &all->ring[all->count++];
    r->first = all->points;
    r->count = 0;
    r->id = id;
    r->part = part;
    r->hole = hole;
    r->line = line;
}

static void add_to_ring(lonlat_rings *all, double lon, double lat)
{
    all->point = (double *)grow(all->point, &all->point_room, 2 * (all->points + 1), sizeof *all->point);
    all->point[2 * all->points] = lon;
    all->point[2 * all->points++ + 1] = lat;
    ++all->ring[all->count - 1].count;
}

static void free_rings(lonlat_rings *all)
{
    free(all->ring);
    free(all->point);
}

/* Twice the area in the plane of lon and lat, positive if it runs counter-clockwise. On the sphere longitudes may jump
   from 180 to -180; *closes: 0 if they then do not come back, for the ring goes round a pole. */
static double lonlat_area(const lonlat_rings *all, const lonlat_ring *r, int on_sphere, int *closes)
{
    const double *p = all->point + 2 * r->first;
    double sum = 0, shift = 0, x = 0;
    size_t i, j;
    for (i = 0; i < r->count; ++i) {
        double step;
        j = i + 1 < r->count ? i + 1 : 0;
        step = p[2 * j] - p[2 * i];
        if (on_sphere && step > 180) step -= 360, --shift;
        if (on_sphere && step < -180) step += 360, ++shift;
        sum += x * (p[2 * j + 1] - p[1]) - (x + step) * (p[2 * i + 1] - p[1]);
        x += step;
    }
    *closes = shift <= 0 && shift >= 0;
    return sum;
}

/* Does it run clockwise? As GeoJSON draws it, with a seam where it goes round a pole. */
static int is_clockwise(const lonlat_rings *all, const lonlat_ring *r, int on_sphere)
{
    int closes;
    double area = lonlat_area(all, r, on_sphere, &closes);
    if (!closes) area = lonlat_area(all, r, 0, &closes);
    return area < 0;
}

static void reverse_ring(lonlat_rings *all, const lonlat_ring *r)
{
    size_t i, j;
    int k;
    for (i = r->first, j = r->first + r->count; i + 1 < j; ++i)
        for (--j, k = 0; k < 2; ++k) {
            double swap = all->point[2 * i + (size_t)k];
            all->point[2 * i + (size_t)k] = all->point[2 * j + (size_t)k];
            all->point[2 * j + (size_t)k] = swap;
        }
}

/* A corner of the rings that are joined; what goes away is no longer linked to. */
typedef struct seam_node {
    double lon, lat;
    size_t next, ring;
    int visited;
} seam_node;

static int on_seam(const seam_node *a)
{
    return fabs(a->lat) >= 90 || fabs(fabs(a->lon) - 180) <= 0;
}

/* The same point of the sphere? */
static int same_point(const seam_node *a, const seam_node *b)
{
    if (a->lat < b->lat || a->lat > b->lat) return 0;
    if (fabs(a->lat) >= 90) return 1;
    return fabs(a->lon - b->lon) <= 0 || (on_seam(a) && on_seam(b));
}

/* Is the side that leaves node a one along the seam? */
static int is_seam(const seam_node *node, size_t a)
{
    return on_seam(&node[a]) && on_seam(&node[node[a].next]) && !same_point(&node[a], &node[node[a].next]);
}

/* Sides along the seam get nodes where other pieces have corners on it. */
static size_t split_seam(seam_node **node, size_t count, size_t *room)
{
    size_t a, b, whole = count;
    for (a = 0; a < count; ++a)
        for (b = 0; b < whole && is_seam(*node, a); ++b) {
            const seam_node *from = *node + a, *to = *node + from->next, *at = *node + b;
            if (!on_seam(at) ||
                !((from->lat < at->lat && at->lat < to->lat) || (to->lat < at->lat && at->lat < from->lat)))
                continue;
            *node = (seam_node *)grow(*node, room, count + 1, sizeof **node);
            (*node)[count] = (*node)[a];
            (*node)[count].lat = (*node)[b].lat;
            (*node)[count].next = (*node)[a].next;
            (*node)[a].next = count++;
        }
    return count;
}

/* Are the sides that leave a and c the same one, run opposite ways? */
static int is_pair(const seam_node *node, size_t a, size_t c)
{
    return a != c && same_point(&node[a], &node[node[c].next]) && same_point(&node[node[a].next], &node[c]);
}

/* Takes such a pair a -> b and c -> d out; a and d are one point, b and c are. */
static void cancel_pair(seam_node *node, size_t a, size_t c)
{
    size_t b = node[a].next, d = node[c].next, behind_b = node[b].next, behind_d = node[d].next;
    if (b == c && a == d) { /* nothing is left of this ring */
        node[a].next = a;
        node[b].next = b;
        return;
    }
    if (b != c) node[c].next = behind_b;
    if (a != d) node[a].next = behind_d;
}

/* Is the node still part of a ring: can it be reached from itself? */
static int is_linked(const seam_node *node, size_t a, size_t count)
{
    size_t i = node[a].next, steps;
    for (steps = 0; steps < count && i != a; ++steps) i = node[i].next;
    return i == a;
}

/* The corners of the rings from `first` on as nodes. */
static seam_node *list_nodes(const lonlat_rings *all, size_t first, size_t *count, size_t *room)
{
    seam_node *node = NULL;
    size_t i, j;
    *count = *room = 0;
    for (i = first; i < all->count; ++i) {
        const lonlat_ring *r = &all->ring[i];
        for (j = 0; j < r->count; ++j) {
            node = (seam_node *)grow(node, room, *count + 1, sizeof *node);
            node[*count].lon = all->point[2 * (r->first + j)];
            node[*count].lat = all->point[2 * (r->first + j) + 1];
            node[*count].next = j + 1 < r->count ? *count + 1 : *count + 1 - r->count;
            node[*count].ring = i;
            node[(*count)++].visited = 0;
        }
    }
    return node;
}

/* Takes out all pairs along the seam; returns whether there were any. */
static int cancel_pairs(seam_node **node, size_t *count, size_t *room)
{
    size_t a, c;
    int joined = 0;
    for (a = 0; a < *count; ++a) /* a pole with several longitudes is one corner */
        while ((*node)[a].next != a && fabs((*node)[a].lat) >= 90 && same_point(*node + a, *node + (*node)[a].next))
            (*node)[a].next = (*node)[(*node)[a].next].next;
    *count = split_seam(node, *count, room);
    for (a = 0; a < *count; ++a)
        for (c = 0; c < *count && is_seam(*node, a); ++c) {
            if (!is_seam(*node, c) || !is_pair(*node, a, c)) continue;
            if (!is_linked(*node, a, *count) || !is_linked(*node, c, *count)) continue;
            cancel_pair(*node, a, c);
            joined = 1;
            c = (size_t)-1; /* the side that now leaves a may be one, too */
        }
    return joined;
}

/* Of two rings round a pole that belong to one part, a belt, the one nearer to the pole is a hole. */
static void find_belt(lonlat_rings *all, size_t first, size_t *holes)
{
    lonlat_ring *r = &all->ring[all->count - 1];
    int closes;
    for (; first + 1 < all->count; ++first) {
        lonlat_ring *other = &all->ring[first];
        if (other->id != r->id || other->part != r->part || other->hole || r->hole) continue;
        lonlat_area(all, other, 1, &closes);
        if (closes) continue;
        if (fabs(all->point[2 * other->first + 1]) <= fabs(all->point[2 * r->first + 1])) other = r;
        other->hole = ++*holes;
    }
}

/* The rings that the nodes now make come behind the others. What was cut may enclose a hole when it is joined. Returns
   their number: 0 if all that was there is the seam, as of a belt round the globe with two corners on each side. */
static size_t link_rings(lonlat_rings *all, seam_node *node, size_t count)
{
    size_t a, i, holes = 0, before = all->count;
    double area;
    int closes;
    for (a = 0; a < count; ++a) {
        size_t least = node[a].ring;
        lonlat_ring *r;
        if (node[a].visited || !is_linked(node, a, count)) continue;
        begin_ring(all, 0, 0, 0, 0);
        for (i = a; !node[i].visited; i = node[i].next) {
            node[i].visited = 1;
            if (node[i].ring < least) least = node[i].ring;
            add_to_ring(all, node[i].lon, node[i].lat);
        }
        r = &all->ring[all->count - 1];
        r->id = all->ring[least].id;
        r->part = all->ring[least].part;
        r->hole = all->ring[least].hole;
        r->line = all->ring[least].line;
        if (r->hole > holes) holes = r->hole;
        area = lonlat_area(all, r, 1, &closes);
        if (r->count < 3)
            --all->count;
        else if (!r->hole && closes && area < 0)
            r->hole = ++holes;
        else if (!r->hole && !closes)
            find_belt(all, before, &holes);
    }
    return all->count - before;
}

/* Turns the rings from `first` on, those of one feature, so that each is an outline: outer rings and holes run
   counter-clockwise. On the sphere joins what was cut at the antimeridian, unless a corner is none of a sphere; returns
   whether anything was. */
static int finish_rings(lonlat_rings *all, size_t first, int on_sphere)
{
    size_t i, a, count, room, before = all->count, seams = 0;
    seam_node *node;
    int joined = 0;
    for (i = first; i < all->count; ++i) {
        lonlat_ring *r = &all->ring[i];
        const double *p = all->point + 2 * r->first, *end = p + 2 * r->count, *at;
        for (at = p; at < end; at += 2) on_sphere &= fabs(at[1]) <= 90;
        if (r->count > 1 && fabs(p[0] - end[-2]) <= 0 && fabs(p[1] - end[-1]) <= 0) --r->count;
        if (is_clockwise(all, r, on_sphere) != (r->hole > 0)) reverse_ring(all, r);
    }
    node = on_sphere ? list_nodes(all, first, &count, &room) : NULL;
    for (a = 0; node && a < count; ++a) seams += (size_t)is_seam(node, a);
    if (seams > 1 && cancel_pairs(&node, &count, &room)) joined = link_rings(all, node, count) > 0;
    free(node);
    if (joined) {
        memmove(all->ring + first, all->ring + before, (all->count - before) * sizeof *all->ring);
        before = first + all->count - before;
    }
    all->count = before;
    for (i = first; i < all->count; ++i)
        if (all->ring[i].hole) reverse_ring(all, &all->ring[i]);
    return joined;
}

#endif
