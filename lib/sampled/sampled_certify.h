/* Judges all cells of a sampled field. */
#ifndef ICCP_SAMPLED_CERTIFY_H
#define ICCP_SAMPLED_CERTIFY_H

#include "base/env.h"
#include "sampled/samples.h"

/* See icc_field_certify(). Fills in the report except for its `size`. */
icc_status iccp_sampled_certify(const icc_field *field, size_t capacity, uint32_t *cells,
                                int32_t *kinds, icc_field_report *report, const iccp_env *env,
                                icc_error *err);

#endif
