/* Nearest boundary points from anywhere: no point of the boundary is nearer. */
#include "icc/icc.h"

#include "../../random.h"
#include "../../shapes.h"
#include "../../suite.h"
#include "../../surfaces.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

static const double SIZES[] = {1,    30,   1e3,   1.1e3, 1e4,   1e6,   1e9,
                               1e15, 1e60, 1e100, 1e150, 1e155, 1e200, 1e300};
enum { N_SIZES = sizeof SIZES / sizeof *SIZES };

typedef struct eye {
    double u[ICC_MAX_DIM], bend;
} eye;

/* Half the difference of the squared distance from |p|^2, over |p|, which orders points. */
static double value(const eye *e, int32_t dim, const double *q)
{
    double sum = 0;
    for (int32_t k = 0; k < dim; ++k)
        sum += q[k] * (e->bend * q[k] - e->u[k]);
    return sum;
}

static eye eye_at(int32_t dim, const double *p)
{
    eye e = {{0}, 0};
    double largest = 0, length = 0;
    for (int32_t k = 0; k < dim; ++k)
        largest = fmax(largest, fabs(p[k]));
    for (int32_t k = 0; k < dim; ++k)
        length += p[k] / largest * (p[k] / largest);
    length = sqrt(length);
    for (int32_t k = 0; k < dim; ++k)
        e.u[k] = p[k] / largest / length;
    e.bend = 0.5 / length / largest;
    return e;
}

/* The facet's point is as near as all vertices and middles of facets are. */
static void look(const icc_domain *domain, const icc_domain_info *info, const double *vertices,
                 const uint32_t *facets, const double *p, double size)
{
    const int32_t dim = info->dim;
    const size_t n = (size_t)dim;
    int32_t where;
    uint32_t facet;
    double bary[ICC_MAX_DIM], q[ICC_MAX_DIM] = {0};
    ck_assert_int_eq(icc_domain_locate(domain, 1, p, &where, &facet, bary, NULL), ICC_OK);
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < n; ++k)
            q[k] += bary[i] * vertices[n * facets[n * facet + i] + k];
    const eye e = eye_at(dim, p);
    const double found = value(&e, dim, q);
    for (size_t f = 0; f < info->n_facets; ++f) {
        double middle[ICC_MAX_DIM] = {0};
        for (size_t i = 0; i < n; ++i) {
            const double *v = vertices + n * facets[n * f + i];
            for (size_t k = 0; k < n; ++k)
                middle[k] += v[k] / (double)n;
            ck_assert_msg(found <= value(&e, dim, v) + 4e-15 * size,
                          "%d-D, %g sizes away: a vertex of facet %zu is nearer by %g", (int)dim,
                          size, f, found - value(&e, dim, v));
        }
        ck_assert_msg(found <= value(&e, dim, middle) + 4e-15 * size,
                      "%d-D: the middle of facet %zu is nearer", (int)dim, f);
    }
}

static void look_around(const icc_domain *domain, random_source *r)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    const size_t n = (size_t)info.dim;
    double *vertices = malloc(n * info.n_vertices * sizeof *vertices);
    uint32_t *facets = malloc(n * info.n_facets * sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(domain, vertices, facets), ICC_OK);
    double size = 0;
    for (size_t k = 0; k < n; ++k)
        size = fmax(size, fmax(fabs(info.lower[k]), fabs(info.upper[k])));
    for (int s = 0; s < N_SIZES; ++s)
        for (int t = 0; t < 12; ++t) {
            double p[ICC_MAX_DIM];
            /* Also along axes and diagonals, where many points are equally near. */
            for (size_t k = 0; k < n; ++k)
                p[k] = SIZES[s] * (t < 8    ? random_between(r, -1, 1)
                                   : t < 10 ? (k == (size_t)t % n) + (k == 0) * 1e-9
                                            : (t & 1) * 2 - 1);
            look(domain, &info, vertices, facets, p, size);
        }
    free(vertices);
    free(facets);
}

START_TEST(polygons)
{
    random_source r = {1};
    for (int k = 0; k < 8; ++k) {
        const shape s = shape_number(k);
        icc_domain *domain;
        ck_assert_int_eq(icc_domain_create(&domain, 2, s.n, s.xy, 0, NULL, NULL, NULL), ICC_OK);
        look_around(domain, &r);
        icc_domain_free(domain);
    }
}
END_TEST

START_TEST(surfaces)
{
    static surface s;
    random_source r = {2};
    for (int k = 0; k < 4; ++k) {
        icc_domain *domain;
        surface_star(&s, k, k == 0 ? 0 : 0.3, &r);
        ck_assert_int_eq(
            icc_domain_create(&domain, 3, s.n_vertices, s.vertices, s.n_faces, s.faces, NULL, NULL),
            ICC_OK);
        look_around(domain, &r);
        icc_domain_free(domain);
    }
}
END_TEST

START_TEST(simplices)
{
    random_source r = {3};
    for (int32_t dim = 4; dim <= ICC_MAX_DIM; ++dim) {
        double vertices[(ICC_MAX_DIM + 1) * ICC_MAX_DIM] = {0};
        uint32_t facets[(ICC_MAX_DIM + 1) * ICC_MAX_DIM];
        const uint32_t n = (uint32_t)dim;
        for (uint32_t k = 0; k < n; ++k)
            vertices[n * (k + 1) + k] = 1;
        for (uint32_t f = 0; f <= n; ++f)
            for (uint32_t i = 0; i < n; ++i) {
                /* Two corners change places on every other facet, so that all face outside. */
                const uint32_t j = f % 2 == 1 && i < 2 ? 1 - i : i;
                facets[n * f + i] = j < f ? j : j + 1;
            }
        icc_domain *domain;
        ck_assert_int_eq(
            icc_domain_create(&domain, dim, n + 1, vertices, n + 1, facets, NULL, NULL), ICC_OK);
        look_around(domain, &r);
        icc_domain_free(domain);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("away");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, polygons);
    tcase_add_test(tests, surfaces);
    tcase_add_test(tests, simplices);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
