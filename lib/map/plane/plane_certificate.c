/* Proves that a piecewise linear map in the plane is one-to-one (docs/theory/plane-maps.md).
 *
 * Two facts are enough. Every triangle is positive before and after the map. And before and after
 * the map, the boundary of the mesh winds once around each place on its left and around no other.
 * For this number counts the triangles that cover a place.
 *
 * Without features, the boundary consists of rings that touch nowhere. Then Euler's formula also
 * shows that the mesh is in one piece and that triangles use all vertices. With features, rings may
 * touch, and the mesh must follow the network of the source (map/compatible/network_rows.h). */
#include "map/plane/plane_certificate.h"

#include "base/error.h"
#include "base/threads.h"
#include "domain/outlines.h"
#include "geometry/edges_bound.h"
#include "map/compatible/network_rows.h"

#include <stdatomic.h>

/* Triangles that a thread looks at at once. */
enum { GRAIN = 512 };

/* ---- outlines ---- */

typedef struct sides {
    iccp_outlines outlines;
    const double *places[2]; /* of all vertices */
} sides;

static icc_status check_side(void *argument, size_t side, const iccp_env *env, icc_error *err)
{
    const sides *s = argument;
    (void)err;
    return iccp_outlines_check(&s->outlines, s->places[side], env, NULL);
}

static icc_status check_outlines(const iccp_plmap *map, size_t *n_rings, const iccp_env *env)
{
    sides s = {.places = {map->points, map->images}};
    uint32_t *next = iccp_alloc(&env->memory, map->n_vertices, sizeof *next);
    if (next == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_ERR_BOUNDARY;
    if (iccp_link_boundary(&map->corners, map->n_vertices, next))
        status = iccp_outlines_create(&s.outlines, map->n_vertices, next, &env->memory);
    if (status == ICC_OK)
        status = iccp_side_by_side(env, 2, check_side, &s, NULL);
    *n_rings = s.outlines.n;
    iccp_free(&env->memory, next);
    iccp_outlines_free(&s.outlines);
    return status;
}

/* ---- boundaries that may touch ---- */

typedef struct border {
    iccp_edges edges;
    const double *places[2];
    bool bound[2];
} border;

static icc_status check_border_side(void *argument, size_t side, const iccp_env *env,
                                    icc_error *err)
{
    border *b = argument;
    (void)err;
    return iccp_edges_bound(&b->bound[side], &b->edges, b->places[side], env);
}

/* Lists the edges without a twin, with their triangles on the left. */
static void list_border(uint32_t *ends, const iccp_corners *corners)
{
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c)
        if (corners->twin[c] == ICCP_NO_NEIGHBOUR) {
            ends[n++] = corners->vertex[iccp_after(c)];
            ends[n++] = corners->vertex[iccp_before(c)];
        }
}

static icc_status check_border(const iccp_plmap *map, size_t n_open, const iccp_env *env)
{
    uint32_t *ends = iccp_alloc(&env->memory, n_open, 2 * sizeof *ends);
    border b = {.edges = {map->n_vertices, n_open, ends}, .places = {map->points, map->images}};
    if (ends == NULL)
        return ICC_ERR_MEMORY;
    list_border(ends, &map->corners);
    const icc_status status = iccp_side_by_side(env, 2, check_border_side, &b, NULL);
    iccp_free(&env->memory, ends);
    return status != ICC_OK || (b.bound[0] && b.bound[1]) ? status : ICC_ERR_BOUNDARY;
}

/* ---- triangles ---- */

/* Counts the tests that pass, so that a test that was not made counts as a fault. */
typedef struct count {
    const iccp_plmap *map;
    atomic_size_t n_good, n_open;
} count;

/* Counts in a range of triangles. Good are positive triangles, and half-edges with a matching twin
 * or without a twin. Open are half-edges without a twin. */
static icc_status count_some(void *argument, size_t begin, size_t end)
{
    count *all = argument;
    const iccp_plmap *map = all->map;
    size_t n_good = 0, n_open = 0;
    for (uint32_t t = (uint32_t)begin; t < end; ++t)
        n_good += iccp_plmap_positive_point(map, t) && iccp_plmap_positive_image(map, t);
    for (uint32_t c = 3 * (uint32_t)begin; c < 3 * end; ++c) {
        const uint32_t twin = map->corners.twin[c];
        n_open += twin == ICCP_NO_NEIGHBOUR;
        n_good += twin == ICCP_NO_NEIGHBOUR ||
                  (map->corners.twin[twin] == c &&
                   map->corners.vertex[iccp_after(twin)] == map->corners.vertex[iccp_before(c)] &&
                   map->corners.vertex[iccp_before(twin)] == map->corners.vertex[iccp_after(c)]);
    }
    atomic_fetch_add(&all->n_good, n_good);
    atomic_fetch_add(&all->n_open, n_open);
    return ICC_OK;
}

icc_status iccp_plmap_certify(const iccp_plmap *map, const iccp_env *env, icc_error *err)
{
    const size_t n_triangles = map->corners.n_triangles;
    iccp_env quiet = *env;
    count all = {.map = map};
    quiet.progress = NULL;
    (void)iccp_for_chunks(&quiet, "check", n_triangles, GRAIN, count_some, &all);
    const size_t n_faults = 4 * n_triangles - atomic_load(&all.n_good);
    const size_t n_open = atomic_load(&all.n_open);
    if (n_faults > 0)
        return iccp_fail(err, ICC_ERR_CERTIFICATE, "the mesh map cannot be certified: %zu faults",
                         n_faults);
    size_t n_rings = 0;
    const icc_status status =
        map->featured != NULL ? check_border(map, n_open, env) : check_outlines(map, &n_rings, env);
    if (status == ICC_ERR_BOUNDARY)
        return iccp_fail(err, ICC_ERR_CERTIFICATE,
                         "the boundary of the mesh or of its image is not simple");
    /* One piece with n_rings - 1 holes. */
    if (status == ICC_OK && map->featured == NULL &&
        2 * map->n_vertices + 2 * n_rings != n_triangles + n_open + 4)
        return iccp_fail(err, ICC_ERR_CERTIFICATE,
                         "the mesh map cannot be certified: its mesh is "
                         "not in one piece");
    return status;
}

static icc_status check_rows(const iccp_plmap *map, const icc_domain *target, const iccp_env *env,
                             icc_error *err)
{
    bool follows;
    const icc_status status = iccp_check_rows(&follows, map, target, env);
    return status != ICC_OK || follows
               ? status
               : iccp_fail(err, ICC_ERR_CERTIFICATE,
                           "the mesh map cannot be certified: its mesh does not follow the lines "
                           "of the domains");
}

icc_status iccp_plane_certify(icc_map *map, const iccp_env *env, icc_error *err)
{
    const iccp_mesh_map *plane = map->state;
    const iccp_env quiet = iccp_quiet(env);
    icc_status status = iccp_plmap_certify(&plane->pl, &quiet, err);
    if (status == ICC_OK && plane->pl.featured != NULL)
        status = check_rows(&plane->pl, map->target_domain, &quiet, err);
    map->info.certified = status == ICC_OK;
    return status;
}
