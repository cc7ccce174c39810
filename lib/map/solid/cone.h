/* A star mesh: a mesh that fills a ball, while it is mapped onto a star-shaped region.
 *
 * A tetrahedron is in place if its corners have their images, and left if not. The front separates
 * the two. It is a sphere that the apex sees from inside; before any tetrahedron is in place, it is
 * the boundary. The images of tetrahedra in place and the cones from the apex over faces of the
 * front fill the region. All these cells are positive, exactly, except during a trial. */
#ifndef ICCP_CONE_H
#define ICCP_CONE_H

#include "fill/tets.h"
#include "geometry/simplices.h"
#include "map/solid/halfspaces.h"

#include <math.h>

typedef struct iccp_cone {
    iccp_tets mesh;     /* before the map; its no_memory tells that any allocation failed */
    double *image;      /* 3 of each point of a tetrahedron in place or of the front; NaN for
                           others */
    uint32_t *n_faces;  /* of each point: the number of faces of the front at it */
    uint8_t *is_placed; /* of each tetrahedron */
    size_t point_room, tet_room;
    size_t n_fixed; /* the first n_fixed points keep their images */
    size_t n_left;
    double apex[3];
    iccp_halfspaces room; /* half-spaces of the point that is being moved */
} iccp_cone;

/* Starts with no tetrahedron in place and the apex at the origin. The images of the boundary are
 * given. ICC_ERR_MEMORY. Free it even then. */
icc_status iccp_cone_create(iccp_cone *cone, const iccp_simplices *mesh, const double *boundary,
                            const iccp_memory *memory);
void iccp_cone_free(iccp_cone *cone);

/* Puts all tetrahedra into place at once. The images of all points are known. */
void iccp_cone_fill(iccp_cone *cone, const double *images);

/* Returns the mesh without removed tetrahedra, which does not know its neighbours, and its images.
 * Free both even on failure. */
icc_status iccp_cone_give(const iccp_cone *cone, iccp_simplices **out, double **images);

/* Makes room for as much as the mesh has room for. */
bool iccp_cone_reserve(iccp_cone *cone);

/* Puts a new point in the middle of an edge or a face, which n points span, and cuts the n_old
 * tetrahedra that have it. The pieces are in mesh.fresh. The caller decides if they are in place,
 * and gives the point an image. If it returns false, nothing has changed. */
bool iccp_cone_cut(iccp_cone *cone, int n, const uint32_t *ends, size_t n_old, const uint32_t *old,
                   uint32_t *point);

/* Returns true if side i of a tetrahedron that is left belongs to the front. For a tetrahedron in
 * place it returns true if the side belongs to the boundary or to another tetrahedron in place. */
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

/* Lists the sides of a tetrahedron that is left which belong to the front. */
int iccp_cone_front_sides(const iccp_cone *cone, uint32_t tet, int side[4]);

/* Puts a tetrahedron into place, or takes out the one placed last. Only the front is updated. */
void iccp_cone_place(iccp_cone *cone, uint32_t tet);
void iccp_cone_take_out(iccp_cone *cone, uint32_t tet);

/* The first returns true if the cells made by placing a tetrahedron are positive. The second tests
 * the cells at a point. */
bool iccp_cone_is_good(const iccp_cone *cone, uint32_t tet);
bool iccp_cone_is_star_good(iccp_cone *cone, uint32_t point);

/* Finds where a point may be, as half-spaces in cone->room. Returns false if that cannot be
 * decided. */
bool iccp_cone_find_room(iccp_cone *cone, uint32_t point);

/* Finds where the apex may be: on the inner side of all faces of the front. */
bool iccp_cone_find_apex_room(iccp_cone *cone);
bool iccp_cone_is_apex_good(const iccp_cone *cone);

/* Give a point an image, and take it away. */
void iccp_cone_put(iccp_cone *cone, uint32_t point, const double image[3]);
void iccp_cone_forget(iccp_cone *cone, uint32_t point);

static inline bool iccp_cone_has_image(const iccp_cone *cone, uint32_t point)
{
    return !isnan(*iccp_cone_image(cone, point));
}

/* ---- moving images ---- */

/* Finds a place from which the apex sees all of the front, with some room. Needs a cone over the
 * boundary, with nothing in place. Returns false if no such place was found. */
bool iccp_cone_find_apex(iccp_cone *cone);

/* Moves the image of a point to where its cells are large, if they stay positive. Points on the
 * boundary and beyond the front do not move. */
void iccp_cone_smooth(iccp_cone *cone, uint32_t point, size_t steps);

/* Moves the images of all points, and the apex. O(n). */
void iccp_cone_smooth_all(iccp_cone *cone);

/* Moves the images of the corners of a tetrahedron that was put into place until all cells are
 * positive. Returns false if this fails; then nothing has moved. */
bool iccp_cone_unlock(iccp_cone *cone, uint32_t tet);

/* ---- putting tetrahedra into place ---- */

typedef enum iccp_cone_result {
    ICCP_CONE_PLACED,
    ICCP_CONE_BLOCKED, /* images are in the way */
    ICCP_CONE_BARRED   /* the rest would not be a ball */
} iccp_cone_result;

/* Returns true if the rest is a ball without a tetrahedron that has n sides on the front. The part
 * that these sides do not contain, a point, an edge or a face, must not be on the front. */
bool iccp_cone_leaves_ball(iccp_cone *cone, uint32_t tet, int n, const int *side);

/* Tries to place a tetrahedron that has a side on the front. */
iccp_cone_result iccp_cone_try(iccp_cone *cone, uint32_t tet);

/* Puts a blocked tetrahedron into place in pieces. A new point cuts the part that it would put
 * behind the front. This point comes to lie just behind the present front. Returns false if doubles
 * are too coarse or the front has changed; the mesh may be finer then. `point` is the new point. */
bool iccp_cone_split(iccp_cone *cone, uint32_t tet, uint32_t *point);

#endif
