/* Samples on surfaces. They get more random points than needed, and thinning leaves them evenly
 * spread: M. Corsini, P. Cignoni, R. Scopigno, Efficient and flexible sampling with blue noise
 * properties of triangular meshes, 2012. Each face gets its share by a running sum of areas, so
 * faces smaller than one sample are treated fairly. */
#include "kernel/sampling/boundary_samples.h"

#include "base/random.h"
#include "domain/complex.h"

#include <math.h>

/* Random points per square of the spacing. They leave almost no hole in which a sample would
 * fit. */
static const double POINTS_A_SQUARE = 12;

/* Returns twice the area. Writes the unit normal unless `normal` is NULL. */
static double normal_of(const icc_shape *shape, uint32_t f, double *normal)
{
    const double *c[3];
    double u[3], v[3], n[3];
    iccp_facet_corners(&shape->walls, f, c);
    for (int k = 0; k < 3; ++k) {
        u[k] = c[1][k] - c[0][k];
        v[k] = c[2][k] - c[0][k];
    }
    for (int k = 0; k < 3; ++k)
        n[k] = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    const double twice = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3 && normal != NULL; ++k)
        normal[k] = n[k] / twice;
    return twice;
}

static bool is_crease(const icc_shape *shape, uint32_t f, uint32_t g)
{
    double m[3], n[3];
    (void)normal_of(shape, f, m);
    (void)normal_of(shape, g, n);
    return !(m[0] * n[0] + m[1] * n[1] + m[2] * n[2] >= ICCP_SHARP_COSINE);
}

/* Writes the creases as pairs of vertices, and returns their number. */
static size_t find_creases(const icc_shape *shape, const uint32_t *across, uint32_t *creases)
{
    size_t n = 0;
    for (uint32_t f = 0; f < shape->walls.n; ++f)
        for (size_t i = 0; i < 3; ++i) {
            const uint32_t g = across[3 * (size_t)f + i];
            if (g < f || !is_crease(shape, f, g))
                continue;
            creases[2 * n] = shape->facets[3 * (size_t)f + (i + 1) % 3];
            creases[2 * n++ + 1] = shape->facets[3 * (size_t)f + (i + 2) % 3];
        }
    return n;
}

icc_status iccp_creases_sample(iccp_point_list *list, const icc_shape *shape, double spacing,
                               const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_vertices = shape->n_walled;
    iccp_complex complex = {3, n_vertices, shape->walls.n, shape->facets, NULL};
    complex.across = iccp_alloc(memory, shape->walls.n, 3 * sizeof *complex.across);
    uint32_t *creases = iccp_alloc(memory, shape->walls.n, 3 * sizeof *creases);
    icc_status status = ICC_ERR_MEMORY;
    if (complex.across != NULL && creases != NULL)
        status = iccp_complex_join(&complex, env, NULL);
    if (status == ICC_OK) {
        const size_t n = find_creases(shape, complex.across, creases);
        status = iccp_segments_sample(list, shape->local, n_vertices, n, creases, spacing, env);
    }
    iccp_free(memory, complex.across);
    iccp_free(memory, creases);
    return status;
}

/* Adds a uniformly random point on face f of the walls. Two numbers in the unit square are
 * reflected into the triangle if they lie beyond the diagonal. */
static void add_random(iccp_point_list *list, const icc_shape *shape, uint32_t f, uint64_t *state)
{
    const double *c[3];
    double a = iccp_random_unit(state), b = iccp_random_unit(state), point[3];
    iccp_facet_corners(&shape->walls, f, c);
    if (a + b > 1) {
        a = 1 - a;
        b = 1 - b;
    }
    for (int k = 0; k < 3; ++k)
        point[k] = c[0][k] + a * (c[1][k] - c[0][k]) + b * (c[2][k] - c[0][k]);
    iccp_point_list_add(list, point);
}

/* Fisher and Yates' shuffle. In the order of the faces, the thinning would leave stripes. */
static void shuffle(iccp_point_list *list, size_t first, uint64_t *state)
{
    for (size_t i = list->n; i-- > first + 1;) {
        const size_t j = first + (size_t)(iccp_random(state) % (i + 1 - first));
        for (size_t k = 0; k < 3; ++k) {
            const double x = list->points[3 * i + k];
            list->points[3 * i + k] = list->points[3 * j + k];
            list->points[3 * j + k] = x;
        }
    }
}

icc_status iccp_surface_sample(iccp_point_list *list, const icc_shape *shape, double spacing,
                               uint64_t seed)
{
    const size_t first = list->n;
    uint64_t state = seed;
    double due = 0;
    for (uint32_t f = 0; f < shape->walls.n; ++f) {
        due += POINTS_A_SQUARE * 0.5 * normal_of(shape, f, NULL) / (spacing * spacing);
        for (; due >= 1 && !list->failed; --due)
            add_random(list, shape, f, &state);
    }
    shuffle(list, first, &state);
    return list->failed ? ICC_ERR_MEMORY : ICC_OK;
}
