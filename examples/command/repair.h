/* repair.h - step 2 of the command: a polygon -> the polygon that the options make of it. */
#ifndef SURFMINK_COMMAND_REPAIR_H
#define SURFMINK_COMMAND_REPAIR_H

#include "rings.h"

/* --- corners ------------------------------------------------------------------------------------------------------ */

static void move_corner(polygon *p, size_t to, size_t from)
{
    size_t stride = stride_of(p->surface);
    if (to == from) return;
    memmove(p->corner + to * stride, p->corner + from * stride, stride * sizeof *p->corner);
    if (p->surface == EMBEDDED) memmove(p->normal + to * 3, p->normal + from * 3, 3 * sizeof *p->normal);
    p->line[to] = p->line[from];
    if (p->has_order) p->order[to] = p->order[from];
}

static void swap_corners(polygon *p, size_t i, size_t j)
{
    size_t stride = stride_of(p->surface), k;
    unsigned long line = p->line[i];
    double swap;
    for (k = 0; k < stride; ++k) {
        swap = p->corner[i * stride + k];
        p->corner[i * stride + k] = p->corner[j * stride + k];
        p->corner[j * stride + k] = swap;
    }
    for (k = 0; k < 3 && p->surface == EMBEDDED; ++k) {
        swap = p->normal[3 * i + k];
        p->normal[3 * i + k] = p->normal[3 * j + k];
        p->normal[3 * j + k] = swap;
    }
    p->line[i] = p->line[j];
    p->line[j] = line;
    if (!p->has_order) return;
    swap = p->order[i], p->order[i] = p->order[j], p->order[j] = swap;
}

/* Is the last corner the first one, repeated? */
static int is_closed(const polygon *p)
{
    double gap;
    if (p->n < 2) return 0;
    gap = distance(p, 0, p->n - 1);
    if (gap <= 0) return 1;
    if (p->n < 4 || !(gap < 1e-6 * distance(p, 0, p->n / 2))) return 0; /* far from it: saves the perimeter */
    return gap <= nearly_closed * perimeter_of(p);
}

static void drop_closing_corner(polygon *p)
{
    if (is_closed(p)) --p->n;
}

/* Heap sort by k: in place, and n log n whatever the order was. */
static void sift_down(polygon *p, size_t root, size_t end)
{
    size_t child;
    while ((child = 2 * root + 1) < end) {
        if (child + 1 < end && p->order[child] < p->order[child + 1]) ++child;
        if (!(p->order[root] < p->order[child])) return;
        swap_corners(p, root, child);
        root = child;
    }
}

static void sort_corners(polygon *p)
{
    size_t i;
    for (i = p->n / 2; i > 0; --i) sift_down(p, i - 1, p->n);
    for (i = p->n; i > 1; --i) {
        swap_corners(p, 0, i - 1);
        sift_down(p, 0, i - 1);
    }
}

/* k tells the order of the corners, wherever their lines stand. The first corner may be repeated with its own k. */
static void order_corners(polygon *p)
{
    size_t i;
    int rises = 1;
    if (!p->has_order) return;
    for (i = 0; i < p->n; ++i)
        if (!(fabs(p->order[i]) <= 1e15) || floor(p->order[i]) < p->order[i])
            find_fault(p, FAULT_BAD_ORDER, p->line[i]);
    if (p->n > 1 && p->order[p->n - 1] <= p->order[0] && p->order[p->n - 1] >= p->order[0] && is_closed(p)) --p->n;
    for (i = 1; i < p->n; ++i) rises &= p->order[i - 1] < p->order[i];
    if (rises || p->fault != SURFMINK_OK) return;
    sort_corners(p);
    for (i = 1; i < p->n; ++i)
        if (!(p->order[i - 1] < p->order[i]))
            find_fault(p, FAULT_BAD_ORDER, p->line[i - 1] > p->line[i] ? p->line[i - 1] : p->line[i]);
    p->has_order = 0;
}

/* On a sphere of radius 1. */
static double merge_distance(const polygon *p, const options *o)
{
    if (o->merge_relative) return o->merge_distance * perimeter_of(p);
    return p->surface == SPHERE && o->radius > 0 ? o->merge_distance / o->radius : o->merge_distance;
}

