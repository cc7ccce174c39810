/* Fits by public calls: control points, figures and meshes, and what is refused. */
#include "../random.h"
#include "../shapes.h"
#include "../suite.h"

#include <icc/fit.h>
#include <math.h>
#include <string.h>

enum { MOST = 60 };

static icc_constraint points_of(size_t n, const double *from, const double *to)
{
    return (icc_constraint){.size = sizeof(icc_constraint),
                            .kind = ICC_CONSTRAINT_POINTS,
                            .n = n,
                            .source = from,
                            .target = to};
}

static icc_fit *fit_of(const icc_constraint *told, const icc_fit_options *options)
{
    icc_fit *fit;
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_fit_create(&fit, NULL, NULL, 1, told, options, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    return fit;
}

static icc_fit_info info_of(const icc_fit *fit)
{
    icc_fit_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_fit_get_info(fit, &info), ICC_OK);
    return info;
}

static void random_points(random_source *r, size_t n, double *points)
{
    for (size_t i = 0; i < 2 * n; ++i)
        points[i] = 0.05 + 0.9 * random_unit(r);
}

static void check_certified(const icc_map *map)
{
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert_int_eq(info.kind, ICC_MAP_MESH);
    ck_assert_int_eq(info.certified, 1);
}

/* Checks that points go exactly where they are told, and come back. */
static void check_exact(const icc_fit *fit, size_t n, const double *from, const double *to)
{
    double images[2 * MOST], back[2 * MOST];
    const icc_map *map = icc_fit_map(fit);
    check_certified(map);
    ck_assert_int_eq(icc_map_apply(map, n, from, images, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_apply_inverse(map, n, to, back, NULL, NULL, NULL), ICC_OK);
    for (size_t i = 0; i < 2 * n; ++i) {
        ck_assert_double_eq(images[i], to[i]);
        ck_assert_double_eq(back[i], from[i]);
    }
}

/* ---- control points ---- */

static void affine(size_t n, const double *p, double *q)
{
    for (size_t i = 0; i < n; ++i) {
        q[2 * i] = 1500 * p[2 * i] + 300 * p[2 * i + 1] + 4e5;
        q[2 * i + 1] = -200 * p[2 * i] + 1400 * p[2 * i + 1] + 5e6;
    }
}

START_TEST(affine_maps_are_found_to_rounding)
{
    random_source r = {1};
    for (size_t n = 3; n <= 50; n += 23) {
        double p[2 * MOST], q[2 * MOST], probe[40], expected[40], images[40];
        random_points(&r, n, p);
        affine(n, p, q);
        const icc_constraint told = points_of(n, p, q);
        const icc_fit_options options = {.size = sizeof options, .box = (double[]){0, 0, 1, 1}};
        icc_fit *fit = fit_of(&told, &options);
        check_exact(fit, n, p, q);
        random_points(&r, 20, probe);
        affine(20, probe, expected);
        ck_assert_int_eq(icc_map_apply(icc_fit_map(fit), 20, probe, images, NULL, NULL, NULL),
                         ICC_OK);
        for (size_t i = 0; i < 40; ++i)
            ck_assert_double_eq_tol(images[i], expected[i], 1e-5);
        ck_assert_double_lt(info_of(fit).affine_residual, 1e-6);
        icc_fit_free(fit);
    }
}
END_TEST

/* One point gives a shift, two give a similarity. */
START_TEST(few_points_are_enough)
{
    const double p[4] = {1, 1, 3, 1}, q[4] = {5, 5, 5, 9}, probe[2] = {1.5, 1.25};
    for (size_t n = 1; n <= 2; ++n) {
        const icc_constraint told = points_of(n, p, q);
        const icc_fit_options options = {.size = sizeof options, .box = (double[]){0, 0, 4, 4}};
        icc_fit *fit = fit_of(&told, &options);
        double image[2];
        check_exact(fit, n, p, q);
        ck_assert_int_eq(icc_map_apply(icc_fit_map(fit), 1, probe, image, NULL, NULL, NULL),
                         ICC_OK);
        ck_assert_double_eq_tol(image[0], (n == 1 ? 5.5 : 4.5), 1e-12);
        ck_assert_double_eq_tol(image[1], (n == 1 ? 5.25 : 6), 1e-12);
        icc_fit_free(fit);
    }
}
END_TEST

/* Points that are pushed through one another fold the spline. */
START_TEST(folded_splines_are_repaired)
{
    random_source r = {2};
    for (int k = 0; k < 6; ++k) {
        const size_t n = 12 + 8 * (size_t)k;
        double p[2 * MOST], q[2 * MOST], swap[2];
        random_points(&r, n, p);
        memcpy(q, p, sizeof q);
        memcpy(swap, q, sizeof swap);
        memcpy(q, q + 2, sizeof swap);
        memcpy(q + 2, swap, sizeof swap);
        const icc_constraint told = points_of(n, p, q);
        icc_fit *fit = fit_of(&told, NULL);
        const icc_fit_info info = info_of(fit);
        ck_assert_uint_gt(info.n_folded, 0);
        ck_assert_int_ne(info.repair, ICC_REPAIR_NONE);
        check_exact(fit, n, p, q);
        icc_fit_free(fit);
    }
}
END_TEST

/* With a tolerance, points with noise are smoothed; otherwise they are exact. */
START_TEST(tolerances_smooth)
{
    random_source r = {3};
    double p[2 * MOST], q[2 * MOST], tolerance[MOST], residuals[2 * MOST], left_out[2 * MOST];
    random_points(&r, MOST, p);
    for (size_t i = 0; i < MOST; ++i) {
        q[2 * i] = p[2 * i] + 0.02 * (random_unit(&r) - 0.5);
        q[2 * i + 1] = p[2 * i + 1] + 0.02 * (random_unit(&r) - 0.5);
        tolerance[i] = 0.01;
    }
    icc_constraint told = points_of(MOST, p, q);
    told.tolerance = tolerance;
    icc_fit *smooth = fit_of(&told, NULL);
    told.tolerance = NULL;
    icc_fit *exact = fit_of(&told, NULL);
    check_exact(exact, MOST, p, q);
    ck_assert_double_gt(info_of(smooth).residual, 1e-3);
    ck_assert_double_gt(info_of(smooth).smoothing, 0);
    ck_assert_double_lt(info_of(smooth).left_out, info_of(exact).left_out);
    ck_assert_int_eq(icc_fit_get_residuals(smooth, residuals, left_out), ICC_OK);
    double sum = 0, image[2];
    for (size_t i = 0; i < 2 * MOST; ++i)
        sum += residuals[i] * residuals[i];
    ck_assert_double_eq_tol(info_of(smooth).residual, sqrt(sum / MOST), 1e-12);
    ck_assert_int_eq(icc_map_apply(icc_fit_map(smooth), 1, p, image, NULL, NULL, NULL), ICC_OK);
    ck_assert_double_eq_tol(image[0] - q[0], residuals[0], 1e-9);
    icc_fit_free(smooth);
    icc_fit_free(exact);
}
END_TEST

START_TEST(a_moved_spline_is_the_one_made_anew)
{
    random_source r = {4};
    double p[2 * MOST], q[2 * MOST], images[2][40], probe[40];
    random_points(&r, 30, p);
    random_points(&r, 20, probe);
    memcpy(q, p, sizeof q);
    const icc_constraint told = points_of(30, p, q);
    const icc_fit_options options = {
        .size = sizeof options, .margin = 0.3, .box = (double[]){0, 0, 1, 1}};
    icc_fit *fit = fit_of(&told, &options), *moved;
    q[0] += 0.02;
    ck_assert_int_eq(icc_fit_move(&moved, fit, q, NULL, NULL), ICC_OK);
    icc_fit_free(fit);
    check_exact(moved, 30, p, q);
    icc_fit *anew = fit_of(&told, &options);
    for (int k = 0; k < 2; ++k)
        ck_assert_int_eq(icc_map_apply(icc_fit_map(k == 0 ? moved : anew), 20, probe, images[k],
                                       NULL, NULL, NULL),
                         ICC_OK);
    for (size_t i = 0; i < 40; ++i)
        ck_assert_double_eq_tol(images[0][i], images[1][i], 1e-3);
    icc_fit_free(moved);
    icc_fit_free(anew);
}
END_TEST

/* A spline keeps its margin, its smoothing and its factor when it moves. So when it comes back, it
 * is the same to the last bit. */
START_TEST(a_spline_comes_back)
{
    random_source r = {5};
    double p[2 * MOST], q[2 * MOST], tolerance[MOST], probe[40], images[2][40];
    random_points(&r, 40, p);
    random_points(&r, 20, probe);
    for (size_t i = 0; i < 40; ++i) {
        tolerance[i] = i % 3 == 0 ? 0 : 0.01;
        q[2 * i] = p[2 * i] + 0.05 * p[2 * i + 1] * p[2 * i + 1] + tolerance[i] * (double)(i % 2);
        q[2 * i + 1] = p[2 * i + 1];
    }
    icc_constraint told = points_of(40, p, q);
    const icc_fit_options options = {.size = sizeof options, .box = (double[]){0, 0, 1, 1}};
    icc_fit_info info[3] = {{.size = sizeof *info}, {.size = sizeof *info}, {.size = sizeof *info}};
    told.tolerance = tolerance;
    icc_fit *fit[3] = {fit_of(&told, &options)};
    const double there = q[2];
    for (int k = 0; k < 2; ++k) {
        q[2] = k == 0 ? there + 0.25 : there;
        ck_assert_int_eq(icc_fit_move(&fit[k + 1], fit[k], q, NULL, NULL), ICC_OK);
    }
    for (int k = 0; k < 3; ++k)
        ck_assert_int_eq(icc_fit_get_info(fit[k], &info[k]), ICC_OK);
    ck_assert_double_gt(info[0].smoothing, 0);
    ck_assert(memcmp(&info[0], &info[2], sizeof *info) == 0);
    ck_assert(!(info[1].margin < info[0].margin || info[1].margin > info[0].margin));
    for (int k = 0; k < 3; k += 2)
        ck_assert_int_eq(
            icc_map_apply(icc_fit_map(fit[k]), 20, probe, images[k / 2], NULL, NULL, NULL), ICC_OK);
    ck_assert_mem_eq(images[0], images[1], sizeof *images);
    for (int k = 0; k < 3; ++k)
        icc_fit_free(fit[k]);
}
END_TEST

/* ---- lines without a domain ---- */

/* Checks that the parts of a line go along linearly. */
static void check_line(const icc_fit *fit, size_t n, const double *from, const double *to)
{
    enum { PARTS = 64 };
    for (size_t i = 0; i + 1 < n; ++i)
        for (int k = 0; k <= PARTS; ++k) {
            const double t = (double)k / PARTS;
            double p[2], image[2];
            for (size_t d = 0; d < 2; ++d)
                p[d] = (1 - t) * from[2 * i + d] + t * from[2 * i + 2 + d];
            ck_assert_int_eq(icc_map_apply(icc_fit_map(fit), 1, p, image, NULL, NULL, NULL),
                             ICC_OK);
            for (size_t d = 0; d < 2; ++d)
                ck_assert_double_eq_tol(image[d], (1 - t) * to[2 * i + d] + t * to[2 * i + 2 + d],
                                        1e-13);
        }
}

static icc_constraint line_of(size_t n, const double *from, const double *to)
{
    icc_constraint line = points_of(n, from, to);
    line.kind = ICC_CONSTRAINT_LINE;
    return line;
}

/* A river with a tributary and a ring among points. Then the river goes the other way round its
 * bend, and points change places beside the tributary, so that the spline folds. */
START_TEST(lines_go_along_linearly)
{
    const double river[8] = {0.1, 0.5, 0.35, 0.6, 0.6, 0.45, 0.95, 0.55};
    const double brook[6] = {0.6, 0.45, 0.55, 0.3, 0.62, 0.1};
    const double ring[8] = {0.2, 0.75, 0.3, 0.75, 0.25, 0.85, 0.2, 0.75};
    const double points[8] = {0.05, 0.05, 0.95, 0.95, 0.45, 0.2, 0.75, 0.2};
    double to[26], all[26], images[8];
    memcpy(all, river, sizeof river);
    memcpy(all + 8, brook, sizeof brook);
    memcpy(all + 14, ring, sizeof ring);
    memcpy(all + 22, points, 4 * sizeof *points);
    for (size_t i = 0; i < 26; ++i)
        to[i] = 2 * all[i] + 0.05 * sin(7 * all[i ^ 1]);
    const icc_constraint told[4] = {line_of(4, all, to), line_of(3, all + 8, to + 8),
                                    line_of(4, all + 14, to + 14), points_of(2, all + 22, to + 22)};
    icc_fit *fit, *moved;
    icc_error err = {.size = sizeof err};
    const icc_status status = icc_fit_create(&fit, NULL, NULL, 4, told, NULL, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
    check_exact(fit, 13, all, to);
    ck_assert_int_eq(info_of(fit).repair, ICC_REPAIR_NONE);
    check_line(fit, 4, all, to);
    check_line(fit, 3, all + 8, to + 8);
    check_line(fit, 4, all + 14, to + 14);
    double left_out[26];
    ck_assert_int_eq(icc_fit_get_residuals(fit, NULL, left_out), ICC_OK);
    for (size_t i = 0; i < 26; ++i)
        ck_assert(isnan(left_out[i]) == (i < 22));
    /* the bend of the river and the ring's tip go to where the spline folds */
    to[3] -= 0.5;
    to[19] += 0.4;
    to[10] -= 0.3;
    ck_assert_int_eq(icc_fit_move(&moved, fit, to, NULL, NULL), ICC_OK);
    ck_assert_int_ne(info_of(moved).repair, ICC_REPAIR_NONE);
    check_exact(moved, 13, all, to);
    check_line(moved, 4, all, to);
    check_line(moved, 3, all + 8, to + 8);
    check_line(moved, 4, all + 14, to + 14);
    ck_assert_int_eq(icc_map_apply(icc_fit_map(moved), 4, points, images, NULL, NULL, NULL),
                     ICC_OK);
    icc_fit_free(moved);
    icc_fit_free(fit);
}
END_TEST

/* Random lines that stay apart, in a warp that folds: each part stays straight, whatever was
 * repaired. */
START_TEST(lines_survive_folds)
{
    enum { LINES = 4, VERTICES = 4 };
    random_source r = {7};
    size_t n_repaired = 0;
    for (int turn = 0; turn < 12; ++turn) {
        double from[LINES][2 * VERTICES], to[LINES][2 * VERTICES], p[40], q[40];
        icc_constraint told[LINES + 1];
        for (size_t k = 0; k < LINES; ++k) {
            for (size_t i = 0; i < VERTICES; ++i) {
                from[k][2 * i] = 0.3 * (double)i + 0.1 * random_unit(&r);
                from[k][2 * i + 1] = 0.3 * (double)k + 0.1 * random_unit(&r);
                to[k][2 * i] = 0.3 * (double)i + 0.1 * random_unit(&r);
                to[k][2 * i + 1] = 0.3 * (double)k + 0.2 * random_unit(&r);
            }
            told[k] = line_of(VERTICES, from[k], to[k]);
        }
        /* between lines, so that none has to cross one */
        for (size_t i = 0; i < 20; ++i) {
            const double row = 0.3 * (double)(i % 3);
            p[2 * i] = 0.9 * random_unit(&r);
            p[2 * i + 1] = row + 0.15 + 0.1 * random_unit(&r);
            q[2 * i] = p[2 * i] + 0.1 * random_unit(&r);
            q[2 * i + 1] = row + 0.22 + 0.07 * random_unit(&r);
        }
        told[LINES] = points_of(20, p, q);
        icc_fit *fit;
        icc_error err = {.size = sizeof err};
        const icc_status status =
            icc_fit_create(&fit, NULL, NULL, LINES + 1, told, NULL, NULL, &err);
        ck_assert_msg(status == ICC_OK, "%d: %s", turn, err.message);
        n_repaired += info_of(fit).repair != ICC_REPAIR_NONE;
        check_exact(fit, 20, p, q);
        for (size_t k = 0; k < LINES; ++k)
            check_line(fit, VERTICES, from[k], to[k]);
        icc_fit_free(fit);
    }
    ck_assert_uint_gt(n_repaired, 6);
}
END_TEST

/* ---- figures and meshes ---- */

static icc_domain *bar(void)
{
    const double xy[] = {0, 0, 10, 0, 10, 1, 0, 1};
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, xy, 0, NULL, NULL, NULL), ICC_OK);
    return domain;
}

