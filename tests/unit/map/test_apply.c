/* Points through maps of kind mesh in the plane: located as the domain locates them, many at a time
 * as one at a time; and what is made when it is first needed. */
#include "map/map.h"
#include "map/plane/plane_kind.h"

#include "../../faulty.h"
#include "../../hard_shapes.h"
#include "../../saved.h"
#include "../../shape_domains.h"
#include "../../suite.h"
#include "../../together.h"

#include <check.h>
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>

/* ---- where points lie ---- */

/* Where it is: as it is; so far away that the band is as wide as the doubles there are apart; far
 * away along one axis only. */
static void place(shape *s, int where)
{
    static const double SHIFT[3][2] = {{0, 0}, {3e9, -1e9}, {0, 7e12}};
    for (size_t i = 0; i < 2 * s->n; ++i)
        s->xy[i] += SHIFT[where][i % 2];
}

/* What happens to a point, by the domain and the triangle that is found for it alone. */
static icc_status reference(const icc_map *map, bool inverse, const double *point, double *image,
                            double *jacobian)
{
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    const icc_domain *to = inverse ? map->source_domain : map->target_domain;
    double local[2], local_image[2], bary[2];
    uint32_t facet;
    image[0] = image[1] = jacobian[0] = NAN;
    if (!isfinite(point[0]) || !isfinite(point[1]))
        return ICC_ERR_ARGUMENT;
    iccp_frame_in(&from->frame, 2, point, local);
    const int32_t where = iccp_domain_locate(from, local, true, &facet, bary);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (where == ICC_BOUNDARY) {
        iccp_domain_facet_point(to, facet, bary, local_image);
    } else {
        const icc_status status =
            iccp_mesh_map_point(iccp_plane_of(map), inverse, local, local_image, jacobian);
        if (status != ICC_OK)
            return status;
    }
    iccp_frame_out(&to->frame, 2, local_image, image);
    return ICC_OK;
}

/* A point on a facet, moved from it by a length that is the band's reach in order of magnitude, a
 * few units in the last place, or anything up to the size of the shape; or any point. */
static void choose_point(const icc_domain *d, random_source *r, size_t i, double *p)
{
    const uint32_t *ends = d->facets + 2 * (size_t)random_below(r, (int)d->n_facets);
    const double *a = d->vertices + 2 * (size_t)ends[0], *b = d->vertices + 2 * (size_t)ends[1];
    const double share = i % 4 == 0 ? 0 : random_unit(r);
    const double length = i % 5 == 0   ? 0
                          : i % 5 == 1 ? random_between(r, 0, 6) * d->band.reach
                          : i % 5 == 2 ? 1e-16 * (double)random_below(r, 40)
                                       : exp(random_between(r, -37, 0));
    const double angle = random_between(r, 0, 6.3);
    double local[2] = {a[0] + share * (b[0] - a[0]) + length * cos(angle),
                       a[1] + share * (b[1] - a[1]) + length * sin(angle)};
    if (i % 7 == 0) {
        local[0] = random_between(r, d->lower[0] - 0.05, d->upper[0] + 0.05);
        local[1] = random_between(r, d->lower[1] - 0.05, d->upper[1] + 0.05);
    }
    iccp_frame_out(&d->frame, 2, local, p);
    if (i % 331 == 0)
        p[i % 2] = i % 662 == 0 ? NAN : -HUGE_VAL;
}

static void same_number(double a, double b)
{
    ck_assert(memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b)));
}

static void check_points(const icc_map *map, bool inverse, uint64_t seed)
{
    enum { N = 1000 };
    static double points[2 * N], mapped[2 * N], jacobians[4 * N];
    static icc_status status[N], jacobian_status[N];
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    random_source r = {seed};
    for (size_t i = 0; i < N; ++i)
        choose_point(from, &r, i, points + 2 * i);
    ck_assert_int_eq((inverse ? icc_map_apply_inverse : icc_map_apply)(map, N, points, mapped,
                                                                       status, NULL, NULL),
                     ICC_OK);
    if (!inverse)
        ck_assert_int_eq(icc_map_jacobian(map, N, points, jacobians, jacobian_status, NULL, NULL),
                         ICC_OK);
    for (size_t i = 0; i < N; ++i) {
        double image[2], jacobian[4];
        ck_assert_int_eq(reference(map, inverse, points + 2 * i, image, jacobian), status[i]);
        same_number(image[0], mapped[2 * i]);
        same_number(image[1], mapped[2 * i + 1]);
        if (inverse)
            continue;
        const bool has_jacobian = status[i] == ICC_OK && !isnan(jacobian[0]);
        ck_assert_int_eq(jacobian_status[i], has_jacobian          ? ICC_OK
                                             : status[i] == ICC_OK ? ICC_ERR_TRACE
                                                                   : status[i]);
        ck_assert(isnan(jacobians[4 * i]) != has_jacobian);
    }
}

