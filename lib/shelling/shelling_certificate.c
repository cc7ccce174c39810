/* Checks the theorem of docs/theory/charts-space.md, "foliations of simplices", hypothesis by
 * hypothesis. A face is a set of vertices. It is examined at its smallest vertex, among the
 * simplices there. */
#include "shelling/shelling_certificate.h"

#include "base/sort.h"
#include "icc/icc.h"
#include "math/orient.h"

#include <math.h>
#include <string.h>

enum { CORNERS = ICC_MAX_DIM + 1, OTHERS = ICC_MAX_DIM - 2, REPORT = 4096 };

/* Sets of corners of a simplex, or of the sides opposite to them. */
typedef struct sets {
    uint8_t in, out, boundary;
    uint8_t centre; /* empty for simplices outside the star */
} sets;

/* A face whose smallest vertex is the vertex that is being examined. */
typedef struct face {
    uint32_t others[OTHERS]; /* the other vertices, ascending, then UINT32_MAX */
    uint32_t n_in, n_out;
    bool used, at_star, on_boundary;
} face;

typedef struct checker {
    const iccp_simplices *mesh;
    const uint32_t *facets;
    uint32_t centre;
    const uint32_t *rank;
    const double *direction;
    iccp_shelling_certificate *found;
    sets *sets;       /* of each simplex */
    uint32_t *first;  /* n_points + 1: where the simplices of each vertex begin in `around` */
    uint32_t *around; /* simplices */
    face *table;      /* open addressing; `capacity` is a power of two */
    uint32_t *used;   /* used places of the table */
    size_t capacity, n_used;
} checker;

bool iccp_shelling_certificate_holds(const iccp_shelling_certificate *c)
{
    return c->n_inverted == 0 && c->n_topology == 0 && c->n_order == 0 && c->n_irregular == 0 &&
           c->n_directions == 0;
}

static const uint32_t *corners_of(const checker *c, size_t simplex)
{
    return c->mesh->corners + (c->mesh->dim + 1) * simplex;
}

/* ---- the mesh ---- */

/* Returns false if a corner is not a point of the mesh, because nothing else can be checked
 * then. */
static bool check_simplices(const checker *c)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n = mesh->dim + 1;
    for (size_t i = 0; i < n * mesh->n_simplices; ++i)
        c->found->n_topology += mesh->corners[i] >= mesh->n_points;
    for (size_t s = 0; s < mesh->n_simplices && c->found->n_topology == 0; ++s) {
        const double *points[CORNERS];
        for (size_t i = 0; i < n; ++i)
            points[i] = iccp_corner_point(mesh, n * s + i);
        c->found->n_inverted += iccp_orient(mesh->dim, points) != 1;
    }
    return c->found->n_topology == 0;
}

/* Returns true if two positive simplices lie on opposite sides of a facet. Replace the second's
 * corner opposite to the facet by the first's. The result must be an odd permutation of the
 * first's corners. */
static bool is_joined(const checker *c, uint32_t side, uint32_t twin)
{
    const uint32_t n = (uint32_t)c->mesh->dim + 1;
    const uint32_t *own = corners_of(c, side / n), *other = corners_of(c, twin / n);
    uint32_t at[CORNERS];
    size_t n_exchanged = 0;
    for (uint32_t j = 0; j < n; ++j) {
        const uint32_t wanted = j == twin % n ? own[side % n] : other[j];
        at[j] = 0;
        while (at[j] < n && own[at[j]] != wanted)
            ++at[j];
        if (at[j] == n)
            return false;
        for (uint32_t k = 0; k < j; ++k)
            n_exchanged += at[k] > at[j];
    }
    return n_exchanged % 2 == 1;
}

static bool is_on_facet(const checker *c, uint32_t side, uint32_t facet)
{
    const size_t dim = c->mesh->dim, n = dim + 1;
    const uint32_t *own = corners_of(c, side / n), *ends = c->facets + dim * facet;
    for (size_t i = 0; i < n; ++i) {
        bool shared = i == side % n;
        for (size_t k = 0; k < dim; ++k)
            shared = shared || own[i] == ends[k];
        if (!shared)
            return false;
    }
    return true;
}

