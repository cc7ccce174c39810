/* One Newton step with a line search: J. Smith, S. Schaefer, Bijective parameterization with free
 * boundaries, 2015. Instead of a scaffold around the shape, a sweep checks the outlines. */
#include "fit/elastic/elastic_step.h"

#include "base/minmax.h"
#include "fit/elastic/elastic_sums.h"
#include "map/energy/newton.h"

#include <math.h>
#include <string.h>

/* Longest step, as a share of the way to the first flip. */
static const double SHARE_OF_FLIP = 0.9;

/* DECREASE: sufficient decrease (Armijo). A step is halved at most MAX_CUTS times. */
static const double DECREASE = 1e-4;
enum { MAX_CUTS = 40 };

/* A plan has places for pairs up to this multiple of their range, so that it serves several
 * steps. */
static const double REACH_OF_PLAN = 2;

icc_status iccp_elastic_energy(iccp_elastic_state *state, double *energy)
{
    icc_status status = ICC_OK;
    *energy = iccp_elastic_triangles(state) + iccp_elastic_springs(state);
    *energy += iccp_reach_energy(&state->as->reach, state->images);
    if (state->as->contact && *energy < HUGE_VAL) {
        status = iccp_contact_find(&state->contact, state->images, 1);
        if (status == ICC_OK)
            *energy += iccp_contact_energy(&state->contact, state->images);
    }
    return status;
}

bool iccp_elastic_is_valid(const iccp_elastic_state *state, icc_status *status)
{
    const iccp_simplicial_map view = iccp_elastic_view(state);
    *status = ICC_OK;
    if (iccp_simplicial_count_at_once(&view, &state->threads) > 0)
        return false;
    if (state->as->contact)
        *status = iccp_outlines_check(&state->as->outlines, state->images, &state->threads, NULL);
    if (*status != ICC_ERR_BOUNDARY)
        return *status == ICC_OK;
    *status = ICC_OK;
    return false;
}

/* ---- the plan ---- */

/* Returns true if the plan has places for all pairs. Both lists are in the order of the edges. */
static bool suffices(const iccp_elastic_plan *plan, const iccp_contact *contact)
{
    size_t first = 0;
    for (size_t i = 0; i < contact->n; ++i) {
        const iccp_touch *t = &contact->touch[i];
        while (first < plan->n_touches && plan->touch[first].a != t->a)
            ++first;
        size_t k = first;
        while (k < plan->n_touches && plan->touch[k].a == t->a && plan->touch[k].p != t->p)
            ++k;
        if (k == plan->n_touches || plan->touch[k].a != t->a)
            return false;
    }
    return true;
}

/* Makes a new plan if pairs push each other that the present one does not know. */
static icc_status update_plan(iccp_elastic_state *s, const iccp_env *env)
{
    if (!s->as->contact)
        return ICC_OK;
    icc_status status = iccp_contact_find(&s->contact, s->images, 1);
    if (status != ICC_OK || suffices(&s->own, &s->contact))
        return status;
    status = iccp_contact_find(&s->contact, s->images, REACH_OF_PLAN);
    if (status != ICC_OK)
        return status;
    iccp_elastic_plan_free(&s->own, &env->memory);
    status = iccp_elastic_plan_create(&s->own, s->as, s->contact.n, s->contact.touch, env);
    return status == ICC_OK ? iccp_assembly_make_room(&s->own.assembly) : status;
}

/* ---- the step ---- */

/* Computes Newton's step as a motion of all vertices, and the energy's slope along it. */
static icc_status solve(iccp_elastic_state *s, double *slope, const iccp_env *env)
{
    iccp_elastic_sum(s);
    const iccp_symmetric hessian = iccp_assembly_hessian(&s->own.assembly);
    const icc_status status = iccp_ldlt_factorise(&s->own.factor, &hessian, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < hessian.n; ++i)
        s->solution[i] = -s->own.assembly.gradient[i];
    iccp_ldlt_solve_at_once(&s->own.factor, 1, s->solution, s->work, &s->threads);
    *slope = 0;
    for (size_t i = 0; i < hessian.n; ++i)
        *slope += s->own.assembly.gradient[i] * s->solution[i];
    for (uint32_t v = 0; v < s->as->n_points; ++v) {
        double axis[2][2];
        const double *along = s->solution + 2 * (size_t)v;
        for (size_t k = 0; k < 2; ++k)
            iccp_elastic_axis(s->as, v, k, axis[k]);
        for (size_t d = 0; d < 2; ++d)
            s->motion[2 * (size_t)v + d] = along[0] * axis[0][d] + along[1] * axis[1][d];
    }
    return ICC_OK;
}

static void set_images(iccp_elastic_state *s, double length)
{
    for (size_t i = 0; i < 2 * s->as->n_points; ++i)
        s->images[i] = s->saved[i] + length * s->motion[i];
}

/* Finds a length that lowers the energy and keeps the state valid. */
static icc_status search_line(iccp_elastic_state *s, iccp_elastic_move *move)
{
    const iccp_simplicial_map view = iccp_elastic_view(s);
    move->limit = iccp_newton_limit(&view, s->motion);
    move->length = iccp_min(1, SHARE_OF_FLIP * move->limit);
    memcpy(s->saved, s->images, 2 * s->as->n_points * sizeof *s->saved);
    for (int k = 0; k < MAX_CUTS; ++k, move->length *= 0.5) {
        set_images(s, move->length);
        icc_status status = iccp_elastic_energy(s, &move->after);
        if (status == ICC_OK &&
            move->after <= move->before + DECREASE * move->length * move->slope &&
            iccp_elastic_is_valid(s, &status))
            return ICC_OK;
        if (status != ICC_OK)
            return status;
    }
    memcpy(s->images, s->saved, 2 * s->as->n_points * sizeof *s->saved);
    move->after = move->before;
    move->length = 0;
    return ICC_OK;
}

icc_status iccp_elastic_step(iccp_elastic_state *state, iccp_elastic_move *move,
                             const iccp_env *env)
{
    iccp_elastic_state *s = state;
    *move = (iccp_elastic_move){0};
    icc_status status = iccp_progress(env, "improve", 0);
    if (status == ICC_OK)
        status = update_plan(s, env);
    if (status == ICC_OK)
        status = iccp_elastic_energy(s, &move->before);
    if (status == ICC_OK)
        status = solve(s, &move->slope, env);
    ++s->n_iterations;
    move->after = move->before;
    if (status == ICC_ERR_SOLVER || (status == ICC_OK && !(move->slope < 0)))
        return ICC_OK;
    return status == ICC_OK ? search_line(s, move) : status;
}
