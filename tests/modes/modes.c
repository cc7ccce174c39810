#include "modes.h"

#include <fenv.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE2__
#include <xmmintrin.h>
/* Traps: all but for subnormal operands and inexact results. */
enum { FLUSH = 0x8040, ROUNDING = 0x6000, UPWARD = 0x4000, MASKS = 0x1f80, TRAPS = 0x0e80 };
#endif

static bool is_usual = true;
static int rounding = FE_TONEAREST;
static unsigned int control; /* of x86's register, where that is all there is to set; or 0 */

void mode_choose(const char *name)
{
    is_usual = name == NULL || *name == '\0';
    rounding = FE_TONEAREST;
    control = 0;
    if (is_usual)
        return;
#ifdef __SSE2__
    control = strcmp(name, "ftz") == 0     ? MASKS | FLUSH
              : strcmp(name, "sse") == 0   ? MASKS | UPWARD
              : strcmp(name, "traps") == 0 ? MASKS & ~TRAPS
                                           : 0;
#endif
    rounding = strcmp(name, "upward") == 0     ? FE_UPWARD
               : strcmp(name, "downward") == 0 ? FE_DOWNWARD
               : strcmp(name, "zero") == 0     ? FE_TOWARDZERO
                                               : FE_TONEAREST;
    if (control != 0 || rounding != FE_TONEAREST)
        return;
    (void)fprintf(stderr, "there is no mode %s here\n", name);
    exit(EXIT_FAILURE);
}

__attribute__((constructor)) static void read_mode(void)
{
    mode_choose(getenv("ICC_TEST_MODE"));
}

void mode_begin(void)
{
    if (is_usual)
        return;
    (void)fesetround(rounding);
    (void)feclearexcept(FE_ALL_EXCEPT);
#ifdef __SSE2__
    if (control != 0)
        _mm_setcsr(control);
#endif
}

icc_status mode_end(icc_status status, const char *call)
{
    if (is_usual)
        return status;
    bool is_kept = fegetround() == rounding && fetestexcept(FE_ALL_EXCEPT) == 0;
#ifdef __SSE2__
    if (control != 0)
        is_kept = _mm_getcsr() == control;
    else
        is_kept = is_kept && (_mm_getcsr() & ROUNDING) != 0;
#endif
    (void)fesetenv(FE_DFL_ENV);
    if (!is_kept) {
        (void)fprintf(stderr, "the caller's floating-point environment is not kept by %s\n", call);
        abort();
    }
    return status;
}
