/* Shapes: regions, walls and curves; cells. */
#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../random.h"
#include "../../../regions.h"
#include "../../../suite.h"
#include "geometry/segment.h"
#include "kernel/sampling/cells.h"
#include "kernel/sampling/shape.h"

#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------- cells */

static double distance2(size_t dim, const double *a, const double *b)
{
    double sum = 0;
    for (size_t k = 0; k < dim; ++k)
        sum += (a[k] - b[k]) * (a[k] - b[k]);
    return sum;
}

START_TEST(cells_find_what_a_search_of_all_finds)
{
    enum { N = 300 };
    const iccp_env env = default_env();
    random_source r = {5};
    for (size_t dim = 2; dim <= 3; ++dim)
        for (int round = 0; round < 60; ++round) {
            double points[3 * N], place[3];
            uint32_t near[N];
            /* Spread out, on a line, all in one place. */
            const double flat = round % 3 == 1 ? 0 : 1, all = round % 20 == 7 ? 0 : 1;
            const size_t n = (size_t)random_below(&r, N + 1);
            for (size_t i = 0; i < n; ++i)
                for (size_t k = 0; k < dim; ++k)
                    points[dim * i + k] = random_between(&r, -1, 1) * (k == 0 ? all : flat * all);
            iccp_cells cells;
            ck_assert_int_eq(
                iccp_cells_create(&cells, dim, n, points, pow(10, random_between(&r, -4, 1)), &env),
                ICC_OK);
            ck_assert_uint_le(cells.shape[0] * cells.shape[1] * cells.shape[2], 4 * n + 1);
            for (int query = 0; query < 20; ++query) {
                const double radius = query == 0 ? 0 : random_between(&r, 0, 1.5);
                for (size_t k = 0; k < dim; ++k)
                    place[k] = query < 2 && n > 0 ? points[k] : random_between(&r, -2, 2);
                size_t expected = 0;
                for (size_t i = 0; i < n; ++i)
                    expected += distance2(dim, place, points + dim * i) <= radius * radius;
                const size_t found = iccp_cells_near(&cells, place, radius, N, near);
                ck_assert_uint_eq(found, expected);
                for (size_t i = 0; i < found; ++i)
                    ck_assert(distance2(dim, place, points + dim * near[i]) <= radius * radius);
                ck_assert_uint_eq(iccp_cells_near(&cells, place, radius, 0, NULL), expected);
            }
            iccp_cells_free(&cells);
        }
}
END_TEST

/* ------------------------------------------------------------------- shape */

START_TEST(a_point_belongs_to_the_innermost_region)
{
    icc_shape *shape = star_shape();
    const double centre[2] = {0, 0}, beside[2] = {0.9, 0.9}, far[2] = {2, 0};
    ck_assert_uint_eq(iccp_shape_region(shape, centre), 0);
    ck_assert_uint_eq(iccp_shape_region(shape, beside), 1);
    ck_assert_uint_eq(iccp_shape_region(shape, far), ICCP_NOWHERE);
    ck_assert(!iccp_shape_holds(shape, far));
    /* On a wall: the region that it encloses. */
    double star[20];
    star_outline(star);
    for (int i = 0; i < 10; ++i)
        for (int step = 0; step <= 8; ++step) {
            const double t = step / 8.0, *a = star + 2 * i, *b = star + 2 * ((i + 1) % 10);
            const double p[2] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
            const iccp_spot spot = iccp_shape_spot(shape, p);
            ck_assert_uint_eq(spot.region, 0);
            ck_assert_uint_ne(spot.wall, ICCP_NOWHERE);
        }
    icc_shape_free(shape);
}
END_TEST

START_TEST(samples_on_walls_are_found_far_from_the_origin)
{
    for (int power = 0; power <= 12; power += 3) {
        const double shift = pow(10, power), size = 1;
        double star[20], square[8];
        star_outline(star);
        square_outline(1.33 * size, square);
        for (int i = 0; i < 20; ++i)
            star[i] += shift;
        for (int i = 0; i < 8; ++i)
            square[i] += shift;
        icc_domain *const regions[2] = {polygon_of(10, star), polygon_of(4, square)};
        icc_shape *shape = shape_of(2, 2, regions);
        for (int i = 0; i < 10; ++i)
            for (int step = 0; step <= 16; ++step) {
                const double t = step / 16.0, *a = star + 2 * i, *b = star + 2 * ((i + 1) % 10);
                const double p[2] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
                ck_assert_uint_eq(iccp_shape_region(shape, p), 0);
            }
        icc_shape_free(shape);
    }
}
END_TEST

