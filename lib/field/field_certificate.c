/* Certifies a chart of method field by the three conditions of docs/theory/charts-space.md,
 * "fields on grids":
 * 1. Each vertex has a vector along which the function rises. choose_all() in vectors.c counts the
 *    vertices that have none.
 * 2. At the corners of all simplices that the boundary runs through, the vectors point inward.
 *    check_inward() in vectors.c counts the contacts that fail.
 * 3. The inside vertices form a ball. make_tree() in chart_field.c refuses what is no ball, and the
 *    grid counts the vertices that it had to give up. */
#include "field/field_certificate.h"

void iccp_field_certify(const iccp_field_state *state, icc_chart *chart)
{
    icc_field_info *own = &chart->own.field;
    own->n_infeasible = state->vectors.n_infeasible;
    own->n_contacts = state->vectors.n_contacts;
    own->n_not_inward = state->vectors.n_not_inward;
    own->n_stray = state->tree->grid->n_stray;
    chart->info.reason = own->n_infeasible > 0   ? ICC_REASON_INFEASIBLE
                         : own->n_not_inward > 0 ? ICC_REASON_NOT_INWARD
                         : own->n_stray > 0      ? ICC_REASON_STRAY
                                                 : ICC_REASON_NONE;
    chart->info.certified = chart->info.reason == ICC_REASON_NONE;
}
