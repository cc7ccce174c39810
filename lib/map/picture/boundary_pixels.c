/* Decides the pixels close to the boundary one by one.
 *
 * Scan conversion is correct up to rounding, and its intervals are half-open. Domains are closed,
 * and points are located in them exactly. Only few pixels are so close to the boundary that this
 * can matter. */
#include "map/picture/boundary_pixels.h"

#include "base/minmax.h"
#include "map/plane/plane_kind.h"

#include <math.h>
#include <string.h>

/* In units of the largest coordinate. A domain counts points up to 1e-14 outside as boundary, which
 * is far more than the rounding of coordinates. Crossings of rows are off by a few units in the
 * last place, 1e-16. */
static const double CLOSE = 1e-13;

/* ---- listing ---- */

static uint8_t *pixel_at(const icc_picture *p, int32_t column, int32_t row)
{
    return (uint8_t *)p->pixels + (size_t)row * p->stride +
           (size_t)column * (size_t)(p->channels * p->bytes);
}

static icc_status add(iccp_boundary_pixels *boundary, const icc_picture *target, int32_t column,
                      int32_t row)
{
    if (boundary->n == boundary->room) {
        const size_t room = 2 * boundary->room + 64;
        struct iccp_boundary_pixel *more =
            iccp_grow(&boundary->memory, boundary->pixels, boundary->n, room, sizeof *more);
        if (more == NULL)
            return ICC_ERR_MEMORY;
        boundary->pixels = more;
        boundary->room = room;
    }
    struct iccp_boundary_pixel *pixel = &boundary->pixels[boundary->n++];
    *pixel = (struct iccp_boundary_pixel){.column = column, .row = row};
    memcpy(pixel->before, pixel_at(target, column, row),
           (size_t)(target->channels * target->bytes));
    return ICC_OK;
}

/* Returns the first of n pixel centres that is not before x. */
static int32_t first_centre(double x, int32_t n)
{
    const double k = ceil(x - 0.5);
    return !(k > 0) ? 0 : k < n ? (int32_t)k : n;
}

/* Returns x where the segment from a to b, with a below b, reaches a height. Beyond the segment it
 * returns the x of the nearer end. */
static double x_at(const double a[2], const double b[2], double y)
{
    if (y <= a[1])
        return a[0];
    return y >= b[1] ? b[0] : a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
}

static icc_status add_along(iccp_boundary_pixels *boundary, const icc_picture *target,
                            const double *a, const double *b, double close)
{
    if (a[1] > b[1]) {
        const double *other = a;
        a = b;
        b = other;
    }
    const int32_t end = first_centre(b[1] + close, target->height);
    icc_status status = ICC_OK;
    for (int32_t row = first_centre(a[1] - close, target->height); row < end; ++row) {
        const double x[2] = {x_at(a, b, row + 0.5 - close), x_at(a, b, row + 0.5 + close)};
        const int32_t last = first_centre(iccp_max(x[0], x[1]) + close, target->width);
        for (int32_t column = first_centre(iccp_min(x[0], x[1]) - close, target->width);
             column < last && status == ICC_OK; ++column)
            status = add(boundary, target, column, row);
    }
    return status;
}

icc_status iccp_boundary_pixels_create(iccp_boundary_pixels *boundary, const icc_domain *domain,
                                       const icc_picture *target, const iccp_env *env)
{
    *boundary = (iccp_boundary_pixels){.memory = env->memory};
    double largest = 0, ends[2][2];
    for (size_t v = 0; v < domain->n_vertices; ++v) {
        iccp_domain_given(domain, v, ends[0]);
        largest = iccp_max(largest, iccp_max(fabs(ends[0][0]), fabs(ends[0][1])));
    }
    icc_status status = ICC_OK;
    for (size_t i = 0; i < domain->n_facets && status == ICC_OK; ++i) {
        for (size_t end = 0; end < 2; ++end)
            iccp_domain_given(domain, domain->facets[2 * i + end], ends[end]);
        status = add_along(boundary, target, ends[0], ends[1], CLOSE * largest);
    }
    if (status != ICC_OK)
        iccp_boundary_pixels_free(boundary);
    return status;
}

void iccp_boundary_pixels_free(iccp_boundary_pixels *boundary)
{
    iccp_free(&boundary->memory, boundary->pixels);
    *boundary = (iccp_boundary_pixels){.memory = boundary->memory};
}

/* ---- deciding ---- */

/* Finds the source point of a pixel's centre. Returns false if the centre is outside. A centre that
 * is inside but in no triangle lies within rounding of the boundary. */
static bool origin(const icc_map *map, const double centre[2], double place[2])
{
    const icc_domain *from = map->target_domain, *to = map->source_domain;
    double local[2], image[2], bary[2];
    uint32_t facet;
    iccp_frame_in(&from->frame, 2, centre, local);
    const int32_t where = iccp_domain_locate(from, local, false, &facet, bary);
    if (where == ICC_OUTSIDE)
        return false;
    if (where == ICC_BOUNDARY ||
        iccp_mesh_map_point(iccp_plane_of(map), true, local, image, NULL) != ICC_OK)
        iccp_domain_facet_point(to, facet, bary, image);
    iccp_frame_out(&to->frame, 2, image, place);
    return true;
}

void iccp_boundary_pixels_decide(const iccp_boundary_pixels *boundary, const icc_map *map,
                                 const iccp_sampler *source, const icc_picture *target)
{
    for (size_t k = 0; k < boundary->n; ++k) {
        const struct iccp_boundary_pixel *pixel = &boundary->pixels[k];
        const double centre[2] = {pixel->column + 0.5, pixel->row + 0.5};
        double place[2];
        uint8_t *to = pixel_at(target, pixel->column, pixel->row);
        if (origin(map, centre, place)) {
            const iccp_line line = {place[0] - 0.5, place[1] - 0.5, 0, 0, 1};
            iccp_sampler_paint(source, &line, to);
        } else
            memcpy(to, pixel->before, (size_t)(target->channels * target->bytes));
    }
}
