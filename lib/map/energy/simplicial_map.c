/* Piecewise linear maps: signs, energies and Jacobians of their simplices. */
#include "map/energy/simplicial_map.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "map/energy/dirichlet.h"
#include "map/energy/flat_simplex.h"
#include "math/inverse.h"
#include "math/orient.h"
#include "math/predicates.h"
#include "math/vec.h"

#include <math.h>
#include <stdatomic.h>

/* GRAIN: simplices that a thread takes at once. BLOCK: simplices whose terms are computed before
 * they are summed in order. */
enum { GRAIN = 512, BLOCK = 4 * GRAIN };

/* In units of the local coordinates, the largest of which is about 1. */
static const double NEXT_TO_NOTHING = 1e-45;

iccp_simplicial_map iccp_simplicial_map_of(const iccp_simplices *mesh, double *images)
{
    return (iccp_simplicial_map){.dim = mesh->dim,
                                 .n_points = mesh->n_points,
                                 .n_simplices = mesh->n_simplices,
                                 .corners = mesh->corners,
                                 .points = mesh->points,
                                 .images = images,
                                 .n_fixed = mesh->n_boundary,
                                 .stretch = 1};
}

void iccp_simplicial_round(size_t n, double *coordinates)
{
    for (size_t i = 0; i < n; ++i)
        if (fabs(coordinates[i]) < NEXT_TO_NOTHING)
            coordinates[i] = 0;
}

static double stretch_of(const iccp_simplicial_map *map, size_t simplex)
{
    const size_t n = map->dim + 1;
    const uint32_t *v = map->corners + n * simplex;
    double sum = 0;
    if (map->growth == NULL)
        return map->stretch;
    for (size_t k = 0; k < n; ++k)
        sum += map->growth[v[k]];
    return map->stretch * (sum / (double)n);
}

static ICCP_INLINE void set_points(size_t dim, const iccp_simplicial_map *map, size_t simplex,
                                   const double **point)
{
    for (size_t k = 0; k <= dim; ++k)
        point[k] = map->points + dim * map->corners[(dim + 1) * simplex + k];
}

/* Returns true if rounding, of the corners too, may be all of the area or volume that doubles
 * found. */
static ICCP_INLINE bool is_flat(size_t dim, const double *const *corner, const double *element)
{
    double most = 0, length = 0;
    for (size_t k = 0; k <= dim; ++k)
        for (size_t d = 0; d < dim; ++d) {
            const double size = fabs(corner[k][d]);
            most = size > most ? size : most;
            length += fabs(corner[k][d] - corner[0][d]);
        }
    return dim == 2 ? !(2 * element[0] > ICCP_CROSS_ERROR * most * length)
                    : !(6 * element[0] > ICCP_ORIENT3D_ERROR * most * length * length);
}

/* The corners are stretched last, since rounding could turn a flat simplex over. */
static void set_flat_element(size_t dim, const double *const *point, double stretch,
                             double *element)
{
    iccp_flat_element(dim, point, element);
    for (size_t d = 0; d < dim; ++d)
        element[0] *= stretch;
    for (size_t k = 1; k < ICCP_ELEMENT(dim); ++k)
        element[k] /= stretch;
}

/* Returns false if the simplex is flat. */
static ICCP_INLINE bool set_element(size_t dim, const iccp_simplicial_map *map, size_t simplex,
                                    double *element)
{
    const double stretch = stretch_of(map, simplex);
    double stretched[4][3];
    const double *point[4], *corner[4];
    set_points(dim, map, simplex, point);
    for (size_t k = 0; k <= dim; ++k) {
        for (size_t d = 0; d < dim; ++d)
            stretched[k][d] = stretch * point[k][d];
        corner[k] = stretched[k];
    }
    iccp_element_fill(dim, corner, element);
    if (!is_flat(dim, corner, element))
        return true;
    set_flat_element(dim, point, stretch, element);
    return false;
}

void iccp_simplicial_element(const iccp_simplicial_map *map, size_t simplex, double *element)
{
    if (map->dim == 2)
        (void)set_element(2, map, simplex, element);
    else
        (void)set_element(3, map, simplex, element);
}

static ICCP_INLINE bool is_positive(size_t dim, const iccp_simplicial_map *map, size_t simplex)
{
    const double *p[ICC_MAX_DIM + 1];
    iccp_simplicial_images(dim, map, simplex, p);
    if (dim == 2)
        return iccp_orient2d(p[0], p[1], p[2]) > 0;
    if (dim == 3)
        return iccp_orient3d(p[0], p[1], p[2], p[3]) > 0;
    return iccp_orient(dim, p) > 0;
}

