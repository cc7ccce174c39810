/* Argument checks of domains made from masks. */
#include "base/env.h"
#include "base/error.h"
#include "domain/mask_boundary.h"
#include "icc/icc.h"

icc_status icc_domain_create_mask(icc_domain **out, int32_t dim, const size_t *shape,
                                  const uint8_t *cells, const icc_env *env, icc_error *err)
{
    if (out == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "out is NULL");
    *out = NULL;
    if (dim < 1 || dim > ICC_MAX_DIM)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "dim is %ld; it must lie in 1..%d", (long)dim,
                         ICC_MAX_DIM);
    if (shape == NULL || cells == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "%s is NULL",
                         shape == NULL ? "shape" : "cells");
    for (int32_t k = 0; k < dim; ++k)
        if (shape[k] == 0)
            return iccp_fail(err, ICC_ERR_ARGUMENT, k, "shape[%ld] is 0", (long)k);
    iccp_env full;
    const icc_status status = iccp_env_read(&full, env, err);
    if (status != ICC_OK)
        return status;
    return iccp_domain_create_mask(out, dim, shape, cells, &full, err);
}
