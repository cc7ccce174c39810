/* The operations of mesh maps beyond space. */
#ifndef ICCP_HIGHER_KIND_H
#define ICCP_HIGHER_KIND_H

#include "map/kind/kind.h"

extern const iccp_map_kind iccp_higher_kind;

#endif
