/* Tests whether a polygon is simple by comparing a tree of boxes with itself. Pieces that cannot
 * meet themselves are skipped. That is the idea of P. Volino, N. Magnenat Thalmann, Efficient
 * self-collision detection on smoothly discretized surface animations using geometrical shape
 * regularity, 1994.
 *
 * In the plane it is exact: a piece of the polygon is simple if its points ascend, by x and then y
 * or by y and then x, or descend. So the search compares only the boxes of pieces that are not
 * monotone, or that do not continue each other monotonically. Where the boxes of a few edges
 * overlap, exact signs compare the edges.
 *
 * Leaves of the tree are chains or, where the polygon is rough, a few edges. A chain is as long as
 * possible without going back in x or in y. The box of a part of a chain is that of its two ends,
 * so nothing need be stored for it. A smooth outline has a few hundred leaves. */
#include "geometry/simple.h"

#include "base/compiler.h"
#include "geometry/boxtree.h"
#include "geometry/segment.h"

#include <math.h>
#include <string.h>

enum {
    FEW = 4,            /* edges of a rough leaf; the least of a chain, except the last */
    GRAIN = 1024 * FEW, /* edges between progress reports */
};

/* Directions that all edges of a piece have: RIGHT or LEFT by x and then y, UP or DOWN by y and
 * then x. CHAIN marks a chain. It may have no direction: two of its edges may lead down and to the
 * right. */
enum { RIGHT = 1, LEFT = 2, UP = 4, DOWN = 8, ANY = 15, CHAIN = 16 };

/* Edges first to end - 1. They belong to the leaves leaf to leaf + size - 1 under a node; some of
 * these leaves may not exist. If the node is 0, they are a part of a chain. */
typedef struct piece {
    size_t node, leaf, size;
    size_t first, end;
    unsigned ways;
    iccp_box box;
} piece;

typedef struct search {
    const double *points;
    const iccp_env *env;
    size_t n;        /* edges */
    size_t n_leaves; /* in use */
    size_t width;    /* width of the tree: a power of two */
    uint32_t *start; /* n_leaves + 1: the first edge of each leaf; the last is n */
    uint8_t *ways;   /* by node; before the tree exists, by leaf */
    iccp_box *boxes; /* by node, for leaves that exist and one more */
    size_t n_tests, patience;
    size_t first;    /* least number with a defect found; n: none */
    size_t reported; /* edges reported */
    icc_status status;
} search;

static const double *point(const search *s, size_t k)
{
    return s->points + 2 * k;
}

/* ------------------------------------------------------------------ leaves */

/* Returns bits for the direction of an edge along x and along y. Returns 0 for an edge without
 * length. */
static ICCP_INLINE unsigned steps_of(const double *a, const double *b)
{
    return (unsigned)(b[0] > a[0]) | (unsigned)(b[0] < a[0]) << 1 | (unsigned)(b[1] > a[1]) << 2 |
           (unsigned)(b[1] < a[1]) << 3;
}

/* A step along only one axis also counts as one along the other, in the order by x and then y. */
static ICCP_INLINE unsigned ways_of(unsigned steps)
{
    return steps == RIGHT || steps == UP    ? RIGHT | UP
           : steps == LEFT || steps == DOWN ? LEFT | DOWN
                                            : steps;
}

static bool leads_back(unsigned steps)
{
    return (steps & (RIGHT | LEFT)) == (RIGHT | LEFT) || (steps & (UP | DOWN)) == (UP | DOWN);
}

/* Returns the end of the chain that begins with an edge, and the chain's directions. An edge
 * without length ends it. */
static size_t chain_from(const search *s, size_t first, unsigned *ways)
{
    unsigned seen = 0;
    size_t e = first;
    *ways = ANY;
    for (; e < s->n; ++e) {
        const unsigned steps = steps_of(point(s, e), point(s, e + 1));
        if (steps == 0 || leads_back(seen | steps))
            break;
        seen |= steps;
        *ways &= ways_of(steps);
    }
    *ways |= CHAIN;
    return e;
}

/* Finds the common directions of a few edges. Returns false if one has no length. */
static bool find_ways(const search *s, size_t first, size_t end, unsigned *ways)
{
    *ways = ANY;
    for (size_t e = first; e < end; ++e) {
        const unsigned steps = steps_of(point(s, e), point(s, e + 1));
        if (steps == 0)
            return false;
        *ways &= ways_of(steps);
    }
    return true;
}

/* Cuts the polygon into leaves, each as long as possible. Returns false if an edge has no
 * length. */
