/* Moves the images of inner vertices one at a time, each by a Newton step of the energy of its
 * star. One sweep visits all of them. */
#ifndef ICCP_RELOCATE_H
#define ICCP_RELOCATE_H

#include "map/energy/descent.h"
#include "map/higher/stars.h"

/* Makes simplices positive, as V. Garanzha and others do (map/energy/untangling.h), until none is
 * left or there is no work for another sweep. Simplices before the map are taken for regular ones
 * with edges of this length, unless it is 0. *n_left counts the simplices that are not positive in
 * the end. */
icc_status iccp_relocate_untangle(const iccp_simplicial_map *map, const iccp_stars *stars,
                                  double edge, iccp_work *work, size_t *n_left,
                                  const iccp_env *env);

/* Lowers the symmetric Dirichlet energy of a map whose simplices are all positive. They stay so,
 * exactly. Takes at most descent->iterations sweeps, and ends when one gains no more than the
 * share descent->tolerance of the energy. If it is cancelled, the map is as good as it got. */
icc_status iccp_relocate_improve(const iccp_simplicial_map *map, const iccp_stars *stars,
                                 const iccp_descent *descent, iccp_work *work,
                                 iccp_improvement *improvement, const iccp_env *env);

#endif
