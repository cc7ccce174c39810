/* Makes the mesh that an elastic fit moves: the caller's own, or one that fills a domain and has
 * the told points among its vertices. */
#include "fit/elastic_shape.h"

#include "base/error.h"
#include "base/sort.h"
#include "fit/elastic/pin_mesh.h"
#include "geometry/segment.h"
#include "math/predicates.h"
#include "mesh/given_triangles.h"

#include <math.h>
#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* A boundary counts as straight at a vertex if its two edges turn by less than this, in radians. */
static const double STRAIGHT = 1e-9;

/* ---- the object ---- */

iccp_elastic_shape *iccp_elastic_shape_retain(iccp_elastic_shape *shape)
{
    (void)atomic_fetch_add(&shape->references, 1);
    return shape;
}

void iccp_elastic_shape_release(iccp_elastic_shape *s)
{
    if (s == NULL || atomic_fetch_sub(&s->references, 1) > 1)
        return;
    const iccp_memory memory = s->memory;
    iccp_free(&memory, s->given);
    iccp_free(&memory, s->points);
    iccp_free(&memory, s->triangles);
    iccp_free(&memory, s->factor);
    iccp_free(&memory, s->ends);
    iccp_free(&memory, s->share);
    iccp_free(&memory, s->hold);
    iccp_free(&memory, s->item);
    iccp_free(&memory, s->inner);
    iccp_free(&memory, s->direction);
    iccp_elastic_free(s->elastic);
    iccp_free(&memory, s);
}

static icc_status make_room(iccp_elastic_shape *s, size_t n_points, size_t n_triangles,
                            size_t n_more)
{
    const iccp_memory *memory = &s->memory;
    s->n_points = n_points;
    s->n_triangles = n_triangles;
    s->n_more = n_more;
    s->given = iccp_alloc(memory, n_points, 2 * sizeof *s->given);
    s->points = iccp_alloc(memory, n_points, 2 * sizeof *s->points);
    s->triangles = iccp_alloc(memory, n_triangles + n_more, 3 * sizeof *s->triangles);
    s->hold = iccp_alloc_zero(memory, n_points, sizeof *s->hold);
    s->item = iccp_alloc(memory, n_points, sizeof *s->item);
    s->inner = iccp_alloc(memory, n_points, sizeof *s->inner);
    s->direction = iccp_alloc_zero(memory, n_points, 2 * sizeof *s->direction);
    if (s->given == NULL || s->points == NULL || s->triangles == NULL || s->hold == NULL ||
        s->item == NULL || s->inner == NULL || s->direction == NULL)
        return ICC_ERR_MEMORY;
    memset(s->item, 0xff, n_points * sizeof *s->item);
    return ICC_OK;
}

/* ---- the caller's mesh ---- */

static icc_status copy_vertices(iccp_elastic_shape *s, const icc_mesh *mesh, icc_error *err)
{
    const size_t n = mesh->n_vertices;
    for (size_t v = 0; v < n; ++v)
        if (!isfinite(mesh->vertices[2 * v]) || !isfinite(mesh->vertices[2 * v + 1]))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_VERTEX, (int64_t)v,
                                "vertex %zu of the mesh is not finite", v);
    memcpy(s->given, mesh->vertices, 2 * n * sizeof *s->given);
    iccp_frame_fit(&s->frame, 2, n, s->given);
    return iccp_frame_in_all(&s->frame, n, s->given, s->points)
               ? ICC_OK
               : iccp_fail(err, ICC_ERR_ARGUMENT,
                           "a coordinate of the mesh is too small beside the others");
}

/* Copies a triangle of a cell, counter-clockwise. *turn is 0 before the first one of the cell, and
 * then 1 or -1: all of them must turn alike. */
static icc_status copy_triangle(iccp_elastic_shape *s, size_t t, const uint32_t corners[3],
                                size_t cell, int *turn, icc_error *err)
{
    uint32_t *to = s->triangles + 3 * t;
    memcpy(to, corners, 3 * sizeof *to);
    const int sign = iccp_orient2d(s->points + 2 * (size_t)to[0], s->points + 2 * (size_t)to[1],
                                   s->points + 2 * (size_t)to[2]);
    if (sign == 0 || sign * *turn < 0)
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)cell,
                            sign == 0 ? "cell %zu has no area, or none at a corner"
                                      : "cell %zu is a quadrilateral that is not convex",
                            cell);
    if (sign < 0) {
        to[1] = corners[2];
        to[2] = corners[1];
    }
    *turn = sign;
    return ICC_OK;
}

