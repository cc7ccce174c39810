/* Draws the paths of map/isotopy/path_search.h as the shortest polylines within their lanes. */
#ifndef ICCP_SHORTEN_H
#define ICCP_SHORTEN_H

#include "map/isotopy/path_search.h"

typedef struct iccp_polyline {
    size_t n, room;
    double *points; /* 2 n */
} iccp_polyline;

/* The distance between two points of an array of points in the plane. */
double iccp_distance_between(const double *points, uint32_t a, uint32_t b);

/* The lane of each crossing: the part of its edge of the bare triangulation where it may lie. It is
 * stored as its lowest and highest share of the edge's length. */
typedef struct iccp_lanes {
    double *share; /* 2 for each vertex beyond the domain's */
} iccp_lanes;

icc_status iccp_lanes_create(iccp_lanes *lanes, const iccp_path_search *search);
void iccp_lanes_free(iccp_lanes *lanes, const iccp_memory *memory);

/* Finds the shortest polyline from one end of a path to the other within its lanes, ends included.
 * Paths drawn this way do not cross. Linear in the crossings as a rule, quadratic in the worst
 * case. */
icc_status iccp_shorten_path(iccp_polyline *line, const iccp_path_search *search,
                             const iccp_lanes *lanes, size_t path);

icc_status iccp_polyline_add(iccp_polyline *line, const double p[2], const iccp_memory *memory);
double iccp_polyline_length(const iccp_polyline *line);
void iccp_polyline_free(iccp_polyline *line, const iccp_memory *memory);

#endif
