/* Checks the arguments of the function that makes domains of the plane with features. */
#include "api/check.h"
#include "api/read_features.h"
#include "domain/features.h"

ICCP_END(domain)

icc_status icc_domain_create_features(icc_domain **out, size_t n_outer, const double *outer,
                                      size_t n_features, const icc_feature *features,
                                      const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "out is NULL");
    *out = NULL;
    iccp_env env_read;
    icc_status status = iccp_env_read(&env_read, env, err);
    if (status == ICC_OK)
        status = iccp_check_counts(n_outer, outer, 0, NULL, err);
    if (status != ICC_OK)
        return status;
    icc_feature *full;
    status = iccp_read_features(&full, 2, n_outer, 0, n_features, features, &env_read.memory, err);
    if (status == ICC_OK)
        status = iccp_domain_create_features(out, n_outer, outer, n_features, full, &env_read, err);
    iccp_free(&env_read.memory, full);
    return iccp_end_domain(status, out, &env_read, err);
}
