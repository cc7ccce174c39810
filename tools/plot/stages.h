/* A chart, and the stages of methods gradient and field that made it, so that they can be drawn. */
#ifndef STAGES_H
#define STAGES_H

#include "job/job.h"

#include <icc/stages.h>

typedef struct stages {
    const icc_domain *domain;
    const icc_chart *chart;
    const icc_map *map; /* the map to which the chart belongs; or NULL */
    icc_domain_info box;
    icc_chart_info chart_info;
    /* For methods gradient and field, borrowed from the chart; else NULL. */
    const icc_function *field;
    const icc_tree *tree;
    const icc_grid *grid;
    icc_grid_info lattice;
    icc_function_info field_info;
    icc_solver_report solved;
    const double *values; /* the drawn values of the function, or their logarithms */
    bool logarithmic;
    double low, high; /* the least and largest of them inside */
    size_t n_edges;   /* in the plane; otherwise 0 */
    uint32_t *edges;  /* n_edges pairs: compression and expansion edges */
    int32_t *kinds;
    size_t n_expansion;
    size_t n_inner_expansion; /* expansion edges whose two triangles are inside */
} stages;

/* Makes the stages of the chart that the job made of the source (side 1), or of the map's source or
 * target (2). Methods other than gradient have no stages; their function is t. */
int stages_make(stages *out, job *j, int side);
void stages_free(stages *s);

/* The position of a grid vertex: as many coordinates as the grid has dimensions. */
void stages_position(const stages *s, uint32_t vertex, double *out);

/* In the plane: the number of holes of the region of triangles whose vertices are all inside and in
 * the tree. Each hole brings a saddle to any function that is lower outside. */
size_t stages_holes(const stages *s);

/* The function of method gradient, linear in every triangle, or its logarithm, which is -HUGE_VAL
 * where the function is 0. NaN where it is not defined. */
double stages_value(const stages *s, const double p[2]);

/* The function of any method at n points. */
int stages_values(const stages *s, job *j, size_t n, const double *points, double *values);

#endif
