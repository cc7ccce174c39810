/* Pieces of a mesh lie in one another, because their surfaces do not touch. The outermost piece has
 * the boundary vertex that comes first along the axes. From there each piece is found within the
 * one around it, and the facets between the two are its surface. */
#include "domain/mesh_regions.h"

#include "base/error.h"
#include "base/sort.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

typedef struct cut {
    iccp_simplices *mesh;
    const int32_t *regions;
    icc_error *err;
    size_t n_pieces;
    uint32_t *piece;  /* by simplex */
    uint32_t *queue;  /* the simplices of a piece */
    uint32_t *around; /* by piece: the piece around it; itself for the outermost one */
    uint32_t *rank;   /* by piece: number of its surface, or NONE */
    uint32_t *owner;  /* by point: number of its surface, or NONE */
    uint32_t *place;  /* by point: its new number */
} cut;

/* ---- pieces ---- */

static void flood(const cut *c, uint32_t first, uint32_t number)
{
    size_t n = 0;
    c->queue[n++] = first;
    c->piece[first] = number;
    for (size_t done = 0; done < n; ++done)
        for (size_t i = 0; i < 4; ++i) {
            const uint32_t across = c->mesh->across[4 * (size_t)c->queue[done] + i];
            if ((across & ICCP_ON_BOUNDARY) != 0 || c->piece[across / 4] != NONE ||
                c->regions[across / 4] != c->regions[first])
                continue;
            c->piece[across / 4] = number;
            c->queue[n++] = across / 4;
        }
}

static void find_pieces(cut *c)
{
    const uint32_t n = (uint32_t)c->mesh->n_simplices;
    for (uint32_t s = 0; s < n; ++s)
        c->piece[s] = NONE;
    for (uint32_t s = 0; s < n; ++s)
        if (c->piece[s] == NONE)
            flood(c, s, (uint32_t)c->n_pieces++);
}

static bool comes_before(const double *a, const double *b)
{
    for (int k = 0; k < 3; ++k)
        if (a[k] < b[k] || a[k] > b[k])
            return a[k] < b[k];
    return false;
}

/* Returns the piece at the first vertex of the boundary along the axes. */
static uint32_t find_outermost(const cut *c)
{
    const iccp_simplices *mesh = c->mesh;
    size_t first = 0;
    for (size_t v = 1; v < mesh->n_boundary; ++v)
        if (comes_before(mesh->points + 3 * v, mesh->points + 3 * first))
            first = v;
    for (size_t side = 0; side < 4 * mesh->n_simplices; ++side)
        for (size_t i = 1; i < 4 && (mesh->across[side] & ICCP_ON_BOUNDARY) != 0; ++i)
            if (mesh->corners[side - side % 4 + (side + i) % 4] == first)
                return c->piece[side / 4];
    return 0;
}

/* Returns true if the piece on the near side of a facet lies within the one beyond it. */
static bool is_outward(const cut *c, size_t side)
{
    const uint32_t across = c->mesh->across[side], own = c->piece[side / 4];
    return (across & ICCP_ON_BOUNDARY) == 0 && c->piece[across / 4] != own &&
           c->around[own] == c->piece[across / 4];
}

static void find_nesting(const cut *c)
{
    const iccp_simplices *mesh = c->mesh;
    bool changed = true;
    for (size_t p = 0; p < c->n_pieces; ++p)
        c->around[p] = NONE;
    const uint32_t outermost = find_outermost(c);
    c->around[outermost] = outermost;
    while (changed) {
        changed = false;
        for (size_t side = 0; side < 4 * mesh->n_simplices; ++side) {
            const uint32_t across = mesh->across[side];
            if ((across & ICCP_ON_BOUNDARY) != 0)
                continue;
            const uint32_t own = c->piece[side / 4], other = c->piece[across / 4];
            if (c->around[own] != NONE || c->around[other] == NONE)
                continue;
            c->around[own] = other;
            changed = true;
        }
    }
}

/* ---- surfaces ---- */

static bool is_less(const void *context, uint32_t a, uint32_t b)
{
    const int32_t *of_piece = context;
    return of_piece[a] < of_piece[b];
}

