/* Every question about a cell is answered by exact predicates. A cell is either a tetrahedron in
 * place or a cone over a face of the front. */
#include "map/solid/cone.h"

#include "map/energy/simplicial_map.h"

#include <string.h>

/* Stands for a corner if no side belongs to a cone. */
enum { NO_SIDE = 4 };

bool iccp_cone_reserve(iccp_cone *cone)
{
    iccp_tets *m = &cone->mesh;
    if (m->points.room > cone->point_room) {
        const size_t n = m->points.room, old = cone->point_room;
        if (!iccp_enlarge(&m->memory, &cone->image, old, n, 3 * sizeof *cone->image) ||
            !iccp_enlarge(&m->memory, &cone->n_faces, old, n, sizeof *cone->n_faces)) {
            m->no_memory = true;
            return false;
        }
        memset(cone->n_faces + old, 0, (n - old) * sizeof *cone->n_faces);
        cone->point_room = n;
        for (size_t v = old; v < n; ++v)
            iccp_cone_forget(cone, (uint32_t)v);
    }
    if (m->room > cone->tet_room) {
        if (!iccp_enlarge(&m->memory, &cone->is_placed, cone->tet_room, m->room, 1)) {
            m->no_memory = true;
            return false;
        }
        memset(cone->is_placed + cone->tet_room, 0, m->room - cone->tet_room);
        cone->tet_room = m->room;
    }
    return true;
}

bool iccp_cone_cut(iccp_cone *cone, int n, const uint32_t *ends, size_t n_old, const uint32_t *old,
                   uint32_t *point)
{
    iccp_tets *m = &cone->mesh;
    double x[3] = {0};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < n; ++k)
            x[i] += iccp_point(&m->points, ends[k])[i];
        x[i] /= n;
    }
    m->cavity.n = 0;
    if (!iccp_list_reserve(m, &m->cavity, 4 * (size_t)n * n_old))
        return false;
    *point = iccp_tets_add_point(m, x);
    if (*point == ICCP_NO_TET)
        return false;
    for (size_t t = 0; t < n_old; ++t)
        for (int k = 0; k < n; ++k) {
            const iccp_tet *tet = &m->tet[old[t]];
            uint32_t *piece = m->cavity.item + m->cavity.n;
            memcpy(piece, tet->v, sizeof tet->v);
            piece[iccp_tet_index(tet, ends[k])] = *point;
            m->cavity.n += 4;
        }
    if (!iccp_tets_reserve(m, m->cavity.n / 4) || !iccp_cone_reserve(cone) ||
        !iccp_tets_replace(m, n_old, old, m->cavity.n / 4, m->cavity.item)) {
        iccp_tets_drop_point(m);
        return false;
    }
    return true;
}

static void count_faces(iccp_cone *cone, uint32_t tet, int side, uint32_t change)
{
    for (int k = 0; k < 3; ++k)
        cone->n_faces[cone->mesh.tet[tet].v[iccp_tet_face[side][k]]] += change;
}

icc_status iccp_cone_create(iccp_cone *cone, const iccp_simplices *mesh, const double *boundary,
                            const iccp_memory *memory)
{
    *cone = (iccp_cone){.n_fixed = mesh->n_boundary, .n_left = mesh->n_simplices};
    iccp_tets_init(&cone->mesh, memory);
    cone->room.memory = *memory;
    if (!iccp_tets_copy(&cone->mesh, mesh) || !iccp_cone_reserve(cone))
        return ICC_ERR_MEMORY;
    memcpy(cone->image, boundary, 3 * cone->n_fixed * sizeof *boundary);
    for (uint32_t t = 0; t < cone->n_left; ++t)
        for (int i = 0; i < 4; ++i)
            if (iccp_cone_is_front(cone, t, i))
                count_faces(cone, t, i, 1);
    return ICC_OK;
}

void iccp_cone_fill(iccp_cone *cone, const double *images)
{
    const size_t n = cone->mesh.points.n;
    memcpy(cone->image, images, 3 * n * sizeof *images);
    memset(cone->n_faces, 0, n * sizeof *cone->n_faces);
    memset(cone->is_placed, 1, cone->mesh.n_tets);
    cone->n_left = 0;
}

icc_status iccp_cone_give(const iccp_cone *cone, iccp_simplices **out, double **images)
{
    const iccp_tets *m = &cone->mesh;
    const size_t n = m->points.n;
    iccp_simplices *mesh = *out = iccp_alloc_zero(&m->memory, 1, sizeof *mesh);
    if (mesh == NULL)
        return ICC_ERR_MEMORY;
    *mesh =
        (iccp_simplices){.memory = m->memory, .dim = 3, .n_points = n, .n_boundary = cone->n_fixed};
    *images = iccp_alloc(&m->memory, n, 3 * sizeof **images);
    mesh->points = iccp_alloc(&m->memory, n, 3 * sizeof *mesh->points);
    mesh->corners = iccp_alloc(&m->memory, m->n_alive, 4 * sizeof *mesh->corners);
    if (*images == NULL || mesh->points == NULL || mesh->corners == NULL)
        return ICC_ERR_MEMORY;
    memcpy(mesh->points, m->points.x, 3 * n * sizeof *mesh->points);
    memcpy(*images, cone->image, 3 * n * sizeof **images);
    for (uint32_t t = 0; t < m->n_tets; ++t)
        if (iccp_tet_alive(m, t))
            memcpy(mesh->corners + 4 * mesh->n_simplices++, m->tet[t].v, sizeof m->tet[t].v);
    return ICC_OK;
}

