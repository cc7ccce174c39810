/* The elastic model: puppets, moving meshes, sliding, contact. */
#include "fit/elastic/elastic_model.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../random.h"
#include "../../../share.h"
#include "../../../suite.h"
#include "base/error.h"
#include "domain/outlines.h"
#include "fit/elastic/pin_mesh.h"
#include "math/predicates.h"
#include "mesh/corners.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define TURN 6.283185307179586

/* A mesh, what is told of it, and its images. */
typedef struct scene {
    size_t n_points, n_triangles;
    double *points, *targets, *images, *direction;
    uint32_t *corners;
    uint8_t *hold;
    double stiffness, reach;
    bool contact;
} scene;

static scene make_scene(size_t n_points, size_t n_triangles)
{
    const scene s = {.n_points = n_points,
                     .n_triangles = n_triangles,
                     .points = calloc(2 * n_points, sizeof(double)),
                     .targets = calloc(2 * n_points, sizeof(double)),
                     .images = calloc(2 * n_points, sizeof(double)),
                     .direction = calloc(2 * n_points, sizeof(double)),
                     .corners = calloc(3 * n_triangles, sizeof(uint32_t)),
                     .hold = calloc(n_points, 1)};
    ck_assert(s.points != NULL && s.targets != NULL && s.images != NULL && s.direction != NULL &&
              s.corners != NULL && s.hold != NULL);
    return s;
}

static void clear_scene(const scene *s)
{
    free(s->points);
    free(s->targets);
    free(s->images);
    free(s->direction);
    free(s->corners);
    free(s->hold);
}

/* Starts over: the images are the points. */
static void reset(const scene *s)
{
    memcpy(s->images, s->points, 2 * s->n_points * sizeof *s->points);
}

static void rest(const scene *s)
{
    memcpy(s->targets, s->points, 2 * s->n_points * sizeof *s->points);
    reset(s);
}

static void hold(const scene *s, size_t v, double x, double y)
{
    s->hold[v] = ICCP_HELD;
    s->targets[2 * v] = x;
    s->targets[2 * v + 1] = y;
}

/* Lattice points by number: columns of `rows` + 1 points each. */
static void fill_lattice(const scene *s, uint32_t columns, uint32_t rows, bool closed)
{
    uint32_t n = 0;
    const uint32_t n_points = (columns + (closed ? 0 : 1)) * (rows + 1);
    for (uint32_t i = 0; i < columns; ++i)
        for (uint32_t j = 0; j < rows; ++j) {
            const uint32_t a = i * (rows + 1) + j, b = (a + rows + 1) % n_points;
            const uint32_t cell[6] = {a, b, b + 1, a, b + 1, a + 1};
            for (size_t k = 0; k < 6; ++k)
                s->corners[n++] = cell[k];
        }
}

/* A box of columns by rows cells. */
static scene make_box(uint32_t columns, uint32_t rows, double width, double height)
{
    const scene s = make_scene((size_t)(columns + 1) * (rows + 1), (size_t)2 * columns * rows);
    for (size_t v = 0; v < s.n_points; ++v) {
        s.points[2 * v] = width * (double)(v / (rows + 1)) / columns;
        s.points[2 * v + 1] = height * (double)(v % (rows + 1)) / rows;
    }
    fill_lattice(&s, columns, rows, false);
    rest(&s);
    return s;
}

/* Layers of cells around a wall, out to a circle. */
typedef struct layers {
    uint32_t around, n;
    double growth; /* of a layer's thickness */
    bool is_airfoil;
} layers;

static const layers ellipse = {64, 24, 1.25, false}, airfoil = {120, 47, 1.22, true};

enum { MOST_LAYERS = 48 };

/* A point of the wall, clockwise from the trailing edge, and its outward normal. The airfoil is
 * NACA 0012. */
static void wall_at(const layers *l, double turns, double *p, double *normal)
{
    double at[3][2];
    for (int k = 0; k < 3; ++k) {
        const double t = turns + (k - 1) * 0.01, c = cos(TURN * t), z = sin(TURN * t);
        const double x = 0.5 * (1 + c);
        const double y =
            0.6 * (0.2969 * sqrt(x) + x * (-0.126 + x * (-0.3516 + x * (0.2843 - 0.1036 * x))));
        at[k][0] = l->is_airfoil ? x - 0.4 : c;
        at[k][1] = l->is_airfoil ? copysign(y, -z) : -0.35 * z;
    }
    const double tx = at[2][0] - at[0][0], ty = at[2][1] - at[0][1];
    memcpy(p, at[1], sizeof at[1]);
    normal[0] = -ty / hypot(tx, ty);
    normal[1] = tx / hypot(tx, ty);
}

/* The layers leave the wall along its normals. */
static scene make_layers(const layers *l)
{
    const size_t column = l->n + 1;
    const scene s = make_scene(l->around * column, (size_t)2 * l->around * l->n);
    double way[MOST_LAYERS] = {0}, layer = 1;
    for (size_t j = 0; j < l->n; ++j, layer *= l->growth)
        way[j + 1] = way[j] + layer;
    for (size_t v = 0; v < s.n_points; ++v) {
        const double share = way[v % column] / way[l->n];
        const double turns = (double)(v / column) / l->around;
        const double far[2] = {cos(TURN * turns), -sin(TURN * turns)};
        double p[2], normal[2];
        wall_at(l, turns, p, normal);
        for (size_t d = 0; d < 2; ++d)
            s.points[2 * v + d] =
                ((1 - share) * (p[d] + 2 * share * normal[d]) + share * 6 * far[d]) / 8;
    }
    fill_lattice(&s, l->around, l->n, true);
    rest(&s);
    return s;
}

