/* Fill-reducing ordering of a sparse symmetric matrix. */
#ifndef ICCP_ORDERING_H
#define ICCP_ORDERING_H

#include "base/env.h"
#include "math/symmetric.h"

#include <stdbool.h>

/* Whether this build has an ordering. Without one, factorisations would fill up. */
bool iccp_ordering_available(void);

/* order[k] is the row that is eliminated k-th. n < 2^31. ICC_ERR_UNSUPPORTED without an
 * ordering. */
icc_status iccp_ordering(const iccp_symmetric *matrix, uint32_t *order, const iccp_env *env);

#endif
