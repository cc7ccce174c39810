/* The object icc_coverage: two layers of the same regions, with common vertices. layer.h has the
 * words of this folder. */
#ifndef ICCP_COVERAGE_OBJECT_H
#define ICCP_COVERAGE_OBJECT_H

#include "domain/domain.h"

struct icc_coverage {
    iccp_memory memory;
    icc_domain *domain[2]; /* source and target */
    size_t n_features;
    icc_feature *feature[2];
    double *point[2]; /* of all features */
    int64_t *id;      /* of each feature */
    icc_coverage_difference *difference;
    icc_coverage_info info;
};

/* See icc_coverage_create(). Arguments have been checked. */
icc_status iccp_coverage_create(icc_coverage **out, const icc_layer *source,
                                const icc_layer *target, const icc_coverage_options *options,
                                const iccp_env *env, icc_error *err);

/* Accepts NULL. */
void iccp_coverage_release(icc_coverage *coverage);

#endif
