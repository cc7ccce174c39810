/* Counts the critical vertices of an order, in parallel. */
#include "gradient/grid/critical_count.h"

#include <string.h>

static const size_t GRAIN = 1 << 12; /* vertices per chunk: at most 0.4 s, in 6-D */

void iccp_critical_put(const iccp_critical *count, size_t begin, const icc_function_report *found)
{
    count->partial[begin / GRAIN] = *found;
}

icc_status iccp_critical_count(const icc_grid *grid, const void *context, size_t n_ranked,
                               uint32_t highest, iccp_chunk chunk, icc_function_report *report,
                               const iccp_env *env)
{
    const size_t n_chunks = (grid->n_vertices + GRAIN - 1) / GRAIN;
    iccp_critical count = {.context = context, .highest = highest};
    count.partial = iccp_alloc(&env->memory, n_chunks, sizeof *count.partial);
    if (count.partial == NULL)
        return ICC_ERR_MEMORY;
    iccp_star_init(&count.star, grid, n_ranked);
    const icc_status status = iccp_for_chunks(env, "check", grid->n_vertices, GRAIN, chunk, &count);
    if (status == ICC_OK) {
        /* Including its padding: equal reports have equal bytes */
        memset(report, 0, sizeof *report);
        report->critical = ICCP_NONE;
        for (size_t c = n_chunks; c-- > 0;) {
            report->n_maxima += count.partial[c].n_maxima;
            report->n_minima += count.partial[c].n_minima;
            report->n_saddles += count.partial[c].n_saddles;
            if (count.partial[c].critical != ICCP_NONE)
                report->critical = count.partial[c].critical;
        }
    }
    iccp_free(&env->memory, count.partial);
    return status;
}
