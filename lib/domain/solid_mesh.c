/* Checks meshes of solids with features. All simplices are positive and join from opposite sides.
 * So as many of them cover a point as the boundary winds around it: one inside, none outside.
 *
 * A facet of a region is a wall: a face of the mesh with two sides. Walls are found by their
 * smallest vertices. The facets tell the regions of the simplices beside them, a flood those of the
 * others. */
#include "domain/solid_mesh.h"

#include "base/error.h"
#include "domain/solid_domain.h"
#include "geometry/tuples.h"
#include "math/orient.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct check {
    const icc_domain *solid;
    iccp_simplices *mesh;
    icc_error *err;
    uint32_t *first; /* by vertex: the first facet of a region with this smallest vertex, or NONE */
    uint32_t *next;  /* by facet of regions: the next one with the same smallest vertex */
    uint32_t *wall;  /* by side: 2 times the facet there, plus 1 if seen from behind; or NONE */
    uint32_t *queue; /* by simplex */
    bool *used;      /* by point */
} check;

static icc_status fail_simplex(const check *c, size_t s, const char *what)
{
    return iccp_fail_at(c->err, ICC_ERR_CERTIFICATE, ICC_ITEM_SIMPLEX, (int64_t)s,
                        "tetrahedron %zu %s", s, what);
}

/* ---- simplices ---- */

static icc_status check_positive(const check *c)
{
    const iccp_simplices *mesh = c->mesh;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const double *points[4];
        for (size_t i = 0; i < 4; ++i)
            points[i] = iccp_corner_point(mesh, 4 * s + i);
        if (iccp_orient(3, points) != 1)
            return fail_simplex(c, s, "is not positive");
    }
    return ICC_OK;
}

/* Checks that all points are used, and that the first ones are those of the solid. */
static icc_status check_points(const check *c)
{
    const iccp_simplices *mesh = c->mesh;
    memset(c->used, 0, mesh->n_points * sizeof *c->used);
    for (size_t i = 0; i < 4 * mesh->n_simplices; ++i)
        c->used[mesh->corners[i]] = true;
    for (size_t v = 0; v < mesh->n_points; ++v)
        if (!c->used[v])
            return iccp_fail_at(c->err, ICC_ERR_CERTIFICATE, ICC_ITEM_VERTEX, (int64_t)v,
                                "vertex %zu belongs to no tetrahedron", v);
    for (size_t i = 0; i < 3 * c->solid->n_vertices; ++i)
        if (mesh->points[i] != c->solid->vertices[i])
            return iccp_fail_at(c->err, ICC_ERR_CERTIFICATE, ICC_ITEM_VERTEX, (int64_t)(i / 3),
                                "vertex %zu of the mesh is not that of the solid", i / 3);
    return ICC_OK;
}

/* ---- walls ---- */

static void sort(uint32_t v[3], const uint32_t *from, bool *odd)
{
    memcpy(v, from, 3 * sizeof *v);
    *odd = iccp_sort_vertices(3, v);
}

/* Lists the facets of regions by their smallest vertices. */
static void list_walls(const check *c)
{
    const icc_domain *solid = c->solid;
    for (size_t v = 0; v < solid->n_vertices; ++v)
        c->first[v] = NONE;
    for (uint32_t f = (uint32_t)solid->n_facets; f < solid->features->n_places; ++f) {
        uint32_t v[3];
        bool odd;
        sort(v, solid->facets + 3 * (size_t)f, &odd);
        c->next[f - solid->n_facets] = c->first[v[0]];
        c->first[v[0]] = f;
    }
}

/* Returns what wall[] says of a side with these points, as seen from beyond it. */
static uint32_t wall_at(const check *c, const uint32_t *points)
{
    const icc_domain *solid = c->solid;
    uint32_t v[3], w[3];
    bool odd, odd_facet;
    sort(v, points, &odd);
    if (v[2] >= solid->n_vertices)
        return NONE;
    for (uint32_t f = c->first[v[0]]; f != NONE; f = c->next[f - solid->n_facets]) {
        sort(w, solid->facets + 3 * (size_t)f, &odd_facet);
        if (v[1] == w[1] && v[2] == w[2])
            return 2 * f + (odd == odd_facet);
    }
    return NONE;
}

/* Finds the walls and the facets of the boundary at all sides. A simplex lies behind a facet whose
 * corners run counter-clockwise as seen from beyond its side. */
static icc_status find_walls(const check *c)
{
    const icc_domain *solid = c->solid;
    iccp_simplices *mesh = c->mesh;
    size_t n_found = 0;
    list_walls(c);
    for (size_t side = 0; side < 4 * mesh->n_simplices; ++side) {
        uint32_t points[3], v[3];
        bool odd, odd_facet;
        iccp_simplices_side(mesh, side, points);
        if ((mesh->across[side] & ICCP_ON_BOUNDARY) == 0) {
            c->wall[side] = wall_at(c, points);
            n_found += c->wall[side] != NONE;
            continue;
        }
        const uint32_t f = mesh->across[side] & ~ICCP_ON_BOUNDARY;
        sort(v, points, &odd);
        sort(v, solid->facets + 3 * (size_t)f, &odd_facet);
        c->wall[side] = 2 * f + (odd == odd_facet);
    }
    if (n_found == 2 * (solid->features->n_places - solid->n_facets))
        return ICC_OK;
    return iccp_fail(c->err, ICC_ERR_CERTIFICATE, "the mesh lacks a face of an inner surface");
}

