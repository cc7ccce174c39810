/* Checks the arguments of the functions on masks of cells. */
#include "api/check.h"
#include "base/env.h"
#include "base/error.h"
#include "domain/mask_boundary.h"
#include "domain/mask_repair.h"
#include "icc/icc.h"

ICCP_END(domain)

static icc_status check_mask(int32_t dim, const size_t *shape, const uint8_t *cells, icc_error *err)
{
    if (dim < 1 || dim > ICC_MAX_DIM)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "dim is %ld; it must lie in 1..%d", (long)dim,
                         ICC_MAX_DIM);
    if (shape == NULL || cells == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "%s is NULL", shape == NULL ? "shape" : "cells");
    for (int32_t k = 0; k < dim; ++k)
        if (shape[k] == 0)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_AXIS, k, "shape[%ld] is 0",
                                (long)k);
    return ICC_OK;
}

icc_status icc_domain_create_mask(icc_domain **out, int32_t dim, const size_t *shape,
                                  const uint8_t *cells, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "out is NULL");
    *out = NULL;
    iccp_env full;
    icc_status status = check_mask(dim, shape, cells, err);
    if (status == ICC_OK)
        status = iccp_env_read(&full, env, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_domain(iccp_domain_create_mask(out, dim, shape, cells, &full, err), out, &full,
                           err);
}

static void fill(uint8_t *cells, const iccp_mask *mask)
{
    for (size_t i = 0; i < mask->n_padded; ++i) {
        int64_t at[ICC_MAX_DIM];
        if (!mask->cells[i])
            continue;
        const int64_t index = iccp_mask_coordinates(mask, i, at);
        if (cells[index] == 0)
            cells[index] = 1;
    }
}

icc_status icc_mask_repair(int32_t dim, const size_t *shape, uint8_t *cells, size_t *n_filled,
                           const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full;
    iccp_mask *mask = NULL;
    size_t n = 0;
    icc_status status = check_mask(dim, shape, cells, err);
    if (status == ICC_OK)
        status = iccp_env_read(&full, env, err);
    if (status == ICC_OK)
        status = iccp_mask_create(&mask, dim, shape, cells, &full, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_finish(&full, iccp_mask_repair(mask, &n, &full)));
    if (status == ICC_OK)
        fill(cells, mask);
    if (n_filled != NULL)
        *n_filled = status == ICC_OK ? n : 0;
    iccp_mask_free(mask);
    return status;
}
