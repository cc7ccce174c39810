/* A quadtree over a box that is built level by level. Every cell carries the points that can still
 * split it, or that are close to its corners. Based on M. Bern, D. Eppstein, J. Gilbert, Provably
 * good mesh generation, 1994. The corners and centres of the leaves become vertices. */
#include "mesh/graded_box.h"

#include "base/minmax.h"
#include "base/random.h"
#include "mesh/constrain.h"
#include "mesh/delaunay.h"
#include "mesh/triangulate.h"

#include <math.h>
#include <string.h>

/* The width of cells grows by this share of the distance from the core. The prototype's value, as
 * ICCP_BOX_SLOPE. */
static const double OUTER_SLOPE = 0.35;

/* Least distance of a corner or centre from a point, in widths of its leaf. */
static const double CLEARANCE = 0.45;

/* Inner vertices of the quadtree are moved within this share of their leaf's width. Otherwise most
 * of them would be cocircular, and exact signs would take most of the time. */
static const double JITTER = 0x1p-8;

/* Half a cell's diagonal, in widths. */
static const double HALF_DIAGONAL = 0.71;

/* Levels below the top, and most root cells along an axis: corners have numbers of 32 bits. There
 * are at least LEAST_ROOTS root cells along the shorter side of a large box. */
enum { MAX_LEVELS = 18, MOST_ROOTS = 1 << 12, LEAST_ROOTS = 4 };

typedef struct cell {
    uint32_t x, y;   /* column and row among the cells of its level */
    size_t first, n; /* its points */
} cell;

/* The cells of one level and their points. */
typedef struct level {
    size_t n_cells, cell_room, n_entries, entry_room;
    cell *cells;
    uint32_t *entries;
    double side[2]; /* of a cell */
    double width;   /* the longer side */
    int depth;      /* 0: the root cells */
} level;

/* A corner or centre, at whole multiples of half the smallest possible cell. */
typedef struct place {
    uint32_t x, y;
    uint32_t width; /* of its smallest leaf */
    bool is_kept;
} place;

typedef struct builder {
    const iccp_graded_box *box;
    const iccp_memory *memory;
    uint32_t roots[2];
    place *places;
    size_t n_places, place_room;
    uint32_t *table; /* hash table of corners: their place + 1, or 0 */
    size_t n_corners, table_size;
} builder;

/* ---- vertices ---- */

static icc_status push_place(builder *b, const place *p)
{
    if (b->n_places == b->place_room) {
        const size_t room = 2 * b->place_room + 1024;
        if (!iccp_enlarge(b->memory, &b->places, b->n_places, room, sizeof *b->places))
            return ICC_ERR_MEMORY;
        b->place_room = room;
    }
    b->places[b->n_places++] = *p;
    return ICC_OK;
}

/* Returns the slot of the table that holds a corner, or the free slot where it belongs. */
static uint32_t *find_slot(const builder *b, uint32_t x, uint32_t y)
{
    const size_t mask = b->table_size - 1;
    uint64_t h = ((uint64_t)x << 32 | y) * UINT64_C(0x9e3779b97f4a7c15);
    h ^= h >> 32;
    for (size_t k = (size_t)h & mask;; k = (k + 1) & mask) {
        const uint32_t at = b->table[k];
        if (at == 0 || (b->places[at - 1].x == x && b->places[at - 1].y == y))
            return &b->table[k];
    }
}

static icc_status enlarge_table(builder *b)
{
    uint32_t *const old = b->table;
    const size_t n_old = b->table_size;
    b->table_size = n_old == 0 ? 4096 : 4 * n_old;
    b->table = iccp_alloc_zero(b->memory, b->table_size, sizeof *b->table);
    if (b->table == NULL) {
        b->table = old;
        return ICC_ERR_MEMORY;
    }
    for (size_t k = 0; k < n_old; ++k)
        if (old[k] != 0)
            *find_slot(b, b->places[old[k] - 1].x, b->places[old[k] - 1].y) = old[k];
    iccp_free(b->memory, old);
    return ICC_OK;
}

/* Levels come from coarse to fine, so the smallest leaf decides whether a corner stays. */
static icc_status add_corner(builder *b, const place *p)
{
    if (2 * b->n_corners >= b->table_size && enlarge_table(b) != ICC_OK)
        return ICC_ERR_MEMORY;
    uint32_t *const slot = find_slot(b, p->x, p->y);
    if (*slot != 0) {
        b->places[*slot - 1].is_kept = p->is_kept;
        b->places[*slot - 1].width = p->width;
        return ICC_OK;
    }
    const icc_status status = push_place(b, p);
    if (status == ICC_OK) {
        *slot = (uint32_t)b->n_places;
        ++b->n_corners;
    }
    return status;
}

