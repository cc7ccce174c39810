/* Reads and writes solids with features as part of other objects' bytes; see
 * docs/reference/formats.md. */
#ifndef ICCP_SOLID_FILE_H
#define ICCP_SOLID_FILE_H

#include "base/blob.h"
#include "domain/domain.h"
#include "geometry/simplices.h"

/* Visits everything except the dimension, which is 3. Reading makes the same checks as creating,
 * also of a mesh. */
icc_status iccp_solid_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env);

/* Visits another mesh of a solid with features, which may be NULL. Reading checks it. */
icc_status iccp_solid_filling_visit(iccp_blob *b, iccp_simplices **mesh, const icc_domain *solid,
                                    const iccp_env *env);

#endif
