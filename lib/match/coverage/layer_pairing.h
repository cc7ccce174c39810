/* Pairs the nodes and borders of two layers. */
#ifndef ICCP_LAYER_PAIRING_H
#define ICCP_LAYER_PAIRING_H

#include "match/coverage/layer_graph.h"
#include "match/plane_affine.h"

typedef struct iccp_layer_pairing {
    const iccp_layer_graph *graph[2]; /* borrowed */
    uint32_t *node;           /* of each place of the source: the target's node, or UINT32_MAX */
    uint32_t *border;         /* of each border of the source: the target's, or UINT32_MAX */
    uint32_t *back;           /* of each border of the target: the source's, or UINT32_MAX */
    iccp_plane_affine affine; /* fits what is sure; local coordinates */
    size_t n_settled;
} iccp_layer_pairing;

/* The caller frees the pairing even after an error. */
icc_status iccp_layer_pairing_create(iccp_layer_pairing *pairing, const iccp_layer_graph *source,
                                     const iccp_layer_graph *target, const iccp_env *env);
/* Accepts a struct of zeros. */
void iccp_layer_pairing_free(iccp_layer_pairing *pairing, const iccp_memory *memory);

#endif
