/* Writes the mesh of a map as PROJ's method "tinshift" reads it: a triangulation file in JSON,
 * version 1.1. https://proj.org/en/stable/operations/transformations/tinshift.html */
#include "job/triangulation.h"

#include "base/allocate.h"
#include "base/json.h"
#include "job/axis_order.h"
#include "job/option_table.h"

#include <stdlib.h>

/* Takes two counts. The remedy works because coordinates near the origin are not rounded. */
#define SPOILT                                                                                     \
    "%zu of %zu triangles are flat or reversed when their numbers are rounded to doubles, "        \
    "because "                                                                                     \
    "the shape is so far from the origin; shift source and target to the origin"

typedef struct map_mesh {
    icc_map_info info;
    double *from, *to; /* vertices, with y as the cages' files have it */
    uint32_t *triangles;
} map_mesh;

static map_mesh take_mesh(const icc_map *map, const cage *cages)
{
    map_mesh m = {.info.size = sizeof m.info};
    icc_map_get_info(map, &m.info);
    m.from = need(m.info.n_vertices, 2 * sizeof *m.from);
    m.to = need(m.info.n_vertices, 2 * sizeof *m.to);
    m.triangles = need(m.info.n_simplices, 3 * sizeof *m.triangles);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = m.info.n_vertices,
                     .vertices = m.from,
                     .n_cells = m.info.n_simplices,
                     .cells = m.triangles};
    icc_map_get_mesh(map, &mesh, m.to);

    if (cages[0].flipped)
        points_flip_y(m.info.n_vertices, m.from);
    if (cages[1].flipped)
        points_flip_y(m.info.n_vertices, m.to);
    return m;
}

static void write_crs(FILE *stream, const char *member, const char *crs)
{
    if (crs == NULL)
        return;
    fprintf(stream, "\"%s\": ", member);
    json_string(stream, crs);
    fputs(",\n", stream);
}

static size_t count_spoilt(const job *j, size_t *n_all)
{
    icc_map_info info = {.size = sizeof info};
    icc_map_report made = {.size = sizeof made};
    icc_map_get_info(j->map, &info);
    icc_map_get_report(j->map, &made);
    *n_all = info.n_simplices;
    return made.n_spoilt;
}

/* Writes the columns that "vertices_columns" and "triangles_columns" name. */
static void write_mesh(FILE *stream, const args *a, const map_mesh *m)
{
    const char *comma = "";
    fputs("{\n\"file_type\": \"triangulation_file\",\n\"format_version\": \"1.1\",\n", stream);
    fprintf(stream, "\"publisher\": \"libicc %s\",\n", icc_version());
    write_crs(stream, "input_crs", a->source_crs);
    write_crs(stream, "output_crs", a->target_crs);
    fprintf(stream,
            "\"transformed_components\": [\"horizontal\"],\n\"fallback_strategy\": \"%s\",\n",
            a->fallback != 0 ? choice_name(fallbacks, a->fallback) : "none");
    fputs("\"vertices_columns\": [\"source_x\", \"source_y\", \"target_x\", \"target_y\"],\n"
          "\"triangles_columns\": [\"idx_vertex1\", \"idx_vertex2\", \"idx_vertex3\"],\n"
          "\"vertices\": [",
          stream);
    for (size_t i = 0; i < 2 * m->info.n_vertices; i += 2, comma = ",")
        fprintf(stream, "%s\n[%.17g, %.17g, %.17g, %.17g]", comma, m->from[i], m->from[i + 1],
                m->to[i], m->to[i + 1]);
    fputs("],\n\"triangles\": [", stream);
    comma = "";
    for (size_t i = 0; i < 3 * m->info.n_simplices; i += 3, comma = ",")
        fprintf(stream, "%s\n[%u, %u, %u]", comma, (unsigned)m->triangles[i],
                (unsigned)m->triangles[i + 1], (unsigned)m->triangles[i + 2]);
    fputs("]\n}\n", stream);
}

/* Prints a remark if a system has y first, or may have. The file has x first. Programs that follow
 * the system's order of axes must then swap coordinates before and after it. */
static void note_axes(const args *a)
{
    static const char swap[] = " +step +proj=axisswap +order=2,1";
    const char *crs[] = {a->source_crs, a->target_crs};
    bool first[2], unknown[2];
    for (int k = 0; k < 2; k++) {
        axis_order order = crs[k] != NULL ? axis_order_of(crs[k]) : AXES_EAST_FIRST;
        first[k] = order == AXES_NORTH_FIRST;
        unknown[k] = order == AXES_UNKNOWN;
    }
    for (int k = 0; k < 2; k++)
        if (unknown[k])
            note("%s: libicc does not know the order of the axes of %s; if latitude or northing "
                 "comes "
                 "first, GDAL's -ct needs '%s' %s the step tinshift",
                 a->triangulation, crs[k], swap + 1, k == 0 ? "before" : "after");
    if (first[0] || first[1])
        note("%s: x comes first, but in %s%s%s latitude or northing does; GDAL's -ct needs "
             "'+proj=pipeline%s +step +proj=tinshift +file=%s%s'",
             a->triangulation, first[0] ? crs[0] : crs[1], first[0] && first[1] ? " and " : "",
             first[0] && first[1] ? crs[1] : "", first[0] ? swap : "", a->triangulation,
             first[1] ? swap : "");
}

int triangulation_check(job *j)
{
    return j->args->triangulation != NULL ? job_read_plane(j, "--triangulation") : DONE;
}

static bool is_mesh(const job *j)
{
    icc_map_info info = {.size = sizeof info};
    icc_map_get_info(j->map, &info);
    return info.kind == ICC_MAP_MESH;
}

int triangulation_write(const job *j)
{
    outfile file;
    if (j->args->triangulation == NULL)
        return DONE;
    if (!is_mesh(j))
        return failed(j->args->source, 0,
                      "no mesh map was found, so there are no triangles to write; without "
                      "--triangulation a curve map moves the points");
    size_t n_all, n_spoilt = count_spoilt(j, &n_all);
    if (n_spoilt > 0 && j->args->require != 0)
        return failed(j->args->triangulation, 0, SPOILT ", so nothing is written", n_spoilt, n_all);
    if (!outfile_open(&file, j->args->triangulation))
        return FAILED;
    map_mesh mesh = take_mesh(j->map, j->cages);
    write_mesh(file.stream, j->args, &mesh);
    free(mesh.from);
    free(mesh.to);
    free(mesh.triangles);
    if (!outfile_close(&file))
        return FAILED;
    note_axes(j->args);
    return DONE;
}

int triangulation_tell(const job *j)
{
    size_t n_all, n = j->args->triangulation != NULL ? count_spoilt(j, &n_all) : 0;
    if (n == 0)
        return DONE;
    note("%s: " SPOILT, j->args->triangulation, n, n_all);
    return PARTIAL;
}
