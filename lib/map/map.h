/* The map object: two charts whose boundaries correspond. */
#ifndef ICCP_MAP_H
#define ICCP_MAP_H

#include "chart/chart.h"

struct icc_map {
    iccp_memory memory;
    icc_chart *source, *target;
    icc_map_info info;
};

/* See icc_map_create(); `kind` may be 0. */
icc_status iccp_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                           int32_t kind, const icc_chart_options *source_options,
                           const icc_chart_options *target_options, const iccp_env *env,
                           icc_error *err);

/* See icc_map_create_from_charts(); `kind` may be 0. */
icc_status iccp_map_create_from_charts(icc_map **out, const icc_chart *source,
                                       const icc_chart *target, int32_t kind, const iccp_env *env,
                                       icc_error *err);
void iccp_map_release(icc_map *map);

#endif
