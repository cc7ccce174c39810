#include "map/higher/relocate.h"

#include "base/minmax.h"
#include "map/energy/untangling.h"
#include "map/higher/star_energy.h"
#include "math/inverse.h"
#include "math/vec.h"

#include <float.h>
#include <string.h>

/* The most sweeps of untangling. A box of 3 x 2 x 2 x 1 cells, turned by 1 radian, takes 4. */
enum { SWEEPS = 100 };

/* Returns true if all simplices of the star are positive, exactly. */
static bool is_star_positive(const iccp_star *star)
{
    for (size_t i = 0; i < star->n; ++i)
        if (!iccp_simplicial_is_positive(star->map, star->simplex[i]))
            return false;
    return true;
}

/* Computes the Newton step. Returns false if it does not lead down. */
static bool find_step(size_t dim, const iccp_star_local *local, double *step)
{
    double inverse[ICC_MAX_DIM * ICC_MAX_DIM], determinant;
    if (!iccp_invert(dim, local->hessian, inverse, &determinant))
        return false;
    for (size_t r = 0; r < dim; ++r)
        step[r] = -iccp_vec_dot(dim, inverse + dim * r, local->gradient);
    const double slope = iccp_vec_dot(dim, step, local->gradient);
    return slope < 0 && slope > -HUGE_VAL;
}

/* Moves one vertex by a Newton step, or by a half, a quarter, .. of it. */
static void move(const iccp_star *star)
{
    const size_t dim = star->map->dim;
    double *image = star->map->images + dim * star->vertex;
    double step[ICC_MAX_DIM], before[ICC_MAX_DIM];
    iccp_star_local local;
    const double energy = iccp_star_energy(star, &local);
    if (!(energy < HUGE_VAL) || !find_step(dim, &local, step))
        return;
    memcpy(before, image, dim * sizeof *before);
    for (double share = 1; share * share > DBL_EPSILON; share *= 0.5) {
        for (size_t k = 0; k < dim; ++k)
            image[k] = before[k] + share * step[k];
        iccp_simplicial_round(dim, image);
        if (iccp_star_energy(star, NULL) < energy && (star->epsilon > 0 || is_star_positive(star)))
            return;
    }
    memcpy(image, before, dim * sizeof *before);
}

static void sweep(const iccp_simplicial_map *map, const iccp_stars *stars, double epsilon,
                  double edge)
{
    for (size_t v = 0; v < stars->n_vertices; ++v) {
        const iccp_star star = {.map = map,
                                .vertex = (uint32_t)(stars->first_vertex + v),
                                .n = stars->first[v + 1] - stars->first[v],
                                .simplex = stars->simplex + stars->first[v],
                                .epsilon = epsilon,
                                .edge = edge};
        move(&star);
    }
}

icc_status iccp_relocate_untangle(const iccp_simplicial_map *map, const iccp_stars *stars,
                                  double edge, iccp_work *work, size_t *n_left, const iccp_env *env)
{
    double epsilon = HUGE_VAL;
    *n_left = iccp_simplicial_count_at_once(map, env);
    for (size_t k = 0; *n_left > 0 && k < SWEEPS; ++k) {
        if (iccp_progress(env, "repair", (double)k / SWEEPS) != ICC_OK)
            return ICC_ERR_CANCELLED;
        if (!iccp_work_take(work, map->n_simplices))
            return ICC_OK;
        epsilon = iccp_min(epsilon, iccp_untangling_start(iccp_least_determinant(map, edge)));
        sweep(map, stars, epsilon, edge);
        *n_left = iccp_simplicial_count_at_once(map, env);
    }
    return ICC_OK;
}

icc_status iccp_relocate_improve(const iccp_simplicial_map *map, const iccp_stars *stars,
                                 const iccp_descent *descent, iccp_work *work,
                                 iccp_improvement *improvement, const iccp_env *env)
{
    double energy = iccp_simplicial_energy_at_once(map, env);
    improvement->energy = energy;
    for (size_t k = 0; k < descent->iterations && stars->n_vertices > 0; ++k) {
        if (iccp_progress(env, "improve", (double)k / (double)descent->iterations) != ICC_OK)
            return ICC_ERR_CANCELLED;
        if (!iccp_work_take(work, map->n_simplices))
            return ICC_OK;
        sweep(map, stars, 0, 0);
        ++improvement->n_iterations;
        energy = iccp_simplicial_energy_at_once(map, env);
        const double gain = improvement->energy - energy;
        improvement->energy = energy;
        if (!(gain > descent->tolerance * energy))
            return ICC_OK;
    }
    return ICC_OK;
}
