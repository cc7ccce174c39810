/* The V-cycle: W. Hackbusch, Multi-Grid Methods and Applications, 1985, chapter 2; as a
 * preconditioner: O. Tatebe, The multigrid preconditioned conjugate gradient method, 1993.
 *
 * One red-black sweep before the coarse correction and one in reverse order after it make the cycle
 * symmetric. Several slabs are processed at the same time. Each step is one slab behind the
 * previous step, so all steps find their data in the cache. */
#include "gradient/solver/multigrid.h"

#include <string.h>

/* Sweeps on the coarsest level, where hardly anything is left to do. */
enum { BOTTOM_SWEEPS = 4 };

static icc_status make_scratch(iccp_multigrid *mg)
{
    const size_t length = (size_t)mg->level[0].extent[0] + 8;
    iccp_mg_scratch *s = &mg->scratch;
    s->even = iccp_alloc(&mg->memory, length, sizeof *s->even);
    s->odd = iccp_alloc(&mg->memory, length, sizeof *s->odd);
    s->line = iccp_alloc(&mg->memory, length, sizeof *s->line);
    s->constant = iccp_alloc(&mg->memory, length, sizeof *s->constant);
    if (s->even == NULL || s->odd == NULL || s->line == NULL || s->constant == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < length; ++i)
        s->constant[i] = 0.5f / (float)mg->level[0].dim;
    return ICC_OK;
}

icc_status iccp_multigrid_create(iccp_multigrid *mg, const icc_grid *grid, size_t n,
                                 const uint32_t *vertex, uint32_t *position, const iccp_env *env)
{
    *mg = (iccp_multigrid){.memory = env->memory, .n_levels = 1};
    icc_status status = iccp_mg_level_fine(&mg->level[0], grid, n, vertex, position, env);
    if (status == ICC_OK)
        status = make_scratch(mg);
    while (status == ICC_OK && mg->n_levels < ICCP_MG_MAX_LEVELS) {
        iccp_mg_level *coarse = &mg->level[mg->n_levels];
        status = iccp_mg_level_coarse(coarse, coarse - 1, &mg->level[0], mg->n_levels, env);
        if (coarse->n_inside == 0)
            break;
        ++mg->n_levels;
    }
    for (int32_t l = 0; l < mg->n_levels; ++l)
        iccp_mg_level_drop_scaffold(&mg->level[l], &mg->memory);
    if (status != ICC_OK)
        iccp_multigrid_free(mg);
    return status;
}

void iccp_multigrid_free(iccp_multigrid *mg)
{
    for (int32_t l = 0; l < mg->n_levels; ++l)
        iccp_mg_level_free(&mg->level[l], &mg->memory);
    iccp_free(&mg->memory, mg->scratch.even);
    iccp_free(&mg->memory, mg->scratch.odd);
    iccp_free(&mg->memory, mg->scratch.line);
    iccp_free(&mg->memory, mg->scratch.constant);
    mg->scratch = (iccp_mg_scratch){0};
    mg->n_levels = 0;
}

static void descend(iccp_multigrid *mg, int32_t l, size_t s)
{
    const iccp_mg_level *level = &mg->level[l];
    const size_t n = level->n_slabs;
    if (s < n)
        iccp_mg_start(level, &mg->scratch, s);
    if (s >= 1 && s - 1 < n)
        iccp_mg_relax(level, &mg->scratch, s - 1, ICCP_BLACK);
    if (s >= 2 && s - 2 < n && l + 1 < mg->n_levels)
        iccp_mg_residual(level, s - 2);
    /* The residuals are complete up to slab s - 2 = 2 coarse + 1. */
    if (l + 1 == mg->n_levels || s < 3)
        return;
    const iccp_mg_level *coarse = level + 1;
    if (n == 1 ? s == 3 : s % 2 == 1 && (s - 3) / 2 < coarse->n_slabs)
        iccp_mg_restrict(coarse, level, &mg->scratch, n == 1 ? 0 : (s - 3) / 2);
}

static void ascend(iccp_multigrid *mg, int32_t l, size_t s)
{
    const iccp_mg_level *level = &mg->level[l];
    const size_t n = level->n_slabs;
    if (s < n && l + 1 < mg->n_levels)
        iccp_mg_prolong(level, level + 1, &mg->scratch, s);
    if (s >= 1 && s - 1 < n)
        iccp_mg_relax(level, &mg->scratch, s - 1, ICCP_BLACK);
    if (s >= 2 && s - 2 < n)
        iccp_mg_relax(level, &mg->scratch, s - 2, ICCP_RED);
}

/* Any number of sweeps works if their colours read the same forwards and backwards. */
static void solve_bottom(iccp_multigrid *mg, int32_t l)
{
    const iccp_mg_level *level = &mg->level[l];
    for (int sweep = 0; sweep < 2 * BOTTOM_SWEEPS; ++sweep)
        for (size_t s = 0; s < level->n_slabs; ++s)
            iccp_mg_relax(level, &mg->scratch, s, sweep % 2 == 0 ? ICCP_RED : ICCP_BLACK);
}

void iccp_multigrid_correct(iccp_multigrid *mg)
{
    for (int32_t l = 1; l < mg->n_levels; ++l)
        for (size_t s = 0; s < mg->level[l].n_slabs + 3; ++s)
            descend(mg, l, s);
    solve_bottom(mg, mg->n_levels - 1);
    for (int32_t l = mg->n_levels - 1; l > 0; --l)
        for (size_t s = 0; s < mg->level[l].n_slabs + 2; ++s)
            ascend(mg, l, s);
}

void iccp_multigrid_descend(iccp_multigrid *mg, size_t s)
{
    descend(mg, 0, s);
}

void iccp_multigrid_ascend(iccp_multigrid *mg, size_t s)
{
    ascend(mg, 0, s);
}

void iccp_multigrid_cycle(iccp_multigrid *mg)
{
    const size_t n = mg->level[0].n_slabs;
    for (size_t s = 0; s < n + 3; ++s)
        iccp_multigrid_descend(mg, s);
    iccp_multigrid_correct(mg);
    for (size_t s = 0; s < n + 2; ++s)
        iccp_multigrid_ascend(mg, s);
}
