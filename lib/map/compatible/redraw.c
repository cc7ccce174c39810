/* A disc of triangles that cannot be untangled as they are joined has a map all the same when its
 * border is a simple polygon before and after the map: by their compatible triangulations
 * (map/compatible/compatible.h). Rings of neighbours are added until it is, and the map of the disc
 * is fair. */
#include "map/compatible/redraw.h"

#include "map/compatible/compatible.h"
#include "map/compatible/overlay_start.h"

#include <math.h>
#include <string.h>

/* Rings of neighbours and corners of a patch at most; crossings go with the square of these. */
enum { MOST_RINGS = 8, MOST_CORNERS = 100 };

/* A patch with less energy than this is not made larger. */
static const double ENOUGH = 20;

static const uint32_t NONE = UINT32_MAX;

typedef struct patch {
    iccp_plmap *map;
    uint8_t *inside;  /* of each triangle */
    uint8_t *ring;    /* of each vertex: 1 more than how far it is from the first triangle; or 0 */
    uint32_t *next;   /* of each vertex: the one after it on the border, or NONE */
    uint32_t *name;   /* of each vertex: its number in the result, or NONE */
    size_t n;         /* corners of the border, counter-clockwise, which have the first numbers */
    uint32_t *border; /* their vertices */
    double *points, *images; /* of the border */
} patch;

static void release(patch *p, const iccp_memory *memory)
{
    iccp_free(memory, p->inside);
    iccp_free(memory, p->ring);
    iccp_free(memory, p->next);
    iccp_free(memory, p->name);
    iccp_free(memory, p->border);
    iccp_free(memory, p->points);
    iccp_free(memory, p->images);
}

static icc_status reserve(patch *p, iccp_plmap *map, const iccp_memory *memory)
{
    *p = (patch){.map = map};
    p->inside = iccp_alloc(memory, map->corners.n_triangles, 1);
    p->ring = iccp_alloc(memory, map->n_vertices, 1);
    p->next = iccp_alloc(memory, map->n_vertices, sizeof *p->next);
    p->name = iccp_alloc(memory, map->n_vertices, sizeof *p->name);
    p->border = iccp_alloc(memory, MOST_CORNERS, sizeof *p->border);
    p->points = iccp_alloc(memory, MOST_CORNERS, 2 * sizeof *p->points);
    p->images = iccp_alloc(memory, MOST_CORNERS, 2 * sizeof *p->images);
    return p->inside != NULL && p->ring != NULL && p->next != NULL && p->name != NULL &&
                   p->border != NULL && p->points != NULL && p->images != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* So many rings of neighbours, of which all but the last are known: what has a corner in them is
 * inside. */
static void enclose(patch *p, uint8_t rings)
{
    const uint32_t *const v = p->map->corners.vertex;
    for (size_t t = 0; t < p->map->corners.n_triangles; ++t) {
        p->inside[t] = 0;
        for (size_t k = 0; k < 3; ++k)
            p->inside[t] |= p->ring[v[3 * t + k]] > 0 && p->ring[v[3 * t + k]] <= rings;
        for (size_t k = 0; k < 3 && p->inside[t]; ++k)
            if (p->ring[v[3 * t + k]] == 0)
                p->ring[v[3 * t + k]] = (uint8_t)(rings + 1);
    }
}

static bool is_border(const patch *p, uint32_t corner)
{
    const uint32_t twin = p->map->corners.twin[corner];
    return twin == ICCP_NO_NEIGHBOUR || !p->inside[twin / 3];
}

/* Links the border's vertices; the number of its edges, or 0 when one is met twice. */
static size_t link_border(patch *p)
{
    const iccp_corners *const corners = &p->map->corners;
    size_t n = 0;
    memset(p->next, 0xff, p->map->n_vertices * sizeof *p->next);
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c) {
        if (!p->inside[c / 3] || !is_border(p, c))
            continue;
        uint32_t *const next = &p->next[corners->vertex[iccp_after(c)]];
        if (*next != NONE)
            return 0;
        *next = corners->vertex[iccp_before(c)];
        ++n;
    }
    return n;
}

