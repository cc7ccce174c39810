/* Making a certified piecewise linear map fairer without losing its certificate. */
#ifndef ICCP_IMPROVE_H
#define ICCP_IMPROVE_H

#include "map/compatible/descent.h"
#include "map/energy/schedule.h"

/* What maps in the plane and in space do in their own ways. */
typedef struct iccp_profile {
    size_t majorised;  /* the first steps are by SLIM's model */
    double least_gain; /* a refinement is in vain when it gains less than this share */
    size_t (*count)(const void *map); /* of simplices */
    double (*energy)(const void *map, const iccp_env *env);
    icc_status (*descend)(void *map, const iccp_descent *descent, bool both_sides, iccp_work *work,
                          iccp_improvement *improvement, const iccp_env *env);
    /* Changes the mesh where the map has most of its energy, which does not rise; `n_changes`: in
     * how many places. */
    icc_status (*refine)(void *map, size_t *n_changes, const iccp_env *env);
} iccp_profile;

/* Lowers the symmetric Dirichlet energy of a map whose simplices are all positive, which they stay,
 * with what is fixed fixed: by steps as long as they gain enough; then refines and continues, as
 * long as that gains enough and there is work left; the last mesh takes steps down to the
 * tolerance. On any failure, ICC_ERR_CANCELLED included, the map is valid and no worse than
 * before. */
icc_status iccp_improve_by(const iccp_profile *profile, void *map, const iccp_schedule *schedule,
                           iccp_work *work, iccp_improvement *improvement, const iccp_env *env);

/* That for a map in the plane, which is refined by cutting the triangles with the most energy and
 * flipping edges. */
icc_status iccp_improve(iccp_plmap *map, const iccp_schedule *schedule, iccp_work *work,
                        iccp_improvement *improvement, const iccp_env *env);

/* Cuts the triangles that carry most of the energy above an isometry's; each keeps its map. */
icc_status iccp_refine(iccp_plmap *map, size_t *n_cut, const iccp_env *env);

#endif
