/* The outlines of a picture run a little outside of what is opaque, so that soft edges go along. They
 * keep away from one another, so nothing is joined that was apart. */
#include "fit/pin_figure.h"

#include "base/allocate.h"
#include "cage/cage_features.h"
#include "cage/cage_readers.h"
#include "picture/picture_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pixels by which the outlines run outside of where alpha is one half: soft edges are so wide, and
 * the outline may be simplified by half of it. */
enum { GROWTH = 2 };

const char *pin_name(pin_text out, const control_points *pins, size_t i)
{
    if (pins->names[i] != NULL)
        snprintf(out, sizeof(pin_text), "pin \"%.36s\"", pins->names[i]);
    else
        snprintf(out, sizeof(pin_text), "pin %zu", i + 1);
    return out;
}

/* ------------------------------------------------------------------ outlines */

/* Makes one domain of all outlines, which shows that they keep apart. */
static icc_status check_apart(const picture *p, double growth, const icc_env *env, icc_error *err)
{
    problem wrong;
    cage all = {.dim = 2};
    icc_domain *domain = NULL;
    cage_take_alpha(&all, p, 0, growth, &wrong);
    if (all.n_more > 0)
        cage_join_outlines(&all);
    icc_status status = job_make_polygon(&domain, &all, env, err);
    icc_domain_free(domain);
    cage_free(&all);
    return status;
}

/* Takes the outline that the user has drawn, which may have holes. What is outside gets no place. */
static int take_outline(figure *f, job *j)
{
    int result = job_read_plane(j, "pose --pins");
    const cage *c = &j->cages[0];
    if (result == DONE && (c->n == 0 || c->n_features > cage_count(c, ICC_FEATURE_HOLE)))
        result = failed(j->args->source, 0,
                        "the figure is one outline with holes; here are regions, lines or points");
    if (result == DONE)
        result = job_make_domains(j);
    if (result != DONE)
        return result;
    f->parts = need(1, sizeof *f->parts);
    f->n = 1;
    f->parts[0].domain = j->made[0];
    j->made[0] = NULL;
    picture_widen(&f->picture, false, true);
    return DONE;
}

/* Finds the outlines, and moves them outwards as far as they keep apart. */
static int find_parts(figure *f, job *j, const char *name)
{
    problem wrong;
    cage outlines = {.dim = 2};
    icc_error err = {.size = sizeof err, .index = -1};
    double growth = GROWTH;
    if (j->args->source != NULL)
        return take_outline(f, j);
    if (!picture_has_alpha(&f->picture))
        return failed(
            name, 0,
            "the picture has no transparent ground, so it has no outline; make its ground "
            "transparent, or give an outline with --source FILE");
    if (!cage_take_alpha(&outlines, &f->picture, 0, 0, &wrong)) {
        cage_free(&outlines);
        return failed(name, 0, "%s", wrong.text);
    }
    cage_free(&outlines);
    while (growth > 0 && check_apart(&f->picture, growth, &j->env, &err) != ICC_OK)
        growth = growth > 0.5 ? growth / 2 : 0;
    outlines = (cage){.dim = 2};
    cage_take_alpha(&outlines, &f->picture, 0, growth, &wrong);
    f->parts = need(outlines.n_more + 1, sizeof *f->parts);
    icc_status status = ICC_OK;
    for (f->n = 0; f->n <= outlines.n_more && status == ICC_OK; f->n++) {
        const cage *one = f->n == 0 ? &outlines : &outlines.more[f->n - 1];
        status = job_make_polygon(&f->parts[f->n].domain, one, &j->env, &err);
    }
    cage_free(&outlines);
    return status == ICC_OK ? DONE : failed(name, 0, "the outline: %s", job_message(&err));
}

/* ------------------------------------------------------------------ pins */

/* Where a pin is, and the nearest place of an outline. */
typedef struct pin_place {
    size_t part; /* SIZE_MAX: it is in none */
    double distance, nearest[2];
} pin_place;

/* The nearest places of the pins on the outline of a part that are inside, or closer than those of
 * other parts. */
static icc_status look_in_part(pin_place *places, const figure *f, size_t part,
                               const control_points *pins, const icc_env *env)
{
    icc_domain_info info = {.size = sizeof info};
    const icc_domain *domain = f->parts[part].domain;
    icc_domain_get_info(domain, &info);
    double *vertices = need(info.n_vertices, 2 * sizeof *vertices),
           *bary = need(pins->n, 2 * sizeof *bary);
    uint32_t *facets = need(info.n_facets, 2 * sizeof *facets),
             *facet = need(pins->n, sizeof *facet);
    int32_t *where = need(pins->n, sizeof *where);
    icc_domain_get_boundary(domain, vertices, facets);
    icc_status status = icc_domain_locate(domain, pins->n, pins->from, where, facet, bary, env);
    for (size_t i = 0; i < pins->n && status == ICC_OK; i++) {
        const uint32_t *ends = facets + 2 * facet[i];
        double at[2];
        for (size_t k = 0; k < 2; k++)
            at[k] = bary[2 * i] * vertices[2 * ends[0] + k] +
                    bary[2 * i + 1] * vertices[2 * ends[1] + k];
        double d = hypot(at[0] - pins->from[2 * i], at[1] - pins->from[2 * i + 1]);
        bool inside = where[i] == ICC_INSIDE;
        if (places[i].part != SIZE_MAX || (!inside && !(d < places[i].distance)))
            continue;
        places[i] = (pin_place){inside ? part : SIZE_MAX, d, {at[0], at[1]}};
    }
    free(vertices);
    free(bary);
    free(facets);
    free(facet);
    free(where);
    return status;
}