/* Turns the wall, and holds the circle. */
static void turn_wall(const scene *s, const layers *l, double turns)
{
    const double c = cos(TURN * turns), z = sin(TURN * turns);
    for (size_t v = 0; v < s->n_points; ++v) {
        const double *p = s->points + 2 * v;
        if (v % (l->n + 1) == 0)
            hold(s, v, c * p[0] - z * p[1], z * p[0] + c * p[1]);
        else if (v % (l->n + 1) == l->n)
            hold(s, v, p[0], p[1]);
    }
}

/* Returns points in the local coordinates of a domain. */
static double *localise(const icc_domain *domain, size_t n, const double *points)
{
    double *local = calloc(2 * n + 1, sizeof *local);
    ck_assert_ptr_nonnull(local);
    for (size_t k = 0; k < n; ++k)
        iccp_frame_in(&domain->frame, 2, points + 2 * k, local + 2 * k);
    return local;
}

/* Meshes a polygon with pins. */
static scene make_puppet(size_t n, const double *outline, size_t n_pins, const double *pins,
                         size_t *first_pin)
{
    const iccp_env env = default_env();
    icc_domain *domain;
    iccp_pin_mesh mesh;
    ck_assert_int_eq(icc_domain_create(&domain, 2, n, outline, 0, NULL, NULL, NULL), ICC_OK);
    double *local = localise(domain, n_pins, pins);
    const iccp_pin_mesh_input input = {.domain = domain, .n_pins = n_pins, .pins = local};
    ck_assert_int_eq(iccp_pin_mesh_create(&mesh, &input, &env, NULL), ICC_OK);
    scene s = make_scene(mesh.n_points, mesh.n_triangles);
    for (size_t v = 0; v < s.n_points; ++v)
        iccp_frame_out(&domain->frame, 2, mesh.points + 2 * v, s.points + 2 * v);
    memcpy(s.corners, mesh.triangles, 3 * s.n_triangles * sizeof *s.corners);
    rest(&s);
    *first_pin = n;
    for (size_t k = 0; k < n_pins; ++k)
        hold(&s, n + k, pins[2 * k], pins[2 * k + 1]);
    iccp_pin_mesh_free(&mesh);
    icc_domain_free(domain);
    free(local);
    return s;
}

static icc_status solve(const scene *s, iccp_elastic_report *report, const iccp_env *env,
                        icc_error *err)
{
    const iccp_elastic_input input = {.n_points = s->n_points,
                                      .n_triangles = s->n_triangles,
                                      .points = s->points,
                                      .corners = s->corners,
                                      .hold = s->hold,
                                      .direction = s->direction,
                                      .stiffness = s->stiffness,
                                      .reach = s->reach,
                                      .contact = s->contact};
    iccp_elastic *elastic;
    icc_status status = iccp_elastic_create(&elastic, &input, env);
    if (status == ICC_OK)
        status = iccp_elastic_solve(elastic, s->targets, s->images, report, env, err);
    iccp_elastic_free(elastic);
    return iccp_explain(err, status);
}

/* Checks the certificate by predicates alone. */
static void check_valid(const scene *s)
{
    const iccp_env env = default_env();
    iccp_outlines outlines;
    iccp_corners corners = {s->corners, malloc(3 * s->n_triangles * sizeof(uint32_t)),
                            s->n_triangles};
    uint32_t *next = malloc(s->n_points * sizeof *next);
    bool is_manifold;
    ck_assert(corners.twin != NULL && next != NULL);
    ck_assert_int_eq(iccp_find_twins(&corners, s->n_points, &is_manifold, &env), ICC_OK);
    ck_assert(is_manifold);
    memset(next, 0xff, s->n_points * sizeof *next);
    for (uint32_t c = 0; c < 3 * s->n_triangles; ++c) {
        const double *p[3];
        for (size_t k = 0; k < 3; ++k)
            p[k] = s->images + 2 * (size_t)s->corners[3 * (c / 3) + k];
        ck_assert_int_gt(iccp_orient2d(p[0], p[1], p[2]), 0);
        if (corners.twin[c] == ICCP_NO_NEIGHBOUR)
            next[s->corners[iccp_after(c)]] = s->corners[iccp_before(c)];
    }
    ck_assert_int_eq(iccp_outlines_create(&outlines, s->n_points, next, &env.memory), ICC_OK);
    ck_assert_int_eq(iccp_outlines_check(&outlines, s->images, &env, NULL), ICC_OK);
    iccp_outlines_free(&outlines);
    free(corners.twin);
    free(next);
}

