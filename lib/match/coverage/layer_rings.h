/* The rings and pieces of a layer. */
#ifndef ICCP_LAYER_RINGS_H
#define ICCP_LAYER_RINGS_H

#include "geometry/boxtree.h"
#include "match/coverage/layer_graph.h"

/* A ring consists of courses: 2 b along border b, 2 b + 1 against it. */
typedef struct iccp_ring {
    size_t first, n;       /* its courses */
    uint32_t region, walk; /* the walk that it is a part of */
    uint32_t piece;        /* the walk around the same area */
    double area;           /* twice; negative for a hole */
    iccp_box box;
} iccp_ring;

typedef struct iccp_layer_rings {
    const iccp_layer_graph *graph; /* borrowed */
    size_t n;
    size_t n_walks;  /* a piece has the number of one of its walks */
    iccp_ring *ring; /* by region */
    uint32_t *course;
} iccp_layer_rings;

/* Returns place k of a course, 0 <= k <= n for a border of n sides. */
static inline uint32_t iccp_course_place(const iccp_layer_graph *graph, uint32_t course, size_t k)
{
    const iccp_border *const border = &graph->border[course / 2];
    return graph->at[border->first + (course % 2 == 0 ? k : border->n - k)];
}

/* Finds the rings, and the pieces left and right of each border. The caller frees the rings even
 * after an error. */
icc_status iccp_layer_rings_create(iccp_layer_rings *rings, iccp_layer_graph *graph,
                                   const iccp_env *env);
/* Accepts a struct of zeros. */
void iccp_layer_rings_free(iccp_layer_rings *rings, const iccp_memory *memory);

#endif
