/* The mesh of a map in the plane as part of the bytes of maps; see docs/formats.md. */
#ifndef ICCP_PLMAP_FILE_H
#define ICCP_PLMAP_FILE_H

#include "base/blob.h"
#include "map/compatible/plmap.h"

/* Into a map that is all zero. ICC_ERR_FORMAT unless the triangles are a manifold, and its boundary
 * goes once along the facets of both domains. What is positive and simple is for the certificate
 * (map/plane/mesh_map.h). */
icc_status iccp_plmap_visit(iccp_blob *b, iccp_plmap *map, const icc_domain *source,
                            const icc_domain *target, const iccp_env *env);

#endif
