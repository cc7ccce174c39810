/* Reads and writes domains with features as part of other objects' bytes; see
 * docs/reference/formats.md. */
#ifndef ICCP_FEATURES_FILE_H
#define ICCP_FEATURES_FILE_H

#include "base/blob.h"
#include "domain/domain.h"

/* Visits everything except the dimension, which is 2. Reading makes the same checks as creating. */
icc_status iccp_features_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env);

#endif
