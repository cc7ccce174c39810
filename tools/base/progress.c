#define _POSIX_C_SOURCE 200809L

#include "base/progress.h"

#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <time.h>
#include <unistd.h>

/* Of what is left, for a call that was not announced: those that check cages and masks. */
static const double SMALL = 0.04;

double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_start(progress *p, bool quiet)
{
    *p = (progress){.wanted = !quiet && isatty(STDERR_FILENO), .drawn = seconds_now(), .share = 1};
}

void progress_expect(progress *p, double share)
{
    p->next = share;
}

static int columns_of_terminal(void)
{
#ifdef TIOCGWINSZ
    struct winsize size;
    if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
#endif
    return 80;
}

/* "[#####     ]  50 % improve", in fewer columns than the terminal has: the last one may make it go
 * to the next line. Where it is narrow the bar shrinks, then goes, then the stage. */
static void draw(const char *stage, double share)
{
    static const char full[] = "##############################";
    int columns = columns_of_terminal() - 1, name = (int)strlen(stage);
    int bar = columns - 9 - name;
    bar = bar > (int)sizeof full - 1 ? (int)sizeof full - 1 : bar;
    fputs("\r\033[K", stderr);
    if (bar >= 5)
        fprintf(stderr, "[%-*.*s] ", bar, (int)(bar * share), full);
    fprintf(stderr, "%3d %%", (int)(100 * share));
    if (6 + name <= columns)
        fprintf(stderr, " %s", stage);
    fflush(stderr);
}

int32_t progress_show(void *user, const char *stage, double share)
{
    progress *p = user;
    /* A share that falls is the first of another call. */
    if (share < p->share || p->width <= 0) {
        p->before += p->width;
        p->width = (1 - p->before) * (p->next > 0 ? p->next : SMALL);
        p->next = 0;
    }
    p->share = share;
    /* Ten pictures a second, the first after a tenth: short jobs show no bar at all. */
    if (!p->wanted || seconds_now() - p->drawn < 0.1)
        return 0;
    draw(stage, p->before + share * p->width);
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
