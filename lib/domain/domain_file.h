/* Domains as part of the bytes of other objects; see docs/formats.md. They are written as what they
 * were made from, and made again: everything is checked as it was then. Where reading fails with
 * ICC_ERR_FORMAT nothing is said. */
#ifndef ICCP_DOMAIN_FILE_H
#define ICCP_DOMAIN_FILE_H

#include "base/blob.h"
#include "domain/domain.h"
#include "domain/simplices.h"

/* The boundary alone; its dimension is written elsewhere. */
void iccp_boundary_write(const icc_domain *domain, iccp_blob_writer *w);
icc_status iccp_boundary_read(icc_domain **out, int32_t dim, iccp_blob_reader *r,
                              const iccp_env *env);

/* Whatever it was made from: a boundary, a mask or a mesh. Points of a mesh that is read have the
 * numbers that the domain gave them, not the first caller's. */
void iccp_domain_write(const icc_domain *domain, iccp_blob_writer *w);
icc_status iccp_domain_read(icc_domain **out, iccp_blob_reader *r, const iccp_env *env);

/* Another mesh of a domain, whose first points are its vertices. It does not know the caller's
 * numbers. Refused unless it is positive, conforming and a ball, with the facets of the domain. */
void iccp_filling_write(const iccp_simplices *mesh, iccp_blob_writer *w);
icc_status iccp_filling_read(iccp_simplices **out, const icc_domain *domain, iccp_blob_reader *r,
                             const iccp_env *env);

/* Whether numbers can be local coordinates of points in a domain of the given dimension, for which
 * signs of determinants are exact: of size 2 at most, and not next to nothing. */
bool iccp_are_local(size_t dim, size_t n, const double *numbers);

#endif
