/* Delaunay triangulation. Based on: C. L. Lawson, Software for C1 surface interpolation, 1977.
 * Points are inserted one by one. Each is located by walking and followed by the flips that restore
 * the Delaunay property. mesh/insertion_order.c gives the order of insertion.
 *
 * A point on an edge needs no special case. It leaves a triangle without area, which lies inside
 * the circle on the other side and is flipped at once. Nor does a point outside the hull: the
 * circle of a ghost triangle is the open half-plane beyond its edge of the hull, together with that
 * edge. */
#include "mesh/delaunay.h"

#include "base/error.h"
#include "math/predicates.h"
#include "mesh/insertion_order.h"

#include <assert.h>

/* Returns true if p lies between a and b. It is on their line and equal to neither. */
static bool between(const double a[2], const double b[2], const double p[2])
{
    const int axis = a[0] < b[0] || a[0] > b[0] ? 0 : 1;
    return (a[axis] < p[axis]) == (p[axis] < b[axis]);
}

/* Returns true if the circle of a triangle contains p. One of its corners may be the ghost. */
static bool circle_contains(const iccp_trimesh *mesh, uint32_t corner, const double p[2])
{
    const uint32_t ghost = mesh->n_points;
    uint32_t a = mesh->corners[corner].vertex;
    uint32_t b = mesh->corners[iccp_after(corner)].vertex;
    uint32_t c = mesh->corners[iccp_before(corner)].vertex;
    if (ICCP_LIKELY(a != ghost && b != ghost && c != ghost))
        return iccp_incircle(iccp_point(mesh, a), iccp_point(mesh, b), iccp_point(mesh, c), p) > 0;
    while (c != ghost) {
        const uint32_t first = a;
        a = b;
        b = c;
        c = first;
    }
    const double *from = iccp_point(mesh, a), *to = iccp_point(mesh, b);
    const int side = iccp_orient2d(from, to, p);
    return side > 0 || (side == 0 && between(from, to, p));
}

/* Returns true if p lies strictly beyond the half-edge that the corner faces. */
static bool beyond(const iccp_trimesh *mesh, uint32_t corner, const double p[2])
{
    const double *from = iccp_point(mesh, mesh->corners[iccp_after(corner)].vertex);
    const double *to = iccp_point(mesh, mesh->corners[iccp_before(corner)].vertex);
    return iccp_orient2d(from, to, p) < 0;
}

/* Walks from a triangle without the ghost to a corner of a triangle that contains p. In a Delaunay
 * triangulation such a walk never returns to a triangle, whichever of two edges it takes. */
static uint32_t locate(const iccp_trimesh *mesh, uint32_t corner, const double p[2])
{
    if (beyond(mesh, corner, p))
        corner = mesh->corners[corner].twin;
    while (mesh->corners[corner].vertex != mesh->n_points) {
        if (beyond(mesh, iccp_after(corner), p))
            corner = mesh->corners[iccp_after(corner)].twin;
        else if (beyond(mesh, iccp_before(corner), p))
            corner = mesh->corners[iccp_before(corner)].twin;
        else
            break;
    }
    return corner;
}

/* Joins a new vertex to the corners of a triangle. Returns its corner in one of the three new
 * triangles. */
static uint32_t split(iccp_trimesh *mesh, uint32_t corner, uint32_t vertex)
{
    iccp_corner *const c = mesh->corners;
    const uint32_t first = corner - corner % 3;
    const uint32_t fresh = 3 * mesh->n_triangles;
    const uint32_t corners[3] = {first, fresh, fresh + 3};
    const uint32_t old[3] = {c[first].vertex, c[first + 1].vertex, c[first + 2].vertex};
    const uint32_t outer[3] = {c[first].twin, c[first + 1].twin, c[first + 2].twin};
    mesh->n_triangles += 2;
    for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t k = corners[i];
        c[k].vertex = vertex;
        c[k + 1].vertex = old[(i + 1) % 3];
        c[k + 2].vertex = old[(i + 2) % 3];
        iccp_link_twins(mesh, k, outer[i]);
        iccp_link_twins(mesh, k + 1, corners[(i + 1) % 3] + 2);
    }
    return first;
}

/* Returns a corner of the same vertex in a triangle without the ghost. */
static uint32_t leave_ghosts(const iccp_trimesh *mesh, uint32_t corner)
{
    while (mesh->corners[iccp_after(corner)].vertex == mesh->n_points ||
           mesh->corners[iccp_before(corner)].vertex == mesh->n_points)
        corner = iccp_around(mesh, corner);
    return corner;
}

/* Goes once around a new vertex and flips the edges that it faces while they are not Delaunay. */
static void legalise(iccp_trimesh *mesh, uint32_t corner)
{
    const double *p = iccp_point(mesh, mesh->corners[corner].vertex);
    const uint32_t last = mesh->corners[iccp_after(corner)].vertex;
    for (;;) {
        if (circle_contains(mesh, mesh->corners[corner].twin, p))
            iccp_flip(mesh, corner);
        else if (mesh->corners[iccp_before(corner)].vertex != last)
            corner = iccp_around(mesh, corner);
        else
            return;
    }
}

static bool equal(const double a[2], const double b[2])
{
    return !(a[0] < b[0] || a[0] > b[0] || a[1] < b[1] || a[1] > b[1]);
}

/* Returns the corner of the triangle at which the point lies, or the number of corners if there is
 * none. */
