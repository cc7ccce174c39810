#include "field/sides.h"

#include <string.h>

void iccp_sides_init(iccp_sides *sides, int32_t dim, const iccp_memory *memory)
{
    *sides = (iccp_sides){.memory = *memory, .dim = dim, .n_simplices = 1};
    for (int32_t k = 2; k <= dim + 1; ++k)
        sides->n_simplices *= (size_t)k;
}

void iccp_sides_free(iccp_sides *sides)
{
    iccp_free(&sides->memory, sides->vertex);
    iccp_free(&sides->memory, sides->first);
    iccp_free(&sides->memory, sides->side);
    iccp_free(&sides->memory, sides->vector);
    iccp_sides_init(sides, sides->dim, &sides->memory);
}

size_t iccp_sides_find(const iccp_sides *sides, uint32_t v)
{
    size_t low = 0, high = sides->n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sides->vertex[middle] < v)
            low = middle + 1;
        else
            high = middle;
    }
    return low < sides->n && sides->vertex[low] == v ? low : SIZE_MAX;
}

/* A simplex at the vertex: its order, the vertex' place in it, its corners. */
typedef struct member {
    int32_t r, k;
    int8_t axis[ICC_MAX_DIM];
    uint32_t corner[ICC_MAX_DIM + 1];
} member;

/* Simplex `at` of vertex v, by the numbering of iccp_side_simplex(). */
static void load(member *m, const iccp_cover *cover, const iccp_orders *orders, uint32_t v,
                 size_t at)
{
    const int32_t dim = orders->dim;
    m->r = (int32_t)(at / (size_t)(dim + 1));
    m->k = (int32_t)(at % (size_t)(dim + 1));
    memcpy(m->axis, orders->axis[m->r], sizeof m->axis);
    m->corner[0] = v;
    for (int32_t i = 0; i < m->k; ++i)
        m->corner[0] -= (uint32_t)cover->grid->stride[m->axis[i]];
    for (int32_t i = 0; i < dim; ++i)
        m->corner[i + 1] = m->corner[i] + (uint32_t)cover->grid->stride[m->axis[i]];
}

/* Across the face opposite to corner i < dim, i != k; the face's number there. */
static int32_t cross(const member *m, const iccp_cover *cover, int32_t i, member *other)
{
    const int32_t dim = cover->grid->dim;
    *other = *m;
    if (i > 0) {
        other->axis[i - 1] = m->axis[i];
        other->axis[i] = m->axis[i - 1];
        other->r = iccp_order_rank(dim, other->axis);
        return i;
    }
    memmove(other->axis, m->axis + 1, (size_t)(dim - 1) * sizeof *m->axis);
    other->axis[dim - 1] = m->axis[0];
    other->corner[0] = m->corner[1];
    other->r = iccp_order_rank(dim, other->axis);
    --other->k;
    return dim;
}

/* Whether the domain continues through a face: surely where a corner is inside, perhaps where the
 * boundary meets the face. A simplex without a vertex inside is taken to belong to its
 * neighbours. */
static bool is_open(const member *m, const member *other, const iccp_cover *cover, int32_t i,
                    int32_t other_i)
{
    const icc_grid *grid = cover->grid;
    bool face_inside = false;
    for (int32_t j = 0; j <= grid->dim; ++j)
        face_inside = face_inside || (j != i && grid->inside[m->corner[j]]);
    uint32_t other_corner = other->corner[0];
    for (int32_t j = 0; j < other_i; ++j)
        other_corner += (uint32_t)grid->stride[other->axis[j]];
    if (face_inside || !grid->inside[m->corner[i]] || !grid->inside[other_corner])
        return true;
    return (cover->faces[m->corner[0]] & iccp_cover_face_bit(grid->dim, m->r, i)) != 0 ||
           (cover->faces[other->corner[0]] & iccp_cover_face_bit(grid->dim, other->r, other_i)) !=
               0;
}

