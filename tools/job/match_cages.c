#include "job/match_cages.h"

#include "base/allocate.h"
#include "job/landmark_file.h"

#include <stdlib.h>
#include <string.h>

/* What matching takes of the time that is left then. */
static const double MATCHED = 0.2;

int match_check(const job *j)
{
    for (int side = 1; side <= 2; side++) {
        const cage *c = &j->cages[side - 1];
        side_text where;
        if (c->dim != 2)
            return failed(job_file(j, side), 0, "%s%zu dimension%s; --match is for the plane",
                          job_side(where, j, side), c->dim, c->dim == 1 ? "" : "s");
        if (c->n_more > 0)
            return failed(job_file(j, side), 0,
                          "%sthe MultiPolygon has %zu parts; --match takes one polygon",
                          job_side(where, j, side), 1 + c->n_more);
    }
    return DONE;
}

/* Landmarks are told by their lines; vertices by the cage, once they are common ones by number. */
static int refuse(job *j, icc_error *err, const table *landmarks)
{
    progress_end(&j->bar);
    if (err->item == ICC_ITEM_POINT && err->index >= 0 && (size_t)err->index < landmarks->n)
        return failed(j->args->landmarks, landmarks->lines[err->index], "%s", err->message);
    bool is_common = err->status == ICC_ERR_BOUNDARY;
    err->index = is_common ? -1 : err->index;
    return job_failed_with(j, err,
                           err->status == ICC_ERR_AMBIGUOUS ? " (--landmarks FILE, or --match arc)"
                           : is_common                      ? " (of the common vertices)"
                                                            : "");
}

static void take_common(cage *c, const icc_domain *domain, size_t n, const uint32_t *origin)
{
    cage common = {.dim = 2, .n = n, .n_heights = c->n_heights};
    common.points = need(n, 2 * sizeof *common.points);
    common.lines = need(n, sizeof *common.lines);
    icc_domain_get_boundary(domain, common.points, NULL);
    for (size_t i = 0; i < n && c->cells == NULL; i++)
        common.lines[i] = origin[i] != UINT32_MAX ? c->lines[origin[i]] : 0;
    cage_free(c);
    *c = common;
}

static void take(job *j, const icc_match *match)
{
    j->matched.size = sizeof j->matched;
    icc_match_get_info(match, &j->matched);
    size_t n = j->matched.n_vertices;
    uint32_t *origins = need(n, 2 * sizeof *origins);
    icc_match_get_origins(match, origins, origins + n);
    take_common(&j->cages[0], icc_match_source(match), n, origins);
    take_common(&j->cages[1], icc_match_target(match), n, origins + n);
    free(origins);
    for (size_t side = 0; side < 2; side++) {
        icc_domain_free(j->domains[side]);
        j->domains[side] = NULL;
    }
}

int match_cages(job *j)
{
    const args *a = j->args;
    table landmarks = {0};
    if (a->landmarks != NULL && landmarks_read(&landmarks, a->landmarks) != DONE)
        return FAILED;
    icc_match_options options = {.size = sizeof options, .turning = a->turning};
    options.between = strcmp(a->match, "arc") == 0 ? ICC_BETWEEN_ARC : ICC_BETWEEN_ELASTIC;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_match *match = NULL;
    progress_expect(&j->bar, MATCHED);
    icc_status status = icc_match_create(&match, j->domains[0], j->domains[1], landmarks.n,
                                         landmarks.values, &options, &j->env, &err);
    int result = DONE;
    if (status == ICC_OK)
        take(j, match);
    else
        result = refuse(j, &err, &landmarks);
    icc_match_free(match);
    table_free(&landmarks);
    return result;
}

void match_report(json *r, const icc_match_info *info)
{
    json_open(r, "match", '{');
    json_count(r, "landmarks", info->n_landmarks);
    json_count(r, "joined", info->n_joined);
    json_number(r, "cost", info->cost);
    json_number(r, "second", info->second);
    json_number(r, "sure", info->sure);
    json_number(r, "turn", info->turn);
    json_flag(r, "mirrored", info->mirrored != 0);
    json_number(r, "least_slope", info->least_slope);
    json_number(r, "most_slope", info->most_slope);
    json_close(r, '}');
}
