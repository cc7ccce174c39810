/* Finds the segments of a set that come close to a segment or a point. */
#ifndef SEGMENT_TREE_H
#define SEGMENT_TREE_H

#include <stddef.h>
#include <stdint.h>

typedef struct segment_tree {
    size_t n, n_leaves; /* a power of two */
    uint32_t *order;    /* the segment of each leaf */
    double (*boxes)[4]; /* nodes 1 .. 2 n_leaves - 1, children 2 i and 2 i + 1: lower, upper */
    uint32_t *found;    /* the result of a query */
    size_t n_found, room_found;
} segment_tree;

/* Sorts n segments, 4 coordinates each. A segment this `near` to a query is always found. */
void segment_tree_make(segment_tree *out, size_t n, const double *segments, double near);
void segment_tree_free(segment_tree *tree);

/* Finds the segments close to a segment in tree->found. Some that are farther away may be among
 * them. */
void segment_tree_ask(segment_tree *tree, const double a[2], const double b[2]);

/* Finds the segments whose boxes, wider by `near`, overlap a box: lower, upper. */
void segment_tree_ask_box(segment_tree *tree, const double box[4]);

#endif
