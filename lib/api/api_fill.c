/* Checks the arguments of the function that fills a surface with a mesh. */
#include "api/check.h"
#include "base/env.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/domain.h"
#include "fill/fill_domain.h"

ICCP_END(domain)

icc_status icc_domain_fill(icc_domain **out, const icc_domain *surface,
                           const icc_fill_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full;
    icc_fill_options given;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : surface == NULL ? "surface" : NULL;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&given, sizeof given, options, "icc_fill_options", err);
    if (status != ICC_OK)
        return status;
    if (surface->dim != 3 || surface->mesh != NULL)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "only surfaces in 3-D without a mesh can be filled");
    if (!(given.ratio == 0.0 || given.ratio >= 1.2))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_fill_options.ratio is %g; it must be 0 or at "
                         "least 1.2",
                         given.ratio);
    const iccp_fill_options own = {.ratio = given.ratio == 0.0 ? ICCP_FILL_RATIO : given.ratio,
                                   .max_points =
                                       given.max_points == 0 ? UINT64_MAX : given.max_points,
                                   .for_map = false};
    return iccp_end_domain(iccp_domain_fill(out, surface, &own, &full, err), out, &full, err);
}
