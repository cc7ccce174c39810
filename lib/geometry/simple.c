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
 * so nothing need be stored for it. A smooth outline has a few hundred leaves.
 *
 * The search walks down the tree from left to right. It takes along a list of the later nodes whose
 * boxes meet that of the present node. So pairs of edges come in the order of the earlier edge, and
 * the search ends soon after the first defect. Boxes are stored in cells of a grid, because then
 * two subtractions compare two boxes, and lists are filtered without a branch. */
#include "geometry/simple.h"

#include "base/compiler.h"
#include "geometry/boxtree.h"
#include "geometry/segment.h"

#include <math.h>
#include <string.h>

enum {
    FEW = 4,               /* edges of a rough leaf; the least of a chain, except the last */
    GRAIN = 1024 * FEW,    /* edges between progress reports */
    HALVING = 8,           /* tests of cells that take as long as one test of parts of chains */
    LAST_CELL = 0x7ffffffe /* of the grid, along each axis */
};

/* Directions that all edges of a piece have: RIGHT or LEFT by x and then y, UP or DOWN by y and
 * then x. CHAIN marks a chain. It may have no direction: two of its edges may lead down and to the
 * right. */
enum { RIGHT = 1, LEFT = 2, UP = 4, DOWN = 8, ANY = 15, CHAIN = 16 };

/* A box in cells of a grid over the polygon. For each axis it has two numbers of 31 bits, with a
 * bit 0 above each: the cell of the lower side, and LAST_CELL + 1 minus the cell of the upper
 * side. So a larger box has smaller numbers. Boxes that meet have cells that meet. */
typedef struct cells {
    uint64_t of[2];
} cells;

/* The bits above the numbers. */
static const uint64_t ABOVE = UINT64_C(0x8000000080000000);

/* The empty box, which meets none. */
static const cells NO_CELLS = {{UINT64_C(0x7fffffff7fffffff), UINT64_C(0x7fffffff7fffffff)}};

/* Edges first to end - 1: those of a leaf, or a part of a chain. */
typedef struct piece {
    size_t first, end;
    unsigned ways;
    iccp_box box;
} piece;

typedef struct search {
    const double *points;
    const iccp_env *env;
    size_t n;                     /* edges */
    size_t n_leaves;              /* in use */
    size_t width;                 /* width of the tree: a power of two */
    uint32_t *start;              /* n_leaves + 1: the first edge of each leaf; the last is n */
    uint8_t *ways;                /* by node; before the tree exists, by leaf */
    double lower[2], per_unit[2]; /* the grid: its first corner, and cells per unit of length */
    cells *boxes;                 /* by node, for leaves that exist and one more */
    cells *items; /* FEW of each leaf and of one more: its edges, or all of a chain; NO_CELLS */
    size_t n_tests, n_pairs; /* tests of cells, and pairs of edges whose boxes meet */
    size_t first;            /* least number with a defect found; n: none */
    size_t reported;         /* edges reported */
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

/* Returns the end of the leaf that begins with an edge, and the leaf's directions. An edge without
 * length ends a chain. If it is one of a few edges, the result is `first`. */
static size_t leaf_from(const search *s, size_t first, unsigned *ways)
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
    if (e == s->n || e >= first + FEW) {
        *ways |= CHAIN;
        return e;
    }
    const size_t end = first + FEW < s->n ? first + FEW : s->n;
    for (; e < end; ++e) {
        const unsigned steps = steps_of(point(s, e), point(s, e + 1));
        if (steps == 0)
            return first;
        *ways &= ways_of(steps);
    }
    return end;
}

/* Cuts the polygon into leaves, each as long as possible. Returns false if an edge has no
 * length. */
