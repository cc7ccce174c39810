/* Divides a plane map into patches whose images can be moved independently. */
#ifndef ICCP_PATCHES_H
#define ICCP_PATCHES_H

#include "map/energy/simplicial_map.h"

/* A patch consists of triangles with a movable corner. Triangles that share a movable corner are in
 * one patch. */
typedef struct iccp_patches {
    iccp_memory memory;
    const iccp_simplicial_map *map;
    const uint8_t *movable;
    size_t n;
    size_t *first;      /* of each patch, and the end */
    uint32_t *triangle; /* patch by patch */
    uint32_t *local;    /* of each point of the map: its number in the patch that is cut out */
    /* The patch that is cut out, with room for the largest one. */
    uint32_t *corners, *point;
    double *points, *images;
    uint8_t *fixed;
} iccp_patches;

/* Finds the patches of the points with movable[v] != 0 that are not fixed. Both arguments are
 * borrowed. */
icc_status iccp_patches_create(iccp_patches *patches, const iccp_simplicial_map *map,
                               const uint8_t *movable, const iccp_memory *memory);
void iccp_patches_free(iccp_patches *patches);

/* Returns patch p as a map of its own, in which all other points are fixed. It is valid until the
 * next patch is cut out. */
iccp_simplicial_map iccp_patches_cut_out(iccp_patches *patches, size_t p);

/* Gives the map the images of the patch that was cut out. */
void iccp_patches_put_back(const iccp_patches *patches, const iccp_simplicial_map *part);

#endif
