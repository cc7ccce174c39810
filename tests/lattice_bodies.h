/* Meshes of tetrahedra with handles and voids, made of the cells of a lattice or of rings of
 * prisms. Only how they hang together matters: they have no coordinates. */
#ifndef TESTS_LATTICE_BODIES_H
#define TESTS_LATTICE_BODIES_H

#include "geometry/simplices.h"
#include "icc/base.h"
#include "random.h"

#include <check.h>
#include <string.h>

static inline iccp_simplices *lattice_mesh(size_t n_simplices)
{
    const iccp_memory *memory = &iccp_memory_default;
    iccp_simplices *mesh = iccp_alloc_zero(memory, 1, sizeof *mesh);
    ck_assert_ptr_nonnull(mesh);
    *mesh = (iccp_simplices){.memory = *memory, .dim = 3};
    mesh->corners = iccp_alloc(memory, n_simplices, 4 * sizeof *mesh->corners);
    mesh->region = iccp_alloc_zero(memory, n_simplices, sizeof *mesh->region);
    ck_assert_ptr_nonnull(mesh->corners);
    ck_assert_ptr_nonnull(mesh->region);
    return mesh;
}

static inline void lattice_add(iccp_simplices *mesh, uint32_t region, uint32_t a, uint32_t b,
                               uint32_t c, uint32_t d)
{
    const uint32_t corners[4] = {a, b, c, d};
    mesh->region[mesh->n_simplices] = region;
    memcpy(mesh->corners + 4 * mesh->n_simplices++, corners, sizeof corners);
}

static inline void lattice_join(iccp_simplices *mesh)
{
    icc_error err = {.size = sizeof err};
    iccp_free(&mesh->memory, mesh->across);
    const icc_status status = iccp_simplices_join(mesh, 0, NULL, &err);
    ck_assert_msg(status == ICC_OK, "%s", err.message);
}

/* Divides some tetrahedra in four, at random. There is room for 3 more each. */
static inline void lattice_divide(iccp_simplices *mesh, size_t n, random_source *r)
{
    for (size_t k = 0; k < n; ++k) {
        const size_t s = (size_t)(random_unit(r) * (double)mesh->n_simplices);
        uint32_t v[4], p = (uint32_t)mesh->n_points++;
        memcpy(v, mesh->corners + 4 * s, sizeof v);
        mesh->corners[4 * s] = p;
        lattice_add(mesh, mesh->region[s], v[0], p, v[2], v[3]);
        lattice_add(mesh, mesh->region[s], v[0], v[1], p, v[3]);
        lattice_add(mesh, mesh->region[s], v[0], v[1], v[2], p);
    }
}

/* ---- cells ---- */

enum { CELLS = 26, OUTSIDE_CELL = 255, CONED_CELL = 254, FIRST_REGION = 100 };

/* Cells: 0 for the body, 1, 2, .. for voids, FIRST_REGION + 1, .. for inner regions,
 * OUTSIDE_CELL. */
typedef struct lattice_body {
    int size[3];
    int beyond; /* the cells around the lattice: OUTSIDE_CELL, or CONED_CELL: a cone over them */
    uint8_t cell[CELLS][CELLS][CELLS];
} lattice_body;

static inline void body_begin(lattice_body *b, int x, int y, int z, uint8_t cell)
{
    ck_assert(x <= CELLS && y <= CELLS && z <= CELLS);
    *b = (lattice_body){.size = {x, y, z}, .beyond = OUTSIDE_CELL};
    memset(b->cell, cell, sizeof b->cell);
}

static inline int body_cell(const lattice_body *b, int x, int y, int z)
{
    const bool in =
        x >= 0 && y >= 0 && z >= 0 && x < b->size[0] && y < b->size[1] && z < b->size[2];
    return in ? b->cell[x][y][z] : b->beyond;
}

static inline bool body_has(int cell)
{
    return cell == 0 || (cell > FIRST_REGION && cell < CONED_CELL);
}

/* Sets the cells of a straight row. */
static inline void body_row(lattice_body *b, const int from[3], const int to[3], uint8_t cell)
{
    int at[3] = {from[0], from[1], from[2]};
    for (;;) {
        for (int i = 0; i < 3; ++i)
            ck_assert(at[i] >= 0 && at[i] < b->size[i]);
        b->cell[at[0]][at[1]][at[2]] = cell;
        if (memcmp(at, to, sizeof at) == 0)
            return;
        for (int i = 0; i < 3; ++i)
            at[i] += (at[i] < to[i]) - (at[i] > to[i]);
    }
}

/* Sets the cells of a square ring of this size in a plane with axes i and j. */
static inline void body_ring(lattice_body *b, int x, int y, int z, int i, int j, int size,
                             uint8_t cell)
{
    int c[4][3] = {{x, y, z}, {x, y, z}, {x, y, z}, {x, y, z}};
    c[1][i] += size - 1;
    c[2][i] += size - 1;
    c[2][j] += size - 1;
    c[3][j] += size - 1;
    for (int k = 0; k < 4; ++k)
        body_row(b, c[k], c[(k + 1) % 4], cell);
}

