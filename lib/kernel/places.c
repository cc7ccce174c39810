#include "kernel/places.h"

#include "base/threads.h"
#include "math/vec.h"

#include <float.h>
#include <math.h>
#include <string.h>

void iccp_places_start(iccp_places *places, size_t dim, const iccp_env *env)
{
    *places = (iccp_places){.memory = env->memory, .dim = dim};
}

void iccp_places_add(iccp_places *places, const double *point)
{
    if (places->n == places->capacity && !places->failed) {
        const size_t capacity = places->capacity < 64 ? 64 : 2 * places->capacity;
        double *points = iccp_grow(&places->memory, places->points, places->n, capacity,
                                   places->dim * sizeof *points);
        places->failed = points == NULL;
        if (points != NULL) {
            places->points = points;
            places->capacity = capacity;
        }
    }
    if (places->failed)
        return;
    memcpy(places->points + places->dim * places->n, point, places->dim * sizeof *point);
    ++places->n;
}

void iccp_places_free(iccp_places *places)
{
    if (places->points != NULL)
        iccp_free(&places->memory, places->points);
    *places = (iccp_places){0};
}

/* The nearest point to point i among those that `stays` (all without), below a squared distance, or
 * n. */
static size_t nearest_to(const iccp_cells *cells, size_t i, const bool *stays, double *best2)
{
    const double *place = cells->points + cells->dim * i;
    size_t found = cells->n;
    iccp_cell_box box;
    if (!iccp_cells_box(cells, place, sqrt(*best2), &box))
        return found;
    for (size_t z = box.from[2]; z <= box.to[2]; ++z)
        for (size_t y = box.from[1]; y <= box.to[1]; ++y) {
            const size_t row = (z * cells->shape[1] + y) * cells->shape[0];
            const uint32_t end = cells->first[row + box.to[0] + 1];
            for (uint32_t at = cells->first[row + box.from[0]]; at < end; ++at) {
                const uint32_t j = cells->order[at];
                if (j == i || (stays != NULL && !stays[j]))
                    continue;
                const double d2 =
                    iccp_vec_distance2(cells->dim, place, cells->points + cells->dim * j);
                if (d2 < *best2) {
                    *best2 = d2;
                    found = j;
                }
            }
        }
    return found;
}

icc_status iccp_places_thin(iccp_places *places, size_t n_kept, double radius, const iccp_env *env)
{
    const size_t dim = places->dim;
    iccp_cells cells;
    bool *stays = iccp_alloc_zero(&env->memory, places->n, sizeof *stays);
    if (stays == NULL)
        return ICC_ERR_MEMORY;
    if (iccp_cells_create(&cells, dim, places->n, places->points, radius, env) != ICC_OK) {
        iccp_free(&env->memory, stays);
        return ICC_ERR_MEMORY;
    }
    for (size_t i = 0; i < places->n; ++i) {
        double best2 = radius * radius;
        stays[i] = i < n_kept || nearest_to(&cells, i, stays, &best2) == places->n;
    }
    size_t n = 0;
    for (size_t i = 0; i < places->n; ++i)
        if (stays[i])
            memmove(places->points + dim * n++, places->points + dim * i, dim * sizeof(double));
    places->n = n;
    iccp_cells_free(&cells);
    iccp_free(&env->memory, stays);
    return ICC_OK;
}

typedef struct measurement {
    iccp_cells cells;
    double *distance;
} measurement;

/* Cells hold about one point each: the search widens until it finds one. */
static icc_status measure_chunk(void *argument, size_t begin, size_t end)
{
    const measurement *m = argument;
    for (size_t i = begin; i < end; ++i) {
        m->distance[i] = HUGE_VAL;
        for (double radius = m->cells.side; m->cells.n > 1; radius *= 2) {
            double best2 = radius * radius;
            if (nearest_to(&m->cells, i, NULL, &best2) == m->cells.n)
                continue;
            m->distance[i] = sqrt(best2);
            break;
        }
    }
    return ICC_OK;
}

icc_status iccp_places_spacing(size_t dim, size_t n, const double *points, double *distance,
                               const iccp_env *env)
{
    measurement m = {.distance = distance};
    /* So small that the number of cells decides. */
    icc_status status = iccp_cells_create(&m.cells, dim, n, points, DBL_MIN, env);
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "check", n, 1024, measure_chunk, &m);
    iccp_cells_free(&m.cells);
    return status;
}