static iccp_elastic_report run(const scene *s)
{
    const iccp_env env = default_env();
    iccp_elastic_report report;
    ck_assert_int_eq(solve(s, &report, &env, NULL), ICC_OK);
    check_valid(s);
    size_t n_off = 0;
    double most = 0;
    for (size_t v = 0; v < s->n_points; ++v) {
        const double *x = s->images + 2 * v, *q = s->targets + 2 * v;
        if (s->hold[v] == ICCP_HELD && (x[0] != q[0] || x[1] != q[1])) {
            ++n_off;
            most = fmax(most, hypot(x[0] - q[0], x[1] - q[1]));
        }
    }
    ck_assert_uint_eq(report.n_off, n_off);
    ck_assert_double_eq_tol(report.most_off, most, 1e-15);
    return report;
}

/* ---- puppets ---- */

/* A wavy bar of length 1 and width 0.1, and three pins. */
enum { BAR = 41 };

static void make_bar(double *outline, double *pins)
{
    for (size_t k = 0; k < BAR; ++k) {
        const double x = (double)k / (BAR - 1), y = 0.06 * sin(6 * x), slope = 0.36 * cos(6 * x);
        const double nx = -slope / hypot(1, slope), ny = 1 / hypot(1, slope);
        const size_t back = 2 * BAR - 1 - k;
        outline[2 * k] = x - 0.05 * nx;
        outline[2 * k + 1] = y - 0.05 * ny;
        outline[2 * back] = x + 0.05 * nx;
        outline[2 * back + 1] = y + 0.05 * ny;
    }
    for (size_t k = 0; k < 3; ++k) {
        const double x = k == 0 ? 0.05 : k == 1 ? 0.5 : 0.95;
        pins[2 * k] = x;
        pins[2 * k + 1] = 0.06 * sin(6 * x);
    }
}

START_TEST(a_bar_bends_to_a_u)
{
    double outline[4 * BAR], pins[6];
    size_t pin;
    make_bar(outline, pins);
    for (int contact = 0; contact < 2; ++contact) {
        scene s = make_puppet(2 * BAR, outline, 3, pins, &pin);
        s.contact = contact == 1;
        hold(&s, pin, 0.3, 0);
        hold(&s, pin + 1, 0.5, 0.4);
        hold(&s, pin + 2, 0.7, 0);
        const iccp_elastic_report report = run(&s);
        ck_assert_uint_eq(report.n_off, 0);
        ck_assert_double_le(report.energy, 4.1);
        clear_scene(&s);
    }
}
END_TEST

enum { STAR = 80 };

START_TEST(a_star_moves_its_tips)
{
    double outline[2 * STAR], pins[12] = {0};
    size_t pin;
    for (size_t k = 0; k < STAR; ++k) {
        const double angle = TURN * (double)k / STAR, r = (2 + 1.1 * cos(5 * angle)) / 4;
        outline[2 * k] = r * cos(angle);
        outline[2 * k + 1] = r * sin(angle);
    }
    for (size_t k = 0; k < 5; ++k) {
        pins[2 * k + 2] = 0.65 * cos(TURN * (double)k / 5);
        pins[2 * k + 3] = 0.65 * sin(TURN * (double)k / 5);
    }
    const scene s = make_puppet(STAR, outline, 6, pins, &pin);
    hold(&s, pin + 1, 0.65 * cos(0.5), 0.65 * sin(0.5));
    hold(&s, pin + 3, 0.65 * cos(0.4 * TURN - 0.6), 0.65 * sin(0.4 * TURN - 0.6));
    const iccp_elastic_report report = run(&s);
    ck_assert_uint_eq(report.n_off, 0);
    ck_assert_double_le(report.energy, 4.06);
    clear_scene(&s);
}
END_TEST

START_TEST(nothing_told_changes_nothing)
{
    double outline[4 * BAR], pins[6];
    size_t pin;
    make_bar(outline, pins);
    scene s = make_puppet(2 * BAR, outline, 3, pins, &pin);
    s.contact = true;
    const iccp_elastic_report report = run(&s);
    ck_assert_double_eq_tol(report.energy, 4, 1e-12);
    for (size_t i = 0; i < 2 * s.n_points; ++i)
        ck_assert_double_eq_tol(s.images[i], s.points[i], 1e-12);
    clear_scene(&s);
}
END_TEST

/* Pins that all turn carry the figure along, without distorting it. One pin shifts it. */
START_TEST(figures_move_rigidly)
{
    double outline[4 * BAR], pins[6];
    size_t pin;
    make_bar(outline, pins);
    for (size_t n = 1; n <= 3; ++n)
        for (int k = 1; k <= 8; ++k) {
            scene s = make_puppet(2 * BAR, outline, n, pins, &pin);
            const double c = cos(TURN * k / 8), z = sin(TURN * k / 8);
            s.contact = true;
            for (size_t i = 0; i < n; ++i) {
                const double x = pins[2 * i], y = pins[2 * i + 1];
                hold(&s, pin + i, c * x - z * y + 0.3, z * x + c * y - 0.2);
            }
            const iccp_elastic_report report = run(&s);
            ck_assert_uint_eq(report.n_off, 0);
            ck_assert_double_eq_tol(report.energy, 4, 1e-6);
            clear_scene(&s);
        }
}
END_TEST

