/* geojson.h - step 1 of the command: GeoJSON (RFC 7946) -> its polygons, an outline for each ring.

   {"type": "FeatureCollection", "features": [{"type": "Feature", "id": ..., "properties": {"name": ...},
    "geometry": {"type": "Polygon", "coordinates": [[[lon, lat], ...], ...]}}, ...]}

   A single Feature or geometry will do, too. The id of a feature is the property that --id names; or its "id"; or its
   property id, name, NAME or ADMIN; or its number. Parts of a MultiPolygon are id/0, id/1, ..., holes id/0/hole1, ...
   Which way a ring runs does not matter: the first of a part is the outer one. A hole is measured as an outline itself.
   Pieces that were cut at the antimeridian are joined again: antimeridian.h.

   Text and rings are kept in memory. Points and lines are left out, with a word; what is no GeoJSON is refused. */
#ifndef SURFMINK_COMMAND_GEOJSON_H
#define SURFMINK_COMMAND_GEOJSON_H

#include "antimeridian.h"
#include "json.h"
#include "polygon.h"
#include "seen.h"

typedef struct geojson {
    json json;
    const char *id_name;     /* that --id asks for; NULL: none */
    lonlat_rings rings;      /* of all features */
    size_t first_of_feature; /* ring */
    size_t parts;            /* of the feature */
    char *ids;               /* texts, one after the other; that of the feature at hand is the last */
    size_t ids_length, ids_room;
    int on_sphere; /* or lon lat are x y of a plane */
    int id_rank;   /* of the id at hand: the higher, the better */
    size_t features, left_out, next;
    seen_ids seen;
} geojson;

/* [[lon, lat], ...] as ring `hole` of the part at hand. */
static void read_ring(geojson *g, size_t hole)
{
    double lon, lat;
    json_expect(&g->json, '[');
    json_next(&g->json);
    begin_ring(&g->rings, g->ids_length, g->parts, hole, g->json.line);
    if (json_takes(&g->json, ']')) return;
    do {
        json_expect(&g->json, '[');
        lon = json_number(&g->json);
        json_expect(&g->json, ',');
        lat = json_number(&g->json);
        while (json_takes(&g->json, ',')) json_number(&g->json); /* a height */
        json_expect(&g->json, ']');
        add_to_ring(&g->rings, lon, lat);
    } while (json_takes(&g->json, ','));
    json_expect(&g->json, ']');
}

/* Lists of coordinates, so many levels above rings: 1 a Polygon, 2 a MultiPolygon. */
static void read_coordinates(geojson *g, int levels)
{
    size_t hole = 0;
    json_expect(&g->json, '[');
    if (!json_takes(&g->json, ']')) {
        do
            if (levels > 1)
                read_coordinates(g, levels - 1);
            else
                read_ring(g, hole++);
        while (json_takes(&g->json, ','));
        json_expect(&g->json, ']');
    }
    if (levels == 1) ++g->parts;
}

/* --- features ----------------------------------------------------------------------------------------------------- */

/* The value that comes next is the id, unless a better one has been found. */
static void read_id(geojson *g, int rank)
{
    char word[64], c = json_next(&g->json);
    const char *text = word;
    size_t length;
    if (c == '{' || c == '[') {
        json_skip(&g->json, 0);
        return;
    }
    if (c == '"')
        text = json_string(&g->json);
    else
        json_word(&g->json, word, sizeof word);
    if (rank <= g->id_rank || (c != '"' && strcmp(text, "null") == 0) || *text == '\0') return;
    length = strlen(text) + 1;
    g->ids = (char *)grow(g->ids, &g->ids_room, g->ids_length + length, 1);
    memcpy(g->ids + g->ids_length, text, length);
    g->id_rank = rank;
}

static void read_properties(geojson *g)
{
    static const char *const usual[] = {"ADMIN", "NAME", "name", "id"};
    if (json_next(&g->json) != '{') {
        json_skip(&g->json, 0);
        return;
    }
    ++g->json.at;
    if (json_takes(&g->json, '}')) return;
    do {
        const char *key = json_string(&g->json);
        int k = 0;
        while (k < 4 && strcmp(key, usual[k]) != 0) ++k;
        json_expect(&g->json, ':');
        if (g->id_name && strcmp(key, g->id_name) == 0)
            read_id(g, 6);
        else if (k < 4)
            read_id(g, k + 1);
        else
            json_skip(&g->json, 0);
    } while (json_takes(&g->json, ','));
    json_expect(&g->json, '}');
}

