/* Triangles that change: what is allowed makes none of them meet, looked at pair by pair. */
#include "../../../hard_bodies.h"
#include "../../../suite.h"
#include "base/env.h"
#include "match/common_mesh/clearance.h"
#include "match/common_mesh/intersections.h"

#include <check.h>
#include <stdlib.h>

enum { SIDE = 9, STEPS = 3000, MOST = 64 };

static surface shape;
static uint32_t faces[3 * SURFACE_FACES];

/* A change: the triangles round a vertex, which has moved, or without those at the end of an edge
 * that takes its place. */
typedef struct change {
    size_t n_old, n;
    uint32_t old[MOST], number[MOST], corner[MOST][3];
} change;

static change change_of(const iccp_half_edges *m, uint32_t v, uint32_t to)
{
    change c = {0};
    uint32_t h = m->out[v];
    for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h)) {
        const uint32_t a = iccp_edge_end(m, h), b = m->origin[iccp_before(h)];
        c.old[c.n_old++] = h / 3;
        if (a == to || b == to)
            continue;
        c.number[c.n] = h / 3;
        c.corner[c.n][0] = to;
        c.corner[c.n][1] = a;
        c.corner[c.n++][2] = b;
    }
    return c;
}

/* Whether anything meets after a change. */
static bool would_meet(const iccp_half_edges *m, double *x, const change *c)
{
    const iccp_memory memory = iccp_memory_default;
    static uint8_t is_bad[SURFACE_VERTICES];
    iccp_common_surface all = {.n_vertices = m->n_vertices, .faces = faces, .x = {x, x}};
    bool any = false;
    for (uint32_t f = 0; f < m->n_faces; ++f) {
        const uint32_t *const v = m->origin + 3 * (size_t)f;
        bool stays = m->degree[v[0]] > 0 && m->degree[v[1]] > 0 && m->degree[v[2]] > 0;
        for (size_t k = 0; k < c->n_old; ++k)
            stays = stays && c->old[k] != f;
        if (stays)
            memcpy(faces + 3 * all.n_faces++, v, 3 * sizeof *v);
    }
    memcpy(faces + 3 * all.n_faces, c->corner, c->n * sizeof *c->corner);
    all.n_faces += c->n;
    ck_assert(iccp_intersections_mark(is_bad, &any, &all, &memory));
    return any;
}

START_TEST(no_more_and_no_less_is_allowed)
{
    const iccp_env env = {.memory = iccp_memory_default};
    random_source r = {7};
    iccp_half_edges m;
    iccp_clearance clearance;
    double *const x = shape.vertices;
    size_t n_moved[2] = {0, 0}, n_collapsed[2] = {0, 0};
    /* Two sheets with little room between them. */
    shape.n_vertices = 0;
    for (int k = 0; k < 2 * SIDE * SIDE; ++k)
        surface_point(&shape, k / SIDE % SIDE, k % SIDE,
                      k / (SIDE * SIDE) + random_between(&r, -.3, .3));
    surface_plate_faces(&shape, SIDE);
    ck_assert_int_eq(
        iccp_half_edges_create(&m, shape.n_vertices, shape.n_faces, shape.faces, &env, NULL),
        ICC_OK);
    ck_assert(iccp_clearance_create(&clearance, &m, x, &env.memory));
    for (int step = 0; step < STEPS; ++step) {
        const uint32_t v = (uint32_t)random_below(&r, (int)m.n_vertices);
        if (m.degree[v] == 0)
            continue;
        double *const p = x + 3 * (size_t)v, before[3] = {p[0], p[1], p[2]};
        uint32_t h = m.out[v];
        for (int k = random_below(&r, (int)m.degree[v]); k > 0; --k)
            h = iccp_edge_turn(&m, h);
        const bool moves = step % 8 != 0;
        if (!moves && (!iccp_edge_collapsible(&m, h) || m.n_left < SIDE * SIDE))
            continue;
        for (int k = 0; k < 3 && moves; ++k)
            p[k] += (step % 3 == 0 ? 4 : 1) * random_between(&r, -.7, .7);
        const change c = change_of(&m, v, moves ? v : iccp_edge_end(&m, h));
        const bool meets = would_meet(&m, x, &c);
        ck_assert_int_eq(
            iccp_clearance_allows(&clearance, c.n_old, c.old, c.n, (const uint32_t(*)[3])c.corner),
            !meets);
        ++(moves ? n_moved : n_collapsed)[meets];
        if (meets) {
            memcpy(p, before, sizeof before);
            continue;
        }
        iccp_clearance_replace(&clearance, c.n, c.number, (const uint32_t(*)[3])c.corner);
        if (!moves)
            iccp_edge_collapse(&m, h);
    }
    for (int k = 0; k < 2; ++k) {
        ck_assert_uint_ge(n_moved[k], 100);
        ck_assert_uint_ge(n_collapsed[k], 10);
    }
    iccp_clearance_free(&clearance, &env.memory);
    iccp_half_edges_free(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("clearance");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, no_more_and_no_less_is_allowed);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
