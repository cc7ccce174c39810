/* Makes the features of a coverage from its rings. */
#ifndef ICCP_COVERAGE_FEATURES_H
#define ICCP_COVERAGE_FEATURES_H

#include "match/coverage/border_vertices.h"
#include "match/coverage/coverage_object.h"
#include "match/coverage/leave_out.h"

/* Fills in the features, and what the info says about them. */
icc_status iccp_coverage_features(icc_coverage *coverage, const iccp_layer_rings *rings,
                                  const iccp_kept *kept, const iccp_border_vertices *vertices,
                                  const iccp_memory *memory);

#endif
