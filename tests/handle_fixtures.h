/* Handles, samplings and weights on a square and a cube, for the tests of kernel coordinates. */
#ifndef TEST_HANDLE_FIXTURES_H
#define TEST_HANDLE_FIXTURES_H

#include "icc/kernel.h"
#include "random.h"

#include <check.h>
#include <stdlib.h>

static const double SQUARE[8] = {0, 0, 1, 0, 1, 1, 0, 1};
static const uint32_t RING[8] = {0, 1, 1, 2, 2, 3, 3, 0};
/* In the square, one of them beside the edges. */
static const double HANDLES[10] = {0, 0, 1, 0, 1, 1, 0, 1, 0.3, 0.6};
static const double CUBE[24] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0,
                                0, 0, 1, 1, 0, 1, 0, 1, 1, 1, 1, 1};

static inline void *allocate(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    ck_assert_ptr_nonnull(memory);
    return memory;
}

static inline icc_sampling *sample_square(double spacing)
{
    icc_domain *domain;
    icc_shape *shape;
    icc_sampling *sampling;
    const icc_sampling_options options = {.size = sizeof options, .spacing = spacing, .steps = 10};
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, SQUARE, 0, NULL, NULL, NULL), ICC_OK);
    const icc_domain *regions[1] = {domain};
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, regions, 0, NULL, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_sampling_create(&sampling, shape, &options, NULL, NULL), ICC_OK);
    icc_shape_free(shape);
    icc_domain_free(domain);
    return sampling;
}

/* A cube of 12 facets with a regular grid of samples. */
static inline icc_sampling *sample_cube(void)
{
    static const uint32_t FACETS[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                        2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    icc_domain *domain;
    icc_shape *shape;
    icc_sampling *sampling;
    const icc_sampling_options options = {
        .size = sizeof options, .kind = ICC_SAMPLING_GRID, .spacing = 0.125, .margin = 1};
    ck_assert_int_eq(icc_domain_create(&domain, 3, 8, CUBE, 12, FACETS, NULL, NULL), ICC_OK);
    const icc_domain *regions[1] = {domain};
    ck_assert_int_eq(icc_shape_create(&shape, 3, 1, regions, 0, NULL, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_sampling_create(&sampling, shape, &options, NULL, NULL), ICC_OK);
    icc_shape_free(shape);
    icc_domain_free(domain);
    return sampling;
}

static inline icc_weights *make(const icc_sampling *sampling, size_t n, const double *handles,
                                const icc_weights_options *options)
{
    icc_weights *weights;
    icc_error err = {.size = sizeof err};
    if (icc_weights_create(&weights, sampling, n, handles, options, NULL, &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    return weights;
}

static inline icc_weights_info info_of(const icc_weights *weights)
{
    icc_weights_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_weights_get_info(weights, &info), ICC_OK);
    return info;
}

static inline double *weights_of(const icc_weights *weights)
{
    const icc_weights_info info = info_of(weights);
    double *values = allocate(info.n_nodes * info.n_handles, sizeof *values);
    ck_assert_int_eq(icc_weights_get_nodes(weights, NULL, NULL, values, NULL), ICC_OK);
    return values;
}

static inline double *nodes_of(const icc_weights *weights)
{
    const icc_weights_info info = info_of(weights);
    double *points = allocate(info.n_nodes * (size_t)info.dim, sizeof *points);
    ck_assert_int_eq(icc_weights_get_nodes(weights, points, NULL, NULL, NULL), ICC_OK);
    return points;
}

/* n points of the unit square or cube. */
static inline double *random_places(size_t dim, size_t n)
{
    double *points = allocate(n * dim, sizeof *points);
    random_source r = {77};
    for (size_t i = 0; i < n * dim; ++i)
        points[i] = random_unit(&r);
    return points;
}

static inline icc_weights_report report_of(const icc_weights *weights)
{
    const size_t dim = (size_t)info_of(weights).dim;
    double *points = random_places(dim, 2000);
    icc_weights_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_weights_get_report(weights, 2000, points, &report, NULL, NULL), ICC_OK);
    free(points);
    return report;
}

static inline void random_transforms(size_t dim, size_t n, double *transforms, random_source *r)
{
    for (size_t k = 0; k < n * dim * (dim + 1); ++k)
        transforms[k] = random_between(r, -1, 1);
}

static inline unsigned char *save(const icc_binding *binding, size_t *n_bytes)
{
    ck_assert_int_eq(icc_binding_save(binding, 0, NULL, n_bytes), ICC_OK);
    unsigned char *data = allocate(*n_bytes, 1);
    size_t again;
    ck_assert_int_eq(icc_binding_save(binding, *n_bytes, data, &again), ICC_OK);
    ck_assert_uint_eq(again, *n_bytes);
    return data;
}

#endif
