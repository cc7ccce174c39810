/* Closed surfaces become domains with a mesh of tetrahedra. */
#ifndef ICCP_FILL_DOMAIN_H
#define ICCP_FILL_DOMAIN_H

#include "domain/domain.h"

/* The ratio where the caller leaves it open. */
#define ICCP_FILL_RATIO 1.6

typedef struct iccp_fill_options {
    double ratio;
    uint64_t max_points;
} iccp_fill_options;

/* See icc_domain_fill(); arguments have been checked. */
icc_status iccp_domain_fill(icc_domain **out, const icc_domain *surface,
                            const iccp_fill_options *options, const iccp_env *env, icc_error *err);

#endif
