/* Triangulates the facets of a point without it. On each facet, the faces at the point form a
 * polygon. Ears are cut off it, the best first. Exact signs tell what is an ear, seen from a point
 * inside. */
#include "fill/lifting.h"

#include "fill/quality.h"

bool iccp_lifting_walls(iccp_lifting *l)
{
    iccp_tets *const m = l->m;
    l->walls.n = 0;
    if (!iccp_tets_star(m, l->p))
        return false;
    for (size_t k = 0; k < m->star.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->star.item[k]];
        for (uint32_t i = 0; i < 4; ++i)
            if (tet->v[i] != l->p && iccp_is_wall_side(tet->across[i]) &&
                !iccp_list_push(m, &l->walls, 4 * m->star.item[k] + i))
                return false;
    }
    return true;
}

void iccp_lifting_opposite(const iccp_lifting *l, uint32_t side, uint32_t edge[2])
{
    const iccp_tet *const tet = &l->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    int i = 0;
    while (tet->v[f[i]] != l->p)
        ++i;
    edge[0] = tet->v[f[(i + 1) % 3]];
    edge[1] = tet->v[f[(i + 2) % 3]];
}

/* Lists the points around p on one facet, counter-clockwise from inside. */
static bool list_polygon(iccp_lifting *l, uint32_t facet)
{
    uint32_t first = ICCP_NO_TET, edge[2], other[2];
    l->polygon.n = 0;
    for (size_t k = 0; k < l->walls.n; ++k) {
        if (iccp_lifting_facet(l, l->walls.item[k]) != facet)
            continue;
        iccp_lifting_opposite(l, l->walls.item[k], edge);
        bool begins = first == ICCP_NO_TET;
        for (size_t i = 0; i < l->walls.n; ++i) {
            iccp_lifting_opposite(l, l->walls.item[i], other);
            if (iccp_lifting_facet(l, l->walls.item[i]) == facet && other[1] == edge[0])
                break;
            begins |= i + 1 == l->walls.n;
        }
        if (begins)
            first = edge[0];
    }
    for (uint32_t at = first; at != ICCP_NO_TET;) {
        if (!iccp_list_push(l->m, &l->polygon, at))
            return false;
        uint32_t next = ICCP_NO_TET;
        for (size_t k = 0; k < l->walls.n && next == ICCP_NO_TET; ++k) {
            iccp_lifting_opposite(l, l->walls.item[k], edge);
            if (iccp_lifting_facet(l, l->walls.item[k]) == facet && edge[0] == at)
                next = edge[1];
        }
        at = next == first ? ICCP_NO_TET : next;
    }
    return true;
}

/* Returns the worth of corner i of the polygon as an ear, or 0 if it is none. Point d lies inside,
 * so it sees ears counter-clockwise. */
static double ear(const iccp_lifting *l, size_t i, uint32_t d)
{
    const iccp_tets *const m = l->m;
    const size_t n = l->polygon.n;
    const uint32_t *const v = l->polygon.item;
    const uint32_t a = v[(i + n - 1) % n], b = v[i], c = v[(i + 1) % n];
    if (iccp_tets_orient(m, a, b, c, d) <= 0)
        return 0.0;
    for (size_t k = 0; k < n; ++k)
        if (v[k] != a && v[k] != b && v[k] != c && iccp_tets_orient(m, a, b, v[k], d) >= 0 &&
            iccp_tets_orient(m, b, c, v[k], d) >= 0 && iccp_tets_orient(m, c, a, v[k], d) >= 0)
            return 0.0;
    const double *const x = iccp_point(&m->points, a), *const y = iccp_point(&m->points, b),
                        *const z = iccp_point(&m->points, c);
    double n2 = 0.0, u[3], w[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = y[k] - x[k];
        w[k] = z[k] - x[k];
    }
    for (int k = 0; k < 3; ++k) {
        const double cross = u[(k + 1) % 3] * w[(k + 2) % 3] - u[(k + 2) % 3] * w[(k + 1) % 3];
        n2 += cross * cross;
    }
    const double edges =
        iccp_square_distance(x, y) + iccp_square_distance(y, z) + iccp_square_distance(z, x);
    return 1e-300 + n2 / (edges * edges);
}

/* Cuts off the best ear until a triangle is left. Returns false if there is no ear, or no
 * memory. */
static bool triangulate(iccp_lifting *l, uint32_t facet, uint32_t d)
{
    uint32_t *const v = l->polygon.item;
    while (l->polygon.n > 2) {
        const size_t n = l->polygon.n;
        size_t best = n;
        double best_worth = 0.0;
        for (size_t i = 0; i < n; ++i) {
            const double worth = ear(l, i, d);
            if (worth > best_worth) {
                best_worth = worth;
                best = i;
            }
        }
        if (best == n || !iccp_list_reserve(l->m, &l->triangles, l->triangles.n + 4))
            return false;
        const uint32_t triangle[4] = {v[(best + n - 1) % n], v[best], v[(best + 1) % n], facet};
        for (int k = 0; k < 4; ++k)
            l->triangles.item[l->triangles.n++] = triangle[k];
        for (size_t i = best; i + 1 < n; ++i)
            v[i] = v[i + 1];
        --l->polygon.n;
    }
    return true;
}

bool iccp_lifting_triangulate(iccp_lifting *l)
{
    l->triangles.n = 0;
    for (size_t k = 0; k < l->walls.n; ++k) {
        const uint32_t side = l->walls.item[k], facet = iccp_lifting_facet(l, side);
        bool known = false;
        for (size_t i = 0; i < k && !known; ++i)
            known = iccp_lifting_facet(l, l->walls.item[i]) == facet;
        if (known)
            continue;
        if (!list_polygon(l, facet) || !triangulate(l, facet, l->m->tet[side / 4].v[side % 4]))
            return false;
    }
    return true;
}
