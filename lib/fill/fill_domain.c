/* Fills a surface in stages. All vertices are inserted into a box, nearly Delaunay. The surface's
 * edges and then its facets are recovered. The outside is removed. Points on the surface are
 * lifted. The inside is refined and improved. Finally the result is checked like any mesh. A
 * failure is reported with its place; a wrong mesh is never returned. */
#include "fill/fill_domain.h"

#include "base/error.h"
#include "base/minmax.h"
#include "domain/features.h"
#include "domain/mesh_domain.h"
#include "domain/solid_mesh.h"
#include "fill/carve.h"
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

/* Keeps the vertices that belong to facets, lines and points. The others are copies of one of
 * them. */
static size_t keep_used(uint32_t *order, size_t n, const icc_domain *surface, uint32_t *seen)
{
    const iccp_features *const features = surface->features;
    const size_t n_facets = features == NULL ? surface->n_facets : features->n_places;
    size_t n_used = 0;
    for (size_t i = 0; i < 3 * n_facets; ++i)
        seen[surface->facets[i]] = 1;
    for (size_t i = 0; features != NULL && i < features->n; ++i)
        for (uint32_t v = 0; v < features->item[i].n; ++v)
            seen[features->item[i].first + v] = 1;
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

/* Arrays of the finished mesh. Points have new numbers, without the box and unused points. */
typedef struct finished {
    const iccp_memory *memory;
    uint32_t *number, *corners; /* by point of the mesh under construction; 4 by tetrahedron */
    double *points;
    size_t n_points, n_tets;
} finished;

static void free_finished(finished *f)
{
    iccp_free(f->memory, f->number);
    iccp_free(f->memory, f->corners);
    iccp_free(f->memory, f->points);
}

/* Fills in the arrays. With features, the points are local ones, otherwise the caller's. Returns
 * false if there is no memory. */
static bool collect(finished *f, const iccp_tets *m, const icc_domain *surface)
{
    const iccp_points *const p = &m->points;
    f->n_tets = m->n_alive;
    f->number = iccp_alloc(f->memory, p->n, sizeof *f->number);
    f->corners = iccp_alloc(f->memory, f->n_tets, 4 * sizeof *f->corners);
    f->points = iccp_alloc(f->memory, p->n, 3 * sizeof *f->points);
    if (f->number == NULL || f->corners == NULL || f->points == NULL)
        return false;
    for (uint32_t v = 0; v < p->n; ++v) {
        double *const x = f->points + 3 * f->n_points;
        if (v >= p->n_given && m->tet_of[v] == ICCP_NO_TET)
            continue;
        if (surface->features != NULL)
            memcpy(x, iccp_point(p, v), 3 * sizeof *x);
        else if (v < p->n_given)
            iccp_domain_given(surface, v, x);
        else
            iccp_frame_out(&surface->frame, 3, iccp_point(p, v), x);
        f->number[v] = (uint32_t)f->n_points++;
    }
    size_t n = 0;
    for (uint32_t t = 0; t < m->n_tets; ++t)
        for (int i = 0; i < 4 && iccp_tet_alive(m, t); ++i)
            f->corners[n++] = f->number[m->tet[t].v[i]];
    return true;
}

/* Makes a mesh of the arrays and of the points on lines, which it takes over. Returns NULL if there
 * is no memory. */
static iccp_simplices *take(finished *f, iccp_constraints *s)
{
    iccp_simplices *const mesh = iccp_alloc_zero(f->memory, 1, sizeof *mesh);
    if (mesh == NULL)
        return NULL;
    for (size_t k = 0; k < s->n_on_lines; ++k)
        s->on_line[k].point = f->number[s->on_line[k].point];
    *mesh = (iccp_simplices){.memory = *f->memory,
                             .dim = 3,
                             .n_points = f->n_points,
                             .points = f->points,
                             .n_simplices = f->n_tets,
                             .corners = f->corners,
                             .on_line = s->on_line,
                             .n_on_lines = s->n_on_lines};
    f->points = NULL;
    f->corners = NULL;
    s->on_line = NULL;
    return mesh;
}

/* Makes the mesh a domain. Frees what is not needed any more as soon as possible. */
static icc_status finish(icc_domain **out, iccp_tets *m, iccp_constraints *s,
                         const icc_domain *surface, const iccp_env *env, icc_error *err)
{
    finished f = {.memory = &env->memory};
    icc_status status = collect(&f, m, surface) ? ICC_OK : iccp_fail_memory(err);
    if (status == ICC_OK) {
        iccp_tets_free(m);
        iccp_tets_init(m, &env->memory);
    }
    if (status == ICC_OK && surface->features != NULL) {
        iccp_simplices *const mesh = take(&f, s);
        status = mesh == NULL ? iccp_fail_memory(err)
                              : iccp_domain_create_solid_mesh(out, surface, mesh, env, err);
    } else if (status == ICC_OK) {
        const icc_mesh mesh = {.dim = 3,
                               .n_vertices = f.n_points,
                               .vertices = f.points,
                               .n_cells = f.n_tets,
                               .cells = f.corners};
        iccp_constraints_free(s);
        status = iccp_domain_create_mesh(out, &mesh, surface->n_facets, surface->facets, env, err);
    }
    free_finished(&f);
    return status;
}

/* The stages, for which the costs below are listed. */
enum { INSERT, SEGMENTS, FACETS, LIFT, CLEAN_UP, REFINE, IMPROVE, CHECK, N_STAGES };
static const double cost[N_STAGES] = {10, 5, 5, 5, 15, 30, 20, 10};

static icc_status make(iccp_tets *m, iccp_constraints *s, const icc_domain *surface,
                       const iccp_fill_options *options, const iccp_env *stage, icc_error *err)
{
    icc_status status = add_points(m, surface, err);
    if (status == ICC_OK)
        status = make_box(m, err);
    if (status == ICC_OK)
        status = insert_vertices(m, surface, &stage[INSERT], err);
    if (status == ICC_OK)
        status = iccp_constraints_create(s, surface, &stage[SEGMENTS], err);
    if (status == ICC_OK && s->n_lines > 0)
        status = iccp_recover_lines(m, s, &stage[SEGMENTS], err);
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
    const bool refine = options->ratio < HUGE_VAL;
    const uint64_t n = m->points.n;
    const uint64_t most =
        options->max_points < UINT64_MAX - n ? n + options->max_points : UINT64_MAX;
    if (status == ICC_OK && refine)
        status = iccp_tets_refine(m, s, options, &stage[REFINE], err);
    if (status == ICC_OK)
        status = iccp_tets_improve(m, !options->for_map, refine ? most : 0, &stage[IMPROVE], err);
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
        iccp_constraints s = {.memory = env->memory};
        s.edges.memory = env->memory;
        iccp_tets_init(&m, &env->memory);
        m.attempt = k;
        iccp_split(stage, N_STAGES, cost, k == 0 ? env : &attempt);
        status = make(&m, &s, surface, options, stage, err);
        if (m.no_memory)
            status = iccp_fail_memory(err);
        if (status == ICC_OK)
            status = finish(out, &m, &s, surface, &stage[CHECK], err);
        iccp_constraints_free(&s);
        iccp_tets_free(&m);
    }
    return status;
}

icc_status iccp_domain_fill_for_map(icc_domain **out, const icc_domain *surface,
                                    const iccp_env *env, icc_error *err)
{
    static const iccp_fill_options options = {ICCP_FILL_RATIO, UINT64_MAX, true};
    return iccp_domain_fill(out, surface, &options, env, err);
}
