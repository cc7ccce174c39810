/* The mesh of tetrahedra under construction. */
#include "fill/tets.h"

#include "base/random.h"

#include <string.h>

const uint8_t iccp_tet_face[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};

void iccp_tets_init(iccp_tets *m, const iccp_memory *memory)
{
    *m = (iccp_tets){.memory = *memory, .free = ICCP_NO_TET, .round = 1, .random = 1};
    m->kept.memory = *memory;
}

void iccp_tets_free(iccp_tets *m)
{
    iccp_list *const lists[] = {&m->star,  &m->ring,  &m->link, &m->cavity,
                                &m->sides, &m->fresh, &m->work};
    for (size_t i = 0; i < sizeof lists / sizeof *lists; ++i)
        iccp_free(&m->memory, lists[i]->item);
    iccp_pairs_free(&m->kept);
    iccp_free(&m->memory, m->points.x);
    iccp_free(&m->memory, m->points.dyadic);
    iccp_free(&m->memory, m->tet_of);
    iccp_free(&m->memory, m->seen);
    iccp_free(&m->memory, m->touched);
    iccp_free(&m->memory, m->tet);
    iccp_free(&m->memory, m->mark);
}

bool iccp_list_reserve(iccp_tets *m, iccp_list *list, size_t room)
{
    if (room <= list->room)
        return true;
    const size_t n = room < 2 * list->room ? 2 * list->room : room < 64 ? 64 : room;
    if (!iccp_enlarge(&m->memory, &list->item, list->room, n, sizeof *list->item)) {
        m->no_memory = true;
        return false;
    }
    list->room = n;
    return true;
}

bool iccp_list_push(iccp_tets *m, iccp_list *list, uint32_t item)
{
    if (list->n == list->room && !iccp_list_reserve(m, list, list->n + 1))
        return false;
    list->item[list->n++] = item;
    return true;
}

uint32_t iccp_tets_add_point(iccp_tets *m, const double *x)
{
    iccp_points *const p = &m->points;
    if (p->n == p->room) {
        const size_t room = 2 * p->room + 64;
        if (!iccp_enlarge(&m->memory, &p->x, p->room, room, 3 * sizeof *p->x) ||
            !iccp_enlarge(&m->memory, &m->tet_of, p->room, room, sizeof *m->tet_of) ||
            !iccp_enlarge(&m->memory, &m->seen, p->room, room, sizeof *m->seen) ||
            !iccp_enlarge(&m->memory, &m->touched, p->room, room, sizeof *m->touched)) {
            m->no_memory = true;
            return ICCP_NO_TET;
        }
        p->room = room;
    }
    memcpy(p->x + 3 * p->n, x, 3 * sizeof *x);
    m->tet_of[p->n] = ICCP_NO_TET;
    m->seen[p->n] = 0;
    m->touched[p->n] = m->round;
    return (uint32_t)p->n++;
}

void iccp_tets_drop_point(iccp_tets *m)
{
    --m->points.n;
}

bool iccp_tets_reserve(iccp_tets *m, size_t n_more)
{
    if (m->n_tets + n_more <= m->room)
        return true;
    const size_t room = m->n_tets + n_more + m->room / 2 + 64;
    if (room >= ICCP_WALL / 4 ||
        !iccp_enlarge(&m->memory, &m->tet, m->n_tets, room, sizeof *m->tet) ||
        !iccp_enlarge(&m->memory, &m->mark, m->n_tets, room, sizeof *m->mark)) {
        m->no_memory = true;
        return false;
    }
    m->room = room;
    return true;
}

uint32_t iccp_tets_new(iccp_tets *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    uint32_t t = m->free;
    if (t == ICCP_NO_TET) {
        t = (uint32_t)m->n_tets++;
        m->mark[t] = 0;
    } else {
        m->free = m->tet[t].across[0];
    }
    m->tet[t] = (iccp_tet){{a, b, c, d}, {ICCP_NO_TET, ICCP_NO_TET, ICCP_NO_TET, ICCP_NO_TET}};
    m->tet_of[a] = m->tet_of[b] = m->tet_of[c] = m->tet_of[d] = t;
    m->touched[a] = m->touched[b] = m->touched[c] = m->touched[d] = m->round;
    ++m->n_alive;
    return t;
}

bool iccp_tets_copy(iccp_tets *m, const iccp_simplices *mesh)
{
    for (size_t v = 0; v < mesh->n_points; ++v)
        if (iccp_tets_add_point(m, mesh->points + 3 * v) == ICCP_NO_TET)
            return false;
    if (!iccp_tets_reserve(m, mesh->n_simplices))
        return false;
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        const uint32_t *v = mesh->corners + 4 * t;
        (void)iccp_tets_new(m, v[0], v[1], v[2], v[3]);
        memcpy(m->tet[t].across, mesh->across + 4 * t, sizeof m->tet[t].across);
    }
    return true;
}

