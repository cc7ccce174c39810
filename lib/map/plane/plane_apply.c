/* Applies a mesh map in the plane to points: asks the mesh, and near the boundary the domain. */
#include "map/plane/plane_apply.h"

#include "map/kind/caller_point.h"

#include <assert.h>

/* Whether a point is a vertex of the mesh on a line or point inside. It goes to that vertex's
 * image, however near the boundary is. */
static bool is_given(const icc_map *map, const iccp_found *found)
{
    uint32_t vertex;
    return found->triangle != ICCP_NO_NEIGHBOUR &&
           iccp_mesh_map_is_given(map->state, found, &vertex);
}

/* Maps a point that was looked up in the mesh.
 *
 * Far from the mesh's boundary, the triangles decide: a point is inside if a triangle holds it, and
 * outside otherwise. The domain would say the same. It counts points as on its boundary only within
 * the reach of the band. The mesh's boundary is at most 1.5 times the reach away from it. So the
 * two agree farther than 4 times the reach from the mesh's boundary. Nearer, the domain decides. */
static icc_status map_point(const icc_map *map, bool inverse, const double *point,
                            const double *local, const iccp_found *found, double *image,
                            double *jacobian)
{
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    const icc_domain *to = inverse ? map->source_domain : map->target_domain;
    double local_image[2], bary[2];
    uint32_t facet;
    icc_status status = ICC_OK;
    int32_t where = found->triangle != ICCP_NO_NEIGHBOUR ? ICC_INSIDE : ICC_OUTSIDE;
    if (found->is_near && !is_given(map, found)) {
        if (!iccp_point_is_finite(2, point))
            return ICC_ERR_ARGUMENT;
        where = iccp_domain_locate(from, local, true, &facet, bary);
    }
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (where == ICC_BOUNDARY)
        status = iccp_image_on_boundary(to, facet, bary, local_image, jacobian);
    else if (found->triangle != ICCP_NO_NEIGHBOUR)
        iccp_mesh_map_image(map->state, inverse, found, local_image, jacobian);
    else
        status = ICC_ERR_TRACE;
    if (status == ICC_OK)
        iccp_image_out(from, to, 2, local_image, image, jacobian);
    return status;
}

static_assert((int)ICCP_FINDER_MANY >= (int)ICCP_CHART_MANY, "all points of a chunk at once");

icc_status iccp_plane_apply(const icc_map *map, bool inverse, size_t n, const double *points,
                            double *images, double *jacobians, icc_status *status, iccp_path *path)
{
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    double local[2 * ICCP_CHART_MANY], own[2];
    iccp_found found[ICCP_CHART_MANY];
    (void)path;
    if (n == 0)
        return ICC_OK;
    for (size_t i = 0; i < n; ++i)
        iccp_frame_in(&from->frame, 2, points + 2 * i, local + 2 * i);
    iccp_mesh_map_find(map->state, inverse, n, local, found);
    for (size_t i = 0; i < n; ++i) {
        double *image = images != NULL ? images + 2 * i : own;
        double *jacobian = jacobians != NULL ? jacobians + 4 * i : NULL;
        status[i] =
            map_point(map, inverse, points + 2 * i, local + 2 * i, &found[i], image, jacobian);
        if (status[i] != ICC_OK)
            iccp_image_none(2, image, jacobian);
    }
    return ICC_OK;
}