static const uint32_t *cell_of(const icc_mesh *mesh, size_t cell, size_t *n)
{
    const size_t begin = mesh->offsets != NULL ? mesh->offsets[cell] : 3 * cell;
    *n = mesh->offsets != NULL ? mesh->offsets[cell + 1] - begin : 3;
    return mesh->cells + begin;
}

/* Copies a cell, which becomes triangles from *t on. A quadrilateral also becomes the two
 * triangles from *more on, and all four weigh half. */
static icc_status copy_cell(iccp_elastic_shape *s, const icc_mesh *mesh, size_t cell, size_t *t,
                            size_t *more, double stiffness, icc_error *err)
{
    size_t n;
    int turn = 0;
    const uint32_t *v = cell_of(mesh, cell, &n);
    for (size_t k = 0; k < n; ++k)
        if (v[k] >= mesh->n_vertices)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)cell,
                                "cell %zu has vertex %lu; there are %zu", cell, (unsigned long)v[k],
                                mesh->n_vertices);
    icc_status status = ICC_OK;
    for (size_t k = 0; status == ICC_OK && k < (n == 4 ? 4 : 1); ++k) {
        const uint32_t corners[3] = {v[k], v[(k + 1) % n], v[(k + 2) % n]};
        const size_t at = k % 2 == 0 ? (*t)++ : (*more)++;
        status = copy_triangle(s, at, corners, cell, &turn, err);
        if (s->factor != NULL)
            s->factor[at] = n == 4 ? stiffness / 2 : stiffness;
    }
    return status;
}

static icc_status shape_of_mesh(iccp_elastic_shape *s, const icc_mesh *mesh,
                                const double *stiffness, const iccp_env *env, icc_error *err)
{
    size_t n_quads = 0, t = 0, n;
    for (size_t cell = 0; cell < mesh->n_cells; ++cell) {
        (void)cell_of(mesh, cell, &n);
        n_quads += n == 4;
    }
    icc_status status = make_room(s, mesh->n_vertices, mesh->n_cells + n_quads, 2 * n_quads);
    size_t more = s->n_triangles;
    s->n_vertices = mesh->n_vertices;
    if (status == ICC_OK && (n_quads > 0 || stiffness != NULL)) {
        s->factor = iccp_alloc(&s->memory, s->n_triangles + s->n_more, sizeof *s->factor);
        status = s->factor != NULL ? ICC_OK : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK)
        status = copy_vertices(s, mesh, err);
    for (size_t cell = 0; status == ICC_OK && cell < mesh->n_cells; ++cell)
        status = copy_cell(s, mesh, cell, &t, &more, stiffness != NULL ? stiffness[cell] : 1, err);
    if (status == ICC_OK)
        status = iccp_check_used(mesh->n_vertices, s->n_triangles, s->triangles, env, err);
    return iccp_fail_side(err, status, status == ICC_OK || status == ICC_ERR_MEMORY ? 0 : 1);
}

/* ---- where the told points are in the caller's mesh ---- */

static bool comes_before(const void *context, uint32_t a, uint32_t b)
{
    const double *points = context, *p = points + 2 * (size_t)a, *q = points + 2 * (size_t)b;
    return p[0] < q[0] || (!(p[0] > q[0]) && p[1] < q[1]);
}

/* Finds the vertex at a point among sorted ones. */
static uint32_t find_vertex(const double *points, const uint32_t *sorted, size_t n,
                            const double *point)
{
    size_t low = 0, high = n;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        const double *p = points + 2 * (size_t)sorted[middle];
        if (p[0] < point[0] || (!(p[0] > point[0]) && p[1] < point[1]))
            low = middle + 1;
        else
            high = middle;
    }
    const double *p = low < n ? points + 2 * (size_t)sorted[low] : NULL;
    const bool is_there =
        p != NULL && !(p[0] > point[0]) && !(p[1] < point[1]) && !(p[1] > point[1]);
    return is_there ? sorted[low] : NONE;
}

