/* The reach of a held vertex: a length below which the map bends little. Without it a single point
 * draws a spike that becomes thinner with the mesh. */
#ifndef ICCP_REACH_H
#define ICCP_REACH_H

#include "map/energy/assembly.h"
#include "math/gram.h"

/* The energy reach^2 u'Qu, summed over both coordinates u of the images. */
typedef struct iccp_reach {
    iccp_memory memory;
    double factor;  /* squared reach; 0: everything below is empty */
    iccp_gram gram; /* Q */
    size_t n_links;
    uint32_t
        *links; /* 3 n_links: neighbours p, m, q of which p and q share no edge. Q joins them */
} iccp_reach;

/* `twins` of the corners are ICCP_NO_NEIGHBOUR at the boundary. */
icc_status iccp_reach_create(iccp_reach *reach, double length, size_t n_points,
                             const double *points, size_t n_triangles, const uint32_t *corners,
                             const uint32_t *twins, const iccp_env *env);
void iccp_reach_free(iccp_reach *reach);

double iccp_reach_energy(const iccp_reach *reach, const double *images);

/* The derivative by the image of a vertex. */
void iccp_reach_gradient(const iccp_reach *reach, const double *images, size_t vertex,
                         double *gradient);

/* Finds the places of Q's entries off the diagonal: place[q] is the number of the entry's column
 * among the neighbours that the row holds, or UINT32_MAX if it is not there. All points of the
 * assembly are free. */
void iccp_reach_find(const iccp_reach *reach, const iccp_assembly *assembly, uint32_t *place);

#endif
