/* Puts a vertex into a mesh that has none inside. */
#include "shelling/shelling_split.h"

#include "base/error.h"
#include "math/orient.h"

#include <string.h>

enum { CORNERS = ICC_MAX_DIM + 1 };

static const uint32_t NONE = UINT32_MAX;

static void find_middle(const iccp_simplices *mesh, size_t simplex, double *middle)
{
    const size_t n = mesh->dim + 1;
    for (size_t k = 0; k < mesh->dim; ++k) {
        middle[k] = 0;
        for (size_t i = 0; i < n; ++i)
            middle[k] += iccp_corner_point(mesh, n * simplex + i)[k];
        middle[k] /= (double)n;
    }
}

/* Returns true if the simplices with the point in place of each corner are all positive,
 * exactly. */
static bool can_split(const iccp_simplices *mesh, size_t simplex, const double *point)
{
    const size_t n = mesh->dim + 1;
    for (size_t i = 0; i < n; ++i) {
        const double *corners[CORNERS];
        for (size_t k = 0; k < n; ++k)
            corners[k] = k == i ? point : iccp_corner_point(mesh, n * simplex + k);
        if (iccp_orient(mesh->dim, corners) != 1)
            return false;
    }
    return true;
}

/* The squared distance of a point from the boundary. */
static double depth_of(const icc_domain *domain, const double *point)
{
    double bary[ICC_MAX_DIM], square;
    (void)iccp_facet_tree_nearest(iccp_domain_tree(domain), point, bary, &square);
    return square;
}

/* Of the simplices that can be split at their barycentre, finds the one whose barycentre is
 * farthest from the boundary. NONE if there is none. */
static uint32_t find_deepest(const icc_domain *domain)
{
    const iccp_simplices *mesh = domain->mesh;
    uint32_t deepest = NONE;
    double best = 0;
    for (uint32_t s = 0; s < mesh->n_simplices; ++s) {
        double middle[ICC_MAX_DIM];
        find_middle(mesh, s, middle);
        const double depth = depth_of(domain, middle);
        if (depth > best && can_split(mesh, s, middle)) {
            best = depth;
            deepest = s;
        }
    }
    return deepest;
}

/* Makes a copy with room for one more point and the dim more simplices that it makes. */
static icc_status copy(iccp_simplices **out, const iccp_simplices *mesh, const iccp_memory *memory)
{
    const size_t dim = mesh->dim, n_sides = (dim + 1) * mesh->n_simplices;
    iccp_simplices *m = iccp_alloc_zero(memory, 1, sizeof *m);
    *out = m;
    if (m == NULL)
        return ICC_ERR_MEMORY;
    *m = (iccp_simplices){.memory = *memory,
                          .dim = dim,
                          .n_points = mesh->n_points + 1,
                          .n_boundary = mesh->n_boundary,
                          .n_simplices = mesh->n_simplices + dim,
                          .n_facets = mesh->n_facets};
    m->points = iccp_alloc(memory, m->n_points, dim * sizeof *m->points);
    m->corners = iccp_alloc(memory, m->n_simplices, (dim + 1) * sizeof *m->corners);
    m->across = iccp_alloc(memory, m->n_simplices, (dim + 1) * sizeof *m->across);
    if (m->points == NULL || m->corners == NULL || m->across == NULL)
        return ICC_ERR_MEMORY;
    memcpy(m->points, mesh->points, mesh->n_points * dim * sizeof *m->points);
    memcpy(m->corners, mesh->corners, n_sides * sizeof *m->corners);
    memcpy(m->across, mesh->across, n_sides * sizeof *m->across);
    return ICC_OK;
}

/* Splits a simplex. Piece 0 replaces it, and the other pieces are new. Piece i has the point as
 * corner i. */
static void split(iccp_simplices *mesh, uint32_t simplex, const double *point)
{
    const uint32_t dim = (uint32_t)mesh->dim, n = dim + 1;
    uint32_t corners[CORNERS], across[CORNERS], piece[CORNERS] = {simplex};
    memcpy(mesh->points + dim * (mesh->n_points - 1), point, dim * sizeof *point);
    memcpy(corners, mesh->corners + n * simplex, n * sizeof *corners);
    memcpy(across, mesh->across + n * simplex, n * sizeof *across);
    for (uint32_t i = 1; i < n; ++i)
        piece[i] = (uint32_t)mesh->n_simplices - n + i;
    for (uint32_t i = 0; i < n; ++i) {
        for (uint32_t k = 0; k < n; ++k) {
            const uint32_t side = n * piece[i] + k;
            mesh->corners[side] = k == i ? (uint32_t)mesh->n_points - 1 : corners[k];
            mesh->across[side] = k == i ? across[i] : n * piece[k] + i;
        }
        if ((across[i] & ICCP_ON_BOUNDARY) == 0)
            mesh->across[across[i]] = n * piece[i] + i;
    }
}

icc_status iccp_split_deepest(iccp_simplices **out, const icc_domain *domain, const iccp_env *env,
                              icc_error *err)
{
    double middle[ICC_MAX_DIM];
    *out = NULL;
    const uint32_t deepest = find_deepest(domain);
    if (deepest == NONE)
        return iccp_fail(err, ICC_ERR_RESOLUTION,
                         "the mesh has no vertex inside, and no %s that could hold one",
                         iccp_simplices_name((size_t)domain->dim));
    icc_status status = copy(out, domain->mesh, &env->memory);
    if (status == ICC_OK) {
        find_middle(domain->mesh, deepest, middle);
        split(*out, deepest, middle);
        return ICC_OK;
    }
    iccp_simplices_free(*out);
    *out = NULL;
    return status;
}
