/* The combinatorics of a boundary: pairs of facets at each ridge. */
#include "domain/complex.h"

#include "base/compiler.h"
#include "base/error.h"
#include "geometry/tuples.h"

#include <stdbool.h>
#include <stdio.h>

enum { MAX = ICC_MAX_DIM };

const char *iccp_complex_facet(size_t dim)
{
    return dim == 3 ? "face" : "facet";
}

const char *iccp_complex_ridge(size_t dim)
{
    return dim == 3 ? "edge" : "ridge";
}

static const uint32_t *corners(const iccp_complex *c, size_t facet)
{
    return c->facets + c->dim * facet;
}

icc_status iccp_complex_check_indices(const iccp_complex *c, icc_error *err)
{
    const char *name = iccp_complex_facet(c->dim);
    for (size_t f = 0; f < c->n_facets; ++f)
        for (size_t i = 0; i < c->dim; ++i) {
            const uint32_t v = corners(c, f)[i];
            if (v >= c->n_vertices)
                return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)f,
                                    "%s %zu names vertex %lu, but there are only %zu vertices",
                                    name, f, (unsigned long)v, c->n_vertices);
            for (size_t j = 0; j < i; ++j)
                if (corners(c, f)[j] == v)
                    return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)f,
                                        "%s %zu names vertex %lu twice", name, f, (unsigned long)v);
        }
    return ICC_OK;
}

/* ----------------------------------------------------------------- ridges */

/* Writes the vertices of the ridge opposite corner i in ascending order. Returns true if the facet
 * runs along it in the odd direction, (-1)^i times the sign of the sorting permutation. `dim` is
 * that of c, here and below. It is a separate argument so that the compiler can avoid divisions. */
static ICCP_INLINE bool read_ridge(const iccp_complex *c, size_t dim, size_t facet, size_t i,
                                   uint32_t *ridge)
{
    const uint32_t *corner = c->facets + dim * facet;
    for (size_t j = 0; j + 1 < dim; ++j)
        ridge[j] = corner[j < i ? j : j + 1];
    return iccp_sort_vertices(dim - 1, ridge) != (i % 2 != 0);
}

/* A list of all ridges. Ridge dim f + i is the ridge of facet f opposite its corner i. */
typedef struct ridge_list {
    const iccp_complex *c;
    iccp_tuples tuples;
} ridge_list;

static ICCP_INLINE void list_ridges(ridge_list *list, size_t dim)
{
    uint32_t *ridge = list->tuples.vertices;
    for (size_t f = 0; f < list->c->n_facets; ++f)
        for (size_t i = 0; i < dim; ++i, ridge += dim - 1)
            (void)read_ridge(list->c, dim, f, i, ridge);
}

/* Writes a text such as "edge (3, 7)". */
static void describe_ridge(const ridge_list *list, uint32_t r, char *text, size_t size)
{
    const size_t width = list->tuples.width;
    int n = snprintf(text, size, "%s (", iccp_complex_ridge(list->c->dim));
    for (size_t k = 0; k < width; ++k)
        n += snprintf(text + n, size - (size_t)n, k == 0 ? "%lu" : ", %lu",
                      (unsigned long)list->tuples.vertices[width * r + k]);
    (void)snprintf(text + n, size - (size_t)n, ")");
}

static ICCP_INLINE bool runs_along(const iccp_complex *c, uint32_t dim, uint32_t r)
{
    uint32_t ridge[MAX];
    return read_ridge(c, dim, r / dim, r % dim, ridge);
}

/* Counts the known neighbours with which a facet disagrees about direction. */
static size_t count_conflicts(const iccp_complex *c, size_t facet)
{
    const uint32_t dim = (uint32_t)c->dim;
    size_t n = 0;
    for (size_t i = 0; i < c->dim; ++i) {
        const size_t other = c->across[c->dim * facet + i];
        for (size_t j = 0; j < c->dim; ++j)
            n += c->across[c->dim * other + j] == facet &&
                 runs_along(c, dim, (uint32_t)(c->dim * facet + i)) ==
                     runs_along(c, dim, (uint32_t)(c->dim * other + j));
    }
    return n;
}

