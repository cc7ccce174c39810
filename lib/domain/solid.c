/* Checks that a mask is a solid without holes. Based on: L. Latecki, 3D Well-Composed Pictures,
 * Graphical Models and Image Processing 59, 1997. Beyond 3-D its condition is not enough (N. Boutry
 * et al., A 4D Counter-Example Showing that DWCness Does not Imply CWCness in nD, 2020). So here
 * the cells around every corner, edge, .. must form a ball.
 *
 * A connected solid with a connected outside has no holes of dimension n - 1 (Alexander duality).
 * So those of dimensions 1 to n - 2 remain to be counted. In the plane there are no others. In
 * space the Euler characteristic is 1 minus their number. Without holes the boundary is a sphere
 * and the solid a ball (Alexander's theorem). */
#include "domain/solid.h"

#include "base/error.h"
#include "geometry/octants.h"

#include <inttypes.h>
#include <stdio.h>

static const size_t CELLS_PER_REPORT = 1 << 16;

enum { TEXT_SIZE = 128 };

/* Writes a text such as "cell 17 (2, 3, 1)". Cells outside the solid also have coordinates in the
 * mask, except the extra cells around it. */
static int64_t describe(const iccp_mask *mask, size_t cell, char *text)
{
    int64_t at[ICC_MAX_DIM];
    const int64_t index = iccp_mask_coordinates(mask, cell, at);
    int used = snprintf(text, TEXT_SIZE, "cell %" PRId64, index);
    for (int32_t k = 0; k < mask->dim; ++k)
        used += snprintf(text + used, (size_t)(TEXT_SIZE - used), "%s%" PRId64,
                         k == 0 ? " (" : ", ", at[k]);
    (void)snprintf(text + used, (size_t)(TEXT_SIZE - used), ")");
    return index;
}

/* ------------------------------------------------------------------ pieces */

typedef struct flood {
    const iccp_mask *mask;
    uint8_t *reached; /* by position in `cells` */
    uint32_t *queue;  /* the n_reached cells reached */
    size_t n_reached;
} flood;

