/* The graph Laplacian with cotangent weights: U. Pinkall and K. Polthier, Computing discrete
 * minimal surfaces and their conjugates, 1993. On a Delaunay mesh they are not negative. The bounds
 * handle constrained edges, cut triangles and needles. With any positive weights, maps made from
 * them are one-to-one. These weights give them low distortion. */
#include "mesh/laplacian.h"

#include "base/minmax.h"

#include <math.h>

static const double LEAST_WEIGHT = 0.02;

double iccp_half_cotangent(const double *p, const double *a, const double *b)
{
    const double ux = a[0] - p[0], uy = a[1] - p[1], vx = b[0] - p[0], vy = b[1] - p[1];
    const double dot = ux * vx + uy * vy, cross = ux * vy - uy * vx;
    return cross > 0 ? 0.5 * dot / cross : copysign(ICCP_MOST_WEIGHT, dot);
}

static double half_cotangent(const iccp_planar *mesh, uint32_t corner)
{
    return iccp_half_cotangent(mesh->points + 2 * (size_t)mesh->triangles[corner],
                               mesh->points + 2 * (size_t)mesh->triangles[iccp_after(corner)],
                               mesh->points + 2 * (size_t)mesh->triangles[iccp_before(corner)]);
}

static double edge_weight(const iccp_planar *mesh, uint32_t corner)
{
    const double w = half_cotangent(mesh, corner) + half_cotangent(mesh, mesh->twins[corner]);
    return iccp_min(iccp_max(w, LEAST_WEIGHT), ICCP_MOST_WEIGHT);
}

/* Visits an edge of which at least the first vertex is inside. */
typedef void (*edge_visitor)(iccp_laplacian *l, uint32_t n_boundary, uint32_t a, uint32_t b,
                             double weight);

/* Calls `visit` once for every edge with an inner vertex that does not end at `left_out`. So
 * counting and filling visit the same edges in the same order. */
static void visit_edges(iccp_laplacian *l, const iccp_planar *mesh, uint32_t left_out,
                        bool with_weights, edge_visitor visit)
{
    const uint32_t n_boundary = (uint32_t)mesh->n_boundary;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        if (mesh->twins[c] == ICCP_NO_NEIGHBOUR || mesh->twins[c] < c)
            continue;
        uint32_t a = mesh->triangles[iccp_after(c)];
        uint32_t b = mesh->triangles[iccp_before(c)];
        if (a == left_out || b == left_out || (a < n_boundary && b < n_boundary))
            continue;
        if (a < n_boundary) {
            const uint32_t swap = a;
            a = b;
            b = swap;
        }
        visit(l, n_boundary, a, b, with_weights ? edge_weight(mesh, c) : 0);
    }
}

static void count_edge(iccp_laplacian *l, uint32_t n_boundary, uint32_t a, uint32_t b,
                       double weight)
{
    (void)weight;
    if (b < n_boundary) {
        ++l->boundary_first[a - n_boundary];
    } else {
        ++l->first[a - n_boundary];
        ++l->first[b - n_boundary];
    }
}

static void add_entry(iccp_laplacian *l, uint32_t row, uint32_t column, double weight)
{
    const size_t p = --l->first[row];
    l->column[p] = column;
    l->value[p] = -weight;
    l->diagonal[row] += weight;
}

static void add_edge(iccp_laplacian *l, uint32_t n_boundary, uint32_t a, uint32_t b, double weight)
{
    if (b < n_boundary) {
        const size_t p = --l->boundary_first[a - n_boundary];
        l->boundary_vertex[p] = b;
        l->boundary_weight[p] = weight;
        l->diagonal[a - n_boundary] += weight;
    } else {
        add_entry(l, a - n_boundary, b - n_boundary, weight);
        add_entry(l, b - n_boundary, a - n_boundary, weight);
    }
}

static void sum_up(size_t *counts, size_t n)
{
    for (size_t i = 1; i <= n; ++i)
        counts[i] += counts[i - 1];
}

static icc_status allocate_entries(iccp_laplacian *l, size_t n)
{
    const size_t n_entries = l->first[n], n_boundary = l->boundary_first[n];
    l->column = iccp_alloc(&l->memory, n_entries, sizeof *l->column);
    l->value = iccp_alloc(&l->memory, n_entries, sizeof *l->value);
    l->boundary_vertex = iccp_alloc(&l->memory, n_boundary, sizeof *l->boundary_vertex);
    l->boundary_weight = iccp_alloc(&l->memory, n_boundary, sizeof *l->boundary_weight);
    return l->column != NULL && l->value != NULL && l->boundary_vertex != NULL &&
                   l->boundary_weight != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

/* Makes two passes over the edges: the first counts the entries of each row, the second fills them
 * in. */
icc_status iccp_laplacian_create(iccp_laplacian *laplacian, const iccp_planar *mesh,
                                 uint32_t left_out, const iccp_env *env)
{
    const size_t n = mesh->n_vertices - mesh->n_boundary;
    iccp_laplacian *l = laplacian;
    *l = (iccp_laplacian){.memory = env->memory};
    l->first = iccp_alloc_zero(&l->memory, n + 1, sizeof *l->first);
    l->boundary_first = iccp_alloc_zero(&l->memory, n + 1, sizeof *l->boundary_first);
    l->diagonal = iccp_alloc_zero(&l->memory, n, sizeof *l->diagonal);
    icc_status status = ICC_ERR_MEMORY;
    if (l->first != NULL && l->boundary_first != NULL && l->diagonal != NULL) {
        visit_edges(l, mesh, left_out, false, count_edge);
        sum_up(l->first, n);
        sum_up(l->boundary_first, n);
        status = allocate_entries(l, n);
    }
    if (status != ICC_OK) {
        iccp_laplacian_free(l);
        return status;
    }
    visit_edges(l, mesh, left_out, true, add_edge);
    if (left_out != ICCP_NO_NEIGHBOUR)
        l->diagonal[left_out - mesh->n_boundary] = 1;
    l->matrix = (iccp_symmetric){n, l->first, l->column, l->value, l->diagonal};
    return ICC_OK;
}

void iccp_laplacian_free(iccp_laplacian *laplacian)
{
    iccp_laplacian *l = laplacian;
    iccp_free(&l->memory, l->first);
    iccp_free(&l->memory, l->column);
    iccp_free(&l->memory, l->value);
    iccp_free(&l->memory, l->diagonal);
    iccp_free(&l->memory, l->boundary_first);
    iccp_free(&l->memory, l->boundary_vertex);
    iccp_free(&l->memory, l->boundary_weight);
    *l = (iccp_laplacian){.memory = l->memory};
}
