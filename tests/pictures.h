/* Maps of the plane and pictures, for tests of warping. */
#ifndef TESTS_PICTURES_H
#define TESTS_PICTURES_H

#include <icc/icc.h>

#include <check.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct mapped {
    icc_domain *source, *target;
    icc_map *map;
} mapped;

static inline mapped make_map(size_t n, const double *source, const double *target, int32_t kind)
{
    mapped m;
    const icc_map_options options = {.size = sizeof options, .kind = kind};
    ck_assert_int_eq(icc_domain_create(&m.source, 2, n, source, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&m.target, 2, n, target, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&m.map, m.source, m.target, &options, NULL, NULL), ICC_OK);
    return m;
}

static inline void unmake(mapped *m)
{
    icc_map_free(m->map);
    icc_domain_free(m->source);
    icc_domain_free(m->target);
}

/* Black, with a gap between rows, so that strides are taken seriously. free() its pixels. */
static inline icc_picture make_picture(int32_t width, int32_t height, int32_t channels,
                                       int32_t bytes)
{
    icc_picture p = {.size = sizeof p,
                     .width = width,
                     .height = height,
                     .channels = channels,
                     .bytes = bytes,
                     .stride = (size_t)width * (size_t)(channels * bytes) + 3};
    p.pixels = calloc(p.stride, (size_t)height);
    ck_assert_ptr_nonnull(p.pixels);
    return p;
}

static inline uint8_t *sample_at(const icc_picture *p, int32_t i, int32_t j, int32_t c)
{
    return (uint8_t *)p->pixels + (size_t)j * p->stride +
           (size_t)((i * p->channels + c) * p->bytes);
}

static inline bool same(const icc_picture *a, const icc_picture *b)
{
    return memcmp(a->pixels, b->pixels, a->stride * (size_t)a->height) == 0;
}

static inline void warp(const mapped *m, const icc_picture *from, const icc_picture *to)
{
    size_t n_failed = 77;
    ck_assert_int_eq(icc_map_warp(m->map, from, to, &n_failed, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(n_failed, 0);
}

#endif
