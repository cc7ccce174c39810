/* Told lines as vertices and edges of a frame's mesh. A segment is divided as finely as the mesh is
 * around it. The vertices inside are told, too, so that the segment goes along linearly. */
#ifndef ICCP_TOLD_LINES_H
#define ICCP_TOLD_LINES_H

#include "fit/spline/frame_mesh.h"

typedef struct iccp_told_lines {
    iccp_memory memory;
    size_t n;            /* vertices inside segments. They follow the told points */
    uint32_t *ends;      /* 2 n: the told points between which each lies */
    double *share;       /* n: the place of each between them, a multiple of a power of two */
    iccp_edge_set walls; /* the parts of all segments */
} iccp_told_lines;

/* Divides segments between the points of a region. `segments`: 2 n_segments numbers of points.
 * `across`: see iccp_frame_mesh(). On failure nothing stays allocated. */
icc_status iccp_told_lines_create(iccp_told_lines *lines, const iccp_frame_region *region,
                                  double across, size_t n_segments, const uint32_t *segments,
                                  const iccp_env *env);
void iccp_told_lines_free(iccp_told_lines *lines);

/* Writes the vertices inside, as they lie between points or between their targets. */
void iccp_told_lines_place(const iccp_told_lines *lines, const double *points, double *inside);

#endif
