/* One vector for every vertex of the simplices that meet a domain, uphill in each simplex at the
 * vertex. Interpolated linearly, the vectors form a field along which the function rises
 * everywhere. Source: docs/theory/charts-space.md, "fields on grids", step 2. */
#ifndef ICCP_VECTORS_H
#define ICCP_VECTORS_H

#include "field/extension.h"
#include "field/sectors.h"

/* Replaces the first coordinate of a vector if the vertex has several; see `sectors`. */
#define ICCP_SEVERAL HUGE_VALF

typedef struct iccp_vectors {
    iccp_memory memory;
    const icc_grid *grid; /* borrowed */
    float *vector;        /* dim numbers per vertex, in general of length 1. The vector of a vertex
                             joined to the root reaches the root, so the field is radial there. 0 if
                             not needed. The checks use exactly these floats, which take half the
                             memory that curves wait for */
    iccp_sectors sectors; /* the vectors of vertices that have several */
    size_t n_vertices;    /* number of vertices that need a vector */
    size_t n_infeasible;  /* number of vertices without an uphill vector */
    size_t n_adjusted;    /* number of function values that were changed to prevent that */
    size_t n_contacts;    /* pairs of a simplex and a facet that runs through it */
    size_t n_not_inward;  /* number of contacts where a vector does not point inward */
} iccp_vectors;

/* Chooses the vectors, and changes `extension` if necessary. Free the vectors in any case. */
icc_status iccp_vectors_create(iccp_vectors *vectors, iccp_extension *extension,
                               const iccp_incidence *incidence, const iccp_env *env);
void iccp_vectors_free(iccp_vectors *vectors);

/* The vector of a vertex that is corner k of the simplex with order number r. */
static inline const float *iccp_vectors_at(const iccp_vectors *vectors, uint32_t v, int32_t r,
                                           int32_t k)
{
    const size_t dim = (size_t)vectors->grid->dim;
    const float *vector = vectors->vector + dim * v;
    if (!(vector[0] >= ICCP_SEVERAL))
        return vector;
    const iccp_sectors *sectors = &vectors->sectors;
    const size_t entry = iccp_sectors_find(sectors, v);
    const uint8_t sector =
        sectors
            ->sector[sectors->n_simplices * entry + iccp_sector_simplex(vectors->grid->dim, r, k)];
    return sectors->vector +
           dim * (sectors->first[entry] + (sector == ICCP_NO_SECTOR ? 0 : sector));
}

#endif