/* Of random pairs in the star and around it, none is seen through a wall; those that no wall parts
 * are. */
START_TEST(walls_hide_exactly_what_is_behind_them)
{
    icc_shape *shape = star_shape();
    double star[20];
    star_outline(star);
    random_source r = {11};
    size_t n_hidden = 0, n_seen = 0;
    for (int round = 0; round < 20000; ++round) {
        double a[2], b[2];
        for (int k = 0; k < 2; ++k) {
            a[k] = random_between(&r, -1.33, 1.33);
            b[k] = a[k] + random_between(&r, -0.4, 0.4);
        }
        if (iccp_shape_region(shape, b) == ICCP_NOWHERE)
            continue;
        bool parted = false;
        for (int i = 0; i < 10; ++i)
            parted |= iccp_segments_meet(a, b, star + 2 * i, star + 2 * ((i + 1) % 10)) != 0;
        ck_assert_int_eq(iccp_shape_sees(shape, a, b), !parted);
        ck_assert_int_eq(iccp_shape_sees(shape, b, a), !parted);
        n_hidden += parted;
        n_seen += !parted;
    }
    ck_assert_uint_gt(n_hidden, 1000);
    ck_assert_uint_gt(n_seen, 1000);
    icc_shape_free(shape);
}
END_TEST

/* The limbs of the U do not see each other, nor do points on their walls, whatever there is
 * between. */
START_TEST(limbs_do_not_see_each_other)
{
    for (int surrounded = 0; surrounded < 2; ++surrounded) {
        icc_shape *shape = u_shape(0.2, surrounded);
        for (int i = 0; i <= 40; ++i)
            for (int j = 0; j <= 40; ++j) {
                const double y = 1.1 + 1.85 * i / 40, z = 1.1 + 1.85 * j / 40;
                const double left[2] = {-0.1, y}, right[2] = {0.1, z};
                const double in_left[2] = {-0.15, y}, in_right[2] = {0.15, z};
                ck_assert(!iccp_shape_sees(shape, left, right));
                ck_assert(!iccp_shape_sees(shape, in_left, right));
                ck_assert(!iccp_shape_sees(shape, left, in_right));
                ck_assert(!iccp_shape_sees(shape, in_left, in_right));
                ck_assert(iccp_shape_sees(shape, left, in_left));
                ck_assert(iccp_shape_sees(shape, in_left, left));
            }
        icc_shape_free(shape);
    }
}
END_TEST

/* Points on a wall see along it and into what it encloses; what is around sees them, but not the
 * other way. */
START_TEST(a_wall_belongs_to_what_it_encloses)
{
    icc_shape *shape = star_shape();
    double star[20];
    star_outline(star);
    for (int i = 0; i < 10; ++i) {
        const double *a = star + 2 * i, *b = star + 2 * ((i + 1) % 10);
        const double d[2] = {b[0] - a[0], b[1] - a[1]};
        for (int step = 1; step < 12; ++step) {
            const double t = step / 13.0, u = (step + 1) / 13.0;
            const double p[2] = {a[0] + t * d[0], a[1] + t * d[1]};
            const double q[2] = {a[0] + u * d[0], a[1] + u * d[1]};
            const double in[2] = {p[0] - 0.01 * d[1], p[1] + 0.01 * d[0]};
            const double out[2] = {p[0] + 0.01 * d[1], p[1] - 0.01 * d[0]};
            ck_assert_uint_eq(iccp_shape_region(shape, in), 0);
            ck_assert_uint_eq(iccp_shape_region(shape, out), 1);
            ck_assert(iccp_shape_sees(shape, p, q) && iccp_shape_sees(shape, q, p));
            ck_assert(iccp_shape_sees(shape, p, in) && iccp_shape_sees(shape, in, p));
            ck_assert(iccp_shape_sees(shape, out, p) && !iccp_shape_sees(shape, p, out));
            ck_assert(!iccp_shape_sees(shape, in, out) && !iccp_shape_sees(shape, out, in));
        }
    }
    /* Across the dent between two tips, and across a tip. */
    const double *tip = star, *dent = star + 2;
    const double p[2] = {0.5 * (tip[0] + dent[0]), 0.5 * (tip[1] + dent[1])}, m[2] = {-p[0], p[1]};
    ck_assert(iccp_shape_sees(shape, p, m));
    const double q[2] = {0.5 * (dent[0] + star[4]), 0.5 * (dent[1] + star[5])};
    ck_assert(!iccp_shape_sees(shape, p, q) && !iccp_shape_sees(shape, q, p));
    icc_shape_free(shape);
}
END_TEST

