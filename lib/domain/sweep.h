/* Whether a ring is simple, in O(n log n). */
#ifndef ICCP_SWEEP_H
#define ICCP_SWEEP_H

#include "domain/defect.h"
#include "domain/ring.h"

/* Looks for a defect of a ring of at least 3 finite points; found->kind is 0 if there is none.
 * Which one is found of several says nothing. */
icc_status iccp_sweep(iccp_defect *found, const iccp_ring *ring, const iccp_env *env);

#endif
