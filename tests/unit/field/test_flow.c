/* Simplices of the grid, nearest points of hulls, and curves of fields that can be solved by
 * hand. */
#include "field/flow_follow.h"
#include "field/flow_jet.h"
#include "field/minnorm.h"
#include "gradient/grid/rasterise.h"

#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <string.h>

/* ---- simplices ---- */

static icc_grid *make_grid(int32_t dim, size_t side)
{
    size_t shape[ICC_MAX_DIM];
    iccp_env env;
    icc_grid *grid;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (int32_t k = 0; k < dim; ++k)
        shape[k] = side + (size_t)k % 2;
    ck_assert_int_eq(iccp_grid_new(&grid, dim, shape, &env, NULL), ICC_OK);
    return grid;
}

static void random_point(random_source *r, const icc_grid *grid, double *x)
{
    for (int32_t k = 0; k < grid->dim; ++k) {
        x[k] = random_between(r, 0, (double)(grid->shape[k] - 1));
        /* On faces of every dimension, too. */
        if (random_below(r, 3) == 0)
            x[k] = floor(x[k]);
        if (k > 0 && random_below(r, 4) == 0)
            x[k] = fmin(floor(x[k]), (double)(grid->shape[k] - 2)) + x[k - 1] - floor(x[k - 1]);
    }
}

static void check_holds(const icc_grid *grid, const iccp_kuhn_simplex *simplex,
                        const double *lambda, const double *x)
{
    double sum = 0, y[ICC_MAX_DIM];
    for (int32_t i = 0; i <= grid->dim; ++i) {
        ck_assert(lambda[i] >= 0);
        sum += lambda[i];
    }
    ck_assert(fabs(sum - 1) < 1e-14);
    iccp_kuhn_simplex_point(simplex, grid, lambda, y);
    for (int32_t k = 0; k < grid->dim; ++k)
        ck_assert(fabs(y[k] - x[k]) < 1e-13);
}

static bool is_corner(const iccp_kuhn_simplex *simplex, int32_t dim, uint32_t v)
{
    for (int32_t i = 0; i <= dim; ++i)
        if (simplex->corner[i] == v)
            return true;
    return false;
}

/* Across facet i and back; on the way the corners of the facet and the points on it stay. */
static void check_crossing(random_source *r, const icc_grid *grid, const iccp_kuhn_simplex *simplex,
                           int32_t i)
{
    const int32_t dim = grid->dim;
    iccp_kuhn_simplex across = *simplex;
    int32_t fresh, back;
    if (!iccp_kuhn_simplex_cross(&across, grid, i, &fresh)) {
        ck_assert_int_eq(memcmp(&across, simplex, sizeof across), 0);
        return;
    }
    for (int32_t j = 0; j <= dim; ++j)
        ck_assert(is_corner(&across, dim, simplex->corner[j]) == (j != i));
    ck_assert(!is_corner(simplex, dim, across.corner[fresh]));
    double lambda[ICC_MAX_DIM + 1], x[ICC_MAX_DIM], sum = 0;
    for (int32_t j = 0; j <= dim; ++j)
        sum += lambda[j] = j == i ? 0 : random_unit(r);
    for (int32_t j = 0; j <= dim; ++j)
        lambda[j] /= sum;
    iccp_kuhn_simplex_point(simplex, grid, lambda, x);
    iccp_kuhn_simplex_carry(dim, i, lambda);
    check_holds(grid, &across, lambda, x);
    ck_assert(iccp_kuhn_simplex_cross(&across, grid, fresh, &back));
    ck_assert_int_eq(back, i);
    for (int32_t j = 0; j <= dim; ++j)
        ck_assert_uint_eq(across.corner[j], simplex->corner[j]);
    for (int32_t k = 0; k < dim; ++k)
        ck_assert_int_eq(across.axis[k], simplex->axis[k]);
}