/* A trunk with an arm beside it: a U turned on its side. */
static scene make_arm(size_t *pin)
{
    static const double corner[][2] = {{0, 0},      {0.4, 0},   {0.4, 0.5}, {0.48, 0.5},
                                       {0.48, 0.1}, {0.6, 0.1}, {0.6, 0.6}, {0, 0.6}};
    enum { CORNERS = 8, PIECES = 12 };
    static const double pins[] = {0.2, 0.2, 0.2, 0.5, 0.54, 0.15};
    double outline[2 * CORNERS * PIECES];
    for (size_t k = 0; k < CORNERS * PIECES; ++k) {
        const double t = (double)(k % PIECES) / PIECES;
        const double *a = corner[k / PIECES], *b = corner[(k / PIECES + 1) % CORNERS];
        for (size_t d = 0; d < 2; ++d)
            outline[2 * k + d] = (1 - t) * a[d] + t * b[d];
    }
    scene s = make_puppet(CORNERS * PIECES, outline, 3, pins, pin);
    s.contact = true;
    return s;
}

START_TEST(an_arm_is_pushed_against_the_trunk)
{
    size_t pin;
    scene s = make_arm(&pin);
    /* the gap is 0.08 wide: the arm touches the trunk, and dents it a little */
    hold(&s, pin + 2, 0.44, 0.15);
    ck_assert_uint_eq(run(&s).n_off, 0);
    /* onto a pin of the trunk: that cannot be */
    reset(&s);
    hold(&s, pin + 2, 0.2, 0.2);
    const iccp_elastic_report report = run(&s);
    ck_assert_uint_ge(report.n_off, 1);
    ck_assert_double_gt(report.most_off, 0.01);
    /* without contact the result is refused, and the images stay */
    reset(&s);
    s.contact = false;
    const iccp_env env = default_env();
    iccp_elastic_report ignored;
    icc_error err = {.size = sizeof err};
    hold(&s, pin + 2, 0.25, 0.15);
    ck_assert_int_eq(solve(&s, &ignored, &env, &err), ICC_ERR_CERTIFICATE);
    ck_assert_mem_eq(s.images, s.points, 2 * s.n_points * sizeof *s.points);
    clear_scene(&s);
}
END_TEST

/* Frame after frame from the one before: the same as each frame says, exactly at the pins. */
START_TEST(a_hand_is_dragged)
{
    const iccp_env env = default_env();
    size_t pin;
    const scene s = make_arm(&pin);
    const iccp_elastic_input input = {.n_points = s.n_points,
                                      .n_triangles = s.n_triangles,
                                      .points = s.points,
                                      .corners = s.corners,
                                      .hold = s.hold,
                                      .direction = s.direction,
                                      .contact = true};
    iccp_elastic *elastic;
    ck_assert_int_eq(iccp_elastic_create(&elastic, &input, &env), ICC_OK);
    for (int k = 1; k <= 20; ++k) {
        iccp_elastic_report report;
        const double angle = TURN * k / 20;
        hold(&s, pin + 2, 0.54 + 0.1 * sin(angle), 0.15 + 0.1 * (1 - cos(angle)));
        ck_assert_int_eq(iccp_elastic_solve(elastic, s.targets, s.images, &report, &env, NULL),
                         ICC_OK);
        ck_assert_uint_eq(report.n_off, 0);
        check_valid(&s);
    }
    for (size_t i = 0; i < 2 * s.n_points; ++i)
        ck_assert_double_eq_tol(s.images[i], s.points[i], 0.01);
    iccp_elastic_free(elastic);
    clear_scene(&s);
}
END_TEST

/* Figures with several limbs, and a pin in each. Some pins go elsewhere, often farther than they
 * can. */
START_TEST(figures_are_posed)
{
    enum { FIGURES = 20, POSES = 10, SIDES = 120, LEAST_LIMBS = 3, MOST_LIMBS = 6 };
    random_source state = {11};
    size_t n_reached = 0, n_poses = 0;
    for (int f = 0; f < share_of(FIGURES); ++f) {
        double outline[2 * SIDES], pins[2 * (MOST_LIMBS + 1)] = {0};
        const size_t n = LEAST_LIMBS + (size_t)(random_unit(&state) * (MOST_LIMBS - 2));
        const double depth = 0.5 + 0.3 * random_unit(&state), twist = random_unit(&state) - 0.5;
        size_t pin;
        for (size_t k = 0; k < SIDES; ++k) {
            const double t = (double)k / SIDES, r = 0.5 + 0.5 * depth * cos(TURN * (double)n * t);
            outline[2 * k] = r * cos(TURN * t + twist * r);
            outline[2 * k + 1] = r * sin(TURN * t + twist * r);
        }
        for (size_t k = 0; k < n; ++k) {
            const double r = 0.5 + 0.4 * depth, angle = TURN * (double)k / (double)n + twist * r;
            pins[2 * k + 2] = r * cos(angle);
            pins[2 * k + 3] = r * sin(angle);
        }
        scene s = make_puppet(SIDES, outline, n + 1, pins, &pin);
        s.contact = true;
        for (int q = 0; q < POSES; ++q) {
            reset(&s);
            for (size_t k = 0; k <= n; ++k) {
                const double far = k > 0 && random_unit(&state) < 0.5 ? 0.6 : 0;
                hold(&s, pin + k, pins[2 * k] + far * (random_unit(&state) - 0.5),
                     pins[2 * k + 1] + far * (random_unit(&state) - 0.5));
            }
            const iccp_elastic_report report = run(&s);
            n_reached += report.n_off == 0;
            ++n_poses;
        }
        clear_scene(&s);
    }
    ck_assert_uint_ge(10 * n_reached, 9 * n_poses);
}
END_TEST

