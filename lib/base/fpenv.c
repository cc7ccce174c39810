/* Installs C's default floating-point environment and gives the caller's back. On x86 one register
 * holds all relevant settings, and most callers have its default value. Reading it takes two
 * nanoseconds, while C's functions take a hundred. */
#include "base/fpenv.h"

#ifdef ICCP_HAS_FPENV

#ifdef __SSE2_MATH__
#include <xmmintrin.h>

enum { FLAGS = 0x3f, DEFAULT = 0x1f80 }; /* flags of raised exceptions; all exceptions masked */
#endif

void iccp_fpenv_enter(iccp_fpenv *env)
{
#ifdef __SSE2_MATH__
    env->mxcsr = _mm_getcsr();
    env->is_default = (env->mxcsr | FLAGS) == (DEFAULT | FLAGS);
    if (env->is_default)
        return;
#endif
    (void)fegetenv(&env->callers);
    (void)fesetenv(FE_DFL_ENV);
}

void iccp_fpenv_leave(iccp_fpenv *env)
{
#ifdef __SSE2_MATH__
    if (env->is_default) {
        if (_mm_getcsr() != env->mxcsr)
            _mm_setcsr(env->mxcsr);
        return;
    }
#endif
    (void)fesetenv(&env->callers);
}

#endif
