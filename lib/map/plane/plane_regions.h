/* The region of each triangle of a map in the plane. */
#ifndef ICCP_PLANE_REGIONS_H
#define ICCP_PLANE_REGIONS_H

#include "map/compatible/plmap.h"

/* Fills in a number for each triangle; see icc_map_get_regions(). Returns ICC_OK or
 * ICC_ERR_MEMORY. */
icc_status iccp_plmap_find_regions(uint32_t *regions, const iccp_plmap *map,
                                   const iccp_memory *memory);

#endif