/* A pin is dragged onto another one and back: off in between, and not in the end. */
START_TEST(a_drag_goes_through_the_trunk)
{
    const iccp_env env = default_env();
    size_t pin, n_off = 0;
    const scene s = make_arm(&pin);
    const iccp_elastic_input input = {.n_points = s.n_points,
                                      .n_triangles = s.n_triangles,
                                      .points = s.points,
                                      .corners = s.corners,
                                      .hold = s.hold,
                                      .direction = s.direction,
                                      .contact = true};
    uint8_t *off = calloc(s.n_points, 1);
    iccp_elastic *elastic;
    iccp_elastic_report report;
    ck_assert_int_eq(iccp_elastic_create(&elastic, &input, &env), ICC_OK);
    for (int k = 1; k <= 20; ++k) {
        const double share = 1 - fabs(k - 10.0) / 10;
        hold(&s, pin + 2, 0.54 - 0.34 * share, 0.15 + 0.05 * share);
        ck_assert_int_eq(iccp_elastic_drag(elastic, s.targets, s.images, off, &report, &env, NULL),
                         ICC_OK);
        check_valid(&s);
        for (size_t v = 0; v < s.n_points; ++v)
            if (s.hold[v] == ICCP_HELD && !off[v])
                ck_assert_mem_eq(s.images + 2 * v, s.targets + 2 * v, 2 * sizeof *s.images);
        n_off += report.n_off;
    }
    ck_assert_uint_gt(n_off, 0);
    ck_assert_uint_eq(report.n_off, 0);
    iccp_elastic_free(elastic);
    clear_scene(&s);
    free(off);
}
END_TEST

/* ---- moving meshes ---- */

START_TEST(sides_slide)
{
    enum { COLUMNS = 24, ROWS = 16 };
    const scene s = make_box(COLUMNS, ROWS, 0.9, 0.6);
    for (size_t v = 0; v < s.n_points; ++v) {
        const size_t i = v / (ROWS + 1), j = v % (ROWS + 1);
        const double x = s.points[2 * v], y = s.points[2 * v + 1];
        if (j == 0)
            hold(&s, v, x, y);
        else if (j == ROWS)
            hold(&s, v, x, y - 0.3 + 0.2 * sin(8 * x));
        else if (i == 0 || i == COLUMNS) {
            s.hold[v] = ICCP_SLIDING;
            s.direction[2 * v + 1] = 3;
        }
    }
    const iccp_elastic_report report = run(&s);
    ck_assert_uint_eq(report.n_off, 0);
    size_t n_moved = 0;
    for (size_t v = 0; v < s.n_points; ++v)
        if (s.hold[v] == ICCP_SLIDING) {
            ck_assert_double_eq(s.images[2 * v], s.points[2 * v]);
            n_moved += fabs(s.images[2 * v + 1] - s.points[2 * v + 1]) > 0.01;
        }
    ck_assert_uint_gt(n_moved, ROWS);
    clear_scene(&s);
}
END_TEST

/* Sides slide along slanted lines that they have to reach first. */
START_TEST(lines_are_reached)
{
    enum { COLUMNS = 8, ROWS = 8 };
    const scene s = make_box(COLUMNS, ROWS, 0.8, 0.8);
    for (size_t v = 0; v < s.n_points; ++v) {
        const size_t i = v / (ROWS + 1), j = v % (ROWS + 1);
        if (i == 0)
            hold(&s, v, s.points[2 * v], s.points[2 * v + 1]);
        else if (i == COLUMNS) {
            s.hold[v] = ICCP_SLIDING;
            s.direction[2 * v] = 0.3;
            s.direction[2 * v + 1] = 1;
            s.targets[2 * v] = 0.9 + 0.3 * (double)j;
            s.targets[2 * v + 1] = (double)j;
        }
    }
    ck_assert_uint_eq(run(&s).n_off, 0);
    for (size_t v = 0; v < s.n_points; ++v)
        if (s.hold[v] == ICCP_SLIDING)
            ck_assert_double_eq_tol(s.images[2 * v] - 0.3 * s.images[2 * v + 1], 0.9, 1e-15);
    clear_scene(&s);
}
END_TEST

/* The first cells keep their heights, and their sides keep their angle with the wall. */
static void check_layers(const layers *l, double turns)
{
    scene s = make_layers(l);
    const double c = cos(TURN * turns), z = sin(TURN * turns);
    s.stiffness = 1.5;
    turn_wall(&s, l, turns);
    ck_assert_uint_eq(run(&s).n_off, 0);
    for (size_t v = 0; v < s.n_points; v += l->n + 1) {
        const double *p = s.points + 2 * v, *x = s.images + 2 * v;
        const double u[2] = {p[2] - p[0], p[3] - p[1]}, w[2] = {x[2] - x[0], x[3] - x[1]};
        const double turned[2] = {c * u[0] - z * u[1], z * u[0] + c * u[1]};
        ck_assert_double_eq_tol(hypot(w[0], w[1]) / hypot(u[0], u[1]), 1, 0.05);
        ck_assert_double_le(fabs(turned[0] * w[1] - turned[1] * w[0]),
                            0.06 * hypot(u[0], u[1]) * hypot(w[0], w[1]));
    }
    clear_scene(&s);
}

