/* A linear program in the point x and its least distance t: maximise t, where normal . x - t >=
 * offset for each facet. Solved by a path of centres: S. Boyd, L. Vandenberghe, Convex
 * Optimization, 2004, chapter 11. Each centre is found by Newton steps with a line search, which
 * never leave the half-spaces. */
#include "map/higher/kernel_point.h"

#include "math/elementary.h"
#include "math/inverse.h"
#include "math/vec.h"

#include <float.h>
#include <string.h>

/* The most Newton steps. A bent L of 1536 facets takes 44. */
enum { STEPS = 200 };

/* A point and its least distance, and derivatives by them. */
typedef double place[ICC_MAX_DIM + 1];

typedef struct program {
    size_t dim, n;
    double *row; /* dim + 2 of each half-space: its normal, -1, and its offset */
    double pull;
} program;

static double room_of(const program *p, size_t i, const double *z)
{
    const double *row = p->row + (p->dim + 2) * i;
    return iccp_vec_dot(p->dim + 1, row, z) - row[p->dim + 1];
}

/* The inner sides of all facets that are not flat up to rounding. */
static void list_halfspaces(program *p, const icc_domain *domain)
{
    const size_t dim = p->dim;
    for (uint32_t f = 0; f < domain->n_facets; ++f) {
        const double *corner[ICC_MAX_DIM];
        double edges[ICC_MAX_DIM * ICC_MAX_DIM], *row = p->row + (dim + 2) * p->n;
        iccp_facet_corners(&domain->tree, f, corner);
        for (size_t i = 0; i + 1 < dim; ++i)
            for (size_t k = 0; k < dim; ++k)
                edges[dim * i + k] = corner[i + 1][k] - corner[0][k];
        iccp_normal_of(dim, edges, row);
        const double length = iccp_vec_norm(dim, row);
        if (!(length > 0))
            continue;
        /* The determinant of corner 0 - x and the edges is positive for x inside if the facets are
         * listed as seen from outside. */
        for (size_t k = 0; k < dim; ++k)
            row[k] *= -domain->orientation / length;
        row[dim] = -1;
        row[dim + 1] = iccp_vec_dot(dim, row, corner[0]);
        ++p->n;
    }
}

/* What a centre maximises; -HUGE_VAL outside the half-spaces. */
static double value_of(const program *p, const place z)
{
    double sum = p->pull * z[p->dim];
    for (size_t i = 0; i < p->n; ++i) {
        const double room = room_of(p, i, z);
        if (!(room > 0))
            return -HUGE_VAL;
        sum += iccp_ln(room);
    }
    return sum;
}

/* Goes along a Newton step, or a half, a quarter, .. of it, until the value grows by a quarter of
 * what its slope promises. */
static bool advance(const program *p, const place way, double slope, place z)
{
    const double value = value_of(p, z);
    place next;
    for (double share = 1; share > DBL_EPSILON; share *= 0.5) {
        for (size_t r = 0; r <= p->dim; ++r)
            next[r] = z[r] + share * way[r];
        if (value_of(p, next) < value + 0.5 * 0.5 * share * slope)
            continue;
        memcpy(z, next, sizeof next);
        return true;
    }
    return false;
}

/* Takes a Newton step towards the centre. Returns its decrement, or 0 if there is none. */
static double step(const program *p, double *z)
{
    const size_t m = p->dim + 1;
    place gradient = {0}, way = {0};
    double hessian[(ICC_MAX_DIM + 1) * (ICC_MAX_DIM + 1)] = {0}, det;
    double inverse[(ICC_MAX_DIM + 1) * (ICC_MAX_DIM + 1)];
    gradient[p->dim] = p->pull;
    for (size_t i = 0; i < p->n; ++i) {
        const double *row = p->row + (p->dim + 2) * i, room = room_of(p, i, z);
        for (size_t r = 0; r < m; ++r) {
            gradient[r] += row[r] / room;
            for (size_t c = 0; c < m; ++c)
                hessian[m * r + c] += row[r] * row[c] / (room * room);
        }
    }
    if (!iccp_invert(m, hessian, inverse, &det))
        return 0;
    for (size_t r = 0; r < m; ++r)
        way[r] = iccp_vec_dot(m, inverse + m * r, gradient);
    const double square = iccp_vec_dot(m, way, gradient);
    if (!(square > 0 && square < HUGE_VAL))
        return 0;
    return advance(p, way, square, z) ? sqrt(square) : 0;
}

/* Starts at the mean of the vertices, and below all half-spaces. */
static void start(const program *p, const icc_domain *domain, place z)
{
    double least = HUGE_VAL;
    memset(z, 0, sizeof(place));
    for (size_t v = 0; v < domain->n_vertices; ++v)
        for (size_t k = 0; k < p->dim; ++k)
            z[k] += domain->vertices[p->dim * v + k] / (double)domain->n_vertices;
    for (size_t i = 0; i < p->n; ++i) {
        const double room = room_of(p, i, z);
        least = room < least ? room : least;
    }
    z[p->dim] = least - 1;
}

/* At a centre the greatest t is about n / pull above this one, or less. So the path may end where t
 * is as great as that, or where even twice that is not enough for a positive t. */
static bool is_decided(const program *p, double t)
{
    const double gap = (double)p->n / p->pull;
    return t >= gap || t <= -2 * gap;
}

icc_status iccp_kernel_point(const icc_domain *domain, double *point, const iccp_env *env)
{
    program p = {.dim = (size_t)domain->dim};
    place z;
    p.row = iccp_alloc(&env->memory, domain->n_facets, (p.dim + 2) * sizeof *p.row);
    if (p.row == NULL)
        return ICC_ERR_MEMORY;
    list_halfspaces(&p, domain);
    start(&p, domain, z);
    p.pull = (double)p.n;
    for (int k = 0; k < STEPS; ++k) {
        if (step(&p, z) > 0.5)
            continue;
        if (is_decided(&p, z[p.dim]))
            break;
        p.pull *= 2;
    }
    memcpy(point, z, p.dim * sizeof *point);
    iccp_free(&env->memory, p.row);
    return ICC_OK;
}