static void begin_feature(geojson *g)
{
    char number[32];
    int length = snprintf(number, sizeof number, "%lu", (unsigned long)g->features++) + 1;
    g->ids = (char *)grow(g->ids, &g->ids_room, g->ids_length + (size_t)length, 1);
    memcpy(g->ids + g->ids_length, number, (size_t)length);
    g->id_rank = 0;
    g->parts = 0;
    g->first_of_feature = g->rings.count;
}

/* RFC 7946 has straight lines in lon lat, and cuts what crosses the antimeridian; many writers do not. */
static void tell_long_edges(const geojson *g)
{
    size_t i, j;
    for (i = g->first_of_feature; g->on_sphere && i < g->rings.count; ++i) {
        const lonlat_ring *r = &g->rings.ring[i];
        for (j = 0; j < r->count; ++j) {
            const double *a = g->rings.point + 2 * (r->first + j);
            const double *b = j + 1 < r->count ? a + 2 : g->rings.point + 2 * r->first;
            if (fabs(a[0] - b[0]) > 180 && fabs(a[0] - b[0]) < 360 && fabs(a[1]) < 90 && fabs(b[1]) < 90 &&
                warns(WARN_LONG))
                remark("%s:%lu: %s: the edge from longitude %g to %g is taken the short way, across 180 degrees; "
                       "corners in between lead it the long way",
                       g->json.in->name, r->line, g->ids + r->id, a[0], b[0]);
        }
    }
}

static void end_feature(geojson *g)
{
    if (g->id_name && g->id_rank < 6)
        die("%s:%lu: no property '%s' in this feature", g->json.in->name, g->json.line, g->id_name);
    if (finish_rings(&g->rings, g->first_of_feature, g->on_sphere))
        remark("%s:%lu: %s: pieces cut at the antimeridian are joined", g->json.in->name, g->json.line,
               g->ids + g->ids_length);
    tell_long_edges(g);
    if (!says_nothing && is_seen(&g->seen, g->ids + g->ids_length) && warns(WARN_AGAIN))
        remark("%s:%lu: id %s comes again: --id takes the ids from another property", g->json.in->name, g->json.line,
               g->ids + g->ids_length);
    g->ids_length += strlen(g->ids + g->ids_length) + 1;
    g->first_of_feature = g->rings.count;
}

/* The old member crs. Codes 4000 to 4999 of EPSG are degrees; those of maps are metres. */
static void check_crs(geojson *g, int depth)
{
    size_t at;
    const char *code;
    json_next(&g->json);
    at = g->json.at;
    json_skip(&g->json, depth);
    for (; at < g->json.at && g->on_sphere; ++at) {
        if (strncmp(g->json.text + at, "EPSG:", 5) != 0) continue;
        code = strrchr(g->json.text + at, ':') + 1;
        if (strtol(code, NULL, 10) / 1000 != 4)
            die("%s:%lu: the coordinates are in EPSG:%.8s, not in degrees: ogr2ogr -t_srs EPSG:4326 converts them, "
                "--surface plane measures the map",
                g->json.in->name, g->json.line, code);
    }
}

/* An object: a collection, a feature, or a geometry, in which type and coordinates may come in any order. */
static void read_object(geojson *g, int depth)
{
    const char *key, *type = "";
    size_t at = 0, end;
    unsigned long line = 0, end_line;
    int levels, is_gltf = 0;
    if (depth > DEEPEST_JSON) bad_json(&g->json, "nested too deeply");
    json_expect(&g->json, '{');
    if (json_next(&g->json) == '}') bad_json(&g->json, "an object without a type: not GeoJSON");
    do {
        key = json_string(&g->json);
        json_expect(&g->json, ':');
        if (strcmp(key, "type") == 0 && json_next(&g->json) == '"') {
            type = json_string(&g->json);
        } else if (strcmp(key, "coordinates") == 0) {
            json_next(&g->json);
            at = g->json.at;
            line = g->json.line;
            json_skip(&g->json, depth);
        } else if (strcmp(key, "crs") == 0) {
            check_crs(g, depth);
        } else if (strcmp(key, "id") == 0) {
            read_id(g, 5);
        } else if (strcmp(key, "properties") == 0) {
            read_properties(g);
        } else if (strcmp(key, "geometry") == 0 && json_next(&g->json) == '{') {
            read_object(g, depth + 1);
        } else if ((strcmp(key, "features") == 0 || strcmp(key, "geometries") == 0) && json_takes(&g->json, '[')) {
            int is_collection = key[0] == 'f';
            if (json_takes(&g->json, ']')) continue;
            do {
                if (is_collection) begin_feature(g);
                read_object(g, depth + 1);
                if (is_collection) end_feature(g);
            } while (json_takes(&g->json, ','));
            json_expect(&g->json, ']');
        } else {
            is_gltf |= strcmp(key, "asset") == 0;
            json_skip(&g->json, depth);
        }
    } while (json_takes(&g->json, ','));
    json_expect(&g->json, '}');
    if (strcmp(type, "Topology") == 0)
        bad_json(&g->json, "TopoJSON is not read: topo2geo, or mapshaper, makes GeoJSON of it");
    levels = strcmp(type, "Polygon") == 0 ? 1 : strcmp(type, "MultiPolygon") == 0 ? 2 : 0;
    if (!at && levels) bad_json(&g->json, "a polygon without coordinates");
    if (!levels && !strstr("Feature FeatureCollection GeometryCollection", *type ? type : "none")) {
        if (!at && is_gltf) bad_json(&g->json, "glTF is not read: Blender or MeshLab saves it as PLY");
        if (!at) bad_json(&g->json, "an object that is not GeoJSON");
        ++g->left_out; /* points and lines */
    }
    if (!levels) return;
    end = g->json.at, end_line = g->json.line;
    g->json.at = at, g->json.line = line;
    read_coordinates(g, levels);
    g->json.at = end, g->json.line = end_line;
}