static icc_status flood_start(flood *f, const iccp_mask *mask, const iccp_env *env)
{
    *f = (flood){.mask = mask};
    f->reached = iccp_alloc_zero(&env->memory, mask->n_padded, sizeof *f->reached);
    f->queue = iccp_alloc(&env->memory, mask->n_padded, sizeof *f->queue);
    return f->reached != NULL && f->queue != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

static void flood_end(flood *f, const iccp_env *env)
{
    iccp_free(&env->memory, f->reached);
    iccp_free(&env->memory, f->queue);
}

static void reach(flood *f, size_t cell)
{
    f->reached[cell] = 1;
    f->queue[f->n_reached++] = (uint32_t)cell;
}

/* Reaches all cells of a kind that are joined to `start` through faces. */
static icc_status flood_from(flood *f, size_t start, const iccp_env *env)
{
    const iccp_mask *mask = f->mask;
    const uint8_t kind = mask->cells[start];
    size_t next = f->n_reached;
    reach(f, start);
    for (; next < f->n_reached; ++next) {
        if (next % CELLS_PER_REPORT == 0 &&
            iccp_progress(env, "check", (double)next / (double)mask->n_padded) != ICC_OK)
            return ICC_ERR_CANCELLED;
        const size_t cell = f->queue[next];
        for (int32_t k = 0; k < mask->dim; ++k) {
            const size_t at = cell / mask->stride[k] % (mask->shape[k] + 2);
            const size_t below = cell - mask->stride[k], above = cell + mask->stride[k];
            if (at > 0 && mask->cells[below] == kind && !f->reached[below])
                reach(f, below);
            if (at <= mask->shape[k] && mask->cells[above] == kind && !f->reached[above])
                reach(f, above);
        }
    }
    return ICC_OK;
}

/* Returns the first cell of a kind that has not been reached, or n_padded. */
static size_t first_left(const flood *f, uint8_t kind)
{
    size_t cell = 0;
    while (cell < f->mask->n_padded && (f->mask->cells[cell] != kind || f->reached[cell]))
        ++cell;
    return cell;
}

static icc_status check_inside(flood *f, const iccp_env *env, icc_error *err)
{
    const iccp_mask *mask = f->mask;
    const size_t first = first_left(f, 1);
    if (first == mask->n_padded)
        return iccp_fail(err, ICC_ERR_TOPOLOGY, "the mask is empty: no cell is inside");
    if (flood_from(f, first, env) != ICC_OK)
        return ICC_ERR_CANCELLED;
    const size_t other = first_left(f, 1);
    if (other == mask->n_padded)
        return ICC_OK;
    char from[TEXT_SIZE], to[TEXT_SIZE];
    (void)describe(mask, first, from);
    const int64_t index = describe(mask, other, to);
    return iccp_fail_at(
        err, ICC_ERR_TOPOLOGY, ICC_ITEM_CELL, index,
        "the mask is not one piece: no way through cells with common faces leads from "
        "%s to %s",
        from, to);
}

/* In 1-D the outside always has two pieces. */
static icc_status check_outside(flood *f, const iccp_env *env, icc_error *err)
{
    const iccp_mask *mask = f->mask;
    if (mask->dim == 1)
        return ICC_OK;
    if (flood_from(f, 0, env) != ICC_OK)
        return ICC_ERR_CANCELLED;
    const size_t other = first_left(f, 0);
    if (other == mask->n_padded)
        return ICC_OK;
    char text[TEXT_SIZE];
    const int64_t index = describe(mask, other, text);
    return iccp_fail_at(
        err, ICC_ERR_TOPOLOGY, ICC_ITEM_CELL, index,
        "the mask encloses a hole: %s, outside, is cut off from the rest of the outside", text);
}

/* ------------------------------------------------------------------- shape */

static icc_status fail_contact(const iccp_mask *mask, const size_t *at, uint64_t block,
                               icc_error *err)
{
    int bit = 0;
    while ((block >> bit & 1) == 0)
        ++bit;
    char text[TEXT_SIZE];
    const int64_t index = describe(mask, iccp_mask_cell(mask, at, bit), text);
    return iccp_fail_at(
        err, ICC_ERR_TOPOLOGY, ICC_ITEM_CELL, index,
        "at %s the boundary of the mask touches itself: cells, or gaps between cells, "
        "meet there only along an edge or a corner",
        text);
}

/* Visits and counts the corners, edges, .. and cells. */
static icc_status check_corners(const iccp_mask *mask, int64_t *euler, const iccp_env *env,
                                icc_error *err)
{
    size_t at[ICC_MAX_DIM] = {0}, n_done = 0;
    *euler = 0;
    do {
        int n_axes;
        const uint64_t block = iccp_mask_block(mask, at, &n_axes);
        if (n_done++ % CELLS_PER_REPORT == 0) {
            const double share =
                (double)at[mask->dim - 1] / (2.0 * (double)mask->shape[mask->dim - 1]);
            if (iccp_progress(env, "check", share) != ICC_OK)
                return ICC_ERR_CANCELLED;
        }
        if (block == 0)
            continue;
        if (block != iccp_mask_full(n_axes) && !iccp_octants_contractible(block, n_axes))
            return fail_contact(mask, at, block, err);
        *euler += (mask->dim - n_axes) % 2 == 0 ? 1 : -1;
    } while (iccp_mask_next(mask, at));
    return ICC_OK;
}

static icc_status check_euler(int64_t euler, icc_error *err)
{
    if (euler == 1)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_TOPOLOGY,
                     "the mask has a tunnel or another hole: its Euler characteristic is %" PRId64
                     ", not 1",
                     euler);
}

icc_status iccp_mask_check(const iccp_mask *mask, const iccp_env *env, icc_error *err)
{
    flood f;
    int64_t euler = 0;
    icc_status status = flood_start(&f, mask, env);
    if (status == ICC_OK)
        status = check_inside(&f, env, err);
    if (status == ICC_OK)
        status = check_corners(mask, &euler, env, err);
    if (status == ICC_OK)
        status = check_outside(&f, env, err);
    if (status == ICC_OK)
        status = check_euler(euler, err);
    flood_end(&f, env);
    return iccp_explain(err, status);
}