/* Numbers the surfaces. Pieces are in the order of their first cells. */
static icc_status rank_pieces(const cut *c)
{
    const iccp_memory *memory = &c->mesh->memory;
    int32_t *of_piece = iccp_alloc(memory, c->n_pieces, sizeof *of_piece);
    uint32_t *order = iccp_alloc(memory, c->n_pieces, 2 * sizeof *order), n = 0;
    if (of_piece != NULL && order != NULL) {
        for (size_t s = c->mesh->n_simplices; s-- > 0;)
            of_piece[c->piece[s]] = c->regions[s];
        for (uint32_t p = 0; p < c->n_pieces; ++p)
            order[p] = p;
        iccp_sort_indices(order, order + c->n_pieces, c->n_pieces, of_piece, is_less);
        for (size_t i = 0; i < c->n_pieces; ++i)
            c->rank[order[i]] = c->around[order[i]] == order[i] ? NONE : n++;
    }
    const bool is_there = of_piece != NULL && order != NULL;
    iccp_free(memory, of_piece);
    iccp_free(memory, order);
    return is_there ? ICC_OK : iccp_fail_memory(c->err);
}

static icc_status fail_point(const cut *c, uint32_t point, const char *what)
{
    const unsigned long given = c->mesh->given[point];
    return iccp_fail_at(c->err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)given,
                        "%s at vertex %lu: such a surface must be closed, and apart from the "
                        "others and from the boundary",
                        what, given);
}

/* Gives each point of a surface to it. Surfaces share no point, and none with the boundary. */
static icc_status own_points(const cut *c)
{
    const iccp_simplices *mesh = c->mesh;
    for (size_t v = 0; v < mesh->n_points; ++v)
        c->owner[v] = NONE;
    for (size_t side = 0; side < 4 * mesh->n_simplices; ++side) {
        const uint32_t across = mesh->across[side];
        if ((across & ICCP_ON_BOUNDARY) != 0 || c->piece[across / 4] == c->piece[side / 4])
            continue;
        const uint32_t inner = is_outward(c, side) ? c->piece[side / 4] : c->piece[across / 4];
        for (size_t i = 1; i < 4; ++i) {
            const uint32_t v = mesh->corners[side - side % 4 + (side + i) % 4];
            if (v < mesh->n_boundary)
                return fail_point(c, v, "a surface between regions touches the boundary");
            if (c->owner[v] != NONE && c->owner[v] != c->rank[inner])
                return fail_point(c, v, "two surfaces between regions touch");
            if (!is_outward(c, side) && !is_outward(c, across))
                return fail_point(c, v, "more than two regions meet");
            c->owner[v] = c->rank[inner];
        }
    }
    return ICC_OK;
}

/* ---- numbers of points ---- */

/* Counts the points and facets of each surface. */
static void count(const cut *c, iccp_region_surfaces *out, size_t *n_points, size_t *n_facets)
{
    *n_points = *n_facets = 0;
    for (size_t v = 0; v < c->mesh->n_points; ++v)
        if (c->owner[v] != NONE) {
            ++out->features[c->owner[v]].n_vertices;
            ++*n_points;
        }
    for (size_t side = 0; side < 4 * c->mesh->n_simplices; ++side)
        if (is_outward(c, side)) {
            ++out->features[c->rank[c->piece[side / 4]]].n_facets;
            ++*n_facets;
        }
}

/* Gives each surface its room in the arrays, which it fills from the beginning. */
static void list_surfaces(const cut *c, iccp_region_surfaces *out, const double *given)
{
    const iccp_simplices *mesh = c->mesh;
    double *vertices = out->vertices;
    uint32_t *facets = out->facets;
    for (size_t f = 0; f < out->n; ++f) {
        icc_feature *feature = &out->features[f];
        feature->vertices = vertices;
        feature->facets = facets;
        vertices += 3 * feature->n_vertices;
        facets += 3 * feature->n_facets;
        feature->n_vertices = feature->n_facets = 0;
    }
    for (size_t v = 0; v < mesh->n_points; ++v) {
        if (c->owner[v] == NONE)
            continue;
        icc_feature *feature = &out->features[c->owner[v]];
        c->place[v] = (uint32_t)feature->n_vertices;
        const size_t at = (size_t)(feature->vertices - out->vertices) + 3 * feature->n_vertices++;
        memcpy(out->vertices + at, given + 3 * (size_t)mesh->given[v], 3 * sizeof *given);
    }
    for (size_t side = 0; side < 4 * mesh->n_simplices; ++side) {
        if (!is_outward(c, side))
            continue;
        icc_feature *feature = &out->features[c->rank[c->piece[side / 4]]];
        uint32_t *to = out->facets + (feature->facets - out->facets) + 3 * feature->n_facets++;
        iccp_simplices_side(mesh, side, to);
        for (size_t i = 0; i < 3; ++i)
            to[i] = c->place[to[i]];
    }
}

