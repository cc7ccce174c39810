/* A mesh that fills a ball, on its way onto a region that can be seen from one point inside.
 *
 * Tetrahedra of the mesh are in place or left. What separates them, the front, is a sphere, which
 * the apex sees from inside; before any is in place it is the boundary. The images of what is in
 * place, and cones from the apex over the faces of the front, fill the region: all these cells are
 * positive, exactly, whenever nothing is being tried. */
#ifndef ICCP_CONE_H
#define ICCP_CONE_H

#include "fill/tets.h"
#include "geometry/simplices.h"
#include "map/solid/halfspaces.h"

#include <math.h>

typedef struct iccp_cone {
    iccp_tets mesh;     /* before the map; its no_memory says that there was none for anything */
    double *image;      /* 3 of each point of a tetrahedron in place or of the front; others NaN */
    uint32_t *n_faces;  /* of each point: the faces of the front at it */
    uint8_t *is_placed; /* of each tetrahedron */
    size_t point_room, tet_room;
    size_t n_fixed; /* the first points, whose images stay */
    size_t n_left;
    double apex[3];
    iccp_halfspaces room; /* of the point that is being moved */
} iccp_cone;

/* Nothing is in place yet, and the apex is the origin; the images of the boundary are given.
 * ICC_ERR_MEMORY; to be freed all the same. */
icc_status iccp_cone_create(iccp_cone *cone, const iccp_simplices *mesh, const double *boundary,
                            const iccp_memory *memory);
void iccp_cone_free(iccp_cone *cone);

/* Puts all into their places at once, where the images of all points are known. */
void iccp_cone_fill(iccp_cone *cone, const double *images);

/* The mesh without what is gone, which does not know its neighbours, and its images; to be freed on
 * failure, too. */
icc_status iccp_cone_give(const iccp_cone *cone, iccp_simplices **out, double **images);

/* Room for what the mesh has room for. */
bool iccp_cone_reserve(iccp_cone *cone);

/* Cuts what n points span, an edge or a face, by a new point in its middle, in the n_old
 * tetrahedra that have it. The pieces are in mesh.fresh; whether they are in place, and the image
 * of the point, is up to the caller. False: nothing has changed. */
bool iccp_cone_cut(iccp_cone *cone, int n, const uint32_t *ends, size_t n_old, const uint32_t *old,
                   uint32_t *point);

/* Whether side i of a tetrahedron that is left belongs to the front, or that of one in place to the
 * boundary or to another in place. */
static inline bool iccp_cone_is_front(const iccp_cone *cone, uint32_t tet, int i)
{
    const uint32_t across = cone->mesh.tet[tet].across[i];
    return iccp_is_wall_side(across) || cone->is_placed[across / 4];
}

static inline bool iccp_cone_is_left(const iccp_cone *cone, uint32_t tet)
{
    return iccp_tet_alive(&cone->mesh, tet) && !cone->is_placed[tet];
}

static inline double *iccp_cone_image(const iccp_cone *cone, uint32_t point)
{
    return cone->image + 3 * (size_t)point;
}

/* The sides of a tetrahedron that is left which belong to the front. */
int iccp_cone_front_sides(const iccp_cone *cone, uint32_t tet, int side[4]);

/* Puts a tetrahedron into its place, or takes the one that was put there last out again: a matter
 * of the front alone. */
void iccp_cone_place(iccp_cone *cone, uint32_t tet);
void iccp_cone_take_out(iccp_cone *cone, uint32_t tet);

/* Whether the cells are positive that putting a tetrahedron into its place has made; and those at a
 * point. */
bool iccp_cone_is_good(const iccp_cone *cone, uint32_t tet);
bool iccp_cone_is_star_good(iccp_cone *cone, uint32_t point);

/* Where a point may be, as cone->room: false where that cannot be told. */
bool iccp_cone_find_room(iccp_cone *cone, uint32_t point);

/* The faces of the front, as half-spaces that have the apex in them, likewise. */
bool iccp_cone_find_apex_room(iccp_cone *cone);
bool iccp_cone_is_apex_good(const iccp_cone *cone);

/* Gives a point an image, or takes it away. */
void iccp_cone_put(iccp_cone *cone, uint32_t point, const double image[3]);
void iccp_cone_forget(iccp_cone *cone, uint32_t point);

static inline bool iccp_cone_has_image(const iccp_cone *cone, uint32_t point)
{
    return !isnan(*iccp_cone_image(cone, point));
}

/* ---- moving images ---- */

/* Puts the apex to where it sees all of the front, with some room: from a cone over the boundary,
 * before anything is in place. False where no such point was found. */
bool iccp_cone_find_apex(iccp_cone *cone);

/* Moves the image of a point to where its cells are large, if they stay positive; that of points on
 * the boundary or beyond the front stays. */
void iccp_cone_smooth(iccp_cone *cone, uint32_t point, size_t steps);

/* The same for all points, and for the apex. O(n). */
void iccp_cone_smooth_all(iccp_cone *cone);

/* Moves the images of the corners of a tetrahedron that was put into its place until all cells are
 * positive. Whether that could be done; nothing has moved if not. */
bool iccp_cone_unlock(iccp_cone *cone, uint32_t tet);

/* ---- putting tetrahedra into their places ---- */

typedef enum iccp_cone_result {
    ICCP_CONE_PLACED,
    ICCP_CONE_BLOCKED, /* there are images that are in the way */
    ICCP_CONE_BARRED   /* what is left would not be a ball */
} iccp_cone_result;

/* Whether what is left without a tetrahedron with n sides on the front is a ball: what they do not
 * have, a point, an edge or a face, is not on the front. */
bool iccp_cone_leaves_ball(iccp_cone *cone, uint32_t tet, int n, const int *side);

/* Tries a tetrahedron that has a side on the front. */
iccp_cone_result iccp_cone_try(iccp_cone *cone, uint32_t tet);

/* Puts one that is blocked into its place in pieces: what it would put behind the front is cut by a
 * new point, which comes to lie just behind what is there now. False when doubles are too coarse
 * for that, or the front has changed; the mesh may be finer then. `point`: the new one. */
bool iccp_cone_split(iccp_cone *cone, uint32_t tet, uint32_t *point);

#endif
