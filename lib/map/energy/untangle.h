/* Making the images of all simplices of a map positive while its mesh stays. */
#ifndef ICCP_UNTANGLE_H
#define ICCP_UNTANGLE_H

#include "map/energy/simplicial_map.h"
#include "map/energy/work.h"

/* A round is given up when more simplices than `most` are inverted after so much work. */
typedef struct iccp_trial {
    size_t most;
    double work;
} iccp_trial;

/* Moves images by Newton's method in the patches of round `round`, of which the plane has
 * ICCP_PLANE_ROUNDS. `marks`: room for a byte for each point. `trial` may be NULL. Steps are
 * capped, and end when there is no work left for one. */
enum { ICCP_PLANE_ROUNDS = 4 };
icc_status iccp_untangle_patches(const iccp_simplicial_map *map, size_t round, uint8_t *marks,
                                 const iccp_trial *trial, iccp_work *work, const iccp_env *env);

/* Marks with 1 the corners of simplices to be repaired, and with 2 to `rings` rings of
 * neighbours. */
void iccp_untangle_mark(const iccp_simplicial_map *map, int rings, uint8_t *marks);

/* Round by round, patches and then everything, as far as that goes. `n_left` says how many
 * simplices are not positive in the end. */
icc_status iccp_untangle(const iccp_simplicial_map *map, iccp_work *work, size_t *n_left,
                         const iccp_env *env);

#endif
