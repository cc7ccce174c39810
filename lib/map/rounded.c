/* Counts the simplices that rounding to the caller's coordinates spoils.
 *
 * The certificate of a mesh map is about local coordinates. The caller's coordinates are these
 * scaled by a power of two and shifted. Scaling is exact except near the smallest doubles, and
 * shifting rounds. The way back to local coordinates does not round (geometry/frame.h), so exact
 * signs there tell whether a rounded simplex is positive. */
#include "map/rounded.h"

#include "math/orient.h"

/* Below this scale, scaling may lose bits. */
static const double LEAST_SCALE = 0x1p-800;

static bool is_exact(const iccp_frame *frame, size_t dim)
{
    bool exact = frame->out[0] * frame->out[1] >= LEAST_SCALE;
    for (size_t k = 0; k < dim; ++k)
        exact &= frame->shift[k] == 0;
    return exact;
}

/* True if a simplex that is positive in local coordinates is still positive when rounded. */
static bool stays_positive(const iccp_frame *frame, size_t dim, const double *points,
                           const uint32_t *corners)
{
    double own[ICC_MAX_DIM + 1][ICC_MAX_DIM];
    const double *corner[ICC_MAX_DIM + 1];
    for (size_t i = 0; i <= dim; ++i) {
        iccp_frame_out(frame, (int32_t)dim, points + dim * corners[i], own[i]);
        iccp_frame_in(frame, (int32_t)dim, own[i], own[i]);
        corner[i] = own[i];
    }
    return iccp_orient(dim, corner) > 0;
}

size_t iccp_map_count_spoilt(const icc_map *map)
{
    const size_t dim = (size_t)map->source_domain->dim;
    const iccp_frame *frame[2] = {&map->source_domain->frame, &map->target_domain->frame};
    const bool exact[2] = {is_exact(frame[0], dim), is_exact(frame[1], dim)};
    if (map->kind->mesh == NULL || (exact[0] && exact[1]))
        return 0;
    const iccp_simplicial_map m = map->kind->mesh(map);
    size_t n = 0;
    for (size_t s = 0; s < m.n_simplices; ++s) {
        const uint32_t *corners = m.corners + (dim + 1) * s;
        n += !((exact[0] || stays_positive(frame[0], dim, m.points, corners)) &&
               (exact[1] || stays_positive(frame[1], dim, m.images, corners)));
    }
    return n;
}
