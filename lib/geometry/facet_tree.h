/* A tree of bounding boxes over the facets of a boundary, or the simplices of a mesh, in any
 * dimension. */
#ifndef ICCP_FACET_TREE_H
#define ICCP_FACET_TREE_H

#include "base/compiler.h"
#include "base/memory.h"
#include "icc/base.h"

#include <stdbool.h>

enum { ICCP_FACET_LEAF = 4 };

/* A complete binary tree stored as a heap, as geometry/boxtree.h has it for polygons: node 1 is the
 * root, leaf n_leaves + j holds places 4 j to 4 j + 3, and order[] says which facets stand
 * there. */
typedef struct iccp_facet_tree {
    size_t dim, n_corners, n;
    const double *vertices; /* borrowed: dim coordinates each */
    const uint32_t *facets; /* borrowed: n_corners each, which is dim */
    size_t n_leaves;
    double *boxes;   /* 2 dim numbers a node: lower, upper; or NULL: every node is looked into */
    uint32_t *order; /* n: the facet at each place; or NULL: the one with its number */
} iccp_facet_tree;

static inline uint32_t iccp_facet_at(const iccp_facet_tree *tree, size_t place)
{
    return tree->order != NULL ? tree->order[place] : (uint32_t)place;
}

/* tree->boxes is NULL if there is no memory. */
void iccp_facet_tree_create(iccp_facet_tree *tree, size_t dim, const double *vertices,
                            size_t n_facets, const uint32_t *facets, const iccp_memory *memory);
/* The same over simplices with dim + 1 corners each, which are then called facets as well. */
void iccp_facet_tree_create_solid(iccp_facet_tree *tree, size_t dim, const double *vertices,
                                  size_t n_simplices, const uint32_t *simplices,
                                  const iccp_memory *memory);
/* The facet at a place will be within such a box, or where it has been: boxes only grow. */
void iccp_facet_tree_include(iccp_facet_tree *tree, size_t place, const double *box);
void iccp_facet_tree_free(iccp_facet_tree *tree, const iccp_memory *memory);

/* The corners of a facet. */
static inline void iccp_facet_corners(const iccp_facet_tree *tree, uint32_t facet,
                                      const double **corners)
{
    for (size_t i = 0; i < tree->dim; ++i)
        corners[i] = tree->vertices + tree->dim * tree->facets[tree->dim * facet + i];
}

/* Its bounding box, lower and upper, for dim = tree->dim and so on: where the compiler knows that
 * it is 3 it need not loop. */
static ICCP_INLINE void iccp_facet_box_of(const iccp_facet_tree *tree, size_t dim, size_t n_corners,
                                          uint32_t facet, double *box)
{
    const uint32_t *corner = tree->facets + n_corners * facet;
    for (size_t k = 0; k < dim; ++k)
        box[k] = box[dim + k] = tree->vertices[dim * corner[0] + k];
    for (size_t i = 1; i < n_corners; ++i)
        for (size_t k = 0; k < dim; ++k) {
            const double x = tree->vertices[dim * corner[i] + k];
            box[k] = x < box[k] ? x : box[k];
            box[dim + k] = x > box[dim + k] ? x : box[dim + k];
        }
}

static inline void iccp_facet_box(const iccp_facet_tree *tree, uint32_t facet, double *box)
{
    iccp_facet_box_of(tree, tree->dim, tree->n_corners, facet, box);
}

/* Lists the facets whose boxes meet a given one, touching included. */
typedef struct iccp_facet_query {
    const iccp_facet_tree *tree;
    double box[2 * ICC_MAX_DIM]; /* may be made smaller at any time */
    const double *from, *to;     /* with a segment: only boxes that come near it; or NULL */
    size_t node;                 /* to continue with after the leaf; 0: none */
    size_t next, end;            /* places of the current leaf yet to be looked at */
} iccp_facet_query;

/* In the order of the tree. `box`: 2 dim numbers, lower and upper. */
void iccp_facet_query_start(iccp_facet_query *query, const iccp_facet_tree *tree,
                            const double *box);

/* For the box of the facet at a place, and only facets at later places. */
void iccp_facet_query_start_after(iccp_facet_query *query, const iccp_facet_tree *tree,
                                  size_t place);

bool iccp_facet_query_next(iccp_facet_query *query, uint32_t *facet);

/* The facet nearest to a finite p (of several, the first), the barycentric coordinates of the
 * nearest point on it, and the squared distance. */
uint32_t iccp_facet_tree_nearest(const iccp_facet_tree *tree, const double *p, double *bary,
                                 double *distance2);

/* The same for a tree in local coordinates and a point from iccp_away_reach(), near or far. */
uint32_t iccp_facet_tree_nearest_local(const iccp_facet_tree *tree, const double *p, double *bary);

#endif
