/* One step of Newton's method for all of a map goes no farther than the worst triangle lets it: it
 * ends before the first one flips, and where the energy is 1 / sigma^2 sigma grows by a third at a
 * time. So triangles that are tense are eased before, each patch of them by itself, at the cost of
 * what is near them. */
#include "map/ease.h"

#include "map/descent.h"
#include "map/dirichlet.h"
#include "map/patches.h"

#include <string.h>

/* A triangle is tense from so many times the energy over the area on that triangles typically have;
 * what is typical is a harmonic mean, of which the worst hardly have a share. */
static const double TENSE = 50;

/* Rings of neighbours that move with the corners of such a triangle, these included. */
enum { RINGS = 3 };

static const iccp_descent EASING = {15, 1e-2, 0, false};

static double density_of(const iccp_simplicial_map *map, size_t triangle, double *area)
{
    const double *image[3];
    double element[ICCP_ELEMENT(2)];
    iccp_simplicial_images(2, map, triangle, image);
    iccp_simplicial_element(map, triangle, element);
    *area = element[0];
    return iccp_dirichlet_energy2(element, image) / element[0];
}

/* Marks the corners of tense triangles; whether there are any. */
static bool mark_tense(const iccp_simplicial_map *map, uint8_t *marks)
{
    double all = 0, softness = 0, area;
    bool any = false;
    for (size_t t = 0; t < map->n_simplices; ++t) {
        const double density = density_of(map, t, &area);
        all += area;
        softness += area / density;
    }
    memset(marks, 0, map->n_points);
    for (size_t t = 0; t < map->n_simplices; ++t)
        if (density_of(map, t, &area) * softness > TENSE * all) {
            for (size_t k = 0; k < 3; ++k)
                marks[map->corners[3 * t + k]] = 1;
            any = true;
        }
    return any;
}

static icc_status ease_patches(const iccp_simplicial_map *map, const uint8_t *movable,
                               iccp_work *work, const iccp_env *env)
{
    iccp_patches patches;
    icc_status status = iccp_patches_create(&patches, map, movable, &env->memory);
    for (size_t p = 0; status == ICC_OK && p < patches.n; ++p) {
        const iccp_env own = iccp_round(env, p, (double)patches.n);
        const iccp_simplicial_map part = iccp_patches_cut_out(&patches, p);
        status = iccp_improve_images(&part, &EASING, work, NULL, &own);
        iccp_patches_put_back(&patches, &part);
    }
    iccp_patches_free(&patches);
    return status;
}

icc_status iccp_ease(iccp_plmap *map, iccp_work *work, const iccp_env *env)
{
    const iccp_simplicial_map simplicial = iccp_plmap_simplicial(map);
    uint8_t *marks = iccp_alloc(&env->memory, map->n_vertices, 1);
    icc_status status = marks != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK && mark_tense(&simplicial, marks)) {
        iccp_simplicial_grow(&simplicial, RINGS, marks);
        status = ease_patches(&simplicial, marks, work, env);
    }
    iccp_free(&env->memory, marks);
    return status;
}