/* surfmink_merge, but lines go along with their corners, and corners of a sphere are compared as directions. */
static void merge_corners(polygon *p, const options *o)
{
    double near = merge_distance(p, o);
    size_t i, kept = 1;
    for (i = 1; i < p->n; ++i) {
        if (near > 0 ? distance(p, i, kept - 1) <= near : coincide(p, i, kept - 1)) continue;
        move_corner(p, kept++, i);
    }
    if (p->n > 0) p->n = kept;
    while (p->n > 1 && (near > 0 ? distance(p, 0, p->n - 1) <= near : coincide(p, 0, p->n - 1))) --p->n;
}

/* Is corner `tip` one that its neighbours i and j do without: coinciding with i, or the tip of a spike that is no wider
   than `near`? */
static int is_needless(const polygon *p, size_t tip, size_t i, size_t j, double near)
{
    double width;
    if (coincide(p, i, tip) || distance(p, i, tip) <= near) return 1;
    return i != j && angle_between(p, tip, i, j, &width) < 1 && width <= near;
}

/* Takes out spikes, however long: x, tip, x; x, y, tip, y, x; x, tip, y, x; ... and with them seams, where an outline
   comes back the way it went. */
static void remove_spikes(polygon *p, const options *o)
{
    size_t i, kept = 0, before = p->n;
    double near = nearly_closed * perimeter_of(p);
    if (o->merge && merge_distance(p, o) > near) near = merge_distance(p, o);
    for (i = 0; i < p->n; ++i) {
        move_corner(p, kept++, i);
        while (kept > 2 && is_needless(p, kept - 2, kept - 3, kept - 1, near)) {
            move_corner(p, kept - 2, kept - 1);
            --kept;
        }
    }
    p->n = kept;
    for (;;) { /* across the first corner */
        if (p->n > 2 && is_needless(p, p->n - 1, p->n - 2, 0, near))
            --p->n;
        else if (p->n > 2 && is_needless(p, 0, p->n - 1, 1, near)) {
            for (i = 1; i < p->n; ++i) move_corner(p, i - 1, i);
            --p->n;
        } else
            break;
    }
    if (p->n < before && p->n >= 3)
        remark("%s:%lu: %s: %lu corners of spikes or seams are taken out", current_file, p->first_line, p->id,
               (unsigned long)(before - p->n));
}

/* --- pixels ------------------------------------------------------------------------------------------------------- */

/* Corners of more outlines than a few buildings have: those of pixels. */
enum { FEWEST_STAIRS = 12 };

/* Do all edges run along the two axes? */
static int is_staircase(const polygon *p)
{
    size_t i;
    if (p->surface != PLANE || p->n <= FEWEST_STAIRS) return 0;
    for (i = 0; i < p->n; ++i) {
        const double *a = p->corner + 2 * i, *b = p->corner + 2 * (i + 1 < p->n ? i + 1 : 0);
        if (fabs(a[0] - b[0]) > 0 && fabs(a[1] - b[1]) > 0) return 0;
    }
    return 1;
}

/* A pass of the mean moves a corner by its edges, so they are to be alike: within a factor of 3, as the sides and
   diagonals of pixels and what is left of them are. */
static int is_uneven(const polygon *p)
{
    double least = HUGE_VAL, most = 0;
    size_t i;
    for (i = 0; i < p->n; ++i) {
        double length = distance(p, i, i + 1 < p->n ? i + 1 : 0);
        if (length < least) least = length;
        if (length > most) most = length;
    }
    return most > 3 * least;
}

/* Told of the first outline that is so. */
static void tell_pixels(const polygon *p, const options *o)
{
    if (!o->smooth && is_staircase(p) && warns(WARN_STAIRS))
        remark("%s:%lu: %s: all edges run along the axes, as those of pixels do, and mu_4 says just that; --resample 1 "
               "--smooth 4 (1: the size of a pixel), or trace a grey image",
               current_file, p->first_line, p->id);
    if (o->smooth && !(o->resample > 0) && is_uneven(p) && warns(WARN_UNEVEN))
        remark("%s:%lu: %s: --smooth wants edges of like length, and these are not; --resample STEP makes them so",
               current_file, p->first_line, p->id);
}