static icc_status find_in_mesh(const iccp_elastic_shape *s, iccp_told *told, const iccp_env *env,
                               icc_error *err)
{
    const size_t n = s->n_points;
    uint32_t *sorted = iccp_alloc(&env->memory, n, sizeof *sorted);
    uint32_t *work = iccp_alloc(&env->memory, n, sizeof *work);
    icc_status status = sorted != NULL && work != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (uint32_t v = 0; status == ICC_OK && v < n; ++v)
        sorted[v] = v;
    if (status == ICC_OK)
        iccp_sort_indices(sorted, work, n, s->given, comes_before);
    for (size_t i = 0; status == ICC_OK && i < told->n; ++i)
        if (told->vertex[i] == NONE) {
            told->vertex[i] = find_vertex(s->given, sorted, n, told->source + 2 * i);
            if (told->vertex[i] == NONE)
                status =
                    iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                 "point %zu is no vertex of the mesh, which is kept as it is", i);
        }
    iccp_free(&env->memory, sorted);
    iccp_free(&env->memory, work);
    return status;
}

/* Whether a triangle has an edge between two vertices. */
static bool has_edge(const iccp_elastic_shape *s, uint32_t t, uint32_t a, uint32_t b)
{
    const uint32_t *v = s->triangles + 3 * (size_t)t;
    return (v[0] == a || v[1] == a || v[2] == a) && (v[0] == b || v[1] == b || v[2] == b);
}

/* Checks that told lines run along edges of the caller's mesh, which then go along linearly. */
static icc_status check_lines(const iccp_elastic_shape *s, const iccp_told *told,
                              const iccp_env *env, icc_error *err)
{
    uint32_t *first = iccp_alloc_zero(&env->memory, s->n_points + 1, sizeof *first);
    uint32_t *around = iccp_alloc(&env->memory, s->n_triangles, 3 * sizeof *around);
    icc_status status = first != NULL && around != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        iccp_list_groups(around, first, s->n_points, s->triangles, s->n_triangles, 3);
    for (size_t i = 0; status == ICC_OK && i < told->n; ++i) {
        if (!told->joined[i])
            continue;
        const uint32_t a = told->vertex[i - 1], b = told->vertex[i];
        uint32_t k = first[a];
        while (k < first[a + 1] && !has_edge(s, around[k], a, b))
            ++k;
        if (k == first[a + 1])
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                  "the line from point %zu to point %zu is no edge of the mesh, "
                                  "which is kept as it is",
                                  i - 1, i);
    }
    iccp_free(&env->memory, first);
    iccp_free(&env->memory, around);
    return status;
}

static bool has_lines(const iccp_told *told)
{
    for (size_t i = 0; i < told->n; ++i)
        if (told->joined[i])
            return true;
    return false;
}

/* ---- a mesh for a domain ---- */

typedef struct pins {
    size_t n, n_segments;
    double *points;     /* 2 n, local */
    uint32_t *segments; /* 2 n_segments, numbers of told vertices (fit/elastic/pin_mesh.h) */
    uint32_t *of_item;  /* of each told item: its pin, or NONE */
    uint32_t *sorted, *work;
} pins;

static void free_pins(pins *p, const iccp_env *env)
{
    iccp_free(&env->memory, p->points);
    iccp_free(&env->memory, p->segments);
    iccp_free(&env->memory, p->of_item);
    iccp_free(&env->memory, p->sorted);
    iccp_free(&env->memory, p->work);
}

/* The told vertex of the mesh that an item will be. */
static uint32_t vertex_of(const pins *p, const icc_domain *domain, const iccp_told *told, size_t i)
{
    return p->of_item[i] == NONE ? told->vertex[i] : (uint32_t)domain->n_vertices + p->of_item[i];
}

/* Lists the segment of a line that ends at item i, unless it is an edge of the outline, which goes
 * along linearly anyway. */
static void add_segment(pins *p, const icc_domain *domain, const iccp_told *told, size_t i)
{
    const uint32_t a = vertex_of(p, domain, told, i - 1), b = vertex_of(p, domain, told, i);
    for (size_t f = 0; p->of_item[i] == NONE && p->of_item[i - 1] == NONE && f < domain->n_facets;
         ++f) {
        const uint32_t *ends = domain->facets + 2 * f;
        if ((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a))
            return;
    }
    p->segments[2 * p->n_segments] = a;
    p->segments[2 * p->n_segments++ + 1] = b;
}

/* Lists the told points, each place once, and the segments of told lines. Points at vertices of the
 * domain become these vertices. */
