/* The network of a domain against brute force, and what is said of two that differ. */
#include "features.h"

#include "domain/network.h"
#include "domain/network_same.h"

#include "../../share.h"
#include "../../suite.h"

#include <math.h>
#include <string.h>

/* A domain, and its vertices on the grid. */
typedef struct plan {
    icc_domain *domain;
    const iccp_network *net;
    spot at[MAX_CHAIN * (MAX_FEATURES + 1)];
    uint32_t n, n_facets;
} plan;

static icc_status begin_plan(plan *p, const picture *drawn, icc_error *err)
{
    request q;
    request_picture(&q, drawn, 1, 0, 0);
    *p = (plan){.n = 0};
    const icc_status status = create(&p->domain, &q, NULL, err);
    for (int i = 0; i <= drawn->n; ++i)
        for (int k = 0; k < drawn->chains[i].n; ++k)
            p->at[p->n++] = drawn->chains[i].at[k];
    if (status == ICC_OK) {
        p->net = p->domain->features->network;
        p->n_facets = (uint32_t)p->domain->features->n_places;
    }
    return status;
}

/* The end that a half-side leaves. */
static spot from(const plan *p, uint32_t h)
{
    return p->at[p->domain->facets[h]];
}

static bool is_side(const plan *p, uint32_t f)
{
    return p->net->side[f] == f && !same(from(p, 2 * f), from(p, 2 * f + 1));
}

/* ---- nodes and sides ---- */

static uint32_t slow_node(const plan *p, uint32_t v)
{
    uint32_t u = 0;
    while (!same(p->at[u], p->at[v]))
        ++u;
    return u;
}

static uint32_t slow_side(const plan *p, uint32_t f)
{
    const spot a = from(p, 2 * f), b = from(p, 2 * f + 1);
    for (uint32_t g = 0;; ++g) {
        const spot c = from(p, 2 * g), d = from(p, 2 * g + 1);
        if ((same(a, c) && same(b, d)) || (same(a, d) && same(b, c)))
            return g;
    }
}

/* From -pi / 2, which is excluded, to 3 pi / 2. */
static double direction(spot a, spot b)
{
    const double angle = atan2((double)(b.y - a.y), (double)(b.x - a.x));
    return angle > -1.5707 ? angle : angle + 6.283185307179586;
}

static void check_node(const plan *p, uint32_t v)
{
    const iccp_network *net = p->net;
    const uint32_t node = slow_node(p, v);
    uint32_t degree = 0;
    ck_assert_uint_eq(net->node[v], node);
    for (uint32_t h = 0; h < 2 * p->n_facets; ++h)
        degree += node == v && is_side(p, h / 2) && same(from(p, h), p->at[v]);
    ck_assert_uint_eq(iccp_network_degree(net, v), degree);
    for (uint32_t i = net->first[v]; i < net->first[v + 1]; ++i) {
        const uint32_t h = net->leaving[i];
        ck_assert(is_side(p, h / 2) && same(from(p, h), p->at[v]) && net->slot[h] == i);
        ck_assert(i == net->first[v] || direction(p->at[v], from(p, net->leaving[i - 1] ^ 1)) <
                                            direction(p->at[v], from(p, h ^ 1)));
    }
    ck_assert(same(from(p, net->place[v]), p->at[v]));
    ck_assert(iccp_network_degree(net, node) == 0 || is_side(p, net->place[v] / 2));
}

