/* Walks from face to face towards the direction (O. Devillers, S. Pion, M. Teillaud, Walking in a
 * Triangulation, 2002). The walk begins at a nearby face, which is stored for each cell of a cube's
 * surface. */
#include "match/sphere/drawn_finder.h"

#include "match/surface/drawn_place.h"

#include <math.h>

enum { LEAST_CELLS = 2, MOST_CELLS = 128 };

/* The half-edge of a face that has p farthest to its right, or ICCP_NO_EDGE if p is right of
 * none. */
static uint32_t exit_of(const iccp_half_edges *m, const double *directions, uint32_t face,
                        const double p[3], double *how)
{
    uint32_t exit = ICCP_NO_EDGE;
    *how = 0;
    for (uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const double s = iccp_direction_det(p, directions + 3 * (size_t)m->origin[h],
                                            directions + 3 * (size_t)iccp_edge_end(m, h));
        if (s < *how) {
            *how = s;
            exit = h;
        }
    }
    return exit;
}

/* A walk may go in circles, which is rare, or come to the other side of the sphere. Then all
 * present faces are searched. */
uint32_t iccp_drawn_walk(const iccp_half_edges *m, const double *directions, uint32_t face,
                         const double p[3])
{
    double how;
    for (size_t n = 0; n < m->n_left; ++n) {
        const uint32_t exit = exit_of(m, directions, face, p, &how);
        if (exit == ICCP_NO_EDGE)
            return face;
        face = m->twin[exit] / 3;
    }
    double best = -HUGE_VAL;
    for (size_t v = 0; v < m->n_vertices; ++v) {
        uint32_t h = m->out[v];
        for (uint32_t k = 0; k < m->degree[v]; ++k, h = iccp_edge_turn(m, h)) {
            (void)exit_of(m, directions, h / 3, p, &how);
            if (how > best && iccp_vec_dot(3, p, directions + 3 * v) > 0) {
                best = how;
                face = h / 3;
            }
        }
    }
    return face;
}

/* ---- cells ---- */

static size_t cell_of(const iccp_drawn_finder *f, const double p[3])
{
    int axis = 0;
    for (int k = 1; k < 3; ++k)
        if (fabs(p[k]) > fabs(p[axis]))
            axis = k;
    const double n = (double)f->n, length = fabs(p[axis]);
    size_t cell = (size_t)(2 * axis + (p[axis] < 0));
    for (int k = 1; k < 3; ++k) {
        const double at = 0.5 * n * (1 + p[(axis + k) % 3] / length);
        cell = cell * f->n + (size_t)iccp_min(at, n - 1);
    }
    return cell;
}

static void middle_of(const iccp_drawn_finder *f, size_t cell, double p[3])
{
    const size_t side = cell / (f->n * f->n), axis = side / 2;
    const size_t at[2] = {cell / f->n % f->n, cell % f->n};
    p[axis] = side % 2 == 0 ? 1 : -1;
    for (size_t k = 0; k < 2; ++k)
        p[(axis + k + 1) % 3] = (2 * (double)at[k] + 1) / (double)f->n - 1;
    const double length = iccp_vec_norm(3, p);
    for (int k = 0; k < 3; ++k)
        p[k] /= length;
}

icc_status iccp_drawn_finder_create(iccp_drawn_finder *f, const iccp_half_edges *m,
                                    const double *directions, const iccp_memory *memory)
{
    const double n = sqrt((double)m->n_faces / 12);
    *f = (iccp_drawn_finder){.m = m, .directions = directions};
    f->n = (size_t)iccp_max(LEAST_CELLS, iccp_min(MOST_CELLS, n));
    f->near = iccp_alloc(memory, 6 * f->n * f->n, sizeof *f->near);
    if (f->near == NULL)
        return ICC_ERR_MEMORY;
    uint32_t face = 0;
    for (size_t cell = 0; cell < 6 * f->n * f->n; ++cell) {
        double p[3];
        middle_of(f, cell, p);
        f->near[cell] = face = iccp_drawn_walk(m, directions, face, p);
    }
    return ICC_OK;
}

void iccp_drawn_finder_free(iccp_drawn_finder *f, const iccp_memory *memory)
{
    iccp_free(memory, f->near);
    *f = (iccp_drawn_finder){0};
}

uint32_t iccp_drawn_find(const iccp_drawn_finder *f, const double p[3])
{
    return iccp_drawn_walk(f->m, f->directions, f->near[cell_of(f, p)], p);
}
