/* Masks: copies, and the vertices of their cut lattice. */
#include "domain/mask.h"

#include "base/budget.h"
#include "base/error.h"

#include <assert.h>

/* Returns the number of vertices of a grid on the cut lattice, with two spare layers on every side.
 * SIZE_MAX means too many. */
static size_t count_lattice(int32_t dim, const size_t *shape)
{
    size_t n = 1;
    for (int32_t k = 0; k < dim; ++k) {
        if (shape[k] > ICCP_MAX_LATTICE || 2 * shape[k] + 5 > ICCP_MAX_LATTICE / n)
            return SIZE_MAX;
        n *= 2 * shape[k] + 5;
    }
    return n;
}

static void copy_cells(iccp_mask *mask, const uint8_t *cells)
{
    size_t at[ICC_MAX_DIM] = {0};
    for (size_t row = 0;; row += mask->shape[0]) {
        size_t first = 1;
        for (int32_t k = 1; k < mask->dim; ++k)
            first += (at[k] + 1) * mask->stride[k];
        for (size_t i = 0; i < mask->shape[0]; ++i)
            mask->cells[first + i] = cells[row + i] != 0;
        int32_t k = 1;
        while (k < mask->dim && ++at[k] == mask->shape[k])
            at[k++] = 0;
        if (k >= mask->dim)
            return;
    }
}

/* Bytes per vertex of the cut lattice while a mask is checked and its boundary is made. */
static const double BYTES_PER_POINT = 6;

icc_status iccp_mask_create(iccp_mask **out, int32_t dim, const size_t *shape, const uint8_t *cells,
                            const iccp_env *env, icc_error *err)
{
    assert(dim >= 1 && dim <= ICC_MAX_DIM);
    *out = NULL;
    if (count_lattice(dim, shape) > ICCP_MAX_LATTICE)
        return iccp_fail(err, ICC_ERR_RESOLUTION,
                         "the mask is too large: its cells, cut in two along each axis, have more "
                         "than %zu vertices",
                         ICCP_MAX_LATTICE);
    icc_status status = iccp_budget_keep(env, BYTES_PER_POINT * (double)count_lattice(dim, shape));
    if (status == ICC_OK)
        status = iccp_budget_work(env, (double)count_lattice(dim, shape) * (double)(8 << dim));
    if (status != ICC_OK)
        return iccp_explain(err, status);
    iccp_mask *mask = iccp_alloc_zero(&env->memory, 1, sizeof *mask);
    if (mask == NULL)
        return iccp_fail_memory(err);
    mask->memory = env->memory;
    mask->dim = dim;
    mask->n_padded = 1;
    for (int32_t k = 0; k < dim; ++k) {
        assert(shape[k] > 0);
        mask->shape[k] = shape[k];
        mask->stride[k] = mask->n_padded;
        mask->n_padded *= shape[k] + 2;
    }
    mask->cells = iccp_alloc_zero(&env->memory, mask->n_padded, sizeof *mask->cells);
    if (mask->cells == NULL) {
        iccp_mask_free(mask);
        return iccp_fail_memory(err);
    }
    copy_cells(mask, cells);
    *out = mask;
    return ICC_OK;
}

void iccp_mask_free(iccp_mask *mask)
{
    if (mask == NULL)
        return;
    const iccp_memory memory = mask->memory;
    iccp_free(&memory, mask->cells);
    iccp_free(&memory, mask);
}

int64_t iccp_mask_coordinates(const iccp_mask *mask, size_t cell, int64_t *coordinates)
{
    int64_t index = 0, n = 1;
    for (int32_t k = 0; k < mask->dim; ++k) {
        coordinates[k] = (int64_t)(cell / mask->stride[k] % (mask->shape[k] + 2)) - 1;
        index += n * coordinates[k];
        n *= (int64_t)mask->shape[k];
    }
    return index;
}

size_t iccp_mask_cell(const iccp_mask *mask, const size_t *at, int bit)
{
    size_t cell = 0;
    for (int32_t k = 0; k < mask->dim; ++k) {
        cell += (at[k] + 1) / 2 * mask->stride[k];
        if (at[k] % 2 == 0) {
            cell += (size_t)(bit & 1) * mask->stride[k];
            bit >>= 1;
        }
    }
    return cell;
}

uint64_t iccp_mask_block(const iccp_mask *mask, const size_t *at, int *n_axes)
{
    size_t lowest = 0, around[1 << ICC_MAX_DIM];
    int n = 0;
    around[0] = 0;
    for (int32_t k = 0; k < mask->dim; ++k) {
        lowest += (at[k] + 1) / 2 * mask->stride[k];
        if (at[k] % 2 != 0)
            continue;
        for (int b = 0; b < 1 << n; ++b)
            around[(1 << n) + b] = around[b] + mask->stride[k];
        ++n;
    }
    uint64_t block = 0;
    for (int b = 0; b < 1 << n; ++b)
        block |= (uint64_t)mask->cells[lowest + around[b]] << b;
    *n_axes = n;
    return block;
}

bool iccp_mask_next(const iccp_mask *mask, size_t *at)
{
    for (int32_t k = 0; k < mask->dim; ++k) {
        if (++at[k] <= 2 * mask->shape[k])
            return true;
        at[k] = 0;
    }
    return false;
}
