/* Makes a map from a triangle mesh and the images of its vertices. The boundary of the mesh gives
 * the two domains: its ring that runs counter-clockwise is the outer one, all others are holes. */
#include "map/given_mesh.h"

#include "base/clock.h"
#include "base/error.h"
#include "domain/features.h"
#include "domain/outlines.h"
#include "map/plane/plane_kind.h"
#include "mesh/given_triangles.h"

#include <math.h>
#include <string.h>

typedef struct maker {
    const iccp_given_mesh *mesh;
    iccp_corners corners; /* owned */
    iccp_outlines rings;
    size_t outer;          /* the outer ring's number */
    uint32_t *vertex;      /* of each vertex of the domains: its number in the mesh */
    double *places;        /* of the same vertices, on one side */
    icc_feature *features; /* of the domains: holes, then points */
    icc_domain *domains[2];
} maker;

/* ---- the boundary ---- */

/* Links the triangles and finds the rings of the boundary. */
static icc_status find_rings(maker *m, const iccp_env *env, icc_error *err)
{
    const iccp_given_mesh *mesh = m->mesh;
    const size_t n = mesh->n_triangles;
    uint32_t *next = iccp_alloc(&env->memory, mesh->n_vertices, sizeof *next);
    m->corners.n_triangles = n;
    m->corners.vertex = iccp_alloc(&env->memory, n, 3 * sizeof *m->corners.vertex);
    m->corners.twin = iccp_alloc(&env->memory, n, 3 * sizeof *m->corners.twin);
    icc_status status = ICC_ERR_MEMORY;
    if (next != NULL && m->corners.vertex != NULL && m->corners.twin != NULL) {
        memcpy(m->corners.vertex, mesh->triangles, 3 * n * sizeof *mesh->triangles);
        status = iccp_link_triangles(&m->corners, mesh->n_vertices, next, env, err);
    }
    if (status == ICC_OK)
        status = iccp_outlines_create(&m->rings, mesh->n_vertices, next, &env->memory);
    iccp_free(&env->memory, next);
    return status;
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
    return m->rings.n - 1 + m->mesh->n_held;
}

/* Lists the vertices of the domains: the outer ring, the holes, the held vertices. */
static icc_status list_vertices(maker *m, const iccp_env *env)
{
    const size_t n = m->rings.n_points + m->mesh->n_held;
    size_t at = 0, f = 0;
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
    for (size_t i = 0; i < m->mesh->n_held; ++i) {
        m->vertex[at] = m->mesh->held[i];
        m->features[f++] = (icc_feature){.size = sizeof *m->features,
                                         .kind = ICC_FEATURE_POINT,
                                         .n_vertices = 1,
                                         .vertices = m->places + 2 * at++};
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

/* Fixes the vertices of the boundary and the held ones to those of the domain. */
static void fix_all(iccp_plmap *pl, const maker *m)
{
    const icc_domain *source = m->domains[0];
    iccp_plmap_fix_none(pl, source->features != NULL ? source : NULL);
    for (uint32_t k = 0; k < source->n_vertices; ++k)
        if (source->features != NULL) {
            iccp_plmap_fix_node(pl, m->vertex[k], k);
        } else {
            pl->fixed[m->vertex[k]] = ICCP_ALONG;
            pl->facet[m->vertex[k]] = k;
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
    icc_status status =
        iccp_check_used(m->mesh->n_vertices, m->mesh->n_triangles, m->mesh->triangles, env, err);
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
