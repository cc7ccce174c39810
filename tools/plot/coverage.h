/* Whether cages and a picture belong together. */
#ifndef COVERAGE_H
#define COVERAGE_H

#include "job/job.h"

/* Says so when a cage covers next to nothing of a picture of that size, or reaches beyond it. */
void coverage_tell(job *j, size_t width, size_t height);

#endif
