/* The directions of an outline at its centre: one vector for each rank, and how well the edges agree about it.
   cc -I. tests/test_director.c -lm && ./a.out */
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"

#include "harness.h"
#include "shapes.h"

#include "examples/beyond/director.h"

#define P 12

enum kind { FLAT, ROUND, SPACE };

/* An outline with its steps 1 to 4. */
typedef struct outline {
    enum kind kind;
    size_t n, dim;
    double corner[3 * MOST], normal[3 * MOST], length[MOST], turning[MOST], phase[MOST], g[2 * (P + 1)], mu[P + 1];
} outline;

/* What is known about its centre. */
typedef struct middle {
    double centre[3], normal[3], direction[3 * (P + 1)], coherence[P + 1];
} middle;

static surfmink_outline view_of(const outline *o, double radius)
{
    return o->kind == FLAT    ? surfmink_plane(o->corner, o->n)
           : o->kind == ROUND ? surfmink_sphere(o->corner, o->n, radius)
                              : surfmink_embedded(o->corner, o->normal, o->n);
}

static int steps(outline *o, double radius)
{
    surfmink_outline view = view_of(o, radius);
    int status = surfmink_edges(&view, o->length, o->turning, NULL);
    if (status == SURFMINK_OK) status = surfmink_phases(o->turning, o->n, SURFMINK_CORRECTED, o->phase);
    if (status == SURFMINK_OK) status = surfmink_irreducible(o->length, o->phase, o->n, P, o->g);
    if (status == SURFMINK_OK) status = surfmink_spectrum(o->g, P, NULL, o->mu, NULL);
    o->dim = o->kind == FLAT ? 2 : 3;
    return status;
}

static int director(const outline *o, middle *m)
{
    surfmink_outline view = view_of(o, 1);
    surfmink_middle found;
    double lag[MOST];
    int status;
    memset(&found, 0, sizeof found);
    found.direction = m->direction;
    found.coherence = m->coherence;
    status = surfmink_director(&view, o->length, o->phase, o->g, P, lag, &found);
    memcpy(m->centre, found.centre, sizeof m->centre);
    memcpy(m->normal, found.normal, sizeof m->normal);
    return status;
}

static void measure(outline *o, middle *m)
{
    CHECK_OK(steps(o, 1));
    CHECK_OK(director(o, m));
}

/* A random outline of a kind, not too long for its curvature to matter and to be allowed. */
static void some_outline(chance *c, enum kind kind, int trial, outline *o)
{
    const chart ellipsoid = {ELLIPSOID, 1.0, 0.6, 0.5}, torus = {TORUS, 2.0, 0.5, 0};
    double xy[2 * MOST];
    o->kind = kind;
    o->n = 3 + one_of(c, 20);
    CASE("kind %d, trial %d, %d corners", (int)kind, trial, (int)o->n);
    if (kind == FLAT)
        random_star(c, o->n, o->corner);
    else if (kind == ROUND) {
        gentle_star(c, o->n, xy);
        onto_sphere(xy, o->n, between(c, 0.05, 2), o->corner);
        turn_somehow(c, o->corner, o->n);
    } else
        star_on_chart(c, trial % 2 ? &ellipsoid : &torus, between(c, 1, 2), between(c, 0, 6), between(c, 0.05, 0.3),
                      o->n, o->corner, o->normal);
}

/* How far two directions of rank p are apart, of which any of the p may be meant: between 0 and 2. */
static double apart(const double *a, const double *b, const double *normal, size_t dim, int p)
{
    double u[3] = {0, 0, 0}, v[3] = {0, 0, 0}, w[3], angle;
    memcpy(u, a, dim * sizeof *a);
    memcpy(v, b, dim * sizeof *b);
    cross3(u, v, w);
    angle = p * atan2(dot3(w, normal), dot3(u, v));
    return hypot(cos(angle) - 1, sin(angle));
}

/* Two outlines that should have the same middle, up to the choice of one of the p vectors. The directions of small mu
   and of small coherence are less certain. */
static void check_same_middle(const outline *o, const middle *a, const middle *b, double within)
{
    int p, k;
    for (k = 0; k < 3; ++k) {
        CHECK_NEAR(a->normal[k], b->normal[k], within);
        CHECK_NEAR(a->centre[k], b->centre[k], within);
    }
    CHECK_NEAR(a->coherence[0], 1, 0);
    for (p = 1; p <= P; ++p) {
        double sharp = o->mu[p] * a->coherence[p];
        CHECK_NEAR(a->coherence[p], b->coherence[p], within * (1 + p));
        if (sharp < 1e-6) continue;
        CHECK_NEAR(apart(a->direction + o->dim * (size_t)p, b->direction + o->dim * (size_t)p, b->normal, o->dim, p), 0,
                   within * (1 + p) / sharp);
    }
}

/* --- what it is --------------------------------------------------------------------------------------------------- */

