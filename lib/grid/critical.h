/* Critical vertices of an order of the vertices of a grid. */
#ifndef ICCP_GRID_CRITICAL_H
#define ICCP_GRID_CRITICAL_H

#include "grid/star.h"

/* An order of some of the vertices inside; those that are not `ranked` are lower than all others. It
 * is asked from several threads at a time. */
typedef struct iccp_ordering {
    const void *context;
    bool (*ranked)(const void *context, uint32_t v);
    bool (*is_higher)(const void *context, uint32_t u, uint32_t v); /* for two that are ranked */
    size_t n_ranked;
    uint32_t highest; /* where a maximum is expected */
} iccp_ordering;

/* Counts critical vertices; see icc_field_report, of which all but `size` is filled in. ICC_ERR_MEMORY or
 * ICC_ERR_CANCELLED leave it as it was. */
icc_status iccp_grid_critical(const icc_grid *grid, const iccp_ordering *ordering,
                              icc_field_report *report, const iccp_env *env);

#endif
