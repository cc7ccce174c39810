/* Draws each path as the shortest one through its sequence of gates, by a funnel: D. T. Lee, F. P.
 * Preparata, Euclidean shortest paths in the presence of rectilinear barriers, 1984. Each path has
 * its own gate on each edge that it crosses. The gates on an edge are disjoint and do not reach its
 * ends, so paths meet neither one another nor a vertex. */
#include "map/isotopy/shorten.h"

#include "math/elementary.h"
#include "math/predicates.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* Free margin on either side of a lane, as a share of the path's part of the edge. */
static const double MARGIN = 0.2;

icc_status iccp_lanes_create(iccp_lanes *lanes, const iccp_path_search *r)
{
    const size_t n = r->domains->n, n_corners = 3 * r->domains->mesh[r->side].n_triangles;
    lanes->share = iccp_alloc_zero(&r->memory, r->n_vertices - n, 2 * sizeof *lanes->share);
    if (lanes->share == NULL)
        return ICC_ERR_MEMORY;
    for (size_t e = 0; e < n_corners; ++e) {
        size_t n_lanes = 0, rank = 0;
        for (uint32_t v = r->first[e]; v != NONE; v = r->crossing[v - n].next)
            ++n_lanes;
        for (uint32_t v = r->first[e]; v != NONE; v = r->crossing[v - n].next, ++rank) {
            double *share = lanes->share + 2 * (v - n);
            share[0] = ((double)rank + MARGIN) / (double)n_lanes;
            share[1] = ((double)rank + 1 - MARGIN) / (double)n_lanes;
        }
    }
    return ICC_OK;
}

void iccp_lanes_free(iccp_lanes *lanes, const iccp_memory *memory)
{
    iccp_free(memory, lanes->share);
    lanes->share = NULL;
}

icc_status iccp_polyline_add(iccp_polyline *line, const double p[2], const iccp_memory *memory)
{
    if (line->n == line->room) {
        const size_t room = 2 * line->room + 8;
        double *points = iccp_grow(memory, line->points, 2 * line->n, 2 * room, sizeof *points);
        if (points == NULL)
            return ICC_ERR_MEMORY;
        line->points = points;
        line->room = room;
    }
    memcpy(line->points + 2 * line->n++, p, 2 * sizeof *p);
    return ICC_OK;
}

double iccp_distance_between(const double *points, uint32_t a, uint32_t b)
{
    const double *p = points + 2 * (size_t)a, *q = points + 2 * (size_t)b;
    return iccp_hypot(q[0] - p[0], q[1] - p[1]);
}

double iccp_polyline_length(const iccp_polyline *line)
{
    double length = 0;
    for (uint32_t k = 1; k < line->n; ++k)
        length += iccp_distance_between(line->points, k - 1, k);
    return length;
}

void iccp_polyline_free(iccp_polyline *line, const iccp_memory *memory)
{
    iccp_free(memory, line->points);
    *line = (iccp_polyline){0};
}

/* The right and the left end of a crossing's lane. */
static void gate_of(const iccp_path_search *r, const iccp_lanes *lanes, uint32_t vertex,
                    double gate[2][2])
{
    const size_t k = vertex - r->domains->n;
    const iccp_crossing *c = &r->crossing[k];
    const uint32_t *v = r->domains->mesh[r->side].vertex;
    const double *a = r->points + 2 * (size_t)v[iccp_after(c->edge)];
    const double *b = r->points + 2 * (size_t)v[iccp_before(c->edge)];
    for (int side = 0; side < 2; ++side) {
        const double share = lanes->share[2 * k + (size_t)(c->is_forward ? side : 1 - side)];
        for (int d = 0; d < 2; ++d)
            gate[side][d] = a[d] + share * (b[d] - a[d]);
    }
}

/* Returns true if p lies right (side 0) or left (side 1) of the ray from a to b, or on it. */
static bool is_beyond(const double *a, const double *b, const double *p, int side)
{
    const double area = iccp_area2d(a, b, p);
    return side == 0 ? area <= 0 : area >= 0;
}

/* Turns gates into bends. The funnel begins at its apex, and everything visible from there lies
 * between its two sides. When one side passes the other, the end of the other side is the next bend
 * and becomes the apex. */
static icc_status pull(iccp_polyline *line, const double (*gates)[2][2], size_t n,
                       const double from[2], const iccp_memory *memory)
{
    const double *apex = from, *end[2] = {from, from};
    size_t at[2] = {0, 0};
    icc_status status = ICC_OK;
    for (size_t k = 0; status == ICC_OK && k < n; ++k)
        for (int side = 0; side < 2; ++side) {
            const double *p = gates[k][side];
            /* The gate does not narrow this side. */
            if (end[side] != apex && !is_beyond(apex, end[side], p, 1 - side))
                continue;
            if (end[1 - side] == apex || is_beyond(apex, end[1 - side], p, side)) {
                end[side] = p;
                at[side] = k;
                continue;
            }
            status = iccp_polyline_add(line, end[1 - side], memory);
            apex = end[1 - side];
            k = at[1 - side];
            end[0] = end[1] = apex;
            at[0] = at[1] = k;
            break;
        }
    return status;
}

icc_status iccp_shorten_path(iccp_polyline *line, const iccp_path_search *r,
                             const iccp_lanes *lanes, size_t path)
{
    const iccp_path_ends *ends = &r->path[path];
    const double *from = r->points + 2 * (size_t)ends->vertex[0];
    const double *to = r->points + 2 * (size_t)ends->vertex[1];
    double(*gates)[2][2] = iccp_alloc(&r->memory, (size_t)ends->n + 1, sizeof *gates);
    size_t n = 0;
    if (gates == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = ends->first; v < ends->first + ends->n && !ends->is_straight; ++v)
        if (r->crossing[v - r->domains->n].edge != NONE)
            gate_of(r, lanes, v, gates[n++]);
    memcpy(gates[n][0], to, 2 * sizeof *to);
    memcpy(gates[n++][1], to, 2 * sizeof *to);
    icc_status status = iccp_polyline_add(line, from, &r->memory);
    if (status == ICC_OK)
        status = pull(line, (const double(*)[2][2])gates, n, from, &r->memory);
    if (status == ICC_OK)
        status = iccp_polyline_add(line, to, &r->memory);
    iccp_free(&r->memory, gates);
    return status;
}