START_TEST(points_near_the_boundary_are_located_by_it)
{
    const icc_map_options options = {.size = sizeof options, .iterations = -1};
    int n_maps = 0;
    for (int where = 0; where < 3; ++where) {
        shape s = shape_hard(_i), t = s;
        for (size_t k = 0; k < t.n; ++k)
            t.xy[2 * k] += 0.3 * t.xy[2 * k + 1];
        place(&s, where);
        place(&t, where);
        icc_domain *source = NULL, *target = NULL;
        icc_map *map = NULL;
        (void)icc_domain_create(&source, 2, s.n, s.xy, 0, NULL, NULL, NULL);
        (void)icc_domain_create(&target, 2, t.n, t.xy, 0, NULL, NULL, NULL);
        if (source != NULL && target != NULL)
            (void)icc_map_create(&map, source, target, &options, NULL, NULL);
        if (map != NULL && iccp_plane_of(map) != NULL) {
            for (int k = 0; k < share_of(6); ++k) {
                check_points(map, false, (uint64_t)(10 * _i + k));
                check_points(map, true, (uint64_t)(10 * _i + k));
            }
            ++n_maps;
        }
        icc_map_free(map);
        icc_domain_free(source);
        icc_domain_free(target);
    }
    ck_assert_int_ge(n_maps, _i == 3 || _i == 6 || _i == 15 ? 0 : 1);
}
END_TEST

/* ---- what is made when it is first needed ---- */

enum { N_POINTS = 300 };

typedef struct fixture {
    icc_domain *source, *target;
    bytes saved; /* a map of kind mesh */
    double points[2 * N_POINTS];
} fixture;

static const int32_t METHODS[] = {ICC_METHOD_DISC, ICC_METHOD_FOLIATION};

static fixture set_up(int32_t method)
{
    fixture f;
    shape s = shape_l(), t = s;
    icc_map *map;
    const icc_chart_options chart = {.size = sizeof chart, .method = method, .cells = 10};
    const icc_map_options options = {.size = sizeof options, .iterations = 2, .chart = &chart};
    random_source r = {7};
    t.xy[4] += 1; /* the boundary meets the centre of a pixel */
    t.xy[7] -= 0.3;
    f.source = domain_of_shape(&s);
    f.target = domain_of_shape(&t);
    ck_assert_int_eq(icc_map_create(&map, f.source, f.target, &options, NULL, NULL), ICC_OK);
    f.saved = map_bytes(map);
    icc_map_free(map);
    for (size_t i = 0; i < 2 * N_POINTS; ++i)
        f.points[i] = random_between(&r, -0.1, 3.1);
    return f;
}

static void tear_down(fixture *f)
{
    icc_domain_free(f->source);
    icc_domain_free(f->target);
    free(f->saved.data);
}

typedef struct answers {
    double there[2 * N_POINTS], back[2 * N_POINTS], jacobians[4 * N_POINTS];
    double bary[2 * N_POINTS], t[N_POINTS], decoded[2 * N_POINTS];
    uint32_t facet[N_POINTS];
    uint8_t pixels[64];
} answers;

enum { QUESTIONS = 6 };

/* One call that needs a grid that the others do not need, but for the last two. */
static icc_status ask(int question, const icc_map *map, const double *points, answers *a)
{
    uint8_t grey[64];
    const icc_picture from = {.size = sizeof from,
                              .width = 8,
                              .height = 8,
                              .channels = 1,
                              .bytes = 1,
                              .stride = 8,
                              .pixels = grey};
    icc_picture to = from;
    double bary[2 * N_POINTS], t[N_POINTS];
    uint32_t facet[N_POINTS];
    memset(grey, 9, sizeof grey);
    to.pixels = a->pixels;
    switch (question) {
    case 0:
        return icc_map_apply(map, N_POINTS, points, a->there, NULL, NULL, NULL);
    case 1:
        return icc_map_apply_inverse(map, N_POINTS, points, a->back, NULL, NULL, NULL);
    case 2:
        return icc_chart_encode(icc_map_source_chart(map), N_POINTS, points, a->facet, a->bary,
                                a->t, NULL, NULL, NULL);
    case 3:
        for (size_t i = 0; i < N_POINTS; ++i) {
            facet[i] = (uint32_t)i % 6;
            bary[2 * i] = (double)i / N_POINTS;
            bary[2 * i + 1] = 1 - bary[2 * i];
            t[i] = 0.5;
        }
        return icc_chart_decode(icc_map_target_chart(map), N_POINTS, facet, bary, t, a->decoded,
                                NULL, NULL, NULL);
    case 4:
        return icc_map_warp(map, &from, &to, NULL, NULL, NULL);
    default:
        return icc_map_jacobian(map, N_POINTS, points, a->jacobians, NULL, NULL, NULL);
    }
}

