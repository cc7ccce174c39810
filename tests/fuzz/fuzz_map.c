/* Any bytes as two polygons and points: either they do not correspond, or every point of the
 * source, and of the target, gets a finite image or a status. */
#include "../flat_mesh.h"
#include "../reports.h"
#include "outlines.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_map(const icc_map *map, size_t n_vertices, const double *source,
                      const double *target, size_t n, const double *points)
{
    double images[4 * MAX_POINTS];
    icc_status status[MAX_POINTS];
    size_t n_failed;
    require(icc_map_apply(map, n, points, images, status, &n_failed, NULL) == ICC_OK);
    check_results(n, status, images, 2, n_failed);
    require(icc_map_apply_inverse(map, n, points, images, status, &n_failed, NULL) == ICC_OK);
    check_results(n, status, images, 2, n_failed);
    require(icc_map_jacobian(map, n, points, images, status, &n_failed, NULL) == ICC_OK);
    for (size_t i = 0; i < n; ++i)
        require(is_point_status(status[i]) && isnan(images[4 * i]) == (status[i] != ICC_OK));
    require(icc_map_apply(map, n_vertices, source, images, status, NULL, NULL) == ICC_OK);
    require(memcmp(images, target, n_vertices * 2 * sizeof *target) == 0);
    require(icc_map_apply_inverse(map, n_vertices, target, images, status, NULL, NULL) == ICC_OK);
    require(memcmp(images, source, n_vertices * 2 * sizeof *source) == 0);
}

/* Of kind mesh: certified, with a mesh that can be had, checked, repaired and improved. */
static void check_mesh(const icc_map *map, const icc_domain *target)
{
    icc_map_info info = {.size = sizeof info}, after = info;
    require(icc_map_get_info(map, &info) == ICC_OK);
    require(info.certified == 1 && report_of(map).n_unrepaired == 0 && info.energy >= 4 - 1e-9);
    require(info.energy <= report_of(map).energy_start * (1 + 1e-12));
    double *vertices = malloc(4 * info.n_vertices * sizeof *vertices);
    uint32_t *triangles = malloc(3 * info.n_simplices * sizeof *triangles);
    require(vertices != NULL && triangles != NULL);
    require(flat_get_mesh(map, vertices, vertices + 2 * info.n_vertices, triangles) == ICC_OK);
    for (size_t c = 0; c < 3 * info.n_simplices; ++c)
        require(triangles[c] < info.n_vertices);
    icc_certificate checked = {.size = sizeof checked};
    const icc_status status =
        flat_repair(map, info.n_vertices, vertices, info.n_simplices, triangles,
                    vertices + 2 * info.n_vertices, &checked, NULL, NULL);
    require(status == ICC_OK || status == ICC_ERR_ARGUMENT);
    require(status != ICC_OK ||
            checked.certified == (checked.boundary_simple && checked.first < 0));
    const icc_improve_options few = {.size = sizeof few, .iterations = 1, .levels = 1};
    icc_improve_report report = {.size = sizeof report};
    icc_map *better, *same;
    require(icc_map_improve(&better, map, &few, &report, NULL, NULL) == ICC_OK);
    require(icc_map_get_info(better, &after) == ICC_OK);
    require(after.energy <= info.energy * (1 + 1e-12) && after.n_simplices == report.n_simplices);
    const icc_status followed = icc_map_retarget(
        &same, better, target,
        &(icc_retarget_options){.size = sizeof(icc_retarget_options), .iterations = -1}, NULL,
        NULL);
    require(followed == ICC_OK || followed == ICC_ERR_CERTIFICATE);
    icc_map_free(same);
    icc_map_free(better);
    free(vertices);
    free(triangles);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    double source[2 * MAX_VERTICES], target[2 * MAX_VERTICES], points[2 * MAX_POINTS];
    if (size < 8)
        return 0;
    const int kind = data[0];
    const size_t half = (size - 2) / 2;
    const size_t n = read_outline(data + 2, half, kind & 1, kind & 2, source);
    const size_t m = read_outline(data + 2 + half, half, kind & 4, kind & 2, target);
    place_outline(n, source, kind >> 4);
    place_outline(m, target, kind >> 6);
    const size_t n_points = pick_points(n, source, data + 2, size - 2, points);
    icc_domain *domains[2] = {NULL, NULL};
    const icc_chart_options chart = {.size = sizeof chart,
                                     .method = pick_method(data[1] >> 6),
                                     .function = 1 + (kind >> 3 & 1),
                                     .cells = 2 + data[1] % 32};
    const icc_map_options options = {.size = sizeof options,
                                     .kind = data[1] % 4 == 3 ? ICC_MAP_CURVES : 0,
                                     .iterations = data[1] % 2 ? 2 : -1,
                                     .chart = &chart};
    icc_map *map = NULL;
    if (icc_domain_create(&domains[0], 2, n, source, 0, NULL, NULL, NULL) == ICC_OK &&
        icc_domain_create(&domains[1], 2, m, target, 0, NULL, NULL, NULL) == ICC_OK) {
        icc_error err = {.size = sizeof err};
        const icc_status status =
            icc_map_create(&map, domains[0], domains[1], &options, NULL, &err);
        require(status == ICC_OK || status == ICC_ERR_RESOLUTION || status == ICC_ERR_BOUNDARY ||
                status == ICC_ERR_CERTIFICATE);
        require(status == ICC_OK ? map != NULL : map == NULL && err.side > 0);
    }
    if (map != NULL) {
        icc_map_info info = {.size = sizeof info};
        require(icc_map_get_info(map, &info) == ICC_OK);
        check_map(map, n, source, target, n_points, points);
        if (info.kind == ICC_MAP_MESH)
            check_mesh(map, domains[1]);
    }
    icc_map_free(map);
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
    return 0;
}
