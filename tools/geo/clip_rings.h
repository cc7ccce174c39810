/* Rings out of the pieces of their boundary. */
#ifndef CLIP_RINGS_H
#define CLIP_RINGS_H

#include "geo/clip.h"

/* From node to node, with the inside on the left. */
typedef struct clip_piece {
    uint32_t from, to;
    bool used;
} clip_piece;

/* Joins pieces, sorted by the node from which they go, to rings, and gives holes to what they are
 * in. False: some are left over. What there is in `out` is to be freed in either case. */
bool clip_rings(clipped *out, size_t n_nodes, const geo_node *nodes, size_t n, clip_piece *pieces);

#endif
