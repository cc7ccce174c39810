/* Projected Newton with a line search that stops before a triangle flips: J. Smith, S. Schaefer,
 * Bijective parameterization with free boundaries, 2015; J. Nocedal, S. Wright, Numerical
 * Optimization, section 3.1. Steps are solved for by factors in the plane and by conjugate
 * gradients in space. */
#include "map/newton.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "map/dirichlet.h"
#include "map/truncated_cg.h"
#include "map/untangling.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/* Of the way to the first flip. */
static const double SHARE_OF_FLIP = 0.9;

/* Sufficient decrease (Armijo); by how much a step is shortened, and how often. In space, where
 * nobody knows beforehand how far it is to the first flip, by less. */
static const double DECREASE = 1e-4, SHORTER = 0.5, SHORTER_IN_SPACE = 0.7;
enum { MAX_CUTS = 40, MAX_CUTS_IN_SPACE = 60 };

/* Conjugate gradients end at this residual; at the second one where one simplex has more than this
 * SHARE of the energy, so that the step is nearly all about it. */
static const double RESIDUAL = 1e-2, FINE_RESIDUAL = 1e-3, SHARE = 0.5;

/* In space, the share of a motion that is looked at first, and how it is shortened. */
static const double FARTHEST = 2, CLOSER = 0.9;

/* In space, where a step of 1 lowers the energy by this share, longer ones are tried. */
static const double LARGE_FALL = 0.3;

/* Elements that a thread takes at once, and rows of a part of the assembly; in space, elements
 * whose gradients and Hessians wait to be summed, and that a thread takes of these. */
enum { GRAIN = 1024, PART_ROWS = 1024, WAITING = 1024, FEW = 64 };

/* ---- set-up ---- */

struct iccp_newton_plan {
    iccp_memory memory;
    atomic_size_t references;
    iccp_assembly assembly; /* without sums */
    iccp_ldlt factor;       /* without numbers */
    size_t n_points, n_simplices;
    uint32_t *corners; /* the mesh that it is for */
};

/* Without threads parts would only cost. */
static icc_status analyse(iccp_assembly *assembly, iccp_ldlt *factor, const iccp_env *env)
{
    const iccp_symmetric hessian = iccp_assembly_hessian(assembly);
    const size_t n_parts = iccp_has_threads(env) ? hessian.n / PART_ROWS + 1 : 1;
    const icc_status status = iccp_ldlt_analyse(factor, &hessian, 2, env);
    return status == ICC_OK ? iccp_assembly_divide(assembly, factor->position, n_parts, env)
                            : status;
}

icc_status iccp_newton_plan_create(iccp_newton_plan **out, const iccp_simplicial_map *map,
                                   const iccp_env *env)
{
    iccp_newton_plan *plan = *out = iccp_alloc_zero(&env->memory, 1, sizeof *plan);
    if (plan == NULL)
        return ICC_ERR_MEMORY;
    const size_t n_corners = 3 * map->n_simplices;
    plan->memory = plan->assembly.memory = plan->factor.memory = env->memory;
    atomic_init(&plan->references, 1);
    plan->n_points = map->n_points;
    plan->n_simplices = map->n_simplices;
    plan->corners = iccp_alloc(&env->memory, n_corners, sizeof *plan->corners);
    icc_status status = plan->corners != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        memcpy(plan->corners, map->corners, n_corners * sizeof *plan->corners);
        status = iccp_assembly_create(&plan->assembly, map, NULL, env);
    }
    if (status == ICC_OK) {
        iccp_assembly_drop_sums(&plan->assembly);
        status = analyse(&plan->assembly, &plan->factor, env);
    }
    if (status != ICC_OK) {
        iccp_newton_plan_release(plan);
        *out = NULL;
    }
    return status;
}

iccp_newton_plan *iccp_newton_plan_retain(iccp_newton_plan *plan)
{
    if (plan != NULL)
        atomic_fetch_add(&plan->references, 1);
    return plan;
}

