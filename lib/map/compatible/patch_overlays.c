/* Replaces patches of a map by overlays: B. Aronov, R. Seidel, D. Souvaine, On compatible
 * triangulations of simple polygons, 1993.
 *
 * Take a disc of triangles whose border is a simple polygon before and after the map. The overlay
 * of the two polygons' triangulations is a one-to-one map of it. */
#include "map/compatible/patch_overlays.h"

#include "map/compatible/compatible.h"
#include "map/compatible/overlay_start.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct patch {
    size_t first, n_triangles; /* in patches.order */
    size_t n;                  /* corners of its border */
    uint32_t *border;          /* their vertices, counter-clockwise */
    iccp_plmap filled;         /* its overlay, whose first n vertices are the border's; or empty */
} patch;

typedef struct patches {
    iccp_plmap *map;
    const uint32_t *patch_of; /* of each triangle: its patch, or NONE */
    uint32_t *order;          /* triangles in patches, patch by patch */
    uint32_t *next; /* of each vertex: the one after it on the border of a patch, or NONE */
    uint32_t *name; /* of each vertex: its new number, or NONE */
    size_t n;
    patch *patch;
} patches;

static icc_status reserve(patches *p, iccp_plmap *map, size_t n_patches, const uint32_t *patch_of,
                          const iccp_memory *memory)
{
    const size_t n = map->n_vertices, n_triangles = map->corners.n_triangles;
    *p = (patches){.map = map,
                   .patch_of = patch_of,
                   .order = iccp_alloc(memory, n_triangles, sizeof *p->order),
                   .next = iccp_alloc(memory, n, sizeof *p->next),
                   .name = iccp_alloc_zero(memory, n, sizeof *p->name),
                   .n = n_patches,
                   .patch = iccp_alloc_zero(memory, n_patches, sizeof *p->patch)};
    if (p->order == NULL || p->next == NULL || p->name == NULL || p->patch == NULL)
        return ICC_ERR_MEMORY;
    memset(p->next, 0xff, n * sizeof *p->next);
    return ICC_OK;
}

static void release(patches *p, const iccp_memory *memory)
{
    for (size_t k = 0; p->patch != NULL && k < p->n; ++k) {
        iccp_free(memory, p->patch[k].border);
        iccp_plmap_free(&p->patch[k].filled);
    }
    iccp_free(memory, p->patch);
    iccp_free(memory, p->order);
    iccp_free(memory, p->next);
    iccp_free(memory, p->name);
}

/* ---- triangles ---- */

/* Lists the triangles patch by patch. */
static void sort_triangles(patches *p)
{
    size_t first = 0;
    for (uint32_t t = 0; t < p->map->corners.n_triangles; ++t)
        if (p->patch_of[t] != NONE)
            ++p->patch[p->patch_of[t]].n_triangles;
    for (size_t k = 0; k < p->n; ++k) {
        p->patch[k].first = first;
        first += p->patch[k].n_triangles;
        p->patch[k].n_triangles = 0;
    }
    for (uint32_t t = 0; t < p->map->corners.n_triangles; ++t)
        if (p->patch_of[t] != NONE) {
            patch *const own = &p->patch[p->patch_of[t]];
            p->order[own->first + own->n_triangles++] = t;
        }
}

/* ---- borders ---- */

/* Whether the edge that a corner faces has the patch of its triangle on one side only. */
static bool is_border(const patches *p, uint32_t corner)
{
    const uint32_t twin = p->map->corners.twin[corner];
    return twin == ICCP_NO_NEIGHBOUR || p->patch_of[twin / 3] != p->patch_of[corner / 3];
}

static uint32_t corner_of(const patches *p, const patch *own, size_t i)
{
    return 3 * p->order[own->first + i / 3] + (uint32_t)(i % 3);
}

