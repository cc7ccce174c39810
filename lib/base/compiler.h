/* What compilers spell differently, in one place. */
#ifndef ICCP_COMPILER_H
#define ICCP_COMPILER_H

#if defined(__GNUC__)
#if defined(__MINGW32__) && !defined(__clang__)
/* C99's conversions, %zu among them, and not those of the old system library. */
#define ICCP_PRINTF(text, first) __attribute__((format(gnu_printf, text, first)))
#else
#define ICCP_PRINTF(text, first) __attribute__((format(printf, text, first)))
#endif
#define ICCP_LIKELY(x) __builtin_expect(!!(x), 1)
#define ICCP_UNLIKELY(x) __builtin_expect(!!(x), 0)
/* Copies of a loop for each dimension, say: where small code is asked for, the compiler judges. */
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
