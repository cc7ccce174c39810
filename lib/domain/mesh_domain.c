/* Makes domains from meshes. Up to 3-D, these checks suffice. All simplices are positive and induce
 * opposite orientations on common facets. So as many simplices cover a point as the boundary winds
 * around it. The boundary is simple, so the number is one inside and zero outside. */
#include "domain/mesh_domain.h"

#include "base/error.h"
#include "domain/mesh_regions.h"
#include "domain/simplicial.h"
#include "domain/solid_domain.h"
#include "domain/solid_mesh.h"
#include "geometry/tuples.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct builder {
    const double *given; /* the caller's points */
    size_t n_given;
    iccp_simplices *mesh; /* has the caller's numbers until renumber() */
    iccp_frame frame;
    uint32_t *number; /* n_given: new number of each of the caller's points, or NONE */
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

/* Checks simplices one by one, then pairs of them across their common facets. */
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

/* Numbers the boundary's points first, then the other points of simplices. */
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

/* Moves points and corners to the new numbers. Points without simplices are dropped. The others
 * keep their order within the boundary and within the interior. So a mesh that is already in this
 * order does not change. */
static icc_status renumber(builder *b)
{
    iccp_simplices *mesh = b->mesh;
    const size_t size = mesh->dim * sizeof *mesh->points;
    number_points(b);
    double *points = iccp_alloc(&mesh->memory, mesh->n_points, size);
    mesh->given = iccp_alloc(&mesh->memory, mesh->n_points, sizeof *mesh->given);
    if (points == NULL || mesh->given == NULL) {
        iccp_free(&mesh->memory, points);
        return ICC_ERR_MEMORY;
    }
    for (uint32_t v = 0; v < b->n_given; ++v) {
        const uint32_t to = b->number[v];
        if (to == NONE)
            continue;
        mesh->given[to] = v;
        memcpy(points + mesh->dim * to, mesh->points + mesh->dim * v, size);
    }
    iccp_free(&mesh->memory, mesh->points);
    mesh->points = points;
    for (size_t side = 0; side < (mesh->dim + 1) * mesh->n_simplices; ++side)
        mesh->corners[side] = b->number[mesh->corners[side]];
    return ICC_OK;
}

icc_status iccp_mesh_read(iccp_simplices **out, iccp_frame *frame, size_t dim, size_t n_vertices,
                          const double *vertices, size_t n_simplices, const uint32_t *simplices,
                          size_t n_facets, const uint32_t *facets, const iccp_env *env,
                          icc_error *err)
{
    builder b = {.given = vertices, .n_given = n_vertices};
    icc_status status = iccp_explain(err, copy_mesh(&b, dim, n_simplices, simplices, env));
    if (status == ICC_OK)
        status = check_mesh(&b, n_facets, facets, env, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_progress(env, "check", 0.6));
    if (status == ICC_OK)
        status = iccp_explain(err, renumber(&b));
    iccp_free(&env->memory, b.number);
    if (status != ICC_OK) {
        iccp_simplices_free(b.mesh);
        b.mesh = NULL;
    }
    *out = b.mesh;
    *frame = b.frame;
    return status;
}

/* ---- domains ---- */

/* Lists the boundary's points as the caller gave them. */
static double *list_points(const iccp_simplices *mesh, const double *given)
{
    const size_t size = mesh->dim * sizeof *given;
    double *points = iccp_alloc(&mesh->memory, mesh->n_boundary, size);
    for (size_t v = 0; points != NULL && v < mesh->n_boundary; ++v)
        memcpy(points + mesh->dim * v, given + mesh->dim * mesh->given[v], size);
    return points;
}

/* Returns the new number of a boundary point. */
static uint32_t number_of(const iccp_simplices *mesh, uint32_t given)
{
    size_t low = 0, high = mesh->n_boundary;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (mesh->given[middle] <= given)
            low = middle;
        else
            high = middle;
    }
    return (uint32_t)low;
}

/* Lists the boundary's facets in the new numbers. If the caller gave no facets, the points of each
 * are ascending as far as the orientation allows. */
