/* Distances of points from triangles in space, and searches for a triangle that is near enough. */
#ifndef ICCP_TRIANGLE_NEAR_H
#define ICCP_TRIANGLE_NEAR_H

#include "geometry/facet_tree.h"

/* The squared distance of a point from the triangle a, b, c. */
double iccp_triangle_distance2(const double *a, const double *b, const double *c, const double *p);

/* Searches a tree of triangles in space. Returns the first triangle found whose squared distance is
 * at most `enough2`, or else the nearest one within `most2`, or else UINT32_MAX. If `enough2` is
 * negative, that is the nearest one. */
uint32_t iccp_triangle_near(const iccp_facet_tree *tree, const double *p, double enough2,
                            double most2, double *distance2);

#endif
