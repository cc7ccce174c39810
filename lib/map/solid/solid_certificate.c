/* A map that is linear in every simplex of a mesh is a homeomorphism if it keeps all orientations
 * and maps the boundary one-to-one onto the target's: Y. Lipman, Bijective Mappings of Meshes with
 * Boundary and the Degree in Mesh Processing, SIAM J. Imaging Sci. 7, 2014.
 *
 * The mesh's boundary is the source's, which is checked when the mesh is made, and its facets
 * correspond to the target's. So it is left to check that the images of its vertices are the
 * target's vertices. With features the same holds for each region, and for the points on lines. */
#include "map/solid/solid_certificate.h"

#include "base/error.h"

#include <string.h>

/* Returns true if all fixed points have the images that the target wants. */
static bool has_fixed(const iccp_solid_map *map, const icc_domain *target)
{
    const iccp_simplices *mesh = map->mesh;
    bool all = memcmp(map->images, target->vertices, 3 * mesh->n_boundary * sizeof(double)) == 0;
    for (size_t k = 0; k < mesh->n_on_lines && all; ++k) {
        const iccp_on_line *p = &mesh->on_line[k];
        double place[3];
        iccp_frame_between(&target->frame, target->vertices + 3 * (size_t)p->a,
                           target->vertices + 3 * (size_t)p->b, p->share, place);
        all = memcmp(map->images + 3 * (size_t)p->point, place, sizeof place) == 0;
    }
    return all;
}

icc_status iccp_solid_certify(icc_map *map, const iccp_env *env, icc_error *err)
{
    const iccp_solid_map *solid = map->state;
    const iccp_simplices *mesh = solid->mesh;
    const iccp_env quiet = iccp_quiet(env);
    const iccp_simplicial_map after = iccp_solid_simplicial(solid);
    const iccp_simplicial_map before = iccp_simplicial_map_of(mesh, mesh->points);
    const size_t n_faults = iccp_simplicial_count_at_once(&before, &quiet) +
                            iccp_simplicial_count_at_once(&after, &quiet);
    const bool is_bounded = has_fixed(solid, map->target_domain);
    map->info.certified = n_faults == 0 && is_bounded;
    if (map->info.certified)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_CERTIFICATE, "the mesh map cannot be certified: %zu faults%s",
                     n_faults, is_bounded ? "" : ", and its boundary is not the target's");
}