/* Counts the corners of each border. Returns how many all borders have together. */
static size_t count_corners(patches *p)
{
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * p->map->corners.n_triangles; ++c)
        if (p->patch_of[c / 3] != NONE && is_border(p, c)) {
            ++p->patch[p->patch_of[c / 3]].n;
            ++n;
        }
    return n;
}

/* Links the vertices of a border. Returns false if one of them is met twice. */
static bool link_border(patches *p, const patch *own)
{
    const iccp_corners *const corners = &p->map->corners;
    for (size_t i = 0; i < 3 * own->n_triangles; ++i) {
        const uint32_t c = corner_of(p, own, i);
        uint32_t *const next = &p->next[corners->vertex[iccp_after(c)]];
        if (!is_border(p, c))
            continue;
        if (*next != NONE)
            return false;
        *next = corners->vertex[iccp_before(c)];
    }
    return true;
}

static void unlink_border(patches *p, const patch *own)
{
    for (size_t i = 0; i < 3 * own->n_triangles; ++i)
        p->next[p->map->corners.vertex[corner_of(p, own, i)]] = NONE;
}

/* Reads the border's vertices. Returns false unless it is one closed walk with nothing fixed
 * inside. */
static bool read_border(const patches *p, const patch *own)
{
    const uint32_t *const vertex = p->map->corners.vertex;
    uint32_t v = NONE;
    size_t n = 0;
    for (size_t i = 0; i < 3 * own->n_triangles; ++i) {
        const uint32_t other = vertex[corner_of(p, own, i)];
        if (p->next[other] != NONE)
            v = other;
        else if (p->map->fixed[other] != ICCP_FREE)
            return false;
    }
    for (const uint32_t first = v; n < own->n && (n == 0 || v != first); v = p->next[v])
        own->border[n++] = v;
    return n == own->n && v == own->border[0];
}

/* ---- overlays ---- */

/* Fills a patch whose border was read. It stays empty if the border is not simple before or after
 * the map, or if rounding spoils the overlay. */
static icc_status draw(patch *own, const iccp_plmap *map, iccp_work *work, const iccp_env *env)
{
    iccp_overlay overlay = {.memory = env->memory};
    double *ends = iccp_alloc(&env->memory, own->n, 4 * sizeof *ends);
    icc_status status = ends != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t k = 0; status == ICC_OK && k < own->n; ++k) {
        const size_t v = own->border[k];
        memcpy(ends + 2 * k, map->points + 2 * v, 2 * sizeof *ends);
        memcpy(ends + 2 * (own->n + k), map->images + 2 * v, 2 * sizeof *ends);
    }
    if (status == ICC_OK)
        status = iccp_compatible_overlay(&overlay, own->n, ends, ends + 2 * own->n, env);
    if (status == ICC_OK) {
        iccp_work_charge(work, ICCP_CROSSING_COST * (double)(overlay.n_vertices - own->n));
        status = iccp_plmap_of_overlay(&own->filled, own->n, &overlay, map->stretch, &env->memory);
    }
    iccp_overlay_free(&overlay);
    iccp_free(&env->memory, ends);
    if (status == ICC_OK && !iccp_plmap_is_positive(&own->filled))
        iccp_plmap_free(&own->filled);
    else if (status == ICC_OK)
        status = iccp_overlay_relax(&own->filled, work, env);
    return status == ICC_ERR_BOUNDARY || status == ICC_ERR_RESOLUTION ? ICC_OK : status;
}

static icc_status fill_patch(patches *p, patch *own, iccp_work *work, const iccp_env *env)
{
    icc_status status = ICC_OK;
    own->border = iccp_alloc(&env->memory, own->n, sizeof *own->border);
    if (own->border == NULL)
        return ICC_ERR_MEMORY;
    if (link_border(p, own) && read_border(p, own))
        status = draw(own, p->map, work, env);
    /* Inner vertices of a filled patch go. */
    for (size_t i = 0; own->filled.n_vertices > 0 && i < 3 * own->n_triangles; ++i) {
        const uint32_t v = p->map->corners.vertex[corner_of(p, own, i)];
        if (p->next[v] == NONE)
            p->name[v] = NONE;
    }
    unlink_border(p, own);
    return status;
}

