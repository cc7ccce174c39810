/* A point p on the surface is on one facet, or two if it is on an edge. On each, the faces at p
 * make a polygon, which can be triangulated without p. Then p moves inside, and cones from it over
 * these triangles fill what it leaves. As p sees its link strictly, so do the points near it; hence
 * there is a way for every p, unless doubles are too coarse. Of all places that are tried the one
 * with the best of the worst tetrahedra is taken. */
#include "fill/lift.h"

#include "base/error.h"
#include "base/minmax.h"
#include "fill/contract.h"
#include "fill/improve.h"
#include "fill/insert.h"
#include "fill/quality.h"

typedef struct lifting {
    iccp_tets *m;
    const iccp_surface *s;
    iccp_list walls;     /* the sides at the point that are walls */
    iccp_list polygon;
    iccp_list triangles; /* of all its facets: three points and the facet */
    uint32_t p;
} lifting;

static bool list_walls(lifting *l)
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

static uint32_t facet_of(const lifting *l, uint32_t side)
{
    return l->m->tet[side / 4].across[side % 4] & ~ICCP_WALL;
}

/* The edge of a wall opposite p, counter-clockwise from inside. */
static void opposite(const lifting *l, uint32_t side, uint32_t edge[2])
{
    const iccp_tet *const tet = &l->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    int i = 0;
    while (tet->v[f[i]] != l->p)
        ++i;
    edge[0] = tet->v[f[(i + 1) % 3]];
    edge[1] = tet->v[f[(i + 2) % 3]];
}

/* The points round p on one facet, counter-clockwise from inside. */
static bool list_polygon(lifting *l, uint32_t facet)
{
    uint32_t first = ICCP_NO_TET, edge[2], other[2];
    l->polygon.n = 0;
    for (size_t k = 0; k < l->walls.n; ++k) {
        if (facet_of(l, l->walls.item[k]) != facet)
            continue;
        opposite(l, l->walls.item[k], edge);
        bool begins = first == ICCP_NO_TET;
        for (size_t i = 0; i < l->walls.n; ++i) {
            opposite(l, l->walls.item[i], other);
            if (facet_of(l, l->walls.item[i]) == facet && other[1] == edge[0])
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
            opposite(l, l->walls.item[k], edge);
            if (facet_of(l, l->walls.item[k]) == facet && edge[0] == at)
                next = edge[1];
        }
        at = next == first ? ICCP_NO_TET : next;
    }
    return true;
}

/* What corner i of the polygon is worth as an ear; 0: it is none. Point d lies inside, so that it
 * sees what is counter-clockwise. */
static double ear(const lifting *l, size_t i, uint32_t d)
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

/* Cuts off the best ear until a triangle is left. False if there is no ear, or no memory. */
static bool triangulate(lifting *l, uint32_t facet, uint32_t d)
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

/* The polygons of all facets at p. */
static bool triangulate_all(lifting *l)
{
    l->triangles.n = 0;
    for (size_t k = 0; k < l->walls.n; ++k) {
        const uint32_t side = l->walls.item[k], facet = facet_of(l, side);
        bool known = false;
        for (size_t i = 0; i < k && !known; ++i)
            known = facet_of(l, l->walls.item[i]) == facet;
        if (known)
            continue;
        if (!list_polygon(l, facet) || !triangulate(l, facet, l->m->tet[side / 4].v[side % 4]))
            return false;
    }
    return true;
}

/* The worst quality of what p has where it is now, or something below `least` if that is lower or
 * not all is positive. */
static double worst_at(const lifting *l, double least)
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

/* Ways inside: along the sum of the facets' normals, towards the middle of the link's inner
 * points, between these, and towards the middle of the whole link. Returns the link's radius. */
static double find_directions(const lifting *l, double direction[DIRECTIONS][3])
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

/* Moves p to the best place found; false if there is none, and then p is where it was. */
static bool find_place(lifting *l)
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
            const double length = ldexp(step % 2 == 0 ? radius : 0.7 * radius, -step / 2 - step / 8);
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

/* Makes the cones. Their sides at p join what were walls there, and each other. */
static bool make_cones(lifting *l)
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

/* Whether v is on all facets that p is on: all walls at p have it, or a facet with it. */
static bool is_on_all(const lifting *l, uint32_t v)
{
    for (size_t k = 0; k < l->walls.n; ++k) {
        const uint32_t facet = facet_of(l, l->walls.item[k]);
        if (!iccp_is_on_facet(l->m, l->s->facets + 3 * (size_t)facet, v))
            return false;
    }
    return true;
}

/* Contracts p with another point of all its facets, if that makes nothing worse than `least`. */
static bool contract_point(lifting *l, double least)
{
    iccp_tets *const m = l->m;
    uint32_t best = ICCP_NO_TET;
    for (size_t k = 0; k < l->walls.n; ++k) {
        uint32_t edge[2];
        opposite(l, l->walls.item[k], edge);
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

static lifted lift_point(lifting *l, uint32_t p)
{
    l->p = p;
    if (!list_walls(l))
        return NO_MEMORY;
    double worst = 1.0;
    for (size_t k = 0; k < l->m->star.n; ++k)
        worst = iccp_min(worst, iccp_quality_of(l->m, l->m->star.item[k]));
    if (contract_point(l, iccp_max(worst, 1e-3)))
        return LIFTED;
    if (!triangulate_all(l))
        return contract_point(l, -HUGE_VAL) ? LIFTED : NOT_LIFTED;
    const size_t n = l->triangles.n / 4;
    if (!iccp_tets_reserve(l->m, n) || !iccp_list_reserve(l->m, &l->m->work, l->walls.n + 3 * n))
        return NO_MEMORY;
    if (!find_place(l))
        return contract_point(l, -HUGE_VAL) ? LIFTED : NOT_LIFTED;
    return make_cones(l) ? LIFTED : NO_MEMORY;
}

/* Flips what is nearly flat at a point that is stuck. */
static void improve_star(lifting *l, uint32_t p)
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

/* Joins q to the space of p's star and, as far as it takes to see all of the rim, what is beyond;
 * or, failing that, to what it sees of the star. */
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

/* Puts a point inside, beside p: then what is at p is not flat, and p has somewhere to go. False if
 * it cannot be. */
static bool put_beside(lifting *l, uint32_t p)
{
    iccp_tets *const m = l->m;
    double direction[DIRECTIONS][3];
    l->p = p;
    if (!list_walls(l) || !triangulate_all(l))
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

/* In rounds: a point that is stuck may be free when others have left. */
icc_status iccp_lift(iccp_tets *m, const iccp_surface *s, const iccp_env *env, icc_error *err)
{
    enum { MOST_ROUNDS = 12 };
    lifting l = {.m = m, .s = s};
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
                stuck = l.walls.n > 0 ? facet_of(&l, l.walls.item[0]) : 0;
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
