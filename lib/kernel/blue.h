/* Blue noise: random samples that are evenly spaced. */
#ifndef ICCP_BLUE_H
#define ICCP_BLUE_H

#include "kernel/places.h"
#include "kernel/shape.h"

/* Adds samples to a list of some that stay where they are. All are in the shape's local
 * coordinates. No sample comes near a wall or leaves its region. ICC_ERR_RESOLUTION if there would
 * be too many to look at. */
icc_status iccp_blue_fill(iccp_places *places, const icc_shape *shape, double spacing,
                          int32_t steps, uint64_t seed, const iccp_env *env);

#endif
