/* Proposes how the chains of a map could slide to lower its energy. */
#ifndef ICCP_SLIDE_STEP_H
#define ICCP_SLIDE_STEP_H

#include "map/compatible/plmap.h"
#include "map/slide/knots.h"

typedef enum iccp_slide_way {
    ICCP_SLIDE_EVENLY, /* chains correspond by their lengths */
    ICCP_SLIDE_DOWN    /* vertices go where Newton's steps move them */
} iccp_slide_way;

typedef struct iccp_slide_request {
    iccp_slide_way way;
    double share;           /* of the step to take, in (0, 1] */
    bool moves_rim;         /* the chains of the rim slide, too */
    const uint8_t *is_held; /* by given vertex: 1 if it stays a partner of itself, or NULL */
} iccp_slide_request;

/* Proposes a slide. `map` is a map between the domains with the knots of `slide`. *out is NULL if
 * no chain can slide, or if rounding would swap knots. Knots may still come so close that making
 * the domains with them fails. */
icc_status iccp_slide_propose(iccp_slide **out, const iccp_slide *slide, const iccp_plmap *map,
                              const iccp_slide_request *request, const iccp_env *env);

#endif
