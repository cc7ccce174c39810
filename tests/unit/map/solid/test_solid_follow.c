/* Maps of meshes in space that follow a target: every frame is a certified map onto it, about as
 * fair as one made at once; what is asked of a new map may be asked of one that has followed. */
#include "../../../faulty.h"
#include "../../../flat_mesh.h"
#include "../../../infos.h"
#include "../../../meshes.h"
#include "../../../reports.h"
#include "../../../saved.h"
#include "../../../share.h"
#include "../../../suite.h"
#include "domain/domain.h"
#include "map/energy/newton.h"

enum { SIDE = 4 };

/* A cube of so many cells with a mesh, and motions of its surface. */
typedef struct scene {
    icc_domain *source;
    size_t n_vertices, n_facets;
    double *vertices;
    uint32_t *facets;
} scene;

static scene new_scene(size_t n)
{
    random_source r = {1};
    scene s;
    icc_domain_info info = {.size = sizeof info};
    test_mesh m = mesh_cube(3, n, 0.1, &r);
    ck_assert_int_eq(mesh_domain(&s.source, &m, NULL, NULL), ICC_OK);
    mesh_free(&m);
    ck_assert_int_eq(icc_domain_get_info(s.source, &info), ICC_OK);
    s.n_vertices = info.n_vertices;
    s.n_facets = info.n_facets;
    s.vertices = mesh_alloc(s.n_vertices, 3 * sizeof *s.vertices);
    s.facets = mesh_alloc(s.n_facets, 3 * sizeof *s.facets);
    ck_assert_int_eq(icc_domain_get_boundary(s.source, s.vertices, s.facets), ICC_OK);
    return s;
}

static void free_scene(scene *s)
{
    icc_domain_free(s->source);
    free(s->vertices);
    free(s->facets);
}

typedef void motion(double far, const double *x, double *y);

/* The surface alone. NULL where it meets itself. */
static icc_domain *surface_of(const scene *s, const double *vertices)
{
    icc_domain *domain;
    const icc_status status =
        icc_domain_create(&domain, 3, s->n_vertices, vertices, s->n_facets, s->facets, NULL, NULL);
    ck_assert(status == ICC_OK || status == ICC_ERR_BOUNDARY);
    return domain;
}

static icc_domain *moved(const scene *s, motion *move, double far)
{
    double *vertices = mesh_alloc(s->n_vertices, 3 * sizeof *vertices);
    for (size_t v = 0; v < s->n_vertices; ++v)
        move(far, s->vertices + 3 * v, vertices + 3 * v);
    icc_domain *domain = surface_of(s, vertices);
    free(vertices);
    ck_assert_ptr_nonnull(domain);
    return domain;
}

static void pull(double far, const double *x, double *y)
{
    const double r2 = (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / 9;
    const double share = r2 < 1 ? (1 - r2) * (1 - r2) : 0;
    for (int k = 0; k < 3; ++k)
        y[k] = x[k] - far * share * (k + 1) / 3;
}

/* Through an angle of `far`, about the axis of the cube. */
static void twist(double far, const double *x, double *y)
{
    const double angle = far * x[2] / SIDE, u = x[0] - SIDE / 2.0, v = x[1] - SIDE / 2.0;
    y[0] = u * cos(angle) - v * sin(angle);
    y[1] = u * sin(angle) + v * cos(angle);
    y[2] = x[2];
}

static void bend(double far, const double *x, double *y)
{
    const double radius = 2 * SIDE / far, angle = x[2] / radius;
    y[0] = radius - (radius - x[0] + SIDE / 2.0) * cos(angle);
    y[1] = x[1];
    y[2] = (radius - x[0] + SIDE / 2.0) * sin(angle);
}

static void turn(double far, const double *x, double *y)
{
    y[0] = x[0] * cos(far) - x[1] * sin(far) + 7;
    y[1] = x[0] * sin(far) + x[1] * cos(far) - 3;
    y[2] = 3 * x[2];
}

static icc_map *first_map(const scene *s)
{
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, s->source, s->source, NULL, NULL, NULL), ICC_OK);
    return map;
}

