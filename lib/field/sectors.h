/* Several vectors at one vertex. A vertex in a gap that is thinner than the grid belongs to the
 * parts of the domain on both sides. It has one vector for each part. A sector is such a part, as
 * seen from the vertex.
 *
 * Source: docs/theory/charts-space.md, "fields on grids". */
#ifndef ICCP_SECTORS_H
#define ICCP_SECTORS_H

#include "field/incidence.h"

enum { ICCP_NO_SECTOR = 255 };

typedef struct iccp_sectors {
    iccp_memory memory;
    int32_t dim;
    size_t n_simplices; /* number of simplices at a vertex: (dim + 1)! */
    size_t n, capacity;
    uint32_t *vertex; /* n vertices, in rising order */
    uint32_t *first;  /* n: number of each vertex's first vector */
    uint8_t *sector;  /* n * n_simplices: which of the vertex's vectors, or ICCP_NO_SECTOR */
    size_t n_vectors, vector_capacity;
    float *vector; /* dim numbers for each vector */
} iccp_sectors;

void iccp_sectors_init(iccp_sectors *sectors, int32_t dim, const iccp_memory *memory);
void iccp_sectors_free(iccp_sectors *sectors);

/* Number of a simplex at a vertex: the one with order number r that has the vertex as corner k. */
static inline size_t iccp_sector_simplex(int32_t dim, int32_t r, int32_t k)
{
    return (size_t)(r * (dim + 1) + k);
}

/* The entry of a vertex, or SIZE_MAX. */
size_t iccp_sectors_find(const iccp_sectors *sectors, uint32_t v);

/* Divides the simplices at a vertex into parts. `active` and `sector` are numbered by
 * iccp_sector_simplex(), and `active` marks the simplices that meet the domain. Two simplices
 * with a common facet belong together if the domain continues through it. Writes the part of
 * each and returns the number of parts, at most ICCP_NO_SECTOR. */
int iccp_sectors_split(const iccp_incidence *incidence, const iccp_orders *orders, uint32_t v,
                       const uint8_t *active, uint8_t *sector);

/* Adds a vertex with zero vectors. It must be larger than all vertices added earlier. */
icc_status iccp_sectors_add(iccp_sectors *sectors, uint32_t v, int n_sectors,
                            const uint8_t *sector);

#endif