static const double BAR_PINS[6] = {0.5, 0.5, 5, 0.5, 9.5, 0.5};
static const double BENT[6] = {3, 0, 5, 4, 7, 0};

START_TEST(a_bar_bends)
{
    icc_domain *domain = bar();
    const icc_constraint told = points_of(3, BAR_PINS, BENT);
    icc_fit *fit;
    ck_assert_int_eq(icc_fit_create(&fit, domain, NULL, 1, &told, NULL, NULL, NULL), ICC_OK);
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(icc_fit_map(fit), &info), ICC_OK);
    ck_assert_double_lt(info.energy, 4.3);
    check_exact(fit, 3, BAR_PINS, BENT);
    ck_assert_uint_eq(info_of(fit).n_off, 0);
    /* Back in steps, as in a drag. */
    for (int k = 4; k >= 0; --k) {
        double to[6];
        icc_fit *next;
        for (size_t i = 0; i < 6; ++i)
            to[i] = BAR_PINS[i] + 0.2 * k * (BENT[i] - BAR_PINS[i]);
        ck_assert_int_eq(icc_fit_move(&next, fit, to, NULL, NULL), ICC_OK);
        icc_fit_free(fit);
        fit = next;
        check_exact(fit, 3, BAR_PINS, to);
    }
    ck_assert_int_eq(icc_map_get_info(icc_fit_map(fit), &info), ICC_OK);
    ck_assert_double_lt(info.energy, 4.001);
    icc_fit_free(fit);
    icc_domain_free(domain);
}
END_TEST

