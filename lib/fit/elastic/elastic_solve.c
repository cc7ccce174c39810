/* Leads held vertices to their targets: E. L. Allgower, K. Georg, Introduction to numerical
 * continuation methods, 1990.
 *
 * The way is divided into parts. In each part, stiff springs pull the held vertices to their
 * places, and a Newton step on the springs brings everything else along. Then the vertices are set
 * exactly, and the rest relaxes. If that would flip a triangle, the part is shortened.
 *
 * If the way is blocked, soft springs show which groups are to blame: those that stay farthest from
 * their targets. They are given up. From then on soft springs pull them, and the others go on. */
#include "fit/elastic/elastic_model.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "fit/elastic/elastic_parts.h"
#include "fit/elastic/elastic_step.h"
#include "fit/elastic/elastic_sums.h"
#include "fit/elastic/paths.h"
#include "fit/elastic/rigid_start.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* A part turns no group by more than this, in turns: 15 degrees. */
static const double MOST_TURN = 1.0 / 24;

/* LEAST_PART: the way is blocked if a shorter part of it fails. LONGER: factor for the next part.
 * HASTY: the first step of a longer part must reach this share, or the part is shortened at
 * once. */
static const double LEAST_PART = 1.0 / 256, LONGER = 1.5, HASTY = 0.5, CAREFUL_PART = 1.0 / 16;

/* Stiffness of the springs of groups that were given up, as a share of that of stiff springs. */
static const double SOFT = 1e-5;

/* Groups are given up if they stay off by more than this share of the largest distance. */
static const double SHARE_OF_WORST = 0.5;

/* Steps end when the energy is expected to fall by no more than this share: in the end, and between
 * parts. */
static const double TOLERANCE = 1e-6, ROUGH = 1e-2;

/* Steps of one part, after a part, in the end, and while soft springs pull. Reports of progress
 * take TYPICAL steps for half of them. */
enum { STEPS_TO_PLACE = 6, STEPS_BETWEEN = 2, STEPS_AT_END = 60, SOFT_STEPS = 30, TYPICAL = 16 };

/* MOST_ROUNDS: how often groups are given up; the last time all are. MOST_TRIES: how often groups
 * that were given up are tried again. After MOST_STEPS Newton steps all are given up at once. */
enum { MOST_ROUNDS = 6, MOST_TRIES = 2, MOST_STEPS = 400 };

typedef struct drive {
    iccp_elastic_state *state;
    iccp_paths paths;
    double *start; /* 2 n_points: the images before a part */
    const iccp_env *env;
} drive;

/* ---- set-up ---- */

static void free_state(iccp_elastic_state *s)
{
    const iccp_memory memory = s->threads.memory;
    iccp_free(&memory, s->place);
    iccp_free(&memory, s->pull);
    iccp_free(&memory, s->settled);
    iccp_free(&memory, s->motion);
    iccp_free(&memory, s->saved);
    iccp_free(&memory, s->solution);
    iccp_free(&memory, s->work);
    iccp_free(&memory, s->term);
    iccp_elastic_plan_free(&s->own, &memory);
    iccp_contact_free(&s->contact);
}

/* Shares the plan of the mesh. */
static icc_status share_plan(iccp_elastic_state *s)
{
    const iccp_elastic_plan *plan = &s->as->plan;
    const iccp_reach *reach = &s->as->reach;
    const size_t n_entries = reach->factor > 0 ? reach->gram.first[s->as->n_points] : 0;
    iccp_simplicial_map view = iccp_elastic_view(s);
    view.corners = plan->corners;
    iccp_ldlt_share(&s->own.factor, &plan->factor, &s->threads.memory);
    s->own.first_touch = plan->first_touch;
    s->own.place = iccp_alloc(&s->threads.memory, n_entries, sizeof *s->own.place);
    if (s->own.place == NULL)
        return ICC_ERR_MEMORY;
    if (n_entries > 0)
        memcpy(s->own.place, plan->place, n_entries * sizeof *s->own.place);
    return iccp_assembly_share(&s->own.assembly, &plan->assembly, &view, &s->threads.memory);
}

static icc_status make_state(iccp_elastic_state *s, const iccp_elastic *as, double *images,
                             const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = as->n_points, size = 2 * sizeof(double);
    *s = (iccp_elastic_state){.as = as, .images = images, .threads = iccp_quiet(env)};
    s->own.assembly.memory = s->own.factor.memory = s->contact.memory = *memory;
    s->place = iccp_alloc(memory, n, size);
    s->pull = iccp_alloc(memory, n, sizeof *s->pull);
    s->settled = iccp_alloc_zero(memory, n, sizeof *s->settled);
    s->motion = iccp_alloc(memory, n, size);
    s->saved = iccp_alloc(memory, n, size);
    s->solution = iccp_alloc(memory, n, size);
    s->work = iccp_alloc(memory, n, size);
    s->term = iccp_alloc(memory, as->n_triangles, sizeof *s->term);
    if (s->place == NULL || s->pull == NULL || s->settled == NULL || s->motion == NULL ||
        s->saved == NULL || s->solution == NULL || s->work == NULL || s->term == NULL)
        return ICC_ERR_MEMORY;
    memcpy(s->place, images, n * size);
    const icc_status status = share_plan(s);
    return status == ICC_OK && as->contact ? iccp_contact_create(&s->contact, &as->shape, env)
                                           : status;
}

