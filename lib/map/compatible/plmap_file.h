/* The mesh of a map in the plane as part of the bytes of maps; see docs/reference/formats.md. */
#ifndef ICCP_PLMAP_FILE_H
#define ICCP_PLMAP_FILE_H

#include "base/blob.h"
#include "map/compatible/plmap.h"

/* Reads into a map that is all zero, or writes. ICC_ERR_FORMAT unless the triangles are a manifold
 * whose boundary goes once along the facets of both domains. The certificate checks the signs
 * (map/plane/plane_certificate.h). */
icc_status iccp_plmap_visit(iccp_blob *b, iccp_plmap *map, const icc_domain *source,
                            const icc_domain *target, const iccp_env *env);

#endif
