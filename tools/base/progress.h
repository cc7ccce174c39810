/* A progress bar on stderr, when that is a terminal. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct progress {
    bool wanted;  /* stderr is a terminal, and nobody asked for quiet */
    bool visible; /* there is a bar to wipe away */
    double drawn; /* when it was last drawn, in seconds */
} progress;

void progress_start(progress *p, bool quiet);

/* An icc_env::progress callback whose user is a progress. Never cancels. */
int32_t progress_show(void *user, const char *stage, double share);

/* Wipes the bar away. */
void progress_end(progress *p);

/* Seconds on a clock that only goes forward. */
double seconds_now(void);

#endif