/* Corners at equal distances of about `step` along the outline, from the first one on. On a sphere along the chords. */
static void resample_corners(polygon *p, double step)
{
    polygon fine;
    size_t stride = stride_of(p->surface), n, i, k, edge = 0;
    double length = 0, at, passed = 0, *side = (double *)resize(NULL, p->n + 1, sizeof *side), x[3],
           normal[3] = {0, 0, 0};
    side[0] = 0;
    for (i = 0; i < p->n; ++i) {
        const double *a = p->corner + i * stride, *b = p->corner + (i + 1 < p->n ? i + 1 : 0) * stride;
        side[i] = hypot(hypot(b[0] - a[0], b[1] - a[1]), stride == 3 ? b[2] - a[2] : 0);
        length += side[i];
    }
    if (!(length / step < 1e8))
        die("%s:%lu: --resample %g makes too many corners of an outline of length %g", current_file, p->first_line,
            step, length);
    n = (size_t)(length / step + 0.5);
    if (n < 3) n = 3;
    memset(&fine, 0, sizeof fine);
    begin_polygon(&fine, p->surface, p->id, p->first_line);
    for (i = 0; i < n && length > 0 && p->corner; ++i) {
        const double *a, *b;
        double t;
        size_t next;
        at = length * (double)i / (double)n;
        while (edge + 1 < p->n && passed + side[edge] <= at) passed += side[edge++];
        next = edge + 1 < p->n ? edge + 1 : 0;
        a = p->corner + edge * stride, b = p->corner + next * stride;
        t = side[edge] > 0 ? (at - passed) / side[edge] : 0;
        for (k = 0; k < stride; ++k) x[k] = a[k] + t * (b[k] - a[k]);
        for (k = 0; k < 3 && p->surface == EMBEDDED; ++k)
            normal[k] = p->normal[3 * edge + k] + t * (p->normal[3 * next + k] - p->normal[3 * edge + k]);
        add_corner(&fine, x, normal, p->line[edge]);
    }
    free(side);
    if (fine.n > 0) {
        p->n = 0;
        for (i = 0; i < fine.n; ++i) add_corner(p, fine.corner + i * stride, fine.normal + 3 * i, fine.line[i]);
    }
    free_polygon(&fine);
}

static void smooth_corners(polygon *p, size_t passes)
{
    surfmink_smooth(p->corner, p->n, stride_of(p->surface), passes);
    if (p->surface == EMBEDDED) surfmink_smooth(p->normal, p->n, 3, passes);
}

static void reverse_corners(polygon *p)
{
    size_t i;
    surfmink_reverse(p->corner, p->n, stride_of(p->surface));
    if (p->surface == EMBEDDED) surfmink_reverse(p->normal, p->n, 3);
    for (i = 0; i < p->n / 2; ++i) {
        unsigned long line = p->line[i];
        p->line[i] = p->line[p->n - 1 - i];
        p->line[p->n - 1 - i] = line;
    }
}

/* In the order in which repairs may help each other. A fault shall not be smeared over its neighbours by smoothing. */
static void repair_polygon(polygon *p, const options *o)
{
    size_t end, seam[2];
    double fraction;
    order_corners(p);
    drop_closing_corner(p);
    if (p->fault != SURFMINK_OK) return;
    if (o->merge) merge_corners(p, o);
    if (o->repair) remove_spikes(p, o);
    if ((end = ring_end(p, 0)) < p->n || (end = hole_begin(p)) < p->n) {
        find_fault(p, FAULT_SEVERAL_RINGS, p->line[end]);
        return;
    }
    if (find_seam(p, seam)) {
        find_fault(p, FAULT_SEAM, p->line[seam[1]]);
        return;
    }
    if ((o->order == 4 || o->error) && p->n > 3 && (end = find_short_edge(p, &fraction)) < p->n &&
        !coincide(p, end, end + 1 < p->n ? end + 1 : 0)) {
        find_fault(p, FAULT_SHORT_EDGE, p->line[end + 1 < p->n ? end + 1 : 0]);
        return;
    }
    tell_pixels(p, o);
    if (o->smooth && (end = find_spike(p, &fraction)) < p->n && p->n > 4) {
        find_fault(p, FAULT_SPIKE, p->line[end]);
        return;
    }
    if (o->resample > 0) resample_corners(p, o->resample);
    smooth_corners(p, o->smooth);
    if (o->reverse == REVERSE_ALWAYS) reverse_corners(p);
}

#endif
