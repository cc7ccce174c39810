/* The ball through which a solid is mapped onto a star-shaped one. */
#ifndef ICCP_SOLID_BALL_H
#define ICCP_SOLID_BALL_H

#include "chart/chart.h"

/* Makes a filled domain in space and a chart of it. It has the triangles of `source`, and its
 * vertices are the directions of the target's vertices from the apex. `source` has a mesh, and the
 * same triangles as the target. *ball is NULL, with ICC_OK, if no point sees all of the target's
 * surface, if doubles are too coarse, or if the target is a ball already. */
icc_status iccp_solid_ball(icc_chart **ball, double apex[3], const icc_domain *source,
                           const icc_domain *target, const iccp_env *env);

#endif