static icc_status list_pins(pins *p, const iccp_elastic_shape *s, const icc_domain *domain,
                            iccp_told *told, const iccp_env *env)
{
    const size_t n = told->n;
    p->points = iccp_alloc(&env->memory, n, 2 * sizeof *p->points);
    p->segments = iccp_alloc(&env->memory, n, 2 * sizeof *p->segments);
    p->of_item = iccp_alloc(&env->memory, n, sizeof *p->of_item);
    p->sorted = iccp_alloc(&env->memory, domain->n_vertices, sizeof *p->sorted);
    p->work = iccp_alloc(&env->memory, domain->n_vertices, sizeof *p->work);
    if (p->points == NULL || p->segments == NULL || p->of_item == NULL || p->sorted == NULL ||
        p->work == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < domain->n_vertices; ++v)
        p->sorted[v] = v;
    iccp_sort_indices(p->sorted, p->work, domain->n_vertices, domain->vertices, comes_before);
    for (size_t i = 0; i < n; ++i) {
        double local[2];
        p->of_item[i] = NONE;
        if (told->vertex[i] != NONE)
            continue;
        iccp_frame_in(&s->frame, 2, told->source + 2 * i, local);
        told->vertex[i] = find_vertex(domain->vertices, p->sorted, domain->n_vertices, local);
        for (size_t k = 0; told->vertex[i] == NONE && k < p->n && p->of_item[i] == NONE; ++k)
            if (!(p->points[2 * k] < local[0]) && !(p->points[2 * k] > local[0]) &&
                !(p->points[2 * k + 1] < local[1]) && !(p->points[2 * k + 1] > local[1]))
                p->of_item[i] = (uint32_t)k;
        if (told->vertex[i] == NONE && p->of_item[i] == NONE) {
            memcpy(p->points + 2 * p->n, local, sizeof local);
            p->of_item[i] = (uint32_t)p->n++;
        }
        if (told->joined[i])
            add_segment(p, domain, told, i);
    }
    return ICC_OK;
}

/* Gives a pin's number in an error back as the item's. */
static void blame_item(const pins *p, size_t n, icc_error *err)
{
    if (err == NULL || err->size == 0 || err->index < 0)
        return;
    for (size_t i = 0; i < n; ++i)
        if (p->of_item[i] == (uint32_t)err->index) {
            (void)iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, (int64_t)i,
                               "point %zu is not inside the domain", i);
            return;
        }
}

/* Where an item is in the domain, locally. Items in one place have one address. */
static const double *place_of(const pins *p, const icc_domain *domain, const iccp_told *told,
                              size_t i)
{
    return p->of_item[i] != NONE ? p->points + 2 * (size_t)p->of_item[i]
                                 : domain->vertices + 2 * (size_t)told->vertex[i];
}

/* Returns true if two segments without a common end meet. */
static bool meet(const double *a, const double *b, const double *c, const double *d)
{
    return a != c && a != d && b != c && b != d && a != b && iccp_segments_meet(a, b, c, d) != 0;
}

/* Names the end of the first piece of a line that meets the boundary, or an earlier piece. */
static void blame_line(const pins *p, const icc_domain *domain, const iccp_told *told,
                       icc_error *err)
{
    const double *v = domain->vertices;
    for (size_t i = 1; i < told->n; ++i) {
        if (!told->joined[i])
            continue;
        const double *a = place_of(p, domain, told, i - 1), *b = place_of(p, domain, told, i);
        for (size_t f = 0; f < domain->n_facets; ++f) {
            const uint32_t *ends = domain->facets + 2 * f;
            if (meet(a, b, v + 2 * (size_t)ends[0], v + 2 * (size_t)ends[1])) {
                (void)iccp_fail_at(err, ICC_ERR_CERTIFICATE, ICC_ITEM_POINT, (int64_t)i,
                                   "the line from point %zu to point %zu meets edge %zu of the "
                                   "domain",
                                   i - 1, i, f);
                return;
            }
        }
        for (size_t k = 1; k < i; ++k)
            if (told->joined[k] &&
                meet(a, b, place_of(p, domain, told, k - 1), place_of(p, domain, told, k))) {
                (void)iccp_fail_at(err, ICC_ERR_CERTIFICATE, ICC_ITEM_POINT, (int64_t)i,
                                   "the line from point %zu to point %zu meets the line from point "
                                   "%zu to point %zu",
                                   i - 1, i, k - 1, k);
                return;
            }
    }
}

