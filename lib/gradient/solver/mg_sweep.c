/* Smoothing and transfer between levels: red-black smoothing, linear interpolation and its
 * transpose. Source: W. Hackbusch, Multi-Grid Methods and Applications, 1985, chapter 3.
 *
 * A V-cycle that starts from 0 needs no x on the way down. Red is b / diagonal, black follows from
 * it, and then only red has a residual. On the way up red is b / diagonal plus the coarse
 * correction, and black and red follow from that. Loops run over pieces of halves of rows, which
 * are contiguous, without branches, and vectorised. */
#include "gradient/solver/mg_sweep.h"

static size_t rows_per_slab(const iccp_mg_level *level)
{
    return level->n_rows / level->n_slabs;
}

/* Returns the half of a row that has a colour. */
static int half_of(const iccp_mg_level *level, size_t row, int colour)
{
    return (int)(level->row[row].parity ^ (uint32_t)colour);
}

static const float *inverse_at(const iccp_mg_level *level, const iccp_mg_scratch *scratch,
                               size_t at)
{
    return level->inverse != NULL ? level->inverse + at : scratch->constant;
}

void iccp_mg_start(const iccp_mg_level *level, const iccp_mg_scratch *scratch, size_t slab)
{
    const size_t n = rows_per_slab(level);
    for (size_t row = slab * n; row < (slab + 1) * n; ++row) {
        const int half = half_of(level, row, ICCP_RED);
        const iccp_mg_run *end, *run = iccp_mg_runs(level, row, half, &end);
        for (; run < end; ++run) {
            const size_t at = (size_t)(level->row[row].base[half] + (ptrdiff_t)run->begin);
            const float *inverse = inverse_at(level, scratch, at), *b = level->b + at;
            float *restrict x = level->x + at;
            for (size_t i = 0; i < run->end - run->begin; ++i)
                x[i] = inverse[i] * b[i];
        }
    }
}

void iccp_mg_relax(const iccp_mg_level *level, const iccp_mg_scratch *scratch, size_t slab,
                   int colour)
{
    const size_t n = rows_per_slab(level);
    for (size_t row = slab * n; row < (slab + 1) * n; ++row) {
        const int half = half_of(level, row, colour);
        const iccp_mg_run *end, *run = iccp_mg_runs(level, row, half, &end);
        for (; run < end; ++run) {
            const float *near[2 * ICC_MAX_DIM];
            const size_t at = iccp_mg_near_in(level, row, half, run->begin, level->x, near);
            level->kernels->relax(level->x + at, level->b + at, inverse_at(level, scratch, at),
                                  near, run->end - run->begin, 2 * level->dim);
        }
    }
}

void iccp_mg_residual(const iccp_mg_level *level, size_t slab)
{
    const size_t n = rows_per_slab(level);
    for (size_t row = slab * n; row < (slab + 1) * n; ++row) {
        const int half = half_of(level, row, ICCP_RED);
        const iccp_mg_run *end, *run = iccp_mg_runs(level, row, half, &end);
        for (; run < end; ++run) {
            const float *near[2 * ICC_MAX_DIM];
            const size_t at = iccp_mg_near_in(level, row, half, run->begin, level->x, near);
            level->kernels->add(level->x + at, near, run->end - run->begin, 2 * level->dim);
        }
    }
}

/* --------------------------------------------------------------- two levels */

/* Finds the first and the last x of a row's inside vertices. Returns false if there are none. */
static bool row_range(const iccp_mg_level *level, size_t row, uint32_t *first, uint32_t *last)
{
    *first = UINT32_MAX;
    *last = 0;
    for (uint32_t h = 0; h < 2; ++h) {
        const iccp_mg_run *end, *run = iccp_mg_runs(level, row, (int)h, &end);
        if (run == end)
            continue;
        const uint32_t low = 2 * run->begin + h, high = 2 * (end[-1].end - 1) + h;
        *first = low < *first ? low : *first;
        *last = high > *last ? high : *last;
    }
    return *first <= *last;
}

/* line[x - first] = weighted residuals around the vertices x of a coarse row. In rows an odd number
 * of steps away, red vertices are on the left and right of them. In other rows they have the same
 * x. */
static void collect(const iccp_mg_level *fine, size_t centre, uint32_t first, size_t n, float scale,
                    float *restrict line)
{
    size_t n_offsets = 1;
    for (int32_t k = 1; k < fine->dim; ++k)
        n_offsets *= 3;
    for (size_t i = 0; i < n; ++i)
        line[i] = 0;
    for (size_t offset = 0; offset < n_offsets; ++offset) {
        size_t row = centre, rest = offset;
        float weight = scale;
        int half = 0;
        for (int32_t k = 1; k < fine->dim; ++k, rest /= 3) {
            row = rest % 3 == 0   ? row - fine->stride[k]
                  : rest % 3 == 2 ? row + fine->stride[k]
                                  : row;
            weight *= rest % 3 == 1 ? 1.0f : 0.5f;
            half ^= rest % 3 != 1;
        }
        const iccp_mg_row *r = fine->row + row;
        if (r->first > r->last)
            continue;
        const float *x = fine->x + (r->base[half] + (ptrdiff_t)first - half);
        if (half == 0)
            for (size_t i = 0; i < n; ++i)
                line[i] += weight * x[i];
        else
            for (size_t i = 0; i < n; ++i)
                line[i] += 0.5f * weight * (x[i] + x[i + 1]);
    }
}

