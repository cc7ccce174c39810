/* Moving what a one-to-one piecewise linear map holds fixed, and everything else with it, in the
 * plane or in space. */
#ifndef ICCP_CARRY_H
#define ICCP_CARRY_H

#include "map/compatible/tend.h"

/* What maps in the plane and in space do in their own ways. */
typedef struct iccp_carriage {
    iccp_simplicial_map (*see)(const void *map);
    /* Where a target wants the image of a fixed point. */
    void (*place)(const void *map, const icc_domain *target, size_t point, double *place);
    double blocked; /* a part that gets no farther than this share is blocked */
    /* Changes the mesh where it is in the way. */
    icc_status (*mend)(void *map, iccp_work *work, const iccp_env *env);
} iccp_carriage;

/* Moves the images of fixed points, all at once and straight, to where a target wants them, in as
 * many parts as that takes. After each one every simplex is positive before and after the map,
 * exactly; so what went round something still does. The mesh is left as it is unless the way is
 * blocked: then it is mended, up to `patience` times in turn.
 *
 * `reached`: whether they are there; not so when images would meet on the way, when the way stays
 * blocked, or when there is no work left. The map is valid in any case. `room`: how many times the
 * last part could have been made before something flips. */
icc_status iccp_carry_by(const iccp_carriage *carriage, void *map, const icc_domain *target,
                         size_t patience, iccp_work *work, bool *reached, double *room,
                         const iccp_env *env);

/* That for a map in the plane, which iccp_tend() mends; `room` is as iccp_tend() wants it. */
icc_status iccp_carry(iccp_plmap *map, const icc_domain *target, const iccp_grain *grain,
                      size_t patience, iccp_work *work, bool *reached, double *room,
                      const iccp_env *env);

/* Where a target wants the image of a fixed vertex. */
void iccp_carry_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
                      double place[2]);

#endif