/* There the frames of all edges are turned copies of one, and nothing has to be tilted. */
THEOREM(in_the_plane_the_direction_is_theta_in_the_frame_of_edge_0_and_the_edges_agree)
{
    chance c = {201};
    int trial, p;
    for (trial = 0; trial < 300; ++trial) {
        outline o;
        middle m;
        surfmink_outline view;
        double frame[4], theta[P + 1], want[2];
        some_outline(&c, FLAT, trial, &o);
        view = view_of(&o, 1);
        measure(&o, &m);
        CHECK_OK(surfmink_frame(&view, 0, frame));
        CHECK_OK(surfmink_spectrum(o.g, P, NULL, NULL, theta));
        for (p = 1; p <= P; ++p) {
            want[0] = cos(theta[p]) * frame[0] + sin(theta[p]) * frame[2];
            want[1] = cos(theta[p]) * frame[1] + sin(theta[p]) * frame[3];
            CHECK_NEAR(m.coherence[p], 1, 1e-14);
            CHECK_NEAR(m.direction[2 * p], want[0], 3e-14);
            CHECK_NEAR(m.direction[2 * p + 1], want[1], 3e-14);
        }
    }
}

THEOREM(rank_0_has_no_direction_and_all_edges_agree_about_that)
{
    chance c = {202};
    int kind, k;
    for (kind = FLAT; kind <= SPACE; ++kind) {
        outline o;
        middle m;
        some_outline(&c, (enum kind)kind, 0, &o);
        measure(&o, &m);
        CHECK_NEAR(m.coherence[0], 1, 0);
        for (k = 0; k < (int)o.dim; ++k) CHECK_NEAR(m.direction[k], 0, 0);
    }
}

/* By symmetry; so coherence 1 is no privilege of the plane. From 1e-6, where corners have fewer digits than their
   centre, to 0.9 of a hemisphere, anywhere, at any angle. */
THEOREM(of_a_regular_polygon_on_the_sphere_the_direction_leads_through_the_middle_of_an_edge)
{
    chance c = {203};
    double radius = 1, vector[3], along, corner;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    int trial, p, k;
    for (trial = 0; trial < 200; ++trial) {
        outline o;
        middle m;
        double centre[3] = {0.3, -0.5, 0.8}, middle_of_edge[3], norm;
        double distance = trial % 4 ? between(&c, 0.001, 1.4) : 1e-6, rounding = 1e-13 + 2e-15 / distance;
        o.kind = ROUND;
        o.n = 3 + one_of(&c, 9);
        CASE("trial %d, %d corners", trial, (int)o.n);
        turn_somehow(&c, centre, 1);
        norm = sqrt(dot3(centre, centre));
        CHECK_OK(surfmink_regular_polygon(&sphere, centre, distance, between(&c, 0, 6), o.n, o.corner));
        measure(&o, &m);
        for (k = 0; k < 3; ++k) {
            CHECK_NEAR(m.normal[k], centre[k] / norm, 1e-15);
            middle_of_edge[k] = o.corner[k] + o.corner[3 + k];
        }
        CHECK_OK(surfmink_sphere_log(m.normal, middle_of_edge, 1, vector));
        along = sqrt(dot3(vector, vector));
        for (k = 0; k < 3; ++k) vector[k] /= along;
        for (p = 1; p <= P; ++p) CHECK_NEAR(m.coherence[p], 1, 1e-14);
        for (p = (int)o.n; p <= P; p += (int)o.n)
            CHECK_NEAR(apart(m.direction + 3 * p, vector, m.normal, 3, p), 0, rounding * p);
        /* and at the negative eigenvalue, half a step on, through a corner */
        CHECK_OK(surfmink_sphere_log(m.normal, o.corner, 1, vector));
        corner = dot3(vector, m.direction + 3 * o.n) / sqrt(dot3(vector, vector));
        CHECK_NEAR(cos((double)o.n * acos(fmax(-1, fmin(1, corner)))), -1, 1e-6);
    }
}

/* The octant: its mean normal is the diagonal, and the middle of edge 0, from z to x, lies towards -y of it. */
THEOREM(the_direction_of_the_octant_is_known)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0}, down[3] = {1, -2, 1};
    outline o;
    middle m;
    int k;
    o.kind = ROUND;
    o.n = 3;
    memcpy(o.corner, corner, sizeof corner);
    measure(&o, &m);
    for (k = 0; k < 3; ++k) {
        CHECK_NEAR(m.normal[k], sqrt(1.0 / 3), 2e-16);
        CHECK_NEAR(m.direction[9 + k], down[k] / sqrt(6), 2e-15);
    }
    CHECK_NEAR(m.coherence[3], 1, 1e-15);
    CHECK_NEAR(m.coherence[2], 1, 1e-15);
}

/* The same in another way: eigenvectors are transported to every edge, turned by the matrix of the smallest rotation,
   and their powers averaged as complex numbers against another frame. */
