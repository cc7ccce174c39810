/* Fills a surface in stages. All vertices are inserted into a box, nearly Delaunay. The surface's
 * edges and then its facets are recovered. The outside is removed. Points on the surface are
 * lifted. The inside is refined and improved. Finally the result is checked like any mesh. A
 * failure is reported with its place; a wrong mesh is never returned. */
#include "fill/fill_domain.h"

#include "base/error.h"
#include "base/minmax.h"
#include "domain/mesh_domain.h"
#include "fill/facets.h"
#include "fill/inner_points.h"
#include "fill/insert.h"
#include "fill/lift.h"
#include "fill/reshape.h"
#include "fill/segments.h"
#include "mesh/insertion_order.h"

#include <string.h>

/* Adds the surface's vertices and the corners of a box at some distance from them. Of all these
 * corners, no five lie on a sphere, and no plane through four contains many others. */
static icc_status add_points(iccp_tets *m, const icc_domain *surface, icc_error *err)
{
    double middle[3], width = 0.0;
    m->points.frame = &surface->frame;
    for (size_t v = 0; v < surface->n_vertices; ++v)
        if (iccp_tets_add_point(m, surface->vertices + 3 * v) == ICCP_NO_TET)
            return iccp_fail_memory(err);
    for (int k = 0; k < 3; ++k) {
        middle[k] = 0.5 * (surface->lower[k] + surface->upper[k]);
        width = iccp_max(width, surface->upper[k] - surface->lower[k]);
    }
    m->points.n_given = surface->n_vertices;
    if (m->attempt >= ICCP_ORDERS)
        iccp_metric_make(&m->metric, m->points.n, m->points.x);
    for (int i = 0; i < 8; ++i) {
        static const double stretch[3] = {1.01, 1.03, 1.07};
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = middle[k] + ((i >> k & 1) != 0 ? 1.0 : -1.0) * width * stretch[k];
        if (iccp_tets_add_point(m, x) == ICCP_NO_TET)
            return iccp_fail_memory(err);
    }
    m->points.n_fixed = m->points.n;
    return ICC_OK;
}

/* Makes six tetrahedra around the diagonal from corner 0 to corner 7. */
static icc_status make_box(iccp_tets *m, icc_error *err)
{
    static const uint8_t corner[6][4] = {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7},
                                         {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}};
    const uint32_t first = (uint32_t)m->points.n_given;
    if (!iccp_tets_reserve(m, 6) || !iccp_list_reserve(m, &m->work, 24))
        return iccp_fail_memory(err);
    m->work.n = 0;
    for (int i = 0; i < 6; ++i) {
        const uint8_t *const c = corner[i];
        const uint32_t t = iccp_tets_new(m, first + c[0], first + c[1], first + c[2], first + c[3]);
        for (uint32_t k = 0; k < 4; ++k)
            m->work.item[m->work.n++] = 4 * t + k;
    }
    iccp_tets_match(m, m->work.n, m->work.item);
    return ICC_OK;
}

/* Keeps the vertices that belong to facets. The others are copies of one of them. */
static size_t keep_used(uint32_t *order, size_t n, const icc_domain *surface, uint32_t *seen)
{
    size_t n_used = 0;
    for (size_t i = 0; i < 3 * surface->n_facets; ++i)
        seen[surface->facets[i]] = 1;
    for (size_t i = 0; i < n; ++i)
        if (seen[order[i]] != 0)
            order[n_used++] = order[i];
    for (size_t i = 0; i < n; ++i)
        seen[i] = 0;
    return n_used;
}

static icc_status insert_vertices(iccp_tets *m, const icc_domain *surface, const iccp_env *env,
                                  icc_error *err)
{
    const size_t n = m->points.n_given;
    uint32_t *order = iccp_alloc(&env->memory, n, sizeof *order);
    icc_status status = order == NULL
                            ? ICC_ERR_MEMORY
                            : iccp_insertion_order(order, n, 3, m->points.x, &env->memory);
    iccp_explain(err, status);
    if (status == ICC_OK)
        status = iccp_tets_insert_all(m, keep_used(order, n, surface, m->seen), order, env, err);
    iccp_free(&env->memory, order);
    return status;
}

/* Converts the mesh to the caller's coordinates and makes it a domain. Frees its parts as soon as
 * possible. */
