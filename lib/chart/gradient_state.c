#include "chart/gradient_state.h"

#include <math.h>

/* By elimination; overwrites the matrix. */
static double determinant(int n, double a[ICC_MAX_DIM][ICC_MAX_DIM])
{
    double det = 1;
    for (int c = 0; c < n; ++c) {
        int pivot = c;
        for (int r = c + 1; r < n; ++r)
            pivot = fabs(a[r][c]) > fabs(a[pivot][c]) ? r : pivot;
        if (!(fabs(a[pivot][c]) > 0))
            return 0;
        for (int k = c; k < n; ++k) {
            const double swap = a[c][k];
            a[c][k] = pivot != c ? -a[pivot][k] : swap;
            a[pivot][k] = pivot != c ? swap : a[pivot][k];
        }
        det *= a[c][c];
        for (int r = c + 1; r < n; ++r)
            for (int k = n; k-- > c;)
                a[r][k] -= a[r][c] / a[c][c] * a[c][k];
    }
    return det;
}

/* The determinant of a vector out of the domain and the facet's edges has the orientation's sign: component
 * k of the outward normal is the cofactor of that vector's component k. */
void iccp_gradient_inward(const icc_domain *domain, uint32_t facet, double *inward)
{
    const int dim = domain->dim;
    const double *corners[ICC_MAX_DIM];
    iccp_facet_corners(&domain->tree, facet, corners);
    for (int k = 0; k < dim; ++k) {
        double minor[ICC_MAX_DIM][ICC_MAX_DIM];
        for (int i = 0; i + 1 < dim; ++i)
            for (int j = 0; j + 1 < dim; ++j) {
                const int axis = j < k ? j : j + 1;
                minor[i][j] = corners[i + 1][axis] - corners[0][axis];
            }
        inward[k] = (k % 2 == 0 ? -1 : 1) * domain->orientation * determinant(dim - 1, minor);
    }
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
