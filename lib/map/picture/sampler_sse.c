/* Kernels for pictures with SSE 4.2: see sampler_lanes.h. */
#include "map/picture/sampler_kernels.h"

#ifdef ICCP_HAS_SIMD

#define WIDE 0
#define TARGET ICCP_SSE42
#include "map/picture/sampler_lanes.h"

const iccp_sampler_kernels *iccp_sampler_sse(const icc_picture *p)
{
    return kernels_for(p);
}

#endif
