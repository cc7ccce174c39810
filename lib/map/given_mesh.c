/* Makes a map from a triangle mesh and the images of its vertices. The boundary of the mesh gives
 * the two domains: its ring that runs counter-clockwise is the outer one, all others are holes. */
#include "map/given_mesh.h"

#include "base/clock.h"
#include "base/error.h"
#include "domain/features.h"
#include "domain/outlines.h"
#include "map/plane/plane_kind.h"

#include <math.h>
#include <string.h>

typedef struct maker {
    const iccp_given_mesh *mesh;
    iccp_corners corners; /* owned */
    iccp_outlines rings;
    size_t outer;          /* the outer ring's number */
    uint32_t *vertex;      /* of each vertex of the domains: its number in the mesh */
    double *places;        /* of the same vertices, on one side */
    icc_feature *features; /* of the domains: holes, then lines and points */
    icc_domain *domains[2];
} maker;

/* ---- the boundary ---- */

static icc_status link_triangles(maker *m, const iccp_env *env, icc_error *err)
{
    const iccp_given_mesh *mesh = m->mesh;
    bool is_manifold = false;
    m->corners.n_triangles = mesh->n_triangles;
    m->corners.vertex = iccp_alloc(&env->memory, mesh->n_triangles, 3 * sizeof(uint32_t));
    m->corners.twin = iccp_alloc(&env->memory, mesh->n_triangles, 3 * sizeof(uint32_t));
    if (m->corners.vertex == NULL || m->corners.twin == NULL)
        return ICC_ERR_MEMORY;
    memcpy(m->corners.vertex, mesh->triangles, 3 * mesh->n_triangles * sizeof(uint32_t));
    const icc_status status = iccp_find_twins(&m->corners, mesh->n_vertices, &is_manifold, env);
    return status != ICC_OK || is_manifold
               ? status
               : iccp_fail(err, ICC_ERR_BOUNDARY,
                           "an edge belongs to two triangles on the same side, or a triangle "
                           "lists a vertex twice");
}

static icc_status find_rings(maker *m, const iccp_env *env, icc_error *err)
{
    uint32_t *next = iccp_alloc(&env->memory, m->mesh->n_vertices, sizeof *next);
    if (next == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_ERR_BOUNDARY;
    if (iccp_link_boundary(&m->corners, m->mesh->n_vertices, next))
        status = iccp_outlines_create(&m->rings, m->mesh->n_vertices, next, &env->memory);
    iccp_free(&env->memory, next);
    return status != ICC_ERR_BOUNDARY
               ? status
               : iccp_fail(err, status, "two parts of the boundary share a vertex");
}

/* Checks that every vertex belongs to a triangle. */
static icc_status check_vertices(const maker *m, const iccp_env *env, icc_error *err)
{
    const iccp_given_mesh *mesh = m->mesh;
    uint8_t *used = iccp_alloc_zero(&env->memory, mesh->n_vertices, 1);
    if (used == NULL)
        return ICC_ERR_MEMORY;
    for (size_t c = 0; c < 3 * mesh->n_triangles; ++c)
        used[mesh->triangles[c]] = 1;
    size_t v = 0;
    while (v < mesh->n_vertices && used[v])
        ++v;
    iccp_free(&env->memory, used);
    return v == mesh->n_vertices ? ICC_OK
                                 : iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)v,
                                                "vertex %zu belongs to no triangle", v);
}

/* Twice the area that a ring encloses, from its first vertex, so that a shape far from the origin
 * is not lost in rounding. */
static double area_of(const maker *m, const iccp_chain *ring)
{
    const uint32_t *v = m->rings.vertex + ring->first;
    const double *p = m->mesh->points, *o = p + 2 * (size_t)v[0];
    double area = 0;
    for (uint32_t k = 1; k + 1 < ring->n; ++k) {
        const double *a = p + 2 * (size_t)v[k], *b = p + 2 * (size_t)v[k + 1];
        area += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
    }
    return area;
}

static void find_outer(maker *m)
{
    double most = -HUGE_VAL;
    for (size_t k = 0; k < m->rings.n; ++k) {
        const double area = area_of(m, &m->rings.ring[k]);
        if (area > most) {
            most = area;
            m->outer = k;
        }
    }
}

/* ---- the domains ---- */

static size_t count_features(const maker *m)
{
    return m->rings.n - 1 + m->mesh->n_features;
}

