/* Several vectors at one vertex: where the outside between two parts of a domain is thinner than
 * the grid, a vertex in it belongs to both, and each has its own: such a part, as seen from the
 * vertex, is a sector. */
#ifndef ICCP_SECTORS_H
#define ICCP_SECTORS_H

#include "field/incidence.h"

enum { ICCP_NO_SECTOR = 255 };

typedef struct iccp_sectors {
    iccp_memory memory;
    int32_t dim;
    size_t n_simplices; /* at a vertex: (dim + 1)! */
    size_t n, capacity;
    uint32_t *vertex; /* n, rising */
    uint32_t *first;  /* n: of the vectors of each */
    uint8_t *sector;  /* n * n_simplices: which of the vectors, or ICCP_NO_SECTOR */
    size_t n_vectors, vector_capacity;
    float *vector; /* dim each */
} iccp_sectors;

void iccp_sectors_init(iccp_sectors *sectors, int32_t dim, const iccp_memory *memory);
void iccp_sectors_free(iccp_sectors *sectors);

/* The number at a vertex of the simplex with order number r whose corner k the vertex is. */
static inline size_t iccp_sector_simplex(int32_t dim, int32_t r, int32_t k)
{
    return (size_t)(r * (dim + 1) + k);
}

/* Which entry is a vertex', or SIZE_MAX. */
size_t iccp_sectors_find(const iccp_sectors *sectors, uint32_t v);

/* Finds the parts that the simplices at a vertex make up, of which `active`, numbered by
 * iccp_sector_simplex() like `sector`, says which meet the domain: two that share a facet belong
 * together when the domain continues through it. Writes the part of each and returns their number,
 * at most ICCP_NO_SECTOR. */
int iccp_sectors_split(const iccp_incidence *incidence, const iccp_orders *orders, uint32_t v,
                       const uint8_t *active, uint8_t *sector);

/* Adds a vertex, larger than all before, with vectors 0. */
icc_status iccp_sectors_add(iccp_sectors *sectors, uint32_t v, int n_sectors,
                            const uint8_t *sector);

#endif
