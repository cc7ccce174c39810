/* Finds the points of a raster inside a boundary of simplices. */
#ifndef ICCP_SCAN_SURFACE_H
#define ICCP_SCAN_SURFACE_H

#include "domain/domain.h"

/* See iccp_domain_scan(). Any dimension, for a domain with a tree of its own. */
icc_status iccp_scan_surface(const icc_domain *domain, const iccp_raster *raster, uint8_t *inside,
                             size_t *n_inside, const iccp_env *env);

#endif
