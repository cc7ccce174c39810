/* Tells how much rounding to the caller's coordinates harms the mesh of a map. */
#ifndef ICCP_ROUNDED_H
#define ICCP_ROUNDED_H

#include "map/map.h"

/* Counts simplices that are not positive on both sides when icc_map_get_mesh() hands them out: see
 * icc_map_report::n_spoilt. */
size_t iccp_map_count_spoilt(const icc_map *map);

#endif
