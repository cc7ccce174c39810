/* Samples a map on a grid. */
#ifndef ICCP_MAP_SAMPLE_H
#define ICCP_MAP_SAMPLE_H

#include "map/map.h"
#include "sampled/samples.h"

/* See icc_map_sample(). */
icc_status iccp_map_sample(const icc_map *map, bool inverse, const icc_field *field,
                           size_t *n_outside, const iccp_env *env);

#endif
