/* All classes of a region's first cohomology, modulo the prime of math/residue.h. */
#ifndef ICCP_REGION_CLASSES_H
#define ICCP_REGION_CLASSES_H

#include "map/topology/region_cells.h"
#include "math/residue.h"

/* An edge and the triangle that gives its value. ICCP_NO_FACE: the edge is free. */
typedef struct iccp_plan_step {
    uint32_t edge, face;
} iccp_plan_step;

#define ICCP_NO_FACE UINT32_MAX

typedef struct iccp_region_classes {
    iccp_memory memory;
    const iccp_region_cells *cells; /* borrowed */
    size_t n;                       /* number of classes in a basis */
    size_t n_free;                  /* edges whose values give all others: n, or some more */
    uint64_t *basis;                /* n * n_free: values of the free edges */
    iccp_plan_step *plan;           /* in this order, values follow from those before */
    size_t n_plan;
    uint64_t *value; /* of each edge, for the last class that was evaluated */
    uint64_t *free_value;
} iccp_region_classes;

/* Finds a basis of the classes of a connected region. Returns ICC_OK, ICC_ERR_MEMORY or
 * ICC_ERR_CANCELLED. Time is linear in the cells, times n_free. */
icc_status iccp_region_classes_create(iccp_region_classes *classes, const iccp_region_cells *cells,
                                      const iccp_env *env);
void iccp_region_classes_free(iccp_region_classes *classes);

/* Returns the values of a combination of the basis at all edges, until the next call. */
const uint64_t *iccp_region_class(iccp_region_classes *classes, const uint64_t *coefficients);

/* Returns the value of a class along an edge from vertex `from` to the other end. */
static inline uint64_t iccp_class_along(const uint64_t *value, const uint32_t *ends, size_t edge,
                                        uint32_t from)
{
    const uint64_t x = value[edge];
    return ends[2 * edge] == from ? x : iccp_residue_subtract(0, x);
}

#endif
