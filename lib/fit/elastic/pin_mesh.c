/* Meshes a domain around pins. Edges are divided first, then a quadtree grades points inside
 * (mesh/grading.h), and the triangulation keeps all edges. An edge between two vertices of the
 * outline is cut in its middle, because a limb that is one triangle wide could not bend. */
#include "fit/elastic/pin_mesh.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/sort.h"
#include "domain/features.h"
#include "math/elementary.h"
#include "math/predicates.h"
#include "mesh/corners.h"
#include "mesh/grading.h"
#include "mesh/triangulate.h"

#include <math.h>
#include <string.h>

/* Without a cell size, squares of its length fill the domain this many times. */
static const double SQUARES = 700;

/* Most squares of a cell's length in the domain's box; a square makes two triangles. */
static const double MOST_SQUARES = 2e6;

/* Edges that fit into the reach. From there on the answer hardly depends on the mesh, as was
 * measured with a pin in a square. Edges are not made shorter by more than FINEST for that. */
static const double EDGES_IN_REACH = 5, FINEST = 2;

/* Edges at a pin are so much shorter than the reach, because the second derivatives have their
 * peak there. With 16 or 64 the aspect of maps beside pins is the same within some percent. */
static const double EDGES_AT_PIN = 32;

/* Least spacing at a pin, as a share of the cell size. */
static const double LEAST_SPACING = 1.0 / 64;

/* Points of the quadtree are left out within this share of the spacing of a pin. Points that divide
 * a segment are pins here. Their spacing is that of the segment's parts, so every point of a
 * segment is within half of it. */
static const double CLEARANCE = 0.65;

/* Most parts of one edge. */
static const double MOST_PARTS = 4096;

/* An edge between two told vertices that is divided. */
typedef struct side {
    uint32_t a, b;
    uint32_t n;       /* parts */
    bool is_boundary; /* on the outline; otherwise a segment between pins */
} side;

typedef struct builder {
    const iccp_pin_mesh_input *input;
    iccp_pin_mesh *mesh;
    const iccp_env *env;
    double cell;
    size_t n_sides, n_parts, n_outline; /* n_outline: parts of the outline, which come first */
    side *sides;
    size_t n_fixed;      /* told vertices, and those that divide sides */
    double *spacing;     /* n_fixed */
    uint32_t *pairs;     /* 2 n_parts: edges that the mesh must contain */
    uint8_t *on_outline; /* n_fixed */
    size_t n_inner;
    double *inner; /* points of the quadtree */
    uint32_t *twins;
} builder;

static const double *point(const builder *b, uint32_t v)
{
    return b->mesh->points + 2 * (size_t)v;
}

static double between(const builder *b, uint32_t v, uint32_t w)
{
    return iccp_hypot(point(b, w)[0] - point(b, v)[0], point(b, w)[1] - point(b, v)[1]);
}

/* ---- spacing at pins ---- */

static bool is_left_of(const void *context, uint32_t a, uint32_t b)
{
    const double *points = context;
    return points[2 * (size_t)a] < points[2 * (size_t)b];
}

/* Sets the spacing of a pin to its distance from other told points. `order` is by x. */
static void find_spacing(const builder *b, const uint32_t *order, size_t n, size_t k)
{
    const uint32_t v = order[k];
    double least = b->spacing[v];
    for (size_t i = k + 1; i < n && point(b, order[i])[0] - point(b, v)[0] < least; ++i)
        least = iccp_min(least, between(b, v, order[i]));
    for (size_t i = k; i-- > 0 && point(b, v)[0] - point(b, order[i])[0] < least;)
        least = iccp_min(least, between(b, v, order[i]));
    if (b->input->reach > 0)
        least = iccp_min(least, b->input->reach / EDGES_AT_PIN);
    b->spacing[v] = iccp_max(least, LEAST_SPACING * b->cell);
}

/* Finds the spacing of pins from one another and from the outline. Sides near pins are divided as
 * finely. */
