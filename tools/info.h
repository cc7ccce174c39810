/* What `libicc info` found out, and the two ways to tell it. */
#ifndef INFO_H
#define INFO_H

#include "job.h"

#include <icc/stages.h>

/* What becomes of the area under the map, by its derivative at evenly spread points. */
typedef struct map_shares {
    size_t n; /* points; 0: there is no map */
    double without_image, collapsed, inverted;
    /* The symmetric Dirichlet energy |J|^2 + |J^-1|^2 where neither is the case, both shapes scaled to
     * the same area: 4 where the shape of things is kept. */
    double mean, median, nearly_all; /* 99 % are below the last one */
} map_shares;

typedef struct info {
    job job;
    icc_domain_info domain;
    icc_chart_info chart;
    icc_chart_measures measures;
    /* Method gradient. */
    icc_field_info field;
    bool has_critical; /* besides the maximum there are others, the first one here */
    double critical[2];
    size_t n_holes;           /* of the grid's inside */
    size_t n_inner_expansion; /* expansion edges between two triangles inside */
    icc_map_info map;
    map_shares shares;
} info;

/* Why the function has other critical points than one maximum, for those that have. */
const char *info_reason(char text[240], const info *x);

void info_print(const info *x);

/* Writes the report of --json. */
int info_report(const info *x);

#endif
