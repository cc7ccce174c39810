/* The floating-point environment that a test calls the library in: a rounding mode, `upward`,
 * `downward` or `zero`; on x86 also `sse` (upward, but for the x87 unit), `ftz` (subnormal numbers
 * flushed to zero) or `traps` (exceptions stop the program). ICC_TEST_MODE names it; without it
 * everything is as usual. With `mixed` each call draws one of these modes.
 *
 * The compiler includes this file ahead of a test program, with a macro for each exported function
 * that returns a status (tests/CMakeLists.txt). So the mode holds during calls only, and what the
 * test itself computes is the same in every mode. Two calls must not stand in one expression whose
 * order C leaves open. */
#ifndef TESTS_MODES_H
#define TESTS_MODES_H

#include <icc/icc.h>
#include <icc/kernel.h>
#include <icc/stages.h>

/* Chooses the mode in place of ICC_TEST_MODE; NULL: as usual. Ends the program if this machine does
 * not have it. Not while calls run. */
void mode_choose(const char *name);

/* Installs the mode. */
void mode_begin(void);

/* Ends the program if the mode is not as mode_begin() left it, or an exception flag is up. Installs
 * the usual environment again, and returns `status`. */
icc_status mode_end(icc_status status, const char *call);

#define IN_MODE(call) (mode_begin(), mode_end(call, #call))

#endif
