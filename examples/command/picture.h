/* picture.h - step 5 of the command, if asked for: what a picture needs to know of every outline.

   Plane, sphere (made a unit sphere) and embedded outlines become alike here: corners and normals in space. */
#ifndef SURFMINK_COMMAND_PICTURE_H
#define SURFMINK_COMMAND_PICTURE_H

#include "write.h"

typedef struct shape {
    size_t first, n; /* corners */
    size_t id;       /* where its text begins */
    int status;
    double centre[3]; /* mean point of the outline; of the sphere above it */
    double normal[3]; /* unit: mean of the normals along the outline */
    double area;      /* about, for sizes and means */
} shape;

/* How many columns fill panels. */
static int map_colors(const options *o)
{
    return o->color_by.count;
}

/* The rank of one of them; 0: it has none. */
static int map_rank(const options *o, int i)
{
    return o->color_by.of[i].rank;
}

typedef struct picture {
    int surface;    /* of all outlines */
    double *corner; /* 3 each */
    size_t corners, corner_room;
    shape *shape;
    size_t shapes, shape_room;
    size_t measured;
    double area;      /* of all shapes */
    double *mu;       /* P + 1 a shape; 0 where it was refused */
    double *value;    /* of each column that fills a panel, a shape; NaN where it is undefined */
    double *director; /* 3 for each of them, a shape: unit, n = 0 of +lambda of its rank; 0 where there is none */
    size_t mu_room, value_room, director_room;
    char *text; /* ids, one after the other */
    size_t text_length, text_room;
    double *normal; /* 3 a corner, unit */
    size_t normal_room;
} picture;

static void free_picture(picture *g)
{
    free(g->corner);
    free(g->shape);
    free(g->text);
    free(g->normal);
    free(g->mu);
    free(g->value);
    free(g->director);
}

/* 0 if it has no direction. */
static int make_unit(double v[3])
{
    double length = sqrt(dot(v, v));
    size_t k;
    if (!(length > 0 && length <= 1e150)) return 0;
    for (k = 0; k < 3; ++k) v[k] /= length;
    return 1;
}

/* --- corners and normals ------------------------------------------------------------------------------------------ */

/* Corner i in space and its normal. */
static int place_corner(const polygon *p, size_t i, double corner[3], double normal[3])
{
    size_t k;
    for (k = 0; k < 3; ++k) {
        corner[k] = p->surface == PLANE ? (k < 2 ? p->corner[2 * i + k] : 0) : p->corner[3 * i + k];
        /* NOLINTNEXTLINE(clang-analyzer-core.NullDereference): an embedded polygon with a corner i has normals */
        normal[k] = p->surface == PLANE ? (k < 2 ? 0 : 1) : p->surface == SPHERE ? corner[k] : p->normal[3 * i + k];
        if (!(fabs(corner[k]) < 1e100)) return 0; /* there, sizes would overflow */
    }
    if (!make_unit(normal)) return 0;
    for (k = 0; k < 3 && p->surface == SPHERE; ++k) corner[k] = normal[k];
    return 1;
}

/* Copies the outline to the end of the picture's; returns its corners there, NULL if they cannot be drawn. */
static double *place_corners(picture *g, const polygon *p)
{
    double *corner, *normal;
    size_t i;
    g->corner = (double *)grow(g->corner, &g->corner_room, 3 * (g->corners + p->n), sizeof *g->corner);
    g->normal = (double *)grow(g->normal, &g->normal_room, 3 * (g->corners + p->n), sizeof *g->normal);
    corner = g->corner + 3 * g->corners;
    normal = g->normal + 3 * g->corners;
    for (i = 0; i < p->n; ++i)
        if (!place_corner(p, i, corner + 3 * i, normal + 3 * i)) return NULL;
    return corner;
}

/* --- the middle --------------------------------------------------------------------------------------------------- */

/* Centre and normal: means along the outline. Area: half the sum of cross products about the centre. */
static void find_centre(shape *s, const picture *g, const double *corner)
{
    const double *normal = g->normal + 3 * s->first;
    double weight, total = 0, area[3] = {0, 0, 0}, a[3], b[3], c[3];
    size_t i, j, k;
    for (k = 0; k < 3; ++k) s->centre[k] = s->normal[k] = 0;
    for (i = 0; i < s->n; ++i) {
        j = i + 1 < s->n ? i + 1 : 0;
        for (k = 0; k < 3; ++k) a[k] = corner[3 * j + k] - corner[3 * i + k];
        total += weight = sqrt(dot(a, a));
        for (k = 0; k < 3; ++k) {
            s->centre[k] += weight * (corner[3 * i + k] + corner[3 * j + k]) / 2;
            s->normal[k] += weight * (normal[3 * i + k] + normal[3 * j + k]) / 2;
        }
    }
    for (k = 0; k < 3; ++k) s->centre[k] = total > 0 ? s->centre[k] / total : corner[k]; /* all corners in one point */
    for (i = 0; i < s->n; ++i) {
        j = i + 1 < s->n ? i + 1 : 0;
        for (k = 0; k < 3; ++k) a[k] = corner[3 * i + k] - s->centre[k];
        for (k = 0; k < 3; ++k) b[k] = corner[3 * j + k] - s->centre[k];
        cross(a, b, c);
        for (k = 0; k < 3; ++k) area[k] += c[k] / 2;
    }
    s->area = sqrt(dot(area, area));
    make_unit(s->normal);
    for (k = 0; k < 3 && g->surface == SPHERE; ++k) s->centre[k] = s->normal[k];
}

