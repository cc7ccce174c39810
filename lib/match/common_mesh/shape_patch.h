/* Changes of a few common triangles of two surfaces, and the triangles that may replace them. */
#ifndef ICCP_SHAPE_PATCH_H
#define ICCP_SHAPE_PATCH_H

#include "match/common_mesh/clearance.h"
#include "match/common_mesh/covering.h"
#include "match/common_mesh/kept_cells.h"

/* The most triangles in one change. */
enum { ICCP_PATCH_TRIANGLES = ICCP_MERGED_NEIGHBOURS + 2 };

/* Restrictions on changes. Each level adds one to those before it. */
typedef enum iccp_patch_caution {
    ICCP_PATCH_BOLD,
    ICCP_PATCH_SHORT, /* makes no side longer than edge2 allows or than the sides before */
    ICCP_PATCH_CALM   /* does not raise the stretch from one surface to the other */
} iccp_patch_caution;

/* Each vertex has the place of a vertex of the overlay, separately on each side. */
typedef struct iccp_patch_state {
    iccp_half_edges m;
    const iccp_common_surface *whole; /* the overlay that everything was made from */
    const uint8_t *keep;              /* by vertex, a bit for each side: its place there is kept */
    const iccp_kept_cells *cells;     /* of the first surface; or NULL */
    double edge2[2];            /* by side: longest squared side, unless a side was longer before */
    double scale;               /* area of the second surface divided by that of the first */
    iccp_patch_caution caution; /* the restrictions in force */
    uint32_t *at[2];            /* by vertex: the vertex of `whole` whose place it has */
    double *x[2];               /* by vertex: that place */
    iccp_covering covering[2];
    iccp_clearance clearance[2];
} iccp_patch_state;

typedef struct iccp_patch_triangles {
    uint32_t n, number[ICCP_PATCH_TRIANGLES], corner[ICCP_PATCH_TRIANGLES][3];
} iccp_patch_triangles;

typedef struct iccp_patch {
    iccp_patch_triangles before, after;
    uint32_t vertex, place[2]; /* the vertex that moves and its places afterwards; ICCP_NO_EDGE:
                                  none moves */
} iccp_patch;

typedef struct iccp_patch_shape {
    double least;       /* the sine of the least angle on both sides */
    double sum;         /* the sum of 1 / sine^2 of the least angles of all triangles on both
                           sides */
    double longest2[2]; /* by side: the longest edge, squared */
} iccp_patch_shape;

static inline const double *iccp_patch_point(const iccp_patch_state *s, int side, uint32_t place)
{
    return s->whole->x[side] + 3 * (size_t)place;
}

/* These return true if kept places and cells allow a change. may_unite: vertex u is merged into v
 * and takes the place of v. On the side `side_of_u`, 0 or 1, both take the place of u; -1 means on
 * neither side. may_move: v goes to a place on the sides whose bits are set, where it is not kept.
 * may_flip: an edge is flipped whose two triangles have these corners. */
bool iccp_patch_may_unite(const iccp_patch_state *s, int side_of_u, uint32_t u, uint32_t v);
bool iccp_patch_may_move(const iccp_patch_state *s, uint32_t v, uint32_t sides, uint32_t place);
bool iccp_patch_may_flip(const iccp_patch_state *s, const uint32_t corners[4]);

/* Adds the triangles around a vertex, except those at `but`. Afterwards `as` replaces the vertex,
 * and triangles that had `as` before are gone. Each triangle's side from corner 0 to corner 1
 * starts at the vertex. */
void iccp_patch_add_ring(const iccp_patch_state *s, iccp_patch *p, uint32_t v, uint32_t but,
                         uint32_t as);

iccp_patch_shape iccp_patch_before(const iccp_patch_state *s, const iccp_patch *p);

/* Returns false if an angle's sine is below `least`, the sum above `most`, or a side too long. If
 * triangles were thin, a side may become a little longer, unless s->caution forbids it. */
bool iccp_patch_after(const iccp_patch_state *s, const iccp_patch *p,
                      const iccp_patch_shape *before, double least, double most,
                      iccp_patch_shape *after);

/* Adds to `sum` the areas of a triangle on both sides and its energy times these areas. `scale` is
 * as above. */
void iccp_patch_add_energy(double sum[2], const iccp_corners *c, const iccp_corners *d,
                           double scale);

/* Returns true if both surfaces stay close enough, neither meets itself, and the stretch between
 * them does not rise. It may rise a little if the least sine was small, unless s->caution forbids
 * it. */
bool iccp_patch_allowed(iccp_patch_state *s, const iccp_patch *p, double least_before);

/* Moves the vertex and updates coverings and clearances. The caller changes s->m. */
void iccp_patch_apply(iccp_patch_state *s, const iccp_patch *p);

#endif
