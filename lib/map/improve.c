/* docs/theory.md, the mesh map; energies and their derivatives: map/dirichlet.c. */
#include "map/improve.h"

#include "base/sort.h"
#include "map/dirichlet.h"
#include "map/movable.h"
#include "map/newton.h"
#include "math/vec.h"

/* First steps with SLIM's model, which gets far from a bad start; then Newton's, which
 * converges. */
enum { MAJORISED_STEPS = 3 };

/* Shares of progress: half of a descent, and half of all descents. */
static const double TYPICAL_STEPS = 8, TYPICAL_LEVELS = 2;

/* A refinement cuts the triangles that carry this share of the energy above an isometry's, but no
 * more than this share of all. */
static const double EXCESS_SHARE = 0.7, MOST_CUT = 0.2;

/* A refinement is the last when it gains less than this. */
static const double LEAST_GAIN = 0.01;

icc_status iccp_improve_images(const iccp_simplicial_map *map, size_t majorised, size_t iterations,
                               double tolerance, iccp_improvement *improvement, const iccp_env *env)
{
    iccp_newton newton;
    iccp_env part = iccp_round(env, 0, TYPICAL_STEPS);
    uint8_t *movable;
    icc_status status = iccp_movable_create(&movable, map, env);
    if (status == ICC_OK)
        status = iccp_newton_create(&newton, map, movable, &part);
    iccp_free(&env->memory, movable);
    if (status != ICC_OK)
        return status;
    const size_t n_free = newton.assembly.n_free;
    double energy = iccp_newton_energy(&newton, ICCP_DIRICHLET, 0);
    for (size_t k = 0; status == ICC_OK && k < iterations && n_free > 0; ++k) {
        const iccp_energy model = k < majorised ? ICCP_DIRICHLET_MAJORISED : ICCP_DIRICHLET;
        double slope;
        part = iccp_round(env, k + 1, TYPICAL_STEPS);
        status = iccp_progress(&part, "improve", 0);
        if (status == ICC_OK)
            status = iccp_newton_solve(&newton, model, 0, &slope, &part);
        if (status != ICC_OK)
            break;
        const double after = iccp_newton_move(&newton, model, 0, energy, slope);
        const double gain = energy - after;
        energy = after;
        ++improvement->n_iterations;
        if (k >= majorised && gain <= tolerance * energy)
            break;
    }
    iccp_newton_free(&newton);
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

/* Steps at one level. */
static icc_status descend(iccp_plmap *map, size_t majorised, size_t iterations, double tolerance,
                          iccp_improvement *improvement, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    const icc_status status =
        iccp_improve_images(&simplicial, majorised, iterations, tolerance, improvement, env);
    improvement->energy = iccp_simplicial_energy(&simplicial);
    return status;
}

typedef struct ranked {
    double excess;
    uint32_t triangle;
} ranked;

static int by_excess(const void *a, const void *b)
{
    const ranked *p = a, *q = b;
    if (p->excess < q->excess || p->excess > q->excess)
        return p->excess < q->excess ? 1 : -1;
    return (p->triangle > q->triangle) - (p->triangle < q->triangle);
}

/* The corner that faces the edge which is longest, before and after the map taken together. */
static uint32_t longest_edge(const iccp_plmap *map, uint32_t triangle)
{
    uint32_t best = 3 * triangle;
    double length = -1;
    for (uint32_t c = 3 * triangle; c < 3 * triangle + 3; ++c) {
        const uint32_t a = iccp_after(c), b = iccp_before(c);
        const double own =
            map->stretch * map->stretch *
                iccp_vec_distance2(2, iccp_plmap_point(map, a), iccp_plmap_point(map, b)) +
            iccp_vec_distance2(2, iccp_plmap_image(map, a), iccp_plmap_image(map, b));
        if (own > length) {
            length = own;
            best = c;
        }
    }
    return best;
}

/* Cuts the triangles that carry most of the excess energy. */
static icc_status refine(iccp_plmap *map, size_t *n_cut, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    const size_t n = map->corners.n_triangles;
    ranked *list = iccp_alloc(&env->memory, n, sizeof *list);
    double excess = 0, reached = 0;
    icc_status status = ICC_OK;
    *n_cut = 0;
    if (list == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t t = 0; t < n; ++t) {
        const double *image[3];
        double element[ICCP_ELEMENT(2)];
        iccp_simplicial_images(2, &simplicial, t, image);
        iccp_simplicial_element(&simplicial, t, element);
        list[t] = (ranked){iccp_dirichlet_energy(2, element, image) - 4 * element[0], t};
        excess += list[t].excess;
    }
    iccp_sort(list, n, sizeof *list, by_excess);
    for (size_t k = 0; status == ICC_OK && k < n && (double)k < MOST_CUT * (double)n &&
                       reached < EXCESS_SHARE * excess;
         ++k) {
        bool done;
        reached += list[k].excess;
        status = iccp_plmap_cut(map, longest_edge(map, list[k].triangle), &done);
        *n_cut += status == ICC_OK && done;
    }
    iccp_free(&env->memory, list);
    return status;
}

icc_status iccp_improve(iccp_plmap *map, size_t iterations, double tolerance, size_t levels,
                        iccp_improvement *improvement, const iccp_env *env)
{
    *improvement = (iccp_improvement){0};
    iccp_env part = iccp_round(env, 0, TYPICAL_LEVELS);
    icc_status status = descend(map, MAJORISED_STEPS, iterations, tolerance, improvement, &part);
    for (size_t level = 0; status == ICC_OK && level < levels; ++level) {
        const double before = improvement->energy;
        size_t n_cut;
        status = refine(map, &n_cut, env);
        if (status != ICC_OK || n_cut == 0)
            break;
        part = iccp_round(env, level + 1, TYPICAL_LEVELS);
        status = descend(map, 0, iterations, tolerance, improvement, &part);
        ++improvement->n_levels;
        if (before - improvement->energy < LEAST_GAIN * before)
            break;
    }
    return status;
}
