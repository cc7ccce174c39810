/* Lifts the vertices off the surface one after the other. A vertex moves to a point that sees all
 * its tetrahedra and all its faces. Cones from there over these faces fill the gap. In the end
 * there are three tetrahedra below each face. The vertex lifted first has a corner in one of them,
 * and the vertex lifted last in all three. Together they are a prism. Every step is positive,
 * exactly. */
#include "map/solid/coat.h"

#include "fill/tets.h"
#include "map/solid/halfspaces.h"

#include <string.h>

/* How far a vertex is lifted towards the middle of its room, as a share. */
static const double DEPTH = 0.5;

typedef struct lifter {
    iccp_tets mesh; /* points below vertices come last */
    iccp_halfspaces room;
    size_t n_points, n_boundary; /* before lifting */
    uint32_t *below;
    size_t n_below;
} lifter;

/* ---- lifting ---- */

/* Adds the half-space on the inner side of a face of a tetrahedron. */
static bool add_room(lifter *l, const iccp_tet *tet, int side)
{
    const uint8_t *f = iccp_tet_face[side];
    const iccp_points *p = &l->mesh.points;
    if (!iccp_halfspaces_reserve(&l->room, l->room.n + 1)) {
        l->mesh.no_memory = true;
        return false;
    }
    return iccp_halfspaces_add(&l->room, iccp_point(p, tet->v[f[0]]), iccp_point(p, tet->v[f[1]]),
                               iccp_point(p, tet->v[f[2]]));
}

/* Finds a place for vertex v, whose star is in l->mesh.star. */
static bool find_place(lifter *l, uint32_t v, double *x)
{
    iccp_tets *m = &l->mesh;
    const double *from = iccp_point(&m->points, v);
    l->room.n = 0;
    for (size_t s = 0; s < m->star.n; ++s) {
        const iccp_tet *tet = &m->tet[m->star.item[s]];
        const int k = iccp_tet_index(tet, v);
        for (int i = 0; i < 4; ++i)
            if ((i == k || iccp_is_wall_side(tet->across[i])) && !add_room(l, tet, i))
                return false;
    }
    memcpy(x, from, 3 * sizeof *x);
    if (!iccp_halfspaces_enter(&l->room, x))
        return false;
    for (int i = 0; i < 3; ++i)
        x[i] = from[i] + DEPTH * (x[i] - from[i]);
    return true;
}

/* Lists the star of v after v is lifted to a point, in m->cavity. */
static bool list_lifted(iccp_tets *m, uint32_t v, uint32_t point)
{
    m->cavity.n = 0;
    if (!iccp_list_reserve(m, &m->cavity, 16 * m->star.n))
        return false;
    for (size_t s = 0; s < m->star.n; ++s) {
        const iccp_tet *tet = &m->tet[m->star.item[s]];
        const int k = iccp_tet_index(tet, v);
        for (int i = 0; i < 4; ++i) {
            if (i != k && !iccp_is_wall_side(tet->across[i]))
                continue;
            uint32_t *out = m->cavity.item + m->cavity.n;
            memcpy(out, tet->v, sizeof tet->v);
            out[i] = point;
            m->cavity.n += 4;
        }
    }
    return true;
}

static void lift(lifter *l, uint32_t v)
{
    iccp_tets *m = &l->mesh;
    double x[3];
    if (!iccp_tets_star(m, v) || !find_place(l, v, x))
        return;
    const uint32_t point = iccp_tets_add_point(m, x);
    if (point == ICCP_NO_TET)
        return;
    if (list_lifted(m, v, point) && iccp_tets_reserve(m, m->cavity.n / 4) &&
        iccp_tets_replace(m, m->star.n, m->star.item, m->cavity.n / 4, m->cavity.item))
        l->below[v] = (uint32_t)l->n_below++;
    else
        iccp_tets_drop_point(m);
}

/* ---- core and coat ---- */

static bool is_lifted(const lifter *l, uint32_t point)
{
    return point < l->n_boundary && l->below[point] != ICCP_NOTHING_BELOW;
}

static bool is_core(const lifter *l, uint32_t t)
{
    const uint32_t *v = l->mesh.tet[t].v;
    return iccp_tet_alive(&l->mesh, t) && !is_lifted(l, v[0]) && !is_lifted(l, v[1]) &&
           !is_lifted(l, v[2]) && !is_lifted(l, v[3]);
}

