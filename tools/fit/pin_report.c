/* What `libicc pose --pins` says about a pose, in words and as a report. */
#include "fit/pin_pose.h"

#include "base/allocate.h"

#include <stdio.h>
#include <string.h>

/* A share of the colour below this is not worth a message: rounding and specks. */
static const double FAINT = 0.005;

static void say(const pin_pose *p, const char *text)
{
    if (strcmp(p->job.args->operands[1], "-") == 0)
        note("%s", text);
    else
        printf("%s\n", text);
}

static size_t count_triangles(const pin_pose *p)
{
    size_t n = 0;
    for (size_t k = 0; k < p->figure.n; k++)
        n += p->parts[k].n_triangles;
    return n;
}

static void say_pose(const pin_pose *p, size_t n_off)
{
    char text[320], place[96] = "";
    const picture *from = &p->figure.picture;
    bool grown = p->width > from->width || p->height > from->height;
    snprintf(text, sizeof text,
             "one-to-one: %s; %zu part%s, %zu triangles; %zu of %zu pins are at "
             "their places",
             p->certified ? "yes, certified" : "not proved", p->figure.n,
             p->figure.n == 1 ? "" : "s", count_triangles(p), p->pins.n - n_off, p->pins.n);
    say(p, text);
    if (p->corner[0] < 0 || p->corner[1] < 0)
        snprintf(place, sizeof place, "; its pixel %ld, %ld was the first", -p->corner[0],
                 -p->corner[1]);
    snprintf(text, sizeof text, "the picture has %zu x %zu pixels, grown from %zu x %zu%s",
             p->width, p->height, from->width, from->height, place);
    if (grown)
        say(p, text);
}

static void report_pins(const pin_pose *p, json *j)
{
    json_open(j, "pins", '[');
    for (size_t i = 0; i < p->pins.n; i++) {
        json_open(j, NULL, '{');
        if (p->pins.names[i] != NULL)
            json_text(j, "name", p->pins.names[i]);
        json_flag(j, "reached", !(p->off[i] > 0));
        json_number(j, "off", p->off[i]);
        json_close(j, '}');
    }
    json_close(j, ']');
}

static int write_report(const pin_pose *p, size_t n_off)
{
    report r;
    if (!report_open(&r, &p->job))
        return FAILED;
    json *j = &r.json;
    json_flag(j, "certified", p->certified);
    json_count(j, "pins_off", n_off);
    report_pins(p, j);
    json_count(j, "parts", p->figure.n);
    json_count(j, "triangles", count_triangles(p));
    json_count(j, "covered_pixels", p->n_covered);
    json_number(j, "faint", p->figure.faint);
    json_count(j, "width", p->width);
    json_count(j, "height", p->height);
    json_open(j, "corner", '[');
    for (int k = 0; k < 2; k++)
        json_number(j, NULL, (double)p->corner[k]);
    json_close(j, ']');
    report_times(&r, &p->job, 0);
    return report_close(&r) ? DONE : FAILED;
}

int pins_tell(pin_pose *p)
{
    double most;
    size_t n_off = pins_off(p, &most);
    pin_text name;
    progress_end(&p->job.bar);
    if (p->job.args->json && write_report(p, n_off) != DONE)
        return FAILED;
    if (!p->job.args->json)
        say_pose(p, n_off);
    if (p->figure.faint > FAINT)
        note("%s: %.2g %% of the colour is left out, because it is fainter than one half and away "
             "from the figure",
             p->job.args->operands[0], 100 * p->figure.faint);
    if (p->n_covered > 0)
        note("parts of the figure lie over each other in %zu pixels", p->n_covered);
    for (size_t i = 0; i < p->pins.n; i++)
        if (p->off[i] > 0)
            note("%s stops %.3g pixels before its place, because the figure would fold or overlap "
                 "on the way",
                 pin_name(name, &p->pins, i), p->off[i]);
    return n_off == 0 ? DONE : PARTIAL;
}
