/* Compares the vertices and facets of two cages. */
#include "job/correspond.h"

#include "base/allocate.h"
#include "cage/cage_degrees.h"
#include "cage/cage_features.h"
#include "cage/cage_parts.h"
#include "cage/cage_ties.h"

#include <stdio.h>
#include <string.h>

/* The corners of a facet, as in "4 5 6". */
static const char *corners_text(char out[96], const cage *c, size_t facet)
{
    size_t used = 0;
    for (size_t k = 0; k < c->dim; k++)
        used += (size_t)snprintf(out + used, 96 - used, "%s%u", k > 0 ? " " : "",
                                 (unsigned)c->facets[facet * c->dim + k]);
    return out;
}

static int compare_facets(job *j)
{
    const cage *source = &j->cages[0], *target = &j->cages[1];
    char here[96], there[96];
    for (size_t i = 0; i < source->n_facets && i < target->n_facets; i++)
        if (memcmp(source->facets + i * source->dim, target->facets + i * target->dim,
                   source->dim * sizeof *source->facets) != 0)
            return failed(j->args->target, target->facet_lines[i],
                          "face %zu has the vertices %s (from 0), but %s in the source %s; the "
                          "faces must be the same, in the same order",
                          i, corners_text(here, target, i), corners_text(there, source, i),
                          j->args->source);
    if (source->n_facets != target->n_facets)
        return failed(j->args->target, 0, "%zu faces, but the source %s has %zu", target->n_facets,
                      j->args->source, source->n_facets);
    return DONE;
}

static void copy_facets(cage *to, const cage *from)
{
    size_t n = from->n_facets;
    to->n_facets = n;
    to->facets = need(n * from->dim, sizeof *to->facets);
    to->facet_lines = need(n, sizeof *to->facet_lines);
    memcpy(to->facets, from->facets, n * from->dim * sizeof *to->facets);
}

/* Compares the numbers of outlines. Regions alone have none. */
static int compare_outlines(job *j)
{
    size_t n[2] = {cage_outlines(&j->cages[0]), cage_outlines(&j->cages[1])};
    size_t side = n[1] > n[0];
    side_text where;
    if (n[0] == n[1])
        return DONE;
    if (n[0] == 0 || n[1] == 0)
        return failed(job_file(j, 2), 0, "%s%s", job_side(where, j, 2),
                      n[1] == 0 ? "no outline, but the source has one"
                                : "an outline, but the source has only regions");
    return failed(job_file(j, (int)side + 1), 0,
                  "%sthe shape has %zu parts, but the %s %zu; they correspond one by one%s",
                  job_side(where, j, (int)side + 1), n[side], side == 0 ? "target" : "source",
                  n[!side], cage_cut_text(&j->cages[side]));
}

int correspond(job *j)
{
    const cage *source = &j->cages[0];
    cage *target = &j->cages[1];
    side_text where;
    if (target->dim == 0)
        return DONE;
    if (target->cells != NULL)
        return failed(j->args->target, 0,
                      "a mask cannot be a target; use its boundary with the vertices moved "
                      "('libicc check --boundary' writes it)");
    if (source->dim != target->dim)
        return failed(j->args->target, 0, "%zu dimensions, but the source %s has %zu", target->dim,
                      j->args->source, source->dim);
    if (source->cells != NULL && source->n == 0)
        return DONE;
    if (source->dim == 2 && compare_outlines(j) != DONE)
        return FAILED;
    if (source->n != target->n)
        return failed(j->args->target, 0,
                      "%s%zu vertices, but the %s %s has %zu; they correspond one by one%s",
                      job_side(where, j, 2), target->n,
                      source->cells != NULL ? "boundary of the mask" : "source", j->args->source,
                      source->n,
                      source->dim == 2 ? " (--match auto pairs outlines that do not)" : "");
    problem wrong;
    if (source->dim == 3 && !cage_pair_parts(source, target, &wrong))
        return failed(j->args->target, wrong.line, "%s%s", job_side(where, j, 2), wrong.text);
    if (!features_correspond(source, target, &wrong))
        return failed(j->args->target, wrong.line, "%s%s", job_side(where, j, 2), wrong.text);
    int side;
    if (!ties_correspond(source, target, &side, &wrong))
        return failed(job_file(j, side), wrong.line, "%s%s", job_side(where, j, side), wrong.text);
    if (target->n_facets > 0)
        return compare_facets(j);
    if (source->n_facets > 0)
        copy_facets(target, source);
    return DONE;
}

void cage_take_boundary(cage *c, const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    icc_domain_get_info(domain, &info);
    c->n = info.n_vertices;
    c->n_facets = info.n_facets;
    c->points = need(c->n * c->dim, sizeof *c->points);
    c->lines = need(c->n, sizeof *c->lines);
    c->facets = need(c->n_facets * c->dim, sizeof *c->facets);
    c->facet_lines = need(c->n_facets, sizeof *c->facet_lines);
    icc_domain_get_boundary(domain, c->points, c->facets);
}
