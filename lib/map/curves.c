/* Based on: Huynh and Gingold, Bijective Deformations in R^n via Integral Curve Coordinates, section
 * 4, steps 3-5: the image of a point has the same coordinates in the other domain. */
#include "map/curves.h"

#include "base/threads.h"
#include "chart/bulk.h"

#include <math.h>

enum { GRAIN = 64 };

typedef struct curves_loop {
    const icc_chart *from, *to;
    const iccp_memory *memory;
    const double *points;
    double *results;        /* images or jacobians */
    icc_status *status;
    atomic_size_t n_failed;
} curves_loop;

static void note(curves_loop *loop, size_t i, icc_status status)
{
    if (loop->status != NULL)
        loop->status[i] = status;
    if (status != ICC_OK)
        atomic_fetch_add(&loop->n_failed, 1);
}

static icc_status map_point(const curves_loop *loop, const double *point, double *image,
                            iccp_path *path)
{
    iccp_coords coords;
    const icc_status status = iccp_encode_point(loop->from, point, &coords, NULL, path);
    if (status == ICC_OK)
        return iccp_decode_point(loop->to, &coords, image, NULL, path);
    for (int32_t k = 0; k < loop->to->info.dim; ++k)
        image[k] = NAN;
    return status;
}

/* The chain rule through the coordinates, and the scales of the two frames. */
static void multiply(const curves_loop *loop, const iccp_decode_jet *outer,
                     const iccp_encode_jet *inner, double *jacobian)
{
    const int32_t dim = loop->to->info.dim;
    const double *in = loop->from->domain->frame.in, *out = loop->to->domain->frame.out;
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t j = 0; j < dim; ++j) {
            double sum = outer->t[i] * inner->t[j];
            for (int32_t k = 0; k < dim; ++k)
                sum += outer->bary[i * dim + k] * inner->bary[k * dim + j];
            jacobian[i * dim + j] = sum * (in[0] * out[0]) * (in[1] * out[1]);
        }
}

static icc_status differentiate(const curves_loop *loop, const double *point, double *jacobian,
                                iccp_path *path)
{
    const int32_t dim = loop->to->info.dim;
    iccp_coords coords;
    iccp_encode_jet inner = {{0}, {0}};
    iccp_decode_jet outer = {{0}, {0}};
    double image[ICC_MAX_DIM];
    icc_status status = iccp_encode_point(loop->from, point, &coords, &inner, path);
    if (status == ICC_OK)
        status = iccp_decode_point(loop->to, &coords, image, &outer, path);
    if (status == ICC_OK)
        multiply(loop, &outer, &inner, jacobian);
    else
        for (int32_t k = 0; k < dim * dim; ++k)
            jacobian[k] = NAN;
    return status;
}

typedef icc_status (*point_function)(const curves_loop *loop, const double *point, double *result,
                                     iccp_path *path);

static icc_status run_chunk(curves_loop *loop, size_t begin, size_t end, point_function function,
                            size_t result_size)
{
    const size_t dim = (size_t)loop->from->info.dim;
    icc_status status = ICC_OK;
    iccp_path path;
    iccp_path_init(&path, loop->memory);
    for (size_t i = begin; i < end && iccp_is_point_status(status); ++i) {
        status = function(loop, loop->points + dim * i, loop->results + result_size * i, &path);
        note(loop, i, status);
    }
    iccp_path_clear(&path);
    return iccp_is_point_status(status) ? ICC_OK : status;
}

static icc_status map_chunk(void *argument, size_t begin, size_t end)
{
    curves_loop *loop = argument;
    return run_chunk(loop, begin, end, map_point, (size_t)loop->to->info.dim);
}

static icc_status jacobian_chunk(void *argument, size_t begin, size_t end)
{
    curves_loop *loop = argument;
    const size_t dim = (size_t)loop->to->info.dim;
    return run_chunk(loop, begin, end, differentiate, dim * dim);
}

static icc_status run(curves_loop *loop, const char *stage, size_t n, iccp_chunk chunk,
                      size_t *n_failed, const iccp_env *env)
{
    const icc_status status = iccp_for_chunks(env, stage, n, GRAIN, chunk, loop);
    if (n_failed != NULL)
        *n_failed = atomic_load(&loop->n_failed);
    return status;
}

icc_status iccp_curves_apply(const icc_chart *from, const icc_chart *to, size_t n,
                             const double *points, double *images, icc_status *status,
                             size_t *n_failed, const iccp_env *env)
{
    curves_loop loop = {from, to, &env->memory, points, images, status, 0};
    return run(&loop, "map", n, map_chunk, n_failed, env);
}

icc_status iccp_curves_jacobian(const icc_chart *from, const icc_chart *to, size_t n,
                                const double *points, double *jacobians, icc_status *status,
                                size_t *n_failed, const iccp_env *env)
{
    curves_loop loop = {from, to, &env->memory, points, jacobians, status, 0};
    return run(&loop, "jacobian", n, jacobian_chunk, n_failed, env);
}
