/* Bisects simplices at their chords, one after the other in the order of the chords' numbers. J. M.
 * Maubach, SIAM J. Sci. Comput. 16, 1995, orders the edges of a simplex for the same reason. Two
 * simplices cut their common facet in the same way, because chords outside it do not affect it. */
#include "map/solid/solid_chords.h"

#include "geometry/tuples.h"
#include "math/orient.h"

#include <string.h>

/* Every cut leaves two pieces with fewer chords, and one of them waits. */
enum { CORNERS = ICC_MAX_DIM + 1, WAITING = CORNERS * (CORNERS - 1) / 2 + 1 };

static const uint32_t NONE = UINT32_MAX;

/* A simplex or a piece of one: the numbers of the chords between its corners, or NONE. */
typedef struct piece {
    uint32_t corner[CORNERS];
    uint32_t chord[CORNERS][CORNERS];
} piece;

typedef struct cutter {
    const iccp_simplices *mesh;
    const uint32_t *facets;
    size_t n; /* corners of a simplex */
    iccp_tuples
        edges; /* edges of the facets, then those of each simplex between points of the boundary */
    size_t n_facet_edges;
    uint32_t *owner; /* of the latter: the simplex, and the corners i < j as n i + j */
    uint32_t *chord; /* of each edge in `edges`: its chord's number, or NONE */
    size_t n_chords;
    uint32_t *first; /* n_simplices + 1: the first edge of each simplex */
    iccp_simplices *out;
} cutter;

static size_t count_rim_edges(const cutter *c, size_t s)
{
    size_t n_rim = 0;
    for (size_t i = 0; i < c->n; ++i)
        n_rim += c->mesh->corners[c->n * s + i] < c->mesh->n_boundary;
    return n_rim * (n_rim - 1) / 2 * (n_rim > 1);
}

static void put_edge(cutter *c, size_t place, uint32_t a, uint32_t b)
{
    c->edges.vertices[2 * place] = a < b ? a : b;
    c->edges.vertices[2 * place + 1] = a < b ? b : a;
}

static void list_edges(cutter *c)
{
    const size_t dim = c->mesh->dim;
    size_t place = 0;
    for (size_t f = 0; f < c->mesh->n_facets; ++f)
        for (size_t i = 0; i < dim; ++i)
            for (size_t j = i + 1; j < dim; ++j)
                put_edge(c, place++, c->facets[dim * f + i], c->facets[dim * f + j]);
    for (size_t s = 0; s < c->mesh->n_simplices; ++s) {
        const uint32_t *v = c->mesh->corners + c->n * s;
        for (size_t i = 0; i < c->n; ++i)
            for (size_t j = i + 1; j < c->n; ++j)
                if (v[i] < c->mesh->n_boundary && v[j] < c->mesh->n_boundary) {
                    c->owner[place - c->n_facet_edges] = (uint32_t)(c->n * i + j);
                    put_edge(c, place++, v[i], v[j]);
                }
    }
}

/* Numbers the edges that belong to no facet: these are the chords. */
static void number_chords(cutter *c)
{
    iccp_tuples_sort(&c->edges);
    for (size_t begin = 0; begin < c->edges.n;) {
        const size_t end = iccp_tuples_end(&c->edges, begin);
        bool is_chord = true;
        for (size_t k = begin; k < end; ++k)
            is_chord = is_chord && c->edges.order[k] >= c->n_facet_edges;
        for (; begin < end; ++begin)
            c->chord[c->edges.order[begin]] = is_chord ? (uint32_t)c->n_chords : NONE;
        c->n_chords += is_chord;
    }
}

/* Lists the edges of the facets, then those of each simplex between points of the boundary. Sorting
 * brings equal edges together. */
static icc_status find_chords(cutter *c, const iccp_env *env)
{
    const size_t dim = c->mesh->dim, n_simplices = c->mesh->n_simplices;
    c->n_facet_edges = c->mesh->n_facets * (dim * (dim - 1) / 2);
    c->first = iccp_alloc(&env->memory, n_simplices + 1, sizeof *c->first);
    if (c->first == NULL)
        return ICC_ERR_MEMORY;
    size_t n_edges = c->n_facet_edges;
    for (size_t s = 0; s < n_simplices; ++s) {
        c->first[s] = (uint32_t)n_edges;
        n_edges += count_rim_edges(c, s);
    }
    c->first[n_simplices] = (uint32_t)n_edges;
    c->owner = iccp_alloc(&env->memory, n_edges, sizeof *c->owner);
    c->chord = iccp_alloc(&env->memory, n_edges, sizeof *c->chord);
    icc_status status = c->owner != NULL && c->chord != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_tuples_create(&c->edges, n_edges, 2, c->mesh->n_boundary, &env->memory);
    if (status == ICC_OK) {
        list_edges(c);
        number_chords(c);
    }
    return status;
}

