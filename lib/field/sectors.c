/* Divides the simplices at a vertex into sectors, and stores a vector for each. See sectors.h
 * for the idea. */
#include "field/sectors.h"

#include <string.h>

void iccp_sectors_init(iccp_sectors *sectors, int32_t dim, const iccp_memory *memory)
{
    *sectors = (iccp_sectors){.memory = *memory, .dim = dim, .n_simplices = 1};
    for (int32_t k = 2; k <= dim + 1; ++k)
        sectors->n_simplices *= (size_t)k;
}

void iccp_sectors_free(iccp_sectors *sectors)
{
    iccp_free(&sectors->memory, sectors->vertex);
    iccp_free(&sectors->memory, sectors->first);
    iccp_free(&sectors->memory, sectors->sector);
    iccp_free(&sectors->memory, sectors->vector);
    iccp_sectors_init(sectors, sectors->dim, &sectors->memory);
}

size_t iccp_sectors_find(const iccp_sectors *sectors, uint32_t v)
{
    size_t low = 0, high = sectors->n;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (sectors->vertex[middle] < v)
            low = middle + 1;
        else
            high = middle;
    }
    return low < sectors->n && sectors->vertex[low] == v ? low : SIZE_MAX;
}

/* A simplex at the vertex: its order, the number k of the vertex among its corners, and the
 * corners. */
typedef struct member {
    int32_t r, k;
    int8_t axis[ICC_MAX_DIM];
    uint32_t corner[ICC_MAX_DIM + 1];
} member;

/* Simplex `at` of vertex v, by the numbering of iccp_sector_simplex(). */
static void load_simplex(member *m, const iccp_incidence *incidence, const iccp_orders *orders,
                         uint32_t v, size_t at)
{
    const int32_t dim = orders->dim;
    m->r = (int32_t)(at / (size_t)(dim + 1));
    m->k = (int32_t)(at % (size_t)(dim + 1));
    memcpy(m->axis, orders->axis[m->r], sizeof m->axis);
    m->corner[0] = v;
    for (int32_t i = 0; i < m->k; ++i)
        m->corner[0] -= (uint32_t)incidence->grid->stride[m->axis[i]];
    for (int32_t i = 0; i < dim; ++i)
        m->corner[i + 1] = m->corner[i] + (uint32_t)incidence->grid->stride[m->axis[i]];
}

/* Finds the simplex across the face opposite to corner i, with i != k. Returns the number of
 * the face in that simplex. */
