/* planted_mesh.c - faults planted into meshes, OFF, OBJ and PLY: planted.h says what must hold of each face.

   The mesh is a sheet of quadrangles, nearly flat, so that faces are seen from above as they are; normals of corners
   are means of the faces there, weighted by area. */
#include "planted.h"

enum { SIDE = 4, MOST_VERTICES = (SIDE + 1) * (SIDE + 1) + 2, MOST_FACES = SIDE * SIDE + 1 };
enum { OFF, OBJ, PLY, FORMATS };

enum planted {
    NONE,
    TURNED,       /* some faces run the other way */
    ALL_TURNED,   /* all of them */
    TWICE,        /* a face, and again */
    DROPPED,      /* a face */
    EXCHANGED,    /* two corners of a face */
    SHIFTED,      /* a corner is another vertex */
    REPEATED,     /* a corner is that before it */
    BEYOND,       /* a corner is a vertex that is not there */
    COPIED,       /* a vertex, its copy used by one face */
    ALMOST,       /* so, with an error of rounding */
    INSERTED,     /* a vertex, so that all later ones are numbered wrong */
    LOST,         /* a vertex, likewise */
    NOT_A_NUMBER, /* a coordinate */
    MOVED,        /* a vertex to where another one is */
    BOW_TIE,      /* two vertices change places */
    FEWER,        /* the counts are too small */
    MORE,         /* too large */
    FAULTS
};

static const char *const fault_name[FAULTS] = {"none",    "turned",   "all_turned", "twice",   "dropped", "exchanged",
                                               "shifted", "repeated", "beyond",     "copied",  "almost",  "inserted",
                                               "lost",    "nan",      "moved",      "bow_tie", "fewer",   "more"};

typedef struct sheet {
    size_t vertices, faces;
    double x[MOST_VERTICES][3];
    unsigned corner[MOST_FACES][4];
} sheet;

static void make_sheet(bytes *in, sheet *s)
{
    unsigned i, j, v;
    s->vertices = s->faces = 0;
    for (i = 0; i <= SIDE; ++i)
        for (j = 0; j <= SIDE; ++j, ++s->vertices) {
            s->x[s->vertices][0] = (double)(100 * j + dice(in, 40));
            s->x[s->vertices][1] = (double)(100 * i + dice(in, 40));
            s->x[s->vertices][2] = dice(in, 30) / 3.0;
        }
    for (i = 0; i < SIDE; ++i)
        for (j = 0; j < SIDE; ++j, ++s->faces) {
            v = i * (SIDE + 1) + j;
            s->corner[s->faces][0] = v;
            s->corner[s->faces][1] = v + 1;
            s->corner[s->faces][2] = v + SIDE + 2;
            s->corner[s->faces][3] = v + SIDE + 1;
        }
}

static void exchange(unsigned *a, unsigned *b)
{
    unsigned swap = *a;
    *a = *b, *b = swap;
}

/* Plants the fault into what is written; changed is what it is read as, if it is read. Returns the face. */
static size_t plant(enum planted fault, bytes *in, sheet *written, sheet *changed)
{
    size_t face = dice(in, (unsigned)written->faces), v = dice(in, (unsigned)written->vertices), i;
    unsigned c = dice(in, 4), w = dice(in, (unsigned)written->vertices), *corner = written->corner[face];
    int copies = 1;
    switch (fault) {
    case TURNED:
        for (i = 0; i < written->faces; ++i)
            if (dice(in, 3) == 0) exchange(&written->corner[i][1], &written->corner[i][3]);
        return 0;
    case ALL_TURNED:
        for (i = 0; i < written->faces; ++i) exchange(&written->corner[i][1], &written->corner[i][3]);
        return 0;
    case TWICE: memcpy(written->corner[written->faces++], corner, sizeof written->corner[0]); return 0;
    case DROPPED:
        --written->faces;
        memmove(corner, corner + 4, (written->faces - face) * sizeof written->corner[0]);
        break;
    case EXCHANGED: exchange(&corner[c], &corner[(c + 1) % 4]); break;
    case SHIFTED: corner[c] = w; break;
    case REPEATED: corner[c] = corner[(c + 1) % 4]; break;
    case BEYOND: corner[c] = (unsigned)written->vertices + dice(in, 3); return 0;
    case ALMOST:
    case COPIED:
        for (i = 0; i < 3; ++i)
            written->x[written->vertices][i] =
                written->x[corner[c]][i] * (fault == ALMOST ? 1 + (dice(in, 7) - 3.0) * DBL_EPSILON : 1);
        corner[c] = (unsigned)written->vertices++;
        return 0;
    case INSERTED:
        memmove(written->x + v + 1, written->x + v, (written->vertices - v) * sizeof written->x[0]);
        ++written->vertices;
        break;
    case LOST:
        --written->vertices;
        memmove(written->x + v, written->x + v + 1, (written->vertices - v) * sizeof written->x[0]);
        break;
    case NOT_A_NUMBER: written->x[v][c % 3] = changed->x[v][c % 3] = (double)NAN; return 0; /* a hole */
    case MOVED: memcpy(written->x[v], written->x[w], sizeof written->x[v]); break;
    case BOW_TIE:
        for (i = 0; i < 3; ++i) {
            double swap = written->x[v][i];
            written->x[v][i] = written->x[w][i];
            written->x[w][i] = swap;
        }
        break;
    default: copies = 0;
    }
    if (copies) *changed = *written;
    return face < written->faces ? face : 0;
}

