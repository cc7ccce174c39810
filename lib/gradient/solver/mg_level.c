/* Makes the finest level from a list of vertices, and the parts that all levels have: rows,
 * windows, runs. */
#include "gradient/solver/mg_level.h"

#include <string.h>

/* Makes the rows of the box, with their strides, parities and empty ranges. */
icc_status iccp_mg_make_rows(iccp_mg_level *level, const iccp_memory *memory)
{
    const int32_t last = level->dim - 1;
    size_t n = 1;
    level->stride[0] = 0;
    for (int32_t k = 1; k < level->dim; ++k) {
        level->stride[k] = n;
        n *= level->extent[k] + 2;
    }
    level->n_rows = n;
    level->n_slabs = last > 0 ? level->extent[last] + 2 : 1;
    level->row = iccp_alloc_zero(memory, n + 1, sizeof *level->row);
    level->range = iccp_alloc(memory, 2 * n, sizeof *level->range);
    if (level->row == NULL || level->range == NULL)
        return ICC_ERR_MEMORY;
    for (size_t r = 0; r < n; ++r) {
        level->range[2 * r] = UINT32_MAX;
        level->range[2 * r + 1] = 0;
    }
    for (int32_t k = 1; k < level->dim; ++k)
        for (size_t r = 0; r < n; ++r)
            level->row[r].parity ^= (uint32_t)(r / level->stride[k] % (level->extent[k] + 2)) & 1;
    return ICC_OK;
}

/* Computes windows: the ranges of a row and of all adjacent rows (along the axes), and one vertex
 * more on both sides. They determine where rows are stored. `wide` is workspace of 2 n_rows
 * numbers. */
static void place_windows(iccp_mg_level *level, uint32_t *wide)
{
    const size_t n = level->n_rows;
    memcpy(wide, level->range, 2 * n * sizeof *wide);
    for (int32_t k = 1; k < level->dim; ++k) {
        for (size_t r = 0; r < n; ++r) {
            level->row[r].first = wide[2 * r];
            level->row[r].last = wide[2 * r + 1];
        }
        for (size_t r = 0; r < n; ++r) {
            if (r >= level->stride[k])
                iccp_mg_widen(wide + 2 * r, level->row[r - level->stride[k]].first,
                              level->row[r - level->stride[k]].last);
            if (r + level->stride[k] < n)
                iccp_mg_widen(wide + 2 * r, level->row[r + level->stride[k]].first,
                              level->row[r + level->stride[k]].last);
        }
    }
    size_t at = 0;
    for (size_t r = 0; r < n; ++r) {
        iccp_mg_row *row = level->row + r;
        row->first = wide[2 * r] > wide[2 * r + 1] ? 1 : (wide[2 * r] - 1) / 2 * 2;
        row->last = wide[2 * r] > wide[2 * r + 1] ? 0 : (wide[2 * r + 1] + 1) | 1;
        const size_t half = (row->last + 1 - row->first) / 2;
        for (size_t h = 0; h < 2; ++h)
            row->base[h] = (ptrdiff_t)(at + h * half) - (ptrdiff_t)(row->first / 2);
        at += 2 * half;
    }
    level->n_entries = at;
}

