/* The mesh under construction: points, and tetrahedra that fill the space between them. All stages
 * of filling work on it.
 *
 * Side 4 t + i is the face of tetrahedron t opposite its corner i. All tetrahedra are positive,
 * exactly: seen from corner 3, corners 0, 1, 2 are counter-clockwise. */
#ifndef ICCP_TETS_H
#define ICCP_TETS_H

#include "base/env.h"
#include "fill/metric.h"
#include "fill/pairs.h"
#include "fill/points.h"
#include "geometry/simplices.h"

#include <stdbool.h>

#define ICCP_NO_TET UINT32_MAX
/* Marks a side that lies on the surface. The other bits are the facet. ICCP_NO_TET includes this
 * bit. */
#define ICCP_WALL 0x80000000u

typedef struct iccp_tet {
    uint32_t v[4]; /* v[0] is ICCP_NO_TET in a deleted tetrahedron */
    /* For each face: its side of the adjacent tetrahedron, a wall, or ICCP_NO_TET */
    uint32_t across[4];
} iccp_tet;

/* The corners of each face, in the order for which the opposite corner is on the positive side. */
extern const uint8_t iccp_tet_face[4][3];

typedef struct iccp_list {
    uint32_t *item;
    size_t n, room;
} iccp_list;

typedef struct iccp_tets {
    iccp_memory memory;
    iccp_points points;
    /* By point: a tetrahedron that has it, or ICCP_NO_TET; as long as the points */
    uint32_t *tet_of;
    uint32_t *seen;    /* by point: a stamp */
    uint32_t *touched; /* by point: the round in which its star last changed */
    iccp_tet *tet;
    uint32_t *mark; /* by tetrahedron: a stamp */
    size_t n_tets, room, n_alive;
    uint32_t free; /* list of deleted tetrahedra, linked by across[0] */
    uint32_t stamp;
    uint32_t round; /* counts the rounds of improvement */
    uint64_t random;
    uint32_t attempt; /* number of the present order of insertion, from 0 */
    iccp_metric metric;
    bool by_angle;   /* quality is the square of the least sine of the dihedral angles */
    uint32_t hint;   /* where a search begins */
    iccp_pairs kept; /* edges that must stay: the pieces of lines */
    bool no_memory;  /* an allocation has failed at some time, whatever came of it */
    iccp_list star, ring, link, cavity, sides, fresh, work;
} iccp_tets;

void iccp_tets_init(iccp_tets *m, const iccp_memory *memory);
void iccp_tets_free(iccp_tets *m);

bool iccp_list_push(iccp_tets *m, iccp_list *list, uint32_t item);
bool iccp_list_reserve(iccp_tets *m, iccp_list *list, size_t room);

enum { ICCP_ORDERS = 3 };

/* Returns the item at place k of n < 2^31 in the present order: forwards, backwards, or scattered
 * by a prime. */
static inline size_t iccp_tets_turn(const iccp_tets *m, size_t k, size_t n)
{
    const uint64_t prime = 2654435761u;
    const uint32_t order = m->attempt % ICCP_ORDERS;
    return order == 0 ? k : order == 1 ? n - 1 - k : (size_t)(k * prime % n);
}

/* Adds a point at x without tetrahedra. Returns ICCP_NO_TET if there is no memory. */
uint32_t iccp_tets_add_point(iccp_tets *m, const double *x);
/* Removes the point that was added last. */
void iccp_tets_drop_point(iccp_tets *m);

/* Makes room for more tetrahedra, so that iccp_tets_new() cannot fail. */
bool iccp_tets_reserve(iccp_tets *m, size_t n_more);
uint32_t iccp_tets_new(iccp_tets *m, uint32_t a, uint32_t b, uint32_t c, uint32_t d);
void iccp_tets_kill(iccp_tets *m, uint32_t t);

/* Copies the points and tetrahedra of a mesh with neighbours, by its numbers, into an empty m.
 * Returns false if there is no memory. */
bool iccp_tets_copy(iccp_tets *m, const iccp_simplices *mesh);
/* Returns a stamp that no tetrahedron and no point has. */
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

/* Returns true if the star of a point has changed in this round or the previous one. If not, a step
 * that failed there would fail again. */
static inline bool iccp_point_touched(const iccp_tets *m, uint32_t point)
{
    return m->touched[point] + 1 >= m->round;
}

/* Returns true if the star of one of its corners has changed. */
static inline bool iccp_tet_touched(const iccp_tets *m, uint32_t t)
{
    const uint32_t *const v = m->tet[t].v;
    return iccp_point_touched(m, v[0]) || iccp_point_touched(m, v[1]) ||
           iccp_point_touched(m, v[2]) || iccp_point_touched(m, v[3]);
}

static inline bool iccp_is_kept_edge(const iccp_tets *m, uint32_t a, uint32_t b)
{
    return m->kept.n > 0 && iccp_pairs_have(&m->kept, a, b);
}

/* Returns the sign of a point with respect to the face opposite corner i; positive means inside. */
static inline int iccp_tet_sees(const iccp_tets *m, const iccp_tet *tet, int i, uint32_t point)
{
    const uint8_t *const f = iccp_tet_face[i];
    return iccp_tets_orient(m, tet->v[f[0]], tet->v[f[1]], tet->v[f[2]], point);
}

/* Makes two sides neighbours. */
static inline void iccp_tets_join(iccp_tets *m, uint32_t a, uint32_t b)
{
    m->tet[a / 4].across[a % 4] = b;
    m->tet[b / 4].across[b % 4] = a;
}

/* Collects the tetrahedra at a point in m->star. Returns false if there is no memory. */
bool iccp_tets_star(iccp_tets *m, uint32_t point);

/* Collects the tetrahedra around edge ab in m->ring, where `tet` is one of them. Collects the
 * points opposite in m->link, such that (a, b, link[i], link[i + 1]) is positive. Returns false if
 * they form no closed ring, if there are more than `most`, or if there is no memory. */
bool iccp_tets_ring(iccp_tets *m, uint32_t a, uint32_t b, uint32_t tet, size_t most);

/* Returns a tetrahedron at point a that the segment to b enters or touches. It contains b if ab is
 * an edge. Returns ICCP_NO_TET if there is none, or no memory for the search. */
uint32_t iccp_tets_towards(iccp_tets *m, uint32_t a, uint32_t b);

/* Replaces tetrahedra by others that fill the same space, given by four points each. m->fresh then
 * has their numbers. Returns false and changes nothing if one of them is not positive or there is
 * no memory. Of the lists of m, `old` may be only star or ring. */
bool iccp_tets_replace(iccp_tets *m, size_t n_old, const uint32_t *old, size_t n_fresh,
                       const uint32_t *fresh);

/* Like iccp_tets_replace(), if the old tetrahedra are the star of point p and p becomes point v of
 * its link. p may be on the surface if v is on the same facets. */
bool iccp_tets_contract(iccp_tets *m, uint32_t p, uint32_t v, size_t n_old, const uint32_t *old,
                        size_t n_fresh, const uint32_t *fresh);

/* Joins sides with the same three corners in pairs. None may be left over. O(n^2). */
void iccp_tets_match(iccp_tets *m, size_t n, uint32_t *sides);

#endif
