/* Shapes as part of other objects' bytes; see docs/reference/formats.md. */
#ifndef ICCP_SHAPE_FILE_H
#define ICCP_SHAPE_FILE_H

#include "base/blob.h"
#include "kernel/sampling/shape.h"

/* Returns ICC_ERR_FORMAT if the bytes are not those of a shape. Reading makes the same checks as
 * icc_shape_create(). Writing takes no env and cannot fail. */
icc_status iccp_shape_visit(iccp_blob *b, icc_shape **shape, const iccp_env *env, icc_error *err);

#endif
