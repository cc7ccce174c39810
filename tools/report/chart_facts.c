/* Gets the facts of a chart from the library, by its method. */
#include "report/chart_facts.h"

/* The members that the structs of methods gradient and field share. */
#define GRID_FACTS(own, form)                                                                      \
    ((grid_facts){.tree = (form),                                                                  \
                  .n_vertices = (own).n_grid,                                                      \
                  .n_inside = (own).n_inside,                                                      \
                  .n_tree = (own).n_tree,                                                          \
                  .n_unreachable = (own).n_unreachable,                                            \
                  .n_cousin_violations = (own).n_cousin_violations,                                \
                  .n_maxima = (own).n_maxima,                                                      \
                  .n_minima = (own).n_minima,                                                      \
                  .n_saddles = (own).n_saddles})

/* The members that the structs on meshes share. */
#define MESH_FACTS(own, share)                                                                     \
    ((mesh_facts){.n_vertices = (own).n_mesh_vertices,                                             \
                  .n_boundary = (own).n_mesh_boundary,                                             \
                  .n_simplices = (own).n_mesh_simplices,                                           \
                  .harmonic_share = (share)})

chart_facts chart_facts_of(const icc_chart *chart)
{
    chart_facts c = {.common = {.size = sizeof c.common},
                     .seconds = {.size = sizeof c.seconds},
                     .gradient = {.size = sizeof c.gradient},
                     .field = {.size = sizeof c.field},
                     .foliation = {.size = sizeof c.foliation},
                     .shelling = {.size = sizeof c.shelling}};
    icc_disc_info disc = {.size = sizeof disc};
    if (chart == NULL)
        return c;
    icc_chart_get_info(chart, &c.common);
    icc_chart_get_timings(chart, &c.seconds);
    if (icc_chart_get_gradient_info(chart, &c.gradient) == ICC_OK)
        c.grid = GRID_FACTS(c.gradient, c.gradient.tree);
    if (icc_chart_get_field_info(chart, &c.field) == ICC_OK)
        c.grid = GRID_FACTS(c.field, ICC_TREE_THESIS);
    if (icc_chart_get_foliation_info(chart, &c.foliation) == ICC_OK)
        c.mesh = MESH_FACTS(c.foliation, c.foliation.harmonic_share);
    c.is_shelling = icc_chart_get_shelling_info(chart, &c.shelling) == ICC_OK;
    if (c.is_shelling)
        c.mesh = MESH_FACTS(c.shelling, c.shelling.harmonic_share);
    if (icc_chart_get_disc_info(chart, &disc) == ICC_OK)
        c.mesh = MESH_FACTS(disc, 0);
    return c;
}

bool chart_has_grid(const chart_facts *c)
{
    return c->common.method == ICC_METHOD_GRADIENT || c->common.method == ICC_METHOD_FIELD;
}
