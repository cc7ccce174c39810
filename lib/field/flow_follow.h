/* Follows many curves, several side by side. This is far faster than one after another, and gives
 * the same bits. Source: docs/theory/charts-space.md, "fields on grids", step 3. */
#ifndef ICCP_FLOW_FOLLOW_H
#define ICCP_FLOW_FOLLOW_H

#include "base/simd.h"
#include "field/flow.h"

typedef struct iccp_flow_curve {
    iccp_flow_place start;
    int32_t sign;  /* +1: to the root; -1: to the boundary */
    double share;  /* uphill: the share of the length at which `place` is wanted; downhill: 0 */
    bool measured; /* true if `volume` is wanted; needs `facet`, where a curve uphill starts */
    /* Results. `status` is ICC_OK, or ICC_ERR_TRACE if the curve cannot continue. */
    icc_status status;
    double length;
    iccp_flow_place place;
    uint32_t facet; /* where a curve downhill leaves the domain */
    double bary[ICC_MAX_DIM];
    /* Logarithm of the volume that a bundle of curves fills, per area on the boundary and per
     * length. It is taken at `place` if uphill, or at the start if downhill. Vectors jump at the
     * facets of the simplices at the root, where curves become straight. Where a curve comes in
     * through such a facet, with the normal m, the volume has two more factors, u . m and
     * 1 / (x . m), for the curve's direction u inside and the vector x outside. These are left
     * out. Only points in the simplices at the root need them. */
    double volume;
} iccp_flow_curve;

/* Returns ICC_ERR_MEMORY or ICC_OK. */
icc_status iccp_flow_follow(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                            const iccp_memory *memory);

/* Follows the curves with the given level of vector instructions, which the processor must have. */
icc_status iccp_flow_follow_as(iccp_simd_level level, const iccp_flow *flow, size_t n,
                               iccp_flow_curve *curves, const iccp_memory *memory);

icc_status iccp_flow_follow2(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                             const iccp_memory *memory);
icc_status iccp_flow_follow4(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                             const iccp_memory *memory);

#endif
