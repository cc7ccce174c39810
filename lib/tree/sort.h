/* Sorting vertices by their values. */
#ifndef ICCP_SORT_H
#define ICCP_SORT_H

#include <stddef.h>
#include <stdint.h>

/* Sorts n vertices so that their values, none of them NaN, fall. Equal ones stay in their order. `work` has
 * room for n. */
void iccp_sort_falling(uint32_t *vertices, uint32_t *work, size_t n, const double *values);

#endif
