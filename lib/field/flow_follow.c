/* Chooses the number of curves side by side by the processor. Without vector instructions it
 * follows one curve at a time. */
#include "field/flow_follow.h"

#define LANES 1
#define TARGET
#include "field/flow_batch.h"

icc_status iccp_flow_follow_as(iccp_simd_level level, const iccp_flow *flow, size_t n,
                               iccp_flow_curve *curves, const iccp_memory *memory)
{
#ifdef ICCP_HAS_SIMD
    if (level >= ICCP_SIMD_AVX2)
        return iccp_flow_follow4(flow, n, curves, memory);
    if (level == ICCP_SIMD_SSE42)
        return iccp_flow_follow2(flow, n, curves, memory);
#endif
    (void)level;
    return follow_batch(flow, n, curves, memory);
}

icc_status iccp_flow_follow(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                            const iccp_memory *memory)
{
    return iccp_flow_follow_as(iccp_simd(), flow, n, curves, memory);
}
