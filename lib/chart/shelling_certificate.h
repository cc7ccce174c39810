/* An exact proof that the foliation of a mesh by an order of its simplices is one-to-one, from its
 * definition alone: integers and exact signs, whoever made the order and the directions.
 * docs/theory.md says why it is enough. */
#ifndef ICCP_SHELLING_CERTIFICATE_H
#define ICCP_SHELLING_CERTIFICATE_H

#include "domain/simplices.h"

/* What the checks count. All must be 0. */
typedef struct iccp_shelling_certificate {
    size_t n_inverted;    /* simplices that are not positively oriented */
    size_t n_topology;    /* sides without a proper other side, or not on the boundary's facet where they
                             should be; 1 more unless the Euler characteristic is 1, unless all simplices
                             hang together, and unless the link of the centre is a closed manifold of the
                             right Euler characteristic */
    size_t n_order;       /* simplices outside the star without a neighbour of smaller rank or without a
                             side to greater rank or the boundary; neighbours of the same rank */
    size_t n_irregular;   /* faces of dimension 0 to dim - 2 that do not have exactly one simplex around
                             them whose sides at the face are all entered, and, unless they lie on the
                             boundary, one whose sides are all left */
    size_t n_directions;  /* simplices whose direction does not leave and enter as the order says */
} iccp_shelling_certificate;

/* `direction`, dim + 1 numbers for each simplex, are the rates of its barycentric coordinates along the
 * leaf, towards the centre. ICC_OK (whatever it found), ICC_ERR_MEMORY or ICC_ERR_CANCELLED. O(n). */
icc_status iccp_certify_shelling(iccp_shelling_certificate *certificate, const iccp_simplices *mesh,
                                 uint32_t centre, const uint32_t *rank, const double *direction,
                                 const iccp_env *env);

#endif