START_TEST(simplices_hold_their_points_and_lead_back)
{
    random_source r = {1};
    for (int32_t dim = 1; dim <= ICC_MAX_DIM; ++dim) {
        icc_grid *grid = make_grid(dim, 4);
        for (int round = 0; round < 300; ++round) {
            double x[ICC_MAX_DIM], lambda[ICC_MAX_DIM + 1];
            iccp_kuhn_simplex simplex;
            memset(&simplex, 0, sizeof simplex);
            random_point(&r, grid, x);
            ck_assert(iccp_kuhn_simplex_at(&simplex, grid, x, lambda));
            check_holds(grid, &simplex, lambda, x);
            for (int32_t i = 0; i <= dim; ++i)
                check_crossing(&r, grid, &simplex, i);
            x[dim - 1] = -0.5;
            ck_assert(!iccp_kuhn_simplex_at(&simplex, grid, x, lambda));
        }
        iccp_grid_release(grid);
    }
}
END_TEST

START_TEST(orders_are_numbered)
{
    iccp_orders orders;
    for (int32_t dim = 1; dim <= ICC_MAX_DIM; ++dim) {
        icc_grid *grid = make_grid(dim, 3);
        int32_t factorial = 1;
        for (int32_t k = 2; k <= dim; ++k)
            factorial *= k;
        iccp_orders_init(&orders, grid);
        ck_assert_int_eq(orders.n, factorial);
        for (int32_t r = 0; r < orders.n; ++r)
            ck_assert_int_eq(iccp_order_rank(dim, orders.axis[r]), r);
        iccp_grid_release(grid);
    }
}
END_TEST

/* ---- hulls ---- */

static double least_product(size_t dim, size_t n, const double *points, const double *x)
{
    double least = HUGE_VAL, length = 0;
    for (size_t k = 0; k < dim; ++k)
        length += x[k] * x[k];
    for (size_t i = 0; i < n; ++i) {
        double sum = 0;
        for (size_t k = 0; k < dim; ++k)
            sum += points[dim * i + k] * x[k];
        least = fmin(least, sum / sqrt(length));
    }
    return least;
}

/* In no direction is the least product larger, and the nearest point has a length equal to it. */
START_TEST(nearest_points_of_hulls)
{
    random_source r = {2};
    int n_apart = 0;
    for (int round = 0; round < 3000; ++round) {
        const size_t dim = 2 + (size_t)random_below(&r, 5), n = 1 + (size_t)random_below(&r, 30);
        double points[30 * ICC_MAX_DIM], nearest[ICC_MAX_DIM], length = 0;
        const double lean = random_between(&r, 0, 2);
        for (size_t i = 0; i < n * dim; ++i)
            points[i] = random_between(&r, -1, 1) + (i % dim == 0 ? lean : 0);
        if (n > 3 && random_below(&r, 2) == 0)
            memcpy(points + dim, points, dim * sizeof *points);
        const double least = iccp_minnorm(dim, n, points, nearest);
        for (size_t k = 0; k < dim; ++k)
            length += nearest[k] * nearest[k];
        ck_assert(fabs(least - sqrt(length)) < 1e-7);
        n_apart += least > 1e-9;
        for (int trial = 0; trial < 30; ++trial) {
            double x[ICC_MAX_DIM];
            for (size_t k = 0; k < dim; ++k)
                x[k] = (least > 1e-9 ? nearest[k] : 0) + random_between(&r, -1, 1) * pow(2, -trial);
            ck_assert(least_product(dim, n, points, x) <= least + 1e-9);
        }
    }
    ck_assert(n_apart > 300 && n_apart < 2700);
}
END_TEST

/* ---- curves ---- */

/* A ball of vectors on the grid of a box, set by hand. */
typedef struct world {
    iccp_env env;
    icc_domain *domain;
    icc_grid *grid;
    iccp_incidence incidence;
    iccp_vectors vectors;
    iccp_flow flow;
} world;

