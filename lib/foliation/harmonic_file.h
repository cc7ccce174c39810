/* The mesh of a harmonic chart as part of its bytes; see docs/formats.md. */
#ifndef ICCP_HARMONIC_FILE_H
#define ICCP_HARMONIC_FILE_H

#include "base/blob.h"
#include "foliation/harmonic.h"

void iccp_harmonic_write(int32_t cells, const iccp_planar *mesh, const icc_domain *domain,
                         iccp_blob *w);

/* The base with its mesh and its number of cells, no more. Refused with ICC_ERR_FORMAT unless the
 * mesh can be certified: all triangles positive, a disc, and its boundary the domain's. */
icc_status iccp_harmonic_read(iccp_harmonic *base, const icc_domain *domain, iccp_blob *r,
                              const iccp_env *env);

#endif
