/* Writes the mesh of a map: its simplices in the source, and the same ones in the target. */
#include "job/mesh_out.h"

#include "base/allocate.h"
#include "job/output_name.h"
#include "mesh/numbered_mesh.h"

#include <stdlib.h>

typedef struct map_mesh {
    icc_map_info info;
    double *points[2]; /* before and after */
    uint32_t *cells;
    uint32_t *regions; /* of each cell, from 0 */
} map_mesh;

static map_mesh take_mesh(const job *j)
{
    map_mesh m = {.info.size = sizeof m.info};
    icc_map_get_info(j->map, &m.info);
    const size_t dim = (size_t)m.info.dim;
    for (size_t k = 0; k < 2; k++)
        m.points[k] = need(m.info.n_vertices, dim * sizeof *m.points[k]);
    m.cells = need(m.info.n_simplices, (dim + 1) * sizeof *m.cells);
    m.regions = need(m.info.n_simplices, sizeof *m.regions);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = m.info.n_vertices,
                     .vertices = m.points[0],
                     .n_cells = m.info.n_simplices,
                     .cells = m.cells};
    icc_map_get_mesh(j->map, &mesh, m.points[1]);
    return m;
}

static int write_side(const char *name, const map_mesh *m, size_t side)
{
    outfile file;
    const numbered_mesh mesh = {.dim = (size_t)m->info.dim,
                                .n_points = m->info.n_vertices,
                                .n_cells = m->info.n_simplices,
                                .points = m->points[side],
                                .cells = m->cells,
                                .regions = m->regions};
    if (!outfile_open(&file, name))
        return FAILED;
    numbered_mesh_write(&mesh, output_format(name), file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

/* Points in the plane get the y of their side's file. */
static void flip(const job *j, map_mesh *m)
{
    for (size_t side = 0; side < 2; side++)
        if (j->cages[side].flipped)
            points_flip_y(m->info.n_vertices, m->points[side]);
}

bool mesh_out_is_wanted(const job *j)
{
    return j->args->mesh_out != NULL || j->args->target_mesh_out != NULL;
}

int mesh_out_check(job *j)
{
    int result = mesh_out_is_wanted(j) ? job_read_cages(j) : DONE;
    return result == DONE && mesh_out_is_wanted(j) && job_dim(j) != 2 && job_dim(j) != 3
               ? failed(j->args->source, 0,
                        "%zu dimension%s; --mesh-out writes triangles or tetrahedra", job_dim(j),
                        job_dim(j) == 1 ? "" : "s")
               : result;
}

int mesh_out_write(const job *j)
{
    const char *names[2] = {j->args->mesh_out, j->args->target_mesh_out};
    icc_map_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err, .index = -1};
    if (!mesh_out_is_wanted(j))
        return DONE;
    icc_map_get_info(j->map, &info);
    if (info.kind != ICC_MAP_MESH)
        return failed(j->args->source, 0, "no mesh map was found, so there is no mesh to write");
    map_mesh m = take_mesh(j);
    int result = icc_map_get_regions(j->map, m.regions, &err) == ICC_OK
                     ? DONE
                     : failed(j->args->source, 0, "%s", err.message);
    flip(j, &m);
    for (size_t k = 0; k < 2 && result == DONE; k++)
        if (names[k] != NULL)
            result = write_side(names[k], &m, k);
    free(m.points[0]);
    free(m.points[1]);
    free(m.cells);
    free(m.regions);
    return result;
}