/* Gives the region of its first simplex to all that are joined to it other than through walls. */
static void flood(const check *c, size_t first)
{
    iccp_simplices *mesh = c->mesh;
    size_t n = 0, done = 0;
    c->queue[n++] = (uint32_t)first;
    while (done < n) {
        const size_t s = c->queue[done++];
        for (size_t side = 4 * s; side < 4 * s + 4; ++side) {
            if (c->wall[side] != NONE)
                continue;
            const uint32_t next = mesh->across[side] / 4;
            if (mesh->region[next] == NONE) {
                mesh->region[next] = mesh->region[s];
                c->queue[n++] = next;
            }
        }
    }
}

/* Numbers the regions, and checks that each wall lies between the right ones. */
static icc_status find_regions(const check *c)
{
    const uint32_t *sides = c->solid->features->sides;
    iccp_simplices *mesh = c->mesh;
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        mesh->region[s] = NONE;
    for (size_t side = 0; side < 4 * mesh->n_simplices; ++side)
        if (c->wall[side] != NONE && mesh->region[side / 4] == NONE) {
            mesh->region[side / 4] = sides[c->wall[side]];
            flood(c, side / 4);
        }
    for (size_t side = 0; side < 4 * mesh->n_simplices; ++side) {
        const uint32_t region = mesh->region[side / 4], wall = c->wall[side];
        if (region == NONE ||
            (wall != NONE ? region != sides[wall] : region != mesh->region[mesh->across[side] / 4]))
            return fail_simplex(c, side / 4, "lies in a wrong region");
    }
    return ICC_OK;
}

/* ---- lines ---- */

/* The edges of lines: pairs of points. */
typedef struct edge_chain {
    uint32_t *edges;
    size_t n;
} edge_chain;

static void add_edge(edge_chain *chain, uint32_t a, uint32_t b)
{
    chain->edges[2 * chain->n] = a < b ? a : b;
    chain->edges[2 * chain->n++ + 1] = a < b ? b : a;
}

/* Follows the points on a segment from a to b. *next is the first that is left in on_line[]. */
static bool follow_segment(const check *c, edge_chain *chain, uint32_t a, uint32_t b, size_t *next)
{
    const iccp_simplices *mesh = c->mesh;
    uint32_t last = a;
    double share = 0;
    for (; *next < mesh->n_on_lines && mesh->on_line[*next].a == a && mesh->on_line[*next].b == b;
         ++*next) {
        const iccp_on_line *p = &mesh->on_line[*next];
        double place[3];
        if (!(p->share > share && p->share < 1) || p->point < mesh->n_boundary ||
            p->point >= mesh->n_points || c->used[p->point])
            return false;
        iccp_frame_between(&c->solid->frame, mesh->points + 3 * (size_t)a,
                           mesh->points + 3 * (size_t)b, p->share, place);
        for (size_t k = 0; k < 3; ++k)
            if (place[k] != mesh->points[3 * (size_t)p->point + k])
                return false;
        c->used[p->point] = true;
        share = p->share;
        add_edge(chain, last, p->point);
        last = p->point;
    }
    add_edge(chain, last, b);
    return true;
}

/* Checks that all edges of chains are edges of the mesh. */
static icc_status check_edges(const check *c, const edge_chain *chain)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n_edges = 6 * mesh->n_simplices;
    iccp_tuples tuples;
    icc_status status =
        iccp_tuples_create(&tuples, chain->n + n_edges, 2, mesh->n_points, &mesh->memory);
    if (status != ICC_OK)
        return iccp_explain(c->err, status);
    uint32_t *to = tuples.vertices;
    memcpy(to, chain->edges, 2 * chain->n * sizeof *to);
    to += 2 * chain->n;
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        for (size_t i = 0; i < 4; ++i)
            for (size_t j = i + 1; j < 4; ++j, to += 2) {
                const uint32_t a = mesh->corners[4 * s + i], b = mesh->corners[4 * s + j];
                to[0] = a < b ? a : b;
                to[1] = a < b ? b : a;
            }
    iccp_tuples_sort(&tuples);
    for (size_t k = 0, end; k < tuples.n && status == ICC_OK; k = end) {
        end = iccp_tuples_end(&tuples, k);
        if (tuples.order[k] < chain->n && end - k == 1)
            status = iccp_fail(c->err, ICC_ERR_CERTIFICATE,
                               "a piece of a line is not an edge of the mesh");
    }
    iccp_tuples_free(&tuples);
    return status;
}

