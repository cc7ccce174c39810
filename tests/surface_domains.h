/* Domains of the tests' surfaces. */
#ifndef TESTS_SURFACE_DOMAINS_H
#define TESTS_SURFACE_DOMAINS_H

#include "surfaces.h"

#include <check.h>
#include <icc/icc.h>

static inline icc_domain *domain_of_surface(const surface *s)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create(&domain, 3, s->n_vertices, s->vertices, s->n_faces, s->faces,
                                    NULL, &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

#endif
