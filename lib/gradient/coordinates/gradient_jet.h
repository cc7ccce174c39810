/* Derivatives of gradient coordinates. */
#ifndef ICCP_GRADIENT_JET_H
#define ICCP_GRADIENT_JET_H

#include "gradient/coordinates/gradient_line.h"

/* Makes the jet of a point with respect to itself. */
void iccp_gradient_identity(int32_t dim, iccp_jetn *jet);

/* Computes the derivatives of the coordinates with respect to the point, from the jets of the lines
 * down and up. */
void iccp_gradient_encode_jet(const icc_chart *chart, const iccp_gradient_line *down,
                              const iccp_jetn *down_jet, const iccp_gradient_line *up,
                              const iccp_jetn *up_jet, iccp_encode_jet *jet);

/* Computes the derivatives of the point with respect to the coordinates. The point lies on `piece`
 * of the line from the boundary point. */
icc_status iccp_gradient_decode_jet(const icc_chart *chart, const iccp_coords *coords,
                                    const double *boundary, const iccp_path *path, size_t piece,
                                    double share, iccp_decode_jet *jet);

#endif
