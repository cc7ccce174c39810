/* Triangulates the vertices half-way between source and target: the constrained Delaunay
 * triangulation of the mean places, where a domain is first moved onto the other one as well as an
 * affine map can. Long walls get vertices. What is inverted on either side is mended. */
#include "map/plane/straight_start.h"

#include "map/compatible/mend_inverted.h"
#include "map/compatible/network_rows.h"
#include "map/energy/affine.h"
#include "map/isotopy/edge_tree.h"
#include "math/predicates.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* ---- the triangulation ---- */

static void free_mesh(iccp_corners *mesh, const iccp_memory *memory)
{
    iccp_free(memory, mesh->vertex);
    iccp_free(memory, mesh->twin);
    *mesh = (iccp_corners){0};
}

/* Sets the mean places. Returns false if no affine map takes one domain near the other. */
static bool meet(double *places, const iccp_domain_pair *domains)
{
    const double *from = domains->domain[0]->vertices, *to = domains->domain[1]->vertices;
    const iccp_simplicial_map vertices = {.dim = 2,
                                          .n_points = domains->n,
                                          .n_fixed = domains->n,
                                          .points = domains->domain[0]->vertices,
                                          .images = domains->domain[1]->vertices};
    iccp_affine affine;
    if (!iccp_affine_fit(&affine, &vertices))
        return false;
    for (size_t v = 0; v < domains->n; ++v) {
        iccp_affine_apply(&affine, from + 2 * v, places + 2 * v);
        for (size_t k = 2 * v; k < 2 * v + 2; ++k)
            places[k] = (places[k] + to[k]) / 2;
    }
    return true;
}

/* Triangulates the vertices half-way, or in the source if walls cross half-way. `places` receives
 * the places of the vertices in this triangulation. */
static icc_status triangulate(iccp_corners *mesh, double *places, const iccp_domain_pair *domains,
                              const iccp_env *env)
{
    icc_status status = ICC_ERR_BOUNDARY;
    *mesh = (iccp_corners){0};
    if (meet(places, domains))
        status = iccp_triangulate_inside(mesh, domains, domains->n, places, domains->n_walls,
                                         domains->pairs, env);
    if (status == ICC_OK || status == ICC_ERR_MEMORY || status == ICC_ERR_CANCELLED)
        return status;
    free_mesh(mesh, &env->memory);
    memcpy(places, domains->domain[0]->vertices, 2 * domains->n * sizeof *places);
    return iccp_triangulate_inside(mesh, domains, domains->n, places, domains->n_walls,
                                   domains->pairs, env);
}

/* Makes a map of the triangulation to itself. vertex[v]: the domains' vertex at vertex v. */
static icc_status begin(iccp_plmap *map, uint32_t *vertex, const iccp_corners *mesh,
                        const double *places, const iccp_domain_pair *domains,
                        const iccp_memory *memory)
{
    uint32_t *number = iccp_alloc(memory, domains->n, sizeof *number), n = 0;
    if (number == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < domains->n; ++v)
        if (domains->node[v] == v) {
            number[v] = n;
            vertex[n++] = v;
        }
    const icc_status status =
        iccp_plmap_begin(map, n, mesh->n_triangles, 1 / domains->scale, memory);
    if (status == ICC_OK) {
        iccp_plmap_fix_none(map, domains->domain[0]);
        for (size_t v = 0; v < n; ++v) {
            memcpy(map->points + 2 * v, places + 2 * (size_t)vertex[v], 2 * sizeof *places);
            iccp_plmap_fix_node(map, v, vertex[v]);
        }
        memcpy(map->images, map->points, 2 * n * sizeof *map->images);
        for (size_t c = 0; c < 3 * mesh->n_triangles; ++c)
            map->corners.vertex[c] = number[mesh->vertex[c]];
        memcpy(map->corners.twin, mesh->twin, 3 * mesh->n_triangles * sizeof *mesh->twin);
    }
    iccp_free(memory, number);
    return status;
}

/* ---- walls ---- */

/* Whether the edge that a corner faces is a wall that shall be halved: the corner is nearer to its
 * middle than the wall's ends are, and belongs to another component. The walls of one component may
 * meet at any angle, so halving them might never end. */
static bool shall_halve(const iccp_plmap *map, uint32_t corner, const iccp_domain_pair *domains)
{
    const uint32_t *v = map->corners.vertex, node = iccp_plmap_node(map, v[corner]);
    const double *x = iccp_plmap_point(map, corner), *a = iccp_plmap_point(map, iccp_after(corner)),
                 *b = iccp_plmap_point(map, iccp_before(corner));
    uint32_t facet;
    double from, to;
    return node != UINT32_MAX &&
           (a[0] - x[0]) * (b[0] - x[0]) + (a[1] - x[1]) * (b[1] - x[1]) < 0 &&
           iccp_plmap_on_line(map, v[iccp_after(corner)], v[iccp_before(corner)], &facet, &from,
                              &to) &&
           domains->component[node] != domains->component[map->featured->facets[2 * (size_t)facet]];
}

static bool is_not_delaunay(const iccp_plmap *map, uint32_t corner)
{
    const uint32_t twin = map->corners.twin[corner];
    return iccp_plmap_may_flip(map, corner) &&
           iccp_incircle(iccp_plmap_point(map, corner), iccp_plmap_point(map, iccp_after(corner)),
                         iccp_plmap_point(map, iccp_before(corner)),
                         iccp_plmap_point(map, twin)) > 0;
}

/* Flips edges around the last vertex until the triangulation is Delaunay again: C. Lawson, Software
 * for C1 surface interpolation, 1977. It is a corner of the given triangles. `stack` has room for
 * the corners of all triangles. */