void iccp_tets_kill(iccp_tets *m, uint32_t t)
{
    m->tet[t].v[0] = ICCP_NO_TET;
    m->tet[t].across[0] = m->free;
    m->free = t;
    --m->n_alive;
}

uint32_t iccp_tets_stamp(iccp_tets *m)
{
    if (++m->stamp == 0) {
        memset(m->mark, 0, m->n_tets * sizeof *m->mark);
        memset(m->seen, 0, m->points.n * sizeof *m->seen);
        m->stamp = 1;
    }
    return m->stamp;
}

bool iccp_tets_star(iccp_tets *m, uint32_t point)
{
    const uint32_t stamp = iccp_tets_stamp(m), first = m->tet_of[point];
    m->star.n = 0;
    m->mark[first] = stamp;
    if (!iccp_list_push(m, &m->star, first))
        return false;
    for (size_t k = 0; k < m->star.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->star.item[k]];
        for (int i = 0; i < 4; ++i) {
            const uint32_t other = tet->across[i] / 4;
            if (tet->v[i] == point || iccp_is_wall_side(tet->across[i]) || m->mark[other] == stamp)
                continue;
            m->mark[other] = stamp;
            if (!iccp_list_push(m, &m->star, other))
                return false;
        }
    }
    return true;
}

/* Goes around from the first tetrahedron, across the face opposite the first of its two other
 * points, and so on. These points are taken in the order that makes the tetrahedron positive. */
bool iccp_tets_ring(iccp_tets *m, uint32_t a, uint32_t b, uint32_t tet, size_t most)
{
    /* Third and fourth corner after corners i and j, such that the permutation is even. */
    static const uint8_t after[4][4][2] = {{{0, 0}, {2, 3}, {3, 1}, {1, 2}},
                                           {{3, 2}, {0, 0}, {0, 3}, {2, 0}},
                                           {{1, 3}, {3, 0}, {0, 0}, {0, 1}},
                                           {{2, 1}, {0, 2}, {1, 0}, {0, 0}}};
    uint32_t t = tet;
    m->ring.n = m->link.n = 0;
    do {
        const iccp_tet *const now = &m->tet[t];
        const uint8_t *const next = after[iccp_tet_index(now, a)][iccp_tet_index(now, b)];
        if (m->ring.n == most || !iccp_list_push(m, &m->ring, t) ||
            !iccp_list_push(m, &m->link, now->v[next[0]]))
            return false;
        if (iccp_is_wall_side(now->across[next[0]]))
            return false;
        t = now->across[next[0]] / 4;
    } while (t != tet);
    return true;
}

/* Looks at the whole star, for cases in which the walk fails. */
static uint32_t search_towards(iccp_tets *m, uint32_t a, uint32_t b)
{
    if (!iccp_tets_star(m, a))
        return ICCP_NO_TET;
    for (size_t k = 0; k < m->star.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->star.item[k]];
        if (iccp_tet_index(tet, b) >= 0)
            return m->star.item[k];
    }
    for (size_t k = 0; k < m->star.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->star.item[k]];
        bool is_there = true;
        for (int i = 0; i < 4 && is_there; ++i)
            is_there = tet->v[i] == a || iccp_tet_sees(m, tet, i, b) >= 0;
        if (is_there)
            return m->star.item[k];
    }
    return ICCP_NO_TET;
}

/* Walks through the star of a, always across a face at a that b lies beyond. Returns ICCP_NO_TET if
 * that leads to a wall or takes too long. */
static uint32_t walk_towards(iccp_tets *m, uint32_t a, uint32_t b)
{
    enum { MOST_STEPS = 200 };
    uint32_t t = m->tet_of[a];
    for (int step = 0; step < MOST_STEPS; ++step) {
        const iccp_tet *const tet = &m->tet[t];
        if (iccp_tet_index(tet, b) >= 0)
            return t;
        const int first = (int)(iccp_random(&m->random) >> 62);
        int k = 0;
        for (; k < 4; ++k) {
            const int i = (first + k) & 3;
            if (tet->v[i] == a || iccp_tet_sees(m, tet, i, b) >= 0)
                continue;
            if (iccp_is_wall_side(tet->across[i]))
                return ICCP_NO_TET;
            t = tet->across[i] / 4;
            break;
        }
        if (k == 4)
            return t;
    }
    return ICCP_NO_TET;
}

/* Looks for the edge from either end, because if one end has very many tetrahedra, the other
 * usually has few. */
uint32_t iccp_tets_towards(iccp_tets *m, uint32_t a, uint32_t b)
{
    uint32_t t = walk_towards(m, a, b);
    if (t == ICCP_NO_TET) {
        t = walk_towards(m, b, a);
        if (t == ICCP_NO_TET || iccp_tet_index(&m->tet[t], a) < 0)
            t = search_towards(m, a, b);
    }
    return t;
}

