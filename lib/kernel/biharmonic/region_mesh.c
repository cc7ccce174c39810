/* Triangulates a region with all its vertices. */
#include "kernel/biharmonic/region_mesh.h"

#include "base/error.h"
#include "mesh/triangulate.h"

#include <string.h>

typedef struct selection {
    uint32_t *number; /* by vertex of all regions: its number in the mesh, or ICCP_NOWHERE */
    uint32_t *pairs;  /* ends of walls, by numbers in the mesh */
    size_t n_walls;
} selection;

static bool bounds(const iccp_region_vertices *v, const uint32_t *parent, uint32_t region, size_t k)
{
    return v->owner[k] == region || parent[v->owner[k]] == region;
}

/* Numbers the vertices of the region and on its walls, in rising order. */
static void choose(iccp_region_mesh *mesh, selection *s, const iccp_region_vertices *v,
                   const uint32_t *parent, uint32_t region)
{
    memset(s->number, 0xff, v->n * sizeof *s->number);
    for (size_t k = 0; k < v->n_pieces; ++k)
        for (size_t e = 0; e < 2 && bounds(v, parent, region, k); ++e)
            s->number[v->pieces[2 * k + e]] = 0;
    for (size_t i = 0; i < v->n; ++i) {
        if (s->number[i] == ICCP_NOWHERE && v->region[i] != region)
            continue;
        s->number[i] = (uint32_t)mesh->n;
        mesh->vertex[mesh->n] = (uint32_t)i;
        memcpy(mesh->points + 2 * mesh->n++, v->points + 2 * i, 2 * sizeof *v->points);
    }
}

static void copy_walls(selection *s, const iccp_region_vertices *v, const uint32_t *parent,
                       uint32_t region)
{
    for (size_t k = 0; k < v->n_pieces; ++k)
        if (bounds(v, parent, region, k)) {
            s->pairs[2 * s->n_walls] = s->number[v->pieces[2 * k]];
            s->pairs[2 * s->n_walls++ + 1] = s->number[v->pieces[2 * k + 1]];
        }
}

static icc_status triangulate(iccp_region_mesh *mesh, const selection *s, uint32_t region,
                              const iccp_env *env, icc_error *err)
{
    iccp_walls walls;
    icc_status status = iccp_walls_create(&walls, mesh->n, s->n_walls, s->pairs, &mesh->memory);
    if (status != ICC_OK)
        return iccp_fail_memory(err);
    mesh->triangles = iccp_alloc(&mesh->memory, mesh->n, 6 * sizeof *mesh->triangles);
    mesh->twins = iccp_alloc(&mesh->memory, mesh->n, 6 * sizeof *mesh->twins);
    status = ICC_ERR_MEMORY;
    if (mesh->triangles != NULL && mesh->twins != NULL)
        status = iccp_triangulate_walls(mesh->n, mesh->points, &walls, &walls, mesh->triangles,
                                        mesh->twins, &mesh->n_triangles, env);
    iccp_walls_free(&walls, &mesh->memory);
    if (status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE || status == ICC_ERR_ARGUMENT ||
        status == ICC_ERR_TOPOLOGY)
        return iccp_fail_at(err, ICC_ERR_RESOLUTION, ICC_ITEM_REGION, region,
                            "walls of region %lu are so close that rounded points on them touch",
                            (unsigned long)region);
    return iccp_explain(err, status);
}

icc_status iccp_region_mesh_create(iccp_region_mesh *mesh, const iccp_region_vertices *vertices,
                                   const uint32_t *parent, uint32_t region, const iccp_env *env,
                                   icc_error *err)
{
    const iccp_memory *memory = &env->memory;
    *mesh = (iccp_region_mesh){.memory = *memory};
    selection s = {0};
    s.number = iccp_alloc(memory, vertices->n, sizeof *s.number);
    s.pairs = iccp_alloc(memory, vertices->n_pieces, 2 * sizeof *s.pairs);
    mesh->vertex = iccp_alloc(memory, vertices->n, sizeof *mesh->vertex);
    mesh->points = iccp_alloc(memory, vertices->n, 2 * sizeof *mesh->points);
    icc_status status = ICC_OK;
    if (s.number == NULL || s.pairs == NULL || mesh->vertex == NULL || mesh->points == NULL)
        status = iccp_fail_memory(err);
    if (status == ICC_OK) {
        choose(mesh, &s, vertices, parent, region);
        copy_walls(&s, vertices, parent, region);
        status = triangulate(mesh, &s, region, env, err);
    }
    iccp_free(memory, s.number);
    iccp_free(memory, s.pairs);
    if (status != ICC_OK)
        iccp_region_mesh_free(mesh);
    return status;
}

void iccp_region_mesh_free(iccp_region_mesh *mesh)
{
    iccp_free(&mesh->memory, mesh->points);
    iccp_free(&mesh->memory, mesh->vertex);
    iccp_free(&mesh->memory, mesh->triangles);
    iccp_free(&mesh->memory, mesh->twins);
    *mesh = (iccp_region_mesh){.memory = mesh->memory};
}
