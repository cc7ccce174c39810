/* Samples on walls and curves. */
#ifndef ICCP_BOUNDARY_SAMPLES_H
#define ICCP_BOUNDARY_SAMPLES_H

#include "kernel/sampling/point_list.h"
#include "kernel/sampling/shape.h"

/* cos 30 degrees. A sharper turn of a line is a corner, and faces that meet at a larger angle form
 * a crease, which is sampled as a line. Circles with at least 13 vertices are round. */
#define ICCP_SHARP_COSINE 0.86602540378443865

/* Adds samples on segments between vertices (dim coordinates each), about `spacing` apart along
 * each line. Ends, forks and corners come first, then even samples between them. A closed line
 * without any of these begins at a vertex. */
icc_status iccp_segments_sample(iccp_point_list *list, const double *vertices, size_t n_vertices,
                                size_t n_segments, const uint32_t *segments, double spacing,
                                const iccp_env *env);

/* 3-D: adds samples on the creases of a shape's walls, where faces meet at 30 degrees or more. */
icc_status iccp_creases_sample(iccp_point_list *list, const icc_shape *shape, double spacing,
                               const iccp_env *env);

/* 3-D: adds random samples on the faces of the walls, many more than needed, to be thinned out. */
icc_status iccp_surface_sample(iccp_point_list *list, const icc_shape *shape, double spacing,
                               uint64_t seed);

#endif