void iccp_newton_plan_release(iccp_newton_plan *plan)
{
    if (plan == NULL || atomic_fetch_sub(&plan->references, 1) != 1)
        return;
    iccp_assembly_free(&plan->assembly);
    iccp_ldlt_free(&plan->factor);
    const iccp_memory memory = plan->memory;
    iccp_free(&memory, plan->corners);
    iccp_free(&memory, plan);
}

bool iccp_newton_plan_fits(const iccp_newton_plan *plan, const iccp_simplicial_map *map)
{
    if (map->dim != 2 || plan->n_points != map->n_points || plan->n_simplices != map->n_simplices ||
        memcmp(plan->corners, map->corners, 3 * map->n_simplices * sizeof *plan->corners) != 0)
        return false;
    bool fits = true;
    for (uint32_t v = 0; v < map->n_points; ++v)
        fits &= iccp_simplicial_is_fixed(map, v) == (plan->assembly.slot[v] == UINT32_MAX);
    return fits;
}

static icc_status find_elements(void *argument, size_t begin, size_t end)
{
    const iccp_newton *s = argument;
    const size_t size = ICCP_ELEMENT(s->map.dim);
    for (size_t e = begin; e < end; ++e)
        iccp_simplicial_element(&s->map, s->assembly.simplex[e], s->element + size * e);
    return ICC_OK;
}

icc_status iccp_newton_create(iccp_newton *newton, const iccp_simplicial_map *map,
                              const uint8_t *movable, const iccp_env *env)
{
    iccp_newton *s = newton;
    *s = (iccp_newton){.map = *map, .threads = *env};
    s->threads.progress = NULL;
    const iccp_newton_plan *plan = map->plan;
    if (plan != NULL && (movable != NULL || !iccp_newton_plan_fits(plan, map)))
        plan = NULL;
    icc_status status = plan != NULL
                            ? iccp_assembly_share(&s->assembly, &plan->assembly, map, &env->memory)
                            : iccp_assembly_create(&s->assembly, map, movable, env);
    if (status != ICC_OK)
        return status;
    const iccp_memory *memory = &s->assembly.memory;
    const size_t n = map->dim * s->assembly.n_free, size = ICCP_ELEMENT(map->dim);
    const size_t n_work = map->dim == 2 ? 1 : ICCP_TRUNCATED_CG_WORK;
    s->factor.memory = env->memory;
    s->element = iccp_alloc(memory, s->assembly.n_elements, size * sizeof *s->element);
    s->step = iccp_alloc(memory, n, sizeof *s->step);
    s->saved = iccp_alloc(memory, n, sizeof *s->saved);
    s->work = iccp_alloc(memory, n, n_work * sizeof *s->work);
    const bool has_terms = map->dim == 3 || iccp_has_threads(env);
    const bool has_locals = map->dim == 3 && iccp_has_threads(env);
    if (has_terms)
        s->term = iccp_alloc(memory, s->assembly.n_elements, sizeof *s->term);
    if (has_locals)
        s->local = iccp_alloc(memory, WAITING, sizeof *s->local);
    if (s->element == NULL || s->step == NULL || s->saved == NULL || s->work == NULL ||
        (has_terms && s->term == NULL) || (has_locals && s->local == NULL))
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_for_chunks(&s->threads, "improve", s->assembly.n_elements, GRAIN,
                                 find_elements, s);
    if (status == ICC_OK && plan != NULL)
        iccp_ldlt_share(&s->factor, &plan->factor, &env->memory);
    else if (status == ICC_OK && map->dim == 2)
        status = analyse(&s->assembly, &s->factor, env);
    if (status != ICC_OK)
        iccp_newton_free(s);
    return status;
}

void iccp_newton_free(iccp_newton *newton)
{
    iccp_newton *s = newton;
    const iccp_memory memory = s->assembly.memory;
    iccp_free(&memory, s->element);
    iccp_free(&memory, s->step);
    iccp_free(&memory, s->saved);
    iccp_free(&memory, s->work);
    iccp_free(&memory, s->term);
    iccp_free(&memory, s->local);
    iccp_ldlt_free(&s->factor);
    iccp_assembly_free(&s->assembly);
    *s = (iccp_newton){.assembly.memory = memory};
}

/* ---- sums over the elements ---- */

