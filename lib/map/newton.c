/* Projected Newton with a line search that stops before a triangle flips: J. Smith, S. Schaefer,
 * Bijective parameterization with free boundaries, 2015. */
#include "map/newton.h"

#include <math.h>
#include <string.h>

#define NONE ICCP_NO_NEIGHBOUR

static const uint32_t PAIRS[6][2] = {{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}};

/* Of the way to the first flip. */
static const double SHARE_OF_FLIP = 0.9;

/* Sufficient decrease (Armijo), and how often a step is halved. */
static const double DECREASE = 1e-4;
enum { MAX_HALVINGS = 40 };

/* Added to the diagonal, relative to its mean: where negative curvature was left out the Hessian may be
 * singular. */
static const double SHIFT = 1e-10;

/* ---- set-up ---- */

static uint32_t slot_of(const iccp_newton *s, const iccp_plmap *map, uint32_t triangle, uint32_t k)
{
    return s->slot[map->corners.vertex[3 * (size_t)triangle + k]];
}

static icc_status list_parts(iccp_newton *s, const iccp_plmap *map, const uint8_t *movable)
{
    const size_t n_triangles = map->corners.n_triangles;
    s->slot = iccp_alloc(&s->memory, map->n_vertices, sizeof *s->slot);
    s->free_vertex = iccp_alloc(&s->memory, map->n_vertices, sizeof *s->free_vertex);
    s->triangle = iccp_alloc(&s->memory, n_triangles, sizeof *s->triangle);
    if (s->slot == NULL || s->free_vertex == NULL || s->triangle == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < map->n_vertices; ++v) {
        s->slot[v] = NONE;
        if (!map->fixed[v] && (movable == NULL || movable[v])) {
            s->slot[v] = (uint32_t)s->n_free;
            s->free_vertex[s->n_free++] = v;
        }
    }
    for (uint32_t t = 0; t < n_triangles; ++t)
        if (slot_of(s, map, t, 0) != NONE || slot_of(s, map, t, 1) != NONE ||
            slot_of(s, map, t, 2) != NONE)
            s->triangle[s->n_elements++] = t;
    return ICC_OK;
}

/* Neighbours of each free vertex among the free ones, each once; `room` says where its list begins. */
static void list_neighbours(iccp_newton *s, const iccp_plmap *map, const size_t *room,
                            uint32_t *degree, uint32_t *list)
{
    memset(degree, 0, s->n_free * sizeof *degree);
    for (size_t e = 0; e < s->n_elements; ++e)
        for (int p = 0; p < 6; ++p) {
            const uint32_t a = slot_of(s, map, s->triangle[e], PAIRS[p][0]);
            const uint32_t b = slot_of(s, map, s->triangle[e], PAIRS[p][1]);
            s->neighbour[6 * e + (size_t)p] = NONE;
            if (a == NONE || b == NONE)
                continue;
            uint32_t *own = list + room[a], k = 0;
            while (k < degree[a] && own[k] != b)
                ++k;
            if (k == degree[a])
                own[degree[a]++] = b;
            s->neighbour[6 * e + (size_t)p] = k;
        }
}

/* Row 2 i holds the entry beside the diagonal, 2 i + 1, then two columns for every neighbour; row
 * 2 i + 1 likewise. */
static icc_status build_pattern(iccp_newton *s, const uint32_t *degree, const size_t *room,
                                const uint32_t *list)
{
    size_t n_entries = 0;
    for (size_t i = 0; i < s->n_free; ++i)
        for (size_t d = 0; d < 2; ++d) {
            s->first[2 * i + d] = n_entries;
            n_entries += 1 + 2 * (size_t)degree[i];
        }
    s->first[2 * s->n_free] = n_entries;
    s->column = iccp_alloc(&s->memory, n_entries, sizeof *s->column);
    s->value = iccp_alloc(&s->memory, n_entries, sizeof *s->value);
    if (s->column == NULL || s->value == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t i = 0; i < s->n_free; ++i)
        for (uint32_t d = 0; d < 2; ++d) {
            uint32_t *column = s->column + s->first[2 * i + d];
            *column++ = 2 * i + 1 - d;
            for (uint32_t k = 0; k < degree[i]; ++k) {
                *column++ = 2 * list[room[i] + k];
                *column++ = 2 * list[room[i] + k] + 1;
            }
        }
    return ICC_OK;
}

