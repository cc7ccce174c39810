/* The stages of a chart once more, each by itself, so that they can be drawn. */
#ifndef STAGES_H
#define STAGES_H

#include "job.h"

#include <icc/stages.h>

typedef struct stages {
    const icc_domain *domain;
    const icc_chart *chart;
    icc_domain_info box;
    icc_chart_info chart_info;
    /* Method gradient; else NULL. */
    icc_grid *grid;
    icc_grid_info lattice;
    icc_tree *tree;
    icc_field *field;
    double low, high; /* least and largest value inside */
    size_t n_edges;
    uint32_t *edges; /* n_edges pairs: compression and expansion edges */
    int32_t *kinds;
} stages;

/* Repeats the stages of the source's (side 1) or the target's (2) chart, with the same maximum. Only the
 * method gradient has any; for others the function is t. */
int stages_make(stages *out, job *j, int side);
void stages_free(stages *s);

/* The position of a grid vertex. */
void stages_position(const stages *s, uint32_t vertex, double out[2]);

/* The function of method gradient, linear in every triangle; NaN where it is not defined. */
double stages_value(const stages *s, const double p[2]);

/* The function of any method at n points. */
int stages_values(const stages *s, job *j, size_t n, const double *points, double *values);

#endif
