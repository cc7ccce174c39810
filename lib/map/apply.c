/* Applies a map to many points on all threads, chunk by chunk. The kind of the map does the
 * work. */
#include "map/apply.h"

#include "base/threads.h"

typedef struct map_loop {
    const icc_map *map;
    bool inverse;
    const iccp_memory *memory;
    const double *points;
    double *images;    /* or NULL */
    double *jacobians; /* or NULL */
    icc_status *status;
    atomic_size_t n_failed;
} map_loop;

static icc_status map_points(const map_loop *loop, size_t begin, size_t n, icc_status *status,
                             iccp_path *path)
{
    const icc_map *map = loop->map;
    const size_t dim = (size_t)map->info.dim;
    return map->kind->apply(map, loop->inverse, n, loop->points + dim * begin,
                            loop->images != NULL ? loop->images + dim * begin : NULL,
                            loop->jacobians != NULL ? loop->jacobians + dim * dim * begin : NULL,
                            status, path);
}

static icc_status map_chunk(void *argument, size_t begin, size_t end)
{
    map_loop *loop = argument;
    icc_status status[ICCP_CHART_MANY];
    size_t n_failed = 0;
    iccp_path path;
    iccp_path_init(&path, loop->memory);
    const icc_status all = map_points(loop, begin, end - begin, status, &path);
    iccp_path_clear(&path);
    if (all != ICC_OK)
        return all;
    for (size_t i = begin; i < end; ++i) {
        n_failed += status[i - begin] != ICC_OK;
        if (loop->status != NULL)
            loop->status[i] = status[i - begin];
    }
    atomic_fetch_add(&loop->n_failed, n_failed);
    return ICC_OK;
}

static icc_status run_loop(map_loop *loop, size_t n, size_t *n_failed, const iccp_env *env)
{
    icc_status status = n > 0 ? loop->map->kind->ready(loop->map, loop->inverse) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "trace", n, ICCP_CHART_MANY, map_chunk, loop);
    if (n_failed != NULL)
        *n_failed = atomic_load(&loop->n_failed);
    return status;
}

icc_status iccp_map_apply(const icc_map *map, bool inverse, size_t n, const double *points,
                          double *images, icc_status *status, size_t *n_failed, const iccp_env *env)
{
    map_loop loop = {map, inverse, &env->memory, points, images, NULL, status, 0};
    return run_loop(&loop, n, n_failed, env);
}

icc_status iccp_map_jacobian(const icc_map *map, size_t n, const double *points, double *jacobians,
                             icc_status *status, size_t *n_failed, const iccp_env *env)
{
    map_loop loop = {map, false, &env->memory, points, NULL, jacobians, status, 0};
    return run_loop(&loop, n, n_failed, env);
}
