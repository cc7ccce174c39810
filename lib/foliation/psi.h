/* The angle-valued function psi, whose level lines are the leaves of a foliation. Source:
 * docs/theory/charts-plane.md, "method foliation". */
#ifndef ICCP_PSI_H
#define ICCP_PSI_H

#include "math/spd.h"
#include "mesh/laplacian.h"

/* Units in one turn. Differences of labels stay far from the ends of int64_t. */
#define ICCP_TURN ((int64_t)1 << 60)

/* psi maps the mesh without its centre to R/Z. It winds once round the centre, increases along the
 * boundary and is discretely harmonic inside. Labels and rises are integers, so decisions made with
 * them are exact. Each rise has its own lift from R/Z to R. */
typedef struct iccp_psi {
    iccp_memory memory;
    uint32_t centre; /* an inner vertex */
    int64_t *label;  /* n_vertices, in [0, ICCP_TURN); the centre's has no meaning. NULL in loaded
                        charts */
    int64_t *rise;   /* 3 n_triangles: along the half-edge that a corner faces; 0 at the centre */
} iccp_psi;

/* Creates psi. The share `harmonic` of the boundary flux, in [0, 1), follows the Green's
 * function of the centre, and the rest is uniform in arc length. `solver` is the factor of
 * the Laplacian of the whole mesh. */
icc_status iccp_psi_create(iccp_psi *psi, const iccp_planar *mesh, const iccp_laplacian *laplacian,
                           const iccp_ldlt *solver, uint32_t centre, double harmonic,
                           const iccp_env *env);
void iccp_psi_free(iccp_psi *psi);

#endif