/* Sets the cells of a torus knot of 2 and n - 2 turns, in 2 n - 1 by 2 n - 1 by 3 cells from a
 * place on: P. R. Cromwell, Embedding knots and links in an open book, 1995. */
static inline void body_knot(lattice_body *b, int n, int x, int y, int z, uint8_t cell)
{
    for (int i = 0; i < n; ++i) {
        const int other = (i + 2) % n, back = (i + n - 2) % n;
        body_row(b, (int[3]){x + 2 * i, y + 2 * i, z}, (int[3]){x + 2 * i, y + 2 * i, z + 2}, cell);
        body_row(b, (int[3]){x + 2 * i, y + 2 * i, z + 2},
                 (int[3]){x + 2 * i, y + 2 * other, z + 2}, cell);
        body_row(b, (int[3]){x + 2 * i, y + 2 * other, z + 2},
                 (int[3]){x + 2 * i, y + 2 * other, z}, cell);
        body_row(b, (int[3]){x + 2 * back, y + 2 * i, z}, (int[3]){x + 2 * i, y + 2 * i, z}, cell);
    }
}

/* Exchanges the body and what is around it, with a cone over the end of the lattice: what is around
 * it in the sphere of three dimensions. */
static inline void body_turn_out(lattice_body *b)
{
    for (int x = 0; x < b->size[0]; ++x)
        for (int y = 0; y < b->size[1]; ++y)
            for (int z = 0; z < b->size[2]; ++z)
                b->cell[x][y][z] = b->cell[x][y][z] == 0 ? OUTSIDE_CELL : 0;
    b->beyond = CONED_CELL;
}

typedef struct lattice_numbers {
    uint32_t of[CELLS + 1][CELLS + 1][CELLS + 1];
    uint32_t n;
} lattice_numbers;

/* Numbers the vertices between the body and one void, region or the outside, in the order of the
 * lattice. So a void that moves keeps its numbers. 0: all vertices that are left. */
static inline void number_wall(lattice_numbers *numbers, const lattice_body *b, int wall)
{
    for (int x = 0; x <= b->size[0]; ++x)
        for (int y = 0; y <= b->size[1]; ++y)
            for (int z = 0; z <= b->size[2]; ++z) {
                bool at_wall = wall == 0, at_body = false;
                for (int k = 0; k < 8; ++k) {
                    const int cell = body_cell(b, x - (k & 1), y - (k >> 1 & 1), z - (k >> 2));
                    at_wall = at_wall || cell == wall;
                    at_body = at_body || (body_has(cell) && (wall == 0 || cell != wall));
                }
                if (at_wall && at_body && numbers->of[x][y][z] == UINT32_MAX)
                    numbers->of[x][y][z] = numbers->n++;
            }
}

/* Adds six tetrahedra for a cell. H. Freudenthal, Simplizialzerlegungen von beschraenkter
 * Flachheit, 1942. */
static inline void add_cell(iccp_simplices *mesh, const lattice_numbers *numbers, int x, int y,
                            int z, uint32_t region)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                     {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int k = 0; k < 6; ++k) {
        int at[3] = {x, y, z};
        uint32_t v[4] = {numbers->of[x][y][z]};
        for (int i = 0; i < 3; ++i) {
            ++at[orders[k][i]];
            v[i + 1] = numbers->of[at[0]][at[1]][at[2]];
        }
        lattice_add(mesh, region, v[0], v[1], v[k < 3 ? 2 : 3], v[k < 3 ? 3 : 2]);
    }
}

/* Adds a cone over the end of the lattice. */
static inline void add_cone(iccp_simplices *mesh, const lattice_body *b,
                            const lattice_numbers *numbers)
{
    static bool at_end[(CELLS + 1) * (CELLS + 1) * (CELLS + 1)];
    memset(at_end, 0, sizeof at_end);
    for (int x = 0; x <= b->size[0]; ++x)
        for (int y = 0; y <= b->size[1]; ++y)
            for (int z = 0; z <= b->size[2]; ++z)
                if (x == 0 || y == 0 || z == 0 || x == b->size[0] || y == b->size[1] ||
                    z == b->size[2])
                    at_end[numbers->of[x][y][z]] = true;
    lattice_join(mesh);
    const uint32_t apex = (uint32_t)mesh->n_points++;
    for (size_t side = 0, n = 4 * mesh->n_simplices; side < n; ++side) {
        uint32_t v[3];
        if (!(mesh->across[side] & ICCP_ON_BOUNDARY))
            continue;
        iccp_simplices_side(mesh, side, v);
        if (at_end[v[0]] && at_end[v[1]] && at_end[v[2]])
            lattice_add(mesh, 0, v[0], v[1], v[2], apex);
    }
}

