/* An exact proof that the foliation of a mesh by an order of its simplices is one-to-one. It uses
 * only the definition, with integers and exact signs, and does not depend on how order and
 * directions were made. Source: docs/theory/charts-space.md, "foliations of simplices". */
#ifndef ICCP_SHELLING_CERTIFICATE_H
#define ICCP_SHELLING_CERTIFICATE_H

#include "geometry/simplices.h"

/* Counts of the checks. All must be 0.
 *
 * n_order: simplices of the star must have rank 0, and all others a greater rank. Each of the
 * others needs a neighbour of smaller rank, and a side to greater rank or to the boundary. It may
 * have no neighbour of the same rank.
 *
 * n_irregular: faces at the centre are not checked, and the star counts as one simplex. Exactly one
 * simplex at a face must have all its sides there entered. Exactly one must have them all left, or
 * none if the face lies on the boundary. */
typedef struct iccp_shelling_certificate {
    size_t n_inverted;   /* simplices that are not positively oriented */
    size_t n_topology;   /* sides without a proper partner; facets of the domain without exactly one
                            side that has their vertices; 1 more if the centre is not a vertex
                            inside */
    size_t n_order;      /* simplices that break the order: see above */
    size_t n_irregular;  /* faces of dimension 0 to dim - 2 with a wrong count; see above */
    size_t n_directions; /* simplices outside the star whose direction does not enter and leave as
                            the order demands */
} iccp_shelling_certificate;

/* Certifies a foliation. `facets` are the domain's, with dim vertices each, which are the first
 * points of the mesh. The domain's creation has checked that they bound it.
 *
 * `direction`, dim + 1 numbers for each simplex, are the rates of its barycentric coordinates
 * along the leaf towards the centre. Only their signs matter. They do not matter in the star,
 * where leaves are straight lines to the centre. Returns ICC_OK, whatever it found, or
 * ICC_ERR_MEMORY or ICC_ERR_CANCELLED. O(n) if the number of simplices at a vertex is bounded. */
icc_status iccp_certify_shelling(iccp_shelling_certificate *certificate, const iccp_simplices *mesh,
                                 const uint32_t *facets, uint32_t centre, const uint32_t *rank,
                                 const double *direction, const iccp_env *env);

bool iccp_shelling_certificate_holds(const iccp_shelling_certificate *certificate);

#endif
