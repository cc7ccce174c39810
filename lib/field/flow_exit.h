/* Finds where a piece of a curve leaves its simplex. This is slow but always succeeds. Source:
 * docs/theory/charts-space.md, "fields on grids", step 3. */
#ifndef ICCP_FLOW_EXIT_H
#define ICCP_FLOW_EXIT_H

#include "field/flow.h"

/* Sets walk->end and walk->exit. The power series must hold up to walk->scale, and the piece is
 * cut there if it does not leave earlier. */
void iccp_flow_find_exit(iccp_flow_walk *walk);

#endif
