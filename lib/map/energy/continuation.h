/* Moves the fixed points of a one-to-one piecewise linear map, in the plane or in space. */
#ifndef ICCP_CONTINUATION_H
#define ICCP_CONTINUATION_H

#include "domain/domain.h"
#include "map/energy/descent.h"

/* What plane and space do differently. */
typedef struct iccp_continuation {
    iccp_simplicial_map (*see)(const void *map); /* returns a view of the map */
    /* Writes where a target wants the image of a fixed point. `place` has its present image, so a
     * point stays if nothing is written. */
    void (*place)(const void *map, const icc_domain *target, size_t point, double *place);
    double blocked; /* a part of the way that is shorter than this share counts as blocked */
    /* Changes the mesh where it blocks the way. */
    icc_status (*mend)(void *map, iccp_work *work, const iccp_env *env);
} iccp_continuation;

/* Moves the images of fixed points straight to their places in a target, all at once, in as many
 * parts as needed. After each part every simplex is exactly positive before and after the map. So
 * the map keeps its isotopy class. The mesh stays the same unless the way is blocked. Then `mend`
 * changes it, up to `patience` times in turn.
 *
 * *reached is false if images would meet on the way, if the way stays blocked, or if there is no
 * work left. The map is valid in any case. If the target is reached, *room is the way to the first
 * flip as a multiple of the last part. */
icc_status iccp_continue(const iccp_continuation *carriage, void *map, const icc_domain *target,
                         size_t patience, iccp_work *work, bool *reached, double *room,
                         const iccp_env *env);

#endif
