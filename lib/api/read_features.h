/* Reads the features that a caller gives, and checks all but their geometry. */
#ifndef ICCP_READ_FEATURES_H
#define ICCP_READ_FEATURES_H

#include "base/env.h"
#include "icc/icc.h"

/* Copies n features in the plane or in space to *full, which the caller frees even on failure. The
 * numbers of vertices and facets of the outer ring or surface count for what is possible in all. */
icc_status iccp_read_features(icc_feature **full, int32_t dim, size_t n_outer,
                              size_t n_outer_facets, size_t n, const icc_feature *features,
                              const iccp_memory *memory, icc_error *err);

#endif
