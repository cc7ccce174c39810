/* Shapes as part of the bytes of other objects; see docs/formats.md. */
#ifndef ICCP_SHAPE_FILE_H
#define ICCP_SHAPE_FILE_H

#include "base/blob.h"
#include "kernel/sampling/shape.h"

/* ICC_ERR_FORMAT if the bytes are those of no shape; everything is checked as in
 * icc_shape_create(). Writing takes no env and cannot fail. */
icc_status iccp_shape_visit(iccp_blob *b, icc_shape **shape, const iccp_env *env, icc_error *err);

#endif
