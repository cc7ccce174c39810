/* Where pins are on the way to the pose. */
#ifndef PIN_PATH_H
#define PIN_PATH_H

#include "control/control_points.h"

/* Finds the places of all pins at a share of the way, 2 for each, at 1 exactly where they go. Pins move
 * straight. If bones join pins, the first pin of each tree of bones moves straight, and from there
 * each bone turns evenly, so that it does not get short on the way. */
void pins_places(double *out, const control_points *pins, double share);

/* The angle from a bone at rest to the bone in the pose, in radians from -pi to pi. */
double bone_turn(const control_points *pins, size_t bone);

#endif
