/* Sums derivatives of elements to a gradient and a sparse Hessian: O. C. Zienkiewicz, R. L. Taylor,
 * The Finite Element Method, chapter 1. The places where each element adds are found once. */
#include "map/energy/assembly.h"

#include "base/threads.h"

#include <string.h>

static const uint32_t NONE = UINT32_MAX;

/* This share of the mean diagonal is added to the diagonal. Without it the Hessian may be singular,
 * because negative curvature is left out. */
static const double SHIFT = 1e-10;

/* GRAIN: elements that a thread takes at once. MOST_SEARCHES: threads that list neighbours at the
 * same time, each of which reads all elements. STRETCHES: pieces into which the list of elements is
 * divided. */
enum { GRAIN = 1024, MOST_SEARCHES = 4, STRETCHES = 16 };

/* ---- pattern ---- */

static ICCP_INLINE uint32_t slot_of(size_t dim, const iccp_assembly *s, size_t element,
                                    size_t corner)
{
    return s->slot[s->corners[(dim + 1) * s->simplex[element] + corner]];
}

/* Numbers the free points, and lists the simplices that have a free corner. */
static icc_status list_parts(iccp_assembly *s, const iccp_simplicial_map *map,
                             const uint8_t *movable)
{
    s->slot = iccp_alloc(&s->memory, map->n_points, sizeof *s->slot);
    s->free_point = iccp_alloc(&s->memory, map->n_points, sizeof *s->free_point);
    s->simplex = iccp_alloc(&s->memory, map->n_simplices, sizeof *s->simplex);
    if (s->slot == NULL || s->free_point == NULL || s->simplex == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < map->n_points; ++v) {
        s->slot[v] = NONE;
        if (!iccp_simplicial_is_fixed(map, v) && (movable == NULL || movable[v])) {
            s->slot[v] = (uint32_t)s->n_free;
            s->free_point[s->n_free++] = v;
        }
    }
    for (uint32_t t = 0; t < map->n_simplices; ++t) {
        const uint32_t *v = map->corners + (s->dim + 1) * t;
        bool is_free = false;
        for (size_t k = 0; k <= s->dim; ++k)
            is_free |= s->slot[v[k]] != NONE;
        if (is_free)
            s->simplex[s->n_elements++] = t;
    }
    return ICC_OK;
}

/* Holds the neighbours of the free points until their columns are written. */
typedef struct lists {
    iccp_assembly *s;
    size_t *room;     /* where each point's list begins */
    uint32_t *degree; /* the length of each list */
    uint32_t *list;
} lists;

/* Lists the free neighbours of free points [begin, end), each once. */
static ICCP_INLINE void list_neighbours(size_t dim, const lists *l, size_t begin, size_t end)
{
    const iccp_assembly *s = l->s;
    uint32_t *neighbour = s->neighbour;
    memset(l->degree + begin, 0, (end - begin) * sizeof *l->degree);
    for (size_t e = 0; e < s->n_elements; ++e)
        for (size_t i = 0; i <= dim; ++i, neighbour += dim) {
            const uint32_t a = slot_of(dim, s, e, i);
            if (a == NONE ? begin > 0 : a < begin || a >= end)
                continue;
            for (size_t j = 0, pair = 0; j <= dim; ++j) {
                const uint32_t b = slot_of(dim, s, e, j);
                if (i == j)
                    continue;
                uint32_t *at = &neighbour[pair++], k = 0;
                *at = NONE;
                if (a == NONE || b == NONE)
                    continue;
                uint32_t *own = l->list + l->room[a];
                while (k < l->degree[a] && own[k] != b)
                    ++k;
                if (k == l->degree[a])
                    own[l->degree[a]++] = b;
                *at = k;
            }
        }
}

static icc_status search(void *argument, size_t begin, size_t end)
{
    const lists *l = argument;
    if (l->s->dim == 2)
        list_neighbours(2, l, begin, end);
    else
        list_neighbours(3, l, begin, end);
    return ICC_OK;
}

