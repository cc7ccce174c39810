/* The energy of a function on a mesh: the integral of its squared Laplacian. */
#ifndef ICCP_BIHARMONIC_ENERGY_H
#define ICCP_BIHARMONIC_ENERGY_H

#include "kernel/biharmonic/region_mesh.h"
#include "math/gram.h"

/* Makes the matrix Q of the energy w'Qw, with one row for each vertex of the mesh. It is L'M^-1 L,
 * with the Laplacian L by cotangents, and a third of the area around each vertex in M. */
icc_status iccp_biharmonic_energy(iccp_gram *energy, const iccp_region_mesh *mesh,
                                  const iccp_env *env);

#endif
