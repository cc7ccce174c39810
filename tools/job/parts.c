/* Divides a job of several polygons into parts. */
#include "job/parts.h"

#include "base/allocate.h"
#include "cage/cage_degrees.h"
#include "cage/cage_features.h"
#include "job/correspond.h"
#include "job/nesting.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t count_polygons(const cage *c)
{
    return c->dim == 0 ? 0 : 1 + c->n_more;
}

/* Reports why the cages cannot have a map for each polygon. */
static int check_cages(const job *j)
{
    const args *a = j->args;
    size_t n[2] = {count_polygons(&j->cages[0]), count_polygons(&j->cages[1])};
    side_text where;
    if (a->target == NULL && n[0] == 1)
        return failed(a->source, 0, "--fill-holes is for maps; --target FILE is missing");
    if (a->target == NULL)
        return failed(
            a->source, 0,
            "the shape has %zu parts; only maps take several, and --target FILE is missing%s", n[0],
            cage_cut_text(&j->cages[0]));
    if (n[0] != n[1]) {
        size_t side = n[1] > n[0];
        return failed(job_file(j, (int)side + 1), 0,
                      "%sthe shape has %zu parts, but the %s %zu; they correspond one by one%s",
                      job_side(where, j, (int)side + 1), n[side], side == 0 ? "target" : "source",
                      n[!side], cage_cut_text(&j->cages[side]));
    }
    if (!a->takes_parts)
        return failed(a->source, 0,
                      "the shape has %zu parts; make one map per part for libicc %s%s", n[0],
                      a->command, cage_cut_text(&j->cages[0]));
    if (j->cages[0].n_ties > 0)
        return failed(a->source, 0, "ties need a cage of a single polygon");
    return DONE;
}

/* ------------------------------------------------------------------ polygons */

static void add_ring(cage *c, int32_t kind, size_t n, const double *points)
{
    size_t first = c->n;
    for (size_t i = 0; i < n; i++)
        cage_add(c, points[2 * i], points[2 * i + 1], 0);
    if (kind != 0)
        cage_add_feature(c, kind, (int64_t)c->n_features + 1, first);
}

/* Makes the inside of a hole: its ring, with the polygons directly in it as holes. */
static void fill_hole(cage *out, const cage *all, const cage_hole *nesting, cage_hole place)
{
    const cage_feature *hole = &cage_polygon(all, place.polygon)->features[place.hole];
    out->dim = 2;
    out->flipped = all->flipped;
    add_ring(out, 0, hole->n, hole->points);
    for (size_t i = 0; i <= all->n_more; i++)
        if (nesting[i].polygon == place.polygon && nesting[i].hole == place.hole)
            add_ring(out, ICC_FEATURE_HOLE, cage_polygon(all, i)->n, cage_polygon(all, i)->points);
}

static job *add_part(job *j)
{
    job *part = &j->parts[j->n_parts++];
    *part = (job){.own = j->own, .both = j->both, .env = j->env, .started = j->started};
    part->args = &part->own;
    return part;
}

/* Makes a part for each polygon after the first, which it takes over, and for each hole to be
 * filled. */
static void make_parts(job *j, const cage_hole *nesting)
{
    size_t n = j->cages[0].n_more, n_holes = 0, n_filled = 0;
    for (size_t i = 0; i <= n && j->args->fill_holes; i++)
        n_holes += cage_count(cage_polygon(&j->cages[0], i), ICC_FEATURE_HOLE);
    j->parts = need(n + n_holes, sizeof *j->parts);
    j->n_parts = n;
    for (size_t i = 0; i <= n && j->args->fill_holes; i++)
        for (size_t h = 0; h < cage_count(cage_polygon(&j->cages[0], i), ICC_FEATURE_HOLE); h++) {
            job *part = add_part(j);
            part->place = (cage_hole){i, h};
            snprintf(part->name, sizeof part->name, "inside of hole %zu: ", ++n_filled);
            for (size_t side = 0; side < 2; side++)
                fill_hole(&part->cages[side], &j->cages[side], nesting, (cage_hole){i, h});
        }
    j->n_parts = 0;
    j->place = nesting[0];
    j->n_polygons = n + 1;
    for (size_t i = 0; i < n; i++) {
        job *part = add_part(j);
        part->place = nesting[i + 1];
        snprintf(part->name, sizeof part->name, "polygon %zu: ", i + 2);
        for (size_t side = 0; side < 2; side++) {
            part->cages[side] = j->cages[side].more[i];
            j->cages[side].more[i] = (cage){0};
        }
    }
    j->n_parts = n + n_holes;
}

