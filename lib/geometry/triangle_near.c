/* Branch and bound as in geometry/facet_nearest.c, for triangles in space. It is faster because a
 * caller that only asks if a triangle is near enough does not need the nearest one. */
#include "geometry/triangle_near.h"

#include "base/minmax.h"
#include "math/vec.h"

/* C. Ericson, Real-Time Collision Detection, 2005, section 5.1.5: signs of products tell which
 * corner, side or face is nearest. */
double iccp_triangle_distance2(const double *a, const double *b, const double *c, const double *p)
{
    const double *const corner[3] = {a, b, c};
    double ab[3], ac[3], at[3][3], d[3][2];
    for (int k = 0; k < 3; ++k) {
        ab[k] = b[k] - a[k];
        ac[k] = c[k] - a[k];
    }
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k)
            at[i][k] = p[k] - corner[i][k];
        d[i][0] = iccp_vec_dot(3, ab, at[i]);
        d[i][1] = iccp_vec_dot(3, ac, at[i]);
    }
    double v = 0, w = 0;
    const double va = d[1][0] * d[2][1] - d[2][0] * d[1][1];
    const double vb = d[2][0] * d[0][1] - d[0][0] * d[2][1];
    const double vc = d[0][0] * d[1][1] - d[1][0] * d[0][1];
    const double from_b = d[1][1] - d[1][0], from_c = d[2][0] - d[2][1];
    if (d[0][0] <= 0 && d[0][1] <= 0)
        v = w = 0;
    else if (d[1][0] >= 0 && from_b <= 0)
        v = 1;
    else if (d[2][1] >= 0 && from_c <= 0)
        w = 1;
    else if (vc <= 0 && d[0][0] >= 0 && d[1][0] <= 0)
        v = d[0][0] / (d[0][0] - d[1][0]);
    else if (vb <= 0 && d[0][1] >= 0 && d[2][1] <= 0)
        w = d[0][1] / (d[0][1] - d[2][1]);
    else if (va <= 0 && from_b >= 0 && from_c >= 0)
        v = 1 - (w = from_b / (from_b + from_c));
    else {
        v = vb / (va + vb + vc);
        w = vc / (va + vb + vc);
    }
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
        const double off = at[0][k] - v * ab[k] - w * ac[k];
        sum += off * off;
    }
    return sum;
}

static ICCP_INLINE double box_distance2(const double *box, const double *p)
{
    double sum = 0;
    for (size_t k = 0; k < 3; ++k) {
        const double d = iccp_max(iccp_max(box[k] - p[k], p[k] - box[3 + k]), 0);
        sum += d * d;
    }
    return sum;
}

typedef struct found {
    uint32_t triangle;
    double distance2;
} found;

/* At equal distance the smaller number wins, so the result does not depend on the order of the
 * tree. */
static ICCP_INLINE void search_leaf(const iccp_facet_tree *tree, size_t node, const double *p,
                                    found *best)
{
    const size_t first = (node - tree->n_leaves) * ICCP_FACET_LEAF;
    for (size_t place = first; place < first + ICCP_FACET_LEAF && place < tree->n; ++place) {
        const uint32_t triangle = iccp_facet_at(tree, place);
        const double *corner[3];
        iccp_facet_corners(tree, triangle, corner);
        const double distance2 = iccp_triangle_distance2(corner[0], corner[1], corner[2], p);
        if (distance2 < best->distance2 ||
            (distance2 == best->distance2 && triangle < best->triangle))
            *best = (found){triangle, distance2};
    }
}

uint32_t iccp_triangle_near(const iccp_facet_tree *tree, const double *p, double enough2,
                            double most2, double *distance2)
{
    struct {
        size_t node;
        double distance2;
    } stack[ICCP_FACET_LEVELS];
    found best = {UINT32_MAX, most2};
    size_t depth = 0, node = 1;
    for (;;) {
        while (node < tree->n_leaves) {
            const double left = box_distance2(tree->boxes + 6 * (2 * node), p);
            const double right = box_distance2(tree->boxes + 6 * (2 * node + 1), p);
            const size_t far = right < left ? 2 * node : 2 * node + 1;
            stack[depth].node = far;
            stack[depth++].distance2 = right < left ? left : right;
            node = far ^ 1;
        }
        search_leaf(tree, node, p, &best);
        do {
            if (depth == 0 || (best.triangle != UINT32_MAX && best.distance2 <= enough2)) {
                *distance2 = best.distance2;
                return best.triangle;
            }
            --depth;
        } while (stack[depth].distance2 > best.distance2);
        node = stack[depth].node;
    }
}
