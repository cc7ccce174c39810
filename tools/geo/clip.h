/* Computes the part of a polygon that lies in the cage. */
#ifndef CLIP_H
#define CLIP_H

#include "geo/noding.h"

/* Rings of nodes, not closed, with the inside on the left. Each outer ring is followed by its
 * holes. Corners of the cage have no `from`. */
typedef struct clip_ring {
    size_t first, n;
    size_t part;
} clip_ring;

typedef struct clipped {
    geo_node *nodes;
    clip_ring *rings;
    size_t n_nodes, n_rings, n_parts;
} clipped;

/* Clips the polygon of the shape's paths first .. first + n_rings - 1, the outer ring before the
 * holes. False if the rings cross themselves or each other so that their inside is not defined.
 * Free the result in either case. */
bool clip_polygon(clipped *out, noding *x, const geo_shape *shape, size_t first, size_t n_rings,
                  const icc_status *status, const bool *snapped);
void clipped_free(clipped *c);

/* Twice the area of a polygon, positive if it is counter-clockwise. */
double ring_area(size_t n, const double *points, size_t stride);

#endif
