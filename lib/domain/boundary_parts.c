/* The parts of a mesh's boundary. The boundary winds around a point as often as positive simplices
 * cover it (docs/theory/plane-maps.md). Suppose that surfaces do not meet. Then they wind around
 * each point once or not at all under one condition: the outermost ones face outwards and every
 * other one faces against the surface around it. */
#include "domain/boundary_parts.h"

#include "base/error.h"
#include "domain/complex.h"
#include "domain/simplicial.h"
#include "geometry/crossings.h"
#include "geometry/edges_bound.h"
#include "geometry/triangles.h"

#include <string.h>

/* ---- the plane ---- */

/* Finds the rings if they share no vertex. */
static icc_status create_rings(iccp_boundary_parts *b)
{
    uint32_t *next = iccp_alloc(&b->memory, b->n_vertices, sizeof *next);
    icc_status status = next != NULL ? ICC_OK : ICC_ERR_MEMORY;
    bool are_apart = next != NULL;
    if (next != NULL)
        memset(next, 0xff, b->n_vertices * sizeof *next);
    for (size_t f = 0; are_apart && f < b->n_facets; ++f) {
        are_apart = next[b->facets[2 * f]] == UINT32_MAX;
        next[b->facets[2 * f]] = b->facets[2 * f + 1];
    }
    if (are_apart)
        status = iccp_outlines_create(&b->outlines, b->n_vertices, next, &b->memory);
    iccp_free(&b->memory, next);
    return status;
}

/* Checks the boundary of a mesh in the plane whose rings share vertices. */
static icc_status check_edges(const iccp_boundary_parts *b, const double *points,
                              const iccp_env *env, icc_error *err)
{
    const iccp_edges edges = {b->n_vertices, b->n_facets, b->facets};
    bool bound;
    const icc_status status = iccp_edges_bound(&bound, &edges, points, env);
    return status != ICC_OK || bound
               ? status
               : iccp_fail(err, ICC_ERR_BOUNDARY,
                           "edges meet elsewhere than at common vertices, or run around a place "
                           "twice");
}

/* ---- space ---- */

/* Sorts the facets by surface. */
static icc_status sort_surfaces(iccp_boundary_parts *b, const iccp_complex *c)
{
    const iccp_memory *memory = &b->memory;
    const size_t n = c->n_facets;
    uint32_t *order = iccp_alloc(memory, n, sizeof *order);
    bool *reached = iccp_alloc_zero(memory, n, sizeof *reached);
    b->facets = iccp_alloc(memory, n, 3 * sizeof *b->facets);
    b->start = iccp_alloc(memory, n / 4 + 1, sizeof *b->start);
    const bool is_ready = order != NULL && reached != NULL && b->facets != NULL && b->start != NULL;
    uint32_t done = 0;
    for (size_t f = 0; is_ready && f < n; ++f)
        if (!reached[f]) {
            b->start[b->n_parts++] = done;
            done += (uint32_t)iccp_complex_flood(c, f, reached, order + done);
        }
    for (size_t f = 0; is_ready && f < n; ++f)
        memcpy(b->facets + 3 * f, c->facets + 3 * (size_t)order[f], 3 * sizeof *b->facets);
    if (is_ready)
        b->start[b->n_parts] = done;
    iccp_free(memory, order);
    iccp_free(memory, reached);
    return is_ready ? ICC_OK : ICC_ERR_MEMORY;
}

static icc_status create_surfaces(iccp_boundary_parts *b, const iccp_env *env, icc_error *err)
{
    uint32_t *facets = b->facets;
    iccp_complex c = {3, b->n_vertices, b->n_facets, facets, NULL};
    c.across = iccp_alloc(&b->memory, 3 * b->n_facets, sizeof *c.across);
    icc_status status = c.across != NULL ? iccp_complex_join(&c, env, err) : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_complex_check_vertices(&c, env, err);
    if (status == ICC_OK)
        status = sort_surfaces(b, &c);
    if (b->facets != facets)
        iccp_free(&b->memory, facets);
    iccp_free(&b->memory, c.across);
    return status;
}

static icc_status fail_pair(icc_error *err, const uint32_t *a, const uint32_t *b)
{
    return iccp_fail(err, ICC_ERR_BOUNDARY, "faces (%lu, %lu, %lu) and (%lu, %lu, %lu) meet",
                     (unsigned long)a[0], (unsigned long)a[1], (unsigned long)a[2],
                     (unsigned long)b[0], (unsigned long)b[1], (unsigned long)b[2]);
}