/* ---- places ---- */

static bool is_off(const drive *d, uint32_t v)
{
    return d->paths.group[d->paths.group_of[v]].is_off;
}

/* Puts the springs' ends after a share of the way. Those of groups that were given up pull softly
 * to the targets. Held vertices that are at their places already stay there. */
static void set_places(drive *d, double share)
{
    iccp_elastic_state *s = d->state;
    const iccp_elastic *as = s->as;
    for (uint32_t v = 0; v < as->n_points; ++v) {
        const size_t at = 2 * (size_t)v;
        const bool is_held = as->hold[v] == ICCP_HELD, is_given_up = is_held && is_off(d, v);
        s->pull[v] = is_given_up ? SOFT : 1;
        if (is_held)
            iccp_paths_at(&d->paths, v, is_given_up ? 1 : share, s->place + at);
        else if (as->hold[v] == ICCP_SLIDING)
            for (size_t k = 0; k < 2; ++k) {
                const double from = d->paths.from[at + k], to = d->paths.to[at + k];
                s->place[at + k] = share < 1 ? from + share * (to - from) : to;
            }
        s->settled[v] = is_held && !is_given_up &&
                        memcmp(s->images + at, s->place + at, 2 * sizeof *s->place) == 0;
    }
}

/* Moves a sliding vertex onto its line. */
static void set_on_line(iccp_elastic_state *s, uint32_t v)
{
    const double *q = s->place + 2 * (size_t)v, *axis = s->as->axis + 2 * (size_t)v;
    double *x = s->images + 2 * (size_t)v;
    const double along = (x[0] - q[0]) * axis[0] + (x[1] - q[1]) * axis[1];
    x[0] = q[0] + along * axis[0];
    x[1] = q[1] + along * axis[1];
}

/* Sets told vertices exactly, except groups that were given up. Returns true and fixes them if all
 * stays valid. Otherwise nothing changes. */
static bool settle(drive *d, icc_status *status)
{
    iccp_elastic_state *s = d->state;
    const iccp_elastic *as = s->as;
    memcpy(s->saved, s->images, 2 * as->n_points * sizeof *s->saved);
    for (uint32_t v = 0; v < as->n_points; ++v) {
        if (as->hold[v] == ICCP_HELD && !is_off(d, v))
            memcpy(s->images + 2 * (size_t)v, s->place + 2 * (size_t)v, 2 * sizeof *s->images);
        else if (as->hold[v] == ICCP_SLIDING)
            set_on_line(s, v);
    }
    if (!iccp_elastic_is_valid(s, status)) {
        memcpy(s->images, s->saved, 2 * as->n_points * sizeof *s->saved);
        return false;
    }
    for (uint32_t v = 0; v < as->n_points; ++v)
        s->settled[v] = as->hold[v] == ICCP_SLIDING || (as->hold[v] == ICCP_HELD && !is_off(d, v));
    return true;
}

/* ---- steps ---- */

static icc_status step(const drive *d, iccp_elastic_move *move)
{
    const iccp_env part = iccp_round(d->env, d->state->n_iterations, TYPICAL);
    return iccp_elastic_step(d->state, move, &part);
}

/* Lowers the energy as long as that is worth a step. */
static icc_status relax(const drive *d, size_t most, double tolerance)
{
    icc_status status = ICC_OK;
    for (size_t k = 0; k < most && status == ICC_OK; ++k) {
        iccp_elastic_move move;
        status = step(d, &move);
        if (move.length <= 0 || -move.slope <= 2 * tolerance * move.after)
            break;
    }
    return status;
}

/* Goes on to a share of the way. *done is false if that is too far. Then the state is as it was. */
static icc_status go_to(drive *d, double share, bool is_careful, bool *done)
{
    iccp_elastic_state *s = d->state;
    const size_t size = 2 * s->as->n_points * sizeof *s->images;
    icc_status status = ICC_OK;
    *done = false;
    memcpy(d->start, s->images, size);
    set_places(d, share);
    for (int k = 0; k < STEPS_TO_PLACE && status == ICC_OK && !*done; ++k) {
        iccp_elastic_move move;
        status = step(d, &move);
        if (status != ICC_OK || move.length <= 0 || (k == 0 && !is_careful && move.length < HASTY))
            break;
        *done = settle(d, &status);
    }
    if (status == ICC_OK && *done && share < 1)
        status = relax(d, STEPS_BETWEEN, ROUGH);
    if (status == ICC_OK && !*done)
        memcpy(s->images, d->start, size);
    return status;
}