static icc_status take_mesh(iccp_elastic_shape *s, iccp_pin_mesh *mesh, const icc_domain *domain,
                            iccp_told *told, const pins *p)
{
    const icc_status status = make_room(s, mesh->n_points, mesh->n_triangles, 0);
    if (status != ICC_OK)
        return status;
    memcpy(s->points, mesh->points, 2 * s->n_points * sizeof *s->points);
    memcpy(s->triangles, mesh->triangles, 3 * s->n_triangles * sizeof *s->triangles);
    for (size_t v = 0; v < s->n_points; ++v)
        iccp_frame_out(&s->frame, 2, s->points + 2 * v, s->given + 2 * v);
    for (size_t v = 0; v < domain->n_vertices; ++v)
        iccp_domain_given(domain, v, s->given + 2 * v);
    for (size_t i = 0; i < told->n; ++i)
        if (p->of_item[i] != NONE) {
            told->vertex[i] = vertex_of(p, domain, told, i);
            memcpy(s->given + 2 * (size_t)told->vertex[i], told->source + 2 * i,
                   2 * sizeof *s->given);
        }
    s->ends = iccp_alloc(&s->memory, s->n_points, 2 * sizeof *s->ends);
    s->share = iccp_alloc_zero(&s->memory, s->n_points, sizeof *s->share);
    if (s->ends == NULL || s->share == NULL)
        return ICC_ERR_MEMORY;
    memset(s->ends, 0xff, 2 * mesh->n_told * sizeof *s->ends);
    memcpy(s->ends + 2 * mesh->n_told, mesh->ends,
           2 * (s->n_points - mesh->n_told) * sizeof *s->ends);
    memcpy(s->share + mesh->n_told, mesh->share, (s->n_points - mesh->n_told) * sizeof *s->share);
    return ICC_OK;
}

static icc_status shape_of_domain(iccp_elastic_shape *s, const icc_domain *domain, iccp_told *told,
                                  const icc_fit_options *options, const iccp_env *env,
                                  icc_error *err)
{
    pins p = {0};
    iccp_pin_mesh mesh;
    s->frame = domain->frame;
    s->n_vertices = domain->n_vertices;
    icc_status status = list_pins(&p, s, domain, told, env);
    const iccp_pin_mesh_input input = {.domain = domain,
                                       .n_pins = p.n,
                                       .pins = p.points,
                                       .n_segments = p.n_segments,
                                       .segments = p.segments,
                                       .cell = options->cell * s->frame.in[0] * s->frame.in[1],
                                       .reach = options->reach * s->frame.in[0] * s->frame.in[1]};
    if (status == ICC_OK) {
        status = iccp_pin_mesh_create(&mesh, &input, env, err);
        if (status == ICC_ERR_OUTSIDE)
            blame_item(&p, told->n, err);
        if (status == ICC_ERR_CERTIFICATE)
            blame_line(&p, domain, told, err);
        if (status == ICC_OK) {
            status = take_mesh(s, &mesh, domain, told, &p);
            iccp_pin_mesh_free(&mesh);
        }
    }
    free_pins(&p, env);
    return status;
}

/* ---- what is told ---- */

static bool are_equal(const double *a, const double *b)
{
    for (size_t k = 0; k < 2; ++k)
        if (a[k] < b[k] || a[k] > b[k] || isnan(a[k]) != isnan(b[k]))
            return false;
    return true;
}

static icc_status check_tolerance(const iccp_told *told, size_t i, icc_error *err)
{
    return told->tolerance[i] > 0
               ? iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                              "point %zu has a tolerance; an elastic fit takes exact points only",
                              i)
               : ICC_OK;
}