static icc_status write_columns(void *argument, size_t begin, size_t end)
{
    const lists *l = argument;
    const iccp_assembly *s = l->s;
    const uint32_t dim = (uint32_t)s->dim;
    for (uint32_t i = (uint32_t)begin; i < end; ++i)
        for (uint32_t d = 0; d < dim; ++d) {
            uint32_t *column = s->column + s->first[dim * i + d];
            for (uint32_t c = 0; c < dim; ++c)
                if (c != d)
                    *column++ = dim * i + c;
            for (uint32_t k = 0; k < l->degree[i]; ++k)
                for (uint32_t c = 0; c < dim; ++c)
                    *column++ = dim * l->list[l->room[i] + k] + c;
        }
    return ICC_OK;
}

/* Writes the rows' lengths and columns. */
static icc_status build_pattern(lists *l, const iccp_env *env)
{
    iccp_assembly *s = l->s;
    const size_t dim = s->dim;
    size_t n_entries = 0;
    for (size_t i = 0; i < s->n_free; ++i)
        for (size_t d = 0; d < dim; ++d) {
            s->first[dim * i + d] = n_entries;
            n_entries += dim - 1 + dim * (size_t)l->degree[i];
        }
    s->first[dim * s->n_free] = n_entries;
    s->column = iccp_alloc(&s->memory, n_entries, sizeof *s->column);
    return s->column != NULL ? iccp_for_chunks(env, "improve", s->n_free, GRAIN, write_columns, l)
                             : ICC_ERR_MEMORY;
}

/* Lists the neighbours first, with room for every pair of corners. Then writes the pattern in
 * exactly the room that it needs. */
static icc_status find_pattern(iccp_assembly *s, const iccp_env *env)
{
    const size_t dim = s->dim;
    const size_t n_searches = s->n_free < GRAIN              ? 1
                              : env->threads < MOST_SEARCHES ? (size_t)env->threads
                                                             : MOST_SEARCHES;
    lists l = {.s = s,
               .room = iccp_alloc_zero(&s->memory, s->n_free + 1, sizeof *l.room),
               .degree = iccp_alloc(&s->memory, s->n_free, sizeof *l.degree),
               .list = iccp_alloc(&s->memory, dim * (dim + 1) * s->n_elements, sizeof *l.list)};
    icc_status status = ICC_ERR_MEMORY;
    if (l.room != NULL && l.degree != NULL && l.list != NULL) {
        for (size_t e = 0; e < s->n_elements; ++e)
            for (size_t k = 0; k <= dim; ++k)
                if (slot_of(dim, s, e, k) != NONE)
                    l.room[slot_of(dim, s, e, k) + 1] += dim;
        for (size_t i = 0; i < s->n_free; ++i)
            l.room[i + 1] += l.room[i];
        status = iccp_for_chunks(env, "improve", s->n_free, s->n_free / n_searches + 1, search, &l);
    }
    if (status == ICC_OK)
        status = build_pattern(&l, env);
    iccp_free(&s->memory, l.room);
    iccp_free(&s->memory, l.degree);
    iccp_free(&s->memory, l.list);
    return status;
}

icc_status iccp_assembly_create(iccp_assembly *assembly, const iccp_simplicial_map *map,
                                const uint8_t *movable, const iccp_env *env)
{
    iccp_assembly *s = assembly;
    const iccp_env quiet = iccp_quiet(env);
    *s = (iccp_assembly){.memory = env->memory, .dim = map->dim, .corners = map->corners};
    icc_status status = list_parts(s, map, movable);
    if (status == ICC_OK) {
        const size_t n = s->dim * s->n_free, n_pairs = s->dim * (s->dim + 1);
        s->neighbour = iccp_alloc(&s->memory, s->n_elements, n_pairs * sizeof *s->neighbour);
        s->first = iccp_alloc(&s->memory, n + 1, sizeof *s->first);
        status =
            s->neighbour != NULL && s->first != NULL ? find_pattern(s, &quiet) : ICC_ERR_MEMORY;
    }
    if (status != ICC_OK)
        iccp_assembly_free(s);
    return status;
}

