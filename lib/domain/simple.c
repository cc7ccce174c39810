/* A tree of boxes is compared with itself, and pieces that cannot meet themselves are left out: the
 * idea of P. Volino, N. Magnenat Thalmann, Efficient self-collision detection on smoothly
 * discretized surface animations using geometrical shape regularity, 1994. In the plane it is
 * exact: a piece of the polygon is simple when its points ascend, by x and then y or by y and then
 * x, or descend. So only the boxes of pieces are compared that do not, or that do not follow one
 * another in such a way; edges, by exact signs, where the boxes of leaves overlap. */
#include "domain/simple.h"

#include "domain/segment.h"

enum {
    LEAF = ICCP_BOXTREE_LEAF,
    GRAIN = 1024 * LEAF /* edges between reports */
};

/* The ways in which all the edges of a piece lead. */
enum { RIGHT = 1, LEFT = 2, UP = 4, DOWN = 8, ANY = 15 };

/* A node of the tree and its edges; those beyond the last one do not exist. */
typedef struct piece {
    size_t node, first, size;
} piece;

typedef struct search {
    const iccp_boxtree *tree;
    const iccp_env *env;
    uint8_t *ways; /* by node */
    size_t n_tests, patience;
    bool met;
    icc_status status;
} search;

static const double *point(const search *s, size_t k)
{
    return s->tree->points + 2 * k;
}

/* ------------------------------------------------------------------- ways */

/* 0 for an edge without length. */
static uint8_t ways_of(const double *a, const double *b)
{
    if (iccp_point_equal(a, b))
        return 0;
    const bool up = a[1] < b[1] || (a[1] == b[1] && a[0] < b[0]);
    return (uint8_t)((iccp_point_less(a, b) ? RIGHT : LEFT) | (up ? UP : DOWN));
}

/* False if an edge has no length. */
static bool find_ways(search *s)
{
    const size_t n_leaves = s->tree->n_leaves;
    for (size_t leaf = 0; leaf < n_leaves; ++leaf) {
        uint8_t ways = ANY;
        const size_t end = (leaf + 1) * LEAF < s->tree->n ? (leaf + 1) * LEAF : s->tree->n;
        for (size_t e = leaf * LEAF; e < end; ++e) {
            const uint8_t way = ways_of(point(s, e), point(s, e + 1));
            if (way == 0)
                return false;
            ways &= way;
        }
        s->ways[n_leaves + leaf] = ways;
    }
    for (size_t node = n_leaves; node-- > 1;)
        s->ways[node] = s->ways[2 * node] & s->ways[2 * node + 1];
    return true;
}

/* ------------------------------------------------------------------ edges */

/* Whether edge e and a later one have a point in common that they should not. */
static bool edges_meet(const search *s, size_t e, size_t f)
{
    const double *a = point(s, e), *b = point(s, f);
    if (f == e + 1)
        return iccp_point_folds(b, a, b + 2);
    if (e == 0 && f + 1 == s->tree->n)
        return iccp_point_folds(a, b, a + 2);
    return iccp_segments_meet(a, a + 2, b, b + 2) != 0;
}

static size_t end_of(const search *s, const piece *a)
{
    const size_t end = a->first + a->size;
    return end < s->tree->n ? end : s->tree->n;
}

static void compare_in_leaf(search *s, const piece *a)
{
    const size_t end = end_of(s, a);
    for (size_t e = a->first; e < end; ++e)
        for (size_t f = e + 1; f < end; ++f)
            s->met |= edges_meet(s, e, f);
    s->n_tests += LEAF * (LEAF - 1) / 2;
}

static void compare_leaves(search *s, const piece *a, const piece *b)
{
    const size_t end_a = end_of(s, a), end_b = end_of(s, b);
    for (size_t e = a->first; e < end_a; ++e) {
        const iccp_box box = iccp_boxtree_edge(s->tree, e);
        ++s->n_tests;
        if (!iccp_boxes_meet(&box, &s->tree->boxes[b->node]))
            continue;
        for (size_t f = b->first; f < end_b; ++f)
            s->met |= edges_meet(s, e, f);
        s->n_tests += LEAF;
    }
}

/* ----------------------------------------------------------------- pieces */

static bool is_leaf(const search *s, const piece *a)
{
    return a->node >= s->tree->n_leaves;
}

static piece half(const piece *a, size_t k)
{
    const size_t size = a->size / 2;
    return (piece){2 * a->node + k, a->first + k * size, size};
}

static double extent(const search *s, const piece *a)
{
    const iccp_box *box = &s->tree->boxes[a->node];
    return (box->upper[0] - box->lower[0]) + (box->upper[1] - box->lower[1]);
}

/* Whether b begins where a ends. */
static bool follows(const search *s, const piece *a, const piece *b)
{
    return b->first == (end_of(s, a) < s->tree->n ? a->first + a->size : 0);
}

static bool done(const search *s)
{
    return s->met || s->status != ICC_OK || s->n_tests > s->patience;
}

/* Compares the edges of a with those of b, which come later. Of two boxes that overlap the longer
 * is halved. */
static void compare(search *s, const piece *a, const piece *b)
{
    ++s->n_tests;
    if (done(s) || !iccp_boxes_meet(&s->tree->boxes[a->node], &s->tree->boxes[b->node]))
        return;
    if ((s->ways[a->node] & s->ways[b->node]) != 0 && (follows(s, a, b) || follows(s, b, a)))
        return;
    const bool a_leaf = is_leaf(s, a), b_leaf = is_leaf(s, b);
    if (a_leaf && b_leaf) {
        compare_leaves(s, a, b);
    } else if (b_leaf || (!a_leaf && extent(s, a) > extent(s, b))) {
        const piece left = half(a, 0), right = half(a, 1);
        compare(s, &left, b);
        compare(s, &right, b);
    } else {
        const piece left = half(b, 0), right = half(b, 1);
        compare(s, a, &left);
        compare(s, a, &right);
    }
}

/* Compares the edges of a piece with one another. */
static void compare_within(search *s, const piece *a)
{
    if (s->status == ICC_OK && (a->size == GRAIN || a->node == 1))
        s->status = iccp_progress(s->env, "check", (double)a->first / (double)s->tree->n);
    if (done(s) || s->ways[a->node] != 0)
        return;
    if (is_leaf(s, a)) {
        compare_in_leaf(s, a);
        return;
    }
    const piece left = half(a, 0), right = half(a, 1);
    compare_within(s, &left);
    compare_within(s, &right);
    compare(s, &left, &right);
}

icc_status iccp_simple_find(iccp_simple *result, const iccp_boxtree *tree, const iccp_env *env)
{
    search s = {.tree = tree, .env = env, .patience = ICCP_SIMPLE_PATIENCE * tree->n};
    const piece all = {1, 0, tree->n_leaves * LEAF};
    *result = (iccp_simple){.answer = ICCP_UNDECIDED};
    s.ways = iccp_alloc(&env->memory, 2 * tree->n_leaves, sizeof *s.ways);
    if (s.ways == NULL)
        return ICC_ERR_MEMORY;
    s.met = !find_ways(&s);
    compare_within(&s, &all);
    iccp_free(&env->memory, s.ways);
    result->n_tests = s.n_tests;
    if (s.met)
        result->answer = ICCP_NOT_SIMPLE;
    else if (!done(&s))
        result->answer = ICCP_SIMPLE;
    return s.status;
}
