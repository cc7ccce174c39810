/* Checks for --require: unless a result is as demanded, nothing is written. */
#ifndef REQUIRE_H
#define REQUIRE_H

#include "job/job.h"

/* Returns DONE if the maps of all parts of the job are as required, otherwise FAILED with a line on
 * stderr. The job must have a map. */
int require_maps(job *j);

#endif
