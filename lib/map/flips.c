/* C. Lawson, Software for C1 surface interpolation, 1977: an edge is replaced by the other diagonal
 * of its two triangles where that is better; here, where the energy falls. */
#include "map/flips.h"

#include "map/candidate.h"

enum { PASSES = 5 };

/* A flip lowers the energy of its two triangles by this share at least. */
static const double LEAST_FALL = 1e-3;

/* It makes no triangle that is flatter than this and than both that it replaces: Newton's steps
 * would be short. */
static const double LEAST_ROUNDNESS = 0.05;

/* Flipping the edge makes triangles x a y and y b x from x a b and y b a. */
static bool is_better_flipped(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t *v = map->corners.vertex, twin = map->corners.twin[corner];
    if (twin == ICCP_NO_NEIGHBOUR)
        return false;
    const uint32_t x = v[corner], y = v[twin], a = v[iccp_after(corner)],
                   b = v[iccp_before(corner)];
    if ((map->fixed[x] && map->fixed[y]) || !iccp_candidate_is_positive(map, x, a, y) ||
        !iccp_candidate_is_positive(map, y, b, x))
        return false;
    iccp_candidate now = iccp_no_candidate(), then = iccp_no_candidate();
    iccp_candidate_add(&now, map, x, a, b);
    iccp_candidate_add(&now, map, y, b, a);
    iccp_candidate_add(&then, map, x, a, y);
    iccp_candidate_add(&then, map, y, b, x);
    return then.energy < (1 - LEAST_FALL) * now.energy &&
           then.roundness >= iccp_min(now.roundness, LEAST_ROUNDNESS);
}

size_t iccp_flip_edges(iccp_plmap *map)
{
    size_t n = 0, n_before = SIZE_MAX;
    for (int pass = 0; pass < PASSES && n != n_before; ++pass) {
        n_before = n;
        for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
            if (c < map->corners.twin[c] && is_better_flipped(map, c)) {
                iccp_flip_edge(&map->corners, c);
                ++n;
            }
    }
    return n;
}
