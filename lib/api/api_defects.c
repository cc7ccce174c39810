/* Checks the arguments of the function that lists the defects of a polygon. */
#include "api/check.h"
#include "base/env.h"
#include "base/error.h"
#include "geometry/polygon_check.h"

icc_status icc_boundary_defects(size_t n_vertices, const double *vertices, size_t capacity,
                                int32_t *kinds, uint32_t *items, size_t *n_defects,
                                const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (n_defects == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "n_defects is NULL");
    *n_defects = 0;
    if (capacity > 0 && (kinds == NULL || items == NULL))
        return iccp_fail(err, ICC_ERR_ARGUMENT, "kinds or items is NULL");
    iccp_env full;
    icc_status status = iccp_env_read(&full, env, err);
    if (status == ICC_OK)
        status = iccp_check_counts(n_vertices, vertices, 0, NULL, err);
    if (status != ICC_OK)
        return status;
    status =
        iccp_boundary_defects(n_vertices, vertices, capacity, kinds, items, n_defects, &full, err);
    return status == ICC_OK ? iccp_explain(err, iccp_finish(&full, ICC_OK)) : status;
}
