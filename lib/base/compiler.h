/* Attributes and hints that compilers spell differently. */
#ifndef ICCP_COMPILER_H
#define ICCP_COMPILER_H

#if defined(__GNUC__)
#if defined(__MINGW32__) && !defined(__clang__)
/* Checks the conversions of C99, such as %zu, instead of those of the old system library. */
#define ICCP_PRINTF(text, first) __attribute__((format(gnu_printf, text, first)))
#else
#define ICCP_PRINTF(text, first) __attribute__((format(printf, text, first)))
#endif
#define ICCP_LIKELY(x) __builtin_expect(!!(x), 1)
#define ICCP_UNLIKELY(x) __builtin_expect(!!(x), 0)
/* Forces inlining, for example to make a copy of a loop for each dimension. When the compiler
 * optimises for size, it decides itself. */
#ifdef __OPTIMIZE_SIZE__
#define ICCP_INLINE inline
#else
#define ICCP_INLINE inline __attribute__((always_inline))
#endif
#define ICCP_PREFETCH(address) __builtin_prefetch(address)
#else
#define ICCP_PRINTF(text, first)
#define ICCP_LIKELY(x) (x)
#define ICCP_UNLIKELY(x) (x)
#define ICCP_INLINE inline
#define ICCP_PREFETCH(address) ((void)(address))
#endif

#endif
