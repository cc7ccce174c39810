/* Checks the image of a mesh of the caller's under a map, and repairs it if asked to.
 *
 * The map of the mesh is one-to-one if two things hold. Every simplex keeps its orientation. The
 * image of the boundary is simple and winds around each point at most once, because this winding
 * number counts the simplices whose images contain the point. The mesh itself must pass the same
 * check (domain/boundary_parts.h). */
#include "map/certify.h"

#include "base/error.h"
#include "domain/boundary_parts.h"
#include "domain/mesh_domain.h"
#include "map/apply.h"
#include "map/energy/mesh_repair.h"
#include "math/orient.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct mesh_check {
    size_t dim, n_vertices, n_simplices;
    const uint32_t *simplices;
    double *before, *after; /* local copies of the vertices and of their images */
    iccp_frame frame;       /* of `after` */
    double *images;         /* as the caller gets them */
    icc_certificate *result;
} mesh_check;

static const uint32_t *corners_of(const mesh_check *m, size_t simplex)
{
    return m->simplices + (m->dim + 1) * simplex;
}

static int orientation(const mesh_check *m, const double *points, size_t simplex)
{
    const uint32_t *v = corners_of(m, simplex);
    const double *corner[ICC_MAX_DIM + 1];
    for (size_t k = 0; k <= m->dim; ++k)
        corner[k] = points + m->dim * v[k];
    return iccp_orient(m->dim, corner);
}

static bool is_finite(size_t dim, const double *point)
{
    for (size_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return false;
    return true;
}

/* Converts points to local coordinates, for exact signs. A point that is not finite becomes 0, and
 * check_simplices() tests no simplex at it. */
static icc_status localise(mesh_check *m, double *local, const double *points, icc_error *err)
{
    const size_t dim = m->dim;
    iccp_frame *frame = &m->frame;
    for (size_t v = 0; v < m->n_vertices; ++v)
        for (size_t k = 0; k < dim; ++k)
            local[dim * v + k] = is_finite(dim, points + dim * v) ? points[dim * v + k] : 0;
    iccp_frame_fit(frame, (int32_t)dim, m->n_vertices, local);
    for (size_t v = 0; v < m->n_vertices; ++v) {
        if (!iccp_frame_holds(frame, (int32_t)dim, local + dim * v))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_VERTEX, (int64_t)v,
                                "vertex %zu has a coordinate too small for exact signs", v);
        iccp_frame_in(frame, (int32_t)dim, local + dim * v, local + dim * v);
    }
    return ICC_OK;
}

/* Counts, by exact signs, simplices that keep no positive volume, and remembers the first at
 * fault. A simplex with a corner without image counts as neither flat nor inverted. */
static void check_simplices(const mesh_check *m)
{
    icc_certificate *c = m->result;
    c->n_no_image = c->n_flat = c->n_inverted = 0;
    for (size_t v = 0; v < m->n_vertices; ++v)
        c->n_no_image += !is_finite(m->dim, m->images + m->dim * v);
    c->first = -1;
    for (size_t s = 0; s < m->n_simplices; ++s) {
        bool fault = false;
        for (size_t k = 0; k <= m->dim; ++k)
            fault |= !is_finite(m->dim, m->images + m->dim * corners_of(m, s)[k]);
        if (!fault) {
            const int before = orientation(m, m->before, s), after = orientation(m, m->after, s);
            c->n_flat += before == 0 || after == 0;
            c->n_inverted += before * after < 0;
            fault = before * after <= 0;
        }
        if (fault && c->first < 0)
            c->first = (int64_t)s;
    }
}

/* ---- repair ---- */

/* Whether there is a fault, and all vertices of the boundary have images. A repair keeps these. */
static bool can_repair(const mesh_check *m, const iccp_simplices *mesh)
{
    for (size_t v = 0; v < mesh->n_boundary; ++v)
        if (!is_finite(m->dim, m->images + m->dim * mesh->given[v]))
            return false;
    return m->result->first >= 0;
}

/* Moves the images of inner vertices until every simplex is positive, or as many as can be. Rounds
 * them to the caller's coordinates, and converts these back, because the check concerns them. */
static icc_status repair(mesh_check *m, const iccp_simplices *mesh, const iccp_env *env)
{
    const size_t dim = m->dim, size = dim * sizeof(double);
    double *images = iccp_alloc(&env->memory, mesh->n_points, size);
    if (images == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < mesh->n_points; ++v) {
        const double *image = m->images + dim * mesh->given[v];
        memcpy(images + dim * v, is_finite(dim, image) ? m->after + dim * mesh->given[v] : image,
               size);
    }
    icc_status status = iccp_mesh_repair(mesh, images, HUGE_VAL, env);
    iccp_mesh_round(mesh, images);
    for (size_t v = mesh->n_boundary; status == ICC_OK && v < mesh->n_points; ++v)
        iccp_frame_out(&m->frame, (int32_t)dim, images + dim * v, m->images + dim * mesh->given[v]);
    iccp_free(&env->memory, images);
    return status == ICC_OK ? localise(m, m->after, m->images, NULL) : status;
}

