/* Bowyer's and Watson's insertion (The Computer Journal 24, 1981). Tetrahedra whose circumspheres
 * contain the new point form a cavity. The cone from the point over the cavity's boundary replaces
 * them. Spheres are only tested in doubles, and "unsure" means outside. The result is valid because
 * exact signs tell that the point sees the whole boundary. So the mesh is nearly Delaunay, and
 * always a mesh. */
#include "fill/insert.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/random.h"

/* Returns true if a point certainly lies in the circumsphere. */
static bool in_sphere(const iccp_tets *m, const iccp_tet *tet, uint32_t point)
{
    const double *const e = iccp_point(&m->points, point);
    double r[4][3], lift[4], most = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double *const x = iccp_point(&m->points, tet->v[i]);
        for (int k = 0; k < 3; ++k)
            r[i][k] = x[k] - e[k];
        if (m->metric.on)
            iccp_metric_apply(m->metric.in, r[i]);
        lift[i] = r[i][0] * r[i][0] + r[i][1] * r[i][1] + r[i][2] * r[i][2];
        most = iccp_max(most, lift[i]);
    }
    const double ab = r[0][0] * r[1][1] - r[1][0] * r[0][1];
    const double bc = r[1][0] * r[2][1] - r[2][0] * r[1][1];
    const double cd = r[2][0] * r[3][1] - r[3][0] * r[2][1];
    const double da = r[3][0] * r[0][1] - r[0][0] * r[3][1];
    const double ac = r[0][0] * r[2][1] - r[2][0] * r[0][1];
    const double bd = r[1][0] * r[3][1] - r[3][0] * r[1][1];
    const double abc = r[0][2] * bc - r[1][2] * ac + r[2][2] * ab;
    const double bcd = r[1][2] * cd - r[2][2] * bd + r[3][2] * bc;
    const double cda = r[2][2] * da + r[3][2] * ac + r[0][2] * cd;
    const double dab = r[3][2] * ab + r[0][2] * bd + r[1][2] * da;
    const double det =
        (lift[2] * dab - lift[3] * abc) + (lift[0] * bcd - lift[1] * cda); /* > 0: inside */
    return det > 1e-14 * most * most * sqrt(most);
}

uint32_t iccp_tets_locate(iccp_tets *m, uint32_t point, uint32_t from)
{
    const size_t most = 1000 + m->n_alive;
    uint32_t t = from;
    for (size_t step = 0; step < most; ++step) {
        const iccp_tet *const tet = &m->tet[t];
        const int first = (int)(iccp_random(&m->random) >> 62);
        int k = 0;
        for (; k < 4; ++k) {
            const int i = (first + k) & 3;
            if (iccp_tet_sees(m, tet, i, point) >= 0)
                continue;
            if (iccp_is_wall_side(tet->across[i]))
                return ICCP_NO_TET;
            t = tet->across[i] / 4;
            break;
        }
        if (k == 4)
            return t;
    }
    return ICCP_NO_TET;
}

static bool holds(const iccp_tets *m, const iccp_tet *tet, uint32_t point)
{
    for (int i = 0; i < 4; ++i)
        if (iccp_tet_sees(m, tet, i, point) < 0)
            return false;
    return true;
}

bool iccp_tets_holders(iccp_tets *m, uint32_t point, uint32_t tet)
{
    const uint32_t stamp = iccp_tets_stamp(m);
    m->cavity.n = 0;
    m->mark[tet] = stamp;
    if (!iccp_list_push(m, &m->cavity, tet))
        return false;
    for (size_t k = 0; k < m->cavity.n; ++k) {
        const iccp_tet *const now = &m->tet[m->cavity.item[k]];
        for (int i = 0; i < 4; ++i) {
            const uint32_t other = now->across[i] / 4;
            if (iccp_is_wall_side(now->across[i]) || m->mark[other] == stamp ||
                iccp_tet_sees(m, now, i, point) != 0)
                continue;
            m->mark[other] = stamp;
            if (holds(m, &m->tet[other], point) && !iccp_list_push(m, &m->cavity, other))
                return false;
        }
    }
    return true;
}

bool iccp_tets_extend(iccp_tets *m, uint32_t point, size_t most)
{
    const uint32_t stamp = iccp_tets_stamp(m);
    for (size_t k = 0; k < m->cavity.n; ++k)
        m->mark[m->cavity.item[k]] = stamp;
    for (size_t k = 0; k < m->cavity.n && m->cavity.n <= most; ++k) {
        const iccp_tet *const tet = &m->tet[m->cavity.item[k]];
        for (int i = 0; i < 4; ++i) {
            const uint32_t other = tet->across[i] / 4;
            if (iccp_is_wall_side(tet->across[i]) || m->mark[other] == stamp ||
                iccp_tet_sees(m, tet, i, point) > 0)
                continue;
            m->mark[other] = stamp;
            if (!iccp_list_push(m, &m->cavity, other))
                return false;
        }
    }
    return true;
}