/* Notes what each item tells of its vertex. */
static icc_status hold_items(iccp_elastic_shape *s, iccp_told *told, icc_error *err)
{
    icc_status status = ICC_OK;
    for (size_t i = 0; status == ICC_OK && i < told->n; ++i) {
        const uint32_t v = told->vertex[i];
        const bool is_sliding = told->kind[i] == ICC_CONSTRAINT_SLIDING;
        const uint32_t other = v < s->n_points ? s->item[v] : NONE;
        status = check_tolerance(told, i, err);
        if (status == ICC_OK &&
            v >= (told->kind[i] < ICC_CONSTRAINT_VERTICES ? s->n_points : s->n_vertices))
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                  "point %zu is vertex %lu; there are %zu", i, (unsigned long)v,
                                  s->n_vertices);
        if (status == ICC_OK && other != NONE &&
            (told->kind[i] == ICC_CONSTRAINT_SLIDING ||
             told->kind[other] == ICC_CONSTRAINT_SLIDING ||
             !are_equal(told->target + 2 * i, told->target + 2 * (size_t)other)))
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                  "points %lu and %zu are in the same place: they must have the "
                                  "same target, and must not slide",
                                  (unsigned long)other, i);
        if (status != ICC_OK)
            break;
        s->item[v] = (uint32_t)i;
        s->hold[v] = is_sliding ? ICCP_SLIDING : ICCP_HELD;
        memcpy(told->source + 2 * i, s->given + 2 * (size_t)v, 2 * sizeof *s->given);
        if (is_sliding)
            memcpy(s->direction + 2 * (size_t)v, told->direction + 2 * i, 2 * sizeof *s->direction);
    }
    return status;
}

/* Sets the direction of a sliding vertex to that of the boundary, which goes to `after`. */
static icc_status follow_boundary(iccp_elastic_shape *s, uint32_t v, uint32_t before,
                                  uint32_t after, icc_error *err)
{
    const double *p = s->points + 2 * (size_t)v;
    double in[2], out[2];
    for (size_t k = 0; k < 2; ++k) {
        in[k] = p[k] - s->points[2 * (size_t)before + k];
        out[k] = s->points[2 * (size_t)after + k] - p[k];
        s->direction[2 * (size_t)v + k] = in[k] + out[k];
    }
    const double cross = in[0] * out[1] - in[1] * out[0], dot = in[0] * out[0] + in[1] * out[1];
    return fabs(cross) <= STRAIGHT * dot
               ? ICC_OK
               : iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)s->item[v],
                              "the boundary bends at point %lu, which is to slide along it: give "
                              "a direction",
                              (unsigned long)s->item[v]);
}

/* Finds the directions of vertices that slide along the boundary. `before` has room for all
 * vertices. */
static icc_status find_directions(iccp_elastic_shape *s, const uint32_t *next, uint32_t *before,
                                  icc_error *err)
{
    icc_status status = ICC_OK;
    for (uint32_t v = 0; v < s->n_points; ++v)
        if (next[v] != NONE)
            before[next[v]] = v;
    for (uint32_t v = 0; status == ICC_OK && v < s->n_points; ++v) {
        if (s->hold[v] != ICCP_SLIDING || !isnan(s->direction[2 * (size_t)v]))
            continue;
        status = next[v] != NONE
                     ? follow_boundary(s, v, before[v], next[v], err)
                     : iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)s->item[v],
                                    "point %lu slides and is not on the boundary: give a direction",
                                    (unsigned long)s->item[v]);
    }
    return status;
}

/* Vertices on edges whose two ends are told are told, too. They go along linearly if both ends are
 * held, and slide in the direction of the end that slides. */
static void hold_edges(iccp_elastic_shape *s)
{
    for (size_t v = s->n_vertices; s->ends != NULL && v < s->n_points; ++v) {
        const uint32_t *end = s->ends + 2 * v;
        if (end[0] == NONE || s->hold[end[0]] == ICCP_LOOSE || s->hold[end[1]] == ICCP_LOOSE)
            continue;
        s->hold[v] = ICCP_HELD;
        for (size_t k = 0; k < 2; ++k)
            if (s->hold[end[k]] == ICCP_SLIDING) {
                s->hold[v] = ICCP_SLIDING;
                memcpy(s->direction + 2 * v, s->direction + 2 * (size_t)end[k],
                       2 * sizeof *s->direction);
            }
    }
}

static void list_inner(iccp_elastic_shape *s, const uint32_t *next)
{
    for (uint32_t v = 0; v < s->n_points; ++v)
        if (s->hold[v] == ICCP_HELD && next[v] == NONE)
            s->inner[s->n_inner++] = v;
}