/* Checks the sides, and marks the facets that have one in `met`. */
static void check_sides(const checker *c, uint8_t *met)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n_sides = (mesh->dim + 1) * mesh->n_simplices;
    for (uint32_t side = 0; side < n_sides; ++side) {
        const uint32_t twin = mesh->across[side], facet = twin & ~ICCP_ON_BOUNDARY;
        bool good;
        if ((twin & ICCP_ON_BOUNDARY) == 0) {
            good = twin < n_sides && mesh->across[twin] == side &&
                   iccp_simplex_of(mesh, twin) != iccp_simplex_of(mesh, side) &&
                   is_joined(c, side, twin);
        } else {
            good = facet < mesh->n_facets && met[facet] == 0 && is_on_facet(c, side, facet);
            if (good)
                met[facet] = 1;
        }
        c->found->n_topology += !good;
    }
    for (size_t f = 0; f < mesh->n_facets; ++f)
        c->found->n_topology += met[f] == 0;
}

static void check_centre(const checker *c)
{
    const iccp_simplices *mesh = c->mesh;
    bool inside = false;
    for (size_t s = 0; s < mesh->n_simplices; ++s)
        inside = inside || c->sets[s].centre != 0;
    for (size_t i = 0; i < mesh->dim * mesh->n_facets; ++i)
        inside = inside && c->facets[i] != c->centre;
    c->found->n_topology += !inside;
}

/* ---- the order ---- */

/* Fills in the sides by which leaves enter and leave a simplex. They enter from simplices of
 * greater rank and the boundary, and leave to simplices of smaller rank. Returns true if a
 * neighbour has the same rank. */
static bool fill_sets(const checker *c, uint32_t s)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n = mesh->dim + 1;
    const uint32_t *v = corners_of(c, s);
    sets *set = &c->sets[s];
    bool tied = false;
    *set = (sets){0};
    for (size_t i = 0; i < n; ++i)
        if (v[i] == c->centre)
            set->centre = (uint8_t)(1u << i);
    for (size_t i = 0; i < n; ++i) {
        const uint32_t twin = mesh->across[n * s + i];
        const uint8_t bit = (uint8_t)(1u << i);
        const bool boundary = (twin & ICCP_ON_BOUNDARY) != 0;
        const uint32_t rank = boundary ? UINT32_MAX : c->rank[iccp_simplex_of(mesh, twin)];
        set->boundary |= boundary ? bit : 0;
        set->in |= boundary || rank > c->rank[s] ? bit : 0;
        set->out |= !boundary && rank < c->rank[s] ? bit : 0;
        tied = tied || (!boundary && rank == c->rank[s]);
    }
    return tied;
}

/* Checks each simplex alone: its rank, that leaves both enter and leave it, and that its
 * direction agrees with the order. */
static void check_order(const checker *c)
{
    const size_t n = c->mesh->dim + 1;
    for (uint32_t s = 0; s < c->mesh->n_simplices; ++s) {
        const bool tied = fill_sets(c, s);
        const sets *set = &c->sets[s];
        if (set->centre != 0) {
            c->found->n_order += c->rank[s] != 0;
            continue;
        }
        c->found->n_order += tied || c->rank[s] == 0 || set->in == 0 || set->out == 0;
        bool agrees = true;
        for (size_t i = 0; i < n; ++i) {
            const double rate = c->direction[n * s + i];
            const bool enters = (set->in >> i & 1) != 0;
            agrees = agrees && isfinite(rate) && (enters ? rate > 0 : rate < 0);
        }
        c->found->n_directions += !agrees;
    }
}

/* ---- faces ---- */

