/* Fills the surfaces of a pair of domains with tetrahedra. */
#include "fill/filled_pair.h"

#include "base/error.h"
#include "base/threads.h"
#include "fill/fill_domain.h"
#include "geometry/simplices.h"

typedef struct fill_job {
    icc_domain **filled;
    const icc_domain *const *domain;
} fill_job;

icc_status iccp_fill_side(icc_domain **filled, const icc_domain *domain, size_t side,
                          const iccp_env *env, icc_error *err)
{
    if (domain->mesh != NULL) {
        *filled = iccp_domain_retain(domain);
        return ICC_OK;
    }
    *filled = NULL;
    const icc_status status = iccp_domain_fill_for_map(filled, domain, env, err);
    if (status != ICC_OK)
        return iccp_fail_side(err, status, (int32_t)side + 1);
    iccp_log(env, "%s: filled with %zu tetrahedra", side == 0 ? "source" : "target",
             (*filled)->mesh->n_simplices);
    return ICC_OK;
}

static icc_status fill_one(void *argument, size_t k, const iccp_env *env, icc_error *err)
{
    const fill_job *job = argument;
    return iccp_fill_side(&job->filled[k], job->domain[k], k, env, err);
}

icc_status iccp_fill_pair(icc_domain *filled[2], const icc_domain *const domains[2],
                          const iccp_env *env, icc_error *err)
{
    fill_job job = {filled, domains};
    filled[0] = filled[1] = NULL;
    const icc_status status = iccp_side_by_side(env, 2, fill_one, &job, err);
    for (int k = 0; status != ICC_OK && k < 2; ++k) {
        iccp_domain_release(filled[k]);
        filled[k] = NULL;
    }
    return status;
}
