/* Measures time for reports. */
#define _POSIX_C_SOURCE 200809L
#include "base/clock.h"

#include <time.h>

double iccp_seconds(void)
{
    struct timespec now;
#ifdef CLOCK_MONOTONIC
    clock_gettime(CLOCK_MONOTONIC, &now);
#else
    timespec_get(&now, TIME_UTC); /* C11's clock; it goes back if someone sets the time back */
#endif
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}
