/* Makes rings from the pieces of their boundary. */
#ifndef CLIP_RINGS_H
#define CLIP_RINGS_H

#include "geo/clip.h"

/* A piece from node to node, with the inside on the left. */
typedef struct clip_piece {
    uint32_t from, to;
    bool used;
} clip_piece;

/* Joins pieces, sorted by the node where they start, to rings, and gives each hole to the ring
 * around it. False if some pieces are left over. Free `out` in either case. */
bool clip_rings(clipped *out, size_t n_nodes, const geo_node *nodes, size_t n, clip_piece *pieces);

#endif
