/* Newton's method for the elastic energy with springs and contact. */
#ifndef ICCP_ELASTIC_STEP_H
#define ICCP_ELASTIC_STEP_H

#include "fit/elastic/elastic_parts.h"

/* Returns the energy at the present images. It is infinite if a triangle is not positive.
 * ICC_ERR_MEMORY if pairs find no room. */
icc_status iccp_elastic_energy(iccp_elastic_state *state, double *energy);

/* Returns true if all triangles are exactly positive and, with contact, the outlines are exactly
 * simple. *status is an error or ICC_OK. */
bool iccp_elastic_is_valid(const iccp_elastic_state *state, icc_status *status);

/* What one step did. */
typedef struct iccp_elastic_move {
    double before, after; /* the energy */
    double slope;         /* of the energy along the step: minus twice the expected fall */
    double length;        /* share of Newton's step; 0: none was possible */
    double limit;         /* share at which a triangle would flip */
} iccp_elastic_move;

/* Makes one step that lowers the energy and keeps the state valid. */
icc_status iccp_elastic_step(iccp_elastic_state *state, iccp_elastic_move *move,
                             const iccp_env *env);

#endif