static icc_status alloc_core(const lifter *l, size_t n_tets, iccp_coat *coat)
{
    iccp_simplices *core = coat->core = iccp_alloc_zero(&coat->memory, 1, sizeof *core);
    if (core == NULL)
        return ICC_ERR_MEMORY;
    *core = (iccp_simplices){.memory = coat->memory,
                             .dim = 3,
                             .n_points = l->n_points,
                             .n_boundary = l->n_boundary,
                             .n_simplices = n_tets};
    core->points = iccp_alloc(&coat->memory, l->n_points, 3 * sizeof *core->points);
    core->corners = iccp_alloc(&coat->memory, n_tets, 4 * sizeof *core->corners);
    core->across = iccp_alloc(&coat->memory, n_tets, 4 * sizeof *core->across);
    return core->points != NULL && core->corners != NULL && core->across != NULL ? ICC_OK
                                                                                 : ICC_ERR_MEMORY;
}

/* `number`: of each tetrahedron, among those of the core or of the coat. `vertex`: of each point
 * below a vertex. */
static void fill_core(const lifter *l, const uint32_t *number, const uint32_t *vertex,
                      iccp_simplices *core)
{
    const iccp_tets *m = &l->mesh;
    memcpy(core->points, m->points.x, 3 * l->n_points * sizeof *core->points);
    for (size_t k = 0; k < l->n_below; ++k)
        memcpy(core->points + 3 * (size_t)vertex[k],
               iccp_point(&m->points, (uint32_t)(l->n_points + k)), 3 * sizeof *core->points);
    for (uint32_t t = 0; t < m->n_tets; ++t)
        for (int i = 0; is_core(l, t) && i < 4; ++i) {
            const uint32_t v = m->tet[t].v[i], across = m->tet[t].across[i];
            const bool leaves = iccp_is_wall_side(across) || !is_core(l, across / 4);
            core->corners[4 * (size_t)number[t] + (size_t)i] =
                v < l->n_points ? v : vertex[v - l->n_points];
            core->across[4 * (size_t)number[t] + (size_t)i] =
                leaves ? ICCP_ON_BOUNDARY | (uint32_t)core->n_facets++
                       : 4 * number[across / 4] + across % 4;
        }
}

static void fill_coat(const lifter *l, iccp_coat *coat)
{
    uint32_t *out = coat->corners;
    for (uint32_t t = 0; t < l->mesh.n_tets; ++t)
        for (int i = 0; iccp_tet_alive(&l->mesh, t) && !is_core(l, t) && i < 4; ++i) {
            const uint32_t v = l->mesh.tet[t].v[i];
            *out++ = v < l->n_points ? v : (uint32_t)(v - l->n_points + l->n_boundary);
        }
}

static icc_status give(const lifter *l, iccp_coat *coat)
{
    const iccp_memory *memory = &coat->memory;
    uint32_t *number = iccp_alloc(memory, l->mesh.n_tets, sizeof *number);
    uint32_t *vertex = iccp_alloc(memory, l->n_below + 1, sizeof *vertex);
    size_t n_core = 0;
    icc_status status = number != NULL && vertex != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (uint32_t t = 0; t < l->mesh.n_tets; ++t)
            if (is_core(l, t))
                number[t] = (uint32_t)n_core++;
        for (uint32_t v = 0; v < l->n_boundary; ++v)
            if (is_lifted(l, v))
                vertex[l->below[v]] = v;
        coat->n_below = l->n_below;
        coat->n_tets = l->mesh.n_alive - n_core;
        coat->corners = iccp_alloc(memory, coat->n_tets + 1, 4 * sizeof *coat->corners);
        status = coat->corners != NULL ? alloc_core(l, n_core, coat) : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK) {
        fill_core(l, number, vertex, coat->core);
        fill_coat(l, coat);
    }
    iccp_free(memory, number);
    iccp_free(memory, vertex);
    return status;
}

icc_status iccp_coat_create(iccp_coat *coat, const iccp_simplices *mesh, const iccp_memory *memory)
{
    lifter l = {.n_points = mesh->n_points, .n_boundary = mesh->n_boundary};
    *coat = (iccp_coat){.memory = *memory};
    iccp_tets_init(&l.mesh, memory);
    l.room.memory = *memory;
    coat->below = iccp_alloc(memory, l.n_boundary, sizeof *coat->below);
    l.below = coat->below;
    icc_status status =
        coat->below != NULL && iccp_tets_copy(&l.mesh, mesh) ? ICC_OK : ICC_ERR_MEMORY;
    for (uint32_t v = 0; status == ICC_OK && v < l.n_boundary; ++v)
        l.below[v] = ICCP_NOTHING_BELOW;
    for (uint32_t v = 0; status == ICC_OK && v < l.n_boundary; ++v) {
        lift(&l, v);
        status = l.mesh.no_memory ? ICC_ERR_MEMORY : ICC_OK;
    }
    if (status == ICC_OK)
        status = give(&l, coat);
    iccp_tets_free(&l.mesh);
    iccp_halfspaces_free(&l.room);
    return status;
}

void iccp_coat_free(iccp_coat *coat)
{
    iccp_simplices_free(coat->core);
    iccp_free(&coat->memory, coat->below);
    iccp_free(&coat->memory, coat->corners);
}