/* A told edge goes along linearly, also where the mesh divides it. */
START_TEST(told_edges_are_straight)
{
    icc_domain *domain = bar();
    const uint32_t vertices[2] = {1, 2};
    const double to[4] = {9, 3, 9, 4.5};
    icc_constraint told[2] = {points_of(1, BAR_PINS, BAR_PINS),
                              {.size = sizeof told[1],
                               .kind = ICC_CONSTRAINT_VERTICES,
                               .n = 2,
                               .vertices = vertices,
                               .target = to}};
    const icc_fit_options options = {.size = sizeof options, .cell = 0.3};
    icc_fit *fit;
    ck_assert_int_eq(icc_fit_create(&fit, domain, NULL, 2, told, &options, NULL, NULL), ICC_OK);
    check_certified(icc_fit_map(fit));
    for (int k = 0; k <= 16; ++k) {
        const double t = k / 16., p[2] = {10, t};
        double image[2];
        ck_assert_int_eq(icc_map_apply(icc_fit_map(fit), 1, p, image, NULL, NULL, NULL), ICC_OK);
        ck_assert_double_eq_tol(image[0], 9, 1e-12);
        ck_assert_double_eq_tol(image[1], 3 + 1.5 * t, 1e-12);
    }
    icc_fit_free(fit);
    icc_domain_free(domain);
}
END_TEST