static bool find_leaves(search *s)
{
    for (size_t e = 0; e < s->n;) {
        unsigned ways;
        size_t end = chain_from(s, e, &ways);
        if (end < s->n && end < e + FEW) {
            end = e + FEW < s->n ? e + FEW : s->n;
            if (!find_ways(s, e, end, &ways))
                return false;
        }
        s->start[s->n_leaves] = (uint32_t)e;
        s->ways[s->n_leaves++] = (uint8_t)ways;
        e = end;
    }
    s->start[s->n_leaves] = (uint32_t)s->n;
    return true;
}

/* ------------------------------------------------------------------- boxes */

/* Returns the box of edges first to end - 1, which are a chain or a few edges. */
static iccp_box part_box(const search *s, size_t first, size_t end, unsigned ways)
{
    if ((ways & CHAIN) != 0)
        return iccp_box_of(point(s, first), point(s, end));
    iccp_box all = iccp_box_of(point(s, first), point(s, first + 1));
    for (size_t e = first + 1; e < end; ++e)
        all = iccp_box_hull(all, iccp_box_of(point(s, e), point(s, e + 1)));
    return all;
}

/* Node 1 is the root, node i has children 2 i and 2 i + 1, and leaf j is node `width` + j. On every
 * level only the first node without leaves is stored; it is empty. */
static void fill_tree(search *s)
{
    static const iccp_box empty = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    memmove(s->ways + s->width, s->ways, s->n_leaves);
    for (size_t j = 0; j < s->n_leaves; ++j)
        s->boxes[s->width + j] = part_box(s, s->start[j], s->start[j + 1], s->ways[s->width + j]);
    for (size_t base = s->width, n = s->n_leaves; base > 0; base /= 2, n = (n + 1) / 2) {
        if (n < base) {
            s->boxes[base + n] = empty;
            s->ways[base + n] = ANY;
        }
        for (size_t i = base / 2; i < base / 2 + (n + 1) / 2 && base > 1; ++i) {
            s->boxes[i] = iccp_box_hull(s->boxes[2 * i], s->boxes[2 * i + 1]);
            s->ways[i] = s->ways[2 * i] & s->ways[2 * i + 1] & ANY;
        }
    }
}

/* ------------------------------------------------------------------ edges */

/* Returns the least number under which the list of defects has an entry for edges e and f that
 * meet. f is the later edge. The number is that of the vertex between them, or of a repeated
 * vertex, or e. */
static size_t number_of(const search *s, size_t e, size_t f)
{
    if (f == e + 1)
        return f;
    if (e == 0 && f + 1 == s->n)
        return 0;
    size_t number = s->n;
    for (size_t i = 0; i < 2; ++i)
        for (size_t j = 0; j < 2; ++j) {
            const double *at = point(s, e + i), *p = point(s, e + 1 - i), *q = point(s, f + 1 - j);
            if (!iccp_point_equal(at, point(s, f + j)))
                continue;
            const bool overlap = iccp_point_equal(p, q) || iccp_point_folds(at, p, q);
            const size_t v = overlap ? e : e + i, w = f + j < s->n ? f + j : 0;
            number = v < number ? v : number;
            number = w < number ? w : number;
        }
    return number < s->n ? number : e;
}

/* Looks for a forbidden common point of edge e and a later one. */
static void compare_edges(search *s, size_t e, size_t f)
{
    const double *a = point(s, e), *b = point(s, f);
    bool meet;
    if (f == e + 1)
        meet = iccp_point_folds(b, a, b + 2);
    else if (e == 0 && f + 1 == s->n)
        meet = iccp_point_folds(a, b, a + 2);
    else
        meet = iccp_segments_meet(a, a + 2, b, b + 2) != 0;
    if (ICCP_UNLIKELY(meet)) {
        const size_t number = number_of(s, e, f);
        s->first = number < s->first ? number : s->first;
    }
}

static void compare_in_few(search *s, const piece *a)
{
    for (size_t e = a->first; e < a->end; ++e)
        for (size_t f = e + 1; f < a->end; ++f)
            compare_edges(s, e, f);
    s->n_tests += FEW * (FEW - 1) / 2;
}

static void compare_few(search *s, const piece *a, const piece *b)
{
    for (size_t e = a->first; e < a->end; ++e) {
        const iccp_box edge = iccp_box_of(point(s, e), point(s, e + 1));
        ++s->n_tests;
        if (!iccp_boxes_meet(&edge, &b->box))
            continue;
        for (size_t f = b->first; f < b->end; ++f)
            compare_edges(s, e, f);
        s->n_tests += FEW;
    }
}

/* ----------------------------------------------------------------- pieces */

static size_t start_of(const search *s, size_t leaf)
{
    return s->start[leaf < s->n_leaves ? leaf : s->n_leaves];
}