static void *count_alloc(void *user, size_t size)
{
    atomic_fetch_add((atomic_long *)user, 1);
    return malloc(size);
}

static void count_dealloc(void *user, void *memory)
{
    atomic_fetch_sub((atomic_long *)user, 1);
    free(memory);
}

/* Each call that needs it reports that there is no memory, and works when there is. */
START_TEST(failed_allocations_are_reported_by_who_needs_them)
{
    fixture x = set_up(METHODS[_i]);
    static answers expected, got;
    for (int question = 0; question < QUESTIONS; ++question) {
        faulty f = {0};
        const icc_env env = faulty_env(&f);
        icc_map *map, *other;
        ck_assert_int_eq(icc_map_load(&map, x.saved.n, x.saved.data, &env, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_load(&other, x.saved.n, x.saved.data, NULL, NULL), ICC_OK);
        memset(&expected, 0, sizeof expected);
        memset(&got, 0, sizeof got);
        ck_assert_int_eq(ask(question, other, x.points, &expected), ICC_OK);
        const bool needs_none = question == 3 && METHODS[_i] == ICC_METHOD_FOLIATION;
        for (size_t k = 1; k <= 3 && !needs_none; ++k) {
            f.fail_at = f.n_allocs + k;
            ck_assert_int_eq(ask(question, map, x.points, &got), ICC_ERR_MEMORY);
        }
        memset(&got, 0, sizeof got);
        ck_assert_int_eq(ask(question, map, x.points, &got), ICC_OK);
        const size_t n_allocs = f.n_allocs;
        ck_assert_int_eq(ask(question, map, x.points, &got), ICC_OK);
        ck_assert_uint_eq(f.n_allocs, n_allocs);
        ck_assert_same(&expected, &got, sizeof got, "an answer");
        icc_map_free(map);
        icc_map_free(other);
        ck_assert_uint_eq(f.n_live, 0);
    }
    tear_down(&x);
}
END_TEST

typedef struct asker {
    const icc_map *map;
    const double *points;
    int first;
    answers got;
} asker;

static void *ask_all(void *argument)
{
    asker *a = argument;
    bool fails = false;
    for (int k = 0; k < QUESTIONS; ++k)
        fails |= ask((a->first + k) % QUESTIONS, a->map, a->points, &a->got) != ICC_OK;
    return fails ? a : NULL;
}

START_TEST(threads_may_ask_at_once)
{
    fixture x = set_up(METHODS[_i]);
    static answers expected;
    static asker askers[TOGETHER];
    icc_map *map;
    ck_assert_int_eq(icc_map_load(&map, x.saved.n, x.saved.data, NULL, NULL), ICC_OK);
    for (int k = 0; k < QUESTIONS; ++k)
        ck_assert_int_eq(ask(k, map, x.points, &expected), ICC_OK);
    icc_map_free(map);
    for (int round = 0; round < share_of(30); ++round) {
        atomic_long n_live = 0;
        const icc_env env = {
            .size = sizeof env, .user = &n_live, .alloc = count_alloc, .dealloc = count_dealloc};
        ck_assert_int_eq(icc_map_load(&map, x.saved.n, x.saved.data, &env, NULL), ICC_OK);
        for (int k = 0; k < TOGETHER; ++k)
            askers[k] = (asker){.map = map, .points = x.points, .first = k / 2};
        run_together(ask_all, askers, sizeof *askers);
        for (int k = 0; k < TOGETHER; ++k)
            ck_assert_same(&expected, &askers[k].got, sizeof expected, "an answer");
        icc_map_free(map);
        ck_assert_int_eq(atomic_load(&n_live), 0);
    }
    tear_down(&x);
}
END_TEST

/* ---- following a target ---- */

static bytes follow(const icc_map *map, double x, const icc_env *env, icc_map **next)
{
    shape t = shape_l();
    t.xy[4] += 0.4 + x;
    t.xy[7] -= 0.3;
    icc_domain *target = domain_of_shape(&t);
    icc_map *own = NULL;
    ck_assert_int_eq(icc_map_retarget(&own, map, target, NULL, env, NULL), ICC_OK);
    icc_domain_free(target);
    const bytes b = map_bytes(own);
    if (next != NULL)
        *next = own;
    else
        icc_map_free(own);
    return b;
}

static void same_bytes(bytes a, bytes b)
{
    ck_assert_uint_eq(a.n, b.n);
    ck_assert_same(a.data, b.data, a.n, "a map that followed");
    free(a.data);
    free(b.data);
}

/* A map with an allocator of its own shares nothing with the first one. */
START_TEST(what_frames_share_changes_nothing)
{
    fixture x = set_up(ICC_METHOD_DISC);
    faulty f = {0};
    const icc_env apart = faulty_env(&f);
    icc_map *map, *frame, *next;
    ck_assert_int_eq(icc_map_load(&map, x.saved.n, x.saved.data, NULL, NULL), ICC_OK);
    for (int k = 0; k < 3; ++k)
        same_bytes(follow(map, 0.05 * k, NULL, NULL), follow(map, 0.05 * k, &apart, NULL));
    ck_assert_ptr_nonnull(iccp_once_get(&iccp_plane_of(map)->plan));
    frame = map;
    for (int k = 0; k < 4; ++k) { /* each from the one before, which is freed */
        iccp_newton_plan *plan = iccp_once_get(&iccp_plane_of(frame)->plan);
        const bytes other = follow(frame, 0.04 * k, &apart, NULL);
        same_bytes(follow(frame, 0.04 * k, NULL, &next), other);
        ck_assert_ptr_eq(iccp_once_get(&iccp_plane_of(next)->plan), plan);
        icc_map_free(frame);
        frame = next;
    }
    icc_map_free(frame);
    ck_assert_uint_eq(f.n_live, 0);
    tear_down(&x);
}
END_TEST

static icc_status follow_once(const icc_env *env, icc_error *err, void *argument)
{
    fixture *x = argument;
    icc_map *map, *frame[2] = {NULL, NULL};
    icc_status status = icc_map_load(&map, x->saved.n, x->saved.data, env, err);
    for (int k = 0; k < 2 && status == ICC_OK; ++k)
        status = icc_map_retarget(
            &frame[k], k == 0 ? map : frame[0], x->target,
            &(icc_retarget_options){.size = sizeof(icc_retarget_options), .iterations = 2}, env,
            err);
    icc_map_free(frame[0]);
    icc_map_free(frame[1]);
    icc_map_free(map);
    return status;
}

START_TEST(following_survives_failures)
{
    fixture x = set_up(ICC_METHOD_DISC);
    faulty_sweep(follow_once, &x);
    tear_down(&x);
}
END_TEST

typedef struct follower {
    const icc_map *map;
    double x;
    bytes made;
} follower;

static void *follow_at_once(void *argument)
{
    follower *f = argument;
    f->made = follow(f->map, f->x, NULL, NULL);
    return NULL;
}

START_TEST(threads_may_follow_at_once)
{
    fixture x = set_up(ICC_METHOD_DISC);
    for (int round = 0; round < share_of(10); ++round) {
        icc_map *map, *other;
        follower followers[TOGETHER];
        ck_assert_int_eq(icc_map_load(&map, x.saved.n, x.saved.data, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_load(&other, x.saved.n, x.saved.data, NULL, NULL), ICC_OK);
        for (int k = 0; k < TOGETHER; ++k)
            followers[k] = (follower){.map = map, .x = 0.03 * k};
        run_together(follow_at_once, followers, sizeof *followers);
        for (int k = 0; k < TOGETHER; ++k)
            same_bytes(followers[k].made, follow(other, 0.03 * k, NULL, NULL));
        icc_map_free(map);
        icc_map_free(other);
    }
    tear_down(&x);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("apply");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 240);
    tcase_add_loop_test(tests, points_near_the_boundary_are_located_by_it, 0, N_HARD_SHAPES);
    tcase_add_loop_test(tests, failed_allocations_are_reported_by_who_needs_them, 0, 2);
    tcase_add_loop_test(tests, threads_may_ask_at_once, 0, 2);
    tcase_add_test(tests, what_frames_share_changes_nothing);
    tcase_add_test(tests, following_survives_failures);
    tcase_add_test(tests, threads_may_follow_at_once);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
