/* The part of a plane map that changes when its target moves.
 *
 * A face of the network changes if a vertex on its walks has another place in the new target. All
 * other faces stay. There every vertex keeps its point and its image, bit for bit. So only the
 * faces that change are moved, as a map of their own. The triangles across their sides belong to it
 * as well, because a cut of a side cuts them, too. Their free vertices are held (ICCP_ON_POINT). */
#ifndef ICCP_MOVING_PART_H
#define ICCP_MOVING_PART_H

#include "map/compatible/plmap.h"

typedef struct iccp_moving_part {
    bool is_whole;  /* all faces change; then the rest is empty */
    iccp_plmap map; /* the part; its mesh may change, but the first n_fixed vertices stay */
    /* The part as it was cut out */
    size_t n_first, n_fixed; /* its vertices, and how many of them are fixed; these come first */
    uint32_t *vertex;        /* of each of its vertices: the number in the whole map */
    size_t n_triangles;
    uint32_t *corners;  /* of its triangles */
    uint8_t *is_inside; /* of each triangle of the whole map: 1 if it is in the part */
} iccp_moving_part;

/* Cuts out the part of a map that changes between two targets. `whole` is a map to the old target.
 * If the targets have different frames, all faces change. O(n). */
icc_status iccp_moving_part_create(iccp_moving_part *part, const iccp_plmap *whole,
                                   const icc_domain *old_target, const icc_domain *target,
                                   const iccp_env *env);

/* Puts the part back where it was cut out. On failure `whole` stays as it is. O(n). */
icc_status iccp_moving_part_put_back(const iccp_moving_part *part, iccp_plmap *whole,
                                     const iccp_env *env);

void iccp_moving_part_free(iccp_moving_part *part);

/* Whether a fixed vertex of a map keeps its place from one target to the next. The targets must
 * have the same frame. Vertices that are not on the network stay. */
bool iccp_stays(const iccp_plmap *map, size_t vertex, const icc_domain *old_target,
                const icc_domain *target);

#endif
