/* Sums over triangles, springs and pairs that touch. The order is the same for all numbers of
 * threads. The derivatives of a triangle are those of map/energy/dirichlet.h with a weight in
 * place of the area. */
#include "fit/elastic/elastic_sums.h"

#include "base/threads.h"
#include "map/energy/dirichlet.h"

#include <string.h>

/* GRAIN: triangles that a thread takes at once. POINTS: the same for vertices. */
enum { GRAIN = 512, POINTS = 256 };

static icc_status find_terms(void *argument, size_t begin, size_t end)
{
    const iccp_elastic_state *s = argument;
    const iccp_simplicial_map view = iccp_elastic_view(s);
    for (size_t t = begin; t < end; ++t) {
        const double *image[3];
        iccp_simplicial_images(2, &view, t, image);
        s->term[t] = iccp_dirichlet_energy2(s->as->element + ICCP_ELEMENT(2) * t, image);
    }
    return ICC_OK;
}

double iccp_elastic_triangles(const iccp_elastic_state *s)
{
    double sum = 0;
    (void)iccp_for_chunks(&s->threads, "improve", s->as->n_triangles, GRAIN, find_terms, (void *)s);
    for (size_t t = 0; t < s->as->n_triangles; ++t)
        sum += s->term[t];
    return sum;
}

/* How far a vertex is from its place along axis k of its frame. */
static double offset(const iccp_elastic_state *s, uint32_t v, size_t k)
{
    const double *x = s->images + 2 * (size_t)v, *q = s->place + 2 * (size_t)v;
    double axis[2];
    iccp_elastic_axis(s->as, v, k, axis);
    return (x[0] - q[0]) * axis[0] + (x[1] - q[1]) * axis[1];
}

double iccp_elastic_springs(const iccp_elastic_state *s)
{
    double sum = 0;
    for (uint32_t v = 0; v < s->as->n_points; ++v)
        for (size_t k = 0; k < 2; ++k)
            if (iccp_elastic_is_told(s->as, v, k) && !s->settled[v]) {
                const double off = offset(s, v, k);
                sum += s->pull[v] * s->as->spring[v] * off * off / 2;
            }
    return sum;
}

/* ---- derivatives ---- */

/* Turns the rows of a corner into the frame of its vertex, and clears those of fixed unknowns. */
static void turn_corner(const iccp_elastic_state *s, uint32_t v, size_t corner, iccp_local *local)
{
    double axis[2][2], *g = local->gradient + 2 * corner, *h = local->hessian;
    bool fixed[2];
    for (size_t k = 0; k < 2; ++k) {
        iccp_elastic_axis(s->as, v, k, axis[k]);
        fixed[k] = s->settled[v] && iccp_elastic_is_told(s->as, v, k);
    }
    const double gradient[2] = {g[0], g[1]};
    for (size_t k = 0; k < 2; ++k)
        g[k] = fixed[k] ? 0 : axis[k][0] * gradient[0] + axis[k][1] * gradient[1];
    for (size_t c = 0; c < 6; ++c) {
        double *row[2] = {h + 6 * (2 * corner) + c, h + 6 * (2 * corner + 1) + c};
        const double x = *row[0], y = *row[1];
        for (size_t k = 0; k < 2; ++k)
            *row[k] = fixed[k] ? 0 : axis[k][0] * x + axis[k][1] * y;
    }
    for (size_t r = 0; r < 6; ++r) {
        double *at = h + 6 * r + 2 * corner;
        const double x = at[0], y = at[1];
        for (size_t k = 0; k < 2; ++k)
            at[k] = fixed[k] ? 0 : axis[k][0] * x + axis[k][1] * y;
    }
}

static void add(iccp_elastic_state *s, size_t part, size_t e, iccp_local *local)
{
    const uint32_t *v = s->own.assembly.corners + 3 * e;
    for (size_t k = 0; k < 3; ++k)
        if (s->as->hold[v[k]] == ICCP_SLIDING ||
            (s->as->hold[v[k]] == ICCP_HELD && s->settled[v[k]]))
            turn_corner(s, v[k], k, local);
    iccp_assembly_add(&s->own.assembly, part, e, local);
}

/* Adds several triangles, which are computed side by side. */
static void add_triangles(iccp_elastic_state *s, size_t part, size_t n, const size_t *t)
{
    const iccp_simplicial_map view = iccp_elastic_view(s);
    iccp_local local[ICCP_DIRICHLET_LANES];
    iccp_dirichlet_batch batch;
    for (size_t i = 0; i < ICCP_DIRICHLET_LANES; ++i) {
        const size_t own = t[i < n ? i : 0];
        const double *image[3];
        iccp_simplicial_images(2, &view, own, image);
        batch.element[i] = s->as->element + ICCP_ELEMENT(2) * own;
        for (size_t k = 0; k < 3; ++k)
            batch.image[k][i] = image[k];
    }
    iccp_dirichlet_locals(iccp_simd(), &batch, false, local);
    for (size_t i = 0; i < n; ++i)
        add(s, part, t[i], &local[i]);
}

