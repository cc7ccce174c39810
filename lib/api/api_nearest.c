/* Checks the arguments of the function that makes the map nearest to a warp. */
#include "api/check.h"
#include "base/options.h"
#include "map/nearest/nearest_map.h"

ICCP_END(map)

static icc_status read_options(icc_nearest_options *full, const icc_nearest_options *options,
                               size_t n_vertices, icc_error *err)
{
    icc_status status = iccp_read_struct(full, sizeof *full, options, "icc_nearest_options", err);
    if (status == ICC_OK && full->held == NULL && full->n_held > 0)
        status = iccp_fail(err, ICC_ERR_ARGUMENT, "icc_nearest_options.held is NULL");
    if (status == ICC_OK && full->n_held > n_vertices)
        status = iccp_fail(err, ICC_ERR_ARGUMENT,
                           "icc_nearest_options.n_held is %zu, but there are %zu vertices",
                           full->n_held, n_vertices);
    for (size_t i = 0; status == ICC_OK && i < full->n_held; ++i)
        if (full->held[i] >= n_vertices)
            status =
                iccp_fail(err, ICC_ERR_ARGUMENT, "icc_nearest_options.held lists vertex %lu of %zu",
                          (unsigned long)full->held[i], n_vertices);
    return status;
}

static icc_status create(icc_map **out, const icc_mesh *mesh, const double *images,
                         const icc_nearest_options *options, icc_nearest_report *report,
                         const iccp_env *env, icc_error *err)
{
    icc_mesh m;
    icc_nearest_options full;
    icc_nearest_report own = {0};
    icc_status status = iccp_read_mesh(&m, mesh, err);
    if (status == ICC_OK && m.dim != 2)
        status = iccp_fail(err, ICC_ERR_UNSUPPORTED,
                           "the mesh has dimension %ld; only meshes of the plane are supported",
                           (long)m.dim);
    if (status == ICC_OK)
        status = iccp_check_counts(m.n_vertices, m.vertices, m.n_cells, m.cells, err);
    if (status == ICC_OK && (m.n_vertices < 3 || m.n_cells == 0))
        status = iccp_fail(err, ICC_ERR_BOUNDARY, "the mesh has no triangles");
    if (status == ICC_OK)
        status = read_options(&full, options, m.n_vertices, err);
    if (status == ICC_OK && report != NULL)
        status = iccp_write_struct(report, &own, sizeof own, "icc_nearest_report", err);
    if (status != ICC_OK)
        return status;
    const iccp_warp warp = {m.n_vertices, m.vertices,  images,   m.n_cells,
                            m.cells,      full.n_held, full.held};
    status = iccp_nearest_map_create(out, &warp, &own, env, err);
    return status == ICC_OK && report != NULL
               ? iccp_write_struct(report, &own, sizeof own, "icc_nearest_report", err)
               : status;
}

icc_status icc_map_create_nearest(icc_map **out, const icc_mesh *mesh, const double *images,
                                  const icc_nearest_options *options, icc_nearest_report *report,
                                  const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL      ? "out"
                          : mesh == NULL   ? "mesh"
                          : images == NULL ? "images"
                                           : NULL;
    iccp_env full;
    const icc_status status = iccp_begin(&full, env, missing, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_map(create(out, mesh, images, options, report, &full, err), out, &full, err);
}
