/* The state of a chart of method foliation on the caller's mesh, and its operations. Source: see
 * shelling_state.c. */
#ifndef ICCP_SHELLING_STATE_H
#define ICCP_SHELLING_STATE_H

#include "chart/chart.h"
#include "shelling/leafn.h"

typedef struct iccp_shelling_state {
    iccp_simplices *mesh; /* the chart's own mesh if the domain's has no vertex inside; else NULL */
    iccp_leaves leaves;
} iccp_shelling_state;

extern const iccp_chart_ops iccp_shelling_ops;

/* Creates a chart with its mesh and its centre, but without leaves. Takes over `own`, even on
 * failure. If it is NULL, the domain's mesh is used. */
icc_status iccp_shelling_begin(icc_chart **out, const icc_domain *domain, iccp_simplices *own,
                               uint32_t centre, const iccp_env *env);

/* Reads or writes the first part of the chart's bytes: information on how the order was found,
 * the chart's own mesh or NULL, and the centre. */
icc_status iccp_shelling_visit_head(iccp_blob *b, icc_shelling_info *facts, iccp_simplices **own,
                                    uint64_t *centre, const icc_domain *domain);

#endif
