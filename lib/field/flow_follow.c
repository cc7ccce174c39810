/* One curve at a time, where nothing better is known of the processor; and the choice. */
#include "field/flow_follow.h"

#define LANES 1
#define TARGET
#include "field/flow_batch.h"

int iccp_flow_kinds(void)
{
#ifdef ICCP_FLOW_HAS_LANES
    return __builtin_cpu_supports("avx2") ? 3 : __builtin_cpu_supports("sse4.2") ? 2 : 1;
#else
    return 1;
#endif
}

icc_status iccp_flow_follow_as(int kind, const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                               const iccp_memory *memory)
{
#ifdef ICCP_FLOW_HAS_LANES
    if (kind == 2)
        return iccp_flow_follow4(flow, n, curves, memory);
    if (kind == 1)
        return iccp_flow_follow2(flow, n, curves, memory);
#endif
    (void)kind;
    return follow_batch(flow, n, curves, memory);
}

icc_status iccp_flow_follow(const iccp_flow *flow, size_t n, iccp_flow_curve *curves,
                            const iccp_memory *memory)
{
    return iccp_flow_follow_as(iccp_flow_kinds() - 1, flow, n, curves, memory);
}
