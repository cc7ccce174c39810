/* A fit of a figure or a mesh. */
#ifndef ICCP_ELASTIC_FIT_H
#define ICCP_ELASTIC_FIT_H

#include "fit/fit.h"

/* Makes the map of a fit that has its told items, its options and its shape. fit->images are where
 * it begins, and become where it ends. Sets its info and residuals. */
icc_status iccp_elastic_fit(icc_fit *fit, const iccp_env *env, icc_error *err);

#endif