/* ---- the whole map ---- */

static bool is_kept(const patches *p, size_t triangle)
{
    const uint32_t k = p->patch_of[triangle];
    return k == NONE || p->patch[k].filled.n_vertices == 0;
}

/* Numbers the vertices that stay, and returns their number. */
static size_t number(patches *p)
{
    size_t n = 0;
    for (size_t v = 0; v < p->map->n_vertices; ++v)
        if (p->name[v] != NONE)
            p->name[v] = (uint32_t)n++;
    return n;
}

/* Appends the vertices and triangles of a filled patch to the result. */
static void append(iccp_plmap *result, const patches *p, const patch *own)
{
    const iccp_plmap *const filled = &own->filled;
    const size_t first = result->n_vertices - own->n;
    uint32_t *corner = result->corners.vertex + 3 * result->corners.n_triangles;
    for (size_t v = own->n; v < filled->n_vertices; ++v)
        iccp_plmap_copy_vertex(result, first + v, filled, v);
    for (size_t c = 0; c < 3 * filled->corners.n_triangles; ++c) {
        const uint32_t v = filled->corners.vertex[c];
        *corner++ = v < own->n ? p->name[own->border[v]] : (uint32_t)(first + v);
    }
    result->n_vertices += filled->n_vertices - own->n;
    result->corners.n_triangles += filled->corners.n_triangles;
}

/* Replaces the triangles of each filled patch by its overlay. */
static icc_status splice(patches *p, const iccp_env *env)
{
    iccp_plmap *const map = p->map, result;
    const size_t n_kept = number(p);
    size_t n = n_kept, n_triangles = 0, n_corners = 0;
    bool is_manifold;
    for (size_t t = 0; t < map->corners.n_triangles; ++t)
        n_triangles += is_kept(p, t);
    for (size_t k = 0; k < p->n; ++k)
        if (p->patch[k].filled.n_vertices > 0) {
            n += p->patch[k].filled.n_vertices - p->patch[k].n;
            n_triangles += p->patch[k].filled.corners.n_triangles;
        }
    icc_status status = iccp_plmap_begin(&result, n, n_triangles, map->stretch, &env->memory);
    if (status != ICC_OK)
        return status;
    for (size_t v = 0; v < map->n_vertices; ++v)
        if (p->name[v] != NONE)
            iccp_plmap_copy_vertex(&result, p->name[v], map, v);
    for (size_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (is_kept(p, c / 3))
            result.corners.vertex[n_corners++] = p->name[map->corners.vertex[c]];
    result.n_vertices = n_kept;
    result.corners.n_triangles = n_corners / 3;
    for (size_t k = 0; k < p->n; ++k)
        if (p->patch[k].filled.n_vertices > 0)
            append(&result, p, &p->patch[k]);
    status = iccp_find_twins(&result.corners, result.n_vertices, &is_manifold, env);
    result.featured = map->featured;
    iccp_plmap_free(status == ICC_OK ? map : &result);
    if (status == ICC_OK)
        *map = result;
    return status;
}

icc_status iccp_overlay_triangles(iccp_plmap *map, size_t n_patches, const uint32_t *patch_of,
                                  size_t most, bool *fits, iccp_work *work, const iccp_env *env)
{
    patches p;
    icc_status status = reserve(&p, map, n_patches, patch_of, &env->memory);
    *fits = false;
    if (status == ICC_OK) {
        sort_triangles(&p);
        *fits = count_corners(&p) <= most;
    }
    for (size_t k = 0; status == ICC_OK && *fits && k < p.n; ++k) {
        const iccp_env part = iccp_round(env, k, (double)p.n);
        status = fill_patch(&p, &p.patch[k], work, &part);
    }
    if (status == ICC_OK && *fits)
        status = splice(&p, env);
    release(&p, &env->memory);
    return status;
}