static icc_status measure_pins(builder *b, icc_error *err)
{
    const icc_domain *domain = b->input->domain;
    const uint32_t first = (uint32_t)domain->n_vertices;
    for (uint32_t v = first; v < b->mesh->n_told; ++v) {
        uint32_t facet = 0;
        double bary[2] = {1, 0}, at[2];
        if (iccp_domain_locate(domain, point(b, v), false, &facet, bary) != ICC_INSIDE)
            return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, v - first,
                                "point %lu is not inside the domain", (unsigned long)(v - first));
        iccp_domain_facet_point(domain, facet, bary, at);
        const double d = iccp_hypot(at[0] - point(b, v)[0], at[1] - point(b, v)[1]);
        side *s = &b->sides[facet];
        b->spacing[v] = iccp_max(iccp_min(b->cell, d), LEAST_SPACING * b->cell);
        s->n = (uint32_t)iccp_min(iccp_max(s->n, ceil(between(b, s->a, s->b) / b->spacing[v])),
                                  MOST_PARTS);
    }
    return ICC_OK;
}

static icc_status space_pins(builder *b, icc_error *err)
{
    const size_t n = b->mesh->n_told;
    uint32_t *order = iccp_alloc(&b->env->memory, n, 2 * sizeof *order);
    if (order == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < n; ++v)
        order[v] = v;
    iccp_sort_indices(order, order + n, n, b->mesh->points, is_left_of);
    const icc_status status = measure_pins(b, err);
    for (size_t k = 0; status == ICC_OK && k < n; ++k)
        if (order[k] >= b->input->domain->n_vertices)
            find_spacing(b, order, n, k);
    iccp_free(&b->env->memory, order);
    return status;
}

/* ---- sides ---- */

/* Lists the sides, with as many parts as the cell size asks for. */
static void list_sides(builder *b)
{
    const icc_domain *domain = b->input->domain;
    for (size_t k = 0; k < b->n_sides; ++k) {
        side *s = &b->sides[k];
        s->is_boundary = k < domain->n_facets;
        const uint32_t *ends = s->is_boundary ? domain->facets + 2 * k
                                              : b->input->segments + 2 * (k - domain->n_facets);
        s->a = ends[0];
        s->b = ends[1];
        s->n = (uint32_t)iccp_min(iccp_max(ceil(between(b, s->a, s->b) / b->cell), 1), MOST_PARTS);
    }
}

/* Adds the vertices that divide a side, and its parts. */
static void divide_side(builder *b, const side *s, size_t *n_parts)
{
    iccp_pin_mesh *mesh = b->mesh;
    const double part = between(b, s->a, s->b) / s->n;
    uint32_t before = s->a;
    for (uint32_t j = 1; j <= s->n; ++j) {
        uint32_t v = s->b;
        if (j < s->n) {
            v = (uint32_t)mesh->n_points++;
            const size_t made = v - mesh->n_told;
            const double share = (double)j / s->n;
            mesh->share[made] = share;
            mesh->ends[2 * made] = s->a;
            mesh->ends[2 * made + 1] = s->b;
            for (size_t d = 0; d < 2; ++d)
                mesh->points[2 * (size_t)v + d] =
                    (1 - share) * point(b, s->a)[d] + share * point(b, s->b)[d];
            b->spacing[v] = part;
            b->on_outline[v] = s->is_boundary;
        }
        b->pairs[2 * *n_parts] = before;
        b->pairs[2 * (*n_parts)++ + 1] = v;
        before = v;
    }
}

/* Divides all sides. A vertex of the outline has the spacing of its longer edge. */
static void divide_sides(builder *b)
{
    size_t n_parts = 0;
    for (uint32_t v = 0; v < b->input->domain->n_vertices; ++v)
        b->spacing[v] = 0;
    for (size_t k = 0; k < b->n_sides; ++k) {
        const side *s = &b->sides[k];
        const double part = between(b, s->a, s->b) / s->n;
        const uint32_t ends[2] = {s->a, s->b};
        for (size_t i = 0; i < 2; ++i) {
            double *own = &b->spacing[ends[i]];
            *own = s->is_boundary ? iccp_max(*own, part) : iccp_min(*own, part);
            b->on_outline[ends[i]] |= s->is_boundary;
        }
        divide_side(b, s, &n_parts);
    }
    for (uint32_t v = 0; v < b->input->domain->n_vertices; ++v)
        if (!b->on_outline[v])
            b->spacing[v] = b->cell;
}