THEOREM(the_direction_is_the_mean_of_the_eigenvectors_of_all_edges_tilted_to_the_centre)
{
    chance c = {204};
    int trial, p, kind, k;
    for (kind = ROUND; kind <= SPACE; ++kind)
        for (trial = 0; trial < 100; ++trial) {
            outline o;
            middle m;
            double frame[MOST][9], mean[3] = {0, 0, 0}, e1[3], e2[3], axis[3] = {0.3, 0.5, -0.7}, norm, total = 0;
            size_t i;
            surfmink_outline view;
            some_outline(&c, (enum kind)kind, trial, &o);
            view = view_of(&o, 1);
            measure(&o, &m);
            for (i = 0; i < o.n; ++i) {
                CHECK_OK(surfmink_frame(&view, i, frame[i]));
                for (k = 0; k < 3; ++k) mean[k] += o.length[i] * frame[i][6 + k];
                total += o.length[i];
            }
            norm = sqrt(dot3(mean, mean));
            for (k = 0; k < 3; ++k) {
                mean[k] /= norm;
                CHECK_NEAR(m.normal[k], mean[k], 3e-15);
            }
            cross3(mean, axis, e1);
            norm = sqrt(dot3(e1, e1));
            for (k = 0; k < 3; ++k) e1[k] /= norm;
            cross3(mean, e1, e2);
            for (p = 1; p <= P; ++p) {
                double re = 0, im = 0, vector[3 * P], direction[3], sharp;
                for (i = 0; i < o.n; ++i) {
                    double pivot[3], angle;
                    CHECK_OK(surfmink_eigenvectors(o.g, p, 1, o.phase[i], frame[i], 3, vector));
                    cross3(frame[i] + 6, mean, pivot);
                    norm = sqrt(dot3(pivot, pivot));
                    if (norm > 0) turn_about(pivot, atan2(norm, dot3(frame[i] + 6, mean)), vector, 1);
                    CHECK_NEAR(dot3(vector, mean), 0, 1e-15);
                    angle = p * atan2(dot3(vector, e2), dot3(vector, e1));
                    re += o.length[i] * cos(angle);
                    im += o.length[i] * sin(angle);
                }
                sharp = hypot(re, im) / total;
                CHECK_NEAR(m.coherence[p], sharp, 3e-14);
                for (k = 0; k < 3; ++k) direction[k] = cos(atan2(im, re) / p) * e1[k] + sin(atan2(im, re) / p) * e2[k];
                if (sharp > 1e-3)
                    CHECK_NEAR(apart(m.direction + 3 * p, direction, mean, 3, p), 0, 3e-14 * (1 + p) / sharp);
            }
        }
}

THEOREM(directions_are_tangent_unit_vectors_and_coherences_lie_between_0_and_1)
{
    chance c = {205};
    int trial, p, kind;
    for (kind = FLAT; kind <= SPACE; ++kind)
        for (trial = 0; trial < 200; ++trial) {
            outline o;
            middle m;
            double v[3] = {0, 0, 0};
            some_outline(&c, (enum kind)kind, trial, &o);
            measure(&o, &m);
            CHECK_NEAR(dot3(m.normal, m.normal), 1, 1e-15);
            for (p = 1; p <= P; ++p) {
                memcpy(v, m.direction + o.dim * (size_t)p, o.dim * sizeof *v);
                CHECK_NEAR(dot3(v, v), 1, 4e-15);
                CHECK_NEAR(dot3(v, m.normal), 0, 2e-15);
                CHECK(m.coherence[p] >= 0 && m.coherence[p] <= 1);
            }
        }
}

/* The middle of a rectangle is its centre wherever it lies, and that of a path is the mean along it, not of the
   corners. */
THEOREM(the_centre_is_the_mean_of_the_outline_along_its_length)
{
    static const double at[4] = {0, 1e8, -3e15, 1e300};
    int where, k;
    for (where = 0; where < 4; ++where) {
        outline o;
        middle m;
        double size = where == 3 ? 1e290 : 2, want[3] = {0.5, 1, 0};
        static const double box[15] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 2, 0, 0, 2, 0}; /* one corner too many */
        for (o.kind = FLAT; o.kind <= SPACE; o.kind = (enum kind)(o.kind + SPACE)) {
            size_t i;
            o.n = 5;
            CASE("at %g, kind %d", at[where], (int)o.kind);
            for (i = 0; i < 5; ++i)
                for (k = 0; k < 3; ++k) {
                    size_t dim = o.kind == FLAT ? 2 : 3;
                    if (k < (int)dim) o.corner[dim * i + (size_t)k] = at[where] + size * box[3 * i + (size_t)k];
                    o.normal[3 * i + (size_t)k] = k == 2;
                }
            measure(&o, &m);
            for (k = 0; k < (int)o.dim; ++k)
                CHECK_NEAR(m.centre[k], at[where] + size * want[k], where == 3 ? 3e284 : 4e-16 * size);
        }
    }
}

