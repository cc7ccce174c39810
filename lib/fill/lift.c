/* Lifts points off the surface. A point p on the surface is on one facet, or on two if it is on an
 * edge. On each facet, the faces at p form a polygon, which can be triangulated without p. Then p
 * moves inside, and cones from p over these triangles fill the space that it leaves.
 *
 * p sees its link strictly, and so do points near it. So every p can be lifted, unless doubles are
 * too coarse. Of all places tried, the one whose worst tetrahedron is best is taken. */
#include "fill/lift.h"

#include "base/error.h"
#include "base/minmax.h"
#include "fill/contract.h"
#include "fill/insert.h"
#include "fill/lifting.h"
#include "fill/quality.h"
#include "fill/reshape.h"

/* Returns the worst quality of the tetrahedra at p in its present place. May return less than
 * `least` if it is lower or if not all tetrahedra are positive. */
static double worst_at(const iccp_lifting *l, double least)
{
    const iccp_tets *const m = l->m;
    double worst = 1.0;
    for (size_t k = 0; k < m->star.n && worst > least; ++k)
        worst = iccp_min(worst, iccp_quality_of(m, m->star.item[k]));
    for (size_t k = 0; k < l->triangles.n && worst > least; k += 4) {
        const uint32_t *const t = l->triangles.item + k;
        worst = iccp_min(worst, iccp_tets_quality(m, t[0], t[1], t[2], l->p));
    }
    if (!(worst > least))
        return -1.0;
    for (size_t k = 0; k < m->star.n; ++k) {
        const uint32_t *const v = m->tet[m->star.item[k]].v;
        if (iccp_tets_orient(m, v[0], v[1], v[2], v[3]) <= 0)
            return -1.0;
    }
    for (size_t k = 0; k < l->triangles.n; k += 4) {
        const uint32_t *const t = l->triangles.item + k;
        if (iccp_tets_orient(m, t[0], t[1], t[2], l->p) <= 0)
            return -1.0;
    }
    return worst;
}

static bool normalise(double d[3])
{
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    for (int k = 0; k < 3; ++k)
        d[k] /= length;
    return length > 0.0;
}

enum { DIRECTIONS = 4 };

/* Finds directions to the inside: the sum of the facets' normals, the middle of the link's inner
 * points, directions between these two, and the middle of the whole link. Returns the link's
 * radius. */
static double find_directions(const iccp_lifting *l, double direction[DIRECTIONS][3])
{
    const iccp_tets *const m = l->m;
    const double *const x = iccp_point(&m->points, l->p);
    double radius = 0.0;
    for (int i = 0; i < DIRECTIONS; ++i)
        for (int k = 0; k < 3; ++k)
            direction[i][k] = 0.0;
    for (size_t i = 0; i < l->triangles.n; i += 4) {
        if (i > 0 && l->triangles.item[i + 3] == l->triangles.item[i - 1])
            continue;
        const double *const a = iccp_point(&m->points, l->triangles.item[i]);
        const double *const b = iccp_point(&m->points, l->triangles.item[i + 1]);
        const double *const c = iccp_point(&m->points, l->triangles.item[i + 2]);
        double normal[3];
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            normal[k] = (b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u]);
        }
        if (m->metric.on)
            iccp_metric_steepest(&m->metric, normal);
        normalise(normal);
        for (int k = 0; k < 3; ++k)
            direction[0][k] += normal[k];
    }
    for (size_t i = 0; i < m->star.n; ++i)
        for (int c = 0; c < 4; ++c) {
            const uint32_t v = m->tet[m->star.item[i]].v[c];
            const double *const y = iccp_point(&m->points, v);
            const double scale = 1.0 / (double)m->star.n;
            bool on_wall = v == l->p;
            for (size_t w = 0; w < l->triangles.n && !on_wall; ++w)
                on_wall = w % 4 != 3 && l->triangles.item[w] == v;
            radius = iccp_max(radius, iccp_square_distance(x, y));
            for (int k = 0; k < 3; ++k) {
                direction[1][k] += on_wall ? 0.0 : scale * (y[k] - x[k]);
                direction[3][k] += scale * (y[k] - x[k]);
            }
        }
    normalise(direction[0]);
    normalise(direction[1]);
    normalise(direction[3]);
    for (int k = 0; k < 3; ++k)
        direction[2][k] = direction[0][k] + direction[1][k];
    normalise(direction[2]);
    return sqrt(radius);
}

