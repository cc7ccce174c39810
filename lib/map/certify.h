/* Checks the image of a mesh of the caller's. */
#ifndef ICCP_CERTIFY_H
#define ICCP_CERTIFY_H

#include "map/map.h"

/* See icc_map_certify() and icc_map_repair(). Works in 2-D and 3-D. `images` is not NULL. Fills in
 * the certificate except for its `size`. */
icc_status iccp_map_certify(const icc_map *map, size_t n_vertices, const double *vertices,
                            size_t n_simplices, const uint32_t *simplices, bool repaired,
                            double *images, icc_certificate *certificate, const iccp_env *env,
                            icc_error *err);

#endif
