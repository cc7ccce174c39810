/* Brings a scan into the coordinates of the target, by its control points. */
#ifndef RECTIFY_H
#define RECTIFY_H

#include "fit/fit_job.h"

/* Makes the fit of points that are pixels of the first operand, and writes the picture with square
 * pixels of the target to the second one, and a world file beside it. Returns DONE, or another exit
 * code after a message. */
int rectify(fit_job *f);

#endif
