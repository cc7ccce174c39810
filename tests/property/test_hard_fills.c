/* Random surfaces that are hard to fill: all but one in a thousand are filled, as they are, and the
 * others named. */
#include "../domains.h"
#include "../hard_bodies.h"
#include "../share.h"
#include "../suite.h"
#include "icc/icc.h"

#include <check.h>
#include <stdio.h>

static surface body;

/* That the mesh has the surface's vertices and faces, bit by bit; icc_domain_create_mesh() has
 * checked that it is one. */
static void check_filled(const icc_domain *filled)
{
    static double vertices[3 * SURFACE_VERTICES];
    static uint32_t faces[3 * SURFACE_FACES];
    const icc_domain_info info = info_of_domain(filled);
    ck_assert_uint_gt(info.n_mesh_simplices, 0);
    ck_assert_uint_eq(info.n_vertices, body.n_vertices);
    ck_assert_uint_eq(info.n_facets, body.n_faces);
    ck_assert_int_eq(icc_domain_get_boundary(filled, vertices, faces), ICC_OK);
    ck_assert_mem_eq(vertices, body.vertices, 3 * body.n_vertices * sizeof *vertices);
    ck_assert_mem_eq(faces, body.faces, 3 * body.n_faces * sizeof *faces);
}

/* 0: it is no surface, by rounding. */
static int try_one(uint64_t seed, int *n_refused)
{
    random_source r = {seed};
    icc_error err = {.size = sizeof err};
    icc_domain *domain, *filled;
    const char *name = surface_hard(&body, &r);
    if (icc_domain_create(&domain, 3, body.n_vertices, body.vertices, body.n_faces, body.faces,
                          NULL, NULL) != ICC_OK)
        return 0;
    const icc_status status = icc_domain_fill(&filled, domain, NULL, NULL, &err);
    icc_domain_free(domain);
    if (status == ICC_OK) {
        check_filled(filled);
    } else {
        ck_assert_int_eq(status, ICC_ERR_RESOLUTION);
        ck_assert(err.index >= 0 && err.message[0] != '\0' && filled == NULL);
        (void)printf("%s, seed %lu: %s\n", name, (unsigned long)seed, err.message);
        ++*n_refused;
    }
    icc_domain_free(filled);
    return 1;
}

START_TEST(nearly_all_are_filled)
{
    const int n = share_of(1000);
    int n_refused = 0, n_tried = 0;
    uint64_t seed = 1;
    for (; n_tried < n && seed < 2 * (uint64_t)n + 10; ++seed)
        n_tried += try_one(seed, &n_refused);
    ck_assert_int_eq(n_tried, n);
    ck_assert_int_le(1000 * n_refused, n);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("hard surfaces");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 36000);
    tcase_add_test(tests, nearly_all_are_filled);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
