/* Tests whether a map can take vertex i of one domain to vertex i of another. */
#ifndef ICCP_CORRESPONDENCE_H
#define ICCP_CORRESPONDENCE_H

#include "domain/domain.h"

/* Returns ICC_ERR_BOUNDARY with a message unless the boundaries correspond. Then facet i joins the
 * same vertices in both, and both turn the same way. Feature i has the same kind and the same
 * number of vertices in both, and rings turn the same way. Returns ICC_ERR_TOPOLOGY unless the
 * networks of the features are the same (domain/network_same.h). */
icc_status iccp_check_correspondence(const icc_domain *source, const icc_domain *target,
                                     icc_error *err);

#endif
