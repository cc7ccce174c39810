/* Finds the patches of a map, and cuts them out one by one. Patches are the connected components of
 * the movable points, where two corners of one triangle are connected. They are found with disjoint
 * sets (base/sets.h). */
#include "map/energy/patches.h"

#include "base/sets.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

static bool is_movable(const iccp_patches *s, uint32_t point)
{
    return s->movable[point] && !iccp_simplicial_is_fixed(s->map, point);
}

/* Returns the first movable corner of a triangle, or NONE. */
static uint32_t handle_of(const iccp_patches *s, size_t triangle)
{
    const uint32_t *v = s->map->corners + 3 * triangle;
    for (int k = 0; k < 3; ++k)
        if (is_movable(s, v[k]))
            return v[k];
    return NONE;
}

/* Joins the movable corners of each triangle. */
static void join(iccp_patches *s, uint32_t *leader)
{
    iccp_sets_begin(leader, s->map->n_points);
    for (size_t t = 0; t < s->map->n_simplices; ++t) {
        const uint32_t *v = s->map->corners + 3 * t, handle = handle_of(s, t);
        for (int k = 0; k < 3 && handle != NONE; ++k)
            if (is_movable(s, v[k]))
                (void)iccp_sets_join(leader, handle, v[k]);
    }
}

/* Numbers the patches in the order of their first triangles, then lists the triangles patch by
 * patch. Returns the number of triangles in the largest patch. */
static size_t sort(iccp_patches *s, uint32_t *leader)
{
    uint32_t *const patch = s->local;
    const size_t n = s->map->n_simplices;
    size_t most = 0;
    memset(patch, 0xff, s->map->n_points * sizeof *patch);
    for (size_t t = 0; t < n; ++t) {
        const uint32_t handle = handle_of(s, t);
        if (handle == NONE)
            continue;
        uint32_t *const own = &patch[iccp_sets_leader(leader, handle)];
        if (*own == NONE)
            *own = (uint32_t)s->n++;
        ++s->first[*own + 2];
    }
    for (size_t p = 0; p < s->n; ++p) {
        most = s->first[p + 2] > most ? s->first[p + 2] : most;
        s->first[p + 2] += s->first[p + 1];
    }
    for (size_t t = 0; t < n; ++t) {
        const uint32_t handle = handle_of(s, t);
        if (handle != NONE)
            s->triangle[s->first[patch[iccp_sets_leader(leader, handle)] + 1]++] = (uint32_t)t;
    }
    return most;
}

static icc_status make_room(iccp_patches *s, size_t n_triangles)
{
    s->corners = iccp_alloc(&s->memory, 3 * n_triangles, sizeof *s->corners);
    s->point = iccp_alloc(&s->memory, 3 * n_triangles, sizeof *s->point);
    s->points = iccp_alloc(&s->memory, 6 * n_triangles, sizeof *s->points);
    s->images = iccp_alloc(&s->memory, 6 * n_triangles, sizeof *s->images);
    s->fixed = iccp_alloc(&s->memory, 3 * n_triangles, sizeof *s->fixed);
    return s->corners != NULL && s->point != NULL && s->points != NULL && s->images != NULL &&
                   s->fixed != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

icc_status iccp_patches_create(iccp_patches *patches, const iccp_simplicial_map *map,
                               const uint8_t *movable, const iccp_memory *memory)
{
    iccp_patches *s = patches;
    *s = (iccp_patches){.memory = *memory, .map = map, .movable = movable};
    uint32_t *leader = iccp_alloc(memory, map->n_points, sizeof *leader);
    s->local = iccp_alloc(memory, map->n_points, sizeof *s->local);
    s->first = iccp_alloc_zero(memory, map->n_points + 2, sizeof *s->first);
    s->triangle = iccp_alloc(memory, map->n_simplices, sizeof *s->triangle);
    icc_status status = ICC_ERR_MEMORY;
    if (leader != NULL && s->local != NULL && s->first != NULL && s->triangle != NULL) {
        join(s, leader);
        status = make_room(s, sort(s, leader));
        memset(s->local, 0xff, map->n_points * sizeof *s->local);
    }
    iccp_free(memory, leader);
    if (status != ICC_OK)
        iccp_patches_free(s);
    return status;
}

void iccp_patches_free(iccp_patches *patches)
{
    iccp_patches *s = patches;
    const iccp_memory memory = s->memory;
    iccp_free(&memory, s->first);
    iccp_free(&memory, s->triangle);
    iccp_free(&memory, s->local);
    iccp_free(&memory, s->corners);
    iccp_free(&memory, s->point);
    iccp_free(&memory, s->points);
    iccp_free(&memory, s->images);
    iccp_free(&memory, s->fixed);
    *s = (iccp_patches){.memory = memory};
}

iccp_simplicial_map iccp_patches_cut_out(iccp_patches *patches, size_t p)
{
    iccp_patches *s = patches;
    const iccp_simplicial_map *map = s->map;
    const size_t n = s->first[p + 1] - s->first[p];
    size_t n_points = 0;
    for (size_t c = 0; c < 3 * n; ++c) {
        const uint32_t v = map->corners[3 * s->triangle[s->first[p] + c / 3] + c % 3];
        if (s->local[v] == NONE) {
            memcpy(s->points + 2 * n_points, map->points + 2 * (size_t)v, 2 * sizeof(double));
            memcpy(s->images + 2 * n_points, map->images + 2 * (size_t)v, 2 * sizeof(double));
            s->fixed[n_points] = !is_movable(s, v);
            s->point[n_points] = v;
            s->local[v] = (uint32_t)n_points++;
        }
        s->corners[c] = s->local[v];
    }
    for (size_t v = 0; v < n_points; ++v)
        s->local[s->point[v]] = NONE;
    return (iccp_simplicial_map){.dim = 2,
                                 .n_points = n_points,
                                 .n_simplices = n,
                                 .corners = s->corners,
                                 .points = s->points,
                                 .images = s->images,
                                 .fixed = s->fixed,
                                 .stretch = map->stretch};
}

void iccp_patches_put_back(const iccp_patches *patches, const iccp_simplicial_map *part)
{
    for (size_t v = 0; v < part->n_points; ++v)
        if (!part->fixed[v])
            memcpy(patches->map->images + 2 * (size_t)patches->point[v], part->images + 2 * v,
                   2 * sizeof(double));
}
