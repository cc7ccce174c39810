/* Chooses the points that are worth moving.
 *
 * The mesh of a cage with many vertices is fine along its boundary and coarse inside. Most of its
 * triangles lie in a strip whose area is negligible, so moving them hardly changes the energy. The
 * boundary is fixed, so leaving them alone moves nothing inside by more than the strip's width. */
#include "map/energy/movable.h"

#include "map/energy/dirichlet.h"

#include <math.h>

/* Meshes with fewer triangles are moved as a whole. */
enum { FEW = 1 << 17 };

/* The triangles left alone may carry at most this share of the energy, counted above an
 * isometry's. */
static const double SHARE = 1e-3;

/* Areas are sorted into classes by powers of two, from the smallest double to the largest. */
enum { CLASSES = 2200, CLASS_OF_ONE = 1100 };

/* Finds the class of each triangle, and the energy above an isometry's that each class carries.
 * Returns the energy of all triangles. */
static double classify(const iccp_simplicial_map *map, uint16_t *class, double excess[CLASSES])
{
    double energy = 0;
    for (size_t t = 0; t < map->n_simplices; ++t) {
        double element[ICCP_ELEMENT(2)];
        const double *image[3];
        int exponent;
        iccp_simplicial_element(map, t, element);
        iccp_simplicial_images(2, map, t, image);
        const double own = iccp_dirichlet_energy(2, element, image);
        (void)frexp(element[0], &exponent);
        class[t] = (uint16_t)(CLASS_OF_ONE + exponent);
        excess[class[t]] += own - 4 * element[0];
        energy += own;
    }
    return energy;
}

bool iccp_all_are_movable(size_t n_triangles)
{
    return n_triangles < FEW;
}

icc_status iccp_movable_create(uint8_t **movable, const iccp_simplicial_map *map,
                               const iccp_env *env)
{
    *movable = NULL;
    if (map->dim != 2 || iccp_all_are_movable(map->n_simplices))
        return ICC_OK;
    uint16_t *class = iccp_alloc(&env->memory, map->n_simplices, sizeof *class);
    uint8_t *marks = iccp_alloc_zero(&env->memory, map->n_points, 1);
    double excess[CLASSES] = {0}, left_alone = 0;
    size_t limit = 0;
    *movable = marks;
    if (class != NULL && marks != NULL) {
        const double energy = classify(map, class, excess);
        while (limit < CLASSES && (left_alone += excess[limit]) <= SHARE * energy)
            ++limit;
        for (size_t t = 0; t < map->n_simplices; ++t)
            for (size_t k = 0; k < 3; ++k)
                marks[map->corners[3 * t + k]] |= class[t] >= limit;
    }
    iccp_free(&env->memory, class);
    return class != NULL && marks != NULL ? ICC_OK : ICC_ERR_MEMORY;
}
