/* Encloses the inverted triangles of a map by patches. In each round, the patches are the triangles
 * within a number of rings around inverted ones. The rings double from round to round, and patches
 * that touch become one. */
#include "map/compatible/overlay_patches.h"

#include "base/sets.h"
#include "map/compatible/patch_overlays.h"

#include <string.h>

/* Rings of the first round. */
enum { FIRST_RINGS = 2 };

static const uint32_t NONE = UINT32_MAX;

typedef struct rings {
    const iccp_plmap *map;
    uint8_t *is_near;   /* of each vertex: within the rings */
    uint32_t *patch_of; /* of each triangle: its patch, or NONE */
    uint32_t *leader;   /* of each triangle, to tell patches apart */
    size_t n_patches;
} rings;

static icc_status reserve(rings *p, const iccp_plmap *map, const iccp_memory *memory)
{
    const size_t n_triangles = map->corners.n_triangles;
    *p = (rings){.map = map,
                 .is_near = iccp_alloc(memory, map->n_vertices, 1),
                 .patch_of = iccp_alloc(memory, n_triangles, sizeof *p->patch_of),
                 .leader = iccp_alloc(memory, n_triangles, sizeof *p->leader)};
    return p->is_near != NULL && p->patch_of != NULL && p->leader != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

static void release(rings *p, const iccp_memory *memory)
{
    iccp_free(memory, p->is_near);
    iccp_free(memory, p->patch_of);
    iccp_free(memory, p->leader);
}

static void mark_corners(rings *p, size_t t)
{
    for (size_t k = 0; k < 3; ++k)
        p->is_near[p->map->corners.vertex[3 * t + k]] = 1;
}

/* Adds the next ring. Then patch_of is 0 for triangles within the rings before this one or touching
 * them, and NONE for others. */
static void add_ring(rings *p)
{
    const uint32_t *const v = p->map->corners.vertex;
    const size_t n = p->map->corners.n_triangles;
    for (size_t t = 0; t < n; ++t)
        p->patch_of[t] =
            p->is_near[v[3 * t]] || p->is_near[v[3 * t + 1]] || p->is_near[v[3 * t + 2]] ? 0 : NONE;
    for (size_t t = 0; t < n; ++t)
        if (p->patch_of[t] == 0)
            mark_corners(p, t);
}

static void enclose(rings *p, size_t n_rings)
{
    memset(p->is_near, 0, p->map->n_vertices);
    for (uint32_t t = 0; t < p->map->corners.n_triangles; ++t)
        if (!iccp_plmap_positive_image(p->map, t))
            mark_corners(p, t);
    for (size_t k = 0; k < n_rings; ++k)
        add_ring(p);
}

/* Numbers the patches. Triangles that share an edge are in one patch. */
static void tell_apart(rings *p)
{
    const iccp_corners *const corners = &p->map->corners;
    uint32_t *const leader = p->leader;
    const uint32_t n = (uint32_t)corners->n_triangles;
    iccp_sets_begin(leader, n);
    for (uint32_t c = 0; c < 3 * n; ++c) {
        const uint32_t twin = corners->twin[c];
        if (twin != ICCP_NO_NEIGHBOUR && p->patch_of[c / 3] == 0 && p->patch_of[twin / 3] == 0)
            (void)iccp_sets_join(leader, c / 3, twin / 3);
    }
    p->n_patches = 0;
    /* The least triangle leads, so its patch has a number before any other of its triangles. */
    for (uint32_t t = 0; t < n; ++t)
        if (p->patch_of[t] != NONE)
            p->patch_of[t] = leader[t] == t ? (uint32_t)p->n_patches++
                                            : p->patch_of[iccp_sets_leader(leader, t)];
}

/* Makes one round. *fits: whether the borders have at most `most` corners. */
static icc_status overlay_round(iccp_plmap *map, size_t n_rings, size_t most, bool *fits,
                                iccp_work *work, const iccp_env *env)
{
    rings p;
    icc_status status = reserve(&p, map, &env->memory);
    if (status == ICC_OK) {
        enclose(&p, n_rings);
        tell_apart(&p);
        status = iccp_overlay_triangles(map, p.n_patches, p.patch_of, most, fits, work, env);
    }
    release(&p, &env->memory);
    return status;
}

icc_status iccp_overlay_patches(iccp_plmap *map, size_t most, iccp_work *work, size_t *n_left,
                                const iccp_env *env)
{
    icc_status status = ICC_OK;
    bool fits = true;
    *n_left = iccp_plmap_count_inverted(map);
    for (size_t n_rings = FIRST_RINGS;
         status == ICC_OK && fits && *n_left > 0 && n_rings <= map->corners.n_triangles;
         n_rings *= 2) {
        status = overlay_round(map, n_rings, most, &fits, work, env);
        *n_left = iccp_plmap_count_inverted(map);
    }
    return status;
}