/* Both sides of its mesh are accepted as meshes of the source and of the target. */
static void check_map(const icc_map *map, const scene *s, const icc_domain *target)
{
    const icc_map_info info = info_of_map(map);
    uint32_t *corners = mesh_alloc(info.n_simplices, 4 * sizeof *corners);
    double *points[2], *vertices = mesh_alloc(s->n_vertices, 3 * sizeof *vertices);
    ck_assert(info.kind == ICC_MAP_MESH && info.certified == 1 && report_of(map).n_unrepaired == 0);
    ck_assert(info.energy >= 6 - 1e-9 && info.energy <= report_of(map).energy_start * (1 + 1e-12));
    for (int side = 0; side < 2; ++side)
        points[side] = mesh_alloc(info.n_vertices, 3 * sizeof *points[side]);
    ck_assert_int_eq(flat_get_mesh(map, points[0], points[1], corners), ICC_OK);
    for (int side = 0; side < 2; ++side) {
        icc_domain *domain;
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(icc_domain_get_boundary(side == 0 ? s->source : target, vertices, NULL),
                         ICC_OK);
        for (size_t i = 0; i < 3 * s->n_vertices; ++i)
            ck_assert_double_eq(vertices[i], points[side][i]);
        ck_assert_msg(flat_create_mesh(&domain, 3, info.n_vertices, points[side], info.n_simplices,
                                       corners, s->n_facets, s->facets, NULL, &err) == ICC_OK,
                      "%s", err.message);
        icc_domain_free(domain);
        free(points[side]);
    }
    free(vertices);
    free(corners);
}

static void count_new(void *user, const char *message)
{
    *(size_t *)user += strstr(message, "making a new map") != NULL;
}

/* *n_new, which may be NULL, counts maps that were made anew. */
static icc_map *follow(const icc_map *map, const icc_domain *target, int32_t iterations,
                       size_t *n_new)
{
    size_t n = 0;
    const icc_env env = {.size = sizeof env, .threads = 1, .log = count_new, .user = &n};
    icc_map *next;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_retarget(&next, map, target,
                                   &(icc_retarget_options){.size = sizeof(icc_retarget_options),
                                                           .iterations = iterations},
                                   &env, &err) == ICC_OK,
                  "%s", err.message);
    if (n_new != NULL)
        *n_new += n;
    return next;
}

/* ---- what comes out ---- */

/* Twenty frames of each motion, and about the same energy as a map that is made at once. */
START_TEST(frame_by_frame)
{
    static motion *const MOTIONS[] = {pull, twist, bend};
    static const double FAR[] = {1.5, 1.5, 2};
    scene s = new_scene(SIDE);
    for (int k = 0; k < 3; ++k) {
        icc_map *map = first_map(&s), *fresh;
        size_t n_new = 0;
        for (int frame = 1; frame <= 20; ++frame) {
            icc_domain *target = moved(&s, MOTIONS[k], FAR[k] * frame / 20);
            icc_map *next = follow(map, target, 0, &n_new);
            check_map(next, &s, target);
            ck_assert_ptr_null(icc_map_source_chart(next));
            icc_map_free(map);
            map = next;
            if (frame == 20) {
                ck_assert_int_eq(icc_map_create(&fresh, s.source, target, NULL, NULL, NULL),
                                 ICC_OK);
                ck_assert_double_lt(info_of_map(map).energy, 1.01 * info_of_map(fresh).energy);
                icc_map_free(fresh);
            }
            icc_domain_free(target);
        }
        ck_assert_uint_eq(n_new, 0);
        ck_assert_uint_eq(info_of_map(map).n_simplices, 6 * SIDE * SIDE * SIDE);
        icc_map_free(map);
    }
    free_scene(&s);
}
END_TEST

