/* Where a piece of a curve leaves its simplex, with all safeguards. */
#ifndef ICCP_FLOW_EXIT_H
#define ICCP_FLOW_EXIT_H

#include "field/flow.h"

/* Sets walk->end and walk->exit, given power series that hold as far as walk->scale: the piece is
 * cut there if it does not leave before. */
void iccp_flow_find_exit(iccp_flow_walk *walk);

#endif
