/* Chooses the vectors of the field. Source: docs/theory/charts-space.md, "fields on grids".
 *
 * Let X_v . grad f > 0 in every simplex at v, for all vertices v. Then X . grad f > 0 everywhere,
 * because X is linear in each simplex and grad f is constant. X is Lipschitz, so its curves do not
 * merge. They cannot close, because f rises along them.
 *
 * The vector of a vertex is the mean of the gradients' directions if its products with all of them
 * are well above 0. Otherwise it is the point of their hull nearest to the origin, which is uphill
 * if and only if any vector is. The boundary's inward normals should agree too, because then curves
 * cross the boundary one way. If no vector suits all of these, the normals have priority.
 *
 * If no vector suits the gradients, the function is changed a little. It moves to the nearest
 * values for which the gradients have a positive product with the vector, simplex by simplex.
 * The vectors are then found anew. Source of this projection: L. G. Gubin, B. T. Polyak, E. V.
 * Raik, The Method of Projections for Finding the Common Point of Convex Sets, 1967. */
#include "field/vectors.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "field/minnorm.h"
#include "math/vec.h"

#include <float.h>
#include <string.h>

enum { MOST_NORMALS = 64, FIRM_ROUNDS = 20, MOST_ROUNDS = 40, TYPICAL_ROUNDS = 4 };

static const size_t GRAIN = 1 << 10; /* vertices per chunk */

/* Bounds on products of unit vectors. GOOD: the mean of the gradients is taken if all its products
 * exceed this, because means keep the vectors smooth. LEAST: a vector is accepted above this. AIM:
 * the projection aims at this. */
static const double GOOD = 0.15, LEAST = 1e-6, AIM = 0.05;

/* A vertex and the simplices at it. A simplex is given as (r, k): the vertex is corner k in the
 * order r of the axes. Values and flags are indexed by a set of axes, in which bit i stands for
 * axis i. They belong to the vertex plus, or minus, one step along each axis of the set. */
typedef struct star {
    const iccp_extension *extension;
    const iccp_incidence *incidence;
    const iccp_orders *orders;
    uint32_t vertex;
    int32_t exponent;
    double up[1 << ICC_MAX_DIM], down[1 << ICC_MAX_DIM]; /* values, by set of axes */
    uint8_t up_inside[1 << ICC_MAX_DIM], down_inside[1 << ICC_MAX_DIM];
    size_t n_gradients, n_normals;
    double *direction;     /* gradients, then normals, each of length 1 */
    const uint8_t *sector; /* by simplex; only the simplices of sector `number` count. NULL: all
                              count */
    uint8_t number;
} star;

/* The simplices at a vertex, (dim + 1)! with a gradient each, and the normals. */
static size_t most_directions(int32_t dim)
{
    size_t n = 1;
    for (int32_t k = 2; k <= dim + 1; ++k)
        n *= (size_t)k;
    return n + MOST_NORMALS;
}

/* Loads the values around a vertex. All get the greatest of their exponents, so that they can be
 * subtracted. */
static void load_star(star *s, uint32_t v)
{
    const icc_grid *grid = s->extension->grid;
    const int n_sets = 1 << grid->dim;
    s->vertex = v;
    s->exponent = iccp_extension_exponent(s->extension, v);
    for (int set = 1; set < n_sets && s->extension->exponent != NULL; ++set) {
        const int32_t a = s->extension->exponent[(ptrdiff_t)v + s->orders->offset[set]];
        const int32_t b = s->extension->exponent[(ptrdiff_t)v - s->orders->offset[set]];
        s->exponent = a > s->exponent ? a : s->exponent;
        s->exponent = b > s->exponent ? b : s->exponent;
    }
    for (int set = 0; set < n_sets; ++set) {
        const uint32_t up = (uint32_t)((ptrdiff_t)v + s->orders->offset[set]);
        const uint32_t down = (uint32_t)((ptrdiff_t)v - s->orders->offset[set]);
        s->up[set] = iccp_extension_get(s->extension, up, s->exponent);
        s->down[set] = iccp_extension_get(s->extension, down, s->exponent);
        s->up_inside[set] = grid->inside[up];
        s->down_inside[set] = grid->inside[down];
    }
}

