/* Makes cages from files, and domains from cages. */
#include "job/job.h"

#include "base/allocate.h"
#include "base/system.h"
#include "cage/cage_defects.h"
#include "cage/cage_degrees.h"
#include "cage/cage_features.h"
#include "cage/cage_read.h"
#include "cage/weld.h"
#include "job/correspond.h"
#include "job/fit_cages.h"
#include "job/frame_cages.h"
#include "job/layer_cages.h"
#include "job/match_cages.h"
#include "job/solid_cages.h"
#include "job/t_junctions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Both cages are welded in the same way, so that they still correspond if they did before. The
 * target may have only vertices; its faces are those of the welded source. */
static int join_vertices(job *j, size_t side)
{
    cage *c = &j->cages[side];
    if (j->args->welds && side == 0 && c->n_facets == 0)
        return failed(job_file(j, (int)side + 1), 0,
                      "this is not a surface in space; --weld needs one");
    if (j->args->welds && c->n_facets > 0)
        weld(c, j->args->weld);
    return DONE;
}

/* If y points down in one of two cages, reverses its y, so that both have the same orientation. */
static int flip_cage(job *j, size_t side)
{
    cage *c = &j->cages[side];
    if (j->args->y_down_side != (int32_t)side + SIDE_SOURCE)
        return DONE;
    if (c->dim != 2 || c->cells != NULL)
        return failed(job_file(j, (int)side + 1), 0,
                      "--y-down is for cages with vertices in the plane");
    cage_flip_y(c);
    return DONE;
}

/* Puts the name of a file into a remedy that is a call of this program. */
static const char *with_name(char out[512], const char *text, const char *name)
{
    static const char call[] = "'libicc fit FILE'";
    const char *at = strstr(text, call);
    if (at == NULL || strlen(name) > 200)
        return text;
    snprintf(out, 512, "%.*s'libicc fit %s'%s", (int)(at - text), text, name, at + sizeof call - 1);
    return out;
}

/* Reads a cage. If both cages are to correspond, its curves are cut into at least as many edges as
 * those of the other one, if that has been read. */
static int read_cage(job *j, size_t side, const char *named, const char *text, size_t n)
{
    problem wrong;
    const cage *other = &j->cages[!side];
    const cage_choice choice = {.role = side == 0 ? CAGE_SOURCE : CAGE_TARGET,
                                .named = named,
                                .may_slide = side == 1 && j->args->match == NULL,
                                .flat = {j->args->flatten,
                                         j->args->match == NULL ? other->n_curves : 0,
                                         other->curve_edges},
                                .like = other->n_simplices > 0 ? other : NULL};
    size_t dim = side == 0 ? 2 : job_dim(j);
    if (cage_read(&j->cages[side], &choice, dim, text, n, &wrong))
        return flip_cage(j, side) == DONE ? join_vertices(j, side) : FAILED;
    j->both = j->both || (j->args->target == NULL && cage_is_named(CAGE_TARGET, text, n));
    side_text where;
    char text_with_name[512];
    const char *name = job_file(j, (int)side + 1);
    return failed(name, wrong.line, "%s%s", job_side(where, j, (int)side + 1),
                  with_name(text_with_name, wrong.text, name));
}

/* Reads the target from its own file. If none is given, reads it from the source's file, if that
 * has one. A shape without features that was chosen by name stays alone if it may. */
static int read_target(job *j, const char *chosen, const char *text, size_t n)
{
    args *a = &j->own;
    if (a->target == NULL && !a->needs_target &&
        !(a->may_pair && (chosen == NULL || j->cages[0].n_features > 0)))
        return DONE;
    if (a->target == NULL && cage_is_named(CAGE_TARGET, text, n)) {
        a->target = a->source;
        j->both = true;
        return read_cage(j, 1, NULL, text, n);
    }
    if (a->target == NULL)
        return a->needs_target ? misused(a->command, "--target FILE is missing") : DONE;
    const char *named;
    char *own = file_read_chosen(a->target, &n, &named);
    int result = own != NULL ? read_cage(j, 1, named, own, n) : FAILED;
    free(own);
    return result;
}

/* Reads the source again if curves of the target needed more edges than its own. */
static int read_source_again(job *j, const char *named, const char *text, size_t n)
{
    cage *c = &j->cages[0];
    const cage *target = &j->cages[1];
    bool again = false;
    for (size_t k = 0; k < c->n_curves && k < target->n_curves; k++)
        again = again || c->curve_edges[k] < target->curve_edges[k];
    if (!again || !(j->args->flatten > 0) || j->args->match != NULL)
        return DONE;
    cage_free(c);
    return read_cage(j, 0, named, text, n);
}

