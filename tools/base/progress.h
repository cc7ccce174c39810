/* A progress bar on stderr, if that is a terminal. One bar covers all library calls of a command.
 * Each call takes a share of the part that the calls before it have left. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct progress {
    bool wanted;   /* stderr is a terminal, without --quiet */
    bool visible;  /* a bar is visible and must be erased */
    double drawn;  /* when it was last drawn, in seconds */
    double before; /* the part taken by earlier calls */
    double width;  /* the part of the present call */
    double share;  /* the share of the present call that is done */
    double next;   /* the share of the rest that the next call takes; 0: a small one */
} progress;

void progress_start(progress *p, bool quiet);

/* Gives the next call of the library this share of the rest. */
void progress_expect(progress *p, double share);

/* An icc_env::progress callback whose user is a progress. Never cancels. */
int32_t progress_show(void *user, const char *stage, double share);

/* Wipes the bar away. */
void progress_end(progress *p);

#endif
