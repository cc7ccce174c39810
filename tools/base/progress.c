#define _POSIX_C_SOURCE 200809L

#include "base/progress.h"

#include <stdio.h>
#include <time.h>
#include <unistd.h>

double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_start(progress *p, bool quiet)
{
    *p = (progress){.wanted = !quiet && isatty(STDERR_FILENO), .drawn = seconds_now()};
}

int32_t progress_show(void *user, const char *stage, double share)
{
    static const char full[] = "##############################",
                      none[] = "                              ";
    progress *p = user;
    /* Ten pictures a second, the first after a tenth: short jobs show no bar at all. */
    if (!p->wanted || seconds_now() - p->drawn < 0.1)
        return 0;
    int width = (int)sizeof full - 1;
    int done = (int)((double)width * (share > 1 ? 1 : share > 0 ? share : 0));
    fprintf(stderr, "\r[%.*s%.*s] %3.0f %% %-24.24s", done, full, width - done, none, 100 * share,
            stage);
    fflush(stderr);
    p->drawn = seconds_now();
    p->visible = true;
    return 0;
}

void progress_end(progress *p)
{
    if (p->visible)
        fputs("\r\033[K", stderr);
    p->visible = false;
}
