/* Makes inverted simplices positive by Newton steps on the untangling energy: V. Garanzha et al.,
 * Foldover-free maps in 50 lines of code, 2021. Patches around the inverted simplices move first.
 * They grow from round to round (docs/theory/plane-maps.md). */
#include "map/energy/untangle.h"

#include "base/minmax.h"
#include "map/energy/newton.h"
#include "map/energy/patches.h"
#include "map/energy/untangling.h"

#include <math.h>
#include <string.h>

/* One round: how many rings of neighbours around inverted simplices may move (0: all), the most
 * steps, and after how many steps without fewer inverted simplices the round ends.
 *
 * In space, a start may have little to do with the map. Then many steps go by before epsilon is
 * small enough to have an effect. If few places stay inverted after that, patches mend them more
 * often than not. */
typedef struct patches {
    int rings, steps, patience;
} patches;

static const patches PLANE[] = {{2, 60, 15}, {5, 60, 15}, {12, 60, 15}, {0, 60, 15}};
static const patches SPACE[] = {{2, 60, 15}, {5, 60, 15}, {12, 60, 15}, {0, 150, 40},
                                {2, 60, 15}, {5, 60, 15}, {12, 60, 15}};

/* Patches are not used in space if more than one tetrahedron in MANY is inverted. They would cost
 * more than moving all points at once, and leave the inverted tetrahedra beside them in worse
 * places. */
enum { MANY = 20 };

/* Epsilon's lower bound falls by at least this share in each step. Garanzha et al. use 0.1 with a
 * slower method. Newton's needs few steps for each epsilon. */
static const double SLOWEST = 0.3;

/* Reports of progress take this many steps for half of a round. */
static const double TYPICAL_STEPS = 10;

/* Whether a simplex is inverted and can be mended. In space, one with only fixed corners cannot. */
static bool is_task(const iccp_simplicial_map *map, size_t simplex)
{
    return (map->dim == 2 || iccp_simplicial_is_free(map, simplex)) &&
           !iccp_simplicial_is_positive(map, simplex);
}

static size_t count_tasks(const iccp_simplicial_map *map)
{
    size_t n = 0;
    for (size_t s = 0; s < map->n_simplices; ++s)
        n += is_task(map, s);
    return n;
}

/* Marks the points that may move, ring by ring: the corners of inverted simplices first, then those
 * of simplices that touch the last ring. */
static void mark_patches(const iccp_simplicial_map *map, int rings, uint8_t *marks)
{
    const size_t n = map->dim + 1;
    memset(marks, 0, map->n_points);
    for (size_t s = 0; s < map->n_simplices; ++s)
        if (is_task(map, s))
            for (size_t k = 0; k < n; ++k)
                marks[map->corners[n * s + k]] = 1;
    for (int ring = 1; ring < rings; ++ring)
        for (size_t s = 0; s < map->n_simplices; ++s) {
            const uint32_t *v = map->corners + n * s;
            bool touches = false;
            for (size_t k = 0; k < n; ++k)
                touches |= marks[v[k]] == ring;
            for (size_t k = 0; touches && k < n; ++k)
                if (marks[v[k]] == 0)
                    marks[v[k]] = (uint8_t)(ring + 1);
        }
}

/* Takes Newton steps, each with a smaller epsilon. The faster the energy fell, the faster epsilon
 * goes to zero (Garanzha et al.). */
