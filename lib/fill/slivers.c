/* Splits slivers. Flips and moves cannot improve a tetrahedron whose corners all lie on the
 * surface. So a point inside replaces one of its edges. */
#include "fill/slivers.h"

#include "base/minmax.h"
#include "fill/flip.h"
#include "fill/place_search.h"
#include "fill/quality.h"

#include <string.h>

/* Squared sine below which a dihedral angle makes a sliver: some 6 degrees */
static const double flat = 0.01;

typedef struct splitter {
    const iccp_tets *m;
    uint32_t p, q;
    size_t last; /* place in the link where the least sine was; it often is there again */
} splitter;

/* The least squared sine after point x has replaced edge pq, whose link is in m->link. */
static double split_worth(void *context, const double *x, double least)
{
    splitter *const c = context;
    const iccp_points *const points = &c->m->points;
    const double *const p = iccp_point(points, c->p), *const q = iccp_point(points, c->q);
    const iccp_list *const link = &c->m->link;
    double worst = 1.0;
    for (size_t k = 0, place = c->last; k <= link->n && worst > least; place = k++) {
        const double *const a = iccp_point(points, link->item[place]);
        const double *const b = iccp_point(points, link->item[(place + 1) % link->n]);
        const double one = iccp_square_sine(x, q, a, b), other = iccp_square_sine(p, x, a, b);
        if (iccp_min(one, other) < worst) {
            worst = iccp_min(one, other);
            c->last = place;
        }
    }
    return worst;
}

/* Looks for a point to replace edge pq of tetrahedron t. */
static bool try_split(iccp_tets *m, uint32_t t, uint32_t p, uint32_t q, iccp_place *best)
{
    double middle[3] = {0};
    if (iccp_is_kept_edge(m, p, q) || !iccp_tets_ring(m, p, q, t, ICCP_MOST_RING))
        return false;
    const double *const a = iccp_point(&m->points, p), *const b = iccp_point(&m->points, q);
    iccp_place own = {{0}, best->worth};
    for (int i = 0; i < 3; ++i)
        own.x[i] = 0.5 * (a[i] + b[i]);
    double nearest = iccp_square_distance(own.x, a);
    for (size_t k = 0; k < m->link.n; ++k) {
        const double *const y = iccp_point(&m->points, m->link.item[k]);
        nearest = iccp_min(nearest, iccp_square_distance(y, own.x));
        for (int i = 0; i < 3; ++i)
            middle[i] += y[i] / (double)m->link.n;
    }
    splitter context = {m, p, q, 0};
    const iccp_place_measure by = {split_worth, &context};
    iccp_search_place(&m->points, &by, middle, nearest, &own);
    if (!(own.worth > best->worth))
        return false;
    *best = own;
    return true;
}

/* Replaces edge pq of tetrahedron t by a point. */
static void split_edge(iccp_tets *m, uint32_t t, uint32_t p, uint32_t q, const double *x)
{
    uint32_t fresh[2 * ICCP_MOST_RING][4];
    if (!iccp_tets_ring(m, p, q, t, ICCP_MOST_RING))
        return;
    const uint32_t point = iccp_tets_add_point(m, x);
    if (point == ICCP_NO_TET)
        return;
    const size_t n = m->link.n;
    for (size_t k = 0; k < n; ++k) {
        const uint32_t a = m->link.item[k], b = m->link.item[(k + 1) % n];
        memcpy(fresh[2 * k], (const uint32_t[4]){point, q, a, b}, sizeof fresh[0]);
        memcpy(fresh[2 * k + 1], (const uint32_t[4]){p, point, a, b}, sizeof fresh[0]);
    }
    if (!iccp_tets_replace(m, n, m->ring.item, 2 * n, fresh[0]))
        iccp_tets_drop_point(m);
}

/* Replaces the best edge of a tetrahedron by a point if the square of the least sine there doubles.
 * It must, because every point makes more tetrahedra. */
static void split_tet(iccp_tets *m, uint32_t t)
{
    const iccp_tet tet = m->tet[t];
    iccp_place best = {{0}, 2.0 * iccp_quality_of(m, t)};
    int from = 0, to = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j)
            if (try_split(m, t, tet.v[i], tet.v[j], &best))
                from = i, to = j;
    if (from != to)
        split_edge(m, t, tet.v[from], tet.v[to], best.x);
}

void iccp_split_slivers(iccp_tets *m, bool first, uint64_t most)
{
    const size_t n = m->n_tets;
    for (uint32_t t = 0; t < n && m->points.n < most; ++t)
        if (iccp_tet_alive(m, t) && (first || iccp_tet_touched(m, t)) &&
            iccp_quality_of(m, t) < flat)
            split_tet(m, t);
}
