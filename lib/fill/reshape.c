/* Flips and moves that improve the worst tetrahedron that they touch, as in L. Freitag and C.
 * Ollivier-Gooch, Tetrahedral mesh improvement using swapping and smoothing, 1997. */
#include "fill/reshape.h"

#include "base/error.h"
#include "base/minmax.h"
#include "fill/contract.h"
#include "fill/flip.h"
#include "fill/place_search.h"
#include "fill/quality.h"
#include "fill/slivers.h"

#include <string.h>

/* Least improvement, and the quality from which tetrahedra are left alone: by volume, where 0.03
 * means dihedral angles of some 10 degrees, and 0.1 some 18; and by angle, where 0.1 is 18 degrees.
 */
static const double gain = 1e-4, good = 0.12, good_angle = 0.1;
static const size_t most_ring = 8;

static bool is_good(const iccp_tets *m, uint32_t t)
{
    return iccp_quality_of(m, t) >= (m->by_angle ? good_angle : good);
}

typedef struct edge {
    const iccp_tets *m;
    uint32_t p, q;
} edge;

static double worth(void *context, uint32_t x, uint32_t y, uint32_t z, bool inner_xz)
{
    const edge *const e = context;
    (void)inner_xz;
    return iccp_min(iccp_tets_quality(e->m, x, y, z, e->q), iccp_tets_quality(e->m, y, x, z, e->p));
}

static bool try_edge(iccp_tets *m, uint32_t t, double worst, uint32_t p, uint32_t q)
{
    edge e = {m, p, q};
    const iccp_removal removal = {worth, &e, false};
    if (!iccp_tets_ring(m, p, q, t, most_ring))
        return false;
    for (size_t k = 1; k < m->ring.n; ++k)
        if (iccp_quality_of(m, m->ring.item[k]) < worst)
            return false; /* the other tetrahedron has its own turn */
    return iccp_remove_edge(m, p, q, &removal, worst + gain * fabs(worst));
}

static bool try_face(iccp_tets *m, uint32_t side, double worst)
{
    uint32_t fresh[3][4];
    if (!iccp_face_removed(m, side, fresh))
        return false;
    if (iccp_quality_of(m, m->tet[side / 4].across[side % 4] / 4) < worst)
        return false;
    for (int i = 0; i < 3; ++i)
        if (iccp_tets_quality(m, fresh[i][0], fresh[i][1], fresh[i][2], fresh[i][3]) <=
            worst + gain * fabs(worst))
            return false;
    return iccp_remove_face(m, side);
}

bool iccp_improve_tet(iccp_tets *m, uint32_t t)
{
    const iccp_tet tet = m->tet[t];
    const double worst = iccp_quality_of(m, t);
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            if (try_edge(m, t, worst, tet.v[i], tet.v[j]))
                return true;
    for (uint32_t i = 0; i < 4; ++i)
        if (try_face(m, 4 * t + i, worst))
            return true;
    return false;
}

/* Returns the worst quality at a point whose star is in m->star, or something that is not above
 * `least`. *last is the place of the worst tetrahedron in the star. It is looked at first, because
 * it often is the worst in the next place, too. */
static double worst_at(const iccp_tets *m, double least, size_t *last)
{
    double worst = iccp_quality_of(m, m->star.item[*last]);
    for (size_t k = 0; k < m->star.n && worst > least; ++k) {
        const double quality = iccp_quality_of(m, m->star.item[k]);
        if (quality < worst) {
            worst = quality;
            *last = k;
        }
    }
    return worst;
}

static bool all_positive(const iccp_tets *m)
{
    for (size_t k = 0; k < m->star.n; ++k) {
        const uint32_t *const v = m->tet[m->star.item[k]].v;
        if (iccp_tets_orient(m, v[0], v[1], v[2], v[3]) <= 0)
            return false;
    }
    return true;
}

typedef struct mover {
    iccp_tets *m;
    uint32_t p;
    size_t last; /* see worst_at() */
} mover;

/* The worst quality at a point, whose star is in m->star, after a move. */
static double move_worth(void *context, const double *x, double least)
{
    mover *const c = context;
    memcpy(c->m->points.x + 3 * (size_t)c->p, x, 3 * sizeof *x);
    const double worst = worst_at(c->m, least, &c->last);
    return worst > least && all_positive(c->m) ? worst : -HUGE_VAL;
}

