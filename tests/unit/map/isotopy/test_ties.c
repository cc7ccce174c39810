/* Ties that are refused, with their number and side; and edges that are cut to a length. */
#include "map/compatible/density.h"
#include "map/map.h"
#include "map/plane/plane_certificate.h"
#include "map/plane/plane_kind.h"

#include "../../../feature_pairs.h"
#include "../../../suite.h"

#include <stddef.h>
#include <stdlib.h>

/* A square with a hole, a line and two points: vertices 0 to 3, 4 to 7, 8 and 9, 10 and 11. */
static plan plate(void)
{
    plan p = plan_square(10);
    plan_feature(&p, ICC_FEATURE_HOLE, 4, (const double[]){2, 2, 4, 2, 4, 4, 2, 4});
    plan_feature(&p, ICC_FEATURE_LINE, 2, (const double[]){6, 2, 8, 2});
    plan_point(&p, 3, 7);
    plan_point(&p, 7, 7);
    return p;
}

enum { N = 4 };

/* From the corner to the hole, on to the line, and from two corners to the points. */
static void sound(icc_tie ties[N])
{
    static const uint32_t ends[N][2] = {{0, 4}, {5, 8}, {3, 10}, {2, 11}};
    for (size_t i = 0; i < N; ++i)
        ties[i] = (icc_tie){.size = sizeof *ties, .vertex = {ends[i][0], ends[i][1]}};
}

static void check_refused(size_t n, const icc_tie *ties, icc_status wanted, int64_t index,
                          int32_t side, const char *text)
{
    const plan p = plate();
    icc_domain *domain = plan_domain(&p);
    const icc_map_options options = {.size = sizeof options, .n_ties = n, .ties = ties};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    const icc_status status = icc_map_create(&map, domain, domain, &options, NULL, &err);
    ck_assert_msg(status == wanted, "%d: %s", (int)status, err.message);
    ck_assert_ptr_null(map);
    ck_assert_msg(strstr(err.message, text) != NULL, "'%s' is not in '%s'", text, err.message);
    ck_assert_int_eq(err.index, index);
    ck_assert_int_eq(err.side, side);
    ck_assert(index < 0 || err.item == ICC_ITEM_TIE);
    icc_domain_free(domain);
}

START_TEST(refused)
{
    static const double across[2] = {7, 1.5}, away[2] = {12, 5}, nothing[2] = {NAN, 1},
                        huge[2] = {1e300, 0}, itself[6] = {5, 9, 5, 6, 2, 8};
    icc_tie ties[N];
    sound(ties);
    check_refused(3, ties, ICC_ERR_TOPOLOGY, -1, 0, "there must be 4");
    ties[1].vertex[1] = 12;
    check_refused(N, ties, ICC_ERR_ARGUMENT, 1, 0, "tie 1 ends at vertex 12");
    sound(ties);
    ties[2].n_source = 1;
    check_refused(N, ties, ICC_ERR_ARGUMENT, 2, 0, "tie 2: its bends are NULL");
    sound(ties);
    ties[2].n_target = 1;
    ties[2].target = nothing;
    check_refused(N, ties, ICC_ERR_ARGUMENT, 2, 2, "target: tie 2: bend 0");
    ties[2].target = huge;
    check_refused(N, ties, ICC_ERR_ARGUMENT, 2, 2, "target: tie 2: bend 0");
    ties[2].target = away;
    check_refused(N, ties, ICC_ERR_TOPOLOGY, 2, 2, "target: tie 2 meets");
    sound(ties);
    ties[3] = (icc_tie){.size = sizeof *ties, .vertex = {1, 9}};
    check_refused(N, ties, ICC_ERR_TOPOLOGY, 3, 0, "tie 3 joins what the ties before it join");
    sound(ties);
    ties[1].vertex[1] = 9; /* along the line */
    check_refused(N, ties, ICC_ERR_TOPOLOGY, 1, 1, "source: tie 1 meets");
    sound(ties);
    ties[0].vertex[1] = 6; /* through the hole */
    check_refused(N, ties, ICC_ERR_TOPOLOGY, 0, 1, "source: tie 0 meets");
    sound(ties);
    ties[3].vertex[0] = 0; /* past the hole's corner 6 */
    ties[3].n_source = ties[3].n_target = 1;
    ties[3].source = ties[3].target = across;
    check_refused(N, ties, ICC_ERR_TOPOLOGY, 3, 1, "source: tie 3 meets");
    sound(ties);
    ties[3].n_source = 3;
    ties[3].source = itself;
    check_refused(N, ties, ICC_ERR_TOPOLOGY, 3, 1, "source: tie 3 meets");
}
END_TEST

