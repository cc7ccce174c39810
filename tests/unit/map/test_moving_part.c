/* A target of which a few vertices move: only the faces at them change. */
#include "../../faulty.h"
#include "../../suite.h"
#include "map/map.h"
#include "map/plane/plane_kind.h"

#include <math.h>

/* A square of SIZE by SIZE nodes, a distance of 1 apart, with all rows and columns as lines. */
enum { SIZE = 7, N_NODES = SIZE * SIZE, N_LINES = 2 * (SIZE - 2), N_RIM = 4 * (SIZE - 1) };

static size_t node_at(int row, int column)
{
    return (size_t)(SIZE * row + column);
}

static void place_nodes(double *places)
{
    for (int i = 0; i < SIZE; ++i)
        for (int k = 0; k < SIZE; ++k) {
            places[2 * node_at(i, k)] = k - SIZE / 2;
            places[2 * node_at(i, k) + 1] = i - SIZE / 2;
        }
}

static void add(double *list, size_t *n, const double *places, size_t node)
{
    memcpy(list + 2 * (*n)++, places + 2 * node, 2 * sizeof *list);
}

static icc_domain *domain_of(const double *places)
{
    double rim[2 * N_RIM], lines[N_LINES][2 * SIZE];
    icc_feature features[N_LINES];
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    size_t n = 0;
    for (int side = 0; side < 4; ++side)
        for (int k = 0; k < SIZE - 1; ++k) {
            const int back = SIZE - 1 - k, last = SIZE - 1;
            add(rim, &n, places,
                side == 0   ? node_at(0, k)
                : side == 1 ? node_at(k, last)
                : side == 2 ? node_at(last, back)
                            : node_at(back, 0));
        }
    for (int line = 0; line < N_LINES; ++line) {
        size_t n_line = 0;
        for (int k = 0; k < SIZE; ++k)
            add(lines[line], &n_line, places,
                line % 2 == 0 ? node_at(1 + line / 2, k) : node_at(k, 1 + line / 2));
        features[line] = (icc_feature){.size = sizeof *features,
                                       .kind = ICC_FEATURE_LINE,
                                       .n_vertices = n_line,
                                       .vertices = lines[line]};
    }
    const icc_status status =
        icc_domain_create_features(&domain, N_RIM, rim, N_LINES, features, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    return domain;
}

/* A map of the square whose inner nodes have moved. */
static icc_map *bent_map(icc_domain **source, double *places, const icc_env *env)
{
    icc_map *map;
    place_nodes(places);
    *source = domain_of(places);
    for (int i = 1; i < SIZE - 1; ++i)
        for (int k = 1; k < SIZE - 1; ++k) {
            places[2 * node_at(i, k)] += 0.3 * sin(1.1 * i);
            places[2 * node_at(i, k) + 1] += 0.3 * cos(1.7 * k);
        }
    icc_domain *target = domain_of(places);
    ck_assert_int_eq(icc_map_create(&map, *source, target, NULL, env, NULL), ICC_OK);
    icc_domain_free(target);
    return map;
}

static icc_map *retarget(const icc_map *map, const double *places, const icc_env *env)
{
    icc_domain *target = domain_of(places);
    icc_error err = {.size = sizeof err};
    icc_map *next;
    const icc_status status = icc_map_retarget(&next, map, target, NULL, env, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    icc_domain_free(target);
    return next;
}

static const iccp_plmap *mesh_of(const icc_map *map)
{
    return &iccp_plane_of(map)->pl;
}

static bool same_places(const icc_map *a, const icc_map *b)
{
    const iccp_plmap *p = mesh_of(a), *q = mesh_of(b);
    return p->n_vertices == q->n_vertices && p->corners.n_triangles == q->corners.n_triangles &&
           memcmp(p->points, q->points, 2 * p->n_vertices * sizeof *p->points) == 0 &&
           memcmp(p->images, q->images, 2 * p->n_vertices * sizeof *p->images) == 0 &&
           memcmp(p->corners.vertex, q->corners.vertex,
                  3 * p->corners.n_triangles * sizeof(uint32_t)) == 0;
}

static bool has_vertex(const iccp_plmap *map, const double *point, const double *image)
{
    for (size_t v = 0; v < map->n_vertices; ++v)
        if (memcmp(map->points + 2 * v, point, 2 * sizeof *point) == 0)
            return memcmp(map->images + 2 * v, image, 2 * sizeof *image) == 0;
    return false;
}

/* Vertices that do not lie in one of the four faces at an inner node stay, bit for bit. */
static void check_others(const icc_map *before, const icc_map *after, int row, int column)
{
    const iccp_plmap *old = mesh_of(before);
    const double scale = before->source_domain->frame.out[0] * before->source_domain->frame.out[1];
    size_t n_stay = 0;
    for (size_t v = 0; v < old->n_vertices; ++v) {
        const double *point = old->points + 2 * v;
        if (fmax(fabs(scale * point[0] - (column - SIZE / 2)),
                 fabs(scale * point[1] - (row - SIZE / 2))) < 1)
            continue;
        ck_assert(has_vertex(mesh_of(after), point, old->images + 2 * v));
        ++n_stay;
    }
    ck_assert_uint_gt(n_stay, old->n_vertices / 2);
}

static void check_map(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    (void)icc_map_get_info(map, &info);
    ck_assert_int_eq(info.certified, 1);
    ck_assert_int_eq(info.class_kept, 1);
    ck_assert_double_eq_tol(info.energy, iccp_plmap_energy(mesh_of(map)), 1e-12 * info.energy);
    ck_assert_uint_eq(info.n_simplices, mesh_of(map)->corners.n_triangles);
}

/* One node after the other goes around in a circle. It comes close to others, so meshes change. */
START_TEST(other_faces_stay)
{
    double places[2 * N_NODES], bent[2 * N_NODES];
    icc_domain *source;
    icc_map *map = bent_map(&source, places, NULL);
    size_t n_changes = 0;
    memcpy(bent, places, sizeof bent);
    for (int frame = 0; frame < 60; ++frame) {
        const int row = 1 + frame / 12 % 5, column = 1 + frame / 6 % 5;
        const size_t node = node_at(row, column);
        const double angle = 1.05 * (frame % 6 + 1);
        places[2 * node] = bent[2 * node] + 0.35 * sin(angle);
        places[2 * node + 1] = bent[2 * node + 1] + 0.35 * (1 - cos(angle));
        icc_map *next = retarget(map, places, NULL);
        check_map(next);
        check_others(map, next, row, column);
        n_changes += mesh_of(map)->corners.n_triangles != mesh_of(next)->corners.n_triangles;
        icc_map_free(map);
        map = next;
    }
    ck_assert_uint_gt(n_changes, 3);
    icc_map_free(map);
    icc_domain_free(source);
}
END_TEST

/* Nothing moves, so the map stays the same. */
START_TEST(the_same_target)
{
    double places[2 * N_NODES];
    icc_domain *source;
    icc_map *map = bent_map(&source, places, NULL), *next = retarget(map, places, NULL);
    check_map(next);
    ck_assert(same_places(map, next));
    icc_map_free(next);
    icc_map_free(map);
    icc_domain_free(source);
}
END_TEST

/* A frame depends on the map before it and on the target, and on nothing else: not on threads, and
 * not on what else was made from the same map. */
START_TEST(the_same_bits)
{
    const icc_env many = {.size = sizeof many, .threads = 3};
    double places[2 * N_NODES], others[2 * N_NODES];
    icc_domain *source, *source_again;
    icc_map *map = bent_map(&source, places, NULL), *again = bent_map(&source_again, others, &many);
    ck_assert(same_places(map, again));
    others[2 * node_at(4, 5)] += 0.2;
    icc_map *other = retarget(again, others, NULL);
    for (int frame = 0; frame < 3; ++frame) {
        places[2 * node_at(2, 3) + 1] += 0.1;
        icc_map *next[2] = {retarget(map, places, NULL), retarget(again, places, &many)};
        ck_assert(same_places(next[0], next[1]));
        icc_map_free(map);
        icc_map_free(again);
        map = next[0];
        again = next[1];
    }
    icc_map_free(other);
    icc_map_free(map);
    icc_map_free(again);
    icc_domain_free(source);
    icc_domain_free(source_again);
}
END_TEST

/* Every allocation fails once, and every report of progress is answered with "stop" once. */
START_TEST(failures)
{
    double places[2 * N_NODES];
    icc_domain *source;
    icc_map *map = bent_map(&source, places, NULL);
    places[2 * node_at(3, 3)] += 0.5;
    icc_domain *target = domain_of(places);
    for (int cancels = 0; cancels < 2; ++cancels)
        for (size_t k = 1;; ++k) {
            faulty f = {0};
            icc_map *next;
            icc_error err = {.size = sizeof err};
            *(cancels ? &f.cancel_at : &f.fail_at) = k;
            const icc_env env = faulty_env(&f);
            const icc_status status = icc_map_retarget(&next, map, target, NULL, &env, &err);
            icc_map_free(next);
            ck_assert_uint_eq(f.n_live, 0);
            if (status == ICC_OK)
                break;
            ck_assert_int_eq(status, cancels ? ICC_ERR_CANCELLED : ICC_ERR_MEMORY);
        }
    icc_domain_free(target);
    icc_map_free(map);
    icc_domain_free(source);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("moving part");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, other_faces_stay);
    tcase_add_test(tests, the_same_target);
    tcase_add_test(tests, the_same_bits);
    tcase_add_test(tests, failures);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
