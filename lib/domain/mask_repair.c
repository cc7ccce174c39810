/* Greedy repair, like the repair of well-composedness in L. Latecki, 3D Well-Composed Pictures,
 * 1997, section 6. Of the gaps around a contact, it fills the one that leaves the fewest contacts
 * around it. It fills none if every filling would create more contacts than before. */
#include "domain/mask_repair.h"

#include "geometry/octants.h"

static const size_t VERTICES_PER_REPORT = 1 << 14;

static bool is_contact(const iccp_mask *mask, const size_t *at)
{
    int n_axes;
    const uint64_t block = iccp_mask_block(mask, at, &n_axes);
    return block != 0 && block != iccp_mask_full(n_axes) &&
           !iccp_octants_contractible(block, n_axes);
}

/* Counts contacts on the corners, edges, .. of a cell. */
static int count_contacts(const iccp_mask *mask, const int64_t *cell)
{
    int n = 0, step[ICC_MAX_DIM] = {0};
    for (;;) {
        size_t at[ICC_MAX_DIM];
        for (int32_t k = 0; k < mask->dim; ++k)
            at[k] = (size_t)(2 * cell[k] + step[k]);
        n += is_contact(mask, at);
        int32_t k = 0;
        while (k < mask->dim && ++step[k] > 2)
            step[k++] = 0;
        if (k == mask->dim)
            return n;
    }
}

static bool within(const iccp_mask *mask, const int64_t *cell)
{
    for (int32_t k = 0; k < mask->dim; ++k)
        if (cell[k] < 0 || cell[k] >= (int64_t)mask->shape[k])
            return false;
    return true;
}

/* Returns how many contacts are added when a cell is filled. */
static int count_change(iccp_mask *mask, size_t position, const int64_t *cell)
{
    const int before = count_contacts(mask, cell);
    mask->cells[position] = 1;
    const int after = count_contacts(mask, cell);
    mask->cells[position] = 0;
    return after - before;
}

/* Fills the best of the empty cells around the vertex, edge, .. `at`: the first of those that leave
 * the fewest contacts. Returns false and fills none if each of them would create more contacts than
 * there were. */
static bool fill_gap(iccp_mask *mask, const size_t *at)
{
    int n_axes, least = 1;
    const uint64_t block = iccp_mask_block(mask, at, &n_axes);
    size_t best = 0;
    for (int bit = 0; bit < 1 << n_axes; ++bit) {
        int64_t cell[ICC_MAX_DIM];
        const size_t position = iccp_mask_cell(mask, at, bit);
        (void)iccp_mask_coordinates(mask, position, cell);
        if ((block >> bit & 1) != 0 || !within(mask, cell))
            continue;
        const int grows = count_change(mask, position, cell);
        if (grows < least) {
            least = grows;
            best = position;
        }
    }
    if (least <= 0)
        mask->cells[best] = 1;
    return least <= 0;
}

icc_status iccp_mask_repair(iccp_mask *mask, size_t *n_filled, const iccp_env *env)
{
    size_t n_before, n_done = 0;
    *n_filled = 0;
    do {
        size_t at[ICC_MAX_DIM] = {0};
        n_before = *n_filled;
        do {
            if (n_done++ % VERTICES_PER_REPORT == 0 && iccp_progress(env, "repair", 0) != ICC_OK)
                return ICC_ERR_CANCELLED;
            *n_filled += is_contact(mask, at) && fill_gap(mask, at);
        } while (iccp_mask_next(mask, at));
    } while (*n_filled > n_before);
    return ICC_OK;
}