static icc_status descend(iccp_newton *newton, const patches *round, iccp_work *work,
                          const iccp_env *env)
{
    size_t n_bad, fewest;
    int since = 0;
    icc_status status = ICC_OK;
    double least = iccp_newton_least(newton, &n_bad);
    double epsilon = iccp_untangling_start(least);
    fewest = n_bad;
    for (int k = 0; k < round->steps && since < round->patience && newton->assembly.n_free > 0 &&
                    iccp_work_take(work, newton->assembly.n_elements);
         ++k) {
        double slope;
        const double before = iccp_newton_energy(newton, ICCP_UNTANGLE, epsilon);
        const iccp_env part = iccp_round(env, (size_t)k, TYPICAL_STEPS);
        status = iccp_progress(&part, "repair", 0);
        if (status == ICC_OK)
            status = iccp_newton_solve(newton, ICCP_UNTANGLE, epsilon, &slope, &part);
        if (status != ICC_OK)
            break;
        const double after = iccp_newton_move(newton, ICCP_UNTANGLE, epsilon, before, slope);
        least = iccp_newton_least(newton, &n_bad);
        since = n_bad < fewest ? 0 : since + 1;
        fewest = n_bad < fewest ? n_bad : fewest;
        if (least > 0 && after >= 0.99 * before)
            break;
        epsilon = iccp_untangling_next(epsilon, least, iccp_max(1 - after / before, SLOWEST));
    }
    return status == ICC_ERR_SOLVER ? ICC_OK : status;
}

/* Moves the points with movable[v] != 0, or all if `movable` is NULL. */
static icc_status untangle_at_once(const iccp_simplicial_map *map, const uint8_t *movable,
                                   const patches *round, iccp_work *work, const iccp_env *env)
{
    iccp_newton newton;
    icc_status status = iccp_newton_create(&newton, map, movable, NULL, env);
    if (status != ICC_OK)
        return status;
    status = descend(&newton, round, work, env);
    iccp_newton_free(&newton);
    return status;
}

/* Untangles each patch by itself. Its epsilon suits its own worst triangle, and it costs nothing
 * more once it is positive. */
static icc_status untangle_one_by_one(const iccp_simplicial_map *map, const uint8_t *movable,
                                      const patches *round, iccp_work *work, const iccp_env *env)
{
    iccp_patches parts;
    icc_status status = iccp_patches_create(&parts, map, movable, &env->memory);
    for (size_t p = 0; status == ICC_OK && p < parts.n; ++p) {
        const iccp_env own = iccp_round(env, p, (double)parts.n);
        const iccp_simplicial_map part = iccp_patches_cut_out(&parts, p);
        if (count_tasks(&part) > 0)
            status = untangle_at_once(&part, NULL, round, work, &own);
        iccp_patches_put_back(&parts, &part);
    }
    iccp_patches_free(&parts);
    return status;
}

/* Makes one round. `marks` has a byte for each point. */
static icc_status untangle_round(const iccp_simplicial_map *map, const patches *round,
                                 uint8_t *marks, iccp_work *work, const iccp_env *env)
{
    if (round->rings == 0)
        return untangle_at_once(map, NULL, round, work, env);
    mark_patches(map, round->rings, marks);
    return map->dim == 2 ? untangle_one_by_one(map, marks, round, work, env)
                         : untangle_at_once(map, marks, round, work, env);
}

icc_status iccp_untangle(const iccp_simplicial_map *map, iccp_work *work, size_t *n_left,
                         const iccp_env *env)
{
    const patches *rounds = map->dim == 2 ? PLANE : SPACE;
    const size_t n = map->dim == 2 ? sizeof PLANE / sizeof *PLANE : sizeof SPACE / sizeof *SPACE;
    uint8_t *marks = iccp_alloc(&env->memory, map->n_points, 1);
    icc_status status = marks != NULL ? ICC_OK : ICC_ERR_MEMORY;
    size_t n_tasks = count_tasks(map);
    for (size_t k = 0; status == ICC_OK && n_tasks > 0 && k < n; ++k) {
        if (map->dim == 3 && SPACE[k].rings > 0 && n_tasks > map->n_simplices / MANY)
            continue;
        const iccp_env part = iccp_round(env, k, 1);
        status = untangle_round(map, &rounds[k], marks, work, &part);
        n_tasks = count_tasks(map);
    }
    *n_left = iccp_simplicial_count_inverted(map);
    iccp_free(&env->memory, marks);
    return status;
}