static ICCP_INLINE const double *corner_images(size_t dim, const iccp_newton *s, size_t e,
                                               const double **image)
{
    iccp_simplicial_images(dim, &s->map, s->assembly.simplex[e], image);
    return s->element + ICCP_ELEMENT(dim) * e;
}

/* A loop over the elements, or over the parts of the assembly. */
typedef struct loop {
    iccp_newton *s;
    iccp_energy energy;
    double epsilon;
    size_t first; /* of the elements that wait */
} loop;

/* On all threads. Chunks do not fail, and a loop without progress cannot be stopped. */
static void run(const iccp_newton *s, size_t n, size_t grain, iccp_chunk chunk, void *argument)
{
    (void)iccp_for_chunks(&s->threads, "improve", n, grain, chunk, argument);
}

static ICCP_INLINE double energy_of(size_t dim, const iccp_newton *s, size_t e, iccp_energy energy,
                                    double epsilon)
{
    const double *image[4], *element = corner_images(dim, s, e, image);
    return energy == ICCP_UNTANGLE ? iccp_untangling_energy(dim, element, image, epsilon)
                                   : iccp_dirichlet_energy(dim, element, image);
}

static icc_status find_terms(void *argument, size_t begin, size_t end)
{
    const loop *l = argument;
    for (size_t e = begin; e < end; ++e)
        l->s->term[e] = l->s->map.dim == 2 ? energy_of(2, l->s, e, l->energy, l->epsilon)
                                           : energy_of(3, l->s, e, l->energy, l->epsilon);
    return ICC_OK;
}

/* With threads the terms are found first; their sum has one order. */
static ICCP_INLINE double sum_energy(size_t dim, const iccp_newton *s, iccp_energy energy,
                                     double epsilon)
{
    const size_t n = s->assembly.n_elements;
    const bool found = iccp_has_threads(&s->threads) && n > GRAIN;
    double sum = 0;
    if (found)
        run(s, n, GRAIN, find_terms, &(loop){(iccp_newton *)s, energy, epsilon, 0});
    for (size_t e = 0; e < n && sum < HUGE_VAL; ++e)
        sum += found ? s->term[e] : energy_of(dim, s, e, energy, epsilon);
    return sum;
}

double iccp_newton_energy(const iccp_newton *newton, iccp_energy energy, double epsilon)
{
    return newton->map.dim == 2 ? sum_energy(2, newton, energy, epsilon)
                                : sum_energy(3, newton, energy, epsilon);
}

static ICCP_INLINE double find_least(size_t dim, const iccp_newton *s, size_t *n_bad)
{
    double least = HUGE_VAL, j[9];
    *n_bad = 0;
    for (size_t e = 0; e < s->assembly.n_elements; ++e) {
        const double *image[4], *element = corner_images(dim, s, e, image);
        const double det = iccp_element_jacobian(dim, element, image, j);
        least = iccp_min(least, det);
        *n_bad += det <= 0;
    }
    return least;
}

double iccp_newton_least(const iccp_newton *newton, size_t *n_bad)
{
    return newton->map.dim == 2 ? find_least(2, newton, n_bad) : find_least(3, newton, n_bad);
}

static void find_local(const loop *l, size_t e, iccp_local *local)
{
    const size_t dim = l->s->map.dim;
    const double *image[4], *element = corner_images(dim, l->s, e, image);
    if (l->energy == ICCP_UNTANGLE)
        iccp_untangling_local(dim, element, image, l->epsilon, local);
    else
        iccp_dirichlet_local(dim, element, image, l->energy == ICCP_DIRICHLET_MAJORISED, local);
}

/* In the plane, and not while it is untangled, several side by side. */
static void find_some(const loop *l, size_t n, const size_t *e, iccp_local *local)
{
    iccp_dirichlet_batch batch;
    if (l->s->map.dim == 3 || l->energy == ICCP_UNTANGLE) {
        for (size_t i = 0; i < n; ++i)
            find_local(l, e[i], &local[i]);
        return;
    }
    for (size_t i = 0; i < ICCP_DIRICHLET_LANES; ++i) {
        const double *image[3];
        batch.element[i] = corner_images(2, l->s, e[i < n ? i : 0], image);
        for (size_t k = 0; k < 3; ++k)
            batch.image[k][i] = image[k];
    }
    iccp_dirichlet_locals(iccp_simd(), &batch, l->energy == ICCP_DIRICHLET_MAJORISED, local);
}

