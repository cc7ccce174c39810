/* Follows a leaf, a level line of psi, by its label. Integers decide which triangle comes next, and
 * doubles tell where the leaf crosses an edge. Errors do not accumulate.
 *
 * Source: docs/theory/charts-plane.md, "method foliation". */
#ifndef ICCP_LEAF2_H
#define ICCP_LEAF2_H

#include "foliation/psi.h"
#include "geometry/path.h"

/* The place where a leaf crosses the half-edge that a corner faces, seen from the triangle
 * nearer to the centre. The label of the half-edge's first vertex is lower than the leaf's by
 * `below`. The label of its second vertex is higher by `above`. A label equal to the leaf's
 * counts as higher, as if all labels were raised by an infinitely small amount. So below > 0 and
 * above >= 0. */
typedef struct iccp_crossing {
    uint32_t corner;
    int64_t below, above;
} iccp_crossing;

/* The leaf through a point of a triangle. */
typedef struct iccp_leaf2 {
    bool in_star;       /* the triangle touches the centre; the leaf is straight from `down` to the
                           centre */
    iccp_crossing down; /* where the leaf from the boundary enters the triangle */
    iccp_crossing up;   /* where the leaf leaves the triangle, seen from the next one; not set in
                           the star */
} iccp_leaf2;

/* Computes the gradient of the label, in label units per length, at the point with the given
 * barycentric coordinates. */
void iccp_label_gradient(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle,
                         const double bary[3], double gradient[2]);

/* Finds the leaf through the point with the given barycentric coordinates. Fails with
 * ICC_ERR_TRACE if the point is the centre, or if the triangle is flat, which a certified psi
 * excludes. */
icc_status iccp_leaf2_through(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle,
                              const double bary[3], iccp_leaf2 *leaf);

/* The leaf that starts on boundary edge k, at the share `lambda` of the edge. `corner` faces the
 * edge. */
iccp_crossing iccp_leaf2_from_boundary(const iccp_psi *psi, uint32_t corner, double lambda);

/* The derivative of the crossing's point by the leaf's label, per unit. */
void iccp_crossing_slope(const iccp_planar *mesh, const iccp_crossing *crossing, double slope[2]);

/* The share of its half-edge at which a crossing lies, in [0, 1]. */
static inline double iccp_crossing_share(const iccp_crossing *crossing)
{
    return (double)crossing->below / ((double)crossing->below + (double)crossing->above);
}

/* The functions below run at every triangle that a leaf meets, so they are inline. */

static inline void iccp_crossing_point(const iccp_planar *mesh, const iccp_crossing *crossing,
                                       double p[2])
{
    const double *a = mesh->points + 2 * (size_t)mesh->triangles[iccp_after(crossing->corner)];
    const double *b = mesh->points + 2 * (size_t)mesh->triangles[iccp_before(crossing->corner)];
    const double share = iccp_crossing_share(crossing);
    p[0] = a[0] + share * (b[0] - a[0]);
    p[1] = a[1] + share * (b[1] - a[1]);
}

/* Moves to the next crossing towards the centre. Returns false if the triangle touches the
 * centre. */
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

/* Moves to the next crossing towards the boundary. Returns false if this crossing is on the
 * boundary. */
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
