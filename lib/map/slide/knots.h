/* The knots along which the chains of two domains correspond. */
#ifndef ICCP_KNOTS_H
#define ICCP_KNOTS_H

#include "base/blob.h"
#include "map/slide/chains.h"

/* A pair of places on a chain. The last knot of a chain of n sides is
 * {{n, n}, {0, 0}}. */
typedef struct iccp_knot {
    uint32_t at[2];  /* before and after the map: the side, counted along the chain */
    double along[2]; /* the place on that side, along the chain, in [0, 1) */
} iccp_knot;

/* A slide never changes once it is made. */
typedef struct iccp_slide {
    iccp_memory memory;
    icc_domain *given[2]; /* the domains without added vertices */
    iccp_chains chains;
    size_t *first; /* chains.n + 1: where the knots of each chain begin */
    iccp_knot *knot;
} iccp_slide;

/* Begins a slide with room for n_knots. The caller fills in `first`, which is all 0, and `knot`. */
icc_status iccp_slide_begin(iccp_slide **out, const icc_domain *source, const icc_domain *target,
                            size_t n_knots, const iccp_memory *memory);

/* Makes the slide in which no vertex has slid. */
icc_status iccp_slide_create(iccp_slide **out, const icc_domain *source, const icc_domain *target,
                             const iccp_memory *memory);

/* Makes the same slide for another target. */
icc_status iccp_slide_copy(iccp_slide **out, const iccp_slide *slide, const icc_domain *target,
                           const iccp_memory *memory);
void iccp_slide_free(iccp_slide *slide);

static inline bool iccp_knot_is_corner(const iccp_knot *knot, int side)
{
    return !(knot->along[side] > 0);
}

/* Whether a corner goes to the same corner. */
static inline bool iccp_knot_stays(const iccp_knot *knot)
{
    return knot->at[0] == knot->at[1] && iccp_knot_is_corner(knot, 0) &&
           iccp_knot_is_corner(knot, 1);
}

/* Returns the number of corners whose image is not the same corner. Corners in one place count
 * once. */
size_t iccp_slide_count(const iccp_slide *slide);

/* Reads or writes the knots. When it reads, it makes the slide between the domains, and refuses
 * knots that are not valid. */
icc_status iccp_slide_visit(iccp_blob *b, iccp_slide **slide, const icc_domain *source,
                            const icc_domain *target, const iccp_memory *memory);

#endif