static void check_nodes(const plan *p)
{
    size_t n_nodes = 0, n_sides = 0, n_junctions = 0;
    for (uint32_t v = 0; v < p->n; ++v) {
        check_node(p, v);
        n_nodes += slow_node(p, v) == v;
        n_junctions += iccp_network_degree(p->net, v) > 2;
    }
    for (uint32_t f = 0; f < p->n_facets; ++f) {
        uint32_t side = 0;
        ck_assert_uint_eq(p->net->side[f], slow_side(p, f));
        n_sides += is_side(p, f);
        const uint32_t a = slow_node(p, p->domain->facets[2 * f]),
                       b = slow_node(p, p->domain->facets[2 * f + 1]);
        ck_assert(iccp_network_side(p->net, p->domain, a, b, &side) == (a != b));
        ck_assert(a == b || side == p->net->side[f]);
    }
    ck_assert_uint_eq(p->net->n_nodes, n_nodes);
    ck_assert_uint_eq(p->net->n_sides, n_sides);
    ck_assert_uint_eq(p->net->n_junctions, n_junctions);
}

/* ---- faces ---- */

static uint32_t leader(uint32_t *set, uint32_t i)
{
    while (set[i] != i)
        i = set[i] = set[set[i]];
    return i;
}

/* How high a side is at x, and how it rises there: both times its extent along x. */
typedef struct height {
    int64_t y, rise, run;
} height;

static height height_at(spot a, spot b, int64_t x)
{
    const int64_t run = b.x - a.x;
    return (height){2 * a.y * run + (x - 2 * a.x) * (b.y - a.y), b.y - a.y, run};
}

/* Just right of x for `way` 1, just left of it for -1. */
static bool is_lower(height a, height b, int way)
{
    const int64_t y = a.y * b.run - b.y * a.run, rise = a.rise * b.run - b.rise * a.run;
    return y != 0 ? y < 0 : way * rise < 0;
}

/* The half-side just below a place, that has it on its left. Coordinates of the place are
 * doubled. */
static uint32_t slow_below(const plan *p, int64_t x, height at, int way)
{
    uint32_t best = UINT32_MAX;
    height highest = {0, 0, 0};
    for (uint32_t h = 0; h < 2 * p->n_facets; ++h) {
        const spot a = from(p, h), b = from(p, h ^ 1);
        if (!is_side(p, h / 2) || a.x >= b.x || x < 2 * a.x || x > 2 * b.x ||
            x == 2 * (way > 0 ? b.x : a.x))
            continue;
        const height own = height_at(a, b, x);
        if (is_lower(own, at, way) && (best == UINT32_MAX || is_lower(highest, own, way))) {
            best = h;
            highest = own;
        }
    }
    return best;
}

/* The number 2 n_facets stands for the outside of everything. A lone point's half-sides stand for
 * the face around it. */
static void join_faces(const plan *p, uint32_t *set)
{
    const uint32_t outside = 2 * p->n_facets;
    for (uint32_t h = 0; h <= outside; ++h)
        set[h] = h;
    for (uint32_t h = 0; h < outside; ++h) {
        const spot a = from(p, h), b = from(p, h ^ 1);
        uint32_t below = UINT32_MAX, own = h ^ 1;
        if (is_side(p, h / 2))
            set[leader(set, h)] = leader(set, iccp_network_next(p->net, p->domain, h));
        if (is_side(p, h / 2) && a.x < b.x) {
            below = slow_below(p, a.x + b.x, height_at(a, b, a.x + b.x), 1);
        } else if (a.x == b.x && p->net->side[h / 2] == h / 2) {
            /* A point; or the lower end of a vertical side, if nothing comes from the left or from
             * below */
            const uint32_t v = p->net->node[p->domain->facets[h]];
            bool first = a.y <= b.y && (a.y < b.y || iccp_network_degree(p->net, v) == 0);
            for (uint32_t i = p->net->first[v]; i < p->net->first[v + 1]; ++i) {
                const spot q = from(p, p->net->leaving[i] ^ 1);
                first &= q.x > a.x || (q.x == a.x && q.y > a.y);
            }
            if (!first)
                continue;
            own = h; /* upwards, with the left on its left */
            below = slow_below(p, 2 * a.x, (height){2 * a.y, 0, 1}, -1);
        } else {
            continue;
        }
        set[leader(set, own)] = leader(set, below == UINT32_MAX ? outside : below);
    }
}

