/* Orders of simplices: every complete one is checked against the definition, on cubes, boxes with
 * wells and houses with two rooms, coarse and finer, in 2 to 6 dimensions. The checker knows the
 * faces of a simplex as lists of vertices, and nothing of how orders are found. */
#include "base/error.h"
#include "base/heap.h"
#include "domain/domain.h"
#include "shelling/best_order.h"
#include "shelling/reverse.h"

#include "../../default_env.h"
#include "../../faulty.h"
#include "../../meshes.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* ------------------------------------------------------------------ meshes */

static void *room(size_t n, size_t size)
{
    void *memory = calloc(n + 1, size);
    ck_assert_ptr_nonnull(memory);
    return memory;
}

/* A box with a square well of width 1 down to the last layer. */
static int has_no_well(int32_t dim, const size_t *cell)
{
    bool in_well = cell[dim - 1] > 0;
    for (int32_t k = 0; k + 1 < dim; ++k)
        in_well = in_well && cell[k] == 2;
    return !in_well;
}

/* Bing's house with two rooms: the room above is entered from below through a shaft in the room
 * below, and the other way round; each shaft hangs on a wall. 11 x 11 x 5 cells. */
static int in_house(const size_t *cell, size_t fine)
{
    const int x = (int)(cell[0] / fine), y = (int)(cell[1] / fine), z = (int)(cell[2] / fine);
    const int shaft = z < 2 ? 3 : 7, wing = z < 2 ? 1 : 9; /* z == 2: both */
    const bool hole = (z <= 2 && x == 3 && y == 5) || (z >= 2 && x == 7 && y == 5);
    const bool shell = x % 10 == 0 || y % 10 == 0 || z % 2 == 0;
    return z < 5 && !hole &&
           (shell || (abs(x - shaft) <= 1 && abs(y - 5) <= 1) || (x == wing && y == 5));
}

/* Along one side, then another, and so on. */
static int is_snake(int32_t dim, const size_t *cell)
{
    return dim == 3 && (cell[0] % 2 == 0 || cell[1] == (cell[0] % 4 == 1 ? 0 : 3)) && cell[2] < 2;
}

static int in_house_2(int32_t dim, const size_t *cell)
{
    return dim == 3 && in_house(cell, 2);
}

/* Cuts all simplices at an edge in two at its middle, where a new vertex is. There is room for
 * them. */
static void split_edge(test_mesh *m, uint32_t a, uint32_t b)
{
    const size_t dim = (size_t)m->dim, n_corners = dim + 1, n_before = m->n_simplices;
    for (size_t k = 0; k < dim; ++k)
        m->vertices[dim * m->n_vertices + k] =
            (m->vertices[dim * a + k] + m->vertices[dim * b + k]) / 2;
    for (size_t s = 0; s < n_before; ++s) {
        uint32_t *first = m->simplices + n_corners * s;
        size_t at_a = n_corners, at_b = n_corners;
        for (size_t i = 0; i < n_corners; ++i) {
            at_a = first[i] == a ? i : at_a;
            at_b = first[i] == b ? i : at_b;
        }
        if (at_a == n_corners || at_b == n_corners)
            continue;
        uint32_t *second = m->simplices + n_corners * m->n_simplices++;
        memcpy(second, first, n_corners * sizeof *first);
        first[at_a] = second[at_b] = (uint32_t)m->n_vertices;
    }
    ++m->n_vertices;
}

/* Splits n edges by chance. The mesh is ended. */
static test_mesh split_edges(test_mesh m, random_source *r, size_t n)
{
    const size_t n_corners = (size_t)m.dim + 1;
    test_mesh out = mesh_of(m.dim, m.n_vertices + n, m.n_simplices);
    memcpy(out.vertices, m.vertices, m.n_vertices * (size_t)m.dim * sizeof *m.vertices);
    memcpy(out.simplices, m.simplices, m.n_simplices * n_corners * sizeof *m.simplices);
    out.n_vertices = m.n_vertices;
    mesh_free(&m);
    for (size_t room_left = 0; n > 0; --n) {
        if (room_left < out.n_simplices) {
            room_left = 4 * out.n_simplices;
            out.simplices = realloc(out.simplices, (out.n_simplices + room_left) * n_corners *
                                                       sizeof *out.simplices);
            ck_assert_ptr_nonnull(out.simplices);
        }
        const size_t before = out.n_simplices, s = (size_t)random_below(r, (int)before);
        const size_t i = (size_t)random_below(r, (int)n_corners);
        const size_t j = (i + 1 + (size_t)random_below(r, out.dim)) % n_corners;
        split_edge(&out, out.simplices[n_corners * s + i], out.simplices[n_corners * s + j]);
        room_left -= out.n_simplices - before;
    }
    return out;
}

