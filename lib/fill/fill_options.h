/* How filling chooses inner vertices. */
#ifndef ICCP_FILL_OPTIONS_H
#define ICCP_FILL_OPTIONS_H

#include <stdbool.h>
#include <stdint.h>

/* Default of the ratio in icc_fill_options. */
#define ICCP_FILL_RATIO 1.6

typedef struct iccp_fill_options {
    double ratio;
    uint64_t max_points;
    /* The mesh is made to be mapped. A map moves inner vertices only, so it needs them everywhere:
     * also where good tetrahedra have four corners on the surface, and as close to one another as
     * the vertices of the surface. */
    bool for_map;
} iccp_fill_options;

#endif