/* Lists the vertices of the domains: the outer ring, the holes, the features. */
static icc_status list_vertices(maker *m, const iccp_env *env)
{
    size_t n = m->rings.n_points, at = 0, f = 0;
    for (size_t i = 0; i < m->mesh->n_features; ++i)
        n += m->mesh->features[i].n;
    m->vertex = iccp_alloc(&env->memory, n, sizeof *m->vertex);
    m->places = iccp_alloc(&env->memory, n, 2 * sizeof *m->places);
    m->features = iccp_alloc_zero(&env->memory, count_features(m) + 1, sizeof *m->features);
    if (m->vertex == NULL || m->places == NULL || m->features == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k <= m->rings.n; ++k) {
        const size_t r = k == 0 ? m->outer : k - 1;
        if (k > 0 && r == m->outer)
            continue;
        const iccp_chain *ring = &m->rings.ring[r];
        memcpy(m->vertex + at, m->rings.vertex + ring->first, ring->n * sizeof *m->vertex);
        if (k > 0)
            m->features[f++] = (icc_feature){.size = sizeof *m->features,
                                             .kind = ICC_FEATURE_HOLE,
                                             .n_vertices = ring->n,
                                             .vertices = m->places + 2 * at};
        at += ring->n;
    }
    for (size_t i = 0; i < m->mesh->n_features; ++i) {
        const iccp_given_feature *given = &m->mesh->features[i];
        memcpy(m->vertex + at, given->vertices, given->n * sizeof *m->vertex);
        m->features[f++] = (icc_feature){.size = sizeof *m->features,
                                         .kind = given->kind,
                                         .n_vertices = given->n,
                                         .vertices = m->places + 2 * at};
        at += given->n;
    }
    return ICC_OK;
}

/* Says what is wrong with a boundary in the mesh's own numbers, if that is what is wrong. */
static void explain(const maker *m, const double *places, const iccp_env *env, icc_error *err)
{
    const size_t n = m->mesh->n_vertices;
    double *local = iccp_alloc(&env->memory, n, 2 * sizeof *local);
    iccp_frame frame;
    if (local == NULL)
        return;
    iccp_frame_fit(&frame, 2, n, places);
    if (iccp_all_finite(2 * n, places) && iccp_frame_in_all(&frame, n, places, local))
        (void)iccp_outlines_check(&m->rings, local, env, err);
    iccp_free(&env->memory, local);
}

static icc_status make_domain(maker *m, int side, const iccp_env *env, icc_error *err)
{
    const double *places = side == 0 ? m->mesh->points : m->mesh->images;
    const size_t n_outer = m->rings.ring[m->outer].n, n_features = count_features(m);
    size_t n = n_outer;
    for (size_t f = 0; f < n_features; ++f)
        n += m->features[f].n_vertices;
    for (size_t k = 0; k < n; ++k)
        memcpy(m->places + 2 * k, places + 2 * (size_t)m->vertex[k], 2 * sizeof *places);
    const icc_status status =
        n_features > 0
            ? iccp_domain_create_features(&m->domains[side], n_outer, m->places, n_features,
                                          m->features, env, err)
            : iccp_domain_create(&m->domains[side], 2, n_outer, m->places, 0, NULL, env, err);
    if (status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE)
        explain(m, places, env, err);
    return status == ICC_OK ? status : iccp_fail_side(err, status, side + 1);
}

/* ---- the map ---- */

/* Converts points to a domain's local coordinates. */
static icc_status localise(double *local, const icc_domain *domain, size_t n, const double *points,
                           int32_t side, icc_error *err)
{
    for (size_t v = 0; v < n; ++v) {
        if (!iccp_frame_holds(&domain->frame, 2, points + 2 * v)) {
            (void)iccp_fail_at(err, ICC_ERR_RESOLUTION, ICC_ITEM_VERTEX, (int64_t)v,
                               "vertex %zu has a coordinate too small for exact signs", v);
            return iccp_fail_side(err, ICC_ERR_RESOLUTION, side);
        }
        iccp_frame_in(&domain->frame, 2, points + 2 * v, local + 2 * v);
    }
    return ICC_OK;
}

static void fix(iccp_plmap *pl, uint32_t vertex, uint8_t kind, size_t facet, double along)
{
    pl->fixed[vertex] = kind;
    pl->facet[vertex] = (uint32_t)facet;
    pl->along[vertex] = along;
}

