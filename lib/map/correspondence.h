/* Whether vertex i of one domain can go to vertex i of another. */
#ifndef ICCP_CORRESPONDENCE_H
#define ICCP_CORRESPONDENCE_H

#include "domain/domain.h"

/* ICC_ERR_BOUNDARY, and why, unless the boundaries correspond: their facets join the same vertices,
 * they turn the same way, and the same holds for features. */
icc_status iccp_check_correspondence(const icc_domain *source, const icc_domain *target,
                                     icc_error *err);

#endif
