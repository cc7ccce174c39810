/* Compares the classes of two regions on their common surface. */
#ifndef ICCP_WITNESS_H
#define ICCP_WITNESS_H

#include "map/topology/region_pair.h"

/* What a witness looks like. Without partners it is a loop of its component that bounds in region
 * `inside`, but not in the other one. With partners, the loop bounds in region `inside` together
 * with loops of these other components, and no such loops bound together with it in the other
 * region. */
typedef struct iccp_witness {
    iccp_memory memory;
    bool exists; /* false: the same loops bound in both regions; then nothing else is set */
    int inside;
    uint32_t component;
    size_t n_partners;
    uint32_t *partners;
    /* Values at the edges of the surface. A loop of the component for which `zero` has sum 0 and
     * `other` another sum is a witness, but for a random failure. */
    uint64_t *zero, *other;
    /* Classes of the region `inside` whose sums along all loops of partners are 0. `zero` is one of
     * them. A witness has sum 0 for each. */
    size_t n_zeros;
    uint64_t *zeros; /* n_zeros * classes[inside].n coefficients */
    /* A few loops of the component (iccp_region_surface): a combination of them is a witness. */
    size_t n_starts;
    uint32_t *starts;
} iccp_witness;

/* Finds the components of a witness, as few as possible, and its classes. Time is cubic in the
 * number of handles. Returns ICC_OK or ICC_ERR_MEMORY. */
icc_status iccp_witness_find(iccp_witness *witness, iccp_region_pair *pair);
void iccp_witness_free(iccp_witness *witness);

/* Finds out exactly whether a loop of n vertices, which edges of the surface join, is a witness. */
icc_status iccp_witness_confirm(const iccp_witness *witness, iccp_region_pair *pair, size_t n,
                                const uint32_t *loop, bool *confirmed);

#endif