static test_mesh cube(int32_t dim, size_t n)
{
    return mesh_cells(dim, n, NULL);
}

/* ----------------------------------------------------------------- checker */

typedef struct tuple {
    uint32_t vertex[ICC_MAX_DIM + 1]; /* ascending, filled up with NONE */
    uint32_t owner;
} tuple;

static int compare(const void *a, const void *b)
{
    const tuple *s = a, *t = b;
    for (int i = 0; i <= ICC_MAX_DIM; ++i)
        if (s->vertex[i] != t->vertex[i])
            return s->vertex[i] < t->vertex[i] ? -1 : 1;
    return 0;
}

/* The corners of a simplex that are in a set, as a tuple. */
static tuple face_tuple(const iccp_simplices *m, size_t s, unsigned set, uint32_t owner)
{
    tuple t = {.owner = owner};
    size_t n = 0;
    for (size_t i = 0; i <= m->dim; ++i)
        if (set >> i & 1) {
            size_t at = n++;
            const uint32_t v = m->corners[(m->dim + 1) * s + i];
            for (; at > 0 && t.vertex[at - 1] > v; --at)
                t.vertex[at] = t.vertex[at - 1];
            t.vertex[at] = v;
        }
    for (; n <= ICC_MAX_DIM; ++n)
        t.vertex[n] = NONE;
    return t;
}

/* All faces of all simplices, numbered. */
typedef struct catalogue {
    size_t n_faces;
    uint32_t *number; /* of each simplex and set of corners */
    uint8_t *size;    /* of each face */
} catalogue;

static catalogue list_faces(const iccp_simplices *m)
{
    const size_t n_sets = (size_t)2 << m->dim;
    tuple *t = room(n_sets * m->n_simplices, sizeof *t);
    catalogue c = {0, room(n_sets * m->n_simplices, sizeof *c.number), NULL};
    for (size_t k = 0; k < n_sets * m->n_simplices; ++k)
        t[k] = face_tuple(m, k / n_sets, (unsigned)(k % n_sets), (uint32_t)k);
    qsort(t, n_sets * m->n_simplices, sizeof *t, compare);
    c.size = room(n_sets * m->n_simplices, sizeof *c.size);
    for (size_t k = 0; k < n_sets * m->n_simplices; ++k) {
        c.n_faces += k > 0 && compare(&t[k - 1], &t[k]) != 0;
        c.number[t[k].owner] = (uint32_t)c.n_faces;
        for (uint8_t i = 0; i <= m->dim && t[k].vertex[i] != NONE; ++i)
            c.size[c.n_faces] = (uint8_t)(i + 1);
    }
    ++c.n_faces;
    free(t);
    return c;
}

/* Whether what simplex s has in common with the union are facets and their faces, one facet at
 * least, but not all. Adds it, if `always` or if so, and to the Euler characteristic. */
static bool add_simplex(const iccp_simplices *m, const catalogue *c, size_t s, uint8_t *in_union,
                        bool always, int64_t *euler)
{
    const unsigned all = (2u << m->dim) - 1;
    const uint32_t *number = c->number + ((size_t)all + 1) * s;
    unsigned opposite = 0;
    for (size_t i = 0; i <= m->dim; ++i)
        opposite |= (unsigned)in_union[number[all ^ 1u << i]] << i;
    bool fits = opposite != 0 && opposite != all;
    for (unsigned set = 1; set < all;
         ++set) /* it lies in a shared facet if it lacks a corner opposite to one */
        fits = fits && (in_union[number[set]] != 0) == ((opposite & ~set) != 0);
    for (unsigned set = 1; (fits || always) && set <= all; ++set) {
        *euler += in_union[number[set]] != 0 ? 0 : c->size[number[set]] % 2 != 0 ? 1 : -1;
        in_union[number[set]] = 1;
    }
    return fits;
}

/* In 3-D, whether the facets with one simplex in the union form a sphere: each edge has two of them
 * and the Euler characteristic is 2. (Vertices where the sphere touches itself have been seen by
 * the above.) */