/* Moves p to the best place found. Returns false and leaves p if there is none. */
static bool find_place(iccp_lifting *l)
{
    iccp_points *const points = &l->m->points;
    double *const x = points->x + 3 * (size_t)l->p;
    iccp_dyadic *const d = &points->dyadic[l->p - points->n_fixed];
    const double from[3] = {x[0], x[1], x[2]}, share = d->share[0];
    double direction[DIRECTIONS][3], best = 0.0, place[3] = {0};
    const double radius = find_directions(l, direction);
    d->share[0] = 0.0;
    for (int i = 0; i < DIRECTIONS; ++i)
        for (int step = 0; step < 80; ++step) {
            const double length =
                ldexp(step % 2 == 0 ? radius : 0.7 * radius, -step / 2 - step / 8);
            for (int k = 0; k < 3; ++k)
                x[k] = from[k] + length * direction[i][k];
            if (!(fabs(x[0]) + fabs(x[1]) + fabs(x[2]) < 8.0))
                continue;
            iccp_points_snap(points, x);
            const double worst = worst_at(l, best);
            if (worst > best) {
                best = worst;
                for (int k = 0; k < 3; ++k)
                    place[k] = x[k];
            }
        }
    for (int k = 0; k < 3; ++k)
        x[k] = best > 0.0 ? place[k] : from[k];
    if (!(best > 0.0))
        d->share[0] = share;
    return best > 0.0;
}

typedef enum lifted { LIFTED, NOT_LIFTED, NO_MEMORY } lifted;

/* Makes the cones. Their sides at p are joined with the former walls and with each other. */
static bool make_cones(iccp_lifting *l)
{
    iccp_tets *const m = l->m;
    const size_t n = l->triangles.n / 4;
    if (!iccp_tets_reserve(m, n) || !iccp_list_reserve(m, &m->work, l->walls.n + 3 * n))
        return false;
    m->work.n = 0;
    for (size_t k = 0; k < l->walls.n; ++k)
        m->work.item[m->work.n++] = l->walls.item[k];
    for (size_t k = 0; k < n; ++k) {
        const uint32_t *const t = l->triangles.item + 4 * k;
        const uint32_t cone = iccp_tets_new(m, t[0], t[1], t[2], l->p);
        m->tet[cone].across[3] = ICCP_WALL | t[3];
        for (uint32_t i = 0; i < 3; ++i)
            m->work.item[m->work.n++] = 4 * cone + i;
    }
    iccp_tets_match(m, m->work.n, m->work.item);
    return true;
}

/* Returns true if v is on all facets that p is on: every wall at p contains v, or belongs to a
 * facet that does. */
static bool is_on_all(const iccp_lifting *l, uint32_t v)
{
    for (size_t k = 0; k < l->walls.n; ++k) {
        const uint32_t facet = iccp_lifting_facet(l, l->walls.item[k]);
        if (!iccp_is_on_facet(l->m, l->s->facets + 3 * (size_t)facet, v))
            return false;
    }
    return true;
}

/* Contracts p with another point of all its facets, if nothing becomes worse than `least`. */
static bool contract_point(iccp_lifting *l, double least)
{
    iccp_tets *const m = l->m;
    uint32_t best = ICCP_NO_TET;
    for (size_t k = 0; k < l->walls.n; ++k) {
        uint32_t edge[2];
        iccp_lifting_opposite(l, l->walls.item[k], edge);
        for (int i = 0; i < 2; ++i) {
            if (!is_on_all(l, edge[i]))
                continue;
            const double worth = iccp_contraction_worth(m, l->p, edge[i], least);
            if (worth > least) {
                least = worth;
                best = edge[i];
            }
        }
    }
    if (best == ICCP_NO_TET || !iccp_contract(m, l->p, best))
        return false;
    m->points.dyadic[l->p - m->points.n_fixed].share[0] = 0.0;
    return true;
}

static lifted lift_point(iccp_lifting *l, uint32_t p)
{
    l->p = p;
    if (!iccp_lifting_walls(l))
        return NO_MEMORY;
    double worst = 1.0;
    for (size_t k = 0; k < l->m->star.n; ++k)
        worst = iccp_min(worst, iccp_quality_of(l->m, l->m->star.item[k]));
    if (contract_point(l, iccp_max(worst, 1e-3)))
        return LIFTED;
    if (!iccp_lifting_triangulate(l))
        return contract_point(l, -HUGE_VAL) ? LIFTED : NOT_LIFTED;
    const size_t n = l->triangles.n / 4;
    if (!iccp_tets_reserve(l->m, n) || !iccp_list_reserve(l->m, &l->m->work, l->walls.n + 3 * n))
        return NO_MEMORY;
    if (!find_place(l))
        return contract_point(l, -HUGE_VAL) ? LIFTED : NOT_LIFTED;
    return make_cones(l) ? LIFTED : NO_MEMORY;
}