/* Returns true if simplex r with the vertex as corner k meets the domain, and writes its lowest
 * corner. */
static bool is_active(const star *s, int32_t r, int32_t k, uint32_t *lowest)
{
    const int8_t *axis = s->orders->axis[r];
    const int32_t dim = s->orders->dim;
    int below = 0, above = 0;
    bool any = s->up_inside[0];
    for (int32_t i = k; i-- > 0;) {
        below |= 1 << axis[i];
        any = any || s->down_inside[below];
    }
    for (int32_t i = k; i < dim; ++i) {
        above |= 1 << axis[i];
        any = any || s->up_inside[above];
    }
    *lowest = (uint32_t)((ptrdiff_t)s->vertex - s->orders->offset[below]);
    if (s->sector != NULL && s->sector[iccp_sector_simplex(dim, r, k)] != s->number)
        return false;
    return any || iccp_incidence_has(s->incidence, *lowest, r);
}

/* The gradient in simplex r with the vertex as corner k, by axis. */
static void gradient_of(const star *s, int32_t r, int32_t k, double *gradient)
{
    const int8_t *axis = s->orders->axis[r];
    int set = 0;
    double value = s->up[0];
    for (int32_t i = k; i-- > 0;) {
        set |= 1 << axis[i];
        gradient[axis[i]] = value - s->down[set];
        value = s->down[set];
    }
    set = 0;
    value = s->up[0];
    for (int32_t i = k; i < s->orders->dim; ++i) {
        set |= 1 << axis[i];
        gradient[axis[i]] = s->up[set] - value;
        value = s->up[set];
    }
}

/* Returns false if the vector is zero. */
static bool normalise(int32_t dim, double *v)
{
    double longest = 0;
    for (int32_t k = 0; k < dim; ++k)
        longest = iccp_max(longest, fabs(v[k]));
    if (!(longest > 0))
        return false;
    for (int32_t k = 0; k < dim; ++k)
        v[k] /= longest;
    const double length = iccp_vec_norm((size_t)dim, v);
    for (int32_t k = 0; k < dim; ++k)
        v[k] /= length;
    return true;
}

/* Lists the directions of the gradients. A zero gradient stays zero, because no vector has a
 * positive product with it. */
static void list_gradients(star *s)
{
    const int32_t dim = s->orders->dim;
    s->n_gradients = s->n_normals = 0;
    for (int32_t r = 0; r < s->orders->n; ++r)
        for (int32_t k = 0; k <= dim; ++k) {
            uint32_t lowest;
            if (!is_active(s, r, k, &lowest))
                continue;
            double *g = s->direction + (size_t)dim * s->n_gradients++;
            gradient_of(s, r, k, g);
            (void)normalise(dim, g);
        }
}

/* Returns true if a facet runs through a simplex of the current sector. */
static bool is_in_sector(const star *s, uint32_t facet)
{
    for (int32_t r = 0; s->sector != NULL && r < s->orders->n; ++r)
        for (int32_t k = 0; k <= s->orders->dim; ++k) {
            uint32_t lowest;
            if (is_active(s, r, k, &lowest) &&
                iccp_incidence_touches(s->incidence, facet, lowest, s->orders->axis[r]))
                return true;
        }
    return s->sector == NULL;
}

/* Lists the inward normals of the facets at the vertex after the gradients. Parallel normals
 * count once, which keeps their number small on flat boundaries. */
static void list_normals(star *s)
{
    static const double SAME = 1 - 1e-12;
    const size_t dim = (size_t)s->orders->dim;
    double *normals = s->direction + dim * s->n_gradients;
    const uint32_t *facet = s->incidence->facet;
    for (uint32_t i = s->incidence->first[s->vertex];
         i < s->incidence->first[s->vertex + 1] && s->n_normals < MOST_NORMALS; ++i) {
        const double *normal = s->incidence->normal + dim * facet[i];
        bool fresh = true;
        for (size_t j = 0; fresh && j < s->n_normals; ++j)
            fresh = iccp_vec_dot(dim, normals + dim * j, normal) < SAME;
        if (fresh && is_in_sector(s, facet[i]))
            memcpy(normals + dim * s->n_normals++, normal, dim * sizeof *normal);
    }
}

