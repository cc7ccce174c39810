/* Chooses the vertices where leaves end. The depth of a vertex is its distance from the boundary.
 * The depths of two vertices differ by no more than their distance, so few have to be computed.
 *
 * Sources: E. W. Dijkstra, 1959, for bounds along edges. W. T. Tutte, 1963, for the images of a
 * pair. */
#include "shelling/centres.h"

#include "base/heap.h"
#include "base/minmax.h"
#include "math/elementary.h"
#include "math/spd.h"
#include "math/vec.h"
#include "shelling/stiffness.h"

#include <math.h>

#define NONE UINT32_MAX

/* Vertices between calls of the progress callback. */
enum { VERTICES_PER_REPORT = 1 << 10 };

/* How much a vertex's depth must grow per distance from the image of the other centre for it to
 * be chosen. With 1.2 to 1.5, centres of pairs of real bodies are a fifth to a half deeper than
 * the nearest vertices. */
static const double DEPTH_PER_DISTANCE = 1.5;

typedef struct search {
    const icc_domain *domain[2]; /* the second one is set only with `image` */
    const iccp_simplices *mesh;
    const iccp_gram *edges; /* its pattern is the edges of the mesh */
    const double *image;    /* of each inner vertex, in the second domain; or NULL */
    double *bound;          /* of each vertex: an upper bound of its depth, in local units */
    iccp_heap heap;
    uint32_t best;
    double depth; /* of the best vertex, relative to the domain's size */
} search;

static double size_of(const icc_domain *domain)
{
    return iccp_pow(fabs(domain->measure), 1.0 / domain->dim);
}

static double distance(const iccp_simplices *mesh, size_t vertex, const double *point)
{
    return iccp_vec_distance(mesh->dim, mesh->points + mesh->dim * vertex, point);
}

/* The depth of a point, or 0 if it is outside. */
static double depth_of(const icc_domain *domain, const double *point)
{
    double bary[ICC_MAX_DIM], square;
    if (iccp_domain_locate(domain, point, true, NULL, NULL) != ICC_INSIDE)
        return 0;
    (void)iccp_facet_tree_nearest(iccp_domain_tree(domain), point, bary, &square);
    return sqrt(square);
}

/* Bounds the depths by the lengths of paths along edges from the boundary (Dijkstra's
 * algorithm). */
static icc_status bound_depths(search *s, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (uint32_t v = 0; v < s->mesh->n_points; ++v) {
        s->bound[v] = v < s->mesh->n_boundary ? 0 : HUGE_VAL;
        if (v < s->mesh->n_boundary)
            iccp_heap_put(&s->heap, v, 0);
    }
    for (size_t n = 0; s->heap.n_entries > 0 && status == ICC_OK; ++n) {
        const uint32_t v = iccp_heap_pop(&s->heap);
        const double *point = s->mesh->points + s->mesh->dim * v;
        if (n % VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "order", 0);
        for (size_t p = s->edges->first[v]; p < s->edges->first[v + 1]; ++p) {
            const uint32_t w = s->edges->column[p];
            const double length = s->bound[v] + distance(s->mesh, w, point);
            if (length < s->bound[w]) {
                s->bound[w] = length;
                iccp_heap_put(&s->heap, w, length);
            }
        }
    }
    return status;
}

/* Measures the depth of a vertex, which lowers the bounds of its neighbours that are still in
 * the queue. */
static double measure(search *s, uint32_t v)
{
    const double *point = s->mesh->points + s->mesh->dim * v;
    const double depth = depth_of(s->domain[0], point);
    for (size_t p = s->edges->first[v]; p < s->edges->first[v + 1]; ++p) {
        const uint32_t w = s->edges->column[p];
        const double bound = depth + distance(s->mesh, w, point);
        if (bound < s->bound[w] && s->heap.place[w] != NONE) {
            s->bound[w] = bound;
            iccp_heap_put(&s->heap, w, -bound);
        }
    }
    return depth;
}

/* Finds the inner vertex with the greatest depth. If it has an image, the lesser of both depths
 * counts. `best` is NONE if all depths are 0. */
static icc_status find_deepest(search *s, const iccp_env *env)
{
    const double size = size_of(s->domain[0]);
    icc_status status = bound_depths(s, env);
    for (uint32_t v = (uint32_t)s->mesh->n_boundary; v < s->mesh->n_points && status == ICC_OK; ++v)
        iccp_heap_put(&s->heap, v, -s->bound[v]);
    for (size_t n = 0; s->heap.n_entries > 0 && status == ICC_OK; ++n) {
        const uint32_t v = iccp_heap_pop(&s->heap);
        if (s->bound[v] <= s->depth * size)
            break;
        if (n % VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "order", 0.5);
        double depth = measure(s, v) / size;
        if (s->image != NULL && depth > s->depth)
            depth = iccp_min(
                depth, depth_of(s->domain[1], s->image + s->mesh->dim * (v - s->mesh->n_boundary)) /
                           size_of(s->domain[1]));
        if (depth > s->depth) {
            s->depth = depth;
            s->best = v;
        }
    }
    return status;
}

static icc_status run_search(search *s, const iccp_env *env)
{
    const size_t n = s->mesh->n_points;
    icc_status status = ICC_ERR_MEMORY;
    s->best = NONE;
    s->depth = 0;
    s->bound = iccp_alloc(&env->memory, n, sizeof *s->bound);
    if (iccp_heap_create(&s->heap, n, &env->memory) && s->bound != NULL)
        status = find_deepest(s, env);
    iccp_heap_free(&s->heap, &env->memory);
    iccp_free(&env->memory, s->bound);
    return status;
}

