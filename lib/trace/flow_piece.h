/* One piece of a curve: from where it is in a simplex to where it leaves it. */
#ifndef ICCP_FLOW_PIECE_H
#define ICCP_FLOW_PIECE_H

#include "trace/flow.h"

/* From walk->place, with the vectors at the corners there. */
icc_status iccp_flow_find_piece(iccp_flow_walk *walk);

#endif
