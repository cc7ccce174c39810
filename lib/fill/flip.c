/* Removes edges and faces. Edge removal follows G. T. Klincsek, Minimal triangulations of polygonal
 * domains, Annals of Discrete Mathematics 9, 1980: the best triangulation of the link follows from
 * the best ones of its parts. */
#include "fill/flip.h"

#include "base/minmax.h"

enum { MOST = ICCP_MOST_RING };

/* For the part of the link from corner i to corner j: the best worth, and the third corner of the
 * triangle at ij. */
typedef struct parts {
    double worth[MOST][MOST];
    uint8_t split[MOST][MOST];
} parts;

/* If the least worth counts, triangulations that are not better than `least` are skipped. */
static void find_best(parts *best, size_t n, const uint32_t *link, const iccp_removal *removal,
                      double least)
{
    const double none = removal->sum ? -HUGE_VAL : least;
    for (size_t i = 0; i + 1 < n; ++i)
        best->worth[i][i + 1] = removal->sum ? 0.0 : HUGE_VAL;
    for (size_t width = 2; width < n; ++width)
        for (size_t i = 0; i + width < n; ++i) {
            const size_t j = i + width;
            best->worth[i][j] = none;
            best->split[i][j] = (uint8_t)(i + 1);
            for (size_t k = i + 1; k < j; ++k) {
                const double left = best->worth[i][k], right = best->worth[k][j];
                if (left == none || right == none ||
                    (!removal->sum && iccp_min(left, right) <= best->worth[i][j]))
                    continue;
                const double own =
                    removal->worth(removal->context, link[i], link[k], link[j], width < n - 1);
                const double worth =
                    removal->sum ? left + right + own : iccp_min(iccp_min(left, right), own);
                if (worth > best->worth[i][j]) {
                    best->worth[i][j] = worth;
                    best->split[i][j] = (uint8_t)k;
                }
            }
        }
}

bool iccp_remove_edge(iccp_tets *m, uint32_t p, uint32_t q, const iccp_removal *removal,
                      double least)
{
    parts best;
    const size_t n = m->link.n;
    const uint32_t *const link = m->link.item;
    if (n < 3 || n > MOST || iccp_is_kept_edge(m, p, q))
        return false;
    find_best(&best, n, link, removal, least);
    if (!(best.worth[0][n - 1] > least))
        return false;
    uint32_t fresh[2 * MOST][4];
    uint8_t stack[MOST][2] = {{0, (uint8_t)(n - 1)}};
    size_t n_stack = 1, n_fresh = 0;
    while (n_stack > 0) {
        const uint8_t i = stack[--n_stack][0], j = stack[n_stack][1];
        if (j - i < 2)
            continue;
        const uint8_t k = best.split[i][j];
        /* (p, q, link[i], link[i + 1]) is positive, so the link is counter-clockwise seen from
         * q. */
        const uint32_t up[4] = {link[i], link[k], link[j], q};
        const uint32_t down[4] = {link[k], link[i], link[j], p};
        for (int c = 0; c < 4; ++c) {
            fresh[n_fresh][c] = up[c];
            fresh[n_fresh + 1][c] = down[c];
        }
        n_fresh += 2;
        stack[n_stack][0] = i, stack[n_stack++][1] = k;
        stack[n_stack][0] = k, stack[n_stack++][1] = j;
    }
    return iccp_tets_replace(m, n, m->ring.item, n_fresh, fresh[0]);
}

bool iccp_face_removed(const iccp_tets *m, uint32_t side, uint32_t fresh[3][4])
{
    const iccp_tet *const tet = &m->tet[side / 4];
    const uint32_t across = tet->across[side % 4];
    if (iccp_is_wall_side(across))
        return false;
    const uint8_t *const f = iccp_tet_face[side % 4];
    const uint32_t a = tet->v[side % 4], b = m->tet[across / 4].v[across % 4];
    for (int i = 0; i < 3; ++i) {
        fresh[i][0] = tet->v[f[i]];
        fresh[i][1] = tet->v[f[(i + 1) % 3]];
        fresh[i][2] = b;
        fresh[i][3] = a;
    }
    return true;
}

bool iccp_remove_face(iccp_tets *m, uint32_t side)
{
    uint32_t fresh[3][4];
    if (!iccp_face_removed(m, side, fresh))
        return false;
    const uint32_t old[2] = {side / 4, m->tet[side / 4].across[side % 4] / 4};
    return iccp_tets_replace(m, 2, old, 3, fresh[0]);
}