/* A line that begins at a corner of the outline and runs along an edge of it goes along linearly,
 * too. */
START_TEST(lines_may_begin_on_the_outline)
{
    icc_domain *domain = bar();
    const double from[6] = {10, 1, 10, 0, 4, 0.5}, to[6] = {10, 1.5, 10, 0, 4, 1};
    const icc_constraint told = {
        .size = sizeof told, .kind = ICC_CONSTRAINT_LINE, .n = 3, .source = from, .target = to};
    const icc_fit_options options = {.size = sizeof options, .cell = 0.3};
    icc_fit *fit;
    ck_assert_int_eq(icc_fit_create(&fit, domain, NULL, 1, &told, &options, NULL, NULL), ICC_OK);
    check_certified(icc_fit_map(fit));
    ck_assert_uint_eq(info_of(fit).n_off, 0);
    for (int k = 0; k <= 32; ++k) {
        const double t = k % 16 / 16.;
        const size_t i = k < 16 ? 0 : 2;
        double p[2], wanted[2], image[2];
        for (size_t d = 0; d < 2; ++d) {
            p[d] = k == 32 ? from[4 + d] : (1 - t) * from[i + d] + t * from[i + 2 + d];
            wanted[d] = k == 32 ? to[4 + d] : (1 - t) * to[i + d] + t * to[i + 2 + d];
        }
        ck_assert_int_eq(icc_map_apply(icc_fit_map(fit), 1, p, image, NULL, NULL, NULL), ICC_OK);
        for (size_t d = 0; d < 2; ++d)
            ck_assert_double_eq_tol(image[d], wanted[d], 1e-12);
    }
    icc_fit_free(fit);
    icc_domain_free(domain);
}
END_TEST