static icc_status list_around(checker *c, const iccp_memory *memory)
{
    const iccp_simplices *mesh = c->mesh;
    const size_t n_sides = (mesh->dim + 1) * mesh->n_simplices;
    size_t most = 0;
    c->first = iccp_alloc_zero(memory, mesh->n_points + 1, sizeof *c->first);
    c->around = iccp_alloc(memory, n_sides, sizeof *c->around);
    if (c->first == NULL || c->around == NULL)
        return ICC_ERR_MEMORY;
    iccp_list_groups(c->around, c->first, mesh->n_points, mesh->corners, mesh->n_simplices,
                     mesh->dim + 1);
    for (size_t v = 0; v < mesh->n_points; ++v)
        most = c->first[v + 1] - c->first[v] > most ? c->first[v + 1] - c->first[v] : most;
    /* At most 2^dim faces of a simplex have a given smallest vertex. */
    for (c->capacity = 16; c->capacity < most << mesh->dim;)
        c->capacity *= 2;
    c->table = iccp_alloc_zero(memory, c->capacity, sizeof *c->table);
    c->used = iccp_alloc(memory, c->capacity, sizeof *c->used);
    return c->table != NULL && c->used != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Finds a face in the table, or adds it. */
static face *find_face(checker *c, const uint32_t *others)
{
    uint64_t hash = 0;
    for (size_t k = 0; k < OTHERS; ++k)
        hash = (hash ^ others[k]) * 0x9e3779b97f4a7c15u;
    for (size_t at = (size_t)(hash >> 32) & (c->capacity - 1);; at = (at + 1) & (c->capacity - 1)) {
        face *f = &c->table[at];
        if (!f->used) {
            *f = (face){.used = true};
            memcpy(f->others, others, sizeof f->others);
            c->used[c->n_used++] = (uint32_t)at;
            return f;
        }
        if (memcmp(f->others, others, sizeof f->others) == 0)
            return f;
    }
}

/* Adds one face of a simplex, given as a set of its corners. */
static void add_face(checker *c, const sets *set, unsigned corners, const uint32_t *others)
{
    face *f = find_face(c, others);
    f->on_boundary = f->on_boundary || (set->boundary & ~corners) != 0;
    if (set->centre != 0) {
        f->at_star = true;
        return;
    }
    f->n_in += (set->out & ~corners) == 0;
    f->n_out += (set->in & ~corners) == 0;
}

/* Adds all faces of a simplex of dimension up to dim - 2 whose smallest vertex is v, without
 * those at the centre. */
static void add_faces(checker *c, uint32_t simplex, uint32_t v)
{
    const size_t dim = c->mesh->dim;
    const uint32_t *given = corners_of(c, simplex);
    uint32_t greater[CORNERS], bit[CORNERS], n = 0, own = 0;
    for (uint32_t i = 0; i <= dim; ++i) {
        if (given[i] == v)
            own = 1u << i;
        if (given[i] <= v || given[i] == c->centre)
            continue;
        uint32_t k = n++;
        for (; k > 0 && greater[k - 1] > given[i]; --k) {
            greater[k] = greater[k - 1];
            bit[k] = bit[k - 1];
        }
        greater[k] = given[i];
        bit[k] = 1u << i;
    }
    for (uint32_t subset = 0; subset < 1u << n; ++subset) {
        uint32_t others[OTHERS + 1], corners = own, size = 0;
        for (uint32_t k = 0; k < n && size + 1 < dim; ++k)
            if ((subset >> k & 1) != 0) {
                others[size++] = greater[k];
                corners |= bit[k];
            }
        if (size + 1 >= dim)
            continue;
        for (; size < OTHERS; ++size)
            others[size] = UINT32_MAX;
        add_face(c, &c->sets[simplex], corners, others);
    }
}

static void check_faces_at(checker *c, uint32_t v)
{
    c->n_used = 0;
    for (uint32_t i = c->first[v]; i < c->first[v + 1]; ++i)
        add_faces(c, c->around[i], v);
    for (size_t i = 0; i < c->n_used; ++i) {
        face *f = &c->table[c->used[i]];
        c->found->n_irregular += f->n_in + f->at_star != 1 || f->n_out != (f->on_boundary ? 0 : 1);
        f->used = false;
    }
}

static icc_status check(checker *c, uint8_t *met, const iccp_env *env)
{
    if (!check_simplices(c))
        return ICC_OK;
    check_sides(c, met);
    if (c->found->n_topology != 0)
        return ICC_OK;
    check_order(c);
    check_centre(c);
    icc_status status = list_around(c, &env->memory);
    for (uint32_t v = 0; status == ICC_OK && v < c->mesh->n_points; ++v) {
        if (v % REPORT == 0)
            status = iccp_progress(env, "check", (double)v / (double)c->mesh->n_points);
        if (status == ICC_OK && v != c->centre)
            check_faces_at(c, v);
    }
    return status;
}

icc_status iccp_certify_shelling(iccp_shelling_certificate *certificate, const iccp_simplices *mesh,
                                 const uint32_t *facets, uint32_t centre, const uint32_t *rank,
                                 const double *direction, const iccp_env *env)
{
    *certificate = (iccp_shelling_certificate){0};
    checker c = {.mesh = mesh,
                 .facets = facets,
                 .centre = centre,
                 .rank = rank,
                 .direction = direction,
                 .found = certificate};
    uint8_t *met = iccp_alloc_zero(&env->memory, mesh->n_facets, 1);
    c.sets = iccp_alloc(&env->memory, mesh->n_simplices, sizeof *c.sets);
    icc_status status = met != NULL && c.sets != NULL ? check(&c, met, env) : ICC_ERR_MEMORY;
    iccp_free(&env->memory, met);
    iccp_free(&env->memory, c.sets);
    iccp_free(&env->memory, c.first);
    iccp_free(&env->memory, c.around);
    iccp_free(&env->memory, c.table);
    iccp_free(&env->memory, c.used);
    return status;
}