/* Moves the points of surfaces after those of the boundary. */
static icc_status move_points(const cut *c, const iccp_region_surfaces *out)
{
    iccp_simplices *mesh = c->mesh;
    double *points = iccp_alloc(&mesh->memory, mesh->n_points, 3 * sizeof *points);
    if (points == NULL)
        return iccp_fail_memory(c->err);
    uint32_t next = (uint32_t)mesh->n_boundary;
    for (size_t f = 0; f < out->n; ++f)
        next += (uint32_t)out->features[f].n_vertices;
    for (uint32_t v = 0; v < mesh->n_points; ++v)
        if (v < mesh->n_boundary)
            c->place[v] = v;
        else if (c->owner[v] == NONE)
            c->place[v] = next++;
        else
            c->place[v] +=
                (uint32_t)(mesh->n_boundary +
                           (size_t)(out->features[c->owner[v]].vertices - out->vertices) / 3);
    for (size_t v = 0; v < mesh->n_points; ++v)
        memcpy(points + 3 * (size_t)c->place[v], mesh->points + 3 * v, 3 * sizeof *points);
    for (size_t i = 0; i < 4 * mesh->n_simplices; ++i)
        mesh->corners[i] = c->place[mesh->corners[i]];
    iccp_free(&mesh->memory, mesh->points);
    mesh->points = points;
    return ICC_OK;
}

/* ---- all ---- */

static icc_status make_surfaces(const cut *c, iccp_region_surfaces *out, const double *given)
{
    const iccp_memory *memory = &out->memory;
    size_t n_points, n_facets;
    out->n = c->n_pieces - 1;
    out->features = iccp_alloc_zero(memory, out->n, sizeof *out->features);
    if (out->features == NULL)
        return iccp_fail_memory(c->err);
    for (size_t f = 0; f < out->n; ++f) {
        out->features[f].size = sizeof *out->features;
        out->features[f].kind = ICC_FEATURE_REGION;
    }
    count(c, out, &n_points, &n_facets);
    out->vertices = iccp_alloc(memory, n_points, 3 * sizeof *out->vertices);
    out->facets = iccp_alloc(memory, n_facets, 3 * sizeof *out->facets);
    if (out->vertices == NULL || out->facets == NULL)
        return iccp_fail_memory(c->err);
    list_surfaces(c, out, given);
    return move_points(c, out);
}

static icc_status cut_mesh(cut *c, iccp_region_surfaces *out, const double *given)
{
    const iccp_memory *memory = &c->mesh->memory;
    find_pieces(c);
    if (c->n_pieces == 1)
        return ICC_OK;
    c->around = iccp_alloc(memory, c->n_pieces, sizeof *c->around);
    c->rank = iccp_alloc(memory, c->n_pieces, sizeof *c->rank);
    if (c->around == NULL || c->rank == NULL)
        return iccp_fail_memory(c->err);
    find_nesting(c);
    icc_status status = rank_pieces(c);
    if (status == ICC_OK)
        status = own_points(c);
    return status == ICC_OK ? make_surfaces(c, out, given) : status;
}

icc_status iccp_region_surfaces_create(iccp_region_surfaces *out, iccp_simplices *mesh,
                                       const int32_t *regions, const double *given, icc_error *err)
{
    const iccp_memory memory = mesh->memory;
    cut c = {.mesh = mesh, .regions = regions, .err = err};
    *out = (iccp_region_surfaces){.memory = memory};
    c.piece = iccp_alloc(&memory, mesh->n_simplices, sizeof *c.piece);
    c.queue = iccp_alloc(&memory, mesh->n_simplices, sizeof *c.queue);
    c.owner = iccp_alloc(&memory, mesh->n_points, sizeof *c.owner);
    c.place = iccp_alloc(&memory, mesh->n_points, sizeof *c.place);
    const icc_status status =
        c.piece != NULL && c.queue != NULL && c.owner != NULL && c.place != NULL
            ? cut_mesh(&c, out, given)
            : iccp_fail_memory(err);
    iccp_free(&memory, c.piece);
    iccp_free(&memory, c.queue);
    iccp_free(&memory, c.around);
    iccp_free(&memory, c.rank);
    iccp_free(&memory, c.owner);
    iccp_free(&memory, c.place);
    if (status != ICC_OK)
        iccp_region_surfaces_free(out);
    return status;
}

void iccp_region_surfaces_free(iccp_region_surfaces *surfaces)
{
    const iccp_memory memory = surfaces->memory;
    iccp_free(&memory, surfaces->features);
    iccp_free(&memory, surfaces->vertices);
    iccp_free(&memory, surfaces->facets);
    *surfaces = (iccp_region_surfaces){.memory = memory};
}
