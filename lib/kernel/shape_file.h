/* Shapes as part of the bytes of other objects; see docs/formats.md. */
#ifndef ICCP_SHAPE_FILE_H
#define ICCP_SHAPE_FILE_H

#include "base/blob.h"
#include "kernel/shape.h"

void iccp_shape_write(const icc_shape *shape, iccp_blob_writer *w);

/* ICC_ERR_FORMAT if the bytes are those of no shape; everything is checked as in
 * icc_shape_create(). */
icc_status iccp_shape_read(icc_shape **out, iccp_blob_reader *r, const iccp_env *env,
                           icc_error *err);

#endif
