/* libicc mesh --fill: fills a closed surface with tetrahedra. The mesh has the same vertices and
 * faces, and new vertices inside. */
#include "cmd/commands.h"

#include "base/allocate.h"
#include "job/job.h"
#include "job/output_name.h"

#include <stdlib.h>
#include <string.h>

typedef struct tetrahedra {
    size_t n_points, n_boundary, n, n_faces;
    double *points;
    uint32_t *corners, *faces;
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
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = m.n_points,
                     .vertices = m.points,
                     .n_cells = m.n,
                     .cells = m.corners};
    icc_domain_get_mesh(filled, &mesh);
    icc_domain_get_boundary(filled, NULL, m.faces);
    return m;
}

static void write_medit(const tetrahedra *m, FILE *out)
{
    fprintf(out, "MeshVersionFormatted 2\nDimension 3\nVertices\n%zu\n", m->n_points);
    for (size_t i = 0; i < m->n_points; i++)
        fprintf(out, "%.17g %.17g %.17g 0\n", m->points[3 * i], m->points[3 * i + 1],
                m->points[3 * i + 2]);
    fprintf(out, "Triangles\n%zu\n", m->n_faces);
    for (size_t i = 0; i < m->n_faces; i++)
        fprintf(out, "%lu %lu %lu 0\n", m->faces[3 * i] + 1UL, m->faces[3 * i + 1] + 1UL,
                m->faces[3 * i + 2] + 1UL);
    fprintf(out, "Tetrahedra\n%zu\n", m->n);
    for (size_t i = 0; i < m->n; i++)
        fprintf(out, "%lu %lu %lu %lu 0\n", m->corners[4 * i] + 1UL, m->corners[4 * i + 1] + 1UL,
                m->corners[4 * i + 2] + 1UL, m->corners[4 * i + 3] + 1UL);
    fprintf(out, "End\n");
}

static void write_vtk(const tetrahedra *m, FILE *out)
{
    fprintf(out, "# vtk DataFile Version 3.0\nlibicc\nASCII\nDATASET UNSTRUCTURED_GRID\n");
    fprintf(out, "POINTS %zu double\n", m->n_points);
    for (size_t i = 0; i < m->n_points; i++)
        fprintf(out, "%.17g %.17g %.17g\n", m->points[3 * i], m->points[3 * i + 1],
                m->points[3 * i + 2]);
    fprintf(out, "CELLS %zu %zu\n", m->n, 5 * m->n);
    for (size_t i = 0; i < m->n; i++)
        fprintf(out, "4 %lu %lu %lu %lu\n", (unsigned long)m->corners[4 * i],
                (unsigned long)m->corners[4 * i + 1], (unsigned long)m->corners[4 * i + 2],
                (unsigned long)m->corners[4 * i + 3]);
    fprintf(out, "CELL_TYPES %zu\n", m->n);
    for (size_t i = 0; i < m->n; i++)
        fprintf(out, "10\n");
}

/* Writes VTK if the name asks for it, else Medit. */
static int write_filled(const job *j, const icc_domain *filled)
{
    const char *name = j->args->operands[1], *format = output_format(name);
    outfile file;
    if (!outfile_open(&file, name))
        return FAILED;
    tetrahedra m = take_mesh(filled);
    if (format != NULL && strcmp(format, "VTK") == 0)
        write_vtk(&m, file.stream);
    else
        write_medit(&m, file.stream);
    const bool written = outfile_close(&file);
    if (written && strcmp(name, "-") != 0 && !j->args->quiet)
        printf("%zu tetrahedra, %zu vertices, %zu of them inside\n", m.n, m.n_points,
               m.n_points - m.n_boundary);
    free(m.points);
    free(m.corners);
    free(m.faces);
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