static uint32_t equal_corner(const iccp_trimesh *mesh, uint32_t corner, const double p[2])
{
    for (int k = 0; k < 3; ++k, corner = iccp_after(corner)) {
        const uint32_t vertex = mesh->corners[corner].vertex;
        if (vertex != mesh->n_points && equal(iccp_point(mesh, vertex), p))
            return corner;
    }
    return 3 * mesh->n_triangles;
}

/* Makes the triangle of the first three points, and the ghost triangles around it. */
static void start(iccp_trimesh *mesh)
{
    iccp_corner *const c = mesh->corners;
    mesh->n_triangles = 4;
    for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t ghost = 3 + 3 * i;
        c[i].vertex = i;
        c[ghost].vertex = mesh->n_points;
        c[ghost + 1].vertex = (i + 2) % 3;
        c[ghost + 2].vertex = (i + 1) % 3;
        iccp_link_twins(mesh, i, ghost);
        iccp_link_twins(mesh, ghost + 2, 3 + 3 * ((i + 1) % 3) + 1);
    }
}

/* Reports equal points. */
static icc_status fail_repeated(uint32_t n_boundary, uint32_t a, uint32_t b, icc_error *err)
{
    const uint32_t point = a > b ? a : b, other = a > b ? b : a;
    if (point < n_boundary)
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_POINT, point,
                            "vertex %lu repeats vertex %lu", (unsigned long)point,
                            (unsigned long)other);
    if (other < n_boundary)
        return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, point,
                            "point %lu is not inside the polygon: it repeats vertex %lu",
                            (unsigned long)point, (unsigned long)other);
    return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, point, "point %lu repeats point %lu",
                        (unsigned long)point, (unsigned long)other);
}

/* Inserts the points in the order of their indices. `order` has the caller's indices. */
static icc_status insert_all(iccp_trimesh *mesh, const uint32_t *order, const iccp_env *env,
                             icc_error *err)
{
    enum { REPORT = 4096 };
    uint32_t corner = 0;
    for (uint32_t i = 3; i < mesh->n_points; ++i) {
        if (i % REPORT == 0 &&
            iccp_progress(env, "mesh", (double)i / (double)mesh->n_points) != ICC_OK)
            return ICC_ERR_CANCELLED;
        const double *p = iccp_point(mesh, i);
        corner = locate(mesh, corner, p);
        const uint32_t same = equal_corner(mesh, corner, p);
        if (same < 3 * mesh->n_triangles)
            return fail_repeated(mesh->n_boundary, order[i], order[mesh->corners[same].vertex],
                                 err);
        corner = split(mesh, corner, i);
        legalise(mesh, corner);
        corner = leave_ghosts(mesh, corner);
    }
    return ICC_OK;
}

static void swap(uint32_t *a, uint32_t *b)
{
    const uint32_t first = *a;
    *a = *b;
    *b = first;
}

/* Moves a third point to the front, so that the first three form a counter-clockwise triangle. */
static icc_status pick_start(uint32_t *order, const iccp_trimesh *mesh, icc_error *err)
{
    const double *a = iccp_point(mesh, order[0]), *b = iccp_point(mesh, order[1]);
    if (equal(a, b))
        return fail_repeated(mesh->n_boundary, order[0], order[1], err);
    for (uint32_t i = 2; i < mesh->n_points; ++i) {
        const int side = iccp_orient2d(a, b, iccp_point(mesh, order[i]));
        if (side == 0)
            continue;
        swap(&order[2], &order[i]);
        if (side < 0)
            swap(&order[0], &order[1]);
        return ICC_OK;
    }
    return iccp_fail(err, ICC_ERR_BOUNDARY, "all vertices of the polygon lie on one line");
}

/* Builds the triangulation on a copy of the points in the order of insertion, because neighbours
 * are then close in memory. Afterwards restores the vertices' own numbers. */
static icc_status build(iccp_trimesh *mesh, const uint32_t *order, const iccp_env *env,
                        icc_error *err)
{
    const double *const points = mesh->points;
    double *copy = iccp_alloc(&env->memory, mesh->n_points, 2 * sizeof *copy);
    if (copy == NULL)
        return iccp_fail_memory(err);
    for (size_t i = 0; i < mesh->n_points; ++i) {
        copy[2 * i] = points[2 * (size_t)order[i]];
        copy[2 * i + 1] = points[2 * (size_t)order[i] + 1];
    }
    mesh->points = copy;
    start(mesh);
    const icc_status status = insert_all(mesh, order, env, err);
    mesh->points = points;
    iccp_free(&env->memory, copy);
    for (uint32_t corner = 0; corner < 3 * mesh->n_triangles; ++corner) {
        uint32_t *const vertex = &mesh->corners[corner].vertex;
        if (*vertex != mesh->n_points)
            *vertex = order[*vertex];
    }
    return status;
}

icc_status iccp_delaunay(iccp_trimesh *mesh, const iccp_env *env, icc_error *err)
{
    assert(mesh->n_points >= 3 && mesh->n_points <= ICCP_TRIMESH_MAX_POINTS);
    uint32_t *order = iccp_alloc(&env->memory, mesh->n_points, sizeof *order);
    icc_status status = ICC_ERR_MEMORY;
    if (order != NULL)
        status = iccp_insertion_order(order, mesh->n_points, 2, mesh->points, &env->memory);
    if (status != ICC_OK)
        iccp_fail_memory(err);
    else
        status = pick_start(order, mesh, err);
    if (status == ICC_OK)
        status = build(mesh, order, env, err);
    iccp_free(&env->memory, order);
    return status;
}
