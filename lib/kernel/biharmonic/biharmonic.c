/* Bounded biharmonic weights: A. Jacobson, I. Baran, J. Popovic, O. Sorkine, Bounded biharmonic
 * weights for real-time deformation, ACM Trans. Graph. 30, 2011. Sakaridis compares kernel
 * coordinates with them (section 6.3.4).
 *
 * The weight of each handle has the least integral of squared Laplacians between 0 and 1, and the
 * given values at held nodes. As in that paper, each weight is found by itself, and then the
 * weights of a point are divided by their sum.
 *
 * A wall belongs to the region that it encloses (shape.h). So enclosed regions come first, and the
 * region around takes their weights on the walls as given. */
#include "kernel/biharmonic/biharmonic.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "kernel/biharmonic/biharmonic_energy.h"
#include "kernel/biharmonic/bounded_program.h"
#include "math/ordering.h"

#include <string.h>

icc_status iccp_share_out(size_t m, double *weights)
{
    double sum = 0;
    for (size_t j = 0; j < m; ++j)
        sum += iccp_max(weights[j], 0);
    for (size_t j = 0; j < m; ++j)
        weights[j] = sum > 0 ? iccp_max(weights[j], 0) / sum : 1 / (double)m;
    return sum > 0 ? ICC_OK : ICC_ERR_SOLVER;
}

/* All regions. */
typedef struct regions {
    const iccp_biharmonic *problem;
    iccp_region_vertices vertices;
    uint32_t *parent; /* by region, see iccp_shape_parent() */
    bool *done;       /* by region */
    double *weights;  /* by vertex of all regions, n_handles each */
    bool *held;       /* by vertex */
    icc_status *status;
} regions;

/* One region. */
typedef struct region {
    const regions *all;
    iccp_region_mesh mesh;
    iccp_gram energy;
    uint32_t *order; /* by vertex of the mesh, see iccp_bounded; and the next one */
    bool *held;
    double *residual; /* by handle */
    iccp_env quiet;   /* without threads, for tasks */
} region;

/* A handle without given weights in the region has the weight 0 there. */
static icc_status solve_handle(const region *r, size_t j, double *x)
{
    const size_t m = r->all->problem->n_handles;
    const iccp_bounded program = {&r->energy.matrix, r->order, r->held};
    bool appears = false;
    for (size_t i = 0; i < r->mesh.n; ++i) {
        x[i] = r->held[i] ? r->all->weights[m * r->mesh.vertex[i] + j] : 0;
        appears |= x[i] != 0;
    }
    r->residual[j] = 0;
    return appears ? iccp_bounded_solve(&program, x, &r->residual[j], &r->quiet) : ICC_OK;
}

static icc_status solve_some(void *argument, size_t begin, size_t end)
{
    const region *r = argument;
    const size_t m = r->all->problem->n_handles;
    double *x = iccp_alloc(&r->quiet.memory, r->mesh.n, sizeof *x);
    icc_status status = x != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t j = begin; status == ICC_OK && j < end; ++j) {
        status = solve_handle(r, j, x);
        for (size_t i = 0; status == ICC_OK && i < r->mesh.n; ++i)
            if (!r->held[i])
                r->all->weights[m * r->mesh.vertex[i] + j] = x[i];
    }
    iccp_free(&r->quiet.memory, x);
    return status;
}

/* Makes the program of a region. */
static icc_status prepare(region *r, uint32_t number, const iccp_env *env, icc_error *err)
{
    const regions *all = r->all;
    const iccp_memory *memory = &env->memory;
    icc_status status =
        iccp_region_mesh_create(&r->mesh, &all->vertices, all->parent, number, env, err);
    if (status != ICC_OK)
        return status;
    status = iccp_biharmonic_energy(&r->energy, &r->mesh, env);
    r->order = iccp_alloc(memory, r->mesh.n, sizeof *r->order);
    r->held = iccp_alloc(memory, r->mesh.n, sizeof *r->held);
    r->residual = iccp_alloc(memory, all->problem->n_handles, sizeof *r->residual);
    if (status == ICC_OK && (r->order == NULL || r->held == NULL || r->residual == NULL))
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_ordering(&r->energy.matrix, r->order, env);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    bool determined = false;
    for (size_t i = 0; i < r->mesh.n; ++i) {
        r->held[i] = all->held[r->mesh.vertex[i]];
        determined |= r->held[i];
    }
    if (determined)
        return ICC_OK;
    return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_REGION, number,
                        "biharmonic weights need a handle in region %lu", (unsigned long)number);
}

