/* Triangulates a polygon. mesh/delaunay.c makes the Delaunay triangulation of all points, and
 * mesh/constrain.c forces the edges of the polygon into it. This file then removes the triangles
 * outside. */
#include "mesh/triangulate.h"

#include "base/error.h"
#include "mesh/constrain.h"
#include "mesh/delaunay.h"

#include <assert.h>

/* Marks a triangle outside. */
static const uint32_t OUTSIDE = UINT32_MAX;

/* Whether a corner faces a wall. Edges at the ghost are none. */
static bool faces_wall(const iccp_trimesh *mesh, uint32_t corner)
{
    const uint32_t a = mesh->corners[iccp_after(corner)].vertex;
    const uint32_t b = mesh->corners[iccp_before(corner)].vertex;
    return a < mesh->n_points && b < mesh->n_points && iccp_is_wall(mesh, a, b);
}

/* Sets number[t] to OUTSIDE or to 0. It begins outside, with a ghost. If the walls are one polygon,
 * it does not cross them: what it does not reach is inside. Otherwise each wall leads from outside
 * to inside or back. `stack` has room for every triangle. Returns ICC_ERR_TOPOLOGY if several
 * polygons do not separate inside from outside. */
static icc_status mark_outside(const iccp_trimesh *mesh, bool is_one, uint32_t *number,
                               uint32_t *stack)
{
    const iccp_corner *const c = mesh->corners;
    const uint32_t unseen = is_one ? 0 : OUTSIDE - 1;
    icc_status status = ICC_OK;
    uint32_t seed = 0, n = 0;
    for (uint32_t t = 0; t < mesh->n_triangles; ++t)
        number[t] = unseen;
    while (c[seed].vertex != mesh->n_points)
        ++seed;
    stack[n++] = seed / 3;
    number[seed / 3] = OUTSIDE;
    while (n > 0) {
        const uint32_t triangle = stack[--n];
        for (uint32_t corner = 3 * triangle; corner < 3 * triangle + 3; ++corner) {
            const uint32_t other = c[corner].twin / 3;
            if (is_one && (number[other] == OUTSIDE || faces_wall(mesh, corner)))
                continue;
            const bool is_outside =
                is_one || (number[triangle] == OUTSIDE) != faces_wall(mesh, corner);
            const uint32_t mark = is_outside ? OUTSIDE : 0;
            if (number[other] == unseen)
                stack[n++] = other;
            else if (number[other] != mark)
                status = ICC_ERR_TOPOLOGY;
            number[other] = mark;
        }
    }
    return status;
}

/* Returns the first point that is neither a vertex of the polygon nor inside, or n_points. */
static uint32_t find_outsider(const iccp_trimesh *mesh, const uint32_t *number)
{
    uint32_t first = mesh->n_points;
    for (uint32_t corner = 0; corner < 3 * mesh->n_triangles; ++corner) {
        const uint32_t vertex = mesh->corners[corner].vertex;
        if (number[corner / 3] == OUTSIDE && vertex >= mesh->n_boundary && vertex < first)
            first = vertex;
    }
    return first;
}

/* Numbers the triangles inside and returns their number. */
static uint32_t number_inside(const iccp_trimesh *mesh, uint32_t *number)
{
    uint32_t n = 0;
    for (uint32_t t = 0; t < mesh->n_triangles; ++t)
        if (number[t] != OUTSIDE)
            number[t] = n++;
    return n;
}

static void copy_out(const iccp_trimesh *mesh, const uint32_t *number, uint32_t *triangles,
                     uint32_t *neighbours)
{
    const iccp_corner *const c = mesh->corners;
    for (uint32_t corner = 0; corner < 3 * mesh->n_triangles; ++corner) {
        if (number[corner / 3] == OUTSIDE)
            continue;
        *triangles++ = c[corner].vertex;
        if (neighbours == NULL)
            continue;
        const uint32_t other = number[c[corner].twin / 3];
        *neighbours++ = other == OUTSIDE ? ICCP_NO_NEIGHBOUR : 3 * other + c[corner].twin % 3;
    }
}

