/* The parts of a mesh's boundary. The boundary winds around a point as often as positive simplices
 * cover it (docs/theory/plane-maps.md). Suppose that surfaces do not meet. Then they wind around
 * each point once or not at all under one condition: the outermost ones face outwards and every
 * other one faces against the surface around it. */
#include "domain/boundary_parts.h"

#include "base/error.h"
#include "domain/closed_surfaces.h"
#include "domain/complex.h"
#include "domain/simplicial.h"
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

static icc_status create_surfaces(iccp_boundary_parts *b, const iccp_env *env, icc_error *err)
{
    b->across = iccp_alloc(&b->memory, 3 * b->n_facets, sizeof *b->across);
    iccp_complex c = {3, b->n_vertices, b->n_facets, b->facets, b->across};
    icc_status status = c.across != NULL ? iccp_complex_join(&c, env, err) : ICC_ERR_MEMORY;
    return status == ICC_OK ? iccp_complex_check_vertices(&c, env, err) : status;
}

static icc_status fail_pair(icc_error *err, const uint32_t *a, const uint32_t *b)
{
    return iccp_fail(err, ICC_ERR_BOUNDARY, "faces (%lu, %lu, %lu) and (%lu, %lu, %lu) meet",
                     (unsigned long)a[0], (unsigned long)a[1], (unsigned long)a[2],
                     (unsigned long)b[0], (unsigned long)b[1], (unsigned long)b[2]);
}

/* Outermost surfaces must face outwards. The others face against the surface around them. */
static icc_status check_nesting(const iccp_boundary_parts *b, const iccp_facet_tree *tree,
                                const iccp_env *env, icc_error *err)
{
    const iccp_complex c = {3, b->n_vertices, b->n_facets, b->facets, b->across};
    iccp_surfaces s;
    icc_status status = iccp_surfaces_create(&s, &c, tree, env);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; k < s.n && status == ICC_OK; ++k) {
        const iccp_surface *own = &s.item[k];
        const int32_t wanted = own->around == UINT32_MAX ? 1 : -s.item[own->around].orientation;
        if (own->orientation != wanted)
            status = iccp_fail(err, ICC_ERR_BOUNDARY,
                               "the surface with vertex %lu faces the wrong way beside the others",
                               (unsigned long)own->lowest);
    }
    iccp_surfaces_free(&s, &b->memory);
    return status;
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
    return status == ICC_OK ? check_nesting(b, tree, env, err) : status;
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
    iccp_free(&memory, b->across);
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
