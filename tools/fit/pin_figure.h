/* A figure in a picture: the outlines of what is opaque in it, and the pins in each. */
#ifndef PIN_FIGURE_H
#define PIN_FIGURE_H

#include "control/control_points.h"
#include "job/job.h"
#include "picture/picture.h"

/* An outline with its holes. Its pins move it. */
typedef struct figure_part {
    icc_domain *domain;
    size_t n_pins;
    uint32_t *pins;    /* numbers of its pins, rising */
    double *clearance; /* of each of its pins: the distance to its outline */
} figure_part;

typedef struct figure {
    picture picture;
    size_t n;
    figure_part *parts;
    double faint; /* the share of the colour that is in no part */
} figure;

/* Reads a picture with an alpha and finds the part of each pin. DONE, or FAILED after a message.
 * Free it in any case. */
int figure_read(figure *out, job *j, const char *name, const control_points *pins);
void figure_free(figure *f);

typedef char pin_text[48];

/* How messages call a pin: `pin "left hand"`, or `pin 3`, counted from 1. Returns `out`. */
const char *pin_name(pin_text out, const control_points *pins, size_t i);

#endif