static void check_faces(const plan *p, const picture *drawn)
{
    static uint32_t set[4 * MAX_CHAIN * (MAX_FEATURES + 1) + 1];
    static uint32_t face_of[4 * MAX_CHAIN * (MAX_FEATURES + 1) + 1];
    const iccp_network *net = p->net;
    size_t n_faces = 0, n_rim = 0;
    join_faces(p, set);
    memset(face_of, 0xFF, sizeof face_of);
    for (uint32_t h = 0; h < 2 * p->n_facets; ++h) {
        const bool lone = net->place[p->domain->facets[h]] / 2 == h / 2;
        if (!is_side(p, h / 2) && !lone)
            continue;
        const uint32_t root = leader(set, h), face = net->face[h];
        ck_assert((face != ICCP_NO_FACE) == (count_left(drawn, from(p, h), from(p, h ^ 1)) > 0));
        ck_assert((net->around[h] == ICCP_NO_WALK) == (root == leader(set, 2 * p->n_facets)));
        ck_assert(
            net->around[h] == ICCP_NO_WALK ||
            (leader(set, net->around[h]) == root && net->around[net->around[h]] == net->around[h]));
        if (face == ICCP_NO_FACE)
            continue;
        n_faces += face_of[root] == UINT32_MAX;
        ck_assert(face_of[root] == UINT32_MAX ? face == n_faces - 1 || !is_side(p, h / 2)
                                              : face_of[root] == face);
        face_of[root] = face;
    }
    for (uint32_t f = 0; f < p->n_facets; ++f)
        n_rim += iccp_network_is_rim(net, f);
    ck_assert_uint_eq(net->n_faces, n_faces);
    ck_assert_uint_eq(net->n_rim, n_rim);
}

static void check_pieces(const plan *p)
{
    uint32_t set[MAX_CHAIN * (MAX_FEATURES + 1)];
    size_t n = 0;
    for (uint32_t v = 0; v < p->n; ++v)
        set[v] = slow_node(p, v);
    for (uint32_t f = 0; f < p->n_facets; ++f) {
        const uint32_t a = leader(set, p->domain->facets[2 * f]),
                       b = leader(set, p->domain->facets[2 * f + 1]);
        set[a < b ? b : a] = a < b ? a : b;
    }
    for (uint32_t v = 0; v < p->n; ++v) {
        const bool is_new = leader(set, v) == v;
        ck_assert_uint_eq(p->net->piece[v], is_new ? n : p->net->piece[leader(set, v)]);
        n += is_new;
    }
    ck_assert_uint_eq(p->net->n_pieces, n);
}

/* ---- random networks ---- */

/* Chains over few spots, so that they share vertices and edges. */
static void random_network(picture *p, random_source *r)
{
    spot spots[10];
    const int n_spots = 4 + random_below(r, 7);
    for (int i = 0; i < n_spots; ++i)
        spots[i] = (spot){random_below(r, SIDE / 2 + 1) * 2, random_below(r, SIDE / 2 + 1) * 2};
    p->n = 1 + random_below(r, MAX_FEATURES);
    p->chains[0] = (chain){0, 4, {{0, 0}, {SIDE, 0}, {SIDE, SIDE}, {0, SIDE}}};
    for (int f = 1; f <= p->n; ++f) {
        static const int32_t kinds[] = {1, 2, 2, 2, 3, 4};
        const int32_t kind = kinds[random_below(r, 6)];
        chain c = {.kind = kind, .n = kind == 3 ? 1 : kind == 2 ? 2 + random_below(r, 3) : 3};
        for (int k = 0; k < c.n; ++k)
            c.at[k] = random_below(r, 8) == 0 ? p->chains[0].at[random_below(r, 4)]
                                              : spots[random_below(r, n_spots)];
        p->chains[f] = c;
    }
}

