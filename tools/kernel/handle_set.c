/* Reads the handles' file member by member. */
#include "kernel/handle_set.h"

#include "base/allocate.h"
#include "base/foreign.h"
#include "base/json_in.h"

#include <stdio.h>
#include <stdlib.h>

/* Reads the handles. The first one decides between the plane and space. */
static bool read_handles(handle_set *set, const json_item *list, problem *wrong)
{
    size_t n_coordinates = json_size(json_first(list));
    if (json_size(list) == 0)
        return spoilt(wrong, 0, "there is no list \"handles\" of points [x, y] or [x, y, z]");
    if (n_coordinates != 2 && n_coordinates != 3)
        return spoilt(wrong, 0, "handles[0] is not a point [x, y] or [x, y, z]");
    set->dim = n_coordinates;
    return json_points(list, "handles", set->dim, &set->n_handles, &set->handles, wrong);
}

/* Reads one of "lines". A parallel line may only refer to earlier ones. They count from 0 in the
 * file and from 1 in icc_line, where 0 means none. */
static bool read_line(handle_set *set, size_t i, const json_item *item, problem *wrong)
{
    static const char *const members[] = {"from", "to", "parallel", NULL};
    icc_line *line = &set->lines[i];
    char where[48], from[64], to[64], parallel[64];
    snprintf(where, sizeof where, "lines[%zu]", i);
    snprintf(from, sizeof from, "%s.from", where);
    snprintf(to, sizeof to, "%s.to", where);
    snprintf(parallel, sizeof parallel, "%s.parallel", where);
    if (!json_is_object(item, where, members, wrong) ||
        !json_reals(json_get(item, "from"), from, set->dim, line->from, wrong) ||
        !json_reals(json_get(item, "to"), to, set->dim, line->to, wrong))
        return false;
    const json_item *other = json_get(item, "parallel");
    uint32_t earlier;
    if (other == NULL)
        return true;
    if (!json_index(other, parallel, "line before it", i, &earlier, wrong))
        return false;
    line->parallel = (int32_t)earlier + 1;
    return true;
}

static bool read_lines(handle_set *set, const json_item *list, problem *wrong)
{
    if (!json_list(list, "lines", &set->n_lines, wrong))
        return false;
    set->lines = need(set->n_lines, sizeof *set->lines);
    size_t i = 0;
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item)) {
        if (!read_line(set, i++, item, wrong))
            return false;
    }
    return true;
}

static bool read_outline(outline *out, const json_item *list, const char *where, size_t dim,
                         problem *wrong)
{
    if (dim != 2)
        return spoilt(wrong, 0, "%s is a polygon, but the handles are in space", where);
    if (!json_points(list, where, 2, &out->n, &out->points, wrong))
        return false;
    const double *last = out->points + 2 * (out->n - (out->n > 0));
    if (out->n > 1 && last[0] == out->points[0] && last[1] == out->points[1])
        out->n--;
    return out->n >= 3 || spoilt(wrong, 0, "%s has %zu vert%s; a polygon has at least 3", where,
                                 out->n, out->n == 1 ? "ex" : "ices");
}

static bool read_regions(handle_set *set, const json_item *list, problem *wrong)
{
    if (!json_list(list, "regions", &set->n_regions, wrong))
        return false;
    set->regions = need(set->n_regions, sizeof *set->regions);
    size_t i = 0;
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item)) {
        char where[48];
        snprintf(where, sizeof where, "regions[%zu]", i);
        if (!read_outline(&set->regions[i++], item, where, set->dim, wrong))
            return false;
    }
    return true;
}

static bool read_curves(handle_set *set, const json_item *curves, problem *wrong)
{
    static const char *const members[] = {"vertices", "segments", NULL};
    return curves == NULL ||
           (json_is_object(curves, "curves", members, wrong) &&
            json_points(json_get(curves, "vertices"), "curves.vertices", set->dim, &set->n_vertices,
                        &set->vertices, wrong) &&
            json_pairs(json_get(curves, "segments"), "curves.segments", "vertex of the curves",
                       set->n_vertices, &set->n_segments, &set->segments, wrong));
}

static bool read_ball(double *centre, double *radius, const json_item *item, const char *where,
                      size_t dim, problem *wrong)
{
    char middle[64], size[64];
    snprintf(middle, sizeof middle, "%s.centre", where);
    snprintf(size, sizeof size, "%s.radius", where);
    return json_reals(json_get(item, "centre"), middle, dim, centre, wrong) &&
           json_real(json_get(item, "radius"), size, radius, wrong) &&
           (*radius > 0 || spoilt(wrong, 0, "%s must be above 0", size));
}

