/* A progress bar on stderr, when that is a terminal. One bar stands for all calls of the library
 * that a command makes: each takes a share of what the calls before it have left. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct progress {
    bool wanted;   /* stderr is a terminal, without --quiet */
    bool visible;  /* there is a bar to wipe away */
    double drawn;  /* when it was last drawn, in seconds */
    double before; /* what the calls before the present one were worth */
    double width;  /* what that one is worth */
    double share;  /* how much of it is done */
    double next;   /* share that the next call takes of what is left then; 0: a small one */
} progress;

void progress_start(progress *p, bool quiet);

/* The next call of the library takes the given share of what is left. */
void progress_expect(progress *p, double share);

/* An icc_env::progress callback whose user is a progress. Never cancels. */
int32_t progress_show(void *user, const char *stage, double share);

/* Wipes the bar away. */
void progress_end(progress *p);

#endif
