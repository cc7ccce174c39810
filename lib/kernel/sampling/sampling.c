/* Checks samples, measures them, and makes the object. */
#include "kernel/sampling/sampling.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "kernel/sampling/point_list.h"
#include "kernel/sampling/spectrum.h"

#include <math.h>
#include <string.h>

icc_sampling *iccp_sampling_retain(const icc_sampling *sampling)
{
    icc_sampling *shared = (icc_sampling *)sampling;
    atomic_fetch_add_explicit(&shared->references, 1, memory_order_relaxed);
    return shared;
}

void iccp_sampling_release(icc_sampling *sampling)
{
    if (sampling == NULL ||
        atomic_fetch_sub_explicit(&sampling->references, 1, memory_order_acq_rel) != 1)
        return;
    const iccp_memory memory = sampling->memory;
    iccp_shape_release(sampling->shape);
    iccp_free(&memory, sampling->points);
    iccp_free(&memory, sampling);
}

/* ------------------------------------------------------------------ survey */

enum { OUTSIDE, WITHIN, ON_EDGE };

/* Facts about samples. */
typedef struct survey {
    const icc_shape *shape;
    size_t n;
    const double *points;
    double *local;    /* local coordinates */
    double *spacing;  /* local distances of nearest neighbours */
    uint32_t *region; /* regions of the samples */
    uint8_t *where;   /* OUTSIDE, WITHIN, or ON_EDGE for a wall or a curve */
} survey;

static void survey_free(survey *s, const iccp_memory *memory)
{
    iccp_free(memory, s->local);
    iccp_free(memory, s->spacing);
    iccp_free(memory, s->region);
    iccp_free(memory, s->where);
}

static icc_status look_chunk(void *argument, size_t begin, size_t end)
{
    const survey *s = argument;
    const size_t dim = s->shape->dim;
    for (size_t i = begin; i < end; ++i) {
        const iccp_spot spot = iccp_shape_spot(s->shape, s->points + dim * i);
        const bool edge = spot.wall != ICCP_NOWHERE || spot.curve != ICCP_NOWHERE;
        s->where[i] = edge ? ON_EDGE : spot.region != ICCP_NOWHERE ? WITHIN : OUTSIDE;
        s->region[i] = spot.region;
        for (size_t k = 0; k < dim; ++k)
            s->local[dim * i + k] = spot.at[k];
    }
    return ICC_OK;
}

static icc_status survey_create(survey *s, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    s->local = iccp_alloc(memory, s->n, s->shape->dim * sizeof *s->local);
    s->spacing = iccp_alloc(memory, s->n, sizeof *s->spacing);
    s->region = iccp_alloc(memory, s->n, sizeof *s->region);
    s->where = iccp_alloc(memory, s->n, sizeof *s->where);
    if (s->local == NULL || s->spacing == NULL || s->region == NULL || s->where == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_for_chunks(env, "sample", s->n, 256, look_chunk, s);
    if (status != ICC_OK)
        return status;
    return iccp_nearest_distances(s->shape->dim, s->n, s->local, s->spacing, env);
}

/* ------------------------------------------------------------------- check */

static icc_status check_inside(const survey *s, icc_error *err)
{
    for (size_t i = 0; i < s->n; ++i)
        if (s->where[i] == OUTSIDE)
            return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, (int64_t)i,
                                "point %zu lies in no region and on no curve", i);
    return ICC_OK;
}

static icc_status check_regions(const survey *s, const iccp_env *env, icc_error *err)
{
    const size_t n_regions = s->shape->n_regions;
    size_t *count = iccp_alloc_zero(&env->memory, n_regions, sizeof *count);
    if (count == NULL)
        return iccp_fail_memory(err);
    for (size_t i = 0; i < s->n; ++i)
        if (s->where[i] == WITHIN)
            ++count[s->region[i]];
    size_t r = 0;
    while (r < n_regions && count[r] > 0)
        ++r;
    iccp_free(&env->memory, count);
    if (r < n_regions)
        return iccp_fail_at(err, ICC_ERR_RESOLUTION, ICC_ITEM_REGION, (int64_t)r,
                            "no sample lies inside region %zu: the spacing is too large for it", r);
    return ICC_OK;
}

