/* The parts of a map in the plane whose images can be moved without regard to one another. */
#ifndef ICCP_PATCHES_H
#define ICCP_PATCHES_H

#include "map/energy/simplicial_map.h"

/* Triangles with a corner that may be moved; those of one patch are neighbours by such corners. */
typedef struct iccp_patches {
    iccp_memory memory;
    const iccp_simplicial_map *map;
    const uint8_t *movable;
    size_t n;
    size_t *first;      /* of each patch, and the end */
    uint32_t *triangle; /* patch by patch */
    uint32_t *local;    /* of each point of the map: which one of the patch that is cut out it is */
    /* What is cut out: room for the largest patch. */
    uint32_t *corners, *point;
    double *points, *images;
    uint8_t *fixed;
} iccp_patches;

/* Of the points with movable[v] != 0 that are not fixed. Both are borrowed. */
icc_status iccp_patches_create(iccp_patches *patches, const iccp_simplicial_map *map,
                               const uint8_t *movable, const iccp_memory *memory);
void iccp_patches_free(iccp_patches *patches);

/* Patch p as a map of its own, until the next one is cut out; all other points are fixed. */
iccp_simplicial_map iccp_patches_cut_out(iccp_patches *patches, size_t p);

/* Gives the map the images of the patch that was cut out. */
void iccp_patches_put_back(const iccp_patches *patches, const iccp_simplicial_map *part);

#endif
