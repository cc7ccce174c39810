/* The nodes and borders of a layer. */
#ifndef ICCP_LAYER_GRAPH_H
#define ICCP_LAYER_GRAPH_H

#include "match/coverage/layer.h"

/* The two directions of side s are the half-sides 2 s, from end 0 to end 1, and 2 s + 1. */
typedef struct iccp_border {
    size_t first;       /* its places are at[first] up to at[first + n]; those of an island begin
                           and end with the same place */
    uint32_t n;         /* sides */
    uint32_t half[2];   /* the half-sides that leave its two ends */
    uint32_t region[2]; /* left and right; the first is smaller */
    uint32_t piece[2];  /* the pieces there; layer_rings.h fills them in */
    bool is_island;
} iccp_border;

typedef struct iccp_layer_graph {
    const iccp_layer *layer; /* borrowed */
    uint32_t *first;         /* n + 1: where the half-sides that leave each place begin */
    uint32_t *leaving;       /* 2 n_sides: counter-clockwise round each place */
    size_t n_borders;
    iccp_border *border;
    uint32_t *at;     /* places along all borders */
    uint32_t *course; /* of each half-side: 2 b along border b, 2 b + 1 against it */
    size_t n_nodes, n_islands;
} iccp_layer_graph;

static inline uint32_t iccp_half_from(const iccp_layer *layer, uint32_t h)
{
    return layer->side[h / 2].end[h & 1];
}

static inline uint32_t iccp_half_left(const iccp_layer *layer, uint32_t h)
{
    return layer->side[h / 2].region[h & 1];
}

/* Returns the number of sides that meet in a place. */
static inline uint32_t iccp_graph_degree(const iccp_layer_graph *graph, uint32_t place)
{
    return graph->first[place + 1] - graph->first[place];
}

static inline bool iccp_graph_is_node(const iccp_layer_graph *graph, uint32_t place)
{
    return iccp_graph_degree(graph, place) > 2;
}

/* Makes the graph. Returns ICC_ERR_BOUNDARY if the regions around a place overlap. The caller frees
 * it even after an error. */
icc_status iccp_layer_graph_create(iccp_layer_graph *graph, const iccp_layer *layer,
                                   const iccp_env *env, icc_error *err);
/* Accepts a struct of zeros. */
void iccp_layer_graph_free(iccp_layer_graph *graph, const iccp_memory *memory);

#endif
