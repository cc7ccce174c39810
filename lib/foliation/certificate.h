/* Exact proofs that a planar chart is one-to-one, independent of how it was made.
 *
 * Source: docs/theory/charts-plane.md, "method foliation" and "method disc", which say what the
 * checks prove. */
#ifndef ICCP_CERTIFICATE_H
#define ICCP_CERTIFICATE_H

#include "foliation/psi.h"

/* Counts of the checks. All but `n_ties` must be 0. */
typedef struct iccp_certificate {
    size_t n_inverted;  /* triangles that are not counter-clockwise */
    size_t n_topology;  /* half-edges without a proper twin that are not edges of the boundary; 1
                           more unless vertices - edges + triangles is 1 */
    size_t n_open;      /* triangles whose rises do not sum to 0, and half-edges whose rise is not
                           the opposite of their twin's */
    size_t n_flat;      /* triangles, boundary edges and edges round the centre whose rise is 0 */
    size_t n_irregular; /* vertices that do not have one ascending and one descending run of
                           neighbours; 1 more unless psi winds once along the boundary */
    size_t n_ties;      /* edges whose ends have the same label; they are ordered by vertex index */
} iccp_certificate;

bool iccp_certificate_holds(const iccp_certificate *certificate);

/* Checks that the mesh with its corners at `points` is a triangulated disc whose boundary is 0,
 * 1, .., n_boundary - 1. Sets n_inverted and n_topology. */
void iccp_certify_mesh(const iccp_planar *mesh, const double *points,
                       iccp_certificate *certificate);

/* Counts exactly the triangles that are not counter-clockwise with their corners at `points`. */
size_t iccp_count_inverted(const iccp_planar *mesh, const double *points);

/* Checks that the level lines of psi are leaves from the boundary to the centre that never meet.
 * Sets n_open, n_flat, n_irregular and n_ties. */
icc_status iccp_certify_psi(const iccp_planar *mesh, const iccp_psi *psi,
                            iccp_certificate *certificate, const iccp_memory *memory);

#endif
