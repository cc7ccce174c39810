/* libicc mesh --fill: fills a closed surface with tetrahedra. The mesh has the same vertices and
 * faces, and new vertices inside. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "job/job.h"
#include "job/output_name.h"
#include "mesh/numbered_mesh.h"

#include <stdlib.h>
#include <string.h>

typedef struct tetrahedra {
    size_t n_points, n_boundary, n, n_faces;
    double *points;
    uint32_t *corners, *faces, *regions;
} tetrahedra;

static tetrahedra take_mesh(const icc_domain *filled)
{
    icc_domain_info info = {.size = sizeof info};
    icc_domain_get_info(filled, &info);
    tetrahedra m = {.n_points = info.n_mesh_vertices,
                    .n_boundary = info.n_vertices,
                    .n = info.n_mesh_simplices,
                    .n_faces = info.n_facets};
    m.points = need(m.n_points, 3 * sizeof *m.points);
    m.corners = need(m.n, 4 * sizeof *m.corners);
    m.faces = need(m.n_faces, 3 * sizeof *m.faces);
    m.regions = need(m.n, sizeof *m.regions);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = m.n_points,
                     .vertices = m.points,
                     .n_cells = m.n,
                     .cells = m.corners};
    icc_domain_get_mesh(filled, &mesh);
    icc_domain_get_boundary(filled, NULL, m.faces);
    icc_domain_get_regions(filled, m.regions);
    return m;
}

/* Writes the format that the name asks for, else Medit. */
static int write_filled(const job *j, const icc_domain *filled)
{
    const char *name = j->args->operands[1];
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    tetrahedra m = take_mesh(filled);
    const numbered_mesh mesh = {3,         m.n_points, m.n,       m.points,
                                m.corners, m.regions,  m.n_faces, m.faces};
    numbered_mesh_write(&mesh, output_format(name), file.stream);
    const bool written = outfile_close(&file);
    if (written && strcmp(name, "-") != 0 && !j->args->quiet)
        printf("%zu tetrahedra, %zu vertices, %zu of them inside\n", m.n, m.n_points,
               m.n_points - m.n_boundary);
    free(m.points);
    free(m.corners);
    free(m.faces);
    free(m.regions);
    return written ? DONE : FAILED;
}

static int fill_surface(job *j)
{
    icc_error err = {.size = sizeof err, .index = -1};
    icc_domain *filled = NULL;
    if (job_dim(j) != 3 || j->cages[0].cells != NULL)
        return failed(j->args->source, 0,
                      "this is not a surface in space; only such a surface can be filled");
    const icc_status status = icc_domain_fill(&filled, j->domains[0], NULL, &j->env, &err);
    progress_end(&j->bar);
    err.side = 1;
    const int result = status == ICC_OK ? write_filled(j, filled) : job_failed(j, &err);
    icc_domain_free(filled);
    return result;
}

int run_fill(const args *a)
{
    args own = *a;
    job j;
    own.source = a->operands[0];
    job_start(&j, &own);
    int result = job_make_domains(&j);
    if (result == DONE)
        result = fill_surface(&j);
    job_end(&j);
    return result;
}
