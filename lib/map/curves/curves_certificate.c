/* Certifies a curve map. A certified chart is a homeomorphism of its domain onto the
 * coordinates, so two of them give a one-to-one map. In doubles, charts of method field need one
 * more check (round_trip.h). */
#include "map/curves/curves_certificate.h"

#include "map/curves/round_trip.h"

icc_status iccp_curves_certify(icc_map *map, const iccp_env *env, icc_error *err)
{
    const icc_chart_info *source = &map->source->info, *target = &map->target->info;
    iccp_map_facts *info = &map->info;
    (void)err;
    info->certified = source->certified && target->certified;
    info->reason_side = !source->certified ? 1 : !target->certified ? 2 : 0;
    info->reason = info->reason_side == 2 ? target->reason : source->reason;
    return info->certified && source->method == ICC_METHOD_FIELD
               ? iccp_round_trip_check(map->source, map->target, info, env)
               : ICC_OK;
}
