#include "modes.h"

#include "../random.h"

#include <fenv.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct mode {
    const char *name;
    int rounding;
    unsigned int control; /* x86's register, where the C library has no name for the mode; or 0 */
} mode;

#ifdef __SSE2__
#include <xmmintrin.h>
/* Traps: all but for subnormal operands and inexact results. */
enum { FLUSH = 0x8040, ROUNDING = 0x6000, UPWARD = 0x4000, MASKS = 0x1f80, TRAPS = 0x0e80 };
#endif

static const mode MODES[] = {{"upward", FE_UPWARD, 0},
                             {"downward", FE_DOWNWARD, 0},
                             {"zero", FE_TOWARDZERO, 0},
#ifdef __SSE2__
                             {"sse", FE_TONEAREST, MASKS | UPWARD},
                             {"ftz", FE_TONEAREST, MASKS | FLUSH},
                             {"traps", FE_TONEAREST, MASKS & ~TRAPS}
#endif
};
enum { N_MODES = sizeof MODES / sizeof *MODES };

static bool is_mixed;
static const mode *chosen; /* the mode of every call; NULL: as usual */

/* The modes of the calls that run on this thread. A callback may call the library again. */
enum { MAX_CALLS = 8 };
static _Thread_local const mode *calls[MAX_CALLS];
static _Thread_local size_t n_calls;
static _Thread_local random_source draws;

void mode_choose(const char *name)
{
    chosen = NULL;
    is_mixed = name != NULL && strcmp(name, "mixed") == 0;
    if (name == NULL || *name == '\0' || is_mixed)
        return;
    for (size_t i = 0; i < N_MODES; ++i)
        if (strcmp(name, MODES[i].name) == 0)
            chosen = &MODES[i];
    if (chosen != NULL)
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
    if (n_calls == MAX_CALLS)
        abort();
    const mode *m = is_mixed ? &MODES[random_below(&draws, N_MODES)] : chosen;
    calls[n_calls++] = m;
    if (m == NULL)
        return;
    (void)fesetround(m->rounding);
    (void)feclearexcept(FE_ALL_EXCEPT);
#ifdef __SSE2__
    if (m->control != 0)
        _mm_setcsr(m->control);
#endif
}

icc_status mode_end(icc_status status, const char *call)
{
    const mode *m = calls[--n_calls];
    if (m == NULL)
        return status;
    bool is_kept = fegetround() == m->rounding && fetestexcept(FE_ALL_EXCEPT) == 0;
#ifdef __SSE2__
    if (m->control != 0)
        is_kept = _mm_getcsr() == m->control;
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