START_TEST(random_networks)
{
    static picture drawn;
    random_source r = {5};
    icc_error err;
    int n_sound = 0;
    const int n_rounds = share_of(200000);
    for (int round = 0; round < n_rounds; ++round) {
        plan p;
        random_network(&drawn, &r);
        const bool sound = is_sound(&drawn);
        ck_assert_msg((begin_plan(&p, &drawn, &err) == ICC_OK) == sound, "%s", err.message);
        if (sound) {
            check_nodes(&p);
            check_pieces(&p);
            check_faces(&p, &drawn);
            ck_assert_int_eq(iccp_network_same(p.domain, p.domain, NULL), ICC_OK);
            ++n_sound;
        }
        icc_domain_free(p.domain);
    }
    ck_assert_int_gt(n_sound, n_rounds / 20);
}
END_TEST

/* ---- two networks ---- */

#define FRAME                                                                                      \
    {                                                                                              \
        0, 6,                                                                                      \
        {                                                                                          \
            {0, 0}, {4, 0}, {8, 0}, {8, 8}, {4, 8},                                                \
            {                                                                                      \
                0, 8                                                                               \
            }                                                                                      \
        }                                                                                          \
    }
#define LINE(n, ...)                                                                               \
    {                                                                                              \
        ICC_FEATURE_LINE, n,                                                                       \
        {                                                                                          \
            __VA_ARGS__                                                                            \
        }                                                                                          \
    }
#define DOT(x, y)                                                                                  \
    {                                                                                              \
        ICC_FEATURE_POINT, 1,                                                                      \
        {                                                                                          \
            {                                                                                      \
                x, y                                                                               \
            }                                                                                      \
        }                                                                                          \
    }

typedef struct change {
    picture source, target;
    const char *message; /* NULL: none */
} change;

