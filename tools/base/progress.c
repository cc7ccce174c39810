/* Draws and erases the progress bar. */
#include "base/progress.h"

#include "base/system.h"

#include <stdio.h>
#include <string.h>

/* The share of the rest for a call that was not announced. These calls check cages and masks. */
static const double SMALL = 0.04;

void progress_start(progress *p, bool quiet)
{
    *p = (progress){.wanted = !quiet && system_columns() > 0, .drawn = seconds_now(), .share = 1};
}

void progress_expect(progress *p, double share)
{
    p->next = share;
}

/* Draws "[#####     ]  50 % improve", narrower than the terminal, because a character in the last
 * column may start a new line. On a narrow terminal the bar shrinks, then disappears, then the
 * stage. */
static void draw(const char *stage, double share)
{
    static const char full[] = "##############################";
    int columns = system_columns() - 1, name = (int)strlen(stage);
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
    /* A share that falls means that another call has begun. */
    if (share < p->share || p->width <= 0) {
        p->before += p->width;
        p->width = (1 - p->before) * (p->next > 0 ? p->next : SMALL);
        p->next = 0;
    }
    p->share = share;
    /* Draws ten times a second, first after 0.1 s, so short jobs show no bar. */
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
