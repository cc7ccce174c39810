/* The ball on the way onto what can be seen from one point inside. */
#ifndef ICCP_SOLID_BALL_H
#define ICCP_SOLID_BALL_H

#include "chart/chart.h"

/* A domain in space with the triangles of `domain` and the directions of the target's vertices from
 * the apex for vertices, filled, and a chart of it. *ball is NULL, with ICC_OK, where no point sees
 * all of the target's surface, or doubles are too coarse, or it is a ball already. `source` has a
 * mesh, and the same triangles. */
icc_status iccp_solid_ball(icc_chart **ball, double apex[3], const icc_domain *source,
                           const icc_domain *target, const iccp_env *env);

#endif