static const change changes[] = {
    {{4,
      {FRAME, LINE(2, {1, 6}, {3, 4}), LINE(2, {3, 1}, {3, 4}), LINE(2, {6, 6}, {3, 4}),
       LINE(2, {3, 7}, {3, 4})}},
     {4,
      {FRAME, LINE(2, {1, 6}, {3, 4}), LINE(2, {3, 1}, {3, 4}), LINE(2, {3, 7}, {3, 4}),
       LINE(2, {6, 6}, {3, 4})}},
     "at (3, 4), where 4 sides meet, feature 2 (a line) and feature 3 (a line) change places in "
     "the target"},
    {{2, {FRAME, LINE(3, {4, 0}, {4, 4}, {4, 8}), DOT(2, 3)}},
     {2, {FRAME, LINE(3, {4, 0}, {4, 4}, {4, 8}), DOT(6, 3)}},
     "feature 1 (a point) is on the left of feature 0 (a line), edge 0, in the source, but on the "
     "right in the target"},
    {{2, {FRAME, LINE(2, {0, 8}, {3, 4}), LINE(3, {4, 0}, {3, 4}, {6, 5})}},
     {2, {FRAME, LINE(2, {0, 8}, {3, 4}), LINE(3, {4, 0}, {3, 3}, {6, 5})}},
     "feature 1 (a line), vertex 1, meets feature 0 (a line), vertex 1, in the source, but not in "
     "the target"},
    {{2, {FRAME, LINE(3, {1, 6}, {2, 4}, {1, 2}), LINE(3, {6, 6}, {5, 4}, {6, 2})}},
     {2, {FRAME, LINE(3, {1, 6}, {3, 4}, {1, 2}), LINE(3, {6, 6}, {3, 4}, {6, 2})}},
     "feature 1 (a line), vertex 1, meets feature 0 (a line), vertex 1, in the target, but not in "
     "the source"},
    {{1, {FRAME, {1, 3, {{4, 0}, {5, 2}, {3, 2}}}}},
     {1, {FRAME, {1, 3, {{4, 1}, {5, 2}, {3, 2}}}}},
     "feature 0 (a hole), vertex 0, meets the outer ring, vertex 1, in the source, but not in the "
     "target"},
    {{1, {FRAME, LINE(5, {2, 2}, {6, 2}, {6, 6}, {2, 6}, {2, 2})}},
     {1, {FRAME, LINE(5, {2, 2}, {2, 6}, {6, 6}, {6, 2}, {2, 2})}},
     "feature 0 (a line) is turned inside out in the target"},
    {{2, {FRAME, LINE(5, {2, 2}, {6, 2}, {6, 6}, {2, 6}, {2, 2}), DOT(4, 4)}},
     {2, {FRAME, LINE(5, {2, 2}, {6, 2}, {6, 6}, {2, 6}, {2, 2}), DOT(1, 1)}},
     "feature 1 (a point) is on the left of feature 0 (a line), edge 0, in the source, but on the "
     "right in the target"},
    {{2, {FRAME, LINE(4, {2, 2}, {6, 2}, {6, 6}, {2, 2}), LINE(4, {4, 3}, {5, 3}, {5, 4}, {4, 3})}},
     {2, {FRAME, LINE(4, {4, 3}, {5, 3}, {5, 4}, {4, 3}), LINE(4, {2, 2}, {6, 2}, {6, 6}, {2, 2})}},
     "feature 0 (a line) lies in a face along the outer ring in the source, but along feature 1 (a "
     "line) in the target"},
    {{2, {FRAME, LINE(3, {0, 0}, {4, 4}, {8, 8}), LINE(2, {4, 4}, {5, 2})}},
     {2, {FRAME, LINE(3, {0, 0}, {4, 4}, {8, 8}), LINE(2, {4, 4}, {3, 6})}},
     "at (4, 4), where 3 sides meet, feature 0 (a line) and feature 1 (a line) change places in "
     "the target"},
    {{2, {FRAME, LINE(2, {4, 0}, {4, 4}), LINE(2, {4, 0}, {2, 3})}},
     {2, {FRAME, LINE(2, {4, 0}, {3, 4}), LINE(2, {4, 0}, {6, 3})}},
     "at (4, 0), where 4 sides meet, feature 0 (a line) and feature 1 (a line) change places in "
     "the target"},
    {{2, {FRAME, LINE(4, {1, 1}, {4, 4}, {7, 4}, {7, 5}), LINE(3, {2, 7}, {4, 4}, {7, 4})}},
     {2, {FRAME, LINE(4, {1, 1}, {4, 5}, {7, 3}, {7, 5}), LINE(3, {2, 7}, {4, 5}, {7, 3})}},
     NULL},
};

START_TEST(known_changes)
{
    for (size_t i = 0; i < sizeof changes / sizeof *changes; ++i) {
        plan source, target;
        icc_error err;
        ck_assert_int_eq(begin_plan(&source, &changes[i].source, &err), ICC_OK);
        ck_assert_int_eq(begin_plan(&target, &changes[i].target, &err), ICC_OK);
        err = (icc_error){.size = sizeof err};
        const icc_status status = iccp_network_same(source.domain, target.domain, &err);
        ck_assert_int_eq(status, changes[i].message != NULL ? ICC_ERR_TOPOLOGY : ICC_OK);
        ck_assert_str_eq(err.message, changes[i].message != NULL ? changes[i].message : "");
        ck_assert((iccp_network_same(target.domain, source.domain, NULL) == ICC_OK) ==
                  (status == ICC_OK));
        icc_domain_free(source.domain);
        icc_domain_free(target.domain);
    }
}
END_TEST

int main(void)
{
    TCase *checks = tcase_create("network");
    tcase_add_test(checks, random_networks);
    tcase_add_test(checks, known_changes);
    tcase_set_timeout(checks, 120);
    Suite *suite = suite_create("network");
    suite_add_tcase(suite, checks);
    return suite_run(suite);
}