/* Elements list[begin] .. list[end - 1], or begin .. end - 1. */
static void add_elements(const loop *l, size_t part, const uint32_t *list, size_t begin, size_t end)
{
    iccp_local local[ICCP_DIRICHLET_LANES];
    size_t e[ICCP_DIRICHLET_LANES], n;
    for (size_t k = begin; k < end; k += n) {
        n = end - k < ICCP_DIRICHLET_LANES ? end - k : ICCP_DIRICHLET_LANES;
        for (size_t i = 0; i < n; ++i)
            e[i] = list != NULL ? list[k + i] : k + i;
        find_some(l, n, e, local);
        for (size_t i = 0; i < n; ++i)
            iccp_assembly_add(&l->s->assembly, part, e[i], &local[i]);
    }
}

static icc_status assemble_parts(void *argument, size_t begin, size_t end)
{
    const loop *l = argument;
    const iccp_assembly *a = &l->s->assembly;
    for (size_t part = begin; part < end; ++part)
        add_elements(l, part, a->element, a->first_element[part], a->first_element[part + 1]);
    return ICC_OK;
}

static icc_status find_locals(void *argument, size_t begin, size_t end)
{
    const loop *l = argument;
    for (size_t k = begin; k < end; ++k)
        find_local(l, l->first + k, &l->s->local[k]);
    return ICC_OK;
}

/* In space most elements would be in several parts. What they add takes long to find, and little to
 * sum in order. */
static void assemble_some(loop *l)
{
    const size_t left = l->s->assembly.n_elements - l->first, n = left < WAITING ? left : WAITING;
    run(l->s, n, FEW, find_locals, l);
    for (size_t k = 0; k < n; ++k)
        iccp_assembly_add(&l->s->assembly, ICCP_ALL_PARTS, l->first + k, &l->s->local[k]);
}

static void assemble(iccp_newton *s, iccp_energy energy, double epsilon)
{
    loop l = {s, energy, epsilon, 0};
    iccp_assembly_begin(&s->assembly);
    if (s->local != NULL)
        for (; l.first < s->assembly.n_elements; l.first += WAITING)
            assemble_some(&l);
    else if (s->assembly.n_parts > 1 && iccp_has_threads(&s->threads))
        run(s, s->assembly.n_parts, 1, assemble_parts, &l);
    else
        add_elements(&l, ICCP_ALL_PARTS, NULL, 0, s->assembly.n_elements);
    iccp_assembly_end(&s->assembly);
}

/* ---- the step ---- */

static icc_status solve_directly(iccp_newton *s, const iccp_symmetric *hessian, const iccp_env *env)
{
    const icc_status status = iccp_ldlt_factorise(&s->factor, hessian, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < hessian->n; ++i)
        s->step[i] = -s->assembly.gradient[i];
    iccp_ldlt_solve_at_once(&s->factor, 1, s->step, s->work, &s->threads);
    return ICC_OK;
}

/* Whether one simplex has most of the Dirichlet energy. */
static bool has_worst(const iccp_newton *s)
{
    double sum = 0, most = 0;
    run(s, s->assembly.n_elements, GRAIN, find_terms,
        &(loop){(iccp_newton *)s, ICCP_DIRICHLET, 0, 0});
    for (size_t e = 0; e < s->assembly.n_elements; ++e) {
        sum += s->term[e];
        most = iccp_max(most, s->term[e]);
    }
    return most > SHARE * sum;
}

/* In space. */
static icc_status solve_by_directions(iccp_newton *s, const iccp_symmetric *hessian,
                                      iccp_energy energy, const iccp_env *env)
{
    const bool untangles = energy == ICCP_UNTANGLE, is_fine = !untangles && has_worst(s);
    return iccp_truncated_cg(hessian, s->assembly.gradient, s->step,
                             is_fine ? FINE_RESIDUAL : RESIDUAL, s->work,
                             untangles ? "repair" : "improve", env);
}

