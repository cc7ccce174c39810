/* Computes steps by the projected Newton method: J. Smith, S. Schaefer, Bijective parameterization
 * with free boundaries, 2015. A sparse factorisation computes the step in the plane, conjugate
 * gradients in space. */
#include "map/energy/newton.h"

#include "base/minmax.h"
#include "map/energy/dirichlet.h"
#include "map/energy/model.h"
#include "map/energy/newton_parts.h"
#include "map/energy/truncated_cg.h"

#include <math.h>
#include <string.h>

/* Conjugate gradients end at this residual. The finer one is used if one simplex has most of the
 * energy, because then nearly all of the step serves that simplex. */
static const double RESIDUAL = 1e-2, FINE_RESIDUAL = 1e-3;

/* ---- set-up ---- */

static icc_status find_elements(void *argument, size_t begin, size_t end)
{
    const iccp_newton *s = argument;
    const size_t size = ICCP_ELEMENT(s->map.dim);
    for (size_t e = begin; e < end; ++e)
        iccp_simplicial_element(&s->map, s->assembly.simplex[e], s->element + size * e);
    return ICC_OK;
}

/* Two tasks that run at the same time. They share only the pattern. */
static icc_status begin_side(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    iccp_newton *s = argument;
    (void)err;
    if (k == 0)
        return iccp_newton_order(&s->assembly, &s->factor, env);
    (void)find_elements(s, 0, s->assembly.n_elements);
    iccp_newton_sum_ahead(s, s->ahead);
    return ICC_OK;
}

/* In the plane, finding the order of elimination takes one thread longer than the first Hessian. So
 * other threads compute that Hessian meanwhile, if its energy is known. Otherwise the sums get
 * their room last, when the rows are short and what served the order is freed. */
static icc_status begin(iccp_newton *s, const iccp_energy *first, bool has_order,
                        const iccp_env *env)
{
    const size_t n = s->assembly.n_elements;
    s->is_ahead = first != NULL && !has_order && s->map.dim == 2 && n > ICCP_NEWTON_GRAIN &&
                  iccp_has_threads(env);
    icc_status status = s->is_ahead ? iccp_assembly_make_room(&s->assembly) : ICC_OK;
    if (status == ICC_OK && s->is_ahead) {
        s->ahead = *first;
        status = iccp_side_by_side(env, 2, begin_side, s, NULL);
    } else if (status == ICC_OK) {
        status = iccp_for_chunks(&s->threads, "improve", n, ICCP_NEWTON_GRAIN, find_elements, s);
        if (status == ICC_OK && !has_order && s->map.dim == 2)
            status = iccp_newton_order(&s->assembly, &s->factor, env);
    }
    if (status == ICC_OK && !has_order && s->map.dim == 2)
        status = iccp_newton_divide(&s->assembly, &s->factor, env);
    return status == ICC_OK ? iccp_assembly_make_room(&s->assembly) : status;
}

icc_status iccp_newton_create(iccp_newton *newton, const iccp_simplicial_map *map,
                              const uint8_t *movable, const iccp_energy *first, const iccp_env *env)
{
    iccp_newton *s = newton;
    *s = (iccp_newton){.map = *map, .threads = *env};
    s->threads.progress = NULL;
    const iccp_newton_plan *plan = map->plan;
    if (plan != NULL && (movable != NULL || !iccp_newton_plan_fits(plan, map)))
        plan = NULL;
    icc_status status = plan != NULL
                            ? iccp_assembly_share(&s->assembly, &plan->assembly, map, &env->memory)
                            : iccp_assembly_create(&s->assembly, map, movable, env);
    if (status != ICC_OK)
        return status;
    const iccp_memory *memory = &s->assembly.memory;
    const size_t n = map->dim * s->assembly.n_free, size = ICCP_ELEMENT(map->dim);
    const size_t n_work = map->dim == 2 ? 1 : ICCP_TRUNCATED_CG_WORK;
    s->factor.memory = env->memory;
    s->element = iccp_alloc(memory, s->assembly.n_elements, size * sizeof *s->element);
    s->step = iccp_alloc(memory, n, sizeof *s->step);
    s->saved = iccp_alloc(memory, n, sizeof *s->saved);
    s->work = iccp_alloc(memory, n, n_work * sizeof *s->work);
    const bool has_terms = map->dim == 3 || iccp_has_threads(env);
    const bool has_locals = map->dim == 3 && iccp_has_threads(env);
    if (has_terms)
        s->term = iccp_alloc(memory, s->assembly.n_elements, sizeof *s->term);
    if (has_locals)
        s->local = iccp_alloc(memory, ICCP_NEWTON_WAITING, sizeof *s->local);
    if (s->element == NULL || s->step == NULL || s->saved == NULL || s->work == NULL ||
        (has_terms && s->term == NULL) || (has_locals && s->local == NULL))
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK && plan != NULL)
        iccp_ldlt_share(&s->factor, &plan->factor, &env->memory);
    if (status == ICC_OK)
        status = begin(s, first, plan != NULL, env);
    if (status != ICC_OK)
        iccp_newton_free(s);
    return status;
}