/* Corners as far apart as the library measures: their sum would overflow. */
THEOREM(the_centre_of_a_huge_outline_does_not_overflow)
{
    static const double corner[8] = {-9e307, -9e307, 0, -9e307, 0, 0, -9e307, 0};
    static const double wide[16] = {-1e308, -1e308, 0, -1e308, 1e308,  -1e308, 1e308,  0,
                                    1e308,  1e308,  0, 1e308,  -1e308, 1e308,  -1e308, 0};
    static const double weight[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    static const double phase[8] = {0, 0, PI / 2, PI / 2, PI, PI, 3 * PI / 2, 3 * PI / 2};
    static const double quarter[4] = {0, PI / 2, PI, 3 * PI / 2};
    const double g[2] = {8, 0};
    surfmink_outline view = surfmink_plane(corner, 4);
    surfmink_middle m = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, NULL, NULL};
    double lag[8];
    CHECK_OK(surfmink_director(&view, weight, quarter, g, 0, lag, &m));
    CHECK_CLOSE(m.centre[0], -4.5e307, 1e-15);
    CHECK_CLOSE(m.centre[1], -4.5e307, 1e-15);
    view = surfmink_plane(wide, 8);
    CHECK_OK(surfmink_director(&view, weight, phase, g, 0, lag, &m));
    CHECK_NEAR(m.centre[0], 0, 1e293);
    CHECK_NEAR(m.centre[1], 0, 1e293);
}

/* --- what it does not depend on ----------------------------------------------------------------------------------- */

THEOREM(the_direction_does_not_depend_on_the_first_corner)
{
    chance c = {206};
    int trial, kind;
    for (kind = FLAT; kind <= SPACE; ++kind)
        for (trial = 0; trial < 100; ++trial) {
            outline o, other;
            middle m, there;
            size_t k;
            some_outline(&c, (enum kind)kind, trial, &o);
            measure(&o, &m);
            other = o;
            k = 1 + one_of(&c, o.n - 1);
            start_at(k, o.corner, o.n, o.dim, other.corner);
            start_at(k, o.normal, o.n, 3, other.normal);
            measure(&other, &there);
            check_same_middle(&o, &there, &m, 3e-13);
        }
}

THEOREM(the_direction_turns_with_the_outline)
{
    chance c = {207};
    int trial, kind, p;
    for (kind = ROUND; kind <= SPACE; ++kind)
        for (trial = 0; trial < 100; ++trial) {
            outline o, turned;
            middle m, want;
            double axis[3], angle = between(&c, 0, 6);
            some_outline(&c, (enum kind)kind, trial, &o);
            measure(&o, &m);
            for (p = 0; p < 3; ++p) axis[p] = between(&c, 0.1, 1);
            turned = o;
            turn_about(axis, angle, turned.corner, o.n);
            turn_about(axis, angle, turned.normal, kind == SPACE ? o.n : 0);
            want = m;
            turn_about(axis, angle, want.centre, 1);
            turn_about(axis, angle, want.normal, 1);
            turn_about(axis, angle, want.direction, P + 1);
            measure(&turned, &m);
            check_same_middle(&o, &m, &want, 1e-12);
        }
}

/* The corners of the mirror image run the other way round; co-normals stay co-normals. */
THEOREM(the_direction_of_the_mirror_image_is_the_mirror_image_of_the_direction)
{
    chance c = {208};
    int trial, kind;
    for (kind = FLAT; kind <= SPACE; ++kind)
        for (trial = 0; trial < 100; ++trial) {
            outline o, mirrored;
            middle m, want;
            size_t i;
            some_outline(&c, (enum kind)kind, trial, &o);
            measure(&o, &want);
            mirrored = o;
            for (i = 0; i < o.n; ++i) {
                mirrored.corner[o.dim * i] *= -1;
                mirrored.normal[3 * i] *= -1;
            }
            surfmink_reverse(mirrored.corner, o.n, o.dim);
            surfmink_reverse(mirrored.normal, o.n, 3);
            want.centre[0] *= -1;
            want.normal[0] *= -1;
            for (i = 0; i <= P; ++i) want.direction[o.dim * i] *= -1;
            measure(&mirrored, &m);
            check_same_middle(&o, &m, &want, 1e-12);
        }
}

/* To the bit, by powers of two: neither the unit, nor the radius, nor the length of normals counts. */
THEOREM(the_direction_knows_no_scale)
{
    chance c = {209};
    int trial, kind;
    for (kind = FLAT; kind <= SPACE; ++kind)
        for (trial = 0; trial < 60; ++trial) {
            outline o, scaled;
            middle m, there;
            double unit = power_of_two((int)one_of(&c, 80) - 40), radius = trial % 2 ? unit : 1;
            size_t i;
            some_outline(&c, (enum kind)kind, trial, &o);
            measure(&o, &m);
            scaled = o;
            for (i = 0; i < 3 * o.n; ++i) {
                if (i < o.dim * o.n) scaled.corner[i] *= unit;
                scaled.normal[i] *= power_of_two((int)(i / 3 * 37 % 60) - 30);
            }
            CHECK_OK(steps(&scaled, radius));
            CHECK_OK(director(&scaled, &there));
            CHECK_SAME(there.direction, m.direction, o.dim * (P + 1));
            CHECK_SAME(there.coherence, m.coherence, P + 1);
            CHECK_SAME(there.normal, m.normal, 3);
            if (kind != ROUND)
                for (i = 0; i < o.dim; ++i) CHECK_NEAR(there.centre[i], unit * m.centre[i], 0);
        }
}