icc_status iccp_deepest_centre(const icc_domain *domain, const iccp_simplices *mesh,
                               uint32_t *centre, const iccp_env *env)
{
    iccp_gram edges;
    icc_status status = iccp_stiffness_create(&edges, mesh, env);
    if (status != ICC_OK)
        return status;
    search s = {.domain = {domain, NULL}, .mesh = mesh, .edges = &edges};
    status = run_search(&s, env);
    iccp_gram_free(&edges);
    /* If all inner vertices are within rounding of the boundary, each is as good as any other. */
    *centre = s.best != NONE ? s.best : (uint32_t)mesh->n_boundary;
    return status;
}

uint32_t iccp_nearest_centre(const iccp_simplices *mesh, const double *point)
{
    uint32_t nearest = (uint32_t)mesh->n_boundary;
    for (size_t v = mesh->n_boundary; v < mesh->n_points; ++v)
        if (distance(mesh, v, point) < distance(mesh, nearest, point))
            nearest = (uint32_t)v;
    return nearest;
}

/* Fills in the right side, with one number for each dimension. Each weight to a boundary vertex
 * is multiplied by that vertex's position in the second domain. */
static void fill_right(const iccp_gram *g, const iccp_simplices *mesh, const icc_domain *to,
                       double *right)
{
    const size_t dim = mesh->dim, n_rim = mesh->n_boundary;
    for (size_t v = n_rim; v < mesh->n_points; ++v)
        for (size_t p = g->first[v]; p < g->first[v + 1]; ++p)
            for (size_t k = 0; k < dim && g->column[p] < n_rim; ++k)
                right[dim * (v - n_rim) + k] -= g->value[p] * to->vertices[dim * g->column[p] + k];
}

/* Sets up the equations of the inner vertices. */
static icc_status set_up(iccp_gram *inner, iccp_gram *edges, const iccp_simplices *mesh,
                         const icc_domain *to, double *right, const iccp_env *env)
{
    uint32_t *row = iccp_alloc(&env->memory, mesh->n_points, sizeof *row);
    icc_status status = row != NULL ? iccp_stiffness_to_network(edges, env) : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (uint32_t v = 0; v < mesh->n_points; ++v)
            row[v] = v < mesh->n_boundary ? NONE : (uint32_t)(v - mesh->n_boundary);
        fill_right(edges, mesh, to, right);
        status = iccp_stiffness_restrict(inner, edges, row, env);
    }
    iccp_free(&env->memory, row);
    return status;
}

/* Computes the images of the inner vertices by the harmonic map, with weights of the Laplacian.
 * Source: W. T. Tutte, How to draw a graph, 1963. */
static icc_status find_images(iccp_gram *edges, const iccp_simplices *mesh, const icc_domain *to,
                              double *image, const iccp_env *env)
{
    iccp_gram inner;
    iccp_ldlt solver;
    icc_status status = set_up(&inner, edges, mesh, to, image, env);
    if (status != ICC_OK)
        return status;
    status = iccp_spd_create(&solver, &inner.matrix, env);
    if (status == ICC_OK) {
        status = iccp_spd_solve(&solver, mesh->dim, image, env);
        iccp_ldlt_free(&solver);
    }
    iccp_gram_free(&inner);
    return status;
}

/* Finds an inner vertex near a point, and prefers a deep one to the nearest. No depth exceeds
 * the sum of the point's depth and the distance from it, so few depths have to be measured. */
static uint32_t find_partner(const icc_domain *domain, const iccp_simplices *mesh,
                             const double *point)
{
    const double depth = depth_of(domain, point);
    uint32_t partner = (uint32_t)mesh->n_boundary;
    double best = -HUGE_VAL;
    for (size_t v = mesh->n_boundary; v < mesh->n_points; ++v) {
        const double away = distance(mesh, v, point);
        if (depth + away - DEPTH_PER_DISTANCE * away <= best)
            continue;
        const double value =
            depth_of(domain, mesh->points + mesh->dim * v) - DEPTH_PER_DISTANCE * away;
        if (value > best) {
            best = value;
            partner = (uint32_t)v;
        }
    }
    return partner;
}

static icc_status pair(search *s, const iccp_simplices *const mesh[2], const uint32_t *given,
                       uint32_t centre[2], const iccp_env *env)
{
    icc_status status = given == NULL ? run_search(s, env) : ICC_OK;
    if (status != ICC_OK)
        return status;
    if (given != NULL)
        s->best = *given;
    if (s->best != NONE) {
        centre[0] = s->best;
        centre[1] = find_partner(s->domain[1], mesh[1],
                                 s->image + mesh[0]->dim * (s->best - mesh[0]->n_boundary));
        return ICC_OK;
    }
    /* No vertex has an image inside. */
    status = iccp_deepest_centre(s->domain[0], mesh[0], &centre[0], env);
    return status == ICC_OK ? iccp_deepest_centre(s->domain[1], mesh[1], &centre[1], env) : status;
}

icc_status iccp_paired_centres(const icc_domain *const domain[2],
                               const iccp_simplices *const mesh[2], const uint32_t *given,
                               uint32_t centre[2], const iccp_env *env)
{
    const size_t n_inner = mesh[0]->n_points - mesh[0]->n_boundary;
    double *image = iccp_alloc_zero(&env->memory, mesh[0]->dim * n_inner, sizeof *image);
    iccp_gram edges;
    if (image == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_stiffness_create(&edges, mesh[0], env);
    if (status == ICC_OK) {
        search s = {
            .domain = {domain[0], domain[1]}, .mesh = mesh[0], .edges = &edges, .image = image};
        status = find_images(&edges, mesh[0], domain[1], image, env);
        if (status == ICC_OK)
            status = pair(&s, mesh, given, centre, env);
        iccp_gram_free(&edges);
    }
    iccp_free(&env->memory, image);
    return status;
}
