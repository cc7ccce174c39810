/* Each part is an elastic fit with a free outline. A pin that turns becomes five points: itself, and
 * four around it, which turn. A bone becomes a line between its pins. */
#include "fit/pin_pose.h"

#include "base/allocate.h"
#include "fit/pin_path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The points around a pin that turns are as far from it as one of so many equal steps to the
 * outline, to another pin or to a bone. */
static const double STEPS_TO_NEXT = 3;

/* Pixels: a pin that is off by less is at its place, but for rounding. */
static const double REACHED = 1e-6;

/* The constraints of a part. */
typedef struct told {
    const control_points *pins;
    size_t n;                /* items */
    double *source, *target; /* 2 n each */
    uint32_t *pin_of;        /* of each item */
    size_t n_constraints;
    icc_constraint *constraints;
} told;

static void add_item(told *t, uint32_t pin, double x, double y)
{
    t->source[2 * t->n] = x;
    t->source[2 * t->n + 1] = y;
    t->pin_of[t->n++] = pin;
}

/* The constraint of the items from `first` on. */
static void add_constraint(told *t, int32_t kind, size_t first)
{
    if (t->n > first)
        t->constraints[t->n_constraints++] = (icc_constraint){.size = sizeof(icc_constraint),
                                                              .kind = kind,
                                                              .n = t->n - first,
                                                              .source = t->source + 2 * first,
                                                              .target = t->target + 2 * first};
}

static bool is_in_bone(const control_points *pins, uint32_t pin)
{
    for (size_t i = 0; i < 2 * pins->n_bones; i++)
        if (pins->bones[i] == pin)
            return true;
    return false;
}

static bool is_in_part(const figure_part *part, uint32_t pin)
{
    for (size_t k = 0; k < part->n_pins; k++)
        if (part->pins[k] == pin)
            return true;
    return false;
}

static double distance_to_bone(const control_points *pins, size_t bone, const double *p)
{
    const double *a = pins->from + 2 * pins->bones[2 * bone],
                 *b = pins->from + 2 * pins->bones[2 * bone + 1];
    double u[2] = {b[0] - a[0], b[1] - a[1]};
    double along = ((p[0] - a[0]) * u[0] + (p[1] - a[1]) * u[1]) / (u[0] * u[0] + u[1] * u[1]);
    along = fmin(fmax(along, 0), 1);
    return hypot(a[0] + along * u[0] - p[0], a[1] + along * u[1] - p[1]);
}

/* The distance of the points around a pin. */
static double radius_around(const control_points *pins, uint32_t pin, double clearance)
{
    const double *p = pins->from + 2 * pin;
    double distance = clearance;
    for (size_t i = 0; i < pins->n; i++)
        if (i != pin)
            distance =
                fmin(distance, hypot(pins->from[2 * i] - p[0], pins->from[2 * i + 1] - p[1]));
    for (size_t i = 0; i < pins->n_bones; i++)
        distance = fmin(distance, distance_to_bone(pins, i, p));
    return distance / STEPS_TO_NEXT;
}