static void check_sphere(const iccp_simplices *m, const catalogue *c, const uint32_t *rank,
                         uint32_t limit)
{
    uint8_t *count = room(c->n_faces, 1);
    int64_t euler = 0;
    for (size_t side = 0; side < 4 * m->n_simplices; ++side) {
        const size_t s = side / 4;
        const uint32_t across = m->across[side];
        if (rank[s] > limit || (across < ICCP_ON_BOUNDARY && rank[across / 4] <= limit))
            continue;
        const unsigned facet = 15u ^ 1u << side % 4;
        for (unsigned set = facet; set != 0; set = (set - 1) & facet) {
            uint8_t *seen = &count[c->number[16 * s + set]];
            euler += *seen == 0 ? (c->size[c->number[16 * s + set]] % 2 != 0 ? 1 : -1) : 0;
            *seen = (uint8_t)(*seen < 3 ? *seen + 1 : 3);
        }
    }
    for (size_t f = 0; f < c->n_faces; ++f)
        ck_assert(c->size[f] != 2 || count[f] == 0 || count[f] == 2);
    ck_assert_int_eq(euler, 2);
    free(count);
}

/* A complete order satisfies the definition. */
static void check_order(const iccp_simplices *m, const catalogue *c, uint32_t centre,
                        const uint32_t *rank)
{
    uint32_t *at = room(m->n_simplices, sizeof *at);
    uint8_t *in_union = room(c->n_faces, 1);
    size_t n_centre = 0;
    int64_t euler = 0;
    memset(at, 0xff, (m->n_simplices + 1) * sizeof *at);
    for (size_t s = 0; s < m->n_simplices; ++s) {
        bool has_centre = false;
        for (size_t i = 0; i <= m->dim; ++i)
            has_centre = has_centre || m->corners[(m->dim + 1) * s + i] == centre;
        ck_assert(has_centre == (rank[s] == 0));
        n_centre += has_centre;
        if (has_centre) {
            add_simplex(m, c, s, in_union, true, &euler);
        } else {
            ck_assert(rank[s] <= m->n_simplices && at[rank[s]] == NONE);
            at[rank[s]] = (uint32_t)s;
        }
    }
    ck_assert_int_eq(euler, 1);
    const size_t n = m->n_simplices - n_centre;
    for (uint32_t k = 1; k <= n; ++k) {
        ck_assert(at[k] != NONE);
        ck_assert(add_simplex(m, c, at[k], in_union, false, &euler));
        ck_assert(euler == 1);
        if (m->dim == 3 && k % (n / 3 + 1) == n / 4)
            check_sphere(m, c, rank, k);
    }
    free(in_union);
    free(at);
}

/* ------------------------------------------------------------------ wishes */

/* Everything that an order is asked for with. */
typedef struct problem {
    icc_domain *domain;
    const iccp_simplices *mesh;
    iccp_faces faces;
    catalogue catalogue; /* made when it is needed first */
    double *potential, *flux, *inflow;
    uint32_t *rank;
} problem;

/* The mesh is ended. */
static problem begin(test_mesh mesh)
{
    const iccp_env env = default_env();
    icc_error err = {.size = sizeof err};
    problem p = {.domain = NULL};
    ck_assert_msg(mesh_domain(&p.domain, &mesh, NULL, &err) == ICC_OK, "%s", err.message);
    mesh_free(&mesh);
    p.mesh = p.domain->mesh;
    ck_assert_uint_gt(p.mesh->n_points, p.mesh->n_boundary);
    ck_assert_int_eq(iccp_faces_create(&p.faces, p.mesh, &env), ICC_OK);
    p.potential = room(p.mesh->n_simplices, sizeof *p.potential);
    p.flux = room((p.mesh->dim + 1) * p.mesh->n_simplices, sizeof *p.flux);
    p.inflow = room(p.mesh->n_facets, sizeof *p.inflow);
    p.rank = room(p.mesh->n_simplices, sizeof *p.rank);
    return p;
}

static void end(problem *p)
{
    free(p->potential);
    free(p->flux);
    free(p->inflow);
    free(p->rank);
    free(p->catalogue.number);
    free(p->catalogue.size);
    iccp_faces_free(&p->faces);
    icc_domain_free(p->domain);
}

static const catalogue *faces_of(problem *p)
{
    if (p->catalogue.n_faces == 0)
        p->catalogue = list_faces(p->mesh);
    return &p->catalogue;
}

static uint32_t random_centre(const problem *p, random_source *r)
{
    return (uint32_t)p->mesh->n_boundary +
           (uint32_t)random_below(r, (int)(p->mesh->n_points - p->mesh->n_boundary));
}