/* ----------------------------------------------------------- lines and points */

static const job *part_of(const job *j, size_t k)
{
    return k == 0 ? j : &j->parts[k - 1];
}

/* True if a point is in a polygon and in none of its holes. */
static bool polygon_holds(const cage *c, const double *point)
{
    bool holds = ring_holds(c->n, c->points, point);
    for (size_t i = 0; i < c->n_features && holds; i++)
        holds = c->features[i].kind != ICC_FEATURE_HOLE ||
                !ring_holds(c->features[i].n, c->features[i].points, point);
    return holds;
}

/* The part that contains the beginning of a feature. If there is none, the first part, which will
 * then refuse it. */
static size_t find_part(const job *j, size_t side, const double *point)
{
    for (size_t k = 0; k <= j->n_parts; k++)
        if (polygon_holds(&part_of(j, k)->cages[side], point))
            return k;
    return 0;
}

/* Adds a feature at the end of a part's features. */
static void move_feature(cage *to, cage_feature *f)
{
    to->features = grow(to->features, &to->room_features, to->n_features + 1, sizeof *to->features);
    to->features[to->n_features++] = *f;
}

/* Moves lines and points, which have all been read to the first polygon, to the polygons that
 * contain them. */
static int share_features(job *j)
{
    size_t n_holes = cage_count(&j->cages[0], ICC_FEATURE_HOLE), n = j->cages[0].n_features;
    size_t *parts[2] = {need(n, sizeof(size_t)), need(n, sizeof(size_t))};
    int result = DONE;
    for (size_t side = 0; side < 2; side++)
        for (size_t i = n_holes; i < n; i++)
            parts[side][i] = find_part(j, side, j->cages[side].features[i].points);
    for (size_t i = n_holes; i < n && result == DONE; i++) {
        feature_text name;
        const cage_feature *f = &j->cages[1].features[i];
        side_text where;
        if (parts[0][i] != parts[1][i])
            result =
                failed(job_file(j, 2), f->line, "%s%s is in another polygon than in the source",
                       job_side(where, j, 2), feature_name(name, f));
    }
    for (size_t side = 0; side < 2 && result == DONE; side++) {
        cage *c = &j->cages[side];
        c->n_features = n_holes;
        for (size_t i = n_holes; i < n; i++)
            move_feature(parts[side][i] == 0 ? c : &j->parts[parts[side][i] - 1].cages[side],
                         &c->features[i]);
    }
    free(parts[0]);
    free(parts[1]);
    return result;
}

/* ---------------------------------------------------------------------- all */

static int check_nesting(const job *j, const cage_hole *source)
{
    for (size_t i = 0; i <= j->cages[0].n_more; i++) {
        cage_hole target = nesting_of(&j->cages[1], i);
        side_text where;
        if (target.polygon != source[i].polygon || target.hole != source[i].hole)
            return failed(
                job_file(j, 2), 0,
                "%spolygon %zu lies in another hole than in the source, or one of them in "
                "none",
                job_side(where, j, 2), i + 1);
    }
    return DONE;
}

int parts_make(job *j)
{
    const cage *c = j->cages;
    side_text where;
    bool fills = j->args->fill_holes && cage_count(&c[0], ICC_FEATURE_HOLE) > 0;
    if (c[0].n_more + c[1].n_more == 0 && !fills)
        return j->args->target != NULL ? correspond(j) : DONE;
    if (c[0].n == 0)
        return failed(job_file(j, 1), 0,
                      "--fill-holes needs one map for each polygon, but these are one domain; "
                      "'libicc match' writes matched polygons to a file");
    int result = check_cages(j);
    if (result == DONE)
        result = correspond(j);
    for (size_t i = 0; i < c[0].n_more && result == DONE; i++)
        if (cage_count(&c[0].more[i], ICC_FEATURE_HOLE) !=
            cage_count(&c[1].more[i], ICC_FEATURE_HOLE))
            result = failed(job_file(j, 2), 0, "%spolygon %zu has other holes than in the source",
                            job_side(where, j, 2), i + 2);
    if (result != DONE)
        return result;
    cage_hole *nesting = need(c[0].n_more + 1, sizeof *nesting);
    for (size_t i = 0; i <= c[0].n_more; i++)
        nesting[i] = nesting_of(&c[0], i);
    result = check_nesting(j, nesting);
    if (result == DONE)
        make_parts(j, nesting);
    if (result == DONE)
        result = share_features(j);
    if (result == DONE && j->n_polygons > 1)
        snprintf(j->name, sizeof j->name, "polygon 1: ");
    for (size_t i = 0; i < j->n_parts && result == DONE; i++)
        result = correspond(&j->parts[i]);
    free(nesting);
    return result;
}