/* The box [0, 12]^3, of which the grid covers more. */
static void world_init(world *w)
{
    static const uint32_t FACES[36] = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    double corners[24];
    for (int i = 0; i < 24; ++i)
        corners[i] = i / 3 >> i % 3 & 1 ? 12 : 0;
    memset(w, 0, sizeof *w);
    ck_assert_int_eq(iccp_env_read(&w->env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_domain_create(&w->domain, 3, 8, corners, 12, FACES, &w->env, NULL),
                     ICC_OK);
    ck_assert_int_eq(iccp_grid_create(&w->grid, w->domain, 12, &w->env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_incidence_create(&w->incidence, w->domain, w->grid, &w->env), ICC_OK);
    w->vectors = (iccp_vectors){.memory = w->env.memory, .grid = w->grid};
    iccp_sectors_init(&w->vectors.sectors, 3, &w->env.memory);
    w->vectors.vector = iccp_alloc_zero(&w->env.memory, w->grid->n_vertices, 3 * sizeof(float));
    w->flow = (iccp_flow){w->grid, w->domain, &w->incidence, &w->vectors, 0, 10000};
}

static void world_free(world *w)
{
    iccp_vectors_free(&w->vectors);
    iccp_incidence_free(&w->incidence);
    iccp_grid_release(w->grid);
    iccp_domain_release(w->domain);
}

static void set_vectors(world *w, void (*field)(const double *x, double *v))
{
    for (uint32_t v = 0; v < w->grid->n_vertices; ++v) {
        double x[3], y[3];
        for (int32_t k = 0; k < 3; ++k)
            x[k] = iccp_grid_coordinate(w->grid, v, k);
        field(x, y);
        for (int k = 0; k < 3; ++k)
            w->vectors.vector[3 * (size_t)v + (size_t)k] = (float)y[k];
    }
}

static void straight(const double *x, double *v)
{
    (void)x;
    v[0] = 0.25;
    v[1] = -0.5;
    v[2] = 1;
}

/* Screws round the axis through (7.5, 7.5, .), which is exact in single precision at vertices. */
static void screw(const double *x, double *v)
{
    v[0] = -(x[1] - 7.5);
    v[1] = x[0] - 7.5;
    v[2] = 0.5;
}

START_TEST(a_constant_field_has_straight_curves)
{
    world w;
    random_source r = {3};
    world_init(&w);
    set_vectors(&w, straight);
    for (int round = 0; round < 200; ++round) {
        iccp_flow_place place;
        iccp_flow_walk walk;
        double x[3], y[3];
        const int sign = random_below(&r, 2) ? 1 : -1;
        for (int k = 0; k < 3; ++k)
            x[k] = random_between(&r, 5, 10);
        ck_assert(iccp_flow_find(&w.flow, x, NULL, &place));
        ck_assert_int_eq(iccp_flow_start(&walk, &w.flow, sign, &place), ICC_OK);
        for (int k = 0; k < 8; ++k)
            ck_assert_int_eq(iccp_flow_next(&walk), ICC_OK);
        iccp_flow_position(&w.flow, &walk.place, walk.place.at, y);
        const double length = sqrt(1.3125), step = sign * walk.length / length;
        ck_assert(walk.length > 0.5);
        ck_assert(fabs(y[0] - x[0] - 0.25 * step) < 1e-13);
        ck_assert(fabs(y[1] - x[1] + 0.5 * step) < 1e-13);
        ck_assert(fabs(y[2] - x[2] - step) < 1e-13);
    }
    world_free(&w);
}
END_TEST

/* Where a screw line is after a length. */
static void screw_to(const double *from, double length, double *to)
{
    const double a = from[0] - 7.5, b = from[1] - 7.5, speed = sqrt(a * a + b * b + 0.25);
    const double t = length / speed;
    to[0] = 7.5 + a * cos(t) - b * sin(t);
    to[1] = 7.5 + a * sin(t) + b * cos(t);
    to[2] = from[2] + 0.5 * t;
}

START_TEST(screw_lines_are_followed_exactly)
{
    world w;
    random_source r = {4};
    world_init(&w);
    set_vectors(&w, screw);
    for (int round = 0; round < 200; ++round) {
        iccp_flow_place place;
        iccp_flow_walk walk;
        double x[3], y[3], z[3], at[3];
        for (int k = 0; k < 3; ++k)
            x[k] = random_between(&r, 5, 10);
        ck_assert(iccp_flow_find(&w.flow, x, NULL, &place));
        ck_assert_int_eq(iccp_flow_start(&walk, &w.flow, 1, &place), ICC_OK);
        for (y[2] = 0; y[2] < 14;) {
            iccp_flow_position(&w.flow, &walk.place, walk.place.at, y);
            screw_to(x, walk.length, z);
            for (int i = 0; i < 3; ++i)
                ck_assert(fabs(y[i] - z[i]) < 1e-12);
            /* Within the piece, by length and back. */
            const double part = random_unit(&r) * walk.end_length;
            const double s = iccp_flow_at_length(&walk, part);
            ck_assert(fabs(iccp_flow_length(&walk, s) - part) < 1e-13);
            iccp_flow_at(&walk, s, at);
            iccp_flow_position(&w.flow, &walk.place, at, y);
            screw_to(x, walk.length + part, z);
            for (int i = 0; i < 3; ++i)
                ck_assert(fabs(y[i] - z[i]) < 1e-12);
            ck_assert_int_eq(iccp_flow_next(&walk), ICC_OK);
        }
    }
    world_free(&w);
}
END_TEST

/* Against differences of the solution: starts that move, a plane that they end on. */
START_TEST(derivatives_of_screw_lines)
{
    world w;
    random_source r = {5};
    world_init(&w);
    set_vectors(&w, screw);
    for (int round = 0; round < 100; ++round) {
        iccp_flow_place place;
        iccp_flow_walk walk;
        iccp_flow_jet jet = {.n = 3, .place = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        double x[3], high[3], low[3];
        for (int k = 0; k < 3; ++k)
            x[k] = random_between(&r, 5, 10);
        ck_assert(iccp_flow_find(&w.flow, x, NULL, &place));
        ck_assert_int_eq(iccp_flow_start(&walk, &w.flow, 1, &place), ICC_OK);
        for (int k = 0; k < 12; ++k) {
            ck_assert(iccp_flow_jet_pass(&walk, &jet));
            ck_assert_int_eq(iccp_flow_next(&walk), ICC_OK);
        }
        for (int c = 0; c < 3; ++c) {
            const double h = 1e-5;
            double moved[3] = {x[0], x[1], x[2]};
            moved[c] = x[c] + h;
            screw_to(moved, walk.length + h * jet.length[c], high);
            moved[c] = x[c] - h;
            screw_to(moved, walk.length - h * jet.length[c], low);
            for (int k = 0; k < 3; ++k)
                ck_assert(fabs((high[k] - low[k]) / (2 * h) - jet.place[c][k]) < 1e-7);
        }
    }
    world_free(&w);
}
END_TEST

/* The box' faces are crossed where the solution crosses them. */
START_TEST(the_boundary_is_met_where_it_is)
{
    world w;
    random_source r = {6};
    world_init(&w);
    set_vectors(&w, straight);
    const double high = (w.domain->upper[0] - w.grid->origin[0]) / w.grid->spacing;
    const double low = (w.domain->lower[0] - w.grid->origin[0]) / w.grid->spacing;
    for (int round = 0; round < 300; ++round) {
        static const double speed[3] = {0.25, -0.5, 1};
        iccp_flow_place place;
        iccp_flow_walk walk;
        double x[3], s, bary[3], local[3], best = HUGE_VAL;
        uint32_t facet = 0;
        for (int k = 0; k < 3; ++k) {
            x[k] = random_between(&r, low + 0.01, high - 0.01);
            best = fmin(best, ((speed[k] > 0 ? high : low) - x[k]) / speed[k]);
        }
        ck_assert(iccp_flow_find(&w.flow, x, NULL, &place));
        ck_assert_int_eq(iccp_flow_start(&walk, &w.flow, 1, &place), ICC_OK);
        while (!iccp_flow_leaves(&walk, &s, &facet, bary))
            ck_assert_int_eq(iccp_flow_next(&walk), ICC_OK);
        iccp_domain_facet_point(w.domain, facet, bary, local);
        for (int k = 0; k < 3; ++k) {
            const double y = (local[k] - w.grid->origin[k]) / w.grid->spacing;
            ck_assert(fabs(y - x[k] - best * speed[k]) < 1e-12);
        }
        ck_assert(fabs(walk.length + iccp_flow_length(&walk, s) - best * sqrt(1.3125)) < 1e-12);
    }
    world_free(&w);
}
END_TEST

/* In the simplices around the root curves are straight, up and down. */
START_TEST(the_root_is_reached_straight)
{
    world w;
    random_source r = {7};
    world_init(&w);
    set_vectors(&w, straight);
    double root[3];
    w.flow.root = 8 * (uint32_t)(1 + w.grid->stride[1] + w.grid->stride[2]);
    for (int32_t k = 0; k < 3; ++k)
        root[k] = iccp_grid_coordinate(w.grid, w.flow.root, k);
    for (int round = 0; round < 200; ++round) {
        iccp_flow_place place;
        iccp_flow_walk walk;
        double x[3], y[3], distance = 0;
        for (int k = 0; k < 3; ++k) {
            x[k] = root[k] + random_between(&r, -0.3, 0.3);
            distance += (x[k] - root[k]) * (x[k] - root[k]);
        }
        distance = sqrt(distance);
        ck_assert(iccp_flow_find(&w.flow, x, NULL, &place));
        ck_assert_int_eq(iccp_flow_start(&walk, &w.flow, 1, &place), ICC_OK);
        ck_assert(walk.ends);
        ck_assert(fabs(walk.end_length - distance) < 1e-14);
        ck_assert_int_eq(iccp_flow_start(&walk, &w.flow, -1, &place), ICC_OK);
        ck_assert(!walk.ends);
        iccp_flow_position(&w.flow, &walk.place, walk.finish, y);
        for (int k = 0; k < 3; ++k)
            ck_assert(fabs((y[k] - root[k]) * distance -
                           (x[k] - root[k]) * (distance + walk.end_length)) < 1e-13);
    }
    world_free(&w);
}
END_TEST

/* Where there is no vector there is no way; and a closed curve is given up. */
START_TEST(hopeless_walks_end)
{
    world w;
    iccp_flow_place place;
    iccp_flow_walk walk;
    const double x[3] = {6.3, 7.2, 7.1};
    world_init(&w);
    ck_assert(iccp_flow_find(&w.flow, x, NULL, &place));
    ck_assert_int_eq(iccp_flow_start(&walk, &w.flow, 1, &place), ICC_ERR_TRACE);
    set_vectors(&w, screw);
    for (uint32_t v = 0; v < w.grid->n_vertices; ++v)
        w.vectors.vector[3 * v + 2] = 0;
    icc_status status = iccp_flow_start(&walk, &w.flow, 1, &place);
    for (size_t k = 0; k < 10 * w.flow.most_steps && status == ICC_OK; ++k)
        status = iccp_flow_next(&walk);
    ck_assert_int_eq(status, ICC_ERR_TRACE);
    world_free(&w);
}
END_TEST

/* To the middle, with a twist and much noise, so that pieces are of every kind. */
static void whirl(const double *x, double *v)
{
    for (int k = 0; k < 3; ++k)
        v[k] = 8 - x[k] + 2 * sin(7 * x[0] + 11 * x[1] + 13 * x[2] + k);
    v[0] -= 1.5 * (x[1] - 8);
    v[1] += 1.5 * (x[0] - 8);
}

/* By itself, as far as a curve of many goes. */
static void follow_alone(const iccp_flow *flow, iccp_flow_curve *curve, iccp_path *path)
{
    iccp_flow_walk walk;
    double s = 0;
    path->n_marks = 0;
    curve->status = iccp_flow_start(&walk, flow, curve->sign, &curve->start);
    while (curve->status == ICC_OK && !walk.ends) {
        ck_assert_int_eq(iccp_flow_note(&walk, path), ICC_OK);
        if (curve->sign < 0 && iccp_flow_leaves(&walk, &s, &curve->facet, curve->bary))
            break;
        curve->status = iccp_flow_next(&walk);
    }
    if (curve->status != ICC_OK)
        return;
    if (curve->sign < 0) {
        curve->length = walk.length + iccp_flow_length(&walk, s);
        return;
    }
    curve->length = walk.length + walk.end_length;
    const double length = curve->share * curve->length;
    ck_assert_int_eq(iccp_flow_note(&walk, path), ICC_OK);
    ck_assert_int_eq(iccp_flow_rewind(&walk, path, length), ICC_OK);
    curve->place = walk.place;
    iccp_flow_at(&walk, iccp_flow_at_length(&walk, length - walk.length), curve->place.at);
}

static void check_same(const iccp_flow_curve *a, const iccp_flow_curve *b)
{
    ck_assert_int_eq(a->status, b->status);
    if (a->status != ICC_OK)
        return;
    ck_assert_mem_eq(&a->length, &b->length, sizeof a->length);
    if (a->sign < 0) {
        ck_assert_uint_eq(a->facet, b->facet);
        ck_assert_mem_eq(a->bary, b->bary, 3 * sizeof *a->bary);
    } else if (a->share > 0) {
        ck_assert_mem_eq(a->place.at, b->place.at, 3 * sizeof *a->place.at);
        ck_assert_mem_eq(a->place.simplex.corner, b->place.simplex.corner, 4 * sizeof(uint32_t));
    }
}

/* However many run side by side. Also with hopeless ones among them. */
START_TEST(many_curves_are_as_if_alone)
{
    enum { N = 300 };
    static iccp_flow_curve alone[N], together[N];
    world w;
    iccp_path path;
    random_source r = {8};
    size_t n_lost = 0, n_curves = 0;
    world_init(&w);
    set_vectors(&w, whirl);
    w.flow.most_steps = 300;
    w.flow.root = 8 * (uint32_t)(1 + w.grid->stride[1] + w.grid->stride[2]);
    memset(w.vectors.vector + 3 * (w.flow.root - 2), 0, 3 * sizeof(float));
    iccp_path_init(&path, &w.env.memory);
    for (size_t i = 0; i < N; ++i) {
        double x[3];
        for (int k = 0; k < 3; ++k)
            x[k] = random_between(&r, 4, 12);
        alone[i].sign = random_below(&r, 2) ? 1 : -1;
        alone[i].share = alone[i].sign > 0 && random_below(&r, 3) > 0 ? random_unit(&r) : 0;
        ck_assert(iccp_flow_find(&w.flow, x, NULL, &alone[i].start));
        together[i] = alone[i];
        follow_alone(&w.flow, &alone[i], &path);
        n_lost += alone[i].status != ICC_OK;
    }
    ck_assert(n_lost > 0 && n_lost < N / 2);
    for (size_t n = 1, from = 0; from < N; from += n, n += 7) {
        n = from + n < N ? n : N - from;
        for (iccp_simd_level level = ICCP_SIMD_NONE; level <= iccp_simd(); ++level) {
            ck_assert_int_eq(iccp_flow_follow_as(level, &w.flow, n, together + from, &w.env.memory),
                             ICC_OK);
            for (size_t i = from; i < from + n; ++i, ++n_curves)
                check_same(&alone[i], &together[i]);
        }
    }
    ck_assert_uint_ge(n_curves, N);
    iccp_path_clear(&path);
    world_free(&w);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("flow");
    TCase *tests = tcase_create("flow");
    tcase_add_test(tests, simplices_hold_their_points_and_lead_back);
    tcase_add_test(tests, orders_are_numbered);
    tcase_add_test(tests, nearest_points_of_hulls);
    tcase_add_test(tests, a_constant_field_has_straight_curves);
    tcase_add_test(tests, screw_lines_are_followed_exactly);
    tcase_add_test(tests, derivatives_of_screw_lines);
    tcase_add_test(tests, the_boundary_is_met_where_it_is);
    tcase_add_test(tests, the_root_is_reached_straight);
    tcase_add_test(tests, hopeless_walks_end);
    tcase_add_test(tests, many_curves_are_as_if_alone);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
