/* Domains as part of the bytes of other objects; see docs/formats.md. They are written as what they
 * were made from, and rebuilt: everything is checked as it was then. Writing takes no env and
 * cannot fail; where reading fails with ICC_ERR_FORMAT nothing is said, and the object is NULL. */
#ifndef ICCP_DOMAIN_FILE_H
#define ICCP_DOMAIN_FILE_H

#include "base/blob.h"
#include "domain/domain.h"
#include "geometry/simplices.h"

/* The boundary alone; its dimension is written elsewhere. */
icc_status iccp_boundary_visit(iccp_blob *b, icc_domain **domain, int32_t dim, const iccp_env *env);

/* Whatever it was made from: a boundary, a mask or a mesh, without features. Points of a mesh that
 * is read have the numbers that the domain gave them, not the first caller's. */
icc_status iccp_domain_visit(iccp_blob *b, icc_domain **domain, const iccp_env *env);

/* The same, or a polygon with features. */
icc_status iccp_domain_visit_any(iccp_blob *b, icc_domain **domain, const iccp_env *env);

/* Another mesh of a domain, whose first points are its vertices, or NULL. It does not know the
 * caller's numbers. Refused unless it is positive, conforming and a ball, with the facets of the
 * domain. */
icc_status iccp_filling_visit(iccp_blob *b, iccp_simplices **mesh, const icc_domain *domain);

/* Whether numbers can be local coordinates of points in a domain of the given dimension, for which
 * signs of determinants are exact: of size 2 at most, and not next to nothing. */
bool iccp_are_local(size_t dim, size_t n, const double *numbers);

#endif
