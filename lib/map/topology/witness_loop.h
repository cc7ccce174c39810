/* Draws the loop that proves that there is no map. */
#ifndef ICCP_WITNESS_LOOP_H
#define ICCP_WITNESS_LOOP_H

#include "map/topology/witness.h"

/* Finds a short witness: n vertices, joined by edges of the surface, without a vertex twice unless
 * the surface is too coarse for that. n is 0 if the search meets a limit. The caller frees the
 * loop. Returns ICC_OK or ICC_ERR_MEMORY. */
icc_status iccp_witness_draw(uint32_t **loop, size_t *n, const iccp_witness *witness,
                             iccp_region_pair *pair);

#endif
