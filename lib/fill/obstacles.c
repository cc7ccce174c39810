/* Finds the obstacles of a missing edge. */
#include "fill/obstacles.h"

static bool has(const uint32_t x[3], uint32_t p)
{
    return x[0] == p || x[1] == p || x[2] == p;
}

/* Tells how segment ab meets triangle x in its plane. Seen from d, the triangle is
 * counter-clockwise. */
static int meets_within(const iccp_obstacles *o, const uint32_t x[3], uint32_t d)
{
    const bool has_a = has(x, o->a), has_b = has(x, o->b);
    if (has_a && has_b)
        return ICCP_MISSES;
    int left = 0, right = 0;
    for (int i = 0; i < 3; ++i) {
        const uint32_t u = x[i], v = x[(i + 1) % 3];
        const int of_a = iccp_tets_orient(o->m, u, v, o->a, d);
        const int of_b = iccp_tets_orient(o->m, u, v, o->b, d);
        if (of_a <= 0 && of_b <= 0)
            return ICCP_MISSES;
        const int side = iccp_tets_orient(o->m, o->a, o->b, u, d);
        left += side > 0;
        right += side < 0;
    }
    return left == 3 || right == 3 ? ICCP_MISSES : ICCP_WITHIN;
}

int iccp_obstacles_meet(const iccp_obstacles *o, const uint32_t x[3], uint32_t d)
{
    const int of_a = has(x, o->a) ? 0 : iccp_tets_orient(o->m, x[0], x[1], x[2], o->a);
    const int of_b = has(x, o->b) ? 0 : iccp_tets_orient(o->m, x[0], x[1], x[2], o->b);
    if (of_a == 0 && of_b == 0) {
        if (d != ICCP_NO_TET)
            return meets_within(o, x, d);
        return has(x, o->a) && has(x, o->b) ? ICCP_MISSES : ICCP_WITHIN;
    }
    if (of_a * of_b >= 0)
        return ICCP_MISSES;
    int left = 0, right = 0;
    for (int i = 0; i < 3; ++i) {
        const int side = iccp_tets_orient(o->m, o->a, o->b, x[i], x[(i + 1) % 3]);
        left += side > 0;
        right += side < 0;
    }
    return left > 0 && right > 0     ? ICCP_MISSES
           : left == 3 || right == 3 ? ICCP_THROUGH
                                     : ICCP_AT_EDGE;
}

int iccp_obstacles_meet_side(const iccp_obstacles *o, uint32_t side)
{
    const iccp_tet *const tet = &o->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    return iccp_obstacles_meet(o, (const uint32_t[3]){tet->v[f[0]], tet->v[f[1]], tet->v[f[2]]},
                               tet->v[side % 4]);
}

bool iccp_obstacles_find(iccp_obstacles *o, uint32_t first)
{
    iccp_tets *const m = o->m;
    const uint32_t stamp = iccp_tets_stamp(m);
    o->tets.n = o->crossed.n = 0;
    m->mark[first] = stamp;
    if (!iccp_list_push(m, &o->tets, first))
        return false;
    for (size_t k = 0; k < o->tets.n; ++k) {
        const uint32_t t = o->tets.item[k];
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t across = m->tet[t].across[i];
            if (iccp_is_wall_side(across) || m->mark[across / 4] == stamp ||
                iccp_obstacles_meet_side(o, 4 * t + i) == ICCP_MISSES)
                continue;
            m->mark[across / 4] = stamp;
            if (!iccp_list_push(m, &o->crossed, 4 * t + i) ||
                !iccp_list_push(m, &o->tets, across / 4))
                return false;
        }
    }
    return true;
}