/* Steps from the star across facets, and what flows down that: not without sources. */
static void prefer_near(problem *p, uint32_t centre)
{
    const iccp_simplices *m = p->mesh;
    const size_t n_sides = m->dim + 1;
    uint32_t *queue = room(m->n_simplices, sizeof *queue);
    size_t n = 0;
    for (size_t s = 0; s < m->n_simplices; ++s) {
        p->potential[s] = -1;
        for (size_t i = 0; i < n_sides; ++i)
            p->potential[s] = m->corners[n_sides * s + i] == centre ? 0 : p->potential[s];
        if (p->potential[s] >= 0)
            queue[n++] = (uint32_t)s;
    }
    for (size_t k = 0; k < n; ++k)
        for (size_t i = 0; i < n_sides; ++i) {
            const uint32_t across = m->across[n_sides * queue[k] + i];
            const size_t there = across / n_sides;
            if (across >= ICCP_ON_BOUNDARY || p->potential[there] >= 0)
                continue;
            p->potential[there] = p->potential[queue[k]] + 1;
            queue[n++] = (uint32_t)there;
        }
    ck_assert_uint_eq(n, m->n_simplices);
    for (size_t side = 0; side < n_sides * m->n_simplices; ++side)
        p->flux[side] =
            m->across[side] >= ICCP_ON_BOUNDARY
                ? -1
                : p->potential[side / n_sides] - p->potential[m->across[side] / n_sides];
    free(queue);
}

static void prefer_anything(problem *p, random_source *r)
{
    for (size_t s = 0; s < p->mesh->n_simplices; ++s)
        p->potential[s] = random_unit(r);
    for (size_t side = 0; side < (p->mesh->dim + 1) * p->mesh->n_simplices; ++side) {
        const uint32_t across = p->mesh->across[side];
        p->flux[side] = across >= ICCP_ON_BOUNDARY ? -1
                        : across < side            ? -p->flux[across]
                                                   : random_unit(r) - 0.5;
    }
}

/* What charts ask for. */
static void prefer_flux(problem *p, uint32_t centre)
{
    const iccp_env env = default_env();
    ck_assert_int_eq(iccp_inflow(p->mesh, centre, 0.5, p->inflow, &env), ICC_OK);
    ck_assert_int_eq(iccp_reference_flux(p->mesh, centre, p->inflow, p->flux, p->potential, &env),
                     ICC_OK);
}

/* How many simplices are left; none: the order has been checked. */
static size_t left_by(problem *p, uint32_t centre, double beta, bool peel)
{
    const iccp_order_priority priority = {p->mesh,      &p->faces, centre, p->flux,
                                          p->potential, beta,      NULL};
    const iccp_env env = default_env();
    size_t n_left = 0, n_without = 0;
    ck_assert_int_eq((peel ? iccp_order_peel : iccp_order_grow)(&priority, p->rank, &n_left, &env),
                     ICC_OK);
    for (size_t s = 0; s < p->mesh->n_simplices; ++s)
        n_without += p->rank[s] == NONE;
    ck_assert_uint_eq(n_left, n_without);
    if (n_left == 0)
        check_order(p->mesh, faces_of(p), centre, p->rank);
    return n_left;
}

/* ------------------------------------------------------------------- tests */

START_TEST(faces_are_numbered_by_their_vertices)
{
    random_source r = {1};
    for (int32_t dim = 2; dim <= ICC_MAX_DIM; ++dim) {
        problem p = begin(split_edges(cube(dim, dim < 5 ? 3 : 2), &r, 10));
        const catalogue *c = faces_of(&p);
        uint32_t *other = room(c->n_faces, sizeof *other),
                 *back = room(p.faces.n_faces, sizeof *back);
        const unsigned n_sets = 2u << dim;
        size_t n_faces = 0;
        for (size_t s = 0; s < p.mesh->n_simplices; ++s)
            for (unsigned set = 1; set < n_sets; ++set) {
                if (iccp_set_size(set) >= (size_t)dim)
                    continue;
                const uint32_t mine = iccp_face(&p.faces, s, set),
                               its = c->number[n_sets * s + set];
                ck_assert(mine < p.faces.n_faces);
                n_faces += other[its] == 0;
                ck_assert(other[its] == 0 || other[its] == mine + 1);
                ck_assert(back[mine] == 0 || back[mine] == its + 1);
                other[its] = mine + 1;
                back[mine] = its + 1;
            }
        ck_assert_uint_eq(n_faces, p.faces.n_faces);
        free(other);
        free(back);
        end(&p);
    }
}
END_TEST