bool iccp_simplicial_is_positive(const iccp_simplicial_map *map, size_t simplex)
{
    return map->dim == 2   ? is_positive(2, map, simplex)
           : map->dim == 3 ? is_positive(3, map, simplex)
                           : is_positive(map->dim, map, simplex);
}

static ICCP_INLINE bool has_image(size_t dim, const iccp_simplicial_map *map, size_t simplex)
{
    const double *p[ICC_MAX_DIM + 1];
    bool is_finite = true;
    iccp_simplicial_images(dim, map, simplex, p);
    for (size_t k = 0; k <= dim; ++k)
        for (size_t d = 0; d < dim; ++d)
            is_finite &= isfinite(p[k][d]) != 0;
    return is_finite;
}

/* Counts positive simplices, so that simplices that were not checked count as inverted. */
typedef struct counting {
    const iccp_simplicial_map *map;
    atomic_size_t n_good;
} counting;

static ICCP_INLINE void count(size_t dim, counting *c, size_t begin, size_t end)
{
    size_t n_good = 0;
    for (size_t s = begin; s < end; ++s)
        n_good += has_image(dim, c->map, s) && is_positive(dim, c->map, s);
    atomic_fetch_add(&c->n_good, n_good);
}

static icc_status count_some(void *argument, size_t begin, size_t end)
{
    counting *c = argument;
    if (c->map->dim == 2)
        count(2, c, begin, end);
    else
        count(c->map->dim, c, begin, end);
    return ICC_OK;
}

size_t iccp_simplicial_count_inverted(const iccp_simplicial_map *map)
{
    counting c = {.map = map};
    (void)count_some(&c, 0, map->n_simplices);
    return map->n_simplices - atomic_load(&c.n_good);
}

size_t iccp_simplicial_count_at_once(const iccp_simplicial_map *map, const iccp_env *env)
{
    iccp_env quiet = *env;
    counting c = {.map = map};
    quiet.progress = NULL;
    (void)iccp_for_chunks(&quiet, "check", map->n_simplices, GRAIN, count_some, &c);
    return map->n_simplices - atomic_load(&c.n_good);
}

bool iccp_simplicial_is_free(const iccp_simplicial_map *map, size_t simplex)
{
    for (size_t k = 0; k <= map->dim; ++k)
        if (!iccp_simplicial_is_fixed(map, map->corners[(map->dim + 1) * simplex + k]))
            return true;
    return false;
}

bool iccp_simplicial_is_hopeless(const iccp_simplicial_map *map)
{
    for (size_t s = 0; s < map->n_simplices; ++s)
        if (!iccp_simplicial_is_free(map, s) && !iccp_simplicial_is_positive(map, s))
            return true;
    return false;
}

/* ---- beyond space ---- */

/* Row k leads from corner 0 to corner k + 1. */
static void set_edges(size_t dim, const double *points, const uint32_t *corners, double *edge)
{
    for (size_t i = 0; i < dim; ++i)
        for (size_t k = 0; k < dim; ++k)
            edge[dim * i + k] = points[dim * corners[i + 1] + k] - points[dim * corners[0] + k];
}

/* Computes the Jacobian from the edges before and after. Returns the determinant of the edges
 * before; if it is 0 for doubles, the Jacobian is NaN. */
static double find_jacobian(size_t dim, const double *before, const double *after, double *jacobian)
{
    double inverse[ICC_MAX_DIM * ICC_MAX_DIM], determinant;
    if (!iccp_invert(dim, before, inverse, &determinant))
        for (size_t i = 0; i < dim * dim; ++i)
            inverse[i] = NAN;
    for (size_t r = 0; r < dim; ++r)
        for (size_t c = 0; c < dim; ++c) {
            double sum = 0;
            for (size_t k = 0; k < dim; ++k)
                sum += inverse[dim * c + k] * after[dim * k + r];
            jacobian[dim * r + c] = sum;
        }
    return determinant;
}