icc_status iccp_newton_solve(iccp_newton *newton, iccp_energy energy, double epsilon, double *slope,
                             const iccp_env *env)
{
    iccp_newton *s = newton;
    const double *gradient = s->assembly.gradient;
    assemble(s, energy, epsilon);
    const iccp_symmetric hessian = iccp_assembly_hessian(&s->assembly);
    const icc_status status = s->map.dim == 2 ? solve_directly(s, &hessian, env)
                                              : solve_by_directions(s, &hessian, energy, env);
    if (status != ICC_OK)
        return status;
    *slope = 0;
    for (size_t i = 0; i < hessian.n; ++i)
        *slope += gradient[i] * s->step[i];
    return s->map.dim == 3 || *slope <= 0 ? ICC_OK : ICC_ERR_SOLVER;
}

/* What the motion of an element's fixed corners is felt as by its free ones. */
static void add_pull(iccp_newton *s, size_t e, const double *motion, double *pull)
{
    const size_t dim = s->map.dim, n = dim * (dim + 1);
    const uint32_t *v = s->map.corners + (dim + 1) * (size_t)s->assembly.simplex[e];
    const double *image[4], *element = corner_images(dim, s, e, image);
    double moved[12], most = 0;
    iccp_local local;
    for (size_t k = 0; k <= dim; ++k)
        for (size_t d = 0; d < dim; ++d) {
            const bool is_free = s->assembly.slot[v[k]] != UINT32_MAX;
            moved[dim * k + d] = is_free ? 0 : motion[dim * (size_t)v[k] + d];
            most = iccp_max(most, fabs(moved[dim * k + d]));
        }
    if (!(most > 0))
        return;
    iccp_dirichlet_local(dim, element, image, false, &local);
    for (size_t i = 0; i < n; ++i) {
        const uint32_t slot = s->assembly.slot[v[i / dim]];
        for (size_t k = 0; k < n && slot != UINT32_MAX; ++k)
            pull[dim * (size_t)slot + i % dim] -= local.hessian[n * i + k] * moved[k];
    }
}

/* Copies what there is for free points. */
static void hand_out(const iccp_newton *s, const double *free_points, double *all)
{
    const size_t dim = s->map.dim;
    for (size_t i = 0; i < s->assembly.n_free; ++i)
        memcpy(all + dim * (size_t)s->assembly.free_point[i], free_points + dim * i,
               dim * sizeof *all);
}

/* With one factorisation for both. */
static icc_status answer_and_rest(iccp_newton *s, const iccp_symmetric *hessian, double *motion,
                                  double *rest, const iccp_env *env)
{
    double *const answer[2] = {s->saved, s->step}, *const to[2] = {motion, rest};
    const icc_status status = iccp_ldlt_factorise(&s->factor, hessian, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < hessian->n; ++i)
        s->step[i] = -s->assembly.gradient[i];
    memset(rest, 0, 2 * s->map.n_points * sizeof *rest);
    for (int k = 0; k < 2; ++k) {
        iccp_ldlt_solve(&s->factor, 1, answer[k], s->work);
        hand_out(s, answer[k], to[k]);
    }
    return ICC_OK;
}

icc_status iccp_newton_answer(iccp_newton *newton, double *motion, double *rest,
                              const iccp_env *env)
{
    iccp_newton *s = newton;
    assemble(s, ICCP_DIRICHLET, 0);
    const iccp_symmetric hessian = iccp_assembly_hessian(&s->assembly);
    memset(s->saved, 0, hessian.n * sizeof *s->saved);
    for (size_t e = 0; e < s->assembly.n_elements; ++e)
        add_pull(s, e, motion, s->saved);
    if (s->map.dim == 2)
        return answer_and_rest(s, &hessian, motion, rest, env);
    for (size_t i = 0; i < hessian.n; ++i)
        s->assembly.gradient[i] -= s->saved[i];
    const icc_status status = solve_by_directions(s, &hessian, ICCP_DIRICHLET, env);
    if (status == ICC_OK)
        hand_out(s, s->step, motion);
    return status;
}

