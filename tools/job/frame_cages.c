/* Makes rectangles the outer rings of cages, and their former rings closed lines. */
#include "job/frame_cages.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int check(const job *j, int side)
{
    const cage *c = &j->cages[side - 1];
    side_text where;
    if (c->dim != 2 || c->cells != NULL || c->n_simplices > 0 || c->n_sliding > 0)
        return failed(job_file(j, side), 0,
                      "%s--frame is for outlines in the plane, all of whose vertices are known",
                      job_side(where, j, side));
    return DONE;
}

/* The largest number of a feature in both cages. */
static int64_t last_number(const job *j)
{
    int64_t last = 0;
    for (size_t side = 0; side < 2; side++)
        for (size_t i = 0; i < j->cages[side].n_features; i++)
            if (j->cages[side].features[i].number > last)
                last = j->cages[side].features[i].number;
    return last;
}

/* Stretches a box by points. */
static void include(double box[4], size_t n, const double *points)
{
    for (size_t i = 0; i < 2 * n; i++) {
        box[i % 2] = fmin(box[i % 2], points[i]);
        box[2 + i % 2] = fmax(box[2 + i % 2], points[i]);
    }
}

/* A ring as a line that ends where it begins. */
static cage_feature close_ring(size_t n, const double *points, size_t line, int64_t number)
{
    cage_feature out = {.kind = ICC_FEATURE_LINE, .number = number, .n = n + 1, .line = line};
    out.points = need(n + 1, 2 * sizeof *out.points);
    memcpy(out.points, points, 2 * n * sizeof *points);
    memcpy(out.points + 2 * n, points, 2 * sizeof *points);
    return out;
}

/* Regions with numbers stay regions. */
static bool becomes_line(const cage_feature *f)
{
    return f->kind == ICC_FEATURE_HOLE || (f->kind == ICC_FEATURE_REGION && f->of_outline);
}

/* Puts the rings after all other features, with the numbers after `last`. */
static void lines_from_rings(cage *c, int64_t last)
{
    cage_feature *all = need(c->n_features + 1, sizeof *all);
    size_t n = 0;
    for (size_t i = 0; i < c->n_features; i++)
        if (!becomes_line(&c->features[i]))
            all[n++] = c->features[i];
    if (c->n > 0)
        all[n++] = close_ring(c->n, c->points, c->lines[0], ++last);
    for (size_t i = 0; i < c->n_features; i++) {
        cage_feature *f = &c->features[i];
        if (!becomes_line(f))
            continue;
        all[n++] = close_ring(f->n, f->points, f->line, ++last);
        free(f->points);
    }
    free(c->features);
    c->features = all;
    c->n_features = c->room_features = n;
}

static void put_frame(cage *c, double share, int64_t last)
{
    double box[4] = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    include(box, c->n, c->points);
    for (size_t i = 0; i < c->n_features; i++)
        include(box, c->features[i].n, c->features[i].points);
    double margin = share * fmax(box[2] - box[0], box[3] - box[1]);
    const double x[2] = {box[0] - margin, box[2] + margin};
    const double y[2] = {box[1] - margin, box[3] + margin};
    lines_from_rings(c, last);
    c->n = 0;
    for (size_t i = 0; i < 4; i++)
        cage_add(c, x[i == 1 || i == 2], y[i >= 2], 0);
}

int frame_cages(job *j)
{
    for (int side = 1; side <= 2; side++)
        if (j->cages[side - 1].dim > 0 && check(j, side) != DONE)
            return FAILED;
    int64_t last = last_number(j);
    for (size_t side = 0; side < 2; side++)
        if (j->cages[side].dim > 0)
            put_frame(&j->cages[side], j->args->frame, last);
    icc_match_free(j->match); /* its domains have no frames */
    j->match = NULL;
    j->domains[0] = j->domains[1] = NULL;
    return DONE;
}