/* Gives two parts the smaller number. */
static void join(size_t n, uint8_t *side, uint8_t a, uint8_t b)
{
    const uint8_t from = a > b ? a : b, to = a > b ? b : a;
    for (size_t i = 0; i < n && from != to; ++i)
        side[i] = side[i] == from ? to : side[i];
}

/* Numbers 0, 1, .. in the order of first use. */
static int renumber(size_t n, uint8_t *side)
{
    uint8_t name[ICCP_NO_SIDE];
    int count = 0;
    memset(name, ICCP_NO_SIDE, sizeof name);
    for (size_t i = 0; i < n; ++i)
        if (side[i] != ICCP_NO_SIDE) {
            if (name[side[i]] == ICCP_NO_SIDE)
                name[side[i]] = (uint8_t)count++;
            side[i] = name[side[i]];
        }
    return count;
}

/* Every active simplex starts as a part of its own; open faces join parts. */
int iccp_sides_split(const iccp_cover *cover, const iccp_orders *orders, uint32_t v,
                     const uint8_t *active, uint8_t *side)
{
    const int32_t dim = orders->dim;
    const size_t n = (size_t)(orders->n * (dim + 1));
    int count = 0;
    for (size_t i = 0; i < n; ++i) {
        /* Too many to be told apart are one. */
        side[i] = active[i] ? (uint8_t)(count < ICCP_NO_SIDE - 1 ? count++ : count) : ICCP_NO_SIDE;
    }
    for (size_t at = 0; at < n; ++at) {
        member m, other;
        if (!active[at])
            continue;
        load(&m, cover, orders, v, at);
        for (int32_t i = 0; i < dim; ++i) {
            if (i == m.k)
                continue;
            const int32_t other_i = cross(&m, cover, i, &other);
            const size_t there = iccp_side_simplex(dim, other.r, other.k);
            if (active[there] && is_open(&m, &other, cover, i, other_i))
                join(n, side, side[at], side[there]);
        }
    }
    return renumber(n, side);
}

/* Arrays grow by doubling; a failed allocation leaves what is there intact. */
icc_status iccp_sides_add(iccp_sides *sides, uint32_t v, int n_sides, const uint8_t *side)
{
    const size_t dim = (size_t)sides->dim;
    if (sides->n == sides->capacity) {
        const size_t room = 2 * sides->capacity + 64;
        uint32_t *vertex = iccp_grow(&sides->memory, sides->vertex, sides->n, room, sizeof *vertex);
        sides->vertex = vertex != NULL ? vertex : sides->vertex;
        uint32_t *first = iccp_grow(&sides->memory, sides->first, sides->n, room, sizeof *first);
        sides->first = first != NULL ? first : sides->first;
        uint8_t *all = iccp_grow(&sides->memory, sides->side, sides->n, room, sides->n_simplices);
        sides->side = all != NULL ? all : sides->side;
        if (vertex == NULL || first == NULL || all == NULL)
            return ICC_ERR_MEMORY;
        sides->capacity = room;
    }
    if (sides->n_vectors + (size_t)n_sides > sides->vector_capacity) {
        const size_t room = 2 * sides->vector_capacity + 256;
        float *vector =
            iccp_grow(&sides->memory, sides->vector, sides->n_vectors, room, dim * sizeof *vector);
        if (vector == NULL)
            return ICC_ERR_MEMORY;
        sides->vector = vector;
        sides->vector_capacity = room;
    }
    memcpy(sides->side + sides->n_simplices * sides->n, side, sides->n_simplices);
    memset(sides->vector + dim * sides->n_vectors, 0,
           (size_t)n_sides * dim * sizeof *sides->vector);
    sides->vertex[sides->n] = v;
    sides->first[sides->n++] = (uint32_t)sides->n_vectors;
    sides->n_vectors += (size_t)n_sides;
    return ICC_OK;
}
