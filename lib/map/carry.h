/* Moving what a one-to-one piecewise linear map holds fixed, and everything else with it. */
#ifndef ICCP_CARRY_H
#define ICCP_CARRY_H

#include "map/tend.h"

/* Moves the images of fixed vertices, all at once and straight, to where a target wants them, in as
 * many parts as that takes. After each one every triangle is positive before and after the map,
 * exactly; so what went round something still does. The mesh is left as it is unless the way is
 * blocked: then iccp_tend() changes it, up to `patience` times in turn.
 *
 * `reached`: whether they are there; not so when images would meet on the way, when the way stays
 * blocked, or when there is no work left. The map is valid in any case. `room`: of the last part,
 * as iccp_tend() wants it. */
icc_status iccp_carry(iccp_plmap *map, const icc_domain *target, const iccp_grain *grain,
                      size_t patience, iccp_work *work, bool *reached, double *room,
                      const iccp_env *env);

/* Where a target wants the image of a fixed vertex. */
void iccp_carry_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
                      double place[2]);

#endif
