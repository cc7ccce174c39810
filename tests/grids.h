/* Grids for tests. */
#ifndef TESTS_GRIDS_H
#define TESTS_GRIDS_H

#include "gradient/grid/kuhn.h"
#include "gradient/grid/lattice.h"

#include "random.h"

#include <check.h>
#include <stdbool.h>
#include <string.h>

static inline icc_grid *grid_of(int32_t dim, const size_t *sides, const uint8_t *inside)
{
    icc_grid *grid;
    ck_assert_int_eq(icc_grid_create_mask(&grid, dim, sides, inside, NULL, NULL), ICC_OK);
    return grid;
}

static inline uint32_t grid_random_inside(random_source *r, const icc_grid *grid)
{
    uint32_t v;
    do
        v = (uint32_t)random_below(r, (int)grid->n_vertices);
    while (!grid->inside[v]);
    return v;
}

/* Random masks without holes: vertices are added as long as what they touch stays contractible. */
static inline void grid_grow_ball(random_source *r, const iccp_kuhn *kuhn, const size_t *sides,
                                  size_t rounds, uint8_t *inside)
{
    size_t n = 1, stride[ICC_MAX_DIM];
    for (int32_t k = 0; k < kuhn->dim; ++k) {
        stride[k] = n;
        n *= sides[k];
    }
    memset(inside, 0, n);
    inside[n / 2] = 1;
    for (size_t round = 0; round < rounds; ++round) {
        const size_t v = (size_t)random_below(r, (int)n);
        iccp_link_set touched = {{0, 0}};
        bool along_axis = false;
        for (int i = 0; i < kuhn->n_neighbours; ++i) {
            size_t u = v;
            int steps = 0;
            bool in_grid = true;
            for (int32_t k = 0; k < kuhn->dim; ++k) {
                const size_t step = (size_t)kuhn->step[i][k];
                in_grid = in_grid && v / stride[k] % sides[k] + step < sides[k];
                u += step * stride[k];
                steps += step != 0;
            }
            if (!in_grid || !inside[u])
                continue;
            iccp_link_add(&touched, i);
            along_axis = along_axis || steps == 1;
        }
        if (along_axis && iccp_kuhn_regular(kuhn, &touched))
            inside[v] = 1;
    }
}

#endif