/* However often the sides of the star are divided, and however they are rounded, one sees along
 * them. */
START_TEST(divided_walls_are_still_straight)
{
    enum { MOST = 200 };
    static double xy[20 * MOST];
    double star[20];
    star_outline(star);
    for (int parts = 1; parts <= MOST; parts += parts < 7 ? 2 : 193) {
        for (int i = 0; i < 10; ++i)
            for (int k = 0; k < parts; ++k)
                for (int c = 0; c < 2; ++c) {
                    const double a = star[2 * i + c], b = star[(2 * i + 2 + c) % 20];
                    xy[2 * (i * parts + k) + c] = a + k * (b - a) / parts;
                }
        icc_domain *const region = polygon_of((size_t)(10 * parts), xy);
        icc_shape *shape = shape_of(2, 1, &region);
        for (int i = 0; i < 10; ++i)
            for (int j = 0; j <= 23; ++j)
                for (int k = 0; k <= 23; ++k) {
                    double p[2], q[2];
                    for (int c = 0; c < 2; ++c) {
                        const double a = star[2 * i + c], b = star[(2 * i + 2 + c) % 20];
                        p[c] = a + (b - a) * (j / 23.0);
                        q[c] = a + (b - a) * (k / 23.0);
                    }
                    ck_assert(iccp_shape_sees(shape, p, q));
                }
        icc_shape_free(shape);
    }
}
END_TEST

START_TEST(the_outside_is_a_region_of_its_own)
{
    icc_shape *shape = u_shape(0.2, 0);
    const double gap[2] = {0, 2}, above[2] = {0, 3.5}, beyond[2] = {2, 2}, wall[2] = {0.1, 2};
    const double limb[2] = {0.2, 2};
    ck_assert(iccp_shape_sees(shape, gap, above) && iccp_shape_sees(shape, above, gap));
    ck_assert(!iccp_shape_sees(shape, gap, beyond) && !iccp_shape_sees(shape, gap, limb));
    ck_assert(iccp_shape_sees(shape, gap, wall) && !iccp_shape_sees(shape, wall, gap));
    icc_shape_free(shape);
}
END_TEST

START_TEST(boundaries_must_not_meet)
{
    static const double OTHERS[][8] = {
        {0.5, 0.5, 3, 0.5, 3, 3, 0.5, 3}, /* crosses */
        {1, -1, 2, -1, 2, 1, 1, 1},       /* shares a side */
        {1, 1, 2, 1, 2, 2, 1, 2},         /* shares a corner */
        {0, 1, 1, 2, 0, 3, -1, 2},        /* a corner on a side */
        {-1, -1, 1, -1, 1, 1, -1, 1},     /* the same */
    };
    double xy[8];
    square_outline(1, xy);
    icc_domain *square = polygon_of(4, xy);
    for (size_t i = 0; i < sizeof OTHERS / sizeof *OTHERS; ++i) {
        icc_domain *other = polygon_of(4, OTHERS[i]);
        const icc_domain *regions[3] = {square, square, other};
        icc_shape *shape;
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(icc_shape_create(&shape, 2, 2, regions + 1, 0, NULL, 0, NULL, NULL, &err),
                         ICC_ERR_BOUNDARY);
        ck_assert_ptr_null(shape);
        ck_assert_int_eq(err.index, 1);
        ck_assert_ptr_nonnull(strstr(err.message, "regions 0 and 1"));
        icc_domain_free(other);
    }
    icc_domain_free(square);
    icc_domain *const cubes[2] = {cube_of(1), cube_of(1)};
    icc_shape *shape;
    ck_assert_int_eq(icc_shape_create(&shape, 3, 2, (const icc_domain *const *)cubes, 0, NULL, 0,
                                      NULL, NULL, NULL),
                     ICC_ERR_BOUNDARY);
    icc_domain_free(cubes[0]);
    icc_domain_free(cubes[1]);
}
END_TEST