static icc_status finish(icc_domain **out, iccp_tets *m, iccp_surface *s, const icc_domain *surface,
                         const iccp_env *env, icc_error *err)
{
    const iccp_points *const p = &m->points;
    const size_t n_tets = m->n_alive;
    uint32_t *number = iccp_alloc(&env->memory, p->n, sizeof *number);
    uint32_t *corners = iccp_alloc(&env->memory, m->n_alive, 4 * sizeof *corners);
    double *given = iccp_alloc(&env->memory, p->n, 3 * sizeof *given);
    icc_status status = ICC_ERR_MEMORY;
    if (number != NULL && corners != NULL && given != NULL) {
        uint32_t n = 0;
        size_t n_corners = 0;
        for (uint32_t v = 0; v < p->n; ++v) {
            if (v >= p->n_given && m->tet_of[v] == ICCP_NO_TET)
                continue;
            if (v < p->n_given)
                iccp_domain_given(surface, v, given + 3 * (size_t)n);
            else
                iccp_frame_out(&surface->frame, 3, iccp_point(p, v), given + 3 * (size_t)n);
            number[v] = n++;
        }
        for (uint32_t t = 0; t < m->n_tets; ++t)
            for (int i = 0; i < 4 && iccp_tet_alive(m, t); ++i)
                corners[n_corners++] = number[m->tet[t].v[i]];
        iccp_tets_free(m);
        iccp_tets_init(m, &env->memory);
        iccp_surface_free(s);
        iccp_free(&env->memory, number);
        number = NULL;
        status = iccp_domain_create_mesh(out, 3, n, given, n_tets, corners, surface->n_facets,
                                         surface->facets, env, err);
    } else {
        iccp_fail_memory(err);
    }
    iccp_free(&env->memory, number);
    iccp_free(&env->memory, corners);
    iccp_free(&env->memory, given);
    return status;
}

/* The stages, for which the costs below are listed. */
enum { INSERT, SEGMENTS, FACETS, LIFT, CLEAN_UP, REFINE, IMPROVE, CHECK, N_STAGES };
static const double cost[N_STAGES] = {10, 5, 5, 5, 15, 30, 20, 10};

static icc_status make(iccp_tets *m, iccp_surface *s, const icc_domain *surface,
                       const iccp_fill_options *options, const iccp_env *stage, icc_error *err)
{
    icc_status status = add_points(m, surface, err);
    if (status == ICC_OK)
        status = make_box(m, err);
    if (status == ICC_OK)
        status = insert_vertices(m, surface, &stage[INSERT], err);
    if (status == ICC_OK)
        status = iccp_surface_create(s, surface->n_vertices, surface->n_facets, surface->facets,
                                     &stage[SEGMENTS], err);
    if (status == ICC_OK)
        status = iccp_recover_segments(m, s, &stage[SEGMENTS], err);
    if (status == ICC_OK)
        status = iccp_recover_facets(m, s, &stage[FACETS], err);
    if (status == ICC_OK)
        status = iccp_carve(m, s, &stage[FACETS], err);
    if (status == ICC_OK)
        status = iccp_lift(m, s, &stage[LIFT], err);
    m->points.n_dyadic = 0; /* all are doubles now */
    m->metric.on = false;
    if (status == ICC_OK)
        status = iccp_tets_clean_up(m, &stage[CLEAN_UP], err);
    if (status == ICC_OK && options->ratio < HUGE_VAL)
        status = iccp_tets_refine(m, s, options->ratio, options->max_points, &stage[REFINE], err);
    if (status == ICC_OK)
        status = iccp_tets_improve(m, &stage[IMPROVE], err);
    return status;
}

/* A different insertion order may avoid the obstacle, so a refused surface is tried in several
 * orders. If all of them fail, they are tried again in a metric in which the surface is not
 * stretched. */
icc_status iccp_domain_fill(icc_domain **out, const icc_domain *surface,
                            const iccp_fill_options *options, const iccp_env *env, icc_error *err)
{
    enum { MOST_ATTEMPTS = 2 * ICCP_ORDERS };
    iccp_env stage[N_STAGES];
    icc_status status = ICC_ERR_RESOLUTION;
    *out = NULL;
    for (uint32_t k = 0; k < MOST_ATTEMPTS && status == ICC_ERR_RESOLUTION; ++k) {
        const iccp_env attempt = iccp_round(env, k, 1.0);
        iccp_tets m;
        iccp_surface s = {.memory = env->memory};
        s.edges.memory = env->memory;
        iccp_tets_init(&m, &env->memory);
        m.attempt = k;
        iccp_split(stage, N_STAGES, cost, k == 0 ? env : &attempt);
        status = make(&m, &s, surface, options, stage, err);
        if (m.no_memory)
            status = iccp_fail_memory(err);
        if (status == ICC_OK)
            status = finish(out, &m, &s, surface, &stage[CHECK], err);
        iccp_surface_free(&s);
        iccp_tets_free(&m);
    }
    return status;
}