/* The least product of a unit vector with any of n directions. */
static double least_product(int32_t dim, size_t n, const double *direction, const double *x)
{
    double least = DBL_MAX;
    for (size_t i = 0; i < n; ++i)
        least = iccp_min(least, iccp_vec_dot((size_t)dim, direction + (size_t)dim * i, x));
    return least;
}

/* Finds a vector of length 1 whose products with all n directions exceed LEAST. If there is
 * none, returns false, and x becomes the mean, or stays as it is if the mean is 0. */
static bool find_vector(int32_t dim, size_t n, const double *direction, double *x)
{
    double mean[ICC_MAX_DIM] = {0}, nearest[ICC_MAX_DIM];
    for (size_t i = 0; i < n; ++i)
        for (int32_t k = 0; k < dim; ++k)
            mean[k] += direction[(size_t)dim * i + (size_t)k];
    const bool has_mean = normalise(dim, mean);
    if (has_mean)
        memcpy(x, mean, (size_t)dim * sizeof *x);
    if (has_mean && least_product(dim, n, direction, mean) > GOOD)
        return true;
    if (!(iccp_minnorm((size_t)dim, n, direction, nearest) > LEAST) || !normalise(dim, nearest))
        return false;
    if (!(least_product(dim, n, direction, nearest) > LEAST))
        return false;
    memcpy(x, nearest, (size_t)dim * sizeof *x);
    return true;
}

/* If a vertex is joined to the root, writes the vector that leads there and returns true. */
static bool is_radial(const star *s, double *x)
{
    const int n_sets = 1 << s->orders->dim;
    for (int set = 1; set < n_sets; ++set)
        for (int sign = -1; sign <= 1; sign += 2)
            if ((ptrdiff_t)s->vertex + sign * s->orders->offset[set] ==
                (ptrdiff_t)s->extension->root) {
                for (int32_t k = 0; k < s->orders->dim; ++k)
                    x[k] = set >> k & 1 ? sign : 0;
                return true;
            }
    return false;
}

/* Tilts x towards `uphill` by 4, 2, .. times that vector. It takes the largest tilt that keeps
 * half of the least product with the n normals, or AIM if that is smaller. */
static void tilt_uphill(int32_t dim, size_t n, const double *normals, const double *uphill,
                        double *x)
{
    const double least = iccp_min(0.5 * least_product(dim, n, normals, x), AIM);
    double tilted[ICC_MAX_DIM];
    for (double share = 4; share > 0.1; share *= 0.5) {
        for (int32_t k = 0; k < dim; ++k)
            tilted[k] = x[k] + share * uphill[k];
        if (normalise(dim, tilted) && least_product(dim, n, normals, tilted) >= least) {
            memcpy(x, tilted, (size_t)dim * sizeof *x);
            return;
        }
    }
}

/* Writes the vector of a vertex, or of one sector of it. Returns true if it is uphill in all
 * simplices. The first of these that exists is taken:
 * - next to the root, the vector to the root;
 * - a vector that suits gradients and normals;
 * - unless `gradients_first`, a vector that suits the normals, tilted uphill;
 * - a vector that suits the gradients.
 *
 * `*agrees` is false if no vector suits both gradients and normals. Next to the root this is not
 * tested. */
static bool choose_vector(star *s, bool gradients_first, double *x, bool *agrees)
{
    const int32_t dim = s->orders->dim;
    list_gradients(s);
    *agrees = true;
    if (s->n_gradients == 0)
        return true;
    if (is_radial(s, x)) {
        double unit[ICC_MAX_DIM];
        memcpy(unit, x, sizeof unit);
        (void)normalise(dim, unit);
        return least_product(dim, s->n_gradients, s->direction, unit) > LEAST;
    }
    list_normals(s);
    if (find_vector(dim, s->n_gradients + s->n_normals, s->direction, x))
        return true;
    *agrees = false;
    if (s->n_normals > 0 && !gradients_first) {
        const double *normals = s->direction + (size_t)dim * s->n_gradients;
        double uphill[ICC_MAX_DIM] = {0};
        (void)find_vector(dim, s->n_gradients, s->direction, uphill);
        if (find_vector(dim, s->n_normals, normals, x)) {
            tilt_uphill(dim, s->n_normals, normals, uphill, x);
            return least_product(dim, s->n_gradients, s->direction, x) > LEAST;
        }
    }
    return find_vector(dim, s->n_gradients, s->direction, x);
}

