/* Makes cages of two layers. The library names regions by numbers, and its messages get the names
 * back. */
#include "job/layer_cages.h"

#include "base/allocate.h"
#include "base/file.h"
#include "job/layer_file.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Copies a message of the library, with names instead of the numbers behind "region". */
static void with_names(char *out, size_t room, const layers *l, const char *message)
{
    size_t n = 0;
    bool is_number = false;
    while (*message != '\0' && n + 1 < room) {
        if (strncmp(message, "region ", 7) == 0 || strncmp(message, "regions ", 8) == 0)
            is_number = true;
        char *end = NULL;
        size_t k = is_number && isdigit((unsigned char)*message) ? strtoul(message, &end, 10) : 0;
        if (end != NULL && k < l->n_names) {
            n += (size_t)snprintf(out + n, room - n, "\"%.60s\"", l->names[k]);
            n = n < room ? n : room - 1;
            is_number = strncmp(end, " and ", 5) == 0 && isdigit((unsigned char)end[5]);
            message = end;
        } else
            out[n++] = *message++;
    }
    out[n] = '\0';
}

/* Makes the cage of one side from features. */
static void take_cage(cage *c, size_t n, const icc_feature *features, const int64_t *ids)
{
    *c = (cage){.dim = 2, .n_features = n};
    c->points = need(1, sizeof *c->points);
    c->features = need(n, sizeof *c->features);
    for (size_t f = 0; f < n; f++) {
        const icc_feature *from = &features[f];
        const cage_feature *before = f > 0 && ids[f] == ids[f - 1] ? &c->features[f - 1] : NULL;
        cage_feature *to = &c->features[f];
        *to = (cage_feature){.kind = from->kind,
                             .number = ids[f] + 1,
                             .ring = before != NULL ? before->ring + 1 : 0,
                             .n = from->n_vertices};
        to->points = need(to->n, 2 * sizeof *to->points);
        memcpy(to->points, from->vertices, to->n * 2 * sizeof *to->points);
    }
}

static void take_cages(job *j, const icc_coverage *coverage, size_t n)
{
    const icc_feature *features[2];
    int64_t *ids = need(n, sizeof *ids);
    icc_coverage_get_features(coverage, &features[0], &features[1]);
    icc_coverage_get_ids(coverage, ids);
    for (int side = 0; side < 2; side++)
        take_cage(&j->cages[side], n, features[side], ids);
    free(ids);
}

/* Prints a table of what was done. */
static void tell(const job *j, const layers *l, const icc_coverage *coverage)
{
    icc_coverage_info info = {.size = sizeof info};
    icc_coverage_get_info(coverage, &info);
    if (j->args->quiet)
        return;
    note("%zu regions, %zu nodes, %zu borders, %zu islands, %zu common vertices (%zu of both "
         "layers)",
         info.n_regions, info.n_nodes, info.n_sides, info.n_islands, info.n_vertices,
         info.n_joined);
    for (int side = 0; side < 2; side++) {
        note("%s: %zu vertices, %zu welded, %zu put into sides; moved by %.3g at most, %.3g apart "
             "at least",
             side == 0 ? "source" : "target", info.n_given[side], info.n_welded[side],
             info.n_inserted[side], info.most_moved[side], info.least_apart[side]);
        if (info.n_chains[side] > 0)
            note("%s: %zu vertices would chain, one near (%.6g, %.6g): --weld is too long or too "
                 "short",
                 side == 0 ? "source" : "target", info.n_chains[side], info.chain[2 * side],
                 info.chain[2 * side + 1]);
    }
    for (size_t k = 0; k < info.n_differences; k++) {
        icc_coverage_difference d = {.size = sizeof d};
        icc_coverage_get_difference(coverage, k, &d);
        note("%s only: the %s of \"%.60s\"%s%.60s%s near (%.6g, %.6g)",
             d.side == 1 ? "source" : "target",
             d.kind == ICC_DIFFERENCE_REGION ? "whole" : "border", l->names[d.ids[0]],
             d.n_ids > 1 ? " and \"" : "", d.n_ids > 1 ? l->names[d.ids[1]] : "",
             d.n_ids > 1 ? "\"" : "", d.place[0], d.place[1]);
    }
}

/* Makes the coverage, and cages from it. */
static int make(job *j, const layers *l)
{
    const args *a = j->args;
    const icc_layer given[2] = {layers_side(l, 0), layers_side(l, 1)};
    icc_coverage *coverage;
    icc_error err = {.size = sizeof err, .index = -1};
    const icc_coverage_options options = {.size = sizeof options,
                                          .weld = {a->weld, a->weld},
                                          .unmatched = a->leaves_out ? ICC_UNMATCHED_LEAVE_OUT : 0};
    icc_status status =
        icc_coverage_create(&coverage, &given[0], &given[1], &options, &j->env, &err);
    if (status != ICC_OK) {
        char text[sizeof err.message];
        progress_end(&j->bar);
        with_names(text, sizeof text, l, job_message(&err));
        return failed(err.side != 0 ? job_file(j, err.side) : NULL, 0, "%s", text);
    }
    icc_coverage_info info = {.size = sizeof info};
    icc_coverage_get_info(coverage, &info);
    take_cages(j, coverage, info.n_features);
    tell(j, l, coverage);
    icc_coverage_free(coverage);
    return DONE;
}

int layer_cages(job *j)
{
    layers l = {0};
    int result = DONE;
    for (int side = 0; side < 2 && result == DONE; side++) {
        problem wrong;
        size_t n;
        char *text = file_read(job_file(j, side + 1), &n);
        if (text == NULL)
            result = FAILED;
        else if (!layers_read(&l, side, text, n, j->args->by, &wrong))
            result = failed(job_file(j, side + 1), wrong.line, "%s", wrong.text);
    }
    if (result == DONE) {
        layers_number(&l);
        result = make(j, &l);
    }
    layers_free(&l);
    return result;
}