static uint32_t whole(const builder *b, int axis)
{
    return b->roots[axis] << (MAX_LEVELS + 1);
}

/* Returns a coordinate of a place. The ends are exact. */
static double coordinate(const builder *b, int axis, uint32_t at)
{
    const double lower = b->box->lower[axis], upper = b->box->upper[axis];
    const uint32_t all = whole(b, axis);
    return at == all ? upper : lower + (upper - lower) * ((double)at / (double)all);
}

static bool on_boundary(const builder *b, const place *p)
{
    return p->x == 0 || p->y == 0 || p->x == whole(b, 0) || p->y == whole(b, 1);
}

/* Returns true if no point of the cell's list is close to a place. */
static bool is_clear(const builder *b, const level *l, const cell *c, const place *p)
{
    const double x = coordinate(b, 0, p->x), y = coordinate(b, 1, p->y);
    const double least = CLEARANCE * l->width;
    for (size_t e = c->first; e < c->first + c->n; ++e) {
        const double *q = b->box->points + 2 * (size_t)l->entries[e];
        if ((q[0] - x) * (q[0] - x) + (q[1] - y) * (q[1] - y) < least * least)
            return false;
    }
    return true;
}

/* Turns a leaf into its centre and its corners. Corners on the boundary always stay. */
static icc_status add_leaf(builder *b, const level *l, const cell *c)
{
    const int shift = MAX_LEVELS - l->depth;
    place p = {(2 * c->x + 1) << shift, (2 * c->y + 1) << shift, (uint32_t)2 << shift, true};
    icc_status status = is_clear(b, l, c, &p) ? push_place(b, &p) : ICC_OK;
    for (uint32_t k = 0; status == ICC_OK && k < 4; ++k) {
        p.x = (c->x + k % 2) << (shift + 1);
        p.y = (c->y + k / 2) << (shift + 1);
        p.is_kept = on_boundary(b, &p) || is_clear(b, l, c, &p);
        status = add_corner(b, &p);
    }
    return status;
}

/* ---- cells ---- */

static void find_centre(const builder *b, const level *l, const cell *c, double centre[2])
{
    centre[0] = b->box->lower[0] + ((double)c->x + 0.5) * l->side[0];
    centre[1] = b->box->lower[1] + ((double)c->y + 0.5) * l->side[1];
}

/* Returns the largest width that a cell may have, apart from the points. */
static double most_width(const builder *b, const level *l, const double centre[2])
{
    double outside[2];
    for (int k = 0; k < 2; ++k)
        outside[k] = iccp_max(
            iccp_max(b->box->core_lower[k] - centre[k], centre[k] - b->box->core_upper[k]), 0);
    const double distance = sqrt(outside[0] * outside[0] + outside[1] * outside[1]);
    return b->box->largest + OUTER_SLOPE * iccp_max(distance - HALF_DIAGONAL * l->width, 0);
}

/* Returns true if a point forbids cells of this width whose centres may be nearer by `slack`. */
static bool forbids(const iccp_graded_box *box, uint32_t i, const double centre[2], double width,
                    double slack)
{
    const double reach = 0.5 * width + (width - box->width[i]) / ICCP_BOX_SLOPE + slack;
    const double *p = box->points + 2 * (size_t)i;
    const double dx = p[0] - centre[0], dy = p[1] - centre[1];
    return width > box->width[i] && dx * dx + dy * dy < reach * reach;
}

static bool must_split(const builder *b, const level *l, const cell *c)
{
    double centre[2];
    find_centre(b, l, c, centre);
    if (l->width > most_width(b, l, centre))
        return true;
    for (size_t e = c->first; e < c->first + c->n; ++e)
        if (forbids(b->box, l->entries[e], centre, l->width, 0))
            return true;
    return false;
}

/* Returns true if a cell keeps a point: because it can split the cell or a cell inside, or because
 * it may be close to one of its corners. */
static bool is_kept(const iccp_graded_box *box, uint32_t i, const double centre[2], double width)
{
    const double *p = box->points + 2 * (size_t)i, near = (HALF_DIAGONAL + CLEARANCE) * width;
    const double dx = p[0] - centre[0], dy = p[1] - centre[1];
    return dx * dx + dy * dy < near * near || forbids(box, i, centre, width, HALF_DIAGONAL * width);
}

static icc_status push_entry(level *l, uint32_t point, const iccp_memory *memory)
{
    if (l->n_entries == l->entry_room) {
        const size_t room = 2 * l->entry_room + 1024;
        if (!iccp_enlarge(memory, &l->entries, l->n_entries, room, sizeof *l->entries))
            return ICC_ERR_MEMORY;
        l->entry_room = room;
    }
    l->entries[l->n_entries++] = point;
    return ICC_OK;
}

