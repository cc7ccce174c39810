/* Sets up the program of a rigid part: which weights may change, and how much each derivative
 * counts. See rigid.c. */
#include "kernel/pose/rigid_program.h"

#include <string.h>

/* Weight of derivatives around the part, as a share of the mean rigidity. */
static const double SURROUNDINGS = 0.1;

/* Numbers the places: the part in the caller's order, then the free nodes within the kernel's reach
 * of it. Also numbers those of them that are free. */
static icc_status find_places(iccp_rigid *r, const uint32_t *part, const bool *held,
                              const iccp_env *env)
{
    const iccp_symmetric *kernel = iccp_collocation_matrix(r->collocation);
    bool *seen = iccp_alloc_zero(&env->memory, r->nodes->n, sizeof *seen);
    if (seen == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < r->n_part; ++k) {
        r->places[r->n_places++] = part[k];
        seen[part[k]] = true;
    }
    for (size_t k = 0; k < r->n_part; ++k)
        for (size_t p = kernel->first[part[k]]; p < kernel->first[part[k] + 1]; ++p) {
            const uint32_t j = kernel->column[p];
            if (!seen[j] && !held[j])
                r->places[r->n_places++] = j;
            seen[j] = true;
        }
    for (size_t k = 0; k < r->n_places; ++k)
        if (!held[r->places[k]])
            r->free[r->n_free++] = r->places[k];
    iccp_free(&env->memory, seen);
    return ICC_OK;
}

static bool has_negative(size_t m, const double *weights)
{
    for (size_t j = 0; j < m; ++j)
        if (weights[j] < 0)
            return true;
    return false;
}

static void count_places(iccp_rigid *r, const double *rigidity)
{
    r->mean = rigidity != NULL ? 0 : 1;
    for (size_t k = 0; rigidity != NULL && k < r->n_part; ++k)
        r->mean += rigidity[k] / (double)r->n_part;
    for (size_t k = 0; k < r->n_places; ++k)
        r->count[k] = k >= r->n_part ? SURROUNDINGS : rigidity != NULL ? rigidity[k] / r->mean : 1;
}

/* Number of all arrays of numbers. Those of free weights come first. */
enum { N_ARRAYS = 12, N_WEIGHTS = 9 };

static void list_arrays(iccp_rigid *r, double **arrays[N_ARRAYS])
{
    double **const list[N_ARRAYS] = {&r->x.weights,  &r->next.weights,  &r->best.weights,
                                     &r->x.gradient, &r->next.gradient, &r->best.gradient,
                                     &r->before,     &r->change,        &r->bent,
                                     &r->slopes,     &r->scratch,       &r->count};
    memcpy(arrays, list, sizeof list);
}

/* One table of lengths, so that each array exists or is NULL when they are freed. */
static icc_status allocate(iccp_rigid *r, const iccp_env *env)
{
    const size_t dim = r->nodes->dim, m = r->nodes->n_handles;
    double **arrays[N_ARRAYS];
    icc_status status = ICC_OK;
    list_arrays(r, arrays);
    for (size_t k = 0; k < N_ARRAYS; ++k) {
        const size_t length = k < N_WEIGHTS             ? iccp_rigid_weights(r)
                              : arrays[k] == &r->slopes ? iccp_rigid_derivatives(r)
                              : arrays[k] == &r->count
                                  ? r->n_places
                                  : iccp_optimise_work(r->handles) + (dim + 1) * m;
        *arrays[k] = iccp_alloc(&env->memory, length, sizeof **arrays[k]);
        if (*arrays[k] == NULL)
            status = ICC_ERR_MEMORY;
    }
    return status;
}

static icc_status create(iccp_rigid *r, const uint32_t *part, const double *rigidity,
                         const bool *held, bool positive, const double *weights,
                         const iccp_env *env)
{
    const size_t n = r->nodes->n, m = r->nodes->n_handles;
    r->places = iccp_alloc(&env->memory, n, sizeof *r->places);
    r->free = iccp_alloc(&env->memory, n, sizeof *r->free);
    r->signs = iccp_alloc(&env->memory, n, sizeof *r->signs);
    icc_status status = ICC_ERR_MEMORY;
    if (r->places != NULL && r->free != NULL && r->signs != NULL)
        status = find_places(r, part, held, env);
    if (status == ICC_OK)
        status = allocate(r, env);
    if (status != ICC_OK)
        return status;
    count_places(r, rigidity);
    status = iccp_hessian_create(&r->hessian, r->nodes, r->collocation, r->n_places, r->places,
                                 r->count, r->n_free, r->free, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < r->n_free; ++i) {
        const double *w = weights + m * r->free[i];
        memcpy(r->before + m * i, w, m * sizeof *w);
        r->signs[i] = positive && !has_negative(m, w);
    }
    return ICC_OK;
}

icc_status iccp_rigid_create(iccp_rigid *rigid, const iccp_nodes *nodes,
                             const iccp_handles *handles, const iccp_collocation *collocation,
                             size_t n_part, const uint32_t *part, const double *rigidity,
                             const bool *held, bool positive, const double *weights,
                             const iccp_env *env)
{
    *rigid = (iccp_rigid){
        .memory = env->memory,
        .nodes = nodes,
        .handles = handles,
        .collocation = collocation,
        .n_part = n_part,
        .hessian = {.memory = env->memory,
                    .inverse = {.memory = env->memory},
                    .map = {.memory = env->memory, .kernel = {.memory = env->memory}}}};
    const icc_status status = create(rigid, part, rigidity, held, positive, weights, env);
    if (status != ICC_OK)
        iccp_rigid_free(rigid);
    return status;
}

void iccp_rigid_free(iccp_rigid *rigid)
{
    double **arrays[N_ARRAYS];
    list_arrays(rigid, arrays);
    for (size_t k = 0; k < N_ARRAYS; ++k)
        iccp_free(&rigid->memory, *arrays[k]);
    iccp_hessian_free(&rigid->hessian);
    iccp_free(&rigid->memory, rigid->places);
    iccp_free(&rigid->memory, rigid->free);
    iccp_free(&rigid->memory, rigid->signs);
    *rigid = (iccp_rigid){.memory = rigid->memory};
}

void iccp_rigid_slopes(const iccp_rigid *rigid, const double *coefficients, double *slopes)
{
    const iccp_rigid *r = rigid;
    const size_t dim = r->nodes->dim, m = r->nodes->n_handles;
    double *gradients = r->scratch, *values = gradients + dim * m;
    memset(slopes, 0, iccp_rigid_derivatives(r) * sizeof *slopes);
    for (size_t k = 0; k < r->n_part; ++k) {
        iccp_collocation_evaluate(r->collocation, m, coefficients,
                                  r->nodes->points + dim * r->places[k], values, gradients);
        for (size_t axis = 0; axis < dim; ++axis)
            for (size_t j = 0; j < m; ++j)
                slopes[m * (dim * k + axis) + j] = gradients[dim * j + axis];
    }
}