/* ---- inside ---- */

/* Drops points of the quadtree that are too near to fixed points inside. */
static icc_status thin_out(builder *b)
{
    uint32_t *order = iccp_alloc(&b->env->memory, b->n_fixed, 2 * sizeof *order);
    size_t n = 0, n_kept = 0;
    double most = 0;
    if (order == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < b->n_fixed; ++v)
        if (!b->on_outline[v]) {
            order[n++] = v;
            most = iccp_max(most, CLEARANCE * b->spacing[v]);
        }
    iccp_sort_indices(order, order + b->n_fixed, n, b->mesh->points, is_left_of);
    for (size_t i = 0; i < b->n_inner; ++i) {
        const double *p = b->inner + 2 * i;
        size_t low = 0, high = n;
        while (low < high) {
            const size_t middle = (low + high) / 2;
            if (point(b, order[middle])[0] < p[0] - most)
                low = middle + 1;
            else
                high = middle;
        }
        bool is_clear = true;
        for (; low < n && point(b, order[low])[0] <= p[0] + most && is_clear; ++low) {
            const double *q = point(b, order[low]);
            is_clear = iccp_hypot(q[0] - p[0], q[1] - p[1]) >= CLEARANCE * b->spacing[order[low]];
        }
        if (is_clear)
            memmove(b->inner + 2 * n_kept++, p, 2 * sizeof *p);
    }
    b->n_inner = n_kept;
    iccp_free(&b->env->memory, order);
    return ICC_OK;
}

static icc_status fill_inside(builder *b)
{
    const iccp_samples samples = {b->n_fixed, b->mesh->points, b->spacing};
    const icc_status status =
        iccp_graded_points(b->input->domain, &samples, b->cell, &b->inner, &b->n_inner, b->env);
    return status == ICC_OK ? thin_out(b) : status;
}

/* ---- triangles ---- */

