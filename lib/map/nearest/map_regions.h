/* Maps all folded regions of a plane map anew, and glues the new maps in. */
#ifndef ICCP_MAP_REGIONS_H
#define ICCP_MAP_REGIONS_H

#include "map/nearest/refill.h"

/* A region that was mapped anew. */
typedef struct iccp_piece {
    uint32_t first; /* the region's first triangle */
    size_t n;       /* its size then */
    iccp_refill refill;
} iccp_piece;

typedef struct iccp_pieces {
    iccp_plmap *map;
    iccp_regions regions;
    uint32_t *piece_of; /* of the first triangle of a region: its last piece, or UINT32_MAX */
    iccp_finder given;  /* in `map` */
    uint32_t *place; /* of each vertex inside a region: its place among those that are not held */
    size_t n, room;
    iccp_piece *item;
    iccp_work vain; /* for attempts that lead to no map */
} iccp_pieces;

icc_status iccp_pieces_create(iccp_pieces *pieces, iccp_plmap *map, const iccp_env *env);
void iccp_pieces_free(iccp_pieces *pieces);

/* Lets regions grow until all are sound and mapped anew. If regions.is_stuck afterwards, one region
 * is everything and could not be, or too much work was in vain. */
icc_status iccp_pieces_fill(iccp_pieces *pieces, const iccp_env *env);

/* Replaces the regions by the new maps. Triangles that are not replaced come first: *n_kept of
 * them. `model` has an image for each vertex. It becomes an array for the vertices of the result;
 * new ones get an image by interpolation. Its memory is that of `env`. */
icc_status iccp_pieces_glue(iccp_pieces *pieces, size_t *n_kept, double **model,
                            const iccp_env *env);

#endif