/* Makes the mesh, with some tetrahedra divided. The surface's vertices come first. */
static inline iccp_simplices *body_mesh(const lattice_body *b, size_t n_divided, random_source *r)
{
    static lattice_numbers numbers;
    const size_t n_cells = (size_t)(b->size[0] * b->size[1] * b->size[2]);
    iccp_simplices *mesh = lattice_mesh(12 * n_cells + 3 * n_divided + 1000);
    memset(&numbers, 0xff, sizeof numbers);
    numbers.n = 0;
    number_wall(&numbers, b, OUTSIDE_CELL);
    for (int wall = 1; wall < CONED_CELL; ++wall)
        number_wall(&numbers, b, wall);
    number_wall(&numbers, b, 0);
    mesh->n_points = numbers.n;
    for (int x = 0; x < b->size[0]; ++x)
        for (int y = 0; y < b->size[1]; ++y)
            for (int z = 0; z < b->size[2]; ++z) {
                const int cell = b->cell[x][y][z];
                if (body_has(cell))
                    add_cell(mesh, &numbers, x, y, z,
                             cell == 0 ? 0 : (uint32_t)(cell - FIRST_REGION));
            }
    if (b->beyond == CONED_CELL)
        add_cone(mesh, b, &numbers);
    lattice_divide(mesh, n_divided, r);
    lattice_join(mesh);
    return mesh;
}

/* ---- solid tori ---- */

/* The surface of a solid torus of n by n vertices is a lattice with edges along a, b and a + b,
 * where a and b are given by how far they go along the torus and around it. */
typedef struct torus_axes {
    int a[2], b[2];
} torus_axes;

static inline uint32_t torus_vertex(int n, int along, int around)
{
    return (uint32_t)(((along % n + n) % n) * n + (around % n + n) % n);
}

/* Adds a layer of tetrahedra that exchange the edges along a + b for edges along a - b. Then the
 * latter is the second axis, and the sum is a. */
static inline void add_layer(iccp_simplices *mesh, torus_axes *t, int n)
{
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const uint32_t v = torus_vertex(n, i, j);
            const uint32_t va = torus_vertex(n, i + t->a[0], j + t->a[1]);
            const uint32_t vb = torus_vertex(n, i + t->b[0], j + t->b[1]);
            const uint32_t vc = torus_vertex(n, i + t->a[0] + t->b[0], j + t->a[1] + t->b[1]);
            const int det = t->a[0] * t->b[1] - t->a[1] * t->b[0];
            lattice_add(mesh, 0, v, va, det > 0 ? vb : vc, det > 0 ? vc : vb);
        }
    *t = (torus_axes){{t->b[0], t->b[1]}, {t->a[0] - t->b[0], t->a[1] - t->b[1]}};
}

/* Adds the tetrahedra of the prism over a triangle with an order of its corners, from one section
 * of the torus to the next. */
static inline void add_prism(iccp_simplices *mesh, const uint32_t v[3], const uint32_t w[3])
{
    lattice_add(mesh, 0, v[0], v[1], v[2], w[2]);
    lattice_add(mesh, 0, v[0], w[1], v[1], w[2]);
    lattice_add(mesh, 0, v[0], w[0], w[1], w[2]);
}

/* Makes a solid torus and adds layers, one for each letter of a word. The letter says which edges
 * are exchanged: c those along a + b, a or b those along this axis. *slope gets the meridian, the
 * loop around the torus that bounds, in steps along the last axes. Vertices are numbered along
 * these axes, so all surfaces are equal. */
static inline iccp_simplices *torus_mesh(int n, const char *word, int slope[2])
{
    torus_axes t = {{1, 0}, {0, 1}};
    iccp_simplices *mesh = lattice_mesh((size_t)n * (size_t)n * (3 + strlen(word)));
    const uint32_t n_rim = (uint32_t)(n * n);
    mesh->n_points = n_rim + (size_t)n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const uint32_t next = (uint32_t)((i + 1) % n);
            const uint32_t v[3] = {n_rim + (uint32_t)i, torus_vertex(n, i, j),
                                   torus_vertex(n, i, j + 1)};
            const uint32_t w[3] = {n_rim + next, torus_vertex(n, i + 1, j),
                                   torus_vertex(n, i + 1, j + 1)};
            add_prism(mesh, v, w);
        }
    for (; *word != '\0'; ++word) {
        const torus_axes s = t;
        if (*word == 'a')
            t = (torus_axes){{s.a[0] + s.b[0], s.a[1] + s.b[1]}, {-s.b[0], -s.b[1]}};
        if (*word == 'b')
            t = (torus_axes){{-s.a[0], -s.a[1]}, {s.a[0] + s.b[0], s.a[1] + s.b[1]}};
        add_layer(mesh, &t, n);
    }
    const int det = t.a[0] * t.b[1] - t.a[1] * t.b[0];
    slope[0] = -t.b[0] * det;
    slope[1] = t.a[0] * det;
    for (size_t k = 0; k < 4 * mesh->n_simplices; ++k) {
        const int v = (int)mesh->corners[k], i = v / n, j = v % n;
        if (v < n * n) /* the steps along the axes that lead there */
            mesh->corners[k] =
                torus_vertex(n, (i * t.b[1] - j * t.b[0]) * det, (j * t.a[0] - i * t.a[1]) * det);
    }
    lattice_join(mesh);
    return mesh;
}

#endif
