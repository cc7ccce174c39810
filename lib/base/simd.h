/* Instructions beyond those that every processor has: loops that gain from them are compiled for
 * these as well, and what runs is chosen by iccp_simd(). The bits must be the same. */
#ifndef ICCP_SIMD_H
#define ICCP_SIMD_H

#if defined(__GNUC__) && defined(__x86_64__)
#define ICCP_HAS_SIMD
#define ICCP_SSE42 __attribute__((target("sse4.2")))
#define ICCP_AVX2 __attribute__((target("avx2")))
#define ICCP_AVX512 __attribute__((target("avx512f")))
#endif

/* WebAssembly cannot ask: a module has vectors of 128 bits everywhere or nowhere. */
#ifdef __wasm_simd128__
#define ICCP_HAS_WASM_SIMD
#endif

typedef enum iccp_simd_level {
    ICCP_SIMD_NONE,
    ICCP_SIMD_SSE42,
    ICCP_SIMD_AVX2,
    ICCP_SIMD_AVX512
} iccp_simd_level;

/* The highest level that is used, if the processor has it: CMake's option ICC_SIMD. */
#ifndef ICCP_SIMD_MOST
#define ICCP_SIMD_MOST ICCP_SIMD_AVX512
#endif

/* The highest that this processor has: it has all below, too. */
static inline iccp_simd_level iccp_simd(void)
{
#ifdef ICCP_HAS_SIMD
    const iccp_simd_level level = __builtin_cpu_supports("avx512f")  ? ICCP_SIMD_AVX512
                                  : __builtin_cpu_supports("avx2")   ? ICCP_SIMD_AVX2
                                  : __builtin_cpu_supports("sse4.2") ? ICCP_SIMD_SSE42
                                                                     : ICCP_SIMD_NONE;
    return level < ICCP_SIMD_MOST ? level : ICCP_SIMD_MOST;
#else
    return ICCP_SIMD_NONE;
#endif
}

#endif
