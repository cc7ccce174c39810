/* Two layers of polygons whose regions have the same names: --by. */
#ifndef LAYER_CAGES_H
#define LAYER_CAGES_H

#include "job/job.h"

/* Reads the layers of source and target from their GeoJSON files. Makes their common vertices, and
 * cages of them. Prints what was done. DONE, or FAILED with a message on stderr. */
int layer_cages(job *j);

#endif
