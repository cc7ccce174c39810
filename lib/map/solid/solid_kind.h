/* Mesh maps in space as a kind of map: the table of their operations. */
#ifndef ICCP_SOLID_KIND_H
#define ICCP_SOLID_KIND_H

#include "map/solid/solid_map.h"

extern const iccp_map_kind iccp_solid_kind;

#endif
