/* Blue noise: random samples that are evenly spaced. */
#ifndef ICCP_BLUE_NOISE_H
#define ICCP_BLUE_NOISE_H

#include "kernel/sampling/point_list.h"
#include "kernel/sampling/shape.h"

/* Adds samples to a list, whose points stay where they are. All are in the shape's local
 * coordinates. No sample comes near a wall or leaves its region. Returns ICC_ERR_RESOLUTION if
 * there would be too many candidates. */
icc_status iccp_blue_noise_fill(iccp_point_list *list, const icc_shape *shape, double spacing,
                                int32_t steps, uint64_t seed, const iccp_env *env);

#endif