/* However far a target is moved by an affine map, that is the map. */
START_TEST(affine_motions_are_found)
{
    scene s = new_scene(SIDE);
    icc_map *map = first_map(&s);
    for (int k = 1; k <= 6; ++k) {
        icc_domain *target = moved(&s, turn, k);
        icc_map *next = follow(map, target, 0, NULL);
        check_map(next, &s, target);
        /* Stretches of 1, 1 and 3 where the volume is the same. */
        const double wide = pow(3, -2.0 / 3), long_side = pow(3, 4.0 / 3);
        ck_assert_double_eq_tol(info_of_map(next).energy,
                                2 * wide + long_side + 2 / wide + 1 / long_side, 1e-6);
        icc_map_free(map);
        icc_domain_free(target);
        map = next;
    }
    icc_map_free(map);
    free_scene(&s);
}
END_TEST

/* In one frame: in parts where it is far, and anew where the straight way is none. */
START_TEST(far_away)
{
    static const double ANGLES[] = {0.5, 1, 2, 3, 4.5};
    scene s = new_scene(SIDE);
    icc_map *map = first_map(&s);
    for (size_t k = 0; k < sizeof ANGLES / sizeof *ANGLES; ++k) {
        icc_domain *target = moved(&s, twist, ANGLES[k]);
        icc_map *next = follow(map, target, 0, NULL), *back;
        check_map(next, &s, target);
        back = follow(next, s.source, 0, NULL);
        check_map(back, &s, s.source);
        ck_assert_double_lt(info_of_map(back).energy, 6.1);
        icc_map_free(next);
        icc_map_free(back);
        icc_domain_free(target);
    }
    icc_map_free(map);
    free_scene(&s);
}
END_TEST

/* Vertices moved at random: every surface that does not meet itself is reached. */
START_TEST(rough_motions)
{
    random_source r = {7};
    scene s = new_scene(3);
    icc_map *map = first_map(&s);
    double *vertices = mesh_alloc(s.n_vertices, 3 * sizeof *vertices);
    int n_followed = 0;
    for (int k = 0; k < share_of(60); ++k) {
        const double most = 0.1 * (1 + k % 5);
        for (size_t i = 0; i < 3 * s.n_vertices; ++i)
            vertices[i] = s.vertices[i] + random_between(&r, -most, most);
        icc_domain *target = surface_of(&s, vertices);
        icc_map *next;
        icc_error err = {.size = sizeof err};
        if (target == NULL)
            continue;
        const icc_status status = icc_map_retarget(&next, map, target, NULL, NULL, &err);
        if (status == ICC_OK) {
            check_map(next, &s, target);
            icc_map_free(map);
            map = next;
            ++n_followed;
        } else {
            ck_assert(next == NULL && err.message[0] != '\0');
            ck_assert(status == ICC_ERR_CERTIFICATE || status == ICC_ERR_RESOLUTION);
            ck_assert(err.item == ICC_ITEM_VERTEX || err.item == ICC_ITEM_FACET);
        }
        icc_domain_free(target);
    }
    ck_assert_int_gt(n_followed, share_of(60) / 3);
    free(vertices);
    icc_map_free(map);
    free_scene(&s);
}
END_TEST