static int32_t cross(const member *m, const iccp_incidence *incidence, int32_t i, member *other)
{
    const int32_t dim = incidence->grid->dim;
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

/* Returns true if the domain continues through a face. It does if a corner is inside, and it may
 * if the boundary meets the face. A simplex without an inside vertex is joined to its
 * neighbours. */
static bool is_open(const member *m, const member *other, const iccp_incidence *incidence,
                    int32_t i, int32_t other_i)
{
    const icc_grid *grid = incidence->grid;
    bool face_inside = false;
    for (int32_t j = 0; j <= grid->dim; ++j)
        face_inside = face_inside || (j != i && grid->inside[m->corner[j]]);
    uint32_t other_corner = other->corner[0];
    for (int32_t j = 0; j < other_i; ++j)
        other_corner += (uint32_t)grid->stride[other->axis[j]];
    if (face_inside || !grid->inside[m->corner[i]] || !grid->inside[other_corner])
        return true;
    return (incidence->faces[m->corner[0]] & iccp_incidence_face_bit(grid->dim, m->r, i)) != 0 ||
           (incidence->faces[other->corner[0]] &
            iccp_incidence_face_bit(grid->dim, other->r, other_i)) != 0;
}

/* Gives two parts the smaller of their numbers. */
static void join(size_t n, uint8_t *sector, uint8_t a, uint8_t b)
{
    const uint8_t from = a > b ? a : b, to = a > b ? b : a;
    for (size_t i = 0; i < n && from != to; ++i)
        sector[i] = sector[i] == from ? to : sector[i];
}

/* Numbers the parts 0, 1, .. in the order of first use. */
static int renumber(size_t n, uint8_t *sector)
{
    uint8_t name[ICCP_NO_SECTOR];
    int count = 0;
    memset(name, ICCP_NO_SECTOR, sizeof name);
    for (size_t i = 0; i < n; ++i)
        if (sector[i] != ICCP_NO_SECTOR) {
            if (name[sector[i]] == ICCP_NO_SECTOR)
                name[sector[i]] = (uint8_t)count++;
            sector[i] = name[sector[i]];
        }
    return count;
}

/* Every active simplex starts as a part of its own. Open faces then join parts. */
int iccp_sectors_split(const iccp_incidence *incidence, const iccp_orders *orders, uint32_t v,
                       const uint8_t *active, uint8_t *sector)
{
    const int32_t dim = orders->dim;
    const size_t n = (size_t)(orders->n * (dim + 1));
    int count = 0;
    for (size_t i = 0; i < n; ++i) {
        /* Parts beyond the largest number share that number. */
        sector[i] =
            active[i] ? (uint8_t)(count < ICCP_NO_SECTOR - 1 ? count++ : count) : ICCP_NO_SECTOR;
    }
    for (size_t at = 0; at < n; ++at) {
        member m, other;
        if (!active[at])
            continue;
        load_simplex(&m, incidence, orders, v, at);
        for (int32_t i = 0; i < dim; ++i) {
            if (i == m.k)
                continue;
            const int32_t other_i = cross(&m, incidence, i, &other);
            const size_t there = iccp_sector_simplex(dim, other.r, other.k);
            if (active[there] && is_open(&m, &other, incidence, i, other_i))
                join(n, sector, sector[at], sector[there]);
        }
    }
    return renumber(n, sector);
}

/* Adds a vertex. Arrays grow by doubling, and a failed allocation leaves the old contents
 * intact. */
icc_status iccp_sectors_add(iccp_sectors *sectors, uint32_t v, int n_sectors, const uint8_t *sector)
{
    const size_t dim = (size_t)sectors->dim;
    if (sectors->n == sectors->capacity) {
        const size_t room = 2 * sectors->capacity + 64;
        uint32_t *vertex =
            iccp_grow(&sectors->memory, sectors->vertex, sectors->n, room, sizeof *vertex);
        sectors->vertex = vertex != NULL ? vertex : sectors->vertex;
        uint32_t *first =
            iccp_grow(&sectors->memory, sectors->first, sectors->n, room, sizeof *first);
        sectors->first = first != NULL ? first : sectors->first;
        uint8_t *all =
            iccp_grow(&sectors->memory, sectors->sector, sectors->n, room, sectors->n_simplices);
        sectors->sector = all != NULL ? all : sectors->sector;
        if (vertex == NULL || first == NULL || all == NULL)
            return ICC_ERR_MEMORY;
        sectors->capacity = room;
    }
    if (sectors->n_vectors + (size_t)n_sectors > sectors->vector_capacity) {
        const size_t room = 2 * sectors->vector_capacity + 256;
        float *vector = iccp_grow(&sectors->memory, sectors->vector, sectors->n_vectors, room,
                                  dim * sizeof *vector);
        if (vector == NULL)
            return ICC_ERR_MEMORY;
        sectors->vector = vector;
        sectors->vector_capacity = room;
    }
    memcpy(sectors->sector + sectors->n_simplices * sectors->n, sector, sectors->n_simplices);
    memset(sectors->vector + dim * sectors->n_vectors, 0,
           (size_t)n_sectors * dim * sizeof *sectors->vector);
    sectors->vertex[sectors->n] = v;
    sectors->first[sectors->n++] = (uint32_t)sectors->n_vectors;
    sectors->n_vectors += (size_t)n_sectors;
    return ICC_OK;
}
