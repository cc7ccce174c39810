/* Drawing the paths of map/isotopy/routes.h as polylines with few bends. */
#ifndef ICCP_TAUT_H
#define ICCP_TAUT_H

#include "map/isotopy/routes.h"

typedef struct iccp_polyline {
    size_t n, room;
    double *points; /* 2 n */
} iccp_polyline;

/* Between two of many points in the plane. */
double iccp_distance_between(const double *points, uint32_t a, uint32_t b);

/* Where on the edges of the bare triangulation each crossing may lie: shares low and high of the
 * way along the edge. */
typedef struct iccp_lanes {
    double *share; /* 2 for each vertex beyond those of the scene */
} iccp_lanes;

icc_status iccp_lanes_create(iccp_lanes *lanes, const iccp_routes *routes);
void iccp_lanes_free(iccp_lanes *lanes, const iccp_memory *memory);

/* The shortest polyline from one end of a path to the other within its lanes, ends included: paths
 * drawn so do not cross. O(crossings) but for O(crossings^2) in the worst case. */
icc_status iccp_taut(iccp_polyline *line, const iccp_routes *routes, const iccp_lanes *lanes,
                     size_t path);

icc_status iccp_polyline_add(iccp_polyline *line, const double p[2], const iccp_memory *memory);
double iccp_polyline_length(const iccp_polyline *line);
void iccp_polyline_free(iccp_polyline *line, const iccp_memory *memory);

#endif
