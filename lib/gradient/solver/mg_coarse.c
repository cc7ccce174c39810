/* Coarse levels of the multigrid. They are discretised anew: the inside vertices with even
 * coordinates, with the stencil of their own spacing. Three rules keep that close to the fine
 * problem, whatever the mask.
 *
 * - The boundary stays where it is. A neighbour outside counts 1 / (its distance in coarse steps),
 *   which is the symmetric form of Shortley and Weller's stencil (W. Hackbusch, Elliptic
 *   Differential Equations, 2nd edition, 2017, section 4.8.1).
 * - Coarse neighbours are never joined through a wall. If there is a wall between them, neither is
 *   kept.
 * - Corridors too narrow for a coarse vertex need none. Errors there decay within their width, and
 *   the smoother removes them.
 *
 * Measured on the masks of tests/hard_masks.h: 9 to 14 iterations to 1e-10. With the plain stencil,
 * and neighbours joined through walls, there were 11 to 36. */
#include "gradient/solver/mg_level.h"

/* Coordinates in a level's box. */
typedef struct place {
    uint32_t at[ICC_MAX_DIM];
    size_t row;
} place;

static bool is_inside(const iccp_mg_level *level, size_t row, uint32_t x)
{
    const iccp_mg_row *r = level->row + row;
    return x >= r->first && x <= r->last && level->inside[iccp_mg_position(level, row, x)];
}

/* Returns true if the vertex `steps` along an axis is inside. It may lie outside the box. */
static bool is_inside_along(const iccp_mg_level *level, const place *p, int32_t axis, int32_t sign,
                            uint32_t steps)
{
    const uint32_t at = p->at[axis];
    if (sign < 0 ? at <= steps : steps > level->extent[axis] - at)
        return false;
    const size_t step = steps * level->stride[axis];
    const uint32_t x = axis > 0 ? p->at[0] : sign < 0 ? at - steps : at + steps;
    return is_inside(level, sign < 0 ? p->row - step : p->row + step, x);
}

/* Returns the same vertex on a level 2^depth times as fine. */
static place finer(const iccp_mg_level *fine, const place *p, int32_t depth)
{
    place f = {.row = 0};
    for (int32_t k = 0; k < fine->dim; ++k) {
        f.at[k] = p->at[k] << depth;
        f.row += fine->stride[k] * f.at[k];
    }
    return f;
}

/* Finds the place of x = 0 in a row. Returns false for rows on the rim of the box. */
static bool row_place(const iccp_mg_level *level, size_t row, place *p)
{
    *p = (place){.row = row};
    for (int32_t k = 1; k < level->dim; ++k) {
        p->at[k] = (uint32_t)(row / level->stride[k] % (level->extent[k] + 2));
        if (p->at[k] == 0 || p->at[k] > level->extent[k])
            return false;
    }
    return true;
}

static bool is_kept(const iccp_mg_level *fine, const place *f)
{
    if (!is_inside(fine, f->row, f->at[0]))
        return false;
    for (int32_t k = 0; k < fine->dim; ++k)
        for (int32_t sign = -1; sign <= 1; sign += 2)
            if (!is_inside_along(fine, f, k, sign, 1) && is_inside_along(fine, f, k, sign, 2))
                return false;
    return true;
}

/* Returns the diagonal entry: the sum of 1 for each neighbour inside and 1 / distance for each one
 * outside. */
static double diagonal(const iccp_mg_level *level, const iccp_mg_level *finest, int32_t depth,
                       const place *p)
{
    const place f = finer(finest, p, depth);
    const uint32_t whole = (uint32_t)1 << depth;
    double sum = 0;
    for (int32_t k = 0; k < level->dim; ++k)
        for (int32_t sign = -1; sign <= 1; sign += 2) {
            uint32_t steps = 1;
            if (is_inside_along(level, p, k, sign, 1))
                steps = whole;
            while (steps < whole && is_inside_along(finest, &f, k, sign, steps))
                ++steps;
            sum += (double)whole / steps;
        }
    return sum;
}

/* Makes every coarse row next to a row of the finer level cover it. Then both can be added to each
 * other without tests. */
