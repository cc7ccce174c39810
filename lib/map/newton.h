/* Newton's method for the images of some vertices of a piecewise linear map. */
#ifndef ICCP_NEWTON_H
#define ICCP_NEWTON_H

#include "map/plmap.h"
#include "math/ldlt.h"

typedef enum iccp_energy {
    ICCP_DIRICHLET,          /* symmetric Dirichlet, its own Hessian */
    ICCP_DIRICHLET_MAJORISED,/* the same with SLIM's */
    ICCP_UNTANGLE
} iccp_energy;

typedef struct iccp_newton {
    iccp_memory memory;
    size_t n_free, n_elements;
    uint32_t *free_vertex;  /* n_free */
    uint32_t *slot;         /* of each vertex among the free ones, or ICCP_NO_NEIGHBOUR */
    uint32_t *triangle;     /* n_elements: triangles with a free corner */
    iccp_element *element;  /* n_elements */
    uint32_t *neighbour;    /* 6 n_elements: which neighbour corner b is of corner a, for (a, b) in
                               (0,1) (0,2) (1,0) (1,2) (2,0) (2,1) */
    size_t *first;          /* the Hessian; rows 2 i and 2 i + 1 belong to free vertex i */
    uint32_t *column;
    double *value, *diagonal;
    double *gradient, *step; /* 2 n_free */
    double *saved;           /* 2 n_free: images to come back to */
    double *work;
    iccp_ldlt factor;
} iccp_newton;

/* For the vertices with movable[v] != 0 that are not fixed; all of them when `movable` is NULL. */
icc_status iccp_newton_create(iccp_newton *newton, const iccp_plmap *map, const uint8_t *movable,
                              const iccp_env *env);
void iccp_newton_free(iccp_newton *newton);

double iccp_newton_energy(const iccp_newton *newton, const iccp_plmap *map, iccp_energy energy,
                          double epsilon);

/* Computes the step and the energy's slope along it. ICC_ERR_SOLVER when there is none. */
icc_status iccp_newton_solve(iccp_newton *newton, const iccp_plmap *map, iccp_energy energy,
                             double epsilon, double *slope, const iccp_env *env);

/* Moves along the step as far as the energy falls enough; where the
 * energy is Dirichlet's no triangle loses its positive image, exactly. Returns the new energy; `before`
 * when nothing could be done. */
double iccp_newton_move(iccp_newton *newton, iccp_plmap *map, iccp_energy energy, double epsilon,
                        double before, double slope);

#endif