/* Copies the triangles inside. */
static icc_status extract(const iccp_trimesh *mesh, uint32_t *triangles, uint32_t *neighbours,
                          const iccp_env *env, icc_error *err)
{
    const size_t n = mesh->n_triangles;
    uint32_t *number = iccp_alloc(&env->memory, n, sizeof *number);
    uint32_t *stack = iccp_alloc(&env->memory, n, sizeof *stack);
    icc_status status = ICC_OK;
    if (number == NULL || stack == NULL) {
        status = iccp_fail_memory(err);
        goto done;
    }
    (void)mark_outside(mesh, true, number, stack);
    const uint32_t outsider = find_outsider(mesh, number);
    if (outsider < mesh->n_points) {
        status = iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, outsider,
                              "point %lu lies outside the polygon", (unsigned long)outsider);
        goto done;
    }
    const uint32_t n_inside = number_inside(mesh, number);
    assert(n_inside == 2 * mesh->n_points - mesh->n_boundary - 2);
    (void)n_inside;
    copy_out(mesh, number, triangles, neighbours);
done:
    iccp_free(&env->memory, stack);
    iccp_free(&env->memory, number);
    return status;
}

/* Makes a Delaunay triangulation of all points, forces the polygon's edges into it, and drops the
 * triangles outside. */
icc_status iccp_triangulate_mesh(size_t n_boundary, size_t n_points, const double *points,
                                 uint32_t *triangles, uint32_t *neighbours, const iccp_env *env,
                                 icc_error *err)
{
    assert(n_boundary >= 3 && n_boundary <= n_points && n_points <= ICCP_TRIMESH_MAX_POINTS);
    iccp_trimesh mesh = {
        .points = points, .n_points = (uint32_t)n_points, .n_boundary = (uint32_t)n_boundary};
    mesh.corners = iccp_alloc(&env->memory, 2 * n_points - 2, 3 * sizeof *mesh.corners);
    if (mesh.corners == NULL)
        return iccp_fail_memory(err);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){3, 1}, env);
    icc_status status = iccp_delaunay(&mesh, &part[0], err);
    if (status == ICC_OK)
        status = iccp_constrain(&mesh, &part[1], err);
    if (status == ICC_OK)
        status = extract(&mesh, triangles, neighbours, env, err);
    iccp_free(&env->memory, mesh.corners);
    return status;
}

icc_status iccp_triangulate_walls(size_t n_points, const double *points, const iccp_walls *walls,
                                  const iccp_walls *bounds, uint32_t *triangles,
                                  uint32_t *neighbours, size_t *n_triangles, const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t room = 2 * n_points - 2;
    iccp_trimesh mesh = {.points = points, .n_points = (uint32_t)n_points, .walls = walls};
    uint32_t *number = iccp_alloc(memory, room, sizeof *number);
    uint32_t *stack = iccp_alloc(memory, room, sizeof *stack);
    mesh.corners = iccp_alloc(memory, room, 3 * sizeof *mesh.corners);
    icc_status status = ICC_ERR_MEMORY;
    if (number != NULL && stack != NULL && mesh.corners != NULL)
        status = iccp_delaunay(&mesh, env, NULL);
    if (status == ICC_OK)
        status = iccp_constrain(&mesh, env, NULL);
    mesh.walls = bounds;
    if (status == ICC_OK)
        status = mark_outside(&mesh, false, number, stack);
    if (status == ICC_OK) {
        *n_triangles = number_inside(&mesh, number);
        copy_out(&mesh, number, triangles, neighbours);
    }
    iccp_free(memory, mesh.corners);
    iccp_free(memory, stack);
    iccp_free(memory, number);
    return status;
}

icc_status iccp_triangulate(size_t n_boundary, size_t n_points, const double *points,
                            uint32_t *triangles, const iccp_env *env, icc_error *err)
{
    return iccp_triangulate_mesh(n_boundary, n_points, points, triangles, NULL, env, err);
}
