/* Finds the points of a raster inside a polygon, which may have holes. */
#ifndef ICCP_SCAN_POLYGON_H
#define ICCP_SCAN_POLYGON_H

#include "domain/domain.h"

/* See iccp_domain_scan(). Exact for the rounded position origin + spacing * i. */
icc_status iccp_scan_polygon(const icc_domain *polygon, const iccp_raster *raster, uint8_t *inside,
                             size_t *n_inside, const iccp_env *env);

#endif
