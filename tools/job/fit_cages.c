/* The constraints of a fit between cages: told vertices of the outline and the holes, vertices that
 * slide, and points and lines inside.
 *
 * A vertex slides along the straight line between the told vertices before and after it in the
 * target. */
#include "job/fit_cages.h"

#include "base/allocate.h"
#include "cage/cage_features.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The sine of the largest angle at which a wall counts as straight: one degree. */
static const double STRAIGHT = 0.0175;

typedef struct told {
    size_t n_vertices; /* of the outline and the holes */
    double *from, *to; /* 2 n_vertices each */
    size_t *lines;     /* in the target's file */
    size_t n_told, n_sliding;
    uint32_t *vertices, *sliding;
    double *places;              /* of told vertices */
    double *points, *directions; /* of the lines of sliding vertices */
    size_t n;
    icc_constraint *constraints;
} told;

static void add_ring(told *t, size_t n, const double *from, const double *to, const size_t *lines,
                     size_t line)
{
    memcpy(t->from + 2 * t->n_vertices, from, 2 * n * sizeof *from);
    memcpy(t->to + 2 * t->n_vertices, to, 2 * n * sizeof *to);
    for (size_t i = 0; i < n; i++)
        t->lines[t->n_vertices + i] = lines != NULL ? lines[i] : line;
    t->n_vertices += n;
}

static told start(const job *j)
{
    const cage *c = &j->cages[0], *d = &j->cages[1];
    told t = {.n = 0};
    size_t n = c->n, n_holes = cage_count(c, ICC_FEATURE_HOLE);
    for (size_t i = 0; i < n_holes; i++)
        n += c->features[i].n;
    t.from = need(n, 2 * sizeof *t.from);
    t.to = need(n, 2 * sizeof *t.to);
    t.lines = need(n, sizeof *t.lines);
    t.vertices = need(n, sizeof *t.vertices);
    t.sliding = need(n, sizeof *t.sliding);
    t.places = need(n, 2 * sizeof *t.places);
    t.points = need(n, 2 * sizeof *t.points);
    t.directions = need(n, 2 * sizeof *t.directions);
    t.constraints = need(c->n_features + 2, sizeof *t.constraints);
    add_ring(&t, c->n, c->points, d->points, d->lines, 0);
    for (size_t i = 0; i < n_holes; i++)
        add_ring(&t, c->features[i].n, c->features[i].points, d->features[i].points, NULL,
                 d->features[i].line);
    return t;
}

static void end(told *t)
{
    free(t->from);
    free(t->to);
    free(t->lines);
    free(t->vertices);
    free(t->sliding);
    free(t->places);
    free(t->points);
    free(t->directions);
    free(t->constraints);
}

bool fit_is_straight(const double *a, const double *v, const double *b)
{
    double x[2] = {v[0] - a[0], v[1] - a[1]}, y[2] = {b[0] - v[0], b[1] - v[1]};
    double size = hypot(x[0], x[1]) * hypot(y[0], y[1]);
    double along = x[0] * y[0] + x[1] * y[1];
    return fabs(x[0] * y[1] - x[1] * y[0]) <= STRAIGHT * size && along > 0;
}

/* Finds the line of a vertex of the outline of n vertices that slides. */
static int add_sliding(told *t, const job *j, size_t n, size_t v)
{
    size_t before = v, after = v;
    do
        before = (before + n - 1) % n;
    while (isnan(t->to[2 * before]) && before != v);
    do
        after = (after + 1) % n;
    while (isnan(t->to[2 * after]) && after != v);
    const double *p = t->to + 2 * before, *q = t->to + 2 * after;
    double direction[2] = {q[0] - p[0], q[1] - p[1]};
    size_t last = (v + n - 1) % n, next = (v + 1) % n;
    if (before == after || !(hypot(direction[0], direction[1]) > 0))
        return failed(
            j->args->target, t->lines[v],
            "a vertex slides along the line between the nearest vertices before and after "
            "it that have coordinates; here these are not two");
    if (!fit_is_straight(t->from + 2 * last, t->from + 2 * v, t->from + 2 * next))
        return failed(j->args->target, t->lines[v],
                      "this vertex cannot slide: the source has a corner there, so write where it "
                      "goes");
    t->sliding[t->n_sliding] = (uint32_t)v;
    memcpy(t->points + 2 * t->n_sliding, p, 2 * sizeof *p);
    memcpy(t->directions + 2 * t->n_sliding, direction, sizeof direction);
    t->n_sliding++;
    return DONE;
}

static void add_constraint(told *t, icc_constraint c)
{
    c.size = sizeof c;
    if (c.n > 0)
        t->constraints[t->n++] = c;
}

static int add_vertices(told *t, const job *j)
{
    int result = DONE;
    for (size_t v = 0; v < t->n_vertices && result == DONE; v++) {
        if (isnan(t->to[2 * v])) {
            result = add_sliding(t, j, j->cages[0].n, v);
        } else {
            t->vertices[t->n_told] = (uint32_t)v;
            memcpy(t->places + 2 * t->n_told++, t->to + 2 * v, 2 * sizeof *t->places);
        }
    }
    add_constraint(t, (icc_constraint){.kind = ICC_CONSTRAINT_VERTICES,
                                       .n = t->n_told,
                                       .vertices = t->vertices,
                                       .target = t->places});
    add_constraint(t, (icc_constraint){.kind = ICC_CONSTRAINT_SLIDING,
                                       .n = t->n_sliding,
                                       .vertices = t->sliding,
                                       .target = t->points,
                                       .direction = t->directions});
    return result;
}

