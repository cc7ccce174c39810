/* Gradients at vertices are means over their triangles, by area. At the middle of an edge from a to
 * b, the cubic with these gradients differs from the mean of both values by the jump (grad(a) -
 * grad(b)) (b - a) / 8. */
#include "fit/spline/jump_refinement.h"

#include "base/sort.h"
#include "base/triangle_corners.h"
#include "math/vec.h"
#include "mesh/triangulate.h"

#include <string.h>

/* Each round halves edges. */
enum { ROUNDS = 3 };

/* Gradients of both coordinates: du/dx, du/dy, dv/dx, dv/dy. */
enum { PARTS = 4 };

typedef struct edge {
    double jump; /* how far the middle is off */
    uint32_t a, b;
} edge;

typedef struct builder {
    const iccp_memory *memory;
    iccp_box_mesh *mesh;
    size_t room;          /* vertices that there is room for */
    double *u, *gradient; /* of all vertices */
    edge *edges;
    size_t n_edges;
    const iccp_edge_set *walls;
} builder;

/* Adds a triangle's area times its gradient to its three vertices. */
static void add_gradient(const iccp_box_mesh *m, size_t t, const double *u, double *gradient,
                         double *area)
{
    const uint32_t *v = m->triangles + 3 * t;
    double g[PARTS] = {0};
    for (size_t k = 0; k < 3; ++k) {
        const double *from = m->points + 2 * (size_t)v[(k + 1) % 3];
        const double *to = m->points + 2 * (size_t)v[(k + 2) % 3];
        for (size_t c = 0; c < 2; ++c) {
            g[2 * c] += u[2 * (size_t)v[k] + c] * (from[1] - to[1]);
            g[2 * c + 1] += u[2 * (size_t)v[k] + c] * (to[0] - from[0]);
        }
    }
    const double *p = m->points + 2 * (size_t)v[0], *q = m->points + 2 * (size_t)v[1],
                 *r = m->points + 2 * (size_t)v[2];
    const double own = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
    for (size_t k = 0; k < 3; ++k) {
        area[v[k]] += own;
        for (size_t c = 0; c < PARTS; ++c)
            gradient[PARTS * (size_t)v[k] + c] += g[c];
    }
}

/* Computes the gradients at all vertices of a mesh. `gradient` has room for PARTS of each. */
static icc_status find_gradients(const iccp_box_mesh *m, const double *u, double *gradient,
                                 const iccp_memory *memory)
{
    double *area = iccp_alloc_zero(memory, m->n_vertices, sizeof *area);
    if (area == NULL)
        return ICC_ERR_MEMORY;
    memset(gradient, 0, PARTS * m->n_vertices * sizeof *gradient);
    for (size_t t = 0; t < m->n_triangles; ++t)
        add_gradient(m, t, u, gradient, area);
    for (size_t k = 0; k < PARTS * m->n_vertices; ++k)
        gradient[k] /= area[k / PARTS];
    iccp_free(memory, area);
    return ICC_OK;
}

/* Writes by how much the middle of an edge differs from the mean of its ends. */
static void find_jump(const double *points, const double *gradient, size_t a, size_t b,
                      double jump[2])
{
    const double *p = points + 2 * a, *q = points + 2 * b;
    for (size_t c = 0; c < 2; ++c) {
        const double *g = gradient + PARTS * a + 2 * c, *h = gradient + PARTS * b + 2 * c;
        jump[c] = ((g[0] - h[0]) * (q[0] - p[0]) + (g[1] - h[1]) * (q[1] - p[1])) / 8;
    }
}

/* Writes value and gradient of vertex v at the middle of the edge from a to b. The derivative along
 * the edge is that of the cubic. */
static void interpolate(double *u, double *gradient, const double *points, size_t v, size_t a,
                        size_t b)
{
    const double *p = points + 2 * a, *q = points + 2 * b;
    const double d[2] = {q[0] - p[0], q[1] - p[1]}, square = iccp_vec_dot(2, d, d);
    double jump[2];
    find_jump(points, gradient, a, b, jump);
    for (size_t c = 0; c < 2; ++c) {
        double *g = gradient + PARTS * v + 2 * c;
        for (size_t k = 0; k < 2; ++k)
            g[k] = 0.5 * (gradient[PARTS * a + 2 * c + k] + gradient[PARTS * b + 2 * c + k]);
        const double rest = 1.5 * (u[2 * b + c] - u[2 * a + c] - iccp_vec_dot(2, g, d)) / square;
        for (size_t k = 0; k < 2; ++k)
            g[k] += rest * d[k];
        u[2 * v + c] = 0.5 * (u[2 * a + c] + u[2 * b + c]) + jump[c];
    }
}

/* ---- refinement ---- */

static int by_jump(const void *a, const void *b)
{
    const edge *e = a, *f = b;
    if (e->jump > f->jump || e->jump < f->jump)
        return e->jump < f->jump ? -1 : 1;
    if (e->a != f->a)
        return e->a < f->a ? 1 : -1;
    return (e->b < f->b) - (e->b > f->b);
}