static bool grow_cavity(iccp_tets *m, uint32_t point, uint32_t stamp)
{
    for (size_t k = 0; k < m->cavity.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->cavity.item[k]];
        for (int i = 0; i < 4; ++i) {
            const uint32_t other = tet->across[i] / 4;
            if (iccp_is_wall_side(tet->across[i]) || m->mark[other] == stamp ||
                !in_sphere(m, &m->tet[other], point))
                continue;
            m->mark[other] = stamp;
            if (!iccp_list_push(m, &m->cavity, other))
                return false;
        }
    }
    return true;
}

/* Returns true if the cavity ends at a side of a marked tetrahedron. */
static bool is_rim(const iccp_tets *m, const iccp_tet *tet, int i, uint32_t stamp)
{
    return iccp_is_wall_side(tet->across[i]) || m->mark[tet->across[i] / 4] != stamp;
}

static bool sees_rim(const iccp_tets *m, const iccp_tet *tet, uint32_t point, uint32_t stamp)
{
    for (int i = 0; i < 4; ++i)
        if (is_rim(m, tet, i, stamp) && iccp_tet_sees(m, tet, i, point) <= 0)
            return false;
    return true;
}

/* Returns true if all corners of a tetrahedron are on the rim. Points of the rim have the stamp. */
static bool is_kept(const iccp_tets *m, const iccp_tet *tet, uint32_t stamp)
{
    for (int i = 0; i < 4; ++i)
        if (m->seen[tet->v[i]] != stamp)
            return false;
    return true;
}

/* Returns true if the cavity ends at a face of edge ij. Goes around the edge from tetrahedron t. */
static bool is_edge_on_rim(const iccp_tets *m, uint32_t t, int i, int j, uint32_t stamp)
{
    const uint32_t first = t, a = m->tet[t].v[i], b = m->tet[t].v[j];
    int k = 0;
    while (k == i || k == j)
        ++k;
    do {
        const iccp_tet *const tet = &m->tet[t];
        if (is_rim(m, tet, k, stamp))
            return true;
        const uint32_t last = tet->v[6 - i - j - k];
        t = tet->across[k] / 4;
        i = iccp_tet_index(&m->tet[t], a);
        j = iccp_tet_index(&m->tet[t], b);
        k = iccp_tet_index(&m->tet[t], last);
    } while (t != first);
    return false;
}

/* Returns true if an edge of tetrahedron t that must stay would be lost. */
static bool loses_edge(const iccp_tets *m, uint32_t t, uint32_t stamp)
{
    const uint32_t *const v = m->tet[t].v;
    for (int i = 0; i < 4 && m->kept.n > 0; ++i)
        for (int j = i + 1; j < 4; ++j)
            if (iccp_is_kept_edge(m, v[i], v[j]) && !is_edge_on_rim(m, t, i, j, stamp))
                return true;
    return false;
}

/* Returns true if none of the cavity's first n tetrahedra loses an edge. */
static bool keeps_lines(const iccp_tets *m, size_t n, uint32_t stamp)
{
    for (size_t k = 0; k < n; ++k)
        if (loses_edge(m, m->cavity.item[k], stamp))
            return false;
    return true;
}

static void stamp_rim(iccp_tets *m, uint32_t stamp)
{
    for (size_t k = 0; k < m->cavity.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->cavity.item[k]];
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 3 && is_rim(m, tet, i, stamp); ++j)
                m->seen[tet->v[iccp_tet_face[i][j]]] = stamp;
    }
}

/* Drops tetrahedra with sides that the point does not see, and tetrahedra that would take a point
 * with them or an edge that must stay, until none are left. The first n_base are not dropped.
 * Returns false if one of these is at fault.
 * A part that becomes separate has a side that the point does not see, so it is dropped, too. */
static bool trim_cavity(iccp_tets *m, uint32_t point, size_t n_base, uint32_t stamp)
{
    for (bool again = true, rim = false; again;) {
        size_t n = 0;
        again = false;
        if (rim)
            stamp_rim(m, stamp);
        for (size_t k = 0; k < m->cavity.n; ++k) {
            const uint32_t t = m->cavity.item[k];
            if (rim ? is_kept(m, &m->tet[t], stamp)
                    : sees_rim(m, &m->tet[t], point, stamp) &&
                          (k < n_base || !loses_edge(m, t, stamp))) {
                m->cavity.item[n++] = t;
                continue;
            }
            if (k < n_base)
                return false;
            m->mark[t] = 0;
            again = true;
        }
        m->cavity.n = n;
        if (!again && !rim)
            again = rim = true;
        else if (again)
            rim = false;
    }
    return keeps_lines(m, n_base, stamp);
}

/* Turns around edge ab to the next face of the rim and returns the new tetrahedron's side there.
 * Starts beyond corner `third` of tetrahedron t, whose side i is on the rim. The cavity's sides on
 * the rim hold the numbers of the new tetrahedra. */
