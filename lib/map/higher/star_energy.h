/* Energies of a star as its vertex moves, in any dimension.
 *
 * The Jacobian J of a simplex changes by u g^T if the image of one corner moves by u. So |J|^2 is a
 * quadratic function of u, the determinant is an affine one, and the inverse of J follows from the
 * formula of J. Sherman and W. J. Morrison (1950). All derivatives are therefore short formulas. */
#ifndef ICCP_STAR_ENERGY_H
#define ICCP_STAR_ENERGY_H

#include "icc/base.h"
#include "map/energy/simplicial_map.h"

/* Which energy. With `epsilon` 0 it is the symmetric Dirichlet energy |J|^2 + |J^-1|^2, which is
 * infinite unless all simplices are positive. With a larger one it is the untangling energy of
 * map/energy/untangling.h, which is finite for every image. */
typedef struct iccp_star {
    const iccp_simplicial_map *map;
    uint32_t vertex;
    size_t n;
    const uint32_t *simplex;
    double epsilon;
    double edge; /* compare with regular simplices of this edge length; 0: with those before */
} iccp_star;

/* The derivatives by the vertex's image. The Hessian has positive eigenvalues, because negative
 * curvature is left out. */
typedef struct iccp_star_local {
    double gradient[ICC_MAX_DIM], hessian[ICC_MAX_DIM * ICC_MAX_DIM];
} iccp_star_local;

/* The energy of the star, up to a constant factor. `local` may be NULL. */
double iccp_star_energy(const iccp_star *star, iccp_star_local *local);

/* The smallest determinant of a Jacobian of the map. */
double iccp_least_determinant(const iccp_simplicial_map *map, double edge);

#endif