static icc_status find_pattern(iccp_newton *s, const iccp_plmap *map)
{
    size_t *room = iccp_alloc_zero(&s->memory, s->n_free + 1, sizeof *room);
    uint32_t *degree = iccp_alloc(&s->memory, s->n_free, sizeof *degree);
    uint32_t *list = iccp_alloc(&s->memory, 6 * s->n_elements, sizeof *list);
    icc_status status = ICC_ERR_MEMORY;
    if (room != NULL && degree != NULL && list != NULL) {
        for (size_t e = 0; e < s->n_elements; ++e)
            for (uint32_t k = 0; k < 3; ++k)
                if (slot_of(s, map, s->triangle[e], k) != NONE)
                    room[slot_of(s, map, s->triangle[e], k) + 1] += 2;
        for (size_t i = 0; i < s->n_free; ++i)
            room[i + 1] += room[i];
        list_neighbours(s, map, room, degree, list);
        status = build_pattern(s, degree, room, list);
    }
    iccp_free(&s->memory, room);
    iccp_free(&s->memory, degree);
    iccp_free(&s->memory, list);
    return status;
}

static icc_status allocate(iccp_newton *s)
{
    const size_t n = 2 * s->n_free;
    s->element = iccp_alloc(&s->memory, s->n_elements, sizeof *s->element);
    s->neighbour = iccp_alloc(&s->memory, s->n_elements, 6 * sizeof *s->neighbour);
    s->first = iccp_alloc(&s->memory, n + 1, sizeof *s->first);
    s->diagonal = iccp_alloc(&s->memory, n, sizeof *s->diagonal);
    s->gradient = iccp_alloc(&s->memory, n, sizeof *s->gradient);
    s->step = iccp_alloc(&s->memory, n, sizeof *s->step);
    s->saved = iccp_alloc(&s->memory, n, sizeof *s->saved);
    s->work = iccp_alloc(&s->memory, n, sizeof *s->work);
    return s->element != NULL && s->neighbour != NULL && s->first != NULL && s->diagonal != NULL &&
                   s->gradient != NULL && s->step != NULL && s->saved != NULL && s->work != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static iccp_symmetric hessian_of(const iccp_newton *s)
{
    return (iccp_symmetric){2 * s->n_free, s->first, s->column, s->value, s->diagonal};
}

icc_status iccp_newton_create(iccp_newton *newton, const iccp_plmap *map, const uint8_t *movable,
                              const iccp_env *env)
{
    iccp_newton *s = newton;
    *s = (iccp_newton){.memory = env->memory};
    icc_status status = list_parts(s, map, movable);
    if (status == ICC_OK)
        status = allocate(s);
    if (status == ICC_OK)
        status = find_pattern(s, map);
    if (status == ICC_OK) {
        for (size_t e = 0; e < s->n_elements; ++e)
            iccp_plmap_element(map, s->triangle[e], &s->element[e]);
        const iccp_symmetric hessian = hessian_of(s);
        status = iccp_ldlt_analyse(&s->factor, &hessian, 2, env);
    }
    if (status != ICC_OK)
        iccp_newton_free(s);
    return status;
}

void iccp_newton_free(iccp_newton *newton)
{
    iccp_newton *s = newton;
    iccp_free(&s->memory, s->free_vertex);
    iccp_free(&s->memory, s->slot);
    iccp_free(&s->memory, s->triangle);
    iccp_free(&s->memory, s->element);
    iccp_free(&s->memory, s->neighbour);
    iccp_free(&s->memory, s->first);
    iccp_free(&s->memory, s->column);
    iccp_free(&s->memory, s->value);
    iccp_free(&s->memory, s->diagonal);
    iccp_free(&s->memory, s->gradient);
    iccp_free(&s->memory, s->step);
    iccp_free(&s->memory, s->saved);
    iccp_free(&s->memory, s->work);
    iccp_ldlt_free(&s->factor);
    *s = (iccp_newton){.memory = s->memory};
}

/* ---- one step ---- */

static void corner_images(const iccp_plmap *map, uint32_t triangle, const double *image[3])
{
    for (uint32_t k = 0; k < 3; ++k)
        image[k] = iccp_plmap_image(map, 3 * triangle + k);
}

double iccp_newton_energy(const iccp_newton *newton, const iccp_plmap *map, iccp_energy energy,
                          double epsilon)
{
    double sum = 0;
    for (size_t e = 0; e < newton->n_elements && sum < HUGE_VAL; ++e) {
        const double *image[3];
        corner_images(map, newton->triangle[e], image);
        sum += energy == ICCP_UNTANGLE ? iccp_untangle_energy(&newton->element[e], image, epsilon)
                                       : iccp_dirichlet_energy(&newton->element[e], image);
    }
    return sum;
}

static void add_element(iccp_newton *s, const iccp_plmap *map, size_t e, const iccp_local *local)
{
    for (uint32_t a = 0; a < 3; ++a) {
        const uint32_t i = slot_of(s, map, s->triangle[e], a);
        if (i == NONE)
            continue;
        for (uint32_t d = 0; d < 2; ++d) {
            s->gradient[2 * i + d] += local->gradient[2 * a + d];
            s->diagonal[2 * i + d] += local->hessian[2 * a + d][2 * a + d];
            s->value[s->first[2 * i + d]] += local->hessian[2 * a + d][2 * a + 1 - d];
        }
    }
    for (int p = 0; p < 6; ++p) {
        const uint32_t k = s->neighbour[6 * e + (size_t)p];
        if (k == NONE)
            continue;
        const uint32_t a = PAIRS[p][0], b = PAIRS[p][1];
        const uint32_t i = slot_of(s, map, s->triangle[e], a);
        for (uint32_t d = 0; d < 2; ++d) {
            double *value = s->value + s->first[2 * i + d] + 1 + 2 * (size_t)k;
            value[0] += local->hessian[2 * a + d][2 * b];
            value[1] += local->hessian[2 * a + d][2 * b + 1];
        }
    }
}

static void assemble(iccp_newton *s, const iccp_plmap *map, iccp_energy energy, double epsilon)
{
    const size_t n = 2 * s->n_free;
    double sum = 0;
    memset(s->gradient, 0, n * sizeof *s->gradient);
    memset(s->diagonal, 0, n * sizeof *s->diagonal);
    memset(s->value, 0, s->first[n] * sizeof *s->value);
    for (size_t e = 0; e < s->n_elements; ++e) {
        const double *image[3];
        iccp_local local;
        corner_images(map, s->triangle[e], image);
        if (energy == ICCP_UNTANGLE)
            iccp_untangle_local(&s->element[e], image, epsilon, &local);
        else
            iccp_dirichlet_local(&s->element[e], image, energy == ICCP_DIRICHLET_MAJORISED, &local);
        add_element(s, map, e, &local);
    }
    for (size_t i = 0; i < n; ++i)
        sum += s->diagonal[i];
    for (size_t i = 0; i < n; ++i)
        s->diagonal[i] += SHIFT * sum / (double)n;
}

icc_status iccp_newton_solve(iccp_newton *newton, const iccp_plmap *map, iccp_energy energy,
                             double epsilon, double *slope, const iccp_env *env)
{
    iccp_newton *s = newton;
    const size_t n = 2 * s->n_free;
    assemble(s, map, energy, epsilon);
    const iccp_symmetric hessian = hessian_of(s);
    const icc_status status = iccp_ldlt_factorise(&s->factor, &hessian, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < n; ++i)
        s->step[i] = -s->gradient[i];
    iccp_ldlt_solve(&s->factor, 1, s->step, s->work);
    *slope = 0;
    for (size_t i = 0; i < n; ++i)
        *slope += s->gradient[i] * s->step[i];
    return *slope <= 0 ? ICC_OK : ICC_ERR_SOLVER;
}

/* The smallest positive root of det(t) = a + b t + c t^2, where a > 0; infinite when there is none. */
static double first_root(double a, double b, double c)
{
    if (fabs(c) <= 1e-300)
        return b < 0 ? -a / b : HUGE_VAL;
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return HUGE_VAL;
    const double q = -0.5 * (b + copysign(sqrt(discriminant), b));
    const double r0 = q / c, r1 = fabs(q) > 0 ? a / q : HUGE_VAL;
    const double low = fmin(r0, r1), high = fmax(r0, r1);
    return low > 0 ? low : high > 0 ? high : HUGE_VAL;
}

static void corner_step(const iccp_newton *s, const iccp_plmap *map, uint32_t triangle, uint32_t k,
                        double step[2])
{
    const uint32_t i = slot_of(s, map, triangle, k);
    step[0] = i == NONE ? 0 : s->step[2 * i];
    step[1] = i == NONE ? 0 : s->step[2 * i + 1];
}

/* How far the step can go before the first triangle loses its area. */
static double flip_limit(const iccp_newton *s, const iccp_plmap *map)
{
    double limit = HUGE_VAL;
    for (size_t e = 0; e < s->n_elements; ++e) {
        const double *p[3];
        double d[3][2];
        corner_images(map, s->triangle[e], p);
        for (uint32_t k = 0; k < 3; ++k)
            corner_step(s, map, s->triangle[e], k, d[k]);
        const double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1];
        const double vx = p[2][0] - p[0][0], vy = p[2][1] - p[0][1];
        const double dux = d[1][0] - d[0][0], duy = d[1][1] - d[0][1];
        const double dvx = d[2][0] - d[0][0], dvy = d[2][1] - d[0][1];
        limit = fmin(limit, first_root(ux * vy - uy * vx, ux * dvy + dux * vy - uy * dvx - duy * vx,
                                       dux * dvy - duy * dvx));
    }
    return limit;
}