static int check_places(const pin_place *places, const char *name, const control_points *pins)
{
    pin_text pin, other;
    for (size_t i = 0; i < pins->n; i++) {
        const double *at = pins->from + 2 * i;
        if (places[i].part == SIZE_MAX)
            return failed(name, pins->lines[i],
                          "%s at %g, %g is %.3g pixels outside of the figure; move it towards "
                          "%.5g, %.5g and beyond",
                          pin_name(pin, pins, i), at[0], at[1], places[i].distance,
                          places[i].nearest[0], places[i].nearest[1]);
        for (size_t k = 0; k < i; k++)
            if (at[0] == pins->from[2 * k] && at[1] == pins->from[2 * k + 1])
                return failed(name, pins->lines[i],
                              "%s is at the place of %s; remove one, or move it",
                              pin_name(pin, pins, i), pin_name(other, pins, k));
    }
    return DONE;
}

static void keep_places(figure *f, const pin_place *places, size_t n_pins)
{
    for (figure_part *p = f->parts; p < f->parts + f->n; p++) {
        p->pins = need(n_pins, sizeof *p->pins);
        p->clearance = need(n_pins, sizeof *p->clearance);
    }
    for (size_t i = 0; i < n_pins; i++) {
        figure_part *p = &f->parts[places[i].part];
        p->clearance[p->n_pins] = places[i].distance;
        p->pins[p->n_pins++] = (uint32_t)i;
    }
}

static int check_bones(const pin_place *places, const char *name, const control_points *pins)
{
    pin_text a, b;
    for (size_t i = 0; i < pins->n_bones; i++) {
        const uint32_t *ends = pins->bones + 2 * i;
        for (size_t k = 0; k < 2; k++)
            if (!isnan(pins->turns[ends[k]]))
                return failed(name, pins->lines[ends[k]],
                              "%s has a turn and a bone; a bone turns its pins, so remove the turn",
                              pin_name(a, pins, ends[k]));
        if (places[ends[0]].part != places[ends[1]].part)
            return failed(name, 0, "bones[%zu] joins %s and %s, which are in two parts", i,
                          pin_name(a, pins, ends[0]), pin_name(b, pins, ends[1]));
    }
    return DONE;
}

static int find_pins(figure *f, job *j, const control_points *pins)
{
    const char *name = j->args->pins;
    pin_place *places = need(pins->n, sizeof *places);
    icc_status status = ICC_OK;
    for (size_t i = 0; i < pins->n; i++)
        places[i] = (pin_place){.part = SIZE_MAX, .distance = HUGE_VAL};
    for (size_t k = 0; k < f->n && status == ICC_OK; k++)
        status = look_in_part(places, f, k, pins, &j->env);
    int result = status == ICC_OK ? check_places(places, name, pins) : job_failed_status(j, status);
    if (result == DONE)
        result = check_bones(places, name, pins);
    if (result == DONE)
        keep_places(f, places, pins->n);
    free(places);
    return result;
}

/* ------------------------------------------------------------------ faint pixels */

static double alpha(const picture *p, size_t x, size_t y)
{
    return p->samples[(y * p->width + x + 1) * p->channels - 1] /
           (double)((UINT32_C(1) << p->depth) - 1);
}

/* True if an opaque pixel is so near that the outline runs around this one. */
static bool is_near_opaque(const picture *p, size_t x, size_t y)
{
    size_t x0 = x > GROWTH ? x - GROWTH : 0, y0 = y > GROWTH ? y - GROWTH : 0;
    for (size_t v = y0; v <= y + GROWTH && v < p->height; v++)
        for (size_t u = x0; u <= x + GROWTH && u < p->width; u++)
            if (alpha(p, u, v) >= 0.5)
                return true;
    return false;
}

static double find_faint(const picture *p)
{
    double faint = 0, all = 0;
    for (size_t y = 0; y < p->height; y++)
        for (size_t x = 0; x < p->width; x++) {
            double a = alpha(p, x, y);
            all += a;
            if (a > 0 && a < 0.5 && !is_near_opaque(p, x, y))
                faint += a;
        }
    return all > 0 ? faint / all : 0;
}

int figure_read(figure *out, job *j, const char *name, const control_points *pins)
{
    *out = (figure){.n = 0};
    int result = picture_read(&out->picture, name);
    if (result == DONE && !picture_is_plain(&out->picture))
        result = failed(name, 0, "an array of floats or of many channels has no alpha");
    if (result == DONE)
        result = find_parts(out, j, name);
    if (result == DONE)
        result = find_pins(out, j, pins);
    if (result == DONE)
        out->faint = j->args->source == NULL ? find_faint(&out->picture) : 0;
    return result;
}

void figure_free(figure *f)
{
    picture_free(&f->picture);
    for (size_t k = 0; k < f->n; k++) {
        icc_domain_free(f->parts[k].domain);
        free(f->parts[k].pins);
        free(f->parts[k].clearance);
    }
    free(f->parts);
}
