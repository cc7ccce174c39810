/* Keeps the lattice points in a shape. Neighbours along a row mostly have the same region. The
 * distance from walls often proves that without another query. */
#include "kernel/sampling/lattice_filter.h"

#include "base/threads.h"

typedef struct sifting {
    const iccp_lattice_filter *filter;
    uint8_t *stays; /* by lattice point */
} sifting;

static bool passes(const iccp_lattice_filter *filter, const iccp_spot *spot)
{
    return spot->region != ICCP_NOWHERE ? spot->clearance >= filter->clearance
                                        : spot->clearance <= filter->margin;
}

static void row_start(const iccp_lattice_filter *filter, size_t row, size_t *at)
{
    at[0] = 0;
    at[1] = row % filter->count[1];
    at[2] = row / filter->count[1];
}

static icc_status sift_rows(void *argument, size_t begin, size_t end)
{
    const sifting *s = argument;
    const iccp_lattice_filter *filter = s->filter;
    const double reach = filter->clearance > filter->margin ? filter->clearance : filter->margin;
    for (size_t row = begin; row < end; ++row) {
        size_t at[3];
        iccp_spot spot = {.clearance = -1};
        uint8_t *stays = s->stays + row * filter->count[0];
        for (row_start(filter, row, at); at[0] < filter->count[0]; ++at[0]) {
            double point[3];
            filter->point(filter->lattice, at, point);
            const iccp_spot here = iccp_shape_spot_beside(filter->shape, &spot, point, reach);
            stays[at[0]] = passes(filter, &here);
            if (!here.beside)
                spot = here;
        }
    }
    return ICC_OK;
}

icc_status iccp_lattice_filter_add(iccp_point_list *list, const iccp_lattice_filter *filter,
                                   const iccp_env *env)
{
    const size_t n_rows = filter->count[1] * filter->count[2];
    sifting s = {filter, iccp_alloc(&env->memory, n_rows, filter->count[0])};
    if (s.stays == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status = iccp_for_chunks(env, "sample", n_rows, 16, sift_rows, &s);
    for (size_t row = 0; status == ICC_OK && row < n_rows; ++row) {
        size_t at[3];
        for (row_start(filter, row, at); at[0] < filter->count[0]; ++at[0]) {
            double point[3];
            if (!s.stays[row * filter->count[0] + at[0]])
                continue;
            filter->point(filter->lattice, at, point);
            iccp_point_list_add(list, point);
        }
    }
    iccp_free(&env->memory, s.stays);
    return status == ICC_OK && list->failed ? ICC_ERR_MEMORY : status;
}
