/* Poses of a figure in a picture, by pins. The steps of `libicc pose --pins`.
 *
 * Words
 * - part: an outline of the picture with its holes. Each part has a mesh and moves by itself.
 * - key: a moment on the way from rest, key 0, to the pose, which is the last key.
 *
 * Ways
 * - Pins: control/control_pins.c reads them, pin_figure.h finds the outlines and the pins' parts.
 * - pin_fits.c poses, pin_draw.c draws pictures, pin_spine.c exports, pin_report.c tells. */
#ifndef PIN_POSE_H
#define PIN_POSE_H

#include "fit/pin_figure.h"

/* A mesh of a part, and its vertices at all keys. */
typedef struct pinned_part {
    size_t n_vertices, n_triangles;
    uint32_t *triangles;
    double **keys; /* 2 n_vertices each */
} pinned_part;

typedef struct pin_pose {
    job job;
    control_points pins;
    figure figure;
    size_t n_keys;
    pinned_part *parts; /* as many as the figure's */
    double *off;        /* of each pin: how far it is from its place in the pose */
    bool certified;     /* all parts at all keys */
    size_t n_covered;   /* pixels of the pose in which a part lies over another one */
    size_t width, height;
    long corner[2]; /* the upper left corner of the pictures, in pixels of the figure's picture */
} pin_pose;

/* Poses all parts. DONE, or FAILED after a message. */
int pins_fit(pin_pose *p);

/* Finds the size of the pictures. */
int pins_measure(pin_pose *p);

/* Draws and writes the pose, or all keys. */
int pins_draw(pin_pose *p);

/* Writes the figure and its pose as a skeleton of Spine. */
int pins_write_spine(const pin_pose *p);

/* Says how good the pose is, and writes the report on request. DONE, PARTIAL if a pin is not at its
 * place, or FAILED. */
int pins_tell(pin_pose *p);

/* The number of pins that are not at their places, and the largest distance. */
size_t pins_off(const pin_pose *p, double *most);

/* Frees everything but the job. */
void pins_free(pin_pose *p);

#endif