static uint32_t turn(const iccp_tets *m, uint32_t t, uint32_t a, uint32_t b, uint32_t third,
                     uint32_t stamp)
{
    for (;;) {
        const iccp_tet *const tet = &m->tet[t];
        const int j = iccp_tet_index(tet, third);
        const uint32_t across = tet->across[j];
        if (iccp_is_wall_side(across))
            return across & ~ICCP_WALL;
        const iccp_tet *const other = &m->tet[across / 4];
        for (int i = 0; i < 4; ++i)
            if (other->v[i] != a && other->v[i] != b && i != (int)(across % 4))
                third = other->v[i];
        t = across / 4;
        (void)stamp;
    }
}

/* Makes the cone. The rim's sides get the numbers of the new tetrahedra with the mark of walls,
 * which inner sides do not have. So each edge finds the tetrahedron beyond it. */
static void make_cone(iccp_tets *m, uint32_t point, uint32_t stamp)
{
    m->fresh.n = m->sides.n = 0;
    for (size_t k = 0; k < m->cavity.n; ++k) {
        const uint32_t t = m->cavity.item[k];
        for (uint32_t i = 0; i < 4; ++i) {
            if (!is_rim(m, &m->tet[t], (int)i, stamp))
                continue;
            const uint8_t *const f = iccp_tet_face[i];
            const uint32_t *const v = m->tet[t].v;
            const uint32_t across = m->tet[t].across[i];
            const uint32_t cone = iccp_tets_new(m, v[f[0]], v[f[1]], v[f[2]], point);
            if (iccp_is_wall_side(across))
                m->tet[cone].across[3] = across;
            else
                iccp_tets_join(m, 4 * cone + 3, across);
            m->fresh.item[m->fresh.n++] = cone;
            m->sides.item[m->sides.n++] = 4 * t + i;
        }
    }
    for (size_t k = 0; k < m->fresh.n; ++k)
        m->tet[m->sides.item[k] / 4].across[m->sides.item[k] % 4] = ICCP_WALL | m->fresh.item[k];
    for (size_t k = 0; k < m->fresh.n; ++k) {
        iccp_tet *const cone = &m->tet[m->fresh.item[k]];
        for (int i = 0; i < 3; ++i) {
            if (cone->across[i] != ICCP_NO_TET)
                continue;
            const uint32_t a = cone->v[(i + 1) % 3], b = cone->v[(i + 2) % 3];
            const uint32_t other = turn(m, m->sides.item[k] / 4, a, b, cone->v[i], stamp);
            const iccp_tet *const tet = &m->tet[other];
            uint32_t j = 0;
            while (tet->v[j] == a || tet->v[j] == b)
                ++j;
            iccp_tets_join(m, 4 * m->fresh.item[k] + (uint32_t)i, 4 * other + j);
        }
    }
    for (size_t k = 0; k < m->cavity.n; ++k)
        iccp_tets_kill(m, m->cavity.item[k]);
}

iccp_inserted iccp_tets_insert(iccp_tets *m, uint32_t point, size_t n_base, bool grow)
{
    const uint32_t stamp = iccp_tets_stamp(m);
    for (size_t k = 0; k < m->cavity.n; ++k)
        m->mark[m->cavity.item[k]] = stamp;
    if (grow && !grow_cavity(m, point, stamp))
        return ICCP_INSERT_MEMORY;
    if (!trim_cavity(m, point, n_base, stamp))
        return ICCP_NOT_INSERTED;
    const size_t n_cone = 2 * m->cavity.n + 2;
    if (!iccp_tets_reserve(m, n_cone) || !iccp_list_reserve(m, &m->fresh, n_cone) ||
        !iccp_list_reserve(m, &m->sides, n_cone))
        return ICCP_INSERT_MEMORY;
    make_cone(m, point, stamp);
    m->hint = m->fresh.item[0];
    return ICCP_INSERTED;
}

icc_status iccp_tets_insert_all(iccp_tets *m, size_t n, const uint32_t *order, const iccp_env *env,
                                icc_error *err)
{
    for (size_t k = 0; k < n; ++k) {
        if (k % 1024 == 0 && iccp_progress(env, "mesh", (double)k / (double)n) != ICC_OK)
            return iccp_explain(err, ICC_ERR_CANCELLED);
        const uint32_t p = order[iccp_tets_turn(m, k, n)];
        const uint32_t t = iccp_tets_locate(m, p, m->hint);
        if (t != ICCP_NO_TET && !iccp_tets_holders(m, p, t))
            return iccp_fail_memory(err);
        const iccp_inserted made =
            t == ICCP_NO_TET ? ICCP_NOT_INSERTED : iccp_tets_insert(m, p, m->cavity.n, true);
        if (made == ICCP_INSERT_MEMORY)
            return iccp_fail_memory(err);
        if (made != ICCP_INSERTED)
            return iccp_fail_at(err, ICC_ERR_RESOLUTION, ICC_ITEM_VERTEX, (int64_t)p,
                                "vertex %lu is too close to others for double precision",
                                (unsigned long)p);
    }
    return ICC_OK;
}
