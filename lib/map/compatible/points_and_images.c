/* Takes steps that move the images by the energy of the map, and then steps that move the points by
 * the energy of its inverse. The two energies differ only in how triangles count: by their area
 * before or after the map.
 *
 * A triangle that is tiny on one side costs next to nothing there, however flat it becomes on the
 * other side. It may become so flat that doubles see no area, and then the inverse has no energy.
 * So the corners of such triangles go back to where they were. */
#include "map/compatible/points_and_images.h"

#include "map/compatible/triangle_quality.h"

#include <math.h>
#include <string.h>

/* Triangles become no flatter than this. Rounding changes the roundness of a triangle by about this
 * much if the triangle is 1e-8 of the domain across. */
static const double LEAST_RESOLVED_ROUNDNESS = 1e-8;

typedef struct retreat {
    iccp_plmap *map;
    double *before; /* the images before the steps */
    uint8_t *back;  /* of each vertex: 1 if it has its image of before again */
} retreat;

static double roundness_of(const double *places, const uint32_t *v)
{
    return iccp_roundness(places + 2 * (size_t)v[0], places + 2 * (size_t)v[1],
                          places + 2 * (size_t)v[2]);
}

/* Whether the image of a triangle is not positive, or is too flat and flatter than it was. Also
 * true if the triangle has no area or no finite energy in doubles, for the map or for its
 * inverse. */
static bool is_spoilt(const retreat *r, uint32_t triangle)
{
    const uint32_t *v = r->map->corners.vertex + 3 * (size_t)triangle;
    if (!iccp_plmap_positive_image(r->map, triangle) ||
        roundness_of(r->map->images, v) <
            iccp_min(LEAST_RESOLVED_ROUNDNESS, roundness_of(r->before, v)))
        return true;
    return !iccp_quality_is_sound(r->map, v[0], v[1], v[2]);
}

/* Gives the corners of a triangle their images of before. Returns false if all had them already. */
static bool send_back(const retreat *r, uint32_t triangle)
{
    bool any = false;
    for (size_t k = 0; k < 3; ++k) {
        const size_t v = r->map->corners.vertex[3 * (size_t)triangle + k];
        any |= !r->back[v];
        r->back[v] = 1;
        memcpy(r->map->images + 2 * v, r->before + 2 * v, 2 * sizeof *r->before);
    }
    return any;
}

/* Sends back the corners of spoilt triangles. That may spoil neighbours, so it goes on until
 * nothing changes. It ends because a vertex that went back stays there. If the energy is then
 * higher than before, all go back. */
static void send_back_spoilt(const retreat *r, double energy_before)
{
    const size_t n = r->map->n_vertices;
    bool any = true, ever = false;
    memset(r->back, 0, n);
    while (any) {
        any = false;
        for (uint32_t t = 0; t < r->map->corners.n_triangles; ++t)
            if (is_spoilt(r, t) && send_back(r, t))
                any = ever = true;
    }
    if (ever && !(iccp_plmap_energy(r->map) <= energy_before))
        memcpy(r->map->images, r->before, 2 * n * sizeof *r->before);
}

icc_status iccp_improve_points_and_images(iccp_plmap *map, const iccp_descent *descent,
                                          iccp_work *work, iccp_improvement *improvement,
                                          const iccp_env *env)
{
    const size_t n = map->n_vertices;
    retreat r = {map, iccp_alloc(&env->memory, n, 2 * sizeof *r.before),
                 iccp_alloc(&env->memory, n, sizeof *r.back)};
    icc_status status = r.before != NULL && r.back != NULL ? ICC_OK : ICC_ERR_MEMORY;
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    for (int side = 0; side < 2; ++side) {
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
        if (status == ICC_OK) {
            const double energy = iccp_simplicial_energy_at_once(&simplicial, env);
            memcpy(r.before, map->images, 2 * n * sizeof *r.before);
            status = iccp_take_steps(&simplicial, descent, work, improvement, &part[side]);
            send_back_spoilt(&r, energy);
        }
        iccp_plmap_swap(map);
    }
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    improvement->energy = iccp_simplicial_energy_at_once(&simplicial, env);
    iccp_free(&env->memory, r.before);
    iccp_free(&env->memory, r.back);
    return status;
}
