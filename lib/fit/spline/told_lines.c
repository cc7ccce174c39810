/* Divides told segments. Cells grow with the distance from the ends by the same slope as in the
 * mesh, and a part is at most half as long as the cells beside it are wide. So no vertex of the
 * mesh comes so near to the middle of a part that its triangle would be flat. */
#include "fit/spline/told_lines.h"

#include "base/minmax.h"
#include "math/vec.h"

#include <math.h>

typedef struct divider {
    iccp_told_lines *lines;
    const iccp_frame_region *region;
    double largest; /* width of a cell */
    size_t room;
    uint32_t *walls; /* 2 n_walls */
    size_t n_walls, wall_room;
} divider;

/* Whether the part of a segment from share `from` is short enough. */
static bool fits(const divider *d, const uint32_t ends[2], double length, double from, double part)
{
    const double middle = from + part / 2;
    const double *spacing = d->region->spacing;
    double width = d->largest;
    width = iccp_min(width, spacing[ends[0]] + ICCP_BOX_SLOPE * middle * length);
    width = iccp_min(width, spacing[ends[1]] + ICCP_BOX_SLOPE * (1 - middle) * length);
    return 2 * part * length <= width;
}

static icc_status push_wall(divider *d, uint32_t a, uint32_t b)
{
    if (d->n_walls == d->wall_room) {
        const size_t room = 2 * d->wall_room + 64;
        if (!iccp_enlarge(&d->lines->memory, &d->walls, 2 * d->n_walls, 2 * room, sizeof *d->walls))
            return ICC_ERR_MEMORY;
        d->wall_room = room;
    }
    d->walls[2 * d->n_walls] = a;
    d->walls[2 * d->n_walls++ + 1] = b;
    return ICC_OK;
}

static icc_status push_vertex(divider *d, const uint32_t ends[2], double share)
{
    iccp_told_lines *l = d->lines;
    if (l->n == d->room) {
        const size_t room = 2 * d->room + 64;
        if (!iccp_enlarge(&l->memory, &l->ends, 2 * l->n, 2 * room, sizeof *l->ends) ||
            !iccp_enlarge(&l->memory, &l->share, l->n, room, sizeof *l->share))
            return ICC_ERR_MEMORY;
        d->room = room;
    }
    l->ends[2 * l->n] = ends[0];
    l->ends[2 * l->n + 1] = ends[1];
    l->share[l->n++] = share;
    return ICC_OK;
}

/* Divides a segment at multiples of powers of two. */
static icc_status divide(divider *d, const uint32_t ends[2])
{
    const double *points = d->region->points;
    const double length =
        iccp_vec_distance(2, points + 2 * (size_t)ends[0], points + 2 * (size_t)ends[1]);
    icc_status status = ICC_OK;
    uint32_t last = ends[0];
    for (double at = 0; status == ICC_OK && at < 1;) {
        double part = 1;
        while (floor(at / part) < at / part || !fits(d, ends, length, at, part))
            part /= 2;
        at += part;
        if (at < 1)
            status = push_vertex(d, ends, at);
        const uint32_t next = at < 1 ? (uint32_t)(d->region->n + d->lines->n - 1) : ends[1];
        if (status == ICC_OK)
            status = push_wall(d, last, next);
        last = next;
    }
    return status;
}

icc_status iccp_told_lines_create(iccp_told_lines *lines, const iccp_frame_region *region,
                                  double across, size_t n_segments, const uint32_t *segments,
                                  const iccp_env *env)
{
    *lines = (iccp_told_lines){.memory = env->memory, .walls.memory = env->memory};
    divider d = {.lines = lines, .region = region, .largest = region->size / across};
    iccp_edge_set distinct = {.memory = env->memory};
    icc_status status = iccp_edge_set_add(&distinct, n_segments, segments);
    for (size_t k = 0; status == ICC_OK && k < distinct.n; ++k)
        status = divide(&d, distinct.ends + 2 * k);
    if (status == ICC_OK)
        status = iccp_edge_set_add(&lines->walls, d.n_walls, d.walls);
    iccp_edge_set_free(&distinct);
    iccp_free(&env->memory, d.walls);
    if (status != ICC_OK)
        iccp_told_lines_free(lines);
    return status;
}

void iccp_told_lines_free(iccp_told_lines *lines)
{
    const iccp_memory memory = lines->memory;
    iccp_free(&memory, lines->ends);
    iccp_free(&memory, lines->share);
    iccp_edge_set_free(&lines->walls);
    *lines = (iccp_told_lines){.memory = memory, .walls.memory = memory};
}

void iccp_told_lines_place(const iccp_told_lines *lines, const double *points, double *inside)
{
    for (size_t k = 0; k < lines->n; ++k) {
        const double *a = points + 2 * (size_t)lines->ends[2 * k],
                     *b = points + 2 * (size_t)lines->ends[2 * k + 1], t = lines->share[k];
        for (size_t c = 0; c < 2; ++c)
            inside[2 * k + c] = (1 - t) * a[c] + t * b[c];
    }
}
