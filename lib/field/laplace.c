/* Based on: L. Huynh and Y. Gingold, Bijective Deformations in R^n via Integral Curve Coordinates,
 * section 5.2: solutions to the Laplace and bi-Laplace equations subject to the inequalities of the
 * cousin tree. */
#include "field/laplace.h"

#include "base/error.h"

icc_status iccp_laplace(icc_field *field, const icc_field_options *options, const iccp_env *env,
                        icc_error *err)
{
    (void)field;
    (void)env;
    return iccp_fail(err, ICC_ERR_UNSUPPORTED, -1, "function %ld is not available yet",
                     (long)options->function);
}