static icc_status check_distinct(const survey *s, bool given, icc_error *err)
{
    for (size_t i = 0; i < s->n; ++i)
        if (!(s->spacing[i] > 0))
            return given ? iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                        "point %zu is the same as another one", i)
                         : iccp_fail(err, ICC_ERR_RESOLUTION,
                                     "the spacing is lost in the rounding of the coordinates");
    return ICC_OK;
}

/* ------------------------------------------------------------------ finish */

/* Computes counts and distances. `sigma` and `spacing` are local if they are computed here. */
static icc_status measure(const survey *s, icc_sampling_info *info, const iccp_env *env)
{
    const iccp_frame *frame = &s->shape->frame;
    double sum = 0, least = HUGE_VAL, spacing = info->spacing * frame->in[0] * frame->in[1];
    info->n_samples = s->n;
    info->n_edge = 0;
    for (size_t i = 0; i < s->n; ++i) {
        info->n_edge += s->where[i] == ON_EDGE;
        sum += s->spacing[i];
        least = iccp_min(least, s->spacing[i]);
    }
    if (info->kind == ICC_SAMPLING_POINTS)
        spacing = s->n > 1 ? sum / (double)s->n : 1;
    info->spacing = spacing * frame->out[0] * frame->out[1];
    info->nearest = s->n > 1 ? least / spacing : 0;
    info->sigma = ICCP_SIGMA_OF_GRID * info->spacing;
    if (info->kind != ICC_SAMPLING_BLUE)
        return ICC_OK;
    double sigma;
    const icc_status status =
        iccp_spectrum_sigma(s->shape->dim, s->n - info->n_edge,
                            s->local + s->shape->dim * info->n_edge, spacing, &sigma, env);
    info->sigma = sigma * frame->out[0] * frame->out[1];
    return status;
}

static icc_status copy_samples(icc_sampling **out, const icc_shape *shape,
                               const icc_sampling_info *info, const double *points,
                               const iccp_env *env)
{
    icc_sampling *s = iccp_alloc_zero(&env->memory, 1, sizeof *s);
    if (s == NULL)
        return ICC_ERR_MEMORY;
    s->memory = env->memory;
    atomic_init(&s->references, 1);
    s->shape = iccp_shape_retain(shape);
    s->info = *info;
    s->points = iccp_alloc(&env->memory, info->n_samples, shape->dim * sizeof *s->points);
    if (s->points == NULL) {
        iccp_sampling_release(s);
        return ICC_ERR_MEMORY;
    }
    memcpy(s->points, points, info->n_samples * shape->dim * sizeof *points);
    *out = s;
    return ICC_OK;
}

icc_status iccp_sampling_finish(icc_sampling **out, const icc_shape *shape, size_t n,
                                const double *points, const icc_sampling_info *info,
                                const iccp_env *env, icc_error *err)
{
    const bool given = info->kind == ICC_SAMPLING_POINTS;
    icc_sampling_info full = *info;
    survey s = {.shape = shape, .n = n, .points = points};
    full.dim = (int32_t)shape->dim;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, env);
    icc_status status = iccp_explain(err, survey_create(&s, &part[0]));
    if (status == ICC_OK)
        status = given ? check_inside(&s, err) : check_regions(&s, env, err);
    if (status == ICC_OK)
        status = check_distinct(&s, given, err);
    if (status == ICC_OK)
        status = iccp_explain(err, measure(&s, &full, &part[1]));
    if (status == ICC_OK)
        status = iccp_explain(err, copy_samples(out, shape, &full, points, env));
    survey_free(&s, &env->memory);
    return status;
}

icc_status iccp_sampling_create_from_points(icc_sampling **out, const icc_shape *shape, size_t n,
                                            const double *points, const iccp_env *env,
                                            icc_error *err)
{
    const icc_sampling_info info = {.kind = ICC_SAMPLING_POINTS};
    *out = NULL;
    return iccp_sampling_finish(out, shape, n, points, &info, env, err);
}
