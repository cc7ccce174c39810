/* Prepares a mesh for the elastic model: weights, springs, outlines and the plan of Newton's
 * method. */
#include "fit/elastic/elastic_model.h"

#include "base/threads.h"
#include "fit/elastic/elastic_parts.h"
#include "math/elementary.h"
#include "mesh/corners.h"

#include <math.h>
#include <string.h>

/* Stiffness of springs as a multiple of what the mesh itself puts up against a motion of the
 * vertex. A held vertex then lags behind by about the reciprocal. */
static const double STIFF = 1e6;

/* Rows in one part of the assembly. */
enum { PART_ROWS = 1024 };

static iccp_simplicial_map view_of(const iccp_elastic *s, size_t n_elements,
                                   const uint32_t *corners, double *images)
{
    return (iccp_simplicial_map){.dim = 2,
                                 .n_points = s->n_points,
                                 .n_simplices = n_elements,
                                 .corners = corners,
                                 .points = s->points,
                                 .images = images,
                                 .stretch = 1};
}

iccp_simplicial_map iccp_elastic_view(const iccp_elastic_state *state)
{
    return view_of(state->as, state->as->n_triangles, state->as->corners, state->images);
}

/* ---- the plan ---- */

static icc_status analyse(iccp_elastic_plan *plan, const iccp_elastic *s, const iccp_env *env)
{
    const size_t n = plan->first_touch + plan->n_touches;
    const size_t n_threads = env->threads > 1 ? (size_t)env->threads : 1;
    const iccp_simplicial_map view = view_of(s, n, plan->corners, NULL);
    icc_status status = iccp_assembly_create(&plan->assembly, &view, NULL, env);
    if (status != ICC_OK)
        return status;
    const iccp_symmetric hessian = iccp_assembly_hessian(&plan->assembly);
    status = iccp_ldlt_analyse(&plan->factor, &hessian, 2, env);
    if (status != ICC_OK)
        return status;
    const size_t n_parts =
        iccp_has_threads(env) ? n_threads * (2 * s->n_points / (PART_ROWS * n_threads) + 1) : 1;
    status = iccp_assembly_divide(&plan->assembly, plan->factor.position, n_parts, env);
    if (status == ICC_OK)
        iccp_reach_find(&s->reach, &plan->assembly, plan->place);
    return status;
}

/* Lists the corners of triangles, links and pairs. */
static void fill_plan(iccp_elastic_plan *plan, const iccp_elastic *s, const iccp_touch *touch)
{
    uint32_t *corners = plan->corners + 3 * plan->first_touch;
    memcpy(plan->corners, s->corners, 3 * s->n_triangles * sizeof *corners);
    if (s->reach.n_links > 0)
        memcpy(plan->corners + 3 * s->n_triangles, s->reach.links,
               3 * s->reach.n_links * sizeof *corners);
    for (size_t k = 0; k < plan->n_touches; ++k) {
        const uint32_t corner[3] = {touch[k].a, touch[k].b, touch[k].p};
        plan->touch[k] = touch[k];
        memcpy(corners + 3 * k, corner, sizeof corner);
    }
}

icc_status iccp_elastic_plan_create(iccp_elastic_plan *plan, const iccp_elastic *elastic,
                                    size_t n_touches, const iccp_touch *touch, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const iccp_reach *reach = &elastic->reach;
    const size_t n_entries = reach->factor > 0 ? reach->gram.first[elastic->n_points] : 0;
    *plan = (iccp_elastic_plan){.n_touches = n_touches};
    plan->first_touch = elastic->n_triangles + reach->n_links;
    plan->assembly.memory = plan->factor.memory = *memory;
    plan->corners = iccp_alloc(memory, plan->first_touch + n_touches, 3 * sizeof *plan->corners);
    plan->touch = iccp_alloc(memory, n_touches, sizeof *plan->touch);
    plan->place = iccp_alloc(memory, n_entries, sizeof *plan->place);
    icc_status status = ICC_ERR_MEMORY;
    if (plan->corners != NULL && plan->touch != NULL && plan->place != NULL) {
        fill_plan(plan, elastic, touch);
        status = analyse(plan, elastic, env);
    }
    if (status != ICC_OK)
        iccp_elastic_plan_free(plan, memory);
    return status;
}

