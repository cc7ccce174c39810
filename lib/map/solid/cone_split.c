/* A flip of two cells to three needs a convex pair, and a flip of three to two needs a vertex that
 * is not a dent. If moving images does not achieve this, the edge or face that would come to the
 * front is cut by a new point. Its image lies just behind the edge or point that leaves the front,
 * as seen from the apex. Then the pieces can be placed whatever the front looks like. */
#include "map/solid/cone.h"

#include <string.h>

/* How far the new point is put back, and to one side of the edge, as shares of the available
 * room. */
static const double BACK = 0.5, ASIDE = 0.25;

/* How often this is tried, each time closer to the edge, down to about 1e-9. */
enum { MOST_TRIES = 14 };

static void between(const double *a, const double *b, double share, double *x)
{
    for (int i = 0; i < 3; ++i)
        x[i] = a[i] + share * (b[i] - a[i]);
}

/* Cuts the edge or face of n points in n_old tetrahedra that are left. If it returns false, nothing
 * has changed. */
static bool cut(iccp_cone *cone, int n, const uint32_t *ends, size_t n_old, const uint32_t *old,
                uint32_t *point)
{
    if (!iccp_cone_cut(cone, n, ends, n_old, old, point))
        return false;
    cone->n_left += cone->mesh.fresh.n - n_old;
    iccp_cone_forget(cone, *point);
    return true;
}

/* Puts all pieces into place one after the other, or none. */
static bool place_all(iccp_cone *cone, int n, const uint32_t *piece)
{
    int k = 0;
    for (bool good = true; good && k < n; ++k) {
        iccp_cone_place(cone, piece[k]);
        good = iccp_cone_is_good(cone, piece[k]);
        if (good && k + 1 == n)
            return true;
    }
    while (k-- > 0)
        iccp_cone_take_out(cone, piece[k]);
    return false;
}

/* Finds the pieces in mesh.fresh that have both points. */
static void find_pieces(const iccp_cone *cone, uint32_t a, uint32_t b, uint32_t *piece)
{
    const iccp_tets *m = &cone->mesh;
    for (size_t k = 0; k < m->fresh.n; ++k) {
        const iccp_tet *tet = &m->tet[m->fresh.item[k]];
        if (iccp_tet_index(tet, a) >= 0 && iccp_tet_index(tet, b) >= 0)
            *piece++ = m->fresh.item[k];
    }
}

/* Splits the edge cd of a tetrahedron whose sides opposite c and d are on the front. */
static bool split_edge(iccp_cone *cone, uint32_t tet, const int *side, uint32_t *point)
{
    iccp_tets *m = &cone->mesh;
    uint32_t ab[2], cd[2], piece[2];
    int n = 0;
    for (int k = 0; k < 4; ++k)
        if (k != side[0] && k != side[1])
            ab[n++] = m->tet[tet].v[k];
    for (int k = 0; k < 2; ++k)
        cd[k] = m->tet[tet].v[side[k]];
    if (!iccp_tets_ring(m, cd[0], cd[1], tet, SIZE_MAX) ||
        !cut(cone, 2, cd, m->ring.n, m->ring.item, point))
        return false;
    find_pieces(cone, ab[0], ab[1], piece);
    double aside = 1;
    for (int tried = 0; tried < MOST_TRIES; ++tried) {
        aside *= ASIDE;
        for (int k = 0; k < 2; ++k) {
            double x[3];
            const bool has = iccp_tet_index(&m->tet[piece[0]], cd[k]) >= 0;
            const uint32_t order[2] = {piece[has ? 0 : 1], piece[has ? 1 : 0]};
            between(iccp_cone_image(cone, ab[0]), iccp_cone_image(cone, ab[1]), 0.5, x);
            between(x, iccp_cone_image(cone, cd[k]), aside, x);
            between(cone->apex, x, BACK, x);
            iccp_cone_put(cone, *point, x);
            if (place_all(cone, 2, order))
                return true;
        }
    }
    iccp_cone_forget(cone, *point);
    return false;
}

/* Splits the face opposite the only corner that all three sides on the front have. */
static bool split_face(iccp_cone *cone, uint32_t tet, int corner, uint32_t *point)
{
    iccp_tets *m = &cone->mesh;
    const uint32_t a = m->tet[tet].v[corner];
    const uint32_t old[2] = {tet, m->tet[tet].across[corner] / 4};
    uint32_t ends[3], piece[3];
    double x[3];
    for (int k = 0; k < 3; ++k)
        ends[k] = m->tet[tet].v[iccp_tet_face[corner][k]];
    if (!cut(cone, 3, ends, 2, old, point))
        return false;
    find_pieces(cone, a, *point, piece);
    between(cone->apex, iccp_cone_image(cone, a), BACK, x);
    iccp_cone_put(cone, *point, x);
    if (place_all(cone, 3, piece))
        return true;
    iccp_cone_forget(cone, *point);
    return false;
}

bool iccp_cone_split(iccp_cone *cone, uint32_t tet, uint32_t *point)
{
    int side[4];
    const int n = iccp_cone_front_sides(cone, tet, side);
    if (!iccp_cone_leaves_ball(cone, tet, n, side))
        return false;
    return n == 2   ? split_edge(cone, tet, side, point)
           : n == 3 ? split_face(cone, tet, 6 - side[0] - side[1] - side[2], point)
                    : false;
}