static piece piece_of(const search *s, size_t node, size_t leaf, size_t size)
{
    return (piece){node,          leaf,          size, start_of(s, leaf), start_of(s, leaf + size),
                   s->ways[node], s->boxes[node]};
}

static piece half(const search *s, const piece *a, size_t k)
{
    if (a->size > 1)
        return piece_of(s, 2 * a->node + k, a->leaf + k * (a->size / 2), a->size / 2);
    const size_t middle = a->first + (a->end - a->first) / 2;
    piece part = {
        .ways = a->ways, .first = k == 0 ? a->first : middle, .end = k == 0 ? middle : a->end};
    part.box = part_box(s, part.first, part.end, part.ways);
    return part;
}

static double extent(const piece *a)
{
    return (a->box.upper[0] - a->box.lower[0]) + (a->box.upper[1] - a->box.lower[1]);
}

/* Returns true if b begins where a ends. */
static bool follows(const search *s, const piece *a, const piece *b)
{
    return b->first == (a->end < s->n ? a->end : 0);
}

/* Returns true if nothing between a and the later piece b can matter any more. A defect there would
 * be listed under an edge of a or under vertex 0. */
static bool done(const search *s, const piece *a, const piece *b)
{
    return s->status != ICC_OK || s->n_tests > s->patience ||
           (a->first > s->first && b->end < s->n) || s->first == 0;
}

/* Compares the edges of a with those of b, which come later. If two boxes overlap, the longer one
 * is halved. */
static void compare(search *s, const piece *a, const piece *b)
{
    ++s->n_tests;
    if (!iccp_boxes_meet(&a->box, &b->box) || done(s, a, b))
        return;
    if ((a->ways & b->ways & ANY) != 0 && (follows(s, a, b) || follows(s, b, a)))
        return;
    const size_t n_a = a->end - a->first, n_b = b->end - b->first;
    if (n_a <= FEW && n_b <= FEW) {
        compare_few(s, a, b);
    } else if (n_b == 1 || (n_a > 1 && extent(a) > extent(b))) {
        const piece left = half(s, a, 0), right = half(s, a, 1);
        compare(s, &left, b);
        compare(s, &right, b);
    } else {
        const piece left = half(s, b, 0), right = half(s, b, 1);
        compare(s, a, &left);
        compare(s, a, &right);
    }
}

static void report(search *s, const piece *a)
{
    if (a->node != 1 && a->first < s->reported + GRAIN)
        return;
    s->reported = a->first;
    s->status = iccp_progress(s->env, "check", (double)a->first / (double)s->n);
}

/* Compares the edges of a piece with one another. */
static void compare_within(search *s, const piece *a)
{
    if (s->status == ICC_OK)
        report(s, a);
    if (a->ways != 0 || done(s, a, a))
        return;
    if (a->size == 1) {
        compare_in_few(s, a);
        return;
    }
    const piece left = half(s, a, 0), right = half(s, a, 1);
    compare_within(s, &left);
    compare_within(s, &right);
    compare(s, &left, &right);
}

/* Compares all edges with the help of leaves. */
static icc_status compare_all(search *s)
{
    const iccp_memory *memory = &s->env->memory;
    s->width = 1;
    while (s->width < s->n_leaves)
        s->width *= 2;
    s->boxes = iccp_alloc(memory, s->width + s->n_leaves + 1, sizeof *s->boxes);
    if (s->boxes == NULL)
        return ICC_ERR_MEMORY;
    fill_tree(s);
    const piece all = piece_of(s, 1, 0, s->width);
    compare_within(s, &all);
    iccp_free(memory, s->boxes);
    return s->status;
}

icc_status iccp_simple_find(iccp_simple *result, const double *points, size_t n,
                            const iccp_env *env)
{
    const size_t most = n / FEW + 1; /* all leaves except the last have at least a few edges */
    search s = {
        .points = points, .env = env, .n = n, .patience = ICCP_SIMPLE_PATIENCE * n, .first = n};
    *result = (iccp_simple){.answer = ICCP_NOT_SIMPLE, .first = n};
    s.start = iccp_alloc(&env->memory, most + 1, sizeof *s.start);
    s.ways = iccp_alloc(&env->memory, 3 * most + 1, sizeof *s.ways);
    if (s.start == NULL || s.ways == NULL)
        s.status = ICC_ERR_MEMORY;
    else if (find_leaves(&s)) {
        s.status = compare_all(&s);
        result->n_tests = s.n_tests;
        const bool complete = s.n_tests <= s.patience;
        if (s.first == n)
            result->answer = complete ? ICCP_SIMPLE : ICCP_UNDECIDED;
        else if (complete)
            result->first = s.first;
    }
    iccp_free(&env->memory, s.ways);
    iccp_free(&env->memory, s.start);
    return s.status;
}
