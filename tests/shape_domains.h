/* Domains of the tests' shapes. */
#ifndef TESTS_SHAPE_DOMAINS_H
#define TESTS_SHAPE_DOMAINS_H

#include "domains.h"
#include "shapes.h"

#include <check.h>
#include <icc/icc.h>

static inline icc_domain *domain_of_shape(const shape *s)
{
    return domain_of_polygon(s->n, s->xy);
}

#endif
