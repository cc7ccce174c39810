/* Samples with SSE 4.2. */
#include "map/sampler_kernels.h"

#ifdef ICCP_SAMPLER_HAS_LANES

#define WIDE 0
#define TARGET __attribute__((target("sse4.2")))
#include "map/sampler_lanes.h"

const iccp_sampler_kernels *iccp_sampler_sse(const icc_picture *p)
{
    return kernels_for(p);
}

#endif
