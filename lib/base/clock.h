/* Measures time for reports. No result of the library depends on it. */
#ifndef ICCP_CLOCK_H
#define ICCP_CLOCK_H

/* Seconds on a clock that only moves forward where POSIX is available. */
double iccp_seconds(void);

#endif
