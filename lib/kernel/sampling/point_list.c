/* A list of points that grows and can be thinned out. */
#include "kernel/sampling/point_list.h"

#include "base/threads.h"
#include "math/vec.h"

#include <float.h>
#include <math.h>
#include <string.h>

void iccp_point_list_start(iccp_point_list *list, size_t dim, const iccp_env *env)
{
    *list = (iccp_point_list){.memory = env->memory, .dim = dim};
}

void iccp_point_list_add(iccp_point_list *list, const double *point)
{
    if (list->n == list->capacity && !list->failed) {
        const size_t capacity = list->capacity < 64 ? 64 : 2 * list->capacity;
        double *points =
            iccp_grow(&list->memory, list->points, list->n, capacity, list->dim * sizeof *points);
        list->failed = points == NULL;
        if (points != NULL) {
            list->points = points;
            list->capacity = capacity;
        }
    }
    if (list->failed)
        return;
    memcpy(list->points + list->dim * list->n, point, list->dim * sizeof *point);
    ++list->n;
}

void iccp_point_list_free(iccp_point_list *list)
{
    if (list->points != NULL)
        iccp_free(&list->memory, list->points);
    *list = (iccp_point_list){0};
}

/* Returns the nearest point to point i below a squared distance, or n. If `stays` is not NULL, only
 * points with stays[] true count. */
static size_t nearest_to(const iccp_cells *cells, size_t i, const bool *stays, double *best2)
{
    const double *place = cells->points + cells->dim * i;
    size_t found = cells->n;
    iccp_cell_box box;
    (void)iccp_cells_box(cells, place, sqrt(*best2), &box);
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

icc_status iccp_point_list_thin(iccp_point_list *list, size_t n_kept, double radius,
                                const iccp_env *env)
{
    const size_t dim = list->dim;
    iccp_cells cells;
    bool *stays = iccp_alloc_zero(&env->memory, list->n, sizeof *stays);
    if (stays == NULL)
        return ICC_ERR_MEMORY;
    if (iccp_cells_create(&cells, dim, list->n, list->points, radius, env) != ICC_OK) {
        iccp_free(&env->memory, stays);
        return ICC_ERR_MEMORY;
    }
    for (size_t i = 0; i < list->n; ++i) {
        double best2 = radius * radius;
        stays[i] = i < n_kept || nearest_to(&cells, i, stays, &best2) == list->n;
    }
    size_t n = 0;
    for (size_t i = 0; i < list->n; ++i)
        if (stays[i])
            memmove(list->points + dim * n++, list->points + dim * i, dim * sizeof(double));
    list->n = n;
    iccp_cells_free(&cells);
    iccp_free(&env->memory, stays);
    return ICC_OK;
}

typedef struct measurement {
    iccp_cells cells;
    double *distance;
} measurement;

/* Cells hold about one point each. The search widens until it finds a point. */
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

icc_status iccp_nearest_distances(size_t dim, size_t n, const double *points, double *distance,
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
