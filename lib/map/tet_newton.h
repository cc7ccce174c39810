/* Newton's method for the images of some vertices of a tetrahedral mesh: what map/newton.h has for
 * triangles, for the untangling energy only. */
#ifndef ICCP_TET_NEWTON_H
#define ICCP_TET_NEWTON_H

#include "domain/simplices.h"
#include "map/tet_distortion.h"
#include "math/symmetric.h"

typedef struct iccp_tet_newton {
    iccp_memory memory;
    const iccp_simplices *mesh;
    double *images; /* 3 for each point of the mesh */
    size_t n_free, n_elements;
    uint32_t *free_point; /* n_free */
    uint32_t *slot;       /* of each point among the free ones, or UINT32_MAX */
    uint32_t *simplex;    /* n_elements: simplices with a free corner */
    iccp_tet *element;    /* n_elements */
    uint32_t *neighbour;  /* 12 n_elements: which neighbour corner b is of corner a */
    size_t *first;        /* the Hessian; rows 3 i to 3 i + 2 belong to free point i */
    uint32_t *column;
    double *value, *diagonal;
    double *gradient, *step; /* 3 n_free */
    double *saved;           /* 3 n_free: images to come back to */
    double *work;
} iccp_tet_newton;

/* For inner points with movable[v] != 0; all of them when `movable` is NULL. The mesh is multiplied by
 * `stretch`. */
icc_status iccp_tet_newton_create(iccp_tet_newton *newton, const iccp_simplices *mesh,
                                  double *images, const uint8_t *movable, double stretch,
                                  const iccp_env *env);
void iccp_tet_newton_free(iccp_tet_newton *newton);

double iccp_tet_newton_energy(const iccp_tet_newton *newton, double epsilon);

/* The smallest determinant, and how many are not positive. */
double iccp_tet_newton_least(const iccp_tet_newton *newton, size_t *n_bad);

/* Computes a step and the energy's slope along it. */
icc_status iccp_tet_newton_solve(iccp_tet_newton *newton, double epsilon, double *slope,
                                 const iccp_env *env);

/* Moves along the step as far as the energy falls enough. Returns the new energy; `before` when nothing
 * could be done. */
double iccp_tet_newton_move(iccp_tet_newton *newton, double epsilon, double before, double slope);

#endif
