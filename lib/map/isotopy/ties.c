/* Reads and checks the caller's ties. Overlaps and wrong orders show when the domains are cut
 * open along the ties. */
#include "map/isotopy/ties.h"

#include "base/error.h"
#include "base/options.h"
#include "map/isotopy/cut_polygon.h"

#include <math.h>
#include <string.h>

/* Largest coordinate of a bend, in local coordinates. */
static const double FARTHEST = 2;

/* ---- reading ---- */

static icc_status read_tie(icc_tie *tie, const icc_tie *ties, size_t i, size_t n_vertices,
                           icc_error *err)
{
    const char *at = (const char *)ties + i * ties->size;
    const icc_status status = iccp_read_struct(tie, sizeof *tie, at, "icc_tie", err);
    if (status != ICC_OK)
        return status;
    for (int end = 0; end < 2; ++end)
        if (tie->vertex[end] >= n_vertices)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_TIE, (int64_t)i,
                                "tie %zu ends at vertex %lu, but there are only %zu", i,
                                (unsigned long)tie->vertex[end], n_vertices);
    if ((tie->source == NULL && tie->n_source > 0) || (tie->target == NULL && tie->n_target > 0))
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_TIE, (int64_t)i,
                            "tie %zu: its bends are NULL", i);
    return ICC_OK;
}

/* Reads a polyline from one end to the other, in local coordinates. */
static icc_status read_line(iccp_polyline *line, const icc_domain *domain, const icc_tie *tie,
                            size_t i, int side, const iccp_memory *memory, icc_error *err)
{
    const double *bends = side == 0 ? tie->source : tie->target;
    const size_t n = side == 0 ? tie->n_source : tie->n_target;
    line->n = 0;
    icc_status status =
        iccp_polyline_add(line, domain->vertices + 2 * (size_t)tie->vertex[0], memory);
    for (size_t k = 0; status == ICC_OK && k < n; ++k) {
        const double *p = bends + 2 * k;
        double local[2];
        iccp_frame_in(&domain->frame, 2, p, local);
        /* No vertex is farther from zero than 1. The predicates are exact for numbers of this
         * size. */
        if (!(fabs(local[0]) <= FARTHEST && fabs(local[1]) <= FARTHEST) ||
            !iccp_frame_holds(&domain->frame, 2, p))
            return iccp_fail_side(err,
                                  iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_TIE, (int64_t)i,
                                               "tie %zu: bend %zu is not a number near the "
                                               "domain",
                                               i, k),
                                  side + 1);
        status = iccp_polyline_add(line, local, memory);
    }
    return status == ICC_OK
               ? iccp_polyline_add(line, domain->vertices + 2 * (size_t)tie->vertex[1], memory)
               : status;
}

static icc_status read_ties(iccp_cuts *cuts, const iccp_domain_pair *domains, size_t n,
                            const icc_tie *ties, icc_error *err)
{
    iccp_polyline line[2] = {{0}, {0}};
    icc_status status = iccp_cuts_begin(cuts, n, &cuts->memory);
    for (size_t i = 0; status == ICC_OK && i < n; ++i) {
        icc_tie tie;
        status = read_tie(&tie, ties, i, domains->n, err);
        for (int side = 0; status == ICC_OK && side < 2; ++side)
            status =
                read_line(&line[side], domains->domain[side], &tie, i, side, &cuts->memory, err);
        if (status == ICC_OK)
            status = iccp_cuts_add(cuts, i, tie.vertex, line);
    }
    for (int side = 0; side < 2; ++side)
        iccp_polyline_free(&line[side], &cuts->memory);
    return status;
}

/* ---- checking ---- */

/* Returns the first tie that closes a ring, or n. `group`: for each component, the smallest number
 * of a component joined with it. */
static size_t find_ring(const iccp_cuts *cuts, const iccp_domain_pair *domains, uint32_t *group)
{
    for (uint32_t c = 0; c < domains->n_components; ++c)
        group[c] = c;
    for (size_t i = 0; i < cuts->n; ++i) {
        uint32_t end[2];
        for (int k = 0; k < 2; ++k)
            for (end[k] = domains->component[cuts->ends[2 * i + (size_t)k]];
                 group[end[k]] != end[k]; end[k] = group[end[k]])
                continue;
        if (end[0] == end[1])
            return i;
        group[end[0] > end[1] ? end[0] : end[1]] = end[0] > end[1] ? end[1] : end[0];
    }
    return cuts->n;
}