/* Adds a cell that keeps some of the points of a list. */
static icc_status add_cell(const builder *b, level *to, uint32_t x, uint32_t y,
                           const uint32_t *points, size_t n)
{
    cell c = {x, y, to->n_entries, 0};
    double centre[2];
    find_centre(b, to, &c, centre);
    for (size_t k = 0; k < n; ++k)
        if (is_kept(b->box, points[k], centre, to->width) &&
            push_entry(to, points[k], b->memory) != ICC_OK)
            return ICC_ERR_MEMORY;
    c.n = to->n_entries - c.first;
    if (to->n_cells == to->cell_room) {
        const size_t room = 2 * to->cell_room + 256;
        if (!iccp_enlarge(b->memory, &to->cells, to->n_cells, room, sizeof *to->cells))
            return ICC_ERR_MEMORY;
        to->cell_room = room;
    }
    to->cells[to->n_cells++] = c;
    return ICC_OK;
}

/* Divides the box into nearly square root cells. Their width is just below a power of two times the
 * largest width, so that a level of cells comes close to that. */
static void find_roots(builder *b, level *top)
{
    double size[2], width = b->box->largest;
    for (int k = 0; k < 2; ++k)
        size[k] = b->box->upper[k] - b->box->lower[k];
    const double least = iccp_min(size[0], size[1]);
    while (2 * LEAST_ROOTS * width <= least)
        width *= 2;
    for (int k = 0; k < 2; ++k) {
        b->roots[k] = (uint32_t)iccp_max(iccp_min(ceil(size[k] / width), MOST_ROOTS), 1);
        top->side[k] = size[k] / (double)b->roots[k];
    }
    top->width = iccp_max(top->side[0], top->side[1]);
}

static icc_status add_roots(builder *b, level *top)
{
    find_roots(b, top);
    uint32_t *all = iccp_alloc(b->memory, b->box->n, sizeof *all);
    icc_status status = all != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (uint32_t i = 0; status == ICC_OK && i < b->box->n; ++i)
        all[i] = i;
    for (uint32_t y = 0; status == ICC_OK && y < b->roots[1]; ++y)
        for (uint32_t x = 0; status == ICC_OK && x < b->roots[0]; ++x)
            status = add_cell(b, top, x, y, all, b->box->n);
    iccp_free(b->memory, all);
    return status;
}

/* Splits every cell of a level, or turns it into a leaf. */
static icc_status descend(builder *b, const level *from, level *to)
{
    icc_status status = ICC_OK;
    for (size_t k = 0; status == ICC_OK && k < from->n_cells; ++k) {
        const cell *c = &from->cells[k];
        if (from->depth == MAX_LEVELS || !must_split(b, from, c)) {
            status = add_leaf(b, from, c);
            continue;
        }
        for (uint32_t j = 0; status == ICC_OK && j < 4; ++j)
            status =
                add_cell(b, to, 2 * c->x + j % 2, 2 * c->y + j / 2, from->entries + c->first, c->n);
    }
    return status;
}

/* Goes level by level, so that only two levels of the tree are in memory. */
static icc_status find_places(builder *b, const iccp_env *env)
{
    level levels[2] = {{.depth = 0}, {.depth = 0}};
    icc_status status = add_roots(b, &levels[0]);
    for (int k = 0; status == ICC_OK && levels[k % 2].n_cells > 0; ++k) {
        level *from = &levels[k % 2], *to = &levels[(k + 1) % 2];
        to->n_cells = to->n_entries = 0;
        for (int axis = 0; axis < 2; ++axis)
            to->side[axis] = 0.5 * from->side[axis];
        to->width = 0.5 * from->width;
        to->depth = from->depth + 1;
        status = iccp_progress(env, "mesh", (double)k / (MAX_LEVELS + 1));
        if (status == ICC_OK)
            status = descend(b, from, to);
    }
    for (int k = 0; k < 2; ++k) {
        iccp_free(b->memory, levels[k].cells);
        iccp_free(b->memory, levels[k].entries);
    }
    return status;
}

/* ---- the mesh ---- */

/* Writes a vertex that is moved a little, unless it lies on the boundary. */
static void find_vertex(const builder *b, const place *p, uint64_t *state, double *vertex)
{
    const uint32_t at[2] = {p->x, p->y};
    for (int k = 0; k < 2; ++k) {
        const double unit = (b->box->upper[k] - b->box->lower[k]) / (double)whole(b, k);
        vertex[k] = coordinate(b, k, at[k]);
        if (!on_boundary(b, p))
            vertex[k] += JITTER * unit * p->width * (iccp_random_unit(state) - 0.5);
    }
}

