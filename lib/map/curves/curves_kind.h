/* The table of operations of curve maps, which map point by point through two charts. */
#ifndef ICCP_CURVES_KIND_H
#define ICCP_CURVES_KIND_H

#include "map/kind/kind.h"

extern const iccp_map_kind iccp_curves_kind;

#endif
