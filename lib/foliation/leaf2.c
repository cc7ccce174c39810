/* Follows level lines of a piecewise linear function in a triangle mesh. With certified labels a
 * leaf meets no triangle twice, so every walk ends. Source: docs/theory/charts-plane.md, "method
 * foliation". */
#include "foliation/leaf2.h"

#include "math/predicates.h"

/* The given share of a positive rise, but at least 1 and at most the whole rise. */
static int64_t part_of(int64_t rise, double share)
{
    const int64_t part = (int64_t)(share * (double)rise + 0.5);
    return part < 1 ? 1 : part > rise ? rise : part;
}

/* In the star, leaves are rays from the centre, whose corner is `corner`. */
static icc_status leaf_in_star(const iccp_psi *psi, uint32_t corner, const double bary[3],
                               iccp_leaf2 *leaf)
{
    const double a = bary[iccp_after(corner) % 3], b = bary[iccp_before(corner) % 3];
    if (!(a + b > 0) || psi->rise[corner] <= 0)
        return ICC_ERR_TRACE;
    const int64_t below = part_of(psi->rise[corner], b / (a + b));
    *leaf = (iccp_leaf2){.in_star = true, .down = {corner, below, psi->rise[corner] - below}};
    return ICC_OK;
}

/* Finds the two edges that the leaf crosses. The label is linear in a triangle without the
 * centre. Labels are taken relative to corner 0. `own` is the point's label, rounded to strictly
 * above the least label and at most the greatest. The exact signs of the corners' labels minus
 * `own` then decide. */
icc_status iccp_leaf2_through(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle,
                              const double bary[3], iccp_leaf2 *leaf)
{
    const uint32_t first = 3 * triangle;
    for (uint32_t k = 0; k < 3; ++k)
        if (mesh->triangles[first + k] == psi->centre)
            return leaf_in_star(psi, first + k, bary, leaf);
    int64_t label[3] = {0, psi->rise[first + 2], -psi->rise[first + 1]};
    const int64_t low =
        label[1] < label[2] ? (label[1] < 0 ? label[1] : 0) : (label[2] < 0 ? label[2] : 0);
    const int64_t high =
        label[1] > label[2] ? (label[1] > 0 ? label[1] : 0) : (label[2] > 0 ? label[2] : 0);
    if (low >= high)
        return ICC_ERR_TRACE;
    const double value = bary[0] * (double)(label[0] - low) + bary[1] * (double)(label[1] - low) +
                         bary[2] * (double)(label[2] - low);
    const int64_t own = low + part_of(high - low, value / (double)(high - low));
    *leaf = (iccp_leaf2){.in_star = false};
    for (uint32_t k = 0; k < 3; ++k) {
        const int64_t a = label[(k + 1) % 3] - own, b = label[(k + 2) % 3] - own;
        if (a < 0 && b >= 0)
            leaf->down = (iccp_crossing){first + k, -a, b};
        else if (a >= 0 && b < 0)
            leaf->up = (iccp_crossing){mesh->twins[first + k], -b, a};
    }
    return leaf->up.corner != ICCP_NO_NEIGHBOUR ? ICC_OK : ICC_ERR_TRACE;
}

/* The derivative of the corner's barycentric coordinate: the edge that the corner faces, turned
 * by 90 degrees, over twice the area. */
static void bary_gradient(const iccp_planar *mesh, uint32_t corner, double gradient[2])
{
    const double *p = mesh->points + 2 * (size_t)mesh->triangles[corner];
    const double *a = mesh->points + 2 * (size_t)mesh->triangles[iccp_after(corner)];
    const double *b = mesh->points + 2 * (size_t)mesh->triangles[iccp_before(corner)];
    const double area = iccp_area2d(p, a, b);
    gradient[0] = (a[1] - b[1]) / area;
    gradient[1] = (b[0] - a[0]) / area;
}

/* The sum of each corner's label, relative to corner 0, times the gradient of its barycentric
 * coordinate. In the star the label is taken where the line from the centre through the point
 * meets the opposite edge. */
void iccp_label_gradient(const iccp_planar *mesh, const iccp_psi *psi, uint32_t triangle,
                         const double bary[3], double gradient[2])
{
    const uint32_t first = 3 * triangle;
    double weight[3] = {0, (double)psi->rise[first + 2], -(double)psi->rise[first + 1]};
    for (uint32_t k = 0; k < 3; ++k)
        if (mesh->triangles[first + k] == psi->centre) {
            const double a = bary[(k + 1) % 3], b = bary[(k + 2) % 3];
            const double scale = (double)psi->rise[first + k] / ((a + b) * (a + b));
            weight[k] = 0;
            weight[(k + 1) % 3] = -b * scale;
            weight[(k + 2) % 3] = a * scale;
        }
    gradient[0] = gradient[1] = 0;
    for (uint32_t k = 0; k < 3; ++k) {
        double own[2];
        bary_gradient(mesh, first + k, own);
        gradient[0] += weight[k] * own[0];
        gradient[1] += weight[k] * own[1];
    }
}

iccp_crossing iccp_leaf2_from_boundary(const iccp_psi *psi, uint32_t corner, double lambda)
{
    const int64_t below = part_of(psi->rise[corner], lambda);
    return (iccp_crossing){corner, below, psi->rise[corner] - below};
}

void iccp_crossing_slope(const iccp_planar *mesh, const iccp_crossing *crossing, double slope[2])
{
    const double *a = mesh->points + 2 * (size_t)mesh->triangles[iccp_after(crossing->corner)];
    const double *b = mesh->points + 2 * (size_t)mesh->triangles[iccp_before(crossing->corner)];
    const double rise = (double)crossing->below + (double)crossing->above;
    slope[0] = (b[0] - a[0]) / rise;
    slope[1] = (b[1] - a[1]) / rise;
}
