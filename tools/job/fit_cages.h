/* Maps between cages that are fits: because vertices of the target may slide along their walls, or
 * because points inside carry their surroundings along (--reach). */
#ifndef FIT_CAGES_H
#define FIT_CAGES_H

#include "job/job.h"

/* Makes the fit from source to target, and its map. Then vertices of the target that slide have the
 * places that they come to. The cages must have been read and correspond. */
int fit_cages(job *j);

/* True if a wall from a over v to b is straight enough for v to slide along it. */
bool fit_is_straight(const double *a, const double *v, const double *b);

/* Prints why a fit of a job was not made, for its item of this line, or 0. Returns FAILED. */
int fit_failed(job *j, const char *file, size_t line, const icc_error *err);

#endif
