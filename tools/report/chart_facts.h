/* Facts about a chart of any method. */
#ifndef CHART_FACTS_H
#define CHART_FACTS_H

#include <icc/icc.h>

#include <stdbool.h>

/* Methods gradient and field. */
typedef struct grid_facts {
    int32_t tree; /* ICC_TREE_* */
    size_t n_vertices, n_inside, n_tree, n_unreachable, n_cousin_violations;
    size_t n_maxima, n_minima, n_saddles; /* of the function */
} grid_facts;

/* Methods foliation and disc. */
typedef struct mesh_facts {
    size_t n_vertices, n_boundary, n_simplices;
    double harmonic_share; /* foliation */
} mesh_facts;

/* Members that a chart does not have are 0. */
typedef struct chart_facts {
    icc_chart_info common;
    icc_chart_timings seconds;
    grid_facts grid;
    mesh_facts mesh;
    icc_gradient_info gradient;
    icc_field_info field;
    icc_foliation_info foliation;
    icc_shelling_info shelling;
    bool is_shelling; /* a foliation on the domain's mesh */
} chart_facts;

/* NULL gives method 0 and no facts. */
chart_facts chart_facts_of(const icc_chart *chart);

/* True if the chart was made on a grid (methods gradient and field). */
bool chart_has_grid(const chart_facts *c);

#endif
