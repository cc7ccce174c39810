/* The apex is the centre of the half-spaces on the inner sides of all faces (halfspaces.h). */
#include "map/solid/apex.h"

#include "fill/tets.h"
#include "map/solid/halfspaces.h"
#include "math/predicates.h"
#include "math/vec.h"

/* Newton steps for the apex. */
enum { STEPS = 100 };

typedef struct region {
    const iccp_simplices *mesh;
    const double *boundary;
} region;

/* Finds the corners of the face of a tetrahedron's side. Returns false if it is not on the
 * boundary. */
static bool find_face(const region *r, size_t side, const double *face[3])
{
    const uint32_t *v = r->mesh->corners + 4 * (side / 4);
    if ((r->mesh->across[side] & ICCP_ON_BOUNDARY) == 0)
        return false;
    for (int k = 0; k < 3; ++k)
        face[k] = r->boundary + 3 * (size_t)v[iccp_tet_face[side % 4][k]];
    return true;
}

static void find_centroid(const region *r, double centroid[3])
{
    double volume = 0, sum[3] = {0};
    for (size_t side = 0; side < 4 * r->mesh->n_simplices; ++side) {
        const double *face[3];
        double normal[3];
        if (!find_face(r, side, face))
            continue;
        iccp_vec_cross(face[0], face[1], normal);
        const double six = iccp_vec_dot(3, normal, face[2]);
        volume += six;
        for (int k = 0; k < 3; ++k)
            sum[k] += six * (face[0][k] + face[1][k] + face[2][k]) / 4;
    }
    for (int k = 0; k < 3; ++k)
        centroid[k] = sum[k] / volume;
}

/* Lists the half-spaces on the inner sides of all faces. *bounded is false if a face has almost no
 * area. */
static icc_status find_room(const region *r, iccp_halfspaces *room, bool *bounded)
{
    *bounded = true;
    for (size_t side = 0; *bounded && side < 4 * r->mesh->n_simplices; ++side) {
        const double *face[3];
        if (!find_face(r, side, face))
            continue;
        if (!iccp_halfspaces_reserve(room, room->n + 1))
            return ICC_ERR_MEMORY;
        *bounded = iccp_halfspaces_add(room, face[0], face[1], face[2]);
    }
    return ICC_OK;
}

/* Returns true if a point sees all faces, exactly. */
static bool sees_all(const region *r, const double point[3])
{
    for (size_t side = 0; side < 4 * r->mesh->n_simplices; ++side) {
        const double *face[3];
        if (find_face(r, side, face) && !(iccp_orient3d(face[0], face[1], face[2], point) > 0))
            return false;
    }
    return true;
}

/* The search begins at the centroid. */
icc_status iccp_find_apex(bool *sees, double apex[3], const iccp_simplices *mesh,
                          const double *boundary, const iccp_memory *memory)
{
    const region r = {mesh, boundary};
    iccp_halfspaces room = {.memory = *memory};
    find_centroid(&r, apex);
    const icc_status status = find_room(&r, &room, sees);
    *sees = status == ICC_OK && *sees && iccp_halfspaces_enter(&room, apex);
    if (*sees) {
        iccp_halfspaces_centre(&room, STEPS, apex);
        *sees = sees_all(&r, apex);
    }
    iccp_halfspaces_free(&room);
    return status;
}
