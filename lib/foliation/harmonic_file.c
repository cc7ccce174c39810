#include "foliation/harmonic_file.h"

#include "domain/domain_file.h"
#include "domain/polygon_check.h"
#include "foliation/certificate.h"
#include "mesh/corners.h"

#include <string.h>

/* Points on the boundary follow from how its facets are cut, twins from the triangles. */
void iccp_harmonic_write(int32_t cells, const iccp_planar *mesh, const icc_domain *domain,
                         iccp_blob_writer *w)
{
    const size_t n_inner = mesh->n_vertices - mesh->n_boundary;
    iccp_blob_u64(w, (uint64_t)cells);
    iccp_blob_u64(w, n_inner);
    iccp_blob_u64(w, mesh->n_triangles);
    iccp_blob_u32(w, domain->n_facets, mesh->pieces);
    iccp_blob_f64(w, 2 * n_inner, mesh->points + 2 * mesh->n_boundary);
    iccp_blob_u32(w, 3 * mesh->n_triangles, mesh->triangles);
}

/* Euler's formula ties the number of boundary edges to those whose bytes are there. */
static bool read_pieces(uint32_t *pieces, const icc_domain *domain, size_t n_inner,
                        size_t n_triangles, iccp_blob_reader *r)
{
    uint64_t n_boundary = 0;
    iccp_blob_read_u32(r, domain->n_facets, pieces);
    for (size_t f = 0; f < domain->n_facets; ++f) {
        if (pieces[f] == 0)
            return false;
        n_boundary += pieces[f];
    }
    return !r->failed && n_boundary + 2 * n_inner == (uint64_t)n_triangles + 2 &&
           3 * (uint64_t)n_triangles < UINT32_MAX;
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
    iccp_certificate certificate = {0};
    iccp_certify_mesh(mesh, mesh->points, &certificate);
    return iccp_certificate_holds(&certificate)
               ? iccp_polygon_check_points(mesh->n_boundary, mesh->points, NULL, env)
               : ICC_ERR_FORMAT;
}

static icc_status fill(iccp_planar *mesh, iccp_blob_reader *r, const iccp_env *env)
{
    const size_t n_inner = mesh->n_vertices - mesh->n_boundary;
    double *inner = mesh->points + 2 * mesh->n_boundary;
    bool is_manifold = false;
    iccp_blob_read_f64(r, 2 * n_inner, inner);
    iccp_blob_read_u32(r, 3 * mesh->n_triangles, mesh->triangles);
    if (r->failed || !iccp_are_local(2, 2 * n_inner, inner) || !names_vertices(mesh))
        return ICC_ERR_FORMAT;
    iccp_corners corners = {mesh->triangles, mesh->twins, mesh->n_triangles};
    icc_status status = iccp_find_twins(&corners, mesh->n_vertices, &is_manifold, env);
    if (status == ICC_OK)
        status = is_manifold ? certify(mesh, env) : ICC_ERR_FORMAT;
    if (status == ICC_OK)
        iccp_planar_list_rim(mesh);
    return status;
}

static icc_status read_mesh(iccp_planar *mesh, const icc_domain *domain, iccp_blob_reader *r,
                            const iccp_env *env)
{
    const size_t n_inner = iccp_blob_read_count(r, 2 * ICCP_F64);
    const size_t n_triangles = iccp_blob_read_count(r, 3 * ICCP_U32);
    uint32_t *pieces = iccp_alloc(&env->memory, domain->n_facets, sizeof *pieces);
    if (pieces == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = ICC_ERR_FORMAT;
    if (read_pieces(pieces, domain, n_inner, n_triangles, r))
        status = iccp_planar_begin(mesh, domain, pieces, n_inner, n_triangles, env);
    iccp_free(&env->memory, pieces);
    return status == ICC_OK ? fill(mesh, r, env) : status;
}

icc_status iccp_harmonic_read(iccp_harmonic *base, const icc_domain *domain, iccp_blob_reader *r,
                              const iccp_env *env)
{
    const uint64_t cells = iccp_blob_read_u64(r);
    memset(base, 0, sizeof *base);
    base->mesh.memory = env->memory;
    if (cells < 1 || cells > ICCP_MAX_CELLS)
        return ICC_ERR_FORMAT;
    base->cells = (int32_t)cells;
    const icc_status status = read_mesh(&base->mesh, domain, r, env);
    if (status != ICC_OK)
        iccp_harmonic_free(base);
    return status;
}
