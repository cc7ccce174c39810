/* The results of `libicc info`, and two ways to print them.
 *
 * Words of this folder
 * - facts: data of a chart that all methods share (chart_facts.h).
 * - reason: words that tell why a chart or a map is not certified (reason.h).
 * - report: the JSON of --json (info_report.c, check_report.c).
 * - shares: how areas change under a map (info_shares.c).
 *
 * Ways: info_print.c prints, info_report.c writes JSON, info_words.c has words of both, sample.h
 * spreads points. Of `check`: check_find.c finds, check_report.c prints and reports, check_write.c
 * repairs.
 *
 * Begin with this file for `libicc info`, and with check_job.h for `libicc check`. */
#ifndef INFO_H
#define INFO_H

#include "job/job.h"
#include "report/chart_facts.h"

#include <icc/stages.h>

/* How areas or volumes change under the map, by its derivative at evenly spread points. */
typedef struct map_shares {
    size_t n; /* points; 0 if there is no map */
    double without_image, collapsed, inverted;
    /* The symmetric Dirichlet energy |J|^2 + |J^-1|^2 at points that are neither folded nor
     * collapsed, with both shapes scaled to the same measure. It is twice the dimension if shape is
     * preserved. */
    double mean, median, nearly_all; /* 99 % are below the last one */
} map_shares;

typedef struct info {
    job job;
    icc_domain_info domain;
    chart_facts chart;
    icc_chart_report measures;
    /* Methods gradient and field. */
    icc_grid_info grid;
    icc_function_info field;
    icc_solver_report solved;
    bool has_critical; /* there are critical points besides the maximum; the first one is here */
    double critical[ICC_MAX_DIM];
    size_t n_order_critical;  /* critical vertices of the tree's own order, besides the maximum */
    icc_grow_report growth;   /* of an order that falls with the function; in more than 2
                                 dimensions */
    bool grown;               /* true if it reached the end */
    size_t n_holes;           /* of the grid's inside, in the plane */
    size_t n_inner_expansion; /* expansion edges between two triangles inside */
    icc_map_info map;
    icc_map_report made;
    map_shares shares;
} info;

/* Samples the map's derivative. */
int info_measure_map(info *x);

/* Why the function has critical points besides one maximum, if it has. */
const char *info_reason(char text[240], const info *x);

/* How the order of the vertices was found, in words. */
const char *info_growth(char text[160], const info *x);

void info_print(const info *x);

/* Writes the report of --json. */
int info_report(const info *x);

#endif
