/* The symmetric Dirichlet energy of the linear map of one simplex in the plane or in space. */
#ifndef ICCP_DIRICHLET_H
#define ICCP_DIRICHLET_H

#include "base/simd.h"
#include "map/energy/jacobian.h"

#include <math.h>
#include <stdbool.h>

/* Returns |J|^2 + |J^-1|^2 times the element's area or volume. It is 2 dim times the measure for an
 * isometry, and infinite if the image is not positive. */
double iccp_dirichlet_energy(size_t dim, const double *element, const double *const *image);

/* The plane's version, where |J^-1| = |J| / det. */
static ICCP_INLINE double iccp_dirichlet_energy2(const double *element, const double *const *image)
{
    double j[4];
    const double det = iccp_element_jacobian(2, element, image, j);
    return det > 0 ? element[0] * iccp_squared_norm(2, j) * (1 + 1 / (det * det)) : HUGE_VAL;
}

/* With `majorise`, the Hessian is that of SLIM's quadratic model, which copes with a bad start.
 * Without it, the Hessian is the energy's own. The image must be positive. */
void iccp_dirichlet_local(size_t dim, const double *element, const double *const *image,
                          bool majorise, iccp_local *local);

/* Triangles that are computed side by side: their elements, and the images of corner k of each.
 * Several of them may be the same triangle. */
enum { ICCP_DIRICHLET_LANES = 4 };
typedef struct iccp_dirichlet_batch {
    const double *element[ICCP_DIRICHLET_LANES], *image[3][ICCP_DIRICHLET_LANES];
} iccp_dirichlet_batch;

/* Sets what iccp_dirichlet_local() gives for each triangle of a batch, with the same bits. The
 * first function chooses the instructions by the level. The others use AVX2 and WebAssembly's
 * vectors. */
void iccp_dirichlet_locals(iccp_simd_level level, const iccp_dirichlet_batch *batch, bool majorise,
                           iccp_local *local);
void iccp_dirichlet_locals_avx2(const iccp_dirichlet_batch *batch, bool majorise,
                                iccp_local *local);
void iccp_dirichlet_locals_wasm(const iccp_dirichlet_batch *batch, bool majorise,
                                iccp_local *local);

#endif
