/* Finds out that two solids have no map.
 *
 * A map takes the surfaces of the source to those of the target as their numbers say, so it takes a
 * loop that bounds inside the source to one that bounds inside the target. Here the loops are
 * compared, for each region by itself.
 *
 * - A refusal is a proof: it names a loop that bounds a surface in one of the two solids, but not
 *   in the other one. It refuses a torus turned inside out, handles whose loops around and through
 *   are exchanged, or with Dehn twists on the wrong side, and ring-shaped voids that are linked
 *   differently: linking numbers are sums of classes along loops.
 * - No refusal is a proof only in some cases. If a surface has no handles, nothing is refused, and
 *   there is a map. The same holds if the solid is a solid torus, of one handle and without voids.
 *   Otherwise the loops are necessary only. More than one handle is decided by which loops can be
 *   contracted inside, so by the fundamental group. A void or a tunnel that is knotted has the
 *   same loops as one that is not, but its surroundings have no map.
 * - All numbers are exact modulo the prime 2^61 - 1. What differs modulo a prime differs, so each
 *   refusal is right. The other way round, a difference that is a multiple of the prime would be
 *   missed. For one handle, no difference can be so large if the shortest loops have up to 2^15
 *   edges: two polygons of that many edges cross less than 2^30 times in a projection. So numbers
 *   of turns are less than 2^29, and differences are products of two sums of two of them.
 * - Lines and points take no part: a line that does not close can be moved through handles.
 * - A solid with spheres inside has two classes of maps, because each sphere can be turned once by
 *   360 degrees on its way, but not undone: an even number of turns can. (The rotations in space
 *   are the unit quaternions up to sign.) Either class has the same images of all surfaces. So a
 *   method that starts from images of vertices, and carries nothing along ways, needs no parity. */
#ifndef ICCP_NO_MAP_H
#define ICCP_NO_MAP_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* A loop that bounds in one of two solids only. */
typedef struct iccp_bad_loop {
    iccp_memory memory;
    size_t n; /* 0: none was found, though there is one */
    uint32_t *vertices;
    int inside; /* it bounds inside the source (0) or the target (1) */
    uint32_t region;
    uint32_t surface;   /* the smallest vertex of its surface */
    size_t n_partners;  /* further surfaces that it needs: see iccp_witness */
    uint32_t *partners; /* their smallest vertices */
} iccp_bad_loop;

/* Compares two meshes whose surfaces have the same triangles by number, and the same region
 * numbers. Sets *exists to true and fills in the loop, which the caller frees, if they have no map.
 * Time is linear in the tetrahedra, times the number of handles, and cubic in the latter. */
icc_status iccp_bad_loop_find(iccp_bad_loop *loop, bool *exists, const iccp_simplices *source,
                              const iccp_simplices *target, const iccp_env *env, icc_error *err);
void iccp_bad_loop_free(iccp_bad_loop *loop);

/* Returns ICC_ERR_TOPOLOGY, with a message that names the handle's surface and the loop, if there
 * is no map from the source, which has a mesh, to the target. If the source has handles, *filled
 * becomes the target with a mesh (filled_pair.h), which the caller releases. Otherwise *filled is
 * NULL. */
icc_status iccp_solid_has_map(icc_domain **filled, const icc_domain *source,
                              const icc_domain *target, const iccp_env *env, icc_error *err);

#endif
