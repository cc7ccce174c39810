/* Vector instructions that not every processor has. Loops that gain from them are also compiled for
 * these, and iccp_simd() chooses at run time. All versions must give the same bits. */
#ifndef ICCP_SIMD_H
#define ICCP_SIMD_H

#if defined(__GNUC__) && defined(__x86_64__)
#define ICCP_HAS_SIMD
#define ICCP_SSE42 __attribute__((target("sse4.2")))
#define ICCP_AVX2 __attribute__((target("avx2")))
#define ICCP_AVX512 __attribute__((target("avx512f")))
#endif

/* WebAssembly has no test at run time: a module uses 128-bit vectors everywhere or nowhere. */
#ifdef __wasm_simd128__
#define ICCP_HAS_WASM_SIMD
#endif

typedef enum iccp_simd_level {
    ICCP_SIMD_NONE,
    ICCP_SIMD_SSE42,
    ICCP_SIMD_AVX2,
    ICCP_SIMD_AVX512
} iccp_simd_level;

/* The highest level that the library uses: CMake's option ICC_SIMD. */
#ifndef ICCP_SIMD_MOST
#define ICCP_SIMD_MOST ICCP_SIMD_AVX512
#endif

/* Returns the highest level that this processor has and the library may use. A processor with one
 * level has all lower ones. */
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