/* Leads all groups that were not given up to their targets. *reached is false if the way is
 * blocked. */
static icc_status follow(drive *d, bool *reached)
{
    const double turn = iccp_paths_turn(&d->paths);
    double share = 0, part = turn > MOST_TURN ? 1 / ceil(turn / MOST_TURN) : 1;
    const double longest = part;
    icc_status status = ICC_OK;
    *reached = false;
    while (status == ICC_OK && !*reached && part >= LEAST_PART * longest) {
        const double to = share + part >= 1 ? 1 : share + part;
        bool done;
        status = go_to(d, to, part <= CAREFUL_PART * longest, &done);
        if (done)
            share = to;
        part = done ? iccp_min(LONGER * part, longest) : part / 2;
        *reached = share >= 1;
    }
    return status;
}

/* ---- groups that block the way ---- */

static double distance(const drive *d, uint32_t v)
{
    const double *x = d->state->images + 2 * (size_t)v, *q = d->paths.to + 2 * (size_t)v;
    return iccp_hypot(x[0] - q[0], x[1] - q[1]);
}

static bool is_leading(const drive *d, uint32_t v)
{
    return d->state->as->hold[v] == ICCP_HELD && d->paths.group[d->paths.group_of[v]].moves &&
           !is_off(d, v);
}

/* Gives up the groups that stay farthest from their targets under soft springs, or all. Those that
 * have no way to go stay where they are. */
static icc_status give_up(drive *d, bool all)
{
    iccp_elastic_state *s = d->state;
    double most = 0;
    set_places(d, 1);
    for (uint32_t v = 0; v < s->as->n_points; ++v)
        if (is_leading(d, v)) {
            s->pull[v] = SOFT;
            s->settled[v] = 0;
        }
    const icc_status status = relax(d, SOFT_STEPS, TOLERANCE);
    for (uint32_t v = 0; v < s->as->n_points; ++v)
        if (is_leading(d, v))
            most = iccp_max(most, distance(d, v));
    const double least = all ? -1 : SHARE_OF_WORST * most;
    for (uint32_t v = 0; v < s->as->n_points; ++v)
        if (is_leading(d, v) && distance(d, v) > least)
            d->paths.group[d->paths.group_of[v]].is_off = true;
    iccp_paths_begin(&d->paths, s->images);
    return status;
}

/* Goes the way, and gives up groups as often as it is blocked. */
static icc_status lead(drive *d)
{
    bool reached = false;
    icc_status status = ICC_OK;
    for (int k = 0; k <= MOST_ROUNDS && status == ICC_OK && !reached; ++k) {
        status = follow(d, &reached);
        if (status == ICC_OK && !reached && k < MOST_ROUNDS) {
            const bool all = k == MOST_ROUNDS - 1 || d->state->n_iterations > MOST_STEPS;
            status = give_up(d, all);
            k = all ? MOST_ROUNDS - 1 : k;
        }
    }
    return status == ICC_OK ? relax(d, STEPS_AT_END, TOLERANCE) : status;
}

/* Begins again with groups that were given up, from where they are now. Soft springs may have led
 * them around what blocked them. Returns true if there are any. */
static bool try_again(drive *d)
{
    bool is_any = false;
    for (size_t g = 0; g < d->paths.n_groups; ++g) {
        is_any |= d->paths.group[g].is_off;
        d->paths.group[g].is_off = false;
    }
    iccp_paths_begin(&d->paths, d->state->images);
    return is_any;
}

/* Starts with the groups given up that were off before. */
static void begin_off(drive *d, const uint8_t *off)
{
    for (uint32_t v = 0; v < d->state->as->n_points; ++v)
        if (d->state->as->hold[v] == ICCP_HELD && off[v]) {
            iccp_group *group = &d->paths.group[d->paths.group_of[v]];
            group->moves = group->is_off = true;
        }
}

/* Tries whether groups that were given up can go to their targets in one part. */
static icc_status try_at_once(drive *d, const uint8_t *off)
{
    bool done = false;
    if (!try_again(d))
        return ICC_OK;
    icc_status status = go_to(d, 1, false, &done);
    if (status == ICC_OK && !done) {
        begin_off(d, off);
        set_places(d, 1);
        (void)settle(d, &status);
    }
    return status == ICC_OK ? relax(d, STEPS_AT_END, TOLERANCE) : status;
}