/* Corners of a sphere may lie off it: only their directions count. */
THEOREM(on_the_sphere_only_the_directions_of_the_corners_count)
{
    chance c = {210};
    int trial;
    for (trial = 0; trial < 100; ++trial) {
        outline o, off;
        middle m, there;
        size_t i;
        some_outline(&c, ROUND, trial, &o);
        measure(&o, &m);
        off = o;
        for (i = 0; i < 3 * o.n; ++i) off.corner[i] *= 1 + (double)(i / 3 % 7) / 4;
        measure(&off, &there);
        check_same_middle(&o, &there, &m, 3e-12);
    }
}

/* Isosceles triangles from slim to almost half a sphere wide: edge 0 is longer than 90 degrees in every other one,
   where its frame comes from the difference of its ends. Mirrored they are the same, and so is all that the centre
   has. */
THEOREM(the_direction_of_an_isosceles_triangle_lies_in_its_mirror_or_between_however_long_its_edges)
{
    chance c = {211};
    int trial, p;
    for (trial = 0; trial < 200; ++trial) {
        outline o;
        middle m;
        double wide = trial % 2 ? between(&c, 1.6, 3.1) : between(&c, 0.1, 1.5), tip = between(&c, 0.1, 1.5);
        double axis[3], across[3], angle, rounding = 1e-12;
        const double *a = o.corner, *b = o.corner + 3, *top = o.corner + 6;
        int k;
        if (trial % 4 == 3) { /* the middle is known though the edge could almost lie anywhere */
            wide = PI - 1e-6;
            rounding = 1e-8;
        }
        o.kind = ROUND;
        o.n = 3;
        CASE("trial %d, an edge of %g", trial, wide);
        o.corner[0] = 1, o.corner[1] = 0, o.corner[2] = 0;
        o.corner[3] = cos(wide), o.corner[4] = sin(wide), o.corner[5] = 0;
        o.corner[6] = cos(wide / 2) * cos(tip), o.corner[7] = sin(wide / 2) * cos(tip), o.corner[8] = sin(tip);
        turn_somehow(&c, o.corner, 3);
        measure(&o, &m);
        for (k = 0; k < 3; ++k) across[k] = (b[k] - a[k]) / (2 * sin(wide / 2)); /* of the mirror */
        CHECK_NEAR(dot3(m.normal, across), 0, 3e-15);
        CHECK(dot3(m.normal, top) > 0);
        cross3(m.normal, across, axis); /* along the mirror */
        for (p = 1; p <= P; ++p) {
            angle = atan2(dot3(m.direction + 3 * p, across), dot3(m.direction + 3 * p, axis));
            if (o.mu[p] * m.coherence[p] > 1e-3) CHECK_NEAR(sin(p * angle), 0, rounding * p);
        }
    }
}

/* --- how it changes ----------------------------------------------------------------------------------------------- */

THEOREM(a_little_change_of_the_outline_changes_the_direction_a_little)
{
    static const double step[3] = {1e-5, 1e-7, 1e-9};
    chance c = {212};
    int trial, kind, s;
    for (kind = FLAT; kind <= SPACE; ++kind)
        for (trial = 0; trial < 40; ++trial) {
            outline o, moved;
            middle m, there;
            size_t i;
            some_outline(&c, (enum kind)kind, trial, &o);
            if (kind == FLAT) gentle_star(&c, o.n, o.corner);
            measure(&o, &m);
            for (s = 0; s < 3; ++s) {
                double size = kind == SPACE ? 0.01 * step[s] : step[s];
                moved = o;
                for (i = 0; i < o.dim * o.n; ++i) moved.corner[i] += between(&c, -size, size);
                measure(&moved, &there);
                check_same_middle(&o, &there, &m, 2e3 * step[s]);
            }
        }
}

/* Halving a cell takes a quarter of the curvature out of it: 1 - coherence falls with the square of that. */
THEOREM(the_smaller_an_outline_the_better_its_edges_agree)
{
    chance c = {213};
    int trial, p;
    for (trial = 0; trial < 50; ++trial) {
        outline o, half;
        middle m, there;
        double xy[2 * MOST];
        o.kind = half.kind = ROUND;
        o.n = half.n = 5 + one_of(&c, 10);
        CASE("trial %d", trial);
        gentle_star(&c, o.n, xy);
        onto_sphere(xy, o.n, 0.08, o.corner);
        onto_sphere(xy, o.n, 0.04, half.corner);
        measure(&o, &m);
        measure(&half, &there);
        for (p = 2; p <= 6; ++p) CHECK_NEAR((1 - m.coherence[p]) / (1 - there.coherence[p]), 16, 0.5);
    }
}

