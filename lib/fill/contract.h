/* Contractions: a point is merged into a neighbour. */
#ifndef ICCP_CONTRACT_H
#define ICCP_CONTRACT_H

#include "fill/tets.h"

/* Returns the worst quality among the tetrahedra that change if p, whose star is in m->star, is
 * contracted with point v of its link. Returns -1 if that is not more than `least`. */
double iccp_contraction_worth(const iccp_tets *m, uint32_t p, uint32_t v, double least);

/* Contracts p with v. Returns false if nothing has changed. */
bool iccp_contract(iccp_tets *m, uint32_t p, uint32_t v);

/* Contracts an inner point with the best point of its link, if the result is better than
 * `least`. */
bool iccp_contract_best(iccp_tets *m, uint32_t p, double least);

#endif
