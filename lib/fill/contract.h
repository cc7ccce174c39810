/* Points are contracted with others. */
#ifndef ICCP_CONTRACT_H
#define ICCP_CONTRACT_H

#include "fill/tets.h"

/* What a contraction of p, whose star is in m->star, with point v of its link would leave, which is
 * the worst quality among the tetrahedra that change; -1 where that is not more than `least`. */
double iccp_contraction_worth(const iccp_tets *m, uint32_t p, uint32_t v, double least);

/* Does it. False: nothing has changed. */
bool iccp_contract(iccp_tets *m, uint32_t p, uint32_t v);

/* Contracts an inner point with the point of its link for which that is worth most, if it is worth
 * more than `least`. */
bool iccp_contract_best(iccp_tets *m, uint32_t p, double least);

#endif
