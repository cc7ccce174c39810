/* Domains with features as part of the bytes of other objects; see docs/formats.md. */
#ifndef ICCP_FEATURES_FILE_H
#define ICCP_FEATURES_FILE_H

#include "base/blob.h"
#include "domain/domain.h"

/* All but the dimension, which is 2. What is read is checked as it is when it is made. */
icc_status iccp_features_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env);

#endif
