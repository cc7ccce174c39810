/* Medit text: https://www.ljll.fr/frey/publications/RT-0253.pdf */
#include "job/mesh_out.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

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
    for (size_t k = 0; k < 2; k++)
        m.points[k] = need(m.info.n_vertices, 3 * sizeof *m.points[k]);
    m.cells = need(m.info.n_simplices, 4 * sizeof *m.cells);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = m.info.n_vertices,
                     .vertices = m.points[0],
                     .n_cells = m.info.n_simplices,
                     .cells = m.cells};
    icc_map_get_mesh(j->map, &mesh, m.points[1]);
    m.regions = need(m.info.n_simplices, sizeof *m.regions);
    icc_map_get_regions(j->map, m.regions, NULL);
    return m;
}

static int write_side(const char *name, const map_mesh *m, const double *points)
{
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    fprintf(file.stream, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n",
            m->info.n_vertices);
    for (size_t i = 0; i < m->info.n_vertices; i++)
        fprintf(file.stream, "%.17g %.17g %.17g 0\n", points[3 * i], points[3 * i + 1],
                points[3 * i + 2]);
    fprintf(file.stream, "Tetrahedra\n%zu\n", m->info.n_simplices);
    for (size_t i = 0; i < m->info.n_simplices; i++) {
        const uint32_t *v = m->cells + 4 * i;
        fprintf(file.stream, "%lu %lu %lu %lu %lu\n", (unsigned long)v[0] + 1,
                (unsigned long)v[1] + 1, (unsigned long)v[2] + 1, (unsigned long)v[3] + 1,
                (unsigned long)m->regions[i] + 1);
    }
    fputs("End\n", file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}

bool mesh_out_is_wanted(const job *j)
{
    return j->args->mesh_out != NULL || j->args->target_mesh_out != NULL;
}

int mesh_out_check(job *j)
{
    int result = mesh_out_is_wanted(j) ? job_read_cages(j) : DONE;
    return result == DONE && mesh_out_is_wanted(j) && job_dim(j) != 3
               ? failed(j->args->source, 0,
                        "this is no surface in space; --mesh-out writes tetrahedra")
               : result;
}

int mesh_out_write(const job *j)
{
    const char *names[2] = {j->args->mesh_out, j->args->target_mesh_out};
    icc_map_info info = {.size = sizeof info};
    int result = DONE;
    if (!mesh_out_is_wanted(j))
        return DONE;
    icc_map_get_info(j->map, &info);
    if (info.kind != ICC_MAP_MESH)
        return failed(j->args->source, 0,
                      "no mesh map was found, so there are no tetrahedra to write");
    map_mesh m = take_mesh(j);
    for (size_t k = 0; k < 2 && result == DONE; k++)
        if (names[k] != NULL)
            result = write_side(names[k], &m, m.points[k]);
    free(m.points[0]);
    free(m.points[1]);
    free(m.cells);
    free(m.regions);
    return result;
}
