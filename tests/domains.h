/* Domains for tests, and points in them. A test fails where something cannot be made. */
#ifndef TESTS_DOMAINS_H
#define TESTS_DOMAINS_H

#include "random.h"

#include <check.h>
#include <icc/icc.h>

typedef struct domain_pair {
    icc_domain *source, *target;
} domain_pair;

static inline void domain_pair_free(domain_pair *p)
{
    icc_domain_free(p->source);
    icc_domain_free(p->target);
}

static inline icc_domain *domain_of_polygon(size_t n, const double *xy)
{
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, NULL), ICC_OK);
    return domain;
}

static inline icc_domain_info info_of_domain(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    return info;
}

/* A random point in a domain, with the same density everywhere. */
static inline void domain_random_point(random_source *r, const icc_domain *domain, double *point)
{
    const icc_domain_info info = info_of_domain(domain);
    int32_t where = ICC_OUTSIDE;
    while (where != ICC_INSIDE) {
        for (int32_t k = 0; k < info.dim; ++k)
            point[k] = random_between(r, info.lower[k], info.upper[k]);
        ck_assert_int_eq(icc_domain_locate(domain, 1, point, &where, NULL, NULL, NULL), ICC_OK);
    }
}

#endif
