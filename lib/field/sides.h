/* Several vectors at one vertex: where the outside between two parts of a domain is thinner than
 * the grid, a vertex in it belongs to both, and each has its own. */
#ifndef ICCP_SIDES_H
#define ICCP_SIDES_H

#include "field/cover.h"

enum { ICCP_NO_SIDE = 255 };

typedef struct iccp_sides {
    iccp_memory memory;
    int32_t dim;
    size_t n_simplices; /* at a vertex: (dim + 1)! */
    size_t n, capacity;
    uint32_t *vertex; /* n, rising */
    uint32_t *first;  /* n: of the vectors of each */
    uint8_t *side;    /* n * n_simplices: which of the vectors, or ICCP_NO_SIDE */
    size_t n_vectors, vector_capacity;
    float *vector; /* dim each */
} iccp_sides;

void iccp_sides_init(iccp_sides *sides, int32_t dim, const iccp_memory *memory);
void iccp_sides_free(iccp_sides *sides);

/* The number at a vertex of the simplex with order number r whose corner k the vertex is. */
static inline size_t iccp_side_simplex(int32_t dim, int32_t r, int32_t k)
{
    return (size_t)(r * (dim + 1) + k);
}

/* Which entry is a vertex', or SIZE_MAX. */
size_t iccp_sides_find(const iccp_sides *sides, uint32_t v);

/* Finds the parts that the simplices at a vertex make up, of which `active`, numbered by
 * iccp_side_simplex() like `side`, says which meet the domain: two that share a facet belong
 * together when the domain continues through it. Writes the part of each and returns their number,
 * at most ICCP_NO_SIDE. */
int iccp_sides_split(const iccp_cover *cover, const iccp_orders *orders, uint32_t v,
                     const uint8_t *active, uint8_t *side);

/* Adds a vertex, larger than all before, with vectors 0. */
icc_status iccp_sides_add(iccp_sides *sides, uint32_t v, int n_sides, const uint8_t *side);

#endif