icc_status iccp_mg_make_windows(iccp_mg_level *level, const iccp_memory *memory)
{
    uint32_t *wide = iccp_alloc(memory, 2 * level->n_rows, sizeof *wide);
    if (wide == NULL)
        return ICC_ERR_MEMORY;
    place_windows(level, wide);
    iccp_free(memory, wide);
    level->inside = iccp_alloc_zero(memory, level->n_entries, 1);
    level->x = iccp_alloc_zero(memory, level->n_entries, sizeof *level->x);
    level->b = iccp_alloc_zero(memory, level->n_entries, sizeof *level->b);
    return level->inside != NULL && level->x != NULL && level->b != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Lists the runs of every half, or counts them if there is no list yet. */
static size_t list_runs(iccp_mg_level *level)
{
    size_t n_runs = 0;
    for (size_t r = 0; r < level->n_rows; ++r) {
        iccp_mg_row *row = level->row + r;
        for (uint32_t h = 0; h < 2; ++h) {
            row->run[h] = (uint32_t)n_runs;
            for (uint32_t k = row->first / 2; 2 * k < row->last; ++k) {
                if (!level->inside[iccp_mg_position(level, r, 2 * k + h)])
                    continue;
                const uint32_t begin = k;
                while (2 * k < row->last && level->inside[iccp_mg_position(level, r, 2 * k + h)])
                    ++k;
                if (level->run != NULL)
                    level->run[n_runs] = (iccp_mg_run){begin, k};
                ++n_runs;
                level->n_inside += level->run != NULL ? k - begin : 0;
            }
        }
    }
    level->row[level->n_rows].run[0] = (uint32_t)n_runs;
    return n_runs;
}

icc_status iccp_mg_make_runs(iccp_mg_level *level, const iccp_memory *memory)
{
    level->run = iccp_alloc(memory, list_runs(level), sizeof *level->run);
    if (level->run == NULL)
        return ICC_ERR_MEMORY;
    list_runs(level);
    return ICC_OK;
}

/* The grid's rows from the first to the last that a list of vertices meets. For each: the first and
 * the last x of the list, and later its number among the rows of the level. */
typedef struct grid_rows {
    const icc_grid *grid;
    uint32_t first; /* row with number 0 */
    size_t n;
    uint32_t *range; /* 2 n */
    uint32_t *row;   /* n */
} grid_rows;

static icc_status make_grid_rows(grid_rows *g, const icc_grid *grid, size_t n,
                                 const uint32_t *vertex, const iccp_memory *memory)
{
    const uint32_t length = (uint32_t)grid->shape[0];
    uint32_t range[2] = {UINT32_MAX, 0};
    for (size_t i = 0; i < n; ++i)
        iccp_mg_widen(range, vertex[i], vertex[i]);
    *g = (grid_rows){.grid = grid, .first = range[0] / length};
    g->n = range[1] / length - g->first + 1;
    g->range = iccp_alloc(memory, 2 * g->n, sizeof *g->range);
    g->row = iccp_alloc(memory, g->n, sizeof *g->row);
    if (g->range == NULL || g->row == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < g->n; ++k) {
        g->range[2 * k] = UINT32_MAX;
        g->range[2 * k + 1] = 0;
    }
    return ICC_OK;
}

static icc_status find_ranges(grid_rows *g, size_t n, const uint32_t *vertex, const iccp_env *env)
{
    const uint32_t length = (uint32_t)g->grid->shape[0];
    icc_status status = ICC_OK;
    for (size_t i = 0; i < n && status == ICC_OK; ++i) {
        const uint32_t row = vertex[i] / length, x = vertex[i] - row * length;
        iccp_mg_widen(g->range + 2 * (size_t)(row - g->first), x, x);
        if (i % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "solve", 0);
    }
    return status;
}

static bool is_met(const grid_rows *g, size_t row)
{
    return g->range[2 * row] <= g->range[2 * row + 1];
}

/* Finds the smallest box around all vertices. */
static void find_extent(iccp_mg_level *level, const grid_rows *g)
{
    uint32_t range[ICC_MAX_DIM][2];
    for (int32_t k = 0; k < level->dim; ++k) {
        range[k][0] = UINT32_MAX;
        range[k][1] = 0;
    }
    for (size_t r = 0; r < g->n; ++r) {
        if (!is_met(g, r))
            continue;
        size_t rest = g->first + r;
        iccp_mg_widen(range[0], g->range[2 * r], g->range[2 * r + 1]);
        for (int32_t k = 1; k < level->dim; ++k) {
            const uint32_t at = (uint32_t)(rest % g->grid->shape[k]);
            iccp_mg_widen(range[k], at, at);
            rest /= g->grid->shape[k];
        }
    }
    for (int32_t k = 0; k < level->dim; ++k) {
        level->corner[k] = range[k][0];
        level->extent[k] = range[k][1] - range[k][0] + 1;
    }
}

/* Gives the grid's rows the numbers of the level, and copies their ranges. */
static void match_rows(iccp_mg_level *level, grid_rows *g)
{
    for (size_t r = 0; r < g->n; ++r) {
        if (!is_met(g, r))
            continue;
        size_t rest = g->first + r, row = 0;
        for (int32_t k = 1; k < level->dim; ++k) {
            row += level->stride[k] * (rest % g->grid->shape[k] - level->corner[k] + 1);
            rest /= g->grid->shape[k];
        }
        g->row[r] = (uint32_t)row;
        level->range[2 * row] = g->range[2 * r] - level->corner[0] + 1;
        level->range[2 * row + 1] = g->range[2 * r + 1] - level->corner[0] + 1;
    }
}

static icc_status mark_inside(iccp_mg_level *level, const grid_rows *g, size_t n,
                              const uint32_t *vertex, uint32_t *position, const iccp_env *env)
{
    const uint32_t length = (uint32_t)g->grid->shape[0];
    icc_status status = ICC_OK;
    for (size_t i = 0; i < n && status == ICC_OK; ++i) {
        const uint32_t row = vertex[i] / length, x = vertex[i] - row * length;
        const size_t at = iccp_mg_position(level, g->row[row - g->first], x - level->corner[0] + 1);
        level->inside[at] = 1;
        position[i] = (uint32_t)at;
        if (i % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "solve", 0);
    }
    return status;
}

static icc_status make_fine(iccp_mg_level *level, grid_rows *g, size_t n, const uint32_t *vertex,
                            uint32_t *position, const iccp_env *env)
{
    icc_status status = find_ranges(g, n, vertex, env);
    if (status != ICC_OK)
        return status;
    find_extent(level, g);
    status = iccp_mg_make_rows(level, &env->memory);
    if (status != ICC_OK)
        return status;
    match_rows(level, g);
    status = iccp_mg_make_windows(level, &env->memory);
    if (status == ICC_OK)
        status = mark_inside(level, g, n, vertex, position, env);
    return status == ICC_OK ? iccp_mg_make_runs(level, &env->memory) : status;
}

icc_status iccp_mg_level_fine(iccp_mg_level *level, const icc_grid *grid, size_t n,
                              const uint32_t *vertex, uint32_t *position, const iccp_env *env)
{
    *level =
        (iccp_mg_level){.dim = grid->dim, .kernels = iccp_mg_kernels_choose(2 * grid->dim, false)};
    grid_rows rows;
    icc_status status = make_grid_rows(&rows, grid, n, vertex, &env->memory);
    if (status == ICC_OK)
        status = make_fine(level, &rows, n, vertex, position, env);
    iccp_free(&env->memory, rows.range);
    iccp_free(&env->memory, rows.row);
    return status;
}

void iccp_mg_level_drop_scaffold(iccp_mg_level *level, const iccp_memory *memory)
{
    iccp_free(memory, level->inside);
    iccp_free(memory, level->range);
    level->inside = NULL;
    level->range = NULL;
}

void iccp_mg_level_free(iccp_mg_level *level, const iccp_memory *memory)
{
    iccp_mg_level_drop_scaffold(level, memory);
    iccp_free(memory, level->row);
    iccp_free(memory, level->run);
    iccp_free(memory, level->inverse);
    iccp_free(memory, level->x);
    iccp_free(memory, level->b);
    *level = (iccp_mg_level){.dim = level->dim};
}