/* The table in docs/internals/beyond.md: a hexagon without symmetry at several sizes, by both transports. */
THEOREM(the_coherence_of_a_hexagon_without_symmetry_is_what_the_documents_say)
{
    static const double xy[12] = {1, 0, 0.6, 0.7, -0.3, 0.8, -1, 0.2, -0.5, -0.6, 0.4, -0.9};
    static const double curvature[5] = {1.06, 0.326, 0.0865, 0.0220, 0.00552};
    static const double corrected[5][2] = {
        {8.0e-4, 7.2e-3}, {7.9e-5, 7.2e-4}, {5.7e-6, 5.2e-5}, {3.7e-7, 3.4e-6}, {2.3e-8, 2.1e-7}};
    static const double classical[5][2] = {
        {1.7e-1, 9.9e-1}, {1.7e-2, 1.5e-1}, {1.2e-3, 1.1e-2}, {7.7e-5, 6.9e-4}, {4.8e-6, 4.4e-5}};
    int s;
    for (s = 0; s < 5; ++s) {
        outline o;
        middle m;
        surfmink_functionals w;
        o.kind = ROUND;
        o.n = 6;
        CASE("size %g", 0.8 / (1 << s));
        onto_sphere(xy, 6, 0.8 / (1 << s), o.corner);
        measure(&o, &m);
        CHECK_OK(surfmink_total(NULL, o.length, o.turning, 6, &w));
        CHECK_CLOSE(w.curvature, curvature[s], 5e-3);
        CHECK_CLOSE(1 - m.coherence[2], corrected[s][0], 3e-2);
        CHECK_CLOSE(1 - m.coherence[6], corrected[s][1], 3e-2);
        CHECK_OK(surfmink_phases(o.turning, 6, SURFMINK_PARALLEL, o.phase));
        CHECK_OK(director(&o, &m));
        CHECK_CLOSE(1 - m.coherence[2], classical[s][0], 4e-2);
        CHECK_CLOSE(1 - m.coherence[6], classical[s][1], 4e-2);
    }
}

/* The classical phases are off by the enclosed curvature after one turn: their edges agree less. */
THEOREM(the_classical_transport_can_be_averaged_too_and_is_less_coherent)
{
    static const double corner[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    double length[3], turning[3], phase[3], g[2 * (P + 1)], lag[3], coherence[P + 1], direction[3 * (P + 1)];
    surfmink_outline view = surfmink_sphere(corner, 3, 1);
    surfmink_middle m = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, NULL, NULL};
    m.direction = direction;
    m.coherence = coherence;
    CHECK_OK(surfmink_edges(&view, length, turning, NULL));
    CHECK_OK(surfmink_phases(turning, 3, SURFMINK_PARALLEL, phase));
    CHECK_OK(surfmink_irreducible(length, phase, 3, P, g));
    CHECK_OK(surfmink_director(&view, length, phase, g, P, lag, &m));
    /* tilted frames turn by 2 pi / 3 from edge to edge, the classical phase by pi / 2: the sum of three is known */
    CHECK_NEAR(coherence[4], fabs(1 + 2 * cos(4 * PI / 6)) / 3, 1e-15);
    CHECK_NEAR(coherence[3], fabs(1 + 2 * cos(3 * PI / 6)) / 3, 1e-15);
    CHECK_NEAR(coherence[12], 1, 1e-14);
}

/* --- calls -------------------------------------------------------------------------------------------------------- */

THEOREM(each_output_may_be_left_out_and_the_phases_may_be_the_lag)
{
    chance c = {214};
    int kind, k;
    for (kind = FLAT; kind <= SPACE; ++kind) {
        outline o;
        middle m;
        surfmink_middle alone;
        surfmink_outline view;
        double lag[MOST], direction[3 * (P + 1)];
        some_outline(&c, (enum kind)kind, 1, &o);
        measure(&o, &m);
        view = view_of(&o, 1);
        memset(&alone, 0, sizeof alone);
        memcpy(lag, o.phase, sizeof lag);
        CHECK_OK(surfmink_director(&view, o.length, lag, o.g, P, lag, &alone));
        CHECK_SAME(alone.centre, m.centre, 3);
        CHECK_SAME(alone.normal, m.normal, 3);
        alone.direction = direction;
        CHECK_OK(surfmink_director(&view, o.length, o.phase, o.g, P, lag, &alone));
        CHECK_SAME(direction, m.direction, o.dim * (P + 1));
        CHECK_NEAR(dot3(alone.axis, alone.axis), 1, 1e-15);
        CHECK_NEAR(dot3(alone.axis, alone.normal), 0, 1e-15);
        CHECK_NEAR(lag[0], -o.phase[0], 2e-16); /* the axis is orthogonal to itself turned, but for rounding */
        for (k = 0; kind == FLAT && k < (int)o.n; ++k) CHECK_ANGLE(lag[k], 0, 1e-13);
    }
}

