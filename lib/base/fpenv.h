/* Makes the library compute in C's default floating-point environment, whatever the caller's is. So
 * results have the same bits in each rounding mode, with or without traps, and with or without
 * flushing subnormal numbers to zero.
 *
 * Each exported function that computes begins with ICCP_ENTER, which installs the default. Wherever
 * the function returns, the caller gets its own environment back, including exception flags.
 * Threads that a call starts inherit its environment (POSIX). So only tasks on the caller's threads
 * enter once more. */
#ifndef ICCP_FPENV_H
#define ICCP_FPENV_H

#include <fenv.h>

/* WebAssembly has only one rounding mode. Compilers other than GCC and Clang lack the attribute. */
#if defined(__GNUC__) && defined(FE_UPWARD)
#define ICCP_HAS_FPENV

typedef struct iccp_fpenv {
    fenv_t callers;
    unsigned int mxcsr; /* on x86: the caller's control and status register */
    int is_default;     /* the caller's environment is the default; `callers` is not set */
} iccp_fpenv;

void iccp_fpenv_enter(iccp_fpenv *env);
void iccp_fpenv_leave(iccp_fpenv *env);

#define ICCP_ENTER                                                                                 \
    iccp_fpenv fpenv __attribute__((cleanup(iccp_fpenv_leave)));                                   \
    iccp_fpenv_enter(&fpenv)

#else
#define ICCP_ENTER (void)0
#endif

#endif