typedef struct work {
    iccp_vectors *vectors;
    iccp_extension *extension;
    const iccp_incidence *incidence;
    const iccp_orders *orders;
    uint8_t *state;          /* by vertex: bits, defined below */
    iccp_extension original; /* the function before any change; owns only its values */
} work;

enum { DIRTY = 1, FAILS = 2, GRADIENTS_FIRST = 4, SPLIT = 8, CONFLICTS = 16 };

/* Loads the vector of a vertex as corner k of simplex r. */
static void load_vector(const work *w, uint32_t v, int32_t r, int32_t k, double *x)
{
    const int32_t dim = w->orders->dim;
    const float *vector = iccp_vectors_at(w->vectors, v, r, k);
    for (int32_t i = 0; i < dim; ++i)
        x[i] = (double)vector[i];
}

static icc_status star_init(star *s, const work *w)
{
    *s = (star){.extension = w->extension, .incidence = w->incidence, .orders = w->orders};
    s->direction = iccp_alloc(&w->vectors->memory, most_directions(w->orders->dim),
                              (size_t)w->orders->dim * sizeof *s->direction);
    return s->direction != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

static void store_vector(float *vector, int32_t dim, const double *x)
{
    for (int32_t k = 0; k < dim; ++k)
        vector[k] = (float)x[k];
}

/* Chooses the vectors of a vertex with several sectors. Returns true if all are uphill. */
static bool choose_sectors(work *w, star *s, uint32_t v)
{
    const iccp_sectors *sectors = &w->vectors->sectors;
    const int32_t dim = w->orders->dim;
    const size_t entry = iccp_sectors_find(sectors, v);
    const uint32_t end =
        entry + 1 < sectors->n ? sectors->first[entry + 1] : (uint32_t)sectors->n_vectors;
    bool good = true, agrees;
    s->sector = sectors->sector + entry * sectors->n_simplices;
    for (uint32_t i = sectors->first[entry]; i < end; ++i) {
        double x[ICC_MAX_DIM] = {0};
        s->number = (uint8_t)(i - sectors->first[entry]);
        good = choose_vector(s, w->state[v] & GRADIENTS_FIRST, x, &agrees) && good;
        store_vector(sectors->vector + (size_t)dim * i, dim, x);
    }
    s->sector = NULL;
    return good;
}

/* Chooses the vectors of vertices marked DIRTY. Each depends on the function alone and not on
 * other vectors, so chunks may run in any order. */
static icc_status choose_chunk(void *argument, size_t begin, size_t end)
{
    work *w = argument;
    const size_t dim = (size_t)w->orders->dim;
    star s;
    const icc_status status = star_init(&s, w);
    for (size_t v = begin; status == ICC_OK && v < end; ++v) {
        if (!(w->state[v] & DIRTY))
            continue;
        double x[ICC_MAX_DIM] = {0};
        bool good, agrees = true;
        load_star(&s, (uint32_t)v);
        if (w->state[v] & SPLIT) {
            good = choose_sectors(w, &s, (uint32_t)v);
        } else {
            good = choose_vector(&s, w->state[v] & GRADIENTS_FIRST, x, &agrees);
            store_vector(w->vectors->vector + dim * v, (int32_t)dim, x);
        }
        w->state[v] &= GRADIENTS_FIRST | SPLIT;
        w->state[v] |= (uint8_t)((good ? 0 : FAILS) | (agrees ? 0 : CONFLICTS));
    }
    iccp_free(&w->vectors->memory, s.direction);
    return status;
}

static void list_active(const star *s, uint8_t *active)
{
    for (int32_t r = 0; r < s->orders->n; ++r)
        for (int32_t k = 0; k <= s->orders->dim; ++k) {
            uint32_t lowest;
            active[iccp_sector_simplex(s->orders->dim, r, k)] = is_active(s, r, k, &lowest);
        }
}

/* Gives several vectors to outside vertices, between parts of the domain, that no single vector
 * suits. Vertices next to the root keep their radial vector. */
static icc_status split_vertices(work *w)
{
    const icc_grid *grid = w->extension->grid;
    iccp_sectors *sectors = &w->vectors->sectors;
    star s;
    icc_status status = star_init(&s, w);
    uint8_t *active = iccp_alloc(&sectors->memory, 2 * sectors->n_simplices, sizeof *active);
    if (status == ICC_OK && active == NULL)
        status = ICC_ERR_MEMORY;
    for (uint32_t v = 0; status == ICC_OK && v < grid->n_vertices; ++v) {
        double x[ICC_MAX_DIM];
        if (!(w->state[v] & CONFLICTS) || grid->inside[v])
            continue;
        load_star(&s, v);
        if (is_radial(&s, x))
            continue;
        list_active(&s, active);
        uint8_t *sector = active + sectors->n_simplices;
        const int n_sectors = iccp_sectors_split(w->incidence, w->orders, v, active, sector);
        if (n_sectors < 2)
            continue;
        status = iccp_sectors_add(sectors, v, n_sectors, sector);
        w->state[v] |= SPLIT | DIRTY;
        w->vectors->vector[(size_t)grid->dim * v] = ICCP_SEVERAL;
    }
    iccp_free(&sectors->memory, active);
    iccp_free(&sectors->memory, s.direction);
    return status;
}

/* Writes the bounds of the value of a vertex. In general the value may be halved or doubled. An
 * outside vertex joined to inside vertices may have any value whose size is at most their smallest
 * one. Across a gap the function may be smaller by any factor, so a small change on one side may be
 * too large on the other. */
static void find_bounds(const work *w, uint32_t v, int32_t exponent, double *low, double *high)
{
    const icc_grid *grid = w->extension->grid;
    const double own = iccp_extension_get(&w->original, v, exponent);
    *low = iccp_min(0.5 * own, 2 * own);
    *high = iccp_max(0.5 * own, 2 * own);
    if (grid->inside[v])
        return;
    double least = HUGE_VAL;
    for (int set = 1; set < 1 << grid->dim; ++set)
        for (int sign = -1; sign <= 1; sign += 2) {
            const uint32_t u = (uint32_t)((ptrdiff_t)v + sign * w->orders->offset[set]);
            if (grid->inside[u])
                least = iccp_min(least, fabs(iccp_extension_get(&w->original, u, exponent)));
        }
    if (least < HUGE_VAL) {
        *low = -least;
        *high = least;
    }
}

/* Adds a step to the value of a vertex, within its bounds. */
static void move_value(const work *w, uint32_t v, int32_t exponent, double step)
{
    double low, high;
    const double value = iccp_extension_get(w->extension, v, exponent) + step;
    find_bounds(w, v, exponent, &low, &high);
    iccp_extension_set(w->extension, v, iccp_min(iccp_max(value, low), high), exponent);
}

/* Moves the corner values of one simplex, within their bounds, until the gradient's product with
 * x is AIM times its length. The root's value, the largest, stays. The product is a weighted sum
 * of the values. Each weight is the component of x along the axis before the corner minus the
 * one along the axis after it. */
static bool project_values(const work *w, const star *s, int32_t r, uint32_t lowest,
                           const double *x, const double *gradient)
{
    const int8_t *axis = w->orders->axis[r];
    const int32_t dim = w->orders->dim;
    const double length = iccp_vec_norm((size_t)dim, gradient);
    const double lack = AIM * length - iccp_vec_dot((size_t)dim, gradient, x);
    if (!(lack > 0))
        return false;
    double part[ICC_MAX_DIM + 1], norm2 = 0;
    uint32_t corner = lowest;
    for (int32_t j = 0; j <= dim; ++j) {
        part[j] = (j > 0 ? x[axis[j - 1]] : 0) - (j < dim ? x[axis[j]] : 0);
        part[j] = corner == w->extension->root ? 0 : part[j];
        norm2 += part[j] * part[j];
        corner += j < dim ? (uint32_t)w->extension->grid->stride[axis[j]] : 0;
    }
    corner = lowest;
    for (int32_t j = 0; j <= dim && norm2 > 0; ++j) {
        if (part[j] < 0 || part[j] > 0)
            move_value(w, corner, s->exponent, 1.0001 * lack * part[j] / norm2);
        corner += j < dim ? (uint32_t)w->extension->grid->stride[axis[j]] : 0;
    }
    return norm2 > 0;
}

/* Marks all vertices around v to be examined again. */
static void mark_dirty(const work *w, uint32_t v)
{
    const icc_grid *grid = w->extension->grid;
    size_t n = 1;
    for (int32_t k = 0; k < grid->dim; ++k)
        n *= 5;
    for (size_t i = 0; i < n; ++i) {
        ptrdiff_t u = (ptrdiff_t)v;
        size_t rest = i;
        for (int32_t k = 0; k < grid->dim; ++k, rest /= 5)
            u += ((ptrdiff_t)(rest % 5) - 2) * (ptrdiff_t)grid->stride[k];
        if (u >= 0 && (size_t)u < grid->n_vertices && w->extension->needed[u])
            w->state[u] |= DIRTY;
    }
}

/* Projects the function, simplex by simplex, onto the values for which the vertex's vector is
 * uphill. One projection may spoil another, so the caller repeats. */
static void adjust_values(work *w, star *s, uint32_t v)
{
    const int32_t dim = w->orders->dim;
    double x[ICC_MAX_DIM], gradient[ICC_MAX_DIM];
    for (int32_t r = 0; r < w->orders->n; ++r)
        for (int32_t k = 0; k <= dim; ++k) {
            uint32_t lowest;
            load_star(s, v);
            if (!is_active(s, r, k, &lowest))
                continue;
            load_vector(w, v, r, k, x);
            gradient_of(s, r, k, gradient);
            if (normalise(dim, x))
                w->vectors->n_adjusted += project_values(w, s, r, lowest, x, gradient);
        }
    mark_dirty(w, v);
}

static icc_status choose_all(work *w, const iccp_env *env)
{
    const icc_status status =
        iccp_for_chunks(env, "solve", w->extension->grid->n_vertices, GRAIN, choose_chunk, w);
    w->vectors->n_infeasible = 0;
    for (size_t v = 0; v < w->extension->grid->n_vertices; ++v)
        w->vectors->n_infeasible += (w->state[v] & FAILS) != 0;
    return status;
}

/* Alternates between adjusting the function and choosing vectors until all are uphill. From
 * FIRM_ROUNDS on, vertices that still fail ignore the normals. */
static icc_status adjust_all(work *w, const iccp_env *env)
{
    star s;
    icc_status status = star_init(&s, w);
    for (int round = 0; status == ICC_OK && w->vectors->n_infeasible > 0 && round < MOST_ROUNDS;
         ++round) {
        for (size_t v = 0; v < w->extension->grid->n_vertices; ++v)
            if (w->state[v] & FAILS) {
                w->state[v] |= round >= FIRM_ROUNDS ? GRADIENTS_FIRST : 0;
                adjust_values(w, &s, (uint32_t)v);
            }
        const iccp_env part = iccp_round(env, (size_t)round, TYPICAL_ROUNDS);
        status = choose_all(w, &part);
    }
    iccp_free(&w->vectors->memory, s.direction);
    return status;
}

/* Counts the facets at a vertex, or at one sector of it, and those that its vector does not
 * cross inward. */
static void count_contacts(work *w, const star *s, const float *vector)
{
    const size_t dim = (size_t)w->orders->dim;
    double x[ICC_MAX_DIM];
    for (size_t k = 0; k < dim; ++k)
        x[k] = (double)vector[k];
    for (uint32_t i = w->incidence->first[s->vertex]; i < w->incidence->first[s->vertex + 1]; ++i) {
        const uint32_t facet = w->incidence->facet[i];
        if (!is_in_sector(s, facet))
            continue;
        ++w->vectors->n_contacts;
        w->vectors->n_not_inward += !(iccp_vec_dot(dim, w->incidence->normal + dim * facet, x) > 0);
    }
}

/* The boundary is crossed one way if the vectors point inward at the corners of all simplices
 * that it runs through. */
static icc_status check_inward(work *w)
{
    const iccp_sectors *sectors = &w->vectors->sectors;
    const size_t dim = (size_t)w->orders->dim;
    star s;
    const icc_status status = star_init(&s, w);
    size_t entry = 0;
    for (uint32_t v = 0; status == ICC_OK && v < w->extension->grid->n_vertices; ++v) {
        s.vertex = v;
        s.sector = NULL;
        if (!(w->state[v] & SPLIT)) {
            count_contacts(w, &s, w->vectors->vector + dim * v);
            continue;
        }
        const size_t end = entry + 1 < sectors->n ? sectors->first[entry + 1] : sectors->n_vectors;
        load_star(&s, v);
        s.sector = sectors->sector + sectors->n_simplices * entry;
        for (size_t i = sectors->first[entry]; i < end; ++i) {
            s.number = (uint8_t)(i - sectors->first[entry]);
            count_contacts(w, &s, sectors->vector + dim * i);
        }
        ++entry;
    }
    iccp_free(&w->vectors->memory, s.direction);
    return status;
}

/* Chooses one vector for each vertex, and several where one does not suit. Where that is not
 * enough, it adjusts the function. */
static icc_status find_vectors(work *w, const iccp_env *env)
{
    const icc_grid *grid = w->extension->grid;
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        w->state[v] = w->extension->needed[v] && v != w->extension->root ? DIRTY : 0;
        w->vectors->n_vertices += w->state[v];
    }
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){4, 1, 3}, env);
    icc_status status = choose_all(w, &part[0]);
    if (status == ICC_OK)
        status = split_vertices(w);
    if (status == ICC_OK)
        status = choose_all(w, &part[1]);
    if (status == ICC_OK)
        status = adjust_all(w, &part[2]);
    return status == ICC_OK ? check_inward(w) : status;
}

