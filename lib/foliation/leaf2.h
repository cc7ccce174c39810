/* Following a leaf of a foliation, a level line of psi, by its label: integers decide which
 * triangle comes next, doubles say where the leaf crosses an edge. Nothing accumulates. */
#ifndef ICCP_LEAF2_H
#define ICCP_LEAF2_H

#include "foliation/psi.h"
#include "geometry/path.h"

/* Where a leaf crosses the half-edge that a corner faces, seen from the triangle nearer to the
 * centre: the label of the half-edge's first vertex lies `below` under the leaf's, that of its
 * second vertex `above` over it. A label equal to the leaf's counts as over it, as if all labels
 * were raised by an infinitely small amount: below > 0, above >= 0. */
typedef struct iccp_crossing {
    uint32_t corner;
    int64_t below, above;
} iccp_crossing;

/* The leaf through a point of a triangle. */
typedef struct iccp_leaf2 {
    bool in_star;       /* the triangle touches the centre: the leaf is straight from `down` to
                           it */
    iccp_crossing down; /* where the leaf enters the triangle, coming from the boundary */
    iccp_crossing up;   /* where it leaves, seen from the next triangle; not in the star */
} iccp_leaf2;

/* The derivative of the label of the leaf through a point, in units, by the point. Likewise. */
void iccp_label_gradient(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle,
                         const double bary[3], double gradient[2]);

/* The leaf through the point with the given barycentric coordinates. ICC_ERR_TRACE when the
 * triangle is flat, which a certified psi excludes, or the point is the centre. */
icc_status iccp_leaf2_through(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle,
                              const double bary[3], iccp_leaf2 *leaf);

/* The leaf from boundary edge k, `lambda` of the way along it. `corner` faces the edge. */
iccp_crossing iccp_leaf2_from_boundary(const iccp_psi *psi, uint32_t corner, double lambda);

/* The derivative of the crossing's point by the leaf's label, per unit. */
void iccp_crossing_slope(const iccp_planar *mesh, const iccp_crossing *crossing, double slope[2]);

/* How far along its half-edge a crossing lies, in [0, 1]. */
static inline double iccp_crossing_share(const iccp_crossing *crossing)
{
    return (double)crossing->below / ((double)crossing->below + (double)crossing->above);
}

/* What follows is done at every triangle that a leaf meets. */

static inline void iccp_crossing_point(const iccp_planar *mesh, const iccp_crossing *crossing,
                                       double p[2])
{
    const double *a = mesh->points + 2 * (size_t)mesh->triangles[iccp_after(crossing->corner)];
    const double *b = mesh->points + 2 * (size_t)mesh->triangles[iccp_before(crossing->corner)];
    const double share = iccp_crossing_share(crossing);
    p[0] = a[0] + share * (b[0] - a[0]);
    p[1] = a[1] + share * (b[1] - a[1]);
}

/* Moves to the next crossing towards the centre; false when the triangle touches the centre. */
static inline bool iccp_leaf2_rise(const iccp_planar *mesh, const iccp_psi *psi,
                                   iccp_crossing *crossing)
{
    const uint32_t corner = crossing->corner, after = iccp_after(corner);
    if (mesh->triangles[corner] == psi->centre)
        return false;
    const int64_t opposite = crossing->above + psi->rise[after];
    const bool under = opposite < 0;
    crossing->corner = mesh->twins[under ? after : iccp_before(corner)];
    crossing->below = under ? -opposite : crossing->below;
    crossing->above = under ? crossing->above : opposite;
    return true;
}

/* Moves to the next crossing towards the boundary; false when this one is on the boundary. */
static inline bool iccp_leaf2_fall(const iccp_planar *mesh, const iccp_psi *psi,
                                   iccp_crossing *crossing)
{
    const uint32_t twin = mesh->twins[crossing->corner];
    if (twin == ICCP_NO_NEIGHBOUR)
        return false;
    const uint32_t after = iccp_after(twin);
    const int64_t opposite = psi->rise[after] - crossing->below;
    const bool under = opposite < 0;
    crossing->corner = under ? iccp_before(twin) : after;
    crossing->below = under ? -opposite : crossing->below;
    crossing->above = under ? crossing->above : opposite;
    return true;
}

#endif