static void write_sheet(const sheet *s, int format, enum planted fault, char *text)
{
    size_t i, c;
    unsigned faces = (unsigned)s->faces, vertices = (unsigned)s->vertices;
    char *at = text;
    if (fault == FEWER) --faces;
    if (fault == MORE) ++faces;
    if (format == OFF) at += sprintf(at, "\nOFF\n%u %u 0\n", vertices, faces);
    if (format == OBJ) at += sprintf(at, "\n# made by hand\n");
    if (format == PLY)
        at += sprintf(at,
                      "\nply\nformat ascii 1.0\nelement vertex %u\nproperty double x\nproperty double y\n"
                      "property double z\nelement face %u\nproperty list uchar int vertex_indices\nend_header\n",
                      vertices, faces);
    for (i = 0; i < s->vertices; ++i) {
        if (format == OBJ) at += sprintf(at, "v ");
        for (c = 0; c < 3; ++c) at += sprintf(at, "%.17g%s", s->x[i][c], c < 2 ? " " : "\n");
    }
    for (i = 0; i < s->faces; ++i) {
        at += sprintf(at, format == OBJ ? "f" : "4");
        for (c = 0; c < 4; ++c) at += sprintf(at, " %u", s->corner[i][c] + (format == OBJ));
        at += sprintf(at, "\n");
    }
}

/* --- judged ------------------------------------------------------------------------------------------------------- */

/* Twice the area vector, from the diagonals. */
static void area_of(const sheet *s, size_t face, double *area)
{
    const unsigned *v = s->corner[face];
    double a[3], b[3];
    int k;
    for (k = 0; k < 3; ++k) {
        a[k] = s->x[v[2]][k] - s->x[v[0]][k];
        b[k] = s->x[v[3]][k] - s->x[v[1]][k];
    }
    cross_product(a, b, area);
}

static int same_place(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/* Is it this face of the sheet? Of vertices at one place those of the boundary are joined: joins says all or none. What
   a fault has folded over is seen from below. */
static int says_face(char *const *field, const sheet *s, size_t face, int joins)
{
    double x[MOST_ROWS][3], normal[MOST_ROWS][3], area[3];
    ring r;
    truth t;
    size_t i, c, k, below = 0;
    if (face >= s->faces) return 0;
    memset(normal, 0, sizeof normal);
    for (r.n = 4, c = 0; c < 4; ++c) {
        unsigned v = s->corner[face][c];
        if (v >= s->vertices) return 0;
        memcpy(x[c], s->x[v], sizeof x[c]);
        r.x[c][0] = (long)x[c][0], r.x[c][1] = (long)x[c][1];
        for (i = 0; i < s->faces; ++i)
            for (k = 0; k < 4; ++k) {
                const unsigned at = s->corner[i][k], before = s->corner[i][(k + 3) % 4];
                if (at != v && !(joins && same_place(s->x[at], x[c]))) continue;
                if (at == before || (joins && same_place(s->x[at], s->x[before]))) continue; /* twice in this face */
                area_of(s, i, area);
                if (!isfinite(area[0]) || !isfinite(area[1]) || !isfinite(area[2])) continue; /* a bad vertex */
                normal[c][0] += area[0], normal[c][1] += area[1], normal[c][2] += area[2];
            }
        below += normal[c][2] < 0;
    }
    if (same_place(x[0], x[3])) r.n = 3; /* the first corner, repeated */
    for (c = 0; c < 4 && below == 4; ++c) r.x[c][0] = -r.x[c][0];
    return find_truth(&r, IN_SPACE, x, normal, &t) && says(field, &t);
}

static void fuzz(bytes in)
{
    static char text[1 << 16], name[64];
    static sheet told, changed, written;
    char *field[64], *at;
    int format = (int)dice(&in, FORMATS), holds = 1, right, k;
    size_t planted_at;
    enum planted fault = (enum planted)dice(&in, FAULTS);
    make_sheet(&in, &told);
    changed = written = told;
    planted_at = plant(fault, &in, &written, &changed);
    write_sheet(&written, format, fault, text);
    run_command(text);
    for (at = world.said; at && next_row_said(&at, field);) {
        size_t face = strtoul(field[0], NULL, 10);
        for (right = says_face(field, &told, face, 0), k = 0; k < 4 && !right; ++k) {
            right = says_face(field, &changed, face, k % 2);
            if (k == 1) exchange(&changed.corner[planted_at][1], &changed.corner[planted_at][3]); /* turned round */
        }
        holds &= right;
    }
    snprintf(name, sizeof name, "%d %s", format, fault_name[fault]);
    JUDGE(name, holds || strstr(world.complained, "there and back") || strstr(world.complained, "too much to tell"),
          text);
    world_end();
}
