/* Many curves at once, several side by side: faster by far than one after another, and the same
 * bits. */
#ifndef ICCP_FLOW_FOLLOW_H
#define ICCP_FLOW_FOLLOW_H

#include "base/simd.h"
#include "field/flow.h"

typedef struct iccp_flow_curve {
    iccp_flow_place start;
    int32_t sign;  /* +1: to the root; -1: to the boundary */
    double share;  /* of the length, where `place` is wanted: of a curve uphill; else 0 */
    bool measured; /* whether `volume` is wanted; needs `facet`, where a curve uphill starts */
    /* Found. ICC_OK, or ICC_ERR_TRACE when it cannot continue. */
    icc_status status;
    double length;
    iccp_flow_place place;
    uint32_t facet; /* where a curve downhill leaves the domain */
    double bary[ICC_MAX_DIM];
    /* The logarithm of the volume that a bundle of curves fills, per its area on the boundary and
     * length: at `place`, or where a curve downhill starts. Of its two factors that are not
     * continuous where the vectors are not, it lacks those. */
    double volume;
} iccp_flow_curve;

/* ICC_ERR_MEMORY or ICC_OK. */
icc_status iccp_flow_follow(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                            const iccp_memory *memory);

/* At a level that the processor has. */
icc_status iccp_flow_follow_as(iccp_simd_level level, const iccp_flow *flow, size_t n,
                               iccp_flow_curve *curves, const iccp_memory *memory);

icc_status iccp_flow_follow2(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                             const iccp_memory *memory);
icc_status iccp_flow_follow4(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                             const iccp_memory *memory);

#endif