static icc_status check_tree(const iccp_cuts *cuts, const iccp_domain_pair *domains, icc_error *err)
{
    const size_t n = domains->n_cuts;
    if (cuts->n != n)
        return iccp_fail(err, ICC_ERR_TOPOLOGY,
                         "%zu ties: there must be %zu, which join all rings, lines and points that "
                         "are apart",
                         cuts->n, n);
    uint32_t *group = iccp_alloc(&cuts->memory, domains->n_components, sizeof *group);
    if (group == NULL)
        return iccp_fail_memory(err);
    const size_t i = find_ring(cuts, domains, group);
    iccp_free(&cuts->memory, group);
    for (size_t k = 0; k < n; ++k)
        if (domains->part[domains->component[cuts->ends[2 * k]]] !=
            domains->part[domains->component[cuts->ends[2 * k + 1]]])
            return iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_TIE, (int64_t)k,
                                "tie %zu joins two parts of the domain that are apart", k);
    return i == n ? ICC_OK
                  : iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_TIE, (int64_t)i,
                                 "tie %zu joins what the ties before it join already", i);
}

/* *meet becomes true if the first n ties meet walls or one another on a side. */
static icc_status first_meet(const iccp_cuts *cuts, const iccp_domain_pair *domains, int side,
                             size_t n, bool *meet, const iccp_env *env)
{
    iccp_cuts some = *cuts;
    iccp_cut_polygons polygons;
    some.n = n;
    const icc_status status = iccp_cut_polygons_create(&polygons, domains, side, &some, env);
    if (status == ICC_OK)
        iccp_cut_polygons_free(&polygons);
    *meet = status == ICC_ERR_CERTIFICATE;
    return status == ICC_ERR_TOPOLOGY || *meet ? ICC_OK : status;
}

/* Finds the first tie that meets a wall or an earlier tie, by bisection. */
static icc_status fail_meeting(const iccp_cuts *cuts, const iccp_domain_pair *domains, int side,
                               const iccp_env *env, icc_error *err)
{
    size_t low = 0, high = cuts->n;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        bool meet;
        const icc_status status = first_meet(cuts, domains, side, middle, &meet, env);
        if (status != ICC_OK)
            return status;
        if (meet)
            high = middle;
        else
            low = middle;
    }
    return iccp_fail_side(err,
                          iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_TIE, (int64_t)low,
                                       "tie %zu meets itself, a tie before it, a feature or the "
                                       "outer ring on its way",
                                       low),
                          side + 1);
}

/* Returns the tie that joins two neighbouring corners of a cut polygon, or n if they are joined by
 * a wall. */
static size_t tie_between(const iccp_cuts *cuts, size_t n_vertices, uint32_t a, uint32_t b)
{
    const uint32_t bend = a >= n_vertices ? a : b;
    for (size_t i = 0; i < cuts->n; ++i) {
        const uint32_t *ends = cuts->ends + 2 * i;
        if (bend >= n_vertices
                ? bend - n_vertices >= cuts->first[i] && bend - n_vertices < cuts->first[i + 1]
                : (ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a))
            return i;
    }
    return cuts->n;
}

/* Compares the two cut polygons. Where they differ, a tie lies between different neighbours. */
static icc_status check_order(const iccp_cuts *cuts, const iccp_domain_pair *domains,
                              const iccp_cut_polygons polygon[2], icc_error *err)
{
    for (uint32_t i = 1; i < polygon[0].n && i < polygon[1].n; ++i) {
        const uint32_t from = polygon[0].vertex[i - 1], *to = polygon[0].vertex + i;
        if (*to == polygon[1].vertex[i])
            continue;
        size_t tie = tie_between(cuts, domains->n, from, *to);
        if (tie == cuts->n)
            tie = tie_between(cuts, domains->n, from, polygon[1].vertex[i]);
        return iccp_fail_at(
            err, ICC_ERR_TOPOLOGY, ICC_ITEM_TIE, tie < cuts->n ? (int64_t)tie : -1,
            "tie %zu leaves a vertex between different neighbours in source and target", tie);
    }
    return ICC_OK;
}

static icc_status check_ties(const iccp_cuts *cuts, const iccp_domain_pair *domains,
                             const iccp_env *env, icc_error *err)
{
    iccp_cut_polygons polygon[2] = {{.memory = env->memory}, {.memory = env->memory}};
    icc_status status = check_tree(cuts, domains, err);
    for (int side = 0; status == ICC_OK && side < 2; ++side) {
        status = iccp_cut_polygons_create(&polygon[side], domains, side, cuts, env);
        if (status == ICC_ERR_CERTIFICATE)
            status = fail_meeting(cuts, domains, side, env, err);
    }
    if (status == ICC_OK)
        status = check_order(cuts, domains, polygon, err);
    for (int side = 0; side < 2; ++side)
        iccp_cut_polygons_free(&polygon[side]);
    return status;
}

icc_status iccp_ties_read(iccp_cuts *cuts, const iccp_domain_pair *domains, size_t n,
                          const icc_tie *ties, const iccp_env *env, icc_error *err)
{
    *cuts = (iccp_cuts){.memory = env->memory};
    icc_status status = read_ties(cuts, domains, n, ties, err);
    if (status == ICC_OK)
        status = check_ties(cuts, domains, env, err);
    if (status != ICC_OK)
        iccp_cuts_free(cuts);
    return status;
}