START_TEST(regions_of_very_different_size_nest)
{
    for (int power = 1; power <= 12; ++power) {
        double small[8], large[8];
        square_outline(pow(10, -power), small);
        square_outline(1, large);
        icc_domain *const regions[2] = {polygon_of(4, large), polygon_of(4, small)};
        icc_shape *shape = shape_of(2, 2, regions);
        const double centre[2] = {0, 0}, beside[2] = {3 * pow(10, -power), 0};
        ck_assert_uint_eq(iccp_shape_region(shape, centre), 1);
        ck_assert_uint_eq(iccp_shape_region(shape, beside), 0);
        ck_assert(!iccp_shape_sees(shape, centre, beside));
        icc_shape_free(shape);
    }
}
END_TEST

START_TEST(space_has_walls_too)
{
    icc_domain *const regions[2] = {cube_of(1), cube_of(2)};
    icc_shape *shape = shape_of(3, 2, regions);
    random_source r = {3};
    size_t n_hidden = 0;
    for (int round = 0; round < 4000; ++round) {
        double a[3], b[3];
        for (int k = 0; k < 3; ++k) {
            a[k] = random_between(&r, -1, 1);
            b[k] = random_between(&r, -2, 2);
        }
        const bool inside = fabs(b[0]) < 1 && fabs(b[1]) < 1 && fabs(b[2]) < 1;
        ck_assert_uint_eq(iccp_shape_region(shape, a), 0);
        ck_assert_uint_eq(iccp_shape_region(shape, b), !inside);
        ck_assert_int_eq(iccp_shape_sees(shape, a, b), inside);
        n_hidden += !inside;
        /* The same with a on a face: out of it, but not back. */
        a[0] = 1;
        ck_assert(iccp_shape_sees(shape, a, b) == inside);
        if (b[0] > 1)
            ck_assert(iccp_shape_sees(shape, b, a));
    }
    ck_assert_uint_gt(n_hidden, 1000);
    icc_shape_free(shape);
}
END_TEST

/* A stick figure: a head, a stick from it that forks. */
static icc_shape *stick_figure(void)
{
    static const double STICKS[8] = {0, -1, 0, -3, -1, -4, 1, -4};
    static const uint32_t SEGMENTS[6] = {0, 1, 1, 2, 1, 3};
    double head[8];
    square_outline(1, head);
    icc_domain *domain = polygon_of(4, head);
    const icc_domain *regions[1] = {domain};
    icc_shape *shape;
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, regions, 4, STICKS, 3, SEGMENTS, NULL, NULL),
                     ICC_OK);
    icc_domain_free(domain);
    return shape;
}

START_TEST(points_of_curves_see_each_other_along_them)
{
    icc_shape *shape = stick_figure();
    const double neck[2] = {0, -1}, trunk[2] = {0, -2.5}, left[2] = {-0.5, -3.5};
    const double right[2] = {0.5, -3.5}, head[2] = {0, 0}, beside[2] = {0.5, -2.5};
    ck_assert(iccp_shape_holds(shape, trunk) && iccp_shape_holds(shape, neck));
    ck_assert(!iccp_shape_holds(shape, beside));
    ck_assert_uint_eq(iccp_shape_region(shape, trunk), ICCP_NOWHERE);
    ck_assert(iccp_shape_sees(shape, neck, trunk) && iccp_shape_sees(shape, trunk, neck));
    ck_assert(iccp_shape_sees(shape, trunk, left) && iccp_shape_sees(shape, left, right));
    ck_assert(iccp_shape_sees(shape, head, neck) && iccp_shape_sees(shape, neck, head));
    ck_assert(iccp_shape_sees(shape, neck, left) && !iccp_shape_sees(shape, head, trunk));
    icc_shape_free(shape);
}
END_TEST