static int check_curves(const job *j)
{
    bool curved = j->cages[0].n_curves + j->cages[1].n_curves > 0 || j->cages[0].of_picture;
    return j->args->flatten > 0 && !curved
               ? failed(
                     job_file(j, 1), 0,
                     "there are no curves to flatten; only SVG and outlines of pictures have them")
               : DONE;
}

/* Points in options must have as many coordinates as the cage. */
static int check_points(job *j)
{
    const args *a = j->args;
    const struct {
        const char *name;
        size_t n;
    } points[] = {{"maximum", a->n_maximum}, {"target-maximum", a->n_target_maximum}};
    for (size_t i = 0; i < 2; i++)
        if (points[i].n > 0 && points[i].n != job_dim(j))
            return misused(a->command, "--%s has %zu coordinates, but the cage %zu", points[i].name,
                           points[i].n, job_dim(j));
    if (j->cages[0].flipped)
        points_flip_y(1, j->own.maximum);
    if (a->y_down_side == SIDE_TARGET)
        points_flip_y(1, j->own.target_maximum);
    return DONE;
}

/* Reports an invalid boundary: names the line of the first defect and counts the others. */
static int failed_boundary(job *j, size_t side, const icc_error *err)
{
    const cage *c = &j->cages[side];
    defect_list list;
    size_t n_all;
    if (defects_find(&list, c, 1, &n_all, &j->env, NULL) != ICC_OK || list.n == 0)
        return job_failed(j, err);
    progress_end(&j->bar);
    char text[200], more[80] = "";
    if (n_all > 1)
        snprintf(more, sizeof more, " (%zu defects in all; 'libicc check' lists them)", n_all);
    side_text where;
    failed(job_file(j, (int)side + 1), c->lines[list.items[0]], "%s%s%s",
           job_side(where, j, (int)side + 1), defect_text(text, &list, 0, c), more);
    defects_free(&list);
    return FAILED;
}

/* Reports an invalid surface. The reason may only be that its faces do not share their vertices. */
static int failed_surface(job *j, size_t side, const icc_error *err)
{
    char hint[120] = "";
    size_t n = weld_count(&j->cages[side]);
    if (n > 0)
        snprintf(hint, sizeof hint,
                 "; %zu vertices coincide with others, as those of STL do: --weld joins them", n);
    return job_failed_with(j, err, hint);
}

/* Reports a vertex that lies on a side of another feature in one of two cages only. */
static int failed_on_side(job *j, size_t side)
{
    side_text where;
    const problem *found = &j->one_sided[side];
    progress_end(&j->bar);
    return failed(job_file(j, (int)side + 1), found->line, "%s%s",
                  job_side(where, j, (int)side + 1), found->text);
}

icc_status job_make_polygon(icc_domain **out, const cage *c, const icc_env *env, icc_error *err)
{
    icc_feature *features = need(c->n_features, sizeof *features);
    for (size_t i = 0; i < c->n_features; i++)
        features[i] = (icc_feature){.size = sizeof *features,
                                    .kind = c->features[i].kind,
                                    .n_vertices = c->features[i].n,
                                    .vertices = c->features[i].points,
                                    .radius = c->features[i].radius};
    icc_status status =
        icc_domain_create_features(out, c->n, c->points, c->n_features, features, env, err);
    free(features);
    return status;
}

int job_make_domain(job *j, size_t side)
{
    const cage *c = &j->cages[side];
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status status =
        c->cells != NULL && c->n == 0      ? icc_domain_create_mask(&j->made[side], (int32_t)c->dim,
                                                                    c->shape, c->cells, &j->env, &err)
        : c->n_features > 0 && c->dim == 3 ? job_make_solid(&j->made[side], c, &j->env, &err)
        : c->n_features > 0                ? job_make_polygon(&j->made[side], c, &j->env, &err)
                            : icc_domain_create(&j->made[side], (int32_t)c->dim, c->n, c->points,
                                                c->n_facets, c->facets, &j->env, &err);
    j->domains[side] = j->made[side];
    if (status == ICC_OK)
        return DONE;
    err.side = (int32_t)side + 1;
    if (err.item == ICC_ITEM_FEATURE && j->one_sided[side].text[0] != '\0')
        return failed_on_side(j, side);
    bool of_ring = status == ICC_ERR_BOUNDARY && c->dim == 2 && err.item != ICC_ITEM_FEATURE;
    return of_ring                               ? failed_boundary(j, side, &err)
           : c->cells == NULL && c->n_facets > 0 ? failed_surface(j, side, &err)
                                                 : job_failed(j, &err);
}