/* Fixes the vertices of the boundary and of the features to the facets of the domain. */
static void fix_all(iccp_plmap *pl, const maker *m)
{
    const size_t n_outer = m->rings.ring[m->outer].n;
    const iccp_features *features = m->domains[0]->features;
    memset(pl->fixed, ICCP_FREE, pl->n_vertices * sizeof *pl->fixed);
    memset(pl->facet, 0, pl->n_vertices * sizeof *pl->facet);
    for (size_t v = 0; v < pl->n_vertices; ++v)
        pl->along[v] = 0;
    for (size_t k = 0; k < n_outer; ++k)
        fix(pl, m->vertex[k], ICCP_ALONG, k, 0);
    for (size_t i = 0; features != NULL && i < features->n; ++i) {
        const iccp_feature *f = &features->item[i];
        const uint32_t *v = m->vertex + f->first;
        const bool is_line = f->kind == ICC_FEATURE_LINE;
        for (size_t k = 0; k < f->n; ++k)
            fix(pl, v[k],
                f->kind == ICC_FEATURE_HOLE    ? ICCP_ALONG
                : f->kind == ICC_FEATURE_POINT ? ICCP_ON_POINT
                : k == 0                       ? ICCP_LINE_BEGIN
                                               : ICCP_ON_LINE,
                f->first_facet + (is_line && k == f->n_facets ? k - 1 : k),
                is_line && k == f->n_facets ? 1 : 0);
    }
}

static icc_status fill_in(icc_map *map, maker *m, const iccp_env *env, icc_error *err)
{
    const iccp_given_mesh *mesh = m->mesh;
    const icc_domain *const *domains = (const icc_domain *const *)m->domains;
    iccp_mesh_map *plane = iccp_mesh_map_new(domains[0], domains[1], &env->memory);
    map->kind = &iccp_plane_kind;
    map->info.kind = ICC_MAP_MESH;
    map->state = plane;
    if (plane == NULL)
        return ICC_ERR_MEMORY;
    icc_status status =
        iccp_plmap_begin(&plane->pl, mesh->n_vertices, mesh->n_triangles,
                         sqrt(domains[1]->measure / domains[0]->measure), &env->memory);
    if (status != ICC_OK)
        return status;
    memcpy(plane->pl.corners.vertex, m->corners.vertex, 3 * mesh->n_triangles * sizeof(uint32_t));
    memcpy(plane->pl.corners.twin, m->corners.twin, 3 * mesh->n_triangles * sizeof(uint32_t));
    fix_all(&plane->pl, m);
    status = localise(plane->pl.points, domains[0], mesh->n_vertices, mesh->points, 1, err);
    if (status == ICC_OK)
        status = localise(plane->pl.images, domains[1], mesh->n_vertices, mesh->images, 2, err);
    if (status == ICC_OK)
        status = iccp_mesh_map_finish(plane, &map->info, env);
    if (status != ICC_OK)
        return status;
    map->info.energy_start = map->info.energy = iccp_plmap_energy(&plane->pl);
    map->info.class_kept = domains[0]->features != NULL;
    return iccp_map_conclude(map, env, err);
}

static icc_status make(icc_map **out, maker *m, const iccp_env *env, icc_error *err)
{
    icc_status status = check_vertices(m, env, err);
    if (status == ICC_OK)
        status = link_triangles(m, env, err);
    if (status == ICC_OK)
        status = find_rings(m, env, err);
    if (status == ICC_OK) {
        find_outer(m);
        status = list_vertices(m, env);
    }
    for (int side = 0; status == ICC_OK && side < 2; ++side)
        status = make_domain(m, side, env, err);
    if (status == ICC_OK)
        status = iccp_map_begin(out, m->domains[0], m->domains[1], env, err);
    return status == ICC_OK ? fill_in(*out, m, env, err) : status;
}

icc_status iccp_map_of_mesh(icc_map **out, const iccp_given_mesh *mesh, const iccp_env *env,
                            icc_error *err)
{
    const double begin = iccp_seconds();
    maker m = {.mesh = mesh, .rings.memory = env->memory};
    *out = NULL;
    const icc_status status = make(out, &m, env, err);
    iccp_free(&env->memory, m.corners.vertex);
    iccp_free(&env->memory, m.corners.twin);
    iccp_outlines_free(&m.rings);
    iccp_free(&env->memory, m.vertex);
    iccp_free(&env->memory, m.places);
    iccp_free(&env->memory, m.features);
    iccp_domain_release(m.domains[0]);
    iccp_domain_release(m.domains[1]);
    if (status != ICC_OK) {
        iccp_map_release(*out);
        *out = NULL;
        return iccp_explain(err, status);
    }
    (*out)->info.seconds = iccp_seconds() - begin;
    return ICC_OK;
}
