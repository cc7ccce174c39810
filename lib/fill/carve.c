/* Removes the outside. The walls divide the mesh into parts. The part at the corners of the box is
 * outside. Beyond a wall of the boundary it is the other way round, and beyond an inner surface the
 * same. Each part is flooded before any of its walls is crossed. So no surface needs to be known as
 * outer, void or nested. */
#include "fill/carve.h"

#include "base/error.h"
#include "fill/facet_scan.h"

typedef struct carving {
    iccp_tets *m;
    const iccp_constraints *s;
    uint32_t *wall; /* by side: the facet and ICCP_WALL, or 0 */
    bool *inside;   /* by tetrahedron */
} carving;

/* Sets wall[side] on both sides of all faces that make up facets. */
static icc_status mark_walls(carving *c, icc_error *err)
{
    iccp_facet_scan scan;
    icc_status status = ICC_OK;
    iccp_facet_scan_init(&scan, c->m, c->s);
    for (uint32_t f = 0; f < c->s->n_facets && status == ICC_OK; ++f) {
        if (!iccp_facet_scan_run(&scan, f))
            status = iccp_fail_memory(err);
        else if (scan.piercing.n > 0 || scan.faces.n == 0)
            status = iccp_fail_facet(err, f, "it is missing from the mesh");
        for (size_t k = 0; k < scan.faces.n && status == ICC_OK; ++k) {
            const uint32_t side = scan.faces.item[k];
            c->wall[side] = c->wall[c->m->tet[side / 4].across[side % 4]] = ICCP_WALL | f;
        }
    }
    iccp_facet_scan_free(&scan);
    return status;
}

/* Stamps the tetrahedra beyond the walls, or beyond the other sides, of tetrahedron t, and appends
 * them to m->work. */
static bool visit(carving *c, uint32_t t, bool walls, uint32_t stamp)
{
    iccp_tets *const m = c->m;
    for (uint32_t i = 0; i < 4; ++i) {
        const uint32_t across = m->tet[t].across[i], wall = c->wall[4 * t + i];
        if (across == ICCP_NO_TET || (wall != 0) != walls || m->mark[across / 4] == stamp)
            continue;
        m->mark[across / 4] = stamp;
        c->inside[across / 4] = c->inside[t] != (walls && (wall & ~ICCP_WALL) < c->s->n_boundary);
        if (!iccp_list_push(m, &m->work, across / 4))
            return false;
    }
    return true;
}

/* Finds what is inside. Returns false if there is no memory. */
static bool flood(carving *c)
{
    iccp_tets *const m = c->m;
    const uint32_t seed = m->tet_of[m->points.n_given], stamp = iccp_tets_stamp(m);
    m->work.n = 0;
    m->mark[seed] = stamp;
    if (!iccp_list_push(m, &m->work, seed))
        return false;
    for (size_t flooded = 0, crossed = 0; crossed < m->work.n; ++crossed) {
        for (; flooded < m->work.n; ++flooded)
            if (!visit(c, m->work.item[flooded], false, stamp))
                return false;
        if (!visit(c, m->work.item[crossed], true, stamp))
            return false;
    }
    return true;
}

/* Gives the tetrahedra at a point on one side of an inner surface a copy of the point. Does nothing
 * on the boundary. Returns false if there is no memory. */
static bool part_point(carving *c, uint32_t p)
{
    iccp_tets *const m = c->m;
    if (!iccp_tets_star(m, p))
        return false;
    for (size_t k = 0; k < m->star.n; ++k)
        if (!c->inside[m->star.item[k]])
            return true;
    const iccp_dyadic twin = m->points.dyadic[p - m->points.n_fixed];
    const uint32_t copy = iccp_tets_add_dyadic(m, &twin), stamp = iccp_tets_stamp(m);
    m->cavity.n = 0;
    m->mark[m->star.item[0]] = stamp;
    if (copy == ICCP_NO_TET || !iccp_list_push(m, &m->cavity, m->star.item[0]))
        return false;
    for (size_t k = 0; k < m->cavity.n; ++k) {
        const uint32_t t = m->cavity.item[k];
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t other = m->tet[t].across[i] / 4;
            if (m->tet[t].v[i] == p || c->wall[4 * t + i] != 0 || m->mark[other] == stamp)
                continue;
            m->mark[other] = stamp;
            if (!iccp_list_push(m, &m->cavity, other))
                return false;
        }
    }
    for (size_t k = 0; k < m->star.n; ++k) {
        iccp_tet *const tet = &m->tet[m->star.item[k]];
        if (m->mark[m->star.item[k]] != stamp)
            tet->v[iccp_tet_index(tet, p)] = copy;
    }
    return true;
}

static bool part_points(carving *c)
{
    const iccp_points *const p = &c->m->points;
    const size_t n = c->s->n_boundary < c->s->n_facets ? p->n_fixed + p->n_dyadic : 0;
    for (uint32_t v = (uint32_t)p->n_fixed; v < n; ++v)
        if (!part_point(c, v))
            return false;
    return true;
}

/* m->work still has all tetrahedra, in the order of the flood. */
static void remove_outside(carving *c)
{
    iccp_tets *const m = c->m;
    for (size_t side = 0; side < 4 * m->n_tets; ++side)
        if (c->wall[side] != 0)
            m->tet[side / 4].across[side % 4] = c->wall[side];
    for (size_t k = 0; k < m->work.n; ++k)
        if (!c->inside[m->work.item[k]])
            iccp_tets_kill(m, m->work.item[k]);
    for (size_t p = 0; p < m->points.n; ++p)
        m->tet_of[p] = ICCP_NO_TET;
    for (uint32_t t = 0; t < m->n_tets; ++t)
        for (int i = 0; i < 4 && iccp_tet_alive(m, t); ++i)
            m->tet_of[m->tet[t].v[i]] = t;
}

icc_status iccp_carve(iccp_tets *m, const iccp_constraints *s, const iccp_env *env, icc_error *err)
{
    carving c = {.m = m, .s = s};
    c.wall = iccp_alloc_zero(&env->memory, m->n_tets, 4 * sizeof *c.wall);
    c.inside = iccp_alloc_zero(&env->memory, m->n_tets, sizeof *c.inside);
    icc_status status =
        c.wall == NULL || c.inside == NULL ? iccp_fail_memory(err) : mark_walls(&c, err);
    if (status == ICC_OK && !(flood(&c) && part_points(&c)))
        status = iccp_fail_memory(err);
    if (status == ICC_OK)
        remove_outside(&c);
    iccp_free(&env->memory, c.wall);
    iccp_free(&env->memory, c.inside);
    if (status == ICC_OK && m->n_alive == 0)
        status = iccp_fail(err, ICC_ERR_TOPOLOGY, "no tetrahedron is left inside");
    return status;
}
