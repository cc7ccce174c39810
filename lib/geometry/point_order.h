/* Sorts points by x, then y. */
#ifndef ICCP_POINT_ORDER_H
#define ICCP_POINT_ORDER_H

#include <stddef.h>
#include <stdint.h>

/* Sorts n indices of finite points (two coordinates each). Equal points keep the order of their
 * indices. `work` has room for n indices. */
void iccp_order_points(uint32_t *order, uint32_t *work, size_t n, const double *points);

#endif
