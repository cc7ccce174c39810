/* libicc pose --pins: a figure in a picture follows its pins. */
#include "cmd/commands.h"

#include "base/system.h"
#include "control/control_read.h"
#include "fit/pin_pose.h"

static int read_all(pin_pose *p)
{
    const args *a = p->job.args;
    int result = control_read(&p->pins, a->pins);
    if (result == DONE && p->pins.n == 0)
        result = failed(a->pins, 0, "there are no pins");
    if (result == DONE)
        result = figure_read(&p->figure, &p->job, a->operands[0], &p->pins);
    p->job.seconds_read = seconds_now() - p->job.started;
    return result;
}

/* Measures, draws and exports, unless --require forbids it. */
static int write_all(pin_pose *p)
{
    const args *a = p->job.args;
    int result = pins_measure(p);
    if (result == DONE && a->require != 0 && !p->certified)
        result = failed(a->operands[0], 0, "the pose is not certified, so nothing is written");
    if (result == DONE)
        result = pins_draw(p);
    return result == DONE && a->spine != NULL ? pins_write_spine(p) : result;
}

int run_pins(const args *a)
{
    pin_pose p = {.n_keys = a->frames > 0 ? (size_t)a->frames + 1 : 2};
    job_start(&p.job, a);
    int result = read_all(&p);
    double began = seconds_now();
    if (result == DONE)
        result = pins_fit(&p);
    p.job.seconds_made = seconds_now() - began;
    if (result == DONE)
        result = write_all(&p);
    if (result == DONE)
        result = pins_tell(&p);
    pins_free(&p);
    job_end(&p.job);
    return result;
}
