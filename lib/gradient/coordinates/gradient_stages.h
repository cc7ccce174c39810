/* The stages of a gradient chart, made from its options: grid, maximum, tree, function. Each is the
 * stage that icc/stages.h offers, so charts of a function (icc_chart_create_function()) are the
 * same. */
#ifndef ICCP_GRADIENT_STAGES_H
#define ICCP_GRADIENT_STAGES_H

#include "chart/chart.h"
#include "gradient/function/function.h"

/* Makes the function, whose tree and grid go with it. `chosen` is the root that the caller asked
 * for or the grassfire found; the root of a plate's tree may be another vertex. Adds the times of
 * the stages to `timings`. */
icc_status iccp_gradient_stages(icc_function **out, uint32_t *chosen, icc_chart_timings *timings,
                                const icc_domain *domain, const icc_chart_options *options,
                                const iccp_env *env, icc_error *err);

#endif
