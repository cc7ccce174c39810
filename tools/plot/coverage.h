/* Checks that cages and a picture fit together. */
#ifndef COVERAGE_H
#define COVERAGE_H

#include "job/job.h"

/* Prints a remark if a cage covers almost nothing of a picture of that size, or reaches beyond
 * it. */
void coverage_tell(job *j, size_t width, size_t height);

#endif
