/* Triangles of two surfaces with common ones, and what may take their place. */
#ifndef ICCP_SHAPE_PATCH_H
#define ICCP_SHAPE_PATCH_H

#include "match/common_mesh/clearance.h"
#include "match/common_mesh/covering.h"
#include "match/common_mesh/kept_cells.h"

/* Most neighbours of a vertex that changes; most triangles that one change concerns. */
enum { ICCP_PATCH_NEIGHBOURS = 18, ICCP_PATCH_TRIANGLES = ICCP_PATCH_NEIGHBOURS + 2 };

/* What changes may not do, each what those before it may not either. */
typedef enum iccp_patch_caution {
    ICCP_PATCH_BOLD,
    ICCP_PATCH_SHORT, /* make sides longer than they may be, and than those before */
    ICCP_PATCH_CALM   /* stretch one surface more to become the other */
} iccp_patch_caution;

/* Vertices are in places of those of the overlay that all of this has come from, on either side by
 * themselves. */
typedef struct iccp_patch_state {
    iccp_half_edges m;
    const iccp_common_surface *whole; /* the overlay */
    const uint8_t *keep;              /* by vertex, a bit for each side: its place there stays */
    const iccp_kept_cells *cells;     /* of the first surface; or NULL */
    double edge2[2]; /* on either side: sides are no longer, squared, unless some were before */
    double scale;    /* times which the second has the area of the first */
    iccp_patch_caution caution; /* against what changes may do else */
    uint32_t *at[2];            /* by vertex: the one of the whole in whose place it is */
    double *x[2];               /* by vertex: that place */
    iccp_covering covering[2];
    iccp_clearance clearance[2];
} iccp_patch_state;

typedef struct iccp_patch_triangles {
    uint32_t n, number[ICCP_PATCH_TRIANGLES], corner[ICCP_PATCH_TRIANGLES][3];
} iccp_patch_triangles;

typedef struct iccp_patch {
    iccp_patch_triangles before, after;
    uint32_t vertex, place[2]; /* it is in this place afterwards; ICCP_NO_EDGE: none moves */
} iccp_patch;

typedef struct iccp_patch_shape {
    double least;       /* the sine of the least angle on both sides */
    double sum;         /* over triangles and sides, of 1 / sine^2 of the least angle */
    double longest2[2]; /* on either side: the longest edge, squared */
} iccp_patch_shape;

static inline const double *iccp_patch_point(const iccp_patch_state *s, int side, uint32_t place)
{
    return s->whole->x[side] + 3 * (size_t)place;
}

/* Whether what stays allows that a vertex u becomes one with v, in the place of v but on one side,
 * 0 or 1, where it is in that of u, or on neither, -1; that v goes to a place on the sides whose
 * bits are set, none of which `keep` has; or that an edge is flipped, of whose two triangles these
 * are the corners. */
bool iccp_patch_may_unite(const iccp_patch_state *s, int side_of_u, uint32_t u, uint32_t v);
bool iccp_patch_may_move(const iccp_patch_state *s, uint32_t v, uint32_t sides, uint32_t place);
bool iccp_patch_may_flip(const iccp_patch_state *s, const uint32_t corners[4]);

/* Adds the triangles round a vertex, but for those at `but`. Afterwards they have `as` in its
 * place, and those with that before are gone. Of each the side from corner 0 to 1 comes from it. */
void iccp_patch_add_ring(const iccp_patch_state *s, iccp_patch *p, uint32_t v, uint32_t but,
                         uint32_t as);

iccp_patch_shape iccp_patch_before(const iccp_patch_state *s, const iccp_patch *p);

/* False if an angle's sine is below `least`, the sum above `most`, or a side too long; where
 * triangles were thin one may become a little longer, unless s->caution is against it. */
bool iccp_patch_after(const iccp_patch_state *s, const iccp_patch *p,
                      const iccp_patch_shape *before, double least, double most,
                      iccp_patch_shape *after);

/* Adds the energy of a triangle, times its areas on both sides, and these; scale: as above. */
void iccp_patch_add_energy(double sum[2], const iccp_corners *c, const iccp_corners *d,
                           double scale);

/* Whether both surfaces are near enough afterwards, neither meets itself, and one is not stretched
 * more to become the other; a little more where the least sine has been small, unless s->caution
 * is against it. */
bool iccp_patch_allowed(iccp_patch_state *s, const iccp_patch *p, double least_before);

/* Moves the vertex and what is beside the triangles; s->m is the caller's to change. */
void iccp_patch_apply(iccp_patch_state *s, const iccp_patch *p);

#endif