/* Lists the edges that are off by more than the tolerance. */
static icc_status list_edges(builder *b, double tolerance)
{
    const iccp_box_mesh *m = b->mesh;
    b->n_edges = 0;
    b->edges = iccp_alloc(b->memory, m->n_triangles, 3 * sizeof *b->edges);
    if (b->edges == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t c = 0; c < 3 * m->n_triangles; ++c) {
        if (m->twins[c] != ICCP_NO_NEIGHBOUR && m->twins[c] < c)
            continue;
        const uint32_t from = m->triangles[iccp_after(c)], to = m->triangles[iccp_before(c)];
        if (iccp_edge_set_has(b->walls, from, to))
            continue;
        double jump[2];
        find_jump(m->points, b->gradient, from, to, jump);
        const double square = iccp_vec_dot(2, jump, jump);
        if (square > tolerance * tolerance)
            b->edges[b->n_edges++] = (edge){square, from < to ? from : to, from < to ? to : from};
    }
    return ICC_OK;
}

static void add_middle(builder *b, const edge *e)
{
    iccp_box_mesh *m = b->mesh;
    const size_t v = m->n_vertices++;
    for (size_t k = 0; k < 2; ++k)
        m->points[2 * v + k] =
            0.5 * (m->points[2 * (size_t)e->a + k] + m->points[2 * (size_t)e->b + k]);
    interpolate(b->u, b->gradient, m->points, v, e->a, e->b);
}

/* Adds the middles of listed edges: of all, or of those that are farthest off if there is no room
 * for all. */
static void add_middles(builder *b, size_t room)
{
    const bool chooses = b->n_edges > room;
    const size_t n = chooses ? room : b->n_edges;
    if (chooses)
        iccp_sort_begin(b->edges, b->n_edges, sizeof *b->edges, by_jump);
    for (size_t k = 0; k < n; ++k) {
        add_middle(b, &b->edges[chooses ? 0 : k]);
        if (chooses)
            iccp_sort_next(b->edges, b->n_edges - k, sizeof *b->edges, by_jump);
    }
}

static icc_status refine_once(builder *b, double tolerance, const iccp_env *env)
{
    const size_t room = b->room - b->mesh->n_vertices;
    if (room == 0)
        return ICC_OK;
    icc_status status = list_edges(b, tolerance);
    if (status == ICC_OK && b->n_edges > 0) {
        add_middles(b, room);
        iccp_free(b->memory, b->mesh->triangles);
        iccp_free(b->memory, b->mesh->twins);
        b->mesh->triangles = b->mesh->twins = NULL;
        status = iccp_box_mesh_triangulate(b->mesh, b->walls, env);
    }
    iccp_free(b->memory, b->edges);
    b->edges = NULL;
    return status;
}

static icc_status begin(builder *b, const iccp_box_mesh *solved, const double *u)
{
    iccp_box_mesh *m = b->mesh;
    const size_t n = solved->n_vertices, count = 3 * solved->n_triangles;
    m->points = iccp_alloc(b->memory, b->room, 2 * sizeof *m->points);
    m->triangles = iccp_alloc(b->memory, count, sizeof *m->triangles);
    m->twins = iccp_alloc(b->memory, count, sizeof *m->twins);
    b->u = iccp_alloc(b->memory, b->room, 2 * sizeof *b->u);
    b->gradient = iccp_alloc(b->memory, b->room, PARTS * sizeof *b->gradient);
    if (m->points == NULL || m->triangles == NULL || m->twins == NULL || b->u == NULL ||
        b->gradient == NULL)
        return ICC_ERR_MEMORY;
    m->n_vertices = n;
    m->n_triangles = solved->n_triangles;
    memcpy(m->points, solved->points, 2 * n * sizeof *m->points);
    memcpy(m->triangles, solved->triangles, count * sizeof *m->triangles);
    memcpy(m->twins, solved->twins, count * sizeof *m->twins);
    memcpy(b->u, u, 2 * n * sizeof *u);
    return find_gradients(solved, u, b->gradient, b->memory);
}

icc_status iccp_jump_refine(iccp_box_mesh *fine, double **fine_u, const iccp_box_mesh *solved,
                            const double *u, const iccp_edge_set *walls, double tolerance,
                            size_t most, const iccp_env *env)
{
    builder b = {
        .memory = &env->memory, .mesh = fine, .room = most * solved->n_vertices, .walls = walls};
    *fine = (iccp_box_mesh){.memory = env->memory};
    icc_status status = begin(&b, solved, u);
    for (int k = 0; status == ICC_OK && k < ROUNDS; ++k) {
        const size_t before = fine->n_vertices;
        const iccp_env part = iccp_part(env, NULL, (double)k / ROUNDS, (k + 1.0) / ROUNDS);
        status = refine_once(&b, tolerance, &part);
        if (fine->n_vertices == before)
            break;
    }
    iccp_free(&env->memory, b.gradient);
    if (status != ICC_OK) {
        iccp_free(&env->memory, b.u);
        iccp_box_mesh_free(fine);
        b.u = NULL;
    }
    *fine_u = b.u;
    return status;
}