/* Whether what is held lies on the border: inner vertices are free, and no inner edge is a line's.
 */
static bool is_free_inside(const patch *p)
{
    const iccp_corners *const corners = &p->map->corners;
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c) {
        const uint32_t v = corners->vertex[c];
        if (p->inside[c / 3] && ((p->map->fixed[v] != ICCP_FREE && p->next[v] == NONE) ||
                                 (!is_border(p, c) && iccp_plmap_is_line(p->map, c))))
            return false;
    }
    return true;
}

/* Whether the patch is a disc without anything held inside and with few corners; these are read
 * along its border, which is one closed walk. */
static bool read_border(patch *p)
{
    const size_t n = link_border(p);
    if (n < 3 || n > MOST_CORNERS || !is_free_inside(p))
        return false;
    uint32_t first = 0;
    while (p->next[first] == NONE)
        ++first;
    uint32_t v = first;
    p->n = 0;
    do {
        memcpy(p->points + 2 * p->n, p->map->points + 2 * (size_t)v, 2 * sizeof(double));
        memcpy(p->images + 2 * p->n, p->map->images + 2 * (size_t)v, 2 * sizeof(double));
        p->border[p->n++] = v;
        v = p->next[v];
    } while (v != first && p->n < n);
    return v == first && p->n == n;
}

/* The overlay of the patch as a map of its own with its border fixed. */
static icc_status fill(iccp_plmap *filled, const patch *p, const iccp_overlay *overlay,
                       const iccp_memory *memory)
{
    const size_t n = overlay->n_vertices;
    const icc_status status =
        iccp_plmap_begin(filled, n, overlay->corners.n_triangles, p->map->stretch, memory);
    if (status != ICC_OK)
        return status;
    iccp_plmap_fill(filled, overlay->points, overlay->images, overlay->corners.vertex,
                    overlay->corners.twin);
    for (uint32_t v = 0; v < n; ++v) {
        filled->fixed[v] = v < p->n ? ICCP_ALONG : ICCP_FREE;
        filled->facet[v] = v < p->n ? v : 0;
        filled->along[v] = 0;
    }
    return ICC_OK;
}

static bool is_positive(const iccp_plmap *map)
{
    bool is = true;
    for (uint32_t t = 0; t < map->corners.n_triangles && is; ++t)
        is = iccp_plmap_positive_point(map, t) && iccp_plmap_positive_image(map, t);
    return is;
}

/* A positive map of the patch; one without vertices where its border has none. */
static icc_status draw(iccp_plmap *filled, const patch *p, iccp_work *work, const iccp_env *env)
{
    iccp_overlay overlay;
    icc_status status = iccp_compatible_overlay(&overlay, p->n, p->points, p->images, env);
    if (status == ICC_OK)
        status = fill(filled, p, &overlay, &env->memory);
    iccp_overlay_free(&overlay);
    if (status == ICC_OK && !is_positive(filled))
        iccp_plmap_free(filled);
    else if (status == ICC_OK)
        status = iccp_overlay_relax(filled, work, env);
    return status == ICC_ERR_BOUNDARY || status == ICC_ERR_RESOLUTION ? ICC_OK : status;
}

static void copy_vertex(iccp_plmap *to, size_t a, const iccp_plmap *from, size_t b)
{
    memcpy(to->points + 2 * a, from->points + 2 * b, 2 * sizeof(double));
    memcpy(to->images + 2 * a, from->images + 2 * b, 2 * sizeof(double));
    to->fixed[a] = from->fixed[b];
    to->facet[a] = from->facet[b];
    to->along[a] = from->along[b];
}

