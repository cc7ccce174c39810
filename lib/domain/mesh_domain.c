/* Why the checks suffice, up to 3-D: all simplices are positive and facets induce opposite
 * orientations, so as many simplices lie over a point as the boundary winds round it. The boundary
 * is a simple one, so that is one inside and none outside. */
#include "domain/mesh_domain.h"

#include "base/error.h"
#include "domain/simplicial.h"
#include "domain/tuples.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct builder {
    const double *given; /* the caller's points */
    size_t n_given;
    iccp_simplices *mesh; /* in the caller's numbers, until renumber() */
    iccp_frame frame;
    uint32_t *number; /* n_given: the new number of each of the caller's points, or NONE */
    double *boundary; /* mesh->n_boundary * dim: points as given */
    uint32_t *facets; /* mesh->n_facets * dim: new numbers of points */
} builder;

static icc_status copy_mesh(builder *b, size_t dim, size_t n_simplices, const uint32_t *simplices,
                            const iccp_env *env)
{
    iccp_simplices *mesh = b->mesh = iccp_alloc_zero(&env->memory, 1, sizeof *mesh);
    if (mesh == NULL)
        return ICC_ERR_MEMORY;
    *mesh = (iccp_simplices){
        .memory = env->memory, .dim = dim, .n_points = b->n_given, .n_simplices = n_simplices};
    mesh->points = iccp_alloc(&env->memory, b->n_given, dim * sizeof *mesh->points);
    mesh->corners = iccp_alloc(&env->memory, n_simplices, (dim + 1) * sizeof *mesh->corners);
    b->number = iccp_alloc(&env->memory, b->n_given, sizeof *b->number);
    if (mesh->points == NULL || mesh->corners == NULL || b->number == NULL)
        return ICC_ERR_MEMORY;
    memcpy(mesh->corners, simplices, n_simplices * (dim + 1) * sizeof *simplices);
    return ICC_OK;
}

/* Checks simplices one by one, then in pairs across the facets that they share. */
static icc_status check_mesh(builder *b, size_t n_facets, const uint32_t *facets,
                             const iccp_env *env, icc_error *err)
{
    iccp_simplices *mesh = b->mesh;
    const iccp_complex c = {mesh->dim + 1, mesh->n_points, mesh->n_simplices, mesh->corners, NULL};
    icc_status status = iccp_simplices_check_corners(mesh, err);
    if (status == ICC_OK)
        status =
            iccp_simplicial_localise(&b->frame, mesh->points, mesh->dim, &c, b->given, env, err);
    if (status == ICC_OK)
        status = iccp_simplices_orient(mesh, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_progress(env, "check", 0.2));
    return status == ICC_OK ? iccp_simplices_join(mesh, n_facets, facets, err) : status;
}

/* The boundary's points first, then the others that simplices have. */
static void number_points(builder *b)
{
    enum { UNUSED, INNER, OUTER };
    iccp_simplices *mesh = b->mesh;
    const size_t n_corners = mesh->dim + 1;
    uint32_t n = 0;
    memset(b->number, 0, b->n_given * sizeof *b->number);
    for (size_t side = 0; side < n_corners * mesh->n_simplices; ++side)
        b->number[mesh->corners[side]] = INNER;
    for (size_t side = 0; side < n_corners * mesh->n_simplices; ++side)
        for (size_t i = 1; i < n_corners && (mesh->across[side] & ICCP_ON_BOUNDARY) != 0; ++i)
            b->number[mesh->corners[side - side % n_corners + (side + i) % n_corners]] = OUTER;
    for (size_t v = 0; v < b->n_given; ++v)
        mesh->n_boundary += b->number[v] == OUTER;
    uint32_t inner = (uint32_t)mesh->n_boundary;
    for (size_t v = 0; v < b->n_given; ++v) {
        const uint32_t kind = b->number[v];
        b->number[v] = kind == OUTER ? n++ : kind == INNER ? inner++ : NONE;
    }
    mesh->n_points = inner;
}

/* Moves points and corners to the new numbers. Points that no simplex has are dropped; the
 * others keep their order within the boundary and within the interior, so that a mesh that is
 * already in this order stays as it is. */