/* The centre of a measured outline is that of its directions. */
static void keep_directors(picture *g, shape *s, const measure *m, const options *o)
{
    double *director = g->director + 3 * (size_t)map_colors(o) * (size_t)(s - g->shape);
    size_t dim = stride_of(g->surface), k;
    int i;
    if (!m->has_director) return;
    for (k = 0; k < 3; ++k) s->normal[k] = m->normal[k];
    for (k = 0; k < 3; ++k) s->centre[k] = g->surface == SPHERE ? m->normal[k] : m->centre[k];
    for (i = 0; i < map_colors(o); ++i)
        for (k = 0; k < dim && map_rank(o, i) > 0 && has_director(m, map_rank(o, i)); ++k)
            director[3 * i + (int)k] = m->direction[dim * (size_t)map_rank(o, i) + k];
}

/* --- outlines ----------------------------------------------------------------------------------------------------- */

static size_t keep_text(picture *g, const char *text)
{
    size_t begin = g->text_length, length = strlen(text) + 1;
    g->text = (char *)grow(g->text, &g->text_room, begin + length, 1);
    memcpy(g->text + begin, text, length);
    g->text_length += length;
    return begin;
}

/* Outlines that were refused are drawn too, as far as they can be. */
static void add_to_picture(picture *g, polygon *p, const measure *m, const pick *picked, const options *o)
{
    size_t ranks = (size_t)o->max_rank + 1, colors = (size_t)map_colors(o), k;
    double *corner;
    shape *s;
    g->surface = p->surface;
    if (p->n < 3 || p->fault != SURFMINK_OK) return;
    if (m->status == SURFMINK_CLOCKWISE) reverse_corners(p); /* the smaller side is the one to draw */
    if (!(corner = place_corners(g, p))) return;
    g->shape = (shape *)grow(g->shape, &g->shape_room, g->shapes + 1, sizeof *g->shape);
    g->mu = (double *)grow(g->mu, &g->mu_room, (g->shapes + 1) * ranks, sizeof *g->mu);
    g->director = (double *)grow(g->director, &g->director_room, (g->shapes + 1) * 3 * colors, sizeof *g->director);
    g->value = (double *)grow(g->value, &g->value_room, (g->shapes + 1) * colors, sizeof *g->value);
    for (k = 0; k < 3 * colors; ++k) g->director[3 * colors * g->shapes + k] = 0;
    for (k = 0; k < colors; ++k) g->value[colors * g->shapes + k] = picked[k].value;
    for (k = 0; k < ranks; ++k) g->mu[ranks * g->shapes + k] = m->status == SURFMINK_OK ? m->mu[k] : 0;
    s = &g->shape[g->shapes++];
    memset(s, 0, sizeof *s);
    s->first = g->corners;
    s->n = p->n;
    s->id = keep_text(g, p->id);
    s->status = m->status;
    g->corners += p->n;
    find_centre(s, g, corner);
    g->area += s->area;
    if (m->status != SURFMINK_OK) return;
    ++g->measured;
    keep_directors(g, s, m, o);
}

static double mu_of(const picture *g, const options *o, size_t i, int p)
{
    return g->mu[((size_t)o->max_rank + 1) * i + (size_t)p];
}

static double value_of(const picture *g, const options *o, size_t i, int color)
{
    return g->value[(size_t)map_colors(o) * i + (size_t)color];
}

/* --- where to look from ------------------------------------------------------------------------------------------- */

/* The axis along which the outlines extend least: from there most of them can be seen. */
static void widest_view(const picture *g, double direction[3])
{
    double least[3], most[3];
    size_t i, k, best = 2;
    for (k = 0; k < 3; ++k) least[k] = most[k] = g->corners ? g->corner[k] : 0;
    for (i = 0; i < 3 * g->corners; ++i) {
        k = i % 3;
        if (g->corner[i] < least[k]) least[k] = g->corner[i];
        if (g->corner[i] > most[k]) most[k] = g->corner[i];
    }
    for (k = 2; k > 0; --k)
        if (most[k - 1] - least[k - 1] < most[best] - least[best]) best = k - 1;
    for (k = 0; k < 3; ++k) direction[k] = k == best ? 1 : 0;
}

/* Along one of the axes, the frame the data were taken in, if it is within 20 degrees. */
static void snap_to_axis(double direction[3])
{
    size_t j, k;
    for (k = 0; k < 3; ++k)
        if (fabs(direction[k]) > 0.94)
            for (j = 0; j < 3; ++j) direction[j] = j != k ? 0 : direction[k] > 0 ? 1 : -1;
}

/* From where the mean outline faces, unless they face all ways. */
static void default_camera(const picture *g, camera *c)
{
    const double degree = 0.017453292519943296;
    double facing[3] = {0, 0, 0}, total = 0;
    size_t i, k;
    for (i = 0; i < g->shapes; ++i) {
        for (k = 0; k < 3; ++k) facing[k] += g->shape[i].area * g->shape[i].normal[k];
        total += g->shape[i].area;
    }
    if (!(sqrt(dot(facing, facing)) > 0.1 * total)) {
        if (g->surface == SPHERE)
            look_from_lonlat(c, 10, 20);
        else {
            widest_view(g, facing);
            look_from(c, facing);
        }
        return;
    }
    make_unit(facing);
    if (g->surface == SPHERE) /* in whole degrees, to be quoted */
        look_from_lonlat(c, floor(atan2(facing[1], facing[0]) / degree + 0.5), floor(asin(facing[2]) / degree + 0.5));
    else {
        snap_to_axis(facing);
        look_from(c, facing);
    }
}

#endif