icc_status iccp_assembly_make_room(iccp_assembly *assembly)
{
    iccp_assembly *s = assembly;
    const size_t n = s->dim * s->n_free;
    if (s->value == NULL)
        s->value = iccp_alloc(&s->memory, s->first[n], sizeof *s->value);
    if (s->diagonal == NULL)
        s->diagonal = iccp_alloc(&s->memory, n, sizeof *s->diagonal);
    if (s->gradient == NULL)
        s->gradient = iccp_alloc(&s->memory, n, sizeof *s->gradient);
    return s->value != NULL && s->diagonal != NULL && s->gradient != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_assembly_share(iccp_assembly *assembly, const iccp_assembly *pattern,
                               const iccp_simplicial_map *map, const iccp_memory *memory)
{
    iccp_assembly *s = assembly;
    *s = *pattern;
    s->memory = *memory;
    s->corners = map->corners;
    s->borrows = true;
    s->value = s->diagonal = s->gradient = NULL;
    const icc_status status = iccp_assembly_make_room(s);
    if (status != ICC_OK)
        iccp_assembly_free(s);
    return status;
}

void iccp_assembly_free(iccp_assembly *assembly)
{
    iccp_assembly *s = assembly;
    void *const pattern[] = {s->free_point, s->slot, s->simplex,       s->neighbour, s->first,
                             s->column,     s->part, s->first_element, s->element};
    iccp_free(&s->memory, s->value);
    iccp_free(&s->memory, s->diagonal);
    iccp_free(&s->memory, s->gradient);
    for (size_t k = 0; k < sizeof pattern / sizeof *pattern && !s->borrows; ++k)
        iccp_free(&s->memory, pattern[k]);
    *s = (iccp_assembly){.memory = s->memory};
}

/* ---- parts ---- */

typedef struct elimination {
    iccp_assembly *s;
    const uint32_t *position;
} elimination;

/* Numbers an element's neighbours among those that are eliminated later, and leaves out the others.
 * The rows still hold all neighbours. */
static icc_status leave_out(void *argument, size_t begin, size_t end)
{
    const elimination *el = argument;
    const iccp_assembly *s = el->s;
    const size_t dim = s->dim;
    uint32_t *neighbour = s->neighbour + dim * (dim + 1) * begin;
    for (size_t e = begin; e < end; ++e)
        for (size_t a = 0; a <= dim; ++a)
            for (size_t b = 0; b < dim; ++b, ++neighbour) {
                if (*neighbour == NONE)
                    continue;
                const size_t row = dim * slot_of(dim, s, e, a);
                const uint32_t *column = s->column + s->first[row] + dim - 1, own = *neighbour;
                uint32_t n_later = 0;
                for (uint32_t k = 0; k < own; ++k)
                    n_later += el->position[column[dim * k]] > el->position[row];
                *neighbour = el->position[column[dim * own]] > el->position[row] ? n_later : NONE;
            }
    return ICC_OK;
}

/* Takes the entries in earlier rows out of all rows. Every entry is stored twice, so half of those
 * outside of the points' own blocks stay. */
static icc_status shorten_rows(iccp_assembly *s, const uint32_t *position)
{
    const size_t dim = s->dim, n_rows = dim * s->n_free, n_own = (dim - 1) * n_rows;
    const size_t n_entries = n_own + (s->first[n_rows] - n_own) / 2;
    uint32_t *column = iccp_alloc(&s->memory, n_entries, sizeof *column);
    double *value = s->value != NULL ? iccp_alloc(&s->memory, n_entries, sizeof *value) : NULL;
    size_t n = 0, begin = 0;
    if (column == NULL || (s->value != NULL && value == NULL)) {
        iccp_free(&s->memory, column);
        iccp_free(&s->memory, value);
        return ICC_ERR_MEMORY;
    }
    for (size_t row = 0; row < n_rows; ++row) {
        const size_t end = s->first[row + 1];
        s->first[row] = n;
        for (size_t q = begin; q < end; ++q) {
            const uint32_t c = s->column[q];
            if (q >= begin + dim - 1 && position[c] < position[row])
                continue;
            if (value != NULL)
                value[n] = s->value[q];
            column[n++] = c;
        }
        begin = end;
    }
    s->first[n_rows] = n;
    iccp_free(&s->memory, s->column);
    iccp_free(&s->memory, s->value);
    s->column = column;
    s->value = value;
    return ICC_OK;
}

/* Lists the parts in which an element has a corner, each once. Returns their number. */
static ICCP_INLINE size_t parts_of(size_t dim, const iccp_assembly *s, size_t element,
                                   uint32_t part[4])
{
    size_t n = 0;
    for (size_t k = 0; k <= dim; ++k) {
        const uint32_t slot = slot_of(dim, s, element, k);
        size_t i = slot == NONE ? n : 0;
        if (slot != NONE)
            part[n] = s->part[slot];
        while (i < n && part[i] != part[n])
            ++i;
        n += slot != NONE && i == n;
    }
    return n;
}

/* Each thread lists the elements of one stretch. */
typedef struct listing {
    iccp_assembly *s;
    size_t stretch; /* elements of a stretch */
    size_t *place;  /* by stretch and part: first the number of elements, then their place in the
                       list */
} listing;

static icc_status count_elements(void *argument, size_t begin, size_t end)
{
    const listing *l = argument;
    size_t *own = l->place + begin / l->stretch * l->s->n_parts;
    uint32_t part[4];
    for (size_t e = begin; e < end; ++e)
        for (size_t k = parts_of(l->s->dim, l->s, e, part); k-- > 0;)
            ++own[part[k]];
    return ICC_OK;
}

static icc_status place_elements(void *argument, size_t begin, size_t end)
{
    const listing *l = argument;
    size_t *own = l->place + begin / l->stretch * l->s->n_parts;
    uint32_t part[4];
    for (size_t e = begin; e < end; ++e)
        for (size_t k = parts_of(l->s->dim, l->s, e, part); k-- > 0;)
            l->s->element[own[part[k]]++] = (uint32_t)e;
    return ICC_OK;
}

/* Works in two passes: the first counts the elements of each part, and the second fills them in, in
 * order. */
static icc_status list_elements(iccp_assembly *s, const iccp_env *env)
{
    const size_t stretch = s->n_elements / STRETCHES + 1;
    const size_t n = s->n_elements / stretch + 1;
    const listing l = {s, stretch, iccp_alloc_zero(&s->memory, n, s->n_parts * sizeof(size_t))};
    size_t total = 0;
    icc_status status = ICC_ERR_MEMORY;
    s->first_element = iccp_alloc(&s->memory, s->n_parts + 1, sizeof *s->first_element);
    if (l.place != NULL && s->first_element != NULL)
        status =
            iccp_for_chunks(env, "improve", s->n_elements, stretch, count_elements, (void *)&l);
    for (size_t p = 0; status == ICC_OK && p < s->n_parts; ++p) {
        s->first_element[p] = total;
        for (size_t k = 0; k < n; ++k) {
            const size_t own = l.place[k * s->n_parts + p];
            l.place[k * s->n_parts + p] = total;
            total += own;
        }
    }
    if (status == ICC_OK) {
        s->first_element[s->n_parts] = total;
        s->element = iccp_alloc(&s->memory, total, sizeof *s->element);
        status = s->element == NULL ? ICC_ERR_MEMORY
                                    : iccp_for_chunks(env, "improve", s->n_elements, stretch,
                                                      place_elements, (void *)&l);
    }
    iccp_free(&s->memory, l.place);
    return status;
}

icc_status iccp_assembly_divide(iccp_assembly *assembly, const uint32_t *position, size_t n_parts,
                                const iccp_env *env)
{
    iccp_assembly *s = assembly;
    const size_t n_rows = s->dim * s->n_free;
    const iccp_env quiet = iccp_quiet(env);
    icc_status status = iccp_for_chunks(&quiet, "improve", s->n_elements, GRAIN, leave_out,
                                        &(elimination){s, position});
    if (status == ICC_OK)
        status = shorten_rows(s, position);
    if (status != ICC_OK || n_parts <= 1)
        return status;
    s->n_parts = n_parts;
    s->part = iccp_alloc(&s->memory, s->n_free, sizeof *s->part);
    if (s->part == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < s->n_free; ++i)
        s->part[i] = (uint32_t)((uint64_t)position[s->dim * i] * n_parts / n_rows);
    return list_elements(s, &quiet);
}

/* ---- sums ---- */

void iccp_assembly_begin(iccp_assembly *assembly, size_t begin, size_t end)
{
    iccp_assembly *s = assembly;
    const size_t row = s->dim * begin, n = s->dim * (end - begin);
    const size_t n_values = s->first[row + n] - s->first[row];
    memset(s->gradient + row, 0, n * sizeof *s->gradient);
    memset(s->diagonal + row, 0, n * sizeof *s->diagonal);
    memset(s->value + s->first[row], 0, n_values * sizeof *s->value);
}

/* Adds each corner's gradient and own block, then the blocks of all pairs of corners. */
static ICCP_INLINE void add(size_t dim, iccp_assembly *s, size_t part, size_t element,
                            const iccp_local *local)
{
    const size_t n = dim * (dim + 1);
    const uint32_t *neighbour = s->neighbour + n * element;
    uint32_t slot[4];
    for (size_t a = 0; a <= dim; ++a) {
        slot[a] = slot_of(dim, s, element, a);
        if (slot[a] != NONE && part != ICCP_ALL_PARTS && s->part[slot[a]] != part)
            slot[a] = NONE;
    }
    for (size_t a = 0; a <= dim; ++a) {
        const uint32_t i = slot[a];
        for (size_t d = 0; d < dim && i != NONE; ++d) {
            const double *row = local->hessian + n * (dim * a + d) + dim * a;
            double *value = s->value + s->first[dim * i + d];
            s->gradient[dim * i + d] += local->gradient[dim * a + d];
            s->diagonal[dim * i + d] += row[d];
            for (size_t c = 0; c < dim; ++c)
                if (c != d)
                    *value++ += row[c];
        }
    }
    for (size_t a = 0; a <= dim; ++a)
        for (size_t b = 0; b <= dim; ++b) {
            const uint32_t k = a != b ? *neighbour++ : NONE;
            const uint32_t i = slot[a];
            for (size_t d = 0; d < dim && k != NONE && i != NONE; ++d) {
                const double *row = local->hessian + n * (dim * a + d) + dim * b;
                double *value = s->value + s->first[dim * i + d] + dim - 1 + dim * k;
                for (size_t c = 0; c < dim; ++c)
                    value[c] += row[c];
            }
        }
}

void iccp_assembly_add(iccp_assembly *assembly, size_t part, size_t element,
                       const iccp_local *local)
{
    if (assembly->dim == 2)
        add(2, assembly, part, element, local);
    else
        add(3, assembly, part, element, local);
}

void iccp_assembly_end(iccp_assembly *assembly)
{
    const size_t n = assembly->dim * assembly->n_free;
    double sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum += assembly->diagonal[i];
    for (size_t i = 0; i < n; ++i)
        assembly->diagonal[i] += SHIFT * sum / (double)n;
}
