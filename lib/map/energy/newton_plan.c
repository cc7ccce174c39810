/* The plan of Newton's method, which is kept from one set of images to the next. */
#include "map/energy/newton_parts.h"

#include <string.h>

/* Rows in one part of the assembly. */
enum { PART_ROWS = 1024 };

icc_status iccp_newton_order(const iccp_assembly *assembly, iccp_ldlt *factor, const iccp_env *env)
{
    const iccp_symmetric hessian = iccp_assembly_hessian(assembly);
    return iccp_ldlt_analyse(factor, &hessian, 2, env);
}

/* Uses one part without threads, because parts would only cost time. */
icc_status iccp_newton_divide(iccp_assembly *assembly, const iccp_ldlt *factor, const iccp_env *env)
{
    const size_t n_threads = env->threads > 1 ? (size_t)env->threads : 1;
    const size_t n_parts =
        iccp_has_threads(env) ? n_threads * (factor->n / (PART_ROWS * n_threads) + 1) : 1;
    return iccp_assembly_divide(assembly, factor->position, n_parts, env);
}

icc_status iccp_newton_plan_create(iccp_newton_plan **out, const iccp_simplicial_map *map,
                                   const iccp_env *env)
{
    iccp_newton_plan *plan = *out = iccp_alloc_zero(&env->memory, 1, sizeof *plan);
    if (plan == NULL)
        return ICC_ERR_MEMORY;
    const size_t n_corners = 3 * map->n_simplices;
    iccp_env alone = *env; /* one search by this thread; the others have other work */
    alone.threads = 1;
    plan->memory = plan->assembly.memory = plan->factor.memory = env->memory;
    atomic_init(&plan->references, 1);
    plan->n_points = map->n_points;
    plan->n_simplices = map->n_simplices;
    plan->corners = iccp_alloc(&env->memory, n_corners, sizeof *plan->corners);
    icc_status status = plan->corners != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        memcpy(plan->corners, map->corners, n_corners * sizeof *plan->corners);
        status = iccp_assembly_create(&plan->assembly, map, NULL, &alone);
    }
    if (status == ICC_OK)
        status = iccp_newton_order(&plan->assembly, &plan->factor, env);
    if (status == ICC_OK)
        status = iccp_newton_divide(&plan->assembly, &plan->factor, env);
    if (status != ICC_OK) {
        iccp_newton_plan_release(plan);
        *out = NULL;
    }
    return status;
}

iccp_newton_plan *iccp_newton_plan_retain(iccp_newton_plan *plan)
{
    if (plan != NULL)
        atomic_fetch_add(&plan->references, 1);
    return plan;
}

void iccp_newton_plan_release(iccp_newton_plan *plan)
{
    if (plan == NULL || atomic_fetch_sub(&plan->references, 1) != 1)
        return;
    iccp_assembly_free(&plan->assembly);
    iccp_ldlt_free(&plan->factor);
    const iccp_memory memory = plan->memory;
    iccp_free(&memory, plan->corners);
    iccp_free(&memory, plan);
}

bool iccp_newton_plan_fits(const iccp_newton_plan *plan, const iccp_simplicial_map *map)
{
    if (map->dim != 2 || plan->n_points != map->n_points || plan->n_simplices != map->n_simplices ||
        memcmp(plan->corners, map->corners, 3 * map->n_simplices * sizeof *plan->corners) != 0)
        return false;
    bool fits = true;
    for (uint32_t v = 0; v < map->n_points; ++v)
        fits &= iccp_simplicial_is_fixed(map, v) == (plan->assembly.slot[v] == UINT32_MAX);
    return fits;
}
