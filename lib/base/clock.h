/* Time for the reports. Nothing in the library depends on it. */
#ifndef ICCP_CLOCK_H
#define ICCP_CLOCK_H

/* Seconds on a clock that only moves forward, where POSIX is at hand. */
double iccp_seconds(void);

#endif