/* Faults of a ridge, the worst first: more than two facets, only one, or two that run along it in
 * the same direction. */
enum { CROWDED, OPEN, TWISTED, N_FAULTS };

typedef struct fault {
    size_t n;       /* number of ridges with this fault */
    size_t place;   /* where the first such ridge begins in the sorted list */
    size_t n_sides; /* its number of facets */
} fault;

/* Names the first ridge at fault. The item of the message is a facet. For a crowded ridge it is the
 * third one, since two belong there. For a twisted ridge it is the facet that disagrees with more
 * of its neighbours, most likely the one that was given the wrong way around. */
static icc_status fail_ridge(const ridge_list *list, int kind, const fault *found, icc_error *err)
{
    const iccp_complex *c = list->c;
    const uint32_t *at = list->tuples.order + found->place;
    const char *name = iccp_complex_facet(c->dim);
    const size_t f = at[0] / c->dim, g = kind == OPEN ? f : at[1] / c->dim;
    char ridge[96];
    describe_ridge(list, at[0], ridge, sizeof ridge);
    if (kind == CROWDED)
        return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)(at[2] / c->dim),
                            "%s belongs to %zu %ss, among them %zu, %zu and %zu, instead of two",
                            ridge, found->n_sides, name, f, g, (size_t)(at[2] / c->dim));
    if (kind == OPEN)
        return iccp_fail_at(
            err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)f,
            "%s of %s %zu belongs to no other %s: the boundary is open (%zu such %ss)", ridge, name,
            f, name, found->n, iccp_complex_ridge(c->dim));
    const size_t guilty = count_conflicts(c, f) > count_conflicts(c, g) ? f : g;
    return iccp_fail_at(
        err, ICC_ERR_BOUNDARY, ICC_ITEM_FACET, (int64_t)guilty,
        "%ss %zu and %zu run along %s in the same direction: one of them is turned over", name, f,
        g, ridge);
}

/* Pairs equal ridges, which are adjacent in the list, that of the smallest facet first. */
static ICCP_INLINE icc_status pair_ridges(iccp_complex *c, uint32_t dim, const ridge_list *list,
                                          icc_error *err)
{
    fault faults[N_FAULTS] = {{0}};
    for (size_t k = 0, end; k < list->tuples.n; k = end) {
        const uint32_t *at = list->tuples.order + k;
        end = iccp_tuples_end(&list->tuples, k);
        int kind = end - k == 1 ? OPEN : end - k > 2 ? CROWDED : N_FAULTS;
        if (kind == N_FAULTS) {
            c->across[at[0]] = at[1] / dim;
            c->across[at[1]] = at[0] / dim;
            if (runs_along(c, dim, at[0]) != runs_along(c, dim, at[1]))
                continue;
            kind = TWISTED;
        }
        if (faults[kind].n++ == 0) {
            faults[kind].place = k;
            faults[kind].n_sides = end - k;
        }
    }
    for (int kind = 0; kind < N_FAULTS; ++kind)
        if (faults[kind].n > 0)
            return fail_ridge(list, kind, &faults[kind], err);
    return ICC_OK;
}

static ICCP_INLINE icc_status join(iccp_complex *c, uint32_t dim, ridge_list *list, icc_error *err)
{
    list_ridges(list, dim);
    iccp_tuples_sort(&list->tuples);
    return pair_ridges(c, dim, list, err);
}

icc_status iccp_complex_join(iccp_complex *c, const iccp_env *env, icc_error *err)
{
    ridge_list list = {.c = c};
    icc_status status = iccp_tuples_create(&list.tuples, c->n_facets * c->dim, c->dim - 1,
                                           c->n_vertices, &env->memory);
    if (status != ICC_OK)
        return iccp_explain(err, status);
    status = c->dim == 3 ? join(c, 3, &list, err) : join(c, (uint32_t)c->dim, &list, err);
    iccp_tuples_free(&list.tuples);
    return status;
}
