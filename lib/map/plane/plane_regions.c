/* The mesh of a map follows the network of its source. So each face of the network is filled with
 * triangles, and those at its sides tell the region. */
#include "map/plane/plane_regions.h"

#include "domain/network_regions.h"

static const uint32_t NONE = UINT32_MAX;

/* Gives the region of its first triangle to all others that no side divides from it. */
static void fill_face(uint32_t *regions, uint32_t *queue, const iccp_plmap *map, uint32_t first)
{
    size_t n = 0;
    queue[n++] = first;
    for (size_t done = 0; done < n; ++done)
        for (uint32_t c = 3 * queue[done]; c < 3 * queue[done] + 3; ++c) {
            const uint32_t twin = map->corners.twin[c];
            if (twin == ICCP_NO_NEIGHBOUR || regions[twin / 3] != NONE ||
                iccp_plmap_is_line(map, c))
                continue;
            regions[twin / 3] = regions[first];
            queue[n++] = twin / 3;
        }
}

/* `region`: of the half-sides of the network. */
static void fill_faces(uint32_t *regions, uint32_t *queue, const iccp_plmap *map,
                       const uint32_t *region)
{
    for (size_t t = 0; t < map->corners.n_triangles; ++t)
        regions[t] = NONE;
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c) {
        uint32_t facet;
        double from, to;
        if (regions[c / 3] != NONE ||
            !iccp_plmap_on_line(map, map->corners.vertex[iccp_after(c)],
                                map->corners.vertex[iccp_before(c)], &facet, &from, &to))
            continue;
        regions[c / 3] = region[2 * facet + (from > to)];
        fill_face(regions, queue, map, c / 3);
    }
}

icc_status iccp_plmap_find_regions(uint32_t *regions, const iccp_plmap *map,
                                   const iccp_memory *memory)
{
    const size_t n_triangles = map->corners.n_triangles;
    if (map->featured == NULL || map->featured->features->n_regions == 0) {
        for (size_t t = 0; t < n_triangles; ++t)
            regions[t] = 0;
        return ICC_OK;
    }
    uint32_t *queue = iccp_alloc(memory, n_triangles, sizeof *queue);
    uint32_t *region = iccp_alloc(memory, map->featured->features->n_places, 2 * sizeof *region);
    icc_status status = ICC_ERR_MEMORY;
    if (queue != NULL && region != NULL)
        status = iccp_network_find_regions(region, map->featured, memory);
    if (status == ICC_OK)
        fill_faces(regions, queue, map, region);
    iccp_free(memory, queue);
    iccp_free(memory, region);
    return status;
}
