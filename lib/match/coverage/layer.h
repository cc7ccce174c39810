/* One layer of a coverage, from the caller's rings to sides without duplicates.
 *
 * Words of this folder. Begin with coverage_create.c.
 * - layer: rings, each with the number of its region. region: an index into the sorted numbers of
 *   all regions of both layers (iccp_regions). ICCP_NO_REGION is what no region covers.
 * - place: where vertices lie, in the local coordinates of its layer. A layer has each place once.
 * - edge: a directed piece of a ring, with its region on the left. side: two places that edges
 *   join, with the regions left and right.
 * - node: a place where more than two sides meet. border: sides from node to node, with the same
 *   regions left and right. island: a closed border without a node (layer_graph.h).
 * - walk, ring, piece: the borders around an area with the area on the left, the closed lines that
 *   they consist of, and the area itself (layer_rings.h).
 * - sure: the only one of its kind in both layers. settled: paired by its place (alike.h).
 * - partner: the node, border or piece of the other layer that it is paired with.
 *
 * Ways: layer_read.c reads rings, layer_weld.c joins vertices, layer_insert.c puts vertices into
 * sides, layer_sides.c makes the sides. layer_graph.h finds nodes and borders, with layer_check.h,
 * which refuses regions that overlap. layer_rings.h finds the rings. layer_pairing.h pairs them,
 * leave_out.h drops what differs, border_vertices.h pairs the vertices along borders, and
 * coverage_features.h makes the features.
 *
 * Invariants
 * - Places keep their coordinates bit by bit. Only vertices move, to places.
 * - A border has the region with the smaller index on its left. So borders of both layers have the
 *   same direction. */
#ifndef ICCP_LAYER_H
#define ICCP_LAYER_H

#include "base/env.h"
#include "geometry/frame.h"

#include <stdbool.h>
#include <stdint.h>

#define ICCP_NO_REGION UINT32_MAX

/* The numbers of all regions that take part, in rising order. */
typedef struct iccp_regions {
    size_t n;
    int64_t *id;
} iccp_regions;

/* Returns the index of a region, or ICCP_NO_REGION if it takes no part. */
uint32_t iccp_regions_find(const iccp_regions *regions, int64_t id);

typedef struct iccp_layer_edge {
    uint32_t from, to, region;
} iccp_layer_edge;

typedef struct iccp_layer_side {
    uint32_t end[2];    /* the first is smaller */
    uint32_t region[2]; /* on the left and on the right of the way from end 0 to end 1 */
} iccp_layer_side;

typedef struct iccp_layer {
    const iccp_regions *regions; /* borrowed */
    iccp_frame frame;
    double weld; /* local */
    size_t n;
    double *place; /* 2 n, local */
    size_t n_edges;
    iccp_layer_edge *edge;
    size_t n_sides;
    iccp_layer_side *side;
    /* What was done; lengths and places are local */
    size_t n_given, n_welded, n_inserted, n_chains;
    double chain[2], most_moved, least_apart, least_apart_at[2];
} iccp_layer;

/* Reads a layer. Each vertex of a region that takes part becomes a place. */
icc_status iccp_layer_read(iccp_layer *layer, const icc_layer *given, const iccp_regions *regions,
                           double weld, const iccp_env *env, icc_error *err);
/* Accepts a struct of zeros. */
void iccp_layer_free(iccp_layer *layer, const iccp_memory *memory);

/* Joins the vertices at equal places, and those within the weld length. */
icc_status iccp_layer_weld(iccp_layer *layer, const iccp_env *env);

/* Puts places within the weld length of an edge into it, and measures what is left. */
icc_status iccp_layer_insert(iccp_layer *layer, const iccp_env *env);
icc_status iccp_layer_measure(iccp_layer *layer, const iccp_env *env);

/* Makes the sides from the edges, without those between two parts of one region. Returns
 * ICC_ERR_BOUNDARY if two regions overlap there. */
icc_status iccp_layer_join(iccp_layer *layer, const iccp_env *env, icc_error *err);

/* Reports ICC_ERR_BOUNDARY: two regions (or one, with itself) overlap at a place. */
icc_status iccp_layer_overlap(const iccp_layer *layer, uint32_t a, uint32_t b, const double *place,
                              icc_error *err);

/* A place in the caller's coordinates. */
static inline void iccp_layer_given(const iccp_layer *layer, uint32_t place, double *point)
{
    iccp_frame_restore(&layer->frame, 2, layer->place + 2 * (size_t)place, point);
}

#endif
