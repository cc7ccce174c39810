/* Common vertices along paired borders. */
#ifndef ICCP_BORDER_VERTICES_H
#define ICCP_BORDER_VERTICES_H

#include "match/coverage/layer_pairing.h"

/* The common vertices of one border, in its direction. An island has its first vertex at the end
 * again. */
typedef struct iccp_common_line {
    size_t n, n_joined;
    double *point[2]; /* 2 n: in the callers' coordinates of source and target */
} iccp_common_line;

typedef struct iccp_border_vertices {
    size_t n;
    iccp_common_line *line; /* of each border of the source; those without a partner are empty */
} iccp_border_vertices;

/* Pairs the vertices of all paired borders whose `is_wanted` is true, by shape or by arc length.
 * The caller frees the vertices even after an error. */
icc_status iccp_border_vertices_create(iccp_border_vertices *vertices,
                                       const iccp_layer_pairing *pairing, const bool *is_wanted,
                                       bool by_arc, const iccp_env *env);
/* Accepts a struct of zeros. */
void iccp_border_vertices_free(iccp_border_vertices *vertices, const iccp_memory *memory);

#endif