START_TEST(heap_gives_out_the_least)
{
    enum { N = 300 };
    random_source r = {2};
    double key[N];
    bool in[N] = {false};
    iccp_heap heap;
    ck_assert(iccp_heap_create(&heap, N, &iccp_memory_default));
    for (int step = 0; step < 20000; ++step) {
        if (random_below(&r, 3) < 2) {
            const int i = random_below(&r, N);
            key[i] = random_below(&r, 50);
            in[i] = true;
            iccp_heap_put(&heap, (uint32_t)i, key[i]);
        } else if (heap.n_entries > 0) {
            int least = -1;
            for (int i = 0; i < N; ++i)
                if (in[i] && (least < 0 || key[i] < key[least]))
                    least = i;
            ck_assert(iccp_heap_pop(&heap) == (uint32_t)least);
            in[least] = false;
        }
    }
    iccp_heap_free(&heap, &iccp_memory_default);
}
END_TEST

/* Balls in the plane can be built up from anywhere in any order: nothing is ever left. */
START_TEST(nothing_is_left_in_the_plane)
{
    random_source r = {3};
    for (int trial = 0; trial < 40; ++trial) {
        problem p = begin(split_edges(cube(2, 3 + (size_t)trial % 5), &r, 5 * (size_t)trial));
        const uint32_t centre = random_centre(&p, &r);
        for (int k = 0; k < 4; ++k) {
            if (k < 2)
                prefer_near(&p, centre);
            else
                prefer_anything(&p, &r);
            ck_assert_uint_eq(left_by(&p, centre, 8, k % 2 != 0), 0);
        }
        end(&p);
    }
}
END_TEST

/* Whatever is wished for: an order is what it should be, or says that it is not complete. */
START_TEST(complete_orders_are_shellings)
{
    random_source r = {4};
    size_t n_complete[ICC_MAX_DIM + 1] = {0}, n_near[ICC_MAX_DIM + 1] = {0};
    for (int32_t dim = 3; dim <= ICC_MAX_DIM; ++dim)
        for (int trial = 0; trial < (dim < 5 ? share_of(10) : 1); ++trial) {
            const test_mesh whole = cube(dim, dim == 3 ? 4 : dim == 4 ? 3 : 2);
            problem p = begin(split_edges(whole, &r, dim < 5 ? 10 * (size_t)trial : 3));
            const uint32_t centre = random_centre(&p, &r);
            for (int k = 0; k < 4; ++k) {
                if (k < 2)
                    prefer_near(&p, centre);
                else
                    prefer_anything(&p, &r);
                const size_t n_left = left_by(&p, centre, 2, k % 2 != 0);
                n_complete[dim] += n_left == 0;
                n_near[dim] += k < 2 && n_left == 0;
            }
            end(&p);
        }
    for (size_t dim = 3; dim <= ICC_MAX_DIM; ++dim)
        ck_assert(n_near[dim] > 0 && n_complete[dim] > n_near[dim]);
}
END_TEST

/* Twelve meshes. */
static problem mesh_by_number(int number, random_source *r)
{
    switch (number) {
    case 0:
        return begin(mesh_cube(3, 5, 0.1, r));
    case 1:
        return begin(mesh_ball(3, 6, 0.1, r));
    case 2:
        return begin(mesh_cells(3, 6, has_no_well));
    case 3:
        return begin(split_edges(mesh_cells(3, 5, has_no_well), r, 400));
    case 4:
        return begin(split_edges(mesh_ball(3, 4, 0.1, r), r, 300));
    case 5:
        return begin(split_edges(cube(3, 2), r, 300));
    case 6:
        return begin(split_edges(cube(3, 1), r, 200));
    case 7:
        return begin(split_edges(mesh_cells(3, 4, is_snake), r, 300));
    case 8:
        return begin(mesh_cube(4, 3, 0.05, r));
    case 9:
        return begin(split_edges(cube(4, 1), r, 60));
    case 10:
        return begin(split_edges(mesh_cells(4, 4, has_no_well), r, 20));
    default:
        return begin(split_edges(cube(2, 9), r, 300));
    }
}

