/* Makes a start from an overlay (docs/theory/plane-maps.md).
 *
 * An overlay has a vertex wherever two diagonals cross. So it has far more triangles than it needs,
 * and most of them are slivers that Newton's method can hardly move. Merging vertices leaves few
 * triangles. Then both sides move by turns: the images by the energy of the map, the points by the
 * energy of its inverse. Every state is one-to-one. */
#include "map/compatible/overlay_start.h"

#include "base/minmax.h"
#include "map/compatible/coarsen.h"
#include "map/compatible/compatible.h"
#include "map/compatible/flips.h"
#include "map/compatible/points_and_images.h"
#include "map/energy/untangle.h"

#include <math.h>

/* Rounds end after one that lowers the energy by less than LEAST_GAIN. Reports of progress take
 * TYPICAL_ROUNDS for half of them. */
enum { ROUNDS = 12, TYPICAL_ROUNDS = 2 };
static const double LEAST_GAIN = 0.05;

/* Steps on each side in a round. */
static const iccp_descent DESCENT = {3, 10, 1e-3, 0, false};

/* Makes the overlay of the two cages. */
static icc_status overlay(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                          const iccp_env *env)
{
    const size_t n = source->n_facets;
    uint32_t *pieces = iccp_alloc(&env->memory, n, sizeof *pieces);
    double *images = iccp_alloc(&env->memory, n, 2 * sizeof *images);
    iccp_planar corners = {.memory = env->memory};
    icc_status status = pieces != NULL && images != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t f = 0; status == ICC_OK && f < n; ++f)
        pieces[f] = 1;
    if (status == ICC_OK)
        status = iccp_planar_begin(&corners, source, pieces, 0, 0, env);
    for (uint32_t v = 0; status == ICC_OK && v < n; ++v) {
        const double along = iccp_planar_along(&corners, source, v, 0);
        const double bary[2] = {1 - along, along};
        iccp_domain_facet_point(target, corners.facet[v], bary, images + 2 * (size_t)v);
    }
    if (status == ICC_OK)
        status = iccp_compatible_create(map, &corners, source, images,
                                        sqrt(target->measure / source->measure), env);
    iccp_planar_free(&corners);
    iccp_free(&env->memory, images);
    iccp_free(&env->memory, pieces);
    return status;
}

/* Untangles the triangles that rounding has inverted, on both sides. */
static icc_status mend(iccp_plmap *map, iccp_work *work, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (int side = 0; side < 2; ++side) {
        size_t n_left = iccp_plmap_count_inverted(map);
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
        if (status == ICC_OK && n_left > 0)
            status = iccp_untangle(&simplicial, work, &n_left, env);
        if (status == ICC_OK && n_left > 0)
            status = ICC_ERR_CERTIFICATE;
        iccp_plmap_swap(map);
    }
    return status;
}

icc_status iccp_overlay_round(iccp_plmap *map, iccp_work *work, double *gain, const iccp_env *env)
{
    const double before = iccp_plmap_energy(map);
    size_t n_gone, n_flips;
    iccp_improvement ignored = {0};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    icc_status status = iccp_coarsen(map, ICCP_RISE, &n_gone, &part[0]);
    if (status == ICC_OK)
        status = iccp_flip_edges(map, &n_flips, env);
    if (status == ICC_OK)
        status = iccp_improve_points_and_images(map, &DESCENT, work, &ignored, &part[1]);
    *gain = 1 - iccp_plmap_energy(map) / before;
    return status;
}

icc_status iccp_overlay_relax(iccp_plmap *map, iccp_work *work, const iccp_env *env)
{
    double gain = 1;
    icc_status status = iccp_cut_chords(map);
    for (size_t k = 0; status == ICC_OK && k < ROUNDS && gain >= LEAST_GAIN; ++k) {
        const iccp_env round = iccp_round(env, k, TYPICAL_ROUNDS);
        status = iccp_overlay_round(map, work, &gain, &round);
    }
    return status;
}

icc_status iccp_overlay_start(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                              double most, iccp_work *work, const iccp_env *env)
{
    iccp_work steps = {.left = most};
    iccp_env part[3];
    *map = (iccp_plmap){.memory = env->memory};
    iccp_split(part, 3, (const double[]){1, 1, 2}, env);
    icc_status status = overlay(map, source, target, &part[0]);
    if (status == ICC_OK) {
        iccp_work_charge(work, ICCP_CROSSING_COST * (double)(map->n_vertices - source->n_facets));
        status = mend(map, &steps, &part[1]);
    }
    steps.left = iccp_min(steps.left, work->left - steps.spent);
    if (status == ICC_OK)
        status = iccp_overlay_relax(map, &steps, &part[2]);
    iccp_work_charge(work, steps.spent);
    return status;
}
