/* Contractions: a point is merged into a neighbour. */
#include "fill/contract.h"

#include "base/minmax.h"
#include "fill/quality.h"

/* Lists the corners of a tetrahedron of the star with v in place of p. */
static void renamed(const iccp_tet *tet, uint32_t p, uint32_t v, uint32_t corner[4])
{
    for (int i = 0; i < 4; ++i)
        corner[i] = tet->v[i] == p ? v : tet->v[i];
}

double iccp_contraction_worth(const iccp_tets *m, uint32_t p, uint32_t v, double least)
{
    double worst = 1.0;
    for (size_t k = 0; k < m->star.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->star.item[k]];
        uint32_t c[4];
        if (iccp_tet_index(tet, v) >= 0)
            continue;
        renamed(tet, p, v, c);
        worst = iccp_min(worst, iccp_tets_quality(m, c[0], c[1], c[2], c[3]));
        if (!(worst > least))
            return -1.0;
    }
    return worst;
}

bool iccp_contract(iccp_tets *m, uint32_t p, uint32_t v)
{
    if (!iccp_list_reserve(m, &m->link, 4 * m->star.n))
        return false;
    m->link.n = 0;
    for (size_t k = 0; k < m->star.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->star.item[k]];
        if (iccp_tet_index(tet, v) >= 0)
            continue;
        renamed(tet, p, v, m->link.item + m->link.n);
        m->link.n += 4;
    }
    if (!iccp_tets_contract(m, p, v, m->star.n, m->star.item, m->link.n / 4, m->link.item))
        return false;
    m->tet_of[p] = ICCP_NO_TET;
    return true;
}

bool iccp_contract_best(iccp_tets *m, uint32_t p, double least)
{
    uint32_t best = ICCP_NO_TET;
    if (!iccp_tets_star(m, p))
        return false;
    const uint32_t stamp = iccp_tets_stamp(m);
    for (size_t k = 0; k < m->star.n; ++k)
        for (int i = 0; i < 4; ++i) {
            const uint32_t v = m->tet[m->star.item[k]].v[i];
            if (v == p || m->seen[v] == stamp)
                continue;
            m->seen[v] = stamp;
            const double worth = iccp_contraction_worth(m, p, v, least);
            if (worth > least) {
                least = worth;
                best = v;
            }
        }
    return best != ICCP_NO_TET && iccp_contract(m, p, best);
}