static bool fits(const iccp_newton *s, const iccp_simplicial_map *map, const uint8_t *movable)
{
    if (s->element == NULL || s->map.corners != map->corners || s->map.points != map->points)
        return false;
    bool fits = s->map.n_points == map->n_points && s->map.n_simplices == map->n_simplices;
    for (uint32_t v = 0; fits && v < map->n_points; ++v)
        fits = (s->assembly.slot[v] != UINT32_MAX) ==
               (!iccp_simplicial_is_fixed(map, v) && (movable == NULL || movable[v]));
    return fits;
}

icc_status iccp_newton_prepare(iccp_newton *newton, const iccp_simplicial_map *map,
                               const uint8_t *movable, const iccp_energy *first,
                               const iccp_env *env)
{
    if (!fits(newton, map, movable)) {
        iccp_newton_free(newton);
        return iccp_newton_create(newton, map, movable, first, env);
    }
    newton->map = *map;
    newton->is_ahead = false;
    return ICC_OK;
}

void iccp_newton_free(iccp_newton *newton)
{
    iccp_newton *s = newton;
    const iccp_memory memory = s->assembly.memory;
    iccp_free(&memory, s->element);
    iccp_free(&memory, s->step);
    iccp_free(&memory, s->saved);
    iccp_free(&memory, s->work);
    iccp_free(&memory, s->term);
    iccp_free(&memory, s->local);
    iccp_ldlt_free(&s->factor);
    iccp_assembly_free(&s->assembly);
    *s = (iccp_newton){.assembly.memory = memory};
}

/* ---- the step ---- */

/* Takes from the step what rounding adds across rails. */
static void stay_on_rails(iccp_newton *s)
{
    for (size_t i = 0; i < s->assembly.n_free; ++i) {
        const double *r = iccp_newton_rail(&s->map, s->assembly.free_point[i]);
        double *step = s->step + 2 * i;
        const double along = r != NULL ? r[0] * step[0] + r[1] * step[1] : 0;
        for (size_t d = 0; r != NULL && d < 2; ++d)
            step[d] = along * r[d];
    }
}

static icc_status solve_directly(iccp_newton *s, const iccp_symmetric *hessian, const iccp_env *env)
{
    const icc_status status = iccp_ldlt_factorise(&s->factor, hessian, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < hessian->n; ++i)
        s->step[i] = -s->assembly.gradient[i];
    iccp_ldlt_solve_at_once(&s->factor, 1, s->step, s->work, &s->threads);
    if (s->map.rail != NULL)
        stay_on_rails(s);
    return ICC_OK;
}

/* Used in space. */
static icc_status solve_by_directions(iccp_newton *s, const iccp_symmetric *hessian,
                                      iccp_energy energy, const iccp_env *env)
{
    const bool untangles = energy == ICCP_UNTANGLE,
               is_fine = !untangles && iccp_newton_has_worst(s);
    return iccp_truncated_cg(hessian, s->assembly.gradient, s->step,
                             is_fine ? FINE_RESIDUAL : RESIDUAL, s->work,
                             untangles ? "repair" : "improve", env);
}

