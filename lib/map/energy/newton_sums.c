/* Sums over the elements: the energy, its gradient and its Hessian. The order of summation is the
 * same for all numbers of threads. */
#include "base/minmax.h"
#include "map/energy/dirichlet.h"
#include "map/energy/model.h"
#include "map/energy/newton_parts.h"
#include "map/energy/untangling.h"

#include <math.h>
#include <string.h>

/* Points whose sums a thread clears at once. */
enum { POINTS = 256 };

/* Elements waiting to be summed that a thread takes at once. */
enum { FEW = 64 };

/* A loop over the elements, or over the parts of the assembly. */
typedef struct loop {
    iccp_newton *s;
    iccp_energy energy;
    double epsilon;
    size_t first; /* the first of the waiting elements */
} loop;

static ICCP_INLINE double energy_of(size_t dim, const iccp_newton *s, size_t e, iccp_energy energy,
                                    double epsilon)
{
    const double *image[4], *element = iccp_newton_images(dim, s, e, image);
    if (energy == ICCP_UNTANGLE)
        return iccp_untangling_energy(dim, element, image, epsilon);
    if (energy == ICCP_MODEL)
        return iccp_model_energy(dim, &s->map, s->assembly.simplex[e], element);
    const double own = iccp_dirichlet_energy(dim, element, image);
    return s->map.model == NULL
               ? own
               : own + iccp_model_energy(dim, &s->map, s->assembly.simplex[e], element);
}

static icc_status find_terms(void *argument, size_t begin, size_t end)
{
    const loop *l = argument;
    for (size_t e = begin; e < end; ++e)
        l->s->term[e] = l->s->map.dim == 2 ? energy_of(2, l->s, e, l->energy, l->epsilon)
                                           : energy_of(3, l->s, e, l->energy, l->epsilon);
    return ICC_OK;
}

/* With threads, all terms are computed first. They are always summed in the same order. */
static ICCP_INLINE double sum_energy(size_t dim, const iccp_newton *s, iccp_energy energy,
                                     double epsilon)
{
    const size_t n = s->assembly.n_elements;
    const bool found = iccp_has_threads(&s->threads) && n > ICCP_NEWTON_GRAIN;
    double sum = 0;
    if (found)
        iccp_newton_run(s, n, ICCP_NEWTON_GRAIN, find_terms,
                        &(loop){(iccp_newton *)s, energy, epsilon, 0});
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
        const double *image[4], *element = iccp_newton_images(dim, s, e, image);
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

/* Adds what a model adds to the derivatives of an element. */
static void add_model(const loop *l, size_t e, iccp_local *local)
{
    const iccp_newton *s = l->s;
    const double *element = s->element + ICCP_ELEMENT(s->map.dim) * e;
    if (s->map.model != NULL && s->map.dim == 2)
        iccp_model_add(2, &s->map, s->assembly.simplex[e], element, local);
    else if (s->map.model != NULL)
        iccp_model_add(3, &s->map, s->assembly.simplex[e], element, local);
}

static void find_local(const loop *l, size_t e, iccp_local *local)
{
    const size_t dim = l->s->map.dim;
    const double *image[4], *element = iccp_newton_images(dim, l->s, e, image);
    if (l->energy == ICCP_UNTANGLE)
        iccp_untangling_local(dim, element, image, l->epsilon, local);
    else if (l->energy == ICCP_MODEL) {
        memset(local, 0, sizeof *local);
        add_model(l, e, local);
    } else {
        iccp_dirichlet_local(dim, element, image, l->energy == ICCP_DIRICHLET_MAJORISED, local);
        add_model(l, e, local);
    }
}

/* Computes several triangles side by side, in the plane and for the Dirichlet energy. */
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
        batch.element[i] = iccp_newton_images(2, l->s, e[i < n ? i : 0], image);
        for (size_t k = 0; k < 3; ++k)
            batch.image[k][i] = image[k];
    }
    iccp_dirichlet_locals(iccp_simd(), &batch, l->energy == ICCP_DIRICHLET_MAJORISED, local);
    for (size_t i = 0; i < n; ++i)
        add_model(l, e[i], &local[i]);
}

/* Leaves in the derivatives of a triangle only what motions along rails change. */
static void put_on_rails(const iccp_newton *s, size_t e, iccp_local *local)
{
    const uint32_t *v = s->map.corners + 3 * (size_t)s->assembly.simplex[e];
    for (size_t k = 0; k < 3; ++k) {
        const double *r = iccp_newton_rail(&s->map, v[k]);
        double *g = local->gradient + 2 * k, *h = local->hessian;
        if (r == NULL)
            continue;
        const double slope = r[0] * g[0] + r[1] * g[1];
        for (size_t d = 0; d < 2; ++d)
            g[d] = slope * r[d];
        for (size_t i = 0; i < 6; ++i) {
            const double along = r[0] * h[6 * i + 2 * k] + r[1] * h[6 * i + 2 * k + 1];
            for (size_t d = 0; d < 2; ++d)
                h[6 * i + 2 * k + d] = along * r[d];
        }
        for (size_t i = 0; i < 6; ++i) {
            const double along = r[0] * h[12 * k + i] + r[1] * h[12 * k + 6 + i];
            for (size_t d = 0; d < 2; ++d)
                h[12 * k + 6 * d + i] = along * r[d];
        }
    }
}

