/* One vector for every vertex of the simplices that meet a domain, uphill in each simplex at the
 * vertex. Interpolated linearly they are a field along which the function rises everywhere. */
#ifndef ICCP_CONES_H
#define ICCP_CONES_H

#include "field/sides.h"
#include "field/smooth.h"

/* In place of the first coordinate of a vector: see `sides`. */
#define ICCP_SEVERAL HUGE_VALF

typedef struct iccp_cones {
    iccp_memory memory;
    const icc_grid *grid; /* borrowed */
    float *vector;        /* dim per vertex: of length 1, but from vertices joined to the root all
                             the way to it, so that the field is radial around it; 0 where none is
                             needed. Exactly these numbers are checked: half the memory, which
                             curves wait for */
    iccp_sides sides;     /* the vectors of vertices that have several */
    size_t n_vertices;    /* that need one */
    size_t n_infeasible;  /* where no vector is uphill in all simplices */
    size_t n_adjusted;    /* values of the function that were changed to prevent that */
    size_t n_contacts;    /* pairs of a simplex and a facet that runs through it */
    size_t n_not_inward;  /* those of them where a vector does not point inward */
} iccp_cones;

/* Changes `smooth` where it has to. Free it in any case. */
icc_status iccp_cones_create(iccp_cones *cones, iccp_smooth *smooth, const iccp_cover *cover,
                             const iccp_env *env);
void iccp_cones_free(iccp_cones *cones);

/* The vector of a vertex that is corner k of the simplex with order number r. */
static inline const float *iccp_cones_vector(const iccp_cones *cones, uint32_t v, int32_t r,
                                             int32_t k)
{
    const size_t dim = (size_t)cones->grid->dim;
    const float *vector = cones->vector + dim * v;
    if (!(vector[0] >= ICCP_SEVERAL))
        return vector;
    const iccp_sides *sides = &cones->sides;
    const size_t entry = iccp_sides_find(sides, v);
    const uint8_t side =
        sides->side[sides->n_simplices * entry + iccp_side_simplex(cones->grid->dim, r, k)];
    return sides->vector + dim * (sides->first[entry] + (side == ICCP_NO_SIDE ? 0 : side));
}

#endif