static bool copy_values(iccp_extension *copy, const iccp_extension *extension)
{
    const size_t n = extension->grid->n_vertices;
    *copy = *extension;
    copy->value = iccp_alloc(&extension->memory, n, sizeof *copy->value);
    if (extension->exponent != NULL)
        copy->exponent = iccp_alloc(&extension->memory, n, sizeof *copy->exponent);
    if (copy->value == NULL || (extension->exponent != NULL && copy->exponent == NULL))
        return false;
    memcpy(copy->value, extension->value, n * sizeof *copy->value);
    if (extension->exponent != NULL)
        memcpy(copy->exponent, extension->exponent, n * sizeof *copy->exponent);
    return true;
}

icc_status iccp_vectors_create(iccp_vectors *vectors, iccp_extension *extension,
                               const iccp_incidence *incidence, const iccp_env *env)
{
    const icc_grid *grid = extension->grid;
    *vectors = (iccp_vectors){.memory = env->memory, .grid = grid};
    iccp_sectors_init(&vectors->sectors, grid->dim, &env->memory);
    work w = {.vectors = vectors, .extension = extension, .incidence = incidence};
    iccp_orders *orders = iccp_alloc(&env->memory, 1, sizeof *orders);
    w.orders = orders;
    w.state = iccp_alloc(&env->memory, grid->n_vertices, sizeof *w.state);
    const bool copied = copy_values(&w.original, extension);
    vectors->vector = iccp_alloc_zero(&env->memory, grid->n_vertices,
                                      (size_t)grid->dim * sizeof *vectors->vector);
    icc_status status = ICC_ERR_MEMORY;
    if (orders != NULL && w.state != NULL && copied && vectors->vector != NULL) {
        iccp_orders_init(orders, grid);
        status = find_vectors(&w, env);
    }
    iccp_free(&env->memory, orders);
    iccp_free(&env->memory, w.state);
    iccp_free(&env->memory, w.original.value);
    iccp_free(&env->memory, w.original.exponent);
    return status;
}

void iccp_vectors_free(iccp_vectors *vectors)
{
    iccp_free(&vectors->memory, vectors->vector);
    iccp_sectors_free(&vectors->sectors);
    *vectors = (iccp_vectors){.memory = vectors->memory, .sectors = vectors->sectors};
}