/* Surfaces that the library has filled; the next target may have a mesh, which does not matter. */
START_TEST(filled_surfaces)
{
    scene s = new_scene(3);
    icc_domain *bare = surface_of(&s, s.vertices), *target = moved(&s, pull, 0.3), *filled;
    icc_map *map, *one, *other;
    ck_assert_int_eq(icc_map_create(&map, bare, bare, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_fill(&filled, target, NULL, NULL, NULL), ICC_OK);
    one = follow(map, target, 0, NULL);
    other = follow(map, filled, 0, NULL);
    check_map(one, &s, target);
    ck_assert_double_eq(info_of_map(one).energy, info_of_map(other).energy);
    ck_assert_uint_eq(info_of_map(one).n_simplices, info_of_map(map).n_simplices);
    same_map(one, other, bare);
    icc_map_free(map);
    icc_map_free(one);
    icc_map_free(other);
    icc_domain_free(bare);
    icc_domain_free(target);
    icc_domain_free(filled);
    free_scene(&s);
}
END_TEST

/* ---- what is asked of it ---- */

/* It is improved, refined, saved and loaded, and followed from there; the map before stays. */
START_TEST(again_and_again)
{
    scene s = new_scene(3);
    icc_domain *near = moved(&s, pull, 0.3), *far = moved(&s, pull, 0.6);
    icc_map *map = first_map(&s), *next = follow(map, near, 0, NULL), *better, *loaded, *last[2];
    const icc_improve_options options = {.size = sizeof options, .levels = 1};
    bytes before = map_bytes(map);
    ck_assert_int_eq(icc_map_improve(&better, next, &options, NULL, NULL, NULL), ICC_OK);
    check_map(better, &s, near);
    ck_assert_double_le(info_of_map(better).energy, info_of_map(next).energy);
    bytes saved = map_bytes(better);
    ck_assert_int_eq(icc_map_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_OK);
    same_map(better, loaded, s.source);
    bytes again = map_bytes(loaded);
    ck_assert_uint_eq(again.n, saved.n);
    ck_assert_same(again.data, saved.data, saved.n, "what is saved again");
    ck_assert_int_eq(info_of_map(loaded).certified, 1);
    last[0] = follow(better, far, 2, NULL);
    last[1] = follow(loaded, far, 2, NULL);
    check_map(last[0], &s, far);
    same_map(last[0], last[1], s.source);
    bytes after = map_bytes(map);
    ck_assert_uint_eq(after.n, before.n);
    ck_assert_same(after.data, before.data, before.n, "a map that was followed");
    free(before.data);
    free(after.data);
    free(saved.data);
    free(again.data);
    icc_map_free(map);
    icc_map_free(next);
    icc_map_free(better);
    icc_map_free(loaded);
    icc_map_free(last[0]);
    icc_map_free(last[1]);
    icc_domain_free(near);
    icc_domain_free(far);
    free_scene(&s);
}
END_TEST

START_TEST(steps_are_as_many_as_asked)
{
    scene s = new_scene(SIDE);
    icc_domain *target = moved(&s, twist, 0.5);
    icc_map *map = first_map(&s);
    icc_map *none = follow(map, target, -1, NULL), *one = follow(map, target, 1, NULL),
            *some = follow(map, target, 0, NULL);
    ck_assert_uint_eq(report_of(none).n_iterations, 0);
    ck_assert_double_eq(info_of_map(none).energy, report_of(none).energy_start);
    ck_assert_uint_eq(report_of(one).n_iterations, 1);
    ck_assert_double_lt(info_of_map(one).energy, info_of_map(none).energy);
    ck_assert_uint_le(report_of(some).n_iterations, 8);
    ck_assert_double_le(info_of_map(some).energy, info_of_map(one).energy);
    icc_map_free(none);
    icc_map_free(one);
    icc_map_free(some);
    icc_map_free(map);
    icc_domain_free(target);
    free_scene(&s);
}
END_TEST

/* Other facets, vertices or sides are no new target. */
START_TEST(other_surfaces_are_refused)
{
    scene s = new_scene(3);
    icc_map *map = first_map(&s), *next = map;
    icc_error err = {.size = sizeof err};
    for (size_t f = 0; f < s.n_facets; ++f) {
        const uint32_t swap = s.facets[3 * f];
        s.facets[3 * f] = s.facets[3 * f + 1];
        s.facets[3 * f + 1] = swap;
    }
    icc_domain *inward = surface_of(&s, s.vertices);
    ck_assert_int_eq(icc_map_retarget(&next, map, inward, NULL, NULL, &err), ICC_ERR_BOUNDARY);
    ck_assert(next == NULL && err.side == 2 && err.message[0] != '\0');
    icc_map_free(map);
    icc_domain_free(inward);
    free_scene(&s);
}
END_TEST

/* What stops a motion is where the volume of a tetrahedron is 0, or before. */
START_TEST(limits_are_before_flips)
{
    random_source r = {11};
    const uint32_t corners[4] = {0, 1, 2, 3};
    double points[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, step[12], after[12];
    const iccp_simplicial_map map = {.dim = 3,
                                     .n_points = 4,
                                     .n_simplices = 1,
                                     .corners = corners,
                                     .points = points,
                                     .images = after,
                                     .stretch = 1};
    for (int k = 0; k < 2000; ++k) {
        for (int i = 0; i < 12; ++i)
            step[i] = random_between(&r, -1, 1);
        memcpy(after, points, sizeof after);
        const double limit = iccp_newton_limit(&map, step);
        ck_assert(limit > 0 && limit <= 2);
        double first = 0;
        for (; first < 2; first += 0.002) {
            for (int i = 0; i < 12; ++i)
                after[i] = points[i] + first * step[i];
            if (!iccp_simplicial_is_positive(&map, 0))
                break;
        }
        ck_assert_double_le(limit, first + 0.002);
        ck_assert_double_ge(limit, 0.25 * first);
    }
}
END_TEST

/* ---- threads, failures ---- */

START_TEST(threads_change_nothing)
{
    scene s = new_scene(7);
    icc_domain *targets[2] = {moved(&s, pull, 1), moved(&s, twist, 2)};
    icc_map *map = first_map(&s);
    for (int k = 0; k < 2; ++k) {
        icc_map *next = follow(map, targets[k], 0, NULL);
        bytes b = map_bytes(next);
        for (int32_t n = 2; n <= 4; ++n) {
            const icc_env env = {.size = sizeof env, .threads = n};
            icc_map *other;
            ck_assert_int_eq(icc_map_retarget(&other, map, targets[k], NULL, &env, NULL), ICC_OK);
            bytes own = map_bytes(other);
            ck_assert_uint_eq(own.n, b.n);
            ck_assert_same(own.data, b.data, b.n, "a map of several threads");
            free(own.data);
            icc_map_free(other);
        }
        free(b.data);
        icc_map_free(next);
        icc_domain_free(targets[k]);
    }
    icc_map_free(map);
    free_scene(&s);
}
END_TEST

typedef struct frame {
    const icc_map *map;
    const icc_domain *target;
} frame;

static icc_status call_follow(const icc_env *env, icc_error *err, void *argument)
{
    const frame *f = argument;
    icc_map *next = (icc_map *)&next;
    const icc_status status = icc_map_retarget(&next, f->map, f->target, NULL, env, err);
    ck_assert_int_eq(status == ICC_OK, next != NULL);
    icc_map_free(next);
    return status;
}

/* A short way, one in parts, and one where the map is made anew. */
START_TEST(failures_leave_nothing)
{
    static const double ANGLES[] = {0.3, 2, 4.5};
    scene s = new_scene(2);
    icc_map *map = first_map(&s);
    for (int k = 0; k < 3; ++k) {
        icc_domain *target = moved(&s, twist, ANGLES[k]);
        faulty_sweep(call_follow, &(frame){map, target});
        icc_domain_free(target);
    }
    icc_map_free(map);
    free_scene(&s);
}
END_TEST

int main(void)
{
    Suite *s = suite_create("maps of meshes in space that follow");
    TCase *c = tcase_create("all");
    tcase_set_timeout(c, 300);
    tcase_add_test(c, frame_by_frame);
    tcase_add_test(c, affine_motions_are_found);
    tcase_add_test(c, far_away);
    tcase_add_test(c, rough_motions);
    tcase_add_test(c, filled_surfaces);
    tcase_add_test(c, again_and_again);
    tcase_add_test(c, steps_are_as_many_as_asked);
    tcase_add_test(c, other_surfaces_are_refused);
    tcase_add_test(c, limits_are_before_flips);
    tcase_add_test(c, threads_change_nothing);
    tcase_add_test(c, failures_leave_nothing);
    suite_add_tcase(s, c);
    return suite_run(s);
}