static icc_status triangulate(builder *b)
{
    iccp_pin_mesh *mesh = b->mesh;
    const iccp_memory *memory = &b->env->memory;
    /* room for a cut in every edge, of which there are less than three for each point */
    const size_t room = 4 * mesh->n_points;
    iccp_walls walls = {0}, outline = {0};
    icc_status status = iccp_walls_create(&walls, mesh->n_points, b->n_parts, b->pairs, memory);
    if (status == ICC_OK)
        status = iccp_walls_create(&outline, mesh->n_points, b->n_outline, b->pairs, memory);
    mesh->triangles = iccp_alloc(memory, room, 6 * sizeof *mesh->triangles);
    b->twins = iccp_alloc(memory, room, 6 * sizeof *b->twins);
    if (mesh->triangles == NULL || b->twins == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_triangulate_walls(mesh->n_points, mesh->points, &walls, &outline,
                                        mesh->triangles, b->twins, &mesh->n_triangles, b->env);
    iccp_walls_free(&walls, memory);
    iccp_walls_free(&outline, memory);
    return status;
}

static bool turns_left(const builder *b, uint32_t v, uint32_t w, const double *p)
{
    return iccp_orient2d(point(b, v), point(b, w), p) > 0;
}

static bool is_on_outline(const builder *b, uint32_t v)
{
    return v < b->n_fixed && b->on_outline[v];
}

/* Cuts the edge that a corner faces, if it joins two vertices of the outline and rounding allows
 * it. */
static void cut_chord(builder *b, iccp_corners *corners, uint32_t corner)
{
    iccp_pin_mesh *mesh = b->mesh;
    const uint32_t twin = b->twins[corner];
    const uint32_t v = mesh->triangles[iccp_after(corner)],
                   w = mesh->triangles[iccp_before(corner)];
    if (twin == ICCP_NO_NEIGHBOUR || !is_on_outline(b, v) || !is_on_outline(b, w))
        return;
    const uint32_t x = mesh->triangles[corner], y = mesh->triangles[twin];
    const double middle[2] = {0.5 * point(b, v)[0] + 0.5 * point(b, w)[0],
                              0.5 * point(b, v)[1] + 0.5 * point(b, w)[1]};
    if (!turns_left(b, x, v, middle) || !turns_left(b, w, x, middle) ||
        !turns_left(b, y, w, middle) || !turns_left(b, v, y, middle))
        return;
    memcpy(mesh->points + 2 * mesh->n_points, middle, sizeof middle);
    iccp_cut_edge(corners, corner, (uint32_t)mesh->n_points++);
}

static void cut_chords(builder *b)
{
    iccp_corners corners = {b->mesh->triangles, b->twins, b->mesh->n_triangles};
    for (uint32_t c = 0; c < 3 * corners.n_triangles; ++c)
        cut_chord(b, &corners, c);
    b->mesh->n_triangles = corners.n_triangles;
}

/* ---- the whole ---- */

/* Makes room for all vertices: `fixed` ones, then those inside and in the middle of chords. */
static icc_status enlarge(builder *b, size_t n_fixed, size_t n_more)
{
    iccp_pin_mesh *mesh = b->mesh;
    const iccp_memory *memory = &b->env->memory;
    const size_t n = n_fixed + n_more, made = n - mesh->n_told, n_old = mesh->n_points;
    if (!iccp_enlarge(memory, &mesh->points, 2 * n_old, 2 * n, sizeof *mesh->points) ||
        !iccp_enlarge(memory, &mesh->ends, 2 * (n_old - mesh->n_told), 2 * made,
                      sizeof *mesh->ends) ||
        !iccp_enlarge(memory, &mesh->share, n_old - mesh->n_told, made, sizeof *mesh->share))
        return ICC_ERR_MEMORY;
    memset(mesh->ends + 2 * (n_old - mesh->n_told), 0xff, 2 * (n - n_old) * sizeof *mesh->ends);
    memset(mesh->share + (n_old - mesh->n_told), 0, (n - n_old) * sizeof *mesh->share);
    return ICC_OK;
}

/* Copies the told points and finds how the sides are divided. */
static icc_status begin(builder *b, icc_error *err)
{
    const iccp_pin_mesh_input *in = b->input;
    const icc_domain *domain = in->domain;
    iccp_pin_mesh *mesh = b->mesh;
    const iccp_memory *memory = &b->env->memory;
    mesh->n_points = mesh->n_told = domain->n_vertices + in->n_pins;
    b->n_sides = domain->n_facets + in->n_segments;
    mesh->points = iccp_alloc(memory, mesh->n_told, 2 * sizeof *mesh->points);
    b->sides = iccp_alloc(memory, b->n_sides, sizeof *b->sides);
    b->spacing = iccp_alloc(memory, mesh->n_told, sizeof *b->spacing);
    if (mesh->points == NULL || b->sides == NULL || b->spacing == NULL)
        return ICC_ERR_MEMORY;
    memcpy(mesh->points, domain->vertices, 2 * domain->n_vertices * sizeof *mesh->points);
    if (in->n_pins > 0)
        memcpy(mesh->points + 2 * domain->n_vertices, in->pins,
               2 * in->n_pins * sizeof *mesh->points);
    list_sides(b);
    const icc_status status = space_pins(b, err);
    for (size_t k = 0; k < b->n_sides; ++k) {
        b->n_parts += b->sides[k].n;
        b->n_outline += b->sides[k].is_boundary ? b->sides[k].n : 0;
    }
    b->n_fixed = mesh->n_told + b->n_parts - b->n_sides;
    return status;
}

static icc_status divide(builder *b)
{
    const iccp_memory *memory = &b->env->memory;
    icc_status status = enlarge(b, b->n_fixed, 0);
    b->pairs = iccp_alloc(memory, b->n_parts, 2 * sizeof *b->pairs);
    b->on_outline = iccp_alloc_zero(memory, b->n_fixed, sizeof *b->on_outline);
    if (status != ICC_OK || b->pairs == NULL || b->on_outline == NULL ||
        !iccp_enlarge(memory, &b->spacing, b->mesh->n_told, b->n_fixed, sizeof *b->spacing))
        return ICC_ERR_MEMORY;
    divide_sides(b);
    return ICC_OK;
}

static icc_status build(builder *b, icc_error *err)
{
    iccp_pin_mesh *mesh = b->mesh;
    icc_status status = begin(b, err);
    if (status == ICC_OK)
        status = divide(b);
    if (status == ICC_OK)
        status = fill_inside(b);
    if (status == ICC_OK)
        status = enlarge(b, b->n_fixed, 4 * (b->n_fixed + b->n_inner));
    if (status != ICC_OK)
        return status;
    if (b->n_inner > 0)
        memcpy(mesh->points + 2 * mesh->n_points, b->inner, 2 * b->n_inner * sizeof *b->inner);
    mesh->n_points += b->n_inner;
    status = triangulate(b);
    if (status == ICC_OK)
        cut_chords(b);
    if (status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE || status == ICC_ERR_ARGUMENT ||
        status == ICC_ERR_TOPOLOGY)
        status = iccp_fail(err, ICC_ERR_CERTIFICATE,
                           "the domain cannot be meshed: lines meet one another or the outline, or "
                           "points or sides are closer than rounding errors");
    return status;
}

/* The area within a ring of facets. */
static double area_of(const icc_domain *domain, size_t first, size_t n)
{
    double area = 0;
    for (size_t f = first; f < first + n; ++f) {
        const double *a = domain->vertices + 2 * (size_t)domain->facets[2 * f];
        const double *b = domain->vertices + 2 * (size_t)domain->facets[2 * f + 1];
        area += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    return fabs(area);
}

static double cell_of(const iccp_pin_mesh_input *input)
{
    const icc_domain *domain = input->domain;
    const iccp_features *features = domain->features;
    const double width = domain->upper[0] - domain->lower[0],
                 height = domain->upper[1] - domain->lower[1];
    if (input->cell > 0)
        return iccp_min(input->cell, iccp_max(width, height));
    double area = area_of(domain, 0, features != NULL ? features->n_outer : domain->n_facets);
    for (size_t k = 0; features != NULL && k < features->n; ++k)
        if (features->item[k].kind == ICC_FEATURE_HOLE)
            area -= area_of(domain, features->item[k].first_facet, features->item[k].n_facets);
    const double cell = sqrt(area / SQUARES);
    return input->reach > 0 ? iccp_min(cell, iccp_max(input->reach / EDGES_IN_REACH, cell / FINEST))
                            : cell;
}

icc_status iccp_pin_mesh_create(iccp_pin_mesh *mesh, const iccp_pin_mesh_input *input,
                                const iccp_env *env, icc_error *err)
{
    builder b = {.input = input, .mesh = mesh, .env = env, .cell = cell_of(input)};
    *mesh = (iccp_pin_mesh){.memory = env->memory};
    const icc_domain *domain = input->domain;
    const double width = (domain->upper[0] - domain->lower[0]) / b.cell,
                 height = (domain->upper[1] - domain->lower[1]) / b.cell;
    if (!(width * height <= MOST_SQUARES))
        return iccp_fail(err, ICC_ERR_RESOLUTION,
                         "a cell this small would make more than %.0f triangles", 2 * MOST_SQUARES);
    const icc_status status = build(&b, err);
    iccp_free(&env->memory, b.sides);
    iccp_free(&env->memory, b.spacing);
    iccp_free(&env->memory, b.pairs);
    iccp_free(&env->memory, b.on_outline);
    iccp_free(&env->memory, b.inner);
    iccp_free(&env->memory, b.twins);
    if (status != ICC_OK)
        iccp_pin_mesh_free(mesh);
    return iccp_explain(err, status);
}

void iccp_pin_mesh_free(iccp_pin_mesh *mesh)
{
    const iccp_memory memory = mesh->memory;
    iccp_free(&memory, mesh->points);
    iccp_free(&memory, mesh->triangles);
    iccp_free(&memory, mesh->ends);
    iccp_free(&memory, mesh->share);
    *mesh = (iccp_pin_mesh){.memory = memory};
}
