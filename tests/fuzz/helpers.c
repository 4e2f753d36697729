/* helpers.c - fuzzes what builds, repairs and converts: lonlat, reverse, smooth, merge, regular polygons and edges of
   the sphere, texts of statuses. */
#include "api.h"

static void lonlat(bytes *in)
{
    double point[3] = {-7, -7, -7}, scaled[3], lon = take_number(in), lat = take_number(in), radius = take_number(in),
           norm;
    int status = surfmink_from_lonlat(lon, lat, radius, point), k;
    CLAIM(is_known(status));
    if (status != SURFMINK_OK) {
        CLAIM(point[0] == -7 && point[1] == -7 && point[2] == -7);
        return;
    }
    if (!(radius > 1e-100 && radius < 1e100)) return;
    CLAIM(surfmink_from_lonlat(lon, lat, 0x1p20 * radius, scaled) == SURFMINK_OK);
    for (k = 0; k < 3; ++k) CLAIM(scaled[k] == 0x1p20 * point[k] || fabs(point[k]) < 1e-300);
    CLAIM(surfmink_from_lonlat(lon, -lat, radius, scaled) == SURFMINK_OK && scaled[2] == -point[2]);
    norm = sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
    CLAIM(fabs(norm / radius - 1) < 1e-15);
}

/* Straight distance, in any unit. */
static int is_near(const double *a, const double *b, size_t stride, double distance)
{
    double most = 0, sum = 0;
    size_t k;
    for (k = 0; k < stride; ++k) {
        if (!(fabs(a[k] - b[k]) <= distance)) return 0;
        most = fmax(most, fabs(a[k] - b[k]));
    }
    for (k = 0; k < stride && most > 0; ++k) sum += (a[k] / most - b[k] / most) * (a[k] / most - b[k] / most);
    return most * sqrt(sum) < distance * (1 - 1e-14) || most == 0;
}

/* Twice reversed is what it was; what is merged has no neighbours within the distance; a smoothed outline keeps its
   centre. */
static void repairs(bytes *in)
{
    double corner[3 * CORNERS], normal[3 * CORNERS], copy[3 * CORNERS], before = 0, after = 0, most = 0, distance = 0;
    size_t n = take(in) % (CORNERS + 1), stride = 1 + take(in) % 3, i, left;
    for (i = 0; i < n * stride; ++i) corner[i] = take_number(in);
    for (i = 0; i < 3 * n; ++i) normal[i] = (double)i;
    memcpy(copy, corner, n * stride * sizeof *corner);
    surfmink_reverse(corner, n, stride);
    surfmink_reverse(corner, n, stride);
    CLAIM(same_bits(copy, corner, n * stride * sizeof *corner));
    surfmink_smooth(corner, n, stride, take(in) % 4);
    for (i = 0; i < n * stride; ++i) {
        before += copy[i];
        after += corner[i];
        most += fabs(copy[i]);
    }
    if (most < 1e300) CLAIM(fabs(before - after) <= 1e-13 * most + 1e-300);
    if (take(in) < 128) distance = fabs(take_number(in));
    left = surfmink_merge(copy, normal, n, stride, distance);
    CLAIM(left <= n && (left > 0 || n == 0));
    for (i = 0; i < left; ++i) {
        CLAIM(left == 1 || !is_near(copy + i * stride, copy + (i + 1 < left ? i + 1 : 0) * stride, stride, distance));
        CLAIM(i == 0 || normal[3 * i] > normal[3 * i - 3]);
    }
    CLAIM(surfmink_merge(copy, NULL, left, stride, distance) == left);
}

/* Smoothing does not care where an outline begins, which way it runs, or in which unit it is. */
static void smoothing(bytes *in)
{
    double corner[2 * CORNERS], other[2 * CORNERS];
    size_t n = take(in) % (CORNERS + 1), by = take(in), passes = take(in) % 4, i;
    for (i = 0; i < 2 * n; ++i) corner[i] = take_number(in);
    for (i = 0; i < 2 * n; ++i)
        if (!(fabs(corner[i]) < 1e100) || (corner[i] != 0 && !(fabs(corner[i]) > 1e-100))) return;
    for (i = 0; i < 2 * n; ++i) other[i] = 0x1p20 * corner[(i + 2 * by) % (2 * n)];
    surfmink_smooth(corner, n, 2, passes);
    surfmink_smooth(other, n, 2, passes);
    for (i = 0; i < 2 * n; ++i) CLAIM(other[i] == 0x1p20 * corner[(i + 2 * by) % (2 * n)]);
}

/* Regular polygons are regular, edges lead to their ends. */
static void builders(bytes *in)
{
    double radius = take_number(in), centre[3], corner[3 * CORNERS], untouched[3 * CORNERS];
    double distance = take_number(in), angle = take_number(in), mu[CORNERS + 1];
    surfmink_outline built;
    surfmink_surface sphere = surfmink_sphere_surface(&radius);
    size_t n = take(in) % (CORNERS + 1), k;
    int status;
    for (k = 0; k < 3; ++k) centre[k] = take_number(in);
    memset(corner, 0x5a, sizeof corner);
    memcpy(untouched, corner, sizeof corner);
    status = surfmink_regular_polygon(&sphere, centre, distance, angle, n, corner);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK)
        CLAIM(same_bits(corner, untouched, sizeof corner));
    else
        CLAIM(all_finite(corner, 3 * n));
    if (status == SURFMINK_OK && fabs(angle) < 7 && radius > 1e-290 && distance > 1e-7 * radius &&
        distance < 1.5 * radius) {
        built = surfmink_sphere(corner, n, radius);
        status = surfmink_measure(&built, (int)n, mu, NULL, NULL, NULL);
        CLAIM(status == SURFMINK_NOT_FINITE || (status == SURFMINK_OK && fabs(mu[n] - 1) < 1e-6));
    }
    if (status != SURFMINK_OK) return;
    memset(untouched, 0x5a, sizeof untouched);
    status = surfmink_edge_points(&sphere, corner, centre, n, untouched);
    CLAIM(is_known(status));
    if (status != SURFMINK_OK)
        CLAIM(is_untouched(untouched, sizeof untouched));
    else
        CLAIM(all_finite(untouched, 3 * n) && is_untouched(untouched + 3 * n, (CORNERS - n) * 3 * sizeof *corner));
}

static void fuzz(bytes in)
{
    int status = (int)take(&in) - 100;
    CLAIM(is_known(status) == (*surfmink_strerror(status) != '\0'));
    CLAIM(is_known(status) == (*surfmink_status_name(status) != '\0'));
    lonlat(&in);
    repairs(&in);
    smoothing(&in);
    builders(&in);
}