icc_status iccp_newton_solve(iccp_newton *newton, iccp_energy energy, double epsilon, double *slope,
                             const iccp_env *env)
{
    iccp_newton *s = newton;
    const double *gradient = s->assembly.gradient;
    iccp_newton_sum(s, energy, epsilon);
    const iccp_symmetric hessian = iccp_assembly_hessian(&s->assembly);
    const icc_status status = s->map.dim == 2 ? solve_directly(s, &hessian, env)
                                              : solve_by_directions(s, &hessian, energy, env);
    if (status != ICC_OK)
        return status;
    *slope = 0;
    for (size_t i = 0; i < hessian.n; ++i)
        *slope += gradient[i] * s->step[i];
    return s->map.dim == 3 || *slope <= 0 ? ICC_OK : ICC_ERR_SOLVER;
}

/* Adds the pull that the motion of an element's fixed corners exerts on its free corners. */
static void add_pull(iccp_newton *s, size_t e, const double *motion, double *pull)
{
    const size_t dim = s->map.dim, n = dim * (dim + 1);
    const uint32_t *v = s->map.corners + (dim + 1) * (size_t)s->assembly.simplex[e];
    const double *image[4], *element = iccp_newton_images(dim, s, e, image);
    double moved[12], most = 0;
    iccp_local local;
    for (size_t k = 0; k <= dim; ++k)
        for (size_t d = 0; d < dim; ++d) {
            const bool is_free = s->assembly.slot[v[k]] != UINT32_MAX;
            moved[dim * k + d] = is_free ? 0 : motion[dim * (size_t)v[k] + d];
            most = iccp_max(most, fabs(moved[dim * k + d]));
        }
    if (!(most > 0))
        return;
    iccp_dirichlet_local(dim, element, image, false, &local);
    if (s->map.model != NULL)
        iccp_model_add(dim, &s->map, s->assembly.simplex[e], element, &local);
    for (size_t i = 0; i < n; ++i) {
        const uint32_t slot = s->assembly.slot[v[i / dim]];
        for (size_t k = 0; k < n && slot != UINT32_MAX; ++k)
            pull[dim * (size_t)slot + i % dim] -= local.hessian[n * i + k] * moved[k];
    }
}

/* Copies the free points' values to an array of all points. */
static void hand_out(const iccp_newton *s, const double *free_points, double *all)
{
    const size_t dim = s->map.dim;
    for (size_t i = 0; i < s->assembly.n_free; ++i)
        memcpy(all + dim * (size_t)s->assembly.free_point[i], free_points + dim * i,
               dim * sizeof *all);
}

/* Computes both answers with one factorisation. */
static icc_status answer_and_rest(iccp_newton *s, const iccp_symmetric *hessian, double *motion,
                                  double *rest, const iccp_env *env)
{
    double *const answer[2] = {s->saved, s->step}, *const to[2] = {motion, rest};
    const icc_status status = iccp_ldlt_factorise(&s->factor, hessian, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < hessian->n; ++i)
        s->step[i] = -s->assembly.gradient[i];
    memset(rest, 0, 2 * s->map.n_points * sizeof *rest);
    for (int k = 0; k < 2; ++k) {
        iccp_ldlt_solve(&s->factor, 1, answer[k], s->work);
        hand_out(s, answer[k], to[k]);
    }
    return ICC_OK;
}

icc_status iccp_newton_answer(iccp_newton *newton, double *motion, double *rest,
                              const iccp_env *env)
{
    iccp_newton *s = newton;
    iccp_newton_sum(s, ICCP_DIRICHLET, 0);
    const iccp_symmetric hessian = iccp_assembly_hessian(&s->assembly);
    memset(s->saved, 0, hessian.n * sizeof *s->saved);
    for (size_t e = 0; e < s->assembly.n_elements; ++e)
        add_pull(s, e, motion, s->saved);
    if (s->map.dim == 2)
        return answer_and_rest(s, &hessian, motion, rest, env);
    for (size_t i = 0; i < hessian.n; ++i)
        s->assembly.gradient[i] -= s->saved[i];
    const icc_status status = solve_by_directions(s, &hessian, ICCP_DIRICHLET, env);
    if (status == ICC_OK)
        hand_out(s, s->step, motion);
    return status;
}