/* Flips nearly flat tetrahedra at a point that is stuck. */
static void improve_star(iccp_lifting *l, uint32_t p)
{
    enum { MOST_FLIPS = 20 };
    const double nearly_flat = 1e-3;
    iccp_tets *const m = l->m;
    for (int n = 0; n < MOST_FLIPS; ++n) {
        bool changed = false;
        if (!iccp_tets_star(m, p) || !iccp_list_reserve(m, &l->polygon, m->star.n))
            return;
        l->polygon.n = 0;
        for (size_t k = 0; k < m->star.n; ++k)
            l->polygon.item[l->polygon.n++] = m->star.item[k];
        for (size_t k = 0; k < l->polygon.n && !changed; ++k) {
            const uint32_t t = l->polygon.item[k];
            changed = iccp_quality_of(m, t) < nearly_flat && iccp_improve_tet(m, t);
        }
        if (!changed)
            return;
    }
}

/* Joins q to the space of p's star and, as far as necessary to see the whole rim, of the tetrahedra
 * beyond. If that fails, joins q to the part of the star that it sees. */
static bool join_star(iccp_tets *m, uint32_t q)
{
    enum { MOST = 500 };
    const uint32_t t = iccp_tets_locate(m, q, m->star.item[0]);
    for (int turn = 0; turn < 2 && t != ICCP_NO_TET; ++turn) {
        if (!iccp_tets_holders(m, q, t))
            return false;
        const size_t n_base = m->cavity.n;
        for (size_t k = 0; k < m->star.n; ++k) {
            bool known = false;
            for (size_t j = 0; j < n_base && !known; ++j)
                known = m->cavity.item[j] == m->star.item[k];
            if (!known && !iccp_list_push(m, &m->cavity, m->star.item[k]))
                return false;
        }
        if (turn == 0 && !iccp_tets_extend(m, q, MOST))
            return false;
        if (iccp_tets_insert(m, q, turn == 0 ? m->cavity.n : n_base, turn != 0) == ICCP_INSERTED)
            return true;
    }
    return false;
}

/* Puts a point inside, beside p. Then the tetrahedra at p are not flat, and p has room to move.
 * Returns false if that fails. */
static bool put_beside(iccp_lifting *l, uint32_t p)
{
    iccp_tets *const m = l->m;
    double direction[DIRECTIONS][3];
    l->p = p;
    if (!iccp_lifting_walls(l) || !iccp_lifting_triangulate(l))
        return false;
    const double radius = find_directions(l, direction);
    for (int step = 1; step < 40; ++step)
        for (int i = 0; i < DIRECTIONS; ++i) {
            double x[3];
            for (int k = 0; k < 3; ++k)
                x[k] = iccp_point(&m->points, p)[k] + ldexp(radius, -step) * direction[i][k];
            if (!(fabs(x[0]) + fabs(x[1]) + fabs(x[2]) < 8.0))
                continue;
            iccp_points_snap(&m->points, x);
            const uint32_t q = iccp_tets_add_point(m, x);
            if (q == ICCP_NO_TET)
                return false;
            if (join_star(m, q))
                return true;
            iccp_tets_drop_point(m);
        }
    return false;
}

/* Goes in rounds, because a stuck point may become free after others have left. */
icc_status iccp_lift(iccp_tets *m, const iccp_constraints *s, const iccp_env *env, icc_error *err)
{
    enum { MOST_ROUNDS = 12 };
    iccp_lifting l = {.m = m, .s = s};
    const iccp_points *const points = &m->points;
    icc_status status = ICC_OK;
    size_t n_left = points->n_dyadic;
    uint32_t stuck = 0;
    for (int round = 0; round < MOST_ROUNDS && n_left > 0; ++round) {
        n_left = 0;
        for (size_t k = points->n_dyadic; k-- > 0 && status == ICC_OK;) {
            const uint32_t p = (uint32_t)(points->n_fixed + k);
            if (!iccp_is_dyadic(points, p))
                continue;
            if (round > 0)
                improve_star(&l, p);
            if (round > 1)
                put_beside(&l, p);
            const lifted done = lift_point(&l, p);
            if (done == NO_MEMORY)
                status = iccp_fail_memory(err);
            if (done == NOT_LIFTED) {
                ++n_left;
                stuck = l.walls.n > 0 ? iccp_lifting_facet(&l, l.walls.item[0]) : 0;
            }
        }
        if (status == ICC_OK)
            status = iccp_explain(err, iccp_progress(env, "mesh", (double)round / MOST_ROUNDS));
    }
    if (status == ICC_OK && n_left > 0)
        status = iccp_fail_facet(err, stuck, "there is no room for a point beside it");
    iccp_free(&m->memory, l.walls.item);
    iccp_free(&m->memory, l.polygon.item);
    iccp_free(&m->memory, l.triangles.item);
    return status;
}
