/* Matches two cages and replaces them by cages with common vertices. */
#include "job/match_cages.h"

#include "base/allocate.h"
#include "cage/cage_features.h"
#include "job/landmark_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The share of the remaining time that matching takes. */
static const double MATCHED = 0.2;

/* In degrees. A larger turn is rarely meant. */
static const double LARGE_TURN = 45;

int match_check(const job *j)
{
    for (int side = 1; side <= 2; side++) {
        const cage *c = &j->cages[side - 1];
        side_text where;
        if (c->dim != 2 && c->dim != 3)
            return failed(job_file(j, side), 0,
                          "%s%zu dimension%s; --match is for the plane and for surfaces",
                          job_side(where, j, side), c->dim, c->dim == 1 ? "" : "s");
    }
    return DONE;
}

/* Reports a refused match. Landmarks are named by their lines. Vertices are named by the cage, if
 * they are common vertices, by number. */
static int refuse(job *j, icc_error *err, const table *landmarks)
{
    progress_end(&j->bar);
    if (err->item == ICC_ITEM_POINT && err->index >= 0 && (size_t)err->index < landmarks->n)
        return failed(j->args->landmarks, landmarks->lines[err->index], "%s", err->message);
    bool is_common = err->status == ICC_ERR_BOUNDARY && err->index >= 0;
    err->index = is_common ? -1 : err->index;
    return job_failed_with(j, err,
                           is_common                          ? " (of the common vertices)"
                           : err->status != ICC_ERR_AMBIGUOUS ? ""
                           : err->item == ICC_ITEM_FEATURE    ? " (--landmarks FILE)"
                           : strstr(err->message, "mirror") != NULL && j->args->flips_cages
                               ? " (--y-down=source or --y-down=target; else --landmarks FILE)"
                               : " (--landmarks FILE, or --match arc)");
}

/* The feature of a cage to which a vertex of its domain belongs. */
static const cage_feature *feature_of(const cage *c, size_t vertex)
{
    size_t end = c->n;
    const cage_feature *f = c->features;
    while ((end += f->n) <= vertex)
        f++;
    return f;
}

/* Takes the holes, lines and points of one side, with their numbers in the source. */
static void take_features(cage *common, const cage *given, const cage *source,
                          const icc_domain *domain, const double *points, const uint32_t *origin)
{
    common->n_features = given->n_features;
    common->features = need(given->n_features, sizeof *common->features);
    for (size_t i = 0; i < given->n_features; i++) {
        icc_feature_info info = {.size = sizeof info};
        icc_domain_get_feature(domain, i, &info);
        size_t known = info.first_vertex, n = info.n_vertices;
        while (origin[known] == UINT32_MAX)
            known++;
        cage_feature *f = &common->features[i];
        *f = *feature_of(given, origin[known]);
        f->number = source->features[i].number;
        f->ring = source->features[i].ring;
        f->item = source->features[i].item;
        f->n = n;
        f->points = need(n, 2 * sizeof *f->points);
        memcpy(f->points, points + 2 * info.first_vertex, n * 2 * sizeof *f->points);
    }
}

/* The vertices and faces have no lines for messages. */
static cage common_surface(const icc_domain *domain, const icc_domain_info *size)
{
    cage c = {.dim = 3, .n = size->n_vertices, .n_facets = size->n_facets};
    c.points = need(c.n, 3 * sizeof *c.points);
    c.facets = need(c.n_facets, 3 * sizeof *c.facets);
    c.lines = need(c.n, sizeof *c.lines);
    c.facet_lines = need(c.n_facets, sizeof *c.facet_lines);
    memset(c.lines, 0, c.n * sizeof *c.lines);
    memset(c.facet_lines, 0, c.n_facets * sizeof *c.facet_lines);
    icc_domain_get_boundary(domain, c.points, c.facets);
    return c;
}