enum { CELLS = 8, SIDE = CELLS + 1 };

typedef struct box_mesh {
    double vertices[2 * SIDE * SIDE];
    uint32_t cells[6 * CELLS * CELLS];
    icc_mesh mesh;
} box_mesh;

static void box_init(box_mesh *b)
{
    size_t n = 0;
    for (uint32_t v = 0; v < SIDE * SIDE; ++v) {
        b->vertices[2 * v] = 2. * (v % SIDE) / CELLS;
        b->vertices[2 * v + 1] = 1. * (v / SIDE) / CELLS;
        for (size_t k = 0; v % SIDE < CELLS && v / SIDE < CELLS && k < 6; ++k)
            b->cells[n++] = v + (uint32_t[]){0, 1, SIDE + 1, 0, SIDE + 1, SIDE}[k];
    }
    b->mesh = (icc_mesh){.size = sizeof b->mesh,
                         .dim = 2,
                         .n_vertices = SIDE * SIDE,
                         .vertices = b->vertices,
                         .n_cells = n / 3,
                         .cells = b->cells};
}

/* The top of a box comes down aslant; its sides slide, its bottom stays. */
START_TEST(walls_slide)
{
    box_mesh b;
    box_init(&b);
    uint32_t held[2 * SIDE], sliding[2 * CELLS];
    double to[4 * SIDE];
    size_t n_sliding = 0;
    for (uint32_t i = 0; i < SIDE; ++i) {
        held[i] = i;
        held[SIDE + i] = CELLS * SIDE + i;
        for (size_t k = 0; k < 2; ++k) {
            to[2 * i + k] = b.vertices[2 * i + k];
            to[2 * (SIDE + i) + k] =
                b.vertices[2 * held[SIDE + i] + k] - (k == 1) * 0.06 * (CELLS - i);
        }
        if (i > 0 && i < CELLS) {
            sliding[n_sliding++] = i * SIDE;
            sliding[n_sliding++] = i * SIDE + CELLS;
        }
    }
    const icc_constraint told[2] = {{.size = sizeof told[0],
                                     .kind = ICC_CONSTRAINT_VERTICES,
                                     .n = 2 * SIDE,
                                     .vertices = held,
                                     .target = to},
                                    {.size = sizeof told[0],
                                     .kind = ICC_CONSTRAINT_SLIDING,
                                     .n = n_sliding,
                                     .vertices = sliding}};
    icc_fit *fit;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_fit_create(&fit, NULL, &b.mesh, 2, told, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    check_certified(icc_fit_map(fit));
    double vertices[2 * SIDE * SIDE], images[2 * SIDE * SIDE];
    icc_mesh mesh = {.size = sizeof mesh, .n_vertices = SIDE * SIDE, .vertices = vertices};
    ck_assert_int_eq(icc_map_get_mesh(icc_fit_map(fit), &mesh, images), ICC_OK);
    ck_assert_mem_eq(vertices, b.vertices, sizeof vertices);
    for (size_t i = 0; i < 2 * SIDE; ++i)
        ck_assert_mem_eq(images + 2 * held[i], to + 2 * i, 2 * sizeof *to);
    for (size_t i = 0; i < n_sliding; ++i)
        ck_assert_double_eq_tol(images[2 * sliding[i]], vertices[2 * sliding[i]], 1e-14);
    icc_fit_free(fit);
}
END_TEST

/* The same cells as quadrilaterals stay convex, whatever the diagonal: the top is pushed aside until
 * triangles alone would let some of them turn concave. */
START_TEST(quadrilaterals_stay_convex)
{
    box_mesh b;
    box_init(&b);
    uint32_t cells[4 * CELLS * CELLS], held[2 * SIDE];
    size_t offsets[CELLS * CELLS + 1], n = 0;
    double to[4 * SIDE];
    for (uint32_t v = 0; v < SIDE * SIDE; ++v)
        for (size_t k = 0; v % SIDE < CELLS && v / SIDE < CELLS && k < 4; ++k)
            cells[n++] = v + (uint32_t[]){0, 1, SIDE + 1, SIDE}[k];
    for (size_t c = 0; c <= CELLS * CELLS; ++c)
        offsets[c] = 4 * c;
    b.mesh.n_cells = CELLS * CELLS;
    b.mesh.cells = cells;
    b.mesh.offsets = offsets;
    for (uint32_t i = 0; i < SIDE; ++i) {
        held[i] = i;
        held[SIDE + i] = CELLS * SIDE + i;
        for (size_t k = 0; k < 2; ++k) {
            to[2 * i + k] = b.vertices[2 * i + k];
            to[2 * (SIDE + i) + k] =
                b.vertices[2 * held[SIDE + i] + k] + (k == 0 ? 1.5 : -0.1 * (i % 3));
        }
    }
    const icc_constraint told = {.size = sizeof told,
                                 .kind = ICC_CONSTRAINT_VERTICES,
                                 .n = 2 * SIDE,
                                 .vertices = held,
                                 .target = to};
    icc_fit *fit;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_fit_create(&fit, NULL, &b.mesh, 1, &told, NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    check_certified(icc_fit_map(fit));
    ck_assert_uint_eq(info_of(fit).n_off, 0);
    double images[2 * SIDE * SIDE];
    uint32_t triangles[6 * CELLS * CELLS];
    icc_mesh mesh = {.size = sizeof mesh, .n_cells = 2 * CELLS * CELLS, .cells = triangles};
    ck_assert_int_eq(icc_map_get_mesh(icc_fit_map(fit), &mesh, images), ICC_OK);
    ck_assert_uint_eq(mesh.n_cells, 2 * CELLS * CELLS);
    for (size_t c = 0; c < 4 * CELLS * CELLS; ++c) {
        const double *p[3];
        for (size_t k = 0; k < 3; ++k)
            p[k] = images + 2 * (size_t)cells[c / 4 * 4 + (c + k) % 4];
        ck_assert_double_gt((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                                (p[2][0] - p[0][0]) * (p[1][1] - p[0][1]),
                            0);
    }
    icc_fit_free(fit);
    cells[1] = SIDE + 1; /* lists a vertex twice */
    ck_assert_int_eq(icc_fit_create(&fit, NULL, &b.mesh, 1, &told, NULL, NULL, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.side, 1);
    ck_assert_int_eq(err.index, 0);
}
END_TEST

/* ---- what is refused ---- */

static void check_refused(icc_status status, const icc_domain *domain, const icc_mesh *mesh,
                          const icc_constraint *told, const icc_fit_options *options,
                          const char *word)
{
    icc_error err = {.size = sizeof err};
    icc_fit *fit = (icc_fit *)&fit;
    const icc_status got = icc_fit_create(&fit, domain, mesh, 1, told, options, NULL, &err);
    ck_assert_msg(got == status, "%s: %d, %s", word, (int)got, err.message);
    ck_assert_ptr_null(fit);
    ck_assert_msg(strstr(err.message, word) != NULL, "%s: %s", word, err.message);
}

START_TEST(wrong_requests_are_refused)
{
    const double p[8] = {0, 0, 1, 0, 1, 1, 0, 1}, mirrored[8] = {0, 0, 1, 0, 1, -1, 0, -1};
    const double twice[8] = {0, 0, 1, 0, 1, 0, 0, 1}, broken[8] = {0, 0, 1, 0, NAN, 1, 0, 1};
    const uint32_t vertex = 99;
    icc_domain *domain = bar();
    box_mesh b;
    box_init(&b);
    icc_constraint told = points_of(4, p, mirrored);
    check_refused(ICC_ERR_ARGUMENT, NULL, NULL, &told, NULL, "mirror");
    told = points_of(4, twice, p);
    check_refused(ICC_ERR_ARGUMENT, NULL, NULL, &told, NULL, "different targets");
    told = points_of(4, broken, p);
    check_refused(ICC_ERR_ARGUMENT, NULL, NULL, &told, NULL, "not finite");
    told = points_of(4, p, broken);
    check_refused(ICC_ERR_ARGUMENT, NULL, NULL, &told, NULL, "target");
    told = points_of(0, p, p);
    check_refused(ICC_ERR_ARGUMENT, NULL, NULL, &told, NULL, "at least 1");
    told = points_of(4, p, p);
    check_refused(ICC_ERR_ARGUMENT, NULL, NULL, &told,
                  &(icc_fit_options){.size = sizeof(icc_fit_options), .reach = 1}, "reach");
    check_refused(
        ICC_ERR_ARGUMENT, NULL, NULL, &told,
        &(icc_fit_options){.size = sizeof(icc_fit_options), .box = (double[]){1, 0, 0, 1}}, "box");
    check_refused(ICC_ERR_ARGUMENT, domain, NULL, &told,
                  &(icc_fit_options){.size = sizeof(icc_fit_options), .margin = 1}, "margin");
    check_refused(ICC_ERR_ARGUMENT, domain, &b.mesh, &told, NULL, "not both");
    told = points_of(1, (double[]){0.51, 0.5}, p);
    check_refused(ICC_ERR_ARGUMENT, NULL, &b.mesh, &told, NULL, "no vertex");
    told = points_of(1, b.vertices, p);
    check_refused(ICC_ERR_ARGUMENT, NULL, &b.mesh, &told,
                  &(icc_fit_options){.size = sizeof(icc_fit_options), .cell = 1}, "cell");
    told = points_of(1, (double[]){20, 0.5}, p);
    check_refused(ICC_ERR_OUTSIDE, domain, NULL, &told, NULL, "not inside");
    told = points_of(2, (double[]){1, 0.5, 9, 5}, p);
    told.kind = ICC_CONSTRAINT_LINE;
    check_refused(ICC_ERR_OUTSIDE, domain, NULL, &told, NULL, "not inside");
    told = (icc_constraint){.size = sizeof told,
                            .kind = ICC_CONSTRAINT_VERTICES,
                            .n = 1,
                            .vertices = &vertex,
                            .target = p};
    check_refused(ICC_ERR_ARGUMENT, domain, NULL, &told, NULL, "vertex 99");
    check_refused(ICC_ERR_UNSUPPORTED, NULL, NULL, &told, NULL, "only points and lines");
    icc_domain_free(domain);
}
END_TEST

/* Two triangles apart, a vertex of no triangle, and a vertex that does not exist. */
START_TEST(wrong_meshes_are_refused)
{
    double points[14] = {0, 0, 1, 0, 0, 1, 3, 0, 4, 0, 3, 1, 9, 9};
    uint32_t triangles[6] = {0, 1, 2, 3, 4, 5};
    const icc_constraint told = points_of(1, points, points);
    const size_t n_vertices[3] = {6, 7, 5};
    const icc_status expected[3] = {ICC_ERR_TOPOLOGY, ICC_ERR_BOUNDARY, ICC_ERR_BOUNDARY};
    const char *const words[3] = {"one piece", "vertex 6", "vertex 5"};
    for (int k = 0; k < 3; ++k) {
        const icc_mesh mesh = {.size = sizeof mesh,
                               .dim = 2,
                               .n_vertices = n_vertices[k],
                               .vertices = points,
                               .n_cells = 2,
                               .cells = triangles};
        check_refused(expected[k], NULL, &mesh, &told, NULL, words[k]);
    }
}
END_TEST

/* A told line that crosses itself has no mesh, and one that leaves the domain neither. The item is
 * named. */
START_TEST(lines_that_meet_are_refused)
{
    const double p[8] = {1, 0.2, 2, 0.8, 1, 0.8, 2, 0.2};
    icc_constraint told = points_of(4, p, p);
    icc_domain *domain = bar();
    told.kind = ICC_CONSTRAINT_LINE;
    check_refused(ICC_ERR_CERTIFICATE, domain, NULL, &told, NULL,
                  "from point 2 to point 3 meets the line from point 0 to point 1");
    const double out[4] = {1, 0.5, 1, 5}, back[4] = {1, 0.5, 1, 0.6};
    told = points_of(2, out, back);
    told.kind = ICC_CONSTRAINT_LINE;
    check_refused(ICC_ERR_OUTSIDE, domain, NULL, &told, NULL, "point 1");
    icc_domain_free(domain);
}
END_TEST

/* The same without a domain, before and after the map, and with points. */
START_TEST(lines_that_meet_in_a_frame_are_refused)
{
    const double cross[8] = {0, 0, 1, 1, 0, 1, 1, 0}, apart[8] = {0, 0, 1, 0, 0, 1, 1, 1};
    const double middle[2] = {0.5, 0}, flat[8] = {0, 0, 1, 0, 0.5, 0, 2, 1};
    icc_constraint told[2] = {line_of(4, cross, apart), points_of(1, middle, middle)};
    check_refused(
        ICC_ERR_CERTIFICATE, NULL, NULL, told, NULL,
        "source: the line from point 2 to point 3 meets the line from point 0 to point 1");
    told[0] = line_of(4, apart, cross);
    check_refused(
        ICC_ERR_CERTIFICATE, NULL, NULL, told, NULL,
        "target: the line from point 2 to point 3 meets the line from point 0 to point 1");
    told[0] = line_of(4, flat, flat);
    check_refused(ICC_ERR_CERTIFICATE, NULL, NULL, told, NULL, "meets the line");
    told[0] = line_of(2, (double[]){0, 1, 0, 1}, apart);
    check_refused(ICC_ERR_ARGUMENT, NULL, NULL, told, NULL,
                  "the line from point 0 to point 1 has no length");
    told[0] = line_of(4, apart, apart);
    icc_fit *fit;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_fit_create(&fit, NULL, NULL, 2, told, NULL, NULL, &err),
                     ICC_ERR_CERTIFICATE);
    ck_assert_msg(strstr(err.message, "from point 0 to point 1 meets point 4") != NULL, "%s",
                  err.message);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("fit");
    TCase *tc = tcase_create("fit");
    tcase_set_timeout(tc, 300);
    tcase_add_test(tc, affine_maps_are_found_to_rounding);
    tcase_add_test(tc, few_points_are_enough);
    tcase_add_test(tc, folded_splines_are_repaired);
    tcase_add_test(tc, tolerances_smooth);
    tcase_add_test(tc, a_moved_spline_is_the_one_made_anew);
    tcase_add_test(tc, a_spline_comes_back);
    tcase_add_test(tc, a_bar_bends);
    tcase_add_test(tc, told_edges_are_straight);
    tcase_add_test(tc, lines_may_begin_on_the_outline);
    tcase_add_test(tc, walls_slide);
    tcase_add_test(tc, quadrilaterals_stay_convex);
    tcase_add_test(tc, wrong_requests_are_refused);
    tcase_add_test(tc, wrong_meshes_are_refused);
    tcase_add_test(tc, lines_that_meet_are_refused);
    tcase_add_test(tc, lines_go_along_linearly);
    tcase_add_test(tc, lines_survive_folds);
    tcase_add_test(tc, lines_that_meet_in_a_frame_are_refused);
    suite_add_tcase(suite, tc);
    return suite_run(suite);
}
