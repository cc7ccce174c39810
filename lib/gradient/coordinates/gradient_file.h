/* The stages of a gradient chart as bytes; see docs/reference/formats.md. They contain what the
 * stages were made from: the cells of the grid, the root, the order of the axes, how the function
 * was made. Vertices, parents and values are written only where the caller chose them. */
#ifndef ICCP_GRADIENT_FILE_H
#define ICCP_GRADIENT_FILE_H

#include "base/blob.h"
#include "gradient/function/function.h"

/* Writes the stages below a function, whose grid has a domain. */
void iccp_gradient_write(const icc_function *function, uint32_t chosen, iccp_blob *b);

/* Makes the stages again. Fails with ICC_ERR_FORMAT if the bytes describe none, and without a
 * message. */
icc_status iccp_gradient_read(icc_function **out, uint32_t *chosen, const icc_domain *domain,
                              iccp_blob *b, const iccp_env *env);

#endif
