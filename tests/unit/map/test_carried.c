/* Features that move: what is reached, what is in the way, and what must stay as it was. */
#include "map/compatible/density.h"
#include "map/compatible/move_targets.h"
#include "map/isotopy/isotopy.h"
#include "map/map.h"
#include "map/plane/plane_certificate.h"
#include "map/plane/plane_kind.h"
#include "mesh/planar.h"

#include "../../default_env.h"
#include "../../feature_pairs.h"
#include "../../share.h"
#include "../../suite.h"

#include <stdlib.h>

/* A square with a hole and two points. */
static plan pins(void)
{
    plan p = plan_square(8);
    plan_hole(&p, 5, 4, 6, 1, 0.2);
    plan_point(&p, 2, 2);
    plan_point(&p, 6, 2);
    return p;
}

static icc_map *identity_of(const plan *p)
{
    icc_domain *domain = plan_domain(p);
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, domain, domain, NULL, NULL, NULL), ICC_OK);
    icc_domain_free(domain);
    return map;
}

/* One-to-one, with all that is fixed where the target wants it, or not at all moved so far. */
static void check_there(const iccp_plmap *map, const icc_domain *target, bool there)
{
    const iccp_env env = default_env();
    size_t n_off = 0;
    for (uint32_t t = 0; t < map->corners.n_triangles; ++t)
        ck_assert(iccp_plmap_positive_point(map, t) && iccp_plmap_positive_image(map, t));
    for (size_t v = 0; v < map->n_vertices; ++v) {
        double place[2];
        if (map->fixed[v] == ICCP_FREE)
            continue;
        iccp_target_place(map, target, v, place);
        n_off += memcmp(place, map->images + 2 * v, sizeof place) != 0;
    }
    ck_assert(there == (n_off == 0));
    ck_assert(!there || iccp_plmap_certify(map, &env, NULL) == ICC_OK);
}

/* Where the images of a map go when the target becomes that of another plan, and whether they get
 * there. */
static bool carry_to(const icc_map *map, const plan *to, double work)
{
    const iccp_env env = default_env();
    icc_domain *target = plan_domain(to);
    iccp_plmap copy;
    const iccp_mesh_limits limits = {iccp_planar_step(target, 15), 1000, 0};
    iccp_work steps = {.left = work};
    bool reached, kept = false;
    double room;
    ck_assert_int_eq(iccp_plmap_copy(&copy, &iccp_plane_of(map)->pl, &env.memory), ICC_OK);
    if (work > 0)
        ck_assert_int_eq(iccp_limit_edges(&copy, limits.longest_edge, &env), ICC_OK);
    ck_assert_int_eq(
        iccp_move_targets(&copy, NULL, target, &limits, 1, &steps, &reached, &room, &env), ICC_OK);
    check_there(&copy, target, reached);
    ck_assert(steps.left >= 0 || steps.spent > 0);
    ck_assert(room >= 0);
    if (reached) {
        ck_assert_int_eq(iccp_isotopy_is_kept(&kept, iccp_plane_of(map)->isotopy,
                                              map->target_domain, &copy, map->source_domain, target,
                                              &env),
                         ICC_OK);
        ck_assert(kept);
    }
    iccp_plmap_free(&copy);
    icc_domain_free(target);
    return reached;
}

/* The same by icc_map_retarget(), which makes the mesh anew where it is in the way. */
static bool follow_to(const icc_map *map, const plan *to)
{
    icc_domain *target = plan_domain(to);
    icc_map *followed;
    icc_map_info info = {.size = sizeof info};
    const icc_status status = icc_map_retarget(&followed, map, target, NULL, NULL, NULL);
    icc_domain_free(target);
    if (status != ICC_OK)
        return false;
    ck_assert_int_eq(icc_map_get_info(followed, &info), ICC_OK);
    ck_assert(info.certified == 1 && info.class_kept == 1);
    icc_map_free(followed);
    return true;
}

START_TEST(carried)
{
    const plan p = pins();
    plan moved = p;
    icc_map *map = identity_of(&p);
    const size_t first = 2 * (p.n_outer + 5), second = first + 2;
    /* Nowhere, which takes no work. */
    ck_assert(carry_to(map, &p, 0));
    moved.xy[first] = 3;
    ck_assert(!carry_to(map, &moved, 0));
    ck_assert(carry_to(map, &moved, 1e6));
    /* Both past each other, the one below and the other above. */
    moved = p;
    moved.xy[first] = 6;
    moved.xy[first + 1] = 1;
    moved.xy[second] = 2;
    moved.xy[second + 1] = 3;
    ck_assert(follow_to(map, &moved));
    /* Through one another: they would meet half way. */
    moved = p;
    moved.xy[first] = 6;
    moved.xy[second] = 2;
    ck_assert(!carry_to(map, &moved, 1e6));
    /* Through the hole. */
    moved = p;
    moved.xy[first] = 4.3;
    moved.xy[first + 1] = 7.6;
    ck_assert(!carry_to(map, &moved, 1e6));
    icc_map_free(map);
}
END_TEST

/* Many small ways one after the other: always kept, and never another map's. */
START_TEST(followed)
{
    enum { FRAMES = 40 };
    const plan p = pins();
    icc_map *map = identity_of(&p);
    random_source r = {3};
    plan at = p;
    for (int frame = 0; frame < share_of(FRAMES); ++frame) {
        plan next = at;
        icc_map *new_map;
        icc_map_info info = {.size = sizeof info};
        icc_error err = {.size = sizeof err};
        for (size_t k = 2 * (p.n_outer + 5); k < 2 * p.n_vertices; ++k) {
            next.xy[k] += random_between(&r, -0.4, 0.4);
            next.xy[k] = fmin(fmax(next.xy[k], 0.5), k % 2 == 1 ? 4.5 : 7.5);
        }
        icc_domain *target = plan_domain(&next);
        ck_assert_msg(icc_map_retarget(&new_map, map, target, NULL, NULL, &err) == ICC_OK, "%s",
                      err.message);
        ck_assert_int_eq(icc_map_get_info(new_map, &info), ICC_OK);
        ck_assert(info.certified == 1 && info.class_kept == 1 && info.n_ties == 3);
        icc_map_free(map);
        icc_domain_free(target);
        map = new_map;
        at = next;
    }
    icc_map_free(map);
}
END_TEST

/* Features go along to any size: of a shape that is next to nothing in the other's coordinates, the
 * place is not asked. */
START_TEST(followed_to_other_sizes)
{
    static const double SIZES[] = {1e-200, 1e200, 1e-10};
    const plan p = pins();
    icc_map *map = identity_of(&p);
    for (size_t k = 0; k < sizeof SIZES / sizeof *SIZES; ++k) {
        plan scaled = p;
        for (size_t i = 0; i < 2 * p.n_vertices; ++i)
            scaled.xy[i] *= SIZES[k];
        ck_assert(follow_to(map, &scaled));
    }
    icc_map_free(map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("carried");
    TCase *c = tcase_create("carried");
    tcase_add_test(c, carried);
    tcase_add_test(c, followed);
    tcase_add_test(c, followed_to_other_sizes);
    suite_add_tcase(suite, c);
    return suite_run(suite);
}
