/* An exact proof that the foliation of a mesh by an order of its simplices is one-to-one, from its
 * definition alone: integers and exact signs, whoever made the order and the directions.
 * docs/theory.md says why it is enough. */
#ifndef ICCP_SHELLING_CERTIFICATE_H
#define ICCP_SHELLING_CERTIFICATE_H

#include "geometry/simplices.h"

/* What the checks count. All must be 0. */
typedef struct iccp_shelling_certificate {
    size_t n_inverted;   /* simplices that are not positively oriented */
    size_t n_topology;   /* sides without a proper other side, and facets of the domain without
                            exactly one side that has their vertices; 1 more if the centre is no
                            vertex inside */
    size_t n_order;      /* simplices outside the star without a neighbour of smaller rank, or
                            without a side to greater rank or the boundary; those that have a
                            neighbour outside the star of the same rank; those of the star that have
                            not rank 0, or others that have */
    size_t n_irregular;  /* faces of dimension 0 to dim - 2 that do not have exactly one simplex
                            around them whose sides at the face are all entered, where the star
                            counts as one, and, unless they lie on the boundary, exactly one whose
                            sides are all left, none if they do; faces at the centre do not count */
    size_t n_directions; /* simplices outside the star whose direction does not leave and enter as
                            the order says */
} iccp_shelling_certificate;

/* `facets`: the domain's, dim vertices each, which are the first points of the mesh; that they
 * bound a domain has been checked when it was made. `direction`, dim + 1 numbers for each simplex,
 * are the rates of its barycentric coordinates along the leaf, towards the centre; only their signs
 * matter, and in the star, where leaves are straight lines to the centre, not even those. ICC_OK
 * (whatever it found), ICC_ERR_MEMORY or ICC_ERR_CANCELLED. O(n) at a bounded number of simplices
 * to a vertex. */
icc_status iccp_certify_shelling(iccp_shelling_certificate *certificate, const iccp_simplices *mesh,
                                 const uint32_t *facets, uint32_t centre, const uint32_t *rank,
                                 const double *direction, const iccp_env *env);

bool iccp_shelling_certificate_holds(const iccp_shelling_certificate *certificate);

#endif
