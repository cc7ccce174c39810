/* Reads and writes domains as part of other objects' bytes; see docs/reference/formats.md. The
 * bytes contain the data that the domain was made from. Reading makes it again with all its checks.
 * Writing takes no env and cannot fail. If reading fails with ICC_ERR_FORMAT, there is no message
 * and the object is NULL. */
#ifndef ICCP_DOMAIN_FILE_H
#define ICCP_DOMAIN_FILE_H

#include "base/blob.h"
#include "domain/domain.h"
#include "geometry/simplices.h"

/* Only the boundary. Its dimension is written elsewhere. */
icc_status iccp_boundary_visit(iccp_blob *b, icc_domain **domain, int32_t dim, const iccp_env *env);

/* A domain made from a boundary, a mask or a mesh, without features. When a mesh is read, its
 * points have the numbers that the domain gave them, not the first caller's. */
icc_status iccp_domain_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env);

/* Any domain, including polygons and solids with features. */
icc_status iccp_domain_visit_any(iccp_blob *b, icc_domain **domain, const iccp_env *env);

/* Another mesh of a domain, or NULL. Its first points are the domain's vertices, and it does not
 * know the caller's numbers. Refused unless it is positive, conforming and a ball, with the facets
 * of the domain. */
icc_status iccp_filling_visit(iccp_blob *b, iccp_simplices **mesh, const icc_domain *domain);

/* Returns true if the numbers can be local coordinates in a domain of the given dimension, for
 * which signs of determinants are exact. Their size is 2 at most, and they are not too close to
 * 0. */
bool iccp_are_local(size_t dim, size_t n, const double *numbers);

#endif