/* The energy and the measure, times the same factor for all simplices. */
static double energy_beyond(const iccp_simplicial_map *map, size_t simplex, double *measure)
{
    const size_t dim = map->dim, n = dim * dim;
    const uint32_t *corners = map->corners + (dim + 1) * simplex;
    double before[ICC_MAX_DIM * ICC_MAX_DIM], after[ICC_MAX_DIM * ICC_MAX_DIM];
    double j[ICC_MAX_DIM * ICC_MAX_DIM], back[ICC_MAX_DIM * ICC_MAX_DIM];
    set_edges(dim, map->points, corners, before);
    set_edges(dim, map->images, corners, after);
    for (size_t i = 0; i < n; ++i)
        before[i] *= map->stretch;
    *measure = find_jacobian(dim, before, after, j);
    const double determinant = find_jacobian(dim, after, before, back);
    return *measure > 0 && determinant > 0
               ? *measure * (iccp_vec_dot(n, j, j) + iccp_vec_dot(n, back, back))
               : HUGE_VAL;
}

void iccp_simplicial_jacobian(const iccp_simplicial_map *map, bool inverse, size_t simplex,
                              double *jacobian)
{
    const double *points = inverse ? map->images : map->points;
    const double *images = inverse ? map->points : map->images;
    const uint32_t *v = map->corners + (map->dim + 1) * simplex;
    const double *from[4], *to[4];
    double element[ICCP_MAX_ELEMENT];
    if (map->dim > 3) {
        double before[ICC_MAX_DIM * ICC_MAX_DIM], after[ICC_MAX_DIM * ICC_MAX_DIM];
        set_edges(map->dim, points, v, before);
        set_edges(map->dim, images, v, after);
        (void)find_jacobian(map->dim, before, after, jacobian);
        return;
    }
    for (size_t k = 0; k <= map->dim; ++k) {
        from[k] = points + map->dim * v[k];
        to[k] = images + map->dim * v[k];
    }
    iccp_element_create(map->dim, from, element);
    if (is_flat(map->dim, from, element))
        iccp_flat_jacobian(map->dim, from, to, jacobian);
    else
        (void)iccp_element_jacobian(map->dim, element, to, jacobian);
}

/* The energy and the measure of each simplex from `first` on. */
typedef struct terms {
    const iccp_simplicial_map *map;
    size_t first;
    double energy[BLOCK], measure[BLOCK];
} terms;

/* Doubles may find no area or volume in a simplex that is exactly positive, before the map or after
 * it. */
static ICCP_INLINE void find_term(size_t dim, terms *t, size_t k)
{
    const iccp_simplicial_map *map = t->map;
    const size_t simplex = t->first + k;
    const double *point[4], *image[4];
    double element[ICCP_MAX_ELEMENT];
    iccp_simplicial_images(dim, map, simplex, image);
    const bool is_solid = set_element(dim, map, simplex, element);
    t->energy[k] = dim == 2 ? iccp_dirichlet_energy2(element, image)
                            : iccp_dirichlet_energy(dim, element, image);
    t->measure[k] = element[0];
    if ((is_solid && t->energy[k] < HUGE_VAL) || !iccp_simplicial_is_positive(map, simplex))
        return;
    set_points(dim, map, simplex, point);
    t->energy[k] = iccp_flat_energy(dim, point, stretch_of(map, simplex), image);
}

static icc_status find_terms(void *argument, size_t begin, size_t end)
{
    terms *t = argument;
    for (size_t k = begin; k < end; ++k)
        if (t->map->dim == 2)
            find_term(2, t, k);
        else if (t->map->dim == 3)
            find_term(3, t, k);
        else
            t->energy[k] = energy_beyond(t->map, t->first + k, &t->measure[k]);
    return ICC_OK;
}

static double mean_energy(const iccp_simplicial_map *map, const iccp_env *env)
{
    terms t;
    double sum = 0, measure = 0;
    t.map = map;
    for (t.first = 0; t.first < map->n_simplices; t.first += BLOCK) {
        const size_t left = map->n_simplices - t.first, n = left < BLOCK ? left : BLOCK;
        if (env != NULL)
            (void)iccp_for_chunks(env, "improve", n, GRAIN, find_terms, &t);
        else
            (void)find_terms(&t, 0, n);
        for (size_t k = 0; k < n; ++k) {
            sum += t.energy[k];
            measure += t.measure[k];
        }
    }
    return sum / measure;
}

double iccp_simplicial_energy(const iccp_simplicial_map *map)
{
    return mean_energy(map, NULL);
}

double iccp_simplicial_energy_at_once(const iccp_simplicial_map *map, const iccp_env *env)
{
    const iccp_env quiet = iccp_quiet(env);
    return mean_energy(map, &quiet);
}