/* Vertices that stay get their new numbers: all but those inside. Returns how many they are. */
static size_t number(patch *p)
{
    const iccp_corners *const corners = &p->map->corners;
    memset(p->name, 0, p->map->n_vertices * sizeof *p->name);
    for (size_t c = 0; c < 3 * corners->n_triangles; ++c)
        if (p->inside[c / 3] && p->next[corners->vertex[c]] == NONE)
            p->name[corners->vertex[c]] = NONE;
    size_t n = 0;
    for (size_t v = 0; v < p->map->n_vertices; ++v)
        if (p->name[v] != NONE)
            p->name[v] = (uint32_t)n++;
    return n;
}

/* Puts the filled patch in the place of what was inside. */
static icc_status splice(patch *p, const iccp_plmap *filled, const iccp_env *env)
{
    iccp_plmap *const map = p->map, result;
    size_t n_triangles = filled->corners.n_triangles, n = 0;
    bool is_manifold;
    const size_t n_kept = number(p);
    for (size_t t = 0; t < map->corners.n_triangles; ++t)
        n_triangles += !p->inside[t];
    icc_status status = iccp_plmap_begin(&result, n_kept + filled->n_vertices - p->n, n_triangles,
                                         map->stretch, &env->memory);
    if (status != ICC_OK)
        return status;
    for (size_t v = 0; v < map->n_vertices; ++v)
        if (p->name[v] != NONE)
            copy_vertex(&result, p->name[v], map, v);
    for (size_t v = p->n; v < filled->n_vertices; ++v)
        copy_vertex(&result, n_kept + v - p->n, filled, v);
    for (size_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (!p->inside[c / 3])
            result.corners.vertex[n++] = p->name[map->corners.vertex[c]];
    for (size_t c = 0; c < 3 * filled->corners.n_triangles; ++c) {
        const uint32_t v = filled->corners.vertex[c];
        result.corners.vertex[n++] =
            v < p->n ? p->name[p->border[v]] : (uint32_t)(n_kept + v - p->n);
    }
    status = iccp_find_twins(&result.corners, result.n_vertices, &is_manifold, env);
    iccp_plmap_free(status == ICC_OK ? map : &result);
    if (status == ICC_OK)
        *map = result;
    return status;
}

/* Of the patches round a triangle, the first with little energy, or the one with least. */
static icc_status redraw_round(iccp_plmap *map, size_t triangle, iccp_work *work, bool *done,
                               const iccp_env *env)
{
    patch p;
    iccp_plmap best = {.memory = env->memory};
    double least = HUGE_VAL;
    uint8_t rings = 0;
    icc_status status = reserve(&p, map, &env->memory);
    if (status == ICC_OK) {
        memset(p.ring, 0, map->n_vertices);
        for (size_t k = 0; k < 3; ++k)
            p.ring[map->corners.vertex[3 * triangle + k]] = 1;
    }
    for (uint8_t r = 1; status == ICC_OK && least > ENOUGH && r <= MOST_RINGS; ++r) {
        iccp_plmap other = {.memory = env->memory};
        enclose(&p, r);
        if (!read_border(&p))
            continue;
        status = draw(&other, &p, work, env);
        const double energy = other.n_vertices > 0 ? iccp_plmap_energy(&other) : HUGE_VAL;
        if (status == ICC_OK && energy < least) {
            const iccp_plmap worse = best;
            best = other;
            other = worse;
            least = energy;
            rings = r;
        }
        iccp_plmap_free(&other);
    }
    *done = status == ICC_OK && rings > 0;
    if (*done) {
        enclose(&p, rings);
        *done = read_border(&p);
        status = splice(&p, &best, env);
    }
    iccp_plmap_free(&best);
    release(&p, &env->memory);
    return status;
}

icc_status iccp_redraw(iccp_plmap *map, iccp_work *work, size_t *n_left, const iccp_env *env)
{
    icc_status status = ICC_OK;
    bool done = true;
    for (size_t t = 0; status == ICC_OK && done && t < map->corners.n_triangles;) {
        if (iccp_plmap_positive_image(map, (uint32_t)t)) {
            ++t;
            continue;
        }
        status = redraw_round(map, t, work, &done, env);
    }
    *n_left = iccp_plmap_count_inverted(map);
    return status;
}