static void read_geojson(geojson *g, lines *in, const options *o)
{
    size_t room = 0, count, before;
    memset(g, 0, sizeof *g);
    g->json.in = in;
    g->id_name = o->id;
    g->on_sphere = o->surface != PLANE;
    g->json.line = 1;
    if (o->surface != SPHERE && o->surface != AS_THE_COLUMNS_SAY && o->surface != PLANE)
        die("%s: GeoJSON has lon lat: --surface sphere, or --surface plane", in->name);
    do {
        g->json.text = (char *)grow(g->json.text, &room, g->json.size + BLOCK_SIZE, 1);
        count = take_bytes(in, g->json.text + g->json.size, room - g->json.size);
        g->json.size += count;
    } while (count > 0);
    if (g->json.size >= 3 && memcmp(g->json.text, "\xef\xbb\xbf", 3) == 0) g->json.at = 3;
    if (memchr(g->json.text, '\0', g->json.size)) bad_json(&g->json, "a zero byte: this is not plain text");
    do { /* one object; or features line by line */
        before = g->features;
        begin_feature(g);
        g->features = before; /* those of a collection begin with the same number */
        read_object(g, 0);
        if (g->rings.count > g->first_of_feature) end_feature(g);
        if (g->features == before) ++g->features;
    } while (json_next(&g->json) == '{');
    if (json_next(&g->json)) bad_json(&g->json, "something follows the end of the GeoJSON");
    if (g->left_out)
        remark("%s: %lu points or lines are left out: they enclose nothing", in->name, (unsigned long)g->left_out);
}

/* How many rings, or outer rings, the feature of ring r has. */
static size_t parts_of_feature(const lonlat_rings *all, size_t r)
{
    size_t i, outer = 0;
    for (i = r; i > 0 && all->ring[i - 1].id == all->ring[r].id;) --i;
    for (; i < all->count && all->ring[i].id == all->ring[r].id; ++i) outer += all->ring[i].hole == 0;
    return outer;
}

static int next_of_geojson(geojson *g, polygon *p, int surface)
{
    const lonlat_ring *r = &g->rings.ring[g->next];
    const char *feature;
    char suffix[64] = "", *id;
    size_t i, used = 0;
    double x[3];
    if (g->next == g->rings.count) return 0;
    feature = g->ids + r->id;
    if (parts_of_feature(&g->rings, g->next) > 1)
        used = (size_t)snprintf(suffix, sizeof suffix, "/%lu", (unsigned long)r->part);
    if (r->hole) snprintf(suffix + used, sizeof suffix - used, "/hole%lu", (unsigned long)r->hole);
    id = (char *)resize(NULL, strlen(feature) + sizeof suffix, 1);
    strcpy(id, feature);
    strcat(id, suffix);
    begin_polygon(p, surface, id, r->line);
    free(id);
    for (i = 0; i < r->count; ++i) {
        const double *lonlat = g->rings.point + 2 * (r->first + i);
        int status = isfinite(lonlat[0]) && isfinite(lonlat[1]) ? SURFMINK_OK : SURFMINK_NOT_FINITE;
        memcpy(x, lonlat, 2 * sizeof *x);
        if (status == SURFMINK_OK && surface == SPHERE) status = surfmink_from_lonlat(lonlat[0], lonlat[1], 1, x);
        find_fault(p, status, r->line);
        add_corner(p, x, NULL, r->line);
    }
    ++g->next;
    return 1;
}

static void free_geojson(geojson *g)
{
    free(g->json.text);
    free(g->ids);
    free_rings(&g->rings);
    free_seen(&g->seen);
}

#endif