static void corners_of(const iccp_tets *m, uint32_t side, uint32_t key[3])
{
    for (int i = 0; i < 3; ++i)
        key[i] = m->tet[side / 4].v[iccp_tet_face[side % 4][i]];
}

static bool same_face(const iccp_tets *m, const uint32_t key[3], uint32_t side)
{
    const iccp_tet *const tet = &m->tet[side / 4];
    for (int i = 0; i < 3; ++i) {
        const int at = iccp_tet_index(tet, key[i]);
        if (at < 0 || at == (int)(side % 4))
            return false;
    }
    return true;
}

void iccp_tets_match(iccp_tets *m, size_t n, uint32_t *sides)
{
    while (n > 0) {
        uint32_t key[3];
        const uint32_t side = sides[--n];
        corners_of(m, side, key);
        for (size_t i = n; i-- > 0;)
            if (same_face(m, key, sides[i])) {
                iccp_tets_join(m, side, sides[i]);
                sides[i] = sides[--n];
                break;
            }
    }
}

/* Replaces p by v. Returns false if v is there already. */
static bool rename_corner(uint32_t key[3], uint32_t p, uint32_t v)
{
    bool has_p = false, has_v = false;
    for (int i = 0; i < 3; ++i) {
        has_p |= key[i] == p;
        has_v |= key[i] == v;
    }
    for (int i = 0; i < 3 && has_p; ++i)
        key[i] = key[i] == p ? v : key[i];
    return !(has_p && has_v);
}

/* Stores the outward sides of the old tetrahedra in m->sides, four numbers each: three corners,
 * with v in place of p, and the neighbour. */
static bool list_rim(iccp_tets *m, uint32_t p, uint32_t v, size_t n_old, const uint32_t *old)
{
    const uint32_t stamp = iccp_tets_stamp(m);
    m->sides.n = 0;
    for (size_t k = 0; k < n_old; ++k)
        m->mark[old[k]] = stamp;
    for (size_t k = 0; k < n_old; ++k) {
        const iccp_tet *const tet = &m->tet[old[k]];
        for (uint32_t i = 0; i < 4; ++i) {
            if (!iccp_is_wall_side(tet->across[i]) && m->mark[tet->across[i] / 4] == stamp)
                continue;
            if (!iccp_list_reserve(m, &m->sides, m->sides.n + 4))
                return false;
            uint32_t *const key = m->sides.item + m->sides.n;
            corners_of(m, 4 * old[k] + i, key);
            key[3] = tet->across[i];
            if (!rename_corner(key, p, v))
                continue;
            m->sides.n += 4;
        }
    }
    return true;
}

/* Connects sides of new tetrahedra on the rim with the old neighbours there, and joins the
 * others. */
static void close_rim(iccp_tets *m)
{
    m->work.n = 0;
    for (size_t k = 0; k < m->fresh.n; ++k)
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t side = 4 * m->fresh.item[k] + i;
            size_t r = 0;
            while (r < m->sides.n && !same_face(m, m->sides.item + r, side))
                r += 4;
            if (r == m->sides.n) {
                m->work.item[m->work.n++] = side;
                continue;
            }
            const uint32_t across = m->sides.item[r + 3];
            if (iccp_is_wall_side(across))
                m->tet[side / 4].across[side % 4] = across;
            else
                iccp_tets_join(m, side, across);
            m->sides.n -= 4;
            memcpy(m->sides.item + r, m->sides.item + m->sides.n, 4 * sizeof *m->sides.item);
        }
    iccp_tets_match(m, m->work.n, m->work.item);
}

bool iccp_tets_contract(iccp_tets *m, uint32_t p, uint32_t v, size_t n_old, const uint32_t *old,
                        size_t n_fresh, const uint32_t *fresh)
{
    for (size_t k = 0; k < n_fresh; ++k)
        if (iccp_tets_orient(m, fresh[4 * k], fresh[4 * k + 1], fresh[4 * k + 2],
                             fresh[4 * k + 3]) <= 0)
            return false;
    if (!iccp_tets_reserve(m, n_fresh) || !iccp_list_reserve(m, &m->fresh, n_fresh) ||
        !iccp_list_reserve(m, &m->work, 4 * n_fresh) || !list_rim(m, p, v, n_old, old))
        return false;
    for (size_t k = 0; k < n_old; ++k)
        iccp_tets_kill(m, old[k]);
    m->fresh.n = 0;
    for (size_t k = 0; k < n_fresh; ++k)
        m->fresh.item[m->fresh.n++] =
            iccp_tets_new(m, fresh[4 * k], fresh[4 * k + 1], fresh[4 * k + 2], fresh[4 * k + 3]);
    close_rim(m);
    return true;
}

bool iccp_tets_replace(iccp_tets *m, size_t n_old, const uint32_t *old, size_t n_fresh,
                       const uint32_t *fresh)
{
    return iccp_tets_contract(m, ICCP_NO_TET, ICCP_NO_TET, n_old, old, n_fresh, fresh);
}
