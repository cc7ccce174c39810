/* Follows four curves side by side, with AVX2. See flow_batch.h. */
#include "field/flow_follow.h"

#ifdef ICCP_HAS_SIMD

#define LANES 4
#define TARGET ICCP_AVX2
#include "field/flow_batch.h"

TARGET icc_status iccp_flow_follow4(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                                    const iccp_memory *memory)
{
    return follow_batch(flow, n, curves, memory);
}

#endif
