/* A binary tree of boxes. Segments are sorted by the Morton codes of their middles, so neighbours
 * in the order are close to each other, and equal numbers of them make up the nodes of a level. */
#include "geo/segment_tree.h"

#include "base/allocate.h"
#include "base/extremes.h"
#include "base/radix_sort.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static void box_of(const double *s, double near, double box[4])
{
    for (size_t k = 0; k < 2; k++) {
        box[k] = lesser(s[k], s[2 + k]) - near;
        box[2 + k] = greater(s[k], s[2 + k]) + near;
    }
}

static void join(double box[4], const double other[4])
{
    for (size_t k = 0; k < 2; k++) {
        box[k] = lesser(box[k], other[k]);
        box[2 + k] = greater(box[2 + k], other[2 + k]);
    }
}

/* Puts the bits of the cell's two numbers in turn. */
static uint64_t morton_code(const double box[4], const double all[4])
{
    enum { BITS = 31 };
    uint64_t code = 0, cell[2];
    for (size_t k = 0; k < 2; k++) {
        double size = all[2 + k] - all[k], share = (box[k] / 2 + box[2 + k] / 2 - all[k]) / size;
        cell[k] = size > 0 && share > 0 ? (uint64_t)ldexp(lesser(share, 1), BITS) : 0;
    }
    for (int bit = BITS; bit >= 0; bit--)
        code = code << 2 | (cell[0] >> bit & 1) << 1 | (cell[1] >> bit & 1);
    return code;
}

static const double EMPTY[4] = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

static void sort_segments(segment_tree *t, const double *segments)
{
    keyed *list = need(t->n, sizeof *list);
    double all[4], box[4];
    memcpy(all, EMPTY, sizeof all);
    for (size_t i = 0; i < t->n; i++) {
        box_of(segments + 4 * i, 0, box);
        join(all, box);
    }
    for (size_t i = 0; i < t->n; i++) {
        box_of(segments + 4 * i, 0, box);
        list[i] = (keyed){morton_code(box, all), (uint32_t)i};
    }
    radix_sort(t->n, list);
    for (size_t i = 0; i < t->n; i++)
        t->order[i] = list[i].item;
    free(list);
}

void segment_tree_make(segment_tree *out, size_t n, const double *segments, double near)
{
    *out = (segment_tree){.n = n, .n_leaves = 1};
    while (out->n_leaves < n)
        out->n_leaves *= 2;
    out->order = need(n, sizeof *out->order);
    out->boxes = need(2 * out->n_leaves, sizeof *out->boxes);
    sort_segments(out, segments);
    for (size_t i = 0; i < out->n_leaves; i++)
        if (i < n)
            box_of(segments + 4 * (size_t)out->order[i], near, out->boxes[out->n_leaves + i]);
        else
            memcpy(out->boxes[out->n_leaves + i], EMPTY, sizeof EMPTY);
    for (size_t i = out->n_leaves - 1; i > 0; i--) {
        memcpy(out->boxes[i], out->boxes[2 * i], sizeof EMPTY);
        join(out->boxes[i], out->boxes[2 * i + 1]);
    }
}

void segment_tree_free(segment_tree *tree)
{
    free(tree->order);
    free(tree->boxes);
    free(tree->found);
    *tree = (segment_tree){0};
}

static bool overlaps(const double a[4], const double b[4])
{
    return a[0] <= b[2] && b[0] <= a[2] && a[1] <= b[3] && b[1] <= a[3];
}

/* True if a segment comes close to a box: their own boxes overlap, and the line does not pass
 * beside the box. */
static bool meets(const double box[4], const double a[2], const double b[2])
{
    for (size_t k = 0; k < 2; k++)
        if (greater(a[k], b[k]) < box[k] || lesser(a[k], b[k]) > box[2 + k])
            return false;
    double dx = b[0] - a[0], dy = b[1] - a[1];
    double x = box[0] / 2 + box[2] / 2 - a[0], y = box[1] / 2 + box[3] / 2 - a[1];
    double reach = fabs(dx) * (box[3] / 2 - box[1] / 2) + fabs(dy) * (box[2] / 2 - box[0] / 2);
    return !(fabs(dx * y - dy * x) > reach);
}

/* Finds what comes close to a segment, or what overlaps a box if there is one. */
static void find(segment_tree *tree, const double *a, const double *b, const double *box)
{
    enum { MAX_DEPTH = 64 };
    size_t stack[MAX_DEPTH], n = 0;
    tree->n_found = 0;
    if (tree->n > 0)
        stack[n++] = 1;
    while (n > 0) {
        size_t at = stack[--n];
        const double *own = tree->boxes[at];
        if (!(box != NULL ? overlaps(own, box) : meets(own, a, b)))
            continue;
        if (at < tree->n_leaves) {
            stack[n++] = 2 * at;
            stack[n++] = 2 * at + 1;
            continue;
        }
        tree->found = grow(tree->found, &tree->room_found, tree->n_found + 1, sizeof *tree->found);
        tree->found[tree->n_found++] = tree->order[at - tree->n_leaves];
    }
}

void segment_tree_ask(segment_tree *tree, const double a[2], const double b[2])
{
    find(tree, a, b, NULL);
}

void segment_tree_ask_box(segment_tree *tree, const double box[4])
{
    find(tree, NULL, NULL, box);
}
