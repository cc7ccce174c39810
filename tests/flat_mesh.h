/* Meshes by their arrays, for tests that have them apart: icc_mesh is filled in here. */
#ifndef FLAT_MESH_H
#define FLAT_MESH_H

#include <icc/icc.h>

/* The library reads it only. */
static inline icc_mesh flat_mesh(int32_t dim, size_t n_vertices, const double *vertices,
                                 size_t n_simplices, const uint32_t *simplices)
{
    icc_mesh mesh = {0};
    mesh.size = sizeof mesh;
    mesh.dim = dim;
    mesh.n_vertices = n_vertices;
    mesh.vertices = (double *)(uintptr_t)vertices;
    mesh.n_cells = n_simplices;
    mesh.cells = (uint32_t *)(uintptr_t)simplices;
    return mesh;
}

static inline int32_t flat_dim(const icc_map *map)
{
    icc_map_info info = {0};
    info.size = sizeof info;
    return icc_map_get_info(map, &info) == ICC_OK ? info.dim : 2;
}

static inline icc_status flat_create_mesh(icc_domain **out, int32_t dim, size_t n_vertices,
                                          const double *vertices, size_t n_simplices,
                                          const uint32_t *simplices, size_t n_facets,
                                          const uint32_t *facets, const icc_env *env,
                                          icc_error *err)
{
    const icc_mesh mesh = flat_mesh(dim, n_vertices, vertices, n_simplices, simplices);
    return icc_domain_create_mesh(out, &mesh, n_facets, facets, env, err);
}

static inline icc_status flat_certify(const icc_map *map, size_t n_vertices, const double *vertices,
                                      size_t n_simplices, const uint32_t *simplices, double *images,
                                      icc_certificate *certificate, const icc_env *env,
                                      icc_error *err)
{
    const icc_mesh mesh = flat_mesh(flat_dim(map), n_vertices, vertices, n_simplices, simplices);
    return icc_map_certify(map, &mesh, images, certificate, env, err);
}

static inline icc_status flat_repair(const icc_map *map, size_t n_vertices, const double *vertices,
                                     size_t n_simplices, const uint32_t *simplices, double *images,
                                     icc_certificate *certificate, const icc_env *env,
                                     icc_error *err)
{
    const icc_mesh mesh = flat_mesh(flat_dim(map), n_vertices, vertices, n_simplices, simplices);
    return icc_map_repair(map, &mesh, images, certificate, env, err);
}

/* Any of the arrays may be NULL; the caller knows their lengths. */
static inline icc_status flat_get_mesh(const icc_map *map, double *vertices, double *images,
                                       uint32_t *simplices)
{
    icc_mesh mesh = {0};
    mesh.size = sizeof mesh;
    const icc_status status = icc_map_get_mesh(map, &mesh, NULL);
    mesh.vertices = vertices;
    mesh.cells = simplices;
    return status == ICC_OK ? icc_map_get_mesh(map, &mesh, images) : status;
}

static inline icc_status flat_domain_mesh(const icc_domain *domain, double *vertices,
                                          uint32_t *simplices)
{
    icc_mesh mesh = {0};
    mesh.size = sizeof mesh;
    const icc_status status = icc_domain_get_mesh(domain, &mesh);
    mesh.vertices = vertices;
    mesh.cells = simplices;
    return status == ICC_OK ? icc_domain_get_mesh(domain, &mesh) : status;
}

#endif