static void cover(iccp_mg_level *level, const iccp_mg_level *fine)
{
    for (size_t r = 0; r < fine->n_rows; ++r) {
        const uint32_t first = fine->range[2 * r], last = fine->range[2 * r + 1];
        if (first > last)
            continue;
        size_t row = 0, odd[ICC_MAX_DIM], n_odd = 0;
        for (int32_t k = 1; k < fine->dim; ++k) {
            const size_t c = r / fine->stride[k] % (fine->extent[k] + 2);
            row += c / 2 * level->stride[k];
            if (c % 2 != 0)
                odd[n_odd++] = level->stride[k];
        }
        for (size_t corner = 0; corner < (size_t)1 << n_odd; ++corner) {
            size_t at = row;
            for (size_t j = 0; j < n_odd; ++j)
                at += corner >> j & 1 ? odd[j] : 0;
            iccp_mg_widen(level->range + 2 * at, first / 2 > 1 ? first / 2 : 1, (last + 1) / 2);
        }
    }
}

typedef struct coarsening {
    iccp_mg_level *level;
    const iccp_mg_level *fine, *finest;
    int32_t depth;
} coarsening;

static void mark_row(const coarsening *c, size_t row)
{
    place p;
    if (!row_place(c->level, row, &p))
        return;
    place f = finer(c->fine, &p, 1);
    const uint32_t last = c->level->range[2 * row + 1];
    for (uint32_t x = c->level->range[2 * row]; x <= last && x <= c->level->extent[0]; ++x) {
        f.at[0] = 2 * x;
        c->level->inside[iccp_mg_position(c->level, row, x)] = is_kept(c->fine, &f);
    }
}

static void weigh_row(const coarsening *c, size_t row)
{
    place p;
    if (!row_place(c->level, row, &p))
        return;
    for (uint32_t h = 0; h < 2; ++h) {
        const iccp_mg_run *end, *run = iccp_mg_runs(c->level, row, (int)h, &end);
        for (; run < end; ++run)
            for (uint32_t k = run->begin; k < run->end; ++k) {
                p.at[0] = 2 * k + h;
                c->level->inverse[iccp_mg_position(c->level, row, p.at[0])] =
                    (float)(1 / diagonal(c->level, c->finest, c->depth, &p));
            }
    }
}

static icc_status for_rows(const coarsening *c, void (*act)(const coarsening *, size_t),
                           const iccp_env *env)
{
    const size_t length = c->level->n_entries / c->level->n_rows + 1;
    const size_t rows_per_report = ICCP_VERTICES_PER_REPORT / length + 1;
    icc_status status = ICC_OK;
    for (size_t r = 0; r < c->level->n_rows && status == ICC_OK; ++r) {
        act(c, r);
        if (r % rows_per_report == 0)
            status = iccp_progress(env, "solve", 0);
    }
    return status;
}

static icc_status fill_coarse(const coarsening *c, const iccp_env *env)
{
    iccp_mg_level *level = c->level;
    icc_status status = iccp_mg_make_rows(level, &env->memory);
    if (status != ICC_OK)
        return status;
    cover(level, c->fine);
    status = iccp_mg_make_windows(level, &env->memory);
    if (status == ICC_OK)
        status = for_rows(c, mark_row, env);
    if (status == ICC_OK)
        status = iccp_mg_make_runs(level, &env->memory);
    if (status != ICC_OK || level->n_inside == 0)
        return status;
    level->inverse = iccp_alloc_zero(&env->memory, level->n_entries, sizeof *level->inverse);
    return level->inverse != NULL ? for_rows(c, weigh_row, env) : ICC_ERR_MEMORY;
}

icc_status iccp_mg_level_coarse(iccp_mg_level *level, const iccp_mg_level *fine,
                                const iccp_mg_level *finest, int32_t depth, const iccp_env *env)
{
    const coarsening c = {level, fine, finest, depth};
    *level = (iccp_mg_level){.dim = fine->dim, .kernels = fine->kernels};
    for (int32_t k = 0; k < fine->dim; ++k) {
        level->extent[k] = fine->extent[k] / 2;
        if (level->extent[k] == 0)
            return ICC_OK;
    }
    const icc_status status = fill_coarse(&c, env);
    if (status != ICC_OK || level->n_inside == 0)
        iccp_mg_level_free(level, &env->memory);
    return status;
}
