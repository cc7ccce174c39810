/* A tree of bounding boxes over the facets of a boundary or the simplices of a mesh, in any
 * dimension. */
#ifndef ICCP_FACET_TREE_H
#define ICCP_FACET_TREE_H

#include "base/compiler.h"
#include "base/memory.h"
#include "icc/base.h"

#include <stdbool.h>

/* Facets in a leaf, and a number of levels that no tree has. */
enum { ICCP_FACET_LEAF = 4, ICCP_FACET_LEVELS = 64 };

/* A complete binary tree stored as a heap, like geometry/boxtree.h for polygons. Node 1 is the
 * root. Leaf n_leaves + j holds places 4 j to 4 j + 3, and order[] tells which facet is at each
 * place. */
typedef struct iccp_facet_tree {
    size_t dim, n_corners, n;
    const double *vertices; /* borrowed: dim coordinates each */
    const uint32_t *facets; /* borrowed: n_corners each, which is dim */
    size_t n_leaves;
    double *boxes;   /* per node 2 dim numbers: lower, upper; NULL: queries visit every node */
    uint32_t *order; /* n: facet at each place; NULL: place and facet have the same number */
} iccp_facet_tree;

static inline uint32_t iccp_facet_at(const iccp_facet_tree *tree, size_t place)
{
    return tree->order != NULL ? tree->order[place] : (uint32_t)place;
}

/* Makes the tree. tree->boxes is NULL if there is no memory. */
void iccp_facet_tree_create(iccp_facet_tree *tree, size_t dim, const double *vertices,
                            size_t n_facets, const uint32_t *facets, const iccp_memory *memory);
/* Like iccp_facet_tree_create(), over n of the facets: list[0], list[1], .. in rising order. */
void iccp_facet_tree_create_some(iccp_facet_tree *tree, size_t dim, const double *vertices,
                                 size_t n, const uint32_t *list, const uint32_t *facets,
                                 const iccp_memory *memory);
/* Like iccp_facet_tree_create(), over simplices with dim + 1 corners each. They are also called
 * facets below. */
void iccp_facet_tree_create_solid(iccp_facet_tree *tree, size_t dim, const double *vertices,
                                  size_t n_simplices, const uint32_t *simplices,
                                  const iccp_memory *memory);
/* Announces that the facet at a place will move within `box`. Boxes only grow, so its former region
 * stays covered. */
void iccp_facet_tree_include(iccp_facet_tree *tree, size_t place, const double *box);
void iccp_facet_tree_free(iccp_facet_tree *tree, const iccp_memory *memory);

/* The corners of a facet. */
static inline void iccp_facet_corners(const iccp_facet_tree *tree, uint32_t facet,
                                      const double **corners)
{
    for (size_t i = 0; i < tree->dim; ++i)
        corners[i] = tree->vertices + tree->dim * tree->facets[tree->dim * facet + i];
}

/* Computes the bounding box of a facet: lower, then upper. Pass dim = tree->dim and n_corners
 * likewise; where the compiler knows that dim is 3, it unrolls the loop. */
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

/* Lists the facets whose boxes meet or touch a given box. */
typedef struct iccp_facet_query {
    const iccp_facet_tree *tree;
    double box[2 * ICC_MAX_DIM]; /* may shrink at any time */
    const double *from, *to;     /* if not NULL: only boxes near this segment */
    double reach;                /* how near; 0: up to rounding */
    size_t node;                 /* node to visit after the leaf; 0: none */
    size_t next, end;            /* places of the current leaf that are still to be visited */
} iccp_facet_query;

/* Starts a query. Facets come in the order of the tree. `box` has 2 dim numbers: lower, upper. */
void iccp_facet_query_start(iccp_facet_query *query, const iccp_facet_tree *tree,
                            const double *box);

/* Starts a query with the box of the facet at a place, for later places only. */
void iccp_facet_query_start_after(iccp_facet_query *query, const iccp_facet_tree *tree,
                                  size_t place);

bool iccp_facet_query_next(iccp_facet_query *query, uint32_t *facet);

/* Returns the facet nearest to a finite p, the first if there are several. Also returns the
 * barycentric coordinates of the nearest point and the squared distance. */
uint32_t iccp_facet_tree_nearest(const iccp_facet_tree *tree, const double *p, double *bary,
                                 double *distance2);

/* Like iccp_facet_tree_nearest(), for a tree in local coordinates and a point from
 * iccp_away_reach(), near or far. */
uint32_t iccp_facet_tree_nearest_local(const iccp_facet_tree *tree, const double *p, double *bary);

#endif