START_TEST(layers_turn_with_their_wall)
{
    check_layers(&ellipse, 80 / 360.0);
    check_layers(&ellipse, -165 / 360.0);
    check_layers(&airfoil, -45 / 360.0);
    check_layers(&airfoil, 90 / 360.0);
    check_layers(&airfoil, -170 / 360.0);
}
END_TEST

/* Two walls that would have to go through each other. */
START_TEST(walls_that_cross_stay_off)
{
    enum { COLUMNS = 16, ROWS = 8 };
    scene s = make_box(COLUMNS, ROWS, 0.8, 0.4);
    s.contact = true;
    for (size_t v = 0; v < s.n_points; ++v) {
        const size_t j = v % (ROWS + 1);
        if (j == 0)
            hold(&s, v, s.points[2 * v], s.points[2 * v + 1]);
        else if (j == ROWS)
            hold(&s, v, s.points[2 * v], -0.2);
    }
    const iccp_elastic_report report = run(&s);
    ck_assert_uint_ge(report.n_off, COLUMNS + 1);
    ck_assert_double_ge(report.most_off, 0.2);
    clear_scene(&s);
}
END_TEST

/* ---- stiffness ---- */

START_TEST(stiff_triangles_stay_as_they_are)
{
    enum { COLUMNS = 20, ROWS = 4 };
    const iccp_env env = default_env();
    const scene s = make_box(COLUMNS, ROWS, 0.8, 0.16);
    double factor[2 * COLUMNS * ROWS];
    for (size_t t = 0; t < s.n_triangles; ++t)
        factor[t] = t < s.n_triangles / 2 ? 1 : 1000;
    for (size_t v = 0; v < s.n_points; ++v)
        if (v / (ROWS + 1) == 0 || v / (ROWS + 1) == COLUMNS)
            hold(&s, v, s.points[2 * v] * 1.2, s.points[2 * v + 1]);
    const iccp_elastic_input input = {.n_points = s.n_points,
                                      .n_triangles = s.n_triangles,
                                      .points = s.points,
                                      .corners = s.corners,
                                      .hold = s.hold,
                                      .direction = s.direction,
                                      .cell_factor = factor};
    iccp_elastic *elastic;
    iccp_elastic_report report;
    ck_assert_int_eq(iccp_elastic_create(&elastic, &input, &env), ICC_OK);
    ck_assert_int_eq(iccp_elastic_solve(elastic, s.targets, s.images, &report, &env, NULL), ICC_OK);
    const size_t middle = (size_t)COLUMNS / 2 * (ROWS + 1) + ROWS / 2;
    const size_t end = (size_t)COLUMNS * (ROWS + 1) + ROWS / 2;
    ck_assert_double_eq_tol(s.images[2 * end] - s.images[2 * middle], 0.4, 0.002);
    iccp_elastic_free(elastic);
    clear_scene(&s);
}
END_TEST

/* ---- reach ---- */

/* The largest ratio of the singular values of a triangle's map. */
static double most_aspect(const scene *s)
{
    double most = 1;
    for (size_t t = 0; t < s->n_triangles; ++t) {
        double u[2][2][2]; /* before and after, edge, coordinate */
        for (size_t side = 0; side < 2; ++side)
            for (size_t k = 0; k < 2; ++k)
                for (size_t d = 0; d < 2; ++d) {
                    const double *x = side == 0 ? s->points : s->images;
                    u[side][k][d] = x[2 * (size_t)s->corners[3 * t + 1 + k] + d] -
                                    x[2 * (size_t)s->corners[3 * t] + d];
                }
        const double before = u[0][0][0] * u[0][1][1] - u[0][0][1] * u[0][1][0];
        const double after = u[1][0][0] * u[1][1][1] - u[1][0][1] * u[1][1][0];
        double norm2 = 0;
        for (size_t d = 0; d < 2; ++d) {
            const double x = (u[1][0][d] * u[0][1][1] - u[1][1][d] * u[0][0][1]) / before;
            const double y = (u[1][1][d] * u[0][0][0] - u[1][0][d] * u[0][1][0]) / before;
            norm2 += x * x + y * y;
        }
        const double half = norm2 / (2 * after / before);
        most = fmax(most, half + sqrt(fmax(half * half - 1, 0)));
    }
    return most;
}

/* Pulls the middle of a square away from four other points, which are held. */
static double pull_middle(uint32_t cells, double reach)
{
    scene s = make_box(cells, cells, 0.8, 0.8);
    s.contact = true;
    s.reach = reach;
    for (size_t v = 0; v < s.n_points; ++v) {
        const size_t i = v / (cells + 1), j = v % (cells + 1);
        if ((8 * i == cells || 8 * i == 7 * cells) && (8 * j == cells || 8 * j == 7 * cells))
            hold(&s, v, s.points[2 * v], s.points[2 * v + 1]);
        if (2 * i == cells && 2 * j == cells)
            hold(&s, v, s.points[2 * v] + 0.12, s.points[2 * v + 1]);
    }
    ck_assert_uint_eq(run(&s).n_off, 0);
    const double aspect = most_aspect(&s);
    clear_scene(&s);
    return aspect;
}