static void go(iccp_newton *s, iccp_plmap *map, double length)
{
    for (size_t i = 0; i < s->n_free; ++i)
        for (size_t d = 0; d < 2; ++d)
            map->images[2 * (size_t)s->free_vertex[i] + d] =
                s->saved[2 * i + d] + length * s->step[2 * i + d];
}

static bool all_positive(const iccp_newton *s, const iccp_plmap *map)
{
    for (size_t e = 0; e < s->n_elements; ++e)
        if (!iccp_plmap_positive_image(map, s->triangle[e]))
            return false;
    return true;
}

double iccp_newton_move(iccp_newton *newton, iccp_plmap *map, iccp_energy energy, double epsilon,
                        double before, double slope)
{
    iccp_newton *s = newton;
    const bool guarded = energy != ICCP_UNTANGLE;
    double length = guarded ? fmin(1, SHARE_OF_FLIP * flip_limit(s, map)) : 1;
    for (size_t i = 0; i < s->n_free; ++i)
        memcpy(s->saved + 2 * i, map->images + 2 * (size_t)s->free_vertex[i], 2 * sizeof(double));
    for (int k = 0; k < MAX_HALVINGS; ++k, length *= 0.5) {
        go(s, map, length);
        const double after = iccp_newton_energy(s, map, energy, epsilon);
        if (after <= before + DECREASE * length * slope && (!guarded || all_positive(s, map)))
            return after;
    }
    go(s, map, 0);
    return before;
}