/* ---- line search ---- */

/* The smallest positive root of det(t) = a + b t + c t^2, where a > 0; infinite when there is
 * none. */
static double first_root(double a, double b, double c)
{
    if (fabs(c) <= 1e-300)
        return b < 0 ? -a / b : HUGE_VAL;
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < 0)
        return HUGE_VAL;
    const double q = -0.5 * (b + copysign(sqrt(discriminant), b));
    const double r0 = q / c, r1 = fabs(q) > 0 ? a / q : HUGE_VAL;
    const double low = iccp_min(r0, r1), high = iccp_max(r0, r1);
    return low > 0 ? low : high > 0 ? high : HUGE_VAL;
}

/* How far corners can go along d before their triangle loses its area. */
static double flip_along(const double *const p[3], const double d[3][2])
{
    const double ux = p[1][0] - p[0][0], uy = p[1][1] - p[0][1];
    const double vx = p[2][0] - p[0][0], vy = p[2][1] - p[0][1];
    const double dux = d[1][0] - d[0][0], duy = d[1][1] - d[0][1];
    const double dvx = d[2][0] - d[0][0], dvy = d[2][1] - d[0][1];
    return first_root(ux * vy - uy * vx, ux * dvy + dux * vy - uy * dvx - duy * vx,
                      dux * dvy - duy * dvx);
}

static double flip_of(const iccp_newton *s, size_t e)
{
    const uint32_t *v = s->map.corners + 3 * (size_t)s->assembly.simplex[e];
    const double *p[3];
    double d[3][2] = {{0}};
    (void)corner_images(2, s, e, p);
    for (size_t k = 0; k < 3; ++k)
        if (s->assembly.slot[v[k]] != UINT32_MAX)
            memcpy(d[k], s->step + 2 * (size_t)s->assembly.slot[v[k]], sizeof d[k]);
    return flip_along(p, (const double(*)[2])d);
}

/* A cubic is positive where its Bernstein coefficients are: of the volume of corners p that go
 * along d, up to the share t of the way. */
static bool keeps_volume(const double *const p[4], const double *const d[4], double t)
{
    double edge[2][9], cofactor[2][9], b[4] = {0};
    for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < 3; ++k) {
            edge[0][3 * i + k] = p[i + 1][k] - p[0][k];
            edge[1][3 * i + k] = t * (d[i + 1][k] - d[0][k]);
        }
    iccp_cofactors(3, edge[0], cofactor[0]);
    iccp_cofactors(3, edge[1], cofactor[1]);
    for (size_t i = 0; i < 9; ++i) {
        b[0] += edge[0][i] * cofactor[0][i] / 3;
        b[1] += edge[1][i] * cofactor[0][i];
        b[2] += edge[0][i] * cofactor[1][i];
        b[3] += edge[1][i] * cofactor[1][i] / 3;
    }
    return b[0] + b[1] / 3 > 0 && b[0] + (2 * b[1] + b[2]) / 3 > 0 && b[0] + b[1] + b[2] + b[3] > 0;
}

static double limit_in_space(const iccp_simplicial_map *map, const double *motion)
{
    double limit = FARTHEST;
    for (size_t t = 0; t < map->n_simplices; ++t) {
        const double *p[4], *d[4];
        iccp_simplicial_images(3, map, t, p);
        for (size_t k = 0; k < 4; ++k)
            d[k] = motion + 3 * (size_t)map->corners[4 * t + k];
        for (int k = 0; k < MAX_CUTS && !keeps_volume(p, d, limit); ++k)
            limit *= CLOSER;
    }
    return limit;
}

double iccp_newton_limit(const iccp_simplicial_map *map, const double *motion)
{
    double least = HUGE_VAL;
    if (map->dim == 3)
        return limit_in_space(map, motion);
    for (size_t t = 0; t < map->n_simplices; ++t) {
        const double *p[3];
        double d[3][2];
        iccp_simplicial_images(2, map, t, p);
        for (size_t k = 0; k < 3; ++k)
            memcpy(d[k], motion + 2 * (size_t)map->corners[3 * t + k], sizeof d[k]);
        least = iccp_min(least, flip_along(p, (const double(*)[2])d));
    }
    return least;
}