/* Completes the weights of a region, which are given for the regions around it. */
static void settle(const region *r)
{
    const size_t m = r->all->problem->n_handles;
    for (size_t i = 0; i < r->mesh.n; ++i) {
        const size_t v = r->mesh.vertex[i];
        if (r->held[i])
            continue;
        const icc_status status = iccp_share_out(m, r->all->weights + m * v);
        if (v < r->all->problem->n)
            r->all->status[v] = status;
        r->all->held[v] = true;
    }
}

static icc_status solve_region(const regions *all, uint32_t number, double *residual,
                               const iccp_env *env, icc_error *err)
{
    const iccp_memory *memory = &env->memory;
    const size_t m = all->problem->n_handles;
    region r = {.all = all,
                .mesh = {.memory = *memory},
                .energy = {.memory = *memory},
                .quiet = {.memory = *memory, .user = env->user, .threads = 1}};
    icc_status status = prepare(&r, number, env, err);
    if (status == ICC_OK) {
        status = iccp_for_chunks(env, "weights", m, 1, solve_some, &r);
        if (status == ICC_ERR_SOLVER)
            status = iccp_fail_at(err, status, ICC_ITEM_REGION, number,
                                  "biharmonic weights of region %lu cannot be found, because its "
                                  "mesh has too thin triangles",
                                  (unsigned long)number);
        status = iccp_explain(err, status);
    }
    if (status == ICC_OK)
        settle(&r);
    for (size_t j = 0; status == ICC_OK && j < m; ++j)
        *residual = iccp_max(*residual, r.residual[j]);
    iccp_region_mesh_free(&r.mesh);
    iccp_gram_free(&r.energy);
    iccp_free(memory, r.order);
    iccp_free(memory, r.held);
    iccp_free(memory, r.residual);
    return status;
}

/* Returns a region whose enclosed regions are done, or the number of regions if all are done. */
static uint32_t next_region(const regions *all)
{
    const size_t n = all->problem->shape->n_regions;
    for (uint32_t r = 0; r < n; ++r) {
        bool ready = !all->done[r];
        for (uint32_t s = 0; ready && s < n; ++s)
            ready = all->done[s] || all->parent[s] != r;
        if (ready)
            return r;
    }
    return (uint32_t)n;
}

static icc_status solve_regions(regions *all, double *weights, double *residual,
                                const iccp_env *env, icc_error *err)
{
    const iccp_biharmonic *p = all->problem;
    const size_t m = p->n_handles, n_regions = p->shape->n_regions;
    icc_status status = ICC_OK;
    memcpy(all->weights, weights, p->n * m * sizeof *weights);
    for (size_t i = 0; i < all->vertices.n; ++i)
        all->held[i] = i < p->n && p->held[i];
    for (uint32_t r = 0; r < n_regions; ++r)
        all->parent[r] = iccp_shape_parent(p->shape, r);
    *residual = 0;
    for (size_t k = 0; status == ICC_OK && k < n_regions; ++k) {
        const iccp_env part = iccp_part(env, NULL, (double)k / (double)n_regions,
                                        (double)(k + 1) / (double)n_regions);
        const uint32_t r = next_region(all);
        status = solve_region(all, r, residual, &part, err);
        all->done[r] = true;
    }
    if (status == ICC_OK)
        memcpy(weights, all->weights, p->n * m * sizeof *weights);
    return status;
}

icc_status iccp_biharmonic_solve(const iccp_biharmonic *problem, double *weights,
                                 icc_status *status, double *residual, const iccp_env *env,
                                 icc_error *err)
{
    const iccp_memory *memory = &env->memory;
    regions all = {.problem = problem, .status = status};
    icc_status result = iccp_region_vertices_create(&all.vertices, problem->shape, problem->n,
                                                    problem->nodes, problem->spacing, env, err);
    if (result != ICC_OK)
        return result;
    all.parent = iccp_alloc(memory, problem->shape->n_regions, sizeof *all.parent);
    all.done = iccp_alloc_zero(memory, problem->shape->n_regions, sizeof *all.done);
    all.weights = iccp_alloc(memory, all.vertices.n, problem->n_handles * sizeof *all.weights);
    all.held = iccp_alloc(memory, all.vertices.n, sizeof *all.held);
    if (all.parent != NULL && all.done != NULL && all.weights != NULL && all.held != NULL)
        result = solve_regions(&all, weights, residual, env, err);
    else
        result = iccp_fail_memory(err);
    iccp_region_vertices_free(&all.vertices);
    iccp_free(memory, all.parent);
    iccp_free(memory, all.done);
    iccp_free(memory, all.weights);
    iccp_free(memory, all.held);
    return result;
}