static void set_piece(const cutter *c, size_t s, piece *p)
{
    memset(p->chord, 0xff, sizeof p->chord);
    memcpy(p->corner, c->mesh->corners + c->n * s, c->n * sizeof *p->corner);
    for (size_t e = c->first[s]; e < c->first[s + 1]; ++e) {
        const size_t ends = c->owner[e - c->n_facet_edges], i = ends / c->n, j = ends % c->n;
        p->chord[i][j] = p->chord[j][i] = c->chord[e];
    }
}

/* Finds the first chord of a piece. Returns false if there is none. */
static bool find_first(const cutter *c, const piece *p, size_t *a, size_t *b)
{
    uint32_t least = NONE;
    for (size_t i = 0; i < c->n; ++i)
        for (size_t j = i + 1; j < c->n; ++j)
            if (p->chord[i][j] < least) {
                least = p->chord[i][j];
                *a = i;
                *b = j;
            }
    return least != NONE;
}

static void replace(const cutter *c, piece *p, size_t corner, uint32_t point)
{
    p->corner[corner] = point;
    for (size_t i = 0; i < c->n; ++i)
        p->chord[corner][i] = p->chord[i][corner] = NONE;
}

/* Writes the pieces of one simplex to `corners`, unless that is NULL. Returns their number. */
static size_t cut(const cutter *c, size_t s, uint32_t *corners)
{
    piece stack[WAITING];
    size_t n_stack = 1, n_pieces = 0, a, b;
    set_piece(c, s, &stack[0]);
    while (n_stack > 0) {
        piece *p = &stack[n_stack - 1];
        if (find_first(c, p, &a, &b)) {
            const uint32_t middle = (uint32_t)c->mesh->n_points + p->chord[a][b];
            stack[n_stack] = *p;
            replace(c, p, a, middle);
            replace(c, &stack[n_stack++], b, middle);
            continue;
        }
        if (corners != NULL)
            memcpy(corners + c->n * n_pieces, p->corner, c->n * sizeof *corners);
        ++n_pieces;
        --n_stack;
    }
    return n_pieces;
}

static void place_middles(const cutter *c)
{
    const size_t dim = c->mesh->dim;
    for (size_t e = c->n_facet_edges; e < c->edges.n; ++e) {
        if (c->chord[e] == NONE)
            continue;
        const double *p = c->mesh->points + dim * c->edges.vertices[2 * e];
        const double *q = c->mesh->points + dim * c->edges.vertices[2 * e + 1];
        for (size_t k = 0; k < dim; ++k)
            c->out->points[dim * (c->mesh->n_points + c->chord[e]) + k] = 0.5 * p[k] + 0.5 * q[k];
    }
}

static bool all_positive(const iccp_simplices *mesh)
{
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const double *corner[CORNERS];
        for (size_t i = 0; i <= mesh->dim; ++i)
            corner[i] = iccp_corner_point(mesh, (mesh->dim + 1) * s + i);
        if (iccp_orient(mesh->dim, corner) != 1)
            return false;
    }
    return true;
}

/* Cuts every simplex twice: first to count the pieces, then to write them. */
static icc_status cut_simplices(cutter *c, const iccp_env *env)
{
    const size_t dim = c->mesh->dim;
    iccp_simplices *out = c->out;
    *out = (iccp_simplices){.memory = env->memory,
                            .dim = dim,
                            .n_points = c->mesh->n_points + c->n_chords,
                            .n_boundary = c->mesh->n_boundary};
    for (size_t s = 0; s < c->mesh->n_simplices; ++s)
        out->n_simplices += cut(c, s, NULL);
    out->points = iccp_alloc(&env->memory, out->n_points, dim * sizeof *out->points);
    out->corners = iccp_alloc(&env->memory, out->n_simplices, c->n * sizeof *out->corners);
    if (out->points == NULL || out->corners == NULL)
        return ICC_ERR_MEMORY;
    memcpy(out->points, c->mesh->points, c->mesh->n_points * dim * sizeof *out->points);
    place_middles(c);
    size_t n = 0;
    for (size_t s = 0; s < c->mesh->n_simplices; ++s)
        n += cut(c, s, out->corners + c->n * n);
    return ICC_OK;
}

icc_status iccp_solid_cut_chords(iccp_simplices **out, const iccp_simplices *mesh,
                                 const uint32_t *facets, const iccp_env *env)
{
    cutter c = {.mesh = mesh, .facets = facets, .n = mesh->dim + 1};
    *out = NULL;
    c.edges.memory = env->memory;
    icc_status status = find_chords(&c, env);
    if (status == ICC_OK && c.n_chords > 0) {
        c.out = iccp_alloc_zero(&env->memory, 1, sizeof *c.out);
        status = c.out != NULL ? cut_simplices(&c, env) : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK && c.out != NULL && all_positive(c.out)) {
        status = iccp_simplices_join(c.out, mesh->n_facets, facets, NULL);
        *out = status == ICC_OK ? c.out : NULL;
    }
    if (*out == NULL)
        iccp_simplices_free(c.out);
    iccp_tuples_free(&c.edges);
    iccp_free(&env->memory, c.first);
    iccp_free(&env->memory, c.owner);
    iccp_free(&env->memory, c.chord);
    return status;
}
