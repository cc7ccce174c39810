/* Follows the integral curves of a function. Based on: L. Huynh, thesis, 2013, Algorithms 3 to 5.
 * Chunks of points are followed side by side. Each keeps its vertices in a list of its own, and the
 * lists are joined in the order of the points. */
#include "gradient/coordinates/integral_curves.h"

#include "base/threads.h"
#include "gradient/coordinates/gradient_boundary.h"
#include "gradient/coordinates/gradient_line.h"

#include <math.h>
#include <string.h>

/* The vertices of the curves of one chunk. */
typedef struct list {
    double *vertices;
    size_t n, capacity; /* in vertices */
} list;

typedef struct work {
    icc_curves *curves;
    const double *points;
    const icc_grid *grid;
    double unit; /* of the lattice, in the caller's coordinates */
    iccp_gradient_state state;
    list *lists; /* one per chunk */
} work;

static icc_status append(const work *w, list *l, const iccp_path *path)
{
    const icc_grid *grid = w->grid;
    const size_t dim = (size_t)grid->dim;
    if (l->n + path->n > l->capacity) {
        const size_t capacity = 2 * (l->n + path->n);
        double *vertices = iccp_grow(&w->curves->memory, l->vertices, dim * l->n, dim * capacity,
                                     sizeof *vertices);
        if (vertices == NULL)
            return ICC_ERR_MEMORY;
        l->vertices = vertices;
        l->capacity = capacity;
    }
    for (size_t k = 0; k < path->n; ++k) {
        double local[ICC_MAX_DIM];
        iccp_gradient_to_local(&w->state, iccp_path_at(path, k), local);
        iccp_frame_out(&grid->frame, grid->dim, local, l->vertices + dim * l->n++);
    }
    return ICC_OK;
}

/* Returns true if no neighbour of a lattice point in the Kuhn triangulation is higher (way up) or
 * lower (way down). False for other points. */
static bool is_critical(const work *w, const double *lattice)
{
    const icc_function *f = w->state.field;
    const icc_grid *grid = w->grid;
    const int sign = w->curves->way == ICC_WAY_UP ? 1 : -1;
    uint32_t vertex = 0;
    for (int k = 0; k < grid->dim; ++k) {
        if (lattice[k] < floor(lattice[k]) || lattice[k] > floor(lattice[k]))
            return false;
        vertex += (uint32_t)lattice[k] * (uint32_t)grid->stride[k];
    }
    for (unsigned set = 1; set < 1u << grid->dim; ++set)
        for (int step = -1; step <= 1; step += 2) {
            uint32_t u = vertex;
            for (int k = 0; k < grid->dim && u != ICCP_NONE; ++k)
                if (set >> k & 1)
                    u = iccp_grid_neighbour(grid, u, k, step);
            if (u == ICCP_NONE || isnan(f->values[u]))
                return false;
            const int order = sign * iccp_function_compare(f, u, vertex);
            if (order > 0 || (order == 0 && sign * ((u > vertex) - (u < vertex)) > 0))
                return false;
        }
    return true;
}

/* Follows one curve. Returns how it ends, or ICC_END_NONE if there is none. The path has at least
 * one point if there is a curve. */
static icc_status follow(const work *w, const double *point, iccp_path *path,
                         iccp_gradient_line *line, int32_t *end)
{
    const iccp_gradient_state *state = &w->state;
    const icc_domain *domain = w->grid->domain;
    double local[ICC_MAX_DIM], from[ICC_MAX_DIM], bary[ICC_MAX_DIM] = {0};
    uint32_t facet = ICCP_NONE;
    iccp_frame_in(&w->grid->frame, w->grid->dim, point, local);
    iccp_gradient_to_lattice(state, local, from);
    iccp_path_start(path, (size_t)w->grid->dim);
    *line = (iccp_gradient_line){.facet = ICCP_NONE};
    *end = ICC_END_NONE;
    const int32_t where =
        domain != NULL ? iccp_domain_locate(domain, local, false, &facet, bary) : ICC_INSIDE;
    if (where == ICC_OUTSIDE)
        return ICC_OK;
    if (where == ICC_BOUNDARY && w->curves->way == ICC_WAY_DOWN) {
        *end = ICC_END_BOUNDARY;
        line->facet = facet;
        memcpy(line->bary, bary, sizeof line->bary);
        return iccp_path_append(path, from, 0);
    }
    icc_status status;
    if (w->curves->way == ICC_WAY_DOWN)
        status = iccp_gradient_down(state, from, path, NULL, line);
    else if (where == ICC_BOUNDARY)
        status = iccp_gradient_up_from(state, facet, local, path, line);
    else
        status = iccp_gradient_up(state, from, path, NULL, line);
    if (status != ICC_ERR_TRACE) {
        *end = w->curves->way == ICC_WAY_UP ? ICC_END_MAXIMUM : ICC_END_BOUNDARY;
        return status;
    }
    if (path->n > 0)
        *end = is_critical(w, iccp_path_at(path, path->n - 1)) ? ICC_END_CRITICAL : ICC_END_VALUES;
    return ICC_OK;
}