START_TEST(reach_ends_spikes)
{
    const double coarse = pull_middle(16, 0), fine = pull_middle(64, 0);
    ck_assert_double_gt(fine, 1.5 * coarse);
    const double smooth = pull_middle(16, 0.1), smoother = pull_middle(64, 0.1);
    ck_assert_double_le(smoother, 2.3);
    ck_assert_double_eq_tol(smoother / smooth, 1, 0.1);
    ck_assert_double_le(pull_middle(32, 0.5), 1.8);
}
END_TEST

/* Affine maps do not bend. Where a side slides, only a large reach makes the map affine. */
START_TEST(reach_leaves_affine_maps)
{
    enum { COLUMNS = 9, ROWS = 6 };
    for (int k = 0; k < 2; ++k) {
        scene s = make_box(COLUMNS, ROWS, 0.9, 0.6);
        s.reach = k == 0 ? 0.05 : 100;
        for (size_t v = 0; v < s.n_points; ++v) {
            const size_t i = v / (ROWS + 1), j = v % (ROWS + 1);
            const double x = s.points[2 * v], y = s.points[2 * v + 1];
            if (i == 0 || i == COLUMNS || j == 0 || (k == 0 && j == ROWS))
                hold(&s, v, 0.1 + 0.9 * x + 0.2 * y, 0.1 * x + 1.1 * y);
            else if (j == ROWS) {
                s.hold[v] = ICCP_SLIDING;
                s.direction[2 * v] = 0.9;
                s.direction[2 * v + 1] = 0.1;
                s.targets[2 * v] = 0.1 + 0.2 * y;
                s.targets[2 * v + 1] = 1.1 * y;
            }
        }
        ck_assert_uint_eq(run(&s).n_off, 0);
        for (size_t v = 0; v < s.n_points; ++v) {
            const double x = s.points[2 * v], y = s.points[2 * v + 1];
            ck_assert_double_eq_tol(s.images[2 * v], 0.1 + 0.9 * x + 0.2 * y, 1e-4);
            ck_assert_double_eq_tol(s.images[2 * v + 1], 0.1 * x + 1.1 * y, 1e-4);
        }
        clear_scene(&s);
    }
}
END_TEST

/* ---- environments ---- */

START_TEST(threads_change_no_bit)
{
    size_t pin;
    scene arm = make_arm(&pin), wall = make_layers(&ellipse), smooth = make_arm(&pin);
    scene *all[3] = {&arm, &wall, &smooth};
    hold(&arm, pin + 2, 0.42, 0.2);
    turn_wall(&wall, &ellipse, 0.1);
    hold(&smooth, pin + 2, 0.42, 0.2);
    smooth.reach = 0.02;
    for (size_t k = 0; k < 3; ++k) {
        iccp_elastic_report report;
        double *first = malloc(2 * all[k]->n_points * sizeof *first);
        for (int32_t threads = 1; threads <= 4; ++threads) {
            iccp_env env = default_env();
            env.threads = threads;
            reset(all[k]);
            ck_assert_int_eq(solve(all[k], &report, &env, NULL), ICC_OK);
            if (threads == 1)
                memcpy(first, all[k]->images, 2 * all[k]->n_points * sizeof *first);
            ck_assert_mem_eq(first, all[k]->images, 2 * all[k]->n_points * sizeof *first);
        }
        free(first);
        clear_scene(all[k]);
    }
}
END_TEST

static icc_status solve_once(const icc_env *env, icc_error *err, void *argument)
{
    const scene *s = argument;
    iccp_elastic_report report;
    iccp_env full;
    ck_assert_int_eq(iccp_env_read(&full, env, err), ICC_OK);
    reset(s);
    const icc_status status = solve(s, &report, &full, err);
    if (status != ICC_OK)
        ck_assert_mem_eq(s->images, s->points, 2 * s->n_points * sizeof *s->points);
    return status;
}

START_TEST(failures_leave_the_images)
{
    enum { COLUMNS = 6, ROWS = 2 };
    scene s = make_box(COLUMNS, ROWS, 0.6, 0.2);
    s.contact = true;
    hold(&s, 0, 0, 0.1);
    hold(&s, s.n_points - 1, 0.1, 0.6);
    faulty_sweep(solve_once, &s);
    s.reach = 0.1;
    faulty_sweep(solve_once, &s);
    clear_scene(&s);
}
END_TEST

static icc_status mesh_once(const icc_env *env, icc_error *err, void *argument)
{
    static const double pins[] = {0.3, 0.2, 0.7, 0.6, 0.7, 0.7};
    static const uint32_t segments[] = {5, 6}; /* after the corners */
    iccp_env full;
    iccp_pin_mesh mesh;
    ck_assert_int_eq(iccp_env_read(&full, env, err), ICC_OK);
    double *local = localise(argument, 3, pins);
    const iccp_pin_mesh_input input = {argument, 3, local, 1, segments, 0.2, 0};
    const icc_status status = iccp_pin_mesh_create(&mesh, &input, &full, err);
    iccp_pin_mesh_free(&mesh);
    free(local);
    return status;
}

START_TEST(meshes_fail_cleanly)
{
    static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
    faulty_sweep(mesh_once, domain);
    icc_domain_free(domain);
}
END_TEST

