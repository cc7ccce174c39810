/* The mesh of a map in the plane as part of the bytes of maps; see docs/reference/formats.md. */
#ifndef ICCP_PLMAP_FILE_H
#define ICCP_PLMAP_FILE_H

#include "base/blob.h"
#include "map/compatible/plmap.h"

/* Versions of the bytes of maps (map/map_file.c): from the first on, they list vertices on a
 * network. */
enum iccp_plmap_version { ICCP_VERSION_NETWORKS = 4, ICCP_VERSION_SLIDING };

/* Reads into a map that is all zero, or writes. ICC_ERR_FORMAT unless the triangles are a manifold
 * whose boundary goes once along the facets of both domains, which have no features. The
 * certificate checks the rest (map/plane/plane_certificate.h). */
icc_status iccp_plmap_visit(iccp_blob *b, iccp_plmap *map, const icc_domain *source,
                            const icc_domain *target, const iccp_env *env);

#endif