static void add_pair(iccp_elastic_state *s, size_t part, size_t e)
{
    const iccp_touch *touch = &s->own.touch[e - s->own.first_touch];
    iccp_local local;
    if (iccp_contact_local(touch, s->as->shape.strength, s->images, &local))
        add(s, part, e, &local);
}

/* Adds elements list[begin] .. list[end - 1], or begin .. end - 1 if `list` is NULL. Triangles come
 * first. Links add nothing. */
static void add_elements(iccp_elastic_state *s, size_t part, const uint32_t *list, size_t begin,
                         size_t end)
{
    size_t t[ICCP_DIRICHLET_LANES], n = 0, k = begin;
    for (; k < end; ++k) {
        const size_t e = list != NULL ? list[k] : k;
        if (e >= s->as->n_triangles)
            break;
        t[n++] = e;
        if (n == ICCP_DIRICHLET_LANES) {
            add_triangles(s, part, n, t);
            n = 0;
        }
    }
    if (n > 0)
        add_triangles(s, part, n, t);
    for (; k < end; ++k) {
        const size_t e = list != NULL ? list[k] : k;
        if (e >= s->own.first_touch)
            add_pair(s, part, e);
    }
}

static icc_status begin_sums(void *argument, size_t begin, size_t end)
{
    iccp_elastic_state *s = argument;
    iccp_assembly_begin(&s->own.assembly, begin, end);
    return ICC_OK;
}

static icc_status assemble_parts(void *argument, size_t begin, size_t end)
{
    iccp_elastic_state *s = argument;
    const iccp_assembly *a = &s->own.assembly;
    for (size_t part = begin; part < end; ++part)
        add_elements(s, part, a->element, a->first_element[part], a->first_element[part + 1]);
    return ICC_OK;
}

static void add_springs(iccp_elastic_state *s)
{
    iccp_assembly *a = &s->own.assembly;
    for (uint32_t v = 0; v < s->as->n_points; ++v)
        for (size_t k = 0; k < 2; ++k)
            if (iccp_elastic_is_told(s->as, v, k) && !s->settled[v]) {
                const double stiffness = s->pull[v] * s->as->spring[v];
                a->diagonal[2 * (size_t)v + k] += stiffness;
                a->gradient[2 * (size_t)v + k] += stiffness * offset(s, v, k);
            }
}

/* The frame of a vertex. Axes of fixed unknowns are 0. */
static void free_axes(const iccp_elastic_state *s, uint32_t v, double axis[2][2])
{
    for (size_t k = 0; k < 2; ++k)
        if (s->settled[v] && iccp_elastic_is_told(s->as, v, k))
            axis[k][0] = axis[k][1] = 0;
        else
            iccp_elastic_axis(s->as, v, k, axis[k]);
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1];
}

/* Adds row v of the bending matrix. */
static void add_bending(iccp_elastic_state *s, uint32_t v)
{
    const iccp_reach *reach = &s->as->reach;
    const iccp_gram *q = &reach->gram;
    iccp_assembly *a = &s->own.assembly;
    double own[2][2], other[2][2], gradient[2];
    free_axes(s, v, own);
    iccp_reach_gradient(reach, s->images, v, gradient);
    for (size_t k = 0; k < 2; ++k) {
        a->gradient[2 * (size_t)v + k] += dot(own[k], gradient);
        a->diagonal[2 * (size_t)v + k] += 2 * reach->factor * q->diagonal[v] * dot(own[k], own[k]);
    }
    for (size_t e = q->first[v]; e < q->first[v + 1]; ++e) {
        free_axes(s, q->column[e], other);
        for (size_t k = 0; k < 2 && s->own.place[e] != UINT32_MAX; ++k) {
            double *value = a->value + a->first[2 * (size_t)v + k] + 1 + 2 * s->own.place[e];
            for (size_t c = 0; c < 2; ++c)
                value[c] += 2 * reach->factor * q->value[e] * dot(own[k], other[c]);
        }
    }
}

void iccp_elastic_sum(iccp_elastic_state *state)
{
    iccp_elastic_state *s = state;
    iccp_assembly *a = &s->own.assembly;
    (void)iccp_for_chunks(&s->threads, "improve", a->n_free, POINTS, begin_sums, s);
    if (a->n_parts > 1 && iccp_has_threads(&s->threads))
        (void)iccp_for_chunks(&s->threads, "improve", a->n_parts, 1, assemble_parts, s);
    else
        add_elements(s, ICCP_ALL_PARTS, NULL, 0, a->n_elements);
    for (uint32_t v = 0; s->as->reach.factor > 0 && v < s->as->n_points; ++v)
        add_bending(s, v);
    iccp_assembly_end(a);
    add_springs(s);
}
