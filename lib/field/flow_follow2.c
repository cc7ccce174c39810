/* Follows two curves side by side, with SSE 4.2. See flow_batch.h. */
#include "field/flow_follow.h"

#ifdef ICCP_HAS_SIMD

#define LANES 2
#define TARGET ICCP_SSE42
#include "field/flow_batch.h"

TARGET icc_status iccp_flow_follow2(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                                    const iccp_memory *memory)
{
    return follow_batch(flow, n, curves, memory);
}

#endif
