/* Moves images and the apex one by one. Each stays in the polyhedron of points that see all its
 * cells: map/solid/halfspaces.h. */
#include "map/solid/cone.h"

#include "map/energy/simplicial_map.h"
#include "math/vec.h"

#include <string.h>

/* ROUNDS: how often each corner is moved to make room for a tetrahedron. APEX_STEPS: Newton steps
 * for the apex at the start. */
enum { ROUNDS = 3, APEX_STEPS = 100 };

void iccp_cone_smooth(iccp_cone *cone, uint32_t point, size_t steps)
{
    double x[3], old[3];
    if (point < cone->n_fixed || !iccp_cone_has_image(cone, point) ||
        !iccp_cone_find_room(cone, point))
        return;
    memcpy(old, iccp_cone_image(cone, point), sizeof old);
    memcpy(x, old, sizeof x);
    iccp_halfspaces_centre(&cone->room, steps, x);
    iccp_cone_put(cone, point, x);
    if (!iccp_cone_is_star_good(cone, point))
        iccp_cone_put(cone, point, old);
}

static void smooth_apex(iccp_cone *cone)
{
    double old[3];
    memcpy(old, cone->apex, sizeof old);
    if (!iccp_cone_find_apex_room(cone))
        return;
    iccp_halfspaces_centre(&cone->room, 1, cone->apex);
    iccp_simplicial_round(3, cone->apex);
    if (!iccp_cone_is_apex_good(cone))
        memcpy(cone->apex, old, sizeof old);
}

void iccp_cone_smooth_all(iccp_cone *cone)
{
    for (size_t v = cone->n_fixed; v < cone->mesh.points.n; ++v)
        iccp_cone_smooth(cone, (uint32_t)v, 1);
    smooth_apex(cone);
}

static bool enter(iccp_cone *cone, uint32_t point)
{
    double x[3];
    if (point < cone->n_fixed || !iccp_cone_find_room(cone, point))
        return false;
    memcpy(x, iccp_cone_image(cone, point), sizeof x);
    const bool entered = iccp_halfspaces_enter(&cone->room, x);
    iccp_cone_put(cone, point, x);
    return entered;
}

static bool are_good(iccp_cone *cone, const uint32_t *points)
{
    bool good = true;
    for (int k = 0; k < 4 && good; ++k)
        good = iccp_cone_is_star_good(cone, points[k]);
    return good;
}

bool iccp_cone_unlock(iccp_cone *cone, uint32_t tet)
{
    uint32_t point[4];
    double old[4][3];
    memcpy(point, cone->mesh.tet[tet].v, sizeof point);
    for (int k = 0; k < 4; ++k)
        memcpy(old[k], iccp_cone_image(cone, point[k]), sizeof old[k]);
    for (int round = 0; round < ROUNDS; ++round) {
        bool entered = false;
        for (int k = 0; k < 4; ++k)
            entered |= enter(cone, point[k]);
        if (entered && are_good(cone, point))
            return true;
    }
    for (int k = 0; k < 4; ++k)
        iccp_cone_put(cone, point[k], old[k]);
    return false;
}

/* ---- the apex ---- */

/* The centroid of the region. */
static void find_centroid(iccp_cone *cone)
{
    double volume = 0, sum[3] = {0};
    for (uint32_t t = 0; t < cone->mesh.n_tets; ++t)
        for (int i = 0; i < 4; ++i) {
            double normal[3];
            if (!iccp_cone_is_front(cone, t, i))
                continue;
            const uint32_t *v = cone->mesh.tet[t].v;
            const double *a = iccp_cone_image(cone, v[iccp_tet_face[i][0]]);
            const double *b = iccp_cone_image(cone, v[iccp_tet_face[i][1]]);
            const double *c = iccp_cone_image(cone, v[iccp_tet_face[i][2]]);
            iccp_vec_cross(a, b, normal);
            const double six = iccp_vec_dot(3, normal, c);
            volume += six;
            for (int k = 0; k < 3; ++k)
                sum[k] += six * (a[k] + b[k] + c[k]) / 4;
        }
    for (int k = 0; k < 3; ++k)
        cone->apex[k] = sum[k] / volume;
}

/* The search begins at the centroid. */
bool iccp_cone_find_apex(iccp_cone *cone)
{
    find_centroid(cone);
    if (!iccp_cone_find_apex_room(cone) || !iccp_halfspaces_enter(&cone->room, cone->apex))
        return false;
    iccp_halfspaces_centre(&cone->room, APEX_STEPS, cone->apex);
    return iccp_cone_is_apex_good(cone);
}
