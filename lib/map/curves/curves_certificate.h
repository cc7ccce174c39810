/* The certificate that a map of two charts is one-to-one. Source: docs/theory/charts-space.md. */
#ifndef ICCP_CURVES_CERTIFICATE_H
#define ICCP_CURVES_CERTIFICATE_H

#include "map/kind/kind.h"

/* See iccp_map_kind. Writes the reason to the map's info if the map is not certified. */
icc_status iccp_curves_certify(icc_map *map, const iccp_env *env, icc_error *err);

#endif
