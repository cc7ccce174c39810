/* A chart, and the stages of methods gradient and field that it was made in, so that they can be
 * drawn. */
#ifndef STAGES_H
#define STAGES_H

#include "job/job.h"

#include <icc/stages.h>

typedef struct stages {
    const icc_domain *domain;
    const icc_chart *chart;
    const icc_map *map; /* that the chart belongs to; or NULL */
    icc_domain_info box;
    icc_chart_info chart_info;
    /* Methods gradient and field; else NULL. Borrowed from the chart. */
    const icc_function *field;
    const icc_tree *tree;
    const icc_grid *grid;
    icc_grid_info lattice;
    icc_function_info field_info;
    const double *values; /* what is drawn of the function: its values, or their logarithms */
    bool logarithmic;
    double low, high; /* least and largest of them inside */
    size_t n_edges;   /* in the plane; else none */
    uint32_t *edges;  /* n_edges pairs: compression and expansion edges */
    int32_t *kinds;
    size_t n_expansion;
    size_t n_inner_expansion; /* expansion edges whose two triangles are inside */
} stages;

/* Of the chart that the job has made of the source (side 1), or of its map's source or target (2).
 * Other methods than gradient have no stages; their function is t. */
int stages_make(stages *out, job *j, int side);
void stages_free(stages *s);

/* The position of a grid vertex: as many coordinates as the grid has dimensions. */
void stages_position(const stages *s, uint32_t vertex, double *out);

/* In the plane: around how many holes the triangles lie whose vertices are all inside and in the
 * tree. Each brings a saddle to any function that is lower outside. */
size_t stages_holes(const stages *s);

/* The function of method gradient, linear in every triangle, or its logarithm, which is
 * -HUGE_VAL where the function is 0; NaN where it is not defined. */
double stages_value(const stages *s, const double p[2]);

/* The function of any method at n points. */
int stages_values(const stages *s, job *j, size_t n, const double *points, double *values);

#endif