/* A spiral of short segments: along it one sees, across it one does not. */
START_TEST(fine_curves_are_seen_along)
{
    enum { N = 2000 };
    static double xy[2 * N];
    static uint32_t segments[2 * (N - 1)];
    for (uint32_t i = 0; i < N; ++i) {
        const double angle = 0.01 * i, radius = 1 + 0.02 * angle;
        xy[2 * i] = radius * cos(angle);
        xy[2 * i + 1] = radius * sin(angle);
        if (i > 0) {
            segments[2 * i - 2] = i - 1;
            segments[2 * i - 1] = i;
        }
    }
    icc_shape *shape;
    ck_assert_int_eq(icc_shape_create(&shape, 2, 0, NULL, N, xy, N - 1, segments, NULL, NULL),
                     ICC_OK);
    for (uint32_t i = 0; i + 800 < N; i += 7)
        for (uint32_t k = 1; k < 20; ++k) {
            ck_assert(iccp_shape_sees(shape, xy + 2 * i, xy + 2 * (i + k)));
            ck_assert(iccp_shape_sees(shape, xy + 2 * (i + k), xy + 2 * i));
            ck_assert(!iccp_shape_sees(shape, xy + 2 * i, xy + 2 * (i + 618 + k)));
        }
    icc_shape_free(shape);
}
END_TEST

START_TEST(bad_shapes_are_named)
{
    static const double GOOD[4] = {0, 0, 1, 0}, INFINITE[4] = {0, 0, HUGE_VAL, 0};
    static const double SAME[4] = {1, 2, 1, 2};
    static const uint32_t SEGMENT[2] = {0, 1}, BEYOND[2] = {0, 2};
    const icc_domain *none[1] = {NULL};
    icc_domain *cube = cube_of(1);
    const icc_domain *cubes[1] = {cube};
    icc_shape *shape = (icc_shape *)&shape;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_shape_create(&shape, 2, 0, NULL, 0, NULL, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(shape);
    ck_assert_ptr_nonnull(strstr(err.message, "empty"));
    ck_assert_int_eq(icc_shape_create(&shape, 2, 0, NULL, 2, INFINITE, 1, SEGMENT, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(err.index, 1);
    ck_assert_int_eq(icc_shape_create(&shape, 2, 0, NULL, 2, SAME, 1, SEGMENT, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_shape_create(&shape, 2, 0, NULL, 2, GOOD, 1, BEYOND, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_shape_create(&shape, 4, 0, NULL, 2, GOOD, 1, SEGMENT, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, none, 0, NULL, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, cubes, 0, NULL, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(err.index, 0);
    ck_assert_int_eq(icc_shape_create(NULL, 2, 0, NULL, 2, GOOD, 1, SEGMENT, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_shape_create(&shape, 2, 0, NULL, 2, GOOD, 1, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    icc_shape_free(NULL);
    icc_domain_free(cube);
}
END_TEST

static icc_status make_shape(const icc_env *env, icc_error *err, void *argument)
{
    static const double STICK[4] = {0, 2, 3, 2};
    static const uint32_t SEGMENT[2] = {0, 1};
    icc_shape *shape;
    const icc_status status =
        icc_shape_create(&shape, 2, 2, argument, 2, STICK, 1, SEGMENT, env, err);
    ck_assert((shape == NULL) == (status != ICC_OK));
    icc_shape_free(shape);
    return status;
}

START_TEST(every_allocation_may_fail)
{
    double inner[8], outer[8];
    square_outline(1, inner);
    square_outline(2, outer);
    icc_domain *regions[2] = {polygon_of(4, inner), polygon_of(4, outer)};
    faulty_sweep(make_shape, regions);
    icc_domain_free(regions[0]);
    icc_domain_free(regions[1]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("shape");
    TCase *c = tcase_create("shape");
    tcase_add_test(c, cells_find_what_a_search_of_all_finds);
    tcase_add_test(c, a_point_belongs_to_the_innermost_region);
    tcase_add_test(c, samples_on_walls_are_found_far_from_the_origin);
    tcase_add_test(c, walls_hide_exactly_what_is_behind_them);
    tcase_add_test(c, limbs_do_not_see_each_other);
    tcase_add_test(c, a_wall_belongs_to_what_it_encloses);
    tcase_add_test(c, divided_walls_are_still_straight);
    tcase_add_test(c, the_outside_is_a_region_of_its_own);
    tcase_add_test(c, boundaries_must_not_meet);
    tcase_add_test(c, regions_of_very_different_size_nest);
    tcase_add_test(c, space_has_walls_too);
    tcase_add_test(c, points_of_curves_see_each_other_along_them);
    tcase_add_test(c, fine_curves_are_seen_along);
    tcase_add_test(c, bad_shapes_are_named);
    tcase_add_test(c, every_allocation_may_fail);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
