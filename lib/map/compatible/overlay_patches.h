/* The overlay of two triangulations in patches, if a large map is inverted in only a few places. */
#ifndef ICCP_OVERLAY_PATCHES_H
#define ICCP_OVERLAY_PATCHES_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* Replaces the triangles around each inverted triangle by an overlay (map/compatible/compatible.h)
 * with the same border. A patch is a disc of triangles with nothing fixed inside. Its border is a
 * simple polygon before and after the map. Patches grow until that holds.
 *
 * Gives up when the borders of all patches have more than `most` corners together. Then the overlay
 * of the whole map costs less. *n_left counts the triangles that are inverted in the end, 0 unless
 * it gave up. Vertices and triangles are numbered anew; vertices of the boundary keep their
 * numbers. O(rings n) for n triangles, plus the overlays. */
icc_status iccp_overlay_patches(iccp_plmap *map, size_t most, iccp_work *work, size_t *n_left,
                                const iccp_env *env);

#endif