START_TEST(one_of_two_is_complete_for_any_maximum)
{
    random_source r = {7};
    const int n_trials = share_of(12);
    int n_grown = 0, n_peeled = 0;
    for (int number = 0; number < 12; ++number) {
        problem p = mesh_by_number(number, &r);
        for (int trial = 0; trial < n_trials; ++trial) {
            const uint32_t centre = random_centre(&p, &r);
            prefer_flux(&p, centre);
            const bool grown = left_by(&p, centre, 8, false) == 0;
            const bool peeled = left_by(&p, centre, 8, true) == 0;
            ck_assert_msg(grown || peeled, "mesh %d, trial %d", number, trial);
            n_grown += grown;
            n_peeled += peeled;
        }
        end(&p);
    }
    ck_assert_int_gt(n_grown, 10 * n_trials);
    ck_assert_int_gt(n_peeled, 10 * n_trials);
}
END_TEST

/* Turns the order's facets and checks what becomes of it: a shelling as before, and what is turned
 * was amiss. Returns how many facets that were are left so. */
static size_t turn_order(problem *p, uint32_t centre, size_t *n_turned)
{
    const iccp_order_priority priority = {p->mesh,      &p->faces, centre, p->flux,
                                          p->potential, 8,         NULL};
    const iccp_env env = default_env();
    const iccp_simplices *m = p->mesh;
    uint32_t *before = room(m->n_simplices, sizeof *before);
    size_t n_changed = 0, n_left = 0, said;
    memcpy(before, p->rank, m->n_simplices * sizeof *before);
    ck_assert_int_eq(iccp_order_reverse(&priority, p->rank, &said, &env), ICC_OK);
    check_order(m, faces_of(p), centre, p->rank);
    for (size_t side = 0; side < (m->dim + 1) * m->n_simplices; ++side) {
        if (m->across[side] >= ICCP_ON_BOUNDARY)
            continue;
        const size_t here = iccp_simplex_of(m, (uint32_t)side);
        const size_t there = iccp_simplex_of(m, m->across[side]);
        const bool left_by = before[here] > before[there],
                   is_left_by = p->rank[here] > p->rank[there];
        ck_assert(!left_by || is_left_by || p->flux[side] < 0);
        n_changed += left_by && !is_left_by;
        n_left += is_left_by && p->flux[side] < 0;
    }
    ck_assert_uint_eq(said, n_changed);
    *n_turned += n_changed;
    free(before);
    return n_left;
}

START_TEST(turned_orders_are_shellings)
{
    random_source r = {12};
    size_t n_turned = 0, n_left = 0, n_forced = 0;
    for (int number = 0; number < 12; ++number) {
        problem p = mesh_by_number(number, &r);
        const uint32_t centre = random_centre(&p, &r);
        for (int k = 0; k < 4; ++k) {
            prefer_flux(&p, centre);
            if (left_by(&p, centre, k < 2 ? 2 : 32, k % 2 != 0) > 0)
                continue;
            n_left += turn_order(&p, centre, &n_turned);
            prefer_anything(&p, &r);
            (void)turn_order(&p, centre, &n_forced);
        }
        end(&p);
    }
    ck_assert_uint_gt(n_turned, 2 * n_left);
    ck_assert_uint_gt(n_forced, n_turned);
}
END_TEST

/* The contest gives what it says, and nothing that a single order with its greedy flux has is
 * better. */
static void check_contest(problem *p, uint32_t centre, const iccp_best_order_info *info,
                          const double *flux)
{
    const iccp_env env = default_env();
    const size_t n_sides = p->mesh->dim + 1;
    size_t n_reversed = 0;
    iccp_circulation c;
    check_order(p->mesh, faces_of(p), centre, p->rank);
    for (size_t side = 0; side < n_sides * p->mesh->n_simplices; ++side) {
        const uint32_t across = p->mesh->across[side];
        if (across >= ICCP_ON_BOUNDARY) {
            ck_assert(flux[side] < 0);
            continue;
        }
        const uint32_t here = p->rank[side / n_sides], there = p->rank[across / n_sides];
        ck_assert(here == there ? flux[side] == 0 : (flux[side] > 0) == (here > there));
        n_reversed += here > there && p->flux[side] < 0;
    }
    ck_assert_uint_eq(info->n_reversed, n_reversed);
    ck_assert_uint_gt(info->n_finished, 0);
    ck_assert_uint_le(info->n_finished, info->n_orders);
    ck_assert_int_eq(iccp_circulation_create(&c, p->mesh, centre, p->inflow, p->flux, &env),
                     ICC_OK);
    ck_assert_double_eq(iccp_circulation_energy(&c, flux), info->energy);
    ck_assert_double_eq(iccp_circulation_divergence(&c, flux), info->divergence);
    ck_assert_double_lt(info->divergence, 1e-12);
    double *greedy = room(n_sides * p->mesh->n_simplices, sizeof *greedy);
    for (int k = 0; k < 4; ++k) {
        if (left_by(p, centre, k < 2 ? 8 : 32, k % 2 != 0) > 0)
            continue;
        ck_assert_int_eq(iccp_circulation_greedy(&c, p->rank, greedy, &env), ICC_OK);
        ck_assert_double_le(info->energy, iccp_circulation_energy(&c, greedy) * (1 + 1e-9));
    }
    free(greedy);
    iccp_circulation_free(&c);
}

