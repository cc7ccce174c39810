/* --require: what a result must be, or nothing is written. */
#ifndef REQUIRE_H
#define REQUIRE_H

#include "job/job.h"

/* DONE if the job's maps, of all parts, are as they are required to be; else FAILED with a line on
 * stderr. There must be a map. */
int require_maps(job *j);

#endif