static int match(job *j)
{
    int result = match_check(j);
    for (size_t side = 0; side < 2 && result == DONE; side++)
        result = job_make_domain(j, side);
    return result == DONE ? match_cages(j) : result;
}

/* The domains of matched cages are made again. */
static int fill_holes(job *j)
{
    if (j->args->target == NULL)
        return failed(j->args->source, 0, "--fill-holes is for maps; --target FILE is missing");
    if (job_dim(j) != 2)
        return failed(j->args->source, 0, "--fill-holes is for cages in the plane");
    for (size_t side = 0; side < 2; side++)
        cage_fill_holes(&j->cages[side]);
    int result = DONE;
    for (size_t side = 0; side < 2 && result == DONE && j->match != NULL; side++) {
        icc_domain_free(j->made[side]);
        j->made[side] = NULL;
        result = job_make_domain(j, side);
    }
    return result;
}

/* True if features of two cages may share vertices. Boundaries of meshes have no more vertices than
 * their meshes, and the library has made those of matched cages. */
static bool may_touch(const job *j)
{
    const cage *source = &j->cages[0], *target = &j->cages[1];
    return source->n_features > 0 && target->dim == 2 && target->n_sliding == 0 &&
           j->match == NULL && source->n_simplices == 0 && target->n_simplices == 0;
}

int job_read_cages(job *j)
{
    if (job_dim(j) > 0)
        return DONE;
    if (j->args->by != NULL) {
        int read = layer_cages(j);
        j->seconds_read = seconds_now() - j->started;
        return read;
    }
    source_file own = {0};
    const source_file *s = j->source != NULL ? j->source : &own;
    if (j->source == NULL)
        own.text = file_read_chosen(job_file(j, 1), &own.n, &own.named);
    if (s->text == NULL)
        return FAILED;
    int result = read_cage(j, 0, s->named, s->text, s->n);
    if (result == DONE)
        result = check_points(j);
    if (result == DONE)
        result = read_target(j, s->named, s->text, s->n);
    if (result == DONE)
        result = read_source_again(j, s->named, s->text, s->n);
    free(own.text);
    if (result == DONE)
        result = solid_cages_add(j);
    if (result == DONE)
        result = check_curves(j);
    if (result == DONE && j->args->match != NULL)
        result = match(j);
    if (result == DONE && j->args->frame > 0)
        result = frame_cages(j);
    if (result == DONE)
        result = j->args->target != NULL ? correspond(j) : DONE;
    if (result == DONE && j->args->fill_holes)
        result = fill_holes(j);
    if (result == DONE && may_touch(j))
        t_junctions_add(j);
    if (result == DONE && j->cages[1].n_sliding > 0)
        result = fit_cages(j);
    j->seconds_read = seconds_now() - j->started;
    return result;
}

int job_read_plane(job *j, const char *what)
{
    int result = job_read_cages(j);
    if (result == DONE && job_dim(j) != 2)
        result = failed(j->args->source, 0, "%zu dimension%s; %s needs cages in the plane",
                        job_dim(j), job_dim(j) == 1 ? "" : "s", what);
    return result;
}

/* Makes the source's domain. The domain of a mask finds its boundary. */
static int make_source(job *j)
{
    int result = j->domains[0] == NULL ? job_make_domain(j, 0) : DONE;
    if (result != DONE || j->cages[0].cells == NULL)
        return result;
    cage_take_boundary(&j->cages[0], j->domains[0]);
    return correspond(j);
}

/* Prints remarks that may surprise, only after success, so that an error is one line. */
static void note_all(const job *j)
{
    match_note(j);
    for (size_t side = 0; side < 2; side++)
        if (j->cages[side].cut)
            note("%s: the polygons of the MultiPolygon are mapped as they are%s",
                 job_file(j, (int)side + 1), cage_cut_text(&j->cages[side]));
    for (size_t side = 0; side < 2; side++)
        if (j->cages[side].n_heights > 0)
            note("%s: heights are left out; a cage in the plane has x and y",
                 job_file(j, (int)side + 1));
    bool picture =
        strcmp(j->args->command, "warp") == 0 || strcmp(j->args->command, "animate") == 0;
    if (picture && j->cages[0].cells != NULL)
        note("%s: x is axis 0 of a mask, its rows; in the picture x counts columns",
             job_file(j, 1));
}

int job_make_domains(job *j)
{
    if (j->has_domains)
        return DONE;
    int result = job_read_cages(j);
    if (result == DONE && j->match == NULL)
        result = make_source(j);
    if (result == DONE && j->match == NULL && j->args->target != NULL)
        result = job_make_domain(j, 1);
    if (result == DONE)
        note_all(j);
    j->has_domains = result == DONE;
    return result;
}