static void settle(iccp_plmap *map, const uint32_t triangles[4], uint32_t *stack)
{
    size_t n = 0;
    for (int i = 0; i < 4; ++i)
        for (uint32_t c = 3 * triangles[i]; triangles[i] != NONE && c < 3 * triangles[i] + 3; ++c)
            if (map->corners.vertex[c] == map->n_vertices - 1)
                stack[n++] = c;
    while (n > 0) {
        const uint32_t corner = stack[--n], twin = map->corners.twin[corner];
        if (is_not_delaunay(map, corner)) {
            iccp_flip_edge(&map->corners, corner);
            stack[n++] = corner;
            stack[n++] = iccp_before(twin);
        }
    }
}

/* Halves walls that vertices are near to, as J. Ruppert does (A Delaunay refinement algorithm for
 * quality 2-dimensional mesh generation, 1995). Otherwise many vertices near a long wall are joined
 * to its ends by flat triangles, which any motion inverts. The vertices at most double. */
static icc_status halve_walls(iccp_plmap *map, const iccp_domain_pair *domains,
                              const iccp_memory *memory)
{
    const size_t n = map->n_vertices;
    uint32_t *stack = iccp_alloc(memory, map->corners.n_triangles + 2 * n, 3 * sizeof *stack);
    icc_status status = stack != NULL ? ICC_OK : ICC_ERR_MEMORY;
    bool more = true;
    while (status == ICC_OK && more) {
        more = false;
        for (uint32_t c = 0; status == ICC_OK && c < 3 * map->corners.n_triangles; ++c) {
            const uint32_t twin = map->corners.twin[c], last = (uint32_t)map->corners.n_triangles;
            bool done = false;
            if (map->n_vertices < 2 * n && shall_halve(map, c, domains))
                status = iccp_plmap_cut(map, c, &done);
            if (done)
                settle(map,
                       (const uint32_t[]){c / 3, twin == NONE ? NONE : twin / 3, last,
                                          twin == NONE ? NONE : last + 1},
                       stack);
            more = more || done;
        }
    }
    iccp_free(memory, stack);
    return status;
}

/* Moves the vertices to their places in the source and in the target. */
static void spread(iccp_plmap *map, size_t n, const uint32_t *vertex,
                   const iccp_domain_pair *domains)
{
    double *const places[2] = {map->points, map->images};
    for (int side = 0; side < 2; ++side)
        for (size_t v = 0; v < map->n_vertices; ++v) {
            const icc_domain *domain = domains->domain[side];
            const double bary[2] = {1 - map->along[v], map->along[v]};
            double *place = places[side] + 2 * v;
            if (v < n)
                memcpy(place, domain->vertices + 2 * (size_t)vertex[v], 2 * sizeof *place);
            else
                iccp_domain_facet_point(domain, map->facet[v], bary, place);
        }
}

/* ---- all of it ---- */

/* Finds the tree of the map's edges between the domains' vertices: the first n of the map, at
 * vertex[v]. */
static icc_status find_tree(iccp_cuts *tree, const iccp_plmap *map, size_t n,
                            const uint32_t *vertex, const iccp_domain_pair *domains,
                            const iccp_env *env)
{
    const size_t n_triangles = map->corners.n_triangles;
    iccp_corners mesh = {iccp_alloc(&env->memory, n_triangles, 3 * sizeof *mesh.vertex), NULL,
                         n_triangles};
    if (mesh.vertex == NULL)
        return ICC_ERR_MEMORY;
    for (size_t c = 0; c < 3 * n_triangles; ++c) {
        const uint32_t v = map->corners.vertex[c];
        mesh.vertex[c] = v < n ? vertex[v] : NONE;
    }
    const icc_status status = iccp_edge_tree(tree, domains, &mesh, env);
    iccp_free(&env->memory, mesh.vertex);
    return status;
}

icc_status iccp_straight_start(iccp_plmap *map, iccp_cuts *tree, bool *found,
                               const iccp_domain_pair *domains, iccp_work *work,
                               const iccp_env *env)
{
    uint32_t *vertex = iccp_alloc(&env->memory, domains->n, sizeof *vertex);
    double *places = iccp_alloc(&env->memory, domains->n, 2 * sizeof *places);
    iccp_corners mesh = {0};
    icc_status status = vertex != NULL && places != NULL ? ICC_OK : ICC_ERR_MEMORY;
    *map = (iccp_plmap){.memory = env->memory};
    *tree = (iccp_cuts){.memory = env->memory};
    if (status == ICC_OK)
        status = triangulate(&mesh, places, domains, env);
    if (status == ICC_OK)
        status = begin(map, vertex, &mesh, places, domains, &env->memory);
    free_mesh(&mesh, &env->memory);
    const size_t n = map->n_vertices;
    if (status == ICC_OK)
        status = halve_walls(map, domains, &env->memory);
    *found = status == ICC_OK;
    if (status == ICC_OK) {
        spread(map, n, vertex, domains);
        status = iccp_mend_inverted(map, found, work, env);
    }
    if (status == ICC_OK && *found)
        status = iccp_check_rows(found, map, domains->domain[1], env);
    if (status == ICC_OK && *found)
        status = find_tree(tree, map, n, vertex, domains, env);
    if (status == ICC_ERR_TOPOLOGY) { /* some components are joined by way of new vertices only */
        *found = false;
        status = ICC_OK;
    }
    iccp_free(&env->memory, vertex);
    iccp_free(&env->memory, places);
    return status;
}
