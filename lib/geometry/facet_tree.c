/* Makes a tree of boxes. Each node is halved at the median of the facets' centres along the longest
 * side: C. Ericson, Real-Time Collision Detection, sections 6.2 and 6.6. */
#include "geometry/facet_tree.h"

#include "base/minmax.h"

#include <math.h>

enum {
    LEAF = ICCP_FACET_LEAF,
    BLOCK = 16 /* rows that are compared at a time */
};

static ICCP_INLINE void include(size_t dim, double *box, const double *other)
{
    for (size_t k = 0; k < dim; ++k) {
        box[k] = other[k] < box[k] ? other[k] : box[k];
        box[dim + k] = other[dim + k] > box[dim + k] ? other[dim + k] : box[dim + k];
    }
}

/* While the tree is made, a facet is a row: the dim coordinates of its centre, and its number. Rows
 * move as a whole, so memory is read in sequence. */

/* Returns the axis along which the centres spread most. Two strands run side by side, and neither
 * waits for the other. Facet numbers get bounds like coordinates, but these are not used. */
static ICCP_INLINE size_t widest_axis(size_t dim, const double *rows, size_t n)
{
    double low[2 * (ICC_MAX_DIM + 1)], high[2 * (ICC_MAX_DIM + 1)], most = -1;
    const size_t width = dim + 1, two = 2 * width;
    size_t widest = 0, i = 0;
    for (size_t k = 0; k < two; ++k)
        low[k] = high[k] = rows[k % width];
    for (; i + 2 <= n; i += 2)
        for (size_t k = 0; k < two; ++k) {
            const double x = rows[width * i + k];
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    for (size_t k = 0; k < dim; ++k) {
        const double last = rows[width * (n - 1) + k];
        const double lowest = iccp_min(iccp_min(low[k], low[width + k]), last);
        const double highest = iccp_max(iccp_max(high[k], high[width + k]), last);
        if (highest - lowest > most) {
            most = highest - lowest;
            widest = k;
        }
    }
    return widest;
}

/* Rows are sorted by a coordinate of the centre. Of equal ones the smaller facet number comes
 * first. */
typedef struct sort_key {
    double at, number;
} sort_key;

static ICCP_INLINE sort_key key_of(size_t dim, const double *row, size_t axis)
{
    return (sort_key){row[axis], row[dim]};
}

static ICCP_INLINE bool before(sort_key a, sort_key b)
{
    return (a.at < b.at) | ((a.at == b.at) & (a.number < b.number));
}

static ICCP_INLINE sort_key middle_of_three(sort_key a, sort_key b, sort_key c)
{
    if (before(a, b))
        return before(b, c) ? b : before(a, c) ? c : a;
    return before(a, c) ? a : before(b, c) ? c : b;
}

static ICCP_INLINE void swap_rows(size_t dim, double *a, double *b)
{
    for (size_t k = 0; k <= dim; ++k) {
        const double swap = a[k];
        a[k] = b[k];
        b[k] = swap;
    }
}

/* Swaps rows inwards from *i and *j: rows that do not precede the pivot with rows that do not
 * follow it. Lists the rows to be swapped a block at a time, so that no branch depends on a
 * comparison. Stops before the middle. S. Edelkamp, A. Weiss, BlockQuicksort: Avoiding Branch
 * Mispredictions in Quicksort, 2016. */
static ICCP_INLINE void swap_blocks(size_t dim, double *rows, size_t axis, sort_key pivot,
                                    ptrdiff_t *i, ptrdiff_t *j)
{
    const ptrdiff_t width = (ptrdiff_t)dim + 1;
    uint8_t left[BLOCK], right[BLOCK];
    ptrdiff_t n_left = 0, n_right = 0, at_left = 0, at_right = 0;
    while (*j - *i + 1 >= 2 * BLOCK) {
        if (at_left == n_left) {
            at_left = n_left = 0;
            for (uint8_t k = 0; k < BLOCK; ++k) {
                left[n_left] = k;
                n_left += !before(key_of(dim, rows + width * (*i + k), axis), pivot);
            }
        }
        if (at_right == n_right) {
            at_right = n_right = 0;
            for (uint8_t k = 0; k < BLOCK; ++k) {
                right[n_right] = k;
                n_right += !before(pivot, key_of(dim, rows + width * (*j - k), axis));
            }
        }
        for (; at_left < n_left && at_right < n_right; ++at_left, ++at_right)
            swap_rows(dim, rows + width * (*i + left[at_left]),
                      rows + width * (*j - right[at_right]));
        *i += at_left == n_left ? BLOCK : 0;
        *j -= at_right == n_right ? BLOCK : 0;
    }
    if (at_left < n_left)
        *i += left[at_left];
    if (at_right < n_right)
        *j -= right[at_right];
}

/* Puts the n_first smallest of n rows at the beginning. C. A. R. Hoare, Algorithm 65: Find,
 * 1961. */
static ICCP_INLINE void split(size_t dim, double *rows, size_t axis, ptrdiff_t n_first, ptrdiff_t n)
{
    const ptrdiff_t width = (ptrdiff_t)dim + 1;
    ptrdiff_t low = 0, high = n - 1;
    while (low < high) {
        const sort_key pivot =
            middle_of_three(key_of(dim, rows + width * low, axis),
                            key_of(dim, rows + width * (low + (high - low) / 2), axis),
                            key_of(dim, rows + width * high, axis));
        ptrdiff_t i = low, j = high;
        swap_blocks(dim, rows, axis, pivot, &i, &j);
        while (i <= j) {
            while (before(key_of(dim, rows + width * i, axis), pivot))
                ++i;
            while (before(pivot, key_of(dim, rows + width * j, axis)))
                --j;
            if (i > j)
                break;
            swap_rows(dim, rows + width * i, rows + width * j);
            ++i;
            --j;
        }
        if (j < n_first)
            low = i;
        if (n_first < i)
            high = j;
    }
}

/* Arranges n rows at `size` places, one half after the other, so that small parts stay in the
 * cache. Paths through the tree are short enough for recursion. */
static void arrange(size_t dim, double *rows, size_t n, size_t size)
{
    const size_t half = size / 2;
    if (size <= LEAF)
        return;
    if (n > half) {
        if (dim == 3)
            split(3, rows, widest_axis(3, rows, n), (ptrdiff_t)half, (ptrdiff_t)n);
        else
            split(dim, rows, widest_axis(dim, rows, n), (ptrdiff_t)half, (ptrdiff_t)n);
        arrange(dim, rows + (dim + 1) * half, n - half, half);
    }
    arrange(dim, rows, n < half ? n : half, half);
}

static ICCP_INLINE void fill_boxes(iccp_facet_tree *tree, size_t dim, size_t n_corners)
{
    for (size_t node = 0; node < 2 * tree->n_leaves; ++node)
        for (size_t k = 0; k < dim; ++k) {
            tree->boxes[2 * dim * node + k] = HUGE_VAL;
            tree->boxes[2 * dim * node + dim + k] = -HUGE_VAL;
        }
    for (size_t place = 0; place < tree->n; ++place) {
        double box[2 * ICC_MAX_DIM];
        iccp_facet_box_of(tree, dim, n_corners, tree->order[place], box);
        include(dim, tree->boxes + 2 * dim * (tree->n_leaves + place / LEAF), box);
    }
    for (size_t node = 2 * tree->n_leaves; node-- > 2;)
        include(dim, tree->boxes + 2 * dim * (node / 2), tree->boxes + 2 * dim * node);
}

/* `list` tells the facets; NULL: all. */
static ICCP_INLINE void fill_rows(const iccp_facet_tree *tree, size_t dim, size_t n_corners,
                                  const uint32_t *list, double *rows)
{
    for (uint32_t i = 0; i < tree->n; ++i) {
        const uint32_t f = list != NULL ? list[i] : i;
        double box[2 * ICC_MAX_DIM];
        iccp_facet_box_of(tree, dim, n_corners, f, box);
        for (size_t k = 0; k < dim; ++k)
            rows[(dim + 1) * i + k] = box[k] + box[dim + k];
        rows[(dim + 1) * i + dim] = f;
    }
}

/* Builds the tree from dim, n_corners, n, vertices and facets. */
static void make(iccp_facet_tree *tree, const uint32_t *list, const iccp_memory *memory)
{
    const size_t dim = tree->dim, n = tree->n;
    const bool surface = dim == 3 && tree->n_corners == 3;
    tree->n_leaves = 1;
    while (tree->n_leaves * LEAF < n)
        tree->n_leaves *= 2;
    double *rows = iccp_alloc(memory, n, (dim + 1) * sizeof *rows);
    tree->order = iccp_alloc(memory, n, sizeof *tree->order);
    tree->boxes = iccp_alloc(memory, 2 * tree->n_leaves, 2 * dim * sizeof *tree->boxes);
    if (rows == NULL || tree->order == NULL || tree->boxes == NULL) {
        iccp_free(memory, rows);
        iccp_facet_tree_free(tree, memory);
        return;
    }
    if (surface)
        fill_rows(tree, 3, 3, list, rows);
    else
        fill_rows(tree, dim, tree->n_corners, list, rows);
    arrange(dim, rows, n, tree->n_leaves * LEAF);
    for (size_t place = 0; place < n; ++place)
        tree->order[place] = (uint32_t)rows[(dim + 1) * place + dim];
    iccp_free(memory, rows);
    if (surface)
        fill_boxes(tree, 3, 3);
    else
        fill_boxes(tree, dim, tree->n_corners);
}

void iccp_facet_tree_create_some(iccp_facet_tree *tree, size_t dim, const double *vertices,
                                 size_t n, const uint32_t *list, const uint32_t *facets,
                                 const iccp_memory *memory)
{
    *tree = (iccp_facet_tree){
        .dim = dim, .n_corners = dim, .n = n, .vertices = vertices, .facets = facets};
    make(tree, list, memory);
}

void iccp_facet_tree_create(iccp_facet_tree *tree, size_t dim, const double *vertices, size_t n,
                            const uint32_t *facets, const iccp_memory *memory)
{
    iccp_facet_tree_create_some(tree, dim, vertices, n, NULL, facets, memory);
}

void iccp_facet_tree_create_solid(iccp_facet_tree *tree, size_t dim, const double *vertices,
                                  size_t n, const uint32_t *simplices, const iccp_memory *memory)
{
    *tree = (iccp_facet_tree){
        .dim = dim, .n_corners = dim + 1, .n = n, .vertices = vertices, .facets = simplices};
    make(tree, NULL, memory);
}

void iccp_facet_tree_include(iccp_facet_tree *tree, size_t place, const double *box)
{
    for (size_t node = tree->n_leaves + place / LEAF; node > 0; node /= 2)
        include(tree->dim, tree->boxes + 2 * tree->dim * node, box);
}

void iccp_facet_tree_free(iccp_facet_tree *tree, const iccp_memory *memory)
{
    iccp_free(memory, tree->boxes);
    iccp_free(memory, tree->order);
    *tree = (iccp_facet_tree){0};
}