static void list_off(const drive *d, uint8_t *off)
{
    for (uint32_t v = 0; v < d->state->as->n_points; ++v)
        off[v] = d->state->as->hold[v] == ICCP_HELD && is_off(d, v);
}

static icc_status lead_all(drive *d, uint8_t *off)
{
    if (off != NULL)
        begin_off(d, off);
    icc_status status = lead(d);
    for (int k = 0; off == NULL && k < MOST_TRIES && d->state->n_iterations <= MOST_STEPS &&
                    status == ICC_OK && try_again(d);
         ++k)
        status = lead(d);
    if (off != NULL && status == ICC_OK) {
        list_off(d, off);
        status = try_at_once(d, off);
        list_off(d, off);
    }
    return status;
}

/* The distance of a told vertex from its target, or from its line. */
static double distance_left(const drive *d, uint32_t v)
{
    const iccp_elastic_state *s = d->state;
    const double *x = s->images + 2 * (size_t)v, *q = d->paths.to + 2 * (size_t)v;
    double axis[2];
    if (s->as->hold[v] == ICCP_HELD)
        return distance(d, v);
    if (s->as->hold[v] == ICCP_LOOSE || s->settled[v])
        return 0;
    iccp_elastic_axis(s->as, v, 1, axis);
    return fabs((x[0] - q[0]) * axis[0] + (x[1] - q[1]) * axis[1]);
}

static void fill_report(const drive *d, iccp_elastic_report *report)
{
    const iccp_elastic_state *s = d->state;
    *report = (iccp_elastic_report){.n_iterations = s->n_iterations};
    for (uint32_t v = 0; v < s->as->n_points; ++v) {
        const double off = distance_left(d, v);
        report->n_off += off > 0;
        report->most_off = iccp_max(report->most_off, off);
    }
    report->energy = iccp_elastic_triangles(s) / s->as->weight;
}

/* Moves all images as the held vertices move in common, if the state stays valid. */
static icc_status start_rigidly(drive *d, const double *targets)
{
    iccp_elastic_state *s = d->state;
    const size_t n = s->as->n_points;
    iccp_rigid_motion motion;
    icc_status status = ICC_OK;
    if (!iccp_rigid_motion_find(&motion, n, s->as->hold, s->images, targets))
        return ICC_OK;
    memcpy(d->start, s->images, 2 * n * sizeof *d->start);
    iccp_rigid_motion_apply(&motion, n, s->images);
    if (!iccp_elastic_is_valid(s, &status))
        memcpy(s->images, d->start, 2 * n * sizeof *d->start);
    return status;
}

static icc_status solve(drive *d, const double *targets, uint8_t *off, iccp_elastic_report *report,
                        icc_error *err)
{
    iccp_elastic_state *s = d->state;
    const iccp_elastic *as = s->as;
    d->start = iccp_alloc(&s->threads.memory, as->n_points, 2 * sizeof *d->start);
    if (d->start == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = start_rigidly(d, targets);
    if (status == ICC_OK)
        status = iccp_paths_create(&d->paths, as->n_points, as->hold, as->n_triangles, as->corners,
                                   targets, s->images, &s->threads);
    if (status == ICC_OK)
        status = lead_all(d, off);
    if (status == ICC_OK)
        fill_report(d, report);
    return status == ICC_OK ? iccp_outlines_check(&as->outlines, s->images, &s->threads, err)
                            : status;
}

icc_status iccp_elastic_drag(const iccp_elastic *elastic, const double *targets, double *images,
                             uint8_t *off, iccp_elastic_report *report, const iccp_env *env,
                             icc_error *err)
{
    const size_t n = 2 * elastic->n_points;
    iccp_elastic_state state;
    drive d = {.state = &state, .paths.memory = env->memory, .env = env};
    double *before = iccp_alloc(&env->memory, n, sizeof *before);
    if (before == NULL)
        return iccp_fail_memory(err);
    memcpy(before, images, n * sizeof *before);
    icc_status status = make_state(&state, elastic, images, env);
    if (status == ICC_OK)
        status = solve(&d, targets, off, report, err);
    if (status == ICC_ERR_BOUNDARY)
        status = iccp_fail(err, ICC_ERR_CERTIFICATE, "parts of the outline overlap in the image");
    if (status != ICC_OK)
        memcpy(images, before, n * sizeof *before);
    iccp_paths_free(&d.paths);
    iccp_free(&env->memory, d.start);
    iccp_free(&env->memory, before);
    free_state(&state);
    return iccp_explain(err, status);
}

icc_status iccp_elastic_solve(const iccp_elastic *elastic, const double *targets, double *images,
                              iccp_elastic_report *report, const iccp_env *env, icc_error *err)
{
    return iccp_elastic_drag(elastic, targets, images, NULL, report, env, err);
}