/* One tie leaves the vertex on the other side of another in the target. */
START_TEST(order)
{
    static const double below[2] = {5, 1}, above[4] = {1, 5, 5, 5.5};
    const icc_tie ties[N] = {{.size = sizeof *ties, .vertex = {0, 4}},
                             {.size = sizeof *ties,
                              .vertex = {0, 8},
                              .n_source = 1,
                              .source = below,
                              .n_target = 2,
                              .target = above},
                             {.size = sizeof *ties, .vertex = {3, 10}},
                             {.size = sizeof *ties, .vertex = {2, 11}}};
    check_refused(N, ties, ICC_ERR_TOPOLOGY, 0, 0, "leaves a vertex between different neighbours");
}
END_TEST

/* Ties of a caller whose struct is larger. */
START_TEST(larger)
{
    struct {
        icc_tie known;
        double more;
    } two[N];
    const plan p = plate();
    icc_domain *domain = plan_domain(&p);
    icc_tie ties[N];
    icc_map *map;
    sound(ties);
    for (size_t i = 0; i < N; ++i) {
        memset(&two[i], 0, sizeof two[i]);
        two[i].known = ties[i];
        two[i].known.size = sizeof two[i];
    }
    const icc_map_options options = {.size = sizeof options, .n_ties = N, .ties = &two[0].known};
    ck_assert_int_eq(icc_map_create(&map, domain, domain, &options, NULL, NULL), ICC_OK);
    icc_map_free(map);
    two[2].more = 1;
    icc_error err = {.size = sizeof err};
    ck_assert_int_ne(icc_map_create(&map, domain, domain, &options, NULL, &err), ICC_OK);
    icc_domain_free(domain);
}
END_TEST

/* ---- lengths of edges ---- */

static double longest_of(const iccp_plmap *map)
{
    double most = 0;
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c) {
        const double *a = iccp_plmap_point(map, iccp_after(c)),
                     *b = iccp_plmap_point(map, iccp_before(c)),
                     *x = iccp_plmap_image(map, iccp_after(c)),
                     *y = iccp_plmap_image(map, iccp_before(c));
        most = fmax(most, hypot(x[0] - y[0], x[1] - y[1]));
        most = fmax(most, map->stretch * hypot(a[0] - b[0], a[1] - b[1]));
    }
    return most;
}

/* Edges become shorter, the map stays: certified, with the same energy, and each vertex on its line
 * where it was. */
START_TEST(density)
{
    for (int k = 0; k < N_PLANS; ++k) {
        plan plans[2];
        iccp_env env;
        const icc_map_options options = {.size = sizeof options, .iterations = -1};
        plans_number(k, &plans[0], &plans[1]);
        icc_domain *domains[2] = {plan_domain(&plans[0]), plan_domain(&plans[1])};
        icc_map *map;
        iccp_plmap copy;
        ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_create(&map, domains[0], domains[1], &options, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(iccp_plmap_copy(&copy, &iccp_plane_of(map)->pl, &env.memory), ICC_OK);
        const double energy = iccp_plmap_energy(&copy), before = longest_of(&copy);
        for (double share = 0.5; share > 0.1; share *= 0.5) {
            ck_assert_int_eq(iccp_limit_edges(&copy, share * before, &env), ICC_OK);
            ck_assert_double_le(longest_of(&copy), share * before * (1 + 1e-12));
            ck_assert_double_eq_tol(iccp_plmap_energy(&copy), energy, 1e-6 * energy);
            ck_assert_int_eq(iccp_plmap_certify(&copy, &env, NULL), ICC_OK);
            for (size_t v = 0; v < copy.n_vertices; ++v) {
                const double bary[2] = {1 - copy.along[v], copy.along[v]};
                double point[2], image[2];
                if (copy.fixed[v] == ICCP_FREE)
                    continue;
                iccp_domain_facet_point(domains[0], copy.facet[v], bary, point);
                iccp_domain_facet_point(domains[1], copy.facet[v], bary, image);
                for (size_t d = 0; d < 2; ++d) {
                    ck_assert_double_eq_tol(point[d], copy.points[2 * v + d], 1e-14);
                    ck_assert_double_eq_tol(image[d], copy.images[2 * v + d], 1e-14);
                }
            }
        }
        iccp_plmap_free(&copy);
        icc_map_free(map);
        icc_domain_free(domains[0]);
        icc_domain_free(domains[1]);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("ties");
    TCase *c = tcase_create("ties");
    tcase_add_test(c, refused);
    tcase_add_test(c, order);
    tcase_add_test(c, larger);
    tcase_add_test(c, density);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
