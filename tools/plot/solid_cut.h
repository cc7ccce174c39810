/* The contents of a figure of a map in space: a solid, the plane that cuts it, and the cut. */
#ifndef SOLID_CUT_H
#define SOLID_CUT_H

#include "job/job.h"
#include "plot/solid_view.h"

typedef struct solid {
    job *job;
    body body;
    bool exact; /* the map is linear on the tetrahedra */
    plane plane;
    corners sheet, shell, rim;
    double ground[2][3]; /* axes of the grid in the plane */
    double cell;         /* of the grid */
    solid_view views[2];
} solid;

/* Makes the map, if there is none, and cuts the source as the options ask. DONE, or FAILED or
 * MISUSED with a message on stderr. Free it in any case. */
int solid_make(solid *out, job *j);
void solid_free(solid *x);

#endif
