#include "chart/gradient_state.h"

icc_status iccp_gradient_ascend(const iccp_gradient_state *state, const double boundary[2],
                                iccp_path *path, double *merge, iccp_jet2 *jet)
{
    double p[2];
    iccp_gradient_to_lattice(state, boundary, p);
    iccp_walk2 walk;
    icc_status status = iccp_walk2_start(&walk, state->field, ICCP_UPHILL, p[0], p[1], jet);
    return status == ICC_OK ? iccp_trace_uphill(&walk, path, merge) : status;
}