/* ---- the boundary ---- */

static bool is_about_shape(icc_status status)
{
    return status == ICC_ERR_BOUNDARY || status == ICC_ERR_TOPOLOGY;
}

/* Notes why the mesh is not certified, unless an earlier reason was noted. */
static void give_reason(mesh_check *m, const char *where, const char *why)
{
    char *message = m->result->message;
    if (message[0] == 0)
        (void)snprintf(message, sizeof m->result->message, "%s%.200s", where, why);
}

static void count_reasons(mesh_check *m)
{
    const icc_certificate *c = m->result;
    const char *name = iccp_simplices_name(m->dim);
    char why[160];
    if (c->first < 0)
        return;
    (void)snprintf(why, sizeof why,
                   "images: %zu inverted, %zu flat, and %zu vertices have none; the first %s at "
                   "fault is %lld",
                   c->n_inverted, c->n_flat, c->n_no_image, name, (long long)c->first);
    give_reason(m, "", why);
}

/* Finds the boundary of the mesh, and checks that the mesh does not overlap itself. */
static icc_status check_before(mesh_check *m, iccp_boundary_parts *boundary,
                               const iccp_simplices *mesh, const iccp_env *env)
{
    icc_error own = {.size = sizeof own};
    icc_status status = iccp_boundary_parts_create(boundary, mesh, m->n_vertices, env, &own);
    if (status == ICC_OK)
        status = iccp_boundary_parts_check(boundary, m->before, env, &own);
    if (is_about_shape(status))
        give_reason(m, "the boundary of the mesh: ", own.message);
    return status;
}

static icc_status check_after(mesh_check *m, const iccp_boundary_parts *boundary,
                              const iccp_simplices *mesh, const iccp_env *env)
{
    icc_error own = {.size = sizeof own};
    icc_status status = ICC_OK;
    for (size_t v = 0; status == ICC_OK && v < mesh->n_boundary; ++v)
        if (!is_finite(m->dim, m->images + m->dim * mesh->given[v]))
            status = iccp_fail(&own, ICC_ERR_BOUNDARY, "vertex %lu has none",
                               (unsigned long)mesh->given[v]);
    if (status == ICC_OK)
        status = iccp_boundary_parts_check(boundary, m->after, env, &own);
    if (is_about_shape(status))
        give_reason(m, "the image of the boundary: ", own.message);
    return status;
}

/* Checks the boundary before the map, repairs the images if wanted and possible, and then checks
 * the boundary after the map. */
static icc_status check_joined(mesh_check *m, const iccp_simplices *mesh, bool repaired,
                               const iccp_env *env)
{
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 3, 1}, env);
    iccp_boundary_parts boundary;
    icc_status status = check_before(m, &boundary, mesh, &part[0]);
    if (status == ICC_OK && repaired && can_repair(m, mesh)) {
        status = repair(m, mesh, &part[1]);
        check_simplices(m);
    }
    if (status == ICC_OK)
        status = check_after(m, &boundary, mesh, &part[2]);
    count_reasons(m);
    iccp_boundary_parts_free(&boundary);
    return status;
}

static icc_status check_mesh(mesh_check *m, bool repaired, const double *vertices,
                             const iccp_env *env)
{
    icc_error own = {.size = sizeof own};
    iccp_simplices *mesh;
    iccp_frame frame;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    check_simplices(m);
    icc_status status = iccp_mesh_read(&mesh, &frame, m->dim, m->n_vertices, vertices,
                                       m->n_simplices, m->simplices, 0, NULL, &part[0], &own);
    if (is_about_shape(status))
        give_reason(m, "", own.message);
    if (status == ICC_OK)
        status = check_joined(m, mesh, repaired, &part[1]);
    iccp_simplices_free(mesh);
    m->result->boundary_simple = status == ICC_OK;
    m->result->certified = status == ICC_OK && m->result->first < 0;
    return is_about_shape(status) ? ICC_OK : status;
}

icc_status iccp_map_certify(const icc_map *map, size_t n_vertices, const double *vertices,
                            size_t n_simplices, const uint32_t *simplices, bool repaired,
                            double *images, icc_certificate *certificate, const iccp_env *env,
                            icc_error *err)
{
    mesh_check m = {.dim = (size_t)map->source_domain->dim,
                    .n_vertices = n_vertices,
                    .n_simplices = n_simplices,
                    .simplices = simplices,
                    .images = images,
                    .result = certificate};
    m.before = iccp_alloc(&env->memory, n_vertices, m.dim * sizeof(double));
    m.after = iccp_alloc(&env->memory, n_vertices, m.dim * sizeof(double));
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = m.before != NULL && m.after != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_map_apply(map, false, n_vertices, vertices, images, NULL, NULL, &part[0]);
    if (status == ICC_OK)
        status = localise(&m, m.before, vertices, err);
    if (status == ICC_OK)
        status = localise(&m, m.after, images, err);
    if (status == ICC_OK)
        status = check_mesh(&m, repaired, vertices, &part[1]);
    iccp_free(&env->memory, m.before);
    iccp_free(&env->memory, m.after);
    return iccp_explain(err, status);
}
