/* Reads and writes the mesh of a harmonic chart. Format: docs/reference/formats.md. */
#include "foliation/harmonic_file.h"

#include "domain/domain_file.h"
#include "foliation/certificate.h"
#include "geometry/polygon_check.h"
#include "mesh/corners.h"

#include <string.h>

/* Checks the numbers of pieces. Euler's formula gives the number of boundary edges from the
 * inner vertices and triangles, whose bytes are known to be there. */
static bool are_pieces(const uint32_t *pieces, const icc_domain *domain, size_t n_inner,
                       size_t n_triangles)
{
    uint64_t n_boundary = 0;
    for (size_t f = 0; f < domain->n_facets; ++f) {
        if (pieces[f] == 0)
            return false;
        n_boundary += pieces[f];
    }
    return n_boundary + 2 * n_inner == (uint64_t)n_triangles + 2 &&
           3 * (uint64_t)n_triangles < UINT32_MAX;
}

/* Boundary points are not saved, because the cuts of the facets determine them. Neither are
 * twins, because the triangles determine them. */
static icc_status visit(iccp_blob *b, int32_t *cells, iccp_planar *mesh, const icc_domain *domain,
                        const iccp_env *env)
{
    size_t n_inner = mesh->n_vertices - mesh->n_boundary, n_triangles = mesh->n_triangles;
    uint32_t *pieces = mesh->pieces;
    iccp_blob_i32(b, ICCP_U64, 1, ICCP_MAX_CELLS, cells);
    iccp_blob_count(b, 2 * ICCP_F64, &n_inner);
    iccp_blob_count(b, 3 * ICCP_U32, &n_triangles);
    iccp_blob_array_u32(b, domain->n_facets, &pieces);
    icc_status status = b->status;
    if (b->reads && status == ICC_OK)
        status = are_pieces(pieces, domain, n_inner, n_triangles)
                     ? iccp_planar_begin(mesh, domain, pieces, n_inner, n_triangles, env)
                     : ICC_ERR_FORMAT;
    if (b->reads)
        iccp_free(&b->memory, pieces);
    if (status != ICC_OK)
        return status;
    iccp_blob_f64(b, 2 * n_inner, mesh->points + 2 * mesh->n_boundary);
    iccp_blob_u32(b, 3 * n_triangles, mesh->triangles);
    return b->status;
}

static bool names_vertices(const iccp_planar *mesh)
{
    for (size_t c = 0; c < 3 * mesh->n_triangles; ++c)
        if (mesh->triangles[c] >= mesh->n_vertices)
            return false;
    return true;
}

static icc_status certify(const iccp_planar *mesh, const iccp_env *env)
{
    const iccp_frame frame = iccp_frame_identity();
    iccp_certificate certificate = {0};
    iccp_certify_mesh(mesh, mesh->points, &certificate);
    return iccp_certificate_holds(&certificate)
               ? iccp_polygon_check_points(mesh->n_boundary, mesh->points, NULL, &frame, env, NULL)
               : ICC_ERR_FORMAT;
}

/* Completes a mesh after its points and triangles have been read. */
static icc_status finish(iccp_planar *mesh, const iccp_env *env)
{
    const size_t n_inner = mesh->n_vertices - mesh->n_boundary;
    bool is_manifold = false;
    if (!iccp_are_local(2, 2 * n_inner, mesh->points + 2 * mesh->n_boundary) ||
        !names_vertices(mesh))
        return ICC_ERR_FORMAT;
    iccp_corners corners = {mesh->triangles, mesh->twins, mesh->n_triangles};
    icc_status status = iccp_find_twins(&corners, mesh->n_vertices, &is_manifold, env);
    if (status == ICC_OK)
        status = is_manifold ? certify(mesh, env) : ICC_ERR_FORMAT;
    if (status == ICC_OK)
        iccp_planar_list_boundary(mesh);
    return status;
}

void iccp_harmonic_write(int32_t cells, const iccp_planar *mesh, const icc_domain *domain,
                         iccp_blob *b)
{
    iccp_planar copy = *mesh;
    (void)visit(b, &cells, &copy, domain, NULL);
}

icc_status iccp_harmonic_read(iccp_harmonic *base, const icc_domain *domain, iccp_blob *b,
                              const iccp_env *env)
{
    memset(base, 0, sizeof *base);
    base->mesh.memory = env->memory;
    icc_status status = visit(b, &base->cells, &base->mesh, domain, env);
    if (status == ICC_OK)
        status = finish(&base->mesh, env);
    if (status != ICC_OK)
        iccp_harmonic_free(base);
    return status;
}