static icc_status copy_vertices(iccp_box_mesh *mesh, const builder *b)
{
    const size_t n = b->box->n;
    size_t count = n;
    uint64_t state = 0;
    mesh->points = iccp_alloc(&mesh->memory, n + b->n_places, 2 * sizeof *mesh->points);
    if (mesh->points == NULL)
        return ICC_ERR_MEMORY;
    memcpy(mesh->points, b->box->points, 2 * n * sizeof *mesh->points);
    for (size_t k = 0; k < b->n_places; ++k)
        if (b->places[k].is_kept)
            find_vertex(b, &b->places[k], &state, mesh->points + 2 * count++);
    mesh->n_vertices = count;
    return ICC_OK;
}

static bool is_ghost(const iccp_trimesh *t, uint32_t triangle)
{
    const iccp_corner *c = t->corners + 3 * (size_t)triangle;
    return c[0].vertex == t->n_points || c[1].vertex == t->n_points || c[2].vertex == t->n_points;
}

/* Copies the triangles without ghosts. `number` has room for one number of each triangle. */
static icc_status copy_triangles(iccp_box_mesh *mesh, const iccp_trimesh *t, uint32_t *number)
{
    size_t count = 0;
    for (uint32_t k = 0; k < t->n_triangles; ++k)
        number[k] = is_ghost(t, k) ? ICCP_NO_NEIGHBOUR : (uint32_t)count++;
    mesh->triangles = iccp_alloc(&mesh->memory, count, 3 * sizeof *mesh->triangles);
    mesh->twins = iccp_alloc(&mesh->memory, count, 3 * sizeof *mesh->twins);
    if (mesh->triangles == NULL || mesh->twins == NULL)
        return ICC_ERR_MEMORY;
    mesh->n_triangles = count;
    for (uint32_t c = 0; c < 3 * t->n_triangles; ++c) {
        if (number[c / 3] == ICCP_NO_NEIGHBOUR)
            continue;
        const size_t at = 3 * (size_t)number[c / 3] + c % 3;
        const uint32_t twin = t->corners[c].twin, other = number[twin / 3];
        mesh->triangles[at] = t->corners[c].vertex;
        mesh->twins[at] = other == ICCP_NO_NEIGHBOUR ? other : 3 * other + twin % 3;
    }
    return ICC_OK;
}

/* Forces walls into a triangulation. */
static icc_status force_walls(iccp_trimesh *t, const iccp_edge_set *edges, const iccp_env *env)
{
    iccp_walls walls = {0};
    icc_status status = iccp_walls_create(&walls, t->n_points, edges->n, edges->ends, &env->memory);
    t->walls = &walls;
    if (status == ICC_OK)
        status = iccp_constrain(t, env, NULL);
    t->walls = NULL;
    iccp_walls_free(&walls, &env->memory);
    return status;
}

icc_status iccp_box_mesh_triangulate(iccp_box_mesh *mesh, const iccp_edge_set *walls,
                                     const iccp_env *env)
{
    const size_t most = 2 * mesh->n_vertices;
    iccp_trimesh t = {.points = mesh->points, .n_points = (uint32_t)mesh->n_vertices};
    uint32_t *number = iccp_alloc(&env->memory, most, sizeof *number);
    t.corners = iccp_alloc(&env->memory, most, 3 * sizeof *t.corners);
    icc_status status = ICC_ERR_MEMORY;
    if (number != NULL && t.corners != NULL)
        status = iccp_delaunay(&t, env, NULL);
    if (status == ICC_OK && walls != NULL && walls->n > 0)
        status = force_walls(&t, walls, env);
    if (status == ICC_OK)
        status = copy_triangles(mesh, &t, number);
    iccp_free(&env->memory, t.corners);
    iccp_free(&env->memory, number);
    if (status != ICC_OK)
        iccp_box_mesh_free(mesh);
    return status;
}

icc_status iccp_graded_box_mesh(iccp_box_mesh *mesh, const iccp_graded_box *box,
                                const iccp_env *env)
{
    builder b = {.box = box, .memory = &env->memory};
    *mesh = (iccp_box_mesh){.memory = env->memory};
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 2}, env);
    icc_status status = find_places(&b, &parts[0]);
    if (status == ICC_OK)
        status = copy_vertices(mesh, &b);
    iccp_free(&env->memory, b.places);
    iccp_free(&env->memory, b.table);
    return status == ICC_OK ? iccp_box_mesh_triangulate(mesh, box->walls, &parts[1]) : status;
}

void iccp_box_mesh_free(iccp_box_mesh *mesh)
{
    iccp_free(&mesh->memory, mesh->points);
    iccp_free(&mesh->memory, mesh->triangles);
    iccp_free(&mesh->memory, mesh->twins);
    *mesh = (iccp_box_mesh){.memory = mesh->memory};
}
