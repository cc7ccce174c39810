/* Pixels whose centres are so close to the boundary that rounding could decide whether they lie
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
        uint8_t before[8]; /* the target's pixel before painting */
    } * pixels;
} iccp_boundary_pixels;

/* Lists these pixels and saves the target's pixels there. Call it before anything is painted. */
icc_status iccp_boundary_pixels_create(iccp_boundary_pixels *boundary, const icc_domain *domain,
                                       const icc_picture *target, const iccp_env *env);
void iccp_boundary_pixels_free(iccp_boundary_pixels *boundary);

/* Decides each pixel exactly: restores the target's pixel, or paints the pixel. */
void iccp_boundary_pixels_decide(const iccp_boundary_pixels *boundary, const icc_map *map,
                                 const iccp_sampler *source, const icc_picture *target);

#endif
