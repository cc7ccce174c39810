/* Shapes for the tests of kernel coordinates. */
#ifndef TESTS_REGIONS_H
#define TESTS_REGIONS_H

#include <check.h>
#include <icc/kernel.h>
#include <math.h>

static inline icc_domain *polygon_of(size_t n, const double *xy)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return domain;
}

static inline void star_outline(double *xy)
{
    for (int i = 0; i < 10; ++i) {
        const double angle = (90 + 36 * i) * 0.017453292519943295, radius = i % 2 == 0 ? 1 : 0.4;
        xy[2 * i] = radius * cos(angle);
        xy[2 * i + 1] = radius * sin(angle);
    }
}

static inline void square_outline(double half, double *xy)
{
    static const double CORNER[8] = {-1, -1, 1, -1, 1, 1, -1, 1};
    for (int i = 0; i < 8; ++i)
        xy[i] = half * CORNER[i];
}

/* Takes over the regions. */
static inline icc_shape *shape_of(int32_t dim, size_t n, icc_domain *const *regions)
{
    icc_shape *shape;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_shape_create(&shape, dim, n, (const icc_domain *const *)regions, 0, NULL, 0,
                                   NULL, NULL, &err) == ICC_OK,
                  "%s", err.message);
    for (size_t r = 0; r < n; ++r)
        icc_domain_free(regions[r]);
    return shape;
}

static inline icc_shape *square_shape(double half)
{
    double xy[8];
    square_outline(half, xy);
    icc_domain *const region = polygon_of(4, xy);
    return shape_of(2, 1, &region);
}

/* A star of ten corners, and a square around it. */
static inline icc_shape *star_shape(void)
{
    double star[20], square[8];
    star_outline(star);
    square_outline(1.33, square);
    icc_domain *const regions[2] = {polygon_of(10, star), polygon_of(4, square)};
    return shape_of(2, 2, regions);
}

/* A U of width 3 whose limbs are `gap` apart, alone or in a square. */
static inline icc_shape *u_shape(double gap, int surrounded)
{
    const double g = 0.5 * gap,
                 xy[16] = {-1.5, 0, 1.5, 0, 1.5, 3, g, 3, g, 1, -g, 1, -g, 3, -1.5, 3};
    const double square[8] = {-3, -3, 3, -3, 3, 5, -3, 5};
    icc_domain *const regions[2] = {polygon_of(8, xy), polygon_of(4, square)};
    if (surrounded)
        return shape_of(2, 2, regions);
    icc_domain_free(regions[1]);
    return shape_of(2, 1, regions);
}

/* A cube around the origin. */
static inline icc_domain *cube_of(double half)
{
    static const uint32_t FACES[36] = {0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                       1, 2, 6, 1, 6, 5, 2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7};
    double xyz[24];
    for (int i = 0; i < 8; ++i) {
        xyz[3 * i] = (i + 1) % 4 < 2 ? -half : half;
        xyz[3 * i + 1] = i % 4 < 2 ? -half : half;
        xyz[3 * i + 2] = i < 4 ? -half : half;
    }
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create(&domain, 3, 8, xyz, 12, FACES, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return domain;
}

#endif