void iccp_elastic_plan_free(iccp_elastic_plan *plan, const iccp_memory *memory)
{
    iccp_free(memory, plan->corners);
    iccp_free(memory, plan->touch);
    iccp_free(memory, plan->place);
    iccp_assembly_free(&plan->assembly);
    iccp_ldlt_free(&plan->factor);
    *plan = (iccp_elastic_plan){.assembly.memory = *memory, .factor.memory = *memory};
}

/* ---- the mesh ---- */

static icc_status allocate(iccp_elastic *s, const iccp_elastic_input *input)
{
    const iccp_memory *memory = &s->memory;
    s->points = iccp_alloc(memory, s->n_points, 2 * sizeof *s->points);
    s->corners = iccp_alloc(memory, s->n_triangles, 3 * sizeof *s->corners);
    s->hold = iccp_alloc(memory, s->n_points, sizeof *s->hold);
    s->axis = iccp_alloc(memory, s->n_points, 2 * sizeof *s->axis);
    s->element = iccp_alloc(memory, s->n_triangles, ICCP_ELEMENT(2) * sizeof *s->element);
    s->spring = iccp_alloc_zero(memory, s->n_points, sizeof *s->spring);
    if (s->points == NULL || s->corners == NULL || s->hold == NULL || s->axis == NULL ||
        s->element == NULL || s->spring == NULL)
        return ICC_ERR_MEMORY;
    memcpy(s->points, input->points, 2 * s->n_points * sizeof *s->points);
    memcpy(s->corners, input->corners, 3 * s->n_triangles * sizeof *s->corners);
    memcpy(s->hold, input->hold, s->n_points * sizeof *s->hold);
    return ICC_OK;
}

static void set_axes(iccp_elastic *s, const double *direction)
{
    for (uint32_t v = 0; v < s->n_points; ++v) {
        double *axis = s->axis + 2 * (size_t)v;
        axis[0] = 1;
        axis[1] = 0;
        if (s->hold[v] != ICCP_SLIDING)
            continue;
        const double *d = direction + 2 * (size_t)v, length = iccp_hypot(d[0], d[1]);
        axis[0] = d[0] / length;
        axis[1] = d[1] / length;
    }
}

/* Weighs a triangle by its area times (area / mean area)^-power times the caller's factor. Scaling
 * the mesh then scales all weights alike. */
static void set_weights(iccp_elastic *s, const iccp_elastic_input *input)
{
    const iccp_simplicial_map view = view_of(s, s->n_triangles, s->corners, NULL);
    double area = 0;
    for (size_t t = 0; t < s->n_triangles; ++t) {
        double *element = s->element + ICCP_ELEMENT(2) * t;
        iccp_simplicial_element(&view, t, element);
        area += element[0];
    }
    s->weight = 0;
    for (size_t t = 0; t < s->n_triangles; ++t) {
        double *element = s->element + ICCP_ELEMENT(2) * t;
        const double share = element[0] / (area / (double)s->n_triangles);
        if (input->stiffness > 0)
            element[0] /= iccp_pow(share, input->stiffness);
        if (input->cell_factor != NULL)
            element[0] *= input->cell_factor[t];
        s->weight += element[0];
    }
}

/* The springs of told vertices: the sum of w |grad|^2 over the triangles of each, and what bending
 * adds. */