/* ------------------------------------------------------------------- apart */

typedef struct ring_list {
    size_t n;
    icc_feature *rings;
    size_t *polygons; /* the polygon of each ring */
} ring_list;

/* Takes rings as holes of an outer one. The library then decides exactly if they lie in it and do
 * not meet. */
static int check_apart(job *j, size_t side, size_t n, const double *outer, const ring_list *list)
{
    icc_domain *domain = NULL;
    icc_error err = {.size = sizeof err, .index = -1};
    side_text where;
    icc_status status =
        icc_domain_create_features(&domain, n, outer, list->n, list->rings, &j->env, &err);
    icc_domain_free(domain);
    if (status == ICC_OK)
        return DONE;
    progress_end(&j->bar);
    job plain = *j;
    plain.name[0] = '\0';
    err.side = (int32_t)side + 1;
    if (err.item != ICC_ITEM_FEATURE || err.index < 0 || (size_t)err.index >= list->n)
        return job_failed(j, &err);
    return failed(job_file(j, (int)side + 1), 0,
                  "%spolygon %zu meets another one, or the hole that it is in",
                  job_side(where, &plain, (int)side + 1), list->polygons[err.index] + 1);
}

static void list_ring(ring_list *list, const cage *c, size_t polygon)
{
    list->polygons[list->n] = polygon;
    list->rings[list->n++] = (icc_feature){.size = sizeof *list->rings,
                                           .kind = ICC_FEATURE_HOLE,
                                           .n_vertices = c->n,
                                           .vertices = c->points};
}

/* A box far around all polygons. */
static void box_round(double out[8], const job *j, size_t side, size_t n_polygons)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t k = 0; k < n_polygons; k++) {
        const cage *c = &part_of(j, k)->cages[side];
        for (size_t i = 0; i < 2 * c->n; i++) {
            lower[i % 2] = fmin(lower[i % 2], c->points[i]);
            upper[i % 2] = fmax(upper[i % 2], c->points[i]);
        }
    }
    double width = upper[0] - lower[0], height = upper[1] - lower[1];
    const double box[] = {lower[0] - width, lower[1] - height, upper[0] + width, lower[1] - height,
                          upper[0] + width, upper[1] + height, lower[0] - width, upper[1] + height};
    memcpy(out, box, sizeof box);
}

/* Polygons that lie in no hole must not meet, nor polygons in the same hole. The inside of a filled
 * hole is a polygon itself, which has been checked. */
static int check_side(job *j, size_t side)
{
    size_t n = j->n_polygons;
    ring_list list = {.rings = need(n, sizeof(icc_feature)), .polygons = need(n, sizeof(size_t))};
    double box[8];
    box_round(box, j, side, n);
    for (size_t k = 0; k < n; k++)
        if (part_of(j, k)->place.polygon == NO_HOLE)
            list_ring(&list, &part_of(j, k)->cages[side], k);
    int result = list.n > 1 ? check_apart(j, side, 4, box, &list) : DONE;
    for (size_t k = 0; k < n && result == DONE; k++) {
        const cage *c = &part_of(j, k)->cages[side];
        for (size_t h = 0; h < cage_count(c, ICC_FEATURE_HOLE) && result == DONE; h++) {
            list.n = 0;
            for (size_t i = 0; i < n; i++)
                if (part_of(j, i)->place.polygon == k && part_of(j, i)->place.hole == h)
                    list_ring(&list, &part_of(j, i)->cages[side], i);
            if (list.n > 0)
                result = check_apart(j, side, c->features[h].n, c->features[h].points, &list);
        }
    }
    free(list.rings);
    free(list.polygons);
    return result;
}

int parts_check(job *j)
{
    int result = check_side(j, 0);
    return result == DONE ? check_side(j, 1) : result;
}
