/* Which points of a large map are worth moving. */
#include "map/energy/movable.h"

#include "../../../faulty.h"
#include "../../../suite.h"
#include "map/energy/dirichlet.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* A lattice of columns that become narrower by a factor from one to the next, each cell cut into
 * two triangles. */
enum { COLUMNS = 200, ROWS = 400 };

typedef struct strip {
    iccp_simplicial_map map;
    uint32_t *corners;
    double *points, *images;
} strip;

static strip make_strip(size_t rows, double factor, double shear)
{
    const size_t n_points = (COLUMNS + 1) * (rows + 1), n_cells = COLUMNS * rows;
    strip s = {.corners = malloc(6 * n_cells * sizeof *s.corners),
               .points = malloc(2 * n_points * sizeof *s.points),
               .images = malloc(2 * n_points * sizeof *s.images)};
    size_t n = 0;
    ck_assert(s.corners != NULL && s.points != NULL && s.images != NULL);
    for (size_t j = 0; j <= rows; ++j) {
        double x = 0, width = 1;
        for (size_t i = 0; i <= COLUMNS; ++i, x += width, width *= factor) {
            const size_t v = j * (COLUMNS + 1) + i;
            s.points[2 * v] = s.images[2 * v] = x;
            s.points[2 * v + 1] = (double)j;
            s.images[2 * v + 1] = (double)j + shear * x;
        }
    }
    for (uint32_t j = 0; j < rows; ++j)
        for (uint32_t i = 0; i < COLUMNS; ++i) {
            const uint32_t a = j * (COLUMNS + 1) + i, c = a + COLUMNS + 1;
            const uint32_t cell[6] = {a, a + 1, c, c, a + 1, c + 1};
            for (size_t k = 0; k < 6; ++k)
                s.corners[n++] = cell[k];
        }
    s.map = (iccp_simplicial_map){.dim = 2,
                                  .n_points = n_points,
                                  .n_simplices = 2 * n_cells,
                                  .corners = s.corners,
                                  .points = s.points,
                                  .images = s.images,
                                  .stretch = 1};
    return s;
}

static void clear_strip(strip *s)
{
    free(s->corners);
    free(s->points);
    free(s->images);
}

static uint8_t *movable_of(const strip *s)
{
    iccp_env env;
    uint8_t *movable;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_movable_create(&movable, &s->map, &env), ICC_OK);
    return movable;
}

START_TEST(small_maps_are_moved_as_a_whole)
{
    strip s = make_strip(20, 0.9, 1);
    ck_assert_ptr_null(movable_of(&s));
    clear_strip(&s);
}
END_TEST

/* Of columns of equal width none is negligible; of those that become narrower all but some of the
 * first are. */
START_TEST(what_hardly_counts_stays)
{
    for (int k = 0; k < 3; ++k) {
        const double factor = k == 0 ? 1 : 0.9;
        strip s = make_strip(ROWS, factor, k == 1 ? 0.5 : 2);
        uint8_t *movable = movable_of(&s);
        double left = 0, all = 0;
        size_t n_left = 0;
        ck_assert_ptr_nonnull(movable);
        for (size_t t = 0; t < s.map.n_simplices; ++t) {
            const uint32_t *v = s.corners + 3 * t;
            double element[ICCP_ELEMENT(2)];
            const double *image[3];
            iccp_simplicial_element(&s.map, t, element);
            iccp_simplicial_images(2, &s.map, t, image);
            const double energy = iccp_dirichlet_energy(2, element, image);
            all += energy;
            if (!movable[v[0]] && !movable[v[1]] && !movable[v[2]]) {
                left += energy - 4 * element[0];
                ++n_left;
            }
        }
        ck_assert_double_le(left, 1e-3 * all);
        if (k == 0)
            ck_assert_uint_eq(n_left, 0);
        else
            ck_assert_uint_gt(n_left, s.map.n_simplices / 2);
        for (size_t j = 0; j <= ROWS; ++j)
            ck_assert(movable[j * (COLUMNS + 1)] && movable[j * (COLUMNS + 1) + 10]);
        free(movable);
        clear_strip(&s);
    }
}
END_TEST

static icc_status try_it(const icc_env *env, icc_error *err, void *argument)
{
    const strip *s = argument;
    iccp_env full;
    uint8_t *movable;
    ck_assert_int_eq(iccp_env_read(&full, env, err), ICC_OK);
    const icc_status status = iccp_movable_create(&movable, &s->map, &full);
    iccp_free(&full.memory, movable);
    return status;
}

START_TEST(without_memory)
{
    strip s = make_strip(ROWS, 0.9, 1);
    for (size_t k = 1; k <= 3; ++k) {
        faulty f = {.fail_at = k};
        const icc_env env = faulty_env(&f);
        ck_assert_int_eq(try_it(&env, NULL, &s), k < 3 ? ICC_ERR_MEMORY : ICC_OK);
        ck_assert_uint_eq(f.n_live, 0);
    }
    clear_strip(&s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("movable points");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, small_maps_are_moved_as_a_whole);
    tcase_add_test(tests, what_hardly_counts_stays);
    tcase_add_test(tests, without_memory);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