/* Completes what is told by what the boundary tells. */
static icc_status hold_boundary(iccp_elastic_shape *s, const iccp_env *env, icc_error *err)
{
    iccp_corners corners = {s->triangles, NULL, s->n_triangles};
    corners.twin = iccp_alloc(&env->memory, s->n_triangles, 3 * sizeof *corners.twin);
    uint32_t *next = iccp_alloc(&env->memory, s->n_points, 2 * sizeof *next);
    icc_status status = corners.twin != NULL && next != NULL
                            ? iccp_link_triangles(&corners, s->n_points, next, env, err)
                            : ICC_ERR_MEMORY;
    if (status == ICC_ERR_BOUNDARY || status == ICC_ERR_TOPOLOGY)
        status = iccp_fail_side(err, status, 1);
    if (status == ICC_OK)
        status = find_directions(s, next, next + s->n_points, err);
    if (status == ICC_OK) {
        hold_edges(s);
        list_inner(s, next);
    }
    iccp_free(&env->memory, corners.twin);
    iccp_free(&env->memory, next);
    return status;
}

/* ---- making it ---- */

static icc_status make_elastic(iccp_elastic_shape *s, const icc_fit_options *options,
                               const iccp_env *env)
{
    const iccp_elastic_input input = {.n_points = s->n_points,
                                      .n_triangles = s->n_triangles + s->n_more,
                                      .n_more = s->n_more,
                                      .points = s->points,
                                      .corners = s->triangles,
                                      .hold = s->hold,
                                      .direction = s->direction,
                                      .stiffness = options->stiffness,
                                      .cell_factor = s->factor,
                                      .reach = options->reach * s->frame.in[0] * s->frame.in[1],
                                      .contact = !options->no_contact};
    return iccp_elastic_create(&s->elastic, &input, env);
}

static icc_status create(iccp_elastic_shape *s, const icc_domain *domain, const icc_mesh *mesh,
                         iccp_told *told, const icc_fit_options *options, const iccp_env *env,
                         icc_error *err)
{
    icc_status status = mesh != NULL ? shape_of_mesh(s, mesh, options->cell_stiffness, env, err)
                                     : shape_of_domain(s, domain, told, options, env, err);
    if (status == ICC_OK && mesh != NULL)
        status = find_in_mesh(s, told, env, err);
    if (status == ICC_OK && mesh != NULL && has_lines(told))
        status = check_lines(s, told, env, err);
    if (status == ICC_OK)
        status = hold_items(s, told, err);
    if (status == ICC_OK)
        status = hold_boundary(s, env, err);
    return status == ICC_OK ? make_elastic(s, options, env) : status;
}

icc_status iccp_elastic_shape_create(iccp_elastic_shape **out, const icc_domain *domain,
                                     const icc_mesh *mesh, iccp_told *told,
                                     const icc_fit_options *options, const iccp_env *env,
                                     icc_error *err)
{
    iccp_elastic_shape *s = iccp_alloc_zero(&env->memory, 1, sizeof *s);
    *out = NULL;
    if (s == NULL)
        return ICC_ERR_MEMORY;
    s->memory = env->memory;
    s->references = 1;
    const icc_status status = create(s, domain, mesh, told, options, env, err);
    if (status == ICC_OK)
        *out = s;
    else
        iccp_elastic_shape_release(s);
    return status;
}

/* ---- targets ---- */

static void aim_item(const iccp_elastic_shape *s, const iccp_told *told, uint32_t v, double *target)
{
    const double *given = told->target + 2 * (size_t)s->item[v];
    if (isnan(given[0]))
        memcpy(target, s->points + 2 * (size_t)v, 2 * sizeof *target);
    else
        iccp_frame_in(&s->frame, 2, given, target);
}

void iccp_elastic_shape_aim(const iccp_elastic_shape *s, const iccp_told *told, double *targets)
{
    for (uint32_t v = 0; v < s->n_points; ++v) {
        if (s->item[v] != NONE)
            aim_item(s, told, v, targets + 2 * (size_t)v);
        else if (s->hold[v] == ICCP_LOOSE)
            memcpy(targets + 2 * (size_t)v, s->points + 2 * (size_t)v, 2 * sizeof *targets);
    }
    for (size_t v = s->n_vertices; v < s->n_points; ++v)
        if (s->item[v] == NONE && s->hold[v] != ICCP_LOOSE) {
            const double *a = targets + 2 * (size_t)s->ends[2 * v];
            const double *b = targets + 2 * (size_t)s->ends[2 * v + 1];
            for (size_t k = 0; k < 2; ++k)
                targets[2 * v + k] = (1 - s->share[v]) * a[k] + s->share[v] * b[k];
        }
}