static uint32_t *list_facets(const iccp_simplices *mesh, const uint32_t *given)
{
    const size_t dim = mesh->dim;
    uint32_t *facets = iccp_alloc(&mesh->memory, mesh->n_facets, dim * sizeof *facets);
    for (size_t i = 0; facets != NULL && given != NULL && i < dim * mesh->n_facets; ++i)
        facets[i] = number_of(mesh, given[i]);
    if (facets == NULL || given != NULL)
        return facets;
    for (size_t side = 0; side < (dim + 1) * mesh->n_simplices; ++side) {
        if (!(mesh->across[side] & ICCP_ON_BOUNDARY))
            continue;
        uint32_t *to = facets + dim * (mesh->across[side] & ~ICCP_ON_BOUNDARY);
        iccp_simplices_side(mesh, side, to);
        if (iccp_sort_vertices(dim, to)) {
            const uint32_t swap = to[dim - 2];
            to[dim - 2] = to[dim - 1];
            to[dim - 1] = swap;
        }
    }
    return facets;
}

/* Returns an error if an inner vertex lies outside the boundary's box and would need another frame.
 * Where orientations are exact, they have excluded that already. */
static icc_status check_frame(const iccp_frame *frame, const icc_domain *domain, icc_error *err)
{
    if (memcmp(frame, &domain->frame, sizeof *frame) == 0)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_BOUNDARY, "a vertex lies outside the boundary of the mesh");
}

/* Makes a domain of a mesh that was read, with the boundary of these points and facets. Takes over
 * the mesh, also if it fails. */
static icc_status create_plain(icc_domain **out, iccp_simplices *mesh, const iccp_frame *frame,
                               const double *points, const uint32_t *facets, const iccp_env *env,
                               icc_error *err)
{
    icc_status status = iccp_domain_create(out, (int32_t)mesh->dim, mesh->n_boundary, points,
                                           mesh->n_facets, facets, env, err);
    if (status == ICC_OK)
        status = check_frame(frame, *out, err);
    if (status == ICC_OK)
        (*out)->mesh = mesh;
    else {
        iccp_simplices_free(mesh);
        iccp_domain_release(*out);
        *out = NULL;
    }
    return status;
}

/* Does the same with surfaces between regions. */
static icc_status create_divided(icc_domain **out, iccp_simplices *mesh, const iccp_frame *frame,
                                 const iccp_outer *outer, const iccp_region_surfaces *surfaces,
                                 const iccp_env *env, icc_error *err)
{
    icc_domain *solid;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status =
        iccp_domain_create_solid(&solid, outer, surfaces->n, surfaces->features, &part[0], err);
    if (status == ICC_OK)
        status = check_frame(frame, solid, err);
    if (status == ICC_OK)
        status = iccp_domain_create_solid_mesh(out, solid, mesh, &part[1], err);
    else
        iccp_simplices_free(mesh);
    iccp_domain_release(solid);
    return status;
}

/* Takes over the mesh, also if it fails. */
static icc_status create(icc_domain **out, iccp_simplices *mesh, const iccp_frame *frame,
                         const icc_mesh *given, const uint32_t *facets, const iccp_env *env,
                         icc_error *err)
{
    iccp_region_surfaces surfaces = {.memory = mesh->memory};
    icc_status status = ICC_OK;
    double *points = list_points(mesh, given->vertices);
    uint32_t *own = list_facets(mesh, facets);
    if (points == NULL || own == NULL)
        status = iccp_fail_memory(err);
    if (status == ICC_OK && given->regions != NULL)
        status = iccp_region_surfaces_create(&surfaces, mesh, given->regions, given->vertices, err);
    const iccp_outer outer = {mesh->n_boundary, mesh->n_facets, points, own};
    if (status != ICC_OK)
        iccp_simplices_free(mesh);
    else if (surfaces.n > 0)
        status = create_divided(out, mesh, frame, &outer, &surfaces, env, err);
    else
        status = create_plain(out, mesh, frame, points, own, env, err);
    iccp_region_surfaces_free(&surfaces);
    iccp_free(&env->memory, points);
    iccp_free(&env->memory, own);
    return status;
}

icc_status iccp_domain_create_mesh(icc_domain **out, const icc_mesh *mesh, size_t n_facets,
                                   const uint32_t *facets, const iccp_env *env, icc_error *err)
{
    iccp_simplices *own;
    iccp_frame frame;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){2, 1}, env);
    *out = NULL;
    icc_status status =
        iccp_mesh_read(&own, &frame, (size_t)mesh->dim, mesh->n_vertices, mesh->vertices,
                       mesh->n_cells, mesh->cells, n_facets, facets, &part[0], err);
    if (status == ICC_OK)
        status = iccp_simplices_check_shape(own, err);
    if (status == ICC_OK)
        return create(out, own, &frame, mesh, facets, &part[1], err);
    iccp_simplices_free(own);
    return status;
}
