/* strokes.h - the strokes that show the p directions of an outline, and how they stay inside it.

   All of this happens in the plane of the picture. A stroke ends where it has gone STROKE_ROOM of the way from the middle
   to the outline, if it would be longer; the others of the same outline are then shortened in proportion, so that they
   still look like p directions. A middle that lies outside, as that of a crescent, or too close to the outline, moves to
   the middle of a chord. */
#ifndef SURFMINK_PICTURE_STROKES_H
#define SURFMINK_PICTURE_STROKES_H

#include <math.h>
#include <stddef.h>

/* Closed rings; ring i ends before point end[i]. */
typedef struct rings {
    const double *point; /* x y */
    size_t stride;       /* numbers from one point to the next */
    const size_t *end;
    size_t count;
} rings;

/* Stroke k goes from the middle by cos(a) axis[0] + sin(a) axis[1], a = first + 2 pi k / p. */
typedef struct strokes {
    int p;
    double first;
    double middle[2], axis[2][2];
} strokes;

/* The rest of the way is for the width of the stroke and of the outline. */
static const double STROKE_ROOM = 0.8;

static inline void stroke_step(const strokes *s, int k, double step[2])
{
    double angle = s->first + 6.283185307179586 * k / s->p, c = cos(angle), d = sin(angle);
    int i;
    for (i = 0; i < 2; ++i) step[i] = c * s->axis[0][i] + d * s->axis[1][i];
}

/* Where the ray from a point meets the rings: the two nearest places, in steps, HUGE_VAL where there are not so many.
   Does the point lie inside? Then there is an odd number of them. */
static inline int meet_rings(const rings *r, const double from[2], const double step[2], double place[2])
{
    size_t ring, i, first = 0, before;
    int inside = 0;
    place[0] = place[1] = HUGE_VAL;
    for (ring = 0; ring < r->count; first = r->end[ring++])
        for (i = first, before = r->end[ring] - 1; i < r->end[ring]; before = i++) {
            const double *p = r->point + r->stride * before, *q = r->point + r->stride * i;
            double a = p[0] - from[0], b = p[1] - from[1], c = q[0] - from[0], d = q[1] - from[1], t;
            double left_p = step[0] * b - step[1] * a, left_q = step[0] * d - step[1] * c;
            if ((left_p >= 0) == (left_q >= 0)) continue;
            t = (a * d - b * c) / (left_q - left_p);
            if (!(t > 0)) continue;
            inside = !inside;
            place[1] = fmin(place[1], fmax(place[0], t));
            place[0] = fmin(place[0], t);
        }
    return inside;
}

/* What part of their length the strokes may have; 0 if the middle lies outside. */
static inline double stroke_share(const strokes *s, const rings *r)
{
    double share = 1, step[2], place[2];
    int k;
    for (k = 0; k < s->p; ++k) {
        stroke_step(s, k, step);
        if (!meet_rings(r, s->middle, step, place)) return 0;
        share = fmin(share, STROKE_ROOM * place[0]);
    }
    return share;
}

/* Takes the middle of a chord along an axis instead, from `low` to `high` of its lengths, if that gives more room. */
static inline void try_chord(strokes *best, double *share, const strokes *s, const rings *r, int axis, double low,
                             double high)
{
    strokes moved = *s;
    double its_share;
    int i;
    if (!(high - low < HUGE_VAL)) return;
    for (i = 0; i < 2; ++i) moved.middle[i] += (low + high) / 2 * s->axis[axis][i];
    its_share = stroke_share(&moved, r);
    if (!(its_share > *share)) return;
    *share = its_share;
    *best = moved;
}

/* Makes the strokes end inside the rings. Returns what is left of their length: 1 if they had room, 0 if there is none
   for them. */
static inline double keep_strokes_inside(strokes *s, const rings *r)
{
    const double ample = 0.5; /* the middle is where readers look for the strokes: it moves only if that is worth it */
    strokes best = *s;
    double share = stroke_share(s, r), up[2], down[2], back[2];
    int axis, i, j;
    for (axis = 0; axis < 2 && share < ample; ++axis) {
        for (i = 0; i < 2; ++i) back[i] = -s->axis[axis][i];
        meet_rings(r, s->middle, back, down);
        if (meet_rings(r, s->middle, s->axis[axis], up))
            try_chord(&best, &share, s, r, axis, -down[0], up[0]);
        else {
            try_chord(&best, &share, s, r, axis, up[0], up[1]);
            try_chord(&best, &share, s, r, axis, -down[1], -down[0]);
        }
    }
    *s = best;
    for (i = 0; i < 2; ++i)
        for (j = 0; j < 2; ++j) s->axis[i][j] *= share;
    return share;
}

#endif