static icc_status renumber(builder *b)
{
    iccp_simplices *mesh = b->mesh;
    const size_t size = mesh->dim * sizeof *mesh->points;
    number_points(b);
    double *points = iccp_alloc(&mesh->memory, mesh->n_points, size);
    mesh->given = iccp_alloc(&mesh->memory, mesh->n_points, sizeof *mesh->given);
    b->boundary = iccp_alloc(&mesh->memory, mesh->n_boundary, size);
    if (points == NULL || mesh->given == NULL || b->boundary == NULL) {
        iccp_free(&mesh->memory, points);
        return ICC_ERR_MEMORY;
    }
    for (uint32_t v = 0; v < b->n_given; ++v) {
        const uint32_t to = b->number[v];
        if (to == NONE)
            continue;
        mesh->given[to] = v;
        memcpy(points + mesh->dim * to, mesh->points + mesh->dim * v, size);
        if (to < mesh->n_boundary)
            memcpy(b->boundary + mesh->dim * to, b->given + mesh->dim * v, size);
    }
    iccp_free(&mesh->memory, mesh->points);
    mesh->points = points;
    for (size_t side = 0; side < (mesh->dim + 1) * mesh->n_simplices; ++side)
        mesh->corners[side] = b->number[mesh->corners[side]];
    return ICC_OK;
}

/* Facets that the caller did not give have their points in ascending order as far as their
 * orientation allows. */
static icc_status list_facets(builder *b, const uint32_t *facets)
{
    const iccp_simplices *mesh = b->mesh;
    const size_t dim = mesh->dim;
    b->facets = iccp_alloc(&mesh->memory, mesh->n_facets, dim * sizeof *b->facets);
    if (b->facets == NULL)
        return ICC_ERR_MEMORY;
    if (facets != NULL) {
        for (size_t i = 0; i < dim * mesh->n_facets; ++i)
            b->facets[i] = b->number[facets[i]];
        return ICC_OK;
    }
    for (size_t side = 0; side < (dim + 1) * mesh->n_simplices; ++side) {
        if (!(mesh->across[side] & ICCP_ON_BOUNDARY))
            continue;
        uint32_t *to = b->facets + dim * (mesh->across[side] & ~ICCP_ON_BOUNDARY);
        iccp_simplices_side(mesh, side, to);
        if (iccp_sort_vertices(dim, to)) {
            const uint32_t swap = to[dim - 2];
            to[dim - 2] = to[dim - 1];
            to[dim - 1] = swap;
        }
    }
    return ICC_OK;
}

static icc_status build_mesh(builder *b, size_t n_facets, const uint32_t *facets,
                             const iccp_env *env, icc_error *err)
{
    icc_status status = check_mesh(b, n_facets, facets, env, err);
    if (status != ICC_OK)
        return status;
    status = iccp_progress(env, "check", 0.6);
    if (status == ICC_OK)
        status = renumber(b);
    if (status == ICC_OK)
        status = list_facets(b, facets);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    return iccp_simplices_check_shape(b->mesh, err);
}

/* An inner vertex that sticks out of the box of the boundary would need another frame; where
 * orientations are exact they have excluded it. */
static icc_status check_frame(const builder *b, const icc_domain *domain, icc_error *err)
{
    if (memcmp(&b->frame, &domain->frame, sizeof b->frame) == 0)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_BOUNDARY, "a vertex lies outside the boundary of the mesh");
}

icc_status iccp_domain_create_mesh(icc_domain **out, int32_t dim, size_t n_vertices,
                                   const double *vertices, size_t n_simplices,
                                   const uint32_t *simplices, size_t n_facets,
                                   const uint32_t *facets, const iccp_env *env, icc_error *err)
{
    builder b = {.given = vertices, .n_given = n_vertices};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){2, 1}, env);
    *out = NULL;
    icc_status status = iccp_explain(err, copy_mesh(&b, (size_t)dim, n_simplices, simplices, env));
    if (status == ICC_OK)
        status = build_mesh(&b, n_facets, facets, &part[0], err);
    if (status == ICC_OK)
        status = iccp_domain_create(out, dim, b.mesh->n_boundary, b.boundary, b.mesh->n_facets,
                                    b.facets, &part[1], err);
    if (status == ICC_OK)
        status = check_frame(&b, *out, err);
    if (status == ICC_OK) {
        (*out)->mesh = b.mesh;
        b.mesh = NULL;
    } else {
        iccp_domain_release(*out);
        *out = NULL;
    }
    iccp_free(&env->memory, b.number);
    iccp_free(&env->memory, b.boundary);
    iccp_free(&env->memory, b.facets);
    iccp_simplices_free(b.mesh);
    return status;
}
