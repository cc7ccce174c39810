/* The overlay of two triangulations in given patches of a map. */
#ifndef ICCP_PATCH_OVERLAYS_H
#define ICCP_PATCH_OVERLAYS_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* Replaces the triangles of each patch by an overlay (map/compatible/compatible.h) with the same
 * border. patch_of[t]: the patch of triangle t, or UINT32_MAX. A patch stays as it is unless it is
 * a disc with nothing fixed inside, whose border is a simple polygon before and after the map.
 *
 * *fits is false, and nothing changes, if the borders of all patches have more than `most` corners
 * together. Vertices and triangles are numbered anew. Vertices that are not inside a patch keep
 * their order and come first. O(n) for n triangles, plus the overlays. */
icc_status iccp_overlay_triangles(iccp_plmap *map, size_t n_patches, const uint32_t *patch_of,
                                  size_t most, bool *fits, iccp_work *work, const iccp_env *env);

#endif