/* Returns the vertex with the largest x. */
static const double *last_vertex(const iccp_facet_tree *tree)
{
    const double *last = tree->vertices + 3 * (size_t)tree->facets[0];
    for (size_t i = 1; i < 3 * tree->n; ++i) {
        const double *v = tree->vertices + 3 * (size_t)tree->facets[i];
        last = v[0] > last[0] ? v : last;
    }
    return last;
}

/* A ray along x from the last vertex of a surface leaves every surface around it. If it crosses an
 * odd number of facets, the surface lies inside another one and must face inwards. */
static icc_status check_surface(const iccp_facet_tree *all, const uint32_t *facets, size_t n,
                                icc_error *err)
{
    const iccp_facet_tree own = {
        .dim = 3, .n_corners = 3, .n = n, .vertices = all->vertices, .facets = facets};
    int32_t orientation;
    double volume;
    const icc_status status = iccp_simplicial_measure(&own, &orientation, &volume, err);
    const bool is_odd = iccp_ray_parity(all, 0, true, last_vertex(&own));
    if (status != ICC_OK || orientation == (is_odd ? -1 : 1))
        return status;
    return iccp_fail(err, ICC_ERR_BOUNDARY,
                     "the surface with vertex %lu faces the wrong way beside the others",
                     (unsigned long)facets[0]);
}

/* Checks surfaces, each of which is closed and connected around each vertex. */
static icc_status check_surfaces(const iccp_boundary_parts *b, const iccp_facet_tree *tree,
                                 const iccp_env *env, icc_error *err)
{
    uint32_t pair[2];
    for (uint32_t f = 0; f < tree->n; ++f)
        if (!iccp_simplicial_has_area(tree, f))
            return iccp_fail(err, ICC_ERR_BOUNDARY, "a face at vertex %lu has area 0",
                             (unsigned long)tree->facets[3 * (size_t)f]);
    icc_status status = iccp_triangles_find(tree, b->n_vertices, pair, env);
    if (status == ICC_OK && pair[0] != pair[1])
        return fail_pair(err, tree->facets + 3 * (size_t)pair[0],
                         tree->facets + 3 * (size_t)pair[1]);
    for (size_t k = 0; status == ICC_OK && b->n_parts > 1 && k < b->n_parts; ++k)
        status = check_surface(tree, tree->facets + 3 * (size_t)b->start[k],
                               b->start[k + 1] - b->start[k], err);
    return status;
}

/* ---- both ---- */

/* Lists the boundary's facets, facing outwards, in the caller's numbers of vertices. */
static void list_facets(const iccp_simplices *mesh, uint32_t *to)
{
    for (size_t side = 0; side < (mesh->dim + 1) * mesh->n_simplices; ++side) {
        if (!(mesh->across[side] & ICCP_ON_BOUNDARY))
            continue;
        iccp_simplices_side(mesh, side, to);
        for (size_t i = 0; i < mesh->dim; ++i, ++to)
            *to = mesh->given[*to];
    }
}

icc_status iccp_boundary_parts_create(iccp_boundary_parts *b, const iccp_simplices *mesh,
                                      size_t n_vertices, const iccp_env *env, icc_error *err)
{
    *b = (iccp_boundary_parts){.memory = env->memory,
                               .dim = mesh->dim,
                               .n_vertices = n_vertices,
                               .n_facets = mesh->n_facets};
    b->facets = iccp_alloc(&env->memory, b->n_facets, mesh->dim * sizeof *b->facets);
    if (b->facets == NULL)
        return ICC_ERR_MEMORY;
    list_facets(mesh, b->facets);
    return mesh->dim == 2 ? create_rings(b) : create_surfaces(b, env, err);
}

void iccp_boundary_parts_free(iccp_boundary_parts *b)
{
    const iccp_memory memory = b->memory;
    iccp_outlines_free(&b->outlines);
    iccp_free(&memory, b->facets);
    iccp_free(&memory, b->start);
}

icc_status iccp_boundary_parts_check(const iccp_boundary_parts *b, const double *points,
                                     const iccp_env *env, icc_error *err)
{
    if (b->outlines.n > 0)
        return iccp_outlines_check(&b->outlines, points, env, err);
    if (b->dim == 2)
        return check_edges(b, points, env, err);
    iccp_facet_tree tree;
    iccp_facet_tree_create(&tree, 3, points, b->n_facets, b->facets, &b->memory);
    icc_status status = ICC_ERR_MEMORY;
    if (tree.boxes != NULL)
        status = check_surfaces(b, &tree, env, err);
    iccp_facet_tree_free(&tree, &b->memory);
    return status;
}
