#include "chart/gradient_state.h"

void iccp_gradient_inward(const icc_domain *domain, uint32_t facet, double inward[2])
{
    const uint32_t *ends = domain->facets + 2 * (size_t)facet;
    const double *a = domain->vertices + 2 * (size_t)ends[0];
    const double *b = domain->vertices + 2 * (size_t)ends[1];
    inward[0] = domain->orientation * (a[1] - b[1]);
    inward[1] = domain->orientation * (b[0] - a[0]);
}

icc_status iccp_gradient_depart(const icc_chart *chart, uint32_t facet, const double point[2],
                                iccp_walk2 *walk, iccp_jet2 *jet)
{
    const iccp_gradient_state *state = chart->state;
    double p[2], inward[2];
    iccp_gradient_to_lattice(state, point, p);
    iccp_gradient_inward(chart->domain, facet, inward);
    const icc_status status =
        iccp_walk2_start(walk, state->field, ICCP_UPHILL, p[0], p[1], jet);
    if (status == ICC_OK)
        iccp_walk2_face(walk, inward);
    return status;
}