static double area_of(const iccp_pin_mesh *mesh)
{
    double area = 0;
    for (size_t t = 0; t < mesh->n_triangles; ++t) {
        const double *p[3];
        for (size_t c = 0; c < 3; ++c)
            p[c] = mesh->points + 2 * (size_t)mesh->triangles[3 * t + c];
        ck_assert_int_gt(iccp_orient2d(p[0], p[1], p[2]), 0);
        area += ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                 (p[1][1] - p[0][1]) * (p[2][0] - p[0][0])) /
                2;
    }
    return area;
}

/* Segments may form a ring. What is inside it belongs to the mesh. */
START_TEST(meshes_contain_rings)
{
    static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const double pins[] = {0.3, 0.3, 0.7, 0.3, 0.5, 0.7};
    static const uint32_t segments[] = {4, 5, 5, 6, 6, 4}; /* after the corners */
    const iccp_env env = default_env();
    icc_domain *domain;
    iccp_pin_mesh mesh;
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
    double *local = localise(domain, 3, pins);
    const iccp_pin_mesh_input input = {domain, 3, local, 3, segments, 0.1, 0};
    ck_assert_int_eq(iccp_pin_mesh_create(&mesh, &input, &env, NULL), ICC_OK);
    ck_assert_double_eq_tol(area_of(&mesh), pow(domain->frame.in[0] * domain->frame.in[1], 2),
                            1e-12);
    iccp_pin_mesh_free(&mesh);
    icc_domain_free(domain);
    free(local);
}
END_TEST

/* A square with a hole, either way round, a segment and a pin close to the outline. */
START_TEST(meshes_contain_what_is_told)
{
    static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    static const double square_back[] = {0, 0, 0, 1, 1, 1, 1, 0};
    static const double hole[] = {0.3, 0.3, 0.6, 0.3, 0.6, 0.6, 0.3, 0.6};
    static const double pins[] = {0.1, 0.8, 0.9, 0.85, 0.99, 0.5};
    static const uint32_t segments[] = {8, 9}; /* after both rings */
    const iccp_env env = default_env();
    for (int k = 0; k < 2; ++k) {
        icc_feature feature = {
            .size = sizeof feature, .kind = ICC_FEATURE_HOLE, .n_vertices = 4, .vertices = hole};
        icc_domain *domain;
        iccp_pin_mesh mesh;
        ck_assert_int_eq(icc_domain_create_features(&domain, 4, k == 0 ? square : square_back, 1,
                                                    &feature, NULL, NULL),
                         ICC_OK);
        double *local = localise(domain, 3, pins);
        const double scale = domain->frame.in[0] * domain->frame.in[1];
        const iccp_pin_mesh_input input = {domain, 3, local, 1, segments, 0.05 * scale, 0};
        ck_assert_int_eq(iccp_pin_mesh_create(&mesh, &input, &env, NULL), ICC_OK);
        ck_assert_double_eq_tol(area_of(&mesh), 0.91 * scale * scale, 1e-12);
        ck_assert_uint_eq(mesh.n_told, 11);
        ck_assert_mem_eq(mesh.points + 16, local, sizeof pins);
        size_t n_sides = 0, n_segment = 0;
        for (size_t v = 0; v < mesh.n_points - mesh.n_told; ++v) {
            const uint32_t *ends = mesh.ends + 2 * v;
            if (ends[0] == UINT32_MAX)
                continue;
            n_segment += ends[0] >= 8;
            n_sides += ends[0] < 8;
            for (size_t d = 0; d < 2; ++d)
                ck_assert_double_eq_tol(mesh.points[2 * (mesh.n_told + v) + d],
                                        (1 - mesh.share[v]) * mesh.points[2 * ends[0] + d] +
                                            mesh.share[v] * mesh.points[2 * ends[1] + d],
                                        1e-15);
        }
        ck_assert_uint_ge(n_sides, 3 * 19 + 4 * 5);
        ck_assert_uint_ge(n_segment, 15);
        iccp_pin_mesh_free(&mesh);
        icc_domain_free(domain);
        free(local);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("elastic model");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, a_bar_bends_to_a_u);
    tcase_add_test(tests, a_star_moves_its_tips);
    tcase_add_test(tests, nothing_told_changes_nothing);
    tcase_add_test(tests, figures_move_rigidly);
    tcase_add_test(tests, an_arm_is_pushed_against_the_trunk);
    tcase_add_test(tests, a_hand_is_dragged);
    tcase_add_test(tests, figures_are_posed);
    tcase_add_test(tests, a_drag_goes_through_the_trunk);
    tcase_add_test(tests, sides_slide);
    tcase_add_test(tests, lines_are_reached);
    tcase_add_test(tests, layers_turn_with_their_wall);
    tcase_add_test(tests, walls_that_cross_stay_off);
    tcase_add_test(tests, stiff_triangles_stay_as_they_are);
    tcase_add_test(tests, reach_ends_spikes);
    tcase_add_test(tests, reach_leaves_affine_maps);
    tcase_add_test(tests, threads_change_no_bit);
    tcase_add_test(tests, failures_leave_the_images);
    tcase_add_test(tests, meshes_fail_cleanly);
    tcase_add_test(tests, meshes_contain_rings);
    tcase_add_test(tests, meshes_contain_what_is_told);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