static bool read_stroke(const handle_set *set, stroke *out, const json_item *item,
                        const char *where, problem *wrong)
{
    static const char *const members[] = {"handle", "centre", "radius", "amount", "weights", NULL};
    char handle[64], amount[64], weights[64];
    snprintf(handle, sizeof handle, "%s.handle", where);
    snprintf(amount, sizeof amount, "%s.amount", where);
    snprintf(weights, sizeof weights, "%s.weights", where);
    if (!json_is_object(item, where, members, wrong))
        return false;
    if (json_get(item, "weights") == NULL)
        return json_index(json_get(item, "handle"), handle, "handle", set->n_handles, &out->handle,
                          wrong) &&
               read_ball(out->centre, &out->radius, item, where, set->dim, wrong) &&
               json_real(json_get(item, "amount"), amount, &out->amount, wrong);
    if (json_get(item, "handle") != NULL || json_get(item, "amount") != NULL)
        return spoilt(wrong, 0, "%s must have either \"weights\" or \"handle\" and \"amount\"",
                      where);
    out->weights = need(set->n_handles, sizeof *out->weights);
    return read_ball(out->centre, &out->radius, item, where, set->dim, wrong) &&
           json_reals(json_get(item, "weights"), weights, set->n_handles, out->weights, wrong);
}

static bool read_paint(handle_set *set, const json_item *list, problem *wrong)
{
    if (!json_list(list, "paint", &set->n_strokes, wrong))
        return false;
    set->strokes = need(set->n_strokes, sizeof *set->strokes);
    size_t i = 0;
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item)) {
        char where[48];
        snprintf(where, sizeof where, "paint[%zu]", i);
        if (!read_stroke(set, &set->strokes[i++], item, where, wrong))
            return false;
    }
    return true;
}

/* Reads one of "rigid": an outline or a ball, never both, and its stiffness compared with the
 * others. */
static bool read_part(rigid_part *part, const json_item *item, const char *where, size_t dim,
                      problem *wrong)
{
    static const char *const members[] = {"region", "centre", "radius", "rigidity", NULL};
    char region[64], rigidity[64];
    snprintf(region, sizeof region, "%s.region", where);
    snprintf(rigidity, sizeof rigidity, "%s.rigidity", where);
    part->rigidity = 1;
    if (!json_is_object(item, where, members, wrong))
        return false;
    if (json_get(item, "rigidity") != NULL &&
        !json_real(json_get(item, "rigidity"), rigidity, &part->rigidity, wrong))
        return false;
    if (!(part->rigidity > 0))
        return spoilt(wrong, 0, "%s must be above 0", rigidity);
    if ((json_get(item, "region") == NULL) == (json_get(item, "centre") == NULL))
        return spoilt(wrong, 0, "%s must have either a \"region\" or \"centre\" and \"radius\"",
                      where);
    return json_get(item, "region") != NULL
               ? read_outline(&part->region, json_get(item, "region"), region, dim, wrong)
               : read_ball(part->centre, &part->radius, item, where, dim, wrong);
}

static bool read_rigid(handle_set *set, const json_item *list, problem *wrong)
{
    if (!json_list(list, "rigid", &set->n_rigid, wrong))
        return false;
    set->rigid = need(set->n_rigid, sizeof *set->rigid);
    size_t i = 0;
    for (const json_item *item = json_first(list); item != NULL; item = json_next(item)) {
        char where[48];
        snprintf(where, sizeof where, "rigid[%zu]", i);
        if (!read_part(&set->rigid[i++], item, where, set->dim, wrong))
            return false;
    }
    return true;
}

static bool read_linear_edges(handle_set *set, const json_item *item, problem *wrong)
{
    if (item != NULL && !json_is(item, JSON_TRUE) && !json_is(item, JSON_FALSE))
        return spoilt(wrong, 0, "linear_edges must be true or false");
    set->linear_edges = json_is(item, JSON_TRUE);
    return !set->linear_edges || set->n_edges > 0 || spoilt(wrong, 0, "linear_edges needs edges");
}

bool handle_set_read(handle_set *out, const char *text, size_t n, problem *wrong)
{
    static const char *const members[] = {"handles", "edges", "lines",        "regions", "curves",
                                          "paint",   "rigid", "linear_edges", NULL};
    *out = (handle_set){0};
    json_tree tree = {0};
    bool good = !foreign_told(text, n, wrong) && json_tree_read(&tree, text, n, wrong);
    const json_item *file = tree.root;
    good = good && json_is_object(file, "the file", members, wrong) &&
           read_handles(out, json_get(file, "handles"), wrong) &&
           json_pairs(json_get(file, "edges"), "edges", "handle", out->n_handles, &out->n_edges,
                      &out->edges, wrong) &&
           read_linear_edges(out, json_get(file, "linear_edges"), wrong) &&
           read_lines(out, json_get(file, "lines"), wrong) &&
           read_regions(out, json_get(file, "regions"), wrong) &&
           read_curves(out, json_get(file, "curves"), wrong) &&
           read_paint(out, json_get(file, "paint"), wrong) &&
           read_rigid(out, json_get(file, "rigid"), wrong);
    json_tree_free(&tree);
    if (!good)
        handle_set_free(out);
    return good;
}

void handle_set_free(handle_set *set)
{
    for (size_t i = 0; set->regions != NULL && i < set->n_regions; i++)
        free(set->regions[i].points);
    for (size_t i = 0; set->rigid != NULL && i < set->n_rigid; i++)
        free(set->rigid[i].region.points);
    free(set->handles);
    free(set->edges);
    free(set->lines);
    free(set->regions);
    free(set->vertices);
    free(set->segments);
    for (size_t i = 0; set->strokes != NULL && i < set->n_strokes; i++)
        free(set->strokes[i].weights);
    free(set->strokes);
    free(set->rigid);
    *set = (handle_set){0};
}
