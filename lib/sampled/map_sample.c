/* Samples a map block by block, so that a large grid takes little memory besides its values. */
#include "sampled/map_sample.h"

#include "base/memory.h"
#include "base/threads.h"
#include "domain/domain.h"
#include "map/apply.h"

#include <math.h>

enum { SAMPLES_PER_BLOCK = 65536, SAMPLES_PER_CHUNK = 256 };

typedef struct block {
    const icc_map *map;
    const icc_field *field;
    bool inverse;
    size_t first;            /* sample of the block */
    double *places, *images; /* dim coordinates each */
    icc_status *status;
} block;

static icc_status place_chunk(void *argument, size_t begin, size_t end)
{
    const block *b = argument;
    const size_t dim = (size_t)b->field->dim;
    for (size_t s = begin; s < end; ++s) {
        size_t i[3] = {0};
        iccp_sample_split(b->field, b->first + s, 0, i);
        for (size_t k = 0; k < dim; ++k) {
            double place = b->field->origin[k];
            for (size_t axis = 0; axis < dim; ++axis)
                place += (double)i[axis] * b->field->step[dim * axis + k];
            b->places[dim * s + k] = place;
        }
    }
    return ICC_OK;
}

/* Adds `factor` times a point of a facet, in the caller's coordinates. */
static void add_vertices(const icc_domain *domain, uint32_t facet, const double *bary,
                         double factor, double *sum)
{
    const size_t dim = (size_t)domain->dim;
    for (size_t v = 0; v < dim; ++v) {
        double given[3];
        iccp_domain_given(domain, domain->facets[dim * facet + v], given);
        for (size_t k = 0; k < dim; ++k)
            sum[k] += factor * bary[v] * given[k];
    }
}

/* Moves a place as the nearest point of the boundary moves. */
static void move_with_boundary(const block *b, const double *place, double *image)
{
    const icc_domain *from = b->inverse ? b->map->target_domain : b->map->source_domain;
    const icc_domain *to = b->inverse ? b->map->source_domain : b->map->target_domain;
    double local[3], bary[3] = {0};
    uint32_t facet = 0;
    iccp_frame_in(&from->frame, from->dim, place, local);
    iccp_domain_locate(from, local, false, &facet, bary);
    memcpy(image, place, (size_t)from->dim * sizeof *image);
    add_vertices(to, facet, bary, 1, image);
    add_vertices(from, facet, bary, -1, image);
}

static icc_status store_chunk(void *argument, size_t begin, size_t end)
{
    const block *b = argument;
    const size_t dim = (size_t)b->field->dim;
    for (size_t s = begin; s < end; ++s) {
        const double *place = b->places + dim * s;
        double *image = b->images + dim * s;
        if (b->status[s] != ICC_OK && b->field->outside == ICC_OUTSIDE_NEAREST)
            move_with_boundary(b, place, image);
        else if (b->status[s] != ICC_OK && b->field->outside == ICC_OUTSIDE_IDENTITY)
            memcpy(image, place, dim * sizeof *image);
        for (size_t k = 0; k < dim && b->field->displacement; ++k)
            image[k] -= place[k];
        iccp_sample_write(b->field, b->first + s, image);
    }
    return ICC_OK;
}

static icc_status sample_block(block *b, size_t n, size_t *n_failed, const iccp_env *env)
{
    const iccp_env quiet = iccp_quiet(env);
    icc_status status = iccp_for_chunks(&quiet, NULL, n, SAMPLES_PER_CHUNK, place_chunk, b);
    if (status == ICC_OK)
        status =
            iccp_map_apply(b->map, b->inverse, n, b->places, b->images, b->status, n_failed, env);
    return status == ICC_OK ? iccp_for_chunks(&quiet, NULL, n, SAMPLES_PER_CHUNK, store_chunk, b)
                            : status;
}

icc_status iccp_map_sample(const icc_map *map, bool inverse, const icc_field *field,
                           size_t *n_outside, const iccp_env *env)
{
    const size_t n = iccp_sample_count(field, 0), dim = (size_t)field->dim;
    const size_t room = n < SAMPLES_PER_BLOCK ? n : SAMPLES_PER_BLOCK;
    block b = {.map = map, .field = field, .inverse = inverse};
    b.places = iccp_alloc(&env->memory, room, dim * sizeof *b.places);
    b.images = iccp_alloc(&env->memory, room, dim * sizeof *b.images);
    b.status = iccp_alloc(&env->memory, room, sizeof *b.status);
    icc_status status =
        b.places != NULL && b.images != NULL && b.status != NULL ? ICC_OK : ICC_ERR_MEMORY;
    size_t n_all = 0;
    for (; status == ICC_OK && b.first < n; b.first += room) {
        const size_t some = n - b.first < room ? n - b.first : room;
        const iccp_env part = iccp_part(env, "trace", (double)b.first / (double)n,
                                        (double)(b.first + some) / (double)n);
        size_t n_failed = 0;
        status = sample_block(&b, some, &n_failed, &part);
        n_all += n_failed;
    }
    if (n_outside != NULL)
        *n_outside = n_all;
    iccp_free(&env->memory, b.places);
    iccp_free(&env->memory, b.images);
    iccp_free(&env->memory, b.status);
    return status;
}
