/* Puts a tetrahedron with one, two or three faces on the front into place by a flip of cells: one
 * to four, two to three, three to two (U. Pachner, P.L. homeomorphic manifolds are equivalent by
 * elementary shellings, 1991). The last tetrahedron is placed by a flip of four to one. */
#include "map/solid/cone.h"

/* Puts the new point of a flip of one cell to four in the cell's middle. */
static void put_new(iccp_cone *cone, uint32_t tet, int corner)
{
    const uint32_t *v = cone->mesh.tet[tet].v;
    double x[3];
    for (int i = 0; i < 3; ++i) {
        x[i] = cone->apex[i];
        for (int k = 0; k < 4; ++k)
            x[i] += k == corner ? 0 : iccp_cone_image(cone, v[k])[i];
        x[i] *= 0.25;
    }
    iccp_cone_put(cone, v[corner], x);
}

/* Returns true if all tetrahedra around an edge are left and the edge is not on the boundary. */
static bool is_behind(iccp_cone *cone, uint32_t a, uint32_t b, uint32_t tet)
{
    iccp_tets *m = &cone->mesh;
    bool behind = iccp_tets_ring(m, a, b, tet, SIZE_MAX);
    for (size_t k = 0; behind && k < m->ring.n; ++k)
        behind = !cone->is_placed[m->ring.item[k]];
    return behind;
}

bool iccp_cone_leaves_ball(iccp_cone *cone, uint32_t tet, int n, const int *side)
{
    const uint32_t *v = cone->mesh.tet[tet].v;
    if (n == 1)
        return cone->n_faces[v[side[0]]] == 0;
    if (n == 2)
        return is_behind(cone, v[side[0]], v[side[1]], tet);
    return n == 3 ? cone->n_faces[v[6 - side[0] - side[1] - side[2]]] == 3
                  : n == 4 && cone->n_left == 1;
}

iccp_cone_result iccp_cone_try(iccp_cone *cone, uint32_t tet)
{
    int side[4];
    const int n = iccp_cone_front_sides(cone, tet, side);
    if (!iccp_cone_leaves_ball(cone, tet, n, side))
        return ICCP_CONE_BARRED;
    const uint32_t fresh = cone->mesh.tet[tet].v[side[0]];
    if (n == 1)
        put_new(cone, tet, side[0]);
    iccp_cone_place(cone, tet);
    if (iccp_cone_is_good(cone, tet) || (n > 1 && iccp_cone_unlock(cone, tet)))
        return ICCP_CONE_PLACED;
    iccp_cone_take_out(cone, tet);
    if (n == 1)
        iccp_cone_forget(cone, fresh);
    return ICCP_CONE_BLOCKED;
}