static icc_status follow_chunk(void *argument, size_t begin, size_t end)
{
    const work *w = argument;
    icc_curves *curves = w->curves;
    const size_t dim = (size_t)curves->dim;
    icc_status status = ICC_OK;
    iccp_path path;
    iccp_path_init(&path, &curves->memory);
    for (size_t i = begin; status == ICC_OK && i < end; ++i) {
        iccp_gradient_line line;
        status = follow(w, w->points + dim * i, &path, &line, &curves->end[i]);
        if (status == ICC_OK)
            status = append(w, &w->lists[begin / ICCP_CHART_MANY], &path);
        curves->first[i + 1] = path.n;
        curves->length[i] = path.n > 0 ? w->unit * iccp_path_length(&path) : 0;
        curves->alone[i] = path.n > 0 ? w->unit * line.alone : 0;
        curves->facet[i] = curves->end[i] == ICC_END_BOUNDARY ? line.facet : ICCP_NONE;
        memcpy(curves->bary + dim * i, line.bary, dim * sizeof *line.bary);
    }
    iccp_path_clear(&path);
    return status;
}

/* Joins the lists of the chunks, and sums up the numbers of vertices. */
static icc_status join(work *w, size_t n_chunks)
{
    icc_curves *curves = w->curves;
    const size_t dim = (size_t)curves->dim;
    size_t n = 0;
    for (size_t i = 0; i < curves->n; ++i)
        curves->first[i + 1] += curves->first[i];
    curves->vertices =
        iccp_alloc(&curves->memory, curves->first[curves->n], dim * sizeof *curves->vertices);
    if (curves->vertices == NULL)
        return ICC_ERR_MEMORY;
    for (size_t c = 0; c < n_chunks; ++c) {
        if (w->lists[c].n > 0)
            memcpy(curves->vertices + dim * n, w->lists[c].vertices,
                   dim * w->lists[c].n * sizeof *curves->vertices);
        n += w->lists[c].n;
    }
    return ICC_OK;
}

static bool allocate(icc_curves *curves)
{
    const size_t n = curves->n;
    curves->first = iccp_alloc_zero(&curves->memory, n + 1, sizeof *curves->first);
    curves->end = iccp_alloc(&curves->memory, n, sizeof *curves->end);
    curves->length = iccp_alloc(&curves->memory, n, sizeof *curves->length);
    curves->alone = iccp_alloc(&curves->memory, n, sizeof *curves->alone);
    curves->facet = iccp_alloc(&curves->memory, n, sizeof *curves->facet);
    curves->bary = iccp_alloc(&curves->memory, n, (size_t)curves->dim * sizeof *curves->bary);
    return curves->first != NULL && curves->end != NULL && curves->length != NULL &&
           curves->alone != NULL && curves->facet != NULL && curves->bary != NULL;
}

/* Beyond the plane, curves meet outside vertices that the tree does not reach. The function gets
 * values there, in a copy. */
static icc_status prepare(work *w, const icc_function *function, const iccp_env *env)
{
    w->state.tree = iccp_tree_retain(function->tree);
    icc_status status = iccp_function_copy(&w->state.field, function, env);
    if (status == ICC_OK)
        status = iccp_gradient_extend(w->state.field, env);
    if (status == ICC_OK && w->grid->domain != NULL)
        status = iccp_gradient_meet_boundary(&w->state, env);
    return status;
}

icc_status iccp_curves_create(icc_curves **out, const icc_function *function, size_t n,
                              const double *points, int32_t way, const iccp_env *env)
{
    const icc_grid *grid = function->tree->grid;
    const size_t n_chunks = (n + ICCP_CHART_MANY - 1) / ICCP_CHART_MANY;
    icc_curves *curves = iccp_alloc_zero(&env->memory, 1, sizeof *curves);
    *out = curves;
    if (curves == NULL)
        return ICC_ERR_MEMORY;
    *curves = (icc_curves){.memory = env->memory, .dim = grid->dim, .way = way, .n = n};
    work w = {curves, points, grid,
              .unit = grid->spacing * grid->frame.out[0] * grid->frame.out[1]};
    w.lists = iccp_alloc_zero(&env->memory, n_chunks, sizeof *w.lists);
    icc_status status = w.lists != NULL && allocate(curves) ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = prepare(&w, function, env);
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "trace", n, ICCP_CHART_MANY, follow_chunk, &w);
    if (status == ICC_OK)
        status = join(&w, n_chunks);
    for (size_t c = 0; w.lists != NULL && c < n_chunks; ++c)
        iccp_free(&env->memory, w.lists[c].vertices);
    iccp_free(&env->memory, w.lists);
    iccp_gradient_state_clear(&w.state);
    if (status != ICC_OK) {
        iccp_curves_release(curves);
        *out = NULL;
    }
    return status;
}

void iccp_curves_release(icc_curves *curves)
{
    if (curves == NULL)
        return;
    const iccp_memory memory = curves->memory;
    iccp_free(&memory, curves->first);
    iccp_free(&memory, curves->vertices);
    iccp_free(&memory, curves->end);
    iccp_free(&memory, curves->length);
    iccp_free(&memory, curves->alone);
    iccp_free(&memory, curves->facet);
    iccp_free(&memory, curves->bary);
    iccp_free(&memory, curves);
}
