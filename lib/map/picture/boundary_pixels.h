/* Pixels whose centres are so close to the boundary that rounding could decide whether they are
 * inside. */
#ifndef ICCP_BOUNDARY_PIXELS_H
#define ICCP_BOUNDARY_PIXELS_H

#include "map/map.h"
#include "map/picture/sampler.h"

typedef struct iccp_boundary_pixels {
    iccp_memory memory;
    size_t n, room;
    struct iccp_boundary_pixel {
        int32_t column, row;
        uint8_t before[8]; /* what the target had there */
    } * pixels;
} iccp_boundary_pixels;

/* Lists them with what the target picture has there, before anything is painted. */
icc_status iccp_boundary_pixels_create(iccp_boundary_pixels *boundary, const icc_domain *domain,
                                       const icc_picture *target, const iccp_env *env);
void iccp_boundary_pixels_free(iccp_boundary_pixels *boundary);

/* Decides about each, exactly: puts the picture's pixel back or paints it. */
void iccp_boundary_pixels_decide(const iccp_boundary_pixels *boundary, const icc_map *map,
                                 const iccp_sampler *source, const icc_picture *target);

#endif
