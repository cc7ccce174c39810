/* Improves a map step by step and mesh by mesh, in the plane and in space. */
#ifndef ICCP_REFINEMENT_H
#define ICCP_REFINEMENT_H

#include "map/energy/descent.h"
#include "map/energy/schedule.h"

/* A map whose energy is higher is far from its best: some of its triangles may be locked, and two
 * refinements may pass before they come free. */
enum { ICCP_HIGH_ENERGY = 20 };

/* What plane and space do differently. */
typedef struct iccp_profile {
    size_t majorised;                 /* so many first steps use SLIM's model */
    double least_gain;                /* a refinement that gains less than this share was in vain */
    size_t (*count)(const void *map); /* returns the number of simplices */
    double (*energy)(const void *map, const iccp_env *env);
    /* See iccp_improve_images(). */
    icc_status (*descend)(void *map, const iccp_descent *descent, bool moves_points,
                          iccp_newton *newton, iccp_work *work, iccp_improvement *improvement,
                          const iccp_env *env);
    /* Changes the mesh in n_changes places where the map has most of its energy. The energy does
     * not rise. */
    icc_status (*refine)(void *map, size_t *n_changes, const iccp_env *env);
} iccp_profile;

/* Lowers the symmetric Dirichlet energy of a map whose simplices are all positive. They stay so,
 * and fixed vertices stay where they are. Takes steps as long as they gain enough. Then refines the
 * mesh and takes steps again, as long as that gains enough and there is work left. On the last mesh
 * the steps go down to the tolerance. On any failure, ICC_ERR_CANCELLED included, the map is valid
 * and no worse than before. */
icc_status iccp_improve_by(const iccp_profile *profile, void *map, const iccp_schedule *schedule,
                           iccp_work *work, iccp_improvement *improvement, const iccp_env *env);

#endif
