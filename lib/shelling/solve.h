/* Solves equations whose unknowns are values at the facets or in the simplices of a mesh.
 * Source: see solve.c. */
#ifndef ICCP_SHELLING_SOLVE_H
#define ICCP_SHELLING_SOLVE_H

#include "geometry/simplices.h"
#include "math/symmetric.h"

/* How the unknowns of a matrix like the Laplacian relate to a mesh. */
typedef struct iccp_unknowns {
    const iccp_simplices *mesh;
    const bool *fixed;     /* of each point: functions without sources are 0 there */
    size_t n_points;       /* an unknown is about the mean of a function over this many points, */
    const uint32_t *point; /* which are these */
} iccp_unknowns;

/* Solves for one right side, which becomes the solution. It factorises the matrix if that is
 * cheap enough, or if nothing else helps. */
icc_status iccp_shelling_solve(const iccp_symmetric *matrix, const iccp_unknowns *unknowns,
                               double *b, const iccp_env *env);

#endif
