/* The certificate that a mesh map in space is one-to-one. */
#ifndef ICCP_SOLID_CERTIFICATE_H
#define ICCP_SOLID_CERTIFICATE_H

#include "map/solid/solid_map.h"

/* See iccp_map_kind. */
icc_status iccp_solid_certify(icc_map *map, const iccp_env *env, icc_error *err);

#endif
