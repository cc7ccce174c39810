/* Domains of the tests' meshes. */
#ifndef TESTS_MESH_DOMAINS_H
#define TESTS_MESH_DOMAINS_H

#include "meshes.h"

#include <check.h>
#include <icc/icc.h>

static inline icc_domain *domain_of_mesh(const test_mesh *m)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(mesh_domain(&domain, m, NULL, &err) == ICC_OK, "%s", err.message);
    return domain;
}

#endif