THEOREM(rank_0_alone_can_be_asked_for)
{
    static const double corner[8] = {0, 0, 1, 0, 1, 1, 0, 1}, length[4] = {1, 1, 1, 1}, phase[4] = {0, 1, 2, 3};
    const double g[4] = {4, 0, nan(""), nan("")}; /* nobody looks behind the ranks */
    double lag[4], direction[3] = {7, 7, 7}, coherence[2] = {7, 7};
    surfmink_outline view = surfmink_plane(corner, 4);
    surfmink_middle m = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, NULL, NULL};
    m.direction = direction;
    m.coherence = coherence;
    CHECK_OK(surfmink_director(&view, length, phase, g, 0, lag, &m));
    CHECK_NEAR(direction[0], 0, 0);
    CHECK_NEAR(direction[1], 0, 0);
    CHECK_NEAR(direction[2], 7, 0);
    CHECK_NEAR(coherence[0], 1, 0);
    CHECK_NEAR(coherence[1], 7, 0);
    CHECK_NEAR(m.centre[0], 0.5, 0);
}

/* One call that has to fail, with this status and without a trace. */
static void check_refused(const outline *o, int max_rank, int status)
{
    surfmink_outline view = view_of(o, 1);
    surfmink_middle m, before;
    double lag[MOST], direction[3 * (P + 1)], coherence[P + 1], none[3 * (P + 1)];
    size_t i;
    for (i = 0; i < 3 * (P + 1); ++i) none[i] = direction[i] = -7;
    memcpy(coherence, none, sizeof coherence);
    memset(&m, 0x5a, sizeof m);
    m.direction = direction;
    m.coherence = coherence;
    before = m;
    CHECK_STATUS(surfmink_director(&view, o->length, o->phase, o->g, max_rank, lag, &m), status);
    CHECK(memcmp(&m, &before, sizeof m) == 0);
    CHECK_SAME(direction, none, 3 * (P + 1));
    CHECK_SAME(coherence, none, P + 1);
}

THEOREM(what_is_wrong_is_named_and_nothing_is_written)
{
    chance c = {215};
    outline good, bad;
    int kind, k;
    for (kind = FLAT; kind <= SPACE; ++kind) {
        some_outline(&c, (enum kind)kind, 0, &good);
        CHECK_OK(steps(&good, 1));
        check_refused(&good, -1, SURFMINK_BAD_ARGUMENT);
        bad = good;
        bad.n = 2;
        check_refused(&bad, P, SURFMINK_TOO_FEW_CORNERS);
        bad = good;
        bad.length[1] = nan("");
        check_refused(&bad, P, SURFMINK_NOT_FINITE);
        bad = good;
        bad.length[2] = -1;
        check_refused(&bad, P, SURFMINK_BAD_ARGUMENT);
        bad = good;
        memset(bad.length, 0, sizeof bad.length);
        check_refused(&bad, P, SURFMINK_BAD_ARGUMENT);
        bad = good;
        bad.phase[0] = HUGE_VAL;
        check_refused(&bad, P, SURFMINK_NOT_FINITE);
        bad = good;
        bad.g[2 * P + 1] = nan("");
        check_refused(&bad, P, SURFMINK_NOT_FINITE);
        bad = good;
        bad.g[0] = HUGE_VAL;
        check_refused(&bad, P, SURFMINK_NOT_FINITE);
        bad = good;
        bad.corner[good.dim] = nan("");
        check_refused(&bad, P, SURFMINK_NOT_FINITE);
        bad = good;
        memcpy(bad.corner, bad.corner + good.dim, good.dim * sizeof *bad.corner);
        check_refused(&bad, P, SURFMINK_COINCIDENT_CORNERS);
        bad = good;
        for (k = 0; k < 3; ++k) (kind == ROUND ? bad.corner : bad.normal)[3 + k] = 0;
        if (kind != FLAT) check_refused(&bad, P, SURFMINK_ZERO_NORMAL);
        bad = good;
        for (k = 0; k < 3; ++k) bad.corner[3 + k] = -bad.corner[k];
        if (kind == ROUND) check_refused(&bad, P, SURFMINK_ANTIPODAL_CORNERS);
        bad = good;
        for (k = 0; k < 3 * (int)bad.n; ++k) bad.normal[k] = bad.corner[3 + k % 3] - bad.corner[k % 3];
        if (kind == SPACE) check_refused(&bad, P, SURFMINK_UPRIGHT_EDGE);
        bad = good;
        for (k = 0; k < 3; ++k) bad.normal[3 + k] *= -1;
        if (kind == SPACE) check_refused(&bad, P, SURFMINK_OPPOSITE_NORMALS);
    }
}

/* A strip of squares bent by the angles given: corner i of one side and of the other, seen along the strip. */
static void bent(outline *o, const double *at, size_t joints)
{
    double x = 0, y = 0;
    size_t i, j;
    o->kind = SPACE;
    o->n = 2 * joints;
    for (i = 0; i < joints; ++i) {
        double *left = o->corner + 3 * i, *right = o->corner + 3 * (o->n - 1 - i);
        left[0] = right[0] = x, left[1] = right[1] = y, left[2] = 0, right[2] = -1;
        for (j = 0; j < 2; ++j) {
            double *normal = o->normal + 3 * (j ? o->n - 1 - i : i);
            normal[0] = -sin(at[i]), normal[1] = cos(at[i]), normal[2] = 0;
        }
        if (i + 1 < joints) {
            x += cos((at[i] + at[i + 1]) / 2);
            y += sin((at[i] + at[i + 1]) / 2);
        }
    }
}

