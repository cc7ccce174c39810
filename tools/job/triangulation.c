/* The mesh of a map as PROJ's method "tinshift" reads it: a triangulation file in JSON, version 1.1.
 * https://proj.org/en/stable/operations/transformations/tinshift.html */
#include "job/triangulation.h"

#include "base/allocate.h"

#include <stdlib.h>

/* Column by column, as "vertices_columns" and "triangles_columns" say. */
static void write_mesh(FILE *stream, const icc_map_info *info, const double *from, const double *to,
                       const uint32_t *triangles)
{
    fputs("{\n\"file_type\": \"triangulation_file\",\n\"format_version\": \"1.1\",\n", stream);
    fprintf(stream, "\"publisher\": \"libicc %s\",\n", icc_version());
    fputs("\"transformed_components\": [\"horizontal\"],\n\"fallback_strategy\": \"none\",\n"
          "\"vertices_columns\": [\"source_x\", \"source_y\", \"target_x\", \"target_y\"],\n"
          "\"triangles_columns\": [\"idx_vertex1\", \"idx_vertex2\", \"idx_vertex3\"],\n"
          "\"vertices\": [",
          stream);
    for (size_t i = 0; i < 2 * info->n_vertices; i += 2)
        fprintf(stream, "%s\n[%.17g, %.17g, %.17g, %.17g]", i > 0 ? "," : "", from[i], from[i + 1],
                to[i], to[i + 1]);
    fputs("],\n\"triangles\": [", stream);
    for (size_t i = 0; i < 3 * info->n_simplices; i += 3)
        fprintf(stream, "%s\n[%u, %u, %u]", i > 0 ? "," : "", (unsigned)triangles[i],
                (unsigned)triangles[i + 1], (unsigned)triangles[i + 2]);
    fputs("]\n}\n", stream);
}

int triangulation_check(job *j)
{
    return j->args->triangulation != NULL ? job_read_plane(j, "--triangulation") : DONE;
}

int triangulation_write(const job *j)
{
    icc_map_info info = {.size = sizeof info};
    outfile file;
    if (j->args->triangulation == NULL)
        return DONE;
    icc_map_get_info(j->map, &info);
    if (info.kind != ICC_MAP_MESH)
        return failed(j->args->source, 0,
                      "the map is not of kind mesh: its repair failed; without --triangulation its "
                      "curves map points");
    if (!outfile_open(&file, j->args->triangulation))
        return FAILED;
    double *from = need(info.n_vertices, 2 * sizeof *from),
           *to = need(info.n_vertices, 2 * sizeof *to);
    uint32_t *triangles = need(info.n_simplices, 3 * sizeof *triangles);
    icc_map_get_mesh(j->map, from, to, triangles);
    write_mesh(file.stream, &info, from, to, triangles);
    free(from);
    free(to);
    free(triangles);
    return outfile_close(&file) ? DONE : FAILED;
}
