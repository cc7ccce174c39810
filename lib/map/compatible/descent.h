/* Steps that lower the energy of a map on one mesh. */
#ifndef ICCP_DESCENT_H
#define ICCP_DESCENT_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

typedef struct iccp_improvement {
    double energy; /* the map's at the end */
    size_t n_iterations;
    size_t n_levels;   /* refinements */
    bool is_converged; /* the last step gained no more than the tolerance */
} iccp_improvement;

/* When steps on one mesh end. */
typedef struct iccp_descent {
    size_t majorised;  /* the first steps are by SLIM's model */
    size_t iterations; /* at most so many, */
    double tolerance;  /* until one gains no more than this share of the energy, */
    double slow;       /* or two in turn no more than this share each, */
    bool is_hasty;     /* or one */
} iccp_descent;

/* Lowers the symmetric Dirichlet energy of a map in the plane or in space, all of whose simplices
 * are positive, which they stay. Ends, too, when there is no work left for a step. Adds to
 * improvement->n_iterations and sets the others but n_levels; NULL if nobody asks. On any failure
 * the map is as good. */
icc_status iccp_improve_images(const iccp_simplicial_map *map, const iccp_descent *descent,
                               iccp_work *work, iccp_improvement *improvement, const iccp_env *env);

/* The same for the images, and then as many steps for the points of what is not fixed, by the
 * energy of the inverse map. Sets improvement->energy. The map is no worse than before, and no
 * triangle has become so flat, on either side, that doubles would take it for one without area. */
icc_status iccp_improve_both_sides(iccp_plmap *map, const iccp_descent *descent, iccp_work *work,
                                   iccp_improvement *improvement, const iccp_env *env);

#endif
