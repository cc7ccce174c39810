/* Fill-reducing ordering of any sparse symmetric matrix. Lattices have nested dissection of their
 * own (gradient/solver/dissection.h). */
#ifndef ICCP_ORDERING_H
#define ICCP_ORDERING_H

#include "base/env.h"
#include "math/symmetric.h"

/* order[k] is the row that is eliminated k-th. Returns ICC_ERR_RESOLUTION for 2^31 entries or
 * more. */
icc_status iccp_ordering(const iccp_symmetric *matrix, uint32_t *order, const iccp_env *env);

#endif