THEOREM(an_outline_whose_normals_cancel_has_no_mean_normal)
{
    static const double once_round[9] = {0, PI / 4, PI / 2, 3 * PI / 4, PI, 5 * PI / 4, 3 * PI / 2, 7 * PI / 4, 2 * PI};
    static const double most[5] = {0, 1.2, 2.4, 3.6, 4.8};
    static const double weight[18] = {1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 0};
    outline o;
    middle m;
    bent(&o, once_round,
         9); /* the wall of a box of eight sides: the long edges cancel, if the short ones do not count */
    CHECK_OK(steps(&o, 1));
    memcpy(o.length, weight, sizeof weight);
    check_refused(&o, P, SURFMINK_ZERO_NORMAL);
    o.length[8] = 0.97e-6 * 16; /* one short side makes a mean of less than 1e-6, and of more */
    check_refused(&o, P, SURFMINK_ZERO_NORMAL);
    o.length[8] = 1.03e-6 * 16;
    CHECK_OK(director(&o, &m));
    CHECK_NEAR(m.normal[1], 1, 1e-9);
    bent(&o, most, 5);
    CHECK_OK(steps(&o, 1));
    CHECK_OK(director(&o, &m));
}

/* Normals at angles -w, 0, w of a bent strip have the mean 0; the ends' are opposite to it where w is pi. */
THEOREM(a_normal_opposite_to_the_mean_cannot_be_tilted)
{
    static const double off[4] = {0, 0.97e-6, 1.03e-6, 1e-3};
    double at[9], weight[18];
    outline o;
    size_t i;
    int k, end;
    for (end = 0; end < 2; ++end) /* the end that is reached first is edge 0, or another */
        for (k = 0; k < 4; ++k) {
            middle m;
            CASE("%g off, end %d", off[k], end);
            for (i = 0; i < 9; ++i) at[i] = ((double)i - 4) * PI / 4 * (1 - off[k] / PI);
            bent(&o, at, 9);
            if (end) {
                outline other = o;
                start_at(4, o.corner, o.n, 3, other.corner);
                start_at(4, o.normal, o.n, 3, other.normal);
                o = other;
            }
            CHECK_OK(steps(&o, 1));
            /* the edges across the ends have the normals at -w and w; only those at 0 have weight */
            for (i = 0; i < o.n; ++i) {
                const double *a = o.normal + 3 * i, *b = o.normal + 3 * ((i + 1) % o.n);
                weight[i] = a[1] > 0.7 && b[1] > 0.7;
            }
            memcpy(o.length, weight, o.n * sizeof *weight);
            if (k < 2)
                check_refused(&o, P, SURFMINK_ZERO_NORMAL);
            else
                CHECK_OK(director(&o, &m));
        }
}

int main(void)
{
    PROVE(in_the_plane_the_direction_is_theta_in_the_frame_of_edge_0_and_the_edges_agree);
    PROVE(rank_0_has_no_direction_and_all_edges_agree_about_that);
    PROVE(of_a_regular_polygon_on_the_sphere_the_direction_leads_through_the_middle_of_an_edge);
    PROVE(the_direction_of_the_octant_is_known);
    PROVE(the_direction_is_the_mean_of_the_eigenvectors_of_all_edges_tilted_to_the_centre);
    PROVE(directions_are_tangent_unit_vectors_and_coherences_lie_between_0_and_1);
    PROVE(the_centre_is_the_mean_of_the_outline_along_its_length);
    PROVE(the_centre_of_a_huge_outline_does_not_overflow);
    PROVE(the_direction_does_not_depend_on_the_first_corner);
    PROVE(the_direction_turns_with_the_outline);
    PROVE(the_direction_of_the_mirror_image_is_the_mirror_image_of_the_direction);
    PROVE(the_direction_knows_no_scale);
    PROVE(on_the_sphere_only_the_directions_of_the_corners_count);
    PROVE(the_direction_of_an_isosceles_triangle_lies_in_its_mirror_or_between_however_long_its_edges);
    PROVE(a_little_change_of_the_outline_changes_the_direction_a_little);
    PROVE(the_smaller_an_outline_the_better_its_edges_agree);
    PROVE(the_coherence_of_a_hexagon_without_symmetry_is_what_the_documents_say);
    PROVE(the_classical_transport_can_be_averaged_too_and_is_less_coherent);
    PROVE(each_output_may_be_left_out_and_the_phases_may_be_the_lag);
    PROVE(rank_0_alone_can_be_asked_for);
    PROVE(what_is_wrong_is_named_and_nothing_is_written);
    PROVE(an_outline_whose_normals_cancel_has_no_mean_normal);
    PROVE(a_normal_opposite_to_the_mean_cannot_be_tilted);
    return QED();
}
