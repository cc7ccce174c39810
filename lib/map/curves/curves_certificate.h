/* The certificate that a map of two charts is one-to-one. */
#ifndef ICCP_CURVES_CERTIFICATE_H
#define ICCP_CURVES_CERTIFICATE_H

#include "map/kind/kind.h"

/* See iccp_map_kind. Gives the reason if it does not hold. */
icc_status iccp_curves_certify(icc_map *map, const iccp_env *env, icc_error *err);

#endif
