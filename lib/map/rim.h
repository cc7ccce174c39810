/* Pixels whose centres are so close to the boundary that rounding could decide whether they are
 * inside. */
#ifndef ICCP_RIM_H
#define ICCP_RIM_H

#include "map/map.h"

typedef struct iccp_rim {
    iccp_memory memory;
    size_t n, room;
    struct iccp_rim_pixel {
        int32_t column, row;
        uint8_t before[8];
    } * pixels;
} iccp_rim;

/* Lists them with what the target picture has there, before anything is painted. */
icc_status iccp_rim_create(iccp_rim *rim, const icc_domain *domain, const icc_picture *target,
                           const iccp_env *env);
void iccp_rim_free(iccp_rim *rim);

/* Decides about each, exactly: puts the picture's pixel back or paints it. */
void iccp_rim_settle(const iccp_rim *rim, const icc_map *map, const icc_picture *source,
                     const icc_picture *target);

#endif
