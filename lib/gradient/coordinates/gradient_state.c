/* Starts of gradient lines in the plane. */
#include "gradient/coordinates/gradient_state.h"

icc_status iccp_gradient_depart(const icc_chart *chart, uint32_t facet, const double point[2],
                                iccp_walk2 *walk, iccp_jet2 *jet)
{
    const iccp_gradient_state *state = chart->state;
    double p[2], inward[2];
    iccp_gradient_to_lattice(state, point, p);
    iccp_facet_inward(chart->domain, facet, inward);
    const icc_status status = iccp_walk2_start(walk, state->field, ICCP_UPHILL, p[0], p[1], jet);
    if (status == ICC_OK)
        iccp_walk2_face(walk, inward);
    return status;
}
