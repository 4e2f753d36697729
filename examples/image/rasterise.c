/* rasterise.c - tissues whose cells are known exactly, as label images: how well does outlines find them?

     rasterise KIND ACROSS DIRECTORY [SEED [SIDE]]

   KIND    plane (straight sides), curved, sphere or ellipsoid; ACROSS: pixels across a cell, about
   SIDE    in the plane: so many cells each way (20; without exact.tsv above 60)
   writes  labels.npy, on surfaces also positions.npy and normals.npy (Mercator's chart, for --wrap x), and exact.tsv,
           the exact outlines, as surfmink reads them

   compile   cc examples/image/rasterise.c -o rasterise -lm */

#include "raster.h"

static int fails(const char *what)
{
    fprintf(stderr, "rasterise: %s\n", what);
    return 1;
}

static const char *path(const char *directory, const char *name)
{
    static char text[1024];
    snprintf(text, sizeof text, "%.900s/%s", directory, name);
    return text;
}

/* The cells as a table. */
static int write_exact(const raster *t, const char *name)
{
    enum { ROOM = RASTER_CORNERS * RASTER_ALONG };
    static double point[6 * ROOM];
    size_t cell, k, c, n, columns = t->is_surface ? 6 : 2;
    FILE *file = fopen(name, "w");
    int failed;
    if (!file) return 0;
    fputs(t->is_surface ? "cell\tk\tx\ty\tz\tnx\tny\tnz\n" : "cell\tk\tx\ty\n", file);
    for (cell = 0; cell < t->cells; ++cell) {
        n = raster_cell(t, cell, point, ROOM);
        for (k = 0; k < n; ++k) {
            fprintf(file, "%lu\t%lu", (unsigned long)cell + 1, (unsigned long)k);
            for (c = 0; c < columns; ++c) fprintf(file, "\t%.12g", point[columns * k + c]);
            fputc('\n', file);
        }
    }
    failed = ferror(file);
    return fclose(file) == 0 && !failed;
}

static int draw_plane(raster *t, size_t across, const char *directory)
{
    size_t size = t->side * across;
    uint32_t *label = (uint32_t *)malloc(size * size * sizeof *label);
    int good = label && raster_draw_plane(t, across, label) &&
               raster_write_npy(path(directory, "labels.npy"), label, 0, 1, size, size);
    free(label);
    return good;
}

static int draw_surface(raster *t, size_t across, const char *directory)
{
    raster_map map;
    size_t pixels;
    uint32_t *label;
    float *position, *normal;
    int good;
    map.kind = RASTER_MERCATOR;
    map.width = (size_t)((double)across * sqrt(RASTER_PI * (double)t->cells));
    map.height = map.width * 4 / 5;
    map.scale = 2 * RASTER_PI / (double)map.width;
    pixels = map.width * map.height;
    label = (uint32_t *)malloc(pixels * sizeof *label);
    position = (float *)malloc(3 * pixels * sizeof *position);
    normal = (float *)malloc(3 * pixels * sizeof *normal);
    good = label && position && normal;
    if (good) raster_draw_chart(t, &map, label, position, normal);
    good = good && raster_write_npy(path(directory, "labels.npy"), label, 0, 1, map.height, map.width) &&
           raster_write_npy(path(directory, "positions.npy"), position, 1, 3, map.height, map.width) &&
           raster_write_npy(path(directory, "normals.npy"), normal, 1, 3, map.height, map.width);
    free(label);
    free(position);
    free(normal);
    return good;
}

int main(int argc, char **argv)
{
    static const double sphere[3] = {1, 1, 1}, embryo[3] = {110, 50, 40};
    const char *kind = argc > 1 ? argv[1] : "";
    int curved = strcmp(kind, "curved") == 0, plane = curved || strcmp(kind, "plane") == 0, good;
    long across = argc > 2 ? atol(argv[2]) : 0, seed = argc > 4 ? atol(argv[4]) : 1,
         side = argc > 5 ? atol(argv[5]) : 20;
    raster t;
    if (argc < 4 || across < 1 || across > 1000 || side < 2 || side > 1000)
        return fails("usage: rasterise plane|curved|sphere|ellipsoid ACROSS DIRECTORY [SEED [SIDE]]");
    if (plane)
        good = raster_plane(&t, (size_t)side, curved ? 0.4 : 0, (uint64_t)seed, side <= 60);
    else if (strcmp(kind, "sphere") == 0 || strcmp(kind, "ellipsoid") == 0)
        good = raster_surface(&t, 400, kind[0] == 's' ? sphere : embryo, (uint64_t)seed, 1);
    else
        return fails("the first argument is plane, curved, sphere or ellipsoid");
    good = good && (plane ? draw_plane(&t, (size_t)across, argv[3]) : draw_surface(&t, (size_t)across, argv[3]));
    if (side <= 60) good = good && write_exact(&t, path(argv[3], "exact.tsv"));
    raster_free(&t);
    return good ? 0 : fails("out of memory, or a file cannot be written");
}
