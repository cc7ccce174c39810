/* Finds a point that sees a whole boundary from inside, in any dimension. */
#ifndef ICCP_KERNEL_POINT_H
#define ICCP_KERNEL_POINT_H

#include "domain/domain.h"

/* Looks for the point of the kernel of a boundary: it is on the inner side of all facets. `point`
 * is where the least distance from their hyperplanes is greatest, up to rounding. The caller asks
 * exact signs whether it sees all facets. */
icc_status iccp_kernel_point(const icc_domain *domain, double *point, const iccp_env *env);

#endif