typedef struct limit {
    const iccp_newton *s;
    _Atomic double least;
} limit;

static icc_status find_flips(void *argument, size_t begin, size_t end)
{
    limit *l = argument;
    double own = HUGE_VAL, least = atomic_load(&l->least);
    for (size_t e = begin; e < end; ++e)
        own = iccp_min(own, flip_of(l->s, e));
    while (own < least && !atomic_compare_exchange_weak(&l->least, &least, own))
        continue;
    return ICC_OK;
}

/* How far the step can go before the first triangle loses its area, which is quadratic along it. */
static double flip_limit(const iccp_newton *s)
{
    limit l = {s, HUGE_VAL};
    run(s, s->assembly.n_elements, GRAIN, find_flips, &l);
    return atomic_load(&l.least);
}

static void set_images(iccp_newton *s, double length)
{
    const size_t dim = s->map.dim;
    for (size_t i = 0; i < s->assembly.n_free; ++i)
        for (size_t d = 0; d < dim; ++d)
            s->map.images[dim * s->assembly.free_point[i] + d] =
                s->saved[dim * i + d] + length * s->step[dim * i + d];
}

static void round_images(iccp_newton *s)
{
    for (size_t i = 0; i < s->assembly.n_free; ++i)
        iccp_simplicial_round(3, s->map.images + 3 * s->assembly.free_point[i]);
}

typedef struct verdict {
    const iccp_newton *s;
    atomic_bool is_positive;
} verdict;

static icc_status find_signs(void *argument, size_t begin, size_t end)
{
    verdict *v = argument;
    for (size_t e = begin; e < end && atomic_load(&v->is_positive); ++e)
        if (!iccp_simplicial_is_positive(&v->s->map, v->s->assembly.simplex[e]))
            atomic_store(&v->is_positive, false);
    return ICC_OK;
}

static bool all_positive(const iccp_newton *s)
{
    verdict v = {s, true};
    run(s, s->assembly.n_elements, GRAIN, find_signs, &v);
    return atomic_load(&v.is_positive);
}

/* Beyond a step of 1 as long as the energy falls. Where a simplex is all but flat, Newton's model
 * of its energy, of which most is 1 / sigma^2, only takes it a third farther from that at a
 * time. */
static double go_on(iccp_newton *s, iccp_energy energy, double before)
{
    double length = 1, after = before;
    do {
        before = after;
        length *= 2;
        set_images(s, length);
        round_images(s);
        after = iccp_newton_energy(s, energy, 0);
    } while (after < before && all_positive(s));
    set_images(s, length / 2);
    round_images(s);
    return before;
}

/* In space nothing but the energy, infinite for what is inverted, keeps a first step of 1 from
 * flips. */
double iccp_newton_move(iccp_newton *newton, iccp_energy energy, double epsilon, double before,
                        double slope)
{
    iccp_newton *s = newton;
    const size_t dim = s->map.dim;
    const bool guarded = energy != ICCP_UNTANGLE, in_space = guarded && dim == 3;
    const double shorter = in_space ? SHORTER_IN_SPACE : SHORTER;
    const int n_tries = in_space ? MAX_CUTS_IN_SPACE : MAX_CUTS;
    double length = guarded && dim == 2 ? iccp_min(1, SHARE_OF_FLIP * flip_limit(s)) : 1;
    for (size_t i = 0; i < s->assembly.n_free; ++i)
        memcpy(s->saved + dim * i, s->map.images + dim * s->assembly.free_point[i],
               dim * sizeof *s->saved);
    for (int k = 0; k < n_tries; ++k, length *= shorter) {
        set_images(s, length);
        if (in_space)
            round_images(s);
        const double after = iccp_newton_energy(s, energy, epsilon);
        if (after <= before + DECREASE * length * slope && (!guarded || all_positive(s)))
            return in_space && k == 0 && after < (1 - LARGE_FALL) * before ? go_on(s, energy, after)
                                                                           : after;
    }
    set_images(s, 0);
    return before;
}