static void add_pin(told *t, uint32_t pin, double clearance)
{
    static const double around[4][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const double *from = t->pins->from + 2 * pin;
    double radius = radius_around(t->pins, pin, clearance);
    add_item(t, pin, from[0], from[1]);
    for (size_t k = 0; k < 4 && !isnan(t->pins->turns[pin]); k++)
        add_item(t, pin, from[0] + radius * around[k][0], from[1] + radius * around[k][1]);
}

/* Pins of bones are told by their bones alone. */
static told tell(const figure_part *part, const control_points *pins)
{
    size_t most = 5 * part->n_pins + 2 * pins->n_bones;
    told t = {.pins = pins};
    t.source = need(most, 2 * sizeof *t.source);
    t.target = need(most, 2 * sizeof *t.target);
    t.pin_of = need(most, sizeof *t.pin_of);
    t.constraints = need(pins->n_bones + 1, sizeof *t.constraints);
    for (size_t k = 0; k < part->n_pins; k++)
        if (!is_in_bone(pins, part->pins[k]))
            add_pin(&t, part->pins[k], part->clearance[k]);
    add_constraint(&t, ICC_CONSTRAINT_POINTS, 0);
    for (size_t i = 0; i < pins->n_bones; i++) {
        const uint32_t *ends = pins->bones + 2 * i;
        size_t first = t.n;
        for (size_t k = 0; k < 2 && is_in_part(part, ends[0]); k++)
            add_item(&t, ends[k], pins->from[2 * ends[k]], pins->from[2 * ends[k] + 1]);
        add_constraint(&t, ICC_CONSTRAINT_LINE, first);
    }
    return t;
}

static void told_free(told *t)
{
    free(t->source);
    free(t->target);
    free(t->pin_of);
    free(t->constraints);
}

/* Targets at a share of the way. What is around pins turns evenly. */
static void set_targets(told *t, double share)
{
    double *places = need(t->pins->n, 2 * sizeof *places);
    pins_places(places, t->pins, share);
    for (size_t i = 0; i < t->n; i++) {
        const double *from = t->pins->from + 2 * t->pin_of[i], *to = places + 2 * t->pin_of[i];
        double turn = t->pins->turns[t->pin_of[i]];
        double angle = isnan(turn) ? 0 : share * turn * acos(-1) / 180;
        double x = t->source[2 * i] - from[0], y = t->source[2 * i + 1] - from[1];
        t->target[2 * i] = to[0] + cos(angle) * x - sin(angle) * y;
        t->target[2 * i + 1] = to[1] + sin(angle) * x + cos(angle) * y;
    }
    free(places);
}

/* ------------------------------------------------------------------ fits */

static int failed_fit(pin_pose *p, const told *t, const icc_error *err)
{
    const char *name = p->job.args->pins;
    pin_text pin;
    progress_end(&p->job.bar);
    if (err->item != ICC_ITEM_POINT || err->index < 0 || (uint64_t)err->index >= t->n)
        return failed(name, 0, "%s", job_message(err));
    uint32_t i = t->pin_of[err->index];
    return failed(name, p->pins.lines[i], "%s: %s", pin_name(pin, &p->pins, i), job_message(err));
}

/* Keeps the mesh and its place at rest. */
static void keep_rest(pinned_part *out, const icc_map *map, size_t n_keys)
{
    icc_map_info info = {.size = sizeof info};
    icc_map_get_info(map, &info);
    out->n_vertices = info.n_vertices;
    out->n_triangles = info.n_simplices;
    out->triangles = need(out->n_triangles, 3 * sizeof *out->triangles);
    out->keys = need(n_keys, sizeof *out->keys);
    for (size_t k = 0; k < n_keys; k++)
        out->keys[k] = need(out->n_vertices, 2 * sizeof **out->keys);
}

static void keep_key(pin_pose *p, pinned_part *out, const icc_map *map, size_t key)
{
    icc_map_info info = {.size = sizeof info};
    icc_map_get_info(map, &info);
    icc_mesh mesh = {.size = sizeof mesh,
                     .n_vertices = out->n_vertices,
                     .vertices = out->keys[0],
                     .n_cells = out->n_triangles,
                     .cells = out->triangles};
    icc_map_get_mesh(map, &mesh, out->keys[key]);
    p->certified = p->certified && info.certified;
}

static void keep_residuals(pin_pose *p, const told *t, const icc_fit *fit)
{
    double *residuals = need(t->n + 1, 2 * sizeof *residuals);
    icc_fit_get_residuals(fit, residuals, NULL);
    for (size_t i = 0; i < t->n; i++) {
        double off = hypot(residuals[2 * i], residuals[2 * i + 1]);
        if (off > REACHED)
            p->off[t->pin_of[i]] = fmax(p->off[t->pin_of[i]], off);
    }
    free(residuals);
}

/* A part without pins holds one vertex, and so everything stays. Then its cells may be as large as
 * it is. */
static icc_status create(icc_fit **out, pin_pose *p, const figure_part *part, const told *t,
                         icc_error *err)
{
    static const uint32_t first[] = {0};
    double *corners = NULL;
    icc_fit_options options = {
        .size = sizeof options, .model = ICC_FIT_ELASTIC, .reach = p->job.args->reach};
    icc_constraint held = {
        .size = sizeof held, .kind = ICC_CONSTRAINT_VERTICES, .n = 1, .vertices = first};
    if (t->n == 0) {
        icc_domain_info info = {.size = sizeof info};
        icc_domain_get_info(part->domain, &info);
        corners = need(info.n_vertices, 2 * sizeof *corners);
        icc_domain_get_boundary(part->domain, corners, NULL);
        held.target = corners;
        for (size_t i = 1; i < info.n_vertices; i++)
            options.cell = fmax(
                options.cell, hypot(corners[2 * i] - corners[0], corners[2 * i + 1] - corners[1]));
    }
    icc_status status =
        icc_fit_create(out, part->domain, NULL, t->n > 0 ? t->n_constraints : 1,
                       t->n > 0 ? t->constraints : &held, &options, &p->job.env, err);
    free(corners);
    return status;
}

/* Steps from one key to the next, in which nothing turns far. */
static size_t steps_of(const pin_pose *p)
{
    enum { MOST_TURN = 30 };
    double most = 0;
    for (size_t i = 0; i < p->pins.n; i++)
        if (!isnan(p->pins.turns[i]))
            most = fmax(most, fabs(p->pins.turns[i]));
    for (size_t i = 0; i < p->pins.n_bones; i++)
        most = fmax(most, fabs(bone_turn(&p->pins, i)) * 180 / acos(-1));
    return (size_t)ceil(fmax(1, most / (MOST_TURN * (double)(p->n_keys - 1))));
}

/* Goes one step on. The fit stays as it is if that fails. */
static icc_status step(icc_fit **fit, pin_pose *p, size_t k, const told *t, icc_error *err)
{
    icc_fit *next = NULL;
    icc_status status = *fit == NULL ? create(&next, p, &p->figure.parts[k], t, err)
                                     : icc_fit_move(&next, *fit, t->target, &p->job.env, err);
    if (status != ICC_OK)
        return status;
    if (*fit == NULL)
        keep_rest(&p->parts[k], icc_fit_map(next), p->n_keys);
    icc_fit_free(*fit);
    *fit = next;
    return ICC_OK;
}

/* Poses a part key by key, each from the one before. */
static int fit_part(pin_pose *p, size_t k)
{
    told t = tell(&p->figure.parts[k], &p->pins);
    icc_fit *fit = NULL;
    icc_error err = {.size = sizeof err, .index = -1};
    icc_status status = ICC_OK;
    size_t steps = t.n > 0 ? steps_of(p) : 1, n = t.n > 0 ? steps * (p->n_keys - 1) : 1;
    for (size_t i = 1; i <= n && status == ICC_OK; i++) {
        set_targets(&t, (double)i / (double)n);
        progress_expect(&p->job.bar, 1.0 / (double)(1 + (p->figure.n - k) * (n - i + 1)));
        status = step(&fit, p, k, &t, &err);
        if (status == ICC_OK && i % steps == 0)
            keep_key(p, &p->parts[k], icc_fit_map(fit), i / steps);
    }
    for (size_t key = 2; t.n == 0 && status == ICC_OK && key < p->n_keys; key++)
        keep_key(p, &p->parts[k], icc_fit_map(fit), key);
    int result = status == ICC_OK ? DONE : failed_fit(p, &t, &err);
    if (result == DONE)
        keep_residuals(p, &t, fit);
    icc_fit_free(fit);
    told_free(&t);
    return result;
}

int pins_fit(pin_pose *p)
{
    p->parts = need(p->figure.n, sizeof *p->parts);
    p->off = need(p->pins.n, sizeof *p->off);
    p->certified = true;
    int result = DONE;
    for (size_t k = 0; k < p->figure.n && result == DONE; k++)
        result = fit_part(p, k);
    return result;
}

size_t pins_off(const pin_pose *p, double *most)
{
    size_t n = 0;
    *most = 0;
    for (size_t i = 0; i < p->pins.n; i++) {
        n += p->off[i] > 0;
        *most = fmax(*most, p->off[i]);
    }
    return n;
}

void pins_free(pin_pose *p)
{
    for (size_t k = 0; k < p->figure.n && p->parts != NULL; k++) {
        for (size_t key = 0; key < p->n_keys && p->parts[k].keys != NULL; key++)
            free(p->parts[k].keys[key]);
        free(p->parts[k].keys);
        free(p->parts[k].triangles);
    }
    free(p->parts);
    free(p->off);
    figure_free(&p->figure);
    control_free(&p->pins);
}
