/* Checks for --require: nothing is written unless a result is as required. */
#ifndef REQUIRE_H
#define REQUIRE_H

#include "job/job.h"

/* Returns DONE if the maps of all parts of the job are as required, otherwise FAILED with a message
 * on stderr. The job must have a map. */
int require_maps(job *j);

#endif