static void set_springs(iccp_elastic *s)
{
    for (size_t c = 0; c < 3 * s->n_triangles; ++c) {
        const double *element = s->element + ICCP_ELEMENT(2) * (c / 3);
        const double *g = element + 1 + 2 * (c % 3);
        s->spring[s->corners[c]] += STIFF * element[0] * (g[0] * g[0] + g[1] * g[1]);
    }
    for (size_t v = 0; s->reach.factor > 0 && v < s->n_points; ++v)
        s->spring[v] += STIFF * s->reach.factor * s->reach.gram.diagonal[v];
}

/* Finds the rings of the boundary, and the bending matrix. */
static icc_status find_outlines(iccp_elastic *s, double reach, const iccp_env *env)
{
    iccp_corners corners = {.vertex = s->corners, .n_triangles = s->n_mesh};
    uint32_t *next = iccp_alloc(&s->memory, s->n_points, sizeof *next);
    bool is_manifold = false;
    corners.twin = iccp_alloc(&s->memory, s->n_mesh, 3 * sizeof *corners.twin);
    icc_status status = ICC_ERR_MEMORY;
    if (next != NULL && corners.twin != NULL)
        status = iccp_find_twins(&corners, s->n_points, &is_manifold, env);
    if (status == ICC_OK && (!is_manifold || !iccp_link_boundary(&corners, s->n_points, next)))
        status = ICC_ERR_BOUNDARY;
    if (status == ICC_OK)
        status = iccp_outlines_create(&s->outlines, s->n_points, next, &s->memory);
    if (status == ICC_OK)
        status = iccp_reach_create(&s->reach, reach, s->n_points, s->points, s->n_mesh, s->corners,
                                   corners.twin, env);
    iccp_free(&s->memory, next);
    iccp_free(&s->memory, corners.twin);
    return status;
}

static icc_status set_up(iccp_elastic *s, const iccp_elastic_input *input, const iccp_env *env)
{
    icc_status status = allocate(s, input);
    if (status != ICC_OK)
        return status;
    set_axes(s, input->direction);
    set_weights(s, input);
    status = find_outlines(s, input->reach, env);
    if (status == ICC_OK)
        set_springs(s);
    s->shape =
        (iccp_contact_shape){.outlines = &s->outlines, .points = s->points, .fixed = s->hold};
    if (status == ICC_OK && s->contact)
        status = iccp_contact_measure(&s->shape, s->weight / (double)s->n_triangles, env);
    if (status == ICC_OK)
        status = iccp_elastic_plan_create(&s->plan, s, 0, NULL, env);
    return status;
}

icc_status iccp_elastic_create(iccp_elastic **out, const iccp_elastic_input *input,
                               const iccp_env *env)
{
    iccp_elastic *s = *out = iccp_alloc_zero(&env->memory, 1, sizeof *s);
    if (s == NULL)
        return ICC_ERR_MEMORY;
    const iccp_env quiet = iccp_quiet(env);
    s->memory = s->plan.assembly.memory = s->plan.factor.memory = s->outlines.memory =
        s->reach.memory = s->reach.gram.memory = env->memory;
    s->n_points = input->n_points;
    s->n_triangles = input->n_triangles;
    s->n_mesh = input->n_triangles - input->n_more;
    s->contact = input->contact;
    const icc_status status = set_up(s, input, &quiet);
    if (status != ICC_OK) {
        iccp_elastic_free(s);
        *out = NULL;
    }
    return status;
}

void iccp_elastic_free(iccp_elastic *elastic)
{
    iccp_elastic *s = elastic;
    if (s == NULL)
        return;
    const iccp_memory memory = s->memory;
    iccp_elastic_plan_free(&s->plan, &memory);
    iccp_outlines_free(&s->outlines);
    iccp_reach_free(&s->reach);
    iccp_free(&memory, s->points);
    iccp_free(&memory, s->corners);
    iccp_free(&memory, s->hold);
    iccp_free(&memory, s->axis);
    iccp_free(&memory, s->element);
    iccp_free(&memory, s->spring);
    iccp_free(&memory, s);
}