/* Meshes of real surfaces, where there are any. */
START_TEST(real_meshes)
{
    static const char *const NAMES[] = {"t08_fox", "t06_spikes_sphere"};
    random_source r = {11};
    for (int number = 0; number < 2; ++number) {
        test_mesh mesh;
        if (!mesh_of_data(&mesh, NAMES[number], "src", "test_order"))
            continue;
        problem p = begin(mesh);
        for (int trial = 0; trial < share_of(6); ++trial) {
            const uint32_t centre = random_centre(&p, &r);
            prefer_flux(&p, centre);
            const bool grown = left_by(&p, centre, 32, false) == 0;
            ck_assert(left_by(&p, centre, 32, true) == 0 || grown);
        }
        end(&p);
    }
}
END_TEST

static void backwards(void *user, size_t n_tasks, icc_task task, void *argument)
{
    (void)user;
    while (n_tasks-- > 0)
        task(argument, n_tasks);
}

START_TEST(contests_are_won_by_the_best)
{
    random_source r = {8};
    for (int number = 0; number < 12; ++number) {
        problem p = mesh_by_number(number, &r);
        const uint32_t centre = random_centre(&p, &r);
        const size_t n = p.mesh->n_simplices, n_sides = n * (p.mesh->dim + 1);
        double *flux = room(n_sides, sizeof *flux), *again = room(n_sides, sizeof *again);
        uint32_t *rank = room(n, sizeof *rank);
        prefer_flux(&p, centre);
        iccp_best_order_info info = {0}, other;
        for (int way = 0; way < 3; ++way) {
            iccp_env env = default_env();
            env.threads = way == 1 ? 3 : 1;
            env.parallel_for = way == 2 ? backwards : NULL;
            other = (iccp_best_order_info){0};
            ck_assert_int_eq(iccp_best_order(p.mesh, centre, p.inflow, p.flux, p.potential,
                                             way == 0 ? p.rank : rank, way == 0 ? flux : again,
                                             way == 0 ? &info : &other, &env, NULL),
                             ICC_OK);
            if (way == 0)
                continue;
            ck_assert_mem_eq(p.rank, rank, n * sizeof *rank);
            ck_assert_mem_eq(flux, again, n_sides * sizeof *flux);
            ck_assert(info.energy == other.energy && info.n_finished == other.n_finished);
        }
        check_contest(&p, centre, &info, flux);
        free(flux);
        free(again);
        free(rank);
        end(&p);
    }
}
END_TEST

/* The adversary: walls so thin that neither way gets through; and, cut finer, sometimes. */
START_TEST(houses_end_in_an_order_or_an_error)
{
    problem p = begin(mesh_cells(3, 22, in_house_2));
    random_source r = {9};
    const iccp_env env = default_env();
    double *flux = room(4 * p.mesh->n_simplices, sizeof *flux);
    for (int trial = 0; trial < 2; ++trial) {
        const uint32_t centre = random_centre(&p, &r);
        icc_error err = {.size = sizeof err};
        iccp_best_order_info info;
        prefer_flux(&p, centre);
        const icc_status status = iccp_best_order(p.mesh, centre, p.inflow, p.flux, p.potential,
                                                  p.rank, flux, &info, &env, &err);
        ck_assert(status == ICC_OK || status == ICC_ERR_TOPOLOGY);
        if (status == ICC_OK) {
            check_contest(&p, centre, &info, flux);
            continue;
        }
        ck_assert_int_eq(err.status, status);
        ck_assert_ptr_nonnull(strstr(err.message, "are left"));
    }
    free(flux);
    end(&p);
}
END_TEST

