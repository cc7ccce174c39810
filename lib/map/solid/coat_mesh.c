/* Moves images one by one. Each stays in the polyhedron of points from which all tetrahedra at it
 * are positive: map/solid/halfspaces.h. Every question about a tetrahedron is answered by exact
 * predicates. */
#include "map/solid/coat_mesh.h"

#include "map/energy/simplicial_map.h"
#include "math/predicates.h"

#include <string.h>

static bool reserve(iccp_coat_mesh *mesh)
{
    iccp_tets *m = &mesh->tets;
    if (m->points.room <= mesh->room)
        return true;
    if (!iccp_enlarge(&m->memory, &mesh->image, mesh->room, m->points.room,
                      3 * sizeof *mesh->image)) {
        m->no_memory = true;
        return false;
    }
    mesh->room = m->points.room;
    return true;
}

icc_status iccp_coat_mesh_create(iccp_coat_mesh *mesh, const iccp_simplices *from,
                                 const double *images, const iccp_memory *memory)
{
    *mesh = (iccp_coat_mesh){.n_fixed = from->n_boundary, .halfspaces.memory = *memory};
    iccp_tets_init(&mesh->tets, memory);
    if (!iccp_tets_copy(&mesh->tets, from) || !reserve(mesh))
        return ICC_ERR_MEMORY;
    memcpy(mesh->image, images, 3 * from->n_points * sizeof *images);
    return ICC_OK;
}

void iccp_coat_mesh_free(iccp_coat_mesh *mesh)
{
    iccp_free(&mesh->tets.memory, mesh->image);
    iccp_halfspaces_free(&mesh->halfspaces);
    iccp_tets_free(&mesh->tets);
}

icc_status iccp_coat_mesh_give(const iccp_coat_mesh *mesh, iccp_simplices **out, double **images)
{
    const iccp_tets *m = &mesh->tets;
    const size_t n = m->points.n;
    iccp_simplices *given = *out = iccp_alloc_zero(&m->memory, 1, sizeof *given);
    if (given == NULL)
        return ICC_ERR_MEMORY;
    *given =
        (iccp_simplices){.memory = m->memory, .dim = 3, .n_points = n, .n_boundary = mesh->n_fixed};
    *images = iccp_alloc(&m->memory, n, 3 * sizeof **images);
    given->points = iccp_alloc(&m->memory, n, 3 * sizeof *given->points);
    given->corners = iccp_alloc(&m->memory, m->n_alive, 4 * sizeof *given->corners);
    if (*images == NULL || given->points == NULL || given->corners == NULL)
        return ICC_ERR_MEMORY;
    memcpy(given->points, m->points.x, 3 * n * sizeof *given->points);
    memcpy(*images, mesh->image, 3 * n * sizeof **images);
    for (uint32_t t = 0; t < m->n_tets; ++t)
        if (iccp_tet_alive(m, t))
            memcpy(given->corners + 4 * given->n_simplices++, m->tet[t].v, sizeof m->tet[t].v);
    return ICC_OK;
}

void iccp_coat_put(iccp_coat_mesh *mesh, uint32_t point, const double image[3])
{
    double *x = iccp_coat_image(mesh, point);
    memcpy(x, image, 3 * sizeof *x);
    iccp_simplicial_round(3, x);
}

/* ---- cutting an edge ---- */

/* Replaces the tetrahedra in the ring of an edge by the two halves of each. */
static bool halve(iccp_coat_mesh *mesh, uint32_t a, uint32_t b, uint32_t point)
{
    iccp_tets *m = &mesh->tets;
    const uint32_t ends[2] = {a, b};
    for (size_t t = 0; t < m->ring.n; ++t)
        for (int k = 0; k < 2; ++k) {
            const iccp_tet *tet = &m->tet[m->ring.item[t]];
            uint32_t *half = m->cavity.item + m->cavity.n;
            memcpy(half, tet->v, sizeof tet->v);
            half[iccp_tet_index(tet, ends[k])] = point;
            m->cavity.n += 4;
        }
    return iccp_tets_reserve(m, m->cavity.n / 4) && reserve(mesh) &&
           iccp_tets_replace(m, m->ring.n, m->ring.item, m->cavity.n / 4, m->cavity.item);
}

