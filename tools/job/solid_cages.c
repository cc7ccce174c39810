/* Reads the files of features of solids. */
#include "job/solid_cages.h"

#include "base/allocate.h"
#include "cage/cage_parts.h"
#include "cage/cage_read.h"
#include "cage/weld.h"
#include "solid/marks.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- surfaces ---- */

/* Adds the surface of a file. Both sides name their files by the same numbers. */
static int add_surface(job *j, size_t side, int32_t kind, const char *name, size_t number)
{
    cage surface;
    problem wrong;
    size_t n;
    const char *named;
    char *text = file_read_chosen(name, &n, &named), label[32];
    const cage_choice choice = {.role = CAGE_TARGET, .named = named};
    if (text == NULL)
        return FAILED;
    bool good = cage_read(&surface, &choice, 3, text, n, &wrong);
    free(text);
    if (!good)
        return failed(name, wrong.line, "%s", wrong.text);
    if (j->args->welds)
        weld(&surface, j->args->weld);
    if (surface.dim != 3 || surface.n_facets == 0 || surface.n_features > 0) {
        good = surface.n_features > 0;
        cage_free(&surface);
        return failed(name, 0,
                      good ? "there are several objects; --%s takes one closed surface a file"
                           : "this is no surface in space; --%s takes one closed surface a file",
                      kind == ICC_FEATURE_HOLE ? "void" : "surface");
    }
    snprintf(label, sizeof label, "%s %zu", kind == ICC_FEATURE_HOLE ? "void" : "surface", number);
    cage_add_solid_feature(&j->cages[side], kind, surface.n, surface.points, surface.n_facets,
                           surface.facets, label, strlen(label));
    cage_free(&surface);
    return DONE;
}

static int add_surfaces(job *j)
{
    const args *a = j->args;
    const file_list *lists[2][2] = {{&a->voids, &a->surfaces},
                                    {&a->target_voids, &a->target_surfaces}};
    int result = DONE;
    for (size_t side = 0; side < 2; side++)
        for (size_t k = 0; k < 2; k++)
            for (size_t i = 0; i < lists[side][k]->n && result == DONE; i++)
                result = add_surface(j, side, k == 0 ? ICC_FEATURE_HOLE : ICC_FEATURE_REGION,
                                     lists[side][k]->names[i], i + 1);
    return result;
}

/* ---- points and lines ---- */

static int read_marks(marks *out, mark_kind kind, const char *name)
{
    problem wrong;
    size_t n;
    char *text = file_read_shape(name, &n);
    *out = (marks){0};
    if (text == NULL)
        return FAILED;
    bool good = marks_read(out, kind, text, n, &wrong);
    free(text);
    return good ? DONE : failed(name, wrong.line, "%s", wrong.text);
}

/* Adds one side of marks to a cage. Marks without names are numbered. */
static void add_marks(cage *c, mark_kind kind, const marks *m, int side)
{
    for (size_t i = 0; i < m->n; i++) {
        const mark *own = &m->items[i];
        char number[32];
        snprintf(number, sizeof number, "%s %zu", kind == MARK_POINT ? "point" : "line", i + 1);
        const char *label = own->name[0] != '\0' ? own->name : number;
        cage_add_solid_feature(c, kind == MARK_POINT ? ICC_FEATURE_POINT : ICC_FEATURE_LINE,
                               own->n[side], own->points[side], 0, NULL, label, strlen(label))
            ->line = own->line;
    }
}

/* Adds the marks of a file with both sides, or of two files. */
static int add_mark_files(job *j, mark_kind kind, const char *source, const char *target)
{
    const char *option = kind == MARK_POINT ? "feature-points" : "feature-lines";
    marks m[2] = {{0}, {0}};
    bool has_target = j->cages[1].dim > 0;
    int result = read_marks(&m[0], kind, source);
    bool both = result == DONE && m[0].items[0].n[1] > 0;
    if (result == DONE && target != NULL)
        result = read_marks(&m[1], kind, target);
    if (result == DONE && target != NULL && (both || m[1].items[0].n[1] > 0))
        result = failed(both ? source : target, 0,
                        "the file has places in the source and in the target, so --target-%s must "
                        "be left out",
                        option);
    if (result == DONE && has_target && !both && target == NULL)
        result = failed(source, 0, "there are no places in the target; --target-%s FILE is missing",
                        option);
    if (result == DONE && strcmp(m[0].axes, m[1].axes) != 0 && m[0].axes[0] != '\0' &&
        m[1].axes[0] != '\0')
        result = failed(target, 0, "the axes are %s, but %s in the source's file %s", m[1].axes,
                        m[0].axes, source);
    if (result == DONE) {
        add_marks(&j->cages[0], kind, &m[0], 0);
        if (has_target)
            add_marks(&j->cages[1], kind, both ? &m[0] : &m[1], both);
    }
    marks_free(&m[0]);
    marks_free(&m[1]);
    return result;
}

/* ---- all ---- */

int solid_cages_add(job *j)
{
    const args *a = j->args;
    const bool wanted = a->voids.n + a->surfaces.n + a->target_voids.n + a->target_surfaces.n > 0 ||
                        a->feature_points != NULL || a->feature_lines != NULL;
    if (!wanted)
        return DONE;
    if (job_dim(j) != 3 || j->cages[0].cells != NULL)
        return failed(j->args->source, 0,
                      "this is no surface in space; --void, --surface, --feature-points and "
                      "--feature-lines need one");
    int result = add_surfaces(j);
    if (result == DONE && a->feature_lines != NULL)
        result = add_mark_files(j, MARK_LINE, a->feature_lines, a->target_feature_lines);
    if (result == DONE && a->feature_points != NULL)
        result = add_mark_files(j, MARK_POINT, a->feature_points, a->target_feature_points);
    return result;
}

icc_status job_make_solid(icc_domain **out, const cage *c, const icc_env *env, icc_error *err)
{
    icc_feature *features = need(c->n_features, sizeof *features);
    for (size_t i = 0; i < c->n_features; i++)
        features[i] =
            (icc_feature){.size = sizeof *features,
                          .kind = c->features[i].kind,
                          .n_vertices = c->features[i].n,
                          .vertices = c->features[i].points,
                          .n_facets = c->features[i].n_facets,
                          .facets = c->features[i].n_facets > 0 ? c->features[i].facets : NULL};
    icc_status status = icc_domain_create_solid(out, c->n, c->points, c->n_facets, c->facets,
                                                c->n_features, features, env, err);
    free(features);
    return status;
}