bool iccp_smooth_point(iccp_tets *m, uint32_t p)
{
    double *const now = m->points.x + 3 * (size_t)p;
    double middle[3] = {0}, nearest = HUGE_VAL;
    if (!iccp_tets_star(m, p))
        return false;
    mover context = {m, p, 0};
    const double before = worst_at(m, -HUGE_VAL, &context.last),
                 least = before + gain * fabs(before);
    iccp_place best = {{now[0], now[1], now[2]}, least};
    for (size_t k = 0; k < m->star.n; ++k)
        for (int c = 0; c < 4; ++c) {
            const double *const y = iccp_point(&m->points, m->tet[m->star.item[k]].v[c]);
            if (m->tet[m->star.item[k]].v[c] == p)
                continue;
            nearest = iccp_min(nearest, iccp_square_distance(y, now));
            for (int i = 0; i < 3; ++i)
                middle[i] += y[i] / (3.0 * (double)m->star.n);
        }
    const iccp_place_measure by = {move_worth, &context};
    iccp_search_place(&m->points, &by, middle, nearest, &best);
    memcpy(now, best.x, sizeof best.x);
    if (!(best.worth > least))
        return false;
    for (size_t k = 0; k < m->star.n; ++k)
        for (int c = 0; c < 4; ++c)
            m->touched[m->tet[m->star.item[k]].v[c]] = m->round;
    return true;
}

/* A try that failed in the last round is repeated only where something has changed since, because
 * it would fail again. */
static void flip_all(iccp_tets *m)
{
    const size_t n = m->n_tets;
    for (uint32_t t = 0; t < n; ++t)
        if (iccp_tet_alive(m, t) && iccp_tet_touched(m, t) && !is_good(m, t))
            iccp_improve_tet(m, t);
}

/* Stamps the points of bad tetrahedra. Skips tetrahedra whose corners have not changed, because
 * there is nothing new to try. */
static uint32_t stamp_bad(iccp_tets *m)
{
    const uint32_t stamp = iccp_tets_stamp(m);
    for (uint32_t t = 0; t < m->n_tets; ++t)
        if (iccp_tet_alive(m, t) && iccp_tet_touched(m, t) && !is_good(m, t))
            for (int i = 0; i < 4; ++i)
                m->seen[m->tet[t].v[i]] = stamp;
    return stamp;
}

icc_status iccp_tets_clean_up(iccp_tets *m, const iccp_env *env, icc_error *err)
{
    enum { ROUNDS = 4 };
    const double enough = 1e-4; /* worst quality that may remain */
    for (int round = 0; round < ROUNDS; ++round) {
        const icc_status status =
            iccp_explain(err, iccp_progress(env, "mesh", (double)round / ROUNDS));
        if (status != ICC_OK)
            return status;
        ++m->round;
        for (uint32_t p = (uint32_t)m->points.n_fixed; p < m->points.n; ++p)
            if (m->tet_of[p] != ICCP_NO_TET && iccp_point_touched(m, p) &&
                !iccp_contract_best(m, p, enough))
                iccp_smooth_point(m, p);
        flip_all(m);
    }
    return ICC_OK;
}

icc_status iccp_tets_improve(iccp_tets *m, bool by_angle, uint64_t most, const iccp_env *env,
                             icc_error *err)
{
    enum { ROUNDS = 4 };
    m->by_angle = by_angle;
    for (size_t p = 0; p < m->points.n && by_angle; ++p)
        m->touched[p] = m->round; /* nothing has been tried by this measure */
    for (int round = 0; round < ROUNDS; ++round) {
        const icc_status status =
            iccp_explain(err, iccp_progress(env, "mesh", (double)round / ROUNDS));
        if (status != ICC_OK)
            return status;
        ++m->round;
        flip_all(m);
        if (by_angle && round > 0)
            iccp_split_slivers(m, round == 1, most);
        const uint32_t stamp = stamp_bad(m);
        for (uint32_t p = (uint32_t)m->points.n_fixed; p < m->points.n; ++p)
            if (m->tet_of[p] != ICCP_NO_TET && m->seen[p] == stamp && iccp_point_touched(m, p))
                iccp_smooth_point(m, p);
    }
    return ICC_OK;
}
