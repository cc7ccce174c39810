/* What the stages of filling work on: points, and tetrahedra that fill the space between them.
 *
 * Side 4 t + i is tetrahedron t as seen across its face opposite corner i. All tetrahedra are
 * positive, exactly: corner 3 lies where corners 0, 1, 2 look counter-clockwise. */
#ifndef ICCP_TETS_H
#define ICCP_TETS_H

#include "base/env.h"
#include "fill/metric.h"
#include "fill/points.h"
#include "geometry/simplices.h"

#include <stdbool.h>

#define ICCP_NO_TET UINT32_MAX
/* The mark of a side that lies on the surface; the other bits are the facet. NO_TET has it, too. */
#define ICCP_WALL 0x80000000u

typedef struct iccp_tet {
    uint32_t v[4];      /* v[0] is ICCP_NO_TET in those that are gone */
    uint32_t across[4]; /* the same face as a side of its other tetrahedron, a wall, or NO_TET */
} iccp_tet;

/* The corners of each face in the order in which the opposite corner is on their positive side. */
extern const uint8_t iccp_tet_face[4][3];

typedef struct iccp_list {
    uint32_t *item;
    size_t n, room;
} iccp_list;

typedef struct iccp_tets {
    iccp_memory memory;
    iccp_points points;
    uint32_t *tet_of;  /* of each point: a tetrahedron that has it, or NO_TET; room as of points */
    uint32_t *seen;    /* of each point: a stamp */
    uint32_t *touched; /* of each point: the round in which its star changed last */
    iccp_tet *tet;
    uint32_t *mark; /* of each tetrahedron: a stamp */
    size_t n_tets, room, n_alive;
    uint32_t free; /* a list of those that are gone, linked by across[0] */
    uint32_t stamp;
    uint32_t round; /* counts the rounds of improvement */
    uint64_t random;
    uint32_t attempt; /* which of several orders things are done in, from 0 */
    iccp_metric metric;
    uint32_t hint;  /* where to begin to look */
    bool no_memory; /* there was none at some time, whatever came of it */
    iccp_list star, ring, link, cavity, sides, fresh, work;
} iccp_tets;

void iccp_tets_init(iccp_tets *m, const iccp_memory *memory);
void iccp_tets_free(iccp_tets *m);

bool iccp_list_push(iccp_tets *m, iccp_list *list, uint32_t item);
bool iccp_list_reserve(iccp_tets *m, iccp_list *list, size_t room);

enum { ICCP_ORDERS = 3 };

/* What comes k-th of n < 2^31: in order, backwards, or scattered by a prime. */
static inline size_t iccp_tets_turn(const iccp_tets *m, size_t k, size_t n)
{
    const uint64_t prime = 2654435761u;
    const uint32_t order = m->attempt % ICCP_ORDERS;
    return order == 0 ? k : order == 1 ? n - 1 - k : (size_t)(k * prime % n);
}

/* A new point that no tetrahedron has, at x; ICCP_NO_TET if there is no memory. */
uint32_t iccp_tets_add_point(iccp_tets *m, const double *x);
/* Takes back the point that was added last. */
void iccp_tets_drop_point(iccp_tets *m);

/* Room for more tetrahedra, so that iccp_tets_new() cannot fail. */
bool iccp_tets_reserve(iccp_tets *m, size_t n_more);
uint32_t iccp_tets_new(iccp_tets *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d);
void iccp_tets_kill(iccp_tets *m, uint32_t t);

/* Into what is empty: points and tetrahedra of a mesh that knows its neighbours, by its numbers.
 * False without memory. */
bool iccp_tets_copy(iccp_tets *m, const iccp_simplices *mesh);
/* A stamp that no mark and no point has. */
uint32_t iccp_tets_stamp(iccp_tets *m);

static inline bool iccp_tet_alive(const iccp_tets *m, uint32_t t)
{
    return m->tet[t].v[0] != ICCP_NO_TET;
}

static inline bool iccp_is_wall_side(uint32_t across)
{
    return (across & ICCP_WALL) != 0;
}

static inline int iccp_tet_index(const iccp_tet *tet, uint32_t point)
{
    return tet->v[0] == point   ? 0
           : tet->v[1] == point ? 1
           : tet->v[2] == point ? 2
           : tet->v[3] == point ? 3
                                : -1;
}

static inline int iccp_tets_orient(const iccp_tets *m, uint32_t a, uint32_t b, uint32_t c,
                                   uint32_t d)
{
    return iccp_points_orient(&m->points, a, b, c, d);
}

/* Whether the star of a point has changed in this round or the one before: if not, what was tried
 * in vain would be so again. */
static inline bool iccp_point_touched(const iccp_tets *m, uint32_t point)
{
    return m->touched[point] + 1 >= m->round;
}

/* Whether that of one of the corners has. */
static inline bool iccp_tet_touched(const iccp_tets *m, uint32_t t)
{
    const uint32_t *const v = m->tet[t].v;
    return iccp_point_touched(m, v[0]) || iccp_point_touched(m, v[1]) ||
           iccp_point_touched(m, v[2]) || iccp_point_touched(m, v[3]);
}

/* The sign with which a point sees the face opposite corner i from inside. */
static inline int iccp_tet_sees(const iccp_tets *m, const iccp_tet *tet, int i, uint32_t point)
{
    const uint8_t *const f = iccp_tet_face[i];
    return iccp_tets_orient(m, tet->v[f[0]], tet->v[f[1]], tet->v[f[2]], point);
}

/* Joins two sides. */
static inline void iccp_tets_join(iccp_tets *m, uint32_t a, uint32_t b)
{
    m->tet[a / 4].across[a % 4] = b;
    m->tet[b / 4].across[b % 4] = a;
}

/* m->star: the tetrahedra at a point. False if there is no memory. */
bool iccp_tets_star(iccp_tets *m, uint32_t point);

/* m->ring: the tetrahedra round edge ab, of which `tet` is one, and m->link: the points opposite,
 * such that (a, b, link[i], link[i + 1]) is positive. False if they do not close, if they are more
 * than `most`, or if there is no memory for them. */
bool iccp_tets_ring(iccp_tets *m, uint32_t a, uint32_t b, uint32_t tet, size_t most);

/* A tetrahedron at point a into which, or along which, the way to b begins; ICCP_NO_TET if there is
 * no memory to look for it or none. It has b if ab is an edge. */
uint32_t iccp_tets_towards(iccp_tets *m, uint32_t a, uint32_t b);

/* Replaces tetrahedra by others, four points each, that fill the same space: false, and nothing
 * changed, if one of them is not positive or there is no memory. `old` is not a list of m but star
 * or ring. m->fresh has their numbers then. */
bool iccp_tets_replace(iccp_tets *m, size_t n_old, const uint32_t *old, size_t n_fresh,
                       const uint32_t *fresh);

/* The same where point p of the old ones, whose star they are, becomes point v of its link; p may
 * be on the surface, if v is on the same facets. */
bool iccp_tets_contract(iccp_tets *m, uint32_t p, uint32_t v, size_t n_old, const uint32_t *old,
                        size_t n_fresh, const uint32_t *fresh);

/* Joins sides that have the same three corners, in pairs; none must be left over. O(n^2). */
void iccp_tets_match(iccp_tets *m, size_t n, uint32_t *sides);

#endif