/* A vertex and its link: all have rank 0. */
START_TEST(star_is_complete_at_once)
{
    for (int32_t dim = 2; dim <= ICC_MAX_DIM; ++dim) {
        test_mesh mesh = split_edges(cube(dim, 1), &(random_source){6}, 0);
        mesh.vertices =
            realloc(mesh.vertices, (mesh.n_vertices + 1) * (size_t)dim * sizeof *mesh.vertices);
        mesh.simplices = realloc(mesh.simplices,
                                 2 * mesh.n_simplices * (size_t)(dim + 1) * sizeof *mesh.simplices);
        ck_assert(mesh.vertices != NULL && mesh.simplices != NULL);
        split_edge(&mesh, mesh.simplices[0],
                   mesh.simplices[dim]); /* the long diagonal, which all have */
        problem p = begin(mesh);
        ck_assert_uint_eq(p.mesh->n_points, p.mesh->n_boundary + 1);
        prefer_near(&p, (uint32_t)p.mesh->n_boundary);
        ck_assert_uint_eq(left_by(&p, (uint32_t)p.mesh->n_boundary, 8, false), 0);
        ck_assert_uint_eq(left_by(&p, (uint32_t)p.mesh->n_boundary, 8, true), 0);
        for (size_t s = 0; s < p.mesh->n_simplices; ++s)
            ck_assert(p.rank[s] == 0);
        double *flux = room(p.mesh->n_simplices * (p.mesh->dim + 1), sizeof *flux);
        const iccp_env env = default_env();
        iccp_best_order_info info;
        prefer_flux(&p, (uint32_t)p.mesh->n_boundary);
        ck_assert_int_eq(iccp_best_order(p.mesh, (uint32_t)p.mesh->n_boundary, p.inflow, p.flux,
                                         p.potential, p.rank, flux, &info, &env, NULL),
                         ICC_OK);
        check_contest(&p, (uint32_t)p.mesh->n_boundary, &info, flux);
        free(flux);
        end(&p);
    }
}
END_TEST

static icc_status call_contest(const icc_env *given, icc_error *err, void *argument)
{
    problem *p = argument;
    iccp_env env;
    iccp_best_order_info info;
    static double flux[4 * 6 * 27];
    ck_assert_int_eq(iccp_env_read(&env, given, NULL), ICC_OK);
    ck_assert_uint_eq(p->mesh->n_simplices, 6 * 27);
    return iccp_best_order(p->mesh, (uint32_t)p->mesh->n_boundary, p->inflow, p->flux, p->potential,
                           p->rank, flux, &info, &env, err);
}

static icc_status call_order(const icc_env *given, icc_error *err, void *argument)
{
    problem *p = argument;
    iccp_env env;
    iccp_faces faces;
    size_t n_left;
    ck_assert_int_eq(iccp_env_read(&env, given, NULL), ICC_OK);
    icc_status status = iccp_faces_create(&faces, p->mesh, &env);
    const iccp_order_priority priority = {
        p->mesh, &faces, (uint32_t)p->mesh->n_boundary, p->flux, p->potential, 2, NULL};
    if (status == ICC_OK)
        status = iccp_order_grow(&priority, p->rank, &n_left, &env);
    if (status == ICC_OK)
        status = iccp_order_peel(&priority, p->rank, &n_left, &env);
    iccp_faces_free(&faces);
    return iccp_explain(err, status);
}

START_TEST(every_failure_is_survived)
{
    problem p = begin(cube(3, 6));
    prefer_near(&p, (uint32_t)p.mesh->n_boundary);
    faulty_sweep(call_order, &p);
    end(&p);
    p = begin(cube(3, 3));
    prefer_flux(&p, (uint32_t)p.mesh->n_boundary);
    faulty_sweep(call_contest, &p);
    end(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("order");
    TCase *tests = tcase_create("all");
    suite_add_tcase(suite, tests);
    tcase_add_test(tests, faces_are_numbered_by_their_vertices);
    tcase_add_test(tests, heap_gives_out_the_least);
    tcase_add_test(tests, nothing_is_left_in_the_plane);
    tcase_add_test(tests, complete_orders_are_shellings);
    tcase_add_test(tests, one_of_two_is_complete_for_any_maximum);
    tcase_add_test(tests, turned_orders_are_shellings);
    tcase_add_test(tests, real_meshes);
    tcase_add_test(tests, contests_are_won_by_the_best);
    tcase_add_test(tests, houses_end_in_an_order_or_an_error);
    tcase_add_test(tests, star_is_complete_at_once);
    tcase_add_test(tests, every_failure_is_survived);
    return suite_run(suite);
}