bool iccp_coat_cut(iccp_coat_mesh *mesh, uint32_t a, uint32_t b, uint32_t *point)
{
    iccp_tets *m = &mesh->tets;
    const uint32_t first = iccp_tets_towards(m, a, b);
    double x[3], y[3];
    m->cavity.n = 0;
    if (first == ICCP_NO_TET || !iccp_tets_ring(m, a, b, first, SIZE_MAX) ||
        !iccp_list_reserve(m, &m->cavity, 8 * m->ring.n))
        return false;
    for (int i = 0; i < 3; ++i)
        x[i] = 0.5 * (iccp_point(&m->points, a)[i] + iccp_point(&m->points, b)[i]);
    *point = iccp_tets_add_point(m, x);
    if (*point == ICCP_NO_TET)
        return false;
    if (!halve(mesh, a, b, *point)) {
        iccp_tets_drop_point(m);
        return false;
    }
    for (int i = 0; i < 3; ++i)
        y[i] = 0.5 * iccp_coat_image(mesh, a)[i] + 0.5 * iccp_coat_image(mesh, b)[i];
    iccp_coat_put(mesh, *point, y);
    return true;
}

/* ---- moving images ---- */

static const double *image_of(const iccp_coat_mesh *mesh, uint32_t tet, int corner)
{
    return iccp_coat_image(mesh, mesh->tets.tet[tet].v[corner]);
}

bool iccp_coat_is_star_good(iccp_coat_mesh *mesh, uint32_t point)
{
    iccp_tets *m = &mesh->tets;
    bool good = iccp_tets_star(m, point);
    for (size_t s = 0; good && s < m->star.n; ++s) {
        const uint32_t t = m->star.item[s];
        good = iccp_orient3d(image_of(mesh, t, 0), image_of(mesh, t, 1), image_of(mesh, t, 2),
                             image_of(mesh, t, 3)) > 0;
    }
    return good;
}

/* Lists the half-spaces on a point's side of the opposite faces. Returns false if a face has almost
 * no area, or no memory is left. */
static bool find_room(iccp_coat_mesh *mesh, uint32_t point)
{
    iccp_tets *m = &mesh->tets;
    iccp_halfspaces *h = &mesh->halfspaces;
    h->n = 0;
    if (!iccp_tets_star(m, point))
        return false;
    if (!iccp_halfspaces_reserve(h, m->star.n)) {
        m->no_memory = true;
        return false;
    }
    for (size_t s = 0; s < m->star.n; ++s) {
        const uint32_t t = m->star.item[s];
        const uint8_t *f = iccp_tet_face[iccp_tet_index(&m->tet[t], point)];
        if (!iccp_halfspaces_add(h, image_of(mesh, t, f[0]), image_of(mesh, t, f[1]),
                                 image_of(mesh, t, f[2])))
            return false;
    }
    return true;
}

static void smooth(iccp_coat_mesh *mesh, uint32_t point)
{
    double x[3], old[3];
    if (!find_room(mesh, point))
        return;
    memcpy(old, iccp_coat_image(mesh, point), sizeof old);
    memcpy(x, old, sizeof x);
    iccp_halfspaces_centre(&mesh->halfspaces, 1, x);
    iccp_coat_put(mesh, point, x);
    if (!iccp_coat_is_star_good(mesh, point))
        iccp_coat_put(mesh, point, old);
}

void iccp_coat_smooth(iccp_coat_mesh *mesh)
{
    for (size_t v = mesh->n_fixed; v < mesh->tets.points.n; ++v)
        smooth(mesh, (uint32_t)v);
}