/* Makes the Hessian regular across the rails. The gradient is 0 there. */
static void brace_rails(iccp_newton *s)
{
    iccp_assembly *a = &s->assembly;
    for (size_t i = 0; s->map.rail != NULL && i < a->n_free; ++i) {
        const double *r = iccp_newton_rail(&s->map, a->free_point[i]);
        if (r == NULL)
            continue;
        const double stiffness = a->diagonal[2 * i] + a->diagonal[2 * i + 1];
        const double across[2] = {-r[1], r[0]};
        for (size_t d = 0; d < 2; ++d) {
            a->diagonal[2 * i + d] += stiffness * across[d] * across[d];
            a->value[a->first[2 * i + d]] += stiffness * across[0] * across[1];
        }
    }
}

/* Adds elements list[begin] .. list[end - 1], or begin .. end - 1 if `list` is NULL. */
static void add_elements(const loop *l, size_t part, const uint32_t *list, size_t begin, size_t end)
{
    iccp_local local[ICCP_DIRICHLET_LANES];
    size_t e[ICCP_DIRICHLET_LANES], n;
    for (size_t k = begin; k < end; k += n) {
        n = end - k < ICCP_DIRICHLET_LANES ? end - k : ICCP_DIRICHLET_LANES;
        for (size_t i = 0; i < n; ++i)
            e[i] = list != NULL ? list[k + i] : k + i;
        find_some(l, n, e, local);
        for (size_t i = 0; i < n; ++i) {
            if (l->s->map.rail != NULL)
                put_on_rails(l->s, e[i], &local[i]);
            iccp_assembly_add(&l->s->assembly, part, e[i], &local[i]);
        }
    }
}

static icc_status begin_sums(void *argument, size_t begin, size_t end)
{
    const loop *l = argument;
    iccp_assembly_begin(&l->s->assembly, begin, end);
    return ICC_OK;
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

/* In space most elements would lie in several parts. So threads compute the elements' derivatives,
 * which takes long, and one thread sums them in order, which is quick. */
static void assemble_some(loop *l)
{
    const size_t left = l->s->assembly.n_elements - l->first,
                 n = left < ICCP_NEWTON_WAITING ? left : ICCP_NEWTON_WAITING;
    iccp_newton_run(l->s, n, FEW, find_locals, l);
    for (size_t k = 0; k < n; ++k)
        iccp_assembly_add(&l->s->assembly, ICCP_ALL_PARTS, l->first + k, &l->s->local[k]);
}

void iccp_newton_sum_ahead(iccp_newton *newton, iccp_energy energy)
{
    iccp_newton *s = newton;
    const loop l = {s, energy, 0, 0};
    iccp_assembly_begin(&s->assembly, 0, s->assembly.n_free);
    add_elements(&l, ICCP_ALL_PARTS, NULL, 0, s->assembly.n_elements);
    iccp_assembly_end(&s->assembly);
    brace_rails(s);
}

void iccp_newton_sum(iccp_newton *newton, iccp_energy energy, double epsilon)
{
    iccp_newton *s = newton;
    loop l = {s, energy, epsilon, 0};
    const bool is_done = s->is_ahead && s->ahead == energy;
    s->is_ahead = false;
    if (is_done)
        return;
    iccp_newton_run(s, s->assembly.n_free, POINTS, begin_sums, &l);
    if (s->local != NULL)
        for (; l.first < s->assembly.n_elements; l.first += ICCP_NEWTON_WAITING)
            assemble_some(&l);
    else if (s->assembly.n_parts > 1 && iccp_has_threads(&s->threads))
        iccp_newton_run(s, s->assembly.n_parts, 1, assemble_parts, &l);
    else
        add_elements(&l, ICCP_ALL_PARTS, NULL, 0, s->assembly.n_elements);
    iccp_assembly_end(&s->assembly);
    brace_rails(s);
}

bool iccp_newton_has_worst(const iccp_newton *newton)
{
    const iccp_newton *s = newton;
    double sum = 0, most = 0;
    iccp_newton_run(s, s->assembly.n_elements, ICCP_NEWTON_GRAIN, find_terms,
                    &(loop){(iccp_newton *)s, ICCP_DIRICHLET, 0, 0});
    for (size_t e = 0; e < s->assembly.n_elements; ++e) {
        sum += s->term[e];
        most = iccp_max(most, s->term[e]);
    }
    return most > sum / 2;
}