static size_t fine_row(const iccp_mg_level *coarse, const iccp_mg_level *fine, size_t row)
{
    size_t at = 0;
    for (int32_t k = 1; k < coarse->dim; ++k)
        at += 2 * (row / coarse->stride[k] % (coarse->extent[k] + 2)) * fine->stride[k];
    return at;
}

void iccp_mg_restrict(const iccp_mg_level *coarse, const iccp_mg_level *fine,
                      const iccp_mg_scratch *scratch, size_t slab)
{
    const size_t n = rows_per_slab(coarse);
    /* Keeps the energy of a function: sum of squared differences times spacing^(dim - 2). */
    float scale = 2;
    for (int32_t k = 1; k < coarse->dim; ++k)
        scale *= 0.5f;
    for (size_t row = slab * n; row < (slab + 1) * n; ++row) {
        uint32_t first, last;
        if (!row_range(coarse, row, &first, &last))
            continue;
        collect(fine, fine_row(coarse, fine, row), first, last - first + 1, scale, scratch->line);
        for (uint32_t h = 0; h < 2; ++h) {
            const iccp_mg_run *end, *run = iccp_mg_runs(coarse, row, (int)h, &end);
            for (; run < end; ++run) {
                float *restrict b = coarse->b + (coarse->row[row].base[h] + (ptrdiff_t)run->begin);
                const float *line = scratch->line + (2 * run->begin + h - first);
                for (size_t i = 0; i < run->end - run->begin; ++i)
                    b[i] = line[2 * i];
            }
        }
    }
}

/* line[x - first] = sum of the coarse rows around a fine row; `first` is even. Returns the number
 * of these rows. */
static size_t prolongate(const iccp_mg_level *coarse, const iccp_mg_level *fine, size_t row,
                         uint32_t first, size_t n_pairs, const iccp_mg_scratch *scratch)
{
    size_t odd[ICC_MAX_DIM], n_odd = 0, base = 0;
    for (int32_t k = 1; k < fine->dim; ++k) {
        const size_t c = row / fine->stride[k] % (fine->extent[k] + 2);
        base += c / 2 * coarse->stride[k];
        if (c % 2 != 0)
            odd[n_odd++] = coarse->stride[k];
    }
    float *restrict even_sum = scratch->even, *restrict odd_sum = scratch->odd;
    for (size_t corner = 0; corner < (size_t)1 << n_odd; ++corner) {
        size_t at = base;
        for (size_t j = 0; j < n_odd; ++j)
            at += corner >> j & 1 ? odd[j] : 0;
        const float *even_x = coarse->x + (coarse->row[at].base[0] + (ptrdiff_t)(first / 2));
        const float *odd_x = coarse->x + (coarse->row[at].base[1] + (ptrdiff_t)(first / 2));
        if (corner == 0)
            for (size_t i = 0; i < n_pairs; ++i) {
                even_sum[i] = even_x[i];
                odd_sum[i] = odd_x[i];
            }
        else
            for (size_t i = 0; i < n_pairs; ++i) {
                even_sum[i] += even_x[i];
                odd_sum[i] += odd_x[i];
            }
    }
    float *restrict line = scratch->line;
    for (size_t i = 0; i < n_pairs; ++i) {
        line[2 * i] = even_sum[i];
        line[2 * i + 1] = odd_sum[i];
    }
    return (size_t)1 << n_odd;
}

void iccp_mg_prolong(const iccp_mg_level *fine, const iccp_mg_level *coarse,
                     const iccp_mg_scratch *scratch, size_t slab)
{
    const size_t n = rows_per_slab(fine);
    for (size_t row = slab * n; row < (slab + 1) * n; ++row) {
        uint32_t first, last;
        if (!row_range(fine, row, &first, &last))
            continue;
        first = first / 4 * 2; /* even x on the coarse level */
        const int half = half_of(fine, row, ICCP_RED);
        const size_t n_rows =
            prolongate(coarse, fine, row, first, ((last + 1) / 2 - first) / 2 + 1, scratch);
        const float weight = 1 / (float)n_rows;
        const iccp_mg_run *end, *run = iccp_mg_runs(fine, row, half, &end);
        for (; run < end; ++run) {
            const size_t at = (size_t)(fine->row[row].base[half] + (ptrdiff_t)run->begin);
            const float *line = scratch->line + (run->begin - first);
            const float *inverse = inverse_at(fine, scratch, at), *b = fine->b + at;
            float *restrict x = fine->x + at;
            if (half == 0)
                for (size_t i = 0; i < run->end - run->begin; ++i)
                    x[i] = inverse[i] * b[i] + weight * line[i];
            else
                for (size_t i = 0; i < run->end - run->begin; ++i)
                    x[i] = inverse[i] * b[i] + 0.5f * weight * (line[i] + line[i + 1]);
        }
    }
}
