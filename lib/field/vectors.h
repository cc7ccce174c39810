/* One vector for every vertex of the simplices that meet a domain, uphill in each simplex at the
 * vertex. Interpolated linearly they are a field along which the function rises everywhere. */
#ifndef ICCP_VECTORS_H
#define ICCP_VECTORS_H

#include "field/extension.h"
#include "field/sectors.h"

/* In place of the first coordinate of a vector: see `sectors`. */
#define ICCP_SEVERAL HUGE_VALF

typedef struct iccp_vectors {
    iccp_memory memory;
    const icc_grid *grid; /* borrowed */
    float *vector;        /* dim per vertex: of length 1, but from vertices joined to the root all
                             the way to it, so that the field is radial around it; 0 where none is
                             needed. Exactly these numbers are checked: half the memory, which
                             curves wait for */
    iccp_sectors sectors; /* the vectors of vertices that have several */
    size_t n_vertices;    /* that need one */
    size_t n_infeasible;  /* where no vector is uphill in all simplices */
    size_t n_adjusted;    /* values of the function that were changed to prevent that */
    size_t n_contacts;    /* pairs of a simplex and a facet that runs through it */
    size_t n_not_inward;  /* those of them where a vector does not point inward */
} iccp_vectors;

/* Changes `extension` where it has to. Free it in any case. */
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