static bool find_leaves(search *s)
{
    for (size_t e = 0; e < s->n;) {
        unsigned ways;
        const size_t end = leaf_from(s, e, &ways);
        if (end == e)
            return false;
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

/* Rounding does not change the order of two numbers. So cells are in the order of coordinates. */
static void make_grid(search *s)
{
    iccp_box all = part_box(s, 0, s->start[1], s->ways[0]);
    for (size_t j = 1; j < s->n_leaves; ++j)
        all = iccp_box_hull(all, part_box(s, s->start[j], s->start[j + 1], s->ways[j]));
    for (int k = 0; k < 2; ++k) {
        const double length = all.upper[k] - all.lower[k];
        s->lower[k] = all.lower[k];
        s->per_unit[k] = length > 0 ? LAST_CELL / length : 0;
    }
}

static ICCP_INLINE cells cell_of(const search *s, const double *p)
{
    cells result;
    for (int k = 0; k < 2; ++k) {
        const uint64_t x = (uint64_t)(int64_t)((p[k] - s->lower[k]) * s->per_unit[k]);
        result.of[k] = x | ((uint64_t)LAST_CELL + 1 - x) << 32;
    }
    return result;
}

/* Returns the smallest box around two boxes: the smaller one of each two numbers. */
static ICCP_INLINE cells hull(cells a, cells b)
{
    for (int k = 0; k < 2; ++k) {
        const uint64_t at_least = ((a.of[k] | ABOVE) - b.of[k]) & ABOVE;
        const uint64_t mask = at_least - (at_least >> 31);
        a.of[k] = (b.of[k] & mask) | (a.of[k] & ~mask);
    }
    return a;
}

/* Returns 1 if two boxes meet, else 0. The subtraction sets the upper side of a against the lower
 * side of b, and the reverse. It borrows the bit above a number where they are apart. */
static ICCP_INLINE size_t meet(cells a, cells b)
{
    uint64_t kept = ABOVE;
    for (int k = 0; k < 2; ++k) {
        const uint64_t opposite = NO_CELLS.of[k] - a.of[k];
        kept &= (opposite << 32 | opposite >> 32 | ABOVE) - b.of[k];
    }
    return kept == ABOVE;
}

/* Fills in the boxes of a leaf's edges, or of the leaf if it is a chain. Returns their hull. */
static cells box_items(search *s, size_t leaf, unsigned ways)
{
    const size_t first = s->start[leaf], end = s->start[leaf + 1];
    const size_t step = (ways & CHAIN) != 0 ? end - first : 1;
    cells last = cell_of(s, point(s, first)), all = last;
    for (size_t k = 0; k < FEW; ++k) {
        const size_t e = first + step * (k + 1);
        const cells next = e <= end ? cell_of(s, point(s, e)) : NO_CELLS;
        s->items[FEW * leaf + k] = e <= end ? hull(last, next) : NO_CELLS;
        all = hull(all, next);
        last = next;
    }
    return all;
}

/* Node 1 is the root, node i has children 2 i and 2 i + 1, and leaf j is node `width` + j. On every
 * level only the first node without leaves is stored; it is empty. */
static void fill_tree(search *s)
{
    memmove(s->ways + s->width, s->ways, s->n_leaves);
    for (size_t j = 0; j < s->n_leaves; ++j)
        s->boxes[s->width + j] = box_items(s, j, s->ways[s->width + j]);
    for (size_t k = 0; k < FEW; ++k)
        s->items[FEW * s->n_leaves + k] = NO_CELLS;
    for (size_t base = s->width, n = s->n_leaves; base > 0; base /= 2, n = (n + 1) / 2) {
        if (n < base) {
            s->boxes[base + n] = NO_CELLS;
            s->ways[base + n] = ANY;
        }
        for (size_t i = base / 2; i < base / 2 + (n + 1) / 2 && base > 1; ++i) {
            s->boxes[i] = hull(s->boxes[2 * i], s->boxes[2 * i + 1]);
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
    bool do_meet;
    if (f == e + 1)
        do_meet = iccp_point_folds(b, a, b + 2);
    else if (e == 0 && f + 1 == s->n)
        do_meet = iccp_point_folds(a, b, a + 2);
    else
        do_meet = iccp_segments_meet(a, a + 2, b, b + 2) != 0;
    if (ICCP_UNLIKELY(do_meet)) {
        const size_t number = number_of(s, e, f);
        s->first = number < s->first ? number : s->first;
    }
}

static void compare_few(search *s, const piece *a, const piece *b)
{
    for (size_t e = a->first; e < a->end; ++e) {
        const iccp_box edge = iccp_box_of(point(s, e), point(s, e + 1));
        if (!iccp_boxes_meet(&edge, &b->box))
            continue;
        for (size_t f = b->first; f < b->end; ++f)
            compare_edges(s, e, f);
        s->n_pairs += b->end - b->first;
    }
}

/* ----------------------------------------------------------------- pieces */

static piece part_of(const search *s, size_t first, size_t end, unsigned ways)
{
    return (piece){first, end, ways, part_box(s, first, end, ways)};
}

static bool is_chain(const search *s, size_t leaf)
{
    return (s->ways[s->width + leaf] & CHAIN) != 0;
}

static piece leaf_of(const search *s, size_t leaf)
{
    return part_of(s, s->start[leaf], s->start[leaf + 1], s->ways[s->width + leaf]);
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

/* Returns true if the polygon is one that the sweep tests faster. */
static bool is_tired(const search *s)
{
    return s->n_tests > ICCP_SIMPLE_TESTS * s->n || s->n_pairs > ICCP_SIMPLE_PAIRS * s->n;
}

/* Returns true if no pair of edges matters any more whose earlier edge is `first` or a later one.
 * The search takes the edges in their order, so it is nearly over when it finds a defect. */
static bool done(const search *s, size_t first)
{
    return s->status != ICC_OK || first > s->first || (s->first == s->n && is_tired(s));
}

/* Compares the edges of a with those of b, which come later. If two boxes overlap, the longer one
 * is halved. */
static void compare(search *s, const piece *a, const piece *b)
{
    s->n_tests += HALVING;
    if (!iccp_boxes_meet(&a->box, &b->box) || done(s, a->first))
        return;
    if ((a->ways & b->ways & ANY) != 0 && (follows(s, a, b) || follows(s, b, a)))
        return;
    const size_t n_a = a->end - a->first, n_b = b->end - b->first;
    if (n_a <= FEW && n_b <= FEW) {
        compare_few(s, a, b);
    } else if (n_b == 1 || (n_a > 1 && extent(a) > extent(b))) {
        const size_t middle = a->first + n_a / 2;
        const piece left = part_of(s, a->first, middle, a->ways);
        const piece right = part_of(s, middle, a->end, a->ways);
        compare(s, &left, b);
        compare(s, &right, b);
    } else {
        const size_t middle = b->first + n_b / 2;
        const piece left = part_of(s, b->first, middle, b->ways);
        const piece right = part_of(s, middle, b->end, b->ways);
        compare(s, a, &left);
        compare(s, a, &right);
    }
}

/* ----------------------------------------------------------------- leaves */

/* Compares leaves of which at least one is a chain. */
static void compare_leaves(search *s, size_t leaf, size_t later)
{
    const piece a = leaf_of(s, leaf), b = leaf_of(s, later);
    compare(s, &a, &b);
}

/* Compares an edge with n later ones. They are given as items. */
static void compare_edge(search *s, size_t item, const uint32_t *later, size_t n)
{
    const cells box = s->items[item];
    const size_t e = s->start[item / FEW] + item % FEW;
    for (size_t i = 0; i < n; ++i)
        if (meet(box, s->items[later[i]]) != 0) {
            compare_edges(s, e, s->start[later[i] / FEW] + later[i] % FEW);
            ++s->n_pairs;
        }
    s->n_tests += n;
}

/* Compares the edges of a leaf with one another and with those of the leaves of n later items. Uses
 * up the list. */
static void compare_leaf(search *s, size_t leaf, uint32_t *later, size_t n)
{
    const size_t first = s->start[leaf], end = s->start[leaf + 1];
    size_t n_edges = 0, last = s->n_leaves;
    for (size_t i = 0; i < n; ++i) {
        const size_t other = later[i] / FEW;
        if (!is_chain(s, leaf) && !is_chain(s, other))
            later[n_edges++] = later[i];
        else if (other != last)
            compare_leaves(s, leaf, other);
        last = other;
    }
    for (size_t e = first; e < end && n_edges > 0; ++e)
        compare_edge(s, FEW * leaf + (e - first), later, n_edges);
    if (s->ways[s->width + leaf] == 0)
        for (size_t e = first; e < end; ++e)
            for (size_t f = e + 1; f < end; ++f)
                compare_edges(s, e, f);
}

/* Lists those of n consecutive items whose boxes meet one. Returns their number. */
static ICCP_INLINE size_t list_items(search *s, cells box, size_t first, size_t n, uint32_t *list)
{
    size_t n_list = 0;
    for (size_t item = first; item < first + n; ++item) {
        list[n_list] = (uint32_t)item;
        n_list += meet(box, s->items[item]);
    }
    s->n_tests += n;
    return n_list;
}

/* Does the work of visit() at a node of one or two leaves. Here items take the place of nodes. */
static void visit_leaves(search *s, size_t node, size_t leaf, size_t size, uint32_t *later,
                         size_t n)
{
    uint32_t *list = later + n;
    size_t n_list = 0;
    for (size_t i = 0; i < n; ++i)
        n_list += list_items(s, s->boxes[node], FEW * (size * later[i] - s->width), FEW * size,
                             list + n_list);
    for (size_t k = 0; k < size && leaf + k < s->n_leaves && !done(s, s->start[leaf + k]); ++k) {
        const cells box = s->boxes[s->width + leaf + k];
        uint32_t *own = list + n_list;
        size_t n_own = 0;
        if (k + 1 < size && s->ways[node] == 0)
            n_own = list_items(s, box, FEW * (leaf + 1), FEW, own);
        for (size_t i = 0; i < n_list; ++i) {
            own[n_own] = list[i];
            n_own += meet(box, s->items[list[i]]);
        }
        s->n_tests += n_list;
        compare_leaf(s, leaf + k, own, n_own);
    }
}

/* ------------------------------------------------------------------- tree */

static void report(search *s, size_t node, size_t first)
{
    if (s->status != ICC_OK || (node != 1 && first < s->reported + GRAIN))
        return;
    s->reported = first;
    s->status = iccp_progress(s->env, "check", (double)first / (double)s->n);
}

/* Lists those children of n nodes whose boxes meet that of a node. Returns their number. */
static size_t list_children(search *s, size_t node, const uint32_t *later, size_t n, uint32_t *list)
{
    const cells box = s->boxes[node];
    size_t n_list = 0;
    for (size_t i = 0; i < n; ++i)
        for (uint32_t k = 0; k < 2; ++k) {
            const uint32_t child = 2 * later[i] + k;
            list[n_list] = child;
            n_list += meet(box, s->boxes[child]);
        }
    s->n_tests += 2 * n;
    return n_list;
}

/* Compares the edges under a node with one another and with those under n later nodes of its level,
 * whose boxes meet its own. The node has `size` leaves, of which `leaf` is the first; the last of
 * them may not exist. Nodes that follow it monotonically are not listed. */
static void visit(search *s, size_t node, size_t leaf, size_t size, uint32_t *later, size_t n)
{
    if (leaf >= s->n_leaves || (n == 0 && s->ways[node] != 0))
        return;
    report(s, node, s->start[leaf]);
    if (done(s, s->start[leaf]))
        return;
    if (size <= 2) {
        visit_leaves(s, node, leaf, size, later, n);
        return;
    }
    for (size_t k = 0; k < 2; ++k) {
        const size_t child = 2 * node + k;
        uint32_t *list = later + n;
        size_t n_list = 0;
        if (k == 0 && s->ways[node] == 0 && meet(s->boxes[child], s->boxes[child + 1]) != 0)
            list[n_list++] = (uint32_t)child + 1;
        n_list += list_children(s, child, later, n, list + n_list);
        const bool next = n_list > 0 && list[0] == child + 1;
        const size_t skip = next && (s->ways[child] & s->ways[child + 1] & ANY) != 0 ? 1 : 0;
        visit(s, child, leaf + k * (size / 2), size / 2, list + skip, n_list - skip);
    }
}

/* Compares all edges with the help of leaves. A list of nodes has at most all nodes of a level, and
 * the two lists of items at most all items. */
static icc_status compare_all(search *s)
{
    const iccp_memory *memory = &s->env->memory;
    s->width = 1;
    while (s->width < s->n_leaves)
        s->width *= 2;
    s->boxes = iccp_alloc(memory, s->width + s->n_leaves + 1, sizeof *s->boxes);
    s->items = iccp_alloc(memory, FEW * (s->n_leaves + 1), sizeof *s->items);
    uint32_t *lists = iccp_alloc(memory, 2 * s->width + 2 * FEW * (s->n_leaves + 1), sizeof *lists);
    if (s->boxes != NULL && s->items != NULL && lists != NULL) {
        make_grid(s);
        fill_tree(s);
        visit(s, 1, 0, s->width, lists, 0);
    } else {
        s->status = ICC_ERR_MEMORY;
    }
    iccp_free(memory, lists);
    iccp_free(memory, s->items);
    iccp_free(memory, s->boxes);
    return s->status;
}

icc_status iccp_simple_find(iccp_simple *result, const double *points, size_t n,
                            const iccp_env *env)
{
    const size_t most = n / FEW + 1; /* all leaves except the last have at least a few edges */
    search s = {.points = points, .env = env, .n = n, .first = n};
    *result = (iccp_simple){.answer = ICCP_NOT_SIMPLE, .first = n};
    s.start = iccp_alloc(&env->memory, most + 1, sizeof *s.start);
    s.ways = iccp_alloc(&env->memory, 3 * most + 1, sizeof *s.ways);
    if (s.start == NULL || s.ways == NULL)
        s.status = ICC_ERR_MEMORY;
    else if (find_leaves(&s)) {
        s.status = compare_all(&s);
        if (s.first == n)
            result->answer = is_tired(&s) ? ICCP_UNDECIDED : ICCP_SIMPLE;
        result->first = s.first;
        result->n_tests = s.n_tests;
        result->n_pairs = s.n_pairs;
    }
    iccp_free(&env->memory, s.ways);
    iccp_free(&env->memory, s.start);
    return s.status;
}