void iccp_cone_free(iccp_cone *cone)
{
    const iccp_memory *memory = &cone->mesh.memory;
    iccp_free(memory, cone->image);
    iccp_free(memory, cone->n_faces);
    iccp_free(memory, cone->is_placed);
    iccp_halfspaces_free(&cone->room);
    iccp_tets_free(&cone->mesh);
}

/* ---- the front ---- */

int iccp_cone_front_sides(const iccp_cone *cone, uint32_t tet, int side[4])
{
    int n = 0;
    for (int i = 0; i < 4; ++i)
        if (iccp_cone_is_front(cone, tet, i))
            side[n++] = i;
    return n;
}

void iccp_cone_place(iccp_cone *cone, uint32_t tet)
{
    for (int i = 0; i < 4; ++i)
        count_faces(cone, tet, i, iccp_cone_is_front(cone, tet, i) ? UINT32_MAX : 1);
    cone->is_placed[tet] = 1;
    --cone->n_left;
}

void iccp_cone_take_out(iccp_cone *cone, uint32_t tet)
{
    for (int i = 0; i < 4; ++i)
        count_faces(cone, tet, i, iccp_cone_is_front(cone, tet, i) ? 1 : UINT32_MAX);
    cone->is_placed[tet] = 0;
    ++cone->n_left;
}

/* ---- cells: a tetrahedron whose corner `side` is the apex, or none is ---- */

static const double *corner_of(const iccp_cone *cone, uint32_t tet, int side, int k)
{
    return k == side ? cone->apex : iccp_cone_image(cone, cone->mesh.tet[tet].v[k]);
}

static bool is_positive(const iccp_cone *cone, uint32_t tet, int side)
{
    return iccp_orient3d(corner_of(cone, tet, side, 0), corner_of(cone, tet, side, 1),
                         corner_of(cone, tet, side, 2), corner_of(cone, tet, side, 3)) > 0;
}

bool iccp_cone_is_good(const iccp_cone *cone, uint32_t tet)
{
    bool good = is_positive(cone, tet, NO_SIDE);
    for (int i = 0; i < 4 && good; ++i) {
        const uint32_t across = cone->mesh.tet[tet].across[i];
        if (!iccp_is_wall_side(across) && !cone->is_placed[across / 4])
            good = is_positive(cone, across / 4, (int)(across % 4));
    }
    return good;
}

/* A question about a cell at a point. `corner` is the point's place in the cell. */
typedef bool (*cell_question)(iccp_cone *cone, uint32_t tet, int side, int corner);

/* Returns true if the answer is yes for all cells at a point: tetrahedra in place, and cones over
 * faces of the front. */
static bool ask_star(iccp_cone *cone, uint32_t point, cell_question question)
{
    iccp_tets *m = &cone->mesh;
    bool holds = iccp_tets_star(m, point);
    for (size_t s = 0; holds && s < m->star.n; ++s) {
        const uint32_t t = m->star.item[s];
        const int k = iccp_tet_index(&m->tet[t], point);
        if (cone->is_placed[t])
            holds = question(cone, t, NO_SIDE, k);
        for (int i = 0; holds && !cone->is_placed[t] && i < 4; ++i)
            if (i != k && iccp_cone_is_front(cone, t, i))
                holds = question(cone, t, i, k);
    }
    return holds;
}

static bool ask_positive(iccp_cone *cone, uint32_t tet, int side, int corner)
{
    (void)corner;
    return is_positive(cone, tet, side);
}

bool iccp_cone_is_star_good(iccp_cone *cone, uint32_t point)
{
    return ask_star(cone, point, ask_positive);
}

/* Adds the half-space on the point's side of the opposite face. */
static bool add_room(iccp_cone *cone, uint32_t tet, int side, int corner)
{
    const uint8_t *f = iccp_tet_face[corner];
    if (!iccp_halfspaces_reserve(&cone->room, cone->room.n + 1)) {
        cone->mesh.no_memory = true;
        return false;
    }
    return iccp_halfspaces_add(&cone->room, corner_of(cone, tet, side, f[0]),
                               corner_of(cone, tet, side, f[1]), corner_of(cone, tet, side, f[2]));
}

bool iccp_cone_find_room(iccp_cone *cone, uint32_t point)
{
    cone->room.n = 0;
    return ask_star(cone, point, add_room);
}

bool iccp_cone_find_apex_room(iccp_cone *cone)
{
    cone->room.n = 0;
    for (uint32_t t = 0; t < cone->mesh.n_tets; ++t)
        for (int i = 0; iccp_cone_is_left(cone, t) && i < 4; ++i)
            if (iccp_cone_is_front(cone, t, i) && !add_room(cone, t, i, i))
                return false;
    return true;
}

bool iccp_cone_is_apex_good(const iccp_cone *cone)
{
    for (uint32_t t = 0; t < cone->mesh.n_tets; ++t)
        for (int i = 0; iccp_cone_is_left(cone, t) && i < 4; ++i)
            if (iccp_cone_is_front(cone, t, i) && !is_positive(cone, t, i))
                return false;
    return true;
}

void iccp_cone_forget(iccp_cone *cone, uint32_t point)
{
    *iccp_cone_image(cone, point) = NAN;
}

void iccp_cone_put(iccp_cone *cone, uint32_t point, const double image[3])
{
    double *x = iccp_cone_image(cone, point);
    memcpy(x, image, 3 * sizeof *x);
    iccp_simplicial_round(3, x);
}
