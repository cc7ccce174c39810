/* A fit of control points. */
#ifndef ICCP_SPLINE_FIT_H
#define ICCP_SPLINE_FIT_H

#include "fit/fit.h"

/* Makes the map of a fit that has its told items, all of them points, and its options. Sets its
 * info and residuals. */
icc_status iccp_spline_fit(icc_fit *fit, const iccp_env *env, icc_error *err);

#endif
