/* Reads the ties of a map from the library and writes them as GeoJSON. */
#include "job/ties_file.h"

#include "base/allocate.h"
#include "cage/cage_features.h"
#include "job/cage_file.h"

#include <stdlib.h>
#include <string.h>

size_t ties_of_map(const icc_map *map, const icc_domain *domain, int side, cage_feature **ties)
{
    icc_map_info info = {.size = sizeof info};
    icc_domain_info shape = {.size = sizeof shape};
    icc_map_get_info(map, &info);
    icc_domain_get_info(domain, &shape);
    double *vertices = need(shape.n_vertices, 2 * sizeof *vertices);
    icc_domain_get_boundary(domain, vertices, NULL);
    *ties = need(info.n_ties, sizeof **ties);
    size_t n_ties = 0;
    for (size_t i = 0; i < info.n_ties; i++) {
        icc_tie_info tie = {.size = sizeof tie};
        if (icc_map_get_tie(map, i, &tie, NULL, NULL) != ICC_OK)
            continue; /* one of its ends has slid */
        size_t n = 2 + (side == 1 ? tie.n_source : tie.n_target);
        double *points = need(n, 2 * sizeof *points);
        icc_map_get_tie(map, i, &tie, side == 1 ? points + 2 : NULL, side == 2 ? points + 2 : NULL);
        memcpy(points, vertices + 2 * (size_t)tie.vertex[0], 2 * sizeof *points);
        memcpy(points + 2 * (n - 1), vertices + 2 * (size_t)tie.vertex[1], 2 * sizeof *points);
        (*ties)[n_ties++] =
            (cage_feature){.kind = CAGE_TIE, .number = (int64_t)i + 1, .n = n, .points = points};
    }
    free(vertices);
    return n_ties;
}

void ties_free(size_t n, cage_feature *ties)
{
    for (size_t i = 0; i < n; i++)
        free(ties[i].points);
    free(ties);
}

int ties_check(job *j)
{
    if (j->args->ties == NULL)
        return DONE;
    int result = job_read_plane(j, "--ties");
    if (result == DONE && cage_circles(&j->cages[0]) > 0)
        return failed(j->args->source, 0, "points with a radius cannot be combined with ties");
    return result == DONE && j->cages[0].n_features == 0
               ? failed(j->args->source, 0,
                        "nothing lies inside the cage, so there are no ties to write")
               : result;
}

/* ------------------------------------------------------------------ writing */

static void write_side(FILE *stream, const job *j, cage_role role)
{
    const cage *c = &j->cages[role - 1];
    cage_feature *ties;
    size_t n = ties_of_map(j->map, j->domains[role - 1], (int)role, &ties);
    cage_write(stream, c, role);
    for (size_t i = 0; i < n; i++)
        cage_write_feature(stream, c, &ties[i], role, false);
    ties_free(n, ties);
}

int ties_write(const job *j)
{
    outfile file;
    icc_map_info info = {.size = sizeof info};
    if (j->args->ties == NULL)
        return DONE;
    icc_map_get_info(j->map, &info);
    if (info.n_ties == 0)
        return failed(j->args->source, 0,
                      "the ties of this map cannot be written in double precision");
    if (!outfile_open(&file, j->args->ties))
        return FAILED;
    fputs("{\"type\": \"FeatureCollection\", \"features\": [\n", file.stream);
    write_side(file.stream, j, CAGE_SOURCE);
    fputs(",\n", file.stream);
    write_side(file.stream, j, CAGE_TARGET);
    fputs("\n]}\n", file.stream);
    return outfile_close(&file) ? DONE : FAILED;
}
