/* Cuts long edges. Cutting triangles at their longest edges keeps their shapes: M.-C. Rivara,
 * Algorithms for refining triangular grids suitable for adaptive and multigrid techniques, 1984. An
 * edge is cut if it is the longest of both its triangles. Otherwise the search goes on across the
 * longest edge. */
#include "map/compatible/density.h"

/* The bound on edges starts at FIRST_BOUND times the wanted length, and each next bound is FALL
 * times the one before. */
static const double FIRST_BOUND = 16, FALL = 0.85;

static double length2(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t *v = map->corners.vertex;
    return iccp_plmap_length2(map, v[iccp_after(corner)], v[iccp_before(corner)]);
}

static uint32_t longest_of(const iccp_plmap *map, uint32_t triangle)
{
    uint32_t best = 3 * triangle;
    for (uint32_t c = best + 1; c < 3 * triangle + 3; ++c)
        if (length2(map, c) > length2(map, best))
            best = c;
    return best;
}

/* Goes from a triangle to the one across its longest edge, as long as edges grow and may be cut.
 * Returns the corner that faces the last edge. */
static uint32_t end_of_way(const iccp_plmap *map, uint32_t triangle)
{
    uint32_t corner = longest_of(map, triangle);
    for (;;) {
        const uint32_t twin = map->corners.twin[corner];
        if (twin == ICCP_NO_NEIGHBOUR)
            return corner;
        const uint32_t next = longest_of(map, twin / 3);
        if (!(length2(map, next) > length2(map, corner)) || !iccp_plmap_may_cut(map, next))
            return corner;
        corner = next;
    }
}

icc_status iccp_limit_edges(iccp_plmap *map, double longest, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (uint32_t t = 0; status == ICC_OK && t < map->corners.n_triangles; ++t) {
        bool done = true;
        while (status == ICC_OK && done && length2(map, longest_of(map, t)) > longest * longest)
            status = iccp_plmap_cut(map, end_of_way(map, t), &done);
        if (status == ICC_OK && t % 4096 == 0)
            status = iccp_progress(env, "mesh", (double)t / (double)map->corners.n_triangles);
    }
    return status;
}

icc_status iccp_refine_longest(iccp_plmap *map, double longest, size_t enough, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (double times = FIRST_BOUND;
         status == ICC_OK && times >= 1 && map->corners.n_triangles < enough; times *= FALL)
        status = iccp_limit_edges(map, times * longest, env);
    return status;
}