static int add_features(told *t, const job *j)
{
    const cage *c = &j->cages[0], *d = &j->cages[1];
    for (size_t i = cage_count(c, ICC_FEATURE_HOLE); i < c->n_features; i++) {
        if (c->features[i].radius > 0)
            return failed(j->args->source, c->features[i].line,
                          "a point with a radius cannot be part of a fit (--reach, slide)");
        add_constraint(t, (icc_constraint){.kind = c->features[i].kind == ICC_FEATURE_LINE
                                                       ? ICC_CONSTRAINT_LINE
                                                       : ICC_CONSTRAINT_POINTS,
                                           .n = c->features[i].n,
                                           .source = c->features[i].points,
                                           .target = d->features[i].points});
    }
    return c->n_ties == 0
               ? DONE
               : failed(j->args->source, 0, "ties cannot be part of a fit (--reach, slide)");
}

/* The line in the target of an item, which is counted over all constraints. */
static size_t line_of_item(const told *t, const job *j, const icc_error *err)
{
    size_t i = (size_t)err->index, first = t->n_told + t->n_sliding;
    if (err->index < 0 || err->item != ICC_ITEM_POINT)
        return 0;
    if (i < t->n_told)
        return t->lines[t->vertices[i]];
    if (i < first)
        return t->lines[t->sliding[i - t->n_told]];
    const cage *d = &j->cages[1];
    for (size_t k = cage_count(d, ICC_FEATURE_HOLE); k < d->n_features; k++) {
        if (i - first < d->features[k].n)
            return d->features[k].line;
        first += d->features[k].n;
    }
    return 0;
}

int fit_failed(job *j, const char *file, size_t line, const icc_error *err)
{
    progress_end(&j->bar);
    return failed(file, line, "%s", job_message(err));
}

/* The outline with its holes alone. */
static icc_status make_region(icc_domain **out, const job *j, icc_error *err)
{
    cage c = j->cages[0];
    c.n_features = cage_count(&c, ICC_FEATURE_HOLE);
    return job_make_polygon(out, &c, &j->env, err);
}

/* Checks that every item has come to its place. */
static int check_reached(job *j)
{
    icc_fit_info info = {.size = sizeof info};
    icc_fit_get_info(j->fit, &info);
    progress_end(&j->bar);
    return info.n_off == 0 ? DONE
                           : failed(job_file(j, 2), 0,
                                    "no map was found: %zu vertices or points stay up to %g off, "
                                    "because the shape would fold or overlap on the way",
                                    info.n_off, info.most_off);
}

static int make_fit(job *j, const told *t)
{
    icc_error err = {.size = sizeof err, .index = -1};
    icc_domain *region = NULL;
    const icc_fit_options options = {
        .size = sizeof options, .model = ICC_FIT_ELASTIC, .reach = j->args->reach};
    icc_status status = make_region(&region, j, &err);
    if (status == ICC_OK)
        status =
            icc_fit_create(&j->fit, region, NULL, t->n, t->constraints, &options, &j->env, &err);
    icc_domain_free(region);
    if (status != ICC_OK)
        return fit_failed(j, job_file(j, 2), line_of_item(t, j, &err), &err);
    j->map = (icc_map *)(uintptr_t)icc_fit_map(j->fit);
    return check_reached(j);
}

/* Gives the vertices that slide their places. */
static int take_places(job *j, const told *t)
{
    cage *d = &j->cages[1];
    double *images = need(j->cages[0].n, 2 * sizeof *images);
    size_t n_failed = 0;
    icc_status status =
        icc_map_apply(j->map, j->cages[0].n, j->cages[0].points, images, NULL, &n_failed, &j->env);
    for (size_t i = 0; i < t->n_sliding && status == ICC_OK; i++)
        memcpy(d->points + 2 * (size_t)t->sliding[i], images + 2 * (size_t)t->sliding[i],
               2 * sizeof *images);
    d->n_sliding = 0;
    free(images);
    return status == ICC_OK ? DONE : job_failed_status(j, status);
}

/* True if the cages are such that a fit can be made between them. */
static int check_cages(job *j)
{
    if (job_dim(j) != 2 || j->cages[0].cells != NULL)
        return failed(j->args->source, 0, "--reach and slide are for outlines in the plane");
    if (j->domains[0] != NULL)
        return DONE;
    return job_make_domain(j, 0);
}

int fit_cages(job *j)
{
    int result = check_cages(j);
    if (result != DONE)
        return result;
    told t = start(j);
    result = add_vertices(&t, j);
    if (result == DONE)
        result = add_features(&t, j);
    if (result == DONE)
        result = make_fit(j, &t);
    if (result == DONE && t.n_sliding > 0)
        result = take_places(j, &t);
    end(&t);
    return result;
}
