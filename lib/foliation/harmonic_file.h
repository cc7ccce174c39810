/* The mesh of a harmonic chart as part of its bytes. Format: docs/reference/formats.md. */
#ifndef ICCP_HARMONIC_FILE_H
#define ICCP_HARMONIC_FILE_H

#include "base/blob.h"
#include "foliation/harmonic.h"

void iccp_harmonic_write(int32_t cells, const iccp_planar *mesh, const icc_domain *domain,
                         iccp_blob *w);

/* Reads the base: its mesh and number of cells, but no Laplacian or factor. Fails with
 * ICC_ERR_FORMAT unless the mesh can be certified as a disc of positive triangles with the
 * domain's boundary. */
icc_status iccp_harmonic_read(iccp_harmonic *base, const icc_domain *domain, iccp_blob *r,
                              const iccp_env *env);

#endif