static icc_status check_lines(const check *c)
{
    const iccp_features *features = c->solid->features;
    size_t next = 0, n_segments = 0;
    bool sound = true;
    for (size_t f = 0; f < features->n; ++f)
        n_segments += features->item[f].kind == ICC_FEATURE_LINE ? features->item[f].n - 1 : 0;
    if (n_segments == 0)
        return c->mesh->n_on_lines == 0
                   ? ICC_OK
                   : iccp_fail(c->err, ICC_ERR_CERTIFICATE, "there are no lines");
    edge_chain chain = {
        iccp_alloc(&c->mesh->memory, n_segments + c->mesh->n_on_lines, 2 * sizeof *chain.edges), 0};
    if (chain.edges == NULL)
        return iccp_fail_memory(c->err);
    memset(c->used, 0, c->mesh->n_points * sizeof *c->used);
    for (size_t f = 0; f < features->n && sound; ++f) {
        const iccp_feature *item = &features->item[f];
        for (uint32_t i = 1; i < item->n && item->kind == ICC_FEATURE_LINE && sound; ++i)
            sound = follow_segment(c, &chain, item->first + i - 1, item->first + i, &next);
    }
    const icc_status status =
        sound && next == c->mesh->n_on_lines
            ? check_edges(c, &chain)
            : iccp_fail(c->err, ICC_ERR_CERTIFICATE, "the points on lines are not in order");
    iccp_free(&c->mesh->memory, chain.edges);
    return status;
}

/* ---- all ---- */

static icc_status check_mesh(const check *c, const iccp_env *env)
{
    iccp_simplices *mesh = c->mesh;
    if (mesh->n_points < c->solid->n_vertices)
        return iccp_fail(c->err, ICC_ERR_CERTIFICATE, "the mesh lacks vertices of the solid");
    icc_status status = iccp_simplices_check_corners(mesh, c->err);
    if (status == ICC_OK)
        status = check_positive(c);
    if (status == ICC_OK)
        status = check_points(c);
    if (status == ICC_OK)
        status = iccp_simplices_join(mesh, c->solid->n_facets, c->solid->facets, c->err);
    if (status == ICC_OK)
        status = iccp_explain(c->err, iccp_progress(env, "check", 0.5));
    if (status == ICC_OK)
        status = find_walls(c);
    if (status == ICC_OK)
        status = find_regions(c);
    return status == ICC_OK ? check_lines(c) : status;
}

static icc_status make_room(check *c)
{
    iccp_simplices *mesh = c->mesh;
    const iccp_memory *memory = &mesh->memory;
    const size_t n_walls = c->solid->features->n_places - c->solid->n_facets;
    mesh->n_boundary = c->solid->n_vertices;
    iccp_free(memory, mesh->given);
    iccp_free(memory, mesh->region);
    iccp_free(memory, mesh->across);
    mesh->across = NULL;
    mesh->given = iccp_alloc(memory, mesh->n_points, sizeof *mesh->given);
    mesh->region = iccp_alloc(memory, mesh->n_simplices, sizeof *mesh->region);
    c->first = iccp_alloc(memory, c->solid->n_vertices, sizeof *c->first);
    c->next = iccp_alloc(memory, n_walls, sizeof *c->next);
    c->wall = iccp_alloc(memory, 4 * mesh->n_simplices, sizeof *c->wall);
    c->queue = iccp_alloc(memory, mesh->n_simplices, sizeof *c->queue);
    c->used = iccp_alloc(memory, mesh->n_points, sizeof *c->used);
    return mesh->given != NULL && mesh->region != NULL && c->first != NULL && c->next != NULL &&
                   c->wall != NULL && c->queue != NULL && c->used != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

icc_status iccp_solid_mesh_check(const icc_domain *solid, iccp_simplices *mesh, const iccp_env *env,
                                 icc_error *err)
{
    check c = {.solid = solid, .mesh = mesh, .err = err};
    const iccp_memory memory = mesh->memory;
    icc_status status = iccp_explain(err, make_room(&c));
    if (status == ICC_OK)
        status = check_mesh(&c, env);
    iccp_free(&memory, c.first);
    iccp_free(&memory, c.next);
    iccp_free(&memory, c.wall);
    iccp_free(&memory, c.queue);
    iccp_free(&memory, c.used);
    for (uint32_t v = 0; status == ICC_OK && v < mesh->n_points; ++v)
        mesh->given[v] = v;
    return status;
}

icc_status iccp_domain_create_solid_mesh(icc_domain **out, const icc_domain *solid,
                                         iccp_simplices *mesh, const iccp_env *env, icc_error *err)
{
    *out = NULL;
    icc_status status = iccp_solid_mesh_check(solid, mesh, env, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_solid_domain_copy(out, solid, &env->memory));
    if (status != ICC_OK) {
        iccp_simplices_free(mesh);
        return status;
    }
    (*out)->mesh = mesh;
    return ICC_OK;
}
