/* Kernels for pictures with AVX2: see sampler_lanes.h. */
#include "map/picture/sampler_kernels.h"

#ifdef ICCP_HAS_SIMD

#define WIDE 1
#define TARGET ICCP_AVX2
#include "map/picture/sampler_lanes.h"

const iccp_sampler_kernels *iccp_sampler_avx2(const icc_picture *p)
{
    return kernels_for(p);
}

#endif
