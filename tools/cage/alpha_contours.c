/* Marching squares (W. E. Lorensen and H. E. Cline 1987, in the plane). The corners of a square
 * are the centres of four pixels. A contour crosses a side of a square whose ends differ, and
 * runs through the square with the opaque corners to its left as a picture is seen. If two opposite
 * corners are opaque and two are not, the mean of the four decides which are connected. */
#include "cage/alpha_contours.h"

#include "base/allocate.h"

#include <stdlib.h>

/* Squares are numbered by their upper left corner, which may lie one pixel outside. */
typedef struct march {
    const picture *p;
    size_t wide, high; /* squares */
    uint32_t
        *next; /* of each crossing: the crossing that follows, or NONE. Crossing 2 s is on the upper
                          side of square s, crossing 2 s + 1 on its left side */
} march;

#define NONE UINT32_MAX

/* The alpha at the centre of pixel (x - 1, y - 1), from 0 to 1. */
static double alpha(const march *m, size_t x, size_t y)
{
    const picture *p = m->p;
    if (x == 0 || y == 0 || x > p->width || y > p->height)
        return 0;
    size_t pixel = (y - 1) * p->width + x - 1;
    return p->samples[(pixel + 1) * p->channels - 1] / (double)((1u << p->depth) - 1);
}

static size_t square(const march *m, size_t x, size_t y)
{
    return y * m->wide + x;
}

/* Links the crossings of one square. Sides are numbered from the upper one clockwise, and corner k
 * begins side k. */
static void link_square(march *m, size_t x, size_t y)
{
    const double at[4] = {alpha(m, x, y), alpha(m, x + 1, y), alpha(m, x + 1, y + 1),
                          alpha(m, x, y + 1)};
    const size_t crossing[4] = {2 * square(m, x, y), 2 * square(m, x + 1, y) + 1,
                                2 * square(m, x, y + 1), 2 * square(m, x, y) + 1};
    const bool joined = at[0] + at[1] + at[2] + at[3] >= 2; /* opposite opaque corners */
    for (size_t k = 0; k < 4; k++) {
        /* A contour enters where it has the opaque end of the side to its left, .. */
        if (!(at[k] < 0.5 && at[(k + 1) % 4] >= 0.5))
            continue;
        size_t leave = k; /* .. and leaves at the next side, or the one before, that goes back */
        for (size_t step = 1; step < 4; step++) {
            leave = joined ? (k + 4 - step) % 4 : (k + step) % 4;
            if (at[leave] >= 0.5 && at[(leave + 1) % 4] < 0.5)
                break;
        }
        m->next[crossing[k]] = (uint32_t)crossing[leave];
    }
}

static void place(const march *m, size_t crossing, double *out)
{
    size_t s = crossing / 2, x = s % m->wide, y = s / m->wide;
    bool down = crossing % 2 == 1;
    double from = alpha(m, x, y), to = alpha(m, x + !down, y + down);
    double share = (0.5 - from) / (to - from);
    out[0] = (double)x - 0.5 + (down ? 0 : share);
    out[1] = (double)y - 0.5 + (down ? share : 0);
}

/* Follows the contour through a crossing, and takes its links away. */
static void take(march *m, size_t first, alpha_contours *out)
{
    out->firsts[out->n_contours++] = out->n;
    for (size_t at = first, next; m->next[at] != NONE; at = next) {
        next = m->next[at];
        m->next[at] = NONE;
        place(m, at, out->points + 2 * out->n++);
    }
}

alpha_contours alpha_contours_find(const picture *p)
{
    march m = {p, p->width + 2, p->height + 2, NULL};
    size_t n = 2 * m.wide * m.high, n_crossings = 0;
    m.next = need(n, sizeof *m.next);
    for (size_t i = 0; i < n; i++)
        m.next[i] = NONE;
    for (size_t y = 0; y <= p->height; y++)
        for (size_t x = 0; x <= p->width; x++)
            link_square(&m, x, y);
    for (size_t i = 0; i < n; i++)
        n_crossings += m.next[i] != NONE;
    alpha_contours out = {.points = need(2 * n_crossings, sizeof *out.points),
                          .firsts = need(n_crossings / 3 + 1, sizeof *out.firsts)};
    for (size_t i = 0; i < n; i++)
        if (m.next[i] != NONE)
            take(&m, i, &out);
    free(m.next);
    return out;
}

void alpha_contours_free(alpha_contours *c)
{
    free(c->points);
    free(c->firsts);
    *c = (alpha_contours){0};
}