static cage common_cage(const cage *given, const cage *source, const icc_domain *domain,
                        const uint32_t *origin)
{
    icc_domain_info size = {.size = sizeof size};
    icc_feature_info first = {.size = sizeof first};
    icc_domain_get_info(domain, &size);
    if (size.dim == 3)
        return common_surface(domain, &size);
    bool has_features = icc_domain_get_feature(domain, 0, &first) == ICC_OK;
    cage c = {.dim = 2,
              .flipped = given->flipped,
              .n = has_features ? first.first_vertex : size.n_vertices};
    c.n_heights = given->n_heights;
    c.points = need(size.n_vertices, 2 * sizeof *c.points);
    c.lines = need(c.n, sizeof *c.lines);
    icc_domain_get_boundary(domain, c.points, NULL);
    for (size_t i = 0; i < c.n && given->cells == NULL; i++)
        c.lines[i] = origin[i] != UINT32_MAX ? given->lines[origin[i]] : 0;
    take_features(&c, given, source, domain, c.points, origin);
    return c;
}

static void take(job *j)
{
    j->matched.size = sizeof j->matched;
    icc_match_get_info(j->match, &j->matched);
    size_t n = j->matched.n_vertices;
    uint32_t *origins = need(n, 2 * sizeof *origins);
    icc_match_get_origins(j->match, origins, origins + n);
    j->domains[0] = icc_match_source(j->match);
    j->domains[1] = icc_match_target(j->match);
    cage common[2];
    for (size_t side = 0; side < 2; side++)
        common[side] =
            common_cage(&j->cages[side], &j->cages[0], j->domains[side], origins + side * n);
    for (size_t side = 0; side < 2; side++) {
        cage_free(&j->cages[side]);
        j->cages[side] = common[side];
        icc_domain_free(j->made[side]);
        j->made[side] = NULL;
    }
    free(origins);
}

int match_cages(job *j)
{
    const args *a = j->args;
    table landmarks = {0};
    if (a->landmarks != NULL && landmarks_read(&landmarks, a->landmarks, job_dim(j)) != DONE)
        return FAILED;
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; j->cages[side].flipped && i < landmarks.n; i++)
            points_flip_y(1, landmarks.values + 4 * i + 2 * side);
    icc_match_options options = {
        .size = sizeof options, .turning = a->turning, .keep_source = a->keep_source};
    options.between = strcmp(a->match, "arc") == 0 ? ICC_BETWEEN_ARC : ICC_BETWEEN_ELASTIC;
    icc_error err = {.size = sizeof err, .index = -1};
    progress_expect(&j->bar, MATCHED);
    icc_status status = icc_match_create(&j->match, j->domains[0], j->domains[1], landmarks.n,
                                         landmarks.values, &options, &j->env, &err);
    int result = DONE;
    if (status == ICC_OK)
        take(j);
    else
        result = refuse(j, &err, &landmarks);
    table_free(&landmarks);
    return result;
}

void match_note(const job *j)
{
    const char *asks = j->args->flips_cages
                           ? "is y down in one of them? (--y-down=source or --y-down=target)"
                           : "is y down in one of the two only?";
    const icc_match_info *info = &j->matched;
    char turned[48];
    bool large = fabs(info->turn) > LARGE_TURN && j->args->turning != ICC_TURNING_FREE;
    if (info->dim != 2 || !(large || info->mirrored))
        return;
    snprintf(turned, sizeof turned, "turned by %.0f degrees to match", info->turn);
    if (info->mirrored)
        note("%s: %s, but the mirror image fits better; %s", job_file(j, 2), turned, asks);
    else
        note("%s: %s; if that is not meant, %s", job_file(j, 2), turned, asks);
}

void match_report(json *r, const icc_match_info *info)
{
    json_open(r, "match", '{');
    json_count(r, "landmarks", info->n_landmarks);
    json_count(r, "joined", info->n_joined);
    if (info->dim == 2) {
        json_number(r, "cost", info->cost);
        json_number(r, "second", info->second);
        json_number(r, "sure", info->sure);
        json_number(r, "turn", info->turn);
        json_flag(r, "mirrored", info->mirrored != 0);
    } else {
        json_count(r, "overlay", info->n_overlay);
        json_number(r, "energy", info->energy);
        json_number(r, "off", info->off);
        json_number(r, "least_angle", info->least_angle);
    }
    json_number(r, "least_slope", info->least_slope);
    json_number(r, "most_slope", info->most_slope);
    json_close(r, '}');
}
